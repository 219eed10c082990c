# SPDX-License-Identifier: BSD-3-Clause
"""The page of --report in a browser: Chromium, driven by Selenium; skips where they are not."""

import base64
import http.server
import json
import shutil
import threading
import time

import numpy as np
import OpenImageIO as oiio
import pytest

from conftest import TESTIMAGES, call
from crypto_pair import Render

webdriver = pytest.importorskip("selenium.webdriver", reason="no python3-selenium here")
from selenium.webdriver.chrome.options import Options  # noqa: E402
from selenium.webdriver.chrome.service import Service  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.wait import WebDriverWait  # noqa: E402

ANIM = TESTIMAGES / "anim"
CHECK = ("--hdrflip:exposures=shot:fail=0.7:quantity=p99",)


def made(program, folder, *words, status):
    ran = call(program, words, folder)
    assert ran.status == status, (ran.status, ran.out, ran.err)
    return folder


@pytest.fixture(scope="module")
def driver(tmp_path_factory):
    chromium, chromedriver = shutil.which("chromium"), shutil.which("chromedriver")
    if not chromium or not chromedriver:
        pytest.skip("no chromium or no chromedriver here")
    options = Options()
    options.binary_location = chromium
    profile = tmp_path_factory.mktemp("profile")
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--window-size=1440,900", f"--user-data-dir={profile}"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    browser = webdriver.Chrome(service=Service(chromedriver), options=options)
    yield browser
    browser.quit()


@pytest.fixture(scope="module")
def page_file(tmp_path_factory):
    import os
    folder = made(os.environ["TONETOOL"], tmp_path_factory.mktemp("page"), "--frames", "1-9",
                  ANIM / "ref.#.exr", ANIM / "test.#.exr", *CHECK, "--report", "page.html",
                  status=1)
    return folder / "page.html"


class Page:
    """A page that is open, and what one asks it."""

    def __init__(self, driver, file):
        self.driver = driver
        driver.get("about:blank")  # the browser's own first page has requests of its own
        for log in ("browser", "performance"):
            driver.get_log(log)
        self.size(1440, 900)
        driver.get(file.as_uri())

    def size(self, width, height):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def ask(self, script, *arguments):
        return self.driver.execute_script(f"return {script}", *arguments)

    def until(self, script, *arguments):
        """Waits for what the page does with its next frames, as for a chart that takes a new size."""
        WebDriverWait(self.driver, 20).until(lambda _: self.ask(script, *arguments), script)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.one(selector).text

    def keys(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()

    def frame(self):
        return self.text("#frame-title").split()[1]

    def ready(self):
        """Waits until the frame that was asked for is decoded and drawn."""
        self.driver.execute_async_script(
            "const done = arguments[0]; viewer.ready.then(() => { drawPanesNow(); done(); })")

    def split(self):
        """Where the reference ends, in percent of the picture."""
        box, edge = self.one(".pane.large").rect, self.one(".edge").rect
        return 100 * (edge["x"] + edge["width"] / 2 - box["x"]) / box["width"]

    def shown(self, pane=0):
        """What is drawn in a pane, as a text."""
        return self.ask("(drawPanesNow(), view.panes[arguments[0]].canvas.toDataURL())", pane)

    def shade(self, x, y, pane=0):
        """R, G, B of a pixel of a pane."""
        return self.ask("""(() => {
          drawPanesNow();
          const pen = make("canvas", { width: 1, height: 1 }).getContext("2d", { willReadFrequently: true });
          pen.drawImage(view.panes[arguments[0]].canvas, -arguments[1], -arguments[2]);
          return [...pen.getImageData(0, 0, 1, 1).data].slice(0, 3); })()""", pane, x, y)

    def point(self, x, y):
        """The pointer goes to a pixel of the picture."""
        left, top = self.ask("(() => { const { scale, left, top } = originOf(largePane());"
                             " return [left + (arguments[0] + 0.5) * scale, top + (arguments[1] + 0.5) * scale]; })()", x, y)
        box = self.one(".pane.large")
        self.driver.execute_script("arguments[0].scrollIntoView({ block: 'center' })", box)
        ActionChains(self.driver).move_to_element_with_offset(
            box, round(left - box.rect["width"] / 2), round(top - box.rect["height"] / 2)).perform()

    def values(self):
        return {key: text for key, text in self.ask(
            "[...document.querySelectorAll('#readout p:first-child span')].map((one) => one.querySelector('b')"
            " ? [one.querySelector('b').textContent, one.lastChild.textContent.trim()] : ['', ''])")}

    def complaints(self):
        return [entry for entry in self.driver.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING")]

    def requests(self):
        messages = [json.loads(entry["message"])["message"]
                    for entry in self.driver.get_log("performance")]
        return [message["params"]["request"]["url"] for message in messages
                if message["method"] == "Network.requestWillBeSent"]


@pytest.fixture
def page(driver, page_file):
    opened = Page(driver, page_file)
    opened.ready()
    yield opened
    opened.driver.execute_script("localStorage.clear()")
    opened.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})
    assert opened.complaints() == []
    assert {url.split(":")[0] for url in opened.requests()} <= {"data", "file"}


