//! The committed JSON Schemas are those the types give; `cargo xtask bless schema` writes them anew.

use std::fs;
use std::path::Path;

#[test]
fn the_schema_of_the_spacecraft_is_in_step() {
    assert_in_step("spacecraft.schema.json", &physics::spacecraft::schema());
}

#[test]
fn the_schema_of_the_timeline_is_in_step() {
    assert_in_step("timeline.schema.json", &physics::guidance::timeline::schema());
}

#[test]
fn the_schema_of_the_ephemeris_is_in_step() {
    assert_in_step("ephemeris.schema.json", &physics::environment::onboard::schema());
}

#[test]
fn the_schema_of_the_spinner_is_in_step() {
    assert_in_step("spinner.schema.json", &physics::spin::spinner::schema());
}

fn assert_in_step(file: &str, expected: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fmu-src/resources").join(file);
    if std::env::var_os("HELIOTORQUE_BLESS").is_some() {
        fs::write(&path, expected).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap();
    assert!(found == expected, "{} is out of step: cargo xtask bless schema", path.display());
}
