# SPDX-License-Identifier: BSD-3-Clause
"""The differential tests: the same command lines by tonetool --compat and by stock oiiotool."""

import os
import shutil
from concurrent.futures import ThreadPoolExecutor

import pytest
from inputs import make_inputs
from run_case import StockRuns, differences, is_meaningful, run_case
from versions import WRITTEN_FOR, judge, version_of

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"


@pytest.fixture(scope="session")
def stock_program():
    path = shutil.which("oiiotool", path="/usr/bin")
    if not path:
        pytest.skip("no oiiotool here to compare with")
    return path


@pytest.fixture(scope="session")
def stock_version(stock_program):
    return version_of(stock_program)


@pytest.fixture(scope="session")
def verdict(request, stock_program, stock_version, tmp_path_factory):
    """verdict(case): what is wrong with it. All selected cases start at once, two at a time."""
    root = tmp_path_factory.mktemp("differential")
    inputs = make_inputs(root / "in")
    stock = StockRuns(stock_program, inputs, root / "stock")
    program = os.environ["TONETOOL"]

    def compare(case):
        own = run_case(case, program, ["--compat"], inputs, root / "own" / case.name)
        reference = stock.run(case)
        found = (is_meaningful(case, reference, stock_version == WRITTEN_FOR)
                 or differences(case, reference, own))
        shutil.rmtree(own.folder)
        stock.forget(reference)
        return found

    selected = [item.callspec.params["case"] for item in request.session.items
                if "case" in getattr(getattr(item, "callspec", None), "params", ())]
    with ThreadPoolExecutor(2) as pool:
        started = {case.name: pool.submit(compare, case) for case in selected if can_run(case)}
        yield lambda case: started[case.name].result()
        for one in started.values():
            one.cancel()


def can_run(case):
    return FONT not in case.line or os.path.exists(FONT)


@pytest.fixture
def assert_identical(verdict, stock_version):
    def check(case):
        if not can_run(case):
            pytest.skip(f"no font {FONT} here")
        found = judge(case.name, verdict(case), stock_version)
        assert not found, "\n".join([case.line, *found])

    return check