def select(page, number):
    page.driver.execute_script("select(arguments[0])", number - 1)
    page.ready()


def test_the_verdict_comes_first_and_the_worst_frame_with_it(page):
    assert page.ask("document.body.innerText.trim().split('\\n')[0].toLowerCase()") in (
        "missing", "to the pictures")
    assert page.text("h1").lower() == "missing"
    assert page.text(".sentence") == "2 of 9 frames need a look: frame 9: missing; frame 5: hdrflip: p99 0.971931 > 0.7"
    assert "9 frames: 1 missing, 1 failed, 7 passed" in page.text(".counted")
    worst = [row.text.split("\n")[0] for row in page.all("#worst strong")]
    assert worst[:2] == ["Frame 9", "Frame 5"]
    select(page, 5)
    assert "failed" in page.text("#frame-title")
    assert "p99" in page.text("#message")
    tops = [page.ask("document.querySelector(arguments[0]).getBoundingClientRect().top", selector)
            for selector in ("header.verdict", ".curve", ".viewer", ".all", ".about")]
    assert tops == sorted(tops)


def test_the_wipe_by_mouse_and_by_keys(page):
    select(page, 5)
    assert page.split() == pytest.approx(50, abs=0.5)
    before = page.shown()
    box = page.one(".pane.large")
    chain = ActionChains(page.driver).move_to_element(page.one(".edge")).click_and_hold()
    chain.move_by_offset(int(box.rect["width"] / 4), 0).release().perform()
    assert page.split() == pytest.approx(75, abs=1)
    assert page.ask("view.zoom") is None  # it did not move the picture
    assert page.shown() != before
    assert page.one("#slide").get_attribute("value") == str(round(page.split()))
    page.keys("[")
    assert page.split() == pytest.approx(70, abs=1)
    page.driver.execute_script("document.getElementById('slide').focus()")
    page.keys(Keys.ARROW_LEFT)
    assert page.split() == pytest.approx(69, abs=1)
    assert page.frame() == "5"  # the arrow was the slider's
    page.keys(Keys.HOME)
    assert page.split() == pytest.approx(0, abs=0.5)


TRANSFORM = "(() => { const { scale, left, top } = originOf(largePane()); return [scale, left, top]; })()"


def test_toggle_and_blink_in_place(page):
    select(page, 5)
    page.point(20, 10)
    page.keys("4")
    box, transform = page.one(".pane.large").rect, page.ask(TRANSFORM)
    seen = []
    for key, reference in (("t", 0), ("t", 100), (" ", 0)):
        page.keys(key)
        assert page.split() == pytest.approx(reference, abs=0.5)
        assert page.one(".pane.large").rect == box  # nothing moves
        assert page.ask(TRANSFORM) == transform
        seen.append(page.shown())
    assert seen[0] == seen[2] != seen[1]
    page.keys("e", "t")
    assert page.ask("view.panes[0].what") == "compare"  # the pair comes back
    page.keys("b")
    assert page.one("#blink").get_attribute("aria-pressed") == "true"
    first = page.split()
    page.until("Math.abs(viewer.split - arguments[0]) > 50", first)
    page.until("Math.abs(viewer.split - arguments[0]) < 50", first)
    page.keys("[")
    assert page.one("#blink").get_attribute("aria-pressed") == "false" and page.ask("viewer.blink") is None
    page.one("#blink").click()
    page.one("#toggle").click()
    assert page.ask("viewer.blink") is None
    select(page, 9)  # no pictures
    assert not page.one("#toggle").is_enabled() and not page.one("#blink").is_enabled()


def test_a_link_leads_to_a_frame(page, page_file):
    select(page, 4)
    assert page.ask("location.hash") == "#4"
    length = page.ask("history.length")
    page.keys(Keys.ARROW_RIGHT)
    assert page.ask("location.hash") == "#5" and page.ask("history.length") == length
    page.driver.execute_script("location.hash = '#7'")
    page.until("document.getElementById('frame').value === '6'")
    page.driver.execute_script("location.hash = '#nothing'")
    assert page.frame() == "7"
    page.driver.get("about:blank")
    page.driver.get(page_file.as_uri() + "#3")
    page.ready()
    assert page.frame() == "3"


