//! `map`: what it says of a spacecraft is what the FMU itself says, direction by direction; refusals name what is wrong.

use std::{
    collections::HashMap,
    fs,
    path::{Path, PathBuf},
};

use fmi::{Fmu, Instance, InstanceOptions, Value};
use resvg::usvg::roxmltree::Document;
use tempfile::TempDir;

use crate::{heliotorque, library, packed_from, run, says, shown, text, words};

const MESSENGER: &str = "../../fmu-src/resources/messenger.toml";
const AU_M: f64 = 149_597_870_700.0;

type MapRow = HashMap<String, f64>;

/// Packs DisturbanceTorque of a file; maps can take its library too.
fn packed(spacecraft: &str) -> Option<(TempDir, PathBuf)> {
    packed_from(&library()?, "DisturbanceTorque", "torque.fmu", &["--spacecraft", spacecraft])
}

/// Runs `map` with one of its files on the standard output.
fn mapped(arguments: &[&str]) -> String {
    let output = heliotorque(&[&["map"], arguments].concat()).output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    String::from_utf8(output.stdout).unwrap()
}

fn rows(csv: &str) -> Vec<MapRow> {
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| {
            let cells = names.iter().zip(line.split(','));
            cells.map(|(name, cell)| ((*name).to_owned(), cell.parse().unwrap_or(f64::NAN))).collect()
        })
        .collect()
}

/// The FMU without a planet, stepped direction by direction.
struct Torque {
    instance: Instance,
    panels: usize,
    time_s: f64,
}

impl Torque {
    fn new(fmu: &Fmu) -> Self {
        let mut instance = Instance::new(fmu, "test", &InstanceOptions::default()).unwrap();
        instance.set("planet.present", &Value::Boolean(false)).unwrap();
        instance.setup_experiment(None, 0.0, None).unwrap();
        instance.enter_initialization_mode().unwrap();
        instance.exit_initialization_mode().unwrap();
        let panels = (1..).take_while(|k| fmu.find(&format!("panel[{k}].angle")).is_some()).count();
        Self { instance, panels, time_s: 0.0 }
    }

