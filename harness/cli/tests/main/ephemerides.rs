//! An ephemeris is fitted from an FMU's flight, reported, packed and used; what is wrong is reported by name.

use std::fs;

use physics::bodies::Body;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::onboard::{OnboardEphemeris, OnboardTarget};
use physics::numerics::Span;

use crate::{packed, run, says, shown, template};

const START: &str = "2011-04-06 UTC";
const STOP: &str = "2011-04-16 UTC";

/// Ten days from Mercury, right as it stands.
const SMALL: &str = "frame = \"EME2000\"\n[[body]]\nbody = \"sun\"\ncenter = \"mercury\"\ndegree = 0\nerror_m = 1.0\n\
                     error_m_s = 0.1\nsegment = [{ start_s = 0.0, end_s = 864000.0, x_m = [5e10], y_m = [0], z_m = [0] }]\n";

#[test]
fn a_file_is_reported_and_a_torn_one_refused_by_line() {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("mine.toml");
    fs::write(&path, SMALL).unwrap();
    let text = run(&["check", shown(&path)], 0);
    let reported = ["ok", "sun", "mercury", "2000-01-01T11:58:55", "2000-01-11T11:58:55", "1 m", "0.1 m/s"];
    assert!(reported.iter().all(|word| text.contains(word)), "{text}");
    for (old, new, printed) in [
        ("error_m = 1.0", "error_m = nan", "mine.toml:6: body[1].error_m: found NaN"),
        ("[[body]]", "[[bodies]]", "found the unknown key `bodies`, allowed: frame, source, body, coarse"),
        ("x_m = [5e10]", "x_m = [5e10, 1]", "mine.toml:8: body[1].segment[1].x_m: found 2 coefficients"),
        ("z_m = [0] }]", "z_m = [0", "not TOML"),
    ] {
        fs::write(&path, SMALL.replace(old, new)).unwrap();
        let text = run(&["check", shown(&path)], 1);
        assert!(text.contains(printed), "{new}: {text}");
    }
    assert!(run(&["new", "--schema", "ephemeris"], 0).contains("heliotorque ephemeris"));
}

#[test]
fn dates_and_sources_that_cannot_be_are_refused_by_name() {
    let Some((_scratch, fmu)) = packed("Empty") else { return };
    let ask = |start: &str, stop: &str| {
        run(&["ephemeris", "--template", shown(&fmu), "--start", start, "--stop", stop], 2)
    };
    assert!(
        ask("2011-04-06", STOP)
            .contains("--start: found \"2011-04-06\", which does not end in UTC, Z, TDB, TT or TAI")
    );
    assert!(ask(STOP, START).contains("--stop: found \"2011-04-06 UTC\", allowed: a date after --start"));
    assert!(ask(START, STOP).contains("Empty has no variable start.epoch, allowed: a MomentumPlant"));
}

/// Greatest error that a table tells in its row of a body, in m.
fn reported_m(text: &str, body: &str) -> f64 {
    let row = text.lines().find(|line| line.contains(body) && line.contains(" m/s")).unwrap();
    let words: Vec<&str> = row.split_whitespace().collect();
    let unit = words.iter().position(|word| *word == "m").unwrap();
    words[unit - 1].parse().unwrap()
}

/// A file places these bodies from Mercury as VSOP87 does, in m.
fn placed_by_theory(text: &str, bodies: &[Body], within_m: f64) {
    // Beside the file stands what the program says of it.
    let lines =
        text.lines().skip_while(|line| !line.starts_with("frame")).take_while(|line| !line.starts_with("-:"));
    let text: String = lines.map(|line| line.to_owned() + "\n").collect();
    let read = OnboardEphemeris::from_toml("planets.toml", &text).unwrap();
    assert_eq!(read.precise.len(), bodies.len(), "{text}");
    let mut theory = Ephemeris::default();
    for (model, body) in read.precise.iter().zip(bodies) {
        assert_eq!(model.target, OnboardTarget::from(*body));
        let Span { start_s: first_s, end_s: last_s } = model.motion.span();
        for share in [0.1, 0.55, 0.9] {
            let at_s = first_s + share * (last_s - first_s);
            let from_mercury_m =
                theory.state(*body, at_s).position_m - theory.state(Body::Mercury, at_s).position_m;
            let off_m = (model.motion.state(at_s).unwrap().position_m - from_mercury_m).norm();
            assert!(off_m < within_m, "{}: {off_m} m", model.target);
        }
    }
}

