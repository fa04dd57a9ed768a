//! The spinner's variables at its public face.

use core::f64::consts::PI;

use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Text, Variables};
use physics::spin::spinner::{Spinner, Thruster};

use super::choices::{BurnPlan, BurnTiming, GeometrySource, MassSource, StarSampling};

const RPM_RAD_S: f64 = PI / 30.0;
const DEG_RAD: f64 = PI / 180.0;

/// Every variable of the spinner, in the order of the XML.
#[derive(Variables)]
#[variables(setup = Spinner)]
pub struct SpinVariables {
    /// Principal moments of inertia about the centre of mass; the third axis is the spin axis.
    #[parameter(unit = "kg.m2", start = initial_inertia(setup))]
    pub inertia: RealVector<3>,
    #[group(name = "inertia")]
    pub inertia_now: InertiaVariables,
    #[group]
    pub mass_properties: MassVariables,
    #[group]
    pub propellant: PropellantVariables,
    #[group]
    pub spin: SpinRateVariables,
    #[group]
    pub initial: InitialVariables,
    #[group]
    pub damper: DamperVariables,
    #[group]
    pub burn: BurnVariables,
    #[group]
    pub pulse: PulseVariables,
    #[group(count = setup.thrusters.len(), setup = &setup.thrusters[index])]
    pub thruster: Vec<ThrusterVariables>,
    #[group]
    pub torque: TorqueVariables,
    #[group]
    pub force: ForceVariables,
    #[group]
    pub geometry: GeometryVariables,
    #[group]
    pub sun: SunVariables,
    #[group]
    pub earth: EarthVariables,
    #[group]
    pub star: StarVariables,
    #[group]
    pub limit: LimitVariables,
    #[group]
    pub attitude: AttitudeVariables,
    #[group]
    pub nutation: NutationVariables,
    #[group]
    pub momentum: MomentumVariables,
    #[group]
    pub spin_axis: SpinAxisVariables,
    #[group]
    pub sun_sensor: SunSensorVariables,
    #[group]
    pub star_tracker: StarTrackerVariables,
    /// Velocity change by the thrusters since the start, in EME2000.
    #[output(unit = "m/s", display = "mm/s", nominal = 1e-2)]
    pub delta_v: RealVector<3>,
    /// Spacecraft mass with the propellant left.
    #[output(unit = "kg", nominal = 1e3)]
    pub mass: Real,
    /// Kinetic energy of rotation.
    #[output(unit = "N.m", nominal = 50.0)]
    pub energy: Real,
    /// Seed of all sensor noise; the same seed gives the same draws.
    #[parameter(start = 1)]
    pub seed: Integer,
}

/// The moments in force at the start: the setup's table at the initial propellant.
fn initial_inertia(setup: &Spinner) -> [f64; 3] {
    let mass = &setup.mass_properties;
    mass.inertia(mass.initial_propellant_kg).map_or([1.0; 3], |inertia| inertia.principal_kg_m2())
}

/// Inertia as it is.
#[derive(Variables)]
pub struct InertiaVariables {
    /// I3/IT with IT = sqrt(I1 I2), paper 002 eq 11.
    #[output(unit = "1", nominal = 1.0)]
    pub ratio: Real,
    /// Principal moments now; they follow the propellant if massProperties.source says so.
    #[output(unit = "kg.m2", nominal = 300.0)]
    pub current: RealVector<3>,
}

/// Mass properties.
#[derive(Variables)]
pub struct MassVariables {
    /// Where the moments of inertia come from.
    #[parameter(start = MassSource::Fixed)]
    pub source: Choice<MassSource>,
}

/// Propellant.
#[derive(Variables)]
#[variables(setup = Spinner)]
pub struct PropellantVariables {
    /// On board at the start.
    #[parameter(unit = "kg", min = 0.0, start = setup.mass_properties.initial_propellant_kg)]
    pub initial: Real,
    /// Used since the start.
    #[output(unit = "kg", nominal = 0.01)]
    pub used: Real,
    /// Left on board.
    #[output(unit = "kg", nominal = 100.0)]
    pub left: Real,
}

