"""Parts of the studies in harness/studies that need no FMU, against what is known otherwise."""

import importlib
import json
import pathlib
import sys

import numpy as np
import pytest

STUDIES = pathlib.Path(__file__).parents[2] / "harness/studies"


@pytest.fixture
def load(monkeypatch):
    """Imports a module of the studies, which puts their folder in place of a script's first."""
    monkeypatch.syspath_prepend(STUDIES)
    return lambda name: importlib.import_module(name)


def test_cells_read_as_numbers_do(load):
    study = load("study")
    for text, expected in (
        ("-0", "0"), ("-0.000", "0.000"), ("-0.0e0,-0.00000e0", "0.0e0,0.00000e0"), ("-0.05 -1.0", "-0.05 -1.0"),
        ("X -0.00, Z -0.01 uN.m (-0.0).", "X 0.00, Z -0.01 uN.m (0.0)."), ("2009-04-06", "2009-04-06"),
    ):
        assert study.unsigned_zeros(text) == expected
    assert study.scientific([1.5e-8, 0.0, -2e12]) == ["1.500000e-8", "0.000000e0", "-2.000000e12"]
    assert [study.exact(it) for it in (1e-7, 0.1, 3.0)] == ["1e-7", "0.1", "3.0"]
    assert [study.plain(it) for it in (12.0, 0.5, 1e-5)] == ["12", "0.5", "0.00001"]


def test_a_number_agrees_to_half_its_last_digit(load):
    rounds = load("study").rounds
    assert rounds(0.01764, 0.0176, 1e-4) and rounds(0.01765, 0.0176, 1e-4)
    assert not rounds(0.017651, 0.0176, 1e-4) and not rounds(float("nan"), 0.0176, 1e-4)


def test_a_body_that_turns_about_z_sees_x_go_toward_minus_y(load):
    vectors = load("vectors")
    q = vectors.turned([0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.5])
    assert q == pytest.approx([0.0, 0.0, np.sin(0.25), np.cos(0.25)], abs=1e-15)
    seen = vectors.to_body(q, [1.0, 0.0, 0.0])
    assert seen == pytest.approx([np.cos(0.5), -np.sin(0.5), 0.0], abs=1e-15)
    assert vectors.rotation_rad([0.0, 0.0, 0.0, 1.0], -q) == pytest.approx([0.0, 0.0, 0.5], abs=1e-15)
    assert vectors.body_angles_deg(vectors.body_direction(0.3, -0.2)) == pytest.approx(np.degrees([0.3, -0.2]), abs=1e-12)


def test_gaps_of_a_known_list(load):
    Spacing = load("momentum.cases").Spacing
    spacing = Spacing.of(np.array([1.0, 5.0, 15.0, 17.0, 37.0, 43.0]))
    assert spacing.extremes_d == (2.0, 20.0) and spacing.typical_d == (4.0, 10.0) and spacing.five_days() == "broken"
    assert str(spacing) == "closest 2.0 d, farthest 20.0 d, typical 4-10 d"
    for closest_d, typical_d, expected in (
        (2.5, (9.0, 30.0), "typical gaps overlap, closest within 25 %"), (2.7, (9.0, 30.0), "typical gaps overlap, closest off"),
        (2.0, (11.0, 30.0), "typical gaps off, closest within 25 %"), (9.0, (1.0, 3.0), "off"),
    ):
        assert spacing.against(Spacing(9, (closest_d, 30.0), typical_d)) == expected
    one = Spacing(2, (55.0, 55.0))
    assert Spacing.of([3.0, 59.0]).against(one) == "gap within 25 %" and Spacing.of([3.0, 33.0]).against(one) == "off"
    assert Spacing.of([3.0, 59.0, 119.0]).against(one) == "closest within 25 %"
    none = Spacing(1)
    assert str(Spacing.of([])) == "0 in 90 d" and str(Spacing.of([3.0, 58.0])) == "2, 55.0 d apart"
    assert Spacing.of([3.0]).against(none) == "no gap, as in the paper" and Spacing.of([3.0, 58.0]).against(none) == "off"


def test_trends_compare_every_pair_once_and_name_exceptions(load):
    cases, trends = load("momentum.cases"), load("momentum.counts").trends

    class Counted:
        def __init__(self, case, count):
            self.case, self.count = case, count

    group = [(cases.OWN, cases.CYLINDER, "paper's")]
    all_cases = cases.with_strategies(cases.STRATEGIES, group, [4.0, 7.0], cases.ALL_OFFSETS)
    # Two steps of strategy in 14 columns, one of threshold in 21, four along Z in 6 rows.
    assert "73 of 73 comparisons hold." in trends([Counted(case, 3) for case in all_cases])
    text = trends([Counted(case, int(case.strategy == "predictive")) for case in all_cases])
    assert "59 of 73" in text and text.count("\n") == 14 and "strategy: 0 dumps with [reactive, 4 N.m.s" in text
    assert "73 of 73" in trends([Counted(case, 9 if case.offset_in[2] > 0 else 1) for case in all_cases])


