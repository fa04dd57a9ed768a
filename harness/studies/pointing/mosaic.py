"""Paper 001: footprints of inertial, body and planet-fixed scans on the planet's disc.

Covered: of the disc as seen midway, by solid angle, what some frame shows. Overlap: of the surface in a frame what the
next one in time shows too. Rates and the Sun's angles in the body frame: the greatest; constrained: seconds at which a
constraint changed the command or no scan was active. Frames of the inertial and the planet-fixed scan are taken at rest,
those of the body scan along the moving rows. Both axes of a scan begin together, as the paper gives an axis no delay.
The fields are those published of MDIS; the one along +Z, rates, durations and pauses are assumed.
"""

import sys

sys.path[0] += "/.."
import itertools
from dataclasses import dataclass

import numpy as np

from pointing.disc import View, draw_views
from pointing.flight import GEOMETRY, Flight, days, fmus
from study import brief, exact, main
from vectors import angle_rad, norm, to_body, to_inertial, unit

TRUE_ANOMALY_DEG = 175.0
# Side of the lattice of directions over the disc, and over a field of view.
DISC = 240
FIELD = 60
# Points along a side of a frame's outline.
SIDE = 12


@dataclass
class Motion:
    """Motion of one axis: it moves by `step` (deg or m), holds, and moves on or back."""

    step: float
    duration_s: float
    pause_s: float
    segments: int
    is_reversed: bool

    @property
    def cycle_s(self):
        return self.duration_s + self.pause_s

    def start(self):
        """Start of the scan so that its positions lie about zero."""
        return -0.5 * (self.step if self.is_reversed else self.step * (self.segments + 1))

    def inputs(self, axis, rate, unit):
        """The inputs of Guidance for this axis, 0 to 2."""
        values = {
            rate: unit * self.step / self.duration_s,
            "duration": self.duration_s,
            "pause": self.pause_s,
            "segments": self.segments,
            "reverse": self.is_reversed,
        }
        return {f"scan.{name}[{axis + 1}]": value for name, value in values.items()}


@dataclass
class Scan:
    """A scan of one camera, along rows (`fast`) and from row to row (`slow`). In each motion along a row the first frame is
    taken `first_s` after its beginning, the others `every_s` apart."""

    title: str
    # Name and side of the square field; the fields are those published of MDIS, the one along +Z is assumed.
    camera: str
    field_deg: float
    day: float
    fast: Motion
    slow: Motion
    first_s: float
    every_s: float = 0.0
    frames_per_motion: int = 1
    # The camera's angle from +Z; None for an instrument along +Z.
    mdis_deg: float | None = None
    is_planet_fixed: bool = False

    def inputs(self, guidance, place, planet):
        """Commands from the first place on."""
        nadir, degree = unit(-place.position_m), np.radians(1.0)
        if self.mdis_deg is None:
            # Rows about Y, from row to row about X; the boresight begins where the scan turns it to +Z midway.
            about_y, about_x = degree * self.fast.start(), degree * self.slow.start()
            boresight = [np.sin(about_y), -np.sin(about_x) * np.cos(about_y), np.cos(about_x) * np.cos(about_y)]
            items = {
                "pointing.scenario": "generic",
                "boresight.option": "vector",
                "aimpoint.option": "nadir",
                "bodyRoll.option": "vector",
                "externalRoll.option": "sun",
                "scan.frame": "body",
            }
            values = {"boresight.vector": boresight, "bodyRoll.vector": [0.0, -1.0, 0.0]}
            values |= self.fast.inputs(1, "rate", degree) | self.slow.inputs(0, "rate", degree)
        else:
            axes = planet.at(place.epoch_s).axes if self.is_planet_fixed else np.eye(3)
            # The two axes that lie most across the line of sight.
            slow, fast, _ = np.argsort(np.abs(nadir @ axes), kind="stable")
            start_m = np.zeros(3)
            start_m[fast], start_m[slow] = self.fast.start(), self.slow.start()
            option, frame = "planetCentered", "inertialTranslation"
            if self.is_planet_fixed:
                # About the point below the spacecraft.
                start_m -= (nadir @ axes) * planet.radii_m[0]
                option, frame = "planetFixed", "planetTranslation"
            items = {"pointing.scenario": "gimbal", "aimpoint.option": option, "scan.frame": frame}
            values = {"boresight.angle": degree * self.mdis_deg, "aimpoint.position": start_m}
            values |= self.fast.inputs(fast, "speed", 1.0) | self.slow.inputs(slow, "speed", 1.0)
        return values | {name: guidance.item(name, item) for name, item in items.items()}

    def simulated(self, fmus, label):
        """The scan's flight."""
        epoch_s, seconds = days(self.day), max(it.cycle_s * it.segments for it in (self.fast, self.slow))
        # A flight of one second shows where the planet's axes are.
        planet = Flight(fmus, label, epoch_s, TRUE_ANOMALY_DEG, 0, {}, lambda places: {}).planet

        def command(places):
            inputs = self.inputs(fmus[1], places[0], planet)
            return {name: np.tile(value, (len(places.time_s), 1)) for name, value in inputs.items()}

        return Flight(fmus, label, epoch_s, TRUE_ANOMALY_DEG, seconds, {}, command)

    def frames(self, flight):
        """The frames; none is taken while the axis from row to row moves."""
        begins_s = (motion * self.fast.cycle_s + self.first_s for motion in range(self.fast.segments))
        times_s = (begin_s + k * self.every_s for begin_s in begins_s for k in range(self.frames_per_motion))
        return [Frame(self, flight, int(time_s)) for time_s in times_s if time_s < len(flight.q)]


