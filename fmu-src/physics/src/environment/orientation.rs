//! Rotation of a planet: uniform about a fixed pole, or the Earth's by the IAU's precession, nutation and rotation angle.
//!
//! Equation: fixed from inertial = Rz(W) E, frame rotations; uniform: E = Rx(90 deg - dec) Rz(90 deg + ra), W = W0 + rate t; the
//! Earth: E = N P with the precession angles of 2006 and the nutation of its greatest terms, W the apparent sidereal time by the
//! Earth rotation angle. Without polar motion and the bias of the frame, 0.02 arcsec.
//! Method: polynomials in time, ten terms of nutation.
//! Error measure: angle from the full theory, below 0.1 arcsec from 1950 to 2050.
//! Reference: IERS Conventions (2010), chapter 5; Capitaine, Wallace and Chapront 2003, Expressions for IAU 2000 precession
//! quantities; Mathews, Herring and Buffett 2002 (terms of IAU 2000B).

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, Vector3};
use serde::{Deserialize, Serialize};

use super::frames::{dcm_from_pole, rotation_x, rotation_y, rotation_z};
use super::utc;
use crate::bodies::BodyData;
use crate::constants::{ARCSECOND_RAD, DAY_S};
use crate::math;

/// Days of a Julian century.
const CENTURY_D: f64 = 36_525.0;
/// Rate of the Earth rotation angle, in revolutions per day of UT1.
const REVOLUTIONS_A_DAY: f64 = 1.002_737_811_911_354_5;
/// The angle at J2000 UT1, in revolutions.
const REVOLUTIONS_AT_J2000: f64 = 0.779_057_273_264;

/// Multiples of the arguments l, l', F, D and node; nutation in longitude by the sine and in obliquity by the cosine, in arcsec.
const NUTATION: [([f64; 5], f64, f64); 10] = [
    ([0.0, 0.0, 0.0, 0.0, 1.0], -17.206_416_1, 9.205_233_1),
    ([0.0, 0.0, 2.0, -2.0, 2.0], -1.317_090_6, 0.573_033_6),
    ([0.0, 0.0, 2.0, 0.0, 2.0], -0.227_641_3, 0.097_845_9),
    ([0.0, 0.0, 0.0, 0.0, 2.0], 0.207_455_4, -0.089_749_2),
    ([0.0, 1.0, 0.0, 0.0, 0.0], 0.147_587_7, 0.007_387_1),
    ([1.0, 0.0, 0.0, 0.0, 0.0], 0.071_115_9, -0.000_675_0),
    ([0.0, 1.0, 2.0, -2.0, 2.0], -0.051_682_1, 0.022_438_6),
    ([0.0, 0.0, 2.0, 0.0, 1.0], -0.038_729_8, 0.020_072_8),
    ([1.0, 0.0, 2.0, 0.0, 2.0], -0.030_146_1, 0.012_902_5),
    ([0.0, -1.0, 2.0, -2.0, 2.0], 0.021_582_9, -0.009_592_9),
];

/// Rotation model of a planet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Orientation {
    /// Constant rotation rate about a fixed pole: the equator at J2000 TDB.
    Uniform(Equator),
    /// The Earth by the IAU's models.
    Iau {
        /// UT1 less UTC, in s.
        ut1_minus_utc_s: f64,
    },
}

/// True equator of a planet at one time, and its rotation angle in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Equator {
    /// Components along the equator's axes of a vector in EME2000.
    pub equator_from_eme2000: Matrix3<f64>,
    /// Angle of the prime meridian about the pole, in rad.
    pub rotation_angle_rad: f64,
    /// Its rate, in rad/s.
    pub rate_rad_s: f64,
}

impl Equator {
    /// Components along the planet's axes of a vector in EME2000, `elapsed_s` later; the equator is kept.
    pub fn fixed_from_eme2000_after(&self, elapsed_s: f64) -> Rotation3<f64> {
        let rotation_angle_rad = self.rotation_angle_rad + self.rate_rad_s * elapsed_s;
        Rotation3::from_matrix_unchecked(rotation_z(-rotation_angle_rad) * self.equator_from_eme2000)
    }

    /// Angular velocity, EME2000, in rad/s.
    pub fn rotation_rad_s_eme2000(&self) -> Vector3<f64> {
        self.equator_from_eme2000.row(2).transpose() * self.rate_rad_s
    }
}

impl Orientation {
    /// Uniform rotation with a body's pole, prime meridian and rate.
    pub fn uniform(body: &BodyData) -> Self {
        let equatorial = dcm_from_pole(body.pole_right_ascension_rad, body.pole_declination_rad);
        Self::Uniform(Equator {
            equator_from_eme2000: equatorial.transpose(),
            rotation_angle_rad: body.prime_meridian_rad,
            rate_rad_s: body.rotation_rate_rad_s,
        })
    }

