"""The main job: picks and faults in, the faulted horizon out."""

import json
import os
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from .data import Mesh, mesh_from_core
from .files import Progress, as_dips, as_faults, as_picks, as_rings, core_picks
from .options import words

_PLACES = [(f"{wall}{axis}", "f8") for wall in ("", "hanging_wall_") for axis in "xyz"]

#: Columns of Horizon.throws. x y z: on the footwall's cutoff line; hanging_wall_*: straight across the fault; along: distance along the footwall's cutoff
#: (x, y units); throw: vertical separation (z units, positive where the hanging wall is down); heave (x, y units, across strike); dip_slip (x, y units,
#: along the fault's dip); deviation: standard deviation of the throw (z units, NaN where it is not known); mark: 0 good, 1 tip, 2 junction, 3 extrapolated.
THROW_TYPE = np.dtype(_PLACES + [(name, "f8") for name in ("along", "throw", "heave", "dip_slip", "deviation")] + [("mark", "i4")])

#: Columns of Horizon.profiles: as THROW_TYPE, at even distances; realized_*: P10, P90 and standard deviation of the throws of realizations (z units, NaN
#: without them); dip (degrees from the horizontal) and azimuth (degrees clockwise from y) of the fault.
PROFILE_TYPE = np.dtype(_PLACES + [(name, "f8") for name in ("along", "throw", "heave", "dip_slip", "deviation", "realized_low", "realized_high",
                                                             "realized_deviation", "dip", "azimuth")])

#: Values of picks["reason"]: why a pick took no part in the surface.
REASONS = ("good", "wrong side", "smeared", "at fault", "stray", "uncovered")


@dataclass(eq=False)
class Cutoff:
    """Where a piece of the horizon meets one side of a fault.

    Attributes
    ----------
    fault : str
        Its name.
    side : 'footwall' or 'hanging wall'
    piece : int
        The piece of the horizon.
    points : (k, 3) float64
        Along the border, the piece to the left seen from above.
    vertices : (k,) int32
        The same as vertices of the horizon.
    """

    fault: str
    side: str
    piece: int
    points: np.ndarray
    vertices: np.ndarray


@dataclass(eq=False)
class Polygon:
    """The area in the map between a fault's two cutoffs.

    Attributes
    ----------
    fault : str
    kind : 'gap' or 'overlap'
        Of a normal fault, or of a reverse fault, where the horizon lies over itself.
    area : float
        In the map, x, y units squared.
    ring : (k, 3) float64
        Counter-clockwise, the first point not repeated.
    """

    fault: str
    kind: str
    area: float
    ring: np.ndarray


@dataclass(eq=False, repr=False)
class Horizon(Mesh):
    """A faulted horizon: a Mesh (vertices, triangles, normals, pieces, fields) and what is known of it.

    fields: pick_distance, to the nearest pick of the same side (x, y units); extrapolated, 1 where that is farther than rho + delta; residual, mean distance
    of the picks at a vertex (z units, positive above, NaN without picks); height_sd, standard deviation of the height (z units).

    Attributes
    ----------
    faults : list of Mesh
        As used: lofted, extended, normals up; each with its name.
    cutoffs : list of Cutoff
    throws : dict of arrays by fault, dtype THROW_TYPE
        A row for each place where throw, heave and dip slip are read off: throw in z units, lengths in x, y units.
    profiles : dict of arrays by fault, dtype PROFILE_TYPE
        The same at even distances along strike.
    polygons : list of Polygon
    vertex_faults : (n, 2) int32
        The faults each vertex lies on, -1 for none.
    report : dict
        What the reconstruction says of itself; the same keys as the command's report.json.
    warnings, notes : list of str
        Sentences for you: what to look at, and what was done to the input.
    picks : dict of arrays, or None
        With keep_picks: points, normals (NaN where there is none), piece (-1: no surface near), residual (z units), reason (see REASONS), in the order given.
    """

    faults: List[Mesh] = field(default_factory=list)
    cutoffs: List[Cutoff] = field(default_factory=list)
    throws: Dict[str, np.ndarray] = field(default_factory=dict)
    profiles: Dict[str, np.ndarray] = field(default_factory=dict)
    polygons: List[Polygon] = field(default_factory=list)
    vertex_faults: np.ndarray = field(default_factory=lambda: np.empty((0, 2), np.int32))
    report: Dict[str, Any] = field(default_factory=dict)
    picks: Optional[Dict[str, np.ndarray]] = None

    @property
    def voxel_size(self) -> float:
        """Edge of the cells it was made with, x, y units."""
        return self.report["parameters"]["voxel_size"]

    def picture(self, path: Any, field: Optional[str] = None, *, width: int = 1200, height: int = 1000) -> None:
        """Draws the horizon from above, with its faults, into a PNG.

        Parameters
        ----------
        path : path
        field : str
            One of fields, in colours; None: heights with contour lines.
        width, height : int, pixels
        """
        from .picture import png

        data = png(self, field, width, height)
        with open(path, "wb") as file:
            file.write(data)

    def _repr_html_(self) -> str:
        from .picture import html

        return html(self)


