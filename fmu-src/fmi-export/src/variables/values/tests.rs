//! Who gave a value, where its start value is among those that may be given.
use super::*;

const GROUP: [Elements; 2] = [
    Elements { first: Element { base: BaseType::Real, place: 0 }, count: 2 },
    Elements { first: Element { base: BaseType::Integer, place: 0 }, count: 1 },
];

/// Two Reals, an Integer, and one Real that the setup may give.
fn start(by_setup: bool) -> Values {
    let mut start = Values { reals: vec![1.0, 2.0, 3.0], integers: vec![7], ..Values::default() };
    start.mark_none();
    if by_setup {
        start.give(1, Value::Real(2.5));
    }
    start
}

fn set_real(values: &mut Values, place: usize, value: f64) {
    values.reals[place] = value;
    values.set[0].mark(place);
}

fn fresh(start: &Values) -> Values {
    let mut values = start.clone();
    values.mark_none();
    values
}

#[test]
fn a_value_set_to_its_start_value_is_given() {
    let start = start(false);
    let mut values = fresh(&start);
    set_real(&mut values, 1, 2.0);
    let given = Given::among(&values, &start, &GROUP);
    assert_eq!([0, 1, 2].map(|at| given.has(Real(at))), [false, true, false]);
    assert!(given.has(RealVector::<2>(0)) && !given.has(Integer(0)));
    assert_eq!([0, 1].map(|at| given.real_or(Real(at), 9.0)), [9.0, 2.0]);
}

#[test]
fn a_group_that_is_written_throughout_is_given_only_if_one_differs() {
    let start = start(false);
    let mut values = fresh(&start);
    set_real(&mut values, 0, 1.0);
    set_real(&mut values, 1, 2.0);
    values.set[1].mark(0);
    assert!(!Given::among(&values, &start, &GROUP).has(Real(0)));
    values.integers[0] = 8;
    assert!(Given::among(&values, &start, &GROUP).has(Real(0)));
}

#[test]
fn what_the_setup_gives_is_given_whoever_writes_it() {
    let start = start(true);
    let mut values = fresh(&start);
    assert!(Given::among(&values, &start, &GROUP).has(Real(1)));
    set_real(&mut values, 0, 1.0);
    set_real(&mut values, 1, 2.5);
    values.set[1].mark(0);
    let given = Given::among(&values, &start, &GROUP);
    assert_eq!([0, 1].map(|at| given.has(Real(at))), [false, true]);
}
