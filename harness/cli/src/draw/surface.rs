//! The flat surfaces of a spacecraft, as its file's reader gives them, for pictures.
//!
//! A surface given by its outline is that polygon, any other a square of its area; a cylindrical sunshade is a row of
//! facets.

use physics::spacecraft::{Panel, Polygon, Spacecraft, SunshadeModel};

use super::vector::{Vector, along, cross, dot, turned, unit};

/// One edge of a square lies across the plane of its normal and this, where it can.
const UP: Vector = [0.0, 0.0, 1.0];
/// The direction to the Sun that the shipped files and Guidance take.
pub const TO_SUN: Vector = [0.0, -1.0, 0.0];
/// Facets of a whole cylinder.
const FACETS: f64 = 72.0;

/// What a surface is drawn as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    /// Cloth or sheet.
    Plate,
    /// A panel's solar cells.
    Cells,
    /// Part of a round body: without edges.
    Facet,
    /// Metal of a nozzle.
    Nozzle,
}

/// A flat polygon in space.
#[derive(Clone, Debug)]
pub struct Surface {
    /// In order around the outline.
    pub corners: Vec<Vector>,
    /// Mean of the corners.
    pub center: Vector,
    /// Out of the front.
    pub normal: Vector,
    /// Two directions in the plane that the grid of a solar panel follows.
    pub grid: [Vector; 2],
    /// What it is drawn as.
    pub finish: Finish,
    /// The entry of the legend that it belongs to.
    pub part: usize,
}

impl Surface {
    /// With its outline, else a square of this area about this centre. Only a panel has an axis, and solar cells.
    pub fn new(
        outline: Option<Vec<Vector>>,
        (area_m2, center_m): (f64, Vector),
        normal: Vector,
        axis: Option<Vector>,
    ) -> Option<Self> {
        // One edge of a square lies along the panel's axis, or across the plane of normal and Z.
        let along =
            axis.or_else(|| unit(cross(normal, UP))).or_else(|| unit(cross(normal, [1.0, 0.0, 0.0])))?;
        let across = unit(cross(normal, along))?;
        let corners = match outline {
            Some(outline) => outline,
            None => square(area_m2, center_m, along, across)?,
        };
        let finish = if axis.is_some() { Finish::Cells } else { Finish::Plate };
        Some(Self { center: mean(&corners), corners, normal, grid: [along, across], finish, part: 0 })
    }

    /// Of a round body, from its corners; the normal follows them by the right-hand rule.
    pub fn facet(corners: Vec<Vector>, finish: Finish, part: usize) -> Option<Self> {
        let [a, b, c, ..] = corners[..] else { return None };
        let normal = unit(cross(along(b, -1.0, a), along(c, -1.0, b)))?;
        let edge = unit(along(b, -1.0, a))?;
        let grid = [edge, cross(normal, edge)];
        Some(Self { center: mean(&corners), corners, normal, grid, finish, part })
    }

    /// Turned about a panel's axis.
    fn turned(mut self, panel: &Panel, angle_rad: f64) -> Self {
        let (center, axis): (Vector, Vector) = (panel.center_body_m.into(), panel.axis_body.into());
        let direction = |a: Vector| turned(a, axis, angle_rad);
        let place = |a: Vector| along(center, 1.0, direction(along(a, -1.0, center)));
        // At angle 0 the outline stays as the file has it, to the bit.
        if angle_rad != 0.0 {
            self.corners = self.corners.iter().map(|corner| place(*corner)).collect();
            self.center = place(self.center);
            self.normal = direction(self.normal);
            self.grid = self.grid.map(direction);
        }
        self
    }
}

fn mean(corners: &[Vector]) -> Vector {
    let share = 1.0 / corners.len() as f64;
    std::array::from_fn(|i| corners.iter().map(|corner| corner[i] * share).sum())
}

