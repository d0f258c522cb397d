"""What goes in and comes out: picks, faults, meshes."""

from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from . import _core, checks


@dataclass(eq=False)
class Picks:
    """The picks of a horizon, and what is known of them. numpy takes it for an array: numpy.asarray(picks) is points.

    Attributes
    ----------
    points : (n, 3) float64
        x, y, z in the user's frame; x and y in one unit, z in its own.
    normals : (n, 3) float64 or None
        As the file has them.
    z_positive : 'up', 'down' or 'auto'
        Which way z grows: elevation is up, depth and time are down; 'auto': it is not known, which counts as up.
    xy_unit, z_unit : str
        'm', 'ft', 'km', 'ms', 's' as the file names them; empty where it does not.
    source, horizon : str
        The file, and the name of the horizon in it.
    notes, warnings : list of str
        What was ignored, dropped or assumed; what is probably not as it was meant.
    """

    points: np.ndarray
    z_positive: str = "auto"
    normals: Optional[np.ndarray] = None
    xy_unit: str = ""
    z_unit: str = ""
    source: str = "picks"
    horizon: str = ""
    notes: List[str] = field(default_factory=list)
    warnings: List[str] = field(default_factory=list)
    z_reason: str = ""

    def __post_init__(self) -> None:
        self.points = checks.points("picks", self.points)
        self.z_positive = checks.way("z_positive", self.z_positive)
        if self.normals is not None:
            self.normals = checks.unit_normals("normals", self.normals, len(self.points))

    def __len__(self) -> int:
        return len(self.points)

    def __array__(self, dtype: Any = None) -> np.ndarray:
        return np.asarray(self.points, dtype=dtype)

    def __repr__(self) -> str:
        return f"<graben.Picks: {len(self)} from {self.source}, z {self.z_positive}>"


@dataclass(eq=False)
class Mesh:
    """A triangle mesh in the user's frame. numpy takes it for an array: numpy.asarray(mesh) is vertices.

    Attributes
    ----------
    vertices : (n, 3) float64
    triangles : (m, 3) int32
        Indices of vertices, counter-clockwise seen from above.
    normals : (n, 3) float64 or None
        Unit vertex normals.
    pieces : (n,) int32 or None
        The piece each vertex belongs to, from 0.
    fields : dict of (n,) float32
        Further values of the vertices, by name.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    normals: Optional[np.ndarray] = None
    pieces: Optional[np.ndarray] = None
    fields: Dict[str, np.ndarray] = field(default_factory=dict)
    name: str = "surface"
    z_positive: str = "auto"
    notes: List[str] = field(default_factory=list)
    warnings: List[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.vertices = checks.points("vertices", self.vertices, least=0)
        count = len(self.vertices)
        self.triangles = checks.triangles("triangles", self.triangles, count)
        if self.normals is not None:
            self.normals = checks.unit_normals("normals", self.normals, count)
        if self.pieces is not None:
            self.pieces = checks.values("pieces", self.pieces, count, np.int32)
        self.fields = {name: checks.values(f"fields[{name!r}]", values, count, np.float32) for name, values in self.fields.items()}
        self.z_positive = checks.way("z_positive", self.z_positive)

    def __len__(self) -> int:
        return len(self.vertices)

    def __array__(self, dtype: Any = None) -> np.ndarray:
        return np.asarray(self.vertices, dtype=dtype)

    def __repr__(self) -> str:
        return f"<graben.{type(self).__name__} {self.name!r}: {len(self.triangles)} triangles, {len(self.vertices)} vertices>"

    @property
    def bounds(self) -> Tuple[float, float, float, float, float, float]:
        """Least and largest x, y and z: (x0, x1, y0, y1, z0, z1)."""
        low, high = self.vertices.min(axis=0), self.vertices.max(axis=0)
        return (low[0], high[0], low[1], high[1], low[2], high[2])

    def write(self, path: Any) -> List[str]:
        """Writes the mesh; the extension says how: .ply .vtk .vtp .obj .stl .ts. See graben.write."""
        from .files import write

        return write(path, self)

    def to_pyvista(self) -> Any:
        """The mesh as a pyvista.PolyData with pieces, normals and fields as point data; needs pyvista."""
        from .exchange import to_pyvista

        return to_pyvista(self)

    def to_xtgeo(self, spacing: Optional[float] = None) -> Any:
        """Heights on a regular grid as an xtgeo.RegularSurface; needs xtgeo.

        Parameters
        ----------
        spacing : float, x, y units
            Between the nodes of the grid; None: the median edge of the mesh. A grid holds one height at a place: where the horizon lies over itself, at a
            reverse fault, that of the upper sheet; in the gap of a normal fault the node is masked.
        """
        from .exchange import to_xtgeo

        return to_xtgeo(self, spacing)

    def _core_mesh(self) -> Dict[str, Any]:
        return {"vertices": self.vertices, "triangles": self.triangles, "normals": self.normals, "pieces": self.pieces, "fields": self.fields}


def mesh_from_core(d: Dict[str, Any], name: str = "surface", z_positive: str = "auto") -> Mesh:
    return Mesh(d["vertices"], d["triangles"], d["normals"], d["pieces"], d["fields"], d.get("name", name), d.get("z_positive", z_positive),
                d.get("notes", []), d.get("warnings", []))


@dataclass(eq=False)
class Fault:
    """A fault that cuts the horizon: a mesh, or sticks that are made a surface of.

    Attributes
    ----------
    name : str
    mesh : Mesh or None
    sticks : list of (k, 3) float64, or None
        Polylines down the fault, as digitised on sections; in any order and direction.
    z_positive : 'up', 'down' or 'auto'
        'auto': as the picks'.
    source, notes, warnings
        As in Picks.
    """

    name: str
    mesh: Optional[Mesh] = None
    sticks: Optional[List[np.ndarray]] = None
    z_positive: str = "auto"
    source: str = "faults"
    notes: List[str] = field(default_factory=list)
    warnings: List[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        if (self.mesh is None) == (self.sticks is None):
            raise ValueError(f"fault {self.name!r}: either a mesh or sticks were expected")
        if self.sticks is not None:
            self.sticks = [checks.points(f"fault {self.name!r}, stick {i}", stick) for i, stick in enumerate(self.sticks)]
            if not self.sticks:
                raise ValueError(f"fault {self.name!r}: sticks was expected to hold a stick or more, but is empty")
        self.z_positive = checks.way("z_positive", self.z_positive)

    def __repr__(self) -> str:
        what = f"{len(self.sticks)} sticks" if self.sticks is not None else f"{len(self.mesh.triangles)} triangles"
        return f"<graben.Fault {self.name!r}: {what}>"

    def _core_fault(self) -> Dict[str, Any]:
        return {"name": self.name, "mesh": None if self.mesh is None else self.mesh._core_mesh(), "sticks": self.sticks, "z_positive": self.z_positive,
                "source": self.source, "notes": self.notes, "warnings": self.warnings}


def fault_from_core(d: Dict[str, Any]) -> Fault:
    mesh = None if d["mesh"] is None else mesh_from_core(d["mesh"], d["name"])
    return Fault(d["name"], mesh, d["sticks"], d["z_positive"], d["source"], d["notes"], d["warnings"])


version: str = _core.version
