"""Triangles of GOCAD surfaces."""

from pathlib import Path


class TSurf:
    """The vertices and triangles of all surfaces in a file."""

    def __init__(self, path):
        self.vertices, self.triangles = [], []
        first, numbers = 0, {}
        for line in Path(path).read_text(encoding="utf-8").splitlines():
            words = line.split()
            if not words:
                continue
            if words[0] in ("VRTX", "PVRTX"):
                numbers[int(words[1])] = len(self.vertices)
                self.vertices.append(tuple(float(word) for word in words[2:5]))
            elif words[0] == "TRGL":
                self.triangles.append(tuple(numbers[int(word)] for word in words[1:4]))
            elif words[0] == "GOCAD" and len(self.vertices) > first:
                first, numbers = len(self.vertices), {}
