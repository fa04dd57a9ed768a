//! One thin function a symbol; names and order of arguments are the standard's.
//!
//! Common safety contract: `component` is NULL or a live handle that no other thread uses meanwhile; arrays
//! have the announced lengths; strings are NUL-terminated; everything lives for the time of the call.
#![allow(clippy::missing_safety_doc, reason = "one contract for all, stated above")]
#![allow(clippy::too_many_arguments, reason = "the standard's signatures")]

use core::ffi::{CStr, c_char, c_int, c_uint, c_void};

use super::CallbackFunctions;
use super::arguments::{flag, place, slice, slice_mut, text};
use super::boundary::{self, MasterLogger, call, saved, state_handle_of};
use crate::Status;
use crate::call_table::Function;
use crate::instance::{Instance, StatusKind};
use crate::library::Library;
use crate::logger::{Category, Logger};
use crate::panics::contain;
use crate::problem::{Complaint, Problem};

/// Declares functions that run a closure inside the boundary; pointers are followed in the closure only.
macro_rules! guarded {
    ($(
        $symbol:ident $name:ident($inner:ident $(, $argument:ident: $type:ty)* $(,)?) $body:block
    )*) => { $(
        #[doc = concat!("`fmi2", stringify!($symbol), "`. # Safety: see the module.")]
        pub unsafe fn $name(component: *mut c_void $(, $argument: $type)*) -> c_int {
            // SAFETY: the module's contract, for the handle and for every pointer in the body.
            unsafe { call(component, Function::$symbol, |$inner| $body) }
        }
    )* };
}

/// `fmi2GetTypesPlatform`.
pub fn get_types_platform() -> *const c_char {
    c"default".as_ptr()
}

/// `fmi2GetVersion`.
pub fn get_version() -> *const c_char {
    c"2.0".as_ptr()
}

