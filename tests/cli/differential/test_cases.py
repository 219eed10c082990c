# SPDX-License-Identifier: BSD-3-Clause
"""Every case of the tables: exit status, files, images and text are those of stock oiiotool."""

import shutil

import pytest
from cases import CASES
from joined import joined
from versions import WRITTEN_FOR, version_of

# With another version each case is run for itself: what a command leaves behind for later ones, as
# the data types that were read, differs as well.
STOCK = shutil.which("oiiotool", path="/usr/bin")
TOGETHER = joined(CASES) if not STOCK or version_of(STOCK) == WRITTEN_FOR else CASES


@pytest.mark.parametrize("case", TOGETHER, ids=lambda case: case.name)
def test_case_is_identical(assert_identical, case):
    assert_identical(case)


def test_names_are_unique():
    assert len({case.name for case in CASES}) == len(CASES) >= 350
