//! The plant's choices.

use fmi_export::Enumeration;
use physics::attitude::control::Allocation;
use physics::bodies::Body;
use physics::environment::frames::Frame;
use physics::spacecraft;

use crate::common::choices::{KNOWN_PLANETS, choices, optional_choices};

/// Where the attitude comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum AttitudeSource {
    /// Computes its own guidance and follows it ideally.
    Guided = 1,
    /// Follows the command inputs ideally.
    Commanded = 2,
    /// Rigid body and wheels under an internal controller that tracks a command.
    Controlled = 3,
    /// Rigid body and wheels driven by wheel-torque inputs.
    Free = 4,
}

/// Start of a controlled or free flight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum StartAttitude {
    /// As given where start.q or start.rate is set, else as guided.
    Automatic = 1,
    /// In the attitude and at the rate of the command or the internal guidance.
    Guided = 2,
    /// In start.q at start.rate.
    Given = 3,
}

/// Where commands come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum CommandSource {
    /// The inputs `command.*`.
    Inputs = 1,
    /// The orbit phase's own guidance, sampled once a second in controlled flight.
    Guidance = 2,
}

choices! {
    /// How torque is spread over the wheels.
    WheelAllocation(Allocation);
}

/// Origin of the orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum OrbitSource {
    /// From the orbital elements at the start.
    Elements = 1,
    /// From the position and velocity inputs, anew whenever they change.
    Inputs = 2,
    /// The position and velocity inputs themselves, which are not propagated.
    Held = 3,
}

impl OrbitSource {
    /// Whether position and velocity are inputs.
    pub fn is_given(self) -> bool {
        matches!(self, Self::Inputs | Self::Held)
    }
}

/// What moves the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum OrbitDynamics {
    /// The centre's gravity alone: the orbit in closed form.
    TwoBody = 1,
    /// Integrated with the planet's flattening, the Sun's tide, and light and heat.
    Disturbed = 2,
    /// Integrated between the Sun and the planets of orbit.attraction, with light and heat: flight between planets.
    NBody = 3,
}

optional_choices! {
    /// The body of an encounter.
    EncounterBody(Body) of KNOWN_PLANETS or "None.";
}

choices! {
    /// Frame of the orbital elements.
    OrbitFrame(Frame);
    /// What turns a panel.
    PanelControl(spacecraft::PanelControl);
}

/// Where a dump leaves a component that exceeded its threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum DumpReinitTo {
    /// The opposite sign at dump.reinitFraction of the threshold.
    Opposite = 1,
    /// The component of dump.target.
    Target = 2,
}

/// Origin of the Sun's and the planets' positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum EphemerisSource {
    /// The analytic theory VSOP87.
    Vsop87 = 1,
    /// The planet on an ellipse about the Sun by ephemeris.semiMajorAxis and so on, as paper 004 prints it; the Earth by
    /// VSOP87.
    Kepler = 2,
    /// The inputs sun.position and earth.position.
    Inputs = 3,
    /// The Chebyshev segments of the FMU's ephemeris.toml, within their span; in an FMU without that file as vsop87.
    Chebyshev = 4,
}
