"""Reading and writing files, and everything that may stand for picks, faults and meshes."""

import os
from typing import Any, Callable, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core, checks
from .data import Fault, Mesh, Picks, fault_from_core, mesh_from_core
from .options import words

Progress = Optional[Callable[[str, float], None]]


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, os.PathLike))


def read_picks(path: Union[str, "os.PathLike[str]"], *, horizon: Optional[str] = None, columns: Optional[Sequence[Union[str, int]]] = None,
               null: Optional[Sequence[Union[str, float]]] = None, threads: int = 0, progress: Progress = None) -> Picks:
    """Reads the picks of a horizon from any file that graben_reconstruct reads: .xyz .txt .csv .poi .pcd .ply .vs, grids and others.

    Parameters
    ----------
    path : path
        'FILE:NAME' for one of several horizons in a file.
    horizon : str
        The same name as an argument of its own.
    columns : three names or numbers from 1
        Which columns of a text table hold x, y and z; None: found by header and content.
    null : values
        Of z that stand for no data, beside those that are recognised; 'none': none is recognised.
    threads : int
        0: one per processor. The result does not depend on it.
    progress : callable of (stage, fraction)

    Raises
    ------
    graben.FileError
        The file cannot be read, or a row of it; see its attributes file and row.
    """
    said = words({"columns": None if columns is None else list(columns), "null": null}, lists=("null",))
    d = _core.read_picks(os.fspath(path), horizon or "", said, threads, progress)
    return Picks(d["points"], d["z_positive"], d["normals"], d["xy_unit"], d["z_unit"], d["source"], d["horizon"], d["notes"], d["warnings"], d["z_reason"])


def read_faults(path: Union[str, "os.PathLike[str]"]) -> List[Fault]:
    """Reads the faults of a file: surfaces .ts .ply .obj .stl .vtp .vtk, or sticks .pol .pl and the tables that interpretation programs write.

    Raises graben.FileError, with the attributes file and row.
    """
    return [fault_from_core(d) for d in _core.read_faults(os.fspath(path))]


def read_mesh(path: Union[str, "os.PathLike[str]"]) -> Mesh:
    """Reads a triangle mesh: .ply .vtk .vtp .vtu .vts .obj .stl .ts. Several objects of a GOCAD file become one mesh, a piece each.

    Raises graben.FileError, with the attributes file and row.
    """
    parts = [mesh_from_core(d) for d in _core.read_meshes(os.fspath(path))]
    if len(parts) == 1:
        return parts[0]
    offsets = np.cumsum([0] + [len(part) for part in parts[:-1]])
    shared = set(parts[0].fields).intersection(*(part.fields for part in parts[1:]))
    return Mesh(np.concatenate([part.vertices for part in parts]), np.concatenate([part.triangles + offset for part, offset in zip(parts, offsets)]),
                pieces=np.repeat(np.arange(len(parts)), [len(part) for part in parts]),
                fields={name: np.concatenate([part.fields[name] for part in parts]) for name in sorted(shared)}, name=parts[0].name,
                z_positive=parts[0].z_positive, notes=[note for part in parts for note in part.notes])


def write(path: Union[str, "os.PathLike[str]"], mesh: Any) -> List[str]:
    """Writes a mesh, a horizon or a model; the extension says how. A file appears when it is complete; a former one stays until then.

    Meshes: .ply .vtk .vtp .obj .stl .ts (double precision where the format can). Models: .msh (gmsh, with .geo beside it), .ml (GOCAD), .vtm (ParaView).

    Returns
    -------
    list of str
        What the format could not hold.

    Raises
    ------
    graben.FileError
        The file cannot be written.
    graben.InvalidInputError
        The extension is unknown.
    """
    path = os.fspath(path)
    if hasattr(mesh, "_write_model"):
        return mesh._write_model(path)
    name = os.path.splitext(os.path.basename(path))[0]
    mesh = as_mesh("mesh", mesh)
    return _core.write_mesh(path, mesh._core_mesh(), name, mesh.z_positive)


def as_picks(name: str, value: Any, *, columns: Any = None, null: Any = None, threads: int = 0) -> Picks:
    """Picks, a path, or an array of shape (n, 3); objects with points (pyvista) are taken too."""
    if isinstance(value, Picks):
        return value
    if _is_path(value):
        return read_picks(value, columns=columns, null=null, threads=threads)
    if hasattr(value, "points") and not hasattr(value, "__array__"):
        value = value.points
    return Picks(checks.points(name, value), source=name)


