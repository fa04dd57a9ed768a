"""Free flight of body and wheels: the FMU against Basilisk.

One flight: a body with products of inertia, four wheels that run with viscous and Coulomb friction and never come to rest,
motor torques that change every 100 s, a constant torque from outside. What is fed and what Basilisk 2.12.1 made of it stand in
`tests/reference/free-flight-basilisk.csv`: its module spacecraft with four balanced wheels (hub inertia with the rotors in it)
and a constant torque, classical Runge-Kutta of order 4 with steps of 0.02 s; Fehlberg's order 7 changes its numbers by 3e-15
in attitude and 6e-14 rad/s in the wheels' speeds.
"""

import numpy as np
import pytest
from fmpy import extract

from simulation import QUATERNION, Stepped, basilisk_table, columns, vector
from spacecraft import pack

INERTIA_KG_M2 = np.array([[199.6, 12.0, -8.0], [12.0, 507.1, 20.0], [-8.0, 20.0, 484.9]])
AXES = np.array([[1, 1, 1], [-1, 1, 1], [-1, 1, -1], [1, 1, -1]]) / np.sqrt(3.0)
ROTOR_KG_M2, COULOMB_N_M, VISCOUS_N_M_S = 0.0125, 1e-3, 2e-6
APPLIED_N_M = np.array([2e-3, -1e-3, 1.5e-3])
SPEEDS = [f"wheel[{k}].speed" for k in (1, 2, 3, 4)]
TORQUES = [f"wheel[{k}].torqueCommand" for k in (1, 2, 3, 4)]
MOTION = QUATERNION + vector("attitude.rate") + SPEEDS


@pytest.fixture(scope="module")
def basilisk():
    return basilisk_table("free-flight-basilisk")


def simulated(unpacked_plant, table):
    """The FMU's motion at the rows' times, fed with the rows' motor torques from each row on."""
    first = table[0]
    start = {"attitude.source": 4, "solar.flux": 0.0, "gravityGradient.enabled": False}
    start |= {f"dump.threshold[{i}]": 1e9 for i in (1, 2, 3)}
    start |= {f"start.{name.removeprefix('attitude.')}": first[name] for name in QUATERNION + vector("attitude.rate")}
    start |= dict(zip(vector("torque.applied"), APPLIED_N_M))
    for i, row in enumerate(INERTIA_KG_M2, 1):
        start |= {f"spacecraft.inertia[{i},{j}]": value for j, value in enumerate(row, 1)}
    for k, axis in enumerate(AXES, 1):
        start |= {f"wheel[{k}].axis[{i}]": value for i, value in enumerate(axis, 1)}
        start |= {
            f"wheel[{k}].inertia": ROTOR_KG_M2,
            f"wheel[{k}].maxTorque": 1.0,
            f"wheel[{k}].coulombFriction": COULOMB_N_M,
            f"wheel[{k}].viscousFriction": VISCOUS_N_M_S,
            f"wheel[{k}].startMomentum": ROTOR_KG_M2 * first[f"wheel[{k}].speed"],
        }
    plant = Stepped(unpacked_plant, start)
    rows = [plant.get(*MOTION)]
    for row, end in zip(table[:-1], table[1:]):
        plant.set(**{name: row[name] for name in TORQUES})
        plant.step(end["time"] - row["time"])
        rows.append(plant.get(*MOTION))
    plant.close()
    return np.array(rows)


def differences(motion, other):
    """Greatest differences of quaternion (either sign), rate in rad/s, and wheel momentum in N.m.s."""
    sign = np.sign(np.sum(motion[:, :4] * other[:, :4], axis=1, keepdims=True))
    return [
        np.abs(sign * motion[:, :4] - other[:, :4]).max(),
        np.abs(motion[:, 4:7] - other[:, 4:7]).max(),
        ROTOR_KG_M2 * np.abs(motion[:, 7:] - other[:, 7:]).max(),
    ]


