//! The Sun and the planets as data: gravity, figure, pole, rotation, orbit plane, surface.
//!
//! A body is one row of [`BODIES`]; a new one is a new row, and for VSOP87 one line in [`crate::environment::ephemeris`].
//! Gravitational parameters are DE440's, poles and rotations those of the IAU working group on cartographic coordinates at
//! J2000 (Archinal et al. 2018; Mars 2009, whose series has no periodic terms), orbit planes the mean ones at J2000 on the
//! ecliptic (Standish, Keplerian elements for approximate positions, 1800 to 2050). A planet's surface radiates and reflects
//! by Lambert's law: Bond albedo and effective temperature (NASA planetary fact sheets) are all that is known of a cloudy
//! one here. Equators and flattenings are those of the IAU's working group too, the Earth's WGS 84's.

pub mod air;
pub mod dipole;
pub mod surface;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::constants::{self, DEG_RAD};
use crate::enumeration::enumeration;
use crate::math;
use air::ExponentialAir;
use dipole::DipoleField;
use surface::{DayTemperature, PlanetSurface};

enumeration! {
    /// A body that a spacecraft can orbit or observe.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
    #[serde(rename_all = "camelCase")]
    pub enum Body {
        /// The Sun.
        2 => Sun,
        /// Mercury.
        1 => Mercury,
        /// Venus.
        3 => Venus,
        /// The Earth.
        // Itself, not the Earth-Moon barycentre.
        4 => Earth,
        /// Mars.
        6 => Mars,
        /// Jupiter.
        7 => Jupiter,
        /// The body that the spacecraft's file describes.
        // [`Spacecraft::body`](crate::spacecraft::Spacecraft) has its data; 8 to 99 are free for bodies to come.
        100 => Custom,
    }
}

/// Data of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyData {
    /// The body.
    pub body: Body,
    /// Its name.
    pub name: &'static str,
    /// Body that it orbits, whose tide it feels; `None` for the Sun.
    pub parent: Option<Body>,
    /// Gravitational parameter of the body alone, without moons, in m3/s2.
    pub gm_m3_s2: f64,
    /// Mean radius, in m.
    pub radius_m: f64,
    /// Second zonal harmonic of its gravity, unnormalised.
    pub j2: f64,
    /// Radius to which `j2` refers, in m.
    pub j2_radius_m: f64,
    /// Right ascension of the north pole in EME2000 at J2000, in rad.
    pub pole_right_ascension_rad: f64,
    /// Declination of the north pole in EME2000 at J2000, in rad.
    pub pole_declination_rad: f64,
    /// Angle of the prime meridian from the ascending node of the equator on that of EME2000, at J2000, in rad.
    pub prime_meridian_rad: f64,
    /// Sidereal rotation rate about the north pole, in rad/s.
    pub rotation_rate_rad_s: f64,
    /// Semi-major axis of its mean orbit about the Sun at J2000, in m; 0 for the Sun, as the five below.
    pub orbit_semi_major_axis_m: f64,
    /// Eccentricity of that orbit.
    pub orbit_eccentricity: f64,
    /// Longitude of its ascending node on the ecliptic of J2000, in rad.
    pub orbit_node_rad: f64,
    /// Its inclination to the ecliptic of J2000, in rad.
    pub orbit_inclination_rad: f64,
    /// Longitude of its perihelion, in rad: ascending node plus argument of perihelion.
    pub orbit_perihelion_longitude_rad: f64,
    /// Radius of its equator, in m.
    pub equatorial_radius_m: f64,
    /// 1 less the ratio of its polar to its equatorial radius.
    pub flattening: f64,
    /// Its air by the exponential model, where there is some.
    pub atmosphere: Option<ExponentialAir>,
    /// Its magnetic field as a dipole, where one is known.
    pub dipole: Option<DipoleField>,
    /// Its surface in sunlight; `None` for the Sun.
    pub surface: Option<PlanetSurface>,
}

impl Body {
    /// Number of bodies, with that of a spacecraft's file.
    pub const COUNT: usize = Self::ALL.len() + 1;

    /// The known bodies.
    pub const ALL: [Self; 6] =
        [Self::Sun, Self::Mercury, Self::Venus, Self::Earth, Self::Mars, Self::Jupiter];

    /// Data of the body; of the body of a spacecraft's file its name alone.
    pub const fn data(self) -> &'static BodyData {
        &BODIES[self as usize]
    }

    /// Whether sunlight falls on it and it casts a shadow.
    pub const fn is_planet(self) -> bool {
        !matches!(self, Self::Sun)
    }
}

/// Least and greatest mean density of a body, in kg/m3: from a comet of loose snow to beyond all planets.
pub const MEAN_DENSITY_KG_M3: [f64; 2] = [100.0, 30_000.0];

