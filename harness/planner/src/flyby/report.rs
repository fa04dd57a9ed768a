//! Results of a plan with a flyby, as members of `plan.json`, as `desired.csv`, `sensitivity.csv` and `partials.csv`.

use nalgebra::{Matrix2, Vector2, Vector3};
use physics::environment::CartesianState;
use serde_json::{Value, json};

use super::{
    dispersion::Outcome,
    encounter::Encounter,
    maneuvers::{Maneuver, ellipse},
    miss::MissCost,
    sensitivity::{DesiredDeltaV, Sensitivity},
    task::FlybyTask,
};
use crate::{
    momentum::{
        attainable::Reachable,
        controls::Control,
        report::{by_percent, percentiles},
        simulated::SimulatedFlight,
        target::Moves,
        windows::Window,
    },
    text_table::csv,
};

/// Columns of an encounter.
const ENCOUNTER: [&str; 3] = ["b_t_m", "b_r_m", "arrival_s"];

/// Manoeuvres that would do what the plan does.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Approach manoeuvres with their times, in s of the flight.
    pub approach: Vec<(f64, Maneuver)>,
    /// When the departure manoeuvre is, in s of the flight.
    pub departure_s: f64,
    /// Root mean square of it: without any correction, behind the approach manoeuvres, behind the plan, in m/s.
    pub departure_m_s: [f64; 3],
    /// The departure manoeuvre by a miss.
    pub cost: MissCost,
}

/// Dispersed flights.
#[derive(Clone, Debug, PartialEq)]
pub struct Campaign {
    /// By run.
    pub outcomes: Vec<Outcome>,
    /// Runs that failed, with why: a flight into the planet, one that misses it.
    pub failed: Vec<(u64, String)>,
    /// Mean of the miss along T and R, in m.
    pub mean_m: Vector2<f64>,
    /// Its covariance, in m2.
    pub covariance_m2: Matrix2<f64>,
}

/// Results of a plan with a flyby.
#[derive(Clone, Debug)]
pub struct FlybyReport<'a> {
    /// Task of all flights.
    pub task: &'a FlybyTask,
    /// Miss of the mission as it is, and of the plan: along T and R in m, of the arrival in s.
    pub miss: [Option<Vector3<f64>>; 2],
    /// Encounter of the plan's flight, of the mission's where there is no plan.
    pub encounter: Encounter,
    /// Places that the encounter can be moved to from the mission's own.
    pub reach: Reachable,
    /// Whether no choice of arrays and attitudes that reaches the aimpoint was found.
    pub is_out_of_reach: bool,
    /// Least changes of velocity that would do the same, at times in s of the flight.
    pub desired: Vec<(f64, DesiredDeltaV)>,
    /// Manoeuvres compared.
    pub compared: Option<Compared>,
    /// Dispersed flights.
    pub campaign: Option<Campaign>,
}

impl<'a> FlybyReport<'a> {
    /// The encounter of the mission as it is.
    pub fn new(task: &'a FlybyTask) -> Self {
        Self {
            task,
            miss: [None, None],
            encounter: task.first.encounter.clone(),
            reach: Reachable::default(),
            is_out_of_reach: false,
            desired: Vec::new(),
            compared: None,
            campaign: None,
        }
    }

    /// Altitude of the closest approach, in m.
    pub fn altitude_m(&self) -> f64 {
        self.encounter.closest.position_m.norm() - self.task.radius_m
    }

    /// Members of `plan.json`.
    pub fn members(&self) -> Value {
        let [miss_before, miss_after] = self.miss.map(|miss| miss.map(|it| [it.x, it.y]));
        let [late_before, late_after] = self.miss.map(|miss| miss.map(|it| it.z));
        let [plus_t, minus_t, plus_r, minus_r] = self.reach.along_m;
        let desired = self.desired.iter().map(|(at_s, it)| {
            json!({
                "at_s": at_s,
                "size_m_s": it.size_m_s(),
                "rightAscension_deg": it.right_ascension_rad().to_degrees(),
                "declination_deg": it.declination_rad().to_degrees(),
            })
        });
        json!({
            "aim_m": self.task.aimpoint.b_m,
            "missBefore_m": miss_before,
            "missAfter_m": miss_after,
            "lateBefore_s": late_before,
            "lateAfter_s": late_after,
            "arrival_s": self.encounter.time_s,
            "osculation_s": self.encounter.epoch_s,
            "osculationEpoch_s": self.encounter.epoch_s + self.task.force_model.epoch_minus_time_s,
            "altitude_m": self.altitude_m(),
            "excessSpeed_m_s": self.encounter.plane.excess_speed_m_s,
            "reach_m": { "+T": plus_t, "-T": minus_t, "+R": plus_r, "-R": minus_r },
            "reachable_m": self.reach.region_m.corners,
            "desiredDeltaV": desired.collect::<Vec<_>>(),
            "maneuvers": self.compared.as_ref().map(compared),
            "dispersions": self.campaign.as_ref().map(campaign),
        })
    }

