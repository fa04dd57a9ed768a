//! The macro that makes a shared library of models.

/// Declares a C function that runs its body in [`fmi2`](crate::fmi2) over the models of the library.
#[doc(hidden)]
#[macro_export]
macro_rules! __symbol {
    ($(#[$doc:meta])* $symbol:ident: $type:ty = $body:ident($($argument:ident: $of:ty),*) -> $result:ty) => {
        $(#[$doc])*
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $symbol($($argument: $of),*) -> $result {
            $crate::fmi2::silence_panics();
            // SAFETY: the caller keeps the contract of the function's type.
            unsafe { $crate::fmi2::$body(&super::LIBRARY, $($argument),*) }
        }

        const _: $type = $symbol;
    };
}

/// Makes the calling crate (of type cdylib) an FMI 2.0 co-simulation library of these models.
///
/// ```ignore
/// fmi_export::export!(models::MomentumPlant, models::SpinPlant);
/// ```
///
/// Emits `LIBRARY`, a [`Library`](crate::Library) of the models, and the three C functions that need it; the others come with
/// this crate (see [`fmi2`](crate::fmi2)).
#[macro_export]
macro_rules! export {
    ($($model:ty),+ $(,)?) => {
        /// The models of this library.
        pub static LIBRARY: $crate::Library =
            $crate::Library { entries: &[$($crate::fmi2::entry::<$model>()),+] };

        #[allow(unsafe_code, reason = "symbols of the C interface, forwarded to fmi_export::fmi2")]
        #[allow(non_snake_case, reason = "the standard's names")]
        #[allow(clippy::too_many_arguments, reason = "the signatures of the standard and of `CheckSchedule`")]
        mod __symbols {
            use ::core::ffi::{c_char, c_int, c_void};
            use $crate::model_description::{describe, functions::types};

            $crate::__symbol! {
                /// See [`instantiate`]($crate::fmi2::instantiate).
                fmi2Instantiate: types::fmi2Instantiate = instantiate(
                    instance_name: *const c_char, fmu_type: c_int, guid: *const c_char, resource_location: *const c_char,
                    functions: *const types::CallbackFunctions, visible: c_int, logging_on: c_int
                ) -> types::Component
            }

            $crate::__symbol! {
                /// See [`Describe`](describe::Describe).
                fmi_export_describe: describe::Describe = describe(
                    model: *const c_char, setup_file: *const c_char, setup_text: *const c_char, context: *mut c_void,
                    receive: Option<describe::Receive>
                ) -> c_int
            }

            $crate::__symbol! {
                /// See [`CheckSchedule`](describe::CheckSchedule).
                fmi_export_check_schedule_file: describe::CheckSchedule = check_schedule(
                    model: *const c_char, setup_file: *const c_char, setup_text: *const c_char, schedule: *const c_char,
                    schedule_file: *const c_char, schedule_text: *const c_char, context: *mut c_void,
                    receive: Option<describe::Receive>
                ) -> c_int
            }
        }
    };
}
