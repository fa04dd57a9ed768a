//! Every number of paper 002 beside ours, from simulations of SpinPlant.

use core::f64::consts::PI;

use loader::Fmu;
use rayon::prelude::*;

use super::spinner::{
    AXIAL_ARM_M, FORCE_N, PERIOD_S, RADIAL_ARM_M, RATE_RAD_S, SPIN_INERTIA_KG_M2, paper_case,
};
use crate::StudyError;
use crate::attitude::Vector;
use crate::report::{Outcome, Run};
use crate::settings::{Settings, set};
use crate::verdict::{compared, rounded, rounds, verdict, verdict_text};

/// Number of ratios over 1.471 to 1.494 at which trains are simulated.
const RATIOS: u32 = 24;
const DAY_S: f64 = 86_400.0;
/// IIIR and IA by their numbers in the shipped spacecraft.
const RADIAL: i32 = 8;
const AXIAL: i32 = 1;
const AXIAL_OPPOSITE: i32 = 4;

/// Marks rows in which nothing was simulated.
const ARITHMETIC: &str = "agrees (arithmetic, not simulated)";

type Row = Vec<String>;

/// Every number.
pub(crate) fn numbers(run: &mut Run<'_>) -> Outcome {
    let fmu = run.options.fmu("SpinPlant.fmu")?;
    let mut rows = pulses(&fmu)?;
    rows.extend(envelopes(&fmu)?);
    rows.extend(observation(&fmu)?);
    rows.extend(beyond(&fmu)?);
    let table = run.chosen(rows, |row| row[0].clone())?;
    run.line("Numbers of paper 002 beside simulations of SpinPlant");
    let header = "quantity | paper | ours | verdict";
    run.table_and_csv("numbers.csv", header, table)
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
    let one = paper_case("one pulse of 1 s", 40.0, 40.0)
        .set("burn.pulseWidth", 1.0)
        .set("burn.count", 1)
        .simulate(fmu, &names)?;
    let train = |thruster: i32, turns: f64| {
        paper_case("2 deg", 1800.0, 1800.0)
            .with(thrusters(thruster))
            .set("burn.turnsPerPulse", turns)
            .set("burn.angle", 2.0 * PI / 180.0)
            .simulate(fmu, &names)
    };
    let (radial, half, axial) = (train(RADIAL, 1.0)?, train(RADIAL, 0.5)?, train(AXIAL, 1.0)?);
    let total_s = 6.0_f64.to_radians() / one.last(3);
    let [radial_deg, axial_deg] = [&radial, &axial].map(|it| it.last(3).to_degrees());
    let [once_min, twice_min] = [&radial, &half].map(|it| it.last(1) / 60.0);
    let pulse_deg = radial_deg / radial.last(4);
    let (arc_deg, days) = (half_arc_deg(fmu)?, deadband_days(fmu)?);
    Ok(vec![
        rounded(
            "axis moved by one 1 s pulse (eq 3) | 0.0095 rad",
            format!("{:.6} rad planned, {:.6} rad simulated", one.last(0), one.last(3)),
            [one.last(3), 0.0095, 1e-4],
        ),
        compared(
            "thruster time for 6 deg | 11.02 s",
            format!("{total_s:.2} s"),
            verdict_text(
                rounds(total_s, 11.03, 0.01) && rounds(6.0_f64.to_radians() / 0.0095, 11.02, 0.01),
                "paper divides by the rounded 0.0095 rad",
            ),
        ),
        rounded("half arc of a 32 ms pulse | 0.48 deg", format!("{arc_deg:.2} deg"), [arc_deg, 0.48, 0.01]),
        rounded(
            "axis moved by one 32 ms pulse | 0.0176 deg",
            format!("{pulse_deg:.5} deg"),
            [pulse_deg, 0.0176, 1e-4],
        ),
        compared(
            "32 ms pulses for 2 deg, lower radial | 114",
            format!("{} (simulated {radial_deg:.4} deg)", radial.last(4)),
            verdict(rounds(radial.last(4), 114.0, 1.0) && rounds(radial_deg, 2.0, 0.02)),
        ),
        compared(
            "32 ms pulses for 2 deg, upper axial | about 58",
            format!("{} (simulated {axial_deg:.4} deg)", axial.last(4)),
            verdict(rounds(axial.last(4), 58.0, 1.0) && rounds(axial_deg, 2.0, 0.04)),
        ),
        rounded("duration, once a turn | 22.6 min", format!("{once_min:.2} min"), [once_min, 22.6, 0.1]),
        compared(
            "duration, twice a turn | 11.6 min",
            format!("{twice_min:.2} min"),
            verdict_text(rounds(twice_min, 11.3, 0.1), "113 half turns are 11.3 min: a slip of the paper"),
        ),
        compared(
            "simulation, end of the manoeuvre | 1368 s",
            format!("{:.0} s for 114 turns", 114.0 * PERIOD_S),
            verdict_text(rounds(114.0 * PERIOD_S, 1368.0, 1.0), ARITHMETIC),
        ),
        rounded("days in the 3 deg deadband | 6.1 d", format!("{days:.2} d"), [days, 6.1, 0.1]),
    ])
}

