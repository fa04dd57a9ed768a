"""The README's validation tables say what the studies print."""

import pathlib

import pytest

from studies import table

README = (pathlib.Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8").splitlines()
OFFSETS = ("0 cm", "-2.54 cm", "-5.08 cm")


def line(*cells):
    return "| " + " | ".join(cells) + " |"


def dump_rows(table_2, assumptions):
    """Dumps by rule and choice; what is outside the paper's is bold."""
    counts = {}
    for row in table_2:
        if row["momentum"] == "paper's" and row["shade"] != "plates":
            counts.setdefault((row["dumps to"], "study's own", row["threshold"]), []).append(row)
    for row in assumptions:
        counts.setdefault((row["dumps to"], row["choice"], row["threshold"]), row)

    def cell(rule, choice, threshold):
        found = counts.get((rule, choice, threshold))
        if found is None:
            return ""
        if isinstance(found, list):
            assert [row["Z offset"] for row in found] == list(OFFSETS)
            text, off = " / ".join(row["ours"] for row in found), any(row["verdict"] == "off" for row in found)
        else:
            text, off = found["ours"], found["verdict"] == "off"
        return f"**{text}**" if off else text

    yield line("paper 000", "", "4 / 9 / 14", "2 / 6 / 8", '"comparable"')
    choices = [
        ("study's own", "as chosen"), ("start 40 days later",) * 2, ("Mercury's orbit plane",) * 2, ("ecliptic",) * 2,
        ("panel tilts - -",) * 2, ("panel tilts + -",) * 2, ("panel tilts - +",) * 2,
    ]
    for rule in ("1.0", "0.9"):
        for choice, said in choices:
            cells = [cell(rule, choice, threshold) for threshold in ("4 N.m.s", "7 N.m.s", "5.5 N.m.s")]
            yield line({"1.0": "1.0, the paper's", "0.9": "0.9, our default"}[rule], said, *cells)


def gap_rows(table_3):
    """Gaps between dumps of the cylinder: the paper's, under its rule, and under ours."""
    chosen = [row for row in table_3 if (row["shade"], row["momentum"]) == ("cylinder", "paper's")]
    paper, ours = chosen[:6], chosen[6:]

    def short(gaps):
        return gaps.replace("closest ", "").replace("farthest ", "").replace("typical ", "")

    for under_papers, under_ours in zip(paper, ours):
        assert (under_papers["dumps to"], under_ours["dumps to"]) == ("1.0", "0.9")
        assert under_papers["paper"] == under_ours["paper"] and under_papers["Z offset"] == under_ours["Z offset"]
        yield line(
            f"{under_papers['threshold']}, {under_papers['Z offset']}", short(under_papers["paper"]),
            short(under_papers["ours"]), under_papers["verdict"].replace(" gaps", ""),
            short(under_ours["ours"]), under_ours["verdict"].replace(" gaps", ""),
        )


def light_rows(rows):
    """Every case and component: the paper's, ours and the difference of the greatest; bold is outside what is allowed."""
    rows = {(row["case"], row["effect"]): row for row in rows}
    for effect in ("solar [1e-7 m/s2]", "albedo [%]", "infrared [%]", "thermal [%]"):
        cases = [rows[case, effect] for case in ("1", "2", "3", "4")]
        yield line(effect, "paper", *(row["paper"] for row in cases))
        ours = []
        for row in cases:
            value = row["ours"].split(" / ")[0] if row["difference of the least"] == "-" else row["ours"]
            text = f"{value} ({row['difference of the greatest']})"
            ours.append(f"**{text}**" if row["verdict"].startswith("off") else text)
        yield line("", "ours", *ours)
        if effect == "infrared [%]":
            yield line("", "by 45 belts", *(f"{row['by cells']} ({row['difference']})" for row in cases))


def block(rows):
    """The README has these rows one under the other."""
    rows = list(rows)
    assert rows[0] in README, rows[0]
    start = README.index(rows[0])
    assert README[start:start + len(rows)] == rows
    assert not README[start + len(rows)].startswith("|"), "a row that no study prints"


def rows_of(studied, name):
    return table(studied(name)[1], f"{name.split('/')[1]}.csv")


def test_dumps_are_those_of_the_studies(studied):
    block(dump_rows(rows_of(studied, "momentum/table2"), rows_of(studied, "momentum/assumptions")))


def test_gaps_are_those_of_the_study(studied):
    block(gap_rows(rows_of(studied, "momentum/table3")))


@pytest.mark.parametrize("name", ["thermal/table7", "thermal/table8"])
def test_light_and_heat_are_those_of_the_studies(studied, name):
    block(light_rows(rows_of(studied, name)))
