"""Spacecraft of our own: writing, packing and the flat-plate law summed in plain numpy."""

import pathlib
import subprocess
import tomllib

import numpy as np

RESOURCES = pathlib.Path(__file__).resolve().parents[2] / "fmu-src" / "resources"
SAILER = (RESOURCES / "examples" / "solar-sailer.toml").read_text(encoding="utf-8")

HEAD = """\
name = "{name}"

[mass_properties]
mass_kg = 120
center_of_mass_m = [0.02, -0.01, 0.03]
inertia_kg_m2 = [[30, 0, 0], [0, 40, 0], [0, 0, 50]]

[optics.paint]
specular = 0.1
diffuse = 0.4
"""


def call(heliotorque, *arguments, folder=None):
    """Runs the command line; text out, status kept."""
    arguments = [str(heliotorque.resolve()), *map(str, arguments)]
    return subprocess.run(arguments, cwd=folder, capture_output=True, text=True, encoding="utf-8")


def pack(heliotorque, dist, folder, text, name, template="MomentumPlant.fmu"):
    """An FMU of this name from a TOML text and a shipped FMU, by the command a user would give."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.toml").write_text(text, encoding="utf-8")
    template = (dist / template).resolve()
    packed = call(
        heliotorque, "pack", "--spacecraft", f"{name}.toml", "--template", template, "--name", name, folder=folder
    )
    assert packed.returncode == 0, packed.stderr
    return str(folder / f"{name}.fmu")


def urchin(plates):
    """A closed-looking body of many plates, each with a normal of its own; no panel, no wheel, no shade."""
    lines = [HEAD.format(name="Urchin")]
    for k in range(plates):
        z = 1.0 - (2 * k + 1) / plates
        azimuth, rho = 2.399963229728653 * k, np.sqrt(1.0 - z * z)
        normal = [rho * np.cos(azimuth), rho * np.sin(azimuth), z]
        # Centres off the normals' line through the centre of mass, or there would be no torque.
        center = [0.6 * normal[0] + 0.2 * normal[1], 0.7 * normal[1], 0.5 * normal[2] - 0.1 * normal[0]]
        lines.append(
            f"[[plates]]\narea_m2 = {0.05 + 0.001 * k}\ncenter_m = {list(map(float, center))}\n"
            f"normal = {list(map(float, normal))}\noptics = \"paint\"\n"
        )
    return "\n".join(lines)


def solar_torque(text, sun, pressure, angles=()):
    """Torque about the centre of mass: the flat-plate law over every face of the file (paper 000, eq 1)."""
    spacecraft = tomllib.loads(text)
    center_of_mass = np.array(spacecraft["mass_properties"]["center_of_mass_m"], dtype=float)
    faces = [(p, np.array(p["normal"], dtype=float), np.array(p["center_m"], dtype=float)) for p in spacecraft.get("plates", [])]
    for panel, angle in zip(spacecraft.get("panels", []), angles, strict=True):
        turn = _turn(*np.radians(panel.get("rotation_deg", [0.0, 0.0, 0.0])))
        axis, zero = np.array(panel["axis"], dtype=float), np.array(panel["zero_normal"], dtype=float)
        normal = np.cos(angle) * zero + np.sin(angle) * np.cross(axis, zero)
        faces.append((panel, turn @ normal, turn @ np.array(panel["center_m"], dtype=float)))
    torque = np.zeros(3)
    for face, normal, center in faces:
        normal = normal / np.linalg.norm(normal)
        for side, key in ((normal, "optics"), (-normal, "rear_optics")):
            cosine = side @ sun
            if cosine <= 0.0 or key not in face:
                continue
            optics = spacecraft["optics"][face[key]]
            specular, diffuse = optics["specular"], optics["diffuse"]
            force = (1.0 - specular) * sun + 2.0 * (specular * cosine + diffuse / 3.0) * side
            torque += np.cross(center - center_of_mass, -pressure * face["area_m2"] * cosine * force)
    return torque


def _turn(x, y, z):
    """Turns about X, then Y, then Z."""
    def about(axis, angle):
        u, v = [(1, 2), (2, 0), (0, 1)][axis]
        matrix = np.eye(3)
        matrix[u, u] = matrix[v, v] = np.cos(angle)
        matrix[u, v], matrix[v, u] = -np.sin(angle), np.sin(angle)
        return matrix

    return about(2, z) @ about(1, y) @ about(0, x)
