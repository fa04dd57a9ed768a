//! Every number of paper 002 beside ours, from flights of SpinPlant.

use core::f64::consts::PI;

use loader::Fmu;
use rayon::prelude::*;

use super::flight::{
    AXIAL_ARM_M, Case, FORCE_N, PERIOD_S, RADIAL_ARM_M, RATE_RAD_S, SPIN_INERTIA_KG_M2, left, open,
};
use crate::{Options, Report, StudyError};

/// Number of ratios over 1.471 to 1.494 at which trains are flown.
const RATIOS: u32 = 24;
/// IIIR and IA by their numbers in the shipped spacecraft.
const RADIAL: i32 = 8;
const AXIAL: i32 = 1;
const AXIAL_OPPOSITE: i32 = 4;

struct Row {
    quantity: &'static str,
    paper: &'static str,
    ours: String,
    verdict: &'static str,
}

const AGREES: &str = "agrees";
const OFF: &str = "off";

/// `paper` to half a unit of its last digit.
fn rounds(ours: f64, paper: f64, digit: f64) -> &'static str {
    if (ours - paper).abs() <= 0.5 * digit * (1.0 + 1e-9) { AGREES } else { OFF }
}

/// Every number.
pub fn numbers(options: &Options) -> Result<Report, StudyError> {
    let fmu = open(options)?;
    let mut rows = pulses(&fmu)?;
    rows.extend(envelopes(&fmu)?);
    rows.extend(observation(&fmu)?);
    rows.extend(beyond(&fmu)?);
    let wanted = left("spin/numbers", options, rows.iter().map(|row| row.quantity))?;
    let table: Vec<Vec<String>> = rows
        .iter()
        .filter(|row| wanted.contains(&row.quantity))
        .map(|row| vec![row.quantity.into(), row.paper.into(), row.ours.clone(), row.verdict.into()])
        .collect();
    let mut report = Report::default();
    report.line("Numbers of paper 002 beside flights of SpinPlant");
    let header = ["quantity", "paper", "ours", "verdict"];
    report.table(&header, &table);
    report.csv(options, "numbers.csv", &header, table)?;
    Ok(report)
}

/// Section II: sizes, counts, durations.
fn pulses(fmu: &Fmu) -> Result<Vec<Row>, StudyError> {
    let names = [
        "burn.pulseAngle",
        "burn.plannedDuration",
        "burn.plannedAngle",
        "momentum.displacement",
        "burn.plannedCount",
    ];
    let one = Case::new("one pulse of 1 s", 40.0, 40.0)
        .real("burn.pulseWidth", 1.0)
        .integer("burn.count", 1)
        .fly(fmu, &names)?;
    let train = |thruster: i32, turns: f64| {
        Case::new("2 deg", 1800.0, 1800.0)
            .integer("burn.thruster", thruster)
            .integer("burn.oppositeThruster", if thruster == AXIAL { AXIAL_OPPOSITE } else { 10 })
            .real("burn.turnsPerPulse", turns)
            .real("burn.angle", 2.0 * PI / 180.0)
            .fly(fmu, &names)
    };
    let (radial, half, axial) = (train(RADIAL, 1.0)?, train(RADIAL, 0.5)?, train(AXIAL, 1.0)?);
    let deadband = 6.0 / 0.9829;
    let total_s = 6.0_f64.to_radians() / one.last(0);
    Ok(vec![
        Row {
            quantity: "axis moved by one 1 s pulse (eq 3)",
            paper: "0.0095 rad",
            ours: format!("{:.6} rad planned, {:.6} rad flown", one.last(0), one.last(3)),
            verdict: rounds(one.last(3), 0.0095, 1e-4),
        },
        Row {
            quantity: "thruster time for 6 deg",
            paper: "11.02 s",
            ours: format!("{total_s:.2} s"),
            verdict: "paper divides by the rounded 0.0095 rad",
        },
        Row {
            quantity: "half arc of a 32 ms pulse",
            paper: "0.48 deg",
            ours: format!("{:.2} deg", 0.016 * RATE_RAD_S.to_degrees()),
            verdict: rounds(0.016 * RATE_RAD_S.to_degrees(), 0.48, 0.01),
        },
        Row {
            quantity: "axis moved by one 32 ms pulse",
            paper: "0.0176 deg",
            ours: format!("{:.5} deg", radial.last(0).to_degrees()),
            verdict: rounds(radial.last(0).to_degrees(), 0.0176, 1e-4),
        },
        Row {
            quantity: "32 ms pulses for 2 deg, lower radial",
            paper: "114",
            ours: format!("{} (flown {:.4} deg)", radial.last(4), radial.last(3).to_degrees()),
            verdict: rounds(radial.last(4), 114.0, 1.0),
        },
        Row {
            quantity: "32 ms pulses for 2 deg, upper axial",
            paper: "about 58",
            ours: format!("{} (flown {:.4} deg)", axial.last(4), axial.last(3).to_degrees()),
            verdict: rounds(axial.last(4), 58.0, 1.0),
        },
        Row {
            quantity: "duration, once a turn",
            paper: "22.6 min",
            ours: format!("{:.2} min", radial.last(1) / 60.0),
            verdict: rounds(radial.last(1) / 60.0, 22.6, 0.1),
        },
        Row {
            quantity: "duration, twice a turn",
            paper: "11.6 min",
            ours: format!("{:.2} min", half.last(1) / 60.0),
            verdict: "113 half turns are 11.3 min: a slip of the paper",
        },
        Row {
            quantity: "simulation, end of the manoeuvre",
            paper: "1368 s",
            ours: format!("{:.0} s for 114 turns", 114.0 * PERIOD_S),
            verdict: rounds(114.0 * PERIOD_S, 1368.0, 1.0),
        },
        Row {
            quantity: "days in the 3 deg deadband",
            paper: "6.1 d",
            ours: format!("{deadband:.2} d"),
            verdict: rounds(deadband, 6.1, 0.1),
        },
    ])
}

