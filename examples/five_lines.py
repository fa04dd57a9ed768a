"""MESSENGER's momentum over 90 days about Mercury, as FMPy runs it without any help."""

from fmpy import simulate_fmu
from picture import finish, folders, panels

dist, pictures = folders(__doc__)

result = simulate_fmu(dist / "MomentumPlant.fmu", stop_time=90 * 86400, step_size=600, output_interval=600,
                      start_values={"spacecraft.centerOfMass[3]": -0.0254, "dump.threshold[1]": 4.0},
                      output=["momentum.body[1]", "dump.count", "sun.elevation"])
print(f"largest X momentum {max(abs(result['momentum.body[1]'])):.3f} N.m.s, {result['dump.count'][-1]} dumps in 90 days")

figure, (momentum, dumps) = panels(2, "time [d]")
momentum.plot(result["time"] / 86400, result["momentum.body[1]"], linewidth=0.8)
momentum.set_ylabel("X momentum [N.m.s]")
dumps.step(result["time"] / 86400, result["dump.count"], where="post")
dumps.set_ylabel("dumps")
finish(figure, pictures / "five_lines.svg")
