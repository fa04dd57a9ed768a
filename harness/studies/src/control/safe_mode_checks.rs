//! What paper 001 says of its safe modes, looked for in a flight.

use super::guided_loop::{Loop, Sample};
use super::safe_mode_flight::{
    BORESIGHT, OPERATIONAL_S, OUTAGE_S, PARDONED_S, SAFE_HOLD_S, SUN_BACK_S, SUN_LOST_S, TRACKER_BACK_S,
    TRACKER_FAILS_S, ZONE_ON_S, sun_angle_deg,
};
use nalgebra::Vector2;

use crate::StudyError;
use crate::attitude::{Vector, across, angle_rad, body_angles_deg};
use crate::case::recorded;
use drawing::Series;

/// Exchange and sample: what is seen at one second acts at the next and shows at the one after.
const DELAY_S: f64 = 3.0;
/// The end of a phase, in which what was commanded is to have come true, in s.
const SETTLED_S: f64 = 200.0;
/// Largest angle between a commanded and an actual direction then, in deg.
const ANGLE_DEG: f64 = 0.1;
/// Largest error of a rate then, as a share of it.
const RATE: f64 = 0.01;

/// A statement of the paper, in short, whether it holds, and what the flight shows.
type Check = (&'static str, (bool, String));

recorded! {
    /// Limits and rates of Guidance, as the FMU has them.
    pub(super) struct Limits {
        earth_acquisition_rad_s: f64 = "guidance.earthAcquisition.rate",
        search_rad_s: f64 = "guidance.sunSearch.rate",
        search_s: f64 = "guidance.sunSearch.duration",
        zone_rad: Vector2<f64> = "guidance.keepIn.azimuth" "guidance.keepIn.elevation",
        safe_hold_rad: Vector2<f64> = "guidance.safeHold.keepIn.azimuth" "guidance.safeHold.keepIn.elevation",
        persistence_s: f64 = "guidance.monitor.persistence",
        margin_rad: f64 = "guidance.monitor.margin",
        beam_rad: f64 = "guidance.link.beam",
    }
}

/// Parameters of Guidance that the checks compare with.
pub(super) struct Parameters {
    operational: i32,
    safe_hold: i32,
    earth_acquisition: i32,
    attitude: i32,
    error_quaternion: i32,
    rate_only: i32,
    limits: Limits,
    zone_deg: Vector2<f64>,
    safe_hold_deg: Vector2<f64>,
}

impl Parameters {
    /// As the FMU has them.
    pub(super) fn read(both: &Loop) -> Result<Self, StudyError> {
        let limits: Limits = both.parameters(Limits::NAMES)?;
        let mode = |item: &str| both.number("guidance.mode.active", item);
        let kind = |item: &str| both.number("guidance.command.kind", item);
        Ok(Self {
            operational: mode("operational")?,
            safe_hold: mode("safeHold")?,
            earth_acquisition: mode("earthAcquisition")?,
            attitude: kind("attitude")?,
            error_quaternion: kind("errorQuaternion")?,
            rate_only: kind("rateOnly")?,
            limits,
            zone_deg: limits.zone_rad.map(f64::to_degrees),
            safe_hold_deg: limits.safe_hold_rad.map(f64::to_degrees),
        })
    }

    /// What is commanded about Y while the Sun is on -Y, and about each axis in turn while it is searched for: lines over
    /// time, in deg/s.
    pub(super) fn commanded_rates(&self) -> [Series; 2] {
        let line = |label: &str, rate_rad_s: f64, from_s: f64, to_s: f64| {
            let rate_deg_s = rate_rad_s.to_degrees();
            Series::dashed(label, vec![(from_s, rate_deg_s), (to_s, rate_deg_s)])
        };
        let lost_s = TRACKER_FAILS_S + OUTAGE_S;
        [
            line("earthAcquisition.rate about -Y", -self.limits.earth_acquisition_rad_s, lost_s, SUN_LOST_S),
            line("sunSearch.rate", self.limits.search_rad_s, SUN_LOST_S, SUN_BACK_S),
        ]
    }
}

/// Part of a flight.
struct Phase<'a>(Vec<&'a Sample>);

