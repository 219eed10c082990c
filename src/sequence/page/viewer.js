// One frame: its pictures, its faults, its numbers.

// `frame`: what of it is decoded, null before; `fault`: the chosen one's number from 1, or 0.
// `blink`: the timer that toggles, or null.
const viewer = { index: 0, frame: null, fault: 0, show: "compare", layout: "one", split: 50, blink: null };
const SHOWS = [["compare", "Comparison"], ["error", "Error map"], ["stops", "Exposure map"],
  ["bias", "Noise or change"]];
const CHANNELS = [["", "RGB"], ["r", "R"], ["g", "G"], ["b", "B"], ["a", "A"], ["y", "Y"]];

const picture = (source, words) => make("img", { src: source, alt: words });

function radios(box, group, options, chosen, choose) {
  const legend = box.querySelector("legend");
  box.replaceChildren(legend, ...options.map(([value, text, enabled, hint]) => make("label", { title: hint },
    make("input", { type: "radio", name: group, value, checked: value === chosen, disabled: !enabled,
      onchange: () => choose(value) }), make("span", {}, text))));
  box.hidden = options.length === 0;
}

// ---- legends

function legendOf(bar, low, high, words, below = null) {
  return make("div", { className: "legend", role: "img", "aria-label": words },
    make("span", {}, low), make("img", { src: bar, alt: "" }), make("span", {}, high), below && make("p", {}, below));
}

const LEGENDS = {
  error: () => legendOf(data.legends.error, "0 same", "1 different",
    "Magma colours, from black, no visible difference, to pale yellow, the largest"),
  stops: ({ range: [low, high] }) => legendOf(data.legends.stops, stops(low), `${stops(high)} stops`,
    `Viridis colours, from dark blue, ${stops(low)} stops, to yellow, ${stops(high)} stops`),
  bias: ({ bias_range: most }) => {
    const range = `${number(100 * most)} %`;
    return legendOf(data.legends.bias, `\u2212${range}`, `+${range}`,
      `From blue, ${range} darker, to orange, ${range} brighter, where that is more than noise`,
      "Grey: no more than noise. Dark stripes: not tested. White stripes: edges differ.");
  },
};

// ---- wipe, toggle, blink

const isPair = () => Boolean(viewer.frame && viewer.frame.sides.reference);

function setSplit(value) {
  viewer.split = Math.min(100, Math.max(0, value));
  const edge = document.querySelector(".edge");
  if (edge) edge.style.left = `${viewer.split}%`;
  for (const [name, gone] of [["of-left", viewer.split < 3], ["of-right", viewer.split > 97]]) {
    const tag = document.querySelector(`.tag.${name}`);
    if (tag) tag.hidden = gone;
  }
  byId("slide").value = viewer.split;
  byId("slide").setAttribute("aria-valuetext", `reference on the left ${Math.round(viewer.split)} %`);
  drawPanesNow();
}

/** One picture whole, in the place of the other: the eye sees a difference that a wipe hides. */
function toggle() {
  if (!isPair()) return;
  if (viewer.layout !== "one") chooseLayout("one");
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
  if (viewer.blink || !isPair()) {
    stopBlinking();
    return;
  }
  toggle();
  viewer.blink = setInterval(toggle, 500);
  byId("blink").setAttribute("aria-pressed", "true");
}

// ---- exposure, channels

/** To a tenth of a stop; null: the exposure of the frame's largest error. */
function setStops(value) {
  view.stops = value === null ? null : Math.min(10, Math.max(-10, Math.round(value * 10) / 10)) || 0;
  drawExposure();
  drawPanes();
}

function drawExposure() {
  const shown = shownStops();
  byId("exposure").value = shown;
  byId("exposure").setAttribute("aria-valuetext", `${stops(shown)} stops`);
  byId("exposure-value").textContent = `${stops(shown)}${view.stops === null ? " (worst)" : ""}`;
}

function setChannel(channel) {
  view.channel = view.channel === channel ? "" : channel;
  drawChoices();
  drawPanes();
}

// ---- panes

