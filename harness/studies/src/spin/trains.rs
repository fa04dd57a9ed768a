//! Figures 2 and 3: nutation left by a 2 deg manoeuvre in n pulses, once per half turn and once per turn.

use super::spinner::{PERIOD_S, RADIAL_ARM_M, RATIO, eq8, paper_case, width_s};
use crate::report::{Outcome, Run};
use crate::verdict::{AGREES, compared, rounds, verdict, verdict_text};
use drawing::{Chart, Panel, Series};

/// The manoeuvre, in rad.
const MANOEUVRE_RAD: f64 = 2.0 * core::f64::consts::PI / 180.0;
/// Most pulses simulated.
const MOST: u32 = 120;
/// Fewest in the picture: fewer leave so much nutation that nothing is found of the rest.
const FEWEST_SHOWN: u32 = 10;
/// Eq 8 takes pulses for impulses. Pulses as short as 20 of them make, 0.18 s, are impulses but for (Omega l)^2/24.
const IMPULSES: u32 = 20;
/// What that part comes to, in deg: 4e-4 of 0.1 deg a pulse.
const EQ8_DEG: f64 = 5e-5;

struct NutationRow {
    count: u32,
    width_s: f64,
    printed_rad: f64,
    simulated_rad: f64,
}

/// Figure 2: one pulse per half revolution.
pub(crate) fn figure2(run: &mut Run<'_>) -> Outcome {
    figure(run, "figure2", 0.5, 0.0237)
}

/// Figure 3: one pulse per revolution.
pub(crate) fn figure3(run: &mut Run<'_>) -> Outcome {
    figure(run, "figure3", 1.0, 0.0177)
}

fn figure(run: &mut Run<'_>, file: &str, turns: f64, paper_envelope_deg: f64) -> Outcome {
    let label = |count: &u32| format!("n = {count}");
    let counts = run.chosen(1..=MOST, label)?;
    let fmu = run.options.fmu("SpinPlant.fmu")?;
    let phase = core::f64::consts::TAU * turns * RATIO;
    // Too few pulses would have to last beyond half a turn.
    let pulse = |count: &u32| {
        let per_pulse = MANOEUVRE_RAD / f64::from(*count);
        Some((*count, per_pulse, width_s(per_pulse, RADIAL_ARM_M)?))
    };
    let pulses: Vec<(u32, f64, f64)> = counts.iter().filter_map(pulse).collect();
    let rows = run.all(&pulses, |&(count, per_pulse, width_s)| {
        let stop_s = (f64::from(count) * turns + 2.0) * PERIOD_S;
        let simulated = paper_case(label(&count), stop_s, stop_s)
            .set("burn.count", count as i32)
            .set("burn.turnsPerPulse", turns)
            .set("burn.pulseWidth", width_s)
            .simulate(&fmu, &["nutation.angle"])?;
        let printed_rad = eq8(per_pulse, phase, f64::from(count));
        Ok(NutationRow { count, width_s, printed_rad, simulated_rad: simulated.last(0) })
    })?;
    run.line(&format!(
        "Nutation after a 2 deg manoeuvre in n pulses, one every {turns} turns, ratio {RATIO} (paper 002, {file})"
    ));
    run.csv(
        &format!("{file}.csv"),
        "n | pulse_width_s | eq8_deg | simulated_deg | envelope_deg",
        rows.iter().map(|row| {
            let [printed_deg, simulated_deg] = [row.printed_rad, row.simulated_rad].map(f64::to_degrees);
            let numbers =
                [row.width_s, printed_deg, simulated_deg, envelope_deg(f64::from(row.count), phase)];
            [vec![row.count.to_string()], numbers.map(|it| format!("{it:.9}")).to_vec()].concat()
        }),
    )?;
    run.picture(&format!("{file}.svg"), &chart(&rows, turns, phase))?;
    let difference = |least: u32| {
        rows.iter()
            .filter(|row| row.count >= least)
            .map(|row| (row.simulated_rad - row.printed_rad).abs().to_degrees())
            .fold(0.0, f64::max)
    };
    let exact_deg = envelope_deg(113.0, phase);
    let printed_deg = MANOEUVRE_RAD.to_degrees() / 113.0
        * (2.0 * (1.0 + core::f64::consts::TAU * RATIO - 3.0 * core::f64::consts::PI)).sqrt();
    let beyond = rows
        .iter()
        .filter(|row| {
            row.count >= IMPULSES
                && row.simulated_rad.to_degrees() > 1.001 * envelope_deg(f64::from(row.count), phase)
        })
        .count();
    let impulses = rows.iter().filter(|row| row.count >= IMPULSES).count();
    let judged = |holds: bool| if impulses > 0 { verdict(holds) } else { "-" };
    let table = [
        compared(
            &format!("envelope at n = 113 | {paper_envelope_deg} deg"),
            format!("{exact_deg:.5} deg"),
            if rounds(exact_deg, paper_envelope_deg, 1e-4) {
                "agrees, though the paper's equation is misprinted"
            } else {
                // Eq 9 lacks a factor 1/2 inside its root, 1 + x for 1 + x/2, and comes out low by this much.
                verdict_text(
                    rounds(printed_deg, paper_envelope_deg, 1e-4),
                    "as its eq 9 is printed; ours is exact",
                )
            },
        ),
        compared(
            "simulated beyond the exact envelope, n >= 20 | -",
            format!("{beyond} of {impulses}"),
            judged(beyond == 0),
        ),
        compared(
            "eq 8 against simulation, n >= 20 | -",
            format!("{:.6} deg", difference(IMPULSES)),
            judged(difference(IMPULSES) < EQ8_DEG),
        ),
        compared(
            "eq 8 against simulation, all n | -",
            format!("{:.6} deg", difference(1)),
            if difference(1) > EQ8_DEG { "pulses of seconds are no impulses" } else { AGREES },
        ),
    ];
    run.table("quantity | paper | ours | verdict", &table);
    Ok(())
}

fn envelope_deg(count: f64, phase: f64) -> f64 {
    MANOEUVRE_RAD.to_degrees() / count / (0.5 * phase).sin().abs()
}

fn chart(rows: &[NutationRow], turns: f64, phase: f64) -> Chart {
    let shown = || rows.iter().filter(|row| row.count >= FEWEST_SHOWN);
    let at_counts = |value: fn(&NutationRow) -> f64| {
        shown().map(|row| (f64::from(row.count), value(row).to_degrees())).collect()
    };
    let envelope = (FEWEST_SHOWN..=MOST).map(f64::from).map(|n| (n, envelope_deg(n, phase))).collect();
    Chart::new(
        format!(
            "Nutation left by a 2 deg manoeuvre, one pulse {}",
            if turns == 1.0 { "a turn".to_owned() } else { format!("every {turns} turns") }
        ),
        "number of pulses",
    )
    .with([Panel::new("nutation [deg]")
        .range(0.0, 1.05 * envelope_deg(f64::from(FEWEST_SHOWN), phase))
        .with([
            // Eq 8 holds only at whole numbers of pulses.
            Series::rings("linear theory", at_counts(|row| row.printed_rad)),
            Series::line("exact envelope", envelope),
            Series::dots("SpinPlant", at_counts(|row| row.simulated_rad)),
        ])])
}
