//! Figure 4: nutation during the 2 deg manoeuvre, and what shape of body gives the paper's range.

use super::flight::{Case, RATIO, left, open};
use crate::chart::{Chart, Panel, Series};
use crate::{Options, Report, StudyError};

const STOP_S: f64 = 1400.0;

fn cases() -> Vec<Case> {
    let case = |label: &str| Case::new(label, STOP_S, 1.0);
    vec![
        case("axisymmetric, ratio 1.483"),
        case("axisymmetric, ratio 1.484").ratio(1.484),
        case("triaxial, I1/I2 = 1.44").triaxial(RATIO, 1.44),
        case("triaxial, I1/I2 = 1.50").triaxial(RATIO, 1.50),
    ]
}

/// Figure 4.
pub fn figure4(options: &Options) -> Result<Report, StudyError> {
    let cases = cases();
    let wanted = left("spin/figure4", options, cases.iter().map(|case| case.label.as_str()))?;
    let fmu = open(options)?;
    let mut report = Report::default();
    report
        .line("Nutation during a 2 deg manoeuvre of 114 pulses of 32 ms, once a turn (paper 002, Figure 4)");
    let (mut rows, mut panels, mut csv) = (Vec::new(), Vec::new(), Vec::new());
    for case in cases.iter().filter(|case| wanted.contains(&case.label.as_str())) {
        let flown = case.fly(&fmu, &["nutation.angle", "nutation.predicted", "burn.pulsesFired"])?;
        let degrees = |column: usize| flown.columns[column].iter().map(|angle| angle.to_degrees());
        // After the first turns, as one reads a range off a picture.
        let after = |column: usize| degrees(column).skip(60);
        let (least, most) = (after(0).fold(f64::INFINITY, f64::min), after(0).fold(0.0, f64::max));
        let verdict = if case.label.starts_with("axi") {
            "the stated inputs: never beyond the envelope 0.0177"
        } else {
            "the paper's range: its body was most likely triaxial"
        };
        rows.push(vec![
            case.label.clone(),
            "0.001 to 0.032, final 0.024".to_owned(),
            format!("{least:.4} to {most:.4}, final {:.4}", flown.last(0).to_degrees()),
            verdict.to_owned(),
        ]);
        csv.extend(flown.times_s.iter().zip(degrees(0)).zip(degrees(1)).map(
            |((time_s, angle), foreseen)| {
                vec![case.label.clone(), format!("{time_s}"), format!("{angle:.9}"), format!("{foreseen:.9}")]
            },
        ));
        panels.push(Panel {
            y_label: "nutation [deg]".to_owned(),
            series: vec![Series::line(
                case.label.clone(),
                flown.times_s.iter().copied().zip(degrees(0)).collect(),
            )],
            y_range: Some((0.0, 0.05)),
            marks: vec![0.0177],
        });
    }
    report.table(&["body", "paper [deg]", "ours [deg]", "verdict"], &rows);
    report.line(
        "The final value turns with the ratio (1.483 and 1.484 above): histories and ranges are compared, not one number.",
    );
    report.csv(options, "figure4.csv", &["case", "time_s", "nutation_deg", "foreseen_deg"], csv)?;
    let chart = Chart {
        title: "Nutation during the 2 deg manoeuvre".to_owned(),
        x_label: "time [s]".to_owned(),
        panels,
    };
    report.picture(options, "figure4.svg", &chart)?;
    Ok(report)
}
