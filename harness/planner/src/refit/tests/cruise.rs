//! A cruise at 0.4 AU on the plant's physics: Sun on -Y, the Earth's direction in the XY plane, panels at offsets that follow one another.

use nalgebra::{Matrix3, Vector3};
use physics::{
    bodies::Body,
    constants::{ASTRONOMICAL_UNIT_M, GM_SUN_M3_S2, RADIUS_SUN_M},
    environment::{
        eclipse::{Shadow, ShadowModel},
        frames::dcm_eme2000_from_ecliptic,
        orbit::{Elements, OrbitMethod, TwoBodyOrbit},
    },
    guidance::{Guided, Schedule, ScienceRule, downlink::default_downlink::DefaultDownlink},
    loads::{Active, ForceTorque},
    momentum::{Convention, DumpPolicy, MomentumIntegrator, Reinitialise, Settings, Totals},
    plant::{
        AttitudeSource, Configuration, EphemerisSource, Laws, LightSource, Motion, PanelSetting, PanelStep,
        PreparedSpacecraft, PropagatorState, RadiationSettings, SimulationContext, SunLight,
        ThrusterEventSettings, Turning,
    },
    radiation::SolarModel,
    spacecraft::{MESSENGER_TOML, MassProperties, Spacecraft, SunshadeModel},
};

use crate::{
    Failure,
    refit::{Flights, History, Parameters},
};

use super::DAY_S;

const EPOCH_S: f64 = 3000.0 * DAY_S;

/// The flight, repeated with any values.
pub(super) struct Cruise {
    spacecraft: Spacecraft,
    solar: SolarModel,
    /// By panel.
    steps: Vec<Vec<PanelStep>>,
}

impl Cruise {
    /// Offsets in deg, each from a day on, and what the panel on the one side has more and the other less.
    pub(super) fn new(offsets: &[(f64, f64, f64)]) -> Self {
        let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
        let of_panel = |side: f64| {
            let step = |(at_d, offset_deg, windmill_deg): &(f64, f64, f64)| PanelStep {
                at_s: at_d * DAY_S,
                offset_rad: (offset_deg + side * windmill_deg).to_radians(),
            };
            offsets.iter().map(step).collect()
        };
        assert_eq!(spacecraft.panels.len(), 2);
        Self {
            solar: SolarModel::new(&spacecraft, None).unwrap(),
            steps: vec![of_panel(1.0), of_panel(-1.0)],
            spacecraft,
        }
    }

    fn configuration(&self, parameters: &Parameters) -> Configuration {
        let elements = Elements {
            semi_major_axis_m: 0.4 * ASTRONOMICAL_UNIT_M,
            eccentricity: 0.0,
            inclination_rad: 0.05,
            ascending_node_rad: 0.3,
            periapsis_argument_rad: 0.0,
            true_anomaly_rad: 1.0,
        };
        let orbit = TwoBodyOrbit::from_elements(elements, GM_SUN_M3_S2, EPOCH_S).unwrap();
        let orbit = orbit.along(&dcm_eme2000_from_ecliptic());
        let panel = |steps: &Vec<PanelStep>| PanelSetting::Timeline {
            steps: steps.as_slice().into(),
            clock_minus_time_s: 0.0,
            before_rad: steps[0].offset_rad,
            tilt: 1.0.into(),
        };
        Configuration {
            encounter: None,
            figure: None,
            air_and_field: None,
            laws: Laws { gm_m3_s2: GM_SUN_M3_S2, flattening: None, dipole_body_a_m2: Vector3::zeros() },
            epoch_minus_time_s: EPOCH_S,
            center: Body::Sun,
            center_radius_m: RADIUS_SUN_M,
            eme2000_from_orbit_frame: dcm_eme2000_from_ecliptic(),
            motion: Motion::TwoBody,
            ephemeris: EphemerisSource::Vsop87,
            light: SunLight {
                source: LightSource::Distance { flux_w_m2: 1358.0 },
                scale: parameters.solar_scale,
            },
            shadow: Shadow::new(ShadowModel::Off, 6.96e8).unwrap(),
            light_and_heat: RadiationSettings {
                storage: false,
                shadowing: false,
                sun_disc: false,
                grid_s: 600.0,
                tolerance: 1e-5,
            },
            attitude: AttitudeSource::Guided(Guided {
                schedule: Schedule {
                    periapsis_s: orbit.periapsis_epoch_s(0),
                    period_s: orbit.period_s(),
                    downlink_start_s: 0.0,
                    downlink_end_s: 0.0,
                    period_shares: [None; 2],
                    every: 0,
                    once: false,
                    throughout: true,
                },
                science: ScienceRule::Scaled { gain: 0.25 },
                elevation_limit_rad: 0.2269,
                slew_rate_rad_s: 0.0,
                keep_in: None,
                sun_direction: None,
                requested: Default::default(),
                managed: false,
            }),
            orbit,
            timeline: None,
            sunshade: SunshadeModel::Plates,
            panels: self.steps.iter().map(panel).collect(),
            wet_mass: MassProperties {
                center_of_mass_body_m: parameters.center_of_mass_body_m,
                mass_kg: 900.0,
                inertia_body_kg_m2: Matrix3::from_diagonal(&Vector3::new(199.6, 507.1, 484.9)),
            },
            effects: Active::by(|_| false),
            momentum: Settings {
                grid_s: 3600.0,
                tolerance: 1e-9,
                convention: Convention::Inertial,
                policy: DumpPolicy {
                    threshold_body_n_m_s: Vector3::repeat(f64::INFINITY),
                    reinitialise: Reinitialise::Opposite { fraction: 1.0 },
                    bias_body_n_m_s: Vector3::zeros(),
                },
            },
            thruster_events: ThrusterEventSettings::default(),
        }
    }
}

impl Flights for Cruise {
    fn simulate(&self, parameters: &Parameters, times_s: &[f64]) -> Result<History, Failure> {
        let configuration = self.configuration(parameters);
        let settings = configuration.momentum;
        let (method, default_downlink) = (OrbitMethod::default(), DefaultDownlink::default());
        let prepared = PreparedSpacecraft {
            panels: &self.spacecraft.panels,
            solar: &self.solar,
            orbit_method: &method,
            default_downlink: &default_downlink,
            timeline: None,
        };
        let mut propagator = PropagatorState::default();
        let mut context = SimulationContext::new(configuration);
        let nothing = |_: f64| [ForceTorque::zero(); 2];
        let mut plant = context.plant(prepared, Turning::still(), &mut propagator, &nothing);
        let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
        let mut momentum_inertial_n_m_s = Vec::with_capacity(times_s.len());
        for time_s in times_s {
            while integrator.ends_by(*time_s) {
                let prepared = integrator.prepare(&mut plant, &settings, f64::INFINITY)?;
                integrator.advance_segment(&mut plant, &settings, &prepared)?;
            }
            momentum_inertial_n_m_s.push(integrator.totals(*time_s).momentum_inertial_n_m_s);
        }
        Ok(History { momentum_inertial_n_m_s, dumps: vec![0; times_s.len()] })
    }
}
