//! Direction of the Sun during a downlink that brings components of momentum to a target (paper 000, eqs 14 to 22).
//!
//! Equation: C(A, E) H + span T(A, E) = target on the targeted axes, C the downlink attitude with the Sun at azimuth A and
//! elevation E, T the whole torque of sunlight there; with momentum by the body integral, H + span T(A, E) = target. With one
//! axis the other angle stays 0, or as near to it as the antennas allow. In science that unloads the attitude turns about the Sun
//! line: C(end) (H + sum of w C_k^T T(A, E)) = target ([`crate::guidance::ScienceArc`]), and the zone alone bounds the place. The
//! linear method takes H in the default attitude and
//! the shade's torque to first order in the angles (eq 17).
//! Method: Newton with central differences on both sides of the Sun and for both antennas; for one axis a bracketed root. Where
//! no admissible place reaches the target, the one that comes nearest to it in momentum, by golden section search.
//! Error measure: none at run time; the equation holds to rounding where a root is found.

use nalgebra::Vector3;

use super::admissible::{Branch, Branches, KeepInLimits};
use super::linear::LinearTorque;
use super::searches::{golden, newton};
use crate::attitude::{MovingUnit, SunAngles, angle_between_rad, direction_from_angles};
use crate::enumeration::enumeration;
use crate::guidance::pointing::antenna::Antennas;
use crate::guidance::{
    DownlinkSunDirection, LinesOfSight, ScienceArc, SelectedSunDirection, downlink_toward, sun_pointing,
};
use crate::math;
use crate::momentum::Convention;
use crate::numerics::roots;
use crate::plant::StartMomentum;

enumeration! {
    /// Components of momentum that sunlight is to bring to a target.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum TargetAxes {
        /// X, by the Sun's elevation; its azimuth stays 0 as far as the antennas allow.
        1 => X,
        /// Z, by the Sun's azimuth; its elevation stays 0.
        2 => Z,
        /// Both.
        #[default]
        3 => Xz,
    }
}

impl TargetAxes {
    /// Whether X and Z are targeted.
    pub fn requested(self) -> [bool; 2] {
        [self != Self::Z, self != Self::X]
    }
}

enumeration! {
    /// How the Sun's place is computed.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum TargetingMethod {
        /// The whole torque of direct sunlight, panels included, and the turn of the momentum with the attitude.
        #[default]
        1 => Exact,
        /// Paper 000's eq 17: the sunshade alone, to first order in the angles; up to 8 % short.
        2 => Linear,
    }
}

/// Settings of targeting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Targeting<'a> {
    /// Components with a target.
    pub axes: TargetAxes,
    /// Formula.
    pub method: TargetingMethod,
    /// Limits of the Sun's place.
    pub limits: KeepInLimits,
    /// Antennas; one of them keeps the Earth in its range.
    pub antennas: &'a Antennas,
}

/// State at the start of a downlink, or of science that unloads, with the torque of its light.
pub struct DownlinkState<'a> {
    /// Unit vector to the Sun, EME2000.
    pub to_sun: Vector3<f64>,
    /// Unit vector to the Earth, EME2000.
    pub to_earth: Vector3<f64>,
    /// Momentum at the start.
    pub momentum: StartMomentum,
    /// Least and greatest angle between Sun and Earth while it lasts, in rad.
    pub separations_rad: [f64; 2],
    /// How long light as at the start acts, in s.
    pub span_s: f64,
    /// Torque of sunlight in N m, body frame, with the Sun in this direction of the body frame.
    pub torque_body_n_m: &'a dyn Fn(&Vector3<f64>) -> Vector3<f64>,
    /// Pressure of that sunlight, in Pa.
    pub pressure_pa: f64,
    /// The shade's linear formula; absent without a shade.
    pub linear: Option<LinearTorque>,
    /// The science that begins; `None`: a downlink does.
    pub science: Option<ScienceUnload<'a>>,
}

/// Science that unloads.
#[derive(Clone, Copy, Debug)]
pub struct ScienceUnload<'a> {
    /// Positions and light through the science.
    pub arc: &'a ScienceArc,
    /// Whether the body turns under the momentum.
    pub convention: Convention,
}

