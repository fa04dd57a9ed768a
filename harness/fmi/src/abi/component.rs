//! One instance at the C interface.

use std::{
    ffi::{CString, c_int, c_void},
    ptr,
    sync::Arc,
};

use model_description::call_table::Function;
use model_description::functions::{
    CO_SIMULATION, LAST_SUCCESSFUL_TIME, TERMINATED,
    types::{self, CallbackFunctions, CallbackLogger},
};

use super::{
    binary::{Binary, numbers},
    logger::{FixedLogger, MessageBuffer, log_message},
    states::{StateKey, States},
    text::text,
};
use crate::{LogMessage, Status, call_record, error::Outcome};

unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(pointer: *mut c_void);
}

/// How the callbacks are handed over; the default suits old FMUs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Callbacks {
    /// NULL for `allocateMemory` and `freeMemory`.
    pub null_memory: bool,
    /// The struct is overwritten with rubbish right after `fmi2Instantiate` (2.0.5 does not let the FMU read it afterwards).
    pub overwritten: bool,
}

/// Everything `fmi2Instantiate` takes.
pub(crate) struct Start<'a> {
    pub name: &'a str,
    pub guid: &'a str,
    pub resources: Option<&'a str>,
    pub logging: bool,
    pub callbacks: Callbacks,
}

/// The answer of a call: its status, or that the library lacks the function.
pub(crate) type Answer = Result<Status, Outcome>;

/// One instance. Dropping it frees its states and itself.
pub(crate) struct Component {
    binary: Arc<Binary>,
    handle: types::Component,
    buffer: Arc<MessageBuffer>,
    // Old FMUs read the callbacks from the caller's struct for the whole of their life.
    callbacks: *mut CallbackFunctions,
    states: States,
}

// SAFETY: an FMI instance may be used from any thread as long as it is from one at a time (2.1.3), which
// `&mut self` ensures; the message buffer is behind a mutex.
unsafe impl Send for Component {}

macro_rules! call {
    ($self:ident.$function:ident($($argument:expr),*)) => {
        match $self.binary.functions.$function {
            Some(function) => {
                let _under_way = call_record::enter(numbers::$function);
                // SAFETY: the handle is alive until drop and the arguments' lengths were checked by the caller.
                answered(unsafe { function($self.handle, $($argument),*) })
            }
            None => Err(Outcome::Missing),
        }
    };
}

/// Functions without arguments, and those that read and write numbers: values of variables, and derivatives of some order.
macro_rules! plain {
    (
        calls { $($name:ident $symbol:ident;)* }
        values { $($of_values:ident $values_symbol:ident($values:ty, $values_pointer:ident);)* }
        derivatives { $($of_derivatives:ident $derivatives_symbol:ident($derivatives:ty, $pointer:ident);)* }
    ) => {
        impl Component {
            $(
                pub(crate) fn $name(&mut self) -> Answer {
                    call!(self.$symbol())
                }
            )*
            $(
                pub(crate) fn $of_values(&mut self, references: &[u32], values: $values) -> Answer {
                    same_length(references.len(), values.len())?;
                    call!(self.$values_symbol(references.as_ptr(), references.len(), values.$values_pointer()))
                }
            )*
            $(
                pub(crate) fn $of_derivatives(
                    &mut self,
                    references: &[u32],
                    orders: &[i32],
                    values: $derivatives,
                ) -> Answer {
                    same_length(references.len(), orders.len())?;
                    same_length(references.len(), values.len())?;
                    let (first, count) = (references.as_ptr(), references.len());
                    call!(self.$derivatives_symbol(first, count, orders.as_ptr(), values.$pointer()))
                }
            )*
        }
    };
}

plain! {
    calls {
        enter_initialization_mode fmi2EnterInitializationMode;
        exit_initialization_mode fmi2ExitInitializationMode;
        terminate fmi2Terminate;
        reset fmi2Reset;
        cancel_step fmi2CancelStep;
    }
    values {
        get_real fmi2GetReal(&mut [f64], as_mut_ptr);
        get_integer fmi2GetInteger(&mut [i32], as_mut_ptr);
        get_boolean fmi2GetBoolean(&mut [i32], as_mut_ptr);
        set_real fmi2SetReal(&[f64], as_ptr);
        set_integer fmi2SetInteger(&[i32], as_ptr);
        set_boolean fmi2SetBoolean(&[i32], as_ptr);
    }
    derivatives {
        set_real_input_derivatives fmi2SetRealInputDerivatives(&[f64], as_ptr);
        get_real_output_derivatives fmi2GetRealOutputDerivatives(&mut [f64], as_mut_ptr);
    }
}

