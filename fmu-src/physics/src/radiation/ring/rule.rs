//! The quadrature over rings: Gauss-Legendre nodes in each segment, all faces of a spacecraft by one rule.
//!
//! Equation, method, order, error measure and reference: see [`super`]. A segment is split at twice the distance of the
//! singularity an earlier birth leaves just outside of it and then at multiples of a ratio (a graded mesh), so that the
//! distance to the singularity is never small beside a piece's length. Singularities nearer than `closest_singularity`
//! are left: what they do to the integral goes with the square of their distance and is below the rule's error.

use nalgebra::Vector3;

use super::arcs::{Arc, Azimuth, EvenMoments, Moments};
use super::segments::{AT_NADIR, Breaks, FARTHEST_SPLIT, SPLIT_RATIO};
use super::sums::{Tensors, Weighted};
use super::view::PlanetView;
use crate::bodies::surface::SurfaceExitance;
use crate::math;
use crate::numerics::quadrature::gauss_legendre;
use crate::numerics::scalar::{Scalar, exp, ln};
use crate::radiation::flat_plate::ReceivedLight;
use crate::radiation::planet_light::PlanetLight;
use crate::refusal::Refusal;

/// Greatest number of nodes a segment may have.
const MOST_NODES: usize = 64;

/// Rings computed side by side.
const AT_ONCE: usize = 8;

/// Closest distance of a break to a degenerate geometry: a plate's horizon, or its crossing with the terminator, touching the limb
/// or a ring, or plate and Sun nearly aligned. The break's speed grows as the inverse of that distance; closer than this the break
/// is held, because its speed would turn the quadrature's error into a slope.
const RACING: f64 = 0.02;

/// A normal whose horizontal part is shorter has no azimuth.
const LEAST_REACH: f64 = 1e-9;

/// The quadrature with its nodes; built once, used without allocation.
#[derive(Clone, Debug, PartialEq)]
pub struct RingRule {
    /// Position in (0, 1) and weight.
    nodes: Vec<(f64, f64)>,
    /// Bends nearer to a segment's start do not matter at this number of nodes: their effect goes with the square.
    closest_singularity: f64,
}

/// A plate with what every ring needs of it, in its own frame: z to nadir, x where its normal leans.
struct Plate<T: Scalar> {
    /// Direction of x from east.
    azimuth: Azimuth<T>,
    normal: Vector3<T>,
    /// Length of the normal's horizontal part.
    reach: T,
    /// Direction of the Sun.
    sun: Vector3<T>,
    /// Azimuth of the Sun in (-pi, pi], with its cosine and sine.
    sun_ahead: T,
    sun_azimuth: Azimuth<T>,
}

impl RingRule {
    /// A rule with `nodes_per_segment` nodes between two births of arcs.
    ///
    /// # Errors
    /// Unless there are 1 to 64 nodes.
    pub fn new(nodes_per_segment: usize) -> Result<Self, Refusal> {
        if !(1..=MOST_NODES).contains(&nodes_per_segment) {
            return Err(Refusal::new(
                format_args!("{nodes_per_segment} quadrature nodes a segment"),
                "1 to 64 (6 for 1e-4, 16 for 1e-5)",
            ));
        }
        let mut positions = vec![0.0; nodes_per_segment];
        let mut weights = vec![0.0; nodes_per_segment];
        gauss_legendre(&mut positions, &mut weights);
        let on_unit = |(x, w): (&f64, &f64)| (0.5 * (1.0 + x), 0.5 * w);
        Ok(Self {
            nodes: positions.iter().zip(&weights).map(on_unit).collect(),
            closest_singularity: math::powf(10_f64, -1.2 - 0.25 * nodes_per_segment as f64),
        })
    }

    /// Nodes between two births of arcs.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Light from the planet on the front of a plate of unit `normal`, by kind (paper 004 eqs 33-36, 39-41 in
    /// the limit of infinitely many planet cells).
    pub fn receive<T: Scalar>(
        &self,
        view: &PlanetView<T>,
        exitance: &SurfaceExitance<T>,
        normal: &Vector3<T>,
    ) -> PlanetLight<T> {
        let plate = Plate::new(view, &view.local(normal));
        let mut total = [Tensors::zero(), Tensors::zero()];
        let breaks = plate.breaks(view);
        for segment in breaks.segments() {
            let mut over = |low: T, high: T| {
                let width = high - low;
                // In passes, so that the roots and divisions of one ring need not wait for those of the ring before.
                for nodes in self.nodes.chunks(AT_ONCE) {
                    let mut rings = [Ring::none(); AT_ONCE];
                    for (ring, &(position, weight)) in rings.iter_mut().zip(nodes) {
                        let (x, jacobian) = segment.at(low + width * position);
                        ring.place(view, x, jacobian * width * weight);
                    }
                    for ring in rings.iter_mut().take(nodes.len()) {
                        ring.find_arcs(view, &plate);
                    }
                    for ring in rings.iter().take(nodes.len()) {
                        ring.add_to(&mut total, &plate, exitance);
                    }
                }
            };
            let (mut low, high) = segment.range();
            if let Some(singularity) = segment.singularity(self.closest_singularity) {
                let mut middle = singularity * 2.0;
                while middle.value() < FARTHEST_SPLIT {
                    if middle.value() > 1.5 * low.value() {
                        over(low, middle);
                        low = middle;
                    }
                    middle = middle * SPLIT_RATIO;
                }
            }
            over(low, high);
        }
        let [albedo, infrared] = total.map(|tensors| plate.outward(view, tensors.on(&plate.normal)));
        PlanetLight { albedo, infrared }
    }
}

