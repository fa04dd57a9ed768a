"""A day of ten plates about the Earth: Basilisk (RK4, 1 s, all its effects), the FMU guided and free in steps of a minute, by turns.

Processor time, Basilisk's of the simulation alone, ours of the program with its start. The environment is that of
`basilisk-requirements.txt`.
"""

import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

from earth_basilisk import DAY_S, DENSITY_KG_M3, DIPOLE_A_M2, HEIGHT_M, SCALE_M, TEXT, Day

TURNS = 9
# The same effects, from an orbit of the same size; tides of Sun and Moon and light from the Earth Basilisk's flight does not have.
FLIGHT = {
    "orbit.center": "earth", "orbit.frame": "eme2000", "orbit.dynamics": "disturbed", "orbit.sunTide": "false",
    "orbit.moonTide": "false", "orbit.semiMajorAxis": 6_778_137.0, "orbit.eccentricity": 0.0, "orbit.inclination": 1.44,
    "planetLight.enabled": "false",
    "atmosphere.referenceDensity": DENSITY_KG_M3, "atmosphere.referenceHeight": HEIGHT_M, "atmosphere.scaleHeight": SCALE_M,
    "dipole.residual": ",".join(map(str, DIPOLE_A_M2)),
}
FREE = {"attitude.source": "free", "control.rate": 1, "start.rate": "0.001,-0.002,0.0015"}


def basilisk_s():
    day = Day()
    begin = time.process_time()
    day.run_to(DAY_S)
    return time.process_time() - begin


def main(program, template, folder):
    (folder / "ten.toml").write_text(TEXT, encoding="utf-8")
    fmu = folder / "Ten.fmu"
    packed = ["pack", "--spacecraft", folder / "ten.toml", "--template", template, "--name", "Ten", "--output", fmu]
    subprocess.run([program, *packed], check=True, capture_output=True)

    def own_s(values):
        settings = [part for name, value in values.items() for part in ("--set", f"{name}={value}")]
        recorded = ("--record", "torque.*", "--output", folder / "ten.csv")
        command = [program, "run", fmu, "--stop", "1d", "--step", "60s", "--quiet", *recorded, *settings]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    turns = [(basilisk_s(), own_s(FLIGHT), own_s(FLIGHT | FREE)) for _ in range(TURNS)]
    for k, name in enumerate(("basilisk", "guided", "free_control_rate_1")):
        print(f"bench earth_day_ten_plates_{name} {statistics.median(turn[k] for turn in turns):.3f} s")
    for k, name in ((1, "guided"), (2, "free_control_rate_1")):
        print(f"bench earth_day_basilisk_over_{name} {statistics.median(turn[0] / turn[k] for turn in turns):.2f} times")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        main(sys.argv[1], str(pathlib.Path(sys.argv[2]).resolve()), pathlib.Path(scratch))
