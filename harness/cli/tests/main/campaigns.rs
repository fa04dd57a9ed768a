//! Files of a campaign: what a kill leaves is taken up or refused, never lost or counted twice; nothing is written elsewhere.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Stdio,
    time::{Duration, Instant},
};

use tempfile::TempDir;

use crate::{heliotorque, is_long, packed, run, says, shown};

/// Runs with percentiles over time, so many of them.
fn campaign(runs: u32) -> Option<(TempDir, PathBuf)> {
    let (scratch, _) = packed("Functions")?;
    let file = scratch.path().join("campaign.toml");
    let text = format!(
        "fmu = \"Functions.fmu\"\nruns = {runs}\nseed = 5\n[vary]\n\"x[1]\" = {{ normal = [2, 0.5] }}\n\
         \"x[2]\" = {{ normal = [-1, 2] }}\n[keep]\nfinal = [\"sum\"]\npercentiles = [\"ramp\"]\n"
    );
    fs::write(&file, text).unwrap();
    Some((scratch, file))
}

/// Arguments that sweep into a table beside the campaign.
fn arguments<'a>(file: &'a Path, output: &'a Path, more: &[&'a str]) -> Vec<&'a str> {
    let sweep = ["sweep", shown(file), "--output", shown(output), "--quiet", "--workers", "2"];
    [&sweep[..], more].concat()
}

