//! What slews, wheels and thrusters the mission needs or has, by axis.

use nalgebra::{Matrix3, Vector3};
use physics::{
    momentum::WheelCapacity,
    propulsion::ThrusterSelection,
    spacecraft::{Spacecraft, Thruster},
};

use super::{momentum::Histories, sized::SizedSpacecraft};
use crate::{instance::vector, variables::item};

const NAMES: [&str; 3] = ["X", "Y", "Z"];

/// A turn about a body axis from rest to rest, by `control.slewRate` and `control.slewAcceleration`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Slew {
    pub axis: &'static str,
    pub torque_n_m: f64,
    pub momentum_n_m_s: f64,
    /// Of 90 and 180 deg.
    pub times_s: [f64; 2],
}

/// Wheels of one geometry that take what the mission needs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Geometry {
    pub name: String,
    /// Of each wheel, in N m s and N m.
    pub capacity_n_m_s: f64,
    pub torque_n_m: f64,
}

/// What wheels have to take about each body axis, and which wheels do.
pub(super) struct Wheels {
    /// Gathered within the longest time between dumps.
    pub gathered_n_m_s: Vector3<f64>,
    /// With slews and margin.
    pub needed_n_m_s: f64,
    pub needed_n_m: f64,
    pub geometries: Vec<Geometry>,
}

/// How thrusters turn the spacecraft one way about an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Allocation {
    pub sense: String,
    /// Names with seconds of full thrust for 1 N m s.
    pub shares: Vec<(String, f64)>,
    /// Angular impulse over impulse.
    pub lever_m: f64,
    /// Of the shortest pulse in which any of them fires, in N m s.
    pub least_impulse_n_m_s: f64,
    pub propellant_g_per_n_m_s: f64,
}

/// What the FMU lets slews do.
pub(super) struct SlewLimits {
    pub rate_rad_s: f64,
    pub acceleration_rad_s2: f64,
    pub inertia_kg_m2: Matrix3<f64>,
}

impl SlewLimits {
    /// Of a sized at its start.
    pub(super) fn of(sized: &SizedSpacecraft) -> Result<Self, loader::Error> {
        let mut started = sized.started()?;
        let mut inertia_kg_m2 = Matrix3::zeros();
        for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column))) {
            let name = format!("spacecraft.inertia[{},{}]", row + 1, column + 1);
            inertia_kg_m2[(row, column)] = started.get_real(&name)?;
        }
        Ok(Self {
            rate_rad_s: started.get_real("control.slewRate")?,
            acceleration_rad_s2: started.get_real("control.slewAcceleration")?,
            inertia_kg_m2,
        })
    }

    /// About each body axis.
    pub(super) fn slews(&self) -> [Slew; 3] {
        let inertia_kg_m2 = self.inertia_kg_m2.diagonal();
        [0, 1, 2].map(|axis| Slew {
            axis: NAMES[axis],
            torque_n_m: inertia_kg_m2[axis] * self.acceleration_rad_s2,
            momentum_n_m_s: inertia_kg_m2[axis] * self.rate_rad_s,
            times_s: [90.0_f64, 180.0].map(|angle_deg| self.time_s(angle_deg.to_radians())),
        })
    }

    /// At full acceleration, coasting at the greatest rate where the turn is long enough; infinite without limits.
    fn time_s(&self, angle_rad: f64) -> f64 {
        let (rate_rad_s, acceleration_rad_s2) = (self.rate_rad_s, self.acceleration_rad_s2);
        if acceleration_rad_s2 <= 0.0 {
            return f64::INFINITY;
        }
        let longest_rad = rate_rad_s * rate_rad_s / acceleration_rad_s2;
        if rate_rad_s > 0.0 && angle_rad > longest_rad {
            return angle_rad / rate_rad_s + rate_rad_s / acceleration_rad_s2;
        }
        2.0 * (angle_rad / acceleration_rad_s2).sqrt()
    }
}

