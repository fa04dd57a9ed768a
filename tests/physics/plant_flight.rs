//! A configured flight obeys what holds for any flight: turning the universe changes nothing, energy of the orbit is
//! kept, gravity gradient has its textbook value.

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Rotation3, Vector3};
use physics::attitude::Attitude;
use physics::bodies::Body;
use physics::bodies::surface::MERCURY;
use physics::constants::{GM_MERCURY_M3_S2, RADIUS_MERCURY_M, SPEED_OF_LIGHT_M_S};
use physics::environment::CartesianState;
use physics::environment::eclipse::{Shadow, ShadowModel};
use physics::environment::frames::Frame;
use physics::environment::orbit::{Elements, OrbitMethod, TwoBodyOrbit};
use physics::guidance::downlink::default_downlink::DefaultDownlink;
use physics::guidance::{Guided, Schedule, ScienceRule};
use physics::loads::{Active, Effect, ForceTorque, Loads, Switch};
use physics::momentum::{
    Convention, DumpPolicy, MomentumIntegrator, Reinitialise, Settings, TorqueModel, Totals,
};
use physics::numerics::quadrature;
use physics::plant::{
    AttitudeSource, Command, Configuration, Digest, EphemerisSource, External, Laws, LightSource, Motion,
    PanelSetting, PanelStep, Plant, PreparedSpacecraft, PropagatorState, RadiationSettings, RadiationSolver,
    Ramp, SimulationContext, Sources, SunLight, ThrusterEventSettings, Turning,
};
use physics::radiation::SolarModel;
use physics::spacecraft::{MESSENGER_TOML, MassProperties, Spacecraft, SunshadeModel};

/// Light and heat unshadowed, without stored heat.
const PLAIN: RadiationSettings =
    RadiationSettings { storage: false, shadowing: false, sun_disc: false, grid_s: 600.0, tolerance: 1e-5 };

pub(crate) const EPOCH_S: f64 = 3382.5 * 86_400.0;

fn elements() -> Elements {
    Elements {
        semi_major_axis_m: 1.0136e7,
        eccentricity: 0.74,
        inclination_rad: 1.44,
        ascending_node_rad: 6.11,
        periapsis_argument_rad: 2.08,
        true_anomaly_rad: 0.0,
    }
}

pub(crate) fn configuration(orbit: TwoBodyOrbit, attitude: AttitudeSource) -> Configuration {
    Configuration {
        encounter: None,
        figure: None,
        air_and_field: None,
        laws: Laws { gm_m3_s2: GM_MERCURY_M3_S2, flattening: None, dipole_body_a_m2: Vector3::zeros() },
        epoch_minus_time_s: EPOCH_S,
        center: Body::Mercury,
        center_radius_m: RADIUS_MERCURY_M,
        eme2000_from_orbit_frame: Matrix3::identity(),
        orbit,
        motion: Motion::TwoBody,
        ephemeris: EphemerisSource::Vsop87,
        light: SunLight { source: LightSource::Distance { flux_w_m2: 1353.0 }, scale: 1.0 },
        shadow: Shadow::new(ShadowModel::Off, RADIUS_MERCURY_M).unwrap(),
        light_and_heat: PLAIN,
        attitude,
        timeline: None,
        sunshade: SunshadeModel::Plates,
        panels: vec![PanelSetting::Disabled; 2],
        wet_mass: MassProperties {
            center_of_mass_body_m: Vector3::new(0.0, 0.01, -0.03),
            mass_kg: 700.0,
            inertia_body_kg_m2: Matrix3::from_diagonal(&Vector3::new(199.6, 507.1, 484.9)),
        },
        effects: Active::by(|switch| switch == Switch::GravityGradient),
        momentum: Settings {
            grid_s: 600.0,
            tolerance: 1e-11,
            convention: Convention::Inertial,
            policy: DumpPolicy {
                threshold_body_n_m_s: Vector3::repeat(f64::INFINITY),
                bias_body_n_m_s: Vector3::zeros(),
                reinitialise: Reinitialise::Opposite { fraction: 1.0 },
            },
        },
        thruster_events: ThrusterEventSettings::default(),
    }
}

