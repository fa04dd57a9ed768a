//! Times that test how an FMU compares times: those masters really give, and wrong ones.

use crate::{Error, Times};
use model_description::call_table::State;

use crate::conformance::{
    experiment::{self, STEPS},
    findings::{Findings, Outcome},
    probe::Trial,
};

/// Wrong times: an FMU whose solver continues until it has passed the end of a step may never come back.
pub(crate) const TRIALS: &[Trial] = &[
    wrong("a step from a time that is not its own", false, |findings, it| {
        step(findings, it, |times| (times.start_s + 0.5 * times.step_s, times.step_s))
    }),
    wrong("a step from before its own time", false, |findings, it| {
        step(findings, it, |times| (times.start_s - times.step_s, times.step_s))
    }),
    wrong("a step of no length", false, |findings, it| step(findings, it, |times| (times.start_s, 0.0))),
    wrong("a step backwards", false, |findings, it| {
        step(findings, it, |times| (times.start_s, -times.step_s))
    }),
    wrong("a step past the stop time it was given (2.1.6)", false, |findings, it| {
        step(findings, it, |times| (times.start_s, 1.5 * (times.stop_s - times.start_s)))
    }),
    wrong("a step of NaN", true, |findings, it| step(findings, it, |times| (times.start_s, f64::NAN))),
    wrong("an infinite step", true, |findings, it| {
        step(findings, it, |times| (times.start_s, f64::INFINITY))
    }),
    wrong("a step from an infinite time", true, |findings, it| {
        step(findings, it, |times| (f64::INFINITY, times.step_s))
    }),
    Trial {
        probe: "times",
        call: "fmi2SetupExperiment",
        what: "a start time that is NaN",
        senseless: true,
        disputed: false,
        run: start_at_nan,
    },
];

const fn wrong(what: &'static str, senseless: bool, run: fn(&mut Findings<'_>, &Trial) -> Outcome) -> Trial {
    Trial { probe: "times", call: "fmi2DoStep", what, senseless, disputed: false, run }
}

fn step(findings: &mut Findings<'_>, trial: &Trial, times: impl Fn(&Times) -> (f64, f64)) -> Outcome {
    let (time_s, step_s) = times(&experiment::times(findings.fmu)?);
    findings.try_refused(trial.what, |instance| instance.do_step(time_s, step_s, false))
}

fn start_at_nan(findings: &mut Findings<'_>, trial: &Trial) -> Outcome {
    let mut instance = experiment::at(findings.fmu, &experiment::unchecked(), State::Instantiated)?;
    let outcome = instance.setup_experiment(None, f64::NAN, None).and_then(|()| {
        instance.enter_initialization_mode()?;
        instance.exit_initialization_mode()
    });
    findings.refused(trial.what, outcome);
    Ok(())
}

/// Times as masters really give them, and times that are wrong.
pub(crate) fn probe(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let times = experiment::times(fmu)?;
    let variable_steps = fmu.co_simulation()?.can_handle_variable_communication_step_size;

    // A master that adds up its steps drifts by rounding.
    let mut instance = experiment::ready(fmu, &experiment::strict())?;
    let step_s = (times.stop_s - times.start_s) / 1000.0 / 3.0;
    let step_s = if variable_steps { step_s } else { times.step_s };
    let count = (((times.stop_s - times.start_s) / step_s).floor() as u64).min(500);
    let mut time_s = times.start_s;
    let outcome = (0..count).try_for_each(|_| {
        instance.do_step(time_s, step_s, false)?;
        time_s += step_s;
        Ok::<(), Error>(())
    });
    findings.done("accepts communication points that carry the rounding of a sum", outcome);

    let mut instance = experiment::ready(fmu, &experiment::strict())?;
    let outcome = (0..STEPS.min(times.steps() - 1)).try_for_each(|k| {
        // Off by one in the last place, to either side.
        let exact_s = times.point_s(k);
        let time_s = match k % 3 {
            1 => exact_s.next_up(),
            2 => exact_s.next_down(),
            _ => exact_s,
        };
        instance.do_step(time_s, times.step_s, false)
    });
    findings.done("accepts communication points that are off in the last place", outcome);

    if variable_steps {
        let mut instance = experiment::ready(fmu, &experiment::strict())?;
        let mut time_s = times.start_s;
        let outcome = [1.0, 0.1, 0.37, 1e-3, 0.5].into_iter().try_for_each(|part| {
            let end_s = (time_s + part * times.step_s).min(times.stop_s);
            if end_s > time_s {
                instance.do_step(time_s, end_s - time_s, false)?;
                time_s = end_s;
            }
            Ok::<(), Error>(())
        });
        findings.done("accepts steps of changing size", outcome);
    } else {
        findings.skipped("steps of changing size: it does not claim to take them");
    }
    Ok(())
}
