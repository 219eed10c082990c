# SPDX-License-Identifier: BSD-3-Clause
"""The installed tree is all that a C++ project needs."""

import gzip
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PAIR = [str(ROOT / "testimages" / f"cornell_{name}.exr") for name in ("ref", "test")]
HEADERS = sorted((ROOT / "src" / "include" / "tonetool").glob("*.h"))
HEADER_NAMES = [path.name for path in HEADERS] + ["version.h"]
CMAKE = os.environ.get("CMAKE", "cmake")
CXX = os.environ.get("CXX", "c++")


def run(*words, status=0, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                          timeout=300, check=False, **options)
    assert (done.returncode == 0) == (status == 0), (words, done.stdout, done.stderr)
    return done.stdout + done.stderr


@pytest.fixture(scope="session")
def tree(tmp_path_factory):
    """The installed tree, moved after it was installed."""
    folder = tmp_path_factory.mktemp("install")
    build = os.environ.get("BUILD_DIR", str(ROOT / "build" / "release"))
    run(CMAKE, "--install", build, "--prefix", folder / "first")
    (folder / "first").rename(folder / "moved")
    return folder / "moved"


@pytest.fixture(scope="session")
def library(tree):
    (found,) = tree.glob("lib*/**/libtonetool.so")
    return found


@pytest.fixture(scope="session")
def flags(library):
    """What pkg-config says of the tree."""
    environment = {**os.environ, "PKG_CONFIG_PATH": str(library.parent / "pkgconfig")}

    def ask(*words):
        return run("pkg-config", *words, "tonetool", env=environment).split()

    return ask


@pytest.fixture(scope="session")
def mean(tree):
    """The mean error of the pair by the installed program."""
    text = run(tree / "bin" / "tonetool", *PAIR, "--hdrflip", "-v")
    return float(re.search(r"^hdrflip: mean ([^\s,]+)", text, re.M).group(1))


def declared_functions():
    """Names of the functions that the headers export."""
    names = set()
    for header in HEADERS:
        text = re.sub(r"//.*|#.*", "", header.read_text())
        scope = "tonetool::ToneAlgo::" if "ToneAlgo" in text else "tonetool::"
        names |= {scope + name for name in re.findall(r"TONETOOL_API[^(;]*?(\w+)\(", text)}
    return names


def test_library_shows_only_public_names(library):
    lines = run("nm", "-D", "--defined-only", "-C", library).splitlines()
    shown = {re.sub(r"[\[(].*", "", line.split(maxsplit=2)[2]) for line in lines}
    assert shown == declared_functions()
    assert len(shown) > 30


