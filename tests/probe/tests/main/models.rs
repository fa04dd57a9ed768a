//! The probes do what their descriptions say, so that a deviation seen through an FMU is the exporter's.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

use fmi_export::fmi2::scalar_variables;
use fmi_export::model::Log;
use fmi_export::variables::{Causality, Variability};
use fmi_export::{
    Context, Declare, Differentiable, Enumeration, InputDerivative, InputsOverTime, Interface, Model,
    OutputRates, Step, StepEnd, Values, Variables,
};
use model_description::{rules::INITIAL_TABLE, validate};
use probe::panicking::Fault;
use probe::{AllTypes, Empty, Panicking};

struct Silent;

impl Log for Silent {
    fn events_enabled(&self) -> bool {
        false
    }
    fn event(&self, _time_s: f64, _message: &str) {}
    fn warning(&self, _message: &str) {}
}

struct Run<M: Model> {
    setup: M::Setup,
    variables: M::Variables,
    interface: Interface,
    values: Values,
}

impl<M: Model> Run<M> {
    fn new() -> Self {
        let setup = M::parse_setup("default", M::DEFAULT_SETUP).unwrap();
        let mut scope = Declare::new();
        let variables = M::Variables::declare(&mut scope, &setup, 0).unwrap();
        let interface = scope.finish();
        let values = interface.start.clone();
        Self { setup, variables, interface, values }
    }

    fn call<T>(&mut self, call: impl FnOnce(&Context<'_, M>, &mut Values) -> T) -> T {
        let context = Context {
            setup: &self.setup,
            variables: &self.variables,
            start: &self.interface.start,
            log: &Silent,
        };
        call(&context, &mut self.values)
    }

    fn initialize(&mut self, start_time_s: f64) -> M::State {
        self.call(|context, values| M::initialize(context, values, start_time_s)).unwrap()
    }

    fn step(&mut self, state: &mut M::State, times_s: (f64, f64), changed: bool, slopes: &[InputDerivative]) {
        let (start_s, end_s) = times_s;
        let step = Step { start_s, end_s, changed, inputs: InputsOverTime::new(start_s, slopes) };
        let end = self.call(|context, values| M::step(context, values, state, &step)).unwrap();
        assert_eq!(end, StepEnd::at(end_s));
    }
}

#[test]
fn every_legal_role_but_the_independent_one_is_there() {
    let variables = scalar_variables(&Run::<AllTypes>::new().interface);
    let roles: BTreeSet<_> = variables.iter().map(|it| (it.causality, it.variability)).collect();
    let legal = INITIAL_TABLE.iter().map(|row| (row.causality, row.variability));
    assert_eq!(roles, legal.filter(|(causality, _)| *causality != Causality::Independent).collect());
    assert!(roles.contains(&(Causality::Output, Variability::Constant)));
    let names: Vec<_> = variables.iter().map(|it| it.name.as_str()).collect();
    for name in ["parameter.matrix[2,3]", "tunable.text", "output.vector[3]", "channel[2].gain"] {
        assert!(names.contains(&name), "{name}");
    }
}

#[test]
fn what_is_described_is_valid() {
    for entry in probe::LIBRARY.entries {
        let findings = validate(&entry.describe(None, None).unwrap());
        assert!(findings.is_empty(), "{}: {findings:?}", entry.name());
    }
}

#[test]
fn outputs_are_inputs_at_the_end_of_the_step() {
    let mut run = Run::<AllTypes>::new();
    let mut state = run.initialize(5.0);
    let (input, output) = (run.variables.input.real, run.variables.output.real);
    let channel = run.variables.channel[1].input;
    run.values.set_real(input, 2.0);
    run.values.set_real(channel, 0.5);
    run.values.set_text(run.variables.input.text, "Ωμέγα");
    // u = 2 + 3 dt + 4 dt^2 / 2 over dt = 0.5
    let slopes = [(1, 3.0), (2, 4.0)].map(|(order, value)| InputDerivative { input, order, value });
    run.step(&mut state, (5.0, 5.5), true, &slopes);
    assert_eq!(run.values.real(output), 4.0);
    assert_eq!(run.values.real(run.variables.channel[1].output), -1.5);
    assert_eq!(run.values.text(run.variables.output.text), "Ωμέγα");
    let integral = run.values.real(run.variables.output.integral);
    assert!((integral - (1.0 + 0.375 + 4.0 * 0.125 / 6.0)).abs() < 1e-15);
    let slope = run.call(|context, values| AllTypes::output_rate(context, values, &state, output));
    assert_eq!(slope, Some(5.0));
    run.step(&mut state, (5.5, 6.5), true, &[]);
    assert_eq!(run.values.real(run.variables.output.integral), integral + 2.0);
}

#[test]
fn cutting_a_step_changes_no_bit_of_the_integral() {
    let results: Vec<f64> = [1, 7]
        .into_iter()
        .map(|pieces| {
            let mut run = Run::<AllTypes>::new();
            run.values.set_real(run.variables.input.real, 0.1);
            let mut state = run.initialize(0.3);
            for piece in 0..pieces {
                let at = |k: i32| 0.3 + 0.9 * f64::from(k) / f64::from(pieces);
                run.step(&mut state, (at(piece), at(piece + 1)), false, &[]);
            }
            run.values.real(run.variables.output.integral)
        })
        .collect();
    assert_eq!(results[0].to_bits(), results[1].to_bits());
}

#[test]
fn directional_derivatives_are_the_gains() {
    let mut run = Run::<AllTypes>::new();
    let state = run.initialize(0.0);
    let variables = &run.variables;
    let unknowns =
        [variables.channel[0].output, variables.channel[1].output, variables.output.vector.element(1)];
    let knowns = [variables.input.vector.element(1), variables.channel[1].input];
    let mut result = [f64::NAN; 3];
    run.call(|context, values| {
        let seeds = [(knowns[0], 2.0), (knowns[1], 5.0)];
        AllTypes::jacobian_vector_product(context, values, &state, &unknowns, &seeds, &mut result)
    })
    .unwrap();
    assert_eq!(result, [0.0, -15.0, 2.0]);
}

#[test]
fn a_state_of_other_channels_is_refused() {
    let state = Run::<AllTypes>::new().initialize(0.0);
    let setup = |text| AllTypes::parse_setup("test", text).unwrap();
    assert!(AllTypes::check_state(&setup(AllTypes::DEFAULT_SETUP), &state).is_ok());
    assert!(AllTypes::check_state(&setup("label = ''"), &state).is_err());
    let error = AllTypes::parse_setup("file.toml", "label = 1").unwrap_err().to_string();
    assert!(error.starts_with("file.toml: "), "{error}");
}

#[test]
fn the_empty_model_tells_the_time() {
    let mut run = Run::<Empty>::new();
    run.initialize(1.0);
    assert_eq!(run.interface.variables.len(), 1);
    run.step(&mut (), (1.0, 2.5), false, &[]);
    assert_eq!(run.interface.variables[0].name, "clock");
    assert_eq!(run.values.real(run.variables.clock), 2.5);
}

/// What became of a run with an fault: "panic", the failure's text, or "ok".
fn outcome(fault: Fault) -> String {
    let run = || -> Result<(), String> {
        let mut run = Run::<Panicking>::new();
        run.values.set_choice(run.variables.fault, fault);
        let start = run.call(|context, values| Panicking::initialize(context, values, 0.0));
        let mut state = start.map_err(|it| it.to_string())?;
        let step = Step { start_s: 0.0, end_s: 1.0, changed: false, inputs: InputsOverTime::held() };
        let end = run.call(|context, values| Panicking::step(context, values, &mut state, &step));
        if let Some(reason) = end.map_err(|it| it.to_string())?.terminate {
            return Err(reason);
        }
        let (input, output) = (run.variables.input, run.variables.output);
        run.call(|context, values| {
            let _ = Panicking::output_rate(context, values, &state, output);
            Panicking::jacobian_vector_product(
                context,
                values,
                &state,
                &[output],
                &[(input, 1.0)],
                &mut [0.0],
            )
        })
        .map_err(|it| it.to_string())?;
        let bytes = postcard::to_stdvec(&state).map_err(|it| it.to_string())?;
        let back: probe::panicking::State = postcard::from_bytes(&bytes).map_err(|it| it.to_string())?;
        drop(back.clone());
        Panicking::check_state(&run.setup, &back).map_err(|it| it.to_string())
    };
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(Ok(())) => "ok".to_owned(),
        Ok(Err(text)) => text,
        Err(payload) => {
            // Some payloads panic when dropped.
            core::mem::forget(payload);
            "panic".to_owned()
        }
    }
}

