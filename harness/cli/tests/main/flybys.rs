//! `plan` with `[flyby]` through the FMU: the steps of paper 003, and what is out of reach.

use std::{fs, path::Path};

use nalgebra::{Matrix2, Matrix6, Rotation2, Vector2, Vector3};
use serde_json::Value;

use crate::{heliotorque, is_long, legs::flyby, momentum_plans::columns, run, says, shown, template};

const LIMIT_N_M_S: f64 = 5.5;

/// Carries a plan out; what is said.
#[track_caller]
pub(crate) fn plan(file: &Path, output: &Path, template: &Path, status: i32) -> String {
    run(&["plan", shown(file), "--output", shown(output), "--template", shown(template)], status)
}

fn json(folder: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join("plan.json")).unwrap()).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect()
}

/// An error of the velocity at a departure on the leg to the second flyby, and when its correction begins.
struct Departure {
    /// Date, and the days from the shipped leg's departure to it.
    date: &'static str,
    after_d: u32,
    /// Error along X.
    error_m_s: f64,
    corrected_from: &'static str,
    /// Range of the miss along T that the error leads to.
    miss_m: std::ops::Range<f64>,
}

/// Paper 003: 170 km, corrected from 111 d before on.
const OF_THE_PAPER: Departure = Departure {
    date: "2008-03-19T00:00:00 UTC",
    after_d: 0,
    error_m_s: 0.0404,
    corrected_from: "2008-06-17 UTC",
    miss_m: -1.9e5..-1.5e5,
};

/// The same in the last quarter of the leg: 40 km, corrected from 40 d before on.
const LATE: Departure = Departure {
    date: "2008-08-16T00:00:00 UTC",
    after_d: 150,
    error_m_s: -0.02,
    corrected_from: "2008-08-27 UTC",
    miss_m: -4.5e4..-3.5e4,
};

/// The leg to the second flyby from a departure on: mission and leg begin where the shipped mission is then.
fn leg_from(folder: &Path, template: &Path, departure: &Departure) {
    flyby(folder, 2, &[]);
    if departure.after_d == 0 {
        return;
    }
    let stop = format!("{}d", departure.after_d);
    let output = folder.join("state.csv");
    let arguments =
        ["--record", "position,velocity", "--every", &stop, "--output", shown(&output), "--quiet"];
    let mission = folder.join("flyby.toml");
    run(
        &[&["run", shown(&mission), "--template", shown(template), "--stop", &stop][..], &arguments].concat(),
        0,
    );
    let state = |name: &str| {
        let names = [1, 2, 3].map(|axis| format!("{name}[{axis}]"));
        columns(&output, &names.each_ref().map(String::as_str)).pop().unwrap()
    };
    let (position, velocity) = (state("position"), state("velocity"));
    let replaced = |file: &str, values: &[(&str, String)]| {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        let line = |line: &str| {
            let value = values.iter().find(|(key, _)| line.starts_with(&format!("{key} = ")));
            value.map_or_else(|| line.to_owned(), |(key, value)| format!("{key} = {value}"))
        };
        fs::write(folder.join(file), text.lines().map(line).collect::<Vec<_>>().join("\n")).unwrap();
    };
    let date = format!("{:?}", departure.date);
    let mission = [
        ("start", date.clone()),
        ("stop", format!("\"{} d\"", 203 - departure.after_d)),
        ("\"orbit.position\"", format!("{position:?}")),
        ("\"orbit.velocity\"", format!("{velocity:?}")),
    ];
    replaced("flyby.toml", &mission);
    let leg = fs::read_to_string(folder.join("leg.toml")).unwrap();
    let leg = leg.replace(&format!("at = {:?}", OF_THE_PAPER.date), &format!("at = {date}"));
    fs::write(folder.join("leg.toml"), leg.replace("revolutions = 1\nbranch = \"left\"\n", "")).unwrap();
    replaced("leg.toml", &[("position", format!("{position:?}"))]);
}

