# SPDX-License-Identifier: BSD-3-Clause
"""The fixture tonetool_check, in sessions of pytest of their own, which find the plug-in by its entry point."""

import importlib.metadata
import importlib.util
import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

ROOT = Path(__file__).resolve().parents[2]
PAIR = [str(ROOT / "testimages" / f"cornell_{name}.exr") for name in ("ref", "test")]

HEAD = """
import os, subprocess, sys
import numpy as np
import OpenImageIO as oiio
import pytest

def grey(value):
    return np.full((24, 32, 3), value, np.float32)
"""
TEST = """
def test_{name}(tonetool_check):
    tonetool_check(grey({value}), fail="{fail}")
"""


def looks(*names, value=0.5, fail="mean=0.1"):
    return HEAD + "".join(TEST.format(name=name, value=value, fail=fail) for name in names)


def session(folder, words):
    """Becomes a session of pytest that prints into two files, and ends this process with its status."""
    status = 3  # of pytest's own errors
    try:
        os.chdir(folder)
        for descriptor, name in ((1, "out"), (2, "err")):
            os.dup2(os.open(f"{name}.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644), descriptor)
        sys.stdout, sys.stderr = (open(descriptor, "w", encoding="utf-8", closefd=False) for descriptor in (1, 2))
        sys.__stdout__, sys.__stderr__ = sys.stdout, sys.stderr
        sys.path.insert(0, str(folder))  # as python -m pytest has it
        signal.alarm(120)
        status = int(pytest.main([f"--basetemp={folder}/base", *map(str, words)]))
        sys.stdout.flush()
        sys.stderr.flush()
    finally:
        os._exit(status)


@pytest.fixture
def run(pytester):
    """Writes test_looks.py, if there is text, and runs pytest. In a copy of this process, which has loaded all
    libraries: to load them takes longer than a session."""

    def run_pytest(text=None, *words):
        if text is not None:
            pytester.makepyfile(test_looks=text)
        begun = time.monotonic()
        child = os.fork()
        if child == 0:
            session(pytester.path, words)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        assert status >= 0, f"pytest ended by signal {-status}"
        lines = [(pytester.path / f"{name}.txt").read_text(encoding="utf-8").splitlines() for name in ("out", "err")]
        return pytest.RunResult(status, *lines, time.monotonic() - begun)

    return run_pytest


@pytest.fixture
def shell(pytester):
    """Runs a command line that was printed, WHY filled in, in the folder where it was."""

    def run_line(line):
        words = shlex.split(line.partition(": ")[2].replace("WHY", "seen"))
        assert words.pop(0) == "tonetool"
        done = subprocess.run([os.environ["TONETOOL"], *words, "--by", "Ada"], cwd=pytester.path, text=True,
                              capture_output=True, timeout=60, check=False)
        assert done.returncode == 0, done.stdout + done.stderr

    return run_line


@pytest.fixture
def approved(run, shell):
    """A session, after which what it says to type is typed."""

    def approve(text, *words):
        result = run(text, *words)
        shell([line for line in result.outlines if line.startswith("to approve")][-1])
        return result

    return approve


@pytest.fixture
def names(pytester):
    """Of the cases of the only run.json, and their statuses."""

    def read():
        (output,) = pytester.path.glob("tonetool-results/*/run.json")
        return {case["name"]: case["status"] for case in json.loads(output.read_text(encoding="utf-8"))["frames"]}

    return read


def said(result, *lines):
    """Sentences stand there, and no traceback."""
    result.stdout.fnmatch_lines([f"*{line}*" for line in lines])
    text = result.stdout.str() + result.stderr.str()
    assert "Traceback" not in text and "INTERNALERROR" not in text


# ---- from the first run to the next change

def test_first_run_fails_then_approved_passes_then_change_fails(run, approved, pytester):
    first = approved(looks("grey"))
    first.assert_outcomes(failed=1)
    said(first, "tonetool_check: test_looks/test_grey: missing: no approved image",
         "the image: tonetool-results/approved/test_looks/test_grey.exr",
         "to approve, after a look: tonetool --approve tonetool-results/approved/run.json test_looks/test_grey "
         "--reason 'WHY'")
    page = pytester.path / "page.html"
    green = run(None, "--tonetool-report", page)
    green.assert_outcomes(passed=1)
    assert green.ret == 0 and "test_grey" in page.read_text(encoding="utf-8")
    changed = run(looks("grey", value=0.05))
    changed.assert_outcomes(failed=1)
    said(changed, "test_grey: failed: hdrflip: mean * > 0.1",
         "pictures: *test_grey.reference.png, .test.png, .error.png")
    for kind in ("reference.png", "test.png", "error.png", "exr"):
        assert (pytester.path / f"tonetool-results/approved/test_looks/test_grey.{kind}").is_file()


def test_no_session_writes_into_the_store(run, approved, pytester):
    run(looks("grey"))
    assert not (pytester.path / "approved").exists()
    approved(None)
    before = {file: file.read_bytes() for file in (pytester.path / "approved").rglob("*") if file.is_file()}
    for text in (looks("grey"), looks("grey", value=0.05), looks("other")):
        run(text, "--tonetool-report", "page.html")
        assert before == {file: file.read_bytes() for file in (pytester.path / "approved").rglob("*")
                          if file.is_file()}


def test_all_that_failed_is_approved_by_one_line(run, approved, names):
    approved(looks("grey", "gray", "green")).assert_outcomes(failed=3)
    run().assert_outcomes(passed=3)
    assert names() == dict.fromkeys(["test_looks/test_gray", "test_looks/test_green", "test_looks/test_grey"], "passed")


def test_edited_baseline_fails(run, approved, pytester):
    approved(looks("grey"))
    (image,) = (pytester.path / "approved").rglob("*.exr")
    image.chmod(0o644)
    image.write_bytes(image.read_bytes() + b"x")
    edited = run()
    edited.assert_outcomes(failed=1)
    said(edited, "is not what was approved")


def test_baseline_edited_behind_a_test_fails_the_session(run, approved):
    approved(looks("grey") + """
def test_meanwhile():
    for file in __import__("pathlib").Path("approved").rglob("*.exr"):
        file.chmod(0o644)
        file.write_bytes(b"")
""")
    result = run()
    result.assert_outcomes(passed=2)
    said(result, "ERROR test_looks/test_grey: passed in its test, and now error: *is not what was approved")
    assert result.ret == 1


# ---- what is given

@pytest.mark.parametrize("image", [
    "grey(0.5)", "grey(0.5)[..., 0]", f"oiio.ImageBuf({PAIR[0]!r})",
    f"oiio.ImageBufAlgo.resize(oiio.ImageBuf({PAIR[0]!r}), roi=oiio.ROI(0, 48, 0, 48))", repr(PAIR[0]),
    f"__import__('pathlib').Path({PAIR[0]!r})"])
def test_images(run, approved, names, image):
    text = HEAD + f"def test_it(tonetool_check):\n    tonetool_check({image}, fail='max=0.0001')\n"
    approved(text)
    run().assert_outcomes(passed=1)
    assert names() == {"test_looks/test_it": "passed"}


def test_other_render_fails(run, approved):
    text = HEAD + "def test_it(tonetool_check):\n    tonetool_check({}, fail='mean=0.2')\n"
    approved(text.format(repr(PAIR[0])))
    for image in (repr(PAIR[1]), f"oiio.ImageBuf({PAIR[1]!r})"):
        result = run(text.format(image))
        result.assert_outcomes(failed=1)
        said(result, "hdrflip: mean 0.26* > 0.2")


UNREADABLE = {
    "'none.exr'": '"none.exr": No such file or directory',
    "'folder.exr'": '"folder.exr": Is a directory',
    "'cut.exr'": 'unreadable: cannot read "*test_2.exr": *',  # in the words of OpenEXR's version
    "'empty.exr'": "unreadable: *",
    "oiio.ImageBuf('cut.exr')": "*cut.exr*",
    "oiio.ImageBuf('none.exr')": "*none.exr*",
    "oiio.ImageBuf()": "*the image holds no pixels",
}


def calls_as_tests(calls):
    return HEAD + "".join(f"def test_{i}(tonetool_check):\n    tonetool_check({call})\n"
                          for i, call in enumerate(calls))


def test_unreadable_fails(run, approved, pytester):
    approved(calls_as_tests([f"{PAIR[0]!r}, fail='mean=0.2'"] * len(UNREADABLE)))
    (pytester.path / "cut.exr").write_bytes(Path(PAIR[0]).read_bytes()[:20000])
    (pytester.path / "empty.exr").touch()
    (pytester.path / "folder.exr").mkdir()
    result = run(calls_as_tests([f"{image}, fail='mean=0.2'" for image in UNREADABLE]))
    result.assert_outcomes(failed=len(UNREADABLE))
    said(result, *(f"tonetool_check: test_looks/test_{i}: {line}" for i, line in enumerate(UNREADABLE.values())))
    assert "to approve" not in result.stdout.str()


def test_unreadable_is_not_approved_in_a_first_run(run, pytester):
    (pytester.path / "cut.exr").write_bytes(Path(PAIR[0]).read_bytes()[:20000])
    result = run("def test_it(tonetool_check):\n    tonetool_check('cut.exr', fail='mean=0.2')\n")
    result.assert_outcomes(failed=1)
    said(result, "test_it: unreadable: cannot read")
    output = next(pytester.path.glob("tonetool-results/*/run.json"))
    done = subprocess.run([os.environ["TONETOOL"], "--approve", output, "*", "--reason", "seen"], cwd=pytester.path,
                          timeout=60, check=False)
    assert done.returncode == 1 and not list(pytester.path.glob("approved/*/*"))


WRONG = {
    "grey(1), fail=''": "ValueError: tonetool_check: no limit",
    "grey(1)": "ValueError: tonetool_check: no limit",
    "grey(1), fail=0.3": "ValueError: tonetool_check: the limit is 0.3 (valid: a string",
    "grey(1), fail='mena=0.3'": 'unknown quantity "mena"',
    "grey(1), fail='\\x7f'": "the program has no result",
    "grey(1)[0, 0], fail='mean=0.3'": "ValueError: write_image: image is a float32 array of shape (3,)",
    "grey(1).astype(np.float64), fail='mean=0.3'": "TypeError: tonetool_check: the image is of float64",
    "grey(1).astype(np.uint8), fail='mean=0.3'": "TypeError: tonetool_check: the image is of uint8",
    "oiio.ImageBuf(oiio.ImageSpec(8, 8, 3, 'uint8')), fail='mean=0.3'": "the image is of uint8",
    "None, fail='mean=0.3'": "TypeError: tonetool_check: the image is of NoneType",
    "'picture.png', fail='mean=0.3'": 'ValueError: tonetool_check: "picture.png" is no OpenEXR file',
    "'picture.exr', fail='mean=0.3'": 'ValueError: tonetool_check: "picture.exr" is no OpenEXR file',
    "grey(1), fail='mean=0.3', name='x' * 300": "File name too long",
}


def test_wrong_calls_fail(run, pytester):
    (pytester.path / "picture.exr").write_bytes(b"\x89PNG\r\n")
    result = run(calls_as_tests(WRONG))
    result.assert_outcomes(failed=len(WRONG))
    text = result.stdout.str().partition("= FAILURES =")[2]
    for part, error in zip(re.split(r"^_+ test_\d+ _+$", text, flags=re.M)[1:], WRONG.values()):
        assert error in part


SWALLOWED = """
    with ThreadPoolExecutor(2) as pool:
        [pool.submit(tonetool_check, {image}, fail="{fail}", name=f"view{{i}}") for i in range(2)]
""", """
    for i in range(2):
        try:
            tonetool_check({image}, fail="{fail}", name=f"view{{i}}")
        except BaseException:
            pass
"""


@pytest.mark.parametrize("body", SWALLOWED, ids=["threads", "caught"])
@pytest.mark.parametrize("image, fail, why", [("grey(0.05)", "mean=0.1", "failed: hdrflip: mean"),
                                              ("grey(1).astype(int)", "mean=0.1", "the image is of int64")])
def test_a_failed_call_that_nobody_sees_fails_the_session(run, approved, body, image, fail, why):
    test = HEAD + "from concurrent.futures import ThreadPoolExecutor\ndef test_pool(tonetool_check):" + body
    words = {"fail": fail}
    first = approved(test.format(image="grey(0.5)", **words))
    first.assert_outcomes(passed=1)
    assert first.ret == 1, "nothing was approved"
    assert run(None).ret == 0
    result = run(test.format(image=image, **words))
    result.assert_outcomes(passed=1)
    assert result.ret == 1
    said(result, *(f"ERROR *test_looks/view{i}: *{why}*but its test test_looks.py::test_pool has not failed"
                   for i in range(2)))


def test_a_failed_call_of_a_test_that_is_to_fail_is_told_once(run, approved):
    approved(looks("grey"))
    text = looks("grey") + "@pytest.mark.xfail\ndef test_x(tonetool_check):\n    tonetool_check(grey(1), fail='mean=0.1')\n"
    result = run(text)
    result.assert_outcomes(passed=1, xfailed=1)
    assert result.ret == 0 and "has not failed" not in result.stdout.str()


def test_an_image_without_a_result_is_not_approved(approved, names):
    approved(looks("grey") + "def test_it(tonetool_check):\n    tonetool_check(grey(1), fail='mena=0.3')\n")
    assert names() == {"test_looks/test_grey": "missing"}


# ---- names

def test_two_of_one_name_and_ids(run, names):
    result = run(HEAD + """
@pytest.mark.parametrize("text", ["a b", "a/b", "ä.c"])
def test_grey(tonetool_check, text):
    tonetool_check(grey(1), fail="mean=0.1")
""")
    result.assert_outcomes(failed=3)
    result.stdout.fnmatch_lines(["*ValueError: tonetool_check: two images are named test_looks/test_grey_a_b_*"])
    assert sorted(names()) == ["test_looks/test_grey__xe4.c_", "test_looks/test_grey_a_b_"]


def test_two_calls_of_one_test_need_names(run, approved, names):
    text = HEAD + """
def test_grey(tonetool_check):
    tonetool_check(grey(1), fail="mean=0.1")
    tonetool_check(grey(2), fail="mean=0.1"{})
"""
    approved(text.format(", name='../two'"))
    approved(text.format(", name='../two'"))
    result = run(text.format(", name='../two'"))
    result.assert_outcomes(passed=1)
    assert names() == {"test_looks/_._two": "passed", "test_looks/test_grey": "passed"}
    twice = run(text.format(""))
    twice.assert_outcomes(failed=1)
    twice.stdout.fnmatch_lines(["*two images are named test_looks/test_grey *"])


def test_wildcards_in_the_folder(run, approved, pytester, monkeypatch):
    folder = pytester.mkdir("a#b %N 'c")
    (folder / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    (folder / "test_looks.py").write_text(looks("grey"), encoding="utf-8")
    monkeypatch.chdir(folder)
    run().assert_outcomes(failed=1)
    monkeypatch.setattr(pytester, "_path", folder)
    approved(None)
    run(None, "--tonetool-report", "page.html").assert_outcomes(passed=1)
    assert (folder / "page.html").is_file()


def test_store_of_the_ini_file(run, approved, pytester, names):
    pytester.makeini("[pytest]\ntonetool_store = looks/good ones\n")
    for folder in ("a", "b"):
        pytester.mkdir(folder)
        (pytester.path / folder / f"test_{folder}.py").write_text(looks("grey"), encoding="utf-8")
    approved(None).assert_outcomes(failed=2)
    run(None, "--tonetool-report", "page.html").assert_outcomes(passed=2)
    assert sorted(names()) == ["test_a/test_grey", "test_b/test_grey"]
    assert len(list((pytester.path / "looks" / "good ones").rglob("*.exr"))) == 2
    (pytester.path / "b" / "test_b.py").unlink()
    gone = run()
    assert gone.ret == 1
    said(gone, "ERROR test_b/test_grey: approved, but no test checks it any more")
    assert run(None, "a").ret == 0  # b may be elsewhere, as far as this session knows


def test_page_of_several_stores_is_an_error(run, approved, pytester):
    for folder in ("a", "b"):
        pytester.mkdir(folder)
        (pytester.path / folder / f"test_{folder}.py").write_text(looks("grey"), encoding="utf-8")
        approved(None, folder)
    both = run(None, "--tonetool-report", "page.html")
    both.assert_outcomes(passed=2)
    assert both.ret == 1 and not (pytester.path / "page.html").exists()
    said(both, "ERROR --tonetool-report: no page, as the tests have 2 folders of approved images")
    assert run().ret == 0


def test_two_stores_of_one_folder_of_results_are_an_error(run, pytester):
    for file in ("a/b/test_one.py", "a_b/test_two.py"):
        (pytester.path / file).parent.mkdir(parents=True)
        (pytester.path / file).write_text(looks("grey"), encoding="utf-8")
    result = run()
    result.assert_outcomes(failed=2)
    result.stdout.fnmatch_lines(["*ValueError: tonetool_check: another folder of approved images is a_b_approved in*"])


# ---- the program

PROGRAMS = {
    "text": "text", "broken": "\0", "silent": "#!/bin/sh\n", "killed": "#!/bin/sh\nkill -9 $$\n",
    "liar": "#!/bin/sh\nwhile [ $1 != --json ]; do shift; done\necho '{}' >$2\n"}


@pytest.mark.parametrize("kind, sentence", [
    ("nowhere", "test_grey: the program tonetool is neither beside this module nor in PATH"),
    ("none", 'test_grey: the program "*/none" cannot be run: No such file or directory'),
    ("text", 'test_grey: the program "*/text" cannot be run: Permission denied'),
    ("broken", 'test_grey: the program "*/broken" cannot be run: Exec format error'),
    ("silent", "test_grey: the program has no result, exit status 0"),
    ("killed", "test_grey: the program has no result, exit status -9"),
    ("liar", "test_grey: the program has no result, exit status 0"),
])
def test_program_missing_is_an_error(run, approved, monkeypatch, pytester, kind, sentence):
    approved(looks("grey"))
    file = pytester.path / kind
    if kind in PROGRAMS:
        file.write_text(PROGRAMS[kind], encoding="utf-8")
        file.chmod(0o644 if kind == "text" else 0o755)
    monkeypatch.setenv("TONETOOL", str(file))
    if kind == "nowhere":
        monkeypatch.delenv("TONETOOL")
        monkeypatch.setenv("PATH", "")
    result = run()
    result.assert_outcomes(failed=1)
    said(result, sentence)
    assert result.ret == 1


def test_program_that_vanishes_fails_the_session(run, approved, pytester, monkeypatch):
    approved(looks("grey"))
    program = pytester.path / "program"
    program.symlink_to(os.environ["TONETOOL"])
    monkeypatch.setenv("TONETOOL", str(program))
    result = run(looks("grey") + "def test_meanwhile():\n    os.remove('program')\n")
    result.assert_outcomes(passed=2)
    said(result, 'ERROR the program "*/program" cannot be run: No such file or directory')
    assert result.ret == 1


def test_pytest_does_not_load_the_libraries(run):
    run("import sys\ndef test_it(pytestconfig):\n    assert pytestconfig.pluginmanager.has_plugin('pytest_tonetool')\n"
        "    assert 'tonetool' not in sys.modules\n").assert_outcomes(passed=1)


# ---- approved images without a test

GONE = "ERROR test_looks/test_grey: approved, but no test checks it any more"


def test_approved_name_without_a_test_fails_until_it_is_retired(run, approved, shell):
    approved(looks("grey", "kept"))
    gone = run(looks("kept"))
    gone.assert_outcomes(passed=1)
    said(gone, GONE, "to retire: tonetool --approve tonetool-results/approved/run.json test_looks/test_grey --retire")
    assert gone.ret == 1 and "test_kept: approved" not in gone.stdout.str()
    shell(next(line for line in gone.outlines if line.startswith("to retire")))
    assert run().ret == 0


@pytest.mark.parametrize("text", [HEAD + "def test_it():\n    pass\n", None])
def test_approved_names_of_which_no_test_is_left(approved, run, pytester, text):
    approved(looks("grey"))
    if text is None:
        (pytester.path / "test_looks.py").unlink()
        pytester.makepyfile(test_other=HEAD + "def test_it():\n    pass\n")
    gone = run(text)
    gone.assert_outcomes(passed=1)
    said(gone, GONE)
    assert gone.ret == 1


@pytest.mark.parametrize("more, words", [
    ("", ["-k", "kept"]), ("", ["test_looks.py::test_kept"]), ("", ["test_looks.py"]), ("", ["-m", "not slow"]),
    ("", ["--ignore", "test_looks.py"]), ("@pytest.mark.skip\ndef test_b(tonetool_check): pass\n", []),
    ("@pytest.mark.xfail\ndef test_b(tonetool_check): assert 0\n", []), ("def test_b(tonetool_check): pass\n", [])])
def test_a_session_that_cannot_know_says_nothing(approved, run, pytester, more, words):
    approved(looks("grey", "kept"))
    pytester.makepyfile(test_other="def test_it(): pass\n")
    slow = "@pytest.mark.slow\ndef test_slow(): pass\n" if "-m" in words else ""
    result = run(looks("kept") + more + slow, *words)
    assert result.ret == 0
    assert "approved, but" not in result.stdout.str()


def test_nor_does_a_session_that_stops(approved, run):
    approved(looks("kept", "grey"))
    grey = TEST.format(name="grey", value=0.5, fail="mean=0.1")
    result = run(looks("kept") + "def test_a(): assert 0\n" + grey, "-x")
    result.assert_outcomes(passed=1, failed=1)
    assert "approved, but" not in result.stdout.str()


def test_records_of_others_are_no_business_of_pytest(run, approved, pytester):
    approved(looks("grey"))
    (pytester.path / "approved" / "hair").mkdir()
    (pytester.path / "approved" / "hair" / "long.approved.json").write_text("{}", encoding="utf-8")
    (pytester.path / "approved" / "test_looks.approved.json").write_text("{}", encoding="utf-8")
    assert run().ret == 0


def test_expected_failure_stays_one(run):
    text = looks("grey").replace("def test", "@pytest.mark.xfail(strict=True)\ndef test")
    result = run(text)
    result.assert_outcomes(xfailed=1)
    assert result.ret == 0


# ---- what sessions leave

def test_run_of_an_earlier_session_does_not_stay(run, approved, pytester):
    output = pytester.path / "tonetool-results" / "approved" / "run.json"
    approved(looks("grey"))
    assert output.is_file()
    pytester.makepyfile(test_other="def test_it(): pass\n")
    run(None, "test_other.py")
    run(None, "--collect-only")
    assert output.is_file()  # no image was asked for
    result = run(looks("grey").replace("def test", "@pytest.mark.skip\ndef test"), "--tonetool-report", "page.html")
    result.assert_outcomes(skipped=1, passed=1)
    said(result, "--tonetool-report: no page, as no image was checked")
    assert result.ret == 0 and not output.exists()


def test_image_of_an_earlier_session_does_not_stay(run, names):
    run(looks("grey", "gray"))
    run(looks("grey"))
    assert list(names()) == ["test_looks/test_grey"]


def test_a_project_without_images_has_no_folder(run, pytester):
    run("def test_it(): pass\n").assert_outcomes(passed=1)
    assert not (pytester.path / "tonetool-results").exists()


def test_two_sessions_at_once_do_not_mix(approved, run, names, pytester):
    approved(looks("grey", "later"))
    killed = pytester.path / "tonetool-results" / ".session-killed"
    killed.mkdir()
    (killed / "alive").touch()
    result = run(looks("grey").replace("0.5", "0.5 - 0.4 * ('INNER' in os.environ)") + """
def test_inner():
    if "INNER" not in os.environ:
        done = subprocess.run([sys.executable, "-m", "pytest", "-k", "grey"], env={**os.environ, "INNER": "1"},
                              stdout=subprocess.PIPE, text=True)
        assert done.returncode == 1 and "test_grey: failed: hdrflip" in done.stdout, done.stdout
""" + TEST.format(name="later", value=0.5, fail="mean=0.1"))
    result.assert_outcomes(passed=3)
    assert names() == {"test_looks/test_grey": "passed", "test_looks/test_later": "passed"}
    assert not list((pytester.path / "tonetool-results").glob(".session-*"))


# ---- pytest-xdist

WORKERS = """
import os, subprocess, sys
import pytest

@pytest.hookimpl(tryfirst=True)
def pytest_configure(config):
    if "WORKER" in os.environ:
        config.workerinput = {"tonetool_session": os.environ["WORKER"]}

@pytest.hookimpl(tryfirst=True)
def pytest_runtestloop(session):
    if "WORKER" in os.environ:
        return None
    class Node:
        config, workerinput = session.config, {}
    session.config.hook.pytest_configure_node(node=Node)
    for choice in ("a", "b"):
        done = subprocess.run([sys.executable, "-m", "pytest", "-k", choice, "test_looks.py"], stdout=subprocess.PIPE,
                              env={**os.environ, "WORKER": Node.workerinput["tonetool_session"]})
        session.testsfailed += done.returncode != 0
    return True
"""


def test_parts_of_two_workers_are_one_run(run, pytester, names):
    """As pytest-xdist runs it: the session collects nothing, and its workers share its folder."""
    pytester.makeconftest(WORKERS)
    pytester.mkdir("none")
    result = run(looks("a", "b", "c"), "none")
    assert result.ret == 1
    assert names() == {"test_looks/test_a": "missing", "test_looks/test_b": "missing"}
    assert not list((pytester.path / "tonetool-results").glob(".session-*"))


def test_xdist(run, approved, names, pytester):
    pytest.importorskip("xdist", reason="pytest-xdist is not installed")
    approved(looks(*"abcd"), "-n", "2").assert_outcomes(failed=4)
    green = run(None, "-n", "2", "--tonetool-report", "page.html")
    green.assert_outcomes(passed=4)
    assert green.ret == 0 and (pytester.path / "page.html").is_file()
    assert set(names().values()) == {"passed"} and len(names()) == 4
    gone = run(looks(*"abd"), "-n", "2")
    assert gone.ret == 1
    said(gone, "ERROR test_looks/test_c: approved, but no test checks it any more")
    assert run(None, "-n", "2", "-k", "test_a").ret == 0
    assert not list((pytester.path / "tonetool-results").glob(".session-*"))


# ---- the entry point

def test_entry_point_of_the_build_and_of_the_wheel():
    found = [entry for entry in importlib.metadata.entry_points(group="pytest11") if "tonetool" in entry.name]
    assert {(entry.name, entry.value) for entry in found} == {("pytest_tonetool", "pytest_tonetool")}
    spec = importlib.util.spec_from_file_location("build_wheel", ROOT / "src/python/pip/build_wheel.py")
    build_wheel = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(build_wheel)
    files = build_wheel.information()
    assert files["entry_points.txt"] == b"[pytest11]\npytest_tonetool = pytest_tonetool\n"
    folder = next(Path(path) for path in sys.path if (Path(path) / "pytest_tonetool").is_dir())
    (info,) = folder.glob("tonetool-*.dist-info")
    assert {file.name: file.read_bytes() for file in info.iterdir()} == files
