//! Task of a spinner's manoeuvre: its goal and its means.

use physics::{
    attitude::{Inertia, Quaternion},
    constants::RPM_RAD_S,
    spin::{
        burn_request::opposes,
        forecast::{ForecastCase, Range},
        nutation::{Spin, allowed_nutation_rad},
        spinner::Spinner,
    },
};

use super::{
    PlanError, TurnRequest, started,
    turn_geometry::{MAX_ANGLE_DEG, TurnGeometry},
};

/// Thruster or group that fires, as a burn of the FMU takes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Firing {
    /// A group by its name.
    Group(String),
    /// A thruster by its number from 1, and that of an opposite one.
    Thruster {
        /// Number.
        number: i32,
        /// The one that pushes the other way, equally hard.
        opposite: Option<i32>,
    },
}

/// A manoeuvre to plan.
#[derive(Clone, Debug)]
pub struct Task {
    /// From where to where.
    pub geometry: TurnGeometry,
    /// Body that is turned.
    pub body: Body,
    /// How far the momentum shall move, in rad.
    pub angle_rad: f64,
    /// Relative: trains move by whole pulses.
    pub angle_tolerance: f64,
    /// Best knowledge of the body, and the thruster.
    pub case: ForecastCase,
    /// Range of the errors of the case.
    pub range: Range,
    /// Thruster or group that fires.
    pub actuator: Actuator,
    /// Angle from the spin axis to the Sun, in rad.
    pub sun_angle_rad: f64,
    /// Smallest pulse and step of its width, in s.
    pub resolution_s: f64,
    /// 1/e time of nutation, in s; 0 without a damper.
    pub damper_time_constant_s: f64,
    /// Nutation that science data bear, in rad.
    pub allowed_nutation_rad: f64,
    /// Limits; infinite where there is none.
    pub limits: TaskLimits,
}

/// Limits of a manoeuvre.
#[derive(Clone, Copy, Debug)]
pub struct TaskLimits {
    /// On nutation at any time, in rad.
    pub peak_rad: f64,
    /// On nutation after the last pulse, in rad.
    pub final_rad: f64,
    /// From first to last edge, in s.
    pub duration_s: f64,
}

fn check(flag: &'static str, found: f64, fits: bool, allowed: &str) -> Result<f64, PlanError> {
    match found.is_finite() && fits {
        true => Ok(found),
        false => Err(PlanError::Flag { flag, found, allowed: allowed.to_owned() }),
    }
}

fn positive(flag: &'static str, found: f64) -> Result<f64, PlanError> {
    check(flag, found, found > 0.0, "a positive number")
}

fn not_negative(flag: &'static str, found: f64) -> Result<f64, PlanError> {
    check(flag, found, found >= 0.0, "0 or a positive number")
}

fn refused(error: impl ToString) -> PlanError {
    PlanError::Refused(error.to_string())
}

/// Body that is turned: its mass properties with the propellant on board.
#[derive(Clone, Debug)]
pub struct Body {
    /// On board, in kg.
    pub propellant_kg: f64,
    inertia: Inertia,
    /// Moments about the body axes of what is planned for, in kg m2.
    pub moments_kg_m2: [f64; 3],
    /// Products of inertia 12, 13, 23, in kg m2: elements of the tensor.
    pub products_kg_m2: [f64; 3],
    ratio: f64,
    ratio_uncertainty: f64,
}

