//! Pictures of slews: error angle, rate, torques and momenta of the wheels over time, with their limits.

use super::slew_flight::{Event, SLEW_S, Sample, Simulated, Wheel};
use drawing::{Chart, Panel, Series};

/// A slew over time.
pub(super) fn figure(simulated: &Simulated) -> Chart {
    let Simulated { slew, limits, samples } = simulated;
    let line = |label: &str, value: &dyn Fn(&Sample) -> f64| {
        Series::line(label, samples.iter().map(|sample| (sample.body.time_s, value(sample))).collect())
    };
    let wheels = |value: &dyn Fn(&Sample, usize) -> f64| -> Vec<Series> {
        (0..limits.wheels.len())
            .map(|k| line(&format!("wheel {}", k + 1), &|sample| value(sample, k)))
            .collect()
    };
    let either_way = |limit: f64| vec![-limit, limit];
    let sense = slew.angle_rad.signum();
    let limit = sense * limits.slew.rate_rad_s.to_degrees();
    let least = |of: fn(&Wheel) -> f64| limits.wheels.iter().map(of).fold(f64::INFINITY, f64::min);
    let [torque_n_m, capacity_n_m_s] = [least(|wheel| wheel.torque_n_m), least(|wheel| wheel.capacity_n_m_s)];
    let mut panels = vec![
        Panel::new("error [deg]").with([line("angle from the attitude commanded at 10 s", &|sample| {
            sample.left_rad.norm().to_degrees()
        })]),
        Panel::new("rate [deg/s]").with([
            line("about the slew's axis", &|sample| sample.body.rate_rad_s.dot(&slew.axis).to_degrees()),
            dashed("control.slewRate", limit, samples),
        ]),
        Panel::new("torque [N m]")
            .range(-1.15 * torque_n_m, 1.15 * torque_n_m)
            .marks("largest", either_way(torque_n_m))
            .with(wheels(&|sample, k| sample.wheels[k].torque_n_m)),
        Panel::new("momentum [N m s]")
            .range(-1.15 * capacity_n_m_s, 1.15 * capacity_n_m_s)
            .marks("capacity", either_way(capacity_n_m_s))
            .with(wheels(&|sample, k| sample.wheels[k].momentum_n_m_s)),
    ];
    if matches!(slew.event, Event::Dumped(..) | Event::Threshold(..)) {
        let full = |sample: &Sample| sample.wheels.iter().filter(|wheel| wheel.is_saturated).count() as f64;
        panels.push(Panel::new("number").range(-0.3, limits.wheels.len() as f64 + 0.3).whole().with([
            line("wheels at capacity", &full),
            line("dump active", &|sample| f64::from(u8::from(sample.body.is_dumping))),
        ]));
    }
    Chart::new(format!("Slew by {:.0} deg: {}", slew.angle_rad.to_degrees(), slew.label), "time [s]")
        .with(panels)
}

/// A limit from the slew's begin on.
fn dashed(label: &str, value: f64, samples: &[Sample]) -> Series {
    let end_s = samples.last().map_or(SLEW_S, |sample| sample.body.time_s);
    Series::dashed(label, vec![(SLEW_S, value), (end_s, value)])
}