def test_the_frames_to_render_again(page):
    assert page.text("#bad-frames") == "5,9"
    page.one("#copy").click()
    page.until("document.getElementById('copied').textContent !== ''")
    assert page.ask("getSelection().toString()") == "5,9"
    assert page.ask("rangeText([11, 3, 9, 10, 3, -1])") == "-1,3,9-11"


def test_keys_step_through_the_frames(page):
    select(page, 5)
    page.keys(Keys.ARROW_RIGHT)
    assert page.frame() == "6"
    page.keys(Keys.ARROW_LEFT, Keys.ARROW_LEFT)
    assert page.frame() == "4"
    page.keys(Keys.END)
    assert page.frame() == "9"
    page.keys(Keys.ARROW_RIGHT)
    assert page.frame() == "9"
    assert not page.one("#next").is_enabled()
    page.ready()
    assert "No pictures" in page.text("#stage")
    page.keys(Keys.HOME)
    assert page.frame() == "1"
    page.keys("N")
    assert page.frame() == "9"
    page.keys("n")
    assert page.frame() == "5"
    page.one("#next").click()
    assert page.frame() == "6"
    page.all("#worst button")[1].click()
    assert page.frame() == "5"
    assert page.one("#worst [aria-current=true] strong").text == "Frame 5"


def halves_of(uris, numbers):
    """Sum and weighted sum of half floats, as numpy has them from the two pictures."""
    parts = []
    for key in ("high", "low"):
        file = numbers / f"{key}.png"
        file.write_bytes(base64.b64decode(uris[key].split(",")[1]))
        source = oiio.ImageInput.open(str(file))
        parts.append(source.read_image("uint8").astype(np.int64))
        source.close()
    flat = (parts[0] << 8 | parts[1]).reshape(-1)
    return [int(flat.sum()), int((flat * (np.arange(flat.size) % 97 + 1)).sum())]


def beauty(file):
    source = oiio.ImageInput.open(str(file))
    names = [f"ViewLayer.Combined.{c}" for c in "RGB"]
    pixels = source.read_image("float")[..., [source.spec().channelnames.index(n) for n in names]]
    source.close()
    return pixels


def test_halves_are_joined_to_the_bit(page, tmp_path):
    select(page, 5)
    for block, part in (("full", "near"), ("exact", None)):
        uris = page.ask("((block) => (arguments[1] ? block[arguments[1]] : block).test)"
                        "(picturesOf(4, arguments[0]))", block, part)
        sums = page.driver.execute_async_script("""
          const [numbers, done] = arguments;
          halfSource(numbers, viewer.frame.size, {}).then(({ levels: [{ codes }] }) => done([
            codes.reduce((sum, code) => sum + code, 0),
            codes.reduce((sum, code, i) => sum + code * (i % 97 + 1), 0)]));""", uris)
        assert sums == halves_of(uris, tmp_path)


def test_values_under_the_pointer_are_those_of_the_file(page):
    select(page, 5)
    reference, test = (beauty(ANIM / f"{part}.0005.exr") for part in ("ref", "test"))
    for x, y in ((3, 4), (30, 17), (47, 27)):
        page.point(x, y)
        values = page.values()
        assert values["x, y"] == f"{x}, {y}"
        for name, pixels in (("Reference", reference), ("Test", test)):
            shown = [float(word) for word in values[name].split("A")[0].split()]
            # Mantissas of 7 bits, shown with four digits.
            assert shown == pytest.approx(pixels[y, x], rel=1 / 256 + 1e-4, abs=1e-6)
            assert values[name].endswith("A 1")
        light = [pixels[y, x] @ [0.2126, 0.7152, 0.0722] for pixels in (reference, test)]
        stops = float(values["Difference"].split()[0].replace("\u2212", "-"))
        assert stops == pytest.approx(np.log2(light[1] / light[0]), abs=0.02)
        assert 0 <= float(values["Error"]) <= 1  # known, not about
    page.point(30, 17)
    page.keys("p")
    page.point(3, 4)
    pins = [row.text for row in page.all("#readout .values")]
    assert len(pins) == 2 and "30, 17" in pins[1]
    page.keys("P")
    assert len(page.all("#readout .values")) == 1


def test_values_that_are_only_in_the_picture_say_so(page):
    select(page, 4)
    page.driver.execute_script("viewer.frame.sides.test.numbers = []; viewer.frame.nearError = null")
    test = beauty(ANIM / "test.0004.exr")
    page.point(20, 20)
    values = page.values()
    assert values["Test"].startswith("about ") and values["Test"].endswith("(from the picture)")
    shown = [float(word) for word in values["Test"].split()[1:4]]
    assert np.log2(shown) == pytest.approx(np.log2(test[20, 20]), abs=1.5)
    assert values["Error"].startswith("about ")
    assert not values["Reference"].startswith("about ")


