//! Dump thresholds by the wheels' allocation: smallest norm, as the FMU shares momentum, and least greatest load.

use loader::{Error, Fmu, Instance};
use nalgebra::Vector3;
use physics::momentum::attainable_threshold_n_m_s;

/// What the wheels guarantee.
pub fn table(fmu: &Fmu, instance: &mut Instance) -> Result<String, Error> {
    let count = (1..).take_while(|number| fmu.find(&format!("wheel[{number}].capacity")).is_some()).count();
    let (mut capacities_n_m_s, mut axes_body) = (Vec::new(), Vec::new());
    for number in 1..=count {
        capacities_n_m_s.push(instance.get_real(&format!("wheel[{number}].capacity"))?);
        axes_body.push(vector(instance, &format!("wheel[{number}].axis"))?.normalize());
    }
    let mut distinct = capacities_n_m_s.clone();
    distinct.dedup();
    let distinct: Vec<String> = distinct.into_iter().map(terminal::short).collect();
    let guaranteed_n_m_s = instance.get_real("dump.guaranteedThreshold")?;
    let mut table =
        terminal::table(&["wheel capacity [N.m.s]", "smallest norm [N.m.s]", "least greatest load [N.m.s]"]);
    table.add_row([
        distinct.join(", "),
        format!("{guaranteed_n_m_s:.4}"),
        format!("{:.4}", attainable_threshold_n_m_s(&axes_body, &capacities_n_m_s)),
    ]);
    let thresholds_n_m_s = vector(instance, "dump.threshold")?;
    // Rounding of the axes does not count.
    let beyond = thresholds_n_m_s.max() > guaranteed_n_m_s * (1.0 + 1e-9);
    let verdict = if beyond { "more than these wheels guarantee" } else { "which these wheels guarantee" };
    Ok(format!(
        "Dump threshold the {count} wheels guarantee: whatever body components stay within it, none saturates\n\
         (0 unless they span all directions). By smallest norm, as the FMU shares momentum (dump.guaranteedThreshold),\n\
         and by the allocation whose greatest load is least, the most any sharing allows.\n\
         In use: dump.threshold = {} N.m.s, {verdict}.\n{table}",
        thresholds_n_m_s.as_slice().iter().copied().map(terminal::short).collect::<Vec<_>>().join(", "),
    ))
}

fn vector(instance: &mut Instance, name: &str) -> Result<Vector3<f64>, Error> {
    let [x, y, z] = [1, 2, 3].map(|axis| instance.get_real(&format!("{name}[{axis}]")));
    Ok(Vector3::new(x?, y?, z?))
}
