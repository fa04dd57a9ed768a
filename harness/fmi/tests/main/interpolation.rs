//! Attitudes, angles and orbits between the rows of a table: closed forms of motions, and how errors fall with the rows' spacing.

use std::f64::consts::TAU;

use fmi::InputTable;
use model_description::{
    Annotation, Causality, InterpolationKind, Variability, VariableKind, annotation::TOOL,
};

use crate::{description, folder, real};

const Q: [(&str, &str); 4] = [("c.q[1]", "1"), ("c.q[2]", "1"), ("c.q[3]", "1"), ("c.q[4]", "1")];
const RATE: [(&str, &str); 3] = [("c.rate[1]", "rad/s"), ("c.rate[2]", "rad/s"), ("c.rate[3]", "rad/s")];

/// Annotations of these inputs: attitudes, positions and their rates.
fn annotation(name: &str) -> Option<Annotation> {
    let (interpolation, rate) = match name {
        "c.q[1]" | "c.q[2]" | "c.q[3]" | "c.q[4]" => (InterpolationKind::Attitude, "c.rate"),
        "o.position[1]" => (InterpolationKind::Position, "o.velocity[1]"),
        "p.position" => (InterpolationKind::Position, "p.velocity"),
        "turn" => (InterpolationKind::Angle, ""),
        _ => return None,
    };
    let rate = Some(rate).filter(|rate| !rate.is_empty()).map(str::to_owned);
    Some(Annotation { interpolation: Some(interpolation), rate, ..Annotation::default() })
}

/// A table of continuous inputs with these names and units, if any; angles named `narrow` range over half a turn either way.
fn table(columns: &[(&str, &str)], rows: &[(f64, Vec<f64>)]) -> InputTable {
    let mut description = description();
    for (number, (name, unit)) in columns.iter().enumerate() {
        let mut input = real(name, 100 + number as u32, Causality::Input, Variability::Continuous);
        if let VariableKind::Real { attributes, .. } = &mut input.kind {
            attributes.unit = Some((*unit).to_owned()).filter(|unit| !unit.is_empty());
            attributes.display_unit = None;
            if *name == "narrow" {
                (attributes.min, attributes.max) = (Some(-TAU / 2.0), Some(TAU / 2.0));
            }
        }
        input.annotation = annotation(name).map(Box::new);
        description.variables.push(input);
    }
    description.annotation_tool = Some(TOOL.to_owned());
    let (_folder, fmu) = folder(&description);
    let header: Vec<&str> = ["time"].into_iter().chain(columns.iter().map(|(name, _)| *name)).collect();
    let cells =
        |(time_s, row): &(f64, Vec<f64>)| [time_s].into_iter().chain(row).map(f64::to_string).collect();
    let rows: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let rows: Vec<Vec<&str>> = rows.iter().map(|row| row.iter().map(String::as_str).collect()).collect();
    InputTable::parse(fmu.description(), &header, &rows).unwrap()
}

fn values<const N: usize>(table: &InputTable, first: usize, time_s: f64) -> [f64; N] {
    std::array::from_fn(|i| table.value(first + i, time_s).to_f64())
}

/// Attitude and body rate of a body that spins by 0.02 rad/s about its x axis, which goes round the inertial z axis by 0.03 rad/s.
fn coning(time_s: f64) -> ([f64; 4], [f64; 3]) {
    let (spin, precession) = (0.02, 0.03);
    let ((sx, cx), (sz, cz)) = ((0.5 * spin * time_s).sin_cos(), (0.5 * precession * time_s).sin_cos());
    let (sine, cosine) = (spin * time_s).sin_cos();
    ([cz * sx, sz * sx, sz * cx, cz * cx], [spin, precession * sine, precession * cosine])
}

fn angle_rad(one: [f64; 4], other: [f64; 4]) -> f64 {
    let chord = |sign: f64| (0..4).map(|i| (one[i] - sign * other[i]).powi(2)).sum::<f64>().sqrt();
    4.0 * (chord(1.0).min(chord(-1.0)) / 2.0).asin()
}

