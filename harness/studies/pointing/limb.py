"""Paper 001: limb points at azimuths and on the terminator, and a scan of the limb's height.

Heights are found from the commanded attitude alone: of the points of the line along +Z the one whose radius meets the
ellipsoid at the limb (eq 21), its height along the radius; the residual is that less the commanded height. Radii of
2440.53, 2439.28 and 2438.26 km along the planet's own axes. Azimuths are right-handed about up from downtrack, an
assumption: the paper does not print their sense.
"""

import sys

sys.path[0] += "/.."
import numpy as np

from pointing.disc import View, draw_views
from pointing.flight import GEOMETRY, Flight, days, fmus
from study import brief, exact, flag, main, mark
from vectors import across, angle_rad, norm, unit

# Assumed, close to the planet's figure; the default is a sphere: so that the limb is that of a triaxial ellipsoid.
TRIAXIAL = {"planet.radii": [2_440_530.0, 2_439_280.0, 2_438_260.0]}
PLUS_Z = np.array([0.0, 0.0, 1.0])
# Six days in, orbit and terminator lie in nearly one plane: the Sun is across nadir and limb all the way round.
EPOCH_S = days(6.0)
TRUE_ANOMALY_DEG = 170.0
AZIMUTHS_DEG = {f"azimuth {azimuth_deg} deg": float(azimuth_deg) for azimuth_deg in range(0, 360, 45)}
SCAN, TERMINATOR = "height scan", "terminator"
SCAN_AZIMUTH_DEG = 60.0
HEIGHT_RATE_M_S = 1000.0
SCAN_S = 300
# 25 days in, the orbit passes over noon and midnight.
TERMINATOR_EPOCH_S = days(25.0)
ORBIT_S = 43_200
# Time between samples of that orbit.
EVERY_S = 60
# Bounds of the Sun keep-in zone (eqs 23 and 24).
ZONE_DEG = np.array([15.0, 13.0])


def generic(fmus, label, azimuth_deg, height_rate_m_s, seconds):
    """A flight whose +Z is on the limb at an azimuth, or rises over it at a rate."""

    def command(places):
        count = np.ones(len(places.time_s))
        scenario = fmus[1].item("pointing.scenario", "limbGeneric")
        return {
            "pointing.scenario": scenario * count,
            "limb.azimuth": np.radians(azimuth_deg) * count,
            "limb.heightRate": height_rate_m_s * count,
        }

    return Flight(fmus, label, EPOCH_S, TRUE_ANOMALY_DEG, seconds, TRIAXIAL, command)


def terminator(fmus):
    """A flight whose +Z is on the limb at the terminator, without constraints: on this orbit the Sun would leave its zone."""
    unconstrained = TRIAXIAL | {f"{name}.enabled": False for name in ("keepIn", "hotPole", "monitor")}
    scenario = fmus[1].item("pointing.scenario", "limbTerminator")

    def command(places):
        return {"pointing.scenario": np.full(len(places.time_s), scenario)}

    return Flight(fmus, TERMINATOR, TERMINATOR_EPOCH_S, 0.0, ORBIT_S, unconstrained, command)


class Found:
    """Crossings of the limb by +Z, found from the attitude alone, one row a second: limb points from the planet's centre, heights
    over them, angles from nadir and of the Sun in the body frame."""

    def __init__(self, flight, every_s=1):
        places, self.boresight = flight.places[::every_s], flight.inertial(PLUS_Z)[::every_s]
        ellipsoid = flight.planet.at(places.epoch_s)
        self.foot_m, self.height_m = ellipsoid.height_over_limb_m(places.position_m, self.boresight)
        self.fixed_m = ellipsoid.along_axes(self.foot_m)
        self.sun_deg = flight.sun_angles_deg()[::every_s]
        self.off_nadir_deg = np.degrees(angle_rad(self.boresight, -places.position_m))


def print_azimuths(run, flights):
    """Limb points at azimuths: flights of one second by azimuth."""
    rows, cells, marks = [], [], []
    for azimuth_deg, flight in flights.items():
        found, place = Found(flight), flight.places[0]
        ellipsoid, view = flight.planet.at(place.epoch_s), View(place)
        found_deg = view.azimuth_deg(found.boresight[0]) % 360.0
        off_nadir_deg, height_m, sun_deg = found.off_nadir_deg[0], found.height_m[0], found.sun_deg[0]
        is_reachable = flight.is_reachable[0]
        rows.append(
            [
                f"{azimuth_deg:.0f} deg",
                f"{found_deg:.9f} deg",
                f"{off_nadir_deg:.4f} deg",
                f"{brief(height_m, sign='+')} m",
                f"{brief(sun_deg[0])} / {sun_deg[1]:+.3f} deg",
                "on the limb" if is_reachable and not flight.is_constrained[0] else "constrained",
            ]
        )
        numbers = [azimuth_deg, found_deg, off_nadir_deg, height_m, *sun_deg]
        cells.append([*map(exact, numbers), flag(is_reachable), *flight.geometry(0)])
        marks.append((view.point_deg(found.foot_m[0]), f"{azimuth_deg:.0f}"))
    header = "azimuth | of +Z | off nadir | height residual | Sun azimuth / elevation in the body frame | "
    run.table(header, rows)
    own = "azimuth_deg | found_azimuth_deg | off_nadir_deg | height_m | sun_azimuth_deg | sun_elevation_deg | reachable"
    run.csv("limb.csv", f"{own} | {GEOMETRY}", cells)

    def draw(axes):
        axes.plot(*np.array([at for at, _ in marks]).T, "o", label="limb points commanded")
        for at, text in marks:
            axes.annotate(text, 1.11 * at, ha="center", va="center")

    title = f"true anomaly {TRUE_ANOMALY_DEG:g} deg, labels: azimuth [deg]"
    draw_views(run, "limb.svg", "Generic limb points", [(title, view, ellipsoid, draw)])