impl<'a> Phase<'a> {
    fn between(samples: &'a [Sample], from_s: f64, to_s: f64) -> Self {
        Self(samples.iter().filter(|sample| (from_s..=to_s).contains(&sample.time_s)).collect())
    }

    fn greatest(&self, value: impl Fn(&Sample) -> f64) -> f64 {
        self.0.iter().map(|sample| value(sample)).fold(f64::NAN, f64::max)
    }

    fn least(&self, value: impl Fn(&Sample) -> f64) -> f64 {
        self.0.iter().map(|sample| value(sample)).fold(f64::NAN, f64::min)
    }

    fn all(&self, is: impl Fn(&Sample) -> bool) -> bool {
        !self.0.is_empty() && self.0.iter().all(|sample| is(sample))
    }

    fn first(&self, is: impl Fn(&Sample) -> bool) -> Option<f64> {
        self.0.iter().find(|sample| is(sample)).map(|sample| sample.time_s)
    }
}

/// How long after `since_s` something was first so.
fn after(samples: &[Sample], since_s: f64, is: impl Fn(&Sample) -> bool) -> f64 {
    let phase = Phase::between(samples, since_s, f64::INFINITY);
    phase.first(is).map_or(f64::NAN, |time_s| time_s - since_s)
}

/// How far outside a zone the Sun is, in deg; negative within.
fn beyond_deg(sample: &Sample, zone_deg: &Vector2<f64>) -> f64 {
    outside_deg(&sample.sun_body_m(), zone_deg)
}

/// The same of a body direction.
fn outside_deg(body: &Vector, zone_deg: &Vector2<f64>) -> f64 {
    let [azimuth, elevation] = body_angles_deg(body);
    (azimuth.abs() - zone_deg[0]).max(elevation.abs() - zone_deg[1])
}

/// Whether the greatest errors of the rate along an axis and across it are small beside what is requested, and text.
fn turns_about(phase: &Phase<'_>, axis: &Vector, commanded_rad_s: f64) -> (bool, String) {
    let along = phase.greatest(|sample| (sample.rate_rad_s.dot(axis) - commanded_rad_s).abs());
    let aside = phase.greatest(|sample| across(&sample.rate_rad_s, axis).norm());
    let within = RATE * commanded_rad_s.abs();
    let percent = |error: f64| 100.0 * error / commanded_rad_s.abs();
    let text = format!(
        "{:.4} deg/s to {:.1e} % along, {:.1e} % across",
        commanded_rad_s.to_degrees(),
        percent(along),
        percent(aside),
    );
    (along <= within && aside <= within, text)
}

/// The Sun on the boresight at the end of a phase, and since when.
fn acquired(samples: &[Sample], from_s: f64, to_s: f64) -> (bool, String) {
    let off_deg = Phase::between(samples, to_s - SETTLED_S, to_s).greatest(sun_angle_deg);
    let start_deg = Phase::between(samples, from_s, from_s).greatest(sun_angle_deg);
    let last = samples.iter().rposition(|it| it.time_s <= to_s && sun_angle_deg(it) > ANGLE_DEG);
    let taken_s = last.map_or(f64::NAN, |k| samples[k].time_s - from_s);
    let text =
        format!("{start_deg:.1} deg off, {ANGLE_DEG} deg after {taken_s:.0} s, then {off_deg:.1e} deg");
    (off_deg <= ANGLE_DEG, text)
}

