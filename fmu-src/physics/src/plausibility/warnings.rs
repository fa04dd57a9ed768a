//! Warnings about values in a spacecraft's file that are possible but hardly meant.

use nalgebra::Vector3;

use super::figures::Figures;
use super::surfaces::{Surface, surfaces};
use crate::momentum::WheelArray;
use crate::plant::{ControlDefaults, DUMP_TORQUE_N_M, SLEW_ACCELERATION_RAD_S2};
use crate::spacecraft::{Spacecraft, SunshadeModel, Thruster};

/// Extents of a spacecraft, in m.
const EXTENTS_M: [f64; 2] = [0.03, 1000.0];

/// Mass over the volume of the extents, in kg/m3: from a sail to solid steel.
const DENSITY_KG_M3: [f64; 2] = [0.005, 8000.0];

/// Sunlit area over mass, in m2/kg: from a sphere of lead to bare sail film.
const AREA_TO_MASS_M2_KG: [f64; 2] = [1e-4, 200.0];

/// A mass drawn together to less than this part of the extents is a slip of units.
const LEAST_SPREAD: f64 = 0.01;

/// Surfaces at distances from one another of more than this many times the size that their area has.
const SCATTERED: f64 = 100.0;

/// A centre of mass may be beyond the hull by this part of the extents' diagonal: not all that has mass is a surface.
const OUTSIDE: f64 = 0.05;

/// Corners moved by less are rounding of the double numbers themselves, in m.
const ROUNDED_M: f64 = 1e-9;

/// A part of the extents by which a corner may lie behind what all is in front of.
const BEHIND: f64 = 1e-3;

/// A radius of gyration over the greater extent across its axis: an even box has 0.29 to 0.41, a point 0, a hoop 0.5.
const GYRATION: [f64; 2] = [0.05, 0.6];

/// An area without an outline may exceed by this factor what all other surfaces span across it: corners are squares there.
const LARGE_AREA: f64 = 1.5;

/// A jet blows inward where its force points away from the middle of the extents by more than this cosine.
const INWARD_JET: f64 = 0.1;

/// One sentence each; none where everything looks right.
pub fn warnings(spacecraft: &Spacecraft, figures: &Figures) -> Vec<String> {
    let surfaces = surfaces(spacecraft);
    let mut found = Vec::new();
    lengths(figures, &mut found);
    masses(figures, &mut found);
    center_of_mass(figures, &mut found);
    one_sided(&surfaces, figures, &mut found);
    found.extend(defaults_at_their_bounds(spacecraft));
    areas(spacecraft, &surfaces, &mut found);
    jets(spacecraft, figures, &mut found);
    if spacecraft.wheels.len() >= 3 && figures.wheels.is_none() {
        let count = spacecraft.wheels.len();
        found.push(format!(
            "the axes of the {count} wheels lie in one plane or line: across it they give no torque and hold nothing"
        ));
    }
    for surface in surfaces.iter().filter(|surface| surface.off_plane_m() > ROUNDED_M) {
        found.push(format!(
            "`{}` has a corner {:.2} mm off the plane of its outline; it was moved onto it",
            surface.plate.name,
            surface.off_plane_m() * 1e3
        ));
    }
    found
}

fn extents_m(figures: &Figures) -> Vector3<f64> {
    figures.greatest_body_m - figures.least_body_m
}

fn lengths(figures: &Figures, found: &mut Vec<String>) {
    let greatest_m = extents_m(figures).max();
    let [least, most] = EXTENTS_M;
    if !(least..=most).contains(&greatest_m) {
        found.push(format!("it is {greatest_m:.3} m long: lengths are in m"));
    }
    let size_m = figures.total_area_m2.sqrt();
    if greatest_m > SCATTERED * size_m {
        found.push(format!(
            "its surfaces of {:.3} m2 together are spread over {greatest_m:.3} m: areas are in m2, lengths in m",
            figures.total_area_m2
        ));
    }
}

fn masses(figures: &Figures, found: &mut Vec<String>) {
    let extents_m = extents_m(figures);
    let mass_kg = figures.mass_properties.mass_kg;
    let volume_m3 = extents_m.product();
    let density_kg_m3 = mass_kg / volume_m3;
    let [thin, dense] = DENSITY_KG_M3;
    // A flat one has no volume, and no density to judge.
    if extents_m.min() > LEAST_SPREAD * extents_m.max() && !(thin..=dense).contains(&density_kg_m3) {
        found.push(format!(
            "{mass_kg} kg in the {volume_m3:.3} m3 of its extents are {density_kg_m3:.3} kg/m3, and spacecraft have 0.1 to 2000"
        ));
    }
    let area_to_mass_m2_kg = figures.sunlit_area_m2 / mass_kg;
    let [heavy, light] = AREA_TO_MASS_M2_KG;
    if figures.sunlit_area_m2 > 0.0 && !(heavy..=light).contains(&area_to_mass_m2_kg) {
        found.push(format!(
            "{:.3} m2 toward the Sun and {mass_kg} kg are {area_to_mass_m2_kg:.2e} m2/kg, and spacecraft have 0.001 to 100",
            figures.sunlit_area_m2
        ));
    }
    let reported = found.len();
    let center_m = figures.mass_properties.center_of_mass_body_m;
    for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        let spread_m = figures.mass_spread_m[axis];
        let above_m = figures.greatest_body_m[axis] - center_m[axis];
        let reach_m = above_m.abs().max((center_m[axis] - figures.least_body_m[axis]).abs());
        // The rounding of a flat spacecraft's inertia is not judged.
        if spread_m > reach_m + LEAST_SPREAD * extents_m.max() {
            found.push(format!(
                "by its inertia the mass lies {spread_m:.3} m from the centre of mass along {name} (root mean square), \
                 and no surface lies farther than {reach_m:.3} m"
            ));
        }
    }
    let spread_m = figures.mass_spread_m.norm();
    if spread_m < LEAST_SPREAD * extents_m.max() {
        found.push(format!(
            "by its inertia the mass lies {spread_m:.2e} m from its centre (root mean square), and the surfaces reach over \
             {:.3} m: inertia is in kg m2",
            extents_m.max()
        ));
    }
    // One error in the inertia is reported once.
    if found.len() == reported {
        gyration(figures, found);
    }
}