/// Mean density of an ellipsoid with these radii that attracts like that, in kg/m3, where it is none of [`MEAN_DENSITY_KG_M3`].
pub fn impossible_density_kg_m3(gm_m3_s2: f64, [a_m, b_m, c_m]: [f64; 3]) -> Option<f64> {
    let volume_m3 = 4.0 / 3.0 * core::f64::consts::PI * a_m * b_m * c_m;
    let density_kg_m3 = gm_m3_s2 / constants::GRAVITATIONAL_CONSTANT_M3_KG_S2 / volume_m3;
    let [least, most] = MEAN_DENSITY_KG_M3;
    (!(least..=most).contains(&density_kg_m3)).then_some(density_kg_m3)
}

/// Radius of the sphere of influence of a body that attracts like that on an orbit of this semi-major axis about its parent, in m.
pub fn sphere_of_influence_m(gm_m3_s2: f64, semi_major_axis_m: f64, parent: Body) -> f64 {
    semi_major_axis_m * math::powf(gm_m3_s2 / parent.data().gm_m3_s2, 0.4)
}

impl BodyData {
    /// Radius of the sphere of influence, in m; 0 for a body without parent or known orbit.
    pub fn sphere_of_influence_m(&self) -> f64 {
        self.parent
            .map_or(0.0, |parent| sphere_of_influence_m(self.gm_m3_s2, self.orbit_semi_major_axis_m, parent))
    }

    /// Default position of the Sun for a spacecraft about this body, from the spacecraft in body axes, in m:
    /// on -Y, at the planet's mean distance from it (Mercury's as paper 004 has it), 1 AU where none is known.
    pub fn usual_sun_body_m(&self) -> [f64; 3] {
        let distance_m = match self.body {
            Body::Mercury => 5.791e10,
            _ if self.orbit_semi_major_axis_m == 0.0 => constants::ASTRONOMICAL_UNIT_M,
            _ => self.orbit_semi_major_axis_m,
        };
        [0.0, -distance_m, 0.0]
    }

    /// Default position of the planet likewise, in m: four radii away.
    pub fn usual_planet_body_m(&self) -> [f64; 3] {
        let radii = self.radius_m / Body::Mercury.data().radius_m;
        [2e6, 3e6, 9e6].map(|along_m| along_m * radii)
    }

    /// The same with another north pole, a unit vector in EME2000.
    #[must_use]
    pub fn with_pole(&self, pole: &Vector3<f64>) -> Self {
        Self {
            pole_right_ascension_rad: math::atan2(pole.y, pole.x),
            pole_declination_rad: math::atan2(pole.z, math::hypot(pole.x, pole.y)),
            ..*self
        }
    }

    /// The same with its north pole and prime meridian at J2000 at these angles in deg, turning at a rate in deg/day.
    const fn rotating(self, [ascension, declination, meridian]: [f64; 3], rate_deg_day: f64) -> Self {
        Self {
            pole_right_ascension_rad: ascension * DEG_RAD,
            pole_declination_rad: declination * DEG_RAD,
            prime_meridian_rad: meridian * DEG_RAD,
            rotation_rate_rad_s: rate_deg_day * DEG_RAD / constants::DAY_S,
            ..self
        }
    }

    /// The same on a mean orbit at J2000: semi-major axis in AU, eccentricity, then ascending node, inclination and longitude of
    /// perihelion in deg.
    const fn on_orbit(
        self,
        axis_au: f64,
        eccentricity: f64,
        [node, inclination, perihelion]: [f64; 3],
    ) -> Self {
        Self {
            orbit_semi_major_axis_m: axis_au * constants::ASTRONOMICAL_UNIT_M,
            orbit_eccentricity: eccentricity,
            orbit_node_rad: node * DEG_RAD,
            orbit_inclination_rad: inclination * DEG_RAD,
            orbit_perihelion_longitude_rad: perihelion * DEG_RAD,
            ..self
        }
    }

    /// Unit vector to the north pole, in EME2000.
    pub fn pole(&self) -> Vector3<f64> {
        let (sin_ra, cos_ra) = math::sin_cos(self.pole_right_ascension_rad);
        let (sin_dec, cos_dec) = math::sin_cos(self.pole_declination_rad);
        Vector3::new(cos_ra * cos_dec, sin_ra * cos_dec, sin_dec)
    }
}

/// The surface of a body whose clouds or soil are known by Bond albedo and effective temperature alone.
const fn gray(radius_m: f64, bond_albedo: f64, effective_temperature_k: f64) -> PlanetSurface {
    PlanetSurface {
        radius_m,
        absorptivity: 1.0 - bond_albedo,
        diffuse_reflectivity: bond_albedo,
        emissivity: 1.0,
        night_temperature_k: effective_temperature_k,
        day_temperature: DayTemperature::Isothermal,
    }
}

/// Data of a body before its file is read: a point with its pole to the north of EME2000.
const CUSTOM: BodyData = BodyData {
    body: Body::Custom,
    name: "the body of the spacecraft's file",
    parent: Some(Body::Sun),
    gm_m3_s2: 0.0,
    radius_m: 1.0,
    j2: 0.0,
    j2_radius_m: 1.0,
    pole_right_ascension_rad: 0.0,
    pole_declination_rad: 90.0 * DEG_RAD,
    prime_meridian_rad: 0.0,
    rotation_rate_rad_s: 0.0,
    orbit_semi_major_axis_m: 0.0,
    orbit_eccentricity: 0.0,
    orbit_node_rad: 0.0,
    orbit_inclination_rad: 0.0,
    orbit_perihelion_longitude_rad: 0.0,
    equatorial_radius_m: 1.0,
    flattening: 0.0,
    atmosphere: None,
    dipole: None,
    surface: None,
};

