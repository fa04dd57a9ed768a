//! Rigid-body motion about principal axes under body-fixed torque as a Taylor series in time, exact to rounding within a
//! segment.
//!
//! The equations are quadratic in momentum and attitude, so the coefficients follow from one another by Cauchy
//! products. A segment is as long as the series converges to rounding, never as long as a communication step: results
//! do not depend on any step. One method serves the triaxial body, thruster arcs, outside torques and the damper.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::damper::Damper;
use crate::attitude::{Inertia, Quaternion};

/// Highest order of the series.
const ORDER: usize = 28;
/// Terms below this share of the whole are rounding.
const ROUNDING: f64 = 1.4e-17;
/// A segment turns the body by no more than this, so that a direction crosses a body axis at most once in it.
const GREATEST_TURN_RAD: f64 = 2.5;
/// Longest segment of a body that hardly turns, in s.
const LONGEST_S: f64 = 60.0;
/// Coefficients of the damper's gain over a segment.
const GAIN_TERMS: usize = 8;
/// Cosines of Chebyshev's nodes, (2 i + 1) pi / 16.
const NODE_COSINES: [f64; GAIN_TERMS] = [
    0.980_785_280_403_230_4,
    0.831_469_612_302_545_2,
    0.555_570_233_019_602_2,
    0.195_090_322_016_128_27,
    -0.195_090_322_016_128_27,
    -0.555_570_233_019_602_2,
    -0.831_469_612_302_545_2,
    -0.980_785_280_403_230_4,
];
/// Coefficients of an outside torque over time.
pub const TORQUE_TERMS: usize = 8;

type Coefficients = [f64; ORDER + 1];

/// Torque on the body in body components, polynomial in time: T(t) = sum of c[k] (t - origin)^k, in N m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyTorque {
    /// Where the polynomial is anchored, in s.
    pub origin_s: f64,
    /// c[k].
    pub coefficients_n_m: [[f64; 3]; TORQUE_TERMS],
}

impl BodyTorque {
    /// A constant torque.
    pub fn constant(torque_body_n_m: Vector3<f64>) -> Self {
        let mut coefficients_n_m = [[0.0; 3]; TORQUE_TERMS];
        coefficients_n_m[0] = torque_body_n_m.into();
        Self { origin_s: 0.0, coefficients_n_m }
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
        self.coefficients_n_m.iter().flatten().all(|&c| c == 0.0)
    }

    /// The same torque plus a constant one.
    #[must_use]
    pub fn plus(mut self, torque_body_n_m: &Vector3<f64>) -> Self {
        for (sum, more) in self.coefficients_n_m[0].iter_mut().zip(torque_body_n_m.iter()) {
            *sum += more;
        }
        self
    }

    /// The same torque plus one that is linear in time: `torque_body_n_m[0]` at `since_s` and `torque_body_n_m[1]` more in a
    /// second.
    #[must_use]
    pub fn plus_linear(mut self, torque_body_n_m: &[Vector3<f64>; 2], since_s: f64) -> Self {
        let [start, slope] = torque_body_n_m;
        if *slope == Vector3::zeros() {
            return self.plus(start);
        }
        if !self.varies() {
            self.origin_s = since_s;
        }
        let at_origin = start + slope * (self.origin_s - since_s);
        for (sum, more) in self.coefficients_n_m[1].iter_mut().zip(slope.iter()) {
            *sum += more;
        }
        self.plus(&at_origin)
    }

    /// The same torque in components about a body's principal axes.
    #[must_use]
    pub fn about_principal_axes(mut self, inertia: &Inertia) -> Self {
        for coefficients in &mut self.coefficients_n_m {
            *coefficients = inertia.principal_from_body(&Vector3::from(*coefficients)).into();
        }
        self
    }

    /// Value at a time, in N m.
    pub fn at(&self, time_s: f64) -> Vector3<f64> {
        let dt_s = time_s - self.origin_s;
        let mut sum = Vector3::zeros();
        for coefficients in self.coefficients_n_m.iter().rev() {
            sum = sum * dt_s + Vector3::from(*coefficients);
        }
        sum
    }