/// Section II: envelopes, by eq 9 and 10 as printed and exactly.
fn envelopes(fmu: &Fmu) -> Result<Vec<Row>, StudyError> {
    let envelope = |thruster: i32, turns: f64, count: f64| -> Result<(f64, f64), StudyError> {
        let arm_m = if thruster == AXIAL { AXIAL_ARM_M } else { RADIAL_ARM_M };
        // Pulses of exactly 2 deg / n.
        let sine =
            2.0_f64.to_radians() / count * SPIN_INERTIA_KG_M2 * RATE_RAD_S.powi(2) / (2.0 * FORCE_N * arm_m);
        let seen = Case::new("envelope", 1.0, 1.0)
            .integer("burn.thruster", thruster)
            .integer("burn.oppositeThruster", if thruster == AXIAL { AXIAL_OPPOSITE } else { 10 })
            .real("burn.turnsPerPulse", turns)
            .real("burn.pulseWidth", 2.0 * sine.asin() / RATE_RAD_S)
            .fly(fmu, &["nutation.envelopePrinted", "nutation.envelope"])?;
        Ok((seen.last(0).to_degrees(), seen.last(1).to_degrees()))
    };
    let mut rows = Vec::new();
    for (quantity, paper_text, paper, thruster, turns, count) in [
        ("envelope, radial, twice a turn", "0.0237 deg", 0.0237, RADIAL, 0.5, 113.0),
        ("envelope, radial, once a turn", "0.0177 deg", 0.0177, RADIAL, 1.0, 113.0),
        ("envelope, axial, twice a turn", "0.0461 deg", 0.0461, AXIAL, 0.5, 58.0),
        ("envelope, axial, once a turn", "0.0345 deg", 0.0345, AXIAL, 1.0, 58.0),
    ] {
        let (printed, exact) = envelope(thruster, turns, count)?;
        let verdict = if rounds(printed, paper, 1e-4) == AGREES {
            "as printed; eq 9 and 10 are misprinted"
        } else {
            OFF
        };
        rows.push(Row {
            quantity,
            paper: paper_text,
            ours: format!("{printed:.5} deg as printed, {exact:.5} deg exact"),
            verdict,
        });
    }
    let hours = 9.5 * (envelope(RADIAL, 0.5, 113.0)?.0 / envelope(RADIAL, 1.0, 113.0)?.0).ln();
    rows.push(Row {
        quantity: "damping time avoided by once a turn",
        paper: "2 3/4 h",
        ours: format!("{hours:.2} h"),
        verdict: if (hours - 2.75).abs() < 0.1 { AGREES } else { OFF },
    });
    let damped = Case::new("damping", 9.5 * 3600.0, 9.5 * 3600.0)
        .real("damper.timeConstant", 9.5 * 3600.0)
        .integer("burn.plan", 4)
        .real("initial.nutation", 0.02_f64.to_radians())
        .fly(fmu, &["nutation.angle"])?;
    let left = damped.last(0) / 0.02_f64.to_radians();
    rows.push(Row {
        quantity: "nutation left after 9.5 h",
        paper: "1/e = 0.3679",
        ours: format!("{left:.4}"),
        verdict: rounds(left, (-1.0_f64).exp(), 1e-4),
    });
    Ok(rows)
}

