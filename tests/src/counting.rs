//! An allocator that counts, thread by thread: parallel tests do not disturb each other.
#![allow(unsafe_code, reason = "a global allocator is an unsafe trait")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The system's allocator, counting.
pub struct Counting;

/// Requests of one thread to the allocator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Blocks requested, moved blocks included.
    pub allocations: u64,
    /// Bytes requested in all.
    pub bytes: u64,
    /// Bytes not given back; negative where the thread freed what others allocated.
    pub live_bytes: i64,
}

thread_local! {
    // Constant and without destructor, so that it may be used inside the allocator.
    static COUNT: Cell<Count> = const { Cell::new(Count { allocations: 0, bytes: 0, live_bytes: 0 }) };
}

/// The counts of this thread so far.
pub fn count() -> Count {
    COUNT.get()
}

/// Runs `body`; returns its result with its requests on this thread.
pub fn counted<T>(body: impl FnOnce() -> T) -> (T, Count) {
    let before = count();
    let result = body();
    let after = count();
    let difference = Count {
        allocations: after.allocations - before.allocations,
        bytes: after.bytes - before.bytes,
        live_bytes: after.live_bytes - before.live_bytes,
    };
    (result, difference)
}

fn note(requested: usize, given_back: usize) {
    // A thread that ends may allocate after its locals are gone.
    let _ = COUNT.try_with(|cell| {
        let mut count = cell.get();
        count.allocations += u64::from(requested > 0);
        count.bytes += requested as u64;
        count.live_bytes += requested as i64 - given_back as i64;
        cell.set(count);
    });
}

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        note(layout.size(), 0);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        note(layout.size(), 0);
        // SAFETY: the caller's promise.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        note(size, layout.size());
        // SAFETY: the caller's promise.
        unsafe { System.realloc(block, layout, size) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        note(0, layout.size());
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(block, layout) }
    }
}
