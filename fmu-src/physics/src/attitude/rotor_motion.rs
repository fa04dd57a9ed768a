//! Motion of one rotor over a segment: when it comes to rest, to its capacity, or breaks away, and what it does then.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::series::{TERMS, polynomial, slope};
use super::wheel::{Motor, ReactionWheel, Rotor};
use crate::numerics::chebyshev::Segment;

/// Factor of a bound by which it exceeds what rounding adds.
const ABOVE_ROUNDING: f64 = 1.0 + 1e-9;

/// One rotor over a segment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct RotorMotion {
    pub rotor: Rotor,
    /// How it moves after the end, if that is why the segment ends.
    pub next: Option<Rotor>,
    /// Series of h + I a.w, in N m s; unused while it is held.
    pub axial: [f64; TERMS],
}

impl RotorMotion {
    /// h + I a.w by the terms up to `order`, `elapsed_s` after the start, in N m s.
    pub(super) fn axial_after(&self, order: usize, elapsed_s: f64) -> f64 {
        polynomial(&self.axial[..=order], elapsed_s)
    }

    /// Whether a simulation can produce it.
    pub(super) fn is_valid(&self) -> bool {
        self.rotor.is_valid() && self.next.is_none_or(|next| next.is_valid())
    }

    /// By how much in N m a rotor that is held is driven off its speed at the start, or one that turns through its rest or beyond
    /// its capacity, and how it then moves; `rate` is the series of the body's.
    pub(super) fn change_at_start(
        &self,
        wheel: &ReactionWheel,
        motor: &Motor,
        rate: &[Vector3<f64>],
    ) -> Option<(f64, Rotor)> {
        match self.rotor {
            Rotor::Held { .. } if wheel.locked => None,
            Rotor::Held { momentum_n_m_s } => {
                let drive = drive_n_m(wheel, motor, momentum_n_m_s, rate)[0];
                driven_off(wheel, motor, momentum_n_m_s, drive)
            }
            Rotor::Turning { direction } => {
                let term = |j: usize| self.axial[j] - wheel.carried_n_m_s(&rate[j]);
                held_back(wheel, motor, direction, term(0), || term(1))
            }
        }
    }

    /// When it changes how it moves within `longest_s`, and to what; no component of the rate changes by more than `rate_swing_rad_s`
    /// by then.
    pub(super) fn event(
        &self,
        wheel: &ReactionWheel,
        motor: &Motor,
        rate: &[Vector3<f64>],
        rate_swing_rad_s: f64,
        longest_s: f64,
    ) -> Option<(f64, Rotor)> {
        let falls_s = |terms: &[f64; TERMS]| falls_below_zero_s(&terms[..rate.len()], longest_s);
        match self.rotor {
            Rotor::Held { .. } if wheel.locked => None,
            Rotor::Held { momentum_n_m_s } => {
                let drive = drive_n_m(wheel, motor, momentum_n_m_s, rate);
                let at_rest = momentum_n_m_s == 0.0;
                let friction = wheel.coulomb_friction_n_m;
                // What is left until it is driven off, and the way it goes then.
                let ways = if at_rest { [1.0, -1.0] } else { [momentum_n_m_s.signum(); 2] };
                let exits = ways.into_iter().filter_map(|way| {
                    let left = if at_rest { plus(&drive, friction, -way) } else { plus(&drive, 0.0, way) };
                    let at_s = falls_s(&left)?;
                    Some((at_s, Rotor::Turning { direction: way }))
                });
                exits.min_by(|(a_s, _), (b_s, _)| a_s.total_cmp(b_s))
            }
            Rotor::Turning { direction } => {
                let limit = wheel.capacity_n_m_s;
                let sign = 1.0_f64.copysign(motor.torque_n_m);
                let at_start = self.axial[0] - wheel.carried_n_m_s(&rate[0]);
                let may_come = |swing_n_m_s: f64| {
                    let is_far = |first_n_m_s: f64| first_n_m_s > swing_n_m_s;
                    let may_rest = wheel.coulomb_friction_n_m > 0.0 && !is_far(direction * at_start);
                    let is_driven =
                        !motor.failed && motor.torque_n_m != 0.0 && !is_far(limit - sign * at_start);
                    [may_rest, is_driven]
                };
                // Most rotors are far from rest and capacity.
                let most =
                    swing(&self.axial[..rate.len()], longest_s) + wheel.inertia_kg_m2 * rate_swing_rad_s;
                if may_come(ABOVE_ROUNDING * most) == [false; 2] {
                    return None;
                }
                let mut relative = self.axial;
                for (term, rate) in relative.iter_mut().zip(rate) {
                    *term -= wheel.carried_n_m_s(rate);
                }
                let [may_rest, is_driven] = may_come(swing(&relative[..rate.len()], longest_s));
                let rests_s = may_rest.then(|| falls_s(&plus(&relative, 0.0, direction))).flatten();
                let full_s = is_driven.then(|| falls_s(&plus(&relative, limit, -sign))).flatten();
                match (rests_s, full_s) {
                    (Some(at_s), full_s) if full_s.is_none_or(|full_s| at_s <= full_s) => {
                        Some((at_s, Rotor::Held { momentum_n_m_s: 0.0 }))
                    }
                    (_, Some(at_s)) => Some((at_s, Rotor::Held { momentum_n_m_s: sign * limit })),
                    _ => None,
                }
            }
        }
    }
}

