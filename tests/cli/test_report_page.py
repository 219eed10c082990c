# SPDX-License-Identifier: BSD-3-Clause
"""The page of --report in a browser: Chromium, driven by Selenium; skips where they are not."""

import base64
import http.server
import json
import shutil
import threading
import time

import pytest

from conftest import TESTIMAGES, call

webdriver = pytest.importorskip("selenium.webdriver", reason="no python3-selenium here")
from selenium.webdriver.chrome.options import Options  # noqa: E402
from selenium.webdriver.chrome.service import Service  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
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

    def split(self):
        """Where the reference ends, in percent of the picture."""
        box, edge = self.one(".compare").rect, self.one(".compare .edge").rect
        return 100 * (edge["x"] + edge["width"] / 2 - box["x"]) / box["width"]

    def shown(self):
        return [image.get_attribute("src") for image in self.all("#stage img")]

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
    yield opened
    opened.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})
    assert opened.complaints() == []
    assert {url.split(":")[0] for url in opened.requests()} <= {"data", "file"}


def select(page, number):
    page.driver.execute_script("select(arguments[0])", number - 1)


def test_the_verdict_comes_first_and_the_worst_frame_with_it(page):
    assert page.ask("document.body.innerText.trim().split('\\n')[0].toLowerCase()") in (
        "missing", "to the pictures")
    assert page.text("h1").lower() == "missing"
    assert "9 frames: 1 missing, 1 failed, 7 passed" in page.text(".sentence")
    worst = [row.text.split("\n")[0] for row in page.all("#worst strong")]
    assert worst[:2] == ["Frame 9", "Frame 5"]
    select(page, 5)
    assert "failed" in page.text("#frame-title")
    assert "p99" in page.text("#message")
    tops = [page.ask("document.querySelector(arguments[0]).getBoundingClientRect().top", selector)
            for selector in ("header.verdict", ".curve", ".viewer", ".all", ".about")]
    assert tops == sorted(tops)


def test_the_slider_by_mouse_and_by_keys(page):
    select(page, 5)
    assert page.split() == pytest.approx(50, abs=0.5)
    before = page.ask("getComputedStyle(document.querySelector('.compare .left')).clipPath")
    box = page.one(".compare")
    chain = ActionChains(page.driver).move_to_element(box).click_and_hold()
    chain.move_by_offset(int(box.rect["width"] / 4), 0).release().perform()
    assert page.split() == pytest.approx(75, abs=1)
    assert page.ask("getComputedStyle(document.querySelector('.compare .left')).clipPath") != before
    assert page.one("#slide").get_attribute("value") == str(round(page.split()))
    page.keys("[")
    assert page.split() == pytest.approx(70, abs=1)
    page.driver.execute_script("document.getElementById('slide').focus()")
    page.keys(Keys.ARROW_LEFT)
    assert page.split() == pytest.approx(69, abs=1)
    assert page.frame() == "5"  # the arrow was the slider's
    page.keys(Keys.HOME)
    assert page.split() == pytest.approx(0, abs=0.5)


def test_toggle_and_blink_in_place(page):
    select(page, 5)
    box = page.one(".compare").rect
    for key, reference in (("t", 0), ("t", 100), (" ", 0)):
        page.keys(key)
        assert page.split() == pytest.approx(reference, abs=0.5)
        assert page.one(".compare").rect == box  # nothing moves
    page.keys("e", "t")
    assert page.all(".compare")  # the pair comes back
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
    assert "No pictures" in page.text("#stage")
    page.keys(Keys.HOME)
    assert page.frame() == "1"
    page.keys("p")
    assert page.frame() == "9"
    page.keys("n")
    assert page.frame() == "5"
    page.one("#next").click()
    assert page.frame() == "6"
    page.all("#worst button")[1].click()
    assert page.frame() == "5"
    assert page.one("#worst [aria-current=true] strong").text == "Frame 5"


def test_exposures_by_mouse_and_by_keys(page):
    select(page, 5)
    choices = page.all("#exposures input")
    assert 2 <= len(choices) <= 5
    seen = []
    for key in range(1, len(choices) + 1):
        page.keys(str(key))
        assert page.all("#exposures input")[key - 1].is_selected()
        seen.append(tuple(page.shown()))
    assert len(set(seen)) == len(choices)
    page.all("#exposures label")[0].click()
    assert tuple(page.shown()) == seen[0]
    label = page.text("#exposures label:first-of-type")
    page.keys(Keys.ARROW_LEFT)  # the radio buttons', which have the focus now
    assert page.frame() == "5"
    select(page, 4)
    page.keys("1")
    assert page.text("#exposures label:first-of-type") == label  # of the whole shot


def test_error_map_and_exposure_map_with_legends(page):
    select(page, 5)
    assert [title.text.split("\n")[0] for title in page.all("#maps h3")] == [
        "Error", "Exposure of the largest error"]
    legends = [legend.text.split("\n") for legend in page.all("#maps .legend")]
    assert legends[0] == ["0 same", "1 different"]
    assert legends[1][1].endswith("stops")
    pair = page.shown()
    page.keys("e")
    error = page.shown()
    assert len(error) == 1 and error != pair
    page.keys("x")
    assert len(page.shown()) == 1 and page.shown() != error
    page.keys("c")
    assert page.shown() == pair
    page.all("#maps .plain")[0].click()
    assert page.shown() == error


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


def test_every_control_has_a_name_and_is_reached_by_tab(page):
    select(page, 5)
    assert page.ask("[...document.images].every((image) => image.hasAttribute('alt'))")
    assert page.ask("[...document.querySelectorAll('canvas')].every((one) =>"
                    " one.getAttribute('aria-label'))")
    wanted = {"measure", "quantity", "previous", "frame", "next", "slide", "theme"}
    page.driver.execute_script("document.body.focus(); document.activeElement.blur()")
    seen = set()
    for _ in range(60):
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
        if wanted | {"exposure", "show", "skip"} <= seen:
            break
    assert wanted | {"exposure", "show", "skip"} <= seen


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


@pytest.mark.parametrize("width", [1440, 800, 400])
def test_nothing_is_wider_than_the_window(page, width):
    page.size(width, 900)
    select(page, 5)
    page.until("document.documentElement.scrollWidth <= arguments[0]", width)
    assert page.one("#stage").rect["width"] > width * 0.4


def test_it_prints(page):
    select(page, 5)
    page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert not page.one("#next").is_displayed()
    assert page.one("h1").is_displayed() and page.one(".compare").is_displayed()
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
    assert page.complaints() == []
    assert page.ask("document.title") != "run"
    assert page.all("[src=x]") == []
    assert name in page.text(".sentence")
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
    assert min(took) < 3000, took
    assert page.frame() == "5"
    page.keys(Keys.END)
    assert page.frame() == "1000"
    assert page.all("#stage img")
    assert "in full of 24 of 1000 frames" in page.text("#about")
    assert "thumbnails of 1000" in page.text("#about")
