//! The spacecraft itself: mass, shade, panels, wheels, faces.

use fmi_export::{Boolean, Choice, Failure, Real, RealMatrix, RealVector, Values, Variables};
use physics::constants::HALF_TURNS_RAD;
use physics::spacecraft::{Articulation, SunKeepIn};

use physics::guidance::constraints::keep_in;

use super::super::setup::PlantSetup as Setup;
use super::choices::PanelControl;
use crate::common::choices::{KeepInMethod, PanelTilt, SunshadeShape};

/// Mass properties.
#[derive(Variables)]
pub struct SpacecraftVariables {
    /// Spacecraft mass.
    #[parameter(tunable, unit = "kg", min = 1e-3, max = 1e12, start = setup.spacecraft.mass_properties.mass_kg)]
    pub mass: Real,
    /// Inertia about the centre of mass, body frame.
    #[parameter(unit = "kg.m2", min = -1e15, max = 1e15, start = setup.spacecraft.mass_properties.inertia_body_kg_m2.transpose().into())]
    pub inertia: RealMatrix<3, 3>,
    /// Centre of mass in the body frame, with every panel at angle 0; panels that have a mass move it by the file's masses.
    #[parameter(tunable, unit = "m", display = "cm", min = -1e4, max = 1e4, start = setup.spacecraft.mass_properties.center_of_mass_body_m.into())]
    pub center_of_mass: RealVector<3>,
    /// Standard deviation by which the centre of mass lies off spacecraft.centerOfMass, drawn from noise.seed anew at each thruster
    /// event (dump or maneuver), in guided and commanded flight; 0 in controlled and free flight.
    #[parameter(unit = "m", display = "cm", min = 0.0, max = 1e2, start = [0.0; 3])]
    pub center_of_mass_shift: RealVector<3>,
}

/// Sunshade.
#[derive(Variables)]
pub struct SunshadeVariables {
    /// Which model of the shade takes the light; without a shade it does not count.
    #[parameter(start = SunshadeShape::for_spacecraft(&setup.spacecraft))]
    pub shape: Choice<SunshadeShape>,
    /// Coefficients of paper 000's eq 3 for the shade in use, about the centre of mass, in the shade's frame: rows are
    /// torque components x, y, z; columns the monomials x, y, z, xy, xz, yz, xx, yy, zz of the Sun direction. Torque
    /// is pressure times the polynomial while sunshade.polynomialValid holds.
    #[calculated_parameter(tunable, unit = "m3")]
    pub coefficient: RealMatrix<3, 9>,
    /// Whether all of the shade is lit, so that the polynomial gives its torque; elsewhere it is clipped.
    #[output]
    pub polynomial_valid: Boolean,
}

/// One solar panel.
#[derive(Variables)]
pub struct PanelVariables {
    /// What sets the panel's rotation angle.
    #[parameter(start = PanelControl(setup.spacecraft.panels[index].control))]
    pub control: Choice<PanelControl>,
    /// Angle between the panel's normal and the Sun direction when it is held by Sun offset; its sign is a sense of tilt.
    #[parameter(tunable, unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1], start = setup.spacecraft.panels[index].sun_offset_rad)]
    pub sun_offset: Real,
    /// Added to the rotation angle, whatever sets it: as mounted or measured.
    #[parameter(tunable, unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1], start = 0.0)]
    pub angle_bias: Real,
    /// Sense of tilt of a positive offset; the paper does not print it.
    #[parameter(start = PanelTilt::for_panel(&setup.spacecraft.panels[index]))]
    pub tilt: Choice<PanelTilt>,
    /// Whether the panel takes part; paper 000's Tables 2 and 3 leave the panels out.
    #[parameter(start = true)]
    pub enabled: Boolean,
    /// Rotation angle about the panel's axis from its zero position; it counts when panel control is by angle. Where it jumps, the
    /// panel goes the shorter way: +180 and -180 deg are one place.
    #[input(unit = "rad", display = "deg", start = setup.spacecraft.panels[index].angle_rad)]
    #[annotation(also_called = "panel[k].angleActual")]
    #[read_where(option = "panel[k].control", items = "angle")]
    pub angle: Real,
    /// Angle between the panel's normal and the Sun direction when panel control is by command; its sign is a sense of tilt.
    #[input(unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1], start = setup.spacecraft.panels[index].sun_offset_rad)]
    #[annotation(also_called = "panel[k].sunOffset")]
    #[read_where(option = "panel[k].control", items = "command")]
    pub sun_offset_command: Real,
    /// Rotation angle in effect, about the panel's axis from its zero position; whole turns are counted along the flight, so that it
    /// does not wrap.
    #[output(unit = "rad", display = "deg")]
    pub angle_actual: Real,
    /// Angle between the panel's normal and the Sun direction at which it stands; 0 while the Sun's place is not known, as panel.suns.
    #[output(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI)]
    pub sun_offset_actual: Real,
    /// Whether that is the angle that panel control asks for; near the panel's axis the Sun leaves no such angle about it. True of a
    /// panel by angle.
    #[output]
    pub sun_offset_reached: Boolean,
    /// Light on the cells, in suns: the cosine of the angle between their normal and the Sun, 0 where they look away, over the square
    /// of the distance in AU; shadows do not count.
    #[output(unit = "1", min = 0.0, nominal = 1.0)]
    pub suns: Real,
    /// How far that light is inside articulation.minimumSuns and maximumSuns, the nearer of both; negative outside.
    #[output(unit = "1", nominal = 1.0)]
    pub corridor_margin: Real,
}