impl<T: Scalar> Plate<T> {
    fn new(view: &PlanetView<T>, normal: &Vector3<T>) -> Self {
        // A normal along nadir has no azimuth; every ring is then seen all or not at all, in any frame.
        let (azimuth, reach) = match Azimuth::with_length(normal.x, normal.y) {
            (azimuth, reach) if reach.value() > LEAST_REACH => (azimuth, reach),
            (_, reach) => (Azimuth { cos: T::constant(1.0), sin: T::constant(0.0) }, reach),
        };
        let sun_azimuth = azimuth.to(&view.sun_azimuth);
        let sun = view.sun_local;
        Self {
            azimuth,
            normal: azimuth.turned_back(normal),
            reach,
            sun: azimuth.turned_back(&sun),
            sun_ahead: T::polar_angle(sun_azimuth.sin, sun_azimuth.cos),
            sun_azimuth,
        }
    }

    /// Light in this frame as light in the body frame.
    fn outward(&self, view: &PlanetView<T>, light: ReceivedLight<T>) -> ReceivedLight<T> {
        ReceivedLight { vector_pa: view.unlocal(&self.azimuth.turned_forth(&light.vector_pa)), ..light }
    }

    /// Limb, nadir, the births of both arcs, and where the terminator crosses the plate's horizon.
    fn breaks(&self, view: &PlanetView<T>) -> Breaks<T> {
        let mut breaks = Breaks::none();
        // Plate horizon: sin(eta) = |cos(tilt)|, so cos(eta) = sin(tilt).
        let along = view.relative_distance * self.reach;
        let under_root = along * along - view.limb_squared;
        let horizon = (under_root.value() > 0.0).then(|| ln(view.limb / (along + under_root.sqrt())));
        let horizon = horizon.map(|x| if x.value() > -RACING { held(view, x) } else { x });
        if horizon.is_none() && self.normal.z.value() <= 0.0 {
            return breaks;
        }
        breaks.insert(view.nearest, false);
        breaks.insert(T::constant(0.0), false);
        let mut inside = |x: T, born: bool| {
            if x.value() > view.nearest.value() + AT_NADIR {
                breaks.insert(x, born);
            } else {
                breaks.born[0] |= born && x.value() >= view.nearest.value() - AT_NADIR;
            }
        };
        if let Some(x) = horizon {
            inside(x, true);
        }
        if let Some(x) = view.terminator {
            inside(x, true);
        }
        self.crossings(view, &mut inside);
        if let (Some(x), true) = (horizon, self.normal.z.value() < 0.0)
            && x.value() > view.nearest.value() + AT_NADIR
        {
            breaks.unseen_before = x.value();
        }
        breaks
    }

    /// Reports the rings on which both arcs end at one point: points p with n.p = 0, sun.p = d sun.nadir on the sphere.
    fn crossings(&self, view: &PlanetView<T>, inside: &mut impl FnMut(T, bool)) {
        let (n, sun) = (&self.normal, &self.sun);
        let n_dot_sun = n.dot(sun);
        let sine_squared = n_dot_sun * n_dot_sun * -1.0 + 1.0;
        if sine_squared.value() < 1e-12 {
            return;
        }
        let level = view.relative_distance * sun.z / sine_squared;
        let foot = (sun - n * n_dot_sun) * level;
        let line = n.cross(sun) / sine_squared.sqrt();
        // |foot + lambda line - d nadir| = 1
        let half_b = view.relative_distance * line.z;
        let c = foot.dot(&foot) - view.relative_distance * foot.z * 2.0 + view.limb_squared;
        let under_root = half_b * half_b - c;
        if under_root.value() <= 0.0 {
            return;
        }
        let root = under_root.sqrt();
        for lambda in [half_b - root, half_b + root] {
            let t_squared = foot.dot(&foot) + lambda * lambda;
            // Beyond the limb the point is on the far side.
            if t_squared.value() < view.limb_squared.value() {
                let x = ln(t_squared / view.limb_squared) * 0.5;
                let races = math::powi(root.value(), 2) < RACING * RACING * t_squared.value()
                    || sine_squared.value() < RACING * RACING;
                inside(if races { held(view, x) } else { x }, false);
            }
        }
    }
}

