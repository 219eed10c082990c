# SPDX-License-Identifier: BSD-3-Clause
"""The fixture tonetool_check of pytest: an image against the approved one, judged by the program.

It is no part of the package tonetool, whose libraries would else be loaded by every pytest on the
machine. Each session has a folder below tonetool-results, in which its processes, the workers of
pytest-xdist among them, leave their images and a part for each; at its end all parts are one suite,
whose run.json is what `tonetool --approve` takes.
"""

import contextlib
import fcntl
import fnmatch
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import uuid
from pathlib import Path

import pytest

RESULTS = "tonetool-results"
RECORD = ".approved.json"
STATE = pytest.StashKey()


def clean(text):
    return re.sub(r"[^A-Za-z0-9._-]|^\.", "_", text)


class Store:
    """A folder of approved images, and where the tests of its names are."""

    def __init__(self, config, test):
        ini = config.getini("tonetool_store")
        self.owner = config.rootpath if ini else test.parent
        self.path = self.owner / (ini or "approved")
        self.files = "**/*.py" if ini else "*.py"
        self.relative = os.path.relpath(self.path, config.rootpath)
        self.folder = clean(self.relative)

    def names(self):
        """Those that are approved."""
        found = (file.relative_to(self.path) for file in self.path.rglob(f"*{RECORD}"))
        return {str(file)[:-len(RECORD)] for file in found if not any(part[0] == "." for part in file.parts)}


@contextlib.contextmanager
def locked(file, how=fcntl.LOCK_EX):
    with open(file, "a", encoding="utf-8") as handle:
        fcntl.flock(handle, how)
        yield handle


class State:
    """What a session, or one of its workers, knows of itself."""

    def __init__(self, config):
        given = getattr(config, "workerinput", {})
        self.worker = bool(given)
        self.id = given.get("tonetool_session") or uuid.uuid4().hex[:12]
        self.results = config.rootpath / RESULTS
        self.folder = self.results / f".session-{self.id}"
        self.collected = {}  # by node id: the file of the test, and whether it asks for tonetool_check
        self.passed = set()  # node ids
        self.not_passed = set()
        self.problems = []  # what the end of the session says
        self.notes = []
        self.alive = None

    def claim(self):
        """Makes the folder, and removes those of sessions that were killed."""
        if self.alive:
            return
        self.results.mkdir(parents=True, exist_ok=True)
        (self.results / ".gitignore").write_text("*\n", encoding="utf-8")
        with locked(self.results / ".lock"):
            self.folder.mkdir(exist_ok=True)
            self.alive = open(self.folder / "alive", "a", encoding="utf-8")
            fcntl.flock(self.alive, fcntl.LOCK_SH)
            for other in self.results.glob(".session-*/alive"):
                with contextlib.suppress(OSError), locked(other, fcntl.LOCK_EX | fcntl.LOCK_NB):
                    shutil.rmtree(other.parent)

    def place(self, store, kind, name):
        """A file of this session."""
        file = self.folder / store.folder / kind / name
        file.parent.mkdir(parents=True, exist_ok=True)
        return file

    def reserve(self, store, name, node, mine):
        """A second test of the name is an error; the same test once more, in the same process, is none."""
        self.claim()
        of_store = self.place(store, "names", ".store")
        with contextlib.suppress(FileExistsError), open(of_store, "x", encoding="utf-8") as out:
            out.write(store.relative)
        if of_store.read_text(encoding="utf-8") not in ("", store.relative):
            raise ValueError(f"tonetool_check: another folder of approved images is {store.folder} in {RESULTS}, too "
                             f"(valid: another name than \"{store.relative}\")")
        who = f"{node} {os.getpid()}"
        file = self.place(store, "names", name)
        try:
            with open(file, "x", encoding="utf-8") as out:
                out.write(who)
        except FileExistsError:
            if name in mine or file.read_text(encoding="utf-8") != who:
                raise ValueError(f"tonetool_check: two images are named {name} (valid: another name=)") from None
        mine.add(name)

    def parts(self):
        """Of each image that was checked, by the folder of its store."""
        found = {}
        for file in sorted(self.folder.glob("*/parts/*/*.json")):
            part = json.loads(file.read_text(encoding="utf-8"))
            found.setdefault(file.relative_to(self.folder).parts[0], {})[part["name"]] = part
        return found


def program():
    """As the variable TONETOOL says, else of the same installation, else of PATH."""
    named = os.environ.get("TONETOOL")
    beside = Path(__file__).resolve().parents[3:4]
    found = named or next((str(file / "bin/tonetool") for file in beside if (file / "bin/tonetool").is_file()), None)
    found = found or shutil.which("tonetool")
    if not found:
        raise RuntimeError("the program tonetool is neither beside this module nor in PATH, nor does TONETOOL name it")
    return found