def test_zoom_at_the_pointer_shows_the_right_pixel(page):
    select(page, 5)
    page.keys("t")  # the test alone
    page.point(30, 17)
    page.keys("8")
    scale, left, top = page.ask(TRANSFORM)
    assert scale == 8
    assert page.values()["x, y"] == "30, 17"
    pixels = beauty(ANIM / "test.0005.exr") * 2 ** page.ask("shownStops()")
    for dx in (-1, 0, 1):  # nearest neighbour: the middle of each pixel has its colour
        light = np.clip(pixels[17, 30 + dx], 0, 1)
        code = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055) * 255
        shade = page.shade(round(left + 8 * (30 + dx) + 4), round(top + 8 * 17 + 4))
        assert shade == pytest.approx(code, abs=2)
    select(page, 6)
    assert page.ask(TRANSFORM) == [scale, left, top]  # from frame to frame
    page.keys("s")
    assert page.ask(TRANSFORM) == [scale, left, top]
    page.keys("f")
    assert page.ask("view.zoom") is None


def test_pictures_that_lie_on_their_side(page):
    """What is shown of a pixel leads back to that pixel, in each of Exif's orientations."""
    assert page.ask("""[1, 2, 3, 4, 5, 6, 7, 8].every((orientation) => {
      const full = { x: 10, y: 20, width: 30, height: 7, orientation };
      const lies = orientation > 4;
      const seen = new Set();
      for (let y = 20; y < 27; y++) for (let x = 10; x < 40; x++) {
        const place = shownPlace(full, { x, y, width: 1, height: 1 });
        if (!inside({ x: 0, y: 0, width: lies ? 7 : 30, height: lies ? 30 : 7 }, place.x, place.y)) return false;
        if (String(filePixel(full, place.x, place.y)) !== String([x, y])) return false;
        seen.add(`${place.x} ${place.y}`);
      }
      return seen.size === 210; })""")
    # Orientation 6: the first row of the file is at the right, its first pixel above.
    assert page.ask("shownPlace({ x: 0, y: 0, width: 30, height: 7, orientation: 6 },"
                    " { x: 2, y: 1, width: 3, height: 1 })") == {"x": 5, "y": 2, "width": 1, "height": 3}


def test_wheel_drag_and_double_click(page):
    select(page, 5)
    page.keys("c")
    box = page.one(".pane.large")
    page.driver.execute_script("arguments[0].scrollIntoView({ block: 'center' })", box)
    origin = ScrollOrigin.from_element(box, -100, -60)
    ActionChains(page.driver).scroll_from_origin(origin, 0, -240).perform()
    assert page.ask("view.zoom") is None  # the page scrolls, as the picture has no focus
    page.driver.execute_script("document.getElementById('stage').focus();"
                               "arguments[0].scrollIntoView({ block: 'center' })", box)
    page.point(10, 6)
    fit = page.ask("scaleOf(largePane())")
    ActionChains(page.driver).scroll_from_origin(origin, 0, -240).perform()
    page.until("scaleOf(largePane()) > 1.9 * arguments[0]", fit)
    before = page.ask(TRANSFORM)
    chain = ActionChains(page.driver).move_to_element_with_offset(box, -150, 40).click_and_hold()
    chain.move_by_offset(60, -30).release().perform()
    after = page.ask(TRANSFORM)
    assert after[0] == before[0]
    assert [after[1] - before[1], after[2] - before[2]] == pytest.approx([60, -30], abs=1)
    ActionChains(page.driver).move_to_element_with_offset(box, -150, 40).double_click().perform()
    assert page.ask("scaleOf(largePane())") == 1


def test_exposures_by_mouse_and_by_keys(page):
    select(page, 5)
    assert page.text("#exposure-value") == "0.0"  # as rendered
    worst = page.ask("viewer.frame.full.start")
    page.keys("0")
    assert page.text("#exposure-value").endswith("(worst)")
    seen = [page.shown()]
    page.keys(".")
    assert page.ask("view.stops") == pytest.approx(round(worst + 0.5, 1), abs=0.06)
    seen.append(page.shown())
    page.keys(",", ",")
    seen.append(page.shown())
    assert len(set(seen)) == 3
    select(page, 4)
    assert page.ask("view.stops") == pytest.approx(round(worst - 0.5, 1), abs=0.11)  # of all frames
    page.driver.execute_script("setStops(0.04)")
    assert page.text("#exposure-value") == "0.0"
    page.driver.execute_script("setStops(-0.04)")
    assert page.text("#exposure-value") == "0.0" and page.ask("Object.is(view.stops, 0)")
    page.driver.execute_script("document.getElementById('exposure').focus()")
    page.keys(Keys.ARROW_RIGHT)
    assert page.ask("view.stops") == 0.1
    page.keys(Keys.END)
    assert page.ask("view.stops") == 10
    page.keys("0")
    assert page.ask("view.stops") is None and page.ask("shownStops()") == page.ask("viewer.frame.full.start")
    page.keys("z")
    assert page.ask("view.stops") == 0


