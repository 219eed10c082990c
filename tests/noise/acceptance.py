#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Noise or change: how often tonetool.bias_check and tonetool.noise_floor are right, on renders and on noise
whose truth is known, and what is accepted.

    /usr/bin/python3 tests/noise/acceptance.py [--shared DIR] [--quick] [--against FILE] [ROW...]

Run by hand, with the folder of the built Python module on PYTHONPATH; some minutes. DIR is the folder of the
labelled renders (scenes/seeds/ and scenes/SCENE/), ../shared by default. ROW: only these, see --list.
--quick: a part of the trials and of the rows, below 20 s. --against FILE: each pair also by the reference
implementation, tools/noise_reference.py of that folder, which takes far longer: where a row does not
hold and the reference gives the same verdicts, the method is at fault and not the program.

Prints a line for each claim: ok or NOT, what came out, and what is accepted. Exit status 1 if any is
NOT, 2 if something is missing. Every trial is seeded, so that a run repeats."""

import argparse
import importlib.util
import sys
import time
from pathlib import Path

try:
    import tonetool
    from renders import Missing
    from rows import NOT_QUICK, ROWS
    from trials import Trials
except ImportError as error:
    print(f"acceptance.py: {error}: it needs numpy, OpenImageIO's Python module, and on PYTHONPATH the folder "
          "of the built Python module, build/release/src/python", file=sys.stderr)
    sys.exit(2)

LEFT_OUT = ("left out: plane and window with their changes (group_lamp, hide_vase, hide_Torus, tint_Cone), pairs of\n"
            "64 samples and of 960 x 540: these renders are not in the folder")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    shared = Path(__file__).resolve().parents[2].parent / "shared"
    parser.add_argument("--shared", type=Path, default=shared, metavar="DIR")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--against", type=Path, metavar="FILE")
    parser.add_argument("--list", action="store_true", help="the names of the rows")
    parser.add_argument("rows", nargs="*", metavar="ROW")
    words = parser.parse_args()
    for name in words.rows:
        if name not in ROWS:
            parser.error(f"no row {name}; there are {', '.join(ROWS)}")
    return words


def reference_of(path):
    if path is None:
        return None
    if not path.is_file():
        print(f"acceptance.py: no reference implementation {path}", file=sys.stderr)
        sys.exit(2)
    spec = importlib.util.spec_from_file_location("noise_reference", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def run_row(name, trials, states):
    """Prints the claims of a row as they come, and counts them."""
    start, judged, against = time.process_time(), trials.judged, trials.against
    try:
        for claim in ROWS[name](trials):
            state = {True: "ok", False: "NOT", None: "-"}[claim.holds]
            states[state] = states.get(state, 0) + 1
            accepted = "not judged" if claim.holds is None else "accepted"
            print(f"{state:4}{name}: {claim.what}: {claim.came}; {accepted}: {claim.accepted}",
                  flush=True)
    except Missing as missing:
        states["missing"] = states.get("missing", 0) + 1
        print(f"skipped {name}: no {missing}", flush=True)
    judged, against = trials.judged - judged, trials.against - against
    compared = f", {against} verdicts not those of the reference" if trials.reference else ""
    print(f"    {name}: {judged} pairs judged{compared}, {time.process_time() - start:.1f} CPU s",
          file=sys.stderr, flush=True)


def main():
    words = arguments()
    if words.list:
        print("\n".join(ROWS))
        return 0
    trials = Trials(words.shared, words.quick, reference_of(words.against))
    print(f"tonetool {tonetool.__version__}, renders of {words.shared}")
    print(LEFT_OUT)
    states = {}
    for name in words.rows or ROWS:
        if words.quick and name in NOT_QUICK and not words.rows:
            print(f"left out: {name}: {NOT_QUICK[name]}")
            continue
        run_row(name, trials, states)
    print(f"{states.get('ok', 0)} ok, {states.get('NOT', 0)} NOT, {states.get('-', 0)} not judged, "
          f"{states.get('missing', 0)} rows skipped")
    if states.get("NOT"):
        return 1
    if states.get("missing") and not words.quick:
        print("acceptance.py: rows were skipped: give the folder of the renders with --shared DIR",
              file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
