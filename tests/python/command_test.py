"""The command graben_ensemble gives what graben.ensemble gives."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import graben

TOOL = Path(os.environ["GRABEN_BIN_DIR"]) / "graben_ensemble"


def run(*arguments):
    return subprocess.run([sys.executable, str(TOOL), *map(str, arguments)], capture_output=True, text=True)


def test_results_are_those_of_the_function(normal, tmp_path):
    done = run("--horizon", normal.picks, "--fault", *normal.faults, "--realizations", 3, "--fault-sigma", 10, "--voxel-size", 250, "--seed", 4, "--workers", 0,
               "--fit", "normal", "--results", tmp_path / "results")
    assert done.returncode == 0, done.stderr
    assert "realizations 3, of which 0 failed" in done.stdout and "largest throw" in done.stdout
    made = graben.ensemble(normal.picks, normal.faults, n=3, fault_sigma=10, voxel_size=250, seed=4, workers=0, fit="normal")
    names = made.write(tmp_path / "function")
    assert sorted(os.listdir(tmp_path / "results")) == sorted(names)
    for name in names:
        assert (tmp_path / "results" / name).read_bytes() == (tmp_path / "function" / name).read_bytes(), name


def test_several_horizons_are_a_model(stack, tmp_path):
    done = run("--horizon", f"Top={stack.folder / 'horizon.xyz'}", f"Base={stack.folder / 'horizon_2.xyz'}", "--fault", *stack.faults, "--realizations", 2,
               "--size", 600, "--inset", 200, "--results", tmp_path)
    assert done.returncode == 0, done.stderr
    table = np.genfromtxt(tmp_path / "blocks.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert len(table) == 6 and (table["probability"] == 1.0).all() and (table["volume_mean"] > 0.0).all()


@pytest.mark.parametrize("arguments, code, message", [
    (["--horizon", "nothing.xyz", "--results", "out"], 1, "nothing.xyz"),
    (["--horizon", "PICKS", "--results", "out", "--realizations", "1"], 2, "--realizations: 2 or more"),
    (["--horizon", "PICKS", "--results", "out", "--voxel-size", "-4"], 2, "voxel_size: .*-4"),
    (["--horizon", "PICKS", "--results", "out", "--size", "9"], 2, "--size: only for several horizons"),
    (["--horizon", "PICKS", "PICKS", "--results", "out"], 2, "NAME=PICKS"),
    (["--horizon", "PICKS", "--results", "out", "--misties", "3"], 2, "misties: .* lines"),
    (["--horizon", "PICKS"], 2, "--results"),
])
def test_wrong_use(normal, tmp_path, monkeypatch, arguments, code, message):
    monkeypatch.chdir(tmp_path)
    done = run(*[normal.picks if word == "PICKS" else word for word in arguments])
    assert done.returncode == code
    import re

    assert re.search(message, done.stderr) and "Traceback" not in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_without_the_package(tmp_path):
    done = subprocess.run([sys.executable, "-S", str(TOOL)], capture_output=True, text=True, env={"PATH": os.environ["PATH"]})
    assert done.returncode == 1 and "Python package of graben is not to be found" in done.stderr and "Traceback" not in done.stderr
