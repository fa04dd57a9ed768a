//! Draws of calls: in each state mostly those that lead on, often any other.

use model_description::BaseType;
use proptest::prelude::*;
use proptest::sample::select;

use super::master::{Call, Picked};
use super::table::STATES;
use super::variables::{VARIABLES, Value};

const BASES: [BaseType; 4] = [BaseType::Real, BaseType::Integer, BaseType::Boolean, BaseType::String];

fn rows(base: BaseType) -> Vec<usize> {
    (0..VARIABLES.len()).filter(|row| VARIABLES[*row].base == base).collect()
}

fn picked(base: BaseType) -> impl Strategy<Value = Picked> {
    prop_oneof![
        40 => select(rows(base)).prop_map(Picked::Row),
        1 => (1000_u32..).prop_map(Picked::Unknown),
    ]
}

/// Numbers whose sums and products are exact, and what no variable admits.
fn value(base: BaseType) -> BoxedStrategy<Value> {
    match base {
        BaseType::Real => {
            let exact = (-40_i32..=80).prop_map(|eighths| Value::Real(f64::from(eighths) / 8.0));
            let odd = select(vec![1e6, -1e6, 1.5e6, f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
            prop_oneof![12 => exact, 1 => odd.prop_map(Value::Real)].boxed()
        }
        BaseType::Integer => {
            let odd = select(vec![3, 11, 1000, -1000, 1001, i32::MIN, i32::MAX]);
            prop_oneof![12 => (-2..=8).prop_map(Value::Integer), 1 => odd.prop_map(Value::Integer)].boxed()
        }
        BaseType::Boolean => {
            prop_oneof![12 => (0..=1).prop_map(Value::Boolean), 1 => select(vec![-1, 2]).prop_map(Value::Boolean)]
                .boxed()
        }
        BaseType::String => {
            let texts = select(vec!["", "a", "100 % #1#", "Ωμέγα", "a rather long text, longer than the others"]);
            prop_oneof![12 => texts.prop_map(Value::Text), 1 => Just(Value::Bytes)].boxed()
        }
    }
}

fn get() -> BoxedStrategy<Call> {
    select(&BASES[..])
        .prop_flat_map(|base| {
            prop::collection::vec(picked(base), 0..5).prop_map(move |picked| Call::Get(base, picked))
        })
        .boxed()
}

/// Any variables, or (`settable`) those that the state's note admits, so that more than errors come out.
fn set(state: char, settable: bool) -> BoxedStrategy<Call> {
    let note = super::table::cell("SetReal", state);
    select(&BASES[..])
        .prop_flat_map(move |base| {
            let fitting: Vec<usize> =
                rows(base).into_iter().filter(|row| VARIABLES[*row].settable(note)).collect();
            let picked = match settable && !fitting.is_empty() {
                true => select(fitting).prop_map(Picked::Row).boxed(),
                false => picked(base).boxed(),
            };
            prop::collection::vec((picked, value(base)), 0..4)
                .prop_map(move |expected| Call::Set(base, expected))
        })
        .boxed()
}

fn experiment() -> impl Strategy<Value = Call> {
    let start_s = prop_oneof![20 => (-8_i32..=8).prop_map(f64::from), 1 => Just(f64::NAN)];
    let length_s = prop_oneof![
        6 => Just(None),
        6 => (0_i32..=40).prop_map(|halves| Some(f64::from(halves) / 2.0)),
        1 => select(vec![Some(-1.0), Some(f64::INFINITY)]),
    ];
    (start_s, length_s).prop_map(|(start_s, length_s)| Call::SetupExperiment {
        start_s,
        stop_s: length_s.map(|it| start_s + it),
    })
}

fn step(right: bool) -> BoxedStrategy<Call> {
    let right_sizes = select(vec![0.25, 0.5, 1.0]).prop_map(|step_s| (step_s, 0.0));
    let wrong_sizes =
        select(vec![1e300, 0.0, -0.5, f64::NAN, f64::INFINITY]).prop_map(|step_s| (step_s, 0.0));
    let wrong_points = select(vec![0.25, -1.0, f64::NAN]).prop_map(|off_s| (0.5, off_s));
    let sizes = if right { right_sizes.boxed() } else { prop_oneof![wrong_sizes, wrong_points].boxed() };
    (sizes, any::<bool>())
        .prop_map(|((step_s, off_s), no_return)| Call::DoStep { step_s, off_s, no_return })
        .boxed()
}

fn states() -> BoxedStrategy<Call> {
    (0_usize..2, 0..6)
        .prop_map(|(slot, what)| match what {
            0 | 1 => Call::GetState(slot),
            2 => Call::SetState(slot),
            3 => Call::FreeState(slot),
            4 => Call::Serialize(slot),
            _ => Call::Deserialize(slot),
        })
        .boxed()
}

fn derivatives() -> BoxedStrategy<Call> {
    let known = prop::bool::weighted(0.9);
    let order = prop_oneof![8 => 1_i32..=2, 1 => select(vec![0, -1, 3])];
    let value = prop_oneof![12 => (-8_i32..=8).prop_map(|it| f64::from(it) / 2.0), 1 => Just(f64::NAN)];
    (known, order, value, 0..3)
        .prop_map(|(known, order, value, what)| match what {
            // The third order has a factorial that rounds.
            0 => Call::SetInputDerivative { known, order: if order == 3 { 1 } else { order }, value },
            1 => Call::GetOutputDerivative { known, order },
            _ => Call::DirectionalDerivative { known, seed: if value.is_nan() { 2.0 } else { value } },
        })
        .boxed()
}

fn anything(state: char) -> BoxedStrategy<Call> {
    use Call::{
        CancelStep, EnterInitializationMode, ExitInitializationMode, GetIntegerStatus, GetStatus,
        GetStringStatus, LastSuccessfulTime, Replace, Reset, SetDebugLogging, Terminate, Terminated,
    };
    prop_oneof![
        1 => any::<bool>().prop_map(SetDebugLogging),
        1 => experiment(),
        6 => select(vec![
            EnterInitializationMode, ExitInitializationMode, Terminate, Reset, CancelStep,
            LastSuccessfulTime, Terminated,
        ]),
        1 => (0..6).prop_map(GetStatus),
        1 => (0..6).prop_map(GetIntegerStatus),
        1 => (0..6).prop_map(GetStringStatus),
        3 => get(),
        3 => set(state, false),
        3 => states(),
        2 => derivatives(),
        2 => step(true),
        1 => step(false),
        1 => Just(Replace),
    ]
    .boxed()
}

/// Calls that lead on from a state.
fn useful(state: char) -> BoxedStrategy<Call> {
    let restore = (0_usize..2).prop_map(Call::SetState);
    match state {
        'I' => prop_oneof![
            4 => experiment(),
            4 => Just(Call::EnterInitializationMode),
            2 => set(state, true),
            1 => states(),
            1 => derivatives(),
        ]
        .boxed(),
        'M' => prop_oneof![
            4 => Just(Call::ExitInitializationMode),
            3 => set(state, true),
            2 => get(),
            1 => states(),
            1 => derivatives(),
        ]
        .boxed(),
        'C' => prop_oneof![
            8 => step(true),
            5 => set(state, true),
            5 => get(),
            3 => states(),
            3 => derivatives(),
            1 => select(vec![Call::LastSuccessfulTime, Call::Terminated]),
            1 => (-4_i32..=8).prop_map(|it| {
                Call::Set(BaseType::Real, vec![(Picked::Row(super::variables::position("end.time")), Value::Real(f64::from(it)))])
            }),
        ]
        .boxed(),
        'F' => prop_oneof![
            3 => get(),
            2 => states(),
            2 => select(vec![Call::LastSuccessfulTime, Call::Terminated, Call::Terminate, Call::Reset]),
            1 => restore,
        ]
        .boxed(),
        _ => prop_oneof![1 => get(), 1 => states(), 1 => restore, 2 => Just(Call::Reset)].boxed(),
    }
}

/// The next call from a state.
pub(super) fn next(state: char) -> BoxedStrategy<Call> {
    thread_local! {
        static BY_STATE: Vec<BoxedStrategy<Call>> = STATES
            .chars()
            .map(|state| {
                // From these states an illegal call leads nowhere else, or to the error state at last.
                let odd = if "FTE".contains(state) { 4 } else { 1 };
                prop_oneof![5 => useful(state), odd => anything(state)].boxed()
            })
            .collect();
    }
    let column = STATES.find(state).unwrap();
    BY_STATE.with(|strategies| strategies[column].clone())
}
