//! Every step of every legal flight is answered in bounded time, with finite outputs or an error that says what to do.

use std::time::Instant;

use model_description::Status;
use model_description::{Causality, Description, ScalarVariable, SimpleTypeKind, VariableKind};

use super::driver::{Spinner, assert_names, description};

/// Uniform numbers from 0 to 1.
struct RandomNumbers(u64);

impl RandomNumbers {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 9_007_199_254_740_992.0
    }

    fn below(&mut self, count: usize) -> usize {
        ((self.roll() * count as f64) as usize).min(count - 1)
    }

    /// A bound, a number between, or one of any magnitude between.
    fn between(&mut self, low: Option<f64>, high: Option<f64>) -> f64 {
        let (least, most) = (low.unwrap_or(-1e12), high.unwrap_or(1e12));
        let magnitude = 10.0_f64.powf(24.0 * self.roll() - 12.0);
        match self.below(5) {
            0 => low.unwrap_or(0.0),
            1 => high.unwrap_or(1e12),
            2 => least + (most - least) * self.roll(),
            3 => magnitude.clamp(least, most),
            _ => (-magnitude).clamp(least, most),
        }
    }
}

/// Sets one variable to something legal; what was set, for messages.
fn set_any(
    spinner: &mut Spinner,
    description: &Description,
    variable: &ScalarVariable,
    random: &mut RandomNumbers,
) -> Option<String> {
    let at = [variable.value_reference];
    let (status, value) = match &variable.kind {
        VariableKind::Real { attributes, .. } => {
            let value = random.between(attributes.min, attributes.max);
            (spinner.fmu.set_real(&at, &[value]), value)
        }
        VariableKind::Integer { min, max, .. } => {
            let value = random.between(min.map(f64::from), max.map(f64::from)) as i32;
            (spinner.fmu.set_integer(&at, &[value]), f64::from(value))
        }
        VariableKind::Boolean { .. } => {
            let value = random.below(2) as i32;
            (spinner.fmu.set_boolean(&at, &[value]), f64::from(value))
        }
        VariableKind::Enumeration { declared_type, .. } => {
            let found = description.types.iter().find(|it| it.name == *declared_type)?;
            let SimpleTypeKind::Enumeration { items, .. } = &found.kind else { return None };
            let value = items[random.below(items.len())].value;
            (spinner.fmu.set_integer(&at, &[value]), f64::from(value))
        }
        VariableKind::String { .. } => return None,
    };
    assert_eq!(status, Status::Ok, "{} = {value}: {:?}", variable.name, spinner.fmu.take_messages());
    Some(format!("{} = {value:e}", variable.name))
}

/// How many flights; more by HELIOTORQUE_FLIGHTS.
fn flights() -> u64 {
    std::env::var("HELIOTORQUE_FLIGHTS").ok().and_then(|count| count.parse().ok()).unwrap_or(150)
}

#[test]
fn every_step_of_a_legal_flight_is_answered() {
    let description = description();
    let settable = |causality: Causality| -> Vec<&ScalarVariable> {
        let found = description.variables.iter().filter(|v| v.causality == causality);
        found.filter(|v| v.name != "solver.workLimit").collect()
    };
    let (parameters, inputs) = (settable(Causality::Parameter), settable(Causality::Input));
    let (mut refused, mut well, mut failed, mut slowest) = (0, 0, 0, (0.0, String::new()));
    for flight in 0..flights() {
        let mut random = RandomNumbers(flight.wrapping_mul(0x9E37_79B9_7F4A_7C15) + 1);
        // A tenth of what a millisecond may cost shows the same as the default does.
        let limit = if std::env::var_os("HELIOTORQUE_FLIGHTS").is_some() { 1_000_000 } else { 50_000 };
        let mut spinner = Spinner::new().set_integer("solver.workLimit", limit);
        let mut inputs_set: Vec<String> = Vec::new();
        for _ in 0..1 + random.below(4) {
            let variable = parameters[random.below(parameters.len())];
            inputs_set.extend(set_any(&mut spinner, &description, variable, &mut random));
        }
        for _ in 0..random.below(3) {
            let variable = inputs[random.below(inputs.len())];
            inputs_set.extend(set_any(&mut spinner, &description, variable, &mut random));
        }
        let mut keep = |begun: Instant, what: &str| {
            let took_s = begun.elapsed().as_secs_f64();
            if took_s > slowest.0 {
                slowest = (took_s, format!("flight {flight}, {what}: {inputs_set:?}"));
            }
            assert!(took_s < 20.0, "flight {flight}, {what} took {took_s} s: {inputs_set:?}");
        };
        let begun = Instant::now();
        let started = spinner.fmu.start(0.0, None);
        keep(begun, "initialization");
        if started != Status::Ok {
            refused += 1;
            continue;
        }
        for length_s in [1.0, 1e3, 1e6, 1e9, 1e12] {
            let begun = Instant::now();
            let status = spinner.try_step(length_s);
            keep(begun, &format!("a step of {length_s} s"));
            if status != Status::Ok {
                assert_eq!(status, Status::Error);
                let text: String = spinner.fmu.take_messages().into_iter().map(|it| it.text).collect();
                assert!(!text.is_empty());
                failed += 1;
                break;
            }
            well += 1;
            let outputs = spinner.outputs();
            assert!(outputs.iter().all(|x| x.is_finite()), "flight {flight}: {outputs:?} {inputs_set:?}");
        }
    }
    println!("{refused} refused, {failed} failed, {well} steps went well; slowest {slowest:?}");
    assert!(well > 100 && failed > 20);
}

#[test]
fn the_longest_step_says_how_far_it_came_and_what_asked_for_so_much() {
    let begun = Instant::now();
    let mut spinner = Spinner::new().start();
    let _ = spinner.fmu.take_messages();
    assert_eq!(spinner.fmu.do_step(0.0, 1e12), Status::Error);
    let text: String = spinner.fmu.take_messages().into_iter().map(|it| it.text).collect();
    let took_s = begun.elapsed().as_secs_f64();
    println!("{took_s:.2} s: {text}");
    assert_names(
        &text,
        &[
            "the step came to ",
            "solver.workLimit = 20000000",
            "crossings of Sun and star",
            "spin.initialRate",
        ],
    );
    // 20 s on an idle machine; others may be at work on this one.
    assert!(took_s < 60.0, "{took_s} s");
}