def test_library_is_versioned(library):
    version = re.search(r"project\(tonetool VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
    name = re.search(r"SONAME.*\[(\S+)\]", run("readelf", "-d", library)).group(1)
    assert library.resolve().name == f"libtonetool.so.{version.group(1)}"
    assert name == "libtonetool.so." + version.group(1).rpartition(".")[0]
    assert (library.parent / name).resolve() == library.resolve()


def test_everything_is_installed(tree):
    """What a package of a distribution would have."""
    names = {str(path.relative_to(tree)) for path in tree.rglob("*") if path.is_file()}
    share = "share/"
    wanted = {"bin/tonetool", "bin/tonetool-slurm",
              share + "tonetool/check.schema.json", share + "tonetool/ocio/tonetool.ocio",
              share + "bash-completion/completions/tonetool",
              share + "zsh/site-functions/_tonetool",
              share + "fish/vendor_completions.d/tonetool.fish",
              *(f"{share}doc/tonetool/{name}" for name in (
                  "README.md", "CHANGELOG.md", "LICENSE", "THIRD_PARTY.md", "doc/building.md"))}
    assert not wanted - names
    pages = {path.relative_to(ROOT / "src") for path in (ROOT / "src" / "doc").rglob("*.md")}
    assert not {page for page in pages if f"{share}doc/tonetool/{page}" not in names}
    assert [name for name in names if re.match(r"lib.*/tone\.imageio\.so$", name)]


def test_manual_is_what_the_program_prints(tree):
    (page,) = (tree / "share" / "man" / "man1").glob("tonetool.1*")
    text = gzip.decompress(page.read_bytes()) if page.suffix == ".gz" else page.read_bytes()
    assert text.decode() == run(tree / "bin" / "tonetool", "--help=man")
    share = tree / "share"
    for shell, name in (("bash", "bash-completion/completions/tonetool"),
                        ("zsh", "zsh/site-functions/_tonetool"),
                        ("fish", "fish/vendor_completions.d/tonetool.fish")):
        assert (share / name).read_text() == run(tree / "bin" / "tonetool", f"--help={shell}")


def test_options_of_slurm_are_in_its_manual(tree):
    (page,) = (tree / "share" / "man" / "man1").glob("tonetool-slurm.1*")
    text = gzip.decompress(page.read_bytes()) if page.suffix == ".gz" else page.read_bytes()
    told = run("/usr/bin/python3", tree / "bin" / "tonetool-slurm", "--help")
    options = set(re.findall(r"^ +(--\w[\w-]*)", told, re.M))
    assert len(options) > 5
    assert set(re.findall(r"^\\fB(--\S*?)\\fR", text.decode().replace("\\-", "-"), re.M)) == options


def test_links_between_installed_pages_lead_there(tree):
    """A link to a page that is installed too; pictures and sources are not."""
    top = tree / "share" / "doc" / "tonetool"
    source_of = {page: ROOT / ("src" if page.parent != top or page.name != "README.md" else "")
                 / page.relative_to(top) for page in top.rglob("*.md")}
    followed = 0
    for page, source in source_of.items():
        links = [re.findall(r"\]\(([^)#:\s]+\.md)", path.read_text(encoding="utf-8"))
                 for path in (page, source)]
        for installed, link in zip(*links):
            if (source.parent / link).resolve() in source_of.values():
                assert (page.parent / installed).exists(), (page.name, installed)
                followed += 1
    assert followed or not any("](src/doc/" in path.read_text() for path in source_of.values())


def test_slurm_takes_the_program_beside_it(tree, tmp_path):
    """Whatever is on the path, and by a link from elsewhere."""
    link = tmp_path / "tonetool-slurm"
    link.symlink_to(tree / "bin" / "tonetool-slurm")
    anim = ROOT / "testimages" / "anim"
    words = ["--frames", "1-4", anim / "ref.#.exr", anim / "test.#.exr", "--hdrflip", "--json",
             tmp_path / "check.json"]
    for script in (tree / "bin" / "tonetool-slurm", link):
        text = run("/usr/bin/python3", script, "--dry-run", "--", *words,
                   env={"PATH": str(tmp_path / "nothing")})
        lines = [line for line in text.splitlines() if " --frames " in line or "--merge" in line]
        assert lines and all(line.startswith(f"{tree}/bin/tonetool ") for line in lines), text


def test_only_the_headers_are_installed(tree):
    """Those of the sources, and the one that the build makes of the project's version."""
    installed = {path.relative_to(tree / "include") for path in (tree / "include").rglob("*.*")}
    assert installed == {Path("tonetool") / name for name in HEADER_NAMES}
    assert not list(tree.rglob("*.a"))


def test_no_file_names_the_build(tree):
    # Not where it is part of another path: the root may be "/tonetool".
    root = re.compile(r"(?:(?<![\w}>./-])|(?<=-[IL]))" + re.escape(str(ROOT)) + r"(?![\w-])")
    for path in tree.rglob("*"):
        if path.suffix in (".cmake", ".pc", ".h", ".py", ".pyi"):
            assert not root.search(path.read_text()), path


@pytest.mark.parametrize("header", HEADER_NAMES)
def test_header_compiles_alone(header, flags, tmp_path):
    source = tmp_path / "alone.cpp"
    source.write_text(f"#include <tonetool/{header}>\n#include <tonetool/{header}>\n")
    run(CXX, "-std=c++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", *flags("--cflags"),
        source)


def test_pages_ask_for_this_version():
    version = re.search(r"project\(tonetool VERSION (\d+\.\d+)",
                        (ROOT / "CMakeLists.txt").read_text()).group(1)
    pages = [ROOT / "README.md", *(ROOT / "src" / "doc").rglob("*.md"),
             HERE / "example" / "CMakeLists.txt"]
    asked = {(path.name, number) for path in pages for number in
             re.findall(r"find_package\(tonetool ([\d.]+)", path.read_text(encoding="utf-8"))}
    assert asked and {number for _, number in asked} == {version}, asked


def test_every_option_is_documented():
    files = [ROOT / "CMakeLists.txt", *(ROOT / "src").rglob("*.cmake"), *(
        path for part in ("src", "plugins", "tests") for path in (ROOT / part).rglob("CMakeLists.txt"))]
    text = "\n".join(path.read_text() for path in files)
    options = set(re.findall(r"option\((TONETOOL_\w+)", text))
    options |= set(re.findall(r"set\((TONETOOL_\w+)[^)]*?\sCACHE\s", text))
    options |= set(re.findall(r"find_(?:file|path|program)\((TONETOOL_\w+)", text))
    presets = json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]
    page = (ROOT / "src" / "doc" / "building.md").read_text(encoding="utf-8")
    documented = set(re.findall(r"^\| `(TONETOOL_\w+)`", page, re.M))
    assert len(options) > 15 and documented == options, documented ^ options
    assert not [preset["name"] for preset in presets if f"`{preset['name']}`" not in page]


