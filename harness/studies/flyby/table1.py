"""Paper 003: velocity change by each flyby of Mercury."""

import sys

sys.path[0] += "/.."
from flyby.leg import FLYBY_1, FLYBY_2, Leg
from flyby.plane import Target
from study import main, verdict

# Printed velocity changes in m/s.
PRINTED_M_S = {
    "Earth flyby (Aug. 2005)": 5966.3,
    "Venus flyby 1 (Oct. 2006)": 5522.5,
    "Venus flyby 2 (June 2007)": 6937.8,
    "Mercury flyby 1 (Jan. 2008)": 2304.0,
    "Mercury flyby 2 (Oct. 2008)": 2452.2,
    "Mercury flyby 3 (Sept. 2009)": 2853.5,
    "DSM-1 (Dec. 2005)": 315.7,
    "DSM-2 (Oct. 2007)": 226.0,
    "DSM-3 (Mar. 2008)": 72.3,
    "DSM-4 (Dec. 2008)": 246.9,
    "DSM-5 (Nov. 2009)": 177.6,
    "MOI (March 2011)": 859.4,
}
# Flybys whose legs are shipped.
MISSIONS = {"Mercury flyby 1 (Jan. 2008)": FLYBY_1, "Mercury flyby 2 (Oct. 2008)": FLYBY_2}
# What agrees, of a velocity change.
SHARE = 0.01


def flyby(run, mission):
    """Velocity change far from the planet in m/s, altitude in km and excess speed in m/s of a simulated flyby."""
    leg = Leg(run, mission)
    (altitude_m, excess_m_s), target = leg.closest(), Target(leg)
    eccentricity = 1.0 + (target.radius_m + altitude_m) * excess_m_s**2 / target.gm_m3_s2
    return 2.0 * excess_m_s / eccentricity, altitude_m / 1e3, excess_m_s


def table1(run):
    rows = []
    for event, paper_m_s in PRINTED_M_S.items():
        cells = ["-", "-", "-", "not computed"]
        if event in MISSIONS:
            numbers = flyby(run, MISSIONS[event])
            cells = [*(f"{number:.1f}" for number in numbers), verdict(abs(numbers[0] / paper_m_s - 1.0) < SHARE)]
        rows.append([event, f"{paper_m_s:.1f}", *cells])
    run.line("Velocity changes of flybys and manoeuvres (paper 003, Table 1)\n")
    header = "event | paper [m/s] | ours [m/s] | altitude [km] | excess speed [m/s] | within 1 %"
    run.table_and_csv("table1.csv", header, rows)
    run.line(
        "Of legs and manoeuvres that are not computed the paper gives no place, of none a state. Assumed: the legs of messenger-flyby1.toml and "
        "messenger-flyby2.toml, which pass Mercury at 200 km. The change is that of the velocity far from the planet."
    )


main(table1)
