//! A mission with what a plan needs of it, and its flights.

use std::{ops::Deref, path::Path};

use ::files::Scratch;
use inputs::plan::{PlanFile, keys::Activity};
use nalgebra::{Matrix4, Vector3};

use super::{
    super::{flights::SimulatedMission, options::FilePlan, progress::Progress},
    flyby_task::flyby_task,
    layout::{orbit_layout, sets_of},
    prepared::Prepared,
    update::updated,
    written,
};
use crate::{
    Failure,
    flyby::FlybyTask,
    momentum::{
        Convention, Limit,
        plan::{Least, PlanProblem, PlanTask, PlannedDump, Simulates},
        simulated::SimulatedFlight,
        windows::{Window, WindowKind},
    },
};

/// Names of the files.
pub(super) const NAMES: [&str; 6] =
    ["timeline.toml", "mission.toml", "plan.csv", "windows.csv", "plan.svg", "plan.json"];

/// A mission with what a plan needs of it.
pub(super) struct Planned<'a> {
    pub options: &'a FilePlan,
    /// The plan file, its times by the clock of the mission, and what it names.
    prepared: Prepared,
    pub simulated: SimulatedFlight,
    /// Aim of a plan with a flyby.
    pub flyby_task: Option<FlybyTask>,
    pub task: PlanTask,
    pub progress: Progress,
    // The folder of an updated mission, as long as it is in use.
    _folder: Option<Scratch>,
}

impl Deref for Planned<'_> {
    type Target = Prepared;

    fn deref(&self) -> &Prepared {
        &self.prepared
    }
}

impl<'a> Planned<'a> {
    /// Reads what the plan file names, and simulates the mission as it is.
    pub(super) fn open(options: &'a FilePlan, file: &PlanFile) -> Result<Self, Failure> {
        let progress = Progress::begin(options.quiet);
        let template = options.template.as_deref();
        let mut prepared = Prepared::new(file, template)?;
        let mut keeps = None;
        if let Some(at) = &file.update {
            let (mut updated, folder) = updated(file, at, &prepared.mission)?;
            updated.update = None;
            prepared = Prepared::new(&updated, template)?;
            prepared.file.update.clone_from(&file.update);
            keeps = Some(folder);
        }
        let (aim, cruise) = (prepared.aim.take(), prepared.cruise.take());
        let Prepared { file, mission, timeline, sunlit, refit, .. } = &prepared;
        let mut simulated = mission.simulate(None)?;
        let flyby_task = file
            .flyby
            .as_ref()
            .zip(aim)
            .map(|(at, aim)| flyby_task(file, (&at.it, aim), (mission, sunlit), &simulated));
        let flyby_task = flyby_task.transpose()?;
        simulated.encountered =
            flyby_task.as_ref().map(|it| it.aimpoint.encountered(&it.first, &simulated.rows));
        let layout = match cruise {
            Some(layout) => layout,
            None => orbit_layout(file, mission, timeline, &simulated)?,
        };
        let limit = Limit {
            momentum_n_m_s: file.momentum.limit_n_m_s.unwrap_or_else(|| mission.least_threshold_n_m_s()),
            size: mission.convention().into(),
            margin: file.momentum.margin,
            covariance: refit.as_ref().map(|it| Matrix4::from(it.covariance).transpose()),
        };
        let least = if mission.is_in_orbit() { Least::Momentum } else { Least::Tilt };
        let target = flyby_task.as_ref().map(FlybyTask::target);
        let (dumps, budget_s) = (file.momentum.dumps as usize, options.budget_s);
        let task = PlanTask { layout, limit, dumps, least, budget_s, target };
        Ok(Self { options, prepared, simulated, flyby_task, task, progress, _folder: keeps })
    }
}