/// A residual below this fraction of momentum and target, and of 1 N m s, counts as rounding.
const ROUNDING: f64 = 1e-13;
/// Intervals looked through for a root.
const INTERVALS: usize = 16;

impl Targeting<'_> {
    /// The place of the Sun for `target_body_n_m_s` at the downlink's end; `None` where Sun and Earth give no downlink attitude, or no
    /// place is admissible.
    pub fn sun_direction(
        &self,
        state: &DownlinkState<'_>,
        target_body_n_m_s: &Vector3<f64>,
    ) -> Option<SelectedSunDirection> {
        let (zone, sides);
        let branches: &[Option<Branch>] = if state.science.is_some() {
            zone = [Some(self.zone())];
            &zone
        } else {
            sides = self.branches(state.separation_rad())?.map(|it| Some(it?.lasting(state.separations_rad)));
            &sides
        };
        let aim = MomentumAim { axes: self.axes, state, target: target_body_n_m_s };
        match self.method {
            TargetingMethod::Exact => aim.exact(branches),
            TargetingMethod::Linear => aim.linear(branches),
        }
    }

    /// Least and greatest torque of sunlight about X and Z in N m through what begins, the other angle at 0: in a downlink with Sun
    /// and Earth this far apart at both ends where an antenna can stay with it, else as they are at the begin.
    pub fn present_torques(
        &self,
        state: &DownlinkState<'_>,
        separations_rad: Option<[f64; 2]>,
    ) -> Option<[[f64; 2]; 2]> {
        if state.science.is_some() {
            return Self::torques_on(state, &self.zone());
        }
        let lasting = separations_rad.and_then(|it| self.torques(state, it));
        lasting.or_else(|| self.torques(state, [state.separation_rad(); 2]))
    }

    /// Least and greatest torque of sunlight about X and Z in N m, the other angle at 0, in a downlink that begins and ends with Sun
    /// and Earth this far apart; `None` where one of them has no direction, or the antenna cannot stay with the Earth.
    pub fn torques(
        &self,
        state: &DownlinkState<'_>,
        [begin_rad, end_rad]: [f64; 2],
    ) -> Option<[[f64; 2]; 2]> {
        let first = self.branches(begin_rad)?[0]?;
        let branch = first.lasting([begin_rad.min(end_rad), begin_rad.max(end_rad)]);
        Self::torques_on(state, &branch)
    }

    fn torques_on(state: &DownlinkState<'_>, branch: &Branch) -> Option<[[f64; 2]; 2]> {
        let torque = |elevation_rad: f64, azimuth_rad: f64| {
            let sun_body = direction_from_angles(SunAngles { azimuth_rad, elevation_rad });
            (state.torque_body_n_m)(&sun_body)
        };
        let sorted = |a: f64, b: f64| [a.min(b), a.max(b)];
        let most_rad = branch.elevation_rad();
        let [low_rad, high_rad] = branch.azimuths_rad(0.0)?;
        Some([
            sorted(torque(-most_rad, 0.0).x, torque(most_rad, 0.0).x),
            sorted(torque(0.0, low_rad).z, torque(0.0, high_rad).z),
        ])
    }

    /// Momentum at the start in the default attitude, body frame, in N m s.
    pub fn default_momentum(&self, state: &DownlinkState<'_>) -> Option<Vector3<f64>> {
        let first = match state.science {
            Some(_) => self.zone(),
            None => self.branches(state.separation_rad())?[0]?,
        };
        let place = first.nearest(SunAngles::default())?;
        Some(state.momentum_body_n_m_s(&place))
    }

    fn branches(&self, separation_rad: f64) -> Option<Branches> {
        // Neither places nor separation is known where one has no direction.
        let has_plane = math::sin(separation_rad) > 1e-9;
        has_plane.then(|| Branch::all(self.limits, self.antennas, separation_rad))
    }

    fn zone(&self) -> Branch {
        Branch::zone(self.limits)
    }
}

