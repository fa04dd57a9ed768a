//! The optimum of paper 000's tables: the Sun's place in every downlink, planned with all 90 days in view.
//!
//! The planner's search of the fewest dumps, then the least momentum, with science as the rule has it and downlinks when they are; a dump
//! may leave any momentum. A plan is simulated through the FMU by its inputs `downlink.*` and `dump.*`, without thresholds while it is
//! sought, by the case's own thresholds in the end: a dump that the plan does not have would be counted. In the paper's momentum, whose
//! body components are integrated, each stays below the threshold, the physical one by its length.

use loader::Fmu;
use planner::Failure;
use planner::momentum::{
    Limit,
    plan::{Least, PlanTask, PlannedDump, Simulates, body_momentum_n_m_s, plan},
    plant::{self, StartValues},
    simulated::{MomentumSize, SAME_S, SimulatedFlight},
    torque::{Control, SunlitSpacecraft},
    windows::{ControlBounds, Layout, Window, WindowKind},
};

use super::cases::{Case, Convention, Simulated, Strategy};
use super::variant::Variant;
use crate::StudyError;
use crate::attitude::Vector;
use crate::case::{self, Row};
use crate::flight::FlightKind;
use crate::report::Run;
use crate::settings::{Setting, Settings, set};

/// A component of momentum that is never reached.
const NEVER_N_M_S: f64 = 1e9;
/// Points at which a plan looks at the momentum, in s: downlinks begin and end at them.
const EVERY_S: f64 = 1800.0;

/// Simulates those of `cases` that the options leave, optima by their plans.
pub(super) fn simulate_all(run: &Run<'_>, cases: Vec<Case>) -> Result<Vec<Simulated>, StudyError> {
    let cases = run.chosen(cases, Case::label)?;
    let fmu = run.options.fmu("MomentumPlant.fmu")?;
    run.all(&cases, |case| match case.strategy {
        Strategy::Optimum => optimum(case, &fmu),
        _ => case.simulate(&fmu, &mut |_| Settings::new()),
    })
}

fn optimum(case: &Case, fmu: &Fmu) -> Result<Simulated, StudyError> {
    let failed = |why: String| StudyError::Plan { case: case.label(), why };
    let mut sought = Sought::of(case, fmu).map_err(|error| failed(error.to_string()))?;
    let task = sought.task(case);
    let (sunlit, simulated) = (sought.sunlit.clone(), sought.simulated.clone());
    let found = plan(&task, &sunlit, &simulated, &mut sought).map_err(|error| failed(error.to_string()))?;
    case.simulate(fmu, &mut sought.steer(&found.windows, &found.dumps))
}

/// A case whose plan is sought.
struct Sought<'a> {
    fmu: &'a Fmu,
    /// Without thresholds.
    case: case::Case,
    kind: FlightKind,
    sunlit: SunlitSpacecraft,
    /// As it is without a plan.
    simulated: SimulatedFlight,
    control_bounds: ControlBounds,
    sun_offset_rad: f64,
}

impl<'a> Sought<'a> {
    fn of(case: &Case, fmu: &'a Fmu) -> Result<Self, Failure> {
        let (convention, settings) = (case.convention, case.settings());
        let values = StartValues { description: fmu.description(), sets: settings.sets() };
        let text = Variant::text_of(fmu).map_err(|error| error.to_string())?;
        let spacecraft = plant::spacecraft("spacecraft.toml", &text)?;
        let sunlit = plant::sunlit(spacecraft, &values, convention)?;
        let [azimuth_rad, elevation_rad] = values.zone_rad();
        let control_bounds = ControlBounds { azimuth_rad, elevation_rad, ..ControlBounds::default() };
        let mut sought = Self {
            fmu,
            kind: FlightKind { convention, panels: sunlit.panels.len(), has_encounter: false },
            sun_offset_rad: if sunlit.panels.is_empty() { 0.0 } else { values.real("panel[1].sunOffset") },
            case: settings.set("dump.threshold", [NEVER_N_M_S; 3]).every(EVERY_S),
            sunlit,
            simulated: SimulatedFlight::default(),
            control_bounds,
        };
        sought.simulated = sought.simulate(&[], &[])?;
        Ok(sought)
    }

    fn task(&self, case: &Case) -> PlanTask {
        PlanTask {
            layout: Layout::of_downlinks(
                self.simulated.downlinks_s(),
                self.control_bounds,
                self.sun_offset_rad,
            ),
            limit: Limit {
                momentum_n_m_s: case.threshold_n_m_s,
                size: match case.convention {
                    Convention::BodyIntegral => MomentumSize::LargestComponent,
                    Convention::Inertial => MomentumSize::Length,
                },
                margin: 0.0,
                covariance: None,
            },
            dumps: usize::MAX,
            least: Least::Momentum,
            budget_s: 0.0,
            target: None,
        }
    }

    /// The inputs at every point: the place of the present downlink or the next one, and dumps.
    fn steer(&self, windows: &[Window], dumps: &[PlannedDump]) -> impl FnMut(Row<'_>) -> Settings {
        let downlinks = windows.iter().filter(|window| window.kind == WindowKind::Free);
        let places: Vec<(f64, [f64; 2])> = downlinks
            .map(|window| {
                let place = [Control::Azimuth, Control::Elevation].map(|it| window.controls.get(it));
                (window.stop_s, place)
            })
            .collect();
        let dumps: Vec<(f64, Vector)> = dumps
            .iter()
            .map(|dump| (dump.at_s, body_momentum_n_m_s(&self.sunlit, &self.simulated, windows, dump)))
            .collect();
        move |row| {
            let place = places.iter().find(|(stop_s, _)| *stop_s > row.time_s + SAME_S);
            let [azimuth_rad, elevation_rad] = place.map_or([0.0; 2], |(_, place)| *place);
            let dump = dumps.iter().find(|(at_s, _)| (at_s - row.time_s).abs() <= SAME_S);
            let mut sets = set("downlink.sunAzimuth", azimuth_rad);
            sets.extend(set("downlink.sunElevation", elevation_rad));
            sets.extend(set("dump.request", dump.is_some()));
            sets.extend(dump.iter().flat_map(|(_, after)| after.of("dump.target")));
            sets
        }
    }
}

impl Simulates for Sought<'_> {
    fn simulate(&mut self, windows: &[Window], dumps: &[PlannedDump]) -> Result<SimulatedFlight, Failure> {
        self.kind.simulate((&self.case, self.fmu), &mut self.steer(windows, dumps))
    }
}
