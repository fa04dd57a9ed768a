//! Plans beat the paper's where the notes say they do, keep their limits, and say when nothing does.

use physics::attitude::Inertia;
use physics::environment::dates;
use physics::spin::{damper::Damper, forecast::Timing, geometry::L1Phases, spinner::Spinner, train::Shape};

use super::{
    ACE, RightAscensionDeclination, Task, TrainForecast, TurnRequest, best, campaign, frontier,
    longest_interval_s, trade, uniform_plan,
};
use crate::plans::spin::text::plan;

/// The request of a turn, from flags of the command with their values, each in its usual unit; a date has `_` in place of the blank.
pub(super) fn request(arguments: &str) -> TurnRequest {
    let mut it = TurnRequest {
        angle_deg: 2.0,
        direction_deg: -90.0,
        target: None,
        from: None,
        date: None,
        sun: None,
        earth: None,
        angle_tolerance_percent: 2.0,
        ratio: None,
        ratio_uncertainty: 0.0115,
        rate_rpm: None,
        rate_uncertainty_rpm: 0.0,
        thruster: None,
        timing: Timing::SunCrossing,
        sun_angle_deg: 10.0,
        max_nutation_deg: None,
        max_final_deg: None,
        max_duration_s: None,
        propellant_kg: None,
        spacecraft: None,
        template: None,
        campaign_s: None,
        rows: 12,
        output: None,
    };
    let mut words = arguments.split(['=', ' ']).filter(|word| !word.is_empty());
    while let (Some(flag), Some(value)) = (words.next(), words.next()) {
        let number = || -> f64 {
            let units = ["deg", "rpm", "min", "d"];
            let bare = units.iter().find_map(|unit| value.strip_suffix(unit)).unwrap_or(value);
            bare.parse().unwrap()
        };
        let place = || {
            let (ra, dec) = value.split_once(',').unwrap();
            let [right_ascension_deg, declination_deg] =
                [ra, dec].map(|angle| angle.strip_suffix("deg").unwrap().parse().unwrap());
            Some(RightAscensionDeclination { right_ascension_deg, declination_deg })
        };
        match flag {
            "--angle" => it.angle_deg = number(),
            "--direction" => it.direction_deg = number(),
            "--target" => it.target = place(),
            "--from" => it.from = place(),
            "--date" => it.date = Some(dates::epoch_s(&value.replace('_', " ")).unwrap()),
            "--sun" => it.sun = place(),
            "--earth" => it.earth = place(),
            "--angle-tolerance" => it.angle_tolerance_percent = number(),
            "--ratio" => it.ratio = Some(number()),
            "--ratio-uncertainty" => it.ratio_uncertainty = number(),
            "--rate" => it.rate_rpm = Some(number()),
            "--rate-uncertainty" => it.rate_uncertainty_rpm = number(),
            "--thruster" => it.thruster = Some(value.to_owned()),
            "--timing" => {
                it.timing = match value {
                    "clock" => Timing::Clock,
                    "phase" => Timing::TruePhase,
                    _ => Timing::SunCrossing,
                }
            }
            "--sun-angle" => it.sun_angle_deg = number(),
            "--max-nutation" => it.max_nutation_deg = Some(number()),
            "--max-final" => it.max_final_deg = Some(number()),
            "--max-duration" => it.max_duration_s = Some(60.0 * number()),
            "--propellant" => it.propellant_kg = Some(number()),
            "--spacecraft" => it.spacecraft = Some(value.into()),
            "--template" => it.template = Some(value.into()),
            "--campaign" => it.campaign_s = Some(86_400.0 * number()),
            "--rows" => it.rows = value.parse().unwrap(),
            _ => panic!("{flag}"),
        }
    }
    it
}

pub(super) fn ace() -> Spinner {
    Spinner::parse("ace.toml", ACE).unwrap()
}

pub(super) fn task(arguments: &str) -> Task {
    Task::new(&request(arguments), &ace()).unwrap()
}

