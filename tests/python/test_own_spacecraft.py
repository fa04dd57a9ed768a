"""Your own spacecraft: packed without a compiler, it runs in FMPy with the file's values, and a bad file is refused by line."""

import json
import re
import tomllib
import zipfile

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

from simulation import Stepped, simulate, stack, vector
from spacecraft import HEAD, RESOURCES, SAILER, call, pack, solar_torque, urchin

PRESSURE_PA = 9e-6
FIXED_LIGHT = {"solar.fixedPressure": True, "solar.pressure": PRESSURE_PA, "eclipse.method": 4}


@pytest.fixture(scope="module")
def sailer(heliotorque, dist, tmp_path_factory):
    return pack(heliotorque, dist, tmp_path_factory.mktemp("my sailer ü"), SAILER, "SolarSailer")


@pytest.fixture(scope="module")
def urchin_65(heliotorque, dist, tmp_path_factory):
    return pack(heliotorque, dist, tmp_path_factory.mktemp("urchin"), urchin(65), "Urchin")


def assert_torque_is_the_sum_over_the_file(fmu, text, panels):
    angles = [f"panel[{k}].angleActual" for k in range(1, panels + 1)]
    names = vector("torque.solar") + vector("sun.direction") + angles
    # Tumbling, so that the Sun comes from everywhere: fronts, rears and panels edge-on.
    tumble = {"attitude.source": 2} | {f"command.rate[{axis}]": rate for axis, rate in ((1, 6.3e-5), (2, -7.3e-5), (3, 1e-5))}
    result = simulate(fmu, 1800.0, days=3.0, start=FIXED_LIGHT | tumble, output=names)
    torque, sun = stack(result, "torque.solar"), stack(result, "sun.direction")
    expected = np.array([
        solar_torque(text, sun[row], PRESSURE_PA, [result[name][row] for name in angles]) for row in range(len(sun))
    ])
    assert np.abs(expected).max() > 1e-7
    assert (np.abs(sun).max(axis=0) > 0.5).all() and sun[:, 1].max() > 0.5, "the Sun lit one side only"
    assert np.abs(torque - expected).max() < 1e-12 * np.abs(expected).max()


def test_the_example_runs_with_its_own_three_panels_and_no_shade(sailer):
    assert validate_fmu(sailer) == []
    description = read_model_description(sailer, validate=True)
    assert description.modelName == "SolarSailer"
    assert description.coSimulation.modelIdentifier == "SolarSailer"
    names = {variable.name for variable in description.modelVariables}
    assert {"panel[3].angle", "wheel[3].momentum"} <= names
    assert not {"panel[4].angle", "wheel[4].momentum"} & names
    assert_torque_is_the_sum_over_the_file(sailer, SAILER, panels=3)


def test_the_example_runs_ninety_days_and_dumps(sailer):
    result = simulate(sailer, 3600.0)
    assert result["time"][-1] == 90 * 86_400.0
    assert result["dump.count"][-1] >= 1
    assert np.abs(stack(result, "momentum.body")).max() <= 1.0 + 1e-9


@pytest.mark.long
def test_fmpy_has_nothing_to_report_of_sixty_five_plates(urchin_65):
    assert validate_fmu(urchin_65) == []


def test_sixty_five_plates_without_panels_and_wheels(urchin_65):
    names = {variable.name for variable in read_model_description(urchin_65).modelVariables}
    assert not any(name.startswith(("panel[", "wheel[")) for name in names)
    assert_torque_is_the_sum_over_the_file(urchin_65, urchin(65), panels=0)


def test_two_spacecraft_in_one_process_do_not_disturb_each_other(sailer, urchin_65, tmp_path):
    def step(spacecraft):
        spacecraft.step(600.0)
        return list(spacecraft.get(*vector("momentum.inertial"), *vector("torque.total")))

    def alone(fmu, folder):
        spacecraft = Stepped(extract(fmu, unzipdir=str(folder)))
        simulated = [step(spacecraft) for _ in range(300)]
        spacecraft.close()
        return simulated

    expected = [alone(sailer, tmp_path / "a"), alone(urchin_65, tmp_path / "b")]
    spacecraft_list = [Stepped(extract(fmu, unzipdir=str(tmp_path / name))) for fmu, name in ((sailer, "c"), (urchin_65, "d"))]
    together = [[], []]
    for _ in range(300):
        for spacecraft, simulated in zip(spacecraft_list, together):
            simulated.append(step(spacecraft))
    for spacecraft in spacecraft_list:
        spacecraft.close()
    assert together == expected
    assert expected[0] != expected[1]


