# SPDX-License-Identifier: BSD-3-Clause
"""--accept: faults that somebody lets pass."""

import json
import shutil

import pytest

QC = ["-q", "test.#.exr", "--qc"]


@pytest.fixture
def anim(tmp_path, testimages):
    """Seven frames; one light group of frame 5 is black."""
    for file in (testimages / "anim").glob("test.*.exr"):
        shutil.copy(file, tmp_path / file.name)
    return tmp_path


def accepted(folder, check, *faults, name="accepted.json"):
    found = [{"frame": frame, "code": code, "by": "Ann", "why": "asked for"}
             for frame, code in faults]
    (folder / name).write_text(json.dumps({"check": check, "accepted": found}))


def result(folder, name):
    return json.loads((folder / name).read_text())


def test_an_accepted_fault_passes(tonetool, anim):
    line = ["--frames", "4-7", *QC]
    tonetool(*line, "--json", "first.json", status=3)
    first = result(anim, "first.json")
    accepted(anim, first["id"], (5, "blacklayer"))
    ran = tonetool(*line, "--accept", "accepted.json", "--json", "second.json", "--bad-frames", "bad")
    second = result(anim, "second.json")
    assert second["id"] == first["id"]
    assert [frame["status"] for frame in first["frames"]].count("failed") == 1
    assert [frame["status"] for frame in second["frames"]].count("failed") == 0
    (fault,) = [fault for fault in second["frames"][1]["faults"] if fault["code"] == "blacklayer"]
    assert fault["severity"] == "info"
    assert fault["sentence"].startswith("accepted by Ann (asked for): ")
    assert "frame 5: info blacklayer: accepted by Ann" in ran.out
    assert "WARNING" not in ran.err
    assert (anim / "bad").read_text().strip() == ""


def test_parts_and_a_merge(tonetool, anim):
    tonetool("--frames", "1-7", *QC, "--json", "whole.json", status=3)
    accepted(anim, result(anim, "whole.json")["id"], (5, "blacklayer"))
    tonetool("--frames", "1-7", *QC, "--accept", "accepted.json", "--json", "whole.json")
    for first, last in ((1, 3), (4, 7)):
        tonetool("--frames", f"{first}-{last}", *QC, "--json", f"{first}.json", status=0 if last < 5 else 3)
    tonetool("--merge", "1.json", "4.json", status=3, *["--json", "plain.json"])
    tonetool("--merge", "1.json", "4.json", "--accept", "accepted.json", "--json", "merged.json")
    assert (anim / "merged.json").read_bytes() == (anim / "whole.json").read_bytes()
    # What parts have accepted is accepted in what they are merged to.
    tonetool("--frames", "4-7", *QC, "--accept", "accepted.json", "--json", "4.json")
    tonetool("--merge", "1.json", "4.json", "--json", "again.json")
    assert (anim / "again.json").read_bytes() == (anim / "whole.json").read_bytes()


def test_what_is_not_there_is_said(tonetool, anim):
    tonetool("--frames", "4-7", *QC, "--json", "first.json", status=3)
    accepted(anim, result(anim, "first.json")["id"], (5, "blacklayer"), (6, "blacklayer"), (99, "nan"))
    ran = tonetool("--frames", "4-7", *QC, "--accept", "accepted.json")
    assert "--accept: frame 6: blacklayer is accepted, but there is no such fault" in ran.err
    assert "--accept: 1 of 3 accepted faults is of frames that were not checked here" in ran.err


def test_a_file_of_another_check_or_no_file_is_an_error_before_the_work(tonetool, anim):
    line = ["--frames", "4-7", *QC, "--accept", "accepted.json"]
    accepted(anim, "0123456789abcdef", (5, "blacklayer"))
    ran = tonetool(*line, status=1)
    assert "accepts faults of another check: it is of 0123456789abcdef" in ran.err
    assert "qc:" not in ran.out
    for text, why in (("{", "valid: a file that the report's page exports"),
                      ('{"accepted": []}', 'has no "check" and "accepted"'),
                      ('{"check": "x", "accepted": [{"frame": 5}]}', "accepted/0")):
        (anim / "accepted.json").write_text(text)
        ran = tonetool(*line, status=1)
        assert why in ran.err and "--accept:" in ran.err
        assert "qc:" not in ran.out
    (anim / "accepted.json").unlink()
    assert "could not read" in tonetool(*line, status=1).err
    tonetool("--frames", "4-7", *QC, "--json", "part.json", status=3)
    (anim / "accepted.json").write_text("{")
    ran = tonetool("--merge", "part.json", "--accept", "accepted.json", status=1)
    assert "valid: a file that the report's page exports" in ran.err


def test_it_is_not_written_over(tonetool, anim):
    accepted(anim, "x", (5, "blacklayer"))
    ran = tonetool("--frames", "4-7", *QC, "--accept", "accepted.json", "--json", "accepted.json", status=1)
    assert '"accepted.json" is read, and would be written over' in ran.err
