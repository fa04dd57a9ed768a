"""Every program in examples/ runs, draws its picture, and prints what closed forms and other methods give."""

import pathlib
import re
import runpy
import sys
import tomllib

import numpy as np
import pytest
from fmpy import simulate_fmu

from simulation import vector
from spacecraft import RESOURCES, call, solar_torque

EXAMPLES = pathlib.Path(__file__).parents[2] / "examples"
HELPERS = {"fmu", "picture"}
TELESCOPE = RESOURCES / "examples" / "sunshield-telescope.toml"
AU_M, LIGHT_M_S = 149_597_870_700.0, 299_792_458.0
NUMBER = r"(-?\d+\.?\d*(?:e[-+]\d+)?)"


@pytest.fixture
def run(dist, tmp_path, monkeypatch, capsys):
    """Runs a program as from the command line; its printed text."""

    def run(name, folder=dist):
        monkeypatch.syspath_prepend(EXAMPLES)
        monkeypatch.setattr(sys, "argv", [f"{name}.py", str(folder), "--output", str(tmp_path)])
        runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
        picture = (tmp_path / f"{name}.svg").read_text(encoding="utf-8")
        assert "<svg" in picture and len(picture) > 5_000
        return capsys.readouterr().out

    return run


def numbers(pattern, text):
    """The numbers in the one place where this stands; # is a number."""
    [found] = re.findall(pattern.replace("#", NUMBER), text)
    return [float(number) for number in found] if isinstance(found, tuple) else float(found)


def shipped(file, center_of_mass_m):
    """MESSENGER's plates and panels, for the flat-plate law in plain numpy."""
    text = (RESOURCES / file).read_text(encoding="utf-8").replace("[[sunshade.plates]]", "[[plates]]")
    return re.sub(r"(?m)^center_of_mass_m = .*$", f"center_of_mass_m = {center_of_mass_m}", text)


def test_every_program_is_executed_here_and_told_of_in_the_readme():
    programs = {file.stem for file in EXAMPLES.glob("*.py")} - HELPERS
    text = pathlib.Path(__file__).read_text(encoding="utf-8")
    assert programs == set(re.findall(r'run\("(\w+)"', text))
    readme = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    assert programs == set(re.findall(r"^\| `(\w+)\.py` \|", readme, re.MULTILINE))
    for helper in HELPERS:
        users = [name for name in programs if f"from {helper} import" in (EXAMPLES / f"{name}.py").read_text(encoding="utf-8")]
        assert users, helper


def test_five_lines(run, dist):
    """The lines are the README's, and the momentum stays at its threshold."""
    readme = (EXAMPLES.parent / "README.md").read_text(encoding="utf-8")
    [lines] = re.findall(r"(?ms)^result = simulate_fmu\(.*?\]\)$", readme)
    program = (EXAMPLES / "five_lines.py").read_text(encoding="utf-8")
    assert lines.replace('"dist/MomentumPlant.fmu"', 'dist / "MomentumPlant.fmu"') in program
    largest, dumps = numbers("momentum # N.m.s, # dumps", run("five_lines"))
    assert 3.9 < largest <= 4.0 and dumps >= 1


def test_own_controller(run):
    """Light's torque by the flat-plate law; its error of pointing by the gain; momentum in the wheels grows at its rate."""
    off, torque, sunlight, momentum = numbers(
        r"off the Sun # arcsec, X torque # N.m \(# of sunlight, .*?X momentum in the wheels # N.m.s", run("own_controller")
    )
    pressure = 1361.0 / LIGHT_M_S * (AU_M / 4.5e10) ** 2
    # Against a spring of inertia times bandwidth squared; the other axes have no torque.
    turn = torque / (199.6 * 0.05**2)
    assert off == pytest.approx(np.degrees(abs(turn)) * 3600.0, rel=1e-3)
    sun = np.array([0.0, -np.cos(turn), np.sin(turn)])
    expected = solar_torque(shipped("messenger-thermal.toml", [0.0, 0.0, -0.0254]), sun, pressure, [0.0, 0.0])
    assert sunlight == pytest.approx(expected[0], rel=2e-6)
    # It began 10 deg off: the torque there is smaller, for a minute of the half hour.
    assert momentum == pytest.approx(torque * 1800.0, rel=0.03)


