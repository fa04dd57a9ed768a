"""The program on Windows, under Wine: simulations, failures of FMUs, files and child processes as on Linux.

Wine is no Windows: it enforces no limit of memory of a Job Object (the program looks itself), replaces no file that is open, and its share
`\\\\server\\share` is a link in its registry's folder.
"""

import contextlib
import os
import pathlib
import shutil
import signal
import subprocess
import time

import pytest

import windows
from spacecraft import RESOURCES, call
from windows import compile_c, hostile, path, processes, until, with_windows_library

MODELS = ["MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance", "Cubesat", "FlexibleCraft", "MessengerFull", "MessengerLight"]
IN_STEP = "fmi2DoStep(currentCommunicationPoint=3, communicationStepSize=1): "
# Beyond MAX_PATH (260), each name below 256.
LONG_NAME = "a-name-of-more-than-fifty-letters-as-folders-of-projects-have"
# CreateFileW's share modes.
READ, WRITE, DELETE = 1, 2, 4
LETTERS = "Überflug Ωμέγα 火星 🛰"


@pytest.fixture(scope="session")
def built():
    folder = os.environ.get("HELIOTORQUE_WINDOWS")
    if not folder:
        pytest.skip("HELIOTORQUE_WINDOWS is not set: run `cargo xtask test --all-platforms`")
    return pathlib.Path(folder)


@pytest.fixture(scope="session")
def server(built):
    """One that outlives each program, so that Wine's own services start once."""
    # It waits for one that runs already, which serves as well.
    with contextlib.suppress(subprocess.TimeoutExpired):
        subprocess.run(["wineserver", "-p120"], check=False, env=os.environ | windows.QUIET, timeout=5)
    # Wine's services keep the streams of the first program, so nobody may wait for their end.
    nothing = subprocess.DEVNULL
    subprocess.run(["wine", "cmd", "/c", "ver"], check=False, env=os.environ | windows.QUIET, stdin=nothing, stdout=nothing, stderr=nothing)


@pytest.fixture
def program(built, server, tmp_path):
    yield windows.Program(built)
    until(lambda: not processes(tmp_path))
    assert not windows.temporaries()


@pytest.fixture(scope="session")
def fmus(built, dist, tmp_path_factory):
    """The shipped FMUs with a library of Windows, by name."""
    folder = tmp_path_factory.mktemp("fmus")
    library = built / "heliotorque.dll"
    return {name: with_windows_library(dist / f"{name}.fmu", library, folder / f"{name}.fmu") for name in MODELS}


@pytest.fixture(scope="session")
def holder(built, tmp_path_factory):
    """A program of Windows that keeps a file open."""
    return compile_c(windows.ROOT / "tests/c/hold.c", tmp_path_factory.mktemp("hold") / "hold.exe", "-municode")


def rows(file):
    return file.read_text(encoding="utf-8").splitlines()[1:] if file.exists() else []


@pytest.mark.parametrize("name", MODELS)
def test_an_fmu_is_simulated_as_on_linux(program, heliotorque, fmus, tmp_path, name):
    here, there = tmp_path / "linux.csv", tmp_path / "windows.csv"
    simulated = call(heliotorque, "run", fmus[name], "--stop", "2h", "--output", here)
    assert simulated.returncode == 0, simulated.stderr
    program.good("run", path(fmus[name]), "--stop", "2h", "--output", path(there))
    assert len(rows(there)) > 1 and there.read_bytes() == here.read_bytes()


@pytest.mark.parametrize("name", ["DisturbanceTorque", "Guidance", "MomentumPlant"])
def test_a_check_passes(program, fmus, name):
    printed = program.good("check", path(fmus[name]))
    assert " 0 failed" in printed, printed


@pytest.mark.parametrize(
    ("behaviour", "more", "expected"),
    [
        ("EXITS", [], "the process ended: it exited with status 0"),
        ("CRASHES", [], "exception 0xc0000005 (segmentation fault)"),
        ("ABORTS", [], "the process ended: it exited with status 3"),
        ("FAILS", [], "answered fmi2Error"),
        ("LIES", [], "the process ended: it exited with status 0"),
        ("SLEEPS", ["--timeout", "0.5s"], "hangs: the call did not return within 0.5 s (see --timeout)"),
        ("SPINS", ["--timeout", "500ms"], "hangs: the call did not return within 0.5 s (see --timeout)"),
        ("PRINTS", ["--timeout", "1s"], "hangs: the call did not return within 1 s (see --timeout)"),
    ],
)
def test_a_run_names_the_call_and_keeps_the_rows(program, tmp_path, behaviour, more, expected):
    fmu, table = hostile(tmp_path, behaviour, "IN_STEP"), tmp_path / "a.csv"
    table.write_text("the last good one")
    printed = program.bad("run", path(fmu), "--output", path(table), *more)
    assert IN_STEP in printed and expected in printed, printed
    assert "4 rows so far: " in printed and "a.csv.part" in printed
    assert rows(tmp_path / "a.csv.part") == ["0,0", "1,1", "2,2", "3,3"]
    assert table.read_text() == "the last good one" and len(printed) < 3 << 20


