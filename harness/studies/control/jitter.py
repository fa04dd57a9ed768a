"""Paper 000: attitude jitter of a flexible structure by a wheel out of balance, with its spectrum."""

import sys

sys.path[0] += "/.."
from dataclasses import dataclass

import numpy as np

from study import exact, main
from vectors import norm, unit

RATE_HZ = 100.0
# Samples of a spectrum.
COUNT = 2**14
BIN_HZ = RATE_HZ / COUNT
BINS_HZ = BIN_HZ * np.arange(COUNT // 2)
# What rings at first has died away then.
SETTLED_S = 240.0
# Below it the attitude moves as a whole.
LOWEST_HZ = 0.2
# The wheel is run up to this speed, in this time; the jitter is that of windows of so many samples.
FASTEST_HZ = 9.0
RUN_UP_S = 600.0
WINDOW = 400
# Speeds of the wheel beside those of the modes, and under control.
SPEEDS_HZ = (0.7, 2.0, 4.5, 8.5)
CONTROLLED_HZ = 4.5
# Nothing acts but wheels.
DARK = {"solar.flux": 0.0, "gravityGradient.enabled": False}
FREE = DARK | {"attitude.source": "free", "start.q": [0.0, 0.0, 0.0, 1.0]}
Q = [0.1, 0.2, -0.3, 0.927_361_849_549_570_4]
# Under the controller, with assumed noise of star tracker (rad) and gyros (rad after a second).
CONTROLLED = DARK | {
    "attitude.source": "controlled",
    "control.balanceTime": 0.0,
    "start.q": Q,
    "command.q": Q,
    "starTracker.noise": [2e-5] * 3,
    "gyro.noise": 1e-6,
}
URAD = 1e6
# What is less is drawn there.
LEAST_DB = -110.0

HEADER = (
    "case | wheel [Hz] | line at [Hz] | amplitude [urad] | in closed form [urad] | ratio | greatest at a mode [urad] | rms [urad]"
)
REMARK = """\
Amplitude: that of the body's angle, the three axes together, from the rate under Hann's window over 164 s, after 240 s.
Closed form: force U W^2 at the wheel's place on a body with its modes, all of them linear. At a mode: within 3 % of its
frequency with the body free. Rms from 0.2 to 50 Hz. Free: nothing acts but the wheel. Controlled: the controller at 50 Hz,
with noise of 20 urad of the star tracker and 1 urad after a second of the gyros, assumed; its torque rings the modes."""


class Structure:
    """Body, flexible modes and wheels, from the parameters of the FMU; the first wheel is the one that shakes.

    Equations: at the angular frequency W of the rotor, T = r x F, F = U W^2 (e1 - i e2), and the body's angle follows from
    -W^2 (J + sum of d d^T W^2 / (w^2 - W^2 + 2 i z w W)) a = T, with J less the rotors about their axes and without the
    stored momentum's gyroscopic torque.
    """

    def __init__(self, fmu):
        modes, rotors = (["frequency", "damping", "coupling"], ["inertia", "axis"])
        modes, rotors = fmu.members("flexibleMode", modes), fmu.members("wheel", rotors)
        body = ["spacecraft.inertia", "spacecraft.centerOfMass", "wheel[1].staticImbalance", "wheel[1].position"]
        found = fmu.simulate("start values", {}, [*modes, *rotors, *body], 1.0, 1.0)
        values = {name: found[name][0] for name in (*modes, *rotors, *body)}
        rotors = [(values[inertia], unit(values[axis])) for inertia, axis in zip(rotors[::2], rotors[1::2])]
        self.carrier = values[body[0]].reshape(3, 3) - sum(inertia * np.outer(axis, axis) for inertia, axis in rotors)
        self.held_hz, self.damping, self.couplings = (np.array([values[name] for name in modes[k::3]]) for k in range(3))
        # The frequencies near those of the modes at which the body shakes most: the modes' with the body free.
        free = [coupling @ np.linalg.solve(self.carrier, coupling) for coupling in self.couplings]
        self.free_hz = self.held_hz / np.sqrt(1.0 - np.array(free))
        self.rotor_kg_m2, self.axis = rotors[0]
        self.lever_m, self.imbalance_kg_m = values[body[3]] - values[body[1]], values[body[2]]

    def jitter_rad(self, frequency_hz):
        """Amplitude of the body's angle, all axes together, where the rotor turns so often a second."""
        turning, own = 2.0 * np.pi * frequency_hz, 2.0 * np.pi * self.held_hz
        factors = turning**2 / (own**2 - turning**2 + 2j * self.damping * own * turning)
        inertia = self.carrier + np.einsum("k,ki,kj->ij", factors, self.couplings, self.couplings)
        first = unit(np.cross(self.axis, [0.267_3, 0.534_5, 0.801_8]))
        second = np.cross(self.axis, first)
        # The square of the speed is in force and acceleration alike.
        torque = self.imbalance_kg_m * (np.cross(self.lever_m, first) - 1j * np.cross(self.lever_m, second))
        return norm(np.linalg.solve(inertia, torque))


@dataclass
class Case:
    """One flight at a constant speed of the first wheel; the others stand."""

    label: str
    wheel_hz: float
    is_controlled: bool

    def __post_init__(self):
        self.wheel_hz = BIN_HZ * np.floor(self.wheel_hz / BIN_HZ + 0.5)

    def amplitudes_rad(self, fmu, structure):
        """The amplitude spectrum of the body's angle, all axes together, under Hann's window: a line at a bin shows with its
        amplitude (Harris, Proc. IEEE 66 (1), 1978)."""
        held = {"wheel[1].startMomentum": structure.rotor_kg_m2 * 2.0 * np.pi * self.wheel_hz}
        settings = (CONTROLLED if self.is_controlled else FREE) | held
        stop_s = SETTLED_S + COUNT / RATE_HZ
        rate = fmu.simulate(self.label, settings, ["attitude.rate"], stop_s, 1.0 / RATE_HZ)["attitude.rate"][-COUNT:]
        window = 1.0 - np.cos(2.0 * np.pi * np.arange(COUNT) / COUNT)
        rates = np.abs(np.fft.rfft((rate - rate.mean(axis=0)) * window[:, None], axis=0)[: COUNT // 2]) * 2.0 / COUNT
        turning = 2.0 * np.pi * BINS_HZ[:, None]
        return norm(np.divide(rates, turning, out=np.zeros_like(rates), where=turning > 0.0))


def cases(structure):
    """Free flights beside the modes and at them, by speed, then those under control."""
    free = [(f"wheel at {speed_hz:g} Hz", speed_hz) for speed_hz in SPEEDS_HZ]
    free += [(f"wheel at mode {k}", speed_hz) for k, speed_hz in enumerate(structure.free_hz, 1)]
    found = sorted((Case(f"free, {label}", speed_hz, False) for label, speed_hz in free), key=lambda it: it.wheel_hz)
    controlled = [("wheel stands", 0.0), (f"wheel at {CONTROLLED_HZ:g} Hz", CONTROLLED_HZ)]
    return found + [Case(f"controlled, {label}", speed_hz, True) for label, speed_hz in controlled]


def greatest(amplitudes_rad, from_hz, to_hz):
    """The greatest amplitude between two frequencies, with its frequency."""
    inside = np.flatnonzero((BINS_HZ >= from_hz) & (BINS_HZ <= to_hz))
    at = inside[np.argmax(amplitudes_rad[inside])]
    return BINS_HZ[at], amplitudes_rad[at]


def row(case, amplitudes_rad, structure):
    """The row of the table."""
    line = ["-"] * 4
    if case.wheel_hz > 0.0:
        at_hz, amplitude_rad = greatest(amplitudes_rad, case.wheel_hz - 0.02, case.wheel_hz + 0.02)
        closed_rad = structure.jitter_rad(case.wheel_hz)
        line = [f"{at_hz:.3f}", f"{URAD * amplitude_rad:.5f}", f"{URAD * closed_rad:.5f}", f"{amplitude_rad / closed_rad:.4f}"]
    at_modes_rad = max(greatest(amplitudes_rad, 0.97 * mode_hz, 1.03 * mode_hz)[1] for mode_hz in structure.free_hz)
    # Noise counts 1.5 bins wide under this window.
    rms_rad = np.sqrt(0.5 * np.sum(amplitudes_rad[BINS_HZ >= LOWEST_HZ] ** 2) / 1.5)
    return [case.label, f"{case.wheel_hz:.3f}", *line, f"{URAD * at_modes_rad:.5f}", f"{URAD * rms_rad:.5f}"]


def run_up(fmu, structure):
    """Jitter while the wheel is run up: its speed in Hz, and the amplitude over windows of some seconds in rad."""
    torque_n_m = structure.rotor_kg_m2 * 2.0 * np.pi * FASTEST_HZ / RUN_UP_S
    settings, names = FREE | {"wheel[1].torqueCommand": torque_n_m}, ["attitude.rate", "wheel[1].speed"]
    found = fmu.simulate("run-up", settings, names, RUN_UP_S, 1.0 / RATE_HZ)
    off = np.arange(WINDOW) - 0.5 * (WINDOW - 1.0)
    points = []
    for first in range(0, len(found.time_s) // (WINDOW // 4) * (WINDOW // 4) - WINDOW, WINDOW // 4):
        speed_rad_s = found["wheel[1].speed"][first + WINDOW // 2]
        if speed_rad_s > np.pi:
            # About the straight line through the samples.
            rate = found["attitude.rate"][first : first + WINDOW]
            rate = rate - rate.mean(axis=0)
            rate -= np.outer(off, off @ rate / (off @ off))
            points.append((speed_rad_s / (2.0 * np.pi), np.sqrt(2.0 * np.sum(rate**2) / WINDOW) / speed_rad_s))
    return np.array(points)


def decibels(amplitudes_rad):
    """Amplitudes relative to 1 urad."""
    return 20.0 * np.log10(URAD * amplitudes_rad)


def draw_spectra(run, chosen, spectra):
    """The spectra, free and controlled below each other."""
    groups = {kind: any(case.is_controlled == kind for case in chosen) for kind in (False, True)}
    kinds = [kind for kind, is_there in groups.items() if is_there]
    labels = [f"{'controlled' if kind else 'free'} [dB re 1 urad]" for kind in kinds]
    drawing, panels = run.axes("Attitude jitter by a wheel out of balance", "frequency [Hz]", labels, 3.0)
    shown = (BINS_HZ >= LOWEST_HZ) & (BINS_HZ <= FASTEST_HZ + 1.0)
    for kind, axes in zip(kinds, panels):
        for case, amplitudes_rad in zip(chosen, spectra):
            if case.is_controlled == kind:
                levels = np.maximum(decibels(amplitudes_rad[shown]), LEAST_DB)
                axes.plot(BINS_HZ[shown], levels, linewidth=0.8, label=case.label)
    run.figure("jitter-spectra.svg", drawing)


def jitter(run):
    fmu = run.fmu("FlexibleCraft.fmu")
    structure = Structure(fmu)
    chosen = run.chosen(cases(structure), lambda case: case.label)
    spectra = run.all(chosen, lambda case: case.amplitudes_rad(fmu, structure))
    run.line("Attitude jitter by the static imbalance of one wheel of FlexibleCraft\n")
    run.table_and_csv("jitter.csv", HEADER, [row(case, own, structure) for case, own in zip(chosen, spectra)])
    for k, (held_hz, free_hz) in enumerate(zip(structure.held_hz, structure.free_hz), 1):
        run.line(f"Mode {k}: {held_hz:.3f} Hz with the body held, {free_hz:.3f} Hz with the body free.")
    run.line(REMARK)
    shown = np.flatnonzero((BINS_HZ >= LOWEST_HZ) & (BINS_HZ <= FASTEST_HZ + 1.0))
    cells = ([case.label, exact(BINS_HZ[k]), exact(own[k])] for case, own in zip(chosen, spectra) for k in shown)
    run.csv("jitter-spectra.csv", "case | frequency_hz | amplitude_rad", cells)
    draw_spectra(run, chosen, spectra)
    if run.options.only:
        return
    points = run_up(fmu, structure)
    cells = ([exact(it) for it in (hz, rad, structure.jitter_rad(hz))] for hz, rad in points)
    run.csv("jitter-run-up.csv", "wheel_hz | amplitude_rad | in_closed_form_rad", cells)
    title = "A wheel run up through the modes"
    drawing, (axes,) = run.axes(title, "speed of the wheel [Hz]", ["jitter [dB re 1 urad]"], 3.5)
    axes.plot(points[:, 0], decibels(points[:, 1]), label="run up to 9 Hz in 600 s")
    steady_hz = np.arange(60, 901) * 0.01
    steady_rad = np.array([structure.jitter_rad(hz) for hz in steady_hz])
    axes.plot(steady_hz, decibels(steady_rad), "--", label="at constant speed, in closed form")
    run.figure("jitter-run-up.svg", drawing)


main(jitter)
