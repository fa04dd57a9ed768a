//! Two circles on the sky: how far apart they are and how much of the Sun's one is free.

use core::f64::consts::PI;

use crate::numerics::scalar::{Scalar, atan, sin, tan};

/// Sun and planet as seen from the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Discs<T: Scalar = f64> {
    /// Angular radius of the Sun, rad.
    pub sun_radius_rad: T,
    /// Angular radius of the planet, rad.
    pub planet_radius_rad: T,
    /// Angle between their centres, rad.
    pub separation_rad: T,
    /// Whether the planet is nearer than the Sun.
    pub planet_in_front: bool,
}

impl<T: Scalar> Discs<T> {
    /// Angle by which the discs are apart, rad; negative while they overlap. Its roots are the outer edges of the
    /// penumbra.
    pub fn outer_gap_rad(&self) -> T {
        self.beyond_rad(self.planet_radius_rad + self.sun_radius_rad)
    }

    /// Angle by which the smaller disc sticks out of the larger, rad; negative in a total or annular eclipse. Its
    /// roots are the inner edges of the penumbra.
    pub fn inner_gap_rad(&self) -> T {
        self.beyond_rad((self.planet_radius_rad - self.sun_radius_rad).abs())
    }

    /// Separation beyond this angle, rad; half a turn where the planet is behind the Sun.
    fn beyond_rad(&self, reach_rad: T) -> T {
        if self.planet_in_front { self.separation_rad - reach_rad } else { T::constant(PI) }
    }

    /// The part of the Sun's disc outside the planet's, 0 to 1; absolute error below 1e-12.
    pub fn lit_fraction(&self) -> T {
        let (a, b, c) = (self.sun_radius_rad, self.planet_radius_rad, self.separation_rad);
        let (dark, full) = (T::constant(0.0), T::constant(1.0));
        if self.outer_gap_rad().value() >= 0.0 {
            return full;
        }
        // 1 - cos without cancellation: a cap of radius x has the solid angle 2 pi cap(x).
        let cap = |x: T| {
            let sine = sin(x * 0.5);
            sine * sine * 2.0
        };
        if self.inner_gap_rad().value() <= 0.0 {
            return if b.value() >= a.value() { dark } else { full - cap(b) / cap(a) };
        }
        // Spherical triangle Sun - planet - crossing of the limbs, by half-angle formulas.
        let half = (a + b + c) * 0.5;
        let (to_a, to_b, to_c) = ((b - a + c) * 0.5, (a - b + c) * 0.5, (a + b - c) * 0.5);
        let root = |x: T| if x.value() > 0.0 { x.sqrt() } else { dark };
        let at_sun_rad = T::polar_angle(root(sin(to_a) * sin(to_c)), root(sin(half) * sin(to_b))) * 2.0;
        let at_planet_rad = T::polar_angle(root(sin(to_b) * sin(to_c)), root(sin(half) * sin(to_a))) * 2.0;
        let tangents = tan(half * 0.5) * tan(to_a * 0.5) * tan(to_b * 0.5) * tan(to_c * 0.5);
        let excess = atan(root(tangents)) * 4.0;
        // The lens: a sector of each circle less the two triangles counted twice.
        let lens = (at_sun_rad * cap(a) + at_planet_rad * cap(b) - excess) * 2.0;
        let lit = full - lens / (cap(a) * (2.0 * PI));
        match lit.value() {
            value if value < 0.0 => dark,
            value if value > 1.0 => full,
            _ => lit,
        }
    }
}
