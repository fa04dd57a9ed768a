//! `heliotorque plan momentum`: arrays, places of the Sun and alternation that hold the momentum of a mission.

mod description;
mod file;
mod options;
mod picture;
mod planned;
mod prices;
#[cfg(feature = "schema")]
mod schema;
mod timeline;
mod written;

use std::{
    cell::RefCell,
    path::{Path, PathBuf},
    process::ExitCode,
    time::Instant,
};

use nalgebra::{Matrix4, Vector3};
use physics::guidance::timeline::Timeline;
use planner::momentum::{
    Limit,
    plan::{Least, MomentumPlan, PlanError, PlanTask, PlannedDump, plan},
    report::{self, PlanEvent},
    simulated::{MomentumSize, SimulatedFlight},
    torque::SunlitSpacecraft,
    windows::{Layout, Reach, Window, WindowKind},
};

pub(crate) use self::options::MomentumOptions;
use self::{
    file::PlanFile,
    planned::{NAMES, Planned},
    timeline::MissionTimeline,
};
use super::{
    files::write_all,
    flights::{Failure, SimulatedMission, Thresholds},
};
use crate::{interrupt, outcome::Outcome};

/// Reads the plan file and what it names, and simulates the mission as it is.
fn opened<'a>(options: &'a MomentumOptions, file: &PlanFile, began: Instant) -> Result<Planned<'a>, Failure> {
    let template = options.template.as_deref();
    let refit = file.refit.as_ref().map(|at| refit(file, at)).transpose()?;
    let sets: Vec<(String, Vec<f64>)> = refit.iter().flat_map(|it| it.sets()).collect();
    let settings = sets.iter().map(|(name, values)| {
        let values: Vec<String> = values.iter().map(f64::to_string).collect();
        format!("{name}={}", values.join(","))
    });
    let settings: Vec<String> = settings.collect();
    let in_mission = |error: Failure| file.problem(&file.mission, &error.to_string());
    let mission = SimulatedMission::open(&file.mission.it, template, &settings).map_err(in_mission)?;
    mission.check_downlinks().map_err(in_mission)?;
    check_spans(file, &mission)?;
    let is_in_orbit = mission.is_in_orbit();
    if let Some(at) = file.of_cruise.first().filter(|_| is_in_orbit) {
        let what =
            "found it, allowed: none in an orbit phase, whose downlinks' places of the Sun alone are planned";
        return Err(file.problem(at, what).into());
    }
    let spacecraft = mission.spacecraft()?;
    if let (Some(at), Some(refit)) = (&file.refit, &refit)
        && let Some(other) = refit.spacecraft.as_ref().filter(|other| **other != spacecraft.name)
    {
        let what =
            format!("found values of {other:?}, allowed: of {:?}, the mission's spacecraft", spacecraft.name);
        return Err(file.problem(at, &what).into());
    }
    let found = mission.timeline(&spacecraft)?;
    let timeline = MissionTimeline::of(&mission, found.as_ref())?;
    let own: Option<&Timeline> = found.as_ref().map(|(_, timeline)| timeline);
    let sunlit = mission.sunlit(own)?;
    let simulated = mission.simulate(Thresholds::Never, None)?;
    let layout = match is_in_orbit {
        true => orbit_layout(file, &mission, &timeline, &simulated)?,
        false => layout(file, &mission, &timeline, &sunlit)?,
    };
    let momentum_n_m_s = file.limit_n_m_s.unwrap_or_else(|| mission.least_threshold_n_m_s());
    let limit = Limit {
        momentum_n_m_s,
        size: MomentumSize::Length,
        margin: file.margin,
        covariance: refit.map(|it| it.covariance),
    };
    let least = if is_in_orbit { Least::Momentum } else { Least::Tilt };
    let task = PlanTask { layout, limit, dumps: file.dumps, least, budget_s: options.budget };
    let last = RefCell::new(String::new());
    Ok(Planned { options, mission, timeline, sunlit, simulated, task, sets, began, last })
}

/// Most windows of a plan.
const MOST_WINDOWS: f64 = 1000.0;

/// Refuses a plan without free time, or with windows beyond count.
fn check_spans(file: &PlanFile, mission: &SimulatedMission) -> Result<(), Failure> {
    let length_s = mission.stop_s - mission.start_s;
    let days = |time_s: f64| terminal::short(time_s / 86_400.0);
    if file.freeze_s.it >= length_s {
        let found =
            format!("found {} d, no less than the mission's {} d", days(file.freeze_s.it), days(length_s));
        let what = format!("{found}, allowed: less, so that there is something to plan");
        return Err(file.problem(&file.freeze_s, &what).into());
    }
    let least_s = length_s / MOST_WINDOWS;
    if file.window_s.it < least_s {
        let found = format!("found {} d of the mission's {} d", days(file.window_s.it), days(length_s));
        let what = format!("{found}, allowed: from {} d on", days(least_s));
        return Err(file.problem(&file.window_s, &what).into());
    }
    Ok(())
}

