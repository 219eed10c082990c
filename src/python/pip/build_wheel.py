# SPDX-License-Identifier: BSD-3-Clause
"""What pip calls (PEP 517): compiles the module with CMake and packs it into a wheel.

It needs nothing but Python, CMake and a compiler. `--config-settings build-dir=FOLDER` keeps what was
compiled for the next time, `--config-settings cmake-args="-DCMAKE_PREFIX_PATH=/opt/tonetool"` tells
where the library is, if not in /usr, /usr/local or $CMAKE_PREFIX_PATH.
"""

import base64
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
ROOT = SOURCE.parents[1]


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(tonetool VERSION ([\d.]+)", text)[1]


def tag():
    """Of this interpreter, whose module is of no use to another."""
    if sys.implementation.name != "cpython":
        raise SystemExit(f"tonetool's module is for CPython, not for {sys.implementation.name}")
    python = "cp" + "".join(map(str, sys.version_info[:2]))
    platform = re.sub(r"\W", "_", sysconfig.get_platform())
    return f"{python}-{python}{getattr(sys, 'abiflags', '')}-{platform}"


def metadata():
    readme = (SOURCE / "pip" / "about.md").read_text(encoding="utf-8")
    return ("Metadata-Version: 2.1\nName: tonetool\n"
            f"Version: {version()}\n"
            "Summary: HDR image comparison and tone mapping for rendering\n"
            "License: BSD-3-Clause\nRequires-Python: >=3.8\nRequires-Dist: numpy\n"
            f"Description-Content-Type: text/markdown\n\n{readme}")


def pybind11_folder():
    """Of the interpreter's own pybind11; else CMake finds the system's."""
    done = subprocess.run([sys.executable, "-m", "pybind11", "--cmakedir"], capture_output=True, text=True,
                          check=False)
    return [f"-Dpybind11_DIR={done.stdout.strip()}"] if done.returncode == 0 else []


def compiled(folder, settings):
    """The folder that holds the package tonetool."""
    ninja = ["-G", "Ninja"] if shutil.which("ninja") and "CMAKE_GENERATOR" not in os.environ else []
    subprocess.run(["cmake", "-S", SOURCE, "-B", folder, *ninja, "-DCMAKE_BUILD_TYPE=Release",
                    f"-DTONETOOL_PYTHON_EXECUTABLE={sys.executable}", *pybind11_folder(),
                    *shlex.split(settings.get("cmake-args", ""))], check=True)
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count())
    subprocess.run(["cmake", "--build", folder, "--target", "tonetool_python", "--parallel", jobs], check=True)
    return Path(folder) / "tonetool"


def information():
    """The files of the folder dist-info but for the list of all."""
    wheel = f"Wheel-Version: 1.0\nGenerator: tonetool\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    return {"METADATA": metadata().encode(), "WHEEL": wheel.encode(), "LICENSE": (ROOT / "LICENSE").read_bytes(),
            "entry_points.txt": (SOURCE / "pip" / "entry_points.txt").read_bytes()}


def pack(package, wheel):
    info = f"tonetool-{version()}.dist-info"
    files = {f"tonetool/{path.name}": path.read_bytes() for path in sorted(package.iterdir()) if path.is_file()}
    files.update((f"{path.parent.name}/{path.name}", path.read_bytes()) for path in SOURCE.glob("pytest_tonetool/*.py"))
    files.update((f"{info}/{name}", data) for name, data in information().items())
    record = ""
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as out:
        for name, data in files.items():
            out.writestr(name, data)


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Without it pip builds the wheel twice; the CMake build installs the same."""
    name = f"tonetool-{version()}.dist-info"
    folder = Path(metadata_directory) / name
    folder.mkdir(exist_ok=True)
    for file, data in information().items():
        (folder / file).write_bytes(data)
    return name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Returns the name of the wheel."""
    settings = config_settings or {}
    name = f"tonetool-{version()}-{tag()}.whl"
    with tempfile.TemporaryDirectory() as fresh:
        package = compiled(settings.get("build-dir", fresh), settings)
        pack(package, Path(wheel_directory) / name)
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("there is no source archive of the module alone: its build needs the whole tree")
