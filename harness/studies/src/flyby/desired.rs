//! Paper 003, Figure 5: the least velocity change that leads the second flyby back to its aimpoint, by its time.

use drawing::{Chart, Panel, Series};
use planner::flyby::sensitivity::DesiredDeltaV;

use super::leg::{Failure, Leg, planned};
use super::mission::{DAY_S, FLYBY_2};
use crate::cells::row;
use crate::report::{Outcome, Run};
use crate::verdict::{compared, verdict};

/// What is to be taken away: along T and R, in m; the direction is assumed.
const MISS_M: [f64; 2] = [-170e3, 0.0];
/// Between times, in days, and from when on before the flyby.
const EVERY_D: f64 = 0.5;
const FIRST_D: f64 = 200.0;
const LAST_D: f64 = 0.5;

/// By day before the flyby.
fn all(run: &Run<'_>) -> Result<Vec<(f64, DesiredDeltaV)>, Failure> {
    let fmu = run.options.fmu("MomentumPlant.fmu")?;
    let sensitivity = Leg::of(&fmu, &FLYBY_2)?.met(&[])?.sensitivity;
    let arrival_s = sensitivity.encounter.time_s;
    let count = ((FIRST_D - LAST_D) / EVERY_D).round() as u32;
    let days = (0..=count).map(|k| FIRST_D - EVERY_D * f64::from(k));
    Ok(days.filter_map(|day| Some((day, sensitivity.desired(arrival_s - day * DAY_S, MISS_M)?))).collect())
}

/// Figure 5.
pub(crate) fn figure5(run: &mut Run<'_>) -> Outcome {
    let all = planned(run, all(run))?;
    let mm_s = |at_d: f64| {
        let found = all.iter().find(|(day, _)| *day == at_d);
        found.map_or(f64::NAN, |(_, desired)| 1e3 * desired.size_m_s())
    };
    let least = all.iter().min_by(|a, b| a.1.size_m_s().total_cmp(&b.1.size_m_s()));
    let (least_d, least_mm_s) =
        least.map_or((f64::NAN, f64::NAN), |(day, desired)| (*day, 1e3 * desired.size_m_s()));
    let near = |what: &str, ours: f64, digits: usize, paper: f64| {
        compared(what, format!("{ours:.digits$}"), verdict((ours / paper - 1.0).abs() < 0.05))
    };
    let rows = vec![
        near("118 d before [mm/s] | 9.2, the least", mm_s(118.0), 2, 9.2),
        near("4 d before [mm/s] | 480", mm_s(4.0), 0, 480.0),
        near("the least [mm/s] | 9.2", least_mm_s, 2, 9.2),
        compared(
            "its time [d before] | 118",
            format!("{least_d:.1}"),
            verdict((least_d - 118.0).abs() < 5.0),
        ),
    ];
    run.line("Velocity change that takes a miss of 170 km away, by its time (paper 003, Figure 5)\n");
    run.table("what | paper | ours | verdict", &rows);
    run.line(
        "Numbers of the paper are read off its figure. Assumed: the leg (messenger-flyby2.toml), as it is, and that the miss is along -T. \
         Near 130 d before the flyby no velocity moves both components of B: how far from 118 d that is depends on the place of departure, \
         which is not published.",
    );
    let line = |of: &dyn Fn(&DesiredDeltaV) -> f64| -> Vec<(f64, f64)> {
        all.iter().map(|(before_d, it)| (-before_d, of(it))).collect()
    };
    let published = vec![(-118.0, 9.2e-3_f64.log10()), (-4.0, 0.48_f64.log10())];
    let size = Panel::new("log10 of m/s")
        .with([Series::curve("ours", line(&|it| it.size_m_s().log10())), Series::dots("paper", published)]);
    let angles = Panel::new("direction [deg]").with([
        Series::dots("right ascension", line(&|it| it.right_ascension_rad().to_degrees())),
        Series::dots("declination", line(&|it| it.declination_rad().to_degrees())),
    ]);
    let title = "Velocity change that takes 170 km along -T away";
    run.picture("figure5.svg", &Chart::new(title, "day from flyby 2").with([size, angles]))?;
    let cells = all.iter().map(|(before_d, it)| {
        let angles_deg = [it.right_ascension_rad(), it.declination_rad()].map(f64::to_degrees);
        row![*before_d, it.size_m_s(), angles_deg, it.delta_v_m_s]
    });
    run.csv(
        "figure5.csv",
        "before_d | delta_v_m_s | right_ascension_deg | declination_deg | delta_v_x_m_s | delta_v_y_m_s | delta_v_z_m_s",
        cells,
    )
}
