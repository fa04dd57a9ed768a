//! Report of a plan with a flyby: reach, velocity changes that would do the same, manoeuvres compared, dispersed flights.

mod campaign;
mod compared;
mod picture;

use physics::constants::DAY_S;

pub(super) use self::picture::{desired, plane};
use super::planned::Planned;
use crate::{
    Failure,
    flyby::{
        FlybyTask,
        controls::lead_by_windows,
        report::{FlybyReport, partials_csv, sensitivity_csv},
    },
    momentum::{
        attainable::{meets_target, reachable},
        plan::MomentumPlan,
    },
};

/// Between the times of desired velocity changes, in s.
const DESIRED_S: f64 = 86_400.0;

/// Names of files that only plans with a flyby have.
pub(super) const NAMES: [&str; 3] = ["desired.csv", "sensitivity.csv", "partials.csv"];

/// Refuses times that the flight does not have, before anything is planned.
pub(super) fn check(planned: &Planned<'_>, flyby_task: &FlybyTask) -> Result<(), Failure> {
    let file = &planned.file;
    let from_s = planned.task.layout.frozen_until_s;
    if from_s >= flyby_task.first.encounter.epoch_s {
        let what = "found a time behind which no change moves the encounter, allowed: one before its hyperbola osculates";
        return Err(file.problem(&file.freeze_s, what).into());
    }
    compared::check(planned, flyby_task)
}

/// Report as far as it is known before the plan.
pub(super) fn before<'a>(
    planned: &Planned<'_>,
    flyby_task: &'a FlybyTask,
) -> Result<FlybyReport<'a>, Failure> {
    let (problem, mut simulates) = (planned.problem(), planned);
    let reach = reachable(&problem, &mut simulates)?;
    let miss = flyby_task.first_miss();
    // The reach is a lower bound: the programme of the plan decides beyond it.
    let is_found = reach.region_m.holds((-miss.xy()).into()) || meets_target(&problem, &mut simulates)?;
    let from_s = planned.task.layout.frozen_until_s.max(planned.mission.start_s);
    let epoch_s = flyby_task.first.encounter.epoch_s;
    let days = (0..).map(|day| from_s + f64::from(day) * DESIRED_S).take_while(|at_s| *at_s < epoch_s);
    let desired = days.filter_map(|at_s| {
        let found = match flyby_task.aimpoint.arrival_s {
            None => flyby_task.first.desired(at_s, [miss.x, miss.y]),
            Some(_) => flyby_task.first.desired_in_time(at_s, [miss.x, miss.y], miss.z),
        };
        Some((at_s, found?))
    });
    Ok(FlybyReport {
        miss: [Some(miss), None],
        is_out_of_reach: !is_found,
        reach,
        desired: desired.collect(),
        ..FlybyReport::new(flyby_task)
    })
}

/// The same of a plan without an aim, with what misses of it cost.
pub(super) fn without_aim<'a>(
    planned: &Planned<'_>,
    flyby_task: &'a FlybyTask,
) -> Result<FlybyReport<'a>, Failure> {
    let mut report = FlybyReport::new(flyby_task);
    if let Some(at) = &planned.file.compare {
        report.compared = Some(compared::compared(&at.it, (planned, flyby_task), &flyby_task.first)?);
    }
    Ok(report)
}

/// Completes the report by the plan's flight, manoeuvres and dispersed flights; returns `sensitivity.csv` and `partials.csv`.
pub(super) fn complete(
    report: &mut FlybyReport<'_>,
    planned: &Planned<'_>,
    found: &MomentumPlan,
) -> Result<[String; 2], Failure> {
    let (file, flyby_task) = (&planned.file, report.task);
    let mut flight = found.flight.clone();
    let after = flyby_task.judge(&mut flight, &planned.sunlit)?;
    report.miss[1] = Some(flyby_task.aimpoint.miss(&after.encounter));
    report.encounter = after.encounter.clone();
    if let Some(at) = &file.compare {
        report.compared = Some(compared::compared(&at.it, (planned, flyby_task), &after)?);
    }
    if let Some(at) = &file.monte_carlo {
        let (mission, _folder) = planned.open_plan((&found.windows, &found.dumps), None)?;
        let covariance = file.update.as_ref().and_then(|it| it.it.covariance);
        let arrival_s = after.encounter.time_s;
        report.campaign =
            Some(campaign::simulated(&mission, (at.it, covariance), (flyby_task, arrival_s), planned)?);
    }
    let by_window = lead_by_windows(&after, &planned.sunlit, &flight, &found.windows);
    Ok([sensitivity_csv(&found.windows, &by_window), partials_csv(&after, &flight)])
}

