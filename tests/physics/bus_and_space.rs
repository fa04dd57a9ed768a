//! Space and bus in a spacecraft's file: defaults, what a surface says of its own, and what cannot be.

use physics::spacecraft::{BACKGROUND_K, BusLink, Spacecraft};

/// A file with lines at its top, of its only plate and of its only panel.
fn file(top: &str, plate: &str, panel: &str) -> String {
    format!(
        "name = \"Craft\"\n{top}\n[mass_properties]\nmass_kg = 100\ncenter_of_mass_m = [0, 0, 0]\n\
         inertia_kg_m2 = [[10, 0, 0], [0, 12, 0], [0, 0, 15]]\n[optics.white]\nspecular = 0.2\ndiffuse = 0.5\n\
         [[plates]]\nname = \"back\"\narea_m2 = 1\ncenter_m = [0, 1, 0]\nnormal = [0, 1, 0]\noptics = \"white\"\n{plate}\n\
         [[panels]]\nname = \"wing\"\narea_m2 = 2\ncenter_m = [2, 0, 0]\naxis = [1, 0, 0]\nzero_normal = [0, -1, 0]\n\
         optics = \"white\"\nrear_optics = \"white\"\n{panel}\n"
    )
}

fn refusal(top: &str, plate: &str, panel: &str) -> String {
    Spacecraft::from_toml("my.toml", &file(top, plate, panel)).unwrap_err().to_string()
}

#[test]
fn space_is_the_microwave_background_and_no_surface_conducts_to_the_bus() {
    let spacecraft = Spacecraft::from_toml("my.toml", &file("", "", "")).unwrap();
    assert_eq!((spacecraft.background_k, BACKGROUND_K), (2.725, 2.725));
    assert_eq!(spacecraft.plates[0].faces.thermal.bus, [BusLink::NONE; 2]);
    assert_eq!(spacecraft.panels[0].faces.thermal.bus, [BusLink::NONE; 2]);
}

#[test]
fn a_surface_takes_the_files_bus_or_its_own() {
    let top = "thermal = { background_k = 40, bus_temperature_k = 290 }";
    let panel = "thermal = { bus_conductance_w_m2_k = 1.5, rear_bus_conductance_w_m2_k = 0.5, bus_temperature_k = 250 }";
    let spacecraft =
        Spacecraft::from_toml("my.toml", &file(top, "thermal.bus_conductance_w_m2_k = 3", panel)).unwrap();
    let link = |conductance_w_m2_k, temperature_k| BusLink { conductance_w_m2_k, temperature_k };
    assert_eq!(spacecraft.background_k, 40.0);
    assert_eq!(spacecraft.plates[0].faces.thermal.bus, [link(3.0, 290.0), BusLink::NONE]);
    assert_eq!(spacecraft.panels[0].faces.thermal.bus, [link(1.5, 250.0), link(0.5, 250.0)]);
    // A box hands it on to its faces.
    let boxed = "[[boxes]]\nname = \"bus\"\ncenter_m = [0, 0, 0]\nsize_m = [1, 1, 2]\noptics = \"white\"\n\
                 thermal = { bus_conductance_w_m2_k = 3 }";
    let spacecraft = Spacecraft::from_toml("my.toml", &file(top, "", boxed)).unwrap();
    let faces = spacecraft.plates.iter().filter(|plate| plate.faces.thermal.bus[0] == link(3.0, 290.0));
    assert_eq!(faces.count(), 6);
}

#[test]
fn what_cannot_be_is_reported_with_its_key() {
    for (top, plate, panel, expected) in [
        ("thermal.background_k = -1", "", "", "thermal.background_k: found -1, allowed: 0 to 2000 K"),
        (
            "thermal.bus_temperature_k = 3000",
            "",
            "",
            "thermal.bus_temperature_k: found 3000, allowed: 0 to 2000 K",
        ),
        ("thermal.background = 3", "", "", "`background`"),
        (
            "",
            "thermal.bus_conductance_w_m2_k = 3",
            "",
            "plates[1].thermal.bus_conductance_w_m2_k: found no temperature of the bus",
        ),
        (
            "",
            "thermal.bus_temperature_k = 290",
            "",
            "plates[1].thermal.bus_temperature_k: found no conductance to the bus",
        ),
        (
            "thermal.bus_temperature_k = 290",
            "thermal.bus_conductance_w_m2_k = -3",
            "",
            "plates[1].thermal.bus_conductance_w_m2_k: found -3",
        ),
        (
            "thermal.bus_temperature_k = 290",
            "thermal.rear_bus_conductance_w_m2_k = 3",
            "",
            "plates[1].thermal.rear_bus_conductance_w_m2_k: found a surface without `rear_optics`",
        ),
        (
            "",
            "",
            "thermal = { bus_conductance_w_m2_k = 1, bus_temperature_k = 1e9 }",
            "panels[1].thermal.bus_temperature_k",
        ),
    ] {
        let reported = refusal(top, plate, panel);
        assert!(reported.contains(expected), "{expected}\n{reported}");
    }
}
