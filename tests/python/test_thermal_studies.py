"""Studies `thermal/*`: paper 004's tables and figures, its numbers typed from the paper a second time."""

import pytest

from studies import table

# Case: solar (1e-7 m/s2), greatest albedo, infrared and recoil in % of it.
TABLE_7 = {1: (8.45, 0.32, 6.68, 25.60), 2: (5.51, 2.37, 14.10, 23.24), 3: (3.71, 0.95, 19.24, 19.99), 4: (6.22, 6.45, 26.79, 24.05)}
TABLE_8 = {1: (8.45, 0.20, 3.66, 23.78), 2: (5.51, 4.40, 25.22, 20.43), 3: (3.72, 0.77, 17.56, 18.97), 4: (6.33, 6.11, 25.70, 21.33)}
# The least albedo, infrared and recoil; of solar the paper prints none.
TABLE_7_LEAST = {1: (0.02, 0.18, 23.44), 2: (0.00, 0.01, 18.80), 3: (0.01, 0.14, 18.81), 4: (0.00, 0.00, 17.93)}
TABLE_8_LEAST = {1: (0.00, 0.17, 23.31), 2: (0.00, 0.02, 18.46), 3: (0.01, 0.08, 16.89), 4: (0.00, 0.00, 17.74)}
# What counts as the paper's, in %: solar, albedo, infrared, recoil.
ALLOWED_7, ALLOWED_8 = (0.15, 2.0, 5.0, 3.0), (0.15, 2.0, 8.0, 3.0)
# Cases and effects that do not.
FAR_7 = {(2, "thermal"), (3, "thermal"), (4, "thermal")}
FAR_8 = {(case, effect) for case in (1, 2, 3, 4) for effect in ("albedo", "thermal")} | {(1, "infrared"), (2, "infrared")}
EFFECTS = ("solar", "albedo", "infrared", "thermal")


@pytest.fixture(scope="module")
def study(studied):
    """What a study prints, and the rows of its CSV."""
    def run(name):
        text, files = studied(f"thermal/{name}")
        return text, table(files, f"{name}.csv")
    return run


def greatest(text):
    return float(text.split("/")[0])


def least(text):
    return float(text.split("/")[1])


def cells(rows):
    return {(int(row["case"]), row["effect"].split()[0]): row for row in rows}


@pytest.mark.parametrize(
    "name, printed, printed_least, allowed, far",
    [
        ("table7", TABLE_7, TABLE_7_LEAST, ALLOWED_7, FAR_7),
        ("table8", TABLE_8, TABLE_8_LEAST, ALLOWED_8, FAR_8),
    ],
)
def test_tables_carry_the_papers_numbers_and_verdicts_that_follow(study, name, printed, printed_least, allowed, far):
    text, rows = study(name)
    rows = cells(rows)
    assert len(rows) == 16
    for case, numbers in printed.items():
        for effect, number, percent in zip(EFFECTS, numbers, allowed):
            row = rows[case, effect]
            assert row["ours"] in text, row
            assert greatest(row["paper"]) == number
            off = greatest(row["ours"]) / number - 1.0
            stated = float(row["difference of the greatest"].split()[0]) / 100.0
            # Both are rounded: the number to its last digit, the difference to 0.1 %.
            assert abs(off - stated) < 0.006 / number + 0.0006
            verdict = f"off by more than {percent:g} %" if (case, effect) in far else f"within {percent:g} %"
            assert row["verdict"] == verdict, row
            assert (abs(stated) > percent / 100.0 + 0.0006) == ((case, effect) in far), row
        for effect, number in zip(EFFECTS[1:], printed_least[case]):
            row = rows[case, effect]
            assert least(row["paper"]) == number
            stated = float(row["difference of the least"].split()[0])
            assert abs(least(row["ours"]) - number - stated) < 0.011, row
        assert rows[case, "solar"]["difference of the least"] == "-"


def test_cells_come_closer_to_the_papers_infrared_than_their_limit(study):
    rows = cells(study("table7")[1])
    for case, (_, albedo, infrared, _) in TABLE_7.items():
        assert abs(greatest(rows[case, "infrared"]["by cells"]) / infrared - 1.0) < 0.015
        # A last digit of albedo is 3 % of the smallest.
        assert abs(greatest(rows[case, "albedo"]["by cells"]) - albedo) < 0.015 * albedo + 0.005
    assert greatest(rows[1, "infrared"]["ours"]) < 0.97 * TABLE_7[1][2]


def test_the_mean_sum_of_thermal_effects_is_the_papers(study):
    text, rows = study("figure12")
    assert text.count("agrees") == 4 and "differs" not in text
    for case in range(1, 5):
        lit = [[float(row[f"{effect}_m_s2"]) for effect in EFFECTS] for row in rows if int(row["case"]) == case]
        shares = [sum(forces[1:]) / forces[0] for forces in lit if forces[0] > 0.0]
        assert len(shares) > 100 and 0.195 < sum(shares) / len(shares) < 0.305


def test_a_year_has_as_many_orbits_as_its_elements_give(study):
    text, rows = study("figure13")
    # Paper 004's Table 3 has a semi-major axis of 10,175 km, its Table 4 one of 57.91e6 km.
    orbits = 7_600_714.0 / 43_446.6
    assert f"{orbits:.1f}" in text and text.count("agrees") == 5 and text.count("differs") == 1
    assert len(rows) >= 174
