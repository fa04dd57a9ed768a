from fmpy import simulate_fmu

outputs = ["torque.total[1]", "torque.total[2]", "torque.total[3]", "force.total[2]", "sun.litFraction"]
start = {"sun.positionBody[1]": 1.0e10, "sun.positionBody[2]": -5.8e10, "sun.positionBody[3]": -5.0e9}
result = simulate_fmu("{fmu}", start_values=start, stop_time=600, step_size=60, output_interval=60, output=outputs)
print("torque [N.m]:", [result[name][-1] for name in outputs[:3]])
