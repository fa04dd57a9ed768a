//! By which equations the models compute, for the manuals inside the FMUs.

use fmi_export::Source;

const fn source(what: &'static str, by: &'static str) -> Source {
    Source { what, by }
}

const PAPER_000: Source = source(
    "paper 000",
    "R. M. Vaughan, D. R. Haley, H. S. Shapiro, D. J. O'Shaughnessy: Momentum Management for the MESSENGER Mission, AAS 01-380",
);
const PAPER_001: Source = source(
    "paper 001",
    "D. O'Shaughnessy, R. Vaughan: MESSENGER Spacecraft Pointing Options, Johns Hopkins University APL",
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
     paper's cells; nothing shadows it",
);
const DAY_SIDE: Source = source(
    "infrared of the day side",
    "planet.dayTemperature uniform: a S / 2 all over the day side (paper 004 eq 32), for absorptivity a and solar flux S at the \
     planet; cosine: N + (a S - N) cos z at the Sun's zenith angle z, for the night side's exitance N = e sigma T^4, so that every \
     place gives off what it absorbs below the Sun and N at the terminator. The whole day side gives off pi R^2 a S the one way \
     and pi R^2 (a S + N) the other",
);
const LOOP: Source = source(
    "sun.positionBody and planet.positionBody in a loop",
    "MomentumPlant's outputs have the names of DisturbanceTorque's inputs, to connect by name. A master that steps both at once \
     (Jacobi) hands over where Sun and planet stood when the step began: torque lags by one communication step, an error of \
     attitude rate times step in the directions. Stepping DisturbanceTorque after the plant (Gauss-Seidel) removes it there and \
     leaves it in what returns to torque.applied; halve the step to see what the lag does",
);
const RECOIL: Source = source(
    "recoil of heat",
    "paper 004 eqs 42 to 50; an insulated face gives off what it takes in (eq 43) and has the temperature of space, \
     thermal.background_k, where nothing reaches it; a face with bus_conductance_w_m2_k exchanges g (T - T_bus) with a bus of \
     given temperature and radiates the rest; what it takes in from space is subtracted in the recoil. Two faces of a thin structure share their heat (eqs 44 to 49, with the power 1/4 in eq 48)",
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
    PAPER_001,
    PAPER_004,
    source(
        "orbit",
        "Kepler's equation, or Gauss-Legendre integration with J2, the Sun's tide and the surface forces; paper 004 eqs 9 to 21",
    ),
    source(
        "planets",
        "VSOP87, an ellipse as paper 004 Table 4 prints it, or Chebyshev segments of resources/ephemeris.toml",
    ),
    LIT_FRACTION,
    source(
        "guided attitude",
        "science: -Y toward the Sun, pitched toward the planet by a rule fitted to paper 000; downlink: paper 000 eq 18",
    ),
    SUNLIGHT,
    CYLINDER,
    POLYNOMIAL,
    PLANET_LIGHT,
    DAY_SIDE,
    RECOIL,
    SHADOWS,
    GRAVITY_GRADIENT,
    LOOP,
    source(
        "inputs that are all zero",
        "count as not set yet, for masters send zeros before the first exchange: without orbit.position, orbit.velocity or \
         sun.position where they are requested nothing acts, without command.q, command.error or command.kind the attitude is \
         held; a warning names them once",
    ),
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
        "any order for force.applied and torque.applied; a commanded attitude is propagated by command.rate; other inputs \
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
        "deltaV",
        "the integral of thrust, which turns with the body, over the mass left at each instant: ve ln(m0/m) along the spin axis",
    ),
    source(
        "burn.nextEdge",
        "a forecast from the motion at the last communication point. A pulse that is on ends as said. The first pulse, and every \
         pulse with burn.timing 3, is foreseen where the thruster's torque will point at burn.targetDirection if the present \
         torques last, and again whenever they change; with burn.timing 2 a pulse is foreseen a delay after the last Sun crossing \
         and again at each crossing; with burn.timing 1 all but the first are fixed. It is -1 before a Sun crossing that timing 2 \
         waits for, where the body does not bring the thruster round, and, while torques or unequal moments of inertia leave no \
         closed form, more than two turns ahead of a pulse",
    ),
    source(
        "directions of 0",
        "sun.direction, earth.direction and star.direction may be 0, which masters send before the first exchange: nothing is seen \
         there, angles to it are 0, and Sun-timed pulses wait",
    ),
    source(
        "work of a step",
        "solver.workLimit bounds it: 16 units for a segment of the motion, 64 with a damper, 4 for a crossing of Sun or star, an edge of a pulse or a panel of the impulse, 2 \
         for a clock sample or a direction on the L1 orbit; where a step is cut changes nothing but that",
    ),
    source(
        "foreseen nutation",
        "paper 002 eq 8 with the nutation kick sin(l t / 2) / l, l = (I3/IT - 1) Omega, in place of Gamma/n, for any train",
    ),
    source("envelopes", "(Gamma/n) / |sin(phi/2)|, where paper 002 eqs 9 and 10 are misprinted"),
    source(
        "damper",
        "takes energy, not momentum: nutation falls by e in its time constant, and grows where I3 is not the greatest",
    ),
    source("spin period seen at the Sun", "paper 002 eq 1, and the true time between crossings"),
    source("star tracker", "paper 002 eqs 16 to 20, and exactly"),
    source("Earth and Sun seen from L1", "a Lissajous orbit with the amplitudes and rates of the parameters"),
    source(
        "input derivatives",
        "torque.applied over the step, of orders 1 to 7; directions are taken where the step ends; other inputs are held",
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
    DAY_SIDE,
    source(
        "inputs that are all zero",
        "count as not set yet: without sun.positionBody nothing acts, without planet.positionBody there is no planet, a planet.pole \
         of zero is -Z",
    ),
    LOOP,
    source(
        "cells of the planet",
        "paper 004 eqs 5 to 8 and 27 to 31 where planetLight.method asks for them, with the areas they have: eqs 6 and 7 mix \
         borders and centres",
    ),
    RECOIL,
    SHADOWS,
    LIT_FRACTION,
    GRAVITY_GRADIENT,
    source("input derivatives", "any order for every input, all taken where the step ends"),
    source("outputs", "those of the inputs at the end of the last step: set inputs, step, read"),
];