/// Corridor of light on the cells of the panels, in suns: 1 is full sunlight across the cells at 1 AU.
#[derive(Variables)]
pub struct ArticulationVariables {
    /// Least light on the cells, for power.
    #[parameter(unit = "1", min = 0.0, max = 1e12, start = setup.spacecraft.articulation.min_suns)]
    pub minimum_suns: Real,
    /// Greatest light on the cells, for their temperature.
    #[parameter(unit = "1", min = 0.0, max = 1e12, start = setup.spacecraft.articulation.max_suns)]
    pub maximum_suns: Real,
    /// Light that panels with panel control distance keep on their cells; where not even full sunlight is so much they face the Sun.
    #[parameter(unit = "1", min = 0.0, max = 1e12, start = setup.spacecraft.articulation.target_suns)]
    pub target_suns: Real,
}

impl ArticulationVariables {
    /// The corridor.
    ///
    /// # Errors
    /// A greatest light that is not above the least.
    pub fn read(&self, values: &Values) -> Result<Articulation, Failure> {
        let [min_suns, max_suns, target_suns] =
            [self.minimum_suns, self.maximum_suns, self.target_suns].map(|suns| values.real(suns));
        if max_suns > min_suns {
            return Ok(Articulation { min_suns, max_suns, target_suns });
        }
        Err(Failure::new(format!(
            "articulation.maximumSuns: found {max_suns:?}, allowed: more than articulation.minimumSuns, {min_suns:?}"
        )))
    }
}

