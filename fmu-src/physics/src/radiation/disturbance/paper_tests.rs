//! Paper 004's Table 7: the share of solar pressure that albedo, infrared and recoil reach around four orbits.

use nalgebra::Vector3;

use super::*;
use crate::bodies::surface::MERCURY;
use crate::constants::{ASTRONOMICAL_UNIT_M, GM_MERCURY_M3_S2, RADIUS_MERCURY_M};
use crate::environment::eclipse::{Shadow, ShadowModel};
use crate::environment::kepler_planet::{MERCURY_AS_PRINTED, MESSENGER_AS_PRINTED, tests::Frames};
use crate::environment::orbit::Elements;
use crate::spacecraft::{MESSENGER_THERMAL_TOML, Spacecraft};

/// Flux at 1 AU that fits the paper's numbers, W/m2 (unpublished there).
const SOLAR_FLUX_PAPER_004_W_M2: f64 = 1365.0;

/// Accelerations around one orbit with the planet standing still, as in the paper's analytical model: least and
/// greatest of solar (in m/s2), and of albedo, infrared and recoil (in % of the greatest solar).
fn around_orbit(mercury_true_anomaly_deg: f64) -> [[f64; 2]; 4] {
    around_orbit_by(mercury_true_anomaly_deg, PlanetLightMethod::Rings(12), 1440)
}

/// The same by any method, at so many places around the orbit.
fn around_orbit_by(
    mercury_true_anomaly_deg: f64,
    planet_light: PlanetLightMethod,
    steps: u32,
) -> [[f64; 2]; 4] {
    let spacecraft = Spacecraft::from_toml("messenger-thermal.toml", MESSENGER_THERMAL_TOML).unwrap();
    let options = Options { planet: Some(MERCURY), planet_light, ..Options::default() };
    let model = DisturbanceModel::new(&spacecraft, &options).unwrap();
    let shadow = Shadow::new(ShadowModel::AllOrNothingCylinder, RADIUS_MERCURY_M).unwrap();
    let planet = Elements { true_anomaly_rad: mercury_true_anomaly_deg.to_radians(), ..MERCURY_AS_PRINTED };
    let frames = Frames::from_elements(&planet);
    let sun_distance_m = frames.planet_hci_m.norm();
    let sun_flux_w_m2 = SOLAR_FLUX_PAPER_004_W_M2 * (ASTRONOMICAL_UNIT_M / sun_distance_m).powi(2);
    let sun_body = -Vector3::y();
    let mut workspace = Workspace::default();
    let mut range = [[f64::INFINITY, 0.0]; 4];
    for step in 0..steps {
        let true_anomaly_rad = f64::from(step) * core::f64::consts::TAU / f64::from(steps);
        let elements = Elements { true_anomaly_rad, ..MESSENGER_AS_PRINTED };
        let position_mci_m = elements.state(GM_MERCURY_M3_S2).unwrap().position_m;
        let position_body_m = frames.dcm_sc_from_mci() * position_mci_m;
        let (lit_fraction, _) = shadow.fraction_and_gaps(&position_body_m, &(sun_body * sun_distance_m));
        let geometry = Geometry {
            lit_fraction,
            planet: Some(PlanetGeometry {
                position_body_m: -position_body_m,
                sun_from_planet_body_m: sun_body,
                sun_flux_w_m2,
                pole_body: None,
            }),
            panel_angles_rad: &[0.0, 0.0],
            ..Geometry::sunlit(sun_body, sun_flux_w_m2)
        };
        let found = model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap();
        // The table leaves eclipses out of its extremes of solar pressure and recoil.
        for (index, (range, effect)) in range.iter_mut().zip(found.values()).enumerate() {
            let a = effect.force_body_n.norm() / spacecraft.mass_properties.mass_kg;
            if lit_fraction > 0.0 || index == 1 || index == 2 {
                *range = [range[0].min(a), range[1].max(a)];
            }
        }
    }
    let solar = range[0][1];
    let percent = |range: [f64; 2]| range.map(|a| a / solar * 100.0);
    [range[0], percent(range[1]), percent(range[2]), percent(range[3])]
}

/// Mercury's true anomaly (deg), solar (1e-7 m/s2), greatest albedo and infrared (% of solar) as published.
const TABLE_7: [[f64; 4]; 4] = [
    [10.0, 8.45, 0.32, 6.68],
    [98.0, 5.51, 2.37, 14.10],
    [189.0, 3.71, 0.95, 19.24],
    [279.0, 6.22, 6.45, 26.79],
];

#[test]
fn solar_albedo_and_infrared_are_the_published_ones() {
    for [anomaly_deg, solar, albedo, infrared] in TABLE_7 {
        let found = around_orbit(anomaly_deg);
        let off = |found: f64, published: f64| (found / published - 1.0).abs();
        assert!(off(found[0][1], solar * 1e-7) < 0.0015, "solar at {anomaly_deg}: {:e}", found[0][1]);
        assert!(off(found[1][1], albedo) < 0.02, "albedo at {anomaly_deg}: {}", found[1][1]);
        assert!(off(found[2][1], infrared) < 0.05, "infrared at {anomaly_deg}: {}", found[2][1]);
    }
}

/// Cases 3 and 4 cannot be had with emissivity equal to absorptivity, whatever the panels conduct.
#[test]
fn recoil_of_case_1_is_the_published_one() {
    let [_, _, _, [least, greatest]] = around_orbit(10.0);
    assert!((least / 23.44 - 1.0).abs() < 0.03, "{least}");
    assert!((greatest / 25.60 - 1.0).abs() < 0.03, "{greatest}");
}

/// The paper's own method, with as many belts as it has: their odd number puts cells on the terminator.
#[test]
fn cells_give_the_published_infrared_closer_than_the_limit_of_many_cells() {
    for [anomaly_deg, _, albedo, infrared] in TABLE_7 {
        let cells = PlanetLightMethod::Cells(45);
        let found = around_orbit_by(anomaly_deg, cells, 360);
        let off = |found: f64, published: f64| (found / published - 1.0).abs();
        assert!(off(found[1][1], albedo) < 0.015, "albedo at {anomaly_deg}: {}", found[1][1]);
        assert!(off(found[2][1], infrared) < 0.015, "infrared at {anomaly_deg}: {}", found[2][1]);
    }
}
