"""Missions that `heliotorque plan` gave: an FMU packed with a mission's values flies past Mercury in FMPy, with nothing else set."""

import pytest
from simulation import DAY_S, simulate
from spacecraft import RESOURCES, call

# By mission: s from the start to the closest approach, days.
FLYBYS = [("messenger-flyby1", 2_315_040.0, 28.0), ("messenger-flyby2", 17_397_600.0, 203.0)]
OUTPUT = ["encounter.count", "encounter.lastTime", "encounter.lastAltitude", "encounter.excessSpeed"]


@pytest.mark.parametrize(("name", "arrival_s", "days"), FLYBYS)
def test_a_packed_flyby_passes_at_its_altitude_in_fmpy(heliotorque, dist, tmp_path, name, arrival_s, days):
    mission = RESOURCES / "examples" / "missions" / f"{name}.toml"
    template = (dist / "MomentumPlant.fmu").resolve()
    packed = call(heliotorque, "pack", "--mission", mission, "--template", template, "--output", "Flyby.fmu", folder=tmp_path)
    assert packed.returncode == 0, packed.stderr
    result = simulate(tmp_path / "Flyby.fmu", step_s=DAY_S, days=days, output=OUTPUT)
    count, at_s, altitude_m, _ = (result[column][-1] for column in OUTPUT)
    assert count == 1 and abs(at_s - arrival_s) < 0.01, at_s
    assert abs(altitude_m - 200e3) < 1.0, altitude_m
