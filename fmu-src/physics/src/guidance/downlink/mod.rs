//! Direction of the Sun in a downlink, and the link to the Earth.

pub mod default_downlink;
pub mod sun_direction;