/// Spin about the third axis.
#[derive(Variables)]
#[variables(setup = Spinner)]
pub struct SpinRateVariables {
    /// Rate about the third axis at the start.
    #[parameter(unit = "rad/s", display = "rpm", min = 0.0, start = setup.limits.spin_rate_rpm * RPM_RAD_S)]
    pub initial_rate: Real,
    /// Rate about the third axis.
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

/// Where the flight starts.
#[derive(Variables)]
pub struct InitialVariables {
    /// Attitude quaternion at the start, scalar last, from EME2000 to body.
    #[parameter(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub q: RealVector<4>,
    /// Angle between momentum and spin axis at the start.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = 1.5, start = 0.0)]
    pub nutation: Real,
    /// Azimuth of the transverse momentum at the start, from body X toward Y.
    #[parameter(unit = "rad", display = "deg", start = 0.0)]
    pub nutation_phase: Real,
}

/// The passive nutation damper.
#[derive(Variables)]
#[variables(setup = Spinner)]
pub struct DamperVariables {
    /// Time in which the nutation angle falls to 1/e about the axis of greatest inertia, and grows by e about another; 0
    /// = no damper. It conserves angular momentum.
    #[parameter(unit = "s", display = "h", min = 0.0, start = setup.damper_time_constant_s)]
    pub time_constant: Real,
}

/// The burn the spacecraft flies by itself.
#[derive(Variables)]
pub struct BurnVariables {
    /// Shape of the train of pulses.
    #[parameter(start = BurnPlan::Uniform)]
    pub plan: Choice<BurnPlan>,
    /// What pulses are timed by.
    #[parameter(start = BurnTiming::Clock)]
    pub timing: Choice<BurnTiming>,
    /// No pulse begins before this time.
    #[parameter(unit = "s", start = 0.0)]
    pub start: Real,
    /// Number of the thruster, from 1 in the order of the setup; 8 is ACE's IIIR.
    #[parameter(start = 8)]
    pub thruster: Integer,
    /// Number of the thruster that fires on odd half turns, opposite to the first; 0 = none.
    #[parameter(start = 10)]
    pub opposite_thruster: Integer,
    /// Name of a group or thruster of the setup to fire instead of the numbers; empty = use the numbers.
    #[parameter(start = "")]
    pub group: Text,
    /// Width of a pulse; of the first and last for the tapered plan.
    #[parameter(unit = "s", display = "ms", min = 0.0, start = 0.032)]
    pub pulse_width: Real,
    /// Turns from pulse to pulse: 0.5, 1, 1.5 and so on; half turns alternate the two thrusters.
    #[parameter(unit = "1", start = 1.0)]
    pub turns_per_pulse: Real,
    /// Number of pulses, used where burn.angle is 0.
    #[parameter(start = 114)]
    pub count: Integer,
    /// How far the momentum shall move; 0 = by burn.count.
    #[parameter(unit = "rad", display = "deg", min = 0.0, start = 0.0)]
    pub angle: Real,
    /// Order of the taper: 1 is 1 2 2 ... 2 1, 2 is 1 3 4 ... 4 3 1.
    #[parameter(min = 1, max = 6, start = 1)]
    pub taper_order: Integer,
    /// Direction in EME2000 toward which the momentum moves; only its part across the momentum counts.
    #[parameter(unit = "1", start = [1.0, 0.0, 0.0])]
    pub target_direction: RealVector<3>,
    /// (assumed - true) / true spin rate: what clock and Sun-crossing delays are computed with.
    #[parameter(unit = "1", display = "%", min = -0.5, max = 0.5, start = 0.0)]
    pub spin_rate_error: Real,
    /// Half width of the range of inertia ratios over which burn.maxNutation shall hold.
    #[parameter(unit = "1", min = 0.0, start = 0.0)]
    pub ratio_uncertainty: Real,
    /// Refuse a plan whose nutation would exceed this at any time; 0 = no limit.
    #[parameter(unit = "rad", display = "deg", min = 0.0, start = 0.0)]
    pub max_nutation: Real,
    /// Refuse a plan that takes longer; 0 = no limit.
    #[parameter(unit = "s", display = "min", min = 0.0, start = 0.0)]
    pub max_duration: Real,
    /// Pulses that ended.
    #[output]
    pub pulses_fired: Integer,
    /// Whether the burn runs: from the first edge of its first pulse to the last edge of its last.
    #[output]
    pub active: Boolean,
    /// Whether its last pulse ended.
    #[output]
    pub done: Boolean,
    /// Next edge of the burn; -1 without one.
    #[output(discrete, unit = "s")]
    pub next_edge: Real,
    /// Pulses of the plan.
    #[calculated_parameter]
    pub planned_count: Integer,
    /// From the plan's first edge to its last.
    #[calculated_parameter(unit = "s", display = "min")]
    pub planned_duration: Real,
    /// How far the plan moves the momentum: the sum of paper 002 eq 3.
    #[calculated_parameter(unit = "rad", display = "deg")]
    pub planned_angle: Real,
    /// How far its widest pulse moves the momentum, eq 3.
    #[calculated_parameter(unit = "rad", display = "deg")]
    pub pulse_angle: Real,
}

/// Pulses commanded from outside.
#[derive(Variables)]
#[variables(setup = Spinner)]
pub struct PulseVariables {
    /// Step to which thruster[k].onDelay and onTime are rounded, and the widths of a taper; 0 = not rounded.
    #[parameter(unit = "s", display = "ms", min = 0.0, start = setup.resolution_s)]
    pub resolution: Real,
}

/// One thruster.
#[derive(Variables)]
#[variables(setup = Thruster)]
pub struct ThrusterVariables {
    /// From the start of each step to the pulse.
    #[input(unit = "s", display = "ms", min = 0.0, start = 0.0)]
    pub on_delay: Real,
    /// Length of a pulse in each step; 0 = none. A pulse that reaches beyond the step is cut there.
    #[input(unit = "s", display = "ms", min = 0.0, start = 0.0)]
    pub on_time: Real,
    /// Fires over the whole step.
    #[input(start = false)]
    pub fire: Boolean,
    /// Whether it is on.
    #[output]
    pub active: Boolean,
    /// Moment arm across the spin axis, paper 002 Table 1.
    #[output(constant, unit = "m", start = setup.torque_body_n_m.xy().norm() / setup.force_body_n.norm())]
    pub arm: Real,
    /// Name in the setup.
    #[output(constant, start = setup.name.as_str())]
    pub name: Text,
}

/// Torques on the body.
#[derive(Variables)]
pub struct TorqueVariables {
    /// Outside torque, body frame.
    #[input(unit = "N.m", display = "uN.m", start = [0.0; 3])]
    pub external: RealVector<3>,
    /// Of the thrusters that are on, body frame.
    #[output(discrete, unit = "N.m", nominal = 1.0)]
    pub thruster: RealVector<3>,
}

/// Forces on the body.
#[derive(Variables)]
pub struct ForceVariables {
    /// Of the thrusters that are on, body frame.
    #[output(discrete, unit = "N", nominal = 1.0)]
    pub thruster: RealVector<3>,
}

/// Where Sun and Earth stand.
#[derive(Variables)]
#[variables(setup = Spinner)]
pub struct GeometryVariables {
    /// Where the directions of Sun and Earth come from.
    #[parameter(start = GeometrySource::Inputs)]
    pub source: Choice<GeometrySource>,
    /// Rate at which the Earth-Sun line turns in the ecliptic, on the L1 orbit.
    #[parameter(unit = "rad/s", display = "deg/s", start = setup.l1_orbit.line_rate_rad_s())]
    pub line_rate: Real,
    /// Lissajous amplitudes: along the Earth-Sun line, across it in the ecliptic, out of the ecliptic.
    #[parameter(unit = "m", display = "km", start = setup.l1_orbit.amplitude_m)]
    pub amplitude: RealVector<3>,
    /// Ecliptic longitude of the Earth seen from the Sun at time 0, on the L1 orbit.
    #[parameter(unit = "rad", display = "deg", start = 0.0)]
    pub longitude: Real,
    /// In-plane phase of the Lissajous motion at time 0.
    #[parameter(unit = "rad", display = "deg", start = 0.0)]
    pub in_plane_phase: Real,
    /// Out-of-plane phase of the Lissajous motion at time 0.
    #[parameter(unit = "rad", display = "deg", start = 0.0)]
    pub out_of_plane_phase: Real,
}

/// The Sun.
#[derive(Variables)]
pub struct SunVariables {
    /// Direction of the Sun in EME2000, of any length; 0 = no Sun.
    #[input(unit = "1", start = [(10.0 * DEG_RAD).sin(), 0.0, (10.0 * DEG_RAD).cos()])]
    pub direction: RealVector<3>,
    /// From the spin axis +Z to the Sun.
    #[output(unit = "rad", display = "deg", nominal = 0.1)]
    pub angle: Real,
    /// Direction of the Sun that is in force, unit vector in EME2000.
    #[output(unit = "1", nominal = 1.0)]
    pub inertial: RealVector<3>,
}

/// The Earth.
#[derive(Variables)]
pub struct EarthVariables {
    /// Direction of the Earth in EME2000, of any length; 0 = no Earth.
    #[input(unit = "1", start = [0.0, 0.0, -1.0])]
    pub direction: RealVector<3>,
    /// From the antenna -Z to the Earth.
    #[output(unit = "rad", display = "deg", nominal = 0.01)]
    pub angle: Real,
    /// Direction of the Earth that is in force, unit vector in EME2000.
    #[output(unit = "1", nominal = 1.0)]
    pub inertial: RealVector<3>,
}

/// The star that the tracker follows.
#[derive(Variables)]
pub struct StarVariables {
    /// Direction of the star in EME2000, of any length; 0 = no star.
    #[input(unit = "1", start = [0.3, 0.95, 0.02])]
    pub direction: RealVector<3>,
}

/// Mission limits and whether they are violated.
#[derive(Variables)]
#[variables(setup = Spinner)]
pub struct LimitVariables {
    /// Greatest Sun angle.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, start = setup.limits.sun_angle_deg * DEG_RAD)]
    pub sun_angle: Real,
    /// Greatest Earth angle.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, start = setup.limits.earth_angle_deg * DEG_RAD)]
    pub earth_angle: Real,
    /// Nominal spin rate; at the start it also sets the star tracker's clock.
    #[parameter(tunable, unit = "rad/s", display = "rpm", min = 0.0, start = setup.limits.spin_rate_rpm * RPM_RAD_S)]
    pub spin_rate: Real,
    /// Allowed either side of the nominal spin rate.
    #[parameter(
        tunable,
        unit = "rad/s",
        display = "rpm",
        min = 0.0,
        start = setup.limits.spin_rate_tolerance_rpm * RPM_RAD_S
    )]
    pub spin_rate_tolerance: Real,
    /// Greatest variation of the spin period, eq 1.
    #[parameter(tunable, unit = "s", display = "ms", min = 0.0, start = setup.limits.period_variation_s)]
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

