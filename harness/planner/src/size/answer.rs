//! The answer first: wheels, time without unloading, propellant; and what was assumed for it.

use inputs::epoch::date;
use physics::constants::DAY_S;
use terminal::rounded;

use super::{
    needs::{NAMES, unspanned},
    sized::{SizedSpacecraft, YEAR_S},
    table::{Found, time, triple},
};

/// Values that count unless they are set: the variable, the key that sets it, and another that stands for it.
const UNSAID: [(&str, &str, &str); 4] = [
    ("start.epoch", "start.epoch", "start.epoch"),
    ("orbit.center", "orbit.center", "orbit.center"),
    ("orbit.semiMajorAxis", "orbit.*", "orbit.source"),
    ("guided.scienceRule", "guided.scienceRule", "attitude.source"),
];

/// The first line, and what no wheel holds.
pub(super) fn text(sized: &SizedSpacecraft, found: &Found) -> String {
    let spacecraft = &sized.spacecraft;
    let wheels = &found.unloadings.wheels;
    let count = if spacecraft.wheels.is_empty() { 4 } else { spacecraft.wheels.len() };
    let each = wheels.geometries.first().map_or([0.0; 2], |it| [it.capacity_n_m_s, it.torque_n_m]);
    let [capacity, torque] = each.map(rounded);
    let noun = if count == 1 { "wheel" } else { "wheels" };
    let each = if count == 1 { "" } else { " each" };
    let mut line = format!(
        "{}: {count} {noun} of {capacity} N.m.s and {torque} N.m{each} for {} without unloading",
        spacecraft.name,
        time(wheels.every_s)
    );
    if let Some(lasting_s) = found.lasting_s {
        let lasting =
            if lasting_s.is_finite() { time(lasting_s) } else { format!("over {}", time(sized.span_s)) };
        line.push_str(&format!(", the file's for {lasting}"));
    }
    let first_kg = found.unloadings.years.first().map_or(0.0, |year| year.propellant_kg);
    line.push_str(&format!("; {} kg of propellant a year", rounded(first_kg)));
    if let Some(years) = found.years {
        let last_kg = found.unloadings.years.last().map_or(first_kg, |year| year.propellant_kg);
        let whole_kg = found.unloadings.propellant_kg(years);
        line.push_str(&format!(
            " at first, {} in the last, {} in {} years",
            rounded(last_kg),
            rounded(whole_kg),
            terminal::short(years)
        ));
    }
    let across: Vec<String> = unspanned(spacecraft)
        .into_iter()
        .map(|axis| format!("{} N.m.s about {}", rounded(wheels.gathered_n_m_s[axis]), NAMES[axis]))
        .collect();
    if !across.is_empty() {
        line.push_str(&format!(
            "\nNo wheel holds what gathers in {}: {} (momentum.unheld); the capacity counts what lies along the wheels",
            time(wheels.every_s),
            across.join(", ")
        ));
    }
    line
}

/// Table of the values that neither file nor call sets, with the key that sets each.
pub(super) fn assumed(sized: &SizedSpacecraft, found: &Found) -> String {
    let spacecraft = &sized.spacecraft;
    let mut table = terminal::table(&["assumed", "value", "set by"]);
    let mut row = |what: &str, value: String, by: &str| {
        table.add_row([what, value.as_str(), by]);
    };
    if spacecraft.unload_every.is_none() && sized.every_s == DAY_S {
        row("time between unloadings", time(sized.every_s), "--every, [momentum] unload_every");
    }
    if sized.slew.is_none() {
        row("slews", "none".to_owned(), "--slew, [momentum] slew");
    }
    row("margin", rounded(found.margin), "--margin");
    if spacecraft.wheels.is_empty() {
        row("wheels", "four in a pyramid about Y".to_owned(), "[[wheels]]");
    }
    if spacecraft.dump_threshold_n_m_s.is_none() && !sized.says("dump.threshold") {
        let value = triple(found.threshold_n_m_s.into());
        row("dump.threshold [N.m.s]", value, "[momentum] dump_threshold_n_m_s");
    }
    if let Err(reason) = &found.allocations {
        row("dumps", reason.clone(), "[[thrusters]]");
    } else if found.unloadings.longest.is_some_and(|it| it.energy_j.is_none()) {
        row("energy of dumps", "unknown".to_owned(), "[[thrusters]] power_w");
    }
    let is_pointed = |name: &str| name == "guided.scienceRule" && spacecraft.pointing.is_some();
    for (name, key, _) in UNSAID
        .into_iter()
        .filter(|(name, _, other)| !sized.says(name) && !sized.says(other) && !is_pointed(name))
    {
        row(name, value(sized, name), key);
    }
    if found.years.is_none() && sized.span_s == YEAR_S {
        row("flight", time(sized.span_s), "--duration, --years");
    }
    table.to_string()
}

/// The value of a variable nobody set, as the file shows it.
fn value(sized: &SizedSpacecraft, name: &str) -> String {
    if let Some(item) = sized.simulation.values().item(name) {
        return item.to_owned();
    }
    let read = sized.started().and_then(|mut it| it.get_real(name));
    match (name, read) {
        ("start.epoch", Ok(epoch_s)) => date(epoch_s).unwrap_or_else(|| format!("{epoch_s} s")),
        ("orbit.semiMajorAxis", Ok(axis_m)) => format!("{} km", rounded(axis_m / 1e3)),
        (_, Ok(value)) => rounded(value),
        (_, Err(_)) => "the default".to_owned(),
    }
}