impl Component {
    /// `fmi2Instantiate`; a failure comes with what was logged.
    pub(crate) fn instantiate(
        binary: Arc<Binary>,
        start: &Start<'_>,
    ) -> Result<Self, (Outcome, Vec<LogMessage>)> {
        let c_text = |what, value| c_text(what, value).map_err(|outcome| (outcome, Vec::new()));
        let name = c_text("the instance name", start.name)?;
        let guid = c_text("the GUID", start.guid)?;
        let resources = start.resources.map(|uri| c_text("the resource location", uri)).transpose()?;
        let Some(function) = binary.functions.fmi2Instantiate else {
            return Err((Outcome::Missing, Vec::new()));
        };
        let buffer = Arc::new(MessageBuffer::default());
        let fixed: FixedLogger = log_message;
        let memory = !start.callbacks.null_memory;
        let callbacks = Box::into_raw(Box::new(CallbackFunctions {
            // SAFETY: both are function pointers of one size; see `log_message` for the arguments.
            logger: Some(unsafe { std::mem::transmute::<FixedLogger, CallbackLogger>(fixed) }),
            allocate_memory: memory.then_some(calloc as _),
            free_memory: memory.then_some(free as _),
            step_finished: None,
            component_environment: Arc::as_ptr(&buffer).cast_mut().cast(),
        }));
        let under_way = call_record::enter(numbers::fmi2Instantiate);
        // SAFETY: all texts and the struct are valid during the call; the buffer outlives the instance.
        let handle = unsafe {
            function(
                name.as_ptr(),
                CO_SIMULATION,
                guid.as_ptr(),
                resources.as_ref().map_or(ptr::null(), |uri| uri.as_ptr()),
                callbacks,
                0,
                c_int::from(start.logging),
            )
        };
        drop(under_way);
        if start.callbacks.overwritten {
            // SAFETY: the struct is ours; from here on nobody may read it as a struct, and we never do.
            unsafe { ptr::write_bytes(callbacks.cast::<u8>(), 0xA5, size_of::<CallbackFunctions>()) };
        }
        let component = Self { binary, handle, buffer, callbacks, states: States::new() };
        if handle.is_null() {
            let messages = component.messages();
            return Err((Outcome::NoInstance, messages));
        }
        Ok(component)
    }

    /// The messages so far, oldest first.
    pub(crate) fn messages(&self) -> Vec<LogMessage> {
        self.buffer.messages().iter().cloned().collect()
    }

    /// Takes the messages out.
    pub(crate) fn take_messages(&self) -> Vec<LogMessage> {
        self.buffer.messages().drain(..).collect()
    }

    pub(crate) fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Answer {
        let texts = c_texts(categories.iter().copied())?;
        let pointers: Vec<_> = texts.iter().map(|text| text.as_ptr()).collect();
        let list = if pointers.is_empty() { ptr::null() } else { pointers.as_ptr() };
        call!(self.fmi2SetDebugLogging(c_int::from(on), pointers.len(), list))
    }

