"""Numbers that paper 000 prints in its Tables 2 to 5, and how ours compare."""

from momentum.cases import CYLINDER, OWN, PANELS, PAPER, Spacing

# Counts may differ from the paper's by this much: its pointing rules, epoch and windows are unpublished.
COUNT_TOLERANCE = 2

# Tables 2 and 3, cylinder: number of dumps, closest and farthest gap and typical range in days, with the centre of mass at 0, 1
# and 2 inches along -Z; by strategy and threshold in N m s.
TABLES_2_3 = {
    ("dumps only", 4.0): [(4, (7.0, 45.0), (7.0, 10.0)), (9, (5.0, 15.5), (5.0, 11.0)), (14, (4.0, 21.0), (4.0, 6.0))],
    ("reactive", 4.0): [(1, None, None), (2, (11.0, 11.0), None), (8, (4.5, 39.0), (4.0, 11.0))],
    ("predictive", 4.0): [(0, None, None), (1, None, None), (5, (5.0, 50.0), None)],
    ("dumps only", 7.0): [(2, (55.0, 55.0), None), (6, (3.5, 25.5), (10.0, 20.0)), (8, (7.0, 25.0), (7.0, 12.0))],
    ("reactive", 7.0): [(0, None, None), (1, None, None), (4, (7.0, 53.0), (10.0, 17.0))],
    ("predictive", 7.0): [(0, None, None), (0, None, None), (2, (11.0, 11.0), None)],
}
# Tables 4 and 5, plates and panels, reactive targets and 5.5 N m s: the same by the centre of mass in inches.
TABLES_4_5 = {
    (0, 0, -1): (2, (11.0, 11.0), None),
    (0, 0, -2): (9, (4.0, 30.0), (4.0, 9.0)),
    (0, 0, 1): (2, (4.5, 4.5), None),
    (0, 0, 2): (8, (3.0, 12.0), (4.0, 11.0)),
    (1, 1, 1): (5, (9.0, 20.0), None),
    (-1, -1, -1): (5, (5.0, 38.0), None),
}


class Published:
    """The paper's number of dumps for a case, as a range; and the gaps between dumps where it prints them. "Comparable to the
    cases using the cylindrical shade": as many dumps as those with a higher and a lower threshold."""

    def __init__(self, fewest, most, spacing=None):
        self.fewest, self.most, self.spacing = fewest, most, spacing

    @classmethod
    def of(cls, case):
        """None where the paper prints nothing: for plates alone, for the physical momentum, and for dumps to anything but what
        its text says. Dumps to 0.9 of the threshold are compared all the same, as the nearest that is well conditioned."""
        if case.convention != "paper's" or case.dumps_to not in (PAPER, OWN) or case.shade not in (CYLINDER, PANELS):
            return None
        if case.shade == PANELS and case.threshold_n_m_s == 5.5 and case.strategy == "reactive" and case.offset_in in TABLES_4_5:
            spacing = Spacing(*TABLES_4_5[case.offset_in])
            return cls(spacing.dumps, spacing.dumps, spacing)
        column = -case.offset_in[2]
        if not case.is_along_z or column not in (0, 1, 2):
            return None
        rows = {key[1]: Spacing(*cells[column]) for key, cells in TABLES_2_3.items() if key[0] == case.strategy}
        if case.shade == PANELS:
            counts = [spacing.dumps for spacing in rows.values()]
            return cls(min(counts), max(counts)) if counts else None
        spacing = rows.get(case.threshold_n_m_s)
        return cls(spacing.dumps, spacing.dumps, spacing) if spacing else None

    def __str__(self):
        return str(self.spacing.dumps) if self.spacing else f"{self.fewest} to {self.most}"

    def against(self, dumps):
        """Verdict on a number of dumps."""
        if self.spacing:
            return "within 2" if abs(dumps - self.spacing.dumps) <= COUNT_TOLERANCE else "off"
        return "comparable" if self.fewest <= dumps <= self.most else "off"
