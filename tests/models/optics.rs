//! Optics, air's hold on surfaces and biases of panels as parameters: as an edited file, from the start on or from where they are
//! set in flight, however that is cut.

use std::collections::BTreeMap;

use fmi_export::Model;
use model_description::{Causality, Status, VariableKind};
use models::{DisturbanceTorque, Guidance, MomentumPlant};
use nalgebra::{Rotation3, Unit, Vector3};

use super::disturbance_torque::instance;
use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing, assert_same};
use super::plant_light::{BUSY, EFFECTS, SHADOWED};

fn assert_near(found: f64, expected: f64, allowed: f64) {
    assert!((found - expected).abs() <= allowed, "{found} {expected}");
}

/// Two materials on surfaces that shadow one another, in air, with and without heat stored: a shade, a bus and a panel.
const FILE: &str = r#"
name = "Optics"
[mass_properties]
mass_kg = 100
center_of_mass_m = [0.1, 0.05, -0.2]
inertia_kg_m2 = [[10, 0.5, -0.2], [0.5, 12, 0.3], [-0.2, 0.3, 15]]
MATERIALS
[[plates]]
name = "shade"
polygon_m = [[-0.5, -1.2, -0.4], [0.6, -1.2, -0.4], [0.5, -1.2, 0.6], [-0.4, -1.2, 0.5]]
normal = [0.0, -1.0, 0.0]
optics = "shield-film"
rear_optics = "bus"
thermal.conduction = { conductance_w_m2_k = 0.5, radiative_exchange = 0.02 }
[[plates]]
name = "front"
polygon_m = [[-1.0, 0.3, -1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-1.0, 0.3, 1.0]]
normal = [-0.1483404, -0.9889364, 0.0]
optics = "bus"
thermal.heat_capacity_j_m2_k = 4000.0
[[panels]]
name = "wing"
area_m2 = 1.5
center_m = [-3.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
zero_normal = [0.0, -1.0, 0.0]
optics = "shield-film"
rear_optics = "bus"
control = "sun_offset"
sun_offset_deg = 30.0
"#;

const SUNSHADE: &str = r#"
[sunshade]
model = "cylinder"
rotation_deg = [4.0, 7.0, -3.0]
[sunshade.cylinder]
radius_m = 0.991
height_m = 2.489
subtended_angle_deg = 122.0
optics = "shield-film"
"#;

type Values = BTreeMap<&'static str, f64>;

/// Numbers of the materials by parameter, without those that the file of the flight leaves to the absorptivity.
const NUMBERS: [(&str, &str, f64, f64); 13] = [
    ("shieldFilm.specular", "specular", 0.0, 0.5),
    ("shieldFilm.diffuse", "diffuse", 0.0, 0.5),
    ("shieldFilm.dragCoefficient", "drag_coefficient", 1.5, 2.5),
    ("bus.specular", "specular", 0.0, 0.5),
    ("bus.diffuse", "diffuse", 0.0, 0.5),
    ("bus.emissivity", "emissivity", 0.1, 0.9),
    ("bus.infraredAbsorptivity", "infrared_absorptivity", 0.1, 0.9),
    ("bus.dragCoefficient", "drag_coefficient", 1.5, 2.5),
    ("bus.energyAccommodation", "energy_accommodation", 0.1, 0.9),
    ("bus.normalAccommodation", "normal_accommodation", 0.1, 0.9),
    ("bus.tangentialAccommodation", "tangential_accommodation", 0.1, 0.9),
    ("bus.wallTemperature", "wall_temperature_k", 100.0, 400.0),
    ("shieldFilm.wallTemperature", "wall_temperature_k", 100.0, 400.0),
];

fn file(values: &Values, more: &str) -> String {
    let material = |name: &str, called: &str| {
        let keys = NUMBERS.iter().filter_map(|(parameter, key, ..)| {
            parameter.strip_prefix(called)?.strip_prefix('.')?;
            Some(format!("{key} = {:?}\n", values[parameter]))
        });
        format!("[optics.{name}]\n{}", keys.collect::<String>())
    };
    let materials = material("shield-film", "shieldFilm") + &material("bus", "bus");
    FILE.replace("MATERIALS", &materials) + more
}

/// Rows of Sobol's kind: each number in its own range, spread evenly (additive recurrence by irrational steps).
fn row(number: usize) -> Values {
    let spread = |k: usize| ((number + 1) as f64 * ((2 * k + 3) as f64).sqrt()).fract();
    (0..).zip(NUMBERS).map(|(k, (name, _, low, high))| (name, low + (high - low) * spread(k))).collect()
}

fn sets(values: &Values) -> Vec<(String, f64)> {
    values.iter().map(|(name, value)| (format!("optics.{name}"), *value)).collect()
}

fn borrowed(sets: &[(String, f64)]) -> Vec<(&str, f64)> {
    sets.iter().map(|(name, value)| (name.as_str(), *value)).collect()
}

/// Each output to a part of the largest of its vector.
fn assert_close<M: Model>(a: &NamedInstance<'_, M>, b: &NamedInstance<'_, M>, part: f64) {
    let vector = |name: &str| name.rsplit_once('[').map_or(name.to_owned(), |(vector, _)| vector.to_owned());
    let (found, expected) = (a.output_bits(), b.output_bits());
    let mut largest: BTreeMap<String, f64> = BTreeMap::new();
    for (name, bits) in &expected {
        let size = largest.entry(vector(name)).or_insert(1e-30);
        *size = size.max(f64::from_bits(*bits).abs());
    }
    for ((name, x), (_, y)) in found.into_iter().zip(expected) {
        let [x, y] = [x, y].map(f64::from_bits);
        let allowed = part * largest[&vector(name)];
        assert!((x - y).abs() <= allowed, "{name} at {} s: {x:?} {y:?}", a.time_s());
    }
}

const EVERYTHING: &[(&str, f64)] = &[
    ("aerodynamics.enabled", 1.0),
    ("aerodynamics.law", 2.0),
    ("atmosphere.method", 1.0),
    ("atmosphere.referenceDensity", 1e-12),
    ("atmosphere.referenceHeight", 1e6),
    ("atmosphere.scaleHeight", 1e6),
];

#[test]
fn rows_over_optics_equal_edited_files() {
    let own = row(99);
    for more in ["", SUNSHADE] {
        let flight = NamedModel::<MomentumPlant>::with("optics.toml", &file(&own, more));
        for number in 0..20 {
            let values = row(number);
            // Every law of air in turn; heat on or off decides whose wall temperatures count.
            let law =
                [("aerodynamics.law", 1.0 + (number % 3) as f64), ("thermal.enabled", (number % 2) as f64)];
            let given = sets(&values);
            let all = [EFFECTS, SHADOWED, EVERYTHING, &law].concat();
            let edited = NamedModel::<MomentumPlant>::with("optics.toml", &file(&values, more));
            let mut edited = edited.initialize(0.0, &all).unwrap();
            let mut set = flight.initialize(0.0, &[all, borrowed(&given)].concat()).unwrap();
            let mut largest = [0.0_f64; 2];
            for end_s in [0.0, 1200.0, 3600.0] {
                if end_s > 0.0 {
                    edited.step_to(end_s).unwrap();
                    set.step_to(end_s).unwrap();
                }
                assert_close(&set, &edited, 1e-12);
                for (largest, name) in largest.iter_mut().zip(["torque.aerodynamic", "torque.solar"]) {
                    *largest = largest.max(set.vector(name).norm());
                }
            }
            assert!(largest.iter().all(|torque| *torque > 1e-9), "{largest:?}");
        }
    }
}

/// Set in flight: what is memoryless is at once that of a flight that has it from the start on.
#[test]
fn what_is_set_in_flight_acts_from_there_on() {
    let named = NamedModel::<MomentumPlant>::with("optics.toml", &file(&row(99), SUNSHADE));
    let given = sets(&row(3));
    let plain = [
        EFFECTS,
        EVERYTHING,
        &[("shadowing.enabled", 0.0), ("thermal.storage", 0.0), ("solver.disturbanceStep", 3600.0)],
    ]
    .concat();
    let mut set = named.initialize(0.0, &plain).unwrap();
    let mut from_start = named.initialize(0.0, &[plain, borrowed(&given)].concat()).unwrap();
    for flight in [&mut set, &mut from_start] {
        flight.step_to(1000.0).unwrap();
    }
    let apart = |a: &NamedInstance<'_, MomentumPlant>, b: &NamedInstance<'_, MomentumPlant>, name: &str| {
        (a.vector(name) - b.vector(name)).norm() / b.vector(name).norm()
    };
    assert!(apart(&set, &from_start, "torque.solar") > 1e-3);
    for (name, value) in borrowed(&given) {
        set.set(name, value);
    }
    for flight in [&mut set, &mut from_start] {
        flight.step_to(1001.0).unwrap();
    }
    for (name, allowed) in
        [("torque.solar", 1e-14), ("force.solar", 1e-14), ("force.thermal", 1e-5), ("force.albedo", 1e-5)]
    {
        let off = apart(&set, &from_start, name);
        assert!(off <= allowed, "{name} {off:e}");
    }
    // The coefficients of the shade's torque follow too.
    for i in 0..27 {
        let name = format!("sunshade.coefficient[{},{}]", i / 9 + 1, i % 9 + 1);
        assert_eq!(set.real(&name), from_start.real(&name));
    }
}

#[test]
fn neither_cuts_nor_restores_change_a_bit_of_a_flight_whose_optics_are_set() {
    let named = NamedModel::<MomentumPlant>::with("optics.toml", &file(&row(99), SUNSHADE));
    let given = sets(&row(5));
    let initialize = || named.initialize(0.0, &[EFFECTS, SHADOWED, EVERYTHING, BUSY].concat()).unwrap();
    assert_cuts_change_nothing(
        initialize,
        (1..=13).map(|k| 1777.0 * f64::from(k)),
        &[130.0, 97.3],
        |flight| {
            let number = (flight.time_s() / 1777.0) as usize;
            let (name, value) = &given[number % given.len()];
            flight.set(name, *value);
            flight.set("panel[1].angleBias", 0.1 * (number / 5) as f64);
        },
    );
    let memoryless = NamedModel::<DisturbanceTorque>::with("optics.toml", &file(&row(99), ""));
    let mut one = memoryless.initialize(0.0, EFFECTS).unwrap();
    borrowed(&given).into_iter().for_each(|(name, value)| one.set(name, value));
    one.step_to(1.0).unwrap();
    let mut other = one.restored();
    for flight in [&mut one, &mut other] {
        flight.step_to(2.0).unwrap();
    }
    assert_same(&one, &other);
}

#[test]
fn more_reflected_than_received_fails_the_step_by_name() {
    let text = file(&row(99), "");
    let expected = "optics.bus.specular + optics.bus.diffuse: found 1.5, allowed: a sum of at most 1";
    let sets = [("optics.bus.specular", 0.75), ("optics.bus.diffuse", 0.75)];
    fn refused<M: Model>(text: &str, sets: &[(&str, f64)], expected: &str) {
        let named = NamedModel::<M>::with("optics.toml", text);
        let refusal = named.refusal(sets);
        assert!(refusal.starts_with(expected), "{refusal}");
        let mut flight = named.initialize(0.0, &[]).unwrap();
        flight.step_to(10.0).unwrap();
        sets.iter().for_each(|(name, value)| flight.set(name, *value));
        let refusal = flight.step_to(20.0).unwrap_err().to_string();
        assert!(refusal.contains(expected), "{refusal}");
    }
    refused::<MomentumPlant>(&text, &sets, expected);
    refused::<DisturbanceTorque>(&text, &sets, expected);
    refused::<Guidance>(&text, &sets, expected);
}

/// Each force of light is linear in a reflectivity, the absorptivity being the rest, so that the derivative is any difference.
#[test]
fn derivatives_by_reflectivities_are_differences_of_any_step() {
    let mut fmu = instance("DisturbanceTorque", "optics", &file(&row(7), SUNSHADE));
    for switch in ["planetLight.enabled", "thermal.enabled"] {
        fmu.put_boolean(switch, true);
    }
    assert_eq!(fmu.fmu.setup_experiment(0.0, None), Status::Ok);
    assert_eq!(fmu.fmu.enter_initialization_mode(), Status::Ok);
    let outputs: Vec<u32> = ["solar", "albedo"]
        .iter()
        .flat_map(|effect| ["force", "torque"].map(|load| format!("{load}.{effect}")))
        .flat_map(|vector| [1, 2, 3].map(|axis| fmu.at(&format!("{vector}[{axis}]"))))
        .collect();
    for name in [
        "optics.shieldFilm.specular",
        "optics.shieldFilm.diffuse",
        "optics.bus.specular",
        "optics.bus.diffuse",
    ] {
        let (parameter, own) = (fmu.at(name), fmu.real(name));
        let mut slopes = vec![0.0; outputs.len()];
        let status = fmu.fmu.get_directional_derivative(&outputs, &[parameter], &[1.0], &mut slopes);
        assert_eq!(status, Status::Ok, "{:?}", fmu.fmu.drain_messages());
        let mut at = |value: f64| {
            fmu.put(name, value);
            fmu.read(&outputs)
        };
        let (low, high) = (at(0.05), at(0.45));
        at(own);
        let largest = slopes.iter().fold(0.0_f64, |most, slope| most.max(slope.abs()));
        assert!(largest > 1e-8, "{name} {largest:e}");
        for (slope, (low, high)) in slopes.iter().zip(low.iter().zip(high)) {
            assert!((slope - (high - low) / 0.4).abs() < 1e-13 * largest, "{name} {slope} {low} {high}");
        }
    }
}

#[test]
fn a_bias_adds_to_the_angle_of_a_panel_under_every_control() {
    let named = NamedModel::<MomentumPlant>::with("optics.toml", &file(&row(99), ""));
    for control in 1..=5 {
        let by = [
            ("panel[1].control", f64::from(control)),
            ("panel[1].angle", 0.4),
            ("panel[1].sunOffsetCommand", -0.2),
        ];
        let simulated = |sets: &[(&str, f64)]| {
            let mut flight = named.initialize(0.0, sets).unwrap();
            flight.step_to(600.0).unwrap();
            flight
        };
        let own = simulated(&by);
        let biased = simulated(&[&by[..], &[("panel[1].angleBias", 0.3)]].concat());
        let angle_rad = own.real("panel[1].angleActual");
        assert_near(biased.real("panel[1].angleActual"), angle_rad + 0.3, 1e-12);
        let stands = simulated(&[("panel[1].control", 2.0), ("panel[1].angle", angle_rad + 0.3)]);
        let (found, expected) = (biased.vector("force.solar"), stands.vector("force.solar"));
        assert!((found - expected).norm() < 1e-12 * expected.norm(), "{control} {found} {expected}");
        let axis = Unit::new_normalize(Vector3::x());
        let turned = Rotation3::from_axis_angle(&axis, angle_rad + 0.3) * -Vector3::y();
        let suns = turned.dot(&biased.vector("sun.direction")).max(0.0);
        let distance_au = biased.real("sun.distance") / 149_597_870_700.0;
        let suns = suns / (distance_au * distance_au);
        assert_near(biased.real("panel[1].suns"), suns, 1e-9 * suns);
    }
}

/// Sources that can act have parameters: air where the file has it or is about the Earth, sunlight alone in Guidance, and no material that
/// no surface is made of.
#[test]
fn parameters_are_those_that_can_act() {
    let plain = "specular = 0.2\ndiffuse = 0.3\n";
    let text = |more: &str| {
        let materials = format!("[optics.shield-film]\n{plain}[optics.bus]\n{plain}[optics.unused]\n{plain}");
        FILE.replace("MATERIALS", &materials) + more
    };
    let names = |model: &str, text: &str| {
        let fmu = instance(model, "parameters", text);
        let variables = fmu.description.variables.iter().filter(|it| it.name.starts_with("optics."));
        let names = variables.map(|it| {
            assert_eq!(
                (it.causality, &it.variability),
                (Causality::Parameter, &model_description::Variability::Tunable)
            );
            assert!(matches!(it.kind, VariableKind::Real { .. }));
            it.name["optics.".len()..].to_owned()
        });
        names.collect::<Vec<_>>()
    };
    let of = |kinds: &[&str]| {
        ["shieldFilm", "bus"]
            .iter()
            .flat_map(|name| kinds.iter().map(move |kind| format!("{name}.{kind}")))
            .collect::<Vec<_>>()
    };
    let light = ["specular", "diffuse"];
    let heat = [&light[..], &["emissivity", "infraredAbsorptivity"]].concat();
    let air = [
        &heat[..],
        &[
            "dragCoefficient",
            "energyAccommodation",
            "normalAccommodation",
            "tangentialAccommodation",
            "wallTemperature",
        ],
    ]
    .concat();
    for model in ["MomentumPlant", "DisturbanceTorque"] {
        assert_eq!(names(model, &text("")), of(&heat));
        assert_eq!(names(model, &text("[start]\n'aerodynamics.enabled' = true")), of(&air));
        assert_eq!(names(model, &text("[fixed]\n'aerodynamics.enabled' = false")), of(&heat));
        let about_earth = text("[start.MomentumPlant]\n'orbit.center' = 'earth'");
        assert_eq!(names(model, &about_earth), of(&air));
    }
    assert_eq!(names("Guidance", &text("")), of(&light));
}
