//! Sensors: what they measure, what their failures do, noise that repeats.

use models::MomentumPlant;
use nalgebra::{UnitQuaternion, Vector3};

use super::super::named_model::{NamedModel, assert_same};
use super::{CONTROLLED, FREE, GUIDANCE, PlantInstance, Start, initialize, to_inertial};

fn estimate(flight: &PlantInstance<'_>) -> UnitQuaternion<f64> {
    flight.to_inertial("estimate.q")
}

const NOISE: Start<'_> = &[
    ("starTracker.noise[1]", 3e-5),
    ("starTracker.noise[2]", 3e-5),
    ("starTracker.noise[3]", 1e-4),
    ("gyro.noise", 2e-6),
    ("gyro.drift", 1e-8),
    ("gyro.bias[1]", 1e-5),
];

#[test]
fn without_noise_everything_is_seen_as_it_is() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for source in [1.0, 2.0, 3.0, 4.0] {
        let mut flight = initialize(
            &named,
            &[&[("attitude.source", source), ("start.rate[3]", 1e-3 * (source - 2.0).max(0.0))]],
        );
        flight.simulate_to(50.0, 0.5).unwrap();
        let angle = estimate(&flight).angle_to(&to_inertial(&flight));
        // Propagated from the sample before at its rate.
        assert!(angle < 1e-7, "{source}: {angle:e}");
        assert!((flight.vector("estimate.rate") - flight.vector("attitude.rate")).norm() < 1e-5);
        let sun = (flight.vector("sun.sensed") - flight.vector("sun.direction")).norm();
        assert!(
            flight.boolean("estimate.valid") && flight.boolean("sun.sensedValid") && sun < 1e-4,
            "{source}: {sun:e}"
        );
    }
}

#[test]
fn noise_spreads_as_reported_and_repeats() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let initialize_with = |seed: f64| {
        let mut flight = initialize(&named, &[CONTROLLED, GUIDANCE, NOISE, &[("noise.seed", seed)]]);
        let (mut sum, mut count) = (0.0_f64, 0.0);
        flight.simulate_to(600.0, 10.0).unwrap();
        while flight.time_s() < 2_000.0 {
            flight.step_to(flight.time_s() + 2.0).unwrap();
            sum += estimate(&flight).angle_to(&to_inertial(&flight)).powi(2);
            count += 1.0;
        }
        (flight, (sum / count).sqrt())
    };
    let (first, spread) = initialize_with(7.0);
    // Filtered: well below the tracker's, well above nothing.
    assert!((2e-6..5e-5).contains(&spread), "{spread:e}");
    assert_same(&first, &initialize_with(7.0).0);
    let (other, _) = initialize_with(8.0);
    assert!(estimate(&first).angle_to(&estimate(&other)) > 1e-8);
}

#[test]
fn failures_decide_what_is_valid() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = initialize(&named, &[CONTROLLED, GUIDANCE, &[("starTracker.outage", 30.0)]]);
    flight.simulate_to(10.0, 1.0).unwrap();
    flight.set("starTracker.failed", 1.0);
    flight.set("starTracker.spareFailed", 1.0);
    flight.simulate_to(35.0, 1.0).unwrap();
    assert!(flight.boolean("estimate.valid"));
    flight.simulate_to(50.0, 1.0).unwrap();
    assert!(!flight.boolean("estimate.valid"));
    flight.set("starTracker.failed", 0.0);
    flight.simulate_to(51.0, 1.0).unwrap();
    assert!(flight.boolean("estimate.valid"));
    // The tracker alone: rates by a filter of its attitudes.
    flight.set("gyro.failed", 1.0);
    flight.simulate_to(80.0, 1.0).unwrap();
    assert!(flight.boolean("estimate.valid"));
    assert!((flight.vector("estimate.rate") - flight.vector("attitude.rate")).norm() < 1e-5);
    // Neither.
    flight.set("starTracker.failed", 1.0);
    flight.simulate_to(90.0, 1.0).unwrap();
    assert!(!flight.boolean("estimate.valid"));
    assert_eq!(flight.vector("estimate.rate"), Vector3::zeros());
}

