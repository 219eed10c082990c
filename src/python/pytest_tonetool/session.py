# SPDX-License-Identifier: BSD-3-Clause
"""What a session of pytest knows of its images: their stores, its folder, who has which name."""

import contextlib
import fcntl
import hashlib
import json
import os
import re
import shutil
import uuid

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

    def remember(self, node, name, problem):
        """What a test was told of an image: if it swallows that, as a thread does, the session fails."""
        file = self.folder / "problems" / f"{hashlib.sha256(f'{node} {name}'.encode()).hexdigest()}.json"
        if not problem:
            file.unlink(missing_ok=True)
            return
        self.claim()
        file.parent.mkdir(exist_ok=True)
        file.write_text(json.dumps({"id": node, "problem": problem}), encoding="utf-8")

    def swallowed(self):
        """Problems whose test has passed all the same."""
        told = [json.loads(file.read_text(encoding="utf-8")) for file in self.folder.glob("problems/*.json")]
        return sorted(f"{each['problem'].splitlines()[0]}, but its test {each['id']} has not failed"
                      for each in told if each["id"] not in self.not_passed)

    def parts(self):
        """Of each image that was checked, by the folder of its store."""
        found = {}
        for file in sorted(self.folder.glob("*/parts/*/*.json")):
            part = json.loads(file.read_text(encoding="utf-8"))
            found.setdefault(file.relative_to(self.folder).parts[0], {})[part["name"]] = part
        return found
