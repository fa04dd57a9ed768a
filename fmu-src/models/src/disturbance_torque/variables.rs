//! The model's variables at its public face.

use fmi_export::{Boolean, Choice, Enumeration, Integer, Real, RealMatrix, RealVector, Values, Variables};
use nalgebra::Matrix3;
use physics::constants::RADIUS_SUN_M;
use physics::numerics::scalar::Scalar;
use physics::plant::{Parameters, Positions};

use super::setup::DisturbanceSetup as Setup;
use crate::common::choices::SunshadeShape;
use crate::common::effects::{self, LawVariables, RecoilVariables, ShadowingVariables};
use crate::common::loads::{self, BySource, PlateVariables};
use crate::common::optics::OpticsVariables;
use crate::common::variables::{EclipseVariables, SolarFluxVariables, SurfaceVariables, WorkLimit};

/// Every variable, in the order of the XML.
#[derive(Variables)]
pub struct DisturbanceVariables {
    pub sun: SunVariables,
    pub planet: PlanetVariables,
    #[group(count = setup.spacecraft.panels.len())]
    pub panel: Vec<PanelVariables>,
    pub solar: SolarFluxVariables,
    pub eclipse: EclipseVariables,
    pub planet_light: PlanetLightVariables,
    pub thermal: RecoilVariables,
    pub shadowing: ShadowingVariables,
    #[group(name = "", setup = &setup.center)]
    pub laws: LawVariables,
    pub atmosphere: AtmosphereVariables,
    /// Field where the spacecraft is, body frame.
    #[input(name = "magneticField.body", unit = "T", display = "nT", start = [0.0; 3])]
    pub magnetic_field_body: RealVector<3>,
    pub spacecraft: SpacecraftVariables,
    /// Which model of the shade takes the light; without a shade it does not count.
    #[parameter(name = "sunshade.shape", start = SunshadeShape::for_spacecraft(&setup.spacecraft))]
    pub sunshade_shape: Choice<SunshadeShape>,
    #[group(setup = &setup.optics)]
    pub optics: OpticsVariables,
    pub solver: WorkLimit,
    pub torque: TorqueVariables,
    pub force: ForceVariables,
    #[group(count = setup.reported_faces.len(), setup = &setup.reported_faces)]
    pub plate: Vec<PlateVariables>,
}

impl DisturbanceVariables {
    /// The inputs.
    pub fn positions(&self) -> Positions<Real> {
        let vector = |of: RealVector<3>| core::array::from_fn(|i| of.element(i));
        Positions {
            sun_m: vector(self.sun.position_body),
            planet_m: vector(self.planet.position_body),
            pole: vector(self.planet.pole),
            center_of_mass_m: vector(self.spacecraft.center_of_mass),
            air: [self.atmosphere.density, self.atmosphere.temperature, self.atmosphere.molar_mass],
            air_velocity_m_s: vector(self.atmosphere.velocity_body),
            field_t: vector(self.magnetic_field_body),
            panel_angles_rad: self.panel.iter().map(|panel| panel.angle).collect(),
        }
    }

    /// The parameters that are numbers, as `read` reads them.
    pub fn parameters<T: Scalar>(&self, values: &Values, read: impl Fn(Real) -> T) -> Parameters<T> {
        let planet = &self.planet;
        Parameters {
            flux_at_1_au_w_m2: read(self.solar.flux),
            solar_scale: read(self.solar.scale),
            sun_radius_m: read(self.sun.radius),
            inertia_body_kg_m2: Matrix3::from_fn(|i, j| read(self.spacecraft.inertia.element(i, j))),
            planet: planet.surface.read(values, planet.radius, &read),
            laws: self.laws.read(
                values,
                [planet.gravitational_parameter, planet.j2, planet.j2_radius],
                &read,
            ),
        }
    }
}

/// The Sun.
#[derive(Variables)]
pub struct SunVariables {
    /// Radius of the Sun (IAU 2015 nominal): width of the penumbra, and of shadows of parts by shadowing.sunDisc. Others use
    /// 695,000 or 696,000 km, which moves an edge of a shadow by some 2 ms.
    #[parameter(unit = "m", display = "km", min = 1.0, max = 1e10, start = RADIUS_SUN_M)]
    pub radius: Real,
    /// From the spacecraft to the Sun, body frame.
    #[input(unit = "m", display = "AU", start = setup.center.data.usual_sun_body_m())]
    pub position_body: RealVector<3>,
    /// Visible part of the Sun's disc: 1 in full light, 0 in the planet's shadow.
    #[output(unit = "1", min = 0.0, max = 1.0, nominal = 1.0)]
    #[annotation(role = "litFraction")]
    pub lit_fraction: Real,
}

