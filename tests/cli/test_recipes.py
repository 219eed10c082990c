# SPDX-License-Identifier: BSD-3-Clause
"""Recipes, read by OpenImageIO's own programs with the plugin and by the program without it."""

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import for_hosts
from prestart import run_text

RECIPES = ("flip", "exposures", "cgtmo", "curve", "view", "nested")
ROOT = Path(__file__).resolve().parents[2]


def plugin_folder():
    """That of the build which the program is of."""
    return Path(os.environ["TONETOOL"]).resolve().parents[1] / "tone.imageio"


def environment(**more):
    keep = {key: value for key, value in os.environ.items()
            if key not in ("OIIO_LIBRARY_PATH", "OPENIMAGEIO_OPTIONS", "LD_LIBRARY_PATH")}
    return {**keep, **more}


@pytest.fixture
def host(tmp_path):
    """Runs one of OpenImageIO's programs with nothing but the plugin's folder set."""
    if not (plugin_folder() / "tone.imageio.so").exists():
        pytest.skip("tone.imageio.so is not built")

    slower = 10 if "SANITIZER_RUNTIME" in os.environ else 1

    def run(*words, status=0, seconds=20):
        program = shutil.which(words[0], path="/usr/bin")
        if not program:
            pytest.skip(f"no {words[0]} here")
        own = for_hosts(environment(OIIO_LIBRARY_PATH=str(plugin_folder())))
        limit = seconds * slower
        # What Python loads it loads by its own main; a sanitizer's library is loaded with a program.
        if words[0] != "python3" and slower == 1:
            done = run_text(program, words[1:], tmp_path, limit, own)
        else:
            done = subprocess.run([program, *map(str, words[1:])], cwd=tmp_path, timeout=limit,
                                  capture_output=True, text=True, check=False, env=own)
        if status is not None:
            assert done.returncode == status, (words, done.stdout, done.stderr)
        return done

    return run


@pytest.fixture
def python(host):
    return lambda code, **options: host("python3", "-c", code, **options).stdout.strip()


