//! Momentum that windows of a recorded flight without dumps gather, in the body frame.
//!
//! In a window from t0 on a source gathers G(t) = A(t) (H(t) - H(t0)), with A from EME2000 to the body: wheels that are
//! empty at t0 hold it at t. Components in a turning frame are never compared over time: H is inertial, and A is that of
//! one time. Over an orbit of period T the secular part is G at its end, the cyclic part the largest
//! |A(t) (H(t) - H(t0) - (t - t0) (H(t0 + T) - H(t0)) / T)|, by component. Wheels that work about a bias b hold it at t0: beside
//! it they hold A(t) (H(t) - H(t0) + A(t0)^-1 b) - b, with the turn of the body under the bias.

use std::borrow::Cow;

use fmi::Recording;
use inputs::variables::{numbers, vectors};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Rows whose bounds are looked at together before the rows themselves, the most first.
const BLOCKS: [usize; 3] = [4096, 256, 16];

/// Momentum of one source by body axis, in N m s.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SourceRow {
    /// Name below `momentum.`.
    pub source: String,
    /// Mean of the orbits.
    pub secular_per_orbit_n_m_s: Vector3<f64>,
    /// Largest of the orbits.
    pub cyclic_in_orbit_n_m_s: Vector3<f64>,
    /// Largest magnitude in any window as long as the time between dumps.
    pub gathered_n_m_s: Vector3<f64>,
}

/// Momentum of a flight by source, as vectors of a frame that does not turn.
pub(super) struct Histories {
    times_s: Vec<f64>,
    /// From EME2000 to the body.
    to_body: Vec<UnitQuaternion<f64>>,
    sources: Vec<Source>,
    /// Momentum of the wheels' bias, body frame, in N m s.
    bias_n_m_s: Vector3<f64>,
    /// Greatest magnitudes by body axis of torque, in N m, and rate, in rad/s.
    most: [Vector3<f64>; 2],
}

/// Quantity of a search over windows.
enum Search {
    /// The largest magnitudes so far, in windows of a length.
    Largest(Vector3<f64>),
    /// The shortest window so far in which a magnitude goes beyond these.
    Beyond(Vector3<f64>),
}

impl Search {
    fn bound(&self, axis: usize) -> f64 {
        match self {
            Self::Largest(bounds) | Self::Beyond(bounds) => bounds[axis],
        }
    }
}

/// Outputs `momentum.*` that are no source.
const NO_SOURCES: [&str; 2] = ["bias", "unheld"];

/// Momentum of one source over time.
struct Source {
    name: String,
    momentum_n_m_s: Vec<Vector3<f64>>,
    /// Whether a window's momentum is turned into the body.
    is_turned: bool,
}

impl Histories {
    /// The `momentum.*` of a flight. `is_body_integral` is whether its components are integrals of torque components
    /// (`momentum.convention`), which stand in no frame: these are taken as they are.
    ///
    /// # Errors
    /// A column that is not recorded.
    pub(super) fn new(
        simulated: &Recording,
        is_body_integral: bool,
        bias_n_m_s: Vector3<f64>,
    ) -> Result<Self, String> {
        let [x, y, z, w] = [1, 2, 3, 4].map(|k| numbers(simulated, &format!("attitude.q[{k}]")));
        let (x, y, z, w) = (x?, y?, z?, w?);
        // A(q) is the inverse of the rotation that q stands for in nalgebra.
        let attitude =
            |k: usize| UnitQuaternion::new_normalize(Quaternion::new(w[k], x[k], y[k], z[k])).inverse();
        let to_body: Vec<_> = (0..w.len()).map(attitude).collect();
        let names =
            simulated.names.iter().filter_map(|name| name.strip_prefix("momentum.")?.strip_suffix("[1]"));
        let names = names.filter(|name| !NO_SOURCES.contains(name));
        let sources = names.map(|name| {
            let recorded = vectors(simulated, &format!("momentum.{name}"))?;
            let is_turned = !is_body_integral && name != "inertial";
            let inertial = |(momentum, to_body): (Vector3<f64>, &UnitQuaternion<f64>)| {
                if is_turned { to_body.inverse_transform_vector(&momentum) } else { momentum }
            };
            let momentum_n_m_s = recorded.into_iter().zip(&to_body).map(inertial).collect();
            Ok(Source { name: name.to_owned(), momentum_n_m_s, is_turned })
        });
        let sources = sources.collect::<Result<_, String>>()?;
        let most = |name: &str| {
            let rows = vectors(simulated, name)?;
            Ok::<_, String>(
                rows.iter().fold(Vector3::zeros(), |most: Vector3<f64>, row| most.sup(&row.abs())),
            )
        };
        let most = [most("torque.total")?, most("attitude.rate")?];
        Ok(Self { times_s: simulated.times_s.clone(), to_body, sources, bias_n_m_s, most })
    }

