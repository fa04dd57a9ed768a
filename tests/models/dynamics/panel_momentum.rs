//! Panels with a mass that turn: the body gives way. Truth is J w + h = C H, integrated independently, the panels made of
//! point masses.

use core::f64::consts::{PI, TAU};

use models::MomentumPlant;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use physics::numerics::quadrature::Rule;

use super::super::named_model::{NamedModel, assert_cuts_change_nothing};
use super::super::wheel_torque::{self, WHEELS, axial, most_off, torques};
use super::{DARK, FREE, PlantInstance, Start, axes, held_momentum, initialize, to_inertial};

const MASS_KG: f64 = 700.0;
pub(super) const LOCKED: Start<'_> =
    &[("wheel[1].locked", 1.0), ("wheel[2].locked", 1.0), ("wheel[3].locked", 1.0), ("wheel[4].locked", 1.0)];
pub(super) const BY_ANGLE: Start<'_> = &[("panel[1].control", 2.0), ("panel[2].control", 2.0)];
const TUMBLING: Start<'_> = &[("start.rate[1]", 4e-3), ("start.rate[2]", -7e-3), ("start.rate[3]", 5e-3)];

/// The shipped spacecraft with panels of these masses.
pub(super) fn text(panels: [&str; 2]) -> String {
    let shipped = include_str!("../../../fmu-src/resources/messenger.toml");
    let mut parts = shipped.split("[[panels]]");
    let head = parts.next().unwrap();
    let bodies = parts.zip(panels).map(|(body, mass)| format!("[[panels]]\n{mass}\n{body}"));
    format!("{head}{}", bodies.collect::<String>())
}

const PAIR: [&str; 2] = ["mass_kg = 20.0", "mass_kg = 20.0"];
pub(super) const HINGED: [&str; 2] = [
    "mass_kg = 30.0\nmass_center_m = [2.0, 0.3, 0.5]\ninertia_kg_m2 = [[4.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 3.5]]",
    "mass_kg = 12.0\nmass_center_m = [-3.0, -0.2, 0.1]\ninertia_kg_m2 = [[1.0, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 1.2]]",
];

type Points = Vec<(f64, Vector3<f64>)>;

/// Point masses with this mass, centre and diagonal inertia about it.
fn points(mass_kg: f64, center: Vector3<f64>, inertia: Vector3<f64>) -> Points {
    let half = inertia.sum() / 2.0;
    let reach = (inertia.map(|it| half - it) * (3.0 / mass_kg)).map(f64::sqrt);
    let ends = (0..3).flat_map(move |i| [1.0, -1.0].map(|sign| Vector3::ith(i, sign * reach[i])));
    ends.map(|end| (mass_kg / 6.0, center + end)).collect()
}

fn about(center: &Vector3<f64>, points: &Points) -> Matrix3<f64> {
    points
        .iter()
        .map(|(mass, at)| {
            let skew = (at - center).cross_matrix();
            -skew * skew * *mass
        })
        .sum()
}

/// Two panels on hinges along X and the rest of the body.
struct Spacecraft {
    panels: [(Points, Vector3<f64>); 2],
    /// Inertia about the origin and first moment of everything else.
    rest: (Matrix3<f64>, Vector3<f64>),
}

impl Spacecraft {
    fn new(panels: [Points; 2]) -> Self {
        let whole = Matrix3::from_diagonal(&Vector3::new(199.6, 507.1, 484.9));
        let (mut inertia, mut moment) = (whole, Vector3::zeros());
        for panel in &panels {
            inertia -= about(&Vector3::zeros(), panel);
            moment -= panel.iter().map(|(mass, at)| at * *mass).sum::<Vector3<f64>>();
        }
        let [right, left] = panels;
        let hinge = Vector3::new(2.28, 0.0, 0.0);
        Self { panels: [(right, hinge), (left, -hinge)], rest: (inertia, moment) }
    }

