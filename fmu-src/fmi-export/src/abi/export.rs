//! The macro that emits the symbols; signatures stand here once, as in `fmi2FunctionTypes.h`.

/// Makes the calling crate (of type cdylib) an FMI 2.0 co-simulation library of these models.
///
/// ```ignore
/// fmi_export::export!(models::MomentumPlant, models::SpinPlant);
/// ```
///
/// Emits `LIBRARY`, a [`Library`](crate::Library) of the models, one `extern "C"` function for every symbol of
/// [`abi::symbols`](crate::abi::symbols), and nothing else.
#[macro_export]
macro_rules! export {
    ($($model:ty),+ $(,)?) => {
        /// The models of this library.
        pub static LIBRARY: $crate::Library =
            $crate::Library { entries: &[$($crate::Entry::of::<$model>()),+] };

        $crate::__emit! {
            fn fmi2Instantiate(
                instance_name: *const c_char, fmu_type: c_int, guid: *const c_char,
                resource_location: *const c_char, functions: *const $crate::abi::CallbackFunctions,
                visible: c_int, logging_on: c_int,
            ) -> *mut c_void = loaded::instantiate(&LIBRARY);
            fn fmi_export_describe(
                model: *const c_char, setup_file: *const c_char, setup_text: *const c_char,
                context: *mut c_void, receive: Option<$crate::abi::Receive>,
            ) -> c_int = loaded::describe(&LIBRARY);
            fn fmi2GetTypesPlatform() -> *const c_char = get_types_platform();
            fn fmi2GetVersion() -> *const c_char = get_version();
            fn fmi2FreeInstance(c: *mut c_void) -> () = free_instance();
            fn fmi2SetDebugLogging(
                c: *mut c_void, logging_on: c_int, count: usize, categories: *const *const c_char,
            ) -> c_int = set_debug_logging();
            fn fmi2SetupExperiment(
                c: *mut c_void, tolerance_defined: c_int, tolerance: f64, start_time: f64,
                stop_time_defined: c_int, stop_time: f64,
            ) -> c_int = setup_experiment();
            fn fmi2EnterInitializationMode(c: *mut c_void) -> c_int = enter_initialization_mode();
            fn fmi2ExitInitializationMode(c: *mut c_void) -> c_int = exit_initialization_mode();
            fn fmi2Terminate(c: *mut c_void) -> c_int = terminate();
            fn fmi2Reset(c: *mut c_void) -> c_int = reset();
            fn fmi2GetReal(c: *mut c_void, vr: *const c_uint, n: usize, value: *mut f64) -> c_int = get_real();
            fn fmi2GetInteger(c: *mut c_void, vr: *const c_uint, n: usize, value: *mut c_int) -> c_int
                = get_integer();
            fn fmi2GetBoolean(c: *mut c_void, vr: *const c_uint, n: usize, value: *mut c_int) -> c_int
                = get_boolean();
            fn fmi2GetString(c: *mut c_void, vr: *const c_uint, n: usize, value: *mut *const c_char) -> c_int
                = get_string();
            fn fmi2SetReal(c: *mut c_void, vr: *const c_uint, n: usize, value: *const f64) -> c_int = set_real();
            fn fmi2SetInteger(c: *mut c_void, vr: *const c_uint, n: usize, value: *const c_int) -> c_int
                = set_integer();
            fn fmi2SetBoolean(c: *mut c_void, vr: *const c_uint, n: usize, value: *const c_int) -> c_int
                = set_boolean();
            fn fmi2SetString(c: *mut c_void, vr: *const c_uint, n: usize, value: *const *const c_char) -> c_int
                = set_string();
            fn fmi2GetFMUstate(c: *mut c_void, state: *mut *mut c_void) -> c_int = get_fmu_state();
            fn fmi2SetFMUstate(c: *mut c_void, state: *mut c_void) -> c_int = set_fmu_state();
            fn fmi2FreeFMUstate(c: *mut c_void, state: *mut *mut c_void) -> c_int = free_fmu_state();
            fn fmi2SerializedFMUstateSize(c: *mut c_void, state: *mut c_void, size: *mut usize) -> c_int
                = serialized_fmu_state_size();
            fn fmi2SerializeFMUstate(
                c: *mut c_void, state: *mut c_void, bytes: *mut c_char, size: usize,
            ) -> c_int = serialize_fmu_state();
            fn fmi2DeSerializeFMUstate(
                c: *mut c_void, bytes: *const c_char, size: usize, state: *mut *mut c_void,
            ) -> c_int = deserialize_fmu_state();
            fn fmi2GetDirectionalDerivative(
                c: *mut c_void, unknowns: *const c_uint, unknown_count: usize, knowns: *const c_uint,
                known_count: usize, seed: *const f64, result: *mut f64,
            ) -> c_int = get_directional_derivative();
            fn fmi2SetRealInputDerivatives(
                c: *mut c_void, vr: *const c_uint, n: usize, orders: *const c_int, values: *const f64,
            ) -> c_int = set_real_input_derivatives();
            fn fmi2GetRealOutputDerivatives(
                c: *mut c_void, vr: *const c_uint, n: usize, orders: *const c_int, values: *mut f64,
            ) -> c_int = get_real_output_derivatives();
            fn fmi2DoStep(c: *mut c_void, point: f64, step_size: f64, no_set_state_prior: c_int) -> c_int
                = do_step();
            fn fmi2CancelStep(c: *mut c_void) -> c_int = cancel_step();
            fn fmi2GetStatus(c: *mut c_void, kind: c_int, value: *mut c_int) -> c_int = get_status();
            fn fmi2GetRealStatus(c: *mut c_void, kind: c_int, value: *mut f64) -> c_int = get_real_status();
            fn fmi2GetIntegerStatus(c: *mut c_void, kind: c_int, value: *mut c_int) -> c_int
                = get_integer_status();
            fn fmi2GetBooleanStatus(c: *mut c_void, kind: c_int, value: *mut c_int) -> c_int
                = get_boolean_status();
            fn fmi2GetStringStatus(c: *mut c_void, kind: c_int, value: *mut *const c_char) -> c_int
                = get_string_status();
        }
    };
}

/// One symbol a line: its signature, and the function of [`abi`](crate::abi) behind it with what goes before
/// the C arguments.
#[doc(hidden)]
#[macro_export]
macro_rules! __emit {
    ($(
        fn $symbol:ident($($argument:ident: $type:ty),* $(,)?) -> $result:ty
            = $($target:ident)::+($($first:expr)?);
    )*) => {
        #[allow(unsafe_code, reason = "symbols of the C interface, forwarded to fmi_export::abi")]
        #[allow(non_snake_case, reason = "the standard's names")]
        #[allow(clippy::missing_safety_doc, reason = "the contract is that of fmi_export::abi")]
        #[allow(clippy::too_many_arguments, reason = "the standard's signatures")]
        #[allow(missing_docs, reason = "the functions are the standard's own")]
        #[allow(unused_unsafe, reason = "two of the functions take no pointer")]
        mod __symbols {
            use ::core::ffi::{c_char, c_int, c_uint, c_void};
            use super::*;
            $(
                #[unsafe(no_mangle)]
                pub unsafe extern "C" fn $symbol($($argument: $type),*) -> $result {
                    // SAFETY: the master keeps the standard's contract.
                    unsafe { $crate::abi::$($target)::+($($first,)? $($argument),*) }
                }
            )*
        }
    };
}
