"""Paper 001: from downlink to the camera at nadir under control: the estimated curves of Figures 7 and 8.

Settled: the estimated attitude stays within 0.1 deg and the rate within 0.005 deg/s of the command, assumed: the paper
gives no number. Its gains, its limits of rate and acceleration and the angle of its slew are not printed either; ours are
the shipped defaults (bandwidth 0.1 rad/s, damping 0.8, slew rate a quarter of what the wheels guarantee to hold, slew
acceleration half of the torque they guarantee, on the largest inertia), and nothing is fitted: epoch and place on the orbit
are those of pointing/transition. By the limits: accelerate, coast and decelerate through our angle, in closed form; so the
difference in time is that of angle and limits, not of the controller. Assumed noise: star tracker 5 arc seconds about each
axis at 10 Hz, gyros 0.005 deg a root hour and a drift of 0.1 deg/h in a day. The camera's angle is commanded once a second
and Guidance takes it as fixed in between, so that the commanded rate has 0.0015 deg/s about X that the sequence of commanded
attitudes lacks; the slew follows it, which is how far the Sun leaves -Y.
"""

import sys

sys.path[0] += "/.."
import numpy as np

from control.guided_loop import STEP, LoopFlight, open_loop
from control.limits import SlewLimits
from pointing.downlink import EPOCH_S, SLEW_S, TRUE_ANOMALY_DEG
from study import agrees, brief, exact, flag, main
from vectors import angle_rad, body_angles_deg, norm, to_body, turn_rad

END_S = 1500.0
# Errors of attitude and rate below which the spacecraft has settled, assumed: the paper says no number.
SETTLED_DEG = 0.1
SETTLED_DEG_S = 0.005
# Half of a unit of the 0 deg that the paper prints for the Sun's azimuth and elevation.
PRINTED_DEG = 0.5
# "The spacecraft response takes about 70-100 seconds to settle".
PAPER_S = (70.0, 100.0)
# Assumed: star tracker 5 arc seconds about each axis; gyros with a random walk of the angle of 0.005 deg a root hour, and of the
# bias of 0.1 deg/h in a day.
NOISE = {
    "plant.starTracker.noise": [np.radians(5.0 / 3600.0)] * 3,
    "plant.gyro.noise": np.radians(0.005 / 60.0),
    "plant.gyro.drift": np.radians(0.1) / 3600.0 / 294.0,
}
CASES = {"with noise": NOISE, "without noise": {}}

HISTORY = (
    "case | time_s | command_q1 | command_q2 | command_q3 | command_q4 | estimate_q1 | estimate_q2 | estimate_q3 | estimate_q4 | "
    "q1 | q2 | q3 | q4 | rate_x_rad_s | rate_y_rad_s | rate_z_rad_s | command_x_rad_s | command_y_rad_s | command_z_rad_s | "
    "sun_x_m | sun_y_m | sun_z_m | earth_x_m | earth_y_m | earth_z_m | planet_x_m | planet_y_m | planet_z_m | mdis_angle_deg | "
    "torque_limited | constrained"
)


def steer(time_s, read):
    """Command at a second: downlink, then the camera at nadir."""
    if time_s < SLEW_S:
        return {"guidance.pointing.scenario": "downlink"} if time_s == 0.0 else {}
    position_m = read("plant.position")
    # The camera stands as far sunward of +Z as nadir does with the Sun on -Y.
    sun_nadir_rad = angle_rad(read("plant.sun.positionInertial") - position_m, -position_m)
    camera = {"guidance.boresight.angle": np.pi / 2.0 - sun_nadir_rad}
    if time_s == SLEW_S:
        camera |= {"guidance.pointing.scenario": "gimbal", "guidance.aimpoint.option": "nadir"}
    return camera


def error_deg(flight):
    """Angles between the estimated and the commanded attitude."""
    return np.degrees(turn_rad(flight.estimate_q, flight.command_q))


