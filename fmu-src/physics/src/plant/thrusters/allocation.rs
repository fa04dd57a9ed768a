//! Allocation of torque to thrusters: selections about a centre of mass, made anew where that or the feed of the tanks changes.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::plant::settings::reaction_control_settings::{Feed, Purpose, ReactionControlSettings};
use crate::propulsion::{PropellantState, ThrusterSelection};
use crate::spacecraft::MOST_THRUSTERS;

/// Reason why no thrusters give torque in both senses about every axis.
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
    /// For want of thrusters that give torque in both senses about every axis through the centre of mass.
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

/// The last selection for one purpose.
type Selected = Option<(Basis, Result<ThrusterSelection, Unserved>)>;

/// Settings of thrusters and tanks, with the last selections made from them; a cache that no state holds.
#[derive(Clone, Debug, Default)]
pub struct ThrusterAllocator {
    /// Settings of thrusters and tanks.
    pub settings: ReactionControlSettings,
    /// For the attitude and for dumps.
    selected: [Selected; 2],
}

impl ThrusterAllocator {
    /// Allocator without selections yet.
    pub fn new(settings: ReactionControlSettings) -> Self {
        Self { settings, ..Self::default() }
    }

    /// Returns the feed of the tanks at `time_s` and the fed thrusters selected for this purpose about this centre of mass.
    ///
    /// # Errors
    /// They do not give torque in both senses about every axis.
    pub(super) fn select<'a>(
        &'a mut self,
        propellant: &'a PropellantState,
        time_s: f64,
        purpose: Purpose,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Result<(Feed<'a>, &'a ThrusterSelection), Unserved> {
        let Self { settings, selected } = self;
        let settings = &*settings;
        let feed = Feed { settings, propellant, time_s };
        let selected = &mut selected[usize::from(purpose == Purpose::Dump)];
        let fed = core::array::from_fn(|k| k < settings.thrusters.len() && feed.feeds(k));
        let basis = Basis { center_of_mass_body_m: *center_of_mass_body_m, purpose, fed };
        if selected.as_ref().is_none_or(|(last, _)| *last != basis) {
            *selected = None;
        }
        let (_, selection) = selected.get_or_insert_with(|| {
            let select =
                |is_fed: &dyn Fn(usize) -> bool| settings.selection(purpose, is_fed, center_of_mass_body_m);
            let selection = select(&|k| fed[k]).map_err(|_| match select(&|_| true) {
                Ok(_) => Unserved::Unfed,
                Err(_) => Unserved::OneSided,
            });
            (basis, selection)
        });
        selection.as_ref().map(|selection| (feed, selection)).map_err(|unserved| *unserved)
    }
}
