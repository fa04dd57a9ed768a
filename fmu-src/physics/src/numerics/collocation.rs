//! Gauss collocation: an implicit Runge-Kutta integrator of any order whose dense output is the solution itself.
//!
//! Equation: dy/dt = f(t, y), y given at the start of a segment of length h.
//! Method: on one segment the solution is the polynomial of degree `S` whose derivative equals the right-hand side at the
//! `S` Gauss-Legendre nodes. The equations are solved by Gauss-Seidel sweeps, which suits smooth, non-stiff motion: segments
//! should be shorter than the time in which the motion changes direction.
//! Order: `2 S` at the segment's end, `h^(S+1)` uniformly within it. Quadratic invariants (the norm of a quaternion, angular
//! momentum, rotational energy) are kept to rounding for any segment length.
//! Error measure: the sweeps end when a sweep changes the solution by rounding; the truncation is not estimated: the length
//! is the caller's, who states what it gives (see `environment::orbit`).
//! Reference: Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1.3 and IV.2.
//!
//! [`Collocation`] holds the method's coefficients (computed, no state). [`SegmentChain`] is the state of one integration:
//! a chain of segments with edges at whole multiples of their length, serialisable; it keeps the last one.

use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::chebyshev::Segment;
use super::quadrature::{Rule, lagrange};

/// Why a segment could not be integrated.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum IntegrationError {
    /// The sweeps do not converge.
    #[error(
        "the integration from {from_s} s to {to_s} s does not converge (last relative change {change:e}): \
         the motion is too fast for a segment of this length, make it shorter"
    )]
    NotConverged {
        /// Start of the segment, s.
        from_s: f64,
        /// End of the segment, s.
        to_s: f64,
        /// Last change of a stage relative to its size.
        change: f64,
    },
    /// The right-hand side or the start is not a finite number.
    #[error("the motion is not finite at {at_s} s")]
    NotFinite {
        /// Time, s.
        at_s: f64,
    },
}

/// Coefficients of Gauss collocation with `S` nodes; `M` must be `S + 1`, the coefficients of the dense output.
#[derive(Clone, Debug)]
pub struct Collocation<const S: usize, const M: usize> {
    /// Nodes on [-1, 1].
    rule: Rule<S>,
    /// Row i: weights of the integral from -1 to node i.
    to_node: SMatrix<f64, S, S>,
    /// Column k: how the values at the nodes make the k-th Chebyshev coefficient of the integral from -1.
    to_integral: SMatrix<f64, S, M>,
}

impl<const S: usize, const M: usize> Default for Collocation<S, M> {
    /// Computes the coefficients.
    fn default() -> Self {
        const { assert!(M == S + 1 && S > 0, "dense output has one coefficient more than there are nodes") }
        let rule = Rule::<S>::gauss_legendre();
        // Each Lagrange basis polynomial of the nodes, integrated from -1.
        let basis = Segment::<S, S>::fit(-1.0, 1.0, |x| SVector::from(lagrange(&rule.nodes, x)));
        let integral: Segment<S, M> = basis.integral(SVector::zeros());
        let mut to_node = SMatrix::<f64, S, S>::zeros();
        for (i, &node) in rule.nodes.iter().enumerate() {
            to_node.set_row(i, &integral.value(node).transpose());
        }
        Self { rule, to_node, to_integral: *integral.coefficients() }
    }
}

impl<const S: usize, const M: usize> Collocation<S, M> {
    /// Rounds until the sweeps count as diverging.
    const SWEEPS: usize = 60;