impl Body {
    fn new(request: &TurnRequest, spinner: &Spinner) -> Result<Self, PlanError> {
        let mass = &spinner.mass_properties;
        let propellant_kg = request.propellant_kg.unwrap_or(mass.initial_propellant_kg);
        let most_kg = mass.most_propellant_kg();
        let allowed = format!("0 to {most_kg} kg, where the spacecraft's mass properties end");
        check("--propellant", propellant_kg, (0.0..=most_kg).contains(&propellant_kg), &allowed)?;
        let inertia = mass.inertia(propellant_kg).map_err(refused)?;
        let ratio = match request.ratio {
            Some(ratio) => positive("--ratio", ratio)?,
            None => inertia.inertial_nutation_ratio().unwrap_or(inertia.ratio()),
        };
        let ratio_uncertainty = not_negative("--ratio-uncertainty", request.ratio_uncertainty)?;
        let (least, greatest) = (ratio - ratio_uncertainty, ratio + ratio_uncertainty);
        if !(least > 1.0 && greatest < 2.0) {
            return Err(PlanError::Refused(format!(
                "the inertia ratio I3/IT is {least:.4} to {greatest:.4} (--ratio, otherwise the spacecraft's, +- \
                 --ratio-uncertainty); allowed is above 1 and below 2: up to 1 nutation does not turn in the body or the \
                 damper lets it grow, so that no train ends quietly, and no body has 2 or more"
            )));
        }
        let (moments_kg_m2, products_kg_m2) =
            (mass.moments_kg_m2(propellant_kg), mass.products_kg_m2(propellant_kg));
        let body = Self { propellant_kg, inertia, moments_kg_m2, products_kg_m2, ratio, ratio_uncertainty };
        if request.ratio.is_none() {
            return Ok(body);
        }
        let inertia = Inertia::axisymmetric(body.inertia.spin_kg_m2(), ratio).map_err(refused)?;
        Ok(Self { moments_kg_m2: inertia.principal_kg_m2(), products_kg_m2: [0.0; 3], inertia, ..body })
    }
}

/// Thruster or group that fires.
#[derive(Clone, Debug)]
pub struct Actuator {
    /// Its name.
    pub name: String,
    /// The same, as a burn of the FMU takes it.
    pub firing: Firing,
    torque_n_m: f64,
    /// Propellant flow, in kg/s.
    pub flow_kg_s: f64,
    /// Whether an opposite thruster can alternate with it.
    pub has_opposite: bool,
}

impl Actuator {
    fn new(request: &TurnRequest, spinner: &Spinner) -> Result<Self, PlanError> {
        let name = thruster_name(request, spinner)?;
        let (mask, opposite) = spinner.named(&name).ok_or_else(|| {
            let thrusters = spinner.thrusters.iter().map(|thruster| thruster.name.as_str());
            let groups = spinner.groups.iter().map(|group| group.name.as_str());
            let known = thrusters.chain(groups).collect::<Vec<_>>().join(", ");
            PlanError::Refused(format!("--thruster is \"{name}\"; this spacecraft has {known}"))
        })?;
        let thrust = spinner.thrust(mask);
        let torque_n_m = thrust.torque_body_n_m.xy().norm();
        if torque_n_m < 1e-9 {
            let what = "which has no torque across the spin axis";
            return Err(PlanError::Refused(format!("--thruster is \"{name}\", {what}")));
        }
        let against = |mask: u32| opposes(&thrust.torque_body_n_m, &spinner.thrust(mask).torque_body_n_m);
        let number = |k: usize| i32::try_from(k + 1).unwrap_or(i32::MAX);
        let (firing, has_opposite) = match spinner.thrusters.iter().position(|t| t.name == name) {
            Some(k) => {
                let opposite = (0..spinner.thrusters.len()).find(|&k| against(1 << k)).map(number);
                (Firing::Thruster { number: number(k), opposite }, opposite.is_some())
            }
            None => (Firing::Group(name.clone()), opposite.is_some_and(against)),
        };
        Ok(Self { name, firing, torque_n_m, flow_kg_s: thrust.flow_kg_s, has_opposite })
    }
}