@pytest.mark.parametrize(
    ("behaviour", "place", "expected"),
    [
        ("EXITS", "IN_STEP", IN_STEP + "the process ended"),
        ("CRASHES", "IN_STEP", "segmentation fault"),
        # Windows itself survives that.
        ("CRASHES", "AT_LOADING", "Hostile.dll: the shared library does not load: "),
        ("SLEEPS", "IN_INSTANTIATE", "fmi2Instantiate: hangs: still busy after 5 s in all (see --timeout)"),
        ("SPINS", "IN_INSTANTIATE", "fmi2Instantiate: hangs: still busy after 5 s in all (see --timeout)"),
        ("LIES", "IN_INSTANTIATE", "fmi2Instantiate: the process ended: it exited with status 0"),
        ("PRINTS", "IN_INSTANTIATE", "fmi2Instantiate: prints without end: more than 16 MiB"),
        ("TOUCHES", "IN_INSTANTIATE", "fmi2Instantiate: allocates without end: more than 4096 MiB"),
    ],
)
def test_a_check_names_the_call(program, tmp_path, behaviour, place, expected):
    timeout = "60s" if behaviour in ("TOUCHES", "PRINTS") else "5s"
    printed = program.bad("check", path(hostile(tmp_path, behaviour, place)), "--probe", "simulation", "--timeout", timeout)
    assert expected in printed and "1 failed" in printed, printed


def test_panics_stay_inside(program, built, tmp_path):
    fmu, table = tmp_path / "Panicking.fmu", tmp_path / "a.csv"
    program.good("pack", "--library", path(built / "probe.dll"), "--model", "Panicking", "--output", path(fmu))
    described = program.good("info", path(fmu), "--variables")
    (line,) = [line for line in described.splitlines() if "Panic in step, with half" in line]
    number = next(word for word in line.split() if word.isdigit())
    (tmp_path / "in.csv").write_text(f"time,fault\n0,1\n3,{number}\n")
    printed = program.bad(
        "run", path(fmu), "--start", "0", "--stop", "10", "--step", "1", "--input", path(tmp_path / "in.csv"), "--output", path(table)
    )
    assert "fmi2Error" in printed and "panic" in printed and "4 rows so far: " in printed, printed
    assert "the process ended" not in printed


@pytest.mark.parametrize("form", ["drive", "slashes", "verbatim", "share", "letters", "long"])
def test_resources_are_found_wherever_the_fmu_is(program, fmus, tmp_path, form):
    """The FMU reads its own file there: a wrong one is refused by its path."""
    name = {"letters": LETTERS, "long": "/".join([LONG_NAME] * 6)}.get(form, "a folder 100% {x}+#")
    folder = tmp_path / name
    shutil.unpack_archive(fmus["MomentumPlant"], folder / "fmu", "zip")
    place = path(folder)
    if form == "slashes":
        place = place.replace("\\", "/")
    elif form == "verbatim":
        place = "\\\\?\\" + place
    elif form == "share":
        place = windows.share(folder)
    assert form != "long" or len(place) > 300
    table = folder / "out.csv"
    program.good("run", f"{place}\\fmu", "--stop", "1h", "--output", f"{place}\\out.csv")
    assert len(rows(table)) > 1
    (setup,) = (folder / "fmu" / "resources").glob("*.toml")
    setup.write_text(setup.read_text(encoding="utf-8").replace("[mass_properties]", "[mass_propertys]", 1), encoding="utf-8")
    printed = program.bad("run", f"{place}\\fmu", "--stop", "1h")
    assert "mass_propertys" in printed and setup.name in printed, printed


def test_text_files_may_have_lines_of_windows(program, heliotorque, fmus, tmp_path):
    """Mission, timeline, spacecraft, tables, campaign, plan: what they give with CR LF is what they give with LF."""
    results = []
    for kind, ending in (("lf", "\n"), ("crlf", "\r\n")):
        folder = tmp_path / kind
        folder.mkdir()
        program.good("new", "timeline", path(folder / "timeline.toml"))
        shutil.copy(RESOURCES / "messenger.toml", folder / "craft.toml")
        (folder / "mission.toml").write_text("")
        program.good("new", "mission", path(folder / "mission.toml"), "--force")
        (folder / "plan.toml").write_text('mission = "mission.toml"\nfreeze = 0\n[tilt]\nazimuth = "10 deg"\n[momentum]\ndumps = 2\n')
        (folder / "campaign.toml").write_text(
            'mission = "mission.toml"\nstep = "1 h"\nsampling = "file"\nfile = "values.csv"\n[keep]\nfinal = ["momentum.body"]\n')
        (folder / "values.csv").write_text("run,spacecraft.centerOfMass[3]\n0,-0.02\n1,-0.03\n")
        (folder / "in.csv").write_text("# an input\ntime,panel[1].sunOffsetCommand\n0,0.1\n3600,0.2\n")
        for file in folder.iterdir():
            text = file.read_text(encoding="utf-8").replace("\r\n", "\n").replace("\n", ending)
            file.write_bytes(text.encode())
        template = path(fmus["MomentumPlant"])
        program.good("check", path(folder / "craft.toml"), "--template", template)
        program.good("pack", "--spacecraft", path(folder / "craft.toml"), "--timeline", path(folder / "timeline.toml"),
                     "--template", template, "--name", "Own", "--output", path(folder / "Own.fmu"))
        program.good("run", path(folder / "mission.toml"), "--template", template, "--stop", "1h", "--output", path(folder / "mission.csv"))
        program.good("run", path(folder / "Own.fmu"), "--stop", "1h", "--output", path(folder / "own.csv"))
        program.good("run", template, "--stop", "1h", "--input", path(folder / "in.csv"), "--output", path(folder / "table.csv"))
        program.good("sweep", path(folder / "campaign.toml"), "--template", template, "--output", path(folder / "runs.csv"))
        program.good("plan", path(folder / "plan.toml"), "--template", template, "--output", path(folder / "plan"))
        named = ("mission.csv", "own.csv", "table.csv", "runs.csv", "plan/plan.csv")
        results.append([(folder / name).read_bytes() for name in named])
    assert results[0] == results[1] and all(b"\n" in result for result in results[0])


