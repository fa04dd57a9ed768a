//! What C can do wrong is an error, never a crash: NULL, odd flags, dead callbacks, calls from the logger.
#![allow(unsafe_code, reason = "calls the C functions with raw pointers, as a master does")]

use core::ffi::{c_char, c_int, c_void};
use core::ptr::{null, null_mut};
use std::cell::Cell;
use std::ffi::CString;

use fmi_export::fmi2;
use fmi_export::model_description::functions::types::{CallbackFunctions, CallbackLogger};

use super::{PROBE, described};

const OK: c_int = 0;
const DISCARD: c_int = 2;
const ERROR: c_int = 3;

thread_local! {
    static LOGGED: Cell<usize> = const { Cell::new(0) };
    static CALL_BACK: Cell<*mut c_void> = const { Cell::new(null_mut()) };
    static ANSWER: Cell<c_int> = const { Cell::new(-1) };
}

unsafe extern "C" fn log(_: *mut c_void, _: *const c_char, _: c_int, _: *const c_char, _: *const c_char) {
    LOGGED.set(LOGGED.get() + 1);
    let component = CALL_BACK.get();
    if !component.is_null() {
        // SAFETY: a live instance; calling it from here is the mistake under test.
        ANSWER.set(unsafe { fmi2::fmi2Reset(component) });
        // SAFETY: as above; must not free what is in use.
        unsafe { fmi2::fmi2FreeInstance(component) };
    }
}

fn callbacks() -> CallbackFunctions {
    // SAFETY: fixed arguments travel alike on the platforms the tests run on, and no others are sent.
    let logger = unsafe {
        core::mem::transmute::<
            unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char),
            CallbackLogger,
        >(log)
    };
    CallbackFunctions {
        logger: Some(logger),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: null_mut(),
    }
}

fn instantiate(name: *const c_char, kind: c_int, guid: *const c_char, flag: c_int) -> *mut c_void {
    let mut functions = Box::new(callbacks());
    // SAFETY: everything is valid during the call, or NULL.
    let component =
        unsafe { fmi2::instantiate(PROBE, name, kind, guid, null(), &raw const *functions, 0, flag) };
    // The struct is dropped, and its content is overwritten.
    functions.logger = None;
    drop(functions);
    component
}

fn started(model: &str) -> *mut c_void {
    let guid = CString::new(described(model).guid).unwrap();
    let component = instantiate(c"name".as_ptr(), 1, guid.as_ptr(), 0);
    assert!(!component.is_null());
    // SAFETY: a live instance.
    unsafe {
        assert_eq!(fmi2::fmi2SetupExperiment(component, 0, 0.0, 0.0, 0, 0.0), OK);
        assert_eq!(fmi2::fmi2EnterInitializationMode(component), OK);
        assert_eq!(fmi2::fmi2ExitInitializationMode(component), OK);
    }
    component
}

#[test]
fn instantiation_refuses_what_it_cannot_use() {
    let guid = CString::new(described("Empty").guid).unwrap();
    let (name, guid) = (c"name".as_ptr(), guid.as_ptr());
    for (name, kind, guid, flag) in [
        (null(), 1, guid, 0),
        (c"".as_ptr(), 1, guid, 0),
        (c" \t".as_ptr(), 1, guid, 0),
        (name, 0, guid, 0),
        (name, 7, guid, 0),
        (name, 1, null(), 0),
        (name, 1, c"{}".as_ptr(), 0),
        (name, 1, guid, -1),
    ] {
        let before = LOGGED.get();
        assert!(instantiate(name, kind, guid, flag).is_null());
        assert_eq!(LOGGED.get(), before + 1);
    }
    let mut silent = callbacks();
    silent.logger = None;
    // SAFETY: everything is valid during the call, or NULL.
    unsafe {
        assert!(fmi2::instantiate(PROBE, name, 1, guid, null(), null(), 0, 0).is_null());
        assert!(fmi2::instantiate(PROBE, name, 1, guid, null(), &raw const silent, 0, 0).is_null());
        fmi2::fmi2FreeInstance(null_mut());
    }
}

