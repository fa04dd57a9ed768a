//! Sweeps: rows that depend on the campaign and their number alone, statistics in closed form, what is refused.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::{Duration, Instant},
};

use tempfile::TempDir;

use crate::{heliotorque, packed, run, says, shown};

/// The campaign `text` on the probe FMU with functions of three parameters.
fn campaign(text: &str) -> Option<(TempDir, PathBuf)> {
    let (scratch, _) = packed("Functions")?;
    let file = scratch.path().join("campaign.toml");
    fs::write(&file, format!("fmu = \"Functions.fmu\"\n{text}")).unwrap();
    Some((scratch, file))
}

/// The table of a sweep with these options.
fn table(file: &Path, name: &str, options: &[&str]) -> String {
    let output = file.with_file_name(name);
    run(&[&["sweep", shown(file), "--output", shown(&output), "--quiet"], options].concat(), 0);
    fs::read_to_string(output).unwrap()
}

/// A column's numbers.
fn column(table: &str, name: &str) -> Vec<f64> {
    let place = table.lines().next().unwrap().split(',').position(|it| it == name).unwrap();
    table.lines().skip(1).map(|row| row.split(',').nth(place).unwrap().parse().unwrap()).collect()
}

const NORMAL: &str = "runs = 3000\nseed = 5\ncorrelation = [[\"x[1]\", \"x[2]\", 0.5]]\n\
    [vary]\n\"x[1]\" = { normal = [2, 0.5] }\n\"x[2]\" = { normal = [-1, 2] }\n\
    [keep]\nfinal = [\"sum\"]\nextremes = [\"ramp\"]\npercentiles = [\"ramp\"]\nevery = \"0.5 s\"\n";

#[test]
fn rows_depend_on_nothing_but_campaign_and_number() {
    let Some((scratch, file)) = campaign(NORMAL) else { return };
    let whole = table(&file, "one.csv", &["--workers", "1"]);
    assert_eq!(whole.lines().count(), 3001);
    assert!(whole.starts_with(
        "run,x[1],x[2],sum.final,ramp.min,ramp.max,ramp.largest,ramp.timeOfLargest,status,reason\n"
    ));
    for workers in ["2", "8"] {
        assert!(table(&file, "more.csv", &["--workers", workers]) == whole, "{workers} workers");
    }
    let percentiles = |name: &str| fs::read_to_string(scratch.path().join(name)).unwrap();
    assert_eq!(percentiles("one-percentiles.csv"), percentiles("more-percentiles.csv"));
    // Pieces have the header each.
    let pieces =
        ["0..1000", "1000..1001", "1001..3000"].map(|runs| table(&file, "piece.csv", &["--runs", runs]));
    let rows = |piece: &String| piece.split_once('\n').unwrap().1.to_owned();
    let joined = pieces.iter().map(rows).collect::<String>();
    assert!(joined == rows(&whole));
    let printed = heliotorque(&["sweep", shown(&file), "--output", "-", "--quiet"]).output().unwrap();
    assert_eq!(String::from_utf8(printed.stdout).unwrap(), whole);
    // What `--dry-run` prints is a table that a campaign takes.
    fs::write(scratch.path().join("values.csv"), run(&["sweep", shown(&file), "--dry-run"], 0)).unwrap();
    let keep = &NORMAL[NORMAL.find("[keep]").unwrap()..];
    fs::write(&file, format!("fmu = \"Functions.fmu\"\nsampling = \"file\"\nfile = \"values.csv\"\n{keep}"))
        .unwrap();
    assert!(table(&file, "file.csv", &[]) == whole);
    let beside = fs::read_to_string(scratch.path().join("one.csv.toml")).unwrap();
    says(
        &beside,
        &[
            "seed = 5",
            "sampling = \"random\"",
            "\"x[1]\" = \"normal 2, 0.5\"",
            "\"ramp.timeOfLargest\" = \"s\"",
        ],
    );
}

