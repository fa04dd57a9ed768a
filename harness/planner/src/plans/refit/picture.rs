//! The picture: momentum as telemetry and fit have it, and residuals, by component over time.

use drawing::{Chart, DrawingError, Panel, Series};
use nalgebra::Vector3;
use physics::constants::DAY_S;

use super::table::Found;

/// Deviations of the noise that are marked.
const MARKED: f64 = 3.0;
const AXES: [&str; 3] = ["X", "Y", "Z"];

/// As SVG text.
///
/// # Errors
/// Nothing to draw.
pub(super) fn svg(found: &Found<'_>) -> Result<String, DrawingError> {
    let (fitted, telemetry) = (found.fitted, found.requested.telemetry);
    let measured = &telemetry.momentum_inertial_n_m_s;
    let broken = |value: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        let mut points = Vec::with_capacity(measured.len() + fitted.arcs.len());
        for arc in &fitted.arcs {
            points.extend(arc.clone().map(|row| (telemetry.times_s[row] / DAY_S, value(row))));
            // Nothing joins two arcs.
            points.push((f64::NAN, f64::NAN));
        }
        points
    };
    let residual = |row: usize| -> &Vector3<f64> { &fitted.residuals_n_m_s[row] };
    let momentum = (0..3).map(|axis| {
        Panel::new(format!("{} [N·m·s]", AXES[axis])).with([
            Series::curve("telemetry", broken(&|row| measured[row][axis])),
            Series::curve("fit", broken(&|row| measured[row][axis] - residual(row)[axis])),
        ])
    });
    let bound_n_m_s = MARKED * found.requested.deviations.noise_n_m_s;
    let residuals = (0..3).map(|axis| {
        Panel::new(format!("{} residual [N·m·s]", AXES[axis]))
            .with([Series::curve("telemetry less fit", broken(&|row| residual(row)[axis]))])
            .marks("3 sigma of --noise", vec![-bound_n_m_s, bound_n_m_s])
    });
    let title = format!("{}: momentum fitted to {}, EME2000", found.mission, found.telemetry);
    drawing::svg(&[&Chart::new(title, "time [d]").with(momentum.chain(residuals))])
}