#[test]
fn null_is_an_error_and_no_elements_need_no_pointer() {
    // SAFETY: NULL is what is under test; everything else is live.
    unsafe {
        let component = started("AllTypes");
        assert_eq!(fmi2::fmi2GetReal(component, null(), 0, null_mut()), OK);
        assert_eq!(fmi2::fmi2SetString(component, null(), 0, null()), OK);
        assert_eq!(
            fmi2::fmi2GetDirectionalDerivative(component, null(), 0, null(), 0, null(), null_mut()),
            OK
        );
        fmi2::fmi2FreeInstance(component);
        let calls: [&dyn Fn(*mut c_void) -> c_int; 12] = [
            &|c| fmi2::fmi2GetReal(c, null(), 1, [0.0].as_mut_ptr()),
            &|c| fmi2::fmi2GetReal(c, [0].as_ptr(), 1, null_mut()),
            &|c| fmi2::fmi2GetReal(c, [0].as_ptr(), usize::MAX, [0.0].as_mut_ptr()),
            &|c| fmi2::fmi2SetString(c, [0].as_ptr(), 1, [null()].as_ptr()),
            &|c| fmi2::fmi2GetFMUstate(c, null_mut()),
            &|c| fmi2::fmi2SetFMUstate(c, null_mut()),
            &|c| fmi2::fmi2SerializedFMUstateSize(c, null_mut(), &mut 0),
            &|c| fmi2::fmi2DeSerializeFMUstate(c, null(), 5, &mut null_mut()),
            &|c| fmi2::fmi2SetDebugLogging(c, 2, 0, null()),
            &|c| fmi2::fmi2SetDebugLogging(c, 1, 1, [null()].as_ptr()),
            &|c| fmi2::fmi2DoStep(c, 0.0, 1.0, 5),
            &|c| fmi2::fmi2GetRealStatus(c, 2, null_mut()),
        ];
        for (i, call) in calls.iter().enumerate() {
            let component = started("AllTypes");
            let before = LOGGED.get();
            assert_eq!(call(component), ERROR, "call {i}");
            assert_eq!(LOGGED.get(), before + 1, "call {i}");
            assert_eq!(call(null_mut()), ERROR, "call {i}");
            fmi2::fmi2FreeInstance(component);
        }
        let component = started("AllTypes");
        assert_eq!(fmi2::fmi2FreeFMUstate(component, null_mut()), OK);
        assert_eq!(fmi2::fmi2FreeFMUstate(component, &mut null_mut()), OK);
        fmi2::fmi2FreeInstance(component);
    }
}

#[test]
fn handles_of_others_are_recognised() {
    let mut foreign = [0_usize; 16];
    let component = foreign.as_mut_ptr().cast::<c_void>();
    // SAFETY: large enough to be read; that it is no handle is what is under test.
    unsafe {
        assert_eq!(fmi2::fmi2Reset(component), ERROR);
        assert_eq!(fmi2::fmi2DoStep(component, 0.0, 1.0, 0), ERROR);
        fmi2::fmi2FreeInstance(component);
        let ours = started("AllTypes");
        assert_eq!(fmi2::fmi2SetFMUstate(ours, component), ERROR);
        let mut state = component;
        assert_eq!(fmi2::fmi2FreeFMUstate(ours, &raw mut state), ERROR);
        assert_eq!(state, component);
        // An instance is no state either.
        assert_eq!(fmi2::fmi2Reset(ours), OK);
        assert_eq!(fmi2::fmi2SetFMUstate(ours, ours), ERROR);
        fmi2::fmi2FreeInstance(ours);
    }
}

#[test]
fn a_call_from_the_logger_is_refused() {
    // SAFETY: a live instance.
    unsafe {
        let component = started("AllTypes");
        CALL_BACK.set(component);
        assert_eq!(fmi2::fmi2DoStep(component, 55.0, 1.0, 0), ERROR);
        CALL_BACK.set(null_mut());
        assert_eq!(ANSWER.get(), ERROR);
        assert_eq!(fmi2::fmi2Reset(component), OK);
        fmi2::fmi2FreeInstance(component);
    }
}

#[test]
fn strings_live_until_they_are_read_with_another_value() {
    let description = described("AllTypes");
    let text = [super::reference(&description, "input.text")];
    // SAFETY: a live instance, arrays of length 1, and strings that the instance still lends.
    unsafe {
        let component = started("AllTypes");
        let (mut first, mut second) = (null(), null());
        assert_eq!(fmi2::fmi2SetString(component, text.as_ptr(), 1, [c"one".as_ptr()].as_ptr()), OK);
        assert_eq!(fmi2::fmi2GetString(component, text.as_ptr(), 1, &raw mut first), OK);
        assert_eq!(fmi2::fmi2DoStep(component, 0.0, 1.0, 0), OK);
        assert_eq!(core::ffi::CStr::from_ptr(first), c"one");
        assert_eq!(fmi2::fmi2GetString(component, text.as_ptr(), 1, &raw mut second), OK);
        assert_eq!(first, second);
        assert_eq!(fmi2::fmi2SetBoolean(component, [0].as_ptr(), 1, [7].as_ptr()), ERROR);
        fmi2::fmi2FreeInstance(component);
        let component = started("AllTypes");
        let boolean = [super::reference(&description, "input.boolean")];
        assert_eq!(fmi2::fmi2SetBoolean(component, boolean.as_ptr(), 1, [7].as_ptr()), DISCARD);
        fmi2::fmi2FreeInstance(component);
    }
}
