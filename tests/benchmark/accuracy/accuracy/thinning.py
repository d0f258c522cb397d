"""Real picks thinned to lines, and what a surface made of those says of the picks left out. Needs numpy and scipy."""

import csv
import numpy
from scipy.interpolate import RBFInterpolator
from scipy.spatial import Delaunay, cKDTree

from .tsurf import TSurf

MOST_NODES = 4000  # of the spline, whose time grows with their cube
QUANTILES = (50, 90, 99)


def read_picks(path):
    picks = numpy.loadtxt(path, comments=("#", "!"), usecols=(0, 1, 2))
    return numpy.unique(picks, axis=0)


class Rows:
    """The rows and columns of picks on a grid, told by the commonest step between neighbours; strips where picks are scattered."""

    def __init__(self, picks, scattered):
        xy = picks[:, :2] - picks[:, :2].mean(axis=0)
        if scattered:
            self.spacing = float(numpy.sqrt(numpy.prod(numpy.ptp(xy, axis=0)) / len(xy)))
            self.place = xy / self.spacing
            return
        distance, index = cKDTree(xy).query(xy, k=5)
        self.spacing = float(numpy.median(distance[:, 1]))
        near = numpy.abs(distance[:, 1:] - self.spacing) < 0.02 * self.spacing
        step = (xy[index[:, 1:]] - xy[:, None])[near]
        turn = numpy.median(numpy.mod(numpy.arctan2(step[:, 1], step[:, 0]), numpy.pi / 2))
        along = numpy.array([numpy.cos(turn), numpy.sin(turn)])
        self.place = xy @ numpy.column_stack([along, [-along[1], along[0]]]) / self.spacing
        offset = numpy.angle(numpy.exp(2j * numpy.pi * self.place).mean(axis=0)) / (2 * numpy.pi)
        self.place -= offset

    def on_lines(self, every):
        """Which picks lie on every n-th row or column; n rows apart the middle one is the first."""
        off = numpy.abs(self.place - every * numpy.round(self.place / every))
        return (off < 0.5).any(axis=1)


def left_out(picks, kept):
    """Which picks are not kept and lie within the hull of those that are, seen from above."""
    return ~kept & (Delaunay(picks[kept][:, :2]).find_simplex(picks[:, :2]) >= 0)


def heights_off(surface, places):
    """For each place how far its z is from that of the nearest sheet over it; infinite where there is none."""
    mesh = TSurf(surface)
    vertices, triangles = numpy.array(mesh.vertices), numpy.array(mesh.triangles)
    corners = vertices[triangles]
    middle = corners[:, :, :2].mean(axis=1)
    radius = numpy.linalg.norm(corners[:, :, :2] - middle[:, None], axis=2).max(axis=1) * (1 + 1e-9)
    found = cKDTree(places[:, :2]).query_ball_point(middle, radius)
    owner = numpy.repeat(numpy.arange(len(triangles)), [len(f) for f in found])
    point = numpy.concatenate([numpy.array(f, dtype=int) for f in found])
    a, b, c = (corners[owner, k] for k in range(3))
    p = places[point]
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])
    with numpy.errstate(divide="ignore", invalid="ignore"):
        u = ((p[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (p[:, 1] - a[:, 1])) / area
        v = ((b[:, 0] - a[:, 0]) * (p[:, 1] - a[:, 1]) - (p[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])) / area
        inside = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9)
    off = numpy.abs(a[:, 2] + u * (b[:, 2] - a[:, 2]) + v * (c[:, 2] - a[:, 2]) - p[:, 2])
    nearest = numpy.full(len(places), numpy.inf)
    numpy.minimum.at(nearest, point[inside], off[inside])
    return nearest


def spline_off(picks, places):
    """The same of a thin-plate spline that knows no faults, through at most MOST_NODES of the picks."""
    nodes = picks[numpy.unique(numpy.round(picks[:, :2], 1), axis=0, return_index=True)[1]]
    nodes = nodes[numpy.random.default_rng(1).permutation(len(nodes))[:MOST_NODES]]
    middle, scale = nodes[:, :2].mean(axis=0), numpy.ptp(nodes[:, :2], axis=0).max()
    spline = RBFInterpolator((nodes[:, :2] - middle) / scale, nodes[:, 2], kernel="thin_plate_spline")
    return numpy.abs(spline((places[:, :2] - middle) / scale) - places[:, 2])


def quantiles(off):
    return [float(numpy.percentile(off, q, method="lower")) for q in QUANTILES]


def rows_of(path):
    """The rows of a table of results by the names of its columns, units left out."""
    with open(path, encoding="utf-8") as file:
        return [{name.split(" [")[0]: float(value or "nan") for name, value in row.items()} for row in csv.DictReader(file)]


def _profile(path):
    return numpy.array([(row["x"], row["y"], row["throw"]) for row in rows_of(path)]).reshape(-1, 3)


def throw_difference(full, thinned, reach):
    """RMS of the throws of one results folder against those of another, over the places of the first; the share of them that have no partner."""
    squares, missing, count = 0.0, 0, 0
    for path in sorted(full.glob("throw_*.csv")):
        ours = _profile(path)
        count += len(ours)
        other = thinned / path.name
        theirs = _profile(other) if other.is_file() else numpy.zeros((0, 3))
        if len(theirs) == 0:
            missing += len(ours)
            continue
        distance, index = cKDTree(theirs[:, :2]).query(ours[:, :2])
        near = distance <= reach
        missing += int((~near).sum())
        squares += float(((ours[near, 2] - theirs[index[near], 2]) ** 2).sum())
    matched = count - missing
    return (squares / matched) ** 0.5 if matched else float("nan"), missing / count if count else 0.0
