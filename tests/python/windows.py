"""The Windows build under Wine: its program, its FMUs, hostile FMUs built by mingw."""

import os
import pathlib
import re
import shutil
import subprocess
import time
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOSTILE = ROOT / "harness" / "cli" / "tests" / "hostile"
COMPILER = "x86_64-w64-mingw32-gcc"
# Neither .NET nor a browser is offered, and nothing is shown.
QUIET = {"WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml=", "DISPLAY": ""}
# Far beyond what any command of the tests takes.
LONG_S = 300


def path(file):
    """A file of this computer as Wine's programs see it."""
    return "Z:" + str(pathlib.Path(file).resolve()).replace("/", "\\")


def share(folder):
    """A folder as another computer's, by the link that Wine looks for such names at."""
    link = pathlib.Path(os.environ["WINEPREFIX"]) / "dosdevices" / "unc" / "server" / "share"
    link.parent.mkdir(parents=True, exist_ok=True)
    link.unlink(missing_ok=True)
    link.symlink_to(folder)
    return "\\\\server\\share"


class Program:
    """heliotorque.exe under Wine."""

    def __init__(self, folder):
        self.program = folder / "heliotorque.exe"

    def start(self, *arguments, program=None, **more):
        streams = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | more
        words = ["wine", str(program or self.program), *map(str, arguments)]
        return subprocess.Popen(words, env=os.environ | QUIET, **streams)

    def call(self, *arguments, **more):
        """Runs it to its end: status, and what it printed."""
        child = self.start(*arguments, stdin=subprocess.DEVNULL, **more)
        try:
            out, err = child.communicate(timeout=LONG_S)
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            raise
        text = (out or b"") + (err or b"")
        return child.returncode, text.decode("utf-8", "replace").replace("\r\n", "\n")

    def good(self, *arguments, **more):
        """What it printed; it must have succeeded."""
        status, text = self.call(*arguments, **more)
        assert status == 0, text
        return text

    def bad(self, *arguments, **more):
        """What it printed; it must have failed as a program does that found a fault."""
        status, text = self.call(*arguments, **more)
        assert status in (1, 2), f"{status}: {text}"
        return text


def with_windows_library(fmu, library, to):
    """A copy of an FMU with the library of Windows, unless it has one."""
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
        identifier = re.search(rb'modelIdentifier="([^"]+)"', archive.read("modelDescription.xml")).group(1).decode()
    shutil.copy(fmu, to)
    entry = f"binaries/win64/{identifier}.dll"
    if entry not in names:
        with zipfile.ZipFile(to, "a", zipfile.ZIP_DEFLATED) as archive:
            archive.write(library, entry)
    return to


def hostile(folder, behaviour, place):
    """An unpacked FMU that does this behaviour at this place."""
    binaries = folder / "fmu" / "binaries" / "win64"
    binaries.mkdir(parents=True)
    shutil.copy(HOSTILE / "modelDescription.xml", folder / "fmu")
    compile_c(HOSTILE / "hostile.c", binaries / "Hostile.dll", "-shared", f"-DBEHAVIOUR={behaviour}", f"-D{place}")
    return folder / "fmu"


def compile_c(source, to, *flags):
    subprocess.run([COMPILER, "-std=gnu11", "-O0", "-w", *flags, source, "-o", to], check=True)
    return to


def processes(folder):
    """Processes of this computer, no zombies, whose arguments name this folder of Windows."""
    def names_it(number):
        try:
            return path(folder).encode() in pathlib.Path(f"/proc/{number}/cmdline").read_bytes()
        except OSError:
            return False

    return [int(entry) for entry in os.listdir("/proc") if entry.isdigit() and names_it(entry)]


def temporaries():
    """Temporary folders of the program, where Wine's registry has them whatever the environment says."""
    users = pathlib.Path(os.environ["WINEPREFIX"]) / "drive_c" / "users"
    return [found for folder in ("Temp", "AppData/Local/Temp") for found in users.glob(f"*/{folder}/heliotorque-*")]


def until(is_so, seconds=60.0):
    """Waits until something is so."""
    end = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < end, "it does not come to that"
        time.sleep(0.01)

