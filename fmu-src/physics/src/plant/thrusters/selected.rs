//! Selection of thrusters by torque about a centre of mass, made anew where that or the feed of the tanks changes.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::plant::settings::reaction_control_settings::Feed;
use crate::propulsion::ThrusterSelection;
use crate::spacecraft::{MOST_THRUSTERS, ThrusterSet};

/// What thrusters are selected for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// A dump.
    Dump,
    /// The attitude, while those of a set give a delta-v.
    Attitude { burning: Option<ThrusterSet> },
}

/// Why no thrusters give torque all ways.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unserved {
    /// The thrusters that give the torque are not fed.
    Unfed,
    /// No thrusters give the torque about this centre of mass, fed or not.
    OneSided,
}

/// How many dumps thrusters did not carry out, or not to their end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct UnservedDumps {
    /// For want of propellant.
    pub unfed: u32,
    /// For want of thrusters that give torque all ways about the centre of mass.
    pub one_sided: u32,
}

impl UnservedDumps {
    /// Counts one.
    pub(super) fn count(&mut self, unserved: Unserved) {
        let count = match unserved {
            Unserved::Unfed => &mut self.unfed,
            Unserved::OneSided => &mut self.one_sided,
        };
        *count = count.saturating_add(1);
    }
}

/// Data that determine a selection.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Basis {
    center_of_mass_body_m: Vector3<f64>,
    purpose: Purpose,
    fed: [bool; MOST_THRUSTERS],
}

/// The last selection; a cache.
#[derive(Clone, Debug, Default)]
pub(super) struct Selected(Option<(Basis, Result<ThrusterSelection, Unserved>)>);

impl Selected {
    /// The thrusters for this that are fed.
    ///
    /// # Errors
    /// They do not give torque all ways.
    pub(super) fn about(
        &mut self,
        feed: &Feed<'_>,
        purpose: Purpose,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Result<&ThrusterSelection, Unserved> {
        let settings = feed.settings;
        let fed = core::array::from_fn(|k| k < settings.thrusters.len() && feed.feeds(k));
        let basis = Basis { center_of_mass_body_m: *center_of_mass_body_m, purpose, fed };
        if self.0.as_ref().is_none_or(|(last, _)| *last != basis) {
            self.0 = None;
        }
        let (_, selection) = self.0.get_or_insert_with(|| {
            let of = |is_fed: &dyn Fn(usize) -> bool| match purpose {
                Purpose::Dump => settings.dump_selection(is_fed, center_of_mass_body_m),
                Purpose::Attitude { burning } => {
                    settings.attitude_selection(burning, is_fed, center_of_mass_body_m)
                }
            };
            let selected = of(&|k| fed[k]).map_err(|_| match of(&|_| true) {
                Ok(_) => Unserved::Unfed,
                Err(_) => Unserved::OneSided,
            });
            (basis, selected)
        });
        selection.as_ref().map_err(|unserved| *unserved)
    }
}
