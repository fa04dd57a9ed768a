//! `plot`: what each kind of picture shows of tables written by hand, and that a recording is drawn as `run` draws it.

use std::{fs, path::Path};

use crate::{heliotorque, run, says, shown, template, text};

const UNITS: &str = "\"center[3]\" = \"m\"\n\"h[1].final\" = \"N.m.s\"\n\"scale\" = \"1\"\n";

/// A campaign in which h = 1000 center + 2 scale; the last run failed.
fn campaign() -> tempfile::TempDir {
    let scratch = tempfile::tempdir().unwrap();
    let mut runs = "run,center[3],scale,h[1].final,status,reason\n".to_owned();
    for run in 0..400 {
        let (center_m, scale) = (1e-3 * f64::from(run % 20), f64::from(run / 20));
        let status = if run < 300 { "ok" } else { "limit" };
        runs += &format!("{run},{center_m},{scale},{},{status},\n", 1e3 * center_m + 2.0 * scale);
    }
    fs::write(scratch.path().join("runs.csv"), runs + "400,0.1,1,,failed,fmi2DoStep\n").unwrap();
    let beside = format!("sampling = \"grid\"\n[units]\n{UNITS}[vary]\nscale = {{ values = [0] }}\n");
    fs::write(scratch.path().join("runs.csv.toml"), beside).unwrap();
    scratch
}

/// The picture that these arguments give in a folder, and what is said.
fn drawn(folder: &Path, arguments: &[&str]) -> (String, String) {
    let arguments = [&["plot"], arguments, &["--output", "p.svg"]].concat();
    let output = heliotorque(&arguments).current_dir(folder).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", text(&output));
    let svg = fs::read_to_string(folder.join("p.svg")).unwrap();
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    (svg, text(&output))
}

fn count(svg: &str, part: &str) -> usize {
    svg.matches(part).count()
}

/// Tags of this kind with this part.
fn tags<'a>(svg: &'a str, kind: &str, part: &str) -> Vec<&'a str> {
    svg.split(&format!("<{kind} "))
        .skip(1)
        .filter_map(|it| it.split("/>").next())
        .filter(|it| it.contains(part))
        .collect()
}

