"""Makes the clouds that are reconstructed, once, in a folder."""

import math
import os
import random
import shutil
import struct
import subprocess

SIZE = 10000.0  # metres, of the horizon
NOISE = 2.0


def spacing(picks):
    """The nominal spacing: the edge of the square each pick has."""
    return SIZE / math.sqrt(picks)


def number(text):
    """10k, 4M or a plain number."""
    factor = {"k": 1000, "M": 1000000}.get(text[-1:], 1)
    return int(float(text[:-1] if factor > 1 else text) * factor)


def label(picks):
    for factor, name in ((1000000, "M"), (1000, "k")):
        if picks >= factor and picks % (factor // 10) == 0:
            return "%g %s" % (picks / factor, name)
    return str(picks)


def horizon(folder, synthesize, picks, text=False):
    """A horizon of graben_synthesize with two faults: its picks and the faults."""
    cloud = os.path.join(folder, "horizon_%d%s" % (picks, "_text" if text else ""))
    if not os.path.exists(os.path.join(cloud, "synthetic.json")):
        part = cloud + ".part"
        shutil.rmtree(part, ignore_errors=True)
        subprocess.run([synthesize, "--quiet", "--kind", "benchmark", "--size", "%g" % SIZE, "--noise", "%g" % NOISE, "--picks", str(picks),
                        "--format", "xyz" if text else "pcd", "--no-truth", "--output", part], check=True)
        shutil.rmtree(cloud, ignore_errors=True)
        os.rename(part, cloud)
    faults = [os.path.join(cloud, "fault_%d.ts" % i) for i in (1, 2)]
    return os.path.join(cloud, "horizon.xyz" if text else "horizon.pcd"), faults


def closed_object(folder, points):
    """A closed blob with bumps, as dense and as noisy as the horizon."""
    path = os.path.join(folder, "object_%d.pcd" % points)
    if not os.path.exists(path):
        part = path + ".part"
        radius = spacing(points) * math.sqrt(points / (4 * math.pi))
        draw = random.Random(1)
        with open(part, "wb") as out:
            out.write(("VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH %d\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
                       "POINTS %d\nDATA binary\n" % (points, points)).encode())
            for _ in range(points):
                z, turn = draw.uniform(-1, 1), draw.uniform(0, 2 * math.pi)
                across = math.sqrt(1 - z * z)
                x, y = across * math.cos(turn), across * math.sin(turn)
                r = radius * (1 + 0.05 * math.sin(5 * x + 1) * math.sin(6 * y + 2) * math.sin(4 * z)) + draw.gauss(0, NOISE)
                out.write(struct.pack("<3d", r * x, r * y, r * z))
        os.rename(part, path)
    return path
