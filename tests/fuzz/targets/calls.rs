//! Any sequence of calls gets a status: the first byte picks the model, the others are calls and their arguments.
//!
//! The call table itself is held by the tests of call sequences; here coverage leads deeper into the models.
#![no_main]

use client::StatePointer;
use fmi_export::model_description::Status;
use heliotorque_fuzz::Subject;
use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;

/// A reference of the model, seldom one it has not.
fn reference(references: &[u32], bytes: &mut Unstructured) -> Result<u32> {
    let number = usize::from(bytes.arbitrary::<u16>()?);
    Ok(match references.get(number % (references.len() + 1)) {
        Some(reference) => *reference,
        None => bytes.arbitrary()?,
    })
}

/// A number near `now`, a small or round one, an odd one, or any.
fn number(now: f64, bytes: &mut Unstructured) -> Result<f64> {
    let (kind, small) = (bytes.arbitrary::<u8>()?, f64::from(bytes.arbitrary::<i8>()?));
    Ok(match kind % 8 {
        0..=2 => now * (1.0 + small / 128.0),
        3 => small / 16.0,
        4 => 10_f64.powf(small / 8.0),
        5 => -now,
        6 => [f64::NAN, f64::INFINITY, f64::MAX, f64::MIN_POSITIVE, 5e-324, -0.0, 1e300]
            [small as u8 as usize % 7],
        _ => f64::from_bits(bytes.arbitrary()?),
    })
}

struct Master<'a> {
    subject: &'a mut Subject,
    slots: [StatePointer; 2],
    blob: Vec<u8>,
    /// In the error state what is held may be read for debugging, whatever it is.
    failed: bool,
}

impl Master<'_> {
    fn now(&mut self, reference: u32) -> f64 {
        let mut value = [0.0];
        self.subject.instance.get_real(&[reference], &mut value);
        let _ = self.subject.instance.take_messages();
        value[0]
    }

    fn call(&mut self, bytes: &mut Unstructured) -> Result<()> {
        let code = bytes.arbitrary::<u8>()?;
        let slot = usize::from(code >> 7);
        let instance = &mut self.subject.instance;
        let status = match code % 24 {
            0 => instance.setup_experiment(0.0, None),
            1 => {
                let (start_s, length_s) = (number(0.0, bytes)?, number(86_400.0, bytes)?);
                instance.setup_experiment(start_s, Some(start_s + length_s))
            }
            2 => instance.enter_initialization_mode(),
            3 => instance.exit_initialization_mode(),
            4..=6 => {
                let exponent = i32::from(bytes.arbitrary::<u8>()? % 20);
                let (_, time_s) = instance.last_successful_time();
                instance.do_step(time_s, 2_f64.powi(exponent - 4))
            }
            7 => {
                let (_, time_s) = instance.last_successful_time();
                let (point_s, step_s) = (number(time_s, bytes)?, number(60.0, bytes)?);
                instance.do_step_without_return(point_s, step_s)
            }
            8..=10 => {
                let reference = reference(&self.subject.reals, bytes)?;
                let now = self.now(reference);
                let value = number(now, bytes)?;
                self.subject.instance.set_real(&[reference], &[value])
            }
            11 => {
                let reference = reference(&self.subject.integers, bytes)?;
                let value = match bytes.arbitrary::<u8>()? {
                    255 => bytes.arbitrary()?,
                    small => i32::from(small) % 12 - 1,
                };
                instance.set_integer(&[reference], &[value])
            }
            12 => {
                let reference = reference(&self.subject.booleans, bytes)?;
                instance.set_boolean(&[reference], &[i32::from(bytes.arbitrary::<u8>()? & 1)])
            }
            13 => {
                let reference = reference(&self.subject.strings, bytes)?;
                let length = usize::from(bytes.arbitrary::<u8>()?).min(bytes.len());
                instance.set_string(&[reference], &[bytes.bytes(length)?])
            }
            14 => {
                let reference = reference(&self.subject.reals, bytes)?;
                let (order, value) = (i32::from(bytes.arbitrary::<i8>()? % 4), number(1e-3, bytes)?);
                instance.set_input_derivatives(&[reference], &[order], &[value])
            }
            15 => {
                let reference = reference(&self.subject.reals, bytes)?;
                let mut value = [0.0];
                let status = instance.get_output_derivatives(
                    &[reference],
                    &[i32::from(bytes.arbitrary::<u8>()? % 3)],
                    &mut value,
                );
                assert!(status != Status::Ok || value[0].is_finite(), "derivative {value:?}");
                status
            }
            16 => {
                let unknown = reference(&self.subject.reals, bytes)?;
                let known = reference(&self.subject.reals, bytes)?;
                let mut value = [0.0];
                let status = instance.get_directional_derivative(&[unknown], &[known], &[1.0], &mut value);
                assert!(status != Status::Ok || value[0].is_finite(), "derivative {value:?}");
                status
            }
            17 => instance.get_state(&mut self.slots[slot]),
            18 => instance.set_state(&self.slots[slot]),
            19 => {
                let (status, blob) = instance.serialize(&self.slots[slot]);
                if status == Status::Ok {
                    self.blob = blob;
                }
                status
            }
            20 => {
                let (status, state) = instance.deserialize(&self.blob);
                if status == Status::Ok {
                    self.slots[slot] = state;
                }
                status
            }
            21 => {
                let (status, _) = instance.get_string(&self.subject.strings);
                let (mut integers, mut booleans) =
                    (vec![0; self.subject.integers.len()], vec![0; self.subject.booleans.len()]);
                status
                    .max(instance.get_integer(&self.subject.integers, &mut integers))
                    .max(instance.get_boolean(&self.subject.booleans, &mut booleans))
            }
            22 => instance.terminate(),
            _ => {
                self.failed = false;
                instance.reset()
            }
        };
        self.subject.check_messages(status);
        self.failed |= status == Status::Error;
        if !self.failed {
            let status = self.subject.read_reals();
            self.failed |= status == Status::Error;
            self.subject.check_messages(status);
        }
        Ok(())
    }
}

fuzz_target!(|input: &[u8]| {
    let Some((choice, calls)) = input.split_first() else { return };
    Subject::with(*choice, |subject| {
        let slots = [StatePointer::null(), StatePointer::null()];
        let mut master = Master { subject, slots, blob: Vec::new(), failed: false };
        let mut bytes = Unstructured::new(calls);
        while !bytes.is_empty() && master.call(&mut bytes).is_ok() {}
    });
});