fn number(tag: &str, key: &str) -> f64 {
    let tag = format!(" {tag}");
    tag.split(&format!(" {key}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
}

#[test]
fn a_recording_is_drawn_as_run_draws_it() {
    let Some((scratch, fmu)) = template() else { return };
    let [csv, of_run] = ["run.csv", "run.svg"].map(|name| scratch.path().join(name));
    let flight = [
        "run",
        shown(&fmu),
        "--stop",
        "2d",
        "--step",
        "10min",
        "--output",
        shown(&csv),
        "--output",
        shown(&of_run),
    ];
    let recorded = "torque.solar,momentum.inertial,attitude.q,sun.litFraction,sun.distance,dump.count";
    run(
        &[&flight[..], &["--set", "start.epoch=2011-04-06 UTC", "--record", recorded, "--quiet"]].concat(),
        0,
    );
    let (dated, _) = drawn(scratch.path(), &["run.csv"]);
    says(&dated, &["uN.m", "AU", "UTC, from 2011-04-06"]);
    // A run has the dates of the epoch that the FMU starts at, as a mission's has.
    assert!(dated == fs::read_to_string(of_run).unwrap(), "{dated}");
    let (svg, _) = drawn(scratch.path(), &["run.csv", "--names", "TORQUE.solar"]);
    assert!(svg.contains("torque.solar") && !svg.contains("momentum"), "{svg}");
    // Beside a table of its own, without what stands beside the first.
    fs::copy(&csv, scratch.path().join("again.csv")).unwrap();
    let (svg, _) = drawn(scratch.path(), &["run.csv", "again.csv", "--names", "torque.solar,dump.count"]);
    says(&svg, &[">run.csv<", ">again.csv<", "torque.solar[3] [uN.m]", ">dump.count<", "UTC"]);
}

#[test]
fn several_tables_have_a_colour_each() {
    let scratch = tempfile::tempdir().unwrap();
    fs::write(scratch.path().join("a.csv"), "time,x[1],x[2]\n0,0,1\n10,1,2\n").unwrap();
    fs::write(scratch.path().join("b.csv"), "time,x[1]\n0,0\n5,2\n20,3\n").unwrap();
    let (svg, _) = drawn(scratch.path(), &["a.csv", "b.csv"]);
    says(&svg, &[">a.csv<", ">b.csv<", ">x[1]<", ">x[2]<", "time [s]"]);
    let lines = |colour: &str| tags(&svg, "path", &format!("stroke=\"{colour}\" stroke-width=\"2\"")).len();
    assert_eq!((lines("#0072b2"), lines("#d55e00")), (2, 1));
    let refused = run_in(scratch.path(), &["plot", "a.csv", "b.csv", "--names", "y"]);
    says(&refused, &["a.csv:1: found no column \"y\", allowed: its columns, as x[1]"]);
}

fn run_in(folder: &Path, arguments: &[&str]) -> String {
    let output = heliotorque(arguments).current_dir(folder).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", text(&output));
    text(&output)
}

#[test]
fn a_histogram_counts_every_run() {
    let scratch = campaign();
    let (svg, printed) =
        drawn(scratch.path(), &["runs.csv", "--histogram", "h[1].final", "--histogram", "center[3]"]);
    says(&printed, &["1 of 401 runs have no number in h[1].final", "p.svg: of 401 rows"]);
    // h runs from 0 to 57 in whole steps: 59 values would be a bar each, but for those at the ends.
    says(&svg, &["h[1].final: 400 runs, mean 28.5", "h[1].final [N.m.s]", "center[3] [m]", "5, 50 and 95 %"]);
    let bars = tags(&svg, "rect", "fill=\"#0072b2\" stroke=\"#ffffff\"");
    let inner = svg.split("center[3]: 401 runs").next().unwrap();
    let bars_of_h = tags(inner, "rect", "fill=\"#0072b2\" stroke=\"#ffffff\"");
    // 20 runs at each of the 20 drawn places; the failed one was drawn from elsewhere.
    let bars_of_center = &bars[bars_of_h.len()..];
    assert_eq!(bars_of_center.len(), 21);
    let heights: Vec<f64> = bars_of_center.iter().map(|bar| number(bar, "height")).collect();
    assert!(heights[..20].iter().all(|it| (it - heights[0]).abs() < 0.2), "{heights:?}");
    assert!((heights[0] / heights[20] - 20.0).abs() < 1.0, "{heights:?}");
}

#[test]
fn a_scatter_has_a_dot_a_run_in_the_colour_of_its_status() {
    let scratch = campaign();
    let (svg, _) = drawn(scratch.path(), &["runs.csv", "--scatter", "center[3],h[1].final"]);
    says(&svg, &["runs.csv: 400 runs", "center[3] [m]", "h[1].final [N.m.s]", ">ok<", ">limit<"]);
    assert_eq!(count(&svg, "r=\"3\" fill=\"#0072b2\""), 300);
    assert_eq!(count(&svg, "r=\"3\" fill=\"#d55e00\""), 100);
    // Over the number of the run too.
    says(&drawn(scratch.path(), &["runs.csv", "--scatter", "run,scale"]).0, &[">run<", ">scale<"]);
}

#[test]
fn a_heat_map_shades_a_cell_for_each_pair_of_values() {
    let scratch = campaign();
    let (svg, _) = drawn(scratch.path(), &["runs.csv", "--heat", "center[3],scale,h[1].final"]);
    says(
        &svg,
        &["mean of h[1].final [N.m.s], 400 runs", "center[3] [m]", ">scale<", ">N.m.s<", ">0<", ">50<"],
    );
    let shaded = tags(&svg, "path", "stroke-width=\"0.6\"");
    assert_eq!(shaded.iter().map(|path| count(path, "z")).sum::<usize>(), 400);
    // The least is at the lower left, in the first shade.
    let first = shaded[0].split('"').nth(1).unwrap();
    assert!(first.starts_with("M106.0,"), "{first}");
}

#[test]
fn a_tornado_sorts_what_each_quantity_changes() {
    let scratch = tempfile::tempdir().unwrap();
    // h = 10 + 100 a - 5 b + c^2 - 1, at means 0, 1, 1 and deviations 0.01, 2, 0.5.
    let h = |a: f64, b: f64, c: f64| 10.0 + 100.0 * a - 5.0 * b + c * c - 1.0;
    let drawn_at = [
        (0.0, 1.0, 1.0),
        (-0.01, 1.0, 1.0),
        (0.01, 1.0, 1.0),
        (0.0, -1.0, 1.0),
        (0.0, 3.0, 1.0),
        (0.0, 1.0, 0.5),
        (0.0, 1.0, 1.5),
    ];
    let rows = drawn_at
        .iter()
        .enumerate()
        .map(|(run, &(a, b, c))| format!("{run},{a},{b},{c},{},ok,\n", h(a, b, c)));
    let text = "run,a,b,c,h.final,status,reason\n".to_owned() + &rows.collect::<String>();
    fs::write(scratch.path().join("runs.csv"), &text).unwrap();
    let beside = |sampling: &str| {
        let vary = "[vary]\nc = 1\na = 1\nb = 1\n[units]\na = \"m\"\n\"h.final\" = \"N.m.s\"\n";
        fs::write(scratch.path().join("runs.csv.toml"), format!("sampling = \"{sampling}\"\n{vary}"))
            .unwrap();
    };
    beside("oneAtATime");
    let (svg, _) = drawn(scratch.path(), &["runs.csv", "--tornado", "h.final"]);
    says(
        &svg,
        &["h.final: 5 with all at their means", "change of h.final [N.m.s]", "- 1 sigma", "+ 1 sigma"],
    );
    let place = |label: &str| svg.find(&format!(">{label}<")).unwrap_or_else(|| panic!("{label}: {svg}"));
    // From the top: b by 10, c by 1.25, a by 1.
    let y = |label: &str| number(&svg[svg[..place(label)].rfind("<text ").unwrap() + 6..], "y");
    assert!(y("b ± 2") < y("c ± 0.5") && y("c ± 0.5") < y("a ± 0.01 m"));
    let width = |colour: &str| -> Vec<f64> {
        let bars = tags(&svg, "rect", &format!("fill=\"{colour}\""))
            .into_iter()
            .filter(|bar| number(bar, "height") < 11.8);
        bars.map(|bar| number(bar, "width")).collect()
    };
    let (minus, plus) = (width("#0072b2"), width("#d55e00"));
    for (widths, changes) in [(&minus, [10.0, 0.75, 1.0]), (&plus, [10.0, 1.25, 1.0])] {
        for (width, change) in widths.iter().zip(changes) {
            assert!((width / minus[0] - change / 10.0).abs() < 0.002, "{minus:?} {plus:?}");
        }
    }
    // Otherwise there are no such runs.
    beside("random");
    says(
        &run_in(scratch.path(), &["plot", "runs.csv", "--tornado", "h.final"]),
        &["runs.csv.toml: sampling: found \"random\", allowed: \"oneAtATime\""],
    );
    beside("oneAtATime");
    fs::write(scratch.path().join("runs.csv"), text.replace("0,0,1,1,5,ok", "0,0,1,1,,failed")).unwrap();
    says(
        &run_in(scratch.path(), &["plot", "runs.csv", "--tornado", "h.final"]),
        &["h.final: found no number in run 0"],
    );
}

#[test]
fn percentiles_are_bands_about_the_median() {
    let scratch = tempfile::tempdir().unwrap();
    let mut table = "time".to_owned();
    let percents = [1, 5, 25, 50, 75, 95, 99];
    for axis in [1, 2] {
        percents.iter().for_each(|percent| table += &format!(",h[{axis}].p{percent}"));
    }
    for day in 0..=10 {
        table += &format!("\n{}", day * 86_400);
        for axis in [1, 2] {
            percents.iter().for_each(|percent| table += &format!(",{}", axis * day * percent));
        }
    }
    fs::write(scratch.path().join("runs-percentiles.csv"), table + "\n").unwrap();
    fs::write(scratch.path().join("runs.csv.toml"), "[units]\n\"h[1].final\" = \"N.m.s\"\n").unwrap();
    let (svg, _) = drawn(scratch.path(), &["runs-percentiles.csv", "--names", "h"]);
    says(
        &svg,
        &[
            "h[1] [N.m.s]",
            ">h[2]<",
            ">median<",
            ">1 to 99 %<",
            ">5 to 95 %<",
            ">25 to 75 %<",
            "time [d]",
            ">1000<",
        ],
    );
    assert_eq!(tags(&svg, "polygon", "fill-opacity").len(), 6);
    let (svg, _) = drawn(scratch.path(), &["runs-percentiles.csv", "--names", "h[2]"]);
    assert!(!svg.contains("h[1]") && tags(&svg, "polygon", "fill-opacity").len() == 3, "{svg}");
}

#[test]
fn kinds_exclude_each_other() {
    let scratch = campaign();
    let usage = |arguments: &[&str]| {
        let output = heliotorque(arguments).current_dir(scratch.path()).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", text(&output));
        text(&output)
    };
    usage(&["plot", "runs.csv", "--histogram", "scale", "--scatter", "scale,run"]);
    usage(&["plot", "runs.csv", "--names", "scale", "--tornado", "scale"]);
    says(&usage(&["plot", "runs.csv", "--scatter", "scale"]), &["--scatter", "two names"]);
    says(&usage(&["plot", "runs.csv", "--heat", "run,scale"]), &["--heat", "three names"]);
    usage(&["plot"]);
    // The picture takes the table's name, and - is the standard output.
    let output = heliotorque(&["plot", "runs.csv", "--histogram", "scale"])
        .current_dir(scratch.path())
        .output()
        .unwrap();
    says(&text(&output), &["runs.svg: of 401 rows"]);
    let named = fs::read(scratch.path().join("runs.svg")).unwrap();
    let output = heliotorque(&["plot", "runs.csv", "--histogram", "scale", "--output", "-"])
        .current_dir(scratch.path())
        .output()
        .unwrap();
    assert_eq!(output.stdout, named);
}
