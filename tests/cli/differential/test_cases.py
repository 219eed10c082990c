# SPDX-License-Identifier: BSD-3-Clause
"""Every case of the tables: exit status, files, images and text are those of stock oiiotool."""

import pytest
from cases import CASES
from joined import joined


@pytest.mark.parametrize("case", joined(CASES), ids=lambda case: case.name)
def test_case_is_identical(assert_identical, case):
    assert_identical(case)


def test_names_are_unique():
    assert len({case.name for case in CASES}) == len(CASES) >= 350
