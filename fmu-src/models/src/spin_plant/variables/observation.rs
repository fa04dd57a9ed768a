//! Sun, Earth and stars, what sees them, and the limits they set.

use core::f64::consts::PI;

use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Variables};

use super::choices::{GeometrySource, StarSampling};
use physics::constants::QUARTER_TURNS_RAD;
use physics::spin::{plant::Sampling, spinner::Spinner as Setup};

use physics::math;

/// Directions of Sun and Earth.
#[derive(Variables)]
pub struct GeometryVariables {
    /// Where the directions of Sun and Earth come from.
    #[parameter(start = GeometrySource::Inputs)]
    pub source: Choice<GeometrySource>,
    /// Rate at which the Earth-Sun line turns in the ecliptic, on the L1 orbit.
    #[parameter(unit = "rad/s", display = "deg/s", min = -1e-3, max = 1e-3, start = setup.l1_orbit.line_rate_rad_s())]
    pub line_rate: Real,
    /// Lissajous amplitudes: along the Earth-Sun line, across it in the ecliptic, out of the ecliptic.
    #[parameter(unit = "m", display = "km", min = -1e12, max = 1e12, start = setup.l1_orbit.amplitude_m)]
    pub amplitude: RealVector<3>,
    /// Ecliptic longitude of the Earth seen from the Sun at time 0, on the L1 orbit.
    #[parameter(unit = "rad", display = "deg", min = -1e6, max = 1e6, start = 0.0)]
    pub longitude: Real,
    /// In-plane phase of the Lissajous motion at time 0.
    #[parameter(unit = "rad", display = "deg", min = -1e6, max = 1e6, start = 0.0)]
    pub in_plane_phase: Real,
    /// Out-of-plane phase of the Lissajous motion at time 0.
    #[parameter(unit = "rad", display = "deg", min = -1e6, max = 1e6, start = 0.0)]
    pub out_of_plane_phase: Real,
}

/// The Sun.
#[derive(Variables)]
pub struct SunVariables {
    /// Direction of the Sun in EME2000, of any length; 0 = not known yet, nothing is seen. Unused on the L1 orbit. The default is 10 deg off the spin axis,
    /// across the way to the default target: a burn timed by the Sun does not run into it.
    #[input(unit = "1", start = [0.0, math::sin(10.0_f64.to_radians()), math::cos(10.0_f64.to_radians())])]
    pub direction: RealVector<3>,
    /// From the spin axis +Z to the Sun.
    #[output(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, nominal = 0.1)]
    pub angle: Real,
    /// Direction of the Sun that is in force, unit vector in EME2000; 0 where it is not known.
    #[output(unit = "1", nominal = 1.0)]
    pub inertial: RealVector<3>,
}

/// The Earth.
#[derive(Variables)]
pub struct EarthVariables {
    /// Direction of the Earth in EME2000, of any length; 0 = not known yet. Unused on the L1 orbit.
    #[input(unit = "1", start = [0.0, 0.0, -1.0])]
    pub direction: RealVector<3>,
    /// From the antenna -Z to the Earth.
    #[output(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, nominal = 0.01)]
    pub angle: Real,
    /// Direction of the Earth that is in force, unit vector in EME2000; 0 where it is not known.
    #[output(unit = "1", nominal = 1.0)]
    pub inertial: RealVector<3>,
}

/// Mission limits and whether they are violated.
#[derive(Variables)]
pub struct LimitVariables {
    /// Greatest Sun angle.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = PI, start = setup.limits.sun_angle_rad())]
    pub sun_angle: Real,
    /// Greatest Earth angle.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = PI, start = setup.limits.earth_angle_rad())]
    pub earth_angle: Real,
    /// Nominal spin rate; at the start it also sets the star tracker's clock.
    #[parameter(tunable, unit = "rad/s", display = "rpm", min = 1e-4, max = 1e4, start = setup.limits.spin_rate_rad_s())]
    pub spin_rate: Real,
    /// Allowed either side of the nominal spin rate.
    #[parameter(
        tunable,
        unit = "rad/s",
        display = "rpm",
        min = 0.0,
        start = setup.limits.spin_rate_tolerance_rad_s()
    )]
    pub spin_rate_tolerance: Real,
    /// Greatest variation of the spin period, eq 1.
    #[parameter(tunable, unit = "s", display = "ms", min = 0.0, start = setup.limits.period_variation_s.0)]
    pub period_variation: Real,
    /// The Sun angle is beyond its limit.
    #[output]
    pub sun_angle_violated: Boolean,
    /// The Earth angle is beyond its limit.
    #[output]
    pub earth_angle_violated: Boolean,
    /// The spin rate is out of its range.
    #[output]
    pub spin_rate_violated: Boolean,
    /// The variation of the spin period is beyond its limit: science data fall into wrong sectors.
    #[output]
    pub period_variation_violated: Boolean,
    /// Any of them.
    #[output]
    pub any_violated: Boolean,
}

/// The star tracker.
#[derive(Variables)]
pub struct StarTrackerVariables {
    /// When it samples the star.
    #[parameter(start = StarSampling(Sampling::Spins))]
    pub sampling: Choice<StarSampling>,
    /// Declination of the star at the last sample, with noise; 0 before any.
    #[output(discrete, unit = "rad", display = "deg", nominal = 1e-2)]
    pub declination: Real,
    /// Declination of the star now, without noise.
    #[output(unit = "rad", display = "deg", min = QUARTER_TURNS_RAD[0], max = QUARTER_TURNS_RAD[1], nominal = 1e-2)]
    pub declination_true: Real,
    /// Time of the last sample; -1 before any.
    #[output(discrete, unit = "s")]
    pub sample_time: Real,
    /// Samples so far.
    #[output]
    pub sample_count: Integer,
    /// Nutation angle estimated from the samples since the last pulse, with the phase of the start's spin and ratio.
    #[output(discrete, unit = "rad", display = "deg", nominal = 1e-4)]
    pub nutation: Real,
    /// Standard deviation of that estimate; pi while the samples do not tell.
    #[output(discrete, unit = "rad", display = "deg", nominal = 1e-4)]
    pub nutation_sigma: Real,
    /// Time to see the full range of declinations with the sampling chosen.
    #[calculated_parameter(unit = "s", display = "min")]
    pub observation_time: Real,
    /// The same for samples at the nominal rate by the clock, paper 002 eq 20.
    #[calculated_parameter(unit = "s", display = "min")]
    pub observation_time_nominal: Real,
}
