//! Solar torque on the sunshade as a polynomial in the Sun's direction (paper 000, eqs 3-8, re-derived).
//!
//! While every part of the shade is lit the torque is a quadratic form without constant term, whatever the shape. All
//! shapes share one derivation from N = int r x dF: with r from the centre of mass, n the normal, c = n.s and
//! M = r x n,
//!
//! N = -P int { (alpha + gD) c (r x s) + [ (2/3) gD c + 2 gS c^2 ] M } dA,
//!
//! so the moments int n r, int n M and int n n M of the lit surface give all 27 coefficients.

use nalgebra::{Matrix3, Vector3};

use super::cylinder::lit_angle_rad;
use super::faces::no_such_sunshade;
use super::flat_plate::Beam;
use crate::math;
use crate::numerics::scalar::Scalar;
use crate::refusal::Refusal;
use crate::spacecraft::{Cylinder, Material, Optics, Plate, Sunshade, SunshadeModel};

/// The monomials of the Sun's direction in the order of the coefficients (paper 000, eq 3).
pub const TERMS: [&str; 9] = ["x", "y", "z", "xy", "xz", "yz", "xx", "yy", "zz"];

/// For each monomial of second degree the two components it multiplies.
const QUADRATIC: [(usize, usize); 6] = [(0, 1), (0, 2), (1, 2), (0, 0), (1, 1), (2, 2)];

/// Torque on a wholly lit surface per unit of pressure, about the centre of mass, in the frame of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorquePolynomial {
    /// `k[j][t]`, in m3: torque about axis j per pascal and per monomial t of [`TERMS`].
    pub k: [[f64; 9]; 3],
}

impl TorquePolynomial {
    /// Returns the polynomial of the sunshade in one of its forms, in the shade frame; `materials` are the spacecraft's, and a surface
    /// that names none keeps its own. The torque in the body frame is `dcm_body_from_shade` times it (eq 12).
    ///
    /// # Errors
    ///
    /// The file does not describe the shade in this form.
    pub fn of_sunshade(
        shade: &Sunshade,
        model: SunshadeModel,
        materials: &[Material],
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Result<Self, Refusal> {
        let center_of_mass_m = shade.dcm_body_from_shade.transpose() * center_of_mass_body_m;
        match (model, &shade.cylinder) {
            (SunshadeModel::Cylinder, Some(cylinder)) => {
                Ok(Self::of_cylinder(cylinder, materials, &center_of_mass_m))
            }
            (SunshadeModel::Plates, _) if !shade.plates.is_empty() => {
                // The plates' front faces (eqs 6-8).
                let mut sum = Self { k: [[0.0; 9]; 3] };
                for plate in &shade.plates {
                    let optics = optics(plate.faces.materials[0], materials).unwrap_or(&plate.faces.optics);
                    sum.add(&Moments::of_plate(plate, &center_of_mass_m), optics);
                }
                Ok(sum)
            }
            _ => Err(no_such_sunshade(model)),
        }
    }

    /// Returns the polynomial of a cylindrical section (eqs 4-5), in its own frame.
    pub fn of_cylinder(cylinder: &Cylinder, materials: &[Material], center_of_mass_m: &Vector3<f64>) -> Self {
        let mut sum = Self { k: [[0.0; 9]; 3] };
        let optics = optics(cylinder.material, materials).unwrap_or(&cylinder.optics);
        sum.add(&Moments::of_cylinder(cylinder, center_of_mass_m), optics);
        sum
    }

    /// A coefficient by axis (0 to 2) and monomial, as `k_x_yz` is `coefficient(0, "yz")`.
    pub fn coefficient(&self, axis: usize, term: &str) -> Option<f64> {
        let column = TERMS.iter().position(|known| *known == term)?;
        self.k.get(axis)?.get(column).copied()
    }

    /// Torque in N m for a beam in the polynomial's own frame; right only where [`polynomial_valid`] says so.
    pub fn torque_n_m<T: Scalar>(&self, beam: &Beam<T>) -> Vector3<T> {
        let [x, y, z] = [beam.source_body.x, beam.source_body.y, beam.source_body.z];
        let monomials = [x, y, z, x * y, x * z, y * z, x * x, y * y, z * z];
        let component = |row: &[f64; 9]| {
            row.iter().zip(monomials).fold(T::constant(0.0), |sum, (k, term)| sum + term * *k)
                * beam.pressure_pa
        };
        let [kx, ky, kz] = &self.k;
        Vector3::new(component(kx), component(ky), component(kz))
    }

    fn add(&mut self, moments: &Moments, optics: &Optics) {
        let along_light = optics.absorptivity + optics.diffuse;
        for (j, row) in self.k.iter_mut().enumerate() {
            // c (r x s)_j = sum_ab s_a (n_a r x e_b)_j s_b
            let arm = Matrix3::from_fn(|a, b| {
                let r: Vector3<f64> = moments.normal_position.row(a).transpose();
                r.cross(&Vector3::ith(b, 1.0))[j]
            });
            let quadratic = -(arm * along_light + moments.normal_normal_arm[j] * (2.0 * optics.specular));
            let (linear_row, quadratic_row) = row.split_at_mut(3);
            for (a, k) in linear_row.iter_mut().enumerate() {
                *k -= 2.0 / 3.0 * optics.diffuse * moments.normal_arm[(a, j)];
            }
            for (&(a, b), k) in QUADRATIC.iter().zip(quadratic_row) {
                *k += if a == b { quadratic[(a, a)] } else { quadratic[(a, b)] + quadratic[(b, a)] };
            }
        }
    }
}

/// Optics of a named material.
fn optics(place: Option<usize>, materials: &[Material]) -> Option<&Optics> {
    materials.get(place?).map(|material| &material.optics)
}

/// Whether the polynomial holds for a Sun in this direction (body frame): no part of the shade is dark.
pub fn polynomial_valid(shade: &Sunshade, model: SunshadeModel, sun_body: &Vector3<f64>) -> bool {
    let sun_shade = shade.dcm_body_from_shade.tr_mul(sun_body);
    match (model, &shade.cylinder) {
        (SunshadeModel::Plates, _) => shade.plates.iter().all(|plate| plate.normal.dot(&sun_shade) >= 0.0),
        (SunshadeModel::Cylinder, Some(cylinder)) => {
            lit_angle_rad(cylinder, &sun_shade) >= 2.0 * cylinder.half_angle_rad
        }
        (SunshadeModel::Cylinder, None) => false,
    }
}

/// Moments of a surface about the centre of mass, with r, n and M = r x n as above.
struct Moments {
    /// int n_a r_b dA at (a, b), in m3.
    normal_position: Matrix3<f64>,
    /// int n_a M_j dA at (a, j), in m3.
    normal_arm: Matrix3<f64>,
    /// int n_a n_b M_j dA at [j] (a, b), in m3.
    normal_normal_arm: [Matrix3<f64>; 3],
}

impl Moments {
    fn of_plate(plate: &Plate, center_of_mass_m: &Vector3<f64>) -> Self {
        let (n, r) = (plate.normal, plate.center_m - center_of_mass_m);
        let arm = r.cross(&n);
        Self {
            normal_position: n * r.transpose() * plate.area_m2,
            normal_arm: n * arm.transpose() * plate.area_m2,
            normal_normal_arm: [arm.x, arm.y, arm.z].map(|arm_j| n * n.transpose() * (arm_j * plate.area_m2)),
        }
    }

