//! Spacecraft, orbit and light of a simulation: constant between two changes of a parameter or input.

use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};

use super::attitude_source::AttitudeSource;
use super::laws::Laws;
use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::environment::eclipse::Shadow;
use crate::environment::kepler_planet::KeplerPlanet;
use crate::environment::onboard::OnboardEphemeris;
use crate::environment::orbit::{GravityModel, NBodyGravity, TwoBodyOrbit};
use crate::environment::sun::pressure_n_m2;
use crate::guidance::timeline::TimelineSettings;
use crate::loads::Active;
use crate::momentum::Settings;
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;
use crate::numerics::scalar::Dual64;
use crate::numerics::spacing::spacing;
use crate::spacecraft::{MassProperties, Panel, Spacecraft, SunshadeModel, hinged_masses, with_panels};

use super::air_and_field_settings::{AirAndFieldSettings, PlanetFigure};
use super::panel_setting::{PanelSetting, SunAt, panel_angle_rad};
use super::thruster_events::ThrusterEventSettings;

/// Source of the positions of Sun and Earth.
#[derive(Clone, Debug, PartialEq)]
pub enum EphemerisSource {
    /// VSOP87.
    Vsop87,
    /// The planet on an ellipse about the Sun; the Earth by VSOP87.
    Kepler(KeplerPlanet),
    /// As the spacecraft carries them; beyond their span they move on evenly.
    Simulated(Arc<OnboardEphemeris>),
    /// Positions and velocities from the orbit's centre, held until they are set anew.
    Given {
        /// Sun, EME2000.
        sun: CartesianState,
        /// Earth, EME2000.
        earth: CartesianState,
    },
}

/// The body that a spacecraft is on its way to, which counts as the planet instead of the centre: its light, heat, shadow and
/// gravity gradient act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encounter {
    /// The body.
    pub body: Body,
    /// Its gravitational parameter, in m3/s2.
    pub gm_m3_s2: f64,
    /// Its radius, in m.
    pub radius_m: f64,
    /// Predictions of it.
    pub prediction: PredictionSettings,
}

/// When an encounter is predicted, how far ahead, and at which time its hyperbola osculates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictionSettings {
    /// At whole multiples of this, in s; 0: never.
    pub refresh_s: f64,
    /// So far ahead at most, in s.
    pub horizon_s: f64,
    /// Nor beyond this epoch, until which the ephemerides place all bodies, in s past J2000 TDB.
    pub last_epoch_s: f64,
    /// So long before the closest approach, in s.
    pub lead_s: f64,
}

impl PredictionSettings {
    /// Settings without predictions. Not an absent value: compiled code computes with its numbers before it asks whether it is there,
    /// which valgrind reports.
    pub(crate) const NEVER: Self = Self { refresh_s: 0.0, horizon_s: 0.0, last_epoch_s: 0.0, lead_s: 0.0 };

    /// Times of a step, before its end, at which a prediction is due, in s.
    pub(crate) fn times_s(self, step: Span) -> impl Iterator<Item = f64> {
        let is_on = self.refresh_s > 0.0;
        let numbers =
            if is_on { self.first_number(step.start_s)..self.first_number(step.end_s) } else { 0..0 };
        numbers.map(move |number| number as f64 * self.refresh_s)
    }

    /// The first multiple from `time_s` on; a time next to one counts as that: one step ends there and another begins.
    fn first_number(self, time_s: f64) -> i64 {
        ((time_s - 4.0 * spacing(time_s)) / self.refresh_s).ceil() as i64
    }

    /// Whether one is due at `time_s`.
    pub(crate) fn is_due(self, time_s: f64) -> bool {
        let next_s = self.first_number(time_s) as f64 * self.refresh_s;
        self.refresh_s > 0.0 && next_s - time_s <= 4.0 * spacing(time_s)
    }
}

/// Motion of the spacecraft's centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// The centre's gravity alone: the orbit in closed form.
    TwoBody,
    /// The same orbit at the start, then integrated.
    Disturbed {
        /// Gravity of the centre with its flattening, and tides.
        gravity: GravityModel,
        /// Length of the integrator's segments, in s.
        segment_length_s: f64,
        /// Radius of the centre, in m: a flight below it ends.
        radius_m: f64,
        /// Whether light, heat and external forces accelerate the spacecraft.
        feedback: bool,
    },
    /// The same, integrated between Sun, planets and Moon.
    NBody {
        /// Their gravity.
        gravity: NBodyGravity,
        /// Whether light, heat and external forces accelerate the spacecraft.
        feedback: bool,
    },
    /// No propagation: position and velocity about the centre are held, EME2000.
    Held {
        /// Position and velocity.
        state: CartesianState,
        /// When they were given, in s past J2000 TDB.
        since_epoch_s: f64,
    },
}

