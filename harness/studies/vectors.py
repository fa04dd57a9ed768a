"""Vectors and attitudes, one row a point. A quaternion (x, y, z, w) is passive from inertial to body, as the FMUs have it."""

import numpy as np


def to_inertial(q, vectors):
    """Body vectors in inertial components."""
    q, vectors = np.asarray(q), np.asarray(vectors)
    twice = 2.0 * np.cross(q[..., :3], vectors)
    return twice * q[..., 3:] + np.cross(q[..., :3], twice) + vectors


def to_body(q, vectors):
    """Inertial vectors in body components."""
    return to_inertial(q * np.array([-1.0, -1.0, -1.0, 1.0]), vectors)


def product(q, p):
    """The attitudes of a body that is turned by p as seen from a body that is turned by q."""
    (a, b, c, d), (x, y, z, w) = np.moveaxis(np.asarray(q), -1, 0), np.moveaxis(np.asarray(p), -1, 0)
    return np.stack(
        [
            d * x + a * w + b * z - c * y,
            d * y - a * z + b * w + c * x,
            d * z + a * y - b * x + c * w,
            d * w - a * x - b * y - c * z,
        ],
        axis=-1,
    )


def turned(q, rotation_rad):
    """The attitudes after right-handed turns about body axes, as rotation vectors."""
    half = 0.5 * np.asarray(rotation_rad)
    size = norm(half)[..., None]
    vector = half * np.divide(np.sin(size), size, out=np.ones_like(size), where=size > 0.0)
    return product(q, np.concatenate([vector, np.cos(size)], axis=-1))


def rotation_rad(q, p):
    """The rotation vectors of the turns from attitudes q to p, body frame."""
    vector, scalar = np.split(product(q * np.array([-1.0, -1.0, -1.0, 1.0]), p), [3], axis=-1)
    size = norm(vector)[..., None]
    angle = 2.0 * np.arctan2(size, np.abs(scalar)) * np.where(scalar < 0.0, -1.0, 1.0)
    return vector * np.divide(angle, size, out=np.zeros_like(size), where=size > 0.0)


def turn_rad(q, p):
    """The angles between attitudes."""
    return norm(rotation_rad(q, p))


def norm(vectors):
    """Lengths of vectors."""
    return np.linalg.norm(vectors, axis=-1)


def angle_rad(a, b):
    """Angles between vectors, exact where they are small."""
    return np.arctan2(norm(np.cross(a, b)), np.einsum("...i,...i->...", a, b))


def across(vectors, axis):
    """The parts of vectors across a unit vector."""
    return vectors - axis * np.einsum("...i,...i->...", vectors, axis)[..., None]


def unit(vectors):
    """Vectors of length one."""
    return vectors / norm(vectors)[..., None]


def body_angles_deg(directions):
    """Azimuths from -Y toward +X and elevations toward -Z of body directions; azimuths from -90 to 270 deg, so that neither -Y
    nor +Y is at a jump."""
    x, y, z = np.moveaxis(directions, -1, 0)
    azimuth_deg = np.degrees(np.arctan2(x, -y))
    azimuth_deg = azimuth_deg + np.where(azimuth_deg < -90.0, 360.0, 0.0)
    return np.stack([azimuth_deg, np.degrees(np.arctan2(-z, np.hypot(x, y)))], axis=-1)


def body_direction(azimuth_rad, elevation_rad):
    """The body directions of azimuths and elevations."""
    level = np.cos(elevation_rad)
    return np.stack([level * np.sin(azimuth_rad), -level * np.cos(azimuth_rad), -np.sin(elevation_rad)], axis=-1)
