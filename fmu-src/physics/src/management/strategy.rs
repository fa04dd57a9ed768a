//! Strategies of paper 000: dumps alone, reactive targets, predictive targets.
//!
//! Reactive: every downlink aims at the same momentum. Predictive: every downlink aims at the middle of the momenta from which the
//! coming cycles, forecast in their default attitudes ([`super::ahead`]), can be simulated below all thresholds, each coming downlink
//! with what sunlight can do then; of the physical momentum at the one that keeps X and Z smallest through the next science.
//! Without a cycle to come it is reactive. Science that unloads has the same targets at its end, of the physical momentum the reactive
//! one.

use nalgebra::Vector3;

use super::linear::LinearTorque;
use super::prediction::{Components, Forecast, PredictedDownlink, PredictedScience, Prediction};
use super::profile::{Component, ControlAuthority};
use super::rotated_momentum::best_turned;
use super::targeting::{DownlinkState, ScienceAim, Targeted, Targeting};
use crate::attitude::{SunAngles, direction_from_angles};
use crate::enumeration::enumeration;
use crate::guidance::{ChosenPlace, ScienceCourse};
use crate::momentum::{Convention, DumpPolicy};
use crate::plant::{DownlinkForecast, ForecastMomentum, PlantError, StartMomentum, SunPlanner};
use crate::radiation::TorquePolynomial;
use crate::spacecraft::{Sunshade, SunshadeModel};

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
    pub targeting: Targeting,
    /// Momentum a reactive downlink aims at, body frame, in N m s.
    pub target_body_n_m_s: Vector3<f64>,
    /// How many cycles ahead predictive targets look, at most [`super::LONGEST_HORIZON`].
    pub horizon: u32,
    /// The shade, for the linear formula.
    pub sunshade: Option<(&'a Sunshade, SunshadeModel)>,
}

impl SunPlanner for Manager<'_> {
    fn choose(&self, outlook: &mut DownlinkForecast<'_>) -> Result<Option<ChosenPlace>, PlantError> {
        let Some(to_earth) = outlook.to_earth.filter(|_| self.strategy != Strategy::DumpsOnly) else {
            return Ok(None);
        };
        let ahead = self.ahead(outlook)?;
        let linear = self.linear(&outlook.center_of_mass_body_m());
        let torque = |sun_body: &Vector3<f64>| outlook.torque_body_n_m(sun_body);
        let aim = DownlinkState {
            to_sun: outlook.to_sun,
            to_earth,
            momentum: outlook.momentum,
            span_s: outlook.science.as_ref().map_or(outlook.span_s, ScienceCourse::light_s),
            torque_body_n_m: &torque,
            pressure_pa: outlook.pressure_pa,
            linear,
            science: outlook
                .science
                .as_ref()
                .map(|course| ScienceAim { course, convention: DownlinkForecast::convention(outlook) }),
        };
        let separations_rad = outlook.separations_rad;
        Ok(self.place(aim, ahead.as_ref(), separations_rad))
    }
}

impl Forecast for DownlinkForecast<'_> {
    type Error = PlantError;

    fn begin_s(&self) -> f64 {
        self.time_s
    }

    fn cycle_s(&self) -> f64 {
        DownlinkForecast::cycle_s(self)
    }

    fn span_s(&self) -> f64 {
        self.span_s
    }

    fn downlink_s(&self) -> f64 {
        DownlinkForecast::downlink_s(self)
    }

    fn begins_in_science(&self) -> bool {
        self.science.is_some()
    }

    fn convention(&self) -> Convention {
        DownlinkForecast::convention(self)
    }

    fn dump_policy(&self) -> DumpPolicy {
        DownlinkForecast::dump_policy(self)
    }

    fn fly(
        &mut self,
        times_s: impl Iterator<Item = f64>,
        step_s: f64,
        visit: impl FnMut(ForecastMomentum),
    ) -> Result<(), PlantError> {
        self.forecast(times_s, step_s, visit)
    }
}

