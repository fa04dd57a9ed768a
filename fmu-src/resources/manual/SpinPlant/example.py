from fmpy import simulate_fmu

outputs = ["nutation.angle", "spin.rate", "momentum.displacement", "burn.pulsesFired"]
result = simulate_fmu("{fmu}", stop_time=300, step_size=1, output_interval=1, output=outputs)
print(f"{result['burn.pulsesFired'][-1]} pulses moved the momentum by {result['momentum.displacement'][-1]:.3e} rad, "
      f"nutation at most {max(result['nutation.angle']):.3e} rad")
