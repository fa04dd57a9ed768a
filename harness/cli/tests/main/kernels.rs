//! SPICE kernels are fitted as SPICE reads them; what is wrong with them is reported by name.
//!
//! `tests/kernels/make_kernels.py` wrote them by CSPICE: every body moves on a circle, whose closed form stands here again.

use std::{
    f64::consts::TAU,
    fs,
    path::{Path, PathBuf},
};

use physics::constants::{GM_EARTH_M3_S2, GM_MERCURY_M3_S2, GM_SUN_M3_S2};
use physics::environment::onboard::{OnboardEphemeris, OnboardTarget};

use crate::{run, says, shown, template};

/// 2011-04-02 TDB, where both kernels begin.
const START_S: f64 = 354_974_400.0;
const START: &str = "2011-04-02 TDB";
const DAY_S: f64 = 86_400.0;

/// A circle: radius in km, period in s, phase at the start and inclination to the equator in rad.
type Circle = [f64; 4];

const SUN: Circle = [742_000.0, 4332.6 * DAY_S, 0.4, 0.41];
const MERCURY: Circle = [57_909_000.0, 87.969 * DAY_S, 1.1, 0.53];
const EARTH_AND_MOON: Circle = [149_598_000.0, 365.256 * DAY_S, 2.3, 0.409];
const EARTH: Circle = [4_671.0, 27.3217 * DAY_S, 5.0, 0.42];
const CRAFT: Circle = [10_136.0, 12.07 * 3600.0, 0.7, 1.44];

/// Position in m.
fn at([radius_km, period_s, phase, inclination]: Circle, epoch_s: f64) -> [f64; 3] {
    let (sin, cos) = (phase + TAU * (epoch_s - START_S) / period_s).sin_cos();
    [cos, sin * inclination.cos(), sin * inclination.sin()].map(|value| 1e3 * radius_km * value)
}

/// Position of a body from Mercury, in m.
fn truth_m(target: OnboardTarget, epoch_s: f64) -> [f64; 3] {
    let sum = |circles: &[(f64, Circle)]| {
        circles.iter().fold([0.0; 3], |sum, (sign, circle)| {
            let position = at(*circle, epoch_s);
            [0, 1, 2].map(|i| sum[i] + sign * position[i])
        })
    };
    match target {
        OnboardTarget::Sun => sum(&[(1.0, SUN), (-1.0, MERCURY)]),
        OnboardTarget::Earth => sum(&[(1.0, EARTH_AND_MOON), (1.0, EARTH), (-1.0, MERCURY)]),
        _ => sum(&[(1.0, CRAFT)]),
    }
}

/// A committed kernel.
fn kernel(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join("kernels").join(name)
}

/// The command with kernels from the start to a date.
#[track_caller]
fn fit(kernels: &[&Path], stop: &str, more: &[&str], status: i32) -> String {
    let mut arguments = vec!["ephemeris", "--start", START, "--stop", stop];
    for kernel in kernels {
        arguments.extend(["--kernel", shown(kernel)]);
    }
    if !more.contains(&"--output") {
        arguments.extend(["--output", "-"]);
    }
    run(&[&arguments[..], more].concat(), status)
}

/// What it wrote.
fn fitted(kernels: &[&Path], stop: &str, more: &[&str]) -> OnboardEphemeris {
    let scratch = tempfile::tempdir().unwrap();
    let file = scratch.path().join("flown.toml");
    fit(kernels, stop, &[&["--output", shown(&file)], more].concat(), 0);
    OnboardEphemeris::from_toml("flown.toml", &fs::read_to_string(file).unwrap()).unwrap()
}

/// The greatest error of a precise model in a span, in m, at epochs of which the fit knows none.
fn worst_m(ephemeris: &OnboardEphemeris, target: OnboardTarget, days: f64) -> f64 {
    let model = ephemeris.precise.iter().find(|it| it.target == target).unwrap();
    let error_m = |k: u32| {
        let epoch_s = START_S + days * DAY_S * f64::from(k) / 3001.0;
        let (found, truth) = (model.motion.state(epoch_s).unwrap().position_m, truth_m(target, epoch_s));
        (0..3).map(|i| (found[i] - truth[i]).powi(2)).sum::<f64>().sqrt()
    };
    (0..3001).map(error_m).fold(0.0, f64::max)
}

