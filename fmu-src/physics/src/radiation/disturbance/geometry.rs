//! Positions of Sun and planet and angles of panels for which light and heat are computed.

use nalgebra::Vector3;

use crate::constants::{RADIUS_SUN_M, SPEED_OF_LIGHT_M_S};
use crate::environment::sun::flux_w_m2;
use crate::numerics::scalar::Scalar;
use crate::radiation::flat_plate::Beam;
use crate::refusal::Refusal;

/// One moment's geometry, in the body frame.
#[derive(Clone, Copy, Debug)]
pub struct Geometry<'a, T: Scalar> {
    /// Unit vector toward the Sun.
    pub sun_direction_body: Vector3<T>,
    /// Sine of the Sun's angular radius, its radius over its distance; counts where shadows are softened.
    pub sun_sine: T,
    /// Solar flux at the spacecraft without eclipses, in W/m2.
    pub sun_flux_w_m2: T,
    /// Factor of the force of direct sunlight; the heat follows from the flux alone.
    pub solar_scale: T,
    /// Visible fraction of the Sun's disc (of its light), 1 outside eclipses.
    pub lit_fraction: T,
    /// The planet, if one is near.
    pub planet: Option<PlanetGeometry<T>>,
    /// Angle of every panel about its axis, in rad.
    pub panel_angles_rad: &'a [T],
    /// Centre of mass from the body frame's origin, in m.
    pub center_of_mass_body_m: Vector3<T>,
}

/// The planet as seen from the spacecraft.
#[derive(Clone, Copy, Debug)]
pub struct PlanetGeometry<T: Scalar> {
    /// From the spacecraft to the planet's centre, body frame, in m.
    pub position_body_m: Vector3<T>,
    /// From the planet's centre to the Sun, body frame, in m; only the direction counts.
    pub sun_from_planet_body_m: Vector3<T>,
    /// The Sun's flux at the planet, in W/m2.
    pub sun_flux_w_m2: T,
    /// North of the planet's cells, body frame, of any length; body -Z, as in paper 004, where there is none. Without effect on
    /// rings.
    pub pole_body: Option<Vector3<T>>,
}

/// Temperatures at which faces radiate heat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Recoil<'a> {
    /// Every surface is in balance with the light it receives.
    Balance,
    /// Temperatures and recoil do not count, and are 0.
    Ignored,
    /// Faces that store heat have these temperatures (in K, one for every face of the model); others are in balance.
    Stored(&'a [f64]),
}

impl<'a, T: Scalar> Geometry<'a, T> {
    /// In sunlight alone, of a Sun that is a point; without panels, torque about the body frame's origin.
    pub fn sunlit(sun_direction_body: Vector3<T>, sun_flux_w_m2: T) -> Self {
        Self {
            sun_direction_body,
            sun_sine: T::constant(0.0),
            sun_flux_w_m2,
            solar_scale: T::constant(1.0),
            lit_fraction: T::constant(1.0),
            planet: None,
            panel_angles_rad: &[],
            center_of_mass_body_m: Vector3::zeros(),
        }
    }

    /// Geometry from positions: fluxes follow the inverse square of the distance (paper 004 eq 22).
    ///
    /// Six arguments, which belong to flux, Sun, planet, shadow, panels and mass. `sun_position_body_m` and `planet_position_body_m` point from the spacecraft to the centres.
    ///
    /// # Errors
    /// The Sun at no distance from spacecraft or planet, or not finite.
    pub fn at(
        flux_at_1_au_w_m2: T,
        sun_position_body_m: &Vector3<T>,
        planet_position_body_m: Option<&Vector3<T>>,
        lit_fraction: T,
        panel_angles_rad: &'a [T],
        center_of_mass_body_m: Vector3<T>,
    ) -> Result<Self, Refusal> {
        let flux = |position_m: &Vector3<T>| -> Result<(T, T), Refusal> {
            let distance_m = position_m.dot(position_m).sqrt();
            let found_m = distance_m.value();
            let flux_w_m2 = flux_w_m2(flux_at_1_au_w_m2, distance_m).ok_or_else(|| {
                let found = format_args!("the Sun is at a distance of {found_m} m");
                Refusal::new(found, "a finite distance above 0 m")
            })?;
            Ok((flux_w_m2, distance_m))
        };
        let (sun_flux_w_m2, distance_m) = flux(sun_position_body_m)?;
        let planet = planet_position_body_m.map(|position_body_m| {
            let sun_from_planet_body_m = sun_position_body_m - position_body_m;
            let (sun_flux_w_m2, _) = flux(&sun_from_planet_body_m)?;
            let (position_body_m, pole_body) = (*position_body_m, None);
            Ok(PlanetGeometry { position_body_m, sun_from_planet_body_m, sun_flux_w_m2, pole_body })
        });
        Ok(Self {
            sun_sine: distance_m.recip() * RADIUS_SUN_M,
            lit_fraction,
            planet: planet.transpose()?,
            panel_angles_rad,
            center_of_mass_body_m,
            ..Self::sunlit(sun_position_body_m / distance_m, sun_flux_w_m2)
        })
    }

    /// The same with a Sun of this radius, in m, in place of the nominal one.
    pub fn with_sun_radius(self, sun_radius_m: T) -> Self {
        Self { sun_sine: self.sun_sine * (sun_radius_m / T::constant(RADIUS_SUN_M)), ..self }
    }

    /// Sunlight as far as the planet lets it through.
    pub(super) fn beam(&self) -> Beam<T> {
        let pressure_pa = self.sun_flux_w_m2 * self.lit_fraction * (1.0 / SPEED_OF_LIGHT_M_S);
        Beam { source_body: self.sun_direction_body, pressure_pa }
    }

    pub(super) fn check(&self, panels: usize) -> Result<(), Refusal> {
        if self.panel_angles_rad.len() != panels {
            let found = format_args!("{} panel angles", self.panel_angles_rad.len());
            return Err(Refusal::new(found, format_args!("{panels}, one for each panel")));
        }
        let finite = |what, good: bool| {
            let refused = || Refusal::new(format_args!("{what} is not finite"), "finite numbers");
            good.then_some(()).ok_or_else(refused)
        };
        let vector = |v: &Vector3<T>| v.iter().all(|x| x.value().is_finite());
        finite("the Sun's direction", vector(&self.sun_direction_body))?;
        finite("the Sun's angular radius", self.sun_sine.value().is_finite())?;
        finite("the Sun's flux", self.sun_flux_w_m2.value().is_finite())?;
        finite("the factor of sunlight's force", self.solar_scale.value().is_finite())?;
        finite("the lit fraction", self.lit_fraction.value().is_finite())?;
        finite("the centre of mass", vector(&self.center_of_mass_body_m))?;
        finite("a panel's angle", self.panel_angles_rad.iter().all(|x| x.value().is_finite()))
    }
}
