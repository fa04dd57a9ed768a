//! Scan patterns on top of a pointing (paper 001, "Scan patterns"): motion of each axis, five frames, compatibility.
//!
//! Each axis moves at its constant rate for its duration, holds for its pause and moves again, back where it reverses, as
//! often as it has segments (0: without end); then it holds. At a corner, and within the tolerance of time before it, the
//! motion that begins counts. Rotations are
//! right-handed about x, y and z of the frame in turn, the axes staying where they are: Rz Ry Rx. A scan in the body frame
//! turns the boresight, one in any other frame moves the aimpoint; the attitude law stays as it is.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::aimpoint::{Aimpoint, AimpointKind};
use super::command::{ScanCommand, ScanFrame};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::lvlh::lvlh_axes;
use crate::guidance::geometry::moving::{Moving, MovingMatrix, MovingVector, rotation_about};
use crate::numerics::spacing::spacing;

/// Scan frames allowed for each kind of aimpoint. The paper prints no matrix; the default is an assumption.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScanCompatibility {
    /// By [`ScanFrame`], then by [`AimpointKind`].
    pub allowed: [[bool; 4]; 5],
}

/// Body scans go with everything (said by the paper), and so do inertial rotations. A translation needs a point at a
/// distance (the paper's example), along the planet's axes one that belongs to the planet. A rotation in the local frame goes
/// with what stands in that frame: its own directions and the planet. By [`ScanFrame`], then by [`AimpointKind`].
pub const DEFAULT_COMPATIBILITY: [[bool; 4]; 5] = [
    // direction, local direction, point, planet point
    [true, true, true, true],
    [true, true, true, true],
    [false, false, true, true],
    [false, false, false, true],
    [false, true, false, true],
];

impl Default for ScanCompatibility {
    fn default() -> Self {
        Self { allowed: DEFAULT_COMPATIBILITY }
    }
}

impl ScanCompatibility {
    /// Whether a scan in this frame goes with this kind of aimpoint.
    pub fn allows(&self, frame: ScanFrame, kind: AimpointKind) -> bool {
        self.allowed[frame as usize][kind as usize]
    }

    /// The boresight and aim at a time of a scan from `basic`; `None` where none is commanded, it does not go with the kind of
    /// aimpoint, or the moved aimpoint has no direction: then the basic pointing stands.
    pub fn scanned(
        &self,
        basic: &Scanned,
        kind: AimpointKind,
        command: &ScanCommand,
        ephemeris: &EphemerisAtTime,
        time: ScanTime,
    ) -> Option<Scanned> {
        let frame = command.frame.filter(|frame| self.allows(*frame, kind))?;
        let mut moved = *basic;
        match frame {
            ScanFrame::Body => moved.boresight_body = rotation(command, time) * basic.boresight_body,
            ScanFrame::InertialRotation => moved.toward = rotation(command, time) * basic.toward,
            ScanFrame::InertialTranslation => moved.toward += translation_m(command, time),
            ScanFrame::PlanetTranslation => {
                let planet_from_inertial = ephemeris.planet.planet_from_inertial(ephemeris.epoch_s);
                moved.toward += planet_from_inertial.tr_mul(&translation_m(command, time));
            }
            ScanFrame::LvlhRotation => {
                let inertial_from_lvlh = lvlh_axes(ephemeris, command.reference.unwrap_or_default())?;
                // The change alone is turned back: a turn by nothing then changes no bit.
                let change = rotation(command, time) - MovingMatrix::identity();
                moved.toward += inertial_from_lvlh * (change * inertial_from_lvlh.tr_mul(&basic.toward));
            }
        }
        Aimpoint::new(moved.toward, kind).is_some().then_some(moved)
    }
}

/// Boresight and aimpoint under a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scanned {
    /// The boresight, body frame.
    pub boresight_body: MovingVector,
    /// From the spacecraft to the aimpoint, EME2000.
    pub toward: MovingVector,
}

/// How far a scan is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScanTime {
    /// Since it began, in s.
    pub elapsed_s: f64,
    /// Rounding of the two times whose difference it is, in s: a corner so near counts as reached.
    pub tolerance_s: f64,
}

