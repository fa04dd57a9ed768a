//! `run` and `info`: values by name and unit, tables in, CSV and pictures out, and Ctrl-C.

use std::fs;

use crate::{built, packed, run, says, shown, template, words};

fn csv(path: &std::path::Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let header = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let rows = reader
        .records()
        .map(|record| record.unwrap().iter().map(|cell| cell.parse().unwrap()).collect())
        .collect();
    (header, rows)
}

#[test]
fn rows_too_sparse_for_an_orbit_are_named() {
    let Some((_scratch, fmu)) = template() else { return };
    // An orbit of 12 h, of which rows every 90 min are eight.
    let printed = |line: &str| run(&[&["run", shown(&fmu)][..], &words(line)].concat(), 0);
    let sparse = "warning: orbit.semiMajorAxis: rows 2 h apart show too little of an orbit of 12 h";
    for line in ["--stop 2d --step 2h", "--stop 2d --step 10min --every 2h"] {
        let text = printed(&format!("{line} --record sun.beta"));
        assert!(text.contains(sparse), "{text}");
    }
    for line in
        ["--stop 2d --step 90min", "--stop 11h --step 2h", "--stop 9d --step 1d --set orbit.center=sun"]
    {
        let text = printed(&format!("{line} --record sun.beta"));
        assert!(!text.contains("rows"), "{text}");
    }
}

#[test]
fn a_simulation_leaves_csv_and_a_picture() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let (table, picture) = (scratch.path().join("out.csv"), scratch.path().join("out.svg"));
    let record = "--record output.integral,output.vector,output.boolean --set input.vector=1,2mN,3";
    let times = words("--stop 1min --step 10s");
    let files = ["--set", "input.real=2 km/s", "--output", shown(&table), "--output", shown(&picture)];
    let text = run(&[&["run", shown(&fmu)][..], &times, &words(record), &files].concat(), 0);
    assert!(text.contains("6 steps to 60 s"), "{text}");
    for file in [&table, &picture] {
        assert!(text.contains(&format!("wrote {}", file.display())), "{text}");
    }
    let row = |name: &str| text.lines().find(|line| line.contains(name)).unwrap().to_owned();
    assert!(row("output.vector").contains("1, 0.002, 3"), "{text}");
    assert!(row("output.integral").contains("120"), "{text}");
    assert!(row("variable").contains("min") && row("variable").contains("max"), "{text}");
    // Beside the table stands where it comes from.
    let origin: toml::Table =
        fs::read_to_string(scratch.path().join("out.csv.toml")).unwrap().parse().unwrap();
    assert_eq!(origin["fmus"][0]["name"].as_str(), Some("AllTypes"));
    assert_eq!(origin["values"]["input.vector[2]"].as_float(), Some(0.002));
    assert_eq!((origin["stop_s"].as_float(), origin["step_s"].as_float()), (Some(60.0), Some(10.0)));
    let (header, rows) = csv(&table);
    assert_eq!(origin["columns"].as_table().unwrap().len(), header.len());
    let names = [
        "time",
        "output.integral",
        "output.vector[1]",
        "output.vector[2]",
        "output.vector[3]",
        "output.boolean",
    ];
    assert_eq!(header, names);
    assert_eq!(rows.len(), 7);
    for (k, row) in (0..).zip(&rows) {
        assert_eq!(row[0], f64::from(k) * 10.0);
        assert!((row[1] - 2000.0 * row[0]).abs() < 1e-8);
        assert_eq!(row[2..], [1.0, 0.002, 3.0, 0.0]);
    }
    let svg = fs::read_to_string(&picture).unwrap();
    assert!(svg.contains("output.integral") && svg.contains("time [s]"));
    // What stays the same is reported instead.
    assert!(
        !svg.contains("output.vector") && text.contains("constant, so not drawn: output.vector"),
        "{text}"
    );
}

