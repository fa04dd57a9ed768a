//! Quaternions, kinematics, rigid body, directions in the body frame, attitude control.
//!
//! An attitude quaternion is scalar-last and takes EME2000 components to body components in Wertz' passive
//! order. Its four numbers are at the same time those of the active rotation that carries the inertial axes onto
//! the body axes, which is how [`Attitude`] holds it.

mod angles;
mod body_load;
pub mod control;
mod dipole_in_field;
mod frame;
mod gravity_gradient;
mod gyrostat;
mod gyrostat_motion;
mod gyrostat_series;
mod imbalance;
mod inertia;
mod internal_motion;
mod mass_flow;
mod motion_at;
mod oscillator;
mod quaternion;
mod rigid_body;
mod rotation;
mod rotor_motion;
pub(crate) mod series;
mod slosh;
mod wheel;

pub use angles::{SunAngles, angle_between_rad, direction_from_angles};
pub use body_load::{BodyLoad, BodyMotion};
pub use dipole_in_field::DipoleInField;
pub use frame::{MovingFrame, MovingUnit};
pub use gravity_gradient::{OblatePlanet, gravity_gradient_n_m, oblate_gravity_gradient_n_m};
pub use gyrostat::{Appendages, Gyrostat, GyrostatError};
pub use gyrostat_motion::GyrostatMotion;
pub use imbalance::RotorImbalance;
pub use inertia::{Inertia, InertiaError};
pub use internal_motion::{HingedMass, InternalMotion};
pub use mass_flow::{JetDamping, MassFlow};
pub use motion_at::MotionAt;
pub use oscillator::FlexibleMode;
pub use quaternion::Quaternion;
pub use rigid_body::RigidBodyState;
pub(crate) use rotation::rotation_vector;
pub use rotation::{Attitude, QuaternionError};
pub use slosh::SloshPendulum;
pub use wheel::{Motor, ReactionWheel, Rotor, motor_power_w};
