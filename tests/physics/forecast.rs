//! Forecasts where a downlink begins are what is then simulated, over events of the schedule too.

use std::cell::RefCell;

use nalgebra::Vector3;
use physics::attitude::Attitude;
use physics::guidance::SelectedSunDirection;
use physics::guidance::timeline::{TimelineEvent, TimelineManeuver};
use physics::loads::ForceTorque;
use physics::momentum::WheelArray;
use physics::numerics::Span;
use physics::plant::{
    AttitudeSource, Command, DownlinkForecast, DynamicsInputs, Flight, IdealSettings, ModeSettings,
    PlantError, SimulationContext, StepContext, ThrusterEventSettings, Thrusters, forecast,
};

use super::plant_flight::{Rig, configuration, guided, orbit};

const HOUR_S: f64 = 3600.0;

/// Times ahead in s, and the momentum there, EME2000, in N m s.
type History = Vec<(f64, Vector3<f64>)>;

/// The forecast at the first downlink for the times behind its begin, with these events, and what is then simulated there.
fn forecast_and_flight(events: &[TimelineEvent], behind_s: &[f64]) -> [History; 2] {
    let orbit = orbit();
    let AttitudeSource::Guided(law) = guided(&orbit) else { panic!("guided") };
    let mut configured =
        configuration(orbit, AttitudeSource::Guided(physics::guidance::Guided { managed: true, ..law }));
    configured.thruster_events =
        ThrusterEventSettings { schedule: events.into(), dumps: true, ..ThrusterEventSettings::default() };
    let (rig, found) = (Rig::new(), RefCell::new(History::new()));
    let planner = |start: &mut DownlinkForecast<'_, '_>| -> Result<Option<SelectedSunDirection>, PlantError> {
        let mut found = found.borrow_mut();
        if found.is_empty() {
            let times_s = behind_s.iter().map(|behind_s| start.begin.time_s + behind_s);
            let times_s: Vec<f64> = times_s.collect();
            forecast(start, times_s.into_iter(), 600.0, |at| {
                found.push((at.time_s, at.momentum_inertial_n_m_s))
            })?;
        }
        // The default attitude, which forecasts assume.
        Ok(None)
    };
    let external = |_: f64| [ForceTorque::zero(); 2];
    let inputs = DynamicsInputs::default();
    let given = StepContext {
        prepared: rig.prepared(),
        external: &external,
        inputs: &inputs,
        planner: &planner,
        work_limit: u32::MAX,
        log: &|_| {},
    };
    let mut flight = Flight::waiting(Thrusters::new(0, 0, 0.0));
    let settings = IdealSettings {
        array: WheelArray::from_axes(&[]),
        wheels: Vec::new(),
        sun_sensors: Vec::new(),
        rate_hz: 1.0,
        seed: 0,
        start_momentum_body_n_m_s: Vector3::new(0.3, -0.2, 0.1),
    };
    flight.configure(SimulationContext::new(configured), ModeSettings::Ideal(settings));
    let held = Command {
        attitude: Attitude::from_quaternion([0.0, 0.0, 0.0, 1.0]).unwrap(),
        rate_body_rad_s: Vector3::zeros(),
        since_s: 0.0,
    };
    flight.begin(given, &held, 0.0).unwrap();
    let mut now_s = 0.0;
    let mut advance = |to_s: f64| {
        flight.advance(given, Span::new(now_s, to_s)).unwrap();
        now_s = to_s;
        flight.evaluate(given, &held, true, to_s).unwrap();
        let report = flight.report(given.prepared, &inputs, &held, true, to_s).unwrap();
        report.summary.totals.momentum_inertial_n_m_s
    };
    advance(4.0 * HOUR_S);
    let forecast = found.borrow().clone();
    let simulated = forecast.iter().map(|(at_s, _)| (*at_s, advance(*at_s))).collect();
    [forecast, simulated]
}

#[test]
fn a_forecast_is_the_flight_over_maneuvers_and_places_of_the_centre_of_mass() {
    let maneuver = TimelineManeuver {
        delta_v_inertial_m_s: Vector3::new(30.0, -20.0, 10.0),
        thrusters: None,
        dumps: Some(false),
    };
    let events = [
        TimelineEvent { at_s: 20.3 * HOUR_S, maneuver: Some(maneuver), ..TimelineEvent::default() },
        TimelineEvent {
            at_s: 31.7 * HOUR_S,
            center_of_mass_body_m: Some(Vector3::new(0.02, 0.01, -0.05)),
            ..TimelineEvent::default()
        },
    ];
    // Behind the downlink's end, each event and the next downlink.
    let behind_s: Vec<f64> = (3..=14).map(|k| 4.0 * f64::from(k) * HOUR_S).collect();
    let [without, _] = forecast_and_flight(&[], &behind_s);
    let [forecast, simulated] = forecast_and_flight(&events, &behind_s);
    assert_eq!(forecast.len(), behind_s.len());
    let (mut worst, mut by_events) = (0.0_f64, 0.0_f64);
    for (((at_s, forecast), (_, simulated)), (_, without)) in forecast.iter().zip(&simulated).zip(&without) {
        worst = worst.max((forecast - simulated).norm());
        by_events = by_events.max((forecast - without).norm());
        assert!(worst < 1e-5, "{at_s}: {forecast} {simulated}");
    }
    println!("{worst:e} apart, {by_events} by the events");
    assert!(by_events > 0.1, "{by_events}");
}
