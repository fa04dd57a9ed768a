"""A second importer, libcosim (with the FMI Library), steps MomentumPlant to FMPy's numbers, bit for bit."""

from flight import fly, stack, vector


def libcosim_momentum(fmu, step_s, steps):
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    execution = CosimExecution.from_step_size(step_size=int(step_s * 1e9))
    slave = execution.add_local_slave(local_slave=CosimLocalSlave(fmu_path=fmu, instance_name="plant"))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer=observer)

    def text(name):
        return name.decode() if isinstance(name, bytes) else name

    references = {text(v.name): v.reference for v in execution.slave_variables(slave_index=slave)}
    assert execution.step(step_count=steps)
    wanted = [references[name] for name in vector("momentum.body")]
    return observer.last_real_values(slave_index=slave, variable_references=wanted)


def test_libcosim_and_fmpy_agree_to_the_bit(momentum_plant):
    ours = stack(fly(momentum_plant, 600.0, days=3.0, output=vector("momentum.body")), "momentum.body")[-1]
    theirs = libcosim_momentum(momentum_plant, 600.0, 3 * 144)
    assert list(ours) == list(theirs)
    assert abs(ours).max() > 0.1