def rewritten(fmu, target, change):
    """The same archive with its spacecraft.toml changed by hand."""
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(target, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            if name == "resources/spacecraft.toml":
                changed = change(content.decode("utf-8"))
                assert changed.encode("utf-8") != content
                content = changed.encode("utf-8")
            new.writestr(name, content)
    return str(target)


def refusal(fmu):
    messages = []

    def logger(environment, instance, status, category, message):
        messages.append(message.decode())

    with pytest.raises(Exception):
        simulate(fmu, 3600.0, days=0.5, output=["dump.count"], logger=logger)
    assert len(messages) == 1, messages
    return messages[0]


@pytest.mark.parametrize("spacecraft", ["SolarSailer", "MomentumPlant"])
def test_a_file_changed_inside_the_fmu_is_refused_with_the_reason(spacecraft, sailer, momentum_plant, tmp_path):
    fmu = sailer if spacecraft == "SolarSailer" else momentum_plant
    changed = rewritten(
        fmu, tmp_path / "changed.fmu", lambda text: re.sub(r"\nmass_kg = \S+", "\nmass_kg = 49.0", text)
    )
    message = refusal(changed)
    assert read_model_description(fmu).guid in message
    assert "GUID" in message and "spacecraft.toml" in message and "changed after packing" in message
    assert "pack the FMU again" in message


def test_a_bad_value_put_inside_the_fmu_is_refused_by_line(sailer, tmp_path):
    bad = rewritten(sailer, tmp_path / "bad.fmu", lambda text: text.replace("area_m2 = 0.5", "area_m2 = -0.5", 1))
    line = 1 + SAILER[: SAILER.index("area_m2 = 0.5")].count("\n")
    assert f"spacecraft.toml:{line}: panels[1].area_m2: found -0.5, allowed: a number above 0" in refusal(bad)


def test_a_comment_added_inside_the_fmu_changes_nothing(sailer, tmp_path):
    noted = rewritten(sailer, tmp_path / "noted.fmu", lambda text: "# mine\n" + text)
    assert np.array_equal(simulate(noted, 3600.0, days=2.0), simulate(sailer, 3600.0, days=2.0))


PLATE = """
[[plates]]
area_m2 = 2.0
center_m = [0, -1, 0]
normal = [0.0, -1.0, 0.0]
optics = "paint"
"""
PANEL = """
[[panels]]
area_m2 = 1.5
center_m = [2, 0, 0]
optics = "paint"
"""
WHEEL = """
[[wheels]]
axis = [1, 0, 0]
capacity_n_m_s = 4
"""
GOOD = HEAD.format(name="Good") + PLATE + PANEL + WHEEL


SHADE = """
[sunshade]
model = "cylinder"
rotation_deg = [0, 0, 2]

[sunshade.cylinder]
radius_m = 1
height_m = 2.5
subtended_angle_deg = 120
optics = "paint"
"""


def test_a_shade_given_as_cylinder_alone_runs_as_one_and_not_as_plates(heliotorque, dist, tmp_path):
    fmu = pack(heliotorque, dist, tmp_path, HEAD.format(name="Shade & 'Co' <ü>") + SHADE, "Shade")
    assert validate_fmu(fmu) == []
    assert "1 sunshade cylinder" in call(
        heliotorque, "check", "Shade.toml", "--template", (dist / "MomentumPlant.fmu").resolve(), folder=tmp_path
    ).stdout
    result = simulate(fmu, 3600.0, days=1.0, start=FIXED_LIGHT, output=vector("torque.solar"))
    assert np.abs(stack(result, "torque.solar")).max() > 1e-8
    messages = []

    def logger(environment, instance, status, category, message):
        messages.append(message.decode())

    with pytest.raises(Exception):
        simulate(fmu, 3600.0, days=1.0, start={"sunshade.shape": 1}, logger=logger)
    assert any("sunshade.shape: found plates, allowed: cylinder" in message for message in messages), messages


def test_a_good_file_is_checked_with_the_template_beside_the_user(heliotorque, dist, tmp_path):
    (tmp_path / "my.toml").write_bytes(b"\xef\xbb\xbf" + GOOD.replace("\n", "\r\n").encode())
    without = call(heliotorque, "check", "my.toml", folder=tmp_path)
    assert without.returncode == 2 and "--template" in without.stderr
    (tmp_path / "dist").mkdir()
    (tmp_path / "dist" / "MomentumPlant.fmu").write_bytes((dist / "MomentumPlant.fmu").read_bytes())
    checked = call(heliotorque, "check", "my.toml", folder=tmp_path)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert "my.toml: ok for MomentumPlant: 1 panel, 1 plate, 1 wheel" in checked.stdout


def test_the_template_is_not_overwritten(heliotorque, dist, tmp_path):
    (tmp_path / "dist").mkdir()
    template = tmp_path / "dist" / "MomentumPlant.fmu"
    template.write_bytes((dist / "MomentumPlant.fmu").read_bytes())
    packed = call(heliotorque, "pack", "--template", "MomentumPlant.fmu", folder=tmp_path / "dist")
    assert packed.returncode == 2 and "--name" in packed.stderr
    assert template.read_bytes() == (dist / "MomentumPlant.fmu").read_bytes()


def test_the_schema_of_a_spinner_is_the_committed_one_and_knows_the_shipped_file(heliotorque):
    schema = json.loads(call(heliotorque, "new", "--schema", "spinner").stdout)
    assert schema == json.loads((RESOURCES / "spinner.schema.json").read_text(encoding="utf-8"))

    def resolved(node):
        node = node.get("anyOf", [node])[0]
        return schema["$defs"][node["$ref"].rsplit("/", 1)[1]] if "$ref" in node else node

    def check(node, value, place):
        node = resolved(node)
        if isinstance(value, dict):
            assert node["additionalProperties"] is False and set(node.get("required", [])) <= value.keys(), place
            for key, inner in value.items():
                check(node["properties"][key], inner, f"{place}.{key}")
        elif isinstance(value, list):
            for inner in value:
                check(node["items"], inner, place)

    ace = tomllib.loads((RESOURCES / "ace.toml").read_text(encoding="utf-8"))
    for optional in ("damper", "group", "star_tracker", "sun_sensor", "l1_orbit", "start"):
        assert optional not in schema["required"]
    check(schema, ace, "ace")


STRONG_WHEELS = """\
name = "Strong wheels"
[mass_properties]
mass_kg = 1.0
center_of_mass_m = [0, 0, 0]
inertia_kg_m2 = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
[optics.black]
specular = 0
diffuse = 0
[[boxes]]
name = "bus"
center_m = [0, 0, 0]
size_m = [1, 1, 1]
optics = "black"
[start]
"orbit.center" = "sun"
"attitude.source" = "free"
"gravityGradient.enabled" = false
""" + "".join(
    f"[[wheels]]\naxis = {axis}\ncapacity_n_m_s = 50.0\nmax_torque_n_m = 1e6\ncoulomb_friction_n_m = 0.0\ninertia_kg_m2 = 0.159\n"
    for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1])
)


