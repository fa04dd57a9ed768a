//! A safe client of the C functions within one process.
//!
//! It calls what an importer calls, pointers and all, but needs no shared library; an allocator of the test's
//! own therefore sees what the functions allocate.
#![allow(unsafe_code, reason = "calls the C functions")]

use core::ffi::{CStr, c_char, c_int, c_void};
use std::cell::RefCell;
use std::ffi::CString;
use std::sync::{Mutex, PoisonError};

use fmi_export::{Library, fmi2 as c};
use model_description::Status;
use model_description::functions::{
    CO_SIMULATION, LAST_SUCCESSFUL_TIME, TERMINATED,
    types::{CallbackFunctions, CallbackLogger, Component, FmuState},
};

/// A message that reached the logger.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Status it came with.
    pub status: Status,
    /// Log category.
    pub category: String,
    /// The text, with `%%` and `##` as they were sent.
    pub text: String,
}

type Messages = Mutex<Vec<Message>>;

/// One instance, driven through the C functions; freed when dropped.
#[derive(Debug)]
pub struct InProcess {
    component: Component,
    messages: Box<Messages>,
}

// SAFETY: an instance may move between threads as long as one of them uses it at a time, which `&mut self`
// ensures.
unsafe impl Send for InProcess {}

/// A `fmi2FMUstate`; NULL until one is taken. Once dropped, the next instance that is dropped in the same thread frees it.
#[derive(Debug)]
pub struct StatePointer(FmuState);

// SAFETY: a saved state belongs to no thread.
unsafe impl Send for StatePointer {}

thread_local! {
    /// States to be freed: only an instance can free them, and any instance can. Of this thread alone, so that none frees what
    /// another thread allocated.
    static DROPPED: RefCell<Vec<StatePointer>> = const { RefCell::new(Vec::new()) };
}

/// States of threads that ended before an instance freed them.
static LEFT: Mutex<Vec<StatePointer>> = Mutex::new(Vec::new());

impl StatePointer {
    /// NULL.
    pub const fn null() -> Self {
        Self(core::ptr::null_mut())
    }

    /// Whether it is NULL.
    pub fn is_null(&self) -> bool {
        self.0.is_null()
    }
}

impl Drop for StatePointer {
    fn drop(&mut self) {
        if !self.0.is_null() {
            let pointer = core::mem::replace(&mut self.0, core::ptr::null_mut());
            if DROPPED.try_with(|dropped| dropped.borrow_mut().push(Self(pointer))).is_err() {
                LEFT.lock().unwrap_or_else(PoisonError::into_inner).push(Self(pointer));
            }
        }
    }
}

/// The five-argument receiver behind the variadic type. Stable Rust cannot define a variadic function; on
/// every ABI the library is built for, fixed arguments travel alike, and no others are sent.
unsafe extern "C" fn receive(
    environment: *mut c_void,
    _instance_name: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment is the mutex of the `InProcess` that made the instance; texts are valid during the call.
    let (messages, category, message) =
        unsafe { (&*environment.cast::<Messages>(), CStr::from_ptr(category), CStr::from_ptr(message)) };
    if let (Ok(mut messages), Some(status)) = (messages.lock(), Status::from_code(status)) {
        let text = |c: &CStr| c.to_string_lossy().into_owned();
        messages.push(Message { status, category: text(category), text: text(message) });
    }
}

fn status(code: c_int) -> Status {
    Status::from_code(code).unwrap_or(Status::Fatal)
}

