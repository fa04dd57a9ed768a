from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from math import cos, sin

# A body of your own, kept on the Sun about X by a controller of your own; small angles, one axis.
folder = extract("{fmu}")
description = read_model_description(folder)
variables = {variable.name: variable.valueReference for variable in description.modelVariables}
vector = lambda name: [variables[f"{name}[{i}]"] for i in (1, 2, 3)]
light = FMU2Slave(guid=description.guid, unzipDirectory=folder, instanceName="light",
                  modelIdentifier=description.coSimulation.modelIdentifier)
light.instantiate()
light.setupExperiment(startTime=0.0)
light.enterInitializationMode()
light.exitInitializationMode()
inertia_kg_m2, angle, rate, wheel_n_m_s, step_s, distance_m = 500.0, 0.1, 0.0, 0.0, 1.0, 5.8e10
for k in range(600):
    light.setReal(vector("sun.positionBody"), [0.0, -distance_m * cos(angle), distance_m * sin(angle)])
    light.doStep(k * step_s, step_s)
    torque = light.getReal(vector("torque.total"))[0]
    command = -inertia_kg_m2 * (0.05**2 * angle + 2 * 0.8 * 0.05 * rate)
    rate += step_s * (torque + command) / inertia_kg_m2
    angle += step_s * rate
    wheel_n_m_s -= step_s * command
print(f"off the Sun by {angle:.2e} rad, {wheel_n_m_s:.4f} N.m.s in the wheel")
light.terminate()
light.freeInstance()
