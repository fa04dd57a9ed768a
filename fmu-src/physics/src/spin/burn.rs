//! A burn: which thrusters, which train, timed how, toward what; checked before it is simulated.

use core::f64::consts::PI;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::{
    burn_error::{BurnError, ParameterError},
    execution::PulseExecution,
    forecast::{ForecastCase, Range, Timing},
    nutation::Spin,
    sizing::sized,
    spinner::Spinner,
    train::{Pulses, Shape, Train, TrainError},
};
use crate::attitude::{Inertia, angle_between_rad};
use crate::spacecraft::{MOST_THRUSTERS, ValveTiming};

/// A transverse or axial torque below this share of the whole counts as none.
const NO_TORQUE: f64 = 1e-9;
/// Cosine of the greatest angle by which "opposite" may be off.
const OPPOSITE: f64 = -0.996;
/// Relative difference up to which opposite torques are of one size: every pulse of a train counts alike.
const ONE_SIZE: f64 = 1e-3;
/// A target closer than this to the momentum's line has no direction across it but rounding, in rad.
const ALONG_RAD: f64 = 1e-6;

/// What a burn is requested to be. Numbers that are 0 where the field says so mean "not given".
#[derive(Clone, Debug, PartialEq)]
pub struct BurnRequest {
    /// Shape of the train.
    pub shape: Shape,
    /// Timing.
    pub timing: Timing,
    /// Not before, in s.
    pub start_s: f64,
    /// Thruster number from 1.
    pub thruster: i32,
    /// Opposite thruster number from 1; 0 for none.
    pub opposite_thruster: i32,
    /// Named group or thruster in place of the numbers; empty for none.
    pub group: String,
    /// Width of a pulse (of the outermost of a taper) at full thrust, in s.
    pub pulse_width_s: f64,
    /// Turns from pulse to pulse.
    pub turns_per_pulse: f64,
    /// Number of pulses; used where `angle_rad` is 0.
    pub count: i32,
    /// How far the momentum shall move, in rad; 0 to use `count`.
    pub angle_rad: f64,
    /// Smallest step of pulse width, in s: tapers of whole steps stay whole; 0 for none.
    pub resolution_s: f64,
    /// Direction toward which the momentum moves, inertial.
    pub target_inertial: Vector3<f64>,
    /// (assumed - true) / true spin rate.
    pub spin_rate_error: f64,
    /// (assumed - true) / true inertia ratio: the train is made for the assumed one.
    pub ratio_error: f64,
    /// Half width of the range of inertia ratios for which limits shall hold.
    pub ratio_uncertainty: f64,
    /// Limit on nutation at any time, in rad; 0 for none.
    pub max_nutation_rad: f64,
    /// Limit on the time from first to last edge, in s; 0 for none.
    pub max_duration_s: f64,
}

/// A burn ready for simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Burn {
    /// Thrusters of even half turns.
    pub mask: u32,
    /// Thrusters of odd half turns.
    pub opposite_mask: u32,
    /// Torque of `mask`, body components, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// Torque of `opposite_mask`.
    pub opposite_torque_body_n_m: Vector3<f64>,
    /// How the valves of both open and close.
    pub valves: [ValveTiming; 2],
    /// The pulses.
    pub train: Train,
    /// Timing.
    pub timing: Timing,
    /// Not before, in s.
    pub start_s: f64,
    /// Unit vector toward which the momentum moves; 0 for a spin manoeuvre, which has no direction.
    pub target_inertial: Vector3<f64>,
    /// Spin rate by which delays are computed, in rad/s.
    pub assumed_rate_rad_s: f64,
}

/// What a burn starts from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurnInitialConditions<'a> {
    /// The true body.
    pub spin: Spin,
    /// Its moments and principal axes.
    pub inertia: Inertia,
    /// Angular momentum, inertial, in N m s.
    pub momentum_inertial: Vector3<f64>,
    /// On board, in kg.
    pub propellant_kg: f64,
    /// How thrusters execute pulses.
    pub execution: &'a [PulseExecution; MOST_THRUSTERS],
}

/// Whether two torques (body components, in N m) push opposite ways across the spin axis and equally hard: within 5 deg
/// and a thousandth.
pub fn opposes(torque_body_n_m: &Vector3<f64>, other_body_n_m: &Vector3<f64>) -> bool {
    cosine_across(torque_body_n_m, other_body_n_m) <= OPPOSITE && of_one_size(torque_body_n_m, other_body_n_m)
}

/// Cosine of the angle between the parts across the spin axis; NaN where one has none.
fn cosine_across(one: &Vector3<f64>, other: &Vector3<f64>) -> f64 {
    one.xy().dot(&other.xy()) / (one.xy().norm() * other.xy().norm())
}

