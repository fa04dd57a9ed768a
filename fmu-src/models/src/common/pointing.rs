//! Attitudes by name: parameters, and their start values by a spacecraft's file.

use fmi_export::{Choice, Failure, Real, RealVector, Values, Variables};
use nalgebra::Vector3;
use physics::enumeration::Enumerated;
use physics::guidance;
use physics::guidance::constraints::keep_in::KeepIn;
use physics::guidance::pointing::command;
use physics::spacecraft::{
    AlignedAxes, AttitudeName, AttitudePart, AttitudeRefusal, NamedAttitude, Panel, PointingSettings,
    Spacecraft, StarDirection, TargetItem, TargetedAxis, panels_need_yaw_steering,
};

use super::choices::{PointingTarget as TargetChoice, ScienceRule};

/// Start values of a named attitude by a spacecraft's file.
#[derive(Clone, Copy, Debug, Default)]
pub struct AttitudeDefaults {
    /// The file's `[pointing]`.
    pub pointing: Option<PointingSettings>,
    /// Whether about a planet the panels need yaw steering, and no keep-in zone says where the Sun stands.
    needs_yaw_steering: bool,
}

impl AttitudeDefaults {
    /// The defaults by a spacecraft's file.
    pub fn new(spacecraft: &Spacecraft) -> Self {
        let needs_yaw_steering =
            spacecraft.sun_keep_in.is_none() && panels_need_yaw_steering(&spacecraft.panels);
        Self { pointing: spacecraft.pointing, needs_yaw_steering }
    }

    /// The rule about a body.
    pub fn rule(&self, is_about_sun: bool) -> ScienceRule {
        match self.pointing.map(|pointing| pointing.attitude) {
            None if self.needs_yaw_steering && !is_about_sun => ScienceRule::YawSteering,
            None => ScienceRule::Nadir,
            Some(NamedAttitude::Named(AttitudeName::Lvlh)) => ScienceRule::Lvlh,
            Some(NamedAttitude::Named(AttitudeName::YawSteering)) => ScienceRule::YawSteering,
            Some(NamedAttitude::Named(AttitudeName::SunPointing)) => ScienceRule::SunPointing,
            Some(NamedAttitude::Inertial(_)) => ScienceRule::Inertial,
            Some(NamedAttitude::Aligned(_)) => ScienceRule::Aligned,
        }
    }

    /// The quaternion.
    fn q(&self) -> [f64; 4] {
        match self.pointing.map(|pointing| pointing.attitude) {
            Some(NamedAttitude::Inertial(q)) => q,
            _ => [0.0, 0.0, 0.0, 1.0],
        }
    }

    /// Axes and targets; those of lvlh unless the file has its own.
    fn axes(&self) -> AlignedAxes {
        match self.pointing.map(|pointing| pointing.attitude) {
            Some(NamedAttitude::Aligned(axes)) => axes,
            _ => AlignedAxes::LVLH,
        }
    }

    /// Rate of turns, in rad/s.
    pub fn slew_rate_rad_s(&self) -> f64 {
        self.pointing.and_then(|pointing| pointing.slew_rate_rad_s).unwrap_or(0.0)
    }
}

/// A body axis and its target.
#[derive(Variables)]
#[variables(setup = TargetedAxis)]
pub struct TargetedAxisVariables {
    /// Body-frame components, of any length.
    #[parameter(unit = "1", start = setup.axis_body.into())]
    pub axis: RealVector<3>,
    /// The target; nadir is refused about the Sun.
    #[parameter(start = TargetChoice(setup.target.item))]
    pub target: Choice<TargetChoice>,
    /// Right ascension of a star.
    #[parameter(unit = "rad", display = "deg", min = command::BACK_TURN_RAD, max = command::FULL_TURN_RAD, start = star_rad(setup)[0])]
    pub right_ascension: Real,
    /// Declination of a star.
    #[parameter(unit = "rad", display = "deg", min = command::DOWN_ANGLE_RAD, max = command::RIGHT_ANGLE_RAD, start = star_rad(setup)[1])]
    pub declination: Real,
}

