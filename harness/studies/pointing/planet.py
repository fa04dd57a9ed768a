"""The planet as an ellipsoid: where lines meet it, what is seen of it, where its limb is.

Lengths along its axes in units of its radii make it the unit sphere. All functions take one row a point.
"""

import numpy as np

from vectors import norm, unit


class Planet:
    """Radii along its axes, pole and rotation, from the parameters of Guidance."""

    NAMES = [f"planet.{name}" for name in ("radii", "poleRightAscension", "poleDeclination", "primeMeridian", "rotationRate")]

    def __init__(self, recording):
        self.radii_m = recording["planet.radii"][0]
        self.pole_rad = [recording[name][0] for name in self.NAMES[1:3]]
        self.meridian_rad, self.rate_rad_s = (recording[name][0] for name in self.NAMES[3:])

    def at(self, epoch_s):
        """The ellipsoid at epochs past J2000 TDB."""
        (sin_a, sin_d), (cos_a, cos_d) = np.sin(self.pole_rad), np.cos(self.pole_rad)
        pole = np.array([cos_d * cos_a, cos_d * sin_a, sin_d])
        # The ascending node of its equator on that of EME2000.
        node = np.array([-sin_a, cos_a, 0.0])
        turned_rad = np.asarray(self.meridian_rad + self.rate_rad_s * epoch_s)[..., None]
        x = node * np.cos(turned_rad) + np.cross(pole, node) * np.sin(turned_rad)
        axes = np.stack([x, np.cross(pole, x), np.broadcast_to(pole, x.shape)], axis=-1)
        return Ellipsoid(axes, self.radii_m)


class Ellipsoid:
    """The planet at one moment, or at one a row, by vectors in EME2000 from its centre."""

    def __init__(self, axes, radii_m):
        # Its x, y and z axis are columns.
        self.axes, self.radii_m = axes, radii_m

    def inertial(self, vectors):
        """EME2000 components of components along its axes."""
        return np.einsum("...ij,...j->...i", self.axes, vectors)

    def along_axes(self, vectors):
        """Components along its axes."""
        return np.einsum("...ji,...j->...i", self.axes, vectors)

    def in_radii(self, vectors):
        """Components along its axes in units of its radii."""
        return self.along_axes(vectors) / self.radii_m

    def surface(self, directions):
        """The surface points in these directions from the centre."""
        return directions / norm(self.in_radii(directions))[..., None]

    def beyond_limb(self, surface, from_m):
        """x . r in units of the radii, less 1: 0 at limb points, positive where the surface is seen (paper 001, eq 21)."""
        return np.einsum("...i,...i->...", self.in_radii(surface), self.in_radii(from_m)) - 1.0

    def hit(self, from_m, directions):
        """First points of lines on the surface, and whether they meet it; other lines come nearest to it there, in units of the radii."""
        origin, ray = self.in_radii(from_m), self.in_radii(directions)
        along, square = -np.einsum("...i,...i->...", origin, ray), np.einsum("...i,...i->...", ray, ray)
        inside = along * along - square * (np.einsum("...i,...i->...", origin, origin) - 1.0)
        distance = (along - np.sqrt(np.maximum(inside, 0.0))) / square
        return from_m + directions * distance[..., None], (inside >= 0.0) & (along > 0.0)

    def height_over_limb_m(self, from_m, directions):
        """The limb points below lines and the heights of the lines over them along the radius; not a number where there is none.

        Of a line's points the one whose radius meets the surface at the limb (eq 21), by bisection: from the spacecraft on
        the radius turns toward the line's direction, and its end goes from the visible side over the limb.
        """

        rho, ray = self.in_radii(from_m), self.in_radii(directions)

        def beyond(distance):
            return np.einsum("...i,...i->...", unit(rho + ray * distance[..., None]), rho) - 1.0

        far = 2.0 * norm(from_m)
        near, is_found = np.zeros_like(far), beyond(far) < 0.0
        for _ in range(200):
            middle = 0.5 * (near + far)
            is_seen = beyond(middle) > 0.0
            near, far = np.where(is_seen, middle, near), np.where(is_seen, far, middle)
        points = from_m + directions * near[..., None]
        with np.errstate(invalid="ignore"):
            # A line to the centre meets no limb.
            foot_m = self.surface(points)
        return foot_m, np.where(is_found, norm(points) - norm(foot_m), np.nan)

    def great_ellipse(self, normal, count):
        """Surface points in the plane through the centre normal to `normal`, once round."""
        return self.surface(circle(normal, count))

    def limb(self, from_m, count):
        """The limb, once round: the circle on the unit sphere whose tangents meet at the spacecraft."""
        rho = self.in_radii(from_m)
        square = rho @ rho
        points = rho / square + circle(rho, count) * np.sqrt(1.0 - 1.0 / square)
        return self.inertial(points * self.radii_m)

    def terminator_limb_points(self, from_m, sun_m):
        """The limb points on the terminator, the plane normal to the Sun's direction: changes of sign of eq 21 along it."""
        rho, ellipse = self.in_radii(from_m), unit(self.in_radii(circle(sun_m, 720)))
        after, is_seen = np.roll(ellipse, -1, axis=0), ellipse @ rho > 1.0
        at = np.flatnonzero(is_seen != np.roll(is_seen, -1))
        is_first = is_seen[at, None]
        seen, hidden = np.where(is_first, ellipse[at], after[at]), np.where(is_first, after[at], ellipse[at])
        for _ in range(60 if len(at) > 0 else 0):
            middle = unit(seen + hidden)
            is_seen = (middle @ rho > 1.0)[:, None]
            seen, hidden = np.where(is_seen, middle, seen), np.where(is_seen, hidden, middle)
        return self.inertial(seen * self.radii_m)


def circle(normal, count):
    """Unit vectors across `normal`, once round."""
    u = unit(np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))]))
    v = unit(np.cross(normal, u))
    angle_rad = 2.0 * np.pi * np.arange(count)[:, None] / count
    return u * np.cos(angle_rad) + v * np.sin(angle_rad)