/// Momentum of the leg from a departure on, planned in windows of ten days, and the leg to 200 km with that plan: `leg/mission.toml`.
fn led(folder: &Path, template: &Path, momentum: &str, departure: &Departure) {
    leg_from(folder, template, departure);
    let text = format!("mission = \"flyby.toml\"\nfreeze = 0\nwindow = \"10 d\"\n{momentum}");
    fs::write(folder.join("momentum.toml"), text).unwrap();
    plan(&folder.join("momentum.toml"), &folder.join("momentum"), template, 0);
    let leg = fs::read_to_string(folder.join("leg.toml")).unwrap();
    fs::write(folder.join("leg.toml"), leg.replace("\"flyby.toml\"", "\"momentum/mission.toml\"")).unwrap();
    plan(&folder.join("leg.toml"), &folder.join("leg"), template, 0);
}

/// Velocity of the leg at its departure, moved along X by an error in m/s.
fn velocity(folder: &Path, error_m_s: f64) -> String {
    let text = fs::read_to_string(folder.join("leg/mission.toml")).unwrap();
    let mut velocity = vector(&text, "orbit.velocity");
    velocity[0] += error_m_s;
    format!("{velocity:?}")
}

/// A vector of a mission's text.
fn vector(text: &str, name: &str) -> Vec<f64> {
    let line = text.lines().find(|line| line.starts_with(&format!("\"{name}\""))).unwrap();
    let list = line.split_once('[').unwrap().1.trim_end_matches(']');
    list.split(',').map(|it| it.trim().parse().unwrap()).collect()
}

/// Outputs of an encounter.
const ENCOUNTER: [&str; 5] =
    ["time", "encounter.bT", "encounter.bR", "encounter.lastTime", "encounter.lastAltitude"];

/// Rows of a simulated mission, ten minutes apart or less: an encounter's, behind them `outputs`.
fn simulated(
    mission: &Path,
    template: &Path,
    (step, more): (&str, &[&str]),
    outputs: &[&str],
) -> Vec<Vec<f64>> {
    let output = mission.with_extension("passed.csv");
    let names = [&ENCOUNTER[..], outputs].concat();
    let record = names[1..].join(",");
    let arguments = [
        &["run", shown(mission), "--template", shown(template), "--every", "600", "--quiet"][..],
        &["--step", step, "--record", &record, "--output", shown(&output)],
        more,
    ];
    run(&arguments.concat(), 0);
    columns(&output, &names)
}

/// B along T and R in km of rows, six hours before their closest approach, and the altitude there: between rows ten minutes apart B is
/// linear to 5 m.
fn encounter(rows: &[Vec<f64>]) -> [f64; 3] {
    let last = rows.last().unwrap();
    let at_s = last[3] - 21_600.0;
    let after = rows.partition_point(|row| row[0] <= at_s);
    let share = (at_s - rows[after - 1][0]) / (rows[after][0] - rows[after - 1][0]);
    let at = |column: usize| {
        1e-3 * (rows[after - 1][column] + share * (rows[after][column] - rows[after - 1][column]))
    };
    [at(1), at(2), 1e-3 * last[4]]
}

fn passed(mission: &Path, template: &Path, (step, more): (&str, &[&str])) -> [f64; 3] {
    encounter(&simulated(mission, template, (step, more), &[]))
}

/// Outputs that the limits of a plan apply to, after those of the encounter.
const KEPT: [&str; 9] = [
    "momentum.inertial[1]",
    "momentum.inertial[2]",
    "momentum.inertial[3]",
    "sun.azimuth",
    "sun.elevation",
    "panel[1].corridorMargin",
    "panel[2].corridorMargin",
    "dump.count",
    "downlink.alternate",
];

/// Of every window; the alternate attitude may have what they leave.
const CONTACTS: f64 = 0.3;
const TILT_DEG: [f64; 2] = [10.0, 12.0];

