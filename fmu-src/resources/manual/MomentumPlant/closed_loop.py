from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

# A rate damper of your own around the free rigid body: its torque acts from outside, as that of thrusters would.
folder = extract("{fmu}")
description = read_model_description(folder)
variables = {variable.name: variable.valueReference for variable in description.modelVariables}
vector = lambda name: [variables[f"{name}[{i}]"] for i in (1, 2, 3)]
plant = FMU2Slave(guid=description.guid, unzipDirectory=folder, instanceName="plant",
                  modelIdentifier=description.coSimulation.modelIdentifier)
plant.instantiate()
plant.setupExperiment(startTime=0.0)
plant.setInteger([variables["attitude.source"], variables["momentum.convention"]], [4, 1])  # free, inertial
plant.setReal(vector("start.rate"), [1e-3, -2e-3, 1e-3])
plant.enterInitializationMode()
plant.exitInitializationMode()
inertia = plant.getReal([variables[f"spacecraft.inertia[{i},{i}]"] for i in (1, 2, 3)])
step_s = 1.0
for k in range(600):
    rate = plant.getReal(vector("attitude.rate"))
    plant.setReal(vector("torque.applied"), [-0.02 * own * of for own, of in zip(inertia, rate)])
    plant.doStep(k * step_s, step_s)
rate = plant.getReal(vector("attitude.rate"))
print("rate after 10 min [rad/s]:", rate)
plant.terminate()
plant.freeInstance()
