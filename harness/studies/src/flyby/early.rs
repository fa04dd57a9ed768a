//! Paper 003, Figure 3: the first flyby's B-plane before and behind a change of the arrays that comes three days early.

use planner::flyby::BPlaneAimpoint;
use planner::momentum::windows::{ControlBounds, Window};

use super::leg::{Failure, Leg, Met, planned};
use super::mission::{DAY_S, FLYBY_1};
use super::plane::{Intercept, Plane, Target, covariance_m2};
use crate::StudyError;
use crate::report::{Outcome, Run};
use crate::verdict::{compared, verdict};

/// How much earlier the arrays turn, in s.
const EARLIER_S: f64 = 3.0 * DAY_S;
/// A window longer than the leg: only steps of the baseline divide it.
pub(super) const WHOLE_S: f64 = 1e9;
/// Printed misses before and behind the change, in m.
const BEFORE_M: f64 = 10e3;
const BEHIND_M: f64 = 11e3;

/// The first flyby with its arrays turned when the baseline has it, and three days early.
pub(super) struct Early {
    pub target: Target,
    /// Misses along T and R in m: before, behind.
    pub miss_m: [[f64; 2]; 2],
    /// Of the closest approach against the aimpoint's, in m, as the FMU reports it.
    pub altitude_offset_m: [f64; 2],
    /// Direction along T and R that a place nearer to the Sun is moved to.
    sunward: [f64; 2],
    /// When the baseline turns them, before the flyby, in s, and from what to what, in rad.
    step: (f64, [f64; 2]),
    covariance_m2: nalgebra::Matrix2<f64>,
}

/// The arrays' last step, earlier.
fn earlier(windows: &[Window]) -> Result<Vec<Window>, Failure> {
    let mut all = windows.to_vec();
    let [.., before, last] = all.as_mut_slice() else { return Err("found no step of the arrays".into()) };
    last.start_s -= EARLIER_S;
    before.stop_s -= EARLIER_S;
    if before.stop_s <= before.start_s {
        return Err("found a last step within three days of the one before".into());
    }
    Ok(all)
}

fn miss_m(aimpoint: &BPlaneAimpoint, met: &Met) -> [f64; 2] {
    aimpoint.miss(&met.sensitivity.encounter).xy().into()
}

/// A miss of the first printed size that moves by `moved_m` to one of the second: of both that at which the altitude changes most to that of
/// the aimpoint.
fn before_m(target: &Target, moved_m: [f64; 2]) -> Option<[f64; 2]> {
    let size_m = moved_m[0].hypot(moved_m[1]);
    let along = moved_m.map(|part_m| part_m / size_m);
    let along_m = (BEHIND_M.powi(2) - BEFORE_M.powi(2) - size_m.powi(2)) / (2.0 * size_m);
    let aside_m = (BEFORE_M.powi(2) - along_m.powi(2)).sqrt();
    let place =
        |aside_m: f64| [along_m * along[0] - aside_m * along[1], along_m * along[1] + aside_m * along[0]];
    let gained_m = |place_m: &[f64; 2]| {
        let behind_m = [place_m[0] + moved_m[0], place_m[1] + moved_m[1]];
        let [before_m, behind_m] = [*place_m, behind_m].map(|it| target.altitude_offset_m(it).abs());
        before_m - behind_m
    };
    let both = [aside_m, -aside_m].into_iter().filter(|it| it.is_finite()).map(place);
    both.max_by(|a, b| gained_m(a).total_cmp(&gained_m(b)))
}

fn compute(leg: &Leg<'_>) -> Result<Early, Failure> {
    let first = leg.met(&[])?;
    let target = Target::of(leg, &first, &FLYBY_1)?;
    let encounter = &first.sensitivity.encounter;
    let aimpoint = BPlaneAimpoint { b_m: target.aimpoint_m, arrival_s: Some(encounter.time_s) };
    let aimed_m = encounter.closest.position_m.norm() - leg.radius_m;
    let layout = leg.layout(WHOLE_S, ControlBounds::default());
    let no_offset = |_| "found a distance that no offset suits";
    let windows = layout.windows(&leg.sunlit, &first.flight).map_err(no_offset)?.0;
    let early = earlier(&windows)?;
    let (leg, nominal) = leg.led(&windows, &aimpoint)?;
    let [from, moved] = [miss_m(&aimpoint, &nominal), miss_m(&aimpoint, &leg.met(&early)?)];
    let moved_m = [moved[0] - from[0], moved[1] - from[1]];
    let before_m = before_m(&target, moved_m).ok_or("found no place 10 km off that it moves to 11 km")?;
    // A state with that miss: by the least change of velocity.
    let error = nominal.sensitivity.desired(0.0, before_m.map(|part_m| -part_m));
    let leg = leg.changed(&error.ok_or("found no velocity that moves the intercept")?.delta_v_m_s);
    let [before, behind] = [leg.met(&windows)?, leg.met(&early)?];
    let altitude = |windows: &[Window], met: &Met| {
        Ok::<_, Failure>(leg.passed(windows, met.sensitivity.encounter.time_s)?[1] - aimed_m)
    };
    let altitude_offset_m = [altitude(&windows, &before)?, altitude(&early, &behind)?];
    let by_place = before.sensitivity.at(before.sensitivity.encounter.epoch_s);
    let to_sun = before.flight.rows.last().map_or_else(nalgebra::Vector3::zeros, |row| row.to_sun_m);
    let sunward = (by_place.fixed_view::<2, 3>(0, 0) * to_sun).normalize();
    let last = windows.len() - 1;
    let step_s = encounter.time_s - windows[last].start_s;
    let at_step_s = windows[last].start_s - EARLIER_S;
    Ok(Early {
        target,
        miss_m: [miss_m(&aimpoint, &before), miss_m(&aimpoint, &behind)],
        altitude_offset_m,
        sunward: sunward.into(),
        step: (step_s, [windows[last - 1].baseline_rad, windows[last].baseline_rad]),
        covariance_m2: covariance_m2(&behind.sensitivity, at_step_s),
    })
}

