//! Mistakes that only a setup can bring about are errors of the builder that name the variable.

use fmi_export::variables::{Causality, RealSpec, Role, ScalarSpec, Variability};
use fmi_export::{Choice, Declare, DeclareError, Enumeration, Integer, Real, RealVector, Text, Variables};

#[derive(Default)]
struct Setup {
    start_kg: f64,
    vector_m: [f64; 3],
    max_m: f64,
    nominal: f64,
    count: i32,
    label: String,
}

/// A setup that is accepted, changed by `change`.
fn declare(change: impl FnOnce(&mut Setup)) -> Result<(), DeclareError> {
    let mut setup = Setup { max_m: 1.0, nominal: 1.0, ..Setup::default() };
    change(&mut setup);
    Outer::declare(&mut Declare::new(), &setup, 0).map(|_| ())
}

#[derive(Variables)]
#[variables(setup = Setup)]
#[allow(dead_code, reason = "declared only")]
struct Outer {
    #[group]
    vehicle: Vehicle,
}

#[derive(Variables)]
#[variables(setup = Setup)]
#[allow(dead_code, reason = "declared only")]
struct Vehicle {
    /// A mass.
    #[parameter(unit = "kg", min = 0.0, nominal = setup.nominal, start = setup.start_kg)]
    mass: Real,
    /// A place.
    #[parameter(unit = "m", min = -1.0, max = setup.max_m, start = setup.vector_m)]
    place: RealVector<3>,
    /// A number.
    #[parameter(max = 7, start = setup.count)]
    count: Integer,
    /// A text.
    #[parameter(start = &setup.label)]
    label: Text,
}

fn refusal<T>(result: Result<T, DeclareError>) -> String {
    result.err().expect("refused").to_string()
}

#[test]
fn values_of_the_setup_are_checked_as_literals_are() {
    declare(|_| ()).unwrap();
    for (found, named) in [
        (declare(|it| it.start_kg = -1.0), "`vehicle.mass`: start -1 is below min 0"),
        (declare(|it| it.start_kg = f64::NAN), "`vehicle.mass`: start is NaN; it must be finite"),
        (declare(|it| it.nominal = 0.0), "`vehicle.mass`: nominal is 0; it must be above 0"),
        (declare(|it| it.vector_m[1] = 2.0), "`vehicle.place[2]`: start 2 is above max 1"),
        (declare(|it| it.max_m = -2.0), "`vehicle.place[1]`: min -1 is above max -2"),
        (declare(|it| it.max_m = f64::INFINITY), "`vehicle.place[1]`: max is inf; it must be finite"),
        (declare(|it| it.count = 8), "`vehicle.count`: start 8 is above max 7"),
        (declare(|it| it.label = "a\0b".to_owned()), "`vehicle.label`: start holds the character '\\0'"),
    ] {
        let found = refusal(found);
        assert!(found.contains(named), "{found}");
    }
}

#[derive(Variables)]
#[allow(dead_code, reason = "declared only")]
struct Same {
    /// One.
    #[output(unit = "1", name = "group.angle")]
    first: Real,
    #[group(name = "group")]
    group: Angle,
}

#[derive(Variables)]
#[allow(dead_code, reason = "declared only")]
struct Angle {
    /// Another.
    #[output(unit = "1")]
    angle: Real,
}

#[test]
fn names_are_unique_across_groups() {
    let found = refusal(Same::declare(&mut Declare::new(), &(), 0));
    assert_eq!(found, "variable `group.angle`: is declared twice");
}

mod one {
    /// A choice.
    #[derive(Clone, Copy, fmi_export::Enumeration)]
    pub(super) enum Mode {
        /// An item.
        On,
    }
}

mod other {
    /// Another choice of the same name.
    #[derive(Clone, Copy, fmi_export::Enumeration)]
    pub(super) enum Mode {
        /// Other item.
        Off,
    }
}

#[derive(Variables)]
#[allow(dead_code, reason = "declared only")]
struct Modes<A: Enumeration, B: Enumeration> {
    /// One.
    #[output]
    first: Choice<A>,
    /// Two.
    #[output]
    second: Choice<B>,
}

#[derive(Variables)]
#[allow(dead_code, reason = "declared only")]
struct NamedAsType {
    /// One.
    #[output]
    first: Choice<one::Mode>,
    /// Named as the type of the first.
    #[output(unit = "1", name = "Mode")]
    second: Real,
}

#[test]
fn type_names_mean_one_type_and_no_variable() {
    assert!(Modes::<one::Mode, one::Mode>::declare(&mut Declare::new(), &(), 0).is_ok());
    let found = refusal(Modes::<one::Mode, other::Mode>::declare(&mut Declare::new(), &(), 0));
    assert_eq!(found, "variable `second`: two different enumerations are named `Mode`");
    let found = refusal(NamedAsType::declare(&mut Declare::new(), &(), 0));
    assert_eq!(found, "variable `Mode`: an enumeration type has this name");
}

#[derive(Variables)]
#[allow(dead_code, reason = "declared only")]
struct Chosen<E: Enumeration> {
    /// A choice.
    #[input(start = E::from_value(1).unwrap())]
    kind: Choice<E>,
}

mod with_none {
    /// A mode.
    #[derive(Clone, Copy, fmi_export::Enumeration)]
    pub(super) enum Mode {
        /// Not chosen yet.
        None = 0,
        /// On.
        On,
    }
}

#[test]
fn an_enumeration_that_is_an_input_accepts_the_zero_that_masters_send() {
    assert!(Chosen::<with_none::Mode>::declare(&mut Declare::new(), &(), 0).is_ok());
    let found = refusal(Chosen::<one::Mode>::declare(&mut Declare::new(), &(), 0));
    assert_eq!(
        found,
        "variable `kind`: is an input whose enumeration has no item 0 `none`, which masters send first"
    );
}

#[test]
fn the_builder_checks_roles_by_itself() {
    let role = |causality, variability| Role { causality, variability, initial: None };
    let real = |role, start| {
        let spec = RealSpec {
            name: "x",
            description: "A value.",
            role,
            unit: "1",
            display_unit: None,
            min: None,
            max: None,
            nominal: None,
        };
        Declare::new().real(&spec, start)
    };
    let input = role(Causality::Input, Variability::Continuous);
    assert!(real(input, Some(0.0)).is_ok());
    assert_eq!(refusal(real(input, None)), "variable `x`: needs a start value");
    let output = role(Causality::Output, Variability::Continuous);
    assert!(refusal(real(output, Some(0.0))).contains("cannot have a start value"));
    let pair = role(Causality::Parameter, Variability::Discrete);
    assert!(refusal(real(pair, Some(0.0))).contains("parameter cannot be discrete; allowed: fixed, tunable"));
    let spec = ScalarSpec { name: "n", description: "A number.", role: output };
    assert!(refusal(Declare::new().integer(&spec, None, None, None)).contains("only a Real"));
    let spec =
        ScalarSpec { name: "n 1", description: "", role: role(Causality::Output, Variability::Discrete) };
    assert!(refusal(Declare::new().boolean(&spec, None)).contains("`n 1`: the name has ' '"));
    let spec = ScalarSpec { name: "n", ..spec };
    assert_eq!(refusal(Declare::new().boolean(&spec, None)), "variable `n`: needs a description");
}
