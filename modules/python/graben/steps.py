"""Single steps of a reconstruction, for those who chain them: the PCL classes, and what measures picks and surfaces."""

import json
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _core, checks
from .data import Mesh, mesh_from_core
from .files import as_faults, as_mesh, as_picks, core_picks
from .options import words


class Sampling(NamedTuple):
    """How densely and how exactly picks sample their surface; all in the picks' units.

    spacing: median nearest-neighbour distance. mean_distance: square root of the area per pick, a voxel size that suits. rho: the cloud is rho-dense, no ball
    of that radius on the surface is empty. delta: three standard deviations about local planes. sigma: standard deviation of the noise. along_lines: whether
    picks lie along lines; then line_distance (from line to line), along (from pick to pick) and share_on_lines.
    """

    spacing: float
    mean_distance: float
    rho: float
    delta: float
    sigma: float
    along_lines: bool
    line_distance: float
    along: float
    share_on_lines: float


def sampling(picks: Any, *, threads: int = 0) -> Sampling:
    """Measures how picks lie: what reconstruct takes its defaults from. picks: array (n, 3), Picks or path, z in the units of x and y."""
    return Sampling(**_core.sampling(as_picks("picks", picks, threads=threads).points, threads))


def evaluate(mesh: Any, *, picks: Any = None, faults: Any = (), truth: Any = None, cutoffs: Any = (), zone_width: Optional[float] = None,
             voxel_size: Optional[float] = None, sigma: Optional[float] = None, pick_reach: Optional[float] = None, margin: Optional[float] = None,
             samples: Optional[int] = None, z_positive: Optional[str] = None, z_scale: Optional[float] = None, threads: Optional[int] = None) -> Dict[str, Any]:
    """Measures a horizon surface, as graben_evaluate does: topology, triangle shapes, and what it is given to be measured against. Distances in x, y units.

    Parameters
    ----------
    mesh : Mesh, path, or (vertices (n, 3), triangles (m, 3))
    picks : array (n, 3), Picks or path
        For the error E(M, X).
    faults : as in reconstruct
        For bridges and seal.
    truth : Mesh, path, or (vertices, triangles)
        The true surface, for distances both ways.
    cutoffs : list of lines (k, 3), or paths
        True cutoff lines, for their distance to the mesh's border.
    zone_width : float, default 300
        Near a fault is what lies within this distance.
    voxel_size : float
        What the surface was made with; default: its median edge.
    sigma : float
        Noise of the picks, the unit of distances to the truth.
    pick_reach, margin : float
        The truth counts as missing only this near to a pick, and this far from the end of the area.
    samples : int, default 100000
        Sample points on each surface.

    Returns
    -------
    dict
        The keys of the command's --report.
    """
    said = words(dict(zone_width=zone_width, voxel_size=voxel_size, sigma=sigma, pick_reach=pick_reach, margin=margin, samples=samples,
                      z_positive=z_positive, z_scale=z_scale, threads=threads)) + ["mesh"]
    surface = as_mesh("mesh", mesh)
    none = {"points": np.empty((0, 3)), "z_positive": "auto", "xy_unit": "", "z_unit": "", "source": "", "horizon": "", "notes": [], "warnings": [],
            "z_reason": ""}
    given = none if picks is None else core_picks(as_picks("picks", picks))
    fault_list = [fault._core_fault() for fault in as_faults("faults", faults)]
    true = None if truth is None else as_mesh("truth", truth)._core_mesh()
    lines = as_faults("cutoffs", {"cutoffs": list(cutoffs)} if len(cutoffs) and not isinstance(cutoffs[0], str) else cutoffs)
    return json.loads(_core.evaluate(said, surface._core_mesh(), given, fault_list, true, [line._core_fault() for line in lines]))


def _faults(faults: Any) -> List[Dict[str, Any]]:
    return [fault._core_fault() for fault in as_faults("faults", faults)]


def normals(points: Any, faults: Any = (), *, neighbors: Optional[int] = None, rho: Optional[float] = None, delta: Optional[float] = None,
            orientation: Optional[str] = None, threads: int = 0) -> Tuple[np.ndarray, np.ndarray]:
    """Normals from the neighbours on a point's own side of the faults: the PCL class FaultConstrainedNormalEstimation.

    Single precision about the middle of the points, z up, all in one unit.

    Returns
    -------
    normals : (n, 3) float64
        Unit length; NaN where there is none.
    curvature : (n,) float32
    """
    if orientation not in (None, "mst", "up"):
        raise ValueError(f"orientation: 'mst' or 'up' was expected, not {orientation!r}")
    options = dict(neighbors=neighbors, rho=rho, delta=delta, orientation=orientation, threads=threads)
    return _core.normals(as_picks("points", points).points, _faults(faults), options)


def marching_cubes(points: Any, normals: Any, faults: Any = (), *, voxel_size: Optional[float] = None, rho: Optional[float] = None,
                   delta: Optional[float] = None, flip_angle: Optional[float] = None, fault_reach: Optional[float] = None, threads: int = 0) -> Mesh:
    """The surface of points with normals, a sheet on each side of each fault: the PCL class HoppeMarchingCubes. Points without a normal are skipped."""
    given = as_picks("points", points).points
    options = dict(voxel_size=voxel_size, rho=rho, delta=delta, flip_angle=flip_angle, fault_reach=fault_reach, threads=threads)
    return mesh_from_core(_core.marching_cubes(given, checks.unit_normals("normals", normals, len(given)), _faults(faults), options))


def cut(mesh: Any, faults: Any, *, tolerance: float = 0.0, threads: int = 0) -> Mesh:
    """Cuts a mesh along faults; vertices along the cut are doubled: the PCL class FaultCutter.

    tolerance: how near to a fault a vertex counts as on it; 0: a fiftieth of the median edge.
    """
    return mesh_from_core(_core.cut(as_mesh("mesh", mesh)._core_mesh(), _faults(faults), tolerance, threads))


def fit(mesh: Any, points: Any, normals: Any, faults: Any, *, fit: Optional[str] = None, neighbors: Optional[int] = None,
        zone_width: Optional[float] = None, search_radius: Optional[float] = None, max_step: Optional[float] = None, passes: Optional[int] = None,
        threads: int = 0) -> Mesh:
    """Moves the vertices near faults to where the quadrics of the picks on their own side have the least error: the PCL class QEMFaultFitter.

    mesh must be cut along the faults (cut, marching_cubes); lengths in the mesh's units, None: estimated.
    """
    if fit not in (None, "full", "normal", "off"):
        raise ValueError(f"fit: 'full', 'normal' or 'off' was expected, not {fit!r}")
    given = as_picks("points", points).points
    options = dict(fit=fit, neighbors=neighbors, zone_width=zone_width, search_radius=search_radius, max_step=max_step, passes=passes, threads=threads)
    found, _, _ = _core.fit(as_mesh("mesh", mesh)._core_mesh(), given, checks.unit_normals("normals", normals, len(given)), _faults(faults), options)
    return mesh_from_core(found)