impl Wheels {
    /// By what a flight without dumps gathers: after a dump to the other side of the threshold a component has room for
    /// 1 + dump.reinitFraction thresholds.
    pub(super) fn needed(
        sized: &SizedSpacecraft,
        histories: &Histories,
        slews: &[Slew; 3],
        margin: f64,
    ) -> Result<Self, loader::Error> {
        let mut started = sized.started()?;
        let is_opposite = item(sized.fmu.description(), &sized.sets, "dump.reinitTo") == Some("opposite");
        let room = if is_opposite { 1.0 + started.get_real("dump.reinitFraction")? } else { 1.0 };
        let gathered_n_m_s = histories.gathered_n_m_s(sized.spacing_s);
        let of_axis = |axis: usize| gathered_n_m_s[axis] / room + slews[axis].momentum_n_m_s;
        let needed_n_m_s = (1.0 + margin) * [0, 1, 2].map(of_axis).into_iter().fold(0.0, f64::max);
        let needed_n_m = (1.0 + margin) * slews.iter().map(|slew| slew.torque_n_m).fold(0.0, f64::max);
        let held = geometries(&sized.spacecraft).into_iter().filter_map(|(name, axes)| {
            // Capacity and torque of each wheel are shared alike.
            let of_one = WheelCapacity::of(&axes, &vec![1.0; axes.len()])?.least_norm_box_n_m_s;
            Some(Geometry { name, capacity_n_m_s: needed_n_m_s / of_one, torque_n_m: needed_n_m / of_one })
        });
        let geometries = held.collect();
        Ok(Self { gathered_n_m_s, needed_n_m_s, needed_n_m, geometries })
    }
}

/// The file's wheels, and others to compare.
fn geometries(spacecraft: &Spacecraft) -> Vec<(String, Vec<Vector3<f64>>)> {
    let own: Vec<_> = spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect();
    let c = (1.0_f64 / 3.0).sqrt();
    let pyramid = [(c, c), (c, -c), (-c, -c), (-c, c)].map(|(x, z)| Vector3::new(x, c, z)).to_vec();
    let orthogonal = vec![Vector3::x(), Vector3::y(), Vector3::z()];
    let own = (!own.is_empty()).then(|| (format!("the file's {}", own.len()), own));
    own.into_iter()
        .chain([
            ("four in a pyramid about Y, 54.7 deg off it".to_owned(), pyramid),
            ("three along X, Y, Z".to_owned(), orthogonal),
        ])
        .collect()
}

/// Capacity of each of the file's wheels whose least-norm box is this threshold, in N m s; the threshold itself without
/// wheels in all directions.
pub(super) fn capacity_n_m_s(spacecraft: &Spacecraft, threshold_n_m_s: f64) -> f64 {
    let axes: Vec<_> = spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect();
    let of_one =
        WheelCapacity::of(&axes, &vec![1.0; axes.len()]).map_or(1.0, |held| held.least_norm_box_n_m_s);
    threshold_n_m_s / of_one
}

/// Each way about each axis by the weakest thrusters that give it, as dumps use them.
///
/// # Errors
/// Why there is none.
pub(super) fn allocations(sized: &SizedSpacecraft) -> Result<Vec<Allocation>, String> {
    let thrusters = &sized.spacecraft.thrusters;
    if thrusters.is_empty() {
        return Err("The file has no thrusters: dumps take no propellant.".to_owned());
    }
    let center_m =
        vector(&mut sized.started().map_err(|error| error.to_string())?, "spacecraft.centerOfMass");
    let center_m = center_m.map_err(|error| error.to_string())?;
    let may_fire = |k: usize| thrusters[k].attitude_control;
    let selection = ThrusterSelection::of_the_finest(thrusters, may_fire, &center_m)
        .map_err(|error| format!("Thrusters: {error}; dumps take no propellant."))?;
    let senses = NAMES.into_iter().enumerate().flat_map(|(axis, name)| {
        [("+", 1.0), ("-", -1.0)].map(|(sign, way)| (format!("{sign}{name}"), Vector3::ith(axis, way)))
    });
    Ok(senses.map(|(sense, impulse)| allocation(thrusters, &selection, sense, &impulse)).collect())
}

fn allocation(
    thrusters: &[Thruster],
    selection: &ThrusterSelection,
    sense: String,
    impulse_n_m_s: &Vector3<f64>,
) -> Allocation {
    let fired: Vec<(&Thruster, f64)> = thrusters
        .iter()
        .zip(selection.on_times_s(impulse_n_m_s))
        .filter(|(_, on_time_s)| *on_time_s > 0.0)
        .collect();
    let impulse_n_s: f64 = fired.iter().map(|(it, on_time_s)| it.force_body_n.norm() * on_time_s).sum();
    // The pulse in which the one that fires longest is as short as its valve allows; below it nothing fires.
    let shortest = fired.iter().map(|(it, on_time_s)| it.valve.full_thrust_s(it.valve.min_on_s) / on_time_s);
    let propellant_kg: f64 = fired.iter().map(|(it, on_time_s)| it.flow_kg_s * on_time_s).sum();
    Allocation {
        sense,
        shares: fired.iter().map(|(it, on_time_s)| (it.name.clone(), *on_time_s)).collect(),
        lever_m: 1.0 / impulse_n_s,
        least_impulse_n_m_s: shortest.fold(f64::INFINITY, f64::min),
        propellant_g_per_n_m_s: 1e3 * propellant_kg,
    }
}