impl Early {
    pub(super) fn of(run: &Run<'_>) -> Result<Self, StudyError> {
        let fmu = run.options.fmu("MomentumPlant.fmu")?;
        planned(run, Leg::of(&fmu, &FLYBY_1).and_then(|leg| compute(&leg)))
    }
}

/// Figure 3.
pub(crate) fn figure3(run: &mut Run<'_>) -> Outcome {
    let found = Early::of(run)?;
    let [before_m, behind_m] = found.miss_m;
    let moved_km = [0, 1].map(|row| (behind_m[row] - before_m[row]) / 1e3);
    let [t, r] = found.sunward;
    let toward_km = moved_km[0] * t + moved_km[1] * r;
    let size_km = |[t_m, r_m]: [f64; 2]| t_m.hypot(r_m) / 1e3;
    let cost_m_s = found.miss_m.map(|miss_m| found.target.cost.cost_m_s(miss_m));
    let altitude_km = found.altitude_offset_m.map(|offset_m| offset_m / 1e3);
    let near = |what: &str, ours: f64, paper: f64| {
        compared(what, format!("{ours:.1}"), verdict((ours - paper).abs() <= 0.5))
    };
    let (step_s, turned_rad) = found.step;
    let [from_deg, to_deg] = turned_rad.map(f64::to_degrees);
    let moved = format!("{:.1}, {toward_km:.1} of it", moved_km[0].hypot(moved_km[1]));
    let rows = vec![
        near("miss before [km] | 10, taken", size_km(before_m), 10.0),
        compared("moved toward the Sun [km] | kilometres", moved, verdict(toward_km > 1.0)),
        near("miss behind [km] | 11, taken", size_km(behind_m), 11.0),
        near("cost before [m/s] | 4.5", cost_m_s[0], 4.5),
        near("cost behind [m/s] | 1.5", cost_m_s[1], 1.5),
        near("saved [m/s] | 3", cost_m_s[0] - cost_m_s[1], 3.0),
        compared("altitude offset before [km] | -", format!("{:+.1}", altitude_km[0]), "-"),
        compared(
            "altitude offset behind [km] | within 2",
            format!("{:+.1}", altitude_km[1]),
            verdict(altitude_km[1].abs() < 2.0),
        ),
    ];
    run.line("Mercury flyby 1: arrays turned three days early (paper 003, Figure 3)\n");
    run.table("what | paper | ours | verdict", &rows);
    run.line(&format!(
        "The arrays turn from {from_deg:.1} to {to_deg:.1} deg off the Sun {:.1} d before the flyby by the baseline, {:.1} d as it was done; \
         when and by how much MESSENGER's did is not published. Nor is the place of the first intercept: of the two that lie 10 km off \
         and are moved to 11 km, it is the one from which the altitude comes nearer to the aim's. Assumed too: state, mass, centre of \
         mass and aim (messenger-flyby1.toml), the corridor. Costs lead back to the path 30 d behind the flyby, for flyby 2.",
        step_s / DAY_S,
        (step_s + EARLIER_S) / DAY_S,
    ));
    let plane = Plane {
        target: &found.target,
        title: "B-plane at Mercury, flyby 1, arrays turned three days early".to_owned(),
        intercepts: vec![
            Intercept { label: "as planned", miss_m: before_m, covariance_m2: None },
            Intercept {
                label: "three days early",
                miss_m: behind_m,
                covariance_m2: Some(found.covariance_m2),
            },
        ],
        reachable_m: Vec::new(),
        costs_m_s: &[1.5, 3.0, 4.5],
    };
    plane.write(run, "figure3")
}
