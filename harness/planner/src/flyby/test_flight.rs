//! A leg to Mercury for the tests: paths by another integrator (Gragg, Bulirsch, Stoer), light as a law of the place, rows as an FMU
//! reports them.

use nalgebra::{Matrix3, Rotation3, SVector, Vector3};
use physics::{
    bodies::Body,
    constants::{ASTRONOMICAL_UNIT_M, GM_MERCURY_M3_S2, GM_SUN_M3_S2, SPEED_OF_LIGHT_M_S},
    environment::{CartesianState, ephemeris::Ephemeris, orbit::BPlane},
};

use super::flight::ForceModel;
use crate::momentum::simulated::{FlightRow, Motion, SimulatedFlight};
pub(super) use physics::constants::DAY_S;

/// A day behind the second flyby, in s past J2000, and how long before it the leg begins.
const FLYBY_S: f64 = 276_640_800.0;
pub(super) const LONG_S: f64 = 200.0 * DAY_S;
pub(super) const MASS_KG: f64 = 900.0;
/// All planets: near Mercury the plans' law has it moved by the list, the flights here by its ephemeris.
const BODIES: [Body; 5] = [Body::Mercury, Body::Venus, Body::Earth, Body::Mars, Body::Jupiter];

type State6 = SVector<f64, 6>;

/// Force of light in N, EME2000, at a time: by the way to the Sun and to the Earth, and the attitude.
pub(super) type Law = Box<dyn Fn(f64, &FlightRow) -> Vector3<f64>>;

/// Where everything is on the leg, and light.
pub(super) struct Leg {
    ephemeris: Ephemeris,
    pub law: Law,
    /// Whether the attitude turns over at 90 deg between Sun and Earth.
    pub flips: bool,
}

/// B.T, B.R and the time of closest approach.
pub(super) type Intercept = Vector3<f64>;

pub(super) fn force_model() -> ForceModel {
    ForceModel {
        body: Body::Mercury,
        gm_m3_s2: GM_MERCURY_M3_S2,
        attracting: BODIES.to_vec(),
        moon: false,
        relativity: true,
        epoch_minus_time_s: FLYBY_S - LONG_S,
        lead_s: 21_600.0,
    }
}

/// Fixed in the body frame, as strong as MESSENGER's times a factor.
pub(super) fn fixed_in_the_body(factor: f64) -> Law {
    Box::new(move |_, row| {
        let suns = (ASTRONOMICAL_UNIT_M / row.to_sun_m.norm()).powi(2);
        row.inertial_from_body * Vector3::new(1.1e-5, 7.2e-5, -0.9e-5) * (suns * factor)
    })
}

impl Leg {
    pub(super) fn new(law: Law, flips: bool) -> Self {
        Self { ephemeris: Ephemeris::default(), law, flips }
    }

    pub(super) fn body(&mut self, body: Body, at_s: f64) -> CartesianState {
        self.ephemeris.state(body, at_s + FLYBY_S - LONG_S)
    }

    /// Half a day before the flyby: about the Sun between 0.315 and 0.70 AU in Mercury's plane, B where 200 km above Mercury are.
    fn before_flyby(&mut self) -> State6 {
        let mercury = self.body(Body::Mercury, LONG_S);
        let (r, up) = (mercury.position_m, mercury.position_m.cross(&mercury.velocity_m_s).normalize());
        let (a, e) = (0.5075 * ASTRONOMICAL_UNIT_M, 0.379_31);
        let across = (GM_SUN_M3_S2 * a * (1.0 - e * e)).sqrt() / r.norm();
        let radial_squared = GM_SUN_M3_S2 * (2.0 / r.norm() - 1.0 / a) - across * across;
        let velocity = up.cross(&r.normalize()) * across - r.normalize() * radial_squared.max(0.0).sqrt();
        let excess = velocity - mercury.velocity_m_s;
        let s = excess.normalize();
        let t = s.cross(
            &(Rotation3::from_axis_angle(&Vector3::x_axis(), 23.439_291_1_f64.to_radians()) * Vector3::z()),
        );
        let aim_m = t.normalize() * -3.9e6 + s.cross(&t.normalize()) * 0.6e6;
        let before_s = 0.5 * DAY_S;
        let position_m = aim_m - excess * before_s;
        let speed = (excess.norm_squared() + 2.0 * GM_MERCURY_M3_S2 / position_m.norm()).sqrt();
        let mercury = self.body(Body::Mercury, LONG_S - before_s);
        packed(&(mercury + CartesianState { position_m, velocity_m_s: s * speed }))
    }

    /// The state at the start.
    pub(super) fn start(&mut self) -> State6 {
        let before = self.before_flyby();
        self.propagated(before, [LONG_S - 0.5 * DAY_S, 0.0])
    }

