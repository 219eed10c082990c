# SPDX-License-Identifier: BSD-3-Clause
"""The fixture tonetool_check of pytest: an image against the approved one, judged by the program.

Each call leaves a part in tonetool-results/.parts, also in the processes of pytest-xdist; at the end all
parts are one suite, whose run.json is what `tonetool --approve` takes.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

RESULTS = "tonetool-results"


def pytest_addoption(parser):
    parser.getgroup("tonetool").addoption("--tonetool-report", metavar="FILE", help="page of all images, HTML")
    parser.addini("tonetool_store", "folder of approved images (default: approved beside the test file)")


def pytest_configure(config):
    if not hasattr(config, "workerinput"):  # before workers of pytest-xdist start
        shutil.rmtree(config.rootpath / RESULTS / ".parts", ignore_errors=True)


def program():
    package = Path(__file__).resolve().parent
    beside = [package.parents[3] / "bin" / "tonetool"] if len(package.parents) > 3 else []
    beside = [str(file) for file in [*beside, Path(sys.executable).parent / "tonetool"] if file.is_file()]
    found = os.environ.get("TONETOOL") or (beside[0] if beside else shutil.which("tonetool"))
    if not found:
        raise RuntimeError("tonetool_check: the program tonetool is neither beside the module nor in PATH")
    return found


def clean(text):
    return re.sub(r"[^A-Za-z0-9._-]", "_", text)


def write_image(image, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)  # what is compared is of this run
    if isinstance(image, (str, os.PathLike)):
        if Path(image).suffix.lower() != ".exr":
            raise ValueError(f"tonetool_check: \"{image}\" is no .exr file")
        shutil.copyfile(image, path)
    elif hasattr(image, "geterror"):  # an ImageBuf
        if not image.write(str(path)):
            raise RuntimeError(f"tonetool_check: {image.geterror()}")
    else:
        import tonetool
        if str(getattr(image, "dtype", "")) != "float32":
            raise TypeError("tonetool_check: the image is no ImageBuf, array of float32 or file name")
        tonetool.chain(["-d", "float", "-o", str(path)], [image])


def write_suite(file, parts):
    """Of parts of one store."""
    rows = "".join(f"\n[[case]]\nname = {json.dumps(part['name'])}\nfail = {json.dumps(part['fail'])}\n"
                   for part in parts)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(f"tonetool-suite = 1\nname = \"pytest\"\nreference = {json.dumps(parts[0]['store'])}\n"
                    f"test = {json.dumps(parts[0]['images'] + '/%N.exr')}\ncheck = \"--hdrflip\"\n{rows}",
                    encoding="utf-8")


def run_suite(file, parts, output, *more):
    """The finished program; output is its JSON."""
    write_suite(file, parts)
    output.unlink(missing_ok=True)
    only = [word for part in parts for word in ("--only", part["name"])]
    return subprocess.run([program(), "--suite", str(file), *only, "--json", str(output), *more], text=True,
                          capture_output=True, errors="replace", check=False)


def passed(done, output, name):
    if done.returncode != 0 or not output.is_file():
        return False
    cases = json.loads(output.read_text(encoding="utf-8"))["frames"]
    return [case["status"] for case in cases if case.get("name") == name] == ["passed"]


@pytest.fixture
def tonetool_check(request):
    """Compares an image with the approved one: tonetool_check(image, fail="mean=0.3", name=None)."""
    config, test = request.config, Path(request.node.path)
    results = config.rootpath / RESULTS
    ini = config.getini("tonetool_store")
    store = config.rootpath / ini if ini else test.parent / "approved"
    images = results / clean(os.path.relpath(store, config.rootpath))

    def check(image, fail=None, name=None):
        __tracebackhide__ = True
        if not fail:
            raise ValueError("tonetool_check: no limit (valid: fail=\"mean=0.3,p99.9=0.6\")")
        full = f"{clean(test.stem)}/{clean(name or request.node.name)}"
        part = {"name": full, "fail": fail, "store": str(store), "images": str(images), "id": request.node.nodeid}
        base = results / ".parts" / images.name / full
        base.parent.mkdir(parents=True, exist_ok=True)
        try:
            with open(f"{base}.part", "x", encoding="utf-8") as out:
                json.dump(part, out)
        except FileExistsError:
            raise ValueError(f"tonetool_check: two images are named {full} (valid: another name=)") from None
        write_image(image, images / f"{full}.exr")
        output = Path(f"{base}.json")
        done = run_suite(Path(f"{base}.toml"), [part], output)
        if not passed(done, output, full):
            said = (done.stdout + done.stderr).strip()
            pytest.fail(f"{said}\nto approve: tonetool --approve {images / 'run.json'} {full} --reason TEXT",
                        pytrace=False)

    return check


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session):
    """All parts, also of workers, in one run for each store."""
    config = session.config
    results = config.rootpath / RESULTS
    found = sorted((results / ".parts").rglob("*.part"))
    if hasattr(config, "workerinput") or not found:
        return
    stores = {}
    for part in (json.loads(file.read_text(encoding="utf-8")) for file in found):
        stores.setdefault(part["images"], []).append(part)
    page = config.getoption("tonetool_report")
    problems = []
    if page and len(stores) > 1:
        problems.append("--tonetool-report: a page is of one store, and the tests have several (valid: tonetool_store)")
    for images, parts in stores.items():
        output = Path(images) / "run.json"
        more = ["--report", os.path.abspath(page)] if page and len(stores) == 1 else []
        done = run_suite(Path(images) / "suite.toml", parts, output, *more)
        # Tests have failed for what did not pass; here counts what only this run did.
        if not output.is_file() or more and not Path(more[1]).is_file() or done.returncode and not session.testsfailed:
            problems.append((done.stdout + done.stderr).strip())
    if problems:
        print("\n" + "\n".join(problems), file=sys.stderr)
        session.exitstatus = pytest.ExitCode.INTERNAL_ERROR
