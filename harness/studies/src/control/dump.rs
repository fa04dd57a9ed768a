//! Dumps by pulses in controlled flight beside the impulse of the same dump: what is left over, what it takes, how the attitude
//! stands it.

use crate::attitude::Vector;
use crate::case::{Case, Recorded, chosen, run_all};
use crate::{Options, Report, StudyError};
use drawing::{Chart, Panel, Series};

/// How long is simulated, and in which steps, in s.
const SPAN_S: f64 = 600.0;
const STEP_S: f64 = 0.25;
/// Momentum of wheels 1 and 2 at the start, in N m s, assumed.
const HELD_N_M_S: [f64; 2] = [3.0, -1.5];

/// One dump.
#[derive(Clone, Debug)]
struct Dump {
    label: &'static str,
    target_n_m_s: Vector,
    /// Set for every thruster of the attitude: name and value.
    each: Option<(&'static str, f64)>,
}

/// Thrusters whose pulses dump: A1 to B4, S1 to P2.
const THRUSTERS: core::ops::RangeInclusive<usize> = 6..=17;

fn dumps() -> Vec<Dump> {
    let dump = |label, target: [f64; 3], each| Dump { label, target_n_m_s: target.into(), each };
    vec![
        dump("to zero", [0.0; 3], None),
        dump("biased", [0.4, -0.3, 0.2], None),
        dump("no scatter", [0.0; 3], Some(("scatter", 0.0))),
        dump("scatter 10 %", [0.0; 3], Some(("scatter", 0.1))),
        dump("shortest pulse 100 ms", [0.0; 3], Some(("minOnTime", 0.1))),
    ]
}

/// A dump in controlled flight and as an impulse.
struct Simulated {
    dump: Dump,
    controlled: Recorded,
    ideal: Recorded,
}

const OUTPUTS: [&str; 10] = [
    "momentum.body",
    "dump.impulse",
    "dump.deltaV",
    "propellant.used",
    "control.error",
    "dump.active",
    "wheel[1].torque",
    "wheel[2].torque",
    "wheel[3].torque",
    "wheel[4].torque",
];
const MOMENTUM: usize = 0;
const IMPULSE: usize = 3;
const DELTA_V: usize = 6;
const USED: usize = 9;
const ERROR: usize = 10;
const ACTIVE: usize = 11;
const WHEELS: core::ops::Range<usize> = 12..16;

fn last(recorded: &Recorded, first: usize) -> Vector {
    recorded.row(recorded.times_s.len() - 1, first).vector()
}

impl Dump {
    /// In the dark, so that nothing but the dump moves the momentum, in an attitude that is held.
    fn case(&self, source: &str) -> Case {
        let case = Case::new(self.label, SPAN_S, STEP_S)
            .item("attitude.source", source)
            .item("command.source", "inputs")
            .item("command.kind", "none")
            .real("solar.flux", 0.0)
            .boolean("gravityGradient.enabled", false)
            .boolean("dump.request", true)
            .elements("dump.target", self.target_n_m_s.iter().copied());
        let Some((name, value)) = self.each else { return case };
        THRUSTERS.fold(case, |case, k| case.real(&format!("thruster[{k}].{name}"), value))
    }
}

fn fly(options: &Options, dump: &Dump) -> Result<Simulated, StudyError> {
    let fmu = options.fmu("MessengerFull.fmu")?;
    let [one, two] = HELD_N_M_S;
    let controlled = dump.case("controlled").real("wheel[1].startMomentum", one);
    let controlled = controlled.real("wheel[2].startMomentum", two).simulate(&fmu, &OUTPUTS)?;
    let before: Vector = controlled.row(0, MOMENTUM).vector();
    let ideal = dump.case("commanded").elements("start.momentum", before.iter().copied());
    let ideal = ideal.grid(10.0, 1.0).simulate(&fmu, &OUTPUTS)?;
    Ok(Simulated { dump: dump.clone(), controlled, ideal })
}

impl Simulated {
    fn duration_s(&self) -> f64 {
        let active = self.controlled.times_s.iter().zip(&self.controlled.columns[ACTIVE]);
        active.filter(|(_, is_active)| **is_active != 0.0).map(|(time_s, _)| *time_s).fold(0.0, f64::max)
    }

