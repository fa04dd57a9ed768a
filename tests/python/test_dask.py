"""`heliotorque_dask` and the Slurm script: pieces on several processes give the bytes of one sweep; what goes wrong is named."""

import os
import pathlib
import re
import stat
import subprocess
import sys

import pytest
from distributed import Client, LocalCluster

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "harness" / "dask"
sys.path.append(str(PACKAGE))
from heliotorque_dask import SweepError, cut, sweep  # noqa: E402

RUNS = 23
CAMPAIGN = """fmu = '{plant}'
stop = "1 d"
step = "1 h"
runs = 23
seed = 7
sampling = "random"
[vary]
"spacecraft.centerOfMass[3]" = {{ normal = ["-2.54 cm", "5 mm"] }}
"solar.flux" = {{ values = [1353, 1361] }}
[keep]
final = ["momentum.body"]
extremes = ["momentum.body"]
"""

# The interface of `heliotorque sweep` as far as it is used: a row is a function of its number, with a text that has a line end.
STAND_IN = '''#!{python}
import os, sys
arguments = sys.argv[1:]
assert arguments[0] == "sweep" and arguments[arguments.index("--output") + 1] is not None
runs, name = 23, os.path.basename(arguments[1])
def row(run):
    status = "failed" if name == "failing.toml" and run == 7 else "ok"
    return f'{{run}},{{run * 0.1}},{{status}},"a, ""b""\\n{{run}}"\\n'
def value(option):
    return arguments[arguments.index(option) + 1] if option in arguments else None
if name == "refused.toml" and "--runs" in arguments and value("--runs").startswith("0.."):
    print("refused.toml:3: sampling: found maybe, allowed: random", file=sys.stderr)
    sys.exit(2)
header = "run,x,status,reason\\n"
if name == "mixed.toml" and "--runs" in arguments and not value("--runs").startswith("0.."):
    header = "run,y,status,reason\\n"
begin, end = (int(edge) for edge in (value("--runs") or f"0..{{runs}}").split(".."))
if "--dry-run" in arguments:
    text = "run,x\\n" + "".join(f"{{run}},{{run * 0.1}}\\n" for run in range(runs))
else:
    assert "--workers" in arguments
    text = header + "".join(row(run) for run in range(begin, end - (name == "short.toml")))
if value("--output") == "-":
    sys.stdout.write(text)
else:
    open(value("--output"), "w").write(text)
    open(value("--output") + ".toml", "w").write(f"runs = {{runs}}\\n")
if name == "failing.toml" and "--dry-run" not in arguments and begin <= 7 < end:
    sys.exit(1)
'''


@pytest.fixture
def stand_in(tmp_path):
    """A program with sweep's interface, and what one run of it gives for all runs."""
    folder = tmp_path / "bin"
    folder.mkdir()
    program = folder / "heliotorque"
    program.write_text(STAND_IN.format(python=sys.executable), encoding="utf-8")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    command = [program, "sweep", "campaign.toml", "--workers", "1", "--output", "-"]
    return program, subprocess.run(command, capture_output=True, check=True).stdout


@pytest.fixture(scope="module")
def client():
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            yield client


def test_pieces_hold_every_run_once():
    for runs, pieces in [(1, 1), (23, 5), (23, 100), (1000, 7)]:
        edges = cut(runs, pieces)
        assert [run for begin, end in edges for run in range(begin, end)] == list(range(runs))
        sizes = [end - begin for begin, end in edges]
        assert min(sizes) >= 1 and max(sizes) - min(sizes) <= 1 and len(sizes) == min(runs, pieces)


@pytest.mark.parametrize("pieces", [1, 5, 100, None])
def test_pieces_are_joined_in_order(client, stand_in, tmp_path, pieces):
    program, expected = stand_in
    output = tmp_path / "runs.csv"
    assert sweep(client, tmp_path / "campaign.toml", output, pieces, str(program)) == RUNS
    assert output.read_bytes() == expected
    assert (tmp_path / "runs.csv.toml").read_text(encoding="utf-8") == "runs = 23\n"
    assert not list(tmp_path.glob("runs.csv.part*"))


def test_a_failed_run_is_a_row_and_what_is_not_made_is_said(client, stand_in, tmp_path):
    program, expected = stand_in
    output = tmp_path / "runs.csv"
    campaign = tmp_path / "failing.toml"
    campaign.write_text('[keep]\npercentiles = ["x"]\nhistories = "out"\n', encoding="utf-8")
    failed = []
    with pytest.warns(UserWarning) as said:
        assert sweep(client, campaign, output, 4, str(program), failed=failed) == RUNS
    assert [str(it.message).split(": ")[1] for it in said] == ["keep.percentiles", "keep.histories"]
    assert failed == ["7"] and output.read_bytes() == expected.replace(b"\n7,0.7000000000000001,ok", b"\n7,0.7000000000000001,failed")
    done = module(campaign, "--output", output, "--heliotorque", program, "--scheduler", client.scheduler.address)
    assert done.returncode == 1 and "runs.csv: 23 runs, 1 failed" in done.stderr and "keep.histories: each worker" in done.stderr, done.stderr


def test_rows_that_were_left_are_not_thrown_away(client, stand_in, tmp_path):
    program, expected = stand_in
    output = tmp_path / "runs.csv"
    part = pathlib.Path(f"{output}.part")
    part.write_bytes(expected[:200])
    pathlib.Path(f"{part}.toml").write_text("runs = 23\n", encoding="utf-8")
    with pytest.raises(SweepError, match="runs.csv.part: found runs of this campaign, allowed: .*--resume"):
        sweep(client, tmp_path / "campaign.toml", output, 4, str(program))
    assert part.read_bytes() == expected[:200]
    assert sweep(client, tmp_path / "campaign.toml", output, 4, str(program), fresh=True) == RUNS
    assert output.read_bytes() == expected


