"""Files and pages hold on other machines too: neither GUIDs nor results depend on the host's mathematics, the README's commands run."""

import ctypes
import os
import pathlib
import re
import subprocess
import sys
import zipfile

import pytest
from fmpy import extract, fmi2, read_model_description

from spacecraft import RESOURCES, call

README = pathlib.Path(__file__).resolve().parents[2] / "README.md"
# glibc's code for processors without fused multiply-add rounds sines of these differently from the other.
TURNED = "rotation_deg = [7.84, 24.78, 7.93]"
OTHER_PROCESSOR = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"}


def test_guid_and_results_are_the_same_on_every_processor(heliotorque, dist, tmp_path, monkeypatch):
    text = (RESOURCES / "messenger.toml").read_text(encoding="utf-8")
    text = re.sub(r"(?m)^rotation_deg = .*", TURNED, text, count=1)
    assert TURNED in text
    (tmp_path / "turned.toml").write_text(text, encoding="utf-8")
    guids, results = [], []
    for name, environment in (("Here", {}), ("There", OTHER_PROCESSOR)):
        with monkeypatch.context() as context:
            for variable, value in environment.items():
                context.setenv(variable, value)
            fmu = tmp_path / f"{name}.fmu"
            template = (dist / "MomentumPlant.fmu").resolve()
            packed = call(
                heliotorque, "pack", "--spacecraft", tmp_path / "turned.toml", "--template", template, "--name", "Turned",
                "--output", fmu,
            )
            assert packed.returncode == 0, packed.stderr
            # What is packed here is simulated there.
            simulated = call(heliotorque, "run", tmp_path / "Here.fmu", "--stop", "1h", "--output", tmp_path / f"{name}.csv")
            assert simulated.returncode == 0, simulated.stderr
        guids.append(read_model_description(str(fmu)).guid)
        results.append((tmp_path / f"{name}.csv").read_bytes())
    assert guids[0] == guids[1] and results[0] == results[1]


@pytest.mark.parametrize("name", ["MomentumPlant", "Cubesat"])
@pytest.mark.parametrize("location", [None, b""])
def test_a_master_may_leave_the_resource_location_out(dist, tmp_path, name, location):
    description = read_model_description(str(dist / f"{name}.fmu"))
    folder = pathlib.Path(extract(str(dist / f"{name}.fmu"), unzipdir=str(tmp_path / "fmu")))

    def instantiate():
        slave = fmi2.FMU2Slave(
            guid=description.guid, unzipDirectory=str(folder), instanceName="it",
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        messages, callbacks = [], fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(lambda *words: messages.append(words[-1].decode()))
        guid, given = description.guid.encode(), ctypes.byref(callbacks)
        slave.component = slave.fmi2Instantiate(b"it", fmi2.fmi2CoSimulation, guid, location, given, 0, 0)
        if slave.component:
            slave.freeInstance()
        return bool(slave.component), messages

    assert instantiate() == (True, [])
    # The compiled-in spacecraft is MomentumPlant's own; another one's is named where it is missing.
    os.rename(folder / "resources", tmp_path / "elsewhere")
    lives, messages = instantiate()
    assert lives == (name == "MomentumPlant")
    assert lives or f"is NULL or empty, and there is no folder `{folder / 'resources'}`" in messages[0]


def test_the_readmes_lines_for_fmpy_run(dist):
    (block,) = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    ran = subprocess.run(
        [sys.executable, "-c", block], cwd=dist.resolve().parent, capture_output=True, text=True, env=os.environ
    )
    assert ran.returncode == 0, ran.stderr
    momentum, dumps = map(float, ran.stdout.split())
    # The momentum stays within the threshold the lines set, and Table 2 has dumps in every column.
    assert 3.5 < momentum <= 4.0 + 1e-9 and dumps >= 2


@pytest.mark.parametrize("name", ["MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance"])
def test_a_manual_explains_what_it_cites(dist, name):
    with zipfile.ZipFile(dist / f"{name}.fmu") as archive:
        page = archive.read("documentation/index.html").decode()
    cited = set(re.findall(r"paper \d{3}", page))
    explained = re.findall(r"<tr><td>(paper \d{3})</td><td>(.*?)</td></tr>", page)
    # Authors, title.
    assert {paper for paper, text in explained if ":" in text} == cited and cited
    assert page.index('<h2 id="sources">') < page.index('<h2 id="stepping">') < page.index('<h2 id="calls">')