#[test]
fn fits_keep_their_error_against_the_closed_form() {
    let (planets, spacecraft_spk) = (kernel("planets.bsp"), kernel("craft.bsp"));
    let both = [planets.as_path(), &spacecraft_spk];
    let bodies = ["--bodies", "sun,earth,spacecraft", "--tolerance", "20", "--coarse"];
    let made = fitted(&both, "2011-04-04 TDB", &bodies);
    let source = made.source.as_deref().unwrap();
    assert_eq!(source, "SPK planets.bsp, craft.bsp from Mercury (199), spacecraft -236");
    for model in &made.precise {
        let (stated_m, found_m) = (model.error.position_m, worst_m(&made, model.target, 2.0));
        assert!(stated_m <= 20.0, "{}: {stated_m}", model.target);
        // The greatest error between the epochs that the fit looks at, and the kernels' own millimetre.
        assert!(found_m <= 1.05 * stated_m + 0.01, "{}: {found_m} m, said {stated_m} m", model.target);
        assert!(found_m >= 0.5 * stated_m, "{}: {found_m} m, said {stated_m} m", model.target);
    }
    // The kernels' velocities are the slopes of their positions.
    assert!(made.precise.iter().all(|model| model.error.velocity_m_s < 0.5));
    assert_eq!(made.precise.len(), 3);
    // Sun to planet, Sun to Earth, planet to spacecraft.
    assert_eq!(made.coarse.len(), 3);
    // Over the joints of the kernel's own polynomials, whose degree this is.
    let made = fitted(&both[..1], "2011-04-26 TDB", &["--degree", "14", "--segment", "8d"]);
    for target in [OnboardTarget::Sun, OnboardTarget::Earth] {
        assert!(worst_m(&made, target, 24.0) < 0.05, "{target}");
    }
}

#[test]
fn bodies_go_by_name_and_by_naif_id() {
    let (planets, spacecraft_spk) = (kernel("planets.bsp"), kernel("craft.bsp"));
    let both = [planets.as_path(), &spacecraft_spk];
    let by_name = ["--bodies", "sun,earth,spacecraft", "--center", "mercury", "--spacecraft", "messenger"];
    let by_id = ["--bodies", "10,399,spacecraft", "--center", "199", "--spacecraft", "-236"];
    let [named, numbered] = [by_name, by_id].map(|options| fitted(&both, "2011-04-03 TDB", &options));
    assert_eq!(named, numbered);
    // Other spacecraft, whose segments are of other types, up to the very end of these.
    for spacecraft in ["-121", "-122", "-123"] {
        let other = ["--bodies", "spacecraft", "--spacecraft", spacecraft, "--tolerance", "1"];
        let other = fitted(&both[1..], "2011-04-02T12:00 TDB", &other);
        assert!(worst_m(&other, OnboardTarget::Spacecraft, 0.5) <= 1.05, "{spacecraft}");
    }
    // A planet as well as the Sun: Mercury from the Sun stands opposite to the Sun from Mercury.
    let from_sun = fitted(&both, "2011-04-03 TDB", &["--bodies", "mercury", "--center", "sun"]);
    let epoch_s = START_S + 0.37 * DAY_S;
    let found = from_sun.precise[0].motion.state(epoch_s).unwrap().position_m;
    let sun = truth_m(OnboardTarget::Sun, epoch_s);
    let off_m = (0..3).map(|i| (found[i] + sun[i]).powi(2)).sum::<f64>().sqrt();
    assert!(off_m <= 100.0 && from_sun.precise[0].target == OnboardTarget::Mercury, "{off_m} m");
    // From another center the same places.
    let from_sun = fitted(&both, "2011-04-03 TDB", &["--bodies", "earth", "--center", "sun"]);
    let model = &from_sun.precise[0];
    let epoch_s = START_S + 0.37 * DAY_S;
    let [sun, earth] = [OnboardTarget::Sun, OnboardTarget::Earth].map(|target| truth_m(target, epoch_s));
    let found = model.motion.state(epoch_s).unwrap().position_m;
    let off_m = (0..3).map(|i| (found[i] - (earth[i] - sun[i])).powi(2)).sum::<f64>().sqrt();
    assert!(off_m <= 100.0, "{off_m} m");
}