/// Attitude.
#[derive(Variables)]
pub struct AttitudeVariables {
    /// Attitude quaternion, scalar last, from EME2000 to the body frame; continuous, so its sign follows the turns.
    #[output(unit = "1", nominal = 1.0)]
    pub q: RealVector<4>,
    /// Angular rate J^-1 h of the body in EME2000, in body components.
    #[output(unit = "rad/s", display = "deg/s", nominal = 1e-2)]
    pub rate: RealVector<3>,
}

/// Nutation: as it is and as theory foresees it.
#[derive(Variables)]
pub struct NutationVariables {
    /// Angle from the momentum to the spin axis.
    #[output(unit = "rad", display = "deg", nominal = 1e-4)]
    pub angle: Real,
    /// Azimuth of the transverse momentum in the body, from X toward Y.
    #[output(unit = "rad", display = "deg", nominal = 1.0)]
    pub phase: Real,
    /// Foreseen after the last pulse by the linear theory (paper 002 eq 8 with the nutation kick for Gamma/n, for any
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
    /// Paper 002 eq 9 (half turns) or eq 10 as printed, for comparison; both are wrong.
    #[calculated_parameter(unit = "rad", display = "deg")]
    pub envelope_printed: Real,
}

/// Angular momentum.
#[derive(Variables)]
pub struct MomentumVariables {
    /// In EME2000.
    #[output(unit = "N.m.s", nominal = 100.0)]
    pub inertial: RealVector<3>,
    /// In the body frame.
    #[output(unit = "N.m.s", nominal = 100.0)]
    pub body: RealVector<3>,
    /// Angle from where it pointed at the start: the manoeuvre done.
    #[output(unit = "rad", display = "deg", nominal = 1e-2)]
    pub displacement: Real,
}

