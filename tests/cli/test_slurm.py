# SPDX-License-Identifier: BSD-3-Clause
"""tonetool-slurm on a Slurm of one node that this test starts in a folder of its own."""

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest
from conftest import TESTIMAGES

SCRIPT = Path(__file__).resolve().parents[2] / "src" / "farm" / "tonetool-slurm"
ANIM = TESTIMAGES / "anim"
FLIP = "--hdrflip:layer=ViewLayer.Combined:quantity=p99:fail=0.8:print=0"
CONFIG = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmctldPort={port}
SlurmdPort={second_port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def start(words, log, **options):
    with open(log, "w", encoding="utf-8") as stream:
        return subprocess.Popen(words, stdout=stream, stderr=stream, **options)


def until(condition, seconds, what):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            pytest.skip(f"Slurm cannot be started here: {what}")
        time.sleep(0.2)


@pytest.fixture(scope="module")
def slurm():
    """The environment of a running Slurm; ends its daemons afterwards."""
    path = "/usr/sbin:/usr/bin:/sbin:/bin"
    for name in ("slurmctld", "slurmd", "sbatch", "munged"):
        if not shutil.which(name, path=path):
            pytest.skip(f"no {name} here (packages slurmctld, slurmd, slurm-client, munge)")
    if os.geteuid() != 0:
        pytest.skip("slurmd wants to be root")
    folder = Path(tempfile.mkdtemp(prefix="slurm-", dir="/tmp"))  # a socket's path is short
    folder.chmod(0o755)
    (folder / "state").mkdir()
    (folder / "spool").mkdir()
    host = socket.gethostname().split(".")[0]
    config = folder / "slurm.conf"
    config.write_text(CONFIG.format(folder=folder, host=host, user="root", port=free_port(),
                                    second_port=free_port()))
    environment = {**os.environ, "SLURM_CONF": str(config)}
    key = folder / "munge.key"
    key.write_bytes(os.urandom(128))
    key.chmod(0o600)
    running = []
    try:
        running.append(start(["/usr/sbin/munged", "--foreground", "--force", f"--key-file={key}",
                              f"--socket={folder}/munge.socket", f"--pid-file={folder}/munge.pid",
                              f"--seed-file={folder}/munge.seed", f"--log-file={folder}/munge.log"],
                             folder / "munged.out"))
        until((folder / "munge.socket").exists, 15, "munged")
        running.append(start(["/usr/sbin/slurmctld", "-D", "-f", str(config)], folder / "c.out",
                             env=environment))
        running.append(start(["/usr/sbin/slurmd", "-D", "-f", str(config)], folder / "d.out",
                             env=environment))

        def idle():
            done = subprocess.run(["sinfo", "--noheader", "--format=%T"], env=environment,
                                  capture_output=True, text=True, check=False)
            return done.stdout.strip() == "idle"
        until(idle, 40, "no idle node: " + (folder / "c.out").read_text()[-300:])
        yield environment
        subprocess.run(["scancel", "--full", "--user", "root"], env=environment, check=False)
    finally:
        for process in reversed(running):
            process.terminate()
        for process in running:
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
        shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture
def shot(tmp_path):
    """Forty frames: the eight of testimages five times; frame 20 is the one that fails."""
    for side in ("ref", "test"):
        for number in range(1, 41):
            of = number % 8 + 1
            source = side if of != 5 or number == 20 else "ref"
            # Copies: a reference and a test that are one file are a warning.
            shutil.copy(ANIM / f"{source}.000{of}.exr", tmp_path / f"{side}.{number:04d}.exr")
    return tmp_path


def words(exposures="frame", *more):
    return ["--frames", "1-40", "ref.#.exr", "test.#.exr", f"{FLIP}:exposures={exposures}",
            *more, "--json", "check.json", "--csv", "check.csv"]


def farm(program, folder, environment, *line):
    return subprocess.run([sys.executable, str(SCRIPT), "--tonetool", program, "--poll", "0.5",
                           *line], cwd=folder, env=environment, capture_output=True, text=True,
                          timeout=280, check=False)


def local(program, folder, line):
    done = subprocess.run([program, *line], cwd=folder, capture_output=True, text=True, check=False,
                          timeout=200)
    made = {name: (folder / name).read_bytes() for name in ("check.json", "check.csv")}
    for name in made:
        (folder / name).unlink()
    return done, made


def killing(program, folder, how_often):
    """A program that is killed in the task of frame 11, so many times, and else is tonetool."""
    wrapper = folder / "tonetool-killed"
    wrapper.write_text(f"""#!/bin/bash
case " $* " in
*" --frames 11,"*)
    count=$(cat '{folder}/killed' 2>/dev/null || echo 0)
    if (( count < {how_often} )); then
        echo $(( count + 1 )) > '{folder}/killed'
        '{program}' "$@" & sleep 0.05; kill -9 $!; kill -9 $$
    fi ;;
esac
exec '{program}' "$@"
""")
    wrapper.chmod(0o755)
    return str(wrapper)


@pytest.mark.parametrize("exposures", ["frame", "shot"])
def test_the_farm_says_what_one_machine_says_though_a_task_is_killed(program, slurm, shot, exposures):
    alone, wanted = local(program, shot, words(exposures))
    assert alone.returncode == 3
    ran = farm(killing(program, shot, 1), shot, slurm, "--chunk", "5", "--throttle", "4", "--",
               *words(exposures))
    assert ran.returncode == 3, (ran.stdout, ran.stderr)
    assert "8 tasks" in ran.stdout
    assert alone.stdout.splitlines()[-1] in ran.stdout
    assert (shot / "killed").read_text().strip() == "1"
    for name, text in wanted.items():
        assert (shot / name).read_bytes() == text, name


def test_the_page_shows_what_the_tasks_have_drawn(program, slurm, shot):
    if subprocess.run([program, "--help", "report"], capture_output=True, check=False).returncode:
        pytest.skip("this program has no --report")
    ran = farm(program, shot, slurm, "--chunk", "4", "--", "--frames", "17-24", "ref.#.exr",
               "test.#.exr", FLIP, "--report", "check.html")
    assert ran.returncode == 3, (ran.stdout, ran.stderr)
    page = (shot / "check.html").read_text(encoding="utf-8")
    assert "frame 20" in page and page.count("data:image/") >= 8


def test_a_task_that_never_succeeds_is_reported(program, slurm, shot):
    ran = farm(killing(program, shot, 9), shot, slurm, "--chunk", "5", "--", *words())
    assert ran.returncode == 1, (ran.stdout, ran.stderr)
    assert (shot / "killed").read_text().strip() == "2"  # once more, not for ever
    found = json.loads((shot / "check.json").read_text())
    without = [frame["frame"] for frame in found["frames"] if frame["status"] == "error"]
    assert without == [11, 12, 13, 14, 15]
    assert len(found["frames"]) == 40


def test_a_frame_that_never_succeeds_is_reported(program, slurm, shot):
    (shot / "test.0033.exr").unlink()
    ran = farm(program, shot, slurm, "--chunk", "5", "--", *words())
    assert ran.returncode == 1, (ran.stdout, ran.stderr)
    found = json.loads((shot / "check.json").read_text())
    assert {f["frame"]: f["status"] for f in found["frames"]}[33] == "missing"
    assert found["counts"]["passed"] == 38


def test_dry_run_prints_the_scripts_and_does_nothing(program, shot):
    before = sorted(os.listdir(shot))
    ran = farm(program, shot, os.environ, "--dry-run", "--sbatch=--time=10", "--throttle", "3",
               "--", *words("shot", "--state", "s", "--warnings-exit"))
    assert ran.returncode == 0, ran.stderr
    assert "#SBATCH --array=0-7%3" in ran.stdout and "#SBATCH --time=10" in ran.stdout
    scripts = [line for line in ran.stdout.splitlines() if line.startswith("# ") and ".sh" in line]
    assert [line.split()[1].rstrip(",") for line in scripts] == [
        "exposures.sh", "exposures-again.sh", "exposures-merge.sh", "check.sh", "check-again.sh",
        "merge.sh"]
    merge = ran.stdout.split("# merge.sh")[1]
    assert "--json check.json" in merge and "--warnings-exit" in merge and "--state" not in merge
    assert sorted(os.listdir(shot)) == before


def test_images_are_of_tasks_and_of_the_merge(program, shot):
    ran = farm(program, shot, os.environ, "--dry-run", "--", *words("shot", "--images", "looks"))
    tasks, merge = ran.stdout.split("# merge.sh")
    assert ran.returncode == 0 and "--images looks" in tasks and "--images looks" in merge
    ran = farm(program, shot, os.environ, "--dry-run", "--", *words("shot", "--figure", "f.png"))
    assert ran.returncode == 1 and "--figure is drawn of images" in ran.stderr


# Runs the tasks of a job at once, one after the other.
FAKE_SBATCH = """#!/bin/bash
script="${!#}"
[ -n "$SCRIPTS" ] && cat "$script" >> "$SCRIPTS"
tasks=$(sed -n 's/^#SBATCH --array=\\([0-9,-]*\\).*/\\1/p' "$script" | tr , '\\n' |
    sed 's/^\\([0-9]*\\)$/\\1-\\1/' | tr - ' ')
for task in $(while read -r a b; do seq "$a" "$b"; done <<< "${tasks:-0 0}"); do
    SLURM_ARRAY_TASK_ID=$task bash "$script"
done
echo 17
"""
ODD = ["plain", "a:b", "{FRAME_NUMBER}", "with space", "a#1 @ %04d %V", "it's", 'say "x"',
       "$HOME `x` & ; * ? \\", "it's {\"x\"}:#"]


@pytest.fixture
def fake_slurm(tmp_path):
    """An environment with programs that have Slurm's names."""
    folder = tmp_path / "bin"
    folder.mkdir()
    for name, text in (("sbatch", FAKE_SBATCH), ("scontrol", "#!/bin/bash\n"),
                       ("squeue", "#!/bin/bash\n")):
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    return {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}


@pytest.mark.parametrize("name", ODD)
def test_folders_of_any_name(program, fake_slurm, tmp_path, name):
    here = tmp_path / name / "shot"
    work = tmp_path / name / "work"
    here.mkdir(parents=True)
    work.mkdir()
    for side, value in (("ref", "0.4"), ("test", "0.5")):
        subprocess.run([program, "--pattern", f"constant:color={value},1,0.1", "8x8", "3",
                        "-o", "a.exr"], cwd=here, check=True)
        for number in (1, 2):
            shutil.copy(here / "a.exr", here / f"{side}.{number:04d}.exr")
    line = ["--frames", "1-2", "ref.#.exr", "test.#.exr", "--hdrflip:fail=1e-3:exposures=shot",
            "--json", "check.json", "--csv", "check.csv"]
    alone, wanted = local(program, here, line)
    assert alone.returncode == 3, alone.stderr
    ran = farm(program, here, fake_slurm, "--folder", str(work), "--chunk", "1", "--", *line)
    logs = "\n".join(log.read_text() for log in work.glob("*/*.log"))
    assert ran.returncode == 3, (ran.stdout, ran.stderr, logs)
    for file, text in wanted.items():
        assert (here / file).read_bytes() == text, file


def names(folder):
    return sorted(os.listdir(folder))


@pytest.fixture
def pairs(program, tmp_path):
    """Four frames, all alike."""
    for side in ("ref", "test"):
        subprocess.run([program, "--pattern", "constant:color=0.4,1,0.1", "8x8", "3", "-o",
                        "a.exr"], cwd=tmp_path, check=True)
        for number in range(1, 5):
            shutil.copy(tmp_path / "a.exr", tmp_path / f"{side}.{number:04d}.exr")
    return tmp_path


FOUR = ["--frames", "1-4", "ref.#.exr", "test.#.exr", "--hdrflip:fail=1e-3"]


@pytest.mark.parametrize("words, text", [
    (["--json", "gone/check.json"], 'no folder "gone"'),
    (["--hdrflip:layer=Nope", "--json", "check.json"], "Nope"),
    (["--hdrflip:fial=1", "--json", "check.json"], 'unknown modifier "fial"'),
])
def test_nothing_is_submitted_where_a_dry_run_fails(program, fake_slurm, pairs, words, text):
    before = names(pairs)
    line = FOUR[:-1] + words if words[0].startswith("--hdrflip") else FOUR + words
    ran = farm(program, pairs, fake_slurm, "--", *line)
    assert ran.returncode == 1 and text in ran.stderr and "Traceback" not in ran.stderr
    assert names(pairs) == before


def test_the_work_folder_goes_where_the_merge_has_no_error(program, fake_slurm, pairs):
    work = pairs / "work"
    work.mkdir()
    ran = farm(program, pairs, fake_slurm, "--folder", "work", "--chunk", "1", "--", *FOUR, "--json",
               "check.json")
    assert ran.returncode == 0, (ran.stdout, ran.stderr)
    assert "4 frames asked for, 4 there" in ran.stdout and not names(work)
    (pairs / "test.0003.exr").unlink()
    ran = farm(program, pairs, fake_slurm, "--folder", "work", "--chunk", "1", "--", *FOUR, "--json",
               "check.json")
    assert ran.returncode == 1 and "missing: 3" in ran.stdout and len(names(work)) == 1


def test_a_resumed_run_does_what_is_left(program, fake_slurm, pairs):
    (pairs / "test.0003.exr").unlink()  # so that the folder stays
    line = ["--chunk", "1", "--", *FOUR, "--json", "check.json", "--csv", "check.csv"]
    work = pairs / "work"
    work.mkdir()
    assert farm(program, pairs, fake_slurm, "--folder", "work", *line).returncode == 1
    (folder,) = work.iterdir()
    shutil.copy(pairs / "ref.0003.exr", pairs / "test.0003.exr")
    (folder / "check.2.json").unlink()  # of frame 3
    whole = (folder / "check.0.json").read_bytes()
    (folder / "check.0.json").write_bytes(whole[:300])
    kept = (folder / "check.1.json").stat().st_mtime_ns
    ran = farm(program, pairs, fake_slurm, "--resume", str(folder), "--chunk", "2", *line[2:])
    assert ran.returncode == 1 and "its words, frames or --chunk were others" in ran.stderr
    scripts = pairs / "scripts"
    ran = farm(program, pairs, {**fake_slurm, "SCRIPTS": str(scripts)}, "--resume", str(folder), *line)
    assert ran.returncode == 0, (ran.stdout, ran.stderr)
    assert "4 tasks, 2 of them done before" in ran.stdout and not folder.exists()
    assert "#SBATCH --array=0,2\n" in scripts.read_text()
    assert kept > 0
    made = (pairs / "check.json").read_bytes()
    alone, wanted = local(program, pairs, line[3:])
    assert alone.returncode == 0 and made == wanted["check.json"]


def test_resume_of_another_folder(program, fake_slurm, pairs):
    ran = farm(program, pairs, fake_slurm, "--resume", ".", "--", *FOUR, "--json", "c.json")
    assert ran.returncode == 1 and "no work folder of tonetool-slurm" in ran.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_cancels_what_was_submitted(program, fake_slurm, pairs, number):
    """The queue that is looked at is never empty, and the merge does not come."""
    bin_folder = Path(fake_slurm["PATH"].split(":")[0])
    (bin_folder / "sbatch").write_text('#!/bin/bash\necho x >> "$0.count"\nwc -l < "$0.count"\n')
    (bin_folder / "squeue").write_text("#!/bin/bash\necho 1 R\n")
    (bin_folder / "scancel").write_text(f'#!/bin/bash\necho "$@" > "{pairs}/cancelled"\n')
    (bin_folder / "scancel").chmod(0o755)
    with subprocess.Popen([sys.executable, str(SCRIPT), "--tonetool", program, "--poll", "0.2", "--",
                           *FOUR, "--json", "check.json"], cwd=pairs, env=fake_slurm, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        for line in process.stdout:
            if "merge is job 3" in line:
                break
        process.send_signal(number)
        _, err = process.communicate(timeout=60)
    assert process.returncode == 128 + number
    assert (pairs / "cancelled").read_text() == "1 2 3\n"
    assert "cancelled the jobs 1 2 3; the same command goes on with --resume " in err
    assert "Traceback" not in err and not (pairs / "check.json").exists()


def test_folder_with_a_line_break(program, fake_slurm, tmp_path):
    folder = tmp_path / "a\nb"
    folder.mkdir()
    ran = farm(program, tmp_path, fake_slurm, "--folder", str(folder), "--", *words())
    assert ran.returncode == 1 and "control characters" in ran.stderr
    assert not os.listdir(folder)


@pytest.mark.parametrize("line, text", [
    (["--", "a.#.exr", "b.#.exr", "--hdrflip", "--json", "c.json"], "need --frames"),
    (["--", "--frames", "1-4", "a.#.exr", "b.#.exr", "--hdrflip"], "no result"),
    (["--", "--frames", "x", "a.#.exr", "--json", "c.json"], "no frame range"),
    (["--", "--frames", "1-4", "a.#.exr", "--merge", "--json", "c.json"], "program's own"),
    (["--", "--frames", "1-4", "a.#.exr", "--cgtmo", "b.#.exr", "--hdrflip", "--json", "c.json"],
     "valid: adapt=FILE"),
    (["--", "--frames", "1-4", "a.#.exr", "--tonemap:adapt=eye:method=mean", "--json", "c.json"],
     "valid: adapt=FILE"),
    (["--", "--frames", "1-4", "a.#.exr", "--tonemap:method=mean:adapt=s.json", "--cgtmo:adapt=frame",
      "--tonemap"], "no result"),
    (["--chunk", "0", "--", "x"], "at least 1"),
])
def test_errors(program, tmp_path, line, text):
    ran = farm(program, tmp_path, os.environ, *line)
    assert ran.returncode in (1, 2)
    assert text in ran.stderr
    assert not os.listdir(tmp_path)
