"""A spinner turns its axis by 2 deg: a train of equal pulses, and one whose first and last are half as long."""

import numpy as np
from fmpy import simulate_fmu
from fmu import start_values
from picture import finish, folders, panels

dist, pictures = folders(__doc__)
plant = dist / "SpinPlant.fmu"
# Radial thruster 8 fires once a turn at 5 rpm; the pulses within the tapered train are twice as long.
TRAINS = {
    "uniform": {"burn.plan": "uniform", "burn.count": 114},
    "tapered": {"burn.plan": "tapered", "burn.count": 58},
}

figure, (axis_angle, *nutation) = panels(3, "time [min]")
for axis, (name, train) in zip(nutation, TRAINS.items()):
    result = simulate_fmu(
        plant, stop_time=1500, step_size=1, output_interval=1, start_values=start_values(plant, train),
        output=["momentum.displacement", "nutation.angle", "burn.pulsesFired", "burn.done"],
    )
    minutes, ended = result["time"] / 60, np.argmax(result["burn.done"])
    moved, left = np.degrees(result["momentum.displacement"]), np.degrees(result["nutation.angle"])
    print(f"{name}: {result['burn.pulsesFired'][-1]} pulses in {minutes[ended]:.2f} min turn the axis by {moved[-1]:.4f} deg, "
          f"nutation at most {left.max():.5f} deg, {left[ended]:.5f} deg at the end")
    axis_angle.plot(minutes, moved, label=name)
    axis.plot(minutes, left, linewidth=0.8)
    axis.set_ylabel(f"nutation, {name} [deg]")
axis_angle.set_ylabel("axis turned [deg]")
finish(figure, pictures / "spinner_manoeuvre.svg")
