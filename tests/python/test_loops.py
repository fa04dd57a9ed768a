"""Loops of our FMUs under masters that send zeros before the first exchange: FMPy's SSP simulation and container FMU."""

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu

from simulation import vector
from masters import container, elements, run_ssp, wires
from spacecraft import RESOURCES, call

LIGHT_W_M2 = 1361.0
STEP_S, STOP_S = 30.0, 43_200.0


def packed(heliotorque, dist, folder, model, name, spacecraft, *settings):
    """An FMU with start values of its own."""
    fmu = folder / f"{name}.fmu"
    sets = [word for setting in settings for word in ("--set", setting)]
    template = (dist / f"{model}.fmu").resolve()
    done = call(
        heliotorque, "pack", "--template", template, "--model", model, "--name", name, "--output", fmu,
        "--spacecraft", RESOURCES / spacecraft, *sets,
    )
    assert done.returncode == 0, done.stderr
    return fmu


@pytest.fixture(scope="module")
def scratch(tmp_path_factory):
    return tmp_path_factory.mktemp("loops")


@pytest.fixture(scope="module")
def light_loop(heliotorque, dist, scratch):
    """A plant in the dark, lit by a DisturbanceTorque of the same spacecraft; and the plant that does it alone."""
    # Body components integrated on their own: a delayed torque is the same torque, whatever way the body has turned.
    settings = ("gravityGradient.enabled=false", "momentum.convention=bodyIntegral")
    flux = f"solar.flux={LIGHT_W_M2}"
    center = "spacecraft.centerOfMass=0.02,0.01,-0.05"
    dark = packed(heliotorque, dist, scratch, "MomentumPlant", "dark", "messenger.toml", *settings, center, "solar.flux=0")
    alone = packed(heliotorque, dist, scratch, "MomentumPlant", "alone", "messenger.toml", *settings, center, flux)
    light = packed(
        heliotorque, dist, scratch, "DisturbanceTorque", "light", "messenger.toml", center, flux
    )
    connections = [
        *wires("plant.sun.positionBody", "light.sun.positionBody", 3),
        *wires("plant.planet.positionBody", "light.planet.positionBody", 3),
        ("plant.panel[1].angleActual", "light.panel[1].angle"),
        ("plant.panel[2].angleActual", "light.panel[2].angle"),
        *wires("light.torque.solar", "plant.torque.applied", 3),
    ]
    return {"plant": dark, "light": light}, connections, alone


def momentum_alone(alone):
    names = [*vector("momentum.body"), *vector("torque.solar")]
    result = simulate_fmu(str(alone), stop_time=STOP_S, step_size=STEP_S, output_interval=STEP_S, output=names)
    momentum = np.array([result[name][-1] for name in vector("momentum.body")])
    torque = np.column_stack([result[name] for name in vector("torque.solar")])
    return momentum, np.linalg.norm(torque, axis=1).max()


def assert_close(momentum, alone, step_s):
    """A loop differs by the torque held over a step and exchanged two steps late."""
    expected, most_n_m = momentum_alone(alone)
    assert np.abs(expected).min() > 4.0 * step_s * most_n_m, "no momentum to compare"
    assert np.linalg.norm(momentum - expected) < 4.0 * step_s * most_n_m
    return np.linalg.norm(momentum - expected)


def test_an_ssp_of_plant_and_torque_runs_as_the_plant_alone(light_loop, tmp_path):
    components, connections, alone = light_loop
    lags = []
    for step_s in (STEP_S, 2.0 * STEP_S):
        folder = tmp_path / f"{step_s:.0f}"
        folder.mkdir()
        result = run_ssp(folder, components, connections, step_s, STOP_S, outputs=elements("plant.momentum.body", 3))
        momentum = np.array([result[name][-1] for name in elements("plant.momentum.body", 3)])
        lags.append(assert_close(momentum, alone, step_s))
        # Both were sent zeros before the first exchange, and answered with none.
        first, last = result[0], result[-1]
        assert [first[name] for name in elements("light.torque.solar", 3)] == [0.0, 0.0, 0.0]
        assert np.linalg.norm([last[name] for name in elements("light.torque.solar", 3)]) > 0.0
    # The delay is a matter of the step alone.
    assert 1.8 < lags[1] / lags[0] < 2.2


def test_a_container_of_plant_and_torque_runs_as_the_plant_alone(light_loop, tmp_path):
    components, connections, alone = light_loop
    outputs = [*elements("plant.momentum.body", 3), *elements("light.torque.solar", 3)]
    fmu = container(tmp_path / "light-container.fmu", components, connections, STEP_S, outputs)
    result = simulate_fmu(fmu, stop_time=STOP_S, step_size=STEP_S, output_interval=STEP_S, output=outputs, validate=False)
    assert result["time"][-1] == STOP_S
    assert_close(np.array([result[name][-1] for name in outputs[:3]]), alone, STEP_S)


@pytest.fixture(scope="module")
def ring(heliotorque, dist, scratch):
    """All three: the spinner commands the plant's attitude, the plant lights the torque model, which turns the spinner."""
    plant = packed(
        heliotorque, dist, scratch, "MomentumPlant", "follower", "messenger.toml",
        "attitude.source=commanded", "command.kind=attitude",
    )
    spinner = packed(heliotorque, dist, scratch, "SpinPlant", "spinner", "ace.toml", "geometry.source=inputs")
    light = packed(heliotorque, dist, scratch, "DisturbanceTorque", "torque", "messenger.toml")
    connections = [
        *wires("spinner.attitude.q", "plant.command.q", 4),
        *wires("plant.sun.positionBody", "light.sun.positionBody", 3),
        *wires("plant.planet.positionBody", "light.planet.positionBody", 3),
        *wires("plant.sun.direction", "spinner.sun.direction", 3),
        *wires("light.torque.total", "spinner.torque.applied", 3),
    ]
    return {"plant": plant, "light": light, "spinner": spinner}, connections


