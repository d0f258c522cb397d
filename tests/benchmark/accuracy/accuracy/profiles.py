"""What a results folder says of a fault's throw and of its own deviation, beside the truth. Needs numpy and scipy."""

import math

import numpy

from .sections import lines
from .thinning import heights_off, rows_of
from .tsurf import TSurf

P90 = 1.2816  # standard deviations from P50 to P90


def _crossing(polylines, place, strike, near):
    """Where the vertical plane through a place across strike meets polylines, nearest to `near`; None if nowhere."""
    best = None
    for line in polylines:
        points = numpy.array(line)
        along = (points[:, :2] - place) @ strike
        for i in numpy.flatnonzero(along[:-1] * along[1:] <= 0.0):
            span = along[i] - along[i + 1]
            point = points[i] + (along[i] / span if span else 0.0) * (points[i + 1] - points[i])
            distance = float(numpy.linalg.norm(point - near))
            if best is None or distance < best[0]:
                best = (distance, point)
    return None if best is None else best[1]


def _beside(path, footwall, hanging_wall):
    found = []
    for row in rows_of(path):
        azimuth = math.radians(row["fault_dip_azimuth"])
        down = numpy.array([math.sin(azimuth), math.cos(azimuth)])
        strike = numpy.array([-down[1], down[0]])
        place = numpy.array([row["x"], row["y"]])
        foot = _crossing(footwall, place, strike, numpy.append(place, row["footwall_z"]))
        hanging = _crossing(hanging_wall, place, strike, numpy.append(place + row["heave"] * down, row["hanging_wall_z"]))
        if foot is not None and hanging is not None:
            found.append((row["throw"], foot[2] - hanging[2], row["throw_p10"], row["throw_p90"], row["heave"], float((hanging - foot)[:2] @ down)))
    return numpy.array(found).reshape(-1, 6)


def throws_beside_truth(results, sample):
    """For each row of the profiles: throw, true throw, P10, P90, heave, true heave."""
    found = []
    for path in sorted(results.glob("profile_*.csv")):
        number = path.stem.split("_")[1]
        found.append(_beside(path, *(list(lines(next(sample.glob(f"cutoff_fault_{number}_{wall}.pol")))) for wall in ("footwall", "hangingwall"))))
    return numpy.concatenate([numpy.zeros((0, 6)), *found])


def throws_beside_mesh(profile, truth):
    """The same for one fault, with the borders of a true surface, but for those of its area, for its cutoffs."""
    mesh = TSurf(truth)
    triangles = numpy.array(mesh.triangles)
    edges = numpy.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, uses = numpy.unique(edges, axis=0, return_counts=True)
    vertices = numpy.array(mesh.vertices)
    border = vertices[edges[uses == 1]]
    low, high = vertices[:, :2].min(axis=0), vertices[:, :2].max(axis=0)
    margin = 1e-3 * (high - low)
    at_edge = ((border[:, :, :2] < low + margin) | (border[:, :, :2] > high - margin)).all(axis=1).any(axis=1)
    cutoffs = list(border[~at_edge])
    return _beside(profile, cutoffs, cutoffs)


def tip_distance(results, sample):
    """From where the true cutoffs meet to the nearest end of the throws; nan where the fault has no tip."""
    worst = math.nan
    for path in sorted(results.glob("throw_*.csv")):
        number = path.stem.split("_")[1]
        ends = [numpy.array([end for line in lines(next(sample.glob(f"cutoff_fault_{number}_{wall}.pol"))) for end in (line[0], line[-1])])
                for wall in ("footwall", "hangingwall")]
        apart = numpy.linalg.norm(ends[0][:, None] - ends[1][None], axis=2)
        if apart.min() > 1.0:
            continue
        tip = ends[0][numpy.unravel_index(apart.argmin(), apart.shape)[0]]
        rows = rows_of(path)
        reached = min(math.dist(tip[:2], (row["x"], row["y"])) for row in (rows[0], rows[-1]))
        worst = reached if math.isnan(worst) else max(worst, reached)
    return worst


def _vertices(path):
    """The vertex properties of a binary PLY file."""
    kinds = {"double": "<f8", "float": "<f4", "int": "<i4", "uchar": "u1"}
    with open(path, "rb") as file:
        count, fields = 0, []
        for line in iter(file.readline, b"end_header\n"):
            words = line.decode().split()
            if words[:2] == ["element", "vertex"]:
                count = int(words[2])
            elif words[0] == "property" and words[1] != "list":
                fields.append((words[2], kinds[words[1]]))
        return numpy.frombuffer(file.read(count * numpy.dtype(fields).itemsize), dtype=fields)


def heights_beside_truth(results, sample, most=3000):
    """How far vertices are from the true height over their places, and the standard deviation the surface says it has there."""
    vertices = _vertices(results / "surface.ply")
    if "height_sd" not in vertices.dtype.names:
        return numpy.zeros((0, 2))
    chosen = numpy.random.default_rng(1).permutation(len(vertices))[:most]
    vertices = vertices[chosen]
    places = numpy.column_stack([vertices[axis] for axis in "xyz"]).astype(float)
    off = numpy.full(len(places), numpy.inf)
    for path in sorted(sample.glob("truth_block_*.ts")):
        off = numpy.minimum(off, heights_off(path, places))
    known = numpy.isfinite(off) & numpy.isfinite(vertices["height_sd"])
    return numpy.column_stack([off[known], vertices["height_sd"][known]])
