//! The keys of a plan file.
#![allow(non_snake_case, reason = "keys are named as in the file")]

use physics::toml::Written as _;

use super::{
    command::CommandKey,
    encounter::{ApproachKey, Arrives, CovarianceFile},
};
use crate::reading::{
    At, InputFile,
    quantities::{
        Angle, Count, Flights, FromZero, Length, LengthFromMeter, LengthFromZero, Margin, Moment, Momentum,
        QuarterTurn, Share, SpanFromHour, SpanFromMinute, SpanFromZero, Triple,
    },
    tables,
};

tables! {
/// Task of a plan: a mission, the ranges of arrays and attitude in its free windows (in an orbit phase: the Sun's place in its
/// downlinks), and what its momentum is kept below. Times,
/// angles and momenta are SI numbers or strings with a unit.
struct PlanKeys makes #[derive(Clone, Debug)] pub struct PlanValues {
    /// The mission of MomentumPlant in guided flight, with spacecraft or model and `momentum.strategy` dumpsOnly, in cruise or in an orbit
    /// phase. The path is relative to this file.
    mission: At<InputFile>,
    /// Time from its start for which the mission stays as it is, arrays included.
    freeze as freeze_s: At<SpanFromZero> = "14 d",
    /// Distance of the points at which momentum and path are looked at, by which the partials of a flyby are exact; "1 h" unless given,
    /// "10 min" in an orbit phase.
    every as every_s: Option<SpanFromMinute>,
    /// Length of the windows that the free time after `freeze` is cut into.
    window as window_s: At<SpanFromHour> = "3 d",
    /// Limit of the momentum.
    momentum: MomentumKeys => |_| MomentumKeys::default().value(),
    /// Offsets of the arrays from the Sun.
    sunOffset as sun_offset: At<SunOffsetKeys> => |_| At::<SunOffsetKeys>::default().value(),
    /// Largest windmill angle of the arrays, either way; 0 for none.
    windmill as windmill_rad: At<QuarterTurn> = "2 deg",
    /// Largest tilt of the Sun off -Y in downlinks; none unless given, in an orbit phase that of the keep-in zone.
    tilt: TiltKeys => |_| TiltKeys::default().value(),
    /// Largest share of a window in the attitude turned by 180 deg about the Sun line; 0 for none.
    alternation: At<Share> = 0.5,
    /// Ground contacts, in the order of time: no alternate attitude in them.
    contact as contacts: At<Vec<At<ContactKeys>>> => |_| At::default(),
    /// Share of every window that contacts take, where none is listed: no alternate attitude in it.
    contactShare as contact_share: At<Share> = 0,
    /// Activities whose price is reported: what adding them would cost.
    activity as activities: Vec<At<ActivityKeys>> => |_| Vec::new(),
    /// Encounter with a planet that the plan aims at.
    flyby: Option<At<FlybyKeys>>,
    /// State from orbit determination that the plan begins with, instead of the mission's.
    update: Option<At<UpdateKeys>>,
    /// Manoeuvres that would do the same.
    compare: Option<At<CompareKeys>>,
    /// Flights of the plan with errors.
    montecarlo as monte_carlo: Option<At<MonteCarloKeys>>,
} rules {
    Excludes contactShare => contact: "contactShare beside [[contact]]", "one of them";
}

/// Limit of the momentum.
struct MomentumKeys makes #[derive(Clone, Debug)] pub struct MomentumBound or Default {
    /// Greatest length of `momentum.inertial`, under `momentum.convention` bodyIntegral greatest component of `momentum.body`; the least
    /// `dump.threshold` unless given.
    limit as limit_n_m_s: Option<Momentum>,
    /// Share of the limit that is left.
    margin: Margin = 0,
    /// The file of a refit (JSON): its centre of mass and scale of sunlight are simulated, three sigma of its covariance are left.
    refit: Option<At<InputFile>>,
    /// Dumps that the plan may have. A plan that needs more ends with status 1.
    dumps: Count = 0,
} rules {
    Excludes margin => refit: "margin beside refit", "one of them";
}

/// Offsets of the arrays.
struct SunOffsetKeys makes #[derive(Clone, Debug)] pub struct SunOffset or Default {
    /// Whether windows may leave the baseline, the fewest steps that keep the light on the cells in its corridor.
    change: bool = false,
    /// Largest change off the baseline.
    largest as largest_rad: QuarterTurn = "5 deg",
}