impl InProcess {
    /// `fmi2Instantiate` with logging on; `resource_location` is NULL if `None`. The error is what was logged.
    pub fn instantiate(
        library: &'static Library,
        guid: &str,
        resource_location: Option<&str>,
    ) -> Result<Self, Vec<Message>> {
        let messages = Box::<Messages>::default();
        // SAFETY: see `receive`.
        let logger = unsafe {
            core::mem::transmute::<
                unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char),
                CallbackLogger,
            >(receive)
        };
        let functions = CallbackFunctions {
            logger: Some(logger),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: (&raw const *messages).cast_mut().cast(),
        };
        let guid = CString::new(guid).unwrap_or_default();
        let location = resource_location.map(|location| CString::new(location).unwrap_or_default());
        // SAFETY: all pointers are valid during the call, the messages as long as the instance.
        let component = unsafe {
            c::instantiate(
                library,
                c"in process".as_ptr(),
                CO_SIMULATION,
                guid.as_ptr(),
                location.as_deref().map_or(core::ptr::null(), CStr::as_ptr),
                &raw const functions,
                0,
                1,
            )
        };
        let client = Self { component, messages };
        if component.is_null() { Err(client.drain_messages()) } else { Ok(client) }
    }

    /// The model `name` with its compiled-in setup, instantiated; the error is what was logged.
    pub fn from_library(library: &'static Library, name: &str) -> Result<Self, Vec<Message>> {
        let described = library.find(name).map(|entry| library.describe(entry, None, None));
        let guid = match described {
            Some(Ok(description)) => description.guid,
            Some(Err(error)) => return Err(vec![error_message(error.to_string())]),
            None => return Err(vec![error_message(format!("no model `{name}`, but {}", library.names()))]),
        };
        Self::instantiate(library, &guid, None)
    }

    /// Returns the messages logged since the last call.
    pub fn drain_messages(&self) -> Vec<Message> {
        self.messages.lock().map(|mut messages| core::mem::take(&mut *messages)).unwrap_or_default()
    }

    /// Brings a fresh instance to the first communication point.
    pub fn start(&mut self, start_s: f64, stop_s: Option<f64>) -> Status {
        [Self::enter_initialization_mode, Self::exit_initialization_mode]
            .into_iter()
            .fold(self.setup_experiment(start_s, stop_s), |worst, call| worst.max(call(self)))
    }

    /// `fmi2SetDebugLogging`.
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&CStr]) -> Status {
        let categories: Vec<_> = categories.iter().map(|category| category.as_ptr()).collect();
        // SAFETY: a live instance, and an array of its length.
        status(unsafe {
            c::fmi2SetDebugLogging(self.component, c_int::from(on), categories.len(), categories.as_ptr())
        })
    }

    /// `fmi2SetupExperiment` without a tolerance.
    pub fn setup_experiment(&mut self, start_s: f64, stop_s: Option<f64>) -> Status {
        self.setup(None, start_s, stop_s)
    }

    /// `fmi2SetupExperiment` with a tolerance.
    pub fn setup_experiment_with_tolerance(&mut self, tolerance: f64, start_s: f64) -> Status {
        self.setup(Some(tolerance), start_s, None)
    }

    fn setup(&mut self, tolerance: Option<f64>, start_s: f64, stop_s: Option<f64>) -> Status {
        let [has_tolerance, has_stop] = [tolerance, stop_s].map(|it| c_int::from(it.is_some()));
        let [tolerance, stop_s] = [tolerance, stop_s].map(Option::unwrap_or_default);
        // SAFETY: a live instance.
        status(unsafe {
            c::fmi2SetupExperiment(self.component, has_tolerance, tolerance, start_s, has_stop, stop_s)
        })
    }

    /// `fmi2DoStep`.
    pub fn do_step(&mut self, point_s: f64, step_size_s: f64) -> Status {
        // SAFETY: a live instance.
        status(unsafe { c::fmi2DoStep(self.component, point_s, step_size_s, 0) })
    }

    /// `fmi2DoStep` with `noSetFMUStatePriorToCurrentPoint`.
    pub fn do_step_without_return(&mut self, point_s: f64, step_size_s: f64) -> Status {
        // SAFETY: a live instance.
        status(unsafe { c::fmi2DoStep(self.component, point_s, step_size_s, 1) })
    }

    /// `fmi2GetString`.
    pub fn get_string(&mut self, references: &[u32]) -> (Status, Vec<String>) {
        let mut pointers = vec![core::ptr::null(); references.len()];
        // SAFETY: a live instance, and arrays of their length.
        let code = unsafe {
            c::fmi2GetString(self.component, references.as_ptr(), references.len(), pointers.as_mut_ptr())
        };
        let text = |&pointer: &*const c_char| match pointer.is_null() {
            true => String::new(),
            // SAFETY: lent by the instance until its next call.
            false => unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned(),
        };
        (status(code), pointers.iter().map(text).collect())
    }

    /// `fmi2SetString`; text after a NUL is cut off, as C does.
    pub fn set_string(&mut self, references: &[u32], values: &[&[u8]]) -> Status {
        let texts: Vec<Vec<u8>> = values.iter().map(|value| [value, b"\0".as_slice()].concat()).collect();
        let pointers: Vec<*const c_char> = texts.iter().map(|text| text.as_ptr().cast()).collect();
        let count = references.len().min(pointers.len());
        // SAFETY: a live instance, and arrays of at least `count` terminated texts.
        status(unsafe { c::fmi2SetString(self.component, references.as_ptr(), count, pointers.as_ptr()) })
    }

    /// `fmi2GetFMUstate`; reuses the memory of a state that is not NULL.
    pub fn get_state(&mut self, state: &mut StatePointer) -> Status {
        // SAFETY: a live instance, and NULL or a live state.
        status(unsafe { c::fmi2GetFMUstate(self.component, &raw mut state.0) })
    }

    /// `fmi2SetFMUstate`.
    pub fn set_state(&mut self, state: &StatePointer) -> Status {
        // SAFETY: a live instance, and NULL or a live state.
        status(unsafe { c::fmi2SetFMUstate(self.component, state.0) })
    }

    /// `fmi2FreeFMUstate`.
    pub fn free_state(&mut self, state: &mut StatePointer) -> Status {
        // SAFETY: a live instance, and NULL or a live state.
        status(unsafe { c::fmi2FreeFMUstate(self.component, &raw mut state.0) })
    }

    /// `fmi2SerializedFMUstateSize`, then `fmi2SerializeFMUstate` with that many bytes.
    pub fn serialize(&mut self, state: &StatePointer) -> (Status, Vec<u8>) {
        let mut size = 0;
        // SAFETY: a live instance, and NULL or a live state.
        let sized = status(unsafe { c::fmi2SerializedFMUstateSize(self.component, state.0, &raw mut size) });
        if sized != Status::Ok {
            return (sized, Vec::new());
        }
        let mut bytes = vec![0; size];
        (self.serialize_into(state, &mut bytes), bytes)
    }

    /// `fmi2SerializeFMUstate`.
    pub fn serialize_into(&mut self, state: &StatePointer, bytes: &mut [u8]) -> Status {
        // SAFETY: a live instance, NULL or a live state, and an array of its length.
        status(unsafe {
            c::fmi2SerializeFMUstate(self.component, state.0, bytes.as_mut_ptr().cast(), bytes.len())
        })
    }

    /// `fmi2DeSerializeFMUstate`.
    pub fn deserialize(&mut self, bytes: &[u8]) -> (Status, StatePointer) {
        let mut state = StatePointer::null();
        // SAFETY: a live instance, and an array of its length.
        let code = unsafe {
            c::fmi2DeSerializeFMUstate(self.component, bytes.as_ptr().cast(), bytes.len(), &raw mut state.0)
        };
        (status(code), state)
    }

    /// The bytes of the state now: `fmi2GetFMUstate` and `fmi2SerializeFMUstate`.
    pub fn state_bytes(&mut self) -> (Status, Vec<u8>) {
        let mut state = StatePointer::null();
        match self.get_state(&mut state) {
            Status::Ok => self.serialize(&state),
            refused => (refused, Vec::new()),
        }
    }

    /// `fmi2SetRealInputDerivatives`.
    pub fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Status {
        let count = references.len().min(orders.len()).min(values.len());
        // SAFETY: a live instance, and arrays of at least `count` elements.
        status(unsafe {
            let (references, orders) = (references.as_ptr(), orders.as_ptr());
            c::fmi2SetRealInputDerivatives(self.component, references, count, orders, values.as_ptr())
        })
    }

    /// `fmi2GetRealOutputDerivatives`.
    pub fn get_output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Status {
        let count = references.len().min(orders.len()).min(values.len());
        // SAFETY: a live instance, and arrays of at least `count` elements.
        status(unsafe {
            let (references, orders) = (references.as_ptr(), orders.as_ptr());
            c::fmi2GetRealOutputDerivatives(self.component, references, count, orders, values.as_mut_ptr())
        })
    }

    /// `fmi2GetDirectionalDerivative`.
    pub fn get_directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        result: &mut [f64],
    ) -> Status {
        let (rows, columns) = (unknowns.len().min(result.len()), knowns.len().min(seed.len()));
        let (unknowns, knowns) = (unknowns.as_ptr(), knowns.as_ptr());
        let (seed, result) = (seed.as_ptr(), result.as_mut_ptr());
        // SAFETY: a live instance, and arrays of at least the announced lengths.
        status(unsafe {
            c::fmi2GetDirectionalDerivative(self.component, unknowns, rows, knowns, columns, seed, result)
        })
    }

    /// `fmi2GetRealStatus` of `fmi2LastSuccessfulTime`.
    pub fn last_successful_time(&mut self) -> (Status, f64) {
        let mut value = f64::NAN;
        // SAFETY: a live instance.
        let code = unsafe { c::fmi2GetRealStatus(self.component, LAST_SUCCESSFUL_TIME, &raw mut value) };
        (status(code), value)
    }

    /// `fmi2GetBooleanStatus` of `fmi2Terminated`.
    pub fn terminated(&mut self) -> (Status, bool) {
        let mut value = 0;
        // SAFETY: a live instance.
        let code = unsafe { c::fmi2GetBooleanStatus(self.component, TERMINATED, &raw mut value) };
        (status(code), value == 1)
    }
}

