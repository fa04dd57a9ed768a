//! Panels: signed offsets through 0, light on the cells and its corridor, a constant light.

use models::MomentumPlant;
use nalgebra::{Rotation3, Vector3};
use physics::constants::ASTRONOMICAL_UNIT_M;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing};

const DAY_S: f64 = 86_400.0;
const COMMANDED: &[(&str, f64)] = &[("panel[1].control", 3.0), ("panel[2].control", 3.0)];
const DISTANCE: &[(&str, f64)] =
    &[("panel[1].control", 5.0), ("panel[2].control", 5.0), ("panel[2].tilt", 2.0)];

/// Light on the cells of a panel of MESSENGER from what the plant shows: cells toward -Y at angle 0, turned about +X.
fn suns(plant: &NamedInstance<'_, MomentumPlant>, panel: usize) -> f64 {
    let angle_rad = plant.real(&format!("panel[{panel}].angleActual"));
    let normal = Rotation3::from_axis_angle(&Vector3::x_axis(), angle_rad) * -Vector3::y();
    let distance_au = plant.real("sun.distance") / ASTRONOMICAL_UNIT_M;
    normal.dot(&plant.vector("sun.direction")).max(0.0) / distance_au.powi(2)
}

#[test]
fn windmilling_goes_evenly_through_zero_and_its_sense_is_its_sign() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut plant = named.initialize(0.0, COMMANDED).unwrap();
    for k in -4..4 {
        let offset_rad = 0.01 * f64::from(k);
        plant.set("panel[1].sunOffsetCommand", offset_rad);
        plant.set("panel[2].sunOffsetCommand", -offset_rad);
        let rates = [("panel[1].sunOffsetCommand", 0.01 / 60.0), ("panel[2].sunOffsetCommand", -0.01 / 60.0)];
        plant.step_moving(60.0 * f64::from(k + 5), &rates).unwrap();
        // The Sun is across the axis of the panels, off -Y by the elevation.
        let turned = ["panel[1].angleActual", "panel[2].angleActual"].map(|name| plant.real(name));
        let expected = 0.01 * f64::from(k + 1);
        assert!((turned[0] - turned[1] - 2.0 * expected).abs() < 1e-12, "{k} {turned:?}");
        let facing_rad = 0.5 * (turned[0] + turned[1]);
        assert!((facing_rad - plant.real("sun.elevation")).abs() < 1e-12, "{turned:?}");
    }
    // A windmill is the mirror image in X of the opposite one: the torque along X stays, along Y and Z it changes sign.
    let [one, other] = [0.04, -0.04].map(|offset_rad| {
        let windmill = [("panel[1].sunOffset", offset_rad), ("panel[2].sunOffset", -offset_rad)];
        let mut plant = named.initialize(0.0, &windmill).unwrap();
        plant.step_to(600.0).unwrap();
        plant.vector("torque.solar")
    });
    let apart = (one - Vector3::new(other.x, -other.y, -other.z)).norm();
    assert!(one.y.abs() > 1e-6 && apart < 1e-9 * one.norm(), "{one} {other}");
}

#[test]
fn light_on_the_cells_and_its_margin_follow_from_where_the_panels_stand() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut plant =
        named.initialize(0.0, &[("panel[1].sunOffset", -0.3), ("panel[2].enabled", 0.0)]).unwrap();
    let mut outside = 0;
    for day in 0..44 {
        plant.step_to(f64::from(day) * 2.0 * DAY_S + 300.0).unwrap();
        let expected = suns(&plant, 1);
        let found = plant.real("panel[1].suns");
        assert!((found - expected).abs() < 1e-12 * expected, "{found} {expected}");
        let margin = plant.real("panel[1].corridorMargin");
        assert!((margin - (expected - 2.0).min(4.2 - expected)).abs() < 1e-11, "{margin} {expected}");
        outside += i32::from(margin < 0.0);
        assert_eq!(
            ["suns", "corridorMargin", "angleActual"].map(|it| plant.real(&format!("panel[2].{it}"))),
            [0.0; 3]
        );
    }
    assert!(outside > 0, "at 17 deg off the Sun the cells are too warm near perihelion");
    let refusal = named.refusal(&[("articulation.minimumSuns", 5.0)]);
    assert!(
        refusal
            .contains("articulation.maximumSuns: found 4.2, allowed: more than articulation.minimumSuns, 5")
    );
}

#[test]
fn control_by_distance_keeps_the_light_on_the_cells() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut plant = named.initialize(0.0, DISTANCE).unwrap();
    let mut distances_au = [f64::INFINITY, 0.0];
    for half_day in 1..=176 {
        plant.step_to(0.5 * DAY_S * f64::from(half_day)).unwrap();
        let distance_au = plant.real("sun.distance") / ASTRONOMICAL_UNIT_M;
        distances_au = [distances_au[0].min(distance_au), distances_au[1].max(distance_au)];
        for panel in [1, 2] {
            let found = suns(&plant, panel);
            assert!((found - 3.0).abs() < 1e-6, "{half_day} {panel}: {found} at {distance_au} AU");
            assert!((plant.real(&format!("panel[{panel}].corridorMargin")) - 1.0).abs() < 1e-6);
        }
        let [one, other] = [1, 2].map(|panel| plant.real(&format!("panel[{panel}].angleActual")));
        assert!(one > other + 0.5, "each tilts its own way: {one} {other}");
    }
    assert!(distances_au[0] < 0.32 && distances_au[1] > 0.45, "{distances_au:?}");
    // More than full sunlight there is not.
    let mut bright =
        named.initialize(0.0, &[DISTANCE, &[("articulation.targetSuns", 50.0)]].concat()).unwrap();
    bright.step_to(600.0).unwrap();
    let [sun, distance_au] =
        [bright.vector("sun.direction"), Vector3::repeat(bright.real("sun.distance") / ASTRONOMICAL_UNIT_M)];
    let across = sun.yz().norm();
    assert!((bright.real("panel[1].suns") - across / distance_au.x.powi(2)).abs() < 1e-9);
}

#[test]
fn cuts_change_nothing_under_control_by_distance() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let initialize = || named.initialize(0.0, DISTANCE).unwrap();
    let ends_s = (1..=24).map(|hour| 3600.0 * f64::from(hour));
    assert_cuts_change_nothing(initialize, ends_s, &[130.0, 60.0, 97.3], |_| {});
}
