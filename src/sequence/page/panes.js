// Panes that show one frame, all at the same place and in the same scale.

// `stops`: the exposure, null for that of the frame's largest error;
// `zoom`: pixels of the screen for one of the picture in the large pane, null for all that fits;
// x and y: what of the picture is in the middle, from 0 to 1.
const view = { zoom: null, x: 0.5, y: 0.5, stops: 0, channel: "", marks: true, panes: [], pointer: null, pins: [] };
const NAMES = { compare: "Reference and test", reference: "Reference", test: "Test", error: "Error map",
  stops: "Exposure map", bias: "Noise or change" };
const MOST_ZOOM = 64;

function svg(tag, attributes, ...children) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

function makePane(what, large) {
  const canvas = make("canvas", { role: "img" });
  const marks = svg("svg", { class: "marks", "aria-hidden": "true" });
  const box = make("div", { className: large ? "pane large" : "pane" }, canvas, marks);
  const pane = { what, large, box, canvas, marks };
  box.addEventListener("pointermove", (event) => pointAt(pane, event));
  box.addEventListener("pointerleave", () => { view.pointer = null; drawReadout(); });
  box.addEventListener("pointerdown", (event) => dragFrom(pane, event));
  box.addEventListener("wheel", (event) => wheel(pane, event), { passive: false });
  box.addEventListener("dblclick", (event) => {
    const [x, y] = pictureAt(pane, event);
    zoomTo(1 / devicePixelRatio, x, y);
  });
  return pane;
}

const shownStops = () => view.stops ?? (viewer.frame ? viewer.frame.start : 0);

// ---- geometry

const largePane = () => view.panes.find((pane) => pane.large) || view.panes[0];
const sizeOf = (pane) => ({ width: pane.box.clientWidth, height: pane.box.clientHeight });

function fitting(pane) {
  const { width, height } = sizeOf(pane);
  const { size } = viewer.frame;
  return Math.min(width / size.width, height / size.height);
}

/** Pixels of the screen for one of the picture. */
function scaleOf(pane) {
  if (view.zoom === null) return fitting(pane);
  return pane.large ? view.zoom : (view.zoom * fitting(pane)) / fitting(largePane());
}

/** Where the picture's first corner is in a pane. */
function originOf(pane) {
  const { width, height } = sizeOf(pane);
  const scale = scaleOf(pane);
  const { size } = viewer.frame;
  return { scale, left: width / 2 - view.x * size.width * scale, top: height / 2 - view.y * size.height * scale };
}

function pictureAt(pane, event) {
  const box = pane.box.getBoundingClientRect();
  const { scale, left, top } = originOf(pane);
  return [(event.clientX - box.left - left) / scale, (event.clientY - box.top - top) / scale];
}

/** From much smaller than what fits to single pixels; 1:1 is always among it. */
function heldZoom(zoom) {
  return Math.min(MOST_ZOOM, Math.max(Math.min(fitting(largePane()) / 4, 1 / devicePixelRatio), zoom));
}

const held = (value) => Math.min(1, Math.max(0, value));

/** The picture's point x, y comes to the middle. */
function zoomTo(zoom, x, y) {
  const { size } = viewer.frame;
  view.zoom = zoom === null ? null : heldZoom(zoom);
  view.x = zoom === null ? 0.5 : held(x / size.width);
  view.y = zoom === null ? 0.5 : held(y / size.height);
  drawPanes();
}

/** By a factor; the picture's point x, y stays where it is. */
function zoomBy(factor, x, y) {
  if (!viewer.frame) return;
  const { size } = viewer.frame;
  const before = scaleOf(largePane());
  const after = heldZoom(before * factor);
  const kept = before / after;
  zoomTo(after, x + (view.x * size.width - x) * kept, y + (view.y * size.height - y) * kept);
}

function panBy(dx, dy) {
  if (!viewer.frame) return;
  const { size } = viewer.frame;
  const scale = scaleOf(largePane());
  zoomTo(scale, view.x * size.width + dx / scale, view.y * size.height + dy / scale);
}

/** A rectangle of the picture, with some room around it. */
function zoomOn({ x, y, width, height }) {
  const { width: w, height: h } = sizeOf(largePane());
  const room = Math.min(w / Math.max(width * 3, 80), h / Math.max(height * 3, 45), 8);
  zoomTo(Math.max(room, fitting(largePane())), x + width / 2, y + height / 2);
}

// ---- mouse and pen

