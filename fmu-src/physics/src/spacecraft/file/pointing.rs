//! Attitude by name, by a quaternion or by two axes and their targets, from its description.

use super::describe_operation::{PointingDescription, StarDescription, TargetedAxisDescription};
use super::part_reader::PartReader;
use crate::spacecraft::panel::Panel;
use crate::spacecraft::pointing::{
    AlignedAxes, AttitudePart, NamedAttitude, PointingSettings, TargetItem, TargetedAxis,
};
use crate::spacecraft::start::StartEntry;
use crate::toml::{Checker, KeyPath};

/// Variables of an attitude, which `[start]` does not have beside `[pointing]`.
const SAME_IN_START: [&str; 4] =
    ["guided.scienceRule", "guided.attitude", "guided.align.", "guided.constrain."];

pub(crate) fn pointing(
    part: &mut PartReader<'_, '_>,
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
        part.check.report(&part.at, format!("[pointing] beside {}", entry.key), allowed);
    }
    let given = [attitude.is_some(), quaternion.is_some(), align.is_some() || constrain.is_some()];
    let has_stand_in =
        ["attitude", "quaternion", "align", "constrain"].iter().any(|key| part.is_stand_in(key));
    let attitude = match (attitude, quaternion, align, constrain) {
        _ if given.iter().filter(|it| **it).count() > 1 => {
            let allowed = "one of them: `attitude`, `quaternion`, or `align` and `constrain`";
            part.check.push(&part.at, "several attitudes", allowed);
            None
        }
        (Some(named), ..) => Some((*named).into()),
        (_, Some(q), ..) => Some(NamedAttitude::Inertial(*q)),
        (_, _, Some(align), Some(constrain)) => {
            aligned(part.check, &part.at, [align, constrain], star.as_ref())
        }
        _ if has_stand_in => None,
        (_, _, None, None) => {
            let allowed = "`attitude`, `quaternion`, or `align` and `constrain`";
            part.check.push(&part.at, "no attitude", allowed);
            None
        }
        (_, _, align, _) => {
            let lacking = if align.is_none() { "align" } else { "constrain" };
            part.check.report_lack(&part.at, lacking, "both `align` and `constrain`, or neither");
            None
        }
    }?;
    check(part.check, &part.at, &attitude, panels);
    Some(PointingSettings {
        attitude,
        slew_rate_rad_s: slew_rate_deg_s.map(|rate_deg_s| rate_deg_s.0.to_radians()),
    })
}

/// Two axes and their targets in a table at `at`, the star of `to = "star"` beside them.
pub(crate) fn aligned(
    check: &mut Checker<'_>,
    at: &KeyPath,
    [align, constrain]: [&TargetedAxisDescription; 2],
    star: Option<&StarDescription>,
) -> Option<NamedAttitude> {
    let targets = [align.to, constrain.to];
    match star {
        Some(_) if !targets.contains(&TargetItem::Star) => {
            check.report(&at.key("star"), "a star", "no such key: neither axis is turned to a star");
        }
        None if targets.contains(&TargetItem::Star) => {
            check.report_lack(
                at,
                "star",
                "`star = { right_ascension_deg, declination_deg }` for `to = \"star\"`",
            );
            return None;
        }
        _ => {}
    }
    let star_rad = star.map_or([0.0; 2], |star| [star.right_ascension_rad(), star.declination_rad()]);
    let [align, constrain] = [align, constrain]
        .map(|given| TargetedAxis { axis_body: given.axis_body(), target: given.to.target(star_rad) });
    Some(NamedAttitude::Aligned(AlignedAxes { align, constrain }))
}

/// Reports an attitude that a spacecraft with these panels does not have, in a table at `at`.
pub(crate) fn check(check: &mut Checker<'_>, at: &KeyPath, attitude: &NamedAttitude, panels: &[Panel]) {
    let Err(refusal) = attitude.axes(panels) else { return };
    let place = match refusal.part {
        AttitudePart::Name => at.key("attitude"),
        AttitudePart::Quaternion => at.key("quaternion"),
        AttitudePart::AlignAxis => at.key("align").key("axis"),
        AttitudePart::ConstrainAxis => at.key("constrain").key("axis"),
        AttitudePart::ConstrainTarget => at.key("constrain").key("to"),
    };
    check.report(&place, refusal.found, refusal.allowed);
}
