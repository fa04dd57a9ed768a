//! The whole spacecraft in sunlight: force and torque over the sphere of Sun directions, and its momentum within the keep-in zone
//! against that of shade and panels alone, surface by surface.

use loader::Fmu;
use model_description::labels;

use super::sphere::{self, Lit};
use crate::StudyError;
use crate::attitude::Vector;
use crate::case::{Case, recorded};
use crate::cells::row;
use crate::report::{Outcome, Run};
use drawing::{Chart, Panel, Series};

const DAY_S: f64 = 86_400.0;
const STOP_S: f64 = 10.0 * DAY_S;
const STEP_S: f64 = 600.0;
/// No dump: above all that gathers.
const THRESHOLD_N_M_S: f64 = 1000.0;
/// What is less than this is light at grazing rounding, in N s.
const MIN_N_S: f64 = 1e-6;
/// Surfaces that messenger.toml has as well; their backs it has not.
const KNOWN: [&str; 10] = [
    "side +X",
    "side -X",
    "slant +X",
    "slant -X",
    "front",
    "top slant -X",
    "top slant +X",
    "top front",
    "+X",
    "-X",
];

recorded! {
    /// The whole spacecraft at one point.
    struct OffSunSample {
        @time_s,
        momentum_n_m_s: Vector = "momentum.inertial",
        force_n: Vector = "force.solar",
        sun_rad: [f64; 2] = "sun.azimuth" "sun.elevation",
    }
}

/// Ten days of guided flight.
struct Simulated {
    /// Names of the surfaces that are reported one by one.
    surfaces: Vec<String>,
    /// Every point, with the force on each of these surfaces.
    samples: Vec<(OffSunSample, Vec<Vector>)>,
}

impl Simulated {
    fn last_momentum_n_m_s(&self) -> Vector {
        self.samples.last().map_or(Vector::repeat(f64::NAN), |(sample, _)| sample.momentum_n_m_s)
    }

    /// Of the force of all, in N s.
    fn impulse_n_s(&self) -> Vector {
        impulse(&self.samples.iter().map(|(sample, _)| sample.force_n).collect::<Vec<_>>())
    }
}

/// Study `momentum/off-sun`.
pub(crate) fn off_sun(run: &mut Run<'_>) -> Outcome {
    let sphere = sphere::map(&run.options.fmu("MessengerLight.fmu")?)?;
    let few = simulated(&run.options.fmu("MomentumPlant.fmu")?, "shade and panels")?;
    let whole = simulated(&run.options.fmu("MessengerFull.fmu")?, "whole")?;
    run.line("Sunlight on the whole MESSENGER (messenger-full.toml), its surfaces shadowing one another\n");
    over_the_sphere(run, &sphere)?;
    within_the_zone(run, &few, &whole)
}

fn over_the_sphere(run: &mut Run<'_>, sphere: &[Lit]) -> Outcome {
    let force = sphere::picture("Force of sunlight at 0.387 AU", "uN", sphere, |lit| lit.force_n * 1e6);
    run.picture("off-sun-force.svg", &force)?;
    let torque =
        sphere::picture("Torque of sunlight at 0.387 AU", "uN.m", sphere, |lit| lit.torque_n_m * 1e6);
    run.picture("off-sun-torque.svg", &torque)?;
    let rows = sphere.iter().map(|lit| row![lit.azimuth_deg, lit.elevation_deg, lit.force_n, lit.torque_n_m]);
    let header = "\
        sun_azimuth_deg | sun_elevation_deg | force_x_n | force_y_n | force_z_n | torque_x_n_m | \
        torque_y_n_m | torque_z_n_m";
    run.csv("off-sun.csv", header, rows)?;
    let most = |what: &str, unit: &str, size: fn(&Lit) -> f64| {
        let at = sphere.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
        at.map_or(Vec::new(), |lit| {
            let ahead = sphere
                .iter()
                .find(|lit| lit.azimuth_deg == 0.0 && lit.elevation_deg == 0.0)
                .map_or(0.0, size);
            vec![
                what.to_owned(),
                format!("{:.1} {unit}", ahead * 1e6),
                format!("{:.1} {unit}", size(lit) * 1e6),
                format!("{:.0} / {:.0}", lit.azimuth_deg, lit.elevation_deg),
            ]
        })
    };
    let rows =
        [most("force", "uN", |lit| lit.force_n.norm()), most("torque", "uN.m", |lit| lit.torque_n_m.norm())];
    run.table("at 0.387 AU | Sun on -Y | greatest | there azimuth / elevation [deg]", &rows);
    run.line("The panels stand where cells are 65 deg off a Sun on -Y.\n");
    Ok(())
}