def test_commanded_attitude(run):
    """Held, momentum is torque times time; turning, that of a circle of this circumference: at most its diameter."""
    stop_s, held, turning, period_s = numbers(
        "after # s held # N.m.s, at most # N.m.s with a turn in # s", run("commanded_attitude")
    )
    pressure = 1361.0 / LIGHT_M_S * (AU_M / 1.496e11) ** 2
    spacecraft, sun = shipped("messenger.toml", [0.0, 0.0, -0.0254]), np.array([0.0, -1.0, 0.0])
    torque = np.linalg.norm(solar_torque(spacecraft, sun, pressure, [0.0, 0.0]))
    # The Sun moves by a third of a degree meanwhile.
    assert held == pytest.approx(torque * stop_s, rel=2e-3)
    assert turning == pytest.approx(torque * period_s / np.pi, rel=1e-2)


def test_parameter_study(run, momentum_plant):
    """Flown at the centre of mass that the study found, the plant has no X momentum left, and at none other."""
    slope, at_cm = numbers("# N.m.s per cm, none at Z = # cm", run("parameter_study"))
    names = vector("momentum.body")
    start = {"momentum.convention": 2} | {f"dump.threshold[{i}]": 1e9 for i in (1, 2, 3)}
    last = [
        simulate_fmu(
            momentum_plant, stop_time=30 * 86400, step_size=600, output_interval=86400, output=names,
            start_values=start | {"spacecraft.centerOfMass[3]": z_cm / 100.0},
        )[names[0]][-1]
        for z_cm in (at_cm, at_cm + 0.5)
    ]
    assert abs(last[0]) < 1e-3
    assert last[1] == pytest.approx(0.5 * slope, rel=1e-3)


def test_sobol_indices(run, momentum_plant, heliotorque, monkeypatch):
    """Of a nearly linear output the indices are the shares of the squared slopes times variances."""
    monkeypatch.setenv("HELIOTORQUE", str(heliotorque))
    text = run("sobol_indices")
    middle = {"spacecraft.centerOfMass[1]": 0.0, "spacecraft.centerOfMass[3]": -0.0254, "solar.scale": 1.0}
    widths = {"spacecraft.centerOfMass[1]": 0.01, "spacecraft.centerOfMass[3]": 0.005, "solar.scale": 0.05}

    def momentum(values):
        flight = simulate_fmu(
            momentum_plant, stop_time=3 * 86400, step_size=3 * 86400, output_interval=3 * 86400, start_values=values,
            output=["momentum.body[1]"],
        )
        return flight["momentum.body[1]"][-1]

    changes = [
        momentum(middle | {name: middle[name] + width}) - momentum(middle | {name: middle[name] - width})
        for name, width in widths.items()
    ]
    shares = np.square(changes) / np.square(changes).sum()
    for name, share in zip(widths, shares):
        alone, with_others = numbers(re.escape(name) + ": # alone, # with others", text)
        assert alone == pytest.approx(share, abs=0.03) and with_others == pytest.approx(share, abs=0.03)


def test_dask_sweep(run, dist, heliotorque, momentum_plant, monkeypatch):
    """Momentum is linear in the drawn place: mean and deviation are those of FMPy's runs at the ends of a standard deviation."""
    # The cluster's processes find the folder wherever they run.
    monkeypatch.setenv("HELIOTORQUE", str(heliotorque.resolve()))
    runs, mean, deviation, per_cm = numbers(
        r"# runs: X momentum # \+- # N.m.s, # N.m.s per cm", run("dask_sweep", dist.resolve())
    )
    names = vector("momentum.body")
    start = {"momentum.convention": 2} | {f"dump.threshold[{i}]": 1e9 for i in (1, 2, 3)}
    at_mean, above = [
        simulate_fmu(
            momentum_plant, stop_time=10 * 86400, step_size=3600, output_interval=86400, output=names,
            start_values=start | {"spacecraft.centerOfMass[3]": z_m},
        )[names[0]][-1]
        for z_m in (-0.0254, -0.0204)
    ]
    assert runs == 40
    assert per_cm == pytest.approx((above - at_mean) / 0.5, rel=1e-3)
    # A Latin hypercube's mean is near the distribution's, and its deviation too.
    assert mean == pytest.approx(at_mean, abs=0.05 * abs(above - at_mean))
    assert deviation == pytest.approx(abs(above - at_mean), rel=0.1)


