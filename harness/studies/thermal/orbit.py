"""One simulation of paper 004: MomentumPlant runs MESSENGER along its orbit of Mercury in the paper's attitude,
DisturbanceTorque gives the force of light and heat there."""

import math

import numpy as np

from vectors import angle_rad, norm, to_body

# Mercury's sidereal revolution by the paper's semi-major axis, and the spacecraft's by its Table 3.
MERCURY_YEAR_S = 7_600_714.0
ORBIT_S = 43_446.6
EFFECTS = ("solar", "albedo", "infrared", "thermal")

TRAJECTORY = {
    "guided.scienceRule": "fixedToSunLine",
    "guided.downlinkEvery": 0,
    "ephemeris.source": "kepler",
    "orbit.frame": "planetOrbit",
    "orbit.semiMajorAxis": 10_175_000.0,
    "eclipse.method": "off",
}


def fmus(run):
    """MomentumPlant and DisturbanceTorque."""
    return run.fmu("MomentumPlant.fmu"), run.fmu("DisturbanceTorque.fmu")


class Accelerations:
    """Accelerations along the orbit, one row a point: magnitudes by effect in m/s2, whether the Sun shines, and Mercury's true
    anomaly, counted on beyond 360 deg."""

    def __init__(self, fmus, true_anomaly_deg, duration_s, step_s, is_moving=True, belts=None):
        """Simulates with a planet that moves and lets no light pass as soon as the discs touch (the paper's numerical model), or
        stands still and casts a cylindrical shadow (its analytical one); with `belts` the planet is summed by cells as in the
        paper, without them by rings."""
        plant, disturbance = fmus
        label = f"Mercury at {true_anomaly_deg:g} deg"
        names = ["position", "heliocentric.position", "attitude.q", "mass"]
        start = TRAJECTORY | {"ephemeris.trueAnomaly": math.radians(true_anomaly_deg)}
        points = plant.simulate(label, start, names, duration_s, step_s)
        self.time_s, position_m, q = points.time_s, points["position"], points["attitude.q"]
        planet_m = points["heliocentric.position"] - position_m
        if not is_moving:
            planet_m, q = np.broadcast_to(planet_m[0], planet_m.shape), np.broadcast_to(q[0], q.shape)
        turned_rad = np.append(0.0, np.cumsum(angle_rad(planet_m[:-1], planet_m[1:])))
        self.true_anomaly_deg = true_anomaly_deg + np.degrees(turned_rad)

        inputs = {
            "sun.positionBody": to_body(q, -planet_m - position_m),
            "planet.positionBody": to_body(q, -position_m),
        }
        settings = {"eclipse.method": "cone" if is_moving else "cylinder"}
        if belts:
            settings |= {"planetLight.method": "cells", "planetLight.belts": belts}
        names = [*(f"force.{effect}" for effect in EFFECTS), "sun.litFraction"]
        stop_s = len(self.time_s) * step_s
        forces = disturbance.simulate(label, settings, names, stop_s, step_s, inputs=inputs)
        # The forces at the end of a step are those of the inputs at its beginning.
        vectors = [forces[name][1:] / points["mass"][:, None] for name in names[:4]]
        self.effects = np.column_stack([norm(vector) for vector in vectors])
        self.total, self.without_solar = norm(sum(vectors)), norm(sum(vectors[1:]))
        self.is_lit = forces["sun.litFraction"][1:] > 0.0

    def thermal_share(self):
        """The sum of albedo, infrared and recoil as a share of solar, where the Sun shines."""
        lit = self.effects[self.is_lit]
        return lit[:, 1:].sum(axis=1) / lit[:, 0]
