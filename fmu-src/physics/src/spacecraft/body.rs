//! A body of the user's own, an asteroid, a comet or a moon: what its file says of it.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::part_reader::PartReader;
use crate::bodies::surface::{DayTemperature, PlanetSurface};
use crate::bodies::{Body, BodyData, impossible_density_kg_m3};
use crate::toml::dates::{self, ALLOWED_DATE};
use crate::toml::{
    BodyRadius, Eccentricity, Emissivity, Fraction, GravitationalParameter, HalfTurn, OrbitAxis, Point,
    RotationRate, TurnEither, Written, ZonalHarmonic, tables,
};

/// Temperature of its night side, assumed, in K: as low as that of airless bodies that turn slowly.
const NIGHT_TEMPERATURE_K: f64 = 100.0;

tables! {
/// A body of one's own, an asteroid, a comet or a moon: with it `custom` is an item of `orbit.center` and the default there, and one
/// of `target.planet` and `aimpoint.body`.
struct BodyDescription {
    /// Its name.
    name: String,
    /// Gravitational parameter, in m3/s2.
    gravitational_parameter_m3_s2: GravitationalParameter,
    /// Radii of its ellipsoid along its own x, y and z, in m; shadow and light take their mean.
    radii_m: [BodyRadius; 3],
    /// Second zonal harmonic of its gravity, unnormalised, for the first radius.
    j2: ZonalHarmonic = 0.0,
    /// Right ascension and declination of its north pole in EME2000, in deg.
    pole_deg: [f64; 2] = [0.0, 90.0],
    /// Angle of its prime meridian from the node of its equator on that of EME2000 at J2000, in deg.
    prime_meridian_deg as prime_meridian_rad: TurnEither = 0.0,
    /// Rotation rate about its pole, in rad/s.
    rotation_rate_rad_s: RotationRate = 0.0,
    /// Diffusely reflected fraction of sunlight; the default is assumed.
    albedo: Fraction = 0.1,
    /// Infrared emissivity; the default is assumed.
    emissivity: Emissivity = 0.9,
    elements: Option<BodyElementsDescription>,
    /// Instead of elements, its position from the Sun at `epoch`, in m.
    position_m: Option<Point>,
    /// Its velocity then, in m/s.
    velocity_m_s: Option<Point>,
    /// When elements or state hold, a date such as "2030-01-01 TDB".
    epoch: Option<String>,
    /// Axes of elements or state: the ecliptic unless given.
    frame: Option<InertialFrame>,
} rules {
    Excludes elements => position_m velocity_m_s: "elements beside position_m or velocity_m_s",
        "either `elements`, or `position_m` and `velocity_m_s`";
    Requires epoch => elements position_m velocity_m_s: "no `elements` and no `position_m` beside it",
        "what the body's place about the Sun is at that time";
    Requires frame => epoch elements position_m velocity_m_s: "no `elements` and no `position_m` beside it",
        "what the body's place about the Sun is at that time";
}

/// Its orbit about the Sun. Without it and without a state, inputs or the file of onboard ephemerides say where the body is.
struct BodyElementsDescription makes #[derive(Clone, Copy, Debug, PartialEq, Serialize)] pub struct BodyElements {
    /// Semi-major axis, in m.
    semi_major_axis_m: OrbitAxis,
    /// Eccentricity, at most 0.99.
    eccentricity: Eccentricity,
    /// Inclination, in deg.
    inclination_deg as inclination_rad: HalfTurn,
    /// Longitude of the ascending node, in deg.
    ascending_node_deg as ascending_node_rad: TurnEither,
    /// Argument of periapsis, in deg.
    periapsis_argument_deg as periapsis_argument_rad: TurnEither,
    /// True anomaly at `epoch`, in deg.
    true_anomaly_deg as true_anomaly_rad: TurnEither,
}
}

/// A body that the spacecraft's file describes, `custom` in `orbit.center`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CustomBody {
    /// Its name.
    pub name: String,
    /// Gravitational parameter, in m3/s2.
    pub gm_m3_s2: f64,
    /// Radii of the ellipsoid along its x, y and z, in m.
    pub radii_m: [f64; 3],
    /// Second zonal harmonic, unnormalised, for the radius along x.
    pub j2: f64,
    /// Right ascension and declination of its north pole in EME2000, in rad.
    pub pole_rad: [f64; 2],
    /// Angle of its prime meridian at J2000, in rad.
    pub prime_meridian_rad: f64,
    /// Rotation rate about the pole, in rad/s.
    pub rotation_rate_rad_s: f64,
    /// Diffusely reflected fraction of sunlight.
    pub albedo: f64,
    /// Infrared emissivity.
    pub emissivity: f64,
    /// Its motion about the Sun; `None` where inputs or a table of positions say where it is.
    pub motion: Option<BodyMotion>,
}

/// How it moves about the Sun, undisturbed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BodyMotion {
    /// When it is there, in s past J2000 TDB.
    pub epoch_s: f64,
    /// Axes of elements or state.
    pub frame: InertialFrame,
    /// Elements or state about the Sun.
    pub orbit: BodyOrbit,
}

/// Axes that do not turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase")]
pub enum InertialFrame {
    /// Mean ecliptic and equinox of J2000.
    #[default]
    Ecliptic,
    /// Mean equator and equinox of J2000.
    Eme2000,
}

