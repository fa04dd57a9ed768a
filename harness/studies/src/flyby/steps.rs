//! Paper 003's steps to the second flyby: momentum planned, departure led to that plan, its error, and plans anew; Figures 6 and 7.

use nalgebra::Matrix2;
use planner::flyby::BPlaneAimpoint;
use planner::momentum::windows::{ControlBounds, Window};

use super::leg::{Failure, Leg, Met, Room, STEP_S, planned, windows_from};
use super::mission::{DAY_S, FLYBY_2};
use super::plane::{Intercept, Plane, SIGMAS, Target, covariance_m2};
use crate::StudyError;
use crate::report::{Outcome, Run};
use crate::verdict::{compared, verdict};

const DEG: f64 = core::f64::consts::PI / 180.0;
/// Miss behind the departure, along T and R, in m; its direction is assumed.
const DEPARTURE_MISS_M: [f64; 2] = [-170e3, 0.0];
/// Of the plan of momentum alone: tilts and momentum leave room for what corrects later.
const MOMENTUM: Room = Room {
    window_s: 10.0 * DAY_S,
    control_bounds: ControlBounds {
        offset_rad: 0.0,
        windmill_rad: 2.0 * DEG,
        azimuth_rad: 5.0 * DEG,
        elevation_rad: 6.0 * DEG,
        alternate: 0.0,
        alternate_apart: false,
    },
    limit_n_m_s: 4.5,
};
/// Of corrections: offsets of the arrays off the baseline of the rest of the leg, or as the plan before has them.
const OFFSET_RAD: f64 = 5.0 * DEG;
/// The paper's threshold of dumps, in N m s.
const THRESHOLD_N_M_S: f64 = 5.5;

/// A correction of the paper.
pub(super) struct Correction {
    figure: &'static str,
    date: &'static str,
    /// Before the flyby, in days.
    before_d: f64,
    window_s: f64,
    /// Found by orbit determination since the plan before, along T and R, in m.
    drift_m: [f64; 2],
    /// The earlier ones leave something of the threshold.
    limit_n_m_s: f64,
    /// Contours, in m/s.
    costs_m_s: &'static [f64],
}

impl Correction {
    /// With the keep-in zone of the paper.
    fn room(&self) -> Room {
        let control_bounds = ControlBounds {
            offset_rad: OFFSET_RAD,
            windmill_rad: 2.0 * DEG,
            azimuth_rad: 10.0 * DEG,
            elevation_rad: 12.0 * DEG,
            alternate: 0.0,
            alternate_apart: false,
        };
        Room { window_s: self.window_s, control_bounds, limit_n_m_s: self.limit_n_m_s }
    }
}

pub(super) const CORRECTIONS: [Correction; 3] = [
    Correction {
        figure: "figure7",
        date: "17 June 2008",
        before_d: 111.0,
        window_s: 10.0 * DAY_S,
        drift_m: [0.0, 0.0],
        limit_n_m_s: 5.0,
        costs_m_s: &[20.0, 40.0, 80.0, 120.0],
    },
    Correction {
        figure: "figure8",
        date: "18 September 2008",
        before_d: 18.0,
        window_s: DAY_S,
        drift_m: [-4e3, 0.0],
        limit_n_m_s: 5.3,
        costs_m_s: &[1.0, 2.0, 4.0],
    },
    // The printed 4 km.
    Correction {
        figure: "figure9",
        date: "29 September 2008",
        before_d: 7.0,
        window_s: DAY_S,
        drift_m: [2.83e3, 2.83e3],
        limit_n_m_s: 5.45,
        costs_m_s: &[1.0, 2.0, 4.0],
    },
];

/// A leg that continues by some windows.
pub(super) struct Step<'a> {
    pub leg: Leg<'a>,
    pub windows: Vec<Window>,
    pub met: Met,
}

