//! Outputs are written when they are read: one that is read alone is what it is among all.

use client::NamedInstance;
use fmi_export::fmi2::entry;
use fmi_export::model_description::{BaseType, Causality};
use fmi_export::{Library, Status};
use models::{DisturbanceTorque, Guidance, MomentumPlant, SpinPlant};

static LIBRARY: Library = Library {
    entries: &[
        entry::<MomentumPlant>(),
        entry::<SpinPlant>(),
        entry::<Guidance>(),
        entry::<DisturbanceTorque>(),
    ],
};

type Output = (BaseType, u32, String);

fn outputs(instance: &NamedInstance) -> Vec<Output> {
    let outputs = instance.description.variables.iter().filter(|it| it.causality == Causality::Output);
    outputs.map(|it| (it.kind.base_type(), it.value_reference, it.name.clone())).collect()
}

/// The bits of an output.
fn read(instance: &mut NamedInstance, (base, reference, name): &Output) -> u64 {
    let (mut real, mut integer) = ([f64::NAN], [0]);
    let status = match base {
        BaseType::Real => instance.fmu.get_real(&[*reference], &mut real),
        BaseType::Integer => instance.fmu.get_integer(&[*reference], &mut integer),
        BaseType::Boolean => instance.fmu.get_boolean(&[*reference], &mut integer),
        BaseType::String => panic!("{name} is a String"),
    };
    assert_eq!(status, Status::Ok, "{name}");
    if *base == BaseType::Real { real[0].to_bits() } else { u64::from(integer[0].unsigned_abs()) }
}

/// At each step another output is read alone in one of two instances, and all in the other, the Reals by one call; after every third step
/// something was set before.
fn each_alone(model: &str, step_s: f64, mut set: impl FnMut(&mut NamedInstance, u32)) {
    let mut both = [(); 2].map(|()| {
        let mut instance = NamedInstance::from_library(&LIBRARY, model);
        set(&mut instance, 0);
        instance.begin(0.0);
        instance
    });
    let outputs = outputs(&both[0]);
    let reals = outputs.iter().filter(|(base, ..)| *base == BaseType::Real);
    let reals: Vec<u32> = reals.map(|(_, reference, _)| *reference).collect();
    let mut moved = 0;
    let mut before: Vec<u64> = Vec::new();
    for (k, output) in (1..).zip(&outputs) {
        both.iter_mut().for_each(|it| it.step_to(f64::from(k) * step_s));
        // One by one each could lack what another brings along.
        assert_eq!(both[0].fmu.get_real(&reals, &mut vec![0.0; reals.len()]), Status::Ok);
        let values: Vec<u64> = outputs.iter().map(|it| read(&mut both[0], it)).collect();
        moved += before.iter().zip(&values).filter(|(a, b)| a != b).count();
        before = values;
        if k % 3 == 0 {
            both.iter_mut().for_each(|it| set(it, k));
        }
        let [all, alone] = both.each_mut().map(|it| read(it, output));
        assert_eq!(all, alone, "{} of {model} after step {k}", output.2);
    }
    assert!(moved > 5 * outputs.len(), "{moved}");
}

#[test]
fn of_the_plant_in_guided_flight() {
    // Between two looks at the forces, which are ten minutes apart, no step has computed the loads.
    each_alone("MomentumPlant", 150.0, |plant, k| {
        if k > 0 {
            plant.put("torque.applied[1]", 1e-6 * f64::from(k));
        }
    });
}

#[test]
fn of_the_plant_in_controlled_flight() {
    each_alone("MomentumPlant", 0.5, |plant, k| match k {
        0 => {
            plant.put_integer("attitude.source", 3);
            plant.put_integer("command.source", 2);
        }
        _ => plant.put("torque.applied[1]", 1e-6 * f64::from(k)),
    });
}

#[test]
fn of_disturbance_torque() {
    each_alone("DisturbanceTorque", 1.0, |model, k| {
        let turn_rad = 0.1 * f64::from(k);
        model.put_vector("sun.positionBody", [5e10 * turn_rad.sin(), -6e10 * turn_rad.cos(), 1e9]);
        model.put_vector("planet.positionBody", [3e6 * turn_rad.cos(), 4e6, 3e6 * turn_rad.sin()]);
        if k % 2 == 1 {
            model.put("solar.scale", 1.0 + 0.01 * f64::from(k));
        }
    });
}