#[test]
fn a_picture_shades_eclipses_and_names_limits_that_nobody_recorded() {
    let Some((scratch, fmu)) = template() else { return };
    let (table, picture) = (scratch.path().join("out.csv"), scratch.path().join("out.svg"));
    // An orbit in the plane of the Sun, low enough to have the planet before it at every turn.
    let sets = [
        "orbit.semiMajorAxis=4000km",
        "orbit.eccentricity=0.1",
        "orbit.inclination=0",
        "dump.threshold=2,2,2",
    ];
    let drawn = |method: &str| {
        let mut arguments = vec!["run", shown(&fmu), "--stop", "1d", "--step", "60s"];
        arguments.extend(["--record", "momentum.body,orbit.timeSincePeriapsis"]);
        arguments.extend(sets.iter().chain(&[method]).flat_map(|set| ["--set", *set]));
        arguments.extend(["--output", shown(&table), "--output", shown(&picture)]);
        let reported = run(&arguments, 0);
        assert!(!reported.contains("litFraction"), "{reported}");
        let (header, _) = csv(&table);
        assert_eq!(header[..2], ["time", "momentum.body[1]"]);
        assert!(header.iter().all(|name| name != "sun.litFraction"), "{header:?}");
        fs::read_to_string(&picture).unwrap()
    };
    let shaded = drawn("eclipse.method=discs");
    assert!(shaded.contains("eclipse") && shaded.contains("dump.threshold"));
    assert!(!shaded.contains("litFraction"));
    let lit = drawn("eclipse.method=off");
    assert!(!lit.contains("eclipse") && lit.contains("dump.threshold"));
}

#[test]
fn a_table_drives_inputs() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let (input, output) = (scratch.path().join("in.csv"), scratch.path().join("out.csv"));
    fs::write(&input, "# a ramp\ntime, input.real\n0, 0\n4, 4\n8, 4\n").unwrap();
    let simulate = |more: &[&str]| {
        let (fmu, input, output) = (shown(&fmu), shown(&input), shown(&output));
        let mut arguments = vec!["run", fmu, "--stop", "8", "--step", "0.5", "--quiet", "--input", input];
        arguments.extend(["--record", "output.integral", "--output", output]);
        arguments.extend(more);
        run(&arguments, 0);
        csv(std::path::Path::new(output)).1.last().unwrap()[1]
    };
    assert!((simulate(&["--slopes"]) - 24.0).abs() < 1e-12);
    assert!((simulate(&[]) - 23.0).abs() < 1e-12);

    fs::write(&input, "time,input.rael\n0,0\n").unwrap();
    let text = run(&["run", shown(&fmu), "--input", shown(&input)], 2);
    assert!(text.contains("in.csv") && text.contains("input.real"), "{text}");
}

#[test]
fn without_files_a_summary_is_shown() {
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    let text =
        run(&["run", shown(&fmu), "--set", "input.text=hello", "--record", "output.text,output.real"], 0);
    assert!(text.contains("hello") && text.contains("final"), "{text}");
    let text = run(&["info", shown(&fmu), "--only", "channel[1].*,input.choice"], 0);
    says(&text, &["channel[1].gain", "input.choice", "1 (red)", "Like the sky."]);
    // What was requested stands alone; all there is comes without --only.
    for part in ["parameter.real", "canSerializeFMUstate", "GUID"] {
        assert!(!text.contains(part), "{text}");
    }
    let text = run(&["info", shown(&fmu), "--variables"], 0);
    says(&text, &["parameter.real", "canSerializeFMUstate", "GUID", "Like the sky."]);
    // Twice and thrice the parameter.
    let text = run(&["info", shown(&fmu), "--coefficients", "--set", "parameter.real=7 km"], 0);
    let value = |name: &str| text.lines().find(|line| line.contains(name)).unwrap().to_owned();
    assert!(value("role.calculatedFixed").contains("14000"), "{text}");
    assert!(value("role.calculatedApprox").contains("21000"), "{text}");
}

#[test]
fn patterns_take_outputs_and_whole_vectors() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let table = scratch.path().join("out.csv");
    let record = |names: &str| {
        run(&["run", shown(&fmu), "--quiet", "--record", names, "--output", shown(&table)], 0);
        csv(&table).0
    };
    let vector = ["output.vector[1]", "output.vector[2]", "output.vector[3]"];
    assert_eq!(record("out*.vector")[1..], vector);
    assert_eq!(record("output.v*or")[1..], vector);
    // A parameter by its name or its vector's.
    assert_eq!(record("parameter.vector,parameter.real")[4], "parameter.real");
    let text = run(&["run", shown(&fmu), "--record", "param*.real"], 2);
    assert!(text.contains("takes outputs only") && text.contains("named: parameter.real"), "{text}");
}

