//! start.attitude: whether a flight by torque starts in start.q at start.rate or as guidance points, and what the log says of it.

use client::NamedInstance;
use fmi_export::fmi2::entry;
use fmi_export::model_description::{Causality, ScalarVariable, VariableKind};
use fmi_export::{Library, Status};
use models::{Guidance, MomentumPlant};

static LIBRARY: Library = Library { entries: &[entry::<MomentumPlant>(), entry::<Guidance>()] };

const IDENTITY: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

/// A free flight with these values set, and what was logged of its start.
fn begun(set: impl FnOnce(&mut NamedInstance)) -> (NamedInstance, String) {
    let mut plant = NamedInstance::from_library(&LIBRARY, "MomentumPlant");
    set(&mut plant);
    plant.put_integer("attitude.source", 4);
    assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
    let messages = plant.fmu.drain_messages();
    let about = messages.iter().filter(|it| it.text.contains("the flight starts"));
    let about: Vec<_> = about.map(|it| it.text.clone()).collect();
    let text = about.last().cloned().unwrap_or_default();
    (plant, text)
}

fn is_identity(plant: &mut NamedInstance) -> bool {
    plant.array::<4>("attitude.q") == IDENTITY
}

#[test]
fn what_is_set_is_given_be_it_to_its_start_value() {
    let (mut plant, text) = begun(|_| {});
    assert!(
        !is_identity(&mut plant) && text.contains("internal guidance points") && text.contains("automatic"),
        "{text}"
    );
    let guided = plant.array::<4>("attitude.q");
    let guided_rate = plant.vector("attitude.rate");
    type Set = fn(&mut NamedInstance);
    let sets: [Set; 4] = [
        |plant| plant.put_vector("start.q", IDENTITY),
        |plant| {
            plant.put_vector("start.q", IDENTITY);
            plant.put_vector("start.rate", [0.0; 3]);
        },
        |plant| plant.put_vector("start.rate", [0.0; 3]),
        |plant| plant.put_integer("start.attitude", 3),
    ];
    for (number, set) in sets.into_iter().enumerate() {
        let (mut plant, text) = begun(set);
        assert!(is_identity(&mut plant), "{number}: {:?}", plant.array::<4>("attitude.q"));
        assert_eq!(plant.vector("attitude.rate"), [0.0; 3]);
        assert!(text.contains("in start.q at start.rate"), "{number}: {text}");
    }
    let (mut plant, text) = begun(|plant| {
        plant.put_vector("start.q", IDENTITY);
        plant.put_integer("start.attitude", 2);
    });
    assert!(
        plant.array::<4>("attitude.q") == guided && plant.vector("attitude.rate") == guided_rate,
        "{text}"
    );
    // The attitude of guidance, thrown off at a rate.
    let (mut plant, text) = begun(|plant| {
        plant.put_vector("start.rate", [0.01, 0.0, 0.0]);
        plant.put_integer("start.attitude", 2);
    });
    assert!(
        plant.array::<4>("attitude.q") == guided && (plant.real("attitude.rate[1]") - 0.01).abs() < 1e-15,
        "{text}"
    );
}

fn write_start(plant: &mut NamedInstance, variable: &ScalarVariable) {
    let name = &variable.name;
    match &variable.kind {
        VariableKind::Real { start, .. } => plant.put(name, start.unwrap()),
        VariableKind::Boolean { start, .. } => plant.put_boolean(name, start.unwrap()),
        VariableKind::String { start, .. } => plant.put_text(name, start.as_ref().unwrap()),
        VariableKind::Integer { start, .. } | VariableKind::Enumeration { start, .. } => {
            plant.put_integer(name, start.unwrap());
        }
    }
}

/// Some tools write every parameter; one that leaves out a single one chose the others.
#[test]
fn start_values_count_as_not_set_only_where_every_parameter_is_written() {
    let description = LIBRARY.describe(&LIBRARY.entries[0], None, None).unwrap();
    let parameters: Vec<_> =
        description.variables.iter().filter(|it| it.causality == Causality::Parameter).collect();
    let (mut plant, text) = begun(|plant| parameters.iter().for_each(|it| write_start(plant, it)));
    assert!(!is_identity(&mut plant), "{text}");
    assert!(text.contains("every parameter") && text.contains("start.attitude given (3)"), "{text}");
    let all_but_one = |plant: &mut NamedInstance| {
        parameters.iter().filter(|it| it.name != "noise.seed").for_each(|it| write_start(plant, it));
    };
    assert!(is_identity(&mut begun(all_but_one).0));
    // Of all that is written one of the two is another than its start value.
    let (mut plant, text) = begun(|plant| {
        parameters.iter().for_each(|it| write_start(plant, it));
        plant.put("start.rate[2]", 1e-3);
    });
    assert!(is_identity(&mut plant) && (plant.real("attitude.rate[2]") - 1e-3).abs() < 1e-15, "{text}");
}

#[test]
fn the_log_names_what_follows_others() {
    let mut plant = NamedInstance::from_library(&LIBRARY, "MomentumPlant");
    plant.put_integer("orbit.center", 3);
    assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
    let text: String = plant.fmu.drain_messages().iter().map(|it| format!("{}\n", it.text)).collect();
    assert!(text.contains("planet.radius = 6051800.0"), "{text}");
}
