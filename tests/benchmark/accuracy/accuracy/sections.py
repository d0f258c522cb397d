"""Where to cut a sample for a section: across each fault, in the middle of its cutoff lines."""

from math import hypot

REACH = 400.0


def lines(path):
    """The lines of a .pol file."""
    line = []
    for row in path.read_text().splitlines():
        point = tuple(float(word) for word in row.split()[:3])
        if len(point) == 3 and point[0] != 999.0:
            line.append(point)
        elif line:
            yield line
            line = []
    if line:
        yield line


def across(cutoffs):
    """For each fault with cutoff lines (x0, y0, x1, y1), from its footwall to its hanging wall."""
    ends = []
    for path in cutoffs:
        if not path.stem.endswith("footwall"):
            continue
        longest = max(lines(path), key=len, default=[])
        if len(longest) < 3:
            continue
        n = len(longest)
        (xa, ya, _), (x, y, _), (xb, yb, _) = longest[n // 3], longest[n // 2], longest[2 * n // 3]
        length = hypot(xb - xa, yb - ya) or 1.0
        dx, dy = REACH * (yb - ya) / length, -REACH * (xb - xa) / length
        ends.append((x - dx, y - dy, x + dx, y + dy))
    return ends