/// Newton's law for a spacecraft at `r` m from the Sun, by the circles of the kernels.
fn fall_m_s2(r: [f64; 3], epoch_s: f64) -> [f64; 3] {
    let toward = |d: [f64; 3], gm: f64| {
        let cubed = d.iter().map(|x| x * x).sum::<f64>().powf(1.5);
        d.map(|x| gm * x / cubed)
    };
    let sun_m = truth_m(OnboardTarget::Sun, epoch_s);
    let mercury_m = sun_m.map(|x| -x);
    let earth_m = {
        let from_mercury_m = truth_m(OnboardTarget::Earth, epoch_s);
        [0, 1, 2].map(|i| from_mercury_m[i] - sun_m[i])
    };
    let mut sum = toward(r.map(|x| -x), GM_SUN_M3_S2);
    for (place_m, gm) in [(mercury_m, GM_MERCURY_M3_S2), (earth_m, GM_EARTH_M3_S2)] {
        let [direct, indirect] = [[0, 1, 2].map(|i| place_m[i] - r[i]), place_m].map(|d| toward(d, gm));
        sum = [0, 1, 2].map(|i| sum[i] + direct[i] - indirect[i]);
    }
    sum
}

#[test]
fn a_flight_between_planets_goes_by_kernels() {
    let Some((scratch, plant)) = template() else { return };
    let planets = kernel("planets.bsp");
    let path = |name: &str| scratch.path().join(name);
    let (file, fmu, record) = (path("planets.toml"), path("ByKernel.fmu"), path("record.csv"));
    let bodies = ["--bodies", "mercury,earth", "--center", "sun", "--degree", "14", "--segment", "8d"];
    fit(&[&planets], "2011-04-25 TDB", &[&bodies[..], &["--output", shown(&file)]].concat(), 0);
    let pack = ["pack", "--template", shown(&plant), "--model", "MomentumPlant", "--output", shown(&fmu)];
    run(&[&pack[..], &["--ephemeris", shown(&file)]].concat(), 0);
    // On the way to Mercury, past it within its sphere of influence.
    let [mercury_m, later_m] = [0.0, 1.0].map(|at_s| truth_m(OnboardTarget::Sun, START_S + at_s).map(|x| -x));
    let off_m = [1.6e8, 5e7, 2e7];
    let mut r: [f64; 3] = [0, 1, 2].map(|i| mercury_m[i] + off_m[i]);
    let mut v: [f64; 3] =
        [0, 1, 2].map(|i| later_m[i] - mercury_m[i] - off_m[i] / 1e5 + [0.0, 800.0, 0.0][i]);
    let epoch = format!("start.epoch={START_S:e}");
    let mut sets = vec![
        epoch,
        "orbit.center=sun".to_owned(),
        "orbit.source=inputs".to_owned(),
        "orbit.dynamics=nBody".to_owned(),
        "ephemeris.source=chebyshev".to_owned(),
        "orbit.radiationFeedback=false".to_owned(),
        "orbit.relativity=false".to_owned(),
        // The kernel's Mercury moves on a circle at a rate of its own, so the path counts from the Sun throughout.
        "orbit.changeCenter=false".to_owned(),
    ];
    sets.extend(["venus", "moon", "mars", "jupiter"].map(|body| format!("orbit.attraction.{body}=false")));
    sets.extend((0..3).map(|i| format!("orbit.position[{}]={:e}", i + 1, r[i])));
    sets.extend((0..3).map(|i| format!("orbit.velocity[{}]={:e}", i + 1, v[i])));
    let mut arguments = vec!["run", shown(&fmu), "--stop", "20d", "--step", "1d", "--quiet"];
    arguments.extend(["--record", "position", "--output", shown(&record)]);
    arguments.extend(sets.iter().flat_map(|set| ["--set", set.as_str()]));
    run(&arguments, 0);
    // Runge and Kutta's method of fourth order in steps of five minutes.
    let h = 300.0;
    let moved = |r: [f64; 3], v: [f64; 3], h: f64| [0, 1, 2].map(|i| r[i] + h * v[i]);
    let mut nearest_m = f64::INFINITY;
    for step in 0..5760 {
        let at_s = START_S + h * f64::from(step);
        let sun_m = truth_m(OnboardTarget::Sun, at_s);
        nearest_m = nearest_m.min((0..3).map(|i| (r[i] + sun_m[i]).powi(2)).sum::<f64>().sqrt());
        let k1 = (v, fall_m_s2(r, at_s));
        let half = |k: ([f64; 3], [f64; 3]), h: f64, at_s: f64| {
            (moved(v, k.1, h), fall_m_s2(moved(r, k.0, h), at_s))
        };
        let k2 = half(k1, h / 2.0, at_s + h / 2.0);
        let k3 = half(k2, h / 2.0, at_s + h / 2.0);
        let k4 = half(k3, h, at_s + h);
        let mean = |a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]| {
            [0, 1, 2].map(|i| (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0)
        };
        (r, v) = (moved(r, mean(k1.0, k2.0, k3.0, k4.0), h), moved(v, mean(k1.1, k2.1, k3.1, k4.1), h));
    }
    let text = fs::read_to_string(&record).unwrap();
    let last: Vec<&str> = text.lines().last().unwrap().split(',').collect();
    let off_m: f64 = (0..3).map(|i| (last[i + 1].parse::<f64>().unwrap() - r[i]).powi(2)).sum::<f64>().sqrt();
    assert!(last[0].starts_with("1728000") && off_m < 10.0, "{off_m} m: {text}");
    // It went through Mercury's sphere of influence.
    assert!(nearest_m < 1.12e8, "{nearest_m}");
}

