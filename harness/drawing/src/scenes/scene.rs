//! Contents of a picture: surfaces, axes of rotation, centre of mass, and a legend; from a spacecraft or a spinner.

use physics::{
    spacecraft::{Plate, Spacecraft},
    spin::spinner::Spinner,
};

use super::{
    devices::Devices,
    parts::{Arrow, Axis, BORESIGHT, Part, SUN_SENSOR, area, box_of, nozzle, panel_called},
    surface::{angle_of_file_rad, surfaces},
};
use crate::{Finish, Surface, Vector, unit};

/// Everything that is drawn.
pub struct Scene {
    /// Name of the spacecraft.
    pub name: String,
    /// Surfaces, of plates and bodies.
    pub(crate) surfaces: Vec<Surface>,
    /// Axes of rotation.
    pub(crate) axes: Vec<Axis>,
    /// Directions of devices.
    pub(crate) arrows: Vec<Arrow>,
    /// Tanks.
    pub tanks_m: Vec<Vector>,
    /// Centre of mass, panels stowed.
    pub center_of_mass_m: Vector,
    /// Whether the Sun stands along -Y.
    pub has_sun: bool,
    /// Entries of the legend.
    pub parts: Vec<Part>,
    /// Limits of the picture, in whole sentences.
    pub remarks: Vec<&'static str>,
}

impl Scene {
    /// A spacecraft with its panels at these angles (by index, in rad), which default to what its file says.
    pub(crate) fn of_spacecraft(spacecraft: &Spacecraft, angles_rad: &[Option<f64>]) -> Self {
        let panels = &spacecraft.panels;
        let angle_rad = |index: usize| {
            let given = angles_rad.get(index).copied().flatten();
            given.unwrap_or_else(|| panels.get(index).map_or(0.0, angle_of_file_rad))
        };
        let mut surfaces = surfaces(spacecraft, angle_rad);
        let plates = spacecraft.plates_body(super::surface::shade_model(spacecraft));
        let rows = plate_rows(&plates);
        let mut parts: Vec<Part> = Vec::new();
        for (name, members) in &rows {
            let area_m2 = members.iter().map(|k| plates[*k].area_m2).sum();
            parts.push(Part::new((parts.len() + 1).to_string(), name, area(area_m2)));
        }
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
        // Surfaces count plates; rows of the legend may have several.
        for surface in &mut surfaces {
            let row = rows.iter().position(|(_, members)| members.contains(&surface.part));
            surface.part = row.unwrap_or_else(|| surface.part + rows.len() - plates.len());
        }
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
        let first_device = parts.len();
        let devices = Devices::from_spacecraft(spacecraft, &surfaces, first_device);
        parts.extend(devices.parts);
        surfaces.extend(devices.nozzles);
        remarks.extend(devices.remarks);
        let at_angle = physics::spacecraft::with_panels(&spacecraft.mass_properties, panels, angle_rad);
        Self {
            name: spacecraft.name.clone(),
            surfaces,
            axes,
            arrows: devices.arrows,
            tanks_m: spacecraft.tanks.iter().map(|tank| tank.position_body_m).collect(),
            center_of_mass_m: at_angle.center_of_mass_body_m,
            has_sun: true,
            parts,
            remarks,
        }
    }

    /// A spinner: its thrusters, on a cylinder through the outermost of them.
    pub(crate) fn of_spinner(spinner: &Spinner) -> Self {
        let thrusters = &spinner.thrusters;
        let places: Vec<Vector> = thrusters.iter().map(|thruster| thruster.position_body_m).collect();
        let radius_m = places.iter().map(|place| place.xy().norm()).fold(0.0, f64::max);
        let heights = |pick: fn(f64, f64) -> f64, from| places.iter().map(|place| place.z).fold(from, pick);
        let (low_m, high_m) = (heights(f64::min, f64::INFINITY), heights(f64::max, f64::NEG_INFINITY));
        // Thrusters in one plane still need a body.
        let missing_m = (0.3 * radius_m - (high_m - low_m)).max(0.0) / 2.0;
        let mut surfaces = body(radius_m, low_m - missing_m, high_m + missing_m);
        let mut parts = Vec::new();
        let mut arrows = Vec::new();
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
        // The middle of the body's side, by azimuth from X toward Y.
        let side_m = |azimuth_deg: f64| {
            let (sine, cosine) = azimuth_deg.to_radians().sin_cos();
            Vector::new(radius_m * cosine, radius_m * sine, (low_m + high_m) / 2.0)
        };
        for (sign, name, azimuth_deg, colour) in [
            ("ST", "star tracker", spinner.star_tracker.azimuth_deg, BORESIGHT),
            ("SS", "Sun sensor", spinner.sun_sensor.azimuth_deg, SUN_SENSOR),
        ] {
            let from_m = side_m(azimuth_deg);
            let Some(outward) = unit(Vector::new(from_m.x, from_m.y, 0.0)) else { continue };
            let to_m = from_m + 0.3 * radius_m * outward;
            arrows.push(Arrow { from_m, to_m, colour });
            let what = format!("azimuth {} deg", terminal::short(azimuth_deg));
            let mut part = Part::new(sign.to_owned(), name, what);
            part.beside_m = Some(to_m + 0.08 * radius_m * outward);
            parts.push(part);
        }
        Self {
            name: spinner.name.clone(),
            surfaces,
            axes: vec![axis],
            arrows,
            tanks_m: Vec::new(),
            center_of_mass_m: Vector::zeros(),
            has_sun: false,
            parts,
            remarks: vec![
                "The file gives no body: the cylinder reaches to the outermost thrusters. Nozzles point where the jet goes.",
            ],
        }
    }

