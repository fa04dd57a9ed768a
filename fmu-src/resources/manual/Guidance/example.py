from fmpy import simulate_fmu

start = {"pointing.scenario": 3,  # nadir
         "position[1]": 1.0e7, "position[2]": 2.0e6, "position[3]": 4.0e6, "velocity[2]": 1300.0, "velocity[3]": 600.0}
outputs = ["command.q[1]", "command.q[2]", "command.q[3]", "command.q[4]", "sun.azimuth", "sun.elevation"]
result = simulate_fmu("{fmu}", start_values=start, stop_time=10, step_size=1, output_interval=1, output=outputs)
print("commanded attitude:", [result[name][-1] for name in outputs[:4]])
