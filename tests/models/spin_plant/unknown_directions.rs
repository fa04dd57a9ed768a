//! Masters send 0 on every input before the first exchange: no error, nothing seen, one warning until there is a value.

use super::driver::{Spinner, assert_names};

const DIRECTIONS: [&str; 3] = ["sun.direction", "earth.direction", "star.direction"];

fn put(spinner: &mut Spinner, name: &str, value: [f64; 3]) {
    for (axis, component) in value.into_iter().enumerate() {
        spinner.put(&format!("{name}[{}]", axis + 1), component);
    }
}

fn warnings(spinner: &mut Spinner) -> String {
    let lines = spinner.fmu.drain_messages().into_iter().map(|message| message.text + "\n");
    lines.filter(|line| line.contains("nothing is seen")).collect()
}

#[test]
fn zero_on_every_direction_is_simulated_and_warned_of_once() {
    let mut spinner = Spinner::new().set_integer("burn.timing", 2);
    DIRECTIONS.iter().for_each(|name| put(&mut spinner, name, [0.0; 3]));
    let mut spinner = spinner.start();
    let text = warnings(&mut spinner);
    assert_names(&text, &DIRECTIONS);
    assert_eq!(text.matches("nothing is seen").count(), 1, "{text}");
    // Four turns: no Sun, no star, no pulse that waits for the Sun.
    for end_s in [0.5, 7.0, 50.0] {
        spinner.to(end_s);
        DIRECTIONS.iter().for_each(|name| put(&mut spinner, name, [0.0; 3]));
    }
    assert_eq!(warnings(&mut spinner), "");
    assert!(spinner.outputs().iter().all(|value| value.is_finite()));
    for name in ["spin.sunCrossings", "starTracker.sampleCount", "burn.pulsesFired"] {
        assert_eq!(spinner.integer(name), 0, "{name}");
    }
    for name in ["sun.angle", "earth.angle", "sun.inertial[1]", "spin.periodVariation", "deltaV[1]"] {
        assert_eq!(spinner.real(name), 0.0, "{name}");
    }
    assert!(!spinner.boolean("limit.anyViolated"));
    // The first values: from here on it moves as one that had them.
    put(&mut spinner, "sun.direction", [0.0, 0.17, 0.98]);
    put(&mut spinner, "earth.direction", [0.0, 0.0, -1.0]);
    put(&mut spinner, "star.direction", [0.3, 0.95, 0.02]);
    spinner.to(400.0);
    assert_eq!(warnings(&mut spinner), "");
    // 350 s are 29 turns.
    assert!((28..=30).contains(&spinner.integer("spin.sunCrossings")));
    assert!((27..=30).contains(&spinner.integer("burn.pulsesFired")));
    assert!(spinner.integer("starTracker.sampleCount") > 0);
    assert!((spinner.real("sun.inertial[3]") - 0.98 / 0.98_f64.hypot(0.17)).abs() < 1e-12);
    // Zero again: warned of again, once.
    put(&mut spinner, "sun.direction", [0.0; 3]);
    spinner.to(401.0);
    let text = warnings(&mut spinner);
    assert!(text.contains("sun.direction is 0") && !text.contains("star"), "{text}");
    spinner.to(402.0);
    assert_eq!(warnings(&mut spinner), "");
}

#[test]
fn zero_on_the_other_inputs_is_no_news() {
    let mut spinner = Spinner::new().start();
    for axis in 1..=3 {
        spinner.put(&format!("torque.applied[{axis}]"), 0.0);
    }
    for k in 1..=10 {
        spinner.fire(k, false);
        spinner.put(&format!("thruster[{k}].onTime"), 0.0);
        spinner.put(&format!("thruster[{k}].onDelay"), 0.0);
    }
    spinner.to(1.0);
    assert_eq!(warnings(&mut spinner), "");
}

#[test]
fn what_the_l1_orbit_knows_is_not_missed() {
    let mut spinner = Spinner::new().set_integer("geometry.source", 2);
    ["sun.direction", "earth.direction"].iter().for_each(|name| put(&mut spinner, name, [0.0; 3]));
    let mut spinner = spinner.start();
    spinner.to(100.0);
    assert_eq!(warnings(&mut spinner), "");
    assert!(spinner.integer("spin.sunCrossings") > 0);
}
