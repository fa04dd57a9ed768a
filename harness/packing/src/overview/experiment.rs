//! Default experiments, in a line.

use model_description::DefaultExperiment;

/// Times of a default experiment, those that it has.
pub fn times(experiment: &DefaultExperiment) -> String {
    let times = [
        ("start", experiment.start_time, " s"),
        ("stop", experiment.stop_time, " s"),
        ("step", experiment.step_size, " s"),
        ("tolerance", experiment.tolerance, ""),
    ];
    let times = times.into_iter().filter_map(|(name, value, unit)| Some((name, value?, unit)));
    times
        .map(|(name, value, unit)| format!("{name} {}{unit}", terminal::short(value)))
        .collect::<Vec<_>>()
        .join(", ")
}
