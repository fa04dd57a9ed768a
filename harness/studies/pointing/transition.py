"""Paper 001: from downlink to the camera at nadir: the commanded curves of Figures 7 and 8."""

import sys

sys.path[0] += "/.."
import numpy as np

from pointing.downlink import EPOCH_S, SLEW_S, TRUE_ANOMALY_DEG
from pointing.flight import GEOMETRY, Flight, fmus
from study import agrees, brief, exact, main
from vectors import angle_rad, body_angles_deg, to_body, turn_rad

END_S = 1000
# Whether the camera's angle is commanded again every second after the slew, so that the Sun stays on -Y; otherwise the angle
# of the slew stays.
CASES = {"camera follows": True, "camera held": False}

REMARK = """\
Not reproduced: the paper prints neither the epoch nor the place on the orbit, and no numbers of the curves; so the
quaternions of Figure 7 and the azimuth and elevation of Mercury in Figure 8 cannot be compared, and its slew angle is
unspecified. Chosen: 2009-04-09 03:36 TDB, when the Earth is 33 deg from the Sun, and a true anomaly of 215 deg at the
start, where the paper's eight hours of downlink about apoapsis end; elsewhere on this orbit the slew is anything up to
180 deg. The paper puts azimuth -33 deg into the +X,+Y quadrant; by its own angles it is in the -X,-Y quadrant. The
estimated curves are those of control/transition. Camera follows: its angle is commanded again every second, so that
the Sun stays on -Y; camera held: the angle of 500 s stays, and the Sun's elevation takes up how nadir moves."""


def simulated(fmus, label):
    """The flight of a case."""
    guidance = fmus[1]

    def command(places):
        is_slewed = places.time_s >= SLEW_S
        # -Y at the Sun and the camera at nadir: the camera stands as far sunward of +Z as nadir does.
        camera_rad = np.pi / 2.0 - angle_rad(places.to_sun_m, -places.position_m)
        held = camera_rad if CASES[label] else camera_rad[SLEW_S]
        from_to = {
            "pointing.scenario": ("downlink", "gimbal"),
            "aimpoint.option": (None, "nadir"),
        }
        items = {
            name: np.where(
                is_slewed, guidance.item(name, after), guidance.item(name, before) if before else guidance.default(name)
            )
            for name, (before, after) in from_to.items()
        }
        return items | {"boresight.angle": np.where(is_slewed, held, guidance.default("boresight.angle"))}

    return Flight(fmus, label, EPOCH_S, TRUE_ANOMALY_DEG, END_S, {}, command)


def angles_deg(flight):
    """Azimuth and elevation in the body frame of Sun, Earth and Mercury, one row a second."""
    places = flight.places
    return [body_angles_deg(to_body(flight.q, to)) for to in (places.to_sun_m, places.to_earth, -places.position_m)]


def comparison(label, flight):
    """The rows of the table."""
    sun_deg, earth_deg, mercury_deg = angles_deg(flight)
    sun_azimuth_deg, sun_elevation_deg = np.abs(sun_deg).max(axis=0)
    azimuth_deg, elevation_deg = earth_deg[SLEW_S - 1, 0], np.abs(earth_deg[:SLEW_S, 1]).max()
    slew_deg = np.degrees(turn_rad(flight.q[SLEW_S - 1], flight.q[SLEW_S]))
    mdis_deg = np.degrees(flight.mdis_angle_rad[SLEW_S])
    constrained = int(flight.is_constrained.sum())

    def small(angle_deg):
        return f"{brief(angle_deg)} deg", agrees(angle_deg < 1e-9)

    rows = [
        ("Earth azimuth before the slew", "-33 deg", f"{azimuth_deg:.2f} deg", agrees(abs(azimuth_deg + 33.0) < 0.05)),
        ("Earth elevation before the slew, greatest", "0 deg", *small(elevation_deg)),
        ("Sun azimuth, greatest", "0 deg", *small(sun_azimuth_deg)),
        ("Sun elevation, greatest", "0 deg", *small(sun_elevation_deg)),
        ("slew angle", "not printed", f"{slew_deg:.3f} deg", "-"),
        (
            "Mercury azimuth / elevation after the slew",
            "not printed",
            "{:.2f} / {:.2f} deg".format(*mercury_deg[SLEW_S]),
            "-",
        ),
        (
            "camera angle after the slew",
            "in range (-50 to 40 deg)",
            f"{mdis_deg:.3f} deg",
            agrees(-50.0 <= mdis_deg <= 40.0),
        ),
        ("samples changed by a constraint", "none", str(constrained), agrees(constrained == 0)),
    ]
    return [[label, *row] for row in rows]


def draw(run, flight):
    """The figures of one flight; curves are interrupted at the slew."""
    time_s = np.insert(flight.places.time_s, SLEW_S, SLEW_S)

    def interrupted(values):
        return np.insert(values, SLEW_S, np.nan)

    title = "Commanded quaternion over the transition"
    drawing, panels = run.axes(title, "time [s]", [f"q{i}" for i in (1, 2, 3, 4)], 1.6)
    for i, axes in enumerate(panels):
        axes.plot(time_s, interrupted(flight.q[:, i]), label="commanded" if i == 0 else "_")
    run.figure("transition-quaternion.svg", drawing)
    title = "Sun, Earth and Mercury in the commanded body frame"
    drawing, panels = run.axes(title, "time [s]", ["azimuth [deg]", "elevation [deg]"])
    sun_deg, earth_deg, mercury_deg = angles_deg(flight)
    for i, axes in enumerate(panels):
        axes.plot(time_s, interrupted(mercury_deg[:, i]), label="Mercury")
        axes.plot(time_s, interrupted(earth_deg[:, i]), label="Earth")
        # Dashed, as it lies on one of the others all the time.
        axes.plot(time_s, interrupted(sun_deg[:, i]), "--", label="Sun")
    run.figure("transition-angles.svg", drawing)


def transition(run):
    labels = run.chosen(CASES)
    both = fmus(run)
    flights = run.all(labels, lambda label: simulated(both, label))
    run.line("Downlink until 500 s, then the camera at nadir (paper 001, Figures 7 and 8, commanded curves)\n")
    rows = [row for label, flight in zip(labels, flights) for row in comparison(label, flight)]
    run.table("case | quantity | paper | ours | verdict", rows)
    run.line(REMARK)
    own = "".join(f" | {body}_azimuth_deg | {body}_elevation_deg" for body in ("sun", "earth", "mercury"))
    cells = (
        [label, *(exact(it) for it in numbers), *flight.geometry(second)]
        for label, flight in zip(labels, flights)
        for second, numbers in enumerate(np.column_stack([*angles_deg(flight), np.degrees(flight.mdis_angle_rad)]))
    )
    run.csv("transition.csv", f"case{own} | mdis_angle_deg | {GEOMETRY}", cells)
    draw(run, flights[0])


main(transition)
