//! A plan: what is planned, what came of it, and how it is simulated.

use nalgebra::Vector3;
use physics::momentum::Convention;

use super::{
    baseline::{NoOffset, OffsetStep},
    model::{Limit, Model},
    program::Goal,
    simulated::SimulatedFlight,
    target::Target,
    torque::SunlitSpacecraft,
    windows::{Layout, Window},
};
use crate::Failure;

/// Flight and plan agree where they differ by less than this share of the limit: nothing more is to be gained.
pub const AGREED: f64 = 0.02;

/// Cost that a plan minimises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Least {
    /// Tilt of the Sun off -Y, by its time.
    Tilt,
    /// Greatest momentum.
    Momentum,
}

impl Least {
    pub(super) fn goal(self) -> Goal {
        match self {
            Self::Tilt => Goal::LeastCost,
            Self::Momentum => Goal::LeastExcess,
        }
    }
}

/// Task of a plan.
#[derive(Clone, Debug)]
pub struct PlanTask {
    /// Windows, contacts, how far controls go.
    pub layout: Layout,
    /// Limit of the momentum.
    pub limit: Limit,
    /// Dumps that the plan may have.
    pub dumps: usize,
    /// Cost that is minimised among plans with the fewest dumps and changes.
    pub least: Least,
    /// Time for counted changes, in s.
    pub budget_s: f64,
    /// Aim of the flight; without effect where it has no encounter.
    pub target: Option<Target>,
}

/// A mission to plan.
#[derive(Clone, Copy, Debug)]
pub struct PlanProblem<'a> {
    /// Task of the plan.
    pub task: &'a PlanTask,
    /// Spacecraft in sunlight.
    pub sunlit: &'a SunlitSpacecraft,
    /// Flight of the mission as it is.
    pub simulated: &'a SimulatedFlight,
}

impl<'a> PlanProblem<'a> {
    /// Windows of the plan and their baseline.
    pub(super) fn windows(&self) -> Result<(Vec<Window>, Vec<OffsetStep>), PlanError> {
        self.task.layout.windows(self.sunlit, self.simulated).map_err(PlanError::Corridor)
    }

    /// Linear model of the flight with windows.
    pub(super) fn model(&self, windows: Vec<Window>) -> Model<'a> {
        Model::new(self.sunlit, self.simulated.clone(), windows, self.task.limit.clone())
    }

    /// Returns the momentum after a dump of these windows in the body frame, in N m s.
    pub fn body_momentum_n_m_s(&self, windows: &[Window], dump: &PlannedDump) -> Vector3<f64> {
        if self.sunlit.convention == Convention::BodyIntegral {
            return dump.after_n_m_s;
        }
        let Some(row) = self.simulated.at(dump.at_s) else { return dump.after_n_m_s };
        let holds = |window: &&Window| window.start_s <= dump.at_s && window.stop_s > dump.at_s;
        let window = windows.iter().find(holds);
        let inertial_from_body = window
            .map_or(row.inertial_from_body, |window| window.inertial_from_body(self.sunlit, &row, dump.at_s));
        inertial_from_body.inverse() * dump.after_n_m_s
    }
}

/// A dump of the plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedDump {
    /// In s of the flight.
    pub at_s: f64,
    /// Momentum after it, EME2000, in N m s.
    pub after_n_m_s: Vector3<f64>,
}

/// Plan and flight at one row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedRow {
    /// In s of the flight.
    pub time_s: f64,
    /// |H| as planned, in N m s.
    pub planned_n_m_s: f64,
    /// |H| as simulated, in N m s.
    pub simulated_n_m_s: f64,
    /// Largest allowed |H|, in N m s.
    pub allowed_n_m_s: f64,
    /// Length of the difference of both, in N m s.
    pub difference_n_m_s: f64,
}

/// Excess that keeps a plan from having no dumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exceeded {
    /// By which the limit is exceeded without dumps at the least that was found, in N m s.
    pub excess_n_m_s: f64,
    /// Up to when the search found controls that keep the limit, in s of the flight; others may keep it longer.
    pub first_s: f64,
}

/// A plan.
#[derive(Clone, Debug)]
pub struct MomentumPlan {
    /// With their controls.
    pub windows: Vec<Window>,
    /// Steps of the baseline.
    pub baseline: Vec<OffsetStep>,
    /// Its dumps, in order.
    pub dumps: Vec<PlannedDump>,
    /// No plan on the baseline has fewer.
    pub dumps_at_least: usize,
    /// Changes of the arrays.
    pub changes: usize,
    /// No plan on the baseline with these dumps has fewer.
    pub changes_at_least: usize,
    /// Row by row.
    pub rows: Vec<PlannedRow>,
    /// Flights that it took.
    pub rounds: usize,
    /// Whether its flight stays below the limit and meets the target.
    pub holds: bool,
    /// Whether it is the mission as it is: no better plan was found.
    pub is_mission: bool,
    /// Excess without dumps, if the limit is not kept.
    pub exceeded: Option<Exceeded>,
    /// Its flight.
    pub flight: SimulatedFlight,
}

/// The greatest |H| of rows as planned and as simulated, in N m s.
pub(super) fn greatest_n_m_s<'a>(rows: impl Iterator<Item = &'a PlannedRow>) -> [f64; 2] {
    rows.fold([0.0; 2], |[planned, simulated], row| {
        [row.planned_n_m_s.max(planned), row.simulated_n_m_s.max(simulated)]
    })
}

impl MomentumPlan {
    /// Greatest |H| as planned and as simulated, in N m s.
    pub fn greatest_n_m_s(&self) -> [f64; 2] {
        greatest_n_m_s(self.rows.iter())
    }

    /// Greatest difference of flight and plan, in N m s.
    pub fn difference_n_m_s(&self) -> f64 {
        self.rows.iter().map(|row| row.difference_n_m_s).fold(0.0, f64::max)
    }
}

/// Why there is no plan at all.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The corridor is empty somewhere.
    #[error("no offset keeps the light on the cells in its corridor {distance_au:.3} AU from the Sun", distance_au = .0.distance_au)]
    Corridor(NoOffset),
    /// A limit that dumps do not help to keep.
    #[error(
        "found a momentum {excess_n_m_s:.3} N.m.s above the limit of {limit_n_m_s} N.m.s on day {day:.1} at best, between two instants at which \
         a dump could be, allowed: a greater limit, or more room for the controls"
    )]
    Limit {
        /// By which it is exceeded at best, in N m s.
        excess_n_m_s: f64,
        /// The limit, in N m s.
        limit_n_m_s: f64,
        /// When it is exceeded most, in d of the flight.
        day: f64,
    },
    /// A flight failed.
    #[error("{0}")]
    Flight(Failure),
    /// The solver found nothing.
    #[error("no programme was solved: {0}")]
    Programme(&'static str),
}

/// How a plan is simulated.
pub trait Simulates {
    /// Simulates windows and dumps.
    ///
    /// # Errors
    /// The flight fails.
    fn simulate(&mut self, windows: &[Window], dumps: &[PlannedDump]) -> Result<SimulatedFlight, Failure>;

    /// Receives what is being done.
    fn progress(&mut self, _doing: &str) {}
}
