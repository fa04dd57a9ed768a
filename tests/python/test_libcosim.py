"""A second importer, libcosim (with the FMI Library), steps every FMU to FMPy's numbers, bit for bit."""

import pytest
from fmpy import simulate_fmu

from simulation import simulate, vector
from spacecraft import RESOURCES, pack

# FMU, step and how many, outputs, which of them must have moved.
SIMULATIONS = {
    "MomentumPlant": (600.0, 3 * 144, [*vector("momentum.body"), *vector("position")]),
    "SpinPlant": (0.5, 1200, ["nutation.angle", *vector("momentum.inertial"), *vector("attitude.rate")]),
    "DisturbanceTorque": (60.0, 3, [f"torque.{source}[1]" for source in ("solar", "albedo", "infrared", "thermal")]),
    "Guidance": (1.0, 300, ["epoch", *(f"command.q[{i}]" for i in range(1, 5))]),
}


def libcosim_values(fmu, step_s, steps, names):
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    execution = CosimExecution.from_step_size(step_size=int(step_s * 1e9))
    slave = execution.add_local_slave(local_slave=CosimLocalSlave(fmu_path=fmu, instance_name="plant"))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer=observer)

    def text(name):
        return name.decode() if isinstance(name, bytes) else name

    references = {text(v.name): v.reference for v in execution.slave_variables(slave_index=slave)}
    assert execution.step(step_count=steps)
    expected = [references[name] for name in names]
    return observer.last_real_values(slave_index=slave, variable_references=expected)


@pytest.mark.parametrize("model", SIMULATIONS)
def test_libcosim_and_fmpy_agree_to_the_bit(dist, model):
    step_s, steps, names = SIMULATIONS[model]
    fmu = str(dist / f"{model}.fmu")
    result = simulate_fmu(fmu, stop_time=step_s * steps, step_size=step_s, output_interval=step_s, output=names)
    ours = [float(result[name][-1]) for name in names]
    assert libcosim_values(fmu, step_s, steps, names) == ours
    assert any(value != 0.0 for value in ours)


def test_libcosim_runs_options_that_it_cannot_set(heliotorque, dist, tmp_path):
    options = {"momentum.convention": ("bodyIntegral", 2), "eclipse.method": ("off", 4)}
    table = "\n".join(f'"{name}" = "{item}"' for name, (item, _) in options.items())
    text = (RESOURCES / "messenger.toml").read_text(encoding="utf-8") + f"{table}\n"  # its last table is [start]
    fmu = pack(heliotorque, dist, tmp_path, text, "Chosen")
    names = vector("momentum.body")
    shipped = str(dist / "MomentumPlant.fmu")

    def last(start):
        result = simulate(shipped, days=3.0, start=start, output=names)
        return [float(result[name][-1]) for name in names]

    chosen = last({name: number for name, (_, number) in options.items()})
    assert libcosim_values(fmu, 600.0, 3 * 144, names) == chosen
    assert chosen != last({})
