//! Against bodies put together from points, and against the closed form of blowdown.
use super::*;
use crate::spacecraft::Blowdown;
use approx::assert_relative_eq;
use nalgebra::Matrix3;

fn tank(position_body_m: Vector3<f64>, propellant_kg: f64) -> Tank {
    Tank {
        name: "tank".into(),
        position_body_m,
        propellant_kg,
        pressure_pa: 2e6,
        allowed_pa: [0.0, f64::INFINITY],
        blowdown: None,
    }
}

/// Mass properties of points, each moment summed by hand.
fn of(points: &[(f64, Vector3<f64>)]) -> MassProperties {
    let mass_kg: f64 = points.iter().map(|(mass, _)| mass).sum();
    let center_of_mass_body_m = points.iter().map(|(mass, at)| at * *mass).sum::<Vector3<f64>>() / mass_kg;
    let mut inertia_body_kg_m2 = Matrix3::zeros();
    for (mass, at) in points {
        let r = at - center_of_mass_body_m;
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            for other in [Vector3::x(), Vector3::y(), Vector3::z()] {
                // a . (r x (b x r)), the momentum about a of a turn about b.
                let moment = axis.dot(&r.cross(&other.cross(&r))) * mass;
                inertia_body_kg_m2 += axis * other.transpose() * moment;
            }
        }
    }
    MassProperties { mass_kg, center_of_mass_body_m, inertia_body_kg_m2 }
}

#[test]
fn what_is_used_is_missing_where_it_was() {
    let tanks = [tank(Vector3::new(0.3, -0.2, 0.6), 40.0), tank(Vector3::new(0.0, 0.1, -0.5), 20.0)];
    let dry =
        [(200.0, Vector3::new(1.0, 0.0, 0.0)), (150.0, Vector3::new(-1.0, 0.4, 0.2)), (90.0, Vector3::z())];
    let with = |left_kg: [f64; 2]| {
        let full = tanks.iter().zip(left_kg).map(|(tank, left)| (left, tank.position_body_m));
        of(&dry.iter().copied().chain(full).collect::<Vec<_>>())
    };
    let mut used = PropellantState::new(2, 5.0);
    used.add_flow(0, [0.5, 0.01]);
    used.take(1, &tanks[1], 12.0);
    let found = used.mass_properties(&with([40.0, 20.0]), &tanks, 15.0);
    let expected = with([40.0 - 5.5, 8.0]);
    assert_relative_eq!(found.mass_kg, expected.mass_kg, max_relative = 1e-14);
    assert_relative_eq!(found.center_of_mass_body_m, expected.center_of_mass_body_m, epsilon = 1e-14);
    assert_relative_eq!(found.inertia_body_kg_m2, expected.inertia_body_kg_m2, epsilon = 1e-12);
}

#[test]
fn a_tank_runs_dry_when_its_flow_has_summed_up() {
    let tank = tank(Vector3::zeros(), 3.0);
    for flow in [[0.1, 0.0], [0.1, 0.01], [0.1, -1e-3], [0.0, 0.02]] {
        let mut used = PropellantState::new(1, 100.0);
        used.add_flow(0, flow);
        let depletion_time_s = used.depletion_time_s(0, &tank);
        assert_relative_eq!(used.used_kg(0, depletion_time_s), 3.0, max_relative = 1e-13);
    }
    let mut used = PropellantState::new(1, 100.0);
    assert_eq!(used.depletion_time_s(0, &tank), f64::INFINITY);
    used.add_flow(0, [0.1, -0.01]);
    assert_eq!(used.depletion_time_s(0, &tank), f64::INFINITY, "the flow stops before");
}

/// Rounding leaves nothing to feed, whether it flows out or is taken at once, at times small and large.
#[test]
fn a_tank_that_has_run_dry_feeds_no_more() {
    let gas = Blowdown { ullage_m3: 0.02, density_kg_m3: 1000.0 };
    let falling = Tank { blowdown: Some(gas), allowed_pa: [1e6, 3e6], ..tank(Vector3::zeros(), 40.0) };
    for (tank, usable_kg) in [(tank(Vector3::zeros(), 1e-3), 1e-3), (falling, 20.0)] {
        for since_s in [0.0, 0.1, 3e8] {
            for flow in [[0.1, 0.0], [0.07, 0.01], [0.1, -1e-5]] {
                let mut used = PropellantState::new(1, since_s);
                used.add_flow(0, flow);
                let end_s = used.depletion_time_s(0, &tank);
                used.accumulate(core::slice::from_ref(&tank), end_s);
                assert_eq!(
                    (used.used_kg(0, end_s + 9.0), tank.feeds(used.used_kg(0, end_s))),
                    (usable_kg, false)
                );
            }
        }
        let mut used = PropellantState::new(1, 0.0);
        (0..7).for_each(|_| used.take(0, &tank, usable_kg / 7.0));
        assert_eq!((used.used_kg(0, 0.0), tank.feedable_kg(usable_kg)), (usable_kg, 0.0));
    }
}

#[test]
fn blowdown_follows_boyle() {
    let gas = Blowdown { ullage_m3: 0.02, density_kg_m3: 1000.0 };
    let tank = Tank { blowdown: Some(gas), allowed_pa: [1e6, 3e6], ..tank(Vector3::zeros(), 40.0) };
    // 10 kg leave 10 litres: three halves of the volume, two thirds of the pressure.
    assert_relative_eq!(tank.pressure_pa(10.0), 2e6 * 2.0 / 3.0, max_relative = 1e-14);
    let slope = (tank.pressure_pa(10.01) - tank.pressure_pa(9.99)) / 0.02;
    assert_relative_eq!(tank.pressure_slope_pa_kg(10.0), slope, max_relative = 1e-6);
    assert!(tank.feeds(19.99) && !tank.feeds(20.01), "1 MPa is reached at 20 kg");
}
