// The keyboard, and the first frame to show.

function step(by) {
  select(Math.min(frames.length - 1, Math.max(0, viewer.index + by)));
}

/** Along the list of the worst frames. */
function stepWorst(by) {
  const { worst } = data.shot;
  if (!worst.length) return;
  const place = worst.indexOf(viewer.index);
  select(worst[place < 0 ? 0 : Math.min(worst.length - 1, Math.max(0, place + by))]);
}

const KEYS = {
  ArrowLeft: () => step(-1), ArrowRight: () => step(1),
  Home: () => select(0), End: () => select(frames.length - 1),
  n: () => stepWorst(1), p: () => stepWorst(-1),
  c: () => chooseShow("compare"), e: () => chooseShow("error"), x: () => chooseShow("stops"),
  m: () => chooseShow("bias"),
  t: toggle, " ": toggle, b: blink,
  "[": () => setSplit(viewer.split - 5), "]": () => setSplit(viewer.split + 5),
};

function onKey(event) {
  if (event.altKey || event.ctrlKey || event.metaKey || event.defaultPrevented) return;
  const owns = event.target.closest("select, input, textarea, .scroll");
  const moves = event.key.startsWith("Arrow") || event.key === "Home" || event.key === "End";
  if (owns && (moves || event.target.tagName === "SELECT")) return;
  if (event.key === " " && event.target.closest("button, summary, a")) return; // presses it
  if (event.key !== "b" && viewer.blink) stopBlinking();
  const exposure = "123456789".indexOf(event.key);
  const full = picturesOf(viewer.index, "full");
  if (event.key.length === 1 && exposure >= 0) {
    if (full && exposure < full.exposures.length) chooseExposure(exposure);
  } else if (KEYS[event.key]) {
    KEYS[event.key]();
    event.preventDefault();
  }
}

function redraw() {
  if (curve.chart) drawCurve();
  if (frames.length) drawFacts(frames[viewer.index]);
}

function chooseTheme(theme) {
  if (theme) document.documentElement.dataset.theme = theme;
  else delete document.documentElement.dataset.theme;
  redraw();
}

function start() {
  document.querySelector("main").hidden = false;
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  byId("frame").replaceChildren(...frames.map((frame, i) => make("option", { value: i }, frameName(frame))));
  byId("frame").onchange = (event) => select(Number(event.target.value));
  byId("previous").onclick = () => step(-1);
  byId("next").onclick = () => step(1);
  byId("toggle").onclick = () => { stopBlinking(); toggle(); };
  byId("blink").onclick = blink;
  byId("theme").onchange = (event) => chooseTheme(event.target.value.startsWith("as") ? "" : event.target.value);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  const hasFrames = frames.length > 0;
  for (const part of document.querySelectorAll(".columns, .all, .curve")) part.hidden = !hasFrames;
  drawAbout();
  drawWorst();
  drawBadFrames();
  drawFaults();
  if (!hasFrames) return;
  drawAll();
  const first = linked();
  viewer.index = first >= 0 ? first : data.shot.worst.length ? data.shot.worst[0] : 0;
  startCurve();
  select(viewer.index);
  document.addEventListener("keydown", onKey);
  addEventListener("hashchange", () => select(linked()));
}

start();
