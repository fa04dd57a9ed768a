"""Papers 000 and 003: sunlight on the whole MESSENGER over the sphere, and its momentum against shade and panels alone."""

import sys

sys.path[0] += "/.."
import numpy as np

from study import DAY_S, brief, exact, main
from vectors import body_direction, norm

# Directions of the Sun over the sphere, this far apart, at Mercury's mean distance.
SPACING_DEG = 5
DISTANCE_M = 5.791e10
# Cells this far off a Sun on -Y: where the panels stand in the map, whatever the Sun does.
PANELS = {"panel[1].angle": np.radians(65.0), "panel[2].angle": np.radians(65.0)}
STOP_S = 10.0 * DAY_S
STEP_S = 600.0
# Impulses below this, in N s, are light at grazing rounding.
LEAST_N_S = 1e-6
# Guided flight without dumps: the threshold is above all that gathers.
GUIDED = {
    "attitude.source": "guided",
    "gravityGradient.enabled": False,
    "momentum.convention": "inertial",
    "dump.threshold": [1000.0] * 3,
}
NAMES = ["momentum.inertial", "force.solar", "sun.azimuth", "sun.elevation"]
# Surfaces that messenger.toml has as well; their backs it has not.
KNOWN = ("side +X", "side -X", "slant +X", "slant -X", "front", "top slant -X", "top slant +X", "top front", "+X", "-X")

REMARK = """\
Guidance keeps the Sun at no azimuth, where the shade keeps bus and boom dark: what is lit beyond shade and cells is the bell,
through the slit of 6 mm that the printed heights leave between the shade and its top. A strip of the bus' sides would be lit
from 10.5 deg of azimuth on."""


class Sphere:
    """Force and torque of sunlight for every direction of the Sun, one row a direction, row by row of elevation."""

    def __init__(self, fmu):
        elevations, azimuths = np.meshgrid(np.arange(-90, 91, SPACING_DEG), np.arange(-180, 180, SPACING_DEG), indexing="ij")
        self.azimuth_deg, self.elevation_deg = azimuths.ravel().astype(float), elevations.ravel().astype(float)
        sun_m = body_direction(np.radians(self.azimuth_deg), np.radians(self.elevation_deg)) * DISTANCE_M
        settings, names = PANELS | {"planet.present": False}, ["force.solar", "torque.solar"]
        stop_s, inputs = float(len(sun_m)), {"sun.positionBody": sun_m}
        found = fmu.simulate("the sphere", settings, names, stop_s, 1.0, inputs=inputs)
        self.force_n, self.torque_n_m = found["force.solar"][1:], found["torque.solar"][1:]

    def row(self, what, unit, sizes):
        """The row of the table for force or torque: ahead, the greatest, and where that is."""
        ahead = sizes[(self.azimuth_deg == 0.0) & (self.elevation_deg == 0.0)][0]
        # Of equal ones the last.
        at = len(sizes) - 1 - np.argmax(sizes[::-1])
        where = f"{self.azimuth_deg[at]:.0f} / {self.elevation_deg[at]:.0f}"
        return [what, f"{ahead * 1e6:.1f} {unit}", f"{sizes[at] * 1e6:.1f} {unit}", where]

    def draw(self, run, file, title, sizes):
        """The sphere as two discs, from -Y and from +Y, a degree of which is everywhere as long toward their middle."""
        from matplotlib.collections import PolyCollection

        titles = {"Sun on the side of -Y": -1.0, "Sun on the side of +Y": 1.0}
        drawing, panels = run.axes(title, "Sun toward X [deg]", ["Sun toward Z [deg]"] * 2, 4.0, is_row=True)
        for axes, (subtitle, side) in zip(panels, titles.items()):
            corners, is_here = self._cells(side)
            cells = PolyCollection(corners[is_here], array=sizes[is_here], cmap="YlGnBu", edgecolor="face")
            cells.set_clim(0.0, sizes.max())
            axes.add_collection(cells)
            axes.set(title=subtitle, aspect="equal", xlim=(-92.0, 92.0), ylim=(-92.0, 92.0))
        drawing.colorbar(cells, ax=panels, shrink=0.8, label=title.split(" at ")[0])
        run.figure(file, drawing)

    def _cells(self, side):
        """The corners around each direction on the disc of a side, in deg, cut at its rim, and whether it is on that side."""
        half_deg, corners, is_here = 0.5 * SPACING_DEG, [], False
        for right, up in ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)):
            elevation_deg = np.clip(self.elevation_deg + up * half_deg, -90.0, 90.0)
            x, y, z = body_direction(np.radians(self.azimuth_deg + right * half_deg), np.radians(elevation_deg)).T
            away_deg, aside = np.degrees(np.minimum(np.arccos(np.clip(y * side, -1.0, 1.0)), np.pi / 2.0)), np.hypot(x, z)
            scale = np.divide(away_deg, aside, out=np.zeros_like(aside), where=aside > 0.0)
            corners.append(np.column_stack([x * scale, z * scale]))
            is_here = is_here | (y * side > 1e-9)
        return np.stack(corners, axis=1), is_here


class Flight:
    """Ten days of guided flight, with the force on each surface that is reported by itself."""

    def __init__(self, fmu, label):
        plates = fmu.members("plate", ["force"])
        # Descriptions begin with the name of the surface.
        self.surfaces = [fmu.variables[f"{name}[1]"].description.split(": ")[0] for name in plates]
        found = fmu.simulate(label, GUIDED, [*NAMES, *plates], STOP_S, STEP_S)
        self.time_d, self.momentum_n_m_s = found.time_s / DAY_S, found["momentum.inertial"]
        self.sun_deg = np.degrees(np.column_stack([found["sun.azimuth"], found["sun.elevation"]]))
        self.impulse_n_s = impulse_n_s(found["force.solar"])
        self.forces_n = [found[name] for name in plates]


