"""Paper 001: large slews of the controlled plant, with full wheels and with a wheel that fails.

Settled: the true attitude stays within 0.01 deg of the command. By the limits: accelerate, coast and decelerate about the
slew's axis within both limits, in closed form. Torque and momentum: greatest share of what a wheel can give and hold.
Wheels full: each starts at 99.5 % of its capacity, assumed, in the sense that the slew adds to, with dumps off; at 900 s a
dump to zero is requested, or dump.threshold is put back. Wheel 2 fails at half of the slew's time by the limits. There is
no keep-in zone here: the slews about X and Z take the Sun off the shade.
"""

import sys

sys.path[0] += "/.."
import math
import re
from dataclasses import dataclass

import numpy as np

from control.limits import SlewLimits
from study import brief, exact, flag, main, mark
from vectors import norm, rotation_rad, turned, unit

# The command jumps then.
SLEW_S = 10.0
SAMPLE_S = 0.5
# Error of the attitude below which a slew is settled.
SETTLED_DEG = 0.01
# An overshoot that counts as none, as a share of the angle.
OVERSHOOT = 1e-3
# Share of their capacity that wheels near it hold at the start, assumed, and when a dump ends the saturation.
NEARLY_FULL = 0.995
DUMP_S = 900.0
# A component of momentum that is never reached: no dumps by themselves.
NEVER_N_M_S = 1e6
# The wheel that fails, and after which share of the slew's ideal duration.
FAILED_WHEEL = 2
FAILED_SHARE = 0.5
BODY = [*("attitude.q", "attitude.rate", "momentum.body", "control.saturated", "dump.active", "dump.count")]

HEADER = (
    "case | angle [deg] | settled [s] | by the limits [s] | overshoot [deg] | off the axis [deg] | rate [deg/s] | torque | "
    "momentum | a wheel full [s] | verdict"
)


@dataclass
class Slew:
    """A slew about a body axis, and what happens besides: nothing, wheels that start nearly full until a dump is requested or
    the dump threshold is put back, or the motor of a wheel that fails."""

    label: str
    axis: tuple
    event: str | None = None

    @property
    def starts_full(self):
        return self.event in ("request", "threshold")


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
SLEWS = [
    Slew("about X", X),
    Slew("about Y", Y),
    Slew("about Z", Z),
    Slew("wheels full, dump", Y, "request"),
    Slew("wheels full, threshold", Y, "threshold"),
    Slew("wheel 2 fails", Y, "failure"),
]


class Plant:
    """The controlled plant: its limits, its wheels, and the attitude that its own guidance has at the start."""

    def __init__(self, fmu):
        own = ["control.bandwidth", "attitude.q", "dump.threshold"]
        wheels = [fmu.members("wheel", [name]) for name in ("axis", "maxTorque", "capacity")]
        found = fmu.simulate("start values", {}, [*SlewLimits.NAMES, *own, *sum(wheels, [])], 1.0, 1.0)
        self.limits = SlewLimits(*(found[name][0] for name in SlewLimits.NAMES))
        self.bandwidth_rad_s, self.q, self.threshold_n_m_s = (found[name][0] for name in own)
        axes, self.torques_n_m, self.capacities_n_m_s = (np.array([found[it][0] for it in names]) for names in wheels)
        self.axes = unit(axes)

    def events(self, slew, target_q, ideal_s):
        """Changes of settings: the time, the variable, its values before and from then on."""
        wheel = f"wheel[{FAILED_WHEEL}].failed"
        never = np.full(3, NEVER_N_M_S)
        events = {
            "request": ("dump.request", DUMP_S, False, True),
            "threshold": ("dump.threshold", DUMP_S, never, self.threshold_n_m_s),
            "failure": (wheel, SLEW_S + FAILED_SHARE * ideal_s, False, True),
        }
        return [("command.q", SLEW_S, self.q, target_q), *([events[slew.event]] if slew.event else [])]

    def start(self, slew, angle_rad):
        """At rest in the start attitude, which is held until the command jumps."""
        settings = {"attitude.source": "controlled", "command.source": "inputs", "start.q": self.q, "command.q": self.q}
        if slew.starts_full:
            settings["dump.threshold"] = [NEVER_N_M_S] * 3
            # The wheels take up the opposite of the body's momentum.
            held = -np.sign(self.axes @ slew.axis) * np.sign(angle_rad) * NEARLY_FULL * self.capacities_n_m_s
            settings |= {f"wheel[{k}].startMomentum": momentum for k, momentum in enumerate(held, 1)}
        return settings


