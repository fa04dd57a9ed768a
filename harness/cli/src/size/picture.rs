//! The picture: dumps and propellant a year over the capacity of each wheel, a line a strategy.

use drawing::{Chart, DrawingError, Panel, Series};

use super::{
    flights::{Dumped, Sweep},
    sized::SizedSpacecraft,
    table::capacity,
};

/// As SVG text.
///
/// # Errors
/// Nothing to draw.
pub(super) fn svg(sized: &SizedSpacecraft, sweep: &Sweep) -> Result<String, DrawingError> {
    let of_strategies = |value: fn(&Dumped) -> f64| {
        let lines = sized.strategies.iter().map(move |strategy| {
            let own = sweep.dumped.iter().filter(|it| it.strategy == *strategy);
            Series::curve(strategy.clone(), own.map(|it| (capacity(sized, it), value(it))).collect())
        });
        lines.collect::<Vec<_>>()
    };
    let most = |value: fn(&Dumped) -> f64| sweep.dumped.iter().map(value).fold(0.0, f64::max);
    let panel = |label: &str, value: fn(&Dumped) -> f64| {
        // A year without dumps is a line along the axis.
        let most = most(value);
        let most = if most > 0.0 { 1.08 * most } else { 1.0 };
        Panel::new(label).with(of_strategies(value)).range(0.0, most)
    };
    let title = format!("{}: dumps by the wheels' capacity", sized.spacecraft.name);
    let x_label = if sized.spacecraft.wheels.is_empty() {
        "dump threshold [N·m·s]"
    } else {
        "capacity of each wheel [N·m·s], least-norm sharing"
    };
    let chart = Chart::new(title, x_label)
        .with([panel("dumps a year", |it| it.dumps), panel("propellant a year [kg]", |it| it.propellant_kg)]);
    drawing::svg(&[&chart])
}
