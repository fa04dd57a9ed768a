//! The shape of limits, attitude and downlinks in a spacecraft file.

use super::written_time::WrittenTime;
use crate::spacecraft::pointing::{AttitudeName, TargetItem};
use crate::toml::{
    HalfTurn, Kilometers, NotNegative, Orbits, Point, Positive, QuarterTurn, QuarterTurnEither, TurnEither,
    tables,
};

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

/// Directions the Sun may have, symmetric about -Y.
struct SunKeepInDescription {
    /// Greatest azimuth in the XY plane from -Y toward +X, in deg.
    azimuth_deg as azimuth_rad: HalfTurn,
    /// Greatest elevation from the XY plane toward -Z, in deg.
    elevation_deg as elevation_rad: QuarterTurn,
    /// Greatest distance from the Sun at which commands of Guidance keep the zone, in m; any unless given.
    distance_m: Option<Positive>,
}

/// How the spacecraft stands while it observes, by a name, a quaternion, or two axes and their targets: the start values of
/// `guided.scienceRule`, `guided.attitude`, `guided.align`, `guided.constrain` and `guided.slewRate`, which `[start]` does not have
/// beside it. With it `guided.phase` is orbit by default.
struct PointingDescription {
    attitude: Option<AttitudeName>,
    /// Quaternion from EME2000 to the body, scalar last.
    quaternion: Option<[f64; 4]>,
    align: Option<TargetedAxisDescription>,
    constrain: Option<TargetedAxisDescription>,
    star: Option<StarDescription>,
    /// Greatest rate of turns, in deg/s; 0 is at once.
    slew_rate_deg_s: Option<NotNegative>,
}

/// A body axis and its target: that of `align` exactly, that of `constrain` as near as possible.
struct TargetedAxisDescription {
    /// Body frame, of any length.
    axis as axis_body: Point,
    /// The target.
    to: TargetItem,
}

/// Direction in EME2000 of `to = "star"`.
struct StarDescription {
    /// Right ascension, in deg.
    right_ascension_deg as right_ascension_rad: TurnEither,
    /// Declination, in deg.
    declination_deg as declination_rad: QuarterTurnEither,
}

/// When an antenna looks at the Earth, counted from periapsis; left out, there are no downlinks. The start values of
/// `guided.downlinkStart`, `guided.downlinkEnd`, `guided.downlinkEvery`, which `[start]` does not have beside it.
struct DownlinksDescription {
    /// Begin after periapsis: s, a string with a unit ("2 h"), or a share of the orbital period ("20 %").
    start: WrittenTime,
    /// End, after the begin, likewise.
    stop: WrittenTime,
    /// A downlink after every how many periapses; 0 is none.
    every: Orbits = 0,
}

/// Corridor of the light on the cells of panels, in suns: max(0, cosine of the angle to the Sun) over the square of the distance in
/// AU. The defaults of `articulation.*`.
struct ArticulationDescription {
    /// Least light, for power.
    min_suns: NotNegative = 0.0,
    /// Greatest light, for temperature.
    max_suns: Positive = 1e3,
    /// Light that panels with `control = "distance"` keep.
    target_suns: Positive = 1.0,
}

/// Zone in which the top deck, -Z, does not look at the planet: low above its subsolar point, which is hot. Guidance keeps it; left
/// out, `hotPole.enabled` is false.
struct HotPoleDescription {
    /// Below this height above the ellipsoid, in km.
    altitude_km as altitude_m: Kilometers,
    /// Within this angle from the subsolar point, in deg.
    angle_deg as angle_rad: HalfTurn,
    /// Least angle between -Z and the direction to the planet's centre, in deg.
    cone_deg as cone_rad: HalfTurn,
}
}
