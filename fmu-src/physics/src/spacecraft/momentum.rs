//! Limits of the stored momentum, and what wheels are sized for.

use super::downlinks::{TimeAfterPeriapsis, WrittenTime};
use super::part_reader::PartReader;
use crate::toml::{Positive, in_units, tables};

/// Units of an angle, and how many degrees they are.
const ANGLES_DEG: [(&str, f64); 2] = [("deg", 1.0), ("rad", 180.0 / core::f64::consts::PI)];
/// Units of a time, and how many seconds they are.
const TIMES_S: [(&str, f64); 3] = [("s", 1.0), ("min", 60.0), ("h", 3600.0)];

/// A slew about any body axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlewDemand {
    /// How far, in rad.
    pub angle_rad: f64,
    /// From rest to rest, in s.
    pub time_s: f64,
}

impl SlewDemand {
    /// How it is written.
    pub const ALLOWED: &'static str =
        "an angle up to 180 deg in a time, both with a unit (deg, rad; s, min, h): \"90 deg in 10 min\"";

    /// From text such as `90 deg in 10 min`; `None` where it is none.
    pub fn read(text: &str) -> Option<Self> {
        let (angle, time) = text.split_once(" in ")?;
        let demand =
            Self { angle_rad: in_units(angle, &ANGLES_DEG)?.to_radians(), time_s: in_units(time, &TIMES_S)? };
        let is_slew = demand.angle_rad > 0.0 && demand.angle_rad <= core::f64::consts::PI;
        (is_slew && demand.time_s > 0.0 && demand.time_s <= 1e9).then_some(demand)
    }

    /// Least acceleration with which wheels do it, in rad/s2: speeding up for half of the time, braking for the other.
    pub fn acceleration_rad_s2(&self) -> f64 {
        4.0 * self.angle_rad / (self.time_s * self.time_s)
    }

    /// The rate in the middle of it, in rad/s.
    pub fn peak_rate_rad_s(&self) -> f64 {
        2.0 * self.angle_rad / self.time_s
    }
}

tables! {
/// Limits of the stored momentum, and what wheels are sized for.
struct MomentumDescription {
    /// Magnitude of each body component, from the wheels' bias, at which thrusters dump it, in N m s; left out, what the wheels hold
    /// on all body axes that they span at once, about others 1e9, never.
    dump_threshold_n_m_s: Option<[Positive; 3]>,
    /// Time between unloadings that `heliotorque size` counts with: s, a string with a unit ("2 d"), or a share of the orbital period
    /// ("100 %"); a day unless given.
    unload_every: Option<WrittenTime>,
    /// Slew that `heliotorque size` counts with, about every axis: "90 deg in 10 min"; none unless given.
    slew: Option<String>,
}
}

/// Time between unloadings.
pub(super) fn unload_every(
    part: &PartReader<'_>,
    description: &MomentumDescription,
) -> Option<TimeAfterPeriapsis> {
    let written = description.unload_every.as_ref()?;
    let is_some = |time: &TimeAfterPeriapsis| match time {
        TimeAfterPeriapsis::Seconds(length) | TimeAfterPeriapsis::PeriodShare(length) => *length > 0.0,
    };
    let allowed = "a time above 0, up to 1e9 s: a number in s or a string with a unit (s, min, h, d), or a share of the \
                   period (\"100 %\")";
    part.key("unload_every").known(written.read().filter(is_some), written.found(), allowed)
}

/// The slew that wheels are sized for.
pub(super) fn slew(part: &PartReader<'_>, description: &MomentumDescription) -> Option<SlewDemand> {
    let written = description.slew.as_ref()?;
    part.key("slew").known(SlewDemand::read(written), format_args!("{written:?}"), SlewDemand::ALLOWED)
}

#[cfg(test)]
mod tests {
    //! Text with units; what is no slew.
    use super::*;

    #[test]
    fn a_slew_is_an_angle_in_a_time() {
        let demand = SlewDemand::read("90 deg in 10 min").unwrap();
        assert_eq!(demand, SlewDemand { angle_rad: core::f64::consts::FRAC_PI_2, time_s: 600.0 });
        // Half a slew is a turn from rest: rate a t/2, angle a (t/2)^2 / 2.
        let (half_s, a) = (300.0, demand.acceleration_rad_s2());
        assert!((0.5 * a * half_s * half_s - demand.angle_rad / 2.0).abs() < 1e-15);
        assert!((a * half_s - demand.peak_rate_rad_s()).abs() < 1e-15);
        assert_eq!(SlewDemand::read("1rad in 30s").unwrap().time_s, 30.0);
        for text in
            ["", "90 in 10 min", "90 deg", "90 deg in 10", "0 deg in 1 s", "181 deg in 1 s", "9 deg in -1 s"]
        {
            assert_eq!(SlewDemand::read(text), None, "{text}");
        }
    }
}
