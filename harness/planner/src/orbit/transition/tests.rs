//! Transition matrices are central differences of propagated paths, and symplectic.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use physics::bodies::Body;
use physics::constants::{DAY_S, GM_MERCURY_M3_S2, RADIUS_MERCURY_M};
use physics::environment::CartesianState;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::orbit::{
    Attractor, BodyEphemeris, DisturbedOrbit, GravityModel, NBodyGravity, NBodySettings, OrbitMethod,
    TwoBodyOrbit,
};
use physics::numerics::Span;

use super::{partials_over, transition};

/// Gradient toward Mercury alone, 1/s2.
fn gradient_per_s2(position_m: &Vector3<f64>) -> Matrix3<f64> {
    let (r, r_m) = (position_m, position_m.norm());
    (r * r.transpose() * (3.0 / (r_m * r_m)) - Matrix3::identity()) * (GM_MERCURY_M3_S2 / r_m.powi(3))
}

fn packed(state: &CartesianState) -> Vector6<f64> {
    let (r, v) = (state.position_m, state.velocity_m_s);
    Vector6::new(r.x, r.y, r.z, v.x, v.y, v.z)
}

fn moved(state: &CartesianState, axis: usize, step: f64) -> CartesianState {
    let mut moved = *state;
    let part = if axis < 3 { &mut moved.position_m } else { &mut moved.velocity_m_s };
    part[axis % 3] += step;
    moved
}

/// Differences of propagated states, extrapolated from two steps (m, m/s).
fn differences(
    start: &CartesianState,
    [step_m, step_m_s]: [f64; 2],
    mut propagated: impl FnMut(&CartesianState) -> CartesianState,
) -> Matrix6<f64> {
    let mut matrix = Matrix6::zeros();
    for axis in 0..6 {
        let step = if axis < 3 { step_m } else { step_m_s };
        let [near, far] = [step, 2.0 * step].map(|step| {
            let [after, before] = [step, -step].map(|step| packed(&propagated(&moved(start, axis, step))));
            (after - before) / (2.0 * step)
        });
        matrix.set_column(axis, &(near + (near - far) / 3.0));
    }
    matrix
}

/// The greatest difference over the size of each block of three by three.
fn off(found: &Matrix6<f64>, expected: &Matrix6<f64>) -> f64 {
    let blocks = [(0, 0), (0, 3), (3, 0), (3, 3)].map(|(row, column)| {
        let [found, expected] = [found, expected].map(|it| it.fixed_view::<3, 3>(row, column).into_owned());
        (found - expected).norm() / expected.norm()
    });
    blocks.into_iter().fold(0.0, f64::max)
}

/// J in units in which both parts of the state are alike.
fn off_symplectic(matrix: &Matrix6<f64>, time_s: f64) -> f64 {
    let mut scale = Matrix6::identity();
    (3..6).for_each(|axis| scale[(axis, axis)] = time_s);
    let scaled = scale * matrix * scale.try_inverse().unwrap();
    let mut j = Matrix6::zeros();
    j.fixed_view_mut::<3, 3>(0, 3).copy_from(&Matrix3::identity());
    j.fixed_view_mut::<3, 3>(3, 0).copy_from(&-Matrix3::identity());
    (scaled.transpose() * j * scaled - j).norm() / scaled.norm()
}

#[test]
fn a_hyperbola_within_a_third_of_its_distance_over_speed_is_held_to_1e_9() {
    let start = CartesianState {
        position_m: Vector3::new(-2.2e7, 1.9e7, 4e6),
        velocity_m_s: Vector3::new(4.1e3, -3.1e3, -1.0e3),
    };
    let orbit = TwoBodyOrbit::from_state(&start, GM_MERCURY_M3_S2, 0.0).unwrap();
    let method = OrbitMethod::default();
    let gradient = |at_s: f64| gradient_per_s2(&orbit.state_at(at_s).position_m);
    let (mut at_s, mut whole) = (0.0, Matrix6::identity());
    let mut cells = Vec::new();
    while at_s < 9000.0 {
        let state = orbit.state_at(at_s);
        let end_s = 9000_f64.min(at_s + 0.3 * state.position_m.norm() / state.velocity_m_s.norm());
        whole = transition(&method, Span::new(at_s, end_s), gradient).unwrap() * whole;
        cells.push(Span::new(at_s, end_s));
        at_s = end_s;
    }
    assert!(off_symplectic(&whole, 1000.0) < 1e-9);
    let expected = differences(&start, [30.0, 5e-3], |state| {
        TwoBodyOrbit::from_state(state, GM_MERCURY_M3_S2, 0.0).unwrap().state_at(9000.0)
    });
    assert!(off(&whole, &expected) < 2e-7, "{}", off(&whole, &expected));
    // Backward the same matrix, at any time within; many short intervals say the same to 1e-9.
    let mut back = Matrix6::identity();
    for span in cells.iter().rev() {
        let partials = partials_over(&method, *span, &back, gradient).unwrap();
        let middle_s = 0.5 * (span.start_s + span.end_s);
        let rest = transition(&method, Span::new(middle_s, span.end_s), gradient).unwrap();
        assert!(off(&partials.at(middle_s), &(back * rest)) < 1e-8);
        assert_eq!(partials.at(span.start_s), partials.at_start);
        back = partials.at_start;
    }
    let mut fine = Matrix6::identity();
    for piece in 0..900 {
        let start_s = 10.0 * f64::from(piece);
        let span = Span::new(start_s, start_s + 10.0);
        fine = transition(&method, span, gradient).unwrap() * fine;
    }
    assert!(off(&back, &fine) < 1e-9 && off(&whole, &fine) < 1e-9, "{}", off(&whole, &fine));
}

