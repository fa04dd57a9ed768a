//! Attitudes by name: one body axis exactly at a target, a second one as near as possible to another.
//!
//! `lvlh` is +Z at nadir and -Y along the orbit normal, `yawSteering` +Z at nadir and p x Z toward the Sun, p the panels' common axis
//! (-Y toward the Sun without panels), `sunPointing` -Y at the Sun and +Z toward ecliptic north. A given attitude is +Z and -Y at
//! where it has them.

use core::fmt;

use nalgebra::Vector3;
use serde::Deserialize;

use super::panel::Panel;
use crate::attitude::Attitude;
use crate::enumeration::{Enumerated, enumeration};

/// Cosine of 5 deg: panels whose axes are nearer to one line than this turn about one axis, and one nearer to Z turns about Z.
const SAME_LINE_COSINE: f64 = 0.996_194_698_091_745_5;
/// Sine of the least angle between two directions that span a plane.
const PARALLEL: f64 = 1e-9;

enumeration! {
    /// Direction that a body axis is turned to.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
    #[serde(rename_all = "camelCase")]
    pub enum TargetItem {
        /// The planet's centre.
        1 => Nadir,
        /// The velocity about the orbit's centre.
        2 => Velocity,
        /// The orbit normal, position x velocity.
        3 => OrbitNormal,
        /// The Sun.
        4 => Sun,
        /// The Earth.
        5 => Earth,
        /// The direction of rightAscension and declination in EME2000.
        6 => Star,
        /// North of the ecliptic of J2000.
        7 => EclipticNorth,
    }
}

enumeration! {
    /// Attitude that its name alone gives.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
    #[serde(rename_all = "camelCase")]
    pub enum AttitudeName {
        /// Local vertical, local horizontal: +Z to nadir, -Y along the orbit normal (position x velocity).
        4 => Lvlh,
        /// Yaw steering: +Z to nadir, p x Z toward the Sun, p the panels' common axis; -Y toward the Sun without panels.
        5 => YawSteering,
        /// -Y to the Sun, +Z toward ecliptic north.
        6 => SunPointing,
    }
}

/// Direction in space that a body axis is turned to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointingTarget {
    /// Its item.
    pub item: TargetItem,
    /// Direction of a star; `None` of other items.
    pub star: Option<StarDirection>,
}

/// Direction fixed in EME2000.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StarDirection {
    /// Right ascension and declination, in rad.
    Angles([f64; 2]),
    /// Along a vector of any length.
    Vector(Vector3<f64>),
}

impl TargetItem {
    /// The target, a star in this direction.
    pub fn target(self, star_rad: [f64; 2]) -> PointingTarget {
        let star = (self == Self::Star).then_some(StarDirection::Angles(star_rad));
        PointingTarget { item: self, star }
    }
}

/// A body axis and what it is turned to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TargetedAxis {
    /// Body frame, of any length.
    pub axis_body: Vector3<f64>,
    /// The target.
    pub target: PointingTarget,
}

impl TargetedAxis {
    /// An axis whose target is no star.
    const fn new(axis_body: Vector3<f64>, item: TargetItem) -> Self {
        Self { axis_body, target: PointingTarget { item, star: None } }
    }
}

/// Two body axes and their targets, which give an attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlignedAxes {
    /// Exactly at its target.
    pub align: TargetedAxis,
    /// As near as possible to its target.
    pub constrain: TargetedAxis,
}

impl AlignedAxes {
    /// +Z at nadir, -Y along the orbit normal.
    pub const LVLH: Self = Self {
        align: TargetedAxis::new(Vector3::new(0.0, 0.0, 1.0), TargetItem::Nadir),
        constrain: TargetedAxis::new(Vector3::new(0.0, -1.0, 0.0), TargetItem::OrbitNormal),
    };

    /// Whether it aims at the centre of a planet, which is none about the Sun.
    pub fn needs_planet(&self) -> bool {
        [self.align, self.constrain].iter().any(|axis| axis.target.item == TargetItem::Nadir)
    }

    /// Refuses axes and targets that give no attitude.
    fn checked(self) -> Result<Self, AttitudeRefusal> {
        let Self { align, constrain } = self;
        for (part, axis) in [(AttitudePart::AlignAxis, align), (AttitudePart::ConstrainAxis, constrain)] {
            if axis.axis_body == Vector3::zeros() {
                return Err(AttitudeRefusal::new(part, "a zero vector", "a vector of any length but 0"));
            }
        }
        if align.axis_body.normalize().cross(&constrain.axis_body.normalize()).norm() <= PARALLEL {
            let allowed = "an axis across that of align";
            return Err(AttitudeRefusal::new(AttitudePart::ConstrainAxis, "parallel axes", allowed));
        }
        if align.target == constrain.target {
            let found = format!("the target {} twice", align.target.item.name());
            return Err(AttitudeRefusal::new(
                AttitudePart::ConstrainTarget,
                found,
                "another target than that of align",
            ));
        }
        Ok(self)
    }
}

