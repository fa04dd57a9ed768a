//! `draw`: well-formed SVG, names and lengths of the file, views and angles as requested, refusals that name what is wrong.

use std::{fs, path::Path};

use resvg::usvg::roxmltree::{Document, Node};
use toml::Table;

use crate::{heliotorque, run, shown, text};

const RESOURCES: &str = "../../fmu-src/resources";
const ORBITER: &str = "../../fmu-src/resources/examples/mercury-orbiter.toml";

/// The SVG of a file, drawn with these arguments.
fn drawn(file: &str, more: &[&str]) -> String {
    let output = heliotorque(&[&["draw", file, "--output", "-"], more].concat()).output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    String::from_utf8(output.stdout).unwrap()
}

fn texts<'a>(document: &'a Document<'_>) -> Vec<&'a str> {
    document.descendants().filter(|node| node.has_tag_name("text")).filter_map(|node| node.text()).collect()
}

/// Numbers of a list of points or of a path.
fn numbers(text: &str) -> Vec<f64> {
    let split = text.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'));
    split.filter(|part| !part.is_empty()).map(|part| part.parse().unwrap()).collect()
}

/// Width and height of some surfaces, in m by the scale bar. Surfaces have edges, arrow heads have none.
fn extent_m(svg: &str, is_meant: impl Fn(&Node) -> bool) -> [f64; 2] {
    let document = Document::parse(svg).unwrap();
    let bar = document.descendants().find(|node| node.attribute("class") == Some("scale")).unwrap();
    let ends = numbers(bar.attribute("d").unwrap());
    let length =
        texts(&document).into_iter().find(|text| text.ends_with(" m") && !text.contains('(')).unwrap();
    let length_m: f64 = length.trim_end_matches(" m").parse().unwrap();
    let pixels_per_m = (ends[2] - ends[0]) / length_m;
    let surfaces = document
        .descendants()
        .filter(|node| node.has_tag_name("polygon") && node.attribute("stroke").is_some())
        .filter(is_meant);
    let points: Vec<f64> = surfaces.flat_map(|node| numbers(node.attribute("points").unwrap())).collect();
    assert!(!points.is_empty());
    [0, 1].map(|i| {
        let along = || points.iter().skip(i).step_by(2).copied();
        (along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)) / pixels_per_m
    })
}

/// What the file says: least and greatest coordinate of every outline, by axis.
fn extents_of_file_m(path: &str) -> [f64; 3] {
    let file: Table = fs::read_to_string(path).unwrap().parse().unwrap();
    let lists = ["plates", "panels"].into_iter().flat_map(|key| file[key].as_array().unwrap());
    let corners: Vec<Vec<f64>> = lists
        .flat_map(|surface| surface["polygon_m"].as_array().unwrap())
        .map(|corner| corner.as_array().unwrap().iter().map(|x| x.as_float().unwrap()).collect())
        .collect();
    [0, 1, 2].map(|i| {
        let along = || corners.iter().map(|corner| corner[i]);
        along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)
    })
}

#[test]
fn every_shipped_spacecraft_is_drawn_with_its_names() {
    for (file, lists) in [
        ("messenger.toml", &["sunshade.plates", "panels"][..]),
        ("messenger-full.toml", &["plates", "sunshade.plates", "panels"]),
        ("messenger-thermal.toml", &["plates", "panels"]),
        ("examples/mercury-orbiter.toml", &["plates", "panels"]),
        ("examples/solar-sailer.toml", &["plates", "panels"]),
        ("examples/sunshield-telescope.toml", &["plates", "panels"]),
        ("ace.toml", &["thruster"]),
    ] {
        let path = format!("{RESOURCES}/{file}");
        let svg = drawn(&path, &[]);
        let document = Document::parse(&svg).unwrap();
        let texts = texts(&document);
        let table: Table = fs::read_to_string(&path).unwrap().parse().unwrap();
        assert!(texts.contains(&table["name"].as_str().unwrap()), "{file}: {texts:?}");
        for list in lists {
            let items = match list.split_once('.') {
                Some((outer, inner)) => &table[outer][inner],
                None => &table[*list],
            };
            for item in items.as_array().unwrap() {
                let name = item["name"].as_str().unwrap();
                let entry = if *list == "panels" { format!("panel {name}") } else { name.to_owned() };
                assert!(texts.contains(&entry.as_str()), "{file}: {entry} is missing in {texts:?}");
            }
        }
        // Three views have two axes in the plane, the perspective has three.
        for axis in ["X", "Y", "Z"] {
            assert_eq!(texts.iter().filter(|text| **text == axis).count(), 3, "{file}: {axis}");
        }
        let suns = texts.iter().filter(|text| **text == "Sun").count();
        assert_eq!(suns, if file == "ace.toml" { 0 } else { 3 }, "{file}");
        let centers =
            document.descendants().filter(|node| node.attribute("class") == Some("center-of-mass")).count();
        assert_eq!(centers, 5, "{file}: one in each view and one in the legend");
    }
}

#[test]
fn lengths_are_those_of_the_file() {
    let [x_m, y_m, z_m] = extents_of_file_m(ORBITER);
    for (view, expected_m) in [("front", [x_m, z_m]), ("side", [y_m, z_m]), ("top", [x_m, y_m])] {
        let found_m = extent_m(&drawn(ORBITER, &["--view", view, "--angle", "0deg"]), |_| true);
        for (found_m, expected_m) in found_m.into_iter().zip(expected_m) {
            // The bar's ends are rounded to 0.1 px.
            assert!((found_m / expected_m - 1.0).abs() < 2e-3, "{view}: {found_m} m, {expected_m} m");
        }
    }
}

