//! By which equations the models compute, for the manuals inside the FMUs.

use fmi_export::Source;

const fn source(what: &'static str, by: &'static str) -> Source {
    Source { what, by }
}

const PAPER_000: Source = source(
    "paper 000",
    "R. M. Vaughan, D. R. Haley, H. S. Shapiro, D. J. O'Shaughnessy: Momentum Management for the MESSENGER Mission, AAS 01-380",
);
const PAPER_002: Source = source(
    "paper 002",
    "M. A. Woodard, D. F. Baker: Optimal Attitude Maneuver Execution for the Advanced Composition Explorer (ACE) Mission",
);
const PAPER_004: Source = source(
    "paper 004",
    "B. Rievers, T. Kato, J. van der Ha, C. Lämmerzahl: Numerical Analysis of Thermal Radiation Perturbations for a Mercury Orbiter",
);
const SUNLIGHT: Source = source(
    "sunlight on plates and panels",
    "flat-plate law of paper 000 eqs 1 and 2 (paper 004 eq 23), pressure F / (c D^2); panels by paper 000 eqs 9 to 11, shade \
     and panels turned against the body by eq 12",
);
const CYLINDER: Source = source(
    "sunlight on a cylindrical shade",
    "closed form of paper 000 eqs 4 and 5, derived anew: k_x_y carries z_c Cd theta_p where the print has y_c theta_m",
);
const POLYNOMIAL: Source = source(
    "torque polynomial of the shade",
    "27 coefficients of paper 000 eqs 3 to 8, derived anew with the constant -2 A Cd / 3 that the print has lost",
);
const PLANET_LIGHT: Source = source(
    "light of the planet",
    "paper 004 eqs 33 to 36 and 39 to 41 as integrals over the planet's visible cap, on rings about the nadir instead of the \
     paper's cells; day side by eq 32, a cosine profile or a given temperature; nothing shadows it",
);
const RECOIL: Source = source(
    "recoil of heat",
    "paper 004 eqs 42 to 50; an insulated face gives off what it takes in (eq 43) and is at 0 K where nothing reaches it, \
     two faces of a thin structure share their heat (eqs 44 to 49, with the power 1/4 in eq 48)",
);
const SHADOWS: Source = source(
    "shadows of surfaces on one another",
    "each surface's outline cut by the projections of those before it: lit area and lit centroid of what remains",
);
const LIT_FRACTION: Source = source(
    "lit fraction of the Sun",
    "overlap of the discs of Sun and planet; all-or-nothing cone and cylinder as in paper 004 eqs 24 to 26",
);
const GRAVITY_GRADIENT: Source =
    source("gravity gradient", "3 mu / r^3 (u x J u), u from the spacecraft to the planet's centre");

/// Of `MomentumPlant`.
pub const MOMENTUM_PLANT: &[Source] = &[
    PAPER_000,
    PAPER_004,
    source(
        "orbit",
        "Kepler's equation, or Gauss-Legendre integration with J2, the Sun's tide and the surface forces; paper 004 eqs 9 to 21",
    ),
    source("planets", "VSOP87, or an ellipse as paper 004 Table 4 prints it"),
    LIT_FRACTION,
    source(
        "guided attitude",
        "science: -Y toward the Sun, pitched toward the planet by a rule fitted to paper 000; downlink: paper 000 eq 18",
    ),
    SUNLIGHT,
    CYLINDER,
    POLYNOMIAL,
    PLANET_LIGHT,
    RECOIL,
    SHADOWS,
    GRAVITY_GRADIENT,
    source(
        "momentum",
        "dH/dt = T in the inertial frame; with momentum.convention 2 the body components one by one, as paper 000 eq 13 is read \
         for its tables",
    ),
    source(
        "dumps",
        "the instant a component reaches its threshold, then set to its opposite times dump.reinitFraction (paper 000)",
    ),
    source(
        "input derivatives",
        "any order for force.external and torque.external; a commanded attitude is propagated by command.rate; other inputs \
         are held over the step",
    ),
];

/// Of `SpinPlant`.
pub const SPIN_PLANT: &[Source] = &[
    PAPER_002,
    source(
        "motion",
        "Euler's equations from pulse edge to pulse edge: a torque-free axisymmetric body in closed form, everything else by \
         Taylor series to rounding",
    ),
    source("axis moved by a pulse", "paper 002 eqs 2 and 3"),
    source(
        "foreseen nutation",
        "paper 002 eq 8 with the nutation kick sin(l t / 2) / l, l = (I3/IT - 1) Omega, in place of Gamma/n, for any train",
    ),
    source(
        "envelopes",
        "exact: (Gamma/n) / |sin(phi/2)|; as printed: paper 002 eqs 9 and 10, both of which have slips",
    ),
    source(
        "damper",
        "takes energy, not momentum: nutation falls by e in its time constant, and grows where I3 is not the greatest",
    ),
    source("spin period seen at the Sun", "paper 002 eq 1, and the true time between crossings"),
    source("star tracker", "paper 002 eqs 16 to 20, and exactly"),
    source("Earth and Sun seen from L1", "a Lissajous orbit with the amplitudes and rates of the parameters"),
    source(
        "input derivatives",
        "torque.external over the step, of orders 1 to 7; directions are taken where the step ends; other inputs are held",
    ),
    source(
        "communication points",
        "thruster[k].onDelay and onTime act once in every step, so that steps cut differently fire differently; all else flies \
         the same",
    ),
];

/// Of `DisturbanceTorque`.
pub const DISTURBANCE_TORQUE: &[Source] = &[
    PAPER_000,
    PAPER_004,
    SUNLIGHT,
    CYLINDER,
    PLANET_LIGHT,
    source(
        "cells of the planet",
        "paper 004 eqs 5 to 8 and 27 to 31 where radiation.method asks for them: with the areas they have, or to the letter of \
         eqs 6 and 7",
    ),
    RECOIL,
    SHADOWS,
    LIT_FRACTION,
    GRAVITY_GRADIENT,
    source("input derivatives", "any order for every input, all taken where the step ends"),
    source("outputs", "those of the inputs at the end of the last step: set inputs, step, read"),
];