/// A thruster and the one that fires opposite it.
fn thrusters(thruster: i32) -> Settings {
    let opposite = if thruster == AXIAL { AXIAL_OPPOSITE } else { 10 };
    [set("burn.thruster", thruster), set("burn.oppositeThruster", opposite)].concat()
}

/// Half the angle by which the body turns while a pulse of 32 ms is on, from the edges of a simulation, in deg.
fn half_arc_deg(fmu: &Fmu) -> Result<f64, StudyError> {
    let simulated = paper_case("half arc", 2.0 * PERIOD_S, 0.016)
        .set("burn.count", 1)
        .simulate(fmu, &["burn.nextEdge", "thruster[8].active", "spin.rate"])?;
    let (mut on_s, mut off_s) = (f64::NAN, f64::NAN);
    let edges = simulated.columns[0].iter().zip(&simulated.columns[1]);
    for (&edge_s, &active) in edges.filter(|(edge_s, _)| **edge_s >= 0.0) {
        if active == 1.0 { off_s = edge_s } else { on_s = edge_s }
    }
    Ok((0.5 * (off_s - on_s) * simulated.columns[2][0]).to_degrees())
}

/// How long the Earth stays within 3 deg of an antenna that stands still, on a circular orbit: from 3 deg on one side, past
/// the antenna, to 3 deg on the other; the second half is simulated.
fn deadband_days(fmu: &Fmu) -> Result<f64, StudyError> {
    let still = |label: &str, stop_s: f64| {
        paper_case(label, stop_s, 600.0)
            .set("burn.plan", "commanded")
            .set("geometry.source", "l1Orbit")
            .set("geometry.amplitude", [0.0; 3])
    };
    let earth = still("where the Earth stands", 600.0).simulate(fmu, &["earth.inertial"])?;
    // The shortest turn that takes +Z opposite the Earth: the antenna looks along -Z.
    let [x, y, z] = (-earth.first::<Vector>()).into();
    let scale = (2.0 * (1.0 + z)).sqrt();
    let q = [-y / scale, x / scale, 0.0, 0.5 * scale];
    let aimed = still("deadband", 4.0 * DAY_S).set("start.q", q);
    let simulated = aimed.simulate(fmu, &["earth.angle"])?;
    let limit_rad = 3.0_f64.to_radians();
    let beyond = simulated.columns[0].iter().position(|angle| *angle > limit_rad).filter(|i| *i > 0);
    Ok(beyond.map_or(f64::NAN, |i| {
        let (before, after) = (simulated.columns[0][i - 1], simulated.columns[0][i]);
        let share = (limit_rad - before) / (after - before);
        let crossing_s = simulated.times_s[i - 1] + share * (simulated.times_s[i] - simulated.times_s[i - 1]);
        2.0 * crossing_s / DAY_S
    }))
}

/// Envelope by eq 9 (once per half turn) and eq 10 (otherwise) as printed, in rad: eq 9 lacks a factor 1/2 inside the root,
/// eq 10 has -1/12 where +1/4 belongs.
fn printed_envelope_rad(per_pulse_rad: f64, ratio: f64, turns_per_pulse: f64) -> f64 {
    let phase_rad = 2.0 * PI * ratio - 3.0 * PI;
    let square =
        if turns_per_pulse == 0.5 { 2.0 * (1.0 + phase_rad) } else { 1.0 - phase_rad.powi(2) / 12.0 };
    per_pulse_rad * square.sqrt()
}

