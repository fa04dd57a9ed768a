//! Kinematics of the plant: one pass from trajectory and ephemeris to an instant, and up to when its law holds.
//!
//! The one pass of a Sun direction: trajectory and ephemeris give positions in EME2000 ([`Geometry`]), the attitude law turns
//! their directions into a body frame, the frame turns them into the body, and the planet's disc takes its part of the
//! Sun's. Momentum, light and outputs all read this.

use crate::attitude::angle_between_rad;
use crate::environment::CartesianState;
use crate::environment::orbit::TwoBodyOrbit;
use crate::guidance::pointing::boresight::Gimbal;
use crate::guidance::{Activity, ArcPoint, Guided, GuidedAttitude, ScienceArc};
use crate::math;
use crate::momentum::{EventValues, WorkKind, after_event_s};
use crate::numerics::chebyshev::Segment;
use crate::numerics::events::first_event;
use crate::numerics::intervals::{first_change_s, sampled_range};
use crate::numerics::spacing::spacing;
use crate::spacecraft::MassProperties;

use nalgebra::{Rotation3, Vector3};

use super::air_and_field_segment::{AirAndField, AirAndFieldSegment};
use super::at_time::{Instant, without_windows};
use super::geometry::{Geometry, SimulationEphemeris};
use super::guided_law::GuidedLaw;
use crate::plant::motion::command_slews::CommandSlews;
use crate::plant::motion::panel_motion::PanelLaws;
use crate::plant::motion::trajectory::Trajectory;
use crate::plant::settings::attitude_source::{AttitudeSource, Turning};
use crate::plant::settings::configuration::{Configuration, Motion};
use crate::plant::settings::digest::Digest;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::panel_setting::SunAt;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::plant::settings::work::Work;

/// Nodes at which a span is looked through for events.
const NODES: usize = 8;
/// The end of a window or slew, computed in epochs, is this near its number in flight time, in s.
const EPOCH_ROUNDING_S: f64 = 1e-6;

/// Motion and light of a configured flight, air and field along it as far as they are known, and the work that is done for it.
pub(crate) struct Kinematics<'a> {
    /// Digest of the settings on which loads depend: a fit made for another one is cut.
    pub digest: Digest,
    pub configuration: &'a Configuration,
    /// The configuration's guidance, with the selected directions of the Sun.
    pub law: Option<Guided>,
    /// Attitude and rate of a body that turns by torque.
    pub turning: Turning,
    pub trajectory: &'a mut Trajectory,
    pub bodies: SimulationEphemeris<'a>,
    /// The spacecraft.
    pub spacecraft: PreparedSpacecraft<'a>,
    /// Slews into the timeline's commands.
    pub command_slews: &'a mut CommandSlews,
    /// Work of the step so far.
    pub work: &'a mut Work,
    /// With every panel at angle 0, of what is left of the propellant.
    pub current_mass_panels_stowed: MassProperties,
    /// Air and field along the orbit.
    pub air_and_field: &'a mut AirAndFieldSegment,
}

