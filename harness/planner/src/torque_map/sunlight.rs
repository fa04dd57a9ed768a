//! Force and torque of sunlight from any direction, and their exact derivatives, as the FMU gives them.

use fmi::{Error, Fmu, Instance, Value};
use nalgebra::Vector3;
use packing::instance::started;

use super::panels::TurnedPanels;

/// Any step: the model has no memory.
const STEP_S: f64 = 1.0;

/// A spacecraft and how it stands in sunlight.
pub struct LitSpacecraft {
    /// A DisturbanceTorque.
    pub fmu: Fmu,
    /// In the order of the FMU.
    pub panels: Vec<TurnedPanels>,
    /// From the Sun, in m.
    pub distance_m: f64,
    /// Source of the load: the last part of the outputs' names.
    pub source: &'static str,
}

/// Force and torque, body frame.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Load {
    /// About the centre of mass, in N m.
    pub torque_n_m: Vector3<f64>,
    /// In N.
    pub force_n: Vector3<f64>,
}

/// An instance that is evaluated direction by direction.
pub struct Sunlight<'a> {
    instance: Instance,
    panels: &'a [TurnedPanels],
    distance_m: f64,
    /// The Sun's position, then every panel's angle.
    inputs: Vec<u32>,
    /// Torque, then force.
    outputs: Vec<u32>,
    steps: f64,
    values: Vec<f64>,
}

impl<'a> Sunlight<'a> {
    /// An instance without a planet, at the spacecraft's distance from the Sun.
    ///
    /// # Errors
    /// An FMU without these variables, or that does not start.
    pub fn new(spacecraft: &'a LitSpacecraft) -> Result<Self, Error> {
        let fmu = &spacecraft.fmu;
        let references = |names: &[String]| -> Result<Vec<u32>, Error> {
            names.iter().map(|name| Ok(fmu.variable(name)?.value_reference)).collect()
        };
        let mut inputs = vector("sun.positionBody");
        inputs.extend((1..=spacecraft.panels.len()).map(|number| format!("panel[{number}].angle")));
        let outputs =
            ["torque", "force"].map(|what| vector(&format!("{what}.{}", spacecraft.source))).concat();
        let (inputs, outputs) = (references(&inputs)?, references(&outputs)?);
        let mut sunlight = Self {
            instance: started(fmu, "map", 0.0, &[("planet.present".to_owned(), Value::Boolean(false))])?,
            panels: &spacecraft.panels,
            distance_m: spacecraft.distance_m,
            values: vec![0.0; inputs.len()],
            inputs,
            outputs,
            steps: 0.0,
        };
        // Directional derivatives are of the last place.
        sunlight.at(&-Vector3::y())?;
        Ok(sunlight)
    }

    /// With the Sun in this direction, a unit vector.
    ///
    /// # Errors
    /// A call that failed.
    pub fn at(&mut self, sun: &Vector3<f64>) -> Result<Load, Error> {
        let (position, angles_rad) = self.values.split_at_mut(3);
        for (value, part) in position.iter_mut().zip(sun.iter()) {
            *value = part * self.distance_m;
        }
        for (value, turned) in angles_rad.iter_mut().zip(self.panels) {
            *value = turned.angle_rad(sun);
        }
        self.instance.set_reals(&self.inputs, &self.values)?;
        self.instance.do_step(self.steps * STEP_S, STEP_S, true)?;
        self.steps += 1.0;
        let mut found = [0.0; 6];
        self.instance.get_reals(&self.outputs, &mut found)?;
        let [tx, ty, tz, fx, fy, fz] = found;
        Ok(Load { torque_n_m: Vector3::new(tx, ty, tz), force_n: Vector3::new(fx, fy, fz) })
    }

    /// Torque with the Sun in this direction, and its derivatives along changes of it, panels turning along, in N m per rad.
    pub(super) fn slopes<const N: usize>(
        &mut self,
        sun: &Vector3<f64>,
        changes: [Vector3<f64>; N],
    ) -> Result<(Load, [Vector3<f64>; N]), Error> {
        let load = self.at(sun)?;
        let mut slopes = [Vector3::zeros(); N];
        for (slope, change) in slopes.iter_mut().zip(&changes) {
            let mut seed: Vec<f64> = change.iter().map(|part| part * self.distance_m).collect();
            seed.extend(self.panels.iter().map(|turned| turned.angle_rate(sun, change)));
            *slope = self.derivative(&seed)?;
        }
        Ok((load, slopes))
    }

    /// Torque's derivative by the Sun offset of these panels, in N m per rad.
    pub(super) fn slope_by_offset(
        &mut self,
        sun: &Vector3<f64>,
        panels: &[usize],
    ) -> Result<Vector3<f64>, Error> {
        self.at(sun)?;
        let mut seed = vec![0.0; self.inputs.len()];
        for &panel in panels {
            seed[3 + panel] = self.panels[panel].angle_per_offset(sun);
        }
        self.derivative(&seed)
    }

    fn derivative(&mut self, seed: &[f64]) -> Result<Vector3<f64>, Error> {
        let mut found = [0.0; 3];
        self.instance.directional_derivative(&self.outputs[..3], &self.inputs, seed, &mut found)?;
        Ok(found.into())
    }
}

fn vector(name: &str) -> Vec<String> {
    (1..=3).map(|axis| format!("{name}[{axis}]")).collect()
}