impl Step<'_> {
    /// In m along T and R.
    pub(super) fn miss_m(&self, target: &Target) -> [f64; 2] {
        let plane = self.met.sensitivity.encounter.plane;
        [plane.b_t_m - target.aimpoint_m[0], plane.b_r_m - target.aimpoint_m[1]]
    }

    /// Altitude of its closest approach, in m, as the FMU reports it.
    pub(super) fn altitude_m(&self) -> Result<f64, Failure> {
        Ok(self.leg.passed(&self.windows, self.arrival_s())?[1])
    }

    fn arrival_s(&self) -> f64 {
        self.met.sensitivity.encounter.time_s
    }

    fn of<'a>(leg: Leg<'a>, windows: Vec<Window>) -> Result<Step<'a>, Failure> {
        let met = leg.met(&windows)?;
        Ok(Step { leg, windows, met })
    }
}

/// The flyby's leg, as far as it is planned.
pub(super) struct Steps<'a> {
    /// The leg as its mission is: its B is the aimpoint.
    unmanaged: Met,
    pub target: Target,
    /// Led to the plan of momentum.
    pub led: Step<'a>,
    /// With the error of the departure.
    pub departed: Step<'a>,
    pub corrected: Vec<CorrectedStep<'a>>,
}

/// The leg before and after a correction.
pub(super) struct CorrectedStep<'a> {
    before: Step<'a>,
    pub after: Step<'a>,
    /// Rounds of the plan.
    rounds: usize,
}

impl<'a> Steps<'a> {
    /// Up to so many corrections.
    fn of(leg: &Leg<'a>, corrections: usize, done: &dyn Fn()) -> Result<Self, Failure> {
        let unmanaged = leg.met(&[])?;
        let target = Target::of(leg, &unmanaged, &FLYBY_2)?;
        let aimpoint = BPlaneAimpoint {
            b_m: target.aimpoint_m,
            arrival_s: Some(unmanaged.sensitivity.encounter.time_s),
        };
        let windows = leg.planned(&MOMENTUM, &[], None)?.windows;
        done();
        let (leg, met) = leg.led(&windows, &aimpoint)?;
        let led = Step { leg, windows, met };
        let departed = off(&led, 0.0, DEPARTURE_MISS_M)?;
        done();
        let mut corrected: Vec<CorrectedStep<'a>> = Vec::new();
        for correction in &CORRECTIONS[..corrections] {
            let last = corrected.last().map_or(&departed, |it| &it.after);
            let at_s = ((last.arrival_s() - correction.before_d * DAY_S) / STEP_S).round() * STEP_S;
            let before = off(last, at_s, correction.drift_m)?;
            let room = correction.room();
            let free = BPlaneAimpoint { arrival_s: None, ..aimpoint };
            let plan = before.leg.planned(&room, &before.windows, Some(&free))?;
            let after = Step::of(before.leg.clone(), plan.windows)?;
            corrected.push(CorrectedStep { before, after, rounds: plan.rounds });
            done();
        }
        Ok(Self { unmanaged, target, led, departed, corrected })
    }

    /// Altitude of the leg as its mission is, in m.
    pub(super) fn aimed_altitude_m(&self) -> f64 {
        self.unmanaged.sensitivity.encounter.closest.position_m.norm() - self.led.leg.radius_m
    }
}

/// A step from a time of it on, with a state that moves its intercept: by the least change of velocity.
fn off<'a>(step: &Step<'a>, at_s: f64, moved_m: [f64; 2]) -> Result<Step<'a>, Failure> {
    let error = step.met.sensitivity.desired(at_s, moved_m.map(|part_m| -part_m));
    let error = error.ok_or("found no velocity that moves the intercept")?.delta_v_m_s;
    let leg = match at_s > 0.0 {
        true => step.leg.from(&step.met.flight.at(at_s).ok_or("found no row of the flight")?)?,
        false => step.leg.clone(),
    };
    Step::of(leg.changed(&error), windows_from(&step.windows, at_s))
}

