//! Capacity of wheels: inscribed sphere, guaranteed box, and the box of least-norm allocation, as the FMU allocates momentum.

use fmi::{Error, Fmu, Instance};
use physics::{momentum::WheelCapacity, spacecraft::free_capacity_n_m_s};

use crate::instance::vector;

/// Table of the capacities that the wheels guarantee.
pub(super) fn table(fmu: &Fmu, instance: &mut Instance) -> Result<String, Error> {
    let count = (1..).take_while(|number| fmu.find(&format!("wheel[{number}].capacity")).is_some()).count();
    let (mut capacities_n_m_s, mut biases_n_m_s, mut axes_body) = (Vec::new(), Vec::new(), Vec::new());
    for number in 1..=count {
        capacities_n_m_s.push(instance.get_real(&format!("wheel[{number}].capacity"))?);
        let bias = format!("wheel[{number}].biasMomentum");
        biases_n_m_s.push(if fmu.find(&bias).is_some() { instance.get_real(&bias)? } else { 0.0 });
        axes_body.push(vector(instance, &format!("wheel[{number}].axis"))?.normalize());
    }
    let mut distinct = capacities_n_m_s.clone();
    distinct.dedup();
    let distinct: Vec<String> = distinct.into_iter().map(terminal::short).collect();
    let guaranteed_n_m_s = instance.get_real("dump.guaranteedThreshold")?;
    let free_n_m_s = capacities_n_m_s.iter().zip(biases_n_m_s);
    let free_n_m_s: Vec<f64> =
        free_n_m_s.map(|(capacity, bias)| free_capacity_n_m_s(*capacity, bias)).collect();
    let held = WheelCapacity::new(&axes_body, &free_n_m_s);
    let shown = |meaning: fn(WheelCapacity) -> f64| format!("{:.4}", held.map_or(0.0, meaning));
    let mut table = terminal::table(&[
        "wheel capacity [N.m.s]",
        "inscribed sphere [N.m.s]",
        "guaranteed box [N.m.s]",
        "least-norm sharing [N.m.s]",
    ]);
    table.add_row([
        distinct.join(", "),
        shown(|held| held.sphere_n_m_s),
        shown(|held| held.box_n_m_s),
        format!("{guaranteed_n_m_s:.4}"),
    ]);
    let thresholds_n_m_s = vector(instance, "dump.threshold")?;
    // Rounding of the axes does not count.
    let beyond = thresholds_n_m_s.max() > guaranteed_n_m_s * (1.0 + 1e-9);
    let verdict = if beyond { "more than these wheels guarantee" } else { "which these wheels guarantee" };
    Ok(format!(
        "What the {count} wheels hold (0 unless they span all directions): in any direction (inscribed sphere), on all body\n\
         axes at once (guaranteed box, half its edge), and on all at once by least-norm sharing, as the FMU shares momentum\n\
         (dump.guaranteedThreshold): what dump.threshold may be.\n\
         In use: dump.threshold = {} N.m.s, {verdict}.\n{table}",
        thresholds_n_m_s.as_slice().iter().copied().map(terminal::short).collect::<Vec<_>>().join(", "),
    ))
}
