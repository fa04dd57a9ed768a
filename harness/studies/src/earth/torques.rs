//! Torque by effect against the height of a circular orbit.

use drawing::{Chart, Panel, Series};

use super::cubesat::{CUBESAT, EFFECTS, EQUATOR_M, Torques, period_s};
use crate::case::Case;
use crate::cells::scientific;
use crate::report::{Outcome, Run};

/// Lowest and highest orbit, in m.
const HEIGHTS_M: [f64; 2] = [180e3, 36e6];
/// How many orbits, evenly spaced by the logarithm of the height.
const ORBITS: u32 = 25;
/// Communication points of an orbit.
const POINTS: f64 = 200.0;
/// Ticks of the pictures' axes: heights in km, and torques in N m by their power of ten.
const TICKS_KM: [f64; 8] = [200.0, 500.0, 1000.0, 2000.0, 5000.0, 10_000.0, 20_000.0, 36_000.0];
const MIN_POWER: i32 = -14;

/// One orbit: its height, mean and greatest torque by effect.
struct AtHeight {
    height_m: f64,
    mean_n_m: [f64; EFFECTS.len()],
    greatest_n_m: [f64; EFFECTS.len()],
}

fn case(height_m: f64) -> Case {
    let radius_m = EQUATOR_M + height_m;
    let duration_s = period_s(radius_m);
    Case::new(format!("{:.0} km", height_m / 1e3), duration_s, duration_s / POINTS)
        .set("orbit.dynamics", "twoBody")
        .set("orbit.semiMajorAxis", radius_m)
        .set("orbit.eccentricity", 0.0)
}

/// Every torque against height, 180 to 36,000 km.
pub(crate) fn torques(run: &mut Run<'_>) -> Outcome {
    let fmu = run.options.fmu(CUBESAT)?;
    let ratio = HEIGHTS_M[1] / HEIGHTS_M[0];
    let heights_m = (0..ORBITS).map(|k| HEIGHTS_M[0] * ratio.powf(f64::from(k) / f64::from(ORBITS - 1)));
    let heights_m = run.chosen(heights_m, |height_m| case(*height_m).label)?;
    let found = run.all(&heights_m, |&height_m| {
        let points: Vec<Torques> = case(height_m).simulate(&fmu, Torques::NAMES)?.all(0);
        let of = |fold: fn(f64, f64) -> f64| {
            points
                .iter()
                .map(Torques::by_effect_n_m)
                .fold([0.0; EFFECTS.len()], |sum, torque| core::array::from_fn(|k| fold(sum[k], torque[k])))
        };
        let count = points.len().max(1) as f64;
        Ok(AtHeight {
            height_m,
            mean_n_m: of(|sum, torque| sum + torque).map(|sum| sum / count),
            greatest_n_m: of(f64::max),
        })
    })?;
    run.line(
        "Torque on a 12U CubeSat that points to the nadir, on circular orbits of 97.4 deg, mean magnitude over an\n\
         orbit; air by NRLMSISE-00 at F10.7 150 and Ap 4, Sentman's law; field by IGRF-14, a residual dipole of 0.035 A m2\n",
    );
    let rows = found.iter().step_by(4).map(|orbit| {
        let means = orbit.mean_n_m.map(|torque_n_m| format!("{torque_n_m:.1e}"));
        [&[format!("{:.0}", orbit.height_m / 1e3)][..], &means].concat()
    });
    let rows: Vec<_> = rows.collect();
    run.table(&format!("height [km] | {} [N m]", EFFECTS.join(" [N m] | ")), &rows);
    if let Some(crossing_km) = crossing_km(&found) {
        run.line(&format!("Air is the greater of air and sunlight up to {crossing_km:.0} km."));
    }
    let columns = EFFECTS.map(|it| format!("{} mean [N m] | {} greatest [N m]", it, it)).join(" | ");
    let rows = found.iter().map(|orbit| {
        let pairs = orbit.mean_n_m.into_iter().zip(orbit.greatest_n_m);
        let numbers = scientific(pairs.flat_map(|(mean, greatest)| [mean, greatest]));
        [vec![format!("{:.3}", orbit.height_m / 1e3)], numbers].concat()
    });
    run.csv("torques.csv", &format!("height [km] | {columns}"), rows)?;
    run.picture("torques.svg", &chart(&found))
}

/// Height in km at which air falls below sunlight.
fn crossing_km(found: &[AtHeight]) -> Option<f64> {
    let excess = |orbit: &AtHeight| (orbit.mean_n_m[1] / orbit.mean_n_m[3]).ln();
    let pair = found.windows(2).find(|pair| excess(&pair[0]) > 0.0 && excess(&pair[1]) <= 0.0)?;
    let [below, above] = [&pair[0], &pair[1]].map(|orbit| (orbit.height_m.ln(), excess(orbit)));
    let share = if above.1.is_finite() { below.1 / (below.1 - above.1) } else { 0.5 };
    Some((below.0 + (above.0 - below.0) * share).exp() / 1e3)
}

fn chart(found: &[AtHeight]) -> Chart {
    let series = (0..EFFECTS.len()).map(|k| {
        let point = |orbit: &AtHeight| {
            let power = orbit.mean_n_m[k].log10();
            let is_seen = power >= f64::from(MIN_POWER);
            ((orbit.height_m / 1e3).log10(), if is_seen { power } else { f64::NAN })
        };
        Series::line(EFFECTS[k], found.iter().map(point).collect())
    });
    let panel = Panel::new("mean torque [N m]").with(series);
    let names = (MIN_POWER..=-3).step_by(2).map(|power| (f64::from(power), format!("1e{power}"))).collect();
    let mut chart =
        Chart::new("Torque on a 12U CubeSat by height", "height [km]").with([Panel { names, ..panel }]);
    chart.x_names = TICKS_KM.map(|height_km| (height_km.log10(), format!("{height_km:.0}"))).to_vec();
    chart
}
