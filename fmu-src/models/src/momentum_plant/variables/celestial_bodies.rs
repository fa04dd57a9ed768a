//! Planet, Sun and Earth.

use fmi_export::{Boolean, Real, RealVector, Variables};
use physics::constants::{HALF_TURNS_RAD, QUARTER_TURNS_RAD, RADIUS_SUN_M};

use super::super::setup::PlantSetup as Setup;
use crate::common::orientation::RotationVariables;
use crate::common::variables::SurfaceVariables;

/// The planet the spacecraft orbits.
#[derive(Variables)]
pub struct PlanetVariables {
    /// Gravitational parameter of the planet: by default that of orbit.center, as everything of planet.* is.
    #[parameter(unit = "m3/s2", display = "km3/s2", min = 0.0, max = 1e21, start = setup.center.data.gm_m3_s2)]
    pub gravitational_parameter: Real,
    /// Radius of the planet; a spacecraft below it is refused.
    #[parameter(unit = "m", display = "km", min = 1.0, max = 1e9, start = setup.center.data.radius_m)]
    pub radius: Real,
    /// Flattening of the planet's gravity, on a disturbed orbit and with gravityGradient.flattening: second zonal harmonic,
    /// unnormalised (HgM005); 0 = none.
    #[parameter(unit = "1", min = -1.0, max = 1.0, start = setup.center.data.j2)]
    pub j2: Real,
    /// Radius to which planet.j2 refers.
    #[parameter(unit = "m", display = "km", min = 1.0, max = 1e9, start = setup.center.data.j2_radius_m)]
    pub j2_radius: Real,
    #[group(name = "", setup = &setup.center)]
    pub rotation: RotationVariables,
    #[group(name = "", setup = &setup.center)]
    pub surface: SurfaceVariables,
    /// From the spacecraft to the planet's centre, body frame; 0 without a planet, that is with orbit.center sun.
    #[output(unit = "m", display = "km", nominal = 1e7)]
    pub position_body: RealVector<3>,
    /// North of the planet, body frame; 0 unless gravityGradient.flattening.
    #[output(unit = "1", nominal = 1.0)]
    pub pole_body: RealVector<3>,
}

/// The Sun as seen from the spacecraft.
#[derive(Variables)]
pub struct SunVariables {
    /// Radius of the Sun (IAU 2015 nominal): width of the penumbra, and of shadows of parts by shadowing.sunDisc. Others use
    /// 695,000 or 696,000 km, which moves an edge of a shadow by some 2 ms.
    #[parameter(unit = "m", display = "km", min = 1.0, max = 1e10, start = RADIUS_SUN_M)]
    pub radius: Real,
    /// Sun's position from the orbit's centre in EME2000 when ephemeris.source is inputs. While it is zero the flight waits
    /// for it: the attitude is held and nothing acts.
    #[input(unit = "m", display = "AU", start = [0.0; 3])]
    #[annotation(
        also_called = "sun.positionInertial[i]",
        interpolation = "position",
        rate = "sun.velocity[i]"
    )]
    #[read_where(option = "ephemeris.source", items = "inputs")]
    pub position: RealVector<3>,
    /// Its velocity, by which the rate of an attitude that follows it is known; the position holds until it is set anew.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    #[annotation(also_called = "sun.velocityInertial[i]")]
    #[read_where(option = "ephemeris.source", items = "inputs")]
    pub velocity: RealVector<3>,
    /// From the spacecraft to the Sun, body frame.
    #[output(unit = "m", display = "AU", nominal = 1e11)]
    pub position_body: RealVector<3>,
    /// Sun's position from the orbit's centre in EME2000, for models that have it as an input.
    #[output(unit = "m", display = "AU", nominal = 1e11)]
    pub position_inertial: RealVector<3>,
    /// Its velocity; sun.velocity when ephemeris.source is inputs.
    #[output(unit = "m/s", display = "km/s", nominal = 1e4)]
    pub velocity_inertial: RealVector<3>,
    /// Unit vector to the Sun, body frame.
    #[output(unit = "1", nominal = 1.0)]
    pub direction: RealVector<3>,
    /// Azimuth of the Sun in the body frame, from -Y toward +X.
    #[output(unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1])]
    #[annotation(limited_by = "keepIn.azimuth")]
    pub azimuth: Real,
    /// Elevation of the Sun in the body frame, positive toward -Z.
    #[output(unit = "rad", display = "deg", min = QUARTER_TURNS_RAD[0], max = QUARTER_TURNS_RAD[1])]
    #[annotation(limited_by = "keepIn.elevation")]
    pub elevation: Real,
    /// Elevation of the Sun over the plane of the orbit about orbit.currentCenter, positive on the side of the angular momentum; 0
    /// without such a plane.
    #[output(unit = "rad", display = "deg", min = QUARTER_TURNS_RAD[0], max = QUARTER_TURNS_RAD[1])]
    pub beta: Real,
    /// Visible part of the Sun's disc: 1 in full light, 0 in the planet's shadow.
    #[output(unit = "1", min = 0.0, max = 1.0, nominal = 1.0)]
    #[annotation(role = "litFraction")]
    pub lit_fraction: Real,
    /// Unit vector to the Sun, body frame, as the Sun sensors give it; 0 where none sees it.
    #[output(unit = "1", nominal = 1.0)]
    pub sensed: RealVector<3>,
    /// Whether a Sun sensor sees it.
    #[output]
    pub sensed_valid: Boolean,
    /// Distance from the Sun.
    #[output(unit = "m", display = "AU", nominal = 1e11)]
    pub distance: Real,
}

/// The Earth as seen from the spacecraft.
#[derive(Variables)]
pub struct EarthVariables {
    /// UT1 minus UTC, for the Earth's orientation iau.
    #[parameter(tunable, unit = "s", min = -1e3, max = 1e3, start = 0.0)]
    pub ut1_offset: Real,
    /// Earth's position from the orbit's centre in EME2000 when ephemeris.source is inputs.
    #[input(unit = "m", display = "AU", start = [0.0; 3])]
    #[annotation(
        also_called = "earth.positionInertial[i]",
        interpolation = "position",
        rate = "earth.velocity[i]"
    )]
    #[read_where(option = "ephemeris.source", items = "inputs")]
    pub position: RealVector<3>,
    /// Its velocity, by which the rate of an attitude that follows it is known; the position holds until it is set anew.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    #[annotation(also_called = "earth.velocityInertial[i]")]
    #[read_where(option = "ephemeris.source", items = "inputs")]
    pub velocity: RealVector<3>,
    /// Earth's position from the orbit's centre in EME2000, for models that have it as an input.
    #[output(unit = "m", display = "AU", nominal = 1e11)]
    pub position_inertial: RealVector<3>,
    /// Its velocity; earth.velocity when ephemeris.source is inputs.
    #[output(unit = "m/s", display = "km/s", nominal = 1e4)]
    pub velocity_inertial: RealVector<3>,
    /// Azimuth of the Earth in the body frame, from -Y toward +X.
    #[output(unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1])]
    pub azimuth: Real,
    /// Elevation of the Earth in the body frame, positive toward -Z.
    #[output(unit = "rad", display = "deg", min = QUARTER_TURNS_RAD[0], max = QUARTER_TURNS_RAD[1])]
    pub elevation: Real,
}
