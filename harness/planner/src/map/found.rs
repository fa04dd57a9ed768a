//! Everything that a map tells of a spacecraft, found once for picture, table and files.

use drawing::scenes::panel_called;
use fmi::Error;
use nalgebra::Vector3;

use super::{options::Steps, spacecraft::MappedSpacecraft};
use crate::{
    momentum::{HoldableDays, Mission, Region},
    torque_map::{Angles, Grid, Mapped, Sunlight, TorqueSensitivity, least, worths},
};

/// All directions.
const SPHERE_DEG: Angles = [180.0, 90.0];
/// Steps across the zone.
const ZONE_STEPS: [usize; 2] = [60, 60];
/// The targeted components.
const TARGETED: [usize; 2] = [0, 2];

/// Momentum that downlinks can attain.
pub(super) struct Attainable {
    /// Mean torque about X and Z that they can add, in N m: 0 is the Sun on -Y.
    pub added_n_m: Region,
    /// The same at the mission's mean light.
    pub mean_added_n_m: Region,
    pub mission: Option<(Mission, HoldableDays)>,
}

/// Everything found.
pub(super) struct Found {
    pub sphere: Mapped,
    /// The keep-in zone, if there is one.
    pub zone: Option<Mapped>,
    /// Minimum of the whole torque in the zone, or anywhere without a zone.
    pub least: (Angles, Vector3<f64>),
    /// Torque with the Sun on -Y.
    pub ahead_n_m: Vector3<f64>,
    /// Torque with the Sun where a degree is weighed, and what that is worth.
    pub weighed: (Vector3<f64>, Vec<TorqueSensitivity>),
    pub attainable: Attainable,
}

impl Found {
    /// Asks the FMU for all of it.
    pub(super) fn new(
        spacecraft: &MappedSpacecraft,
        steps: Steps,
        mission: Option<Mission>,
    ) -> Result<Self, Error> {
        let quarter = steps.0 as usize;
        let sphere = Mapped::new(&spacecraft.lit, SPHERE_DEG, [4 * quarter, 2 * quarter])?;
        let of_zone =
            |zone_rad: [f64; 2]| Mapped::new(&spacecraft.lit, zone_rad.map(f64::to_degrees), ZONE_STEPS);
        let zone = spacecraft.zone_rad.map(of_zone).transpose()?;
        let allowed = &zone.as_ref().unwrap_or(&sphere).grid;
        let mut sunlight = Sunlight::new(&spacecraft.lit)?;
        let least = least(&mut sunlight, allowed)?;
        let ahead_n_m = sunlight.at(&-Vector3::y())?.torque_n_m;
        let weighed = worths(&spacecraft.lit, spacecraft.sun.angles_deg, panel_called)?;
        let attainable = Attainable::new(spacecraft, allowed, &ahead_n_m, mission);
        Ok(Self { sphere, zone, least, ahead_n_m, weighed, attainable })
    }
}

impl Attainable {
    fn new(
        spacecraft: &MappedSpacecraft,
        allowed: &Grid,
        ahead_n_m: &Vector3<f64>,
        mission: Option<Mission>,
    ) -> Self {
        let share = spacecraft.downlink.share();
        let points = allowed.nodes().map(|(_, load)| TARGETED.map(|axis| load.torque_n_m[axis]));
        let added_n_m = Region::hull(points).scaled(share, TARGETED.map(|axis| -share * ahead_n_m[axis]));
        let light = mission.as_ref().map_or(1.0, |mission| mission.mean_light(spacecraft.lit.distance_m));
        let mean_added_n_m = added_n_m.scaled(light, [0.0; 2]);
        let mission = mission.map(|mission| {
            let held = mission.held(&added_n_m, spacecraft.lit.distance_m, spacecraft.threshold_n_m_s);
            (mission, held)
        });
        Self { added_n_m, mean_added_n_m, mission }
    }
}
