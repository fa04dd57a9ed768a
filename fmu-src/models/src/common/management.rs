//! Momentum management by sunlight: its parameters, and the manager they describe.

use fmi_export::{Choice, Failure, Integer, RealVector, Values, Variables};
use nalgebra::Vector3;
use physics::enumeration::Enumerated;
use physics::guidance::pointing::antenna::Antennas;
use physics::guidance::{NoCycle, Schedule};
use physics::management::{self, KeepInLimits, Manager, Strategy, TargetAxes, Targeting, TargetingMethod};
use physics::spacecraft::{Spacecraft, SunshadeModel};

use super::choices::choices;

/// The greatest number of cycles that predictive targets look ahead.
const LONGEST_HORIZON: i32 = management::LONGEST_HORIZON as i32;

choices! {
    /// What sunlight is used for during downlinks.
    MomentumStrategy(Strategy);
    /// Body components of momentum that sunlight brings to a target.
    MomentumTargetAxes(TargetAxes);
    /// How the Sun's place is computed.
    MomentumTargeting(TargetingMethod);
}

/// Spacecraft whose momentum is managed.
#[derive(Clone, Copy)]
pub(crate) struct ManagedSpacecraft<'s> {
    /// The spacecraft.
    pub spacecraft: &'s Spacecraft,
    /// Form in which the shade takes the light.
    pub sunshade: SunshadeModel,
    /// Its antennas.
    pub antennas: &'s Antennas,
    /// Limits of the Sun's azimuth and elevation about -Y.
    pub sun_limits_rad: [f64; 2],
    /// Sum of the wheels' biases, from which targets count.
    pub bias_body_n_m_s: Vector3<f64>,
}

/// Momentum that downlinks aim at.
#[derive(Variables)]
pub struct TargetingVariables {
    /// Body components of momentum that sunlight brings to a target.
    #[parameter(start = MomentumTargetAxes(TargetAxes::Xz))]
    pub target_axes: Choice<MomentumTargetAxes>,
    /// How the Sun's place is computed.
    #[parameter(start = MomentumTargeting(TargetingMethod::Exact))]
    pub targeting: Choice<MomentumTargeting>,
    /// Momentum in the body frame that a reactive downlink aims at, by momentum.convention, from the wheels' bias.
    #[parameter(unit = "N.m.s", min = -1e12, max = 1e12, start = [0.0; 3])]
    pub target: RealVector<3>,
    /// How many cycles predictive targets look ahead: each is the science after a downlink and the downlink after it, the first begins
    /// at the end of the downlink (or science that unloads) whose target is sought, the last ends with its science. Each downlink counts
    /// with what sunlight can do then, none in a solar conjunction, so that the target holds over a gap that lies within the horizon;
    /// a horizon that cannot be kept is shortened. The default is chosen: paper 000 names none, from 16 on the dumps of its Table 2 stay
    /// the same, each count within 1 of the paper's, since the conjunction on day 42 is prepared for in time; 1 looks at the next
    /// science alone. Each choice flies the horizon once ahead, so that its cost, and what it takes of solver.workLimit, grows in
    /// proportion. With momentum.convention = inertial, under which the body turns, it is one cycle whatever stands here; without a cycle
    /// to come targets are momentum.target.
    #[parameter(min = 1, max = LONGEST_HORIZON, start = 20)]
    pub horizon: Integer,
}

impl TargetingVariables {
    /// The target, body frame, in N m s.
    pub fn target_body_n_m_s(&self, values: &Values) -> Vector3<f64> {
        Vector3::from(values.vector(self.target))
    }