/// Limits of the plan in a folder by the rows of its input table: momentum, tilts, corridor, no dump, contacts.
fn keeps(folder: &Path, rows: &[Vec<f64>]) {
    let jumps = columns(&folder.join("plan.csv"), &["time"]).concat();
    for row in rows {
        let [h_x, h_y, h_z, azimuth, elevation, first_suns, second_suns, dumps, _] = row[5..] else {
            panic!()
        };
        let size_n_m_s = Vector3::new(h_x, h_y, h_z).norm();
        assert!(size_n_m_s < LIMIT_N_M_S && dumps == 0.0, "{row:?}");
        let tilts_deg = [azimuth, elevation].map(|tilt| tilt.to_degrees().abs());
        assert!(tilts_deg.iter().zip(TILT_DEG).all(|(tilt, most)| *tilt < most + 1e-6), "{row:?}");
        // The row of a jump has the arrays from before it. Their bounds are those of the flight that is to be corrected, 180 km from this
        // one along the Sun line: 10 s on the way.
        let least_suns = if jumps.contains(&row[0]) { -1e-4 } else { 0.0 };
        assert!(first_suns.min(second_suns) > least_suns, "{row:?}");
    }
    let mut greatest = 0.0_f64;
    let windows = columns(&folder.join("windows.csv"), &["start_s", "stop_s", "alternate_share"]);
    // The first is frozen: the plan before has it.
    for window in &windows[1..] {
        let within = rows.iter().filter(|row| (window[0]..window[1]).contains(&row[0]));
        let (count, alternate) = within.fold((0.0, 0.0), |(count, sum), row| (count + 1.0, sum + row[13]));
        let share = alternate / count;
        // A stretch a day, whose edges lie between rows.
        let row_of_a_day = 600.0 / 86_400.0;
        assert!((share - window[2]).abs() < row_of_a_day, "{share} {window:?}");
        assert!(share < 1.0 - CONTACTS + row_of_a_day, "{share} {window:?}");
        greatest = greatest.max(share);
    }
    println!("alternate up to {greatest} of a window");
    assert!(greatest > 0.65, "contacts limit none of them: {greatest}");
}

/// Momentum planned, departure led to 200 km with that plan, an error there that is corrected: `plan.toml`, with more about the flyby.
fn departed(folder: &Path, template: &Path, departure: &Departure, flyby: &str) {
    let momentum = "contactShare = 0.3\n[momentum]\nlimit = \"5.3 N.m.s\"\n[tilt]\nazimuth = \"5 deg\"\nelevation = \"6 deg\"\n";
    led(folder, template, momentum, departure);
    let [azimuth_deg, elevation_deg] = TILT_DEG;
    let text = format!(
        "mission = \"leg/mission.toml\"\nwindow = \"10 d\"\nalternation = 1\ncontactShare = {CONTACTS}\n\
         [momentum]\nlimit = \"{LIMIT_N_M_S} N.m.s\"\n[tilt]\nazimuth = \"{azimuth_deg} deg\"\nelevation = \"{elevation_deg} deg\"\n\
         [sunOffset]\nchange = true\nlargest = \"20 deg\"\n\
         [flyby]\nbody = \"mercury\"\naltitude = \"200 km\"\nangle = 0\nfrom = {:?}\n{flyby}\
         [update]\nat = {:?}\nvelocity = {}\n[compare]\nnext = \"2009-09-29 UTC\"\n",
        departure.corrected_from,
        departure.date,
        velocity(folder, departure.error_m_s)
    );
    fs::write(folder.join("plan.toml"), text).unwrap();
}

