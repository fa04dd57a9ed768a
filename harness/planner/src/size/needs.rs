//! Slews, wheels and thrusters that the mission needs or has, by axis.

use inputs::variables::NEVER_N_M_S;
use nalgebra::Vector3;
use packing::instance::vector;
use physics::{
    momentum::WheelArray,
    propulsion::ThrusterSelection,
    spacecraft::{Spacecraft, Thruster, Wheel},
};

use super::{momentum::Histories, sized::SizedSpacecraft};

pub(super) const NAMES: [&str; 3] = ["X", "Y", "Z"];

/// A turn about a body axis from rest to rest, speeding up for half of the time and braking for the other.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Slew {
    pub axis: &'static str,
    pub torque_n_m: f64,
    pub momentum_n_m_s: f64,
}

/// Wheels of one geometry that take what the mission needs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Geometry {
    pub name: String,
    /// Capacity and torque of each wheel, in N m s and N m.
    pub capacity_n_m_s: f64,
    pub torque_n_m: f64,
}

/// Demands on wheels about each body axis, and wheels that meet them.
pub(super) struct Wheels {
    /// Time between unloadings, in s.
    pub every_s: f64,
    /// Gathered within it beside the bias.
    pub gathered_n_m_s: Vector3<f64>,
    /// With slews and margin.
    pub needed_n_m_s: Vector3<f64>,
    pub needed_n_m: Vector3<f64>,
    /// The file's wheels first, where it has some.
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
    /// Impulse of the shortest pulse in which any of them fires, in N m s.
    pub least_impulse_n_m_s: f64,
    pub propellant_g_per_n_m_s: f64,
}

/// The slew about each body axis; none without a demand.
pub(super) fn slews(sized: &SizedSpacecraft) -> Result<Option<[Slew; 3]>, fmi::Error> {
    let Some(demand) = sized.slew else { return Ok(None) };
    let mut started = sized.started()?;
    let mut inertia_kg_m2 = Vector3::zeros();
    for axis in 0..3 {
        inertia_kg_m2[axis] = started.get_real(&format!("spacecraft.inertia[{0},{0}]", axis + 1))?;
    }
    Ok(Some([0, 1, 2].map(|axis| Slew {
        axis: NAMES[axis],
        torque_n_m: inertia_kg_m2[axis] * demand.acceleration_rad_s2(),
        momentum_n_m_s: inertia_kg_m2[axis] * demand.peak_rate_rad_s(),
    })))
}

/// Demands on wheels beside the time between unloadings.
pub(super) struct Demands<'a> {
    pub sized: &'a SizedSpacecraft,
    pub slews: &'a Option<[Slew; 3]>,
    pub margin: f64,
    /// Thresholds over which a component moves between dumps: 1 + dump.reinitFraction after one to the other side.
    pub room: f64,
}

impl<'a> Demands<'a> {
    /// Demands of a spacecraft with these slews.
    pub(super) fn new(
        sized: &'a SizedSpacecraft,
        slews: &'a Option<[Slew; 3]>,
        margin: f64,
    ) -> Result<Self, fmi::Error> {
        let is_opposite = sized.simulation.values().item("dump.reinitTo") == Some("opposite");
        let room = if is_opposite { 1.0 + sized.started()?.get_real("dump.reinitFraction")? } else { 1.0 };
        Ok(Self { sized, slews, margin, room })
    }

    fn slew(&self, of: fn(&Slew) -> f64) -> Vector3<f64> {
        self.slews.as_ref().map_or_else(Vector3::zeros, |slews| Vector3::from_fn(|axis, _| of(&slews[axis])))
    }

    /// Wheels for what the flights gather between unloadings every `every_s`.
    pub(super) fn wheels(&self, flights: &[Histories], every_s: f64) -> Wheels {
        let most = |of: &dyn Fn(&Histories) -> Vector3<f64>| {
            flights.iter().map(of).fold(Vector3::zeros(), |most: Vector3<f64>, it| most.sup(&it))
        };
        let gathered_n_m_s = most(&|flight| flight.gathered_n_m_s(every_s));
        let held_n_m_s = gathered_n_m_s / self.room;
        let needed_n_m_s = (held_n_m_s + self.slew(|it| it.momentum_n_m_s)) * (1.0 + self.margin);
        let torque_n_m = most(&|flight| flight.torque_n_m(held_n_m_s)) + self.slew(|it| it.torque_n_m);
        let needed_n_m = torque_n_m * (1.0 + self.margin);
        let geometry = |(name, axes, bias_n_m_s): (String, Vec<Vector3<f64>>, f64)| Geometry {
            name,
            capacity_n_m_s: bias_n_m_s + of_each(&axes, &needed_n_m_s),
            torque_n_m: of_each(&axes, &needed_n_m),
        };
        let geometries = geometries(&self.sized.spacecraft).into_iter().map(geometry).collect();
        Wheels { every_s, gathered_n_m_s, needed_n_m_s, needed_n_m, geometries }
    }