    /// The manager of a spacecraft's momentum by this strategy.
    pub(crate) fn manager<'s>(
        &self,
        values: &Values,
        strategy: Strategy,
        managed: ManagedSpacecraft<'s>,
    ) -> Manager<'s> {
        let ManagedSpacecraft { spacecraft, sunshade, antennas, sun_limits_rad, bias_body_n_m_s } = managed;
        let [azimuth_rad, elevation_rad] = sun_limits_rad;
        Manager {
            strategy,
            targeting: Targeting {
                axes: values.choice(self.target_axes).0,
                method: values.choice(self.targeting).0,
                limits: KeepInLimits { azimuth_rad, elevation_rad },
                antennas,
            },
            target_body_n_m_s: self.target_body_n_m_s(values),
            bias_body_n_m_s,
            horizon: values.integer(self.horizon).unsigned_abs(),
            sunshade: spacecraft.sunshade.as_ref().map(|shade| (shade, sunshade)),
        }
    }
}

/// Reason why there is no downlink.
pub(crate) const NO_ANTENNA: &str = "the spacecraft has no antenna ([[antennas]])";

/// Refuses downlink windows that no antenna serves.
///
/// # Errors
/// Windows without an antenna.
pub(crate) fn check_windows_have_antenna(schedule: &Schedule, antennas: &Antennas) -> Result<(), Failure> {
    if !antennas.is_empty() || schedule.check_windows() == Err(NoCycle::Never) {
        return Ok(());
    }
    let found = match (schedule.once, schedule.every) {
        _ if schedule.throughout => {
            "guided.phase: found cruise, downlink throughout, allowed: orbit".to_owned()
        }
        (true, _) => "guided.downlinkReference: found start, one window, allowed: periapsis".to_owned(),
        (false, every) => format!("guided.downlinkEvery: found {every}, allowed: 0, no downlink"),
    };
    Err(Failure::new(format!("{found}; {NO_ANTENNA}")))
}

/// Refuses targets by sunlight where no downlink can choose the Sun's place.
///
/// # Errors
/// A strategy without an antenna that is steered.
pub(crate) fn check_strategy_has_antenna(strategy: Strategy, antennas: &Antennas) -> Result<(), Failure> {
    if strategy == Strategy::DumpsOnly || antennas.has_fan() {
        return Ok(());
    }
    let lack = match antennas.is_empty() {
        true => "the spacecraft has no antenna",
        false => "no antenna of the spacecraft is steered in the XY plane",
    };
    Err(Failure::new(format!(
        "momentum.strategy: found {}, allowed: dumpsOnly; targets by sunlight choose the Sun's place in downlinks, and {lack} \
         ([[antennas]] azimuth_deg)",
        strategy.name()
    )))
}

/// Refuses downlinks that serve no strategy: none comes, or they leave no science between them.
///
/// # Errors
/// Windows that never come or overlap.
pub(crate) fn check_windows(schedule: &Schedule) -> Result<(), Failure> {
    let Schedule { downlink_start_s, downlink_end_s, .. } = *schedule;
    let found = match schedule.check_windows() {
        Ok(()) => return Ok(()),
        Err(fault) => fault,
    };
    Err(Failure::new(format!(
        "momentum.strategy, guided.downlinkStart, guided.downlinkEnd, guided.downlinkEvery: found a strategy with {found}, from \
         {downlink_start_s:?} s to {downlink_end_s:?} s, allowed: dumpsOnly, or downlinks with science between them"
    )))
}

/// Warns of windows that never come or overlap, whatever the strategy.
pub(crate) fn window_warning(schedule: &Schedule) -> Option<String> {
    let Schedule { downlink_start_s, downlink_end_s, every, .. } = *schedule;
    let names = "guided.downlinkStart, guided.downlinkEnd, guided.downlinkEvery";
    match schedule.check_windows().err()? {
        NoCycle::Overlap { every_s } => Some(format!(
            "{names}: a window from {downlink_start_s} s to {downlink_end_s} s every {every_s} s is always open: the spacecraft \
             is in downlink for ever and never observes"
        )),
        NoCycle::Throughout => None,
        NoCycle::Never if every > 0 && schedule.period_s.is_finite() => Some(format!(
            "{names}: a window from {downlink_start_s} s to {downlink_end_s} s is never open: there is no downlink"
        )),
        NoCycle::Never => None,
    }
}
