//! Kinematics of the plant: one pass from trajectory and ephemeris to an instant, and up to when its law holds.
//!
//! The one pass of a Sun direction: trajectory and ephemeris give positions in EME2000 ([`Geometry`]), the attitude law turns
//! their directions into a body frame, the frame turns them into the body, and the planet's disc takes its part of the
//! Sun's. Momentum, light and outputs all read this.

use crate::attitude::{MovingFrame, angle_between_rad};
use crate::environment::CartesianState;
use crate::environment::ephemeris::Ephemeris;
use crate::environment::orbit::TwoBodyOrbit;
use crate::guidance::constraints::command_slew::{CommandSlew, SlewedFrame};
use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::constraints::slew::Slew;
use crate::guidance::downlink::default_downlink::DefaultDownlink;
use crate::guidance::downlink::sun_direction::SunRequest;
use crate::guidance::pointing::boresight::Gimbal;
use crate::guidance::pointing::command::Scenario;
use crate::guidance::timeline::{
    Slot, TimelineAttitude, TimelineEntry, TimelineLaw, TimelineSettings, bodies_of,
};
use crate::guidance::{
    Activity, ArcPoint, DownlinkStatus, DownlinkSunDirection, Guided, GuidedAttitude, ScienceArc, Sight,
    TargetPlanet, Window,
};
use crate::math;
use crate::momentum::{EventValues, after_event_s};
use crate::numerics::chebyshev::Segment;
use crate::numerics::events::first_event;
use crate::numerics::intervals::{first_change_s, sampled_range};
use crate::numerics::spacing::spacing;
use crate::spacecraft::{MassProperties, Panel};

use nalgebra::{Rotation3, Vector3};

use super::command_slews::CommandSlews;
use super::geometry::{self, Geometry, GeometrySight, SimulationEphemeris};
use super::instant::{Instant, Regime};
use super::trajectory::Trajectory;
use crate::momentum::WorkKind;
use crate::plant::settings::attitude_source::{AttitudeSource, Turning};
use crate::plant::settings::configuration::{Configuration, Motion};
use crate::plant::settings::error::PlantError;
use crate::plant::settings::panel_setting::SunAt;
use crate::plant::settings::work::Work;

/// Nodes at which a span is looked through for events.
const NODES: usize = 8;
/// The end of a window or slew, computed in epochs, is this near its number in flight time, in s.
const EPOCH_ROUNDING_S: f64 = 1e-6;

/// Body frame, window and margins of the attitude law.
struct LawAt {
    frame: MovingFrame,
    regime: Regime,
    status: DownlinkStatus,
    degenerate: bool,
    margins: [f64; 2],
    until_s: f64,
}

/// The keep-in zone of the orbit phase's own guidance under a command of the timeline.
fn keep_in_of_orbit_phase(guided: &Guided, entry: Option<&TimelineEntry>) -> Option<KeepIn> {
    match (entry, guided.keep_in) {
        (Some(entry), Some(zone)) => entry.keep_in.applied(&zone, true),
        (_, zone) => zone,
    }
}

/// Returns the geometry at `time_s`; a law reads motions about `planet` from it as well, or directions alone.
fn sight(
    configuration: &Configuration,
    ephemeris: &mut Ephemeris,
    time_s: f64,
    geometry: Geometry,
    planet: Option<TargetPlanet>,
) -> GeometrySight {
    let motion = planet.map(|planet| {
        let bodies = &mut SimulationEphemeris { configuration, ephemeris };
        let gravity = bodies.gravity_m_s2(time_s, &geometry.spacecraft);
        (TargetPlanet { gm_m3_s2: configuration.orbit.mu_m3_s2(), ..planet }, gravity)
    });
    GeometrySight { geometry, epoch_s: time_s + configuration.epoch_minus_time_s, motion }
}