/// Right ascension and declination of an axis's star, in rad; 0 without one.
fn star_rad(axis: &TargetedAxis) -> [f64; 2] {
    match axis.target.star {
        Some(StarDirection::Angles(star_rad)) => star_rad,
        _ => [0.0; 2],
    }
}

impl TargetedAxisVariables {
    fn read(&self, values: &Values) -> TargetedAxis {
        let star_rad = [self.right_ascension, self.declination].map(|angle| values.real(angle));
        TargetedAxis {
            axis_body: Vector3::from(values.vector(self.axis)),
            target: values.choice(self.target).0.target(star_rad),
        }
    }
}

/// Numbers of the rules inertial and aligned.
#[derive(Variables)]
#[variables(setup = AttitudeDefaults)]
pub struct NamedAttitudeVariables {
    /// Attitude of the rule inertial: quaternion, scalar last, from EME2000 to the body frame; a norm off 1 by more than 1e-3 is
    /// refused.
    #[parameter(unit = "1", start = setup.q())]
    pub attitude: RealVector<4>,
    #[group(setup = &setup.axes().align)]
    pub align: TargetedAxisVariables,
    #[group(setup = &setup.axes().constrain)]
    pub constrain: TargetedAxisVariables,
}

/// Surroundings that a rule of science is read for.
#[derive(Clone, Copy)]
pub struct RuleContext<'a> {
    /// Whether the orbit's centre is the Sun.
    pub is_about_sun: bool,
    /// The spacecraft's panels.
    pub panels: &'a [Panel],
    /// Zone that keeps the Sun, where one is in force.
    pub zone: Option<KeepIn>,
}

impl NamedAttitudeVariables {
    /// The law of a named rule; `None` of the others.
    ///
    /// # Errors
    /// Numbers that give no attitude, panels or a centre that the rule does not go with.
    pub fn read(
        &self,
        values: &Values,
        rule: ScienceRule,
        context: &RuleContext<'_>,
    ) -> Result<Option<guidance::ScienceRule>, Failure> {
        let [align, constrain] = [&self.align, &self.constrain].map(|axis| axis.read(values));
        let attitude = match rule {
            ScienceRule::Scaled | ScienceRule::Nadir | ScienceRule::FixedToSunLine => return Ok(None),
            ScienceRule::Lvlh => NamedAttitude::Named(AttitudeName::Lvlh),
            ScienceRule::YawSteering => NamedAttitude::Named(AttitudeName::YawSteering),
            ScienceRule::SunPointing => NamedAttitude::Named(AttitudeName::SunPointing),
            ScienceRule::Inertial => NamedAttitude::Inertial(values.vector(self.attitude)),
            ScienceRule::Aligned => NamedAttitude::Aligned(AlignedAxes { align, constrain }),
        };
        let axes = attitude.axes(context.panels).map_err(|refusal| refused(&refusal))?;
        if context.is_about_sun && axes.needs_planet() {
            let (name, found) = match attitude {
                NamedAttitude::Named(AttitudeName::Lvlh) => ("scienceRule", "lvlh"),
                NamedAttitude::Named(AttitudeName::YawSteering) => ("scienceRule", "yawSteering"),
                _ if align.target.item == TargetItem::Nadir => ("align.target", TargetItem::Nadir.name()),
                _ => ("constrain.target", TargetItem::Nadir.name()),
            };
            return Err(Failure::new(format!(
                "guided.{name}: found {found} about the Sun, allowed: what needs no planet, as guided.scienceRule sunPointing, or a \
                 planet as the orbit's centre"
            )));
        }
        Ok(Some(guidance::ScienceRule::Aligned { axes, zone: context.zone }))
    }
}

fn refused(refusal: &AttitudeRefusal) -> Failure {
    let name = match refusal.part {
        AttitudePart::Name => "scienceRule",
        AttitudePart::Quaternion => "attitude",
        AttitudePart::AlignAxis => "align.axis",
        AttitudePart::ConstrainAxis => "constrain.axis",
        AttitudePart::ConstrainTarget => "constrain.target",
    };
    Failure::new(format!("guided.{name}: {refusal}"))
}