/// Of `Guidance`.
pub const GUIDANCE: &[Source] = &[
    PAPER_001,
    PAPER_000,
    PAPER_004,
    source(
        "attitude and rate",
        "paper 001 eqs 1 to 16 with the rates of eqs 8 to 13 along the prime axes, rotated to the body by C_B/P; every vector \
         carries its time derivative, so that the rate is exact for every law",
    ),
    source(
        "roll vectors that give no roll",
        "geometry.degenerate: an external roll reference along the aimpoint gives way to the north of EME2000, then to the \
         equinox; a body roll vector along the boresight to -Y, then to +Z. Without a direction of boresight or aimpoint the \
         last law stays that gave an attitude",
    ),
    source(
        "samples",
        "at whole seconds of time and at the start. A sample belongs to the step that begins at it and reads that step's inputs; \
         outputs are those of the last sample, command.q and the Sun's angles propagated by command.rate",
    ),
    source(
        "inputs that are 0",
        "count as not given: the timeline's stand in their place. A zero position, sun.position or earth.position (where \
         ephemeris.source asks for them) is not connected yet: the last command stays and nothing is judged. A zero estimate.q, \
         or one that still has its start value, is not connected: the monitor watches nothing. Without a scenario the last law \
         stays, within its constraints, without its scan",
    ),
    source(
        "ephemerides as flown",
        "with ephemeris.source chebyshev: Chebyshev segments of resources/ephemeris.toml, or VSOP87's own, and coarse polynomials \
         of fourth degree of the Keplerian elements. Operational goes by the precise ones alone, Safe Hold until they are lost, \
         Earth Acquisition by the coarse ones. They are lost where their Sun, in the frame of estimate.q, is farther than \
         ephemeris.tolerance from sun.sensed for ephemeris.persistence, and where their span ends; that ends Operational, and \
         a new request for it trusts them again. Positions that the file has of the spacecraft stand in for position and velocity",
    ),
    source(
        "planet's rotation",
        "the IAU's with its pole fixed at J2000, as in paper 001: Rz(W) Rx(90 deg - dec) Rz(90 deg + ra), W = W0 + rate t",
    ),
    source(
        "local frames",
        "up from the planet to the spacecraft; azimuth right-handed about up from the horizontal part of the velocity \
         (downtrack) or of the direction from the planet to the Sun; elevation toward up (paper 001, Figure 4, which does not say \
         the sense of azimuth)",
    ),
    source(
        "optimal lighting",
        "the greatest cos E cos I on a sphere of planet.radii[1] (eqs 17 to 19, r and alpha at the planet's centre), between nadir \
         and subsolar point: golden section, then Newton's method on the derivative",
    ),
    source(
        "limb",
        "eqs 20 to 22 on the triaxial ellipsoid; on the terminator the solution nearer to downtrack, and without one the planet's \
         centre with target.reachable false",
    ),
    source(
        "scans",
        "each axis moves for its duration, holds for its pause and moves again, back if it reverses, as often as it has segments; \
         rotations x, y, z in turn about fixed axes. Which frames go with which aimpoints is an assumption: body and inertial \
         rotations with all, translations with points, along the planet's axes with points of the planet, rotations in the local \
         frame with its own directions and the planet. What does not go together is not scanned",
    ),
    source(
        "Sun keep-in",
        "Table 6: the Sun on the zone's boundary, the boresight as near to the aimpoint as that allows; at the nearest boundary \
         point, or with keepIn.method clamp at the paper's",
    ),
    source(
        "hot pole",
        "while the spacecraft is low over the subsolar region -Z stays away from the planet, by the smallest turn about the Sun \
         line, so that the Sun's place is kept first; its numbers are assumed",
    ),
    source(
        "downlink",
        "the antenna's azimuth that puts the Sun on -Y: minus the Sun-Earth angle below 90 deg, the angle beyond (paper 000 eqs 18 \
         to 20); with boresight.option phasedArray the commanded azimuth, -Y rolled toward the Sun",
    ),
    source(
        "modes",
        "demotion by itself, one mode at a time by the monitor, promotion by mode.request alone, where it changes. Safe Hold flies \
         downlink whatever is commanded; Earth Acquisition gives eqs 25 and 26 (command to actual) and a turn about the boresight, \
         keepIn.axis, with the Sun by its sensors or by ephemeris and estimate; without either a rate about X, Y and Z in turn",
    ),
    source("input derivatives", "any order for every Real input, taken at each sample"),
];
