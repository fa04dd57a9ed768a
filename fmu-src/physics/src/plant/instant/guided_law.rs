//! Attitude that guidance commands: by the timeline, else by the orbit phase, and during slews into commands.

use crate::guidance::constraints::command_slew::CommandSlew;
use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::constraints::slew::{Slew, SlewedFrame};
use crate::guidance::pointing::command::Scenario;
use crate::guidance::timeline::{Slot, TimelineEntry, TimelineLaw, TimelineSettings, bodies_of};
use crate::guidance::{
    Activity, AttitudeCommand, Guided, GuidedAttitude, OrbitPhaseLaw, Sight, TargetPlanet, Window,
};

use super::geometry::{Geometry, GeometrySight, SimulationEphemeris};
use crate::plant::motion::command_slews::CommandSlews;
use crate::plant::motion::trajectory::Trajectory;
use crate::plant::settings::attitude_source::AttitudeSource;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;

/// Returns the geometry at `time_s`; a law reads motions about `planet` from it as well, or directions alone.
fn sight(
    bodies: &mut SimulationEphemeris<'_>,
    time_s: f64,
    geometry: Geometry,
    planet: Option<TargetPlanet>,
) -> GeometrySight {
    let configuration = bodies.configuration;
    let motion = planet.map(|planet| {
        let gravity = bodies.gravity_m_s2(time_s, &geometry.spacecraft);
        (TargetPlanet { gm_m3_s2: configuration.orbit.mu_m3_s2(), ..planet }, gravity)
    });
    GeometrySight { geometry, epoch_s: time_s + configuration.epoch_minus_time_s, motion }
}

/// Guidance of a configured flight.
pub(super) struct GuidedLaw<'k, 'a> {
    pub trajectory: &'k Trajectory,
    pub bodies: &'k mut SimulationEphemeris<'a>,
    /// The spacecraft.
    pub spacecraft: PreparedSpacecraft<'k>,
    /// Slews into the timeline's commands.
    pub command_slews: &'k mut CommandSlews,
    /// Settings of the guidance.
    pub guided: &'k Guided,
}

/// Slot of the timeline with the law and settings that turn it into an attitude.
#[derive(Clone, Copy)]
struct SlotCommand<'t> {
    law: &'t TimelineLaw<'t>,
    settings: &'t TimelineSettings,
    slot: Slot<'t>,
}

/// Attitude that a slot commands, without the slew into it, and the geometry that it was computed from.
#[derive(Clone, Copy)]
struct Target {
    geometry: Geometry,
    attitude: GuidedAttitude,
}

impl GuidedLaw<'_, '_> {
    /// Attitude that the timeline commands at `time_s`, else the orbit phase's own guidance.
    pub(super) fn attitude(&mut self, time_s: f64, geometry: &Geometry) -> GuidedAttitude {
        let guided = self.guided;
        let Some((law, settings)) = self.spacecraft.timeline.zip(self.bodies.configuration.timeline) else {
            let requested = guided.requested.at_distance(geometry.to_sun.position_m.norm());
            let own = self.by_orbit_phase(&Guided { requested, ..*guided }, time_s, geometry);
            return GuidedAttitude { clamped: own.clamped || requested.is_moved, ..own };
        };
        let slot = law.timeline.slot(time_s, settings.clock_minus_time_s);
        let command = SlotCommand { law: &law, settings: &settings, slot };
        let target = Target { geometry: *geometry, attitude: self.by_slot(&command, time_s, geometry) };
        // NaN is no rate.
        if !(guided.slew_rate_rad_s > 0.0 && self.command_slews.lead_into(slot.since_s)) {
            return target.attitude;
        }
        let slew = self.command_slew(&command, time_s, &target);
        self.slewed(slew.as_ref(), time_s, &target)
    }

    /// Attitude during the slew into a command.
    fn slewed(&self, slew: Option<&CommandSlew>, time_s: f64, target: &Target) -> GuidedAttitude {
        let (sun, target) = (target.geometry.lines_of_sight().sun, target.attitude);
        let slewed = slew.and_then(|slew| slew.at(time_s, &target.frame, &sun, self.guided.slew_rate_rad_s));
        slewed.map_or(target, |SlewedFrame { frame, end_s }| {
            let end_epoch_s = end_s + self.bodies.configuration.epoch_minus_time_s;
            GuidedAttitude { frame, slewing: true, until_s: target.until_s.min(end_epoch_s), ..target }
        })
    }

    /// The slew into the command of a slot, from the attitude in which the body stands where it begins: of an attitude that dynamics
    /// follow at the first sample of it, otherwise at its edge.
    fn command_slew(
        &mut self,
        command: &SlotCommand<'_>,
        time_s: f64,
        target: &Target,
    ) -> Option<CommandSlew> {
        let SlotCommand { law, settings, slot } = *command;
        let guided = self.guided;
        let found = self.command_slews.find(slot.since_s);
        if let Some(slew) = found.filter(|slew| !slew.is_open()) {
            return Some(slew);
        }
        let zone = self.slew_zone(command, &target.geometry);
        let longest_s = Slew::longest_rad(zone.as_ref()) / guided.slew_rate_rad_s;
        if found.is_none() && time_s - slot.since_s > longest_s {
            return None;
        }
        let is_sampled = matches!(self.bodies.configuration.attitude, AttitudeSource::Dynamic(_));
        let begin_s = found.map_or(if is_sampled { time_s } else { slot.since_s }, |slew| slew.begin_s);
        let Target { geometry, attitude } = match begin_s == time_s {
            true => *target,
            false => {
                let spacecraft = self.trajectory.state_at(self.bodies.configuration, begin_s);
                let geometry = self.bodies.geometry(begin_s, spacecraft);
                Target { geometry, attitude: self.by_slot(command, begin_s, &geometry) }
            }
        };
        let mut slew = found.unwrap_or_else(|| {
            let before = law.timeline.slot_before(slot.since_s, settings.clock_minus_time_s);
            let last = self.by_slot(&SlotCommand { slot: before, ..*command }, begin_s, &geometry);
            let from = self.command_slews.find(before.since_s);
            let stood = self.slewed(from.as_ref(), begin_s, &Target { geometry, attitude: last });
            CommandSlew::new(begin_s, &stood.frame)
        });
        let sun = geometry.lines_of_sight().sun;
        let zone = self.slew_zone(command, &geometry);
        slew.aim(&attitude.frame, &sun, zone.as_ref(), guided.slew_rate_rad_s);
        self.command_slews.keep(slot.since_s, slew);
        Some(slew)
    }

