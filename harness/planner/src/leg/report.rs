//! Results of a leg, as `plan.json`.

use inputs::leg::FlybyAimpoint;
use nalgebra::Vector3;
use physics::{constants::DAY_S, environment::dates};
use serde_json::{Value, json};

use super::{
    aimpoint::{Flyby, closest_distance_m},
    shooting::{Leg, LegTask},
};

/// The UTC date of a time of the flight, to the second; `zero_epoch_s` is the epoch of time 0 in s past J2000 TDB.
pub fn date(time_s: f64, zero_epoch_s: f64) -> String {
    let date = dates::utc(zero_epoch_s + time_s + 0.5);
    match date.split_once('.') {
        Some((seconds, _)) => format!("{seconds} UTC"),
        None => date,
    }
}

/// Altitude of the hyperbola that osculates the lead time before, in m: on the way from there the Sun's tide moves the path.
pub fn osculating_altitude_m(task: &LegTask, leg: &Leg) -> f64 {
    let found = &leg.encounter;
    closest_distance_m(found.b_m.norm(), found.excess_speed_m_s, task.mu_m3_s2) - task.radius_m
}

/// A time of the flight: its s, and the date where the flight has one.
fn instant(time_s: f64, zero_epoch_s: Option<f64>) -> Value {
    let mut instant = json!({ "time_s": time_s });
    if let Some(zero_s) = zero_epoch_s {
        instant["epoch_s"] = json!(zero_s + time_s);
        instant["date"] = json!(date(time_s, zero_s));
    }
    instant
}

/// The flyby of a leg by its closest approach and the hyperbola that osculates there.
pub fn flyby(task: &LegTask, leg: &Leg) -> Flyby {
    let distance_m = task.radius_m + leg.encounter.altitude_m;
    Flyby::new(distance_m, leg.encounter.excess_speed_there_m_s, task.mu_m3_s2)
}

/// Delta-v of the departure, EME2000, in m/s, where the velocity before it is known.
pub fn departure_m_s(task: &LegTask, leg: &Leg) -> Option<Vector3<f64>> {
    Some(leg.velocity_m_s - task.velocity_before_m_s?)
}

/// `plan.json`; `body` is the body's name, `zero_epoch_s` the epoch of time 0 in s past J2000 TDB where there is one.
///
/// # Errors
/// None that numbers make.
pub fn json(
    (task, leg): (&LegTask, &Leg),
    body: &str,
    zero_epoch_s: Option<f64>,
) -> Result<String, serde_json::Error> {
    let of = |vector: &Vector3<f64>| json!(vector.as_slice());
    let found = &leg.encounter;
    let flyby = flyby(task, leg);
    let aimpoint = match task.aimpoint {
        FlybyAimpoint::Altitude { altitude_m, angle_rad } => {
            json!({ "altitude_m": altitude_m, "angle_deg": angle_rad.to_degrees() })
        }
        FlybyAimpoint::Plane { b_t_m, b_r_m } => json!({ "bT_m": b_t_m, "bR_m": b_r_m }),
    };
    let mut report = json!({
        "status": "planned",
        "body": body,
        "departure": {
            "at": instant(task.start_s, zero_epoch_s),
            "position_m": of(&task.position_m),
            "velocity_m_s": of(&leg.velocity_m_s),
            "lambert_m_s": of(&leg.lambert_m_s),
        },
        "aim": aimpoint,
        "arrival": instant(found.arrival_s, zero_epoch_s),
        "days": (found.arrival_s - task.start_s) / DAY_S,
        "altitude_m": found.altitude_m,
        "osculation": instant(found.osculation_s, zero_epoch_s),
        "osculatingAltitude_m": osculating_altitude_m(task, leg),
        "bT_m": found.b_m.x,
        "bR_m": found.b_m.y,
        "excessSpeed_m_s": found.excess_speed_m_s,
        "miss_m": leg.miss_m,
        "turn_deg": flyby.turn_rad.to_degrees(),
        "flybyDeltaV_m_s": flyby.delta_v_m_s,
        "rounds": { "withoutBody": leg.rounds[0], "withBody": leg.rounds[1] },
    });
    if let Some(delta_v_m_s) = departure_m_s(task, leg) {
        report["deltaV"] = json!({ "vector_m_s": of(&delta_v_m_s), "size_m_s": delta_v_m_s.norm() });
    }
    serde_json::to_string_pretty(&report).map(|text| text + "\n")
}