/// Radii of gyration that no even body of these extents comes near.
fn gyration(figures: &Figures, found: &mut Vec<String>) {
    let extents_m = extents_m(figures);
    let [least, most] = GYRATION;
    for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        let across_m = extents_m[(axis + 1) % 3].max(extents_m[(axis + 2) % 3]);
        let radius_m = figures.gyration_radii_m[axis];
        let share = radius_m / across_m;
        if across_m > 0.0 && !(least..=most).contains(&share) {
            found.push(format!(
                "the radius of gyration about {name} is {radius_m:.3} m, {share:.3} of the {across_m:.3} m across that axis, and \
                 spacecraft have 0.1 to 0.5: inertia is in kg m2 about the centre of mass"
            ));
        }
    }
}

/// Areas without an outline that are larger than all around them spans.
fn areas(spacecraft: &Spacecraft, surfaces: &[Surface], found: &mut Vec<String>) {
    let form = spacecraft.sunshade.as_ref().map_or(SunshadeModel::Plates, |shade| shade.model);
    let (_, without_outline) = spacecraft.outlines(form);
    let of_area = surfaces.iter().enumerate().filter(|(_, it)| without_outline.contains(&it.plate.name));
    for (index, surface) in of_area {
        let corners = &surface.corners_m;
        let center_m = corners.iter().sum::<Vector3<f64>>() / corners.len() as f64;
        let others = surfaces.iter().enumerate().filter(|(other, _)| *other != index);
        let mut around = others.flat_map(|(_, other)| other.corners_m.iter().copied()).peekable();
        if around.peek().is_none() {
            continue;
        }
        let (low_m, high_m) =
            around.fold((center_m, center_m), |(low, high), corner| (low.inf(&corner), high.sup(&corner)));
        let spans_m = high_m - low_m;
        let faces_m2 = Vector3::new(spans_m.y * spans_m.z, spans_m.z * spans_m.x, spans_m.x * spans_m.y);
        let around_m2 = surface.plate.normal.abs().dot(&faces_m2);
        if surface.plate.area_m2 > LARGE_AREA * around_m2 {
            found.push(format!(
                "`{}` has {:.3} m2, and all around it spans {around_m2:.3} m2 across it: areas are in m2",
                surface.plate.name, surface.plate.area_m2
            ));
        }
    }
}

/// Jets that all blow inward, and senses about an axis in which no thruster turns.
fn jets(spacecraft: &Spacecraft, figures: &Figures, found: &mut Vec<String>) {
    let middle_m = (figures.least_body_m + figures.greatest_body_m) / 2.0;
    let is_inward = |thruster: &Thruster| {
        let outward_m = thruster.position_body_m - middle_m;
        let (force_n, distance_m) = (thruster.force_body_n.norm(), outward_m.norm());
        distance_m > 0.0 && thruster.force_body_n.dot(&outward_m) > INWARD_JET * force_n * distance_m
    };
    if !spacecraft.thrusters.is_empty() && spacecraft.thrusters.iter().all(is_inward) {
        found.push(
            "the jets of all thrusters blow inward: `direction` is that of the force on the spacecraft, the jet goes the other way"
                .to_owned(),
        );
    }
    let Some(torque) = figures.thruster_torque else { return };
    let senses = ["X", "Y", "Z"].into_iter().enumerate().flat_map(|(axis, name)| {
        [("+", torque.plus_n_m[axis]), ("-", torque.minus_n_m[axis])]
            .map(|(sign, most_n_m)| (format!("{sign}{name}"), most_n_m))
    });
    let missing: Vec<String> =
        senses.filter(|(_, most_n_m)| *most_n_m == 0.0).map(|(sense, _)| sense).collect();
    if !missing.is_empty() {
        found.push(format!(
            "no thruster gives torque about {} of the centre of mass: they cannot dump or control the attitude alone",
            missing.join(", ")
        ));
    }
}

