//! The extent of the crate's tests.

/// Selects the extent of a test: `long` in `cargo xtask test --long`, which sets the variable, else `short`.
pub(crate) fn short_or_long<T>(short: T, long: T) -> T {
    if std::env::var_os("HELIOTORQUE_LONG").is_some() { long } else { short }
}
