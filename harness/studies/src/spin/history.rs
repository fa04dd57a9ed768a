//! Figure 4: nutation during the 2 deg manoeuvre, and what shape of body gives the paper's range.

use super::spinner::{RATIO, paper_case};
use crate::case::Case;
use crate::report::{Outcome, Run};
use crate::verdict::{compared, verdict_text};
use drawing::{Chart, Panel, Series};

const STOP_S: f64 = 1400.0;
/// End of the paper's simulation, in s.
const PAPER_END_S: f64 = 1368.0;
/// What the paper reads off its figure, in deg: least, greatest, and where it ends.
const PAPER_DEG: (f64, f64, f64) = (0.001, 0.032, 0.024);
/// To which it reads, in deg.
const READ_DEG: f64 = 0.001;

fn cases() -> Vec<Case> {
    let case = |label: &str| paper_case(label, STOP_S, 0.5);
    vec![
        case("axisymmetric, ratio 1.483"),
        case("axisymmetric, ratio 1.484").ratio(1.484),
        case("triaxial, I1/I2 = 1.44").triaxial(RATIO, 1.44),
        case("triaxial, I1/I2 = 1.50").triaxial(RATIO, 1.50),
        case("triaxial, I2/I1 = 1.44").triaxial(RATIO, 1.0 / 1.44),
        case("triaxial, I2/I1 = 1.50").triaxial(RATIO, 1.0 / 1.50),
    ]
}

/// What was simulated, in deg.
struct NutationRange {
    least_deg: f64,
    most_deg: f64,
    /// After the paper's end: the nutation of a triaxial body swings.
    end_deg: (f64, f64),
    envelope_deg: f64,
}

impl NutationRange {
    /// What the comparison comes to.
    fn verdict(&self) -> String {
        let (least, most, end) = PAPER_DEG;
        let range = (self.least_deg - least).abs() <= READ_DEG && (self.most_deg - most).abs() <= READ_DEG;
        let ends = self.end_deg.0 - READ_DEG <= end && end <= self.end_deg.1 + READ_DEG;
        let within = self.most_deg <= 1.001 * self.envelope_deg;
        match (range, ends) {
            (true, true) => "the paper's range and end".to_owned(),
            (true, false) => "the paper's range, not its end".to_owned(),
            (false, _) if within => {
                format!("not the paper's range: never beyond the envelope of {:.4}", self.envelope_deg)
            }
            (false, true) => "not the paper's range, though its end".to_owned(),
            (false, false) => "not the paper's range, nor its end".to_owned(),
        }
    }
}

/// Figure 4.
pub(crate) fn figure4(run: &mut Run<'_>) -> Outcome {
    let cases = run.chosen(cases(), |case| case.label.clone())?;
    let fmu = run.options.fmu("SpinPlant.fmu")?;
    run.line("Nutation during a 2 deg manoeuvre of 114 pulses of 32 ms, once a turn (paper 002, Figure 4)");
    let names = ["nutation.angle", "nutation.predicted", "burn.done", "nutation.envelope"];
    let results = run.all(&cases, |case| case.simulate(&fmu, &names))?;
    let (mut rows, mut panels, mut csv) = (Vec::new(), Vec::new(), Vec::new());
    for (case, simulated) in cases.iter().zip(&results) {
        let degrees = |column: usize| simulated.columns[column].iter().map(|angle| angle.to_degrees());
        let between = |from_s: f64, to_s: f64| {
            let chosen =
                simulated.times_s.iter().zip(degrees(0)).filter(|(t, _)| (from_s..=to_s).contains(*t));
            chosen.fold((f64::INFINITY, 0.0_f64), |range, (_, deg)| (range.0.min(deg), range.1.max(deg)))
        };
        // After the first turns, as one reads a range off a picture.
        let (least_deg, most_deg) = between(60.0, PAPER_END_S);
        let found = NutationRange {
            least_deg,
            most_deg,
            end_deg: between(PAPER_END_S, STOP_S),
            envelope_deg: simulated.last(3).to_degrees(),
        };
        rows.push(compared(
            &format!("{} | 0.001 to 0.032, final 0.024", case.label),
            format!(
                "{least_deg:.4} to {most_deg:.4}, final {:.4} to {:.4}",
                found.end_deg.0, found.end_deg.1
            ),
            verdict_text(simulated.last(2) == 1.0, &found.verdict()),
        ));
        csv.extend(simulated.times_s.iter().zip(degrees(0)).zip(degrees(1)).map(
            |((time_s, angle), predicted)| {
                vec![
                    case.label.clone(),
                    format!("{time_s}"),
                    format!("{angle:.9}"),
                    format!("{predicted:.9}"),
                ]
            },
        ));
        panels.push(Panel::new("nutation [deg]").range(0.0, 0.05).with([
            Series::curve(case.label.clone(), simulated.times_s.iter().copied().zip(degrees(0)).collect()),
            Series::dashed("linear theory", simulated.times_s.iter().copied().zip(degrees(1)).collect()),
            Series::dashed(
                format!("envelope {:.4} deg", found.envelope_deg),
                vec![(0.0, found.envelope_deg), (STOP_S, found.envelope_deg)],
            ),
        ]));
    }
    run.table("body | paper [deg] | ours [deg] | verdict", &rows);
    run.line(
        "The final value turns with the ratio (1.483 and 1.484 above): histories and ranges are compared, not one number.\n\
         I1 is about X, I2 about Y. A triaxial body gives the paper's range if its greater transverse inertia is about X, and\n\
         does not if it is about Y. The paper prints neither axis nor quotient: both are choices, and the range they give is\n\
         no confirmation.",
    );
    run.csv("figure4.csv", "case | time_s | nutation_deg | predicted_deg", csv)?;
    let chart = Chart::new("Nutation during the 2 deg manoeuvre", "time [s]").with(panels);
    run.picture("figure4.svg", &chart)
}

#[cfg(test)]
mod tests {
    //! The verdict follows what was simulated.
    use super::*;

    #[test]
    fn the_verdict_turns_with_the_numbers() {
        let found = |least_deg, most_deg, end_deg| NutationRange {
            least_deg,
            most_deg,
            end_deg,
            envelope_deg: 0.0177,
        };
        for (found, expected) in [
            (found(0.0005, 0.0324, (0.02, 0.03)), "the paper's range and end"),
            (found(0.0005, 0.0324, (0.002, 0.008)), "the paper's range, not its end"),
            (found(0.0005, 0.0359, (0.02, 0.03)), "not the paper's range, though its end"),
            (found(0.0005, 0.0359, (0.01, 0.02)), "not the paper's range, nor its end"),
            (
                found(0.0005, 0.0176, (0.003, 0.003)),
                "not the paper's range: never beyond the envelope of 0.0177",
            ),
            (found(0.0005, 0.0190, (0.003, 0.003)), "not the paper's range, nor its end"),
        ] {
            assert_eq!(found.verdict(), expected);
        }
    }
}
