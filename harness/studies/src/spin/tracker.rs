//! Figures 6 and 7: nutation in star tracker samples, and how long it takes to show.

use core::f64::consts::PI;

use super::spinner::{RATIO, paper_case};
use crate::report::{Outcome, Run};
use crate::verdict::{compared, rounds, verdict, verdict_text};
use drawing::{Chart, Panel, Series};

/// Nutation of the figure, in rad.
const NUTATION_RAD: f64 = 0.02 * PI / 180.0;
/// Length of its picture, in s.
const SHOWN_S: f64 = 800.0;
/// Figure 7 shows times beyond this, in min.
const LONG_MIN: f64 = 30.0;
/// Its picture's height, in min.
const TALLEST_MIN: f64 = 60.0;
const SAMPLINGS: [(&str, &str); 2] = [("clock, every 96 s", "clock"), ("every 8 spins", "spins")];

/// Figure 6.
pub(crate) fn figure6(run: &mut Run<'_>) -> Outcome {
    let samplings = run.chosen(SAMPLINGS, |(label, _)| (*label).to_owned())?;
    let fmu = run.options.fmu("SpinPlant.fmu")?;
    run.line("Declination of a star in the tracker of a nutating spinner (paper 002, Figure 6)");
    let (mut rows, mut csv, mut panels) = (Vec::new(), Vec::new(), Vec::new());
    for (label, sampling) in &samplings {
        let case = paper_case(*label, 14_400.0, 0.5)
            .set("burn.plan", "commanded")
            .set("start.nutation", NUTATION_RAD)
            .set("starTracker.sampling", *sampling);
        let names = [
            "starTracker.declinationTrue",
            "starTracker.sampleTime",
            "starTracker.declination",
            "starTracker.nutation",
            "starTracker.nutationSigma",
        ];
        let simulated = case.simulate(&fmu, &names)?;
        let (times, exact) = (&simulated.times_s, &simulated.columns[0]);
        let mean = exact.iter().sum::<f64>() / exact.len() as f64;
        // Where a sample has just come: the true declination there, and what the tracker measured.
        let samples: Vec<(f64, f64, f64)> = (1..times.len())
            .filter(|&i| {
                simulated.columns[1][i] != simulated.columns[1][i - 1] && simulated.columns[1][i] >= 0.0
            })
            .map(|i| (simulated.columns[1][i], exact[i], simulated.columns[2][i]))
            .collect();
        let first: Vec<_> = samples.iter().take(8).collect();
        let span = match (first.first(), first.last()) {
            (Some(a), Some(b)) => (b.0 - a.0) / 60.0,
            _ => f64::NAN,
        };
        rows.push(compared(
            &format!("{label} | 11.2 min"),
            format!("{span:.2} min"),
            verdict_text(rounds(span, 11.2, 0.1), "span of 8 samples"),
        ));
        rows.push(compared(
            &format!("{label}: nutation from the samples of 4 h | 0.02 deg (set)"),
            format!("{:.4} +- {:.4} deg", simulated.last(3).to_degrees(), simulated.last(4).to_degrees()),
            verdict((simulated.last(3) - NUTATION_RAD).abs() < 3.0 * simulated.last(4)),
        ));
        csv.extend(samples.iter().map(|(time_s, exact, measured)| {
            vec![
                (*label).to_owned(),
                format!("{time_s:.6}"),
                format!("{:.9}", exact.to_degrees()),
                format!("{:.9}", measured.to_degrees()),
            ]
        }));
        // The wave of 8 s is drawn from a simulation of its own, finer than the picture.
        let wave = case.clone().grid(SHOWN_S, 0.05).simulate(&fmu, &names[..1])?;
        let off_deg = |at_s: f64, declination_rad: f64| (at_s, (declination_rad - mean).to_degrees());
        let exact = wave.times_s.iter().zip(&wave.columns[0]).map(|(t, d)| off_deg(*t, *d)).collect();
        let sampled = samples.iter().filter(|s| s.0 <= SHOWN_S).map(|s| off_deg(s.0, s.1)).collect();
        panels.push(
            Panel::new("declination - mean [deg]").range(-0.03, 0.03).with([
                Series::line(format!("{label}: true"), exact),
                Series::dots("where sampled", sampled),
            ]),
        );
    }
    run.table("sampling | paper | ours | verdict", &rows);
    run.line(
        "The declination swings by the nutation angle either way: the paper's \"amplitude twice the nutation angle\" is \
         peak to peak.",
    );
    run.csv("figure6.csv", "sampling | time_s | true_deg | measured_deg", csv)?;
    let chart = Chart::new(format!("Star declination, 0.02 deg nutation, ratio {RATIO}, 5 rpm"), "time [s]")
        .with(panels);
    run.picture("figure6.svg", &chart)
}

