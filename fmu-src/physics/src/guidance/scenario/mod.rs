//! The scenarios of paper 001's Table 5: which vectors each sets, with limb and scan.
//!
//! All but the generic one roll -Y toward the Sun. A scan may move any but downlink and burn.

use nalgebra::Vector3;

use crate::guidance::burn::delta_v::BurnPointing;
use crate::guidance::downlink::default_downlink::DefaultDownlink;
use crate::guidance::downlink::sun_direction::{
    DownlinkRequest, DownlinkSunDirection, SunRequest, downlink, half_turned,
};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::lighting::SubsolarMethod;
use crate::guidance::geometry::limb::{LimbPoint, generic_limb, terminator_limb};
use crate::guidance::geometry::moving::{Moving, MovingVector, fixed, unit, unit_normal, value};
use crate::guidance::orbit_phase::attitudes::ScienceRule;
use crate::guidance::orbit_phase::guided::{DownlinkStatus, Guided, GuidedAttitude};
use crate::guidance::orbit_phase::schedule::Activity;
use crate::guidance::pointing::aimpoint::{Aimpoint, AimpointKind, aimpoint, body_roll, external_roll};
use crate::guidance::pointing::aligned::aligned_vectors;
use crate::guidance::pointing::antenna::{Antennas, Beam};
use crate::guidance::pointing::boresight::{Boresight, DeviceAngle, Gimbal, boresight, instrument_boresight};
use crate::guidance::pointing::command::{BodyRollCommand, BoresightOption, PointingCommand, Scenario};
use crate::guidance::pointing::law::{Pointing, PointingVectors};
use crate::guidance::pointing::scan::{ScanCompatibility, ScanTime, Scanned};
use crate::spacecraft::Instrument;

/// Devices of the spacecraft and settings that pointing options read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuidanceHardware<'a> {
    /// Instruments by their rows.
    pub instruments: &'a [Instrument],
    /// The gimbal of the instrument that has one.
    pub gimbal: Option<Gimbal>,
    /// Antennas to the Earth.
    pub antennas: &'a Antennas,
    /// The default downlink with them.
    pub default_downlink: &'a DefaultDownlink,
    /// Definition of the subsolar point.
    pub subsolar: SubsolarMethod,
    /// Scan frames allowed for each kind of aimpoint.
    pub scans: ScanCompatibility,
}

/// Progress of a command: clocks of its motions, and the direction of the Sun in a downlink.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointingProgress {
    /// How far the scan is; `None` while there is none.
    pub scan: Option<ScanTime>,
    /// Since the limb scenario began, in s.
    pub limb_elapsed_s: f64,
    /// Selected direction of the Sun in downlink; `None`: as requested.
    pub downlink_sun: Option<DownlinkSunDirection>,
    /// Requested direction of the Sun in downlink, and whether the attitude is turned about the Sun line.
    pub requested: SunRequest,
    /// Thrust direction that a burn commands.
    pub burn: Option<BurnPointing>,
}

/// The pointing vectors of a command, with its flags.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointingSolution {
    /// For the attitude law.
    pub vectors: PointingVectors,
    /// The gimbal's angle, where the command sets it; out of range it is the nearest bound.
    pub gimbal: Option<DeviceAngle>,
    /// From the spacecraft to the second target, which the gimbal follows, EME2000.
    pub second: Option<MovingVector>,
    /// The antenna's azimuth, where the command sets it; out of range it is the nearest bound.
    pub antenna: Option<Beam>,
    /// Whether the boresight is on the aimpoint that was requested.
    pub reachable: bool,
    /// Whether an angle that was requested is out of its range.
    pub clamped: bool,
    /// Whether a scan moves boresight or aimpoint.
    pub scan_active: bool,
    /// Outputs of a downlink.
    pub downlink: DownlinkStatus,
    /// Margins at whose roots the law of a downlink takes another form; infinite otherwise.
    pub margins: [f64; 2],
}

/// Inputs of a scenario.
struct Reading<'a> {
    command: &'a PointingCommand,
    hardware: &'a GuidanceHardware<'a>,
    ephemeris: &'a EphemerisAtTime,
    progress: &'a PointingProgress,
}

