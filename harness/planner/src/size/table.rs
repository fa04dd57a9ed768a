//! The tables on the screen, and the CSV of dumps by threshold.

use fmi::csv::Real;
use physics::constants::DAY_S;
use terminal::rounded;

use nalgebra::Vector3;

use super::{
    flights::{Dumped, Sweep},
    momentum::SourceRow,
    needs::{Allocation, Slew, capacity_n_m_s},
    sized::{SizedSpacecraft, YEAR_S},
    unloading::Unloadings,
};
use crate::text_table::{self, headed};

/// Results, but for pictures.
pub(super) struct Found {
    pub sources: Vec<SourceRow>,
    pub sweep: Sweep,
    pub slews: Option<[Slew; 3]>,
    /// By the time between unloadings.
    pub unloadings: Unloadings,
    /// The same by an orbit and a week, where the flight has whole ones.
    pub others: Vec<Unloadings>,
    /// How long the file's wheels last, in s; `None` without any.
    pub lasting_s: Option<f64>,
    /// How many years the mission lasts, where it was said.
    pub years: Option<f64>,
    pub threshold_n_m_s: Vector3<f64>,
    /// Why dumps take no propellant, or thrusters by axis.
    pub allocations: Result<Vec<Allocation>, String>,
    pub margin: f64,
}

/// Every table.
pub(super) fn text(sized: &SizedSpacecraft, found: &Found) -> String {
    let mut parts = vec![
        unloadings(found),
        sources(sized, &found.sources),
        dumps(sized, &found.sweep),
        wheels(sized, found),
    ];
    parts.extend(found.slews.as_ref().map(slews));
    parts.extend(found.allocations.as_ref().ok().map(|rows| allocations(rows)));
    parts.join("\n\n")
}

/// Wheels and thrusters by the time between unloadings.
fn unloadings(found: &Found) -> String {
    let mut table = headed(
        "unloaded every | capacity of each wheel [N.m.s] | torque [N.m] | impulse a year [N.m.s] | propellant a year [kg] | most minutes a dump | most W.h a dump",
    );
    let mut rows: Vec<&Unloadings> = found.others.iter().chain([&found.unloadings]).collect();
    rows.sort_by(|a, b| a.wheels.every_s.total_cmp(&b.wheels.every_s));
    for row in rows {
        let Some((wheels, year)) = row.wheels.geometries.first().zip(row.years.first()) else { continue };
        let firing = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), rounded);
        table.add_row([
            time(row.wheels.every_s),
            rounded(wheels.capacity_n_m_s),
            rounded(wheels.torque_n_m),
            rounded(year.impulse_n_m_s),
            rounded(year.propellant_kg),
            firing(row.longest.map(|it| it.time_s / 60.0)),
            firing(row.longest.and_then(|it| it.energy_j).map(|energy_j| energy_j / 3600.0)),
        ]);
    }
    format!(
        "Unloaded to the bias whatever gathered, by the thrusters at full thrust; the capacity with slews and margin\n{table}"
    )
}

fn sources(sized: &SizedSpacecraft, rows: &[SourceRow]) -> String {
    let mut table = terminal::table(&[
        "momentum.* [N.m.s]",
        "secular per orbit: X, Y, Z",
        "cyclic in an orbit",
        &format!("most in {}", time(sized.every_s)),
    ]);
    for row in rows.iter().filter(|row| !is_nothing(row)) {
        table.add_row([
            row.source.clone(),
            triple(row.secular_per_orbit_n_m_s.into()),
            triple(row.cyclic_in_orbit_n_m_s.into()),
            triple(row.gathered_n_m_s.into()),
        ]);
    }
    format!(
        "{}: momentum without dumps, {} of flight, orbits of {}; gathered from the beginning of a window on, in the body frame at \
         its end, momentum.inertial in EME2000\n{table}",
        sized.spacecraft.name,
        time(sized.span_s),
        time(sized.period_s)
    )
}

/// Sources that are off.
fn is_nothing(row: &SourceRow) -> bool {
    row.cyclic_in_orbit_n_m_s.iter().chain(&row.gathered_n_m_s).all(|part| *part == 0.0)
}