/// Summary of the report, in lines.
pub(super) fn summary(report: &FlybyReport<'_>) -> Vec<String> {
    let km = |length_m: f64| terminal::short(length_m / 1e3);
    let (aimpoint, encounter) = (&report.task.aimpoint, &report.encounter);
    let days_before = |at_s: f64| terminal::short((encounter.time_s - at_s) / DAY_S);
    let lead_h = terminal::short((encounter.time_s - encounter.epoch_s) / 3600.0);
    let missed = |label: &str, miss: &nalgebra::Vector3<f64>| {
        let late = aimpoint.arrival_s.map(|_| format!(", {} s late", terminal::short(miss.z)));
        let late = late.unwrap_or_default();
        format!("{label} misses by {} km along T, {} km along R{late}", km(miss.x), km(miss.y))
    };
    let mut lines = vec![format!(
        "{}, {lead_h} h before closest approach: aim B.T {} km, B.R {} km; closest approach {} km above it, excess speed {} km/s",
        report.task.body(),
        km(aimpoint.b_m[0]),
        km(aimpoint.b_m[1]),
        km(report.altitude_m()),
        terminal::short(encounter.plane.excess_speed_m_s / 1e3),
    )];
    let [before, after] = &report.miss;
    lines.extend(before.iter().map(|miss| missed("the mission as it is", miss)));
    lines.extend(after.iter().map(|miss| missed("the plan", miss)));
    if before.is_none() {
        return lines;
    }
    let along = report.reach.along_m.map(|along_m| along_m.map_or("none".to_owned(), km));
    lines.push(format!("reach +T {}, -T {}, +R {}, -R {} km", along[0], along[1], along[2], along[3]));
    if report.is_out_of_reach {
        lines.push(
            "not found: arrays and attitudes that lead to the aim within the limits; what was reached is a lower bound"
                .to_owned(),
        );
    }
    let least = report.desired.iter().min_by(|a, b| a.1.size_m_s().total_cmp(&b.1.size_m_s()));
    if let Some((at_s, it)) = least {
        lines.push(format!(
            "least velocity change that would do the same: {} mm/s, {} d before",
            terminal::short(1e3 * it.size_m_s()),
            days_before(*at_s)
        ));
    }
    if let Some(compared) = &report.compared {
        for (at_s, it) in &compared.approach {
            lines.push(format!(
                "approach manoeuvre {} d before: {} m/s, leaves {} km (root mean square)",
                days_before(*at_s),
                terminal::short(it.rms_m_s),
                km(it.left.rms_m())
            ));
        }
        let [without, behind, planned] = compared.departure_m_s.map(terminal::short);
        lines.push(format!(
            "departure manoeuvre: {without} m/s without a correction, {behind} behind the approach manoeuvres, {planned} behind the plan"
        ));
    }
    if let Some(campaign) = &report.campaign {
        let ([large_m, small_m], angle_rad) = crate::flyby::maneuvers::ellipse(&campaign.covariance_m2);
        lines.push(format!(
            "{} dispersed flights, {} failed: mean miss {}, {} km, ellipse of one deviation {} by {} km, {} deg from T toward R",
            campaign.outcomes.len() + campaign.failed.len(),
            campaign.failed.len(),
            km(campaign.mean_m.x),
            km(campaign.mean_m.y),
            km(large_m),
            km(small_m),
            terminal::short(angle_rad.to_degrees())
        ));
    }
    lines
}