@pytest.mark.parametrize(
    "campaign, said",
    [
        ("refused.toml", r"refused.toml:3: sampling: found maybe, allowed: random"),
        ("mixed.toml", r"mixed.toml, runs 5\.\.11: found another header"),
        ("short.toml", r"short.toml, runs 0\.\.5: found 4 rows, from run \['0'\] on, allowed: 5"),
    ],
)
def test_what_goes_wrong_is_named_and_the_table_not_replaced(client, stand_in, tmp_path, campaign, said):
    program, _ = stand_in
    output = tmp_path / "runs.csv"
    output.write_text("earlier", encoding="utf-8")
    with pytest.raises(SweepError, match=said):
        sweep(client, tmp_path / campaign, output, 4, str(program))
    assert output.read_text(encoding="utf-8") == "earlier" and not pathlib.Path(f"{output}.toml").exists()


def module(*arguments, **environment):
    return subprocess.run(
        [sys.executable, "-m", "heliotorque_dask", *map(str, arguments)],
        capture_output=True, text=True, env=os.environ | {"PYTHONPATH": str(PACKAGE)} | environment,
    )


def test_the_command_uses_a_scheduler_or_its_own_processes(client, stand_in, tmp_path):
    program, expected = stand_in
    output = tmp_path / "runs.csv"
    scheduler = ["--scheduler", client.scheduler.address]
    for more in [scheduler, [*scheduler, "--pieces", "3"], []]:
        done = module(tmp_path / "campaign.toml", "--output", output, "--heliotorque", program, *more)
        assert done.returncode == 0 and "runs.csv: 23 runs" in done.stderr, done.stderr
        assert output.read_bytes() == expected
        output.unlink()
    refused = module(tmp_path / "refused.toml", "--output", output, "--heliotorque", program, *scheduler)
    assert refused.returncode == 2 and "heliotorque_dask: " in refused.stderr and "sampling: found maybe" in refused.stderr
    absent = module(tmp_path / "campaign.toml", "--output", output, "--heliotorque", tmp_path / "none", *scheduler)
    assert absent.returncode == 2 and "none: No such file or directory; allowed: the heliotorque program" in absent.stderr
    assert module(tmp_path / "campaign.toml", "--output", output, "--pieces", "0").returncode == 2
    assert not output.exists()


def slurm(folder, program, campaign, piece, pieces):
    """One job of the array, with `srun` as nothing but a prefix."""
    srun = program.with_name("srun")
    srun.write_text('#!/bin/sh\nexec "$@"\n', encoding="utf-8")
    srun.chmod(0o755)
    environment = os.environ | {
        "PATH": f"{program.parent}:{os.environ['PATH']}",
        "SLURM_ARRAY_TASK_ID": str(piece), "SLURM_ARRAY_TASK_COUNT": str(pieces), "SLURM_CPUS_PER_TASK": "2",
    }
    command = ["sh", ROOT / "examples" / "sweep.slurm", campaign]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)


def joined_as_told(folder):
    """The script's own line that joins pieces."""
    script = (ROOT / "examples" / "sweep.slurm").read_text(encoding="utf-8")
    [line] = re.findall(r"(?m)^# +(awk .*)$", script)
    subprocess.run(["sh", "-c", line], cwd=folder, check=True)
    return (folder / "runs.csv").read_bytes()


def test_the_slurm_array_gives_the_same_bytes(stand_in, tmp_path):
    program, expected = stand_in
    folder = tmp_path / "jobs"
    for pieces in [10, 30]:
        folder.mkdir()
        for piece in range(pieces):
            done = slurm(folder, program, "campaign.toml", piece, pieces)
            assert done.returncode == 0, done.stderr
        assert joined_as_told(folder) == expected
        folder = tmp_path / "more"


def test_a_campaign_of_the_plant_is_the_same_byte_for_byte(client, heliotorque, momentum_plant, tmp_path):
    campaign = tmp_path / "campaign.toml"
    campaign.write_text(CAMPAIGN.format(plant=momentum_plant), encoding="utf-8")
    alone = tmp_path / "alone.csv"
    subprocess.run([heliotorque, "sweep", campaign, "--output", alone], check=True)
    output = tmp_path / "runs.csv"
    assert sweep(client, campaign, output, 4, str(heliotorque)) == RUNS
    beside = [pathlib.Path(f"{table}.toml").read_bytes() for table in (alone, output)]
    assert output.read_bytes() == alone.read_bytes() and beside[0] == beside[1]
    header, *rows = output.read_text(encoding="utf-8").splitlines()
    assert header.startswith("run,solar.flux,spacecraft.centerOfMass[3],") and len(rows) == RUNS
    same = subprocess.run([heliotorque, "compare", alone, output, "--tolerance", "0"], capture_output=True, text=True)
    assert same.returncode == 0 and "no difference" in same.stdout, same.stdout
    for suffix in ("", ".toml"):
        os.replace(f"{output}{suffix}", f"{output}.part{suffix}")
    os.truncate(f"{output}.part", alone.stat().st_size // 2)
    subprocess.run([heliotorque, "sweep", campaign, "--output", output, "--resume"], check=True)
    assert output.read_bytes() == alone.read_bytes()
    folder = tmp_path / "jobs"
    folder.mkdir()
    program = tmp_path / "bin" / "heliotorque"
    program.parent.mkdir()
    program.symlink_to(heliotorque.resolve())
    for piece in range(3):
        done = slurm(folder, program, campaign, piece, 3)
        assert done.returncode == 0, done.stderr
    assert joined_as_told(folder) == alone.read_bytes()
