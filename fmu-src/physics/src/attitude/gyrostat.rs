//! Gyrostat: a body with reaction wheels and what swings on it, and what follows from its momentum.
//!
//! Equations: H = J w + sum of h a, in body components, J with the rotors in it; with p = h + I a.w for every rotor that
//! turns, H - sum of p a - sum of held h a = (J - sum of I a a^T) w. Modal coordinates enter alike ([`super::oscillator`]).

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::imbalance::RotorImbalance;
use super::oscillator::{FlexibleMode, Oscillator};
use super::slosh::SloshPendulum;
use super::wheel::{ReactionWheel, Rotor};

/// Moving parts of the body other than its wheels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Appendages {
    /// Flexible modes.
    pub modes: Vec<FlexibleMode>,
    /// Propellant.
    pub sloshes: Vec<SloshPendulum>,
    /// Rotors out of balance.
    pub imbalances: Vec<RotorImbalance>,
}

/// A body with reaction wheels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gyrostat {
    inertia_body_kg_m2: Matrix3<f64>,
    /// Without the rotors about their axes that can turn, and its inverse in 1/(kg m2).
    carrier_body_kg_m2: Matrix3<f64>,
    inverse_carrier: Option<Matrix3<f64>>,
    wheels: Vec<ReactionWheel>,
    appendages: Appendages,
    /// Centre of mass, from which the positions of propellant and unbalanced rotors count, in m.
    center_of_mass_body_m: Vector3<f64>,
}

/// Why there is no such body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GyrostatError {
    /// A rotor without inertia.
    #[error("wheel[{wheel}].inertia is {found} kg m2, allowed: above 0")]
    Rotor {
        /// 1-based.
        wheel: usize,
        /// In kg m2.
        found: f64,
    },
    /// An axis of no direction.
    #[error("wheel[{wheel}].axis is {found:?}, allowed: any vector but zero")]
    Axis {
        /// 1-based.
        wheel: usize,
        /// Axis found.
        found: [f64; 3],
    },
    /// The body less its rotors.
    #[error(
        "the inertia less that of the rotors about their axes has the principal moment {found} kg m2, allowed: above 0; \
         spacecraft.inertia includes the rotors"
    )]
    Body {
        /// The smallest, in kg m2.
        found: f64,
    },
    /// The body less what swings on it.
    #[error(
        "the inertia less that of the rotors and of what swings has the principal moment {found} kg m2, allowed: above 0; \
         spacecraft.inertia includes all of it: see flexibleMode[k].coupling, slosh[k].mass and slosh[k].pivot"
    )]
    Swinging {
        /// The smallest, in kg m2.
        found: f64,
    },
    /// More propellant than body.
    #[error(
        "slosh[k].mass is {found} kg together, allowed: less than spacecraft.mass = {whole_kg} kg, of which it is a part"
    )]
    Propellant {
        /// All of it, in kg.
        found: f64,
        /// The whole, in kg.
        whole_kg: f64,
    },
}

impl Gyrostat {
    /// `inertia_body_kg_m2` is about the centre of mass and includes the rotors; axes may have any length.
    ///
    /// # Errors
    /// A rotor without inertia or axis, or rotors with more inertia than the whole.
    pub fn new(
        inertia_body_kg_m2: Matrix3<f64>,
        mut wheels: Vec<ReactionWheel>,
    ) -> Result<Self, GyrostatError> {
        for (index, wheel) in wheels.iter_mut().enumerate() {
            let (number, found) = (index + 1, wheel.inertia_kg_m2);
            if !(found.is_finite() && found > 0.0) {
                return Err(GyrostatError::Rotor { wheel: number, found });
            }
            let found = wheel.axis_body.into();
            let axis = wheel.axis_body.try_normalize(0.0).filter(|axis| axis.iter().all(|x| x.is_finite()));
            wheel.axis_body = axis.ok_or(GyrostatError::Axis { wheel: number, found })?;
        }
        let mut body = Self { inertia_body_kg_m2, wheels, ..Self::default() };
        body.set_carrier();
        let found = SymmetricEigen::new(body.carrier_body_kg_m2).eigenvalues.min();
        if found > 0.0 { Ok(body) } else { Err(GyrostatError::Body { found }) }
    }

    /// With what swings on it and rotors out of balance, in a body of this mass about this centre.
    ///
    /// # Errors
    /// More propellant than mass, or so much that swings that no inertia is left.
    pub fn with_appendages(
        mut self,
        appendages: Appendages,
        mass_kg: f64,
        center_of_mass_body_m: Vector3<f64>,
    ) -> Result<Self, GyrostatError> {
        let found = appendages.sloshes.iter().map(|slosh| slosh.mass_kg).sum();
        if found >= mass_kg {
            return Err(GyrostatError::Propellant { found, whole_kg: mass_kg });
        }
        self.appendages = appendages;
        self.center_of_mass_body_m = center_of_mass_body_m;
        let still = [Vector3::zeros(); 2];
        let swinging = self.oscillators(mass_kg, &still);
        let rest = swinging.fold(self.carrier_body_kg_m2, |rest, it| rest - it.inertia_body_kg_m2());
        let found = SymmetricEigen::new(rest).eigenvalues.min();
        if found > 0.0 { Ok(self) } else { Err(GyrostatError::Swinging { found }) }
    }

    /// Moving parts of the body other than its wheels.
    pub fn appendages(&self) -> &Appendages {
        &self.appendages
    }

    /// Centre of mass, body frame, in m.
    pub fn center_of_mass_body_m(&self) -> &Vector3<f64> {
        &self.center_of_mass_body_m
    }

