from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from math import atan2, pi

# A sequencer of your own: a torque pulse whenever body X passes inertial Y, which moves the momentum that way turn by turn.
folder = extract("{fmu}")
description = read_model_description(folder)
variables = {variable.name: variable.valueReference for variable in description.modelVariables}
vector = lambda name: [variables[f"{name}[{i}]"] for i in (1, 2, 3)]
plant = FMU2Slave(guid=description.guid, unzipDirectory=folder, instanceName="plant",
                  modelIdentifier=description.coSimulation.modelIdentifier)
plant.instantiate()
plant.setupExperiment(startTime=0.0)
plant.setInteger([variables["burn.plan"]], [4])  # commanded: nothing fires by itself
plant.enterInitializationMode()
plant.exitInitializationMode()
quaternion = [variables[f"attitude.q[{i}]"] for i in (1, 2, 3, 4)]
start, step_s = plant.getReal(vector("momentum.inertial")), 0.1
for k in range(3000):
    x, y, z, w = plant.getReal(quaternion)
    azimuth = atan2(2 * (x * y + z * w), 1 - 2 * (y * y + z * z))  # of body X in the inertial frame
    torque = 0.5 if abs(azimuth - pi / 2) < 0.1 else 0.0
    plant.setReal(vector("torque.applied"), [torque, 0.0, 0.0])
    plant.doStep(k * step_s, step_s)
moved = [b - a for a, b in zip(start, plant.getReal(vector("momentum.inertial")))]
print("momentum moved by [N.m.s]:", moved)
plant.terminate()
plant.freeInstance()
