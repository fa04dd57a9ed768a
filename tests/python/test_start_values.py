"""Start values in a spacecraft file: what an importer reads and runs is what it would have set itself."""

import numpy as np
import pytest
from fmpy import read_model_description

from simulation import QUATERNION, Stepped, simulate
from spacecraft import RESOURCES, call

# As the command line writes them, and as FMPy would set them.
SET = {
    "momentum.convention": ("bodyIntegral", 2),
    "eclipse.method": ("off", 4),
    "panel[1].enabled": ("false", False),
    "panel[2].sunOffset": ("10 deg", 10.0 / (180.0 / np.pi)),
    "dump.threshold[2]": ("3", 3.0),
    "guided.downlinkEvery": ("3", 3),
    "torque.applied[1]": ("2 uN.m", 2.0 / 1e6),
}
MESSENGER = RESOURCES / "messenger.toml"


def starts(fmu):
    return {variable.name: variable.start for variable in read_model_description(fmu, validate=True).modelVariables}


@pytest.fixture(scope="module")
def with_start_values(heliotorque, dist, tmp_path_factory):
    """Packed with every value on the command line."""
    fmu = tmp_path_factory.mktemp("start") / "Told.fmu"
    words = [word for name, (text, _) in SET.items() for word in ("--set", f"{name}={text}")]
    template = (dist / "MomentumPlant.fmu").resolve()
    done = call(
        heliotorque, "pack", "--template", template, "--spacecraft", MESSENGER, "--name", "Told", "--output", fmu, *words
    )
    assert done.returncode == 0, done.stderr
    return str(fmu)


def test_fmpy_reads_what_was_packed_and_runs_it_as_if_it_had_set_it(with_start_values, momentum_plant):
    before, after = starts(momentum_plant), starts(with_start_values)
    changed = {name for name in after if after[name] != before[name]}
    assert changed == set(SET)
    assert all(str(value).lower() == after[name] or float(after[name]) == value for name, (_, value) in SET.items())

    by_master = simulate(momentum_plant, days=20.0, start={name: value for name, (_, value) in SET.items()})
    from_file, unset = simulate(with_start_values, days=20.0), simulate(momentum_plant, days=20.0)
    assert from_file.tobytes() == by_master.tobytes()
    assert from_file.tobytes() != unset.tobytes()


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("with_rate", [False, True])
def test_a_free_flight_starts_at_the_identity_where_that_is_set(unpacked_plant, sign, with_rate):
    start = dict(zip(QUATERNION, [0.0, 0.0, 0.0, sign]))
    if with_rate:
        start |= {f"start.rate[{i}]": 0.0 for i in (1, 2, 3)}
    start = {name.replace("attitude.q", "start.q"): value for name, value in start.items()}
    flight = Stepped(unpacked_plant, {"attitude.source": 4} | start)
    assert flight.get(*QUATERNION).tolist() == [0.0, 0.0, 0.0, sign]
    flight.close()
    guided = Stepped(unpacked_plant, {"attitude.source": 4, "start.attitude": 2} | start)
    assert abs(guided.get(*QUATERNION)[3]) < 0.999
    guided.close()
