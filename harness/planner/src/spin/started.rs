//! Start values of the spinner's file that a plan begins from.

use nalgebra::Vector3;
use physics::{
    attitude::Quaternion,
    constants::RPM_RAD_S,
    spacecraft::{StartEntry, StartValue},
    spin::spinner::Spinner,
};

use super::PlanError;

const MODEL: &str = "SpinPlant";

/// The value that counts: what stands for the model alone, before what stands for all.
fn entry<'a>(spinner: &'a Spinner, name: &str) -> Option<&'a StartEntry> {
    let of = |model: Option<&str>| {
        spinner.start.iter().find(move |entry| entry.name == name && entry.model.as_deref() == model)
    };
    of(Some(MODEL)).or_else(|| of(None))
}

/// Direction of the spin axis by `start.q` of the spacecraft's file.
pub(super) fn axis_inertial(spinner: &Spinner) -> Option<Vector3<f64>> {
    let number = |value: &StartValue| match value {
        StartValue::Real(number) => Some(*number),
        StartValue::Integer(number) => Some(*number as f64),
        _ => None,
    };
    let entry = entry(spinner, "start.q")?;
    let StartValue::List(components) = &entry.value else { return None };
    let components: Vec<f64> = components.iter().map(number).collect::<Option<_>>()?;
    let attitude = Quaternion::from_components(components.try_into().ok()?)?;
    let inertia = spinner.mass_properties.inertia(spinner.mass_properties.initial_propellant_kg).ok()?;
    Some(attitude.inertial_from_body(&inertia.spin_axis_body()))
}

/// The spin rate that the file's start values have: a number in rad/s, or with its unit.
pub(super) fn rate_rad_s(spinner: &Spinner) -> Result<Option<f64>, PlanError> {
    let Some(entry) = entry(spinner, "spin.initialRate") else {
        return Ok(None);
    };
    let with_unit = |text: &str| {
        [("rpm", RPM_RAD_S), ("deg/s", 1_f64.to_radians()), ("rad/s", 1.0)].into_iter().find_map(
            |(unit, factor)| Some(text.trim().strip_suffix(unit)?.trim_end().parse::<f64>().ok()? * factor),
        )
    };
    let rate_rad_s = match &entry.value {
        StartValue::Real(rate_rad_s) => Some(*rate_rad_s),
        StartValue::Integer(rate_rad_s) => Some(*rate_rad_s as f64),
        StartValue::Text(text) => with_unit(text),
        _ => None,
    };
    match rate_rad_s.filter(|rate_rad_s| rate_rad_s.is_finite() && *rate_rad_s > 0.0) {
        Some(rate_rad_s) => Ok(Some(rate_rad_s)),
        None => Err(PlanError::Direction {
            flag: "--rate",
            what: format!(
                "{} in line {} is no spin rate; allowed: a positive number in rad/s, or with its unit (rpm, deg/s), or this \
                 flag",
                entry.key, entry.line
            ),
        }),
    }
}