    /// Torque and force of sunlight with panels at these angles.
    fn at(&mut self, azimuth_deg: f64, elevation_deg: f64, distance_m: f64, angles_rad: &[f64]) -> [f64; 6] {
        let ((sin_a, cos_a), (sin_e, cos_e)) =
            (azimuth_deg.to_radians().sin_cos(), elevation_deg.to_radians().sin_cos());
        for (k, part) in [cos_e * sin_a, -cos_e * cos_a, -sin_e].into_iter().enumerate() {
            self.instance.set_real(&format!("sun.positionBody[{}]", k + 1), part * distance_m).unwrap();
        }
        assert_eq!(angles_rad.len(), self.panels);
        for (k, angle_rad) in angles_rad.iter().enumerate() {
            self.instance.set_real(&format!("panel[{}].angle", k + 1), *angle_rad).unwrap();
        }
        self.instance.do_step(self.time_s, 1.0, true).unwrap();
        self.time_s += 1.0;
        [0, 1, 2, 3, 4, 5].map(|k| {
            let load = if k < 3 { "torque" } else { "force" };
            self.instance.get_real(&format!("{load}.solar[{}]", k % 3 + 1)).unwrap()
        })
    }
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Cells of MESSENGER's panels, whose axes are X, 65 deg off the Sun: angles about the axis from the cells' normal -Y.
///
/// Cells with a normal n = [0, -cos a, -sin a] see the Sun s at n.s = -s_y cos a - s_z sin a; bisected from facing it on.
fn messenger_angle_rad(azimuth_deg: f64, elevation_deg: f64, offset_rad: f64) -> f64 {
    let (a, e) = (azimuth_deg.to_radians(), elevation_deg.to_radians());
    let (toward, across) = (e.cos() * a.cos(), e.sin());
    let cosine = |angle: f64| toward * angle.cos() + across * angle.sin();
    let facing = across.atan2(toward);
    let (mut low, mut high) = (facing, facing + core::f64::consts::PI);
    if cosine(low) < offset_rad.cos() {
        return facing;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if cosine(middle) > offset_rad.cos() { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[test]
fn every_direction_is_what_the_fmu_says() {
    let Some((_room, fmu_path)) = packed(MESSENGER) else { return };
    let fmu = Fmu::open(&fmu_path).unwrap();
    let csv = mapped(&words(&format!(
        "{MESSENGER} --template {} --distance 0.3 --step 1deg --output - --quiet",
        shown(&fmu_path)
    )));
    let rows = rows(&csv);
    assert_eq!(rows.len(), 360 * 181);
    let mut torque = Torque::new(&fmu);
    let columns = [["torque_x_n_m", "torque_y_n_m", "torque_z_n_m"], ["force_x_n", "force_y_n", "force_z_n"]];
    let greatest =
        columns.map(|names| rows.iter().map(|row| norm(&names.map(|name| row[name]))).fold(0.0, f64::max));
    for row in &rows {
        let (azimuth, elevation) = (row["sun_azimuth_deg"], row["sun_elevation_deg"]);
        let angles = [row["panel_1_angle_deg"], row["panel_2_angle_deg"]].map(f64::to_radians);
        // On the axis any angle does.
        if elevation != 0.0 || azimuth.abs() != 90.0 {
            let expected = messenger_angle_rad(azimuth, elevation, 65_f64.to_radians());
            let apart = (angles[0] - expected).sin().abs();
            assert!(apart < 1e-7 && (angles[0] - expected).cos() > 0.0, "{row:?}: {expected}");
        }
        let found = torque.at(azimuth, elevation, 0.3 * AU_M, &angles);
        for ((names, values), greatest) in columns.iter().zip(found.chunks(3)).zip(greatest) {
            for (name, value) in names.iter().zip(values) {
                assert!((row[*name] - value).abs() <= 1e-14 * greatest, "{row:?}: {name} {value}");
            }
        }
    }
}

#[test]
fn lines_and_balances_are_where_the_torque_vanishes() {
    let Some((_room, fmu_path)) = packed(MESSENGER) else { return };
    let fmu = Fmu::open(&fmu_path).unwrap();
    for center_m in [[0.0; 3], [0.01, 0.02, -0.05]] {
        let set = format!("spacecraft.centerOfMass={}m,{}m,{}m", center_m[0], center_m[1], center_m[2]);
        let csv = |options: &[&str]| {
            let spacecraft = [MESSENGER, "--template", shown(&fmu_path), "--distance", "0.4", "--set", &set];
            mapped(&[&spacecraft[..], &["--step", "2deg", "--quiet"], options, &["-"]].concat())
        };
        let mut torque = Torque::new(&fmu);
        for (axis, value) in center_m.into_iter().enumerate() {
            torque.instance.set_real(&format!("spacecraft.centerOfMass[{}]", axis + 1), value).unwrap();
        }
        let sphere = rows(&csv(&["--output"]));
        let most = ["torque_x_n_m", "torque_y_n_m", "torque_z_n_m"]
            .map(|name| sphere.iter().map(|row| row[name].abs()).fold(0.0, f64::max));
        let lines = csv(&["--no-picture", "--lines"]);
        let mut counts = HashMap::new();
        for (line, row) in lines.lines().skip(1).zip(rows(&lines)) {
            let [azimuth, elevation] = ["sun_azimuth_deg", "sun_elevation_deg"].map(|name| row[name]);
            let is_in_zone = azimuth.abs() <= 15.0 + 1e-9 && elevation.abs() <= 13.0 + 1e-9;
            assert!(line.starts_with("all") || is_in_zone, "{line}");
            let angle_rad = messenger_angle_rad(azimuth, elevation, 65_f64.to_radians());
            let found = torque.at(azimuth, elevation, 0.4 * AU_M, &[angle_rad; 2]);
            let axes = line.split(',').nth(1).unwrap();
            for axis in axes.chars().map(|letter| "xyz".find(letter).unwrap()) {
                assert!(
                    found[axis].abs() <= 1e-12 * most[axis],
                    "{line}: {:e} of {:e}",
                    found[axis],
                    most[axis]
                );
            }
            *counts.entry((line.split(',').next().unwrap().to_owned(), axes.to_owned())).or_insert(0) += 1;
        }
        for axis in ["x", "z"] {
            assert!(
                ["all", "zone"].iter().all(|at| counts[&((*at).to_owned(), axis.to_owned())] > 50),
                "{counts:?}"
            );
        }
        assert_eq!(counts[&("zone".to_owned(), "xz".to_owned())], 1, "{counts:?}");
    }
}

#[test]
fn a_degree_is_worth_what_differences_say() {
    let Some((_room, fmu_path)) = packed(MESSENGER) else { return };
    for sun_deg in [[0.0, 0.0], [20.0, -40.0]] {
        worth_at(&fmu_path, sun_deg);
    }
}

/// A degree of tilt at an azimuth and elevation, by the map and by differences of torque.
fn worth_at(fmu_path: &Path, [azimuth, elevation]: [f64; 2]) {
    let fmu = Fmu::open(fmu_path).unwrap();
    let printed = mapped(&words(&format!(
        "{MESSENGER} --template {} --distance 0.3 --step 10deg --no-picture --set spacecraft.centerOfMass=1cm,2cm,-3cm \
         --sun {azimuth}deg,{elevation}deg",
        shown(fmu_path)
    )));
    let reported = |what: &str| -> Vec<f64> {
        let line = printed
            .lines()
            .find(|line| line.trim_start().starts_with(what))
            .unwrap_or_else(|| panic!("{what}: {printed}"));
        line.trim_start()[what.len()..].split_whitespace().map(|cell| cell.parse().unwrap()).collect()
    };
    let mut torque = Torque::new(&fmu);
    for (axis, value) in [0.01, 0.02, -0.03].into_iter().enumerate() {
        torque.instance.set_real(&format!("spacecraft.centerOfMass[{}]", axis + 1), value).unwrap();
    }
    let mut at = |azimuth: f64, elevation: f64, offsets_deg: [f64; 2]| {
        let angles = offsets_deg.map(|offset| messenger_angle_rad(azimuth, elevation, offset.to_radians()));
        torque.at(azimuth, elevation, 0.3 * AU_M, &angles)
    };
    const H: f64 = 0.05;
    let own = [65.0; 2];
    // A degree of tilt is more of azimuth off the equator.
    let wide = H / elevation.to_radians().cos();
    let mut offset = |offsets_deg: [f64; 2]| at(azimuth, elevation, offsets_deg);
    let [both, one] = [[1.0, 1.0], [1.0, 0.0]]
        .map(|share| [1.0, -1.0].map(|sign| offset(share.map(|share| 65.0 + sign * share * H))));
    let azimuths = [1.0, -1.0].map(|sign| at(azimuth + sign * wide, elevation, own));
    let elevations = [1.0, -1.0].map(|sign| at(azimuth, elevation + sign * H, own));
    for (what, [plus, minus]) in [
        ("Sun azimuth", azimuths),
        ("Sun elevation", elevations),
        ("Sun offset of the panels", both),
        ("Sun offset of panel +X", one),
    ] {
        let reported = reported(what);
        for axis in 0..3 {
            let slope = (plus[axis] - minus[axis]) / (2.0 * H);
            // To the printed digits and the third derivative over a twentieth of a degree.
            assert!((reported[axis] - slope * 1e6).abs() < 1e-4, "{what} {axis}: {reported:?}, {slope:e}");
            assert!(
                (reported[3 + axis] - slope * 86_400.0).abs() < 1e-5,
                "{what} {axis}: {reported:?}, {slope:e}"
            );
        }
        assert!(reported.iter().any(|value| *value != 0.0), "{what}");
    }
}

#[test]
fn a_degree_is_weighed_where_the_attitude_has_the_sun() {
    let Some((_room, fmu_path)) = packed(MESSENGER) else { return };
    let map = [MESSENGER, "--template", shown(&fmu_path), "--step", "10deg", "--no-picture"];
    let heading = |more: &[&str]| {
        let printed = mapped(&[&map[..], more].concat());
        printed.lines().find(|line| line.starts_with("What a degree")).unwrap().to_owned()
    };
    // A fixed attitude, EME2000 to body, and the Sun where the plant's own outputs have it.
    let turned = ["--set", "attitude.source=commanded", "--set", "start.q=0.1,-0.3,0.3,0.9"];
    let Some((_folder, plant)) =
        library().and_then(|it| packed_from(&it, "MomentumPlant", "plant.fmu", &["--spacecraft", MESSENGER]))
    else {
        return;
    };
    let seen = words("--stop 1s --step 1s --record sun.azimuth,sun.elevation");
    let printed = run(&[&["run", shown(&plant)][..], &seen, &turned].concat(), 0);
    let shown_deg = |name: &str| -> f64 {
        let row = printed.lines().find(|line| line.contains(name)).unwrap();
        row.split_whitespace().last().unwrap().parse().unwrap()
    };
    let found = heading(&turned);
    for name in ["azimuth", "elevation"] {
        let text = format!("{name} {:.2}", shown_deg(&format!("sun.{name}")));
        assert!(found.contains(text.trim_end_matches('0')), "{found}: {text}");
    }
    assert!(found.contains("as the attitude has it at the start (--sun)"), "{found}");
    // On -Y where it is said, and where the plant waits for its place.
    for more in [&["--sun", "0deg,0deg"][..], &["--set", "orbit.source=inputs"]] {
        let found = heading(more);
        assert_eq!(found, "What a degree of tilt is worth with the Sun on -Y, panels turning with it");
    }
}

#[test]
fn a_degree_off_the_sun_is_worth_something_from_the_sun_on() {
    let Some((_room, fmu_path)) = packed(MESSENGER) else { return };
    let fmu = Fmu::open(&fmu_path).unwrap();
    let at = ["--distance", "0.3", "--step", "10deg", "--sun", "0deg,0deg"];
    let map = [&[MESSENGER, "--template", shown(&fmu_path)][..], &at].concat();
    let mut torque = Torque::new(&fmu);
    // With the Sun on -Y, across their axes, the offset is the angle itself, to the side of the tilt.
    let h_deg = 0.05;
    let mut at = |angle_deg: f64| torque.at(0.0, 0.0, 0.3 * AU_M, &[angle_deg.to_radians(), 0.0]);
    let (plus, minus) = (at(h_deg), at(-h_deg));
    for (tilt, sign) in [("positive", 1.0), ("negative", -1.0)] {
        let tilted = format!("panel[1].tilt={tilt}");
        let printed =
            mapped(&[&map[..], &["--no-picture", "--panel-offset", "0deg", "--set", &tilted]].concat());
        let what = "Sun offset of panel +X";
        let line = printed.lines().find_map(|line| line.trim_start().strip_prefix(what)).unwrap();
        let reported: Vec<f64> = line.split_whitespace().map(|cell| cell.parse().unwrap()).collect();
        for axis in 0..3 {
            let slope = sign * (plus[axis] - minus[axis]) / (2.0 * h_deg);
            assert!((reported[axis] - slope * 1e6).abs() < 1e-4, "{tilt} {axis}: {reported:?}, {slope:e}");
        }
        assert!(reported.iter().any(|value| value.abs() > 0.01), "{printed}");
    }
}

#[test]
fn torque_goes_with_the_inverse_square_and_follows_the_options() {
    let Some((_room, fmu_path)) = packed(MESSENGER) else { return };
    let csv = |more: &[&str]| {
        let template = ["--template", shown(&fmu_path)];
        let all = words("--step 10deg --output - --quiet");
        rows(&mapped(&[&[MESSENGER], &template[..], &all, more].concat()))
    };
    let (near, far) = (csv(&["--distance", "0.3"]), csv(&["--distance", "0.6 AU"]));
    assert_eq!(near.len(), 36 * 19);
    let greatest = near.iter().map(|row| row["torque_x_n_m"].abs()).fold(0.0, f64::max);
    for (near, far) in near.iter().zip(&far) {
        assert!(
            (near["torque_x_n_m"] - 4.0 * far["torque_x_n_m"]).abs() < 1e-13 * greatest,
            "{near:?} {far:?}"
        );
    }
    let ahead = |rows: &[MapRow]| {
        rows.iter().find(|row| row["sun_azimuth_deg"] == 0.0 && row["sun_elevation_deg"] == 0.0).unwrap()["panel_1_angle_deg"]
    };
    assert!((ahead(&near) - 65.0).abs() < 1e-9);
    for set in [["--panel-offset", "50deg"], ["--set", "panel[1].sunOffset=50deg"]] {
        assert!((ahead(&csv(&set)) - 50.0).abs() < 1e-9, "{set:?}");
    }
    assert!((ahead(&csv(&["--set", "panel[1].tilt=negative"])) + 65.0).abs() < 1e-9);
    let still = csv(&["--set", "panel[1].control=angle", "--set", "panel[1].angle=12deg"]);
    assert!(still.iter().all(|row| (row["panel_1_angle_deg"] - 12.0).abs() < 1e-9));
    // The packed FMU is the same spacecraft.
    let of_fmu =
        mapped(&words(&format!("{} --distance 0.3 --step 10deg --output - --quiet", shown(&fmu_path))));
    assert_eq!(rows(&of_fmu).len(), near.len());
    assert!(rows(&of_fmu).iter().zip(&near).all(|(one, other)| one["torque_z_n_m"] == other["torque_z_n_m"]));
}

#[test]
fn the_picture_shows_lines_and_a_mission() {
    let Some((room, fmu_path)) = packed(MESSENGER) else { return };
    let simulated = room.path().join("flown.csv");
    let mut recorded = "time,torque.total[1],torque.total[2],torque.total[3]\n".to_owned();
    for hour in 0..=240 {
        recorded += &format!("{},2e-5,0,0\n", hour * 3600);
    }
    fs::write(&simulated, recorded).unwrap();
    let svg = room.path().join("my.svg");
    let line = format!(
        "{MESSENGER} --template {} --distance 0.387 --recording {} --output {}",
        shown(&fmu_path),
        shown(&simulated),
        shown(&svg)
    );
    let all = words(&line);
    let printed = mapped(&all);
    // 5.5 N m s at 2e-5 N m less what downlinks add about X, printed to 1e-10 N m.
    let line = printed.lines().find(|line| line.trim_start().starts_with("mean torque about X")).unwrap();
    let least_n_m: f64 = line.split_whitespace().nth(4).unwrap().parse::<f64>().unwrap() * 1e-6;
    let day = |text: &str| -> f64 {
        let line = printed.lines().find(|line| line.starts_with(text)).unwrap_or_else(|| panic!("{printed}"));
        line[text.len()..].split_whitespace().next().unwrap().parse().unwrap()
    };
    let expected_d = 5.5 / (2e-5 + least_n_m) / 86_400.0;
    assert!((day("holdable without a dump until day") - expected_d).abs() < 0.1, "{printed} {expected_d}");
    assert!((day("without targets in downlinks until day") - 5.5 / 2e-5 / 86_400.0).abs() < 0.1, "{printed}");
    assert!(printed.contains("more than downlinks can undo"), "{printed}");
    let drawn = fs::read_to_string(&svg).unwrap();
    let document = Document::parse(&drawn).unwrap();
    let classed =
        |class: &str| document.descendants().filter(|node| node.attribute("class") == Some(class)).count();
    assert!(classed("zero") > 6 && classed("attainable") == 1 && classed("mission") == 1, "{drawn}");
}

#[test]
fn what_cannot_be_mapped_is_refused_by_name() {
    for (arguments, expected) in [
        (&["--distance", "nan"][..], "--distance"),
        (&["--zone", "0deg,13deg"], "--zone"),
        (&["--step", "7deg"], "--step"),
        (&["--panel-offset", "200deg"], "--panel-offset"),
        (&["--no-picture", "--output", "x.svg"], "--output"),
        (&["--source", "moon"], "--source"),
    ] {
        let printed = run(&[&["map", MESSENGER][..], arguments].concat(), 2);
        assert!(printed.contains(expected), "{arguments:?}: {printed}");
    }
    let Some((room, fmu_path)) = packed(MESSENGER) else { return };
    let wrong = room.path().join("wrong.csv");
    fs::write(&wrong, "time,mass\n0,1\n600,1\n").unwrap();
    let template = ["--template", shown(&fmu_path), "--step", "10deg"];
    for (spacecraft, arguments, expected) in [
        (MESSENGER, &["--set", "spacecraft.center=1"][..], "spacecraft.center"),
        (MESSENGER, &["--set", "keepIn.azimuth=0deg"], "keepIn.azimuth"),
        (MESSENGER, &["--recording", shown(&wrong)], "torque.total[1] to [3], nor momentum.body"),
        (MESSENGER, &["--set", "keepIn.azimuth=-1deg"], "found -1deg"),
        (MESSENGER, &["--recording", "no/such.csv"], "no/such.csv"),
        (
            MESSENGER,
            &["--output", "-", "--lines", "-"],
            "one file cannot take both: see --output and --lines",
        ),
        ("no/such.toml", &[], "no/such.toml"),
        ("../../fmu-src/resources/ace.toml", &[], "ace.toml"),
    ] {
        let printed = run(&[&["map", spacecraft][..], &template, arguments].concat(), 2);
        assert!(printed.contains(expected), "{spacecraft} {arguments:?}: {printed}");
    }
    assert!(
        run(&["map", MESSENGER, "--template", shown(&fmu_path), "--output", "x.png"], 2).contains("--output")
    );
    assert!(run(&["map", shown(&fmu_path), "--template", shown(&fmu_path)], 2).contains("--template"));
    // Neither shade nor panels: what remains is mapped, an offset has nothing to hold.
    let bare = room.path().join("bare.toml");
    let plate = "name = \"A\"\n[mass_properties]\nmass_kg = 100.0\ncenter_of_mass_m = [0.0, 0.0, 0.0]\n\
                 inertia_kg_m2 = [[9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]]\n[optics.foil]\nspecular = 0.2\n\
                 diffuse = 0.3\n[[plates]]\nname = \"P\"\narea_m2 = 1.0\ncenter_m = [0.0, -1.0, 0.1]\nnormal = [0.0, -1.0, 0.0]\n\
                 optics = \"foil\"\n";
    fs::write(&bare, plate).unwrap();
    let without_picture = [&template[..], &["--no-picture"]].concat();
    let reported = run(&[&["map", shown(&bare)][..], &without_picture].concat(), 0);
    assert!(reported.contains("Sun keep-in zone: none") && reported.contains("least of all"), "{reported}");
    assert!(!reported.contains("in the zone") && !reported.contains("the keep-in zone"), "{reported}");
    let (lines, svg) = (room.path().join("lines.csv"), room.path().join("bare.svg"));
    let files = ["--lines", shown(&lines), "--output", shown(&svg)];
    run(&[&["map", shown(&bare)][..], &template[..4], &files].concat(), 0);
    assert!(!fs::read_to_string(&lines).unwrap().contains("zone"));
    let drawn = || fs::read_to_string(&svg).unwrap();
    assert!(!drawn().contains("keep-in"));
    // What downlinks can undo is drawn where there are any.
    assert!(!drawn().contains("downlinks can undo") && drawn().contains("About Z"));
    let windows = ["guided.downlinkStart=3h", "guided.downlinkEnd=5h", "guided.downlinkEvery=2"];
    let windows: Vec<&str> = windows.into_iter().flat_map(|set| ["--set", set]).collect();
    run(&[&["map", shown(&bare)][..], &template[..4], &files, &windows].concat(), 0);
    assert!(drawn().contains("downlinks can undo"));
    for zone in [["--zone", "20deg,10deg"], ["--set", "keepIn.azimuth=20deg"]] {
        let reported = run(&[&["map", shown(&bare)][..], &without_picture, &zone].concat(), 0);
        says(&reported, &["Sun keep-in zone: 20 deg of azimuth", "in the zone"]);
    }
    // As the flight has it.
    let ignored = ["--zone", "180deg,90deg"];
    let reported = run(&[&["map", MESSENGER][..], &without_picture, &ignored].concat(), 0);
    assert!(reported.contains("Sun keep-in zone: none"), "{reported}");
    let refused = run(&[&["map", shown(&bare)][..], &template, &["--panel-offset", "50deg"]].concat(), 2);
    assert!(refused.contains("--panel-offset") && refused.contains("no panel"), "{refused}");
}

#[test]
fn check_map_and_run_give_one_torque_at_1_au() {
    let Some((_room, template)) = crate::template() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let full = "../../fmu-src/resources/messenger-full.toml";
    // Off the centre of mass, so that there is a torque about every axis to compare.
    let off = fs::read_to_string(full).unwrap().replacen(
        "center_of_mass_m = [0.0, 0.0, 0.0]",
        "center_of_mass_m = [0.02, 0.0, -0.03]",
        1,
    );
    for has_shadows in [false, true] {
        let file = scratch.path().join("craft.toml");
        let setting = format!(
            "\n[start.DisturbanceTorque]\n\"shadowing.enabled\" = {has_shadows}\n[start.MomentumPlant]\n\"shadowing.enabled\" = {has_shadows}\n"
        );
        fs::write(&file, format!("{off}{setting}")).unwrap();
        let checked = run(&["check", shown(&file), "--template", shown(&template)], 0);
        let line = checked.lines().find(|line| line.contains("torque at 1 AU")).unwrap();
        let numbers = line.split_once('(').unwrap().1.split_once(')').unwrap().0;
        let checked: Vec<f64> = numbers.split(", ").map(|part| part.parse().unwrap()).collect();
        assert_eq!(line.contains("by sunlight with shadows"), has_shadows, "{line}");
        let map = run(
            &[
                "map",
                shown(&file),
                "--template",
                shown(&template),
                "--distance",
                "1",
                "--no-picture",
                "--step",
                "10deg",
            ],
            0,
        );
        let row = map.lines().find(|line| line.contains("Sun on -Y")).unwrap();
        let mapped: Vec<f64> =
            row.split_whitespace().skip(5).take(3).map(|part| part.parse().unwrap()).collect();
        for (checked, mapped) in checked.iter().zip(&mapped) {
            // Four significant digits here, 1e-4 uN m there.
            assert!((checked - mapped).abs() < 1e-3 * mapped.abs() + 1e-4, "{line}: {row}");
        }
    }
}