/// Largest errors of attitude and body rate between rows of the coning that are so far apart and of any sign.
fn coning_errors(spacing_s: f64, has_rates: bool) -> [f64; 2] {
    let row = |k: i32| {
        let (q, rate) = coning(f64::from(k) * spacing_s);
        // Signs as they come where the scalar is never negative, and worse.
        let sign = if k % 3 == 1 || q[3] < 0.0 { -1.0 } else { 1.0 };
        let q = q.iter().map(|element| sign * element);
        (f64::from(k) * spacing_s, q.chain(rate.into_iter().filter(|_| has_rates)).collect())
    };
    let rows: Vec<(f64, Vec<f64>)> = (0..=(240.0 / spacing_s) as i32).map(row).collect();
    let columns = if has_rates { [&Q[..], &RATE].concat() } else { Q.to_vec() };
    let table = table(&columns, &rows);
    let mut largest = [0.0_f64; 2];
    let mut before: Option<[f64; 4]> = None;
    for time_s in (0..2400).map(|k| f64::from(k) * 0.1) {
        let found: [f64; 4] = values(&table, 0, time_s);
        let (q, rate) = coning(time_s);
        largest[0] = largest[0].max(angle_rad(found, q));
        assert!((found.iter().map(|it| it * it).sum::<f64>() - 1.0).abs() < 1e-12);
        // One sign all along.
        assert!(before.is_none_or(|before| (0..4).all(|i| (before[i] - found[i]).abs() < 0.01)), "{time_s}");
        before = Some(found);
        if has_rates {
            let found: [f64; 3] = values(&table, 4, time_s);
            let error = (0..3).map(|i| (found[i] - rate[i]).abs()).fold(0.0, f64::max);
            largest[1] = largest[1].max(error);
        }
    }
    largest
}

#[test]
fn turns_are_followed_to_the_order_of_their_rows() {
    let [alone, by_rates] = [false, true].map(|has_rates| [8.0, 4.0].map(|it| coning_errors(it, has_rates)));
    assert!(alone[0][0] / alone[1][0] > 3.5, "{alone:?}");
    assert!(by_rates[0][0] / by_rates[1][0] > 12.0, "{by_rates:?}");
    // A cubic's slope is of third order.
    assert!(by_rates[0][1] / by_rates[1][1] > 7.0, "{by_rates:?}");
    assert!(by_rates[1][0] < 1e-5 && alone[1][0] < 2e-3, "{alone:?} {by_rates:?}");
}

#[test]
fn a_turn_of_constant_rate_is_exact_from_rows_far_apart() {
    // 60 deg a row about (2, -1, 2) / 3, of lengths that grow from 1 to 2, one of them of the other sign.
    let q = |turn_rad: f64| {
        let (sine, cosine) = (turn_rad / 2.0).sin_cos();
        [sine * 2.0 / 3.0, -sine / 3.0, sine * 2.0 / 3.0, cosine]
    };
    let row = |k: i32| {
        let (share, sign) = (f64::from(k), if k == 1 { -1.0 } else { 1.0 });
        (10.0 * share, q(share * TAU / 6.0).map(|it| sign * it * (1.0 + share / 2.0)).to_vec())
    };
    let table = table(&Q, &[row(0), row(1), row(2)]);
    for time_s in [0.0, 1.0, 5.0, 9.99, 10.0, 13.0, 20.0, 25.0] {
        let (share, found) = (f64::min(time_s, 20.0) / 10.0, values::<4>(&table, 0, time_s));
        let expected = q(share * TAU / 6.0).map(|it| it * (1.0 + share / 2.0));
        assert!((0..4).all(|i| (found[i] - expected[i]).abs() < 1e-12), "{time_s}: {found:?}, {expected:?}");
    }
    let [line] = &table.coarse_turns()[..] else { panic!("{:?}", table.coarse_turns()) };
    assert!(line.starts_with("c.q turns by 60.0 deg from ") && line.contains("c.rate"), "{line}");
}

#[test]
fn attitudes_with_rates_or_rows_close_by_are_not_named() {
    let rows = |spacing_s: f64, has_rates: bool| -> Vec<(f64, Vec<f64>)> {
        let row = |k: i32| {
            let (q, rate) = coning(f64::from(k) * spacing_s);
            (f64::from(k) * spacing_s, q.into_iter().chain(rate.into_iter().filter(|_| has_rates)).collect())
        };
        (0..4).map(row).collect()
    };
    assert!(table(&[&Q[..], &RATE].concat(), &rows(30.0, true)).coarse_turns().is_empty());
    assert!(table(&Q, &rows(0.4, false)).coarse_turns().is_empty());
    // A jump is no gap, and a quaternion of zeros no attitude.
    let rows = [(0.0, vec![0.0; 4]), (1.0, vec![0.0, 0.0, 0.0, 1.0]), (1.0, vec![1.0, 0.0, 0.0, 0.0])];
    let jump = table(&Q, &rows);
    assert!(jump.coarse_turns().is_empty());
    assert_eq!(values::<4>(&jump, 0, 0.5), [0.0; 4]);
    assert_eq!(values::<4>(&jump, 0, 1.0), [1.0, 0.0, 0.0, 0.0]);
}