/// The momentum that a Sun place is to bring about.
struct MomentumAim<'a> {
    axes: TargetAxes,
    state: &'a DownlinkState<'a>,
    target: &'a Vector3<f64>,
}

impl MomentumAim<'_> {
    fn exact(&self, branches: &[Option<Branch>]) -> Option<SelectedSunDirection> {
        let tolerance = ROUNDING * (1.0 + self.state.momentum.magnitude_n_m_s() + self.target.norm());
        let mut best: Option<(f64, SelectedSunDirection)> = None;
        for branch in branches.iter().flatten() {
            let found = match self.axes {
                TargetAxes::Xz => self.both(branch, tolerance),
                TargetAxes::X | TargetAxes::Z => self.one(branch),
            };
            let Some((place, left)) = found else { continue };
            let is_reached = left <= 10.0 * tolerance;
            if is_reached {
                return Some(SelectedSunDirection { place, clamped: false });
            }
            if best.is_none_or(|(least, _)| left < least - tolerance) {
                best = Some((left, SelectedSunDirection { place, clamped: true }));
            }
        }
        best.map(|(_, targeted)| targeted)
    }

    /// The place for both axes on one branch, and what is left of the target.
    fn both(&self, branch: &Branch, tolerance: f64) -> Option<(DownlinkSunDirection, f64)> {
        let left = |azimuth_rad: f64, elevation_rad: f64| {
            let angles = SunAngles { azimuth_rad, elevation_rad };
            self.state
                .left(&DownlinkSunDirection { angles, earth_ahead: branch.earth_ahead }, self.target)
                .xz()
        };
        let start = branch.nearest(SunAngles::default())?.angles;
        if let Some(angles) = newton(start, left, tolerance)
            && let Some(place) = branch.place(angles)
        {
            return Some((place, left(place.angles.azimuth_rad, place.angles.elevation_rad).norm()));
        }
        let along_azimuth = |elevation_rad: f64| {
            let [low_rad, high_rad] = branch.azimuths_rad(elevation_rad)?;
            Some(golden(low_rad, high_rad, |azimuth_rad| left(azimuth_rad, elevation_rad).norm()))
        };
        let most_rad = branch.elevation_rad();
        let (elevation_rad, least) = golden(-most_rad, most_rad, |elevation_rad| {
            along_azimuth(elevation_rad).map_or(f64::INFINITY, |(_, least)| least)
        });
        let (azimuth_rad, _) = along_azimuth(elevation_rad)?;
        Some((branch.nearest(SunAngles { azimuth_rad, elevation_rad })?, least))
    }

    /// The same for one axis, the other angle at 0 as far as that is admissible.
    fn one(&self, branch: &Branch) -> Option<(DownlinkSunDirection, f64)> {
        let by_elevation = self.axes == TargetAxes::X;
        let angles = |angle_rad: f64| {
            if by_elevation {
                SunAngles { azimuth_rad: 0.0, elevation_rad: angle_rad }
            } else {
                SunAngles { azimuth_rad: angle_rad, elevation_rad: 0.0 }
            }
        };
        let [low_rad, high_rad] = if by_elevation {
            [-branch.elevation_rad(), branch.elevation_rad()]
        } else {
            branch.azimuths_rad(0.0)?
        };
        let left = |angle_rad: f64| {
            branch.nearest(angles(angle_rad)).map_or(f64::NAN, |place| {
                let left = self.state.left(&place, self.target);
                if by_elevation { left.x } else { left.z }
            })
        };
        let at = |k: usize| low_rad + (high_rad - low_rad) * k as f64 / INTERVALS as f64;
        let roots = (0..INTERVALS).filter_map(|k| {
            let (from, to) = (at(k), at(k + 1));
            let changes_sign = left(from) * left(to) <= 0.0;
            changes_sign.then(|| roots::bracketed(from, to, left)).flatten()
        });
        let nearest = roots.min_by(|a, b| a.abs().total_cmp(&b.abs()));
        let angle_rad = nearest.unwrap_or_else(|| {
            let misses = (0..=INTERVALS).map(|k| (at(k), left(at(k)).abs()));
            let best = misses.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0.0, |(angle_rad, _)| angle_rad);
            let step_rad = (high_rad - low_rad) / INTERVALS as f64;
            let (from, to) = ((best - step_rad).max(low_rad), (best + step_rad).min(high_rad));
            golden(from, to, |angle_rad| left(angle_rad).abs()).0
        });
        let place = branch.nearest(angles(angle_rad))?;
        let left = left(angle_rad).abs();
        left.is_finite().then_some((place, left))
    }

    fn linear(&self, branches: &[Option<Branch>]) -> Option<SelectedSunDirection> {
        let linear = self.state.linear.as_ref()?;
        let start = branches.iter().flatten().find_map(|branch| branch.nearest(SunAngles::default()))?;
        let [by_x, by_z] = self.axes.requested();
        let mut change = self.target - self.state.momentum_body_n_m_s(&start);
        change.y = 0.0;
        for (component, is_targeted) in [(0, by_x), (2, by_z)] {
            if !is_targeted {
                change[component] = 0.0;
            }
        }
        let solution = linear.sun_angles(&(change / self.state.span_s), self.state.pressure_pa, [by_x, by_z]);
        let requested = solution.unwrap_or_default();
        let distance_rad = |place: &DownlinkSunDirection| {
            let to = direction_from_angles(place.angles);
            angle_between_rad(&to, &direction_from_angles(requested))
        };
        let places = branches.iter().flatten().filter_map(|branch| branch.nearest(requested));
        let nearest = |best: DownlinkSunDirection, next: DownlinkSunDirection| {
            if distance_rad(&next) < distance_rad(&best) - ROUNDING { next } else { best }
        };
        let place = places.reduce(nearest)?;
        let clamped = solution.is_none() || distance_rad(&place) > 1e-9;
        Some(SelectedSunDirection { place, clamped })
    }
}

