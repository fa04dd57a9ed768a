//! States: saved, restored, serialised, reset, all to the bit.

use crate::{Error, Fmu, Instance, InstanceOptions};
use model_description::call_table::State;

use crate::conformance::{
    experiment::{self, Bits, STEPS},
    findings::{Findings, Outcome},
};

/// Saves between two steps and compares what follows.
pub(crate) fn probe(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let flags = fmu.co_simulation()?;
    let half = STEPS / 2;

    let mut fresh = experiment::ready(fmu, &experiment::strict())?;
    let at_start = experiment::outputs(&mut fresh)?;
    experiment::simulate(&mut fresh, 0, STEPS)?;
    let at_end = experiment::outputs(&mut fresh)?;

    let again = experiment::short_simulation(fmu, &experiment::strict())?;
    findings.expect(again == at_end, "a second simulation gives the same bits");

    let same = after_reset(&mut fresh)? == [at_start, at_end.clone()];
    findings.expect(same, "after fmi2Reset it runs as a fresh instance, to the bit");

    if !flags.can_get_and_set_fmu_state {
        findings.skipped("saving and restoring: not claimed");
        return Ok(());
    }
    let mut instance = experiment::ready(fmu, &experiment::strict())?;
    experiment::simulate(&mut instance, 0, half)?;
    let at_half = experiment::outputs(&mut instance)?;
    let saved = instance.save_state()?;
    findings.expect(experiment::outputs(&mut instance)? == at_half, "saving changes nothing");
    experiment::simulate(&mut instance, half, STEPS)?;
    let first = experiment::outputs(&mut instance)?;
    instance.restore_state(saved)?;
    let restored = experiment::outputs(&mut instance)?;
    findings.expect(restored == at_half, "a restored state has the outputs it was saved with");
    experiment::simulate(&mut instance, half, STEPS)?;
    let second = experiment::outputs(&mut instance)?;
    findings.expect(first == second, "a restored state runs on as the first time, to the bit");
    findings.expect(first == at_end, "a simulation with a save in it equals one without, to the bit");

    if flags.can_serialize_fmu_state {
        let bytes = instance.serialize_state(saved)?;
        findings.good(format!("a state serialises to {} bytes", bytes.len()));
        let mut other = experiment::ready(fmu, &experiment::strict())?;
        let state = other.deserialize_state(&bytes)?;
        other.restore_state(state)?;
        experiment::simulate(&mut other, half, STEPS)?;
        let there = experiment::outputs(&mut other)?;
        findings.expect(there == at_end, "another instance runs on from the bytes, to the bit");
        let back = other.serialize_state(state)?;
        findings.expect(back == bytes, "the bytes read and written again are the same");
        damaged(findings, &bytes)?;
    } else {
        findings.skipped("serialising: not claimed");
    }
    instance.free_state(saved)?;
    findings.good("frees its state");
    Ok(())
}

/// Whether an instance that was reset runs as a fresh one, to the bit, over a few steps of the default experiment.
///
/// # Errors
/// A call that fails.
pub fn resets(fmu: &Fmu) -> Result<bool, Error> {
    let mut instance = experiment::ready(fmu, &InstanceOptions::default())?;
    let at_start = experiment::outputs(&mut instance)?;
    experiment::simulate(&mut instance, 0, STEPS)?;
    let at_end = experiment::outputs(&mut instance)?;
    Ok(after_reset(&mut instance)? == [at_start, at_end])
}

/// The outputs at the start and after a short simulation of an instance that is reset.
fn after_reset(instance: &mut Instance) -> Result<[Bits; 2], Error> {
    instance.reset()?;
    experiment::advance(instance, State::StepComplete)?;
    let at_start = experiment::outputs(instance)?;
    experiment::simulate(instance, 0, STEPS)?;
    Ok([at_start, experiment::outputs(instance)?])
}

/// Bytes that were cut or changed.
fn damaged(findings: &mut Findings<'_>, bytes: &[u8]) -> Outcome {
    let mut damaged = bytes.to_vec();
    if let Some(middle) = damaged.get_mut(bytes.len() / 2) {
        *middle ^= 0x10;
    }
    let cases: [(&str, &[u8]); 3] =
        [("no bytes", &[]), ("half the bytes", &bytes[..bytes.len() / 2]), ("a flipped bit", &damaged)];
    for (what, bytes) in cases {
        let what = format!("a serialised state of {what}");
        findings.try_refused(&what, |instance| instance.deserialize_state(bytes).map(drop))?;
    }
    Ok(())
}
