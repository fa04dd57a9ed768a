//! MESSENGER in cruise for the tests: the shipped spacecraft on a circle about the Sun, the Earth far off.

use nalgebra::{Rotation3, Vector3};
use physics::{
    constants::ASTRONOMICAL_UNIT_M,
    plant::{LightSource, SunLight},
    spacecraft::{Articulation, MESSENGER_TOML, Spacecraft},
};

use super::{
    model::Limit,
    plan::{Least, PlanTask},
    simulated::{FlightRow, MomentumSize, SimulatedFlight},
    torque::SunlitSpacecraft,
    windows::{ControlBounds, Layout},
};
pub(super) use physics::constants::DAY_S;

/// With the centre of mass there, in m.
pub(crate) fn sunlit(center_of_mass_m: [f64; 3]) -> SunlitSpacecraft {
    let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
    let light = SunLight { source: LightSource::Distance { flux_w_m2: 1358.0 }, scale: 1.0 };
    let mut sunlit = SunlitSpacecraft::new(spacecraft, light, None).unwrap();
    sunlit.current_mass_panels_stowed.center_of_mass_body_m = Vector3::from(center_of_mass_m);
    sunlit
}

/// A row at an angle along the circle.
pub(super) fn row(sunlit: &SunlitSpacecraft, time_s: f64, distance_au: f64, along_rad: f64) -> FlightRow {
    let here_m = Vector3::new(along_rad.cos(), along_rad.sin(), 0.0) * (distance_au * ASTRONOMICAL_UNIT_M);
    let mut row = FlightRow {
        time_s,
        to_sun_m: -here_m,
        to_earth_m: Vector3::new(0.1, 0.2, 1.0) * ASTRONOMICAL_UNIT_M - here_m,
        lit_fraction: 1.0,
        inertial_from_body: Rotation3::identity(),
        panel_angles_rad: vec![0.0; sunlit.panels.len()],
        other_torque_n_m: Vector3::zeros(),
        momentum_n_m_s: Vector3::zeros(),
        dumps: 0,
        downlink: true,
        motion: None,
    };
    row.inertial_from_body = sunlit.downlink_attitude(&row, 0.0, 0.0).unwrap();
    row
}

/// So many days, a row each two hours, at this distance, the Sun's direction fixed.
pub(super) fn simulated(sunlit: &SunlitSpacecraft, days: u32, distance_au: f64) -> SimulatedFlight {
    let times = (0..=12 * days).map(|k| f64::from(k) * 7200.0);
    SimulatedFlight {
        rows: times.map(|time_s| row(sunlit, time_s, distance_au, 0.3)).collect(),
        ..SimulatedFlight::default()
    }
}

/// Windows of a day from the start on, without controls; the corridor is wide.
pub(super) fn task(limit_n_m_s: f64, control_bounds: ControlBounds) -> PlanTask {
    PlanTask {
        layout: Layout {
            frozen_until_s: 0.0,
            arrays_are_frozen: true,
            window_s: DAY_S,
            occupied: Vec::new(),
            downlinks_s: None,
            contacts_s: Vec::new(),
            contact_share: 0.0,
            control_bounds,
            in_force: Vec::new(),
            own: Vec::new(),
            corridor: Articulation { min_suns: 0.0, max_suns: 1e3, target_suns: 1.0 },
            offset_sign: 1.0,
            frozen_offset_rad: 0.0,
            sides: vec![1.0, -1.0],
        },
        limit: Limit {
            momentum_n_m_s: limit_n_m_s,
            size: MomentumSize::Length,
            margin: 0.0,
            covariance: None,
        },
        dumps: 0,
        target: None,
        least: Least::Tilt,
        budget_s: 20.0,
    }
}
