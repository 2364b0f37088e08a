//! An allocator that counts what the calling thread asks of it. A test or bench installs it with
//! `#[global_allocator]`.
#![allow(
    unsafe_code,
    dead_code,
    reason = "an allocator is unsafe by its signature; no user uses all of this"
)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static CALLS: Cell<u64> = const { Cell::new(0) };
    static LIVE: Cell<i64> = const { Cell::new(0) };
}

/// Requests for memory by this thread so far.
pub(crate) fn allocations() -> u64 {
    CALLS.get()
}

/// Bytes that this thread has asked for and not given back.
pub(crate) fn live_bytes() -> i64 {
    LIVE.get()
}

/// The system's allocator, counted.
pub(crate) struct Counting;

fn count(calls: u64, bytes: i64) {
    // while a thread ends its counters may be gone
    let _ = CALLS.try_with(|counter| counter.set(counter.get() + calls));
    let _ = LIVE.try_with(|counter| counter.set(counter.get() + bytes));
}

// SAFETY: every call is passed on to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(1, layout.size() as i64);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(0, -(layout.size() as i64));
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(1, size as i64 - layout.size() as i64);
        // SAFETY: the caller's promise.
        unsafe { System.realloc(pointer, layout, size) }
    }
}