    /// Equator and rotation angle at an epoch in s past J2000 TDB.
    pub fn equator(&self, epoch_s: f64) -> Equator {
        match *self {
            Self::Uniform(at_j2000) => Equator {
                rotation_angle_rad: (at_j2000.rotation_angle_rad + at_j2000.rate_rad_s * epoch_s) % TAU,
                ..at_j2000
            },
            Self::Iau { ut1_minus_utc_s } => of_earth(epoch_s, ut1_minus_utc_s),
        }
    }

    /// Unit vector to the north pole, EME2000.
    pub fn pole_eme2000(&self, epoch_s: f64) -> Vector3<f64> {
        self.equator(epoch_s).equator_from_eme2000.row(2).transpose()
    }
}

/// A polynomial by its coefficients, the constant first.
fn polynomial<const N: usize>(coefficients: [f64; N], at: f64) -> f64 {
    coefficients.into_iter().rev().fold(0.0, |sum, term| sum * at + term)
}

fn of_earth(epoch_s: f64, ut1_minus_utc_s: f64) -> Equator {
    let centuries = epoch_s / (CENTURY_D * DAY_S);
    let arcseconds = |value: f64| value * ARCSECOND_RAD;
    let zeta =
        polynomial([2.650_545, 2_306.083_227, 0.298_849_9, 0.018_018_28, -5.971e-6, -3.173e-7], centuries);
    let z =
        polynomial([-2.650_545, 2_306.077_181, 1.092_734_8, 0.018_268_37, -2.859_6e-5, -2.904e-7], centuries);
    let theta =
        polynomial([0.0, 2_004.191_903, -0.429_493_4, -0.041_822_64, -7.089e-6, -1.274e-7], centuries);
    let precession =
        rotation_z(arcseconds(z)) * rotation_y(arcseconds(-theta)) * rotation_z(arcseconds(zeta));
    let obliquity = arcseconds(polynomial([84_381.406, -46.836_769, -1.831e-4, 2.003_4e-3], centuries));
    let (in_longitude, in_obliquity, node_rad) = nutation_rad(centuries);
    let nutation = rotation_x(obliquity + in_obliquity) * rotation_z(in_longitude) * rotation_x(-obliquity);
    let ut1_d = (utc::utc_s(epoch_s) + ut1_minus_utc_s) / DAY_S;
    // Whole revolutions of whole days drop out.
    let revolutions = ut1_d.fract() + REVOLUTIONS_AT_J2000 + (REVOLUTIONS_A_DAY - 1.0) * ut1_d;
    let accumulated = polynomial([0.014_506, 4_612.156_534, 1.391_581_7, -4.4e-7, -2.995_6e-5], centuries);
    let equinoxes = in_longitude * math::cos(obliquity) + arcseconds(0.002_64) * math::sin(node_rad);
    Equator {
        equator_from_eme2000: nutation * precession,
        rotation_angle_rad: revolutions.fract() * TAU + arcseconds(accumulated) + equinoxes,
        rate_rad_s: REVOLUTIONS_A_DAY * TAU / DAY_S,
    }
}

/// Nutation in longitude and obliquity, and the mean longitude of the Moon's node, in rad.
fn nutation_rad(centuries: f64) -> (f64, f64, f64) {
    let arguments = [
        [485_868.249_036, 1_717_915_923.217_8],
        [1_287_104.793_05, 129_596_581.048_1],
        [335_779.526_232, 1_739_527_262.847_8],
        [1_072_260.703_69, 1_602_961_601.209],
        [450_160.398_036, -6_962_890.543_1],
    ]
    .map(|[start, rate]| (start + rate * centuries) % 1_296_000.0 * ARCSECOND_RAD);
    let (mut longitude, mut obliquity) = (0.0, 0.0);
    for (multiples, sine, cosine) in NUTATION {
        let argument: f64 =
            multiples.iter().zip(arguments).map(|(multiple, argument)| multiple * argument).sum();
        let (sin, cos) = math::sin_cos(argument);
        longitude += sine * sin;
        obliquity += cosine * cos;
    }
    (longitude * ARCSECOND_RAD, obliquity * ARCSECOND_RAD, arguments[4])
}

#[cfg(test)]
mod tests {
    //! The Earth against the SOFA library's full theory; all planets against their own rates.
    use super::*;
    use crate::bodies::Body;

