from fmpy import simulate_fmu

outputs = ["torque.solar[1]", "momentum.body[1]", "momentum.body[2]", "momentum.body[3]", "sun.elevation"]
result = simulate_fmu("{fmu}", stop_time=6 * 3600, step_size=600, output_interval=600, output=outputs)
for row in result[::6]:
    print(*(f"{value:12.4g}" for value in row))
