"""Studies `control/*`: attitudes, momenta and modes computed again with numpy from the histories.

The histories carry the true attitude (EME2000 to body) and rate of every sample and, by study, wheels, Sun, commands.
"""

import math
import subprocess

import numpy as np
import pytest
from fmpy import read_model_description

from studies import attitude, program, table, vector

BORESIGHT = np.array([0.0, -1.0, 0.0])


def turn_deg(before, after):
    """Rotation angle between two attitudes, from the part of the matrix that is exact for small angles."""
    m = after @ before.T
    sine = np.linalg.norm([m[1, 2] - m[2, 1], m[2, 0] - m[0, 2], m[0, 1] - m[1, 0]]) / 2.0
    return math.degrees(math.atan2(sine, (np.trace(m) - 1.0) / 2.0))


def angle_deg(a, b):
    return math.degrees(math.atan2(np.linalg.norm(np.cross(a, b)), a @ b))


def by_case(files, name):
    cases = {}
    for row in table(files, name):
        cases.setdefault(row["case"], []).append(row)
    return cases


def starts(dist, fmu):
    variables = read_model_description(str(dist / fmu)).modelVariables
    return {v.name: float(v.start) for v in variables if v.start and v.type == "Real"}


@pytest.fixture(scope="module")
def plant(dist):
    return starts(dist, "MomentumPlant.fmu")


@pytest.fixture(scope="module")
def guidance(dist):
    return starts(dist, "Guidance.fmu")


@pytest.fixture(scope="module")
def slew(studied):
    text, files = studied("control/slew")
    return text, {row["case"]: row for row in table(files, "slew.csv")}, by_case(files, "slew-history.csv")


@pytest.fixture(scope="module")
def safe_mode(studied):
    text, files = studied("control/safe-mode")
    return text, table(files, "safe-mode.csv"), by_case(files, "safe-mode-history.csv")


@pytest.fixture(scope="module")
def transition(studied):
    text, files = studied("control/transition")
    return text, table(files, "transition.csv"), by_case(files, "transition-history.csv")


RATE = "rate_x_rad_s rate_y_rad_s rate_z_rad_s"


# Slew


@pytest.mark.parametrize("case, axis", [("about X", 0), ("about Y", 1), ("about Z", 2)])
def test_a_slew_turns_about_its_axis_within_the_limits_and_stops_there(slew, plant, case, axis):
    _, rows, histories = slew
    history, row = histories[case], rows[case]
    assert row["verdict"] == "settles, not saturated" and row["a wheel full [s]"] == "never"
    first, last = attitude(history[0]), attitude(history[-1])
    # What the integral has not yet made up for: 5e-4 N m of sunlight on 200 kg m2 at 0.0116 rad/s2 a rad are 0.012 deg.
    assert turn_deg(first, last) == pytest.approx(60.0, abs=2e-3)
    # The axis of the slew is the one direction that both attitudes share.
    assert abs((last @ first.T)[axis, axis] - 1.0) < 1e-8
    rates = np.array([vector(sample, RATE) for sample in history])
    assert rates[:, axis].max() <= plant["control.slewRate"] * 1.002
    assert rates[:, axis].min() >= -1e-3 * plant["control.slewRate"]
    steps = np.diff(rates[:, axis]) / np.diff([float(sample["time_s"]) for sample in history])
    assert np.abs(steps).max() <= plant["control.slewAcceleration"] * 1.05
    off = [turn_deg(attitude(sample), last) for sample in history]
    settled = next(k for k in reversed(range(len(off))) if off[k] > 0.01) + 1
    assert float(row["settled [s]"]) == pytest.approx(float(history[settled]["time_s"]) - 10.0, abs=0.51)
    # Trapezoid: the area under the rate is the angle.
    peak, ramp = plant["control.slewRate"], plant["control.slewAcceleration"]
    duration = math.radians(60.0) / peak + peak / ramp
    assert float(row["by the limits [s]"]) == pytest.approx(duration, abs=0.051)


@pytest.mark.parametrize("case, left", [("wheels full, dump", 0.0), ("wheels full, threshold", 0.9 * 5.5)])
def test_full_wheels_stop_the_slew_until_a_dump_frees_them(slew, plant, case, left):
    _, rows, histories = slew
    history = histories[case]
    assert rows[case]["verdict"] == "flagged, recovered by a dump"
    capacity = plant["wheel[1].capacity"]
    for sample in history:
        for k in range(1, 5):
            held = abs(float(sample[f"wheel{k}_momentum_n_m_s"]))
            assert held <= capacity * (1.0 + 1e-12)
            assert (sample[f"wheel{k}_full"] == "true") == (held >= capacity * (1.0 - 1e-9)), sample["time_s"]
    full = [float(sample["time_s"]) for sample in history if "true" in [sample[f"wheel{k}_full"] for k in range(1, 5)]]
    assert full[0] < 60.0 and 900.0 < full[-1] < 1200.0
    dumping = [float(sample["time_s"]) for sample in history if sample["dumping"] == "true"]
    assert dumping[0] == pytest.approx(900.0, abs=0.51)
    last = history[-1]
    assert last["dumps"] == "1" and "true" not in [last[f"wheel{k}_full"] for k in range(1, 5)]
    # The dump's target counts in the body frame of its begin: the slew turns about Y alone.
    assert float(last["momentum_y_n_m_s"]) == pytest.approx(left, abs=0.1)
    assert turn_deg(attitude(history[0]), attitude(last)) == pytest.approx(60.0, abs=1e-3)