impl Manager<'_> {
    /// The shade's linear formula about this centre of mass; `None` without a shade.
    pub(super) fn linear(&self, center_of_mass_body_m: &Vector3<f64>) -> Option<LinearTorque> {
        let (shade, model) = self.sunshade?;
        let polynomial = TorquePolynomial::of_sunshade(shade, model, center_of_mass_body_m).ok()?;
        Some(LinearTorque::new(&polynomial, shade.dcm_body_from_shade))
    }

    /// What lies ahead, where targets are predicted from it; `None` where nothing is to come.
    ///
    /// # Errors
    /// What ends a forecast.
    pub(super) fn ahead<F: Forecast>(&self, forecast: &mut F) -> Result<Option<Prediction>, F::Error> {
        if self.strategy == Strategy::Predictive { Prediction::of(forecast, self.horizon) } else { Ok(None) }
    }

    /// Where the Sun is to stand for the target predicted from what lies ahead, or else the one target; `None` where no place is
    /// admissible.
    pub(super) fn place(
        &self,
        mut aim: DownlinkState<'_>,
        ahead: Option<&Prediction>,
        separations_rad: [f64; 2],
    ) -> Option<ChosenPlace> {
        let predicted = match (ahead, aim.momentum) {
            (Some(Prediction::Science(science)), StartMomentum::Inertial(momentum)) => {
                // A target in the body would be another one under the other antenna: what is off it in space is brought to zero.
                self.turned(&aim, science).map(|end_body| {
                    let end = science.inertial_from_body * end_body;
                    aim.momentum = StartMomentum::Inertial(momentum - end);
                    Vector3::zeros()
                })
            }
            (Some(Prediction::Components(components)), _) => self.kept(&aim, components),
            _ => None,
        };
        let target = predicted.unwrap_or(self.target_body_n_m_s);
        let targeted = self.targeting.sun_place_throughout(&aim, &target, separations_rad);
        targeted.map(|Targeted { place, clamped }| ChosenPlace { place, clamped })
    }

    /// The target from which X and Z stay below their thresholds through the coming cycles.
    fn kept(&self, aim: &DownlinkState<'_>, ahead: &Components) -> Option<Vector3<f64>> {
        let now = self.targeting.default_momentum(aim)?;
        let torques = self.targeting.present_torques(aim, ahead.present().separations_rad)?;
        let default_n_m = (aim.torque_body_n_m)(&direction_from_angles(SunAngles::default())).xz();
        // What the default attitude adds beside sunlight alone comes in others too.
        let beside = |downlink: &PredictedDownlink| {
            let light = default_n_m * downlink.equivalent_s(aim.pressure_pa);
            [0, 1].map(|axis| downlink.added[axis] - light[axis])
        };
        let later = ahead.cycles(|downlink| {
            let torques = downlink.separations_rad.and_then(|it| self.targeting.torques(aim, it));
            let light_s = downlink.equivalent_s(aim.pressure_pa);
            let beside = beside(downlink);
            [0, 1].map(|axis| {
                let torques_n_m = torques.map_or([default_n_m[axis]; 2], |it| it[axis]);
                torques_n_m.map(|it| it * light_s + beside[axis])
            })
        });
        let beside = beside(ahead.present());
        let target = |axis: usize| {
            let body_axis = 2 * axis;
            let component = Component {
                now: now[body_axis] + beside[axis],
                reach: torques[axis].map(|it| it * aim.span_s),
                cycles: later[axis].get(..ahead.count()).unwrap_or_default(),
                path: &ahead.path()[axis],
                threshold: ahead.policy.threshold_body_n_m_s[body_axis],
                dumped: |before| ahead.policy.component_after(body_axis, before),
            };
            component.target() - beside[axis]
        };
        Some(Vector3::new(target(0), 0.0, target(1)))
    }

    /// The target that keeps the momentum of the next science smallest.
    fn turned(&self, aim: &DownlinkState<'_>, science: &PredictedScience) -> Option<Vector3<f64>> {
        let now = self.targeting.default_momentum(aim)?;
        let reach = self
            .targeting
            .torques(aim, [aim.separation_rad(); 2])?
            .map(|it| it.map(|torque| torque * aim.span_s));
        let end = science.end_body_n_m_s;
        let range = |axis: usize, reach: ControlAuthority, requested: bool| {
            // Under the other antenna the body stands half a turn about the Sun line away.
            let [least, most] = [reach[0].min(-reach[1]), reach[1].max(-reach[0])];
            if requested { [now[axis] + least, now[axis] + most] } else { [end[axis]; 2] }
        };
        let [by_x, by_z] = self.targeting.axes.requested();
        let ranges = [range(0, reach[0], by_x), range(2, reach[1], by_z)];
        Some(best_turned(&science.squares, ranges, end.y))
    }
}

