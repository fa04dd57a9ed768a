"""An own ephemeris: positions and velocities from a table, here half an ellipse from the Earth to Mercury."""

import numpy as np
from fmu import Fmu
from picture import finish, folders, panels

dist, pictures = folders(__doc__)
plant = dist / "MomentumPlant.fmu"
AU_M, SUN_M3_S2 = 1.495978707e11, 1.32712440018e20

# The table, as SPICE or a mission's trajectory file would give it: time, position and velocity in EME2000 from the Sun.
perihelion_m, aphelion_m = 0.387 * AU_M, 1.0 * AU_M
a, e = (aphelion_m + perihelion_m) / 2, (aphelion_m - perihelion_m) / (aphelion_m + perihelion_m)
b, n = a * np.sqrt(1 - e * e), np.sqrt(SUN_M3_S2 / a**3)
E = np.linspace(np.pi, 2 * np.pi, 500)  # eccentric anomaly, from aphelion to perihelion
time_s = (E - e * np.sin(E) - np.pi) / n
zero, speed = np.zeros_like(E), n / (1 - e * np.cos(E))
position_m = np.column_stack([a * (np.cos(E) - e), b * np.sin(E), 0 * E])
velocity_m_s = np.column_stack([-a * np.sin(E), b * np.cos(E), 0 * E]) * (n / (1 - e * np.cos(E)))[:, None]

# The first row is also the start: the plant looks at its orbit before the first step.
options = {"orbit.center": "sun", "orbit.source": "inputs", "guided.downlinkEvery": 0}
options |= {"orbit.position": position_m[0], "orbit.velocity": velocity_m_s[0]}
rows = []
with Fmu(plant, options) as spacecraft:
    for k in range(len(E)):
        rows.append((time_s[k] / 86400, spacecraft.get("sun.distance"), spacecraft.get("force.solar[2]")))
        if k + 1 < len(E):
            spacecraft.step(time_s[k + 1] - time_s[k])
            # What holds from here on; the plant moves on from it by itself until the next row.
            spacecraft.set("orbit.position", position_m[k + 1])
            spacecraft.set("orbit.velocity", velocity_m_s[k + 1])
day, distance_m, force_n = np.array(rows).T
print(f"{day[-1]:.2f} d from {distance_m[0] / AU_M:.4f} to {distance_m[-1] / AU_M:.4f} AU, "
      f"force of light {force_n[0] * 1e6:.4f} to {force_n[-1] * 1e6:.4f} uN")

figure, (distance, force) = panels(2, "time [d]")
distance.plot(day, distance_m / AU_M)
distance.set_ylabel("Sun distance [AU]")
force.plot(day, force_n * 1e6)
force.set_ylabel("force of light [uN]")
finish(figure, pictures / "own_ephemeris.svg")