fn of_one_size(one: &Vector3<f64>, other: &Vector3<f64>) -> bool {
    (other.xy().norm() / one.xy().norm() - 1.0).abs() <= ONE_SIZE
}

impl Burn {
    /// Checks a request against hardware, physics and limits.
    ///
    /// # Errors
    /// A parameter out of its range, a train that cannot be simulated, limits or propellant that it does not fit.
    pub fn new(
        spinner: &Spinner,
        request: &BurnRequest,
        initial: &BurnInitialConditions<'_>,
    ) -> Result<Self, BurnError> {
        let spin = &initial.spin;
        let (mask, opposite_mask) = masks(spinner, request)?;
        let torque_body_n_m = spinner.thrust(mask).torque_body_n_m;
        let opposite_torque_body_n_m = opposite_mask.map(|m| spinner.thrust(m).torque_body_n_m);
        // What tilts the momentum is across the principal axis; what a pulse is meant for, its body axes say.
        let across_n_m = initial.inertia.spin_frame_from_body(&torque_body_n_m).xy().norm();
        let points = torque_body_n_m.xy().norm() > NO_TORQUE * torque_body_n_m.norm().max(NO_TORQUE);
        if !points && torque_body_n_m.z.abs() < NO_TORQUE {
            return Err(parameter(
                "burn.thruster",
                "a set of thrusters without torque",
                "one that turns the body",
            ));
        }
        for (name, error) in
            [("burn.spinRateError", request.spin_rate_error), ("burn.ratioError", request.ratio_error)]
        {
            if !(error > -0.5 && error < 0.5) {
                return Err(parameter(name, error, "allowed is -0.5 to 0.5"));
            }
        }
        if !request.start_s.is_finite() {
            return Err(parameter("burn.start", request.start_s, "it must be a time"));
        }
        let half_turn_s = 0.5 * spin.period_s();
        if points && request.pulse_width_s > half_turn_s {
            let allowed = format!(
                "an attitude pulse is at most half a turn, {half_turn_s} s: beyond, it works against itself"
            );
            return Err(refused_width(request, &allowed));
        }
        let mut target_inertial = Vector3::zeros();
        if points {
            let norm = request.target_inertial.norm();
            if !(norm.is_finite() && norm > 0.0) {
                let found = format!("{:?}", request.target_inertial.as_slice());
                return Err(parameter("burn.targetDirection", found, "it must be a direction"));
            }
            target_inertial = request.target_inertial / norm;
            check_target(request, &target_inertial, &initial.momentum_inertial)?;
        }
        let assumed_rate_rad_s = spin.rate_rad_s * (1.0 + request.spin_rate_error);
        let flight =
            ForecastCase { spin: *spin, assumed_rate_rad_s, timing: request.timing, torque_n_m: across_n_m };
        let assumed =
            Spin { rate_rad_s: assumed_rate_rad_s, ratio: spin.ratio * (1.0 + request.ratio_error), ..*spin };
        let train = train(request, &ForecastCase { spin: assumed, ..flight }, points)?;
        if points && train.widest_s() > half_turn_s {
            let allowed = format!(
                "the plan's widest pulse is {} s, an attitude pulse at most half a turn",
                train.widest_s()
            );
            return Err(refused_width(request, &allowed));
        }
        if points && train.alternates() {
            let opposite = opposite_torque_body_n_m.unwrap_or_else(Vector3::zeros);
            let cosine = cosine_across(&torque_body_n_m, &opposite);
            if cosine.is_nan() || cosine > OPPOSITE {
                return Err(TrainError::Cancels { turns: train.turns_per_pulse() }.into());
            }
            if !of_one_size(&torque_body_n_m, &opposite) {
                let name = if request.group.is_empty() { "burn.oppositeThruster" } else { "burn.group" };
                let found = format!(
                    "a pair of {across_n_m:.6} and {:.6} N m across the spin axis",
                    opposite.xy().norm()
                );
                return Err(parameter(
                    name,
                    found,
                    "thrusters that alternate must have one torque, within 0.1 %",
                ));
            }
        }
        check_limits(request, &flight, &train)?;
        let opposite_mask = opposite_mask.unwrap_or(mask);
        let valves = [mask, if train.alternates() { opposite_mask } else { mask }];
        let burn = Self {
            mask,
            opposite_mask,
            valves: [
                one_timing(spinner, initial.execution, valves[0])?,
                one_timing(spinner, initial.execution, valves[1])?,
            ],
            torque_body_n_m,
            opposite_torque_body_n_m: opposite_torque_body_n_m.unwrap_or(torque_body_n_m),
            train,
            timing: request.timing,
            start_s: request.start_s,
            target_inertial,
            assumed_rate_rad_s,
        };
        burn.check_valves(request, if points { half_turn_s } else { f64::INFINITY })?;
        let needed_kg = burn.propellant_kg(spinner);
        // Rounding of the sum is no propellant.
        if needed_kg > initial.propellant_kg * (1.0 + 1e-12) {
            return Err(BurnError::Limit {
                what: "its propellant",
                found: format!("{needed_kg:.6} kg"),
                limit: format!("propellant.loaded = {} kg", initial.propellant_kg),
            });
        }
        Ok(burn)
    }