pub(crate) fn guided(orbit: &TwoBodyOrbit) -> AttitudeSource {
    AttitudeSource::Guided(Guided {
        schedule: Schedule {
            periapsis_s: orbit.periapsis_epoch_s(0),
            period_s: orbit.period_s(),
            downlink_start_s: 7200.0,
            downlink_end_s: 36_000.0,
            period_shares: [None; 2],
            every: 2,
            once: false,
            throughout: false,
        },
        science: ScienceRule::Scaled { gain: 0.25 },
        elevation_limit_rad: 0.2269,
        slew_rate_rad_s: 3e-3,
        keep_in: None,
        sun_direction: None,
        requested: Default::default(),
        managed: false,
    })
}

pub(crate) fn orbit() -> TwoBodyOrbit {
    orbit_in(Frame::PlanetEquator)
}

fn orbit_in(frame: Frame) -> TwoBodyOrbit {
    let to_eme2000 = frame.dcm_eme2000_from_frame(Body::Mercury.data(), CartesianState::default).unwrap();
    TwoBodyOrbit::from_elements(elements(), GM_MERCURY_M3_S2, EPOCH_S).unwrap().along(&to_eme2000)
}

fn spacecraft() -> Spacecraft {
    Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap()
}

/// A spacecraft with everything a flight of it needs.
pub(crate) struct Rig {
    spacecraft: Spacecraft,
    solar: SolarModel,
    method: OrbitMethod,
    default_downlink: DefaultDownlink,
    pub(crate) propagator: PropagatorState,
    context: Option<SimulationContext>,
}

impl Rig {
    pub(crate) fn new() -> Self {
        let spacecraft = spacecraft();
        Self {
            solar: SolarModel::new(&spacecraft, None).unwrap(),
            spacecraft,
            method: OrbitMethod::default(),
            default_downlink: DefaultDownlink::default(),
            propagator: PropagatorState::default(),
            context: None,
        }
    }

    fn plant(&mut self, configuration: &Configuration) -> Plant<'_> {
        self.plant_with(configuration, &|_| [ForceTorque::zero(); 2])
    }

    fn plant_in_light(&mut self, configuration: &Configuration, light: RadiationSolver) -> Plant<'_> {
        self.context_of(configuration).models.sources = Sources::new(Some(light), None);
        self.plant_now(&|_| [ForceTorque::zero(); 2])
    }

    /// The spacecraft.
    pub(crate) fn prepared(&self) -> PreparedSpacecraft<'_> {
        PreparedSpacecraft {
            panels: &self.spacecraft.panels,
            solar: &self.solar,
            orbit_method: &self.method,
            default_downlink: &self.default_downlink,
            timeline: None,
        }
    }

    /// Continues under this configuration.
    fn context_of(&mut self, configuration: &Configuration) -> &mut SimulationContext {
        self.context.insert(SimulationContext::new(configuration.clone()))
    }

    pub(crate) fn plant_with<'a>(
        &'a mut self,
        configuration: &Configuration,
        load: &'a External<'a>,
    ) -> Plant<'a> {
        self.context_of(configuration);
        self.plant_now(load)
    }

    fn plant_now<'a>(&'a mut self, load: &'a External<'a>) -> Plant<'a> {
        let prepared = PreparedSpacecraft {
            panels: &self.spacecraft.panels,
            solar: &self.solar,
            orbit_method: &self.method,
            default_downlink: &self.default_downlink,
            timeline: None,
        };
        self.context.as_mut().unwrap().plant(prepared, Turning::still(), &mut self.propagator, load)
    }
}

#[test]
fn orbit_elements_keep_energy_and_angular_momentum_in_every_frame() {
    let expected_energy = -GM_MERCURY_M3_S2 / (2.0 * elements().semi_major_axis_m);
    let p_m = elements().semi_major_axis_m * (1.0 - 0.74f64.powi(2));
    for frame in [Frame::PlanetOrbit, Frame::PlanetEquator, Frame::Eme2000, Frame::Ecliptic] {
        let orbit = orbit_in(frame);
        for hours in [0.0, 1.0, 5.5, 11.9, 1000.0] {
            let state = orbit.state_at(EPOCH_S + hours * 3600.0);
            let energy = 0.5 * state.velocity_m_s.norm_squared() - GM_MERCURY_M3_S2 / state.position_m.norm();
            assert_relative_eq!(energy, expected_energy, max_relative = 1e-9);
            let h = state.position_m.cross(&state.velocity_m_s).norm();
            assert_relative_eq!(h, (GM_MERCURY_M3_S2 * p_m).sqrt(), max_relative = 1e-9);
        }
    }
}