function wheel(pane, event) {
  const focused = byId("stage").contains(document.activeElement) || byId("maps").contains(document.activeElement);
  if (!viewer.frame || (!event.ctrlKey && !focused)) return;
  event.preventDefault();
  const [x, y] = pictureAt(pane, event);
  zoomBy(2 ** (-Math.sign(event.deltaY) * Math.min(1, Math.abs(event.deltaY) / 240)), x, y);
  pointAt(pane, event);
}

function dragFrom(pane, event) {
  if (!viewer.frame || event.button !== 0) return;
  stopBlinking();
  byId("stage").focus({ preventScroll: true });
  const wipes = Boolean(event.target.closest(".edge"));
  pane.box.setPointerCapture(event.pointerId);
  let last = event;
  const drag = (now) => {
    if (wipes) {
      const area = pane.box.getBoundingClientRect();
      setSplit((100 * (now.clientX - area.left)) / area.width);
    } else if (now.clientX !== last.clientX || now.clientY !== last.clientY) {
      const ratio = scaleOf(largePane()) / scaleOf(pane);
      panBy((last.clientX - now.clientX) * ratio, (last.clientY - now.clientY) * ratio);
    }
    last = now;
  };
  pane.box.addEventListener("pointermove", drag);
  pane.box.addEventListener("lostpointercapture", () => pane.box.removeEventListener("pointermove", drag),
    { once: true });
}

function pointAt(pane, event) {
  if (!viewer.frame) return;
  const [x, y] = pictureAt(pane, event).map(Math.floor);
  view.pointer = inside(viewer.frame.size, x, y) ? { x, y } : null;
  drawReadout();
}

// ---- drawing

/** `shown`: the corners of the part of the picture that the pane has on the screen. */
function shownCorners(pane) {
  const { width, height } = sizeOf(pane);
  const { scale, left, top } = originOf(pane);
  return { x0: -left / scale, y0: -top / scale, x1: (width - left) / scale, y1: (height - top) / scale };
}

const scratch = document.createElement("canvas");

/** Draws what of a source is on the screen, in the level that is nearest to its resolution. */
function drawSource(pen, pane, from, look) {
  const { place } = from;
  const { scale, left, top } = originOf(pane);
  const wanted = (place.width * scale * devicePixelRatio) / from.levels[0].width;
  const level = levelOf(from, Math.max(0, Math.floor(-Math.log2(wanted) + 0.4)));
  const per = { x: level.width / place.width, y: level.height / place.height };
  const { x0, y0, x1, y1 } = shownCorners(pane);
  const a = Math.max(0, Math.floor((x0 - place.x) * per.x)), b = Math.max(0, Math.floor((y0 - place.y) * per.y));
  const c = Math.min(level.width, Math.ceil((x1 - place.x) * per.x));
  const d = Math.min(level.height, Math.ceil((y1 - place.y) * per.y));
  if (c <= a || d <= b) return;
  if (scratch.width < c - a || scratch.height < d - b) {
    scratch.width = Math.max(scratch.width, c - a);
    scratch.height = Math.max(scratch.height, d - b);
  }
  scratch.getContext("2d").putImageData(shownPart(from, level, a, b, c - a, d - b, look), 0, 0);
  pen.drawImage(scratch, 0, 0, c - a, d - b, left + (place.x + a / per.x) * scale, top + (place.y + b / per.y) * scale,
    ((c - a) / per.x) * scale, ((d - b) / per.y) * scale);
}

function drawWhole(pen, pane, canvas) {
  const { scale, left, top } = originOf(pane);
  const { size } = viewer.frame;
  pen.drawImage(canvas, left, top, size.width * scale, size.height * scale);
}

/** The numbers of one side, where they are those of every pixel. */
function wholeNumbers(side) {
  const { width, height } = viewer.frame.size;
  return side.numbers.find(({ mean, place }) => !mean && place.width === width && place.height === height);
}

function drawSide(pen, pane, side) {
  if (view.channel === "a") {
    if (side.alpha) drawWhole(pen, pane, side.alpha.canvas);
    else fillPicture(pen, pane, "#fff");
    return;
  }
  const look = { stops: shownStops(), channel: view.channel };
  const whole = wholeNumbers(side);
  if (!whole) drawSource(pen, pane, side.picture, look);
  for (const from of whole ? [whole] : side.numbers) if (!from.mean) drawSource(pen, pane, from, look);
}

function fillPicture(pen, pane, colour) {
  const { scale, left, top } = originOf(pane);
  const { size } = viewer.frame;
  pen.fillStyle = colour;
  pen.fillRect(left, top, size.width * scale, size.height * scale);
}

