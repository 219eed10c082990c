// The values of a pixel.

const signed = (value, digits) => `${value < 0 ? "\u2212" : "+"}${Math.abs(value).toFixed(digits)}`;

function componentText(value, how) {
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "over 65504" : "under \u221265504";
  return how === "picture" ? String(Number(value.toPrecision(2))) : number(value);
}

function colourText({ rgb, alpha, how }) {
  const text = rgb.map((value) => componentText(value, how)).join("  ");
  return alpha === null ? text : `${text}  A ${componentText(alpha, how === "number" ? how : "picture")}`;
}

const HOWS = { number: "", mean: " (mean of the pixels around it)", picture: " (from the picture)" };

function stopsBetween(reference, test) {
  const [a, b] = [reference, test].map(({ rgb }) => luminance(...rgb));
  if (a > 0 && b > 0 && Number.isFinite(a) && Number.isFinite(b)) return `${signed(Math.log2(b / a), 2)} stops`;
  return a === b ? "equal" : "\u2014";
}

/** Rows of a name and a text: what is known of a shown pixel. */
function readoutOf(frame, x, y) {
  const { full, sides, maps } = frame;
  const [fx, fy] = filePixel(full, x, y);
  const found = Object.entries(sides).map(([side, of]) => [side, colourAt(of, x, y)]);
  const rows = [["x, y", `${fx}, ${fy}`]];
  for (const [side, colour] of found)
    rows.push([found.length > 1 ? NAMES[side] : "R G B", `${colour.how === "picture" ? "about " : ""}${colourText(colour)}${HOWS[colour.how]}`]);
  if (sides.reference && sides.test) rows.push(["Difference", stopsBetween(found[0][1], found[1][1])]);
  const error = errorAt(frame, x, y);
  if (error) rows.push(["Error", `${error.exact ? "" : "about "}${error.value.toFixed(2)}`]);
  if (maps.stops) {
    const [low, high] = full.range;
    rows.push(["Worst at", `${stops(low + mapAt(maps.stops, x, y) * (high - low))} stops`]);
  }
  return rows;
}

/** The pointer's pixel, else the one in the middle. */
function spotOf(frame) {
  if (view.pointer) return view.pointer;
  const at = (part, size) => Math.min(Math.floor(part * size), size - 1);
  return { x: at(view.x, frame.size.width), y: at(view.y, frame.size.height) };
}

function readoutRow(frame, { x, y }, more) {
  const cells = readoutOf(frame, x, y).map(([key, text]) => make("span", {}, make("b", {}, key), ` ${text}`));
  return make("p", { className: "values" }, ...cells, more);
}

function drawReadout() {
  const { frame } = viewer;
  const rows = [];
  if (frame && frame.full) {
    rows.push(readoutRow(frame, spotOf(frame), view.pointer ? null : make("span", { className: "hint" }, "(the middle)")));
    view.pins.forEach((pin, i) => rows.push(readoutRow(frame, pin, make("button", { type: "button", className: "plain",
      "aria-label": `Remove pin ${i + 1}`, onclick: () => { view.pins.splice(i, 1); drawPanes(); } }, "remove"))));
  }
  byId("readout").replaceChildren(...rows);
}

function pin() {
  if (!viewer.frame || !viewer.frame.full) return;
  view.pins.push({ ...spotOf(viewer.frame) });
  if (view.pins.length > 4) view.pins.shift();
  drawPanes();
}