/// `fmi2Instantiate` over the models of a library. # Safety: see the module.
pub unsafe fn instantiate(
    library: &Library,
    instance_name: *const c_char,
    fmu_type: c_int,
    guid: *const c_char,
    resource_location: *const c_char,
    functions: *const CallbackFunctions,
    visible: c_int,
    logging_on: c_int,
) -> *mut c_void {
    // SAFETY: the module's contract. The struct is copied: it may die with this call.
    let Some(functions) = (unsafe { functions.as_ref() }).copied() else { return core::ptr::null_mut() };
    let Some(logger) = functions.logger else { return core::ptr::null_mut() };
    let environment = functions.component_environment;
    let log = |status: Status, message: core::fmt::Arguments<'_>| {
        // SAFETY: the module's contract.
        let name = unsafe { text(instance_name, "instanceName") }.unwrap_or(c"");
        let _ = contain(|| {
            Logger::new(Box::new(MasterLogger { logger, environment }), name, false).log(status, message)
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
            1 => {}
            0 => return Err("this FMU is for co-simulation, not for model exchange".to_owned()),
            other => return Err(format!("argument fmuType is {other}, allowed is 1 (fmi2CoSimulation)")),
        }
        explained(flag(visible, "visible"))?;
        let logging_on = explained(flag(logging_on, "loggingOn"))?;
        // SAFETY: the module's contract.
        let location = unsafe { text(resource_location, "fmuResourceLocation") }.unwrap_or(c"");
        let prepared = library.select(&guid.to_string_lossy(), location.to_bytes())?;
        let sink = Box::new(MasterLogger { logger, environment });
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
    result.map_err(|problem| problem.explain(&Default::default()).to_string())
}

/// `fmi2FreeInstance`. # Safety: see the module; the component is not used again.
pub unsafe fn free_instance(component: *mut c_void) {
    // SAFETY: the module's contract.
    unsafe { boundary::free(component) }
}

guarded! {
    SetDebugLogging set_debug_logging(inner, logging_on: c_int, count: usize, categories: *const *const c_char) {
        let on = flag(logging_on, "loggingOn")?;
        let categories = slice(categories, count, "categories")?;
        if categories.iter().any(|category| category.is_null()) {
            return Err(Problem::Argument { name: "categories", what: Complaint::Null });
        }
        let named = |index: usize| Category::from_name(CStr::from_ptr(categories[index]));
        inner.instance.set_debug_logging(on, categories.len(), named)
    }
    SetupExperiment setup_experiment(
        inner, tolerance_defined: c_int, tolerance: f64, start_time: f64, stop_time_defined: c_int, stop_time: f64,
    ) {
        let tolerance = flag(tolerance_defined, "toleranceDefined")?.then_some(tolerance);
        let stop_time = flag(stop_time_defined, "stopTimeDefined")?.then_some(stop_time);
        inner.instance.setup_experiment(tolerance, start_time, stop_time)
    }
    EnterInitializationMode enter_initialization_mode(inner) {
        inner.instance.enter_initialization_mode()
    }
    ExitInitializationMode exit_initialization_mode(inner) {
        inner.instance.exit_initialization_mode()
    }
    Terminate terminate(inner) {
        inner.instance.terminate()
    }
    Reset reset(inner) {
        inner.instance.reset()
    }
    GetReal get_real(inner, references: *const c_uint, count: usize, values: *mut f64) {
        let values = slice_mut(values, count, "value")?;
        inner.instance.get_real(slice(references, count, "vr")?, values)
    }
    GetInteger get_integer(inner, references: *const c_uint, count: usize, values: *mut c_int) {
        let values = slice_mut(values, count, "value")?;
        inner.instance.get_integer(slice(references, count, "vr")?, values)
    }
    GetBoolean get_boolean(inner, references: *const c_uint, count: usize, values: *mut c_int) {
        let values = slice_mut(values, count, "value")?;
        inner.instance.get_boolean(slice(references, count, "vr")?, values)
    }
    GetString get_string(inner, references: *const c_uint, count: usize, values: *mut *const c_char) {
        let values = slice_mut(values, count, "value")?;
        let lent = &mut inner.lent;
        inner.instance.get_string(slice(references, count, "vr")?, |position, index, text| {
            values[position] = lent.lend(index, text);
        })
    }
    SetReal set_real(inner, references: *const c_uint, count: usize, values: *const f64) {
        inner.instance.set_real(slice(references, count, "vr")?, slice(values, count, "value")?)
    }
    SetInteger set_integer(inner, references: *const c_uint, count: usize, values: *const c_int) {
        inner.instance.set_integer(slice(references, count, "vr")?, slice(values, count, "value")?)
    }
    SetBoolean set_boolean(inner, references: *const c_uint, count: usize, values: *const c_int) {
        inner.instance.set_boolean(slice(references, count, "vr")?, slice(values, count, "value")?)
    }
    SetString set_string(inner, references: *const c_uint, count: usize, values: *const *const c_char) {
        let texts = slice(values, count, "value")?;
        let texts = texts.iter().map(|&pointer| text(pointer, "value").map(|text| text.to_str().ok()));
        let texts = texts.collect::<Result<Vec<_>, Problem>>()?;
        inner.instance.set_string(slice(references, count, "vr")?, &texts)
    }
    GetFmuState get_fmu_state(inner, state: *mut *mut c_void) {
        let state = place(state, "FMUstate")?;
        let reuse = if state.is_null() { None } else { Some(saved(*state, "FMUstate")?) };
        if let Some(new) = inner.instance.save(reuse)? {
            *state = state_handle_of(new);
        }
        Ok(())
    }
    SetFmuState set_fmu_state(inner, state: *mut c_void) {
        inner.instance.restore(saved(state, "FMUstate")?)
    }
    FreeFmuState free_fmu_state(inner, state: *mut *mut c_void) {
        inner.instance.guard(Function::FreeFmuState)?;
        match state.as_mut() {
            Some(state) if !state.is_null() => {
                saved(*state, "FMUstate")?;
                // NULL before the drop, which may panic: nobody must free it twice.
                boundary::free_state(core::mem::replace(state, core::ptr::null_mut()))
            }
            _ => Ok(()),
        }
    }
    SerializedFmuStateSize serialized_fmu_state_size(inner, state: *mut c_void, size: *mut usize) {
        let size = place(size, "size")?;
        *size = inner.instance.serialized_size(saved(state, "FMUstate")?)?;
        Ok(())
    }
    SerializeFmuState serialize_fmu_state(inner, state: *mut c_void, bytes: *mut c_char, size: usize) {
        let bytes = slice_mut(bytes.cast::<u8>(), size, "serializedState")?;
        inner.instance.serialize(saved(state, "FMUstate")?, bytes)
    }
    DeSerializeFmuState deserialize_fmu_state(inner, bytes: *const c_char, size: usize, state: *mut *mut c_void) {
        let state = place(state, "FMUstate")?;
        let bytes = slice(bytes.cast::<u8>(), size, "serializedState")?;
        // Always a new state: the standard gives the pointer no meaning before the call.
        *state = state_handle_of(inner.instance.deserialize(bytes)?);
        Ok(())
    }
    GetDirectionalDerivative get_directional_derivative(
        inner, unknowns: *const c_uint, unknown_count: usize, knowns: *const c_uint, known_count: usize,
        seed: *const f64, result: *mut f64,
    ) {
        let unknowns = slice(unknowns, unknown_count, "vUnknown_ref")?;
        let knowns = slice(knowns, known_count, "vKnown_ref")?;
        let seed = slice(seed, known_count, "dvKnown")?;
        let result = slice_mut(result, unknown_count, "dvUnknown")?;
        inner.instance.get_directional_derivative(unknowns, knowns, seed, result)
    }
    SetRealInputDerivatives set_real_input_derivatives(
        inner, references: *const c_uint, count: usize, orders: *const c_int, values: *const f64,
    ) {
        let references = slice(references, count, "vr")?;
        let orders = slice(orders, count, "order")?;
        inner.instance.set_input_derivatives(references, orders, slice(values, count, "value")?)
    }
    GetRealOutputDerivatives get_real_output_derivatives(
        inner, references: *const c_uint, count: usize, orders: *const c_int, values: *mut f64,
    ) {
        let references = slice(references, count, "vr")?;
        let orders = slice(orders, count, "order")?;
        inner.instance.get_output_derivatives(references, orders, slice_mut(values, count, "value")?)
    }
    DoStep do_step(inner, point: f64, step_size: f64, no_set_fmu_state_prior: c_int) {
        let no_return = flag(no_set_fmu_state_prior, "noSetFMUStatePriorToCurrentPoint")?;
        inner.instance.do_step(point, step_size, no_return)
    }
    CancelStep cancel_step(inner) {
        inner.instance.cancel_step()
    }
    GetStatus get_status(inner, kind: c_int, value: *mut c_int) {
        place(value, "value")?;
        inner.instance.no_status(Function::GetStatus, StatusKind::from_code(kind))
    }
    GetRealStatus get_real_status(inner, kind: c_int, value: *mut f64) {
        let value = place(value, "value")?;
        *value = inner.instance.real_status(StatusKind::from_code(kind))?;
        Ok(())
    }
    GetIntegerStatus get_integer_status(inner, kind: c_int, value: *mut c_int) {
        place(value, "value")?;
        inner.instance.no_status(Function::GetIntegerStatus, StatusKind::from_code(kind))
    }
    GetBooleanStatus get_boolean_status(inner, kind: c_int, value: *mut c_int) {
        let value = place(value, "value")?;
        *value = c_int::from(inner.instance.boolean_status(StatusKind::from_code(kind))?);
        Ok(())
    }
    GetStringStatus get_string_status(inner, kind: c_int, value: *mut *const c_char) {
        place(value, "value")?;
        inner.instance.no_status(Function::GetStringStatus, StatusKind::from_code(kind))
    }
}
