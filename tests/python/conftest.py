"""The FMUs and the library under test; `cargo xtask test` sets the environment."""

import os
import pathlib

import fmpy.simulation
import pytest
from fmpy import extract

from studies import study


# FMPy's native logger calls whichever function was registered last, also for FMUs that brought none, and does not keep it.
_LOGGERS = []
_LoggerType = fmpy.simulation.fmi2CallbackLoggerTYPE


def _kept(function):
    _LOGGERS.append(_LoggerType(function))
    return _LOGGERS[-1]


fmpy.simulation.fmi2CallbackLoggerTYPE = _kept


def _path(variable):
    value = os.environ.get(variable)
    if not value:
        refuse = pytest.fail if os.environ.get("CI") else pytest.skip
        refuse(f"{variable} is not set: run `cargo xtask test`")
    return pathlib.Path(value)


def pytest_configure(config):
    config.addinivalue_line("markers", "long: runs in `cargo xtask test --long` alone")
    config.addinivalue_line("markers", "written: holds passages of guide and README, which `bless guide` writes anew")
    config.addinivalue_line("markers", "rebuilds: of these, builds and packs anew what the others read")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """A worker has all tests of a file, and one all that share the studies; xdist's own hook, which reads the groups, comes after."""
    for item in items:
        group = "studies" if "studied" in item.fixturenames else item.path.name
        item.add_marker(pytest.mark.xdist_group(group))


@pytest.fixture(scope="session")
def dist():
    return _path("HELIOTORQUE_DIST")


@pytest.fixture(scope="session")
def heliotorque():
    return _path("HELIOTORQUE")


@pytest.fixture(scope="session")
def library():
    return _path("HELIOTORQUE_LIBRARY")


@pytest.fixture(scope="session")
def probe_library():
    return _path("HELIOTORQUE_PROBE_LIBRARY")


@pytest.fixture(scope="session")
def momentum_plant(dist):
    return str(dist / "MomentumPlant.fmu")


@pytest.fixture(scope="session")
def unpacked_plant(momentum_plant, tmp_path_factory):
    return extract(momentum_plant, unzipdir=str(tmp_path_factory.mktemp("MomentumPlant")))


@pytest.fixture(scope="session")
def studied(heliotorque, dist, tmp_path_factory):
    """What a study prints and leaves, simulated once on four threads for all tests."""
    done = {}

    def run(name):
        if name not in done:
            done[name] = study(heliotorque, dist, tmp_path_factory.mktemp("study"), name, 4)
        return done[name]

    return run