    /// Whether it changes with time.
    fn varies(&self) -> bool {
        self.coefficients_n_m[1..].iter().flatten().any(|&c| c != 0.0)
    }

    /// The coefficients about another time.
    fn shifted(&self, time_s: f64) -> [[f64; 3]; TORQUE_TERMS] {
        let mut shifted = self.coefficients_n_m;
        if self.varies() {
            let dt_s = time_s - self.origin_s;
            // Repeated Horner division.
            for first in 0..TORQUE_TERMS {
                for k in (first..TORQUE_TERMS - 1).rev() {
                    let above = shifted[k + 1];
                    for (c, a) in shifted[k].iter_mut().zip(above) {
                        *c += dt_s * a;
                    }
                }
            }
        }
        shifted
    }
}

/// One segment: the motion from its start on, as polynomials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaylorSegment {
    momentum_body: [Coefficients; 3],
    attitude: [Coefficients; 4],
    order: u8,
    length_s: f64,
}

impl TaylorSegment {
    /// The segment that starts at `start_s` in `attitude` with body momentum `momentum_body` (N m s), "body" being the principal
    /// axes.
    ///
    /// `hint_s` is how far the motion will be requested, if that is known; the segment may be shorter.
    pub fn new(
        inertia: &Inertia,
        damper: &Damper,
        torque: &BodyTorque,
        start_s: f64,
        attitude: Quaternion,
        momentum_body: &Vector3<f64>,
        hint_s: f64,
    ) -> Self {
        let mut segment = Self {
            momentum_body: [[0.0; ORDER + 1]; 3],
            attitude: [[0.0; ORDER + 1]; 4],
            order: 0,
            length_s: 0.0,
        };
        for axis in 0..3 {
            segment.momentum_body[axis][0] = momentum_body[axis];
        }
        for i in 0..4 {
            segment.attitude[i][0] = attitude.0[i];
        }
        let torque = torque.shifted(start_s);
        let mut gain = Gain::constant(damper.gain(momentum_body));
        segment.expand(inertia, &torque, &gain, hint_s);
        if damper.acts() {
            // The gain follows the nutation angle. It is weak, so a few rounds settle it to rounding.
            let length_s = segment.length_s.min(0.1 / damper.rate_1_s());
            let scale = momentum_body.norm() * length_s;
            for _ in 0..4 {
                let (fitted, change) = segment.fitted_gain(damper, &gain, length_s);
                if change * scale <= ROUNDING && length_s == segment.length_s {
                    break;
                }
                gain = fitted;
                segment.expand(inertia, &torque, &gain, length_s);
            }
        }
        // Convergence is judged by the greatest term, and a NaN is never the greatest.
        if !segment.is_finite() {
            segment.length_s = 0.0;
        }
        segment
    }

    /// Whether its highest coefficients, which all others go into, are finite.
    fn is_finite(&self) -> bool {
        let order = usize::from(self.order).min(ORDER);
        self.momentum_body.iter().chain(&self.attitude).all(|coefficients| coefficients[order].is_finite())
    }

    /// Whether a decoded segment can be one.
    pub fn is_valid(&self) -> bool {
        usize::from(self.order) <= ORDER && (0.0..=LONGEST_S).contains(&self.length_s)
    }

    /// How long the segment holds, in s; 0 where it does not at all.
    pub fn length_s(&self) -> f64 {
        self.length_s
    }

    /// Momentum in body components `dt_s` after the start, in N m s.
    #[inline]
    pub fn momentum_body(&self, dt_s: f64) -> Vector3<f64> {
        let order = usize::from(self.order);
        let [x, y, z] = &self.momentum_body;
        Vector3::new(horner(x, order, dt_s), horner(y, order, dt_s), horner(z, order, dt_s))
    }

