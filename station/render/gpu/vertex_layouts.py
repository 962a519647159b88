"""The corners of kit and figure as tables for OpenGL, and where the programs find what in them.

Normals and tangents are half floats; the fourth of a normal tells how freely a head's corner moves. Weights and `ao`
are 255ths.
"""

import numpy as np
from numpy.typing import NDArray

from station.render.figure.skin import Skin
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh

RIGID_DTYPE = np.dtype(
    [
        ("position", np.float32, 3),
        ("normal", np.float16, 4),
        ("tangent", np.float16, 4),
        ("bone", np.uint8),
        ("material", np.uint8),
        ("ao", np.uint8),
        ("pad", np.uint8),
    ]
)
SKIN_DTYPE = np.dtype(
    [
        ("position", np.float32, 3),
        ("normal", np.float16, 4),
        ("bones", np.uint8, 4),
        ("weights", np.uint8, 4),
        ("material", np.uint8),
        ("ao", np.uint8),
        ("pad", np.uint8, 2),
    ]
)
RIGID = ("3f 4f2 4f2 1i1 1i1 1f1 1x1", "position", "normal", "tangent", "bone", "material", "ao")
SKIN = ("3f 4f2 4i1 4f1 1i1 1f1 2x1", "position", "normal", "bones", "weights", "material", "ao")
RIGID_PLACES = ("3f 16x1 1i1 3x1", "position", "bone")
SKIN_PLACES = ("3f 8x1 4i1 4f1 4x1", "position", "bones", "weights")
"""Layout and names, as moderngl takes them: whole corners, and where they are alone."""


def rigid_rows(mesh: Mesh) -> NDArray[np.void]:
    """The corners of what is rigid, (n,) of `RIGID_DTYPE`."""
    rows = np.zeros(len(mesh.position), RIGID_DTYPE)
    rows["position"] = mesh.position
    rows["normal"][:, :3], rows["normal"][:, 3] = mesh.normal, _gives(mesh)
    rows["tangent"][:, :3] = mesh.tangent
    rows["bone"], rows["material"] = mesh.bone, mesh.material
    rows["ao"] = np.rint(np.clip(mesh.ao, 0, 1) * 255)
    return rows


_HEADS = (Material.HEAD, Material.MESH_HEAD)


def _gives(mesh: Mesh) -> NDArray[np.float64]:
    """How freely each corner moves when its head is struck: 1 in the middle, 0 at the hoop and off the heads, (n,).

    Heads are lathes, whose first uv is the distance from their middle.
    """
    gives = np.zeros(len(mesh.position))
    heads = np.isin(mesh.material, _HEADS)
    for bone in np.unique(mesh.bone[heads]):
        its = heads & (mesh.bone == bone)
        far = mesh.uv[its, 0]
        gives[its] = 1.0 - (far / far.max()) ** 2
    return gives


def skin_rows(skin: Skin) -> NDArray[np.void]:
    """The corners of the figure, (n,) of `SKIN_DTYPE`."""
    rows = np.zeros(len(skin.position), SKIN_DTYPE)
    rows["position"], rows["material"] = skin.position, skin.material
    rows["normal"][:, :3] = skin.normal
    rows["bones"] = skin.bones
    rows["weights"] = _shares(skin.weights)
    rows["ao"] = np.rint(skin.ao * 255)
    return rows


def _shares(weights: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Weights as 255ths that sum to 255 exactly, so that no corner is pulled towards the origin."""
    parts = np.rint(weights * 255)
    parts[:, 0] += 255 - parts.sum(axis=1)
    return parts.astype(np.uint8)