/// The steps of a study.
pub(super) fn steps<T>(
    run: &Run<'_>,
    corrections: usize,
    of: impl FnOnce(Steps<'_>) -> Result<T, Failure>,
) -> Result<T, StudyError> {
    let fmu = run.options.fmu("MomentumPlant.fmu")?;
    let bar = terminal::progress(corrections as u64 + 2, "steps", !run.options.progress);
    let found = Leg::of(&fmu, &FLYBY_2).and_then(|leg| Steps::of(&leg, corrections, &|| bar.inc(1)));
    bar.finish_and_clear();
    planned(run, found.and_then(of))
}

/// Figure 6.
pub(crate) fn figure6(run: &mut Run<'_>) -> Outcome {
    let (target, error_m_s, miss_m, covariance_m2) = steps(run, 0, |steps| {
        let error = steps.led.met.sensitivity.desired(0.0, DEPARTURE_MISS_M.map(|part_m| -part_m));
        let error_m_s = error.map_or(f64::NAN, |error| error.size_m_s());
        let miss_m = steps.departed.miss_m(&steps.target);
        let covariance_m2 = covariance_m2(&steps.departed.met.sensitivity, 0.0);
        Ok((steps.target, error_m_s, miss_m, covariance_m2))
    })?;
    let size_km = miss_m[0].hypot(miss_m[1]) / 1e3;
    let cost_m_s = target.cost.cost_m_s(DEPARTURE_MISS_M);
    let altitude_km = target.altitude_offset_m(miss_m) / 1e3;
    let rows = vec![
        compared("miss [km] | 170", format!("{size_km:.1}"), verdict((size_km - 170.0).abs() < 2.0)),
        compared(
            "cost of 170 km along T [m/s] | 80",
            format!("{cost_m_s:.0}"),
            verdict((cost_m_s - 80.0).abs() < 8.0),
        ),
        compared("altitude offset [km] | -", format!("{altitude_km:.1}"), "-"),
        compared("error of the departure [mm/s] | -", format!("{:.1}", 1e3 * error_m_s), "-"),
    ];
    run.line("Mercury flyby 2 behind the departure of 19 March 2008 (paper 003, Figure 6)\n");
    run.table("what | paper | ours | verdict", &rows);
    run.line(ASSUMED);
    run.line(
        "The paper says neither date nor manoeuvre of its penalty; ours leads back to the path 30 d behind the flyby, for 2009-09-29.",
    );
    let plane = Plane {
        target: &target,
        title: "B-plane at Mercury behind the departure, 201 days before flyby 2".to_owned(),
        intercepts: vec![Intercept {
            label: "behind the departure",
            miss_m,
            covariance_m2: Some(covariance_m2),
        }],
        reachable_m: Vec::new(),
        costs_m_s: &[20.0, 40.0, 80.0, 120.0],
    };
    plane.write(run, "figure6")
}

const ASSUMED: &str = "\
Assumed, as it is not published: state at the departure, mass, centre of mass and aim (messenger-flyby2.toml, 200 km, B along T), the
corridor of the arrays, that the miss is along -T, and the state's covariance: 1 km and 0.5 mm/s along each axis. Ellipses: three
deviations by that alone.";

/// Figure 7.
pub(crate) fn figure7(run: &mut Run<'_>) -> Outcome {
    corrected(run, 0)
}

/// Figure 8.
pub(crate) fn figure8(run: &mut Run<'_>) -> Outcome {
    corrected(run, 1)
}

/// Figure 9.
pub(crate) fn figure9(run: &mut Run<'_>) -> Outcome {
    corrected(run, 2)
}

/// What one correction came to.
struct Corrected {
    /// In m along T and R, before and behind it.
    miss_m: [[f64; 2]; 2],
    covariance_m2: Matrix2<f64>,
    greatest_n_m_s: f64,
    /// Off the aimpoint's altitude, as the FMU reports it, in m.
    altitude_offset_m: f64,
    windows: usize,
    rounds: usize,
}

fn corrected(run: &mut Run<'_>, index: usize) -> Outcome {
    let correction = &CORRECTIONS[index];
    let (target, all, reachable) = steps(run, index + 1, |steps| {
        let aimed_m = steps.aimed_altitude_m();
        let of = |CorrectedStep { before, after, rounds }: &CorrectedStep<'_>| -> Result<Corrected, Failure> {
            Ok(Corrected {
                miss_m: [before, after].map(|step| step.miss_m(&steps.target)),
                covariance_m2: covariance_m2(&after.met.sensitivity, 0.0),
                greatest_n_m_s: after.met.flight.greatest_momentum().0,
                altitude_offset_m: after.altitude_m()? - aimed_m,
                windows: after.windows.len(),
                rounds: *rounds,
            })
        };
        let all = steps.corrected.iter().map(of).collect::<Result<Vec<_>, _>>()?;
        let Some(CorrectedStep { before, .. }) = steps.corrected.last() else {
            return Err("found no correction".into());
        };
        let aimpoint = BPlaneAimpoint { b_m: steps.target.aimpoint_m, arrival_s: None };
        let reachable = before.leg.reachable(&correction.room(), &before.windows, &aimpoint)?;
        Ok((steps.target, all, reachable))
    })?;
    run.line(&format!(
        "Mercury flyby 2 planned anew on {}, {} days before it (paper 003, {})\n",
        correction.date,
        correction.before_d,
        correction.figure.replace("figure", "Figure ")
    ));
    let size_km = |[t_m, r_m]: [f64; 2]| t_m.hypot(r_m) / 1e3;
    let row = |(found, correction): (&Corrected, &Correction)| {
        let [before_km, after_km] = found.miss_m.map(size_km);
        let ([large_m, small_m], _) = planner::flyby::maneuvers::ellipse(&found.covariance_m2);
        let holds = after_km < 1.0 && found.greatest_n_m_s < THRESHOLD_N_M_S;
        vec![
            format!("{} d", correction.before_d),
            format!("{before_km:.2}"),
            format!("{after_km:.2}"),
            format!("{:+.2}", found.altitude_offset_m / 1e3),
            format!("{:.2}", found.greatest_n_m_s),
            found.windows.to_string(),
            found.rounds.to_string(),
            format!("{:.1} by {:.1}", SIGMAS * large_m / 1e3, SIGMAS * small_m / 1e3),
            verdict(holds).to_owned(),
        ]
    };
    let rows: Vec<_> = all.iter().zip(&CORRECTIONS).map(row).collect();
    run.table(
        "before the flyby | miss before [km] | miss behind, paper: under 1 [km] | altitude offset [km] | momentum, limit 5.5 [N.m.s] | \
         windows | rounds | ellipse [km] | verdict",
        &rows,
    );
    let moved = ["+T", "-T", "+R", "-R"].iter().zip(reachable.along_m);
    let moved = moved.map(|(axis, along_m)| match along_m {
        Some(along_m) => format!("{axis} {:.1}", along_m / 1e3),
        None => format!("{axis} none"),
    });
    let farthest_km = reachable.polygon_m.iter().map(|corner_m| size_km(*corner_m)).fold(0.0, f64::max);
    run.line(&format!(
        "Sunlight moves the last intercept by up to {} km from then on, the other component as it is, and by {farthest_km:.1} km at most.",
        moved.collect::<Vec<_>>().join(", ")
    ));
    run.line(ASSUMED);
    run.line(&format!(
        "The plans begin at the departure's miss, each at the one before. Windows hold arrays and position of the Sun; the FMU gets them as inputs.{}",
        if index > 0 { DRIFTS } else { "" }
    ));
    let Some(Corrected { miss_m: [before_m, after_m], covariance_m2, .. }) = all.into_iter().next_back()
    else {
        return Ok(());
    };
    let reached_m = reachable.polygon_m.iter().map(|[t_m, r_m]| [before_m[0] + t_m, before_m[1] + r_m]);
    let plane = Plane {
        target: &target,
        title: format!("B-plane at Mercury, {} days before flyby 2", correction.before_d),
        intercepts: vec![
            Intercept { label: "by the plan before", miss_m: before_m, covariance_m2: None },
            Intercept { label: "planned anew", miss_m: after_m, covariance_m2: Some(covariance_m2) },
        ],
        reachable_m: reached_m.collect(),
        costs_m_s: correction.costs_m_s,
    };
    plane.write(run, correction.figure)
}

/// Assumptions appended to every correction but the first.
const DRIFTS: &str = "
Assumed too: that orbit determination found a drift of 4 km along -T 18 d before, where the paper prints none, and that the drift of 4 km
that it prints 7 d before was along T and R in equal parts: sunlight moves it farthest nearly the other way.";
