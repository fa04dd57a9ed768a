//! Flight near a body: closest approach, and B of the hyperbola that osculates before it.

use nalgebra::{Vector2, Vector3};
use physics::environment::{
    CartesianState,
    orbit::{BPlane, OrbitError, TwoBodyOrbit},
};

/// A flight as it is reported at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ApproachRow {
    /// In s of the flight.
    pub time_s: f64,
    /// Position and velocity from the body's centre, EME2000.
    pub state: CartesianState,
    /// B-plane of the hyperbola that osculates then.
    pub b_plane: BPlane,
}

/// Rows of a flight about its arrival, in the order of time, with what it passed.
#[derive(Clone, Debug, PartialEq)]
pub struct Approach {
    /// At least one.
    pub rows: Vec<ApproachRow>,
    /// Time in s and altitude in m of the closest approach, where it is over.
    pub closest: Option<(f64, f64)>,
    /// Gravitational parameter of the body, m3/s2.
    pub mu_m3_s2: f64,
    /// Its radius, m.
    pub radius_m: f64,
}

/// An encounter as it was simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encounter {
    /// Time of the closest approach, s of the flight.
    pub arrival_s: f64,
    /// Its altitude, m; below 0 on a path into the body.
    pub altitude_m: f64,
    /// Time at which the hyperbola of B osculates, s of the flight.
    pub osculation_s: f64,
    /// B along T and R, m.
    pub b_m: Vector2<f64>,
    /// Speed far from the body of that hyperbola, m/s.
    pub excess_speed_m_s: f64,
    /// The same of the one that osculates at the closest approach, m/s.
    pub excess_speed_there_m_s: f64,
}

impl Approach {
    /// The encounter, with B of the hyperbola that osculates `lead_s` before the closest approach. A closest approach that is not in
    /// the flight, as it ends before or inside the body, is that of the last row's hyperbola.
    ///
    /// # Errors
    /// A last row whose orbit about the body is none.
    pub fn encounter(&self, lead_s: f64) -> Result<Encounter, OrbitError> {
        let (arrival_s, altitude_m) = match (self.closest, self.rows.last()) {
            (Some(closest), _) => closest,
            (None, Some(last)) => {
                let orbit = TwoBodyOrbit::from_state(&last.state, self.mu_m3_s2, last.time_s)?;
                let distance_m = orbit.periapsis_distance_m();
                (orbit.periapsis_epoch_s(0), distance_m - self.radius_m)
            }
            (None, None) => (f64::NAN, f64::NAN),
        };
        let osculation_s = arrival_s - lead_s;
        let before = self.b_plane_at(osculation_s);
        Ok(Encounter {
            arrival_s,
            altitude_m,
            osculation_s,
            b_m: before.xy(),
            excess_speed_m_s: before.z,
            excess_speed_there_m_s: self.b_plane_at(arrival_s).z,
        })
    }

    /// B.T, B.R (m) and the speed far away (m/s) at a time: a cubic through the four rows about it, beyond the rows the nearest.
    fn b_plane_at(&self, time_s: f64) -> Vector3<f64> {
        let value = |row: &ApproachRow| {
            Vector3::new(row.b_plane.b_t_m, row.b_plane.b_r_m, row.b_plane.excess_speed_m_s)
        };
        let rows = &self.rows;
        let after = rows.partition_point(|row| row.time_s < time_s);
        match (after.checked_sub(1).and_then(|before| rows.get(before)), rows.get(after)) {
            (None, Some(row)) | (Some(row), None) => return value(row),
            (None, None) => return Vector3::repeat(f64::NAN),
            _ => {}
        }
        let first = after.saturating_sub(2).min(rows.len().saturating_sub(4));
        let nodes = &rows[first..rows.len().min(first + 4)];
        let weighted = nodes.iter().map(|row| {
            let others = nodes.iter().filter(|other| other.time_s != row.time_s);
            let weights = others.map(|other| (time_s - other.time_s) / (row.time_s - other.time_s));
            value(row) * weights.product::<f64>()
        });
        weighted.sum()
    }
}
