//! Figure 13: a whole Mercury year, by orbit.

use crate::cells::scientific;
use crate::report::{Outcome, Run};
use crate::verdict::{agrees, compared};
use drawing::{Chart, Panel, Series};

use super::orbit::{Case, EFFECTS, Fmus, MERCURY_YEAR_S, ORBIT_S, Planet, Sample};

/// Time between samples, in s.
const STEP_S: f64 = 60.0;

/// Least, mean and greatest of one quantity over one orbit.
#[derive(Clone, Copy, Debug)]
struct Range {
    least: f64,
    mean: f64,
    greatest: f64,
}

impl Range {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let (mut least, mut greatest, mut sum, mut count) = (f64::INFINITY, 0.0_f64, 0.0, 0_u32);
        for value in values {
            least = least.min(value);
            greatest = greatest.max(value);
            sum += value;
            count += 1;
        }
        Self { least, mean: sum / f64::from(count.max(1)), greatest }
    }
}

/// What one orbit comes to.
struct Orbit {
    true_anomaly_deg: f64,
    effects: [Range; 4],
    /// Mean share of albedo, infrared and recoil in solar, in the light.
    mean_thermal_share: f64,
}

impl Orbit {
    fn of(samples: &[Sample]) -> Self {
        let lit = || samples.iter().filter(|sample| sample.lit);
        let share = |sample: &Sample| sample.effects[1..].iter().sum::<f64>() / sample.effects[0];
        Self {
            true_anomaly_deg: samples.first().map_or(0.0, |sample| sample.true_anomaly_deg),
            effects: [0, 1, 2, 3].map(|k| Range::of(samples.iter().map(|sample| sample.effects[k]))),
            mean_thermal_share: Range::of(lit().map(share)).mean,
        }
    }
}

fn row(what: &str, ours: String, holds: bool) -> Vec<String> {
    compared(what, ours, agrees(holds))
}

/// Figure 13: accelerations over a Mercury year; least, mean and greatest of every orbit.
pub(crate) fn figure13(run: &mut Run<'_>) -> Outcome {
    let fmus = Fmus::open(run.options)?;
    let case = Case {
        true_anomaly_deg: 0.0,
        planet: Planet::Moving,
        duration_s: MERCURY_YEAR_S,
        step_s: STEP_S,
        belts: None,
    };
    let samples = fmus.simulate(&case)?;
    let orbit_of = |sample: &Sample| (sample.time_s / ORBIT_S) as u64;
    let orbits: Vec<Orbit> = samples.chunk_by(|a, b| orbit_of(a) == orbit_of(b)).map(Orbit::of).collect();
    run.line("A whole Mercury year (paper 004, Figure 13)\n");
    let lit = || samples.iter().filter(|sample| sample.lit);
    let greatest = |value: &dyn Fn(&Sample) -> f64| lit().map(value).fold(0.0, f64::max);
    let shares = orbits.iter().map(|orbit| orbit.mean_thermal_share);
    let mean_share = Range::of(shares);
    let infrared = greatest(&|sample| sample.effects[2] / sample.effects[0]);
    let thermal = greatest(&|sample| sample.effects[3] / sample.effects[0]);
    let scalar = greatest(&|sample| sample.effects[1..].iter().sum::<f64>() / sample.effects[0]);
    let vector = greatest(&|sample| sample.without_solar / sample.effects[0]);
    let total = greatest(&|sample| sample.total);
    let percent = |share: f64| format!("{:.1} %", share * 100.0);
    let count = MERCURY_YEAR_S / ORBIT_S;
    let shares_agree = mean_share.least > 0.195 && mean_share.greatest < 0.305;
    let rows = [
        row("orbits in a year | 172", format!("{count:.1}"), (count - 172.0).abs() < 0.5),
        row(
            "mean sum of thermal effects, of solar | 20-30 %",
            format!("{} to {}", percent(mean_share.least), percent(mean_share.greatest)),
            shares_agree,
        ),
        row("greatest infrared, of solar | about 25 %", percent(infrared), (infrared - 0.25).abs() < 0.03),
        row("greatest recoil, of solar | about 25 %", percent(thermal), (thermal - 0.25).abs() < 0.03),
        row("greatest sum of magnitudes, of solar | up to 50 %", percent(scalar), scalar < 0.505),
        row(
            "greatest total | order of 1e-6 m/s2",
            format!("{total:.2e} m/s2"),
            (5e-7..2e-6).contains(&total),
        ),
    ];
    run.table("quantity | paper | ours | verdict", &rows);
    run.line(&format!(
        "The printed elements give {count:.1} orbits in a year. The sum of magnitudes is the paper's; the magnitude of the\n\
         vector sum of albedo, infrared and recoil reaches {} of solar.",
        percent(vector)
    ));
    run.picture("figure13.svg", &chart(&orbits))?;
    let columns = |it| format!(" | {it}_least_m_s2 | {it}_mean_m_s2 | {it}_greatest_m_s2");
    let header = format!("true_anomaly_deg{}", EFFECTS.map(columns).concat());
    let rows = orbits.iter().map(|orbit| {
        let effects = orbit.effects.iter().flat_map(|effect| [effect.least, effect.mean, effect.greatest]);
        [vec![format!("{:.4}", orbit.true_anomaly_deg)], scientific(effects)].concat()
    });
    run.csv("figure13.csv", &header, rows)
}

fn chart(orbits: &[Orbit]) -> Chart {
    let panel = |name: &str, pick: fn(&Range) -> f64| {
        Panel::new(format!("{name} a [1e-7 m/s2]")).with((0..4).map(|k| {
            let point = |orbit: &Orbit| (orbit.true_anomaly_deg, pick(&orbit.effects[k]) * 1e7);
            Series::line(EFFECTS[k], orbits.iter().map(point).collect())
        }))
    };
    Chart::new("Accelerations over a Mercury year, by orbit", "true anomaly of Mercury [deg]").with([
        panel("greatest", |range| range.greatest),
        panel("mean", |range| range.mean),
        panel("least", |range| range.least),
    ])
}
