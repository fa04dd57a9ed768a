//! First lines of `size` by hand: a constant torque on a craft that stands still, whose momentum grows with time alone.

use std::fs;

use crate::{run, says, shown, template};

/// Held in space in EME2000's axes, in the dark; torque by hand.
const CRAFT: &str = r#"
name = "Craft"
[mass_properties]
mass_kg = 300.0
center_of_mass_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [[90.0, 0.0, 0.0], [0.0, 70.0, 0.0], [0.0, 0.0, 60.0]]
[optics.paint]
specular = 0.0
diffuse = 0.3
[[boxes]]
name = "bus"
center_m = [0.0, 0.0, 0.0]
size_m = [1.0, 1.0, 1.0]
optics = "paint"
[start]
"orbit.center" = "sun"
"orbit.source" = "held"
"orbit.position" = [1.5e11, 0, 0]
"orbit.velocity" = [0, 30000, 0]
"attitude.source" = "commanded"
"command.q" = [0, 0, 0, 1]
"solar.flux" = 0
"torque.applied" = [2e-6, -3e-6, 1e-6]
"#;
const TORQUE_N_M: [f64; 3] = [2e-6, 3e-6, 1e-6];
const DAY_S: f64 = 86_400.0;
const YEAR_S: f64 = 365.25 * DAY_S;
const MARGIN: f64 = 1.3;
/// Two wheels along Y and Z, of different bias.
const PAIR: &str = "
[[wheels]]
axis = [0.0, 1.0, 0.0]
capacity_n_m_s = 4.0
bias_momentum_n_m_s = -3.0
[[wheels]]
axis = [0.0, 0.0, 1.0]
capacity_n_m_s = 4.0
";
const FORCE_N: f64 = 0.02;
const IMPULSE_S: f64 = 1500.0;
const POWER_W: f64 = 400.0;
const ARM_M: f64 = 0.8;

/// Couples about every axis both ways, each thruster for one of them.
fn ion_thrusters() -> String {
    let mut text = "[[tanks]]\nposition_m = [0.0, 0.0, 0.0]\npropellant_kg = 30.0\n".to_owned();
    for axis in 0..3 {
        for (arm, force) in [(1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)] {
            let (mut position, mut direction) = ([0.0; 3], [0.0; 3]);
            position[(axis + 1) % 3] = arm * ARM_M;
            direction[(axis + 2) % 3] = force;
            text.push_str(&format!(
                "[[thrusters]]\nposition_m = {position:?}\ndirection = {direction:?}\nforce_n = {FORCE_N}\n\
                 specific_impulse_s = {IMPULSE_S}\npower_w = {POWER_W}\n"
            ));
        }
    }
    text
}

/// What `size` prints of the craft with more in its file.
fn sized(more: &str, arguments: &[&str]) -> Option<String> {
    let (scratch, template) = template()?;
    let file = scratch.path().join("craft.toml");
    fs::write(&file, CRAFT.replacen("[start]", &format!("{more}\n[start]"), 1)).unwrap();
    let folder = scratch.path().join("sizing");
    let call =
        ["size", shown(&file), "--template", shown(&template), "--output", shown(&folder), "--budget", "0s"];
    Some(run(&[&call[..], arguments].concat(), 0))
}

/// The numbers of the first line.
fn first_line(text: &str) -> Vec<f64> {
    let line = text.lines().find(|line| line.starts_with("Craft: ")).unwrap();
    line.split([' ', ';', ',']).filter_map(|word| word.parse().ok()).collect()
}

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 1e-3 * expected.abs(), "{found} {expected}");
    }
}

/// About Y the bias leaves 1 N m s of 4; X is nobody's; without thrusters nothing is spent.
#[test]
fn a_pair_of_wheels_with_bias_without_thrusters() {
    let Some(text) = sized(PAIR, &["--duration", "40d"]) else { return };
    let gathered = TORQUE_N_M.map(|torque| torque * DAY_S);
    let lasting_s = 1.0 / (MARGIN * TORQUE_N_M[1]);
    let expected = [2.0, 3.0 + MARGIN * gathered[1], MARGIN * TORQUE_N_M[1], 1.0, lasting_s / DAY_S, 0.0];
    close(&first_line(&text), &expected);
    says(
        &text,
        &[
            "No wheel holds what gathers in 1 d: 0.1728 N.m.s about X",
            "dumps are ideal and take no propellant: the file has no [[thrusters]]",
            "[momentum] unload_every",
            "--slew, [momentum] slew",
        ],
    );
}

/// No wheels in the file: four in a pyramid, whose cube's corner loads one by 0.75 root 3.
#[test]
fn ion_thrusters_without_wheels() {
    let Some(text) = sized(&ion_thrusters(), &["--duration", "40d", "--every", "2d"]) else { return };
    let gathered = TORQUE_N_M.map(|torque| torque * 2.0 * DAY_S);
    let of_one = 0.75 * 3.0_f64.sqrt();
    let impulse = |span_s: f64| TORQUE_N_M.iter().map(|torque| torque * span_s).sum::<f64>();
    let year_kg = impulse(YEAR_S) / (ARM_M * IMPULSE_S * 9.80665);
    let [capacity, torque] = [gathered[1], TORQUE_N_M[1]].map(|it| MARGIN * it * of_one);
    close(&first_line(&text), &[4.0, capacity, torque, 2.0, year_kg]);
    // Both of a couple fire for the time of the longest axis; energy is power times all times.
    let minutes = gathered[1] / (2.0 * FORCE_N * ARM_M) / 60.0;
    let watt_hours = POWER_W * impulse(2.0 * DAY_S) / (FORCE_N * ARM_M) / 3600.0;
    let row = text.lines().find(|line| line.trim_start().starts_with("2 d")).unwrap();
    let cells: Vec<f64> = row.split_whitespace().skip(2).map(|cell| cell.parse().unwrap()).collect();
    close(&cells[3..], &[year_kg, minutes, watt_hours]);
    says(&text, &["7 d"]);
}

/// Twice the torque in the last of ten years: 15 times the first of propellant, and wheels for twice the momentum. A slew of 90 deg in
/// 10 min has the rate 2 angle / time and the acceleration 4 angle / time^2.
#[test]
fn a_slew_and_years_by_hand() {
    let (end, years) = ("torque.applied[2]=-6e-6", ["--years", "10", "--slew", "90 deg in 10 min"]);
    let more = ion_thrusters() + "[momentum]\nunload_every = \"12 h\"\n";
    let arguments =
        [&years[..], &["--end", end, "--end", "torque.applied[1]=4e-6", "--end", "torque.applied[3]=2e-6"]];
    let Some(text) = sized(&more, &[&arguments.concat()[..], &["--duration", "40d"]].concat()) else {
        return;
    };
    let angle = std::f64::consts::FRAC_PI_2;
    let (rate, acceleration) = (2.0 * angle / 600.0, 4.0 * angle / 360_000.0);
    let of_one = MARGIN * 0.75 * 3.0_f64.sqrt();
    let by_axis = |axis: usize| 2.0 * TORQUE_N_M[axis] * DAY_S / 2.0 + [90.0, 70.0, 60.0][axis] * rate;
    let capacity = of_one * by_axis(0).max(by_axis(1));
    let torque = of_one * (90.0 * acceleration + 4e-6);
    let first_kg = TORQUE_N_M.iter().sum::<f64>() * YEAR_S / (ARM_M * IMPULSE_S * 9.80665);
    close(
        &first_line(&text),
        &[4.0, capacity, torque, 12.0, first_kg, 2.0 * first_kg, 15.0 * first_kg, 10.0],
    );
}
