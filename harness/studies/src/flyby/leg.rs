//! A leg to a flyby through MomentumPlant: simulated as its mission is or by a plan's inputs, led to an aimpoint, planned anew.
//!
//! Flights end seven hours and more before the closest approach: what follows is propagated by the planner, so that a path into the
//! planet is one like others. [`Leg::passed`] simulates it to the end.

use loader::Fmu;
pub(super) use planner::Failure;
use planner::{
    flyby::{BPlaneAimpoint, ForceModel, Sensitivity},
    momentum::{
        Convention, Limit,
        attainable::{Reachable, reachable},
        in_force::ActiveControls,
        plan::{Least, MomentumPlan, PlanTask, PlannedDump, Simulates, plan},
        plant::{self, StartValues},
        simulated::{FlightRow, MomentumSize, SAME_S, SimulatedFlight},
        target::Target,
        torque::{Control, SunlitSpacecraft},
        windows::{ControlBounds, Layout, Window},
    },
};

use super::mission::{DAY_S, Mission};
use crate::StudyError;
use crate::attitude::Vector;
use crate::case::Case;
use crate::flight::FlightKind;
use crate::report::Run;
use crate::settings::{Settings, set};

/// How near a plan comes to its aimpoint, in m.
const TOLERANCE_M: f64 = 1e3;
/// Between points at which plans command, in s; windows begin and end at them.
pub(super) const STEP_S: f64 = 6.0 * 3600.0;
/// The same where a flight goes past the planet, and how long it continues behind.
const FINE_S: f64 = 3600.0;
const BEHIND_S: f64 = 2.0 * 3600.0;
/// Flights to lead a leg at most, and when it is there: in m, and in s of the arrival.
const ROUNDS: usize = 10;
const LED_M: f64 = 20.0;
const LED_S: f64 = 0.1;

/// A leg from its start on.
#[derive(Clone)]
pub(super) struct Leg<'a> {
    fmu: &'a Fmu,
    case: Case,
    stop_s: f64,
    kind: FlightKind,
    pub force_model: ForceModel,
    pub sunlit: SunlitSpacecraft,
    /// Radius of the planet, in m.
    pub radius_m: f64,
    /// The row of an earlier leg that it continues from.
    begun: Option<FlightRow>,
}

/// A leg's flight and what its encounter depends on.
#[derive(Clone)]
pub(super) struct Met {
    pub flight: SimulatedFlight,
    pub sensitivity: Sensitivity,
}

/// How a plan may correct.
#[derive(Clone, Copy)]
pub(super) struct Room {
    pub window_s: f64,
    pub control_bounds: ControlBounds,
    /// Greatest |H|, in N m s.
    pub limit_n_m_s: f64,
}

impl<'a> Leg<'a> {
    /// A mission's.
    pub(super) fn of(fmu: &'a Fmu, mission: &Mission) -> Result<Self, Failure> {
        let settings = mission.settings(fmu.description())?;
        Self::new(fmu, Case::new(mission.name, mission.stop_s, STEP_S).with(settings), mission.stop_s)
    }

    fn new(fmu: &'a Fmu, case: Case, stop_s: f64) -> Result<Self, Failure> {
        let values = StartValues { description: fmu.description(), sets: case.sets() };
        let text = files::read_text(&fmu.folder().join("resources/spacecraft.toml"))?;
        let sunlit =
            plant::sunlit(plant::spacecraft("spacecraft.toml", &text)?, &values, Convention::Inertial)?;
        let force_model = ForceModel::new(&values, 0.0)?;
        let radius_m = values.real("planet.radius");
        let kind =
            FlightKind { convention: Convention::Inertial, panels: sunlit.panels.len(), has_encounter: true };
        Ok(Self { fmu, case, stop_s, kind, force_model, sunlit, radius_m, begun: None })
    }

