"""An own controller on the free plant: from the estimated attitude and rate to wheel torques, four times a second."""

import numpy as np
from fmu import Fmu
from picture import finish, folders, panels

dist, pictures = folders(__doc__)
BANDWIDTH, DAMPING, STEP_S, STOP_S = 0.03, 0.8, 0.25, 600.0
TARGET = np.append(np.sin(np.radians(15.0)) * np.array([0.6, 0.0, 0.8]), np.cos(np.radians(15.0)))  # a turn by 30 deg


def error(q):
    """Quaternion from the target's axes to the body's, its scalar not negative."""
    vector = TARGET[3] * q[:3] - q[3] * TARGET[:3] + np.cross(q[:3], TARGET[:3])
    scalar = TARGET @ q
    return np.sign(scalar) * vector, abs(scalar)


rows = []
with Fmu(dist / "MomentumPlant.fmu", {"attitude.source": "free", "start.q": [0, 0, 0, 1], "orbit.trueAnomaly": np.pi}) as plant:
    axes = np.array([plant.get(f"wheel[{k}].axis") for k in (1, 2, 3, 4)]).T
    share = np.linalg.pinv(axes)  # torque on the body to torque of each wheel
    inertia = np.reshape(plant.get("spacecraft.inertia"), (3, 3))
    at_start = np.array(plant.get("momentum.inertial"))
    for _ in range(int(STOP_S / STEP_S)):
        q, rate = np.array(plant.get("estimate.q")), np.array(plant.get("estimate.rate"))
        torque = -inertia @ (2 * BANDWIDTH**2 * error(q)[0] + 2 * DAMPING * BANDWIDTH * rate)
        # The body feels the opposite of what a motor gives its rotor.
        for k, motor in enumerate(share @ -torque, start=1):
            plant.set(f"wheel[{k}].torqueCommand", np.clip(motor, -0.08, 0.08))
        plant.step(STEP_S)
        off = np.degrees(2 * np.arctan2(np.linalg.norm(error(np.array(plant.get("attitude.q")))[0]), error(q)[1]))
        rows.append([plant.time, off, *(plant.get(f"wheel[{k}].momentum") for k in (1, 2, 3, 4))])
    gained = np.linalg.norm(np.array(plant.get("momentum.inertial")) - at_start)

rows = np.array(rows)
settled_s = rows[np.flatnonzero(rows[:, 1] > 0.1)[-1] + 1, 0]
print(f"a turn by 30 deg within 0.1 deg after {settled_s:.2f} s, {rows[-1, 1]:.6f} deg off at the end, "
      f"momentum gained {gained:.6f} N.m.s")

figure, (off, wheels) = panels(2, "time [s]")
off.semilogy(rows[:, 0], rows[:, 1])
off.set_ylabel("off the target [deg]")
wheels.plot(rows[:, 0], rows[:, 2:], label=[f"wheel {k}" for k in (1, 2, 3, 4)])
wheels.set_ylabel("momentum [N.m.s]")
finish(figure, pictures / "wheel_controller.svg")