#[test]
fn times_take_dates_that_count_from_the_epoch_of_the_start() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    let (scratch, fmu) = (tempfile::tempdir().unwrap(), dist.join("MomentumPlant.fmu"));
    let table = scratch.path().join("out.csv");
    let simulate = |more: &[&str], status: i32| {
        let always = ["run", shown(&fmu), "--step", "600", "--output", shown(&table)];
        run(&[&always[..], more].concat(), status)
    };
    let last_s = || csv(&table).1.last().unwrap()[0];
    let epoch = ["--set", "start.epoch=2016-12-31T23:00:00 UTC"];
    // With the leap second.
    simulate(&[&epoch[..], &["--stop", "2017-01-01T01:00:00 UTC"]].concat(), 0);
    assert_eq!(last_s(), 7201.0);
    simulate(&[&epoch[..], &["--start", "600", "--stop", "2017-01-01T00:00:00 UTC"]].concat(), 0);
    assert_eq!(last_s(), 600.0 + 3601.0);
    // The FMU's own epoch is 2009-04-06 TDB.
    simulate(&["--stop", "2009-04-06T01:00:00 TDB"], 0);
    assert_eq!(last_s(), 3600.0);
    let text = simulate(&["--stop", "2009-04-06T01:00:00"], 2);
    assert!(text.contains("UTC, Z, TDB"), "{text}");
    let text = simulate(&["--stop", "2009-04-05 TDB"], 2);
    assert!(text.contains("must be later than the start time"), "{text}");
    let Some((_room, other)) = packed("AllTypes") else { return };
    let text = run(&["run", shown(&other), "--stop", "2009-04-07 TDB"], 2);
    assert!(text.contains("--stop") && text.contains("no epoch of the start"), "{text}");
    // Windows count from the start here, and from periapsis by default.
    let dated = "guided.downlinkStart=2009-04-06T00:10:00 TDB";
    let text = simulate(&["--stop", "1 h", "--set", dated], 2);
    assert!(text.contains("guided.downlinkReference is periapsis"), "{text}");
    let simulated = |start: &str, end: &str| {
        let sets = ["--set", "guided.downlinkReference=start", "--set", start, "--set", end];
        simulate(&[&sets[..], &["--stop", "2 h", "--record", "attitude.q"]].concat(), 0);
        csv(&table).1
    };
    let by_dates = simulated(dated, "guided.downlinkEnd=2009-04-06T00:50:00 TDB");
    assert_eq!(by_dates, simulated("guided.downlinkStart=10 min", "guided.downlinkEnd=50 min"));
    assert_ne!(by_dates, simulated("guided.downlinkStart=60 min", "guided.downlinkEnd=100 min"));
}

#[test]
fn a_time_that_is_none_is_shown_so() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    let (scratch, fmu) = (tempfile::tempdir().unwrap(), dist.join("MomentumPlant.fmu"));
    let table = scratch.path().join("out.csv");
    let names = "dump.lastTime,dump.count,torque.solar";
    let simulate = ["run", shown(&fmu), "--stop", "600", "--step", "600", "--record", names];
    let row = |text: &str| text.lines().find(|line| line.contains("dump.lastTime")).unwrap().to_owned();
    let text = run(&simulate, 0);
    // Least, greatest and last, with files too.
    assert_eq!(row(&text).matches("none").count(), 3, "{text}");
    let text = run(&[&simulate[..], &["--output", shown(&table)]].concat(), 0);
    assert_eq!(row(&text).matches("none").count(), 3, "{text}");
    assert!(text.contains("wrote") && text.contains("torque.solar"), "{text}");
    // Files keep the number, and the standard output holds the table alone.
    assert_eq!(csv(&table).1[1][1], -1.0);
    let output = crate::heliotorque(&[&simulate[..], &["--output", "-"]].concat()).output().unwrap();
    assert!(output.stdout == fs::read(&table).unwrap() && !crate::text(&output).contains("wrote"));
    let text = run(&[&simulate[..], &["--quiet", "--output", shown(&table)]].concat(), 0);
    assert!(text.is_empty(), "{text}");
}

