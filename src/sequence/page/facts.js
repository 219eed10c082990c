// The numbers of the frame that is shown.

const facts = { histograms: [] };

function table(caption, rows) {
  return make("div", {}, make("h3", {}, caption), make("table", {}, make("tbody", {},
    ...rows.map(([key, value]) => make("tr", {}, make("th", { scope: "row" }, key),
      make("td", { className: typeof value === "number" ? "value" : "" },
        value instanceof Node ? value : typeof value === "number" ? number(value) : String(value)))))));
}

function histogramBox(measurement) {
  const total = measurement.histogram.reduce((sum, count) => sum + count, 0);
  const canvas = make("canvas", { role: "img", "aria-label":
    `Histogram of the error of ${total} pixels: ` +
    `${number(100 * (1 - measurement.histogram[0] / Math.max(1, total)))} % of them are above 0.01` });
  const box = make("div", {}, make("h3", {}, "Histogram of the error"),
    make("div", { className: "plot" }, canvas));
  const axis = (text) => ({ title: { display: true, text, color: color("soft") },
    ticks: { color: color("soft"), maxRotation: 0, autoSkipPadding: 16 },
    grid: { display: false, borderColor: color("soft") } });
  const draw = () => new Chart(canvas, { type: "bar",
    data: { labels: measurement.histogram.map((_, i) => (i / measurement.histogram.length).toFixed(2)),
      datasets: [{ label: "pixels", data: measurement.histogram.map((count) => count || null),
        backgroundColor: color("accent"), barPercentage: 1, categoryPercentage: 1 }] },
    options: { responsive: true, maintainAspectRatio: false, animation: false,
      plugins: { legend: { display: false } }, interaction: { mode: "index", intersect: false },
      scales: { x: axis("error"), y: { ...axis("pixels"), type: "logarithmic", min: 0.8,
        ticks: { color: color("soft"), callback: (value) =>
          (Number.isInteger(Math.log10(value)) ? value.toLocaleString("en") : null) } } } } });
  return [box, draw];
}

function cropsOf(list) {
  const figures = [];
  for (const crop of list) {
    for (const key of ["reference", "test", "error"]) {
      if (!crop[key]) continue;
      const words = crop.reference ? key : `${crop.x},${crop.y}`;
      figures.push(make("figure", {}, picture(crop[key], `${key} around ${crop.x},${crop.y}`),
        make("figcaption", {}, words)));
    }
  }
  return make("div", { className: "crops" }, ...figures);
}

/** The pixel of the largest error and its neighbours, for each measurement. */
function nearBoxes(frame, full) {
  const boxes = [];
  for (const { worst } of frame.measurements) {
    const found = full && worst ? (full.spots || []).filter((spot) => spot.x === worst.x && spot.y === worst.y) : [];
    if (found.length)
      boxes.push(make("h3", {}, `The largest error, pixel by pixel, at ${worst.x},${worst.y}`), cropsOf(found));
  }
  return boxes;
}

function settingsOf(measurement) {
  const rows = entries(measurement.settings).map(([key, value]) => [key, name(value)]);
  if (measurement.exposures && measurement.exposures.length) {
    const list = measurement.exposures;
    rows.push(["exposures", `${list.length}: ${stops(list[0])} to ${stops(list[list.length - 1])} stops`]);
  }
  return rows.concat(entries(measurement.parameters));
}

/** Of a command with one of three verdicts: its sentence, what was found, and the numbers. */
function verdictBoxes(measurement, rows) {
  const found = (measurement.evidence || []).map((text) => make("li", {}, text));
  const boxes = [make("div", { className: "wide" }, make("h3", {}, `${measurement.command} (${measurement.status})`),
    make("p", {}, measurement.sentence), found.length ? make("ul", {}, ...found) : null)];
  boxes.push(table("Numbers", rows), table("Parameters", settingsOf(measurement)));
  measurement.warnings.forEach((text) => boxes.push(make("p", { className: "wide" }, badge("warning"),
    ` ${text}`)));
  return boxes;
}

function measurementBoxes(measurement) {
  const rows = entries(measurement.quantities);
  if (measurement.verdict) return verdictBoxes(measurement, rows);
  for (const limit of thresholdsOf(measurement)) {
    if (typeof limit.fail === "number") rows.push([`fail (${limit.quantity})`, limit.fail]);
    if (typeof limit.warn === "number") rows.push([`warn (${limit.quantity})`, limit.warn]);
  }
  if (measurement.pixels) rows.push(["pixels", measurement.pixels]);
  const boxes = [table(`${measurement.command} (${measurement.status})`, rows)];
  const settings = settingsOf(measurement);
  if (settings.length) boxes.push(table("Parameters", settings));
  measurement.warnings.forEach((text) => boxes.push(make("p", { className: "wide" }, badge("warning"),
    ` ${text}`)));
  return boxes;
}

function drawFacts(frame) {
  const boxes = [];
  const later = [];
  for (const measurement of frame.measurements) {
    const parts = measurementBoxes(measurement);
    if (measurement.histogram && measurement.histogram.length) {
      const [box, draw] = histogramBox(measurement);
      parts.push(box);
      later.push(draw);
    }
    boxes.push(...attributionBoxes(measurement.attribution), ...parts);
  }
  const files = [["reference", frame.reference], ["test", frame.test]].filter(([, file]) => file);
  boxes.push(...files.length ? [table("Files", files.map(([key, file]) => [key, name(file)]))] : []);
  facts.histograms.forEach((chart) => chart.destroy());
  byId("facts").replaceChildren(...boxes);
  facts.histograms = later.map((draw) => draw());
}