    /// A row without what the path is, the attitude being one side up.
    fn row(&mut self, at_s: f64, y: &State6, ahead: bool) -> FlightRow {
        let state = unpacked(y);
        let (to_sun_m, earth) = (-state.position_m, self.body(Body::Earth, at_s));
        let to_earth_m = earth.position_m - state.position_m;
        let y_axis = -to_sun_m.normalize();
        let z_axis = to_sun_m.cross(&to_earth_m).normalize() * if ahead { 1.0 } else { -1.0 };
        let axes = Matrix3::from_columns(&[y_axis.cross(&z_axis), y_axis, z_axis]);
        FlightRow {
            time_s: at_s,
            to_sun_m,
            to_earth_m,
            lit_fraction: 1.0,
            inertial_from_body: Rotation3::from_matrix_unchecked(axes),
            panel_angles_rad: vec![0.0; 2],
            other_torque_n_m: Vector3::zeros(),
            momentum_n_m_s: Vector3::zeros(),
            dumps: 0,
            downlink: true,
            motion: None,
        }
    }

    fn cosine(&mut self, at_s: f64, y: &State6) -> f64 {
        let row = self.row(at_s, y, true);
        row.to_sun_m.normalize().dot(&row.to_earth_m.normalize())
    }

    /// Over a time that may run back; the attitude turns over where Sun and Earth say.
    pub(super) fn propagated(&mut self, mut y: State6, [mut at_s, to_s]: [f64; 2]) -> State6 {
        while at_s != to_s {
            let left_s = to_s - at_s;
            let next_s = if left_s.abs() < DAY_S { to_s } else { at_s + DAY_S * left_s.signum() };
            let before = self.cosine(at_s, &y);
            let ahead = self.flips && self.is_ahead(at_s, next_s, &y, before);
            let reached = self.integrated(y, [at_s, next_s], ahead);
            let after = self.cosine(next_s, &reached);
            if !self.flips || before * after >= 0.0 || before.abs() < 1e-12 {
                (at_s, y) = (next_s, reached);
                continue;
            }
            // Where it comes to 90 deg, by secants.
            let (mut low, mut high) = ((at_s, before), (next_s, after));
            for _ in 0..20 {
                let flip_s = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
                let there = self.integrated(y, [at_s, flip_s], ahead);
                let found = (flip_s, self.cosine(flip_s, &there));
                if found.1.abs() < 1e-15 || found.1 == low.1 || found.1 == high.1 {
                    break;
                }
                if found.1 * low.1 > 0.0 { low = found } else { high = found }
            }
            let flip_s = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            y = self.integrated(y, [at_s, flip_s], ahead);
            // On the other side by a bit, so that it is not found again.
            let past_s = flip_s + 1e-3 * left_s.signum();
            y = self.integrated(y, [flip_s, past_s], after < 0.0);
            at_s = past_s;
        }
        y
    }

    fn is_ahead(&mut self, at_s: f64, next_s: f64, y: &State6, before: f64) -> bool {
        if before.abs() > 1e-9 {
            return before < 0.0;
        }
        let inside_s = at_s + 60.0 * (next_s - at_s).signum();
        let there = self.integrated(*y, [at_s, inside_s], before < 0.0);
        self.cosine(inside_s, &there) < 0.0
    }

    fn rate(&mut self, at_s: f64, y: &State6, ahead: bool) -> State6 {
        let (r, v) = (Vector3::new(y[0], y[1], y[2]), Vector3::new(y[3], y[4], y[5]));
        let mut sum = -r * GM_SUN_M3_S2 / r.norm().powi(3);
        // Schwarzschild's term, without which Mercury does not move as VSOP87 has it.
        let potential = GM_SUN_M3_S2 / r.norm();
        let bracket = r * (4.0 * potential - v.norm_squared()) + v * (4.0 * r.dot(&v));
        sum += bracket * potential / (SPEED_OF_LIGHT_M_S * r.norm()).powi(2);
        for body in BODIES {
            let gm = body.data().gm_m3_s2;
            let p = self.body(body, at_s).position_m;
            sum += (p - r) * gm / (p - r).norm().powi(3) - p * gm / p.norm().powi(3);
        }
        let row = self.row(at_s, y, ahead);
        sum += (self.law)(at_s, &row) / MASS_KG;
        State6::from([y[3], y[4], y[5], sum.x, sum.y, sum.z])
    }

