//! Meaning of a continuous input for interpolation: attitude, position with velocity, angle.
//!
//! The model description tells it by names and units alone; annotations of the FMU can take the place of this file.

use std::f64::consts::TAU;

use model_description::{Description, ScalarVariable, value};

use super::interpolation::Circle;

/// The vector that element 1 of a quaternion belongs to, such as `command.q`, and that of its body rate, such as `command.rate`.
pub(super) fn quaternion<'d>(
    description: &Description,
    variable: &'d ScalarVariable,
) -> Option<(&'d str, Option<String>)> {
    let vector = variable.name.strip_suffix("[1]")?;
    let (before, last) = split(vector);
    let says = |text: &String| text.to_lowercase().contains("quaternion");
    let is_one = last == "q" || variable.description.as_ref().is_some_and(says);
    let is_bare = value::unit(description, variable).is_none_or(|unit| unit == "1");
    (is_one && is_bare).then(|| (vector, (last == "q").then(|| format!("{before}rate"))))
}

/// Whether a variable is an angular rate in rad/s.
pub(super) fn is_angular_rate(description: &Description, variable: &ScalarVariable) -> bool {
    value::unit(description, variable) == Some("rad/s")
}

/// The velocity beside a position: of `orbit.position[1]` it is `orbit.velocity[1]`.
pub(super) fn velocity_name(variable: &ScalarVariable) -> Option<String> {
    let (before, last) = split(&variable.name);
    Some(format!("{before}velocity{}", last.strip_prefix("position")?))
}

/// Whether one variable is in the unit of the other for each second.
pub(super) fn is_rate_of(description: &Description, rate: &ScalarVariable, of: &ScalarVariable) -> bool {
    let unit = |variable| value::unit(description, variable);
    unit(of).is_some_and(|of| unit(rate) == Some(&format!("{of}/s")))
}

/// The circle of an angle: a Real whose unit measures one.
pub(super) fn angle(description: &Description, variable: &ScalarVariable) -> Option<Circle> {
    let unit = value::unit(description, variable)?;
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

/// Splits a name into its prefix up to the last dot, and the last segment.
fn split(name: &str) -> (&str, &str) {
    name.split_at(name.rfind('.').map_or(0, |dot| dot + 1))
}