def test_it_is_basilisks(unpacked_plant, basilisk):
    assert np.abs(columns(basilisk, SPEEDS)).min() > 10.0
    attitude, rate_rad_s, wheels_n_m_s = differences(simulated(unpacked_plant, basilisk), columns(basilisk, MOTION))
    assert attitude < 1e-12 and rate_rad_s < 1e-13 and wheels_n_m_s < 1e-12


def test_the_controlled_wheels_take_up_sunlight_as_basilisks(unpacked_plant):
    """An attitude held for 2000 s in sunlight from one direction on plates and two panels at different angles.

    Basilisk's loop is spacecraft, four wheels, facetSRPDynamicEffector, simpleNav, inertial3D, attTrackingError, mrpFeedback
    with its integral and rwMotorTorque, all at 50 Hz. The loops differ in how inertia enters the gains, and a sample later, so
    the wheels are the same once the integral has settled: from 1000 s on.
    """
    table = basilisk_table("controlled-flight-basilisk")
    to_sun = np.array([0.05, -0.99, 0.06])
    start = {"attitude.source": 3, "gravityGradient.enabled": False, "eclipse.method": 4, "ephemeris.source": 3}
    start |= dict(zip(vector("sun.position"), 1e15 * to_sun / np.linalg.norm(to_sun)))
    start |= {"solar.fixedPressure": True, "solar.pressure": 1368.0 / 299_792_458.0}
    start |= {f"wheel[{k}].inertia": ROTOR_KG_M2 for k in (1, 2, 3, 4)}
    for k, angle in ((1, 0.4), (2, 0.9)):
        start |= {f"panel[{k}].control": 2, f"panel[{k}].angle": angle}
    plant = Stepped(unpacked_plant, start)
    speeds = columns(table, SPEEDS)
    for time, expected in zip(table["time"][1:], speeds[1:]):
        plant.step(time - plant.time)
        if time >= 1000.0:
            assert np.abs(plant.get(*SPEEDS) - expected).max() < 1e-7 * np.abs(speeds).max()
    plant.close()


ONE_WING = """
name = "One wing"
[mass_properties]
mass_kg = 1300.0
center_of_mass_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [[2600, 0, 0], [0, 1500, 0], [0, 0, 2500]]
[optics.foil]
specular = 0.2
diffuse = 0.3
[[boxes]]
name = "bus"
center_m = [0, 0, 0]
size_m = [1.6, 1.6, 2.1]
optics = "foil"
[[panels]]
name = "wing"
control = "angle"
mass_kg = 60.0
inertia_kg_m2 = [[20, 0, 0], [0, 20, 0], [0, 0, 40]]
area_m2 = 11.0
center_m = [0, -4.8, 0]
axis = [0, 1, 0]
zero_normal = [-1, 0, 0]
optics = "foil"
rear_optics = "foil"
[start]
"orbit.center" = "sun"
"attitude.source" = "free"
"""


def test_a_panel_at_180_deg_either_way_is_one_place(heliotorque, dist, tmp_path):
    """Without momentum body and wing turn against one another: by 20 kg m2 of the wing's turn over 1500 kg m2 in all."""
    folder = extract(pack(heliotorque, dist, tmp_path / "wing", ONE_WING, "OneWing"), unzipdir=str(tmp_path / "fmu"))
    flight = Stepped(folder, {"panel[1].angle": np.radians(178.0), "start.q[4]": 1.0, "solar.flux": 0.0})
    first = flight.get(*QUATERNION)
    for step in range(1, 101):
        angle = np.radians(178.0 + 0.05 * step)
        flight.set(**{"panel[1].angle": (angle + np.pi) % (2.0 * np.pi) - np.pi})
        flight.step(1.0)
        turned = 2.0 * np.linalg.norm((flight.get(*QUATERNION) - first)[:3])
        assert abs(turned / (np.radians(0.05 * step) * 20.0 / 1500.0) - 1.0) < 1e-2
        assert abs(flight.get("panel[1].angleActual")[0] - angle) < 1e-12
    flight.close()
