//! Source of the ephemerides, from parameters and inputs; refuses what cannot be simulated, by name.

use fmi_export::Failure;
use nalgebra::Vector3;
use physics::bodies::Body;
use physics::environment::CartesianState;
use physics::plant;

use super::n_body;
use crate::common::center::CenterBody;
use crate::common::ephemeris::{self, NamedEpoch};
use crate::momentum_plant::setup::Read;
use crate::momentum_plant::variables::choices::EphemerisSource;

/// Reads the source of the positions of Sun, Earth and planets.
pub(super) fn read(read: Read<'_>, center: Body, waiting: bool) -> Result<plant::EphemerisSource, Failure> {
    let (variables, center) = (read.variables, &read.setup.bodies.body(center));
    let epoch_s = read.real(variables.start.epoch);
    Ok(match read.choice(variables.ephemeris_source) {
        EphemerisSource::Inputs => {
            let sun_m = read.vector(variables.sun.position);
            let at_the_planet = center.data.body.is_planet() && sun_m == Vector3::from([0.0; 3]);
            if at_the_planet && !waiting {
                return Err(Failure::new(
                    "sun.position is not set: found (0, 0, 0) m, allowed: the Sun's position from the orbit's centre, which \
                     ephemeris.source = inputs asks for",
                ));
            }
            let given = |position, velocity| CartesianState {
                position_m: read.vector(position),
                velocity_m_s: read.vector(velocity),
            };
            plant::EphemerisSource::Given {
                sun: given(variables.sun.position, variables.sun.velocity),
                earth: given(variables.earth.position, variables.earth.velocity),
            }
        }
        EphemerisSource::Kepler => {
            let ellipse = &variables.ephemeris;
            plant::EphemerisSource::Kepler(ellipse.planet(read, center, epoch_s)?)
        }
        EphemerisSource::Chebyshev => match ephemeris::precise(read.setup.ephemeris.as_ref()) {
            Some(carried) => {
                n_body::check_onboard(read, carried, NamedEpoch { name: "start.epoch", epoch_s })?;
                plant::EphemerisSource::Simulated(carried.clone())
            }
            None => without_table(center, "chebyshev")?,
        },
        EphemerisSource::Vsop87 => without_table(center, "vsop87")?,
    })
}

/// VSOP87, or the orbit of the body of the spacecraft's file.
fn without_table(center: &CenterBody, source: &str) -> Result<plant::EphemerisSource, Failure> {
    if center.data.body != Body::Custom {
        return Ok(plant::EphemerisSource::Vsop87);
    }
    ephemeris::custom(center, source).map(plant::EphemerisSource::Kepler)
}