#[test]
fn a_flight_is_fitted_to_the_tolerance_and_simulated_by_another_fmu() {
    let Some((scratch, plant)) = template() else { return };
    let path = |name: &str| scratch.path().join(name);
    let (fitted, file) = (path("Fitted.fmu"), path("flown.toml"));
    let pack = ["pack", "--template", shown(&plant), "--model", "MomentumPlant", "--output"];
    let span = ["ephemeris", "--template", shown(&plant), "--start", START, "--stop", STOP, "--output"];
    let make = [&span[..], &[shown(&file)]].concat();
    let text = run(
        &[&make[..], &["--tolerance", "500", "--coarse", "--bodies", "sun,earth,spacecraft"]].concat(),
        0,
    );
    for body in ["sun", "earth", "spacecraft"] {
        let error_m = reported_m(&text, &format!(" {body} "));
        assert!(error_m <= 500.0, "{body}: {text}");
    }
    // The file says the same.
    let again = run(&["check", shown(&file)], 0);
    assert_eq!(text.lines().skip(1).collect::<Vec<_>>(), again.lines().skip(1).collect::<Vec<_>>());
    let impossible = run(&[&make[..], &["--tolerance", "1e-9", "--segment", "5d"]].concat(), 2);
    assert!(impossible.contains("--tolerance: no fit of sun up to degree 16 keeps"), "{impossible}");
    // Any planet, the Moon from kernels alone.
    let make = [&span[..], &["-", "--bodies"]].concat();
    let planets = run(&[&make[..], &["venus,jupiter", "--tolerance", "500"]].concat(), 0);
    placed_by_theory(&planets, &[Body::Venus, Body::Jupiter], 600.0);
    let moon = run(&[&make[..], &["moon"]].concat(), 2);
    assert!(moon.contains("--bodies moon: allowed with --kernel"), "{moon}");
    // Another FMU uses it within its span alone.
    let set = ["--set", "ephemeris.source=chebyshev", "--ephemeris", shown(&file)];
    let refusal = run(&[&pack[..], &[shown(&fitted)], &set].concat(), 2);
    says(&refusal, &["the FMU is not written", "start.epoch: found"]);
    let epoch = format!("start.epoch={START}");
    run(&[&pack[..], &[shown(&fitted)], &set, &["--set", &epoch]].concat(), 0);
    assert!(run(&["info", shown(&fitted)], 0).contains("sun from mercury"));
    let record = path("record.csv");
    let simulate = |epoch: &str, status: i32| {
        let epoch = format!("start.epoch={epoch}");
        let output = ["--record", "sun.positionInertial", "--output", shown(&record)];
        let run_it = ["run", shown(&fitted), "--stop", "1d", "--quiet", "--set", &epoch];
        run(&[&run_it[..], &output].concat(), status)
    };
    simulate("2011-04-07 UTC", 0);
    let text = simulate("2011-05-07 UTC", 2);
    assert!(text.contains("start.epoch: found") && text.contains("ephemeris.toml places sun"), "{text}");
    // It is no source for a span it does not cover, either.
    let beyond = ["--start", "2011-05-06 UTC", "--stop", "2011-05-07 UTC", "--output", "-"];
    let text = run(&[&["ephemeris", "--template", shown(&fitted)], &beyond[..]].concat(), 2);
    assert!(text.contains("Fitted.fmu") && text.contains("ephemeris.toml places sun"), "{text}");
    let text = run(
        &[
            "ephemeris",
            "--template",
            shown(&fitted),
            "--start",
            START,
            "--stop",
            "2011-05-07 UTC",
            "--output",
            "-",
        ],
        2,
    );
    assert!(text.contains("Fitted.fmu") && text.contains("the epoch at the end of the step"), "{text}");
}
