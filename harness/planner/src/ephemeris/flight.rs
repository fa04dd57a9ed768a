//! An FMU as the source of an ephemeris: it is simulated, and its outputs say where everything is.

use std::path::Path;

use fmi::{Error, Fmu, Instance, Value};
use inputs::variables::assigned;
use nalgebra::Vector3;
use packing::instance;
use physics::{
    bodies::Body,
    enumeration::Enumerated,
    environment::{CartesianState, onboard::OnboardTarget},
};

use crate::ephemeris::{Failure, Source};

/// Parameter with the epoch at the start of a flight.
const START_EPOCH: &str = "start.epoch";
/// Parameter that says from where positions count.
const CENTER: &str = "orbit.center";

/// Parameter that names another planet that positions are shown of.
const ENCOUNTER: &str = "encounter.body";

/// Whether a target is placed as the body of an encounter.
fn is_encounter(target: OnboardTarget) -> bool {
    use OnboardTarget::{Jupiter, Mars, Mercury, Venus};
    matches!(target, Mercury | Venus | Mars | Jupiter)
}

/// A simulation that can be repeated.
pub(super) struct RepeatableSimulation {
    fmu: Fmu,
    shown: String,
    sets: Vec<(String, Value)>,
    start_s: f64,
    center: Body,
}

/// Positions and velocities in the order of the outputs: x, y, z of each.
type Outputs = [u32; 6];

impl RepeatableSimulation {
    /// An FMU with these settings, its flight starting at an epoch.
    pub(super) fn open(path: &Path, settings: &[String], start_s: f64) -> Result<Self, Failure> {
        let fmu = Fmu::open(path)?;
        let shown = path.display().to_string();
        let description = fmu.description();
        let names =
            [START_EPOCH, CENTER, "sun.positionInertial[1]", "earth.positionInertial[1]", "position[1]"];
        if let Some(name) = names.into_iter().find(|name| fmu.variable(name).is_err()) {
            return Err(format!(
                "{shown}: {} has no variable {name}, allowed: a MomentumPlant, which places Sun, Earth and spacecraft",
                description.model_name
            )
            .into());
        }
        let mut sets = assigned(description, settings)?;
        if sets.iter().any(|(name, _)| name == START_EPOCH) {
            return Err(format!("--set {START_EPOCH}: --start says when the flight begins").into());
        }
        sets.extend(fmi::parse_assignment(description, &format!("{START_EPOCH}={start_s:e}"))?);
        let mut source = Self { fmu, shown, sets, start_s, center: Body::Mercury };
        let mut instance = source.started(&source.sets)?;
        let center = instance.get(CENTER)?.to_string();
        source.center = Body::ITEMS
            .iter()
            .find(|item| item.name == center || item.value.to_string() == center)
            .map(|item| item.variant)
            .ok_or_else(|| format!("{}: {CENTER} is {center}, which no ephemeris names", source.shown))?;
        Ok(source)
    }

    fn started(&self, sets: &[(String, Value)]) -> Result<Instance, Failure> {
        instance::started(&self.fmu, "ephemeris", 0.0, sets).map_err(|error| self.in_fmu(&error).into())
    }

    /// The settings of a flight that places these targets: a planet other than the Earth as the body of an encounter, the
    /// spacecraft being held somewhere.
    fn sets_for(&self, targets: &[OnboardTarget]) -> Result<Vec<(String, Value)>, Failure> {
        let mut sets = self.sets.clone();
        if let Some(planet) = targets.iter().find(|target| is_encounter(**target)) {
            let planet = format!("{ENCOUNTER}={planet}");
            for set in ["orbit.dynamics=nBody", "orbit.source=held", "orbit.position[1]=1e10", &planet] {
                sets.extend(fmi::parse_assignment(self.fmu.description(), set)?);
            }
        }
        Ok(sets)
    }

    fn in_fmu(&self, error: &Error) -> String {
        format!("{}: {}", self.shown, Error::chain(error))
    }
}

impl Source for RepeatableSimulation {
    fn center(&self) -> Body {
        self.center
    }

    fn title(&self) -> String {
        let description = self.fmu.description();
        let sets = self.sets.iter().filter(|(name, _)| name != START_EPOCH);
        let sets: Vec<String> = sets.map(|(name, value)| format!("{name} = {value}")).collect();
        let with = if sets.is_empty() { String::new() } else { format!(" with {}", sets.join(", ")) };
        format!("{} {}{with}", description.model_name, description.guid)
    }

    fn states(
        &self,
        targets: &[OnboardTarget],
        epochs_s: &[f64],
        reported: &mut dyn FnMut() -> Result<(), Failure>,
    ) -> Result<Vec<Vec<CartesianState>>, Failure> {
        if targets.contains(&OnboardTarget::Moon) {
            return Err("--bodies moon: allowed with --kernel, as no output places the Moon".into());
        }
        let mut outputs: Vec<Outputs> = Vec::with_capacity(targets.len());
        for target in targets {
            let (position, velocity) = match target {
                OnboardTarget::Sun => ("sun.positionInertial", "sun.velocityInertial"),
                OnboardTarget::Earth => ("earth.positionInertial", "earth.velocityInertial"),
                target if is_encounter(*target) => ("encounter.position", "encounter.velocity"),
                _ => ("position", "velocity"),
            };
            let names = [position, velocity].into_iter().flat_map(|name| (1..=3).map(move |i| (name, i)));
            let mut references = Outputs::default();
            for (slot, (name, i)) in references.iter_mut().zip(names) {
                *slot = self.fmu.variable(&format!("{name}[{i}]"))?.value_reference;
            }
            outputs.push(references);
        }
        let mut instance = self.started(&self.sets_for(targets)?)?;
        let mut time_s = 0.0;
        let mut states = vec![Vec::with_capacity(epochs_s.len()); targets.len()];
        for epoch_s in epochs_s {
            let next_s = epoch_s - self.start_s;
            if next_s > time_s {
                instance.do_step(time_s, next_s - time_s, true).map_err(|error| self.in_fmu(&error))?;
                time_s = next_s;
            }
            for (outputs, states) in outputs.iter().zip(&mut states) {
                let mut values = [0.0; 6];
                instance.get_reals(outputs, &mut values)?;
                let [x, y, z, vx, vy, vz] = values;
                states.push(CartesianState {
                    position_m: Vector3::new(x, y, z),
                    velocity_m_s: Vector3::new(vx, vy, vz),
                });
            }
            reported()?;
        }
        Ok(states)
    }
}