    /// The solution of `y' = rhs(t, y)`, `y(start_s) = start`, on `[start_s, end_s]`, and its value at the end.
    ///
    /// `guess`, usually the segment before, is extrapolated as the first approximation; it changes the result by
    /// rounding only. Costs `S` evaluations a sweep, 3 to 8 sweeps.
    ///
    /// # Errors
    /// [`IntegrationError`]; the sweeps must converge to rounding (a few 1e-16 of each component's size or change).
    pub fn solve<const D: usize>(
        &self,
        start_s: f64,
        end_s: f64,
        start: &SVector<f64, D>,
        guess: Option<&Segment<D, M>>,
        mut rhs: impl FnMut(f64, &SVector<f64, D>) -> SVector<f64, D>,
    ) -> Result<(Segment<D, M>, SVector<f64, D>), IntegrationError> {
        let half_s = 0.5 * (end_s - start_s);
        let center_s = 0.5 * (start_s + end_s);
        let node_s: [f64; S] = self.rule.nodes.map(|x| center_s + half_s * x);
        let first = rhs(start_s, start);
        if !is_finite(&first) || !is_finite(start) {
            return Err(IntegrationError::NotFinite { at_s: start_s });
        }
        let mut rates = [first; S];
        if let Some(guess) = guess {
            for (rate, &at_s) in rates.iter_mut().zip(&node_s) {
                let guessed = guess.value_and_derivative(at_s).1;
                if is_finite(&guessed) {
                    *rate = guessed;
                }
            }
        }
        let mut last = Change { own: f64::INFINITY, whole: f64::INFINITY };
        let mut idle_sweeps = 0;
        for sweep in 0..Self::SWEEPS {
            let change = match self.sweep(half_s, start, &node_s, &mut rates, &mut rhs) {
                Ok(change) => change,
                // Sweeps that had been growing ran into infinity.
                Err(_) if sweep > 0 && last.whole > 0.1 => break,
                Err(error) => return Err(error),
            };
            idle_sweeps = if change.own > 0.5 * last.own { idle_sweeps + 1 } else { 0 };
            last = change;
            // Rounding: nothing moves, or what moves no longer shrinks and is nothing to the whole.
            if change.own < 4.0 * f64::EPSILON || (idle_sweeps >= 2 && change.whole < 1e-13) {
                return Ok(self.dense(start_s, end_s, start, &rates));
            }
        }
        Err(IntegrationError::NotConverged { from_s: start_s, to_s: end_s, change: last.own })
    }

    /// One Gauss-Seidel sweep over the nodes.
    fn sweep<const D: usize>(
        &self,
        half_s: f64,
        start: &SVector<f64, D>,
        node_s: &[f64; S],
        rates: &mut [SVector<f64, D>; S],
        rhs: &mut impl FnMut(f64, &SVector<f64, D>) -> SVector<f64, D>,
    ) -> Result<Change, IntegrationError> {
        let mut moved = SVector::<f64, D>::zeros();
        let mut size = start.abs();
        for (i, &at_s) in node_s.iter().enumerate() {
            let mut y = *start;
            for (j, rate) in rates.iter().enumerate() {
                y += rate * (half_s * self.to_node[(i, j)]);
            }
            let rate = rhs(at_s, &y);
            if !is_finite(&rate) {
                return Err(IntegrationError::NotFinite { at_s });
            }
            moved = moved.sup(&((rate - rates[i]) * half_s).abs());
            size = size.sup(&(rate * half_s).abs());
            rates[i] = rate;
        }
        let ratios = moved.zip_map(&size, |m, s| if m > 0.0 { m / s } else { 0.0 });
        let whole = if moved.max() > 0.0 { moved.max() / size.max() } else { 0.0 };
        Ok(Change { own: ratios.max(), whole })
    }

    fn dense<const D: usize>(
        &self,
        start_s: f64,
        end_s: f64,
        start: &SVector<f64, D>,
        rates: &[SVector<f64, D>; S],
    ) -> (Segment<D, M>, SVector<f64, D>) {
        let half_s = 0.5 * (end_s - start_s);
        let mut coefficients = SMatrix::<f64, D, M>::zeros();
        let mut end = *start;
        for (i, rate) in rates.iter().enumerate() {
            end += rate * (half_s * self.rule.weights[i]);
            for (k, mut column) in coefficients.column_iter_mut().enumerate() {
                column += rate * (half_s * self.to_integral[(i, k)]);
            }
        }
        let mut mean = coefficients.column_mut(0);
        mean += start;
        (Segment::from_coefficients(start_s, end_s, coefficients), end)
    }
}

/// How far a sweep moved the stages: the worst component relative to its own size, and to the largest component.
#[derive(Clone, Copy)]
struct Change {
    own: f64,
    whole: f64,
}

