//! A body of the user's own, from its description.

use nalgebra::Vector3;

use super::description::{BodyDescription, BodyElementsDescription};
use super::part_reader::PartReader;
use crate::bodies::impossible_density_kg_m3;
use crate::spacecraft::body::{BodyMotion, BodyOrbit, CustomBody};
use crate::toml::dates::{self, ALLOWED_DATE};

pub(crate) fn body(part: &mut PartReader<'_, '_>, description: &BodyDescription) -> CustomBody {
    if description.name.trim().is_empty() {
        part.report("name", "an empty name", "a name");
    }
    let [right_ascension, declination] = description.pole_deg();
    let pole = part.at.key("pole_deg");
    part.check.within(&pole.item(0), right_ascension, -360.0, 360.0, "an angle from -360 to 360 deg");
    part.check.within(&pole.item(1), declination, -90.0, 90.0, "an angle from -90 to 90 deg");
    let rate_rad_s = description.rotation_rate_rad_s();
    let place = part.at.key("rotation_rate_rad_s");
    part.check.within(&place, rate_rad_s, -1.0, 1.0, "a rate from -1 to 1 rad/s");
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
        j2: part.check.within(&part.at.key("j2"), description.j2(), -1.0, 1.0, "a number from -1 to 1"),
        pole_rad: [right_ascension, declination].map(f64::to_radians),
        prime_meridian_rad: description.prime_meridian_deg().to_radians(),
        rotation_rate_rad_s: rate_rad_s,
        albedo: description.albedo(),
        emissivity: description.emissivity(),
        motion: motion(part, description),
    }
}

/// Its motion, if elements or a state say it; both at once, or a part of them, are reported.
fn motion(part: &mut PartReader<'_, '_>, description: &BodyDescription) -> Option<BodyMotion> {
    let state = [("position_m", description.position_m), ("velocity_m_s", description.velocity_m_s)];
    let written = state.map(|(_, vector)| vector.is_some());
    let orbit = match (&description.elements, written) {
        (Some(_), [true, _] | [_, true]) => {
            part.report(
                "elements",
                "elements beside position_m or velocity_m_s",
                "either `elements`, or `position_m` and `velocity_m_s`",
            );
            return None;
        }
        (Some(given), _) => elements(&mut part.table("elements"), given),
        (None, [true, true]) => {
            let [position_m, velocity_m_s] =
                state.map(|(key, vector)| part.vector(key, vector.unwrap_or_default()));
            if position_m.cross(&velocity_m_s) == Vector3::zeros() {
                let allowed = "not along position_m: a fall along a line is no orbit about the Sun";
                part.report("velocity_m_s", format_args!("{:?}", velocity_m_s.as_slice()), allowed);
            }
            BodyOrbit::State { position_m, velocity_m_s }
        }
        (None, [false, false]) => {
            if let Some(key) =
                ["epoch", "frame"].into_iter().find(|key| part.check.is_written(&part.at.key(key)))
            {
                let found = "no `elements` and no `position_m` beside it";
                part.report(key, found, "what the body's place about the Sun is at that time");
            }
            return None;
        }
        (None, written) => {
            let missing = if written[0] { "velocity_m_s" } else { "position_m" };
            part.check.report_lack(
                &part.at,
                missing,
                "position_m in m and velocity_m_s in m/s, both from the Sun",
            );
            return None;
        }
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

fn elements(part: &mut PartReader<'_, '_>, given: &BodyElementsDescription) -> BodyOrbit {
    let eccentricity = part.check.within(
        &part.at.key("eccentricity"),
        given.eccentricity,
        0.0,
        0.99,
        "a number from 0 to 0.99",
    );
    BodyOrbit::Elements {
        semi_major_axis_m: given.semi_major_axis_m.0,
        eccentricity,
        inclination_rad: given.inclination_deg.0.to_radians(),
        ascending_node_rad: given.ascending_node_deg.0.to_radians(),
        periapsis_argument_rad: given.periapsis_argument_deg.0.to_radians(),
        true_anomaly_rad: given.true_anomaly_deg.0.to_radians(),
    }
}
