//! Commands: which inputs a step reads, scans and their clock, clamps, constraints that are switched in flight.

use models::Guidance;
use nalgebra::Vector3;

use super::super::named_model::{NamedModel, assert_same};
use super::{FREE, GuidanceInstance, PLACED, to_inertial, with};

const AT_VECTOR: &[(&str, f64)] =
    &[("pointing.scenario", 2.0), ("aimpoint.option", 1.0), ("aimpoint.vector[3]", 1.0)];
const DOWN: &[(&str, f64)] = &[("pointing.scenario", 3.0)];

#[test]
fn a_sample_reads_the_inputs_of_the_step_that_begins_at_it() {
    let named = NamedModel::<Guidance>::shipped();
    let mut flight = named.initialize(0.0, &with(&[PLACED, FREE, AT_VECTOR])).unwrap();
    for (end_s, direction) in
        [(1.0, Vector3::x()), (1.5, Vector3::y()), (2.5, -Vector3::x()), (4.0, Vector3::z())]
    {
        // The sample at 1.0 belongs to the step from 1.0, those at 2.0 and 3.0 to the steps that hold them.
        flight.set_elements("aimpoint.vector", &direction);
        flight.step_to(end_s).unwrap();
        assert!((to_inertial(&flight) * Vector3::z() - direction).norm() < 1e-6, "{end_s}");
    }
    // Without a sample inside, a step does not read them.
    let before = flight.quaternion("command.q");
    flight.step_to(4.25).unwrap();
    flight.set_elements("aimpoint.vector", &Vector3::x());
    flight.step_to(4.75).unwrap();
    let after = flight.quaternion("command.q");
    assert!(before.iter().zip(after).all(|(a, b)| (a - b).abs() < 1e-6));
}

#[test]
fn outputs_are_those_of_the_last_sample_propagated_by_its_rate() {
    let named = NamedModel::<Guidance>::shipped();
    let mut flight = named.initialize(0.0, &with(&[PLACED, FREE, DOWN])).unwrap();
    flight.step_to(10.0 + 1e-9).unwrap();
    let (start, rate) = (to_inertial(&flight), flight.vector("command.rate"));
    assert!(rate.norm() > 1e-5);
    flight.step_to(11.0).unwrap();
    let expected = start * nalgebra::UnitQuaternion::from_scaled_axis(rate);
    assert!(expected.angle_to(&to_inertial(&flight)) < 1e-7);
    assert_eq!(rate, flight.vector("command.rate"));
}

#[test]
fn the_quaternions_sign_goes_on_through_transitions() {
    let named = NamedModel::<Guidance>::shipped();
    let mut flight = named.initialize(0.0, &with(&[PLACED, DOWN])).unwrap();
    let mut last = flight.quaternion("command.q");
    let mut turned = 0.0_f64;
    for minute in 1..=1440 {
        let (sine, cosine) = (f64::from(minute) * 60.0 * 3e-4).sin_cos();
        flight.set_elements("position", &(Vector3::new(cosine, 0.1, sine) * 4e6));
        flight.set_elements("velocity", &(Vector3::new(-sine, 0.0, cosine) * 1.2e3));
        let scenario = [3.0, 6.0, 10.0, 8.0][minute as usize / 20 % 4];
        flight.set("pointing.scenario", scenario);
        // A first sample with what was set, from the attitude propagated to it.
        flight.step_to(f64::from(minute) * 60.0 - 59.0).unwrap();
        let now = flight.quaternion("command.q");
        let along: f64 = now.iter().zip(last).map(|(a, b)| a * b).sum();
        assert!(along > -1e-3, "{minute} min: {last:?} {now:?}");
        turned = turned.max(1.0 - along);
        flight.step_to(f64::from(minute) * 60.0).unwrap();
        last = flight.quaternion("command.q");
    }
    assert!(turned > 0.1, "{turned}");
}