    /// Centre of mass, inertia about it, and momentum by unit rate of each panel.
    fn at(&self, angles: [f64; 2]) -> (Vector3<f64>, Matrix3<f64>, [Vector3<f64>; 2]) {
        let turned: Vec<Points> = (self.panels.iter().zip(angles))
            .map(|((points, hinge), angle)| {
                let turn = Rotation3::new(Vector3::x() * angle);
                points.iter().map(|(mass, at)| (*mass, hinge + turn * (at - hinge))).collect()
            })
            .collect();
        let (mut inertia, mut moment) = self.rest;
        for points in &turned {
            inertia += about(&Vector3::zeros(), points);
            moment += points.iter().map(|(mass, at)| at * *mass).sum::<Vector3<f64>>();
        }
        let center = moment / MASS_KG;
        let skew = center.cross_matrix();
        let momenta = [0, 1].map(|k| {
            let hinge = self.panels[k].1;
            let each = turned[k].iter();
            each.map(|(mass, at)| (at - center).cross(&Vector3::x().cross(&(at - hinge))) * *mass).sum()
        });
        (center, inertia + skew * skew * MASS_KG, momenta)
    }

    /// Rate of the body and of the panels that stand at `law(time, attitude)`.
    fn rates(
        &self,
        law: &dyn Fn(f64, &UnitQuaternion<f64>) -> [f64; 2],
        time_s: f64,
        attitude: &UnitQuaternion<f64>,
        momentum: &Vector3<f64>,
    ) -> (Vector3<f64>, [f64; 2]) {
        let difference = |a: [f64; 2], b: [f64; 2], by: f64| [0, 1].map(|k| (a[k] - b[k]) / by);
        let step = 1e-6;
        let by_time = difference(law(time_s + step, attitude), law(time_s - step, attitude), 2.0 * step);
        let by_turn = [0, 1, 2].map(|i| {
            let turned =
                |sign: f64| attitude * UnitQuaternion::from_scaled_axis(Vector3::ith(i, sign * step));
            difference(law(time_s, &turned(1.0)), law(time_s, &turned(-1.0)), 2.0 * step)
        });
        let (_, inertia, momenta) = self.at(law(time_s, attitude));
        let mut matrix = inertia;
        let mut rest = attitude.inverse() * momentum;
        for k in 0..2 {
            matrix += momenta[k] * Vector3::new(by_turn[0][k], by_turn[1][k], by_turn[2][k]).transpose();
            rest -= momenta[k] * by_time[k];
        }
        let rate = matrix.try_inverse().unwrap() * rest;
        (rate, [0, 1].map(|k| by_time[k] + (0..3).map(|i| by_turn[i][k] * rate[i]).sum::<f64>()))
    }

    /// The attitude at `end_s` by the classical Runge-Kutta method.
    fn integrated(
        &self,
        law: &dyn Fn(f64, &UnitQuaternion<f64>) -> [f64; 2],
        (start_s, end_s, steps): (f64, f64, u32),
        mut attitude: UnitQuaternion<f64>,
        momentum: &Vector3<f64>,
    ) -> UnitQuaternion<f64> {
        let step_s = (end_s - start_s) / f64::from(steps);
        for k in 0..steps {
            let time_s = start_s + f64::from(k) * step_s;
            let slope = |at_s: f64, q: nalgebra::Quaternion<f64>| {
                let unit = UnitQuaternion::from_quaternion(q);
                let rate = self.rates(law, at_s, &unit, momentum).0;
                unit.into_inner() * nalgebra::Quaternion::from_imag(rate) * 0.5
            };
            let q = attitude.into_inner();
            let a = slope(time_s, q);
            let b = slope(time_s + step_s / 2.0, q + a * (step_s / 2.0));
            let c = slope(time_s + step_s / 2.0, q + b * (step_s / 2.0));
            let d = slope(time_s + step_s, q + c * step_s);
            attitude = UnitQuaternion::from_quaternion(q + (a + (b + c) * 2.0 + d) * (step_s / 6.0));
        }
        attitude
    }
}

