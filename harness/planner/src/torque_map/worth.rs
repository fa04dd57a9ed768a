//! Sensitivity of the torque to a degree of the Sun's direction or of the panels, by the FMU's own derivatives.

use fmi::Error;
use nalgebra::Vector3;

use super::{
    grid::{Angles, direction},
    panels::Rule,
    sunlight::{LitSpacecraft, Sunlight},
};

/// One quantity that is turned by a degree.
pub struct TorqueSensitivity {
    /// The quantity.
    pub what: String,
    /// Change of torque for each degree, body frame.
    pub torque_n_m_per_deg: Vector3<f64>,
}

/// Torque with the Sun at this azimuth and elevation in N m, and its change by a degree of tilt, toward larger azimuth and toward
/// larger elevation, and of panels, which `called` names.
///
/// # Errors
/// A call that failed.
pub fn worths(
    spacecraft: &LitSpacecraft,
    [azimuth_deg, elevation_deg]: Angles,
    called: impl Fn(&str) -> String,
) -> Result<(Vector3<f64>, Vec<TorqueSensitivity>), Error> {
    let (mut sunlight, sun) = (Sunlight::new(spacecraft)?, direction([azimuth_deg, elevation_deg]));
    // A quarter turn on along either angle; along azimuth a great circle, which at a pole is one as well.
    let ahead = [direction([azimuth_deg + 90.0, 0.0]), direction([azimuth_deg, elevation_deg + 90.0])];
    let (load, slopes) = sunlight.slopes(&sun, ahead)?;
    let per_deg = |what: &str, slope: Vector3<f64>| TorqueSensitivity {
        what: what.to_owned(),
        torque_n_m_per_deg: slope * 1_f64.to_radians(),
    };
    let mut found = vec![per_deg("Sun azimuth", slopes[0]), per_deg("Sun elevation", slopes[1])];
    let panels = spacecraft.panels.iter();
    let held = panels.enumerate().filter(|(_, turned)| matches!(turned.rule, Rule::SunOffset { .. }));
    let held: Vec<usize> = held.map(|(index, _)| index).collect();
    if !held.is_empty() {
        found.push(per_deg("Sun offset of the panels", sunlight.slope_by_offset(&sun, &held)?));
    }
    if held.len() > 1 {
        for index in held {
            let what = format!("Sun offset of {}", called(&spacecraft.panels[index].panel.name));
            found.push(per_deg(&what, sunlight.slope_by_offset(&sun, &[index])?));
        }
    }
    Ok((load.torque_n_m, found))
}
