//! The spinner's variables at its public face.

mod body;
mod burn;
pub(super) mod choices;
mod observation;

use fmi_export::{Integer, Real, RealVector, Variables};

use body::{
    AttitudeVariables, MassVariables, MomentumVariables, NutationVariables, PropellantVariables,
    SpinAxisVariables, SpinRateVariables, StartVariables,
};
use burn::{BurnVariables, ThrusterVariables, TorqueVariables};
use observation::{EarthVariables, GeometryVariables, LimitVariables, StarTrackerVariables, SunVariables};

use crate::common::variables::WorkLimit;
use physics::spin::spinner::Spinner as Setup;

/// Every variable of the spinner, in the order of the XML.
#[derive(Variables)]
pub struct SpinVariables {
    /// Moments of inertia about the body axes through the centre of mass, the principal ones where productsOfInertia is 0. The
    /// principal axis nearest to the third is the spin axis.
    #[parameter(unit = "kg.m2", min = 1e-9, max = 1e12, start = setup.mass_properties.moments_kg_m2(setup.mass_properties.initial_propellant_kg))]
    pub inertia: RealVector<3>,
    /// Products of inertia 12, 13, 23 about the body axes: elements of the inertia tensor, -integral of x_i x_j dm.
    #[parameter(unit = "kg.m2", min = -1e12, max = 1e12, start = setup.mass_properties.products_kg_m2(setup.mass_properties.initial_propellant_kg))]
    pub products_of_inertia: RealVector<3>,
    /// I3/IT with IT = sqrt(I1 I2) of the principal moments, paper 002 eq 11.
    #[output(unit = "1", nominal = 1.0)]
    pub inertia_ratio: Real,
    pub mass_properties: MassVariables,
    pub propellant: PropellantVariables,
    pub spin: SpinRateVariables,
    pub start: StartVariables,
    /// Time in which the nutation angle falls to 1/e about the axis of greatest inertia, and grows by e about another; 0
    /// = no damper. It conserves angular momentum.
    #[parameter(name = "damper.timeConstant", unit = "s", display = "h", min = 0.0, max = 1e12, start = setup.damper_time_constant_s)]
    pub damper_time_constant: Real,
    pub burn: BurnVariables,
    /// Step to which thruster[k].onDelay and onTime are rounded, and the widths of a taper; 0 = not rounded.
    #[parameter(name = "pulse.resolution", unit = "s", display = "ms", min = 0.0, start = setup.resolution_s)]
    pub pulse_resolution: Real,
    #[group(count = setup.thrusters.len(), setup = &setup.thrusters[index])]
    pub thruster: Vec<ThrusterVariables>,
    pub torque: TorqueVariables,
    /// Force of the thrusters, body frame.
    #[output(name = "force.thruster", unit = "N", nominal = 1.0)]
    pub force_thruster: RealVector<3>,
    pub geometry: GeometryVariables,
    pub sun: SunVariables,
    pub earth: EarthVariables,
    /// Direction of the star in EME2000, of any length; 0 = not known yet, nothing is seen.
    #[input(name = "star.direction", unit = "1", start = [0.3, 0.95, 0.02])]
    pub star_direction: RealVector<3>,
    pub limit: LimitVariables,
    pub attitude: AttitudeVariables,
    pub nutation: NutationVariables,
    // Coning: +Z goes round the spin axis where it is no principal axis.
    /// Angle from +Z to the spin axis, the principal axis nearest to it; 0 without products of inertia.
    #[output(name = "coning.angle", unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, nominal = 1e-2)]
    pub coning_angle: Real,
    pub momentum: MomentumVariables,
    pub spin_axis: SpinAxisVariables,
    /// Sun angle measured at the last crossing, with noise; 0 before any.
    #[output(name = "sunSensor.angle", discrete, unit = "rad", display = "deg", nominal = 0.1)]
    pub sun_sensor_angle: Real,
    pub star_tracker: StarTrackerVariables,
    /// Velocity change by the thrusters since the start, in EME2000.
    #[output(unit = "m/s", display = "mm/s", nominal = 1e-2)]
    pub delta_v: RealVector<3>,
    /// Spacecraft mass, with the propellant left.
    #[output(unit = "kg", nominal = 1e3)]
    pub mass: Real,
    /// Kinetic energy of rotation.
    #[output(unit = "N.m", nominal = 50.0)]
    pub energy: Real,
    /// Seed of all sensor noise and of the scatter of pulses; the same seed gives the same draws.
    #[parameter(start = 1)]
    pub seed: Integer,
    pub solver: WorkLimit,
}