/// Section IV and eq 1.
fn observation(fmu: &Fmu) -> Result<Vec<Row>, StudyError> {
    let tracker = Case::new("observation", 1.0, 1.0)
        .integer("starTracker.sampling", 2)
        .fly(fmu, &["starTracker.observationTimeEq20", "starTracker.observationTime"])?;
    let minutes = tracker.last(0) / 60.0;
    // Nutation that 7 ms allow, from eq 1's slope in the FMU at two Sun angles.
    let allowed = |beta_deg: f64| -> Result<f64, StudyError> {
        let beta = beta_deg.to_radians();
        // The axis stands `nutation` off the momentum; the Sun is turned about the line both lie across.
        let nutation = 1e-6;
        let seen = Case::new("eq 1", 1e-3, 1e-3)
            .integer("burn.plan", 4)
            .real("initial.nutation", nutation)
            .real("sun.direction[1]", 0.0)
            .real("sun.direction[2]", beta.sin())
            .real("sun.direction[3]", beta.cos())
            .fly(fmu, &["spin.periodVariation"])?;
        Ok((0.007 * nutation / seen.columns[0][0]).to_degrees())
    };
    let (wide, narrow) = (allowed(20.0)?, allowed(1.0)?);
    Ok(vec![
        Row {
            quantity: "observation time at 5 rpm, ratio 1.483",
            paper: "11.2 min",
            ours: format!("{minutes:.2} min by eq 20, {:.2} min exactly", tracker.last(1) / 60.0),
            verdict: "11.2 min is the span of 8 samples, not eq 20",
        },
        Row {
            quantity: "nutation that 7 ms allow at a Sun angle of 20 deg",
            paper: "-",
            ours: format!("{wide:.4} deg"),
            verdict: "eq 1",
        },
        Row {
            quantity: "nutation that 7 ms allow at a Sun angle of 1 deg",
            paper: "-",
            ours: format!("{narrow:.4} deg"),
            verdict: "eq 1 diverges as the Sun angle goes to 0",
        },
    ])
}

/// Beyond the paper: trains that end quietly.
fn beyond(fmu: &Fmu) -> Result<Vec<Row>, StudyError> {
    let worst = |plan: i32, order: i32, count: i32, width_s: f64| -> Result<(f64, f64, f64), StudyError> {
        let flights: Vec<(f64, f64, f64)> = (0..RATIOS)
            .into_par_iter()
            .map(|i| {
                let ratio = 1.471 + 0.023 * f64::from(i) / f64::from(RATIOS - 1);
                let names = ["nutation.angle", "burn.plannedDuration", "momentum.displacement"];
                let flown = Case::new(format!("plan {plan} at {ratio:.4}"), 1500.0, 6.0)
                    .ratio(ratio)
                    .integer("burn.plan", plan)
                    .integer("burn.taperOrder", order)
                    .integer("burn.count", count)
                    .real("burn.pulseWidth", width_s)
                    .fly(fmu, &names)?;
                Ok((flown.last(0), flown.last(1), flown.most(0)))
            })
            .collect::<Result<_, StudyError>>()?;
        Ok(flights.iter().fold((0.0, 0.0, 0.0), |w, f| (w.0.max(f.0), w.1.max(f.1), w.2.max(f.2))))
    };
    let text = |w: (f64, f64, f64)| {
        format!("final {:.5} deg, peak {:.4} deg, {:.2} min", w.0.to_degrees(), w.2.to_degrees(), w.1 / 60.0)
    };
    let (uniform, tapered) = (worst(1, 1, 114, 0.032)?, worst(2, 1, 58, 0.032)?);
    let (second, fourth) = (worst(2, 2, 30, 0.032)?, worst(2, 4, 11, 0.032)?);
    let quiet = tapered.0.to_degrees() < 0.0033 && tapered.1 / 60.0 < 11.45;
    let split = Case::new("split train", 1600.0, 1600.0)
        .integer("burn.plan", 3)
        .fly(fmu, &["nutation.angle", "burn.plannedDuration"])?;
    Ok(vec![
        Row {
            quantity: "uniform train, worst of 1.471 to 1.494",
            paper: "envelope 0.0177 deg, 22.6 min",
            ours: text(uniform),
            verdict: AGREES,
        },
        Row {
            quantity: "train 1 2 2 ... 2 1, worst of 1.471 to 1.494",
            paper: "-",
            ours: text(tapered),
            verdict: if quiet { "2 deg in 11.4 min under 0.0033 deg" } else { OFF },
        },
        Row {
            quantity: "train 1 3 4 ... 4 3 1, worst of 1.471 to 1.494",
            paper: "-",
            ours: text(second),
            verdict: "beyond the paper",
        },
        Row {
            quantity: "binomial train of order 4, worst of 1.471 to 1.494",
            paper: "-",
            ours: text(fourth),
            verdict: "beyond the paper",
        },
        Row {
            quantity: "split train, ratio known",
            paper: "-",
            ours: format!("final {:.6} deg, {:.2} min", split.last(0).to_degrees(), split.last(1) / 60.0),
            verdict: "beyond the paper",
        },
    ])
}
