//! Oscillators on the spacecraft: flexible modes, and propellant as pendulums.

use serde::Serialize;

use super::mass::MassProperties;
use super::part_reader::PartReader;
use crate::attitude::{Appendages, FlexibleMode, Gyrostat, GyrostatError, SloshPendulum};
use crate::toml::{Fraction, Frequency, Named, Place, Point, Positive, UnitVector, tables};

/// Damping ratio of what swings where the file gives none. Assumed.
const DAMPING: f64 = 0.005;

/// Frequency of propellant without acceleration where the file gives none, in Hz: surface tension or a membrane holds it.
/// Assumed.
const COAST_FREQUENCY_HZ: f64 = 0.005;

tables! {
/// A flexible mode, of a panel or a boom, in hybrid coordinates: with modal displacement e, e'' + 2 z w e' + w^2 e = -d.w',
/// and the body's momentum holds d e'.
struct FlexibleModeDescription called "flexible mode" {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Frequency with the body held, in Hz.
    frequency_hz: Frequency,
    /// Damping ratio.
    damping: Fraction = DAMPING,
    /// Coupling d to rotation about the body axes, for a modal mass of 1, in sqrt(kg) m; the sum of d d^T over all modes is less
    /// than the inertia.
    coupling_sqrt_kg_m as coupling_body_sqrt_kg_m: Point,
}

/// Propellant that swings as a pendulum.
struct SloshDescription called "slosh" {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Mass that swings, in kg; a part of mass_properties.mass_kg, at rest in its inertia.
    mass_kg: Positive,
    /// Length of the pendulum, in m.
    length_m: Positive,
    /// Pivot, body frame, in m.
    pivot_m as pivot_body_m: Point,
    /// Unit vector from the pivot to the mass at rest, body frame: against the acceleration by the thrusters it swings under.
    axis as axis_body: UnitVector,
    /// Damping ratio.
    damping: Fraction = DAMPING,
    /// Frequency without acceleration, in Hz, by surface tension or a membrane.
    coast_frequency_hz: Frequency = COAST_FREQUENCY_HZ,
}
}

/// A flexible mode of the spacecraft.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedMode {
    /// For messages.
    pub name: String,
    /// Frequency, damping and coupling.
    pub mode: FlexibleMode,
}

/// Propellant that swings in its tank.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedSlosh {
    /// For messages.
    pub name: String,
    /// Mass, pendulum and damping.
    pub pendulum: SloshPendulum,
}

/// A flexible mode.
pub(super) fn mode(part: &PartReader<'_>, description: &FlexibleModeDescription) -> NamedMode {
    NamedMode {
        name: description.called(part.index),
        mode: FlexibleMode {
            frequency_hz: description.frequency_hz.0,
            damping: description.damping(),
            coupling_body_sqrt_kg_m: description.coupling_body_sqrt_kg_m(),
        },
    }
}

/// Propellant that swings.
pub(super) fn slosh(part: &PartReader<'_>, description: &SloshDescription) -> NamedSlosh {
    NamedSlosh {
        name: description.called(part.index),
        pendulum: SloshPendulum {
            mass_kg: description.mass_kg.0,
            length_m: description.length_m.0,
            pivot_body_m: description.pivot_body_m(),
            axis_body: description.axis_body(),
            damping: description.damping(),
            coast_frequency_hz: description.coast_frequency_hz(),
        },
    }
}

/// The body has mass and inertia without what swings.
pub(super) fn swinging_fits(
    root: &Place<'_>,
    modes: &[NamedMode],
    sloshes: &[NamedSlosh],
    mass: &MassProperties,
) {
    let appendages = Appendages {
        modes: modes.iter().map(|it| it.mode).collect(),
        sloshes: sloshes.iter().map(|it| it.pendulum).collect(),
        ..Appendages::default()
    };
    if (modes.is_empty() && sloshes.is_empty()) || mass.mass_kg <= 0.0 {
        return;
    }
    // What is wrong with the body itself is reported with it.
    let Ok(rigid) = Gyrostat::new(mass.inertia_body_kg_m2, Vec::new()) else { return };
    let (key, found, allowed) =
        match rigid.with_appendages(appendages, mass.mass_kg, mass.center_of_mass_body_m) {
            Ok(_) => return,
            Err(GyrostatError::Propellant { found, whole_kg }) => (
                "slosh",
                format!("mass_kg of {found} together"),
                format!("less than mass_properties.mass_kg = {whole_kg}, of which it is a part"),
            ),
            Err(error) => {
                let key = if modes.is_empty() { "slosh" } else { "flexible_modes" };
                (key, error.to_string(), "modes and propellant that leave an inertia".to_owned())
            }
        };
    root.key(key).report(found, allowed);
}
