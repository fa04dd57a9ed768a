//! Paper 000's trade: storage and mass of the wheels against dumps.

use loader::Fmu;

use super::cases::{Convention, DumpsTo, Shade, Simulated, Strategy, convention_label};
use super::lists::with_strategies;
use super::optimum::simulate_all;
use crate::StudyError;
use crate::case::Case;
use crate::report::{Outcome, Run};
use drawing::{Chart, Panel, Series};

/// Storage of a wheel in N m s, mass of four in kg, threshold in N m s: "between 4 and 12 Nms per wheel with a total mass between
/// 12 and 20 kg", of which 17 kg "will allow 8 Nms"; the thresholds are those of small, intermediate and large wheels.
const PRINTED: [[f64; 3]; 3] = [[4.0, 12.0, 4.0], [8.0, 17.0, 5.5], [12.0, 20.0, 7.0]];
/// Storage of a wheel, in N m s.
const CAPACITIES_N_M_S: [f64; 5] = [4.0, 6.0, 8.0, 10.0, 12.0];
/// Centre of mass, in inches.
const OFFSETS_IN: [[i8; 3]; 2] = [[0, 0, -1], [0, 0, -2]];

/// Mass of four wheels and threshold of dumps, on straight lines between what is printed.
fn between_printed(capacity_n_m_s: f64) -> [f64; 2] {
    let [low, middle, high] = PRINTED;
    let ([from, mass_from, threshold_from], [to, mass_to, threshold_to]) =
        if capacity_n_m_s <= middle[0] { (low, middle) } else { (middle, high) };
    let share = (capacity_n_m_s - from) / (to - from);
    [mass_from + share * (mass_to - mass_from), threshold_from + share * (threshold_to - threshold_from)]
}

/// Study `momentum/wheels`.
pub(crate) fn wheels(run: &mut Run<'_>) -> Outcome {
    let wheels = CAPACITIES_N_M_S.map(|capacity_n_m_s| {
        let [mass_kg, threshold_n_m_s] = between_printed(capacity_n_m_s);
        (capacity_n_m_s, mass_kg, threshold_n_m_s)
    });
    let groups = [Convention::BodyIntegral, Convention::Inertial]
        .map(|convention| (DumpsTo::OWN, Shade::PlatesAndPanels, convention));
    let thresholds_n_m_s = wheels.map(|(.., threshold_n_m_s)| threshold_n_m_s);
    let cases = with_strategies(&Strategy::ALL, &groups, &thresholds_n_m_s, &OFFSETS_IN);
    let simulated = simulate_all(run, cases)?;
    let guaranteed = guaranteed_thresholds(&run.options.fmu("MomentumPlant.fmu")?)?;
    run.line("Thruster dumps in 90 days over the storage of the wheels (paper 000), plates and panels\n");
    let mut rows = Vec::new();
    for (&(capacity_n_m_s, mass_kg, threshold_n_m_s), guaranteed) in wheels.iter().zip(&guaranteed) {
        for &(.., convention) in &groups {
            let here = |strategy| {
                let of = is_of(strategy, threshold_n_m_s, convention);
                let join = simulated.iter().filter(of).map(dumps).collect::<Vec<_>>();
                if join.is_empty() { "-".to_owned() } else { join.join(" / ") }
            };
            let [alone, reactive, predictive] = Strategy::ALL.map(here);
            rows.push(vec![
                format!("{capacity_n_m_s:.0}"),
                format!("{mass_kg:.2}"),
                format!("{threshold_n_m_s:.3}"),
                format!("{guaranteed:.3}"),
                convention_label(convention).to_owned(),
                alone,
                reactive,
                predictive,
            ]);
        }
    }
    let header = "\
        storage [N.m.s] | mass of four [kg] | threshold [N.m.s] | no wheel saturates up to [N.m.s] | \
        momentum | dumps only | reactive | predictive";
    run.table_and_csv("wheels.csv", header, rows)?;
    run.line(REMARK);
    draw(run, &simulated, &wheels)
}

