//! Where everything is by the ephemerides a spacecraft carries, and whether the precise ones are trusted (paper 001,
//! "Inertial pointing options").
//!
//! Operational uses the precise models alone. Safe Hold uses them until they are unavailable, then the coarse ones. Earth
//! Acquisition assumes that they failed. They are declared invalid where their Sun, in the estimated body frame, has been
//! away from the sensed one for a while, and at once where their span is left. Invalid they stay until the ground asks for
//! Operational again; they are judged anew then.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::mode::Mode;
use super::monitor::{Monitor, MonitorState};
use crate::attitude::{Attitude, angle_between_rad};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::value;

/// How far the Sun of the precise models may be from the sensed one, assumed: two degrees, a few times what Sun sensors err.
pub const SUN_TOLERANCE_RAD: f64 = 2.0 * crate::constants::DEG_RAD;

/// For how long it may be farther away, in s, assumed.
pub const SUN_PERSISTENCE_S: f64 = 10.0;

/// Where everything is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPositions {
    /// By the precise models, or by the only ones; `None` while a place is not known, or outside their span.
    pub precise: Option<EphemerisAtTime>,
    /// By the coarse models; `None` while a place is not known.
    pub coarse: Option<EphemerisAtTime>,
    /// Whether modes choose between both; otherwise the precise ones hold in every mode.
    pub by_mode: bool,
}

impl BodyPositions {
    /// The same in every mode.
    pub fn in_every_mode(surroundings: Option<EphemerisAtTime>) -> Self {
        Self { precise: surroundings, coarse: None, by_mode: false }
    }

    /// What a mode goes by.
    pub fn in_mode(&self, mode: Mode, trust: &EphemerisTrust) -> Option<&EphemerisAtTime> {
        let chosen = if self.by_mode && trust.uses_coarse(mode) { &self.coarse } else { &self.precise };
        chosen.as_ref()
    }

    /// Whether anything is known of the places.
    pub fn are_known(&self) -> bool {
        self.precise.is_some() || self.coarse.is_some()
    }
}

/// Whether the precise models are trusted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EphemerisTrust {
    is_lost: bool,
    disagreement: MonitorState,
}

impl EphemerisTrust {
    /// Whether they are valid.
    pub fn is_valid(&self) -> bool {
        !self.is_lost
    }

    /// Whether a mode goes by the coarse models where modes choose.
    pub fn uses_coarse(&self, mode: Mode) -> bool {
        match mode {
            Mode::Operational => false,
            Mode::SafeHold => self.is_lost,
            Mode::EarthAcquisition => true,
        }
    }

    /// Trusts them again, to be judged anew.
    pub fn renew(&mut self) {
        *self = Self::default();
    }

    /// Takes a sample. Where attitude or Sun are not known, or `check` is `None`, nothing contradicts the models.
    pub fn judge(
        &mut self,
        check: Option<&Monitor>,
        time_s: f64,
        places: &BodyPositions,
        sensed: Option<(Attitude, Vector3<f64>)>,
    ) {
        if !places.by_mode || self.is_lost {
            return;
        }
        let Some(precise) = &places.precise else {
            self.is_lost = places.coarse.is_some();
            return;
        };
        let angle_rad = sensed.map_or(0.0, |(estimate, sun_body)| {
            let computed = estimate.inertial_from_body().inverse() * value(&precise.to_sun());
            angle_between_rad(&computed, &sun_body)
        });
        match check {
            Some(check) => self.is_lost = check.trips(&mut self.disagreement, time_s, angle_rad),
            None => self.disagreement = MonitorState::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    //! A Sun elsewhere than sensed is believed for the persistence, and the modes go by what paper 001 lets them.
    use nalgebra::Rotation3;

    use super::*;
    use crate::bodies::Body;
    use crate::environment::CartesianState;
    use crate::environment::bodies_from_center::fixed;
    use crate::guidance::geometry::ephemeris_at_time::TargetPlanet;

    const CHECK: Monitor = Monitor { margin_rad: SUN_TOLERANCE_RAD, persistence_s: 3.0 };

    fn surroundings(sun_m: Vector3<f64>) -> EphemerisAtTime {
        let spacecraft = CartesianState { position_m: Vector3::x(), velocity_m_s: Vector3::y() };
        let planet = TargetPlanet::of(Body::Mercury.data());
        EphemerisAtTime::new(0.0, planet, &spacecraft, &fixed(sun_m), &fixed(Vector3::z() * 1e11))
    }

    fn places() -> BodyPositions {
        let (precise, coarse) = (surroundings(Vector3::x() * 5e10), surroundings(Vector3::y() * 5e10));
        BodyPositions { precise: Some(precise), coarse: Some(coarse), by_mode: true }
    }

    /// An attitude turned about Z, and the Sun sensed in its frame while it stands along X or `off_rad` from there.
    fn sensed(off_rad: f64) -> Option<(Attitude, Vector3<f64>)> {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.7);
        let sun = Rotation3::from_axis_angle(&Vector3::z_axis(), off_rad) * Vector3::x();
        Some((Attitude::from_rotation(&turn), turn.inverse() * sun * 3.0))
    }

    fn valid_after(offs_rad: &[Option<f64>]) -> bool {
        let mut trust = EphemerisTrust::default();
        for (second, off_rad) in offs_rad.iter().enumerate() {
            trust.judge(Some(&CHECK), second as f64, &places(), off_rad.and_then(sensed));
        }
        trust.is_valid()
    }

    #[test]
    fn a_disagreement_counts_once_it_has_lasted() {
        let (good, bad) = (Some(0.9 * SUN_TOLERANCE_RAD), Some(1.1 * SUN_TOLERANCE_RAD));
        assert!(valid_after(&[good; 9]));
        assert!(valid_after(&[bad; 3]));
        assert!(!valid_after(&[bad; 4]));
        assert!(!valid_after(&[bad, bad, bad, bad, good, good]), "invalid they stay");
        assert!(valid_after(&[bad, bad, bad, good, bad, bad, bad]));
        assert!(valid_after(&[bad, bad, bad, None, bad, bad, bad]), "nothing sensed contradicts nothing");
    }

    #[test]
    fn a_span_that_is_left_ends_them_at_once_and_lack_of_places_does_not() {
        let mut trust = EphemerisTrust::default();
        trust.judge(None, 0.0, &BodyPositions { precise: None, coarse: None, ..places() }, None);
        assert!(trust.is_valid());
        trust.judge(None, 0.0, &BodyPositions { precise: None, by_mode: false, ..places() }, None);
        assert!(trust.is_valid());
        trust.judge(None, 0.0, &BodyPositions { precise: None, ..places() }, None);
        assert!(!trust.is_valid());
        trust.renew();
        assert!(trust.is_valid());
    }

    #[test]
    fn each_mode_goes_by_its_own_models() {
        let (mut trust, places) = (EphemerisTrust::default(), places());
        let [precise, coarse] = [places.precise.as_ref(), places.coarse.as_ref()];
        let modes = [Mode::Operational, Mode::SafeHold, Mode::EarthAcquisition];
        assert_eq!(modes.map(|mode| places.in_mode(mode, &trust)), [precise, precise, coarse]);
        trust.judge(None, 0.0, &BodyPositions { precise: None, ..places }, None);
        assert_eq!(modes.map(|mode| places.in_mode(mode, &trust)), [precise, coarse, coarse]);
        let alone = BodyPositions { by_mode: false, ..places };
        assert_eq!(modes.map(|mode| alone.in_mode(mode, &trust)), [precise; 3]);
    }
}