/// An attitude by its name, with what the name leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NamedAttitude {
    /// Attitude that its name alone gives.
    Named(AttitudeName),
    /// Quaternion from EME2000 to the body, scalar last.
    Inertial([f64; 4]),
    /// Two axes and their targets.
    Aligned(AlignedAxes),
}

impl NamedAttitude {
    /// Axes and targets on a spacecraft with these panels.
    ///
    /// # Errors
    /// A quaternion whose norm is off 1, axes or targets that give no attitude, `yawSteering` with panels along Z or on several axes.
    pub fn axes(&self, panels: &[Panel]) -> Result<AlignedAxes, AttitudeRefusal> {
        match self {
            Self::Named(AttitudeName::Lvlh) => Ok(AlignedAxes::LVLH),
            Self::Named(AttitudeName::YawSteering) => Ok(AlignedAxes {
                constrain: TargetedAxis::new(yaw_steering_axis(panels)?, TargetItem::Sun),
                ..AlignedAxes::LVLH
            }),
            Self::Named(AttitudeName::SunPointing) => Ok(AlignedAxes {
                align: TargetedAxis::new(-Vector3::y(), TargetItem::Sun),
                constrain: TargetedAxis::new(Vector3::z(), TargetItem::EclipticNorth),
            }),
            Self::Inertial(q) => {
                let attitude = Attitude::from_quaternion(*q).map_err(|error| {
                    let (found, allowed) = (format!("{q:?}, of norm {}", error.norm), error.allowed);
                    AttitudeRefusal { part: AttitudePart::Quaternion, found, allowed }
                })?;
                let inertial_from_body = attitude.inertial_from_body();
                let held = |axis_body: Vector3<f64>| {
                    let star = Some(StarDirection::Vector(inertial_from_body * axis_body));
                    TargetedAxis { axis_body, target: PointingTarget { item: TargetItem::Star, star } }
                };
                Ok(AlignedAxes { align: held(Vector3::z()), constrain: held(-Vector3::y()) })
            }
            Self::Aligned(axes) => axes.checked(),
        }
    }
}

/// Body axis that yaw steering turns toward the Sun.
fn yaw_steering_axis(panels: &[Panel]) -> Result<Vector3<f64>, AttitudeRefusal> {
    let Some(first) = panels.first() else { return Ok(-Vector3::y()) };
    let refuse = |found| {
        let allowed = "panels that turn about one axis more than 5 deg off Z, or another attitude";
        Err(AttitudeRefusal::new(AttitudePart::Name, found, allowed))
    };
    match common_axis(panels) {
        None => refuse(format!("yawSteering, and {} panels on several axes", panels.len())),
        Some(axis) if is_along(&axis, &Vector3::z()) => {
            refuse(format!("yawSteering, and the axis of panel {:?} along Z", first.name))
        }
        Some(axis) => Ok(axis.cross(&Vector3::z()).normalize()),
    }
}

/// Axis of the first panel where all of them turn about one line.
fn common_axis(panels: &[Panel]) -> Option<Vector3<f64>> {
    let first = panels.first()?.axis_body;
    panels.iter().all(|panel| is_along(&panel.axis_body, &first)).then_some(first)
}

/// Whether all panels turn about one axis more than 5 deg off X and off Z, which the nadir rule keeps from the Sun.
pub fn panels_need_yaw_steering(panels: &[Panel]) -> bool {
    common_axis(panels).is_some_and(|axis| !is_along(&axis, &Vector3::x()) && !is_along(&axis, &Vector3::z()))
}

/// Whether two unit vectors lie within 5 deg of one line.
fn is_along(one: &Vector3<f64>, other: &Vector3<f64>) -> bool {
    one.dot(other).abs() >= SAME_LINE_COSINE
}

/// Part of an attitude that is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AttitudePart {
    /// Its name.
    Name,
    /// The quaternion.
    Quaternion,
    /// The axis that is aligned.
    AlignAxis,
    /// The axis that is constrained.
    ConstrainAxis,
    /// The target of that axis.
    ConstrainTarget,
}

/// Refusal of an attitude, by the part of it.
#[derive(Clone, Debug, PartialEq)]
pub struct AttitudeRefusal {
    /// Part that is refused.
    pub part: AttitudePart,
    /// Content of that part.
    pub found: String,
    /// Content that it may have.
    pub allowed: &'static str,
}

impl AttitudeRefusal {
    fn new(part: AttitudePart, found: impl Into<String>, allowed: &'static str) -> Self {
        Self { part, found: found.into(), allowed }
    }
}

impl fmt::Display for AttitudeRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "found {}, allowed: {}", self.found, self.allowed)
    }
}

/// Attitude of a spacecraft by its file, and how fast it turns to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointingSettings {
    /// The attitude.
    pub attitude: NamedAttitude,
    /// Rate of turns, in rad/s, where the file gives one.
    pub slew_rate_rad_s: Option<f64>,
}
