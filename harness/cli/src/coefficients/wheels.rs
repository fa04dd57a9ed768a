//! Dump thresholds by the wheels' allocation: smallest norm, as the FMU shares momentum, and least greatest load.
//!
//! Momenta the wheels can hold at all form a zonotope, the sum of the segments -c_k a_k .. c_k a_k over capacities c_k and
//! axes a_k. An allocation that makes the greatest relative load least reaches all of it. The cube of body components
//! within -h .. +h lies inside it if h |n|_1 <= sum_k c_k |a_k . n| for the normal n = a_i x a_j of every face
//! (Markley et al., "Maximum torque and momentum envelopes for reaction-wheel arrays", JGCD 33, 2010).

use loader::{Error, Fmu, Value};
use physics::spacecraft::{MESSENGER_TOML, Spacecraft};

use super::instance::started;

/// Wheel capacities and the dump thresholds paper 000 states for them, in N m s.
const PAPER_THRESHOLDS_N_M_S: [(f64, f64); 3] = [(4.0, 4.0), (8.0, 5.5), (12.0, 7.0)];

type Vector = [f64; 3];

/// Whether the FMU holds the spacecraft that paper 000 is about, by its name in the file.
fn is_messenger(fmu: &Fmu) -> bool {
    let file = fmu.folder().join("resources").join("spacecraft.toml");
    let Ok(text) = files::read_text(&file) else { return false };
    let name = |text: &str| Spacecraft::from_toml("", text).map(|it| it.name).unwrap_or_default();
    let messenger = name(MESSENGER_TOML);
    name(&text).strip_prefix(&messenger).is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
}

/// What the wheels guarantee: as they are, and of MESSENGER, were each as large as the paper's.
pub fn table(fmu: &Fmu, sets: &[(String, Value)]) -> Result<String, Error> {
    let count = (1..).take_while(|number| fmu.find(&format!("wheel[{number}].capacity")).is_some()).count();
    let names: Vec<String> = (1..=count).map(|number| format!("wheel[{number}].capacity")).collect();
    let mut instance = started(fmu, sets)?;
    let capacities_n_m_s: Vec<f64> =
        names.iter().map(|name| instance.get_real(name)).collect::<Result<_, _>>()?;
    let mut distinct = capacities_n_m_s.clone();
    distinct.dedup();
    let distinct: Vec<String> = distinct.into_iter().map(terminal::short).collect();
    let axes = axes_body(fmu, sets, count)?;
    let least_load = |capacities_n_m_s: &[f64]| {
        let axes = axes.as_deref().unwrap_or_default();
        format!("{:.4}", least_load_threshold_n_m_s(axes, capacities_n_m_s))
    };
    let is_messenger = is_messenger(fmu);
    let header = [
        "wheel capacity [N.m.s]",
        "smallest norm [N.m.s]",
        "least greatest load [N.m.s]",
        "paper 000 states [N.m.s]",
    ];
    let columns = if is_messenger { header.len() } else { header.len() - 1 };
    let mut table = terminal::table(&header[..columns]);
    let guaranteed_n_m_s = instance.get_real("dump.guaranteedThreshold")?;
    let as_is = format!("{} (this spacecraft)", distinct.join(", "));
    let mut cells =
        vec![as_is, format!("{guaranteed_n_m_s:.4}"), least_load(&capacities_n_m_s), String::new()];
    cells.truncate(columns);
    table.add_row(cells);
    for (capacity_n_m_s, stated_n_m_s) in PAPER_THRESHOLDS_N_M_S.into_iter().filter(|_| is_messenger) {
        let mut sets = sets.to_vec();
        sets.extend(names.iter().map(|name| (name.clone(), Value::Real(capacity_n_m_s))));
        let guaranteed_n_m_s = started(fmu, &sets)?.get_real("dump.guaranteedThreshold")?;
        table.add_row([
            format!("{capacity_n_m_s} each"),
            format!("{guaranteed_n_m_s:.4}"),
            least_load(&vec![capacity_n_m_s; count]),
            stated_n_m_s.to_string(),
        ]);
    }
    let mut thresholds = Vec::new();
    let mut greatest_n_m_s = 0.0_f64;
    for axis in 1..=3 {
        let threshold_n_m_s = instance.get_real(&format!("dump.threshold[{axis}]"))?;
        greatest_n_m_s = greatest_n_m_s.max(threshold_n_m_s);
        thresholds.push(terminal::short(threshold_n_m_s));
    }
    // Rounding of the axes does not count.
    let beyond = greatest_n_m_s > guaranteed_n_m_s * (1.0 + 1e-9);
    let verdict = if beyond { "more than these wheels guarantee" } else { "which these wheels guarantee" };
    Ok(format!(
        "Dump threshold the {count} wheels guarantee: whatever body components stay within it, none saturates\n\
         (0 unless they span all directions). By smallest norm, as the FMU shares momentum (dump.guaranteedThreshold),\n\
         and by the allocation whose greatest load is least, the most any sharing allows.\n\
         In use: dump.threshold = {} N.m.s, {verdict}.\n{}{table}",
        thresholds.join(", "),
        if is_messenger { "Paper 000's are MESSENGER's; it does not print the axes.\n" } else { "" }
    ))
}