    /// The zone that a slew into the command of a slot does not leave where it holds both ends.
    fn slew_zone(&self, command: &SlotCommand<'_>, geometry: &Geometry) -> Option<KeepIn> {
        match command.slot.entry {
            Some(entry) if command.slot.scenario().is_some() => {
                command.settings.keep_in(entry, geometry.to_sun.position_m.norm())
            }
            entry => self.keep_in_of_orbit_phase(entry),
        }
    }

    /// The keep-in zone of the orbit phase's own guidance under a command of the timeline.
    fn keep_in_of_orbit_phase(&self, entry: Option<&TimelineEntry>) -> Option<KeepIn> {
        match (entry, self.guided.keep_in) {
            (Some(entry), Some(zone)) => entry.keep_in.applied(&zone, true),
            (_, zone) => zone,
        }
    }

    /// Attitude that a slot of the timeline commands at `time_s`, without the slew into it.
    fn by_slot(&mut self, command: &SlotCommand<'_>, time_s: f64, geometry: &Geometry) -> GuidedAttitude {
        let (guided, slot) = (self.guided, &command.slot);
        let epoch_minus_time_s = self.bodies.configuration.epoch_minus_time_s;
        let [since_s, until_s] = [slot.since_s, slot.until_s].map(|it| it + epoch_minus_time_s);
        let requested = slot.sun_request(guided.requested);
        let commanded = slot.entry.filter(|_| slot.scenario().is_some());
        if let Some(entry) = commanded
            && let Some(found) = self.commanded(command, entry, time_s, geometry)
        {
            let activity = match slot.scenario() {
                Some(Scenario::Downlink) => Activity::Downlink,
                _ => Activity::Science,
            };
            let command = AttitudeCommand { corner_s: found.corner_s + epoch_minus_time_s, ..found };
            let window = Window { activity, since_s, until_s };
            return GuidedAttitude { row: slot.row, ..GuidedAttitude::held(command, window) };
        }
        let keep_in = self.keep_in_of_orbit_phase(slot.entry);
        let requested = requested.at_distance(geometry.to_sun.position_m.norm());
        let own = self.by_orbit_phase(&Guided { requested, keep_in, ..*guided }, time_s, geometry);
        let window = Window {
            since_s: own.window.since_s.max(since_s),
            until_s: own.window.until_s.min(until_s),
            ..own.window
        };
        let clamped = own.clamped || requested.is_moved;
        GuidedAttitude { window, clamped, until_s: own.until_s.min(until_s), ..own }
    }

    /// The attitude of a command of the timeline.
    fn commanded(
        &mut self,
        command: &SlotCommand<'_>,
        entry: &TimelineEntry,
        time_s: f64,
        geometry: &Geometry,
    ) -> Option<AttitudeCommand> {
        let SlotCommand { law, settings, slot } = *command;
        let sight = sight(self.bodies, time_s, *geometry, Some(settings.planet));
        let mut ephemeris_at_time = sight.ephemeris()?;
        for body in bodies_of(&entry.command) {
            ephemeris_at_time.place_body(body, &self.bodies.body(body, time_s));
        }
        let guided = Guided { requested: slot.sun_request(self.guided.requested), ..*self.guided };
        law.attitude(settings, entry, time_s, &ephemeris_at_time, &guided)
    }

    /// Attitude that the orbit phase's own guidance commands at `time_s`.
    fn by_orbit_phase(&mut self, guided: &Guided, time_s: f64, geometry: &Geometry) -> GuidedAttitude {
        let (configuration, bodies) = (self.bodies.configuration, &mut *self.bodies);
        let trajectory = self.trajectory;
        let law = OrbitPhaseLaw { guided: *guided, default_downlink: self.spacecraft.default_downlink };
        let epoch_s = time_s + configuration.epoch_minus_time_s;
        let planet =
            guided.science.reads_motion().then(|| TargetPlanet::from_body(configuration.center.data()));
        let window =
            trajectory.window(configuration, time_s).unwrap_or_else(|| guided.schedule.window(epoch_s));
        law.within(window, epoch_s, |at_epoch_s| {
            if at_epoch_s == epoch_s {
                return sight(bodies, time_s, *geometry, planet);
            }
            let at_s = at_epoch_s - configuration.epoch_minus_time_s;
            let spacecraft = trajectory.state_at_window_start(configuration, at_s);
            let geometry = bodies.geometry(at_s, spacecraft);
            sight(bodies, at_s, geometry, planet)
        })
    }
}