/** Reference at the left of the edge, test at its right. */
function drawCompared(pen, pane, { reference, test }) {
  const { width, height } = sizeOf(pane);
  const edge = (width * viewer.split) / 100;
  for (const [side, from, to] of [[reference, 0, edge], [test, edge, width]]) {
    if (to <= from) continue;
    pen.save();
    pen.beginPath();
    pen.rect(from, 0, to - from, height);
    pen.clip();
    drawSide(pen, pane, side);
    pen.restore();
  }
}

function drawPane(pane) {
  const { width, height } = sizeOf(pane);
  const { canvas } = pane;
  const w = Math.round(width * devicePixelRatio), h = Math.round(height * devicePixelRatio);
  if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
  const pen = canvas.getContext("2d");
  pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
  pen.clearRect(0, 0, width, height);
  const { frame } = viewer;
  if (!frame || !width || !height) return;
  pen.imageSmoothingEnabled = scaleOf(pane) * devicePixelRatio <= 2;
  pen.imageSmoothingQuality = "high";
  const { sides, maps } = frame;
  if (!frame.full) drawWhole(pen, pane, frame.image);
  else if (pane.what === "compare" && sides.reference) drawCompared(pen, pane, sides);
  else if (maps[pane.what]) drawWhole(pen, pane, maps[pane.what].canvas);
  else drawSide(pen, pane, sides[pane.what] || sides.test);
  drawMarks(pane);
}

let asked = 0;
/** With the browser's next frame, however often it is asked for. */
function drawPanes() {
  asked ||= requestAnimationFrame(drawPanesNow);
}

function drawPanesNow() {
  cancelAnimationFrame(asked);
  asked = 0;
  view.panes.forEach(drawPane);
  if (viewer.frame) {
    const percent = scaleOf(largePane()) * devicePixelRatio * 100;
    byId("zoom").textContent = `${percent < 10 ? percent.toFixed(1) : Math.round(percent)} %`;
  }
  drawReadout();
}

// ---- marks

/** What is marked in the picture: faults of the frame by their number, and the largest errors. */
function marksOf(index) {
  const frame = frames[index];
  const marks = frame.faults.map((fault, i) => ({ label: String(i + 1), fault, kind: classOf(fault.severity),
    rectangle: fault.rectangle, position: fault.position }));
  for (const { worst } of frame.measurements)
    if (worst && !marks.some(({ label, position }) => label === "max" && position.x === worst.x && position.y === worst.y))
      marks.push({ label: "max", kind: "info", position: worst });
  return marks;
}

/** In the picture that is shown; null where a fault is of the whole frame. */
function placeOf({ rectangle, position }, full) {
  if (rectangle) return shownPlace(full, { x: rectangle[0], y: rectangle[1], width: rectangle[2], height: rectangle[3] });
  return position ? shownPlace(full, { ...position, width: 1, height: 1 }) : null;
}

function drawMarks(pane) {
  const { full } = viewer.frame;
  const { scale, left, top } = originOf(pane);
  const nodes = [];
  const { near } = viewer.frame;
  if (pane.large && view.marks && near && !wholeNumbers(viewer.frame.sides.test)) {
    nodes.push(svg("rect", { class: "exact", x: left + near.x * scale, y: top + near.y * scale,
      width: near.width * scale, height: near.height * scale }));
  }
  for (const mark of full && view.marks ? marksOf(viewer.index) : []) {
    const place = placeOf(mark, full);
    if (!place) continue;
    const x = left + place.x * scale, y = top + place.y * scale;
    const w = place.width * scale, h = place.height * scale;
    const chosen = mark.fault && mark.label === String(viewer.fault) ? " chosen" : "";
    const shape = { class: `mark ${mark.kind}${chosen}` };
    const outline = { class: "outline" };
    const radius = Math.max(9, w);
    const draw = (attributes) => (mark.rectangle ? svg("rect", { ...attributes, x, y, width: Math.max(w, 4), height: Math.max(h, 4) })
      : svg("circle", { ...attributes, cx: x + w / 2, cy: y + h / 2, r: radius }));
    nodes.push(draw(outline), draw(shape));
    if (pane.large) nodes.push(svg("text", { class: `mark ${mark.kind}`, x: mark.rectangle ? x + 3 : x + w / 2 + radius + 2,
      y: mark.rectangle ? y + 14 : y + h / 2 - radius + 4 }, mark.label));
  }
  for (const pin of full ? view.pins : []) {
    const x = left + (pin.x + 0.5) * scale, y = top + (pin.y + 0.5) * scale;
    nodes.push(svg("path", { class: "pin", d: `M${x - 7} ${y}h14M${x} ${y - 7}v14` }));
  }
  pane.marks.replaceChildren(...nodes);
}