    /// Attitude `dt_s` after the start.
    #[inline]
    pub fn attitude(&self, dt_s: f64) -> Quaternion {
        let order = usize::from(self.order);
        let [x, y, z, w] = &self.attitude;
        Quaternion([
            horner(x, order, dt_s),
            horner(y, order, dt_s),
            horner(z, order, dt_s),
            horner(w, order, dt_s),
        ])
        .normalized()
    }

    /// Fills the coefficients until they converge over `hint_s`, or to the highest order and then sets the length.
    fn expand(&mut self, inertia: &Inertia, torque: &[[f64; 3]; TORQUE_TERMS], gain: &Gain, hint_s: f64) {
        let inverse = inertia.principal_kg_m2().map(f64::recip);
        let h0 = Vector3::new(self.momentum_body[0][0], self.momentum_body[1][0], self.momentum_body[2][0]);
        let rate = Vector3::new(h0.x * inverse[0], h0.y * inverse[1], h0.z * inverse[2]).norm();
        let mut wanted_s = hint_s.min(LONGEST_S);
        if rate * wanted_s > GREATEST_TURN_RAD {
            wanted_s = GREATEST_TURN_RAD / rate;
        }
        let torque_size = torque[0].iter().map(|t| t.abs()).fold(0.0, f64::max);
        let momentum_scale = h0.norm().max(torque_size * wanted_s).max(f64::MIN_POSITIVE);
        // Terms of torque and gain that are not 0 must be in before convergence counts.
        let least = torque.iter().rposition(|term| *term != [0.0; 3]).unwrap_or(0).max(gain.terms);
        let mut turning = [[0.0; ORDER + 1]; 3];
        let mut braking = [[0.0; ORDER + 1]; 3];
        let (mut power, mut small) = (1.0, 0);
        for n in 0..ORDER {
            let [p23, p31, p12] = self.momentum_products(n);
            let mut next = [
                p23 * (inverse[2] - inverse[1]),
                p31 * (inverse[0] - inverse[2]),
                p12 * (inverse[1] - inverse[0]),
            ];
            if let Some(term) = torque.get(n) {
                for (sum, more) in next.iter_mut().zip(term) {
                    *sum += more;
                }
            }
            for axis in 0..3 {
                turning[axis][n] = self.momentum_body[axis][n] * inverse[axis];
            }
            if gain.terms > 0 {
                for (shape, product) in braking.iter_mut().zip([-p31, -p23, self.across_square(n)]) {
                    shape[n] = product;
                }
                for (sum, shape) in next.iter_mut().zip(&braking) {
                    *sum += gain.times(shape, n);
                }
                turning[0][n] -= gain.times(&self.momentum_body[1], n);
                turning[1][n] += gain.times(&self.momentum_body[0], n);
            }
            let scale = ((n + 1) as f64).recip();
            let turned = self.turned(n, &turning);
            for (coefficients, slope) in self.momentum_body.iter_mut().zip(next) {
                coefficients[n + 1] = slope * scale;
            }
            for (coefficients, slope) in self.attitude.iter_mut().zip(turned) {
                coefficients[n + 1] = slope * (0.5 * scale);
            }
            power *= wanted_s;
            let (momentum_term, attitude_term) = self.term_sizes(n + 1);
            let is_small =
                momentum_term * power <= ROUNDING * momentum_scale && attitude_term * power <= ROUNDING;
            small = if is_small { small + 1 } else { 0 };
            if small == 3 && n >= least {
                self.order = (n + 1) as u8;
                self.length_s = wanted_s;
                return;
            }
        }
        self.order = ORDER as u8;
        let mut length_s = wanted_s;
        for k in ORDER - 2..=ORDER {
            let (momentum_term, attitude_term) = self.term_sizes(k);
            let share = (momentum_term / momentum_scale).max(attitude_term);
            if share > 0.0 {
                length_s = length_s.min((ROUNDING / share).powf((k as f64).recip()));
            }
        }
        self.length_s = length_s;
    }

