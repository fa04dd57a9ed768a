"""The shipped systems, simulated by this project's masters and by others; what `wire` connects."""

import csv
import importlib.util
import os
import pty
import re
import subprocess
import zipfile

import numpy as np
import pytest
from lxml import etree

from masters import elements
from spacecraft import call
from systems import connectors, loop_of, simulated, simulated_by_fmpy, simulated_by_libcosim

# File, stop and step of a flight; DisturbanceLoop's is its default experiment.
SYSTEMS = {
    "MessengerLoop": (1_200.0, 1.0),
    "MessengerLoopPlain": (1_200.0, 1.0),
    "DisturbanceLoop": (43_200.0, 10.0),
}
# The same with stops of their own, further ones in `cargo xtask test --long`.
FLIGHTS = [(system, stop_s) for system, (stop_s, _) in SYSTEMS.items()] + [
    pytest.param(system, 14_400.0, marks=pytest.mark.long) for system in ("MessengerLoop", "MessengerLoopPlain")
]
DAY_S = 86_400.0


ATTITUDE = elements("body.attitude.q", 4)
RATE = elements("body.attitude.rate", 3)


def table(result, names):
    return np.column_stack([result[name] for name in names])


@pytest.mark.parametrize("system, stop_s", FLIGHTS)
def test_fmpy_and_our_jacobi_master_that_begins_with_zeros_agree(heliotorque, dist, system, stop_s):
    ssp, (_, step_s) = dist / f"{system}.ssp", SYSTEMS[system]
    outputs, inputs, joined = connectors(ssp)
    theirs = simulated_by_fmpy(ssp, stop_s, step_s)
    ours = simulated(heliotorque, ssp, outputs, "--first-exchange", "zeros", "--stop", str(stop_s))
    assert len(theirs) == stop_s / step_s and ours["time"][-1] == stop_s
    moved = 0
    for name in outputs:
        scale = np.abs(theirs[name].astype(float)).max()
        assert np.abs(theirs[name].astype(float) - ours[name][1:]).max() <= 1e-12 * scale, name
        moved += np.ptp(ours[name]) > 0.0
    assert moved > len(outputs) // 2
    # What FMPy shows of an input is what it sets in the next step.
    assert set(inputs) == set(joined)
    for name, output in joined.items():
        assert (theirs[name] == theirs[output]).all()


def test_the_default_experiment_is_a_day_at_a_second_about_mercury(dist):
    # As it is simulated where the systems are packed, a row each 600 s.
    assert "\nstop_s = 86400.0\nstep_s = 1.0\n" in (dist / "MessengerLoop.csv.toml").read_text(encoding="utf-8")
    names, *rows = csv.reader((dist / "MessengerLoop.csv").read_text(encoding="utf-8").splitlines())
    result = dict(zip(names, np.array(rows, dtype=float).T, strict=True))
    assert len(result["time"]) == DAY_S / 600.0 + 1 and (np.diff(result["time"]) == 600.0).all()
    # It turns, light leaves momentum, and Guidance has no reason to leave its operational mode.
    assert np.ptp(table(result, elements("plant.attitude.q", 4)), axis=0).max() > 0.5
    assert np.abs(table(result, elements("plant.momentum.body", 3))).max() > 0.1
    assert (result["guidance.mode.active"] == 1.0).all()


def test_outputs_at_the_start_are_exchanged_before_the_first_step(heliotorque, dist):
    names = [*elements("plant.attitude.q", 4), *elements("guidance.command.q", 4)]
    ssp = dist / "MessengerLoop.ssp"
    first = simulated(heliotorque, ssp, names, "--stop", "1")
    attitude, command = (table(first, names[part])[0] for part in (slice(0, 4), slice(4, 8)))
    assert np.abs(np.dot(attitude, command)) > 1.0 - 1e-12
    # Guidance computed it from where the plant is, which without an exchange it does not know.
    rate = elements("guidance.command.rate", 3)
    exchanged, zeros = (
        table(simulated(heliotorque, ssp, rate, "--stop", "1", "--first-exchange", first), rate)[0]
        for first in ("initial", "zeros")
    )
    assert exchanged.all() and not zeros.any()


# Systems without connections of enumerations, which libcosim does not know, and what is compared of them.
PLAIN = {
    "DisturbanceLoop": [*ATTITUDE, *elements("disturbance.torque.total", 3)],
    "MessengerLoopPlain": [
        *elements("plant.attitude.q", 4), *elements("plant.momentum.body", 3), *elements("guidance.command.q", 4),
    ],
}


