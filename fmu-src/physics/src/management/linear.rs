//! The Sun's place for a torque by the linear formula (paper 000, eqs 14 to 17; eq 17's azimuth denominator is k_z_x - k_z_xy).
//!
//! With the Sun near -Y of the shade, s = [A, -1, -E], the torque along X and Z per unit of pressure is
//! T_x = (k_x_yz - k_x_z) E + (k_x_yy - k_x_y), T_z = (k_z_x - k_z_xy) A + (k_z_yy - k_z_y).

use nalgebra::{Matrix3, Vector3};

use crate::attitude::{SunAngles, direction_from_angles};
use crate::radiation::TorquePolynomial;

/// The linear formula of a shade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearTorque {
    dcm_body_from_shade: Matrix3<f64>,
    /// Slope by elevation and constant of the torque along X of the shade, in m3.
    along_x_m3: [f64; 2],
    /// Slope by azimuth and constant of the torque along Z of the shade, in m3.
    along_z_m3: [f64; 2],
}

impl LinearTorque {
    /// Linear formula of the shade's polynomial about the centre of mass, in its own frame.
    pub fn new(polynomial: &TorquePolynomial, dcm_body_from_shade: Matrix3<f64>) -> Self {
        let k = |axis, term| polynomial.coefficient(axis, term).unwrap_or(0.0);
        Self {
            dcm_body_from_shade,
            along_x_m3: [k(0, "yz") - k(0, "z"), k(0, "yy") - k(0, "y")],
            along_z_m3: [k(2, "x") - k(2, "xy"), k(2, "yy") - k(2, "y")],
        }
    }

    /// Direction of the Sun for this torque, body frame, in N m; X and Z of the shade count where they are requested
    /// for; `None` where the shade gives no torque that way.
    pub fn sun_angles(
        &self,
        torque_body_n_m: &Vector3<f64>,
        pressure_pa: f64,
        requested: [bool; 2],
    ) -> Option<SunAngles> {
        let torque_m3 = self.dcm_body_from_shade.tr_mul(torque_body_n_m) / pressure_pa;
        let solve = |requested: bool, required_m3: f64, [slope_m3, constant_m3]: [f64; 2]| {
            let angle_rad = (required_m3 - constant_m3) / slope_m3;
            if requested { Some(angle_rad).filter(|it| it.is_finite()) } else { Some(0.0) }
        };
        let in_shade = SunAngles {
            azimuth_rad: solve(requested[1], torque_m3.z, self.along_z_m3)?,
            elevation_rad: solve(requested[0], torque_m3.x, self.along_x_m3)?,
        };
        Some(SunAngles::from_direction(&(self.dcm_body_from_shade * direction_from_angles(in_shade))))
    }
}

#[cfg(test)]
mod tests {
    //! The formula's torque is the polynomial's to second order in the angles, whichever way the shade is turned.
    use super::*;
    use crate::radiation::Beam;
    use crate::spacecraft::{MESSENGER_TOML, Spacecraft};
    use nalgebra::Rotation3;

    #[test]
    fn the_torque_comes_out_to_second_order() {
        let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
        let mut shade = spacecraft.sunshade.unwrap();
        let center_of_mass_m = Vector3::new(0.01, 0.0, 0.03);
        for turn_rad in [0.0, 0.1] {
            let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), turn_rad);
            shade.dcm_body_from_shade = *turn.matrix();
            let polynomial =
                TorquePolynomial::of_sunshade(&shade, shade.model, &[], &(turn * center_of_mass_m)).unwrap();
            let linear = LinearTorque::new(&polynomial, shade.dcm_body_from_shade);
            let error = |size: f64| {
                // A torque that asks for angles of this size about the one that asks for none.
                let none = Vector3::new(linear.along_x_m3[1], 0.0, linear.along_z_m3[1]);
                let requested =
                    none + Vector3::new(linear.along_x_m3[0] * size, 0.0, -linear.along_z_m3[0] * size);
                let requested_body = shade.dcm_body_from_shade * requested * 5e-5;
                let angles = linear.sun_angles(&requested_body, 5e-5, [true; 2]).unwrap();
                let source_body = shade.dcm_body_from_shade.tr_mul(&direction_from_angles(angles));
                let torque = polynomial.torque_n_m(&Beam { source_body, pressure_pa: 1.0 });
                (torque - requested).xz().norm()
            };
            let (coarse, fine) = (error(0.1), error(0.05));
            assert!(coarse > 1e-4 && coarse > 3.5 * fine, "{coarse} {fine}");
        }
    }
}
