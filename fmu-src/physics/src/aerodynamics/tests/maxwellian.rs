//! Force on a face agrees with integrals over the velocities of a drifting Maxwellian gas.

use core::f64::consts::PI;

use super::*;
use crate::constants::GAS_CONSTANT_J_MOL_K;
use crate::numerics::quadrature::Rule;

/// What crosses the plane z = 0 downward, per area and time, of a gas of density 1.
struct Flux {
    mass: f64,
    momentum: Vector3<f64>,
    energy: f64,
}

/// Integral over all velocities w of molecules with w_z < 0, of a gas of most probable speed `c` that drifts at `drift`.
fn downward(c: f64, drift: &Vector3<f64>) -> Flux {
    let rule = Rule::<64>::gauss_legendre();
    // Beyond seven widths, or where e^(-42) of what is met at the plane is left, nothing counts.
    let depth = drift.z.max(0.0) / c;
    let (low, high) = if drift.z > 0.0 {
        (-c * ((depth * depth + 42.0).sqrt() - depth), 0.0)
    } else {
        (drift.z - 7.0 * c, (drift.z + 7.0 * c).min(0.0))
    };
    let mut flux = Flux { mass: 0.0, momentum: Vector3::zeros(), energy: 0.0 };
    for (z, of_z) in rule.on(low, high) {
        for (x, of_x) in rule.on(drift.x - 7.0 * c, drift.x + 7.0 * c) {
            for (y, of_y) in rule.on(drift.y - 7.0 * c, drift.y + 7.0 * c) {
                let w = Vector3::new(x, y, z);
                let density = (-(w - drift).norm_squared() / (c * c)).exp() / (PI.sqrt() * c).powi(3);
                let crossing = -z * density * of_x * of_y * of_z;
                flux.mass += crossing;
                flux.momentum += w * crossing;
                flux.energy += crossing * w.norm_squared() / 2.0;
            }
        }
    }
    flux
}

/// Force per area by the integrals alone, on a face with its normal along z.
fn expected_pa(law: (AerodynamicLaw, Reemission), flow: &AirFlow<f64>) -> Vector3<f64> {
    let velocity = flow.velocity_body_m_s;
    let speed =
        |temperature_k: f64| (2.0 * GAS_CONSTANT_J_MOL_K * temperature_k / flow.molar_mass_kg_mol).sqrt();
    let met = downward(speed(flow.temperature_k), &-velocity);
    // Pressure of the same mass sent out as a gas at rest.
    let sent = |temperature_k: f64| {
        let gas = downward(speed(temperature_k), &Vector3::zeros());
        -gas.momentum.z / gas.mass * met.mass
    };
    let along = Vector3::new(met.momentum.x, met.momentum.y, 0.0);
    let pressure = -met.momentum.z;
    let per_area = match law {
        (AerodynamicLaw::SchaafChambre, _) => {
            let (normal, tangential) = (SURFACE.normal_accommodation, SURFACE.tangential_accommodation);
            let reflected = pressure - normal * (pressure - sent(SURFACE.wall_temperature_k));
            along * tangential - Vector3::z() * (pressure + reflected)
        }
        (_, reemission) => {
            let per_kelvin = match reemission {
                Reemission::Effusive => {
                    let gas = downward(speed(1.0), &Vector3::zeros());
                    gas.energy / gas.mass
                }
                // 3/2 k in a gas at rest.
                Reemission::Moe => 1.5 * GAS_CONSTANT_J_MOL_K / flow.molar_mass_kg_mol,
            };
            let incident_k = velocity.norm_squared() / 2.0 / per_kelvin;
            let alpha = SURFACE.energy_accommodation;
            let sent_k = incident_k - alpha * (incident_k - SURFACE.wall_temperature_k);
            along - Vector3::z() * (pressure + sent(sent_k))
        }
    };
    per_area * flow.density_kg_m3
}

#[test]
fn both_gas_laws_are_integrals_over_the_maxwellian() {
    let mut spacecraft = spacecraft(PLATE);
    let plate = &mut spacecraft.plates[0];
    (plate.normal, plate.area_m2, plate.faces.gas_surface) = (Vector3::z(), 1.0, [SURFACE; 2]);
    for law in &LAWS[1..] {
        let model = model(&spacecraft, *law);
        for (speed_m_s, degrees) in [
            (500.0, 0.0),
            (500.0, 120.0),
            (3000.0, 60.0),
            (3000.0, 180.0),
            (7700.0, 0.0),
            (7700.0, 75.0),
            (7700.0, 90.0),
            (7700.0, 110.0),
            (9000.0, 180.0),
        ] {
            let angle = f64::to_radians(degrees);
            let along = Vector3::new(angle.sin() * 0.6, angle.sin() * 0.8, angle.cos());
            let flow = thin_air(along * speed_m_s);
            let expected = expected_pa(*law, &flow);
            let found = load(&model, &flow, &[]).force_body_n;
            assert!(
                (found - expected).norm() < 1e-9 * expected.norm(),
                "{law:?} at {speed_m_s} m/s and {degrees} deg: {found} {expected}"
            );
        }
    }
}
