// One frame: its images, its numbers.

// `stops` is the requested exposure; `exposure` the index of the nearest one that was drawn.
// `blink`: the timer that toggles, or null.
const viewer = { index: 0, exposure: 0, stops: null, show: "compare", split: 50, blink: null };
const SHOWS = [["compare", "Comparison"], ["error", "Error map"], ["stops", "Exposure map"],
  ["bias", "Noise or change"]];

const picture = (source, words) => make("img", { src: source, alt: words });

function radios(box, group, options, chosen, choose) {
  const legend = box.querySelector("legend");
  box.replaceChildren(legend, ...options.map(([value, text, enabled, hint]) => make("label", { title: hint },
    make("input", { type: "radio", name: group, value, checked: value === chosen, disabled: !enabled,
      onchange: () => choose(value) }), make("span", {}, text))));
  box.hidden = options.length === 0;
}

function legendOf(bar, low, high, words) {
  return make("div", { className: "legend", role: "img", "aria-label": words },
    make("span", {}, low), make("img", { src: bar, alt: "" }), make("span", {}, high));
}

const errorLegend = () => legendOf(data.legends.error, "0 same", "1 different",
  "Magma colours, from black, no visible difference, to pale yellow, the largest");

function stopsLegend(full) {
  const [low, high] = full.range;
  return legendOf(data.legends.stops, stops(low), `${stops(high)} stops`,
    `Viridis colours, from dark blue, ${stops(low)} stops, to yellow, ${stops(high)} stops`);
}

function biasLegend(full) {
  const range = `${number(100 * full.bias_range)} %`;
  return legendOf(data.legends.bias, `\u2212${range}`, `+${range}`,
    `From blue, ${range} darker, to orange, ${range} brighter, where that is more than noise`);
}

function setSplit(value) {
  viewer.split = Math.min(100, Math.max(0, value));
  const left = document.querySelector(".compare .left");
  if (!left) return;
  left.style.clipPath = `inset(0 ${100 - viewer.split}% 0 0)`;
  document.querySelector(".compare .edge").style.left = `${viewer.split}%`;
  byId("slide").value = viewer.split;
  byId("slide").setAttribute("aria-valuetext", `reference on the left ${Math.round(viewer.split)} %`);
}

/** One picture whole, in the place of the other: the eye sees a difference that a wipe hides. */
function toggle() {
  if (viewer.show !== "compare") chooseShow("compare");
  setSplit(viewer.split < 50 ? 100 : 0);
}

function stopBlinking() {
  clearInterval(viewer.blink);
  viewer.blink = null;
  byId("blink").setAttribute("aria-pressed", "false");
}

/** Twice a second, until a key or a click. */
function blink() {
  if (viewer.blink) {
    stopBlinking();
    return;
  }
  toggle();
  viewer.blink = setInterval(toggle, 500);
  byId("blink").setAttribute("aria-pressed", "true");
}

function slider(full) {
  const at = full.exposures[viewer.exposure];
  const words = (which) => `${which} at ${stops(at.stops)} stops`;
  const left = picture(at.reference, words("Reference"));
  left.className = "left";
  const box = make("div", { className: "compare" }, picture(at.test, words("Test")), left,
    make("div", { className: "edge" }), make("span", { className: "tag of-left" }, "Reference"),
    make("span", { className: "tag of-right" }, "Test"));
  const drag = (event) => {
    if (event.type === "pointermove" && !event.buttons) return;
    stopBlinking();
    const area = box.getBoundingClientRect();
    setSplit((100 * (event.clientX - area.left)) / area.width);
    event.preventDefault();
  };
  box.addEventListener("pointerdown", (event) => { box.setPointerCapture(event.pointerId); drag(event); });
  box.addEventListener("pointermove", drag);
  for (const image of box.querySelectorAll("img")) image.draggable = false;
  return box;
}

/** The large image, its caption and, for the comparison, its slider. */
function stageOf(frame, full, small) {
  if (!full) {
    if (!small) return [make("p", { className: "none" }, "No pictures of this frame."), "", null];
    return [picture(small.test, "Test, thumbnail"), data.pictures.thumbnails, null];
  }
  if (viewer.show === "error" && full.error)
    return [picture(full.error, "Error map"), data.pictures.error, errorLegend()];
  if (viewer.show === "stops" && full.stops)
    return [picture(full.stops, "Exposure map"), data.pictures.stops, stopsLegend(full)];
  if (viewer.show === "bias" && full.bias)
    return [picture(full.bias, "Map of noise or change"), data.pictures.bias, biasLegend(full)];
  const at = full.exposures[viewer.exposure];
  if (!at.reference) return [picture(at.test, `Test at ${stops(at.stops)} stops`), data.pictures.shown, null];
  const range = make("input", { type: "range", className: "slide", id: "slide", min: 0, max: 100, step: 1,
    "aria-label": "Where reference and test meet",
    oninput: (event) => { stopBlinking(); setSplit(Number(event.target.value)); } });
  return [slider(full), data.pictures.shown, range];
}