    /// Whether the vectors of a decoded burn can be some.
    pub fn is_valid(&self) -> bool {
        let norm = self.target_inertial.norm();
        self.valves.iter().all(ValveTiming::is_valid) && (norm == 0.0 || (norm - 1.0).abs() < 1e-6)
    }

    /// Propellant of all its pulses, in kg.
    pub fn propellant_kg(&self, spinner: &Spinner) -> f64 {
        let flows = [self.mask, self.opposite_mask].map(|mask| spinner.thrust(mask).flow_kg_s);
        (0..self.train.count())
            .map(|k| flows[self.train.half_turns(k) as usize % 2] * self.train.width_s(k))
            .sum()
    }

    /// Whether it moves the momentum's direction; a spin manoeuvre does not.
    pub fn points(&self) -> bool {
        self.target_inertial != Vector3::zeros()
    }

    /// Thrusters and torque of pulse `k`.
    pub fn actuator(&self, k: u32) -> (u32, Vector3<f64>) {
        if self.train.half_turns(k) % 2 == 1 {
            (self.opposite_mask, self.opposite_torque_body_n_m)
        } else {
            (self.mask, self.torque_body_n_m)
        }
    }

    /// From the opening of pulse `k`'s valve to the centre of its thrust, and from there to the closing, in s. The valve is open
    /// for what gives the pulse's width at full thrust.
    pub fn about_centre_s(&self, k: u32) -> [f64; 2] {
        let timing = &self.valves[self.train.half_turns(k) as usize % 2];
        let on_s = timing.on_s(self.train.width_s(k));
        let before_s = timing.centre_s(on_s);
        [before_s, on_s - before_s]
    }

    /// Refuses pulses that are too short for their valves, or whose thrust lasts longer than `longest_s`.
    fn check_valves(&self, request: &BurnRequest, longest_s: f64) -> Result<(), BurnError> {
        for timing in &self.valves {
            let least_s = timing.min_on_s.max(timing.rise_s);
            let greatest_s = longest_s - timing.rise_s - timing.tail_off_s;
            for width_s in (0..=self.train.order()).map(|k| self.train.width_s(k)) {
                let on_s = timing.on_s(width_s);
                if on_s > 0.0 && on_s >= least_s * (1.0 - 1e-12) && on_s <= greatest_s {
                    continue;
                }
                let allowed = format!(
                    "a pulse of {width_s} s at full thrust opens its valve for {on_s} s: allowed is what opens it for at \
                     least thruster[k].minOnTime and riseTime ({least_s} s), with rise and tail-off within half a turn"
                );
                return Err(refused_width(request, &allowed));
            }
        }
        Ok(())
    }

    /// Seconds a turn is taken to last.
    pub fn assumed_period_s(&self) -> f64 {
        2.0 * PI / self.assumed_rate_rad_s
    }
}

/// How the valves of thrusters that fire together open and close.
fn one_timing(
    spinner: &Spinner,
    execution: &[PulseExecution; MOST_THRUSTERS],
    mask: u32,
) -> Result<ValveTiming, BurnError> {
    let mut of_mask = (0..MOST_THRUSTERS).filter(|k| mask >> k & 1 == 1);
    let first = of_mask.next().unwrap_or(0);
    let timing = execution[first].valve;
    match of_mask.find(|k| execution[*k].valve != timing) {
        None => Ok(timing),
        Some(k) => {
            let names = [first, k].map(|k| spinner.thrusters.get(k).map_or("", |it| it.name.as_str()));
            Err(parameter(
                "burn.group",
                format!("a group with {} and {}, whose valves differ", names[0], names[1]),
                "thrusters that fire together in a burn have one minOnTime, riseTime and tailOffTime",
            ))
        }
    }
}

fn parameter(name: &'static str, found: impl ToString, allowed: &str) -> BurnError {
    ParameterError::new(name, found, allowed).into()
}

fn refused_width(request: &BurnRequest, allowed: &str) -> BurnError {
    parameter("burn.pulseWidth", format!("{} s", request.pulse_width_s), allowed)
}

