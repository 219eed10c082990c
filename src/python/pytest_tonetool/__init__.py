# SPDX-License-Identifier: BSD-3-Clause
"""The fixture tonetool_check of pytest: an image against the approved one, judged by the program.

It is no part of the package tonetool, whose libraries would else be loaded by every pytest on the
machine. Each session has a folder below tonetool-results, in which its processes, the workers of
pytest-xdist among them, leave their images and a part for each; at its end all parts are one suite,
whose run.json is what `tonetool --approve` takes.
"""

import json
import os
import shutil
import sys

import pytest

from .check import Check
from .finish import finish, stores_of
from .program import told
from .session import STATE, State


@pytest.fixture
def tonetool_check(request):
    """Compares an image with the approved one: tonetool_check(image, fail="mean=0.3", name=None)."""
    return Check(request)


def pytest_addoption(parser):
    parser.getgroup("tonetool").addoption("--tonetool-report", metavar="FILE", help="page of all images, HTML")
    parser.addini("tonetool_store", "folder of approved images (default: approved beside the test file)")


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
