//! How light of the planet is summed: on rings, or by the paper's cells.

use nalgebra::{Matrix3, Vector3};

use super::geometry::PlanetGeometry;
use crate::bodies::surface::{PlanetSurface, SurfaceExitance};
use crate::numerics::scalar::Scalar;
use crate::radiation::grid::{PlanetGrid, sun_fixed_axes};
use crate::radiation::planet_light::PlanetLight;
use crate::radiation::ring::{PlanetView, RingRule};
use crate::refusal::Refusal;
use crate::spacecraft::PlanetMap;

/// Method by which the planet's light is summed.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanetLightMethod {
    /// Rings about the nadir, with this number of quadrature nodes per segment: 6 for 1e-4, 16 for 1e-5.
    Rings(usize),
    /// The paper's cells in this number of belts of latitude: slow, and results bend as each cell rises or sets.
    Cells(usize),
    /// Cells with properties of their own, which go before those of the planet's surface.
    Map(PlanetMap),
}

impl Default for PlanetLightMethod {
    fn default() -> Self {
        Self::Rings(6)
    }
}

/// The method, prepared.
#[derive(Clone, Debug)]
pub(super) enum PlanetRule {
    Rings(RingRule),
    Cells(PlanetGrid),
}

/// The planet as one geometry shows it, for every face.
pub(super) struct PlanetSource<'r, T: Scalar> {
    rule: &'r PlanetRule,
    view: PlanetView<T>,
    sun_flux_w_m2: T,
    exitance: SurfaceExitance<T>,
    /// Axes of the cells as columns; without effect on rings.
    cell_axes: Matrix3<T>,
}

impl PlanetRule {
    pub(super) fn new(method: &PlanetLightMethod) -> Result<Self, Refusal> {
        Ok(match method {
            PlanetLightMethod::Rings(nodes) => Self::Rings(RingRule::new(*nodes)?),
            PlanetLightMethod::Cells(belts) => Self::Cells(PlanetGrid::new(*belts)?),
            PlanetLightMethod::Map(map) => Self::Cells(PlanetGrid::of_map(map)?),
        })
    }

    /// Returns the estimated time of the light on `faces` faces, in microseconds.
    pub(super) fn evaluation_units(&self, faces: u32) -> u32 {
        match self {
            Self::Rings(rings) => {
                let nodes = rings.node_count() as u32;
                // Measured from 4 to 64 nodes with terminator and horizon in view; few nodes cost what every face costs.
                1 + faces.saturating_mul((3 * nodes).saturating_sub(4).max(nodes + 6)) / 20
            }
            Self::Cells(grid) => 1 + faces.saturating_mul(grid.cell_count() as u32) / 4,
        }
    }

    /// Returns the part of the computation that all faces have in common.
    pub(super) fn planet_source<T: Scalar>(
        &self,
        surface: &PlanetSurface<T>,
        planet: &PlanetGeometry<T>,
    ) -> Result<PlanetSource<'_, T>, Refusal> {
        let view =
            PlanetView::new(&planet.position_body_m, &planet.sun_from_planet_body_m, surface.radius_m)?;
        let cell_axes = match self {
            Self::Rings(_) => Matrix3::identity(),
            Self::Cells(_) => sun_fixed_axes(&view.sun, &planet.pole_body.unwrap_or_else(|| -Vector3::z()))?,
        };
        let sun_flux_w_m2 = planet.sun_flux_w_m2;
        let exitance = surface.exitance(sun_flux_w_m2);
        Ok(PlanetSource { rule: self, view, sun_flux_w_m2, exitance, cell_axes })
    }
}

impl<T: Scalar> PlanetSource<'_, T> {
    /// Light on a face of unit `normal`.
    pub(super) fn receive(&self, normal: &Vector3<T>) -> PlanetLight<T> {
        let Self { view, sun_flux_w_m2, exitance, cell_axes, .. } = self;
        match self.rule {
            PlanetRule::Rings(rings) => rings.receive(view, exitance, normal),
            PlanetRule::Cells(grid) => grid.receive(exitance, *sun_flux_w_m2, view, cell_axes, normal),
        }
    }
}
