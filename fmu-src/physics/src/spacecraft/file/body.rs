//! A body of the user's own, from its description.

use nalgebra::Vector3;

use super::describe_body::{BodyDescription, BodyElementsDescription};
use super::part_reader::PartReader;
use crate::bodies::impossible_density_kg_m3;
use crate::spacecraft::body::{BodyMotion, BodyOrbit, CustomBody};
use crate::toml::dates::{self, ALLOWED_DATE};
use crate::toml::{Point, Written};

pub(crate) fn body(part: &mut PartReader<'_, '_>, description: &BodyDescription) -> CustomBody {
    if description.name.trim().is_empty() {
        part.report("name", "an empty name", "a name");
    }
    let [right_ascension, declination] = description.pole_deg();
    let pole = part.at.key("pole_deg");
    part.check.within(&pole.item(0), right_ascension, -360.0, 360.0, "an angle from -360 to 360 deg");
    part.check.within(&pole.item(1), declination, -90.0, 90.0, "an angle from -90 to 90 deg");
    let (gm_m3_s2, radii_m) =
        (description.gravitational_parameter_m3_s2.0, description.radii_m.map(f64::from));
    // Values out of their own ranges are reported for themselves.
    let is_judged = gm_m3_s2 > 0.0 && radii_m.iter().all(|radius_m| (1.0..=1e9).contains(radius_m));
    let density_kg_m3 = impossible_density_kg_m3(gm_m3_s2, radii_m).filter(|_| is_judged);
    if let Some(density_kg_m3) = density_kg_m3 {
        let found = format_args!("{gm_m3_s2:?}, with radii_m a mean density of {density_kg_m3:.3e} kg/m3");
        part.report(
            "gravitational_parameter_m3_s2",
            found,
            "a mean density of 100 to 30000 kg/m3 (1 km3/s2 is 1e9 m3/s2)",
        );
    }
    CustomBody {
        name: description.name.clone(),
        gm_m3_s2,
        radii_m,
        j2: description.j2(),
        pole_rad: [right_ascension, declination].map(f64::to_radians),
        prime_meridian_rad: description.prime_meridian_rad(),
        rotation_rate_rad_s: description.rotation_rate_rad_s(),
        albedo: description.albedo(),
        emissivity: description.emissivity(),
        motion: motion(part, description),
    }
}

/// Its motion, if elements or a state say it; both at once, or a part of them, are reported.
fn motion(part: &mut PartReader<'_, '_>, description: &BodyDescription) -> Option<BodyMotion> {
    let (position_m, velocity_m_s) = (description.position_m, description.velocity_m_s);
    let orbit = match (&description.elements, position_m.map(Point::value), velocity_m_s.map(Point::value)) {
        (Some(elements), None, None) => BodyOrbit::from(elements),
        (None, Some(position_m), Some(velocity_m_s)) => {
            if position_m.cross(&velocity_m_s) == Vector3::zeros() {
                let allowed = "not along position_m: a fall along a line is no orbit about the Sun";
                part.report("velocity_m_s", format_args!("{:?}", velocity_m_s.as_slice()), allowed);
            }
            BodyOrbit::State { position_m, velocity_m_s }
        }
        (None, position_m, velocity_m_s) if position_m.is_some() || velocity_m_s.is_some() => {
            let missing = if position_m.is_some() { "velocity_m_s" } else { "position_m" };
            let allowed = "position_m in m and velocity_m_s in m/s, both from the Sun";
            part.check.report_lack(&part.at, missing, allowed);
            return None;
        }
        _ => return None,
    };
    let Some(epoch) = description.epoch.as_deref() else {
        part.check.report_lack(&part.at, "epoch", format_args!("when the body is there, {ALLOWED_DATE}"));
        return None;
    };
    let epoch_s = match dates::epoch_s(epoch) {
        Ok(epoch_s) => epoch_s,
        Err(error) => {
            part.report("epoch", format_args!("{epoch:?}, {error}"), ALLOWED_DATE);
            return None;
        }
    };
    Some(BodyMotion { epoch_s, frame: description.frame.unwrap_or_default(), orbit })
}

impl From<&BodyElementsDescription> for BodyOrbit {
    fn from(given: &BodyElementsDescription) -> Self {
        Self::Elements {
            semi_major_axis_m: given.semi_major_axis_m.0,
            eccentricity: given.eccentricity.0,
            inclination_rad: given.inclination_rad(),
            ascending_node_rad: given.ascending_node_rad(),
            periapsis_argument_rad: given.periapsis_argument_rad(),
            true_anomaly_rad: given.true_anomaly_rad(),
        }
    }
}
