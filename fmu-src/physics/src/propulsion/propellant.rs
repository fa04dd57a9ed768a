//! Propellant in the tanks while thrusters fire, and the mass properties without what is used.
//!
//! Equations: du/dt = q; p(u) as in [`Tank`]; r_c' = (M r_c - sum u_k r_k) / (M - sum u_k);
//! J' = J + M [r_c] - sum u_k [r_k] - M' [r_c'] with [r] = r.r 1 - r r^T (Steiner), propellant taken as points at its tanks.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::flow::{flowed_kg, lasts_s};
use crate::spacecraft::{MassProperties, Tank, steiner};

/// Propellant used from one tank, linear flow from a time on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct TankUse {
    used_kg: f64,
    /// In kg/s, and its slope in kg/s2.
    flow_kg_s: [f64; 2],
}

/// Propellant used so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PropellantState {
    since_s: f64,
    tanks: Vec<TankUse>,
}

impl PropellantState {
    /// With every tank as loaded.
    pub fn new(tanks: usize, time_s: f64) -> Self {
        Self { since_s: time_s, tanks: vec![TankUse::default(); tanks] }
    }

    /// Whether its numbers can come from a flight with so many tanks; bytes from elsewhere may hold anything.
    pub fn is_valid(&self, tanks: usize) -> bool {
        self.tanks.len() == tanks && self.tanks.iter().all(|tank| tank.used_kg >= 0.0)
    }

    /// Used from tank `k` (from 0) until `time_s`, in kg.
    pub fn used_kg(&self, k: usize, time_s: f64) -> f64 {
        let elapsed_s = (time_s - self.since_s).max(0.0);
        self.tanks.get(k).map_or(0.0, |tank| tank.used_kg + flowed_kg(tank.flow_kg_s, elapsed_s))
    }

    /// Used from all tanks until `time_s`, in kg.
    pub fn total_used_kg(&self, time_s: f64) -> f64 {
        (0..self.tanks.len()).map(|k| self.used_kg(k, time_s)).sum()
    }

    /// Counts what was used until `time_s`; from there nothing flows.
    pub fn accumulate(&mut self, time_s: f64) {
        for k in 0..self.tanks.len() {
            let used_kg = self.used_kg(k, time_s);
            self.tanks[k] = TankUse { used_kg, flow_kg_s: [0.0; 2] };
        }
        self.since_s = time_s;
    }

    /// Adds to the flow from tank `k` since it was settled, in kg/s and kg/s2.
    pub fn add_flow(&mut self, k: usize, flow_kg_s: [f64; 2]) {
        if let Some(tank) = self.tanks.get_mut(k) {
            for (sum, flow) in tank.flow_kg_s.iter_mut().zip(flow_kg_s) {
                *sum += flow;
            }
        }
    }

    /// Flow from tank `k` when it was settled, in kg/s.
    pub fn flow_kg_s(&self, k: usize) -> f64 {
        self.tanks.get(k).map_or(0.0, |tank| tank.flow_kg_s[0])
    }

    /// Takes this much from tank `k` at once, in kg, and no more than is left.
    pub fn take(&mut self, k: usize, tank: &Tank, propellant_kg: f64) {
        if let Some(used) = self.tanks.get_mut(k) {
            used.used_kg = (used.used_kg + propellant_kg).min(tank.propellant_kg);
        }
    }

    /// When tank `k` runs dry at the present flow, in s.
    pub fn depletion_time_s(&self, k: usize, tank: &Tank) -> f64 {
        self.tanks.get(k).map_or(f64::INFINITY, |used| {
            self.since_s + lasts_s(used.flow_kg_s, tank.propellant_kg - used.used_kg)
        })
    }

    /// Nothing is left in tank `k`.
    pub fn empty(&mut self, k: usize, tank: &Tank) {
        if let Some(used) = self.tanks.get_mut(k) {
            used.used_kg = tank.propellant_kg;
        }
    }

    /// Mass properties without what is used until `time_s`, of a spacecraft that has `loaded` with full tanks.
    pub fn mass_properties(&self, loaded: &MassProperties, tanks: &[Tank], time_s: f64) -> MassProperties {
        if self.total_used_kg(time_s) == 0.0 {
            return *loaded;
        }
        without(loaded, tanks, |k| self.used_kg(k, time_s))
    }

    /// Mass properties without what flowed since [`PropellantState::accumulate`] until `time_s`, of a spacecraft that had `settled`
    /// then.
    pub fn mass_properties_since(
        &self,
        settled: &MassProperties,
        tanks: &[Tank],
        time_s: f64,
    ) -> MassProperties {
        without(settled, tanks, |k| self.used_kg(k, time_s) - self.used_kg(k, self.since_s))
    }
}

/// Mass properties of a body without so much of each tank, in kg.
fn without(body: &MassProperties, tanks: &[Tank], used_kg: impl Fn(usize) -> f64) -> MassProperties {
    let mut mass_kg = body.mass_kg;
    let mut moment_kg_m = body.center_of_mass_body_m * body.mass_kg;
    let mut about_origin_kg_m2 =
        body.inertia_body_kg_m2 + steiner(&body.center_of_mass_body_m) * body.mass_kg;
    for (k, tank) in tanks.iter().enumerate() {
        let used_kg = used_kg(k);
        mass_kg -= used_kg;
        moment_kg_m -= tank.position_body_m * used_kg;
        about_origin_kg_m2 -= steiner(&tank.position_body_m) * used_kg;
    }
    let center_of_mass_body_m: Vector3<f64> = moment_kg_m / mass_kg;
    MassProperties {
        mass_kg,
        center_of_mass_body_m,
        inertia_body_kg_m2: about_origin_kg_m2 - steiner(&center_of_mass_body_m) * mass_kg,
    }
}

#[cfg(test)]
mod tests {
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
        let center_of_mass_body_m =
            points.iter().map(|(mass, at)| at * *mass).sum::<Vector3<f64>>() / mass_kg;
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
        let dry = [
            (200.0, Vector3::new(1.0, 0.0, 0.0)),
            (150.0, Vector3::new(-1.0, 0.4, 0.2)),
            (90.0, Vector3::z()),
        ];
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
}
