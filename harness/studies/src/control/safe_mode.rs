//! Safe modes of paper 001 in a loop of Guidance and the controlled plant: every one is reached and does what the paper says.

use super::guided_loop::{Loop, Sample};
use super::safe_mode_checks::{Parameters, attitude_lost, zone_violated};
use super::safe_mode_flight::{Chain, sun_angle_deg};
use crate::cells::row;
use crate::report::{Outcome, Run};
use crate::verdict::{agrees, compared};
use drawing::{Chart, Mark, Panel, Series};

/// Both chains of modes.
pub(crate) fn safe_mode(run: &mut Run<'_>) -> Outcome {
    let chains = [Chain::AttitudeLost, Chain::ZoneViolated];
    let cases = run.chosen(chains, |chain| chain.label().to_owned())?;
    let both = Loop::open(run.options)?;
    let parameters = Parameters::read(&both)?;
    let step_s = run.options.step_s;
    let simulated = run.all(&cases, |chain| Ok((*chain, chain.simulated(&both, step_s)?)))?;
    run.line("Safe modes (paper 001), Guidance and the controlled plant in a loop\n");
    let rows: Vec<_> = simulated
        .iter()
        .flat_map(|(chain, samples)| {
            let checks = match chain {
                Chain::AttitudeLost => attitude_lost(&parameters, samples),
                Chain::ZoneViolated => zone_violated(&parameters, samples),
            };
            checks.into_iter().map(|(statement, (holds, found))| {
                compared(&format!("{} | {statement}", chain.label()), found, agrees(holds))
            })
        })
        .collect();
    run.table_and_csv("safe-mode.csv", "case | paper 001 | found | verdict", rows)?;
    run.line(REMARK);
    history(run, &simulated)?;
    for (chain, samples) in &simulated {
        let file = format!("safe-mode-{}.svg", chain.label().replace(' ', "-"));
        run.picture(&file, &figure(*chain, &parameters, samples))?;
    }
    Ok(())
}

const REMARK: &str = "\
Attitude lost: +Z at the Sun with the keep-in zone off; the star tracker fails at 300 s and the gyros keep the estimate
valid for 60 s; all Sun sensors fail at 2000 s and work again at 4400 s, the star tracker at 6000 s; Safe Hold is requested
at 6300 s, Operational at 7800 s, and the first pointing command is set all the time. Zone violated: the same pointing; the
zone is put in force at 300 s, Operational is requested at 2400 s. All times, the rates of Earth Acquisition and search, and
how long the monitor waits are assumed: the paper prints none.";

/// Everything of every second.
fn history(run: &mut Run<'_>, simulated: &[(Chain, Vec<Sample>)]) -> Outcome {
    let header = "\
        case | time_s | q1 | q2 | q3 | q4 | rate_x_rad_s | rate_y_rad_s | rate_z_rad_s | sun_x | sun_y | \
        sun_z | earth_x | earth_y | earth_z | sun_angle_deg | command_x_rad_s | command_y_rad_s | \
        command_z_rad_s | mode | command_kind | attitude_known | sun_sensed | torque_limited | dumps | link";
    let rows = simulated.iter().flat_map(|(chain, samples)| {
        samples.iter().map(|sample| {
            let [sun, earth] = [sample.to_sun_m(), sample.to_earth_m()].map(|to| to.normalize());
            row![
                chain.label(),
                sample.time_s,
                sample.q,
                sample.rate_rad_s,
                sun,
                earth,
                sun_angle_deg(sample),
                sample.command_rate_rad_s,
                sample.mode,
                sample.command_kind,
                sample.is_attitude_known,
                sample.is_sun_sensed,
                sample.is_torque_limited,
                sample.dumps,
                sample.has_link,
            ]
        })
    });
    run.csv("safe-mode-history.csv", header, rows)
}

/// Mode, Sun, rates and flags over time.
fn figure(chain: Chain, parameters: &Parameters, samples: &[Sample]) -> Chart {
    let line = |label: &str, value: &dyn Fn(&Sample) -> f64| {
        // The first second has no command yet.
        let points = samples.iter().skip(1).map(|sample| (sample.time_s, value(sample)));
        Series::line(label, points.collect())
    };
    let flag = |is: bool| f64::from(u8::from(is));
    let rate = |i: usize| move |sample: &Sample| sample.rate_rad_s[i].to_degrees();
    let mut rates = vec![line("X", &rate(0)), line("Y", &rate(1)), line("Z", &rate(2))];
    if chain == Chain::AttitudeLost {
        rates.extend(parameters.commanded_rates());
    }
    Chart::new(format!("Safe modes: {}", chain.label()), "time [s]").with([
        Panel::new("mode")
            .range(0.5, 3.5)
            .whole()
            .with([line("1 Operational, 2 Safe Hold, 3 Earth Acquisition", &|it| f64::from(it.mode))]),
        Panel::new("command")
            .range(0.5, 3.5)
            .whole()
            .with([line("1 attitude, 2 error quaternion, 3 rate only", &|sample| {
                f64::from(sample.command_kind)
            })]),
        Panel::new("Sun [deg]").with([line("from -Y", &sun_angle_deg)]),
        Panel::new("rate [deg/s]").with(rates),
        Panel::new("valid").range(-0.15, 1.15).whole().with([
            line("estimated attitude", &|sample| flag(sample.is_attitude_known)),
            line("sensed Sun", &|sample| flag(sample.is_sun_sensed)).drawn(Mark::Dashed),
            line("link with the Earth", &|sample| flag(sample.has_link)),
        ]),
    ])
}