#[test]
fn a_span_that_is_not_covered_is_reported_with_the_one_that_is() {
    let (planets, spacecraft_spk) = (kernel("planets.bsp"), kernel("craft.bsp"));
    let both = [planets.as_path(), &spacecraft_spk];
    let text = fit(&both, "2011-05-04 UTC", &[], 2);
    says(
        &text,
        &[
            "--start, --stop: found 2011-04-01T23:58:53.814 UTC to 2011-05-04T00:00:00 UTC",
            "allowed: from 2011-04-01T23:58:53.814 UTC to 2011-04-25T23:58:53.814 UTC",
            "planets.bsp, craft.bsp places Sun (10)",
        ],
    );
    let text = fit(&both, "2011-04-05 TDB", &["--bodies", "spacecraft"], 2);
    assert!(text.contains("to 2011-04-03T23:58:53.814 UTC") && text.contains("MESSENGER (-236)"), "{text}");
    // A gap within the span.
    let text = fit(&both, "2011-04-03T06:00 TDB", &["--bodies", "spacecraft", "--spacecraft", "-121"], 2);
    let spans = "from 2011-04-01T23:58:53.814 UTC to 2011-04-02T11:58:53.814 UTC or from \
                 2011-04-02T23:58:53.814 UTC to 2011-04-03T11:58:53.814 UTC";
    assert!(text.contains(spans) && text.contains("spacecraft -121"), "{text}");
    // The coarse models may reach further than the kernels.
    let text = fit(&both, "2011-04-04 TDB", &["--coarse", "--coarse-until", "2011-06-01 UTC"], 2);
    assert!(text.contains("to 2011-06-01T00:00:00 UTC, allowed"), "{text}");
    // Before UTC dates are in TDB.
    let early =
        ["ephemeris", "--start", "1950-01-01 TDB", "--stop", "1950-02-01 TDB", "--output", "-", "--kernel"];
    let text = run(&[&early[..], &[shown(&planets)]].concat(), 2);
    assert!(text.contains("found 1950-01-01T00:00:00 TDB to 1950-02-01T00:00:00 TDB"), "{text}");
}