impl Motion {
    /// Gravity of an integrated orbit.
    pub(crate) fn gravity(&self) -> Option<&GravityModel> {
        match self {
            Self::Disturbed { gravity, .. } => Some(gravity),
            Self::NBody { gravity, .. } => Some(&gravity.model),
            Self::TwoBody | Self::Held { .. } => None,
        }
    }

    /// Whether light, heat and external forces accelerate the spacecraft.
    pub fn has_nongravitational_forces(&self) -> bool {
        matches!(self, Self::Disturbed { feedback: true, .. } | Self::NBody { feedback: true, .. })
    }

    /// Whether the acceleration by light and heat over a segment is as good as the orbit is to be, in m/s2; one about a single body has
    /// no tolerance.
    pub(crate) fn resolves<const N: usize>(&self, acceleration_m_s2: &Segment<3, N>) -> bool {
        match self {
            Self::NBody { gravity, .. } => gravity.resolves(acceleration_m_s2),
            Self::TwoBody | Self::Disturbed { .. } | Self::Held { .. } => true,
        }
    }
}

/// Sunlight: its pressure, and what of it acts as force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunLight {
    /// Source of the light, which planet and surfaces reflect and absorb too.
    pub source: LightSource,
    /// Factor of force and torque of direct sunlight; heat follows from the source alone.
    pub scale: f64,
}

impl SunLight {
    /// Pressure by which direct sunlight acts, at a distance from the Sun's centre, in Pa; NaN where there is no such distance.
    pub fn pressure_pa(&self, distance_m: f64) -> f64 {
        self.source.pressure_pa(distance_m) * self.scale
    }
}

/// Radiation pressure of sunlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightSource {
    /// The same everywhere, in Pa.
    Fixed {
        /// Pressure, in Pa.
        pressure_pa: f64,
    },
    /// Falling with the square of the distance.
    Distance {
        /// Flux at 1 AU, in W/m2.
        flux_w_m2: f64,
    },
}

impl LightSource {
    /// Pressure at a distance from the Sun's centre, in Pa; NaN where there is no such distance.
    pub fn pressure_pa(&self, distance_m: f64) -> f64 {
        match *self {
            Self::Fixed { pressure_pa } => pressure_pa,
            Self::Distance { flux_w_m2 } => pressure_n_m2(flux_w_m2, distance_m).unwrap_or(f64::NAN),
        }
    }
}

