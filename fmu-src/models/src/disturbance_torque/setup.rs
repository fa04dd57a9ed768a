//! The model and its immutable setup: the spacecraft.

use fmi_export::{Context, SetupError};
use physics::spacecraft::Spacecraft;
use serde::Serialize;

/// The memoryless disturbance model.
pub struct DisturbanceTorque;

/// What every call of the model is given.
pub type Plan<'a> = Context<'a, DisturbanceTorque>;

/// The spacecraft of an instance.
#[derive(Clone, Debug, Serialize)]
pub struct DisturbanceSetup {
    /// As read from the file.
    pub spacecraft: Spacecraft,
    /// The faces reported one by one, with the panel each belongs to; empty unless the file asks for that.
    #[serde(skip)]
    pub reported_faces: Vec<crate::common::spacecraft::ReportedFace>,
}

impl DisturbanceSetup {
    /// From TOML text.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, SetupError> {
        let spacecraft = Spacecraft::from_toml(file, text).map_err(|error| SetupError(error.to_string()))?;
        let reported_faces = crate::common::spacecraft::reported_faces(file, &spacecraft)?;
        Ok(Self { spacecraft, reported_faces })
    }
}
