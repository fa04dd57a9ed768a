//! A visit: a command of the timeline at a time, and how a child process sends it.

use isolation::Payload;
use nalgebra::Vector3;

/// Words of a visit in a payload.
const WORDS: usize = 9;

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
    /// Appends it to a payload, as [`Visit::read`] reads it.
    pub fn push(&self, payload: &mut Vec<u64>) {
        payload.extend([self.row, self.dumps].map(|it| u64::from(it as u32)));
        let numbers = [self.span_s, self.sun_rad].concat();
        payload.extend(numbers.iter().chain(&self.gathered_inertial_n_m_s).map(|it| it.to_bits()));
    }

    /// The visit of a payload.
    pub fn read(payload: &mut Payload<'_>) -> Option<Self> {
        let words = payload.words(WORDS)?;
        let number = |k: usize| f64::from_bits(words[k]);
        Some(Self {
            row: words[0] as u32 as i32,
            dumps: words[1] as u32 as i32,
            span_s: [number(2), number(3)],
            sun_rad: [number(4), number(5)],
            gathered_inertial_n_m_s: Vector3::new(number(6), number(7), number(8)),
        })
    }
}
