//! Elements of the osculating orbit.

use fmi_export::{Real, Values, Variables};
use physics::plant::OsculatingOrbit;

/// Orbit that has the present position and velocity, about orbit.currentCenter and in the axes of orbit.frame, those of orbit.center.
/// All is 0 while the flight waits and on a line through the body.
#[derive(Variables)]
pub struct OsculatingVariables {
    /// Semi-major axis; negative on a hyperbola.
    #[output(unit = "m", display = "km", nominal = 1e7)]
    pub semi_major_axis: Real,
    /// Eccentricity.
    #[output(unit = "1", nominal = 1.0)]
    pub eccentricity: Real,
    /// Inclination.
    #[output(unit = "rad", display = "deg", nominal = 1.0)]
    pub inclination: Real,
    /// Longitude of the ascending node; 0 with an inclination of 0 or 180 deg, where the argument of periapsis counts from x.
    #[output(unit = "rad", display = "deg", nominal = 1.0)]
    pub ascending_node: Real,
    /// Argument of periapsis; 0 on a circle, where the true anomaly counts from the node.
    #[output(unit = "rad", display = "deg", nominal = 1.0)]
    pub periapsis_argument: Real,
    /// True anomaly, from 0 to 360 deg, on a hyperbola from -180 to 180 deg.
    #[output(unit = "rad", display = "deg", nominal = 1.0)]
    pub true_anomaly: Real,
    /// Angle from the ascending node to the spacecraft, along the motion.
    #[output(unit = "rad", display = "deg", nominal = 1.0)]
    pub argument_of_latitude: Real,
    /// Period; 0 on a hyperbola.
    #[output(unit = "s", display = "h", nominal = 1e4)]
    pub period: Real,
    /// Height of periapsis over the radius of orbit.currentCenter; below 0 on an orbit that meets the surface.
    #[output(unit = "m", display = "km", nominal = 1e6)]
    pub periapsis_height: Real,
    /// Height of apoapsis; 0 on a hyperbola.
    #[output(unit = "m", display = "km", nominal = 1e6)]
    pub apoapsis_height: Real,
}

/// Number of an orbit that an output shows.
type OfOrbit = fn(&OsculatingOrbit) -> f64;

impl OsculatingVariables {
    /// Writes an orbit, or 0 where there is none.
    pub fn write(&self, values: &mut Values, orbit: Option<&OsculatingOrbit>) {
        let outputs: [(Real, OfOrbit); 10] = [
            (self.semi_major_axis, |it| it.elements.semi_major_axis_m),
            (self.eccentricity, |it| it.elements.eccentricity),
            (self.inclination, |it| it.elements.inclination_rad),
            (self.ascending_node, |it| it.elements.ascending_node_rad),
            (self.periapsis_argument, |it| it.elements.periapsis_argument_rad),
            (self.true_anomaly, |it| it.elements.true_anomaly_rad),
            (self.argument_of_latitude, |it| it.elements.argument_of_latitude_rad()),
            (self.period, |it| it.period_s),
            (self.periapsis_height, |it| it.periapsis_height_m),
            (self.apoapsis_height, |it| it.apoapsis_height_m),
        ];
        for (output, of) in outputs {
            values.set_real(output, orbit.map_or(0.0, of));
        }
    }
}
