//! The modes of guidance, and what commands each of them takes (paper 001, "Safe Modes").

use serde::{Deserialize, Serialize};

use crate::enumeration::{enumeration, file_enumerations};
use crate::guidance::pointing::command::{PointingCommand, Scenario};

file_enumerations! {
    /// How much the guidance is trusted with.
    #[derive(Default)]
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

enumeration! {
    /// Why a mode is in force.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    pub enum ModeReason {
        /// The input mode.request requests it.
        1 => Request,
        /// The timeline requests it.
        2 => Timeline,
        /// The estimated attitude had the Sun outside the keep-in zone for too long.
        3 => SunKeepIn,
        /// The estimated attitude had -Z too near the planet over the hot pole for too long.
        4 => HotPole,
        /// There is no valid estimate of the attitude; the Sun is known.
        5 => AttitudeLost,
        /// There is no valid estimate of the attitude and no Sun: it is searched for.
        6 => SunLost,
        /// The precise ephemerides contradict the Sun sensors, or end.
        7 => Ephemeris,
        /// The safing turn of the mode before came no nearer to its constraint for too long.
        8 => NoProgress,
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

    /// Whether this mode follows a scenario.
    pub fn follows(self, scenario: Scenario) -> bool {
        match self {
            Self::Operational => true,
            Self::SafeHold => scenario == Scenario::Downlink,
            Self::EarthAcquisition => false,
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