@pytest.mark.parametrize("system, stop_s", [it for it in FLIGHTS if getattr(it, "values", it)[0] in PLAIN])
def test_libcosim_and_our_jacobi_master_agree_to_the_bit(heliotorque, dist, tmp_path, system, stop_s):
    """libcosim exchanges in initialization, too."""
    ssp, (_, step_s), names = dist / f"{system}.ssp", SYSTEMS[system], PLAIN[system]
    ours = simulated(heliotorque, ssp, names, "--stop", str(stop_s))
    theirs = simulated_by_libcosim(ssp, tmp_path, step_s, int(stop_s / step_s), names)
    assert [ours[name][-1] for name in names] == theirs


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("initially", [False, True])
def test_no_shipped_system_has_an_algebraic_loop_by_what_its_fmus_declare(dist, tmp_path, system, initially):
    assert loop_of(dist / f"{system}.ssp", tmp_path, initially) is None


def test_the_loop_is_there_where_nothing_is_fixed(heliotorque, dist, tmp_path):
    """Commanded, the plant turns as it is told at once, and Guidance tells it by where it is."""
    ssp = tmp_path / "open.ssp"
    parts = (f"guidance={dist / 'Guidance.fmu'}", f"plant={dist / 'MomentumPlant.fmu'}")
    assert call(heliotorque, "wire", *parts, "--output", ssp).returncode == 0
    assert loop_of(ssp, tmp_path / "parts", False) is not None


def test_both_masters_converge_to_each_other_with_the_step(heliotorque, dist):
    ssp = dist / "DisturbanceLoop.ssp"

    def difference(step_s):
        options = ("--stop", "7200", "--step", str(step_s), "--every", "7200")
        ends = [
            table(simulated(heliotorque, ssp, RATE, *options, "--master", master), RATE)[-1]
            for master in ("jacobi", "gaussSeidel")
        ]
        return np.linalg.norm(ends[0] - ends[1])

    differences = [difference(step_s) for step_s in (80.0, 40.0, 20.0, 10.0)]
    ratios = np.array(differences[:-1]) / np.array(differences[1:])
    # Both are of first order.
    assert (np.abs(ratios - 2.0) < 0.3).all(), differences


def test_masters_take_the_values_that_they_say(heliotorque, dist):
    """Jacobi steps with the torque of the step's beginning, Gauss-Seidel (torque first) with that of its end."""
    ssp = dist / "DisturbanceLoop.ssp"
    given, taken = elements("disturbance.torque.total", 3), elements("body.torque.total", 3)
    for master, lag in (("jacobi", 1), ("gaussSeidel", 0)):
        result = simulated(heliotorque, ssp, [*given, *taken], "--stop", "200", "--master", master)
        output, use = table(result, given), table(result, taken)
        assert (use[1:] == output[1 - lag : len(output) - lag]).all()
        assert np.ptp(output, axis=0).max() > 0.0


# What of the plant reaches Guidance, and back, today; vectors by their bare names.
TO_GUIDANCE = {
    "position": "position",
    "velocity": "velocity",
    "estimate.q": "estimate.q",
    "estimate.rate": "estimate.rate",
    "estimate.valid": "estimate.valid",
    "sun.sensed": "sun.sensed",
    "sun.sensedValid": "sun.sensedValid",
    "sun.positionInertial": "sun.position",
    "sun.velocityInertial": "sun.velocity",
    "earth.positionInertial": "earth.position",
    "earth.velocityInertial": "earth.velocity",
    "accelerometer.deltaV": "accelerometer.deltaV",
    "momentum.body": "momentum.body",
}
TO_PLANT = {
    name: name
    for name in (
        "command.kind", "command.q", "command.rate", "command.error", "thrust.request", "thrust.command", "thrust.stop",
        "dump.request", "dump.target", "panel",
    )
}


