//! The attitude of the orbit phase as pointing vectors.

use super::{GuidanceHardware, PointingSolution};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::value;
use crate::guidance::orbit_phase::attitudes::ScienceRule;
use crate::guidance::orbit_phase::guided::{DownlinkStatus, Guided, GuidedAttitude};
use crate::guidance::orbit_phase::schedule::Activity;
use crate::guidance::pointing::aligned::aligned_vectors;
use crate::guidance::pointing::antenna::Beam;
use crate::guidance::pointing::law::Pointing;

/// Returns an attitude of the orbit phase as vectors: axes and targets of its science where those are its law, else +Z at its
/// own direction, -Y rolled to its own.
pub fn orbit_phase_solution(
    attitude: &GuidedAttitude,
    law: &Guided,
    ephemeris: &EphemerisAtTime,
    hardware: &GuidanceHardware<'_>,
) -> PointingSolution {
    let pointing = Pointing::from_frame(&attitude.frame);
    let is_downlink = attitude.window.activity == Activity::Downlink && !attitude.slewing;
    let keeps_nadir = attitude.window.activity == Activity::Science && law.science.unloads();
    let earth_body = || value(&pointing.to_body(&ephemeris.to_earth()));
    // The zone exchanges the vectors of the targets themselves.
    let aligned = match law.science {
        ScienceRule::Aligned { axes, .. } if attitude.window.activity == Activity::Science => {
            aligned_vectors(&axes, ephemeris).filter(|_| !attitude.slewing)
        }
        _ => None,
    };
    PointingSolution {
        second: keeps_nadir.then(|| ephemeris.to_planet()),
        antenna: (is_downlink && !law.requested.alternate)
            .then(|| Beam::AtTheEarth(hardware.antennas.toward(&earth_body()))),
        downlink: DownlinkStatus::from_attitude(attitude),
        reachable: !attitude.slewing && (is_downlink || attitude.margins.iter().all(|margin| *margin >= 0.0)),
        ..PointingSolution::at(aligned.unwrap_or_else(|| pointing.vectors()))
    }
}
