//! Burns of a body that turns, in free flight about the Earth, against an integration of position, attitude and propellant from
//! first principles by Runge and Kutta's rule of fourth order.

use client::short_or_long;
use models::MomentumPlant;
use nalgebra::{Matrix3, Quaternion, SVector, UnitQuaternion, Vector3};

use super::super::named_model::{NamedModel, assert_cuts_change_nothing};
use super::super::spacecraft::{EXHAUST_M_S, SIMPLE, couples, thruster};
use super::{DARK, FREE, PlantInstance, Start, initialize, to_inertial};

const MU_M3_S2: f64 = 3.986_004_355_07e14;
const J2: f64 = 1.082_635_9e-3;
const J2_RADIUS_M: f64 = 6.378_136_3e6;
const MASS_KG: f64 = 400.0;

/// A body with one engine and one tank, both anywhere, and couples of small thrusters.
#[derive(Clone, Copy)]
struct Spacecraft {
    inertia_kg_m2: [f64; 3],
    nozzle_m: [f64; 3],
    force_n: [f64; 3],
    tank_m: [f64; 3],
}

impl Spacecraft {
    fn model(&self) -> NamedModel<MomentumPlant> {
        let [a, b, c] = self.inertia_kg_m2;
        let force = Vector3::from(self.force_n);
        let direction: [f64; 3] = force.normalize().into();
        let text = SIMPLE
            .replace("mass_kg = 500.0", &format!("mass_kg = {MASS_KG:?}"))
            .replace(
                "[[200.0, 0.0, 0.0], [0.0, 300.0, 0.0], [0.0, 0.0, 400.0]]",
                &format!("[[{a:?}, 0.0, 0.0], [0.0, {b:?}, 0.0], [0.0, 0.0, {c:?}]]"),
            )
            .replace(
                "position_m = [0.0, 0.0, 0.0]\npropellant_kg = 50.0",
                &format!("position_m = {:?}\npropellant_kg = 150.0", self.tank_m),
            );
        let engine =
            thruster(self.nozzle_m, direction, force.norm(), "set = \"lva\"\nattitude_control = false");
        let text = format!("{text}{engine}{}", couples(""));
        NamedModel::<MomentumPlant>::with("burns.toml", &text)
    }

    fn flow_kg_s(&self) -> f64 {
        Vector3::from(self.force_n).norm() / EXHAUST_M_S
    }

    /// Centre of mass and inertia about it with so much of the propellant gone from its tank.
    fn left(&self, used_kg: f64) -> (Vector3<f64>, Matrix3<f64>) {
        let tank = Vector3::from(self.tank_m);
        let mass = MASS_KG - used_kg;
        let center = tank * (-used_kg / mass);
        let squared = |r: Vector3<f64>| -r.cross_matrix() * r.cross_matrix();
        let loaded = Matrix3::from_diagonal(&Vector3::from(self.inertia_kg_m2));
        (center, loaded - squared(tank) * used_kg - squared(center) * mass)
    }
}

/// Position, velocity, body to inertial, J w in the body, propellant used.
type State = SVector<f64, 14>;

fn gravity_m_s2(r: Vector3<f64>) -> Vector3<f64> {
    let (d, k) = (r.norm(), 1.5 * J2 * MU_M3_S2 * J2_RADIUS_M * J2_RADIUS_M);
    let z = 5.0 * r.z * r.z / (d * d);
    let flattening = Vector3::new(r.x * (z - 1.0), r.y * (z - 1.0), r.z * (z - 3.0)) * (k / d.powi(5));
    flattening - r * (MU_M3_S2 / d.powi(3))
}

fn rates(spacecraft: &Spacecraft, y: &State, burns: bool) -> State {
    let part = |i: usize| Vector3::new(y[i], y[i + 1], y[i + 2]);
    let (position, velocity, momentum, used_kg) = (part(0), part(3), part(10), y[13]);
    let attitude = Quaternion::new(y[9], y[6], y[7], y[8]);
    let (center, inertia) = spacecraft.left(used_kg);
    let rate = inertia.try_inverse().unwrap() * momentum;
    let (mut acceleration, mut torque, mut flow) = (gravity_m_s2(position), Vector3::zeros(), 0.0);
    if burns {
        let force = Vector3::from(spacecraft.force_n);
        let arm = Vector3::from(spacecraft.nozzle_m) - center;
        flow = spacecraft.flow_kg_s();
        acceleration += UnitQuaternion::from_quaternion(attitude) * force / (MASS_KG - used_kg);
        torque = arm.cross(&force) - arm.cross(&rate.cross(&arm)) * flow;
    }
    let turn = attitude * Quaternion::from_imag(rate) * 0.5;
    let momentum_rate = torque - rate.cross(&momentum);
    let mut out = State::zeros();
    for (i, part) in [velocity, acceleration, turn.imag()].into_iter().enumerate() {
        out.fixed_rows_mut::<3>(3 * i).copy_from(&part);
    }
    out[9] = turn.scalar();
    out.fixed_rows_mut::<3>(10).copy_from(&momentum_rate);
    out[13] = flow;
    out
}

