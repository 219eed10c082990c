# SPDX-License-Identifier: BSD-3-Clause
"""Help as a newcomer reads it, the man page, and completion in the shells themselves."""

import json
import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TOPICS = ("compare", "check", "cases", "threshold", "tonemap", "hdr", "ocio", "recipes", "exit")


@pytest.fixture
def registry(tonetool):
    return json.loads(tonetool("--help=json").out)


def names_of(registry):
    return {name: row for row in registry for name in row["names"]}


@pytest.fixture
def shop(tonetool, make_image, tmp_path, testimages):
    """The files that the examples of help name."""
    for name in ("ref.exr", "test.exr", "picture.exr", "shot.exr"):
        make_image(name, width=32, height=32)
    for frame in (1, 2, 3):
        for side in ("ref", "test", "shot"):
            make_image(f"{side}.{frame:04d}.exr", width=32, height=32, seed=frame)
    for folder in ("refs", "renders", "out/bdpt", "out/pt"):
        (tmp_path / folder).mkdir(parents=True)
        make_image(f"{folder}/lamp.exr", width=32, height=32)
    for name in (f"{folder}/hair/long.exr" for folder in ("renders", "refs", "out/bdpt", "out/pt")):
        (tmp_path / name).parent.mkdir()
        make_image(name, width=32, height=32)
    (tmp_path / "suite.toml").write_text('tonetool-suite = 1\nreference = "approved"\ntest = "renders/%N.exr"\n'
                                         'check = "--hdrflip:fail=mean=0.3"\n')
    tonetool("--suite", "suite.toml", "--json", "run.json", "-q", status=1)
    tonetool("--approve", "run.json", "*", "--reason", "first")
    (tmp_path / "ocio").symlink_to(ROOT / "ocio")
    for shot in ("gallery", "cornell"):
        for side in ("ref", "test"):
            (tmp_path / f"{shot}_{side}.exr").symlink_to(testimages / f"{shot}_{side}.exr")
    return tmp_path


def examples(text):
    return [shlex.split(line)[1:] for line in text.splitlines()
            if re.match(r" *tonetool [^0-9]", line) and not line.startswith("tonetool")]


# ---- the first page

def test_the_first_page_is_one_screen_and_its_examples_run(tonetool, shop, registry):
    page = tonetool("-h").out
    assert len(page.splitlines()) <= 45 and max(map(len, page.splitlines())) <= 130
    lines = page.split("matter first:\n")[1].split("\n\n")[0].splitlines()
    assert len(lines) == 10
    for line in lines:
        name = re.match(r" *-+([\w-]+)", line).group(1)
        assert name in names_of(registry)
    assert "--help COMMAND" in page and all(f"--help {topic} " in page for topic in TOPICS)
    assert len(examples(page)) == 3
    for words in examples(page):
        tonetool(*words)


def test_no_arguments_print_how_it_is_used(tonetool):
    ran = tonetool(status=1)
    assert ran.err.count("tonetool ref.exr test.exr") == 1 and "--help" in ran.err


# ---- subjects

@pytest.mark.parametrize("topic", TOPICS)
def test_the_commands_and_modifiers_of_a_topic_exist(tonetool, registry, topic):
    text = tonetool("--help", topic).out
    assert max(map(len, text.split("\n--tonemap\n")[0].splitlines())) <= 104
    for name in re.findall(r"(?<![\w-])--?([a-z][\w-]*)(?=[\s:=,.;)]|$)", text):
        assert name in names_of(registry), name
    for word in re.findall(r"(?<!\S)--[a-z]+:\S+", text):
        row = names_of(registry)[word.split(":")[0][2:]]
        keys = [modifier["key"] for modifier in row["modifiers"]]
        for part in word.split(":")[1:]:
            assert part.split("=")[0] in keys, word


@pytest.mark.parametrize("topic", TOPICS)
def test_the_examples_of_a_topic_run(tonetool, shop, topic):
    text = tonetool("--help", topic).out.split("\n--tonemap\n")[0]
    recipe = re.search(r"  tonetool 1\n(?:  .*\n)+", text)
    if recipe:
        (shop / "error.tone").write_text(recipe.group().replace("\n  ", "\n").lstrip())
    for words in examples(text):
        ran = tonetool(*words)
        assert "ERROR" not in ran.err


def test_exit_statuses_are_in_all_places(tonetool):
    for words in (("--help", "exit"), ("--help",), ("--help=man",)):
        text = tonetool(*words).out.replace("\\", "")
        for meaning in ("everything passed", "only warnings", "threshold was exceeded"):
            assert meaning in text, words


def test_a_name_of_both_gives_both_and_with_dashes_the_command(tonetool):
    assert "Showing an HDR picture" in tonetool("--help", "tonemap").out
    assert "curve=NAME" in tonetool("--help", "tonemap").out
    assert "Showing an HDR picture" not in tonetool("--help", "--tonemap").out
    assert "subjects: compare" in tonetool("--help", "treshold", status=1).err


def test_frequent_modifiers_come_first_and_curve_parameters_last(tonetool):
    lines = tonetool("--help", "hdrflip").out.splitlines()
    place = {line.split("=")[0].strip(): at for at, line in enumerate(lines) if "=" in line}
    assert place["fail"] < place["layer"] < place["startExposure"] < place["resize"]
    assert place["resize"] < place["shoulder"] and place["print"] < place["bias"]
    titles = [line.strip() for line in lines if line.endswith(":")]
    assert titles == ["modifiers used most:", "other modifiers:",
                      "parameters of single tone curves:"]


