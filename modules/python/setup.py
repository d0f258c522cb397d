"""Builds graben._core with CMake from the source tree around this folder; see README.md.

GRABEN_BUILD_DIR: a build folder of graben, made with -DGRABEN_BUILD_PYTHON=ON for this Python, to take the module from.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

TOP = Path(__file__).resolve().parents[2]
TEMPORARY = tempfile.mkdtemp(prefix="graben-")


class CMakeBuild(build_ext):
    def build_extension(self, ext: Extension) -> None:
        build = os.environ.get("GRABEN_BUILD_DIR")
        if not build:
            build = os.path.join(TEMPORARY, "cmake")
            subprocess.run(["cmake", "-S", str(TOP), "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DGRABEN_BUILD_PYTHON=ON", "-DGRABEN_BUILD_TESTS=OFF",
                            f"-DGRABEN_PYTHON={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--parallel", str(os.cpu_count() or 1), "--target", "graben_python"], check=True)
        target = Path(self.get_ext_fullpath(ext.name))
        built = Path(build, "python", "graben", target.name)
        if not built.exists():
            raise RuntimeError(f"{built} was expected: was GRABEN_BUILD_DIR made for {sys.executable}?")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built, target)


setup(
    version=re.search(r"<version>([0-9.]+)</version>", (TOP / "package.xml").read_text()).group(1),
    packages=["graben"],
    package_data={"graben": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("graben._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    zip_safe=False,
    # Nothing is written into the source tree.
    options={"build": {"build_base": TEMPORARY}, "egg_info": {"egg_base": TEMPORARY}},
)
