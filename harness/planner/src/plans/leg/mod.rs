//! `heliotorque plan` of a leg file: the velocity at a place and date that leads to an encounter with a planet.

mod flights;
mod picture;

use std::path::Path;

use ::files::{OutputFolder, Scratch};
use files::outcome::{self, Answer, Outcome};
use inputs::{
    leg::{FlybyAimpoint, file::LegFile},
    library::Library,
    mission::{Inputs, Mission},
    values,
};
use isolation::interrupt;
use packing::assembly::spacecraft_of;
use physics::{constants::DAY_S, environment::dates};
use toml_edit::{DocumentMut, value};

use self::flights::LegFlights;
use super::{
    files::{check_standing, write_all},
    flights::SimulatedMission,
    mission_text,
    options::FilePlan,
    progress::Progress,
};
use crate::{
    Failure,
    leg::{Leg, LegError, LegTask, MAX_LEG_S, report, shoot},
    orbit::LambertError,
};

/// Names of the files.
const NAMES: [&str; 3] = ["mission.toml", "plan.svg", "plan.json"];
/// How near B comes to the aimpoint, in m.
const TOLERANCE_M: f64 = 1.0;
/// How long a mission continues behind the arrival, at least, in s.
const BEHIND_S: f64 = DAY_S;
/// Elements, which a start from position and velocity does not read.
const ELEMENTS: [&str; 7] = [
    "orbit.frame",
    "orbit.semiMajorAxis",
    "orbit.eccentricity",
    "orbit.inclination",
    "orbit.ascendingNode",
    "orbit.periapsisArgument",
    "orbit.trueAnomaly",
];
/// Inputs that a leg gives.
const STARTS: [&str; 2] = ["orbit.position", "orbit.velocity"];

/// Sentence on a leg file, after all that the command does before its first flight.
///
/// # Errors
/// Refusals of the command.
pub fn checked(file: &Path, library: Library<'_>) -> Result<String, Failure> {
    let found = LegFile::read(file)?;
    let unjudged = library.unjudged(&found.mission.it)?;
    if unjudged.is_none() {
        Prepared::new(&found, library.template())?;
    }
    let at = |instant: values::Instant| match instant {
        values::Instant::Time(time_s) => format!("day {}", terminal::short(time_s / DAY_S)),
        values::Instant::Epoch(epoch_s) => dates::utc(epoch_s),
    };
    let from = found.depart.at.as_ref().map_or("its start", |at| &at.it.1);
    let revolutions = found.arrive.revolutions().map_or(0, |(number, _)| number);
    Ok(format!(
        "leads {} from {from} to {} at {}, {}, in {revolutions} revolutions{}",
        found.mission.it.display(),
        found.arrive.body.it.word(),
        at(found.arrive.at.it),
        aimpoint(&found.aimpoint().it),
        unjudged.unwrap_or_default(),
    ))
}

fn aimpoint(aimpoint: &FlybyAimpoint) -> String {
    let km = |length_m: f64| terminal::short(1e-3 * length_m);
    match aimpoint {
        FlybyAimpoint::Altitude { altitude_m, angle_rad } => {
            let angle_deg = terminal::short(angle_rad.to_degrees());
            format!("{} km above it, B {angle_deg} deg from T toward R", km(*altitude_m))
        }
        FlybyAimpoint::Plane { b_t_m, b_r_m } => format!("B.T {} km, B.R {} km", km(*b_t_m), km(*b_r_m)),
    }
}

/// The mission's text with the leg's start, and with the velocity there once it is known.
struct LegMission<'a> {
    file: &'a LegFile,
    mission: Mission,
}

impl<'a> LegMission<'a> {
    fn read(file: &'a LegFile) -> Result<Self, Failure> {
        let mission = Mission::read(&file.mission.it)?;
        if let Some(Inputs::Columns(columns)) = &mission.inputs
            && let Some(at) = columns.iter().find(|at| STARTS.iter().any(|name| at.it.0.starts_with(name)))
        {
            let what = "found an input that the leg gives, allowed: none of orbit.position, orbit.velocity";
            return Err(at.problem(&mission.file, what).into());
        }
        if let (Some(at), None) = (&file.depart.at, mission.epoch_s()) {
            let what = "found a date, allowed: no such key, as the mission does not start at a date";
            return Err(file.problem(at, what).into());
        }
        if let (values::Instant::Epoch(_), None) = (file.arrive.at.it, mission.epoch_s()) {
            let what = "found a date, allowed: simulation time, as the mission does not start at a date";
            return Err(file.problem(&file.arrive.at, what).into());
        }
        Ok(Self { file, mission })
    }

    /// Time of the arrival of a flight whose time 0 has this epoch, in s.
    fn arrival_s(&self, zero_epoch_s: Option<f64>) -> f64 {
        self.file.arrive.at.it.time_s(zero_epoch_s).unwrap_or(f64::NAN)
    }