/// From `start` over `span_s` in steps of at most `step_s`.
fn integrated(spacecraft: &Spacecraft, start: State, span_s: f64, step_s: f64, burns: bool) -> State {
    let count = (span_s / step_s).ceil();
    let h = span_s / count;
    let mut y = start;
    for _ in 0..count as usize {
        let k1 = rates(spacecraft, &y, burns);
        let k2 = rates(spacecraft, &(y + k1 * (0.5 * h)), burns);
        let k3 = rates(spacecraft, &(y + k2 * (0.5 * h)), burns);
        let k4 = rates(spacecraft, &(y + k3 * h), burns);
        y += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
    }
    y
}

/// At 700 km, inclined, turning at `rate`.
fn start(spacecraft: &Spacecraft, rate_rad_s: [f64; 3]) -> State {
    let radius_m = 7_071_008.4_f64;
    let (sin, cos) = 0.9_f64.sin_cos();
    let speed_m_s = (MU_M3_S2 / radius_m).sqrt();
    let momentum = Vector3::from(spacecraft.inertia_kg_m2).component_mul(&Vector3::from(rate_rad_s));
    State::from([
        radius_m,
        0.0,
        0.0,
        0.0,
        speed_m_s * cos,
        speed_m_s * sin,
        0.0,
        0.0,
        0.0,
        1.0,
        momentum.x,
        momentum.y,
        momentum.z,
        0.0,
    ])
}

fn simulated<'a>(
    named: &'a NamedModel<MomentumPlant>,
    at: &State,
    rate_rad_s: [f64; 3],
    more: Start<'_>,
) -> PlantInstance<'a> {
    let place: Vec<(String, f64)> = (0..3)
        .flat_map(|i| {
            [
                (format!("orbit.position[{}]", i + 1), at[i]),
                (format!("orbit.velocity[{}]", i + 1), at[i + 3]),
                (format!("start.rate[{}]", i + 1), rate_rad_s[i]),
                (format!("dump.threshold[{}]", i + 1), 1e9),
            ]
        })
        .collect();
    let place: Vec<(&str, f64)> = place.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let orbit: Start<'_> = &[
        ("orbit.center", 4.0),
        ("orbit.source", 2.0),
        ("orbit.dynamics", 2.0),
        ("orbit.sunTide", 0.0),
        ("orbit.moonTide", 0.0),
        // The pole is fixed, as in the integration.
        ("planet.orientation", 1.0),
    ];
    let mut flight = initialize(named, &[FREE, DARK, orbit, &place, more]);
    flight.set("thrust.request", 1.0);
    flight.set("thrust.command", 1.0);
    flight
}

/// Position in m and velocity in m/s off an integration.
fn off(flight: &PlantInstance<'_>, y: &State) -> [f64; 2] {
    let at = |i: usize| Vector3::new(y[i], y[i + 1], y[i + 2]);
    [(flight.vector("position") - at(0)).norm(), (flight.vector("velocity") - at(3)).norm()]
}

/// Engine and tank at the centre of mass: the body turns about its axis evenly, and the thrust with it.
const CENTRAL: Spacecraft = Spacecraft {
    inertia_kg_m2: [200.0, 300.0, 400.0],
    nozzle_m: [0.0; 3],
    force_n: [0.0, 160.0, 120.0],
    tank_m: [0.0; 3],
};

