"""Every study runs and leaves whole tables and pictures, and prints the same on one core and on four."""

import xml.etree.ElementTree as ElementTree

import pytest

from studies import STUDIES, study, table

ALL = [
    "control/slew", "control/safe-mode", "control/transition", "control/dump", "control/jitter",
    "earth/torques", "earth/day",
    "flyby/table1", "flyby/table2", "flyby/table3", "flyby/figure3", "flyby/figure4", "flyby/figure5", "flyby/figure6", "flyby/figure7",
    "flyby/figure8", "flyby/figure9",
    "momentum/tables", "momentum/figure4", "momentum/figure5",
    "momentum/assumptions", "momentum/dump-targets", "momentum/wheels", "momentum/sensitivity", "momentum/off-sun",
    "momentum/authority",
    "pointing/limb", "pointing/mosaic", "pointing/transition", "pointing/burn",
    "spin/figure2", "spin/figure3", "spin/figure4", "spin/figure6", "spin/figure7", "spin/numbers",
    "thermal/table7", "thermal/table8", "thermal/figure12", "thermal/figure13",
]


def test_these_are_all():
    programs = [path for path in STUDIES.glob("*/*.py") if "main(" in path.read_text(encoding="utf-8").splitlines()[-1]]
    assert sorted(f"{path.parent.name}/{path.stem}" for path in programs) == sorted(ALL)


# Flown by the same means as momentum/figure5, for half a minute of one core and more.
LONG = {"momentum/tables", "momentum/assumptions", "momentum/dump-targets", "momentum/wheels", "momentum/sensitivity"}
# Planned anew from the departure on, by one means.
LONG |= {"flyby/table3", "flyby/figure4", "flyby/figure6", "flyby/figure7", "flyby/figure8", "flyby/figure9"}
# One of every means by which processes share the work.
EVERY_RUN = {"control/slew", "momentum/figure4", "pointing/limb", "spin/figure3", "thermal/table7"}


def long_unless(daily, names):
    return [name if name in daily else pytest.param(name, marks=pytest.mark.long) for name in names]


@pytest.mark.parametrize("name", long_unless(set(ALL) - LONG, ALL))
def test_results_are_whole(studied, name):
    _, files = studied(name)
    own = name.split("/")[1]
    expected = {f"table{number}.csv" for number in (2, 3, 4, 5)} if own == "tables" else {f"{own}.csv"}
    assert expected <= files.keys() and (f"{own}.svg" in files or not own.startswith("figure"))
    for file in files:
        if file.endswith(".csv"):
            table(files, file)
        else:
            assert ElementTree.fromstring(files[file]).tag.endswith("svg")


@pytest.mark.parametrize("name", long_unless(EVERY_RUN, [name for name in ALL if name not in LONG]))
def test_results_do_not_depend_on_the_number_of_cores(studied, heliotorque, dist, tmp_path, name):
    assert study(heliotorque, dist, tmp_path, name, 1) == studied(name)
