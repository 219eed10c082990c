# SPDX-License-Identifier: BSD-3-Clause
"""Without --compat nothing that oiiotool takes is refused but what loses work there."""

import os

import pytest
from cases_surface import CASES
from conftest import can_run
from inputs import make_inputs
from run_case import run_case

# What each of these asks for is not there; oiiotool goes on without a word.
REFUSED = {"taken-unknown-modifier", "taken-malformed-modifier", "taken-subimages-unknown",
           "taken-subimages-beyond", "coloured-ccmatrix-singular", "written-type-bits",
           "hidden-nostderr-warning", "printed-printstats-outside"}


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    root = tmp_path_factory.mktemp("strict")
    inputs = make_inputs(root / "in")
    program = os.environ["TONETOOL"]
    return {case.name: run_case(case, program, [], inputs, root / case.name)
            for case in CASES if can_run(case)}


def test_strict_mode_takes_what_oiiotool_takes(ran):
    refused = {name: ran[name].err for name in ran if ran[name].status}
    expected = {case.name for case in CASES if case.status} | REFUSED
    assert not {name: text for name, text in refused.items() if name not in expected}


def test_no_run_crashes(ran):
    assert not [name for name in ran if ran[name].status not in (0, 1)]