SCANS = {
    "inertial": Scan(
        title="MDIS wide-angle, inertial scan",
        camera="MDIS wide-angle",
        field_deg=10.5,
        day=12.0,
        mdis_deg=-19.0,
        fast=Motion(2.0e6, 60.0, 40.0, 6, True),
        slow=Motion(1.4e6, 60.0, 140.0, 3, False),
        first_s=90.0,
    ),
    "body": Scan(
        title="+Z instrument, body scan",
        camera="+Z instrument",
        field_deg=1.5,
        day=6.0,
        fast=Motion(15.0, 120.0, 20.0, 3, True),
        slow=Motion(1.3, 10.0, 130.0, 3, False),
        first_s=10.0,
        every_s=10.0,
        frames_per_motion=12,
    ),
    "planet": Scan(
        title="MDIS narrow-angle, planet-fixed scan",
        camera="MDIS narrow-angle",
        field_deg=1.5,
        day=12.0,
        mdis_deg=-19.0,
        is_planet_fixed=True,
        fast=Motion(3.7e5, 40.0, 20.0, 10, True),
        slow=Motion(3.7e5, 40.0, 80.0, 5, False),
        first_s=50.0,
    ),
}


class Frame:
    """A square field of view at one second; points of the planet are along its axes, in m."""

    def __init__(self, scan, flight, second):
        self.second, self.place, self.q = second, flight.places[second], flight.q[second]
        self.ellipsoid, self.rate_rad_s = flight.planet.at(self.place.epoch_s), flight.rate_rad_s[second]
        self.mdis_deg = 0.0 if scan.mdis_deg is None else np.degrees(flight.mdis_angle_rad[second])
        sine, cosine = np.sin(np.radians(self.mdis_deg)), np.cos(np.radians(self.mdis_deg))
        self.half_tangent = np.tan(np.radians(0.5 * scan.field_deg))
        # Boresight, across toward +X, across sunward; body frame.
        self.axes = np.array([[0.0, -sine, cosine], [1.0, 0.0, 0.0], [0.0, -cosine, -sine]])

    def directions(self, x, y):
        """EME2000 directions at -1 to 1 across the field."""
        sides = self.half_tangent * np.stack(np.broadcast_arrays(x, y), axis=-1)
        return to_inertial(self.q, self.axes[0] + sides @ self.axes[1:])

    def on_planet_m(self, x, y):
        """Points at which directions meet the planet or come nearest to it."""
        points, is_hit = self.ellipsoid.hit(self.place.position_m, self.directions(x, y))
        return self.ellipsoid.along_axes(points), is_hit

    def outline_m(self):
        """The outline once round."""
        step = 2.0 * np.arange(SIDE) / SIDE - 1.0
        one = np.ones(SIDE)
        x, y = np.append(step, [one, -step, -one]), np.append(-one, [step, one, -step])
        return self.on_planet_m(np.append(x, -1.0), np.append(y, -1.0))[0]

    def surface_m(self):
        """Points of the surface in the field, evenly over it, and the share of the field that they fill."""
        at = (2.0 * np.arange(FIELD) + 1.0) / FIELD - 1.0
        points_m, is_hit = self.on_planet_m(*(it.ravel() for it in np.meshgrid(at, at)))
        return points_m[is_hit], is_hit.mean()

    def shows(self, surface_m):
        """Whether surface points are in the field and seen."""
        points = self.ellipsoid.inertial(surface_m)
        depth, x, y = (to_body(self.q, points - self.place.position_m) @ self.axes.T).T
        limit = self.half_tangent * depth
        is_inside = (depth > 0.0) & (np.abs(x) <= limit) & (np.abs(y) <= limit)
        return is_inside & (self.ellipsoid.beyond_limb(points, self.place.position_m) > 0.0)


