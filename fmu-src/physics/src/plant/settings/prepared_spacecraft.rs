//! The spacecraft, prepared once for all its flights.

use crate::environment::orbit::OrbitMethod;
use crate::guidance::downlink::default_downlink::DefaultDownlink;
use crate::guidance::timeline::TimelineLaw;
use crate::radiation::SolarModel;
use crate::spacecraft::Panel;

/// The spacecraft, prepared once.
#[derive(Clone, Copy, Debug)]
pub struct PreparedSpacecraft<'a> {
    /// Panels of the spacecraft.
    pub panels: &'a [Panel],
    /// The whole of it in sunlight.
    pub solar: &'a SolarModel,
    /// Method by which the orbit is integrated.
    pub orbit_method: &'a OrbitMethod,
    /// The default downlink of its antennas.
    pub default_downlink: &'a DefaultDownlink,
    /// Commands over time, which guided flight follows.
    pub timeline: Option<TimelineLaw<'a>>,
}

impl PreparedSpacecraft<'_> {
    /// Whether a panel has a mass.
    pub(crate) fn has_panel_mass(&self) -> bool {
        self.panels.iter().any(|panel| panel.mass.is_some())
    }
}
