//! How a flight stands along its orbit: how near the Sun comes to the axes of panels, how often an antenna sees the Earth.

use core::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;

use crate::attitude::{SunAngles, angle_between_rad};
use crate::constants::DAY_S;
use crate::plant::{self, Configuration, Flight, Instant, StepContext};
use crate::spacecraft::{Antenna, Spacecraft};

/// The Sun this near to the axis of a panel leaves it no angle at which the cells face it, in rad.
const NEAR_AXIS_RAD: f64 = 10.0 * core::f64::consts::PI / 180.0;
/// A part of the time that is little contact.
const LITTLE_CONTACT: f64 = 0.1;
/// Times that are looked at.
const SAMPLES: u32 = 96;
/// Longest span that is looked at, in s, and the one of an orbit without a period.
const SPANS_S: [f64; 2] = [10.0 * DAY_S, DAY_S];
/// A panel whose axis is this near to Z cannot be turned across the Sun by a turn about Z, in rad.
const ALONG_Z_RAD: f64 = 5.0 * core::f64::consts::PI / 180.0;

/// Counts of what was seen along an orbit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlightSurvey {
    /// Times that were looked at.
    count: u32,
    /// Times, by panel, with the Sun near its axis.
    near_axis: Vec<u32>,
    /// Times at which an antenna sees the Earth.
    contact: u32,
    /// Whether there is a planet.
    has_planet: bool,
}

impl FlightSurvey {
    /// Survey of a flight from `start_s` over the orbits that bring all its windows.
    pub fn new(flight: &Flight, given: StepContext<'_>, spacecraft: &Spacecraft, start_s: f64) -> Self {
        let mut survey = Self { near_axis: vec![0; spacecraft.panels.len()], ..Self::default() };
        let Some(configuration) = flight.configuration() else { return survey };
        survey.has_planet = configuration.planet().is_some();
        let Some(guided) = configuration.attitude.guided() else { return survey };
        let [most_s, day_s] = SPANS_S;
        let period_s = configuration.orbit.period_s() * f64::from(guided.schedule.every.max(1));
        let span_s = if period_s.is_finite() && survey.has_planet { period_s.min(most_s) } else { day_s };
        let times_s = (0..SAMPLES).map(|k| start_s + span_s * (f64::from(k) + 0.5) / f64::from(SAMPLES));
        let Some(context) = flight.context() else { return survey };
        plant::survey(context, given, times_s, |configuration, _, instant| {
            survey.see(spacecraft, configuration, instant);
        });
        survey
    }

    fn see(&mut self, spacecraft: &Spacecraft, configuration: &Configuration, instant: &Instant) {
        self.count += 1;
        let turning = spacecraft.panels.iter().zip(&configuration.panels);
        for ((panel, setting), near) in turning.zip(&mut self.near_axis) {
            let from_axis_rad = angle_between_rad(&panel.axis_body, &instant.sun_body);
            let is_near = from_axis_rad.min(core::f64::consts::PI - from_axis_rad) < NEAR_AXIS_RAD;
            *near += u32::from(is_near && setting.is_by_sun());
        }
        let earth_body = instant.earth_body();
        let sees = spacecraft.antennas.iter().any(|named| sees(&named.antenna, &earth_body));
        self.contact += u32::from(sees);
    }

    /// One sentence each; none where everything looks right.
    pub fn warnings(&self, spacecraft: &Spacecraft) -> Vec<String> {
        if self.count == 0 {
            return Vec::new();
        }
        let share = |times: u32| f64::from(times) / f64::from(self.count);
        let mut found = Vec::new();
        for (k, (near, panel)) in self.near_axis.iter().zip(&spacecraft.panels).enumerate() {
            let is_along_z = panel.axis_body.cross(&Vector3::z()).norm() < crate::math::sin(ALONG_Z_RAD);
            let rule = if self.has_planet && !is_along_z { "yawSteering" } else { "sunPointing" };
            if *near > 0 {
                found.push(format!(
                    "panel[{}]: the Sun is within 10 deg of the axis of `{}` for {:.0} % of the time, and its cells cannot face \
                     it there: set guided.scienceRule = {rule}, or turn the axis",
                    k + 1,
                    panel.name,
                    (100.0 * share(*near)).max(1.0)
                ));
            }
        }
        let contact = share(self.contact);
        if !spacecraft.antennas.is_empty() && contact < LITTLE_CONTACT {
            let names: Vec<String> =
                spacecraft.antennas.iter().map(|named| format!("`{}`", named.name)).collect();
            found.push(format!(
                "antenna {} has the Earth in its beam for {:.1} % of the time: set downlinks ([downlinks], guided.downlink*), or \
                 azimuth_deg or axis of the antenna",
                names.join(", "),
                100.0 * contact
            ));
        }
        found
    }
}

/// Whether the beam of an antenna can be put on a direction in the body frame.
fn sees(antenna: &Antenna, direction_body: &Vector3<f64>) -> bool {
    let angles = SunAngles::from_direction(direction_body);
    match antenna.fan() {
        Some(fan) => {
            let off_rad = crate::math::wrapped_rad(angles.azimuth_rad - fan.middle_rad).abs();
            let along_rad = fan.half_rad + 0.5 * antenna.along_rad;
            angles.elevation_rad.abs() <= antenna.half_across_rad() && off_rad <= along_rad
        }
        None => {
            let beam_rad = 0.5 * antenna.across_rad.max(antenna.along_rad);
            let axis_body = antenna.axis_body().unwrap_or_default();
            angle_between_rad(&axis_body, direction_body) <= beam_rad.min(FRAC_PI_2)
        }
    }
}