const REMARK: &str = "\
Centre of mass at Z = -2.54 / -5.08 cm; a star where two dumps are less than the mission's five days apart. Dumps go to
0.9 of the opposite threshold. Printed: 4, 8 and 12 N.m.s; 12, 17 and 20 kg; thresholds 4, 5.5 and 7 N.m.s; straight lines
between. The paper does not print the wheels' axes: up to which threshold no wheel saturates holds for messenger.toml's
pyramid.";

fn is_of(strategy: Strategy, threshold_n_m_s: f64, convention: Convention) -> impl Fn(&&Simulated) -> bool {
    move |it| {
        (it.case.strategy, it.case.threshold_n_m_s, it.case.convention)
            == (strategy, threshold_n_m_s, convention)
    }
}

/// Their number, with a star where they break the mission's requirement.
fn dumps(simulation: &Simulated) -> String {
    let star = if simulation.spacing().is_closer_than_five_days() { "*" } else { "" };
    format!("{}{star}", simulation.count)
}

/// What the plant computes from axes and storage.
fn guaranteed_thresholds(fmu: &Fmu) -> Result<Vec<f64>, StudyError> {
    let threshold = |capacity_n_m_s: f64| {
        let case = (1..=4).fold(Case::new("wheels", 1.0, 1.0), |case, number| {
            case.set(&format!("wheel[{number}].capacity"), capacity_n_m_s)
        });
        Ok(case.simulate(fmu, &["dump.guaranteedThreshold"])?.last(0))
    };
    CAPACITIES_N_M_S.into_iter().map(threshold).collect()
}

fn draw(run: &mut Run<'_>, simulated: &[Simulated], wheels: &[(f64, f64, f64)]) -> Outcome {
    let line = |strategy: Strategy, offset_in: [i8; 3], convention: Convention| {
        let there = || simulated.iter().filter(|it| it.case.offset_in == offset_in);
        let points = wheels.iter().filter_map(|&(_, mass_kg, threshold_n_m_s)| {
            Some((mass_kg, there().find(is_of(strategy, threshold_n_m_s, convention))?.count as f64))
        });
        Series::line(strategy.label(), points.collect())
    };
    let panels = [Convention::BodyIntegral, Convention::Inertial]
        .into_iter()
        .flat_map(|convention| OFFSETS_IN.into_iter().map(move |offset_in| (convention, offset_in)));
    let panels: Vec<Panel> = panels
        .map(|(convention, offset_in)| {
            let mut series = Strategy::ALL.map(|strategy| line(strategy, offset_in, convention)).to_vec();
            series.retain(|series| !series.points.is_empty());
            let most = series.iter().flat_map(|it| &it.points).map(|(_, count)| *count).fold(1.0, f64::max);
            let centimetres = 2.54 * f64::from(offset_in[2]);
            Panel::new(format!("{}, Z {centimetres:.2} cm", convention_label(convention)))
                .range(-0.5, 1.15 * most)
                .with(series)
        })
        .filter(|panel| !panel.series.is_empty())
        .collect();
    let chart = Chart::new(
        "Thruster dumps in 90 days over the mass of four wheels, by momentum and offset",
        "mass of four wheels [kg]: 12 kg store 4 N.m.s a wheel, 17 kg 8, 20 kg 12",
    )
    .with(panels);
    run.picture("wheels.svg", &chart)
}

#[cfg(test)]
mod tests {
    //! The printed points, and half way between them.
    use super::*;

    #[test]
    fn what_is_printed_stands_on_the_lines() {
        for [capacity, mass, threshold] in PRINTED {
            assert_eq!(between_printed(capacity), [mass, threshold]);
        }
        assert_eq!(between_printed(6.0), [14.5, 4.75]);
        assert_eq!(between_printed(10.0), [18.5, 6.25]);
    }
}
