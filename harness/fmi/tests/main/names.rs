//! People's names and values: vectors, patterns, units, items; and errors that help.

use fmi::{Fmu, Value, parse_assignment};

use crate::{description, folder};

fn assigned(text: &str) -> Result<Vec<(String, Value)>, String> {
    let (_folder, fmu) = folder(&description());
    parse_assignment(fmu.description(), text).map_err(|error| error.to_string())
}

fn value(text: &str) -> Value {
    assigned(text).unwrap().remove(0).1
}

#[test]
fn reals_take_units() {
    assert_eq!(value("ship.mass=1.5"), Value::Real(1.5));
    assert_eq!(value("ship.mass = -1e-3 m"), Value::Real(-1e-3));
    assert_eq!(value("ship.mass=2.54cm"), Value::Real(0.0254));
    assert_eq!(value("ship.mass=.5e1cm"), Value::Real(0.05));
    // Offsets too: 20 above a sea level that lies at 500.
    assert_eq!(value("ship.mass=20 above sea"), Value::Real(520.0));
    assert_eq!(value("ship.mass=2000 cm above sea"), Value::Real(520.0));
    for (text, expected) in [
        ("ship.mass=5km", "the units m, cm, above sea"),
        ("ship.mass=", "no number"),
        ("ship.mass=nan", "no number"),
        ("ship.mass=inf", "no number"),
        ("ship.mass=1e999", "beyond"),
        ("ship.mass=m", "no number"),
        ("ship.mass=日本", "no number"),
    ] {
        let error = assigned(text).unwrap_err();
        assert!(error.contains(expected) && error.contains("ship.mass"), "{text}: {error}");
    }
}

#[test]
fn other_types_take_what_people_write() {
    assert_eq!(value("drive.on=true"), Value::Boolean(true));
    assert_eq!(value("drive.on=0"), Value::Boolean(false));
    assert_eq!(value("drive.mode=burn"), Value::Integer(7));
    assert_eq!(value("drive.mode=7"), Value::Integer(7));
    assert_eq!(value("drive.turns=-3"), Value::Integer(-3));
    assert_eq!(value("ship.name=a=b, c"), Value::Text("a=b, c".to_owned()));
    assert!(assigned("drive.on=yes").unwrap_err().contains("true, false"));
    assert!(assigned("drive.mode=land").unwrap_err().contains("coast (1), burn (7)"));
    assert!(assigned("drive.turns=1.5").unwrap_err().contains("whole number"));
    assert!(assigned("drive.turns=3000000000").unwrap_err().contains("whole number"));
    assert!(assigned("no equals sign").unwrap_err().contains("name=value"));
}

#[test]
fn a_vector_is_set_whole() {
    let all = assigned("ship.arm=1,2cm,-3").unwrap();
    let expected = [("ship.arm[1]", 1.0), ("ship.arm[2]", 0.02), ("ship.arm[3]", -3.0)];
    assert_eq!(all.len(), 3);
    for ((name, value), (expected, number)) in all.iter().zip(expected) {
        assert_eq!((name.as_str(), value), (expected, &Value::Real(number)));
    }
    let same: Vec<Value> = assigned("ship.arm=2cm").unwrap().into_iter().map(|(_, value)| value).collect();
    assert_eq!(same, vec![Value::Real(0.02); 3]);
    assert!(assigned("ship.arm=1,2").unwrap_err().contains("2 values given for its 3 elements"));
}

fn selected<'a>(fmu: &'a Fmu, pattern: &str) -> Vec<&'a str> {
    let positions = fmu.select(pattern).unwrap();
    positions.into_iter().map(|it| fmu.description().variables[it].name.as_str()).collect()
}

#[test]
fn patterns_keep_declaration_order() {
    let (_folder, fmu) = folder(&description());
    let names = |pattern: &str| selected(&fmu, pattern);
    assert_eq!(names("position"), ["position[1]", "position[2]"]);
    assert_eq!(names("position[*]"), names("position"));
    assert_eq!(names("position[2]"), ["position[2]"]);
    assert_eq!(names("*.m*"), ["ship.mass", "drive.mode"]);
    assert_eq!(names("*").len(), 12);
    assert!(fmu.select("nothing.*").is_err());
}

#[test]
fn a_name_may_be_in_another_case_where_one_has_it() {
    let (_folder, fmu) = folder(&description());
    let names = |pattern: &str| selected(&fmu, pattern);
    assert_eq!(names("Ship.MASS"), ["ship.mass"]);
    assert_eq!(names("Position"), ["position[1]", "position[2]"]);
    assert_eq!(names("POS*"), ["position[1]", "position[2]"]);
    assert_eq!(names("pos*on"), ["position[1]", "position[2]"]);
    assert_eq!(value("SHIP.mass=2cm"), Value::Real(0.02));
    // Two that differ in case alone: only the exact name means one of them.
    let mut twice = description();
    twice.variables[4].name = "ship.Mass".to_owned();
    let (_folder, fmu) = folder(&twice);
    assert_eq!(fmu.select("ship.Mass").unwrap().len(), 1);
    let error = fmu.select("SHIP.MASS").unwrap_err().to_string();
    assert!(error.contains("ship.Mass") && error.contains("ship.mass"), "{error}");
}

#[test]
fn a_wrong_name_gets_its_neighbours() {
    let (_folder, fmu) = folder(&description());
    let error = fmu.variable("ship.mas").unwrap_err().to_string();
    assert!(error.contains("near it: ship.mass"), "{error}");
    let error = fmu.variable("warp.coil").unwrap_err().to_string();
    assert!(error.contains("info --variables"), "{error}");
}
