//! Predictive targets of flights that are written by hand.
use approx::assert_relative_eq;
use nalgebra::Rotation3;

use super::super::admissible::KeepInLimits;
use super::super::prediction::Forecast;
use super::super::targeting::{TargetAxes, TargetingMethod};
use super::*;
use crate::momentum::{Convention, DumpPolicy, Reinitialise};

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

    fn terms(&self) -> ForecastTerms {
        ForecastTerms {
            begin_s: 0.0,
            cycle_s: CYCLE_S,
            span_s: if self.begins_in_science { SCIENCE_S } else { DOWNLINK_S },
            begins_in_science: self.begins_in_science,
            downlink_s: DOWNLINK_S,
            convention: Convention::BodyIntegral,
            policy: DumpPolicy {
                threshold_body_n_m_s: Vector3::repeat(3.0),
                reinitialise: Reinitialise::Opposite { fraction: 1.0 },
                bias_body_n_m_s: Vector3::zeros(),
            },
        }
    }

    fn simulated(
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
            limits: KeepInLimits { azimuth_rad: 0.2, elevation_rad: 0.2 },
            antennas: &crate::guidance::pointing::antenna::tests::quadrants(),
        },
        target_body_n_m_s: Vector3::zeros(),
        bias_body_n_m_s: Vector3::zeros(),
        horizon,
        sunshade: None,
    };
    let torque = |sun_body: &Vector3<f64>| {
        let SunAngles { azimuth_rad, elevation_rad } = SunAngles::from_direction(sun_body);
        Vector3::new(0.0025 * elevation_rad, 0.0, 0.0025 * azimuth_rad)
    };
    let state = DownlinkState {
        to_sun: Vector3::x(),
        to_earth: Vector3::new(separations_rad[0].cos(), separations_rad[0].sin(), 0.0),
        separations_rad: [separations_rad[0]; 2],
        momentum: StartMomentum::Body(Vector3::new(0.9, 0.0, 0.0)),
        span_s: DOWNLINK_S,
        torque_body_n_m: &torque,
        pressure_pa: PRESSURE_PA,
        linear: None,
        science: None,
    };
    let Ok(prediction) = manager.predict(&mut ByHand { separations_rad, begins_in_science: false });
    let Some(Prediction::Components(components)) = prediction else { panic!("no forecast") };
    manager.kept(&state, &components).unwrap().x
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
    let Ok(Some(Prediction::Components(components))) = Prediction::new(&mut forecast, 3) else {
        panic!("no forecast")
    };
    assert_eq!(components.downlinks[0].span_s, SCIENCE_S);
    // What it adds by itself, then nothing before the next downlink, then two sciences of -1.
    assert_relative_eq!(components.downlinks[0].added[0], -1.0, epsilon = 1e-12);
    let [x, _] = components.cycles(|downlink| [[-downlink.span_s, downlink.span_s]; 2]);
    let changes: Vec<f64> = x.iter().take(3).map(|cycle| cycle.excursion.change).collect();
    assert_relative_eq!(changes.as_slice(), [0.0, -1.0, -1.0].as_slice(), epsilon = 1e-12);
    assert_eq!(
        [x[0].authority, x[1].authority, x[2].authority],
        [[-1000.0, 1000.0], [-1000.0, 1000.0], [0.0; 2]]
    );
}
