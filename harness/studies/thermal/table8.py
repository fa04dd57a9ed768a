"""Paper 004: the same with the planet moving."""

import sys

sys.path[0] += "/.."
import study
from thermal import tables


def table8(run):
    tables.table(
        run,
        "table8",
        tables.TABLE_8,
        'One orbit, planet moving, no light in the penumbra (paper 004, Table 8, "numerical")',
        "Infrared and albedo of cases 1 and 2 cannot be had from the printed geometry by any scan tried: from Table 7 to\n"
        "Table 8 the paper halves the infrared of case 1 and nearly doubles that of case 2, while the planet turns by 2 to 3 deg.\n"
        "Recoil is printed lower than in Table 7 though nothing about the panels changes.",
        tolerances=(0.0015, 0.02, 0.08, 0.03),
        is_moving=True,
    )


study.main(table8)
