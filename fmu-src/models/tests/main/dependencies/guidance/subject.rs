//! What a drawing is about.

use models::Guidance;

use super::super::bench::Bench;

/// Guidance with everything that does not change in flight.
pub type Guide = Bench<Guidance>;

/// What a drawing is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Subject {
    /// A scenario by its item.
    Scenario(i32),
    /// An aimpoint by its item, without constraints.
    Aimpoint(i32),
    /// A camera at a second aimpoint.
    SecondAimpoint(i32),
    /// A scan by its item.
    Scan(i32),
    /// Modes and sensors.
    Modes,
    /// The monitor, which trips at once.
    Monitor,
    /// Flown ephemerides, judged by the Sun sensors at once.
    Ephemeris,
    /// The four vectors by their options, without constraints.
    Generic,
    /// A direction that is missing, by what it is.
    Lost(i32),
    /// Science and downlink, near their windows.
    OrbitPhase,
    /// The hot pole: low above the subsolar point.
    HotPole,
    /// An antenna at an Earth that is near the Sun or at the planet's limb.
    Link,
    /// A burn, waiting or under way.
    Burn,
    /// A downlink that begins with momentum: of the scenario, or of the orbit phase.
    Momentum,
    /// The same with science after it within reach of a forecast.
    Predictive,
}

impl Subject {
    /// Whether it is a downlink that begins with momentum.
    pub fn is_momentum(self) -> bool {
        matches!(self, Self::Momentum | Self::Predictive)
    }
}

/// Every subject as often as one round of drawings has it.
pub fn subjects() -> Vec<Subject> {
    let scenarios = (0..=8).map(Subject::Scenario);
    let aims = (1..=15).flat_map(|item| [Subject::Aimpoint(item), Subject::SecondAimpoint(item)]);
    let scans = (1..=5).map(Subject::Scan);
    let others = [
        Subject::Modes,
        Subject::Ephemeris,
        Subject::OrbitPhase,
        Subject::HotPole,
        Subject::Monitor,
        Subject::Link,
        Subject::Burn,
        Subject::Momentum,
        Subject::Predictive,
        Subject::Momentum,
        Subject::Generic,
        Subject::Monitor,
        Subject::Generic,
        Subject::OrbitPhase,
        Subject::Scan(5),
    ];
    let lost = (0..8).map(Subject::Lost);
    scenarios.chain(aims).chain(scans).chain(others).chain(others).chain(lost).collect()
}
