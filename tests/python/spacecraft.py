"""Spacecraft of our own: writing, packing and the flat-plate law summed in plain numpy."""

import functools
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
    return solar_loads(text, sun, pressure, angles)[1]


def solar_loads(text, sun, pressure, angles=(), center_of_mass=None):
    """Force, torque about the centre of mass, and the sum of the faces' forces without their directions."""
    if center_of_mass is None:
        center_of_mass = tomllib.loads(text)["mass_properties"]["center_of_mass_m"]
    force, torque, size = np.zeros(3), np.zeros(3), 0.0
    for area, center, normal, specular, diffuse in _faces(text, tuple(angles)):
        cosine = normal @ sun
        if cosine > 0.0:
            push = (1.0 - specular) * sun + 2.0 * (specular * cosine + diffuse / 3.0) * normal
            push *= -pressure * area * cosine
            force, torque = force + push, torque + np.cross(center - np.array(center_of_mass), push)
            size += np.linalg.norm(push)
    return force, torque, size


@functools.cache
def _faces(text, angles):
    """Area, centre, outward normal, specular and diffuse share of every face of plates and panels, fronts and backs."""
    spacecraft = tomllib.loads(text)
    placed = [(plate, np.array(plate["normal"], dtype=float), np.eye(3)) for plate in spacecraft.get("plates", [])]
    for panel, angle in zip(spacecraft.get("panels", []), angles, strict=True):
        axis, zero = np.array(panel["axis"], dtype=float), np.array(panel["zero_normal"], dtype=float)
        turn = _turn(*np.radians(panel.get("rotation_deg", [0.0, 0.0, 0.0])))
        placed.append((panel, turn @ (np.cos(angle) * zero + np.sin(angle) * np.cross(axis, zero)), turn))
    faces = []
    for surface, normal, turn in placed:
        area, center = _outlined(surface) if "polygon_m" in surface else (None, None)
        area, center = surface.get("area_m2", area), turn @ np.array(surface.get("center_m", center), dtype=float)
        for side, key in ((1.0, "optics"), (-1.0, "rear_optics")):
            if key in surface:
                optics = spacecraft["optics"][surface[key]]
                faces.append((area, center, side * normal / np.linalg.norm(normal), optics["specular"], optics["diffuse"]))
    return faces


def _outlined(surface):
    """Area and centre of a flat outline."""
    corners = np.array(surface["polygon_m"])
    parts = [(corners[0], a, b) for a, b in zip(corners[1:], corners[2:])]
    vectors = [np.cross(a - o, b - o) / 2.0 for o, a, b in parts]
    whole = sum(vectors)
    area = np.linalg.norm(whole)
    weights = [vector @ whole / area for vector in vectors]
    return area, sum(w * (o + a + b) / 3.0 for w, (o, a, b) in zip(weights, parts)) / area


def _turn(x, y, z):
    """Turns about X, then Y, then Z."""
    def about(axis, angle):
        u, v = [(1, 2), (2, 0), (0, 1)][axis]
        matrix = np.eye(3)
        matrix[u, u] = matrix[v, v] = np.cos(angle)
        matrix[u, v], matrix[v, u] = -np.sin(angle), np.sin(angle)
        return matrix

    return about(2, z) @ about(1, y) @ about(0, x)