@pytest.mark.parametrize(("share", "completes"), [(READ | WRITE | DELETE, True), (READ | WRITE, True), (READ, False)])
def test_a_file_that_is_open_is_replaced_or_named(program, holder, fmus, tmp_path, share, completes):
    table = tmp_path / "a.csv"
    table.write_text("old")
    with program.start(path(table), share, program=holder) as held:
        assert held.stdout.readline().strip() == b"held"
        status, printed = program.call("run", path(fmus["DisturbanceTorque"]), "--stop", "1h", "--output", path(table))
        out, _ = held.communicate(b"\n", timeout=60)
        # Whoever has it open goes on reading what stood there.
        assert out == b"old" and held.returncode == 0
    part = rows(tmp_path / "a.csv.part")
    if status == 0:
        # Wine 8 does not get here: it refuses what Windows 10 does.
        assert share & DELETE and len(rows(table)) > 1 and not part
    else:
        assert "a.csv: another program has it open" in printed and "see --output" in printed, printed
        # Refused before the flight, or its rows stay.
        assert table.read_text() == "old" and (len(part) > 1) == completes


def test_two_runs_into_one_file_do_not_mix(program, tmp_path):
    fmu, table = hostile(tmp_path, "SLEEPS", "IN_STEP"), tmp_path / "a.csv"
    first = program.start("run", path(fmu), "--output", path(table), "--timeout", "60s")
    until(lambda: len(rows(tmp_path / "a.csv.part")) == 4)
    printed = program.bad("run", path(fmu), "--stop", "2", "--output", path(table))
    assert "a.csv.part: another run is writing it: see --output" in printed, printed
    # Others may read it meanwhile.
    assert program.call("info", path(tmp_path / "a.csv.part"))[0] in (0, 2)
    first.kill()
    first.communicate()


def test_what_an_fmu_starts_ends_with_it_and_is_named(program, tmp_path):
    for number, behaviour in enumerate(("FORKS", "DETACHES")):
        folder = tmp_path / str(number)
        fmu, table = hostile(folder, behaviour, "IN_STEP"), folder / "a.csv"
        printed = program.good("run", path(fmu), "--stop", "6", "--output", path(table))
        assert len(rows(table)) == 7
        assert "left processes behind, which were ended: " in printed and "heliotorque.exe" in printed, printed


def test_children_end_with_a_program_that_is_killed(program, tmp_path):
    fmu, table = hostile(tmp_path, "SLEEPS", "IN_STEP"), tmp_path / "a.csv"
    table.write_text("the last good one")
    child = program.start("run", path(fmu), "--output", path(table))
    until(lambda: len(rows(tmp_path / "a.csv.part")) == 4)
    assert len(processes(tmp_path)) == 2
    child.kill()
    child.communicate()
    until(lambda: not processes(tmp_path))
    assert len(rows(tmp_path / "a.csv.part")) == 4 and table.read_text() == "the last good one"
    program.good("run", path(fmu), "--stop", "3", "--output", path(table))
    assert len(rows(table)) == 4 and not (tmp_path / "a.csv.part").exists()


def test_ctrl_c_ends_what_hangs(program, tmp_path):
    fmu, table = hostile(tmp_path, "SLEEPS", "IN_STEP"), tmp_path / "a.csv"
    child = program.start("run", path(fmu), "--output", path(table), stdin=subprocess.DEVNULL)
    until(lambda: len(rows(tmp_path / "a.csv.part")) == 4)
    began = time.monotonic()
    child.send_signal(signal.SIGINT)
    out, err = child.communicate(timeout=60)
    printed = (out + err).decode()
    assert child.returncode == 130 and time.monotonic() - began < 3, printed
    assert "interrupted at 3 s" in printed and len(rows(table)) == 4, printed