/// The planets by a clock that begins ten days before the second flyby of Mercury.
#[derive(Default)]
struct Sky(Ephemeris);

impl Sky {
    const ZERO_S: f64 = 276_640_800.0 - 10.0 * DAY_S;
}

impl BodyEphemeris for Sky {
    fn heliocentric(&mut self, body: Body, at_s: f64) -> CartesianState {
        self.0.state(body, Self::ZERO_S + at_s)
    }

    fn smooth_until_s(&self, at_s: f64) -> f64 {
        Ephemeris::smooth_until_s(Self::ZERO_S + at_s) - Self::ZERO_S
    }

    fn moon_from_earth_m(&mut self, at_s: f64) -> Vector3<f64> {
        self.0.moon_from_earth(Self::ZERO_S + at_s).position_m
    }
}

/// Along the path of a flight, cell by cell, about whatever body that is integrated.
#[test]
fn over_a_flyby_between_bodies_it_is_what_propagated_paths_differ_by() {
    let settings = NBodySettings { changes_center: true, cell_s: DAY_S, tolerance_m: 1e-4 };
    let bodies = [Body::Mercury, Body::Venus, Body::Jupiter];
    let rows = bodies.iter().map(|body| Attractor::point_mass(body.data()));
    let sun = Attractor::point_mass(Body::Sun.data());
    let model = GravityModel::new(Body::Sun, rows.chain([sun, Attractor::MOON]), false);
    let gravity = NBodyGravity::new(settings, model);
    let (mut sky, method, end_s) = (Sky::default(), OrbitMethod::default(), 1.5 * DAY_S);
    let mercury = sky.heliocentric(Body::Mercury, 0.6 * DAY_S);
    let radius_m = RADIUS_MERCURY_M + 2e6;
    let speed_m_s = (5.2e3_f64.powi(2) + 2.0 * GM_MERCURY_M3_S2 / radius_m).sqrt();
    let normal = mercury.position_m.cross(&mercury.velocity_m_s).normalize();
    let across = mercury.velocity_m_s.normalize();
    let velocity_m_s = across.cross(&normal) * speed_m_s;
    let hyperbola = TwoBodyOrbit::from_state(
        &CartesianState { position_m: across * radius_m, velocity_m_s },
        GM_MERCURY_M3_S2,
        0.6 * DAY_S,
    );
    let start = sky.heliocentric(Body::Mercury, 0.0) + hyperbola.unwrap().state_at(0.0);
    let mut orbit = DisturbedOrbit::between_bodies(&start, 0.0, &gravity).unwrap();
    let mut whole = Matrix6::identity();
    let none = |_: f64| Vector3::zeros();
    while orbit.end_s() < end_s {
        orbit.advance_between_bodies(end_s, &method, &gravity, &mut sky, none).unwrap();
        let cell = transition(&method, Span::new(orbit.start_s(), orbit.end_s()), |at_s| {
            gravity.model.gradient_per_s2(Body::Sun, at_s, &orbit.state_at(at_s).position_m, &mut sky)
        });
        whole = cell.unwrap() * whole;
    }
    let expected = differences(&start, [1e4, 0.1], |state| {
        let mut orbit = DisturbedOrbit::between_bodies(state, 0.0, &gravity).unwrap();
        while orbit.end_s() < end_s {
            orbit.advance_between_bodies(end_s, &method, &gravity, &mut sky, none).unwrap();
        }
        orbit.state_at(end_s)
    });
    assert!(off_symplectic(&whole, DAY_S) < 1e-9);
    assert!(off(&whole, &expected) < 2e-5, "{}", off(&whole, &expected));
    // Mercury counts for all of it: the Sun alone is another matrix.
    assert!(whole.fixed_view::<3, 3>(0, 3).norm() > 5.0 * end_s, "{whole}");
}
