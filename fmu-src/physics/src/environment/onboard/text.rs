//! The ephemeris file as text: what is read back is the same to the bit.

use core::fmt::Write;

use super::ephemeris::{FittedBody, OnboardEphemeris};
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
        write_body(&mut text, "body", body, &format!("degree = {degree}"));
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
        write_body(&mut text, "coarse", body, &format!("start_s = {start_s:e}\nend_s = {end_s:e}"));
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

/// Writes the keys that every model begins with, its `own` between centre and errors.
fn write_body<M>(text: &mut String, kind: &str, body: &FittedBody<M>, own: &str) {
    let (center, error) = (OnboardTarget::from(body.center), body.error);
    let _ = writeln!(text, "\n[[{kind}]]\nbody = \"{}\"\ncenter = \"{center}\"\n{own}", body.target);
    let _ = writeln!(text, "error_m = {:e}\nerror_m_s = {:e}", error.position_m, error.velocity_m_s);
}

fn list(numbers: impl Iterator<Item = f64>) -> String {
    let written: Vec<String> = numbers.map(|number| format!("{number:e}")).collect();
    format!("[{}]", written.join(", "))
}

/// A TOML string.
fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
