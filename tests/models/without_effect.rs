//! Settings that can have no effect are refused or reported by name.

use fmi_export::Model;
use models::{DisturbanceTorque, MomentumPlant};

use super::named_model::NamedModel;
use super::spacecraft::{ALL, RADIATING};

fn warnings<M: Model>(text: &str, sets: &[(&str, f64)]) -> Vec<String> {
    let named = NamedModel::<M>::with("my.toml", text);
    named.initialize(0.0, sets).unwrap();
    // What else is odd about these spacecraft is not of this file.
    let own = ["shadowing.enabled: ", "[planet_map]"];
    named.warnings().into_iter().filter(|it| own.iter().any(|begin| it.starts_with(begin))).collect()
}

const SHADOWS: &[(&str, f64)] = &[("shadowing.enabled", 1.0)];

fn shadows_need_outlines<M: Model>() {
    let thermal = include_str!("../../fmu-src/resources/messenger-thermal.toml");
    let found = NamedModel::<M>::with("my.toml", thermal).refusal(SHADOWS);
    let expected = "shadowing.enabled: found true, allowed: false, as no surface of MESSENGER, thermal has an outline that could \
                    cast a shadow; polygon_m gives one to `shade -X`, `shade front`, ";
    assert!(found.starts_with(expected), "{found}");
    assert_eq!(
        warnings::<M>(RADIATING, SHADOWS),
        [
            "shadowing.enabled: `far`, `outer` have no outline (polygon_m), cast no shadow and are never shadowed"
        ]
    );
    let whole = include_str!("../../fmu-src/resources/messenger-full.toml");
    assert_eq!(warnings::<M>(whole, SHADOWS), [""; 0]);
    assert_eq!(warnings::<M>(RADIATING, &[]), [""; 0]);
    // A file that asks for them is refused before anything is packed.
    let text = format!("{}[start]\n\"shadowing.enabled\" = true\n", ALL);
    let line = text.lines().count();
    let found = M::parse_setup("my.toml", &text).err().unwrap().to_string();
    assert!(
        found.starts_with(&format!("my.toml:{line}: start.\"shadowing.enabled\": found true, ")),
        "{found}"
    );
    let other = format!("{}[start.Guidance]\n\"shadowing.enabled\" = true\n", ALL);
    assert!(M::parse_setup("my.toml", &other).is_ok());
}

#[test]
fn shadows_without_outlines_in_the_plant() {
    shadows_need_outlines::<MomentumPlant>();
}

#[test]
fn shadows_without_outlines_in_disturbance_torque() {
    shadows_need_outlines::<DisturbanceTorque>();
}

/// A cylindrical shade has no outline.
#[test]
fn a_cylindrical_shade_casts_no_shadow() {
    let whole = include_str!("../../fmu-src/resources/messenger-full.toml");
    let cylinder = "[sunshade.cylinder]\nradius_m = 0.991\nheight_m = 2.489\nsubtended_angle_deg = 122.0\noptics = \
                    \"shade-cloth\"\n[start]";
    let text = if whole.contains("[sunshade.cylinder]") {
        whole.to_owned()
    } else {
        whole.replace("[start]", cylinder)
    };
    let sets = [("shadowing.enabled", 1.0), ("sunshade.shape", 2.0)];
    let found = warnings::<DisturbanceTorque>(&text, &sets);
    assert!(found.len() == 1 && found[0].contains("`sunshade.cylinder` has no outline"), "{found:?}");
}

#[test]
fn a_map_of_the_planet_that_nothing_reads() {
    let used = [("planetLight.enabled", 1.0), ("planetLight.method", 3.0)];
    assert_eq!(warnings::<DisturbanceTorque>(ALL, &used), [""; 0]);
    for sets in [&[][..], &used[..1], &used[1..]] {
        let found = warnings::<DisturbanceTorque>(ALL, sets);
        assert!(
            found.len() == 1 && found[0].starts_with("[planet_map] in the spacecraft.toml of All"),
            "{found:?}"
        );
    }
    let found = warnings::<MomentumPlant>(ALL, &[("planetLight.enabled", 1.0)]);
    assert!(found.len() == 1 && found[0].contains("DisturbanceTorque alone takes it"), "{found:?}");
}

/// A source that a switch leaves out is 0 by itself, in the totals and by face; nothing else changes.
#[test]
fn each_switch_of_disturbance_torque_takes_one_source_away() {
    let named = NamedModel::<DisturbanceTorque>::with("my.toml", RADIATING);
    let all = [("planetLight.enabled", 1.0), ("thermal.enabled", 1.0), ("gravityGradient.enabled", 1.0)];
    let simulated = |sets: &[(&str, f64)]| {
        let flight = named.initialize(0.0, sets).unwrap();
        let mut found = Vec::new();
        for source in ["solar", "albedo", "infrared", "thermal"] {
            found.push((
                source,
                flight.vector(&format!("torque.{source}")),
                flight.vector(&format!("force.{source}")),
            ));
        }
        let gradient = flight.vector("torque.gravityGradient");
        let torque: nalgebra::Vector3<f64> =
            found.iter().map(|it| it.1).sum::<nalgebra::Vector3<f64>>() + gradient;
        let force: nalgebra::Vector3<f64> = found.iter().map(|it| it.2).sum();
        let faces: nalgebra::Vector3<f64> =
            (1..=7).map(|k| flight.vector(&format!("plate[{k}].force"))).sum();
        assert!((torque - flight.vector("torque.total")).norm() < 1e-18);
        assert!((force - flight.vector("force.total")).norm() < 1e-18);
        assert!((faces - force).norm() < 1e-12 * force.norm());
        (found, gradient)
    };
    let (whole, gradient) = simulated(&all);
    assert!(whole.iter().all(|it| it.1.norm() > 0.0 && it.2.norm() > 0.0) && gradient.norm() > 0.0);
    let (dim, _) = simulated(&[&all[..], &[("planetLight.enabled", 0.0)]].concat());
    assert_eq!(dim[0], whole[0]);
    assert!(dim[1].2.norm() == 0.0 && dim[2].2.norm() == 0.0 && dim[3].2.norm() > 0.0);
    // Less heat arrives.
    assert!(dim[3].2 != whole[3].2);
    let (cold, _) = simulated(&[&all[..], &[("thermal.enabled", 0.0)]].concat());
    assert_eq!(cold[..3], whole[..3]);
    assert!(cold[3].1.norm() == 0.0 && cold[3].2.norm() == 0.0);
    let (light, none) = simulated(&[&all[..], &[("gravityGradient.enabled", 0.0)]].concat());
    assert_eq!(light, whole);
    assert_eq!(none.norm(), 0.0);
}
