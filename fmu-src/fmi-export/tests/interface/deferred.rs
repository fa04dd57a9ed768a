//! Outputs that a model writes when they are read: they are those of the last step, whatever was set, saved or left unread since.

use client::{InProcess, StatePointer};
use fmi_export::model_description::Description;
use fmi_export::model_description::Status::{Error, Ok};
use fmi_export::{
    About, Context, DeferredOutputs, Dependencies, Extensions, Failure, Integer, Knowns, Library, Model,
    OutputGroups, OutputRates, Real, SetupError, Step, StepEnd, Values, Variables, knowns,
};

use super::{only_message, real, reference};

static LIBRARY: Library = Library { entries: &[fmi_export::fmi2::entry::<Deferring>()] };

/// Two groups of outputs, and one that the step writes.
struct Deferring;

#[derive(Variables)]
struct DeferringVariables {
    /// Goes to `group.product`.
    #[input(unit = "1", start = 1.0)]
    input: Real,
    /// Factor.
    #[parameter(tunable, unit = "1", start = 2.0)]
    factor: Real,
    /// Input times factor, of the first group.
    #[output(unit = "1")]
    product: Real,
    /// Number of times that the first group was written.
    #[output]
    written: Integer,
    /// Reciprocal of the input, of the second group.
    #[output(unit = "1")]
    reciprocal: Real,
    /// Time of the communication point, written by the step.
    #[output(unit = "s")]
    clock: Real,
}

type Called<'a> = Context<'a, Deferring>;

impl Model for Deferring {
    const NAME: &'static str = "Deferring";
    const STATE_VERSION: u32 = 1;
    const EXTENSIONS: Extensions<Self> = Extensions::none().output_rates().deferred_outputs();

    type Setup = ();
    type Variables = DeferringVariables;
    /// The input of the last step, and how often a group was written.
    type State = (f64, i32);

    fn parse_setup(_file: &str, _text: &str) -> Result<(), SetupError> {
        Result::Ok(())
    }

    fn about(_setup: &()) -> About {
        About { stop_time_s: 1.0, step_size_s: 0.1, tolerance: 1e-6, ..About::default() }
    }

    fn initialize(context: &Called<'_>, values: &mut Values, start_s: f64) -> Result<(f64, i32), Failure> {
        let mut state = (values.real(context.variables.input), 0);
        values.set_real(context.variables.clock, start_s);
        Self::write_outputs(context, values, &mut state, OutputGroups::ALL, start_s)?;
        Result::Ok(state)
    }

    fn step(
        context: &Called<'_>,
        values: &mut Values,
        state: &mut (f64, i32),
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        state.0 = step.inputs.real(values, context.variables.input, step.end_s);
        values.set_real(context.variables.clock, step.end_s);
        Result::Ok(StepEnd::at(step.end_s))
    }

    fn dependencies(_setup: &(), v: &DeferringVariables) -> Dependencies {
        let mut table = Dependencies::new();
        table.output(knowns![v.product, v.reciprocal], knowns![v.input], knowns![v.factor]);
        table.output(knowns![v.written, v.clock], knowns![], knowns![]);
        table
    }
}

impl DeferredOutputs for Deferring {
    fn output_groups(v: &DeferringVariables) -> Vec<Knowns> {
        // What is no output does not count.
        vec![knowns![v.product, v.written, v.factor], knowns![v.reciprocal]]
    }

    fn write_outputs(
        context: &Called<'_>,
        values: &mut Values,
        (input, written): &mut (f64, i32),
        groups: OutputGroups,
        time_s: f64,
    ) -> Result<(), Failure> {
        let v = context.variables;
        assert_eq!(values.real(v.clock), time_s);
        if groups.contains(0) {
            *written += 1;
            values.set_real(v.product, *input * values.real(v.factor));
            values.set_integer(v.written, *written);
        }
        if groups.contains(1) {
            *written += 1;
            if *input == -1.0 {
                return Err(Failure::new("-1 has no reciprocal, 100 % deliberately"));
            }
            values.set_real(v.reciprocal, input.recip());
        }
        Result::Ok(())
    }
}

impl OutputRates for Deferring {
    fn output_rate(_: &Called<'_>, values: &Values, _: &(f64, i32), output: Real) -> Option<f64> {
        Some(values.real(output))
    }
}

fn started() -> (InProcess, Description) {
    let description = LIBRARY.find("Deferring").unwrap().describe(None, None).unwrap();
    let mut instance = InProcess::from_library(&LIBRARY, "Deferring").unwrap();
    assert_eq!(instance.start(0.0, None), Ok);
    (instance, description)
}

fn written(instance: &mut InProcess, description: &Description) -> i32 {
    let mut count = [0];
    assert_eq!(instance.get_integer(&[reference(description, "written")], &mut count), Ok);
    count[0]
}