impl Planned<'_> {
    /// The mission to plan.
    pub(super) fn problem(&self) -> PlanProblem<'_> {
        PlanProblem { task: &self.task, sunlit: &self.sunlit, simulated: &self.simulated }
    }

    /// Momentum after a dump, body frame, in N m s.
    pub(super) fn body(&self, windows: &[Window], dump: &PlannedDump) -> Vector3<f64> {
        self.problem().body_momentum_n_m_s(windows, dump)
    }

    /// Writes timeline and mission of a plan into a folder.
    pub(super) fn write_into(
        &self,
        folder: &Path,
        (windows, dumps): (&[Window], &[PlannedDump]),
        activity: Option<(&Activity, [f64; 2])>,
    ) -> Result<[(&'static str, String); 2], Failure> {
        let bodies = |dump: &PlannedDump| self.body(windows, dump);
        let text = self.timeline.text(&self.mission, (windows, dumps, &self.task.layout), &bodies, activity);
        // In an orbit phase the arrays stay as they are.
        let panels = if self.mission.is_in_orbit() { 0 } else { self.sunlit.panels.len() };
        let start = self.start_momentum_body_n_m_s(windows);
        let start = start.map(|it| ("start.momentum".to_owned(), it.as_slice().to_vec()));
        let sets: Vec<_> = self.refit.iter().flat_map(sets_of).chain(start).collect();
        let mission = written::mission(&self.mission, folder, panels, &sets)?;
        Ok([(NAMES[0], text), (NAMES[1], mission)])
    }

    /// Momentum of the mission's start in the body frame of a first window that is free, which the plan turns; in N m s.
    fn start_momentum_body_n_m_s(&self, windows: &[Window]) -> Option<Vector3<f64>> {
        let (row, window) = (self.simulated.rows.first()?, windows.first()?);
        let is_turned = window.kind == WindowKind::Free
            && self.sunlit.convention == Convention::Inertial
            && row.momentum_n_m_s != Vector3::zeros();
        let inertial_from_body =
            is_turned.then(|| window.inertial_from_body(&self.sunlit, row, row.time_s))?;
        Some(inertial_from_body.inverse() * row.momentum_n_m_s)
    }

    /// The mission of a plan, in a folder that lasts as long as it is in use.
    pub(super) fn open_plan(
        &self,
        plan: (&[Window], &[PlannedDump]),
        activity: Option<(&Activity, [f64; 2])>,
    ) -> Result<(SimulatedMission, Scratch), Failure> {
        let folder = Scratch::new()?;
        for (name, text) in self.write_into(folder.path(), plan, activity)? {
            folder.write(name, text)?;
        }
        let template = self.options.template.as_deref();
        let path = folder.path().join(NAMES[1]);
        let mut mission = SimulatedMission::open([&path, &self.mission.mission.file], template, &[])?;
        mission.rows_s = self.mission.rows_s;
        Ok((mission, folder))
    }

    /// Simulates a plan.
    pub(super) fn simulate_plan(
        &self,
        windows: &[Window],
        dumps: &[PlannedDump],
        activity: Option<(&Activity, [f64; 2])>,
    ) -> Result<SimulatedFlight, Failure> {
        let (mission, _folder) = self.open_plan((windows, dumps), activity)?;
        let mut flight = mission.simulate(None)?;
        if let Some(flyby_task) = &self.flyby_task {
            flyby_task.judge(&mut flight, &self.sunlit)?;
        }
        Ok(flight)
    }

    /// Simulates a plan with other seeds: greatest |H| and dumps of each flight.
    pub(super) fn simulate_seeds(
        &self,
        windows: &[Window],
        dumps: &[PlannedDump],
    ) -> Result<Vec<(f64, u32)>, Failure> {
        let count = self.options.seeds;
        if count == 0 {
            return Ok(Vec::new());
        }
        let (mission, _folder) = self.open_plan((windows, dumps), None)?;
        let bar = terminal::progress(count.into(), "seeds", self.options.quiet);
        let flights = (1..=count).map(|seed| {
            let flight = mission.simulate(Some(seed))?;
            bar.inc(1);
            Ok((flight.greatest(self.task.limit.size).0, flight.rows.last().map_or(0, |row| row.dumps)))
        });
        let flights = flights.collect();
        bar.finish_and_clear();
        flights
    }
}

impl Simulates for &Planned<'_> {
    fn simulate(&mut self, windows: &[Window], dumps: &[PlannedDump]) -> Result<SimulatedFlight, Failure> {
        self.simulate_plan(windows, dumps, None)
    }

    fn progress(&mut self, doing: &str) {
        self.progress.say(doing);
    }
}
