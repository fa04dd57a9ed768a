//! Roots: one in a bracket, and all sign changes of a polynomial.
//!
//! Equation: f(x) = 0, for a function that changes its sign in a bracket ([`bracketed`]) or for a polynomial by its
//! Bernstein coefficients on [0, 1] ([`bernstein_sign_changes`]).
//! Method: Chandrupatla's for the bracket (inverse quadratic interpolation where it is safe, bisection elsewhere). For the
//! polynomial, subdivision by de Casteljau: the number of sign changes of Bernstein coefficients is an upper bound on the
//! number of roots with the same parity, so a piece with none is dropped, a piece with one is bracketed, others are halved.
//! Order: superlinear near a simple root; one bit a step at worst.
//! Error measure: the bracket's width, down to neighbouring doubles, or where rounding of the function takes over. Two
//! roots of a polynomial closer than 1e-12 of its interval count by the signs around them.
//! Reference: Chandrupatla, Advances in Engineering Software 28, 1997; Lane and Riesenfeld, BIT 21, 1981 (Descartes' rule
//! in Bernstein form).

/// The root of a continuous `function` between `from` and `to`, by Chandrupatla's method (inverse quadratic
/// interpolation where it is safe, bisection elsewhere).
///
/// The result is within 4 ulp of a sign change: the bracket shrinks to neighbouring numbers or an exact zero. At most 200
/// evaluations, usually 6 to 10. `None` when both ends have the same sign, and on
/// NaN or infinity.
pub fn bracketed(from: f64, to: f64, mut function: impl FnMut(f64) -> f64) -> Option<f64> {
    let mut evaluate = |at: f64| Some(function(at)).filter(|value| value.is_finite() && at.is_finite());
    let (mut a, mut b) = (to, from);
    let (mut f_a, mut f_b) = (evaluate(a)?, evaluate(b)?);
    if f_a == 0.0 {
        return Some(a);
    }
    if f_b == 0.0 {
        return Some(b);
    }
    if (f_a > 0.0) == (f_b > 0.0) {
        return None;
    }
    let mut fraction = 0.5;
    for _ in 0..200 {
        let x = a + fraction * (b - a);
        let f_x = evaluate(x)?;
        let (c, f_c) = if (f_x > 0.0) == (f_a > 0.0) {
            (a, f_a)
        } else {
            let dropped = (b, f_b);
            (b, f_b) = (a, f_a);
            dropped
        };
        (a, f_a) = (x, f_x);
        let best = if f_a.abs() < f_b.abs() { a } else { b };
        let resolution = 2.0 * f64::EPSILON * best.abs() + f64::MIN_POSITIVE;
        let relative = resolution / (b - a).abs();
        if relative > 0.5 || f_a == 0.0 || f_b == 0.0 {
            return Some(best);
        }
        let xi = (a - b) / (c - b);
        let phi = (f_a - f_b) / (f_c - f_b);
        let safe = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
        fraction = if safe {
            f_a / (f_b - f_a) * f_c / (f_b - f_c) + (c - a) / (b - a) * f_a / (f_c - f_a) * f_b / (f_c - f_b)
        } else {
            0.5
        };
        fraction = fraction.clamp(relative, 1.0 - relative);
    }
    Some(0.5 * (a + b))
}

/// Up to `N` roots in rising order, without allocation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roots<const N: usize> {
    at: [f64; N],
    count: usize,
}

impl<const N: usize> Default for Roots<N> {
    fn default() -> Self {
        Self { at: [0.0; N], count: 0 }
    }
}

impl<const N: usize> Roots<N> {
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// All of them, rising.
    pub fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        self.at.iter().take(self.count).copied()
    }

    pub(super) fn map(&mut self, change: impl Fn(f64) -> f64) {
        for at in self.at.iter_mut().take(self.count) {
            *at = change(*at);
        }
    }

    pub(super) fn push(&mut self, at: f64) {
        if let Some(slot) = self.at.get_mut(self.count) {
            *slot = at;
            self.count += 1;
        }
    }
}

