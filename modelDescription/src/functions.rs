//! The C functions of FMI 2.0 co-simulation: name, signature, and when each may be called (4.2.4).
//!
//! [`functions!`](crate::functions!) is the one list of them; [`types`] are the C types that follow from it.

/// Hands the list of functions to the macro `$callback`, one row a function:
/// `Name symbol (parameter: type, ...) -> result: row of the call table;`
///
/// The columns of a row are the states in the order of [`State::ALL`](crate::call_table::State::ALL), its entries the
/// constants of [`call_table`](crate::call_table); a callback that does not need types or rows leaves these tokens out.
#[macro_export]
macro_rules! functions {
    ($callback:ident) => {
        // Columns:                                instantiated
        //                                         |  Initialization Mode
        //                                         |  |  stepComplete
        //                                         |  |  |  stepInProgress
        //                                         |  |  |  |  stepFailed
        //                                         |  |  |  |  |   stepCanceled
        //                                         |  |  |  |  |   |   terminated
        //                                         |  |  |  |  |   |   |  error
        //                                         |  |  |  |  |   |   |  |   fatal
        $callback! {
            GetTypesPlatform fmi2GetTypesPlatform() -> *const c_char: ANY;
            GetVersion fmi2GetVersion() -> *const c_char: ANY;
            SetDebugLogging fmi2SetDebugLogging(
                c: Component, logging_on: c_int, count: usize, categories: *const *const c_char
            ) -> c_int: ANY;
            // Needs no instance: the states of other instances do not matter, unless one of them is fatal.
            Instantiate fmi2Instantiate(
                instance_name: *const c_char, fmu_type: c_int, guid: *const c_char, resource_location: *const c_char,
                functions: *const CallbackFunctions, visible: c_int, logging_on: c_int
            ) -> Component: ANY;
            FreeInstance fmi2FreeInstance(c: Component) -> (): IDLE;
            SetupExperiment fmi2SetupExperiment(
                c: Component, tolerance_defined: c_int, tolerance: f64, start_time: f64, stop_time_defined: c_int,
                stop_time: f64
            ) -> c_int:                           [X, O, O, O, O, O, O, O, O];
            EnterInitializationMode fmi2EnterInitializationMode(c: Component) -> c_int:
                                                  [X, O, O, O, O, O, O, O, O];
            ExitInitializationMode fmi2ExitInitializationMode(c: Component) -> c_int:
                                                  [O, X, O, O, O, O, O, O, O];
            Terminate fmi2Terminate(c: Component) -> c_int:
                                                  [O, O, X, O, X, O, O, O, O];
            Reset fmi2Reset(c: Component) -> c_int: IDLE;
            GetReal fmi2GetReal(c: Component, vr: *const u32, n: usize, value: *mut f64) -> c_int: GET;
            GetInteger fmi2GetInteger(c: Component, vr: *const u32, n: usize, value: *mut c_int) -> c_int: GET;
            GetBoolean fmi2GetBoolean(c: Component, vr: *const u32, n: usize, value: *mut c_int) -> c_int: GET;
            GetString fmi2GetString(
                c: Component, vr: *const u32, n: usize, value: *mut *const c_char
            ) -> c_int: GET;
            SetReal fmi2SetReal(c: Component, vr: *const u32, n: usize, value: *const f64) -> c_int: SET;
            SetInteger fmi2SetInteger(c: Component, vr: *const u32, n: usize, value: *const c_int) -> c_int: SET;
            SetBoolean fmi2SetBoolean(c: Component, vr: *const u32, n: usize, value: *const c_int) -> c_int: SET;
            SetString fmi2SetString(
                c: Component, vr: *const u32, n: usize, value: *const *const c_char
            ) -> c_int: SET;
            GetFmuState fmi2GetFMUstate(c: Component, state: *mut FmuState) -> c_int:
                                                  [X, X, X, O, N8, N7, X, N7, O];
            SetFmuState fmi2SetFMUstate(c: Component, state: FmuState) -> c_int: IDLE;
            FreeFmuState fmi2FreeFMUstate(c: Component, state: *mut FmuState) -> c_int: IDLE;
            SerializedFmuStateSize fmi2SerializedFMUstateSize(
                c: Component, state: FmuState, size: *mut usize
            ) -> c_int: IDLE;
            SerializeFmuState fmi2SerializeFMUstate(
                c: Component, state: FmuState, bytes: *mut c_char, size: usize
            ) -> c_int: IDLE;
            DeSerializeFmuState fmi2DeSerializeFMUstate(
                c: Component, bytes: *const c_char, size: usize, state: *mut FmuState
            ) -> c_int: IDLE;
            GetDirectionalDerivative fmi2GetDirectionalDerivative(
                c: Component, unknowns: *const u32, unknown_count: usize, knowns: *const u32, known_count: usize,
                seed: *const f64, result: *mut f64
            ) -> c_int:                           [O, X, X, O, N8, N7, X, N7, O];
            SetRealInputDerivatives fmi2SetRealInputDerivatives(
                c: Component, vr: *const u32, n: usize, order: *const c_int, value: *const f64
            ) -> c_int:                           [X, X, X, O, O, O, O, O, O];
            GetRealOutputDerivatives fmi2GetRealOutputDerivatives(
                c: Component, vr: *const u32, n: usize, order: *const c_int, value: *mut f64
            ) -> c_int:                           [O, O, X, O, N8, X, X, N7, O];
            DoStep fmi2DoStep(
                c: Component, point: f64, step_size: f64, no_set_state_prior: c_int
            ) -> c_int:                           [O, O, X, O, O, O, O, O, O];
            CancelStep fmi2CancelStep(c: Component) -> c_int:
                                                  [O, O, O, X, O, O, O, O, O];
            GetStatus fmi2GetStatus(c: Component, kind: c_int, value: *mut c_int) -> c_int: STATUS;
            GetRealStatus fmi2GetRealStatus(c: Component, kind: c_int, value: *mut f64) -> c_int: STATUS;
            GetIntegerStatus fmi2GetIntegerStatus(c: Component, kind: c_int, value: *mut c_int) -> c_int: STATUS;
            GetBooleanStatus fmi2GetBooleanStatus(c: Component, kind: c_int, value: *mut c_int) -> c_int: STATUS;
            GetStringStatus fmi2GetStringStatus(
                c: Component, kind: c_int, value: *mut *const c_char
            ) -> c_int: STATUS;
        }
    };
}