    /// r = R n + z Z - r_c, n = [sin, -cos, 0], angles within +-theta0: odd powers of z and of sin vanish.
    fn of_cylinder(cylinder: &Cylinder, center_of_mass_m: &Vector3<f64>) -> Self {
        let half = cylinder.half_angle_rad;
        let (sin, cos) = math::sin_cos(half);
        let strip_m2 = cylinder.radius_m * cylinder.height_m;
        // int n, int n n, and int n n n by its third index.
        let first = -Vector3::y() * (2.0 * sin * strip_m2);
        let sin_sin = (half - sin * cos) * strip_m2;
        let cos_cos = (half + sin * cos) * strip_m2;
        let second = Matrix3::from_diagonal(&Vector3::new(sin_sin, cos_cos, 0.0));
        let sin_sin_cos = 2.0 / 3.0 * math::powi(sin, 3) * strip_m2;
        let cos_cos_cos = 2.0 * (sin - math::powi(sin, 3) / 3.0) * strip_m2;
        let along_x =
            Matrix3::from_fn(|a, b| if (a, b) == (0, 1) || (a, b) == (1, 0) { -sin_sin_cos } else { 0.0 });
        let along_y = -Matrix3::from_diagonal(&Vector3::new(sin_sin_cos, cos_cos_cos, 0.0));
        // M = (R n + z Z - r_c) x n leaves n x r_c once z is integrated.
        let [cx, cy, cz] = [center_of_mass_m.x, center_of_mass_m.y, center_of_mass_m.z];
        Self {
            normal_position: second * cylinder.radius_m - first * center_of_mass_m.transpose(),
            normal_arm: -second * center_of_mass_m.cross_matrix().transpose(),
            normal_normal_arm: [along_y * cz, -along_x * cz, along_x * cy - along_y * cx],
        }
    }
}