/// Sweeps and is killed once the table has so many bytes; whether it was.
fn killed(arguments: &[&str], part: &Path, bytes: u64) -> bool {
    let mut child = heliotorque(arguments).stderr(Stdio::null()).spawn().unwrap();
    let began = Instant::now();
    while fs::metadata(part).map_or(0, |it| it.len()) < bytes
        && child.try_wait().unwrap().is_none()
        && began.elapsed() < Duration::from_secs(60)
    {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    !child.wait().unwrap().success()
}

/// The table, its percentiles and the text beside it.
fn results(output: &Path) -> [Vec<u8>; 3] {
    let stem = output.file_stem().unwrap().to_str().unwrap();
    [format!("{stem}.csv"), format!("{stem}-percentiles.csv"), format!("{stem}.csv.toml")]
        .map(|name| fs::read(output.with_file_name(name)).unwrap())
}

#[test]
fn campaigns_that_are_killed_and_resumed_have_the_bytes_of_undisturbed_ones() {
    let Some((scratch, file)) = campaign(5000) else { return };
    let at = |name: &str| scratch.path().join(name);
    let (whole, output, part) = (at("whole.csv"), at("runs.csv"), at("runs.csv.part"));
    run(&arguments(&file, &whole, &[]), 0);
    let length = fs::metadata(&whole).unwrap().len();
    let kills = if is_long() { 50 } else { 6 };
    // Moments that spread evenly, three kills a campaign, some of them behind the last row.
    let mut count = 0;
    for kill in 0..kills {
        let share = (f64::from(kill) * 0.618_033_988_75).fract();
        let resumed: &[&str] = if kill % 3 == 0 { &["--fresh"] } else { &["--resume"] };
        count += u32::from(killed(
            &arguments(&file, &output, resumed),
            &part,
            (share * 1.02 * length as f64) as u64,
        ));
        if kill % 3 == 2 || kill + 1 == kills {
            run(&arguments(&file, &output, &["--resume"]), 0);
            assert!(results(&output) == results(&whole), "{kill}");
            let left = fs::read_dir(scratch.path()).unwrap().map(|it| it.unwrap().file_name());
            let left: Vec<_> = left.filter(|name| name.to_string_lossy().contains(".part")).collect();
            assert!(left.is_empty(), "{left:?}");
            fs::remove_file(&output).unwrap();
        }
    }
    assert!(count > kills as u32 / 2, "{count} of {kills}");
}

#[test]
fn rows_that_a_kill_left_are_not_thrown_away() {
    let Some((scratch, file)) = campaign(5000) else { return };
    let at = |name: &str| scratch.path().join(name);
    let (whole, output, part) = (at("whole.csv"), at("runs.csv"), at("runs.csv.part"));
    run(&arguments(&file, &whole, &[]), 0);
    assert!(killed(&arguments(&file, &output, &[]), &part, 20_000));
    let left = fs::read(&part).unwrap();
    says(&run(&arguments(&file, &output, &[]), 2), &["runs.csv.part: found ", "--resume", "--fresh"]);
    assert!(fs::read(&part).unwrap() == left);
    // Rows count as far as the numbers of the percentiles are there: cut, with a hole, not at all.
    let numbers = at("runs-percentiles.csv.part");
    let bytes = fs::read(&numbers).unwrap();
    let mut with_hole = bytes.clone();
    with_hole[1000..1100].fill(0);
    // A run whose process was killed from outside is simulated again, and nothing stands for it until then.
    let text = String::from_utf8(left.clone()).unwrap();
    let row = text.lines().nth(3).unwrap();
    let varied = row.splitn(4, ',').take(3).collect::<Vec<_>>().join(",");
    fs::write(&part, text.replacen(row, &format!("{varied},,killed,killed from outside"), 1)).unwrap();
    run(&arguments(&file, &output, &["--resume"]), 0);
    assert!(results(&output) == results(&whole));
    fs::remove_file(&output).unwrap();
    for damaged in [&bytes[..bytes.len() / 2 - 3], &with_hole, &[]] {
        fs::write(&part, &left).unwrap();
        fs::write(&numbers, damaged).unwrap();
        fs::write(at("runs.csv.part.toml"), fs::read(at("whole.csv.toml")).unwrap()).unwrap();
        run(&arguments(&file, &output, &["--resume"]), 0);
        assert!(results(&output) == results(&whole), "{} bytes", damaged.len());
        fs::remove_file(&output).unwrap();
    }
    // A header that was cut is written anew.
    fs::write(&part, &left[..9]).unwrap();
    fs::write(at("runs.csv.part.toml"), fs::read(at("whole.csv.toml")).unwrap()).unwrap();
    run(&arguments(&file, &output, &["--resume"]), 0);
    assert!(results(&output) == results(&whole));
    // Without its percentiles a table is not complete.
    fs::remove_file(at("runs-percentiles.csv")).unwrap();
    says(&run(&arguments(&file, &output, &["--resume"]), 2), &["runs-percentiles.csv: found no percentiles"]);
}

#[test]
fn a_range_of_runs_belongs_to_what_is_resumed() {
    let Some((scratch, file)) = campaign(40) else { return };
    let output = scratch.path().join("runs.csv");
    run(&arguments(&file, &output, &["--runs", "0..10"]), 0);
    let refused = run(&arguments(&file, &output, &["--resume"]), 2);
    says(&refused, &["runs.csv.toml: found the runs 0..10, allowed: those of this sweep, 0..40"]);
    let done = run(&arguments(&file, &output, &["--runs", "0..10", "--resume"]), 0);
    says(&done, &["complete already: 10 ok"]);
    fs::rename(&output, scratch.path().join("runs.csv.part")).unwrap();
    fs::rename(scratch.path().join("runs.csv.toml"), scratch.path().join("runs.csv.part.toml")).unwrap();
    let refused = run(&arguments(&file, &output, &["--runs", "0..5", "--resume"]), 2);
    says(&refused, &["runs.csv.part.toml: found the runs 0..10, allowed: those of this sweep, 0..5"]);
}

#[test]
fn files_of_a_campaign_follow_the_rules_of_all_others() {
    let Some((scratch, file)) = campaign(5) else { return };
    let at = |name: &str| scratch.path().join(name);
    let output = at("runs.csv");
    let text = fs::read_to_string(&file).unwrap();
    let away = tempfile::tempdir().unwrap();
    let with = |histories: &str| fs::write(&file, format!("{text}histories = {histories:?}\n")).unwrap();
    with(shown(&away.path().join("x")));
    says(
        &run(&arguments(&file, &output, &[]), 2),
        &["keep.histories: found ", "allowed: a folder in the campaign's"],
    );
    assert!(!away.path().join("x").exists());
    fs::create_dir(at("histories")).unwrap();
    fs::write(at("histories/run-3.csv"), "precious").unwrap();
    with("histories");
    says(&run(&arguments(&file, &output, &[]), 2), &["run-3.csv: found a file that no run wrote"]);
    fs::remove_dir_all(at("histories")).unwrap();
    // Outputs are held against inputs before the first run.
    fs::write(at("runs-percentiles.csv"), "x[1]\n1\n2\n").unwrap();
    let by_table = "fmu = \"Functions.fmu\"\nsampling = \"file\"\nfile = \"runs-percentiles.csv\"\n[keep]\npercentiles = [\"ramp\"]\n";
    fs::write(&file, by_table).unwrap();
    says(&run(&arguments(&file, &output, &[]), 2), &["runs-percentiles.csv: it is an input too"]);
    assert!(!output.exists() && !at("runs.csv.part").exists());
    fs::write(at("values.csv"), "x[1],x[1]\n1,2\n").unwrap();
    fs::write(&file, by_table.replace("runs-percentiles", "values")).unwrap();
    says(&run(&arguments(&file, &output, &[]), 2), &["values.csv: found the column \"x[1]\" twice"]);
    fs::write(&file, text.replace("runs = 5", "runs = 1000000000\nsampling = \"latinHypercube\"")).unwrap();
    says(&run(&arguments(&file, &output, &[]), 2), &["found 1000000000 runs, allowed: 1 to 16777216"]);
    fs::write(&file, &text).unwrap();
    #[cfg(unix)]
    {
        fs::write(at("precious"), "precious").unwrap();
        std::os::unix::fs::symlink(at("precious"), at("runs-percentiles.csv.part")).unwrap();
        says(&run(&arguments(&file, &output, &[]), 2), &["runs-percentiles.csv.part: found "]);
        assert_eq!(fs::read(at("precious")).unwrap(), b"precious");
    }
}
