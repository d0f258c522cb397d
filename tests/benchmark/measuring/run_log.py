"""Measured runs, kept in a file as they are made."""

import hashlib
import json
import os
import statistics

from . import tools


def fingerprint(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()[:16]


class RunLog:
    """Runs by case, picks and tool. What another build of graben took is left out; the runs of other programs stay."""

    def __init__(self, path, build, resume):
        """build None: only to look at what is there."""
        self.path = path
        self.runs = []
        if os.path.exists(path):
            if resume:
                self.read(build)
            else:
                os.replace(path, path + ".old")
        if build is None and not self.runs:
            raise SystemExit("There are no runs in " + path)
        if build is not None:
            self.write(build)

    def read(self, build):
        with open(self.path, encoding="utf-8") as file:
            lines = [json.loads(line) for line in file if line.endswith("\n")]
        same = build is None or (lines and lines[0]["build"] == build)
        self.runs = [run for run in lines[1:] if same or run["tool"] in tools.PEERS]

    def write(self, build):
        with open(self.path + ".part", "w", encoding="utf-8") as file:
            file.writelines(json.dumps(line) + "\n" for line in [{"build": build}] + self.runs)
        os.replace(self.path + ".part", self.path)

    def add(self, run):
        self.runs.append(run)
        with open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps(run) + "\n")

    def find(self, case, picks, tool):
        return [run for run in self.runs if (run["case"], run["picks"], run["tool"]) == (case, picks, tool)]

    def median(self, case, picks, tool, value):
        """Of the runs that ended well; value: a key of a run or a function of it. None if there is none."""
        values = [value(run) if callable(value) else run[value] for run in self.find(case, picks, tool) if run["status"] == "ok"]
        values = [v for v in values if v is not None]
        return statistics.median(values) if values else None

    def failure(self, case, picks, tool):
        """What went wrong in the last run, or None."""
        runs = self.find(case, picks, tool)
        return runs[-1]["status"] if runs and all(run["status"] != "ok" for run in runs) else None

    def sizes(self, case):
        return sorted({run["picks"] for run in self.runs if run["case"] == case})

    def repeats(self):
        return max((len(self.find(run["case"], run["picks"], run["tool"])) for run in self.runs), default=0)

    def others(self):
        """Cores that other processes kept busy, median over all runs."""
        return statistics.median([run["others"] for run in self.runs]) if self.runs else 0.0
