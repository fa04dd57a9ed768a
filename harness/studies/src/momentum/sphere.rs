//! Force and torque of sunlight for every direction of the Sun, from an FMU that has the Sun's place as an input.

use std::f64::consts::FRAC_PI_2;

use loader::{Error, Fmu, Instance, InstanceOptions, Value};

use crate::vector::{Vector, norm};
use drawing::Series;
use drawing::{PlaneChart, PlanePanel};

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

/// The Sun's direction in the body frame, as paper 001 counts azimuth and elevation: -Y at zero.
fn direction([azimuth_deg, elevation_deg]: [f64; 2]) -> Vector {
    let ((sin_a, cos_a), (sin_e, cos_e)) =
        (azimuth_deg.to_radians().sin_cos(), elevation_deg.to_radians().sin_cos());
    [cos_e * sin_a, -cos_e * cos_a, -sin_e]
}

/// All directions, row by row of elevation.
pub fn map(fmu: &Fmu) -> Result<Vec<Lit>, Error> {
    let mut instance = Instance::new(fmu, fmu.name(), &InstanceOptions::default())?;
    instance.set("planet.present", &Value::Boolean(false))?;
    instance.setup_experiment(None, 0.0, None)?;
    instance.enter_initialization_mode()?;
    for panel in 1..=2 {
        instance.set(&format!("panel[{panel}].angle"), &Value::Real(PANEL_RAD))?;
    }
    instance.exit_initialization_mode()?;
    let read: Vec<usize> = [fmu.select("force.solar")?, fmu.select("torque.solar")?].concat();
    let mut found = Vec::new();
    for elevation in (-90..=90).step_by(SPACING_DEG as usize) {
        for azimuth in (-180..180).step_by(SPACING_DEG as usize) {
            let at = [f64::from(azimuth), f64::from(elevation)];
            for (axis, part) in direction(at).into_iter().enumerate() {
                let name = format!("sun.positionBody[{}]", axis + 1);
                instance.set(&name, &Value::Real(part * DISTANCE_M))?;
            }
            instance.do_step(found.len() as f64 * STEP_S, STEP_S, true)?;
            let mut loads = [0.0; 6];
            for (load, &position) in loads.iter_mut().zip(&read) {
                if let Value::Real(value) = instance.get_variable(&fmu.description().variables[position])? {
                    *load = value;
                }
            }
            let [fx, fy, fz, tx, ty, tz] = loads;
            let (force_n, torque_n_m) = ([fx, fy, fz], [tx, ty, tz]);
            found.push(Lit { azimuth_deg: at[0], elevation_deg: at[1], force_n, torque_n_m });
        }
    }
    Ok(found)
}

/// The sphere as two discs, from -Y and from +Y, a degree of which is everywhere as long toward their middle; dots are coloured
/// by six bands of `size`, whose unit is `unit`.
pub fn picture(title: &str, unit: &str, found: &[Lit], size: impl Fn(&Lit) -> Vector) -> PlaneChart {
    const BANDS: usize = 6;
    let most = found.iter().map(|lit| norm(&size(lit))).fold(0.0, f64::max);
    let band = |lit: &Lit| ((norm(&size(lit)) / most * BANDS as f64) as usize).min(BANDS - 1);
    let place = |lit: &Lit, side: f64| {
        let [x, y, z] = direction([lit.azimuth_deg, lit.elevation_deg]);
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
