"""GMT's gridding programs as peers: a grid fitted to the picks of each true block, laid on the true surface's triangles of that block.

They are told what graben has to find: which picks belong to one block, and where it ends.
"""

import os
import shutil
import struct
import subprocess
import tempfile
import time
from pathlib import Path

from .run import CommandError
from .tsurf import TSurf

MOST_POINTS = 2000  # of greenspline, whose time grows with their cube
PADDING = 200.0


def program():
    """GMT's command, or None if it is not installed."""
    return shutil.which("gmt")


def labelled_picks(path):
    """The picks of a binary .ply of graben_synthesize: rows by their block."""
    content = Path(path).read_bytes()
    start = content.index(b"end_header\n") + len(b"end_header\n")
    blocks = {}
    for x, y, z, block in struct.iter_unpack("<dddI", content[start:]):
        blocks.setdefault(block, []).append((x, y, z))
    return blocks


def rows(points):
    return "".join(" ".join(f"{c:.9g}" for c in point) + "\n" for point in points)


class Gridder:
    """Runs one of the programs in a folder of its own."""

    def __init__(self, name, limit=600.0):
        self.name = name
        self.limit = limit

    def gmt(self, folder, arguments, text):
        environment = {**os.environ, "GMT_USERDIR": str(folder), "LC_ALL": "C"}
        try:
            done = subprocess.run([program(), *arguments], cwd=folder, input=text, capture_output=True, text=True, timeout=self.limit, check=False,
                                  env=environment)
        except subprocess.TimeoutExpired as error:
            raise CommandError(f"gmt {arguments[0]}: no result after {self.limit:.0f} s") from error
        if done.returncode != 0:
            raise CommandError(f"gmt {arguments[0]}: exit {done.returncode}: {done.stderr.strip().splitlines()[-1:]}")
        return done.stdout

    def means(self, folder, picks, cell, region):
        return self.gmt(folder, ["blockmean", region, f"-I{cell:g}"], rows(picks))

    def heights(self, picks, places, cell):
        """z of the grid of a block's picks at the places (x, y)."""
        low = [min(p[k] for p in (*picks, *places)) - PADDING for k in (0, 1)]
        wide = [max(p[k] for p in (*picks, *places)) + PADDING - low[k] for k in (0, 1)]

        def region_of(step):
            ends = [a + (int(w / step) + 1) * step for a, w in zip(low, wide)]
            return f"-R{low[0]:.6f}/{ends[0]:.6f}/{low[1]:.6f}/{ends[1]:.6f}"
        region = region_of(cell)
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            if self.name == "surface":
                self.gmt(folder, ["surface", region, f"-I{cell:g}", "-Ggrid.nc"], self.means(folder, picks, cell, region))
            else:
                means, support = self.means(folder, picks, cell, region), cell
                while means.count("\n") > MOST_POINTS:
                    support *= 1.25
                    means = self.means(folder, picks, support, region_of(support))
                self.gmt(folder, ["greenspline", region, f"-I{2 * cell:g}", "-Ggrid.nc", "-D1", "-Sc"], means)
            found = self.gmt(folder, ["grdtrack", "-Ggrid.nc", "-Z"], rows(places))
        heights = [float(word) for word in found.split()]
        if len(heights) != len(places) or any(z != z for z in heights):
            raise CommandError(f"gmt {self.name}: the grid does not reach everywhere")
        return heights


def surface_of(name, sample, mesh, cell=25.0):
    """Writes the mesh of a peer for a sample made with --format ply; returns its seconds."""
    blocks = labelled_picks(sample.folder / "horizon.ply")
    vertices, triangles, seconds = [], [], 0.0
    for number in sorted(blocks):
        block = TSurf(sample.folder / f"truth_block_{number + 1}.ts")
        start = time.monotonic()
        heights = Gridder(name).heights(blocks[number], [v[:2] for v in block.vertices], cell)
        seconds += time.monotonic() - start
        first = len(vertices)
        vertices += [(x, y, z) for (x, y, _), z in zip(block.vertices, heights)]
        triangles += [tuple(first + corner for corner in triangle) for triangle in block.triangles]
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    mesh.write_bytes(head.encode() + b"".join(struct.pack("<ddd", *v) for v in vertices) + b"".join(struct.pack("<Biii", 3, *t) for t in triangles))
    return seconds
