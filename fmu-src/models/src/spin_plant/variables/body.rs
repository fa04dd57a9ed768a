//! The spinning body: mass properties, spin, nutation, momentum.

use fmi_export::{Choice, Integer, Real, RealVector, Variables};

use super::choices::MassSource;
use physics::constants::HALF_TURNS_RAD;
use physics::spin::{plant, spinner::Spinner as Setup};

/// Mass properties.
#[derive(Variables)]
pub struct MassVariables {
    /// Where moments and products of inertia come from.
    #[parameter(start = MassSource(plant::MassSource::Fixed))]
    pub source: Choice<MassSource>,
    /// Principal moments of inertia now, the third about the spin axis; they follow the propellant if massProperties.source says
    /// so.
    #[output(unit = "kg.m2", nominal = 300.0)]
    pub inertia: RealVector<3>,
}

/// Propellant.
#[derive(Variables)]
pub struct PropellantVariables {
    /// On board at the start, up to the last point of the setup's mass properties. When it is used up, nothing fires any
    /// more: a pulse ends there.
    #[parameter(
        unit = "kg",
        min = 0.0,
        max = setup.mass_properties.most_propellant_kg(),
        start = setup.mass_properties.initial_propellant_kg
    )]
    pub loaded: Real,
    /// Propellant used since the start.
    #[output(unit = "kg", nominal = 0.01)]
    pub used: Real,
    /// Left on board.
    #[output(unit = "kg", nominal = 100.0)]
    pub left: Real,
}

/// Spin about the spin axis: the principal axis nearest to the third axis.
#[derive(Variables)]
pub struct SpinRateVariables {
    /// Rate about the spin axis at the start.
    #[parameter(unit = "rad/s", display = "rpm", min = 1e-4, max = 1e4, start = setup.limits.spin_rate_rad_s())]
    pub initial_rate: Real,
    /// Rate about the spin axis.
    #[output(unit = "rad/s", display = "rpm", nominal = 0.5)]
    pub rate: Real,
    /// Time between the last two Sun crossings; that of the present rate before there are two.
    #[output(discrete, unit = "s", nominal = 10.0)]
    pub period: Real,
    /// Change of the Sun-crossing period over the last turn.
    #[output(discrete, unit = "s", display = "ms", nominal = 1e-3)]
    pub period_change: Real,
    /// Variation of the Sun-crossing period by nutation, paper 002 eq 1; diverges as the Sun angle goes to 0 and is
    /// cut at one period.
    #[output(unit = "s", display = "ms", nominal = 1e-3)]
    pub period_variation: Real,
    /// Sectors by which the end of the last turn was misplaced, having been divided by the period of the turn before.
    #[output(discrete, unit = "1", nominal = 1.0)]
    pub sector_error: Real,
    /// Sun crossings since the start.
    #[output]
    pub sun_crossings: Integer,
}

/// Start of the flight.
#[derive(Variables)]
pub struct StartVariables {
    /// Attitude quaternion at the start, scalar last, from EME2000 to body.
    #[parameter(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub q: RealVector<4>,
    /// Angle between momentum and spin axis (the principal axis nearest to the third) at the start.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = 1.5, start = 0.0)]
    pub nutation: Real,
    /// Azimuth of the transverse momentum about the spin axis at the start, from body X toward Y.
    #[parameter(unit = "rad", display = "deg", start = 0.0)]
    pub nutation_phase: Real,
}

/// Attitude.
#[derive(Variables)]
pub struct AttitudeVariables {
    /// Attitude quaternion, scalar last, from EME2000 to the body frame; continuous, so its sign follows the turns.
    #[output(unit = "1", nominal = 1.0)]
    #[annotation(interpolation = "attitude", rate = "attitude.rate")]
    pub q: RealVector<4>,
    /// Angular rate of the body in EME2000, in body components: J^-1 h.
    #[output(unit = "rad/s", display = "deg/s", nominal = 1e-2)]
    pub rate: RealVector<3>,
}

/// Nutation: as it is and as theory foresees it.
#[derive(Variables)]
pub struct NutationVariables {
    /// Angle from the momentum to the spin axis, the principal axis nearest to the third.
    #[output(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, nominal = 1e-4)]
    pub angle: Real,
    /// Azimuth of the transverse momentum about the spin axis, from body X toward Y.
    #[output(unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1], nominal = 1.0)]
    pub phase: Real,
    /// Predicted after the last pulse by the linear theory (paper 002 eq 8 with the nutation kick for Gamma/n, for any
    /// train), without damper and initial nutation.
    #[output(discrete, unit = "rad", display = "deg", nominal = 1e-4)]
    pub predicted: Real,
    /// 1 + lambda/Omega: inertial nutation rate over spin rate; I3/IT for an axisymmetric body.
    #[calculated_parameter(unit = "1")]
    pub ratio: Real,
    /// Nutation that the burn's widest pulse raises from rest.
    #[calculated_parameter(unit = "rad", display = "deg")]
    pub kick: Real,
    /// Greatest nutation of a uniform train of such pulses: kick / |sin(phi/2)|.
    #[calculated_parameter(unit = "rad", display = "deg")]
    pub envelope: Real,
}

/// Angular momentum.
#[derive(Variables)]
pub struct MomentumVariables {
    /// System momentum in EME2000.
    #[output(unit = "N.m.s", nominal = 100.0)]
    pub inertial: RealVector<3>,
    /// System momentum in the body frame.
    #[output(unit = "N.m.s", nominal = 100.0)]
    pub body: RealVector<3>,
    /// Angle from where it pointed at the start: the manoeuvre done.
    #[output(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, nominal = 1e-2)]
    pub displacement: Real,
}

/// The body's third axis +Z, about which it spins but for coning.
#[derive(Variables)]
pub struct SpinAxisVariables {
    /// Unit vector in EME2000.
    #[output(unit = "1", nominal = 1.0)]
    pub inertial: RealVector<3>,
    /// Angle from where it pointed at the start.
    #[output(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, nominal = 1e-2)]
    pub displacement: Real,
}