    /// `desired.csv`.
    pub fn desired_csv(&self) -> String {
        let rows = self.desired.iter().map(|(at_s, it)| {
            let angles = [it.right_ascension_rad(), it.declination_rad()].map(f64::to_degrees);
            [*at_s, it.size_m_s()].into_iter().chain(angles).chain(it.delta_v_m_s.iter().copied())
        });
        let header = "time_s,delta_v_m_s,right_ascension_deg,declination_deg,delta_v_x_m_s,delta_v_y_m_s,delta_v_z_m_s";
        csv(header, rows)
    }
}

fn ellipse_json(covariance_m2: &Matrix2<f64>) -> Value {
    let (semi_axes_m, angle_rad) = ellipse(covariance_m2);
    json!({ "semiAxes_m": semi_axes_m, "angle_deg": angle_rad.to_degrees() })
}

fn compared(compared: &Compared) -> Value {
    let approach = compared.approach.iter().map(|(at_s, it)| {
        json!({
            "at_s": at_s,
            "mean_m_s": [it.mean_m_s.x, it.mean_m_s.y, it.mean_m_s.z],
            "rms_m_s": it.rms_m_s,
            "left_m": it.left.rms_m(),
            "ellipse": ellipse_json(&it.left.covariance_m2),
        })
    });
    let [without, behind_approach, behind_plan] = compared.departure_m_s;
    let by_miss = compared.cost.by_miss_1_s;
    json!({
        "approach": approach.collect::<Vec<_>>(),
        "departure": {
            "at_s": compared.departure_s,
            "withoutCorrection_m_s": without,
            "behindApproach_m_s": behind_approach,
            "behindPlan_m_s": behind_plan,
            "byMiss_1_s": by_miss.row_iter().map(|row| [row[0], row[1]]).collect::<Vec<_>>(),
            "byT_m_s_km": 1e3 * by_miss.column(0).norm(),
            "byR_m_s_km": 1e3 * by_miss.column(1).norm(),
        },
    })
}

fn campaign(campaign: &Campaign) -> Value {
    let of = |value: &dyn Fn(&Outcome) -> f64| {
        by_percent(percentiles(campaign.outcomes.iter().map(value).collect()))
    };
    json!({
        "runs": campaign.outcomes.len() + campaign.failed.len(),
        "failed": campaign.failed.iter().map(|(run, why)| json!({ "run": run, "why": why })).collect::<Vec<_>>(),
        "mean_m": [campaign.mean_m.x, campaign.mean_m.y],
        "ellipse": ellipse_json(&campaign.covariance_m2),
        "percentiles": {
            "miss_m": of(&|it| it.miss_m[0].hypot(it.miss_m[1])),
            "missT_m": of(&|it| it.miss_m[0]),
            "missR_m": of(&|it| it.miss_m[1]),
            "arrival_s": of(&|it| it.arrival_s),
            "altitude_m": of(&|it| it.altitude_m),
            "momentum_n_m_s": of(&|it| it.momentum_n_m_s),
        },
    })
}

/// `partials.csv`: the state at every row of a flight up to the epoch of osculation, EME2000 from the Sun, and B.T, B.R (m) and arrival
/// (s) by it.
pub fn partials_csv(sensitivity: &Sensitivity, flight: &SimulatedFlight) -> String {
    let state = ["x_m", "y_m", "z_m", "v_x_m_s", "v_y_m_s", "v_z_m_s"];
    let before = flight.rows.iter().filter(|row| row.time_s <= sensitivity.encounter.epoch_s);
    let rows = before.filter_map(|row| {
        let CartesianState { position_m, velocity_m_s } = row.motion?.from_sun;
        let numbers = [position_m, velocity_m_s].into_iter().flat_map(<[f64; 3]>::from);
        let by_state = sensitivity.at(row.time_s).transpose();
        Some([row.time_s].into_iter().chain(numbers).chain(by_state.iter().copied().collect::<Vec<_>>()))
    });
    let by_state = ENCOUNTER.iter().flat_map(|row| state.map(|column| format!("{row}_by_{column}")));
    let names: Vec<String> = by_state.collect();
    csv(&format!("time_s,{},{}", state.join(","), names.join(",")), rows)
}

/// `sensitivity.csv`: B.T, B.R (m) and arrival (s) of every window by a degree of offset, windmill, azimuth and elevation, by the share of
/// the alternate attitude, and by a degree of its own azimuth and elevation.
pub fn sensitivity_csv(windows: &[Window], by_window: &[Moves]) -> String {
    let controls = [
        "offset_deg",
        "windmill_deg",
        "azimuth_deg",
        "elevation_deg",
        "alternate_share",
        "alternate_azimuth_deg",
        "alternate_elevation_deg",
    ];
    let rows = windows.iter().zip(by_window).map(|(window, by)| {
        let numbers = by.by_control.iter().enumerate().flat_map(|(control, by)| {
            let unit = if control == Control::Alternate as usize { 1.0 } else { 1.0_f64.to_radians() };
            [0, 1, 2].map(|row| by[row] * unit)
        });
        [window.start_s, window.stop_s].into_iter().chain(numbers)
    });
    let names = controls.iter().flat_map(|control| ENCOUNTER.map(|row| format!("{row}_by_{control}")));
    csv(&format!("start_s,stop_s,{}", names.collect::<Vec<_>>().join(",")), rows)
}
