//! `heliotorque plan` of a plan file: arrays, places of the Sun and alternation that hold the momentum of a mission.

mod flyby;
mod flyby_task;
mod input_table;
mod layout;
mod picture;
mod planned;
mod prepared;
mod prices;
mod steps;
mod summary;
mod timeline;
mod update;
mod written;

use std::path::Path;

use ::files::OutputFolder;
use drawing::{Chart, DrawingError, Picture};
use files::outcome::{self, Answer, Outcome};
use inputs::{library::Library, plan::PlanFile};
use isolation::interrupt;
use physics::constants::DAY_S;

use self::{
    planned::{NAMES, Planned},
    prepared::Prepared,
};
use super::{
    files::{check_standing, write_all},
    options::FilePlan,
};
use crate::{
    Failure,
    flyby::report::{FlybyReport, partials_csv},
    momentum::{
        attainable::least_excess_n_m_s,
        baseline::NoOffset,
        plan::{MomentumPlan, PlanError, PlanProblem, plan},
        report::{self, PlanEvent},
        windows::{Window, WindowKind},
    },
};

/// Refuses what only a plan with [flyby] takes.
fn check(file: &PlanFile) -> Result<(), String> {
    if file.flyby.is_some() {
        return Ok(());
    }
    let what = "found it without [flyby], allowed with it";
    let other = file.update.as_ref().map(|at| file.problem(at, what));
    let other = other.or_else(|| Some(file.problem(file.compare.as_ref()?, what)));
    let other = other.or_else(|| Some(file.problem(file.monte_carlo.as_ref()?, what)));
    other.map_or(Ok(()), Err)
}

/// Summary of a plan file in a sentence, after all that the command does before its first flight.
///
/// # Errors
/// Refusals of the command.
pub fn checked(path: &Path, library: Library<'_>) -> Result<String, Failure> {
    let found = PlanFile::read(path)?;
    check(&found)?;
    let unjudged = library.unjudged(&found.mission.it)?;
    if unjudged.is_none() {
        Prepared::new(&found, library.template())?;
    }
    let days = |time_s: f64| terminal::short(time_s / DAY_S);
    let deg = |angle_rad: f64| terminal::short(angle_rad.to_degrees());
    let tilt = |angle_rad: Option<f64>| deg(angle_rad.unwrap_or(0.0));
    Ok(format!(
        "plans {} behind day {} in windows of {} d: windmill {} deg, Sun {} and {} deg off -Y, alternation {}, offset {} deg off the \
         baseline; {} contacts, {} activities{}",
        found.mission.it.display(),
        days(found.freeze_s.it),
        days(found.window_s.it),
        deg(found.windmill_rad.it),
        tilt(found.tilt.azimuth_rad),
        tilt(found.tilt.elevation_rad),
        terminal::short(found.alternation.it),
        deg(found.offset_rad()),
        found.contacts.it.len(),
        found.activities.len(),
        unjudged.unwrap_or_default(),
    ))
}

/// Plans, writes the files and reports what came of it.
pub fn run(options: &FilePlan) -> Outcome {
    let file = PlanFile::read(&options.file)?;
    check(&file)?;
    check_standing(&options.output, NAMES)?;
    let _folder = OutputFolder::create(&options.output, "--output")?;
    let planned = Planned::open(options, &file)?;
    let mut encounter = None;
    if let Some(flyby_task) = &planned.flyby_task {
        flyby::check(&planned, flyby_task)?;
        if !planned.file.has_aim() {
            let report = flyby::without_aim(&planned, flyby_task)?;
            without_plan(&planned, "withoutAim", &report, Vec::new())?;
            return Ok(Answer::Yes);
        }
        let report = flyby::before(&planned, flyby_task)?;
        if report.is_out_of_reach {
            let contents =
                vec![(NAMES[4], drawn(None, Some(&report))?), (flyby::NAMES[0], report.desired_csv())];
            without_plan(&planned, "notFound", &report, contents)?;
            return Ok(Answer::No);
        }
        encounter = Some(report);
    }
    let mut simulates = &planned;
    let found = plan(&planned.problem(), &mut simulates);
    if interrupt::raised() {
        return Ok(Answer::Interrupted);
    }
    match found {
        Ok(found) => answer(&planned, &found, encounter),
        Err(PlanError::Corridor(none)) => no_offset(&planned, &none),
        Err(limit @ PlanError::Limit { .. }) => outcome::no(&limit.to_string()),
        Err(error) => Err(error.into()),
    }
}