fn hinged() -> Spacecraft {
    Spacecraft::new([
        points(30.0, Vector3::new(2.0, 0.3, 0.5), Vector3::new(4.0, 7.0, 3.5)),
        points(12.0, Vector3::new(-3.0, -0.2, 0.1), Vector3::new(1.0, 1.5, 1.2)),
    ])
}

fn degrees_between(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>) -> f64 {
    a.angle_to(b).to_degrees()
}

#[test]
fn a_pair_of_panels_turns_the_body_back() {
    // Plates about the axis through their middles: J about X stays, so the body turns by their share of it.
    let named = NamedModel::<MomentumPlant>::with("pair.toml", &text(PAIR));
    let share = 2.0 * 20.0 * 2.5 / 12.0 / 199.6;
    let mut flight = initialize(&named, &[FREE, DARK, LOCKED, BY_ANGLE]);
    let start = to_inertial(&flight);
    for panel in ["panel[1].angle", "panel[2].angle"] {
        flight.set(panel, core::f64::consts::FRAC_PI_2);
    }
    flight.step_to(10.0).unwrap();
    let turned = (start.inverse() * to_inertial(&flight)).scaled_axis();
    println!("{} deg", turned.norm().to_degrees());
    assert!((turned.norm().to_degrees() - 3.757).abs() < 1e-3);
    assert!((turned + Vector3::x() * (share * core::f64::consts::FRAC_PI_2)).norm() < 1e-9, "{turned}");
    assert!(flight.vector("attitude.rate").norm() < 1e-15);
    assert_eq!(flight.vector("momentum.inertial"), Vector3::zeros());
    // The same evenly: the body turns back while they move, and stands when they do.
    let mut flight = initialize(&named, &[FREE, DARK, LOCKED, BY_ANGLE]);
    let rate = core::f64::consts::FRAC_PI_2 / 10.0;
    flight.step_moving(5.0, &[("panel[1].angle", rate), ("panel[2].angle", rate)]).unwrap();
    assert!((flight.vector("attitude.rate") + Vector3::x() * (share * rate)).norm() < 1e-12);
    for panel in ["panel[1].angle", "panel[2].angle"] {
        flight.set(panel, rate * 5.0);
    }
    flight.step_moving(10.0, &[("panel[1].angle", rate), ("panel[2].angle", rate)]).unwrap();
    for panel in ["panel[1].angle", "panel[2].angle"] {
        flight.set(panel, core::f64::consts::FRAC_PI_2);
    }
    flight.step_to(20.0).unwrap();
    let evenly = (start.inverse() * to_inertial(&flight)).scaled_axis();
    assert!((evenly - turned).norm() < 1e-9, "{evenly} {turned}");
    assert!(flight.vector("attitude.rate").norm() < 1e-14, "{}", flight.vector("attitude.rate"));
}

/// J w + h from outputs, the panels at these angles and rates.
fn formed(
    flight: &PlantInstance<'_>,
    spacecraft: &Spacecraft,
    angles: [f64; 2],
    rates: [f64; 2],
) -> Vector3<f64> {
    let (_, inertia, momenta) = spacecraft.at(angles);
    let panels = momenta[0] * rates[0] + momenta[1] * rates[1];
    to_inertial(flight) * (inertia * flight.vector("attitude.rate") + panels)
}