macro_rules! simple {
    ($($name:ident, $symbol:ident $(of $kind:ident into $value:expr)?;)*) => {
        impl InProcess { $(
            #[doc = concat!("`", stringify!($symbol), "`.")]
            pub fn $name(&mut self $(, $kind: i32)?) -> Status {
                $(let mut value = $value;)?
                // SAFETY: a live instance, and a place for the value.
                status(unsafe { c::$symbol(self.component $(, $kind, &raw mut value)?) })
            }
        )* }
    };
}

simple! {
    enter_initialization_mode, fmi2EnterInitializationMode;
    exit_initialization_mode, fmi2ExitInitializationMode;
    terminate, fmi2Terminate;
    reset, fmi2Reset;
    cancel_step, fmi2CancelStep;
    get_status, fmi2GetStatus of kind into 0;
    get_integer_status, fmi2GetIntegerStatus of kind into 0;
    get_string_status, fmi2GetStringStatus of kind into core::ptr::null();
}

macro_rules! access {
    ($($get:ident, $set:ident, $get_symbol:ident, $set_symbol:ident, $type:ty;)*) => {
        impl InProcess { $(
            #[doc = concat!("`", stringify!($get_symbol), "`.")]
            pub fn $get(&mut self, references: &[u32], values: &mut [$type]) -> Status {
                let count = references.len().min(values.len());
                // SAFETY: a live instance, and arrays of at least `count` elements.
                status(unsafe { c::$get_symbol(self.component, references.as_ptr(), count, values.as_mut_ptr()) })
            }

            #[doc = concat!("`", stringify!($set_symbol), "`.")]
            pub fn $set(&mut self, references: &[u32], values: &[$type]) -> Status {
                let count = references.len().min(values.len());
                // SAFETY: a live instance, and arrays of at least `count` elements.
                status(unsafe { c::$set_symbol(self.component, references.as_ptr(), count, values.as_ptr()) })
            }
        )* }
    };
}

access! {
    get_real, set_real, fmi2GetReal, fmi2SetReal, f64;
    get_integer, set_integer, fmi2GetInteger, fmi2SetInteger, i32;
    get_boolean, set_boolean, fmi2GetBoolean, fmi2SetBoolean, i32;
}

impl Drop for InProcess {
    fn drop(&mut self) {
        if !self.component.is_null() {
            let dropped = DROPPED.try_with(RefCell::take).unwrap_or_default();
            for mut state in dropped {
                self.free_state(&mut state);
            }
        }
        // SAFETY: NULL or a live instance, not used again.
        unsafe { c::fmi2FreeInstance(self.component) }
    }
}

fn error_message(text: String) -> Message {
    Message { status: Status::Error, category: "logStatusError".to_owned(), text }
}