/// Writes a plan that was found, and reports what came of it.
fn answer(planned: &Planned<'_>, found: &MomentumPlan, mut encounter: Option<FlybyReport<'_>>) -> Outcome {
    let options = planned.options;
    let prices = prices::all(planned, found)?;
    let events = events(planned, found);
    let table = input_table::text(planned, found);
    let seeds = planned.simulate_seeds(&found.windows, &found.dumps)?;
    let mut of_flyby = Vec::new();
    if let Some(report) = &mut encounter {
        let [sensitivity, partials] = flyby::complete(report, planned, found)?;
        of_flyby = flyby::NAMES.into_iter().zip([report.desired_csv(), sensitivity, partials]).collect();
    }
    let report = encounter.as_ref();
    let chart = picture::chart(&planned.sunlit.spacecraft.name, found, &planned.task);
    let picture = drawn(Some(&chart), report)?;
    let more = report.map(FlybyReport::members);
    let json = report::json(found, &planned.task, &events, (&prices, &seeds), more)?;
    let [timeline, mission] = planned.write_into(&options.output, (&found.windows, &found.dumps), None)?;
    let windows = report::windows_csv(found, &steps::shown_deg);
    let mut contents = vec![timeline, mission];
    contents.extend(NAMES[2..].iter().copied().zip([table, windows, picture, json]));
    contents.extend(of_flyby);
    write(planned, &contents)?;
    for warning in written::beyond_inputs(&planned.mission, &planned.timeline) {
        terminal::note(&warning);
    }
    if let Some(why) = &found.flight.ended {
        terminal::note(&format!(
            "warning: the mission with this plan ends early, see `heliotorque new leg`: {why}"
        ));
    }
    if !options.quiet {
        terminal::print(&summary::text(planned, found, (&prices, &seeds)))?;
        if let Some(report) = report {
            terminal::print(&flyby::summary(report).join("\n"))?;
        }
        for (name, _) in &contents {
            terminal::note(&format!("wrote {}", options.output.join(name).display()));
        }
    }
    if found.exceeded.is_some()
        && let Some(what) = full_contacts(planned, found)
    {
        return outcome::no(&what);
    }
    Ok(Answer::from(report::status(found, &planned.task) == "planned"))
}

/// Writes `plan.json` where the corridor is empty, and says where.
fn no_offset(planned: &Planned<'_>, none: &NoOffset) -> Outcome {
    let start_s = planned.mission.start_s;
    write(planned, &[(NAMES[5], report::corridor_json(none, start_s)?)])?;
    let corridor = &planned.task.layout.corridor;
    let what = format!(
        "{}: articulation: found nothing between {} and {} suns on day {:.1}, {:.4} AU from the Sun, where cells get {:.3} at most, \
         allowed: bounds that some offset keeps at every distance of the flight",
        planned.mission.mission.file.display(),
        corridor.min_suns,
        corridor.max_suns,
        (none.at_s - start_s) / DAY_S,
        none.distance_au,
        none.suns,
    );
    outcome::no(&planned.file.problem(&planned.file.mission, &what))
}

/// Writes and prints what there is of an encounter without a plan: where the mission as it is passes its planet, and other contents.
fn without_plan(
    planned: &Planned<'_>,
    status: &str,
    report: &FlybyReport<'_>,
    mut contents: Vec<(&'static str, String)>,
) -> Result<(), Failure> {
    contents.push((NAMES[5], report::without_plan_json(status, report.members())?));
    contents.push((flyby::NAMES[2], partials_csv(&report.task.first, &planned.simulated)));
    write(planned, &contents)?;
    if !planned.options.quiet {
        terminal::print(&flyby::summary(report).join("\n"))?;
    }
    Ok(())
}

/// `plan.svg`.
fn drawn(chart: Option<&Chart>, report: Option<&FlybyReport<'_>>) -> Result<String, DrawingError> {
    let of_flyby = report.map(|report| (flyby::plane(report), flyby::desired(report)));
    let mut all: Vec<&dyn Picture> = chart.iter().map(|chart| *chart as &dyn Picture).collect();
    if let Some((plane, desired)) = &of_flyby {
        all.push(plane);
        all.extend(desired.iter().map(|chart| chart as &dyn Picture));
    }
    drawing::svg(&all)
}

/// Problem of contacts that leave no time for an alternation without which there is no plan.
fn full_contacts(planned: &Planned<'_>, found: &MomentumPlan) -> Option<String> {
    let full = |window: &&Window| window.kind == WindowKind::Free && window.free_of_contact.is_empty();
    let window = found.windows.iter().find(full)?;
    let mut task = planned.task.clone();
    task.layout.contacts_s.clear();
    let needs = least_excess_n_m_s(&PlanProblem { task: &task, ..planned.problem() }, f64::NEG_INFINITY);
    let at = planned.file.contacts.it.iter().find(|at| {
        let span = [at.it.start, at.it.stop].map(|instant| planned.mission.time_s(instant));
        matches!(span, [Some(from_s), Some(to_s)] if from_s < window.stop_s && to_s > window.start_s)
    })?;
    if needs.ok()? > 0.0 {
        return None;
    }
    let start_s = planned.mission.start_s;
    let [from_d, to_d] = [window.start_s, window.stop_s].map(|time_s| (time_s - start_s) / DAY_S);
    let what = format!(
        "found contacts that fill the window from day {from_d:.1} to {to_d:.1}, allowed: some time without contact: no plan was found without alternation there"
    );
    Some(planned.file.problem(at, &what))
}

fn events(planned: &Planned<'_>, found: &MomentumPlan) -> Vec<PlanEvent> {
    let mut events = planned.timeline.plan_events();
    let dumps = found.dumps.iter();
    events.extend(dumps.map(|dump| PlanEvent { at_s: dump.at_s, kinds: vec!["dump"], planned: true }));
    events.sort_by(|a, b| a.at_s.total_cmp(&b.at_s));
    events
}

fn write(planned: &Planned<'_>, contents: &[(&'static str, String)]) -> Result<(), Failure> {
    let mut inputs = planned.mission.mission.reads();
    inputs.push(&planned.options.file);
    write_all(&planned.options.output, contents, &inputs)?;
    Ok(())
}
