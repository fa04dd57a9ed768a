//! Where the Sun stands in a downlink, and the link to the Earth.

pub mod default_downlink;
pub mod sun_place;