/// A break that keeps its part of the way from nadir to the limb: as good a place to split there, whatever the
/// geometry does next, and one that does not move faster than nadir itself.
fn held<T: Scalar>(view: &PlanetView<T>, x: T) -> T {
    view.nearest * (x.value() / view.nearest.value())
}

/// One ring of the planet.
#[derive(Clone, Copy)]
struct Ring<T: Scalar> {
    /// Distance over the planet's radius.
    distance: T,
    cos_eta: T,
    sin_eta: T,
    /// Solid angle per azimuth, times the node's weight.
    solid_angle: T,
    /// cos z = `sun_level + distance sin(eta) (sun.x cos + sun.y sin)` around the ring.
    sun_level: T,
    /// Arc that the plate sees.
    seen: Arc<T>,
    /// Arc that the Sun lights.
    lit: Arc<T>,
}

impl<T: Scalar> Ring<T> {
    fn none() -> Self {
        let zero = T::constant(0.0);
        Self {
            distance: zero,
            cos_eta: zero,
            sin_eta: zero,
            solid_angle: zero,
            sun_level: zero,
            seen: Arc::Empty,
            lit: Arc::Empty,
        }
    }

    /// Puts the ring at `x` with the weight `share`.
    #[inline]
    fn place(&mut self, view: &PlanetView<T>, x: T, share: T) {
        let t = view.limb * exp(x);
        let t_squared = t * t;
        let per_twice_distance_t = T::constant(0.5) / (view.relative_distance * t);
        let cos_eta = (t_squared + view.limb_squared) * per_twice_distance_t;
        let sin_eta_squared = (cos_eta * -1.0 + 1.0) * (cos_eta + 1.0);
        if sin_eta_squared.value() > 0.0 {
            self.distance = t;
            self.cos_eta = cos_eta;
            self.sin_eta = sin_eta_squared.sqrt();
            self.solid_angle = share * (view.limb_squared - t_squared) * per_twice_distance_t;
        }
    }

    #[inline]
    fn find_arcs(&mut self, view: &PlanetView<T>, plate: &Plate<T>) {
        self.seen = Arc::from_linear_condition(plate.normal.z * self.cos_eta, plate.reach * self.sin_eta);
        // Surface normal at the ring: (t s - d nadir) / R.
        self.sun_level = plate.sun.z * (self.distance * self.cos_eta - view.relative_distance);
        self.lit =
            Arc::from_linear_condition(self.sun_level, view.sun_reach * (self.distance * self.sin_eta));
    }

    /// Adds the ring's reflected and infrared light.
    #[inline]
    fn add_to(&self, total: &mut [Tensors<T>; 2], plate: &Plate<T>, exitance: &SurfaceExitance<T>) {
        if matches!(self.seen, Arc::Empty) {
            return;
        }
        let (cos_eta, sin_eta, solid_angle) = (self.cos_eta, self.sin_eta, self.solid_angle);
        let t_sin_eta = self.distance * sin_eta;
        let slant = (self.sun_level, plate.sun.x * t_sin_eta, plate.sun.y * t_sin_eta);
        let all = EvenMoments::over(self.seen);
        let night = exitance.night_w_m2 * solid_angle;
        let day = exitance.day_constant_w_m2 * solid_angle;
        let day_cosine = exitance.day_cosine_w_m2 * solid_angle;
        let (slanted, infrared) = match self.lit {
            Arc::Empty => {
                total[1].add(sin_eta, cos_eta, &Weighted::flat_even(&all).scaled(night));
                return;
            }
            Arc::Full => {
                let slanted = Weighted::slanted_even(&all, slant);
                let infrared = Weighted::flat_even(&all).scaled(day).plus(day_cosine, &slanted);
                (slanted, infrared)
            }
            Arc::Part { half, cos_half, sin_half } => {
                let part = (half, cos_half, sin_half);
                let common = Moments::common(self.seen, part, plate.sun_ahead, plate.sun_azimuth);
                let slanted = Weighted::slanted(&common, slant);
                let infrared = Weighted::flat_even(&all)
                    .scaled(night)
                    .plus(day - night, &Weighted::flat(&common))
                    .plus(day_cosine, &slanted);
                (slanted, infrared)
            }
        };
        total[0].add(sin_eta, cos_eta, &slanted.scaled(exitance.reflected_cosine_w_m2 * solid_angle));
        total[1].add(sin_eta, cos_eta, &infrared);
    }
}
