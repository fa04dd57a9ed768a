//! Whatever bytes reach fmi2DeSerializeFMUstate, the answer is a status and the instance stays usable.

use client::{InProcess, Names, StatePointer, short_or_long};
use heliotorque_tests::counting::counted;
use model_description::{BaseType, Status};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use crate::scenarios::{Scenario, Simulation};
use crate::support::{self, fresh, ok};

/// Mark, layout version, GUID digest; then payload length and checksum, then the payload (see `blob.rs`).
const BEFORE_LENGTH: usize = 8 + 4 + 16;
const HEADER: usize = BEFORE_LENGTH + 8 + 8;

/// FNV-1a, 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    let mut hash: u64 = 14_695_981_039_346_656_037;
    for byte in bytes {
        hash ^= u64::from(*byte);
        hash = hash.wrapping_mul(1_099_511_628_211);
    }
    hash
}

/// `payload` behind the mark, version and digest of `like`, with a length and checksum that are right.
fn seal(like: &[u8], payload: &[u8]) -> Vec<u8> {
    let mut sealed = like[..BEFORE_LENGTH].to_vec();
    sealed.extend_from_slice(&(payload.len() as u64).to_le_bytes());
    sealed.extend_from_slice(&checksum(payload).to_le_bytes());
    sealed.extend_from_slice(payload);
    sealed
}

/// Blobs of the three states a master saves most: fresh, initializing, running.
fn genuine(model: &str) -> Vec<Vec<u8>> {
    let mut blobs = Vec::new();
    let mut instance = fresh(model);
    let mut save = |instance: &mut InProcess| {
        let (status, bytes) = instance.state_bytes();
        ok(status);
        blobs.push(bytes);
    };
    save(&mut instance);
    ok(instance.setup_experiment(0.0, None));
    ok(instance.enter_initialization_mode());
    save(&mut instance);
    ok(instance.exit_initialization_mode());
    for step in 0..5 {
        ok(instance.do_step(60.0 * f64::from(step), 60.0));
    }
    save(&mut instance);
    if model == "MomentumPlant" {
        let mut instance = fresh(model);
        let names = support::names(model);
        let on = |name: &str| names.typed(BaseType::Boolean, name);
        ok(instance.set_boolean(&[on("planetLight.enabled"), on("thermal.enabled")], &[1, 1]));
        ok(instance.set_integer(&[names.typed(BaseType::Integer, "orbit.dynamics")], &[2]));
        ok(instance.start(0.0, None));
        ok(instance.do_step(0.0, 1000.0));
        save(&mut instance);
    }
    blobs
}

#[test]
fn the_seal_is_the_documented_one() {
    for model in ["Empty", "AllTypes", "MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance"] {
        for blob in genuine(model) {
            assert_eq!(seal(&blob, &blob[HEADER..]), blob, "{model}");
        }
    }
}

/// Damage to a genuine payload before it is sealed again.
#[derive(Clone, Debug)]
enum Damage {
    /// Other bytes in its place.
    Replaced(Vec<u8>),
    /// Bits flipped, by position in the payload (modulo its length).
    Flipped(Vec<(usize, u8)>),
    /// Bytes overwritten.
    Overwritten(usize, Vec<u8>),
    /// Bytes put in between.
    Inserted(usize, Vec<u8>),
    /// Bytes taken out.
    Removed(usize, usize),
    CutOff(usize),
}

impl Damage {
    fn applied_to(&self, payload: &[u8]) -> Vec<u8> {
        let mut damaged = payload.to_vec();
        let length = damaged.len().max(1);
        match self {
            Self::Replaced(bytes) => damaged.clone_from(bytes),
            Self::Flipped(flips) => flips.iter().for_each(|(at, bits)| {
                if let Some(byte) = damaged.get_mut(at % length) {
                    *byte ^= bits;
                }
            }),
            Self::Overwritten(at, bytes) => {
                damaged.iter_mut().skip(at % length).zip(bytes).for_each(|(to, from)| *to = *from);
            }
            Self::Inserted(at, bytes) => {
                let tail = damaged.split_off(at % length);
                damaged.extend_from_slice(bytes);
                damaged.extend(tail);
            }
            Self::Removed(at, count) => {
                let at = (at % length).min(damaged.len());
                let end = (at + count).min(damaged.len());
                damaged.drain(at..end);
            }
            Self::CutOff(at) => damaged.truncate(at % length),
        }
        damaged
    }
}