def as_mesh(name: str, value: Any) -> Mesh:
    """A Mesh, a path, a pair (vertices, triangles), or an object with points and regular_faces (pyvista) or vertices and faces (trimesh)."""
    if isinstance(value, Mesh):
        return value
    if _is_path(value):
        return read_mesh(value)
    for vertices, triangles in (("points", "regular_faces"), ("vertices", "faces"), ("vertices", "triangles")):
        if hasattr(value, vertices) and hasattr(value, triangles):
            return Mesh(getattr(value, vertices), getattr(value, triangles))
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return Mesh(checks.points(f"{name}[0], the vertices", value[0]), value[1])
    raise ValueError(f"{name}: a graben.Mesh, a path or a pair (vertices, triangles) was expected, not {type(value).__name__}")


def _is_sticks(value: Any) -> bool:
    """A list of polylines; a pair of vertices and triangles holds whole numbers in its second part."""
    if not isinstance(value, (tuple, list)) or not value:
        return False
    if not all(np.ndim(stick) == 2 and np.shape(stick)[1] == 3 for stick in value):
        return False
    return len(value) != 2 or np.asarray(value[1]).dtype.kind not in "iu"


def as_faults(name: str, value: Any) -> List[Fault]:
    """Faults in any way they can be given: one or a list of paths, Fault, Mesh, pairs (vertices, triangles), lists of sticks; or a dict of these by name."""
    if value is None:
        return []
    if isinstance(value, dict):
        return [_named(fault, str(key)) for key, one in value.items() for fault in _as_fault(f"{name}[{key!r}]", one, str(key))]
    if _is_path(value) or isinstance(value, (Fault, Mesh)):
        value = [value]
    if not isinstance(value, Iterable) or isinstance(value, np.ndarray):
        raise ValueError(f"{name}: a list of faults was expected, each a path, a graben.Fault, a mesh (vertices, triangles) or a list of sticks of "
                         f"shape (k, 3), not {type(value).__name__}")
    return [fault for i, one in enumerate(value) for fault in _as_fault(f"{name}[{i}]", one, f"fault_{i + 1}")]


def _named(fault: Fault, name: str) -> Fault:
    return Fault(name, fault.mesh, fault.sticks, fault.z_positive, fault.source, fault.notes, fault.warnings)


def _as_fault(argument: str, value: Any, name: str) -> List[Fault]:
    if isinstance(value, Fault):
        return [value]
    if _is_path(value):
        return read_faults(value)
    if _is_sticks(value):
        return [Fault(name, sticks=list(value), source=argument)]
    if isinstance(value, Mesh):
        return [Fault(value.name if value.name != "surface" else name, mesh=value, z_positive=value.z_positive, source=argument)]
    try:
        return [Fault(name, mesh=as_mesh(argument, value), source=argument)]
    except ValueError as error:
        raise ValueError(f"{error}; a fault is a path, a graben.Fault, a mesh (vertices, triangles) or a list of sticks of shape (k, 3)") from None


def as_dips(name: str, value: Any, *, null: Any = None) -> Tuple[np.ndarray, np.ndarray, List[str]]:
    """Measured dips: paths, or an array of shape (n, 5): x y z dip azimuth. Gives places, unit normals and notes."""
    if value is None or (isinstance(value, (list, tuple)) and not value):
        return np.empty((0, 3)), np.empty((0, 3)), []
    if _is_path(value):
        value = [value]
    if isinstance(value, (list, tuple)) and all(_is_path(one) for one in value):
        read = [_core.read_dips(os.fspath(one), words({"null": null}, lists=("null",))) for one in value]
        return np.concatenate([r[0] for r in read]), np.concatenate([r[1] for r in read]), [note for r in read for note in r[2]]
    table = checks.points(name, value, columns=5)
    return np.ascontiguousarray(table[:, :3]), _core.normals_of_dips(np.ascontiguousarray(table[:, 3:])), []


def as_rings(name: str, value: Any) -> List[np.ndarray]:
    """Polygons of the map: one ring of shape (k, 2) or (k, 3), or a list of them. Gives (k, 3)."""
    rings = [value] if np.ndim(value) == 2 and np.ndim(value[0]) == 1 else list(value)
    checked = [checks.points(f"{name}[{i}]", ring, least=3, columns=3 if np.ndim(ring) == 2 and np.shape(ring)[1] == 3 else 2) for i, ring in enumerate(rings)]
    if not checked:
        raise ValueError(f"{name}: 'data', 'hull', a path or a list of rings of shape (k, 2) was expected, but it is empty")
    return [np.column_stack((ring[:, :2], np.zeros(len(ring)))) for ring in checked]


def core_picks(picks: Picks) -> dict:
    return {"points": picks.points, "normals": picks.normals, "z_positive": picks.z_positive, "xy_unit": picks.xy_unit, "z_unit": picks.z_unit,
            "source": picks.source, "horizon": picks.horizon, "notes": picks.notes, "warnings": picks.warnings, "z_reason": picks.z_reason}