#[test]
fn the_steps_of_the_paper_lead_back_to_the_aim() {
    let Some((_packed, template)) = template() else { return };
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let departure = if is_long() { OF_THE_PAPER } else { LATE };
    departed(folder, &template, &departure, "");
    let output = folder.join("out");
    let printed = plan(&folder.join("plan.toml"), &output, &template, 0);
    says(
        &printed,
        &[
            "Mercury, 6 h before closest approach: aim B.T",
            "the mission as it is misses by -",
            "departure manoeuvre",
        ],
    );
    let picture = fs::read_to_string(output.join("plan.svg")).unwrap();
    says(&picture, &["hyperbola osculating 6 h before closest approach"]);
    let found = json(&output);
    assert_eq!(found["status"], "planned");
    let [before, after] = ["missBefore_m", "missAfter_m"].map(|key| numbers(&found[key]));
    println!(
        "miss before {before:?}, after {after:?} m, rounds {}, |H| {}",
        found["rounds"], found["largestMomentum"]
    );
    assert!(departure.miss_m.contains(&before[0]) && before[1].abs() < 1e4, "{before:?}");
    assert!(after[0].hypot(after[1]) < 1e3);
    assert!(found["rounds"].as_f64().unwrap() <= 5.0);
    assert!(found["largestMomentum"]["simulated"].as_f64().unwrap() < LIMIT_N_M_S);
    // Simulated on its own, by timeline and by input table: the corridor is a limit of the mission, whose break is status 1.
    let mission = output.join("mission.toml");
    let by_timeline = passed(&mission, &template, ("600s", &[]));
    let aim_km = numbers(&found["aim_m"])[0] / 1e3;
    assert!((by_timeline[0] - aim_km).hypot(by_timeline[1]) < 1.0, "{by_timeline:?} {aim_km}");
    assert!((by_timeline[2] - 200.0).abs() < 1.0);
    let text = fs::read_to_string(&mission).unwrap();
    let table = text.replace("timeline = \"timeline.toml\"\n", "").replace("\"timeline\"", "\"command\"");
    // At the jump of the arrays the corridor is left, see `keeps`.
    let table = table.split("\n[limits]").next().unwrap();
    fs::write(output.join("table.toml"), table).unwrap();
    let inputs = output.join("plan.csv");
    let rows = simulated(&output.join("table.toml"), &template, ("60s", &["--input", shown(&inputs)]), &KEPT);
    keeps(&output, &rows);
    let by_table = encounter(&rows);
    let apart_m = [0, 1, 2].map(|column| 1e3 * (by_table[column] - by_timeline[column]));
    println!("by table less by timeline {apart_m:?} m");
    assert!(apart_m.iter().all(|apart_m| apart_m.abs() < 0.1), "{by_table:?} {by_timeline:?}");
    // Paper: 80 m/s for such a miss, 0.72 m/s a km here.
    let departure = &found["maneuvers"]["departure"];
    let cost = departure["withoutCorrection_m_s"].as_f64().unwrap();
    assert!((cost / (before[0].abs() / 1e3) - 0.72).abs() < 0.15, "{cost}");
    assert!(departure["behindPlan_m_s"].as_f64().unwrap() < 1.0);
}

/// The error of the departure makes it two minutes late.
#[test]
fn an_arrival_that_is_fixed_is_met_to_a_fifth_of_a_second() {
    if !is_long() {
        return;
    }
    let Some((_packed, template)) = template() else { return };
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    departed(folder, &template, &OF_THE_PAPER, "arrival = \"fixed\"\ntime = \"2008-10-06T08:40:00 UTC\"\n");
    let output = folder.join("out");
    plan(&folder.join("plan.toml"), &output, &template, 0);
    let found = json(&output);
    let late_s = ["lateBefore_s", "lateAfter_s"].map(|key| found[key].as_f64().unwrap());
    let miss_m = numbers(&found["missAfter_m"]);
    println!("late by {late_s:?} s, off by {miss_m:?} m, rounds {}", found["rounds"]);
    assert!(late_s[0] > 60.0 && late_s[1].abs() < 0.2, "{late_s:?}");
    assert!(miss_m[0].hypot(miss_m[1]) < 1e3, "{miss_m:?}");
}

