//! Rigid-body motion about principal axes under body-fixed torque as a Taylor series in time, exact to rounding within a
//! segment.
//!
//! The equations are those of [`crate::attitude::series`], quadratic in momentum and attitude, with w = J^-1 m + G (e3 x m) of
//! the damper ([`super::damper`]) and jet damping ([`JetDamping`]) in the torque. A segment is as long as the series converges
//! to rounding, never as long as a communication step: results do not depend on any step. One method serves the triaxial body,
//! thruster arcs, outside torques and the damper.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::damper::Damper;
use crate::attitude::series::{ROUNDING, RotationSeries, exact_length_s, polynomial, product, through};
use crate::attitude::{Inertia, JetDamping, Quaternion};
use crate::numerics::chebyshev::Segment;

/// Highest order of the series.
const ORDER: usize = 28;
/// A segment turns the body by no more than this, so that a direction crosses a body axis at most once in it.
const GREATEST_TURN_RAD: f64 = 2.5;
/// Longest segment of a body that hardly turns, in s.
const LONGEST_S: f64 = 60.0;
/// Coefficients of the damper's gain over a segment.
const GAIN_TERMS: usize = 8;
/// Coefficients of an outside torque over time.
pub const TORQUE_TERMS: usize = 8;

/// Torque on the body in body components, polynomial in time, with jet damping: T(t) = sum of c[k] (t - origin)^k - D(t) w, in
/// N m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyTorque {
    /// Origin of the polynomial, in s.
    pub origin_s: f64,
    /// c[k].
    pub coefficients_n_m: [Vector3<f64>; TORQUE_TERMS],
    /// D, from the origin on.
    pub jet_damping: JetDamping,
}

impl BodyTorque {
    /// A constant torque.
    pub fn constant(torque_body_n_m: Vector3<f64>) -> Self {
        let mut torque = Self::default();
        torque.coefficients_n_m[0] = torque_body_n_m;
        torque
    }

    /// Adds the derivative of an order from 1 along a body axis, at the origin; `None` beyond the orders that are used.
    pub fn set_derivative(&mut self, axis: usize, order: u32, derivative: f64) -> Option<()> {
        let coefficients = self.coefficients_n_m.get_mut(order as usize)?;
        let factorial: f64 = (1..=order).map(f64::from).product();
        coefficients[axis] = derivative / factorial;
        Some(())
    }

    /// Whether it vanishes at all times.
    pub fn is_zero(&self) -> bool {
        self.coefficients_n_m.iter().all(|c| *c == Vector3::zeros())
            && self.jet_damping == JetDamping::default()
    }

    /// The same outside torque plus one that is linear in time: `torque_body_n_m[0]` at `since_s` and `torque_body_n_m[1]` more in
    /// a second; jet damping likewise.
    #[must_use]
    pub fn plus_linear(
        mut self,
        torque_body_n_m: &[Vector3<f64>; 2],
        jet_damping: JetDamping,
        since_s: f64,
    ) -> Self {
        let [start, slope] = torque_body_n_m;
        let varies = *slope != Vector3::zeros() || jet_damping.terms_kg_m2_s[1] != Matrix3::zeros();
        if !self.varies() && varies {
            self.origin_s = since_s;
        }
        let elapsed_s = self.origin_s - since_s;
        self.coefficients_n_m[0] += start + slope * elapsed_s;
        self.coefficients_n_m[1] += slope;
        self.jet_damping = jet_damping.after(elapsed_s);
        self
    }

    /// The same torque in components about a body's principal axes.
    #[must_use]
    pub fn about_principal_axes(mut self, inertia: &Inertia) -> Self {
        self.coefficients_n_m = self.coefficients_n_m.map(|it| inertia.principal_from_body(&it));
        let columns = |it: &Matrix3<f64>| {
            Matrix3::from_columns(&[0, 1, 2].map(|k| inertia.principal_from_body(&it.column(k).into())))
        };
        // R D R^T of a symmetric matrix.
        let terms = &mut self.jet_damping.terms_kg_m2_s;
        *terms = terms.map(|it| columns(&columns(&it).transpose()));
        self
    }

    /// Value at a time on a body that turns like this (body components, rad/s), in N m.
    pub fn at(&self, time_s: f64, rate_body_rad_s: &Vector3<f64>) -> Vector3<f64> {
        let elapsed_s = time_s - self.origin_s;
        polynomial(&self.coefficients_n_m, elapsed_s)
            + self.jet_damping.torque_n_m(elapsed_s, rate_body_rad_s)
    }

    /// Whether it changes with time.
    fn varies(&self) -> bool {
        self.coefficients_n_m[1..].iter().any(|c| *c != Vector3::zeros())
    }

    /// The same with another origin.
    fn shifted(&self, time_s: f64) -> Self {
        let mut shifted = self.coefficients_n_m;
        if self.varies() {
            let dt_s = time_s - self.origin_s;
            // Repeated Horner division.
            for first in 0..TORQUE_TERMS {
                for k in (first..TORQUE_TERMS - 1).rev() {
                    let above = shifted[k + 1];
                    shifted[k] += above * dt_s;
                }
            }
        }
        let jet_damping = self.jet_damping.after(time_s - self.origin_s);
        Self { origin_s: time_s, coefficients_n_m: shifted, jet_damping }
    }
}

