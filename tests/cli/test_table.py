# SPDX-License-Identifier: BSD-3-Clause
"""--table: numbers of named cases for a paper."""

import json

import numpy as np
import pytest

MSE = "--errormap:metric=mse:print=0"
METHODS = ("4spp", "16spp", "16spp_filtered")
VALUES = {"cornell": (0.330026, 0.192611, 0.146284), "gallery": (0.364424, 0.195588, 0.159064),
          "nightstreet": (0.543955, 0.410784, None)}

CSV = """name,4spp,16spp,16spp_filtered
cornell,0.330026,0.192611,0.146284
gallery,0.364424,0.195588,0.159064
nightstreet,0.543955,0.410784,
mean,0.412802,0.266328,
"""
MARKDOWN = """errormap.mse, lower is better

| | 4spp | 16spp | 16spp_filtered |
|---|--:|--:|--:|
| cornell | 0.3300 | 0.1926 | **0.1463** |
| gallery | 0.3644 | 0.1956 | **0.1591** |
| nightstreet | 0.5440 | **0.4108** | – |
| mean | 0.4128 | **0.2663** | – |
"""
LATEX = r"""% errormap.mse, lower is better
% needs \usepackage{booktabs}
\begin{tabular}{lrrr}
\toprule
 & 4spp & 16spp & 16spp\_filtered \\
\midrule
cornell & 0.3300 & 0.1926 & \textbf{0.1463} \\
gallery & 0.3644 & 0.1956 & \textbf{0.1591} \\
nightstreet & 0.5440 & \textbf{0.4108} & -- \\
\midrule
mean & 0.4128 & \textbf{0.2663} & -- \\
\bottomrule
\end{tabular}
"""


@pytest.fixture
def methods(tmp_path, make_image):
    """Images whose mean square errors are VALUES."""

    def make(name, error):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        make_image(name, 4, 4, pixels=np.full((4, 4, 3), np.sqrt(error)))

    for name, values in VALUES.items():
        make(f"r/{name}.exr", 0)
        for method, value in zip(METHODS, values, strict=True):
            if value is not None:
                make(f"t/{method}/{name}.exr", value)
    return make


WORDS = ["r/%N.exr", "t/%M/%N.exr", MSE, "-q"]
ORDER = f"methods={','.join(METHODS)}"


@pytest.mark.parametrize("ending, text", [("csv", CSV), ("md", MARKDOWN), ("tex", LATEX)])
@pytest.mark.usefixtures("methods")
def test_bytes(tonetool, tmp_path, ending, text):
    # A case that is missing is no table's matter alone: status 1.
    tonetool(*WORDS, f"--table:{ORDER}", f"t.{ending}", "--json", "j.json", status=1)
    assert (tmp_path / f"t.{ending}").read_text(encoding="utf-8") == text
    ran = tonetool("--merge", "j.json", f"--table:{ORDER}", f"again.{ending}", status=1)
    assert (tmp_path / f"again.{ending}").read_text(encoding="utf-8") == text
    assert "no number of nightstreet [16spp_filtered]" in ran.err


@pytest.mark.usefixtures("methods")
def test_order_digits_and_ties(tonetool, tmp_path, methods):
    methods("t/copy/cornell.exr", VALUES["cornell"][2])
    tonetool(*WORDS, "--table:digits=2", "t.md", status=1)
    lines = (tmp_path / "t.md").read_text(encoding="utf-8").splitlines()
    assert lines[2] == "| | 16spp | 16spp_filtered | 4spp | copy |"
    assert lines[4] == "| cornell | 0.19 | **0.15** | 0.33 | **0.15** |"


@pytest.mark.usefixtures("methods")
def test_higher_is_better(tonetool, tmp_path):
    tonetool("r/%N.exr", "t/%M/%N.exr", "--errormap:metric=psnr:print=0", "-q",
             "--table:methods=4spp,16spp", "t.md", status=1)
    lines = (tmp_path / "t.md").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "errormap.psnr, higher is better"
    row = lines[4].split(" | ")
    assert row[0] == "| cornell" and not row[1].startswith("**") and row[2].startswith("**")


