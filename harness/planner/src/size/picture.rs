//! The picture: dumps and propellant a year over the capacity of each wheel, a line a strategy.

use drawing::{Chart, DrawingError, Panel, Series};

use super::{
    flights::{Dumped, Sweep},
    sized::SizedSpacecraft,
    table::capacity,
};

/// As SVG text, without panels in which all is 0; `None` where no panel is left.
///
/// # Errors
/// Nothing to draw.
pub(super) fn svg(sized: &SizedSpacecraft, sweep: &Sweep) -> Result<Option<String>, DrawingError> {
    let of_strategies = |value: fn(&Dumped) -> f64| {
        let lines = sized.strategies.iter().map(move |strategy| {
            let own = sweep.dumped.iter().filter(|it| it.strategy == *strategy);
            Series::curve(*strategy, own.map(|it| (capacity(sized, it), value(it))).collect())
        });
        lines.collect::<Vec<_>>()
    };
    let most = |value: fn(&Dumped) -> f64| sweep.dumped.iter().map(value).fold(0.0, f64::max);
    let panel = |label: &str, value: fn(&Dumped) -> f64| {
        let most = most(value);
        (most > 0.0).then(|| Panel::new(label).with(of_strategies(value)).range(0.0, 1.08 * most))
    };
    let title = format!("{}: dumps by the wheels' capacity", sized.spacecraft.name);
    let x_label = if sized.spacecraft.wheels.is_empty() {
        "dump threshold [N·m·s]"
    } else {
        "capacity of each wheel [N·m·s], least-norm sharing"
    };
    let panels =
        [panel("dumps a year", |it| it.dumps), panel("propellant a year [kg]", |it| it.propellant_kg)];
    let panels: Vec<Panel> = panels.into_iter().flatten().collect();
    if panels.is_empty() {
        return Ok(None);
    }
    drawing::svg(&[&Chart::new(title, x_label).with(panels)]).map(Some)
}
