//! A passage through the planet's shadow is never missed, however short it is beside the solver's step.

use nalgebra::Vector3;
use physics::attitude::Attitude;
use physics::constants::{GM_MERCURY_M3_S2, RADIUS_MERCURY_M};
use physics::environment::eclipse::{Shadow, ShadowModel};
use physics::environment::orbit::{Elements, TwoBodyOrbit};
use physics::loads::{Active, ForceTorque};
use physics::momentum::{MomentumIntegrator, TorqueModel, Totals};
use physics::plant::{AttitudeSource, Command, Configuration, EphemerisSource, LightSource, SunLight};

use super::plant_flight::{EPOCH_S, Rig, configuration, integrate, still};

const RADIUS_M: f64 = 3.2e6;
const DURATION_S: f64 = 4_000.0;

fn mean_motion_rad_s() -> f64 {
    (GM_MERCURY_M3_S2 / RADIUS_M.powi(3)).sqrt()
}

/// A circle about Mercury tilted against the Sun's direction (+X) until it spends `shadow_s` of each revolution in the
/// cylinder behind the planet; its deepest point is passed at `midnight_s`.
fn tilted(shadow_s: f64, midnight_s: f64) -> TwoBodyOrbit {
    let half_rad = 0.5 * mean_motion_rad_s() * shadow_s;
    let cosine = (1.0 - (RADIUS_MERCURY_M / RADIUS_M).powi(2)).sqrt() / half_rad.cos();
    // The plane holds -X turned by the tilt about Y, and Y.
    let inclination_rad = cosine.acos();
    let orbit = Elements {
        semi_major_axis_m: RADIUS_M,
        eccentricity: 0.0,
        inclination_rad,
        ascending_node_rad: core::f64::consts::FRAC_PI_2,
        periapsis_argument_rad: 0.0,
        true_anomaly_rad: core::f64::consts::FRAC_PI_2 - mean_motion_rad_s() * midnight_s,
    };
    TwoBodyOrbit::from_elements(orbit, GM_MERCURY_M3_S2, EPOCH_S).unwrap()
}

fn in_light(orbit: TwoBodyOrbit, model: ShadowModel, grid_s: f64) -> Configuration {
    let command = Command { attitude: Attitude::default(), rate_body_rad_s: Vector3::zeros(), since_s: 0.0 };
    // The body's -Y looks at the Sun, so far away that its light is parallel.
    let sun_m = Vector3::new(0.0, -1e17, 0.0);
    let turned = Command { attitude: attitude_toward_x(), ..command };
    let base = configuration(orbit, AttitudeSource::Commanded(turned));
    let mut momentum = base.momentum;
    momentum.grid_s = grid_s;
    Configuration {
        ephemeris: EphemerisSource::Given {
            sun: still(Vector3::new(-sun_m.y, 0.0, 0.0)),
            earth: still(Vector3::new(0.0, 1e11, 0.0)),
        },
        light: SunLight { source: LightSource::Fixed { pressure_pa: 5e-5 }, scale: 1.0 },
        shadow: Shadow::new(model, RADIUS_MERCURY_M).unwrap(),
        effects: Active::by(|_| false),
        momentum,
        ..base
    }
}

/// -Y of the body along +X of EME2000.
fn attitude_toward_x() -> Attitude {
    let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), core::f64::consts::FRAC_PI_2);
    Attitude::from_rotation(&turn)
}

fn momentum_after(configuration: &Configuration, time_s: f64) -> Vector3<f64> {
    let mut rig = Rig::new();
    let mut plant = rig.plant_with(configuration, &|_| [ForceTorque::zero(); 2]);
    let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
    integrate(&mut integrator, &mut plant, &configuration.momentum, time_s);
    integrator.totals(time_s).momentum_inertial_n_m_s
}

/// Torque and attitude are constant in light, so the momentum is the torque times the time in light.
#[test]
fn the_momentum_of_a_grazing_passage_is_torque_times_time_in_light() {
    for shadow_s in [117.0, 60.0, 10.0, 1.0] {
        for midnight_s in [1_200.0, 1_471.3, 1_500.0, 2_000.7] {
            let orbit = tilted(shadow_s, midnight_s);
            for grid_s in [600.0, 60.0, 7.0] {
                let dark = in_light(orbit, ShadowModel::AllOrNothingCylinder, grid_s);
                let mut rig = Rig::new();
                let sample = rig
                    .plant_with(&dark, &|_| [ForceTorque::zero(); 2])
                    .sample(midnight_s - 0.5 * shadow_s - 1.0);
                let torque_n_m = sample.inertial_from_body * sample.torque_body_n_m;
                let expected = torque_n_m * (DURATION_S - shadow_s);
                let found = momentum_after(&dark, DURATION_S);
                let off = (found - expected).norm() / (torque_n_m.norm() * DURATION_S);
                assert!(torque_n_m.norm() > 1e-7, "{torque_n_m}");
                assert!(off < 1e-9, "{shadow_s} s at {midnight_s} s on {grid_s} s: {off:e}");
            }
        }
    }
}

/// The same passages by the disc of the Sun: steps far longer than the penumbra give what steps far shorter give.
#[test]
fn long_steps_see_what_short_ones_see_in_every_shadow() {
    for model in [ShadowModel::DiscOverlap, ShadowModel::AllOrNothingCone] {
        for shadow_s in [60.0, 10.0, 1.0] {
            let orbit = tilted(shadow_s, 1_471.3);
            // Near enough that the Sun has a disc and the shadow a penumbra.
            let sun_m = Vector3::new(5e10, 0.0, 0.0);
            let seen = |grid_s: f64| {
                let mut dark = in_light(orbit, model, grid_s);
                dark.ephemeris =
                    EphemerisSource::Given { sun: still(sun_m), earth: still(Vector3::new(0.0, 1e11, 0.0)) };
                momentum_after(&dark, DURATION_S)
            };
            let (long, short) = (seen(600.0), seen(1.0));
            assert!((long - short).norm() < 1e-10, "{model:?} {shadow_s}: {:e}", (long - short).norm());
        }
    }
}
