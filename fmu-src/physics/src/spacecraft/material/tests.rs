//! Values of a material act as if the file had them.

use approx::assert_relative_eq;

use super::*;
use crate::numerics::scalar::Dual64;
use crate::spacecraft::Spacecraft;

/// A plate of this material, which may be followed by its further keys.
fn file(keys: &str) -> String {
    format!(
        "name = 'test'\nmass_properties = {{ mass_kg = 10.0, center_of_mass_m = [0, 0, 0], inertia_kg_m2 = [[1, 0, 0], \
         [0, 1, 0], [0, 0, 1]] }}\n[optics.shield-film]\n{keys}\n[[plates]]\narea_m2 = 1.0\ncenter_m = [0, 0, 0]\n\
         normal = [0, 0, 1]\noptics = 'shield-film'\n"
    )
}

fn material(keys: &str) -> NamedMaterial {
    Spacecraft::from_toml("", &file(keys)).unwrap().materials.swap_remove(0)
}

#[test]
fn values_act_as_if_they_stood_in_the_file() {
    for (before, after) in [
        ("specular = 0.15\ndiffuse = 0.35", "specular = 0.4\ndiffuse = 0.05"),
        (
            "specular = 0.15\ndiffuse = 0.35\nemissivity = 0.3\ninfrared_absorptivity = 0.2",
            "specular = 0.6\ndiffuse = 0.4\nemissivity = 0.7\ninfrared_absorptivity = 0.8",
        ),
        (
            "absorptivity = 0.1\nspecular = 0.3\ndiffuse = 0.6\ndrag_coefficient = 2.0\nwall_temperature_k = 250",
            "absorptivity = 0.7\nspecular = 0.1\ndiffuse = 0.2\nenergy_accommodation = 0.5\nnormal_accommodation = 0.4\n\
             tangential_accommodation = 0.3",
        ),
    ] {
        let (before, after) = (material(before), material(after));
        assert_eq!(before.name, "shieldFilm");
        // Unchanged, to the bit.
        assert_eq!(before.with(&before.values()).unwrap(), before.material);
        let found = before.with(&after.values()).unwrap();
        let numbers = |it: Material| {
            let numbers = core::cell::RefCell::new(Vec::new());
            it.map(|number| numbers.borrow_mut().push(number));
            numbers.into_inner()
        };
        for (found, edited) in numbers(found).into_iter().zip(numbers(after.material)) {
            assert_relative_eq!(found, edited, epsilon = 1e-15);
        }
    }
}

#[test]
fn what_follows_changes_with_the_absorptivity() {
    let own = material("specular = 0.15\ndiffuse = 0.35");
    let mut values = own.values().map(|it| Dual64::new(it, 0.0));
    values.specular.eps = 1.0;
    let found = own.with(&values).unwrap();
    assert_eq!(found.map(|it| it.re), own.material);
    assert_eq!(found.optics.absorptivity.eps, -1.0);
    assert_eq!(found.thermal.infrared_optics.absorptivity.eps, -1.0);
    assert_eq!(found.thermal.emission.emissivity.eps, -1.0);
    // A number that is left to the absorptivity changes by itself too.
    values.specular.eps = 0.0;
    values.emissivity.value.eps = 1.0;
    values.infrared_absorptivity.value.eps = 2.0;
    let thermal = own.with(&values).unwrap().thermal;
    assert_eq!((thermal.emission.emissivity.eps, thermal.infrared_optics.absorptivity.eps), (1.0, 2.0));
    assert_relative_eq!(thermal.infrared_optics.specular.eps, -2.0 * 0.15 / 0.5, epsilon = 1e-15);
}

#[test]
fn what_no_material_does_is_refused_by_name() {
    let own = material("specular = 0.15\ndiffuse = 0.35\nemissivity = 0.5\nemissivity_per_k = -1e-4");
    let refusal = |change: fn(&mut MaterialValues)| {
        let mut values = own.values();
        change(&mut values);
        own.with(&values).unwrap_err().to_string()
    };
    assert_eq!(
        refusal(|it| it.specular = 0.75),
        "optics.shieldFilm.specular + optics.shieldFilm.diffuse: found 1.1, allowed: a sum of at most 1; the rest is absorbed"
    );
    let refused = refusal(|it| it.emissivity.value = 0.1);
    assert!(refused.starts_with("optics.shieldFilm.emissivity: found 0.1 with"), "{refused}");
}

#[test]
fn names_without_a_variable_and_names_alike_are_refused() {
    let renamed = |name: &str| {
        Spacecraft::from_toml("", &file("specular = 0.1\ndiffuse = 0.1").replace("shield-film", name))
    };
    for (name, variable) in [("white_paint", "whitePaint"), ("mli-2-outer", "mli2Outer"), ("MLI", "MLI")] {
        assert_eq!(renamed(name).unwrap().materials[0].name, variable);
    }
    let refused = renamed("2mil").unwrap_err().to_string();
    assert!(refused.contains("optics.2mil") && refused.contains("the first a letter"), "{refused}");
    let clash = file("specular = 0.1\ndiffuse = 0.1\n[optics.shieldFilm]\nspecular = 0.0\ndiffuse = 0.0");
    let refused = Spacecraft::from_toml("", &clash).unwrap_err().to_string();
    assert!(refused.contains("optics.shieldFilm.*, as of `shield-film`"), "{refused}");
}

/// Only what surfaces are made of has parameters.
#[test]
fn unused_materials_are_left_out() {
    let keys = "specular = 0.1\ndiffuse = 0.1\n[optics.unused]\nspecular = 0.0\ndiffuse = 0.0";
    let spacecraft = Spacecraft::from_toml("", &file(keys)).unwrap();
    assert_eq!(spacecraft.materials.len(), 1);
    assert_eq!(spacecraft.plates[0].faces.materials, [Some(0), None]);
}
