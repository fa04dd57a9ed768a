//! A plan pulse by pulse, as CSV and JSON.

use physics::{attitude::angle_between_rad, constants::RPM_RAD_S, environment::dates};
use serde::Serialize;

use super::{
    PlanError, Task, TrainForecast,
    flight::SimulatedPlan,
    limit_checks::LimitCheck,
    options::RightAscensionDeclination,
    start_values::{self, Setting},
    timing_label,
    turn_geometry::{Way, right_ascension_declination},
};

/// A plan that was simulated and checked against its limits.
#[derive(Clone, Debug)]
pub struct PlannedBurn {
    /// Name of the spacecraft.
    pub name: String,
    /// Date, in s past J2000 TDB, where it was given.
    pub epoch_s: Option<f64>,
    /// Request that the plan answers.
    pub task: Task,
    /// The train.
    pub row: TrainForecast,
    /// How it is simulated.
    pub flight: SimulatedPlan,
    /// Its limits.
    pub checks: Vec<LimitCheck>,
}

/// One line of the table.
#[derive(Serialize)]
struct Line<'a> {
    pulse: usize,
    time_s: f64,
    on_time_s: f64,
    thruster: &'a str,
    phase_deg: f64,
    after_sun_crossing_s: Option<f64>,
    axis_right_ascension_deg: f64,
    axis_declination_deg: f64,
    nutation_deg: f64,
    sun_angle_deg: f64,
    earth_angle_deg: Option<f64>,
}

#[derive(Serialize)]
struct Course {
    length_deg: f64,
    sun_angle_deg: [f64; 2],
    way_from_sun_deg: [f64; 2],
}

impl Course {
    fn new(way: &Way) -> Self {
        let both = |(from, to): (f64, f64)| [from.to_degrees(), to.to_degrees()];
        Self {
            length_deg: way.length_rad.to_degrees(),
            sun_angle_deg: both(way.sun_angle_rad),
            way_from_sun_deg: both(way.heading_rad),
        }
    }
}

#[derive(Serialize)]
struct Document<'a> {
    spacecraft: &'a str,
    date: Option<String>,
    spin_rate_rpm: f64,
    timing: &'a str,
    train: String,
    start: RightAscensionDeclination,
    target: RightAscensionDeclination,
    end: RightAscensionDeclination,
    miss_deg: f64,
    sun: RightAscensionDeclination,
    earth: Option<RightAscensionDeclination>,
    great_circle: Course,
    rhumb_line: Option<Course>,
    propellant_kg: f64,
    worst_nutation_deg: f64,
    worst_final_nutation_deg: f64,
    limits: &'a [LimitCheck],
    start_values: serde_json::Map<String, serde_json::Value>,
    pulses: Vec<Line<'a>>,
}

fn failed(error: impl std::fmt::Display) -> PlanError {
    PlanError::Write(error.to_string())
}

impl PlannedBurn {
    /// Start values of SpinPlant.
    pub fn start_values(&self) -> Vec<(&'static str, Setting)> {
        start_values::start_values(&self.task, &self.row)
    }

    /// The table with a header.
    ///
    /// # Errors
    /// Text that cannot be written.
    pub fn to_csv(&self) -> Result<String, PlanError> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        self.lines().try_for_each(|line| writer.serialize(line)).map_err(failed)?;
        String::from_utf8(writer.into_inner().map_err(failed)?).map_err(failed)
    }

    /// Everything there is to say about the plan, the table included.
    ///
    /// # Errors
    /// Text that cannot be written.
    pub fn to_json(&self) -> Result<String, PlanError> {
        let mut values = serde_json::Map::new();
        for (name, value) in self.start_values() {
            values.insert(name.to_owned(), serde_json::to_value(value).map_err(failed)?);
        }
        let geometry = &self.task.geometry;
        let document = Document {
            spacecraft: &self.name,
            date: self.epoch_s.map(dates::utc),
            spin_rate_rpm: self.task.case.spin.rate_rad_s / RPM_RAD_S,
            timing: timing_label(self.task.case.timing),
            train: self.row.label(),
            start: right_ascension_declination(&self.flight.start_axis_inertial),
            target: right_ascension_declination(&geometry.target_inertial),
            end: right_ascension_declination(&self.flight.end_axis_inertial()),
            miss_deg: self.flight.miss_rad(&self.task).to_degrees(),
            sun: right_ascension_declination(&geometry.sun_inertial),
            earth: geometry.earth_inertial.as_ref().map(right_ascension_declination),
            great_circle: Course::new(&geometry.great_circle()),
            rhumb_line: geometry.rhumb_line().as_ref().map(Course::new),
            propellant_kg: self.row.propellant_kg,
            worst_nutation_deg: self.row.peak_rad.to_degrees(),
            worst_final_nutation_deg: self.row.final_rad.to_degrees(),
            limits: &self.checks,
            start_values: values,
            pulses: self.lines().collect(),
        };
        serde_json::to_string_pretty(&document).map(|text| text + "\n").map_err(failed)
    }

    fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        let geometry = &self.task.geometry;
        self.flight.pulses.iter().enumerate().map(move |(k, pulse)| {
            let axis = &pulse.axis_inertial;
            let place = right_ascension_declination(axis);
            Line {
                pulse: k + 1,
                time_s: pulse.time_s,
                on_time_s: pulse.on_time_s,
                thruster: &pulse.thruster,
                phase_deg: pulse.phase_rad.to_degrees(),
                after_sun_crossing_s: pulse.after_sun_s,
                axis_right_ascension_deg: place.right_ascension_deg,
                axis_declination_deg: place.declination_deg,
                nutation_deg: pulse.nutation_rad.to_degrees(),
                sun_angle_deg: angle_between_rad(axis, &geometry.sun_inertial).to_degrees(),
                earth_angle_deg: geometry
                    .earth_inertial
                    .map(|earth| angle_between_rad(&-axis, &earth).to_degrees()),
            }
        })
    }
}
