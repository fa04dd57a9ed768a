//! Models and caches of a simulation, and the work that is done with them.

use crate::environment::ephemeris::Ephemeris;
use crate::momentum::WorkKind;
use crate::plant::settings::digest::Digest;
use crate::plant::settings::work::{Work, WorkExceeded};
use crate::plant::sources::Sources;
use crate::radiation::SolarModel;
use crate::spacecraft::Material;

/// Models of planets, surfaces and sources, which the flight and its forks use alike; none is saved.
#[derive(Clone, Debug)]
pub struct SimulationModels {
    /// Planets.
    pub ephemeris: Ephemeris,
    /// The spacecraft in sunlight, where its materials can be set; else as it was prepared.
    pub solar: Option<SolarModel>,
    /// Digest of the settings on which loads depend, and of what is set of path and attitude.
    pub digest: Digest,
    /// Sources of loads.
    pub sources: Sources,
    /// Work of the step so far.
    pub work: Work,
}

impl Default for SimulationModels {
    fn default() -> Self {
        let (ephemeris, sources) = (Ephemeris::default(), Sources::default());
        Self { ephemeris, solar: None, digest: Digest::default(), sources, work: Work::new(u32::MAX, 0) }
    }
}

impl SimulationModels {
    /// Sets the material with this index where it differs from the present one; allocates nothing.
    pub fn set_material(&mut self, place: usize, material: &Material) {
        let Self { solar, sources, .. } = self;
        let Some(solar) = solar.as_mut().filter(|it| it.materials().get(place) != Some(material)) else {
            return;
        };
        solar.set_material(place, material);
        sources.set_material(place, material);
    }

    /// A step begins: nothing spent of `limit` units of about a microsecond.
    pub(crate) fn begin_work(&mut self, limit: u32) {
        self.ephemeris.count_from_here();
        self.work = Work::new(limit, self.ephemeris.evaluations());
    }

    /// Counts work, the flight having come to `time_s`.
    ///
    /// # Errors
    /// More was spent than may be.
    pub(crate) fn spend(&mut self, kind: WorkKind, units: u32, time_s: f64) -> Result<(), WorkExceeded> {
        self.work.spend(kind, units, self.ephemeris.evaluations(), time_s)
    }
}