fn dumps(sized: &SizedSpacecraft, sweep: &Sweep) -> String {
    let mut table = headed(
        "strategy | dump.threshold [N.m.s] | capacity of each wheel [N.m.s] | dumps a year | impulse a year [N.m.s] | propellant a year [kg]",
    );
    for it in &sweep.dumped {
        table.add_row([
            it.strategy.to_owned(),
            triple(it.threshold_n_m_s.into()),
            rounded(capacity(sized, it)),
            rounded(it.dumps),
            rounded(it.impulse_n_m_s),
            rounded(it.propellant_kg),
        ]);
    }
    let left_out = match sweep.left_out {
        0 => String::new(),
        count => format!("\n{count} more flights were left out: see --budget"),
    };
    format!(
        "Dumps by threshold; the wheels' capacity is that whose least-norm sharing holds it\n{table}{left_out}"
    )
}

/// Capacity of each wheel by the threshold.
pub(super) fn capacity(sized: &SizedSpacecraft, dumped: &Dumped) -> f64 {
    capacity_n_m_s(&sized.spacecraft, &dumped.threshold_n_m_s)
}

fn wheels(sized: &SizedSpacecraft, found: &Found) -> String {
    let wheels = &found.unloadings.wheels;
    let mut table = terminal::table(&["wheels", "capacity of each [N.m.s]", "torque of each [N.m]"]);
    for it in &wheels.geometries {
        table.add_row([it.name.clone(), rounded(it.capacity_n_m_s), rounded(it.torque_n_m)]);
    }
    let own = sized.spacecraft.wheels.iter().map(|wheel| wheel.capacity_n_m_s).reduce(f64::min);
    let own = own.map_or_else(|| "none".to_owned(), |capacity| format!("{} N.m.s each", rounded(capacity)));
    format!(
        "Wheels for {} N.m.s and {} N.m about X, Y, Z, beside their bias, about every axis at once: {} N.m.s gathered in {} \
         (time between unloadings{}), in the room between dumps, a slew, and a margin of {}; the file has {own}\n{table}",
        triple(wheels.needed_n_m_s.into()),
        triple(wheels.needed_n_m.into()),
        triple(wheels.gathered_n_m_s.into()),
        time(sized.every_s),
        if sized.span_s < sized.every_s { "; the flight is shorter, see --duration" } else { "" },
        rounded(found.margin)
    )
}

fn slews(slews: &[Slew; 3]) -> String {
    let mut table = terminal::table(&["slew about", "torque [N.m]", "momentum [N.m.s]"]);
    for slew in slews {
        table.add_row([slew.axis.to_owned(), rounded(slew.torque_n_m), rounded(slew.momentum_n_m_s)]);
    }
    format!("The slew about each axis from rest to rest, speeding up for half of the time\n{table}")
}

fn allocations(rows: &[Allocation]) -> String {
    let mut table = headed(
        "torque about | lever [m] | least impulse [N.m.s] | propellant [g per N.m.s] | seconds of full thrust for 1 N.m.s",
    );
    for row in rows {
        let shares = row.shares.iter().map(|(name, on_time_s)| format!("{name} {}", rounded(*on_time_s)));
        table.add_row([
            row.sense.clone(),
            rounded(row.lever_m),
            rounded(row.least_impulse_n_m_s),
            rounded(row.propellant_g_per_n_m_s),
            shares.collect::<Vec<_>>().join(", "),
        ]);
    }
    format!(
        "Thrusters as dumps use them: the weakest that turn both ways, couples where there are some\n{table}"
    )
}

/// Dumps by threshold and strategy, SI, as CSV.
pub(super) fn csv(sized: &SizedSpacecraft, sweep: &Sweep) -> String {
    let rows = sweep.dumped.iter().map(|it| {
        let [x, y, z]: [f64; 3] = it.threshold_n_m_s.into();
        let numbers = [x, y, z, capacity(sized, it), it.dumps, it.impulse_n_m_s, it.propellant_kg];
        [it.strategy.to_owned()].into_iter().chain(numbers.map(|value| Real(value).to_string()))
    });
    let header = "strategy,threshold_x_n_m_s,threshold_y_n_m_s,threshold_z_n_m_s,wheel_capacity_n_m_s,dumps_per_year,\
                  impulse_n_m_s_per_year,propellant_kg_per_year";
    text_table::csv(header, rows)
}

pub(super) fn triple(values: [f64; 3]) -> String {
    values.map(rounded).join(", ")
}

/// In the largest unit that it has one of.
pub(super) fn time(span_s: f64) -> String {
    const UNITS: [(f64, &str); 4] = [(YEAR_S, "a"), (DAY_S, "d"), (3600.0, "h"), (60.0, "min")];
    let unit = UNITS.into_iter().find(|(unit_s, _)| span_s >= *unit_s);
    let (unit_s, unit) = unit.unwrap_or((1.0, "s"));
    format!("{} {unit}", rounded(span_s / unit_s))
}
