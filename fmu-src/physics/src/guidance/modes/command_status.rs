//! Status of a guidance command in the attitude that the constraints allow: reached, clamped, linked.

use serde::{Deserialize, Serialize};

use super::sample_inputs::SampleContext;
use crate::guidance::constraints::constrained::ConstrainedPointing;
use crate::guidance::downlink::sun_direction::link;
use crate::guidance::geometry::moving::{MovingVector, value};
use crate::guidance::orbit_phase::guided::DownlinkStatus;
use crate::guidance::pointing::antenna::{AntennaRow, Beam};
use crate::guidance::pointing::boresight::DeviceAngle;
use crate::guidance::pointing::law::{Pointing, PointingVectors};
use crate::guidance::scenario::PointingSolution;

/// Status of a command.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CommandStatus {
    /// The gimbal's angle, and whether it is the one requested.
    pub gimbal: DeviceAngle,
    /// The antenna in use.
    pub antenna: Option<AntennaRow>,
    /// Azimuth of that antenna, in rad.
    pub antenna_azimuth_rad: f64,
    /// Angle between Sun and Earth, in rad.
    pub sun_separation_rad: f64,
    /// Whether there is a link with the Earth.
    pub link_available: bool,
    /// Whether the boresight is on the aimpoint.
    pub reachable: bool,
    /// Whether a fallback stands in for a roll vector, or there is no direction at all.
    pub degenerate: bool,
    /// Whether a scan moves boresight or aim.
    pub scan_active: bool,
    /// Status of a downlink.
    pub downlink: DownlinkStatus,
    /// Whether the keep-in zone changed the attitude.
    pub sun_keep_in: bool,
    /// Whether the hot-pole keep-out did.
    pub hot_pole: bool,
    /// Whether its cone is kept, in force or not.
    pub hot_pole_reached: bool,
    /// Whether something that was requested was clamped.
    pub clamped: bool,
}

impl CommandStatus {
    /// Status without an attitude.
    pub(super) const NOTHING: Self = Self {
        gimbal: DeviceAngle { angle_rad: 0.0, in_range: true },
        antenna: None,
        antenna_azimuth_rad: 0.0,
        sun_separation_rad: 0.0,
        link_available: false,
        reachable: false,
        degenerate: false,
        scan_active: false,
        downlink: DownlinkStatus { active: false, clamped: false },
        sun_keep_in: false,
        hot_pole: false,
        hot_pole_reached: true,
        clamped: false,
    };

    /// Status of an attitude within the constraints.
    pub(super) fn new(
        now: &SampleContext<'_>,
        solution: &PointingSolution,
        constrained: &ConstrainedPointing,
    ) -> Self {
        let SampleContext { settings, ephemeris, requested_sun, .. } = *now;
        let ConstrainedPointing { pointing, sun_keep_in, hot_pole: turn, hot_pole_reached } = *constrained;
        let hot_pole = turn.is_some();
        let earth_body = value(&pointing.to_body(&ephemeris.to_earth()));
        let is_moved = sun_keep_in || hot_pole;
        let antennas = settings.hardware.antennas;
        let beam = solution.antenna.map(|requested| match requested {
            // A fan's beam follows the Earth where a constraint moved the antenna off it.
            Beam::AtTheEarth(beam) if is_moved => antennas.following(beam, &earth_body),
            Beam::AtTheEarth(azimuth) | Beam::Commanded(azimuth) => azimuth,
        });
        let link = link(ephemeris, &earth_body, antennas, beam.as_ref(), &settings.link);
        let gimbal = solution
            .gimbal_angle(&pointing, settings.hardware.gimbal.as_ref())
            .unwrap_or(Self::NOTHING.gimbal);
        Self {
            gimbal,
            antenna: beam.and_then(|beam| beam.antenna),
            antenna_azimuth_rad: beam.map_or(0.0, |beam| beam.azimuth_rad),
            sun_separation_rad: link.map_or(0.0, |link| link.sun_separation_rad),
            link_available: link.is_some_and(|link| link.available),
            reachable: match solution.antenna {
                Some(Beam::AtTheEarth(_)) => link.is_some_and(|link| link.covered),
                _ => solution.reachable && is_on(&pointing, &solution.vectors),
            },
            degenerate: pointing.degenerate,
            scan_active: solution.scan_active,
            downlink: DownlinkStatus {
                clamped: solution.downlink.active
                    && (solution.downlink.clamped || requested_sun.is_moved || sun_keep_in),
                ..solution.downlink
            },
            sun_keep_in,
            hot_pole,
            hot_pole_reached,
            clamped: !hot_pole_reached || solution.clamped || !gimbal.in_range,
        }
    }
}

/// Whether the boresight is on the aimpoint, within what rounding leaves.
fn is_on(pointing: &Pointing, vectors: &PointingVectors) -> bool {
    const ROUNDING_RAD: f64 = 1e-9;
    let toward = |vector: &MovingVector| value(vector).try_normalize(0.0);
    let aimpoint_body = toward(&pointing.to_body(&vectors.aimpoint));
    let both = aimpoint_body.zip(toward(&vectors.boresight_body));
    both.is_some_and(|(aimpoint, boresight)| {
        aimpoint.cross(&boresight).norm() < ROUNDING_RAD && aimpoint.dot(&boresight) > 0.0
    })
}