#[test]
fn a_group_is_written_once_a_step_and_only_where_it_is_read() {
    let (mut instance, description) = started();
    let at = |name| reference(&description, name);
    assert_eq!(written(&mut instance, &description), 1);
    for step in 0..5 {
        assert_eq!(instance.do_step(f64::from(step), 1.0), Ok);
        assert_eq!(real(&mut instance, at("clock")), f64::from(step) + 1.0);
    }
    assert_eq!(written(&mut instance, &description), 3);
    assert_eq!(real(&mut instance, at("product")), 2.0);
    assert_eq!(written(&mut instance, &description), 3);
    assert_eq!(real(&mut instance, at("reciprocal")), 1.0);
    assert_eq!(instance.do_step(5.0, 1.0), Ok);
    // The second group counts before the first shows its number.
    let mut both = [f64::NAN; 2];
    assert_eq!(instance.get_real(&[at("reciprocal"), at("product")], &mut both), Ok);
    assert_eq!((both, written(&mut instance, &description)), ([1.0, 2.0], 5));
}

#[test]
fn outputs_read_after_a_set_are_those_of_the_last_step() {
    let (mut instance, description) = started();
    let at = |name| reference(&description, name);
    assert_eq!(instance.set_real(&[at("input"), at("factor")], &[3.0, 5.0]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.set_real(&[at("input"), at("factor")], &[7.0, 11.0]), Ok);
    assert_eq!(real(&mut instance, at("product")), 15.0);
    assert_eq!([at("input"), at("factor")].map(|it| real(&mut instance, it)), [7.0, 11.0]);
    assert_eq!(real(&mut instance, at("reciprocal")), 1.0 / 3.0);
    assert_eq!(instance.do_step(1.0, 1.0), Ok);
    assert_eq!(real(&mut instance, at("product")), 77.0);
    // Set back is as if never set, and the outputs of the step before are gone with the next one.
    assert_eq!(instance.set_real(&[at("input")], &[1.0]), Ok);
    assert_eq!(instance.do_step(2.0, 1.0), Ok);
    assert_eq!(instance.set_real(&[at("input")], &[2.0]), Ok);
    assert_eq!(instance.do_step(3.0, 1.0), Ok);
    assert_eq!(real(&mut instance, at("product")), 22.0);
}

#[test]
fn derivatives_find_every_output_written() {
    let (mut instance, description) = started();
    let at = |name| reference(&description, name);
    assert_eq!(instance.set_real(&[at("input")], &[4.0]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.set_real(&[at("input")], &[5.0]), Ok);
    let mut rates = [f64::NAN; 2];
    let outputs = [at("product"), at("reciprocal")];
    assert_eq!(instance.get_output_derivatives(&outputs, &[1, 1], &mut rates), Ok);
    assert_eq!(rates, [8.0, 0.25]);
}

#[test]
fn a_saved_state_has_the_outputs_that_nobody_read() {
    let (mut instance, description) = started();
    let at = |name| reference(&description, name);
    assert_eq!(instance.set_real(&[at("input")], &[4.0]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.set_real(&[at("input")], &[8.0]), Ok);
    let mut state = StatePointer::null();
    assert_eq!(instance.get_state(&mut state), Ok);
    let (status, bytes) = instance.serialize(&state);
    assert_eq!(status, Ok);
    assert_eq!(instance.do_step(1.0, 1.0), Ok);
    let (mut twin, _) = started();
    let (status, decoded) = twin.deserialize(&bytes);
    assert_eq!(status, Ok);
    assert_eq!(twin.do_step(0.0, 1.0), Ok);
    for (restored, state) in [(&mut instance, &state), (&mut twin, &decoded)] {
        // Groups that were pending where the state is set are not written into it.
        assert_eq!(restored.set_state(state), Ok);
        assert_eq!(["product", "reciprocal", "input"].map(|it| real(restored, at(it))), [8.0, 0.25, 8.0]);
        assert_eq!(written(restored, &description), 3);
        assert_eq!(restored.do_step(1.0, 1.0), Ok);
        assert_eq!(real(restored, at("product")), 16.0);
    }
}

#[test]
fn a_reset_forgets_what_was_not_written() {
    let (mut instance, description) = started();
    assert_eq!(instance.set_real(&[reference(&description, "input")], &[4.0]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.reset(), Ok);
    assert_eq!(instance.start(0.0, None), Ok);
    assert_eq!(real(&mut instance, reference(&description, "product")), 2.0);
    assert_eq!(written(&mut instance, &description), 1);
}

#[test]
fn a_group_that_cannot_be_written_is_an_error_where_it_is_read() {
    for (input, why) in [(-1.0, "-1 has no reciprocal"), (0.0, "`reciprocal`")] {
        let (mut instance, description) = started();
        let at = |name| reference(&description, name);
        assert_eq!(instance.set_real(&[at("input")], &[input]), Ok);
        assert_eq!(instance.do_step(0.0, 1.0), Ok);
        assert_eq!(real(&mut instance, at("product")), 2.0 * input);
        assert_eq!(instance.get_real(&[at("reciprocal")], &mut [f64::NAN]), Error);
        let text = only_message(&instance);
        assert!(text.starts_with("fmi2GetReal: ") && text.contains(why), "{text}");
        assert_eq!(instance.do_step(1.0, 1.0), Error);

        let (mut instance, _) = started();
        assert_eq!(instance.set_real(&[at("input")], &[input]), Ok);
        assert_eq!(instance.do_step(0.0, 1.0), Ok);
        assert_eq!(instance.get_state(&mut StatePointer::null()), Error);
        assert!(only_message(&instance).contains(why));
    }
}
