//! The shape of wheels, tanks, thrusters, sensors, instruments and antennas in a spacecraft file.

use crate::spacecraft::sun_sensors::HALF_FIELD_OF_VIEW_DEG;
use crate::spacecraft::tank::HYDRAZINE_KG_M3;
use crate::toml::{
    FieldOfView, Finite, Fraction, HalfTurn, HalfTurnEither, NotNegative, Point, Positive, QuarterTurn,
    SpecificImpulse, TurnEither, UnitVector, tables,
};

tables! {
/// A reaction wheel.
struct WheelDescription called "wheel" {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Unit vector of the spin axis, body frame.
    axis as axis_body: UnitVector,
    /// Greatest momentum of the rotor, in N m s.
    capacity_n_m_s: Positive,
    /// Momentum about which the wheel works, along its axis, in N m s; up to its capacity either way.
    bias_momentum_n_m_s: Finite = 0.0,
    /// Moment of inertia of the rotor about its axis, in kg m2; left out, that which reaches the capacity at 6000 rpm.
    inertia_kg_m2: Option<Positive>,
    /// Greatest torque of the motor, in N m; left out, that which reaches the capacity from rest in 100 s.
    max_torque_n_m: Option<Positive>,
    /// Coulomb friction, in N m.
    coulomb_friction_n_m: NotNegative = 0.0,
    /// Viscous friction, in N m per rad/s.
    viscous_friction_n_m_s: NotNegative = 0.0,
    /// Static imbalance of the rotor, in kg m.
    static_imbalance_kg_m: NotNegative = 0.0,
    /// Place of the rotor, body frame, in m.
    position_m as position_body_m: Option<Point>,
} rules {
    RequiresIfPositive static_imbalance_kg_m => position_m: "no position_m beside it", "with the rotor's place, position_m";
}

/// A propellant tank.
struct TankDescription called "tank" {
    /// Name for thrusters and messages; numbered unless given.
    name: Option<String>,
    /// Position of its propellant, taken as a point, body frame, in m.
    position_m as position_body_m: Point,
    /// Propellant loaded, in kg; a part of mass_properties.mass_kg.
    propellant_kg: Positive,
    /// Pressure when loaded, in Pa. Only its ratio counts; the default is assumed.
    pressure_pa: Positive = 2e6,
    /// Least and greatest pressure at which thrusters may be fed, in Pa; any unless given.
    allowed_pressure_pa: Option<[f64; 2]>,
    /// Volume of the gas that drives the propellant out, in m3: the pressure falls as it expands (blowdown). Left out, the
    /// pressure is regulated.
    ullage_m3: Option<Positive>,
    /// Density of the propellant in blowdown, in kg/m3; the default is hydrazine's.
    density_kg_m3: Positive = HYDRAZINE_KG_M3,
} rules {
    Requires density_kg_m3 => ullage_m3: "no ullage_m3 beside it", "with ullage_m3 alone (blowdown)";
}

/// A thruster.
struct ThrusterDescription called "thruster" {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Position, body frame, in m.
    position_m as position_body_m: Point,
    /// Unit vector of its force on the spacecraft, body frame; the plume goes the other way.
    direction as direction_body: UnitVector,
    /// Full thrust, in N.
    force_n: Positive,
    /// Pressure at which it has that thrust, in Pa; its tank's when loaded unless given. Thrust and flow are proportional to
    /// the pressure.
    at_pressure_pa: Option<Positive>,
    /// Specific impulse, in s.
    specific_impulse_s: SpecificImpulse,
    /// Name of the tank that feeds it; the first unless given.
    tank: Option<String>,
    /// Name of the set whose delta-v it takes part in: letters and digits, the first a letter; none unless given.
    set: Option<String>,
    /// Whether it may control the attitude and dump momentum; a main engine does not.
    attitude_control: bool = true,
    /// Shortest time for which its valve opens, in s.
    min_on_time_s: NotNegative = 0.0,
    /// Time over which the thrust rises linearly, in s.
    rise_time_s: NotNegative = 0.0,
    /// Time over which the full thrust falls linearly to nothing, in s.
    tail_off_time_s: NotNegative = 0.0,
    /// Standard deviation of the thrust from pulse to pulse, as a share of it.
    scatter: Fraction = 0.0,
    /// Electric power while it fires, in W, for `heliotorque size`.
    power_w: Option<NotNegative>,
    /// Half angle of the plume, in deg: surfaces within it are flagged while it fires; 0 is none.
    plume_half_angle_deg as plume_half_angle_rad: QuarterTurn = 0.0,
}

/// A Sun sensor.
struct SunSensorDescription called "sun sensor" {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Unit vector of its axis, body frame.
    axis as axis_body: UnitVector,
    /// Half the field of view, from the axis, in deg.
    half_field_of_view_deg as half_field_of_view_rad: HalfTurn = HALF_FIELD_OF_VIEW_DEG,
}

/// An instrument.
struct InstrumentDescription called "instrument" {
    /// Name for messages and the manual.
    name: String,
    /// Unit vector of its boresight, body frame; on a gimbal at angle 0.
    boresight as boresight_body: UnitVector,
    gimbal: Option<GimbalDescription>,
}

/// A gimbal that turns an instrument about one axis: at most one instrument has one.
struct GimbalDescription {
    /// Unit vector of its axis, body frame, perpendicular to the boresight; angles count right-handed about it.
    axis as axis_body: UnitVector,
    /// Least angle, in deg.
    minimum_deg as minimum_rad: HalfTurnEither,
    /// Greatest angle, in deg.
    maximum_deg as maximum_rad: HalfTurnEither,
}

/// An antenna: a fan steered in the XY plane (`azimuth_deg`) or fixed along an axis (`axis`).
struct AntennaDescription called "antenna" {
    /// Its item of `antenna.select`: letters and digits, the first a letter.
    name: String,
    /// From and to which azimuth a fan is steered, in deg, from -Y toward +X: up to 180 deg apart, or 360.
    azimuth_deg: Option<[TurnEither; 2]>,
    /// Unit vector along which a fixed antenna looks, body frame: it is turned to the Earth, -Y as near to the Sun as that allows.
    axis as axis_body: Option<UnitVector>,
    /// Full widths of the beam, in deg: across the XY plane and along it (of an axis along Z along X).
    beam_deg as beam_rad: [FieldOfView; 2],
} rules {
    Excludes axis => azimuth_deg: "an axis beside `azimuth_deg`", "one of both: a fan has `azimuth_deg`, a fixed antenna `axis`";
    AnyOf azimuth_deg axis: "neither `azimuth_deg` nor `axis`",
        "`azimuth_deg = [from, to]` of a fan in the XY plane, or `axis` of a fixed antenna";
}
}