    fn text(&self, folder: &Path, velocity_m_s: &[f64]) -> Result<String, Failure> {
        let mut document: DocumentMut = mission_text::moved(&self.mission.path, folder)?;
        let mut zero_epoch_s = self.mission.epoch_s().map(|at| at.it);
        let mut stop_s = self.mission.stop_s();
        if let (Some(at), Some(before_s)) = (&self.file.depart.at, zero_epoch_s)
            && at.it.0 != before_s
        {
            document["start"] = value(&at.it.1);
            zero_epoch_s = Some(at.it.0);
            // A duration counts from the new start, a date does not.
            let is_date = document.get("stop").and_then(|it| it.as_str()).is_some_and(dates::looks_like_date);
            stop_s =
                stop_s.map(|stop_s| if is_date { stop_s - dates::span_s(before_s, at.it.0) } else { stop_s });
        }
        let needed_s = self.arrival_s(zero_epoch_s) + BEHIND_S;
        if stop_s.is_none_or(|stop_s| stop_s < needed_s) {
            document["stop"] = value(format!("{} d", (needed_s / DAY_S).ceil()));
        }
        if let Some(table) = document.get_mut("set").and_then(|it| it.as_table_like_mut()) {
            for name in ELEMENTS {
                table.remove(name);
            }
        }
        mission_text::set(&mut document, "orbit.source", value("inputs"));
        let position_m = self.file.depart.position_m.it;
        mission_text::set(&mut document, STARTS[0], mission_text::numbers(position_m.as_slice()));
        mission_text::set(&mut document, STARTS[1], mission_text::numbers(velocity_m_s));
        Ok(document.to_string())
    }
}

/// Refuses a mission that does not move between planets to that of the leg.
fn check(file: &LegFile, mission: &SimulatedMission, arrival_s: f64) -> Result<(), Failure> {
    let shown = file.mission.it.display();
    for (name, allowed) in
        [("orbit.center", "sun"), ("orbit.dynamics", "nBody"), ("encounter.body", file.arrive.body.it.word())]
    {
        let found = mission.values().item(name).unwrap_or("none");
        if found != allowed {
            let what = format!("{shown}: {name}: found {found}, allowed: {allowed}, for this leg");
            return Err(match name {
                "encounter.body" => file.problem(&file.arrive.body, &what),
                _ => file.problem(&file.mission, &what),
            }
            .into());
        }
    }
    if arrival_s.is_nan() || arrival_s <= mission.start_s {
        return Err(file
            .problem(&file.arrive.at, "found a time that is not after the departure, allowed: a later one")
            .into());
    }
    if arrival_s - mission.start_s > MAX_LEG_S {
        let years = terminal::short((arrival_s - mission.start_s) / (365.25 * DAY_S));
        let what = format!(
            "found a time {years} years behind the departure, allowed: up to {} years behind it",
            terminal::short(MAX_LEG_S / (365.25 * DAY_S))
        );
        return Err(file.problem(&file.arrive.at, &what).into());
    }
    if let Some(table) = &mission.inputs {
        let variables = &mission.fmu.description().variables;
        let mut names = table.positions().map(|position| variables[position].name.as_str());
        if let Some(name) = names.find(|name| STARTS.iter().any(|start| name.starts_with(start))) {
            return Err(format!("{shown}: inputs: found {name}, allowed: others: the leg gives it").into());
        }
    }
    Ok(())
}

/// A leg before its first flight.
struct Prepared<'a> {
    of_leg: LegMission<'a>,
    mission: SimulatedMission,
    arrival_s: f64,
}

impl<'a> Prepared<'a> {
    /// Opens the mission with the leg's start.
    ///
    /// # Errors
    /// Whatever is refused, by the leg's line.
    fn new(file: &'a LegFile, template: Option<&Path>) -> Result<Self, Failure> {
        let of_leg = LegMission::read(file)?;
        let scratch = Scratch::new()?;
        // At rest it would fall into the Sun; every flight has a velocity of its own.
        let begun = scratch.write(NAMES[0], of_leg.text(scratch.path(), &[0.0; 3])?)?;
        let in_mission = |error: Failure| file.problem(&file.mission, &error.to_string());
        let mission =
            SimulatedMission::open([&begun, &file.mission.it], template, &[]).map_err(in_mission)?;
        let arrival_s = of_leg.arrival_s(mission.zero_epoch_s);
        check(file, &mission, arrival_s)?;
        Ok(Self { of_leg, mission, arrival_s })
    }
}

