# SPDX-License-Identifier: BSD-3-Clause
"""What others wrote is named, and its licences go with every copy of it."""

import html
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
THIRD_PARTY = (ROOT / "src" / "THIRD_PARTY.md").read_text(encoding="utf-8")
MIT = "The above copyright notice and this permission notice shall be included in all"


def section(name):
    """The text below a heading."""
    return re.search(rf"^## {re.escape(name)}\n(.*?)(?=^## |\Z)", THIRD_PARTY, re.M | re.S).group(1)


def words(text):
    return text.replace("```text", " ").replace("```", " ").split()


def test_licenses_prints_both_files(tonetool):
    licence = (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert tonetool("--licenses").out == f"{licence}\n{THIRD_PARTY}\n"


def test_every_library_that_is_built_in_is_named():
    lines = (ROOT / "src/scripts/packages.txt").read_text(encoding="utf-8").splitlines()
    packages = {line.split("#")[0].strip() for line in lines}
    libraries = {name for name in packages if name.endswith("-dev") or name.startswith("libjs-")}
    assert len(libraries) >= 6
    assert not {name for name in libraries if f"`{name}`" not in THIRD_PARTY}


def test_texts_are_there():
    for name in ("Chart.js", "@kurkle/color", "nlohmann/json"):
        assert MIT in section(name) and "opyright" in section(name).split("```")[0], name
    assert "Apache License" in section("Highway") and "END OF TERMS" in section("Highway")
    assert "Neither the name" in section("OpenImageIO, OpenColorIO, Imath, OpenEXR")


def test_the_page_holds_the_licences_of_its_parts(tonetool, testimages, tmp_path):
    tonetool(testimages / "cornell_ref.exr", testimages / "cornell_test.exr", "--hdrflip",
             "--report", "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    (shown,) = re.findall(r'<details class="licences"><summary>[^<]*</summary>\s*<pre>([^<]*)</pre>',
                          page)
    shown = words(html.unescape(shown))
    for name in ("Chart.js", "@kurkle/color"):
        # The page names no other place, not even in a text.
        expected = [name, *words(re.sub("https?://", "", section(name)))]
        assert any(shown[i:i + len(expected)] == expected for i in range(len(shown))), name
    # The notices of the versions that are in the page.
    assert re.search(r"Chart\.js v[34]\.", page) and re.search(r"@kurkle/color v0\.", page)


def test_the_citation_is_of_this_version(tonetool):
    citation = (ROOT / ".github/CITATION.cff").read_text(encoding="utf-8")
    version = tonetool("--version").out.splitlines()[0]
    assert re.findall(r"^version: (.*)$", citation, re.M) == [version]
