//! Large slews under the plant's own controller: how they settle, a saturation that a dump ends, a wheel that fails.

use super::slew_figures::figure;
use super::slew_flight::{BodySample, Event, Plant, SLEW_S, Sample, Simulated, Slew, Wheel, WheelSample};
use crate::attitude::{Vector, greatest};
use crate::cells::row;
use crate::report::{Outcome, Run};

/// Angle of the slews where none is requested.
const ANGLE_DEG: f64 = 60.0;
/// Error of the attitude below which a slew is settled.
const SETTLED_DEG: f64 = 0.01;
/// An overshoot that counts as none, as a share of the angle.
const OVERSHOOT: f64 = 1e-3;
/// Share of their capacity that wheels near it hold at the start, assumed.
const NEARLY_FULL: f64 = 0.995;
/// When a dump ends the saturation, in s.
const DUMP_S: f64 = 900.0;

fn slews(angle_rad: f64) -> Vec<Slew> {
    let [x, y, z] = [Vector::x(), Vector::y(), Vector::z()];
    let slew = |label, axis, event, stop_s| Slew { label, axis, angle_rad, event, stop_s };
    vec![
        slew("about X", x, Event::None, None),
        slew("about Y", y, Event::None, None),
        slew("about Z", z, Event::None, None),
        slew("wheels full, dump", y, Event::Dumped(NEARLY_FULL, DUMP_S), Some(2400.0)),
        slew("wheels full, threshold", y, Event::Threshold(NEARLY_FULL, DUMP_S), Some(2400.0)),
        slew("wheel 2 fails", y, Event::Failed(2, 0.5), None),
    ]
}

/// What a flight shows, in the units that are printed.
struct Measures {
    /// From the command's jump until the error stays small, in s.
    settled_s: Option<f64>,
    ideal_s: f64,
    overshoot_deg: f64,
    across_deg: f64,
    rate_deg_s: f64,
    /// Greatest share of what a motor can give.
    torque: f64,
    /// Greatest share of what a wheel can hold.
    momentum: f64,
    /// First and last time at which a wheel was at its capacity, in s.
    full_s: Option<(f64, f64)>,
    /// Whether the torque requested was ever more than the wheels could give.
    is_torque_limited: bool,
    dumps: i32,
}

impl Measures {
    fn of(simulated: &Simulated) -> Self {
        let Simulated { slew, limits, samples } = simulated;
        let error_deg = |sample: &Sample| sample.left_rad.norm().to_degrees();
        let after = || samples.iter().filter(|sample| sample.body.time_s >= SLEW_S);
        let small_from =
            samples.iter().rposition(|sample| error_deg(sample) > SETTLED_DEG).map_or(0, |k| k + 1);
        let sense = slew.angle_rad.signum();
        let share = |of: fn(&WheelSample) -> f64, most: fn(&Wheel) -> f64| {
            let each = samples.iter().flat_map(|sample| sample.wheels.iter().zip(&limits.wheels));
            greatest(each.map(|(wheel, limit)| of(wheel) / most(limit)))
        };
        let is_full = |sample: &&Sample| sample.wheels.iter().any(|wheel| wheel.is_saturated);
        let full = || samples.iter().filter(is_full).map(|sample| sample.body.time_s);
        Self {
            settled_s: samples.get(small_from).map(|sample| sample.body.time_s - SLEW_S),
            ideal_s: limits.slew.least_s(slew.angle_rad.abs()),
            overshoot_deg: after()
                .map(|sample| -sense * sample.ahead_rad(slew))
                .fold(0.0, f64::max)
                .to_degrees(),
            across_deg: greatest(
                samples.iter().map(|sample| (sample.left_rad - slew.axis * sample.ahead_rad(slew)).norm()),
            )
            .to_degrees(),
            rate_deg_s: greatest(samples.iter().map(|sample| sample.body.rate_rad_s.dot(&slew.axis)))
                .to_degrees(),
            torque: share(|wheel| wheel.torque_n_m, |limit| limit.torque_n_m),
            momentum: share(|wheel| wheel.momentum_n_m_s, |limit| limit.capacity_n_m_s),
            full_s: full().next().zip(full().next_back()),
            is_torque_limited: samples.iter().any(|sample| sample.body.is_torque_limited),
            dumps: samples.last().map_or(0, |sample| sample.body.dumps),
        }
    }

    /// What became of the slew.
    fn verdict(&self, simulated: &Simulated) -> String {
        let Some(settled_s) = self.settled_s else { return "does not settle".to_owned() };
        let is_full = self.full_s.is_some();
        let ends_full =
            simulated.samples.last().is_some_and(|last| last.wheels.iter().any(|it| it.is_saturated));
        let prompt = settled_s <= 1.05 * self.ideal_s + 3.0 / simulated.limits.bandwidth_rad_s;
        let steady = self.overshoot_deg <= OVERSHOOT * simulated.slew.angle_rad.abs().to_degrees();
        let free = !is_full && !self.is_torque_limited;
        match simulated.slew.event {
            Event::None => match (free, steady, prompt) {
                (false, ..) => "saturates".to_owned(),
                (_, false, _) => "overshoots".to_owned(),
                (.., false) => "settles late".to_owned(),
                _ => "settles, not saturated".to_owned(),
            },
            Event::Dumped(_, at_s) | Event::Threshold(_, at_s) => {
                if !is_full || SLEW_S + settled_s < at_s {
                    "no saturation".to_owned()
                } else if ends_full || self.dumps != 1 {
                    "not recovered".to_owned()
                } else {
                    "flagged, recovered by a dump".to_owned()
                }
            }
            Event::Failed(wheel, _) => {
                let stands =
                    simulated.samples.last().is_some_and(|last| last.wheels[wheel - 1].torque_n_m == 0.0);
                match (stands, free) {
                    (true, true) => format!("survived with {} wheels", simulated.limits.wheels.len() - 1),
                    (true, false) => "saturates".to_owned(),
                    (false, _) => format!("wheel {wheel} still gives torque"),
                }
            }
        }
    }