def print_scan(run, flight):
    """The scan of the limb's height."""
    found, time_s = Found(flight), flight.places.time_s
    commanded_m = HEIGHT_RATE_M_S * time_s
    moved_m = np.append(0.0, np.cumsum(norm(np.diff(found.fixed_m, axis=0))))
    run.line(f"\nScan of the limb's height at azimuth {SCAN_AZIMUTH_DEG:g} deg, {HEIGHT_RATE_M_S / 1e3:.0f} km/s:\n")
    run.table(
        "time | commanded height | height residual | off nadir | limb point's way on the surface | "
        "Sun azimuth / elevation in the body frame",
        [
            [
                f"{time_s[k]:.0f} s",
                f"{commanded_m[k] / 1e3:.0f} km",
                f"{brief(found.height_m[k] - commanded_m[k], sign='+')} m",
                f"{found.off_nadir_deg[k]:.4f} deg",
                f"{moved_m[k] / 1e3:.1f} km",
                f"{brief(found.sun_deg[k, 0])} / {found.sun_deg[k, 1]:+.3f} deg",
            ]
            for k in range(0, len(time_s), 60)
        ],
    )
    run.csv(
        "limb-scan.csv",
        f"commanded_height_m | height_m | sun_azimuth_deg | sun_elevation_deg | {GEOMETRY}",
        ([*map(exact, (commanded_m[k], found.height_m[k], *found.sun_deg[k])), *flight.geometry(k)] for k in range(len(time_s))),
    )
    first = flight.places[0]
    ellipsoid = flight.planet.at(first.epoch_s)
    track = np.array([View(flight.places[k]).direction_deg(it) for k, it in enumerate(found.boresight)])
    middle = 0.5 * (track[0] + track[-1])

    def draw(axes):
        axes.plot(*track.T, label="track of +Z over the scan")
        axes.plot(*track[::60].T, "o", label="every 60 s")

    def draw_close(axes):
        draw(axes)
        for minute, at in enumerate(track[::60]):
            axes.annotate(f"{minute * 60.0 * HEIGHT_RATE_M_S / 1e3:.0f}", at + [0.12, -0.05])
        axes.set(xlim=(middle[0] - 0.8, middle[0] + 0.8), ylim=(middle[1] - 0.8, middle[1] + 0.8))

    panels = [("the disc", View(first), ellipsoid, draw), ("the limb, heights in km", View(first), ellipsoid, draw_close)]
    draw_views(run, "limb-scan.svg", "Scan of the limb's height", panels)


class Minute:
    """One sample of the flight on the terminator, with the limb points along it; the nearer is that nearer to the downtrack
    direction, or None."""

    def __init__(self, flight, found, number):
        self.second = number * EVERY_S
        self.place = flight.places[self.second]
        ellipsoid = flight.planet.at(self.place.epoch_s)
        self.solutions_m = ellipsoid.terminator_limb_points(self.place.position_m, self.place.sun_m)
        self.boresight, self.is_reachable = found.boresight[number], flight.is_reachable[self.second]
        self.nearer_m, self.height_m, self.azimuth_deg = None, np.nan, np.nan
        if len(self.solutions_m) > 0:
            downtrack = across(self.place.velocity_m_s, unit(self.place.position_m))
            to_m = self.solutions_m - self.place.position_m
            self.nearer_m = self.solutions_m[np.argmax(to_m @ downtrack / norm(to_m))]
            self.height_m, self.azimuth_deg = found.height_m[number], View(self.place).azimuth_deg(self.boresight)


