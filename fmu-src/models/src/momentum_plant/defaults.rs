//! Start values that are computed or come from the spacecraft.

use physics::constants;
use physics::environment::{frames, orbit::Elements, paper004, sun, time};
use physics::spacecraft::{self, SunKeepIn};

use super::choices::{PanelControl, PanelTilt, SunshadeModel};
use super::setup::PlantSetup;

/// 2009-04-06 00:00 TDB: orbit insertion in paper 000's plan, in s past J2000 TDB.
pub(super) const EPOCH_TDB_S: f64 = time::MOMENTUM_STUDY_START_S;
pub(super) const SOLAR_FLUX_W_M2: f64 = sun::SOLAR_FLUX_PAPER_000_W_M2;
pub(super) const MERCURY_GM_M3_S2: f64 = constants::GM_MERCURY_M3_S2;
pub(super) const MERCURY_RADIUS_M: f64 = constants::RADIUS_MERCURY_M;
pub(super) const MERCURY_J2: f64 = constants::J2_MERCURY;
pub(super) const MERCURY_J2_RADIUS_M: f64 = constants::J2_REFERENCE_RADIUS_MERCURY_M;
pub(super) const MERCURY_POLE_RIGHT_ASCENSION_RAD: f64 = frames::MERCURY_POLE_RIGHT_ASCENSION_RAD;
pub(super) const MERCURY_POLE_DECLINATION_RAD: f64 = frames::MERCURY_POLE_DECLINATION_RAD;
/// Mercury's orbit as paper 004 prints it.
pub(super) const PRINTED: Elements = paper004::MERCURY_AS_PRINTED;

/// The semi-major axis of a 12 h orbit about Mercury (Kepler's third law).
pub(super) fn semi_major_axis_m() -> f64 {
    let mean_motion_rad_s = core::f64::consts::TAU / 43_200.0;
    // Start values enter the GUID: no digit may hang on the machine's own library of functions.
    libm::cbrt(MERCURY_GM_M3_S2 / (mean_motion_rad_s * mean_motion_rad_s))
}

/// Inertia by rows.
pub(super) fn inertia_kg_m2(setup: &PlantSetup) -> [[f64; 3]; 3] {
    setup.spacecraft.mass_properties.inertia_body_kg_m2.transpose().into()
}

/// The shade model the spacecraft file asks for.
pub(super) fn sunshade_model(setup: &PlantSetup) -> SunshadeModel {
    shade_of(&setup.spacecraft)
}

/// The shade model a spacecraft file asks for.
pub(crate) fn shade_of(spacecraft: &spacecraft::Spacecraft) -> SunshadeModel {
    match spacecraft.sunshade.as_ref().map(|shade| shade.model) {
        Some(spacecraft::SunshadeModel::Cylinder) => SunshadeModel::Cylinder,
        Some(spacecraft::SunshadeModel::Plates) | None => SunshadeModel::Plates,
    }
}

/// How the spacecraft file says a panel is held.
pub(super) fn panel_control(setup: &PlantSetup, index: usize) -> PanelControl {
    match setup.spacecraft.panels[index].control {
        spacecraft::PanelControl::SunOffset => PanelControl::SunOffset,
        spacecraft::PanelControl::Angle => PanelControl::Angle,
    }
}

/// The sense in which the spacecraft file tilts a panel.
pub(super) fn panel_tilt(setup: &PlantSetup, index: usize) -> PanelTilt {
    if setup.spacecraft.panels[index].tilt_sign < 0.0 { PanelTilt::Negative } else { PanelTilt::Positive }
}

/// The keep-in zone; without one in the file every direction is allowed.
pub(super) fn keep_in(setup: &PlantSetup) -> SunKeepIn {
    let everywhere =
        SunKeepIn { azimuth_rad: core::f64::consts::PI, elevation_rad: core::f64::consts::FRAC_PI_2 };
    setup.spacecraft.sun_keep_in.unwrap_or(everywhere)
}

/// The dump threshold; without one in the file what its wheels guarantee, and without wheels in all directions paper
/// 000's for small wheels.
pub(super) fn dump_threshold_n_m_s(setup: &PlantSetup) -> [f64; 3] {
    let craft = &setup.spacecraft;
    let smallest_n_m_s = spacecraft::PAPER_DUMP_THRESHOLDS_N_M_S[0].1;
    let capacities_n_m_s = craft.wheels.iter().map(|wheel| wheel.capacity_n_m_s);
    let array = setup.wheel_array.as_ref();
    let guaranteed_n_m_s = array.map(|it| it.guaranteed_threshold_n_m_s(capacities_n_m_s));
    craft.dump_threshold_n_m_s.map_or([guaranteed_n_m_s.unwrap_or(smallest_n_m_s); 3], Into::into)
}