impl DownlinkState<'_> {
    /// Angle between Sun and Earth, in rad.
    pub fn separation_rad(&self) -> f64 {
        angle_between_rad(&self.to_sun, &self.to_earth)
    }

    /// Momentum at the start in the attitude with the Sun at `place`, body frame, in N m s; of science in its attitude at the end.
    fn momentum_body_n_m_s(&self, place: &DownlinkSunDirection) -> Vector3<f64> {
        if let Some((arc, momentum)) = self.turning(place) {
            return arc.carried_body_n_m_s(place.angles, &momentum);
        }
        match self.momentum {
            StartMomentum::Body(momentum) => momentum,
            StartMomentum::Inertial(momentum) => {
                let still = |direction| MovingUnit { direction, rate_1_s: Vector3::zeros() };
                let (sun, earth) = (still(self.to_sun), still(self.to_earth));
                let lines = LinesOfSight { sun, earth, planet: None, sun_from_planet: None };
                let command = downlink_toward(&lines, place).unwrap_or_else(|| sun_pointing(&lines));
                command.frame.inertial_from_body.inverse() * momentum
            }
        }
    }

    /// Science in which the body turns under the momentum, and that in EME2000 at its start; `None` in any other.
    fn turning(&self, place: &DownlinkSunDirection) -> Option<(&ScienceArc, Vector3<f64>)> {
        let ScienceUnload { arc, convention } = self.science?;
        match (self.momentum, convention) {
            (StartMomentum::Inertial(momentum), _) => Some((arc, momentum)),
            (StartMomentum::Body(momentum), Convention::Inertial) => {
                Some((arc, arc.begin_inertial_n_m_s(place.angles, &momentum)))
            }
            (StartMomentum::Body(_), Convention::BodyIntegral) => None,
        }
    }

    /// Momentum at the end less the target, body frame, in N m s.
    fn left(&self, place: &DownlinkSunDirection, target: &Vector3<f64>) -> Vector3<f64> {
        let torque = (self.torque_body_n_m)(&direction_from_angles(place.angles));
        if let Some((arc, momentum)) = self.turning(place) {
            return arc.end_body_n_m_s(place.angles, &momentum, &torque) - target;
        }
        self.momentum_body_n_m_s(place) + torque * self.span_s - target
    }
}

#[cfg(test)]
mod tests;