/// Near conjunctions the spacecraft rolls within hours: cells of a day follow its sunlight as those of two hours do.
#[test]
fn cells_of_a_day_and_of_two_hours_lead_to_the_same_encounter() {
    let Some((_packed, template)) = template() else { return };
    let folder = tempfile::tempdir().unwrap();
    flyby(folder.path(), 2, &[]);
    let of = |settings: &[&str]| passed(&folder.path().join("flyby.toml"), &template, ("600s", settings));
    let [days, hours] = [of(&[]), of(&["--set", "orbit.nBodyStep=7200"])];
    let apart_m = (days[0] - hours[0]).hypot(days[1] - hours[1]) * 1e3;
    println!("{apart_m} m apart");
    assert!(apart_m < 1.0);
}

/// Tilts of the first window leave the direction of the initial momentum of 4 N m s.
#[test]
fn a_plan_that_tilts_from_the_start_on_leaves_the_momentum_there() {
    let Some((_packed, template)) = template() else { return };
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    flyby(folder, 2, &[]);
    let mission = fs::read_to_string(folder.join("flyby.toml")).unwrap();
    let with_momentum = mission.replace("[set]\n", "[set]\n\"start.momentum\" = [2.0, -2.0, 2.8]\n");
    assert_ne!(mission, with_momentum);
    fs::write(folder.join("flyby.toml"), with_momentum.replace("stop = ", "stop = \"20 d\" # ")).unwrap();
    let text = "mission = \"flyby.toml\"\nfreeze = 0\nwindow = \"5 d\"\nalternation = 0\nwindmill = 0\n\
                [momentum]\nlimit = \"4.1 N.m.s\"\n[tilt]\nazimuth = \"10 deg\"\nelevation = \"10 deg\"\n";
    fs::write(folder.join("plan.toml"), text).unwrap();
    let output = folder.join("out");
    plan(&folder.join("plan.toml"), &output, &template, 0);
    let names = ["momentum.inertial[1]", "momentum.inertial[2]", "momentum.inertial[3]", "sun.elevation"];
    let first = |mission: &Path| {
        let rows = mission.with_extension("first.csv");
        let record = names.join(",");
        let arguments = ["--every", "1d", "--record", &record, "--output", shown(&rows), "--quiet"];
        run(&[&["run", shown(mission), "--template", shown(&template)][..], &arguments].concat(), 0);
        columns(&rows, &names).remove(0)
    };
    let [untilted, tilted] = [folder.join("flyby.toml"), output.join("mission.toml")].map(|it| first(&it));
    println!("{untilted:?} {tilted:?}");
    let apart = (0..3).map(|axis| (tilted[axis] - untilted[axis]).abs()).fold(0.0, f64::max);
    assert!((tilted[3] - untilted[3]).abs() > 1.0_f64.to_radians(), "the plan does not tilt");
    assert!(apart < 1e-5, "{apart} N m s apart");
}

/// The lower root of a covariance: 3 km, 1 cm/s, the velocity along Y correlated with the position along X.
fn root() -> Matrix6<f64> {
    let deviations = [3e3, 3e3, 3e3, 1e-2, 1e-2, 1e-2];
    let mut root = Matrix6::from_diagonal(&deviations.into());
    (root[(4, 0)], root[(4, 4)]) = (8e-3, 6e-3);
    root
}

const RUNS: u32 = 100;
const SCALE: f64 = 0.02;
const CENTER_OF_MASS_M: f64 = 2e-3;
/// What 90 % of a normal distribution do not exceed, in deviations.
const MOST: f64 = 1.281_55;