def test_channels_alone_and_together(page):
    select(page, 5)
    page.keys("t", "z")
    whole = page.shown()
    seen = set()
    for key in "rgyRGBYA":
        page.keys(key)
        assert page.ask("view.channel") == key.lower()
        shade = page.shade(40, 40)
        assert shade[0] == shade[1] == shade[2]
        seen.add(page.shown())
        page.keys(key)
        assert page.ask("view.channel") == "" and page.shown() == whole
    assert len(seen) == 5
    page.all("#channels label")[2].click()
    assert page.ask("view.channel") == "g"


def test_maps_with_legends_beside_and_large(page):
    select(page, 5)
    assert [title.text.split("\n")[0] for title in page.all("#maps h3")] == [
        "Error map", "Exposure map"]
    legends = [legend.text.split("\n") for legend in page.all("#maps .legend")]
    assert legends[0] == ["0 same", "1 different"]
    assert legends[1][1].endswith("stops")
    pair = page.shown()
    page.keys("e")
    error = page.shown()
    assert error != pair and page.ask("view.panes.map((pane) => pane.what)") == ["error", "stops"]
    page.keys("s")
    assert page.shown() not in (pair, error)
    page.keys("c")
    assert page.shown() == pair
    page.all("#maps .plain")[0].click()
    assert page.shown() == error
    page.keys("c", "l")
    assert page.ask("view.panes.map((pane) => pane.what)") == ["reference", "test", "error", "stops"]
    page.keys("1")
    assert page.ask("new Set(view.panes.map((pane) => scaleOf(pane))).size") == 1
    page.keys("l")


def test_decisions_are_kept_and_exported(page, page_file):
    assert page.ask("document.getElementById('decision').hidden")  # no fault, nothing to decide
    page.driver.execute_script("""
      frames[4].faults.push({ code: "hole", severity: "error", sentence: "A hole.", rectangle: [8, 4, 6, 3] },
        { code: "firefly", severity: "warning", sentence: "A firefly.", position: { x: 30, y: 17 }, layer: "L" });""")
    page.driver.execute_script("select(4, 1)")
    page.ready()
    assert page.ask("location.hash") == "#5/1"
    (rectangle,) = page.all(".pane.large rect.mark")
    scale, left, top = page.ask(TRANSFORM)
    assert float(rectangle.get_attribute("x")) == pytest.approx(left + 8 * scale)
    assert float(rectangle.get_attribute("width")) == pytest.approx(6 * scale)
    assert scale == max(8, page.ask("fitting(largePane())"))
    assert page.all(".pane.large circle.mark.warning")
    page.keys("j")
    assert page.ask("location.hash") == "#5/2" and page.ask("viewer.fault") == 2
    page.keys("k", "a")
    assert page.one("#accepted").get_attribute("aria-pressed") == "true"
    page.keys("i")
    page.keys("so it is, a")  # letters are of the note
    page.keys(Keys.ESCAPE)
    page.one("#by").send_keys("Ann")
    page.keys(Keys.ESCAPE, "j", "x")
    assert "rejected" in page.text("#found") and "accepted: so it is, a" in page.text("#found")
    exported = json.loads(page.ask("acceptedText()"))
    assert exported == {"check": page.ask("data.shot.id"), "accepted": [
        {"frame": 5, "code": "hole", "by": "Ann", "why": "so it is, a"}]}
    assert page.text("#export") == "Export accepted (1)"
    page.driver.get("about:blank")
    page.driver.get(page_file.as_uri())
    page.ready()
    assert page.one("#by").get_attribute("value") == "Ann"
    assert page.ask("Object.values(decisions.of).map(({ what }) => what)") == ["accepted", "rejected"]


def test_what_the_page_exports_the_program_accepts(driver, program, tmp_path):
    line = ["--frames", "4-6", "-q", ANIM / "test.#.exr", "--qc"]
    made(program, tmp_path, *line, "--report", "page.html", status=3)
    page = Page(driver, tmp_path / "page.html")
    page.ready()
    assert page.frame() == "5" and not page.all(".edge")  # one picture is no pair
    assert page.text("#bad-frames") == "5"
    page.keys("a")
    assert page.ask("document.getElementById('bad').hidden")
    (tmp_path / "accepted.json").write_text(page.ask("acceptedText()"))
    page.driver.execute_script("localStorage.clear()")
    assert page.complaints() == []
    made(program, tmp_path, *line, "--accept", "accepted.json", "--report", "page.html", status=0)
    page = Page(driver, tmp_path / "page.html")
    assert "faults of 1 frame are accepted" in page.text(".sentence")


