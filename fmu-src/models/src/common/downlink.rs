//! Direction of the Sun in downlinks: requests by inputs, and the reports of it.

use fmi_export::{Boolean, Real, Values, Variables};
use physics::attitude::SunAngles;
use physics::constants::{HALF_TURNS_RAD, QUARTER_TURNS_RAD};
use physics::guidance::downlink::sun_direction::SunRequest;

/// The file of commands over time in an FMU.
pub(crate) const TIMELINE_FILE: &str = "timeline.toml";

/// Refusal of a keep-in zone without a direction.
pub(crate) const ZERO_KEEP_IN_AXIS: &str =
    "keepIn.axis: found (0, 0, 0), allowed: a vector of any length but zero";

/// Downlinks.
#[derive(Variables)]
pub struct DownlinkVariables {
    /// Azimuth of the Sun in the body frame during downlinks, from -Y toward +X, with momentum.strategy dumpsOnly. Where both
    /// angles are 0 the timeline's count, else the Sun stands on -Y. As near as Sun, Earth and antennas allow.
    #[input(unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1], start = 0.0)]
    pub sun_azimuth: Real,
    /// Its elevation, positive toward -Z.
    #[input(unit = "rad", display = "deg", min = QUARTER_TURNS_RAD[0], max = QUARTER_TURNS_RAD[1], start = 0.0)]
    pub sun_elevation: Real,
    /// Whether downlinks are turned by 180 deg about the Sun line: the torque of sunlight across it changes its sign, and there is
    /// no link.
    #[input(start = false)]
    pub alternate: Boolean,
    /// Whether a downlink lasts.
    #[output]
    pub active: Boolean,
    /// Whether Sun, Earth and antennas keep the Sun from the place that it was to have.
    #[output]
    pub clamped: Boolean,
}

impl DownlinkVariables {
    /// Reads the request of the inputs.
    pub fn request(&self, values: &Values) -> SunRequest {
        SunRequest {
            sun: SunAngles {
                azimuth_rad: values.real(self.sun_azimuth),
                elevation_rad: values.real(self.sun_elevation),
            },
            alternate: values.boolean(self.alternate),
            ..SunRequest::default()
        }
    }
}

/// A sentence for a command, named by `command`, whose roll axis lies along its boresight.
pub(crate) fn roll_warning(command: &str) -> String {
    format!(
        "{command} has its body roll axis along the boresight, which leaves the turn about it open, and -Y or +Z stands in: set \
         bodyRoll (-Y unless it is set) across the boresight"
    )
}