    /// The largest magnitude of the body's gathered momentum within any time of this length, by axis.
    pub(super) fn gathered_n_m_s(&self, span_s: f64) -> Vector3<f64> {
        self.body().map_or_else(Vector3::zeros, |body| self.largest_n_m_s(body, &self.bias_n_m_s, span_s))
    }

    /// The shortest time in which the body gathers more than this, by axis, in s; `None` where no window does.
    pub(super) fn shortest_beyond_s(&self, bounds_n_m_s: Vector3<f64>) -> Option<f64> {
        let mut search = Search::Beyond(bounds_n_m_s);
        let span_s = self.search(self.body()?, &self.bias_n_m_s, f64::INFINITY, &mut search);
        span_s.is_finite().then_some(span_s)
    }

    /// Momentum gathered in one window of this length after another, body frame at its end, and the time of all; `None` where the flight
    /// has none.
    pub(super) fn unloaded_n_m_s(&self, span_s: f64) -> Option<(Vec<Vector3<f64>>, f64)> {
        let body = self.body().filter(|_| self.span_s() >= span_s * (1.0 - 1e-9))?;
        let starts = self.starts_n_m_s(body, &self.bias_n_m_s);
        let windows = windows(&self.times_s, span_s);
        let last = *windows.last()?.end();
        let each = windows.into_iter().map(|window| {
            let gathered_n_m_s = body.momentum_n_m_s[*window.end()] - starts[*window.start()];
            self.in_body(body, *window.end(), gathered_n_m_s) - self.bias_n_m_s
        });
        Some((each.collect(), self.times_s[last] - self.times_s[0]))
    }

    /// Torque that wheels take up by body axis where they hold up to this beside their bias, in N m: what acts, and what the
    /// momentum they hold needs to turn with the body, |w x h| by bounds.
    pub(super) fn torque_n_m(&self, gathered_n_m_s: Vector3<f64>) -> Vector3<f64> {
        let [torque_n_m, rate_rad_s] = self.most;
        let held_n_m_s = gathered_n_m_s + self.bias_n_m_s.abs();
        Vector3::from_fn(|axis, _| {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            torque_n_m[axis] + rate_rad_s[next] * held_n_m_s[last] + rate_rad_s[last] * held_n_m_s[next]
        })
    }

    /// Length of the flight, in s.
    pub(super) fn span_s(&self) -> f64 {
        self.times_s.last().zip(self.times_s.first()).map_or(0.0, |(last, first)| last - first)
    }

    fn body(&self) -> Option<&Source> {
        self.sources.iter().find(|source| source.name == "body")
    }

    /// A row a source; `period_s` is an orbit's, `spacing_s` the time between dumps.
    pub(super) fn by_source(&self, period_s: f64, spacing_s: f64) -> Vec<SourceRow> {
        let orbits = windows(&self.times_s, period_s);
        let rows = self.sources.iter().map(|source| {
            let (mut secular_n_m_s, mut cyclic_n_m_s) = (Vector3::zeros(), Vector3::zeros());
            for orbit in &orbits {
                let (secular, cyclic) = self.parts(source, orbit, period_s);
                secular_n_m_s += secular / orbits.len() as f64;
                cyclic_n_m_s = cyclic.sup(&cyclic_n_m_s);
            }
            SourceRow {
                source: source.name.clone(),
                secular_per_orbit_n_m_s: secular_n_m_s,
                cyclic_in_orbit_n_m_s: cyclic_n_m_s,
                gathered_n_m_s: self.largest_n_m_s(source, &Vector3::zeros(), spacing_s),
            }
        });
        rows.collect()
    }

    /// Momentum of a source that is a vector of the body's frame at a row.
    fn in_body(&self, source: &Source, row: usize, momentum_n_m_s: Vector3<f64>) -> Vector3<f64> {
        if source.is_turned { self.to_body[row] * momentum_n_m_s } else { momentum_n_m_s }
    }

