"""Venus surveyor under an own controller: disturbance torque from the FMU, body and wheels in numpy."""

import sys

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

AU_M, STEP_S, HOURS = 1.495978707e11, 1.0, 2
KP, KD = 0.0025, 0.08  # 1/s2, 1/s
SUN = np.array([0.0, -0.723 * AU_M, 0.0])  # inertial axes chosen so that the Sun stands on -Y

path = sys.argv[1]
description = read_model_description(path)
reference = {variable.name: variable.valueReference for variable in description.modelVariables}
fmu = FMU2Slave(guid=description.guid, unzipDirectory=extract(path),
                modelIdentifier=description.coSimulation.modelIdentifier)


def vector(name):
    return [reference[f"{name}[{axis}]"] for axis in (1, 2, 3)]


fmu.instantiate()
fmu.setupExperiment(startTime=0.0)
fmu.enterInitializationMode()
fmu.exitInitializationMode()

inertia = np.diag([260.0, 310.0, 180.0])
angle, rate, wheels = np.radians([2.0, 0.0, 0.0]), np.zeros(3), np.zeros(3)  # small angles from the inertial axes
orbit = np.sqrt(3.24858592e14 / 6551.8e3**3)  # circular, 500 km, rad/s
for k in range(int(HOURS * 3600 / STEP_S)):
    time, (x, y, z) = k * STEP_S, angle
    body = np.array([[1, z, -y], [-z, 1, x], [y, -x, 1]])  # inertial to body axes, to first order
    below = 6551.8e3 * np.array([np.cos(orbit * time), 0.6 * np.sin(orbit * time), 0.8 * np.sin(orbit * time)])
    fmu.setReal(vector("sun.positionBody") + vector("planet.positionBody"), [*(body @ SUN), *(body @ -below)])
    fmu.doStep(time, STEP_S)
    disturbance = np.array(fmu.getReal(vector("torque.total")))
    motor = inertia @ (KP * angle + KD * rate)
    acceleration = np.linalg.solve(inertia, disturbance - motor - np.cross(rate, inertia @ rate + wheels))
    rate = rate + STEP_S * acceleration
    angle, wheels = angle + STEP_S * rate, wheels + STEP_S * motor
print(f"after {HOURS} h: {np.degrees(np.linalg.norm(angle)) * 3600:.2f} arcsec off, "
      f"wheels hold {wheels[0]:.4f}, {wheels[1]:.4f}, {wheels[2]:.4f} N.m.s")
fmu.terminate()
fmu.freeInstance()
