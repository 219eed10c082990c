# SPDX-License-Identifier: BSD-3-Clause
"""The end of a session: all of its images as one run for each store, and approved names without a test."""

import fnmatch
import json
import os
import shutil
from pathlib import Path

from .program import approve_line, run_program, statuses, told, write_suite
from .session import STATE, Store, clean, locked


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
        return all(folder.is_dir() for folder in folders) and not {owner, *owner.parents}.isdisjoint(folders)

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
    for file, asks in sorted(set(state.collected.values())):
        store = Store(config, Path(file))
        found[store.folder] = store
        if asks:
            asking.add(store.folder)
    if config.getini("tonetool_store"):
        store = Store(config, config.rootpath)
        found[store.folder] = store
    return found, asking


def finish(config, state):
    """Sentences of what is wrong, and of what is useful."""
    for file in state.folder.glob("collected-*.json"):
        told_by_worker = json.loads(file.read_text(encoding="utf-8"))
        state.collected.update((node, tuple(test)) for node, test in told_by_worker.items())
    parts = state.parts()
    problems, notes = state.swallowed(), []
    page = config.getoption("tonetool_report")
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
        try:
            work.run(folder in asking, page if work.parts else None)
        except (OSError, RuntimeError) as error:
            work.problems.append(told(error))
        problems += work.problems
        notes += work.notes
    if page and not page.is_file():
        problems.append(f"--tonetool-report: \"{page}\" was not written")
    return problems, notes
