//! Which thrusters give which torque about a centre of mass: worked out where it is another.

use nalgebra::Vector3;

use crate::plant::settings::reaction_control_settings::ReactionControlSettings;
use crate::propulsion::ThrusterSelection;
use crate::spacecraft::ThrusterSet;

/// What thrusters are selected for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// A dump.
    Dump,
    /// The attitude, while those of a set give a delta-v.
    Attitude { burning: Option<ThrusterSet> },
}

/// The last selection; a cache.
#[derive(Clone, Debug, Default)]
pub(super) struct Selected(Option<(Vector3<f64>, Purpose, Option<ThrusterSelection>)>);

impl Selected {
    /// The thrusters for this, none where they do not give torque all ways.
    pub(super) fn about(
        &mut self,
        settings: &ReactionControlSettings,
        purpose: Purpose,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Option<&ThrusterSelection> {
        if self.0.as_ref().is_none_or(|(center, last, _)| center != center_of_mass_body_m || *last != purpose)
        {
            self.0 = None;
        }
        let (_, _, selection) = self.0.get_or_insert_with(|| {
            let found = match purpose {
                Purpose::Dump => settings.dump_selection(center_of_mass_body_m),
                Purpose::Attitude { burning } => settings.attitude_selection(burning, center_of_mass_body_m),
            };
            (*center_of_mass_body_m, purpose, found.ok())
        });
        selection.as_ref()
    }
}
