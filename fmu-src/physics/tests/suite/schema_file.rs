//! The committed JSON Schema is the one the spacecraft types give; `UPDATE_SCHEMA=1` writes it anew.

use std::fs;
use std::path::Path;

#[test]
fn the_schema_file_is_in_step() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../resources/spacecraft.schema.json");
    let wanted = physics::spacecraft::schema();
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        fs::write(&path, &wanted).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap();
    assert!(found == wanted, "{} is out of step: run the tests once with UPDATE_SCHEMA=1", path.display());
}
