//! A good file gives the numbers it states; a bad one is refused by file, line, key, what was found and what is allowed.

use approx::assert_relative_eq;
use nalgebra::Vector3;
use proptest::prelude::*;

use super::*;
use crate::toml::Problem;

const SMALL: &str = include_str!("small.toml");

fn small(text: &str) -> Spacecraft {
    Spacecraft::from_toml("small.toml", text).unwrap()
}

fn problems(text: &str) -> Vec<Problem> {
    Spacecraft::from_toml("small.toml", text).unwrap_err().problems
}

/// The one problem of the small file after a replacement.
fn problem(from: &str, to: &str) -> Problem {
    assert!(SMALL.contains(from), "nothing to replace: {from}");
    let problems = problems(&SMALL.replacen(from, to, 1));
    assert_eq!(problems.len(), 1, "{problems:?}");
    problems.into_iter().next().unwrap()
}

#[test]
fn messenger_is_as_published() {
    let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
    let shade = spacecraft.sunshade.as_ref().unwrap();
    assert_eq!(shade.plates.len(), 8);
    assert_eq!(spacecraft.panels.len(), 2);
    assert_eq!(spacecraft.wheels.len(), 4);
    let area: f64 = shade.plates.iter().map(|plate| plate.area_m2).sum();
    assert_relative_eq!(area, 2.0 * (1.169 + 0.8672 + 0.02052) + 1.068 + 0.06409, epsilon = 1e-12);
    assert!(shade.plates.iter().all(|plate| (plate.normal.norm() - 1.0).abs() < 1e-15));
    assert!(shade.plates.iter().all(|plate| (plate.faces.optics.absorptivity - 0.5).abs() < 1e-15));
    // Mirrored in X, plate by plate.
    for plate in &shade.plates {
        let mirror = |v: &Vector3<f64>| Vector3::new(-v.x, v.y, v.z);
        assert!(shade.plates.iter().any(|other| other.center_m == mirror(&plate.center_m)
            && other.normal == mirror(&plate.normal)
            && other.area_m2 == plate.area_m2));
    }
    assert_relative_eq!(shade.cylinder.unwrap().half_angle_rad, 61_f64.to_radians());
    assert_relative_eq!(spacecraft.panels[0].sun_offset_rad, 65_f64.to_radians());
    assert_relative_eq!(spacecraft.sun_keep_in.unwrap().elevation_rad, 13_f64.to_radians());
}

#[test]
fn the_example_is_a_good_file_of_another_spacecraft() {
    let text = include_str!("../../../resources/examples/solar-sailer.toml");
    let spacecraft = Spacecraft::from_toml("solar-sailer.toml", text).unwrap();
    assert_eq!((spacecraft.plates.len(), spacecraft.panels.len(), spacecraft.wheels.len()), (9, 3, 3));
    assert!(spacecraft.sunshade.is_none());
}

#[test]
fn defaults_are_the_documented_ones() {
    let spacecraft = small(SMALL);
    let panel = &spacecraft.panels[0];
    assert_eq!(panel.axis_body, Vector3::x());
    assert_eq!(panel.zero_normal_body, -Vector3::y());
    assert_eq!((panel.control, panel.sun_offset_rad, panel.tilt_sign), (PanelControl::SunOffset, 0.0, 1.0));
    assert_eq!((panel.name.as_str(), spacecraft.plates[0].name.as_str()), ("panel 1", "plate 1"));
    assert_relative_eq!(spacecraft.plates[0].faces.optics.absorptivity, 0.3, epsilon = 1e-15);
    assert!(
        spacecraft.sunshade.is_none()
            && spacecraft.sun_keep_in.is_none()
            && spacecraft.dump_threshold_n_m_s.is_none()
    );
}

#[test]
fn a_bad_value_is_named_with_its_line() {
    let negative = problem("area_m2 = 2.0", "area_m2 = -2.0");
    assert_eq!(
        negative,
        Problem {
            line: Some(11),
            key: "plates[1].area_m2".to_owned(),
            found: "-2".to_owned(),
            allowed: "a number above 0 and at most 1e12".to_owned(),
        }
    );
    let shown = Spacecraft::from_toml("small.toml", &SMALL.replacen("2.0", "-2.0", 1)).unwrap_err();
    assert_eq!(
        shown.to_string(),
        "small.toml:11: plates[1].area_m2: found -2, allowed: a number above 0 and at most 1e12"
    );
}

