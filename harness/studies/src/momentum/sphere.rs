//! Force and torque of sunlight for every direction of the Sun, from an FMU that has the Sun's place as an input.

use std::f64::consts::FRAC_PI_2;

use loader::Fmu;

use crate::StudyError;
use crate::attitude::{Vector, body_direction};
use crate::case::{Case, RowReader};
use crate::settings::{Settings, set};
use drawing::{PlaneChart, PlanePanel, Shading};

/// Between neighbouring directions, in deg.
const SPACING_DEG: i32 = 5;
/// Mercury's mean distance, in m.
const DISTANCE_M: f64 = 5.791e10;
/// Cells this far off a Sun on -Y: where the panels stand in the map, whatever the Sun does.
const PANEL_RAD: f64 = 65.0 * std::f64::consts::PI / 180.0;
const STEP_S: f64 = 1.0;

/// What sunlight does from one direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lit {
    /// Of the Sun, in deg.
    pub azimuth_deg: f64,
    /// Of the Sun, in deg.
    pub elevation_deg: f64,
    /// Body frame, in N.
    pub force_n: Vector,
    /// About the centre of mass, body frame, in N m.
    pub torque_n_m: Vector,
}

/// All directions, row by row of elevation.
pub(super) fn map(fmu: &Fmu) -> Result<Vec<Lit>, StudyError> {
    let azimuths = || (-180..180).step_by(SPACING_DEG as usize).map(f64::from);
    let elevations = (-90..=90).step_by(SPACING_DEG as usize).map(f64::from);
    let at: Vec<[f64; 2]> = elevations.flat_map(|e| azimuths().map(move |a| [a, e])).collect();
    let case = Case::new("the sphere", at.len() as f64 * STEP_S, STEP_S)
        .set("planet.present", false)
        .set("panel[1].angle", PANEL_RAD)
        .set("panel[2].angle", PANEL_RAD);
    let mut ahead = at.iter();
    let mut inputs = |_: RowReader<'_>| {
        ahead.next().map_or(Settings::new(), |at| set("sun.positionBody", direction(*at) * DISTANCE_M))
    };
    let found: Vec<(Vector, Vector)> = case.steer(fmu, &["force.solar", "torque.solar"], &mut inputs)?.all(0);
    let lit = |([azimuth_deg, elevation_deg], (force_n, torque_n_m)): ([f64; 2], _)| Lit {
        azimuth_deg,
        elevation_deg,
        force_n,
        torque_n_m,
    };
    Ok(at.iter().copied().zip(found.into_iter().skip(1)).map(lit).collect())
}

/// The Sun's direction in the body frame, as paper 001 counts azimuth and elevation: -Y at zero.
fn direction(at_deg: [f64; 2]) -> Vector {
    let [azimuth_rad, elevation_rad] = at_deg.map(f64::to_radians);
    body_direction(azimuth_rad, elevation_rad)
}

/// The sphere as two discs, from -Y and from +Y, a degree of which is everywhere as long toward their middle; around each direction
/// a cell is shaded by `size`, whose unit is `unit`.
pub(super) fn picture(title: &str, unit: &str, found: &[Lit], size: impl Fn(&Lit) -> Vector) -> PlaneChart {
    let panel = |title: &str, side: f64| PlanePanel {
        title: title.to_owned(),
        cells: found.iter().filter_map(|lit| Some((cell(lit, side)?, size(lit).norm()))).collect(),
        half_width: 92.0,
        ..PlanePanel::default()
    };
    PlaneChart {
        title: title.to_owned(),
        x_label: "Sun toward X [deg]".to_owned(),
        y_label: "Sun toward Z [deg]".to_owned(),
        panels: vec![panel("Sun on the side of -Y", -1.0), panel("Sun on the side of +Y", 1.0)],
        shading: Some(Shading {
            least: 0.0,
            greatest: found.iter().map(|lit| size(lit).norm()).fold(0.0, f64::max),
            unit: unit.to_owned(),
        }),
    }
}

/// The corners around a direction on the disc of a side, in deg, cut at its rim; `None` on the other side.
fn cell(lit: &Lit, side: f64) -> Option<Vec<(f64, f64)>> {
    const RIM: f64 = 1e-9;
    let half_deg = 0.5 * f64::from(SPACING_DEG);
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(right, up)| {
        let elevation_deg = (lit.elevation_deg + up * half_deg).clamp(-90.0, 90.0);
        direction([lit.azimuth_deg + right * half_deg, elevation_deg])
    });
    let place = |direction: Vector| {
        let [x, y, z] = direction.into();
        let (away_rad, across) = ((y * side).clamp(-1.0, 1.0).acos().min(FRAC_PI_2), x.hypot(z));
        let scale = if across > 0.0 { away_rad.to_degrees() / across } else { 0.0 };
        (x * scale, z * scale)
    };
    corners.iter().any(|corner| corner.y * side > RIM).then(|| corners.map(place).to_vec())
}
