// The plot of the error over the frames.

const POINTS = { passed: "circle", measured: "circle", skipped: "circle", warning: "triangle", failed: "rectRot" };
const unordered = frames.some(isCase) && !frames.some((frame) => frame.frame); // no line joins cases
const curve = { chart: null, place: mainPlace, quantity: null };
const color = (key) => getComputedStyle(document.documentElement).getPropertyValue(`--${key}`).trim();

/** The limit of each frame; rows of a suite may give a case its own. */
function curveLimits() {
  const limitOf = (frame, kind) => {
    const measurement = curve.place >= 0 && measurementOf(frame, curve.place);
    const limit = measurement && thresholdsOf(measurement).find((one) => one.quantity === curve.quantity);
    return limit && typeof limit[kind] === "number" ? limit[kind] : null;
  };
  return ["fail", "warn"].map((kind) => ({ kind, values: frames.map((frame) => limitOf(frame, kind)) }))
    .map(({ kind, values }) => {
      const all = [...new Set(values.filter((value) => value !== null))];
      const value = all.length === 1 ? all[0] : null; // null: it is not one for all
      return { kind, value, values: value === null ? values : values.map(() => value), any: all.length > 0 };
    }).filter(({ any }) => any);
}

function curveSets() {
  const values = frames.map((frame) => valueOf(frame, curve.place, curve.quantity));
  const per = (f) => frames.map(f);
  const plain = frames.length > 200 ? 1 : 3;
  const loud = (frame) => !["passed", "measured", "skipped"].includes(frame.status);
  const sets = [{
    label: curve.place < 0 ? "faults" : curve.quantity, data: values, borderColor: color("accent"),
    backgroundColor: color("accent"), borderWidth: 2, tension: 0, spanGaps: false,
    showLine: !unordered,
    pointStyle: per((frame) => POINTS[frame.status] || "rect"),
    pointRadius: per((frame) => (loud(frame) ? 7 : plain)),
    pointHoverRadius: per((frame) => (loud(frame) ? 9 : 6)),
    pointBackgroundColor: per((frame) => (loud(frame) ? color(classOf(frame.status)) : color("accent"))),
    pointBorderColor: per((frame, i) => (i === viewer.index ? color("ink") : color("card"))),
    pointBorderWidth: per((frame, i) => (i === viewer.index ? 3 : 1)),
  }];
  const lost = (i) => values[i] === null && frames[i].status !== "skipped";
  if (values.some((_, i) => lost(i))) {
    sets.push({ label: "no result", data: values.map((_, i) => (lost(i) ? 0 : null)),
      showLine: false, pointStyle: "crossRot", pointRadius: 7, pointHoverRadius: 9, clip: false,
      borderColor: color("error"), pointBorderWidth: 3, backgroundColor: color("error") });
  }
  for (const { kind, value, values: limits } of curveLimits()) {
    sets.push({ label: value === null ? kind : `${kind} ${number(value)}`, data: limits,
      showLine: value !== null, pointRadius: value === null ? 12 : 0, pointBorderWidth: 3,
      pointHoverRadius: 0, borderWidth: 2, borderDash: kind === "fail" ? [7, 4] : [2, 4],
      borderColor: color(kind === "fail" ? "failed" : "warning"), pointStyle: "line",
      backgroundColor: "transparent" });
  }
  return sets;
}

function curveTip(item) {
  const frame = frames[item.dataIndex];
  if (["fail", "warn"].includes(item.dataset.label)) return `${item.dataset.label} ${number(item.raw)}`;
  if (item.datasetIndex > 0 && item.dataset.label !== "no result") return item.dataset.label;
  const value = valueOf(frame, curve.place, curve.quantity);
  return value === null ? `no result: ${frame.message || frame.status}`
    : `${curve.place < 0 ? "faults" : curve.quantity} ${number(value)} (${frame.status})`;
}

