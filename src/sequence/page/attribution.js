// Whose error it is: three tables of the frame that is shown.

const percent = (share) => (typeof share === "number" ? `${number(Math.round(1000 * share) / 10)} %` : "");
const factor = (gain, error) => (typeof gain === "number"
  ? `${number(gain)}${typeof error === "number" && error > 0 ? ` \u00b1 ${number(error)}` : ""}` : "");

/** A table with a heading for each column, in a box of its own that scrolls. */
function listing(caption, columns, rows) {
  const cell = ([, of, isValue], row) => {
    const text = of(row);
    return make("td", { className: isValue ? "value" : "" }, text === undefined || text === null ? "" : String(text));
  };
  const [first, ...others] = columns;
  return make("div", { className: "wide" }, make("h3", {}, caption),
    make("div", { className: "scroll", tabIndex: 0, role: "region", "aria-label": caption },
      make("table", {},
        make("thead", {}, make("tr", {}, ...columns.map(([title, , isValue]) =>
          make("th", { scope: "col", className: isValue ? "value" : "" }, title)))),
        make("tbody", {}, ...rows.map((row) => make("tr", { className: row.finding ? "finding" : "" },
          make("th", { scope: "row" }, name(String(first[1](row)))), ...others.map((column) => cell(column, row))))))));
}

const LIGHTS = [["Light", (row) => row.name], ["Finding", (row) => row.finding],
  ["Explains", (row) => percent(row.explains), true],
  ["Error with the reference's", (row) => row.mean_replaced !== undefined && number(row.mean_replaced), true],
  ["Error by it alone", (row) => row.mean_alone !== undefined && number(row.mean_alone), true],
  ["Times the reference's light", (row) => factor(row.gain, row.gain_error), true]];
const MATTES = [["Name", (row) => row.name], ["Finding", (row) => row.finding],
  ["Of the error", (row) => percent(row.mass), true], ["Mean error", (row) => number(row.mean), true],
  ["Pixels", (row) => `${number(Math.round(row.pixels_reference))} \u2192 ${number(Math.round(row.pixels_test))}`, true],
  ["Changed", (row) => number(row.changed), true],
  ["Moved", (row) => (row.shift && row.changed ? row.shift.map((way) => number(Math.round(10 * way) / 10)).join(", ") : ""), true],
  ["Times the reference's R, G, B", (row) => (row.gain || []).map((gain) => factor(gain)).join(", "), true]];
const LAYERS = [["Layer", (row) => row.name], ["Finding", (row) => row.finding],
  ["Mean", (row) => number(row.mean), true], ["Largest", (row) => number(row.max), true], ["Unit", (row) => row.unit],
  ["Changed pixels", (row) => (row.gain === undefined ? number(row.changed) : ""), true],
  ["Times the reference's light", (row) => factor(row.gain, row.gain_error), true],
  ["Mostly under", (row) => (row.most_under || []).map(([who, share]) => `${who} (${percent(share)})`).join(", ")]];

function manifestBox(manifests) {
  const items = [];
  for (const [type, sides] of Object.entries(manifests || {})) {
    for (const [side, names] of Object.entries(sides))
      items.push(make("li", {}, `${type}: only the ${side} has ${[].concat(names).join(", ")}`));
  }
  return items.length ? [make("div", { className: "wide" }, make("h3", {}, "Names of one manifest alone"),
    make("ul", {}, ...items))] : [];
}

/** Findings as sentences, then lights, objects of each Cryptomatte, layers. */
function attributionBoxes(attribution) {
  if (!attribution) return [];
  const rowsOf = (list) => (Array.isArray(list) ? list.filter((row) => row instanceof Object) : []);
  const findings = Array.isArray(attribution.findings) ? attribution.findings.map(String) : [];
  const [lights, layers] = [rowsOf(attribution.lights), rowsOf(attribution.layers)];
  const boxes = [make("div", { className: "wide" }, make("h3", {}, "Whose error it is"),
    findings.length ? make("ul", {}, ...findings.map((text) => make("li", {}, text)))
      : make("p", {}, "No light, object or layer has changed: what differs is noise, or in none of them."))];
  if (lights.length) boxes.push(listing("Lights", LIGHTS, lights));
  for (const [type, rows] of Object.entries(attribution.mattes || {})) boxes.push(listing(type, MATTES, rowsOf(rows)));
  if (layers.length) boxes.push(listing("Layers", LAYERS, layers));
  return boxes.concat(manifestBox(attribution.manifest_only));
}
