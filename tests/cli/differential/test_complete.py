# SPDX-License-Identifier: BSD-3-Clause
"""What oiiotool takes against the tables, and the registry against both: no command or modifier
without a case, no command without help and an error case."""

import json
import os
import subprocess
from collections import Counter

import pytest
from cases import CASES
from stock_surface import (EXPRESSIONS, HIDDEN, SHARED, all_commands, all_modifiers,
                           declared_commands, listed_commands)
from versions import not_taken

# Only tonetool has these; tests/cli/test_*.py run them.
OWN_COMMANDS = set("""suite only key approve reason by again retire approved accept against dry-run merge-list bad-frames exit-zero table github summary images ctest figure biascheck noisefloor hdrflip ldrflip flipdiff exposure bloom calibrate tonemap cgtmo lightindex errormap
    tmqi luminancestats qc exportlut report json csv junit contactsheet pictures state statistics
    merge doctor licenses h compat progress parallel-frames memory warnings-exit filmstrip tonecurves""".split())

# Only tonetool has these of a command that both have.
OWN_MODIFIERS = {("colormap", "bar"), ("diff", "ignore"), ("diff", "mask"), ("pdiff", "ignore"), ("pdiff", "mask")}

OWN_TEXT = {"help"}     # each program's help is its own

# These are in oiiotool as well, since a version that is newer than tonetool's model.
NEWER = {"history": (3, 0), "no-history": (3, 0), "parallel-frames": (2, 5), "flipdiff": (3, 1)}
NEWER_HIDDEN = {"test-bad-format": (3, 1)}


@pytest.fixture(scope="module")
def registry():
    done = subprocess.run([os.environ["TONETOOL"], "--help=json"], capture_output=True, text=True,
                          check=True)
    return json.loads(done.stdout)


def lacking(registry, has):
    return [command["names"][0] for command in registry
            if not set(command["names"]) & (OWN_COMMANDS | OWN_TEXT)
            and not set(command["names"]) <= set(NEWER) and not has(command)]


def test_every_command_of_oiiotool_is_there(registry, stock_program, stock_version):
    names = {name for command in registry for name in command["names"]}
    assert all_commands(stock_program) - names == not_taken(stock_version)[0]


def test_own_commands_are_not_oiiotools(stock_program, stock_version):
    since = {name for name, version in NEWER.items() if stock_version >= version}
    assert not ((OWN_COMMANDS | set(NEWER)) & all_commands(stock_program)) - since


def test_hidden_commands_are_those_that_the_binary_declares_beside_its_help(stock_program, stock_version):
    newer = {name for name, version in NEWER_HIDDEN.items() if stock_version >= version}
    assert declared_commands(stock_program) - listed_commands(stock_program) == HIDDEN | newer


def test_every_modifier_of_oiiotool_is_there(registry, stock_program, stock_version):
    taken = {(name, modifier["key"]) for command in registry for name in command["names"]
             for modifier in command["modifiers"]}
    assert all_modifiers(stock_program) - taken == not_taken(stock_version)[1]


def test_every_command_has_help(registry):
    assert not [command["names"] for command in registry if not command["help"].strip()]
    assert not [(command["names"][0], modifier["key"]) for command in registry
                for modifier in command["modifiers"] if not modifier["help"].strip()]


def test_every_command_has_two_differential_cases(registry):
    used = Counter(name for case in CASES for name in case.commands())
    assert not lacking(registry, lambda row: sum(used[name] for name in row["names"]) >= 2)


def test_every_command_has_an_error_case(registry):
    used = {name for case in CASES if case.status for name in case.commands()}
    assert not lacking(registry, lambda row: used & set(row["names"]))


def test_every_modifier_has_a_differential_case(registry):
    used = {one for case in CASES for one in case.modifiers()}
    unused = {(row["names"][0], modifier["key"]) for row in registry
              if not set(row["names"]) & OWN_COMMANDS for modifier in row["modifiers"]
              if modifier["key"] not in SHARED
              and not used & {(name, modifier["key"]) for name in row["names"]}}
    assert unused == OWN_MODIFIERS


def test_every_command_of_oiiotool_has_a_case(stock_program, stock_version):
    """Needs no registry: what oiiotool takes is what the tables run."""
    used = Counter(name for case in CASES for name in case.commands())
    without = OWN_TEXT | set(NEWER) | not_taken(stock_version)[0]
    assert not {name for name in listed_commands(stock_program) - without if used[name] < 2}
    assert not HIDDEN - set(used)


def test_every_modifier_of_oiiotool_has_a_case(stock_program, stock_version):
    used = {one for case in CASES for one in case.modifiers()}
    without = {(name, key) for name, key in all_modifiers(stock_program) if name in NEWER}
    assert not all_modifiers(stock_program) - used - without - not_taken(stock_version)[1]


def test_every_word_of_expressions_has_a_case():
    text = " ".join(case.line for case in CASES)
    assert not [word for word in EXPRESSIONS if word not in text]