/// Integrates momentum until `time_s`; no dump is due.
pub(super) fn integrate(
    integrator: &mut MomentumIntegrator,
    plant: &mut Plant<'_>,
    settings: &Settings,
    time_s: f64,
) {
    while integrator.ends_by(time_s) {
        let prepared = integrator.prepare(plant, settings, f64::INFINITY).unwrap();
        assert!(prepared.due.is_none());
        integrator.advance_segment(plant, settings, &prepared).unwrap();
    }
}

#[test]
fn accumulated_momentum_is_the_gauss_quadrature_of_torque() {
    let orbit = orbit();
    let configuration = configuration(orbit, guided(&orbit));
    let (mut a, mut b) = (Rig::new(), Rig::new());
    let mut plant = a.plant(&configuration);
    let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
    // Inside one downlink window, past its slew: smooth, so Gauss-Legendre on 60 s pieces is as good as exact.
    let (from_s, to_s) = (10_000.0, 30_000.0);
    integrate(&mut integrator, &mut plant, &configuration.momentum, from_s);
    let before = integrator.totals(from_s).momentum_inertial_n_m_s;
    integrate(&mut integrator, &mut plant, &configuration.momentum, to_s);
    let gained = integrator.totals(to_s).momentum_inertial_n_m_s - before;
    let mut plant = b.plant(&configuration);
    let rule = quadrature::Rule::<5>::gauss_legendre();
    let mut sum = Vector3::zeros();
    let pieces = 334;
    let length_s = (to_s - from_s) / f64::from(pieces);
    for piece in 0..pieces {
        let start_s = from_s + f64::from(piece) * length_s;
        for (time_s, weight_s) in rule.on(start_s, start_s + length_s) {
            let sample = plant.sample(time_s);
            sum += sample.inertial_from_body * sample.torque_body_n_m * weight_s;
        }
    }
    assert!(gained.norm() > 1e-3);
    assert_relative_eq!(gained, sum, epsilon = 1e-9);
}

#[test]
fn gravity_gradient_has_its_textbook_value() {
    // Planet in the body XY plane at 45 deg: N_z = (3 mu / 2 r^3) (J_y - J_x).
    let orbit = orbit();
    let state = orbit.state_at(EPOCH_S);
    let toward = -state.position_m.normalize();
    let across = state.velocity_m_s.normalize();
    let axis = toward.cross(&across).normalize();
    let across = axis.cross(&toward);
    let x = (toward + across).normalize();
    let y = axis.cross(&x);
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, axis]));
    let command = Command {
        attitude: Attitude::from_rotation(&rotation),
        rate_body_rad_s: Vector3::zeros(),
        since_s: 0.0,
    };
    let configuration = configuration(orbit, AttitudeSource::Commanded(command));
    let mut rig = Rig::new();
    let mut plant = rig.plant(&configuration);
    let torque = plant.evaluate(0.0).loads[Effect::GravityGradient].torque_body_n_m;
    // The planet stands at -45 deg from X: toward = (x - y) / sqrt 2.
    let expected = -1.5 * GM_MERCURY_M3_S2 / state.position_m.norm().powi(3) * (507.1 - 199.6);
    assert_relative_eq!(torque, Vector3::new(0.0, 0.0, expected), max_relative = 1e-9, epsilon = 1e-15);
}

/// A body that stands still, from the orbit's centre, in m.
pub(crate) fn still(position_m: Vector3<f64>) -> CartesianState {
    CartesianState { position_m, ..CartesianState::default() }
}

#[test]
fn a_given_sun_is_where_it_was_given() {
    let orbit = orbit();
    let sun_m = Vector3::new(4e10, -3e10, 1e10);
    let command = Command { attitude: Attitude::default(), rate_body_rad_s: Vector3::zeros(), since_s: 0.0 };
    let configuration = Configuration {
        ephemeris: EphemerisSource::Given { sun: still(sun_m), earth: still(Vector3::new(0.0, 1e11, 0.0)) },
        ..configuration(orbit, AttitudeSource::Commanded(command))
    };
    let mut rig = Rig::new();
    let mut plant = rig.plant(&configuration);
    let evaluation = plant.evaluate(0.0);
    let expected = (sun_m - orbit.state_at(EPOCH_S).position_m).normalize();
    assert_relative_eq!(evaluation.instant.sun_body, expected, epsilon = 1e-12);
    // Bounded by a black sphere and a mirror of the whole area: pressure times 5.4 m2, once and twice.
    let distance_au = evaluation.instant.sun_distance_m / 149_597_870_700.0;
    let pressure_pa = 1353.0 / SPEED_OF_LIGHT_M_S / (distance_au * distance_au);
    assert!(evaluation.loads[Effect::Solar].force_body_n.norm() < 2.0 * 5.4 * pressure_pa);
}

