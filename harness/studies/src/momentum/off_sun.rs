//! The whole spacecraft in sunlight: force and torque over the sphere of Sun directions, and its momentum within the keep-in zone
//! against that of shade and panels alone, surface by surface.

use loader::Fmu;
use model_description::labels;

use super::sphere::{self, Lit};
use crate::attitude::Vector;
use crate::case::Case;
use crate::settings::cells;
use crate::{Options, Report, StudyError};
use drawing::{Chart, Panel, Series};

const DAY_S: f64 = 86_400.0;
const STOP_S: f64 = 10.0 * DAY_S;
const STEP_S: f64 = 600.0;
/// No dump: above all that gathers.
const THRESHOLD_N_M_S: f64 = 1000.0;
/// What is less than this is light at grazing rounding, in N s.
const LEAST_N_S: f64 = 1e-6;
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

/// Ten days of guided flight.
struct Simulated {
    times_d: Vec<f64>,
    momentum_n_m_s: Vec<Vector>,
    force_n: Vec<Vector>,
    angles_deg: Vec<[f64; 2]>,
    /// Of every surface reported, its name and its force.
    surfaces: Vec<(String, Vec<Vector>)>,
}

/// Study `momentum/off-sun`.
pub fn off_sun(options: &Options) -> Result<Report, StudyError> {
    let sphere = sphere::map(&options.fmu("MessengerLight.fmu")?)?;
    let few = fly(&options.fmu("MomentumPlant.fmu")?, "shade and panels")?;
    let whole = fly(&options.fmu("MessengerFull.fmu")?, "whole")?;
    let mut report = Report::default();
    report
        .line("Sunlight on the whole MESSENGER (messenger-full.toml), its surfaces shadowing one another\n");
    over_the_sphere(&mut report, options, &sphere)?;
    within_the_zone(&mut report, options, &few, &whole)?;
    Ok(report)
}

fn over_the_sphere(report: &mut Report, options: &Options, sphere: &[Lit]) -> Result<(), StudyError> {
    let force = sphere::picture("Force of sunlight at 0.387 AU", "uN", sphere, |lit| lit.force_n * 1e6);
    report.picture(options, "off-sun-force.svg", &force)?;
    let torque =
        sphere::picture("Torque of sunlight at 0.387 AU", "uN.m", sphere, |lit| lit.torque_n_m * 1e6);
    report.picture(options, "off-sun-torque.svg", &torque)?;
    let rows = sphere.iter().map(|lit| {
        let at = [lit.azimuth_deg, lit.elevation_deg];
        cells(&[&at, lit.force_n.as_slice(), lit.torque_n_m.as_slice()])
    });
    let header = "\
        sun_azimuth_deg | sun_elevation_deg | force_x_n | force_y_n | force_z_n | torque_x_n_m | \
        torque_y_n_m | torque_z_n_m";
    report.csv(options, "off-sun.csv", header, rows)?;
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
    report.table("at 0.387 AU | Sun on -Y | greatest | there azimuth / elevation [deg]", &rows);
    report.line("The panels stand where cells are 65 deg off a Sun on -Y.\n");
    Ok(())
}

