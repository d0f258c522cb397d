"""The package as a whole: help, stubs, and that pip installs it."""

import ast
import inspect
import os
import pydoc
import subprocess
import sys
from pathlib import Path

import pytest

import graben
from graben import _core

SOURCE = Path(os.environ["GRABEN_SOURCE_DIR"])


def test_the_stub_names_what_there_is():
    stub = ast.parse((SOURCE / "modules/python/graben/_core.pyi").read_text())
    told = {node.name: [argument.arg for argument in node.args.args] for node in stub.body if isinstance(node, ast.FunctionDef)}
    there = {name for name in dir(_core) if not name.startswith("_")} - {"version"}
    assert set(told) == there
    for name, arguments in told.items():
        first_line = getattr(_core, name).__doc__.splitlines()[0]
        assert [part.split(":")[0].strip() for part in first_line.split("(", 1)[1].rsplit(")", 1)[0].split(", ") if ":" in part and "[" not in
                part.split(":")[0]] == arguments, first_line


@pytest.mark.parametrize("name", graben.__all__)
def test_everything_public_is_described(name):
    thing = getattr(graben, name)
    if not callable(thing):
        return
    assert inspect.getdoc(thing), name
    if inspect.isfunction(thing):
        hints = inspect.signature(thing)
        assert all(parameter.annotation is not parameter.empty for parameter in hints.parameters.values()), name
        assert hints.return_annotation is not hints.empty


def test_arguments_of_reconstruct_are_described():
    text = inspect.getdoc(graben.reconstruct)
    for name in inspect.signature(graben.reconstruct).parameters:
        assert name in text, name
    assert "x, y units" in text and "(n, 3)" in text


def test_help_reads_as_a_page():
    page = pydoc.plain(pydoc.render_doc(graben))
    assert "faulted geological horizons" in page and "reconstruct(picks: Any, faults" in page
    assert max(len(line) for line in inspect.getdoc(graben.reconstruct).splitlines()) <= 160


def test_the_version_is_that_of_the_package():
    assert f"<version>{graben.__version__}</version>" in (SOURCE / "package.xml").read_text()


def test_import_brings_no_other_library():
    program = "import sys, graben; print(sorted({'pyvista', 'xtgeo', 'dask', 'distributed', 'pandas', 'matplotlib'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_pip_installs_it(tmp_path):
    """Into an environment of its own, from the module that is built already."""
    environment = tmp_path / "environment"
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", environment], check=True)
    python = environment / "bin" / "python"
    clean = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "PYTHONDONTWRITEBYTECODE")}
    before = {path for path in (SOURCE / "modules/python").rglob("*")}
    pip = [python, "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-deps", "--no-index"]
    subprocess.run([*pip, SOURCE / "modules/python"], check=True, env=clean)
    assert {path for path in (SOURCE / "modules/python").rglob("*")} == before, "the source tree stays as it was"
    program = ("import graben, numpy; assert graben.__file__.startswith('%s'); x = numpy.random.default_rng(1).uniform(0, 100, (500, 3)) * (1, 1, .01);"
               "print(len(graben.reconstruct(x).triangles) > 0, graben.__version__)" % environment)
    done = subprocess.run([python, "-c", program], capture_output=True, text=True, cwd=tmp_path, env=clean)
    assert done.stdout == f"True {graben.__version__}\n", done.stderr
    told = subprocess.run([environment / "bin" / "graben_ensemble", "--help"], capture_output=True, text=True, cwd=tmp_path, env=clean)
    assert told.returncode == 0 and "--pick-sigma" in told.stdout
