//! The sine that the crates inside the library call, in place of the C library's.
//!
//! hifitime takes it from the standard library and so from the system, whose rounding is its own. Defined here and hidden, it is
//! found before the system's and stays inside the library.
#![allow(unsafe_code, reason = "defines a symbol of the C library")]

use core::arch::global_asm;

#[cfg(target_arch = "x86_64")]
global_asm!(
    ".globl sin",
    ".hidden sin",
    ".type sin, @function",
    "sin:",
    "jmp {sine}",
    sine = sym sine,
);
#[cfg(target_arch = "aarch64")]
global_asm!(
    ".globl sin",
    ".hidden sin",
    ".type sin, @function",
    "sin:",
    "b {sine}",
    sine = sym sine,
);

extern "C" fn sine(angle_rad: f64) -> f64 {
    physics::math::sin(angle_rad)
}
