//! Flexible modes and propellant, from their descriptions: checks every value, and that the body has an inertia without them.

use super::describe_swinging::{FlexibleModeDescription, SloshDescription};
use super::part_reader::PartReader;
use crate::attitude::{Appendages, FlexibleMode, Gyrostat, GyrostatError, SloshPendulum};
use crate::spacecraft::mass::MassProperties;
use crate::spacecraft::swinging::{NamedMode, NamedSlosh};
use crate::toml::{Checker, KeyPath, Named};

/// A flexible mode.
pub(crate) fn mode(part: &mut PartReader<'_, '_>, description: &FlexibleModeDescription) -> NamedMode {
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
pub(crate) fn slosh(part: &mut PartReader<'_, '_>, description: &SloshDescription) -> NamedSlosh {
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
pub(crate) fn swinging_fits(
    check: &mut Checker<'_>,
    modes: &[NamedMode],
    sloshes: &[NamedSlosh],
    mass: &MassProperties,
) {
    let root = KeyPath::root();
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
    check.report(&root.key(key), found, allowed);
}
