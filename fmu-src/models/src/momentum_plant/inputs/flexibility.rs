//! From parameters to what swings on the body and to rotors out of balance; refuses an axis of no direction, by name.

use fmi_export::{Failure, Real, Values};
use nalgebra::Vector3;
use physics::attitude::{Appendages, FlexibleMode, RotorImbalance, SloshPendulum};

use crate::momentum_plant::setup::Plan;

/// Flexible modes, propellant and rotors out of balance.
pub fn appendages(context: &Plan<'_>, values: &Values) -> Result<Appendages, Failure> {
    let v = context.variables;
    let real = |handle: Real| values.real(handle);
    let modes = v.flexible_mode.iter().map(|mode| FlexibleMode {
        frequency_hz: real(mode.frequency),
        damping: real(mode.damping),
        coupling_body_sqrt_kg_m: Vector3::from(values.vector(mode.coupling)),
    });
    let sloshes = v.slosh.iter().enumerate().map(|(index, slosh)| {
        let found = values.vector(slosh.axis);
        let axis_body = Vector3::from(found).try_normalize(0.0).ok_or_else(|| {
            Failure::new(format!(
                "slosh[{}].axis: found {found:?}, allowed: a vector of any length but zero",
                index.saturating_add(1)
            ))
        })?;
        Ok(SloshPendulum {
            mass_kg: real(slosh.mass),
            length_m: real(slosh.length),
            pivot_body_m: Vector3::from(values.vector(slosh.pivot)),
            axis_body,
            coast_frequency_hz: real(slosh.coast_frequency),
            damping: real(slosh.damping),
        })
    });
    let wheels = v.wheel.iter().enumerate().filter(|(_, wheel)| real(wheel.static_imbalance) > 0.0);
    Ok(Appendages {
        modes: modes.collect(),
        sloshes: sloshes.collect::<Result<_, Failure>>()?,
        imbalances: wheels
            .map(|(index, wheel)| RotorImbalance {
                wheel: index,
                static_imbalance_kg_m: real(wheel.static_imbalance),
                position_body_m: Vector3::from(values.vector(wheel.position)),
            })
            .collect(),
    })
}