def test_the_layer_of_a_fault_is_shown_beside_it(driver, program, tmp_path):
    made(program, tmp_path, "--frames", "4-6", "-q", ANIM / "ref.#.exr", ANIM / "test.#.exr",
         "--against", "--qc", "--report", "page.html", status=3)
    page = Page(driver, tmp_path / "page.html")
    page.ready()
    layer = page.ask("frames[1].faults.find((fault) => fault.code === 'blacklayer').layer")
    shown = page.ask("""[...document.querySelectorAll("#found .layers img")]
        .filter((one) => one.alt.startsWith(arguments[0] + " "))
        .map((one) => [one.alt, one.naturalWidth, one.complete])""", layer)
    width = min(256, oiio.ImageInput.open(str(ANIM / "test.0005.exr")).spec().width)
    assert shown == [[f"{layer} of the reference", width, True], [f"{layer} of the test", width, True]]
    assert page.complaints() == []


def test_help_filter_and_sort(page):
    page.keys("?")
    assert page.one("#help").is_displayed() and "wipe to the left" in page.text("#help")
    page.keys("b")
    assert page.ask("viewer.blink") is None  # the help has the keyboard
    page.keys(Keys.ESCAPE)
    assert not page.one("#help").is_displayed()
    page.keys("/", "miss")
    assert [row.text.split()[0] for row in page.all("#all tbody tr")] == ["9"]
    assert page.text("#all-count") == "1 of 9 frames"
    page.driver.execute_script("const box = document.getElementById('filter'); box.value = ''; box.oninput()")
    page.driver.execute_script("const box = document.getElementById('sort'); box.value = 'worst'; box.oninput()")
    assert [row.text.split()[0] for row in page.all("#all tbody tr")][:3] == ["9", "5", "1"]


def test_hover_and_click_on_the_curve(page):
    canvas = page.one("#curve")
    x, y = page.ask("(() => { const at = curve.chart.getDatasetMeta(0).data[4];"
                    " return [at.x, at.y]; })()")
    rect = canvas.rect
    chain = ActionChains(page.driver)
    chain.move_to_element_with_offset(canvas, x - rect["width"] / 2, y - rect["height"] / 2)
    chain.perform()
    assert page.ask("curve.chart.tooltip.opacity") > 0
    assert page.ask("curve.chart.tooltip.title") == ["Frame 5"]
    assert "(failed)" in page.ask("curve.chart.tooltip.body[0].lines[0]")
    chain.click().perform()
    assert page.frame() == "5"
    assert page.ask("curve.chart.data.datasets.map((set) => set.label)") == [
        "p99", "no result", "fail 0.7"]
    assert "frame 5" in canvas.get_attribute("aria-label")
    page.driver.execute_script(
        "const box = document.getElementById('quantity'); box.value = 'mean'; box.onchange({target: box})")
    assert page.ask("curve.chart.data.datasets[0].label") == "mean"


def test_numbers_histogram_and_parameters_of_a_frame(page):
    select(page, 5)
    facts = page.text("#facts")
    for word in ("p99", "weighted-median", "Parameters", "tonemapper", "ppd", "test.0005.exr"):
        assert word in facts
    bars = page.ask("facts.histograms[0].data.datasets[0].data.filter(Boolean)"
                    ".reduce((a, b) => a + b)")
    assert f"{bars}" in facts  # every pixel
    assert page.all("#near img") and page.all("#near .crops figcaption")[0].text == "reference"


