//! Recorded flights are fed back: errors fall with the rows' spacing, and missions, campaigns and systems read rows as `run` does.

use std::{fmt::Write, fs, path::Path};

use tempfile::TempDir;

use crate::{library, packed_from, run, says, shown};

const CUBESAT: &str = "../../fmu-src/resources/examples/cubesat-12u.toml";
/// Communication step in s; rows stand at multiples of it, the last one at the stop.
const STEP_S: usize = 5;
const STOP: &str = "5280 s";

/// A recording: names, and of each row the time and the values.
struct Recorded {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Recorded {
    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        let (header, rows) = text.split_once('\n').unwrap();
        let numbers = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect();
        Self {
            names: header.split(',').map(str::to_owned).collect(),
            rows: rows.lines().map(numbers).collect(),
        }
    }

    /// A vector in every row.
    fn vectors(&self, vector: &str) -> Vec<Vec<f64>> {
        let is_element = |name: &String| name.strip_prefix(vector).is_some_and(|it| it.starts_with('['));
        let places: Vec<usize> =
            (0..self.names.len()).filter(|place| is_element(&self.names[*place])).collect();
        self.rows.iter().map(|row| places.iter().map(|place| row[*place]).collect()).collect()
    }

    /// A table of inputs: these vectors under other names, a row every so many seconds.
    fn inputs(&self, spacing_s: usize, vectors: &[(&str, &str)]) -> String {
        let element = |vector: &str, i: usize| format!("{vector}[{}]", i + 1);
        let columns: Vec<Vec<Vec<f64>>> = vectors.iter().map(|(from, _)| self.vectors(from)).collect();
        let mut table = "time".to_owned();
        for ((_, to), column) in vectors.iter().zip(&columns) {
            (0..column[0].len()).for_each(|i| write!(table, ",{}", element(to, i)).unwrap());
        }
        for k in (0..self.rows.len()).step_by(spacing_s / STEP_S) {
            write!(table, "\n{}", self.rows[k][0]).unwrap();
            columns.iter().flat_map(|column| &column[k]).for_each(|value| write!(table, ",{value}").unwrap());
        }
        table + "\n"
    }
}

/// Runs the spacecraft with these arguments and reads what is recorded.
fn flown(folder: &Path, name: &str, arguments: &[&str]) -> Recorded {
    let (fmu, output) = (folder.join("craft.fmu"), folder.join(name));
    let step = format!("{STEP_S} s");
    let begin = ["run", shown(&fmu), "--stop", STOP, "--step", &step, "--quiet", "--output", shown(&output)];
    run(&[&begin[..], arguments].concat(), 0);
    Recorded::read(&output)
}

/// The spacecraft's FMU, and its own flight.
fn truth() -> Option<(TempDir, Recorded)> {
    let (scratch, _) = packed_from(&library()?, "MomentumPlant", "craft.fmu", &["--spacecraft", CUBESAT])?;
    let record = "attitude.q,attitude.rate,position,velocity";
    let truth = flown(scratch.path(), "truth.csv", &["--record", record]);
    Some((scratch, truth))
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other).powi(2)).sum::<f64>().sqrt()
}

/// Turn between two attitudes of any sign, in rad.
fn turn_rad(one: &[f64], other: &[f64]) -> f64 {
    let turned: Vec<f64> = other.iter().map(|element| -element).collect();
    4.0 * (distance(one, other).min(distance(one, &turned)) / 2.0).asin()
}

/// Largest error behind the start; what is held over a step shows the flight one step before (`late` 1).
fn largest(found: &[Vec<f64>], truth: &[Vec<f64>], late: usize, of: fn(&[f64], &[f64]) -> f64) -> f64 {
    assert_eq!(found.len(), truth.len());
    (1..found.len()).map(|k| of(&found[k], &truth[k - late])).fold(0.0, f64::max)
}