#[cfg(test)]
mod tests {
    //! Predictive targets of flights that are flown by hand.
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;

    use super::super::prediction::Forecast;
    use super::super::targeting::{TargetAxes, TargetingMethod};
    use super::*;
    use crate::momentum::Reinitialise;

    const DOWNLINK_S: f64 = 1000.0;
    const SCIENCE_S: f64 = 2000.0;
    const CYCLE_S: f64 = DOWNLINK_S + SCIENCE_S;
    const PRESSURE_PA: f64 = 5e-5;

    /// Science takes 1 N m s of X, downlinks change nothing in their default attitude; Sun and Earth are so far apart in each.
    struct ByHand {
        separations_rad: [f64; 4],
        begins_in_science: bool,
    }

    impl ByHand {
        fn first_science_s(&self) -> f64 {
            if self.begins_in_science { 0.0 } else { DOWNLINK_S }
        }
    }

    impl Forecast for ByHand {
        type Error = core::convert::Infallible;

        fn begin_s(&self) -> f64 {
            0.0
        }

        fn cycle_s(&self) -> f64 {
            CYCLE_S
        }

        fn span_s(&self) -> f64 {
            if self.begins_in_science { SCIENCE_S } else { DOWNLINK_S }
        }

        fn downlink_s(&self) -> f64 {
            DOWNLINK_S
        }

        fn begins_in_science(&self) -> bool {
            self.begins_in_science
        }

        fn convention(&self) -> Convention {
            Convention::BodyIntegral
        }

        fn dump_policy(&self) -> DumpPolicy {
            DumpPolicy {
                threshold_body_n_m_s: Vector3::repeat(3.0),
                reinitialise: Reinitialise::Opposite { fraction: 1.0 },
            }
        }

        fn fly(
            &mut self,
            times_s: impl Iterator<Item = f64>,
            _step_s: f64,
            mut visit: impl FnMut(ForecastMomentum),
        ) -> Result<(), Self::Error> {
            let mut before_s = 0.0;
            for time_s in times_s {
                assert!(time_s >= before_s, "{time_s} after {before_s}");
                before_s = time_s;
                // Since the begin of the first science: whole cycles, and what has passed of this one.
                let since_s = time_s - self.first_science_s();
                let cycles = (since_s / CYCLE_S).floor();
                let passed = cycles + ((since_s - cycles * CYCLE_S) / SCIENCE_S).min(1.0);
                let downlink = (since_s / CYCLE_S).ceil().clamp(0.0, 3.0) as usize;
                let angle_rad = self.separations_rad[downlink];
                visit(ForecastMomentum {
                    time_s,
                    downlink: since_s - cycles * CYCLE_S >= SCIENCE_S,
                    to_sun: Vector3::x(),
                    to_earth: Some(Vector3::new(angle_rad.cos(), angle_rad.sin(), 0.0)),
                    pressure_pa: PRESSURE_PA,
                    momentum_body_n_m_s: Vector3::new(-passed.max(0.0), 0.0, 0.0),
                    momentum_inertial_n_m_s: Vector3::zeros(),
                    body_from_inertial: Rotation3::identity(),
                });
            }
            Ok(())
        }
    }

