//! Differences against what was calculated by hand.

use super::*;

fn column(name: &str, cells: [(&str, &str); 3]) -> Compared {
    let of = |it: fn(&(&str, &str)) -> String| cells.iter().map(|pair| Cell::of_text(&it(pair))).collect();
    Compared {
        name: name.to_owned(),
        expected: of(|pair| pair.0.to_owned()),
        found: of(|pair| pair.1.to_owned()),
    }
}

fn found(columns: &[Compared]) -> Vec<(String, usize, f64, f64)> {
    differences(columns).into_iter().map(|it| (it.name, it.row, it.absolute, it.fraction)).collect()
}

#[test]
fn what_is_the_same_differs_by_nothing() {
    let same = [
        column("x", [("1", "1.0"), ("-0", "0"), ("1e3", "1000")]),
        column("b", [("true", "1"), ("false", "0"), ("1", "true")]),
        column("s", [("nadir", "nadir"), ("", ""), ("NaN", "NaN")]),
        column("i", [("inf", "inf"), ("-inf", "-inf"), ("0", "0")]),
    ];
    assert_eq!(found(&same), []);
}

#[test]
fn a_component_is_held_against_its_vector() {
    let columns = [
        column("h[1]", [("1", "1.5"), ("2", "2"), ("4", "3")]),
        column("h[2]", [("8", "8"), ("-10", "-10"), ("0", "0")]),
        column("h[1].final", [("1", "1"), ("2", "2.5"), ("2", "2")]),
        column("h[2].final", [("5", "5"), ("0", "0"), ("0", "0")]),
        column("h[1].min", [("1", "1"), ("2", "2.5"), ("2", "2")]),
        column("zero", [("0", "0"), ("0", "1e-300"), ("0", "0")]),
    ];
    let expected = [
        ("h[1]", 2, 1.0, 0.1),
        ("h[1].final", 1, 0.5, 0.1),
        ("h[1].min", 1, 0.5, 0.25),
        ("zero", 1, 1e-300, f64::INFINITY),
    ];
    assert_eq!(found(&columns), expected.map(|(name, row, it, part)| (name.to_owned(), row, it, part)));
}

#[test]
fn what_is_no_number_is_as_far_off_as_can_be() {
    for (expected, other) in
        [("", "2"), ("2", ""), ("NaN", "2"), ("inf", "2"), ("inf", "-inf"), ("ok", "limit")]
    {
        let [difference] = &found(&[column("x", [("1", "1"), (expected, other), ("3", "3.5")])])[..] else {
            panic!("{expected} {other}");
        };
        assert_eq!((difference.1, difference.2), (1, f64::INFINITY), "{expected} {other}");
    }
}