/// Section II: envelopes, by eq 9 and 10 as printed and exactly.
fn envelopes(fmu: &Fmu) -> Result<Vec<Row>, StudyError> {
    let envelope = |thruster: i32, turns: f64, count: f64| -> Result<(f64, f64), StudyError> {
        let arm_m = if thruster == AXIAL { AXIAL_ARM_M } else { RADIAL_ARM_M };
        // Pulses of exactly 2 deg / n.
        let sine =
            2.0_f64.to_radians() / count * SPIN_INERTIA_KG_M2 * RATE_RAD_S.powi(2) / (2.0 * FORCE_N * arm_m);
        let found = paper_case("envelope", 1.0, 1.0)
            .with(thrusters(thruster))
            .set("burn.turnsPerPulse", turns)
            .set("burn.pulseWidth", 2.0 * sine.asin() / RATE_RAD_S)
            .simulate(fmu, &["inertiaRatio", "nutation.envelope"])?;
        let (ratio, exact_rad) = (found.last(0), found.last(1));
        // The FMU's envelope is that of its own pulse: (Gamma / n) / |sin(phi / 2)|.
        let per_pulse_rad = exact_rad * (PI * ratio * turns).sin().abs();
        let printed_rad = printed_envelope_rad(per_pulse_rad, ratio, turns);
        Ok((printed_rad.to_degrees(), exact_rad.to_degrees()))
    };
    let mut rows = Vec::new();
    for (what, paper, thruster, turns, count) in [
        ("envelope, radial, twice a turn | 0.0237 deg", 0.0237, RADIAL, 0.5, 113.0),
        ("envelope, radial, once a turn | 0.0177 deg", 0.0177, RADIAL, 1.0, 113.0),
        ("envelope, axial, twice a turn | 0.0461 deg", 0.0461, AXIAL, 0.5, 58.0),
        ("envelope, axial, once a turn | 0.0345 deg", 0.0345, AXIAL, 1.0, 58.0),
    ] {
        let (printed, exact) = envelope(thruster, turns, count)?;
        rows.push(compared(
            what,
            format!("{printed:.5} deg as printed, {exact:.5} deg exact"),
            verdict_text(rounds(printed, paper, 1e-4), "as printed; eq 9 and 10 are misprinted"),
        ));
    }
    let hours = 9.5 * (envelope(RADIAL, 0.5, 113.0)?.0 / envelope(RADIAL, 1.0, 113.0)?.0).ln();
    let holds = verdict((hours - 2.75).abs() < 0.1);
    rows.push(compared("damping time avoided by once a turn | 2 3/4 h", format!("{hours:.2} h"), holds));
    let damped = paper_case("damping", 9.5 * 3600.0, 9.5 * 3600.0)
        .set("damper.timeConstant", 9.5 * 3600.0)
        .set("burn.plan", "commanded")
        .set("start.nutation", 0.02_f64.to_radians())
        .simulate(fmu, &["nutation.angle"])?;
    let left = damped.last(0) / 0.02_f64.to_radians();
    let paper = (-1.0_f64).exp();
    rows.push(rounded("nutation left after 9.5 h | 1/e = 0.3679", format!("{left:.4}"), [left, paper, 1e-4]));
    Ok(rows)
}

/// Section IV and eq 1.
fn observation(fmu: &Fmu) -> Result<Vec<Row>, StudyError> {
    let tracker = paper_case("observation", 1.0, 1.0)
        .set("starTracker.sampling", "clock")
        .simulate(fmu, &["starTracker.observationTimeNominal", "starTracker.observationTime"])?;
    let minutes = tracker.last(0) / 60.0;
    // Nutation that 7 ms allow, from eq 1's slope in the FMU at two Sun angles.
    let allowed = |beta_deg: f64| -> Result<f64, StudyError> {
        let beta = beta_deg.to_radians();
        // The axis stands `nutation` off the momentum; the Sun is revolution about the line both lie across.
        let nutation = 1e-6;
        let found = paper_case("eq 1", 1e-3, 1e-3)
            .set("burn.plan", "commanded")
            .set("start.nutation", nutation)
            .set("sun.direction", [0.0, beta.sin(), beta.cos()])
            .simulate(fmu, &["spin.periodVariation"])?;
        Ok((0.007 * nutation / found.columns[0][0]).to_degrees())
    };
    let (wide, narrow) = (allowed(20.0)?, allowed(1.0)?);
    let exact = tracker.last(1) / 60.0;
    Ok(vec![
        compared(
            "observation time at 5 rpm, ratio 1.483 | 11.2 min",
            format!("{minutes:.2} min by eq 20, {exact:.2} min exactly"),
            // 8 samples 96 s apart span 7 of these; figure6 runs them.
            verdict_text(
                rounds(minutes, 11.76, 0.01) && rounds(7.0 * 96.0 / 60.0, 11.2, 0.1),
                "11.2 min is the span of 8 samples, not eq 20",
            ),
        ),
        // The notes to the paper solve eq 1 by hand.
        compared(
            "nutation that 7 ms allow at a Sun angle of 20 deg | -",
            format!("{wide:.4} deg"),
            verdict_text(rounds(wide, 0.038, 1e-3), "eq 1"),
        ),
        compared(
            "nutation that 7 ms allow at a Sun angle of 1 deg | -",
            format!("{narrow:.4} deg"),
            verdict_text(rounds(narrow, 0.0018, 1e-4), "eq 1 diverges as the Sun angle goes to 0"),
        ),
    ])
}

/// The worst of simulations over the range of ratios.
struct Worst {
    final_deg: f64,
    peak_deg: f64,
    duration_min: f64,
    /// Greatest peak as a share of the same simulation's exact envelope of a uniform train.
    envelope_share: f64,
    /// Least and greatest move.
    moved_deg: (f64, f64),
}