/// Angle that no downlink's Sun is off -Y by, in rad: where neither plan nor keep-in zone bounds it.
const MOST_TILT_RAD: f64 = 1.5;
/// Places stay so far within the keep-in zone, in rad: angles are rounded where they are written.
const WITHIN_ZONE_RAD: f64 = 1e-4;

/// The downlinks of a mission's orbit phase.
fn orbit_layout(
    file: &PlanFile,
    mission: &SimulatedMission,
    timeline: &MissionTimeline,
    simulated: &SimulatedFlight,
) -> Result<Layout, Failure> {
    let rows = &simulated.rows;
    // A command ends within its downlink: the spacecraft's own turn to science follows.
    let last_in =
        |stop_s: f64| rows[rows.partition_point(|row| row.time_s < stop_s).saturating_sub(1)].time_s;
    let downlinks = simulated.downlinks_s().into_iter().map(|[start_s, stop_s]| [start_s, last_in(stop_s)]);
    let downlinks_s: Vec<[f64; 2]> = downlinks.filter(|[start_s, stop_s]| stop_s > start_s).collect();
    if downlinks_s.is_empty() {
        return Err(file
            .problem(&file.mission, "found no downlink, allowed: a mission with downlinks to plan")
            .into());
    }
    let zone_rad = mission.values().zone_rad();
    let tilt = |angle_rad: Option<f64>, zone_rad: f64| {
        angle_rad.unwrap_or(MOST_TILT_RAD).min(zone_rad - WITHIN_ZONE_RAD).max(0.0)
    };
    let reach = Reach {
        azimuth_rad: tilt(file.azimuth_rad, zone_rad[0]),
        elevation_rad: tilt(file.elevation_rad, zone_rad[1]),
        ..Reach::default()
    };
    let sun_offset_rad = mission.values().real("panel[1].sunOffset");
    let sun_offset_rad = if sun_offset_rad.is_finite() { sun_offset_rad } else { 0.0 };
    Ok(Layout {
        frozen_until_s: mission.start_s + file.freeze_s.it,
        occupied: timeline.occupied(mission.stop_s),
        ..Layout::of_downlinks(downlinks_s, reach, sun_offset_rad)
    })
}

fn layout(
    file: &PlanFile,
    mission: &SimulatedMission,
    timeline: &MissionTimeline,
    sunlit: &SunlitSpacecraft,
) -> Result<Layout, Failure> {
    let sides: Vec<f64> = sunlit.windmill_sides().collect();
    let has_side = sides.iter().any(|side| *side != 0.0);
    if let (angle_rad, Some(at)) = &file.windmill_rad
        && *angle_rad > 0.0
        && !has_side
    {
        let what = "found panels without a side, allowed: 0, or windmill_side = 1 or -1 of [[panels]] in the spacecraft file";
        return Err(file.problem(at, what).into());
    }
    let panels = 1..=sunlit.panels.len();
    let controls = panels.map(|number| mission.values().item(&format!("panel[{number}].control")));
    let arrays_are_frozen = controls.into_iter().all(|it| matches!(it, Some("sunOffset" | "timeline")));
    let mut contacts_s: Vec<[f64; 2]> = Vec::new();
    for at in &file.contacts {
        let span = at.it.map(|instant| mission.time_s(instant));
        let [Some(from_s), Some(to_s)] = span else {
            return Err(file
                .problem(at, "found a date, allowed: simulation time: the mission does not start at a date")
                .into());
        };
        // Dates and simulation times compare here alone.
        if contacts_s.last().is_some_and(|[_, before_s]| from_s < *before_s) {
            let what = "found it before the contact above ends, allowed: contacts in the order of time, none overlapping";
            return Err(file.problem(at, what).into());
        }
        contacts_s.push([from_s, to_s]);
    }
    let zone_rad = mission.values().zone_rad();
    let offset_rad =
        timeline.arrays_rad.first().and_then(|(_, angles)| angles.first().copied()).unwrap_or_else(|| {
            if sides.is_empty() { 0.0 } else { mission.values().real("panel[1].sunOffset") }
        });
    Ok(Layout {
        frozen_until_s: mission.start_s + file.freeze_s.it,
        arrays_are_frozen,
        window_s: file.window_s.it,
        occupied: timeline.occupied(mission.stop_s),
        downlinks_s: None,
        contacts_s,
        contact_share: file.contact_share,
        reach: Reach {
            offset_rad: file.offset_rad,
            windmill_rad: file.windmill_rad.0,
            azimuth_rad: file.azimuth_rad.unwrap_or(0.0).min(zone_rad[0]),
            elevation_rad: file.elevation_rad.unwrap_or(0.0).min(zone_rad[1]),
            alternate: file.alternation,
        },
        corridor: mission.corridor(),
        offset_sign: if offset_rad < 0.0 { -1.0 } else { 1.0 },
        frozen_offset_rad: offset_rad,
        sides,
    })
}