/// The vectors of a command, its scan included; `None` where it has no scenario, or boresight or aimpoint no direction: then the
/// last command stays.
pub fn pointing_solution(
    command: &PointingCommand,
    hardware: &GuidanceHardware<'_>,
    ephemeris: &EphemerisAtTime,
    progress: &PointingProgress,
) -> Option<PointingSolution> {
    let r = Reading { command, hardware, ephemeris, progress };
    let solution = match command.scenario? {
        Scenario::Generic => {
            let boresight = boresight(&command.boresight, hardware.gimbal.as_ref(), hardware.antennas)?;
            let mut solution = r.sunward(boresight, r.aimpoint()?);
            solution.vectors.body_roll = body_roll(&command.body_roll);
            solution.vectors.external_roll = external_roll(&command.external_roll, ephemeris);
            solution
        }
        Scenario::PlusZ => r.sunward(r.instrument()?, r.aimpoint()?),
        Scenario::Nadir => {
            let nadir = Aimpoint::new(ephemeris.to_planet(), AimpointKind::PlanetPoint)?;
            r.sunward(r.instrument()?, nadir)
        }
        Scenario::Gimbal => {
            let boresight = Boresight::gimbal(command.boresight.angle_rad, hardware.gimbal.as_ref()?);
            r.sunward(boresight, r.aimpoint()?)
        }
        Scenario::DoubleTarget => {
            let second = aimpoint(&command.second_aimpoint, ephemeris, hardware.subsolar);
            let second = second.map(|second| second.toward);
            PointingSolution { second, ..r.sunward(r.instrument()?, r.aimpoint()?) }
        }
        Scenario::Downlink => r.antenna_at_the_earth()?,
        Scenario::LimbTerminator => r.limb(terminator_limb(ephemeris, r.limb_height()))?,
        Scenario::LimbGeneric => {
            let reference = command.limb.reference.unwrap_or_default();
            r.limb(generic_limb(ephemeris, reference, command.limb.azimuth_rad, r.limb_height()))?
        }
        Scenario::Burn => {
            let burn = progress.burn.as_ref()?;
            PointingSolution::at(r.rolled_sunward(fixed(burn.boresight_body), burn.direction))
        }
        // Its own law gives the attitude, not vectors of a scenario.
        Scenario::OrbitPhase => return None,
    };
    let directed =
        |vector: &MovingVector| value(vector).amax() > 0.0 && vector.iter().all(|x| x.re.is_finite());
    directed(&solution.vectors.boresight_body).then_some(solution)
}

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

/// Whether the body roll axis of a command lies along the boresight that it gives: then a fallback stands in for it.
pub fn is_rolled_about_boresight(command: &PointingCommand, hardware: &GuidanceHardware<'_>) -> bool {
    use Scenario::{DoubleTarget, Generic, LimbGeneric, LimbTerminator, Nadir, PlusZ};
    let boresight_body = match command.scenario {
        Some(Generic) => boresight(&command.boresight, hardware.gimbal.as_ref(), hardware.antennas),
        Some(PlusZ | Nadir | DoubleTarget | LimbTerminator | LimbGeneric) => {
            instrument_boresight(hardware.instruments, command.boresight.instrument).map(Boresight::fixed)
        }
        _ => None,
    };
    let roll = if command.scenario == Some(Generic) { command.body_roll } else { BodyRollCommand::default() };
    boresight_body
        .is_some_and(|it| unit(&it.body).is_some() && unit_normal(&it.body, &body_roll(&roll)).is_none())
}

impl PointingSolution {
    /// These vectors without a device.
    pub fn at(vectors: PointingVectors) -> Self {
        Self {
            vectors,
            gimbal: None,
            second: None,
            antenna: None,
            reachable: true,
            clamped: false,
            scan_active: false,
            downlink: DownlinkStatus::default(),
            margins: [f64::INFINITY; 2],
        }
    }

