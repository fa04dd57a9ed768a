//! Attitudes by two axes and their targets as commands of the scenario generic, and their vectors.

use super::aimpoint::aimpoint;
use super::command::{
    AimpointCommand, AimpointOption, BodyRollCommand, BodyRollOption, BoresightCommand, BoresightOption,
    ExternalRollCommand, ExternalRollOption, PointingCommand, Scenario,
};
use super::law::PointingVectors;
use super::roll::external_roll;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::lighting::SubsolarMethod;
use crate::guidance::geometry::moving::fixed;
use crate::spacecraft::{AlignedAxes, PointingTarget};

/// Returns the command of the scenario generic that aligns one axis and constrains the other.
pub fn aligned_command(axes: &AlignedAxes) -> PointingCommand {
    PointingCommand {
        scenario: Some(Scenario::Generic),
        boresight: BoresightCommand {
            option: Some(BoresightOption::Vector),
            vector: axes.align.axis_body,
            ..BoresightCommand::default()
        },
        aimpoint: aimpoint_at(axes.align.target),
        body_roll: BodyRollCommand {
            option: Some(BodyRollOption::Vector),
            vector: axes.constrain.axis_body,
            ..BodyRollCommand::default()
        },
        external_roll: roll_toward(axes.constrain.target),
        ..PointingCommand::default()
    }
}

/// Vectors of that command; `None` where the target of `align` has no direction.
pub fn aligned_vectors(axes: &AlignedAxes, ephemeris: &EphemerisAtTime) -> Option<PointingVectors> {
    // No target is a point of the surface.
    let aimpoint = aimpoint(&aimpoint_at(axes.align.target), ephemeris, SubsolarMethod::default())?;
    Some(PointingVectors {
        boresight_body: fixed(axes.align.axis_body),
        aimpoint: aimpoint.toward,
        body_roll: fixed(axes.constrain.axis_body),
        external_roll: external_roll(&roll_toward(axes.constrain.target), ephemeris),
    })
}

fn aimpoint_at(target: PointingTarget) -> AimpointCommand {
    let option = |option| AimpointCommand { option: Some(option), ..AimpointCommand::default() };
    match target {
        PointingTarget::Nadir => option(AimpointOption::Nadir),
        PointingTarget::Velocity => option(AimpointOption::Velocity),
        PointingTarget::OrbitNormal => option(AimpointOption::OrbitNormal),
        PointingTarget::Sun => option(AimpointOption::Sun),
        PointingTarget::Earth => option(AimpointOption::Earth),
        PointingTarget::EclipticNorth => option(AimpointOption::EclipticNorth),
        PointingTarget::Inertial(vector) => AimpointCommand { vector, ..option(AimpointOption::Vector) },
        PointingTarget::Star { right_ascension_rad, declination_rad } => AimpointCommand {
            right_ascension_rad,
            declination_rad,
            ..option(AimpointOption::RightAscensionDeclination)
        },
    }
}

fn roll_toward(target: PointingTarget) -> ExternalRollCommand {
    let option = |option| ExternalRollCommand { option: Some(option), ..ExternalRollCommand::default() };
    match target {
        PointingTarget::Nadir => option(ExternalRollOption::Planet),
        PointingTarget::Velocity => option(ExternalRollOption::Velocity),
        PointingTarget::OrbitNormal => option(ExternalRollOption::OrbitNormal),
        PointingTarget::Sun => option(ExternalRollOption::Sun),
        PointingTarget::Earth => option(ExternalRollOption::Earth),
        PointingTarget::EclipticNorth => option(ExternalRollOption::EclipticNorth),
        PointingTarget::Inertial(vector) => {
            ExternalRollCommand { vector, ..option(ExternalRollOption::Vector) }
        }
        PointingTarget::Star { right_ascension_rad, declination_rad } => ExternalRollCommand {
            right_ascension_rad,
            declination_rad,
            ..option(ExternalRollOption::RightAscensionDeclination)
        },
    }
}

#[cfg(test)]
mod tests;