@pytest.fixture
def recipe(tmp_path):
    """Writes a recipe; files of the test images are ../testimages/NAME in it."""
    (tmp_path / "testimages").symlink_to(ROOT / "testimages")

    def write(name, text, magic="tonetool 1\n"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(magic + text, encoding="utf-8")
        return name

    return write


def pixels_of(file):
    """All subimages, as they are stored, of an image that needs no plugin."""
    image = oiio.ImageInput.open(str(file))
    assert image, oiio.geterror()
    found = []
    while image.seek_subimage(len(found), 0):
        found.append(image.read_image(image.spec().format))
    return found


def assert_same(one, other):
    assert len(one) == len(other)
    for a, b in zip(one, other):
        assert a.dtype == b.dtype
        assert np.array_equal(a, b, equal_nan=True)


# ---- The six recipes

CHAINS = {
    "flip": "gallery_ref.exr gallery_test.exr --hdrflip",
    "exposures": "gallery_ref.exr gallery_test.exr --hdrflip:exposuremap=stops --pop",
    "cgtmo": "gallery_ref.exr --cgtmo",
    "curve": "nightstreet_ref.exr --tonemap:curve=hable:method=mean",
    "view": "--colorconfig ../ocio/tonetool.ocio nightstreet_ref.exr "
            "--tonemap:display=sRGB:view=ACES_SDR",
}


@pytest.mark.parametrize("name", RECIPES)
def test_every_program_reads_what_the_chain_makes(name, host, tonetool, program, tmp_path):
    file = ROOT / "testimages" / f"{name}.tone"
    host("oiiotool", file, "-o", "oiiotool.exr")
    host("iconvert", file, "iconvert.exr")
    tonetool(file, "-o", "own.exr", env=environment())
    expected = pixels_of(tmp_path / "oiiotool.exr")
    assert expected[0].size > 1000 and np.ptp(expected[0].astype(float)) > 0
    assert_same(pixels_of(tmp_path / "iconvert.exr"), expected)
    assert_same(pixels_of(tmp_path / "own.exr"), expected)
    if name in CHAINS:
        words = [word.replace("_SDR", " SDR") for word in CHAINS[name].split()]
        subprocess.run([program, *words, "-o", tmp_path / "chain.exr"], check=True,
                       cwd=ROOT / "testimages", capture_output=True)
        assert_same(pixels_of(tmp_path / "chain.exr"), expected[:1])
    shown = host("iinfo", file).stdout
    height, width, channels = expected[0].shape
    assert " ".join(shown.split()).startswith(
        f"{file} : {width} x {height}, {channels} channel")
    assert "PASS" in host("idiff", "-a", "-fail", "0", file, "oiiotool.exr").stdout


@pytest.mark.parametrize("name", RECIPES)
def test_maketx(name, host, tmp_path):
    file = ROOT / "testimages" / f"{name}.tone"
    host("oiiotool", file, "--subimage", "0", "-o", "file.exr")
    for source in (file, "file.exr"):
        host("maketx", "--nomipmap", "-d", "float", source, "-o", f"{Path(source).stem}.tx")
    assert_same(pixels_of(tmp_path / f"{name}.tx"), pixels_of(tmp_path / "file.tx"))


@pytest.mark.parametrize("name", RECIPES)
def test_python(name, host, python, tmp_path):
    file = ROOT / "testimages" / f"{name}.tone"
    python("import OpenImageIO as oiio, numpy\n"
           f"image = oiio.ImageInput.open('{file}')\n"
           "numpy.save('input.npy', image.read_image(image.spec().format))\n"
           f"buffer = oiio.ImageBuf('{file}')\n"
           "numpy.save('buffer.npy', buffer.get_pixels(image.spec().format))\n")
    host("oiiotool", file, "-o", "file.exr")
    expected = pixels_of(tmp_path / "file.exr")[:1]
    for saved in ("input.npy", "buffer.npy"):
        assert_same([np.load(tmp_path / saved).reshape(expected[0].shape)], expected)


def test_metadata_tells_the_chain_its_inputs_and_what_was_measured(host):
    shown = host("iinfo", "-v", "-a", ROOT / "testimages" / "flip.tone").stdout
    assert ('tone:chain: "gallery_ref.exr gallery_test.exr --hdrflip:exposuremap=stops '
            '--label error"') in shown
    folder = ROOT / "testimages"
    assert f'tone:inputs: "{folder}/gallery_ref.exr;{folder}/gallery_test.exr"' in shown
    assert "FLIP:meanerror: 0." in shown and "FLIP:startExposure" in shown
    assert 'oiio:subimagename: "error"' in shown and "2 subimages" in shown


def test_what_a_recipe_warns_of_is_said_where_it_is_read(tonetool, recipe, make_image):
    image = make_image("a.exr")
    name = recipe("w.tone", "--missingfile black gone.exr --resize 16x12 --ch R,G,B")
    ran = tonetool(image, name, "--hdrflip:fail=0.999", "--warnings-exit", status=2)
    assert f'"{name}": read : File does not exist: "gone.exr", black instead' in ran.err
    outer = recipe("o.tone", f"{name} --mulc 2")
    assert "gone.exr" in tonetool(image, outer, "--hdrflip:fail=0.999").err
    tonetool(name, "-o", "made.exr", "--warnings-exit", status=2)
    tonetool(image, "made.exr", "--hdrflip:fail=0.999", "--warnings-exit")


def test_subimages_are_the_stack_from_the_top_down(host, recipe, tmp_path):
    name = recipe("stack.tone", "--pattern constant:color=1 8x8 1 --pattern constant:color=2 8x8 1 "
                                "--siappend --pattern constant:color=3 8x8 1 --swap")
    host("oiiotool", name, "-o", "stack.exr")
    assert [float(part.max()) for part in pixels_of(tmp_path / "stack.exr")] == [1, 2, 3]


def test_a_sequence_of_recipes(host, recipe, tmp_path):
    for frame in range(1, 9):
        recipe(f"s.{frame:04}.tone", f"--pattern constant:color=0.{frame} 8x8 1")
    host("oiiotool", "--frames", "1-8", "s.#.tone", "-o", "s.#.exr")
    for frame in range(1, 9):
        (pixels,) = pixels_of(tmp_path / f"s.{frame:04}.exr")
        assert np.all(pixels == np.float32(f"0.{frame}").astype(pixels.dtype))


# ---- The language

WORDS = "--pattern constant:color={} 8x8 1"


def value_of(host, *words):
    """Of a constant image."""
    done = host("oiiotool", *words, "--echo", "{TOP.AVGCOLOR}")
    return float(done.stdout)


def test_parameters_by_name_by_hint_and_by_default(host, python, recipe):
    name = recipe("p.tone", "$value = 0.25  # of a comment\n" + WORDS.format("$value"))
    assert value_of(host, name) == 0.25
    assert value_of(host, f"{name}?value=0.5") == 0.5
    assert value_of(host, "--iconfig", "tone:value", "0.75", name) == 0.75
    assert value_of(host, "--iconfig", "tone:value", "0.75", f"{name}?value=0.5") == 0.5
    code = ("import OpenImageIO as oiio\nconfig = oiio.ImageSpec()\n"
            "config.attribute('tone:value', '2')\n"
            f"print(oiio.ImageInput.open('{name}', config).read_image()[0, 0, 0])\n"
            f"print(oiio.ImageBuf('{name}', 0, 0, config).getpixel(0, 0)[0])")
    assert python(code).split() == ["2.0", "2.0"]


def test_comments_quotes_and_line_breaks(tonetool, recipe):
    recipe("q.tone", """# the whole line
--create 8x8 1        # behind a word
--attrib one 'a ; b $none \\'
--attrib two "a \\"b\\" ${word}$$"
$word = "late r"
--attrib three $word \\
--attrib fo\\ ur "it's""" + '" --attrib five x-y\n', magic="tonetool 1  \r\n")
    ran = tonetool("q.tone", "--echo", "{TOP.one}|{TOP.two}|{TOP.three}|{TOP['fo ur']}|{TOP.five}",
                   status=1)
    assert 'parameter "word" has no value' in ran.err and "line 5" in ran.err
    ran = tonetool("q.tone?word=w", "--echo",
                   "{TOP.one}|{TOP.two}|{TOP.three}|{TOP['fo ur']}|{TOP.five}")
    assert ran.out == 'a ; b $none \\|a "b" w$|w|it\'s|x-y\n'


def test_relative_paths_are_relative_to_the_recipe(host, recipe, tmp_path):
    recipe("sub/inner.tone", "../testimages/plain.exr")
    recipe("outer.tone", "sub/inner.tone --colorconfig testimages/../testimages/nosuch.ocio")
    host("oiiotool", "outer.tone", "-o", "outer.exr")
    assert_same(pixels_of(tmp_path / "outer.exr"), pixels_of(ROOT / "testimages/plain.exr"))
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    host("oiiotool", elsewhere / ".." / "outer.tone", "-o", elsewhere / "outer.exr")


def test_a_frame_of_a_sequence(host, recipe, tmp_path):
    recipe("frame.tone", "$frame = 7\nshot.#.exr --frames $frame")
    for frame in (7, 12):
        host("oiiotool", "--pattern", f"constant:color=0.{frame}", "8x8", "1", "-o",
             f"shot.{frame:04}.exr")
    assert value_of(host, "frame.tone") == pytest.approx(0.7)
    assert value_of(host, "frame.tone?frame=12") == pytest.approx(0.12)
    assert 'File does not exist: "shot.0013.exr"' in host(
        "iinfo", "frame.tone?frame=13", status=1).stderr
    recipe("all.tone", "shot.#.exr")
    assert "wildcards fit 2 frames, not one" in host("iinfo", "all.tone", status=1).stderr


def test_a_result_has_the_data_type_that_a_file_would_have(host, recipe):
    for words, expected in (("testimages/srgb8.png", "uint8"), ("testimages/plain.exr", "float"),
                            ("testimages/plain.exr -d half --mulc 2", "half"),
                            ("testimages/white.exr testimages/white.exr -d half --hdrflip",
                             "half")):
        shown = host("iinfo", recipe("type.tone", words)).stdout
        assert f"channel, {expected} tone" in shown, (words, shown)


# ---- What is refused: an error of the host with our text, never a hang (timeout 20) or a crash

REFUSED = {
    "missing.tone": ("nosuch.exr", 'recipe "missing.tone": read : File does not exist'),
    "self.tone": ("self.tone --mulc 2", 'recipe "self.tone" reads itself'),
    "one.tone": ("two.tone", "reads itself: one.tone -> two.tone -> one.tone"),
    "written.tone": ("testimages/plain.exr -o evil.exr", "-o : not allowed here: it writes a file"),
    "tx.tone": ("testimages/plain.exr --otex evil.exr", "not allowed here"),
    "process.tone": ("--threads 1 testimages/plain.exr", "sets up the whole process"),
    "saved.tone": ("testimages/white.exr testimages/white.exr --hdrflip:saveexposures=evil",
                   'modifier "saveexposures" is not allowed here'),
    "unknown.tone": ("testimages/plain.exr --hdrflp", "did you mean --hdrflip"),
    "endless.tone": ("--while 1 --endwhile", "stopped after 100000 words"),
    "empty.tone": ("# nothing", "leaves no image on the stack"),
    "threshold.tone": ("testimages/white.exr testimages/plain.exr --hdrflip:fail=0.001",
                       "a threshold was exceeded"),
    "deep.tone": ("testimages/deep.exr", "is deep (valid: --flatten)"),
    "quote.tone": ("--echo 'a\nb", "line 3: unfinished quotation"),
    "dollar.tone": ("--echo $", "line 2: no name of a parameter"),
    "truncated.tone": ("testimages/truncated.exr", "truncated.exr"),
    "folder.tone": ("testimages", 'recipe "folder.tone": read'),
    "through.tone": ("missing.tone",
                     'recipe "missing.tone": read : File does not exist: "nosuch.exr" (read for '
                     '"through.tone")'),
}


@pytest.fixture
def refused(recipe):
    for name, (text, _) in REFUSED.items():
        recipe(name, text)
    recipe("two.tone", "one.tone")


@pytest.mark.usefixtures("refused")
@pytest.mark.parametrize("name", REFUSED)
def test_refused(name, host, tonetool, tmp_path):
    # As for the truncated file itself, the header is all that iinfo asks for.
    headers = [("iinfo", name)] if name != "truncated.tone" else []
    for words in (("oiiotool", name, "-o", "out.exr"), *headers, ("maketx", name)):
        done = host(*words, status=1)
        assert REFUSED[name][1] in done.stdout + done.stderr, words
        assert "ERROR" in done.stdout + done.stderr
    assert REFUSED[name][1] in tonetool(name, "-o", "out.exr", status=1, env=environment()).err
    assert list(tmp_path.glob("evil*")) == [] and not (tmp_path / "out.exr").exists()


def check_both(name, text, host, tonetool):
    for words in (("oiiotool", name, "-o", "out.exr"), ("iinfo", name)):
        done = host(*words, status=1)
        assert "ERROR" in done.stdout + done.stderr
        assert text in done.stdout + done.stderr, (words, done.stdout, done.stderr)
    assert text in tonetool(name, "-o", "out.exr", status=1, env=environment()).err


def test_nesting_ends(host, recipe, tonetool):
    for depth in range(1000):
        recipe(f"d{depth}.tone", f"d{depth + 1}.tone")
    recipe("d1000.tone", "testimages/plain.exr")
    check_both("d0.tone", 'recipe "d16.tone": recipes are nested deeper than 16', host, tonetool)
    host("oiiotool", "d985.tone", "-o", "deepest.exr")
    check_both("d984.tone", "nested deeper than 16", host, tonetool)


@pytest.mark.parametrize("name", ["x.exr", "noextension", "x.png"])
def test_a_recipe_of_another_name(name, host, recipe, tonetool):
    recipe(name, "testimages/plain.exr")
    text = f'"{name}" is a recipe of tonetool, whose name must end in .tone'
    check_both(name, text, host, tonetool)
    recipe("around.tone", name)
    check_both("around.tone", text, host, tonetool)


def test_what_is_no_recipe(host, recipe, tonetool, tmp_path):
    recipe("big.tone", " " * 100_000_000)
    check_both("big.tone", "is larger than 1 MB", host, tonetool)
    noise = np.random.default_rng(7).integers(0, 256, 5000, dtype=np.uint8).tobytes()
    (tmp_path / "rubbish.tone").write_bytes(noise)
    check_both("rubbish.tone", 'its first line is not "tonetool 1"', host, tonetool)
    (tmp_path / "half.tone").write_bytes(b"tonetool 1\n" + noise)
    check_both("half.tone", "is no text: it has a byte of value", host, tonetool)
    recipe("two.tone", "", magic="tonetool 2\n")
    check_both("two.tone", 'is of another version, "tonetool 2" (valid: "tonetool 1")', host,
               tonetool)
    (tmp_path / "nothing.tone").write_bytes(b"")
    check_both("nothing.tone", "is no recipe", host, tonetool)


def test_a_corrupt_file_of_another_format_is_not_ours(host, tmp_path):
    (tmp_path / "corrupt.exr").write_bytes(b"\x76\x2f\x31\x01 and no more")
    done = host("oiiotool", "corrupt.exr", "-o", "out.exr", status=1)
    assert "recipe" not in done.stdout + done.stderr


def test_misspelt_parameters(host, recipe, tonetool):
    name = recipe("p.tone", "$frame = 1\n" + WORDS.format("$frame"))
    text = 'no parameter "fram", did you mean "frame"? (valid: frame)'
    check_both(f"{name}?fram=2", text, host, tonetool)
    assert text in host("oiiotool", "--iconfig", "tone:fram", "2", name, "-o", "out.exr",
                        status=1).stderr
    check_both(f"{recipe('n.tone', 'testimages/plain.exr')}?x=2", 'no parameter "x" (it has none)',
               host, tonetool)


# ---- One process, many reads

def test_a_changed_input_is_computed_anew(python, recipe):
    recipe("sum.tone", "a.tif inner.tone --add")
    recipe("inner.tone", "b.tif --mulc 10")
    code = """
import OpenImageIO as oiio, os
def write(name, value):
    oiio.ImageBufAlgo.fill((value,), roi=oiio.ROI(0, 8, 0, 8, 0, 1, 0, 1)).write(name, 'float')
def read():
    return float(oiio.ImageInput.open('sum.tone').read_image()[0, 0, 0])
write('a.tif', 1.0); write('b.tif', 2.0)
values = [read(), read()]
held = oiio.ImageInput.open('sum.tone')
values.append(float(held.read_image()[0, 0, 0]))
for name, value in (('a.tif', 3.0), ('b.tif', 4.0), ('b.tif', 5.0)):
    write(name, value)
    values.append(read())
values.append(float(held.read_image()[0, 0, 0]))
stamp = os.stat('a.tif')
write('a.tif', 7.0)
os.utime('a.tif', ns=(stamp.st_atime_ns, stamp.st_mtime_ns))
values.append(read())
open('inner.tone', 'w').write('tonetool 1\\nb.tif')
values.append(read())
print(values)
"""
    assert python(code) == str([21.0, 21.0, 21.0, 23.0, 43.0, 53.0, 53.0, 57.0, 12.0])


# The first array that OpenImageIO's module makes imports numpy, which two threads at a time hang in.
FIRST_ARRAY = """
oiio.ImageBufAlgo.zero(roi=oiio.ROI(0, 1, 0, 1, 0, 1, 0, 1)).get_pixels()
"""


def test_many_threads(python, recipe):
    for i in range(20):
        recipe(f"flat{i}.tone", f"--pattern constant:color={i} 64x64 3 --blur 5x5")
        recipe(f"over{i}.tone", f"flat{i}.tone flat{(i + 1) % 20}.tone --add")
    code = """
import OpenImageIO as oiio, threading
""" + FIRST_ARRAY + """
wrong = []
def look(n):
    i, over = n % 40 // 2, n % 2
    for attempt in range(3):
        image = oiio.ImageInput.open(f"{'over' if over else 'flat'}{i}.tone")
        value = float(image.read_image()[32, 32, 1]) if image else oiio.geterror()
        if not abs(value - (i + (i + 1) % 20 if over else i)) < 1e-3:
            wrong.append((n, value))
threads = [threading.Thread(target=look, args=(n,)) for n in range(160)]
[t.start() for t in threads]; [t.join() for t in threads]
print(wrong)
"""
    assert python(code, seconds=60) == "[]"


def test_threads_that_meet_in_a_cycle(python, recipe):
    for i in range(4):
        recipe(f"c{i}.tone", f"--create 64x64 3 --blur 9x9 c{(i + 1) % 4}.tone")
    code = """
import OpenImageIO as oiio, threading
opened = []
def look(n):
    opened.append(oiio.ImageInput.open(f"c{n % 4}.tone"))
    assert 'reads itself' in oiio.geterror()
threads = [threading.Thread(target=look, args=(n,)) for n in range(32)]
[t.start() for t in threads]; [t.join() for t in threads]
print(len(opened), [o for o in opened if o])
"""
    assert python(code) == "32 []"


def test_tiles_of_an_image_cache_are_read_by_its_threads(python, recipe):
    recipe("big.tone", "--pattern checker:width=7 512x512 3 --blur 3x3 --resize 700x700")
    code = """
import OpenImageIO as oiio
oiio.attribute('threads', 8)
image = oiio.ImageBuf('big.tone')
print(oiio.ImageBufAlgo.computePixelStats(oiio.ImageBufAlgo.resize(image, roi=oiio.ROI(
    0, 300, 0, 300, 0, 1, 0, 3))).avg[0] > 0, image.has_error)
"""
    assert python(code) == "True False"


@pytest.mark.usefixtures("plain_memory")
def test_opening_often_needs_no_memory(python, recipe):
    name = recipe("small.tone", "$value = 1\n--pattern constant:color=$value 64x64 4")
    recipe("wrong.tone", "$value = 1\nnosuch.exr")
    code = f"""
import OpenImageIO as oiio, os
def resident():
    return int(open('/proc/self/statm').read().split()[1]) * os.sysconf('SC_PAGE_SIZE')
def look(n):
    value = n % 100
    # The module never deletes a reader, and one that is closed keeps nothing.
    image = oiio.ImageInput.open(f'{name}?value={{value}}')
    assert image.read_scanline(9, 0)[0, 0] == value
    image.close()
    if n % 20 == 0:
        assert not oiio.ImageInput.open(f'wrong.tone?value={{n}}') and oiio.geterror()
[look(n) for n in range(1000)]
before = resident()
[look(n) for n in range(10000)]
print((resident() - before) >> 20)
"""
    assert int(python(code, seconds=120)) < 8


def test_opening_reads_headers_and_the_first_look_runs_the_chain(python, recipe):
    recipe("flip.tone", "testimages/cornell_ref.exr testimages/cornell_test.exr --hdrflip")
    recipe("broken.tone", "testimages/truncated.exr --exposure 1")
    code = """
import OpenImageIO as oiio
image = oiio.ImageInput.open('flip.tone')
size = image.spec_dimensions(0)
print(size.width, size.height, size.nchannels, size.format)
print(image.spec().getattribute('FLIP:meanerror') > 0, image.seek_subimage(1, 0))
print(image.read_image().shape)
image = oiio.ImageInput.open('broken.tone')
print(image.spec_dimensions(0).width, image.read_image(), 'truncated.exr' in image.geterror())
"""
    assert python(code).splitlines() == ["96 96 1 float", "True False", "(96, 96, 1)",
                                         "64 None True"]


# ---- --doctor

def doctor(tonetool, status, **variables):
    ran = tonetool("--doctor", status=status, env=for_hosts(environment(**variables)))
    return ran.out + ran.err


def test_doctor(tonetool, host, tmp_path):
    folder = plugin_folder()
    host("oiiotool", "--version")
    assert "doctor: oiiotool reads recipes" in doctor(tonetool, 0, OIIO_LIBRARY_PATH=str(folder))
    said = doctor(tonetool, 1)
    assert "OIIO_LIBRARY_PATH is not set; this line mends it:" in said
    (line,) = [line.strip() for line in said.splitlines() if "  export " in line]
    mended = subprocess.run(["sh", "-c", f"{line}\n{os.environ['TONETOOL']} --doctor"],
                            env=for_hosts(environment()), capture_output=True, text=True,
                            check=False)
    assert mended.returncode == 0, mended.stderr
    assert "no tone.imageio.so in" in doctor(tonetool, 1, OIIO_LIBRARY_PATH=str(tmp_path))
    assert '"/no/such" is no folder' in doctor(tonetool, 1, OIIO_LIBRARY_PATH="/no/such")
    (tmp_path / "tone.imageio.so").write_bytes(b"no library")
    assert "cannot be loaded" in doctor(tonetool, 1, OIIO_LIBRARY_PATH=str(tmp_path))
    (tmp_path / "tone.imageio.so").unlink()
    shutil.copy(folder / "tone.imageio.so", tmp_path / "libtone.imageio.so")
    assert "must be named tone.imageio.so" in doctor(tonetool, 1, OIIO_LIBRARY_PATH=str(tmp_path))
    empty = doctor(tonetool, 1, PATH=str(tmp_path))
    assert "there is no oiiotool on the PATH" in empty


def test_the_plugin_shows_its_own_names_only(host):
    host("oiiotool", "--version")
    listed = subprocess.run(["nm", "-D", "--defined-only", plugin_folder() / "tone.imageio.so"],
                            capture_output=True, text=True, check=True).stdout
    assert {line.split()[-1] for line in listed.splitlines()} == {
        "tone_imageio_version", "tone_imageio_library_version", "tone_input_imageio_create",
        "tone_input_extensions"}


def test_a_recipe_is_held_to_what_a_command_line_is(tonetool, make_image, tmp_path):
    for seed in (1, 2, 3):
        make_image(f"{seed}.exr", seed=seed)
    (tmp_path / "check.tone").write_text("tonetool 1\n1.exr 2.exr 2.exr --hdrflip:fail=0.9\n")
    ran = tonetool("check.tone", "-o", "x.exr", status=1)
    assert '"1.exr" was never compared' in ran.err
    (tmp_path / "name.tone").write_text("tonetool 1\n1.exr\n")
    assert not tonetool("name.tone", "-o", "x.exr", "--warnings-exit").err
    (tmp_path / "two.tone").write_text("tonetool 1\n1.exr 2.exr\n")
    assert '"1.exr" was read, but no command used it' in tonetool("two.tone", "-o", "x.exr").err