def run_program(words, cwd):
    """Its exit status, and what it printed. Files have names from here: one of a folder above may have wildcards."""
    found = program()
    try:
        words = [os.path.relpath(word, cwd) if isinstance(word, Path) else word for word in words]
        done = subprocess.run([found, *words], cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, encoding="utf-8", errors="replace", check=False)
    except OSError as error:
        raise RuntimeError(f"the program \"{found}\" cannot be run: {error.strerror}") from None
    return done.returncode, done.stdout.strip()


def write_suite(file, store, images, parts):
    rows = "".join(f"\n[[case]]\nname = {json.dumps(part['name'])}\nfail = {json.dumps(part['fail'])}\n"
                   for part in parts)
    reference, test = (json.dumps(os.path.relpath(path, file.parent)) for path in (store, images / "%N.exr"))
    file.write_text(f"tonetool-suite = 1\nname = \"pytest\"\nreference = {reference}\ntest = {test}\n"
                    f"check = \"--hdrflip\"\n{rows}", encoding="utf-8")


def statuses(output):
    """Status and message of each case of a run; none where it wrote no result."""
    try:
        cases = json.loads(output.read_text(encoding="utf-8"))["frames"]
        return {case["name"]: (case["status"], case.get("message", "")) for case in cases}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def write_image(image, path):
    if isinstance(image, (str, os.PathLike)):
        if Path(image).suffix.lower() != ".exr":
            raise ValueError(f"tonetool_check: \"{image}\" is no .exr file (valid: an OpenEXR file, an ImageBuf, an "
                             "array of float32)")
        shutil.copyfile(image, path)
        return
    kind = str(image.spec().format if hasattr(image, "geterror") else getattr(image, "dtype", type(image).__name__))
    if kind not in (("half", "float", "double", "unknown") if hasattr(image, "geterror") else ("float32",)):
        raise TypeError(f"tonetool_check: the image is of {kind} (valid: an array of float32, an ImageBuf of half or "
                        "float, both linear, or the name of an OpenEXR file)")
    try:
        import tonetool
    except ImportError as error:
        raise RuntimeError(f"the module tonetool cannot be loaded: {error}") from None
    tonetool.write_image(image, str(path))


def told(error):
    return f"\"{error.filename}\": {error.strerror}" if isinstance(error, OSError) and error.filename else str(error)


def typed(path, cwd):
    """As it is typed in a shell."""
    return shlex.quote(os.path.relpath(path, cwd))


def approve_line(run, names, cwd, *more):
    return " ".join(["tonetool --approve", typed(run, cwd), *names, *more, "--reason 'WHY'"])


class Check:
    """The fixture of one test."""

    def __init__(self, request):
        self.config = request.config
        self.state = request.config.stash[STATE]
        self.node = request.node
        self.cwd = request.config.invocation_params.dir
        self.store = Store(request.config, Path(request.node.path))
        self.mine = set()

    def __call__(self, image, fail=None, name=None):
        __tracebackhide__ = True
        if not isinstance(fail, str) or not fail.strip():
            raise ValueError("tonetool_check: no limit (valid: fail=\"mean=0.3,p99.9=0.6\")")
        full = f"{clean(Path(self.node.path).stem)}/{clean(name or self.node.name)}"
        try:
            self.state.reserve(self.store, full, self.node.nodeid, self.mine)
            problem = self.judge(image, {"name": full, "fail": fail, "id": self.node.nodeid})
        except (OSError, RuntimeError) as error:
            problem = f"tonetool_check: {full}: {told(error)}"
        if problem:
            pytest.fail(problem, pytrace=False)

    def judge(self, image, part):
        """What is wrong; empty where the image passes."""
        file = self.state.place(self.store, "images", f"{part['name']}.exr")
        file.unlink(missing_ok=True)
        write_image(image, file)
        output = self.state.place(self.store, "runs", f"{part['name']}.json")
        output.unlink(missing_ok=True)
        suite = output.with_name(f"{output.stem}.toml")
        write_suite(suite, self.store.path, self.state.folder / self.store.folder / "images", [part])
        status, said = run_program(["--suite", suite, "--only", part["name"], "--json", output], self.cwd)
        cases = statuses(output)
        part["passed"] = status == 0 and set(cases) == {part["name"]} and cases[part["name"]][0] == "passed"
        if cases:
            self.state.place(self.store, "parts", f"{part['name']}.json").write_text(json.dumps(part), encoding="utf-8")
        return "" if part["passed"] else self.sentence(part["name"], status, said, cases)

    def sentence(self, name, status, said, cases):
        if name not in cases:
            return f"tonetool_check: {name}: the program has no result, exit status {status}\n{said}".strip()
        folder = self.state.results / self.store.folder
        lines = [f"tonetool_check: {name}: {': '.join(cases[name])}"]
        lines += [line for line in said.splitlines() if line.startswith("tonetool WARNING")]
        if cases[name][0] == "failed":
            lines.append(f"pictures: {typed(folder / name, self.cwd)}.reference.png, .test.png, .error.png")
        else:
            lines.append(f"the image: {typed(folder / name, self.cwd)}.exr")
        if "\nto approve" in f"\n{said}":
            lines.append(f"to approve, after a look: {approve_line(folder / 'run.json', [name], self.cwd)}")
        return "\n".join(lines)


