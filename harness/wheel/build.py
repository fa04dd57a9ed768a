"""Writes a wheel (PyPA's binary distribution format 1.0): build.py FOLDER VERSION TAG OUTPUT

FOLDER holds the package; TAG is the platform's. The same files give the same wheel, byte for byte.
"""

import base64
import hashlib
import sys
import zipfile
from pathlib import Path

METADATA = """\
Metadata-Version: 2.1
Name: heliotorque
Version: {version}
Summary: Spacecraft disturbance torque and angular momentum as FMUs, with their command line
License: MIT OR Apache-2.0
Requires-Python: >=3.8
"""
WHEEL = """\
Wheel-Version: 1.0
Generator: heliotorque
Root-Is-Purelib: false
Tag: py3-none-{tag}
"""
ENTRY_POINTS = """\
[console_scripts]
heliotorque = heliotorque:main
"""


def entry(path, is_program=False):
    info = zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0))
    info.compress_type = zipfile.ZIP_DEFLATED
    info.external_attr = (0o100755 if is_program else 0o100644) << 16
    return info


def main(folder, version, tag, output):
    folder, about = Path(folder), f"heliotorque-{version}.dist-info"
    files = sorted(path for path in folder.rglob("*") if path.is_file() and "__pycache__" not in path.parts)
    entries = [(entry(path.relative_to(folder).as_posix(), path.parent.name == "bin"), path.read_bytes()) for path in files]
    texts = {"METADATA": METADATA.format(version=version), "WHEEL": WHEEL.format(tag=tag), "entry_points.txt": ENTRY_POINTS}
    entries += [(entry(f"{about}/{name}"), text.encode()) for name, text in texts.items()]
    record = ""
    with zipfile.ZipFile(Path(output) / f"heliotorque-{version}-py3-none-{tag}.whl", "w") as wheel:
        for info, content in entries:
            wheel.writestr(info, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
            record += f"{info.filename},sha256={digest},{len(content)}\n"
        wheel.writestr(entry(f"{about}/RECORD"), record + f"{about}/RECORD,,\n")


main(*sys.argv[1:])