#[test]
fn bad_settings_name_the_variable_and_what_is_allowed() {
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    for (setting, expected) in [
        ("input.reel=1", "near it: input.real"),
        ("input.real=1 kg", "allowed: a number, with one of the units m/s, km/s"),
        ("input.choice=pink", "red (1)"),
        ("output.real=1", "output.real"),
        ("input.vector=1,2", "3 elements"),
        ("input.real", "name=value"),
    ] {
        let text = run(&["run", shown(&fmu), "--set", setting], 2);
        assert!(text.contains(expected), "{setting}: {text}");
    }
    // What the FMU itself refuses is reported with its reason, also without the log.
    for (setting, expected) in
        [("input.real=1e7", "-1000000.0 to 1000000.0"), ("input.integer=2000", "-1000 to 1000")]
    {
        let text = run(&["run", shown(&fmu), "--set", setting], 2);
        says(&text, &["fmi2Discard", "allowed is", expected]);
    }
    let text = run(&["run", shown(&fmu), "--output", "no/such/folder/out.csv"], 2);
    assert!(text.contains("no/such/folder/out.csv") && text.contains("--output"), "{text}");
}

#[test]
fn an_angle_beyond_its_limits_is_reported_in_deg() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    let fmu = dist.join("MomentumPlant.fmu");
    for (setting, expected) in [
        ("orbit.inclination=5", "5 rad; did you mean 5deg? Allowed: 0 to 180 deg (0 to 3.141593 rad)"),
        (
            "orbit.inclination=10",
            "found 10, which is more than a turn without a unit, allowed: 10 deg or 10 rad",
        ),
        ("orbit.inclination=200deg", "found 200deg, allowed: 0 to 180 deg"),
        ("orbit.inclination=1e4rad", "found 1e4rad, allowed: 0 to 180 deg"),
        ("orbit.inclination=-5", "found -5 rad, allowed: 0 to 180 deg"),
    ] {
        for command in [&["run"][..], &["info", "--coefficients"]] {
            let text = run(&[command, &[shown(&fmu), "--set", setting]].concat(), 2);
            assert!(text.contains("orbit.inclination") && text.contains(expected), "{setting}: {text}");
        }
    }
    run(&["info", "--coefficients", shown(&fmu), "--set", "orbit.inclination=10deg"], 0);
    run(&["info", "--coefficients", shown(&fmu), "--set", "orbit.inclination=3.1"], 0);
}

#[test]
fn an_epoch_is_written_and_shown_as_a_date() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    let fmu = dist.join("MomentumPlant.fmu");
    let simulate = |setting: &str, status| {
        let times = ["--stop", "600", "--step", "600", "--record", "start.epoch", "--set", setting];
        run(&[&["run", shown(&fmu)], &times[..]].concat(), status)
    };
    let text = simulate("start.epoch=2011-04-06T00:00:00 UTC", 0);
    // 34 leap seconds and 32.184 s after 4112.5 days.
    assert!(text.contains("355320066.18") && text.contains("(2011-04-06T00:00:00 UTC)"), "{text}");
    let text = simulate("Start.Epoch=2009-04-06 TDB", 0);
    assert!(text.contains("292248000 (2009-04-05T23:58:53.8"), "{text}");
    for (date, expected) in [
        ("2011-04-06", "does not end in UTC, Z, TDB, TT or TAI"),
        ("2011-02-29 UTC", "a day that no calendar has"),
        ("tomorrow", "which is no date"),
    ] {
        let text = simulate(&format!("start.epoch={date}"), 2);
        assert!(text.contains("start.epoch") && text.contains(expected), "{text}");
        assert!(text.contains("2008-03-19T19:30:00 UTC") && text.contains("the units s"), "{text}");
    }
    let text = run(&["info", shown(&fmu), "--only", "start.epoch"], 0);
    assert!(text.contains("292248000 (2009-04-05T23:58:53.8"), "{text}");
}

#[test]
fn an_error_on_the_way_leaves_what_was_simulated() {
    let Some((scratch, fmu)) = packed("Panicking") else { return };
    let (input, output) = (scratch.path().join("in.csv"), scratch.path().join("out.csv"));
    let info = run(&["info", shown(&fmu), "--variables"], 0);
    let panic = info.lines().find(|line| line.contains("Panic in step, with half")).unwrap();
    let number = panic.split_whitespace().find(|word| word.parse::<i32>().is_ok()).unwrap();
    fs::write(&input, format!("time,fault\n0,1\n3,{number}\n")).unwrap();
    let text = run(
        &words(&format!(
            "run {} --start 0 --stop 10 --step 1 --input {} --output {}",
            shown(&fmu),
            shown(&input),
            shown(&output)
        )),
        2,
    );
    assert!(text.contains("fmi2Error") && text.contains("panic"), "{text}");
    // Under the name of a recording in progress: what is complete has its own name.
    assert!(text.contains("4 rows so far: ") && text.contains("out.csv.part"), "{text}");
    assert_eq!(csv(&scratch.path().join("out.csv.part")).1.len(), 4);
    assert!(!output.exists());
}

