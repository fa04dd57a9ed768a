//! Reaction wheel: axis, rotor, motor and friction, and whether the rotor turns or is held.
//!
//! Equations, along the spin axis a with the rotor's speed W relative to the body and h = I W:
//! d/dt (h + I a.w) = u - f, f = c sign(h) + v W.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Share of the capacity by which a wheel at its capacity may fall short.
const AT_CAPACITY: f64 = 1e-9;

/// One reaction wheel.
#[derive(Clone, Debug, PartialEq)]
pub struct ReactionWheel {
    /// Unit vector of the spin axis; positive speed is right-handed about it.
    pub axis_body: Vector3<f64>,
    /// Moment of inertia of the rotor about its axis, in kg m2.
    pub inertia_kg_m2: f64,
    /// Greatest torque of the motor, in N m.
    pub max_torque_n_m: f64,
    /// Greatest momentum of the rotor relative to the body, in N m s.
    pub capacity_n_m_s: f64,
    /// Momentum about which it works, in N m s: wheels share what is beside it.
    pub bias_n_m_s: f64,
    /// Coulomb friction, in N m.
    pub coulomb_friction_n_m: f64,
    /// Viscous friction, in N m per rad/s.
    pub viscous_friction_n_m_s: f64,
    /// Whether the rotor is fixed to the body.
    pub locked: bool,
}

impl ReactionWheel {
    /// Friction on the rotor at `momentum_n_m_s` relative to the body, along the axis, in N m; none at rest.
    pub fn friction_n_m(&self, momentum_n_m_s: f64) -> f64 {
        let sign = if momentum_n_m_s == 0.0 { 0.0 } else { momentum_n_m_s.signum() };
        self.coulomb_friction_n_m * sign + self.viscous_rate_1_s() * momentum_n_m_s
    }

    /// Whether it is at its capacity at `momentum_n_m_s`, to one part in 1e9; a locked one never is.
    pub fn is_saturated(&self, momentum_n_m_s: f64) -> bool {
        !self.locked && momentum_n_m_s.abs() >= self.capacity_n_m_s * (1.0 - AT_CAPACITY)
    }

    /// Momentum of the rotor by the body's rotation along its axis, I a.w, in N m s.
    pub fn carried_n_m_s(&self, rate_body_rad_s: &Vector3<f64>) -> f64 {
        self.inertia_kg_m2 * self.axis_body.dot(rate_body_rad_s)
    }

    /// Speed of the rotor relative to the body, in rad/s, at a momentum in N m s.
    pub fn speed_rad_s(&self, momentum_n_m_s: f64) -> f64 {
        momentum_n_m_s / self.inertia_kg_m2
    }

    /// Viscous friction over momentum, in 1/s.
    pub fn viscous_rate_1_s(&self) -> f64 {
        self.viscous_friction_n_m_s / self.inertia_kg_m2
    }
}

/// Mechanical power of a motor that exerts this torque (N m) on a rotor at this speed (rad/s) relative to the body, in W;
/// negative where it brakes.
pub fn motor_power_w(torque_n_m: f64, speed_rad_s: f64) -> f64 {
    torque_n_m * speed_rad_s
}

/// Torque of a wheel's motor until its next command.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motor {
    /// Torque on the rotor along the axis, in N m, within what the motor can give.
    pub torque_n_m: f64,
    /// Whether there is no motor: nothing limits the rotor's momentum either.
    pub failed: bool,
}

/// How a rotor moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Rotor {
    /// Under motor and friction; Coulomb friction opposes `direction`, +1 or -1.
    Turning {
        /// Sign of the speed.
        direction: f64,
    },
    /// At constant speed relative to the body: locked, held by Coulomb friction at rest, or by the motor at the capacity.
    Held {
        /// Momentum relative to the body, in N m s.
        momentum_n_m_s: f64,
    },
}

impl Rotor {
    /// Motion of the rotor of `wheel` at the start, with this momentum relative to the body.
    pub fn at_start(wheel: &ReactionWheel, momentum_n_m_s: f64) -> Self {
        let at_rest = momentum_n_m_s == 0.0 && wheel.coulomb_friction_n_m > 0.0;
        if wheel.locked || at_rest {
            Self::Held { momentum_n_m_s }
        } else {
            Self::Turning { direction: 1.0_f64.copysign(momentum_n_m_s) }
        }
    }

    /// Whether a simulation can produce it.
    pub fn is_valid(&self) -> bool {
        !matches!(self, Self::Turning { direction } if direction.abs() != 1.0)
    }
}