function panesWanted() {
  const { sides, maps, full } = viewer.frame;
  if (!full) return [["compare"], []];
  const there = ["error", "stops", "bias"].filter((what) => maps[what]);
  const pair = isPair() ? ["reference", "test"] : ["test"];
  return viewer.layout === "side" ? [[...pair, ...there], []]
    : [[maps[viewer.show] ? viewer.show : "compare"], there.filter((what) => what !== viewer.show)];
}

function wipeParts() {
  return [make("div", { className: "edge", title: "Drag to wipe" }), make("span", { className: "tag of-left" }, "Reference"),
    make("span", { className: "tag of-right" }, "Test")];
}

function paneFigure(pane) {
  const { what } = pane;
  const { full } = viewer.frame;
  const title = what === "compare" && !isPair() ? "Picture" : NAMES[what];
  pane.canvas.setAttribute("aria-label", `${title}, ${NOUN} ${frameName(frames[viewer.index])}`);
  if (pane.large && what === "compare" && isPair()) pane.box.append(...wipeParts());
  else if (pane.large) pane.box.append(make("span", { className: "tag of-left" }, title));
  if (pane.large && viewer.layout === "one") return pane.box;
  const head = viewer.layout === "side" ? null : make("h3", {}, title, make("button", { type: "button", className: "plain",
    onclick: () => chooseShow(what), "aria-label": `${title}: show large` }, "show large"));
  return make("figure", {}, head, pane.box, LEGENDS[what] ? LEGENDS[what](full) : null);
}

const paneWatcher = new ResizeObserver(() => drawPanes());

/** The panes for what the frame has; they stay while that is the same. */
function drawPictures() {
  const { frame } = viewer;
  if (!frame) {
    view.panes = [];
    byId("stage").replaceChildren(make("p", { className: "none" }, "No pictures of this frame."));
    byId("maps").replaceChildren();
    byId("stage-caption").replaceChildren();
    byId("slide").hidden = true;
    drawReadout();
    return;
  }
  const [large, small] = panesWanted();
  paneWatcher.disconnect();
  const figures = [large.map((what) => makePane(what, true)), small.map((what) => makePane(what, false))];
  view.panes = figures.flat();
  for (const { box } of view.panes) box.style.aspectRatio = `${frame.size.width} / ${frame.size.height}`;
  byId("stage").className = viewer.layout === "side" && frame.full ? "stage side" : "stage";
  byId("stage").replaceChildren(...figures[0].map(paneFigure));
  byId("maps").replaceChildren(...figures[1].map(paneFigure));
  const shown = viewer.layout === "one" && LEGENDS[large[0]] && frame.full ? LEGENDS[large[0]](frame.full) : null;
  byId("stage-caption").replaceChildren(...[shown, captionOf(frame, large[0])].filter(Boolean));
  view.panes.forEach(({ box }) => paneWatcher.observe(box));
  byId("slide").hidden = !(isPair() && viewer.layout === "one" && large[0] === "compare");
  setSplit(viewer.split);
}

/** What is shown, and how near it is to the file. */
function captionOf(frame, what) {
  if (!frame.full) return data.pictures.thumbnails;
  if (viewer.layout === "one" && data.pictures[what]) return data.pictures[what];
  const { full } = frame;
  const parts = [`Scene-linear Rec.709${full.space && full.space !== "rec709" ? ` (from ${full.space})` : ""}, shown as sRGB.`];
  if (frame.reduced) parts.push(`Reduced to ${data.pictures.reduced} pixels: this frame is not among the worst.`);
  if (!wholeNumbers(frame.sides.test))
    parts.push("Values are those of the file inside the dotted square around the worst pixel, elsewhere about right.");
  return parts.join(" ");
}

// ---- choices