def test_save_restore(run, momentum_plant):
    """The restored instance ends with the bits of a plant that was never interrupted."""
    text = run("save_restore")
    assert "restored: every bit the same" in text
    last = numbers("after ten days # N.m.s;", text)
    whole = simulate_fmu(momentum_plant, stop_time=10 * 86400, step_size=600, output_interval=600, output=["momentum.body[1]"])
    assert last == whole["momentum.body[1]"][-1]
    assert numbers("mass moved # N.m.s", text) != pytest.approx(last, abs=0.1)


def test_own_ephemeris(run):
    """Half the period of the ellipse, and light by the inverse square of the distance."""
    days, aphelion, perihelion, least, most = numbers("# d from # to # AU, force of light # to # uN", run("own_ephemeris"))
    half_period_days = 365.2568983 / 2.0 * (1.387 / 2.0) ** 1.5
    assert days == pytest.approx(half_period_days, abs=0.01)
    assert (aphelion, perihelion) == (1.0, 0.387)
    assert most / least == pytest.approx((1.0 / 0.387) ** 2, rel=1e-4)


def test_spinner_manoeuvre(run):
    """Paper 002: 114 pulses once a turn in 22.6 min for 2 deg; tapered, half the time and less nutation."""
    text = run("spinner_manoeuvre")
    sizes = "# pulses in # min turn the axis by # deg, nutation at most # deg, # deg at the end"
    uniform, tapered = (numbers(f"{name}: {sizes}", text) for name in ("uniform", "tapered"))
    # The burn is done a turn of 0.2 min after the last pulse begins.
    assert uniform[0] == 114 and uniform[1] == pytest.approx(22.6, abs=0.2) and uniform[2] == pytest.approx(2.0, abs=0.01)
    assert tapered[1] == pytest.approx(11.4, abs=0.2) and tapered[2] == pytest.approx(2.0, abs=0.01)
    assert tapered[4] < 0.0033 < uniform[4]


def test_wheel_controller(run):
    """It settles as the linear oscillator of the same poles does; the wheels only lend momentum."""
    settled_s, off, gained = numbers("after # s, # deg off at the end, momentum gained # N.m.s", run("wheel_controller"))
    bandwidth, damping = 0.03, 0.8
    time_s = np.arange(0.0, 600.0, 0.25)
    damped = bandwidth * np.sqrt(1.0 - damping**2)
    envelope = 30.0 * np.exp(-damping * bandwidth * time_s)
    error = envelope * (np.cos(damped * time_s) + damping * bandwidth / damped * np.sin(damped * time_s))
    linear_s = time_s[np.flatnonzero(np.abs(error) > 0.1)[-1] + 1]
    assert settled_s == pytest.approx(linear_s, rel=0.05)
    assert off < 0.02
    # A gravity gradient and light of less than 1e-4 N.m.
    assert gained < 600.0 * 1e-4