#[test]
fn a_tumbling_body_gives_way_to_panels_that_move_evenly_and_at_once() {
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text(HINGED));
    let spacecraft = hinged();
    let mut flight = initialize(&named, &[FREE, DARK, LOCKED, BY_ANGLE, TUMBLING]);
    let momentum = flight.vector("momentum.inertial");
    let mut attitude = to_inertial(&flight);
    let (mut angles, mut now_s, mut worst_deg, mut worst_momentum) = ([0.0; 2], 0.0, 0.0_f64, 0.0_f64);
    // What each panel does: goes at once there, then moves so fast until then.
    for (set, rates, until_s) in [
        ([0.0, 0.0], [0.1, -0.03], 8.37),
        ([0.837, -0.2511], [0.0, 0.0], 15.0),
        ([-1.3, 2.1], [0.0, 0.0], 20.0),
        ([-1.0, 2.1], [-0.2, 0.5], 26.5),
        ([3.0, -2.9], [0.0, 0.02], 60.0),
    ] {
        // At once is as fast as one likes, and the shorter way.
        let (from, quick_s): ([f64; 2], f64) = (angles, 1e-8);
        let at_once = [0, 1].map(|k| from[k] + (set[k] - from[k] + PI).rem_euclid(TAU) - PI);
        let jump = |at_s: f64, _: &UnitQuaternion<f64>| {
            [0, 1].map(|k| from[k] + (at_once[k] - from[k]) * (at_s - now_s) / quick_s)
        };
        attitude = spacecraft.integrated(&jump, (now_s, now_s + quick_s, 400), attitude, &momentum);
        let ramp =
            |at_s: f64, _: &UnitQuaternion<f64>| [0, 1].map(|k| at_once[k] + rates[k] * (at_s - now_s));
        attitude = spacecraft.integrated(&ramp, (now_s, until_s, 2000), attitude, &momentum);
        flight.set("panel[1].angle", set[0]);
        flight.set("panel[2].angle", set[1]);
        let moving = [("panel[1].angle", rates[0]), ("panel[2].angle", rates[1])];
        let moving: &[_] = if rates == [0.0; 2] { &[] } else { &moving };
        flight.step_moving(until_s, moving).unwrap();
        angles = [0, 1].map(|k| at_once[k] + rates[k] * (until_s - now_s));
        worst_deg = worst_deg.max(degrees_between(&to_inertial(&flight), &attitude));
        worst_momentum = worst_momentum.max((formed(&flight, &spacecraft, angles, rates) - momentum).norm());
        assert_eq!(flight.vector("momentum.inertial"), momentum);
        assert!((flight.vector("centerOfMass") - spacecraft.at(angles).0).norm() < 1e-12);
        now_s = until_s;
    }
    println!("{worst_deg:.1e} deg, {:.1e} of the momentum", worst_momentum / momentum.norm());
    assert!(worst_deg < 1e-5, "{worst_deg:e}");
    assert!(worst_momentum < 1e-12 * momentum.norm(), "{worst_momentum:e}");
    // Begun at an angle, the rate is the one requested.
    let turned = initialize(&named, &[FREE, DARK, LOCKED, BY_ANGLE, TUMBLING, &[("panel[1].angle", 0.9)]]);
    assert!((turned.vector("attitude.rate") - Vector3::new(4e-3, -7e-3, 5e-3)).norm() < 1e-17);
    let begun = formed(&turned, &spacecraft, [0.9, 0.0], [0.0; 2]);
    assert!((turned.vector("momentum.inertial") - begun).norm() < 1e-13);
}

#[test]
fn panels_that_keep_to_the_sun_turn_a_spinning_body_back() {
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text(HINGED));
    let spacecraft = hinged();
    let spinning: Start<'_> = &[("start.rate[1]", 0.03), ("start.rate[2]", 0.004), ("start.rate[3]", -0.006)];
    let undumped: Start<'_> =
        &[("dump.threshold[1]", 1e6), ("dump.threshold[2]", 1e6), ("dump.threshold[3]", 1e6)];
    let mut flight = initialize(&named, &[FREE, DARK, LOCKED, spinning, undumped]);
    let momentum = flight.vector("momentum.inertial");
    let start = to_inertial(&flight);
    let to_sun = start * flight.vector("sun.direction");
    let first = [1, 2].map(|k| flight.real(&format!("panel[{k}].angleActual")));
    // The cells make 65 deg with the Sun, tilted about +X from where they face it; angle 0 looks along -Y.
    let law = |_: f64, attitude: &UnitQuaternion<f64>| {
        let sun = attitude.inverse() * to_sun;
        let in_plane = sun.y.hypot(sun.z);
        let facing = (-sun.z).atan2(-sun.y);
        let angle = facing + (65.0_f64.to_radians().cos() / in_plane).clamp(-1.0, 1.0).acos();
        [angle, angle]
    };
    let mine = law(0.0, &start);
    assert!((0..2).all(|k| (mine[k] - first[k]).abs() < 1e-9), "{mine:?} {first:?}");
    let (rate, turning) = spacecraft.rates(&law, 0.0, &start, &momentum);
    // The Sun itself moves by 1e-6 rad/s.
    assert!(
        (rate - flight.vector("attitude.rate")).norm() < 3e-7,
        "{rate} {} {turning:?}",
        flight.vector("attitude.rate")
    );
    assert!(turning[0].abs() > 0.01);
    let mut attitude = start;
    let mut worst_deg = 0.0_f64;
    for k in 0..10 {
        let (from_s, until_s) = (6.0 * f64::from(k), 6.0 * f64::from(k + 1));
        attitude = spacecraft.integrated(&law, (from_s, until_s, 200), attitude, &momentum);
        flight.step_to(until_s).unwrap();
        worst_deg = worst_deg.max(degrees_between(&to_inertial(&flight), &attitude));
        assert_eq!(flight.vector("momentum.inertial"), momentum);
    }
    println!("{worst_deg:.1e} deg");
    assert!(worst_deg < 0.01, "{worst_deg:e}");
}

