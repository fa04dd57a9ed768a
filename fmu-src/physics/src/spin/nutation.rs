//! Nutation that remains after trains of short pulses: the linear theory of paper 002, section II, corrected and as printed.
//!
//! In the body the transverse momentum turns at lambda = (r - 1) Omega, r = I3/I_T. A pulse of width l and transverse
//! torque T adds T * 2 sin(lambda l/2)/lambda to it (the *nutation kick*) and moves the momentum in inertial space by
//! T * 2 sin(Omega l/2)/Omega (the *manoeuvre*, eq 2). For short pulses the two are the same.

use core::f64::consts::PI;

use crate::math;

/// Spin and nutation of an axisymmetric spinner, as planners know them.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Spin {
    /// Omega_s, in rad/s.
    pub rate_rad_s: f64,
    /// r = I3/I_T (1 + lambda/Omega for a triaxial body).
    pub ratio: f64,
    /// I3, in kg m2.
    pub inertia_kg_m2: f64,
}

impl Spin {
    /// One turn, in s.
    pub fn period_s(&self) -> f64 {
        2.0 * PI / self.rate_rad_s
    }

    /// lambda, the rate of nutation in the body, in rad/s.
    pub fn body_nutation_rad_s(&self) -> f64 {
        (self.ratio - 1.0) * self.rate_rad_s
    }

    /// Gamma of one pulse: how far it moves the momentum, in rad (eq 3 with alpha = Omega l/2).
    pub fn manoeuvre_rad(&self, torque_n_m: f64, width_s: f64) -> f64 {
        let half_arc = 0.5 * self.rate_rad_s * width_s;
        2.0 * torque_n_m * math::sin(half_arc) / (self.inertia_kg_m2 * self.rate_rad_s * self.rate_rad_s)
    }

    /// Nutation angle one pulse raises from rest, in rad.
    pub fn nutation_kick_rad(&self, torque_n_m: f64, width_s: f64) -> f64 {
        torque_n_m * effective_width_s(self.body_nutation_rad_s(), width_s)
            / (self.inertia_kg_m2 * self.rate_rad_s)
    }

    /// Width whose nutation kick is `factor` times that of `width_s`; `None` where no single pulse has it.
    pub fn scaled_width_s(&self, width_s: f64, factor: f64) -> Option<f64> {
        let nutation = self.body_nutation_rad_s();
        if nutation == 0.0 {
            return Some(factor * width_s);
        }
        let sine = factor * math::sin(0.5 * nutation * width_s);
        (sine.abs() <= 1.0).then(|| 2.0 * math::asin(sine) / nutation)
    }

    /// phi: angle by which nutation advances from pulse to pulse (paper, before eq 4; "3 pi" belongs to 1 1/2 turns).
    pub fn phase_advance_rad(&self, turns_per_pulse: f64) -> f64 {
        2.0 * PI * turns_per_pulse * self.ratio
    }
}

/// 2 sin(lambda l/2)/lambda, the width of the impulse that leaves the same nutation.
fn effective_width_s(nutation_rad_s: f64, width_s: f64) -> f64 {
    let half = 0.5 * nutation_rad_s * width_s;
    if half.abs() < 1e-5 { width_s * (1.0 - half * half / 6.0) } else { width_s * math::sin(half) / half }
}

/// Integral of u sin(lambda u) over the middle of a pulse, by its effective width, in s.
fn first_moment_s(nutation_rad_s: f64, width_s: f64) -> f64 {
    let half = 0.5 * nutation_rad_s * width_s;
    let (sine, cosine) = math::sin_cos(half);
    // (sin h - h cos h) / sin h / lambda, h^2/3 (1 + h^2/15) / lambda where both cancel.
    if half.abs() < 1e-3 {
        return width_s * half / 6.0 * (1.0 + half * half / 15.0);
    }
    (sine - half * cosine) / (sine * nutation_rad_s)
}

/// Greatest nutation eq 8 reaches at any count: (Gamma/n) / |sin(phi/2)|; infinite where the kicks add up.
pub fn exact_envelope_rad(kick_rad: f64, phase_rad: f64) -> f64 {
    kick_rad / math::sin(0.5 * phase_rad).abs()
}

/// Eq 1: spread of the Sun-crossing period by nutation, in s. Diverges as the Sun angle goes to 0.
pub fn period_variation_s(nutation_rad: f64, spin_rate_rad_s: f64, sun_angle_rad: f64) -> f64 {
    2.0 * nutation_rad / (spin_rate_rad_s * math::tan(sun_angle_rad))
}

/// Eq 1 solved for the nutation angle that a period variation allows, in rad.
pub fn allowed_nutation_rad(period_variation_s: f64, spin_rate_rad_s: f64, sun_angle_rad: f64) -> f64 {
    0.5 * period_variation_s * spin_rate_rad_s * math::tan(sun_angle_rad)
}

/// Running nutation of the linear theory, pulse by pulse, for any train: transverse over axial momentum in the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct LinearNutation {
    across: [f64; 2],
    time_s: f64,
}

impl LinearNutation {
    /// Adds a pulse whose transverse torque is `torque_n_m[0]` at `from_s` and changes by `torque_n_m[1]` a second, until
    /// `to_s`.
    pub fn pulse(&mut self, spin: &Spin, torque_n_m: [[f64; 2]; 2], from_s: f64, to_s: f64) {
        let nutation = spin.body_nutation_rad_s();
        let (sine, cosine) = math::sin_cos(nutation * (to_s - self.time_s));
        let [x, y] = self.across;
        let (sine_half, cosine_half) = math::sin_cos(0.5 * nutation * (to_s - from_s));
        let scale = effective_width_s(nutation, to_s - from_s) / (spin.inertia_kg_m2 * spin.rate_rad_s);
        let [start, slope] = torque_n_m;
        let half_s = 0.5 * (to_s - from_s);
        let [mut tx, mut ty] = start;
        if slope != [0.0; 2] {
            // T(t) = Tm + s u about the middle: to Tm w comes -i s m, m the integral of u sin(lambda u).
            let moment = first_moment_s(nutation, to_s - from_s);
            (tx, ty) =
                (tx + slope[0] * half_s + slope[1] * moment, ty + slope[1] * half_s - slope[0] * moment);
        }
        self.across = [
            x * cosine - y * sine + scale * (tx * cosine_half - ty * sine_half),
            x * sine + y * cosine + scale * (tx * sine_half + ty * cosine_half),
        ];
        self.time_s = to_s;
    }

    /// Nutation angle, in rad: the theory's sum is the tangent.
    pub fn angle_rad(&self) -> f64 {
        math::atan(math::hypot(self.across[0], self.across[1]))
    }
}