impl Worst {
    fn of(fmu: &Fmu, plan: &str, order: i32, count: i32) -> Result<Self, StudyError> {
        let simulations: Vec<[f64; 5]> = (0..RATIOS)
            .into_par_iter()
            .map(|i| {
                let ratio = 1.471 + 0.023 * f64::from(i) / f64::from(RATIOS - 1);
                let names =
                    ["nutation.angle", "burn.plannedDuration", "nutation.envelope", "momentum.displacement"];
                let simulated = paper_case(format!("plan {plan} at {ratio:.4}"), 1500.0, 6.0)
                    .ratio(ratio)
                    .set("burn.plan", plan)
                    .set("burn.taperOrder", order)
                    .set("burn.count", count)
                    .set("burn.pulseWidth", 0.032)
                    .simulate(fmu, &names)?;
                let [left_deg, moved_deg] = [0, 3].map(|column| simulated.last(column).to_degrees());
                let (peak_rad, duration_min) = (simulated.most(0), simulated.last(1) / 60.0);
                let envelope_share = peak_rad / simulated.last(2);
                Ok([left_deg, peak_rad.to_degrees(), duration_min, envelope_share, moved_deg])
            })
            .collect::<Result<_, StudyError>>()?;
        let of = |k: usize| simulations.iter().map(move |simulation| simulation[k]);
        let [final_deg, peak_deg, duration_min, envelope_share, most_deg] =
            [0, 1, 2, 3, 4].map(|k| of(k).fold(0.0, f64::max));
        let moved_deg = (of(4).fold(f64::INFINITY, f64::min), most_deg);
        Ok(Self { final_deg, peak_deg, duration_min, envelope_share, moved_deg })
    }

    fn text(&self) -> String {
        let Self { final_deg, peak_deg, duration_min, .. } = self;
        format!("final {final_deg:.5} deg, peak {peak_deg:.4} deg, {duration_min:.2} min")
    }

    /// Whether the turn is 2 deg within whole pulses, 2 %.
    fn turns(&self) -> bool {
        self.moved_deg.0 > 1.96 && self.moved_deg.1 < 2.04
    }

    /// What it has over `paper`'s plan, and what it pays.
    fn beyond(&self, paper: &Self) -> String {
        let (nutation, duration) = (paper.final_deg / self.final_deg, paper.duration_min / self.duration_min);
        let text = format!(
            "nutation 1/{nutation:.0}, duration 1/{duration:.1}, peak {:.1} times",
            self.peak_deg / paper.peak_deg
        );
        verdict_text(self.turns() && nutation > 1.0 && duration > 1.0, &text).to_owned()
    }
}

/// Beyond the paper: trains that end with little nutation.
fn beyond(fmu: &Fmu) -> Result<Vec<Row>, StudyError> {
    let (uniform, tapered) = (Worst::of(fmu, "uniform", 1, 114)?, Worst::of(fmu, "tapered", 1, 58)?);
    let (second, fourth) = (Worst::of(fmu, "tapered", 2, 30)?, Worst::of(fmu, "tapered", 4, 11)?);
    let as_stated = tapered.turns() && tapered.final_deg < 0.0033 && tapered.duration_min < 11.45;
    let split = paper_case("split train", 1600.0, 1600.0)
        .set("burn.plan", "split")
        .simulate(fmu, &["nutation.angle", "burn.plannedDuration", "burn.done", "momentum.displacement"])?;
    let (split_deg, split_moved_deg) = (split.last(0).to_degrees(), split.last(3).to_degrees());
    let better = |train: &str, it: &Worst| {
        compared(&format!("{train}, worst of 1.471 to 1.494 | -"), it.text(), &it.beyond(&uniform))
    };
    Ok(vec![
        compared(
            "uniform train, worst of 1.471 to 1.494 | envelope 0.0177 deg, 22.6 min",
            uniform.text(),
            verdict(
                uniform.turns()
                    && uniform.envelope_share < 1.001
                    && rounds(uniform.peak_deg, 0.0177, 1e-4)
                    && rounds(uniform.duration_min, 22.6, 0.1),
            ),
        ),
        compared(
            "train 1 2 2 ... 2 1, worst of 1.471 to 1.494 | -",
            tapered.text(),
            verdict_text(as_stated, "2 deg in 11.4 min under 0.0033 deg"),
        ),
        better("train 1 3 4 ... 4 3 1", &second),
        better("binomial train of order 4", &fourth),
        compared(
            "split train, ratio known | -",
            format!("final {split_deg:.6} deg, {:.2} min", split.last(1) / 60.0),
            verdict_text(
                split.last(2) == 1.0 && split_deg < 2e-5 && rounds(split_moved_deg, 2.0, 0.08),
                "ends without nutation",
            ),
        ),
    ])
}