    /// Modified midpoint with extrapolation, steps as their error requires.
    fn integrated(&mut self, mut y: State6, [mut at_s, to_s]: [f64; 2], ahead: bool) -> State6 {
        const COLUMNS: usize = 8;
        let mut step_s = (to_s - at_s).signum() * 7200.0;
        while at_s != to_s {
            let whole_s = if (to_s - at_s).abs() <= step_s.abs() { to_s - at_s } else { step_s };
            let mut last: Vec<State6> = Vec::new();
            let (mut found, mut columns) = (None, 0);
            let first = self.rate(at_s, &y, ahead);
            for column in 0..COLUMNS {
                let count = 2 * (column + 1);
                let h = whole_s / count as f64;
                let (mut before, mut now) = (y, y + first * h);
                for k in 1..count {
                    let next = before + self.rate(at_s + h * k as f64, &now, ahead) * (2.0 * h);
                    (before, now) = (now, next);
                }
                let mut row = vec![(now + before + self.rate(at_s + whole_s, &now, ahead) * h) * 0.5];
                for back in 1..=column {
                    let ratio = (count as f64 / (2 * (column + 1 - back)) as f64).powi(2);
                    row.push(row[back - 1] + (row[back - 1] - last[back - 1]) / (ratio - 1.0));
                }
                let change = if column > 0 { row[column] - row[column - 1] } else { State6::repeat(1e9) };
                let allowed_m = 2e-16 * y.fixed_rows::<3>(0).norm();
                let off_m = change.fixed_rows::<3>(0).norm().max(change.fixed_rows::<3>(3).norm() * 1e5);
                columns = column;
                last = row;
                if off_m <= 10.0 * allowed_m {
                    found = Some(last[column]);
                    break;
                }
            }
            match found {
                Some(next) => {
                    (at_s, y) = (if whole_s == to_s - at_s { to_s } else { at_s + whole_s }, next);
                    step_s = if columns < COLUMNS - 2 { 1.5 * whole_s } else { whole_s };
                }
                None if whole_s.abs() < 1.0 => {
                    (at_s, y) =
                        (if whole_s == to_s - at_s { to_s } else { at_s + whole_s }, last[COLUMNS - 1]);
                }
                None => step_s = 0.5 * whole_s,
            }
        }
        y
    }

    /// From a state on, near whose encounter the closest approach is about `about_s`: B 6 h before it, and when.
    pub(super) fn intercept(&mut self, y: State6, at_s: f64, about_s: f64) -> Intercept {
        let mut closest_s = about_s;
        let mut there = self.propagated(y, [at_s, closest_s]);
        for _ in 0..8 {
            let relative = unpacked(&there) - self.body(Body::Mercury, closest_s);
            let (r, v) = (relative.position_m, relative.velocity_m_s);
            let late_s = -r.dot(&v) / (v.norm_squared() - GM_MERCURY_M3_S2 / r.norm());
            there = self.propagated(there, [closest_s, closest_s + late_s]);
            closest_s += late_s;
            if late_s.abs() < 1e-7 {
                break;
            }
        }
        let epoch_s = closest_s - force_model().lead_s;
        let there = unpacked(&self.propagated(there, [closest_s, epoch_s]));
        let plane =
            BPlane::from_state(&(there - self.body(Body::Mercury, epoch_s)), GM_MERCURY_M3_S2).unwrap();
        Vector3::new(plane.b_t_m, plane.b_r_m, closest_s)
    }

    /// Rows an hour apart, as far as to one hour behind `to_s`.
    pub(super) fn recorded(&mut self, start: State6, to_s: f64) -> SimulatedFlight {
        self.recorded_over(start, [0.0, ((to_s / 3600.0).floor() + 1.0) * 3600.0], 3600.0)
    }

    /// Rows that are `step_s` apart, over whole steps.
    pub(super) fn recorded_over(
        &mut self,
        start: State6,
        [from_s, to_s]: [f64; 2],
        step_s: f64,
    ) -> SimulatedFlight {
        let (mut y, mut rows) = (start, Vec::new());
        for step in 0..=((to_s - from_s) / step_s).round() as usize {
            let at_s = from_s + step as f64 * step_s;
            if step > 0 {
                y = self.propagated(y, [from_s + (step - 1) as f64 * step_s, at_s]);
            }
            let ahead = self.flips && self.cosine(at_s, &y) < 0.0;
            let mut row = self.row(at_s, &y, ahead);
            row.motion = Some(Motion {
                from_sun: unpacked(&y),
                body_from_sun: self.body(Body::Mercury, at_s),
                mass_kg: MASS_KG,
                light_n: (self.law)(at_s, &row),
            });
            rows.push(row);
        }
        SimulatedFlight { rows, ..SimulatedFlight::default() }
    }
}

pub(super) fn packed(state: &CartesianState) -> State6 {
    State6::from_fn(|i, _| if i < 3 { state.position_m[i] } else { state.velocity_m_s[i - 3] })
}

pub(super) fn unpacked(y: &State6) -> CartesianState {
    CartesianState {
        position_m: Vector3::new(y[0], y[1], y[2]),
        velocity_m_s: Vector3::new(y[3], y[4], y[5]),
    }
}
