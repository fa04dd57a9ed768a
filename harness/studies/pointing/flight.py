"""Flights of paper 001: MomentumPlant moves along its orbit, Guidance is told once a second where it is, and commands."""

import numpy as np

from pointing.planet import Planet
from study import DAY_S, exact
from vectors import body_angles_deg, body_direction, to_body, to_inertial, turned

# 2009-04-06 00:00 TDB past J2000, the start of the default flight.
DEFAULT_EPOCH_S = 292_248_000.0
# Columns of `Flight.geometry`: EME2000, positions from the planet's centre.
GEOMETRY = "time_s | epoch_s | q1 | q2 | q3 | q4 | x_m | y_m | z_m | vx_m_s | vy_m_s | vz_m_s | sun_x_m | sun_y_m | sun_z_m"

SEEN = ["position", "velocity", "heliocentric.position", "attitude.q", "earth.azimuth", "earth.elevation"]
COMMANDED = ["command.q", "command.rate", "gimbal.angle", "target.reachable", "scan.active"]
CONSTRAINTS = ["constraint.sunKeepIn", "constraint.hotPole", "constraint.clamped"]


def fmus(run):
    """MomentumPlant and Guidance."""
    return run.fmu("MomentumPlant.fmu"), run.fmu("Guidance.fmu")


class Places:
    """Positions of spacecraft, Sun and Earth, once a second; EME2000."""

    def __init__(self, seen, epoch_s):
        self.time_s, self.epoch_s = seen.time_s, epoch_s + seen.time_s
        self.position_m, self.velocity_m_s = seen["position"], seen["velocity"]
        # From the spacecraft to the Sun, and to the Earth as a unit vector.
        self.to_sun_m = -seen["heliocentric.position"]
        self.to_earth = to_inertial(seen["attitude.q"], body_direction(seen["earth.azimuth"], seen["earth.elevation"]))

    def __getitem__(self, rows):
        """The places of some seconds."""
        chosen = object.__new__(Places)
        chosen.__dict__ = {name: values[rows] for name, values in self.__dict__.items()}
        return chosen

    @property
    def sun_m(self):
        """From the planet's centre to the Sun."""
        return self.to_sun_m + self.position_m


class Flight:
    """Commands of Guidance once a second, and the positions there."""

    def __init__(self, fmus, label, epoch_s, true_anomaly_deg, seconds, parameters, command):
        """Simulates; `command` gives the inputs of Guidance for all places, one row a second."""
        plant, guidance = fmus
        start, stop_s = {"start.epoch": epoch_s}, seconds + 1.0
        moving = start | {"orbit.trueAnomaly": np.radians(true_anomaly_deg)}
        # The plant's orbit does not depend on commands: it is simulated first.
        places = Places(plant.simulate(label, moving, SEEN, stop_s, 1.0), epoch_s)
        motion = {"position": places.position_m, "velocity": places.velocity_m_s}
        names = [*COMMANDED, *CONSTRAINTS, *Planet.NAMES]
        found = guidance.simulate(label, start | parameters, names, stop_s, 1.0, inputs=motion | command(places))
        self.places, self.planet = places[:-1], Planet(found)
        # What was commanded a second ago has turned by its constant rate since then.
        self.rate_rad_s = found["command.rate"][1:]
        self.q = turned(found["command.q"][1:], -self.rate_rad_s)
        self.mdis_angle_rad = found["gimbal.angle"][1:]
        self.is_reachable, self.is_scanning = found["target.reachable"][1:] == 1.0, found["scan.active"][1:] == 1.0
        self.is_constrained = np.any([found[name][1:] == 1.0 for name in CONSTRAINTS], axis=0)

    def inertial(self, body):
        """EME2000 directions of a body direction."""
        return to_inertial(self.q, body)

    def sun_angles_deg(self):
        """Azimuths and elevations of the Sun in the body frame."""
        return body_angles_deg(to_body(self.q, self.places.to_sun_m))

    def geometry(self, second):
        """The cells of GEOMETRY."""
        place = self.places[second]
        numbers = [place.time_s, place.epoch_s, *self.q[second], *place.position_m, *place.velocity_m_s, *place.sun_m]
        return [exact(number) for number in numbers]


def days(number):
    """The epoch so many days after the start of the default flight."""
    return DEFAULT_EPOCH_S + number * DAY_S