    fn values(&self) -> StartValues<'_> {
        StartValues { description: self.fmu.description(), sets: self.case.sets() }
    }

    /// Its time of an epoch in s past J2000 TDB.
    pub(super) fn time_s(&self, epoch_s: f64) -> f64 {
        epoch_s - self.force_model.epoch_minus_time_s
    }

    /// With another velocity at the start.
    pub(super) fn changed(&self, change_m_s: &Vector) -> Self {
        let velocity_m_s = self.values().vector("orbit.velocity") + change_m_s;
        Self { case: self.case.clone().set("orbit.velocity", velocity_m_s), ..self.clone() }
    }

    /// With another scale of sunlight.
    pub(super) fn brighter(&self, scale: f64) -> Self {
        Self { case: self.case.clone().set("solar.scale", scale), ..self.clone() }
    }

    /// From a row of a flight on, with its state and momentum.
    pub(super) fn from(&self, row: &FlightRow) -> Result<Self, Failure> {
        let motion = row.motion.ok_or("the flight: found no motion")?;
        let case = self.case.clone();
        let case = case
            .set("start.epoch", self.values().real("start.epoch") + row.time_s)
            .set("orbit.position", motion.from_sun.position_m)
            .set("orbit.velocity", motion.from_sun.velocity_m_s);
        Ok(Self { begun: Some(row.clone()), ..Self::new(self.fmu, case, self.stop_s - row.time_s)? })
    }

    /// The momentum that it continues with, in the body frame as it stands in a window.
    fn momentum(&self, window: &Window) -> Settings {
        let Some(row) = &self.begun else { return Settings::new() };
        let inertial_from_body = window.inertial_from_body(&self.sunlit, row, window.start_s);
        set("start.momentum", inertial_from_body.inverse() * row.momentum_n_m_s)
    }

    /// Arrays and place of the Sun of a window.
    fn inputs(&self, window: &Window) -> Settings {
        let [offset_rad, windmill_rad, azimuth_rad, elevation_rad] =
            [Control::Offset, Control::Windmill, Control::Azimuth, Control::Elevation]
                .map(|it| window.controls.get(it));
        let panels = window.sides.iter().zip(1..).flat_map(|(side, number)| {
            set(&format!("panel[{number}].sunOffsetCommand"), offset_rad + windmill_rad * side)
        });
        let place = [set("downlink.sunAzimuth", azimuth_rad), set("downlink.sunElevation", elevation_rad)];
        panels.chain(place.concat()).collect()
    }

    /// The case with a plan's windows from its start on, and what they set later; none: arrays as the mission has them.
    fn by(&self, windows: &[Window]) -> (Case, impl FnMut(crate::case::RowReader<'_>) -> Settings) {
        let commanded = |number| set(&format!("panel[{number}].control"), "command");
        let start = windows.first().map_or_else(Settings::new, |first| {
            let panels = (1..=self.kind.panels).flat_map(commanded);
            panels.chain(self.inputs(first)).chain(self.momentum(first)).collect()
        });
        let by_window: Vec<(f64, Settings)> =
            windows.iter().map(|window| (window.start_s, self.inputs(window))).collect();
        let steer = move |row: crate::case::RowReader<'_>| {
            let now = by_window.iter().rfind(|(start_s, _)| *start_s <= row.time_s + SAME_S);
            now.map_or_else(Settings::new, |(_, inputs)| inputs.clone())
        };
        (self.case.clone().with(start), steer)
    }

    /// Simulates it by a plan's windows; none: arrays as the mission has them.
    pub(super) fn simulated(&self, windows: &[Window]) -> Result<SimulatedFlight, Failure> {
        let (case, mut steer) = self.by(windows);
        self.kind.simulate((&case.grid(self.stop_s, STEP_S), self.fmu), &mut steer)
    }

    /// The same with what its encounter depends on.
    pub(super) fn met(&self, windows: &[Window]) -> Result<Met, Failure> {
        let flight = self.simulated(windows)?;
        let sensitivity = self.sensitivity(&flight, windows)?;
        Ok(Met { flight, sensitivity })
    }

    fn sensitivity(&self, flight: &SimulatedFlight, windows: &[Window]) -> Result<Sensitivity, Failure> {
        let mut sunlit = self.sunlit.clone();
        if !windows.is_empty() {
            sunlit.followed_suns.fill(None);
        }
        Ok(Sensitivity::new(flight, &self.force_model, &sunlit)?)
    }

    /// Time (s) and altitude (m) of the closest approach of a flight past the planet, as the FMU reports them.
    pub(super) fn passed(&self, windows: &[Window], arrival_s: f64) -> Result<[f64; 2], Failure> {
        let (case, mut steer) = self.by(windows);
        let stop_s = ((arrival_s + BEHIND_S) / FINE_S).ceil() * FINE_S;
        let names = ["encounter.lastTime", "encounter.lastAltitude"];
        let recorded = case.grid(stop_s, FINE_S).steer(self.fmu, &names, &mut steer)?;
        Ok([recorded.last(0), recorded.last(1)])
    }

    /// With the velocity at the start that leads these windows to an aimpoint with its time of arrival.
    pub(super) fn led(&self, windows: &[Window], aimpoint: &BPlaneAimpoint) -> Result<(Self, Met), Failure> {
        let mut leg = self.clone();
        for _ in 0..ROUNDS {
            let met = leg.met(windows)?;
            let miss = aimpoint.miss(&met.sensitivity.encounter);
            if miss.xy().norm() < LED_M && miss.z.abs() < LED_S {
                return Ok((leg, met));
            }
            let change = met.sensitivity.desired_in_time(0.0, [miss.x, miss.y], miss.z);
            leg = leg.changed(&change.ok_or("found no velocity that leads to the aim")?.delta_v_m_s);
        }
        Err(format!("found no flight to the aim in {ROUNDS}").into())
    }

    /// Windows of its time, on the baseline of the arrays.
    pub(super) fn layout(&self, window_s: f64, control_bounds: ControlBounds) -> Layout {
        let values = self.values();
        let whole = Layout::of_downlinks(Vec::new(), control_bounds, 0.0);
        let mut layout = Layout {
            arrays_are_frozen: false,
            window_s,
            downlinks_s: None,
            sides: self.sunlit.windmill_sides().collect(),
            ..whole
        };
        layout.corridor.min_suns = values.real("articulation.minimumSuns");
        layout.corridor.max_suns = values.real("articulation.maximumSuns");
        layout
    }

    /// A plan's, which begins with windows in force.
    fn task(&self, room: &Room, windows: &[Window], has_aim: bool) -> PlanTask {
        let in_force =
            windows.iter().map(|it| ActiveControls { at_s: it.start_s, controls: it.controls }).collect();
        // A square in the circle.
        let side_m = TOLERANCE_M * core::f64::consts::FRAC_1_SQRT_2;
        PlanTask {
            layout: Layout { in_force, ..self.layout(room.window_s, room.control_bounds) },
            limit: Limit {
                momentum_n_m_s: room.limit_n_m_s,
                size: MomentumSize::Length,
                margin: 0.0,
                covariance: None,
            },
            dumps: 0,
            least: Least::Tilt,
            budget_s: 0.0,
            target: has_aim.then_some(Target { tolerance: [Some(side_m), Some(side_m), None] }),
        }
    }

    /// Where plans may move the encounter of these windows to.
    pub(super) fn reachable(
        &self,
        room: &Room,
        windows: &[Window],
        aimpoint: &BPlaneAimpoint,
    ) -> Result<Reachable, Failure> {
        let mut sought = Sought { leg: self, aimpoint: Some(aimpoint) };
        let simulated = sought.simulate(windows, &[])?;
        Ok(reachable(&self.task(room, windows, true), &self.sunlit, &simulated, &mut sought)?)
    }

    /// A plan whose momentum stays below the limit, and which meets an aimpoint to a kilometre if there is one; `windows` are those before it.
    pub(super) fn planned(
        &self,
        room: &Room,
        windows: &[Window],
        aimpoint: Option<&BPlaneAimpoint>,
    ) -> Result<MomentumPlan, Failure> {
        let mut sought = Sought { leg: self, aimpoint };
        let simulated = sought.simulate(windows, &[])?;
        let task = self.task(room, windows, aimpoint.is_some());
        let found = plan(&task, &self.sunlit, &simulated, &mut sought)?;
        // What counts is the flight, not how near the linear plan came to it.
        let miss_m = found.flight.encountered.as_ref().map_or(0.0, |it| it.miss.xy().norm());
        let greatest_n_m_s = found.greatest_n_m_s()[1];
        if found.dumps.is_empty() && greatest_n_m_s <= room.limit_n_m_s && miss_m <= TOLERANCE_M {
            return Ok(found);
        }
        Err(format!(
            "found no plan that keeps its limits from {:.1} d before the encounter on: {} dumps, {greatest_n_m_s:.2} of {} N m s, \
             {:.2} km off after {} flights, planned to {:.3} N m s",
            self.stop_s / DAY_S,
            found.dumps.len(),
            room.limit_n_m_s,
            miss_m / 1e3,
            found.rounds,
            found.difference_n_m_s(),
        )
        .into())
    }
}

