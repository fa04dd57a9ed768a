//! A plan, from its file.

use std::path::Path;

use files::outcome::Refusal;
use physics::toml::{Place, Written as _};

use super::{
    encounter::Arrives,
    keys::{Flyby, FlybyKeys, PlanKeys, PlanValues},
};
use crate::{
    kind::FileKind,
    leg::FlybyAimpoint,
    reading::{self, At, InFile, quantities::Moment},
    values::Instant,
};

/// A plan file.
pub type PlanFile = InFile<PlanValues>;

impl PlanFile {
    /// Reads a plan.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub fn read(file: &Path) -> Result<Self, Refusal> {
        reading::read(FileKind::Plan, file, judge)
    }
}

impl PlanValues {
    /// Whether it has an aim, or is to say where the mission as it is passes a planet.
    pub fn has_aim(&self) -> bool {
        self.flyby.as_ref().is_none_or(|at| at.it.aimpoint().is_some())
    }

    /// Largest change of the arrays' offsets off the baseline, in rad; 0 where it is kept.
    pub fn offset_rad(&self) -> f64 {
        if self.sun_offset.it.change { self.sun_offset.it.largest_rad } else { 0.0 }
    }

    /// Keys that the file has and that count in cruise alone.
    pub fn of_cruise(&self) -> impl Iterator<Item = At<()>> {
        let keys = [
            self.window_s.with(()),
            self.windmill_rad.with(()),
            self.alternation.with(()),
            self.sun_offset.with(()),
            self.contacts.with(()),
            self.contact_share.with(()),
        ];
        keys.into_iter().filter(|key| key.is_written)
    }

    /// Every time that counts by the clock of the mission.
    pub fn instants_mut(&mut self) -> impl Iterator<Item = &mut Instant> {
        let flyby = self.flyby.iter_mut().flat_map(|at| [&mut at.it.time, &mut at.it.from]);
        let next = self.compare.iter_mut().map(|at| &mut at.it.next.it);
        let contacts = self.contacts.it.iter_mut().flat_map(|at| [&mut at.it.start, &mut at.it.stop]);
        let activities = self.activities.iter_mut().flat_map(|at| [&mut at.it.start, &mut at.it.stop]);
        flyby.flatten().map(|at| &mut at.it).chain(next).chain(contacts).chain(activities)
    }
}

impl Flyby {
    /// Aimpoint; without one the encounter of the mission as it is is described, and nothing is planned.
    pub fn aimpoint(&self) -> Option<At<FlybyAimpoint>> {
        FlybyAimpoint::new([&self.b_t_m, &self.b_r_m], &self.altitude_m, &self.angle_rad)
    }
}

/// Reports spans and contacts out of order, and an incomplete aim.
fn judge(keys: &PlanKeys, plan: &PlanValues, root: &Place<'_>) {
    let contacts = keys.contact.iter().flat_map(|at| &at.it).enumerate();
    let mut before: Option<Instant> = None;
    for (index, at) in contacts {
        let place = root.key("contact").item(index);
        let (start, stop) = (&at.it.start, &at.it.stop);
        if !check_span(&place, start, stop) {
            continue;
        }
        if let (Some(before), Some(start_at)) = (before, start.read())
            && is_before(start_at, before) == Some(true)
        {
            let found = format_args!("{start}, before the contact above ends");
            place.key("start").report(found, "contacts in the order of time, none overlapping");
        }
        before = stop.read();
    }
    for (index, at) in keys.activity.iter().flatten().enumerate() {
        check_span(&root.key("activity").item(index), &at.it.start, &at.it.stop);
    }
    if let (Some(keys), Some(flyby)) = (&keys.flyby, &plan.flyby) {
        judge_flyby(&keys.it, &flyby.it, &root.key("flyby"));
    }
}

/// Whether an instant comes before another one; `None` of a date and a simulation time.
fn is_before(one: Instant, other: Instant) -> Option<bool> {
    match (one, other) {
        (Instant::Time(one), Instant::Time(other)) | (Instant::Epoch(one), Instant::Epoch(other)) => {
            Some(one < other)
        }
        _ => None,
    }
}

/// Whether start and stop are both dates or both simulation times; reports others, and those out of order.
fn check_span(place: &Place<'_>, start: &Moment, stop: &Moment) -> bool {
    let (Some(from), Some(to)) = (start.read(), stop.read()) else { return false };
    let place = place.key("stop");
    match is_before(from, to) {
        Some(true) => {}
        Some(false) => {
            place.report(format_args!("{stop}, not after `start`"), format_args!("a time after {start}"));
        }
        None => place.report(stop, "a date as start is one, or both simulation times"),
    }
    is_before(from, to).is_some()
}

fn judge_flyby(keys: &FlybyKeys, flyby: &Flyby, place: &Place<'_>) {
    let aimpoint = flyby.aimpoint();
    let has_part =
        [&flyby.b_t_m, &flyby.b_r_m, &flyby.altitude_m, &flyby.angle_rad].iter().any(|it| it.is_some());
    if aimpoint.is_none() && has_part {
        place.report("no whole aim, or two", "either bT and bR, or altitude and angle");
    }
    if let Some(altitude) = keys.altitude.as_ref().filter(|it| it.it.value() < 0.0) {
        let found = format_args!("{}, inside of the planet", altitude.it);
        place.key("altitude").report(found, "an altitude from 0 on");
    }
    let arrival = place.key("arrival");
    match (&keys.time, flyby.arrival) {
        (None, Arrives::Fixed) => arrival.report("fixed without time", "time = a date, beside it"),
        (Some(_), Arrives::Free) => place.key("time").report("it", "arrival = \"fixed\" beside it"),
        _ => {}
    }
    if aimpoint.is_none() && flyby.arrival == Arrives::Fixed {
        arrival.report("fixed without an aim", "bT and bR, or altitude and angle, beside it");
    }
}

#[cfg(test)]
mod tests;