#[test]
fn a_plate_without_outline_is_a_square_of_its_area() {
    let front = drawn(&format!("{RESOURCES}/messenger.toml"), &["--view", "front", "--angle", "0 deg"]);
    // The front plate of 1.068 m2 faces the viewer straight and is the nearest; three plates share its plane.
    let document = Document::parse(&front).unwrap();
    let remark = texts(&document).into_iter().any(|text| text.contains("squares of their area"));
    assert!(remark);
    let squares: Vec<[f64; 2]> = document
        .descendants()
        .filter(|node| node.has_tag_name("polygon") && node.attribute("stroke").is_some())
        .map(|node| extent_m(&front, |other| other.attribute("points") == node.attribute("points")))
        .collect();
    for area_m2 in [1.068_f64, 0.06409, 2.5, 2.5] {
        let side_m = area_m2.sqrt();
        let is_it = |[wide, high]: &[f64; 2]| (wide - side_m).abs() < 2e-3 && (high - side_m).abs() < 2e-3;
        assert!(squares.iter().any(is_it), "{area_m2}: {squares:?}");
    }
}

#[test]
fn panels_turn_about_their_axes() {
    // Cells are the only surfaces that are blue: more blue than red.
    let is_panel = |node: &Node| {
        let fill = node.attribute("fill").unwrap();
        let channel = |at: usize| i32::from_str_radix(&fill[at..at + 2], 16).unwrap();
        channel(5) > channel(1) + 40
    };
    for (angle, part) in [("0deg", 1.0), ("60deg", 0.5), ("-60deg", 0.5), ("1.0471975512rad", 0.5)] {
        let svg = drawn(ORBITER, &["--view", "front", "--angle", angle]);
        let [wide_m, high_m] = extent_m(&svg, is_panel);
        assert!(
            (high_m - 1.5 * part).abs() < 4e-3 && (wide_m - 6.0).abs() < 8e-3,
            "{angle}: {wide_m} {high_m}"
        );
        assert!(svg.contains(", at "), "{svg}");
    }
    // One alone, by its name in any case; the other stays at the file's 55 deg to the Sun.
    let svg = drawn(ORBITER, &["--view", "front", "--angle", "+x=10deg"]);
    assert!(svg.contains("at 10 deg") && svg.contains("at 55 deg"));
    let other = drawn(ORBITER, &["--view", "front", "--angle", "-X=-10deg"]);
    assert!(other.contains("at -10 deg") && other.contains("at 55 deg"));
}

#[test]
fn views_are_those_requested() {
    let headings = |views: &str| -> Vec<String> {
        let svg = drawn(ORBITER, &["--view", views]);
        let document = Document::parse(&svg).unwrap();
        let known = ["Front", "Side", "Top", "Perspective"];
        texts(&document).into_iter().filter(|text| known.contains(text)).map(str::to_owned).collect()
    };
    assert_eq!(headings("side"), ["Side"]);
    assert_eq!(headings("front,perspective"), ["Perspective", "Front"]);
    assert_eq!(headings("all"), ["Top", "Perspective", "Front", "Side"]);
    assert!(run(&["draw", ORBITER, "--view", "back"], 2).contains("--view"));
}

#[test]
fn what_cannot_be_drawn_is_named() {
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    let wrong = at("wrong.toml");
    let good = fs::read_to_string(ORBITER).unwrap();
    fs::write(&wrong, good.replace("mass_kg = 620.0", "mass_kg = -1.0")).unwrap();
    let line = good.lines().position(|line| line == "mass_kg = 620.0").unwrap() + 1;
    let printed = run(&["draw", shown(&wrong), "--output", shown(&at("x.svg"))], 2);
    assert!(printed.contains(&format!("wrong.toml:{line}: mass_properties.mass_kg")), "{printed}");
    assert!(!at("x.svg").exists());
    for (more, expected) in [
        (&["--output", "x.png"][..], "allowed: .svg, or - for SVG on the standard output: see --output"),
        (&["--angle", "wing=10deg"], "found the panel \"wing\", allowed: +X, -X"),
    ] {
        let printed = run(&[&["draw", ORBITER][..], more].concat(), 2);
        assert!(printed.contains(expected), "{printed}");
    }
    assert!(run(&["draw", ORBITER, "--angle", "+X=10"], 2).contains("an angle carries its unit"));
    let ace = format!("{RESOURCES}/ace.toml");
    assert!(run(&["draw", &ace, "--angle", "3deg"], 2).contains("the file has no panels"));
    assert!(run(&["draw", "no/such.toml"], 2).contains("no/such.toml"));
}

#[test]
fn files_are_named_after_the_spacecraft() {
    let scratch = tempfile::tempdir().unwrap();
    fs::copy(ORBITER, scratch.path().join("my.toml")).unwrap();
    let output = heliotorque(&["draw", "my.toml"]).current_dir(scratch.path()).output().unwrap();
    assert!(output.status.success() && text(&output).contains("my.svg"), "{}", text(&output));
    assert!(Document::parse(&fs::read_to_string(scratch.path().join("my.svg")).unwrap()).is_ok());
}

#[test]
fn the_readme_shows_what_is_drawn() {
    let shown = fs::read_to_string(Path::new("../../docs/src/pictures/mercury-orbiter.svg")).unwrap();
    assert!(
        shown == drawn(ORBITER, &[]),
        "`heliotorque draw {ORBITER} --output docs/src/pictures/mercury-orbiter.svg` writes it anew"
    );
}
