"""Flights of ten days in steps of a minute or ten, three values read at each: `heliotorque sweep` with one worker beside FMPy, by turns."""

import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from fmpy import extract, read_model_description, simulate_fmu
from fmpy.simulation import instantiate_fmu

FLIGHTS, TURNS = 8, 3
STOP_S = 864000
OUTPUTS = [f"momentum.body[{k}]" for k in (1, 2, 3)]
NAME = "spacecraft.centerOfMass[3]"


def timed(work):
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def main(program, fmu, folder):
    values = [-0.03 + 0.001 * k for k in range(FLIGHTS)]
    options = {"stop_time": STOP_S, "output": OUTPUTS}
    campaign = folder / "campaign.toml"

    def sweep(step_s):
        campaign.write_text(
            f"fmu = '{fmu}'\nstop = {STOP_S}\nstep = {step_s}\nsampling = 'grid'\n[vary]\n'{NAME}' = {{ values = {values} }}\n"
            f"[keep]\nextremes = ['momentum.body']\n",
            encoding="utf-8",
        )
        subprocess.run([program, "sweep", campaign, "--workers", "1", "--output", folder / "runs.csv", "--quiet"], check=True)

    def each_from_its_file(step_s):
        for value in values:
            simulate_fmu(fmu, step_size=step_s, output_interval=step_s, start_values={NAME: value}, **options)

    unpacked, description = extract(fmu, unzipdir=str(folder / "unpacked")), read_model_description(fmu)

    def one_that_is_reset(step_s):
        instance = instantiate_fmu(unpacked, description, fmi_type="CoSimulation")
        for value in values:
            instance.reset()
            simulate_fmu(
                unpacked, model_description=description, fmu_instance=instance, step_size=step_s, output_interval=step_s,
                start_values={NAME: value}, **options,
            )
        instance.freeInstance()

    for step_s in (60, 600):
        turns = [[timed(lambda: way(step_s)) for way in (sweep, each_from_its_file, one_that_is_reset)] for _ in range(TURNS)]
        own = statistics.median(turn[0] for turn in turns)
        print(f"bench sweep_{FLIGHTS}_flights_in_steps_of_{step_s}_s {own:.3f} s")
        for name, way in (("simulate_fmu_of_the_file", 1), ("one_instance_reset", 2)):
            ratio = statistics.median(turn[way] / turn[0] for turn in turns)
            print(f"bench fmpy_{name}_over_sweep_in_steps_of_{step_s}_s {ratio:.2f} times")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        main(sys.argv[1], str(pathlib.Path(sys.argv[2]).resolve()), pathlib.Path(scratch))
