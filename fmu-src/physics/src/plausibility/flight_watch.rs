//! Warnings of a flight under way, each told once: forces on an orbit in closed form, bodies before the Sun, panels
//! that do not come to where they are to stand.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::environment::time;
use crate::loads::Effect;
use crate::plant::{Configuration, Evaluation, Flight, Motion};
use crate::spacecraft::Spacecraft;
use crate::toml::dates;

/// Greatest force over gravity of a spacecraft that a closed orbit describes.
const FORCE_OVER_GRAVITY: f64 = 1e-4;
/// Difference of light, as a share of the Sun's at normal incidence, from which a panel off its angle is told of: a comsat's
/// arrays stay below it at the solstice.
const LIGHT_OFF: f64 = 0.1;
/// Rounding of an angle, in rad.
const ROUNDING_RAD: f64 = 1e-6;
/// Time between two looks at the forces, in s, which change along an orbit.
const LOOK_EVERY_S: f64 = 600.0;
/// Panels whose warnings are remembered, one bit each.
const PANELS: usize = 64;

/// Warnings that were told already.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FlightWatch {
    force: bool,
    occultation: bool,
    panels: u64,
    /// Time of the next look at forces, in s.
    force_from_s: Option<f64>,
    /// Time of the next look at what may hide the Sun, in s.
    quiet_until_s: Option<f64>,
}

/// Whether a time in s lies before another, if there is one.
fn is_before(time_s: f64, from_s: Option<f64>) -> bool {
    from_s.is_some_and(|from_s| time_s < from_s)
}

/// Whether a panel stands at the angle from the Sun, both in rad, at which it is to stand.
pub fn is_sun_offset_reached([meant_rad, actual_rad]: [f64; 2]) -> bool {
    (meant_rad - actual_rad).abs() <= ROUNDING_RAD
}

impl FlightWatch {
    /// Whether [`Self::see`] reads the loads at `time_s`.
    pub fn looks_at_forces(&self, configuration: Option<&Configuration>, time_s: f64) -> bool {
        let is_closed_orbit = configuration.is_some_and(|it| matches!(it.motion, Motion::TwoBody));
        !self.force && is_closed_orbit && !is_before(time_s, self.force_from_s)
    }

    /// Tells what a flight that was evaluated at `time_s` shows for the first time.
    pub fn see(
        &mut self,
        (flight, time_s): (&mut Flight, f64),
        spacecraft: &Spacecraft,
        mut tell: impl FnMut(&str),
    ) {
        let Some((configuration, evaluation)) = flight.configuration().zip(flight.evaluation()) else {
            return;
        };
        if self.looks_at_forces(Some(configuration), time_s) {
            self.force_from_s = Some(time_s + LOOK_EVERY_S);
            let mu_m3_s2 = configuration.orbit.mu_m3_s2();
            if let Some(text) = force_over_gravity(evaluation, mu_m3_s2) {
                self.force = true;
                tell(&text);
            }
        }
        let sun = evaluation.instant.sun();
        let panels = spacecraft.panels.iter().zip(&configuration.panels).take(PANELS);
        for (k, (panel, setting)) in panels.enumerate() {
            let bit = 1_u64 << k;
            if self.panels & bit == 0 && setting.light_out_of_reach(panel, &sun).abs() > LIGHT_OFF {
                let Some(angle_rad) = setting.angle_rad(panel, &sun) else { continue };
                let [meant_rad, actual_rad] = setting.sun_offsets_rad(&panel.normal_body(angle_rad), &sun);
                self.panels |= bit;
                let [meant_deg, actual_deg] =
                    [meant_rad, actual_rad].map(|it| format!("{:.1}", it.to_degrees()));
                tell(&format!(
                    "panel[{}].sunOffset of {meant_deg} deg is out of reach at {time_s} s: turned about its axis `{}` comes to \
                     {actual_deg} deg from the Sun; see panel[k].sunOffsetActual, and choose guided.scienceRule or the axis so that the \
                     Sun stands across it",
                    k + 1,
                    panel.name
                ));
            }
        }
        let epoch_s = time::epoch_at_s(time_s, configuration.epoch_minus_time_s);
        if self.occultation || is_before(time_s, self.quiet_until_s) {
            return;
        }
        if let Some(found) = flight.occultation(time_s, &mut self.quiet_until_s) {
            self.occultation = true;
            tell(&format!(
                "{} stands before the Sun on {} and hides {:.1} % of its disc: no eclipse by another body than that of planet.* is \
                 simulated; sun.litFraction and torque.solar leave it out",
                found.name,
                dates::utc(epoch_s),
                100.0 * found.share
            ));
        }
    }
}

/// A sentence where light or air is more than a small part of the gravity in the centre's field.
fn force_over_gravity(evaluation: &Evaluation, mu_m3_s2: f64) -> Option<String> {
    let distance_m = evaluation.instant.geometry.spacecraft.position_m.norm();
    let gravity_n = evaluation.mass.mass_kg * mu_m3_s2 / (distance_m * distance_m);
    let of = |name, is_of: fn(Effect) -> bool| {
        let all = Effect::ALL.into_iter().filter(|effect| is_of(*effect));
        (name, all.map(|effect| evaluation.loads[effect].force_body_n).sum::<Vector3<f64>>().norm())
    };
    let groups = [of("light", Effect::is_light), of("air", |effect| effect == Effect::Aerodynamic)];
    let (name, force_n) = groups.into_iter().max_by(|one, other| one.1.total_cmp(&other.1))?;
    let share = force_n / gravity_n;
    (distance_m > 0.0 && share > FORCE_OVER_GRAVITY).then(|| {
        format!(
            "the force of {name} is {share:.1e} of the gravity, and orbit.dynamics is twoBody, an orbit in closed form that nothing \
             else moves: set orbit.dynamics = disturbed"
        )
    })
}