class Flight:
    """A simulated slew, one row a sample, and what it shows."""

    def __init__(self, fmu, plant, slew, angle_rad, step_s):
        self.slew, self.angle_rad, self.plant = slew, angle_rad, plant
        axis, self.ideal_s = np.array(slew.axis), plant.limits.least_s(abs(angle_rad))
        target_q = turned(plant.q, axis * angle_rad)
        stop_s = 2400.0 if slew.starts_full else math.ceil(SLEW_S + 1.4 * self.ideal_s + 100.0)
        at_s = step_s * np.arange(math.ceil(stop_s / step_s) + 1)
        inputs = {
            name: np.where(at_s[:, None] >= from_s - 1e-9, np.atleast_1d(after), np.atleast_1d(before))
            for name, from_s, before, after in plant.events(slew, target_q, self.ideal_s)
        }
        wheels = [fmu.members("wheel", [name]) for name in ("torque", "momentum", "saturated")]
        names, every = [*BODY, *sum(wheels, [])], round(SAMPLE_S / step_s)
        start = plant.start(slew, angle_rad)
        found = fmu.simulate(slew.label, start, names, float(stop_s), step_s, every=every, inputs=inputs)
        self.found, self.time_s = found, found.time_s
        self.torque_n_m, self.momentum_n_m_s, is_full = (np.column_stack([found[it] for it in own]) for own in wheels)
        self.is_full = is_full == 1.0
        # Rotation from the attitude to the one after the slew; how far along the axis, negative beyond it.
        self.left_rad = rotation_rad(found["attitude.q"], target_q)
        self.ahead_rad = self.left_rad @ axis
        self.about_axis_rad_s = found["attitude.rate"] @ axis
        self._measure(axis)

    def _measure(self, axis):
        is_off = np.degrees(norm(self.left_rad)) > SETTLED_DEG
        settled = np.flatnonzero(is_off)[-1] + 1 if is_off.any() else 0
        # From the command's jump until the error stays small.
        self.settled_s = self.time_s[settled] - SLEW_S if settled < len(self.time_s) else None
        beyond_rad = -np.sign(self.angle_rad) * self.ahead_rad[self.time_s >= SLEW_S]
        self.overshoot_deg = np.degrees(beyond_rad.max(initial=0.0))
        self.across_deg = np.degrees(norm(self.left_rad - np.outer(self.ahead_rad, axis)).max())
        self.torque_share = np.max(np.abs(self.torque_n_m) / self.plant.torques_n_m)
        self.momentum_share = np.max(np.abs(self.momentum_n_m_s) / self.plant.capacities_n_m_s)
        self.full_s = self.time_s[self.is_full.any(axis=1)]
        self.is_limited = np.any(self.found["control.saturated"] == 1.0)

    def verdict(self):
        """Result of the slew."""
        if self.settled_s is None:
            return "does not settle"
        is_free = len(self.full_s) == 0 and not self.is_limited
        if self.slew.starts_full:
            if len(self.full_s) == 0 or SLEW_S + self.settled_s < DUMP_S:
                return "no saturation"
            is_recovered = not self.is_full[-1].any() and self.found.last("dump.count") == 1
            return "flagged, recovered by a dump" if is_recovered else "not recovered"
        if self.slew.event == "failure":
            if self.torque_n_m[-1, FAILED_WHEEL - 1] != 0.0:
                return f"wheel {FAILED_WHEEL} still gives torque"
            return f"survived with {len(self.plant.axes) - 1} wheels" if is_free else "saturates"
        if not is_free:
            return "saturates"
        if self.overshoot_deg > OVERSHOOT * abs(np.degrees(self.angle_rad)):
            return "overshoots"
        is_prompt = self.settled_s <= 1.05 * self.ideal_s + 3.0 / self.plant.bandwidth_rad_s
        return "settles, not saturated" if is_prompt else "settles late"

    def row(self):
        """The row of the table."""
        return [
            self.slew.label,
            f"{np.degrees(self.angle_rad):.1f}",
            "-" if self.settled_s is None else f"{self.settled_s:.1f}",
            f"{self.ideal_s:.1f}",
            brief(self.overshoot_deg),
            brief(self.across_deg),
            f"{np.degrees(np.abs(self.about_axis_rad_s).max()):.4f}",
            f"{100.0 * self.torque_share:.0f} %",
            f"{100.0 * self.momentum_share:.0f} %",
            f"{self.full_s[0]:.0f} to {self.full_s[-1]:.0f}" if len(self.full_s) > 0 else "never",
            self.verdict(),
        ]

    def history(self):
        """The rows of the CSV file with every sample."""
        found = self.found
        body = [self.time_s, found["attitude.q"], found["attitude.rate"], self.left_rad, found["momentum.body"]]
        flags = np.column_stack([found["control.saturated"], found["dump.active"]]) == 1.0
        for k, numbers in enumerate(np.column_stack(body)):
            wheels = zip(self.torque_n_m[k], self.momentum_n_m_s[k], self.is_full[k])
            own = [cell for torque, momentum, full in wheels for cell in (exact(torque), exact(momentum), flag(full))]
            dumps = int(found["dump.count"][k])
            yield [self.slew.label, *map(exact, numbers), *map(flag, flags[k]), dumps, *own]

    def draw(self, run):
        """Error angle, rate, torques and momenta of the wheels over time, with their limits."""
        labels = ["error [deg]", "rate [deg/s]", "torque [N m]", "momentum [N m s]"]
        labels += ["number"] if self.slew.starts_full else []
        title = f"Slew by {np.degrees(self.angle_rad):.0f} deg: {self.slew.label}"
        drawing, (error, rate, torque, momentum, *number) = run.axes(title, "time [s]", labels)
        time_s = self.time_s
        error.plot(time_s, np.degrees(norm(self.left_rad)), label="angle from the attitude commanded at 10 s")
        rate.plot(time_s, np.degrees(self.about_axis_rad_s), label="about the slew's axis")
        limit_deg_s = np.sign(self.angle_rad) * np.degrees(self.plant.limits.rate_rad_s)
        rate.plot([SLEW_S, time_s[-1]], [limit_deg_s] * 2, "--", label="control.slewRate")
        for axes, values, most, label in (
            (torque, self.torque_n_m, self.plant.torques_n_m.min(), "largest"),
            (momentum, self.momentum_n_m_s, self.plant.capacities_n_m_s.min(), "capacity"),
        ):
            axes.plot(time_s, values, label=[f"wheel {k}" for k in range(1, values.shape[1] + 1)])
            mark(axes, (-most, most), label)
            axes.set_ylim(-1.15 * most, 1.15 * most)
        if number:
            number[0].plot(time_s, self.is_full.sum(axis=1), label="wheels at capacity")
            number[0].plot(time_s, self.found["dump.active"], label="dump active")
        run.figure(f"slew-{self.slew.label.replace(', ', '-').replace(' ', '-').lower()}.svg", drawing)