/// A state of motion at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Anchor {
    /// When, in s.
    pub time_s: f64,
    /// Attitude then.
    pub attitude: Quaternion,
    /// Angular momentum then, inertial, in N m s.
    pub momentum_inertial: Vector3<f64>,
}

/// One segment: the motion from its start on, as polynomials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaylorSegment {
    series: RotationSeries<{ ORDER + 1 }>,
    /// How long the segment holds, in s; 0 where it does not at all.
    pub length_s: f64,
}

impl TaylorSegment {
    /// The segment that starts at `anchor`, its attitude being that of the principal axes, about which `torque` is too.
    ///
    /// `hint_s` is how far the motion will be evaluated, if that is known; the segment may be shorter.
    pub fn new(
        inertia: &Inertia,
        damper: &Damper,
        torque: &BodyTorque,
        anchor: &Anchor,
        hint_s: f64,
    ) -> Self {
        let momentum_body = &anchor.attitude.body_from_inertial(&anchor.momentum_inertial);
        let series = RotationSeries::new(anchor.attitude, Vector3::zeros(), *momentum_body);
        let mut segment = Self { series, length_s: 0.0 };
        let torque = torque.shifted(anchor.time_s);
        let mut gain = [0.0; GAIN_TERMS];
        gain[0] = damper.gain(momentum_body);
        segment.expand(inertia, &torque, &gain[..usize::from(gain[0] != 0.0)], hint_s);
        if damper.acts() {
            // The gain follows the nutation angle. It is weak, so a few rounds converge to rounding.
            let length_s = segment.length_s.min(0.1 / damper.rate_1_s);
            let scale = momentum_body.norm() * length_s;
            for _ in 0..4 {
                let nodes_s = Segment::<1, GAIN_TERMS>::nodes(0.0, length_s);
                let values = nodes_s.map(|at_s| damper.gain(&segment.momentum_body(at_s)));
                let changes =
                    nodes_s.iter().zip(values).map(|(at_s, it)| (it - polynomial(&gain, *at_s)).abs());
                if changes.fold(0.0, f64::max) * scale <= ROUNDING && length_s == segment.length_s {
                    break;
                }
                gain = through(&nodes_s, values);
                segment.expand(inertia, &torque, &gain, length_s);
            }
        }
        // Convergence is judged by the greatest term, and a NaN is never the greatest.
        let RotationSeries { order, attitude, momentum, .. } = &segment.series;
        let last = attitude[*order].iter().chain(&momentum[*order]);
        if !last.into_iter().all(|it| it.is_finite()) {
            segment.length_s = 0.0;
        }
        segment
    }

    /// Whether a decoded segment can be one.
    pub fn is_valid(&self) -> bool {
        self.series.is_valid() && (0.0..=LONGEST_S).contains(&self.length_s)
    }

    /// Momentum in body components `dt_s` after the start, in N m s.
    #[inline]
    pub fn momentum_body(&self, dt_s: f64) -> Vector3<f64> {
        polynomial(&self.series.momentum[..=self.series.order], dt_s)
    }

    /// Attitude `dt_s` after the start.
    #[inline]
    pub fn attitude(&self, dt_s: f64) -> Quaternion {
        self.series.attitude_after(dt_s)
    }

    /// Fills the coefficients until they converge over `hint_s`, or to the highest order and then sets the length.
    fn expand(&mut self, inertia: &Inertia, torque: &BodyTorque, gain: &[f64], hint_s: f64) {
        let BodyTorque { coefficients_n_m: torque, jet_damping, .. } = torque;
        let jets_act = *jet_damping != JetDamping::default();
        let inverse = Vector3::from(inertia.principal_kg_m2().map(f64::recip));
        let Self { series, length_s } = self;
        let momentum = series.momentum[0];
        let rate = momentum.component_mul(&inverse).norm();
        *length_s = hint_s.min(LONGEST_S);
        if rate * *length_s > GREATEST_TURN_RAD {
            *length_s = GREATEST_TURN_RAD / rate;
        }
        let scale = momentum.norm().max(torque[0].amax() * *length_s).max(f64::MIN_POSITIVE);
        // Terms of torque and gain that are not 0 must be in before convergence counts.
        let least = torque.iter().rposition(|term| *term != Vector3::zeros()).unwrap_or(0).max(gain.len());
        let size = |series: &RotationSeries<_>, n: usize| {
            (series.momentum[n].amax() / scale).max(series.attitude[n].amax())
        };
        let (mut power, mut small) = (1.0, 0);
        series.order = 0;
        loop {
            let n = series.order;
            let braked: Vector3<f64> = product(gain, &series.momentum, n);
            series.rate[n] =
                series.momentum[n].component_mul(&inverse) + Vector3::new(-braked.y, braked.x, 0.0);
            if n == ORDER || (small == 3 && n > least) {
                break;
            }
            let mut torque_n_m = torque.get(n).copied().unwrap_or_default();
            if jets_act {
                torque_n_m += jet_damping.term(&series.rate, n);
            }
            series.extend(torque_n_m);
            power *= *length_s;
            small = if size(series, n + 1) * power <= ROUNDING { small + 1 } else { 0 };
        }
        if series.order == ORDER {
            *length_s = exact_length_s(*length_s, (ORDER - 2..=ORDER).map(|n| (n, size(series, n))));
        }
    }
}
