//! `heliotorque plan` of a plan file: arrays, places of the Sun and alternation that hold the momentum of a mission.

mod flyby;
mod flyby_task;
mod layout;
mod picture;
mod planned;
mod prepared;
mod prices;
mod timeline;
mod written;

use std::{cell::RefCell, path::Path, time::Instant};

use ::files::OutputFolder;
use drawing::{Chart, DrawingError, Picture};
use files::outcome::{self, Answer, Outcome};
use inputs::{library::Library, plan::PlanFile};
use isolation::interrupt;
use nalgebra::{Matrix4, Vector3};
use physics::constants::DAY_S;

use self::{
    flyby_task::FlybyTask,
    layout::orbit_layout,
    planned::{NAMES, Planned},
    prepared::Prepared,
};
use super::{
    files::{check_standing, write_all},
    options::FilePlan,
};
use crate::{
    Failure,
    flyby::report::FlybyReport,
    momentum::{
        Limit,
        plan::{Least, MomentumPlan, PlanError, PlanTask, PlannedDump, plan},
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

/// Reads what the plan file names, and simulates the mission as it is.
fn opened<'a>(options: &'a FilePlan, file: &PlanFile, began: Instant) -> Result<Planned<'a>, Failure> {
    let prepared = Prepared::new(file, options.template.as_deref())?;
    if let Some(at) = &file.update {
        let (mut updated, folder) = flyby::updated(file, at, &prepared.mission)?;
        updated.update = None;
        let mut planned = opened(options, &updated, began)?;
        planned.keeps = Some(folder);
        planned.file.update = file.update.clone();
        return Ok(planned);
    }
    let Prepared { file, mission, timeline, sunlit, refit, sets, aim, cruise } = prepared;
    let mut simulated = mission.simulate(None)?;
    let flyby_task = file.flyby.as_ref().zip(aim);
    let flyby_task =
        flyby_task.map(|(at, aim)| FlybyTask::new(&file, (&at.it, aim), (&mission, &sunlit), &simulated));
    let flyby_task = flyby_task.transpose()?;
    simulated.encountered = flyby_task.as_ref().map(|it| it.aimpoint.encountered(&it.first, &simulated.rows));
    let layout = match cruise {
        Some(layout) => layout,
        None => orbit_layout(&file, &mission, &timeline, &simulated)?,
    };
    let momentum_n_m_s = file.momentum.limit_n_m_s.unwrap_or_else(|| mission.least_threshold_n_m_s());
    let limit = Limit {
        momentum_n_m_s,
        size: mission.convention().into(),
        margin: file.momentum.margin,
        covariance: refit.map(|it| Matrix4::from(it.covariance).transpose()),
    };
    let least = if mission.is_in_orbit() { Least::Momentum } else { Least::Tilt };
    let target = flyby_task.as_ref().map(FlybyTask::target);
    let task = PlanTask {
        layout,
        limit,
        dumps: file.momentum.dumps as usize,
        least,
        budget_s: options.budget_s,
        target,
    };
    let last = RefCell::new(String::new());
    Ok(Planned {
        options,
        file,
        mission,
        timeline,
        sunlit,
        simulated,
        flyby_task,
        task,
        sets,
        began,
        last,
        keeps: None,
    })
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
    let began = Instant::now();
    let file = PlanFile::read(&options.file)?;
    check(&file)?;
    check_standing(&options.output, NAMES)?;
    let _folder = OutputFolder::create(&options.output, "--output")?;
    let planned = opened(options, &file, began)?;
    let file = &planned.file;
    if let Some(flyby_task) = &planned.flyby_task {
        flyby::check(&planned, flyby_task)?;
    }
    if let Some(flyby_task) = planned.flyby_task.as_ref().filter(|_| !file.has_aim()) {
        return describe(&planned, flyby_task);
    }
    let encounter =
        planned.flyby_task.as_ref().map(|it| Ok::<_, Failure>((flyby::before(&planned, it)?, it)));
    let mut encounter = encounter.transpose()?;
    if let Some((report, flyby_task)) = encounter.as_ref().filter(|(report, _)| report.is_out_of_reach) {
        return refuse(&planned, (report, flyby_task));
    }
    let mut simulates = &planned;
    let outcome = plan(&planned.task, &planned.sunlit, &planned.simulated, &mut simulates);
    if interrupt::raised() {
        return Ok(Answer::Interrupted);
    }
    let found = match outcome {
        Ok(found) => found,
        Err(PlanError::Corridor(none)) => {
            let text = report::corridor_json(&none, planned.mission.start_s)?;
            write(&planned, &[(NAMES[5], text)])?;
            let corridor = &planned.task.layout.corridor;
            let day = (none.at_s - planned.mission.start_s) / DAY_S;
            let what = format!(
                "{}: articulation: found nothing between {} and {} suns on day {day:.1}, {:.4} AU from the Sun, where cells get {:.3} \
                 at most, allowed: bounds that some offset keeps at every distance of the flight",
                planned.mission.mission.file.display(),
                corridor.min_suns,
                corridor.max_suns,
                none.distance_au,
                none.suns,
            );
            return outcome::no(&file.problem(&file.mission, &what));
        }
        Err(limit @ PlanError::Limit { .. }) => return outcome::no(&limit.to_string()),
        Err(error) => return Err(error.to_string().into()),
    };
    let prices = prices::all(file, &planned, &found)?;
    let events = events(&planned, &found);
    let panels = planned.sunlit.spacecraft.panels.iter().map(|panel| panel.windmill_side);
    let sides: Vec<f64> = panels.filter(|_| !planned.mission.is_in_orbit()).collect();
    let bodies = |dump: &PlannedDump| planned.body(&found.windows, dump);
    let table = written::inputs(&planned.mission, &planned.timeline, &found, &sides, &bodies);
    let windows = report::windows_csv(&found, &timeline::shown_deg)?;
    let seeds = planned.simulate_seeds(&found.windows, &found.dumps)?;
    let mut of_flyby = Vec::new();
    if let Some((report, flyby_task)) = &mut encounter {
        let [sensitivity, partials] = flyby::complete(report, file, (&planned, flyby_task), &found)?;
        of_flyby = vec![
            (flyby::NAMES[0], String::from_utf8(report.desired_csv()?)?),
            (flyby::NAMES[1], sensitivity),
            (flyby::NAMES[2], partials),
        ];
    }
    let chart = picture::chart(&planned.sunlit.spacecraft.name, &found, &planned.task);
    let picture = drawn(Some(&chart), encounter.as_ref().map(|(report, it)| (report, *it)))?;
    let more = encounter.as_ref().map(|(report, _)| report.members()).unwrap_or_default();
    let json = report::json(&found, &planned.task, &events, (&prices, &seeds), more)?;
    let [timeline, mission] = planned.write_into(&options.output, (&found.windows, &found.dumps), None)?;
    let mut contents = vec![
        timeline,
        mission,
        (NAMES[2], table),
        (NAMES[3], String::from_utf8(windows)?),
        (NAMES[4], picture),
        (NAMES[5], json),
    ];
    contents.extend(of_flyby);
    write(&planned, &contents)?;
    for warning in written::beyond_inputs(&planned.mission, &planned.timeline) {
        terminal::note(&warning);
    }
    if let Some(why) = &found.flight.ended {
        terminal::note(&format!(
            "warning: the mission with this plan ends early, see `heliotorque new leg`: {why}"
        ));
    }
    if !options.quiet {
        terminal::print(&summary(&planned, &found, (&prices, &seeds)))?;
        if let Some((report, flyby_task)) = &encounter {
            terminal::print(&flyby::summary(report, flyby_task).join("\n"))?;
        }
        for (name, _) in &contents {
            terminal::note(&format!("wrote {}", options.output.join(name).display()));
        }
    }
    if found.exceeded.is_some()
        && let Some(what) = full_contacts(file, &planned, &found)
    {
        return outcome::no(&what);
    }
    let is_planned = report::status(&found, &planned.task) == "planned";
    Ok(Answer::from(is_planned))
}

