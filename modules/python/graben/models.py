"""Several horizons and the faults that cut them as closed blocks."""

import json
from dataclasses import dataclass, field
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core, checks
from .data import Mesh, mesh_from_core
from .files import Progress, as_faults, as_picks, core_picks
from .options import words


@dataclass(eq=False)
class Block:
    """A closed volume of a model.

    Attributes
    ----------
    name : str
    layer : int
        0: above the first horizon.
    volume, area : float
        In the user's units: x, y units squared times z units, where z_scale is 1.
    fault_sides : dict by fault
        1: in its hanging wall, -1: in its footwall, 2: on both sides, round its tip, 0: not at it.
    """

    name: str
    layer: int
    volume: float
    area: float
    fault_sides: Dict[str, int]


class SectionBlock(NamedTuple):
    """A block in a section: rings of (distance along the section, z); outer ones counter-clockwise, holes clockwise."""

    block: str
    rings: List[np.ndarray]
    area: float


class SectionLine(NamedTuple):
    """A horizon or fault in a section: points (distance along the section, z)."""

    surface: str
    points: np.ndarray


class SectionThrow(NamedTuple):
    """A throw in a section: its two cutoffs, footwall first, (2, 2); apparent in the section, and along the fault's dip (NaN where it is not known)."""

    fault: str
    horizon: str
    cutoffs: np.ndarray
    apparent: float
    along_dip: float


@dataclass(eq=False)
class Section:
    """A vertical section through a model along a line in plan.

    Attributes
    ----------
    length : float
        x, y units.
    blocks : list of SectionBlock
    lines : list of SectionLine
    throws : list of SectionThrow
    """

    length: float
    blocks: List[SectionBlock]
    lines: List[SectionLine]
    throws: List[SectionThrow]


@dataclass(eq=False)
class Model:
    """Horizons and faults as closed blocks that share their surfaces.

    Attributes
    ----------
    blocks : list of Block
    horizons : dict of Mesh by name
        As reconstructed, before they became part of the model.
    faults : list of Mesh
    report : dict
        As the command's report.json.
    reports : dict by horizon
        The reports of their reconstructions.
    defects : list of str
        Why the model is not closed; empty: it is.
    warnings, notes : list of str
    """

    blocks: List[Block]
    horizons: Dict[str, Mesh]
    faults: List[Mesh]
    report: Dict[str, Any]
    reports: Dict[str, Dict[str, Any]]
    defects: List[str]
    z_positive: str
    warnings: List[str] = field(default_factory=list)
    notes: List[str] = field(default_factory=list)
    _sealed: Dict[str, Any] = field(default_factory=dict, repr=False)

    @property
    def closed(self) -> bool:
        """Whether every block is watertight and the volumes add up."""
        return not self.defects

    def block_mesh(self, block: Union[int, str]) -> Mesh:
        """The closed surface of a block, by name or number, outward; pieces: the surface each vertex belongs to, see surfaces."""
        number = block if isinstance(block, int) else self._place([b.name for b in self.blocks], block, "block")
        return mesh_from_core(_core.block_mesh(self._sealed, number), self.blocks[number].name, self.z_positive)

    def surface_mesh(self, surface: str) -> Mesh:
        """What of a horizon, fault or wall bounds blocks; names: see surfaces."""
        return mesh_from_core(_core.surface_mesh(self._sealed, self._place([n for n, _ in self._sealed["surfaces"]], surface, "surface")), surface,
                              self.z_positive)

    @property
    def surfaces(self) -> List[Tuple[str, str]]:
        """Name and kind of all surfaces: wall, top, base, horizon or fault."""
        return list(self._sealed["surfaces"])

    def section(self, line: Any) -> Section:
        """Cuts the model along a line in plan: array (k, 2) of x, y, two points or more."""
        d = _core.section(self._sealed, checks.points("line", line, least=2, columns=2), self.z_positive)
        return Section(d["length"], [SectionBlock(*b) for b in d["blocks"]], [SectionLine(*t) for t in d["lines"]], [SectionThrow(*t) for t in d["throws"]])

    def write(self, path: Any) -> List[str]:
        """Writes the model: .msh (gmsh, with .geo beside it), .ml (GOCAD) or .vtm (ParaView)."""
        from .files import write

        return write(path, self)

    def _write_model(self, path: str) -> List[str]:
        if not path.endswith((".msh", ".ml", ".vtm")):
            raise ValueError(f"path: an extension .msh, .ml or .vtm was expected for a model, not {path!r}")
        _core.write_model(self._sealed, path, self.z_positive)
        return []

    @staticmethod
    def _place(names: Sequence[str], name: str, what: str) -> int:
        if name not in names:
            raise ValueError(f"{what}: {name!r} is not one of {', '.join(names)}")
        return list(names).index(name)