def test_wire_connects_what_belongs_together_and_nothing_else(heliotorque, dist, tmp_path):
    ssp = tmp_path / "loop.ssp"
    done = call(
        heliotorque, "wire", f"guidance={dist / 'Guidance.fmu'}", f"plant={dist / 'MomentumPlant.fmu'}", "--output", ssp
    )
    assert done.returncode == 0, done.stderr
    _, inputs, joined = connectors(ssp)
    bare = {(output.split("[")[0], to.split("[")[0]) for to, output in joined.items()}
    expected = {(f"plant.{output}", f"guidance.{to}") for output, to in TO_GUIDANCE.items()}
    expected |= {(f"guidance.{output}", f"plant.{to}") for output, to in TO_PLANT.items()}
    assert bare == expected
    assert len(joined) == len(inputs) == 6 * 3 + (4 + 3 + 1 + 3 + 1 + 3) + (1 + 4 + 3 + 4 + 3) + (3 + 1 + 3 + 2)
    assert done.stdout == "" and done.stderr.startswith(f"{len(joined)} connections")
    assert "no output of that name" in done.stderr and "scan.frame" in done.stderr
    # To the standard output the same bytes, once it has the same name; never to a terminal.
    piped = subprocess.run(
        [heliotorque, "wire", "--name", "loop", "-q", f"guidance={dist / 'Guidance.fmu'}", f"plant={dist / 'MomentumPlant.fmu'}"],
        capture_output=True,
    )
    assert piped.stdout == ssp.read_bytes() and piped.stderr == b""
    terminal, other_end = pty.openpty()
    refused = subprocess.run([heliotorque, "wire", dist / "Guidance.fmu"], stdout=other_end, stderr=subprocess.PIPE, text=True)
    os.close(terminal)
    os.close(other_end)
    assert refused.returncode == 2 and "not written to a terminal: see --output" in refused.stderr


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_description_follows_the_schema_and_names_components_units_and_options(dist, system):
    import fmpy

    with zipfile.ZipFile(dist / f"{system}.ssp") as archive:
        root = etree.fromstring(archive.read("SystemStructure.ssd"))
        assert sorted(archive.namelist())[0] == "SystemStructure.ssd"
    schema = etree.XMLSchema(file=f"{os.path.dirname(fmpy.__file__)}/ssp/schema/SystemStructureDescription.xsd")
    schema.assertValid(root)
    common = "{http://ssp-standard.org/SSP1/SystemStructureCommon}"
    units = {unit.get("name") for unit in root.iter(f"{common}Unit")}
    options = {option.get("name") for option in root.iter(f"{common}Enumeration") if len(option)}
    for connector in root.iter("{*}Connector"):
        (kind,) = connector
        if kind.tag == f"{common}Real":
            assert kind.get("unit") in units
        if kind.tag == f"{common}Enumeration":
            assert kind.get("name") in options


def test_values_are_set_by_component_with_units_and_dates(heliotorque, dist):
    ssp = dist / "DisturbanceLoop.ssp"
    settings = ("--set", "body.start.rate=0,0,1 deg/s")
    first = simulated(heliotorque, ssp, RATE, "--stop", "10", *settings)
    assert first["body.attitude.rate[3]"][0] == np.radians(1.0)
    dated = simulated(
        heliotorque, dist / "MessengerLoop.ssp", ["guidance.epoch"], "--stop", "1",
        "--set", "guidance.start.epoch=2011-04-06T00:00:00 UTC",
    )
    assert abs(dated["guidance.epoch"][0] - 355_320_066.0) < 2.0


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["DisturbanceLoop.ssp", "--set", "body.torque.total=1,0,0"], ["body.torque.total[1]", "connected to disturbance.torque.total[1]"]),
        (["DisturbanceLoop.ssp", "--set", "bdy.inertia=1,1,1"], ["DisturbanceLoop: no variable \"bdy.inertia\""]),
        (["DisturbanceLoop.ssp", "--record", "nothing"], ["no variable \"nothing\""]),
        (["DisturbanceLoop.ssp", "--slopes", "--input", "-"], ["--slopes is for an FMU"]),
        (["DisturbanceLoop.ssp", "--step", "-1"], ["more than 0 s"]),
        (["DisturbanceLoop.ssp", "--start", "100"], ["later than the start time"]),
        (["Guidance.fmu", "--master", "jacobi"], ["--master is for a system"]),
        (["Guidance.fmu", "--first-exchange", "zeros"], ["--first-exchange is for a system"]),
        # The failed call is named with its component.
        (["DisturbanceLoop.ssp", "--set", "body.start.q=0,0,0,0"], ["instance \"body\"", "fmi2GetReal", "`start.q`"]),
    ],
)
def test_what_cannot_be_run_is_refused_by_name(heliotorque, dist, arguments, said):
    name, *options = arguments
    done = call(heliotorque, "run", dist / name, "--stop", "20", *options)
    assert done.returncode != 0
    for part in said:
        assert part in done.stderr, done.stderr


def test_open_inputs_follow_a_table(heliotorque, dist, tmp_path):
    csv = tmp_path / "panels.csv"
    csv.write_text("time,disturbance.panel[1].angle\n0,0\n100,0\n100,1\n", encoding="utf-8")
    name = "disturbance.panel[1].angle"
    result = simulated(heliotorque, dist / "DisturbanceLoop.ssp", [name, *elements("disturbance.torque.solar", 3)], "--stop", "200", "--input", csv)
    assert result[name].tolist() == [0.0] * 11 + [1.0] * 10
    torque = table(result, elements("disturbance.torque.solar", 3))
    assert np.abs(torque[11] - torque[10]).max() > 10.0 * np.abs(torque[10] - torque[9]).max()


