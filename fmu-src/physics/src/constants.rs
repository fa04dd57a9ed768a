//! Named physical constants, each with unit and source.

/// Speed of light in vacuum, m/s (exact, SI).
pub const SPEED_OF_LIGHT_M_S: f64 = 299_792_458.0;
/// Astronomical unit, m (exact, IAU 2012 Resolution B2).
pub const ASTRONOMICAL_UNIT_M: f64 = 149_597_870_700.0;
/// Stefan-Boltzmann constant, W m-2 K-4 (exact in the SI of 2019, rounded to 10 digits).
pub const STEFAN_BOLTZMANN_W_M2_K4: f64 = 5.670_374_419e-8;
/// Molar gas constant, J mol-1 K-1 (exact in the SI of 2019, rounded to 15 digits).
pub const GAS_CONSTANT_J_MOL_K: f64 = 8.314_462_618_153_24;
/// Newtonian constant of gravitation, m3 kg-1 s-2 (CODATA 2018).
pub const GRAVITATIONAL_CONSTANT_M3_KG_S2: f64 = 6.674_30e-11;
/// Radians in a degree.
pub const DEG_RAD: f64 = core::f64::consts::PI / 180.0;
/// An arc second, in rad.
pub const ARCSECOND_RAD: f64 = DEG_RAD / 3600.0;
/// Radians a second in a revolution a minute.
pub const RPM_RAD_S: f64 = core::f64::consts::PI / 30.0;
/// Seconds in a day.
pub const DAY_S: f64 = 86_400.0;
/// Seconds in a Julian year.
pub const YEAR_S: f64 = 365.25 * DAY_S;
/// Units of time that files and options take, with their seconds, the SI unit first.
pub const TIME_UNITS: [(&str, f64); 6] =
    [("s", 1.0), ("ms", 1e-3), ("min", 60.0), ("h", 3600.0), ("d", DAY_S), ("a", YEAR_S)];
/// Standard acceleration of gravity, m/s2 (exact, CGPM 1901); turns specific impulse into exhaust speed.
pub const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// Gravitational parameter of the Sun, m3/s2 (JPL DE440).
pub const GM_SUN_M3_S2: f64 = 1.327_124_400_412_793_9e20;
/// Gravitational parameter of Mercury, m3/s2 (JPL DE440, from MESSENGER).
pub const GM_MERCURY_M3_S2: f64 = 2.203_186_855_1e13;
/// Gravitational parameter of Venus, m3/s2 (JPL DE440).
pub const GM_VENUS_M3_S2: f64 = 3.248_585_920_0e14;
/// Gravitational parameter of the Earth without the Moon, m3/s2 (JPL DE440).
pub const GM_EARTH_M3_S2: f64 = 3.986_004_355_07e14;
/// Gravitational parameter of the Moon, m3/s2 (DE440).
pub const GM_MOON_M3_S2: f64 = 4.902_800_118e12;
/// Mass of the Earth in masses of the Moon (DE440).
pub const EARTH_TO_MOON_MASS: f64 = 81.300_568_221_497_2;
/// Gravitational parameter of Mars without its moons, m3/s2 (JPL DE440).
pub const GM_MARS_M3_S2: f64 = 4.282_837_362_07e13;
/// Gravitational parameter of Jupiter without its moons, m3/s2 (JPL DE440).
pub const GM_JUPITER_M3_S2: f64 = 1.266_865_341_96e17;

/// Nominal radius of the Sun, m (IAU 2015 Resolution B3).
pub const RADIUS_SUN_M: f64 = 6.957e8;
/// Mean radius of Mercury, m (IAU Working Group on Cartographic Coordinates, 2015).
pub const RADIUS_MERCURY_M: f64 = 2.439_4e6;
/// Mean radius of Venus, m (IAU Working Group on Cartographic Coordinates, 2015).
pub const RADIUS_VENUS_M: f64 = 6.051_8e6;
/// Mean radius of the Earth, m (IAU Working Group on Cartographic Coordinates, 2015).
pub const RADIUS_EARTH_M: f64 = 6.371_008_4e6;
/// Mean radius of the Moon, m (IAU Working Group on Cartographic Coordinates, 2015).
pub const RADIUS_MOON_M: f64 = 1.737_4e6;
/// Mean radius of Mars, m (IAU Working Group on Cartographic Coordinates, 2015).
pub const RADIUS_MARS_M: f64 = 3.389_5e6;
/// Mean radius of Jupiter, m (IAU Working Group on Cartographic Coordinates, 2015).
pub const RADIUS_JUPITER_M: f64 = 6.991_1e7;

/// Second zonal harmonic J2 of Mercury, dimensionless, unnormalised (Mazarico et al. 2014, HgM005).
pub const J2_MERCURY: f64 = 5.032_3e-5;
/// Radius to which [`J2_MERCURY`] refers, m (HgM005).
pub const J2_REFERENCE_RADIUS_MERCURY_M: f64 = 2.44e6;

/// Least and greatest azimuth, and any angle counted both ways, in rad.
pub const HALF_TURNS_RAD: [f64; 2] = [-core::f64::consts::PI, core::f64::consts::PI];

/// Least and greatest elevation, in rad.
pub const QUARTER_TURNS_RAD: [f64; 2] = [-core::f64::consts::FRAC_PI_2, core::f64::consts::FRAC_PI_2];
