"""Runs the commands of graben on cases; samples are made once per folder."""

import hashlib
import json
import os
import resource
import shutil
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[4]


class CommandError(Exception):
    """A command ended with an error; the message is what it said."""


def build_folder(argument=None):
    return Path(argument or os.environ.get("GRABEN_BUILD_DIR") or ROOT / "build").resolve()


class Commands:
    """The programs of one build folder."""

    def __init__(self, build, threads=0, verbose=False):
        self.bin = build_folder(build) / "bin"
        self.threads = str(threads)
        self.verbose = verbose
        self.version = {}
        for name in ("synthesize", "reconstruct", "evaluate"):
            if not self.path(name).is_file():
                raise SystemExit(f"{self.path(name)} is missing; build graben first or name its build folder with --build")

    def path(self, name):
        return self.bin / f"graben_{name}"

    def digest(self, name):
        if name not in self.version:
            self.version[name] = hashlib.sha256(self.path(name).read_bytes()).hexdigest()
        return self.version[name]

    def call(self, program, arguments, limit=600.0):
        """Runs a program; returns its wall seconds."""
        command = [str(program), *map(str, arguments)]
        if self.verbose:
            print("+", " ".join(command), flush=True)
        start = time.monotonic()
        try:
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=limit, check=False)
        except subprocess.TimeoutExpired as error:
            raise CommandError(f"{Path(program).name}: no result after {limit:.0f} s") from error
        if done.returncode != 0:
            raise CommandError(f"{Path(program).name}: exit {done.returncode}: {done.stdout.strip().splitlines()[-1:]}")
        return time.monotonic() - start

    def graben(self, name, arguments):
        return self.call(self.path(name), [*arguments, "--threads", self.threads])


def _digest(*parts):
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


def _synthesized(commands, folder, options):
    """A folder with what graben_synthesize makes of these options, made at most once per version of it."""
    sample = folder / _digest(commands.digest("synthesize"), *options)
    if (sample / "synthetic.json").is_file():
        return sample
    made = sample.with_suffix(f".{os.getpid()}.{time.monotonic_ns()}")
    try:
        commands.graben("synthesize", ["--quiet", "--output", made, *options])
        made.rename(sample)
    except OSError:
        if not (sample / "synthetic.json").is_file():
            raise
    finally:
        shutil.rmtree(made, ignore_errors=True)
    return sample


def _replaced(options, others):
    """The options with the values of others; both are lists of name, value, name, value ..."""
    pairs = dict(zip(options[::2], options[1::2]))
    pairs.update(zip(others[::2], others[1::2]))
    return [word for pair in pairs.items() for word in pair]


class Sample:
    """The files of one case and seed."""

    def __init__(self, commands, folder, case, seed):
        folder = Path(folder) / "samples"
        folder.mkdir(parents=True, exist_ok=True)
        options = [*case.synthesize, "--noise", f"{case.sigma:g}", "--seed", str(seed)]
        self.case = case
        self.folder = _synthesized(commands, folder, options)
        self.picks = self.folder / "horizon.xyz"
        self.faults = sorted(self.folder.glob(f"fault_*.{case.faults}"))
        self.truth = self.folder / "truth.ply"
        self.cutoffs = sorted(self.folder.glob("cutoff_*.pol"))
        self.judging_faults = sorted(self.folder.glob("fault_*.ts"))
        if case.judged_by:
            other = _synthesized(commands, folder, ["--no-truth", *_replaced(options, case.judged_by)])
            self.judging_faults = sorted(other.glob("fault_*.ts"))

    def evaluate(self, commands, mesh, voxel_size, report):
        arguments = [mesh, "--quiet", "--picks", self.picks, "--truth", self.truth, "--sigma", f"{self.case.sigma:g}",
                     "--voxel-size", f"{voxel_size:.9g}", *self.case.evaluate, "--report", report]
        if self.judging_faults:
            arguments += ["--fault", *self.judging_faults]
        if self.cutoffs:
            arguments += ["--cutoffs", *self.cutoffs]
        commands.graben("evaluate", arguments)
        return json.loads(Path(report).read_text())


def reconstruct(commands, sample, folder, name, options=()):
    """Makes NAME.ply and NAME.report.json; returns the report with the wall seconds added."""
    mesh, report = folder / f"{name}.ply", folder / f"{name}.report.json"
    mesh.unlink(missing_ok=True)
    faults = ["--fault", *sample.faults] if sample.faults else []
    seconds = commands.graben("reconstruct", ["--quiet", "--horizon", sample.picks, *faults, *sample.case.reconstruct, *options,
                                              "--output", mesh, "--report", report])
    return {**json.loads(report.read_text()), "wall": seconds}


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime
