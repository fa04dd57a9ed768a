//! Limits of a slew's rate and acceleration, and the least time that they allow: accelerate, coast, decelerate.

use crate::case::recorded;

recorded! {
    /// Limits, both above 0.
    pub(super) struct SlewLimits {
        /// In rad/s.
        pub rate_rad_s: f64 = "control.slewRate",
        /// In rad/s2.
        pub acceleration_rad_s2: f64 = "control.slewAcceleration",
    }
}

impl SlewLimits {
    /// The least time of a slew by an angle, in s.
    pub(super) fn least_s(&self, angle_rad: f64) -> f64 {
        let (rate, acceleration) = (self.rate_rad_s, self.acceleration_rad_s2);
        if angle_rad < rate * rate / acceleration {
            2.0 * (angle_rad / acceleration).sqrt()
        } else {
            angle_rad / rate + rate / acceleration
        }
    }

    /// The angle of a slew that takes `time_s` at least, in rad.
    pub(super) fn angle_rad(&self, time_s: f64) -> f64 {
        let (rate, acceleration) = (self.rate_rad_s, self.acceleration_rad_s2);
        let ramp_s = rate / acceleration;
        if time_s < 2.0 * ramp_s { acceleration * time_s * time_s / 4.0 } else { rate * (time_s - ramp_s) }
    }
}

#[cfg(test)]
mod tests {
    //! A slew summed up in small steps that brakes as late as it can.
    use super::*;

    #[test]
    fn the_least_time_is_that_of_full_acceleration_and_braking() {
        let limits = SlewLimits { rate_rad_s: 0.3, acceleration_rad_s2: 0.1 };
        for angle_rad in [0.2, 0.9, 2.5] {
            let (mut angle, mut rate, mut steps) = (0.0, 0.0f64, 0);
            let step_s = 1e-4;
            while angle < angle_rad && (rate > 0.0 || steps == 0) {
                let stops_in = rate * rate / 0.2;
                let requested = if angle + stops_in < angle_rad { 0.3 } else { 0.0 };
                let next = rate + (requested - rate).clamp(-0.1 * step_s, 0.1 * step_s);
                angle += 0.5 * (rate + next) * step_s;
                rate = next;
                steps += 1;
            }
            let summed_s = f64::from(steps) * step_s;
            assert!((limits.least_s(angle_rad) - summed_s).abs() < 0.05, "{angle_rad}: {summed_s}");
            assert!((limits.angle_rad(limits.least_s(angle_rad)) - angle_rad).abs() < 1e-14);
        }
    }
}