#[test]
fn every_fault_happens_where_it_should() {
    for item in Fault::TYPE.items {
        let fault = Fault::from_value(item.value).unwrap();
        let found = outcome(fault);
        match fault {
            Fault::Nowhere | Fault::StepShort | Fault::StepStill => assert_eq!(found, "ok"),
            Fault::FailInitialize => assert!(found.starts_with("initialize fails")),
            Fault::FailStep => assert!(found.starts_with("step fails")),
            Fault::TerminateStep => assert_eq!(found, "the model ends here"),
            Fault::FailCheckState => assert!(found.starts_with("this state is refused")),
            Fault::FailSerializeState => assert_ne!(found, "panic"),
            _ => assert_eq!(found, "panic", "{fault:?}"),
        }
    }
    for (place, panics) in [("nowhere", false), ("parseSetup", true), ("about", true), ("declare", true)] {
        let text = format!("panic_in = '{place}'");
        let run = || {
            let setup = Panicking::parse_setup("test", &text).unwrap();
            let _ = Panicking::about(&setup);
            let _ = <Panicking as Model>::Variables::declare(&mut Declare::new(), &setup, 0).unwrap();
        };
        assert_eq!(catch_unwind(run).is_err(), panics, "{place}");
    }
    let setup = Panicking::parse_setup("test", "panic_in = 'serializeSetup'").unwrap();
    assert!(catch_unwind(|| postcard::to_stdvec(&setup)).is_err());
}
