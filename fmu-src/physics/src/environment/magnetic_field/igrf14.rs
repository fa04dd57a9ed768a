//! The International Geomagnetic Reference Field, 14th generation (IAGA V-MOD, doi 10.5281/zenodo.14012302), 1900 to 2030.
//!
//! Equation: B = -grad V, V = a sum over n, m of (a/r)^(n+1) (g cos(m l) + h sin(m l)) P_n^m(sin(latitude)), Schmidt's
//! semi-normalised functions, a = 6371.2 km; coefficients linear in time between five years and the next five.
//! Method: Cunningham's recursion in Cartesian components, without a singularity at the poles, its functions not normalised.
//! Order: degree 13.
//! Error measure: rounding.
//! Reference: Alken et al. 2021, International Geomagnetic Reference Field: the thirteenth generation (form); Montenbruck and
//! Gill, Satellite Orbits, 3.2.4 and 3.2.5 (recursion).

use std::sync::OnceLock;

use nalgebra::Vector3;

/// First year that it has.
pub(super) const FIRST_YEAR: f64 = 1900.0;
/// Last year that it has.
pub(super) const LAST_YEAR: f64 = 2030.0;
/// Radius to which the coefficients refer, in m.
const RADIUS_M: f64 = 6_371.2e3;
/// Highest degree.
const DEGREE: usize = 13;
/// Years from one column to the next, and columns.
const YEARS: f64 = 5.0;
const COLUMNS: usize = 27;
/// Functions are needed to one degree more.
const SIZE: usize = DEGREE + 2;

/// A pair of coefficients g and h in T of functions that are not normalised, for each column.
type Pair = [[f64; 2]; COLUMNS];

/// As published: a row of degree, order (negative: h) and a value in nT for each column.
const TEXT: &str = include_str!("igrf14.shc");

/// Pairs of a degree by order.
type Pairs = [Pair; DEGREE + 1];

const _: () = assert!(!core::mem::needs_drop::<Pairs>());

/// The pairs of degree `n`: one degree at a time, for few kB fit on the stack of a thread, and in place, for an unloaded library
/// leaves its heap behind.
fn pairs(n: usize) -> &'static Pairs {
    static PAIRS: [OnceLock<Pairs>; DEGREE + 1] = [const { OnceLock::new() }; DEGREE + 1];
    PAIRS[n].get_or_init(|| {
        let mut pairs = [[[0.0; 2]; COLUMNS]; DEGREE + 1];
        let rows = TEXT.lines().filter(|line| !line.starts_with('#')).skip(2);
        for row in rows {
            let mut fields = row.split_whitespace();
            let mut whole = || fields.next()?.parse::<i32>().ok();
            let (Some(degree), Some(order)) = (whole(), whole()) else { continue };
            let m = order.unsigned_abs() as usize;
            let Some(pair) = pairs.get_mut(m).filter(|_| degree.unsigned_abs() as usize == n) else {
                continue;
            };
            let scale_t = schmidt(n, m) * 1e-9;
            for (value, column) in fields.filter_map(|it| it.parse::<f64>().ok()).zip(pair) {
                column[usize::from(order < 0)] = value * scale_t;
            }
        }
        pairs
    })
}

/// Ratio of Schmidt's functions to those that are not normalised.
fn schmidt(n: usize, m: usize) -> f64 {
    let quotient: f64 = (n - m + 1..=n + m).map(|k| k as f64).product();
    let doubled = if m == 0 { 1.0 } else { 2.0 };
    (doubled / quotient).sqrt()
}

/// The field along the Earth's axes in T, in a year that it has, at a position from the centre along them, in m.
pub(super) fn field_fixed_t(year: f64, position_fixed_m: &Vector3<f64>) -> Vector3<f64> {
    let columns = (year - FIRST_YEAR) / YEARS;
    let column = (columns.floor() as usize).min(COLUMNS - 2);
    let share = columns - column as f64;
    let (v, w) = functions(position_fixed_m);
    let mut field = Vector3::zeros();
    for n in 1..=DEGREE {
        for (m, pair) in pairs(n).iter().enumerate().take(n + 1) {
            let [g, h] = [0, 1].map(|k| pair[column][k] + (pair[column + 1][k] - pair[column][k]) * share);
            let (up, k) = (n + 1, (n - m + 1) as f64);
            field.z += k * (g * v[up][m] + h * w[up][m]);
            if m == 0 {
                field.x += g * v[up][1];
                field.y += g * w[up][1];
            } else {
                let below = k * (k + 1.0);
                field.x += 0.5
                    * (g * v[up][m + 1] + h * w[up][m + 1] - below * (g * v[up][m - 1] + h * w[up][m - 1]));
                field.y += 0.5
                    * (g * w[up][m + 1] - h * v[up][m + 1] + below * (g * w[up][m - 1] - h * v[up][m - 1]));
            }
        }
    }
    field
}

type Functions = [[f64; SIZE]; SIZE];

/// (a/r)^(n+1) P_n^m cos(m l), and the same with the sine.
fn functions(position_fixed_m: &Vector3<f64>) -> (Functions, Functions) {
    let (mut v, mut w) = ([[0.0; SIZE]; SIZE], [[0.0; SIZE]; SIZE]);
    let square = position_fixed_m.norm_squared();
    let scaled = position_fixed_m * (RADIUS_M / square);
    let shrink = RADIUS_M * RADIUS_M / square;
    v[0][0] = RADIUS_M / square.sqrt();
    for m in 0..SIZE {
        if m > 0 {
            let odd = (2 * m - 1) as f64;
            v[m][m] = odd * (scaled.x * v[m - 1][m - 1] - scaled.y * w[m - 1][m - 1]);
            w[m][m] = odd * (scaled.x * w[m - 1][m - 1] + scaled.y * v[m - 1][m - 1]);
        }
        for n in m + 1..SIZE {
            let (odd, far, span) = ((2 * n - 1) as f64, (n + m - 1) as f64, (n - m) as f64);
            for it in [&mut v, &mut w] {
                let before = if n > m + 1 { it[n - 2][m] } else { 0.0 };
                it[n][m] = (odd * scaled.z * it[n - 1][m] - far * shrink * before) / span;
            }
        }
    }
    (v, w)
}