/// Spin axes in the body frame, from how the wheels share a momentum at the start; `None` unless they span all directions.
///
/// By the smallest norm wheel k holds r_k . H, with r_k = G^-1 a_k and G = sum a a^T; so sum r r^T = G^-1, and a_k = G r_k.
fn axes_body(fmu: &Fmu, sets: &[(String, Value)], count: usize) -> Result<Option<Vec<Vector>>, Error> {
    // Small, so that nothing is dumped; the difference takes the body's own momentum out.
    const PROBE_N_M_S: f64 = 1e-3;
    let loads_n_m_s = |along: Option<usize>| -> Result<Vec<f64>, Error> {
        let mut sets = sets.to_vec();
        sets.extend((0..3).map(|axis| {
            let value = if along == Some(axis) { PROBE_N_M_S } else { 0.0 };
            (format!("start.momentum[{}]", axis + 1), Value::Real(value))
        }));
        let mut instance = started(fmu, &sets)?;
        (1..=count).map(|number| instance.get_real(&format!("wheel[{number}].momentum"))).collect()
    };
    let base = loads_n_m_s(None)?;
    let [x, y, z] = [loads_n_m_s(Some(0))?, loads_n_m_s(Some(1))?, loads_n_m_s(Some(2))?];
    let shares: Vec<Vector> = (0..count)
        .map(|wheel| [&x, &y, &z].map(|loads| (loads[wheel] - base[wheel]) / PROBE_N_M_S))
        .collect();
    let mut gram_inverse = [[0.0; 3]; 3];
    for share in &shares {
        for (row, component) in gram_inverse.iter_mut().zip(share) {
            for (cell, other) in row.iter_mut().zip(share) {
                *cell += component * other;
            }
        }
    }
    let [a, b, c] = gram_inverse;
    let determinant = dot(&a, &cross(&b, &c));
    let gram = [cross(&b, &c), cross(&c, &a), cross(&a, &b)].map(|row| row.map(|cell| cell / determinant));
    let axis = |share: &Vector| [dot(&gram[0], share), dot(&gram[1], share), dot(&gram[2], share)];
    Ok((determinant > 0.0).then(|| shares.iter().map(axis).collect()))
}

/// The greatest h such that some allocation holds every momentum with body components within -h .. +h; 0 without axes.
fn least_load_threshold_n_m_s(axes_body: &[Vector], capacities_n_m_s: &[f64]) -> f64 {
    let mut least_n_m_s = f64::INFINITY;
    for (first, a) in axes_body.iter().enumerate() {
        for b in &axes_body[first + 1..] {
            let normal = cross(a, b);
            let reach: f64 =
                axes_body.iter().zip(capacities_n_m_s).map(|(axis, c)| c * dot(axis, &normal).abs()).sum();
            let size: f64 = normal.iter().map(|component| component.abs()).sum();
            // Two parallel axes span no face.
            if size > 1e-9 {
                least_n_m_s = least_n_m_s.min(reach / size);
            }
        }
    }
    if least_n_m_s.is_finite() { least_n_m_s } else { 0.0 }
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