def run(heliotorque, dist, folder, name, *options):
    command = program(heliotorque, dist, folder, name, *options)
    return subprocess.run(command, capture_output=True, text=True, encoding="utf-8")


def test_angle_and_step_are_taken_where_they_mean_something(heliotorque, dist, tmp_path, slew):
    found = run(heliotorque, dist, tmp_path, "control/slew", "--only", "about X", "--angle", "-20deg")
    assert found.returncode == 0, found.stderr
    files = {file.name: file.read_text(encoding="utf-8") for file in tmp_path.iterdir()}
    assert sorted(files) == ["slew-about-x.svg", "slew-history.csv", "slew.csv"]
    history = table(files, "slew-history.csv")
    assert turn_deg(attitude(history[0]), attitude(history[-1])) == pytest.approx(20.0, abs=2e-3)
    assert float(history[len(history) // 3]["rate_x_rad_s"]) < 0.0
    refused = run(heliotorque, dist, tmp_path, "control/safe-mode", "--angle", "20deg")
    assert refused.returncode == 2 and "control/safe-mode does not take --angle" in refused.stderr
    refused = run(heliotorque, dist, tmp_path, "control/transition", "--step", "0.3")
    assert refused.returncode == 2 and "a second or a whole part of it" in refused.stderr
    assert run(heliotorque, dist, tmp_path, "control/slew", "--angle", "20").returncode == 2


def test_a_slew_does_not_depend_on_its_steps(heliotorque, dist, tmp_path, slew):
    # A power of two, so that the times of the samples are the same doubles.
    found = run(heliotorque, dist, tmp_path, "control/slew", "--only", "about X", "--step", "0.125")
    assert found.returncode == 0, found.stderr
    fine = table({"slew-history.csv": (tmp_path / "slew-history.csv").read_text()}, "slew-history.csv")
    assert fine == slew[2]["about X"]


# Safe modes

OPERATIONAL, SAFE_HOLD, EARTH_ACQUISITION = "1", "2", "3"


def between(history, start, stop):
    chosen = [row for row in history if start <= float(row["time_s"]) <= stop]
    assert chosen
    return chosen


def sun_body(row):
    return attitude(row) @ vector(row, "sun_x sun_y sun_z")


def test_every_mode_is_reached_and_left_only_by_request(safe_mode):
    _, checks, histories = safe_mode
    assert len(checks) == 22 and {row["verdict"] for row in checks} == {"agrees"}

    def modes(history):
        changes = [history[0]["mode"]]
        for row in history:
            if row["mode"] != changes[-1]:
                changes.append(row["mode"])
        return changes

    assert modes(histories["attitude lost"]) == [OPERATIONAL, EARTH_ACQUISITION, SAFE_HOLD, OPERATIONAL]
    assert modes(histories["zone violated"]) == [OPERATIONAL, SAFE_HOLD, OPERATIONAL]
    # Exchanged and sampled once a second.
    lost = histories["attitude lost"]
    for mode, since, until in [(EARTH_ACQUISITION, 364, 6300), (SAFE_HOLD, 6302, 7800), (OPERATIONAL, 7802, 9300)]:
        assert {row["mode"] for row in between(lost, since, until)} == {mode}
    assert {row["attitude_known"] for row in between(lost, 364, 5999)} == {"false"}
    assert {row["attitude_known"] for row in between(lost, 6003, 9300)} == {"true"}


def test_earth_acquisition_puts_the_sun_on_the_boresight_and_turns_about_it(safe_mode, guidance):
    lost = safe_mode[2]["attitude lost"]
    rate = guidance["earthAcquisition.rate"]
    for start, stop in [(1500, 2000), (5500, 6300)]:
        rows = between(lost, start, stop)
        assert max(angle_deg(sun_body(row), BORESIGHT) for row in rows) < 0.01
        for row in rows:
            assert np.linalg.norm(vector(row, RATE) - rate * BORESIGHT) < 0.05 * rate
            assert float(row["sun_angle_deg"]) == pytest.approx(angle_deg(sun_body(row), BORESIGHT), abs=1e-9)
        # Seen from EME2000 the body turns about the Sun line: by the angle that the rate gives.
        turned = turn_deg(attitude(rows[0]), attitude(rows[-1]))
        assert turned == pytest.approx(math.degrees(rate) * (stop - start), rel=1e-3)
    assert min(angle_deg(sun_body(row), BORESIGHT) for row in between(lost, 0, 363)) > 89.0


def test_safe_hold_points_at_the_earth_within_its_zone_whatever_is_commanded(safe_mode, guidance):
    for history, start, stop in [
        (safe_mode[2]["attitude lost"], 7600, 7800), (safe_mode[2]["zone violated"], 2200, 2400),
    ]:
        for row in between(history, start, stop):
            c = attitude(row)
            x, y, z = sun_body(row)
            assert abs(math.atan2(x, -y)) < guidance["safeHold.keepIn.azimuth"]
            assert abs(math.asin(z)) < guidance["safeHold.keepIn.elevation"]
            # In the antennas' plane.
            assert abs((c @ vector(row, "earth_x earth_y earth_z"))[2]) < math.sin(guidance["link.beam"])
            assert row["link"] == "true"
    for row in between(safe_mode[2]["attitude lost"], 9100, 9300):
        assert angle_deg(sun_body(row), np.array([0.0, 0.0, 1.0])) < 0.01


def test_the_zone_demotes_by_one_and_then_bounds_the_target(safe_mode, guidance):
    history = safe_mode[2]["zone violated"]
    first = next(row for row in history if row["mode"] == SAFE_HOLD)
    assert 300 + guidance["monitor.persistence"] <= float(first["time_s"]) <= 303 + guidance["monitor.persistence"]
    for row in between(history, 3800, 4000):
        x, y, z = sun_body(row)
        # As near to +Z as the zone lets the Sun come: its elevation bound.
        assert math.asin(z) == pytest.approx(guidance["keepIn.elevation"], abs=1e-6) and abs(x) < 1e-6


# Transition


def test_the_response_settles_as_long_as_its_limits_take_and_differs_from_the_papers(transition, plant):
    text, rows, histories = transition
    for case, history in histories.items():
        found = {row["quantity"]: row for row in rows if row["case"] == case}
        at = {float(row["time_s"]): row for row in history}
        commanded = "command_q1 command_q2 command_q3 command_q4"
        slew = turn_deg(attitude(at[500.0], commanded), attitude(at[501.0], commanded))
        assert found["slew angle"]["ours"] == f"{slew:.2f} deg" and 50.0 < slew < 70.0
        peak, ramp = plant["control.slewRate"], plant["control.slewAcceleration"]
        limits = math.radians(slew) / peak + peak / ramp
        assert found["the same by the limits alone"]["ours"] == f"{limits:.0f} s"

        def is_off(row):
            error = turn_deg(attitude(row, "estimate_q1 estimate_q2 estimate_q3 estimate_q4"), attitude(row, commanded))
            expected = vector(row, "command_x_rad_s command_y_rad_s command_z_rad_s")
            return error > 0.1 or math.degrees(np.linalg.norm(vector(row, RATE) - expected)) > 0.005

        settled = max(time for time, row in at.items() if is_off(row)) + 1.0 - 500.0
        row = found["time to settle"]
        assert row["ours"] == f"{settled:.0f} s" and abs(settled - limits) < 15.0
        assert row["verdict"] == ("agrees" if 70.0 <= settled <= 100.0 else "differs")
    assert "nothing is fitted" in text


def test_the_sun_stays_on_the_shade_all_the_way(transition):
    _, rows, histories = transition
    for case, history in histories.items():
        most = 0.0
        for row in history[1:]:
            sun = vector(row, "sun_x_m sun_y_m sun_z_m")
            estimated = attitude(row, "estimate_q1 estimate_q2 estimate_q3 estimate_q4") @ sun
            most = max(most, angle_deg(estimated, BORESIGHT))
            assert angle_deg(attitude(row) @ sun, BORESIGHT) < 0.5
        found = {row["quantity"]: row for row in rows if row["case"] == case}
        assert found["Sun from -Y in the estimated attitude, greatest"]["ours"] == f"{most:.1e} deg".replace("e-0", "e-")
        assert found["seconds outside the keep-in zone, estimated"]["ours"] == "0"


def test_noise_is_in_the_estimate_and_in_nothing_without_it(transition, plant):
    histories = transition[2]

    def errors_arc_s(case):
        estimate = "estimate_q1 estimate_q2 estimate_q3 estimate_q4"
        return np.array([3600.0 * turn_deg(attitude(row, estimate), attitude(row)) for row in histories[case]])

    # Between two samples the estimate turns on at its rate: a h2 / 2 of the slew's acceleration.
    acceleration, interval = plant["control.slewAcceleration"], 1.0 / plant["control.rate"]
    most = 3600.0 * math.degrees(acceleration * interval**2 / 2.0)
    assert 0.5 * most < errors_arc_s("without noise").max() < 1.1 * most
    # Better than the star tracker's 5 arc seconds about each axis, as the gyros average it.
    noisy = errors_arc_s("with noise")[100:]
    assert 0.1 < np.sqrt((noisy**2).mean()) < 5.0 * math.sqrt(3.0)
