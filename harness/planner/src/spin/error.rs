//! Why there is no plan.

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A flag out of its range.
    #[error("{flag} is {found}; allowed is {allowed}")]
    Flag {
        /// The flag.
        flag: &'static str,
        /// What was found.
        found: f64,
        /// What is allowed.
        allowed: String,
    },
    /// Flags that do not say enough, or too much.
    #[error("{flag}: {what}")]
    Aim {
        /// The flag.
        flag: &'static str,
        /// What is missing or wrong, and what to do.
        what: String,
    },
    /// A body that does not come to rest about its spin axis, or none.
    #[error(
        "the inertia ratio I3/IT is {least:.4} to {greatest:.4} (--ratio, otherwise the spacecraft's, +- \
         --ratio-uncertainty); allowed is above 1 and below 2: up to 1 nutation does not turn in the body or the damper lets \
         it grow, so that no train ends quietly, and no body has 2 or more"
    )]
    Ratio {
        /// Least of the range.
        least: f64,
        /// Greatest of the range.
        greatest: f64,
    },
    /// No such thruster.
    #[error("--thruster is \"{found}\"; this spacecraft has {known}")]
    Thruster {
        /// What was requested.
        found: String,
        /// What there is.
        known: String,
    },
    /// A set of thrusters that cannot turn the spin axis.
    #[error("--thruster is \"{found}\", which has no torque across the spin axis")]
    NoTorque {
        /// What was requested.
        found: String,
    },
    /// The spacecraft's file.
    #[error("{0}")]
    Setup(String),
    /// No train keeps the limits.
    #[error(
        "no plan keeps the limits: over all plans the least peak nutation is {peak_deg:.5} deg, the least final nutation \
         {final_deg:.6} deg, the shortest time {duration_min:.2} min, the least propellant {propellant_kg:.6} kg; widen \
         --max-nutation, --max-final or --max-duration, or see --propellant"
    )]
    NoPlan {
        /// Least peak of all plans.
        peak_deg: f64,
        /// Least final nutation of all plans.
        final_deg: f64,
        /// Shortest of all plans.
        duration_min: f64,
        /// Least of all plans.
        propellant_kg: f64,
    },
    /// The thruster's shortest pulse moves too far.
    #[error(
        "--angle is {angle_deg} deg; no train comes within {tolerance_percent} % of it (--angle-tolerance): the shortest \
         pulse of {thruster}, {pulse_ms} ms, moves {pulse_deg:.6} deg"
    )]
    NoTrain {
        /// What was requested.
        angle_deg: f64,
        /// How near it had to come.
        tolerance_percent: f64,
        /// Name.
        thruster: String,
        /// Shortest pulse.
        pulse_ms: f64,
        /// What it moves.
        pulse_deg: f64,
    },
    /// The thruster cannot do it at this spin rate.
    #[error("--thruster {thruster} has no train: {why}")]
    Coarse {
        /// Name.
        thruster: String,
        /// Why.
        why: String,
    },
    /// Simulated through the FMU, no plan kept what it promised.
    #[error("no plan keeps its limits when it is simulated through the FMU: {0}")]
    Broken(String),
    /// The plan cannot be simulated.
    #[error("the plan could not be simulated pulse by pulse: {0}")]
    Flight(String),
    /// The plan cannot be written down.
    #[error("the plan could not be written: {0}")]
    Write(String),
    /// The FMU did not simulate it.
    #[error("the plan could not be simulated through the FMU: {0}")]
    Verify(String),
}