def test_whose_error_it_is(driver, program, tmp_path):
    """Findings as sentences, then three tables: each a region that the keyboard scrolls."""
    render = Render(seed=2)
    render.lights = {"fill": 0.25}
    render.ball = (18, 12)
    Render().write(tmp_path / "ref.exr")
    render.write(tmp_path / "test.exr")
    made(program, tmp_path, "ref.exr", "test.exr", "--hdrflip:attribute=1", "--report", "page.html", status=0)
    page = Page(driver, tmp_path / "page.html")
    page.ready()
    assert [one.text for one in page.all("#facts li")][0].startswith("light key: off, explains ")
    regions = page.all("#facts .scroll")
    assert [one.get_attribute("aria-label") for one in regions] == ["Lights", "View.CryptoObject", "Layers"]
    assert {(one.get_attribute("role"), one.get_attribute("tabindex")) for one in regions} == {("region", "0")}
    rows = [[row.text for row in one.find_elements(By.CSS_SELECTOR, "tbody th")] for one in regions]
    assert rows[0][0] == "key" and set(rows[1]) == {"ball", "floor", "box"} and rows[1][2] == "box" and rows[2] == ["View.Depth"]
    found = [[cell.text for cell in one.find_elements(By.CSS_SELECTOR, "tr.finding td:nth-child(2)")] for one in regions]
    assert found == [["off"], ["uncovered or hidden", "moved or reshaped"], ["changed"]] or \
        found == [["off"], ["moved or reshaped", "uncovered or hidden"], ["changed"]]
    heads = page.all("#facts .scroll thead th")
    assert all(one.get_attribute("scope") == "col" and one.text for one in heads)
    for width in (1440, 640):
        page.size(width, 900)
        page.until("document.documentElement.scrollWidth <= innerWidth")  # charts follow a moment later
    assert page.complaints() == []
    assert {url.split(":")[0] for url in page.requests()} <= {"data", "file"}


def test_every_control_has_a_name_and_is_reached_by_tab(page):
    select(page, 5)
    assert page.ask("[...document.images].every((image) => image.hasAttribute('alt'))")
    assert page.ask("[...document.querySelectorAll('canvas')].every((one) =>"
                    " one.getAttribute('aria-label'))")
    wanted = {"measure", "quantity", "previous", "frame", "next", "slide", "theme", "exposure", "stage", "filter",
              "sort", "keys", "show", "channel", "skip"}
    page.driver.execute_script("document.body.focus(); document.activeElement.blur()")
    seen = set()
    for _ in range(90):
        page.keys(Keys.TAB)
        state = page.ask("(() => { const at = document.activeElement; const style ="
                         " getComputedStyle(at.matches('fieldset input') ? at.nextSibling : at);"
                         " return [at.id || at.name || at.className, style.outlineStyle,"
                         " at.innerText || at.ariaLabel || (at.labels && at.labels.length) || at.id]; })()")
        if state[0] in ("", None):
            continue
        seen.add(state[0])
        assert state[1] not in ("none", ""), state
        assert state[2], state
        if wanted <= seen:
            break
    assert wanted <= seen


LUMINANCE = """
const [text, behind] = arguments;
const light = (color) => {
  const channels = color.match(/[\\d.]+/g).slice(0, 3).map((v) => v / 255)
    .map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return 0.2126 * channels[0] + 0.7152 * channels[1] + 0.0722 * channels[2];
};
const of = (value, key) => {
  const probe = document.body.appendChild(document.createElement("i"));
  probe.style.color = `var(--${value})`;
  const found = light(getComputedStyle(probe).color);
  probe.remove();
  return found;
};
const [a, b] = [of(text), of(behind)].sort((x, y) => y - x);
return (a + 0.05) / (b + 0.05);
"""


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_both_themes_have_the_contrast_that_wcag_asks_for(page, theme):
    page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
        "features": [{"name": "prefers-color-scheme", "value": theme}]})
    dark = page.ask("getComputedStyle(document.body).backgroundColor.match(/\\d+/)[0] < 80")
    assert dark == (theme == "dark")
    for color in ("ink", "soft", "accent", "passed", "measured", "warning", "failed", "error"):
        assert page.driver.execute_script(LUMINANCE, color, "card") >= 4.5, color
    assert page.driver.execute_script(LUMINANCE, "focus", "card") >= 3


def test_the_theme_can_be_chosen(page):
    for option, first in (("dark", True), ("light", False)):
        page.driver.execute_script("const box = document.getElementById('theme');"
                                   "box.value = arguments[0]; box.onchange({target: box})", option)
        shade = page.ask("getComputedStyle(document.body).backgroundColor.match(/\\d+/)[0]")
        assert (int(shade) < 80) == first


def test_a_status_is_a_word_and_a_shape(page):
    assert page.ask("[...document.querySelectorAll('.status')].every((one) =>"
                    " one.querySelector('use') && one.textContent.trim())")
    shapes = page.ask("[...new Set([...document.querySelectorAll('.worst use')].map((use) =>"
                      " use.getAttribute('href')))]")
    assert shapes == ["#sign-missing", "#sign-failed"]
    styles = page.ask("curve.chart.data.datasets[0].pointStyle")
    assert styles[4] == "rectRot" and styles[0] == "circle"


@pytest.mark.parametrize("width", [3840, 1440, 800, 400])
def test_nothing_is_wider_than_the_window(page, width):
    page.size(width, 900)
    select(page, 5)
    page.until("document.documentElement.scrollWidth <= arguments[0]", width)
    assert page.one("#stage").rect["width"] > width * 0.4
    page.keys("l")
    page.until("document.documentElement.scrollWidth <= arguments[0]", width)
    page.keys("l")


