//! Functions of three parameters, for statistics of many runs: a sum, and the one of Ishigami and Homma.

use fmi_export::{
    About, Context, Dependencies, Failure, Model, Real, RealVector, SetupError, Step, StepEnd, Values,
    Variables, knowns,
};

/// Functions of parameters.
pub struct Functions;

/// The variables of [`Functions`].
#[derive(Variables)]
pub struct FunctionsVariables {
    /// What the functions take.
    #[parameter(unit = "1", start = [0.0; 3])]
    pub x: RealVector<3>,
    /// The sum of all three.
    #[output(unit = "1")]
    pub sum: Real,
    /// Sum by time: x1 + x2 + x3 times the time in s.
    #[output(unit = "1")]
    pub ramp: Real,
    /// sin(x1) + 7 sin(x2)^2 + 0.1 x3^4 sin(x1).
    #[output(unit = "1")]
    pub ishigami: Real,
}

fn write(context: &Context<'_, Functions>, values: &mut Values, time_s: f64) {
    let v = context.variables;
    let [x1, x2, x3] = values.vector(v.x);
    let sum = x1 + x2 + x3;
    values.set_real(v.sum, sum);
    values.set_real(v.ramp, sum * time_s);
    values.set_real(v.ishigami, x1.sin() + 7.0 * x2.sin().powi(2) + 0.1 * x3.powi(4) * x1.sin());
}

impl Model for Functions {
    const NAME: &'static str = "Functions";
    const STATE_VERSION: u32 = 1;

    type Setup = ();
    type Variables = FunctionsVariables;
    type State = ();

    fn parse_setup(_file: &str, _text: &str) -> Result<(), SetupError> {
        Ok(())
    }

    fn about(_setup: &()) -> About {
        About {
            description: "Functions of three parameters.".to_owned(),
            stop_time_s: 1.0,
            step_size_s: 0.5,
            tolerance: 1e-6,
            ..About::default()
        }
    }

    fn initialize(
        context: &Context<'_, Self>,
        values: &mut Values,
        start_time_s: f64,
    ) -> Result<(), Failure> {
        write(context, values, start_time_s);
        Ok(())
    }

    fn step(
        context: &Context<'_, Self>,
        values: &mut Values,
        _state: &mut (),
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        write(context, values, step.end_s);
        Ok(StepEnd::at(step.end_s))
    }

    fn dependencies(_setup: &(), v: &FunctionsVariables) -> Dependencies {
        let mut table = Dependencies::new();
        for output in [v.sum, v.ramp, v.ishigami] {
            table.output(output, knowns![], knowns![v.x]);
        }
        table
    }
}
