"""model gives what graben_model gives, as arrays."""

import json
import pickle

import numpy as np
import pytest

import graben
from conftest import command


@pytest.fixture(scope="module")
def options():
    return {"size": 300.0, "inset": 100.0}


@pytest.fixture(scope="module")
def files(stack):
    return {"Top": str(stack.folder / "horizon.xyz"), "Base": str(stack.folder / "horizon_2.xyz")}


@pytest.fixture(scope="module")
def model(stack, files, options):
    return graben.model(files, stack.faults, **options)


def test_the_model_of_the_command(stack, files, model, tmp_path):
    command("graben_model", "--horizon", *(f"{name}={path}" for name, path in files.items()), "--fault", *stack.faults, "--size", 300, "--inset", 100,
            "--output", tmp_path / "command.msh", "--results", tmp_path / "results", "--quiet")
    model.write(tmp_path / "python.msh")
    assert (tmp_path / "python.msh").read_bytes() == (tmp_path / "command.msh").read_bytes()
    told = json.loads((tmp_path / "results" / "report.json").read_text())
    assert {k: v for k, v in model.report.items() if k != "stages"} == {k: v for k, v in told.items() if k != "stages"}


def test_blocks_are_closed_and_fill_the_box(model):
    assert model.closed and len(model.blocks) == 6
    assert sum(block.volume for block in model.blocks) == pytest.approx(model.report["volume"], rel=1e-9)
    (fault,) = model.faults
    for block in model.blocks:
        mesh = model.block_mesh(block.name)
        corners = mesh.vertices[mesh.triangles] - mesh.vertices.mean(axis=0)
        assert np.linalg.det(corners).sum() / 6.0 == pytest.approx(block.volume, rel=1e-9)
        assert block.fault_sides[fault.name] in (-1, 1)
    assert set(model.horizons) == {"Top", "Base"} == set(model.reports)


def test_surfaces(model):
    kinds = dict(model.surfaces)
    assert kinds["Top"] == "horizon" and kinds[model.faults[0].name] == "fault"
    top = model.surface_mesh("Top")
    assert set(np.unique(top.triangles)) == set(range(len(top.vertices)))
    with pytest.raises(ValueError, match="surface: 'Middle' is not one of"):
        model.surface_mesh("Middle")
    with pytest.raises(IndexError, match="6 blocks"):
        model.block_mesh(6)


def test_section(model):
    section = model.section([[-2500.0, 0.0], [2500.0, 100.0]])
    assert section.length == pytest.approx(np.hypot(5000.0, 100.0))
    assert {block.block for block in section.blocks} <= {block.name for block in model.blocks}
    areas = sum(block.area for block in section.blocks)
    assert areas == pytest.approx(section.length * (model.report["top"] - model.report["base"]), rel=1e-6)
    assert {throw.horizon for throw in section.throws} == {"Top", "Base"}
    assert all(50.0 < throw.apparent < 110.0 for throw in section.throws)
    with pytest.raises(ValueError, match=r"line: .*\(n, 2\), n >= 2"):
        model.section([[0.0, 0.0]])


def test_pickled_and_back(model):
    again = pickle.loads(pickle.dumps(model))
    assert [block.name for block in again.blocks] == [block.name for block in model.blocks]
    np.testing.assert_array_equal(again.block_mesh(0).vertices, model.block_mesh(0).vertices)
    assert again.section([[-2500, 0], [2500, 0]]).length == 5000.0


def test_arrays_and_relations(stack, files, options):
    given = [(name, graben.read_picks(path).points, "erosional") for name, path in files.items()]
    assert graben.model(given, stack.faults, **options).closed


@pytest.mark.parametrize("horizons, message", [({}, "horizons: .*empty"), ([("Top",)], r"horizons: .*\(name, picks\)"),
                                               ({"Top": np.zeros((2, 2))}, r"horizons\['Top'\]: .*\(2, 2\)"),
                                               ([("Top", np.eye(3), "younger")], "relation 'younger'")])
def test_wrong_horizons(horizons, message):
    with pytest.raises(ValueError, match=message):
        graben.model(horizons)


def test_wrong_options(files):
    with pytest.raises(ValueError, match="outline: .*four numbers"):
        graben.model(files, outline=(1, 2, 3))
    with pytest.raises(ValueError, match="colour"):
        graben.model(files, colour="red")