/// From ten days before the encounter on: the ellipse and the spread of |H| are those of the flights that each column of the covariance's
/// root leads to, and each coordinate of the centre of mass; the percentiles are alike for one thread and two.
#[test]
fn dispersed_flights_spread_as_the_covariance_says_on_any_number_of_threads() {
    let Some((_packed, template)) = template() else { return };
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    flyby(folder, 2, &[]);
    let covariance = root() * root().transpose();
    let row = |row: usize| covariance.row(row).iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    fs::write(folder.join("covariance.csv"), (0..6).map(row).collect::<Vec<_>>().join("\n")).unwrap();
    let text = format!(
        "mission = \"flyby.toml\"\nfreeze = 0\nwindow = \"10 d\"\nalternation = 0\nwindmill = 0\n\
         [momentum]\nlimit = \"1e6 N.m.s\"\n[tilt]\nazimuth = \"10 deg\"\nelevation = \"10 deg\"\n\
         [flyby]\nbody = \"mercury\"\naltitude = \"200 km\"\nangle = 0\ntolerance = \"5 km\"\n\
         [update]\nat = \"2008-09-26 UTC\"\ncovariance = \"covariance.csv\"\n\
         [montecarlo]\nruns = {RUNS}\nseed = 3\nscale = {SCALE}\ncenterOfMass = {CENTER_OF_MASS_M}\n"
    );
    let file = folder.join("plan.toml");
    fs::write(&file, text).unwrap();
    let of_threads = ["1", "2"].map(|threads| {
        let output = folder.join(threads);
        let arguments = ["plan", shown(&file), "--output", shown(&output), "--template", shown(&template)];
        let done = heliotorque(&arguments).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert_eq!(done.status.code(), Some(0), "{}", crate::text(&done));
        json(&output)
    });
    let [found, other] = &of_threads;
    let dispersions = &found["dispersions"];
    assert_eq!(dispersions, &other["dispersions"]);
    assert_eq!((&dispersions["runs"], &dispersions["failed"]), (&RUNS.into(), &Value::Array(Vec::new())));
    // What each column leads to, sunlight, and each coordinate of the centre of mass.
    let mission = folder.join("1/mission.toml");
    let text = fs::read_to_string(&mission).unwrap();
    let [position, velocity] = ["orbit.position", "orbit.velocity"].map(|name| vector(&text, name));
    // B along T and R in m, and the greatest |H| in N m s.
    let passed = |settings: &[String]| {
        let more: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting.as_str()]).collect();
        let rows = simulated(&mission, &template, ("600s", &more), &KEPT[..3]);
        let [b_t, b_r, _] = encounter(&rows);
        let greatest = rows.iter().map(|row| Vector3::new(row[5], row[6], row[7]).norm()).fold(0.0, f64::max);
        (Vector2::new(1e3 * b_t, 1e3 * b_r), greatest)
    };
    let set = |name: &str, at: &[f64], off: &[f64]| {
        let values: Vec<String> = at.iter().zip(off).map(|(at, off)| (at + off).to_string()).collect();
        format!("{name}={}", values.join(","))
    };
    let (nominal, nominal_n_m_s) = passed(&[]);
    let root = root();
    let moved = root.column_iter().map(|column| {
        let off = column.as_slice();
        let sets = [set("orbit.position", &position, &off[..3]), set("orbit.velocity", &velocity, &off[3..])];
        passed(&sets)
    });
    let by_center_of_mass = (0..3).map(|axis| {
        let off: [f64; 3] = core::array::from_fn(|it| if it == axis { CENTER_OF_MASS_M } else { 0.0 });
        passed(&[set("spacecraft.centerOfMass", &[0.01, 0.02, 0.03], &off)])
    });
    let by_center_of_mass: Vec<_> = by_center_of_mass.collect();
    let moved: Vec<_> = moved.chain([passed(&[format!("solar.scale={}", 1.0 + SCALE)])]).collect();
    let all = || moved.iter().chain(&by_center_of_mass);
    let expected: Matrix2<f64> =
        all().map(|(moved, _)| (moved - nominal) * (moved - nominal).transpose()).sum();
    let expected_n_m_s = all().map(|(_, greatest)| (greatest - nominal_n_m_s).powi(2)).sum::<f64>().sqrt();
    let [half, most] =
        ["50", "90"].map(|share| dispersions["percentiles"]["momentum_n_m_s"][share].as_f64().unwrap());
    println!("momentum {half} and {most} of {nominal_n_m_s} N m s, deviation expected {expected_n_m_s}");
    // Of so many flights the difference of the two percentiles is known to 13 %. Without the centre of mass it were 0.4 of this.
    assert!(((most - half) / (MOST * expected_n_m_s) - 1.0).abs() < 0.4);
    let ellipse = &dispersions["ellipse"];
    let semi_axes = Vector2::from_vec(numbers(&ellipse["semiAxes_m"]));
    let turn = Rotation2::new(ellipse["angle_deg"].as_f64().unwrap().to_radians()).into_inner();
    let spread = turn * Matrix2::from_diagonal(&semi_axes.component_mul(&semi_axes)) * turn.transpose();
    let mean = Vector2::from_vec(numbers(&dispersions["mean_m"]))
        - Vector2::from_vec(numbers(&found["missAfter_m"]));
    let inverse = expected.try_inverse().unwrap();
    // The sum of squares of N flights is chi-squared with 2 (N - 1) degrees of freedom, that of the mean with 2.
    let squares = (inverse * spread).trace() / 2.0;
    let of_mean = f64::from(RUNS) * mean.dot(&(inverse * mean));
    println!("squares {squares} of 1, of the mean {of_mean} of 2; semi-axes {semi_axes:?} m");
    assert!((squares - 1.0).abs() < 4.0 / f64::from(RUNS - 1).sqrt());
    assert!(of_mean < 20.0);
}