    /// Secular and cyclic part of the orbit that these rows are, the former for a whole period.
    fn parts(
        &self,
        source: &Source,
        orbit: &core::ops::RangeInclusive<usize>,
        period_s: f64,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let (first, last) = (*orbit.start(), *orbit.end());
        let (times_s, momentum_n_m_s) = (&self.times_s, &source.momentum_n_m_s);
        let gathered_n_m_s = momentum_n_m_s[last] - momentum_n_m_s[first];
        let span_s = times_s[last] - times_s[first];
        let fraction = |row: usize| if span_s > 0.0 { (times_s[row] - times_s[first]) / span_s } else { 0.0 };
        let off = |row: usize| momentum_n_m_s[row] - momentum_n_m_s[first] - gathered_n_m_s * fraction(row);
        let cyclic = orbit.clone().map(|row| self.in_body(source, row, off(row)).abs());
        let whole = if span_s > 0.0 { period_s / span_s } else { 0.0 };
        (self.in_body(source, last, gathered_n_m_s * whole), cyclic.fold(Vector3::zeros(), |a, b| a.sup(&b)))
    }

    /// The largest |G(t)| over all windows of this length, by component.
    fn largest_n_m_s(&self, source: &Source, bias_n_m_s: &Vector3<f64>, span_s: f64) -> Vector3<f64> {
        let mut search = Search::Largest(Vector3::zeros());
        self.search(source, bias_n_m_s, span_s, &mut search);
        Vector3::from([0, 1, 2].map(|axis| search.bound(axis)))
    }

    /// From what a window's momentum counts, by the row in which it begins.
    fn starts_n_m_s<'s>(&self, source: &'s Source, bias_n_m_s: &Vector3<f64>) -> Cow<'s, [Vector3<f64>]> {
        if *bias_n_m_s == Vector3::zeros() {
            return Cow::Borrowed(&source.momentum_n_m_s);
        }
        let held = |(momentum, to_body): (&Vector3<f64>, &UnitQuaternion<f64>)| {
            let bias =
                if source.is_turned { to_body.inverse_transform_vector(bias_n_m_s) } else { *bias_n_m_s };
            momentum - bias
        };
        source.momentum_n_m_s.iter().zip(&self.to_body).map(held).collect()
    }

    /// Goes through all windows up to a length; gives the length of the shortest that [`Search::Beyond`] found, else this one. Blocks
    /// of rows whose bounds hold nothing larger are passed over.
    fn search(
        &self,
        source: &Source,
        bias_n_m_s: &Vector3<f64>,
        mut span_s: f64,
        search: &mut Search,
    ) -> f64 {
        let starts_n_m_s = self.starts_n_m_s(source, bias_n_m_s);
        let bounds = |rows: &[Vector3<f64>]| {
            rows.iter().fold((rows[0], rows[0]), |(low, high), it| (low.inf(it), high.sup(it)))
        };
        let blocks = BLOCKS.map(|block| (block, starts_n_m_s.chunks(block).map(bounds).collect::<Vec<_>>()));
        let mut first = 0;
        for row in 0..starts_n_m_s.len() {
            for axis in 0..3 {
                // Times are rounded.
                while self.times_s[row] - self.times_s[first] > span_s * (1.0 + 1e-9) {
                    first += 1;
                }
                let unit = Vector3::ith(axis, 1.0);
                let direction =
                    if source.is_turned { self.to_body[row].inverse_transform_vector(&unit) } else { unit };
                let now_n_m_s = direction.dot(&source.momentum_n_m_s[row]) - bias_n_m_s[axis];
                let mut begin = first;
                while begin < row {
                    let passed = blocks.iter().find(|(block, bounds)| {
                        begin % block == 0 && begin + block <= row && {
                            let (low, high) = bounds[begin / block];
                            let (center, half) = ((low + high) / 2.0, (high - low) / 2.0);
                            let off_n_m_s = (now_n_m_s - direction.dot(&center)).abs();
                            off_n_m_s + direction.abs().dot(&half) <= search.bound(axis)
                        }
                    });
                    if let Some((block, _)) = passed {
                        begin += block;
                        continue;
                    }
                    let gathered_n_m_s = (now_n_m_s - direction.dot(&starts_n_m_s[begin])).abs();
                    if gathered_n_m_s > search.bound(axis) {
                        match search {
                            Search::Largest(largest) => largest[axis] = gathered_n_m_s,
                            Search::Beyond(_) => span_s = self.times_s[row] - self.times_s[begin],
                        }
                    }
                    begin += 1;
                }
            }
        }
        span_s
    }
}

/// Rows of one whole span after another; all rows where there is no whole one.
fn windows(times_s: &[f64], span_s: f64) -> Vec<core::ops::RangeInclusive<usize>> {
    let mut windows = Vec::new();
    let mut begin = 0;
    for end in 0..times_s.len() {
        // Times are rounded.
        if times_s[end] - times_s[begin] >= span_s * (1.0 - 1e-9) {
            windows.push(begin..=end);
            begin = end;
        }
    }
    if windows.is_empty() && !times_s.is_empty() {
        windows.push(0..=times_s.len() - 1);
    }
    windows
}

#[cfg(test)]
mod tests;
