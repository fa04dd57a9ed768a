//! A day of the CubeSat at 500 km: torque and momentum by effect, and the air that it meets.

use drawing::{Chart, Panel, Series};

use super::cubesat::{CUBESAT, EFFECTS, Torques, by_effect};
use crate::attitude::Vector;
use crate::case::{Case, recorded};
use crate::cells::scientific;
use crate::report::{Outcome, Run};

/// Duration, in s.
const DAY_S: f64 = 86_400.0;
/// Communication step, in s.
const STEP_S: f64 = 60.0;

recorded! {
    /// What the day leaves at one communication point.
    struct Point {
        @time_s,
        by_source_n_m_s: [Vector; 6] = "momentum.gravityGradient" "momentum.aerodynamic" "momentum.magnetic"
            "momentum.solar" "momentum.albedo" "momentum.infrared",
        total_n_m_s: Vector = "momentum.body",
        density_kg_m3: f64 = "atmosphere.density",
        height_m: f64 = "geodetic.height",
    }
}

impl Point {
    fn momentum_n_m_s(&self) -> [f64; EFFECTS.len()] {
        by_effect(self.by_source_n_m_s)
    }
}

/// A day in a low orbit of the Earth.
pub(crate) fn day(run: &mut Run<'_>) -> Outcome {
    let fmu = run.options.fmu(CUBESAT)?;
    let names = [Point::NAMES, Torques::NAMES].concat();
    let recorded = Case::new("a day at 500 km", DAY_S, STEP_S).simulate(&fmu, &names)?;
    let points: Vec<(Point, Torques)> = recorded.all(0);
    run.line("A 12U CubeSat for a day at 500 km, pointing to the nadir, its wheels taking everything\n");
    let (count, last) = (points.len().max(1) as f64, points.last());
    let rows: Vec<Vec<String>> = (0..EFFECTS.len())
        .map(|k| {
            let torques = || points.iter().map(|(_, torques)| torques.by_effect_n_m()[k] * 1e6);
            let mean = torques().sum::<f64>() / count;
            let after = last.map_or(f64::NAN, |(point, _)| point.momentum_n_m_s()[k] * 1e3);
            vec![
                EFFECTS[k].to_owned(),
                format!("{mean:.3}"),
                format!("{:.3}", torques().fold(0.0, f64::max)),
                format!("{after:.3}"),
            ]
        })
        .collect();
    run.table("effect | mean torque [uN m] | greatest [uN m] | momentum after the day [mN m s]", &rows);
    if let Some((last, _)) = last {
        let total = last.total_n_m_s.norm() * 1e3;
        let densities = points.iter().map(|(point, _)| point.density_kg_m3);
        let (least, most) =
            densities.fold((f64::INFINITY, 0.0_f64), |(least, most), it| (least.min(it), most.max(it)));
        run.line(&format!(
            "System momentum after the day {total:.3} mN m s; density {least:.2e} to {most:.2e} kg/m3, height {:.1} km at the end.",
            last.height_m / 1e3
        ));
    }
    let columns = EFFECTS.map(|it| format!("{it} torque [N m] | {it} momentum [N m s]")).join(" | ");
    let rows = points.iter().map(|(point, torques)| {
        let pairs = torques.by_effect_n_m().into_iter().zip(point.momentum_n_m_s());
        let effects = pairs.flat_map(|(torque, momentum)| [torque, momentum]);
        [vec![format!("{}", point.time_s)], scientific([point.density_kg_m3].into_iter().chain(effects))]
            .concat()
    });
    run.csv("day.csv", &format!("time [s] | density [kg/m3] | {columns}"), rows)?;
    run.picture("day.svg", &chart(&points))
}

fn chart(points: &[(Point, Torques)]) -> Chart {
    let hours = |point: &Point| point.time_s / 3600.0;
    let torques = (0..EFFECTS.len()).map(|k| {
        let places = points.iter().map(|(point, torques)| (hours(point), torques.by_effect_n_m()[k] * 1e6));
        Series::line(EFFECTS[k], places.collect())
    });
    let momenta = (0..EFFECTS.len()).map(|k| {
        let places = points.iter().map(|(point, _)| (hours(point), point.momentum_n_m_s()[k] * 1e3));
        Series::line(EFFECTS[k], places.collect())
    });
    let density = points.iter().map(|(point, _)| (hours(point), point.density_kg_m3 * 1e12)).collect();
    Chart::new("A 12U CubeSat for a day at 500 km", "time [h]").with([
        Panel::new("torque [uN m]").titled("torque by effect").with(torques),
        Panel::new("momentum [mN m s]").titled("what each effect did to the momentum").with(momenta),
        Panel::new("density [1e-12 kg/m3]").titled("air").with([Series::line("density", density)]),
    ])
}