#[test]
fn a_long_burn_leaves_the_spacecraft_where_continuous_thrust_does() {
    let rate_rad_s = [1e-3, 0.0, 0.0];
    let begin = start(&CENTRAL, rate_rad_s);
    // 565 m/s by 200 N.
    let burn_s = MASS_KG * (1.0 - (-565.0 / EXHAUST_M_S).exp()) / CENTRAL.flow_kg_s();
    let burnt = integrated(&CENTRAL, begin, burn_s, 0.5, true);
    let (turned, mass_kg) = (rate_rad_s[0] * burn_s, MASS_KG - burnt[13]);
    assert!((EXHAUST_M_S * (MASS_KG / mass_kg).ln() - 565.0).abs() < 1e-9 && turned > 0.9);
    let early = integrated(&CENTRAL, begin, 103.7, 0.5, true);
    let end = integrated(&CENTRAL, burnt, 4_000.0, 0.5, false);
    let named = CENTRAL.model();
    let steps = [(10.0, 1e-2), (1.0, 1e-3), (0.1, 1e-3)];
    for (step_s, tolerance_m) in &steps[..short_or_long(2, 3)] {
        let mut flight = simulated(&named, &begin, rate_rad_s, &[("solver.dynamicsStep", *step_s)]);
        flight.set("thrust.stop", burn_s);
        // Within an interval.
        flight.step_to(103.7).unwrap();
        let [early_m, early_m_s] = off(&flight, &early);
        flight.simulate_to(burn_s + 4_000.0, 100.0).unwrap();
        let [end_m, end_m_s] = off(&flight, &end);
        println!(
            "solver.dynamicsStep {step_s}: {early_m:.1e} m and {early_m_s:.1e} m/s after 103.7 s, {end_m:.1e} m and \
             {end_m_s:.1e} m/s 4000 s after the burn"
        );
        assert!(early_m < 1e-4 && early_m_s < 1e-6, "{early_m} {early_m_s}");
        assert!(end_m < *tolerance_m && end_m_s < 1e-5, "{end_m} {end_m_s}");
    }
}

#[test]
fn pulses_within_an_interval_move_the_spacecraft_when_they_are_given() {
    let rate_rad_s = [0.05, 0.0, 0.0];
    let begin = start(&CENTRAL, rate_rad_s);
    let named = CENTRAL.model();
    let mut flight = simulated(&named, &begin, rate_rad_s, &[("solver.dynamicsStep", 10.0)]);
    flight.set("thrust.command", 0.0);
    let (mut y, mut now_s) = (begin, 0.0);
    for k in 0..23 {
        let until_s = 0.7 * f64::from(k + 1);
        let (opens_s, on_s) = (now_s + 0.113, 0.2371);
        flight.set("thruster[1].onDelay", opens_s - now_s);
        flight.set("thruster[1].onTime", on_s);
        flight.step_to(until_s).unwrap();
        y = integrated(&CENTRAL, y, opens_s - now_s, 0.01, false);
        y = integrated(&CENTRAL, y, on_s, 0.01, true);
        y = integrated(&CENTRAL, y, until_s - opens_s - on_s, 0.01, false);
        now_s = until_s;
        let [off_m, off_m_s] = off(&flight, &y);
        assert!(off_m < 1e-6 && off_m_s < 1e-8, "at {now_s} s: {off_m} {off_m_s}");
    }
    assert!(flight.vector("deltaV").norm() > 2.0);
}

#[test]
fn cutting_and_saving_change_no_bit_of_a_thrusting_orbit() {
    let rate_rad_s = [0.03, -0.02, 0.01];
    let spacecraft = Spacecraft { nozzle_m: [0.0, 0.1, -1.0], tank_m: [0.2, -0.1, 0.4], ..CENTRAL };
    let begin = start(&spacecraft, rate_rad_s);
    let named = spacecraft.model();
    let initialize = || {
        let mut flight = simulated(&named, &begin, rate_rad_s, &[("solver.dynamicsStep", 10.0)]);
        flight.set("thrust.stop", 17.321);
        flight
    };
    assert_cuts_change_nothing(initialize, [33.0], &[0.33, 1.7, 10.0], |_| {});
}

/// Momentum, inertial, in N m s.
fn momentum(y: &State) -> Vector3<f64> {
    let attitude = Quaternion::new(y[9], y[6], y[7], y[8]);
    UnitQuaternion::from_quaternion(attitude) * Vector3::new(y[10], y[11], y[12])
}