def test_info_and_check_tell_of_a_system(heliotorque, dist, tmp_path):
    done = call(heliotorque, "info", dist / "MessengerLoop.ssp")
    for part in ("guidance", "plant", "MomentumPlant", "stop 86400 s, step 1 s", "command.kind", "open inputs", "sun.sensedValid"):
        assert part in done.stdout
    assert call(heliotorque, "check", dist / "MessengerLoop.ssp").returncode == 0
    torn = tmp_path / "torn.ssp"
    torn.write_bytes((dist / "MessengerLoop.ssp").read_bytes()[:-1000])
    done = call(heliotorque, "check", torn)
    assert done.returncode == 1 and "not a usable SSP archive" in done.stdout


def test_the_systems_own_connectors_are_set_and_recorded_by_their_names(heliotorque, dist, tmp_path):
    zipfile.ZipFile(dist / "DisturbanceLoop.ssp").extractall(tmp_path)
    parts = [f"{name}={tmp_path / 'resources' / name}.fmu" for name in ("disturbance", "body")]
    ssp, inner = tmp_path / "own.ssp", "disturbance.panel[1].angle"
    done = call(heliotorque, "wire", *parts, "--export", f"body.attitude.q,body.attitude.rate,{inner}", "--output", ssp, "-q")
    assert done.returncode == 0, done.stderr
    options = ("--stop", "600", "--step", "10")
    bare = [re.sub(r"[.\[]", "_", name.removeprefix("body.")).removesuffix("]") for name in RATE]
    plain = simulated(heliotorque, dist / "DisturbanceLoop.ssp", RATE, *options, "--set", f"{inner}=30deg")
    ours = simulated(heliotorque, ssp, ["panel_1_angle", inner, *bare, *RATE], *options, "--set", "panel_1_angle=30deg")
    for name, of_system in zip(RATE, bare):
        assert (ours[of_system] == plain[name]).all() and (ours[name] == plain[name]).all()
    assert (ours[inner] == np.pi / 6.0).all() and (ours["panel_1_angle"] == np.pi / 6.0).all()
    # In a unit of the connector's own, from a table.
    with zipfile.ZipFile(ssp) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    text = files["SystemStructure.ssd"].decode()
    text = text.replace('<ssc:Real unit="rad"/>', '<ssc:Real unit="half turns"/>', 1)
    unit = '<ssd:Units><ssc:Unit name="half turns"><ssc:BaseUnit rad="1" factor="3.141592653589793"/></ssc:Unit>'
    files["SystemStructure.ssd"] = text.replace("<ssd:Units>", unit).encode()
    other = tmp_path / "other.ssp"
    with zipfile.ZipFile(other, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    angles = tmp_path / "angles.csv"
    angles.write_text("time,panel_1_angle\n0,0\n300,0\n300,0.5\n", encoding="utf-8")
    turned = simulated(heliotorque, other, ["panel_1_angle", inner], *options, "--input", angles)
    assert turned["panel_1_angle"].tolist() == [0.0] * 31 + [0.5] * 30
    assert turned[inner].tolist() == [0.0] * 31 + [np.pi / 2.0] * 30
    # FMPy shows them, too, and libcosim takes no such system.
    theirs = simulated_by_fmpy(ssp, 600.0, 10.0)
    for name, of_system in zip(RATE, bare):
        assert (theirs[of_system] == theirs[name]).all() and np.ptp(theirs[of_system]) > 0.0
    (tmp_path / "libcosim").mkdir()
    with pytest.raises(AssertionError, match="Unable to create execution"):
        simulated_by_libcosim(ssp, tmp_path / "libcosim", 10.0, 60, RATE)


@pytest.mark.skipif(importlib.util.find_spec("OMSimulator") is None, reason="OMSimulator is not installed")
@pytest.mark.parametrize("system", SYSTEMS)
def test_omsimulator_flies_the_system(heliotorque, dist, system):
    from OMSimulator import SSP, CRef

    stop_s, step_s = SYSTEMS[system]
    ssp = dist / f"{system}.ssp"
    names = ATTITUDE if system == "DisturbanceLoop" else elements("plant.attitude.q", 4)
    model = SSP(str(ssp))
    model.newSolver({"name": "fixed", "method": "oms_ma", "fixedStepSize": step_s})
    outputs, _, _ = connectors(ssp)
    for component in {name.partition(".")[0] for name in outputs}:
        model.setSolver(CRef(system, component), "fixed")
    running = model.instantiate()
    running.initialize()
    running.simulate()
    theirs = np.array([running.getValue(CRef(system, *name.split(".", 1))) for name in names])
    running.terminate()
    running.delete()
    ours = simulated(heliotorque, ssp, names, "--every", str(stop_s))
    assert np.abs(theirs - table(ours, names)[-1]).max() < 1e-9
