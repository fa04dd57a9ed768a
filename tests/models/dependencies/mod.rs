//! Dependencies are declared in `ModelStructure`: at random states a known is changed, and every unknown that follows lists it.
//! More than that may be declared; longer searches run in `cargo xtask test --long`.

mod bench;
mod draw;
mod models;
mod variable;
