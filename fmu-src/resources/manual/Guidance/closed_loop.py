from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

# An orbit of your own, and a body of your own that follows each command one step later.
folder = extract("{fmu}")
description = read_model_description(folder)
variables = {variable.name: variable.valueReference for variable in description.modelVariables}
vector = lambda name, size=3: [variables[f"{name}[{i}]"] for i in range(1, size + 1)]
guidance = FMU2Slave(guid=description.guid, unzipDirectory=folder, instanceName="guidance",
                     modelIdentifier=description.coSimulation.modelIdentifier)
guidance.instantiate()
guidance.setupExperiment(startTime=0.0)
guidance.enterInitializationMode()
guidance.exitInitializationMode()
mu_m3_s2, step_s = 2.2032e13, 1.0  # Mercury
position, velocity = [1.0e7, 2.0e6, 4.0e6], [0.0, 1300.0, 600.0]
guidance.setInteger([variables["pointing.scenario"]], [3])  # nadir
for k in range(300):
    guidance.setReal(vector("position") + vector("velocity"), position + velocity)
    guidance.doStep(k * step_s, step_s)
    attitude, rate = guidance.getReal(vector("command.q", 4)), guidance.getReal(vector("command.rate"))
    guidance.setReal(vector("estimate.q", 4) + vector("estimate.rate"), attitude + rate)
    distance_m = sum(x * x for x in position) ** 0.5
    velocity = [v - step_s * mu_m3_s2 * x / distance_m**3 for x, v in zip(position, velocity)]
    position = [x + step_s * v for x, v in zip(position, velocity)]
print("attitude after 5 min:", attitude)
guidance.terminate()
guidance.freeInstance()
