"""An own body and controller in numpy around DisturbanceTorque: pointing at the Sun and what the wheels collect."""

import numpy as np
from fmu import Fmu
from picture import finish, folders, panels

dist, pictures = folders(__doc__)

SUN_M = np.array([0.0, -4.5e10, 0.0])  # in the inertial frame, so that -Y faces it when q is (0, 0, 0, 1)
BANDWIDTH, DAMPING, STEP_S, STOP_S = 0.05, 0.8, 1.0, 1800.0


def matrix(q):
    """Body from inertial axes."""
    e, s = q[:3], q[3]
    cross = np.array([[0, -e[2], e[1]], [e[2], 0, -e[0]], [-e[1], e[0], 0]])
    return (s * s - e @ e) * np.eye(3) + 2 * np.outer(e, e) - 2 * s * cross


def turned(q, angle):
    """The attitude after a turn about body axes."""
    half = np.linalg.norm(angle) / 2
    d = np.append(np.sinc(half / np.pi) * angle / 2, np.cos(half))
    vector = d[3] * q[:3] + q[3] * d[:3] - np.cross(d[:3], q[:3])
    return np.append(vector, d[3] * q[3] - d[:3] @ q[:3])


options = {"solar.flux": 1361.0, "planet.present": False, "spacecraft.centerOfMass": [0.0, 0.0, -0.0254]}
q, rate, wheels = turned(np.array([0.0, 0.0, 0.0, 1.0]), np.radians([10.0, 0.0, 0.0])), np.zeros(3), np.zeros(3)
rows = []
with Fmu(dist / "DisturbanceTorque.fmu", options) as light:
    inertia = np.reshape(light.get("spacecraft.inertia"), (3, 3))
    for k in range(int(STOP_S / STEP_S)):
        light.set("sun.positionBody", matrix(q) @ SUN_M)
        light.step(STEP_S)
        disturbance, sunlight = np.array(light.get("torque.total")), light.get("torque.solar[1]")
        command = -inertia @ (BANDWIDTH**2 * 2 * np.sign(q[3]) * q[:3] + 2 * DAMPING * BANDWIDTH * rate)
        gyroscopic = np.cross(rate, inertia @ rate + wheels)
        rate = rate + STEP_S * np.linalg.solve(inertia, disturbance + command - gyroscopic)
        wheels = wheels - STEP_S * command
        q = turned(q, STEP_S * rate)
        rows.append([(k + 1) * STEP_S, 2 * np.degrees(np.arcsin(np.linalg.norm(q[:3]))), *disturbance, *wheels])

rows = np.array(rows)
print(f"off the Sun {rows[-1, 1] * 3600:.3f} arcsec, X torque {rows[-1, 2]:.6e} N.m ({sunlight:.6e} of sunlight, the rest of heat), "
      f"X momentum in the wheels {rows[-1, 5]:.6f} N.m.s after {STOP_S:.0f} s")

figure, (off, torque, momentum) = panels(3, "time [s]")
off.semilogy(rows[:, 0], rows[:, 1])
off.set_ylabel("attitude error [deg]")
torque.plot(rows[:, 0], rows[:, 2] * 1e6)
torque.set_ylabel("X torque [uN.m]")
momentum.plot(rows[:, 0], rows[:, 5:8], label=["x", "y", "z"])
momentum.set_ylabel("wheels [N.m.s]")
finish(figure, pictures / "own_controller.svg")
