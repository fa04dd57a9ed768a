//! The modes of guidance, and what commands each of them takes (paper 001, "Safe Modes").

use serde::{Deserialize, Serialize};

use crate::enumeration::enumeration;
use crate::guidance::pointing::command::{PointingCommand, Scenario};

enumeration! {
    /// How much the guidance is trusted with.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    #[serde(rename_all = "camelCase")]
    pub enum Mode {
        /// Every command is followed.
        #[default]
        1 => Operational,
        /// Downlink only, within its own keep-in zone.
        2 => SafeHold,
        /// A slow turn about the Sun line, or the search for the Sun.
        3 => EarthAcquisition,
    }
}

impl Mode {
    /// The next lower mode; the lowest is its own.
    pub fn demoted(self) -> Self {
        match self {
            Self::Operational => Self::SafeHold,
            Self::SafeHold | Self::EarthAcquisition => Self::EarthAcquisition,
        }
    }

    /// The command as this mode takes it: Safe Hold replaces all but downlink by the default downlink, and scans never.
    pub fn allowed(self, command: &PointingCommand) -> PointingCommand {
        match self {
            Self::Operational => *command,
            Self::SafeHold | Self::EarthAcquisition if command.scenario == Some(Scenario::Downlink) => {
                PointingCommand { scan: Default::default(), ..*command }
            }
            _ => PointingCommand { scenario: Some(Scenario::Downlink), ..PointingCommand::default() },
        }
    }
}