    fn row(&self, simulated: &Simulated) -> Vec<String> {
        let seconds = |time_s: f64| format!("{time_s:.1}");
        vec![
            simulated.slew.label.to_owned(),
            format!("{:.1}", simulated.slew.angle_rad.to_degrees()),
            self.settled_s.map_or_else(|| "-".to_owned(), seconds),
            seconds(self.ideal_s),
            format!("{:.1e}", self.overshoot_deg),
            format!("{:.1e}", self.across_deg),
            format!("{:.4}", self.rate_deg_s),
            format!("{:.0} %", 100.0 * self.torque),
            format!("{:.0} %", 100.0 * self.momentum),
            self.full_s
                .map_or_else(|| "never".to_owned(), |(from_s, to_s)| format!("{from_s:.0} to {to_s:.0}")),
            self.verdict(simulated),
        ]
    }
}

const HEADER: &str = "\
    case | angle [deg] | settled [s] | by the limits [s] | overshoot [deg] | off the axis [deg] | \
    rate [deg/s] | torque | momentum | a wheel full [s] | verdict";

/// Slews about each axis, with full wheels and with a wheel that fails.
pub(crate) fn slew(run: &mut Run<'_>) -> Outcome {
    let slews = slews(run.options.angle_rad.unwrap_or(ANGLE_DEG.to_radians()));
    let cases = run.chosen(slews, |slew| slew.label.to_owned())?;
    let plant = Plant::open(run.options)?;
    let step_s = run.options.step_s;
    let simulated = run.all(&cases, |slew| plant.simulated(slew, step_s))?;
    run.line("Slews under the plant's own controller; the command jumps at 10 s\n");
    let rows: Vec<_> = simulated.iter().map(|simulated| Measures::of(simulated).row(simulated)).collect();
    run.table_and_csv("slew.csv", HEADER, rows)?;
    if let Some(Simulated { limits, .. }) = simulated.first() {
        run.line(&format!(
            "Limits: {:.4} deg/s and {:.5} deg/s2 (control.slewRate and control.slewAcceleration), wheels of {} N m and {} N m s.",
            limits.slew.rate_rad_s.to_degrees(),
            limits.slew.acceleration_rad_s2.to_degrees(),
            limits.wheels[0].torque_n_m,
            limits.wheels[0].capacity_n_m_s,
        ));
    }
    run.line(REMARK);
    history(run, &simulated)?;
    for simulated in &simulated {
        let file =
            format!("slew-{}.svg", simulated.slew.label.replace(", ", "-").replace(' ', "-").to_lowercase());
        run.picture(&file, &figure(simulated))?;
    }
    Ok(())
}

const REMARK: &str = "\
Settled: the true attitude stays within 0.01 deg of the command. By the limits: accelerate, coast and decelerate about the
slew's axis within both limits, in closed form. Torque and momentum: greatest share of what a wheel can give and hold.
Wheels full: each starts at 99.5 % of its capacity, assumed, in the sense that the slew adds to, with dumps off; at 900 s a
dump to zero is requested, or dump.threshold is put back. Wheel 2 fails at half of the slew's time by the limits. There is
no keep-in zone here: the slews about X and Z take the Sun off the shade.";

/// Every sample of every flight.
fn history(run: &mut Run<'_>, simulated: &[Simulated]) -> Outcome {
    let mut header = "\
        case | time_s | q1 | q2 | q3 | q4 | rate_x_rad_s | rate_y_rad_s | rate_z_rad_s | \
        left_x_rad | left_y_rad | left_z_rad | momentum_x_n_m_s | momentum_y_n_m_s | momentum_z_n_m_s | \
        torque_limited | dumping | dumps"
        .to_owned();
    let wheels = simulated.first().map_or(0, |simulated| simulated.limits.wheels.len());
    for k in 1..=wheels {
        header += &format!(" | wheel{k}_torque_n_m | wheel{k}_momentum_n_m_s | wheel{k}_full");
    }
    let rows = simulated.iter().flat_map(|Simulated { slew, samples, .. }| {
        samples.iter().map(|sample| {
            let BodySample { time_s, q, rate_rad_s, momentum_n_m_s, .. } = sample.body;
            let BodySample { is_torque_limited, is_dumping, dumps, .. } = sample.body;
            let body = row![slew.label, time_s, q, rate_rad_s, sample.left_rad, momentum_n_m_s];
            let wheels = sample
                .wheels
                .iter()
                .flat_map(|wheel| row![wheel.torque_n_m, wheel.momentum_n_m_s, wheel.is_saturated]);
            [body, row![is_torque_limited, is_dumping, dumps], wheels.collect()].concat()
        })
    });
    run.csv("slew-history.csv", &header, rows)
}
