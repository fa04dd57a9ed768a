//! Interpolation between two rows: cubics by rates, turns of attitudes, angles by the nearest turn.
//!
//! Equation: Hermite's cubic, of error h^4 |x''''| / 384 over rows h apart; a turn of constant rate about one axis (Shoemake 1985),
//! whose error falls with h^2; where the body rate w stands beside a quaternion (scalar last), Hermite's cubic of its elements with
//! dq/dt = Xi(q) w / 2, normalised. Reference: Markley and Crassidis (2014), equations 3.20 and 3.21.

/// A unit quaternion, scalar last.
pub(super) type Quaternion = [f64; 4];

/// Two rows, and where between them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// From row to row, in s.
    pub span_s: f64,
    /// Share of it that has passed.
    pub share: f64,
}

impl Gap {
    /// The value on a straight line.
    pub(super) fn linear(self, [left, right]: [f64; 2]) -> f64 {
        left + (right - left) * self.share
    }

    /// The value, and its rate, of the cubic with these values and rates at both rows.
    pub(super) fn cubic(self, [left, right]: [f64; 2], [left_rate, right_rate]: [f64; 2]) -> (f64, f64) {
        let (share, slope) = (self.share, (right - left) / self.span_s);
        let (at_left, at_right) = (left_rate - slope, right_rate - slope);
        // Beside the straight line, whose bits stay where the rates are its slope.
        let beside = at_left * (1.0 - share) - at_right * share;
        let value = self.linear([left, right]) + self.span_s * share * (1.0 - share) * beside;
        let bend = share * (1.0 - share) * (at_left + at_right);
        (value, slope + (1.0 - 2.0 * share) * beside - bend)
    }

    /// The attitude on the turn of constant rate between two of one sign.
    pub(super) fn turned(self, [left, right]: [Quaternion; 2]) -> Quaternion {
        let half_rad = half_turn_rad(left, right);
        // So little that the sines cancel out.
        if half_rad < 1e-8 {
            return std::array::from_fn(|i| self.linear([left[i], right[i]]));
        }
        let weights = [1.0 - self.share, self.share].map(|share| (share * half_rad).sin() / half_rad.sin());
        std::array::from_fn(|i| weights[0] * left[i] + weights[1] * right[i])
    }

    /// The attitude and the body rate in rad/s on the way between two of one sign with these body rates.
    pub(super) fn turned_by_rates(
        self,
        [left, right]: [Quaternion; 2],
        [left_rad_s, right_rad_s]: [[f64; 3]; 2],
    ) -> (Quaternion, [f64; 3]) {
        let rates = [derivative(left, left_rad_s), derivative(right, right_rad_s)];
        let cubics: [(f64, f64); 4] =
            std::array::from_fn(|i| self.cubic([left[i], right[i]], rates.map(|it| it[i])));
        let norm = cubics.iter().map(|(value, _)| value * value).sum::<f64>().sqrt();
        let q = cubics.map(|(value, _)| value / norm);
        // A rate along q changes its length alone and is orthogonal to Xi(q).
        (q, body_rate(q, cubics.map(|(_, rate)| rate / norm)))
    }
}

/// Half the turn between two attitudes of one sign, in rad.
pub(super) fn half_turn_rad(left: Quaternion, right: Quaternion) -> f64 {
    let chord: f64 = left.iter().zip(right).map(|(left, right)| (right - left).powi(2)).sum();
    2.0 * (chord.sqrt() / 2.0).min(1.0).asin()
}

/// dq/dt of an attitude that turns with a body rate in rad/s.
fn derivative([x, y, z, w]: Quaternion, [a, b, c]: [f64; 3]) -> Quaternion {
    [w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a, -(x * a + y * b + z * c)]
        .map(|twice| 0.5 * twice)
}

/// The body rate in rad/s of an attitude with this dq/dt.
fn body_rate([x, y, z, w]: Quaternion, [dx, dy, dz, dw]: Quaternion) -> [f64; 3] {
    [
        w * dx - x * dw - (y * dz - z * dy),
        w * dy - y * dw - (z * dx - x * dz),
        w * dz - z * dw - (x * dy - y * dx),
    ]
    .map(|half| 2.0 * half)
}

/// An angle that comes back after a turn, and where its variable may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Circle {
    /// A turn in the variable's unit.
    pub turn: f64,
    /// Its least value.
    pub min: f64,
    /// Its greatest value.
    pub max: f64,
}

impl Circle {
    /// The same angle as `to`, reached from `from` by the nearest turn. A whole turn from or to 0 is meant as one.
    fn nearest(self, from: f64, to: f64) -> f64 {
        let turns = (to - from) / self.turn;
        let is_whole = (turns.abs() - 1.0).abs() < 1e-9 && from * to == 0.0;
        if is_whole || turns.abs() <= 0.5 { to } else { to - turns.round() * self.turn }
    }

    /// Whether values that reach so far count whole turns themselves.
    pub(super) fn is_counted(self, values: &[f64]) -> bool {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        greatest - least > self.turn * (1.0 + 1e-9)
    }

    /// Rows that follow one another by the nearest turn, as far as the variable's range allows.
    pub(super) fn unwrapped(self, values: &[f64]) -> Vec<f64> {
        let mut before = None;
        let follow = |value: &f64| {
            let near = before.map_or(*value, |before| self.nearest(before, *value));
            let found = if (self.min..=self.max).contains(&near) { near } else { *value };
            *before.insert(found)
        };
        values.iter().map(follow).collect()
    }

    /// The angle on the nearest way between two rows, within the variable's range.
    pub(super) fn between(self, gap: Gap, [left, right]: [f64; 2]) -> f64 {
        let angle = gap.linear([left, self.nearest(left, right)]);
        let turns = if angle > self.max {
            -1.0
        } else if angle < self.min {
            1.0
        } else {
            0.0
        };
        angle + turns * self.turn
    }

    /// The way from one angle to another by the nearest turn.
    pub(super) fn way(self, from: f64, to: f64) -> f64 {
        self.nearest(from, to) - from
    }
}