def _named_horizons(horizons: Any) -> List[Tuple[str, Any, str]]:
    items = list(horizons.items()) if isinstance(horizons, dict) else list(horizons)
    if not items:
        raise ValueError("horizons: a dict of picks by name, or a list of (name, picks), top to bottom, was expected, but it is empty")
    named = []
    for item in items:
        if not isinstance(item, (tuple, list)) or not 2 <= len(item) <= 3:
            raise ValueError("horizons: a dict of picks by name, or a list of (name, picks) or (name, picks, relation), top to bottom, was expected")
        name, picks = str(item[0]), item[1]
        relation = item[2] if len(item) == 3 else "conformable"
        named.append((name, core_picks(as_picks(f"horizons[{name!r}]", picks)), relation))
    return named


def _outline(outline: Any) -> Optional[str]:
    if outline is None or isinstance(outline, str):
        return outline
    box = np.asarray(outline, dtype=float).ravel()
    if box.shape != (4,):
        raise ValueError(f"outline: 'auto' or four numbers x0, y0, x1, y1 were expected, but its shape is {np.shape(outline)}")
    return "box:" + ",".join(repr(float(x)) for x in box)


def model(
    horizons: Any,
    faults: Any = (),
    *,
    outline: Any = None,
    inset: Optional[float] = None,
    top: Optional[float] = None,
    base: Optional[float] = None,
    size: Optional[float] = None,
    min_thickness: Optional[float] = None,
    fill: Optional[float] = None,
    extend_faults: Union[str, float, None] = None,
    progress: Progress = None,
    **options: Any,
) -> Model:
    """Turns picks on several horizons and the faults that cut them into closed blocks, as graben_model does.

    Parameters
    ----------
    horizons : dict of picks by name, or list of (name, picks) or (name, picks, relation)
        Top to bottom. picks as in reconstruct; relation: 'conformable', 'erosional' (cuts off those below) or 'onlap' (ends at the one below).
    faults : as in reconstruct
    outline : 'auto' or x0, y0, x1, y1
        auto: what all horizons' picks span.
    inset : float, x, y units
        Draws the outline in on all sides.
    top, base : float
        z where the model ends; default: over and under the picks by a tenth of their range.
    size : float, x, y units
        Edge of the model's triangles; default: the horizons' smallest voxel size.
    min_thickness : float, z units
        A layer thinner than this is absent.
    fill : float, x, y units
        Farthest a horizon is carried on from itself.
    extend_faults : 'box', 'none', 'off' or float
        box: up and down to the model's top and base.
    progress : callable of (stage, fraction)
    **options
        Of reconstruct, for every horizon: voxel_size, rho, z_scale, z_positive, threads, ...

    Raises as reconstruct.
    """
    given = dict(outline=_outline(outline), inset=inset, top=top, base=base, size=size, min_thickness=min_thickness, fill=fill, extend_faults=extend_faults)
    said = words({**given, **options}, lists=("skip",))
    named = _named_horizons(horizons)
    d = _core.model(said, named, [fault._core_fault() for fault in as_faults("faults", faults)], progress)
    faults_used = [mesh_from_core(fault) for fault in d["faults"]]
    names = [fault.name for fault in faults_used]
    return Model([Block(name, layer, volume, area, dict(zip(names, sides))) for name, layer, volume, area, sides in d["sealed"]["blocks"]],
                 {h["name"]: mesh_from_core(h, z_positive=d["z_positive"]) for h in d["horizons"]}, faults_used, json.loads(d["report"]),
                 {h["name"]: json.loads(h["report"]) for h in d["horizons"]}, d["defects"], d["z_positive"], d["warnings"], d["notes"], d["sealed"])