#[test]
fn a_picture_of_another_kind_is_refused_before_the_simulation() {
    let Some((scratch, fmu)) = packed("Empty") else { return };
    let picture = scratch.path().join("out.png");
    let text = run(&["run", shown(&fmu), "--output", shown(&picture)], 2);
    assert!(text.contains("out.png: found another ending, allowed: .csv, .svg"), "{text}");
    assert!(!picture.exists());
}

#[test]
fn files_that_cannot_be_written_are_reported_before_the_simulation() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let (table, picture) = (scratch.path().join("out.csv"), scratch.path().join("out.svg"));
    let missing = scratch.path().join("none/out.svg");
    let simulate =
        |more: &[&str]| run(&[&["run", shown(&fmu), "--stop", "1e9", "--step", "1"], more].concat(), 2);
    // Hours of stepping, had the simulation begun.
    for missing in [&missing, &missing.with_extension("csv")] {
        says(&simulate(&["--output", shown(missing)]), &["none", "see --output"]);
    }
    // One that cannot be written leaves the other as it was, and so does a simulation that is refused.
    fs::write(&table, "precious").unwrap();
    simulate(&["--output", shown(&table), "--output", shown(&missing)]);
    simulate(&["--output", shown(&table), "--output", shown(&picture), "--set", "input.real=1e7"]);
    assert_eq!(fs::read_to_string(&table).unwrap(), "precious");
    assert!(!picture.exists());
}

#[cfg(target_os = "linux")]
/// Starts a run of hours into a file, and interrupts it once it listens.
fn interrupted(fmu: &std::path::Path, output: &std::path::Path) -> std::process::Output {
    let arguments =
        ["run", shown(fmu), "--stop", "1e12", "--step", "1", "--every", "1e5", "--output", shown(output)];
    let mut child = crate::heliotorque(&arguments).stderr(std::process::Stdio::piped()).spawn().unwrap();
    // Hours of stepping: only the signal ends it, and only once the program listens.
    while !listens_to_interrupts(child.id()) {
        assert_eq!(child.try_wait().unwrap(), None, "it ended before it listened");
        std::thread::yield_now();
    }
    // The shell's own `kill`: the program of that name is not on every machine.
    let kill = ["-c", "kill -INT \"$1\"", "sh", &child.id().to_string()];
    assert!(std::process::Command::new("sh").args(kill).status().unwrap().success());
    child.wait_with_output().unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_leaves_a_valid_partial_csv() {
    let Some((scratch, fmu)) = packed("Empty") else { return };
    let output = scratch.path().join("out.csv");
    let ended = interrupted(&fmu, &output);
    assert_eq!(ended.status.code(), Some(130));
    assert!(crate::text(&ended).contains("interrupted at"), "{}", crate::text(&ended));
    let mut reader = csv::Reader::from_path(&output).unwrap();
    let columns = reader.headers().unwrap().len();
    let rows: Vec<csv::StringRecord> = reader.records().map(|record| record.unwrap()).collect();
    assert!(!rows.is_empty() && rows.iter().all(|row| row.len() == columns));
    let last_s: f64 = rows.last().unwrap()[0].parse().unwrap();
    assert!(last_s < 1e12, "it came to its end");
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_does_not_replace_a_complete_file_by_part_of_one() {
    let Some((scratch, fmu)) = packed("Empty") else { return };
    let output = scratch.path().join("out.csv");
    run(&["run", shown(&fmu), "--quiet", "--output", shown(&output)], 0);
    let complete = std::fs::read(&output).unwrap();
    let ended = interrupted(&fmu, &output);
    let reported = crate::text(&ended);
    assert_eq!(ended.status.code(), Some(130), "{reported}");
    assert_eq!(std::fs::read(&output).unwrap(), complete);
    let (_, rows) = csv(&scratch.path().join("out.csv.part"));
    assert!(!rows.is_empty());
    says(&reported, &[&format!("{} rows so far: ", rows.len()), "out.csv.part"]);
    assert!(!reported.contains("wrote "), "{reported}");
}

/// Whether a process catches SIGINT (signal 2), by the mask the kernel shows.
#[cfg(target_os = "linux")]
fn listens_to_interrupts(process: u32) -> bool {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask & 0b10 != 0)
}
