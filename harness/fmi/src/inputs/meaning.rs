//! Meaning of a continuous input for interpolation: attitude, position with velocity, angle, as the FMU annotates it; angles by
//! their unit too.

use std::f64::consts::TAU;

use model_description::{Annotation, Description, InterpolationKind, ScalarVariable, value};

use super::interpolation::Circle;

/// The vector that element 1 of a quaternion belongs to, such as `command.q`, and that of its body rate, such as `command.rate`.
pub(super) fn quaternion(variable: &ScalarVariable) -> Option<(&str, Option<&str>)> {
    let annotation = interpolated(variable, InterpolationKind::Attitude)?;
    Some((variable.name.strip_suffix("[1]")?, annotation.rate.as_deref()))
}

/// The velocity of a position.
pub(super) fn velocity_name(variable: &ScalarVariable) -> Option<&str> {
    interpolated(variable, InterpolationKind::Position)?.rate.as_deref()
}

fn interpolated(variable: &ScalarVariable, kind: InterpolationKind) -> Option<&Annotation> {
    variable.annotation.as_deref().filter(|it| it.interpolation == Some(kind))
}

/// Whether a variable is an angular rate in rad/s.
pub(super) fn is_angular_rate(description: &Description, variable: &ScalarVariable) -> bool {
    value::unit(description, variable) == Some("rad/s")
}

/// Whether one variable is in the unit of the other for each second.
pub(super) fn is_rate_of(description: &Description, rate: &ScalarVariable, of: &ScalarVariable) -> bool {
    let unit = |variable| value::unit(description, variable);
    unit(of).is_some_and(|of| unit(rate) == Some(&format!("{of}/s")))
}

/// The circle of an angle: a Real whose unit measures one, or without a unit one in rad that is annotated as such.
pub(super) fn angle(description: &Description, variable: &ScalarVariable) -> Option<Circle> {
    let unit = value::unit(description, variable)
        .or_else(|| interpolated(variable, InterpolationKind::Angle).map(|_| "rad"))?;
    let base = description.units.iter().find(|it| it.name == unit).and_then(|it| it.base);
    let turn = match base {
        Some(base) if base.exponents().iter().all(|(of, it)| *it == i32::from(*of == "rad")) => {
            TAU / base.factor
        }
        None if unit == "rad" => TAU,
        _ => return None,
    };
    let (min, max) = value::limits(description, variable);
    Some(Circle { turn, min: min.unwrap_or(f64::NEG_INFINITY), max: max.unwrap_or(f64::INFINITY) })
}
