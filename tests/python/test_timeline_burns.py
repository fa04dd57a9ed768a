"""Burns of a timeline, each by thrusters of its own, simulated by Guidance and a controlled plant wired to each other."""

import numpy as np
import pytest

from spacecraft import call
from systems import simulated, simulated_by_fmpy

CRAFT = """\
name = "Burner"
[mass_properties]
mass_kg = 500.0
center_of_mass_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [[200.0, 0.0, 0.0], [0.0, 300.0, 0.0], [0.0, 0.0, 400.0]]
[optics.black]
specular = 0.0
diffuse = 0.0
[[plates]]
area_m2 = 1.0
center_m = [0.0, 0.0, 0.0]
normal = [0.0, -1.0, 0.0]
optics = "black"
[[tanks]]
position_m = [0.0, 0.0, 0.0]
propellant_kg = 50.0
"""
EXHAUST_M_S = 220.0 * 9.80665
# Names of sets, each with its velocity in m/s, EME2000.
BURNS = [("main", [7.0, -9.0, 4.0]), ("fine", [-1.0, 3.0, 2.0]), ("side", [0.5, 0.0, -1.5])]
DELTA_V = [f"plant.deltaV[{i}]" for i in (1, 2, 3)]
HOUR_S = 3600.0


def thruster(position, direction, force_n, more):
    return (
        f"[[thrusters]]\nposition_m = {position}\ndirection = {direction}\nforce_n = {force_n}\n"
        f"specific_impulse_s = 220.0\n{more}\n"
    )


def craft():
    """100 N along +Z, 20 N along +Z, 10 N along +X for burns; couples of 5 N about all axes, three wheels."""
    text = CRAFT + thruster([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 100.0, 'set = "main"\nattitude_control = false')
    for side in (0.5, -0.5):
        text += thruster([0.0, side, 0.0], [0.0, 0.0, 1.0], 10.0, 'set = "fine"')
        text += thruster([0.0, side, 0.0], [1.0, 0.0, 0.0], 5.0, 'set = "side"')
    for axis in range(3):
        for sense in (1.0, -1.0):
            for side in (1.0, -1.0):
                at, along = [0.0] * 3, [0.0] * 3
                at[(axis + 1) % 3], along[(axis + 2) % 3] = side, side * sense
                text += thruster(at, along, 5.0, "")
        along = [0.0] * 3
        along[axis] = 1.0
        text += f"[[wheels]]\naxis = {along}\ncapacity_n_m_s = 10.0\n"
    return text


def timeline(begins_s, lasts_s):
    """Burns at their times, with nadir between: at a time after the command, when the attitude is reached, and at FMI time."""
    starts = [', start = "10 min"', "", ', start = "5 min", duration = "10 min"']
    text = '[[command]]\nat = 0\nscenario = "nadir"\n'
    for (name, delta_v), begin_s, start in zip(BURNS, begins_s, starts, strict=True):
        text += f'[[command]]\nat = {begin_s}\nscenario = "burn"\n'
        text += f'burn = {{ deltaV = {delta_v}, thrusters = "{name}"{start} }}\n'
        text += f'[[command]]\nat = {begin_s + lasts_s}\nscenario = "nadir"\n'
    return text


def wired(heliotorque, dist, folder, text):
    (folder / "burner.toml").write_text(craft(), encoding="utf-8")
    (folder / "timeline.toml").write_text(text, encoding="utf-8")
    # FMPy applies no parameter set. Nothing but burns and nadir: no zone keeps the thrust off its direction.
    sets = {
        "MomentumPlant": ["attitude.source=controlled", "command.source=inputs"],
        "Guidance": ["keepIn.enabled=false", "hotPole.enabled=false"],
    }
    for model, more in [("MomentumPlant", []), ("Guidance", ["--timeline", "timeline.toml"])]:
        template = (dist / f"{model}.fmu").resolve()
        options = ["--spacecraft", "burner.toml", "--model", model, "--template", template, *more]
        options += [word for value in sets[model] for word in ("--set", value)]
        packed = call(heliotorque, "pack", *options, "--output", f"{model}.fmu", folder=folder)
        assert packed.returncode == 0, packed.stderr
    parts = ["guidance=Guidance.fmu", "plant=MomentumPlant.fmu"]
    done = call(
        heliotorque, "wire", *parts, "--stop", "7d", "--step", "1s", "--outputs",
        ",".join([*DELTA_V, "plant.mass", "guidance.burn.timedOut"]), "--output", "burner.ssp", folder=folder,
    )
    assert done.returncode == 0, done.stderr
    return folder / "burner.ssp"


def judge(time_s, delta_v, mass_kg, begins_s, lasts_s):
    """Each burn adds its velocity, and the propellant that the rocket equation asks for it."""
    for (name, planned), begin_s in zip(BURNS, begins_s, strict=True):
        before, after = (np.searchsorted(time_s, at) for at in (begin_s, begin_s + lasts_s))
        added = delta_v[after] - delta_v[before]
        assert np.linalg.norm(added - planned) < 0.01 * np.linalg.norm(planned), (name, added)
        ideal = EXHAUST_M_S * np.log(mass_kg[before] / mass_kg[after])
        assert abs(ideal / np.linalg.norm(planned) - 1.0) < 0.01, (name, ideal)


# A controlled week is thirty million steps of the controller.
@pytest.mark.long
def test_three_burns_of_a_weeks_timeline_add_their_velocities(heliotorque, dist, tmp_path):
    begins_s, lasts_s = [30 * HOUR_S, 84 * HOUR_S, 138 * HOUR_S], 0.5 * HOUR_S
    ssp = wired(heliotorque, dist, tmp_path, timeline(begins_s, lasts_s))
    names = [*DELTA_V, "plant.mass", "guidance.burn.timedOut", "guidance.mode.active"]
    result = simulated(heliotorque, ssp, names, "--every", "600")
    assert result["time"][-1] == 7 * 24 * HOUR_S
    assert not result["guidance.burn.timedOut"].any() and (result["guidance.mode.active"] == 1).all()
    delta_v = np.column_stack([result[name] for name in DELTA_V])
    judge(result["time"], delta_v, result["plant.mass"], begins_s, lasts_s)


def test_both_masters_fly_three_burns_of_a_timeline(heliotorque, dist, tmp_path):
    begins_s, lasts_s = [600.0, 2400.0, 4200.0], 1200.0
    ssp = wired(heliotorque, dist, tmp_path, timeline(begins_s, lasts_s))
    for result in (
        simulated_by_fmpy(ssp, 6000.0, 1.0), simulated(heliotorque, ssp, [*DELTA_V, "plant.mass"], "--stop", "6000"),
    ):
        delta_v = np.column_stack([result[name] for name in DELTA_V])
        judge(result["time"], delta_v, result["plant.mass"], begins_s, lasts_s)