@pytest.mark.usefixtures("methods")
def test_a_column_for_each_quantity(tonetool, tmp_path):
    words = ["r/%N.exr", "t/4spp/%N.exr", MSE, "-q", "--json", "j.json"]
    tonetool(*words, "--table", "t.csv")
    first = json.loads((tmp_path / "j.json").read_text())["frames"][0]
    quantities = [f"errormap.{name}" for name in first["measurements"][0]["quantities"]]
    text = (tmp_path / "t.csv").read_text(encoding="utf-8").splitlines()
    assert text[0].split(",") == ["name", *quantities]
    tonetool(*words, "--table:quantity=errormap.max,errormap.mse", "t.tex")
    text = (tmp_path / "t.tex").read_text(encoding="utf-8")
    assert " & errormap.max & errormap.mse \\\\" in text and "textbf" not in text


def test_frames_are_seeds(tonetool, tmp_path, make_image):
    for seed, error in ((1, 0.1), (2, 0.2), (3, 0.6)):
        for side, value in (("r", 0), ("t", np.sqrt(error))):
            make_image(f"{side}_a.{seed:04}.exr", 4, 4, pixels=np.full((4, 4, 3), value))
    tonetool("r_%N.#.exr", "t_%N.#.exr", MSE, "-q", "--table:quantity=errormap.mse", "t.md")
    assert "| a | 0.3000 ± 0.2646 |" in (tmp_path / "t.md").read_text(encoding="utf-8")


def test_names_are_escaped(tonetool, tmp_path, make_image):
    name = r"a_b&c%d#e$f^g~h{i}|j\k"
    for side in "rt":
        make_image(f"{side} {name}.exr", 4, 4)
    words = ["r %N.exr", "t %N.exr", MSE, "-q"]
    tonetool(*words, "--table", "t.tex")
    assert (r"a\_b\&c\%d\#e\$f\textasciicircum{}g\textasciitilde{}h\{i\}|j\textbackslash{}k & "
            in (tmp_path / "t.tex").read_text(encoding="utf-8"))
    tonetool(*words, "--table", "t.md")
    assert r"h{i}\|j\\k |" in (tmp_path / "t.md").read_text(encoding="utf-8")


@pytest.mark.usefixtures("methods")
@pytest.mark.parametrize("words, text", [
    ([*WORDS, "--table", "t.txt"], '"t.txt" has no extension of a table (valid: .md, .tex, .csv)'),
    ([*WORDS, "--table:quantity=errormap.rmse", "t.md"], 'no case has the quantity "errormap.rmse"'),
    ([*WORDS, "--table:quantity=errormap.mse,errormap.max", "t.md"], "over methods a table has one"),
    ([*WORDS, "--table:methods=4spp,8spp", "t.md"], '--table: methods has "8spp" (there are: 16spp, 16spp_filtered, 4spp)'),
    ([*WORDS, "--table:methods=4spp,4spp", "t.md"], 'the method "4spp" is named twice'),
    ([*WORDS, "--table:digits=x", "t.md"], "digits"),
    ([*WORDS, "--table:columns=2", "t.md"], 'no modifier "columns" (valid: quantity, digits, methods)'),
    (["r/cornell.exr", "t/4spp/cornell.exr", MSE, "--table", "t.md"], "a row for each name"),
    (["r/%N.exr", "t/4spp/%N.exr", MSE, "--table:methods=4spp", "t.md"],
     "--table: methods= needs methods (valid: %M in the names of the images)"),
])
def test_errors(tonetool, tmp_path, words, text):
    assert text in tonetool(*words, status=1).err
    assert not (tmp_path / "t.md").exists()
