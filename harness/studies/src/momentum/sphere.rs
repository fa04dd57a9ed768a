//! Force and torque of sunlight for every direction of the Sun, from an FMU that has the Sun's place as an input.

use std::f64::consts::FRAC_PI_2;

use loader::Fmu;

use crate::StudyError;
use crate::attitude::{Vector, body_direction};
use crate::case::{Case, Row};
use crate::settings::{Settings, set};
use drawing::{PlaneChart, PlanePanel, Series};

/// Between neighbouring directions, in deg.
const SPACING_DEG: i32 = 5;
/// Mercury's mean distance, in m.
const DISTANCE_M: f64 = 5.791e10;
/// Cells this far off a Sun on -Y: where the panels stand in the map, whatever the Sun does.
const PANEL_RAD: f64 = 65.0 * std::f64::consts::PI / 180.0;
const STEP_S: f64 = 1.0;

/// What sunlight does from one direction.
#[derive(Clone, Copy, Debug)]
pub struct Lit {
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
pub fn map(fmu: &Fmu) -> Result<Vec<Lit>, StudyError> {
    let azimuths = || (-180..180).step_by(SPACING_DEG as usize).map(f64::from);
    let elevations = (-90..=90).step_by(SPACING_DEG as usize).map(f64::from);
    let at: Vec<[f64; 2]> = elevations.flat_map(|e| azimuths().map(move |a| [a, e])).collect();
    let case = Case::new("the sphere", at.len() as f64 * STEP_S, STEP_S)
        .set("planet.present", false)
        .set("panel[1].angle", PANEL_RAD)
        .set("panel[2].angle", PANEL_RAD);
    let mut ahead = at.iter();
    let mut inputs = |_: Row<'_>| {
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

/// The sphere as two discs, from -Y and from +Y, a degree of which is everywhere as long toward their middle; dots are coloured
/// by six bands of `size`, whose unit is `unit`.
pub fn picture(title: &str, unit: &str, found: &[Lit], size: impl Fn(&Lit) -> Vector) -> PlaneChart {
    const BANDS: usize = 6;
    let most = found.iter().map(|lit| size(lit).norm()).fold(0.0, f64::max);
    let band = |lit: &Lit| ((size(lit).norm() / most * BANDS as f64) as usize).min(BANDS - 1);
    let place = |lit: &Lit, side: f64| {
        let [x, y, z] = direction([lit.azimuth_deg, lit.elevation_deg]).into();
        let away_rad = (y * side).clamp(-1.0, 1.0).acos();
        let scale = if away_rad > 0.0 { away_rad.to_degrees() / x.hypot(z) } else { 0.0 };
        (away_rad <= FRAC_PI_2 + 1e-9).then_some((x * scale, z * scale))
    };
    let panel = |title: &str, side: f64| PlanePanel {
        title: title.to_owned(),
        series: (0..BANDS)
            .map(|number| {
                let step = most / BANDS as f64;
                let label =
                    format!("{:.1} to {:.1} {unit}", number as f64 * step, (number + 1) as f64 * step);
                let points = found.iter().filter(|lit| band(lit) == number);
                Series::dots(label, points.filter_map(|lit| place(lit, side)).collect())
            })
            .collect(),
        centre: (0.0, 0.0),
        half_width: 92.0,
        ..PlanePanel::default()
    };
    PlaneChart {
        title: title.to_owned(),
        x_label: "Sun toward X [deg]".to_owned(),
        y_label: "Sun toward Z [deg]".to_owned(),
        panels: vec![panel("Sun on the side of -Y", -1.0), panel("Sun on the side of +Y", 1.0)],
    }
}