@pytest.fixture
def tonetool_check(request):
    """Compares an image with the approved one: tonetool_check(image, fail="mean=0.3", name=None)."""
    return Check(request)


class Finish:
    """All parts of a store, also those of workers, as one run."""

    def __init__(self, config, store, parts):
        self.config = config
        self.state = config.stash[STATE]
        self.cwd = config.invocation_params.dir
        self.store = store
        self.parts = parts
        self.folder = self.state.results / store.folder
        self.problems = []
        self.notes = []

    def is_whole(self):
        """Whether the session was asked for all tests that could be of the store."""
        if self.config.option.keyword:
            return False
        if getattr(getattr(self.config, "args_source", None), "name", "") == "TESTPATHS":
            return True
        owner = Path(os.path.realpath(self.store.owner))
        folders = [Path(os.path.realpath(self.cwd / arg)) for arg in self.config.args]
        return all(folder.is_dir() for folder in folders) and any(owner.is_relative_to(folder) for folder in folders)

    def gone(self):
        """Approved names whose test is not there any more, as far as this session can know."""
        left = sorted(name for name in self.store.names() - set(self.parts) if "/" in name)
        if not left or not self.is_whole():
            return []
        patterns = self.config.getini("python_files")
        stems = {name.partition("/")[0] for name in left}
        known = {stem for stem in stems
                 if any(fnmatch.fnmatch(f"{stem}.py", pattern) for pattern in patterns) and self.is_known(stem)}
        return [name for name in left if name.partition("/")[0] in known]

    def is_known(self, stem):
        """Whether every test of the files of this name ran, passed, and checked an image if it asks for that."""
        called = {part["id"] for part in self.parts.values()}
        tests = {node: asks for node, (file, asks) in self.state.collected.items() if clean(Path(file).stem) == stem}
        if any(node not in self.state.passed - self.state.not_passed or asks and node not in called
               for node, asks in tests.items()):
            return False
        files = {os.path.realpath(file) for file, _ in self.state.collected.values()}
        return all(os.path.realpath(file) in files for file in self.store.owner.glob(self.store.files)
                   if clean(file.stem) == stem)

    def run(self, is_asked, page):
        gone = self.gone()
        if self.parts or gone:
            self.state.claim()
            with locked(self.state.results / f".{self.store.folder}.lock"):
                self.compare(gone, page)
        elif is_asked:  # and no image came: the run would be one of an earlier session
            (self.folder / "run.json").unlink(missing_ok=True)

    def compare(self, gone, page):
        images = self.state.folder / self.store.folder / "images"
        images.mkdir(parents=True, exist_ok=True)
        for image in images.rglob("*.exr"):
            if str(image.relative_to(images))[:-len(".exr")] not in self.parts:  # it had no result
                image.unlink()
        shutil.rmtree(self.folder, ignore_errors=True)
        images.rename(self.folder)
        suite, output = self.folder / "suite.toml", self.folder / "run.json"
        write_suite(suite, self.store.path, self.folder, self.parts.values())
        names = [*self.parts, *gone]
        only = [word for name in names for word in ("--only", name)] if self.store.names() - set(names) else []
        status, said = run_program(["--suite", suite, *only, "--json", output, "--images", self.folder,
                                    *(["--report", page] if page else [])], self.cwd)
        cases = statuses(output)
        if not cases:
            raise RuntimeError(f"the program has no result, exit status {status}\n{said}".strip())
        self.judge(gone, cases)
        if sum(status != "passed" for status, _ in cases.values()) > 1:  # else its test has said so
            self.notes += [line for line in said.splitlines() if line.startswith("to approve")]

    def judge(self, gone, cases):
        """Tests have failed for what did not pass in them; here counts what only the whole session can tell."""
        for name, part in self.parts.items():
            said = cases.get(name, ("no case",))
            if part["passed"] and said[0] != "passed":
                self.problems.append(f"{name}: passed in its test, and now {': '.join(said)}")
        if gone:
            self.problems += [f"{name}: approved, but no test checks it any more" for name in gone]
            self.notes.append("to retire: " + approve_line(self.folder / "run.json", gone, self.cwd, "--retire"))


