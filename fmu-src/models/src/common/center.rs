//! What a spacecraft flies about, and the parameters' defaults that follow from it.

use physics::bodies::Body;
use physics::bodies::surface::{MERCURY, PlanetSurface};
use physics::environment::frames::Frame;
use physics::environment::kepler_planet::{MERCURY_AS_PRINTED, MESSENGER_AS_PRINTED};
use physics::environment::orbit::{self, Elements};
use physics::spacecraft::{Spacecraft, StartEntry};

use super::choices::OrbitCenter;
use super::start_values::{entry_of, item};

/// The model whose orbit it is.
const PLANT: &str = "MomentumPlant";

/// The centre by the start value of `orbit.center` in the spacecraft's file; Mercury without one.
pub fn center_of(spacecraft: &Spacecraft) -> Body {
    of_entry(entry_of(&spacecraft.start, PLANT, "orbit.center")).unwrap_or(Body::Mercury)
}

/// The planet that is observed: that of `target.planet` in the file, else the centre.
pub fn target_of(spacecraft: &Spacecraft, model: &str) -> Body {
    let target = of_entry(entry_of(&spacecraft.start, model, "target.planet"));
    target.unwrap_or_else(|| center_of(spacecraft))
}

fn of_entry(entry: Option<&StartEntry>) -> Option<Body> {
    entry.and_then(|entry| item::<OrbitCenter>(&entry.value)).map(|it| it.0)
}

/// Elements of an orbit to begin with: about Mercury paper 004's Table 3 with a period of 12 h, about another planet a circle
/// of three radii over the poles, about the Sun one of 1 AU.
pub fn elements(center: Body) -> Elements {
    match center {
        // 12 h by Kepler's third law.
        Body::Mercury => Elements {
            semi_major_axis_m: orbit::semi_major_axis_m(center.data().gm_m3_s2, 43_200.0),
            true_anomaly_rad: 0.0,
            ..MESSENGER_AS_PRINTED
        },
        other => Elements::simple_about(other),
    }
}

/// The frame of those elements: the ecliptic about the Sun, the equator about a planet.
pub const fn frame(center: Body) -> Frame {
    if center.is_planet() { Frame::PlanetEquator } else { Frame::Ecliptic }
}

/// The surface; Mercury's, at the body's radius, where there is none.
pub fn surface(center: Body) -> PlanetSurface {
    let data = center.data();
    PlanetSurface { radius_m: data.radius_m, ..data.surface.unwrap_or(MERCURY) }
}

/// The planet's ellipse about the Sun: Mercury's by paper 004's Table 4, else the mean one at J2000 from perihelion. The Sun, for
/// which none counts, has the Earth's.
pub fn ellipse(center: Body) -> Elements {
    match center {
        Body::Mercury => MERCURY_AS_PRINTED,
        Body::Sun => Elements::mean_orbit_of(Body::Earth.data()),
        planet => Elements::mean_orbit_of(planet.data()),
    }
}
