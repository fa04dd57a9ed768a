//! Attitude by name, by a quaternion or by two axes and their targets: its table in the file, and the reading of it.

use super::panel::Panel;
use super::part_reader::PartReader;
use super::pointing::{
    AlignedAxes, AttitudeName, AttitudePart, AttitudeRefusal, NamedAttitude, PointingSettings, TargetItem,
    TargetedAxis,
};
use super::start::StartEntry;
use crate::toml::{NotNegative, Place, Point, QuarterTurnEither, TurnEither, tables};

tables! {
/// How the spacecraft stands while it observes, by a name, a quaternion, or two axes and their targets: the start values of
/// `guided.scienceRule`, `guided.attitude`, `guided.align`, `guided.constrain` and `guided.slewRate`, which `[start]` does not have
/// beside it. With it `guided.phase` is orbit by default.
struct PointingDescription {
    attitude: Option<AttitudeName>,
    /// Quaternion from EME2000 to the body, scalar last.
    quaternion: Option<[f64; 4]>,
    align: Option<TargetedAxisDescription>,
    constrain: Option<TargetedAxisDescription>,
    star: Option<StarDescription>,
    /// Greatest rate of turns, in deg/s; 0 is at once.
    slew_rate_deg_s: Option<NotNegative>,
} rules {
    Either attitude quaternion => align constrain: "several attitudes",
        "one of them: `attitude`, `quaternion`, or `align` and `constrain`";
    AnyOf attitude quaternion align constrain: "no attitude", "`attitude`, `quaternion`, or `align` and `constrain`";
}

/// A body axis and its target: that of `align` exactly, that of `constrain` as near as possible.
struct TargetedAxisDescription {
    /// Body frame, of any length.
    axis as axis_body: Point,
    /// The target.
    to: TargetItem,
}

/// Direction in EME2000 of `to = "star"`.
struct StarDescription {
    /// Right ascension, in deg.
    right_ascension_deg as right_ascension_rad: TurnEither,
    /// Declination, in deg.
    declination_deg as declination_rad: QuarterTurnEither,
}
}

/// Variables of an attitude, which `[start]` does not have beside `[pointing]`.
const SAME_IN_START: [&str; 4] =
    ["guided.scienceRule", "guided.attitude", "guided.align.", "guided.constrain."];

/// Reads the attitude.
pub(super) fn pointing(
    part: &PartReader<'_>,
    description: &PointingDescription,
    start: &[StartEntry],
    panels: &[Panel],
) -> Option<PointingSettings> {
    let PointingDescription { attitude, quaternion, align, constrain, star, slew_rate_deg_s } = description;
    let slew_rate = slew_rate_deg_s.map(|_| "guided.slewRate");
    let is_same = |it: &&StartEntry| {
        !it.is_fixed && SAME_IN_START.iter().copied().chain(slew_rate).any(|name| it.name.starts_with(name))
    };
    if let Some(entry) = start.iter().find(is_same) {
        let allowed = format!("one of both: [pointing], or {} in [start]", entry.name);
        part.report(format!("[pointing] beside {}", entry.key), allowed);
    }
    let attitude = match (attitude, quaternion, align, constrain) {
        (Some(named), None, None, None) => Some(NamedAttitude::Named(*named)),
        (None, Some(q), None, None) => Some(NamedAttitude::Inertial(*q)),
        (None, None, Some(align), Some(constrain)) => aligned(part, [align, constrain], star.as_ref()),
        (None, None, Some(_), None) | (None, None, None, Some(_)) => {
            if !["attitude", "quaternion", "align", "constrain"].iter().any(|key| part.key(key).is_stand_in())
            {
                let lacking = if align.is_none() { "align" } else { "constrain" };
                part.report_lack(lacking, "both `align` and `constrain`, or neither");
            }
            None
        }
        // Several attitudes or none, which the rules report.
        _ => None,
    }?;
    axes(part, &attitude, panels, [&part.key("attitude"), &part.key("quaternion")]);
    Some(PointingSettings {
        attitude,
        slew_rate_rad_s: slew_rate_deg_s.map(|rate_deg_s| rate_deg_s.0.to_radians()),
    })
}

/// Two axes and their targets in a table at `at`, the star of `to = "star"` beside them.
pub(crate) fn aligned(
    at: &Place<'_>,
    [align, constrain]: [&TargetedAxisDescription; 2],
    star: Option<&StarDescription>,
) -> Option<NamedAttitude> {
    let targets = [align.to, constrain.to];
    match star {
        Some(_) if !targets.contains(&TargetItem::Star) => {
            at.key("star").report("a star", "no such key: neither axis is turned to a star");
        }
        None if targets.contains(&TargetItem::Star) => {
            at.report_lack("star", "`star = { right_ascension_deg, declination_deg }` for `to = \"star\"`");
            return None;
        }
        _ => {}
    }
    let star_rad = star.map_or([0.0; 2], |star| [star.right_ascension_rad(), star.declination_rad()]);
    let [align, constrain] = [align, constrain]
        .map(|given| TargetedAxis { axis_body: given.axis_body(), target: given.to.target(star_rad) });
    Some(NamedAttitude::Aligned(AlignedAxes { align, constrain }))
}

/// Axes of an attitude on a spacecraft with these panels, in a table at `at`, its name and its quaternion at these places; reports an
/// attitude that it does not have.
pub(crate) fn axes(
    at: &Place<'_>,
    attitude: &NamedAttitude,
    panels: &[Panel],
    [name, quaternion]: [&Place<'_>; 2],
) -> Option<AlignedAxes> {
    let report = |refusal: AttitudeRefusal| {
        let place = match refusal.part {
            AttitudePart::Name => name.clone(),
            AttitudePart::Quaternion => quaternion.clone(),
            AttitudePart::AlignAxis => at.key("align").key("axis"),
            AttitudePart::ConstrainAxis => at.key("constrain").key("axis"),
            AttitudePart::ConstrainTarget => at.key("constrain").key("to"),
        };
        place.report(refusal.found, refusal.allowed);
    };
    attitude.axes(panels).map_err(report).ok()
}
