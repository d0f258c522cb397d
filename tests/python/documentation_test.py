"""The lines of config/documentation/python.md run as they stand and say what they should."""

import os
import re
from pathlib import Path

import pytest

from conftest import command

PAGE = Path(os.environ["GRABEN_SOURCE_DIR"]) / "config/documentation/python.md"


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    (sample,) = re.findall(r"`graben_synthesize (--output sample .*)`", PAGE.read_text())
    before = os.getcwd()
    os.chdir(folder)
    try:
        command("graben_synthesize", "--quiet", *sample.split())
        lines = []
        names = {"print": lambda *words: lines.append(" ".join(map(str, words)))}
        for number, block in enumerate(re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)):
            exec(compile(block, f"python.md, block {number + 1}", "exec"), names)
    finally:
        os.chdir(before)
    return folder, lines


def test_what_is_printed(told):
    _, lines = told
    text = "\n".join(lines)
    assert re.search(r"<graben.Horizon 'horizon': \d+ triangles", text)
    assert re.search(r"^throw 0 to \d+, heave up to \d+$", text, re.MULTILINE)
    assert re.search(r"^largest throw \d+, between \d+ \(P10\) and \d+ \(P90\)$", text, re.MULTILINE)
    assert "its shape is" in text and "(n, 3)" in text


def test_the_files(told):
    folder, _ = told
    for name in ("horizon.ply", "model.msh", "ensemble/failed.csv", "ensemble/horizon_mean.asc"):
        assert (folder / name).stat().st_size > 0


def test_the_pictures_of_the_page(told):
    """Those beside the page are drawn by it."""
    folder, _ = told
    for name in re.findall(r"!\[.*?\]\((.*?)\)", PAGE.read_text()):
        assert (folder / name).read_bytes().startswith(b"\x89PNG")
        assert (PAGE.parent / name).read_bytes().startswith(b"\x89PNG"), f"{name} is missing beside the page"