/// The planet: where it is and what its surface does with sunlight.
#[derive(Variables)]
pub struct PlanetVariables {
    /// From the spacecraft to the planet's centre, body frame.
    #[input(unit = "m", display = "km", start = setup.center.data.usual_planet_body_m())]
    pub position_body: RealVector<3>,
    /// Whether there is a planet; without one its position does not count. By default there is unless the file's orbit.center is
    /// the Sun; the defaults of planet.* are those of that body.
    #[parameter(start = setup.center.data.body.is_planet())]
    pub present: Boolean,
    /// Radius of the planet; a spacecraft below it is refused.
    #[parameter(unit = "m", display = "km", min = 1.0, max = 1e9, start = setup.center.data.radius_m)]
    pub radius: Real,
    /// Gravitational parameter of the planet: by it its gravity gradient.
    #[parameter(unit = "m3/s2", display = "km3/s2", min = 0.0, max = 1e21, start = setup.center.data.gm_m3_s2)]
    pub gravitational_parameter: Real,
    /// Flattening of the planet's gravity, with gravityGradient.flattening: second zonal harmonic, unnormalised.
    #[parameter(unit = "1", min = -1.0, max = 1.0, start = setup.center.data.j2)]
    pub j2: Real,
    /// Radius to which planet.j2 refers.
    #[parameter(unit = "m", display = "km", min = 1.0, max = 1e9, start = setup.center.data.j2_radius_m)]
    pub j2_radius: Real,
    /// North of the planet in the body frame, of any length; -Z in the attitude of paper 004. For its cells, and for the flattening of
    /// its gravity. Without effect on rings.
    #[input(unit = "1", start = [0.0, 0.0, -1.0])]
    #[annotation(also_called = "planet.poleBody[i]")]
    pub pole: RealVector<3>,
    #[group(name = "", setup = &setup.center)]
    pub surface: SurfaceVariables,
}

/// The air about the spacecraft.
#[derive(Variables)]
pub struct AtmosphereVariables {
    /// Density; 0 = no air.
    #[input(unit = "kg/m3", min = 0.0, max = 1e3, start = 0.0)]
    pub density: Real,
    /// Temperature.
    #[input(unit = "K", min = 0.0, max = 1e5, start = 1000.0)]
    pub temperature: Real,
    /// Mean molar mass.
    #[input(unit = "kg/mol", display = "g/mol", min = 0.0, max = 1.0, start = 0.016)]
    pub molar_mass: Real,
    /// Velocity of the spacecraft relative to the air, body frame.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    pub velocity_body: RealVector<3>,
}

/// One solar panel.
#[derive(Variables)]
pub struct PanelVariables {
    /// Rotation angle about the panel's axis from its zero position.
    #[input(unit = "rad", display = "deg", start = setup.spacecraft.panels[index].angle_rad)]
    #[annotation(also_called = "panel[k].angleActual")]
    pub angle: Real,
}

/// How planet light is summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum PlanetMethod {
    /// Quadrature on rings about the nadir: fast, exact in the limit of many nodes.
    Rings = 1,
    /// The cells of paper 004 with the areas they have: slow, and results bend as each cell rises or sets.
    Cells = 2,
    /// The cells of planet_map in the spacecraft's file, with albedo, emissivity and temperature of their own by local time.
    Map = 3,
}

/// Light of the planet.
#[derive(Variables)]
pub struct PlanetLightVariables {
    #[group(name = "")]
    pub rings: effects::PlanetLightVariables,
    /// How light of the planet is summed over what the spacecraft sees of it.
    #[parameter(start = PlanetMethod::Rings)]
    pub method: Choice<PlanetMethod>,
    /// Belts of latitude of the planet's cells, twice as many of longitude (n_res of paper 004); its odd numbers have cells
    /// right on the terminator. Time goes with the square.
    #[parameter(min = 1, max = 2000, start = 45)]
    pub belts: Integer,
}

/// Mass properties.
#[derive(Variables)]
pub struct SpacecraftVariables {
    /// Centre of mass in the body frame, as the panels stand.
    #[input(unit = "m", display = "cm", min = -1e4, max = 1e4, start = setup.spacecraft.mass_properties.center_of_mass_body_m.into())]
    pub center_of_mass: RealVector<3>,
    /// Inertia about the centre of mass, body frame.
    #[parameter(unit = "kg.m2", min = -1e15, max = 1e15, start = setup.spacecraft.mass_properties.inertia_body_kg_m2.transpose().into())]
    pub inertia: RealMatrix<3, 3>,
}

/// Torque about the centre of mass by source, body frame.
#[derive(Variables)]
pub struct TorqueVariables {
    #[group(name = "", setup = &loads::TORQUE)]
    pub by_source: BySource,
    /// Sum of all sources.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-5)]
    pub total: RealVector<3>,
}

/// Force by source, body frame.
#[derive(Variables)]
pub struct ForceVariables {
    #[group(name = "", setup = &loads::FORCE)]
    pub by_source: BySource,
    /// Sum of all sources.
    #[output(unit = "N", display = "uN", nominal = 1e-4)]
    pub total: RealVector<3>,
}
