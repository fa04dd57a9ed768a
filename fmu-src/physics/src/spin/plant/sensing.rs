//! What the sensors see: Sun crossings, star samples, Sun and Earth on the L1 orbit.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::state::{DIRECTION_INTERVAL_S, Plant, Sampling, SpinPlantError, StarSample};
use crate::attitude::{RigidBodyState, angle_between_rad};
use crate::spin::{
    crossing::{Crossing, Pole},
    crossing_detector::CrossingDetector,
    noise::{Channel, normal},
    spinner::Spinner,
    tracker::{picket_of, searched},
    work::{Cost, Work},
};

impl Plant {
    /// Looks up Sun and Earth on the L1 orbit for the next interval.
    pub(super) fn refresh_directions(&mut self) {
        let Some(l1) = &self.l1 else { return };
        let seen = l1.sun_earth(self.refresh_s);
        self.directions.sun_inertial = seen.sun_inertial;
        self.directions.earth_inertial = seen.earth_inertial;
        self.sun.forget(self.refresh_s);
        self.refresh_count = self.refresh_count.saturating_add(1);
        self.refresh_s = self.refresh_count as f64 * DIRECTION_INTERVAL_S;
    }

    /// Lets the sensors see the first thing there is to see up to `until_s`; when it was, if there was one.
    pub(super) fn observe(
        &mut self,
        spinner: &Spinner,
        until_s: f64,
        work: &mut Work,
    ) -> Result<Option<f64>, SpinPlantError> {
        let (sun, star) = (self.directions.sun_inertial, self.directions.star_inertial);
        let azimuths = self.sensor_azimuths;
        let look = |body, inertial| move || Crossing { body, inertial, pole: Pole::SpinAxis };
        let due_s = |detector: &mut CrossingDetector, body, inertial: Vector3<f64>, work: &mut Work| {
            // A direction of 0 is none.
            let known = inertial != Vector3::zeros();
            let due_s =
                known.then(|| detector.due_s(&self.motion, look(body, inertial), until_s, work)).flatten();
            due_s.unwrap_or(f64::INFINITY)
        };
        let sun_s = due_s(&mut self.sun, azimuths.sun, sun, work);
        let star_s = if self.sampling == Sampling::Clock {
            let tick_s = self.clock_start_s + self.clock_count as f64 * self.clock_period_s;
            if tick_s <= until_s { tick_s } else { f64::INFINITY }
        } else {
            due_s(&mut self.star, azimuths.star, star, work)
        };
        if sun_s.is_infinite() && star_s.is_infinite() {
            return Ok(None);
        }
        if sun_s <= star_s {
            self.see_sun(spinner, sun_s, work)?;
        } else {
            self.see_star(spinner, star_s, work)?;
        }
        Ok(Some(sun_s.min(star_s)))
    }

    fn see_sun(&mut self, spinner: &Spinner, time_s: f64, work: &mut Work) -> Result<(), SpinPlantError> {
        self.reach(spinner, time_s, work)?;
        let state = self.motion.at(time_s);
        let angle = angle_between_rad(&state.attitude.spin_axis_inertial(), &self.directions.sun_inertial);
        let noise = normal(self.seed, Channel::SunSensor, self.sun.count());
        self.sun_sample_rad = angle + spinner.sun_sensor.noise_deg.to_radians() * noise;
        self.sun.pass(time_s, state.rate_rad_s(self.motion.inertia()).z);
        let dry = self.is_dry();
        if let Some(sequencer) = self.sequencer.as_mut().filter(|_| !dry) {
            sequencer.sun_pulse(&self.motion, time_s, &self.directions.sun_inertial, work);
        }
        Ok(())
    }

    fn see_star(&mut self, spinner: &Spinner, time_s: f64, work: &mut Work) -> Result<(), SpinPlantError> {
        self.reach(spinner, time_s, work)?;
        let state = self.motion.at(time_s);
        let tracker = &spinner.star_tracker;
        let declination =
            state.attitude.spin_axis_inertial().dot(&self.directions.star_inertial).clamp(-1.0, 1.0).asin();
        let visible = self.directions.star_inertial != Vector3::zeros()
            && declination.abs() <= 0.5 * tracker.field_of_view_deg.to_radians();
        let turn = match self.sampling {
            Sampling::Clock => {
                work.spend(Cost::ClockSample);
                self.clock_count = self.clock_count.saturating_add(1);
                None
            }
            Sampling::Spins => {
                self.star.pass(time_s, state.rate_rad_s(self.motion.inertia()).z);
                Some(self.star.count().wrapping_sub(1))
            }
        };
        // Pickets count from the Sun pulse: without a Sun there are none.
        let sun_known = self.directions.sun_inertial != Vector3::zeros();
        let seen = turn
            .is_none_or(|turn| sun_known && searched(self.star_picket(spinner, &state), turn, tracker.every));
        if !(visible && seen) {
            return Ok(());
        }
        let noise = normal(self.seed, Channel::StarTracker, u64::from(self.sample.count));
        let declination_rad = declination + tracker.noise_deg.to_radians() * noise;
        self.sample = StarSample { time_s, declination_rad, count: self.sample.count.wrapping_add(1) };
        let phase = self.theory.ratio * self.theory.rate_rad_s * (time_s - self.estimator_since_s);
        self.estimator.add(phase, declination_rad);
        Ok(())
    }

    /// Picket of the star: its azimuth about the momentum after the Sun's.
    pub(super) fn star_picket(&self, spinner: &Spinner, state: &RigidBodyState) -> u32 {
        let pole = state.momentum_inertial;
        let ahead = |direction: &Vector3<f64>| {
            let seen = state
                .attitude
                .body_from_inertial(&(direction - pole * (pole.dot(direction) / pole.norm_squared())));
            seen.y.atan2(seen.x)
        };
        // Half a picket of margin keeps a star that starts on a border off it.
        let pickets = spinner.star_tracker.pickets;
        let margin = PI / f64::from(pickets);
        picket_of(
            ahead(&self.directions.star_inertial) - ahead(&self.directions.sun_inertial) + margin,
            pickets,
        )
    }
}
