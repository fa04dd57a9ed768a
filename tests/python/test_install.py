"""An installed program works in any folder; xtask works on the checkout that it is started in."""

import os
import pathlib
import shutil
import subprocess

import pytest

from spacecraft import RESOURCES

ROOT = pathlib.Path(__file__).resolve().parents[2]


def cleared(**more):
    """This environment without what the tests set, and without where cargo was started."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("HELIOTORQUE", "CARGO_MANIFEST"))}
    return kept | more


def xtask(heliotorque, *arguments, folder, **environment):
    program = heliotorque.resolve().with_name("xtask")
    if not program.exists():
        (pytest.fail if os.environ.get("CI") else pytest.skip)("xtask is not built: run `cargo xtask test`")
    return subprocess.run(
        [program, *map(str, arguments)], cwd=folder, capture_output=True, text=True, env=cleared(**environment)
    )


WHOLE = pytest.param([], marks=[pytest.mark.long, pytest.mark.rebuilds])


@pytest.mark.parametrize("options", [["--built"], WHOLE], ids=["built", "whole"])
def test_an_installed_program_works_anywhere(heliotorque, tmp_path, options):
    prefix, folder = tmp_path / "prefix", tmp_path / "empty"
    folder.mkdir()
    installed = xtask(heliotorque, "install", *options, "--prefix", prefix, folder=ROOT)
    assert installed.returncode == 0, installed.stderr
    assert f"{prefix / 'bin'} is not on PATH" in installed.stderr and "export PATH=" in installed.stderr
    shared = prefix / "lib" / "heliotorque"
    listed = {line for line in installed.stdout.splitlines() if line.startswith(str(prefix))}
    page = prefix / "share" / "man" / "man1" / "heliotorque-run.1"
    assert {str(prefix / "bin" / "heliotorque"), str(shared / "SpinPlant.fmu"), str(page)} <= listed
    assert "heliotorque run" in page.read_text(encoding="utf-8")
    assert listed == {str(path) for path in prefix.rglob("*") if path.is_file()}

    def run(*arguments):
        return subprocess.run(
            ["heliotorque", *arguments],
            cwd=folder,
            capture_output=True,
            text=True,
            env={"PATH": f"{prefix / 'bin'}:/usr/bin:/bin"},
        )

    shutil.copy(RESOURCES / "ace.toml", folder / "my.toml")
    for arguments, expected in [
        (("check", "my.toml"), "ok for SpinPlant"),
        (("pack", "--spacecraft", "my.toml", "--name", "My"), "My.fmu: My, "),
        (("check", "My.fmu", "--static"), "0 failed"),
        (("plan", "spin", "--output", "turn"), f"Re-simulated through {shared / 'SpinPlant.fmu'}"),
    ]:
        ran = run(*arguments)
        assert ran.returncode == 0 and expected in ran.stdout, (arguments, ran.stdout, ran.stderr)
    # Results are left here, not beside the program.
    assert (folder / "turn" / "burn.csv").exists()
    assert listed == {str(path) for path in prefix.rglob("*") if path.is_file()}


@pytest.mark.parametrize("arguments", [["--prefix"], ["--prefix="], ["--to", "x"], ["--prefix", "x", "y"]])
def test_install_says_what_it_takes(heliotorque, arguments):
    refused = xtask(heliotorque, "install", *arguments, folder=ROOT)
    assert refused.returncode == 1 and "--prefix FOLDER" in refused.stderr


def test_xtask_works_on_the_checkout_it_is_started_in(heliotorque, tmp_path):
    copy = tmp_path / "copy"
    left_out = shutil.ignore_patterns("target", "dist", ".git", "corpus")
    shutil.copytree(ROOT, copy, ignore=left_out)
    notices = pathlib.Path("fmu-src") / "component" / "THIRD-PARTY.txt"
    expected, before = (ROOT / notices).read_text(encoding="utf-8"), (ROOT / notices).stat().st_mtime_ns
    # From its root, from within, and as cargo starts it.
    for folder, environment in [
        (copy, {}),
        (copy / "harness" / "cli", {}),
        (tmp_path, {"CARGO_MANIFEST_DIR": str(copy / "xtask")}),
    ]:
        (copy / notices).unlink()
        made = xtask(heliotorque, "notices", folder=folder, **environment)
        assert made.returncode == 0, made.stderr
        assert (copy / notices).read_text(encoding="utf-8") == expected
    assert (ROOT / notices).stat().st_mtime_ns == before
