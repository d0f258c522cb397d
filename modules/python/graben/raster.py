"""Heights of a mesh on a regular grid."""

from dataclasses import dataclass

import numpy as np

from .data import Mesh


@dataclass(frozen=True)
class Grid:
    """A regular grid in the map.

    Attributes
    ----------
    x0, y0 : float
        Of the first node.
    spacing : float
        Between nodes, the same along x and y.
    columns, rows : int
        Nodes along x and y.
    """

    x0: float
    y0: float
    spacing: float
    columns: int
    rows: int

    @property
    def shape(self):
        return (self.columns, self.rows)

    @classmethod
    def over(cls, mesh: Mesh, spacing: float) -> "Grid":
        """The grid of nodes at whole multiples of the spacing that a mesh lies over."""
        low = np.floor(mesh.vertices[:, :2].min(axis=0) / spacing)
        high = np.ceil(mesh.vertices[:, :2].max(axis=0) / spacing)
        columns, rows = (high - low).astype(int) + 1
        return cls(low[0] * spacing, low[1] * spacing, spacing, int(columns), int(rows))


def median_edge(mesh: Mesh) -> float:
    corners = mesh.vertices[mesh.triangles]
    return float(np.median(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)))


def heights(mesh: Mesh, grid: Grid) -> np.ndarray:
    """z at the nodes, shape (columns, rows), NaN where the mesh is not; where it lies over itself, that of the upper sheet."""
    places = (mesh.vertices[:, :2] - (grid.x0, grid.y0)) / grid.spacing
    a, b, c = (places[mesh.triangles[:, i]] for i in range(3))
    low = np.maximum(np.ceil(np.minimum(np.minimum(a, b), c) - 1e-9).astype(int), 0)
    high = np.minimum(np.floor(np.maximum(np.maximum(a, b), c) + 1e-9).astype(int), np.array(grid.shape) - 1)
    extent = np.maximum(high - low + 1, 0)
    count = extent.prod(axis=1)
    triangle = np.repeat(np.arange(len(count)), count)
    number = np.arange(len(triangle)) - np.repeat(np.cumsum(count) - count, count)
    width = extent[triangle, 0]
    node = low[triangle] + np.stack((number % np.maximum(width, 1), number // np.maximum(width, 1)), axis=1)
    weights = _weights(node, a[triangle], b[triangle], c[triangle])
    inside = (weights >= -1e-9).all(axis=1)
    z = (mesh.vertices[:, 2][mesh.triangles[triangle[inside]]] * weights[inside]).sum(axis=1)
    downward = mesh.z_positive == "down"
    surface = np.full(grid.shape, np.inf if downward else -np.inf)
    (np.minimum if downward else np.maximum).at(surface, tuple(node[inside].T), z)
    return np.where(np.isfinite(surface), surface, np.nan)


def _weights(p: np.ndarray, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Barycentric coordinates in the map; NaN in a triangle that is upright."""

    def area(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]

    with np.errstate(divide="ignore", invalid="ignore"):
        whole = area(b - a, c - a)
        wb = area(p - a, c - a) / whole
        wc = area(b - a, p - a) / whole
    return np.stack((1.0 - wb - wc, wb, wc), axis=1)
