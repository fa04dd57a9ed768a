//! Settings that can be simulated but will disappoint are logged once, in the instance's log.

use model_description::Status;

use super::driver::Spinner;

fn warnings(spinner: &mut Spinner) -> String {
    spinner.fmu.drain_messages().into_iter().map(|message| message.text + "\n").collect()
}

#[test]
fn a_tank_that_runs_dry_says_so_once() {
    let mut spinner = Spinner::new().set("propellant.loaded", 0.01).set_integer("burn.plan", 4).start();
    assert_eq!(warnings(&mut spinner), "");
    spinner.fire(8, true);
    spinner.to(4.0);
    assert_eq!(warnings(&mut spinner), "");
    // 0.01 kg at 2.06 g/s are 4.85 s.
    spinner.to(8.0);
    let text = warnings(&mut spinner);
    assert!(text.contains("propellant ran out between 4 and 8 s"), "{text}");
    assert_eq!(spinner.real("propellant.used"), 0.01);
    assert!(!spinner.boolean("thruster[8].active"));
    spinner.to(12.0);
    assert_eq!(warnings(&mut spinner), "");
    let mut empty = Spinner::new().set("propellant.loaded", 0.0).set_integer("burn.plan", 4).start();
    assert!(warnings(&mut empty).contains("no propellant"));
    let text = Spinner::new().set("propellant.loaded", 0.001).refusal();
    assert!(text.contains("its propellant would be 0.0075") && text.contains("propellant.loaded"), "{text}");
    // The mass properties end at 195 kg.
    let mut full = Spinner::new();
    let at = full.at("propellant.loaded");
    assert_eq!(full.fmu.set_real(&[at], &[195.5]), Status::Discard);
    assert_eq!(full.fmu.set_real(&[at], &[195.0]), Status::Ok);
}

#[test]
fn a_burn_by_count_that_would_go_beyond_its_target_says_so() {
    let near = |z: f64| Spinner::new().set("burn.targetDirection[3]", z);
    // 114 pulses move 2.008 deg; the target is 2.3 deg or 1.9 deg away.
    assert_eq!(warnings(&mut near(2.3_f64.to_radians().tan().recip()).start()), "");
    let text = warnings(&mut near(1.9_f64.to_radians().tan().recip()).start());
    for part in ["114 pulses", "2.007", "1.9000 deg away"] {
        assert!(text.contains(part), "`{part}` is missing from: {text}");
    }
}

#[test]
fn a_burn_timed_by_a_sun_in_its_way_says_so() {
    let toward = |azimuth_deg: f64, angle_deg: f64, timing: i32| {
        let (azimuth, beta) = (azimuth_deg.to_radians(), 10.0_f64.to_radians());
        let mut spinner = Spinner::new()
            .set("sun.direction[1]", beta.sin() * azimuth.cos())
            .set("sun.direction[2]", beta.sin() * azimuth.sin())
            .set("sun.direction[3]", beta.cos())
            .set("burn.angle", angle_deg.to_radians())
            .set_integer("burn.timing", timing)
            .start();
        warnings(&mut spinner)
    };
    for (azimuth_deg, angle_deg, warned) in
        [(0.0, 2.0, false), (0.0, 9.95, true), (0.0, 30.0, true), (90.0, 30.0, false), (180.0, 30.0, false)]
    {
        let text = toward(azimuth_deg, angle_deg, 2);
        assert_eq!(text.contains("passes the Sun's line"), warned, "{azimuth_deg} {angle_deg}: {text}");
        assert!(!toward(azimuth_deg, angle_deg, 3).contains("burn"));
    }
    // As it comes the Sun is out of the way.
    assert_eq!(warnings(&mut Spinner::new().set_integer("burn.timing", 2).start()), "");
}