/// What a refit found.
struct Refit {
    spacecraft: Option<String>,
    center_of_mass_m: [f64; 3],
    scale: f64,
    covariance: Matrix4<f64>,
}

impl Refit {
    fn sets(&self) -> Vec<(String, Vec<f64>)> {
        vec![
            ("spacecraft.centerOfMass".to_owned(), self.center_of_mass_m.to_vec()),
            ("solar.scale".to_owned(), vec![self.scale]),
        ]
    }
}

fn refit(plan: &PlanFile, at: &file::At<PathBuf>) -> Result<Refit, Failure> {
    // Beside the values for missions stands what was found.
    let is_toml = at.it.extension().is_some_and(|it| it.eq_ignore_ascii_case("toml"));
    let path = if is_toml { at.it.with_extension("json") } else { at.it.clone() };
    let found = ::files::read_text(&path).and_then(|text| planner::momentum::refit_file::read(&text));
    let found = found.map_err(|error| {
        let allowed = "allowed: the JSON that `heliotorque refit` writes";
        plan.problem(at, &format!("found {}: {error}, {allowed}", path.display()))
    })?;
    Ok(Refit {
        spacecraft: found.spacecraft,
        center_of_mass_m: found.center_of_mass_m,
        scale: found.scale,
        covariance: Matrix4::from(found.covariance).transpose(),
    })
}

/// What a plan file says, in a sentence, without flying anything.
///
/// # Errors
/// Everything wrong in it.
pub(crate) fn checked(file: &Path) -> Result<String, String> {
    let found = PlanFile::read(file)?;
    let days = |time_s: f64| terminal::short(time_s / 86_400.0);
    let deg = |angle_rad: f64| terminal::short(angle_rad.to_degrees());
    let tilt = |angle_rad: Option<f64>| deg(angle_rad.unwrap_or(0.0));
    Ok(format!(
        "plans {} behind day {} in windows of {} d: windmill {} deg, Sun {} and {} deg off -Y, alternation {}, offset {} deg off the \
         baseline; {} contacts, {} activities",
        found.mission.it.display(),
        days(found.freeze_s.it),
        days(found.window_s.it),
        deg(found.windmill_rad.0),
        tilt(found.azimuth_rad),
        tilt(found.elevation_rad),
        terminal::short(found.alternation),
        deg(found.offset_rad),
        found.contacts.len(),
        found.activities.len(),
    ))
}

