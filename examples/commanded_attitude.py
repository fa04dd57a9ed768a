"""A commanded attitude, held or turning about the Sun line: a turning spacecraft collects no momentum."""

import numpy as np
from fmpy import simulate_fmu
from fmu import start_values
from picture import finish, folders, panels

dist, pictures = folders(__doc__)
plant = dist / "MomentumPlant.fmu"

# On a circle round the Sun that begins at +X of EME2000, so that the Sun is at -X; this attitude turns -Y there.
options = {
    "orbit.center": "sun", "orbit.frame": "eme2000", "orbit.semiMajorAxis": 1.496e11, "orbit.eccentricity": 0.0,
    "orbit.inclination": 0.0, "orbit.ascendingNode": 0.0, "orbit.periapsisArgument": 0.0, "orbit.trueAnomaly": 0.0,
    "solar.flux": 1361.0, "gravityGradient.enabled": False, "spacecraft.centerOfMass": [0.0, 0.0, -0.0254],
    "panel[1].control": "angle", "panel[2].control": "angle",
    "attitude.source": "commanded", "command.kind": "attitude", "command.q": [0.0, 0.0, -np.sqrt(0.5), np.sqrt(0.5)],
}
PERIOD_S, STOP_S = 7200.0, 28800.0


def momentum(rate_rad_s):
    """Size of the momentum over time, where the body turns about its Y axis at this rate."""
    names = [f"momentum.inertial[{i}]" for i in (1, 2, 3)]
    start = start_values(plant, options | {"command.rate": [0.0, rate_rad_s, 0.0]})
    result = simulate_fmu(plant, stop_time=STOP_S, step_size=60, output_interval=60, start_values=start, output=names)
    return result["time"], np.linalg.norm([result[name] for name in names], axis=0)


time, held = momentum(0.0)
_, turning = momentum(2 * np.pi / PERIOD_S)
print(f"momentum after {STOP_S:.0f} s held {held[-1]:.6f} N.m.s, at most {turning.max():.6f} N.m.s with a turn in {PERIOD_S:.0f} s")

figure, (axis,) = panels(1, "time [h]")
axis.plot(time / 3600, held, label="held")
axis.plot(time / 3600, turning, label="a turn every two hours")
axis.set_ylabel("momentum [N.m.s]")
finish(figure, pictures / "commanded_attitude.svg")