/// Every body, in the order of [`Body`].
pub const BODIES: [BodyData; Body::COUNT] = [
    BodyData {
        body: Body::Sun,
        name: "the Sun",
        parent: None,
        gm_m3_s2: constants::GM_SUN_M3_S2,
        radius_m: constants::RADIUS_SUN_M,
        j2_radius_m: constants::RADIUS_SUN_M,
        equatorial_radius_m: constants::RADIUS_SUN_M,
        ..CUSTOM.rotating([286.13, 63.87, 84.176], 14.184_4)
    },
    BodyData {
        body: Body::Mercury,
        name: "Mercury",
        gm_m3_s2: constants::GM_MERCURY_M3_S2,
        radius_m: constants::RADIUS_MERCURY_M,
        j2: constants::J2_MERCURY,
        j2_radius_m: constants::J2_REFERENCE_RADIUS_MERCURY_M,
        equatorial_radius_m: 2_440.53e3,
        flattening: 1.0 - 2_438.26 / 2_440.53,
        dipole: Some(dipole::MERCURY),
        surface: Some(surface::MERCURY),
        // Node and inclination of paper 004 Table 4; Standish has 48.3308 and 7.0050 deg.
        ..CUSTOM.rotating([281.010_3, 61.415_5, 329.598_8], 6.138_510_8).on_orbit(
            0.387_099_27,
            0.205_635_93,
            [48.33, 7.0, 77.457_796_28],
        )
    },
    BodyData {
        body: Body::Venus,
        name: "Venus",
        gm_m3_s2: constants::GM_VENUS_M3_S2,
        radius_m: constants::RADIUS_VENUS_M,
        // Konopliv et al. 1999, MGNP180U.
        j2: 4.404e-6,
        j2_radius_m: 6.051e6,
        equatorial_radius_m: 6_051.8e3,
        atmosphere: Some(air::VENUS),
        surface: Some(gray(constants::RADIUS_VENUS_M, 0.77, 226.6)),
        ..CUSTOM.rotating([272.76, 67.16, 160.20], -1.481_368_8).on_orbit(
            0.723_335_66,
            0.006_776_72,
            [76.679_842_55, 3.394_676_05, 131.602_467_18],
        )
    },
    BodyData {
        body: Body::Earth,
        name: "the Earth",
        gm_m3_s2: constants::GM_EARTH_M3_S2,
        radius_m: constants::RADIUS_EARTH_M,
        // EGM2008.
        j2: 1.082_635_9e-3,
        j2_radius_m: 6.378_136_3e6,
        equatorial_radius_m: 6_378_137.0,
        flattening: 1.0 / 298.257_223_563,
        atmosphere: Some(air::EARTH),
        dipole: Some(dipole::EARTH),
        surface: Some(gray(constants::RADIUS_EARTH_M, 0.294, 254.0)),
        ..CUSTOM.rotating([0.0, 90.0, 190.147], 360.985_623_5).on_orbit(
            1.000_002_61,
            0.016_711_23,
            [0.0, 0.0, 102.937_681_93],
        )
    },
    BodyData {
        body: Body::Mars,
        name: "Mars",
        gm_m3_s2: constants::GM_MARS_M3_S2,
        radius_m: constants::RADIUS_MARS_M,
        // Konopliv et al. 2011, MRO110B.
        j2: 1.956_6e-3,
        j2_radius_m: 3.396e6,
        equatorial_radius_m: 3_396.19e3,
        flattening: 1.0 - 3_376.20 / 3_396.19,
        atmosphere: Some(air::MARS),
        surface: Some(gray(constants::RADIUS_MARS_M, 0.25, 209.8)),
        ..CUSTOM.rotating([317.681_43, 52.886_50, 176.630], 350.891_982_26).on_orbit(
            1.523_710_34,
            0.093_394_1,
            [49.559_538_91, 1.849_691_42, -23.943_629_59],
        )
    },
    BodyData {
        body: Body::Jupiter,
        name: "Jupiter",
        gm_m3_s2: constants::GM_JUPITER_M3_S2,
        radius_m: constants::RADIUS_JUPITER_M,
        // Iess et al. 2018.
        j2: 1.469_657_2e-2,
        j2_radius_m: 7.149_2e7,
        equatorial_radius_m: 71_492e3,
        flattening: 1.0 - 66_854.0 / 71_492.0,
        atmosphere: Some(air::JUPITER),
        dipole: Some(dipole::JUPITER),
        surface: Some(gray(constants::RADIUS_JUPITER_M, 0.343, 109.9)),
        ..CUSTOM.rotating([268.056_595, 64.495_303, 284.95], 870.536).on_orbit(
            5.202_887,
            0.048_386_24,
            [100.473_909_09, 1.304_396_95, 14.728_479_83],
        )
    },
    CUSTOM,
];

#[cfg(test)]
mod tests;