def test_very_strong_wheels_pack_with_a_note_and_turn_the_body(heliotorque, dist, tmp_path):
    (tmp_path / "Strong.toml").write_text(STRONG_WHEELS, encoding="utf-8")
    template = (dist / "MomentumPlant.fmu").resolve()
    packed = call(heliotorque, "pack", "--spacecraft", "Strong.toml", "--template", template, "--name", "Strong", folder=tmp_path)
    assert packed.returncode == 0 and "control.slewAcceleration starts at 10 rad/s2" in packed.stderr, packed.stderr
    torque_n_m, stop_s = 15.0, 2.0
    result = simulate_fmu(
        str(tmp_path / "Strong.fmu"), stop_time=stop_s, step_size=0.1, output_interval=0.1,
        start_values={"wheel[1].torqueCommand": torque_n_m}, output=["attitude.rate[1]"],
    )
    # The rotor takes part in the body's rate: (J - I) domega/dt = -u.
    assert result["attitude.rate[1]"][-1] == pytest.approx(-torque_n_m * stop_s / (1.0 - 0.159), rel=1e-5)


def test_check_names_the_model_whose_keys_it_judges_by(heliotorque, dist, tmp_path):
    # A parameter of MomentumPlant beside what only its own range refuses.
    text = STRONG_WHEELS.replace("mass_kg = 1.0", "mass_kg = 1e-4")
    (tmp_path / "light.toml").write_text(text, encoding="utf-8")
    checked = call(heliotorque, "check", "light.toml", "--template", (dist / "MomentumPlant.fmu").resolve(), folder=tmp_path)
    said = checked.stdout + checked.stderr
    assert checked.returncode != 0 and "spacecraft.mass" in said and "MomentumPlant" in said, said
    assert "unknown name" not in said, said
