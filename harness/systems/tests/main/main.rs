//! Systems as they are read, refused and wired; FMUs are descriptions without a library.

mod refused;
mod support;
mod wired;