#[test]
fn replays_come_nearer_to_the_flight_as_their_rows_do() {
    let Some((scratch, truth)) = truth() else { return };
    let folder = scratch.path();
    let replay = |name: &str, spacing_s: usize, vectors: &[(&str, &str)], more: &str| {
        let input = folder.join("in.csv");
        fs::write(&input, truth.inputs(spacing_s, vectors)).unwrap();
        let more: Vec<&str> = more.split(' ').collect();
        flown(
            folder,
            name,
            &[&["--input", shown(&input), "--record", "attitude.q,position"], &more[..]].concat(),
        )
    };
    let (q, position) = (truth.vectors("attitude.q"), truth.vectors("position"));
    let errors = |spacing_s: usize| {
        let orbit = [("position", "orbit.position"), ("velocity", "orbit.velocity")];
        let attitude = [("attitude.q", "command.q"), ("attitude.rate", "command.rate")];
        let sets = "--set attitude.source=commanded --set orbit.source=";
        let by_rates = replay("rates.csv", spacing_s, &[orbit, attitude].concat(), &format!("{sets}inputs"));
        // Without rates an attitude is held over the step, as a place that is not propagated.
        let held =
            replay("held.csv", spacing_s, &[&orbit[..], &attitude[..1]].concat(), &format!("{sets}held"));
        [
            largest(&by_rates.vectors("attitude.q"), &q, 0, turn_rad),
            largest(&by_rates.vectors("position"), &position, 0, distance),
            largest(&held.vectors("attitude.q"), &q, 1, turn_rad),
            largest(&held.vectors("position"), &position, 1, distance),
        ]
    };
    let (far, near) = (errors(240), errors(120));
    for ((far, near), factor) in far.iter().zip(near).zip([12.0, 12.0, 3.5, 12.0]) {
        assert!(far / near > factor, "{far} by {near}, allowed: more than {factor}");
    }
    // Rows h apart leave a turn of constant rate at most h^2 / 8 of the acceleration.
    let rates = truth.vectors("attitude.rate");
    let changes = rates.windows(2).map(|pair| distance(&pair[0], &pair[1]) / STEP_S as f64);
    let bound_rad = 120.0 * 120.0 / 8.0 * changes.fold(0.0, f64::max);
    assert!(near[2] < bound_rad, "{} of {bound_rad}", near[2]);
    assert!(near[0].to_degrees() < 0.01 && near[1] < 10.0, "{near:?}");
}

#[test]
fn missions_campaigns_and_systems_read_rows_as_run_does() {
    let Some((scratch, truth)) = truth() else { return };
    let folder = scratch.path();
    let record = "attitude.q,attitude.rate,position,panel[1].angle";
    let vectors =
        [("attitude.q", "command.q"), ("position", "orbit.position"), ("velocity", "orbit.velocity")];
    // An angle over the edge, and what is held from row to row.
    let mut table = truth.inputs(240, &vectors).lines().map(str::to_owned).collect::<Vec<_>>();
    table[0].push_str(",panel[1].angle,downlink.alternate");
    table[1..].iter_mut().enumerate().for_each(|(k, line)| {
        let (angle, flag) = if k % 2 == 0 { ("170 deg", 0) } else { ("-170 deg", 1) };
        write!(line, ",{angle},{flag}").unwrap();
    });
    fs::write(folder.join("in.csv"), table.join("\n")).unwrap();
    let input = folder.join("in.csv");
    let sets = ["attitude.source=commanded", "orbit.source=inputs"];
    let set: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
    // Ends between two rows, so that a campaign's last row shows how they are interpolated.
    let until = ["--stop", "1290 s", "--step", "5 s", "--quiet"];
    let told = |output: &str, subject: &str, more: &[&str]| {
        let (output, subject) = (folder.join(output), folder.join(subject));
        run(&[&["run", shown(&subject), "--output", shown(&output)], &until[..], more].concat(), 0);
        fs::read_to_string(output).unwrap()
    };
    let inputs = ["--input", shown(&input), "--record", record];
    let alone = told("alone.csv", "craft.fmu", &[&inputs[..], &set].concat());

    let mission = format!(
        "fmu = \"craft.fmu\"\nstop = \"1290 s\"\nstep = \"5 s\"\nrecord = [\"{}\"]\n[set]\n\
         \"attitude.source\" = \"commanded\"\n\"orbit.source\" = \"inputs\"\n",
        record.replace(',', "\", \"")
    );
    let with_file = mission.replace("[set]", "inputs = \"in.csv\"\n[set]");
    fs::write(folder.join("file.toml"), &with_file).unwrap();
    assert!(told("file.csv", "file.toml", &[]) == alone, "a mission with a table");
    // Rows in the mission itself: vectors whole, each input with rows of its own.
    let cells: Vec<Vec<&str>> = table.iter().map(|line| line.split(',').collect()).collect();
    let mut rows = format!("{mission}[inputs]\n");
    for (name, columns) in [
        ("command.q", 1..5),
        ("orbit.position", 5..8),
        ("orbit.velocity", 8..11),
        ("panel[1].angle", 11..12),
        ("downlink.alternate", 12..13),
    ] {
        let value = |cell: &str| if cell.ends_with("deg") { format!("\"{cell}\"") } else { cell.to_owned() };
        let row = |row: &Vec<&str>| {
            let values: Vec<String> = columns.clone().map(|column| value(row[column])).collect();
            format!("[{}, {}]", row[0], values.join(", "))
        };
        let all: Vec<String> = cells[1..].iter().map(row).collect();
        writeln!(rows, "\"{name}\" = [{}]", all.join(", ")).unwrap();
    }
    fs::write(folder.join("rows.toml"), rows).unwrap();
    assert!(told("rows.csv", "rows.toml", &[]) == alone, "a mission with rows");

    let campaign = "mission = \"file.toml\"\nruns = 1\nseed = 1\n[vary]\n\"solar.scale\" = { uniform = [1, 1.000001] }\n\
                    [keep]\nfinal = [\"attitude.q\", \"position\"]\n";
    fs::write(folder.join("campaign.toml"), campaign).unwrap();
    let runs = folder.join("runs.csv");
    run(&["sweep", shown(&folder.join("campaign.toml")), "--output", shown(&runs), "--quiet"], 0);
    let runs = fs::read_to_string(runs).unwrap();
    let (header, values) = runs.split_once('\n').unwrap();
    let last = alone.lines().last().unwrap().split(',').collect::<Vec<_>>();
    let names = alone.lines().next().unwrap().split(',').zip(last);
    for (name, value) in
        names.filter(|(name, _)| ["attitude.q", "position"].iter().any(|it| name.starts_with(it)))
    {
        let place = header.split(',').position(|it| it == format!("{name}.final")).unwrap();
        assert_eq!(values.split(',').nth(place), Some(value), "{name} of a campaign");
    }

    let system = folder.join("craft.ssp");
    let craft = format!("craft={}", shown(&folder.join("craft.fmu")));
    run(&["wire", &craft, "--output", shown(&system)], 0);
    let named = |list: &str| list.split(',').map(|it| format!("craft.{it}")).collect::<Vec<_>>();
    let of_system = format!("time,{}", named(&table[0]["time,".len()..]).join(","));
    table[0] = of_system;
    fs::write(&input, table.join("\n")).unwrap();
    let set: Vec<String> = sets.iter().flat_map(|set| ["--set".to_owned(), format!("craft.{set}")]).collect();
    let set: Vec<&str> = set.iter().map(String::as_str).collect();
    let record = named(record).join(",");
    let found = told(
        "system.csv",
        "craft.ssp",
        &[&["--input", shown(&input), "--record", &record], &set[..]].concat(),
    );
    assert!(found.replace("craft.", "") == alone, "a system");
}

