//! The C functions, each with its symbol, its contract and its body.
//!
//! The contract of all: `c` is NULL or a live instance that no other thread uses meanwhile; an array has the announced
//! length, a string ends with NUL, and both stay the caller's and need to be valid during the call only, unless a
//! function says otherwise. Nothing the caller gives is kept. The signatures are held against
//! [`model_description::functions::types`].
#![allow(non_snake_case, reason = "the standard's names")]
#![allow(
    clippy::missing_safety_doc,
    reason = "one contract for all, stated above, and more at each function"
)]

use core::ffi::{CStr, c_char, c_int};

use model_description::Status;
use model_description::call_table::Function;
use model_description::functions::{
    CO_SIMULATION, LAST_SUCCESSFUL_TIME, TERMINATED,
    types::{self, CallbackFunctions, Component, FmuState},
};

use super::arguments::{flag, null, place, slice, slice_mut, text};
use super::boundary::{self, ImporterLogger, call, saved, state_handle_of};
use super::instance::Instance;
use super::instance::state::Experiment;
use super::problem::Problem;
use crate::library::Library;
use crate::logger::{Category, Logger};
use crate::panics::contain;

/// Declares C functions: documentation, name in the call table, symbol, arguments after the instance, and the body, which
/// runs inside the panic boundary with the instance in `$inner`. Pointers are followed in the body only.
macro_rules! functions {
    ($(
        $(#[$doc:meta])*
        $function:ident $symbol:ident($inner:ident $(, $argument:ident: $type:ty)* $(,)?) $body:block
    )*) => { $(
        $(#[$doc])*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $symbol(c: Component $(, $argument: $type)*) -> c_int {
            // SAFETY: the module's contract, for the instance and for every pointer in the body.
            unsafe { call(c, Function::$function, |$inner| $body) }
        }

        const _: types::$symbol = $symbol;
    )* };
}

/// `"default"`. The text is the library's and valid as long as the library is loaded.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

const _: types::fmi2GetTypesPlatform = fmi2GetTypesPlatform;

/// `"2.0"`. The text is the library's and valid as long as the library is loaded.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

const _: types::fmi2GetVersion = fmi2GetVersion;

/// The body of `fmi2Instantiate`, over the models of a library.
///
/// The instance is the caller's, to be given back by `fmi2FreeInstance`; NULL where there is none, with the reason in the
/// log. `functions` is copied and may go when this returns; the logger and the environment in it are used until the
/// instance is freed. `allocateInstanceState` and `freeInstanceState` are never called. `resource_location` may be NULL or empty: then the
/// compiled-in setup is used.
#[allow(clippy::too_many_arguments, reason = "the standard's signature")]
pub unsafe fn instantiate(
    library: &Library,
    instance_name: *const c_char,
    fmu_type: c_int,
    guid: *const c_char,
    resource_location: *const c_char,
    functions: *const CallbackFunctions,
    visible: c_int,
    logging_on: c_int,
) -> Component {
    // SAFETY: the module's contract. The struct is copied: the caller may reuse its memory after this call.
    let Some(functions) = (unsafe { functions.as_ref() }).copied() else { return core::ptr::null_mut() };
    let Some(logger) = functions.logger else { return core::ptr::null_mut() };
    let environment = functions.component_environment;
    let log = |status: Status, message: core::fmt::Arguments<'_>| {
        // SAFETY: the module's contract.
        let name = unsafe { text(instance_name, "instanceName") }.unwrap_or(c"");
        let _ = contain(|| {
            Logger::new(Box::new(ImporterLogger { logger, environment }), name, false).log(status, message)
        });
    };
    let made = contain(|| {
        // SAFETY: the module's contract.
        let (name, guid) = unsafe { (text(instance_name, "instanceName"), text(guid, "fmuGUID")) };
        let (name, guid) = (explained(name)?, explained(guid)?);
        if name.to_bytes().iter().all(u8::is_ascii_whitespace) {
            return Err("argument instanceName is empty; it must name the instance".to_owned());
        }
        match fmu_type {
            CO_SIMULATION => {}
            0 => return Err("this FMU is for co-simulation, not for model exchange".to_owned()),
            other => return Err(format!("argument fmuType is {other}, allowed is 1 (fmi2CoSimulation)")),
        }
        explained(flag(visible, "visible"))?;
        let logging_on = explained(flag(logging_on, "loggingOn"))?;
        // SAFETY: the module's contract.
        let location = unsafe { text(resource_location, "fmuResourceLocation") }.unwrap_or(c"");
        let prepared = library.select(&guid.to_string_lossy(), location.to_bytes())?;
        let sink = Box::new(ImporterLogger { logger, environment });
        Ok(boundary::handle_of(Instance::new(prepared, Logger::new(sink, name, logging_on))))
    });
    match made {
        Ok(Ok(component)) => return component,
        Ok(Err(problem)) => log(Status::Error, format_args!("fmi2Instantiate: {problem}")),
        Err(panic) => log(Status::Error, format_args!("fmi2Instantiate: panic: {panic}")),
    }
    core::ptr::null_mut()
}

