"""The spinner of paper 002: its constants, inertia, pulse widths and the nutation that a train of pulses leaves."""

import math

FMU = "SpinPlant.fmu"
# The thruster force, in N (after eq 2).
FORCE_N = 4.448
# Arms of a lower-deck radial and of an upper-deck axial thruster, in m (Table 1).
RADIAL_ARM_M = 0.40
AXIAL_ARM_M = 0.78
# The average spin inertia, in kg m2 (after eq 3).
SPIN_INERTIA_KG_M2 = 353.82
# Nominal spin rate and period (after eq 2).
RATE_RAD_S = math.pi / 6.0
PERIOD_S = 12.0
# The ratio of spin to transverse inertia in the figures.
RATIO = 1.483
# What the paper reads off its Figure 4, and how finely, in deg.
LEAST_DEG, MOST_DEG, END_DEG = 0.001, 0.032, 0.024
READ_DEG = 0.001


def body(ratio=RATIO, quotient=1.0):
    """Settings of the undamped body with I3/sqrt(I1 I2) = `ratio` and I1/I2 = `quotient`."""
    transverse = SPIN_INERTIA_KG_M2 / ratio
    inertia = [transverse * math.sqrt(quotient), transverse / math.sqrt(quotient), SPIN_INERTIA_KG_M2]
    return {"inertia": inertia, "damper.timeConstant": 0.0}


def pulse_width_s(angle_rad, arm_m):
    """The width of a pulse that turns the axis by this angle (eq 3); None if it lasted beyond half a turn."""
    sine = angle_rad * SPIN_INERTIA_KG_M2 * RATE_RAD_S**2 / (2.0 * FORCE_N * arm_m)
    return 2.0 * math.asin(sine) / RATE_RAD_S if sine <= 1.0 else None


def nutation_rad(per_pulse_rad, phase_rad, count):
    """The nutation that a train of impulses leaves (eq 8), by the angle per pulse and the nutation phase between pulses."""
    return per_pulse_rad * math.sqrt((1.0 - math.cos(count * phase_rad)) / (1.0 - math.cos(phase_rad)))


def against_paper(least_deg, most_deg, ends_deg, envelope_deg):
    """Verdict on the paper's range and end; the nutation of a triaxial body swings at the end too."""
    has_range = abs(least_deg - LEAST_DEG) <= READ_DEG and abs(most_deg - MOST_DEG) <= READ_DEG
    has_end = ends_deg[0] - READ_DEG <= END_DEG <= ends_deg[1] + READ_DEG
    if has_range:
        return "the paper's range and end" if has_end else "the paper's range, not its end"
    if most_deg <= 1.001 * envelope_deg:
        return f"not the paper's range: never beyond the envelope of {envelope_deg:.4f}"
    return f"not the paper's range, {'though its end' if has_end else 'nor its end'}"