    /// Whether nothing swings on it and every rotor is balanced.
    pub fn is_rigid(&self) -> bool {
        let Appendages { modes, sloshes, imbalances } = &self.appendages;
        modes.is_empty() && sloshes.is_empty() && imbalances.is_empty()
    }

    /// How many modal coordinates there are: one of each flexible mode, then two of each pendulum.
    pub fn oscillator_count(&self) -> usize {
        self.appendages.modes.len() + 2 * self.appendages.sloshes.len()
    }

    /// Modal coordinates in a body of this mass under this acceleration and its slope, in m/s2 and m/s3.
    pub(super) fn oscillators(
        &self,
        mass_kg: f64,
        acceleration_body_m_s2: &[Vector3<f64>; 2],
    ) -> impl Iterator<Item = Oscillator> {
        let Appendages { modes, sloshes, .. } = &self.appendages;
        let sloshes = sloshes.iter().flat_map(move |slosh| {
            slosh.oscillators(mass_kg, &self.center_of_mass_body_m, acceleration_body_m_s2)
        });
        modes.iter().map(FlexibleMode::oscillator).chain(sloshes)
    }

    /// Inertia about the centre of mass with the rotors in it, body frame, in kg m2.
    pub fn inertia_body_kg_m2(&self) -> &Matrix3<f64> {
        &self.inertia_body_kg_m2
    }

    /// Takes another inertia, the rotors in it as before, and another centre of mass.
    pub fn set_mass_properties(
        &mut self,
        inertia_body_kg_m2: Matrix3<f64>,
        center_of_mass_body_m: Vector3<f64>,
    ) {
        self.center_of_mass_body_m = center_of_mass_body_m;
        if inertia_body_kg_m2 != self.inertia_body_kg_m2 {
            self.inertia_body_kg_m2 = inertia_body_kg_m2;
            self.set_carrier();
        }
    }

    fn set_carrier(&mut self) {
        self.carrier_body_kg_m2 = self.without(self.wheels.iter().filter(|wheel| !wheel.locked));
        self.inverse_carrier = self.carrier_body_kg_m2.try_inverse();
    }

    /// The same without the rotors about their axes that can turn: what the motors' torque accelerates.
    pub fn carrier_body_kg_m2(&self) -> &Matrix3<f64> {
        &self.carrier_body_kg_m2
    }

    /// The wheels, axes of length 1.
    pub fn wheels(&self) -> &[ReactionWheel] {
        &self.wheels
    }

    /// Sum over the wheels of a scalar along each axis, body frame.
    pub fn along_axes(&self, of_wheel: impl Fn(usize) -> f64) -> Vector3<f64> {
        let wheels = self.wheels.iter().enumerate();
        wheels.fold(Vector3::zeros(), |sum, (k, wheel)| sum + wheel.axis_body * of_wheel(k))
    }

    /// Total momentum at a body rate, the rotors holding these momenta relative to the body, body frame, in N m s.
    pub fn momentum_body_n_m_s(
        &self,
        rate_body_rad_s: &Vector3<f64>,
        rotors_n_m_s: impl Fn(usize) -> f64,
    ) -> Vector3<f64> {
        self.inertia_body_kg_m2 * rate_body_rad_s + self.along_axes(rotors_n_m_s)
    }

    /// Inverse of the carrier's inertia, in 1/(kg m2).
    pub fn inverse_carrier(&self) -> Option<&Matrix3<f64>> {
        self.inverse_carrier.as_ref()
    }

    /// First and second term of the rate's series, body frame, in rad/s2 and rad/s3: w' = J^-1 (m' - u), m' = m x w + T, with the
    /// body rate w in rad/s, the total momentum m in N m s, J the carrier's inertia, the torque T from outside with its slope and
    /// the torque u of the motors on the rotors.
    pub fn rate_terms(
        &self,
        rate: &Vector3<f64>,
        momentum: &Vector3<f64>,
        [torque, torque_slope]: [Vector3<f64>; 2],
        motors: &Vector3<f64>,
    ) -> [Vector3<f64>; 2] {
        let Some(inverse) = self.inverse_carrier else { return [Vector3::zeros(); 2] };
        let momentum_rate = momentum.cross(rate) + torque;
        let slope = inverse * (momentum_rate - motors);
        [slope, inverse * (momentum_rate.cross(rate) + momentum.cross(&slope) + torque_slope) * 0.5]
    }

    /// Inverse of the inertia that body and held rotors have alone, without what swings, in 1/(kg m2).
    pub(super) fn inverse_inertia<'a>(
        &self,
        rotors: impl Iterator<Item = &'a Rotor> + Clone,
        swinging: impl Iterator<Item = Matrix3<f64>>,
    ) -> Matrix3<f64> {
        let turns = |rotor: &Rotor| matches!(rotor, Rotor::Turning { .. });
        let mut all = self.wheels.iter().zip(rotors.clone());
        if self.oscillator_count() == 0 && all.all(|(wheel, rotor)| turns(rotor) != wheel.locked) {
            return self.inverse_carrier.unwrap_or_else(Matrix3::zeros);
        }
        let turning = self.wheels.iter().zip(rotors).filter(|(_, rotor)| turns(rotor));
        let rest = self.without(turning.map(|(wheel, _)| wheel));
        swinging.fold(rest, |rest, it| rest - it).try_inverse().unwrap_or_else(Matrix3::zeros)
    }

    fn without<'a>(&self, wheels: impl Iterator<Item = &'a ReactionWheel>) -> Matrix3<f64> {
        wheels.fold(self.inertia_body_kg_m2, |rest, wheel| {
            rest - wheel.axis_body * wheel.axis_body.transpose() * wheel.inertia_kg_m2
        })
    }
}