def test_help_begins_with_what_the_program_is_for(tonetool):
    text = tonetool("--help").out
    assert text.index("--hdrflip ") < text.index("--tonemap ") < text.index("--threads ")


# ---- the man page

def test_the_man_page_has_its_sections_and_no_fault(tonetool, tmp_path):
    page = tonetool("--help=man").out
    titles = re.findall(r'^\.SH "?([A-Z ]+)"?$', page, re.M)
    assert titles == ["NAME", "SYNOPSIS", "DESCRIPTION", "EXAMPLES", "SUBJECTS", "COMMANDS",
                      "EXIT STATUS", "ENVIRONMENT", "FILES", "SEE ALSO"]
    if not shutil.which("groff"):
        pytest.skip("no groff here")
    (tmp_path / "tonetool.1").write_text(page)
    done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "tonetool.1"], cwd=tmp_path,
                          capture_output=True, text=True, check=True)
    assert done.stderr == "" and "hdrflip" in done.stdout


# ---- other spellings

def test_words_that_everyone_tries(tonetool, shop):
    assert "weighted-median" in tonetool("ref.exr", "test.exr", "--hdrflip", "--verbose").out
    assert tonetool("ref.exr", "test.exr", "--quiet", "--hdrflip").out == ""
    tonetool("ref.exr", "--output", "copy.exr")
    assert (shop / "copy.exr").exists()


def test_version_says_what_it_runs_with(tonetool):
    lines = tonetool("--version").out.splitlines()
    assert re.fullmatch(r"\d+\.\d+\.\d+", lines[0])
    assert [line.rsplit(" ", 1)[0] for line in lines[1:]] == [
        "OpenImageIO", "OpenColorIO", "OpenEXR", "instruction set"]
    assert all(re.search(r" \d+\.\d+", line) for line in lines[1:4])
    assert tonetool("--compat", "--version").out.splitlines() == lines[:1]


# ---- completion

def completed_by_bash(script, line):
    """What the shell would put for the last word, as bash calls the function."""
    code = f"""
source {script}
COMP_WORDBREAKS=$' \\t\\n"\\'><=;|&(:'
COMP_LINE={shlex.quote(line)}; COMP_POINT=${{#COMP_LINE}}
compopt() {{ :; }}
_tonetool
printf '%s\\n' "${{COMPREPLY[@]}}" """
    return subprocess.run(["bash", "-c", code], capture_output=True, text=True,
                          check=True).stdout.split()


def completed_by_fish(script, line):
    code = f"source {script}; complete -C {shlex.quote(line)}"
    done = subprocess.run(["fish", "--no-config", "-c", code], capture_output=True, text=True,
                          check=True, env={**os.environ, "HOME": str(script.parent)})
    last = [row.split("\t")[0].split(":")[-1] for row in done.stdout.splitlines()]
    return [word.split("=")[1] for word in last] if "=" in line.split(":")[-1] else last


def completed_by_zsh(script, line):
    """zsh on a terminal of its own lists what it has found."""
    (script.parent / "_tonetool").write_text(script.read_text())
    code = f"""
zmodload zsh/zpty
zpty shell zsh -f -i
# What it prints, until that fits a pattern and nothing follows for a second; 30 s at most.
drain() {{
    local text all silent=0 waited=0
    while (( waited < 300 )) && {{ [[ $all != ${{~1}} ]] || (( silent < 10 )) }}; do
        if zpty -r -t shell text; then all+=$text; silent=0; else sleep 0.1; (( ++silent, ++waited )); fi
    done
    print -rn -- $all
}}
zpty -w shell 'PROMPT=; autoload -U compinit; compinit -D -u; LISTMAX=10000; stty columns 300 rows 2000
fpath=({script.parent} $fpath); autoload -U _tonetool; compdef _tonetool tonetool; print re""ady'
drain "*ready*" >/dev/null
zpty -w -n shell {shlex.quote(line)}$'\t\t'
drain $'*\\n*'
zpty -d shell"""
    done = subprocess.run(["zsh", "-f", "-c", code], capture_output=True, text=True, check=True)
    plain = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", done.stdout)
    return re.findall(r"[-\w.]+=?", plain)


SHELLS = {"bash": completed_by_bash, "fish": completed_by_fish, "zsh": completed_by_zsh}


@pytest.mark.parametrize("shell", SHELLS)
def test_completion(tonetool, tmp_path, shell):
    if not shutil.which(shell):
        pytest.skip(f"no {shell} here")
    script = tmp_path / f"tonetool.{shell}"
    script.write_text(tonetool(f"--help={shell}").out)
    complete = SHELLS[shell]
    assert "--hdrflip" in complete(script, "tonetool a.exr --hdrf")
    modifiers = complete(script, "tonetool a.exr b.exr --hdrflip:fail=0.1:")
    assert {"warn=", "layer=", "tonemapper="} <= set(modifiers)
    assert "stops" in complete(script, "tonetool a.exr b.exr --hdrflip:exposuremap=")
    assert {"uncharted2", "uchimura"} <= set(
        complete(script, "tonetool a.exr b.exr --hdrflip:fail=0.1:tonemapper=u"))


def test_a_word_of_the_help_is_taken_for_a_modifier(tonetool, testimages):
    ran = tonetool(testimages / "plain.exr", "--tonemap:exposure=1", status=1)
    assert 'unknown modifier "exposure", did you mean "method" or "stops"? (--help tonemap lists all)' in ran.err
    assert "valid: " not in ran.err