/// Sets the held rotor free that is driven off most, or holds the one that would move through its rest or beyond its capacity at
/// once; whether there was one. `rate` is the series of the body's.
pub(super) fn change_one(
    rotors: &mut [RotorMotion],
    wheels: &[ReactionWheel],
    motors: &[Motor],
    rate: &[Vector3<f64>],
) -> bool {
    let mut worst: Option<(f64, &mut RotorMotion, Rotor)> = None;
    for ((it, wheel), motor) in rotors.iter_mut().zip(wheels).zip(motors) {
        if let Some((excess_n_m, rotor)) = it.change_at_start(wheel, motor, rate)
            && worst.as_ref().is_none_or(|(most_n_m, ..)| excess_n_m > *most_n_m)
        {
            worst = Some((excess_n_m, it, rotor));
        }
    }
    worst.map(|(_, it, rotor)| it.rotor = rotor).is_some()
}

/// When the first rotor changes how it moves, at most `longest_s` after the start, in s, which changes that rotor.
pub(super) fn first_event_s(
    rotors: &mut [RotorMotion],
    wheels: &[ReactionWheel],
    motors: &[Motor],
    rate: &[Vector3<f64>],
    longest_s: f64,
) -> f64 {
    let rate_swing_rad_s = rate
        .iter()
        .skip(1)
        .rev()
        .fold(0.0, |sum, term| (sum + term.x.abs() + term.y.abs() + term.z.abs()) * longest_s);
    let mut first: Option<(&mut RotorMotion, f64, Rotor)> = None;
    for ((it, wheel), motor) in rotors.iter_mut().zip(wheels).zip(motors) {
        let until_s = first.as_ref().map_or(longest_s, |(_, at_s, _)| *at_s);
        if let Some((at_s, rotor)) = it.event(wheel, motor, rate, rate_swing_rad_s, until_s) {
            first = Some((it, at_s, rotor));
        }
    }
    let Some((it, at_s, rotor)) = first else { return longest_s };
    it.next = Some(rotor);
    // Time always advances.
    at_s.max(longest_s * 1e-9)
}

/// Torque that drives a held rotor off its speed at the start, along its axis, as a polynomial in time, in N m.
fn drive_n_m(wheel: &ReactionWheel, motor: &Motor, held_n_m_s: f64, rate: &[Vector3<f64>]) -> [f64; TERMS] {
    let mut drive = [0.0; TERMS];
    for ((j, rate), term) in rate.iter().enumerate().skip(1).zip(&mut drive) {
        let acceleration = rate * (j as f64);
        *term = -wheel.carried_n_m_s(&acceleration);
    }
    drive[0] += motor.torque_n_m - wheel.friction_n_m(held_n_m_s);
    drive
}

/// By how much a polynomial can differ from its first term within `longest_s`.
fn swing(terms: &[f64], longest_s: f64) -> f64 {
    terms.iter().skip(1).rev().fold(0.0, |swing, term| (swing + term.abs()) * longest_s)
}

/// When a polynomial of the segment first falls through zero within `longest_s`.
fn falls_below_zero_s(terms: &[f64], longest_s: f64) -> Option<f64> {
    if terms[0] > swing(terms, longest_s) {
        return None;
    }
    let fit = Segment::<1, { TERMS + 1 }>::fit(0.0, longest_s, |at_s| [polynomial(terms, at_s)].into());
    let falls = |at_s: &f64| slope(terms, *at_s) < 0.0;
    fit.sign_changes(0.0, longest_s).iter().find(falls)
}

/// By how much a held rotor is driven off its speed, in N m, and how it then turns.
fn driven_off(wheel: &ReactionWheel, motor: &Motor, held_n_m_s: f64, drive_n_m: f64) -> Option<(f64, Rotor)> {
    let excess_n_m = if held_n_m_s == 0.0 {
        drive_n_m.abs() - wheel.coulomb_friction_n_m
    } else if motor.failed || motor.torque_n_m * held_n_m_s <= 0.0 {
        // No motor holds it.
        f64::INFINITY
    } else {
        -drive_n_m * held_n_m_s.signum()
    };
    let direction = if held_n_m_s == 0.0 { drive_n_m } else { held_n_m_s };
    (excess_n_m > 0.0).then(|| (excess_n_m, Rotor::Turning { direction: 1.0_f64.copysign(direction) }))
}

/// By how much a rotor that turns is driven through its rest or beyond its capacity, in N m, and how it is held there.
fn held_back(
    wheel: &ReactionWheel,
    motor: &Motor,
    direction: f64,
    relative_n_m_s: f64,
    speeding_up_n_m: impl Fn() -> f64,
) -> Option<(f64, Rotor)> {
    let rounding = 4.0 * f64::EPSILON;
    let at_capacity = relative_n_m_s.abs() >= wheel.capacity_n_m_s * (1.0 - rounding);
    if at_capacity && !motor.failed && motor.torque_n_m * relative_n_m_s > 0.0 {
        let outward_n_m = speeding_up_n_m() * relative_n_m_s.signum();
        if outward_n_m > 0.0 {
            return Some((outward_n_m, Rotor::Held { momentum_n_m_s: relative_n_m_s }));
        }
    }
    let at_rest = relative_n_m_s.abs() <= rounding * wheel.capacity_n_m_s;
    let backward_n_m = if at_rest { -speeding_up_n_m() * direction } else { 0.0 };
    (wheel.coulomb_friction_n_m > 0.0 && backward_n_m > 0.0)
        .then_some((backward_n_m, Rotor::Held { momentum_n_m_s: 0.0 }))
}

/// `sign * terms + constant`.
fn plus(terms: &[f64; TERMS], constant: f64, sign: f64) -> [f64; TERMS] {
    let mut result = terms.map(|term| sign * term);
    result[0] += constant;
    result
}