def stack(result, name, size):
    return np.column_stack([result[element] for element in elements(name, size)])


def assert_followed(plant, spinner, lag):
    """The plant turns as it was commanded `lag` rows before; a quaternion and its negative are one attitude."""
    commanded, done = spinner[: len(spinner) - lag], plant[lag:]
    assert np.abs(np.abs(np.sum(commanded * done, axis=1)) - 1.0).max() < 1e-12
    assert np.ptp(done, axis=0).max() > 0.5, "nothing turned"


def test_an_ssp_of_all_three_runs(ring, tmp_path):
    components, connections = ring
    result = run_ssp(tmp_path, components, connections, 1.0, 60.0, outputs=elements("plant.attitude.q", 4))
    plant, spinner = stack(result, "plant.attitude.q", 4), stack(result, "spinner.attitude.q", 4)
    # A command of zeros is none: the plant holds the attitude that it began with.
    assert plant[0].tolist() == [0.0, 0.0, 0.0, 1.0]
    assert_followed(plant, spinner, 1)
    torque = stack(result, "light.torque.total", 3)
    assert torque[0].tolist() == [0.0, 0.0, 0.0] and (np.linalg.norm(torque[1:], axis=1) > 0.0).all()


def test_a_container_of_all_three_runs(ring, tmp_path):
    components, connections = ring
    outputs = [*elements("plant.attitude.q", 4), *elements("spinner.attitude.q", 4), *elements("light.torque.total", 3)]
    fmu = container(tmp_path / "ring-container.fmu", components, connections, 1.0, outputs)
    result = simulate_fmu(fmu, stop_time=60.0, step_size=1.0, output_interval=1.0, output=outputs, validate=False)
    plant, spinner = stack(result, "plant.attitude.q", 4), stack(result, "spinner.attitude.q", 4)
    assert_followed(plant[1:], spinner[1:], 1)
    assert (np.linalg.norm(stack(result, "light.torque.total", 3)[3:], axis=1) > 0.0).all()


@pytest.fixture(scope="module")
def pointed(heliotorque, dist, scratch):
    """Guidance and the plant that it points at nadir, each from where the other is."""
    plant = packed(
        heliotorque, dist, scratch, "MomentumPlant", "pointed", "messenger.toml",
        "attitude.source=commanded", "command.kind=attitude",
    )
    guidance = packed(heliotorque, dist, scratch, "Guidance", "nadir", "messenger.toml", "pointing.scenario=nadir")
    connections = [
        *wires("guidance.command.q", "plant.command.q", 4),
        *wires("guidance.command.rate", "plant.command.rate", 3),
        *wires("plant.position", "guidance.position", 3),
        *wires("plant.velocity", "guidance.velocity", 3),
    ]
    return {"guidance": guidance, "plant": plant}, connections


def assert_pointed(plant, commanded):
    """After the first exchanges the plant stands as it is commanded to, within what a second of even turning leaves."""
    assert np.ptp(plant, axis=0).max() > 0.1, "nothing turned"
    assert np.abs(np.abs(np.sum(plant[4:] * commanded[4:], axis=1)) - 1.0).max() < 1e-10


def test_guidance_points_the_plant_in_an_ssp(pointed, tmp_path):
    components, connections = pointed
    result = run_ssp(tmp_path, components, connections, 1.0, 60.0, outputs=elements("plant.attitude.q", 4))
    assert_pointed(stack(result, "plant.attitude.q", 4), stack(result, "guidance.command.q", 4))


def test_guidance_points_the_plant_in_a_container(pointed, tmp_path):
    components, connections = pointed
    outputs = [*elements("plant.attitude.q", 4), *elements("guidance.command.q", 4)]
    fmu = container(tmp_path / "pointed-container.fmu", components, connections, 1.0, outputs)
    result = simulate_fmu(fmu, stop_time=60.0, step_size=1.0, output_interval=1.0, output=outputs, validate=False)
    assert_pointed(stack(result, "plant.attitude.q", 4), stack(result, "guidance.command.q", 4))


def inputs_of(fmu):
    variables = read_model_description(str(fmu)).modelVariables
    return [variable for variable in variables if variable.causality == "input"]


# With options by which the inputs are read; what may not move.
ALL_ZERO = {
    "MomentumPlant": ("messenger.toml", ["attitude.source=commanded", "orbit.source=elements"], 600.0, "attitude.q", 4),
    "SpinPlant": ("ace.toml", ["geometry.source=inputs", "burn.plan=commanded"], 1.0, "momentum.inertial", 3),
    "DisturbanceTorque": ("messenger.toml", [], 60.0, "force.total", 3),
    "Guidance": ("messenger.toml", [], 1.0, "command.q", 4),
}


@pytest.mark.parametrize("model", ALL_ZERO)
def test_every_input_may_be_zero_for_ever(heliotorque, dist, tmp_path, model):
    spacecraft, settings, step_s, held, size = ALL_ZERO[model]
    fmu = packed(heliotorque, dist, tmp_path, model, "zero", spacecraft, *settings)
    inputs = [f"it.{variable.name}" for variable in inputs_of(fmu)]
    assert len(inputs) >= 10
    result = run_ssp(tmp_path, {"it": fmu}, [], step_s, 20 * step_s, zeros=inputs, outputs=elements(f"it.{held}", size))
    kept = stack(result, f"it.{held}", size)
    assert np.isfinite(kept).all()
    if model == "DisturbanceTorque":
        assert not kept.any()
    else:
        assert kept[0].any() and np.abs(kept - kept[0]).max() <= 1e-12 * np.abs(kept[0]).max()