def test_find_package(tree, mean, tmp_path):
    run(CMAKE, "-S", HERE / "example", "-B", tmp_path, f"-DCMAKE_PREFIX_PATH={tree}",
        f"-DCMAKE_CXX_COMPILER={CXX}", "-DCMAKE_CXX_STANDARD=17")
    run(CMAKE, "--build", tmp_path)
    assert float(run(tmp_path / "example", *PAIR)) == pytest.approx(mean, abs=1e-6)


def test_example_fails_with_the_reason(tree, tmp_path):
    """Also where the project's own standard is an older one, as clang 14's default is."""
    run(CMAKE, "-S", HERE / "example", "-B", tmp_path, f"-DCMAKE_PREFIX_PATH={tree}",
        "-DCMAKE_CXX_STANDARD=14")
    run(CMAKE, "--build", tmp_path)
    text = run(tmp_path / "example", PAIR[0], tmp_path / "none.exr", status=1)
    assert "hdr_flip" in text and "none.exr" in text


def test_pkg_config(library, flags, mean, tmp_path):
    program = tmp_path / "example"
    run(CXX, "-std=c++17", HERE / "example" / "example.cpp", "-o", program,
        *flags("--cflags", "--libs"), f"-Wl,-rpath,{library.parent}")
    assert float(run(program, *PAIR)) == pytest.approx(mean, abs=1e-6)


def test_guide_shows_the_example():
    guide = (ROOT / "src" / "doc" / "cpp.md").read_text(encoding="utf-8")
    (shown,) = re.findall(r"```cpp\n(.*?)```", guide, re.S)
    assert shown == (HERE / "example" / "example.cpp").read_text()
    (lists,) = re.findall(r"```cmake\n(.*?)```", guide, re.S)
    for line in lists.splitlines():
        assert line in (HERE / "example" / "CMakeLists.txt").read_text().splitlines()


def test_installed_python_module(tree):
    found = list(tree.glob("lib/python3*/dist-packages/tonetool/__init__.py"))
    if os.environ.get("PYTHON_MODULE") == "OFF":
        pytest.skip("built without the Python module")
    (package,) = found
    code = ("import tonetool, OpenImageIO as o; print(tonetool.__file__); "
            f"print(tonetool.hdr_flip(*(o.ImageBuf(p) for p in {PAIR!r})).summary.pool.mean)")
    text = run("/usr/bin/python3", "-B", "-c", code, env={"PYTHONPATH": str(package.parents[1])})
    assert text.splitlines()[0] == str(package) and float(text.splitlines()[1]) > 0
    assert (package.parent / "py.typed").exists() and (package.parent / "__init__.pyi").exists()


TEST_OF_PYTEST = """
def test_cornell(tonetool_check):
    tonetool_check({image!r}, fail="mean=0.1")
"""


def test_installed_plugin_of_pytest(tree, tmp_path):
    """Found by its entry point, and finds the program of its own tree; nothing else says where they are."""
    found = list(tree.glob("lib/python3*/dist-packages/pytest_tonetool"))
    if os.environ.get("PYTHON_MODULE") == "OFF":
        pytest.skip("built without the Python module")
    (module,) = found
    assert {path.name for path in module.parent.glob("tonetool-*.dist-info/*")} == {
        "METADATA", "WHEEL", "LICENSE", "entry_points.txt"}
    environment = {"PYTHONPATH": str(module.parent), "PATH": str(tmp_path / "nothing")}
    pytest_words = ["/usr/bin/python3", "-B", "-m", "pytest", "-p", "no:cacheprovider"]

    def session(image, status):
        (tmp_path / "test_looks.py").write_text(TEST_OF_PYTEST.format(image=image), encoding="utf-8")
        return run(*pytest_words, env=environment, cwd=tmp_path, status=status)

    text = session(PAIR[0], 1)
    (line,) = [line for line in text.splitlines() if line.startswith("to approve")]
    assert "missing: no approved image" in text and "tonetool-" in text.split("plugins:")[1].splitlines()[0]
    run(tree / "bin" / "tonetool", *line.partition(": tonetool ")[2].split(" --reason")[0].split(), "--reason", "seen",
        "--by", "Ada", cwd=tmp_path)
    assert "1 passed" in session(PAIR[0], 0)
    assert "failed: hdrflip: mean 0.26" in session(PAIR[1], 1)