/// The spin axis +Z.
#[derive(Variables)]
pub struct SpinAxisVariables {
    /// Unit vector in EME2000.
    #[output(unit = "1", nominal = 1.0)]
    pub inertial: RealVector<3>,
    /// Angle from where it pointed at the start.
    #[output(unit = "rad", display = "deg", nominal = 1e-2)]
    pub displacement: Real,
}

/// The Sun sensor.
#[derive(Variables)]
pub struct SunSensorVariables {
    /// Sun angle measured at the last crossing, with noise; 0 before any.
    #[output(discrete, unit = "rad", display = "deg", nominal = 0.1)]
    pub angle: Real,
}

/// The star tracker.
#[derive(Variables)]
pub struct StarTrackerVariables {
    /// When it samples the star.
    #[parameter(start = StarSampling::Spins)]
    pub sampling: Choice<StarSampling>,
    /// Declination of the star at the last sample, with noise; 0 before any.
    #[output(discrete, unit = "rad", display = "deg", nominal = 1e-2)]
    pub declination: Real,
    /// Declination of the star now, without noise.
    #[output(unit = "rad", display = "deg", nominal = 1e-2)]
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
    /// The same by paper 002 eq 20.
    #[calculated_parameter(unit = "s", display = "min")]
    pub observation_time_eq20: Real,
}
