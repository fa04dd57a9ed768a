//! Directions and points that a pointing aims at: moving vectors, limb, lighting, orbit frame.

pub mod ephemeris_at_time;
pub mod lighting;
pub mod limb;
pub mod lvlh;
pub mod moving;
pub mod planet_point;