/// One point of Figure 7's map, times in min.
struct Point {
    rate_rpm: f64,
    ratio: f64,
    eq20_min: f64,
    clock_min: f64,
    spins_min: f64,
}

/// Figure 7.
pub(crate) fn figure7(run: &mut Run<'_>) -> Outcome {
    let ratios = (0..24).map(|i| 1.4715 + 0.001 * f64::from(i) * 22.5 / 23.0);
    let label = |ratio: &f64| format!("ratio {ratio:.4}");
    let ratios = run.chosen(ratios, label)?;
    let fmu = run.options.fmu("SpinPlant.fmu")?;
    let rates_rpm = |ratio| (0..40).map(move |j| (ratio, 4.9 + 0.2 * (f64::from(j) + 0.5) / 40.0));
    let grid: Vec<(f64, f64)> = ratios.iter().copied().flat_map(rates_rpm).collect();
    let points = run.all(&grid, |&(ratio, rate_rpm)| {
        let time = |sampling: &str| {
            paper_case(label(&ratio), 1.0, 1.0)
                .ratio(ratio)
                .set("burn.plan", "commanded")
                .set("spin.initialRate", rate_rpm * PI / 30.0)
                .set("starTracker.sampling", sampling)
                .simulate(&fmu, &["starTracker.observationTime", "starTracker.observationTimeNominal"])
        };
        let (clock, spins) = (time("clock")?, time("spins")?);
        Ok(Point {
            rate_rpm,
            ratio,
            eq20_min: clock.last(1) / 60.0,
            clock_min: clock.last(0) / 60.0,
            spins_min: spins.last(0) / 60.0,
        })
    })?;
    run.line("Time to see the full range of declinations over spin rate and ratio (paper 002, Figure 7)");
    let percent = |time: fn(&Point) -> f64| {
        let slow = points.iter().filter(|point| time(point) > LONG_MIN).count();
        100.0 * slow as f64 / points.len() as f64
    };
    let [eq20, clock, spins] = [percent(|p| p.eq20_min), percent(|p| p.clock_min), percent(|p| p.spins_min)];
    let share = |percent: f64| format!("{percent:.1} %");
    // Greatest relative spread of the time over the spin rates, among the ratios.
    let spread = points
        .chunk_by(|a, b| a.ratio == b.ratio)
        .map(|line| {
            let most = line.iter().map(|p| p.spins_min).fold(0.0, f64::max);
            most / line.iter().map(|p| p.spins_min).fold(f64::INFINITY, f64::min) - 1.0
        })
        .fold(0.0, f64::max);
    let of_clock = verdict_text((clock - eq20).abs() < 1.0, "what eq 20 approximates");
    let drops_out = "the spin rate drops out but for the length of a spin";
    let of_spins = verdict_text(spread < 0.2 / 4.9 + 0.001, drops_out);
    let rows = [
        compared("eq 20 | about 20 %", share(eq20), verdict((eq20 - 20.0).abs() < 2.0)),
        compared("exact, clock samples every 96 s | -", share(clock), of_clock),
        compared("exact, samples every 8 spins | -", share(spins), of_spins),
    ];
    run.table("beyond 30 min | paper | ours | verdict", &rows);
    run.csv(
        "figure7.csv",
        "spin_rate_rpm | ratio | eq20_min | clock_min | spins_min",
        points.iter().map(|p| {
            let numbers = [p.ratio, p.eq20_min, p.clock_min, p.spins_min].map(|it| format!("{it:.6}"));
            [vec![format!("{:.4}", p.rate_rpm)], numbers.to_vec()].concat()
        }),
    )?;
    let panel = |method: &str, time: fn(&Point) -> f64| {
        // A line ends where it leaves the picture.
        let inside = |time_min: f64| if time_min <= TALLEST_MIN { time_min } else { f64::NAN };
        let mut series: Vec<Series> = ratios
            .iter()
            .step_by((ratios.len() / 4).max(1))
            .map(|ratio| {
                let line = points.iter().filter(|p| p.ratio == *ratio).map(|p| (p.rate_rpm, inside(time(p))));
                Series::line(label(ratio), line.collect())
            })
            .collect();
        series.push(Series::dashed("30 min", vec![(4.9, LONG_MIN), (5.1, LONG_MIN)]));
        Panel::new("observation time [min]").titled(method).range(0.0, TALLEST_MIN).with(series)
    };
    let chart = Chart::new("Nutation observation time", "spin rate [rpm]")
        .with([panel("by equation 20", |p| p.eq20_min), panel("sampled every 8 spins", |p| p.spins_min)]);
    run.picture("figure7.svg", &chart)
}