/// Orbit of the body about the Sun.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum BodyOrbit {
    /// By Keplerian elements.
    Elements(BodyElements),
    /// By a state vector.
    State {
        /// In m.
        position_m: Vector3<f64>,
        /// In m/s.
        velocity_m_s: Vector3<f64>,
    },
}

impl CustomBody {
    /// Its surface: local balance by day; the night's temperature is assumed.
    pub fn surface(&self) -> PlanetSurface {
        PlanetSurface {
            radius_m: self.mean_radius_m(),
            absorptivity: 1.0 - self.albedo,
            diffuse_reflectivity: self.albedo,
            emissivity: self.emissivity,
            night_temperature_k: NIGHT_TEMPERATURE_K,
            day_temperature: DayTemperature::Cosine,
        }
    }

    fn mean_radius_m(&self) -> f64 {
        self.radii_m.iter().sum::<f64>() / 3.0
    }

    /// As a row of [`BODIES`](crate::bodies::BODIES), without its orbit.
    pub fn data(&self) -> BodyData {
        BodyData {
            gm_m3_s2: self.gm_m3_s2,
            radius_m: self.mean_radius_m(),
            j2: self.j2,
            j2_radius_m: self.radii_m[0],
            pole_right_ascension_rad: self.pole_rad[0],
            pole_declination_rad: self.pole_rad[1],
            prime_meridian_rad: self.prime_meridian_rad,
            rotation_rate_rad_s: self.rotation_rate_rad_s,
            equatorial_radius_m: self.radii_m[0],
            flattening: 1.0 - self.radii_m[2] / self.radii_m[0],
            surface: Some(self.surface()),
            ..*Body::Custom.data()
        }
    }
}

/// Reads the body.
pub(super) fn body(part: &PartReader<'_>, description: &BodyDescription) -> CustomBody {
    if description.name.trim().is_empty() {
        part.key("name").report("an empty name", "a name");
    }
    let [right_ascension, declination] = description.pole_deg();
    let pole = part.key("pole_deg");
    pole.item(0).within(right_ascension, [-360.0, 360.0], "an angle from -360 to 360 deg");
    pole.item(1).within(declination, [-90.0, 90.0], "an angle from -90 to 90 deg");
    let (gm_m3_s2, radii_m) = (description.gravitational_parameter_m3_s2.0, description.radii_m.value());
    // Values out of their own ranges are reported for themselves.
    let is_judged = gm_m3_s2 > 0.0 && radii_m.iter().all(|radius_m| (1.0..=1e9).contains(radius_m));
    let density_kg_m3 = impossible_density_kg_m3(gm_m3_s2, radii_m).filter(|_| is_judged);
    if let Some(density_kg_m3) = density_kg_m3 {
        let found = format_args!("{gm_m3_s2:?}, with radii_m a mean density of {density_kg_m3:.3e} kg/m3");
        part.key("gravitational_parameter_m3_s2")
            .report(found, "a mean density of 100 to 30000 kg/m3 (1 km3/s2 is 1e9 m3/s2)");
    }
    CustomBody {
        name: description.name.clone(),
        gm_m3_s2,
        radii_m,
        j2: description.j2(),
        pole_rad: [right_ascension, declination].map(f64::to_radians),
        prime_meridian_rad: description.prime_meridian_rad(),
        rotation_rate_rad_s: description.rotation_rate_rad_s(),
        albedo: description.albedo(),
        emissivity: description.emissivity(),
        motion: motion(part, description),
    }
}

/// Its motion, if elements or a state say it; both at once, or a part of them, are reported.
fn motion(part: &PartReader<'_>, description: &BodyDescription) -> Option<BodyMotion> {
    let BodyDescription { elements, position_m, velocity_m_s, .. } = description;
    let orbit = match (elements, position_m.value(), velocity_m_s.value()) {
        (Some(elements), None, None) => BodyOrbit::Elements(elements.value()),
        (None, Some(position_m), Some(velocity_m_s)) => {
            if position_m.cross(&velocity_m_s) == Vector3::zeros() {
                let allowed = "not along position_m: a fall along a line is no orbit about the Sun";
                part.key("velocity_m_s").report(format_args!("{:?}", velocity_m_s.as_slice()), allowed);
            }
            BodyOrbit::State { position_m, velocity_m_s }
        }
        (None, position_m, velocity_m_s) if position_m.is_some() || velocity_m_s.is_some() => {
            let missing = if position_m.is_some() { "velocity_m_s" } else { "position_m" };
            let allowed = "position_m in m and velocity_m_s in m/s, both from the Sun";
            part.report_lack(missing, allowed);
            return None;
        }
        _ => return None,
    };
    let Some(epoch) = description.epoch.as_deref() else {
        part.report_lack("epoch", format_args!("when the body is there, {ALLOWED_DATE}"));
        return None;
    };
    let refuse = |error| part.key("epoch").report(format_args!("{epoch:?}, {error}"), ALLOWED_DATE);
    let epoch_s = dates::epoch_s(epoch).map_err(refuse).ok()?;
    Some(BodyMotion { epoch_s, frame: description.frame.unwrap_or_default(), orbit })
}