def test_guidance_loop(run):
    """The boresight is where the program's own geometry has the planet, and turns at the rate of nadir."""
    text = run("guidance_loop")
    assert "nadir within reach" in text
    off, stop_s, rate = numbers("# deg off at # s, rate # deg/s", text)
    assert off < 0.02
    # Of an ellipse about Mercury: its areal velocity over the square of the distance, from Kepler's equation.
    a_m, e, gm = 10136461.213078892, 0.74, 22031868551000.0
    n = np.sqrt(gm / a_m**3)
    anomaly = 2.0 * np.arctan(np.sqrt((1.0 - e) / (1.0 + e)) * np.tan(1.3))
    mean = anomaly - e * np.sin(anomaly) + n * stop_s
    for _ in range(50):
        anomaly -= (anomaly - e * np.sin(anomaly) - mean) / (1.0 - e * np.cos(anomaly))
    radius_m = a_m * (1.0 - e * np.cos(anomaly))
    expected = np.degrees(np.sqrt(gm * a_m * (1.0 - e * e)) / radius_m**2)
    # The body follows the Sun about nadir as well, which adds to the rate across.
    assert expected * 0.999 < rate < expected * 1.05


@pytest.fixture(scope="module")
def telescope(heliotorque, dist, tmp_path_factory):
    """The telescope's DisturbanceTorque in a folder of its own, after `check` and `pack` have called its file right."""
    folder = tmp_path_factory.mktemp("telescope")
    for model in ("DisturbanceTorque", "MomentumPlant"):
        done = call(
            heliotorque, "pack", "--spacecraft", TELESCOPE, "--model", model, "--template", (dist / f"{model}.fmu").resolve(),
            "--name", "SunshieldTelescope", "--output", folder / ("SunshieldTelescope.fmu" if model[0] == "D" else "plant.fmu"),
        )
        assert done.returncode == 0, done.stderr
    return folder


def test_check_calls_the_telescope_right(heliotorque, telescope):
    # The plant by what stands in it: shipped ones are run through every call elsewhere.
    for file, *options in ((TELESCOPE,), (telescope / "SunshieldTelescope.fmu",), (telescope / "plant.fmu", "--static")):
        done = call(heliotorque, "check", file, *options)
        assert done.returncode == 0, done.stdout + done.stderr


def test_trim_flap(run, telescope):
    """No mean torque is left, and what the flap changed is the flat-plate law of the flap alone."""
    text = run("trim_flap", telescope)
    flap_deg, left, level = numbers("flap at # deg: # N.m.s in a week, # N.m.s with the flap level", text)
    assert left == 0.0 and level > 10.0
    spacecraft = tomllib.loads(TELESCOPE.read_text(encoding="utf-8"))
    assert spacecraft["panels"][0]["angle_deg"] == pytest.approx(flap_deg, abs=0.5)
    # Area and centre of the flap, by hand from its corners; nothing shadows it.
    flap = f"""
[mass_properties]
center_of_mass_m = {spacecraft["mass_properties"]["center_of_mass_m"]}
[optics]
front = {{ specular = 0.8, diffuse = 0.05 }}
[[panels]]
area_m2 = 6.6
center_m = [0.0, 0.4, -11.9]
axis = [1.0, 0.0, 0.0]
zero_normal = [0.0, -1.0, 0.0]
optics = "front"
"""
    pressure = 1361.0 / LIGHT_M_S * (AU_M / 1.51094e11) ** 2
    changes = []
    for pitch in np.radians(np.arange(-5.0, 45.1, 2.5)):
        sun = np.array([0.0, -np.cos(pitch), -np.sin(pitch)])
        turned, straight = (solar_torque(flap, sun, pressure, [np.radians(angle)])[0] for angle in (flap_deg, 0.0))
        changes.append(turned - straight)
    assert np.mean(changes) * 7 * 86400 == pytest.approx(left - level, rel=1e-3)


def test_the_telescope_goes_round_the_sun_beyond_the_earth(telescope):
    result = simulate_fmu(
        str(telescope / "plant.fmu"), stop_time=7 * 86400, step_size=3600, output_interval=3600,
        output=["sun.distance", "sun.litFraction", "torque.solar[1]", "momentum.body[1]", "wheel[6].momentum", "dump.count"],
    )
    assert result["sun.distance"] == pytest.approx(1.01 * AU_M, rel=1e-5)
    assert (result["sun.litFraction"] == 1.0).all()
    assert result["momentum.body[1]"][-1] == pytest.approx(result["torque.solar[1]"].mean() * 7 * 86400, rel=0.05)