function mapFigure(source, title, legend, show) {
  return make("figure", {}, make("h3", {}, title, make("button", { type: "button", className: "plain",
    onclick: () => chooseShow(show), "aria-label": `${title}: show large` }, "show large")),
  make("div", { className: "frame" }, picture(source, title)), legend);
}

function drawPictures() {
  const frame = frames[viewer.index];
  const full = picturesOf(viewer.index, "full");
  const small = picturesOf(viewer.index, "small");
  const [large, words, below] = stageOf(frame, full, small);
  byId("stage").className = full && full.height > full.width ? "stage tall" : "stage";
  document.querySelector(".pictures").classList.toggle("coarse", Boolean(full) && full.width < 400);
  byId("stage").replaceChildren(large);
  byId("stage-caption").replaceChildren(...[below, words].filter(Boolean));
  const maps = [];
  if (full && full.error) maps.push(mapFigure(full.error, "Error", errorLegend(), "error"));
  else if (!full && small && small.error)
    maps.push(make("figure", {}, make("h3", {}, "Error"), make("div", { className: "frame" },
      picture(small.error, "Error map, thumbnail")), errorLegend()));
  if (full && full.stops)
    maps.push(mapFigure(full.stops, "Exposure of the largest error", stopsLegend(full), "stops"));
  if (full && full.bias) maps.push(mapFigure(full.bias, "Noise or change", biasLegend(full), "bias"));
  const pair = Boolean(document.querySelector("#stage .compare"));
  byId("toggle").disabled = byId("blink").disabled = !(full && full.exposures[0].reference);
  if (!pair && viewer.blink) stopBlinking();
  byId("maps").replaceChildren(...maps);
  byId("maps").hidden = maps.length === 0;
  byId("near").replaceChildren(...nearBoxes(frame, full));
  setSplit(viewer.split);
}

function nearest(list) {
  if (viewer.stops === null) return Math.floor(list.length / 2);
  const away = list.map((each) => Math.abs(each.stops - viewer.stops));
  return Math.max(0, away.indexOf(Math.min(...away)));
}

function drawChoices() {
  const full = picturesOf(viewer.index, "full");
  const list = full ? full.exposures : [];
  viewer.exposure = nearest(list);
  radios(byId("exposures"), "exposure", list.map((each, i) => [i, stops(each.stops), true, `Key ${i + 1}`]),
    viewer.exposure, chooseExposure);
  const there = { compare: true, error: full && full.error, stops: full && full.stops, bias: full && full.bias };
  const shows = SHOWS.filter(([key]) => key !== "bias" || there.bias);
  radios(byId("shows"), "show", full ? shows.map(([key, text]) =>
    [key, key === "compare" && !list[0].reference ? "Picture" : text, Boolean(there[key])]) : [],
    there[viewer.show] ? viewer.show : "compare", chooseShow);
}

function chooseExposure(exposure) {
  viewer.stops = picturesOf(viewer.index, "full").exposures[exposure].stops;
  viewer.show = "compare";
  refresh();
}

function chooseShow(show) {
  viewer.show = show;
  refresh();
}

/** Shows other images; the keyboard focus stays where it was. */
function refresh() {
  const focus = document.activeElement;
  const group = focus && focus.name;
  drawChoices();
  drawPictures();
  if (group === "exposure" || group === "show") {
    const again = document.querySelector(`input[name="${group}"]:checked`);
    if (again) again.focus();
  }
}

/** "#1009", or "#1009 left" of a view: what leads to a frame. */
const linkOf = (frame) => `#${encodeURIComponent(String(frame.frame) + (frame.view ? ` ${frame.view}` : ""))}`;

/** The frame that the page's address names, or -1. */
function linked() {
  return frames.findIndex((frame) => linkOf(frame) === location.hash);
}

function select(index) {
  if (index < 0 || index >= frames.length) return;
  viewer.index = index;
  const frame = frames[index];
  byId("frame-title").replaceChildren(`Frame ${frameName(frame)} `, badge(frame.status));
  if (location.hash !== linkOf(frame)) history.replaceState(null, "", linkOf(frame));
  const message = frame.message || verdictOf(frame);
  byId("message").textContent = message;
  byId("message").classList.toggle("empty", !message);
  byId("frame").value = index;
  byId("previous").disabled = index === 0;
  byId("next").disabled = index === frames.length - 1;
  refresh();
  drawFacts(frame);
  markCurve();
  markLists();
}