def print_terminator(run, flight):
    """The limb point on the terminator once round an orbit: how many there are, and which is taken."""
    found = Found(flight, EVERY_S)
    minutes = [Minute(flight, found, number) for number in range(len(found.height_m))]
    sun_deg, total = found.sun_deg, len(minutes)
    counts = np.array([len(it.solutions_m) for it in minutes])
    two, none = ([it for it in minutes if (it.nearer_m is None) == is_none] for is_none in (False, True))
    wrong = sum(it.is_reachable == (it.nearer_m is None) for it in minutes)
    off_aim_rad = [angle_rad(it.boresight, it.nearer_m - it.place.position_m) for it in two]
    off_nadir_rad = [angle_rad(it.boresight, -it.place.position_m) for it in none]
    is_inside = np.all(np.abs(sun_deg) <= ZONE_DEG, axis=1)

    def share(number):
        return f"{100.0 * number / total:.1f} % ({number} of {total} minutes)"

    run.line("\nLimb on the terminator over an orbit that passes over noon and midnight, no constraints:\n")
    run.table(
        "terminator limb | ",
        [
            ["two solutions", share(np.sum(counts == 2))],
            ["none: +Z to the planet's centre", share(np.sum(counts == 0))],
            ["target.reachable says which", f"{total - wrong} of {total}"],
            ["+Z off the solution nearer to downtrack, greatest", f"{brief(max(off_aim_rad))} rad"],
            ["+Z off the centre where there is none, greatest", f"{brief(max(off_nadir_rad))} rad"],
            ["height residual, greatest", f"{brief(max(abs(it.height_m) for it in two))} m"],
            ["Sun elevation in the body frame", f"{sun_deg[:, 1].min():+.1f} to {sun_deg[:, 1].max():+.1f} deg"],
            ["Sun azimuth, greatest", f"{brief(np.abs(sun_deg[:, 0]).max())} deg"],
            ["Sun within its zone of 15 by 13 deg", share(is_inside.sum())],
        ],
    )
    own = "solutions | reachable | azimuth_deg | height_m | sun_azimuth_deg | sun_elevation_deg"
    cells = (
        [
            len(it.solutions_m),
            flag(it.is_reachable),
            *map(exact, (it.azimuth_deg, it.height_m, *sun_deg[k])),
            *flight.geometry(it.second),
        ]
        for k, it in enumerate(minutes)
    )
    run.csv("limb-terminator.csv", f"{own} | {GEOMETRY}", cells)
    hours = [it.place.time_s / 3600.0 for it in minutes]
    labels = ["solutions", "azimuth [deg]", "Sun elevation [deg]"]
    title = "Limb on the terminator over one orbit"
    drawing, (number, azimuth, elevation) = run.axes(title, "time since periapsis [h]", labels)
    number.plot(hours, counts)
    number.set(ylim=(-0.2, 2.2), yticks=(0, 1, 2))
    azimuths_deg = [it.azimuth_deg for it in minutes]
    azimuth.plot(hours, azimuths_deg, ".", label="of the commanded limb point, from downtrack")
    elevation.plot(hours, sun_deg[:, 1], label="in the body frame")
    mark(elevation, (-ZONE_DEG[1], ZONE_DEG[1]), "keep-in zone")
    run.figure("limb-terminator.svg", drawing)
    draw_discs(run, flight, two, none)


def draw_discs(run, flight, two, none):
    """The disc where there are two limb points on the terminator, and where there is none: far out, so that the disc is small,
    and in the middle of the gap."""

    def panel(it):
        view = View(it.place)

        def draw(axes):
            points_deg = view.point_deg(it.solutions_m)
            axes.plot(*points_deg.T, "o", markersize=8.0, fillstyle="none", label="limb points on the terminator")
            axes.plot(*view.direction_deg(it.boresight), "o", label="commanded +Z")

        what = "two" if len(it.solutions_m) > 0 else "none, the terminator is hidden"
        title = f"{it.place.time_s / 3600.0:.2f} h after periapsis: {what}"
        return title, view, flight.planet.at(it.place.epoch_s), draw

    far = next(it for it in two if it.place.time_s >= 10_800.0)
    panels = [panel(far), panel(none[len(none) // 2])]
    draw_views(run, "limb-discs.svg", "Limb points on the terminator", panels)


def limb(run):
    labels = run.chosen([*AZIMUTHS_DEG, SCAN, TERMINATOR])
    both = fmus(run)

    def simulated(label):
        if label == TERMINATOR:
            return terminator(both)
        if label == SCAN:
            return generic(both, label, SCAN_AZIMUTH_DEG, HEIGHT_RATE_M_S, SCAN_S)
        return generic(both, label, AZIMUTHS_DEG[label], 0.0, 1)

    flights = dict(zip(labels, run.all(labels, simulated)))
    run.line("Limb pointing (paper 001, eqs 20 to 22 and Figure 6)\n")
    at_azimuths = {AZIMUTHS_DEG[label]: flight for label, flight in flights.items() if label in AZIMUTHS_DEG}
    if at_azimuths:
        print_azimuths(run, at_azimuths)
    if SCAN in flights:
        print_scan(run, flights[SCAN])
    if TERMINATOR in flights:
        print_terminator(run, flights[TERMINATOR])
    run.remark()


main(limb)
