//! Cases simulated through MomentumPlant as flights that the planner reads.

use loader::Fmu;
use planner::{
    Failure,
    momentum::{Convention, plant, simulated::SimulatedFlight},
};

use crate::case::{Case, Row};
use crate::settings::Settings;

/// What of a flight is recorded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FlightKind {
    /// Which momentum is integrated.
    pub convention: Convention,
    /// Panels of the spacecraft.
    pub panels: usize,
    /// Whether the motion to an encounter counts.
    pub has_encounter: bool,
}

impl FlightKind {
    /// Simulates a case; what `steer` answers to a recorded point is set there.
    ///
    /// # Errors
    /// A flight that fails, an FMU without such outputs.
    pub(crate) fn simulate(
        self,
        (case, fmu): (&Case, &Fmu),
        steer: &mut dyn FnMut(Row<'_>) -> Settings,
    ) -> Result<SimulatedFlight, Failure> {
        let panels: Vec<String> = (0..self.panels).map(plant::panel).collect();
        let mut names: Vec<&str> = plant::recorded(self.convention).to_vec();
        names.extend(plant::RECORDED_MOTION.iter().filter(|_| self.has_encounter));
        names.extend(panels.iter().map(String::as_str));
        let recorded = case.steer(fmu, &names, steer)?;
        let variables = &fmu.description().variables;
        let elements = names.iter().map(|name| fmu.select(name)).collect::<Result<Vec<_>, _>>()?.concat();
        let known: Vec<&str> = elements.iter().map(|position| variables[*position].name.as_str()).collect();
        let column = |name: &str| Some(recorded.columns[known.iter().position(|it| *it == name)?].clone());
        Ok(plant::flight(&recorded.times_s, &column, (self.panels, self.convention))?)
    }
}
