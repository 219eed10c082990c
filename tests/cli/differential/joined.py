# SPDX-License-Identifier: BSD-3-Clause
"""Cases that leave no state behind run several in one process, since starting one takes most of
the time: "a --x -o out.exr" and "b --y -o out.exr" become "a --x -o one.exr b --y -o two.exr"."""

import math
import re

from case import Case

AT_ONCE = 8
PREFIX = re.compile(r"(-a |--colorconfig \S+ )*")
JOINABLE = set("""arith range window resample turn composite create draw text filter channel part
    deep stack color colormap""".split())
# Commands that change what later ones do, print, or look at the whole stack.
LEAVE_STATE = set("""a d i autoorient native colorconfig autocc noautocc label siappendall fixnan
    attrib echo""".split())
TAKE_TWO = set("""add sub mul div absdiff max min over zover paste pastemeta st_warp convolve
    chappend siappend deepmerge deepholdout swap""".split())


def takes(name, word, argument):
    if name == "mosaic":
        return math.prod(map(int, argument.split("x")))
    if re.search(":(n|all)=", word):
        return 99
    return 3 if name == "mad" else 2 if name in TAKE_TWO else 0


def finds_its_images(words):
    """Whether no command reaches below the images that this case has pushed."""
    images = 0
    for index, word in enumerate(words):
        name = word.lstrip("-").split(":")[0]
        if word.startswith("in/"):
            images += 1
        elif word.startswith("-") and name in ("create", "pattern", "kernel", "dup"):
            images += 1
        elif word.startswith("-"):
            needed = takes(name, word, words[min(index + 1, len(words) - 1)])
            if needed > images:
                return False
            images -= max(needed - 1, 0) if name not in ("swap",) else 0
    return True


def prefix_of(case):
    return PREFIX.match(case.line).group()


def can_join(case):
    rest = case.line[len(prefix_of(case)):]
    words = Case(case.name, rest).command_lines()
    if (case != Case(case.name, case.line) or case.name.split("-")[0] not in JOINABLE
            or len(words) > 1 or rest.count(" -o out.") != 1):
        return False
    return (re.search(r" -o out\.\w+$", rest) is not None and finds_its_images(words[0])
            and re.match(r"in/|--(create|pattern|kernel) ", rest) is not None
            and not Case(case.name, rest).commands() & LEAVE_STATE)


def join(cases):
    prefix = prefix_of(cases[0])
    lines = [re.sub(r"-o out(\.\w+)$", rf"-o {case.name}\1", case.line[len(prefix):])
             for case in cases]
    return Case(f"{cases[0].name}+{len(cases) - 1}", prefix + " ".join(lines))


def joined(cases):
    """The cases, those that can be joined as groups of AT_ONCE."""
    groups, alone = {}, []
    for case in cases:
        if can_join(case):
            groups.setdefault((case.name.split("-")[0], prefix_of(case)), []).append(case)
        else:
            alone.append(case)
    for group in groups.values():
        alone += [join(group[i:i + AT_ONCE]) for i in range(0, len(group), AT_ONCE)]
    return alone
