//! The macro that makes a shared library of models.

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
            $crate::Library { entries: &[$($crate::Entry::of::<$model>()),+] };

        #[allow(unsafe_code, reason = "symbols of the C interface, forwarded to fmi_export::fmi2")]
        #[allow(non_snake_case, reason = "the standard's names")]
        #[allow(clippy::too_many_arguments, reason = "the signatures of the standard and of `CheckSchedule`")]
        mod __symbols {
            use ::core::ffi::{c_char, c_int, c_void};
            use $crate::model_description::{describe, functions::types};

            /// See [`instantiate`]($crate::fmi2::instantiate).
            #[unsafe(no_mangle)]
            unsafe extern "C" fn fmi2Instantiate(
                instance_name: *const c_char,
                fmu_type: c_int,
                guid: *const c_char,
                resource_location: *const c_char,
                functions: *const types::CallbackFunctions,
                visible: c_int,
                logging_on: c_int,
            ) -> types::Component {
                $crate::fmi2::silence_panics();
                // SAFETY: the importer keeps the standard's contract.
                unsafe {
                    $crate::fmi2::instantiate(
                        &super::LIBRARY, instance_name, fmu_type, guid, resource_location, functions, visible, logging_on,
                    )
                }
            }

            const _: types::fmi2Instantiate = fmi2Instantiate;

            /// See [`Describe`](describe::Describe).
            #[unsafe(no_mangle)]
            unsafe extern "C" fn fmi_export_describe(
                model: *const c_char,
                setup_file: *const c_char,
                setup_text: *const c_char,
                context: *mut c_void,
                receive: Option<describe::Receive>,
            ) -> c_int {
                $crate::fmi2::silence_panics();
                // SAFETY: the caller keeps the contract of `Describe`.
                unsafe {
                    $crate::fmi2::describe(&super::LIBRARY, model, setup_file, setup_text, context, receive)
                }
            }

            const _: describe::Describe = fmi_export_describe;

            /// See [`CheckSchedule`](describe::CheckSchedule).
            #[unsafe(no_mangle)]
            unsafe extern "C" fn fmi_export_check_schedule_file(
                model: *const c_char,
                setup_file: *const c_char,
                setup_text: *const c_char,
                schedule: *const c_char,
                schedule_file: *const c_char,
                schedule_text: *const c_char,
                context: *mut c_void,
                receive: Option<describe::Receive>,
            ) -> c_int {
                $crate::fmi2::silence_panics();
                // SAFETY: the caller keeps the contract of `CheckSchedule`.
                unsafe {
                    $crate::fmi2::check_schedule(
                        &super::LIBRARY, model, setup_file, setup_text, schedule, schedule_file, schedule_text, context,
                        receive,
                    )
                }
            }

            const _: describe::CheckSchedule = fmi_export_check_schedule_file;
        }
    };
}
