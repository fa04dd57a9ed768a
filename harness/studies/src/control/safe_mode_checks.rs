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
use crate::verdict::{agrees, compared};
use drawing::Series;

/// Exchange and sample: what is seen at one second acts at the next and shows at the one after.
const DELAY_S: f64 = 3.0;
/// The end of a phase, in which what was commanded is to have come true, in s.
const SETTLED_S: f64 = 200.0;
/// Largest angle between a commanded and an actual direction then, in deg.
const ANGLE_DEG: f64 = 0.1;
/// Largest error of a rate then, as a share of it.
const RATE: f64 = 0.01;

/// A statement of the paper and whether it holds.
pub struct Check {
    /// The paper's, in short.
    pub statement: &'static str,
    /// What the flight shows.
    pub found: String,
    /// Whether it is so.
    pub holds: bool,
}

impl Check {
    /// Cells of the table.
    pub fn row(self, case: &str) -> Vec<String> {
        compared(&format!("{case} | {}", self.statement), self.found, agrees(self.holds))
    }
}

recorded! {
    /// Limits and rates of Guidance, as the FMU has them.
    pub struct Limits {
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
pub struct Parameters {
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
    pub fn read(both: &Loop) -> Result<Self, StudyError> {
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
    pub fn commanded_rates(&self) -> [Series; 2] {
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
fn turns_about(phase: &Phase<'_>, axis: &Vector, wanted_rad_s: f64) -> (bool, String) {
    let along = phase.greatest(|sample| (sample.rate_rad_s.dot(axis) - wanted_rad_s).abs());
    let aside = phase.greatest(|sample| across(&sample.rate_rad_s, axis).norm());
    let within = RATE * wanted_rad_s.abs();
    let percent = |error: f64| 100.0 * error / wanted_rad_s.abs();
    let text = format!(
        "{:.4} deg/s to {:.1e} % along, {:.1e} % across",
        wanted_rad_s.to_degrees(),
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
pub fn attitude_lost(parameters: &Parameters, samples: &[Sample]) -> Vec<Check> {
    let limits = &parameters.limits;
    let mut checks = Vec::new();
    let mut check =
        |statement, (holds, found): (bool, String)| checks.push(Check { statement, found, holds });

    let lost_s = TRACKER_FAILS_S + OUTAGE_S;
    let before = Phase::between(samples, 0.0, lost_s - 1.0);
    check("Operational: every pointing option", {
        let off_deg = before.greatest(plus_z_from_sun_deg);
        (
            before.all(|it| it.mode == parameters.operational) && off_deg < ANGLE_DEG,
            format!("+Z within {off_deg:.1e} deg of the Sun"),
        )
    });
    let invalid_s = after(samples, 0.0, |sample| !sample.is_attitude_known);
    let demoted_s = after(samples, invalid_s, |sample| sample.mode == parameters.earth_acquisition);
    check(
        "inertial reference lost: Earth Acquisition",
        (
            (invalid_s - lost_s).abs() <= DELAY_S && demoted_s <= DELAY_S,
            format!("lost at {invalid_s:.0} s, demoted {demoted_s:.0} s later"),
        ),
    );
    let first = Phase::between(samples, lost_s + DELAY_S, SUN_LOST_S);
    check(
        "quaternion error and rate instead of an attitude",
        (first.all(|it| it.command_kind == parameters.error_quaternion), format!("to {SUN_LOST_S:.0} s")),
    );
    check("boresight to the Sun", acquired(samples, lost_s, SUN_LOST_S));
    let settled = Phase::between(samples, SUN_LOST_S - SETTLED_S, SUN_LOST_S);
    check(
        "slow rotation about the Sun direction",
        turns_about(&settled, &BORESIGHT, limits.earth_acquisition_rad_s),
    );
    let search_s = after(samples, SUN_LOST_S, |sample| sample.command_kind == parameters.rate_only);
    check(
        "Sun lost: rate only",
        (search_s <= DELAY_S, format!("{search_s:.0} s after the last Sun sensor failed")),
    );
    for round in 0..3 {
        let (name, axis) = [
            ("about a first body axis for a duration", Vector::x()),
            ("then about a second", Vector::y()),
            ("then about a third", Vector::z()),
        ][round];
        let from_s = SUN_LOST_S + search_s + round as f64 * limits.search_s;
        let to_s = from_s + limits.search_s;
        let commanded = |sample: &Sample| sample.command_rate_rad_s.dot(&axis) == limits.search_rad_s;
        let seconds =
            Phase::between(samples, SUN_LOST_S, SUN_LOST_S + search_s + 3.0 * limits.search_s - 1.0);
        let seconds = seconds.0.iter().filter(|sample| commanded(sample)).count();
        let whole = Phase::between(samples, from_s, to_s - 1.0).all(commanded);
        let end = Phase::between(samples, to_s - SETTLED_S, to_s - 1.0);
        let (turns, text) = turns_about(&end, &axis, limits.search_rad_s);
        check(name, (whole && turns, format!("{} for {seconds} s, {text}", ["X", "Y", "Z"][round])));
    }
    let again = Phase::between(samples, SUN_LOST_S + search_s + 3.0 * limits.search_s, SUN_BACK_S);
    check(
        "cycling is repeated",
        (
            again.all(|it| it.command_rate_rad_s == Vector::new(limits.search_rad_s, 0.0, 0.0)),
            format!("about X again to {SUN_BACK_S:.0} s"),
        ),
    );
    let found_s = after(samples, SUN_BACK_S, |sample| sample.command_kind == parameters.error_quaternion);
    check(
        "until a valid reading of the Sun",
        (found_s <= DELAY_S, format!("{found_s:.0} s after the Sun sensors work again")),
    );
    check("boresight to the Sun again", acquired(samples, SUN_BACK_S, TRACKER_BACK_S));
    let known_s = after(samples, TRACKER_BACK_S, |sample| sample.is_attitude_known);
    let kept = Phase::between(samples, TRACKER_BACK_S, SAFE_HOLD_S)
        .all(|it| it.mode == parameters.earth_acquisition);
    check(
        "promotion only by ground command",
        (
            kept && known_s <= DELAY_S,
            format!("attitude known {known_s:.0} s after the tracker works, mode kept to {SAFE_HOLD_S:.0} s"),
        ),
    );
    let held = Phase::between(samples, SAFE_HOLD_S + DELAY_S, OPERATIONAL_S);
    let end = Phase::between(samples, OPERATIONAL_S - SETTLED_S, OPERATIONAL_S);
    check("Safe Hold: strict Sun safety", {
        let inside_deg = -end.greatest(|sample| beyond_deg(sample, &parameters.safe_hold_deg));
        (
            held.all(|it| it.mode == parameters.safe_hold) && inside_deg >= 0.0,
            format!("{inside_deg:.2} deg inside its zone"),
        )
    });
    check("an attitude that maintains communication with Earth", {
        let off_deg =
            end.greatest(|it| body_angles_deg(&it.q.inverse_transform_vector(&it.to_earth_m()))[1].abs());
        let links = end.all(|sample| sample.has_link);
        (
            links && off_deg <= limits.beam_rad.to_degrees(),
            format!(
                "Earth within {off_deg:.1e} deg of the antennas' plane, link {}",
                if links { "kept" } else { "lost" }
            ),
        )
    });
    check("all other commands are ignored", {
        let off_deg = end.least(plus_z_from_sun_deg);
        (off_deg > 60.0, format!("+Z {off_deg:.1} deg from the commanded Sun"))
    });
    let stop_s = samples.last().map_or(f64::NAN, |sample| sample.time_s);
    let end = Phase::between(samples, stop_s - SETTLED_S, stop_s);
    check("Operational by ground command", {
        let off_deg = end.greatest(plus_z_from_sun_deg);
        (
            end.all(|it| it.mode == parameters.operational) && off_deg < ANGLE_DEG,
            format!("+Z within {off_deg:.1e} deg of the Sun"),
        )
    });
    checks
}

fn plus_z_from_sun_deg(sample: &Sample) -> f64 {
    angle_rad(&Vector::z(), &sample.sun_body_m()).to_degrees()
}

/// The keep-in zone is put in force while the Sun is outside.
pub fn zone_violated(parameters: &Parameters, samples: &[Sample]) -> Vec<Check> {
    let limits = &parameters.limits;
    let mut checks = Vec::new();
    let mut check =
        |statement, (holds, found): (bool, String)| checks.push(Check { statement, found, holds });

    let stop_s = samples.last().map_or(f64::NAN, |sample| sample.time_s);
    let commanded = Phase::between(samples, ZONE_ON_S + DELAY_S, stop_s);
    check("the command is forced into the zone", {
        let most_deg = commanded.greatest(|sample| {
            outside_deg(&sample.command_q.inverse_transform_vector(&sample.to_sun_m()), &parameters.zone_deg)
        });
        let kinds = commanded.all(|sample| sample.command_kind == parameters.attitude);
        (kinds && most_deg < 1e-6, format!("at most {most_deg:.1e} deg outside"))
    });
    let least_deg = Phase::between(samples, 0.0, ZONE_ON_S).least(|it| beyond_deg(it, &parameters.zone_deg));
    let sun_deg = Phase::between(samples, ZONE_ON_S, ZONE_ON_S).greatest(sun_angle_deg);
    let demoted_s = after(samples, ZONE_ON_S, |sample| sample.mode == parameters.safe_hold);
    let lowest = samples.iter().any(|sample| sample.mode == parameters.earth_acquisition);
    check(
        "a violation that persists demotes to the next lowest mode",
        (
            least_deg > limits.margin_rad.to_degrees()
                && (limits.persistence_s..=limits.persistence_s + DELAY_S).contains(&demoted_s)
                && !lowest,
            format!("Sun {sun_deg:.1} deg from -Y, Safe Hold {demoted_s:.0} s later"),
        ),
    );
    let inside = |sample: &Sample| beyond_deg(sample, &parameters.safe_hold_deg) <= 0.0;
    let back_s = after(samples, ZONE_ON_S, inside);
    check("a safing turn to a Sun-safe attitude", {
        let end = Phase::between(samples, PARDONED_S - SETTLED_S, PARDONED_S);
        let inside_deg = -end.greatest(|sample| beyond_deg(sample, &parameters.safe_hold_deg));
        let stays = Phase::between(samples, ZONE_ON_S + back_s, PARDONED_S).all(inside);
        (stays, format!("inside after {back_s:.0} s, then by {inside_deg:.2} deg"))
    });
    let kept = Phase::between(samples, ZONE_ON_S + demoted_s, PARDONED_S);
    check(
        "promotion only by ground command",
        (kept.all(|it| it.mode == parameters.safe_hold), format!("Safe Hold to {PARDONED_S:.0} s")),
    );
    let end = Phase::between(samples, stop_s - SETTLED_S, stop_s);
    check("Operational: the valid attitude closest to the target", {
        let beyond = |sample: &Sample| beyond_deg(sample, &parameters.zone_deg);
        let [least_deg, most_deg] = [end.least(beyond), end.greatest(beyond)];
        let off_deg = end.least(plus_z_from_sun_deg);
        (
            end.all(|it| it.mode == parameters.operational && it.is_constrained)
                && least_deg.abs().max(most_deg.abs()) < ANGLE_DEG,
            format!(
                "Sun within {:.1e} deg of the boundary, {off_deg:.1} deg from +Z",
                least_deg.abs().max(most_deg.abs())
            ),
        )
    });
    checks
}