impl Configuration {
    /// Becomes another one; allocates nothing where it has as many panels.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        let mut panels = core::mem::take(&mut self.panels);
        panels.clone_from(&other.panels);
        let (ephemeris, thruster_events) = (other.ephemeris.clone(), other.thruster_events.clone());
        *self = Self { panels, ephemeris, thruster_events, ..*other };
    }

    /// The planet, if there is one: the encounter's body, else the centre.
    pub fn planet(&self) -> Option<Body> {
        let center = Some(self.center).filter(|body| body.is_planet());
        self.encounter.map(|encounter| encounter.body).or(center)
    }

    /// Gravitational parameter of that planet, in m3/s2.
    pub(crate) fn planet_gm_m3_s2(&self) -> f64 {
        self.encounter.map_or(self.orbit.mu_m3_s2(), |encounter| encounter.gm_m3_s2)
    }

    /// Whether forces in simulated attitude perturb the orbit by Encke's method, interval by interval; the long segments of n-body motion
    /// are integrated again with the forces instead.
    pub(crate) fn uses_encke(&self) -> bool {
        matches!(self.attitude, AttitudeSource::Dynamic(_))
            && matches!(self.motion, Motion::Disturbed { feedback: true, .. })
    }

    /// Whether there is more of light and heat than sunlight that nothing shadows.
    pub fn has_light_and_heat(&self) -> bool {
        self.light_and_heat.shadowing || self.effects.light().any(|effect| effect.row().switch.is_some())
    }

    /// Indices of the enabled panels, and the spacecraft with those alone.
    pub(crate) fn enabled_panels(&self, spacecraft: &Spacecraft) -> (Vec<usize>, Spacecraft) {
        let is_enabled = |index: &usize| self.panels.get(*index) != Some(&PanelSetting::Disabled);
        let panels: Vec<usize> = (0..spacecraft.panels.len()).filter(is_enabled).collect();
        let mut simulated = spacecraft.clone();
        simulated.panels = panels.iter().map(|&index| spacecraft.panels[index].clone()).collect();
        (panels, simulated)
    }

    /// Writes the angles in rad of these panels for this position of the Sun.
    pub(crate) fn panel_angles_rad(
        &self,
        panels: &[Panel],
        enabled_panels: &[usize],
        sun: &SunAt,
        angles_rad: &mut [f64],
    ) {
        for (angle_rad, &index) in angles_rad.iter_mut().zip(enabled_panels) {
            *angle_rad = panel_angle_rad(&self.panels, panels, index, sun);
        }
    }

    /// Mass, centre of mass and inertia of a body that has `at_zero`, as the panels stand with the Sun there.
    pub fn mass_properties(&self, at_zero: &MassProperties, panels: &[Panel], sun: &SunAt) -> MassProperties {
        with_panels(at_zero, panels, |index| panel_angle_rad(&self.panels, panels, index, sun))
    }

    /// The first time after `time_s` at which a panel goes elsewhere at once, in s; infinite where none does.
    pub fn panels_until_s(&self, time_s: f64) -> f64 {
        self.panels.iter().map(|setting| setting.until_s(time_s)).fold(f64::INFINITY, f64::min)
    }

    /// The last time up to `end_s` at which the panels stand by the laws of `start_s`, in s.
    pub(crate) fn last_of_panels_s(&self, start_s: f64, end_s: f64) -> f64 {
        let until_s = self.panels_until_s(start_s);
        if until_s <= end_s { until_s.next_down() } else { end_s }
    }

    /// Momentum of the panels relative to the body in N m s, body frame, as they turn about the centre of `mass` with the Sun
    /// moving like that.
    pub fn panel_momentum_body_n_m_s(
        &self,
        panels: &[Panel],
        mass: &MassProperties,
        sun: &SunAt<Dual64>,
    ) -> Vector3<f64> {
        let turn = |index: usize| {
            let setting = self.panels.get(index);
            let [angle_rad, rate_rad_s] = setting.map_or([0.0; 2], |it| it.turn_rad(&panels[index], sun));
            [angle_rad, rate_rad_s, 0.0]
        };
        let center = &mass.center_of_mass_body_m;
        hinged_masses(panels, turn).map(|it| it.momentum_body_n_m_s(center)).sum()
    }
}

/// Everything a flight needs besides the spacecraft itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Epoch (s past J2000 TDB) minus time, in s.
    pub epoch_minus_time_s: f64,
    /// Central body.
    pub center: Body,
    /// Another body that counts as the planet, if one does.
    pub encounter: Option<Encounter>,
    /// Its radius, in m.
    pub center_radius_m: f64,
    /// Components in the frame of the orbit's elements to components in EME2000.
    pub eme2000_from_orbit_frame: Matrix3<f64>,
    /// Orbit about it, in EME2000, by epoch; of an integrated orbit the one it starts on.
    pub orbit: TwoBodyOrbit,
    /// Motion along that orbit or off it.
    pub motion: Motion,
    /// Sun and Earth.
    pub ephemeris: EphemerisSource,
    /// Figure and rotation of the planet, if there is one.
    pub figure: Option<PlanetFigure>,
    /// Air and magnetic field about it, where one of them acts.
    pub air_and_field: Option<AirAndFieldSettings>,
    /// Sunlight.
    pub light: SunLight,
    /// Shadow of the planet.
    pub shadow: Shadow,
    /// Light and heat beyond direct sunlight.
    pub light_and_heat: RadiationSettings,
    /// Attitude.
    pub attitude: AttitudeSource,
    /// Settings of the timeline; `None`: no timeline is followed.
    pub timeline: Option<TimelineSettings>,
    /// Model of the shade.
    pub sunshade: SunshadeModel,
    /// One setting a panel.
    pub panels: Vec<PanelSetting>,
    /// Mass, centre of mass and inertia with every panel at angle 0 and full tanks.
    pub wet_mass: MassProperties,
    /// Effects that act.
    pub effects: Active,
    /// Parameters of effects in closed form.
    pub laws: Laws,
    /// Integration of momentum.
    pub momentum: Settings,
    /// Settings of thruster events, and the scheduled ones.
    pub thruster_events: ThrusterEventSettings,
}

/// Parts of the light and heat that are computed, and their resolution in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiationSettings {
    /// Whether surfaces with a heat capacity store heat; otherwise all are in balance with their light.
    pub storage: bool,
    /// Whether surfaces given as polygons shadow one another from the Sun.
    pub shadowing: bool,
    /// Whether the Sun's disc softens those shadows.
    pub sun_disc: bool,
    /// Segments of light and heat end at multiples of this, in s.
    pub grid_s: f64,
    /// Largest last Chebyshev term of a segment relative to the largest force and torque in it.
    pub tolerance: f64,
}
