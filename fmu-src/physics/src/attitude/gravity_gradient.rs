//! Torque of a planet's gravity gradient.

use nalgebra::{Matrix3, Vector3};

use crate::numerics::scalar::Scalar;

/// Torque 3 mu / r^5 r x J r of a point mass of gravitational parameter `gm_m3_s2` at `to_planet_body_m`, in N m.
pub fn gravity_gradient_n_m<T: Scalar>(
    gm_m3_s2: T,
    inertia_body_kg_m2: &Matrix3<T>,
    to_planet_body_m: &Vector3<T>,
) -> Vector3<T> {
    let distance_m = to_planet_body_m.norm();
    let toward = to_planet_body_m / distance_m;
    let scale = gm_m3_s2 * 3.0 / (distance_m * distance_m * distance_m);
    toward.cross(&(inertia_body_kg_m2 * toward)) * scale
}

#[cfg(test)]
mod tests {
    //! A dumb-bell is pulled into line with the planet by the difference of the two pulls on its ends.

    use super::*;
    use crate::numerics::scalar::Dual64;

    const GM: f64 = 2.2e13;

    fn pulls(half_m: &Vector3<f64>, mass_kg: f64, planet_m: &Vector3<f64>) -> Vector3<f64> {
        [half_m, &-half_m]
            .iter()
            .map(|end| {
                let away = planet_m - *end;
                end.cross(&(away * (GM * mass_kg / away.norm().powi(3))))
            })
            .sum()
    }

    #[test]
    fn the_torque_on_a_dumb_bell_is_that_of_its_ends() {
        let (half_m, mass_kg) = (Vector3::new(30.0, -10.0, 20.0), 50.0);
        let planet_m = Vector3::new(1.0e6, 2.0e6, -1.5e6);
        let inertia =
            (Matrix3::identity() * half_m.norm_squared() - half_m * half_m.transpose()) * (2.0 * mass_kg);
        let found = gravity_gradient_n_m(GM, &inertia, &planet_m);
        let expected = pulls(&half_m, mass_kg, &planet_m);
        // The next term of the expansion is smaller by (size / distance)^2.
        assert!((found - expected).norm() < 1e-8 * found.norm(), "{found} {expected}");
    }

    #[test]
    fn the_derivative_is_the_slope() {
        let inertia = Matrix3::new(200.0, 5.0, -3.0, 5.0, 450.0, 8.0, -3.0, 8.0, 430.0);
        let at = |x: f64| gravity_gradient_n_m(GM, &inertia, &Vector3::new(1e6 + x, 2e6, -1.5e6));
        let seeded = Vector3::new(Dual64::new(1e6, 1.0), Dual64::new(2e6, 0.0), Dual64::new(-1.5e6, 0.0));
        let exact = gravity_gradient_n_m(Dual64::constant(GM), &inertia.map(Dual64::constant), &seeded)
            .map(|t| t.eps);
        let slope = (at(10.0) - at(-10.0)) / 20.0;
        assert!((slope - exact).norm() < 1e-8 * exact.norm());
    }
}
