//! Steps halved until the events that a counter counts stand apart.

use crate::{Error, Instance};

/// Events closer than a millionth of the step stay together.
pub(crate) const MAX_HALVINGS: u32 = 20;

/// Takes a step; one in which the counter, an Integer, rises by more than `most` is taken back and made in halves. `between` is
/// reported every communication point within the step.
pub(crate) fn step_apart(
    instance: &mut Instance,
    (counter, most): (u32, i32),
    (time_s, step_s): (f64, f64),
    halvings: u32,
    between: &mut dyn FnMut(&mut Instance, f64) -> Result<(), Error>,
) -> Result<(), Error> {
    let before = count(instance, counter)?;
    let state = instance.save_state()?;
    instance.do_step(time_s, step_s, true)?;
    let crowded = halvings > 0 && count(instance, counter)? > before + most;
    if crowded {
        instance.restore_state(state)?;
    }
    instance.free_state(state)?;
    if !crowded {
        return Ok(());
    }
    let (half_s, middle_s) = (0.5 * step_s, time_s + 0.5 * step_s);
    step_apart(instance, (counter, most), (time_s, half_s), halvings - 1, between)?;
    between(instance, middle_s)?;
    step_apart(instance, (counter, most), (middle_s, half_s), halvings - 1, between)
}

fn count(instance: &mut Instance, counter: u32) -> Result<i32, Error> {
    let mut count = [0];
    instance.get_integers(&[counter], &mut count)?;
    Ok(count[0])
}