    fn row(&self) -> Vec<String> {
        let Self { dump, controlled, ideal } = self;
        let left = last(controlled, MOMENTUM) - dump.target_n_m_s;
        let apart = last(controlled, IMPULSE) - last(ideal, IMPULSE);
        let torque =
            WHEELS.map(|k| controlled.columns[k].iter().fold(0.0_f64, |most, it| most.max(it.abs())));
        vec![
            dump.label.to_owned(),
            format!("{:.3}", last(ideal, IMPULSE).norm()),
            format!("{:.1}", 1e3 * left.norm()),
            format!("{:.1}", 1e3 * apart.norm()),
            format!("{:.0}", self.duration_s()),
            format!("{:.2}", 1e3 * controlled.last(USED)),
            format!("{:.2}", 1e3 * ideal.last(USED)),
            format!("{:.2}", 1e3 * last(controlled, DELTA_V).norm()),
            format!("{:.2}", 1e3 * last(ideal, DELTA_V).norm()),
            format!("{:.3}", controlled.most(ERROR).to_degrees()),
            format!("{:.3}", torque.fold(0.0, f64::max)),
        ]
    }
}

const HEADER: &str = "\
    case | impulse [N m s] | left over [mN m s] | apart [mN m s] | lasts [s] | propellant [g] | \
    impulsive [g] | delta-v [mm/s] | impulsive [mm/s] | attitude [deg] | wheel torque [N m]";

const REMARK: &str = "\
Impulse: of the same dump at once, in commanded flight. Left over: between the momentum after the pulses and the target; the
smallest pulse of a 4.4 N thruster is 20 ms, about 70 mN m s. Apart: between the impulse of the pulses and the one at once.
Attitude: greatest error while the wheels take up the pulses. In the dark, the wheels holding 3 and -1.5 N m s at the start,
assumed; the thrusters' layout is assumed too (messenger-full.toml).";

/// Dumps by pulses beside dumps at once.
pub fn dump(options: &Options) -> Result<Report, StudyError> {
    let cases = chosen("control/dump", options, dumps(), |dump| dump.label.to_owned())?;
    let simulated = run_all(options, &cases, |dump| fly(options, dump))?;
    let mut report = Report::default();
    report.line("Dumps of the controlled spacecraft by pulses of its 4.4 N thrusters\n");
    let rows: Vec<_> = simulated.iter().map(Simulated::row).collect();
    report.table(HEADER, &rows);
    report.line(REMARK);
    report.csv(options, "dump.csv", HEADER, rows)?;
    for simulated in &simulated {
        let name = simulated.dump.label.replace(" %", "").replace(' ', "-");
        report.picture(options, &format!("dump-{name}.svg"), &figure(simulated))?;
    }
    Ok(report)
}

/// The dump over time, until a while after its end.
fn figure(simulated: &Simulated) -> Chart {
    let recorded = &simulated.controlled;
    let end_s = simulated.duration_s() + 60.0;
    let line = |label: &str, value: &dyn Fn(usize) -> f64| {
        let rows = recorded.times_s.iter().enumerate().filter(|(_, time_s)| **time_s <= end_s);
        Series::line(label, rows.map(|(row, time_s)| (*time_s, value(row))).collect())
    };
    let components = |first: usize, scale: f64| -> Vec<Series> {
        let component = |i: usize| line(["x", "y", "z"][i], &|row| scale * recorded.columns[first + i][row]);
        (0..3).map(component).collect()
    };
    Chart::new(format!("Dump by pulses: {}", simulated.dump.label), "time [s]").with([
        Panel::new("momentum [N m s]")
            .marks("target", simulated.dump.target_n_m_s.as_slice().to_vec())
            .with(components(MOMENTUM, 1.0)),
        Panel::new("wheel torque [N m]").with(
            WHEELS.map(|k| line(&format!("wheel {}", k - WHEELS.start + 1), &|row| recorded.columns[k][row])),
        ),
        Panel::new("error [deg]").with([line("attitude from the one commanded", &|row| {
            recorded.columns[ERROR][row].to_degrees()
        })]),
        Panel::new("delta-v [mm/s]").with(components(DELTA_V, 1e3)),
    ])
}
