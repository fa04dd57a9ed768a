//! Attitudes by two axes and their targets as commands of the scenario generic, and their vectors.

use super::aimpoint::{aimpoint, external_roll};
use super::command::{
    AimpointCommand, AimpointOption, BodyRollCommand, BodyRollOption, BoresightCommand, BoresightOption,
    ExternalRollCommand, ExternalRollOption, PointingCommand, Scenario,
};
use super::law::PointingVectors;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::lighting::SubsolarMethod;
use crate::guidance::geometry::moving::fixed;
use crate::spacecraft::{AlignedAxes, PointingTarget, StarDirection, TargetItem};

/// Returns the command of the scenario generic that aligns one axis and constrains the other.
pub fn aligned_command(axes: &AlignedAxes) -> PointingCommand {
    PointingCommand {
        scenario: Some(Scenario::Generic),
        boresight: BoresightCommand {
            option: Some(BoresightOption::Vector),
            vector: axes.align.axis_body,
            ..BoresightCommand::default()
        },
        aimpoint: commands_toward(axes.align.target).0,
        body_roll: BodyRollCommand {
            option: Some(BodyRollOption::Vector),
            vector: axes.constrain.axis_body,
            ..BodyRollCommand::default()
        },
        external_roll: commands_toward(axes.constrain.target).1,
        ..PointingCommand::default()
    }
}

/// Vectors of that command; `None` where the target of `align` has no direction.
pub fn aligned_vectors(axes: &AlignedAxes, ephemeris: &EphemerisAtTime) -> Option<PointingVectors> {
    let (aim, _) = commands_toward(axes.align.target);
    let (_, roll) = commands_toward(axes.constrain.target);
    // No target is a point of the surface.
    let aimpoint = aimpoint(&aim, ephemeris, SubsolarMethod::default())?;
    Some(PointingVectors {
        boresight_body: fixed(axes.align.axis_body),
        aimpoint: aimpoint.toward,
        body_roll: fixed(axes.constrain.axis_body),
        external_roll: external_roll(&roll, ephemeris),
    })
}

/// A target as what one axis aims at and as what another is rolled toward.
fn commands_toward(target: PointingTarget) -> (AimpointCommand, ExternalRollCommand) {
    use {AimpointOption as Aim, ExternalRollOption as Roll};
    let (mut aim, mut roll) = (AimpointCommand::default(), ExternalRollCommand::default());
    let options = match (target.item, target.star) {
        (TargetItem::Nadir, _) => (Aim::Nadir, Roll::Planet),
        (TargetItem::Velocity, _) => (Aim::Velocity, Roll::Velocity),
        (TargetItem::OrbitNormal, _) => (Aim::OrbitNormal, Roll::OrbitNormal),
        (TargetItem::Sun, _) => (Aim::Sun, Roll::Sun),
        (TargetItem::Earth, _) => (Aim::Earth, Roll::Earth),
        (TargetItem::EclipticNorth, _) => (Aim::EclipticNorth, Roll::EclipticNorth),
        (TargetItem::Star, Some(StarDirection::Angles([right_ascension_rad, declination_rad]))) => {
            (aim.right_ascension_rad, aim.declination_rad) = (right_ascension_rad, declination_rad);
            (roll.right_ascension_rad, roll.declination_rad) = (right_ascension_rad, declination_rad);
            (Aim::RightAscensionDeclination, Roll::RightAscensionDeclination)
        }
        (TargetItem::Star, Some(StarDirection::Vector(vector))) => {
            (aim.vector, roll.vector) = (vector, vector);
            (Aim::Vector, Roll::Vector)
        }
        // Without a direction there is none to aim at.
        (TargetItem::Star, None) => (Aim::Vector, Roll::Vector),
    };
    (aim.option, roll.option) = (Some(options.0), Some(options.1));
    (aim, roll)
}

#[cfg(test)]
mod tests;
