//! What a picture shows: surfaces, axes of rotation, centre of mass, and a legend; from a spacecraft or a spinner.

use drawing::{Finish, Surface, Vector, unit};
use physics::{spacecraft::Spacecraft, spin::spinner::Spinner};

use super::surface::{angle_of_file_rad, surfaces};

/// A line about which something turns, right-handed.
pub struct Axis {
    pub center_m: Vector,
    pub direction: Vector,
    /// How far the line goes to either side.
    pub half_length_m: f64,
}

impl Axis {
    /// The ends of the line.
    pub fn ends_m(&self) -> [Vector; 2] {
        [-1.0, 1.0].map(|end| self.center_m + end * self.half_length_m * self.direction)
    }
}

/// An entry of the legend.
pub struct Part {
    /// The short sign in the picture: `3`, `P1`, `T10`.
    pub sign: String,
    pub name: String,
    /// Area or force, and how it stands.
    pub what: String,
    /// Where its sign stands if not on its surface.
    pub beside_m: Option<Vector>,
}

/// Everything that is drawn.
pub struct Scene {
    pub name: String,
    pub surfaces: Vec<Surface>,
    pub axes: Vec<Axis>,
    pub center_of_mass_m: Vector,
    /// Whether the Sun stands along -Y.
    pub has_sun: bool,
    pub parts: Vec<Part>,
    /// What the picture leaves open, in whole sentences.
    pub remarks: Vec<&'static str>,
}

/// A panel as texts name it: `panel +X`, whether or not its own name says that it is one.
pub fn panel_called(name: &str) -> String {
    let says_so = name.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("panel"));
    if says_so { name.to_owned() } else { format!("panel {name}") }
}

impl Scene {
    /// A spacecraft with its panels at these angles (by index, in rad), which default to what its file says.
    pub fn of_spacecraft(spacecraft: &Spacecraft, angles_rad: &[Option<f64>]) -> Self {
        let panels = &spacecraft.panels;
        let angle_rad = |index: usize| {
            let given = angles_rad.get(index).copied().flatten();
            given.unwrap_or_else(|| panels.get(index).map_or(0.0, angle_of_file_rad))
        };
        let surfaces = surfaces(spacecraft, angle_rad);
        let plates = spacecraft.plates_body(super::surface::shade_model(spacecraft));
        let mut parts: Vec<Part> = plates
            .iter()
            .enumerate()
            .map(|(k, plate)| Part::new((k + 1).to_string(), &plate.name, area(plate.area_m2)))
            .collect();
        let is_round = surfaces.iter().any(|surface| surface.finish == Finish::Facet);
        if let Some(cylinder) =
            spacecraft.sunshade.as_ref().and_then(|shade| shade.cylinder).filter(|_| is_round)
        {
            let area_m2 = 2.0 * cylinder.half_angle_rad * cylinder.radius_m * cylinder.height_m;
            parts.push(Part::new("S".to_owned(), "sunshade", area(area_m2)));
        }
        parts.extend(panels.iter().enumerate().map(|(k, panel)| {
            let angle_deg = (angle_rad(k).to_degrees() * 10.0).round() / 10.0;
            let what = format!("{}, at {} deg", area(panel.area_m2), terminal::short(angle_deg + 0.0));
            Part::new(format!("P{}", k + 1), &panel_called(&panel.name), what)
        }));
        let axes = panels.iter().enumerate().filter_map(|(k, panel)| {
            let of_panel =
                surfaces.iter().rev().find(|surface| surface.part + panels.len() == parts.len() + k)?;
            let (center_m, direction) = (panel.center_body_m, panel.axis_body);
            let reach = |corner: &Vector| (corner - center_m).dot(&direction).abs();
            let reach_m = of_panel.corners.iter().map(reach).fold(0.0, f64::max);
            Some(Axis { center_m, direction, half_length_m: 1.25 * reach_m })
        });
        let axes = axes.collect();
        let polygons = plates.iter().map(|plate| plate.polygon.is_some());
        let polygons: Vec<bool> =
            polygons.chain(panels.iter().map(|panel| panel.polygon.is_some())).collect();
        let mut remarks = Vec::new();
        match (polygons.iter().any(|given| *given), polygons.iter().all(|given| *given)) {
            (_, true) => {}
            (true, false) => remarks.push("Plates and panels without polygon_m are squares of their area."),
            (false, false) => {
                remarks.push("The file gives no outlines: plates and panels are squares of their area.")
            }
        }
        let follows = |(index, panel): (usize, &physics::spacecraft::Panel)| {
            let is_given = angles_rad.get(index).is_some_and(Option::is_some);
            panel.control == physics::spacecraft::PanelControl::SunOffset && !is_given
        };
        if panels.iter().enumerate().any(follows) {
            remarks.push("Panels that follow the Sun stand as they do with it along -Y.");
        }
        let at_angle = physics::spacecraft::with_panels(&spacecraft.mass_properties, panels, angle_rad);
        Self {
            name: spacecraft.name.clone(),
            surfaces,
            axes,
            center_of_mass_m: at_angle.center_of_mass_body_m,
            has_sun: true,
            parts,
            remarks,
        }
    }

