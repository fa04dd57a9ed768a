//! Days follow in closed form from constant torques; what is no recording is refused.
use super::*;

fn mission(text: &str) -> Result<Mission, String> {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("simulated.csv");
    std::fs::write(&path, text).unwrap();
    Mission::read(&path)
}

/// Constant torque over days, a row each hour.
fn constant(torque_n_m: [f64; 3], days: usize) -> Mission {
    let mut text = "time,torque.total[1],torque.total[2],torque.total[3]\n".to_owned();
    for hour in 0..=24 * days {
        let [x, y, z] = torque_n_m;
        text += &format!("{},{x},{y},{z}\n", hour * 3600);
    }
    mission(&text).unwrap()
}

#[test]
fn a_constant_torque_is_held_as_long_as_its_excess_takes() {
    let square = Region::hull([[-1e-6, -1e-6], [1e-6, -1e-6], [1e-6, 1e-6], [-1e-6, 1e-6]]);
    // 0.5e-6 N m too much from the one edge of the band to the other; all of it from 0.
    let simulated = constant([1.5e-6, 0.2e-6, 0.9e-6], 200);
    let held = simulated.held(&square, 1.0, [2.0, 2.0, 3.0]);
    let managed_d = 2.0 / 0.5e-6 / DAY_S;
    assert!((held.managed_d.unwrap() - managed_d).abs() < 1.0 / 24.0 + 1e-9, "{held:?}");
    assert!((held.unmanaged_d.unwrap() - 2.0 / 1.5e-6 / DAY_S).abs() < 1.0 / 24.0 + 1e-9);
    assert!((held.y_d.unwrap() - 2.0 / 0.2e-6 / DAY_S).abs() < 1.0 / 24.0 + 1e-9);
    // Twice the light holds it.
    assert_eq!(simulated.held(&square.scaled(2.0, [0.0; 2]), 1.0, [2.0, 2.0, 3.0]).managed_d, None);
    assert!((simulated.mean_torque_n_m()[0] - 1.5e-6).abs() < 1e-18);
}

#[test]
fn a_torque_that_swings_is_held_where_its_peak_less_what_downlinks_give_is() {
    // 20 days at +2e-6, 20 days at -2e-6: alone up to 3.456 N m s, with 1e-6 undone up to 1.728.
    let mut text = "time,torque.total[1],torque.total[2],torque.total[3]\n".to_owned();
    for hour in 0..=24 * 40 {
        let x = if hour < 480 { 2e-6 } else { -2e-6 };
        text += &format!("{},{x},0,0\n", hour * 3600);
    }
    let simulated = mission(&text).unwrap();
    let segment = Region::hull([[-1e-6, 0.0], [1e-6, 0.0]]);
    assert_eq!(simulated.held(&segment, 1.0, [1.74, 9.0, 9.0]).managed_d, None);
    assert!(simulated.held(&segment, 1.0, [1.70, 9.0, 9.0]).managed_d.unwrap() > 19.0);
}

#[test]
fn dumps_are_taken_out_of_momentum() {
    let mut text = "time,momentum.body[1],momentum.body[2],momentum.body[3],dump.count\n".to_owned();
    for row in 0..100 {
        let (gathered, dumps) = (f64::from(row) * 0.1, row / 30);
        text += &format!("{},{},0,0,{dumps}\n", row * 600, gathered - 3.05 * f64::from(dumps));
    }
    let simulated = mission(&text).unwrap();
    assert!((simulated.gathered_n_m_s[99][0] - 9.9).abs() < 1e-12);
    assert_eq!(simulated.dumps, Some(3.0));
}

#[test]
fn what_is_no_recording_is_refused_by_name() {
    let head = "time,torque.total[1],torque.total[2],torque.total[3]";
    for (text, expected) in [
        ("time,x\n0,1\n1,2\n".to_owned(), "torque.total[1] to [3]"),
        (
            "time,momentum.body[1],momentum.body[2],momentum.body[3]\n0,1,1,1\n1,1,1,1\n".to_owned(),
            "dump.count",
        ),
        (format!("{head}\n0,1,2,3\n"), "two rows"),
        (format!("{head}\n1,1,2,3\n0,1,2,3\n"), "times rise"),
        (format!("{head}\n0,1,2,3\n1,1,nan,3\n"), "simulated.csv:3: torque.total[2]: found \"nan\""),
        (format!("{head},sun.distance\n0,1,2,3,1\n1,1,2,3,0\n"), "sun.distance above 0"),
        ("x\n1\n2\n".to_owned(), "column time"),
    ] {
        let refused = mission(&text).err().unwrap();
        assert!(refused.contains(expected) && refused.contains("--recording"), "{text}: {refused}");
    }
}
