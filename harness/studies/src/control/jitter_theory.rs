//! Jitter of a flexible body by a rotor out of balance, in closed form.
//!
//! Equations: at the angular frequency W of the rotor, T = r x F, F = U W^2 (e1 - i e2), and the body's angle follows from
//! -W^2 (J + sum of d d^T W^2 / (w^2 - W^2 + 2 i z w W)) a = T, with J less the rotors about their axes and without the
//! stored momentum's gyroscopic torque.

use loader::Fmu;
use nalgebra::{Complex, Matrix3, SVector, Vector3};

use crate::StudyError;
use crate::case::{at_start, numbered, recorded};

recorded! {
    /// One flexible mode.
    pub(super) struct Mode {
        /// With the body held, in Hz.
        pub frequency_hz: f64 = "frequency",
        damping: f64 = "damping",
        coupling: Vector3<f64> = "coupling",
    }
}

recorded! {
    /// A wheel's rotor.
    struct Rotor {
        inertia_kg_m2: f64 = "inertia",
        axis: Vector3<f64> = "axis",
    }
}

recorded! {
    /// The body with everything, and the wheel that shakes it.
    struct Body {
        inertia_kg_m2: SVector<f64, 9> = "spacecraft.inertia",
        center_m: Vector3<f64> = "spacecraft.centerOfMass",
        imbalance_kg_m: f64 = "wheel[1].staticImbalance",
        wheel_m: Vector3<f64> = "wheel[1].position",
    }
}

/// Body, modes and wheels, from the parameters of an FMU.
#[derive(Clone, Debug)]
pub(super) struct Structure {
    carrier: Matrix3<f64>,
    /// In the order of the FMU.
    pub modes: Vec<Mode>,
    axis: Vector3<f64>,
    lever_m: Vector3<f64>,
    imbalance_kg_m: f64,
    /// Of the first wheel, in kg m2.
    pub rotor_kg_m2: f64,
}

impl Structure {
    /// Reads it; the first wheel is the one that shakes.
    pub(super) fn read(fmu: &Fmu) -> Result<Self, StudyError> {
        let body: Body = at_start(fmu, Body::NAMES)?.first();
        let modes = at_start(fmu, &numbered(fmu, "flexibleMode", Mode::NAMES))?.first();
        let mut rotors: Vec<Rotor> = at_start(fmu, &numbered(fmu, "wheel", Rotor::NAMES))?.first();
        let mut carrier = Matrix3::from_row_slice(body.inertia_kg_m2.as_slice());
        for Rotor { inertia_kg_m2, axis } in &mut rotors {
            axis.normalize_mut();
            carrier -= *axis * axis.transpose() * *inertia_kg_m2;
        }
        let (rotor_kg_m2, axis) =
            rotors.first().map_or((f64::NAN, Vector3::z()), |rotor| (rotor.inertia_kg_m2, rotor.axis));
        let (lever_m, imbalance_kg_m) = (body.wheel_m - body.center_m, body.imbalance_kg_m);
        Ok(Self { carrier, modes, axis, lever_m, imbalance_kg_m, rotor_kg_m2 })
    }

    /// Amplitude of the body's angle, all axes together, where the rotor turns so often a second, in rad.
    pub(super) fn jitter_rad(&self, frequency_hz: f64) -> f64 {
        let turning = std::f64::consts::TAU * frequency_hz;
        let complex = |v: &Vector3<f64>| v.map(Complex::from);
        let mut inertia = self.carrier.map(Complex::from);
        for mode in &self.modes {
            let (own, coupling) = (std::f64::consts::TAU * mode.frequency_hz, complex(&mode.coupling));
            let stiffness = Complex::new(own * own - turning * turning, 2.0 * mode.damping * own * turning);
            inertia += coupling * coupling.transpose() * (Complex::from(turning * turning) / stiffness);
        }
        let first = self.axis.cross(&Vector3::new(0.267_3, 0.534_5, 0.801_8)).normalize();
        let second = self.axis.cross(&first);
        let torque =
            complex(&self.lever_m.cross(&first)) - complex(&self.lever_m.cross(&second)) * Complex::i();
        // The square of the speed is in force and acceleration alike.
        let angle =
            inertia.try_inverse().map(|inverse| inverse * torque * Complex::from(self.imbalance_kg_m));
        angle.map_or(f64::NAN, |angle| angle.norm())
    }

    /// The frequency near that of a mode at which the body shakes most, in Hz: the mode's with the body free.
    pub(super) fn resonance_hz(&self, mode: &Mode) -> f64 {
        let free =
            self.carrier.try_inverse().map_or(0.0, |inverse| mode.coupling.dot(&(inverse * mode.coupling)));
        mode.frequency_hz / (1.0 - free).sqrt()
    }
}