/// A text has every one of the parts.
pub(super) fn assert_has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` is missing from: {text}");
    }
}

/// These flags have no plan, for a reason that has every one of the parts.
pub(super) fn refused(arguments: &str, parts: &[&str]) {
    assert_has(&plan(&request(arguments)).unwrap_err().to_string(), parts);
}

fn chosen(task: &Task) -> TrainForecast {
    best(&trade(task).unwrap()).unwrap().clone()
}

#[test]
fn the_papers_plan_is_its_114_pulses_in_22_6_min() {
    let row = uniform_plan(&task("--angle 2deg")).unwrap();
    assert_eq!(row.train.count, 114);
    assert!((row.duration_s / 60.0 - 22.6).abs() < 0.01);
    assert!((row.final_rad.to_degrees() - 0.0177).abs() < 1e-4);
    assert!((row.propellant_kg - 114.0 * 0.032 * 4.448 / (220.0 * 9.80665)).abs() < 1e-12);
}

#[test]
fn with_the_papers_peak_the_planner_finds_the_tapered_train_in_half_the_time() {
    let row = chosen(&task("--angle 2deg --max-nutation 0.02deg"));
    assert_eq!(row.train.shape, Shape::Tapered { order: 1 });
    assert_eq!(row.train.count, 58);
    assert!((row.duration_s / 60.0 - 11.4).abs() < 0.01);
    // Within 1.471 to 1.494 the bound of the notes.
    assert!(row.final_rad.to_degrees() < 0.0033 && row.peak_rad.to_degrees() < 0.02);
}

#[test]
fn the_best_plan_keeps_every_limit_and_no_other_that_does_has_less_nutation() {
    let task = task(
        "--angle 3deg --max-nutation 0.08deg --max-duration 10min --max-final 0.01deg --rate-uncertainty 0.1rpm",
    );
    let row = chosen(&task);
    assert!(row.fits && row.peak_rad <= task.limits.peak_rad && row.duration_s <= 600.0);
    for other in trade(&task).unwrap() {
        assert!(!other.fits || other.final_rad >= row.final_rad);
        assert!((other.moved_rad / task.angle_rad - 1.0).abs() <= 0.02);
    }
}

#[test]
fn a_clock_pays_for_a_spin_rate_that_is_not_known() {
    let sun = uniform_plan(&task("--angle 2deg --timing sun --rate-uncertainty 0.01rpm")).unwrap();
    let clock = uniform_plan(&task("--angle 2deg --timing clock --rate-uncertainty 0.01rpm")).unwrap();
    // 114 turns at 0.2 % are a quarter turn: the arcs fan out over it.
    assert!(sun.moved_range_rad.0 > 0.99 * sun.moved_rad);
    assert!(clock.moved_range_rad.0 < 0.95 * clock.moved_rad);
}

#[test]
fn the_frontier_holds_no_train_that_another_beats() {
    let rows = trade(&task("--angle 2deg")).unwrap();
    let frontier = frontier(&rows);
    assert!(frontier.len() >= 5 && frontier.len() < rows.len());
    for a in &frontier {
        for b in &rows {
            assert!(b.final_rad >= a.final_rad || b.peak_rad >= a.peak_rad || b.duration_s >= a.duration_s);
        }
    }
}

#[test]
fn plans_that_cannot_be_had_say_why() {
    refused("--max-nutation 0.001deg", &["no plan keeps the limits"]);
    refused("--max-duration 0.01min", &["shortest", "min"]);
    refused("--thruster V", &["IIIR", "spin up"]);
    refused("--thruster IR+ --angle 0deg", &["--angle is 0"]);
    refused("--spacecraft nowhere.toml", &["nowhere.toml"]);
    let text = Task::new(&TurnRequest { thruster: Some("thrust along +Z".into()), ..request("") }, &ace())
        .unwrap_err();
    assert!(text.to_string().contains("no torque across the spin axis"));
}

#[test]
fn bodies_and_angles_that_have_no_quiet_plan_are_refused_with_what_is_allowed() {
    refused("--angle 400deg", &["--angle is 400", "above 0 to 175 deg"]);
    refused("--angle 175.1deg", &["--angle is 175.1"]);
    for (ratio, range) in [
        ("0.9", "0.8885 to 0.9115"),
        ("1.0", "0.9885 to 1.0115"),
        ("1.01", "0.9985 to 1.0215"),
        ("1.995", "1.9835 to 2.0065"),
        ("2", "1.9885 to 2.0115"),
    ] {
        refused(&format!("--ratio {ratio}"), &[range, "above 1 and below 2", "--ratio-uncertainty", "grow"]);
        refused(&format!("--ratio {ratio} --campaign 10d"), &[range]);
    }
    refused("--ratio-uncertainty 0.5", &["0.98", "above 1"]);
    refused("--sun-angle 90deg", &["--sun-angle is 90", "below 90 deg"]);
    refused("--rate-uncertainty 5rpm", &["--rate-uncertainty is 5", "--rate"]);
    assert!(Task::new(&request("--angle 175deg --ratio 1.02"), &ace()).is_ok());
    // A body of its own may be as bad as a flag.
    let mut slim = ace();
    slim.mass_properties.inertia_ratio.iter_mut().for_each(|ratio| *ratio = 0.9);
    assert!(Task::new(&request(""), &slim).unwrap_err().to_string().contains("the inertia ratio I3/IT"));
}

#[test]
fn what_the_thruster_or_the_tank_cannot_give_is_refused_for_what_it_is() {
    refused(
        "--angle 0.001deg",
        &["--angle is 0.001", "2 %", "--angle-tolerance", "IIIR, 32 ms, moves 0.0176"],
    );
    refused("--rate 1e6rpm", &["IIIR", "0.032 s", "half a turn", "--rate"]);
    refused("--propellant=-3", &["--propellant is -3", "0 to 195 kg"]);
    refused("--propellant 1e6", &["--propellant is 1000000", "0 to 195 kg"]);
    // 2 deg take 7.5 g.
    refused("--propellant 0.005", &["no plan", "least propellant 0.007", "--propellant"]);
    let rows = trade(&task("--propellant 0.0071")).unwrap();
    let needs: Vec<f64> = rows.iter().map(|row| row.propellant_kg).collect();
    assert!(rows.iter().any(|row| row.fits) && rows.iter().any(|row| !row.fits), "{needs:?}");
    assert!(rows.iter().all(|row| row.fits == (row.propellant_kg <= 0.0071)));
}

#[test]
fn opposite_thrusters_are_of_one_size() {
    let rows = |spinner: &Spinner| trade(&Task::new(&request("--thruster IIIR"), spinner).unwrap()).unwrap();
    assert!(rows(&ace()).iter().any(|row| row.train.alternates()));
    // A weaker opposite leaves none, though IIIA pushes the same way: with 0.69 m.
    let weaker = ACE.replacen("name = \"IVR\"\nforce_n = 4.448", "name = \"IVR\"\nforce_n = 4.0", 1);
    let spinner = Spinner::parse("my.toml", &weaker).unwrap();
    assert!(rows(&spinner).iter().all(|row| !row.train.alternates()));
}

#[test]
fn a_longer_turn_of_a_slow_spinner_counts_against_the_time() {
    // 57 turns take 11.40 min at 5 rpm and 11.63 min at 4.9 rpm.
    let fits = |arguments: &str| {
        let task = task(&format!("--max-duration 11.5min {arguments}"));
        super::evaluate(&task, Shape::Tapered { order: 1 }, 1, 1.0).unwrap().fits
    };
    assert!(fits("") && !fits("--rate-uncertainty 0.1rpm"));
    assert!(fits("--rate-uncertainty 0.1rpm --timing clock"));
}

/// Nutation of a body with a ratio below 1 grows under the damper that the table's times count on.
#[test]
fn below_a_ratio_of_1_the_damper_does_the_opposite() {
    let angle_after = |ratio: f64| {
        let inertia = Inertia::new([353.82 / ratio, 353.82 / ratio, 353.82]).unwrap();
        Damper::new(34_200.0, &inertia).angle_after_rad(1e-3, 3_600.0)
    };
    assert!(angle_after(0.9) > 1e-3 && angle_after(1.48) < 1e-3);
}

#[test]
fn a_plan_says_whether_it_was_simulated_again() {
    // Tests run in the crate's folder, where nothing is packed.
    assert_has(&plan(&request("--angle 2deg")).unwrap().text, &["Not re-simulated: no dist/SpinPlant.fmu"]);
    let own = "../../fmu-src/resources/ace.toml";
    let text = plan(&TurnRequest { spacecraft: Some(own.into()), ..request("--angle 2deg") }).unwrap().text;
    assert_has(&text, &["Not re-simulated", "another spacecraft"]);
    refused("--template nowhere.fmu", &["nowhere.fmu"]);
}

#[test]
fn without_a_lissajous_the_deadband_lasts_the_papers_6_1_days() {
    let mut spinner = ace();
    spinner.l1_orbit.amplitude_m = [0.0; 3];
    let task = task("--angle 2deg");
    let (phases, duration_s) = (L1Phases::default(), 60.0 * 86_400.0);
    let longest = longest_interval_s(&spinner, &phases, duration_s).unwrap();
    assert!((longest / 86_400.0 - 6.1).abs() < 0.02, "{}", longest / 86_400.0);
    let row = campaign(&spinner, &task, &phases, [duration_s, 2.0 * 86_400.0], &mut || ()).unwrap();
    assert_eq!(row.count, 29);
    assert!((row.mean_rad.to_degrees() - 2.0 * 0.9829).abs() < 1e-6);
    assert!(row.holds && row.science_lost_s <= row.science_lost_uniform_s);
}

#[test]
fn a_campaign_keeps_its_limits_and_its_days() {
    // Uniform trains take 22.6 min for 2 deg, tapered ones half of it at most.
    refused("--campaign 20d --max-nutation 0.001deg", &["no plan keeps the limits"]);
    let (spinner, phases, days) = (ace(), L1Phases::default(), 30.0 * 86_400.0);
    let cadence = |arguments: &str| {
        campaign(&spinner, &task(arguments), &phases, [days, 2.0 * 86_400.0], &mut || ()).unwrap()
    };
    let (free, bound) = (cadence(""), cadence("--max-nutation 0.02deg"));
    assert!(bound.manoeuvring_s > free.manoeuvring_s && bound.largest_rad == free.largest_rad);
    // No row and no interval is longer than the campaign.
    let text = plan(&request("--campaign 3d")).unwrap().text;
    assert!(
        text.contains("2.00 d") && !text.contains("4.00 d") && text.contains("No turn is needed"),
        "{text}"
    );
    for days in ["0", "-1", "3654", "1e6"] {
        refused(&format!("--campaign={days}d"), &["--campaign is", "above 0 to 3653 days"]);
    }
    let mut passed = 0;
    campaign(&spinner, &task(""), &phases, [days, 2.5 * 86_400.0], &mut || passed += 1).unwrap();
    assert_eq!(passed, super::windows(days, 2.5 * 86_400.0));
}

#[test]
fn the_line_of_the_best_plan_says_what_it_misses_and_how_much_it_nutates() {
    // None that is as quick keeps the period variation of the file: the plan is the best of those that the flags leave.
    let text = plan(&request("--angle 2deg --max-duration 8min")).unwrap().text;
    let line = text.lines().find(|line| line.starts_with("Least final nutation")).unwrap();
    assert_has(
        line,
        &["moves 1.9676 of 2.0000 deg (-1.6 %)", "peak nutation 0.14135 deg", "8.0 times the uniform plan's"],
    );
}

#[test]
fn months_of_pointing_on_the_lissajous_orbit_keep_earth_and_sun() {
    let text = plan(&request("--campaign 120d")).unwrap().text;
    assert_has(&text, &["Longest interval", "kept", "broken"]);
}