#[test]
fn angles_take_the_nearest_turn_within_their_range() {
    let columns = [("narrow", "rad"), ("panel.angle", "rad"), ("wheel.angle", "rad"), ("orbit.phase", "rad")];
    let deg = |row: [f64; 4]| row.map(f64::to_radians).to_vec();
    let rows = [
        (0.0, deg([170.0, 350.0, 0.0, 0.0])),
        (10.0, deg([-170.0, 10.0, 300.0, 360.0])),
        (20.0, deg([170.0, 350.0, 600.0, 360.0])),
    ];
    let table = table(&columns, &rows);
    for (time_s, expected) in [
        (0.0, [170.0, 350.0, 0.0, 0.0]),
        (2.0, [174.0, 354.0, 60.0, 72.0]),
        // Past half a turn the range of one goes on from the other side; the other counts on.
        (8.0, [-174.0, 366.0, 240.0, 288.0]),
        (10.0, [-170.0, 370.0, 300.0, 360.0]),
        (12.0, [-174.0, 366.0, 360.0, 360.0]),
        (18.0, [174.0, 354.0, 540.0, 360.0]),
        (20.0, [170.0, 350.0, 600.0, 360.0]),
    ] {
        let found = values::<4>(&table, 0, time_s).map(f64::to_degrees);
        assert!((0..4).all(|i| (found[i] - expected[i]).abs() < 1e-9), "{time_s}: {found:?}, {expected:?}");
    }
    // 20 deg in 10 s, across the edge of the range too.
    let slope = table.slope(0, [2.0, 8.0]).unwrap().to_degrees();
    assert!((slope - 2.0).abs() < 1e-9, "{slope}");
}

#[test]
fn names_alone_say_nothing_and_an_annotated_angle_needs_no_unit() {
    let columns =
        [("d.q[1]", "1"), ("d.q[2]", "1"), ("d.q[3]", "1"), ("d.q[4]", "1"), ("turn", ""), ("bare", "")];
    let rows = [(0.0, vec![0.0, 0.0, 0.0, 1.0, 3.0, 3.0]), (10.0, vec![1.0, 0.0, 0.0, 0.0, -3.0, -3.0])];
    let found = values::<6>(&table(&columns, &rows), 0, 5.0);
    assert_eq!(found, [0.5, 0.0, 0.0, 0.5, TAU / 2.0, 0.0]);
}

#[test]
fn positions_beside_velocities_are_cubics_and_slopes_reach_them() {
    // x = t^3 - 2 t^2 + 5 is its own cubic; without a velocity, or beside one in another unit, it is a line.
    let columns =
        [("o.position[1]", "m"), ("o.velocity[1]", "m/s"), ("p.position", "m"), ("p.velocity", "km/s")];
    let x = |time_s: f64| time_s.powi(3) - 2.0 * time_s.powi(2) + 5.0;
    let v = |time_s: f64| 3.0 * time_s.powi(2) - 4.0 * time_s;
    let row = |time_s: f64| (time_s, vec![x(time_s), v(time_s), x(time_s), v(time_s)]);
    let table = table(&columns, &[row(0.0), row(2.0), row(5.0)]);
    for time_s in [0.0, 0.3, 1.0, 2.0, 4.5, 5.0] {
        let [position, velocity, line, _] = values::<4>(&table, 0, time_s);
        assert!((position - x(time_s)).abs() < 1e-12 && (velocity - v(time_s)).abs() < 1e-12, "{time_s}");
        assert_eq!(line == position, [0.0, 2.0, 5.0].contains(&time_s), "{time_s}");
    }
    // Straight motion has the bits of a line, as masters have it that know no velocities.
    let straight = |time_s: f64, x: f64| (time_s, vec![x, -200.0, x, -200.0]);
    let line = self::table(&columns, &[straight(0.0, 1e8), straight(15.0, 1e8 - 3000.0)]);
    for time_s in (0..150).map(|k| f64::from(k) * 0.1) {
        let [cubic, velocity, linear, _] = values::<4>(&line, 0, time_s);
        assert_eq!((cubic.to_bits(), velocity), (linear.to_bits(), -200.0), "{time_s}");
    }
    for step_s in [[0.0, 0.5], [1.5, 2.5], [4.0, 6.0], [2.0, 5.0]] {
        for column in 0..4 {
            let [start, end] = step_s.map(|time_s| table.value(column, time_s).to_f64());
            let reached = start + table.slope(column, step_s).unwrap() * (step_s[1] - step_s[0]);
            assert!((reached - end).abs() < 1e-12, "{step_s:?}: {reached}, {end}");
        }
    }
}
