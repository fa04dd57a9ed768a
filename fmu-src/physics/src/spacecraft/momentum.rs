//! Limits of the stored momentum, and what wheels are sized for.

use super::downlinks::{TimeAfterPeriapsis, WrittenTime};
use super::part_reader::PartReader;
use super::slew::SlewDemand;
use crate::toml::{Positive, tables};

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
