"""Paper 000: momentum dumps by pulses of thrusters beside the same dumps at once."""

import sys

sys.path[0] += "/.."
import numpy as np

from study import main, mark
from vectors import norm

SPAN_S = 600.0
STEP_S = 0.25
# Momentum of wheels 1 and 2 at the start, assumed.
HELD = {"wheel[1].startMomentum": 3.0, "wheel[2].startMomentum": -1.5}
# Thrusters whose pulses dump: A1 to B4, S1 to P2.
THRUSTERS = range(6, 18)
# In the dark, so that nothing but the dump moves the momentum, in an attitude that is held.
DARK = {
    "command.source": "inputs",
    "command.kind": "none",
    "solar.flux": 0.0,
    "gravityGradient.enabled": False,
    "dump.request": True,
}
# Momentum that the dump leaves, in N m s, and what is set for every thruster.
DUMPS = {
    "to zero": ([0.0, 0.0, 0.0], {}),
    "biased": ([0.4, -0.3, 0.2], {}),
    "no scatter": ([0.0, 0.0, 0.0], {"scatter": 0.0}),
    "scatter 10 %": ([0.0, 0.0, 0.0], {"scatter": 0.1}),
    "shortest pulse 100 ms": ([0.0, 0.0, 0.0], {"minOnTime": 0.1}),
}
NAMES = ["momentum.body", "dump.impulse", "dump.deltaV", "propellant.used", "control.error", "dump.active"]
WHEELS = [f"wheel[{k}].torque" for k in (1, 2, 3, 4)]

HEADER = (
    "case | impulse [N m s] | left over [mN m s] | apart [mN m s] | lasts [s] | propellant [g] | impulsive [g] | delta-v [mm/s] | "
    "impulsive [mm/s] | attitude [deg] | wheel torque [N m]"
)
REMARK = """\
Impulse: of the same dump at once, in commanded flight. Left over: between the momentum after the pulses and the target; the
smallest pulse of a 4.4 N thruster is 20 ms, about 70 mN m s. Apart: between the impulse of the pulses and the one at once.
Attitude: greatest error while the wheels take up the pulses. In the dark, the wheels holding 3 and -1.5 N m s at the start,
assumed; the thrusters' layout is assumed too (messenger-full.toml)."""


def simulated(fmu, label):
    """The dump in controlled flight, and as an impulse in commanded flight."""
    target_n_m_s, each = DUMPS[label]
    thrusters = {f"thruster[{k}].{name}": value for k in THRUSTERS for name, value in each.items()}
    settings, names = DARK | {"dump.target": target_n_m_s} | thrusters, [*NAMES, *WHEELS]
    pulses = fmu.simulate(label, settings | HELD | {"attitude.source": "controlled"}, names, SPAN_S, STEP_S)
    at_once = settings | {"attitude.source": "commanded", "start.momentum": pulses["momentum.body"][0]}
    return pulses, fmu.simulate(label, at_once, names, 10.0, 1.0)


def duration_s(pulses):
    """The last time at which the dump is active."""
    return pulses.time_s[pulses["dump.active"] == 1.0].max(initial=0.0)


def wheel_torques_n_m(pulses):
    return np.column_stack([pulses[name] for name in WHEELS])


def row(label, pulses, at_once):
    """The row of the table."""
    impulse_n_m_s = at_once.last("dump.impulse")
    numbers = [
        f"{norm(impulse_n_m_s):.3f}",
        f"{1e3 * norm(pulses.last('momentum.body') - DUMPS[label][0]):.1f}",
        f"{1e3 * norm(pulses.last('dump.impulse') - impulse_n_m_s):.1f}",
        f"{duration_s(pulses):.0f}",
        *(f"{1e3 * it.last('propellant.used'):.2f}" for it in (pulses, at_once)),
        *(f"{1e3 * norm(it.last('dump.deltaV')):.2f}" for it in (pulses, at_once)),
        f"{np.degrees(pulses['control.error'].max()):.3f}",
        f"{np.abs(wheel_torques_n_m(pulses)).max():.3f}",
    ]
    return [label, *numbers]


def draw(run, label, pulses):
    """The dump over time, until a while after its end."""
    shown = pulses.time_s <= duration_s(pulses) + 60.0
    time_s = pulses.time_s[shown]
    labels = ["momentum [N m s]", "wheel torque [N m]", "error [deg]", "delta-v [mm/s]"]
    drawing, (momentum, wheels, error, delta_v) = run.axes(f"Dump by pulses: {label}", "time [s]", labels)
    for i, name in enumerate("xyz"):
        momentum.plot(time_s, pulses["momentum.body"][shown, i], label=name)
        delta_v.plot(time_s, 1e3 * pulses["dump.deltaV"][shown, i], label=name)
    mark(momentum, sorted(set(DUMPS[label][0])), "target")
    for k, torques_n_m in enumerate(wheel_torques_n_m(pulses)[shown].T, 1):
        wheels.plot(time_s, torques_n_m, label=f"wheel {k}")
    error.plot(time_s, np.degrees(pulses["control.error"][shown]), label="attitude from the one commanded")
    run.figure(f"dump-{label.replace(' %', '').replace(' ', '-')}.svg", drawing)


def dump(run):
    labels = run.chosen(DUMPS)
    fmu = run.fmu("MessengerFull.fmu")
    found = run.all(labels, lambda label: simulated(fmu, label))
    run.line("Dumps of the controlled spacecraft by pulses of its 4.4 N thrusters\n")
    run.table_and_csv("dump.csv", HEADER, [row(label, *both) for label, both in zip(labels, found)])
    run.line(REMARK)
    for label, (pulses, _) in zip(labels, found):
        draw(run, label, pulses)


main(dump)