/// Bytes that mean most to a decoder: long lengths, NaN, infinities, plain noise.
fn chunk() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        4 => prop::collection::vec(any::<u8>(), 1..24),
        1 => Just(vec![0xFF; 9]),
        1 => Just(vec![0xFF, 0xFF, 0xFF, 0xFF, 0x0F]),
        1 => prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::MAX, -1e300, 0.0, 5e-324])
            .prop_map(|number| number.to_le_bytes().to_vec()),
    ]
}

fn damage() -> impl Strategy<Value = Damage> {
    prop_oneof![
        1 => prop::collection::vec(any::<u8>(), 0..600).prop_map(Damage::Replaced),
        3 => prop::collection::vec((any::<usize>(), any::<u8>()), 1..4).prop_map(Damage::Flipped),
        4 => (any::<usize>(), chunk()).prop_map(|(at, bytes)| Damage::Overwritten(at, bytes)),
        2 => (any::<usize>(), chunk()).prop_map(|(at, bytes)| Damage::Inserted(at, bytes)),
        2 => (any::<usize>(), 1_usize..20).prop_map(|(at, count)| Damage::Removed(at, count)),
        1 => any::<usize>().prop_map(Damage::CutOff),
    ]
}

/// One instance that is offered blobs, and its state when reset.
struct Target {
    model: &'static str,
    instance: InProcess,
    names: Names,
    fresh_bytes: Vec<u8>,
    accepted: u32,
}

impl Target {
    fn new(model: &'static str) -> Self {
        let mut instance = fresh(model);
        let fresh_bytes = instance.state_bytes().1;
        Self { model, instance, names: support::names(model), fresh_bytes, accepted: 0 }
    }

    /// The bytes are refused with an error, or give a state the instance can continue from; never a panic.
    fn offer(&mut self, bytes: &[u8]) {
        let ((status, state), count) = counted(|| self.instance.deserialize(bytes));
        // No length inside the bytes makes the decoder request more memory than they can fill.
        let limit = 200_000 + 100 * bytes.len() as u64;
        assert!(count.bytes < limit, "{}: {} bytes requested for {}", self.model, count.bytes, bytes.len());
        match status {
            Status::Ok => self.use_restored(&state),
            Status::Error => assert!(state.is_null()),
            other => panic!("{}: {other:?}", self.model),
        }
        self.check_log();
        ok(self.instance.reset());
        assert_eq!(self.instance.state_bytes(), (Status::Ok, self.fresh_bytes.clone()), "{}", self.model);
    }

    fn use_restored(&mut self, state: &StatePointer) {
        self.accepted += 1;
        ok(self.instance.set_state(state));
        // What is well formed may still be nonsense: any status, but an answer, and soon.
        let (_, time_s) = self.instance.last_successful_time();
        let mut reals = vec![0.0; self.names.all(BaseType::Real).len()];
        let _ = self.instance.get_real(self.names.all(BaseType::Real), &mut reals);
        let _ = self.instance.do_step(time_s, 60.0);
        let _ = self.instance.get_real(self.names.all(BaseType::Real), &mut reals);
        let _ = self.instance.state_bytes();
    }

    fn check_log(&self) {
        let messages = self.instance.drain_messages();
        assert!(messages.iter().all(|it| !it.text.contains("panic")), "{}: {messages:?}", self.model);
    }
}

fn run<S: Strategy>(cases: u32, strategy: S, test: impl Fn(S::Value)) {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    TestRunner::new(config)
        .run(&strategy, |value| {
            test(value);
            Ok(())
        })
        .unwrap_or_else(|failure| panic!("{failure}"));
}

/// Few are accepted by chance, many after a flip in a number: both must happen for the test to mean much.
fn resealed(model: &'static str, cases: u32) {
    let blobs = genuine(model);
    // A panic takes the target with it; shrinking continues with a new one.
    let kept = std::cell::Cell::new(None);
    run(cases, (0..blobs.len(), damage()), |(which, damage)| {
        let mut target = kept.take().unwrap_or_else(|| Target::new(model));
        target.offer(&seal(&blobs[which], &damage.applied_to(&blobs[which][HEADER..])));
        kept.set(Some(target));
    });
    let accepted = kept.take().unwrap().accepted;
    assert!(accepted > cases / 100 && accepted < cases, "{model}: {accepted} of {cases} accepted");
}

#[test]
fn resealed_payloads_of_all_types_are_refused_or_usable() {
    resealed("AllTypes", 20_000);
}

