//! Mass, centre of mass and inertia, and which of them a body can have.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::part_reader::PartReader;
use crate::toml::{Point, Positive, Written, tables};

tables! {
/// Mass properties of the whole spacecraft.
struct MassDescription {
    /// Mass, in kg.
    mass_kg: Positive,
    /// Centre of mass from the body frame's origin, in m.
    center_of_mass_m: Point,
    /// Inertia about the centre of mass, body axes, row by row, in kg m2.
    inertia_kg_m2: [[f64; 3]; 3],
}
}

/// Mass properties of the whole spacecraft.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassProperties {
    /// Mass in kg.
    pub mass_kg: f64,
    /// Centre of mass from the body frame's origin, body axes, in m.
    pub center_of_mass_body_m: Vector3<f64>,
    /// Inertia about the centre of mass, body axes, in kg m2.
    pub inertia_body_kg_m2: Matrix3<f64>,
}

/// A panel's part of the spacecraft's mass, at angle 0.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PanelMass {
    /// Mass in kg.
    pub mass_kg: f64,
    /// Its centre, body frame, in m.
    pub center_body_m: Vector3<f64>,
    /// Inertia about its centre, body axes, in kg m2.
    pub inertia_body_kg_m2: Matrix3<f64>,
}

impl PanelMass {
    /// In a frame that this rotation takes its own to.
    #[must_use]
    pub fn turned(&self, rotation: &Matrix3<f64>) -> Self {
        Self {
            mass_kg: self.mass_kg,
            center_body_m: rotation * self.center_body_m,
            inertia_body_kg_m2: rotation * self.inertia_body_kg_m2 * rotation.transpose(),
        }
    }

    /// A thin square plate of this area.
    pub fn square_plate(
        mass_kg: f64,
        area_m2: f64,
        center_body_m: Vector3<f64>,
        normal_body: &Vector3<f64>,
    ) -> Self {
        // m a^2 / 12 about the axes in the plate, twice that about its normal.
        let across = mass_kg * area_m2 / 12.0;
        let inertia_body_kg_m2 = (Matrix3::identity() + normal_body * normal_body.transpose()) * across;
        Self { mass_kg, center_body_m, inertia_body_kg_m2 }
    }
}

/// Inertia of a unit mass at `place` about the origin, in m2.
pub(crate) fn steiner(place: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(place.norm_squared()) - place * place.transpose()
}

/// Relative slack of the checks below: a thin plate sits exactly on the triangle inequality's edge.
const SLACK: f64 = 1e-9;

/// Whether a body can have this inertia (kg m2): finite, symmetric, positive definite, and no principal moment
/// above the sum of the two others. The error says which condition fails.
pub fn check_inertia(inertia_kg_m2: &Matrix3<f64>) -> Result<(), &'static str> {
    if !inertia_kg_m2.iter().all(|moment| moment.abs() < 1e100) {
        return Err("finite numbers below 1e100 in magnitude");
    }
    let scale = inertia_kg_m2.amax();
    if (inertia_kg_m2 - inertia_kg_m2.transpose()).amax() > SLACK * scale {
        return Err("a symmetric matrix");
    }
    if inertia_kg_m2.cholesky().is_none() {
        return Err("a positive definite matrix (every principal moment above 0)");
    }
    // The second moments of the mass, int r r^T dm = (tr I / 2) 1 - I, are never negative along any direction: for
    // principal axes that is the triangle inequality.
    let slack = SLACK * scale;
    let second_moments = Matrix3::from_diagonal_element(inertia_kg_m2.trace() / 2.0 + slack) - inertia_kg_m2;
    if second_moments.cholesky().is_none() {
        return Err(
            "principal moments of which none exceeds the sum of the two others (triangle inequality)",
        );
    }
    Ok(())
}

/// Reads the mass properties.
pub(super) fn mass(part: &PartReader<'_>, description: &MassDescription) -> MassProperties {
    MassProperties {
        inertia_body_kg_m2: inertia_kg_m2(part, description.inertia_kg_m2),
        mass_kg: description.mass_kg.0,
        center_of_mass_body_m: description.center_of_mass_m.value(),
    }
}

/// Reads an inertia, row by row.
pub(super) fn inertia_kg_m2(part: &PartReader<'_>, rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    let inertia_kg_m2 = Matrix3::from(rows).transpose();
    if let Err(allowed) = check_inertia(&inertia_kg_m2) {
        part.key("inertia_kg_m2").report(format!("{rows:?}"), allowed);
    }
    inertia_kg_m2
}

#[cfg(test)]
mod tests {
    //! Inertias of real point masses pass, inertias no mass distribution has do not.

    use nalgebra::Rotation3;
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_thin_disc_is_a_body_and_a_thinner_one_is_not() {
        assert_eq!(check_inertia(&Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.0))), Ok(()));
        let error = check_inertia(&Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.0001))).unwrap_err();
        assert!(error.contains("triangle"));
    }

    #[test]
    fn the_verdict_does_not_depend_on_the_axes() {
        let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0).into_inner();
        let turned = |d: Vector3<f64>| turn * Matrix3::from_diagonal(&d) * turn.transpose();
        assert_eq!(check_inertia(&turned(Vector3::new(3.0, 4.0, 6.9))), Ok(()));
        assert!(check_inertia(&turned(Vector3::new(3.0, 4.0, 7.1))).unwrap_err().contains("triangle"));
        assert!(check_inertia(&turned(Vector3::new(3.0, 4.0, -1.0))).unwrap_err().contains("positive"));
    }

    #[test]
    fn torn_matrices_are_named() {
        let mut inertia = Matrix3::from_diagonal_element(1.0);
        inertia[(0, 1)] = 0.1;
        assert!(check_inertia(&inertia).unwrap_err().contains("symmetric"));
        inertia[(0, 1)] = f64::NAN;
        assert!(check_inertia(&inertia).unwrap_err().contains("finite"));
        inertia[(0, 1)] = f64::INFINITY;
        assert!(check_inertia(&inertia).unwrap_err().contains("finite"));
    }

    proptest! {
        #[test]
        fn any_cloud_of_points_is_a_body(points in prop::collection::vec(prop::array::uniform3(-5.0..5.0_f64), 4..12)) {
            let inertia = points.iter().fold(Matrix3::from_diagonal_element(1e-6), |sum, p| {
                let r = Vector3::from(*p);
                sum + Matrix3::from_diagonal_element(r.norm_squared()) - r * r.transpose()
            });
            prop_assert_eq!(check_inertia(&inertia), Ok(()));
        }
    }
}
