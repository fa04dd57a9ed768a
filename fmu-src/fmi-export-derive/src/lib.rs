//! `#[derive(Variables)]` and `#[derive(Enumeration)]`: declarations checked where they are written.
//!
//! The unit table, the role rules and the name grammar are those of `model-description`, so that what
//! compiles here also passes the builder and the validator.

mod attribute;
mod check;
mod enumeration;
mod field;
mod source;
mod variables;

use proc_macro::TokenStream;
use syn::{DeriveInput, parse_macro_input};

/// Declares the fields of a struct as FMI variables: implements `fmi_export::Variables` and `fmi_export::Section`.
///
/// `#[variables(setup = Type)]` on the struct names the type `setup` has in expressions; without it that is `Setup`, and a struct
/// that does not mention `setup` serves every setup type. `#[variables(label = expression)]` begins the descriptions of its variables with what the user
/// calls the group. Expressions may use `setup: &Type` and `index: usize`, the 0-based
/// position in the innermost `Vec` of groups around the struct (0 outside of any).
///
/// One attribute a field: `#[parameter]`, `#[calculated_parameter]`, `#[input]`, `#[output]`, `#[local]`
/// on a `Real`, `RealVector<N>`, `RealMatrix<R, C>`, `Integer`, `Boolean`, `Text` or `Choice<E>`; the doc
/// comment becomes the description. Inside, separated by commas:
///
/// | item | meaning |
/// |---|---|
/// | `constant`, `fixed`, `tunable`, `discrete`, `continuous` | variability; the default is fixed for parameters, continuous for other Reals, discrete for the rest |
/// | `initial = exact` (`approx`, `calculated`) | `initial`, where it differs from the standard's default |
/// | `start = expression` | start value: `f64`, `[f64; N]`, `[[f64; C]; R]`, `i32`, `bool`, text or a variant |
/// | `unit = "m"`, `display = "km"` | unit (required for Reals) and display unit, from the unit table |
/// | `min`, `max` | limits of a Real or an Integer |
/// | `nominal` | nominal value of a Real |
/// | `name = "a.b"` | name within the group; the default is the field's in lowerCamelCase |
///
/// Relations to other variables follow in `#[annotation(also_called = "...", limited_by = "...", role = "epoch", interpolation =
/// "attitude", rate = "...")]` and `#[read_where(option = "...", items = "one two", set = "one")]`, with full names as in
/// `fmi_export::variables::Annotation`: `wheel[k].capacity` is of the same wheel, `dump.threshold[i]` the element of equal index.
///
/// A struct that derives `Variables` is nested under the field's name; `#[group(name = "a.b")]` gives another, and `name = ""`
/// adds no prefix.
/// `#[group(count = expression)]` on a `Vec` declares as many groups `name[1].`, `name[2].`, and
/// `setup = expression` hands the group another setup, in which `index` counts the elements.
#[proc_macro_derive(
    Variables,
    attributes(
        variables,
        parameter,
        calculated_parameter,
        input,
        output,
        local,
        annotation,
        read_where,
        group
    )
)]
pub fn variables(item: TokenStream) -> TokenStream {
    let input = parse_macro_input!(item as DeriveInput);
    variables::expand(&input).unwrap_or_else(|error| error.into_compile_error()).into()
}

/// Offers a fieldless enum as an FMI enumeration: implements `fmi_export::Enumeration`.
///
/// The type definition has the enum's name, the items the variants' names in lowerCamelCase; doc comments
/// become descriptions. `#[enumeration(name = "other")]` renames the type or an item. Item values are the
/// discriminants where given and otherwise count on from the item before, the first being 1.
#[proc_macro_derive(Enumeration, attributes(enumeration))]
pub fn enumeration(item: TokenStream) -> TokenStream {
    let input = parse_macro_input!(item as DeriveInput);
    enumeration::expand(&input).unwrap_or_else(|error| error.into_compile_error()).into()
}
