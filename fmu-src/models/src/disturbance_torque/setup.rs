//! The model and its immutable setup: the spacecraft.

use fmi_export::{Context, Model, SetupError};
use physics::spacecraft::Spacecraft;
use serde::Serialize;

use crate::common::center::{CenterBodies, CenterBody, center_of};
use crate::common::effects::check_start;
use crate::common::optics::SettableMaterials;

/// The memoryless disturbance model.
pub struct DisturbanceTorque;

/// Context of every call of the model.
pub(super) type Plan<'a> = Context<'a, DisturbanceTorque>;

/// The spacecraft of an instance.
#[derive(Clone, Debug, Serialize)]
pub struct DisturbanceSetup {
    /// As read from the file.
    pub spacecraft: Spacecraft,
    /// The centre of its orbit by its file, by which the defaults of the parameters go.
    #[serde(skip)]
    pub center: CenterBody,
    /// Materials whose numbers are parameters.
    #[serde(skip)]
    pub optics: SettableMaterials,
    /// The faces reported one by one, with the panel each belongs to; empty unless the file asks for that.
    #[serde(skip)]
    pub reported_faces: Vec<crate::common::spacecraft::ReportedFace>,
}

impl DisturbanceSetup {
    /// From TOML text.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, SetupError> {
        let spacecraft = Spacecraft::from_toml(file, text).map_err(|error| SetupError(error.to_string()))?;
        check_start(file, &spacecraft, DisturbanceTorque::NAME)?;
        let reported_faces = crate::common::spacecraft::reported_faces(file, &spacecraft)?;
        let center = CenterBodies::new(file, &spacecraft)?.body(center_of(&spacecraft));
        Ok(Self {
            optics: SettableMaterials::new(&spacecraft, center.data.body, DisturbanceTorque::NAME),
            center,
            spacecraft,
            reported_faces,
        })
    }
}