/// All changes of sign in `(from, to]` of a polynomial given by Bernstein coefficients on `[0, 1]`; a zero exactly
/// at `to` counts, one exactly at `from` does not.
///
/// A piece whose coefficients have no change of sign has no root, one change means exactly one root (bracketed and
/// solved), more split the piece by de Casteljau (Descartes' rule in Bernstein form, Lane and Riesenfeld 1981).
pub fn bernstein_sign_changes<const N: usize>(coefficients: &[f64; N], from: f64, to: f64) -> Roots<N> {
    /// Pieces narrower than this count by the signs at their ends.
    const NARROW: f64 = 1e-12;
    /// log2(1 / NARROW) halvings, each leaving one right half behind.
    const STACK: usize = 44;
    let mut found = Roots::default();
    if N == 0 || !coefficients.iter().all(|c| c.is_finite()) || from.is_nan() || to.is_nan() || to <= from {
        return found;
    }
    let mut stack = [([0.0; N], 0.0, 0.0); STACK];
    stack[0] = (restrict(coefficients, from, to), from, to);
    let mut height = 1;
    let mut sign_before = 0.0;
    let mut ends_on_zero = false;
    while height > 0 {
        height -= 1;
        let (piece, start, end) = stack[height];
        let signs = Signs::from_coefficients(&piece);
        if signs.changes > 1 && end - start > NARROW && height + 2 <= STACK {
            let middle = 0.5 * (start + end);
            let (left, right) = split(&piece, 0.5);
            stack[height] = (right, middle, end);
            stack[height + 1] = (left, start, middle);
            height += 2;
            continue;
        }
        if signs.first * sign_before < 0.0 {
            found.push(start);
        }
        if signs.first * signs.last < 0.0 {
            // A zero at an end of the piece is not the root sought: start just inside.
            let lower = if piece[0] == 0.0 { NARROW } else { 0.0 };
            let upper = if piece[N - 1] == 0.0 { 1.0 - NARROW } else { 1.0 };
            let root = bracketed(lower, upper, |u| split(&piece, u).0[N - 1]).unwrap_or(lower);
            found.push(start + root * (end - start));
        }
        if signs.last != 0.0 {
            sign_before = signs.last;
            ends_on_zero = piece[N - 1] == 0.0;
        }
    }
    if ends_on_zero {
        found.push(to);
    }
    found
}

/// Signs of the first and last coefficient that is not zero (0 if there is none), and the changes between them.
struct Signs {
    first: f64,
    last: f64,
    changes: usize,
}

impl Signs {
    fn from_coefficients(coefficients: &[f64]) -> Self {
        let mut signs = Self { first: 0.0, last: 0.0, changes: 0 };
        for sign in coefficients.iter().filter(|c| **c != 0.0).map(|c| c.signum()) {
            if signs.first == 0.0 {
                signs.first = sign;
            } else if sign != signs.last {
                signs.changes += 1;
            }
            signs.last = sign;
        }
        signs
    }
}

/// The same polynomial on `[0, u]` and on `[u, 1]`.
fn split<const N: usize>(coefficients: &[f64; N], u: f64) -> ([f64; N], [f64; N]) {
    let (mut left, mut right) = ([0.0; N], [0.0; N]);
    let mut work = *coefficients;
    for level in 0..N {
        left[level] = work[0];
        right[N - 1 - level] = work[N - 1 - level];
        for i in 0..N - 1 - level {
            work[i] = (1.0 - u) * work[i] + u * work[i + 1];
        }
    }
    (left, right)
}

fn restrict<const N: usize>(coefficients: &[f64; N], from: f64, to: f64) -> [f64; N] {
    let (left, _) = if to < 1.0 { split(coefficients, to) } else { (*coefficients, [0.0; N]) };
    if from > 0.0 && to > 0.0 { split(&left, from / to).1 } else { left }
}

#[cfg(test)]
mod tests;