    /// Coefficients `n` of h2 h3, h3 h1, h1 h2.
    fn momentum_products(&self, n: usize) -> [f64; 3] {
        let [x, y, z] = &self.momentum_body;
        let mut sums = [0.0; 3];
        for k in 0..=n {
            sums[0] += y[k] * z[n - k];
            sums[1] += z[k] * x[n - k];
            sums[2] += x[k] * y[n - k];
        }
        sums
    }

    /// Coefficient `n` of h1^2 + h2^2.
    fn across_square(&self, n: usize) -> f64 {
        let [x, y, _] = &self.momentum_body;
        (0..=n).map(|k| x[k] * x[n - k] + y[k] * y[n - k]).sum()
    }

    /// Coefficient `n` of q * w, twice the derivative of the attitude.
    fn turned(&self, n: usize, turning: &[Coefficients; 3]) -> [f64; 4] {
        let [qx, qy, qz, qw] = &self.attitude;
        let [wx, wy, wz] = turning;
        let mut sums = [0.0; 4];
        for k in 0..=n {
            let m = n - k;
            sums[0] += qw[k] * wx[m] + qy[k] * wz[m] - qz[k] * wy[m];
            sums[1] += qw[k] * wy[m] + qz[k] * wx[m] - qx[k] * wz[m];
            sums[2] += qw[k] * wz[m] + qx[k] * wy[m] - qy[k] * wx[m];
            sums[3] -= qx[k] * wx[m] + qy[k] * wy[m] + qz[k] * wz[m];
        }
        sums
    }

    fn term_sizes(&self, k: usize) -> (f64, f64) {
        let momentum = self.momentum_body.iter().map(|c| c[k].abs()).fold(0.0, f64::max);
        let attitude = self.attitude.iter().map(|c| c[k].abs()).fold(0.0, f64::max);
        (momentum, attitude)
    }

    /// The damper's gain over the segment as a polynomial through Chebyshev nodes, and its greatest change at them.
    fn fitted_gain(&self, damper: &Damper, before: &Gain, length_s: f64) -> (Gain, f64) {
        let mut nodes = [0.0; GAIN_TERMS];
        let mut values = [0.0; GAIN_TERMS];
        let mut change = 0.0_f64;
        for i in 0..GAIN_TERMS {
            nodes[i] = 0.5 * length_s * (1.0 - NODE_COSINES[i]);
            values[i] = damper.gain(&self.momentum_body(nodes[i]));
            change = change.max((values[i] - before.at(nodes[i])).abs());
        }
        // Newton's divided differences, then to powers of time.
        for level in 1..GAIN_TERMS {
            for i in (level..GAIN_TERMS).rev() {
                values[i] = (values[i] - values[i - 1]) / (nodes[i] - nodes[i - level]);
            }
        }
        let mut powers = [0.0; GAIN_TERMS];
        for i in (0..GAIN_TERMS).rev() {
            for k in (0..GAIN_TERMS).rev() {
                let below = if k > 0 { powers[k - 1] } else { 0.0 };
                powers[k] = below - nodes[i] * powers[k];
            }
            powers[0] += values[i];
        }
        (Gain { powers, terms: GAIN_TERMS }, change)
    }
}

/// The damper's gain over a segment, a polynomial in time.
struct Gain {
    powers: [f64; GAIN_TERMS],
    /// How many count.
    terms: usize,
}

impl Gain {
    fn constant(value: f64) -> Self {
        let mut powers = [0.0; GAIN_TERMS];
        powers[0] = value;
        Self { powers, terms: usize::from(value != 0.0) }
    }

    fn at(&self, dt_s: f64) -> f64 {
        self.powers.iter().rev().fold(0.0, |sum, power| sum * dt_s + power)
    }

    /// Coefficient `n` of its product with another series.
    fn times(&self, series: &Coefficients, n: usize) -> f64 {
        (0..self.terms.min(n + 1)).map(|j| self.powers[j] * series[n - j]).sum()
    }
}

#[inline]
fn horner(coefficients: &Coefficients, order: usize, x: f64) -> f64 {
    let mut sum = 0.0;
    for k in (0..=order.min(ORDER)).rev() {
        sum = sum * x + coefficients[k];
    }
    sum
}
