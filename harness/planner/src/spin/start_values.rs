//! The plan as start values of SpinPlant: what `run --set`, `pack --set` and a file's `[start]` take.

use std::fmt::Write;

use physics::spin::{forecast::Timing, train::Shape};

use super::{Firing, Task, TrainForecast};

/// The value of a variable, or of all elements of a vector.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Setting {
    /// A number in SI.
    Real(f64),
    /// A whole number.
    Integer(i32),
    /// An item's name, or any text.
    Text(String),
    /// A vector.
    Vector(Vec<f64>),
}

/// The item of `burn.plan` that a shape is, and the order of a taper.
pub(super) fn plan_item(shape: Shape) -> (&'static str, Option<u32>) {
    match shape {
        Shape::Uniform => ("uniform", None),
        Shape::Tapered { order } => ("tapered", Some(order)),
        Shape::Split => ("split", None),
    }
}

/// The item of `burn.timing`.
pub(super) fn timing_item(timing: Timing) -> &'static str {
    match timing {
        Timing::Clock => "clock",
        Timing::SunCrossing => "sunCrossing",
        Timing::TruePhase => "truePhase",
    }
}

/// Everything that the flight depends on and that the spacecraft's file does not say by itself.
pub(super) fn start_values(task: &Task, row: &TrainForecast) -> Vec<(&'static str, Setting)> {
    let train = &row.train;
    let (plan, order) = plan_item(train.shape);
    let whole = |count: u32| Setting::Integer(i32::try_from(count).unwrap_or(i32::MAX));
    let vector = |values: &[f64]| Setting::Vector(values.to_vec());
    let mut values = vec![
        ("inertia", vector(&task.body.moments_kg_m2)),
        ("productsOfInertia", vector(&task.body.products_kg_m2)),
        ("propellant.loaded", Setting::Real(task.body.propellant_kg)),
        ("spin.initialRate", Setting::Real(task.case.spin.rate_rad_s)),
        ("start.q", vector(&task.attitude().0)),
        ("start.nutation", Setting::Real(0.0)),
        ("burn.plan", Setting::Text(plan.to_owned())),
    ];
    values.extend(order.map(|order| ("burn.taperOrder", whole(order))));
    values.push(("burn.timing", Setting::Text(timing_item(task.case.timing).to_owned())));
    values.push(("burn.start", Setting::Real(0.0)));
    match &task.actuator.firing {
        Firing::Group(name) => values.push(("burn.group", Setting::Text(name.clone()))),
        Firing::Thruster { number, opposite } => {
            values.push(("burn.group", Setting::Text(String::new())));
            values.push(("burn.thruster", Setting::Integer(*number)));
            values.push(("burn.oppositeThruster", Setting::Integer(opposite.unwrap_or(0))));
        }
    }
    values.extend([
        ("burn.pulseWidth", Setting::Real(train.width_s(0))),
        ("burn.turnsPerPulse", Setting::Real(train.turns_per_pulse())),
        ("burn.count", whole(train.count)),
        ("burn.angle", Setting::Real(0.0)),
        ("burn.targetDirection", vector(task.geometry.burn_target_inertial().as_slice())),
        ("sun.direction", vector(task.geometry.sun_inertial.as_slice())),
    ]);
    values.extend(task.geometry.earth_inertial.map(|earth| ("earth.direction", vector(earth.as_slice()))));
    values
}

/// The `[start]` table of a spacecraft's file.
pub(crate) fn toml(values: &[(&'static str, Setting)]) -> String {
    let mut text = String::from("[start]\n");
    for (name, value) in values {
        let written = match value {
            Setting::Real(number) => format!("{number:?}"),
            Setting::Integer(number) => number.to_string(),
            Setting::Text(letters) => format!("{letters:?}"),
            Setting::Vector(numbers) => format!("{numbers:?}"),
        };
        let _ = writeln!(text, "\"{name}\" = {written}");
    }
    text
}

/// The same as options, quoted for a shell.
pub(crate) fn options(values: &[(&'static str, Setting)]) -> String {
    // The shortest form that is read back as the same number.
    let short = |number: &f64| {
        let written = format!("{number:?}");
        written.strip_suffix(".0").map_or(written.clone(), str::to_owned)
    };
    let one = |(name, value): &(&str, Setting)| {
        let written = match value {
            Setting::Real(number) => short(number),
            Setting::Integer(number) => number.to_string(),
            Setting::Text(letters) => letters.clone(),
            Setting::Vector(numbers) => numbers.iter().map(short).collect::<Vec<_>>().join(","),
        };
        let setting = format!("{name}={written}");
        let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "=.,+-_".contains(letter);
        if setting.chars().all(is_plain) {
            return format!("--set {setting}");
        }
        format!("--set '{}'", setting.replace('\'', "'\\''"))
    };
    values.iter().map(one).collect::<Vec<_>>().join(" ")
}
