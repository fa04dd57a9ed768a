//! Attitude jitter of a flexible spacecraft by a wheel out of balance: lines at the wheel's speed and at the modes.

use super::jitter_flight::{COUNT, FASTEST_HZ, JitterCase, LOWEST_HZ, RATE_HZ, Shaken, run_up};
use super::jitter_theory::Structure;
use super::spectrum::Spectrum;
use crate::cells::row;
use crate::report::{Outcome, Run};
use drawing::{Chart, Panel, Series};

/// Speeds of the wheel beside those of the modes, in Hz.
const SPEEDS_HZ: [f64; 4] = [0.7, 2.0, 4.5, 8.5];
/// Speed under control, in Hz.
const CONTROLLED_HZ: f64 = 4.5;
const HEADER: &str = "\
    case | wheel [Hz] | line at [Hz] | amplitude [urad] | in closed form [urad] | ratio | \
    greatest at a mode [urad] | rms [urad]";

fn flights(structure: &Structure) -> Vec<JitterCase> {
    let flight = |wheel_hz: f64, controlled: bool, at: String| {
        let how = if controlled { "controlled" } else { "free" };
        JitterCase {
            label: format!("{how}, {at}"),
            wheel_hz: Spectrum::nearest_hz(COUNT, RATE_HZ, wheel_hz),
            controlled,
        }
    };
    let beside = SPEEDS_HZ.map(|hz| flight(hz, false, format!("wheel at {hz} Hz")));
    let at_modes = structure
        .modes
        .iter()
        .enumerate()
        .map(|(k, mode)| flight(structure.resonance_hz(mode), false, format!("wheel at mode {}", k + 1)));
    let mut all: Vec<JitterCase> = beside.into_iter().chain(at_modes).collect();
    all.sort_by(|a, b| a.wheel_hz.total_cmp(&b.wheel_hz));
    all.push(flight(0.0, true, "wheel stands".to_owned()));
    all.push(flight(CONTROLLED_HZ, true, format!("wheel at {CONTROLLED_HZ} Hz")));
    all
}

const URAD: f64 = 1e6;
/// What is less is drawn there.
const MIN_DB: f64 = -110.0;

fn shown(shaken: &Shaken, structure: &Structure) -> Vec<String> {
    let Shaken { flight, spectrum } = shaken;
    let turns = flight.wheel_hz > 0.0;
    let (line_hz, line) = spectrum.greatest(flight.wheel_hz - 0.02, flight.wheel_hz + 0.02);
    let theory = structure.jitter_rad(flight.wheel_hz);
    let at_modes = structure.modes.iter().map(|mode| {
        let hz = structure.resonance_hz(mode);
        spectrum.greatest(0.97 * hz, 1.03 * hz).1
    });
    let or_none = |value: String| if turns { value } else { "-".to_owned() };
    vec![
        flight.label.clone(),
        format!("{:.3}", flight.wheel_hz),
        or_none(format!("{line_hz:.3}")),
        or_none(format!("{:.5}", URAD * line)),
        or_none(format!("{:.5}", URAD * theory)),
        or_none(format!("{:.4}", line / theory)),
        format!("{:.5}", URAD * at_modes.fold(0.0, f64::max)),
        format!("{:.5}", URAD * spectrum.rms(LOWEST_HZ, 0.5 * RATE_HZ)),
    ]
}

/// Spectra at constant speeds, and a run-up through the modes.
pub(crate) fn jitter(run: &mut Run<'_>) -> Outcome {
    let fmu = run.options.fmu("FlexibleCraft.fmu")?;
    let structure = Structure::read(&fmu)?;
    let cases = run.chosen(flights(&structure), |flight| flight.label.clone())?;
    let shaken = run.all(&cases, |flight| flight.simulated(&fmu, &structure))?;
    run.line("Attitude jitter by the static imbalance of one wheel of FlexibleCraft\n");
    let rows: Vec<_> = shaken.iter().map(|shaken| shown(shaken, &structure)).collect();
    run.table_and_csv("jitter.csv", HEADER, rows)?;
    for (k, mode) in structure.modes.iter().enumerate() {
        run.line(&format!(
            "Mode {}: {:.3} Hz with the body held, {:.3} Hz with the body free.",
            k + 1,
            mode.frequency_hz,
            structure.resonance_hz(mode)
        ));
    }
    run.line(REMARK);
    let lines = shaken.iter().flat_map(|Shaken { flight, spectrum }| {
        let points = spectrum.between(LOWEST_HZ, FASTEST_HZ + 1.0);
        points.map(|(hz, amplitude)| row![flight.label.as_str(), hz, amplitude])
    });
    run.csv("jitter-spectra.csv", "case | frequency_hz | amplitude_rad", lines)?;
    run.picture("jitter-spectra.svg", &spectra(&shaken))?;
    if run.options.only.is_none() {
        let points = run_up(&fmu, &structure)?;
        let header = "wheel_hz | amplitude_rad | in_closed_form_rad";
        let rows = points.iter().map(|&(hz, rad)| row![hz, rad, structure.jitter_rad(hz)]);
        run.csv("jitter-run-up.csv", header, rows)?;
        run.picture("jitter-run-up.svg", &run_up_figure(&points, &structure))?;
    }
    Ok(())
}

const REMARK: &str = "\
Amplitude: that of the body's angle, the three axes together, from the rate under Hann's window over 164 s, after 240 s.
Closed form: force U W^2 at the wheel's place on a body with its modes, all of them linear. At a mode: within 3 % of its
frequency with the body free. Rms from 0.2 to 50 Hz. Free: nothing acts but the wheel. Controlled: the controller at 50 Hz,
with noise of 20 urad of the star tracker and 1 urad after a second of the gyros, assumed; its torque rings the modes.";

/// Amplitudes in dB relative to 1 urad.
fn decibels(amplitude_rad: f64) -> f64 {
    20.0 * (URAD * amplitude_rad).log10()
}

fn spectra(shaken: &[Shaken]) -> Chart {
    let panel = |controlled: bool, y_label: &str| {
        let chosen = shaken.iter().filter(move |it| it.flight.controlled == controlled);
        let series = chosen.map(|Shaken { flight, spectrum }| {
            let points = spectrum.between(LOWEST_HZ, FASTEST_HZ + 1.0);
            let points = points.map(|(hz, amplitude)| (hz, decibels(amplitude).max(MIN_DB)));
            Series::line(flight.label.clone(), points.collect())
        });
        Panel::new(y_label).with(series)
    };
    let panels = [panel(false, "free [dB re 1 urad]"), panel(true, "controlled [dB re 1 urad]")];
    Chart::new("Attitude jitter by a wheel out of balance", "frequency [Hz]")
        .with(panels.into_iter().filter(|panel| !panel.series.is_empty()))
}

fn run_up_figure(points: &[(f64, f64)], structure: &Structure) -> Chart {
    let simulated = points.iter().map(|(hz, rad)| (*hz, decibels(*rad))).collect();
    let steady = (60..=1000).map(|k| f64::from(k) * 0.01).filter(|hz| *hz <= FASTEST_HZ);
    let steady = steady.map(|hz| (hz, decibels(structure.jitter_rad(hz)))).collect();
    Chart::new("A wheel run up through the modes", "speed of the wheel [Hz]").with([Panel::new(
        "jitter [dB re 1 urad]",
    )
    .with([
        Series::line("run up to 9 Hz in 600 s", simulated),
        Series::dashed("at constant speed, in closed form", steady),
    ])])
}
