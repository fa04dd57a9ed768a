//! Flights of a planned mission through its FMU: as it is, by the timeline of a plan, with other values at the start.

use std::{ops::Deref, path::Path};

use campaign::run::{Run, Simulated};
use fmi::{Recording, Value};
use inputs::{
    mission::{Inputs, Mission},
    plan::PlanFile,
    reading::At,
    values,
    variables::{NEVER_N_M_S, elements},
};
use nalgebra::Vector3;
use packing::assembly::spacecraft_of;
use physics::{
    guidance::timeline::{Timeline, simulation_time_s},
    momentum::Convention,
    spacecraft::{Articulation, Spacecraft},
};

use crate::{
    Failure,
    momentum::{plant, simulated::SimulatedFlight, torque::SunlitSpacecraft},
    simulation::{Flight, Simulation},
};

/// Error text for a time outside the mission.
pub(super) const OUTSIDE: &str = "found a time outside of the mission, allowed: from its start to its stop";

/// The model that is planned.
const MODEL: &str = "MomentumPlant";
/// Communication step, in s; steps change nothing in what is simulated.
const STEP_S: f64 = 3600.0;
/// The same in an orbit phase, whose downlinks begin and end at such points.
const ORBIT_STEP_S: f64 = 600.0;
/// A flight whose last row is nearer to its planet came to it: farther than any goes in such a step.
const NEAR_M: f64 = 1e8;

/// A mission that can be simulated.
pub(super) struct SimulatedMission {
    pub mission: Mission,
    simulation: Simulation,
    /// Distance of the rows that plans read, in s, where a plan gives one.
    pub rows_s: Option<f64>,
    /// Epoch of time 0 in s past J2000 TDB, where the mission begins at a date.
    pub zero_epoch_s: Option<f64>,
}

impl Deref for SimulatedMission {
    type Target = Simulation;

    fn deref(&self) -> &Simulation {
        &self.simulation
    }
}

impl SimulatedMission {
    /// Opens a mission, which messages name by its second path; values that win over its own as for `--set`.
    pub(super) fn open(
        [path, file]: [&Path; 2],
        template: Option<&Path>,
        set: &[String],
    ) -> Result<Self, Failure> {
        let run = Run {
            fmu: path.to_owned(),
            origin: Some(file.to_owned()),
            template: template.map(Path::to_owned),
            set: set.to_vec(),
            ..Run::default()
        };
        let simulated = Simulated::new(&run)?;
        let Some(mission) = simulated.mission.clone() else {
            return Err(format!("{}: found no mission, allowed: one (.toml)", file.display()).into());
        };
        let simulation = Simulation::open(&simulated, MODEL)?;
        let zero_epoch_s = simulated.zero_epoch_s(simulation.start_s);
        let opened = Self { mission, simulation, rows_s: None, zero_epoch_s };
        if opened.values().item("attitude.source").is_none() {
            let (shown, found) = (file.display(), &opened.fmu.description().model_name);
            return Err(format!(
                "{shown}: model: found {found}, allowed: {MODEL}: a plan is for its missions"
            )
            .into());
        }
        Ok(opened)
    }

    /// Refuses a mission whose downlinks cannot be planned: a plant must follow them ideally, and choose no places of the Sun itself.
    ///
    /// # Errors
    /// What is not as a plan needs it.
    pub(super) fn check_downlinks(&self) -> Result<(), Failure> {
        let shown = self.mission.file.display();
        if let Some(fmu) = &self.mission.fmu {
            let found =
                format!("found `fmu = {:?}`, which takes no other timeline", fmu.display().to_string());
            let allowed = "allowed: spacecraft or model, of which the plan's FMU is packed";
            return Err(format!("{shown}: {found}, {allowed}").into());
        }
        if let Some(Inputs::Columns(columns)) = &self.mission.inputs
            && let Some(at) = columns.iter().find(|at| at.it.0.starts_with("downlink."))
        {
            let what = "found an input that the plan commands, allowed: none of downlink.*: inputs rule over timelines";
            return Err(at.problem(&self.mission.file, what).into());
        }
        for (name, allowed) in [("attitude.source", "guided"), ("momentum.strategy", "dumpsOnly")] {
            let found = self.values().item(name).unwrap_or("none");
            if found != allowed {
                return Err(format!("{shown}: {name}: found {found}, allowed: {allowed}, for a plan").into());
            }
        }
        Ok(())
    }

    /// Its time of an instant, in s; `None` for a date where the mission has none.
    pub(super) fn time_s(&self, instant: values::Instant) -> Option<f64> {
        instant.time_s(self.zero_epoch_s)
    }

    /// The text of its timeline and what it says; `None` without one.
    pub(super) fn timeline(&self, spacecraft: &Spacecraft) -> Result<Option<(String, Timeline)>, Failure> {
        let Some(path) = &self.mission.timeline else { return Ok(None) };
        let text = files::read_text(path)?;
        let shown = path.display().to_string();
        let timeline = Timeline::of_plant(&shown, &text, spacecraft).map_err(|error| error.to_string())?;
        Ok(Some((text, timeline)))
    }

    /// A time of a plan's file, in s.
    pub(super) fn time_in_file_s<T>(
        &self,
        file: &PlanFile,
        at: &At<T>,
        instant: values::Instant,
    ) -> Result<f64, String> {
        self.time_s(instant).ok_or_else(|| {
            let what = "found a date, allowed: simulation time: the mission does not start at a date";
            file.problem(at, what)
        })
    }