/// A plan without an aim says where the mission passes, by what state that changes, and what a miss costs; nothing is planned. Flights with
/// other velocities at the start move B as the partials say.
#[test]
fn without_an_aim_the_encounter_of_the_mission_is_described() {
    let Some((_packed, template)) = template() else { return };
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    flyby(folder, 1, &[]);
    let text = "mission = \"flyby.toml\"\nfreeze = 0\nevery = \"2 h\"\n[flyby]\nbody = \"mercury\"\n\
                [compare]\nnext = \"2008-10-06T08:40:00 UTC\"\napproach = []\n";
    let (file, output) = (folder.join("plan.toml"), folder.join("out"));
    fs::write(&file, text).unwrap();
    says(&plan(&file, &output, &template, 0), &["Mercury, 6 h before closest approach: aim B.T"]);
    let found = json(&output);
    assert_eq!((&found["status"], &found["missAfter_m"]), (&"withoutAim".into(), &Value::Null));
    assert!(!output.join("mission.toml").exists());
    let departure = &found["maneuvers"]["departure"];
    let by_miss: Vec<Vec<f64>> = departure["byMiss_1_s"].as_array().unwrap().iter().map(numbers).collect();
    for (column, key) in ["byT_m_s_km", "byR_m_s_km"].into_iter().enumerate() {
        let size = by_miss.iter().map(|row| row[column].powi(2)).sum::<f64>().sqrt();
        assert!((1e3 * size / departure[key].as_f64().unwrap() - 1.0).abs() < 1e-9);
    }
    let names = ["time_s", "b_t_m_by_v_x_m_s", "b_r_m_by_v_x_m_s"];
    let partials = columns(&output.join("partials.csv"), &names);
    assert_eq!([partials[0][0], partials[1][0]], [0.0, 7200.0]);
    let velocity = vector(&fs::read_to_string(folder.join("flyby.toml")).unwrap(), "orbit.velocity");
    let moved_m = [-1e-3, 1e-3].map(|off_m_s| {
        let set = format!("orbit.velocity={},{},{}", velocity[0] + off_m_s, velocity[1], velocity[2]);
        passed(&folder.join("flyby.toml"), &template, ("600s", &["--set", &set])).map(|it| 1e3 * it)
    });
    for column in [0, 1] {
        let by_flights = (moved_m[1][column] - moved_m[0][column]) / 2e-3;
        let by_state = partials[0][1 + column];
        println!("{by_flights} by flights, {by_state} by partials, m by m/s");
        // B between rows is linear to 5 m.
        assert!((by_flights - by_state).abs() < 5e3, "{by_flights} {by_state}");
    }
}