#[test]
fn a_tank_off_the_axis_moves_the_centre_of_mass_through_a_burn() {
    // Through the centre of mass at first; then the tank of 150 kg drains, 0.3 m beside it.
    let spacecraft = Spacecraft {
        nozzle_m: [0.02, 0.01, -1.1],
        force_n: [0.0, 3.0, 400.0],
        tank_m: [0.3, -0.1, 0.2],
        ..CENTRAL
    };
    let rate_rad_s = [0.02, 0.03, 0.05];
    let begin = start(&spacecraft, rate_rad_s);
    let end = integrated(&spacecraft, begin, 60.0, 0.005, true);
    let after = integrated(&spacecraft, end, 17.5, 0.005, false);
    let gained = momentum(&after) - momentum(&begin);
    assert!(gained.norm() > 10.0);
    let named = spacecraft.model();
    for step_s in [0.1, 1.0, 10.0] {
        let mut flight = simulated(&named, &begin, rate_rad_s, &[("solver.dynamicsStep", step_s)]);
        flight.set("thrust.stop", 60.0);
        flight.simulate_to(60.0, 60.0).unwrap();
        let (center, _) = spacecraft.left(end[13]);
        let off_m = (flight.vector("centerOfMass") - center).norm();
        flight.simulate_to(77.5, 17.5).unwrap();
        let found = flight.vector("momentum.inertial");
        let off = (found - momentum(&after)).norm() / momentum(&after).norm();
        let turned = Quaternion::new(after[9], after[6], after[7], after[8]);
        let off_rad = to_inertial(&flight).angle_to(&UnitQuaternion::from_quaternion(turned));
        let [place_m, speed_m_s] = self::off(&flight, &after);
        println!(
            "solver.dynamicsStep {step_s}: momentum {off:.1e} of itself, attitude {off_rad:.1e} rad, centre of mass {off_m:.1e} m, \
             position {place_m:.1e} m, velocity {speed_m_s:.1e} m/s"
        );
        assert!(off < 1e-9 && off_rad < 1e-7 && off_m < 1e-12, "{off} {off_rad} {off_m}");
        assert!(place_m < 1e-6 && speed_m_s < 1e-8, "{place_m} {speed_m_s}");
    }
}

#[test]
fn the_jet_slows_a_turning_body_as_thomson_says() {
    // Thrust along the axis through nozzle and centre of mass, tank there: no torque, J stays, and across the axis
    // dw/dt = -q l^2 w / J about the two equal axes.
    let spacecraft = Spacecraft {
        inertia_kg_m2: [300.0, 300.0, 400.0],
        nozzle_m: [0.0, 0.0, -1.5],
        force_n: [0.0, 0.0, 400.0],
        tank_m: [0.0; 3],
    };
    let (begin, named) = (start(&spacecraft, [0.2, 0.0, 0.0]), spacecraft.model());
    let time_s = 100.0;
    let ratio = (-spacecraft.flow_kg_s() * 1.5 * 1.5 / 300.0 * time_s).exp();
    assert!(ratio < 0.9);
    for step_s in [0.1, 1.0, 10.0] {
        let mut flight = simulated(&named, &begin, [0.2, 0.0, 0.0], &[("solver.dynamicsStep", step_s)]);
        flight.simulate_to(time_s, 50.0).unwrap();
        let slowed = 0.2 - flight.vector("attitude.rate").norm();
        let off = slowed / (0.2 * (1.0 - ratio)) - 1.0;
        println!("solver.dynamicsStep {step_s}: the rate falls by {slowed:.6} rad/s, {off:.1e} off");
        assert!(off.abs() < 1e-9, "{off}");
    }
    // A tank on the axis away from the centre of mass: inertia and lever change with it.
    let spacecraft = Spacecraft { tank_m: [0.0, 0.0, 0.6], ..spacecraft };
    let (begin, named) = (start(&spacecraft, [0.2, 0.05, 0.1]), spacecraft.model());
    let end = integrated(&spacecraft, begin, time_s, 0.01, true);
    let mut flight = simulated(&named, &begin, [0.2, 0.05, 0.1], &[("solver.dynamicsStep", 10.0)]);
    flight.simulate_to(time_s, 50.0).unwrap();
    let lost = (momentum(&end) - momentum(&begin)).norm();
    let off = (flight.vector("momentum.inertial") - momentum(&end)).norm() / lost;
    println!("with the tank 0.6 m along the axis: {off:.1e} of what is lost");
    assert!(lost > 1.0 && off < 1e-10, "{lost} {off}");
}