/// Offset of one axis and its rate: `speed` per second in each motion.
pub fn axis_offset(command: &ScanCommand, axis: usize, speed: f64, time: ScanTime) -> Moving {
    let elapsed_s = time.elapsed_s;
    let tolerance_s = time.tolerance_s + 4.0 * spacing(elapsed_s);
    let duration_s = command.duration_s[axis];
    let pause_s = command.pause_s[axis].max(0.0);
    let moves = duration_s > 0.0 && elapsed_s >= -tolerance_s && speed != 0.0;
    if !moves {
        return Moving::from_re(0.0);
    }
    let cycle_s = duration_s + pause_s;
    let start_of = |cycle: f64| if cycle > 0.0 { cycle * cycle_s } else { 0.0 };
    let mut cycle = (elapsed_s / cycle_s).floor();
    // The division may round across an edge that the product puts exactly.
    if elapsed_s < start_of(cycle) - tolerance_s {
        cycle -= 1.0;
    } else if elapsed_s >= start_of(cycle + 1.0) - tolerance_s {
        cycle += 1.0;
    }
    let back = command.reverse[axis];
    // Seconds of forward motion that the finished motions leave.
    let net_s = |count: f64| {
        if back {
            (count % 2.0) * duration_s
        } else if count > 0.0 {
            count * duration_s
        } else {
            0.0
        }
    };
    let segments = f64::from(command.segments[axis]);
    if segments > 0.0 && cycle >= segments {
        return Moving::from_re(speed * net_s(segments));
    }
    let sign = if back && cycle % 2.0 == 1.0 { -1.0 } else { 1.0 };
    let since_corner_s = elapsed_s - start_of(cycle);
    let phase_s = if since_corner_s > tolerance_s { since_corner_s } else { 0.0 };
    if phase_s < duration_s - tolerance_s {
        Moving::new(speed * (net_s(cycle) + sign * phase_s), sign * speed)
    } else {
        Moving::from_re(speed * net_s(cycle + 1.0))
    }
}

/// When the next motion of an axis begins or ends, in s since the scan began; `None` where nothing moves any more.
pub fn next_corner_s(command: &ScanCommand, time: ScanTime) -> Option<f64> {
    command.frame?;
    let speeds = (0..3).map(|axis| (axis, [command.rate_rad_s[axis], command.speed_m_s[axis]]));
    let moving = speeds.filter(|(axis, speeds)| *speeds != [0.0; 2] && command.duration_s[*axis] > 0.0);
    let next = moving.filter_map(|(axis, _)| {
        let (duration_s, pause_s) = (command.duration_s[axis], command.pause_s[axis].max(0.0));
        let (cycle_s, tolerance_s) = (duration_s + pause_s, time.tolerance_s + 4.0 * spacing(time.elapsed_s));
        let reached_s = time.elapsed_s + tolerance_s;
        let cycle = (reached_s / cycle_s).floor().max(0.0);
        let corners_s =
            [cycle * cycle_s + duration_s, (cycle + 1.0) * cycle_s, (cycle + 1.0) * cycle_s + duration_s];
        let segments = f64::from(command.segments[axis]);
        let end_s = if segments > 0.0 { segments * cycle_s - pause_s } else { f64::INFINITY };
        corners_s.into_iter().find(|corner_s| *corner_s > reached_s && *corner_s <= end_s)
    });
    next.reduce(f64::min)
}

/// Rz Ry Rx; axes that do not turn are left out.
fn rotation(command: &ScanCommand, time: ScanTime) -> MovingMatrix {
    let mut turned = MovingMatrix::identity();
    for axis in (0..3).filter(|axis| command.rate_rad_s[*axis] != 0.0) {
        turned = rotation_about(axis, axis_offset(command, axis, command.rate_rad_s[axis], time)) * turned;
    }
    turned
}

fn translation_m(command: &ScanCommand, time: ScanTime) -> MovingVector {
    Vector3::from_fn(|axis, _| axis_offset(command, axis, command.speed_m_s[axis], time))
}

#[cfg(test)]
mod tests;