#[test]
fn an_unknown_key_comes_with_the_nearest_allowed_one() {
    let unknown = problem("area_m2 = 2.0", "arae_m2 = 2.0");
    assert_eq!(unknown.line, Some(11));
    assert_eq!(unknown.key, "plates[1].arae_m2");
    assert_eq!(unknown.found, "the unknown key `arae_m2` (did you mean `area_m2`?)");
    assert!(unknown.allowed.contains("center_m"));
    assert_eq!(problem("[optics.white]", "[optic.white]").key, "optic");
    let material = problem("optics = \"white\"", "optics = \"whyte\"");
    assert_eq!(material.found, "the unknown material `whyte` (did you mean `white`?)");
}

#[test]
fn every_rule_has_its_message() {
    for rule in include_str!("rules.txt").lines().skip(1) {
        let [from, to, key, allowed] = rule.split(" => ").collect::<Vec<_>>()[..] else { panic!("{rule}") };
        let problem = problem(&from.replace("\\n", "\n"), &to.replace("\\n", "\n"));
        assert_eq!(problem.key, key, "{problem:?}");
        assert!(problem.allowed.contains(allowed), "{problem:?}");
        assert!(problem.line.is_some());
    }
}

#[test]
fn two_of_a_kind_with_one_name_are_refused_by_both_places() {
    let plate = "[[plates]]\narea_m2 = 1.0\ncenter_m = [0, 0, 0]\nnormal = [0, 0, 1]\noptics = \"white\"\n";
    let panel = "[[panels]]\narea_m2 = 3.0\ncenter_m = [2.0, 0.0, 0.0]\noptics = \"white\"\n";
    let wheel = "[[wheels]]\naxis = [1.0, 0.0, 0.0]\ncapacity_n_m_s = 4.0\n";
    for (list, item) in [("plates", plate), ("panels", panel), ("wheels", wheel)] {
        let named = |name: &str| format!("{item}name = \"{name}\"\n");
        let reported = problems(&format!("{SMALL}{}{}{}", named("a"), named("b"), named("a")));
        assert_eq!(reported.len(), 1, "{reported:?}");
        assert_eq!(reported[0].key, format!("{list}[4].name"));
        assert_eq!(reported[0].found, format!("`a`, the name of {list}[2] too"));
        // The first has no name and is called by its number.
        let number = format!("{} 1", list.trim_end_matches('s'));
        let reported = problems(&format!("{SMALL}{}", named(&number)));
        assert_eq!(reported[0].found, format!("`{number}`, the name of {list}[1] too"));
    }
    let shade = format!("[sunshade]\nmodel = \"plates\"\n{}", plate.replace("plates", "sunshade.plates"));
    assert!(Spacecraft::from_toml("small.toml", &format!("{SMALL}{shade}")).is_ok());
    let reported = problems(&format!("{SMALL}{plate}name = \"a\"\n{shade}name = \"a\"\n"));
    assert_eq!(
        (reported[0].key.as_str(), reported[0].found.as_str()),
        ("sunshade.plates[1].name", "`a`, the name of plates[2] too")
    );
}

#[test]
fn all_bad_values_are_reported_at_once() {
    let text = SMALL.replace("area_m2 = ", "area_m2 = -").replace("mass_kg = 100", "mass_kg = inf");
    assert_eq!(problems(&text).len(), 3);
}

#[test]
fn numbers_beyond_all_measure_are_short_and_the_limit_is_named() {
    for (area, found) in
        [("1e300", "1e300"), ("inf", "inf"), ("1e-310", "1e-310"), ("1000000000001", "1000000000001")]
    {
        let beyond = problem("area_m2 = 2.0", &format!("area_m2 = {area}"));
        assert_eq!(
            (beyond.found.as_str(), beyond.allowed.as_str()),
            (found, "a number above 0 and at most 1e12")
        );
    }
    assert!(Spacecraft::from_toml("small.toml", &SMALL.replacen("2.0", "1e12", 1)).is_ok());
    let far = problem("center_m = [0.0, -1.0, 0.0]", "center_m = [0.0, -1e300, 0.0]");
    assert_eq!(
        (far.found.as_str(), far.allowed.as_str()),
        ("-1e300", "a finite number up to 1e12 in magnitude")
    );
    let long = problem("normal = [0.0, -1.0, 0.0]", "normal = [0.0, -1e100, 0.0]");
    assert_eq!(long.found, "[0.0, -1e100, 0.0] of length 1e100");
}

