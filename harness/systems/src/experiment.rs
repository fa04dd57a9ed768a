//! The default experiment of a system: its own, and what its FMUs have where it leaves something out.

use fmi::Fmu;
use model_description::DefaultExperiment;

/// Completes a default experiment: earliest start and stop and smallest step of the FMUs where they are left out.
pub(crate) fn complete<'a>(
    given: DefaultExperiment,
    fmus: impl Iterator<Item = &'a Fmu> + Clone,
) -> DefaultExperiment {
    let smallest = |of: fn(&DefaultExperiment) -> Option<f64>| {
        let all = fmus.clone().filter_map(|fmu| of(fmu.description().default_experiment.as_ref()?));
        all.min_by(f64::total_cmp)
    };
    DefaultExperiment {
        start_time: given.start_time.or_else(|| smallest(|it| it.start_time)),
        stop_time: given.stop_time.or_else(|| smallest(|it| it.stop_time)),
        step_size: given.step_size.or_else(|| smallest(|it| it.step_size)),
        tolerance: None,
    }
}
