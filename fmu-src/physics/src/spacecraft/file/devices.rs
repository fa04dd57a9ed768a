//! Wheels, Sun sensors and instruments, from their descriptions.

use nalgebra::Vector3;

use super::description::{InstrumentDescription, SunSensorDescription, WheelDescription};
use super::names::Named;
use crate::spacecraft::instruments::Instrument;
use crate::spacecraft::sun_sensors::MountedSunSensor;
use crate::spacecraft::wheels::{SPEED_AT_CAPACITY_RAD_S, TIME_TO_CAPACITY_S, Wheel};
use crate::toml::{Checker, Place};

pub(crate) fn wheel(
    check: &mut Checker<'_>,
    at: &Place,
    index: usize,
    description: &WheelDescription,
) -> Wheel {
    let capacity_n_m_s = description.capacity_n_m_s.0;
    let static_imbalance_kg_m = description.static_imbalance_kg_m();
    if static_imbalance_kg_m > 0.0 && description.position_m.is_none() {
        check.report(
            &at.key("static_imbalance_kg_m"),
            "no position_m beside it",
            "with the rotor's place, position_m",
        );
    }
    Wheel {
        static_imbalance_kg_m,
        position_body_m: description
            .position_m
            .map_or(Vector3::zeros(), |place| check.vector(&at.key("position_m"), place)),
        name: description.called(index),
        coulomb_friction_n_m: description.coulomb_friction_n_m(),
        viscous_friction_n_m_s: description.viscous_friction_n_m_s(),
        axis_body: check.unit_vector(&at.key("axis"), description.axis),
        capacity_n_m_s,
        inertia_kg_m2: description.inertia_kg_m2.map_or(capacity_n_m_s / SPEED_AT_CAPACITY_RAD_S, f64::from),
        max_torque_n_m: description.max_torque_n_m.map_or(capacity_n_m_s / TIME_TO_CAPACITY_S, f64::from),
    }
}

pub(crate) fn sun_sensor(
    check: &mut Checker<'_>,
    at: &Place,
    index: usize,
    description: &SunSensorDescription,
) -> MountedSunSensor {
    MountedSunSensor {
        name: description.called(index),
        axis_body: check.unit_vector(&at.key("axis"), description.axis),
        half_field_of_view_rad: description.half_field_of_view_deg().to_radians(),
    }
}

pub(crate) fn instrument(
    check: &mut Checker<'_>,
    at: &Place,
    _: usize,
    description: &InstrumentDescription,
) -> Instrument {
    Instrument {
        name: description.name.clone(),
        boresight_body: check.unit_vector(&at.key("boresight"), description.boresight),
    }
}