/// Questions of a planner change nothing in the flight, whatever it assumes of the time ahead.
#[test]
fn a_clone_predicts_the_span_ahead() {
    let orbit = orbit();
    let configuration = configuration(orbit, guided(&orbit));
    let torques = |rig: &mut Rig, times_s: &[f64]| -> Vec<Vector3<f64>> {
        let mut plant = rig.plant(&configuration);
        let torque = |time_s: &f64| {
            plant.prepare(*time_s, f64::INFINITY).unwrap();
            plant.evaluate(*time_s).loads.total().torque_body_n_m
        };
        times_s.iter().map(torque).collect()
    };
    let (mut requested, mut simulated) = (Rig::new(), Rig::new());
    torques(&mut requested, &[0.0, 600.0]);
    torques(&mut simulated, &[0.0, 600.0]);
    let before = requested.propagator.clone();
    let ahead_s = [1200.0, 5000.0, 9000.0];
    let predicted = torques(&mut requested, &ahead_s);
    requested.propagator = before;
    assert_eq!(requested.propagator, simulated.propagator);
    assert_eq!(torques(&mut requested, &ahead_s), predicted);
    assert_eq!(torques(&mut simulated, &ahead_s), predicted);
}

/// An attitude sampled every 10 s and propagated in between gives the light of the motion it was sampled from.
#[test]
fn light_follows_an_attitude_that_is_known_only_up_to_now() {
    let truth = Command {
        attitude: Attitude::from_quaternion([0.5, -0.5, 0.5, 0.5]).unwrap(),
        rate_body_rad_s: Vector3::new(2e-4, -1e-4, 3e-4),
        since_s: 0.0,
    };
    let settings = RadiationSettings { grid_s: 10.0, ..PLAIN };
    let with = |command: Command| Configuration {
        effects: Active::by(|_| true),
        light_and_heat: settings,
        ..configuration(orbit(), AttitudeSource::Commanded(command))
    };
    let spacecraft = spacecraft();
    let light = RadiationSolver::new(&spacecraft, &with(truth), &MERCURY, 6).unwrap();
    let simulate = |sample_s: Option<f64>| {
        let (mut rig, mut command) = (Rig::new(), truth);
        let mut loads = Vec::new();
        for k in 0..=60 {
            let time_s = 5.0 * f64::from(k);
            if sample_s.is_some_and(|sample_s| time_s % sample_s == 0.0) {
                rig.propagator.cut(&with(command), time_s);
                command = Command { attitude: truth.attitude_at(time_s), since_s: time_s, ..truth };
            }
            let configuration = with(command);
            let mut plant = rig.plant_in_light(&configuration, light.clone());
            plant.prepare(time_s, f64::INFINITY).unwrap();
            loads.push(plant.evaluate(time_s).loads.total());
        }
        loads
    };
    for (continuous, sampled) in simulate(None).into_iter().zip(simulate(Some(10.0))) {
        let scale_n = continuous.force_body_n.norm();
        assert!(scale_n > 0.0);
        assert!((continuous.force_body_n - sampled.force_body_n).norm() < 1e-9 * scale_n);
        assert!((continuous.torque_body_n_m - sampled.torque_body_n_m).norm() < 1e-9 * scale_n);
    }
}

/// Light that was fitted for other settings ends where those change, as if it had been cut there.
#[test]
fn a_fit_for_other_settings_ends_where_they_change() {
    let attitude = Attitude::from_quaternion([0.5, -0.5, 0.5, 0.5]).unwrap();
    let command = Command { attitude, rate_body_rad_s: Vector3::zeros(), since_s: 0.0 };
    let with = |center_of_mass_x_m: f64| {
        let mut moved = configuration(orbit(), AttitudeSource::Commanded(command));
        moved.effects = Active::by(|_| true);
        moved.wet_mass.center_of_mass_body_m = Vector3::new(center_of_mass_x_m, 0.0, 0.0);
        moved
    };
    let light = RadiationSolver::new(&spacecraft(), &with(0.0), &MERCURY, 6).unwrap();
    let simulate = |digests: [Digest; 2], is_cut: bool| {
        let mut rig = Rig::new();
        let mut loads = Loads::zero();
        for (digest, (time_s, x_m)) in digests.into_iter().zip([(0.0, 0.0), (0.5, 0.1)]) {
            if is_cut && time_s > 0.0 {
                rig.propagator.cut(&with(0.0), time_s);
            }
            let context = rig.context_of(&with(x_m));
            context.models.sources = Sources::new(Some(light.clone()), None);
            context.models.digest = digest;
            let mut plant = rig.plant_now(&|_| [ForceTorque::zero(); 2]);
            plant.prepare(time_s, f64::INFINITY).unwrap();
            loads = plant.evaluate(time_s).loads;
        }
        loads
    };
    let [one, other] = [1, 2].map(|word| Digest::default().with_word(word));
    let cut = simulate([one, one], true);
    assert_eq!(simulate([one, other], false), cut);
    assert_ne!(simulate([one, one], false), cut);
}