/// Writes where the mission as it is passes its planet, for a plan without an aim.
fn describe(planned: &Planned<'_>, flyby_task: &FlybyTask) -> Outcome {
    let report = flyby::without_aim(planned, flyby_task)?;
    let json = report::without_plan_json("withoutAim", report.members())?;
    let partials = flyby::first_partials(planned, flyby_task)?;
    write(planned, &[(NAMES[5], json), (flyby::NAMES[2], partials)])?;
    if !planned.options.quiet {
        terminal::print(&flyby::summary(&report, flyby_task).join("\n"))?;
    }
    Ok(Answer::Yes)
}

/// Writes what there is of a plan whose aimpoint is out of reach.
fn refuse(planned: &Planned<'_>, (report, flyby_task): (&FlybyReport, &FlybyTask)) -> Outcome {
    let picture = drawn(None, Some((report, flyby_task)))?;
    let json = report::without_plan_json("notFound", report.members())?;
    let desired = String::from_utf8(report.desired_csv()?)?;
    let partials = flyby::first_partials(planned, flyby_task)?;
    let contents =
        [(NAMES[4], picture), (NAMES[5], json), (flyby::NAMES[0], desired), (flyby::NAMES[2], partials)];
    write(planned, &contents)?;
    if !planned.options.quiet {
        terminal::print(&flyby::summary(report, flyby_task).join("\n"))?;
    }
    Ok(Answer::No)
}

