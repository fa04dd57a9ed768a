//! Everything that a map tells of a spacecraft, found once for picture, table and files.

use std::{panic::resume_unwind, thread};

use loader::Error;
use nalgebra::Vector3;
use planner::momentum::{Held, Mission, Region};

use super::{
    balance::{self, Balance},
    grid::{Angles, Grid},
    options::{SourceKind, Steps},
    spacecraft::MappedSpacecraft,
    sunlight::Sunlight,
    worth::{self, Worth},
    zero_lines::{self, ZeroLine},
};

/// All directions.
const SPHERE_DEG: Angles = [180.0, 90.0];
/// Steps across the zone.
const ZONE_STEPS: [usize; 2] = [60, 60];
/// The targeted components.
const TARGETED: [usize; 2] = [0, 2];

/// A rectangle of directions and what is found in it.
pub struct Mapped {
    pub grid: Grid,
    /// Of X, Y and Z.
    pub lines: [Vec<ZeroLine>; 3],
    pub balances: Vec<Balance>,
}

/// What downlinks can do.
pub struct Attainable {
    /// What they can add to the mean torque about X and Z, in N m: 0 is the Sun on -Y.
    pub added_n_m: Region,
    /// The same at the mission's mean light.
    pub mean_added_n_m: Region,
    pub mission: Option<(Mission, Held)>,
}

/// Everything found.
pub struct Found {
    pub sphere: Mapped,
    /// The keep-in zone, if there is one.
    pub zone: Option<Mapped>,
    /// Where the whole torque is least in the zone, without one anywhere.
    pub least: (Angles, Vector3<f64>),
    /// Torque with the Sun on -Y.
    pub ahead_n_m: Vector3<f64>,
    pub worths: Vec<Worth>,
    pub attainable: Attainable,
}

impl Mapped {
    fn new(
        spacecraft: &MappedSpacecraft,
        source: SourceKind,
        limits_deg: Angles,
        steps: [usize; 2],
    ) -> Result<Self, Error> {
        let grid = Grid::new(spacecraft, source, limits_deg, steps)?;
        let requested = &grid;
        let (lines, balances) = thread::scope(|scope| {
            let of = |axis: usize| {
                scope
                    .spawn(move || zero_lines::find(&mut Sunlight::new(spacecraft, source)?, requested, axis))
            };
            let workers = [of(0), of(1), of(2)];
            let balances = Sunlight::new(spacecraft, source)
                .and_then(|mut sunlight| balance::find(&mut sunlight, requested));
            (workers.map(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic))), balances)
        });
        let [x, y, z] = lines;
        Ok(Self { grid, lines: [x?, y?, z?], balances: balances? })
    }
}

impl Found {
    /// Asks the FMU for all of it.
    pub fn new(
        spacecraft: &MappedSpacecraft,
        (source, steps): (SourceKind, Steps),
        mission: Option<Mission>,
    ) -> Result<Self, Error> {
        let quarter = steps.0 as usize;
        let sphere = Mapped::new(spacecraft, source, SPHERE_DEG, [4 * quarter, 2 * quarter])?;
        let of_zone =
            |zone_rad: [f64; 2]| Mapped::new(spacecraft, source, zone_rad.map(f64::to_degrees), ZONE_STEPS);
        let zone = spacecraft.zone_rad.map(of_zone).transpose()?;
        let allowed = &zone.as_ref().unwrap_or(&sphere).grid;
        let mut sunlight = Sunlight::new(spacecraft, source)?;
        let least = balance::least(&mut sunlight, allowed)?;
        let (ahead_n_m, worths) = worth::find(&mut sunlight, &spacecraft.panels)?;
        let attainable = Attainable::new(spacecraft, allowed, &ahead_n_m, mission);
        Ok(Self { sphere, zone, least, ahead_n_m, worths, attainable })
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
        let light = mission.as_ref().map_or(1.0, |mission| mission.mean_light(spacecraft.distance_m));
        let mean_added_n_m = added_n_m.scaled(light, [0.0; 2]);
        let mission = mission.map(|mission| {
            let held = mission.held(&added_n_m, spacecraft.distance_m, spacecraft.threshold_n_m_s);
            (mission, held)
        });
        Self { added_n_m, mean_added_n_m, mission }
    }
}
