//! The centre of a spacecraft's orbit, and the parameters' defaults that follow from it.

use fmi_export::SetupError;
use physics::bodies::air::ExponentialAir;
use physics::bodies::surface::{MERCURY, PlanetSurface};
use physics::bodies::{Body, BodyData};
use physics::enumeration::Enumerated;
use physics::environment::frames::Frame;
use physics::environment::kepler_planet::{KeplerPlanet, MERCURY_AS_PRINTED, MESSENGER_AS_PRINTED};
use physics::environment::orbit::{self, Elements};
use physics::spacecraft::{Spacecraft, StartEntry, StartValue};

use super::choices::OrbitCenter;
use super::start_values::{entry_of, item};

/// The model whose orbit it is.
const PLANT: &str = "MomentumPlant";

/// Longest and shortest semi-major axis of a planet's ellipse in `ephemeris.*`, in m, and its greatest eccentricity.
const ELLIPSES: ([f64; 2], f64) = ([1e9, 1e13], 0.99);

/// A body with what a spacecraft's file gives of it.
#[derive(Clone, Copy, Debug)]
pub struct CenterBody {
    /// Gravity, figure, rotation and surface of the body.
    pub data: BodyData,
    /// Radii of its ellipsoid, in m.
    pub radii_m: [f64; 3],
    /// Orbit about the Sun of the file's own body, if that is this one and the file gives an orbit.
    pub motion: Option<KeplerPlanet>,
}

/// The centre by the start value of `orbit.center` in the spacecraft's file; without one the file's own body, or Mercury.
pub(crate) fn center_of(spacecraft: &Spacecraft) -> Body {
    let own = if spacecraft.body.is_some() { Body::Custom } else { Body::Mercury };
    of_entry(entry_of(&spacecraft.start, PLANT, "orbit.center")).unwrap_or(own)
}

/// The planet that is observed: that of `target.planet` in the file, else the centre.
pub(crate) fn target_of(spacecraft: &Spacecraft, model: &str) -> Body {
    let target = of_entry(entry_of(&spacecraft.start, model, "target.planet"));
    target.unwrap_or_else(|| center_of(spacecraft))
}

fn of_entry(entry: Option<&StartEntry>) -> Option<Body> {
    match &entry?.value {
        StartValue::Text(name) => Body::ITEMS.iter().find(|item| item.name == name).map(|item| item.variant),
        value => item::<OrbitCenter>(value).map(|it| it.0),
    }
}

/// All bodies with what a spacecraft's file gives of one.
#[derive(Clone, Copy, Debug)]
pub struct CenterBodies {
    custom: Option<CenterBody>,
}

impl CenterBodies {
    /// The bodies of a spacecraft's file.
    ///
    /// # Errors
    /// A body in the file that is on no orbit about the Sun.
    pub fn new(file: &str, spacecraft: &Spacecraft) -> Result<Self, SetupError> {
        let Some(custom) = &spacecraft.body else { return Ok(Self { custom: None }) };
        let motion = custom.motion.as_ref().map(KeplerPlanet::of_body).transpose();
        let motion = motion.map_err(|error| SetupError(format!("{file}: body: {error}")))?;
        Ok(Self { custom: Some(CenterBody { data: custom.data(), radii_m: custom.radii_m, motion }) })
    }

    /// One of them.
    pub fn body(&self, body: Body) -> CenterBody {
        self.custom.filter(|_| body == Body::Custom).unwrap_or_else(|| {
            let data = *body.data();
            CenterBody { data, radii_m: [data.radius_m; 3], motion: None }
        })
    }
}

impl CenterBody {
    /// Elements of an orbit to begin with: about Mercury paper 004's Table 3 with a period of 12 h, about another planet a circle
    /// of three radii over the poles, about the Sun one of 1 AU.
    pub fn elements(&self) -> Elements {
        match self.data.body {
            // 12 h by Kepler's third law.
            Body::Mercury => Elements {
                semi_major_axis_m: orbit::semi_major_axis_m(self.data.gm_m3_s2, 43_200.0),
                true_anomaly_rad: 0.0,
                ..MESSENGER_AS_PRINTED
            },
            _ => Elements::simple_about(&self.data),
        }
    }

    /// The frame of those elements: the ecliptic about the Sun, the equator about a planet.
    pub const fn frame(&self) -> Frame {
        if self.data.body.is_planet() { Frame::PlanetEquator } else { Frame::Ecliptic }
    }

    /// Its air by the exponential model; without density where none is known.
    pub fn air(&self) -> ExponentialAir {
        self.data.atmosphere.unwrap_or(ExponentialAir::NONE)
    }

    /// The surface; Mercury's, at the body's radius, where there is none.
    pub fn surface(&self) -> PlanetSurface {
        PlanetSurface { radius_m: self.data.radius_m, ..self.data.surface.unwrap_or(MERCURY) }
    }

    /// The planet's ellipse about the Sun: Mercury's by paper 004's Table 4, the file's own body's by the file, else the mean one
    /// at J2000 from perihelion. The Sun, for which none counts, and a body that is on none have the Earth's.
    pub fn ellipse(&self) -> Elements {
        let ([least_m, most_m], most) = ELLIPSES;
        let is_ellipse =
            |it: &&Elements| (least_m..=most_m).contains(&it.semi_major_axis_m) && it.eccentricity <= most;
        match self.data.body {
            Body::Mercury => MERCURY_AS_PRINTED,
            Body::Sun => Elements::mean_orbit_of(Body::Earth.data()),
            Body::Custom => {
                let own = self.motion.as_ref().map(KeplerPlanet::elements).filter(is_ellipse);
                own.copied().unwrap_or_else(|| Elements::mean_orbit_of(Body::Earth.data()))
            }
            planet => Elements::mean_orbit_of(planet.data()),
        }
    }
}