/// On the baseline without tilt, no limit on |H|: 260 km along +R is refused with what was reached, which is the paper's reach 111 d before
/// and within it 40 d before.
#[test]
fn what_is_out_of_reach_is_refused_with_the_polygon() {
    let Some((_packed, template)) = template() else { return };
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let departure = if is_long() { OF_THE_PAPER } else { LATE };
    led(folder, &template, "alternation = 0\nwindmill = 0\n[momentum]\nlimit = \"1e6 N.m.s\"\n", &departure);
    let file = folder.join("plan.toml");
    let text = format!(
        "mission = \"leg/mission.toml\"\nwindow = \"10 d\"\n[momentum]\nlimit = \"1e6 N.m.s\"\n\
         [tilt]\nazimuth = \"10 deg\"\nelevation = \"12 deg\"\n[sunOffset]\nchange = true\nlargest = \"90 deg\"\n\
         [flyby]\nbody = \"mercury\"\nbT = \"3321.8 km\"\nbR = \"260 km\"\nfrom = {:?}\n",
        departure.corrected_from
    );
    fs::write(&file, text).unwrap();
    let printed = plan(&file, &folder.join("far"), &template, 1);
    says(&printed, &["not found: arrays and attitudes that lead to the aim", "reach +T"]);
    let found = json(&folder.join("far"));
    assert_eq!(found["status"], "notFound");
    let reach = ["+T", "-T", "+R", "-R"].map(|key| found["reach_m"][key].as_f64().unwrap() / 1e3);
    println!("reach {reach:?} km");
    // Paper 003 has 146 and 233 km, of windows that it does not print: see docs/src/validation.md.
    for (found_km, published_km) in [(reach[2], 146.0), (reach[3], 233.0)] {
        let share = found_km / published_km;
        assert!(if is_long() { (share - 1.0).abs() < 0.2 } else { share > 0.2 && share < 1.0 }, "{reach:?}");
    }
    assert!(found["reachable_m"].as_array().unwrap().len() > 6);
    assert!(!folder.join("far/mission.toml").exists());
}

/// Steps of the arrays at the start and 30 d behind it, as dates and as times, and a plan that begins with the mission's own state of day 60.
#[test]
fn an_update_leaves_the_clock_of_a_timeline() {
    let Some((_packed, template)) = template() else { return };
    let times = [["\"2008-03-19T00:00:00 UTC\"", "\"2008-04-18T00:00:00 UTC\""], ["0", "\"30 d\""]];
    let ats = ["\"2008-05-18 UTC\"", "\"60 d\""];
    let froms = ["\"2008-06-17 UTC\"", "\"90 d\""];
    let missed = [(0, 0), (1, 0), (1, 1)].map(|(clock, of_file)| {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let with = "timeline = \"steps.toml\"\nmodel = ";
        flyby(folder, 2, &[("\"distance\"", "\"timeline\""), ("model = ", with)]);
        let steps = times[clock].iter().zip([45, 62]);
        let steps = steps.map(|(at, deg)| format!("[[panels]]\nat = {at}\nsunOffset = \"{deg} deg\"\n"));
        fs::write(folder.join("steps.toml"), steps.collect::<String>()).unwrap();
        let text = format!(
            "mission = \"flyby.toml\"\nwindmill = 0\nalternation = 0\n[momentum]\nlimit = \"1e6 N.m.s\"\n\
             [flyby]\nbody = \"mercury\"\nbT = \"9e4 km\"\nbR = 0\nfrom = {}\n[update]\nat = {}\n",
            froms[of_file], ats[of_file]
        );
        fs::write(folder.join("plan.toml"), text).unwrap();
        plan(&folder.join("plan.toml"), &folder.join("out"), &template, 1);
        let found = json(&folder.join("out"));
        let mut missed = numbers(&found["missBefore_m"]);
        missed.push(found["desiredDeltaV"][0]["at_s"].as_f64().unwrap());
        missed
    });
    for other in &missed[1..] {
        let apart = missed[0].iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 10.0, "{missed:?}");
    }
}