fn explained<T>(result: Result<T, Problem>) -> Result<T, String> {
    result.map_err(|problem| problem.text)
}

/// Frees an instance and the strings that `fmi2GetString` gave; NULL is no error. The instance is not used again; its saved states
/// should be freed before, and can be freed through another instance of this library after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: Component) {
    // SAFETY: the module's contract.
    unsafe { boundary::free(c) }
}

const _: types::fmi2FreeInstance = fmi2FreeInstance;

functions! {
    /// Switches log categories on or off; none named means all of them. Errors are logged always.
    SetDebugLogging fmi2SetDebugLogging(inner, logging_on: c_int, count: usize, categories: *const *const c_char) {
        let on = flag(logging_on, "loggingOn")?;
        let categories = slice(categories, count, "categories")?;
        if categories.iter().any(|category| category.is_null()) {
            return Err(null("categories"));
        }
        let named = |index: usize| Category::from_name(CStr::from_ptr(categories[index]));
        inner.instance.set_debug_logging(on, categories.len(), named)
    }
    /// Start and stop time in s, and a tolerance that the model may take as its own.
    SetupExperiment fmi2SetupExperiment(
        inner, tolerance_defined: c_int, tolerance: f64, start_time: f64, stop_time_defined: c_int, stop_time: f64,
    ) {
        let tolerance = flag(tolerance_defined, "toleranceDefined")?.then_some(tolerance);
        let stop_s = flag(stop_time_defined, "stopTimeDefined")?.then_some(stop_time);
        inner.instance.setup_experiment(Experiment { start_s: start_time, stop_s, tolerance })
    }
    /// Begins Initialization Mode at the start time.
    EnterInitializationMode fmi2EnterInitializationMode(inner) {
        inner.instance.enter_initialization_mode()
    }
    /// Ends Initialization Mode: initializes the model with what was set.
    ExitInitializationMode fmi2ExitInitializationMode(inner) {
        inner.instance.exit_initialization_mode()
    }
    /// Ends the simulation; values can be read further.
    Terminate fmi2Terminate(_inner) {
        Ok(())
    }
    /// Back to the state after `fmi2Instantiate`. Saved states stay valid.
    Reset fmi2Reset(inner) {
        inner.instance.reset();
        Ok(())
    }
    /// Copies the values of Reals into `value`.
    GetReal fmi2GetReal(inner, references: *const u32, count: usize, values: *mut f64) {
        let values = slice_mut(values, count, "value")?;
        inner.instance.get_real(slice(references, count, "vr")?, values, |_, stored| *stored)
    }
    /// Copies the values of Integers and Enumerations into `value`.
    GetInteger fmi2GetInteger(inner, references: *const u32, count: usize, values: *mut c_int) {
        let values = slice_mut(values, count, "value")?;
        inner.instance.get_integer(slice(references, count, "vr")?, values, |_, stored| *stored)
    }
    /// Copies the values of Booleans into `value`, 0 or 1.
    GetBoolean fmi2GetBoolean(inner, references: *const u32, count: usize, values: *mut c_int) {
        let values = slice_mut(values, count, "value")?;
        inner.instance.get_boolean(slice(references, count, "vr")?, values, |_, stored| c_int::from(*stored))
    }
    /// Points the elements of `value` to texts in UTF-8. They are the instance's: each is valid until the same variable is read
    /// again with another value or the instance is freed.
    GetString fmi2GetString(inner, references: *const u32, count: usize, values: *mut *const c_char) {
        let values = slice_mut(values, count, "value")?;
        let strings = &mut inner.strings;
        let references = slice(references, count, "vr")?;
        inner.instance.get_string(references, values, |index, stored| strings.hold(index, stored))
    }
    /// Sets Reals: all of them, or none where one is refused.
    SetReal fmi2SetReal(inner, references: *const u32, count: usize, values: *const f64) {
        inner.instance.set_real(slice(references, count, "vr")?, slice(values, count, "value")?)
    }
    /// Sets Integers and Enumerations: all of them, or none where one is refused.
    SetInteger fmi2SetInteger(inner, references: *const u32, count: usize, values: *const c_int) {
        inner.instance.set_integer(slice(references, count, "vr")?, slice(values, count, "value")?)
    }
    /// Sets Booleans, 0 or 1: all of them, or none where one is refused.
    SetBoolean fmi2SetBoolean(inner, references: *const u32, count: usize, values: *const c_int) {
        inner.instance.set_boolean(slice(references, count, "vr")?, slice(values, count, "value")?)
    }
    /// Sets Strings, UTF-8, from copies of the texts: all of them, or none where one is refused.
    SetString fmi2SetString(inner, references: *const u32, count: usize, values: *const *const c_char) {
        let texts = slice(values, count, "value")?;
        let texts = texts.iter().map(|&pointer| text(pointer, "value").map(|text| text.to_str().ok()));
        let texts = texts.collect::<Result<Vec<_>, Problem>>()?;
        inner.instance.set_string(slice(references, count, "vr")?, &texts)
    }
    /// Saves the state. With `*state` NULL it makes a new one, which is the caller's until `fmi2FreeFMUstate`; otherwise it
    /// overwrites that state of this library and needs no new memory for values.
    GetFmuState fmi2GetFMUstate(inner, state: *mut FmuState) {
        let state = place(state, "FMUstate")?;
        let reuse = if state.is_null() { None } else { Some(saved(*state)?) };
        if let Some(new) = inner.instance.save(reuse)? {
            *state = state_handle_of(new);
        }
        Ok(())
    }
    /// Takes over a saved state of this model with this setup; the state stays the caller's and can be used again.
    SetFmuState fmi2SetFMUstate(inner, state: FmuState) {
        inner.instance.restore(saved(state)?)
    }
    /// Frees a saved state and writes NULL to `*state`; NULL, and a pointer to NULL, are no errors.
    FreeFmuState fmi2FreeFMUstate(_inner, state: *mut FmuState) {
        match state.as_mut() {
            Some(state) if !state.is_null() => {
                saved(*state)?;
                // NULL before the drop, which may panic: it must not be freed twice.
                boundary::free_state(core::mem::replace(state, core::ptr::null_mut()))
            }
            _ => Ok(()),
        }
    }
    /// Writes to `*size` how many bytes `fmi2SerializeFMUstate` needs for the state.
    SerializedFmuStateSize fmi2SerializedFMUstateSize(inner, state: FmuState, size: *mut usize) {
        let size = place(size, "size")?;
        *size = inner.instance.serialized_size(saved(state)?)?;
        Ok(())
    }
    /// Writes a saved state into the caller's `bytes`; what lies beyond its size is left as it was. The state stays the
    /// caller's.
    SerializeFmuState fmi2SerializeFMUstate(inner, state: FmuState, bytes: *mut c_char, size: usize) {
        let bytes = slice_mut(bytes.cast::<u8>(), size, "serializedState")?;
        inner.instance.serialize(saved(state)?, bytes)
    }
    /// Makes a new state from bytes of any instance of this model with this setup, in whatever process; it is the caller's
    /// until `fmi2FreeFMUstate`. Whatever the bytes, the answer is a state or an error.
    DeSerializeFmuState fmi2DeSerializeFMUstate(inner, bytes: *const c_char, size: usize, state: *mut FmuState) {
        let state = place(state, "FMUstate")?;
        let bytes = slice(bytes.cast::<u8>(), size, "serializedState")?;
        // Always a new state: the standard gives the pointer no meaning before the call.
        *state = state_handle_of(inner.instance.deserialize(bytes)?);
        Ok(())
    }
    /// Writes the Jacobian d(unknowns)/d(knowns) times `seed` into `result`, as long as `unknowns`.
    GetDirectionalDerivative fmi2GetDirectionalDerivative(
        inner, unknowns: *const u32, unknown_count: usize, knowns: *const u32, known_count: usize,
        seed: *const f64, result: *mut f64,
    ) {
        let unknowns = slice(unknowns, unknown_count, "vUnknown_ref")?;
        let knowns = slice(knowns, known_count, "vKnown_ref")?;
        let seed = slice(seed, known_count, "dvKnown")?;
        let result = slice_mut(result, unknown_count, "dvUnknown")?;
        inner.instance.get_directional_derivative(unknowns, knowns, seed, result)
    }
    /// Derivatives of inputs with respect to time, for the next step only.
    SetRealInputDerivatives fmi2SetRealInputDerivatives(
        inner, references: *const u32, count: usize, orders: *const c_int, values: *const f64,
    ) {
        let references = slice(references, count, "vr")?;
        let orders = slice(orders, count, "order")?;
        inner.instance.set_input_derivatives(references, orders, slice(values, count, "value")?)
    }
    /// Writes derivatives of outputs with respect to time, at the last communication point, into `value`.
    GetRealOutputDerivatives fmi2GetRealOutputDerivatives(
        inner, references: *const u32, count: usize, orders: *const c_int, values: *mut f64,
    ) {
        let references = slice(references, count, "vr")?;
        let orders = slice(orders, count, "order")?;
        inner.instance.get_output_derivatives(references, orders, slice_mut(values, count, "value")?)
    }
    /// Steps from the last communication point to `point + step_size`, in s.
    DoStep fmi2DoStep(inner, point: f64, step_size: f64, no_set_fmu_state_prior: c_int) {
        let no_return = flag(no_set_fmu_state_prior, "noSetFMUStatePriorToCurrentPoint")?;
        inner.instance.do_step(point, step_size, no_return)
    }
    /// No step is ever pending: an error in every state that is reached.
    CancelStep fmi2CancelStep(_inner) {
        Ok(())
    }
    /// Only a pending step has this status: answers `fmi2Discard`.
    GetStatus fmi2GetStatus(_inner, kind: c_int, value: *mut c_int) {
        place(value, "value")?;
        Err(Problem::no_status(kind))
    }
    /// Writes `fmi2LastSuccessfulTime` to `*value`.
    GetRealStatus fmi2GetRealStatus(inner, kind: c_int, value: *mut f64) {
        let value = place(value, "value")?;
        match kind {
            LAST_SUCCESSFUL_TIME => *value = inner.instance.state.time_s,
            _ => return Err(Problem::no_status(kind)),
        }
        Ok(())
    }
    /// Only a pending step has this status: answers `fmi2Discard`.
    GetIntegerStatus fmi2GetIntegerStatus(_inner, kind: c_int, value: *mut c_int) {
        place(value, "value")?;
        Err(Problem::no_status(kind))
    }
    /// Writes `fmi2Terminated` to `*value`.
    GetBooleanStatus fmi2GetBooleanStatus(inner, kind: c_int, value: *mut c_int) {
        let value = place(value, "value")?;
        match kind {
            TERMINATED => *value = c_int::from(inner.instance.state.terminated),
            _ => return Err(Problem::no_status(kind)),
        }
        Ok(())
    }
    /// Only a pending step has this status: answers `fmi2Discard`.
    GetStringStatus fmi2GetStringStatus(_inner, kind: c_int, value: *mut *const c_char) {
        place(value, "value")?;
        Err(Problem::no_status(kind))
    }
}