/// Commanded flight with momentum in the wheels.
const COMMANDED: Start<'_> = &[("attitude.source", 2.0), ("start.momentum[2]", 1.5)];

/// The flight with a command that turns about X and Z.
fn turning_as_commanded(mut flight: PlantInstance<'_>) -> PlantInstance<'_> {
    flight.set("command.q[4]", 1.0);
    flight.set("command.rate[1]", 2e-3);
    flight.set("command.rate[3]", -1e-3);
    flight
}

#[test]
fn ideal_wheels_hold_what_the_panels_do_not() {
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text(HINGED));
    let spacecraft = hinged();
    let mut flight = turning_as_commanded(initialize(&named, &[COMMANDED, DARK, BY_ANGLE]));
    let rates = [0.05, -0.02];
    flight.step_moving(7.0, &[("panel[1].angle", rates[0]), ("panel[2].angle", rates[1])]).unwrap();
    let held = to_inertial(&flight) * held_momentum(&flight);
    let whole = formed(&flight, &spacecraft, rates.map(|rate| 7.0 * rate), rates) + held;
    let reported = flight.vector("momentum.inertial");
    assert!((whole - reported).norm() < 1e-12 * reported.norm(), "{whole} {reported}");
}

/// The wheels' torques over time from `start_s` on by Gauss-Legendre quadrature, beside what it makes of their momenta; how far
/// it is off, relative to the greatest change.
fn torques_off(
    flight: &mut PlantInstance<'_>,
    start_s: f64,
    mut step: impl FnMut(&mut PlantInstance<'_>, f64),
) -> f64 {
    const PIECE_S: f64 = 15.0;
    let rule = Rule::<8>::gauss_legendre();
    step(flight, start_s);
    let (begin, mut impulse) = (axial(flight), [0.0; WHEELS]);
    for piece in 0..4 {
        let from_s = start_s + f64::from(piece) * PIECE_S;
        for (at_s, weight_s) in rule.on(from_s, from_s + PIECE_S) {
            step(flight, at_s);
            let shown = torques(flight);
            (0..WHEELS).for_each(|k| impulse[k] += shown[k] * weight_s);
        }
        step(flight, from_s + PIECE_S);
    }
    most_off(&begin, &axial(flight), &impulse)
}

#[test]
fn ideal_wheels_take_up_what_turning_panels_give() {
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text(HINGED));
    // The Sun gives the angles, in science, in a slew and in the downlink.
    let mut flight =
        wheel_torque::initialize(&named, &[("start.momentum[2]", 2.0), ("guided.slewRate", 2e-3)]);
    for start_s in [30.0, 900.0, 3000.0, 9000.0] {
        let off = torques_off(&mut flight, start_s, |flight, at_s| flight.step_to(at_s).unwrap());
        println!("guided, from {start_s} s: {off:.1e}");
        assert!(off < 1e-6, "{start_s}: {off}");
    }
    // An input does, and its derivative.
    let mut flight = turning_as_commanded(wheel_torque::initialize(&named, &[COMMANDED, BY_ANGLE].concat()));
    let rates = [("panel[1].angle", 0.05), ("panel[2].angle", -0.02)];
    let off = torques_off(&mut flight, 2.0, |flight, at_s| {
        let now_s = flight.time_s();
        rates.iter().for_each(|(name, rate)| flight.set(name, rate * now_s));
        flight.step_moving(at_s, &rates).unwrap();
    });
    println!("commanded: {off:.1e}");
    assert!(off < 1e-6, "{off}");
}

