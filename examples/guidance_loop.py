"""Guidance and the controlled plant in a loop, second by second: the boresight turns to nadir and follows it."""

import numpy as np
from fmu import Fmu
from picture import finish, folders, panels

dist, pictures = folders(__doc__)
STEP_S, STOP_S = 1.0, 900.0

# Output of the plant: input of Guidance, and back.
SENSED = {"position": "position", "velocity": "velocity", "estimate.q": "estimate.q", "estimate.rate": "estimate.rate",
          "sun.positionInertial": "sun.position", "sun.velocityInertial": "sun.velocity",
          "earth.positionInertial": "earth.position", "earth.velocityInertial": "earth.velocity"}
COMMANDED = ("command.kind", "command.q", "command.rate")


def boresight(q):
    """Body +Z in inertial axes."""
    x, y, z, s = q
    return np.array([2 * (x * z + s * y), 2 * (y * z - s * x), s * s - x * x - y * y + z * z])


# Where the plant's own guidance would be: -Y near the Sun, or Guidance would see a Sun out of its zone and go to safe hold.
orbit = {"orbit.trueAnomaly": 2.6, "guided.scienceRule": "fixedToSunLine"}
with Fmu(dist / "MomentumPlant.fmu", orbit) as guided:
    orbit["start.q"] = guided.get("attitude.q")

rows = []
with (
    Fmu(dist / "MomentumPlant.fmu", orbit | {"attitude.source": "controlled"}) as plant,
    Fmu(dist / "Guidance.fmu", {"pointing.scenario": "nadir", "hotPole.enabled": False}) as guidance,
):
    while plant.time < STOP_S:
        for output, name in SENSED.items():
            guidance.set(name, plant.get(output))
        guidance.step(STEP_S)
        for name in COMMANDED:
            plant.set(name, guidance.get(name))
        plant.step(STEP_S)
        nadir = -np.array(plant.get("position"))
        off = np.arccos(np.clip(boresight(plant.get("attitude.q")) @ nadir / np.linalg.norm(nadir), -1, 1))
        rows.append([plant.time, np.degrees(off), np.degrees(np.linalg.norm(plant.get("attitude.rate"))),
                     *(plant.get(f"wheel[{k}].momentum") for k in (1, 2, 3, 4))])
    reachable = guidance.get("target.reachable")

rows = np.array(rows)
reached = "within reach" if reachable else "held back by the Sun keep-in zone"
print(f"nadir {reached}, {rows[-1, 1]:.5f} deg off at {STOP_S:.0f} s, rate {rows[-1, 2]:.6f} deg/s")

figure, (off, rate, wheels) = panels(3, "time [s]")
off.plot(rows[:, 0], rows[:, 1])
off.set_ylabel("+Z off nadir [deg]")
rate.plot(rows[:, 0], rows[:, 2])
rate.set_ylabel("rate [deg/s]")
wheels.plot(rows[:, 0], rows[:, 3:], label=[f"wheel {k}" for k in (1, 2, 3, 4)])
wheels.set_ylabel("momentum [N.m.s]")
finish(figure, pictures / "guidance_loop.svg")
