"""The program heliotorque and its FMUs, as paths."""

import os
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

__version__ = version("heliotorque")

_FOLDER = Path(__file__).resolve().parent
_FILES = _FOLDER / "lib" / "heliotorque"


def program():
    """The path of the program."""
    return str(_FOLDER / "bin" / ("heliotorque.exe" if os.name == "nt" else "heliotorque"))


def fmu(name):
    """The path of a shipped FMU, such as "MomentumPlant"."""
    path = _FILES / f"{name}.fmu"
    if not path.is_file():
        names = ", ".join(sorted(other.stem for other in _FILES.glob("*.fmu")))
        raise ValueError(f"found the unknown name {name!r}, allowed: {names}")
    return str(path)


def main():
    """The command heliotorque."""
    command = [program(), *sys.argv[1:]]
    if os.name != "nt":
        os.execv(command[0], ["heliotorque", *command[1:]])
    with subprocess.Popen(command) as child:
        while True:
            try:
                sys.exit(child.wait())
            except KeyboardInterrupt:
                # The program got it too, and ends in its own way.
                pass
