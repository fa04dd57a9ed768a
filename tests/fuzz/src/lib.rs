//! Common code of the fuzz targets: the models in this process, their variables, and sealed states.

use std::cell::RefCell;

use client::{InProcess, Names};
use fmi_export::fmi2::entry;
use fmi_export::{Library, Status};
use model_description::BaseType;
use models::{DisturbanceTorque, Guidance, MomentumPlant, SpinPlant};
use probe::{AllTypes, Empty};

/// The models of the targets, in the order of an input's first byte.
pub const MODELS: [&str; 6] =
    ["MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance", "AllTypes", "Empty"];

/// A library of one model, so that instantiating it does not describe the others.
pub fn library(model: &str) -> &'static Library {
    static MOMENTUM_PLANT: Library = Library { entries: &[entry::<MomentumPlant>()] };
    static SPIN_PLANT: Library = Library { entries: &[entry::<SpinPlant>()] };
    // The shipped file has start values for MomentumPlant.
    static DISTURBANCE_TORQUE: Library =
        Library { entries: &[entry::<DisturbanceTorque>(), entry::<MomentumPlant>()] };
    static GUIDANCE: Library = Library { entries: &[entry::<Guidance>()] };
    static ALL_TYPES: Library = Library { entries: &[entry::<AllTypes>()] };
    static EMPTY: Library = Library { entries: &[entry::<Empty>()] };
    match model {
        "MomentumPlant" => &MOMENTUM_PLANT,
        "SpinPlant" => &SPIN_PLANT,
        "DisturbanceTorque" => &DISTURBANCE_TORQUE,
        "Guidance" => &GUIDANCE,
        "AllTypes" => &ALL_TYPES,
        "Empty" => &EMPTY,
        other => panic!("no library of {other}"),
    }
}

/// An instance that serves input after input, with what the targets need to know of its model.
pub struct Subject {
    /// The instance, not yet reset.
    pub instance: InProcess,
    /// Value references of the Reals.
    pub reals: Vec<u32>,
    /// Value references of Integers and enumerations.
    pub integers: Vec<u32>,
    /// Value references of the Booleans.
    pub booleans: Vec<u32>,
    /// Value references of the Strings.
    pub strings: Vec<u32>,
    /// A saved state of a fresh instance.
    fresh: Vec<u8>,
}

impl Subject {
    fn new(model: &str) -> Self {
        let library = library(model);
        let description = library.find(model).unwrap().describe(None, None).unwrap();
        let mut instance = InProcess::from_library(library, model).unwrap();
        let names = Names::new(&description);
        let fresh = instance.state_bytes().1;
        Self {
            instance,
            reals: names.all(BaseType::Real).to_vec(),
            integers: names.all(BaseType::Integer).to_vec(),
            booleans: names.all(BaseType::Boolean).to_vec(),
            strings: names.all(BaseType::String).to_vec(),
            fresh,
        }
    }

    /// Runs `body` on the instance of the model that `choice` picks, reset.
    pub fn with<T>(choice: u8, body: impl FnOnce(&mut Self) -> T) -> T {
        thread_local! {
            static SUBJECTS: [RefCell<Option<Subject>>; MODELS.len()] = const { [const { RefCell::new(None) }; MODELS.len()] };
        }
        let number = usize::from(choice) % MODELS.len();
        SUBJECTS.with(|subjects| {
            let mut subject = subjects[number].borrow_mut();
            let subject = subject.get_or_insert_with(|| Self::new(MODELS[number]));
            assert_eq!(subject.instance.reset(), Status::Ok);
            let _ = subject.instance.drain_messages();
            body(subject)
        })
    }

    /// Every Real read under OK is finite; gives the status.
    pub fn read_reals(&mut self) -> Status {
        let mut values = vec![0.0; self.reals.len()];
        let status = self.instance.get_real(&self.reals, &mut values);
        if status == Status::Ok {
            for (reference, value) in self.reals.iter().zip(&values) {
                assert!(value.is_finite(), "Real {reference} is {value}");
            }
        }
        status
    }

    /// No message reports a panic, and an error has a message.
    pub fn check_messages(&self, status: Status) {
        let messages = self.instance.drain_messages();
        assert!(!messages.iter().any(|message| message.text.contains("panic")), "{messages:?}");
        assert_ne!(status, Status::Fatal, "{messages:?}");
        if status == Status::Error {
            assert!(messages.iter().any(|message| message.status == status), "an error without a message");
        }
    }

    /// `payload` behind this model's mark, version and digest, with a length and checksum that are right.
    pub fn seal(&self, payload: &[u8]) -> Vec<u8> {
        let mut sealed = self.fresh[..BEFORE_LENGTH].to_vec();
        sealed.extend_from_slice(&(payload.len() as u64).to_le_bytes());
        sealed.extend_from_slice(&checksum(payload).to_le_bytes());
        sealed.extend_from_slice(payload);
        sealed
    }
}

/// Offset of the payload length in a saved state: mark, layout version, GUID digest stand before it, the checksum and the payload after it.
const BEFORE_LENGTH: usize = 8 + 4 + 16;
/// Length of the header of a saved state, in bytes.
pub const HEADER: usize = BEFORE_LENGTH + 8 + 8;

/// FNV-1a, 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(14_695_981_039_346_656_037, |hash: u64, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(1_099_511_628_211)
    })
}