fn within_the_zone(run: &mut Run<'_>, few: &Simulated, whole: &Simulated) -> Outcome {
    let shown = |what: &str, v: Vector| -> Vec<String> {
        [what.to_owned()].into_iter().chain(v.iter().map(|x| format!("{x:.6}"))).collect()
    };
    let [of_few, of_whole] = [few, whole].map(Simulated::last_momentum_n_m_s);
    let gap = of_whole - of_few;
    let rows = [shown("shade and panels", of_few), shown("whole", of_whole), shown("difference", gap)];
    run.line("Inertial momentum after 10 days in the keep-in zone, guided, without dumps [N.m.s]\n");
    run.table("spacecraft | X | Y | Z", &rows);
    let angles_deg = |axis: usize| whole.samples.iter().map(move |(it, _)| it.sun_rad[axis].to_degrees());
    let widest = |axis: usize| angles_deg(axis).map(f64::abs).fold(0.0, f64::max);
    run.line(&format!(
        "The Sun was up to {:.1} deg in azimuth and {:.1} deg in elevation off -Y.\n",
        widest(0),
        widest(1)
    ));

    let difference_n_s = whole.impulse_n_s() - few.impulse_n_s();
    let (mut rows, mut explained) = (Vec::new(), -few.impulse_n_s());
    let mut seen: Vec<&str> = Vec::new();
    for (k, name) in whole.surfaces.iter().enumerate() {
        let force_n: Vec<Vector> = whole.samples.iter().map(|(_, surfaces)| surfaces[k]).collect();
        let total = impulse(&force_n);
        explained += total;
        let is_known = KNOWN.contains(&name.as_str()) && !seen.contains(&name.as_str());
        seen.push(name);
        let lit = force_n.iter().filter(|force| force.norm() > 0.0).count();
        if total.norm() > MIN_N_S && !is_known {
            let share = format!("{:.1} %", 100.0 * lit as f64 / force_n.len().max(1) as f64);
            rows.push(row![shown(name, total), share.as_str()]);
        }
    }
    run.line("Sunlight's impulse, body frame, on surfaces that shade and panels alone do not have [N.s]\n");
    if rows.is_empty() {
        run.line("none of them is lit");
    } else {
        run.table("surface | X | Y | Z | of the time lit", &rows);
    }
    let left = (explained - difference_n_s).norm();
    run.line(&format!(
        "All surfaces of the whole less shade and panels: {:.6} N.s; what both flights differ by: {:.6} N.s; apart {:.1e} of it.",
        explained.norm(),
        difference_n_s.norm(),
        left / difference_n_s.norm().max(f64::MIN_POSITIVE)
    ));
    run.line(REMARK);
    let header =
        "time_d | few_x_n_m_s | few_y_n_m_s | few_z_n_m_s | whole_x_n_m_s | whole_y_n_m_s | whole_z_n_m_s";
    let rows = few
        .samples
        .iter()
        .zip(&whole.samples)
        .map(|((few, _), (whole, _))| row![few.time_s / DAY_S, few.momentum_n_m_s, whole.momentum_n_m_s]);
    run.csv("off-sun-momentum.csv", header, rows)?;
    let days = |(sample, _): &(OffSunSample, Vec<Vector>)| sample.time_s / DAY_S;
    let lines = |of: &dyn Fn(usize) -> Vector| {
        [0, 1, 2].map(|axis| {
            let points = whole.samples.iter().enumerate().map(|(k, it)| (days(it), of(k)[axis]));
            Series::line(["X", "Y", "Z"][axis], points.collect())
        })
    };
    let momentum = |simulated: &Simulated, k: usize| {
        simulated.samples.get(k).map_or(Vector::repeat(f64::NAN), |(it, _)| it.momentum_n_m_s)
    };
    // The two lie on each other: their difference shows what they do not share.
    let difference = |k: usize| 1e3 * (momentum(whole, k) - momentum(few, k));
    let chart = Chart::new("Inertial momentum within the keep-in zone", "time [d]").with([
        Panel::new("momentum [N.m.s]").titled("the whole spacecraft").with(lines(&|k| momentum(whole, k))),
        Panel::new("momentum [mN.m.s]").titled("the whole less shade and panels").with(lines(&difference)),
    ]);
    run.picture("off-sun-momentum.svg", &chart)
}

const REMARK: &str = "\
Guidance keeps the Sun at no azimuth, where the shade keeps bus and boom dark: what is lit beyond shade and cells is the bell,
through the slit of 6 mm that the printed heights leave between the shade and its top. A strip of the bus' sides would be lit
from 10.5 deg of azimuth on.";

fn simulated(fmu: &Fmu, label: &str) -> Result<Simulated, StudyError> {
    let surfaces = surfaces(fmu);
    let forces = (1..=surfaces.len()).map(|number| format!("plate[{number}].force"));
    let names: Vec<String> =
        OffSunSample::NAMES.iter().map(|name| (*name).to_owned()).chain(forces).collect();
    let recorded = Case::new(label, STOP_S, STEP_S)
        .set("attitude.source", "guided")
        .set("gravityGradient.enabled", false)
        .set("momentum.convention", "inertial")
        .set("dump.threshold", [THRESHOLD_N_M_S; 3])
        .simulate(fmu, &names)?;
    Ok(Simulated { surfaces, samples: recorded.all(0) })
}

/// Names of the surfaces that are reported one by one.
fn surfaces(fmu: &Fmu) -> Vec<String> {
    let labels = labels::of_groups(fmu.description());
    let label = |number: usize| labels.get(format!("plate[{number}]").as_str()).copied();
    (1..).map_while(label).map(str::to_owned).collect()
}

/// Sum of forces at equal steps, by the trapezoid rule, in N s.
fn impulse(force_n: &[Vector]) -> Vector {
    let ends = force_n.first().zip(force_n.last()).map_or(Vector::zeros(), |(first, last)| first + last);
    (force_n.iter().sum::<Vector>() - ends * 0.5) * STEP_S
}