/// Finds the leg, writes the files and reports what came of it.
pub fn run(options: &FilePlan) -> Outcome {
    let progress = Progress::begin(options.quiet);
    let file = LegFile::read(&options.file)?;
    check_standing(&options.output, NAMES)?;
    let _folder = OutputFolder::create(&options.output, "--output")?;
    let Prepared { of_leg, mission, arrival_s } = Prepared::new(&file, options.template.as_deref())?;
    let in_mission = |error: Failure| file.problem(&file.mission, &error.to_string());
    let body = file.arrive.body.it.word();
    let say = |doing: &str| progress.say(doing);
    say("the planet");
    let (leg, task, picture) = {
        let start = (file.depart.position_m.it, arrival_s);
        let mut flights = LegFlights::begin(&mission, body, start, &say).map_err(in_mission)?;
        let task = LegTask {
            position_m: file.depart.position_m.it,
            start_s: mission.start_s,
            arrival_s,
            aimpoint: file.aimpoint().it,
            lead_s: flights.lead_s,
            revolutions: file.arrive.revolutions(),
            velocity_before_m_s: file.depart.velocity_before_m_s,
            body: flights.at_arrival,
            mu_m3_s2: flights.mu_m3_s2,
            radius_m: flights.radius_m,
            tolerance_m: TOLERANCE_M,
        };
        let found = shoot(&task, &mut flights);
        if interrupt::raised() {
            return Ok(Answer::Interrupted);
        }
        let leg = match found {
            Ok(leg) => leg,
            Err(LegError::Flight(why)) => return Err(in_mission(why).into()),
            Err(infeasible) => return outcome::no(&refusal(&file, &infeasible)),
        };
        let paths = flights.paths(&leg.velocity_m_s).map_err(in_mission)?;
        let names = [spacecraft_of(&mission.fmu)?.name, capitalised(body)];
        let picture = picture::svg([&names[0], &names[1]], (&task, &leg), &paths)?;
        (leg, task, picture)
    };
    let text = of_leg.text(&options.output, leg.velocity_m_s.as_slice())?;
    let json = report::json((&task, &leg), body, mission.zero_epoch_s)?;
    let contents = [(NAMES[0], text), (NAMES[1], picture), (NAMES[2], json)];
    let mut inputs = of_leg.mission.reads();
    inputs.push(&options.file);
    let written = write_all(&options.output, &contents, &inputs)?;
    if !options.quiet {
        terminal::print(&summary((&task, &leg), &file, mission.zero_epoch_s))?;
        written.iter().for_each(|path| terminal::note(&format!("wrote {}", path.display())));
    }
    Ok(Answer::Yes)
}

/// An infeasible leg by the key that it comes from.
fn refusal(file: &LegFile, error: &LegError) -> String {
    let what = error.to_string();
    match error {
        LegError::Inside { .. } | LegError::Lost { .. } => file.problem(&file.aimpoint(), &what),
        LegError::Lambert(LambertError::TooShort { .. }) => file.problem(&file.arrive.revolutions, &what),
        LegError::Fast { .. } | LegError::Lambert(LambertError::Time { .. }) => {
            file.problem(&file.arrive.at, &what)
        }
        LegError::Lambert(_) | LegError::Orbit(_) | LegError::Flight(_) => {
            file.problem(&file.depart.position_m, &what)
        }
    }
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn summary((task, leg): (&LegTask, &Leg), file: &LegFile, zero_epoch_s: Option<f64>) -> String {
    let found = &leg.encounter;
    let at = |time_s: f64| match zero_epoch_s {
        Some(zero_s) => report::date(time_s, zero_s),
        None => format!("{} s", terminal::short(time_s)),
    };
    let flyby = report::flyby(task, leg);
    let shown = |vector: &nalgebra::Vector3<f64>| {
        vector.map(|part| format!("{part:.4}")).iter().cloned().collect::<Vec<_>>().join(", ")
    };
    let mut lines = vec![
        format!(
            "{}: closest approach {}, altitude {:.3} km",
            capitalised(file.arrive.body.it.word()),
            at(found.arrival_s),
            1e-3 * found.altitude_m
        ),
        format!(
            "B.T {:.3} km, B.R {:.3} km of the hyperbola that osculates {}, {} h before; its altitude {:.3} km; {:.3} m/s far away",
            1e-3 * found.b_m.x,
            1e-3 * found.b_m.y,
            at(found.osculation_s),
            terminal::short(task.lead_s / 3600.0),
            1e-3 * report::osculating_altitude_m(task, leg),
            found.excess_speed_m_s
        ),
        format!(
            "flyby: turns by {:.3} deg, delta-v {:.1} m/s",
            flyby.turn_rad.to_degrees(),
            flyby.delta_v_m_s
        ),
        format!(
            "departure {}: velocity {} m/s (EME2000, from the Sun)",
            at(task.start_s),
            shown(&leg.velocity_m_s)
        ),
    ];
    if let Some(delta_v_m_s) = report::departure_m_s(task, leg) {
        lines.push(format!(
            "delta-v of the departure {:.4} m/s: {}",
            delta_v_m_s.norm(),
            shown(&delta_v_m_s)
        ));
    }
    lines.push(format!(
        "{} flights without the planet's gravity, {} with it; B is {:.3} m off the aim",
        leg.rounds[0],
        leg.rounds[1],
        leg.miss_m[0].hypot(leg.miss_m[1])
    ));
    lines.join("\n")
}