#[test]
fn a_body_that_no_kernel_holds_is_reported_with_those_that_are() {
    let (planets, spacecraft_spk) = (kernel("planets.bsp"), kernel("craft.bsp"));
    let text = fit(&[&planets], "2011-04-03 TDB", &["--bodies", "spacecraft"], 2);
    says(&text, &["--kernel: found no MESSENGER (-236) in planets.bsp, allowed: Solar System"]);
    let text = fit(&[&spacecraft_spk], "2011-04-03 TDB", &[], 2);
    assert!(text.contains("found no Sun (10) in craft.bsp, allowed: MESSENGER (-236)"), "{text}");
    let text = fit(&[&planets], "2011-04-03 TDB", &["--center", "jupiter"], 2);
    assert!(text.contains("found no Jupiter (599) in planets.bsp"), "{text}");
    let text = fit(&[&planets], "2011-04-03 TDB", &["--bodies", "moon"], 2);
    assert!(text.contains("found no Moon (301) in planets.bsp"), "{text}");
    let text = fit(&[&planets], "2011-04-03 TDB", &["--bodies", "venus"], 2);
    assert!(text.contains("found no Venus (299) in planets.bsp"), "{text}");
    let text = fit(&[&planets], "2011-04-03 TDB", &["--center", "saturn"], 2);
    assert!(text.contains("--center <BODY>") && text.contains("or its NAIF id"), "{text}");
    let text = fit(&[&planets], "2011-04-03 TDB", &["--center", "sun"], 2);
    assert!(text.contains("--bodies: sun is the center"), "{text}");
    let text = fit(&[&planets], "2011-04-03 TDB", &["--spacecraft", "-236"], 2);
    assert!(text.contains("--spacecraft: allowed where --bodies names the spacecraft"), "{text}");
    // What belongs to kernels stands beside them, and what belongs to a flight does not.
    assert!(fit(&[], "2011-04-03 TDB", &["--center", "sun"], 2).contains("--kernel <BSP>"));
    let text = fit(&[&planets], "2011-04-03 TDB", &["--set", "orbit.center=sun"], 2);
    assert!(text.contains("cannot be used with"), "{text}");
}

/// A kernel with other bytes at a place.
fn patched(bytes: &[u8], place: usize, new: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes[place..place + new.len()].copy_from_slice(new);
    bytes
}

#[test]
fn damaged_and_foreign_files_are_refused_by_name() {
    let bytes = fs::read(kernel("craft.bsp")).unwrap();
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("mine.bsp");
    let refused = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        fit(&[&path], "2011-04-03 TDB", &["--bodies", "spacecraft"], 2)
    };
    // The list of the segments is record 2: next, previous, count, and 40 bytes for each segment.
    let (list, second) = (1024, 1024 + 24 + 40);
    let frame = patched(&bytes, second + 24, &17_i32.to_ne_bytes());
    for (what, bytes, printed) in [
        (
            "torn in the data",
            bytes[..bytes.len() - 1500].to_vec(),
            "mine.bsp: torn or damaged: the segment of",
        ),
        ("torn in the list", bytes[..1500].to_vec(), "mine.bsp: torn or damaged: it has no record 2"),
        ("torn at once", bytes[..60].to_vec(), "mine.bsp: torn or damaged"),
        ("empty", Vec::new(), "mine.bsp: found another kind of file, allowed: an SPK kernel"),
        ("text", b"frame = \"EME2000\"\n".repeat(200), "mine.bsp: found another kind of file"),
        ("attitude", patched(&bytes, 0, b"DAF/CK  "), "mine.bsp: found DAF/CK, allowed: an SPK kernel"),
        (
            "big-endian",
            patched(&bytes, 88, b"BIG-IEEE"),
            "found the order of bytes BIG-IEEE, allowed: LTL-IEEE",
        ),
        ("no end", patched(&bytes, list, &2.0_f64.to_ne_bytes()), "the list of its segments has no end"),
        ("no such record", patched(&bytes, list, &900.0_f64.to_ne_bytes()), "it has no record 900"),
        ("ecliptic", frame, "mine.bsp: MESSENGER (-236): found frame 17, allowed: 1, J2000"),
        (
            "type 21",
            patched(&bytes, second + 28, &21_i32.to_ne_bytes()),
            "found data type 21, allowed: 1, 2, 3",
        ),
        (
            "starts at 0",
            patched(&bytes, second + 32, &0_i32.to_ne_bytes()),
            "torn or damaged: the segment of",
        ),
    ] {
        let text = refused(&bytes);
        assert!(text.contains(printed), "{what}: {text}");
    }
    let absent = scratch.path().join("none.bsp");
    assert!(fit(&[&absent], "2011-04-03 TDB", &[], 2).contains("none.bsp: "));
    // No kernel is overwritten by what is made of it.
    fs::write(&path, &bytes).unwrap();
    let text = fit(&[&path], "2011-04-03 TDB", &["--bodies", "spacecraft", "--output", shown(&path)], 2);
    assert!(text.contains("--output") && fs::read(&path).unwrap() == bytes, "{text}");
}
