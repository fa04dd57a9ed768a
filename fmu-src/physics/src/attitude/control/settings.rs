//! Settings of the attitude controller, its gains, and whether the sampled loop is stable with them.
//!
//! The poles of the continuous loop are those of (s^2 + 2 d w s + w^2)(s + c w) with bandwidth w, damping d and
//! integral ratio c. Sampled with period dt and zero-order hold on the double integrator of the rigid body, with
//! P = kp dt^2, D = kd dt, Q = ki dt^3, the loop's characteristic polynomial is
//! (z-1)^3 + P/2 (z+1)(z-1) + D (z-1)^2 + Q/2 z (z+1), whose roots Jury's conditions hold inside the unit circle.

/// Settings of the controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControllerSettings {
    /// Samples a second.
    pub rate_hz: f64,
    /// Natural frequency of the closed loop, in rad/s.
    pub bandwidth_rad_s: f64,
    /// Damping ratio, dimensionless.
    pub damping: f64,
    /// Inverse time constant of the integral part as a fraction of the bandwidth, dimensionless; 0 for none.
    pub integral: f64,
    /// Greatest rate of the reference relative to the command, in rad/s; 0 for no limit.
    pub slew_rate_rad_s: f64,
    /// Greatest acceleration of the reference, in rad/s2; 0 for no limit.
    pub slew_acceleration_rad_s2: f64,
    /// Whether the reference continues however far the body is off: with actuators that are far stronger than slews require.
    pub keeps_reference: bool,
}

/// Feedback gains per unit of inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gains {
    /// On the angle, in 1/s2.
    pub proportional_1_s2: f64,
    /// On the rate, in 1/s.
    pub rate_1_s: f64,
    /// On the integral of the angle, in 1/s3.
    pub integral_1_s3: f64,
}

/// Why a controller cannot work.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GainError {
    /// A number is outside its range.
    #[error("the controller's {what} is {found} {unit}; allowed is {allowed}")]
    Range {
        /// Name of the setting.
        what: &'static str,
        /// Value found.
        found: f64,
        /// Its unit.
        unit: &'static str,
        /// Allowed range.
        allowed: &'static str,
    },
    /// The sampled loop is not stable.
    #[error(
        "the controller's bandwidth is {bandwidth_rad_s} rad/s: sampled at {rate_hz} Hz, with damping {damping} and \
         integral ratio {integral}, the loop is stable below {allowed_rad_s} rad/s; lower the bandwidth or sample faster"
    )]
    Unstable {
        /// Bandwidth found, in rad/s.
        bandwidth_rad_s: f64,
        /// Samples a second.
        rate_hz: f64,
        /// Damping ratio.
        damping: f64,
        /// Integral ratio.
        integral: f64,
        /// The bandwidth at which the loop stops being stable, in rad/s.
        allowed_rad_s: f64,
    },
}

impl ControllerSettings {
    /// Checks that every number is in its range and that the sampled closed loop is stable.
    pub fn check(&self) -> Result<(), GainError> {
        let (positive, not_negative) = ("a positive finite number", "0 or a positive finite number");
        for (what, found, unit, allowed) in [
            ("sample rate", self.rate_hz, "Hz", positive),
            ("bandwidth", self.bandwidth_rad_s, "rad/s", positive),
            ("damping ratio", self.damping, "", positive),
            ("integral ratio", self.integral, "", not_negative),
            ("slew rate", self.slew_rate_rad_s, "rad/s", not_negative),
            ("slew acceleration", self.slew_acceleration_rad_s2, "rad/s2", not_negative),
        ] {
            let is_zero_allowed = allowed == not_negative;
            if !found.is_finite() || found < 0.0 || (found == 0.0 && !is_zero_allowed) {
                return Err(GainError::Range { what, found, unit, allowed });
            }
        }
        if self.is_stable_at(self.bandwidth_rad_s) {
            return Ok(());
        }
        Err(GainError::Unstable {
            bandwidth_rad_s: self.bandwidth_rad_s,
            rate_hz: self.rate_hz,
            damping: self.damping,
            integral: self.integral,
            allowed_rad_s: self.greatest_bandwidth_rad_s(),
        })
    }

    /// Time between two samples, in s.
    pub fn interval_s(&self) -> f64 {
        self.rate_hz.recip()
    }

    pub(super) fn gains(&self) -> Gains {
        self.gains_at(self.bandwidth_rad_s)
    }

    fn gains_at(&self, bandwidth_rad_s: f64) -> Gains {
        let (w, d, c) = (bandwidth_rad_s, self.damping, self.integral);
        Gains {
            proportional_1_s2: (1.0 + 2.0 * d * c) * w * w,
            rate_1_s: (2.0 * d + c) * w,
            integral_1_s3: c * w * w * w,
        }
    }

    /// Jury's conditions on the characteristic polynomial, with equality only at the root z = 1 of no integral part.
    fn is_stable_at(&self, bandwidth_rad_s: f64) -> bool {
        let (gains, dt) = (self.gains_at(bandwidth_rad_s), self.interval_s());
        let p = gains.proportional_1_s2 * dt * dt;
        let d = gains.rate_1_s * dt;
        let q = gains.integral_1_s3 * dt * dt * dt;
        if self.integral == 0.0 {
            return d < 2.0 && p < 2.0 * d;
        }
        let [a0, a1, a2] = [-1.0 - p / 2.0 + d, 3.0 - 2.0 * d + q / 2.0, -3.0 + p / 2.0 + d + q / 2.0];
        d < 2.0 && a0.abs() < 1.0 && (a1 - a0 * a2).abs() < 1.0 - a0 * a0
    }

    /// The bandwidth up to which the loop is stable at this rate, damping and integral ratio, in rad/s; 0 where none is.
    fn greatest_bandwidth_rad_s(&self) -> f64 {
        // Stable for D < 2 at most; from low bandwidths up, because the poles are those of the continuous loop there.
        let end = 2.0 * self.rate_hz / (2.0 * self.damping + self.integral);
        let steps = 4096;
        let at = |step: i32| end * f64::from(step) / f64::from(steps);
        let first = (1..=steps).find(|&step| !self.is_stable_at(at(step))).unwrap_or(steps);
        let (mut stable, mut unstable) = (at(first - 1), at(first));
        for _ in 0..60 {
            let middle = 0.5 * (stable + unstable);
            if self.is_stable_at(middle) { stable = middle } else { unstable = middle }
        }
        stable
    }
}