def test_the_verdict_on_nutation_turns_with_the_numbers(load):
    against = load("spin.spinner").against_paper
    for least_deg, most_deg, ends_deg, expected in (
        (0.0005, 0.0324, (0.02, 0.03), "the paper's range and end"), (0.0005, 0.0324, (0.002, 0.008), "the paper's range, not its end"),
        (0.0005, 0.0359, (0.02, 0.03), "not the paper's range, though its end"),
        (0.0005, 0.0359, (0.01, 0.02), "not the paper's range, nor its end"),
        (0.0005, 0.0176, (0.003, 0.003), "not the paper's range: never beyond the envelope of 0.0177"),
        (0.0005, 0.0190, (0.003, 0.003), "not the paper's range, nor its end"),
    ):
        assert against(least_deg, most_deg, ends_deg, 0.0177) == expected


def test_the_least_time_of_a_slew_is_that_of_full_acceleration_and_braking(load):
    limits = load("control.limits").SlewLimits(0.3, 0.1)
    for angle_rad in (0.2, 0.9, 2.5):
        angle, rate, steps, step_s = 0.0, 0.0, 0, 1e-3
        while angle < angle_rad and (rate > 0.0 or steps == 0):
            requested = 0.3 if angle + rate * rate / 0.2 < angle_rad else 0.0
            after = rate + np.clip(requested - rate, -0.1 * step_s, 0.1 * step_s)
            angle, rate, steps = angle + 0.5 * (rate + after) * step_s, after, steps + 1
        assert limits.least_s(angle_rad) == pytest.approx(steps * step_s, abs=0.1)
        assert limits.angle_rad(limits.least_s(angle_rad)) == pytest.approx(angle_rad, abs=1e-14)


def test_draws_have_their_moments_and_depend_on_nothing_else(load):
    normal_vectors = load("flyby.draws").normal_vectors
    drawn = normal_vectors(3, 0, 20_000)
    assert np.abs(drawn.mean(axis=0)).max() < 0.03 and np.cov(drawn.T) == pytest.approx(np.eye(3), abs=0.04)
    assert np.array_equal(drawn[:11], normal_vectors(3, 0, 11)) and not np.array_equal(drawn[:11], normal_vectors(4, 0, 11))


def test_the_block_of_zero_key_is_that_of_chacha8(load):
    draws = load("flyby.draws")
    # Key, nonce and counter zero, of the eStream test vectors (draft-strombergson-chacha-test-vectors).
    draws.key = lambda seed: np.zeros(8, dtype=np.uint32)
    words = draws.block(0, np.zeros(1, dtype=np.uint64))[0]
    assert words.astype("<u4").tobytes().hex().startswith("3e00ef2f895f40d67f5bb8e81f09a5a12c840ec3ce9a7f3b181be188ef711a1e")


def test_partials_between_rows_are_those_of_a_free_path_through_them(load, tmp_path):
    times_s, by_velocity = np.arange(5) * 0.1, np.arange(1.0, 10.0)
    departure = {"byMiss_1_s": [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]}
    found = {"aim_m": [3e6, 0.0], "arrival_s": 9.0, "osculation_s": 8.0, "altitude_m": 2e5, "excessSpeed_m_s": 5e3}
    (tmp_path / "plan.json").write_text(json.dumps(found | {"maneuvers": {"departure": departure}}))

    # Partials by the velocity swing, those by the position are minus their rate.
    def partials(time_s):
        by_v, by_r = np.sin(time_s) * by_velocity.reshape(3, 3), -np.cos(time_s) * by_velocity.reshape(3, 3)
        return np.concatenate([by_r, by_v], axis=-1)

    rows = [[time_s, *np.zeros(6), *partials(time_s).ravel()] for time_s in times_s]
    np.savetxt(tmp_path / "partials.csv", rows, delimiter=",", header="time_s")
    encounter = load("flyby.leg").Encounter(tmp_path)
    for time_s, error in ((0.0, 1e-14), (0.2, 1e-14), (0.4, 1e-14), (0.13, 1e-4), (0.37, 1e-4)):
        assert encounter.at(time_s) == pytest.approx(partials(time_s), abs=error)
    desired_m_s = encounter.desired_m_s(0.2, np.array([100.0, -50.0]))
    assert encounter.at(0.2)[:2, 3:] @ desired_m_s == pytest.approx([-100.0, 50.0])
