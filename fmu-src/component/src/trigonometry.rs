//! The sine and cosine that the crates inside the library call, in place of the C library's.
//!
//! hifitime and nrlmsise00 take them from the standard library and so from the system, whose rounding is its own. Defined here and
//! hidden, they are found before the system's and stay inside the library.
#![allow(unsafe_code, reason = "defines symbols of the C library")]

use core::arch::global_asm;

#[cfg(target_arch = "x86_64")]
macro_rules! jump {
    () => {
        "jmp {function}"
    };
}
#[cfg(target_arch = "aarch64")]
macro_rules! jump {
    () => {
        "b {function}"
    };
}

macro_rules! functions {
    ($($symbol:literal = $function:ident($of_physics:path);)+) => {$(
        #[cfg(target_os = "linux")]
        global_asm!(
            concat!(".globl ", $symbol),
            concat!(".hidden ", $symbol),
            concat!(".type ", $symbol, ", @function"),
            concat!($symbol, ":"),
            jump!(),
            function = sym $function,
        );
        // COFF has no visibility: a DLL exports only listed symbols.
        #[cfg(target_os = "windows")]
        global_asm!(
            concat!(".globl ", $symbol),
            concat!($symbol, ":"),
            jump!(),
            function = sym $function,
        );

        extern "C" fn $function(angle_rad: f64) -> f64 {
            $of_physics(angle_rad)
        }
    )+};
}

functions! {
    "sin" = sine(physics::math::sin);
    "cos" = cosine(physics::math::cos);
}
