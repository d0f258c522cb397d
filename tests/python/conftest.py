"""Samples made by graben_synthesize, once for each file of tests."""

import os
import subprocess
from pathlib import Path
from types import SimpleNamespace

import pytest

BIN = Path(os.environ["GRABEN_BIN_DIR"])


def command(name, *arguments):
    """Runs a graben command. Gives what it prints."""
    done = subprocess.run([str(BIN / name), *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def sample(folder, kind, *options):
    command("graben_synthesize", "--output", folder, "--kind", kind, "--quiet", *options)
    return SimpleNamespace(folder=folder, picks=str(folder / "horizon.xyz"), faults=sorted(map(str, folder.glob("fault_*.ts"))),
                           sticks=sorted(map(str, folder.glob("fault_*.pol"))))


@pytest.fixture(scope="session")
def normal(tmp_path_factory):
    """A normal fault through the area, z up, UTM coordinates."""
    return sample(tmp_path_factory.mktemp("normal"), "normal", "--picks", 6000, "--origin", "461000,5931000,-1700")


@pytest.fixture(scope="session")
def tip_in_depth(tmp_path_factory):
    """A fault that ends inside the area, z is depth."""
    return sample(tmp_path_factory.mktemp("tip"), "tip", "--picks", 6000, "--origin", "461000,5931000,1700", "--z-positive", "down")


@pytest.fixture(scope="session")
def stack(tmp_path_factory):
    """Two horizons cut by one fault."""
    return sample(tmp_path_factory.mktemp("stack"), "normal", "--picks", 3000, "--horizons", 2)


@pytest.fixture(scope="session")
def lines(tmp_path_factory):
    """Picks along lines, with misties."""
    return sample(tmp_path_factory.mktemp("lines"), "normal", "--sampling", "lines", "--line-distance", 300, "--along-line", 50, "--mistie", 4)