impl Kinematics<'_> {
    /// Counts work, the flight having come to `time_s`.
    pub(crate) fn spend_units(&mut self, cost: WorkKind, units: u32, time_s: f64) -> Result<(), PlantError> {
        Ok(self.work.spend(cost, units, self.bodies.ephemeris.evaluations(), time_s)?)
    }

    /// Mass, centre of mass and inertia as the panels stand with the Sun there.
    pub(crate) fn mass_properties(&self, sun: &SunAt) -> MassProperties {
        self.configuration.mass_properties(&self.current_mass_panels_stowed, self.spacecraft.panels, sun)
    }

    /// Air and magnetic field at `time_s`, up to which they are known.
    pub(crate) fn air_and_field(&self, time_s: f64) -> AirAndField {
        self.air_and_field.at(self.configuration.air_and_field.as_ref(), time_s)
    }

    /// The panels, by their laws.
    pub(crate) fn panel_laws(&self) -> PanelLaws<'_> {
        let (settings, panels) = (&self.configuration.panels, self.spacecraft.panels);
        PanelLaws { settings, panels, stowed: &self.current_mass_panels_stowed }
    }

    /// The event functions alone, counted as a search.
    pub(crate) fn events(&mut self, time_s: f64) -> EventValues {
        self.work.note_search(false);
        self.instant(time_s).events
    }

    /// Matrix that takes body components to EME2000 alone, by which a dump is sought and for which it counts.
    pub(crate) fn inertial_from_body(&mut self, time_s: f64) -> Rotation3<f64> {
        self.work.note_search(true);
        let geometry = self.geometry(time_s);
        self.attitude(time_s, &geometry).frame.inertial_from_body
    }

    /// Resolution of `time_s`, in s: everything is constant over less.
    pub(crate) fn time_rounding_s(&self, time_s: f64) -> f64 {
        spacing(time_s).max(spacing(time_s + self.configuration.epoch_minus_time_s))
    }

    /// Everything but the loads at `time_s`.
    pub(crate) fn instant(&mut self, time_s: f64) -> Instant {
        let geometry = self.geometry(time_s);
        let law = self.attitude(time_s, &geometry);
        let (lit_fraction, gaps_rad) = match geometry.to_planet {
            None => (1.0, [f64::INFINITY; 2]),
            Some(to_planet) => {
                let spacecraft_m = -to_planet.position_m;
                let sun_m = spacecraft_m + geometry.to_sun.position_m;
                self.configuration.shadow.fraction_and_gaps(&spacecraft_m, &sun_m)
            }
        };
        let to_body = law.frame.inertial_from_body.inverse();
        let sun_distance_m = geometry.to_sun.position_m.norm();
        Instant {
            time_s,
            to_body,
            sun_body: to_body * (geometry.to_sun.position_m / sun_distance_m),
            sun_distance_m,
            planet_body_m: geometry.to_planet.map(|planet| to_body * planet.position_m),
            geometry,
            law,
            lit_fraction,
            events: EventValues::new(gaps_rad[0], gaps_rad[1], law.margins[0], law.margins[1]),
        }
    }

    /// The spacecraft about the planet, or about the centre where no planet is, at `time_s`.
    pub(crate) fn about_planet(&mut self, time_s: f64) -> CartesianState {
        let spacecraft = self.trajectory.state_at(self.configuration, time_s);
        let elsewhere = self.configuration.planet().filter(|planet| *planet != self.configuration.center);
        let Some(planet) = elsewhere else { return spacecraft };
        spacecraft - self.bodies.body(planet, time_s)
    }

    /// Geometry, attitude and regime at `time_s`.
    pub(crate) fn geometry(&mut self, time_s: f64) -> Geometry {
        let spacecraft = self.trajectory.state_at(self.configuration, time_s);
        self.bodies.geometry(time_s, spacecraft)
    }

    /// Body frame and rate, window and margins of the attitude law.
    fn attitude(&mut self, time_s: f64, geometry: &Geometry) -> GuidedAttitude {
        match (&self.configuration.attitude, self.law) {
            (AttitudeSource::Guided(_), Some(law)) => self.guided(&law, time_s, geometry),
            (AttitudeSource::Commanded(command), _) => without_windows(command.frame_at(time_s)),
            _ => without_windows(self.turning.frame_at(time_s)),
        }
    }

    /// Attitude that this guidance commands at `time_s`.
    fn guided(&mut self, guided: &Guided, time_s: f64, geometry: &Geometry) -> GuidedAttitude {
        let mut law = GuidedLaw {
            trajectory: self.trajectory,
            bodies: &mut self.bodies,
            spacecraft: self.spacecraft,
            command_slews: self.command_slews,
            guided,
        };
        law.attitude(time_s, geometry)
    }

    /// Attitude that guidance commands at `time_s`; `None` without guidance.
    pub(crate) fn guided_attitude(&mut self, time_s: f64) -> Option<GuidedAttitude> {
        self.law.map(|law| self.attitude_by(&law, time_s))
    }

    /// Attitude that this guidance commands at `time_s`.
    pub(crate) fn attitude_by(&mut self, law: &Guided, time_s: f64) -> GuidedAttitude {
        let geometry = self.geometry(time_s);
        self.guided(law, time_s, &geometry)
    }

    /// Least and greatest angle between Sun and Earth from one time to a later one, in rad, the spacecraft continuing along the
    /// ellipse that it is on.
    pub(crate) fn separations_rad(&mut self, from_s: f64, to_s: f64) -> [f64; 2] {
        let mut ahead = self.geometry_ahead(from_s);
        sampled_range(|share| {
            let geometry = ahead(from_s + (to_s - from_s) * share);
            angle_between_rad(&geometry.to_sun.position_m, &geometry.to_earth.position_m)
        })
    }

    /// Sun and planet from one time to a later one, likewise.
    pub(crate) fn science_arc(&mut self, gimbal: Gimbal, from_s: f64, to_s: f64) -> ScienceArc {
        let light = self.configuration.light;
        let mut ahead = self.geometry_ahead(from_s);
        ScienceArc::new(gimbal, to_s - from_s, |share| {
            let geometry = ahead(from_s + (to_s - from_s) * share);
            let to_sun_m = geometry.to_sun.position_m;
            ArcPoint {
                to_sun_m,
                to_planet_m: geometry.to_planet.map_or(Vector3::zeros(), |planet| planet.position_m),
                pressure_pa: light.pressure_pa(to_sun_m.norm()),
            }
        })
    }

    /// Returns the geometry at times after `from_s`, the spacecraft on the ellipse that osculates there.
    fn geometry_ahead(&mut self, from_s: f64) -> impl FnMut(f64) -> Geometry {
        let configuration = self.configuration;
        let now = self.trajectory.state_at(configuration, from_s);
        let from_epoch_s = from_s + configuration.epoch_minus_time_s;
        let ellipse = match configuration.motion {
            Motion::TwoBody => Some(*self.trajectory.two_body(configuration)),
            Motion::Disturbed { gravity, .. } => {
                TwoBodyOrbit::from_state(&now, gravity.gm_m3_s2(gravity.center), from_epoch_s).ok()
            }
            Motion::NBody { .. } => {
                let gm_m3_s2 = configuration.orbit.mu_m3_s2();
                TwoBodyOrbit::from_state(&now, gm_m3_s2, from_epoch_s).ok()
            }
            Motion::Held { .. } => None,
        };
        let bodies = &mut self.bodies;
        move |at_s| {
            let at_epoch_s = at_s + configuration.epoch_minus_time_s;
            let spacecraft = ellipse.map_or(now, |ellipse| ellipse.state_at(at_epoch_s));
            bodies.geometry(at_s, spacecraft)
        }
    }

    /// The number at which the window or slew of `instant` ends or a panel goes elsewhere at once, if that is before
    /// `limit_s`.
    pub(crate) fn laws_until_s(&mut self, instant: &Instant, limit_s: f64) -> f64 {
        let time_s = instant.time_s;
        let limit_s = limit_s.min(self.configuration.panels_until_s(time_s));
        let until_s = instant.law.until_s - self.configuration.epoch_minus_time_s;
        let epoch_s = until_s + self.configuration.epoch_minus_time_s;
        let rounding_s = EPOCH_ROUNDING_S + 4.0 * (spacing(epoch_s) + spacing(until_s));
        let (before_s, behind_s) = ((until_s - rounding_s).max(time_s), until_s + rounding_s);
        if before_s >= limit_s || behind_s.is_nan() {
            return limit_s;
        }
        let form = |it: &GuidedAttitude| {
            (it.window.since_s, it.window.activity == Activity::Downlink, it.slewing, it.corner_s)
        };
        let same = |it: &mut Self, at_s: f64| {
            let geometry = it.geometry(at_s);
            form(&it.attitude(at_s, &geometry)) == form(&instant.law)
        };
        if same(self, behind_s) {
            return limit_s;
        }
        first_change_s(before_s, behind_s, |at_s| same(self, at_s)).min(limit_s)
    }

    /// Whether a bound of their rates excludes a root of the shadow's gaps within `span_s` of `instant`; never with margins of an attitude law.
    pub(crate) fn excludes_events(&self, instant: &Instant, span_s: f64) -> bool {
        let Geometry { to_planet, to_sun, .. } = &instant.geometry;
        let [outer_rad, inner_rad, first_margin, second_margin] = instant.events.into();
        if first_margin != f64::INFINITY || second_margin != f64::INFINITY {
            return false;
        }
        let Some(to_planet) = to_planet else {
            return outer_rad == f64::INFINITY && inner_rad == f64::INFINITY;
        };
        let Configuration { shadow, .. } = self.configuration;
        // Twice the gravity at the surface bounds the acceleration.
        let gm_m3_s2 = self.configuration.planet_gm_m3_s2();
        let gained_m_s = 2.0 * gm_m3_s2 / math::powi(shadow.planet_radius_m(), 2) * span_s;
        let bound = |to: &CartesianState| {
            let speed_m_s = to.velocity_m_s.norm() + gained_m_s;
            [to.position_m.norm() - speed_m_s * span_s, speed_m_s]
        };
        let (planet, sun) = (bound(to_planet), bound(to_sun));
        let most_rad = shadow.greatest_gap_rate_rad_s(planet, sun) * span_s;
        // False for NaN.
        planet[0] > 0.0 && sun[0] > 0.0 && outer_rad.abs().min(inner_rad.abs()) > most_rad
    }

    /// The latest time up to `limit_s` until which attitude and light are smooth from `start_s` on.
    pub(crate) fn smooth_until(&mut self, start_s: f64, limit_s: f64) -> f64 {
        // The edge this span starts at was found on an orbit that has been computed anew since.
        let after_s = after_event_s(start_s).min(limit_s);
        let first = self.instant(after_s);
        // Where a panel goes elsewhere is known to the number, however soon that is.
        let limit_s = limit_s.min(self.configuration.panels_until_s(start_s));
        let limit_s = self.laws_until_s(&first, limit_s);
        let samples = Segment::<4, NODES>::nodes(start_s, limit_s).map(|at_s| self.instant(at_s).events);
        let rounding_s = self.time_rounding_s(limit_s);
        first_event([after_s, start_s, limit_s], rounding_s, &samples, |at_s| self.events(at_s))
            .unwrap_or(limit_s)
    }
}
