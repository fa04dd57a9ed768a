"""The flap of the sunshield telescope, turned until a tour of the sky collects no momentum.

Needs the telescope beside the other FMUs:
heliotorque pack fmu-src/resources/examples/sunshield-telescope.toml --model DisturbanceTorque \
  --template dist/DisturbanceTorque.fmu --name SunshieldTelescope --output dist/SunshieldTelescope.fmu
"""

import numpy as np
from fmu import Fmu
from picture import finish, folders, panels

dist, pictures = folders(__doc__)
fmu = dist / "SunshieldTelescope.fmu"
if not fmu.exists():
    raise SystemExit(f"{fmu} is missing. {__doc__}")
SUN_M, WEEK_S = 1.51094e11, 7 * 86400.0
PITCHES = np.radians(np.arange(-5.0, 45.1, 2.5))  # the Sun off -Y, turned about +X: the boresight 85 to 135 deg off it


def torques(telescope, flap_rad):
    """Torque about X at every pitch."""
    found = []
    for pitch in PITCHES:
        telescope.set("sun.positionBody", [0.0, -SUN_M * np.cos(pitch), -SUN_M * np.sin(pitch)])
        telescope.set("panel[1].angle", flap_rad)
        telescope.step(1.0)
        found.append(telescope.get("torque.solar[1]"))
    return np.array(found)


with Fmu(fmu) as telescope:
    flaps = np.radians(np.arange(0.0, -40.1, -2.0))
    table = np.array([torques(telescope, flap) for flap in flaps])
    mean = table.mean(axis=1)
    k = np.flatnonzero(np.diff(np.sign(mean)))[0]
    low, high = flaps[k], flaps[k + 1]
    while abs(high - low) > 1e-9:
        middle = (low + high) / 2
        if np.sign(torques(telescope, middle).mean()) == np.sign(mean[k]):
            low = middle
        else:
            high = middle
    best, trimmed = low, torques(telescope, low)

print(f"flap at {np.degrees(best):.3f} deg: {trimmed.mean() * WEEK_S:.3f} N.m.s in a week, "
      f"{mean[0] * WEEK_S:.2f} N.m.s with the flap level")

figure, (axis,) = panels(1, "pitch of the Sun [deg]")
axis.plot(np.degrees(PITCHES), table[0] * WEEK_S, label="flap level")
axis.plot(np.degrees(PITCHES), trimmed * WEEK_S, label=f"flap at {np.degrees(best):.1f} deg")
axis.axhline(0.0, color="0.6", linewidth=0.8)
axis.set_ylabel("X momentum in a week [N.m.s]")
finish(figure, pictures / "trim_flap.svg")