def stores_of(config, state):
    """Each store of the session by its folder, and whether a test asks for it."""
    found, asking = {}, set()
    for file in sorted({file for file, _ in state.collected.values()}):
        store = Store(config, Path(file))
        found[store.folder] = store
        if any(asks for of, asks in state.collected.values() if of == file):
            asking.add(store.folder)
    if config.getini("tonetool_store"):
        store = Store(config, config.rootpath)
        found[store.folder] = store
    return found, asking


def finish(config, state):
    """Sentences of what is wrong, and of what is useful."""
    for file in state.folder.glob("collected-*.json"):
        state.collected.update(json.loads(file.read_text(encoding="utf-8")))
    parts = state.parts()
    page = config.getoption("tonetool_report")
    problems, notes = [], []
    if page and len(parts) != 1:
        said = "--tonetool-report: no page"
        if parts:
            problems.append(f"{said}, as the tests have {len(parts)} folders of approved images (valid: one, which the "
                            "ini option tonetool_store names)")
        else:
            notes.append(f"{said}, as no image was checked")
    page = page and len(parts) == 1 and config.invocation_params.dir / page
    stores, asking = stores_of(config, state)
    for folder, store in stores.items():
        work = Finish(config, store, parts.get(folder, {}))
        work.run(folder in asking, page if work.parts else None)
        problems += work.problems
        notes += work.notes
    if page and not page.is_file():
        problems.append(f"--tonetool-report: \"{page}\" was not written")
    return problems, notes


def pytest_addoption(parser):
    parser.getgroup("tonetool").addoption("--tonetool-report", metavar="FILE", help="page of all images, HTML")
    parser.addini("tonetool_store", "folder of approved images, below the root (default: approved beside the test file)")


def pytest_configure(config):
    state = config.stash[STATE] = State(config)
    if not state.worker:
        config.pluginmanager.register(Reports(state), "tonetool-reports")


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node):
    """Of pytest-xdist: a worker works in the session's folder."""
    node.workerinput["tonetool_session"] = node.config.stash[STATE].id


def pytest_itemcollected(item):
    """Also of what is deselected later."""
    asks = "tonetool_check" in getattr(item, "fixturenames", ())
    item.config.stash[STATE].collected[item.nodeid] = (str(item.path), asks)


def pytest_collection_finish(session):
    """A worker tells the session, which collects nothing itself."""
    config, state = session.config, session.config.stash[STATE]
    if not state.worker:
        return
    stores, asking = stores_of(config, state)
    if asking or any(store.path.is_dir() for store in stores.values()):
        state.claim()
        (state.folder / f"collected-{os.getpid()}.json").write_text(json.dumps(state.collected), encoding="utf-8")


class Reports:
    """Which tests passed, told to the process that ends the session."""

    def __init__(self, state):
        self.state = state

    def pytest_runtest_logreport(self, report):
        if not report.passed or hasattr(report, "wasxfail"):
            self.state.not_passed.add(report.nodeid)
        elif report.when == "call":
            self.state.passed.add(report.nodeid)
        if not self.state.alive and self.state.folder.is_dir():
            self.state.claim()  # as workers end before the session does


@pytest.hookimpl(tryfirst=True)
def pytest_sessionfinish(session):
    """All parts, also of workers, in one run for each store."""
    config, state = session.config, session.config.stash[STATE]
    if state.worker or config.option.collectonly:
        return
    try:
        problems, state.notes = finish(config, state)
    except (OSError, RuntimeError, ValueError) as error:
        problems = [told(error)]
    shutil.rmtree(state.folder, ignore_errors=True)
    state.problems = [f"ERROR {line}" for line in problems]
    if problems and not config.pluginmanager.has_plugin("terminalreporter"):
        print(*state.problems, sep="\n", file=sys.stderr)
    if problems and session.exitstatus in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter, config):
    state = config.stash[STATE]
    if state.problems or state.notes:
        terminalreporter.section("tonetool", red=bool(state.problems))
    for line in [*state.problems, *state.notes]:
        terminalreporter.write_line(line)
