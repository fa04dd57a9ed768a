//! Wheels, Sun sensors and instruments, from their descriptions.

use nalgebra::Vector3;

use super::describe_devices::{
    GimbalDescription, InstrumentDescription, SunSensorDescription, WheelDescription,
};
use super::part_reader::PartReader;
use crate::spacecraft::instruments::{GimbalMount, Instrument};
use crate::spacecraft::sun_sensors::MountedSunSensor;
use crate::spacecraft::wheels::{SPEED_AT_CAPACITY_RAD_S, TIME_TO_CAPACITY_S, Wheel};
use crate::toml::{Checker, KeyPath, Named};

pub(crate) fn wheel(part: &mut PartReader<'_, '_>, description: &WheelDescription) -> Wheel {
    let capacity_n_m_s = description.capacity_n_m_s.0;
    let bias_n_m_s = description.bias_momentum_n_m_s();
    if bias_n_m_s.abs() > capacity_n_m_s {
        let allowed = format_args!("up to capacity_n_m_s either way, {capacity_n_m_s}");
        part.report_across("bias_momentum_n_m_s", bias_n_m_s, allowed);
    }
    Wheel {
        bias_n_m_s,
        static_imbalance_kg_m: description.static_imbalance_kg_m(),
        position_body_m: description.position_body_m().unwrap_or_default(),
        name: description.called(part.index),
        coulomb_friction_n_m: description.coulomb_friction_n_m(),
        viscous_friction_n_m_s: description.viscous_friction_n_m_s(),
        axis_body: description.axis_body(),
        capacity_n_m_s,
        inertia_kg_m2: description.inertia_kg_m2.map_or(capacity_n_m_s / SPEED_AT_CAPACITY_RAD_S, f64::from),
        max_torque_n_m: description.max_torque_n_m.map_or(capacity_n_m_s / TIME_TO_CAPACITY_S, f64::from),
    }
}

pub(crate) fn sun_sensor(
    part: &mut PartReader<'_, '_>,
    description: &SunSensorDescription,
) -> MountedSunSensor {
    MountedSunSensor {
        name: description.called(part.index),
        axis_body: description.axis_body(),
        half_field_of_view_rad: description.half_field_of_view_rad(),
    }
}

pub(crate) fn instrument(part: &mut PartReader<'_, '_>, description: &InstrumentDescription) -> Instrument {
    let boresight_body = description.boresight_body();
    let gimbal =
        part.optional("gimbal", description.gimbal.as_ref(), |part, it| gimbal(part, it, &boresight_body));
    Instrument { name: description.name.clone(), boresight_body, gimbal }
}

fn gimbal(
    part: &mut PartReader<'_, '_>,
    description: &GimbalDescription,
    boresight_body: &Vector3<f64>,
) -> GimbalMount {
    let [minimum_deg, maximum_deg] = [description.minimum_deg.0, description.maximum_deg.0];
    if minimum_deg > maximum_deg {
        let allowed = format!("an angle from `minimum_deg`, {minimum_deg} deg, to 180 deg");
        part.report("maximum_deg", maximum_deg, allowed);
    }
    GimbalMount {
        axis_body: part.perpendicular("axis", description.axis_body(), ("boresight", boresight_body)),
        minimum_rad: description.minimum_rad(),
        maximum_rad: description.maximum_rad(),
    }
}

/// At most one instrument has a gimbal.
pub(crate) fn check_gimbals(check: &mut Checker<'_>, at: &KeyPath, instruments: &[Instrument]) {
    let mut with_gimbal =
        instruments.iter().enumerate().filter(|(_, instrument)| instrument.gimbal.is_some());
    let Some((_, first)) = with_gimbal.next() else { return };
    for (index, _) in with_gimbal {
        let found = format!("a gimbal beside that of `{}`", first.name);
        check.report(&at.item(index).key("gimbal"), found, "one instrument with a gimbal");
    }
}
