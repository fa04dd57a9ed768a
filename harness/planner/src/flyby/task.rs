//! Task of a flyby: the aimpoint of all flights in the B-plane, and how they meet it.

use nalgebra::Vector3;

use super::{aimpoint::BPlaneAimpoint, flight::ForceModel, sensitivity::Sensitivity};
use crate::momentum::{simulated::SimulatedFlight, target::Target, torque::SunlitSpacecraft};

/// Encounter that a plan's flights aim at.
#[derive(Clone, Debug)]
pub struct FlybyTask {
    /// Forces on the spacecraft.
    pub force_model: ForceModel,
    /// Aimpoint in the B-plane.
    pub aimpoint: BPlaneAimpoint,
    /// Distance from the aimpoint that a plan may leave, in m.
    pub tolerance_m: f64,
    /// Radius of the planet, in m.
    pub radius_m: f64,
    /// Partials of the mission as it is.
    pub first: Sensitivity,
}

impl FlybyTask {
    /// Name of the planet.
    pub fn body(&self) -> &'static str {
        self.force_model.body.data().name
    }

    /// A square within the circle of the tolerance; the time that the spacecraft takes for it, where the arrival is fixed.
    pub fn target(&self) -> Target {
        let side_m = self.tolerance_m * core::f64::consts::FRAC_1_SQRT_2;
        let excess_m_s = self.first.encounter.plane.excess_speed_m_s;
        let in_time = self.aimpoint.arrival_s.map(|_| self.tolerance_m / excess_m_s);
        Target { tolerance: [Some(side_m), Some(side_m), in_time] }
    }

    /// Gives a flight its miss of the aimpoint.
    ///
    /// # Errors
    /// A flight without an encounter.
    pub fn judge(
        &self,
        flight: &mut SimulatedFlight,
        sunlit: &SunlitSpacecraft,
    ) -> Result<Sensitivity, String> {
        let found = Sensitivity::new(flight, &self.force_model, sunlit)?;
        flight.encountered = Some(self.aimpoint.encountered(&found, &flight.rows));
        Ok(found)
    }

    /// The miss of the mission as it is: along T and R in m, of the arrival in s.
    pub fn first_miss(&self) -> Vector3<f64> {
        self.aimpoint.miss(&self.first.encounter)
    }
}