#[test]
fn a_scan_starts_at_the_sample_where_its_frame_is_commanded() {
    let named = NamedModel::<Guidance>::shipped();
    let scan = [("scan.rate[1]", 1e-3), ("scan.duration[1]", 1e6)];
    let sets = with(&[PLACED, FREE, AT_VECTOR, &scan]);
    let mut flight = named.initialize(0.0, &sets).unwrap();
    let mut basic = named.initialize(0.0, &sets).unwrap();
    let mut step = |flight: &mut super::GuidanceInstance<'_>, end_s: f64| {
        flight.step_to(end_s).unwrap();
        basic.step_to(end_s).unwrap();
        let angle_rad = to_inertial(&basic).angle_to(&to_inertial(flight));
        let active = flight.boolean("scan.active");
        (angle_rad, active)
    };
    let near = |(angle_rad, active): (f64, bool), elapsed_s: f64| {
        assert!((angle_rad - 1e-3 * elapsed_s).abs() < 1e-9, "{angle_rad} {elapsed_s}");
        assert_eq!(active, elapsed_s > 0.0);
    };
    near(step(&mut flight, 5.0), 0.0);
    flight.set("scan.frame", 1.0);
    near(step(&mut flight, 12.0), 7.0);
    flight.set("scan.frame", 0.0);
    near(step(&mut flight, 13.0), 0.0);
    flight.set("scan.frame", 1.0);
    near(step(&mut flight, 15.5), 2.5);
}

#[test]
fn a_scan_that_does_not_fit_leaves_the_basic_pointing() {
    let named = NamedModel::<Guidance>::shipped();
    let scan = [("scan.rate[1]", 1e-3), ("scan.speed[1]", 1e3), ("scan.duration[1]", 1e6)];
    let downlink = [("pointing.scenario", 6.0)];
    // Translations of a direction, a turn of the local frame, and any scan with downlink.
    for (command, frames) in [(AT_VECTOR, &[3.0, 4.0, 5.0][..]), (&downlink, &[1.0, 2.0, 3.0, 4.0, 5.0][..])]
    {
        for frame in frames {
            let sets = with(&[PLACED, command, &scan, &[("scan.frame", *frame)]]);
            let (mut scanned, mut basic) =
                (named.initialize(0.0, &sets).unwrap(), named.initialize(0.0, &sets).unwrap());
            basic.set("scan.frame", 0.0);
            scanned.step_to(30.0).unwrap();
            basic.step_to(30.0).unwrap();
            assert_same(&scanned, &basic);
            assert!(!scanned.boolean("scan.active"));
        }
    }
}

#[test]
fn camera_and_antenna_stop_at_their_bounds() {
    let named = NamedModel::<Guidance>::shipped();
    let camera = [("pointing.scenario", 4.0), ("aimpoint.option", 12.0)];
    for (requested_rad, found_rad) in [(0.5, 0.5), (1.0, 40_f64.to_radians()), (-2.0, -50_f64.to_radians())] {
        let angle = [("boresight.angle", requested_rad)];
        let flight = named.initialize(0.0, &with(&[PLACED, FREE, &camera, &angle])).unwrap();
        assert!((flight.real("gimbal.angle") - found_rad).abs() < 1e-15);
        let inside = requested_rad == found_rad;
        assert_eq!(
            [flight.boolean("gimbal.inRange"), flight.boolean("constraint.clamped")],
            [inside, !inside]
        );
    }
    let antenna = [("pointing.scenario", 6.0), ("boresight.option", 4.0)];
    for (requested_deg, found_deg, select) in
        [(-30.0, -30.0, 1), (30.0, 0.0, 1), (80.0, 90.0, 2), (150.0, 150.0, 2)]
    {
        let azimuth = [("boresight.azimuth", f64::to_radians(requested_deg))];
        let flight = named.initialize(0.0, &with(&[PLACED, FREE, &antenna, &azimuth])).unwrap();
        assert!(
            (flight.real("antenna.azimuth") - f64::to_radians(found_deg)).abs() < 1e-12,
            "{requested_deg}"
        );
        assert_eq!(flight.integer("antenna.select"), select);
        assert_eq!(flight.boolean("constraint.clamped"), requested_deg != found_deg);
    }
}

