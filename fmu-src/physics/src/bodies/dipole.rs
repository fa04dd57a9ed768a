//! Magnetic field of a body as a dipole, tilted and off its centre.
//!
//! Equation: m = a^3 (g11, h11, g10) of the Gauss coefficients; the position from those of the second degree.
//! Reference: Fraser-Smith, Centered and eccentric geomagnetic dipoles and their poles, Reviews of Geophysics 25, 1987.

use serde::{Deserialize, Serialize};

/// A dipole along the body's axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DipoleField {
    /// Field on its equator times the cube of the distance there, toward the north pole of the field, in T m3.
    pub moment_fixed_t_m3: [f64; 3],
    /// Position of the dipole from the body's centre, body-fixed axes, in m.
    pub place_fixed_m: [f64; 3],
}

/// Square root of 3.
const ROOT_3: f64 = 1.732_050_807_568_877_2;

impl DipoleField {
    /// Returns the dipole of the Gauss coefficients g10, g11, h11 and g20, g21, h21, g22, h22 in T at this radius in m.
    pub const fn eccentric(radius_m: f64, first: [f64; 3], second: [f64; 5]) -> Self {
        let ([g10, g11, h11], [g20, g21, h21, g22, h22]) = (first, second);
        let l0 = 2.0 * g10 * g20 + ROOT_3 * (g11 * g21 + h11 * h21);
        let l1 = -g11 * g20 + ROOT_3 * (g10 * g21 + g11 * g22 + h11 * h22);
        let l2 = -h11 * g20 + ROOT_3 * (g10 * h21 - h11 * g22 + g11 * h22);
        let square = g10 * g10 + g11 * g11 + h11 * h11;
        let e = (l0 * g10 + l1 * g11 + l2 * h11) / (4.0 * square);
        let scale_m = radius_m / (3.0 * square);
        let cube = radius_m * radius_m * radius_m;
        Self {
            moment_fixed_t_m3: [cube * g11, cube * h11, cube * g10],
            place_fixed_m: [scale_m * (l1 - g11 * e), scale_m * (l2 - h11 * e), scale_m * (l0 - g10 * e)],
        }
    }
}

const fn nano<const N: usize>(values: [f64; N]) -> [f64; N] {
    let (mut scaled, mut at) = (values, 0);
    while at < N {
        scaled[at] = values[at] * 1e-9;
        at += 1;
    }
    scaled
}

/// The Earth's at 2025 (IGRF-14).
pub const EARTH: DipoleField = DipoleField::eccentric(
    6_371.2e3,
    nano([-29_350.0, -1_410.3, 4_545.5]),
    nano([-2_556.2, 2_950.9, -3_133.6, 1_648.7, -814.2]),
);

/// Mercury's: 190 nT at a radius of 2440 km, along its axis, 479 km north of the centre (Anderson et al. 2012, The low-degree
/// structure of Mercury's planetary magnetic field, J. Geophys. Res. 117, E00L12).
pub const MERCURY: DipoleField = DipoleField {
    moment_fixed_t_m3: [0.0, 0.0, -190e-9 * 2_440e3 * 2_440e3 * 2_440e3],
    place_fixed_m: [0.0, 0.0, 479e3],
};

/// Jupiter's (JRM09; Connerney et al. 2018, A new model of Jupiter's magnetic field, Geophys. Res. Lett. 45).
pub const JUPITER: DipoleField = DipoleField::eccentric(
    71_492e3,
    nano([410_244.7, -71_498.3, 21_330.5]),
    nano([11_670.4, -56_835.8, -42_027.3, 48_689.5, 19_353.2]),
);

#[cfg(test)]
mod tests {
    //! The Earth's eccentric dipole lies where it is published to lie.
    use super::*;

    #[test]
    fn the_dipole_of_the_earth_is_six_hundred_km_off() {
        // Some 594 km toward the western Pacific at 2025; Fraser-Smith has 488 km at 1985, growing by 2.5 km a year.
        let [x, y, z] = EARTH.place_fixed_m;
        let off_m = (x * x + y * y + z * z).sqrt();
        assert!((570e3..620e3).contains(&off_m), "{off_m}");
        let longitude_deg = y.atan2(x).to_degrees();
        assert!((130.0..145.0).contains(&longitude_deg), "{longitude_deg}");
        let pole_deg =
            (EARTH.moment_fixed_t_m3[2] / 6_371.2e3_f64.powi(3) / 29_735e-9).abs().acos().to_degrees();
        assert!((8.5..10.5).contains(&pole_deg), "the field's pole is 9.2 deg from the axis: {pole_deg}");
        assert!(JUPITER.place_fixed_m.iter().map(|it| it * it).sum::<f64>().sqrt() < 0.15 * 71_492e3);
    }
}
