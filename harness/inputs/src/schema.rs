//! Test that the committed schema of a file is the one that its tables give.

/// Whether `fmu-src/resources` holds the schema of a kind of file; `cargo xtask bless schema` writes it anew.
pub(crate) fn assert_in_step<T: schemars::JsonSchema>(kind: &str) {
    let mut schema = schemars::schema_for!(T);
    schema.insert("title".to_owned(), format!("heliotorque {kind}").into());
    let requested = format!("{:#}", schema.as_value());
    let resources = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fmu-src/resources");
    let path = resources.join(format!("{kind}.schema.json"));
    if std::env::var_os("HELIOTORQUE_BLESS").is_some() {
        std::fs::write(&path, &requested).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap();
    assert!(found == requested, "{} is out of step: cargo xtask bless schema", path.display());
}

#[test]
fn every_schema_is_in_step() {
    assert_in_step::<crate::mission::keys::MissionKeys>("mission");
    assert_in_step::<crate::campaign::keys::CampaignKeys>("campaign");
    assert_in_step::<crate::plan::keys::PlanKeys>("plan");
    assert_in_step::<crate::leg::keys::LegKeys>("leg");
}
