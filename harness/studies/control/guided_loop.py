"""MessengerLoop: Guidance and the controlled plant, each with the other's outputs at every step."""

import numpy as np

from loop import SAMPLE_S, Loop
from fmu import Failure
from vectors import to_body, turned

# What Guidance starts with before it has a command.
HELD = {"guidance.start.q": [0.0, 0.0, 0.0, 1.0], "guidance.ephemeris.source": "inputs"}
# Option of the studies: their communication step.
STEP = {"type": float, "metavar": "S", "default": SAMPLE_S, "help": "communication step, in s (default: 1)"}

NAMES = [
    *(f"plant.{name}" for name in ("position", "sun.positionInertial", "earth.positionInertial")),
    *(f"plant.{name}" for name in ("attitude.q", "attitude.rate", "estimate.q", "estimate.valid", "sun.sensedValid")),
    *(f"plant.{name}" for name in ("control.saturated", "dump.count")),
    *(f"guidance.{name}" for name in ("command.q", "command.rate", "command.kind", "mode.active", "link.available")),
    *(f"guidance.{name}" for name in ("gimbal.angle", "constraint.sunKeepIn")),
]


def open_loop(run):
    """The system, for steps of a second or a whole part of it."""
    step_s = run.options.step
    if abs(round(SAMPLE_S / step_s) * step_s - SAMPLE_S) > 1e-9:
        raise Failure(f"--step: found {step_s:g} s, allowed: a second or a whole part of it")
    return Loop(run.dist("MessengerLoop.ssp"))


def start_settings(q, rate_rad_s, time_s):
    """The plant's attitude and rate at the start from the command that stands `time_s` later."""
    return {"plant.start.q": turned(q, -time_s * rate_rad_s), "plant.start.rate": rate_rad_s}


class LoopFlight:
    """A flight in the loop, one row a second; directions and attitudes from EME2000."""

    def __init__(self, loop, label, settings, epoch_s, true_anomaly_deg, stop_s, step_s, steer):
        """Simulates; it begins in the attitude and at the rate that is commanded first."""
        settings = HELD | settings | {"plant.orbit.trueAnomaly": np.radians(true_anomaly_deg)}
        settings |= {"guidance.start.epoch": epoch_s, "plant.start.epoch": epoch_s}
        first = loop.simulate(label, settings, NAMES, SAMPLE_S, SAMPLE_S, steer)
        start = start_settings(first.last("guidance.command.q"), first.last("guidance.command.rate"), SAMPLE_S)
        self.recording = loop.simulate(label, settings | start, NAMES, stop_s, step_s, steer)
        self.time_s, self.q = self.recording.time_s, self["plant.attitude.q"]
        self.rate_rad_s, self.command_rate_rad_s = self["plant.attitude.rate"], self["guidance.command.rate"]
        self.command_q, self.estimate_q = self["guidance.command.q"], self["plant.estimate.q"]
        position_m = self["plant.position"]
        # From the spacecraft.
        self.to_planet_m = -position_m
        self.to_sun_m = self["plant.sun.positionInertial"] - position_m
        self.to_earth_m = self["plant.earth.positionInertial"] - position_m

    def __getitem__(self, name):
        return self.recording[name]

    def sun_body_m(self):
        """The Sun in the true body frame."""
        return to_body(self.q, self.to_sun_m)