def impulse_n_s(force_n):
    """Sum of forces at equal steps, by the trapezoid rule."""
    return (force_n.sum(axis=0) - 0.5 * (force_n[0] + force_n[-1])) * STEP_S


def row(what, vector):
    return [what, *(f"{component:.6f}" for component in vector)]


def over_the_sphere(run, sphere):
    """Figures, CSV and table of the sphere."""
    force_un, torque_un_m = 1e6 * norm(sphere.force_n), 1e6 * norm(sphere.torque_n_m)
    sphere.draw(run, "off-sun-force.svg", "Force of sunlight [uN] at 0.387 AU", force_un)
    sphere.draw(run, "off-sun-torque.svg", "Torque of sunlight [uN.m] at 0.387 AU", torque_un_m)
    numbers = np.column_stack([sphere.azimuth_deg, sphere.elevation_deg, sphere.force_n, sphere.torque_n_m])
    header = "sun_azimuth_deg | sun_elevation_deg | force_x_n | force_y_n | force_z_n | torque_x_n_m | torque_y_n_m"
    run.csv("off-sun.csv", f"{header} | torque_z_n_m", (map(exact, own) for own in numbers))
    rows = [sphere.row("force", "uN", norm(sphere.force_n)), sphere.row("torque", "uN.m", norm(sphere.torque_n_m))]
    run.table("at 0.387 AU | Sun on -Y | greatest | there azimuth / elevation [deg]", rows)
    run.line("The panels stand where cells are 65 deg off a Sun on -Y.\n")


def by_surface(run, few, whole):
    """The impulse of sunlight on surfaces that shade and panels alone do not have."""
    difference_n_s, explained_n_s = whole.impulse_n_s - few.impulse_n_s, -few.impulse_n_s
    rows, seen = [], set()
    for name, force_n in zip(whole.surfaces, whole.forces_n):
        total_n_s = impulse_n_s(force_n)
        explained_n_s = explained_n_s + total_n_s
        is_known = name in KNOWN and name not in seen
        seen.add(name)
        if norm(total_n_s) > LEAST_N_S and not is_known:
            rows.append([*row(name, total_n_s), f"{100.0 * np.mean(norm(force_n) > 0.0):.1f} %"])
    run.line("Sunlight's impulse, body frame, on surfaces that shade and panels alone do not have [N.s]\n")
    if rows:
        run.table("surface | X | Y | Z | of the time lit", rows)
    else:
        run.line("none of them is lit")
    left = norm(explained_n_s - difference_n_s) / norm(difference_n_s)
    run.line(
        f"All surfaces of the whole less shade and panels: {norm(explained_n_s):.6f} N.s; what both flights differ by: "
        f"{norm(difference_n_s):.6f} N.s; apart {brief(left)} of it."
    )


def within_the_zone(run, few, whole):
    """Momentum of both spacecraft within the keep-in zone."""
    ends = few.momentum_n_m_s[-1], whole.momentum_n_m_s[-1]
    run.line("Inertial momentum after 10 days in the keep-in zone, guided, without dumps [N.m.s]\n")
    rows = [row("shade and panels", ends[0]), row("whole", ends[1]), row("difference", ends[1] - ends[0])]
    run.table("spacecraft | X | Y | Z", rows)
    widest_deg = np.abs(whole.sun_deg).max(axis=0)
    run.line(f"The Sun was up to {widest_deg[0]:.1f} deg in azimuth and {widest_deg[1]:.1f} deg in elevation off -Y.\n")
    by_surface(run, few, whole)
    run.line(REMARK)
    header = "time_d | few_x_n_m_s | few_y_n_m_s | few_z_n_m_s | whole_x_n_m_s | whole_y_n_m_s | whole_z_n_m_s"
    numbers = np.column_stack([few.time_d, few.momentum_n_m_s, whole.momentum_n_m_s])
    run.csv("off-sun-momentum.csv", header, (map(exact, own) for own in numbers))
    # The two lie on each other: their difference shows what they do not share.
    panels = {
        "the whole spacecraft": ("momentum [N.m.s]", whole.momentum_n_m_s),
        "the whole less shade and panels": ("momentum [mN.m.s]", 1e3 * (whole.momentum_n_m_s - few.momentum_n_m_s)),
    }
    labels = [label for label, _ in panels.values()]
    drawing, axes = run.axes("Inertial momentum within the keep-in zone", "time [d]", labels)
    for own, (title, (_, momentum)) in zip(axes, panels.items()):
        own.plot(whole.time_d, momentum, label=["X", "Y", "Z"])
        own.set_title(title)
    run.figure("off-sun-momentum.svg", drawing)


def off_sun(run):
    sphere = Sphere(run.fmu("MessengerLight.fmu"))
    few = Flight(run.fmu("MomentumPlant.fmu"), "shade and panels")
    whole = Flight(run.fmu("MessengerFull.fmu"), "whole")
    run.line("Sunlight on the whole MESSENGER (messenger-full.toml), its surfaces shadowing one another\n")
    over_the_sphere(run, sphere)
    within_the_zone(run, few, whole)


main(off_sun)