    /// The target of X with 0.9 N m s at the begin, where sunlight adds 0.0025 N m per rad of elevation: at 0.2 rad 0.5 N m s a downlink.
    fn target_x(separations_rad: [f64; 4], horizon: u32) -> f64 {
        let manager = Manager {
            strategy: Strategy::Predictive,
            targeting: Targeting {
                axes: TargetAxes::Xz,
                method: TargetingMethod::Exact,
                azimuth_limit_rad: 0.2,
                elevation_limit_rad: 0.2,
            },
            target_body_n_m_s: Vector3::zeros(),
            horizon,
            sunshade: None,
        };
        let torque = |sun_body: &Vector3<f64>| {
            let SunAngles { azimuth_rad, elevation_rad } = SunAngles::of(sun_body);
            Vector3::new(0.0025 * elevation_rad, 0.0, 0.0025 * azimuth_rad)
        };
        let aim = DownlinkState {
            to_sun: Vector3::x(),
            to_earth: Vector3::new(separations_rad[0].cos(), separations_rad[0].sin(), 0.0),
            momentum: StartMomentum::Body(Vector3::new(0.9, 0.0, 0.0)),
            span_s: DOWNLINK_S,
            torque_body_n_m: &torque,
            pressure_pa: PRESSURE_PA,
            linear: None,
            science: None,
        };
        let Ok(ahead) = manager.ahead(&mut ByHand { separations_rad, begins_in_science: false });
        let Some(Prediction::Components(components)) = ahead else { panic!("no forecast") };
        manager.kept(&aim, &components).unwrap().x
    }

    #[test]
    fn a_conjunction_to_come_is_held_over() {
        // Two sciences of -1 with the downlink between them: from h the momentum passes h - 1, then h - 1 + u, u within 0.5, then
        // h - 2 + u. Above -3 and below 3: 1.5 - 3 <= h <= 3, the middle 0.75. In conjunction, u = 0: 2 - 3 <= h <= 3.
        assert_relative_eq!(target_x([1.0; 4], 2), 0.75, epsilon = 1e-12);
        assert_relative_eq!(target_x([1.0, 0.0, 1.0, 1.0], 2), 1.0, epsilon = 1e-12);
        // Three sciences, two downlinks: 2 - 3 <= h <= 3 with both, 2.5 - 3 <= h <= 3 with either in conjunction, and with both
        // 3 - 3 <= h <= 3, whose middle 1.5 is out of reach: 0.9 and 0.5 more.
        assert_relative_eq!(target_x([1.0; 4], 3), 1.0, epsilon = 1e-12);
        assert_relative_eq!(target_x([1.0, 0.0, 1.0, 1.0], 3), 1.25, epsilon = 1e-12);
        assert_relative_eq!(target_x([1.0, 1.0, 0.0, 1.0], 3), 1.25, epsilon = 1e-12);
        assert_relative_eq!(target_x([1.0, 0.0, 0.0, 1.0], 3), 1.4, epsilon = 1e-12);
        // Near conjunction the elevation is bounded by the angle between Sun and Earth: 0.04 rad are 0.1 N m s.
        assert_relative_eq!(target_x([1.0, 0.04, 1.0, 1.0], 3), 1.2, epsilon = 1e-12);
    }

    #[test]
    fn science_that_unloads_looks_ahead_over_the_next_downlink() {
        let mut forecast = ByHand { separations_rad: [1.0; 4], begins_in_science: true };
        let Ok(Some(Prediction::Components(components))) = Prediction::of(&mut forecast, 3) else {
            panic!("no forecast")
        };
        assert_eq!(components.present().span_s, SCIENCE_S);
        // What it adds by itself, then nothing before the next downlink, then two sciences of -1.
        assert_relative_eq!(components.present().added[0], -1.0, epsilon = 1e-12);
        let [x, _] = components.cycles(|downlink| [[-downlink.span_s, downlink.span_s]; 2]);
        let changes: Vec<f64> = x.iter().take(3).map(|cycle| cycle.swing.change).collect();
        assert_relative_eq!(changes.as_slice(), [0.0, -1.0, -1.0].as_slice(), epsilon = 1e-12);
        assert_eq!([x[0].reach, x[1].reach, x[2].reach], [[-1000.0, 1000.0], [-1000.0, 1000.0], [0.0; 2]]);
    }
}