    pub(crate) fn setup_experiment(
        &mut self,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Answer {
        let (has_tolerance, tolerance) = (c_int::from(tolerance.is_some()), tolerance.unwrap_or(0.0));
        let (has_stop, stop) = (c_int::from(stop.is_some()), stop.unwrap_or(0.0));
        call!(self.fmi2SetupExperiment(has_tolerance, tolerance, start, has_stop, stop))
    }

    pub(crate) fn do_step(&mut self, time: f64, step: f64, no_set_state_prior: bool) -> Answer {
        let Some(function) = self.binary.functions.fmi2DoStep else { return Err(Outcome::Missing) };
        let _under_way = call_record::enter_with(numbers::fmi2DoStep, [time, step]);
        // SAFETY: the handle is alive until drop.
        answered(unsafe { function(self.handle, time, step, c_int::from(no_set_state_prior)) })
    }

    /// The texts are copied at once: the FMU may reuse its memory at the next call.
    pub(crate) fn get_string(&mut self, references: &[u32], values: &mut Vec<String>) -> Answer {
        let mut pointers = vec![ptr::null(); references.len()];
        let answer = call!(self.fmi2GetString(references.as_ptr(), references.len(), pointers.as_mut_ptr()))?;
        if matches!(answer, Status::Ok | Status::Warning) {
            // SAFETY: on success every pointer is NULL or a text.
            values.extend(pointers.into_iter().map(|pointer| unsafe { text(pointer) }.unwrap_or_default()));
        }
        Ok(answer)
    }

    pub(crate) fn set_string(&mut self, references: &[u32], values: &[&str]) -> Answer {
        same_length(references.len(), values.len())?;
        let texts = c_texts(values.iter().copied())?;
        let pointers: Vec<_> = texts.iter().map(|text| text.as_ptr()).collect();
        call!(self.fmi2SetString(references.as_ptr(), references.len(), pointers.as_ptr()))
    }

    pub(crate) fn get_directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        result: &mut [f64],
    ) -> Answer {
        same_length(knowns.len(), seed.len())?;
        same_length(unknowns.len(), result.len())?;
        call!(self.fmi2GetDirectionalDerivative(
            unknowns.as_ptr(),
            unknowns.len(),
            knowns.as_ptr(),
            knowns.len(),
            seed.as_ptr(),
            result.as_mut_ptr()
        ))
    }

    /// `fmi2GetRealStatus` of `fmi2LastSuccessfulTime`.
    pub(crate) fn last_successful_time(&mut self) -> Result<(Status, f64), Outcome> {
        let mut value = f64::NAN;
        let status = call!(self.fmi2GetRealStatus(LAST_SUCCESSFUL_TIME, &raw mut value))?;
        Ok((status, value))
    }

    /// `fmi2GetBooleanStatus` of `fmi2Terminated`.
    pub(crate) fn terminated(&mut self) -> Result<(Status, bool), Outcome> {
        let mut value = 0;
        let status = call!(self.fmi2GetBooleanStatus(TERMINATED, &raw mut value))?;
        Ok((status, value != 0))
    }

    /// The remaining status functions, for probing.
    pub(crate) fn get_other_status(&mut self, function: Function, kind: i32) -> Answer {
        let mut number = 0;
        let mut pointer = ptr::null();
        match function {
            Function::GetStatus => call!(self.fmi2GetStatus(kind, &raw mut number)),
            Function::GetIntegerStatus => call!(self.fmi2GetIntegerStatus(kind, &raw mut number)),
            _ => call!(self.fmi2GetStringStatus(kind, &raw mut pointer)),
        }
    }

    /// `fmi2GetFMUstate` into a new state.
    pub(crate) fn get_state(&mut self) -> Result<(Status, Option<StateKey>), Outcome> {
        let mut state = ptr::null_mut();
        let status = call!(self.fmi2GetFMUstate(&raw mut state))?;
        Ok((status, self.states.keep(state)))
    }

    pub(crate) fn set_state(&mut self, key: StateKey) -> Answer {
        let state = self.states.get(key)?;
        call!(self.fmi2SetFMUstate(state))
    }

    pub(crate) fn free_state(&mut self, key: StateKey) -> Answer {
        let mut state = self.states.take(key)?;
        call!(self.fmi2FreeFMUstate(&raw mut state))
    }

    pub(crate) fn serialize_state(&mut self, key: StateKey, bytes: &mut Vec<u8>) -> Answer {
        let state = self.states.get(key)?;
        let mut size = 0;
        let status = call!(self.fmi2SerializedFMUstateSize(state, &raw mut size))?;
        if !matches!(status, Status::Ok | Status::Warning) {
            return Ok(status);
        }
        bytes.clear();
        bytes.resize(size, 0);
        call!(self.fmi2SerializeFMUstate(state, bytes.as_mut_ptr().cast(), size))
    }