def _table(rows: np.ndarray, dtype: np.dtype) -> np.ndarray:
    table = np.empty(len(rows), dtype)
    for i, name in enumerate(dtype.names):
        table[name] = rows[:, i]
    return table


def _distinct(names: Sequence[str]) -> List[str]:
    """The names, a number behind those that were there before."""
    taken: Dict[str, int] = {}
    distinct = []
    for name in names:
        taken[name] = taken.get(name, 0) + 1
        distinct.append(name if taken[name] == 1 else f"{name}_{taken[name]}")
    return distinct


def _horizon(d: Dict[str, Any]) -> Horizon:
    faults = [mesh_from_core(fault) for fault in d["faults"]]
    names = _distinct([fault.name for fault in faults])
    mesh = d["mesh"]
    report = json.loads(d["report"])
    return Horizon(
        mesh["vertices"], mesh["triangles"], mesh["normals"], mesh["pieces"], mesh["fields"], "horizon", d["z_positive"], d["notes"], report["warnings"],
        faults=faults,
        cutoffs=[Cutoff(names[fault], "footwall" if side < 0 else "hanging wall", piece, points, vertices)
                 for fault, piece, side, vertices, points in d["cutoffs"]],
        throws={name: _table(rows, THROW_TYPE) for name, rows in zip(names, d["throws"])},
        profiles={name: _table(rows, PROFILE_TYPE) for name, rows in zip(names, d["profiles"])},
        polygons=[Polygon(names[fault], "overlap" if overlap else "gap", area, ring) for fault, overlap, area, ring in d["polygons"]],
        vertex_faults=d["vertex_faults"], report=report, picks=d["picks"])


