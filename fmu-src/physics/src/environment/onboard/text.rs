//! The ephemeris file as text: what is read back is the same to the bit.

use core::fmt::Write;

use super::ephemeris::OnboardEphemeris;
use super::target::OnboardTarget;
use crate::numerics::Span;

/// The file of an ephemeris.
pub fn to_toml(ephemeris: &OnboardEphemeris) -> String {
    let mut text = String::from("frame = \"EME2000\"\n");
    if let Some(source) = &ephemeris.source {
        let _ = writeln!(text, "source = {}", quoted(source));
    }
    for body in &ephemeris.precise {
        let segments = body.motion.segments();
        let degree = segments.first().map_or(0, |segment| segment.coefficients_m.len().saturating_sub(1));
        let center = OnboardTarget::from(body.center);
        let _ = writeln!(text, "\n[[body]]\nbody = \"{}\"\ncenter = \"{center}\"", body.target);
        let _ = writeln!(text, "degree = {degree}");
        let _ = writeln!(text, "error_m = {:e}", body.error.position_m);
        let _ = writeln!(text, "error_m_s = {:e}", body.error.velocity_m_s);
        for segment in segments {
            let _ = writeln!(text, "\n[[body.segment]]");
            let _ = writeln!(text, "start_s = {:e}\nend_s = {:e}", segment.start_s, segment.end_s);
            for (i, key) in ["x_m", "y_m", "z_m"].into_iter().enumerate() {
                let coefficients = segment.coefficients_m.iter().map(|row| row[i]);
                let _ = writeln!(text, "{key} = {}", list(coefficients));
            }
        }
    }
    for body in &ephemeris.coarse {
        let Span { start_s, end_s } = body.motion.span;
        let center = OnboardTarget::from(body.center);
        let _ = writeln!(text, "\n[[coarse]]\nbody = \"{}\"\ncenter = \"{center}\"", body.target);
        let _ = writeln!(text, "start_s = {start_s:e}\nend_s = {end_s:e}");
        let _ = writeln!(text, "error_m = {:e}", body.error.position_m);
        let _ = writeln!(text, "error_m_s = {:e}", body.error.velocity_m_s);
        let keys = [
            "semi_major_axis_m",
            "eccentricity",
            "inclination_rad",
            "ascending_node_rad",
            "periapsis_argument_rad",
            "mean_anomaly_rad",
        ];
        for (row, key) in keys.into_iter().enumerate() {
            let coefficients = body.motion.elements.coefficients().row(row);
            let _ = writeln!(text, "{key} = {}", list(coefficients.iter().copied()));
        }
    }
    text
}

fn list(numbers: impl Iterator<Item = f64>) -> String {
    let written: Vec<String> = numbers.map(|number| format!("{number:e}")).collect();
    format!("[{}]", written.join(", "))
}

/// A TOML string.
fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