def angle_rad(text):
    """An angle with its unit: 60deg, 1.05rad."""
    found = re.fullmatch(r"(.+?) *(deg|rad)", text)
    if not found:
        raise ValueError
    return float(found[1]) if found[2] == "rad" else math.radians(float(found[1]))


def slew(run):
    slews = run.chosen(SLEWS, lambda it: it.label)
    fmu = run.fmu("MessengerFull.fmu")
    plant = Plant(fmu)
    flights = run.all(slews, lambda it: Flight(fmu, plant, it, run.options.angle, run.options.step))
    run.line("Slews under the plant's own controller; the command jumps at 10 s\n")
    run.table_and_csv("slew.csv", HEADER, [flight.row() for flight in flights])
    limits_deg = np.degrees([plant.limits.rate_rad_s, plant.limits.acceleration_rad_s2])
    run.line(
        f"Limits: {limits_deg[0]:.4f} deg/s and {limits_deg[1]:.5f} deg/s2 (control.slewRate and control.slewAcceleration), "
        f"wheels of {plant.torques_n_m[0]:g} N m and {plant.capacities_n_m_s[0]:g} N m s."
    )
    run.remark()
    body = "case | time_s | q1 | q2 | q3 | q4 | rate_x_rad_s | rate_y_rad_s | rate_z_rad_s | left_x_rad | left_y_rad | left_z_rad"
    momentum = "momentum_x_n_m_s | momentum_y_n_m_s | momentum_z_n_m_s | torque_limited | dumping | dumps"
    numbers = range(1, len(plant.axes) + 1)
    wheels = "".join(f" | wheel{k}_torque_n_m | wheel{k}_momentum_n_m_s | wheel{k}_full" for k in numbers)
    cells = (row for flight in flights for row in flight.history())
    run.csv("slew-history.csv", f"{body} | {momentum}{wheels}", cells)
    for flight in flights:
        flight.draw(run)


ANGLE = {"type": angle_rad, "metavar": "ANGLE", "default": math.radians(60.0), "help": "60deg, 1.05rad (default: 60deg)"}
STEP = {"type": float, "metavar": "S", "default": SAMPLE_S, "help": "communication step, in s (default: 0.5)"}

main(slew, angle=ANGLE, step=STEP)
