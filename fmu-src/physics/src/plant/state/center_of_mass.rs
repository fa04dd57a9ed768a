//! Nominal centre of mass of a flight, by parameter or as an event has placed it, and how far thruster events have moved it from there.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::plant::settings::configuration::Configuration;
use crate::spacecraft::MassProperties;

/// A nominal place that holds as long as the parameter stays what it was then.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Placed {
    place_body_m: Vector3<f64>,
    parameter_body_m: Vector3<f64>,
}

/// Centre of mass as events have moved it, body frame, with every panel at angle 0 and full tanks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CenterOfMass {
    placed: Option<Placed>,
    /// From the nominal place since the last thruster event, in m; none while nothing moves it.
    pub(crate) shift_body_m: Option<Vector3<f64>>,
}

impl CenterOfMass {
    /// An event places it there.
    pub(crate) fn place(&mut self, configuration: &Configuration, place_body_m: Vector3<f64>) {
        self.placed =
            Some(Placed { place_body_m, parameter_body_m: configuration.wet_mass.center_of_mass_body_m });
    }

    /// A parameter that is set anew rules from there on.
    pub(crate) fn reconfigured(&mut self, configuration: &Configuration) {
        self.placed =
            self.placed.filter(|it| it.parameter_body_m == configuration.wet_mass.center_of_mass_body_m);
    }

    /// Mass properties with full tanks: inertia about the centre of mass, which moves alone.
    pub(crate) fn mass_properties(&self, configuration: &Configuration) -> MassProperties {
        let mut loaded = configuration.wet_mass;
        if let Some(Placed { place_body_m, .. }) = self.placed {
            loaded.center_of_mass_body_m = place_body_m;
        }
        if let Some(shift_body_m) = self.shift_body_m {
            loaded.center_of_mass_body_m += shift_body_m;
        }
        loaded
    }
}
