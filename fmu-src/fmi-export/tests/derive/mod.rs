//! `#[derive(Variables)]` and `#[derive(Enumeration)]`: what they declare and what they refuse.

mod declared;
mod refused;

/// Every mistake that can be seen in the source is an error of the compiler, at the place of the mistake. In the long extent
/// alone: all that they use is compiled once more.
#[test]
fn mistakes_in_the_source_do_not_compile() {
    if client::short_or_long(false, true) {
        trybuild::TestCases::new().compile_fail("tests/derive/fail/*.rs");
    }
}