def reconstruct(
    picks: Any,
    faults: Any = (),
    *,
    dips: Any = None,
    voxel_size: Optional[float] = None,
    neighbors: Optional[int] = None,
    rho: Optional[float] = None,
    delta: Optional[float] = None,
    flip_angle: Optional[float] = None,
    zone_width: Optional[float] = None,
    fault_reach: Optional[float] = None,
    clearance: Optional[float] = None,
    extent: Any = None,
    fill_holes: Union[str, float, None] = None,
    extend_faults: Union[str, float, None] = None,
    fault_smoothing: Union[str, float, None] = None,
    fault_dip: Union[float, Tuple[float, float], None] = None,
    fit: Optional[str] = None,
    signed_distance: Optional[str] = None,
    orientation: Optional[str] = None,
    z_scale: Optional[float] = None,
    z_positive: Optional[str] = None,
    fault_z_positive: Optional[str] = None,
    units_as_given: bool = False,
    throw_interval: Optional[float] = None,
    columns: Optional[Sequence[Union[str, int]]] = None,
    null: Optional[Sequence[Union[str, float]]] = None,
    skip: Sequence[str] = (),
    threads: Optional[int] = None,
    memory_limit: Optional[float] = None,
    realizations: int = 0,
    deviation: bool = True,
    keep_picks: bool = False,
    progress: Progress = None,
) -> Horizon:
    """Turns picks on a horizon and the faults that cut it into the faulted horizon: one triangle mesh piece on each side of each fault, sealed to it.

    The same bits as the command graben_reconstruct gives, for any number of threads. Nothing but picks is required; None means: estimated from the picks, or
    the command's default. Other Python threads run meanwhile; Ctrl-C stops it.

    Parameters
    ----------
    picks : array (n, 3), Picks, or path
        x, y, z; x and y in one unit (metres, feet), z in its own. Rows with NaN are refused. An array is copied once.
    faults : list
        Each a path, a Fault, a mesh (vertices (n, 3), triangles (m, 3)), or a list of sticks (k, 3); a dict names them.
    dips : path, list of paths, or array (n, 5)
        Measured dips: x, y, z, dip (degrees from the horizontal), azimuth (degrees clockwise from y).
    voxel_size : float, x, y units
        Edge of a marching-cubes cell; default: the picks' mean distance.
    neighbors : int
        Picks a tangent plane is fitted to; default: 15, up to 60 where the noise is large.
    rho, delta : float, x, y units
        Sampling density: holes wider than about twice rho stay open. Largest noise of the picks.
    flip_angle : float, degrees
        Triangles turned farther than this from the planes around are left out; default 60, 180: none.
    zone_width : float, x, y units
        The zone fitted to the faults reaches this far from them; default: five voxels.
    fault_reach : float, x, y units
        Farthest the surface is carried on from the last picks to a fault.
    clearance : float, x, y units
        Picks nearer to a fault than this are left out; default 0.
    extent : 'data', 'hull', path of polygons, or list of rings (k, 2)
        What the surface covers: what the picks cover (default), all that lies between them on the map, or an area in which it is whole and beyond which
        it ends.
    fill_holes : float, x, y units, or 'all'
        Holes among the picks no wider than this are covered too; default 0.
    extend_faults : 'auto', 'off' or float, x, y units
        How far faults are continued along dip; auto: to the horizon, where the picks have a step there.
    fault_smoothing : 'auto', 'off' or float, x, y units
        How far the nodes of sticks lie off their fault (standard deviation).
    fault_dip : (dip, azimuth), degrees, or 90
        Of faults given as level lines, traces on a map.
    fit : 'full', 'normal' or 'off'
        Fit near the faults; default full.
    signed_distance : 'smooth' or 'nearest'
        Averaged over picks of the same side, or Hoppe's nearest plane; default smooth.
    orientation : 'mst' or 'up'
        Of the normals; default mst, a spanning tree.
    z_scale : float
        z is multiplied by this for all distances, as for time in ms against metres; default 1.
    z_positive, fault_z_positive : 'up', 'down' or 'auto'
        Which way z grows: elevation is up, depth and time are down; auto: as the files say, else up.
    units_as_given : bool
        Picks and faults are in the same units and directions although it does not look so.
    throw_interval : float, x, y units
        Distance between the rows of profiles; default: four voxels, rounded.
    columns, null
        Of a text table given as path, see read_picks.
    skip : list of str
        Steps to leave out, for comparisons.
    threads : int
        0: one per processor.
    memory_limit : float, GB
        A job that would need more is refused before it starts; default: three quarters of the memory.
    realizations : int, 4 to 1000
        Makes the surface so many times more from perturbed picks; see PROFILE_TYPE. For more than noise of single picks see ensemble.
    deviation : bool
        Whether the standard deviation of heights and throws is reckoned; a tenth of the time.
    keep_picks : bool
        Whether Horizon.picks says what became of each pick.
    progress : callable of (stage: str, fraction: float)
        Called in this thread as the job goes on; what it raises stops the job.

    Raises
    ------
    ValueError
        An argument is not what it should be; names it, its shape, and what was expected.
    graben.Error
        InvalidInputError, FileError (with file and row), ResourceError.
    """
    rings = None if extent is None or isinstance(extent, (str, os.PathLike)) else as_rings("extent", extent)
    extent = os.fspath(extent) if isinstance(extent, os.PathLike) else extent
    said = words(
        dict(voxel_size=voxel_size, neighbors=neighbors, rho=rho, delta=delta, flip_angle=flip_angle, zone_width=zone_width, fault_reach=fault_reach,
             clearance=clearance, extent=extent if rings is None else None, fill_holes=fill_holes, extend_faults=extend_faults,
             fault_smoothing=fault_smoothing, fault_dip=fault_dip, fit=fit,
             signed_distance=signed_distance, orientation=orientation, z_scale=z_scale, z_positive=z_positive, fault_z_positive=fault_z_positive,
             units_as_given=units_as_given, throw_interval=throw_interval, skip=skip, threads=threads, memory_limit=memory_limit), lists=("skip",))
    if realizations != 0 and not 4 <= realizations <= 1000:
        raise ValueError(f"realizations: 0, or 4 to 1000 were expected, not {realizations}")
    given = as_picks("picks", picks, columns=columns, null=null, threads=threads or 0)
    fault_list = as_faults("faults", faults)
    places, normals, dip_notes = as_dips("dips", dips, null=null)
    wishes = {"deviation": bool(deviation), "keep_picks": bool(keep_picks), "realizations": int(realizations), "polygon": rings or []}
    d = _core.reconstruct(said, core_picks(given), [fault._core_fault() for fault in fault_list], (places, normals), wishes, progress)
    d["notes"] = dip_notes + d["notes"]
    return _horizon(d)