    /// Corners of the box around all surfaces, body frame.
    pub(crate) fn bounds_m(&self) -> Option<[Vector; 2]> {
        let bounds = box_of(self.surfaces.iter())?;
        bounds.iter().flatten().all(|x| x.is_finite()).then_some(bounds)
    }
}

/// The dish that a plate is a facet of, by the names that the file's reader gives facets.
pub fn dish_of(plate: &str) -> Option<&str> {
    let (dish, facet) = plate.rsplit_once(".ring[")?;
    let indices = facet.strip_suffix(']')?.split_once("][")?;
    let is_number = |text: &str| text.parse::<u32>().is_ok();
    (is_number(indices.0) && is_number(indices.1)).then_some(dish)
}

/// Names of the legend's rows with the plates of each: one of a plate, one of a dish.
fn plate_rows(plates: &[Plate]) -> Vec<(String, Vec<usize>)> {
    let mut rows: Vec<(String, Vec<usize>)> = Vec::new();
    for (index, plate) in plates.iter().enumerate() {
        let dish = dish_of(&plate.name);
        match rows.last_mut() {
            Some((name, members)) if dish == Some(name.as_str()) => members.push(index),
            _ => rows.push((dish.unwrap_or(&plate.name).to_owned(), vec![index])),
        }
    }
    rows
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dish_is_one_row() {
        let dish = "[[dishes]]\nname = 'HGA.x'\nvertex_m = [0, 0, 2]\naxis = [0, 0, 1]\nradius_m = 0.6\ndepth_m = 0.2\n\
                    optics = 'mli'\n";
        let text = format!(
            "{}{dish}",
            include_str!("../../../cli/src/new/spacecraft.toml").split("[start.").next().unwrap()
        );
        let spacecraft = Spacecraft::from_toml("", &text).unwrap();
        let facets = spacecraft.plates.len() - 6;
        let scene = Scene::of_spacecraft(&spacecraft, &[]);
        let named = scene.parts.iter().position(|part| part.name == "HGA.x").unwrap();
        let own = scene.surfaces.iter().filter(|surface| surface.part == named).count();
        assert!(facets > 10 && own == facets, "{own} of {facets}");
        // Panels keep their own rows, and their axes.
        assert_eq!(scene.axes.len(), 2);
        for (sign, finish) in [("P1", Finish::Cells), ("P2", Finish::Cells), ("1", Finish::Plate)] {
            let row = scene.parts.iter().position(|part| part.sign == sign).unwrap();
            let mut own = scene.surfaces.iter().filter(|surface| surface.part == row);
            assert!(
                own.next().is_some_and(|surface| surface.finish == finish) && own.next().is_none(),
                "{sign}"
            );
        }
        assert_eq!(dish_of("box.ring[a][1]"), None);
    }

    #[test]
    fn every_device_is_drawn() {
        let text = include_str!("../../../../fmu-src/resources/messenger-full.toml");
        let spacecraft = Spacecraft::from_toml("", text).unwrap();
        let scene = Scene::of_spacecraft(&spacecraft, &[]);
        let count = |letter: char| {
            scene.parts.iter().filter(|part| part.beside_m.is_some() && part.sign.starts_with(letter)).count()
        };
        assert_eq!(count('T'), spacecraft.thrusters.len());
        assert_eq!(count('W'), spacecraft.wheels.len());
        assert_eq!((count('K'), scene.tanks_m.len()), (spacecraft.tanks.len(), spacecraft.tanks.len()));
        // A fan shows both of its ends.
        let antennas = 2 * spacecraft.antennas.len();
        assert_eq!(scene.arrows.len(), spacecraft.wheels.len() + spacecraft.instruments.len() + antennas);
        assert_eq!((count('A'), count('I')), (2, 5));
        // A nozzle opens away from the force.
        let row = scene.parts.iter().position(|part| part.name == "LVA").unwrap();
        let deepest = scene.surfaces.iter().filter(|it| it.part == row).flat_map(|it| &it.corners);
        assert!(deepest.map(|corner| corner.z).fold(f64::MAX, f64::min) < -1.0);
    }
}
