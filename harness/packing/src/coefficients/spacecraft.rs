//! Coefficients of sunshade, torques and wheels of a spacecraft, as the FMU itself computes them.

use fmi::{Error, Fmu, Instance};
use model_description::Causality;

use super::wheels;

/// The monomials of paper 000's eq 3, in the order of the FMU's columns.
const TERMS: [&str; 9] = ["x", "y", "z", "x y", "x z", "y z", "x^2", "y^2", "z^2"];

/// Whether a table here shows this calculated parameter.
pub(super) fn shows(name: &str) -> bool {
    name.starts_with("sunshade.coefficient[") || name == "dump.guaranteedThreshold"
}

/// The tables of those parts that the FMU has.
pub(super) fn tables(fmu: &Fmu, instance: &mut Instance) -> Result<Vec<String>, Error> {
    let mut tables = Vec::new();
    if fmu.find("sunshade.coefficient[3,9]").is_some() {
        tables.push(polynomial(instance)?);
    }
    if fmu.find("torque.total[1]").is_some() && fmu.find("sun.elevation").is_some() {
        tables.push(loads(fmu, instance)?);
    }
    let names = ["wheel[1].capacity", "wheel[1].axis[3]", "dump.threshold[3]", "dump.guaranteedThreshold"];
    if names.iter().all(|name| fmu.find(name).is_some()) {
        tables.push(wheels::table(fmu, instance)?);
    }
    Ok(tables)
}

fn polynomial(instance: &mut Instance) -> Result<String, Error> {
    let mut table = terminal::table(&["term", "k_x [m3]", "k_y [m3]", "k_z [m3]"]);
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
    let mut table = terminal::table(&["at the start", "unit", "x", "y", "z"]);
    for variable in &fmu.description().variables {
        let Some(name) = variable.name.strip_suffix("[1]") else { continue };
        let load = ["torque.", "force."].iter().any(|group| name.starts_with(group));
        if !load || variable.causality != Causality::Output {
            continue;
        }
        let (unit, factor) = match fmi::display_unit(fmu.description(), variable) {
            Some((unit, factor, _)) => (unit.to_owned(), factor),
            None => (fmi::unit(fmu.description(), variable).unwrap_or_default().to_owned(), 1.0),
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
