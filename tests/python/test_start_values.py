"""Start values in a spacecraft file: what an importer reads and runs is what it would have set itself."""

import numpy as np
import pytest
from fmpy import read_model_description

from simulation import simulate
from spacecraft import RESOURCES, call, pack

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


def test_the_table_in_the_file_is_the_same(with_start_values, heliotorque, dist, tmp_path):
    # Into the file's own [start], its last table.
    table = """
"eclipse.method" = "off"
"panel[1].enabled" = false
"panel[2].sunOffset" = "10 deg"
"dump.threshold" = [5.5, 3.0, 5.5]
"planetLight.belts" = 30 # of DisturbanceTorque

[start.MomentumPlant]
"momentum.convention" = "bodyIntegral"
"guided.downlinkEvery" = 3
"torque.applied" = ["2 uN.m", 0, 0]
"""
    text = MESSENGER.read_text(encoding="utf-8") + table
    fmu = pack(heliotorque, dist, tmp_path, text, "Told")
    assert read_model_description(fmu).guid == read_model_description(with_start_values).guid
    assert starts(fmu) == starts(with_start_values)
    checked = call(heliotorque, "check", tmp_path / "Told.toml", "--template", dist / "MomentumPlant.fmu")
    assert checked.returncode == 0, checked.stdout


def test_check_tells_a_start_value_that_one_model_does_not_take(heliotorque, dist, tmp_path):
    text = MESSENGER.read_text(encoding="utf-8")
    bad = tmp_path / "bad.toml"
    bad.write_text(text + '"orbit.center" = "pluto"\n', encoding="utf-8")
    checked = call(heliotorque, "check", bad, "--template", dist / "MomentumPlant.fmu")
    line = len(text.splitlines()) + 1
    assert checked.returncode == 1
    assert f'bad.toml:{line}: start."orbit.center": found "pluto", allowed: mercury (1), sun (2)' in checked.stdout
    assert "1 problem" in checked.stderr
