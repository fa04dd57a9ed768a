//! The smallest model: one output, no setup, no state.

use fmi_export::{
    About, Context, Dependencies, Failure, Model, Real, SetupError, Step, StepEnd, Values, Variables, knowns,
};

/// A model of one output.
pub struct Empty;

/// The variables of [`Empty`]; the schema requires at least one.
#[derive(Variables)]
pub struct EmptyVariables {
    /// Time of the last communication point.
    #[output(unit = "s", name = "clock")]
    pub clock: Real,
}

impl Model for Empty {
    const NAME: &'static str = "Empty";
    const STATE_VERSION: u32 = 1;

    type Setup = ();
    type Variables = EmptyVariables;
    type State = ();

    fn parse_setup(_file: &str, _text: &str) -> Result<(), SetupError> {
        Ok(())
    }

    fn about(_setup: &()) -> About {
        About {
            description: "Nothing but a clock.".to_owned(),
            stop_time_s: 1.0,
            step_size_s: 0.1,
            tolerance: 1e-6,
            ..About::default()
        }
    }

    fn initialize(
        context: &Context<'_, Self>,
        values: &mut Values,
        start_time_s: f64,
    ) -> Result<(), Failure> {
        values.set_real(context.variables.clock, start_time_s);
        Ok(())
    }

    fn step(
        context: &Context<'_, Self>,
        values: &mut Values,
        _state: &mut (),
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        values.set_real(context.variables.clock, step.end_s);
        Ok(StepEnd::at(step.end_s))
    }

    fn dependencies(_setup: &(), variables: &EmptyVariables) -> Dependencies {
        let mut table = Dependencies::new();
        table.output(variables.clock, knowns![], knowns![]);
        table
    }
}
