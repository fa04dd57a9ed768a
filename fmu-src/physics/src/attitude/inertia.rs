//! Principal moments of inertia of a rigid body.

use serde::{Deserialize, Serialize};

/// Moments that differ by less than this (relative) count as equal: the body is axisymmetric.
const AXISYMMETRY: f64 = 1e-13;

/// Principal moments of inertia about the centre of mass; the third axis is the spin axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Inertia {
    principal_kg_m2: [f64; 3],
}

/// Why three numbers are no moments of inertia.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InertiaError {
    /// A moment is not a positive finite number.
    #[error("inertia[{index}] is {value} kg m2; a moment of inertia is a positive finite number")]
    NotPositive {
        /// 1-based.
        index: usize,
        /// What was given.
        value: f64,
    },
    /// No distribution of mass has these moments.
    #[error(
        "inertia[{index}] is {value} kg m2, more than the sum {sum} kg m2 of the other two: no distribution of mass \
         has that (triangle inequality)"
    )]
    Triangle {
        /// 1-based.
        index: usize,
        /// What was given.
        value: f64,
        /// Sum of the other two.
        sum: f64,
    },
}

impl Inertia {
    /// Checks the moments: positive, finite, none greater than the sum of the other two.
    pub fn new(principal_kg_m2: [f64; 3]) -> Result<Self, InertiaError> {
        for (i, &value) in principal_kg_m2.iter().enumerate() {
            if !(value.is_finite() && value > 0.0) {
                return Err(InertiaError::NotPositive { index: i + 1, value });
            }
        }
        for (i, &value) in principal_kg_m2.iter().enumerate() {
            let sum = principal_kg_m2.iter().sum::<f64>() - value;
            if value > sum {
                return Err(InertiaError::Triangle { index: i + 1, value, sum });
            }
        }
        Ok(Self { principal_kg_m2 })
    }

    /// An axisymmetric body of spin inertia I3 and ratio I3/I_T.
    pub fn axisymmetric(spin_kg_m2: f64, ratio: f64) -> Result<Self, InertiaError> {
        let transverse = spin_kg_m2 / ratio;
        Self::new([transverse, transverse, spin_kg_m2])
    }

    /// I1, I2, I3.
    pub fn principal_kg_m2(&self) -> [f64; 3] {
        self.principal_kg_m2
    }

    /// I3.
    pub fn spin_kg_m2(&self) -> f64 {
        self.principal_kg_m2[2]
    }

    /// I_T = sqrt(I1 I2), paper 002 after eq 11.
    pub fn transverse_kg_m2(&self) -> f64 {
        (self.principal_kg_m2[0] * self.principal_kg_m2[1]).sqrt()
    }

    /// I3/I_T.
    pub fn ratio(&self) -> f64 {
        self.spin_kg_m2() / self.transverse_kg_m2()
    }

    /// Whether I1 = I2.
    pub fn is_axisymmetric(&self) -> bool {
        let [i1, i2, _] = self.principal_kg_m2;
        (i1 - i2).abs() <= AXISYMMETRY * i1.max(i2)
    }

    /// Whether the spin axis is the axis of greatest inertia, about which a body that dissipates energy is stable.
    pub fn spins_about_major_axis(&self) -> bool {
        let [i1, i2, i3] = self.principal_kg_m2;
        i3 > i1 && i3 > i2
    }

    /// lambda / Omega for small nutation: the rate at which the transverse rate turns in the body, per spin rate.
    ///
    /// r - 1 for an axisymmetric body, +-sqrt((I3/I1 - 1)(I3/I2 - 1)) in general (negative about the minor axis);
    /// `None` about the intermediate axis, where nutation does not oscillate. `sqrt(I1 I2)` in place of I_T is not
    /// the right mean for a triaxial body.
    pub fn body_nutation_ratio(&self) -> Option<f64> {
        let [i1, i2, i3] = self.principal_kg_m2;
        if self.is_axisymmetric() {
            return Some(i3 / i1 - 1.0);
        }
        let (a, b) = (i3 / i1 - 1.0, i3 / i2 - 1.0);
        (a * b > 0.0).then(|| (a * b).sqrt().copysign(a))
    }

    /// Inertial nutation rate over spin rate: I3/I_T for an axisymmetric body, 1 + sqrt(...) in general (eq 11).
    pub fn inertial_nutation_ratio(&self) -> Option<f64> {
        self.body_nutation_ratio().map(|ratio| 1.0 + ratio)
    }
}
