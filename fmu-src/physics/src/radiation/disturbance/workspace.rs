//! Results of an evaluation by face, and scratch space that is allocated once.

use nalgebra::Vector3;

use crate::loads::{Active, Effect};
use crate::numerics::scalar::{Scalar, scratch};
use crate::radiation::planet_light::PlanetLight;
use crate::radiation::shadow::ShadowWorkspace;
use crate::spacecraft::Material;

/// Light, heat and forces of one face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceResult<T: Scalar> {
    /// Force of each effect of light and heat, body frame, in N. They add up to the effects' forces, but for sunlight on the
    /// strips of a cylindrical shade: there the strips are flat and the effect has the closed form.
    pub forces_body_n: [Vector3<T>; Effect::LIGHT],
    /// Centre of the lit area, body frame, in m; the face's centre where it is dark.
    pub lit_center_body_m: Vector3<T>,
    /// Absorbed sunlight, in W.
    pub absorbed_sun_w: T,
    /// Absorbed light from the planet, in W.
    pub absorbed_planet_w: T,
    /// Temperature, in K.
    pub temperature_k: T,
}

impl<T: Scalar> FaceResult<T> {
    pub(super) fn dark() -> Self {
        let zero = T::constant(0.0);
        Self {
            forces_body_n: [Vector3::zeros(); Effect::LIGHT],
            lit_center_body_m: Vector3::zeros(),
            absorbed_sun_w: zero,
            absorbed_planet_w: zero,
            temperature_k: zero,
        }
    }

    /// Force of the effects that act, body frame, in N.
    pub fn force_body_n(&self, active: Active) -> Vector3<T> {
        active.light().map(|effect| self.forces_body_n[effect as usize]).sum()
    }
}

scratch! {
/// Scratch space of [`super::DisturbanceModel::evaluate`] and its results by face. Starts empty; the first evaluation
/// sizes it, later ones do not allocate unless surfaces shadow one another.
pub struct Workspace<T: Scalar> {
    pub(super) normals: Vec<Vector3<T>>,
    pub(super) lights: Vec<PlanetLight<T>>,
    pub(super) faces: Vec<FaceResult<T>>,
    pub(super) shadow: ShadowWorkspace<T>,
    pub(super) materials: Vec<Material<T>>,
}
}

impl<T: Scalar> Workspace<T> {
    /// The faces as of the last evaluation, in the order of [`super::DisturbanceModel::face_names`].
    pub fn faces(&self) -> &[FaceResult<T>] {
        &self.faces
    }

    /// How many shadows of one outline on another the last evaluation cut out, about a microsecond each.
    pub fn shadows_cut(&self) -> usize {
        self.shadow.clipped_pairs()
    }

    /// Sets the results of `faces` faces to those without light and heat.
    pub fn darken(&mut self, faces: usize) {
        self.faces.clear();
        self.faces.resize(faces, FaceResult::dark());
    }

    /// Sizes everything; allocates only when a size changes.
    pub(super) fn prepare(&mut self, normals: usize, faces: usize) {
        if self.normals.len() != normals {
            self.normals.resize(normals, Vector3::zeros());
            self.lights.resize(normals, PlanetLight::dark());
        }
        if self.faces.len() != faces {
            self.faces.resize(faces, FaceResult::dark());
        }
    }
}
