//! Visits of a run: a command of the timeline at a time, the Sun in the body frame, and the momentum gathered.
//!
//! Momentum gathered is the change of `momentum.inertial` without dumps: steps are halved until one that has a dump is short, and while
//! one lasts the trapezoid of the torque stands for the change. The Sun is that of the middle of a visit, when a slew into it is over.

use fmi::{Error, Fmu, Instance, Watcher};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::visit::Visit;
use crate::carried;

/// Reals that are read, in this order.
const REALS: [&str; 13] = [
    "timeline.until",
    "sun.azimuth",
    "sun.elevation",
    "momentum.inertial[1]",
    "momentum.inertial[2]",
    "momentum.inertial[3]",
    "torque.total[1]",
    "torque.total[2]",
    "torque.total[3]",
    "attitude.q[1]",
    "attitude.q[2]",
    "attitude.q[3]",
    "attitude.q[4]",
];
/// Integers, likewise.
const INTEGERS: [&str; 2] = ["timeline.command", "dump.count"];
/// Whether a dump lasts.
const DUMPING: &str = "dump.active";
/// Names of a thruster's variables begin with it.
const THRUSTER: &str = "thruster[";

/// Values at a time.
#[derive(Clone, Copy, Debug)]
struct Sample {
    time_s: f64,
    row: i32,
    until_s: Option<f64>,
    sun_rad: [f64; 2],
    momentum_inertial_n_m_s: Vector3<f64>,
    torque_inertial_n_m: Vector3<f64>,
    dumps: i32,
    is_dumping: bool,
}

/// A visit under way.
#[derive(Clone, Copy, Debug)]
struct Open {
    visit: Visit,
    middle_s: f64,
    last: Sample,
}

/// Makes visits of a flight by a timeline.
pub struct Visits {
    references: [Vec<u32>; 3],
    counts: bool,
    stop_s: f64,
    open: Option<Open>,
    /// Visits that are over.
    closed: Vec<Visit>,
}

impl Visits {
    /// For an FMU that flies by a timeline with commands and tells its momentum until a stop, with the variables that are given a
    /// value; `None` for others, and where on-times of thrusters are given, which count from the beginning of each step.
    pub fn new<'n>(fmu: &Fmu, stop_s: f64, mut given: impl Iterator<Item = &'n String>) -> Option<Self> {
        let description = fmu.description();
        let has_commands = carried::timeline::names(fmu.folder()).is_some_and(|names| !names.is_empty());
        if !has_commands || given.any(|name| name.starts_with(THRUSTER)) {
            return None;
        }
        let reference = |name: &&str| {
            let found = description.variables.iter().find(|variable| variable.name == **name);
            found.map(|variable| variable.value_reference)
        };
        let reals = REALS.iter().map(reference).collect::<Option<Vec<u32>>>()?;
        let integers = INTEGERS.iter().map(reference).collect::<Option<Vec<u32>>>()?;
        let references = [reals, integers, vec![reference(&DUMPING)?]];
        let counts = description.co_simulation.as_ref().is_some_and(|it| it.can_get_and_set_fmu_state);
        Some(Self { references, counts, stop_s, open: None, closed: Vec::new() })
    }

    /// The visits up to where the run came; none where no command was ever in force.
    pub fn into_visits(mut self) -> Vec<Visit> {
        self.closed.extend(self.open.map(|open| open.visit));
        self.closed.retain(|visit| visit.span_s[0] < visit.span_s[1]);
        if self.closed.iter().all(|visit| visit.row == 0) { Vec::new() } else { self.closed }
    }

    fn read(&self, instance: &mut Instance, time_s: f64) -> Result<Sample, Error> {
        let (mut reals, mut integers) = ([0.0; REALS.len()], [0; INTEGERS.len()]);
        instance.get_reals(&self.references[0], &mut reals)?;
        instance.get_integers(&self.references[1], &mut integers)?;
        let mut is_dumping = [0];
        instance.get_booleans(&self.references[2], &mut is_dumping)?;
        let [until_s, azimuth_rad, elevation_rad, ..] = reals;
        let vector = |at: usize| Vector3::new(reals[at], reals[at + 1], reals[at + 2]);
        let q = Quaternion::new(reals[12], reals[9], reals[10], reals[11]);
        Ok(Sample {
            time_s,
            row: integers[0],
            until_s: Some(until_s).filter(|it| *it > time_s),
            sun_rad: [azimuth_rad, elevation_rad],
            momentum_inertial_n_m_s: vector(3),
            torque_inertial_n_m: UnitQuaternion::new_normalize(q) * vector(6),
            dumps: integers[1],
            is_dumping: is_dumping[0] != 0,
        })
    }

    /// Begins a visit where a sample is.
    fn begin(&self, now: Sample) -> Open {
        let end_s = now.until_s.unwrap_or(self.stop_s).min(self.stop_s);
        let visit = Visit {
            row: now.row,
            span_s: [now.time_s; 2],
            sun_rad: now.sun_rad,
            gathered_inertial_n_m_s: Vector3::zeros(),
            dumps: 0,
        };
        Open { visit, middle_s: 0.5 * (now.time_s + end_s), last: now }
    }

    /// Takes the values of a later time; gives the next one at which something happens, in s.
    fn take(&mut self, now: Sample) -> f64 {
        let mut open = self.open.unwrap_or_else(|| self.begin(now));
        let last = core::mem::replace(&mut open.last, now);
        let dumps = now.dumps - last.dumps;
        open.visit.gathered_inertial_n_m_s += if dumps == 0 && !last.is_dumping {
            now.momentum_inertial_n_m_s - last.momentum_inertial_n_m_s
        } else {
            (last.torque_inertial_n_m + now.torque_inertial_n_m) * (0.5 * (now.time_s - last.time_s))
        };
        open.visit.dumps += dumps;
        open.visit.span_s[1] = now.time_s;
        if last.time_s < open.middle_s {
            open.visit.sun_rad = now.sun_rad;
        }
        let is_over = now.row != last.row || last.until_s.is_some_and(|until_s| until_s <= now.time_s);
        if is_over && now.time_s > open.visit.span_s[0] {
            self.closed.push(open.visit);
            open = self.begin(now);
        }
        self.open = Some(open);
        let middle_s = Some(open.middle_s).filter(|middle_s| *middle_s > now.time_s);
        middle_s.or(now.until_s).unwrap_or(f64::INFINITY)
    }
}

impl Watcher for Visits {
    fn look(&mut self, instance: &mut Instance, time_s: f64) -> Result<f64, Error> {
        let now = self.read(instance, time_s)?;
        Ok(self.take(now))
    }

    fn counter(&self) -> Option<u32> {
        self.references[1].last().copied().filter(|_| self.counts)
    }
}