#[test]
fn ideal_wheels_show_the_torque_of_fast_panels_in_a_long_step() {
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text(HINGED));
    let spacecraft = hinged();
    let mut flight = turning_as_commanded(initialize(&named, &[COMMANDED, DARK, BY_ANGLE]));
    let (rates, time_s, difference_s) = ([0.5, -0.3], 40.0, 1e-4);
    flight.step_moving(time_s, &[("panel[1].angle", rates[0]), ("panel[2].angle", rates[1])]).unwrap();
    let turning = flight.vector("attitude.rate");
    let own = |at_s: f64| {
        let (_, inertia, momenta) = spacecraft.at(rates.map(|rate| rate * at_s));
        inertia * turning + momenta[0] * rates[0] + momenta[1] * rates[1]
    };
    let own_rate = (own(time_s + difference_s) - own(time_s - difference_s)) / (2.0 * difference_s);
    // No torque from outside, and the body turns evenly.
    let expected = -turning.cross(&flight.vector("momentum.body")) - own_rate;
    let shown: Vector3<f64> = axes(&flight).iter().zip(torques(&flight)).map(|(axis, it)| axis * it).sum();
    let off = (shown - expected).norm() / expected.norm();
    println!("{off:.1e} of {:.1} N m", expected.norm());
    assert!(off < 1e-6, "{off} {shown} {expected}");
}

#[test]
fn how_the_motion_of_panels_is_cut_changes_no_bit() {
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text(HINGED));
    let spinning: Start<'_> = &[("start.rate[1]", 0.03), ("start.rate[2]", 0.004)];
    let initialize = || initialize(&named, &[FREE, spinning]);
    assert_cuts_change_nothing(initialize, [0.017, 5.5, 20.0, 40.0], &[1.3, 0.013, 0.5, 7.0], |flight| {
        if flight.time_s() == 20.0 {
            flight.set("panel[1].sunOffset", 0.3);
        }
    });
}

#[test]
fn light_turns_the_body_about_its_moved_centre() {
    // Sunlight on the panels has an arm from the centre of mass, which the first panel moves.
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text(HINGED));
    let start: Start<'_> =
        &[("attitude.source", 2.0), ("panel[1].control", 2.0), ("gravityGradient.enabled", 0.0)];
    let mut flight = initialize(&named, &[start]);
    let torque_about_origin = |flight: &PlantInstance<'_>| {
        let force = flight.vector("force.solar");
        (flight.vector("torque.solar") + flight.vector("centerOfMass").cross(&force), force)
    };
    flight.set("panel[1].angle", 1.2);
    flight.step_to(10.0).unwrap();
    let moved = torque_about_origin(&flight);
    let shipped = NamedModel::<MomentumPlant>::shipped();
    let mut rigid = initialize(&shipped, &[start]);
    rigid.set("panel[1].angle", 1.2);
    rigid.step_to(10.0).unwrap();
    let fixed = torque_about_origin(&rigid);
    assert!(flight.vector("centerOfMass").norm() > 0.01 && rigid.vector("centerOfMass").norm() == 0.0);
    assert!((moved.1 - fixed.1).norm() < 1e-12 * fixed.1.norm());
    assert!((moved.0 - fixed.0).norm() < 1e-10 * fixed.0.norm(), "{} {}", moved.0, fixed.0);
}