def test_it_prints(page):
    select(page, 5)
    page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert not page.one("#next").is_displayed()
    assert page.one("h1").is_displayed() and page.one(".pane.large").is_displayed()
    sheet = base64.b64decode(page.driver.execute_cdp_cmd("Page.printToPDF", {})["data"])
    assert sheet.startswith(b"%PDF") and len(sheet) > 50_000


def test_without_a_script_the_verdict_and_the_frames_are_there(driver, page_file):
    driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        driver.get(page_file.as_uri())
        assert driver.find_element(By.CSS_SELECTOR, "h1").text.lower() == "missing"
        rows = driver.find_elements(By.CSS_SELECTOR, "noscript tr")
        assert [row.text.split()[1] for row in rows[1:]] == [
            "passed"] * 4 + ["failed"] + ["passed"] * 3 + ["missing"]
    finally:
        driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


class Counter(http.server.BaseHTTPRequestHandler):
    calls = []

    def do_GET(self):  # noqa: N802
        self.calls.append(self.path)
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_):
        pass


def test_what_a_page_could_be_made_to_load_is_refused(driver, page_file):
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Counter)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_port}"
    page = Page(driver, page_file)
    page.driver.execute_script("""
      window.refused = [];
      document.addEventListener("securitypolicyviolation", (event) =>
        window.refused.push(event.effectiveDirective));
      document.body.insertAdjacentHTML("beforeend", `<img src="${arguments[0]}/img">
        <img src="data:," onerror="document.title = 'broken in'"><link rel="stylesheet" href="${arguments[0]}/css">
        <iframe src="${arguments[0]}/frame"></iframe>`);
      const script = document.createElement("script");
      script.src = `${arguments[0]}/script`;
      document.body.append(script);
      fetch(`${arguments[0]}/fetch`).catch(() => 0);
      """, address)
    time.sleep(1)
    refused = set(page.ask("window.refused"))
    server.shutdown()
    assert Counter.calls == []
    assert {"img-src", "script-src-attr", "style-src-elem", "frame-src", "script-src-elem",
            "connect-src"} <= refused
    assert page.ask("document.title") != "broken in"
    page.complaints()


def test_names_are_only_text(driver, program, tmp_path):
    # Together the path holds an end tag, a script and an image that would run.
    folder = tmp_path / "a<" / "script><script>document.title='run'<" / "script>"
    folder.mkdir(parents=True)
    name = "<img src=x onerror=document.title='run'>&quot;\"'"
    for number in (1, 2):
        for part in ("ref", "test"):
            shutil.copy(ANIM / f"{part}.000{number}.exr", folder / f"{name}{part}.000{number}.exr")
    (folder / f"{name}test.0002.exr").unlink()
    made(program, tmp_path, "--frames", "1-2", folder / f"{name}ref.#.exr",
         folder / f"{name}test.#.exr", *CHECK, "--report", "page.html", status=1)
    page = Page(driver, tmp_path / "page.html")
    page.ready()
    assert page.complaints() == []
    assert page.ask("document.title") != "run"
    assert page.all("[src=x]") == []
    assert name in page.text(".counted")
    select(page, 1)
    assert str(folder / f"{name}test.0001.exr") in page.text("#facts")
    assert page.ask("document.scripts.length") == len(
        page.all("script[type]")) + 2


def test_a_thousand_frames_open_at_once(driver, program, tmp_path):
    for number in range(1, 1001):
        for part in ("ref", "test"):
            (tmp_path / f"{part}.{number:04}.exr").symlink_to(
                ANIM / f"{part}.000{(number - 1) % 8 + 1}.exr")
    ran = call(program, ["--frames", "1-1000", "--parallel-frames", "2", "-q", "ref.#.exr",
                         "test.#.exr", *CHECK, "--report", "page.html"], tmp_path, timeout=600)
    assert ran.status == 3, ran.err
    file = tmp_path / "page.html"
    assert file.stat().st_size < 60e6
    took = []
    for _ in range(3):  # the best of three: other work is on this machine
        page = Page(driver, file)
        took.append(page.ask("performance.timing.loadEventEnd - performance.timing.navigationStart"))
    assert page.complaints() == []
    assert min(took) < 2000, took
    assert page.frame() == "5"
    page.keys(Keys.END)
    page.ready()
    assert page.frame() == "1000"
    assert "thumbnails" in page.text("#stage-caption") and page.all(".pane.large canvas")
    assert "in full of 24 of 1000 frames" in page.text("#about")
    assert "thumbnails of 1000" in page.text("#about")