    /// The gimbal's angle in the attitude that is commanded in the end.
    pub fn gimbal_angle(&self, pointing: &Pointing, gimbal: Option<&Gimbal>) -> Option<DeviceAngle> {
        let second = self.second.zip(gimbal);
        let followed = second.map(|(second, gimbal)| gimbal.toward(&value(&pointing.to_body(&second))));
        followed.or(self.gimbal)
    }
}

impl Reading<'_> {
    fn instrument(&self) -> Option<Boresight> {
        instrument_boresight(self.hardware.instruments, self.command.boresight.instrument)
            .map(Boresight::fixed)
    }

    fn aimpoint(&self) -> Option<Aimpoint> {
        aimpoint(&self.command.aimpoint, self.ephemeris, self.hardware.subsolar)
    }

    /// Height along the radius of the limb point, in m.
    fn limb_height(&self) -> Moving {
        let limb = &self.command.limb;
        Moving::new(limb.height_m + limb.height_rate_m_s * self.progress.limb_elapsed_s, limb.height_rate_m_s)
    }

    fn limb(&self, limb: Option<LimbPoint>) -> Option<PointingSolution> {
        let limb = limb?;
        let aimpoint = Aimpoint::new(self.ephemeris.to_planet() + limb.position, AimpointKind::PlanetPoint)?;
        Some(self.sunward(self.instrument()?, Aimpoint { reachable: limb.exists, ..aimpoint }))
    }

    /// -Y rolled toward the Sun.
    fn rolled_sunward(&self, boresight_body: MovingVector, aimpoint: MovingVector) -> PointingVectors {
        PointingVectors {
            boresight_body,
            aimpoint,
            body_roll: fixed(-Vector3::y()),
            external_roll: self.ephemeris.to_sun(),
        }
    }

    /// The boresight at the aimpoint with -Y rolled toward the Sun, and the scan on top.
    fn sunward(&self, boresight: Boresight, aimpoint: Aimpoint) -> PointingSolution {
        let basic = Scanned { boresight_body: boresight.body, toward: aimpoint.toward };
        let scan = self.progress.scan.and_then(|time| {
            let scans = &self.hardware.scans;
            scans.scanned(&basic, aimpoint.kind, &self.command.scan, self.ephemeris, time)
        });
        let Scanned { boresight_body, toward } = scan.unwrap_or(basic);
        PointingSolution {
            gimbal: boresight.gimbal,
            antenna: boresight.antenna.map(Beam::Commanded),
            reachable: aimpoint.reachable,
            clamped: boresight.gimbal.is_some_and(|angle| !angle.in_range)
                || boresight.antenna.is_some_and(|antenna| !antenna.is_in_range()),
            scan_active: scan.is_some(),
            ..PointingSolution::at(self.rolled_sunward(boresight_body, toward))
        }
    }

    /// An antenna at the Earth: a fan at the commanded azimuth where the boresight is one, otherwise where it puts
    /// the Sun in its place. No scan moves it.
    fn antenna_at_the_earth(&self) -> Option<PointingSolution> {
        let boresight = &self.command.boresight;
        let commanded = boresight.option == Some(BoresightOption::PhasedArray);
        let place = self.progress.downlink_sun;
        let request = DownlinkRequest {
            antenna_azimuth_rad: commanded.then_some(boresight.azimuth_rad),
            sun_body: place.map_or(self.progress.requested.sun, |place| place.angles),
            earth_ahead: place.map(|place| place.earth_ahead),
        };
        let found =
            downlink(&self.ephemeris.to_sun(), &self.ephemeris.to_earth(), self.hardware.antennas, &request)?;
        let alternate = self.progress.requested.alternate && !commanded;
        let mut vectors = found.vectors;
        if alternate {
            vectors.aimpoint = half_turned(&vectors.aimpoint, &self.ephemeris.to_sun());
        }
        Some(PointingSolution {
            antenna: (!alternate).then_some(Beam::AtTheEarth(found.antenna)),
            clamped: found.clamped,
            downlink: DownlinkStatus { active: true, clamped: found.clamped },
            margins: found.margins,
            ..PointingSolution::at(vectors)
        })
    }
}

#[cfg(test)]
pub(crate) mod scenario_tests;
