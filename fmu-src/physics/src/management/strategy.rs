//! Strategies of paper 000: dumps alone, reactive targets, predictive targets.
//!
//! Reactive: every downlink aims at the same momentum. Predictive: every downlink aims at the middle of the momenta from which the
//! coming cycles, forecast in their default attitudes ([`super::prediction`]), can be simulated below all thresholds, each coming downlink
//! with what sunlight can do then; of the physical momentum at the one that keeps X and Z smallest through the next science.
//! Without a cycle to come it is reactive. Science that unloads has the same targets at its end, of the physical momentum the reactive
//! one.

use nalgebra::Vector3;

use super::linear::LinearTorque;
use super::prediction::{
    Components, Forecast, ForecastTerms, PredictedDownlink, PredictedScience, Prediction,
};
use super::profile::{Component, ControlAuthority};
use super::rotated_momentum::best_turned;
use super::targeting::{DownlinkState, ScienceUnload, Targeting};
use crate::attitude::{SunAngles, direction_from_angles};
use crate::enumeration::enumeration;
use crate::guidance::{ScienceArc, SelectedSunDirection};
use crate::momentum::Settings;
use crate::plant::{DownlinkForecast, ForecastMomentum, PlantError, StartMomentum, forecast};
use crate::radiation::TorquePolynomial;
use crate::spacecraft::{Material, Sunshade, SunshadeModel};

enumeration! {
    /// What sunlight is used for.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Strategy {
        /// Nothing: the Sun stands on -Y, thrusters dump.
        #[default]
        1 => DumpsOnly,
        /// Every downlink brings the momentum toward momentum.target.
        2 => Reactive,
        /// Every downlink brings it to the middle of what keeps all components below dump.threshold through the coming
        /// momentum.horizon cycles, forecast.
        3 => Predictive,
    }
}

/// A strategy with all it needs of parameters and spacecraft.
#[derive(Clone, Copy, Debug)]
pub struct Manager<'a> {
    /// Strategy.
    pub strategy: Strategy,
    /// Axes, formula, limits.
    pub targeting: Targeting<'a>,
    /// Momentum a reactive downlink aims at, body frame, in N m s.
    pub target_body_n_m_s: Vector3<f64>,
    /// The wheels' bias, from which the target counts, body frame, in N m s.
    pub bias_body_n_m_s: Vector3<f64>,
    /// How many cycles ahead predictive targets look, at most [`super::LONGEST_HORIZON`].
    pub horizon: u32,
    /// The shade, for the linear formula.
    pub sunshade: Option<(&'a Sunshade, SunshadeModel)>,
}

impl Forecast for DownlinkForecast<'_, '_> {
    type Error = PlantError;

    fn terms(&self) -> ForecastTerms {
        let Settings { convention, policy, .. } = self.configuration().momentum;
        ForecastTerms {
            begin_s: self.begin.time_s,
            cycle_s: if self.begin.is_first { f64::INFINITY } else { self.law.schedule.cycle_s() },
            span_s: self.span_s,
            begins_in_science: self.science.is_some(),
            downlink_s: self.law.schedule.downlink_s(),
            convention,
            policy,
        }
    }

    fn simulated(
        &mut self,
        times_s: impl Iterator<Item = f64>,
        step_s: f64,
        visit: impl FnMut(ForecastMomentum),
    ) -> Result<(), PlantError> {
        forecast(self, times_s, step_s, visit)
    }
}