fn square(area_m2: f64, center: Vector, along: Vector, across: Vector) -> Option<Vec<Vector>> {
    let half = area_m2.sqrt() / 2.0;
    let corner = |(a, b): (f64, f64)| -> Vector {
        std::array::from_fn(|i| center[i] + half * (a * along[i] + b * across[i]))
    };
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner);
    (half.is_finite() && half > 0.0).then(|| corners.to_vec())
}

/// The sunshade that the file says is used.
pub fn shade_model(spacecraft: &Spacecraft) -> SunshadeModel {
    spacecraft.sunshade.as_ref().map_or(SunshadeModel::Plates, |shade| shade.model)
}

/// Plates, then a cylindrical shade if it is used, then panels at these angles (by index, in rad); `part` counts these.
pub fn surfaces(spacecraft: &Spacecraft, angle_rad: impl Fn(usize) -> f64) -> Vec<Surface> {
    let outline = |polygon: &Option<Polygon>| {
        let polygon = polygon.as_ref()?;
        Some(polygon.vertices_m().iter().map(|vertex| (*vertex).into()).collect())
    };
    let plates = spacecraft.plates_body(shade_model(spacecraft));
    let mut parts: Vec<Vec<Surface>> = plates
        .iter()
        .map(|plate| {
            let square = (plate.area_m2, plate.center_m.into());
            Surface::new(outline(&plate.polygon), square, plate.normal.into(), None).into_iter().collect()
        })
        .collect();
    parts.extend((shade_model(spacecraft) == SunshadeModel::Cylinder).then(|| cylinder(spacecraft)));
    for (index, panel) in spacecraft.panels.iter().enumerate() {
        let square = (panel.area_m2, panel.center_body_m.into());
        let (normal, axis) = (panel.zero_normal_body.into(), panel.axis_body.into());
        let surface = Surface::new(outline(&panel.polygon), square, normal, Some(axis));
        parts.push(surface.map(|surface| surface.turned(panel, angle_rad(index))).into_iter().collect());
    }
    let numbered = parts.into_iter().enumerate();
    numbered
        .flat_map(|(part, surfaces)| surfaces.into_iter().map(move |surface| Surface { part, ..surface }))
        .collect()
}

/// The angle at which a panel stands with the Sun along -Y, as its file says.
pub fn angle_of_file_rad(panel: &Panel) -> f64 {
    match panel.control {
        physics::spacecraft::PanelControl::Angle => panel.angle_rad,
        physics::spacecraft::PanelControl::SunOffset | physics::spacecraft::PanelControl::Command => {
            panel.angle_for_sun_offset(&TO_SUN.into(), panel.sun_offset_rad, panel.tilt_sign)
        }
    }
}

/// The facets of a cylindrical sunshade.
fn cylinder(spacecraft: &Spacecraft) -> Vec<Surface> {
    let Some(shade) = &spacecraft.sunshade else { return Vec::new() };
    let Some(cylinder) = &shade.cylinder else { return Vec::new() };
    let half_turn = std::f64::consts::PI;
    let count = (FACETS * cylinder.half_angle_rad / half_turn).ceil().max(2.0);
    let corner = |k: f64, z_m: f64| -> Vector {
        let (sine, cosine) = (cylinder.half_angle_rad * (2.0 * k / count - 1.0)).sin_cos();
        let in_shade: Vector = [cylinder.radius_m * sine, -cylinder.radius_m * cosine, z_m];
        std::array::from_fn(|i| {
            let row: Vector = std::array::from_fn(|j| shade.dcm_body_from_shade[(i, j)]);
            dot(row, in_shade)
        })
    };
    let half_m = cylinder.height_m / 2.0;
    (0..count as u32)
        .filter_map(|k| {
            let (k, next) = (f64::from(k), f64::from(k + 1));
            let corners =
                vec![corner(k, -half_m), corner(next, -half_m), corner(next, half_m), corner(k, half_m)];
            Surface::facet(corners, Finish::Facet, 0)
        })
        .collect()
}

