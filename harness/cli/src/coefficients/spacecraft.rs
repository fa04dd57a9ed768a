//! What sunshade, torques and wheels of a spacecraft come to, as the FMU itself computes it.

use loader::{Error, Fmu, Instance, Value};
use model_description::Causality;

use super::started;
use crate::output;

/// The monomials of paper 000's eq 3, in the order of the FMU's columns.
const TERMS: [&str; 9] = ["x", "y", "z", "x y", "x z", "y z", "x^2", "y^2", "z^2"];

/// Wheel capacities and the dump thresholds paper 000 states for them, in N m s.
const PAPER_THRESHOLDS_N_M_S: [(f64, f64); 3] = [(4.0, 4.0), (8.0, 5.5), (12.0, 7.0)];

/// Whether a table here shows this calculated parameter.
pub fn shows(name: &str) -> bool {
    name.starts_with("sunshade.coefficient[") || name == "dump.guaranteedThreshold"
}

/// The tables of those parts that the FMU has.
pub fn tables(fmu: &Fmu, sets: &[(String, Value)], instance: &mut Instance) -> Result<Vec<String>, Error> {
    let mut tables = Vec::new();
    if fmu.find("sunshade.coefficient[3,9]").is_some() {
        tables.push(polynomial(instance)?);
    }
    if fmu.find("torque.total[1]").is_some() && fmu.find("sun.elevation").is_some() {
        tables.push(loads(fmu, instance)?);
    }
    if fmu.find("wheel[1].capacity").is_some() && fmu.find("dump.guaranteedThreshold").is_some() {
        tables.push(wheels(fmu, sets, instance)?);
    }
    Ok(tables)
}

fn polynomial(instance: &mut Instance) -> Result<String, Error> {
    let mut table = output::table(&["term", "k_x [m3]", "k_y [m3]", "k_z [m3]"]);
    let mut greatest = 0.0_f64;
    for (column, term) in TERMS.iter().enumerate() {
        let mut row = vec![(*term).to_owned()];
        for component in 1..=3 {
            let name = format!("sunshade.coefficient[{component},{}]", column + 1);
            let coefficient = instance.get_real(&name)?;
            greatest = greatest.max(coefficient.abs());
            row.push(format!("{coefficient:>12.7}"));
        }
        table.add_row(row);
    }
    if greatest == 0.0 {
        return Ok("No sunshade: its torque coefficients are all zero.".to_owned());
    }
    let valid = instance.get("sunshade.polynomialValid")?.to_string() == "true";
    let holds =
        if valid { "holds" } else { "does not hold: part of the shade is dark, its torque is clipped" };
    Ok(format!(
        "Torque of sunlight on the sunshade about the centre of mass, shade frame: N_j = p * sum of k_j * term\n\
         (p: radiation pressure; x, y, z: unit vector to the Sun; variables sunshade.coefficient[j,k]).\n\
         With the Sun where it stands at the start the polynomial {holds}.\n{table}"
    ))
}

/// Torque and force by source at the start.
fn loads(fmu: &Fmu, instance: &mut Instance) -> Result<String, Error> {
    let azimuth_deg = instance.get_real("sun.azimuth")?.to_degrees();
    let elevation_deg = instance.get_real("sun.elevation")?.to_degrees();
    let mut table = output::table(&["at the start", "unit", "x", "y", "z"]);
    for variable in &fmu.description().variables {
        let Some(name) = variable.name.strip_suffix("[1]") else { continue };
        let load = ["torque.", "force."].iter().any(|group| name.starts_with(group));
        if !load || variable.causality != Causality::Output {
            continue;
        }
        let (unit, factor) = match loader::display_unit(fmu.description(), variable) {
            Some((unit, factor, _)) => (unit.to_owned(), factor),
            None => (loader::unit(fmu.description(), variable).unwrap_or_default().to_owned(), 1.0),
        };
        let mut row = vec![name.to_owned(), unit];
        for axis in 1..=3 {
            let value = instance.get_real(&format!("{name}[{axis}]"))? * factor;
            row.push(format!("{value:>12.6}"));
        }
        table.add_row(row);
    }
    Ok(format!(
        "Torque about the centre of mass and force, with the Sun at azimuth {azimuth_deg:.3} deg, elevation \
         {elevation_deg:.3} deg\n(body frame; force.inertial in EME2000).\n{table}"
    ))
}

/// What the wheels guarantee: as they are, and were each as large as the paper's.
fn wheels(fmu: &Fmu, sets: &[(String, Value)], instance: &mut Instance) -> Result<String, Error> {
    let names: Vec<String> = (1..)
        .map(|number| format!("wheel[{number}].capacity"))
        .take_while(|name| fmu.find(name).is_some())
        .collect();
    let mut own = Vec::new();
    for name in &names {
        own.push(instance.get_real(name)?);
    }
    own.dedup();
    let own: Vec<String> = own.into_iter().map(output::short).collect();
    let threshold = |instance: &mut Instance| instance.get_real("dump.guaranteedThreshold");
    let mut table = output::table(&[
        "wheel capacity [N.m.s]",
        "guaranteed threshold [N.m.s]",
        "paper 000 states [N.m.s]",
    ]);
    let as_is = format!("{} (this spacecraft)", own.join(", "));
    let guaranteed_n_m_s = threshold(instance)?;
    table.add_row([as_is, format!("{guaranteed_n_m_s:.4}"), String::new()]);
    for (capacity_n_m_s, stated_n_m_s) in PAPER_THRESHOLDS_N_M_S {
        let mut sets = sets.to_vec();
        sets.extend(names.iter().map(|name| (name.clone(), Value::Real(capacity_n_m_s))));
        let guaranteed_n_m_s = threshold(&mut started(fmu, &sets)?)?;
        table.add_row([
            format!("{capacity_n_m_s} each"),
            format!("{guaranteed_n_m_s:.4}"),
            stated_n_m_s.to_string(),
        ]);
    }
    let mut thresholds = Vec::new();
    let mut greatest_n_m_s = 0.0_f64;
    for axis in 1..=3 {
        let threshold_n_m_s = instance.get_real(&format!("dump.threshold[{axis}]"))?;
        greatest_n_m_s = greatest_n_m_s.max(threshold_n_m_s);
        thresholds.push(output::short(threshold_n_m_s));
    }
    // Rounding of the axes does not count.
    let beyond = greatest_n_m_s > guaranteed_n_m_s * (1.0 + 1e-9);
    let verdict = if beyond { "more than these wheels guarantee" } else { "which these wheels guarantee" };
    Ok(format!(
        "Dump threshold the {} wheels guarantee: whatever body components stay within it, none saturates\n\
         (dump.guaranteedThreshold, from axes, capacities and smallest-norm sharing; 0 unless they span all directions).\n\
         In use: dump.threshold = {} N.m.s, {verdict}.\n\
         Paper 000's are MESSENGER's; it does not print the axes.\n{table}",
        names.len(),
        thresholds.join(", ")
    ))
}
