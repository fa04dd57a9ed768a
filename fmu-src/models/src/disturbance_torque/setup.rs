//! The immutable setup: the spacecraft.

use fmi_export::SetupError;
use physics::radiation::disturbance::{DisturbanceModel, Options};
use physics::spacecraft::Spacecraft;
use serde::Serialize;

/// The spacecraft of an instance.
#[derive(Clone, Debug, Serialize)]
pub struct DisturbanceSetup {
    /// As read from the file.
    pub spacecraft: Spacecraft,
    /// Names of the faces reported one by one; empty unless the file asks for that.
    #[serde(skip)]
    pub reported_faces: Vec<String>,
}

impl DisturbanceSetup {
    /// From TOML text.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, SetupError> {
        let spacecraft = Spacecraft::from_toml(file, text).map_err(|error| SetupError(error.to_string()))?;
        let reported_faces = if spacecraft.per_plate_outputs {
            DisturbanceModel::new(&spacecraft, &Options::default())
                .map_err(|error| SetupError(format!("{file}: {error}")))?
                .face_names()
                .collect()
        } else {
            Vec::new()
        };
        Ok(Self { spacecraft, reported_faces })
    }
}