/// Front sides in the light are bright; cells are blue, cloth is yellowish white, backs are grey.
pub fn colour(surface: &Surface, front: bool, light: Vector) -> String {
    let light = unit(light).map_or(0.0, |light| dot(surface.normal, light)).max(0.0);
    let (dark, bright) = match (surface.finish, front) {
        (Finish::Cells, true) => ([0x16, 0x2c, 0x5c], [0x3f, 0x74, 0xc4]),
        (Finish::Nozzle, _) => ([0x4a, 0x52, 0x5c], [0x7d, 0x86, 0x91]),
        (_, true) => ([0xb0, 0xa5, 0x8c], [0xff, 0xf6, 0xe2]),
        (_, false) => ([0x6f, 0x75, 0x7d], [0x8e, 0x95, 0x9e]),
    };
    let mix = |low: u8, high: u8| (f64::from(low) + (f64::from(high) - f64::from(low)) * light).round() as u8;
    let [r, g, b]: [u8; 3] = std::array::from_fn(|i| mix(dark[i], bright[i]));
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Ends of the lines of a solar panel's grid: nearly square cells over the rectangle around the outline.
pub fn cell_lines(surface: &Surface) -> Vec<[Vector; 2]> {
    const CELLS: f64 = 25.0;
    let [low, high] = [f64::min, f64::max].map(|pick| {
        surface.grid.map(|direction| {
            let along = surface.corners.iter().map(|corner| dot(*corner, direction));
            along.reduce(pick).unwrap_or_default()
        })
    });
    let size = [high[0] - low[0], high[1] - low[1]];
    let cell = (size[0] * size[1] / CELLS).sqrt();
    let offset = dot(surface.center, surface.normal);
    let point = |a: f64, b: f64| -> Vector {
        std::array::from_fn(|i| a * surface.grid[0][i] + b * surface.grid[1][i] + offset * surface.normal[i])
    };
    let mut lines = Vec::new();
    for axis in 0..2 {
        let count = (size[axis] / cell).round().clamp(1.0, CELLS) as u32;
        for k in 1..count {
            let at = low[axis] + size[axis] * f64::from(k) / f64::from(count);
            let ends = [low[1 - axis], high[1 - axis]];
            lines.push(ends.map(|end| if axis == 0 { point(at, end) } else { point(end, at) }));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    //! Panels stand as the model that takes the light turns them.
    use super::*;

    #[test]
    fn panels_turn_as_the_radiation_model_turns_them() {
        let sailer = include_str!("../../../../fmu-src/resources/examples/solar-sailer.toml");
        let file = Spacecraft::from_toml("", sailer).unwrap();
        for angle_rad in [-2.0, -0.4, 0.7, 3.0] {
            let all = surfaces(&file, |_| angle_rad);
            for (panel, surface) in file.panels.iter().zip(&all[all.len() - file.panels.len()..]) {
                let normal: Vector = panel.normal_body(angle_rad).into();
                assert!((dot(normal, surface.normal) - 1.0).abs() < 1e-12, "{}", panel.name);
                for corner in &surface.corners {
                    assert!(
                        dot(normal, along(*corner, -1.0, surface.center)).abs() < 1e-12,
                        "{}",
                        panel.name
                    );
                }
            }
        }
    }

    #[test]
    fn panels_that_follow_the_sun_keep_their_offset() {
        let file = Spacecraft::from_toml("", physics::spacecraft::MESSENGER_TOML).unwrap();
        let all = surfaces(&file, |index| angle_of_file_rad(&file.panels[index]));
        let cells: Vec<&Surface> = all.iter().filter(|surface| surface.finish == Finish::Cells).collect();
        assert_eq!(cells.len(), 2);
        for surface in cells {
            let offset_deg = dot(surface.normal, TO_SUN).acos().to_degrees();
            assert!((offset_deg - 65.0).abs() < 1e-9, "{offset_deg}");
        }
    }
}
