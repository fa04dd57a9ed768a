//! Flights of the models through their C functions, as digests of the bits of all outputs at all communication points.
//!
//! The digest is FNV-1a (64 bits) over the bytes of every Real, Integer and Boolean output, little-endian.

use client::NamedInstance;
use fmi_export::Library;
use fmi_export::fmi2::entry;
use model_description::{Causality, VariableKind};
use models::{Guidance, MomentumPlant, SpinPlant};

static LIBRARY: Library =
    Library { entries: &[entry::<MomentumPlant>(), entry::<SpinPlant>(), entry::<Guidance>()] };

/// A simulation.
pub struct DigestCase {
    /// Model and scenario.
    pub name: &'static str,
    /// Simulates the case and returns the digest of its outputs.
    pub digest: fn() -> u64,
}

/// Simulations whose digests are compared across platforms.
pub const FLIGHTS: &[DigestCase] = &[
    DigestCase {
        name: "MomentumPlant, 10 days with planet light, heat, dumps and a disturbed orbit",
        digest: plant_with_all,
    },
    DigestCase { name: "MomentumPlant, 90 days with dumps", digest: plant_with_dumps },
    DigestCase {
        name: "MomentumPlant, 90 days with planet light, heat and dumps",
        digest: plant_with_light_and_heat,
    },
    DigestCase { name: "SpinPlant, manoeuvre", digest: manoeuvre },
    DigestCase { name: "Guidance, a day of the orbit phase", digest: guidance },
];

const DAY_S: f64 = 86_400.0;
const ORBIT_PHASE: i32 = 10;
const DISTURBED: i32 = 2;

fn plant() -> NamedInstance {
    let mut plant = instance("MomentumPlant");
    plant.put_vector("dump.threshold", [4.0; 3]);
    plant.put("spacecraft.centerOfMass[3]", -0.0254);
    plant
}

fn plant_with_dumps() -> u64 {
    simulated(plant(), 90.0 * DAY_S, 600.0)
}

fn plant_with_light_and_heat() -> u64 {
    let mut plant = plant();
    plant.put_boolean("planetLight.enabled", true);
    plant.put_boolean("thermal.enabled", true);
    simulated(plant, 90.0 * DAY_S, 600.0)
}

fn plant_with_all() -> u64 {
    let mut plant = plant();
    plant.put_boolean("planetLight.enabled", true);
    plant.put_boolean("thermal.enabled", true);
    plant.put_integer("orbit.dynamics", DISTURBED);
    simulated(plant, 10.0 * DAY_S, 60.0)
}

fn manoeuvre() -> u64 {
    simulated(instance("SpinPlant"), 1400.0, 1.0)
}

fn guidance() -> u64 {
    let mut guidance = instance("Guidance");
    guidance.put_integer("pointing.scenario", ORBIT_PHASE);
    // A circle of 12 h about Mercury by arithmetic alone: each step turns it by twice the angle whose tangent this is.
    let tangent = 7.27e-4;
    let (cosine, sine) =
        ((1.0 - tangent * tangent) / (1.0 + tangent * tangent), 2.0 * tangent / (1.0 + tangent * tangent));
    let (mut x, mut z) = (1.0, 0.0);
    simulate_with(guidance, DAY_S, 10.0, move |guidance| {
        guidance.put_vector("position", [10.136e6 * x, 0.0, 10.136e6 * z]);
        guidance.put_vector("velocity", [-1474.0 * z, 0.0, 1474.0 * x]);
        (x, z) = (cosine * x - sine * z, sine * x + cosine * z);
    })
}

fn instance(model: &str) -> NamedInstance {
    let mut instance = NamedInstance::from_library(&LIBRARY, model);
    // The logger has a variable number of arguments, which WebAssembly passes in its own way.
    instance.fmu.set_debug_logging(false, &[]);
    instance
}

/// Steps to `stop_s` and digests all outputs at every communication point.
fn simulated(instance: NamedInstance, stop_s: f64, step_s: f64) -> u64 {
    simulate_with(instance, stop_s, step_s, |_| ())
}

/// The same with inputs that `set` sets before initialization and before each step.
fn simulate_with(
    mut instance: NamedInstance,
    stop_s: f64,
    step_s: f64,
    mut set: impl FnMut(&mut NamedInstance),
) -> u64 {
    let outputs = || instance.description.variables.iter().filter(|it| it.causality == Causality::Output);
    let of = |kind: fn(&VariableKind) -> bool| -> Vec<u32> {
        outputs().filter(|it| kind(&it.kind)).map(|it| it.value_reference).collect()
    };
    let reals = of(|kind| matches!(kind, VariableKind::Real { .. }));
    let integers = of(|kind| matches!(kind, VariableKind::Integer { .. } | VariableKind::Enumeration { .. }));
    let booleans = of(|kind| matches!(kind, VariableKind::Boolean { .. }));
    let mut digest = 0xcbf2_9ce4_8422_2325_u64;
    let mut take = |bytes: &[u8]| {
        for byte in bytes {
            digest = (digest ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
        }
    };
    set(&mut instance);
    instance.begin(0.0);
    for step in 0..=(stop_s / step_s) as u32 {
        if step > 0 {
            set(&mut instance);
            instance.step_to(f64::from(step) * step_s);
        }
        instance.read(&reals).iter().for_each(|value| take(&value.to_bits().to_le_bytes()));
        for (references, are_booleans) in [(&integers, false), (&booleans, true)] {
            let mut values = vec![0; references.len()];
            let status = match are_booleans {
                true => instance.fmu.get_boolean(references, &mut values),
                false => instance.fmu.get_integer(references, &mut values),
            };
            instance.ok("outputs", status);
            values.iter().for_each(|value| take(&value.to_le_bytes()));
        }
    }
    digest
}

/// How many flights there are.
#[unsafe(no_mangle)]
pub extern "C" fn count() -> usize {
    FLIGHTS.len()
}

/// The digest of a flight.
#[unsafe(no_mangle)]
pub extern "C" fn digest(flight: usize) -> u64 {
    (FLIGHTS[flight].digest)()
}

/// The name of a flight, in UTF-8 and not ended by NUL.
#[unsafe(no_mangle)]
pub extern "C" fn name(flight: usize) -> *const u8 {
    FLIGHTS[flight].name.as_ptr()
}

/// The bytes of the name of a flight.
#[unsafe(no_mangle)]
pub extern "C" fn name_length(flight: usize) -> usize {
    FLIGHTS[flight].name.len()
}
