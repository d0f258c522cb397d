"""Jobs that grow with something else than picks, or are small: graben alone, in one run."""

import math
import os
import random
import shutil
import subprocess

PICKS = 60000  # with many faults
APART = 60.0   # metres between these
FAULTS = (0, 30, 100, 300)
HALF_LENGTH = 1050.0
STEP = 8.0     # up and down from block to block

# name: what it is
JOBS = {
    **{"faults_%d" % count: "60,000 picks, %d parallel faults" % count for count in FAULTS},
    "lines": "22,800 picks on lines 22 spacings apart",
    "small": "2,000 picks, one fault",
    "plain": "60,000 picks, one fault",
    "results": "the same with `--results`",
}


def _whole(folder, name, make):
    """The folder of a job's input, made at most once."""
    path = os.path.join(folder, "job_" + name)
    if not os.path.isdir(path):
        part = path + ".part"
        shutil.rmtree(part, ignore_errors=True)
        make(part)
        os.rename(part, path)
    return path


def _many_faults(path):
    """Picks on blocks in turn up and down, and the vertical faults between them from the middle outwards."""
    os.makedirs(path)
    draw = random.Random(1)
    half = 0.5 * APART * (max(FAULTS) + 1)
    with open(os.path.join(path, "horizon.xyz"), "w", encoding="ascii") as out:
        for _ in range(PICKS):
            x, y = draw.uniform(-half, half), draw.uniform(-HALF_LENGTH, HALF_LENGTH)
            block = math.floor((x + half) / APART)
            out.write("%.3f %.3f %.3f\n" % (x, y, 20 * math.sin(x / 1500) + STEP * (block % 2) + draw.gauss(0, 0.5)))
    order = sorted(range(max(FAULTS)), key=lambda number: abs(number + 0.5 - 0.5 * max(FAULTS)))
    for place, number in enumerate(order):
        x = -half + APART * (number + 1)
        corners = [(x, y, z) for y in (-HALF_LENGTH - 100, HALF_LENGTH + 100) for z in (-150, 150)]
        with open(os.path.join(path, "fault_%d.ts" % (place + 1)), "w", encoding="ascii") as out:
            out.write("GOCAD TSurf 1\nHEADER {\nname:fault_%d\n}\nTFACE\n" % (place + 1))
            out.writelines("VRTX %d %.3f %.3f %.3f\n" % (i + 1, *corner) for i, corner in enumerate(corners))
            out.write("TRGL 1 2 4\nTRGL 1 4 3\nEND\n")


class Jobs:
    def __init__(self, folder, synthesize, reconstruct):
        self.folder, self.synthesize, self.reconstruct = folder, synthesize, reconstruct

    def _synthetic(self, name, *options):
        def make(part):
            subprocess.run([self.synthesize, "--quiet", "--no-truth", "--output", part, *options], check=True)
        return _whole(self.folder, name, make)

    def _command(self, path, faults, *options):
        command = [self.reconstruct, "--quiet", "--horizon", os.path.join(path, "horizon.xyz"), "--output", os.path.join(self.folder, "surface.ply"),
                   *options]
        return command + (["--fault", *(os.path.join(path, "fault_%d.ts" % (i + 1)) for i in range(faults))] if faults else [])

    def commands(self):
        """By name: a command and the picks it reads."""
        report = ("--report", os.path.join(self.folder, "report.json"))
        many = _whole(self.folder, "faults", _many_faults)
        found = {"faults_%d" % count: self._command(many, count, *report) for count in FAULTS}
        lines = self._synthetic("lines", "--kind", "normal", "--sampling", "lines", "--line-distance", "275,275", "--along-line", "12.5")
        found["lines"] = self._command(lines, 1, *report)
        found["small"] = self._command(self._synthetic("small", "--kind", "normal", "--picks", "2000"), 1)
        plain = self._synthetic("plain", "--kind", "normal")
        found["plain"] = self._command(plain, 1)
        found["results"] = self._command(plain, 1, "--results", os.path.join(self.folder, "job_results"))
        return {name: (command, command[command.index("--horizon") + 1]) for name, command in found.items()}


def goals(add, runs):
    """Rows of the table of goals. add(what, goal, value, met, text): value None: not measured."""
    def of(name, value):
        return runs.median("job", 0, name, value)

    def ratio(above, below):
        return above / below if above is not None and below else None

    def stage(run):
        return run["stages"].get("faults")
    add("300 faults / none, 60,000 picks: CPU time", "at most 12", ratio(of("faults_300", "cpu"), of("faults_0", "cpu")), lambda v: v <= 12, "%.1f")
    add("300 faults / 100: the stage of the faults", "at most 4", ratio(of("faults_300", stage), of("faults_100", stage)), lambda v: v <= 4, "%.1f")

    def time(what, goal, name, limit, text, factor):
        wall, cpu = of(name, "wall"), of(name, "cpu")
        if wall is not None:
            add(what, goal, factor * wall, lambda v: v <= limit, text, text % (factor * cpu))
    time("2,000 picks: ms", "at most 60", "small", 60, "%.0f", 1000)
    time("22,800 picks on lines: s", "at most 0.6", "lines", 0.6, "%.2f", 1)
    add("`--results` / plain, 60,000 picks: CPU time", "at most 1.6", ratio(of("results", "cpu"), of("plain", "cpu")), lambda v: v <= 1.6)
    more = None if of("results", "peak") is None or of("plain", "peak") is None else (of("results", "peak") - of("plain", "peak")) / 1e6
    add("`--results`: more memory, MB", "at most 50", more, lambda v: v <= 50, "%.0f")


def table(row, runs, seconds):
    """The rows of the table of jobs; none if there are no runs."""
    found = []
    for name, what in JOBS.items():
        wall, cpu, peak = (runs.median("job", 0, name, key) for key in ("wall", "cpu", "peak"))
        if wall is not None:
            found.append(row([what, seconds(wall), seconds(cpu), "%.0f" % (peak / 1e6)]))
        elif runs.failure("job", 0, name):
            found.append(row([what, runs.failure("job", 0, name), "-", "-"]))
    return [row(["job, default options", "wall s", "CPU s", "peak MB"]), "|---|---|---|---|"] + found if found else []
