//! Dumps by pulses in controlled flight beside the impulse of the same dump: what is left over, what it takes, how the attitude
//! stands it.

use loader::Fmu;
use nalgebra::Vector4;

use crate::StudyError;
use crate::attitude::Vector;
use crate::case::{Case, recorded};
use crate::report::{Outcome, Run};
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
    controlled: Vec<DumpSample>,
    ideal: DumpSample,
}

recorded! {
    /// What is kept of a point.
    struct DumpSample {
        @time_s,
        momentum_n_m_s: Vector = "momentum.body",
        impulse_n_m_s: Vector = "dump.impulse",
        delta_v_m_s: Vector = "dump.deltaV",
        used_kg: f64 = "propellant.used",
        error_rad: f64 = "control.error",
        is_active: bool = "dump.active",
        wheels_n_m: Vector4<f64> = "wheel[1].torque" "wheel[2].torque" "wheel[3].torque" "wheel[4].torque",
    }
}

impl Dump {
    /// In the dark, so that nothing but the dump moves the momentum, in an attitude that is held.
    fn case(&self, source: &str) -> Case {
        let case = Case::new(self.label, SPAN_S, STEP_S)
            .set("attitude.source", source)
            .set("command.source", "inputs")
            .set("command.kind", "none")
            .set("solar.flux", 0.0)
            .set("gravityGradient.enabled", false)
            .set("dump.request", true)
            .set("dump.target", self.target_n_m_s);
        let Some((name, value)) = self.each else { return case };
        THRUSTERS.fold(case, |case, k| case.set(&format!("thruster[{k}].{name}"), value))
    }
}

fn simulated(fmu: &Fmu, dump: &Dump) -> Result<Simulated, StudyError> {
    let [one, two] = HELD_N_M_S;
    let controlled = dump.case("controlled").set("wheel[1].startMomentum", one);
    let controlled = controlled.set("wheel[2].startMomentum", two).simulate(fmu, DumpSample::NAMES)?;
    let controlled: Vec<DumpSample> = controlled.all(0);
    let ideal = dump.case("commanded").set("start.momentum", controlled[0].momentum_n_m_s);
    let ideal = ideal.grid(10.0, 1.0).simulate(fmu, DumpSample::NAMES)?.last_row().read();
    Ok(Simulated { dump: dump.clone(), controlled, ideal })
}

impl Simulated {
    fn duration_s(&self) -> f64 {
        let active = self.controlled.iter().filter(|sample| sample.is_active);
        active.map(|sample| sample.time_s).fold(0.0, f64::max)
    }

    fn row(&self) -> Vec<String> {
        let Self { dump, controlled, ideal } = self;
        let last = &controlled[controlled.len() - 1];
        let left = last.momentum_n_m_s - dump.target_n_m_s;
        let apart = last.impulse_n_m_s - ideal.impulse_n_m_s;
        let most = |of: fn(&DumpSample) -> f64| controlled.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        vec![
            dump.label.to_owned(),
            format!("{:.3}", ideal.impulse_n_m_s.norm()),
            format!("{:.1}", 1e3 * left.norm()),
            format!("{:.1}", 1e3 * apart.norm()),
            format!("{:.0}", self.duration_s()),
            format!("{:.2}", 1e3 * last.used_kg),
            format!("{:.2}", 1e3 * ideal.used_kg),
            format!("{:.2}", 1e3 * last.delta_v_m_s.norm()),
            format!("{:.2}", 1e3 * ideal.delta_v_m_s.norm()),
            format!("{:.3}", most(|sample| sample.error_rad).to_degrees()),
            format!("{:.3}", most(|sample| sample.wheels_n_m.amax())),
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
pub(crate) fn dump(run: &mut Run<'_>) -> Outcome {
    let cases = run.chosen(dumps(), |dump| dump.label.to_owned())?;
    let fmu = run.options.fmu("MessengerFull.fmu")?;
    let simulated = run.all(&cases, |dump| simulated(&fmu, dump))?;
    run.line("Dumps of the controlled spacecraft by pulses of its 4.4 N thrusters\n");
    let rows: Vec<_> = simulated.iter().map(Simulated::row).collect();
    run.table_and_csv("dump.csv", HEADER, rows)?;
    run.line(REMARK);
    for simulated in &simulated {
        let name = simulated.dump.label.replace(" %", "").replace(' ', "-");
        run.picture(&format!("dump-{name}.svg"), &figure(simulated))?;
    }
    Ok(())
}

/// The dump over time, until a while after its end.
fn figure(simulated: &Simulated) -> Chart {
    let end_s = simulated.duration_s() + 60.0;
    let line = |label: &str, value: &dyn Fn(&DumpSample) -> f64| {
        let shown = simulated.controlled.iter().filter(|sample| sample.time_s <= end_s);
        Series::line(label, shown.map(|sample| (sample.time_s, value(sample))).collect())
    };
    let components =
        |of: fn(&DumpSample) -> Vector| [0, 1, 2].map(|i| line(["x", "y", "z"][i], &|sample| of(sample)[i]));
    let wheels = (0..4).map(|k| line(&format!("wheel {}", k + 1), &|sample| sample.wheels_n_m[k]));
    Chart::new(format!("Dump by pulses: {}", simulated.dump.label), "time [s]").with([
        Panel::new("momentum [N m s]")
            .marks("target", simulated.dump.target_n_m_s.as_slice().to_vec())
            .with(components(|sample| sample.momentum_n_m_s)),
        Panel::new("wheel torque [N m]").with(wheels),
        Panel::new("error [deg]")
            .with([line("attitude from the one commanded", &|sample| sample.error_rad.to_degrees())]),
        Panel::new("delta-v [mm/s]").with(components(|sample| sample.delta_v_m_s * 1e3)),
    ])
}