/// One reaction wheel. In guided and commanded flight the wheels hold the system momentum less the body's own; there friction
/// and torque play no part.
#[derive(Variables)]
pub struct WheelVariables {
    /// Greatest spin momentum the wheel can hold.
    #[parameter(unit = "N.m.s", min = 0.0, max = 1e12, start = setup.spacecraft.wheels[index].capacity_n_m_s)]
    pub capacity: Real,
    /// Spin axis in the body frame, of any length; positive speed is right-handed about it.
    #[parameter(unit = "1", min = -1e6, max = 1e6, start = setup.spacecraft.wheels[index].axis_body.into())]
    pub axis: RealVector<3>,
    /// Moment of inertia of the rotor about its axis.
    #[parameter(unit = "kg.m2", min = 1e-12, max = 1e12, start = setup.spacecraft.wheels[index].inertia_kg_m2)]
    pub inertia: Real,
    /// Greatest torque of the motor.
    #[parameter(unit = "N.m", min = 0.0, max = 1e12, start = setup.spacecraft.wheels[index].max_torque_n_m)]
    pub max_torque: Real,
    /// Coulomb friction.
    #[parameter(unit = "N.m", min = 0.0, max = 1e12, start = setup.spacecraft.wheels[index].coulomb_friction_n_m)]
    pub coulomb_friction: Real,
    /// Viscous friction, in N m per rad/s.
    #[parameter(unit = "N.m.s", min = 0.0, max = 1e12, start = setup.spacecraft.wheels[index].viscous_friction_n_m_s)]
    pub viscous_friction: Real,
    /// Static imbalance of the rotor: the force U W^2 turns with it, in controlled and free flight.
    #[parameter(unit = "kg.m", display = "g.cm", min = 0.0, max = 1e6, start = setup.spacecraft.wheels[index].static_imbalance_kg_m)]
    pub static_imbalance: Real,
    /// Place of the rotor in the body frame, on which the torque by its imbalance depends.
    #[parameter(unit = "m", display = "cm", min = -1e4, max = 1e4, start = setup.spacecraft.wheels[index].position_body_m.into())]
    pub position: RealVector<3>,
    /// Whether the rotor is fixed to the body.
    #[parameter(start = false)]
    pub locked: Boolean,
    /// Spin momentum about which the wheel works, up to its capacity either way; their sum is momentum.bias.
    #[parameter(unit = "N.m.s", min = -1e12, max = 1e12, start = setup.spacecraft.wheels[index].bias_n_m_s)]
    pub bias_momentum: Real,
    /// Spin momentum at the start, relative to the body, in controlled and free flight; by default biasMomentum.
    #[parameter(unit = "N.m.s", min = -1e12, max = 1e12, start = setup.spacecraft.wheels[index].bias_n_m_s)]
    pub start_momentum: Real,
    /// Torque of the motor on the rotor along the axis in free flight, held over the step; limited to maxTorque.
    #[input(unit = "N.m", start = 0.0)]
    #[read_where(option = "attitude.source", items = "free")]
    pub torque_command: Real,
    /// Whether the motor gives no torque, in controlled and free flight; friction stays.
    #[input(start = false)]
    pub failed: Boolean,
    /// Spin momentum about the wheel's axis relative to the body; in guided and commanded flight its
    /// bias and its share by least norm of what lies along the wheels' axes beside all biases.
    #[output(unit = "N.m.s", nominal = 1.0)]
    #[annotation(limited_by = "wheel[k].capacity")]
    pub momentum: Real,
    /// Speed of the rotor relative to the body.
    #[output(unit = "rad/s", display = "rpm", nominal = 100.0)]
    pub speed: Real,
    /// Torque of the motor on the rotor that acts, after failure, limit and the stop at capacity; in guided and commanded flight
    /// that with which the wheel follows ideally, without friction.
    #[output(unit = "N.m", nominal = 1e-3)]
    pub torque: Real,
    /// Mechanical power of the motor, torque times speed; negative where it brakes.
    #[output(unit = "W", nominal = 1.0)]
    pub power: Real,
    /// Whether the wheel is at its capacity, in guided and commanded flight whether it would have to hold more.
    #[output]
    pub saturated: Boolean,
}

/// Sun keep-in zone: of guided attitudes azimuth and elevation about -Y, of the timeline's scenarios all of it.
#[derive(Variables)]
pub struct KeepInVariables {
    /// Whether commands keep the Sun inside the zone: scenarios of the timeline, which can switch and resize it, and the rules lvlh to
    /// aligned of guided.scienceRule. Guided flight by the others always does.
    #[parameter(start = setup.spacecraft.sun_keep_in.is_some())]
    pub enabled: Boolean,
    /// Centre of the zone, body frame, of any length: the zone's frame is the body's, turned by the smallest rotation that takes -Y
    /// to it. For scenarios of the timeline and the rules lvlh to aligned.
    #[parameter(unit = "1", start = [0.0, -1.0, 0.0])]
    pub axis: RealVector<3>,
    /// Greatest distance from the Sun at which the zone counts; likewise.
    #[parameter(unit = "m", display = "AU", min = 0.0, max = SunKeepIn::FARTHEST_M, start = setup.keep_in().distance_m)]
    pub distance: Real,
    /// Where a Sun outside is put; likewise.
    #[parameter(start = KeepInMethod(keep_in::KeepInMethod::Nearest))]
    pub method: Choice<KeepInMethod>,
    /// Largest Sun azimuth either way.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, start = setup.keep_in().azimuth_rad)]
    pub azimuth: Real,
    /// Largest Sun elevation either way; guided attitudes stay within.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::FRAC_PI_2, start = setup.keep_in().elevation_rad)]
    pub elevation: Real,
    /// How far inside the zone the Sun stands; negative outside.
    #[output(unit = "rad", display = "deg")]
    pub margin: Real,
}
