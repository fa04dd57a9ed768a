//! Figures 7 and 8 of paper 001 with the controlled plant: commanded, estimated and true attitude over a scenario change.

use nalgebra::Vector2;

use super::guided_loop::{Flight, Loop, Sample};
use super::slew_limits::SlewLimits;
use crate::StudyError;
use crate::attitude::{Attitude, Vector, angle_rad, body_angles_deg};
use crate::cells::row;
use crate::pointing::{SLEW_S, TRANSITION_EPOCH_S, TRANSITION_TRUE_ANOMALY_DEG};
use crate::report::{Outcome, Run};
use crate::settings::{Settings, of, set};
use crate::verdict::{agrees, compared};
use drawing::{Chart, Mark, Panel, Series};

const END_S: f64 = 1500.0;
/// Errors of attitude and rate below which the spacecraft has settled, assumed: the paper says no number.
const SETTLED_DEG: f64 = 0.1;
const SETTLED_DEG_S: f64 = 0.005;
/// Half of a unit of the 0 deg that the paper prints for the Sun's azimuth and elevation.
const PRINTED_DEG: f64 = 0.5;
/// "The spacecraft response takes about 70-100 seconds to settle".
const PAPER_S: [f64; 2] = [70.0, 100.0];
/// Star tracker, each axis: 5 arc seconds, assumed.
const TRACKER_RAD: f64 = 5.0 * ARC_SECOND;
/// Gyros: random walk of the angle, 0.005 deg a root hour, assumed.
const GYRO_RAD_SQRT_S: f64 = 0.005 * core::f64::consts::PI / 180.0 / 60.0;
/// Gyros: random walk of the bias, 0.1 deg/h in a day, assumed.
const DRIFT_RAD_S_SQRT_S: f64 = 0.1 * core::f64::consts::PI / 180.0 / 3600.0 / 294.0;
const ARC_SECOND: f64 = core::f64::consts::PI / 648_000.0;