#[test]
fn an_interrupted_sweep_goes_on_with_what_it_has() {
    let text = NORMAL.replace("runs = 3000", "runs = 30000");
    let Some((scratch, file)) = campaign(&text) else { return };
    let whole = table(&file, "whole.csv", &[]);
    let (runs, part) = (scratch.path().join("runs.csv"), scratch.path().join("runs.csv.part"));
    let arguments = ["sweep", shown(&file), "--output", shown(&runs), "--quiet", "--workers", "2"];
    let mut child = heliotorque(&arguments).stderr(Stdio::null()).spawn().unwrap();
    let began = Instant::now();
    while fs::metadata(&part).map_or(0, |it| it.len()) < 100_000 && began.elapsed() < Duration::from_secs(60)
    {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = fs::read_to_string(&part).unwrap();
    assert!(left.len() < whole.len() && whole.starts_with(&left), "{} of {} bytes", left.len(), whole.len());
    // Another campaign does not continue with it.
    fs::write(&file, format!("fmu = \"Functions.fmu\"\n{}", text.replace("seed = 5", "seed = 6"))).unwrap();
    let refused = run(&[&arguments[..], &["--resume"]].concat(), 2);
    says(&refused, &["runs.csv.part.toml: found another campaign"]);
    fs::write(&file, format!("fmu = \"Functions.fmu\"\n{text}")).unwrap();
    // The end of a row that was cut off is written anew.
    fs::write(&part, &left[..left.len() - 7]).unwrap();
    assert!(table(&file, "runs.csv", &["--resume"]) == whole);
    let percentiles = |name: &str| fs::read_to_string(scratch.path().join(name)).unwrap();
    assert_eq!(percentiles("runs-percentiles.csv"), percentiles("whole-percentiles.csv"));
    let mut left: Vec<_> = fs::read_dir(scratch.path()).unwrap().map(|it| it.unwrap().file_name()).collect();
    left.retain(|name| name.to_string_lossy().contains(".part"));
    assert!(left.is_empty(), "{left:?}");
    says(&run(&[&arguments[..], &["--resume"]].concat(), 0), &["complete already"]);
}

#[test]
fn statistics_are_those_of_the_distributions() {
    let Some((scratch, file)) = campaign(NORMAL) else { return };
    let table = table(&file, "runs.csv", &[]);
    let [one, other, sum] = ["x[1]", "x[2]", "sum.final"].map(|name| column(&table, name));
    let count = one.len() as f64;
    let product = one.iter().zip(&other).map(|(a, b)| (a - 2.0) / 0.5 * (b + 1.0) / 2.0).sum::<f64>() / count;
    assert!((product - 0.5).abs() < 4.0 * (1.25 / count).sqrt(), "{product}");
    assert!(one.iter().zip(&other).zip(&sum).all(|((a, b), sum)| a + b == *sum));
    // The ramp ends at the sum, which is normal with mean 1 and variance 0.25 + 4 + 2 * 0.5.
    let sigma = 5.25_f64.sqrt();
    let quantiles = [(1, -2.326_347_874_f64), (25, -0.674_489_750), (50, 0.0), (95, 1.644_853_627)];
    let percentiles = fs::read_to_string(scratch.path().join("runs-percentiles.csv")).unwrap();
    assert_eq!(column(&percentiles, "time"), [0.0, 0.5, 1.0]);
    for (percent, z) in quantiles {
        let share = f64::from(percent) / 100.0;
        let density = (-0.5 * z * z).exp() / (2.0 * core::f64::consts::PI).sqrt();
        let error = sigma * (share * (1.0 - share) / count).sqrt() / density;
        let found = column(&percentiles, &format!("ramp.p{percent}"));
        assert_eq!(found[0], 0.0);
        assert!((found[2] - (1.0 + z * sigma)).abs() < 4.0 * error, "{percent} %: {found:?}");
        assert!((found[1] - 0.5 * found[2]).abs() < 1e-12, "{percent} %: {found:?}");
    }
    // The largest magnitude of a ramp is at its end.
    assert!(column(&table, "ramp.timeOfLargest").iter().all(|time_s| *time_s == 1.0));
    let largest = column(&table, "ramp.largest");
    assert!(largest.iter().zip(&sum).all(|(largest, sum)| *largest == sum.abs()));
}

#[test]
fn limits_are_a_status_and_histories_tables() {
    let Some((scratch, file)) = campaign("") else { return };
    let mission = "fmu = \"Functions.fmu\"\nstop = 4\nstep = 1\nrecord = [\"ramp\"]\nevery = 2\n[set]\n\"x[2]\" = 1\n[limits]\nramp = { max = 9 }\n";
    fs::write(scratch.path().join("mission.toml"), mission).unwrap();
    let text = "mission = \"mission.toml\"\nsampling = \"oneAtATime\"\n[vary]\n\"x[1]\" = { normal = [1, 0.5] }\n\
        [keep]\nfinal = [\"ramp\"]\nhistories = \"over-time\"\n";
    fs::write(&file, text).unwrap();
    let table = table(&file, "runs.csv", &[]);
    let rows: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!([rows[0], rows[1]], ["0,1,8,ok,", "1,0.5,6,ok,"]);
    assert!(
        rows[2].starts_with("2,1.5,10,limit,")
            && rows[2].contains("mission.toml:9: limits.ramp: found 10 at 4 s"),
        "{}",
        rows[2]
    );
    let history = fs::read_to_string(scratch.path().join("over-time/run-2.csv")).unwrap();
    assert_eq!(history, "time,ramp\n0,0\n2,5\n4,10\n");
}

#[test]
fn a_full_disk_leaves_what_was_written() {
    let text = "runs = 52000\n[vary]\n\"x[1]\" = { normal = [0, 1] }\n\"x[3]\" = { normal = [0, 1] }\n\
        [keep]\nextremes = [\"ishigami\", \"ramp\", \"sum\"]\n";
    let Some((scratch, file)) = campaign(text) else { return };
    // Unpacked: nothing else is written.
    let fmu = fmi::Fmu::open(scratch.path().join("Functions.fmu")).unwrap();
    let text = fs::read_to_string(&file).unwrap().replace("Functions.fmu", shown(fmu.folder()));
    fs::write(&file, text).unwrap();
    let whole = table(&file, "whole.csv", &[]);
    assert!(whole.len() > 10_500_000, "{} bytes", whole.len());
    let runs = scratch.path().join("runs.csv");
    // Files of 5 or 10 MB at most, as the shell counts; what the processes share has 4 MiB.
    let script = "trap '' XFSZ; ulimit -f 10000; exec \"$0\" sweep \"$1\" --output \"$2\" --quiet";
    let program = heliotorque(&[]).get_program().to_owned();
    let mut shell = Command::new("sh");
    let output = shell.args(["-c", script]).arg(program).args([&file, &runs]).output().unwrap();
    let text = crate::text(&output);
    assert_eq!(output.status.code(), Some(2), "{text}");
    says(&text, &["runs.csv.part: ", "--output"]);
    let left = fs::read_to_string(scratch.path().join("runs.csv.part")).unwrap();
    assert!(left.len() > 5_000_000 && left.len() < whole.len() && whole.starts_with(&left));
    assert!(table(&file, "runs.csv", &["--resume"]) == whole);
}

#[test]
fn what_is_wrong_is_named() {
    let Some((_scratch, file)) = campaign("") else { return };
    let uniform = "\"x[1]\" = { uniform = [0, 1] }";
    for (text, parts) in [
        (
            "runs = 3\n[vary]\ny = { uniform = [0, 1] }\n",
            &["campaign.toml:4: vary.y.uniform: found the unknown variable \"y\""][..],
        ),
        (
            "runs = 3\n[vary]\nx = { uniform = [0, 1] }\n",
            &["found \"x\", 3 variables, allowed: one of them: \"x[1]\""],
        ),
        ("runs = 3\n[vary]\nsum = { uniform = [0, 1] }\n", &["vary.sum.uniform", "cannot be set"]),
        ("runs = 3\n[vary]\n\"x[1]\" = { uniform = [\"1 km\", 2] }\n", &["campaign.toml:4", "1 km"]),
        (
            "runs = 3\n[vary]\n\"x[1]\" = { uniform = [2, 1] }\n",
            &["found 2 and 1, allowed: the smaller one first"],
        ),
        (
            "runs = 3\n[vary]\n\"x[1]\" = { normal = [0, 0] }\n",
            &["found the standard deviation 0, allowed: above 0"],
        ),
        ("runs = 3\n[vary]\n\"x[1]\" = { logUniform = [0, 1] }\n", &["found 0, allowed: above 0"]),
        ("runs = 3\n[vary]\n\"x[1]\" = { triangular = [0, 2, 1] }\n", &["found the most likely value 2"]),
        (
            "runs = 3\n[vary]\n\"x[1]\" = { normal = [0, 1], values = [1] }\n",
            &["found normal and values, allowed: one of"],
        ),
        ("sampling = \"grid\"\n[vary]\n\"x[1]\" = { values = [] }\n", &["campaign.toml:4", "a list of 0"]),
        (
            "sampling = \"grid\"\n[vary]\n\"x[1]\" = { normal = [0, 1] }\n",
            &["found x[1] as normal with sampling grid, allowed: values and steps"],
        ),
        (
            "sampling = \"grid\"\nruns = 3\n[vary]\n\"x[1]\" = { values = [1, 2] }\n",
            &["campaign.toml:3: runs: found 3 runs, allowed: 2"],
        ),
        (&format!("[vary]\n{uniform}\n"), &["found no `runs`"]),
        (&format!("runs = 3\nfile = \"a.csv\"\n[vary]\n{uniform}\n"), &["`file` with another sampling"]),
        (
            &format!("runs = 3\nsampling = \"file\"\nfile = \"campaign.toml\"\n[vary]\n{uniform}\n"),
            &["`vary` beside sampling file"],
        ),
        (
            &format!("runs = 70000\nsampling = \"sobol\"\n[vary]\n{uniform}\n"),
            &["found 70000 runs, allowed: 1 to 65536"],
        ),
        (
            &format!("runs = 3\ncorrelation = [[\"x[1]\", \"x[2]\", 0.5]]\n[vary]\n{uniform}\n"),
            &["campaign.toml:3: correlation: found \"x[1]\", allowed: a variable in `vary` that is normal"],
        ),
        (
            "runs = 3\ncorrelation = [[\"x[1]\", \"x[2]\", 0.9], [\"x[2]\", \"x[3]\", 0.9], [\"x[1]\", \"x[3]\", -0.9]]\n[vary]\n\
          \"x[1]\" = { normal = [0, 1] }\n\"x[2]\" = { normal = [0, 1] }\n\"x[3]\" = { normal = [0, 1] }\n",
            &["positive definite"],
        ),
        (
            &format!("runs = 3\n[vary]\n{uniform}\n[keep]\nfinal = [\"nothing\"]\n"),
            &["campaign.toml:6: keep.final[1]", "nothing"],
        ),
        (
            &format!("runs = 3\n[vary]\n{uniform}\n[keep]\nevery = \"1 s\"\n"),
            &["`every` beside `percentiles`"],
        ),
        (
            &format!("runs = 1000000\nstep = \"1 ms\"\n[vary]\n{uniform}\n[keep]\npercentiles = [\"sum\"]\n"),
            &["keep.percentiles: found 1001000000 numbers, allowed: up to 100000000"],
        ),
    ] {
        fs::write(&file, format!("fmu = \"Functions.fmu\"\n{text}")).unwrap();
        says(&run(&["sweep", shown(&file)], 2), parts);
    }
    fs::write(&file, format!("fmu = \"Functions.fmu\"\nruns = 3\n[vary]\n{uniform}\n")).unwrap();
    says(&run(&["sweep", shown(&file), "--runs", "2..4"], 2), &["--runs: found 2..4, allowed: within 0..3"]);
    run(&["sweep", shown(&file), "--runs", "4..2"], 2);
}

#[test]
fn a_value_outside_its_limits_is_named_with_its_run() {
    let Some((scratch, _)) = packed("RigidBody") else { return };
    let file = scratch.path().join("campaign.toml");
    let text =
        "fmu = \"RigidBody.fmu\"\nsampling = \"grid\"\n[vary]\n\"inertia[1]\" = { steps = [2, -1, 4] }\n";
    fs::write(&file, text).unwrap();
    // 2, 1, 0, -1 against a minimum of 1e-3.
    says(
        &run(&["sweep", shown(&file)], 2),
        &["campaign.toml:4: vary.\"inertia[1]\".steps: run 2: found 0, allowed: a number from 0.001"],
    );
}

/// Rows of a Sobol sequence over a material's numbers are flights of edited files.
#[test]
fn a_sweep_over_optics_flies_edited_files() {
    let Some(library) = crate::library() else { return };
    let (scratch, _) = crate::packed_from(&library, "MomentumPlant", "plant.fmu", &[]).unwrap();
    let (file, shipped) = (scratch.path().join("campaign.toml"), scratch.path().join("messenger.toml"));
    let rows = if crate::is_long() { 20 } else { 2 };
    let names = [
        "optics.shadeCloth.specular",
        "optics.shadeCloth.diffuse",
        "optics.solarCells.specular",
        "optics.solarCells.diffuse",
    ];
    let vary: String = names.map(|name| format!("\"{name}\" = {{ uniform = [0, 0.5] }}\n")).concat();
    let text = format!(
        "fmu = \"plant.fmu\"\nstop = \"6 h\"\nstep = \"600 s\"\nruns = {rows}\nsampling = \"sobol\"\n[vary]\n{vary}\
         [keep]\nfinal = [\"momentum.inertial\"]\n"
    );
    fs::write(&file, text).unwrap();
    let swept = table(&file, "runs.csv", &[]);
    let own = include_str!("../../../../fmu-src/resources/messenger.toml");
    let mut seen = Vec::new();
    for row in 0..rows {
        let at = |name: &str| column(&swept, name)[row];
        let [a, b, c, d] = names.map(at);
        let edited = own
            .replace("specular = 0.15\ndiffuse = 0.35", &format!("specular = {a:?}\ndiffuse = {b:?}"))
            .replace("specular = 0.52\ndiffuse = 0.07", &format!("specular = {c:?}\ndiffuse = {d:?}"));
        fs::write(&shipped, edited).unwrap();
        let fmu = scratch.path().join("edited.fmu");
        let pack = [
            "pack",
            "--library",
            shown(&library),
            "--model",
            "MomentumPlant",
            "--spacecraft",
            shown(&shipped),
        ];
        run(&[&pack[..], &["--output", shown(&fmu)]].concat(), 0);
        let flown = scratch.path().join("flown.csv");
        let flight = [
            "run",
            shown(&fmu),
            "--stop",
            "6h",
            "--step",
            "600s",
            "--quiet",
            "--record",
            "momentum.inertial",
        ];
        run(&[&flight[..], &["--output", shown(&flown)]].concat(), 0);
        let flown = fs::read_to_string(flown).unwrap();
        for axis in 1..=3 {
            let name = format!("momentum.inertial[{axis}]");
            let expected = *column(&flown, &name).last().unwrap();
            let found = at(&format!("{name}.final"));
            assert!(
                (found - expected).abs() <= 1e-12 * expected.abs().max(1e-3),
                "{name} {found} {expected}"
            );
            seen.push(found);
        }
    }
    assert!((seen[0] - seen[3]).abs() > 1e-4 * seen[0].abs(), "{seen:?}");
}