/// Inertial reference, then the Sun, are lost and found.
pub(super) fn attitude_lost(parameters: &Parameters, samples: &[Sample]) -> Vec<Check> {
    let limits = &parameters.limits;
    let mut checks = Vec::new();
    let mut check = |statement, found| checks.push((statement, found));
    let operational = |phase: Phase<'_>| {
        let off_deg = phase.greatest(plus_z_from_sun_deg);
        let holds = phase.all(|it| it.mode == parameters.operational) && off_deg < ANGLE_DEG;
        (holds, format!("+Z within {off_deg:.1e} deg of the Sun"))
    };

    let lost_s = TRACKER_FAILS_S + OUTAGE_S;
    check("Operational: every pointing option", operational(Phase::between(samples, 0.0, lost_s - 1.0)));
    let invalid_s = after(samples, 0.0, |sample| !sample.is_attitude_known);
    let demoted_s = after(samples, invalid_s, |sample| sample.mode == parameters.earth_acquisition);
    let holds = (invalid_s - lost_s).abs() <= DELAY_S && demoted_s <= DELAY_S;
    let found = format!("lost at {invalid_s:.0} s, demoted {demoted_s:.0} s later");
    check("inertial reference lost: Earth Acquisition", (holds, found));
    let first = Phase::between(samples, lost_s + DELAY_S, SUN_LOST_S);
    let holds = first.all(|it| it.command_kind == parameters.error_quaternion);
    check("quaternion error and rate instead of an attitude", (holds, format!("to {SUN_LOST_S:.0} s")));
    check("boresight to the Sun", acquired(samples, lost_s, SUN_LOST_S));
    let settled = Phase::between(samples, SUN_LOST_S - SETTLED_S, SUN_LOST_S);
    let turns = turns_about(&settled, &BORESIGHT, limits.earth_acquisition_rad_s);
    check("slow rotation about the Sun direction", turns);
    let search_s = after(samples, SUN_LOST_S, |sample| sample.command_kind == parameters.rate_only);
    let found = format!("{search_s:.0} s after the last Sun sensor failed");
    check("Sun lost: rate only", (search_s <= DELAY_S, found));
    let search_from_s = SUN_LOST_S + search_s;
    let search_to_s = search_from_s + 3.0 * limits.search_s;
    for (round, (statement, letter, axis)) in [
        ("about a first body axis for a duration", "X", Vector::x()),
        ("then about a second", "Y", Vector::y()),
        ("then about a third", "Z", Vector::z()),
    ]
    .into_iter()
    .enumerate()
    {
        let from_s = search_from_s + round as f64 * limits.search_s;
        let to_s = from_s + limits.search_s;
        let commanded = |sample: &Sample| sample.command_rate_rad_s.dot(&axis) == limits.search_rad_s;
        let seconds = Phase::between(samples, SUN_LOST_S, search_to_s - 1.0);
        let seconds = seconds.0.iter().filter(|sample| commanded(sample)).count();
        let whole = Phase::between(samples, from_s, to_s - 1.0).all(commanded);
        let end = Phase::between(samples, to_s - SETTLED_S, to_s - 1.0);
        let (turns, text) = turns_about(&end, &axis, limits.search_rad_s);
        check(statement, (whole && turns, format!("{letter} for {seconds} s, {text}")));
    }
    let again = Phase::between(samples, search_to_s, SUN_BACK_S);
    let holds = again.all(|it| it.command_rate_rad_s == Vector::new(limits.search_rad_s, 0.0, 0.0));
    check("cycling is repeated", (holds, format!("about X again to {SUN_BACK_S:.0} s")));
    let found_s = after(samples, SUN_BACK_S, |sample| sample.command_kind == parameters.error_quaternion);
    let found = format!("{found_s:.0} s after the Sun sensors work again");
    check("until a valid reading of the Sun", (found_s <= DELAY_S, found));
    check("boresight to the Sun again", acquired(samples, SUN_BACK_S, TRACKER_BACK_S));
    let known_s = after(samples, TRACKER_BACK_S, |sample| sample.is_attitude_known);
    let kept = Phase::between(samples, TRACKER_BACK_S, SAFE_HOLD_S)
        .all(|it| it.mode == parameters.earth_acquisition);
    let found =
        format!("attitude known {known_s:.0} s after the tracker works, mode kept to {SAFE_HOLD_S:.0} s");
    check("promotion only by ground command", (kept && known_s <= DELAY_S, found));
    let held = Phase::between(samples, SAFE_HOLD_S + DELAY_S, OPERATIONAL_S);
    let end = Phase::between(samples, OPERATIONAL_S - SETTLED_S, OPERATIONAL_S);
    let inside_deg = -end.greatest(|sample| beyond_deg(sample, &parameters.safe_hold_deg));
    let holds = held.all(|it| it.mode == parameters.safe_hold) && inside_deg >= 0.0;
    check("Safe Hold: strict Sun safety", (holds, format!("{inside_deg:.2} deg inside its zone")));
    let earth_deg = |it: &Sample| body_angles_deg(&it.q.inverse_transform_vector(&it.to_earth_m()))[1].abs();
    let (off_deg, links) = (end.greatest(earth_deg), end.all(|sample| sample.has_link));
    let link = if links { "kept" } else { "lost" };
    let found = format!("Earth within {off_deg:.1e} deg of the antennas' plane, link {link}");
    let holds = links && off_deg <= limits.beam_rad.to_degrees();
    check("an attitude that maintains communication with Earth", (holds, found));
    let off_deg = end.least(plus_z_from_sun_deg);
    let found = format!("+Z {off_deg:.1} deg from the commanded Sun");
    check("all other commands are ignored", (off_deg > 60.0, found));
    let stop_s = samples.last().map_or(f64::NAN, |sample| sample.time_s);
    let end = Phase::between(samples, stop_s - SETTLED_S, stop_s);
    check("Operational by ground command", operational(end));
    checks
}

