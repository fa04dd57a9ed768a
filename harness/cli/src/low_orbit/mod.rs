//! What is missing in a low orbit of the Earth: air and magnetism disturb more there than sunlight.

use loader::Value;
use model_description::Description;
use nalgebra::Vector3;
use physics::{
    bodies::Body,
    environment::{CartesianState, orbit::Elements},
};

use crate::variables::{item, real};

/// Below this altitude drag and magnetic torque are no smaller than those of light.
const LOW_M: f64 = 1e6;
/// What chooses the body that a plant orbits.
const CENTER: &str = "orbit.center";
/// Effects, and the variables that switch them in models that have them.
const EFFECTS: [(&str, &str); 2] = [("air", "aerodynamics.enabled"), ("magnetism", "magnetics.enabled")];

/// A warning for each plant that begins low above the Earth and lacks effects that count there.
pub(crate) fn warnings(description: &Description, sets: &[(String, Value)]) -> Vec<String> {
    let plants = description.variables.iter().filter_map(|variable| variable.name.strip_suffix(CENTER));
    plants.filter_map(|prefix| warning(description, sets, prefix)).collect()
}

fn warning(description: &Description, sets: &[(String, Value)], prefix: &str) -> Option<String> {
    let name = |name: &str| format!("{prefix}{name}");
    if item(description, sets, &name(CENTER))? != "earth" {
        return None;
    }
    let has = |switch: &str| description.variables.iter().any(|variable| variable.name == name(switch));
    let missing: Vec<&str> =
        EFFECTS.into_iter().filter(|(_, switch)| !has(switch)).map(|(effect, _)| effect).collect();
    let altitude_m = periapsis_m(
        &|it| real(description, sets, &name(it)),
        item(description, sets, &name("orbit.source")),
    )? - Body::Earth.data().radius_m;
    let is_low = (0.0..LOW_M).contains(&altitude_m);
    (is_low && !missing.is_empty()).then(|| {
        format!(
            "{}: the Earth, at {:.0} km above it: {} missing in this model; below {:.0} km they disturb more than light",
            name(CENTER),
            altitude_m / 1e3,
            if let [one] = missing.as_slice() { format!("{one} is") } else { format!("{} are", missing.join(" and ")) },
            LOW_M / 1e3
        )
    })
}

/// Distance of the periapsis from the Earth's centre. An ellipse through the Earth is none that is simulated: left at the default of
/// another centre, the eccentricity counts as 0.
fn periapsis_m(value: &dyn Fn(&str) -> Option<f64>, source: Option<&str>) -> Option<f64> {
    let earth = Body::Earth.data();
    let vector = |name: &str| -> Option<Vector3<f64>> {
        let [x, y, z] = [1, 2, 3].map(|axis| value(&format!("{name}[{axis}]")));
        Some(Vector3::new(x?, y?, z?))
    };
    match source {
        Some("held") => return Some(vector("orbit.position")?.norm()),
        Some("inputs") => {
            let (position_m, velocity_m_s) = (vector("orbit.position")?, vector("orbit.velocity")?);
            let elements =
                Elements::from_state(&CartesianState { position_m, velocity_m_s }, earth.gm_m3_s2).ok()?;
            return Some(elements.semi_major_axis_m * (1.0 - elements.eccentricity));
        }
        _ => {}
    }
    let (axis_m, eccentricity) = (value("orbit.semiMajorAxis")?, value("orbit.eccentricity")?);
    let periapsis_m = axis_m * (1.0 - eccentricity);
    Some(if periapsis_m < earth.radius_m { axis_m } else { periapsis_m })
}

#[cfg(test)]
mod tests;
