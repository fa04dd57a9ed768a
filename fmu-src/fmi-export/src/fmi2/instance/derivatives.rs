//! Input derivatives, output derivatives, directional derivatives.

use super::Instance;
use crate::fmi2::access::{CONTINUOUS, GET_INITIALIZATION, INPUT, OUTPUT, SET_INITIALIZATION};
use crate::fmi2::instance::state::MAX_INPUT_DERIVATIVE_ORDER;
use crate::fmi2::problem::Problem;
use crate::fmi2::references;
use crate::model::InputDerivative;
use crate::variables::{GREATEST_SET, Real};
use model_description::BaseType;
use model_description::call_table::State;

impl Instance {
    /// `fmi2SetRealInputDerivatives`; they hold until the end of the next step.
    pub(crate) fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), Problem> {
        for ((&reference, &order), &value) in references.iter().zip(orders).zip(values) {
            self.require(reference, INPUT | CONTINUOUS, INPUT | CONTINUOUS, "continuous Real input")?;
            check_order(order, MAX_INPUT_DERIVATIVE_ORDER)?;
            if !(-GREATEST_SET..=GREATEST_SET).contains(&value) {
                let name = self.access.named(BaseType::Real, reference);
                return Err(Problem::discard(format_args!(
                    "a derivative of {name} was set to {value:?}, allowed is {:?} to {GREATEST_SET:?}",
                    -GREATEST_SET
                )));
            }
        }
        let kept = &mut self.state.input_derivatives;
        for ((&reference, &order), &value) in references.iter().zip(orders).zip(values) {
            let (input, order) = (real(reference), order.unsigned_abs());
            match kept.iter_mut().find(|old| old.input == input && old.order == order) {
                Some(old) => old.value = value,
                None => kept.push(InputDerivative { input, order, value }),
            }
        }
        Ok(())
    }

    /// `fmi2GetRealOutputDerivatives` at the last communication point. An order above the declared one has the value 0 and a
    /// warning: the declared polynomial has no such term.
    pub(crate) fn get_output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Result<(), Problem> {
        for (&reference, &order) in references.iter().zip(orders) {
            self.require(reference, OUTPUT, OUTPUT, "Real output")?;
            check_order(order, i32::MAX.unsigned_abs())?;
        }
        self.write_pending()?;
        let largest = self.output_derivative_order;
        let mut highest = 0;
        for ((&reference, &order), value) in references.iter().zip(orders).zip(values) {
            highest = highest.max(order.unsigned_abs());
            if order.unsigned_abs() > largest {
                *value = 0.0;
                continue;
            }
            *value = self.runtime.output_rate(self.values_at_last_step(), real(reference), &self.logger)?;
            if !value.is_finite() {
                return Err(self.slope_not_finite(reference, "", *value));
            }
        }
        if highest > largest {
            return Err(Problem::warning(format_args!(
                "output derivatives of order {highest} are answered with 0: maxOutputDerivativeOrder is {largest}"
            )));
        }
        Ok(())
    }

    /// `fmi2GetDirectionalDerivative` at the last communication point.
    pub(crate) fn get_directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        result: &mut [f64],
    ) -> Result<(), Problem> {
        let initializing = self.state.mode == State::InitializationMode;
        let (unknown, known) = match initializing {
            true => (GET_INITIALIZATION, INPUT | SET_INITIALIZATION),
            false => (OUTPUT, INPUT),
        };
        for &reference in unknowns {
            self.require(reference, unknown, unknown, "Real unknown of the model structure")?;
        }
        for &reference in knowns {
            self.require(reference, known, 0, "Real input")?;
        }
        if let Some((&reference, &value)) = knowns.iter().zip(seed).find(|(_, seed)| !seed.is_finite()) {
            let name = self.access.named(BaseType::Real, reference);
            return Err(Problem::error(format_args!(
                "the seed of {name} is {value:?}, allowed is any finite value"
            )));
        }
        if initializing {
            self.initialize_if_needed()?;
        }
        self.write_pending()?;
        // Lists of the model's own, in memory that is kept from call to call.
        let (mut of, mut seeds) = core::mem::take(&mut self.directions);
        of.clear();
        of.extend(unknowns.iter().map(|&reference| real(reference)));
        seeds.clear();
        seeds.extend(knowns.iter().map(|&known| real(known)).zip(seed.iter().copied()));
        let values = self.values_at_last_step();
        let found = self.runtime.jacobian_vector_product(values, &of, &seeds, result, &self.logger);
        self.directions = (of, seeds);
        found?;
        match unknowns.iter().zip(result).find(|(_, slope)| !slope.is_finite()) {
            None => Ok(()),
            Some((&of, &mut value)) => {
                let moved = knowns.iter().zip(seed).filter(|(_, seed)| **seed != 0.0);
                let names = moved.filter_map(|(known, _)| self.access.any_name(*known));
                Err(self.slope_not_finite(of, &names.collect::<Vec<_>>().join(", "), value))
            }
        }
    }

    /// Refuses a Real reference without any of the flags `any`, or without all of the flags `all`.
    fn require(&self, reference: u32, any: u16, all: u16, role: &'static str) -> Result<(), Problem> {
        match self.access.flags_at(BaseType::Real, reference) {
            Some(flags) if flags & any != 0 && flags & all == all => Ok(()),
            Some(_) => {
                let name = self.access.named(BaseType::Real, reference);
                Err(Problem::error(format_args!("{name} is no {role}")))
            }
            None => Err(self.access.unknown(BaseType::Real, reference)),
        }
    }

    #[cold]
    fn slope_not_finite(&self, of: u32, along: &str, value: f64) -> Problem {
        let name = self.access.named(BaseType::Real, of);
        let along = if along.is_empty() { String::new() } else { format!(" along {along}") };
        Problem::error(format_args!(
            "the derivative of {name}{along} came out as {value:?}, which is no finite number"
        ))
    }
}

/// The Real of a value reference that was checked.
fn real(reference: u32) -> Real {
    Real(references::index(BaseType::Real, reference) as u32)
}

fn check_order(order: i32, largest: u32) -> Result<(), Problem> {
    match u32::try_from(order) {
        Ok(positive) if (1..=largest).contains(&positive) => Ok(()),
        _ => Err(Problem::error(format_args!("the derivative order is {order}, allowed are 1 to {largest}"))),
    }
}
