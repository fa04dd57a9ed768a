"""Paper 004: albedo, infrared and recoil as shares of solar pressure, planet standing still."""

import sys

sys.path[0] += "/.."
import study
from thermal import tables


def table7(run):
    tables.table(
        run,
        "table7",
        tables.TABLE_7,
        'One orbit, planet standing still, cylindrical shadow (paper 004, Table 7, "analytical")',
        "Recoil of cases 2 to 4: the plates' emissivities are not printed, and with emissivity equal to absorptivity no\n"
        "conduction gives the printed pairs.",
        tolerances=(0.0015, 0.02, 0.05, 0.03),
        is_moving=False,
    )


study.main(table7)