function drawChoices() {
  const { frame } = viewer;
  const full = frame && frame.full;
  const there = { compare: true, ...(full ? frame.maps : {}) };
  const shows = SHOWS.filter(([key]) => key === "compare" || there[key]);
  radios(byId("shows"), "show", full && shows.length > 1 ? shows.map(([key, text]) =>
    [key, key === "compare" && !isPair() ? "Picture" : text, Boolean(there[key])]) : [],
  there[viewer.show] ? viewer.show : "compare", chooseShow);
  radios(byId("channels"), "channel", full ? CHANNELS.map(([key, text]) => [key, text, true,
    key ? `Shift and ${text}` : "all channels"]) : [], view.channel, (channel) => {
    view.channel = channel;
    drawPanes();
  });
  for (const id of ["toggle", "blink"]) byId(id).disabled = !isPair();
  byId("layout").setAttribute("aria-pressed", String(viewer.layout === "side"));
  byId("exposures").hidden = !full;
  for (const id of ["layout", "fit", "one-to-one"]) byId(id).disabled = !full;
}

function chooseShow(show) {
  viewer.show = show;
  viewer.layout = "one";
  refresh();
}

function chooseLayout(layout) {
  viewer.layout = layout;
  refresh();
}

/** Shows other images; the keyboard focus stays where it was. */
function refresh() {
  const focus = document.activeElement;
  const group = focus && focus.name;
  drawChoices();
  drawPictures();
  if (group === "show" || group === "channel") {
    const again = document.querySelector(`input[name="${group}"]:checked`);
    if (again) again.focus();
  }
}

// ---- the frame

/** "#1009", "#1009 left" of a view, "#1009/3" of a fault: what leads there. */
const linkOf = (frame, fault = 0) =>
  `#${encodeURIComponent(itemName(frame))}${fault ? `/${fault}` : ""}`;

/** The frame and the fault that the page's address names; the frame is -1 where it names none. */
function linked() {
  const [, head, fault] = /^(#[^/]*)(?:\/(\d+))?$/.exec(location.hash) || [null, "", 0];
  const index = frames.findIndex((frame) => linkOf(frame) === head);
  return { index, fault: index >= 0 && Number(fault) <= frames[index].faults.length ? Number(fault || 0) : 0 };
}

function address() {
  const link = linkOf(frames[viewer.index], viewer.fault);
  if (location.hash !== link) history.replaceState(null, "", link);
}

function chooseFault(number) {
  viewer.fault = number;
  address();
  drawFound();
  drawDecision();
  const mark = marksOf(viewer.index)[number - 1];
  const place = mark && viewer.frame && viewer.frame.full ? placeOf(mark, viewer.frame.full) : null;
  if (place) zoomOn(place);
  drawPanes();
}

/** The next or previous fault, in this frame or another. */
function stepFault(by) {
  const all = frames.flatMap((frame, index) => frame.faults.map((_, i) => ({ index, fault: i + 1 })));
  const here = (one) => (one.index - viewer.index) * 1000 + one.fault - viewer.fault;
  const next = by > 0 ? all.find((one) => here(one) > 0) : all.reverse().find((one) => here(one) < 0);
  if (next) select(next.index, next.fault);
}

function drawTitle(frame) {
  byId("frame-title").replaceChildren(`${frameTitle(frame)} `, badge(frame.status));
  const message = whyOf(frame);
  byId("message").textContent = message;
  byId("message").classList.toggle("empty", !message);
  byId("frame").value = viewer.index;
  byId("previous").disabled = viewer.index === 0;
  byId("next").disabled = viewer.index === frames.length - 1;
}

/** Pictures are decoded meanwhile; those of the frame before stay until then. */
async function showPictures(index) {
  let frame = null;
  try {
    frame = await frameOf(index);
  } catch (problem) {
    byId("message").textContent = problem.message;
  }
  if (index !== viewer.index) return;
  viewer.frame = frame;
  if (!isPair() && viewer.blink) stopBlinking();
  refresh();
  drawExposure();
  if (viewer.fault) chooseFault(viewer.fault);
  byId("near").replaceChildren(...nearBoxes(frames[index], frame && frame.full));
}

function select(index, fault = 0) {
  if (index < 0 || index >= frames.length) return Promise.resolve();
  Object.assign(viewer, { index, fault });
  address();
  drawTitle(frames[index]);
  drawFound();
  drawDecision();
  drawFacts(frames[index]);
  markCurve();
  markLists();
  viewer.ready = showPictures(index);
  return viewer.ready;
}
