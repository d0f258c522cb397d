"""What an interpreter might as well have picked: picks and faults moved by errors of the kind that interpretations have."""

from dataclasses import dataclass, replace
from typing import List, Optional, Tuple

import numpy as np

from .data import Fault, Mesh, Picks

_WAVES = 64  # of a random field
_NEW_LINE = 5.0  # steps along a line; one that is longer begins the next line


@dataclass(frozen=True)
class Errors:
    """Standard deviations and ranges of the errors; see ensemble."""

    pick_sigma: float
    pick_range: float
    fault_sigma: float
    fault_range: Optional[float]
    misties: float
    z_scale: float
    lines: Optional[np.ndarray]  # for each pick the number of its line, from 0; None: picks are dense in all directions


def find_lines(points: np.ndarray, along: float) -> np.ndarray:
    """The line each pick is on, from the order of the picks: a new one begins where the step from one to the next is long beside the usual."""
    steps = np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1)
    return np.concatenate(([0], np.cumsum(steps > _NEW_LINE * along)))


def generator(seed: int, realization: int, *what: int) -> np.random.Generator:
    """Random numbers of one thing in one realization, whoever makes it and when."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(realization, *what))))


def smooth_field(places: np.ndarray, reach: float, random: np.random.Generator, phases: Optional[np.ndarray] = None) -> np.ndarray:
    """A Gaussian random field of variance 1 at places (n, d) whose correlation falls to exp(-1/2) over the reach, as a sum of waves.

    phases: (n,) of whole numbers; fields at places of different numbers have nothing to do with each other.
    """
    waves = random.standard_normal((_WAVES, places.shape[1])) / reach
    count = 1 if phases is None else int(phases.max()) + 1
    offsets = random.uniform(0.0, 2.0 * np.pi, (_WAVES, count))
    total = np.zeros(len(places))
    for wave, offset in zip(waves, offsets):
        total += np.cos(places @ wave + (offset[0] if phases is None else offset[phases]))
    return total * np.sqrt(2.0 / _WAVES)


def _along(points: np.ndarray, lines: np.ndarray) -> np.ndarray:
    """Distance along its line of each pick, (n, 1)."""
    steps = np.linalg.norm(np.diff(points[:, :2], axis=0, prepend=points[:1, :2]), axis=1)
    steps[np.concatenate(([True], lines[1:] != lines[:-1]))] = 0.0
    return np.cumsum(steps)[:, None]


def perturbed_picks(picks: Picks, errors: Errors, seed: int, realization: int, horizon: int = 0) -> Picks:
    """z moved by noise of pick_sigma, correlated over pick_range along each line (or in the map), and by a constant for each line."""
    random = generator(seed, realization, 0, horizon)
    points, lines = picks.points.copy(), errors.lines
    if errors.pick_sigma > 0.0:
        if errors.pick_range <= 0.0:
            noise = random.standard_normal(len(points))
        elif lines is None:
            noise = smooth_field(points[:, :2], errors.pick_range, random)
        else:
            noise = smooth_field(_along(points, lines), errors.pick_range, random, lines)
        points[:, 2] += errors.pick_sigma * noise
    if errors.misties > 0.0 and lines is not None:
        points[:, 2] += errors.misties * random.standard_normal(int(lines.max()) + 1)[lines]
    return replace(picks, points=points, notes=[], warnings=[])


def _scaled(points: np.ndarray, z_scale: float) -> np.ndarray:
    return points * (1.0, 1.0, z_scale)


def _vertex_normals(mesh: Mesh, z_scale: float) -> np.ndarray:
    corners = _scaled(mesh.vertices, z_scale)[mesh.triangles]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(mesh.vertices)
    for corner in range(3):
        np.add.at(normals, mesh.triangles[:, corner], facing)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0.0)


def _plane_normal(points: np.ndarray) -> np.ndarray:
    return np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2][-1]


def _moved(points: np.ndarray, normals: np.ndarray, errors: Errors, random: np.random.Generator) -> np.ndarray:
    scaled = _scaled(points, errors.z_scale)
    reach = errors.fault_range or float(np.linalg.norm(np.ptp(scaled, axis=0))) / 3.0
    moved = scaled + errors.fault_sigma * smooth_field(scaled, reach, random)[:, None] * normals
    return moved / (1.0, 1.0, errors.z_scale)


def perturbed_faults(faults: List[Fault], errors: Errors, seed: int, realization: int) -> List[Fault]:
    """Each fault moved across itself by a smooth random distance of fault_sigma, correlated over fault_range on the fault."""
    return [_perturbed_fault(fault, errors, generator(seed, realization, 1, i)) for i, fault in enumerate(faults)] if errors.fault_sigma > 0.0 else faults


def _perturbed_fault(fault: Fault, errors: Errors, random: np.random.Generator) -> Fault:
    if fault.mesh is not None:
        mesh = fault.mesh
        normals = _vertex_normals(mesh, errors.z_scale) if len(mesh.triangles) else _plane_normal(_scaled(mesh.vertices, errors.z_scale))
        return replace(fault, mesh=Mesh(_moved(mesh.vertices, normals, errors, random), mesh.triangles, name=mesh.name, z_positive=mesh.z_positive))
    nodes = np.concatenate(fault.sticks)
    moved = _moved(nodes, _plane_normal(_scaled(nodes, errors.z_scale)), errors, random)
    return replace(fault, sticks=np.split(moved, np.cumsum([len(stick) for stick in fault.sticks])[:-1]))


def perturbed(picks: List[Tuple[str, Picks, str]], errors: List[Errors], faults: List[Fault], seed: int, realization: int):
    """Picks of all horizons and the faults, of one realization."""
    moved = [(name, perturbed_picks(given, error, seed, realization, i), relation) for i, ((name, given, relation), error) in enumerate(zip(picks, errors))]
    return moved, perturbed_faults(faults, errors[0], seed, realization)