#[test]
fn camera_and_beam_follow_their_targets_where_the_zone_moved_the_attitude() {
    let named = NamedModel::<Guidance>::shipped();
    let off = [("hotPole.enabled", 0.0)];
    let toward = |flight: &GuidanceInstance<'_>, place: Vector3<f64>| {
        to_inertial(flight).inverse() * place.normalize()
    };
    let spacecraft = Vector3::new(3e6, 1e6, 2e6);
    // The Earth is 157 deg from the Sun: requested at 100 deg it leaves the Sun outside the zone.
    let antenna =
        [("pointing.scenario", 6.0), ("boresight.option", 4.0), ("boresight.azimuth", 100_f64.to_radians())];
    let flight = named.initialize(0.0, &with(&[PLACED, &off, &antenna])).unwrap();
    let earth = toward(&flight, Vector3::new(-9e10, 5e10, -3e9) - spacecraft);
    assert!(flight.boolean("constraint.sunKeepIn") && flight.boolean("link.available"));
    assert!((flight.real("antenna.azimuth") - earth.x.atan2(-earth.y)).abs() < 1e-12);
    assert!((flight.real("antenna.azimuth").to_degrees() - 100.0).abs() > 20.0, "the zone moved it");
    // +Z along the local horizon, the camera at nadir.
    let mut clamped = 0;
    for azimuth_deg in (0..360).step_by(30) {
        let targets = [
            ("pointing.scenario", 5.0),
            ("aimpoint.option", 9.0),
            ("aimpoint.azimuth", f64::from(azimuth_deg).to_radians()),
            ("aimpoint.elevation", -1.0),
            ("secondAimpoint.option", 12.0),
        ];
        let flight = named.initialize(0.0, &with(&[PLACED, &off, &targets])).unwrap();
        let nadir = toward(&flight, -spacecraft);
        let expected_deg = (-nadir.y).atan2(nadir.z).to_degrees();
        let in_range = (-50.0..=40.0).contains(&expected_deg);
        assert_eq!(flight.boolean("gimbal.inRange"), in_range, "{azimuth_deg}: {expected_deg}");
        let found_deg = flight.real("gimbal.angle").to_degrees();
        assert!(
            !in_range || (found_deg - expected_deg).abs() < 1e-10,
            "{azimuth_deg}: {found_deg} {expected_deg}"
        );
        clamped += u32::from(flight.boolean("constraint.sunKeepIn"));
    }
    assert!(clamped > 3, "{clamped}");
}

#[test]
fn the_keep_in_zone_is_switched_and_resized_between_steps() {
    let named = NamedModel::<Guidance>::shipped();
    let zone = [
        ("hotPole.enabled", 0.0),
        ("monitor.enabled", 0.0),
        ("keepIn.azimuth", 0.2),
        ("keepIn.elevation", 0.2),
    ];
    let mut flight = named.initialize(0.0, &with(&[PLACED, AT_VECTOR, &zone])).unwrap();
    // Toward the Sun, so that it would stand on +Z.
    flight.set_elements("aimpoint.vector", &Vector3::new(3e10, -4e10, 2e9));
    let mut step = |name: &str, value: f64, end_s: f64| {
        flight.set(name, value);
        flight.step_to(end_s).unwrap();
        (flight.boolean("constraint.sunKeepIn"), flight.real("sun.elevation"))
    };
    let (in_force, elevation_rad) = step("keepIn.enabled", 1.0, 1.0);
    assert!(in_force && (elevation_rad + 0.2).abs() < 1e-6, "{elevation_rad}");
    let (in_force, elevation_rad) = step("keepIn.elevation", 0.1, 2.0);
    assert!(in_force && (elevation_rad + 0.1).abs() < 1e-6, "{elevation_rad}");
    let (in_force, elevation_rad) = step("keepIn.enabled", 0.0, 3.0);
    assert!(!in_force && elevation_rad < -1.5, "{elevation_rad}");
    assert!(step("keepIn.enabled", 1.0, 4.0).0);
    // The Sun is 5e10 m away.
    assert!(!step("keepIn.distance", 4.9e10, 5.0).0);
    assert!(step("keepIn.distance", 5.2e10, 6.0).0);
}

#[test]
fn a_zone_without_axis_is_refused_by_name_and_too_much_work_by_its_limit() {
    let named = NamedModel::<Guidance>::shipped();
    let refused = named.refusal(&with(&[PLACED, &[("keepIn.axis[2]", 0.0)]]));
    assert!(refused.contains("keepIn.axis: found (0, 0, 0)"), "{refused}");
    let mut flight = named.initialize(0.0, &with(&[PLACED, DOWN, &[("solver.workLimit", 1_000.0)]])).unwrap();
    flight.step_to(249.0).unwrap();
    let refused = flight.step_to(600.0).unwrap_err().to_string();
    assert!(refused.contains("solver.workLimit = 1000") && refused.contains("reached 499 s"), "{refused}");
}