fn plus_z_from_sun_deg(sample: &Sample) -> f64 {
    angle_rad(&Vector::z(), &sample.sun_body_m()).to_degrees()
}

/// The keep-in zone is put in force while the Sun is outside.
pub(super) fn zone_violated(parameters: &Parameters, samples: &[Sample]) -> Vec<Check> {
    let Parameters { limits, zone_deg, safe_hold_deg, .. } = parameters;
    let mut checks = Vec::new();
    let mut check = |statement, found| checks.push((statement, found));

    let stop_s = samples.last().map_or(f64::NAN, |sample| sample.time_s);
    let commanded = Phase::between(samples, ZONE_ON_S + DELAY_S, stop_s);
    let most_deg = commanded
        .greatest(|it| outside_deg(&it.command_q.inverse_transform_vector(&it.to_sun_m()), zone_deg));
    let kinds = commanded.all(|sample| sample.command_kind == parameters.attitude);
    let found = format!("at most {most_deg:.1e} deg outside");
    check("the command is forced into the zone", (kinds && most_deg < 1e-6, found));
    let least_deg = Phase::between(samples, 0.0, ZONE_ON_S).least(|it| beyond_deg(it, zone_deg));
    let sun_deg = Phase::between(samples, ZONE_ON_S, ZONE_ON_S).greatest(sun_angle_deg);
    let demoted_s = after(samples, ZONE_ON_S, |sample| sample.mode == parameters.safe_hold);
    let lowest = samples.iter().any(|sample| sample.mode == parameters.earth_acquisition);
    let in_time = (limits.persistence_s..=limits.persistence_s + DELAY_S).contains(&demoted_s);
    let holds = least_deg > limits.margin_rad.to_degrees() && in_time && !lowest;
    let found = format!("Sun {sun_deg:.1} deg from -Y, Safe Hold {demoted_s:.0} s later");
    check("a violation that persists demotes to the next lowest mode", (holds, found));
    let inside = |sample: &Sample| beyond_deg(sample, safe_hold_deg) <= 0.0;
    let back_s = after(samples, ZONE_ON_S, inside);
    let end = Phase::between(samples, PARDONED_S - SETTLED_S, PARDONED_S);
    let inside_deg = -end.greatest(|sample| beyond_deg(sample, safe_hold_deg));
    let stays = Phase::between(samples, ZONE_ON_S + back_s, PARDONED_S).all(inside);
    let found = format!("inside after {back_s:.0} s, then by {inside_deg:.2} deg");
    check("a safing turn to a Sun-safe attitude", (stays, found));
    let kept = Phase::between(samples, ZONE_ON_S + demoted_s, PARDONED_S);
    let holds = kept.all(|it| it.mode == parameters.safe_hold);
    check("promotion only by ground command", (holds, format!("Safe Hold to {PARDONED_S:.0} s")));
    let end = Phase::between(samples, stop_s - SETTLED_S, stop_s);
    let beyond = |sample: &Sample| beyond_deg(sample, zone_deg);
    let boundary_deg = end.least(beyond).abs().max(end.greatest(beyond).abs());
    let off_deg = end.least(plus_z_from_sun_deg);
    let held = end.all(|it| it.mode == parameters.operational && it.is_constrained);
    let found = format!("Sun within {boundary_deg:.1e} deg of the boundary, {off_deg:.1} deg from +Z");
    check("Operational: the valid attitude closest to the target", (held && boundary_deg < ANGLE_DEG, found));
    checks
}