/// The momentum is moved toward a point: there must be a way to it, and no plan goes beyond.
fn check_target(
    request: &BurnRequest,
    target_inertial: &Vector3<f64>,
    momentum_inertial: &Vector3<f64>,
) -> Result<(), BurnError> {
    let apart_rad = angle_between_rad(momentum_inertial, target_inertial);
    let apart_deg = apart_rad.to_degrees();
    // Written so that a NaN is refused.
    if !(apart_rad > ALONG_RAD && apart_rad < PI - ALONG_RAD) {
        let found =
            format!("{:?}, {apart_deg:.6} deg from the angular momentum", request.target_inertial.as_slice());
        return Err(parameter("burn.targetDirection", found, "it needs a part across the angular momentum"));
    }
    if request.angle_rad > apart_rad * (1.0 + 1e-9) {
        let found = format!("{} rad ({:.4} deg)", request.angle_rad, request.angle_rad.to_degrees());
        let allowed = format!(
            "burn.targetDirection is {apart_deg:.4} deg from the angular momentum, and a burn goes no farther than its \
             target: allowed is up to {apart_rad} rad, or a target farther away"
        );
        return Err(parameter("burn.angle", found, &allowed));
    }
    Ok(())
}

fn masks(spinner: &Spinner, request: &BurnRequest) -> Result<(u32, Option<u32>), BurnError> {
    if !request.group.is_empty() {
        return spinner.named(&request.group).ok_or_else(|| {
            let names: Vec<&str> = spinner
                .groups
                .iter()
                .map(|group| group.name.as_str())
                .chain(spinner.thrusters.iter().map(|thruster| thruster.name.as_str()))
                .collect();
            let allowed = format!("this spacecraft has {}", names.join(", "));
            parameter("burn.group", format!("\"{}\"", request.group), &allowed)
        });
    }
    let count = spinner.thrusters.len();
    let bit = |name: &'static str, number: i32| match usize::try_from(number) {
        Ok(k) if (1..=count).contains(&k) => Ok(1_u32 << (k - 1)),
        _ => Err(parameter(name, number, &format!("this spacecraft has thrusters 1 to {count}"))),
    };
    let main = bit("burn.thruster", request.thruster)?;
    let opposite = match request.opposite_thruster {
        0 => None,
        number => Some(bit("burn.oppositeThruster", number)?),
    };
    Ok((main, opposite))
}

fn train(request: &BurnRequest, flight: &ForecastCase, points: bool) -> Result<Train, BurnError> {
    if request.angle_rad.is_nan() || request.angle_rad < 0.0 {
        return Err(parameter("burn.angle", request.angle_rad, "allowed is 0 (use burn.count) or an angle"));
    }
    let pulses = Pulses {
        shape: request.shape,
        unit_width_s: request.pulse_width_s,
        turns_per_pulse: request.turns_per_pulse,
        resolution_s: request.resolution_s,
    };
    if request.angle_rad == 0.0 || !points {
        let count = u32::try_from(request.count)
            .map_err(|_| parameter("burn.count", request.count, "allowed is 1 or more"))?;
        return Ok(Train::new(&pulses, count, &flight.spin)?);
    }
    sized(&pulses, flight, request.angle_rad)
}

fn check_limits(request: &BurnRequest, flight: &ForecastCase, train: &Train) -> Result<(), BurnError> {
    for (name, value) in [
        ("burn.maxDuration", request.max_duration_s),
        ("burn.maxNutation", request.max_nutation_rad),
        ("burn.ratioUncertainty", request.ratio_uncertainty),
    ] {
        if value.is_nan() || value < 0.0 {
            return Err(parameter(name, value, "allowed is 0 or a positive number"));
        }
    }
    let duration_s = train.duration_s(flight.spin.period_s());
    if request.max_duration_s > 0.0 && duration_s > request.max_duration_s {
        return Err(BurnError::Limit {
            what: "its duration",
            found: format!("{duration_s:.3} s"),
            limit: format!("burn.maxDuration = {} s", request.max_duration_s),
        });
    }
    if request.max_nutation_rad > 0.0 {
        let range = Range { ratio: request.ratio_uncertainty, rate_rad_s: 0.0 };
        let peak_rad = range.worst(flight, train).peak_nutation_rad;
        if peak_rad > request.max_nutation_rad {
            return Err(BurnError::Limit {
                what: "its greatest nutation",
                found: format!("{:.6} deg", peak_rad.to_degrees()),
                limit: format!("burn.maxNutation = {:.6} deg", request.max_nutation_rad.to_degrees()),
            });
        }
    }
    Ok(())
}
