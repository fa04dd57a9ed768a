//! The default experiment of a system: its own, and what its FMUs have where it leaves something out.

use loader::Fmu;
use model_description::DefaultExperiment;

use crate::structure::Experiment;

/// What is left out is the earliest start and stop and the smallest step of the FMUs.
pub(crate) fn complete<'a>(given: Experiment, fmus: impl Iterator<Item = &'a Fmu> + Clone) -> Experiment {
    let smallest = |of: fn(&DefaultExperiment) -> Option<f64>| {
        let all = fmus.clone().filter_map(|fmu| of(fmu.description().default_experiment.as_ref()?));
        all.min_by(f64::total_cmp)
    };
    Experiment {
        start_s: given.start_s.or_else(|| smallest(|it| it.start_time)),
        stop_s: given.stop_s.or_else(|| smallest(|it| it.stop_time)),
        step_s: given.step_s.or_else(|| smallest(|it| it.step_size)),
    }
}
