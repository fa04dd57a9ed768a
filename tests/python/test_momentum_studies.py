"""`heliotorque study momentum/*` flies what FMPy flies, and says of its own numbers what they say."""

import itertools
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from flight import DAY_S, PAPER, PAPER_COUNTS, dump_times, fly
from studies import table

# As the study writes its rows.
PAPER_CELLS = {
    (f"{threshold:g} N.m.s", offset): count
    for threshold, counts in PAPER_COUNTS.items()
    for offset, count in zip(("0 cm", "-2.54 cm", "-5.08 cm"), counts)
}
PAPERS, CYLINDER = "paper's", "cylinder"


@pytest.fixture(scope="module")
def flown(studied):
    return {name: studied(f"momentum/{name}") for name in ("table2", "table3", "figure4")}


def dumps_by_row(files, rows):
    """The dump times of every row, in days; the cases of `dumps.csv` stand in the order of the rows."""
    cases = itertools.groupby(table(files, "dumps.csv"), key=lambda row: row["case"])
    times = [(case, np.array([float(row["dump_time_d"]) for row in group])) for case, group in cases]
    assert len(times) == len(rows)
    for row, (case, days) in zip(rows, times):
        assert f"{row['threshold']}, " in case and case.endswith(f"Z {row['Z offset']}")
        assert (np.diff(days) > 0.0).all() and 0.0 < days[0] and days[-1] <= 90.0
    return [days for _, days in times]


def cylinder(rows):
    """The paper's six cells, by threshold and offset."""
    cells = {(row["threshold"], row["Z offset"]): row for row in rows if (row["shade"], row["momentum"]) == (CYLINDER, PAPERS)}
    assert set(cells) == set(PAPER_CELLS)
    return cells


def test_table_2_counts_as_its_verdicts_say(flown):
    text, files = flown["table2"]
    rows = table(files, "table2.csv")
    for row in rows:
        number = re.fullmatch(r"(\d+)", row["paper"])
        assert row["momentum"] == PAPERS or not number, "the paper has no such row"
        if number:
            near = abs(int(row["ours"]) - int(number[1])) <= 2
            assert row["verdict"] == ("within 2" if near else "off"), row
    for cell, row in cylinder(rows).items():
        assert int(row["paper"]) == PAPER_CELLS[cell] and row["verdict"] == "within 2", row
        assert row["our gaps"] in text
    for row, days in zip(rows, dumps_by_row(files, rows)):
        # Under the physical momentum two dumps can fall into one step, of which the file has the last.
        assert len(days) == int(row["ours"]) if row["momentum"] == PAPERS else len(days) <= int(row["ours"]), row


@pytest.mark.parametrize("threshold, offset_cm", [(4, -5.08), (7, -2.54)])
def test_dumps_are_those_that_fmpy_flies(flown, momentum_plant, threshold, offset_cm):
    start = PAPER | {"sunshade.model": 2, "spacecraft.centerOfMass[3]": offset_cm / 100.0}
    start |= {f"dump.threshold[{axis}]": float(threshold) for axis in (1, 2, 3)}
    expected = [f"{time / DAY_S:.6f}" for time in dump_times(fly(momentum_plant, start=start))]
    label = [f"{threshold} N.m.s", CYLINDER, PAPERS, f"Z {offset_cm} cm"]
    for name in ("table2", "table3"):
        found = table(flown[name][1], "dumps.csv")
        assert [row["dump_time_d"] for row in found if all(part in row["case"] for part in label)] == expected


def test_table_3_has_the_gaps_of_its_dumps(flown):
    text, files = flown["table3"]
    rows = table(files, "table3.csv")
    for cell, row in cylinder(rows).items():
        assert re.match(r"closest|2, 55 d apart", row["paper"]) and row["ours"] in text and row["verdict"], cell
    for row, days in zip(rows, dumps_by_row(files, rows)):
        gaps = np.diff(days)
        numbers = [float(number) for number in re.findall(r"(?:closest|farthest|typical|-|2,) ?([\d.]+)", row["ours"])]
        if len(days) > 2:
            expected = [gaps.min(), gaps.max(), *np.percentile(gaps, [25.0, 75.0])]
            assert np.all(np.abs(np.array(numbers) - expected) < [0.0501, 0.0501, 0.501, 0.501]), (row, expected)
        elif len(days) == 2:
            assert abs(numbers[0] - gaps[0]) < 0.501, row
        assert (row["mission requirement"] == "closer than 5 days") == bool((gaps < 5.0).any()), row


def test_figure_4_draws_the_momentum_that_fmpy_flies(flown, momentum_plant):
    _, files = flown["figure4"]
    result = fly(momentum_plant, start=PAPER | {"sunshade.model": 2} | {f"dump.threshold[{axis}]": 4.0 for axis in (1, 2, 3)})
    rows = [row for row in table(files, "figure4.csv") if row["case"].endswith("Z 0 cm")]
    hourly = slice(None, None, 6)
    assert np.abs(np.array([float(row["time_d"]) for row in rows]) - result["time"][hourly] / DAY_S).max() < 1e-6
    momentum = np.array([float(row["momentum_x_n_m_s"]) for row in rows])
    assert np.abs(momentum - result["momentum.body[1]"][hourly]).max() < 1e-9
    picture = "".join(ElementTree.fromstring(files["figure4.svg"]).itertext())
    for offset in ("0 cm", "-2.54 cm", "-5.08 cm"):
        assert f"Z = {offset}, " in picture
    assert files["figure4.svg"] == flown["table2"][1]["figure4.svg"]
