//! Getting, setting and stepping allocate nothing.
#![allow(unsafe_code, reason = "a counting allocator implements an unsafe trait")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use fmi_export::model_description::Status::Ok;

use super::{fresh, reference};

struct Counting;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
    static LIVE: Cell<isize> = const { Cell::new(0) };
}

// SAFETY: forwards to the system's allocator; counting touches no memory of its own.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        LIVE.set(LIVE.get() + 1);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE.set(LIVE.get() - 1);
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        // SAFETY: the caller's promise.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn counted(body: impl FnOnce()) -> usize {
    let before = COUNT.get();
    body();
    COUNT.get() - before
}

/// Blocks that this thread allocated and has not freed.
pub(super) fn live() -> isize {
    LIVE.get()
}

#[test]
fn the_counter_counts() {
    assert_eq!(counted(|| drop(std::hint::black_box(vec![1_u8; 100]))), 1);
}

#[test]
fn get_set_and_step_do_not_allocate() {
    for logging in [false, true] {
        let (mut instance, description) = fresh("AllTypes");
        assert_eq!(instance.set_debug_logging(logging, &[]), Ok);
        assert_eq!(instance.start(0.0, None), Ok);
        let at = |name| reference(&description, name);
        let inputs = [at("input.real"), at("tunable.real"), at("channel[1].input")];
        let outputs = [at("output.real"), at("output.integral"), at("input.real")];
        let (integer, boolean, echo) = ([at("input.integer")], [at("input.boolean")], [at("echo.boolean")]);
        let input = [inputs[0]];
        let count = counted(|| {
            for i in 0..100 {
                let x = f64::from(i) / 100.0;
                assert_eq!(instance.set_real(&inputs, &[x, x, x]), Ok);
                assert_eq!(instance.set_integer(&integer, &[i]), Ok);
                assert_eq!(instance.set_boolean(&boolean, &[0]), Ok);
                assert_eq!(instance.set_input_derivatives(&input, &[1], &[x]), Ok);
                assert_eq!(instance.do_step(f64::from(i), 1.0), Ok);
                assert_eq!(instance.get_real(&outputs, &mut [0.0; 3]), Ok);
                assert_eq!(instance.get_integer(&integer, &mut [0]), Ok);
                assert_eq!(instance.get_boolean(&echo, &mut [0]), Ok);
                assert_eq!(instance.get_output_derivatives(&[outputs[0]], &[1], &mut [0.0]), Ok);
            }
        });
        assert_eq!(count, 0, "logging {logging}");
    }
}

#[test]
fn an_event_costs_nothing_when_nobody_listens() {
    let (mut instance, description) = super::started("AllTypes");
    let input = [reference(&description, "input.boolean")];
    assert_eq!(instance.set_debug_logging(false, &[]), Ok);
    assert_eq!(instance.set_boolean(&input, &[1]), Ok);
    let mut point_s = 0.0;
    let mut step = || {
        point_s += 1.0;
        assert_eq!(instance.do_step(point_s - 1.0, 1.0), Ok);
    };
    step();
    let quiet = counted(&mut step);
    assert_eq!(instance.set_boolean(&input, &[0]), Ok);
    assert_eq!(instance.do_step(point_s, 1.0), Ok);
    assert_eq!(instance.set_boolean(&input, &[1]), Ok);
    let eventful = counted(|| assert_eq!(instance.do_step(point_s + 1.0, 1.0), Ok));
    assert_eq!((quiet, eventful), (0, 0));
}