fn center_of_mass(figures: &Figures, found: &mut Vec<String>) {
    let outside_m = figures.center_of_mass_outside_m.unwrap_or(0.0);
    if outside_m > OUTSIDE * extents_m(figures).norm() {
        found.push(format!("the centre of mass lies {outside_m:.2} m outside of the hull of all surfaces"));
    }
}

/// A sentence for what starts at the bound of what may be set, as the file gives more or less.
pub fn defaults_at_their_bounds(spacecraft: &Spacecraft) -> Vec<String> {
    let axes: Vec<_> = spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect();
    let defaults = ControlDefaults::new(spacecraft, &WheelArray::from_axes(&axes));
    let slews = (SLEW_ACCELERATION_RAD_S2, "rad/s2");
    let rows = [
        ("control.slewAcceleration", defaults.slew_acceleration_rad_s2, slews, "wheels"),
        ("control.thrusterAcceleration", defaults.thruster_acceleration_rad_s2, slews, "thrusters"),
        ("dump.torque", defaults.dump_torque_n_m, (DUMP_TORQUE_N_M, "N.m"), "wheels"),
    ];
    let at_bound = rows.into_iter().filter_map(|(name, start, ([min, max], unit), of)| {
        let (bound, than) = if start >= max { (max, "more") } else { (min, "less") };
        let allowed = format!("as far as it may be set: the {of} of the file give {than}");
        (start == bound && start > 0.0).then(|| format!("{name} starts at {bound} {unit}, {allowed}"))
    });
    at_bound.collect()
}

/// One-sided surfaces that have everything else in front of them, or nothing behind.
fn one_sided(surfaces: &[Surface], figures: &Figures, found: &mut Vec<String>) {
    let slack_m = BEHIND * extents_m(figures).norm();
    for (index, surface) in
        surfaces.iter().enumerate().filter(|(_, surface)| surface.plate.faces.rear_optics.is_none())
    {
        let Some(origin_m) = surface.corners_m.first() else { continue };
        let others = surfaces.iter().enumerate().filter(|(other, _)| *other != index);
        let heights_m = others.flat_map(|(_, other)| &other.corners_m);
        let heights_m = heights_m.map(|corner| surface.plate.normal.dot(&(corner - origin_m)));
        let (lowest_m, highest_m) = heights_m
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), height| {
                (low.min(height), high.max(height))
            });
        let is_inward = lowest_m >= -slack_m && highest_m > slack_m;
        if is_inward {
            found.push(format!(
                "`{}` faces inward: everything else lies in front of it, and light reaches it from there alone",
                surface.plate.name
            ));
        } else if lowest_m >= -slack_m {
            found.push(format!(
                "`{}` has one side and nothing behind it: light on its back meets nothing; a membrane has `rear_optics`",
                surface.plate.name
            ));
        } else if let Some(rear) = rear_before(surfaces, index) {
            found.push(format!(
                "`{}` faces inward: before it stands the rear of `{rear}`, which light does not pass, and behind it nothing; turn \
                 `normal` about",
                surface.plate.name
            ));
        }
    }
}

/// The one-sided surface whose rear a surface has before its middle, while it has nothing behind; both with outlines of their own.
fn rear_before(surfaces: &[Surface], index: usize) -> Option<&str> {
    let own = surfaces.get(index).filter(|own| own.plate.polygon.is_some())?;
    let middle_m = own.corners_m.iter().sum::<Vector3<f64>>() / own.corners_m.len() as f64;
    let first_along = |direction: Vector3<f64>| {
        let others = surfaces.iter().enumerate().filter(|(other, _)| *other != index);
        let met = others.filter_map(|(_, it)| Some((it, ray_length_m(it, &middle_m, &direction)?)));
        met.min_by(|one, other| one.1.total_cmp(&other.1)).map(|(it, _)| it)
    };
    let before = first_along(own.plate.normal)?;
    let is_rear = before.plate.polygon.is_some()
        && before.plate.faces.rear_optics.is_none()
        && before.plate.normal.dot(&own.plate.normal) > 0.0;
    (is_rear && first_along(-own.plate.normal).is_none()).then_some(before.plate.name.as_str())
}

/// How far from a point a ray meets a surface, in m; `None` where it does not.
fn ray_length_m(surface: &Surface, from_m: &Vector3<f64>, direction: &Vector3<f64>) -> Option<f64> {
    let corners_m = &surface.corners_m;
    let length_m =
        surface.plate.normal.dot(&(corners_m.first()? - from_m)) / surface.plate.normal.dot(direction);
    let at_m = from_m + direction * length_m;
    let across = surface.plate.normal.iamax();
    let (u, v) = ((across + 1) % 3, (across + 2) % 3);
    let following = corners_m.iter().cycle().skip(1);
    // A half line from a point inside of an outline crosses it an odd number of times.
    let crossings = corners_m.iter().zip(following).filter(|(a, b)| {
        (a[v] > at_m[v]) != (b[v] > at_m[v])
            && at_m[u] < a[u] + (b[u] - a[u]) * (at_m[v] - a[v]) / (b[v] - a[v])
    });
    (length_m.is_finite() && length_m > ROUNDED_M && crossings.count() % 2 == 1).then_some(length_m)
}
