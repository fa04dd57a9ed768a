//! stub
use crate::enumeration::enumeration;
use crate::loads::ForceTorque;
use crate::numerics::scalar::Scalar;
use crate::refusal::Refusal;
use crate::spacecraft::{Spacecraft, SunshadeModel};
use nalgebra::Vector3;
enumeration! {
    /// l
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum AerodynamicLaw {
        /// D.
        1 => DragCoefficient,
        /// S.
        2 => Sentman,
        /// C.
        3 => SchaafChambre,
    }
}
enumeration! {
    /// r
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Reemission {
        /// E.
        1 => Effusive,
        /// M.
        2 => Moe,
    }
}
/// o
#[derive(Clone, Copy, Debug)]
pub struct AerodynamicOptions {
    /// l
    pub law: AerodynamicLaw,
    /// r
    pub reemission: Reemission,
    /// s
    pub shadowing: bool,
    /// s
    pub sunshade_model: Option<SunshadeModel>,
}
/// f
#[derive(Clone, Copy, Debug)]
pub struct AirFlow<T> {
    /// d
    pub density_kg_m3: T,
    /// t
    pub temperature_k: T,
    /// m
    pub molar_mass_kg_mol: T,
    /// v
    pub velocity_body_m_s: Vector3<T>,
}
/// w
#[derive(Clone, Debug)]
pub struct Workspace<T>(Vec<T>);
impl<T> Default for Workspace<T> { fn default() -> Self { Self(Vec::new()) } }
/// m
#[derive(Clone, Debug)]
pub struct AerodynamicModel;
impl AerodynamicModel {
    /// n
    pub fn new(_s: &Spacecraft, _o: &AerodynamicOptions) -> Result<Self, Refusal> { Ok(Self) }
    /// c
    pub fn face_count(&self) -> usize { 0 }
    /// u
    pub fn evaluation_units(&self) -> u32 { 1 }
    /// l
    pub fn load<T: Scalar>(&self, _f: &AirFlow<T>, _a: &[T], _c: &Vector3<T>, _w: Option<&[T]>, _s: &mut Workspace<T>) -> ForceTorque<T> { ForceTorque::zero() }
}