#[test]
fn rows_that_turn_far_without_a_rate_are_named() {
    let Some((scratch, truth)) = truth() else { return };
    let (fmu, input) = (scratch.path().join("craft.fmu"), scratch.path().join("in.csv"));
    let warned = |vectors: &[(&str, &str)], spacing_s: usize| {
        fs::write(&input, truth.inputs(spacing_s, vectors)).unwrap();
        let begin = ["run", shown(&fmu), "--stop", "1 min", "--step", "1 min", "--record", "attitude.q"];
        run(&[&begin[..], &["--set", "attitude.source=commanded", "--input", shown(&input)]].concat(), 0)
    };
    let (q, rate) = (("attitude.q", "command.q"), ("attitude.rate", "command.rate"));
    says(&warned(&[q], 240), &["warning: command.q turns by ", "found no command.rate beside it"]);
    for (vectors, spacing_s) in [(&[q, rate][..], 240), (&[q], STEP_S)] {
        assert!(!warned(vectors, spacing_s).contains("command.q turns by"), "{vectors:?} {spacing_s}");
    }
}

#[test]
fn pulses_between_two_communication_points_are_named() {
    let Some((scratch, _)) = truth() else { return };
    let (fmu, input) = (scratch.path().join("craft.fmu"), scratch.path().join("in.csv"));
    fs::write(&input, "time,dump.request\n0,false\n70,true\n100,false\n").unwrap();
    let told = |step: &str| {
        let begin = ["run", shown(&fmu), "--stop", "5 min", "--record", "attitude.q"];
        run(&[&begin[..], &["--step", step, "--input", shown(&input)]].concat(), 0)
    };
    says(
        &told("1 min"),
        &["warning: dump.request is true from 70 s to 100 s alone", "a step of at most 30 s"],
    );
    assert!(!told("30 s").contains("dump.request is"));
}
