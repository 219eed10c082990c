# SPDX-License-Identifier: BSD-3-Clause
"""--against and --qc over shots that look like renders: what is wrong is found, in its frame and as
severe as it is; shots without a fault have none."""

import json

import pytest
from conftest import call
from fault_suite import shots
from fault_suite.kinds import ALL, FIRST, HEALTHY, KINDS, LAST, MIDDLE


def name_of(number):
    return f"shot.{number}.exr"


@pytest.fixture(scope="module")
def versions(tmp_path_factory):
    """The approved and the new version of both shots, without a fault."""
    root = tmp_path_factory.mktemp("versions")
    for version, how in (("approved", shots.APPROVED), ("new", shots.NEW)):
        for shot, render in shots.SHOTS.items():
            folder = root / version / shot
            folder.mkdir(parents=True)
            for number in ALL:
                render(number - 1000, **how).write(folder / name_of(number))
    return root


@pytest.fixture
def check(program, tmp_path):
    """Runs the program over all frames, or those named, and returns those of its report."""

    def run(*words, frames=f"{FIRST}-{LAST}"):
        ran = call(program, ["--frames", frames, *words, "--json", "check.json"], tmp_path)
        return ran, json.loads((tmp_path / "check.json").read_text())["frames"]

    return run


def faults(frames, command):
    return [(frame["frame"], fault["severity"], fault["code"]) for frame in frames
            for fault in frame.get("faults", []) if fault.get("command", "qc") == command]


def make_frames(folder, kind, new, numbers):
    """The frames of the shot, changed where the kind says so."""
    for number in numbers:
        path = folder / name_of(number)
        if number not in kind.frames:
            path.symlink_to(new / name_of(number))
            continue

        def render(number, **how):
            return shots.SHOTS[kind.shot](number - 1000, **{**shots.NEW, **how})

        kind.change(render(number), number, render).write(path)


@pytest.mark.parametrize("name", KINDS)
def test_each_kind_of_fault(check, versions, tmp_path, name):
    kind = KINDS[name]
    numbers = ALL if len(kind.frames) < len(ALL) else ALL[:6]
    make_frames(tmp_path, kind, versions / "new" / kind.shot, numbers)
    ran, frames = check(versions / "approved" / kind.shot / "shot.#.exr", "shot.#.exr",
                        "--against", "--qc", frames=f"{numbers[0]}-{numbers[-1]}")
    assert sorted(faults(frames, "qc")) == sorted(kind.alone)
    found = faults(frames, "against")
    changed = set(kind.frames) & set(numbers) if kind.against else set()
    assert {number for number, *_ in found} == changed
    for number in changed:
        assert kind.against <= {(severity, code) for at, severity, code in found if at == number}
    errors = "error" in {severity for _, severity, _ in [*found, *kind.alone]}
    assert ran.status == (3 if errors else 0)


@pytest.mark.parametrize("shot", shots.SHOTS)
def test_a_new_version_with_more_noise_has_no_fault(check, versions, shot):
    folders = [versions / version / shot / "shot.#.exr" for version in ("approved", "new")]
    ran, frames = check(*folders, "--against", "--qc")
    assert (ran.status, ran.err) == (0, "")
    assert not any(frame.get("faults") for frame in frames)
    assert {frame["status"] for frame in frames} == {"passed"}


@pytest.mark.parametrize("name", HEALTHY)
def test_a_shot_without_a_fault(check, tmp_path, name):
    render, told = HEALTHY[name]
    for number in ALL:
        render(number - 1000).write(tmp_path / name_of(number))
    ran, frames = check("shot.#.exr", "--qc")
    assert ran.status == 0
    assert {(severity, code) for _, severity, code in faults(frames, "qc")} == told


@pytest.mark.parametrize("size", [1, 5, 24])
def test_any_split_gives_the_bytes_of_the_whole(program, versions, tmp_path, size):
    """Also where a frame is missing in either version, and where frames are told together."""
    for version, missing in (("approved", 1009), ("new", 1016)):
        (tmp_path / version).mkdir()
        for number in set(ALL) - {missing}:
            kind = {1005: KINDS["tint"], 1006: KINDS["tint"], MIDDLE: KINDS["hole"]}.get(number)
            path = tmp_path / version / name_of(number)
            if kind and version == "new":
                frame = shots.pan(number - 1000, **shots.NEW)
                kind.change(frame, number, None).write(path)
            else:
                path.symlink_to(versions / version / "pan" / name_of(number))
    words = ["approved/shot.#.exr", "new/shot.#.exr", "--against", "--qc"]

    def run(*words, status):
        assert call(program, words, tmp_path).status == status

    run("--frames", f"{FIRST}-{LAST}", *words, "--json", "whole.json", "--csv", "whole.csv",
        status=1)
    parts = []
    for first in range(FIRST, LAST + 1, size):
        parts.append(f"part{first}.json")
        last = min(first + size - 1, LAST)
        run("--frames", f"{first}-{last}", *words, "--exit-zero", "--json", parts[-1], status=0)
    run("--merge", *reversed(parts), "--json", "merged.json", "--csv", "merged.csv", status=1)
    for kind in ("json", "csv"):
        assert ((tmp_path / f"merged.{kind}").read_bytes() ==
                (tmp_path / f"whole.{kind}").read_bytes())
    frames = json.loads((tmp_path / "whole.json").read_text())["frames"]
    statuses = {frame["frame"]: frame["status"] for frame in frames}
    assert statuses[1016] == "missing"
    assert {1005, 1006, 1009, MIDDLE} == {number for number, status in statuses.items()
                                    if status == "failed"}
    assert (1009, "error", "noapproved") in faults(frames, "against")
    assert (MIDDLE, "error", "hole") in faults(frames, "qc")


def test_results_of_an_older_program_are_refused(check, versions, tmp_path, program):
    check(versions / "new" / "pan" / "shot.#.exr", "--qc", frames="1001")
    report = json.loads((tmp_path / "check.json").read_text())
    assert report["version"] == 2
    report["version"] = 1
    (tmp_path / "old.json").write_text(json.dumps(report))
    ran = call(program, ["--merge", "old.json", "--json", "merged.json"], tmp_path)
    assert ran.status == 1
    assert "old.json" in ran.err and "version 1" in ran.err and "Traceback" not in ran.err
    assert not (tmp_path / "merged.json").exists()
