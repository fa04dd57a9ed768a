//! What acts on the spacecraft, by source, and its faces one by one.

use fmi_export::{Real, RealVector, Variables};
use physics::radiation::Effect;

use super::spacecraft::ReportedFace;

/// Torque about the centre of mass by source, body frame.
#[derive(Variables)]
pub struct TorqueBySource {
    /// Direct sunlight.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-5)]
    pub solar: RealVector<3>,
    /// Sunlight reflected by the planet.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-6)]
    pub albedo: RealVector<3>,
    /// Infrared light of the planet.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-6)]
    pub infrared: RealVector<3>,
    /// Recoil of the heat the spacecraft radiates.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-6)]
    pub thermal: RealVector<3>,
    /// Gravity gradient of the planet.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-5)]
    pub gravity_gradient: RealVector<3>,
}

/// What each source did to the momentum since the last dump, body frame by momentum.convention. All of them add up to what the
/// momentum changed by since, but for thrusters in use and rotors out of balance.
#[derive(Variables)]
pub struct MomentumBySource {
    /// Direct sunlight.
    #[output(unit = "N.m.s", nominal = 1e-1)]
    pub solar: RealVector<3>,
    /// Sunlight reflected by the planet.
    #[output(unit = "N.m.s", nominal = 1e-2)]
    pub albedo: RealVector<3>,
    /// Infrared light of the planet.
    #[output(unit = "N.m.s", nominal = 1e-2)]
    pub infrared: RealVector<3>,
    /// Recoil of the heat the spacecraft radiates.
    #[output(unit = "N.m.s", nominal = 1e-2)]
    pub thermal: RealVector<3>,
    /// Gravity gradient of the planet.
    #[output(unit = "N.m.s", nominal = 1e-1)]
    pub gravity_gradient: RealVector<3>,
    /// What was applied from outside.
    #[output(unit = "N.m.s", nominal = 1e-1)]
    pub applied: RealVector<3>,
}

/// Force by source, body frame.
#[derive(Variables)]
pub struct ForceBySource {
    /// Direct sunlight.
    #[output(unit = "N", display = "uN", nominal = 1e-4)]
    pub solar: RealVector<3>,
    /// Sunlight reflected by the planet.
    #[output(unit = "N", display = "uN", nominal = 1e-5)]
    pub albedo: RealVector<3>,
    /// Infrared light of the planet.
    #[output(unit = "N", display = "uN", nominal = 1e-5)]
    pub infrared: RealVector<3>,
    /// Recoil of the heat the spacecraft radiates.
    #[output(unit = "N", display = "uN", nominal = 1e-5)]
    pub thermal: RealVector<3>,
}

/// One face of a plate or panel, in the file's order: plates, sunshade, panels, the rear after the front. There if the
/// FMU was packed with per-plate outputs.
#[derive(Variables)]
#[variables(setup = Vec<ReportedFace>, label = setup[index].name)]
pub struct PlateVariables {
    /// Temperature.
    #[output(unit = "K", nominal = 300.0)]
    pub temperature: Real,
    /// Force of sunlight and of whatever else acts of planet light and recoil, body frame; all add up to force.total but for
    /// what is applied, and for sunlight on a cylindrical shade, which is round there and of flat strips here.
    #[output(unit = "N", display = "uN", nominal = 1e-5)]
    pub force: RealVector<3>,
}

impl TorqueBySource {
    /// The output of an effect; none for what is applied from outside and the thrusters.
    pub fn of(&self, effect: Effect) -> Option<RealVector<3>> {
        match effect {
            Effect::Solar => Some(self.solar),
            Effect::Albedo => Some(self.albedo),
            Effect::Infrared => Some(self.infrared),
            Effect::Thermal => Some(self.thermal),
            Effect::GravityGradient => Some(self.gravity_gradient),
            Effect::Applied | Effect::Thrusters => None,
        }
    }
}

impl MomentumBySource {
    /// The outputs with their effects.
    pub fn all(&self) -> [(Effect, RealVector<3>); 6] {
        [
            (Effect::Solar, self.solar),
            (Effect::Albedo, self.albedo),
            (Effect::Infrared, self.infrared),
            (Effect::Thermal, self.thermal),
            (Effect::GravityGradient, self.gravity_gradient),
            (Effect::Applied, self.applied),
        ]
    }
}

impl ForceBySource {
    /// The output of an effect; none for what is applied from outside, the thrusters, and what exerts no force.
    pub fn of(&self, effect: Effect) -> Option<RealVector<3>> {
        match effect {
            Effect::Solar => Some(self.solar),
            Effect::Albedo => Some(self.albedo),
            Effect::Infrared => Some(self.infrared),
            Effect::Thermal => Some(self.thermal),
            Effect::GravityGradient | Effect::Applied | Effect::Thrusters => None,
        }
    }
}