function curveOptions() {
  const axis = (title) => ({ title: { display: true, text: title, color: color("soft") },
    ticks: { color: color("soft"), maxRotation: 0, autoSkipPadding: 14 },
    grid: { color: color("line"), borderColor: color("soft") } });
  return {
    responsive: true, maintainAspectRatio: false, animation: false, layout: { padding: { right: 10 } },
    interaction: { mode: "index", intersect: false },
    scales: { x: axis(NOUN), y: { ...axis(curve.place < 0 ? "faults" : curve.quantity),
      beginAtZero: true, grace: "5%" } },
    plugins: {
      legend: { align: "end", labels: { color: color("ink"), usePointStyle: true, boxWidth: 30 } },
      tooltip: { callbacks: { title: (items) => `${capital(NOUN)} ${items[0].label}`, label: curveTip } },
    },
    onClick: (event, active, chart) => {
      const near = chart.getElementsAtEventForMode(event, "index", { intersect: false }, false);
      if (near.length) select(near[0].index);
    },
  };
}

function curveWords() {
  const values = frames.map((frame) => valueOf(frame, curve.place, curve.quantity));
  let high = -1;
  values.forEach((value, i) => {
    if (value !== null && (high < 0 || value > values[high])) high = i;
  });
  const lost = values.filter((value, i) => value === null && frames[i].status !== "skipped").length;
  const what = curve.place < 0 ? "faults" : curve.quantity;
  const parts = [high < 0 ? `No ${NOUN} has a value.` :
    `The largest ${what} is ${number(values[high])}, at ${NOUN} ${frameName(frames[high])}.`];
  curveLimits().forEach(({ kind, value }) => parts.push(value === null
    ? `Each ${NOUN} has its own limit (${kind}).` : `${capital(NOUN)}s ${kind} at ${number(value)}.`));
  if (lost) parts.push(`${plural(lost, NOUN)} without a result.`);
  return parts.join(" ");
}

function drawCurve() {
  const made = { type: "line", data: { labels: frames.map(frameName), datasets: curveSets() },
    options: curveOptions() };
  if (curve.chart) curve.chart.destroy();
  curve.chart = new Chart(byId("curve"), made);
  byId("curve").setAttribute("aria-label", `Curve over ${plural(frames.length, NOUN)}. ${curveWords()}`);
  byId("curve-hint").textContent = `${meaningOf(curve.quantity)} ${curveWords()} A click on the curve shows the ${NOUN}.`.trim();
}

function markCurve() {
  if (!curve.chart) return;
  const [points] = curve.chart.data.datasets;
  points.pointBorderColor = frames.map((_, i) => (i === viewer.index ? color("ink") : color("card")));
  points.pointBorderWidth = frames.map((_, i) => (i === viewer.index ? 3 : 1));
  curve.chart.update("none");
}

function chooseMeasure(place) {
  curve.place = place;
  const quantities = place < 0 ? ["faults"] : quantitiesOf(place);
  const limit = hasVerdict(place) ? null : thresholdOf(place);
  if (limit && !quantities.includes(limit.quantity)) quantities.push(limit.quantity);
  curve.quantity = limit ? limit.quantity : quantities[0];
  byId("quantity").replaceChildren(...quantities.map((each) =>
    make("option", { value: each, selected: each === curve.quantity }, each)));
}

function startCurve() {
  const places = measures.map((command, place) => ({ command, place }));
  if (frames.some((frame) => frame.faults.length)) places.push({ command: "faults found", place: -1 });
  if (!places.length) {
    document.querySelector("section.curve").hidden = true;
    return;
  }
  byId("measure").replaceChildren(...places.map(({ command, place }) =>
    make("option", { value: place, selected: place === mainPlace }, command)));
  chooseMeasure(measures.length ? mainPlace : -1);
  byId("measure").onchange = (event) => { chooseMeasure(Number(event.target.value)); drawCurve(); };
  byId("quantity").onchange = (event) => { curve.quantity = event.target.value; drawCurve(); };
  drawCurve();
}