    pub(crate) fn deserialize_state(&mut self, bytes: &[u8]) -> Result<(Status, Option<StateKey>), Outcome> {
        let mut state = ptr::null_mut();
        let status = call!(self.fmi2DeSerializeFMUstate(bytes.as_ptr().cast(), bytes.len(), &raw mut state))?;
        Ok((status, self.states.keep(state)))
    }

    /// Zero-length vectors as NULL, NULL states to free, a NULL list of categories: all legal, all tempting to
    /// get wrong. Gives the name and answer of each call.
    pub(crate) fn probe_nulls(&mut self) -> Vec<(&'static str, Answer)> {
        let (references, none) = (ptr::null::<u32>(), ptr::null_mut());
        let mut no_state: *mut c_void = none;
        vec![
            ("fmi2GetReal", call!(self.fmi2GetReal(references, 0, ptr::null_mut()))),
            ("fmi2GetInteger", call!(self.fmi2GetInteger(references, 0, ptr::null_mut()))),
            ("fmi2GetBoolean", call!(self.fmi2GetBoolean(references, 0, ptr::null_mut()))),
            ("fmi2GetString", call!(self.fmi2GetString(references, 0, ptr::null_mut()))),
            ("fmi2SetReal", call!(self.fmi2SetReal(references, 0, ptr::null()))),
            ("fmi2SetInteger", call!(self.fmi2SetInteger(references, 0, ptr::null()))),
            ("fmi2SetBoolean", call!(self.fmi2SetBoolean(references, 0, ptr::null()))),
            ("fmi2SetString", call!(self.fmi2SetString(references, 0, ptr::null()))),
            ("fmi2SetDebugLogging", call!(self.fmi2SetDebugLogging(1, 0, ptr::null()))),
            ("fmi2FreeFMUstate", call!(self.fmi2FreeFMUstate(&raw mut no_state))),
        ]
    }

    /// `fmi2FreeFMUstate` without a place for the state, which many FMUs do not survive.
    pub(crate) fn free_no_state(&mut self) -> Answer {
        call!(self.fmi2FreeFMUstate(ptr::null_mut()))
    }

    /// `fmi2FreeInstance(NULL)`, a no-op by the standard.
    pub(crate) fn free_nothing(&self) {
        // SAFETY: NULL is allowed.
        unsafe { self.free_instance(ptr::null_mut()) };
    }

    /// `fmi2FreeInstance`.
    ///
    /// # Safety
    /// The handle is NULL, or an instance that is never used again.
    unsafe fn free_instance(&self, handle: types::Component) {
        if let Some(function) = self.binary.functions.fmi2FreeInstance {
            let _under_way = call_record::enter(numbers::fmi2FreeInstance);
            // SAFETY: the caller's promise.
            unsafe { function(handle) };
        }
    }
}

impl Drop for Component {
    fn drop(&mut self) {
        if !self.handle.is_null() {
            for mut state in self.states.held() {
                let _ = call!(self.fmi2FreeFMUstate(&raw mut state));
            }
            // SAFETY: the handle is alive and never used again.
            unsafe { self.free_instance(self.handle) };
        }
        // SAFETY: made by Box::into_raw, and its fields have no destructors.
        drop(unsafe { Box::from_raw(self.callbacks.cast::<std::mem::MaybeUninit<CallbackFunctions>>()) });
    }
}

fn answered(code: c_int) -> Answer {
    let status = Status::from_code(code);
    call_record::log_status(status);
    status.ok_or(Outcome::UnknownStatus(code))
}

fn same_length(references: usize, values: usize) -> Result<(), Outcome> {
    if references == values {
        return Ok(());
    }
    Err(Outcome::BadArguments(format!("{references} value references but {values} values")))
}

fn c_text(what: &str, value: &str) -> Result<CString, Outcome> {
    CString::new(value).map_err(|_| Outcome::BadArguments(format!("{what} contains a zero byte")))
}

fn c_texts<'a>(texts: impl Iterator<Item = &'a str>) -> Result<Vec<CString>, Outcome> {
    texts.map(|text| c_text(&format!("the text {text:?}"), text)).collect()
}