#[test]
fn resealed_payloads_of_the_plant_are_refused_or_usable() {
    resealed("MomentumPlant", short_or_long(1_500, 5_000));
}

#[test]
fn resealed_payloads_of_the_spinner_are_refused_or_usable() {
    resealed("SpinPlant", 5_000);
}

#[test]
fn resealed_payloads_of_the_memoryless_model_are_refused_or_usable() {
    resealed("DisturbanceTorque", 5_000);
}

#[test]
fn torn_guidance_states_never_end_the_process() {
    resealed("Guidance", short_or_long(1_500, 5_000));
}

#[test]
fn raw_bytes_are_refused() {
    let target = std::cell::RefCell::new(Target::new("AllTypes"));
    run(10_000, prop::collection::vec(any::<u8>(), 0..200), |bytes| target.borrow_mut().offer(&bytes));
    assert_eq!(target.borrow().accepted, 0);
}

#[test]
fn every_truncation_and_every_flipped_bit_is_refused() {
    let blob = genuine("AllTypes").remove(2);
    let mut target = Target::new("AllTypes");
    for length in 0..blob.len() {
        target.offer(&blob[..length]);
    }
    let mut flipped = blob.clone();
    for at in 0..blob.len() * 8 {
        flipped[at / 8] ^= 1 << (at % 8);
        target.offer(&flipped);
        flipped[at / 8] ^= 1 << (at % 8);
    }
    assert_eq!(target.accepted, 0);
    target.offer(&blob);
    assert_eq!(target.accepted, 1);
}

#[test]
fn states_of_other_models_and_other_setups_are_refused() {
    let own = genuine("AllTypes").remove(2);
    for other in ["Empty", "Panicking", "MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance"] {
        let foreign = fresh(other).state_bytes().1;
        let mut target = Target::new("AllTypes");
        target.offer(&foreign);
        assert_eq!(target.accepted, 0, "{other}");
        // The same bytes under our own digest are no state of ours either.
        target.offer(&seal(&own, &foreign[HEADER..]));
        assert_eq!(target.accepted, 0, "{other}");
        // And a state in memory, handed to the wrong instance.
        let mut state = StatePointer::null();
        ok(fresh(other).get_state(&mut state));
        assert_eq!(target.instance.set_state(&state), Status::Error, "{other}");
        ok(target.instance.reset());
    }
    let mut target = Target::new("AllTypes");
    ok(target.instance.reset());
    let mut later = own;
    later[8] += 1;
    let _ = target.instance.drain_messages();
    assert_eq!(target.instance.deserialize(&later).0, Status::Error);
    let messages = target.instance.drain_messages();
    assert!(messages[0].text.contains("layout version 4, this library reads 3"), "{messages:?}");
}

/// Bytes are judged before any setting is read: an instance in which nothing was ever set and one in the midst of another simulation
/// take and refuse the same ones, with the same words.
fn judged_alike(scenario: Scenario, cases: u32) {
    let model = scenario.model();
    let blobs = genuine(model);
    let mut busy = Simulation::new(scenario);
    (0..10).for_each(|_| busy.step());
    ok(busy.instance.set_debug_logging(true, &[]));
    let (bare, busy) = (std::cell::RefCell::new(fresh(model)), std::cell::RefCell::new(busy.instance));
    let judged = |instance: &std::cell::RefCell<InProcess>, bytes: &[u8]| {
        let mut instance = instance.borrow_mut();
        let _ = instance.drain_messages();
        let (status, state) = instance.deserialize(bytes);
        let texts: Vec<String> = instance.drain_messages().into_iter().map(|it| it.text).collect();
        (status, state.is_null(), texts)
    };
    let (refused, taken) = (std::cell::Cell::new(0), std::cell::Cell::new(0));
    run(cases, (0..blobs.len(), damage()), |(which, damage)| {
        let bytes = seal(&blobs[which], &damage.applied_to(&blobs[which][HEADER..]));
        let found = judged(&bare, &bytes);
        let count = if found.0 == Status::Ok { &taken } else { &refused };
        count.set(count.get() + 1);
        assert_eq!(judged(&busy, &bytes), found, "{scenario:?}");
    });
    assert!(taken.get() > cases / 100 && refused.get() > cases / 100, "{} {}", taken.get(), refused.get());
}

#[test]
fn bytes_are_judged_before_any_setting_is_read() {
    for scenario in [Scenario::Free, Scenario::Lit, Scenario::Fired, Scenario::Placed, Scenario::Safed] {
        judged_alike(scenario, short_or_long(500, 3_000));
    }
}