/// Key and what was found, of every problem.
fn reported(text: &str) -> Vec<(String, String)> {
    problems(text).into_iter().map(|problem| (problem.key, problem.found)).collect()
}

#[test]
fn keys_types_and_values_are_reported_together_in_the_order_of_the_file() {
    let mut text = SMALL.to_owned();
    for (from, to) in [
        ("mass_kg = 100\n", ""),
        ("center_of_mass_m = [0.0, 0.1, 0.0]", "center_of_mass_m = [0.0, \"low\", 0.0]"),
        ("specular = 0.2", "specular = true"),
        ("area_m2 = 2.0", "area_m2 = -2.0\nwings = 2"),
        ("center_m = [2.0, 0.0, 0.0]", "center_m = [2.0, 0.0]\ntilt_sign = 1.5\ncontrol = \"sun\""),
        ("capacity_n_m_s = 4.0", "capacity_n_m_s = 0\naxle = 1"),
    ] {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let expected = [
        ("mass_properties", "no key `mass_kg`"),
        ("mass_properties.center_of_mass_m[2]", "string \"low\""),
        ("optics.white.specular", "boolean `true`"),
        ("plates[1].area_m2", "-2"),
        ("plates[1].wings", "the unknown key `wings`"),
        ("panels[1].center_m", "a list of length 2"),
        ("panels[1].tilt_sign", "floating point `1.5`"),
        ("panels[1].control", "the unknown word `sun`"),
        ("wheels[1].capacity_n_m_s", "0"),
        ("wheels[1].axle", "the unknown key `axle`"),
    ];
    assert_eq!(reported(&text), expected.map(|(key, found)| (key.to_owned(), found.to_owned())));
    let lines: Vec<_> = problems(&text).into_iter().map(|problem| problem.line).collect();
    assert!(lines.is_sorted() && lines[0] == Some(3), "{lines:?}");
}

#[test]
fn one_mistake_is_one_problem_whatever_hangs_on_it() {
    for slip in include_str!("slips.txt").lines().skip(2) {
        let [from, to, key] = slip.split(" => ").collect::<Vec<_>>()[..] else { panic!("{slip}") };
        assert_eq!(problem(&from.replace("\\n", "\n"), &to.replace("\\n", "\n")).key, key);
    }
    let plate = SMALL.find("[[plates]]").unwrap()..SMALL.find("[[panels]]").unwrap();
    let panel = SMALL.find("[[panels]]").unwrap()..SMALL.find("[[wheels]]").unwrap();
    let bare = SMALL
        .replace(&SMALL[plate.clone()], "")
        .replace(&SMALL[panel], &SMALL[plate].replace("plates", "plate"));
    assert_eq!(
        reported(&bare),
        [("plate".to_owned(), "the unknown key `plate` (did you mean `plates`?)".to_owned())]
    );
    // Of an empty file only what it must have is reported.
    let lacks = ["name", "mass_properties", "optics"].map(|key| (String::new(), format!("no key `{key}`")));
    assert_eq!(reported("").split_last().unwrap(), (&(String::new(), "no surface".to_owned()), &lacks[..]));
}

#[test]
fn numbers_are_read_in_every_form_of_toml() {
    let read = |area: &str| {
        let text = SMALL.replacen("area_m2 = 2.0", &format!("area_m2 = {area}"), 1);
        Spacecraft::from_toml("small.toml", &text).map(|spacecraft| spacecraft.plates[0].area_m2)
    };
    for (text, area_m2) in [
        ("1_000.5", 1000.5),
        ("0x10", 16.0),
        ("+2e-1", 0.2),
        ("3", 3.0),
        ("0b11", 3.0),
        ("9223372036", 9_223_372_036.0),
    ] {
        assert_eq!(read(text), Ok(area_m2), "{text}");
    }
    assert_eq!(read("1e999").unwrap_err().problems[0].found, "floating point `1e999`");
    assert_eq!(read("1979-05-27").unwrap_err().problems[0].found, "the time 1979-05-27");
}

#[test]
fn a_file_without_surfaces_or_with_empty_lists_is_refused() {
    let head = &SMALL[..SMALL.find("[[plates]]").unwrap()];
    assert_eq!(problems(head)[0].found, "no surface");
    assert_eq!(problems(&format!("plates = []\n{head}"))[0].found, "an empty list");
}

#[test]
fn torn_text_names_the_line() {
    let torn = &SMALL[..SMALL.find("-1.0, 0.0]").unwrap()];
    let problems = problems(torn);
    assert_eq!(problems[0].line, Some(12), "{problems:?}");
    assert!(problems[0].found.contains("not TOML"));
    assert!(Spacecraft::from_toml("empty.toml", "").is_err());
}

#[test]
fn a_direction_written_with_four_digits_is_renormalised() {
    let text = SMALL.replace("normal = [0.0, -1.0, 0.0]", "normal = [0.7071, -0.7071, 0.0]");
    assert_relative_eq!(small(&text).plates[0].normal.x, 0.5_f64.sqrt(), epsilon = 1e-15);
}

#[test]
fn a_misalignment_turns_a_panel_about_the_body_origin() {
    let text = SMALL.replace("area_m2 = 3.0", "area_m2 = 3.0\nrotation_deg = [0.0, 0.0, 90.0]");
    let by_angles = &small(&text).panels[0];
    let matrix = "area_m2 = 3.0\ndcm_body_from_panel = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]";
    let by_matrix = &small(&SMALL.replace("area_m2 = 3.0", matrix)).panels[0];
    for panel in [by_angles, by_matrix] {
        assert_relative_eq!(panel.center_body_m, Vector3::new(0.0, 2.0, 0.0), epsilon = 1e-15);
        assert_relative_eq!(panel.axis_body, Vector3::y(), epsilon = 1e-15);
        assert_relative_eq!(panel.zero_normal_body, Vector3::x(), epsilon = 1e-15);
    }
}

proptest! {
    #[test]
    fn no_text_panics(text in "\\PC{0,200}") {
        let _ = Spacecraft::from_toml("any.toml", &text);
    }

    #[test]
    fn no_damage_to_a_good_file_panics(at in 0..SMALL.len(), byte in prop::char::range(' ', '~')) {
        let mut text = SMALL.to_owned();
        text.replace_range(at..at + 1, &byte.to_string());
        let _ = Spacecraft::from_toml("any.toml", &text).map_err(|error| error.to_string());
    }
}

#[test]
fn messenger_thermal_is_table_5() {
    let spacecraft = Spacecraft::from_toml("messenger-thermal.toml", MESSENGER_THERMAL_TOML).unwrap();
    assert_eq!((spacecraft.plates.len(), spacecraft.panels.len()), (8, 2));
    assert_eq!(spacecraft.mass_properties.mass_kg, 700.0);
    let plates: f64 = spacecraft.plates.iter().map(|plate| plate.area_m2).sum();
    assert_relative_eq!(plates, 2.122 + 1.264 + 2.121 + 2.0 * 2.35 + 2.0 * 1.803 + 4.612, epsilon = 1e-12);
    // -127.2 and -52.8 deg of right ascension.
    assert_relative_eq!(
        spacecraft.plates[0].normal.angle(&spacecraft.plates[2].normal).to_degrees(),
        74.4,
        epsilon = 1e-6
    );
    for panel in &spacecraft.panels {
        assert_relative_eq!(panel.faces.optics.absorptivity, 0.75);
        assert_relative_eq!(panel.faces.rear_optics.unwrap().absorptivity, 0.7, epsilon = 1e-15);
        assert_eq!(panel.faces.thermal.conduction.unwrap().conductance_w_m2_k, 18.0);
        assert_eq!(
            panel.faces.thermal.rear.unwrap().emission.emissivity,
            panel.faces.rear_optics.unwrap().absorptivity
        );
    }
}

#[test]
fn outlines_give_area_centre_and_normal() {
    let text = SMALL.replace(
        "area_m2 = 2.0\ncenter_m = [0.0, -1.0, 0.0]\nnormal = [0.0, -1.0, 0.0]",
        "polygon_m = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, -1.0, 3.0]]",
    );
    let plate = &small(&text).plates[0];
    assert_relative_eq!(plate.area_m2, 3.0, epsilon = 1e-14);
    assert_relative_eq!(plate.center_m, Vector3::new(0.0, -1.0, 1.0), epsilon = 1e-14);
    assert_relative_eq!(plate.normal, -Vector3::y(), epsilon = 1e-14);
    // The same vertices with the normal on the other side: the outline turns round.
    let text = text.replace("polygon_m", "normal = [0.0, 1.0, 0.0]\npolygon_m");
    assert_relative_eq!(small(&text).plates[0].normal, Vector3::y(), epsilon = 1e-14);
}

#[test]
fn corners_in_whole_millimetres_fit_the_exact_values_beside_them() {
    // A square of 0.3 m, tilted by 20 deg about X, with corners as a drawing has them.
    let text = |area_m2: f64| {
        let given = "area_m2 = 2.0\ncenter_m = [0.0, -1.0, 0.0]\nnormal = [0.0, -1.0, 0.0]";
        let tilted = format!(
            "area_m2 = {area_m2}\ncenter_m = [0.15, 0, 0]\nnormal = [0, -0.9396926, 0.3420201]\n\
             polygon_m = [[0, -0.051, -0.141], [0.3, -0.052, -0.141], [0.3, 0.051, 0.142], [0, 0.051, 0.141]]"
        );
        SMALL.replace(given, &tilted)
    };
    let spacecraft = Spacecraft::from_toml("small.toml", &text(0.09)).unwrap();
    let plate = &spacecraft.plates[0];
    let outline = plate.polygon.as_ref().unwrap();
    assert!((1e-4..1e-3).contains(&outline.off_plane_m()), "{}", outline.off_plane_m());
    assert_eq!((plate.area_m2, plate.normal), (outline.area_m2(), outline.normal()));
    assert_relative_eq!(plate.area_m2, 0.09, max_relative = 5e-3);
    let far = problems(&text(0.092));
    assert_eq!((far.len(), far[0].key.as_str()), (1, "plates[1].area_m2"), "{far:?}");
    assert!(far[0].allowed.ends_with(" within 3.3e-3"), "{far:?}");
}

#[test]
fn bad_outlines_and_heat_are_named() {
    let plate = "normal = [0.0, -1.0, 0.0]\noptics = \"white\"";
    let with = |more: &str| problem(plate, &format!("{plate}\n{more}"));
    let bent = with("polygon_m = [[-1, -1, -0.5], [1, -1, -0.5], [1, -1.1, 0.5], [-1, -1, 0.5]]");
    assert_eq!(bent.key, "plates[1].polygon_m");
    assert!(bent.found.contains("off the plane"), "{bent:?}");
    let crossing = with("polygon_m = [[-1, -1, -0.5], [1, -1, 0.5], [1, -1, -0.5], [-1, -1, 1.5]]");
    assert!(crossing.found.contains("cross"), "{crossing:?}");
    // What the outline would have given is not reported as missing besides.
    let given = "area_m2 = 2.0\ncenter_m = [0.0, -1.0, 0.0]\nnormal = [0.0, -1.0, 0.0]";
    let alone = problem(given, "polygon_m = [[-1, -1, -0.5], [1, -1, 0.5], [1, -1, -0.5], [-1, -1, 1.5]]");
    assert_eq!(alone.key, "plates[1].polygon_m");
    let small = with("polygon_m = [[-0.5, -1, -0.5], [0.5, -1, -0.5], [0.5, -1, 0.5], [-0.5, -1, 0.5]]");
    assert_eq!((small.key.as_str(), small.found.as_str()), ("plates[1].area_m2", "2"));
    let one_sided = with("thermal.conduction.conductance_w_m2_k = 3.0");
    assert_eq!(one_sided.key, "plates[1].thermal.conduction");
    let falling = problem("diffuse = 0.5", "diffuse = 0.5\nemissivity = 0.8\nemissivity_per_k = -1e-3");
    assert_eq!(falling.key, "optics.white.emissivity_per_k");
    let sum = problem("diffuse = 0.5", "diffuse = 0.5\nabsorptivity = 0.4");
    assert!(sum.allowed.contains("a sum of 1"), "{sum:?}");
    let nothing = problem("area_m2 = 2.0\n", "");
    assert_eq!(nothing.found, "no key `area_m2`");
}

#[test]
fn emissivity_and_infrared_absorptivity_stand_for_themselves() {
    let text =
        SMALL.replace("diffuse = 0.5", "diffuse = 0.5\nemissivity = 0.85\ninfrared_absorptivity = 0.9");
    let thermal = small(&text).plates[0].faces.thermal;
    assert_eq!(thermal.front.emission.emissivity, 0.85);
    let optics = thermal.front.infrared_optics;
    assert_relative_eq!(optics.absorptivity, 0.9);
    assert_relative_eq!(optics.diffuse / optics.specular, 2.5, epsilon = 1e-12);
    let plain = small(SMALL).plates[0].faces.thermal;
    assert_relative_eq!(plain.front.emission.emissivity, 0.3, epsilon = 1e-15);
}

#[test]
fn start_values_are_handed_on_with_their_lines() {
    let lines = SMALL.lines().count();
    let text = format!(
        "{SMALL}[start]\n\"a.b[1]\" = 1\nc = [1.5, \"2 cm\", [true]]\n[start.Plant]\n\"a.b\" = \"x\"\n"
    );
    let spacecraft = small(&text);
    let entry = |key: &str, line: usize, model: Option<&str>, name: &str, value: StartValue| StartEntry {
        key: key.to_owned(),
        line: lines + line,
        model: model.map(str::to_owned),
        is_fixed: false,
        name: name.to_owned(),
        value,
    };
    let list = StartValue::List(vec![
        StartValue::Real(1.5),
        StartValue::Text("2 cm".to_owned()),
        StartValue::List(vec![StartValue::Boolean(true)]),
    ]);
    assert_eq!(
        spacecraft.start,
        [
            entry("start.Plant.\"a.b\"", 5, Some("Plant"), "a.b", StartValue::Text("x".to_owned())),
            entry("start.\"a.b[1]\"", 2, None, "a.b[1]", StartValue::Integer(1)),
            entry("start.c", 3, None, "c", list),
        ]
    );
    // What the spacecraft is made of is the same: start values are of the models.
    let plain = small(SMALL);
    assert_eq!(Spacecraft { start: Vec::new(), ..spacecraft }, plain);
}

#[test]
fn what_is_no_start_value_of_anything_is_reported() {
    for (lines, key, found) in [
        ("[start]\na = 2011-04-06", "start.a", "the time 2011-04-06"),
        ("[start]\na = 99999999999999999999", "start.a", "integer `99999999999999999999`"),
        ("[start]\na = [1, {b = 2}]", "start.a[2]", "a table"),
        ("[start.Plant]\na.b = 2", "start.Plant.a", "a table"),
    ] {
        let reported = problem("[[wheels]]", &format!("{lines}\n[[wheels]]"));
        assert_eq!((reported.key.as_str(), reported.found.as_str()), (key, found), "{reported:?}");
    }
    let wrong = problem("name = \"Small\"", "name = \"Small\"\nstart = 1");
    assert_eq!((wrong.found.as_str(), wrong.allowed.as_str()), ("integer `1`", "a table"));
}

#[test]
fn a_thousand_faults_take_a_thousand_times_as_long_as_one() {
    let unknown_keys =
        |count: usize| (0..count).map(|k| format!("key_{k} = 1\n")).collect::<String>() + SMALL;
    let bad_plates = |count: usize| {
        let plate = "[[plates]]\nnormal = [1.0, 1.0, 0.0]\narea_m2 = \"x\"\n";
        SMALL.to_owned() + &plate.repeat(count)
    };
    let found = |text: &str| {
        let error = Spacecraft::from_toml("small.toml", text).unwrap_err();
        error.problems.len() + error.unlisted
    };
    // Of the processor for this thread alone, in s: what else the machine does plays no part.
    let spent_s = || {
        let schedstat = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
        schedstat.split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-9
    };
    // The kernel counts in ticks of some ms: 10,000 faults at least.
    let seconds = |text: &str, count: usize| {
        let ten_thousand = || {
            let before_s = spent_s();
            for _ in 0..10_000 / count {
                assert!(found(text) >= count);
            }
            spent_s() - before_s
        };
        (0..3).map(|_| ten_thousand()).fold(f64::INFINITY, f64::min)
    };
    for (file, most) in [(&unknown_keys as &dyn Fn(usize) -> String, 10_000), (&bad_plates, 1_900)] {
        let (few, many) = (seconds(&file(most / 10), most / 10), seconds(&file(most), most));
        // As long, with room for caches; each pair compared once would make it ten times.
        assert!(many < 4.0 * few, "{few} s for a tenth ten times, {many} s for {most}");
    }
}

impl Thruster {
    /// One with nothing but a place, a force and a flow.
    pub(crate) fn plain(position_body_m: Vector3<f64>, force_body_n: Vector3<f64>) -> Self {
        Self {
            name: String::new(),
            position_body_m,
            force_body_n,
            torque_body_n_m: position_body_m.cross(&force_body_n),
            flow_kg_s: 0.002,
            valve: ValveTiming::default(),
            scatter: 0.0,
            power_w: None,
            set: None,
            attitude_control: true,
            tank: 0,
            at_pressure_pa: None,
            plume_half_angle_rad: 0.0,
        }
    }
}