impl Task {
    /// Makes the task of a request and a spacecraft.
    pub fn new(request: &TurnRequest, spinner: &Spinner) -> Result<Self, PlanError> {
        let angle_deg = request.angle_deg;
        let allowed = format!("above 0 to {MAX_ANGLE_DEG} deg");
        check("--angle", angle_deg, angle_deg > 0.0 && angle_deg <= MAX_ANGLE_DEG, &allowed)?;
        let sun_deg = request.sun_angle_deg;
        check("--sun-angle", sun_deg, sun_deg > 0.0 && sun_deg < 90.0, "above 0 to below 90 deg")?;
        let geometry = TurnGeometry::new(request, spinner)?;
        let angle_rad = if request.target.is_some() { geometry.angle_rad() } else { angle_deg.to_radians() };
        let has_sun = request.sun.is_some() || request.date.is_some();
        let sun_angle_rad = if has_sun { geometry.sun_angle_rad() } else { sun_deg.to_radians() };
        let rate_rad_s = match request.rate_rpm {
            Some(rate_rpm) => positive("--rate", rate_rpm)? * RPM_RAD_S,
            None => started::rate_rad_s(spinner)?.unwrap_or_else(|| spinner.limits.spin_rate_rad_s()),
        };
        let body = Body::new(request, spinner)?;
        let error_rpm = not_negative("--rate-uncertainty", request.rate_uncertainty_rpm)?;
        let is_less = error_rpm * RPM_RAD_S < rate_rad_s;
        check("--rate-uncertainty", error_rpm, is_less, "less than the spin rate (--rate)")?;
        let actuator = Actuator::new(request, spinner)?;
        let spin = Spin { rate_rad_s, ratio: body.ratio, inertia_kg_m2: body.inertia.spin_kg_m2() };
        let limit = |flag, value: Option<f64>| value.map_or(Ok(f64::INFINITY), |value| positive(flag, value));
        Ok(Self {
            geometry,
            angle_rad,
            angle_tolerance: positive("--angle-tolerance", request.angle_tolerance_percent)? / 100.0,
            case: ForecastCase {
                spin,
                assumed_rate_rad_s: rate_rad_s,
                timing: request.timing,
                torque_n_m: actuator.torque_n_m,
            },
            range: Range { ratio: body.ratio_uncertainty, rate_rad_s: error_rpm * RPM_RAD_S },
            sun_angle_rad,
            resolution_s: spinner.resolution_s,
            damper_time_constant_s: spinner.damper_time_constant_s,
            allowed_nutation_rad: allowed_nutation_rad(
                spinner.limits.period_variation_s.0,
                rate_rad_s,
                sun_angle_rad,
            ),
            limits: TaskLimits {
                peak_rad: limit("--max-nutation", request.max_nutation_deg)?.to_radians(),
                final_rad: limit("--max-final", request.max_final_deg)?.to_radians(),
                duration_s: limit("--max-duration", request.max_duration_s)?,
            },
            body,
            actuator,
        })
    }

    /// EME2000 to body at the start, with the spin axis where the turn begins.
    pub fn attitude(&self) -> Quaternion {
        self.geometry.attitude(&self.body.inertia.spin_axis_body())
    }

    /// Whether a limit was given for the burn; the propellant on board always is one.
    pub fn is_limited(&self) -> bool {
        let TaskLimits { peak_rad, final_rad, duration_s } = self.limits;
        [peak_rad, final_rad, duration_s].iter().any(|limit| limit.is_finite())
    }

    /// Whether a move is the task's angle within its tolerance.
    pub fn meets_angle(&self, moved_rad: f64) -> bool {
        (moved_rad / self.angle_rad - 1.0).abs() <= self.angle_tolerance
    }

    /// The same task for another angle, met as well as whole pulses can.
    #[must_use]
    pub fn with_angle(&self, angle_rad: f64) -> Self {
        Self { angle_rad, angle_tolerance: f64::INFINITY, ..self.clone() }
    }
}

/// Thruster that fires: the flag's, otherwise the first one that tilts the momentum.
fn thruster_name(request: &TurnRequest, spinner: &Spinner) -> Result<String, PlanError> {
    if let Some(name) = &request.thruster {
        return Ok(name.clone());
    }
    let first = spinner.steering_pair().and_then(|(first, _)| spinner.thrusters.get(first));
    first.map(|thruster| thruster.name.clone()).ok_or_else(|| PlanError::Direction {
        flag: "--thruster",
        what: "no thruster of the spacecraft's file tilts the spin axis".to_owned(),
    })
}
