"""The planet's disc as the spacecraft sees it: angles from nadir, limb, night side, terminator."""

import numpy as np

from vectors import across, norm, unit

POINTS = 720


class View:
    """A view toward nadir from one place: downtrack to the right, the orbit's left up."""

    def __init__(self, place):
        self.place, self.nadir = place, unit(-place.position_m)
        self.right = unit(across(place.velocity_m_s, self.nadir))
        # Seen along nadir: right, up and the direction to the viewer are right-handed.
        self.up = np.cross(self.right, self.nadir)

    def direction_deg(self, directions):
        """Directions: the angle from nadir laid off at its position angle, to the right and up."""
        sides = np.stack([directions @ self.right, directions @ self.up], axis=-1)
        side = norm(sides)
        angle_deg = np.degrees(np.arctan2(side, directions @ self.nadir))
        return sides * np.divide(angle_deg, side, out=np.zeros_like(side), where=side > 0.0)[..., None]

    def point_deg(self, points_m):
        """Points by their vectors from the planet's centre."""
        return self.direction_deg(points_m - self.place.position_m)

    def azimuth_deg(self, direction):
        """Azimuth of a direction about the local vertical, right-handed about up from downtrack."""
        return np.degrees(np.arctan2(direction @ self.up, direction @ self.right))

    def radius_deg(self, ellipsoid):
        """Angular radius of the disc."""
        return norm(self.point_deg(ellipsoid.limb(self.place.position_m, POINTS))).max()

    def draw(self, axes, ellipsoid):
        """Draws limb, terminator and night side."""
        from_m, sun_m = self.place.position_m, self.place.sun_m
        limb, terminator = ellipsoid.limb(from_m, POINTS), ellipsoid.great_ellipse(sun_m, POINTS)
        seen = stretch(terminator, ellipsoid.beyond_limb(terminator, from_m) > 0.0)
        night = stretch(limb, limb @ sun_m <= 0.0)
        if len(night) > 0 and len(seen) > 0:
            is_nearer = norm(night[-1] - seen[0]) <= norm(night[-1] - seen[-1])
            night = np.concatenate([night, seen if is_nearer else seen[::-1]])
        axes.fill(*self.point_deg(night).T, color="0.85")
        axes.plot(*self.point_deg(np.append(limb, limb[:1], axis=0)).T, label="limb")
        axes.plot(*self.point_deg(seen).T, "--", label="terminator, night side shaded")
        half_deg = 1.25 * self.radius_deg(ellipsoid)
        axes.set(aspect="equal", xlim=(-half_deg, half_deg), ylim=(-half_deg, half_deg))


def draw_views(run, file, title, panels):
    """Writes a figure with one panel a view: title, view, ellipsoid, and a function that draws into the axes."""
    labels = ["left of the track [deg]"] * len(panels)
    drawing, axes = run.axes(title, "downtrack of nadir [deg]", labels, 9.0 / len(panels) - 0.5, is_row=True)
    for own, (subtitle, view, ellipsoid, draw) in zip(axes, panels):
        view.draw(own, ellipsoid)
        draw(own)
        own.set_title(subtitle)
    drawing.legend(*axes[0].get_legend_handles_labels(), loc="upper right", ncols=4, frameon=False)
    run.figure(file, drawing)


def stretch(curve, passes):
    """The points of a closed curve that pass, in order, beginning after a gap."""
    begins = np.flatnonzero(passes & ~np.roll(passes, 1))
    first = begins[0] if len(begins) > 0 else 0
    return np.roll(curve, -first, axis=0)[np.roll(passes, -first)]
