//! `--json` of `heliotorque size`: the numbers of the tables as one object, SI.

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::{needs::capacity_n_m_s, sized::SizedSpacecraft, table::Found, unloading::Unloadings};

fn components(vector: &Vector3<f64>) -> [f64; 3] {
    (*vector).into()
}

fn unloadings(it: &Unloadings) -> Value {
    let wheels = it.wheels.geometries.iter().map(|wheel| {
        json!({ "name": wheel.name, "capacity_N_m_s": wheel.capacity_n_m_s, "torque_N_m": wheel.torque_n_m })
    });
    let years = it
        .years
        .iter()
        .map(|year| json!({ "impulse_N_m_s": year.impulse_n_m_s, "propellant_kg": year.propellant_kg }));
    let longest = it.longest.map(|dump| {
        json!({ "time_s": dump.time_s, "propellant_kg": dump.propellant_kg, "energy_J": dump.energy_j })
    });
    json!({
        "every_s": it.wheels.every_s,
        "gathered_N_m_s": components(&it.wheels.gathered_n_m_s),
        "needed_N_m_s": components(&it.wheels.needed_n_m_s),
        "needed_N_m": components(&it.wheels.needed_n_m),
        "wheels": wheels.collect::<Vec<_>>(),
        "years": years.collect::<Vec<_>>(),
        "longestDump": longest,
    })
}

/// Returns the object.
pub(super) fn object(sized: &SizedSpacecraft, found: &Found) -> Value {
    let sources = found.sources.iter().map(|row| {
        json!({
            "source": row.source,
            "secularPerOrbit_N_m_s": components(&row.secular_per_orbit_n_m_s),
            "cyclicInOrbit_N_m_s": components(&row.cyclic_in_orbit_n_m_s),
            "gathered_N_m_s": components(&row.gathered_n_m_s),
        })
    });
    let dumps = found.sweep.dumped.iter().map(|it| {
        json!({
            "strategy": it.strategy,
            "threshold_N_m_s": components(&it.threshold_n_m_s),
            "wheelCapacity_N_m_s": capacity_n_m_s(&sized.spacecraft, &it.threshold_n_m_s),
            "dumpsPerYear": it.dumps,
            "impulsePerYear_N_m_s": it.impulse_n_m_s,
            "propellantPerYear_kg": it.propellant_kg,
        })
    });
    let slews = found.slews.iter().flatten().map(
        |slew| json!({ "axis": slew.axis, "torque_N_m": slew.torque_n_m, "momentum_N_m_s": slew.momentum_n_m_s }),
    );
    let thrusters = found.allocations.iter().flatten().map(|row| {
        json!({
            "torqueAbout": row.sense,
            "lever_m": row.lever_m,
            "leastImpulse_N_m_s": row.least_impulse_n_m_s,
            "propellant_g_per_N_m_s": row.propellant_g_per_n_m_s,
            "secondsOfFullThrust": row.shares,
        })
    });
    json!({
        "spacecraft": sized.spacecraft.name,
        "flight_s": sized.span_s,
        "orbit_s": sized.period_s,
        "margin": found.margin,
        "lasting_s": found.lasting_s,
        "unloadings": found.others.iter().chain([&found.unloadings]).map(unloadings).collect::<Vec<_>>(),
        "sources": sources.collect::<Vec<_>>(),
        "dumps": dumps.collect::<Vec<_>>(),
        "dumpsLeftOut": found.sweep.left_out,
        "slews": slews.collect::<Vec<_>>(),
        "thrusters": thrusters.collect::<Vec<_>>(),
    })
}