    /// Seconds past J2000 TDB and the rows of `erfa.c2t06a` (pyerfa 2.0.1.5: IAU 2006 and 2000A, no polar motion, UT1 = UTC).
    #[rustfmt::skip]
    const BY_ERFA: [(f64, [f64; 9]); 11] = [
        (473342467.1839, [-0.176011443814, 0.984388072826, 0.000306145287, -0.984387028020, -0.176011703301, 0.001435049210, 0.001466530480, -0.000048780366, 0.999998923454]), // 2015-01-01 0 h
        (511731068.1856, [0.351145056583, -0.936320883702, -0.000593279914, 0.936319753807, 0.351145554955, -0.001455288768, 0.001570944870, -0.000044482246, 0.999998765076]), // 2016-03-20 7.5 h
        (549940569.1848, [-0.046830266962, 0.998902853762, 0.000121828397, -0.998901459028, -0.046830405229, 0.001669819876, 0.001673693113, -0.000043496452, 0.999998598429]), // 2017-06-05 13.25 h
        (590058069.1824, [0.595895101997, -0.803061546595, -0.001086184849, 0.803060288830, 0.595896091401, -0.001421533315, 0.001788832048, -0.000025187178, 0.999998399721]), // 2018-09-12 21 h
        (631087269.1839, [0.985938375478, 0.167098705112, -0.001882155752, -0.167098376299, 0.985940171913, 0.000331731842, 0.001911124927, -0.000012561983, 0.999998173720]), // 2019-12-31 18 h
        (666543669.1851, [-0.987439877223, -0.157982575041, 0.001998713143, 0.157982266862, -0.987441900026, -0.000312138821, 0.002022925598, 0.000007542914, 0.999997953855]), // 2021-02-14 3 h
        (710204829.1841, [0.023443343095, 0.999725164469, -0.000072059178, -0.999722827254, 0.023443444111, 0.002161850214, 0.002162945377, 0.000021358209, 0.999997660603]), // 2022-07-04 11.1 h
        (762480069.1854, [0.930345065474, -0.366678856926, -0.002162182243, 0.366677770999, 0.930347577213, -0.000893212734, 0.002339103235, 0.000038171894, 0.999997263566]), // 2024-02-29 12 h
        (849031269.1830, [-0.912304124533, 0.409506377808, 0.002389747617, -0.409504898262, -0.912307254088, 0.001101107380, 0.002631094581, 0.000025931450, 0.999996538328]), // 2026-11-27 6 h
        (894389469.1854, [0.584277001769, -0.811552695225, -0.001614954362, 0.811549538124, 0.584279233525, -0.002263723172, 0.002780714938, 0.000012025922, 0.999996133732]), // 2028-05-05 5.5 h
        (946728069.1839, [-0.178926135507, 0.983862359384, 0.000543893910, -0.983858092225, -0.178926961387, 0.002897732106, 0.002948286831, -0.000016634417, 0.999995653655]), // 2030-01-01 0 h
    ];

    /// Components along the planet's axes of a vector in EME2000.
    fn fixed_from_eme2000(orientation: &Orientation, epoch_s: f64) -> Rotation3<f64> {
        orientation.equator(epoch_s).fixed_from_eme2000_after(0.0)
    }

    #[test]
    fn the_earth_is_oriented_as_by_the_full_theory() {
        let earth = Orientation::Iau { ut1_minus_utc_s: 0.0 };
        for (epoch_s, rows) in BY_ERFA {
            let found = fixed_from_eme2000(&earth, epoch_s);
            // A small rotation by an angle changes three columns by the root of 2 times as much.
            let off_rad = (found.matrix() - Matrix3::from_row_slice(&rows)).norm() * 0.5_f64.sqrt();
            assert!(off_rad < 0.1 * ARCSECOND_RAD, "{epoch_s}: {} arcsec", off_rad / ARCSECOND_RAD);
        }
    }

    #[test]
    fn a_second_of_ut1_rotates_it_by_fifteen_arc_seconds() {
        let at = |ut1_minus_utc_s: f64| fixed_from_eme2000(&Orientation::Iau { ut1_minus_utc_s }, 8e8);
        let turned_arcsec = at(1.0).angle_to(&at(0.0)) / ARCSECOND_RAD;
        assert!((turned_arcsec - 15.041).abs() < 1e-3, "{turned_arcsec}");
    }

    #[test]
    fn angular_velocity_is_how_the_axes_move() {
        let earth = Orientation::Iau { ut1_minus_utc_s: 0.3 };
        for orientation in
            [earth, Orientation::uniform(Body::Mercury.data()), Orientation::uniform(Body::Jupiter.data())]
        {
            let step_s = 50.0;
            let at = |epoch_s: f64| fixed_from_eme2000(&orientation, epoch_s).inverse();
            let turned = (at(8e8 + step_s) * at(8e8 - step_s).inverse()).scaled_axis() / (2.0 * step_s);
            let rate = orientation.equator(8e8).rotation_rad_s_eme2000();
            assert!((turned - rate).norm() < 1e-6 * rate.norm(), "{turned} {rate}");
            let pole = orientation.pole_eme2000(8e8);
            assert!((pole.cross(&rate)).norm() < 1e-15 * rate.norm() + 1e-20);
        }
    }

    #[test]
    fn without_precession_the_earth_is_within_a_third_of_a_degree_of_its_uniform_rotation() {
        let uniform = Orientation::uniform(Body::Earth.data());
        let earth = Orientation::Iau { ut1_minus_utc_s: 0.0 };
        let [uniform, earth] = [uniform, earth].map(|it| fixed_from_eme2000(&it, 7e8));
        let off_deg = uniform.angle_to(&earth).to_degrees();
        assert!(off_deg < 0.35, "{off_deg}");
    }
}