    /// The same, refused outside of the mission.
    pub(super) fn time_in_mission_s(&self, file: &PlanFile, at: &At<values::Instant>) -> Result<f64, String> {
        let time_s = self.time_in_file_s(file, at, at.it)?;
        if !(time_s >= self.start_s && time_s < self.stop_s) {
            return Err(file.problem(at, OUTSIDE));
        }
        Ok(time_s)
    }

    /// Difference between the clock of a timeline and the time of the flight, in s.
    pub(super) fn clock_minus_time_s(&self, timeline: &Timeline) -> f64 {
        timeline.clock_minus_time_s(self.zero_s())
    }

    /// Epoch of time 0 in s past J2000 TDB, by the mission's start or its own.
    pub(super) fn zero_s(&self) -> f64 {
        self.zero_epoch_s.unwrap_or_else(|| self.values().real("start.epoch") - self.start_s)
    }

    /// The least `dump.threshold`, in N m s.
    pub(super) fn least_threshold_n_m_s(&self) -> f64 {
        self.values().vector("dump.threshold").min()
    }

    /// Convention of its momentum: the physical one, or components that are integrated in the body frame.
    pub(super) fn convention(&self) -> Convention {
        match self.values().item("momentum.convention") {
            Some("bodyIntegral") => Convention::BodyIntegral,
            _ => Convention::Inertial,
        }
    }

    /// Whether downlinks alternate with science; else it is in cruise, downlink throughout.
    pub(super) fn is_in_orbit(&self) -> bool {
        self.values().item("guided.phase") == Some("orbit")
    }

    /// Whether it has an encounter with a planet.
    fn has_encounter(&self) -> bool {
        let body = self.values().item("encounter.body");
        self.values().item("orbit.dynamics") == Some("nBody") && body.is_some_and(|body| body != "none")
    }

    /// The corridor of the light on the cells.
    pub(super) fn corridor(&self) -> Articulation {
        Articulation {
            min_suns: self.values().real("articulation.minimumSuns"),
            max_suns: self.values().real("articulation.maximumSuns"),
            target_suns: self.values().real("articulation.targetSuns"),
        }
    }

    /// The spacecraft in sunlight with the mission's values, the centre of mass as it is at each time.
    pub(super) fn sunlit(&self, timeline: Option<&Timeline>) -> Result<SunlitSpacecraft, Failure> {
        let mut sunlit = plant::sunlit(spacecraft_of(&self.fmu)?, &self.values(), self.convention())?;
        if let Some(timeline) = timeline {
            let clock_minus_time_s = self.clock_minus_time_s(timeline);
            let moved = timeline.events.iter().filter_map(|event| {
                Some((simulation_time_s(event.at_s, clock_minus_time_s), event.center_of_mass_body_m?))
            });
            sunlit.centers_of_mass = moved.collect();
        }
        Ok(sunlit)
    }

    /// Simulates it without dumps by thresholds; with a seed, by its own.
    pub(super) fn simulate(&self, seed: Option<u32>) -> Result<SimulatedFlight, Failure> {
        let (description, convention) = (self.fmu.description(), self.convention());
        let panels = (0..).map(plant::panel);
        let panels = panels.take_while(|name| description.variables.iter().any(|it| it.name == *name));
        let panels: Vec<String> = panels.collect();
        let mut outputs: Vec<&str> = panels.iter().map(String::as_str).collect();
        outputs.extend(plant::recorded(convention));
        if self.has_encounter() {
            outputs.extend(plant::RECORDED_MOTION);
        }
        let mut sets = Vec::new();
        if seed.is_none() {
            sets.extend(elements("dump.threshold", Vector3::repeat(NEVER_N_M_S)));
        }
        if let Some(seed) = seed.and_then(|seed| i32::try_from(seed).ok()) {
            sets.push(("noise.seed".to_owned(), Value::Integer(seed)));
        }
        let flight = Flight { sets: &sets, outputs: &outputs, ..Flight::default() };
        let (recording, ended) = self.record_until(&flight)?;
        let column = |name: &str| recording.column(name).map(|column| column.numbers());
        let flight = plant::flight(&recording.times_s, &column, (panels.len(), convention));
        let Some(why) = ended else { return Ok(flight?) };
        // A path into the planet of the encounter: a plan, or another departure, may lead past it.
        let last = flight.ok().filter(|flight| {
            let motion = flight.rows.last().and_then(|row| row.motion);
            motion.is_some_and(|motion| motion.from_body().position_m.norm() < NEAR_M)
        });
        last.map(|flight| SimulatedFlight { ended: Some(why.clone()), ..flight }).ok_or_else(|| why.into())
    }

    /// Records a flight.
    pub(super) fn record(&self, flight: &Flight<'_>) -> Result<Recording, Failure> {
        match self.record_until(flight)? {
            (recording, None) => Ok(recording),
            (_, Some(error)) => Err(error.into()),
        }
    }

    /// The same of a flight that an error may end: what was recorded until then, and the error.
    pub(super) fn record_until(&self, flight: &Flight<'_>) -> Result<(Recording, Option<String>), Failure> {
        let longest_s = (flight.stop_s.unwrap_or(self.stop_s) - self.start_s) / 8.0;
        let own_s = if self.is_in_orbit() { ORBIT_STEP_S } else { STEP_S };
        let step_s = flight.step_s.or(self.rows_s).unwrap_or(own_s).min(longest_s);
        let flown = self.fly(&Flight { step_s: Some(step_s), dumps_apart: true, ..*flight })?;
        Ok((flown.recording, flown.ended.err()))
    }
}