/// `plan.svg`.
fn drawn(chart: Option<&Chart>, flyby: Option<(&FlybyReport, &FlybyTask)>) -> Result<String, DrawingError> {
    let of_flyby =
        flyby.map(|(report, flyby_task)| (flyby::plane(report, flyby_task), flyby::desired(report)));
    let mut all: Vec<&dyn Picture> = chart.iter().map(|chart| *chart as &dyn Picture).collect();
    if let Some((plane, desired)) = &of_flyby {
        all.push(plane);
        all.extend(desired.iter().map(|chart| chart as &dyn Picture));
    }
    drawing::svg(&all)
}

/// Problem of contacts that leave no time for an alternation without which there is no plan.
fn full_contacts(file: &PlanFile, planned: &Planned<'_>, found: &MomentumPlan) -> Option<String> {
    let full = |window: &&Window| window.kind == WindowKind::Free && window.free_of_contact.is_empty();
    let window = found.windows.iter().find(full)?;
    let mut task = planned.task.clone();
    task.layout.contacts_s.clear();
    let needs = crate::momentum::attainable::least_excess_n_m_s(
        &task,
        &planned.sunlit,
        &planned.simulated,
        f64::NEG_INFINITY,
    );
    let at = file.contacts.it.iter().find(|at| {
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
    Some(file.problem(at, &what))
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

fn summary(
    planned: &Planned<'_>,
    found: &MomentumPlan,
    (prices, seeds): (&[report::Price], &[(f64, u32)]),
) -> String {
    let start_s = planned.mission.start_s;
    let day = |time_s: f64| (time_s - start_s) / DAY_S;
    let [most_planned, most_simulated] = found.greatest_n_m_s();
    let limit = planned.task.limit.momentum_n_m_s;
    let size = planned.task.limit.size;
    let (unmanaged, _) = planned.simulated.greatest(size);
    let mut lines = vec![
        format!("{size} as the mission is: {unmanaged:.3} N.m.s"),
        format!(
            "{size} planned {most_planned:.3}, simulated {most_simulated:.3}, limit {limit:.3} N.m.s; flight and plan differ by {:.4} at most, \
             {:.2} % of the limit, after {} flight{}",
            found.difference_n_m_s(),
            100.0 * found.difference_n_m_s() / limit,
            found.rounds,
            if found.rounds == 1 { "" } else { "s" },
        ),
    ];
    if let Some(exceeded) = &found.exceeded {
        let bound = match found.dumps_at_least {
            0 => "no plan without a dump was found".to_owned(),
            count => format!("no plan holds without a dump: {count} at least on this baseline"),
        };
        lines.push(format!(
            "{bound}; the limit is exceeded by {:.3} N.m.s at the least that was found, first on day {:.1}; {} may be ([momentum] dumps)",
            exceeded.excess_n_m_s,
            day(exceeded.first_s),
            planned.task.dumps,
        ));
        let days: Vec<String> = found.dumps.iter().map(|dump| format!("{:.2}", day(dump.at_s))).collect();
        lines.push(format!("dumps on days {}", days.join(", ")));
    } else {
        lines.push("dumps: 0".to_owned());
    }
    if !found.holds {
        lines.push(
            "no plan was found that holds: the best flight exceeds the limit, or misses its aim".to_owned(),
        );
    }
    if found.is_mission {
        lines.push("the plan is the mission as it is: no better one was found".to_owned());
    }
    let gap = match (found.changes - found.changes_at_least, found.changes_at_least) {
        (0, _) => "no plan has fewer on this baseline".to_owned(),
        (_, 0) => "fewer are not excluded".to_owned(),
        (_, least) => format!("no plan has fewer than {least} on this baseline"),
    };
    let free = found.windows.iter().filter(|window| window.kind == WindowKind::Free);
    lines.push(match planned.mission.is_in_orbit() {
        true => format!("places of the Sun in {} downlinks", free.count()),
        false => format!(
            "{} steps of the baseline, {} changes of the arrays; {gap}",
            found.baseline.len(),
            found.changes
        ),
    });
    for price in prices {
        lines.push(format!(
            "{} {}: {:.3} N.m.s gathered more, {:+.3} N.m.s at the limit, {:+} dumps",
            if price.removed { "without" } else { "with" },
            price.name,
            Vector3::from(price.gathered_n_m_s).norm(),
            price.momentum_n_m_s,
            price.dumps,
        ));
    }
    if !seeds.is_empty() {
        let [momentum, dumps] = report::of_seeds(seeds);
        let all = |of: [f64; 3]| of.map(terminal::short).join(", ");
        lines.push(format!(
            "{} seeds: {size} {} N.m.s, dumps {} (50, 90, 99 %)",
            seeds.len(),
            all(momentum),
            all(dumps)
        ));
    }
    lines.push(format!("{:.1} s", planned.began.elapsed().as_secs_f64()));
    lines.join("\n")
}
