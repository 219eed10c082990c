# SPDX-License-Identifier: BSD-3-Clause
"""How shown output is compared with printed output, and renewed."""

import sys

import markdown
import pytest

sys.path.insert(0, str(markdown.ROOT / "src" / "scripts"))
import remake_outputs  # noqa: E402  # pylint: disable=wrong-import-position

PAGE = """# Page

```sh
echo one
false
echo $?
```

    one
    1

Run `tonetool --version` and `not this`.

| a | `tonetool a \\| b` |

```sh
echo "mean 0.25"; echo more; echo last
```

<!-- within 0.2 -->
```text
mean 0.26
...
```
"""


@pytest.fixture
def page(tmp_path):
    (tmp_path / "page.md").write_text(PAGE)
    return tmp_path


def test_blocks_and_their_outputs(page):
    first, second = markdown.blocks("page.md", page)
    assert first.commands() == ["echo one", "false", "echo $?"]
    assert first.shown == ["one", "1"] and first.line == 4 and first.within is None
    assert second.shown == ["mean 0.26", "..."] and second.within == 0.2
    assert [block.text for block in markdown.inline("page.md", page)] == ["tonetool --version\n", "tonetool a | b\n"]


def test_a_block_runs_in_a_shell(page, program):
    first, second = markdown.blocks("page.md", page)
    markdown.fill(page, program)
    ran = markdown.run(first, program, page)
    assert ran.statuses == [0, 1, 0] and not ran.failed and ran.lines == ["one", "1"]
    assert markdown.run(second, program, page).lines == ["mean 0.25", "more", "last"]


def test_a_command_that_fails_is_named(page, program):
    markdown.fill(page, program)
    for text in ("true\nfalse\n", "exit 3\ntrue\n"):
        block = markdown.Block("page.md", 1, text)
        assert markdown.run(block, program, page).failed


@pytest.mark.parametrize("shown, printed", [
    ("mean 0.267735", "mean 0.267736"),
    ("from -7.7824 to 1e-05", "from -7.7823 to 1.01e-05"),
    ("... 0.5 in ...", "so 0.50001 in all"),
    ("p99.9 0.667698 (a/test.0001.exr)", "p99.9 0.667699 (a/test.0001.exr)"),
])
def test_lines_that_are_the_same(shown, printed):
    assert markdown.same_line(shown, printed)


@pytest.mark.parametrize("shown, printed", [
    ("mean 0.267735", "mean 0.268736"),
    ("mean 0.267735", "mean 0.267735 and"),
    ("count 12", "count 13"),
    ("p99.9 0.667698 (a/test.0001.exr)", "p99.9 0.667698 (a/test.0002.exr)"),
    ("p99.9 0.5", "p99.8 0.5"),
    ("... 0.5 in ...", "so 0.6 in all"),
    ("version 0.1.0", "version 0.1.1"),
])
def test_lines_that_are_not(shown, printed):
    assert not markdown.same_line(shown, printed)


@pytest.mark.parametrize("shown, same", [
    ("a b c d", True), ("a ... d", True), ("... b ... d", True), ("a ...", True), ("... a b c d", True),
    ("a b c", False), ("b ...", False), ("... c", False), ("a c d", False), ("... d ... a ...", False)])
def test_gaps_are_where_dots_are(shown, same):
    assert markdown.same_output(shown.split(), list("abcd")) is same


def test_stated_tolerance():
    assert markdown.same_line("error 0.0012", "error 0.00101", 0.2)
    assert not markdown.same_line("error 0.0012", "error 0.0009", 0.2)


@pytest.mark.parametrize("shown, printed, made", [
    ("a 0.5|b", "a 0.7|b|c", "a 0.7|b|c"),
    ("mean 0.5|...|verdict passed 3", "mean 0.6|x|y|z|verdict passed 4|", "mean 0.6|...|verdict passed 4|..."),
    ("...|verdict passed ...", "mean|verdict passed 4", "...|verdict passed ..."),
    ("gone|...|lost", "only|these", "only|these"),
    ("gone|...", "1|2|3|4|5|6|7|8|9|10", "1|2|3|...|10"),
])
def test_remaking(shown, printed, made):
    assert remake_outputs.remade(shown.split("|"), printed.split("|")) == made.split("|")