/// Largest tilt, either way.
struct TiltKeys makes #[derive(Clone, Debug)] pub struct Tilt or Default {
    /// Largest tilt of the Sun's azimuth, from -Y toward +X, within the keep-in zone.
    azimuth as azimuth_rad: Option<QuarterTurn>,
    /// Largest tilt of the Sun's elevation, positive toward -Z, within the keep-in zone.
    elevation as elevation_rad: Option<QuarterTurn>,
}

/// A ground contact.
struct ContactKeys makes #[derive(Clone, Debug)] pub struct Contact {
    /// When it begins: a date or simulation time.
    start: Moment,
    /// When it ends.
    stop: Moment,
}

/// An activity that might be added.
struct ActivityKeys called "activity" makes #[derive(Clone, Debug)] pub struct Activity {
    /// Name of the activity.
    name: String,
    /// When it begins: a date or simulation time.
    start: Moment,
    /// When it ends.
    stop: Moment,
    /// Its command, with the keys of `[[command]]` in a timeline but at and until.
    command: CommandKey,
}

/// Aim at a planet: `bT` and `bR`, or `altitude` and `angle`, where B is that of the
/// hyperbola that osculates `encounter.leadTime` before the closest approach. Without these nothing is planned.
struct FlybyKeys makes #[derive(Clone, Debug)] pub struct Flyby {
    /// The planet: the mission's `encounter.body`.
    body: At<String>,
    /// Component of B along T.
    bT as b_t_m: Option<At<Length>>,
    /// Component of B along R.
    bR as b_r_m: Option<At<Length>>,
    /// Altitude of the closest approach.
    altitude as altitude_m: Option<At<Length>>,
    /// Angle of B from T toward R.
    angle as angle_rad: Option<At<Angle>>,
    /// Time of arrival: a date or simulation time; with a fixed arrival.
    time: Option<At<Moment>>,
    /// Whether the time of arrival is a goal too; free unless given.
    arrival: Arrives => |_| Arrives::Free,
    /// From when on the plan may change the mission, a date or simulation time, instead of `freeze`; arrays before it by timeline or
    /// `sunOffset`.
    from: Option<At<Moment>>,
    /// Greatest miss.
    tolerance as tolerance_m: LengthFromMeter = "1 km",
}

/// State from orbit determination, EME2000 from `orbit.center`.
struct UpdateKeys makes #[derive(Clone, Debug)] pub struct Update {
    /// Time of the state: a date or simulation time; the mission of the plan starts there, with the momentum that its flight has then.
    at: At<Moment>,
    /// Position in m; that of the mission unless given.
    position as position_m: Option<Triple>,
    /// Velocity in m/s; that of the mission unless given.
    velocity as velocity_m_s: Option<Triple>,
    /// Covariance of position (m) and velocity (m/s) for `[montecarlo]`: six rows of six numbers, as CSV. The path is relative to this file.
    covariance: Option<CovarianceFile>,
}

/// Manoeuvres that would do the same: approach manoeuvres before the flyby, and one behind it that makes up for what is left.
struct CompareKeys makes #[derive(Clone, Debug)] pub struct Compare {
    /// Standard deviation of their direction about each axis across.
    directionError as direction_error_rad: QuarterTurn = "0.2 deg",
    /// Standard deviation of their size, as a share.
    magnitudeError as magnitude_error: Share = 0.001,
    /// Times of approach manoeuvres, before the arrival.
    approach as approach_s: ApproachKey = ["-42 d"],
    /// Time of the departure manoeuvre, after the arrival.
    departure as departure_s: SpanFromHour = "30 d",
    /// Time at which that manoeuvre leads back to the flight through the aim: a date or simulation time.
    next: At<Moment>,
}

/// Flights of the plan with errors.
struct MonteCarloKeys makes #[derive(Clone, Copy, Debug)] pub struct MonteCarlo {
    /// How many.
    runs: Flights = 200,
    /// Seed of the draws. Manoeuvres of run n have `noise.seed` n.
    seed: Count = 1,
    /// Standard deviation of each coordinate of the centre of mass.
    centerOfMass as center_of_mass_m: LengthFromZero = 0,
    /// Standard deviation of `solar.scale`.
    scale: FromZero = 0,
}
}