/// The types of `fmi2FunctionTypes.h`: each function's under its own name, and those they are made of.
pub mod types {
    #![allow(non_camel_case_types, reason = "the standard's names")]

    use core::ffi::{c_char, c_int, c_void};

    /// `fmi2Component`: an instance, owned by the FMU from `fmi2Instantiate` to `fmi2FreeInstance`.
    pub type Component = *mut c_void;
    /// `fmi2FMUstate`: a saved state, owned by the FMU until `fmi2FreeFMUstate`.
    pub type FmuState = *mut c_void;
    /// `fmi2CallbackLogger`: instance environment, instance name, status, category, `printf` format, its arguments.
    pub type CallbackLogger =
        unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

    /// `fmi2CallbackFunctions`. The importer owns it; an FMU copies it during `fmi2Instantiate` (2.1.5).
    #[repr(C)]
    #[derive(Clone, Copy, Debug)]
    #[allow(missing_docs, reason = "the fields are the standard's own")]
    pub struct CallbackFunctions {
        pub logger: Option<CallbackLogger>,
        pub allocate_memory: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
        pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
        pub step_finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
        pub component_environment: *mut c_void,
    }

    macro_rules! declare {
        ($($name:ident $symbol:ident $parameters:tt -> $result:ty: $access:expr;)*) => { $(
            #[doc = concat!("The type of `", stringify!($symbol), "`.")]
            pub type $symbol = unsafe extern "C" fn $parameters -> $result;
        )* };
    }

    crate::functions!(declare);
}

/// `fmi2Type` of co-simulation.
pub const CO_SIMULATION: i32 = 1;
/// `fmi2StatusKind` of `fmi2GetRealStatus`: until which time the last step was computed, in s.
pub const LAST_SUCCESSFUL_TIME: i32 = 2;
/// `fmi2StatusKind` of `fmi2GetBooleanStatus`: whether the FMU wants to end the simulation.
pub const TERMINATED: i32 = 3;