fn within_the_zone(
    report: &mut Report,
    options: &Options,
    few: &Simulated,
    whole: &Simulated,
) -> Result<(), StudyError> {
    let last =
        |simulated: &Simulated| simulated.momentum_n_m_s.last().copied().unwrap_or(Vector::repeat(f64::NAN));
    let row = |what: &str, v: &Vector| {
        let mut cells = vec![what.to_owned()];
        cells.extend(v.iter().map(|x| format!("{x:.6}")));
        cells
    };
    let gap = last(whole) - last(few);
    let rows = [row("shade and panels", &last(few)), row("whole", &last(whole)), row("difference", &gap)];
    report.line("Inertial momentum after 10 days in the keep-in zone, guided, without dumps [N.m.s]\n");
    report.table("spacecraft | X | Y | Z", &rows);
    let widest = |axis: usize| whole.angles_deg.iter().map(|at| at[axis].abs()).fold(0.0, f64::max);
    report.line(&format!(
        "The Sun was up to {:.1} deg in azimuth and {:.1} deg in elevation off -Y.\n",
        widest(0),
        widest(1)
    ));

    let difference_n_s = impulse(&whole.force_n) - impulse(&few.force_n);
    let (mut rows, mut explained) = (Vec::new(), -impulse(&few.force_n));
    let mut seen: Vec<&str> = Vec::new();
    for (name, force_n) in &whole.surfaces {
        let total = impulse(force_n);
        explained += total;
        let is_known = KNOWN.contains(&name.as_str()) && !seen.contains(&name.as_str());
        seen.push(name);
        let lit = force_n.iter().filter(|force| force.norm() > 0.0).count();
        if total.norm() > LEAST_N_S && !is_known {
            let mut cells = row(name, &total);
            cells.push(format!("{:.1} %", 100.0 * lit as f64 / force_n.len().max(1) as f64));
            rows.push(cells);
        }
    }
    report
        .line("Sunlight's impulse, body frame, on surfaces that shade and panels alone do not have [N.s]\n");
    if rows.is_empty() {
        report.line("none of them is lit");
    } else {
        report.table("surface | X | Y | Z | of the time lit", &rows);
    }
    let left = (explained - difference_n_s).norm();
    report.line(&format!(
        "All surfaces of the whole less shade and panels: {:.6} N.s; what both flights differ by: {:.6} N.s; apart {:.1e} of it.",
        explained.norm(),
        difference_n_s.norm(),
        left / difference_n_s.norm().max(f64::MIN_POSITIVE)
    ));
    report.line(REMARK);
    let header =
        "time_d | few_x_n_m_s | few_y_n_m_s | few_z_n_m_s | whole_x_n_m_s | whole_y_n_m_s | whole_z_n_m_s";
    let rows = few
        .times_d
        .iter()
        .zip(few.momentum_n_m_s.iter().zip(&whole.momentum_n_m_s))
        .map(|(time_d, (few, whole))| cells(&[&[*time_d], few.as_slice(), whole.as_slice()]));
    report.csv(options, "off-sun-momentum.csv", header, rows)?;
    let points = |simulated: &Simulated, axis: usize| -> Vec<(f64, f64)> {
        simulated.times_d.iter().zip(&simulated.momentum_n_m_s).map(|(t, h)| (*t, h[axis])).collect()
    };
    let chart =
        Chart::new("Inertial momentum within the keep-in zone", "time [d]").with((0..3).map(|axis| {
            Panel::new(format!("H_{} [N.m.s]", ["x", "y", "z"][axis])).with([
                Series::line("shade and panels", points(few, axis)),
                Series::line("whole", points(whole, axis)),
            ])
        }));
    report.picture(options, "off-sun-momentum.svg", &chart)
}

const REMARK: &str = "\
Guidance keeps the Sun at no azimuth, where the shade keeps bus and boom dark: what is lit beyond shade and cells is the bell,
through the slit of 6 mm that the printed heights leave between the shade and its top. A strip of the bus' sides would be lit
from 10.5 deg of azimuth on.";

fn fly(fmu: &Fmu, label: &str) -> Result<Simulated, StudyError> {
    let body = ["momentum.inertial", "force.solar", "sun.azimuth", "sun.elevation"];
    let mut names = body.map(str::to_owned).to_vec();
    let surfaces = surfaces(fmu);
    names.extend((1..=surfaces.len()).map(|number| format!("plate[{number}].force")));
    let recorded = Case::new(label, STOP_S, STEP_S)
        .item("attitude.source", "guided")
        .boolean("gravityGradient.enabled", false)
        .item("momentum.convention", "inertial")
        .elements("dump.threshold", [THRESHOLD_N_M_S; 3])
        .simulate(fmu, &names)?;
    let angles = recorded.columns[6].iter().zip(&recorded.columns[7]);
    Ok(Simulated {
        times_d: recorded.times_s.iter().map(|time_s| time_s / DAY_S).collect(),
        momentum_n_m_s: recorded.vectors(0),
        force_n: recorded.vectors(3),
        angles_deg: angles.map(|(a, e)| [a.to_degrees(), e.to_degrees()]).collect(),
        surfaces: surfaces
            .into_iter()
            .enumerate()
            .map(|(k, name)| (name, recorded.vectors(8 + 3 * k)))
            .collect(),
    })
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