/// Each stretch between two edges is a flight with panels that are held; the second edge comes sooner after the first than an event
/// that is searched for could.
#[test]
fn spans_end_at_the_number_where_a_panel_goes_elsewhere() {
    const END_S: f64 = 9000.0;
    const EDGES_S: [f64; 4] = [0.0, 1_234.567_890_123, 1_234.567_95, 5_000.3];
    const OFFSETS_RAD: [[f64; 2]; 4] = [[0.9, 0.9], [-0.4, 0.7], [-0.4, -0.2], [1.2, 1.2]];
    let orbit = orbit();
    // So slow that no surface comes out of the dark: that bends the torque, by however little within an interval.
    let turning = Command {
        attitude: Attitude::from_quaternion([0.5, -0.5, 0.5, 0.5]).unwrap(),
        rate_body_rad_s: Vector3::new(2e-6, -1e-6, 3e-6),
        since_s: 0.0,
    };
    for attitude in [guided(&orbit), AttitudeSource::Commanded(turning)] {
        let whole = configuration(orbit, attitude);
        let steps = |panel: usize| {
            let all = EDGES_S.iter().zip(OFFSETS_RAD).skip(1);
            all.map(|(&at_s, offsets)| PanelStep { at_s, offset_rad: offsets[panel] }).collect()
        };
        let timeline = |panel: usize| PanelSetting::Timeline {
            steps: steps(panel),
            clock_minus_time_s: 0.0,
            before_rad: OFFSETS_RAD[0][panel],
            tilt: 1.0.into(),
        };
        let stepped = Configuration { panels: vec![timeline(0), timeline(1)], ..whole.clone() };
        let simulate = |cut_s: f64| {
            let mut rig = Rig::new();
            let mut plant = rig.plant(&stepped);
            let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
            let mut now_s = 0.0;
            while now_s < END_S {
                now_s = (now_s + cut_s).min(END_S);
                integrate(&mut integrator, &mut plant, &stepped.momentum, now_s);
            }
            integrator.totals(END_S).momentum_inertial_n_m_s
        };
        let found = simulate(END_S);
        for cut_s in [100.0, 617.284, 86_400.0] {
            assert_eq!(simulate(cut_s), found, "{cut_s}");
        }
        let mut totals = Totals::default();
        for (k, &start_s) in EDGES_S.iter().enumerate() {
            let end_s = EDGES_S.get(k + 1).copied().unwrap_or(END_S);
            let offset = |angle| PanelSetting::SunOffset { offset: Ramp::held(angle), tilt: 1.0.into() };
            let held = Configuration { panels: OFFSETS_RAD[k].map(offset).to_vec(), ..whole.clone() };
            let mut rig = Rig::new();
            let mut plant = rig.plant(&held);
            let mut integrator = MomentumIntegrator::new(start_s, totals);
            integrate(&mut integrator, &mut plant, &held.momentum, end_s);
            totals = integrator.totals(end_s);
            let mut rig = Rig::new();
            let mut plant = rig.plant(&stepped);
            if k + 1 < EDGES_S.len() {
                for before_s in [end_s.next_down(), end_s - 5e-5, end_s - 0.5] {
                    let within = before_s >= start_s;
                    assert!(!within || plant.prepare(before_s, END_S).unwrap().0 == end_s, "{before_s}");
                }
            }
        }
        let apart = (found - totals.momentum_inertial_n_m_s).norm();
        // Where an interval is halved depends on the one before; both are within the integrator's tolerance.
        let allowed = stepped.momentum.tolerance * found.norm();
        assert!(apart < allowed && found.norm() > 1e-2, "{apart:e} of {}", found.norm());
    }
}