fn is_finite<const D: usize>(vector: &SVector<f64, D>) -> bool {
    vector.iter().all(|x| x.is_finite())
}

/// State of an integration: a chain of segments with edges at `k * length_s`, which keeps the last one with its dense output and is
/// all that a restored copy needs.
///
/// The first segment starts wherever the integration starts, and a [`SegmentChain::cut`] ends a segment early; after both, edges
/// are whole multiples again. Segments depend on nothing but their start: asking more or less often changes no bit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SegmentChain<const D: usize, const M: usize> {
    /// Length of the segments, s.
    pub(crate) length_s: f64,
    /// Number of the edge the last segment ends at.
    edge: i64,
    /// Start of the present segment, s.
    pub(crate) start_s: f64,
    /// How far the integration has come, s.
    pub(crate) end_s: f64,
    /// Solution there.
    end: SVector<f64, D>,
    /// Dense output between start and end of the present segment.
    pub(crate) segment: Segment<D, M>,
}

impl<const D: usize, const M: usize> SegmentChain<D, M> {
    /// An integration that stands at `start` at `start_s`, with segments of `length_s` (above 0, like all times finite).
    pub fn new(length_s: f64, start_s: f64, start: SVector<f64, D>) -> Self {
        let mut coefficients = SMatrix::<f64, D, M>::zeros();
        if M > 0 {
            coefficients.set_column(0, &start);
        }
        Self {
            length_s,
            edge: (start_s / length_s).floor() as i64,
            start_s,
            end_s: start_s,
            end: start,
            segment: Segment::from_coefficients(start_s, start_s + length_s, coefficients),
        }
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.length_s > 0.0 && self.segment.is_valid() && self.segment.spans(self.start_s, self.end_s)
    }

    /// The solution at a time of the present segment.
    pub fn value(&self, at_s: f64) -> SVector<f64, D> {
        if at_s >= self.end_s { self.end } else { self.segment.value(at_s) }
    }

    /// Integrates one more segment, to the next edge or to `limit_s` if that comes first; later segments end at the edges
    /// again.
    ///
    /// # Errors
    /// See [`Collocation::solve`]; the segments stay as they were.
    pub fn advance_to<const S: usize>(
        &mut self,
        method: &Collocation<S, M>,
        limit_s: f64,
        rhs: impl FnMut(f64, &SVector<f64, D>) -> SVector<f64, D>,
    ) -> Result<(), IntegrationError> {
        // Counted from where the segments end, not from the number kept: restored bytes may hold any number.
        let mut edge = edge_after(self.end_s, self.length_s);
        let mut end_s = edge as f64 * self.length_s;
        if limit_s < end_s {
            (edge, end_s) = (edge.saturating_sub(1), limit_s);
        }
        // A short segment says nothing of a long one.
        let known = self.end_s - self.start_s >= 0.1 * (end_s - self.end_s);
        let guess = (self.end_s > self.start_s && known).then_some(&self.segment);
        let (segment, end) = method.solve(self.end_s, end_s, &self.end, guess, rhs)?;
        *self = Self { length_s: self.length_s, edge, start_s: self.end_s, end_s, end, segment };
        Ok(())
    }

    /// Ends the present segment at `at_s`, within it: what was computed beyond is void because the right-hand side
    /// changes there, or the state jumps to `value`.
    pub fn cut(&mut self, at_s: f64, value: SVector<f64, D>) {
        *self = Self::new(self.length_s, at_s, value);
    }
}

/// The number of the first edge `k * length_s` after `at_s`; within rounding of one, of the one behind it.
fn edge_after(at_s: f64, length_s: f64) -> i64 {
    let edge = ((at_s / length_s).floor() as i64).saturating_add(1);
    let is_there = edge as f64 * length_s - at_s <= 1e-12 * at_s.abs().max(length_s);
    if is_there { edge.saturating_add(1) } else { edge }
}

/// First whole multiple of a segment's length after a time; see [`SegmentChain::advance_to`].
pub fn edge_after_s(at_s: f64, length_s: f64) -> f64 {
    edge_after(at_s, length_s) as f64 * length_s
}

#[cfg(test)]
mod tests;