/// What is simulated: a label, and whether star tracker and gyros have noise.
type Case = (&'static str, bool);

const CASES: [Case; 2] = [("with noise", true), ("without noise", false)];

fn simulated((label, is_noisy): Case, both: &Loop, step_s: Option<f64>) -> Result<Vec<Sample>, StudyError> {
    // The camera stands as far sunward of +Z as nadir does with the Sun on -Y.
    let camera = |sample: &Sample| {
        let sun_nadir_rad = angle_rad(&sample.to_sun_m(), &sample.to_planet_m());
        set("boresight.angle", core::f64::consts::FRAC_PI_2 - sun_nadir_rad)
    };
    let inputs = |sample: &Sample| {
        let mut settings = Settings::new();
        if sample.time_s == 0.0 {
            settings.extend(set("pointing.scenario", "downlink"));
        } else if sample.time_s == SLEW_S {
            settings.extend(set("pointing.scenario", "gimbal"));
            settings.extend(set("aimpoint.option", "nadir"));
        }
        if sample.time_s >= SLEW_S {
            settings.extend(camera(sample));
        }
        of("guidance", settings)
    };
    let noise = || {
        let noise = [
            set("starTracker.noise", [TRACKER_RAD; 3]),
            set("gyro.noise", GYRO_RAD_SQRT_S),
            set("gyro.drift", DRIFT_RAD_S_SQRT_S),
        ];
        of("plant", noise.concat())
    };
    both.simulated(
        &Flight {
            label,
            epoch_s: TRANSITION_EPOCH_S,
            true_anomaly_deg: TRANSITION_TRUE_ANOMALY_DEG,
            stop_s: END_S,
            settings: if is_noisy { noise() } else { Settings::new() },
            inputs: &inputs,
        },
        step_s,
    )
}

/// Azimuth and elevation in the estimated body frame, in deg.
fn estimated_deg(sample: &Sample, inertial: &Vector) -> [f64; 2] {
    body_angles_deg(&sample.estimate_q.inverse_transform_vector(inertial))
}

/// Angle between the estimated and the commanded attitude, in deg.
fn error_deg(sample: &Sample) -> f64 {
    (sample.estimate_q.inverse() * sample.command_q).scaled_axis().norm().to_degrees()
}

/// Angle between the true rate and the commanded one, in deg/s.
fn rate_error_deg_s(sample: &Sample) -> f64 {
    (sample.rate_rad_s - sample.command_rate_rad_s).norm().to_degrees()
}

/// Limits of the plant's slews, and the keep-in zone in rad.
type Limits = (SlewLimits, Vector2<f64>);

/// The estimated curves of Figures 7 and 8.
pub(crate) fn transition(run: &mut Run<'_>) -> Outcome {
    let cases = run.chosen(CASES, |(label, _)| (*label).to_owned())?;
    let both = Loop::open(run.options)?;
    let names = SlewLimits::NAMES.iter().map(|name| format!("plant.{name}"));
    let zone = ["azimuth", "elevation"].map(|name| format!("guidance.keepIn.{name}"));
    let limits: Limits = both.parameters(&names.chain(zone).collect::<Vec<_>>())?;
    let step_s = run.options.step_s;
    let simulated = run.all(&cases, |case| Ok((*case, simulated(*case, &both, step_s)?)))?;
    run.line(
        "Downlink until 500 s, then the camera at nadir (paper 001, Figures 7 and 8), under the plant's own controller\n",
    );
    let rows: Vec<_> =
        simulated.iter().flat_map(|((label, _), samples)| rows(label, &limits, samples)).collect();
    run.table_and_csv("transition.csv", "case | quantity | paper | ours | verdict", rows)?;
    run.line(REMARK);
    history(run, &simulated)?;
    if let Some(((label, _), samples)) = simulated.first() {
        run.picture("transition-quaternion.svg", &quaternion_chart(label, samples))?;
        run.picture("transition-angles.svg", &angle_chart(label, samples))?;
    }
    Ok(())
}

const REMARK: &str = "\
Settled: the estimated attitude stays within 0.1 deg and the rate within 0.005 deg/s of the command, assumed: the paper
gives no number. Its gains, its limits of rate and acceleration and the angle of its slew are not printed either; ours are
the shipped defaults (bandwidth 0.1 rad/s, damping 0.8, slew rate a quarter of what the wheels guarantee to hold, slew
acceleration half of the torque they guarantee, on the largest inertia), and nothing is fitted: epoch and place on the orbit
are those of pointing/transition. By the limits: accelerate, coast and decelerate through our angle, in closed form; so the
difference in time is that of angle and limits, not of the controller. Assumed noise: star tracker 5 arc seconds about each
axis at 10 Hz, gyros 0.005 deg a root hour and a drift of 0.1 deg/h in a day. The camera's angle is commanded once a second
and Guidance takes it as fixed in between, so that the commanded rate has 0.0015 deg/s about X that the sequence of commanded
attitudes lacks; the slew follows it, which is how far the Sun leaves -Y.";

fn rows(label: &str, (slew, zone_rad): &Limits, samples: &[Sample]) -> Vec<Vec<String>> {
    let at = |second: f64| samples.iter().find(|sample| sample.time_s == second);
    // The command of the sample at 500 s stands one second later.
    let (Some(before), Some(after)) = (at(SLEW_S), at(SLEW_S + 1.0)) else { return Vec::new() };
    let greatest = |value: &dyn Fn(&Sample) -> f64| samples.iter().skip(1).map(value).fold(0.0, f64::max);
    let slew_rad = (before.command_q.inverse() * after.command_q).scaled_axis().norm();
    let is_off =
        |sample: &Sample| error_deg(sample) > SETTLED_DEG || rate_error_deg_s(sample) > SETTLED_DEG_S;
    let settled_s =
        samples.iter().rposition(is_off).and_then(|k| samples.get(k + 1)).map(|it| it.time_s - SLEW_S);
    let off_sun = |frame: &dyn Fn(&Sample) -> Attitude| {
        greatest(&|it| {
            angle_rad(&-Vector::y(), &frame(it).inverse_transform_vector(&it.to_sun_m())).to_degrees()
        })
    };
    let zone_deg = zone_rad.map(f64::to_degrees);
    let outside = samples.iter().skip(1).filter(|sample| {
        let [azimuth, elevation] = estimated_deg(sample, &sample.to_sun_m());
        azimuth.abs() > zone_deg[0] || elevation.abs() > zone_deg[1]
    });
    let [outside, limited] = [outside.count(), samples.iter().filter(|it| it.is_torque_limited).count()];
    let last_deg = samples.iter().rev().take(300).map(error_deg).fold(0.0, f64::max);
    let row = |what: &str, ours: String, verdict: &str| compared(&format!("{label} | {what}"), ours, verdict);
    let [estimated_deg, true_deg] = [off_sun(&|sample| sample.estimate_q), off_sun(&|sample| sample.q)];
    vec![
        row("slew angle | not printed", format!("{:.2} deg", slew_rad.to_degrees()), "-"),
        row(
            "time to settle | about 70 to 100 s",
            settled_s.map_or_else(|| "does not".to_owned(), |time_s| format!("{time_s:.0} s")),
            agrees(settled_s.is_some_and(|time_s| (PAPER_S[0]..=PAPER_S[1]).contains(&time_s))),
        ),
        row("the same by the limits alone | not printed", format!("{:.0} s", slew.least_s(slew_rad)), "-"),
        row(
            "slew angles that take 70 to 100 s by the limits | not printed",
            format!(
                "{:.1} to {:.1} deg",
                slew.angle_rad(PAPER_S[0]).to_degrees(),
                slew.angle_rad(PAPER_S[1]).to_degrees()
            ),
            "-",
        ),
        row(
            "Sun from -Y in the estimated attitude, greatest | 0 deg: never leaves -Y",
            format!("{estimated_deg:.1e} deg"),
            agrees(estimated_deg < PRINTED_DEG),
        ),
        row(
            "Sun from -Y in the true attitude, greatest | 0 deg",
            format!("{true_deg:.1e} deg"),
            agrees(true_deg < PRINTED_DEG),
        ),
        row("seconds outside the keep-in zone, estimated | never", outside.to_string(), agrees(outside == 0)),
        row("error in the last 300 s, greatest | not printed", format!("{last_deg:.1e} deg"), "-"),
        row("seconds with torque at its limit | not printed", limited.to_string(), "-"),
    ]
}

fn history(run: &mut Run<'_>, simulated: &[(Case, Vec<Sample>)]) -> Outcome {
    let header = "\
        case | time_s | command_q1 | command_q2 | command_q3 | command_q4 | estimate_q1 | estimate_q2 | \
        estimate_q3 | estimate_q4 | q1 | q2 | q3 | q4 | rate_x_rad_s | rate_y_rad_s | rate_z_rad_s | \
        command_x_rad_s | command_y_rad_s | command_z_rad_s | sun_x_m | sun_y_m | sun_z_m | earth_x_m | \
        earth_y_m | earth_z_m | planet_x_m | planet_y_m | planet_z_m | mdis_angle_deg | torque_limited | \
        constrained";
    let rows = simulated.iter().flat_map(|((label, _), samples)| {
        samples.iter().map(|sample| {
            row![
                *label,
                sample.time_s,
                sample.command_q,
                sample.estimate_q,
                sample.q,
                sample.rate_rad_s,
                sample.command_rate_rad_s,
                sample.to_sun_m(),
                sample.to_earth_m(),
                sample.to_planet_m(),
                sample.mdis_angle_rad.to_degrees(),
                sample.is_torque_limited,
                sample.is_constrained,
            ]
        })
    });
    run.csv("transition-history.csv", header, rows)
}

/// A line over time from the first command on, interrupted where the command jumps if `jumps`.
fn over_time(label: &str, samples: &[Sample], jumps: bool, value: impl Fn(&Sample) -> f64) -> Series {
    let mut points = Vec::new();
    for sample in samples.iter().skip(1) {
        if jumps && sample.time_s == SLEW_S + 1.0 {
            points.push((sample.time_s, f64::NAN));
        }
        points.push((sample.time_s, value(sample)));
    }
    Series::line(label, points)
}

/// The sign of a quaternion that leaves it closest to the commanded one at the end of the flight.
fn sign(samples: &[Sample], q: &Attitude) -> f64 {
    if samples.last().is_some_and(|last| q.dot(&last.command_q) < 0.0) { -1.0 } else { 1.0 }
}

fn quaternion_chart(label: &str, samples: &[Sample]) -> Chart {
    let signed = |q: &Attitude, i: usize| sign(samples, q) * q[i];
    let mut panels: Vec<Panel> = (0..4)
        .map(|i| {
            Panel::new(format!("q{}", i + 1)).with([
                over_time("commanded", samples, true, |sample| signed(&sample.command_q, i)),
                over_time("estimated", samples, false, |sample| signed(&sample.estimate_q, i))
                    .drawn(Mark::Dashed),
            ])
        })
        .collect();
    for panel in panels.iter_mut().skip(1) {
        panel.series.iter_mut().for_each(|series| series.label.clear());
    }
    panels.push(Panel::new("error [deg]").with([over_time(
        "estimated to commanded",
        samples,
        false,
        error_deg,
    )]));
    Chart::new(format!("Commanded and estimated quaternion over the transition, {label}"), "time [s]")
        .with(panels)
}

fn angle_chart(label: &str, samples: &[Sample]) -> Chart {
    let panel = |name: &str, i: usize| {
        Panel::new(format!("{name} [deg]")).with([
            over_time("Mercury", samples, false, |it| estimated_deg(it, &it.to_planet_m())[i]),
            over_time("Earth", samples, false, |it| estimated_deg(it, &it.to_earth_m())[i]),
            // Dashed, as it lies on one of the others all the time.
            over_time("Sun", samples, false, |it| estimated_deg(it, &it.to_sun_m())[i]).drawn(Mark::Dashed),
        ])
    };
    Chart::new(format!("Sun, Earth and Mercury in the estimated body frame, {label}"), "time [s]")
        .with([panel("azimuth", 0), panel("elevation", 1)])
}
