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

function zoomAtSpot(factor) {
  if (!viewer.frame) return;
  const { x, y } = spotOf(viewer.frame);
  zoomBy(factor, x + 0.5, y + 0.5);
}

/** So many pixels of the screen for each of the picture, around the pointer. */
function zoomExactly(times) {
  if (!viewer.frame) return;
  zoomAtSpot(times / devicePixelRatio / scaleOf(largePane()));
}

function showHelp() {
  if (byId("help").open) byId("help").close();
  else byId("help").showModal();
}

const WAY = 80; // pixels of the screen
const KEYS = {
  ArrowLeft: () => step(-1), ArrowRight: () => step(1),
  Home: () => select(0), End: () => select(frames.length - 1),
  n: () => stepWorst(1), N: () => stepWorst(-1), j: () => stepFault(1), k: () => stepFault(-1),
  c: () => chooseShow("compare"), e: () => chooseShow("error"), s: () => chooseShow("stops"),
  m: () => chooseShow("bias"), l: () => chooseLayout(viewer.layout === "one" ? "side" : "one"),
  t: toggle, " ": toggle, b: blink,
  "[": () => setSplit(viewer.split - 5), "]": () => setSplit(viewer.split + 5),
  ",": () => setStops(shownStops() - 0.5), ".": () => setStops(shownStops() + 0.5),
  0: () => setStops(null), z: () => setStops(0),
  f: () => viewer.frame && zoomTo(null), 1: () => zoomExactly(1), 2: () => zoomExactly(2), 4: () => zoomExactly(4),
  8: () => zoomExactly(8), "+": () => zoomAtSpot(2), "-": () => zoomAtSpot(0.5),
  r: () => setChannel("r"), g: () => setChannel("g"), y: () => setChannel("y"), R: () => setChannel("r"),
  G: () => setChannel("g"), B: () => setChannel("b"), A: () => setChannel("a"), Y: () => setChannel("y"),
  o: () => { view.marks = !view.marks; drawPanes(); },
  p: pin, P: () => { view.pins = []; drawPanes(); },
  a: () => decide("accepted"), x: () => decide("rejected"),
  i: () => byId("note").focus(), "/": () => byId("filter").focus(), "?": showHelp,
};
const PANS = { ArrowLeft: [-WAY, 0], ArrowRight: [WAY, 0], ArrowUp: [0, -WAY], ArrowDown: [0, WAY] };

function onKey(event) {
  if (event.altKey || event.ctrlKey || event.metaKey || event.defaultPrevented) return;
  if (event.target.matches("input[type=text], input[type=search]")) {
    if (event.key === "Escape") event.target.blur();
    return;
  }
  const owns = event.target.closest("select, input, .scroll");
  const moves = event.key.startsWith("Arrow") || event.key === "Home" || event.key === "End";
  if (owns && (moves || event.target.tagName === "SELECT")) return;
  if (byId("help").open && event.key !== "?") return;
  if (event.key === " " && event.target.closest("button, summary, a")) return; // presses it
  if (event.key !== "b" && viewer.blink) stopBlinking();
  if (event.shiftKey && PANS[event.key]) panBy(...PANS[event.key]);
  else if (Object.hasOwn(KEYS, event.key)) KEYS[event.key]();
  else return;
  event.preventDefault();
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
  byId("layout").onclick = () => chooseLayout(viewer.layout === "one" ? "side" : "one");
  byId("fit").onclick = () => zoomTo(null);
  byId("one-to-one").onclick = () => zoomExactly(1);
  byId("exposure").oninput = (event) => setStops(Number(event.target.value));
  byId("worst-exposure").onclick = () => setStops(null);
  byId("slide").oninput = (event) => { stopBlinking(); setSplit(Number(event.target.value)); };
  for (const id of ["keys", "keys-below"]) byId(id).onclick = showHelp;
  byId("theme").onchange = (event) => chooseTheme(event.target.value.startsWith("as") ? "" : event.target.value);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  for (const id of ["curve-title", "worst-title", "all-title", "found-title"])
    byId(id).textContent = byId(id).textContent.replace("frame", NOUN);
  byId("frame-word").textContent = capital(NOUN);
  const hasFrames = frames.length > 0;
  for (const part of document.querySelectorAll(".columns, .all, .curve")) part.hidden = !hasFrames;
  startDecisions();
  startApproving();
  drawAbout();
  drawWorst();
  drawBadFrames();
  drawFaults();
  if (!hasFrames) return;
  startAll();
  const { index, fault } = linked();
  const { worst } = data.shot; // the first of them that can be looked at
  viewer.index = index >= 0 ? index : worst.find((one) => picturesOf(one, "small")) ?? worst[0] ?? 0;
  startCurve();
  select(viewer.index, fault);
  document.addEventListener("keydown", onKey);
  addEventListener("hashchange", () => select(linked().index, linked().fault));
}

start();