    /// A spinner: its thrusters, on a cylinder through the outermost of them.
    pub fn of_spinner(spinner: &Spinner) -> Self {
        let thrusters = &spinner.thrusters;
        let places: Vec<Vector> = thrusters.iter().map(|thruster| thruster.position_body_m).collect();
        let radius_m = places.iter().map(|place| place.xy().norm()).fold(0.0, f64::max);
        let heights = |pick: fn(f64, f64) -> f64, from| places.iter().map(|place| place.z).fold(from, pick);
        let (low_m, high_m) = (heights(f64::min, f64::INFINITY), heights(f64::max, f64::NEG_INFINITY));
        // Thrusters in one plane still need a body.
        let missing_m = (0.3 * radius_m - (high_m - low_m)).max(0.0) / 2.0;
        let mut surfaces = body(radius_m, low_m - missing_m, high_m + missing_m);
        let mut parts = Vec::new();
        for (index, thruster) in thrusters.iter().enumerate() {
            let Some(jet) = unit(-thruster.force_body_n) else { continue };
            let length_m = 0.28 * radius_m;
            surfaces.extend(nozzle(places[index], jet, length_m, index));
            let what = format!("{} N", terminal::short(thruster.force_body_n.norm()));
            let mut part = Part::new(format!("T{}", index + 1), &thruster.name, what);
            part.beside_m = Some(places[index] + 1.55 * length_m * jet);
            parts.push(part);
        }
        let axis = Axis {
            center_m: Vector::new(0.0, 0.0, (low_m + high_m) / 2.0),
            direction: Vector::z(),
            half_length_m: (high_m - low_m) / 2.0 + missing_m + 0.35 * radius_m,
        };
        Self {
            name: spinner.name.clone(),
            surfaces,
            axes: vec![axis],
            center_of_mass_m: Vector::zeros(),
            has_sun: false,
            parts,
            remarks: vec![
                "The file gives no body: the cylinder reaches to the outermost thrusters. Nozzles point where the jet goes.",
            ],
        }
    }

    /// Corners of the box around all surfaces, body frame.
    pub fn bounds_m(&self) -> Option<[Vector; 2]> {
        let mut corners = self.surfaces.iter().flat_map(|surface| &surface.corners);
        let first = *corners.next()?;
        let bounds = corners.fold([first; 2], |[low, high], corner| [low.inf(corner), high.sup(corner)]);
        bounds.iter().flatten().all(|x| x.is_finite()).then_some(bounds)
    }
}

impl Part {
    fn new(sign: String, name: &str, what: String) -> Self {
        Self { sign, name: name.to_owned(), what, beside_m: None }
    }
}

/// To four digits.
fn area(area_m2: f64) -> String {
    let decimals = (3.0 - area_m2.log10().floor()).clamp(0.0, 12.0) as usize;
    let rounded_m2 = format!("{area_m2:.decimals$}").parse().unwrap_or(area_m2);
    format!("{} m²", terminal::short(rounded_m2))
}

/// Facets of a spinner's assumed body.
fn body(radius_m: f64, low_m: f64, high_m: f64) -> Vec<Surface> {
    const SIDES: u32 = 40;
    let corner = |k: u32, z_m: f64| -> Vector {
        let (sine, cosine) = (f64::from(k) * std::f64::consts::TAU / f64::from(SIDES)).sin_cos();
        Vector::new(radius_m * cosine, radius_m * sine, z_m)
    };
    let sides = (0..SIDES)
        .map(|k| vec![corner(k, low_m), corner(k + 1, low_m), corner(k + 1, high_m), corner(k, high_m)]);
    let upper = (0..SIDES).map(|k| corner(k, high_m)).collect();
    let lower = (0..SIDES).rev().map(|k| corner(k, low_m)).collect();
    let all =
        sides.map(|corners| (corners, Finish::Facet)).chain([(upper, Finish::Plate), (lower, Finish::Plate)]);
    all.filter_map(|(corners, finish)| Surface::facet(corners, finish, usize::MAX)).collect()
}

/// A cone from the throat to the exit.
fn nozzle(throat_m: Vector, jet: Vector, length_m: f64, part: usize) -> Vec<Surface> {
    const SIDES: u32 = 10;
    let across = unit(jet.cross(&Vector::z())).or_else(|| unit(jet.cross(&Vector::x())));
    let Some(first) = across else { return Vec::new() };
    let second = jet.cross(&first);
    let exit_m = throat_m + length_m * jet;
    let rim = |k: u32| {
        let (sine, cosine) = (f64::from(k) * std::f64::consts::TAU / f64::from(SIDES)).sin_cos();
        exit_m + 0.32 * length_m * (cosine * first + sine * second)
    };
    let sides = (0..SIDES).map(|k| vec![throat_m, rim(k + 1), rim(k)]);
    let all = sides.chain([(0..SIDES).map(rim).collect()]);
    all.filter_map(|corners| Surface::facet(corners, Finish::Nozzle, part)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_is_called_one_once() {
        for (name, called) in [
            ("+X", "panel +X"),
            ("panel +X", "panel +X"),
            ("Panel", "Panel"),
            ("pan", "panel pan"),
            ("wing \u{e4}", "panel wing \u{e4}"),
        ] {
            assert_eq!(panel_called(name), called);
        }
    }
}