impl Manager<'_> {
    /// Chooses the Sun's place; see [`crate::plant::SunPlanner`].
    ///
    /// # Errors
    /// What ends a flight.
    pub fn choose(
        &self,
        forecast: &mut DownlinkForecast<'_, '_>,
    ) -> Result<Option<SelectedSunDirection>, PlantError> {
        let Some(to_earth) = forecast.to_earth.filter(|_| self.strategy != Strategy::DumpsOnly) else {
            return Ok(None);
        };
        let prediction = self.predict(forecast)?;
        let sunlit = forecast.sunlit();
        let linear = self.linear(sunlit.solar.materials(), &sunlit.center_of_mass_body_m());
        let ForecastTerms { convention, .. } = forecast.terms();
        let torque = |sun_body: &Vector3<f64>| sunlit.torque_body_n_m(sun_body, forecast.pressure_pa);
        let state = DownlinkState {
            to_sun: forecast.to_sun,
            to_earth,
            separations_rad: forecast.separations_rad,
            momentum: forecast.begin.momentum,
            span_s: forecast.science.as_ref().map_or(forecast.span_s, ScienceArc::light_s),
            torque_body_n_m: &torque,
            pressure_pa: forecast.pressure_pa,
            linear,
            science: forecast.science.as_ref().map(|arc| ScienceUnload { arc, convention }),
        };
        Ok(self.place(state, prediction.as_ref()))
    }

    /// The linear formula of the shade of these materials about this centre of mass; `None` without a shade.
    pub(super) fn linear(
        &self,
        materials: &[Material],
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Option<LinearTorque> {
        let (shade, model) = self.sunshade?;
        let polynomial =
            TorquePolynomial::of_sunshade(shade, model, materials, center_of_mass_body_m).ok()?;
        Some(LinearTorque::new(&polynomial, shade.dcm_body_from_shade))
    }

    /// Forecast for predicted targets; `None` where no cycle is to come.
    ///
    /// # Errors
    /// What ends a forecast.
    pub(super) fn predict<F: Forecast>(&self, forecast: &mut F) -> Result<Option<Prediction>, F::Error> {
        if self.strategy == Strategy::Predictive { Prediction::new(forecast, self.horizon) } else { Ok(None) }
    }

    /// Direction of the Sun for the predicted target, or else the one target; `None` where no direction is
    /// admissible.
    pub(super) fn place(
        &self,
        mut state: DownlinkState<'_>,
        prediction: Option<&Prediction>,
    ) -> Option<SelectedSunDirection> {
        let predicted = match (prediction, state.momentum) {
            (Some(Prediction::Science(science)), StartMomentum::Inertial(momentum)) => {
                // A target in the body would be another one under the other antenna: what is off it in space is brought to zero.
                self.turned(&state, science).map(|end_body| {
                    let end = science.inertial_from_body * end_body;
                    state.momentum = StartMomentum::Inertial(momentum - end);
                    Vector3::zeros()
                })
            }
            (Some(Prediction::Components(components)), _) => self.kept(&state, components),
            _ => None,
        };
        let target = predicted.unwrap_or(self.bias_body_n_m_s + self.target_body_n_m_s);
        self.targeting.sun_direction(&state, &target)
    }

    /// The target from which X and Z stay below their thresholds through the coming cycles.
    fn kept(&self, state: &DownlinkState<'_>, prediction: &Components) -> Option<Vector3<f64>> {
        let momentum_body_n_m_s = self.targeting.default_momentum(state)?;
        let torques = self.targeting.present_torques(state, prediction.downlinks[0].separations_rad)?;
        let default_n_m = (state.torque_body_n_m)(&direction_from_angles(SunAngles::default())).xz();
        // What the default attitude adds beside sunlight alone comes in others too.
        let beside = |downlink: &PredictedDownlink| {
            let light = default_n_m * downlink.equivalent_s(state.pressure_pa);
            [0, 1].map(|axis| downlink.added[axis] - light[axis])
        };
        let later = prediction.cycles(|downlink| {
            let torques = downlink.separations_rad.and_then(|it| self.targeting.torques(state, it));
            let light_s = downlink.equivalent_s(state.pressure_pa);
            let beside = beside(downlink);
            [0, 1].map(|axis| {
                let torques_n_m = torques.map_or([default_n_m[axis]; 2], |it| it[axis]);
                torques_n_m.map(|it| it * light_s + beside[axis])
            })
        });
        let beside = beside(&prediction.downlinks[0]);
        let policy = &prediction.policy;
        let target = |axis: usize| {
            let body_axis = 2 * axis;
            let bias_n_m_s = policy.bias_body_n_m_s[body_axis];
            let component = Component {
                momentum_n_m_s: momentum_body_n_m_s[body_axis] + beside[axis] - bias_n_m_s,
                authority: torques[axis].map(|it| it * state.span_s),
                cycles: later[axis].get(..prediction.count).unwrap_or_default(),
                path: &prediction.path[axis],
                threshold: policy.threshold_body_n_m_s[body_axis],
                dumped: |before| policy.after(&Vector3::repeat(before + bias_n_m_s))[body_axis] - bias_n_m_s,
            };
            component.target() - beside[axis] + bias_n_m_s
        };
        Some(Vector3::new(target(0), 0.0, target(1)))
    }

    /// The target that keeps the momentum of the next science smallest.
    fn turned(&self, state: &DownlinkState<'_>, science: &PredictedScience) -> Option<Vector3<f64>> {
        let momentum_body_n_m_s = self.targeting.default_momentum(state)?;
        let authority = self
            .targeting
            .torques(state, [state.separation_rad(); 2])?
            .map(|it| it.map(|torque| torque * state.span_s));
        let end = science.end_body_n_m_s;
        let range = |axis: usize, authority: ControlAuthority, requested: bool| {
            // Under the other antenna the body stands half a turn about the Sun line away.
            let [least, most] = [authority[0].min(-authority[1]), authority[1].max(-authority[0])];
            if requested {
                [momentum_body_n_m_s[axis] + least, momentum_body_n_m_s[axis] + most]
            } else {
                [end[axis]; 2]
            }
        };
        let [by_x, by_z] = self.targeting.axes.requested();
        let ranges = [range(0, authority[0], by_x), range(2, authority[1], by_z)];
        Some(best_turned(&science.squares, ranges, end.y))
    }
}

#[cfg(test)]
mod tests;
