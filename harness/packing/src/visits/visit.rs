//! A visit as numbers, which a child process sends.

use nalgebra::Vector3;

/// A visit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visit {
    /// Row of the timeline's command, from 1; 0 where none is in force.
    pub row: i32,
    /// Begin and end, in s.
    pub span_s: [f64; 2],
    /// Azimuth and elevation of the Sun in its middle, in rad.
    pub sun_rad: [f64; 2],
    /// Momentum gathered, EME2000, without dumps, in N m s.
    pub gathered_inertial_n_m_s: Vector3<f64>,
    /// Dumps in it.
    pub dumps: i32,
}

impl Visit {
    /// Returns the numbers from which [`Visit::from_numbers`] makes it.
    pub fn numbers(&self) -> Vec<f64> {
        let whole = [self.row, self.dumps].map(f64::from);
        [whole, self.span_s, self.sun_rad]
            .as_flattened()
            .iter()
            .chain(&self.gathered_inertial_n_m_s)
            .copied()
            .collect()
    }

    /// Returns the visit of such numbers; `None` of others.
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let [row, dumps, begin_s, end_s, azimuth_rad, elevation_rad, x, y, z] = *numbers else { return None };
        Some(Self {
            row: row as i32,
            dumps: dumps as i32,
            span_s: [begin_s, end_s],
            sun_rad: [azimuth_rad, elevation_rad],
            gathered_inertial_n_m_s: Vector3::new(x, y, z),
        })
    }
}
