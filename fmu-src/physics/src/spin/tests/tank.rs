//! Thrusters fire as long as there is propellant, to the instant, whatever the grid.

use approx::assert_relative_eq;

use super::{ace, directions, firing, paper_start, pulses, request};
use crate::spin::{
    burn_request::BurnRequest,
    plant::{Commands, Outputs, Plant, Predictions, Start},
    spinner::Spinner,
};

const FLOW_KG_S: f64 = 4.448 / (220.0 * 9.806_65);

fn start(propellant_kg: f64) -> Start {
    Start { propellant_kg, ..paper_start(1.483) }
}

fn launch(spinner: &Spinner, start: &Start, commands: Commands) -> Plant {
    Plant::start(spinner, start, directions(), commands, 0.0).unwrap()
}

#[test]
fn a_held_thruster_goes_off_when_the_last_drop_is_gone() {
    let spinner = ace();
    let depletion_time_s = 0.01 / FLOW_KG_S;
    let mut ends = Vec::new();
    for step_s in [0.001, 0.032, 0.7, 20.0] {
        let mut plant = launch(&spinner, &start(0.01), firing(&[8]));
        for i in 1..=(20.0_f64 / step_s).floor() as u32 {
            plant.advance(&spinner, f64::from(i) * step_s).unwrap();
            let outputs = Outputs::from_plant(&plant, &spinner);
            assert_eq!(plant.propulsion.valves.open_mask() == 0, plant.time_s >= depletion_time_s);
            assert_relative_eq!(
                outputs.propellant_used_kg,
                (FLOW_KG_S * plant.time_s).min(0.01),
                max_relative = 1e-12
            );
        }
        plant.advance(&spinner, 20.0).unwrap();
        assert!(plant.propulsion.is_dry());
        ends.push(Outputs::from_plant(&plant, &spinner));
    }
    let end = &ends[0];
    assert!(ends.iter().all(|other| other == end));
    assert_eq!((end.propellant_used_kg, end.propellant_remaining_kg), (0.01, 0.0));
    // A pulse of that length does the same to a spinner that has enough.
    let mut rich = launch(&spinner, &start(97.5), pulses(&[8], 0.0, depletion_time_s));
    rich.advance(&spinner, 20.0).unwrap();
    let expected = Outputs::from_plant(&rich, &spinner);
    assert!((end.state.momentum_inertial - expected.state.momentum_inertial).norm() < 1e-9);
    assert_relative_eq!(end.predicted_nutation_rad, expected.predicted_nutation_rad, max_relative = 1e-9);
    assert_relative_eq!(expected.propellant_used_kg, 0.01, max_relative = 1e-12);
}

#[test]
fn nothing_fires_from_an_empty_tank() {
    let spinner = ace();
    let mut plant = launch(&spinner, &start(0.0), firing(&[7, 8, 9]));
    let before = Outputs::from_plant(&plant, &spinner);
    plant.advance(&spinner, 100.0).unwrap();
    let after = Outputs::from_plant(&plant, &spinner);
    assert_eq!(after.state.momentum_inertial, before.state.momentum_inertial);
    assert_eq!((after.propellant_used_kg, after.delta_v_inertial_m_s.norm()), (0.0, 0.0));
}

#[test]
fn a_burn_is_refused_what_is_not_on_board_and_simulated_with_the_last_drop() {
    let spinner = ace();
    let needed_kg = 114.0 * 0.032 * FLOW_KG_S;
    let mut start = start(0.999 * needed_kg);
    start.burn = Some(request());
    let refusal = |start: &Start| {
        Plant::start(&spinner, start, directions(), Commands::default(), 0.0).unwrap_err().to_string()
    };
    for part in ["propellant would be 0.0075", "propellant.loaded = 0.0075"] {
        assert!(refusal(&start).contains(part), "{}", refusal(&start));
    }
    start.propellant_kg = needed_kg;
    let mut plant = launch(&spinner, &start, Commands::default());
    plant.advance(&spinner, 1400.0).unwrap();
    let outputs = Outputs::from_plant(&plant, &spinner);
    assert!(outputs.burn_done && outputs.pulses_fired == 114);
    assert_relative_eq!(outputs.propellant_used_kg, needed_kg, max_relative = 1e-12);
    assert_relative_eq!(
        outputs.momentum_displacement_rad,
        Predictions::from_plant(&plant).manoeuvre_rad,
        max_relative = 1e-3
    );
}

#[test]
fn a_burn_whose_propellant_others_take_ends_in_the_midst_of_its_pulse() {
    let spinner = ace();
    // Four pulses of 1 s fit; two thrusters without torque take one and a half of them away beforehand.
    let mut start = start(4.0 * FLOW_KG_S);
    start.burn = Some(BurnRequest { pulse_width_s: 1.0, count: 4, start_s: 5.0, ..request() });
    let mut plant = launch(&spinner, &start, firing(&[7, 9]));
    plant.advance(&spinner, 0.75).unwrap();
    plant.command(Commands::default(), directions());
    plant.advance(&spinner, 200.0).unwrap();
    let outputs = Outputs::from_plant(&plant, &spinner);
    assert_eq!(outputs.pulses_fired, 2);
    assert!(!outputs.burn_done && !outputs.burn_active && outputs.next_edge_s < 0.0);
    assert_eq!(outputs.propellant_remaining_kg, 0.0);
    // Two pulses and a half, the half beginning at the edge of its pulse and so early by a quarter of a second.
    let per_second = 1.7792 / (353.82 * core::f64::consts::PI / 6.0);
    assert_relative_eq!(outputs.momentum_displacement_rad, 2.5 * per_second, max_relative = 0.02);
}

#[test]
fn a_lighter_spinner_gains_more_speed() {
    let spinner = ace();
    let mut plant = launch(&spinner, &start(97.5), Commands::default());
    let mut expected = 0.0;
    let mut mass_kg = 562.0 + 97.5;
    // Along the axis, so that nothing turns.
    for firing_number in 0..4 {
        let from_s = 6000.0 * f64::from(firing_number);
        plant.command(firing(&[7, 9]), directions());
        plant.advance(&spinner, from_s + 5000.0).unwrap();
        plant.command(Commands::default(), directions());
        plant.advance(&spinner, from_s + 6000.0).unwrap();
        let before_kg = mass_kg;
        mass_kg -= 2.0 * FLOW_KG_S * 5000.0;
        expected += 220.0 * 9.806_65 * (before_kg / mass_kg).ln();
        assert_relative_eq!(
            Outputs::from_plant(&plant, &spinner).delta_v_inertial_m_s.norm(),
            expected,
            max_relative = 1e-9
        );
    }
    assert!(mass_kg < 0.95 * 659.5);
}
