//! The default downlink, the Sun on -Y: which direction of the body looks at the Earth, by the angle between Sun and Earth.
//!
//! A fan has the Earth at the azimuth -theta or +theta of the XY plane (paper 000, eqs 18 and 20 with A = E = 0), or at the bound of its
//! range; an antenna fixed along an axis has it there. All of it changes at angles that the antennas fix, and is smooth between.
//! Method: bounds of ranges, axes and the middles between two of them, folded into 0 to 180 deg, are all that the choice can change at;
//! it is made once in the middle between neighbours, and equal neighbours are joined.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector3;

use super::sun_direction::is_ahead;
use crate::attitude::angle_between_rad;
use crate::guidance::pointing::antenna::{Antennas, BOUND_RAD};
use crate::math;

/// Direction of the Earth in the body frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EarthBoresight {
    /// In the XY plane at the azimuth -theta.
    Behind,
    /// In the XY plane at +theta.
    Ahead,
    /// Along this unit vector, with -Y as near to the Sun as that allows.
    Fixed(Vector3<f64>),
}

/// Boresight that looks at the Earth, by the angle between Sun and Earth.
#[derive(Clone, Debug, PartialEq)]
pub struct DefaultDownlink {
    antennas: Antennas,
    first: EarthBoresight,
    /// Cosines of the angles at which the choice changes, with what is chosen beyond; they fall.
    changes: Vec<(f64, EarthBoresight)>,
}

impl Default for DefaultDownlink {
    fn default() -> Self {
        Self::new(&Antennas::default())
    }
}

impl DefaultDownlink {
    /// With these antennas; without one, as with fans all round.
    pub fn new(antennas: &Antennas) -> Self {
        let mut all = Self { antennas: antennas.clone(), first: EarthBoresight::Behind, changes: Vec::new() };
        let mut last = None;
        for pair in candidates_rad(antennas).windows(2) {
            let (Some(from_rad), Some(to_rad)) = (pair.first(), pair.last()) else { continue };
            if to_rad - from_rad < 1e-9 {
                continue;
            }
            let chosen = chosen(antennas, 0.5 * (from_rad + to_rad));
            if last.is_none() {
                all.first = chosen;
            } else if last != Some(chosen) {
                let cosine =
                    if (from_rad - FRAC_PI_2).abs() < BOUND_RAD { 0.0 } else { math::cos(*from_rad) };
                all.changes.push((cosine, chosen));
            }
            last = Some(chosen);
        }
        all
    }

    /// The antennas.
    pub fn antennas(&self) -> &Antennas {
        &self.antennas
    }

    /// Direction of the Earth at this cosine of the angle between Sun and Earth.
    pub fn boresight(&self, cosine: f64) -> EarthBoresight {
        let passed = self.changes.iter().take_while(|(at, _)| cosine <= *at).last();
        passed.map_or(self.first, |(_, chosen)| *chosen)
    }

    /// A smooth function of the cosine with a root at every change; infinite without one.
    pub fn margin(&self, cosine: f64) -> f64 {
        let margins = self.changes.iter().map(|(at, _)| cosine - at);
        margins.reduce(|product, margin| product * margin).unwrap_or(f64::INFINITY)
    }

    /// Whether the Sun moves in the body while the antenna looks at the Earth, at some angle between both.
    pub fn moves_the_sun(&self) -> bool {
        let mut all = [&self.first].into_iter().chain(self.changes.iter().map(|(_, chosen)| chosen));
        all.any(|chosen| matches!(chosen, EarthBoresight::Fixed(_)))
    }
}

/// Boresight that looks at the Earth at an angle between Sun and Earth, in rad.
fn chosen(antennas: &Antennas, separation_rad: f64) -> EarthBoresight {
    let azimuths_rad = [-separation_rad, separation_rad];
    let ahead = is_ahead(antennas, azimuths_rad, math::cos(separation_rad));
    let fan = antennas.nearest_fan(azimuths_rad[usize::from(ahead)]);
    match antennas.nearest_axis(&fan, &-Vector3::y(), separation_rad) {
        Some((_, axis_body)) => EarthBoresight::Fixed(axis_body),
        None if fan.antenna.is_some() && !fan.is_in_range() => EarthBoresight::Fixed(fan.direction_body()),
        None if ahead => EarthBoresight::Ahead,
        None => EarthBoresight::Behind,
    }
}

/// Angles between Sun and Earth at which the choice can change, in rad, sorted; 0 and 180 deg are among them.
fn candidates_rad(antennas: &Antennas) -> Vec<f64> {
    let bounds_rad = antennas.fans().flat_map(|(_, fan)| fan.bounds_rad());
    let folded =
        |bound_rad: f64| [-TAU, 0.0, TAU].map(|turn_rad| [turn_rad + bound_rad, turn_rad - bound_rad]);
    let axes_rad = antennas.axes().map(|(_, axis_body)| angle_between_rad(&axis_body, &-Vector3::y()));
    let values_rad: Vec<f64> = bounds_rad.flat_map(folded).flatten().chain(axes_rad).collect();
    let middles_rad = values_rad.iter().flat_map(|a| values_rad.iter().map(move |b| 0.5 * (a + b)));
    let inside = middles_rad.filter(|angle_rad| (0.0..=PI).contains(angle_rad));
    let mut all: Vec<f64> = inside.chain([0.0, FRAC_PI_2, PI]).collect();
    all.sort_by(f64::total_cmp);
    // Values that differ by rounding are one; 90 deg stays exact.
    let same = |next: &mut f64, before: &mut f64| *next != FRAC_PI_2 && (*next - *before).abs() < BOUND_RAD;
    all.dedup_by(same);
    all
}

#[cfg(test)]
mod tests;