def comparison(loop, label, flight):
    """The rows of the table."""
    limits = SlewLimits(*(loop.default(f"plant.{name}") for name in SlewLimits.NAMES))
    zone_deg = np.degrees([loop.default(f"guidance.keepIn.{name}") for name in ("azimuth", "elevation")])
    # The command of the sample at 500 s stands one second later.
    slew_rad = turn_rad(flight.command_q[SLEW_S], flight.command_q[SLEW_S + 1])
    rate_error_deg_s = np.degrees(norm(flight.rate_rad_s - flight.command_rate_rad_s))
    is_off = (error_deg(flight) > SETTLED_DEG) | (rate_error_deg_s > SETTLED_DEG_S)
    settled = np.flatnonzero(is_off)[-1] + 1
    settled_s = flight.time_s[settled] - SLEW_S if settled < len(is_off) else np.nan
    sun_deg = body_angles_deg(to_body(flight.estimate_q, flight.to_sun_m))[1:]
    outside = int(np.any(np.abs(sun_deg) > zone_deg, axis=1).sum())
    limited = int(np.sum(flight["plant.control.saturated"] == 1.0))
    angles_deg = np.degrees([limits.angle_rad(time_s) for time_s in PAPER_S])

    def off_sun(q):
        off_deg = np.degrees(angle_rad(np.array([0.0, -1.0, 0.0]), to_body(q, flight.to_sun_m)))[1:].max()
        return f"{brief(off_deg)} deg", agrees(off_deg < PRINTED_DEG)

    rows = [
        ("slew angle", "not printed", f"{np.degrees(slew_rad):.2f} deg", "-"),
        (
            "time to settle",
            "about 70 to 100 s",
            "does not" if np.isnan(settled_s) else f"{settled_s:.0f} s",
            agrees(PAPER_S[0] <= settled_s <= PAPER_S[1]),
        ),
        ("the same by the limits alone", "not printed", f"{limits.least_s(slew_rad):.0f} s", "-"),
        ("slew angles that take 70 to 100 s by the limits", "not printed", "{:.1f} to {:.1f} deg".format(*angles_deg), "-"),
        ("Sun from -Y in the estimated attitude, greatest", "0 deg: never leaves -Y", *off_sun(flight.estimate_q)),
        ("Sun from -Y in the true attitude, greatest", "0 deg", *off_sun(flight.q)),
        ("seconds outside the keep-in zone, estimated", "never", str(outside), agrees(outside == 0)),
        ("error in the last 300 s, greatest", "not printed", f"{brief(error_deg(flight)[-300:].max())} deg", "-"),
        ("seconds with torque at its limit", "not printed", str(limited), "-"),
    ]
    return [[label, *row] for row in rows]


def history(label, flight):
    """The rows of the CSV file with everything of every second."""
    numbers = np.column_stack(
        [
            *(flight.time_s, flight.command_q, flight.estimate_q, flight.q, flight.rate_rad_s, flight.command_rate_rad_s),
            *(flight.to_sun_m, flight.to_earth_m, flight.to_planet_m, np.degrees(flight["guidance.gimbal.angle"])),
        ]
    )
    flags = zip(flight["plant.control.saturated"], flight["guidance.constraint.sunKeepIn"])
    for row, own in zip(numbers, flags):
        yield [label, *map(exact, row), *map(flag, own)]


def draw(run, label, flight):
    """The figures of one flight, from the first command on; the command is interrupted where it jumps."""
    time_s, jump = flight.time_s[1:], SLEW_S
    # The sign that leaves each quaternion closest to the commanded one at the end.
    last = flight.command_q[-1]
    command_q, estimate_q = (
        q[1:] * np.where(q[1:] @ last < 0.0, -1.0, 1.0)[:, None] for q in (flight.command_q, flight.estimate_q)
    )
    title = f"Commanded and estimated quaternion over the transition, {label}"
    drawing, panels = run.axes(title, "time [s]", [*(f"q{i}" for i in (1, 2, 3, 4)), "error [deg]"], 1.6)
    for i, axes in enumerate(panels[:4]):
        commanded = np.insert(command_q[:, i], jump, np.nan)
        axes.plot(np.insert(time_s, jump, time_s[jump]), commanded, label="_" if i else "commanded")
        axes.plot(time_s, estimate_q[:, i], "--", label="_" if i else "estimated")
    panels[4].plot(time_s, error_deg(flight)[1:], label="estimated to commanded")
    run.figure("transition-quaternion.svg", drawing)
    title = f"Sun, Earth and Mercury in the estimated body frame, {label}"
    drawing, panels = run.axes(title, "time [s]", ["azimuth [deg]", "elevation [deg]"])
    # The Sun is dashed, as it lies on one of the others all the time.
    bodies = {"Mercury": (flight.to_planet_m, "-"), "Earth": (flight.to_earth_m, "-"), "Sun": (flight.to_sun_m, "--")}
    for name, (to_m, style) in bodies.items():
        angles_deg = body_angles_deg(to_body(flight.estimate_q, to_m))[1:]
        for i, axes in enumerate(panels):
            axes.plot(time_s, angles_deg[:, i], style, label=name)
    run.figure("transition-angles.svg", drawing)


def transition(run):
    labels = run.chosen(CASES)
    loop, step_s = open_loop(run), run.options.step
    place = (EPOCH_S, TRUE_ANOMALY_DEG, END_S, step_s, steer)
    flights = run.all(labels, lambda label: LoopFlight(loop, label, CASES[label], *place))
    run.line("Downlink until 500 s, then the camera at nadir (paper 001, Figures 7 and 8), under the plant's own controller\n")
    rows = [row for label, flight in zip(labels, flights) for row in comparison(loop, label, flight)]
    run.table_and_csv("transition.csv", "case | quantity | paper | ours | verdict", rows)
    run.remark()
    cells = (row for label, flight in zip(labels, flights) for row in history(label, flight))
    run.csv("transition-history.csv", HISTORY, cells)
    draw(run, labels[0], flights[0])


main(transition, step=STEP)
