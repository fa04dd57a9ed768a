//! Limits on files: the guide's table is that of the program, and what is beyond a limit is refused by its name.

use std::{collections::BTreeMap, fmt::Write as _, fs, io::Write as _};

use physics::spacecraft::MOST_SURFACES;
use physics::toml::{LIMITS, MOST_ITEMS, MOST_PROBLEMS, MOST_TEXT_BYTES};
use zip::{CompressionMethod, ZipWriter, write::SimpleFileOptions};

use crate::{run, shown, template};

const GUIDE: &str = include_str!("../../../../docs/src/files/limits.md");

/// The rows of the guide's tables.
fn rows() -> BTreeMap<&'static str, u64> {
    let cells =
        GUIDE.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |")?.split_once(" | "));
    cells.filter_map(|(what, most)| Some((what, most.parse().ok()?))).collect()
}

#[test]
fn the_guide_has_every_limit() {
    let archive = fmi::ArchiveLimits::default();
    let mut expected = BTreeMap::from([
        ("bytes of a TOML file", MOST_TEXT_BYTES as u64),
        ("bytes of a table of numbers (`--input`, `map --recording`)", files::MAX_TABLE_BYTES),
        ("bytes of a `modelDescription.xml`", archive.description_bytes),
        ("bytes of the description or a parameter set of a system", systems::MAX_BYTES),
        ("bytes of an unpacked archive", archive.total_bytes),
        ("entries of an archive", archive.entries as u64),
        ("components of a system", systems::MAX_COMPONENTS as u64),
        ("problems that a message lists; the others are counted", MOST_PROBLEMS as u64),
        ("surfaces of a spacecraft, copies and facets of shapes among them", MOST_SURFACES as u64),
    ]);
    let keys: Vec<(String, u64)> =
        LIMITS.iter().map(|(key, most)| (format!("`{key}`"), *most as u64)).collect();
    expected.extend(keys.iter().map(|(key, most)| (key.as_str(), *most)));
    assert_eq!(rows(), expected);
    assert!(GUIDE.contains(&format!("every other has at most {MOST_ITEMS} entries")));
    assert_eq!(files::MAX_TEXT_BYTES, MOST_TEXT_BYTES as u64);
}

const SPACECRAFT: &str = r#"
name = "Limits"
[optics.white]
specular = 0.1
diffuse = 0.2
[mass_properties]
mass_kg = 100.0
center_of_mass_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [[10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 10.0]]
"#;

const PLATE: &str = r#"
[[plates]]
optics = "white"
area_m2 = 1.0
normal = [1.0, 0.0, 0.0]
center_m = [0.0, 0.0, 0.5]
"#;

/// What stands `count` times in a file.
fn times(count: usize, part: impl Fn(usize) -> String) -> String {
    (0..count).map(part).collect()
}

fn axis(k: usize) -> &'static str {
    ["[1.0, 0.0, 0.0]", "[0.0, 1.0, 0.0]", "[0.0, 0.0, 1.0]"][k % 3]
}

fn outline(count: usize) -> String {
    let mut text = "[[plates]]\noptics = \"white\"\nnormal = [0.0, 0.0, 1.0]\npolygon_m = [".to_owned();
    for k in 0..count {
        let (sin, cos) = (k as f64 * core::f64::consts::TAU / count as f64).sin_cos();
        write!(text, "[{cos:.9}, {sin:.9}, 0.0], ").unwrap();
    }
    text + "]\n"
}

fn wheels(count: usize) -> String {
    let wheel = |k| format!("[[wheels]]\nname = \"w{k}\"\naxis = {}\ncapacity_n_m_s = 4.0\n", axis(k));
    PLATE.to_owned() + &times(count, wheel)
}

fn thrusters(count: usize) -> String {
    let thruster = |k| {
        format!(
            "[[thrusters]]\nname = \"t{k}\"\nposition_m = [1.0, {k}.0, 0.3]\ndirection = {}\nforce_n = 1.0\n\
             specific_impulse_s = 220.0\n",
            axis(k)
        )
    };
    PLATE.to_owned() + &times(count, thruster)
}

fn names(count: usize) -> String {
    PLATE.to_owned() + "[start]\n" + &times(count, |k| format!("\"no.such{k}\" = 1.0\n"))
}

fn most(key: &str) -> usize {
    LIMITS.iter().find(|(name, _)| *name == key).unwrap().1
}