#[test]
fn the_estimate_is_lost_when_both_star_trackers_have_failed() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let commanded: Start<'_> = &[("attitude.source", 2.0)];
    for (source, outage_s) in [(CONTROLLED, 0.0), (commanded, 0.0)] {
        let mut flight = initialize(&named, &[source, GUIDANCE, &[("starTracker.outage", outage_s)]]);
        for (failed, spare_failed) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)] {
            flight.set("starTracker.failed", failed);
            flight.set("starTracker.spareFailed", spare_failed);
            let end_s = flight.time_s() + 1.0;
            flight.step_to(end_s).unwrap();
            assert_eq!(
                flight.boolean("estimate.valid"),
                failed * spare_failed == 0.0,
                "{failed} {spare_failed}"
            );
        }
    }
}

#[test]
fn sun_sensors_see_what_is_before_them() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = initialize(&named, &[FREE]);
    flight.simulate_to(5.0, 1.0).unwrap();
    let sun = flight.vector("sun.direction");
    // One after the other fails; those that see it are within 60 deg of it.
    let mut seeing = 0;
    for k in 1..=6 {
        let axis = flight.vector(&format!("sunSensor[{k}].axis"));
        seeing += u32::from(axis.dot(&sun) > 0.5);
        if axis.dot(&sun) > 0.5 {
            flight.set(&format!("sunSensor[{k}].failed"), 1.0);
        }
    }
    assert!((1..=3).contains(&seeing));
    assert!(flight.boolean("sun.sensedValid"));
    flight.simulate_to(6.0, 1.0).unwrap();
    assert!(!flight.boolean("sun.sensedValid"));
    assert_eq!(flight.vector("sun.sensed"), Vector3::zeros());
}

#[test]
fn no_sun_is_sensed_in_the_shadow() {
    let named = NamedModel::<MomentumPlant>::shipped();
    // Where the shipped orbit has eclipses in a quarter of a year, guided flight tells quickly.
    let mut guided = named.initialize(0.0, &[]).unwrap();
    while guided.real("sun.litFraction") > 0.0 {
        guided.step_to(guided.time_s() + 300.0).unwrap();
        assert!(guided.time_s() < 86_400.0 * 90.0);
    }
    let dark_s = guided.time_s();
    // The orbit is one in closed form: simulated from the middle of the shadow and out of it.
    let mut flight = named.initialize(0.0, &[("attitude.source", 2.0)]).unwrap();
    flight.step_to(dark_s).unwrap();
    assert!(!flight.boolean("sun.sensedValid"));
    let [place, speed] = ["position", "velocity"].map(|name| flight.vector(name));
    let names = ["orbit.position", "orbit.velocity"];
    let given = names
        .iter()
        .zip([place, speed])
        .flat_map(|(name, vector)| (0..3).map(move |i| (format!("{name}[{}]", i + 1), vector[i])));
    let given: Vec<(String, f64)> = given.collect();
    let mut start: Vec<(&str, f64)> = given.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let epoch_s = guided.real("epoch");
    start.extend([("attitude.source", 4.0), ("orbit.source", 2.0), ("start.epoch", epoch_s)]);
    let mut flight = named.initialize(0.0, &start).unwrap();
    while flight.real("sun.litFraction") < 1.0 {
        flight.step_to(flight.time_s() + 10.0).unwrap();
        let lit = flight.real("sun.litFraction");
        assert!(lit > 0.0 || !flight.boolean("sun.sensedValid"));
        assert!(flight.time_s() < 7_200.0);
    }
    flight.step_to(flight.time_s() + 1.0).unwrap();
    assert!(flight.boolean("sun.sensedValid"));
}