def disc_lattice(flight):
    """Surface points evenly over the disc seen midway, along the planet's axes."""
    place = flight.places[len(flight.q) // 2]
    view, ellipsoid = View(place), flight.planet.at(place.epoch_s)
    at = np.tan(np.radians(view.radius_deg(ellipsoid))) * ((2.0 * np.arange(DISC) + 1.0) / DISC - 1.0)
    x, y = (it.reshape(-1, 1) for it in np.meshgrid(at, at))
    points, is_hit = ellipsoid.hit(place.position_m, view.nadir + view.right * x + view.up * y)
    return ellipsoid.along_axes(points[is_hit])


class Mosaic:
    """A scan that was simulated, with its frames, and of each frame the share of its surface that the next one shows too."""

    def __init__(self, fmus, label):
        self.label, self.scan = label, SCANS[label]
        self.flight = self.scan.simulated(fmus, label)
        self.frames = self.scan.frames(self.flight)
        shares = [after.shows(before.surface_m()[0]).mean() for before, after in itertools.pairwise(self.frames)]
        self.overlaps = np.array(shares)

    def row(self):
        """The row of the table."""
        lattice = disc_lattice(self.flight)
        times_shown = sum(frame.shows(lattice).astype(int) for frame in self.frames)
        shown, twice = np.sum(times_shown >= 1), np.sum(times_shown >= 2)
        rate_deg_s = np.degrees(norm(self.flight.rate_rad_s))
        sun_deg = np.abs(self.flight.sun_angles_deg()).max(axis=0)
        constrained = np.sum(self.flight.is_constrained | ~self.flight.is_scanning)
        return [
            self.label,
            f"{self.scan.camera}, {self.scan.field_deg} deg",
            str(len(self.frames)),
            f"{100.0 * shown / len(lattice):.1f} %",
            f"{100.0 * twice / shown:.1f} %",
            f"{100.0 * self.overlaps.min():.1f} % to {100.0 * self.overlaps.max():.1f} %",
            f"{rate_deg_s.max():.4f} deg/s",
            f"{max(rate_deg_s[frame.second] for frame in self.frames):.4f} deg/s",
            f"{brief(sun_deg[0])} / {sun_deg[1]:.2f} deg",
            f"{constrained} of {len(self.flight.q)} s",
        ]

    def cells(self):
        """The rows of the CSV file."""
        for number, (frame, overlap) in enumerate(zip(self.frames, np.append(self.overlaps, np.nan)), 1):
            x, y, z = frame.on_planet_m(0.0, 0.0)[0]
            numbers = [
                frame.mdis_deg,
                np.degrees(np.arctan2(z, np.hypot(x, y))),
                np.degrees(np.arctan2(y, x)),
                frame.surface_m()[1],
                overlap,
                np.degrees(norm(frame.rate_rad_s)),
                np.degrees(angle_rad(frame.directions(0.0, 0.0), -frame.place.position_m)),
            ]
            cells = [exact(it) for it in (self.scan.field_deg, *numbers)]
            yield [self.label, number, *cells, *self.flight.geometry(frame.second)]

    def draw(self, run):
        """Footprints on the disc as seen midway, numbered in time beside the line that joins their middles."""
        place = self.flight.places[len(self.flight.q) // 2]
        view, ellipsoid = View(place), self.flight.planet.at(place.epoch_s)
        outlines = [view.point_deg(ellipsoid.inertial(frame.outline_m())) for frame in self.frames]
        middles = view.point_deg(ellipsoid.inertial([frame.on_planet_m(0.0, 0.0)[0] for frame in self.frames]))

        def draw(axes):
            for k, outline in enumerate(outlines):
                axes.plot(*outline.T, color="C2", label="frames" if k == 0 else "_")
            axes.plot(*middles.T, "--", color="C3", label="middles in sequence")
            for number, at in enumerate(middles, 1):
                axes.annotate(str(number), at, xytext=(4.0, 4.0), textcoords="offset points")
            half_deg = 1.08 * max(np.abs(outlines).max(), view.radius_deg(ellipsoid))
            axes.set(xlim=(-half_deg, half_deg), ylim=(-half_deg, half_deg))

        title = f"{len(self.frames)} frames, {self.scan.field_deg:.2f} deg field, numbered in time"
        draw_views(run, f"mosaic-{self.label}.svg", self.scan.title, [(title, view, ellipsoid, draw)])


def mosaic(run):
    labels = run.chosen(SCANS)
    both = fmus(run)
    mosaics = run.all(labels, lambda label: Mosaic(both, label))
    run.line('Mosaics by scans with reversals and pauses (paper 001, "Scan patterns")\n')
    header = "scan | camera | frames | disc covered | of that twice | overlap with the next | greatest rate | at frames"
    run.table(f"{header} | Sun azimuth / elevation | constrained", [it.row() for it in mosaics])
    run.remark()
    own = "scan | frame | field_deg | mdis_angle_deg | latitude_deg | longitude_deg | on_disc | overlap_with_next"
    cells = (row for it in mosaics for row in it.cells())
    run.csv("mosaic.csv", f"{own} | rate_deg_s | off_nadir_deg | {GEOMETRY}", cells)
    for it in mosaics:
        it.draw(run)


main(mosaic)
