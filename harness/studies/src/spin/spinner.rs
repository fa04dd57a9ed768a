//! The paper's spinner as a case: constants, inertia, pulse widths.

use crate::case::Case;

/// The paper's thruster force, in N (after eq 2).
pub(super) const FORCE_N: f64 = 4.448;
/// Arm of a lower-deck radial thruster, in m (Table 1).
pub(super) const RADIAL_ARM_M: f64 = 0.40;
/// Arm of an upper-deck axial thruster, in m (Table 1).
pub(super) const AXIAL_ARM_M: f64 = 0.78;
/// The paper's average spin inertia, in kg m2 (after eq 3).
pub(super) const SPIN_INERTIA_KG_M2: f64 = 353.82;
/// Nominal spin rate, in rad/s (after eq 2).
pub(super) const RATE_RAD_S: f64 = core::f64::consts::PI / 6.0;
/// Nominal spin period, in s.
pub(super) const PERIOD_S: f64 = 12.0;
/// The ratio of the paper's figures.
pub(super) const RATIO: f64 = 1.483;

/// The paper's body, undamped, for `stop_s`.
pub(super) fn paper_case(label: impl Into<String>, stop_s: f64, step_s: f64) -> Case {
    Case::new(label, stop_s, step_s).ratio(RATIO).set("damper.timeConstant", 0.0)
}

impl Case {
    /// An axisymmetric body of this ratio.
    pub(crate) fn ratio(self, ratio: f64) -> Self {
        self.triaxial(ratio, 1.0)
    }

    /// A body of I3/sqrt(I1 I2) = `ratio` and I1/I2 = `quotient`.
    pub(crate) fn triaxial(self, ratio: f64, quotient: f64) -> Self {
        let transverse = SPIN_INERTIA_KG_M2 / ratio;
        let inertia = [transverse * quotient.sqrt(), transverse / quotient.sqrt(), SPIN_INERTIA_KG_M2];
        self.set("inertia", inertia)
    }
}

/// Eq 8 with `kick` for Gamma/n.
pub(super) fn eq8(kick: f64, phase_rad: f64, count: f64) -> f64 {
    kick * ((1.0 - (count * phase_rad).cos()) / (1.0 - phase_rad.cos())).sqrt()
}

/// Pulse width whose manoeuvre by eq 3 is `angle_rad`, in s; `None` beyond half a turn.
pub(super) fn width_s(angle_rad: f64, arm_m: f64) -> Option<f64> {
    let sine = angle_rad * SPIN_INERTIA_KG_M2 * RATE_RAD_S * RATE_RAD_S / (2.0 * FORCE_N * arm_m);
    (sine <= 1.0).then(|| 2.0 * sine.asin() / RATE_RAD_S)
}
