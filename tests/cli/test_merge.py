# SPDX-License-Identifier: BSD-3-Clause
"""--merge of very many parts: how they are named, what they come to, and files of other versions."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import jsonschema
import numpy as np
import pytest

SCHEMA = Path(__file__).resolve().parents[2] / "src" / "sequence" / "check.schema.json"
FROZEN = Path(__file__).resolve().parent / "check_version_1.json"


@pytest.fixture
def parts(tonetool, make_image, tmp_path):
    """Six frames of --qc, the fourth with a NaN, as one file and in parts of one."""
    for number in range(1, 7):
        pixels = np.random.default_rng(number).random((12, 16, 3)) + 0.1
        if number == 4:
            pixels[3, 5] = np.nan
        make_image(f"a.{number:04d}.exr", pixels=pixels)
    (tmp_path / "p").mkdir()
    tonetool("a.#.exr", "--qc", "--json", "whole.json", "--csv", "whole.csv", status=3)
    for number in range(1, 7):
        tonetool("--frames", str(number), "a.#.exr", "--qc", "--exit-zero", "--json",
                 f"p/{number}.json")
    return tmp_path


def load(path):
    return json.loads(path.read_text(encoding="utf-8"))


NAMED = {"files": ["--merge", *(f"p/{n}.json" for n in range(1, 7))], "folder": ["--merge", "p"],
         "pattern": ["--merge", "p/?.json"], "patterns": ["--merge", "p/[4-6].jso*", "p/[1-3].json*"],
         "list": ["--merge-list", "list.txt"], "lists": ["--merge", "p/1.json", "--merge-list", "rest.txt"]}


@pytest.mark.parametrize("how", NAMED)
def test_any_way_to_name_the_parts_gives_the_bytes_of_the_single_run(tonetool, parts, how):
    (parts / "list.txt").write_text("p/[12].*\np\n".replace("p\n", "p/3.json\r\n\np/[4-6]*\n"))
    (parts / "rest.txt").write_text("".join(f"p/{n}.json\n" for n in range(6, 1, -1)))
    tonetool(*NAMED[how], "--json", "c.json", "--csv", "c.csv", status=3)
    assert (parts / "c.json").read_bytes() == (parts / "whole.json").read_bytes()
    assert (parts / "c.csv").read_bytes() == (parts / "whole.csv").read_bytes()


def test_the_standard_input_names_parts(program, parts):
    names = "\n".join(str(file) for file in sorted((parts / "p").iterdir()))
    ran = subprocess.run([program, "--merge-list", "-", "--frames", "1-7", "--json", "-"], input=names,
                         cwd=parts, capture_output=True, text=True, check=False, timeout=60)
    found = json.loads(ran.stdout)
    assert ran.returncode == 1 and [f["frame"] for f in found["frames"]] == list(range(1, 8))
    assert found["frames"][6]["message"] == "no part has a result of this frame"


@pytest.mark.parametrize("words, text", [
    (["--merge", "empty"], 'no *.json in the folder "empty"'),
    (["--merge", "q/*.json"], 'no file matches "q/*.json"'),
    (["--merge-list", "gone.txt"], 'no file "gone.txt"'),
    (["--merge-list"], "missing argument FILE"),
    (["--merge", "p", "--json", "p/4.json"], "is read, and would be written over"),
    (["--merge", "p", "--json:record=0", "c.json"], '--json has no modifier "record" (valid: records)'),
    (["--merge", "p", "--json:records=no", "c.json"], 'records "no"'),
])
def test_errors(tonetool, parts, words, text):
    (parts / "empty").mkdir()
    before = (parts / "p" / "4.json").read_bytes()
    assert text in tonetool(*words, *([] if "--json" in "".join(words) else ["--json", "c.json"]),
                            status=1).err
    assert not (parts / "c.json").exists() and (parts / "p" / "4.json").read_bytes() == before


def test_results_without_records(tonetool, parts):
    tonetool("--merge", "p", "--json:records=0", "c.json", status=3)
    whole, found = load(parts / "whole.json"), load(parts / "c.json")
    jsonschema.validate(found, load(SCHEMA))
    assert found.pop("records") is False
    for frame in whole["frames"]:
        assert frame.pop("qc")
    assert found == whole
    assert (parts / "c.json").stat().st_size < (parts / "whole.json").stat().st_size / 5
    ran = tonetool("--merge", "c.json", status=1)
    assert '"c.json": was written by --json:records=0' in ran.err
    tonetool("a.#.exr", "--qc", "--json:records=0", "d.json", status=3)
    assert (parts / "d.json").read_bytes() == (parts / "c.json").read_bytes()


def test_records_that_another_program_has_laid_out_anew(tonetool, parts):
    for file in (parts / "p").iterdir():
        file.write_text(json.dumps(load(file), indent=4 if file.stem < "4" else None))
    tonetool("--merge", "p", "--json", "c.json", status=3)
    assert (parts / "c.json").read_bytes() == (parts / "whole.json").read_bytes()


@pytest.mark.parametrize("change, text", [
    (lambda text: text[:-30], '"p/2.json": '),
    (lambda text: text.replace('"qc": {', '"qc": {{', 1), '"p/2.json": '),
    (lambda text: text.replace('"cells": "', '"cells": ["', 1), '"p/2.json": '),
    (lambda text: text.replace('"cells": "', '"cells": "AAAA', 1), "not what --qc measured"),
    (lambda text: text.replace('"cells"', '"cell"', 1), "not what --qc measured"),
    (lambda text: text.replace('"qc": {', '"qc": 7, "q": {', 1), "not what --qc measured"),
])
def test_damaged_parts(tonetool, parts, change, text):
    part = parts / "p" / "2.json"
    part.write_text(change(part.read_text()))
    ran = tonetool("--merge", "p", "--json", "c.json", status=1)
    assert text in ran.err and '"p/2.json"' in ran.err
    ran = tonetool("--merge", "p", "--frames", "1-6", "--json", "c.json", status=1)
    assert load(parts / "c.json")["frames"][1]["status"] == "error"

# ---- what no part has

@pytest.mark.parametrize("there, lacking", [((1, 2, 5, 6), [3, 4]), ((1, 2, 4), [3]), ((1, 3), [2]),
                                            ((1, 3, 5), []), ((2, 5), [3, 4]), ((6,), [])])
def test_a_frame_between_those_of_the_parts_is_missed(tonetool, parts, there, lacking):
    """As one is that both sides of a sequence lack: a job of the farm that never ran has not passed."""
    files = [f"p/{number}.json" for number in there]
    ran = tonetool("--merge", *files, "--json", "c.json", status=1 if lacking else 3 if 4 in there else 0)
    found = load(parts / "c.json")
    assert [frame["frame"] for frame in found["frames"] if frame["status"] == "error"] == lacking
    for frame in found["frames"]:
        if frame["frame"] in lacking:
            assert frame["message"] == ("no part has a result of this frame (valid: --frames, if it is not to "
                                        "be there)")
    assert f"{len(lacking)} error" in ran.out if lacking else "error" not in ran.out
    listed = ",".join(map(str, there))
    gap_of_qc = there == (1, 2, 5, 6)
    tonetool("--merge", *files, "--frames", listed, "--json", "c.json", status=3 if 4 in there or gap_of_qc else 0)
    assert [frame["frame"] for frame in load(parts / "c.json")["frames"]] == list(there)

# ---- parts of another day

def later(file, part):
    """As if the file had been rendered a second after the part was made."""
    made = part.stat().st_mtime_ns
    os.utime(file, ns=(made + 10**9, made + 10**9))


def test_a_frame_that_was_rendered_after_its_part_is_an_error(tonetool, parts):
    later(parts / "a.0005.exr", parts / "p" / "5.json")
    for words in ([], ["--frames", "1-6"]):
        ran = tonetool("--merge", "p", *words, "--json", "c.json", status=1)
        assert "1 error, 1 failed, 4 passed" in ran.out
        assert load(parts / "c.json")["frames"][4]["message"] == (
            '"a.0005.exr" was written after the part "p/5.json" (valid: a part that is made again)')
    tonetool("--merge", "p/5.json")  # an old result, printed again
    tonetool("--merge", "p/5.json", "--frames", "5", status=1)  # a part of what is said to be there
    tonetool("--frames", "5", "a.#.exr", "--qc", "--json", "p/5.json")
    os.utime(parts / "a.0005.exr")
    later(parts / "p" / "5.json", parts / "a.0005.exr")
    assert "1 failed, 5 passed" in tonetool("--merge", "p", status=3).out


def test_a_part_that_found_a_fault_keeps_it(tonetool, parts):
    (parts / "a.0004.exr").rename(parts / "gone.exr")
    tonetool("--frames", "4", "a.#.exr", "--qc", "--exit-zero", "--json", "p/4.json")
    (parts / "gone.exr").rename(parts / "a.0004.exr")
    later(parts / "a.0004.exr", parts / "p" / "4.json")
    assert "1 missing, 5 passed" in tonetool("--merge", "p", status=1).out


# ---- versions

def test_a_file_of_version_1_is_refused(tonetool, tmp_path):
    """What --qc kept of a frame was another."""
    assert load(FROZEN)["version"] == 1
    shutil.copy(FROZEN, tmp_path / "part.json")
    ran = tonetool("--merge", "part.json", "--json", "c.json", status=1)
    assert '"part.json": is of version 1, this program reads 2' in ran.err
    assert not (tmp_path / "c.json").exists()


@pytest.mark.parametrize("measured_by, said", [("tonetool 9.9.9", "tonetool 9.9.9"),
                                           (None, "a version that does not say which")])
def test_parts_that_two_versions_measured_are_refused(tonetool, parts, measured_by, said):
    """Numbers and rules of two versions may differ, and one verdict would hide which frames are of which."""
    part = parts / "p" / "2.json"
    own = load(part)["program"]
    assert own == "tonetool " + tonetool("--version").out.splitlines()[0]
    changed = {key: value for key, value in load(part).items() if key != "program"}
    part.write_text(json.dumps({**changed, **({"program": measured_by} if measured_by else {})}))
    ran = tonetool("--merge", "p", "--json", "c.json", status=1)
    assert f'p/2.json" was made by {said}' in ran.err and f'p/1.json" by {own}' in ran.err
    assert "(valid: parts of one version)" in ran.err
    assert not (parts / "c.json").exists()
    tonetool("--merge", "p/2.json", "--json", "c.json")
    assert load(parts / "c.json").get("program") == measured_by


@pytest.mark.parametrize("version, text", [(3, "is of version 3, this program reads 2"),
                                           (0, "is of version 0, this program reads 2"),
                                           ("1", "not a whole number")])
def test_files_of_other_versions_are_refused(tonetool, parts, version, text):
    part = parts / "p" / "2.json"
    part.write_text(json.dumps({**load(part), "version": version}))
    ran = tonetool("--merge", "p/2.json", "--json", "c.json", status=1)
    assert '"p/2.json": ' in ran.err and text in ran.err
    assert not (parts / "c.json").exists()


# ---- a long shot

def test_two_thousand_parts(program, parts, plain_memory):
    """A fifth of a long shot. The facts of a frame take about 25 kB of memory, its text and what
    the rules compute of it as much again."""
    text = (parts / "p" / "1.json").read_text()
    many = parts / "many"
    many.mkdir()
    for number in range(1, 2001):
        new = json.loads(text)
        frame = new["frames"][0]
        frame["frame"] = number
        new["worst"] = [{"frame": number}] if new["worst"] else []
        frame["qc"]["picture"]["hash"] = f"{number:032x}"
        (many / f"{number}.json").write_text(json.dumps(new, indent=1))
    script = ("import resource, subprocess, sys; done = subprocess.run(sys.argv[1:]); "
              "used = resource.getrusage(resource.RUSAGE_CHILDREN); "
              "print(used.ru_utime + used.ru_stime, used.ru_maxrss); sys.exit(done.returncode)")
    def measured(*words):
        ran = subprocess.run([sys.executable, "-c", script, program, *words], cwd=parts, check=False,
                             capture_output=True, text=True, timeout=120)
        assert ran.returncode in (0, 3), ran.stderr
        return [float(word) for word in ran.stdout.splitlines()[-1].split()]
    _, few_kilobytes = measured("--merge", "many/1.json", "--json", "few.json")
    _, kilobytes = measured("--merge", "many", "--json", "many.json", "--csv", "many.csv")
    assert kilobytes - few_kilobytes < 2000 * 50
    assert len(load(parts / "many.json")["frames"]) == 2000


@pytest.mark.parametrize("kind", ["link", "folder", "fifo"])
def test_what_looks_like_a_part_of_a_folder_is_one(tonetool, make_image, tmp_path, kind):
    make_image("a.exr")
    (tmp_path / "parts").mkdir()
    tonetool("a.exr", "--qc", "--json", "parts/1.json")
    tonetool("--merge", "parts")
    part = tmp_path / "parts" / "2.JSON"
    {"link": lambda: part.symlink_to("/nowhere/2.json"), "folder": part.mkdir,
     "fifo": lambda: os.mkfifo(part)}[kind]()
    assert '2.JSON" is no file that can be read' in tonetool("--merge", "parts", status=1).err