#[test]
fn a_spacecraft_beyond_a_limit_is_refused_by_its_key() {
    let Some((folder, template)) = template() else { return };
    let file = folder.path().join("craft.toml");
    let check = |text: &str, status: i32| {
        fs::write(&file, format!("{SPACECRAFT}{text}")).unwrap();
        run(&["check", shown(&file), "--template", shown(&template)], status)
    };
    let plates = |count| times(count, |k| PLATE.replace("0.5]", &format!("{k}.5]")));
    let cases: [(&str, &dyn Fn(usize) -> String); 5] = [
        ("plates", &plates),
        ("wheels", &wheels),
        ("thrusters", &thrusters),
        ("polygon_m", &outline),
        ("start", &names),
    ];
    for (key, text) in cases {
        let most = most(key);
        let beyond = check(&text(most + 1), 1);
        let expected = format!("{key}: found {} entries, allowed: at most {most}", most + 1);
        assert!(beyond.contains(&expected), "{beyond}");
        let far = text(100_000);
        let far = check(&far, if far.len() > MOST_TEXT_BYTES { 2 } else { 1 });
        let named = far.contains(&format!("found 100000 entries, allowed: at most {most}"))
            || far.contains(&format!("allowed: at most {MOST_TEXT_BYTES}"));
        assert!(named, "{key}: {}", &far[..far.len().min(2000)]);
    }
    for (key, text) in [("wheels", wheels(64)), ("polygon_m", outline(1000))] {
        let at_limit = check(&text, 0);
        assert!(!at_limit.contains("at most"), "{key}: {at_limit}");
    }
    let shapes = times(30, |k| {
        format!(
            "[[dishes]]\nname = \"d{k}\"\noptics = \"white\"\nvertex_m = [0.0, {k}.0, 0.0]\naxis = [0.0, 0.0, 1.0]\n\
             radius_m = 0.25\ndepth_m = 0.05\nfacets = 64\nrings = 8\n"
        )
    });
    let surfaces = check(&shapes, 1);
    assert!(surfaces.contains(&format!("allowed: at most {MOST_SURFACES}")), "{surfaces}");
    let unknown = check(&times(30_000, |k| format!("unknown{k} = 1\n")), 1);
    assert!(
        unknown.contains("29901 more problems") && unknown.contains(": 30001 problems"),
        "{}",
        &unknown[unknown.len() - 300..]
    );
    assert!(unknown.lines().count() < MOST_PROBLEMS + 10, "{} lines", unknown.lines().count());
}

/// An archive with one deflated entry of so many blanks after `begin`.
fn blanks(name: &str, begin: &str, mebibytes: usize) -> Vec<u8> {
    let mut zip = ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options =
        SimpleFileOptions::default().compression_method(CompressionMethod::Deflated).large_file(true);
    zip.start_file(name, options).unwrap();
    zip.write_all(begin.as_bytes()).unwrap();
    let block = vec![b' '; 1 << 20];
    for _ in 0..mebibytes {
        zip.write_all(&block).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

#[test]
fn an_archive_beyond_a_limit_is_refused_before_it_is_unpacked() {
    let folder = tempfile::tempdir().unwrap();
    let fmu = folder.path().join("large.fmu");
    fs::write(&fmu, blanks("modelDescription.xml", "<?xml version=\"1.0\"?>", 600)).unwrap();
    for command in ["info", "run"] {
        let refused = run(&[command, shown(&fmu)], 2);
        assert!(refused.contains("modelDescription.xml unpacks to"), "{refused}");
    }
    let system = folder.path().join("many.ssp");
    let component = |k| format!("<Component name=\"c{k}\" source=\"a.fmu\"/>");
    let structure = format!(
        "<?xml version=\"1.0\"?><SystemStructureDescription \
         xmlns=\"http://ssp-standard.org/SSP1/SystemStructureDescription\" version=\"1.0\" name=\"x\"><System \
         name=\"s\"><Elements>{}</Elements></System></SystemStructureDescription>",
        times(systems::MAX_COMPONENTS + 1, component)
    );
    fs::write(&system, blanks("SystemStructure.ssd", &structure, 0)).unwrap();
    let refused = run(&["run", shown(&system)], 2);
    assert!(refused.contains(&format!("allowed: at most {}", systems::MAX_COMPONENTS)), "{refused}");
}

#[test]
fn a_text_beyond_the_limit_is_refused_before_it_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let text = folder.path().join("large.toml");
    fs::File::create(&text).unwrap().set_len(1 << 30).unwrap();
    for arguments in [&["check"][..], &["draw"], &["run"]] {
        let refused = run(&[arguments, &[shown(&text)]].concat(), 2);
        assert!(refused.contains(&format!("allowed: at most {MOST_TEXT_BYTES}")), "{arguments:?}: {refused}");
    }
}
