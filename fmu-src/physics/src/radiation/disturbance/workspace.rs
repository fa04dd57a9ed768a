//! What an evaluation writes: results by effect, by face, and scratch space that is allocated once.

use nalgebra::Vector3;

use crate::numerics::scalar::Scalar;
use crate::radiation::force_torque::ForceTorque;
use crate::radiation::planet_light::PlanetLight;
use crate::radiation::shadow::ShadowWorkspace;

/// Force and torque about the centre of mass, by effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disturbance<T: Scalar> {
    /// Direct sunlight.
    pub solar: ForceTorque<T>,
    /// Sunlight reflected by the planet.
    pub albedo: ForceTorque<T>,
    /// Infrared light of the planet.
    pub infrared: ForceTorque<T>,
    /// Recoil of the heat the spacecraft radiates.
    pub thermal: ForceTorque<T>,
}

impl<T: Scalar> Disturbance<T> {
    /// No disturbance.
    pub fn zero() -> Self {
        Self {
            solar: ForceTorque::zero(),
            albedo: ForceTorque::zero(),
            infrared: ForceTorque::zero(),
            thermal: ForceTorque::zero(),
        }
    }

    /// All effects together.
    pub fn total(&self) -> ForceTorque<T> {
        self.solar + self.albedo + self.infrared + self.thermal
    }
}

/// What one face receives, gives off and feels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceResult<T: Scalar> {
    /// Force by effect, body frame, in N: solar, albedo, infrared, thermal. They add up to the effects' forces, but for
    /// sunlight on the strips of a cylindrical shade: there the strips are flat and the effect has the closed form.
    pub forces_body_n: [Vector3<T>; 4],
    /// Lit area, in m2; 0 where the face looks away from the Sun.
    pub lit_area_m2: T,
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
            forces_body_n: [Vector3::zeros(); 4],
            lit_area_m2: zero,
            lit_center_body_m: Vector3::zeros(),
            absorbed_sun_w: zero,
            absorbed_planet_w: zero,
            temperature_k: zero,
        }
    }

    /// Force of all effects, body frame, in N.
    pub fn force_body_n(&self) -> Vector3<T> {
        self.forces_body_n.iter().sum()
    }
}

/// Scratch space of [`super::DisturbanceModel::evaluate`] and its results by face. Starts empty; the first evaluation
/// sizes it, later ones do not allocate unless surfaces shadow one another.
#[derive(Clone, Debug)]
pub struct Workspace<T: Scalar> {
    pub(super) normals: Vec<Vector3<T>>,
    pub(super) lights: Vec<PlanetLight<T>>,
    pub(super) faces: Vec<FaceResult<T>>,
    pub(super) shadow: ShadowWorkspace<T>,
}

impl<T: Scalar> Default for Workspace<T> {
    fn default() -> Self {
        Self {
            normals: Vec::new(),
            lights: Vec::new(),
            faces: Vec::new(),
            shadow: ShadowWorkspace::default(),
        }
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

    /// As after an evaluation in which no light reaches any of so many faces, and none is known to be warm.
    pub fn darken(&mut self, faces: usize) {
        self.faces.clear();
        self.faces.resize(faces, FaceResult::dark());
    }

    /// Takes the recoil out of the faces' forces; their temperatures stay.
    pub(super) fn leave_out_recoil(&mut self) {
        for face in &mut self.faces {
            face.forces_body_n[3] = Vector3::zeros();
        }
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