/// Plans, writes the files and tells what came of it.
pub(crate) fn run(options: &MomentumOptions) -> Outcome {
    let began = Instant::now();
    let file = PlanFile::read(&options.plan)?;
    std::fs::create_dir_all(&options.output)
        .map_err(|error| format!("{}: {error}: see --output", options.output.display()))?;
    let planned = opened(options, &file, began)?;
    let mut simulates = &planned;
    let outcome = plan(&planned.task, &planned.sunlit, &planned.simulated, &mut simulates);
    if interrupt::raised() {
        return Ok(ExitCode::from(interrupt::INTERRUPTED));
    }
    let found = match outcome {
        Ok(found) => found,
        Err(PlanError::Corridor(none)) => {
            let text = report::corridor_json(&none, planned.mission.start_s)?;
            write(&planned, &[(NAMES[5], text)])?;
            let corridor = &planned.task.layout.corridor;
            let day = (none.at_s - planned.mission.start_s) / 86_400.0;
            let what = format!(
                "{}: articulation: found nothing between {} and {} suns on day {day:.1}, {:.4} AU from the Sun, where cells get {:.3} \
                 at most, allowed: bounds that some offset keeps at every distance of the flight",
                planned.mission.mission.file.display(),
                corridor.min_suns,
                corridor.max_suns,
                none.distance_au,
                none.suns,
            );
            return Err(file.problem(&file.mission, &what).into());
        }
        Err(error) => return Err(error.to_string().into()),
    };
    let prices = prices::all(&file, &planned, &found)?;
    let events = events(&planned, &found);
    let panels = planned.sunlit.spacecraft.panels.iter().map(|panel| panel.windmill_side);
    let sides: Vec<f64> = panels.filter(|_| !planned.mission.is_in_orbit()).collect();
    let bodies = |dump: &PlannedDump| planned.body(&found.windows, dump);
    let table = written::inputs(&planned.mission, &planned.timeline, &found, &sides, &bodies);
    let windows = report::windows_csv(&found, &timeline::shown_deg)?;
    let picture = picture::svg(&planned.sunlit.spacecraft.name, &found, &planned.task)?;
    let seeds = planned.simulate_seeds(&found.windows, &found.dumps)?;
    let json = report::json(&found, &planned.task, &events, (&prices, &seeds))?;
    let [timeline, mission] = planned.write_into(&options.output, (&found.windows, &found.dumps), None)?;
    let contents = [
        timeline,
        mission,
        (NAMES[2], table),
        (NAMES[3], String::from_utf8(windows)?),
        (NAMES[4], picture),
        (NAMES[5], json),
    ];
    write(&planned, &contents)?;
    for warning in written::beyond_inputs(&planned.mission, &planned.timeline) {
        terminal::note(&warning);
    }
    if !options.quiet {
        terminal::print(&summary(&planned, &found, (&prices, &seeds)))?;
        for (name, _) in &contents {
            terminal::note(&format!("wrote {}", options.output.join(name).display()));
        }
    }
    if found.exceeded.is_some() {
        check_contacts(&file, &planned, &found)?;
    }
    let is_planned = report::status(&found, &planned.task) == "planned";
    Ok(if is_planned { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Refuses contacts that leave no time for an alternation without which there is no plan.
fn check_contacts(file: &PlanFile, planned: &Planned<'_>, found: &MomentumPlan) -> Result<(), Failure> {
    let full = |window: &&Window| window.kind == WindowKind::Free && window.free_of_contact.is_empty();
    let Some(window) = found.windows.iter().find(full) else { return Ok(()) };
    let mut task = planned.task.clone();
    task.layout.contacts_s.clear();
    let needs = planner::momentum::plan::least_excess_n_m_s(
        &task,
        &planned.sunlit,
        &planned.simulated,
        f64::NEG_INFINITY,
    );
    let (Ok(excess), Some(at)) = (
        needs,
        file.contacts.iter().find(|at| {
            let span = at.it.map(|instant| planned.mission.time_s(instant));
            matches!(span, [Some(from_s), Some(to_s)] if from_s < window.stop_s && to_s > window.start_s)
        }),
    ) else {
        return Ok(());
    };
    if excess > 0.0 {
        return Ok(());
    }
    let start_s = planned.mission.start_s;
    let [from_d, to_d] = [window.start_s, window.stop_s].map(|time_s| (time_s - start_s) / 86_400.0);
    let what = format!(
        "found contacts that fill the window from day {from_d:.1} to {to_d:.1}, allowed: some time without contact: no plan holds without alternation there"
    );
    Err(file.problem(at, &what).into())
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
    inputs.push(&planned.options.plan);
    write_all(&planned.options.output, contents, &inputs)?;
    Ok(())
}

fn summary(
    planned: &Planned<'_>,
    found: &MomentumPlan,
    (prices, seeds): (&[report::Price], &[(f64, u32)]),
) -> String {
    let start_s = planned.mission.start_s;
    let day = |time_s: f64| (time_s - start_s) / 86_400.0;
    let [most_planned, most_simulated] = found.greatest_n_m_s();
    let limit = planned.task.limit.momentum_n_m_s;
    let (unmanaged, _) = planned.simulated.greatest_momentum();
    let mut lines = vec![
        format!("|H| as the mission is: {unmanaged:.3} N.m.s"),
        format!(
            "|H| planned {most_planned:.3}, simulated {most_simulated:.3}, limit {limit:.3} N.m.s; flight and plan differ by {:.4} at most, \
             {:.2} % of the limit, after {} flight{}",
            found.difference_n_m_s(),
            100.0 * found.difference_n_m_s() / limit,
            found.rounds,
            if found.rounds == 1 { "" } else { "s" },
        ),
    ];
    if let Some(exceeded) = &found.exceeded {
        lines.push(format!(
            "no plan holds without a dump: {} at least, the limit being exceeded by {:.3} N.m.s, first on day {:.1}; {} may be ([momentum] dumps)",
            found.dumps_at_least,
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
        lines.push("the last flight does not agree with the plan, or exceeds the limit".to_owned());
    }
    let gap = match found.changes - found.changes_at_least {
        0 => "no plan has fewer".to_owned(),
        _ => format!("no plan has fewer than {}", found.changes_at_least),
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
        let [momentum, dumps] = report::percentiles(seeds);
        let all = |of: [f64; 3]| of.map(terminal::short).join(", ");
        lines.push(format!(
            "{} seeds: |H| {} N.m.s, dumps {} (50, 90, 99 %)",
            seeds.len(),
            all(momentum),
            all(dumps)
        ));
    }
    lines.push(format!("{:.1} s", planned.began.elapsed().as_secs_f64()));
    lines.join("\n")
}