/// Motion and light of a configured flight, and the work that is done for it.
pub(crate) struct Kinematics<'a> {
    pub configuration: &'a Configuration,
    /// The configuration's guidance, with the selected directions of the Sun.
    pub law: Option<Guided>,
    /// How the body turns where it turns by torque.
    pub turning: Turning,
    pub trajectory: &'a mut Trajectory,
    pub ephemeris: &'a mut Ephemeris,
    /// The default downlink of the spacecraft's antennas.
    pub default_downlink: &'a DefaultDownlink,
    /// Commands over time.
    pub timeline: Option<TimelineLaw<'a>>,
    /// Slews into them.
    pub command_slews: &'a mut CommandSlews,
    /// Work of the step so far.
    pub work: &'a mut Work,
    /// With every panel at angle 0, of what is left of the propellant.
    pub current_mass_panels_stowed: MassProperties,
}

impl Kinematics<'_> {
    /// Counts work, the flight having come to `time_s`.
    pub(crate) fn spend_units(&mut self, cost: WorkKind, units: u32, time_s: f64) -> Result<(), PlantError> {
        Ok(self.work.spend(cost, units, self.ephemeris.evaluations(), time_s)?)
    }

    /// Mass, centre of mass and inertia as the panels stand with the Sun there.
    pub(crate) fn mass_properties(&self, panels: &[Panel], sun: &SunAt) -> MassProperties {
        self.configuration.mass_properties(&self.current_mass_panels_stowed, panels, sun)
    }

    /// The event functions alone, counted as a search.
    pub(crate) fn events(&mut self, time_s: f64) -> EventValues {
        self.work.note_search();
        self.instant(time_s).events
    }

    /// Matrix that takes body components to EME2000 alone, by which a dump is sought and for which it counts.
    pub(crate) fn inertial_from_body(&mut self, time_s: f64) -> Rotation3<f64> {
        self.work.note_dump_search();
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
        let (lit_fraction, gaps_rad) = self.light_fraction(&geometry);
        let to_body = law.frame.inertial_from_body.inverse();
        let sun_distance_m = geometry.to_sun.position_m.norm();
        Instant {
            to_body,
            sun_body: to_body * (geometry.to_sun.position_m / sun_distance_m),
            sun_distance_m,
            planet_body_m: geometry.to_planet.map(|planet| to_body * planet.position_m),
            geometry,
            frame: law.frame,
            lit_fraction,
            regime: Regime { in_shadow: gaps_rad[0] <= 0.0, ..law.regime },
            events: EventValues::new(gaps_rad[0], gaps_rad[1], law.margins[0], law.margins[1]),
            downlink: law.status,
            is_degenerate: law.degenerate,
            attitude_until_s: law.until_s,
        }
    }

    /// Visible part of the Sun's disc and the gaps of the shadow.
    fn light_fraction(&self, geometry: &Geometry) -> (f64, [f64; 2]) {
        let Some(to_planet) = geometry.to_planet else { return (1.0, [f64::INFINITY; 2]) };
        let spacecraft_m = -to_planet.position_m;
        let sun_m = spacecraft_m + geometry.to_sun.position_m;
        self.configuration.shadow.fraction_and_gaps(&spacecraft_m, &sun_m)
    }

    /// The spacecraft about the planet, or about the centre where no planet is, at `time_s`.
    pub(crate) fn about_planet(&mut self, time_s: f64) -> CartesianState {
        let spacecraft = self.trajectory.state_at(self.configuration, time_s);
        let elsewhere = self.configuration.planet().filter(|planet| *planet != self.configuration.center);
        let Some(planet) = elsewhere else { return spacecraft };
        let epoch_s = time_s + self.configuration.epoch_minus_time_s;
        spacecraft - geometry::body(self.configuration, self.ephemeris, planet, epoch_s)
    }

    /// Geometry, attitude and regime at `time_s`.
    fn geometry(&mut self, time_s: f64) -> Geometry {
        let spacecraft = self.trajectory.state_at(self.configuration, time_s);
        Geometry::at(self.configuration, self.ephemeris, time_s, spacecraft)
    }

    /// Body frame and rate, and the form of the law they come from.
    fn attitude(&mut self, time_s: f64, geometry: &Geometry) -> LawAt {
        let held = |frame: MovingFrame| LawAt {
            frame,
            regime: Regime::UNCHANGING,
            status: DownlinkStatus::default(),
            degenerate: false,
            margins: [f64::INFINITY; 2],
            until_s: f64::INFINITY,
        };
        match (&self.configuration.attitude, self.law) {
            (AttitudeSource::Guided(_), Some(law)) => {
                let guided = self.guided(&law, time_s, geometry);
                LawAt {
                    frame: guided.frame,
                    regime: Regime {
                        window_since_s: guided.window.since_s,
                        downlink: guided.window.activity == Activity::Downlink,
                        row: guided.row,
                        slewing: guided.slewing,
                        corner_s: guided.corner_s,
                        in_shadow: false,
                    },
                    status: DownlinkStatus::from_attitude(&guided),
                    degenerate: guided.degenerate,
                    margins: guided.margins,
                    until_s: guided.until_s - self.configuration.epoch_minus_time_s,
                }
            }
            (AttitudeSource::Commanded(command), _) => held(command.frame_at(time_s)),
            _ => held(self.turning.frame_at(time_s)),
        }
    }

    /// Attitude that the timeline commands at `time_s`, else the orbit phase's own guidance.
    fn guided(&mut self, guided: &Guided, time_s: f64, geometry: &Geometry) -> GuidedAttitude {
        let distance_m = geometry.to_sun.position_m.norm();
        let Some((law, settings)) = self.timeline.zip(self.configuration.timeline) else {
            let (requested, cut) = guided.requested.at_distance(distance_m);
            let own = self.by_orbit_phase(&Guided { requested, ..*guided }, time_s, geometry);
            return GuidedAttitude { clamped: own.clamped || cut, ..own };
        };
        let slot = law.timeline.slot(time_s, settings.clock_minus_time_s);
        let target = self.by_slot(guided, (&law, &settings, &slot), time_s, geometry);
        // NaN is no rate.
        if !(guided.slew_rate_rad_s > 0.0 && self.command_slews.lead_into(slot.since_s)) {
            return target;
        }
        let slew = self.command_slew(guided, (&law, &settings, &slot), time_s, (geometry, &target));
        self.slewed(guided, slew.as_ref(), time_s, (geometry, target))
    }

    /// Attitude during the slew into a command.
    fn slewed(
        &self,
        guided: &Guided,
        slew: Option<&CommandSlew>,
        time_s: f64,
        (geometry, target): (&Geometry, GuidedAttitude),
    ) -> GuidedAttitude {
        let sun = geometry.lines_of_sight().sun;
        let slewed = slew.and_then(|slew| slew.at(time_s, &target.frame, &sun, guided.slew_rate_rad_s));
        slewed.map_or(target, |SlewedFrame { frame, end_s }| {
            let end_epoch_s = end_s + self.configuration.epoch_minus_time_s;
            GuidedAttitude { frame, slewing: true, until_s: target.until_s.min(end_epoch_s), ..target }
        })
    }

    /// The slew into the command of a slot, from the attitude in which the body stands where it begins: of an attitude that dynamics
    /// follow at the first sample of it, otherwise at its edge.
    fn command_slew(
        &mut self,
        guided: &Guided,
        (law, settings, slot): (&TimelineLaw<'_>, &TimelineSettings, &Slot<'_>),
        time_s: f64,
        (geometry, target): (&Geometry, &GuidedAttitude),
    ) -> Option<CommandSlew> {
        let found = self.command_slews.find(slot.since_s);
        if let Some(slew) = found.filter(|slew| !slew.is_open()) {
            return Some(slew);
        }
        let zone = self.slew_zone(guided, settings, slot, geometry);
        let longest_s = Slew::longest_rad(zone.as_ref()) / guided.slew_rate_rad_s;
        if found.is_none() && time_s - slot.since_s > longest_s {
            return None;
        }
        let is_sampled = matches!(self.configuration.attitude, AttitudeSource::Dynamic(_));
        let begin_s = found.map_or(if is_sampled { time_s } else { slot.since_s }, |slew| slew.begin_s);
        let (geometry, target) = match begin_s == time_s {
            true => (*geometry, *target),
            false => {
                let geometry = self.geometry(begin_s);
                (geometry, self.by_slot(guided, (law, settings, slot), begin_s, &geometry))
            }
        };
        let mut slew = found.unwrap_or_else(|| {
            let before = law.timeline.slot_before(slot.since_s, settings.clock_minus_time_s);
            let last = self.by_slot(guided, (law, settings, &before), begin_s, &geometry);
            let from = self.command_slews.find(before.since_s);
            let stood = self.slewed(guided, from.as_ref(), begin_s, (&geometry, last));
            CommandSlew::new(begin_s, &stood.frame)
        });
        let sun = geometry.lines_of_sight().sun;
        let zone = self.slew_zone(guided, settings, slot, &geometry);
        slew.aim(&target.frame, &sun, zone.as_ref(), guided.slew_rate_rad_s);
        self.command_slews.keep(slot.since_s, slew);
        Some(slew)
    }

    /// The zone that a slew into the command of a slot does not leave where it holds both ends.
    fn slew_zone(
        &self,
        guided: &Guided,
        settings: &TimelineSettings,
        slot: &Slot<'_>,
        geometry: &Geometry,
    ) -> Option<KeepIn> {
        match slot.entry {
            Some(entry) if slot.scenario().is_some() => {
                settings.keep_in(entry, geometry.to_sun.position_m.norm())
            }
            entry => keep_in_of_orbit_phase(guided, entry),
        }
    }

    /// Attitude that a slot of the timeline commands at `time_s`, without the slew into it.
    fn by_slot(
        &mut self,
        guided: &Guided,
        (law, settings, slot): (&TimelineLaw<'_>, &TimelineSettings, &Slot<'_>),
        time_s: f64,
        geometry: &Geometry,
    ) -> GuidedAttitude {
        let epoch_minus_time_s = self.configuration.epoch_minus_time_s;
        let [since_s, until_s] = [slot.since_s, slot.until_s].map(|it| it + epoch_minus_time_s);
        let requested = slot.sun_request(guided.requested);
        let commanded = slot.entry.filter(|_| slot.scenario().is_some());
        if let Some(entry) = commanded
            && let Some(found) =
                self.commanded((law, settings, entry), time_s, geometry, (guided.sun_direction, requested))
        {
            let activity = match slot.scenario() {
                Some(Scenario::Downlink) => Activity::Downlink,
                _ => Activity::Science,
            };
            return GuidedAttitude {
                frame: found.frame,
                window: Window { activity, since_s, until_s },
                row: slot.row,
                slewing: false,
                margins: found.margins,
                clamped: found.clamped,
                degenerate: found.degenerate,
                corner_s: found.corner_s + epoch_minus_time_s,
                until_s: until_s.min(found.corner_s + epoch_minus_time_s),
            };
        }
        let keep_in = keep_in_of_orbit_phase(guided, slot.entry);
        let (requested, cut) = requested.at_distance(geometry.to_sun.position_m.norm());
        let own = self.by_orbit_phase(&Guided { requested, keep_in, ..*guided }, time_s, geometry);
        let window = Window {
            since_s: own.window.since_s.max(since_s),
            until_s: own.window.until_s.min(until_s),
            ..own.window
        };
        GuidedAttitude { window, clamped: own.clamped || cut, until_s: own.until_s.min(until_s), ..own }
    }

    /// The attitude of a command of the timeline.
    fn commanded(
        &mut self,
        (law, settings, entry): (&TimelineLaw<'_>, &TimelineSettings, &TimelineEntry),
        time_s: f64,
        geometry: &Geometry,
        sun: (Option<DownlinkSunDirection>, SunRequest),
    ) -> Option<TimelineAttitude> {
        let epoch_s = time_s + self.configuration.epoch_minus_time_s;
        let sight = sight(self.configuration, self.ephemeris, time_s, *geometry, Some(settings.planet));
        let mut ephemeris_at_time = sight.ephemeris()?;
        for body in bodies_of(&entry.command) {
            let place = geometry::body(self.configuration, self.ephemeris, body, epoch_s);
            ephemeris_at_time.place_body(body, &place);
        }
        law.attitude(settings, entry, time_s, &ephemeris_at_time, sun)
    }

    /// Attitude that the orbit phase's own guidance commands at `time_s`.
    fn by_orbit_phase(&mut self, guided: &Guided, time_s: f64, geometry: &Geometry) -> GuidedAttitude {
        let (configuration, ephemeris) = (self.configuration, &mut *self.ephemeris);
        let (trajectory, default_downlink) = (&*self.trajectory, self.default_downlink);
        let epoch_s = time_s + configuration.epoch_minus_time_s;
        let planet =
            guided.science.reads_motion().then(|| TargetPlanet::from_body(configuration.center.data()));
        let window =
            trajectory.window(configuration, time_s).unwrap_or_else(|| guided.schedule.window(epoch_s));
        guided.within(window, epoch_s, default_downlink, |at_epoch_s| {
            if at_epoch_s == epoch_s {
                return sight(configuration, ephemeris, time_s, *geometry, planet);
            }
            let at_s = at_epoch_s - configuration.epoch_minus_time_s;
            let spacecraft = trajectory.state_at_window_start(configuration, at_s);
            let geometry = Geometry::at(configuration, ephemeris, at_s, spacecraft);
            sight(configuration, ephemeris, at_s, geometry, planet)
        })
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
        let ephemeris = &mut *self.ephemeris;
        move |at_s| {
            let at_epoch_s = at_s + configuration.epoch_minus_time_s;
            let spacecraft = ellipse.map_or(now, |ellipse| ellipse.state_at(at_epoch_s));
            Geometry::at(configuration, ephemeris, at_s, spacecraft)
        }
    }

    /// The number at which the window or slew of `instant`, at `time_s`, ends or a panel goes elsewhere at once, if that is before
    /// `limit_s`.
    pub(crate) fn laws_until_s(&mut self, time_s: f64, instant: &Instant, limit_s: f64) -> f64 {
        let limit_s = limit_s.min(self.configuration.panels_until_s(time_s));
        let epoch_s = instant.attitude_until_s + self.configuration.epoch_minus_time_s;
        let rounding_s = EPOCH_ROUNDING_S + 4.0 * (spacing(epoch_s) + spacing(instant.attitude_until_s));
        let (before_s, behind_s) =
            ((instant.attitude_until_s - rounding_s).max(time_s), instant.attitude_until_s + rounding_s);
        if before_s >= limit_s || behind_s.is_nan() {
            return limit_s;
        }
        let form = |it: &Regime| (it.window_since_s, it.downlink, it.slewing, it.corner_s);
        let same = |it: &mut Self, at_s: f64| {
            let geometry = it.geometry(at_s);
            form(&it.attitude(at_s, &geometry).regime) == form(&instant.regime)
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
        let limit_s = self.laws_until_s(after_s, &first, limit_s);
        let samples = Segment::<4, NODES>::nodes(start_s, limit_s).map(|at_s| self.instant(at_s).events);
        let rounding_s = self.time_rounding_s(limit_s);
        first_event([after_s, start_s, limit_s], rounding_s, &samples, |at_s| self.events(at_s))
            .unwrap_or(limit_s)
    }
}