/// A plan of a leg that is sought.
struct Sought<'a, 'f> {
    leg: &'a Leg<'f>,
    aimpoint: Option<&'a BPlaneAimpoint>,
}

impl Simulates for Sought<'_, '_> {
    fn simulate(&mut self, windows: &[Window], _: &[PlannedDump]) -> Result<SimulatedFlight, Failure> {
        let mut flight = self.leg.simulated(windows)?;
        if let Some(aimpoint) = self.aimpoint {
            let sensitivity = self.leg.sensitivity(&flight, windows)?;
            flight.encountered = Some(aimpoint.encountered(&sensitivity, &flight.rows));
        }
        Ok(flight)
    }
}

/// What a study found, or why it has no plan.
pub(super) fn planned<T>(run: &Run<'_>, found: Result<T, Failure>) -> Result<T, StudyError> {
    found.map_err(|error| StudyError::Plan { case: run.study.to_owned(), why: error.to_string() })
}

/// Windows from a time on, by a clock that is 0 there.
pub(super) fn windows_from(windows: &[Window], at_s: f64) -> Vec<Window> {
    let left = windows.iter().filter(|window| window.stop_s > at_s + SAME_S);
    let shifted = left.map(|window| Window {
        start_s: (window.start_s - at_s).max(0.0),
        stop_s: window.stop_s - at_s,
        ..window.clone()
    });
    shifted.collect()
}