def test_other_version_is_refused(tree, tmp_path):
    shutil.copytree(HERE / "example", tmp_path / "source")
    lists = tmp_path / "source" / "CMakeLists.txt"
    lists.write_text(re.sub(r"tonetool \d+\.\d+", "tonetool 99.0", lists.read_text()))
    text = run(CMAKE, "-S", tmp_path / "source", "-B", tmp_path / "build",
               f"-DCMAKE_PREFIX_PATH={tree}", status=1)
    assert 'compatible with requested version "99.0"' in text


# ---- images as tests of CTest

@pytest.fixture(scope="session")
def renderer(tree, tmp_path_factory):
    """Configures the project of tests/package/images; `line` is added to it."""
    source = HERE / "images"
    pair = PAIR[0].removesuffix("_ref.exr")

    def configure(line="", status=0):
        build = tmp_path_factory.mktemp("renderer")
        text = run(CMAKE, "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={tree}", f"-DPAIR={pair}",
                   f"-DRELATIVE={os.path.relpath(pair, source)}", f"-DLINE={line}", status=status)
        return build, " ".join(text.split())

    return configure


def test_images_are_tests_of_ctest(renderer):
    build, _ = renderer()
    done = subprocess.run([str(Path(CMAKE).with_name("ctest")) if "/" in CMAKE else "ctest", "-L",
                           "looks", "--output-on-failure"],
                          cwd=build, capture_output=True, text=True, timeout=120, check=False)
    told = {name: rest.strip(" .*") for name, rest in
            re.findall(r"Test +#\d+: (\S+) ([. *A-Za-z()]+)", done.stdout)}
    assert {name: re.sub(r"\W", "", text) for name, text in told.items()} == {
        "render_cornell": "Passed", "looks/cornell": "Failed", "looks/same": "Passed",
        "render_broken": "Failed", "looks/broken": "NotRun"}, done.stdout
    assert 'name="hdrflip.mean">' in done.stdout and "looks/broken (Not Run)" in done.stdout
    images = {str(path.relative_to(build / "tonetool")) for path in (build / "tonetool").rglob("*.png")}
    assert images == {f"looks/cornell/c#1.{kind}.png" for kind in ("reference", "test", "error")}


def test_properties_of_image_tests(renderer):
    build, _ = renderer()
    tests = json.loads(run("ctest", "--show-only=json-v1", cwd=build))["tests"]
    properties = {one["name"]: {p["name"]: p["value"] for p in one["properties"]} for one in tests}
    words = {one["name"]: one["command"] for one in tests}
    assert properties["looks/cornell"]["FIXTURES_REQUIRED"] == ["tonetool.render_cornell"]
    assert properties["lookdev"]["FIXTURES_REQUIRED"] == ["tonetool.render_cornell"]
    assert set(properties["render_cornell"]["FIXTURES_SETUP"]) == {"tonetool.render_cornell"}
    assert properties["looks/cornell"]["TIMEOUT"] == 60
    assert properties["looks/same"]["LABELS"] == ["fast", "looks"]
    assert words["lookdev"][1:] == ["--suite", str(HERE / "images/suite.toml"), "--ctest", "--images",
                                    str(build / "tonetool/lookdev")]
    for found in properties.values():
        assert not {"SKIP_RETURN_CODE", "WILL_FAIL"} & set(found)


@pytest.mark.parametrize("arguments, told", [
    ("TEST a.exr REFERENCE b.exr CHECK --hdrflip", "CHECK has no limit, so it could not fail"),
    ("TEST a.exr REFERENCE b.exr CHECK --hdrflip:warn=0.2", "CHECK has no limit"),
    ("TEST a.exr REFERENCE b.exr CHECK --hdrflip:fail= --resize:x=1 9", "CHECK has no limit"),
    ("TEST a.exr REFERENCE b.exr CHECK --qc", "CHECK has no limit"),
    ("TEST a.exr CHECK --hdrflip:fail=0.2", "REFERENCE is missing"),
    ("TEST a.exr REFERENCE b.exr CHECK --diff MASK", None),
    ("TEST a.exr REFERENCE b.exr CHECK --hdrflip:print=0:fail=0.2 DEPENDS nothing",
     'DEPENDS "nothing" is no test of this folder'),
    ("TEST a.exr REFERENCE b.exr CHECK --diff LABELS", "nothing behind LABELS"),
])
def test_image_tests_that_are_refused(renderer, arguments, told):
    _, text = renderer(f"tonetool_add_image_test(NAME x {arguments})", status=1 if told else 0)
    assert told is None or f"tonetool_add_image_test(x): {told}" in text
