//! Burn of a spinner: thrusters, train of pulses, timing and target, checked before it is simulated.

use core::f64::consts::PI;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::{
    burn_error::BurnError,
    burn_request::{BurnRequest, parameter},
    forecast::{ForecastCase, Timing},
    nutation::Spin,
    spinner::{PulseExecution, Spinner},
    train::Train,
};
use crate::attitude::Inertia;
use crate::numerics::Span;
use crate::spacecraft::{MOST_THRUSTERS, ValveTiming};

/// A transverse or axial torque below this fraction of the whole counts as none.
const NO_TORQUE: f64 = 1e-9;

/// Burn ready for simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Burn {
    /// Thrusters of even and of odd half turns.
    pub masks: [u32; 2],
    /// Torque of both, body components, in N m.
    pub torques_body_n_m: [Vector3<f64>; 2],
    /// Opening and closing of the valves of both.
    pub valves: [ValveTiming; 2],
    /// The pulses.
    pub train: Train,
    /// Timing.
    pub timing: Timing,
    /// Earliest time of the first pulse, in s.
    pub start_s: f64,
    /// Unit vector toward which the momentum moves; 0 for a spin manoeuvre, which has no direction.
    pub target_inertial: Vector3<f64>,
    /// Spin rate by which delays are computed, in rad/s.
    pub assumed_rate_rad_s: f64,
}

/// State of the body and the thrusters when a burn is requested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurnInitialConditions<'a> {
    /// The true body.
    pub spin: Spin,
    /// Its moments and principal axes.
    pub inertia: Inertia,
    /// Angular momentum, inertial, in N m s.
    pub momentum_inertial: Vector3<f64>,
    /// Propellant on board, in kg.
    pub propellant_kg: f64,
    /// Execution of pulses by the thrusters.
    pub execution: &'a [PulseExecution; MOST_THRUSTERS],
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
        let (mask, opposite_mask) = request.masks(spinner)?;
        let torque_body_n_m = spinner.thrust(mask).torque_body_n_m;
        let opposite_torque_body_n_m = opposite_mask.map(|m| spinner.thrust(m).torque_body_n_m);
        // The part across the principal axis tilts the momentum; the body's axes say what a pulse is meant for.
        let across_n_m = initial.inertia.spin_frame_from_body(&torque_body_n_m).xy().norm();
        let points = torque_body_n_m.xy().norm() > NO_TORQUE * torque_body_n_m.norm().max(NO_TORQUE);
        if !points && torque_body_n_m.z.abs() < NO_TORQUE {
            let allowed = "one that turns the body";
            return Err(parameter("burn.thruster", "a set of thrusters without torque", allowed));
        }
        request.check_numbers()?;
        let half_turn_s = 0.5 * spin.period_s();
        if points && request.pulse_width_s > half_turn_s {
            return Err(request.refused_width(&format!(
                "an attitude pulse is at most half a turn, {half_turn_s} s: beyond, it works against itself"
            )));
        }
        let target_inertial =
            if points { request.target(&initial.momentum_inertial)? } else { Vector3::zeros() };
        let assumed_rate_rad_s = spin.rate_rad_s * (1.0 + request.spin_rate_error);
        let flight =
            ForecastCase { spin: *spin, assumed_rate_rad_s, timing: request.timing, torque_n_m: across_n_m };
        let assumed =
            Spin { rate_rad_s: assumed_rate_rad_s, ratio: spin.ratio * (1.0 + request.ratio_error), ..*spin };
        let train = request.train(&ForecastCase { spin: assumed, ..flight }, points)?;
        if points && train.widest_s() > half_turn_s {
            let widest_s = train.widest_s();
            return Err(request.refused_width(&format!(
                "the plan's widest pulse is {widest_s} s, an attitude pulse at most half a turn"
            )));
        }
        if points && train.alternates() {
            let opposite_body_n_m = opposite_torque_body_n_m.unwrap_or_else(Vector3::zeros);
            request.check_opposite(&train, &torque_body_n_m, &opposite_body_n_m, across_n_m)?;
        }
        request.check_limits(&flight, &train)?;
        let masks = [mask, opposite_mask.unwrap_or(mask)];
        let timing = |half: usize| one_timing(spinner, initial.execution, masks[half]);
        let burn = Self {
            masks,
            valves: [timing(0)?, timing(usize::from(train.alternates()))?],
            torques_body_n_m: [torque_body_n_m, opposite_torque_body_n_m.unwrap_or(torque_body_n_m)],
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

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        let norm = self.target_inertial.norm();
        self.valves.iter().all(ValveTiming::is_valid) && (norm == 0.0 || (norm - 1.0).abs() < 1e-6)
    }

    /// Propellant of all its pulses, in kg.
    pub fn propellant_kg(&self, spinner: &Spinner) -> f64 {
        let flows = self.masks.map(|mask| spinner.thrust(mask).flow_kg_s);
        (0..self.train.count).map(|k| flows[self.half(k)] * self.train.width_s(k)).sum()
    }

    /// Tells whether the burn moves the direction of the momentum; a spin manoeuvre does not.
    pub fn points(&self) -> bool {
        self.target_inertial != Vector3::zeros()
    }

    /// Thrusters and torque of pulse `k`.
    pub fn actuator(&self, k: u32) -> (u32, Vector3<f64>) {
        (self.masks[self.half(k)], self.torques_body_n_m[self.half(k)])
    }

    /// Whether pulse `k` comes in an even (0) or an odd (1) half turn.
    fn half(&self, k: u32) -> usize {
        self.train.half_turns(k) as usize % 2
    }

    /// Span of pulse `k` from the opening of its valve to the closing, relative to the centre of its thrust. The valve is open
    /// for as long as the pulse's width at full thrust requires.
    pub fn about_centre(&self, k: u32) -> Span {
        let timing = &self.valves[self.half(k)];
        let on_s = timing.on_s(self.train.width_s(k));
        let before_s = timing.centre_s(on_s);
        Span::new(-before_s, on_s - before_s)
    }

    /// Refuses pulses that are too short for their valves, or whose thrust lasts longer than `longest_s`.
    fn check_valves(&self, request: &BurnRequest, longest_s: f64) -> Result<(), BurnError> {
        for timing in &self.valves {
            let least_s = timing.min_on_s.max(timing.rise_s);
            let greatest_s = longest_s - timing.rise_s - timing.tail_off_s;
            for width_s in (0..=self.train.order).map(|k| self.train.width_s(k)) {
                let on_s = timing.on_s(width_s);
                if on_s > 0.0 && on_s >= least_s * (1.0 - 1e-12) && on_s <= greatest_s {
                    continue;
                }
                let allowed = format!(
                    "a pulse of {width_s} s at full thrust opens its valve for {on_s} s: allowed is what opens it for at \
                     least thruster[k].minOnTime and riseTime ({least_s} s), with rise and tail-off within half a turn"
                );
                return Err(request.refused_width(&allowed));
            }
        }
        Ok(())
    }

    /// Duration of a turn at the assumed spin rate, in s.
    pub fn assumed_period_s(&self) -> f64 {
        2.0 * PI / self.assumed_rate_rad_s
    }
}

/// Opening and closing of the valves of thrusters that fire together.
///
/// # Errors
/// Valves that differ.
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