    /// How long the file's wheels hold what gathers, in s: infinite where no flight fills them; `None` without wheels.
    pub(super) fn lasting_s(&self, flights: &[Histories]) -> Option<f64> {
        let wheels = &self.sized.spacecraft.wheels;
        if wheels.is_empty() {
            return None;
        }
        let array = WheelArray::from_axes(&axes_of(&self.sized.spacecraft));
        let held_n_m_s = array.spanned_threshold_n_m_s(wheels.iter().map(Wheel::free_capacity_n_m_s));
        let free_n_m_s = held_n_m_s / (1.0 + self.margin) - self.slew(|it| it.momentum_n_m_s);
        let bounds_n_m_s = free_n_m_s.map(|it| it.max(0.0)) * self.room;
        let each =
            flights.iter().map(|flight| flight.shortest_beyond_s(bounds_n_m_s).unwrap_or(f64::INFINITY));
        Some(each.fold(f64::INFINITY, f64::min))
    }
}

/// Body axes along which the file's wheels hold nothing; none where it has no wheels.
pub(super) fn unspanned(spacecraft: &Spacecraft) -> Vec<usize> {
    let spanned = WheelArray::from_axes(&axes_of(spacecraft)).spanned();
    (0..3).filter(|axis| !spacecraft.wheels.is_empty() && !spanned[*axis]).collect()
}

/// Part of each of wheels alike, along these axes, that hold so much about all body axes that they span at once.
fn of_each(axes: &[Vector3<f64>], needed: &Vector3<f64>) -> f64 {
    let of_one = WheelArray::from_axes(axes).spanned_threshold_n_m_s(axes.iter().map(|_| 1.0));
    // About an axis that they do not span they hold nothing, whatever they are.
    let each = needed.iter().zip(&of_one).filter(|(_, of_one)| of_one.is_finite());
    each.map(|(needed, of_one)| needed / of_one).fold(0.0, f64::max)
}

fn axes_of(spacecraft: &Spacecraft) -> Vec<Vector3<f64>> {
    spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect()
}

/// The file's wheels, and others to compare, with the greatest bias of each.
fn geometries(spacecraft: &Spacecraft) -> Vec<(String, Vec<Vector3<f64>>, f64)> {
    let own = axes_of(spacecraft);
    let bias_n_m_s = spacecraft.wheels.iter().map(|wheel| wheel.bias_n_m_s.abs()).fold(0.0, f64::max);
    let c = (1.0_f64 / 3.0).sqrt();
    let pyramid = [(c, c), (c, -c), (-c, -c), (-c, c)].map(|(x, z)| Vector3::new(x, c, z)).to_vec();
    let orthogonal = vec![Vector3::x(), Vector3::y(), Vector3::z()];
    let own = (!own.is_empty()).then(|| (format!("the file's {}", own.len()), own, bias_n_m_s));
    own.into_iter()
        .chain([
            ("four in a pyramid about Y, 54.7 deg off it".to_owned(), pyramid, 0.0),
            ("three along X, Y, Z".to_owned(), orthogonal, 0.0),
        ])
        .collect()
}

/// Capacity of each of the file's wheels whose least-norm box is this threshold, in N m s; the threshold itself without wheels.
pub(super) fn capacity_n_m_s(spacecraft: &Spacecraft, threshold_n_m_s: &Vector3<f64>) -> f64 {
    let bias_n_m_s = spacecraft.wheels.iter().map(|wheel| wheel.bias_n_m_s.abs()).fold(0.0, f64::max);
    let reached = threshold_n_m_s.map(|it| if it >= NEVER_N_M_S { 0.0 } else { it });
    if spacecraft.wheels.is_empty() {
        reached.max()
    } else {
        bias_n_m_s + of_each(&axes_of(spacecraft), &reached)
    }
}

/// Thrusters that dump, about the centre of mass at the start.
///
/// # Errors
/// Why dumps take no propellant.
pub(super) fn dumping(sized: &SizedSpacecraft) -> Result<ThrusterSelection, String> {
    let thrusters = &sized.spacecraft.thrusters;
    if thrusters.is_empty() {
        return Err("dumps are ideal and take no propellant: the file has no [[thrusters]]".to_owned());
    }
    let mut started = sized.started().map_err(|error| error.to_string())?;
    let center_m = vector(&mut started, "spacecraft.centerOfMass").map_err(|error| error.to_string())?;
    ThrusterSelection::of_the_finest(thrusters, |k| thrusters[k].attitude_control, &center_m)
        .map_err(|error| format!("dumps are ideal and take no propellant: thrusters: {error}"))
}

/// Each way about each axis by the weakest thrusters that give it, as dumps use them.
pub(super) fn allocations(sized: &SizedSpacecraft, selection: &ThrusterSelection) -> Vec<Allocation> {
    let thrusters = &sized.spacecraft.thrusters;
    let senses = NAMES.into_iter().enumerate().flat_map(|(axis, name)| {
        [("+", 1.0), ("-", -1.0)].map(|(sign, way)| (format!("{sign}{name}"), Vector3::ith(axis, way)))
    });
    senses.map(|(sense, impulse)| allocation(thrusters, selection, sense, &impulse)).collect()
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
