// Worst frames, faults, all frames.

function thumbnail(index, className) {
  const small = picturesOf(index, "small");
  if (!small) return make("span", { className: className || "none" }, className ? "" : frames[index].status);
  return make("img", { src: small.test, alt: "", className });
}

function drawWorst() {
  const shown = data.shot.worst.slice(0, 100);
  byId("worst").replaceChildren(...shown.map((index) => {
    const frame = frames[index];
    return make("li", {}, make("button", { type: "button", className: "pick", "data-index": index,
      onclick: () => { select(index); } },
      thumbnail(index), make("strong", {}, frameTitle(frame)), badge(frame.status),
      make("span", { className: "what" }, `${isRejected(frame) ? "rejected. " : isAccepted(frame) ? "accepted. " : ""}`
        + whyOf(frame))));
  }));
  const more = data.shot.worst.length - shown.length;
  const note = more > 0 ? `and ${plural(more, `more ${NOUN}`)}, see below`
    : shown.length === 0 ? "There is none." : "";
  byId("worst-note").textContent = note;
}

/** "1004,1006,1009-1011": ascending numbers as render farms read them. */
function rangeText(numbers) {
  const parts = [];
  for (const number of [...new Set(numbers)].sort((a, b) => a - b)) {
    const last = parts[parts.length - 1];
    if (last && last[1] === number - 1) last[1] = number;
    else parts.push([number, number]);
  }
  return parts.map(([low, high]) => (low === high ? `${low}` : `${low}-${high}`)).join(",");
}

/** Nothing is wrong with the frame but faults that were accepted here. */
function isAccepted(frame) {
  const bad = frame.faults.filter((fault) => fault.severity === "error");
  return frame.status === "failed" && bad.length > 0 && frame.measurements.every((one) => one.status !== "failed")
    && bad.every((fault) => (decisionOf(frame, fault) || {}).what === "accepted");
}

const isRejected = (frame) => frame.faults.some((fault) => (decisionOf(frame, fault) || {}).what === "rejected");

/** As --bad-frames writes them: what failed or could not be checked, by the numbers of the tests; without what was
 * accepted here, and with what was rejected. */
function badFrames() {
  const bad = (frame) => ["failed", "error"].includes(classOf(frame.status)) && !isAccepted(frame);
  return rangeText(frames.filter((frame) => bad(frame) || isRejected(frame)).map((frame) => frame.test_frame ?? frame.frame));
}

function drawBadFrames() {
  const text = badFrames();
  byId("bad").hidden = !text || frames.some(isCase) || (frames.length === 1 && frames[0].frame === 0);
  byId("bad-frames").textContent = text;
  byId("copy").onclick = async () => {
    getSelection().selectAllChildren(byId("bad-frames"));
    try {
      await navigator.clipboard.writeText(text);
      byId("copied").textContent = "copied";
    } catch {
      byId("copied").textContent = "selected: copy with the keyboard";
    }
  };
}

/** Where a fault is, in words. */
function placeText({ rectangle, position }) {
  if (rectangle) return `${rectangle[2]}x${rectangle[3]} at ${rectangle[0]},${rectangle[1]}`;
  return position ? `at ${position.x},${position.y}` : "";
}

/** The layer in which a fault is, as it is in the files; of each layer once. */
function layerFigures(index, i) {
  const { faults } = frames[index];
  const { layer } = faults[i];
  const shown = (picturesOf(index, "layers") || []).find((one) => one.layer === layer);
  if (!shown || faults.findIndex((fault) => fault.layer === layer) !== i) return null;
  const figures = ["reference", "test"].filter((side) => shown[side]).map((side) => {
    return make("figure", {}, picture(shown[side], `${layer} of the ${side}`),
      make("figcaption", {}, shown.reference ? side : layer));
  });
  return make("div", { className: "layers" }, ...figures);
}

/** The faults and the largest errors of the frame, beside its picture. */
function drawFound() {
  const frame = frames[viewer.index];
  const rows = marksOf(viewer.index).map((mark, i) => {
    const { fault } = mark;
    const decision = fault && decisionOf(frame, fault);
    return make("li", {}, make("button", { type: "button", className: "found", "data-fault": fault ? i + 1 : null,
      "aria-current": fault && viewer.fault === i + 1 ? "true" : null,
      onclick: () => (fault ? chooseFault(i + 1) : showMark(mark)) },
    make("b", { className: "label" }, mark.label),
    make("span", {}, fault ? badge(fault.severity) : null, " ", make("strong", {}, fault ? fault.code : "largest error"),
      fault && fault.layer ? ` in ${fault.layer}` : "", ` ${placeText(mark)}`,
      decision ? make("em", {}, ` ${decision.what}${decision.why ? `: ${decision.why}` : ""}`) : null,
      fault ? make("span", { className: "what" }, fault.sentence) : null)),
    fault ? layerFigures(viewer.index, i) : null);
  });
  byId("found").replaceChildren(...rows);
  byId("found-title").hidden = rows.length === 0;
}

function showMark(mark) {
  const place = viewer.frame && viewer.frame.full ? placeOf(mark, viewer.frame.full) : null;
  if (place) zoomOn(place);
}

function faultRow(frame, index, fault, spots) {
  const numbers = [];
  if (typeof fault.value === "number") numbers.push(`measured ${number(fault.value)}`);
  if (typeof fault.threshold === "number") numbers.push(`allowed ${number(fault.threshold)}`);
  if (placeText(fault)) numbers.push(placeText(fault));
  const place = fault.position && spots.filter((spot) =>
    spot.x === fault.position.x && spot.y === fault.position.y);
  return make("div", { className: "fault" },
    make("p", {}, make("button", { type: "button", onclick: () => {
      select(index, frame.faults.indexOf(fault) + 1);
      byId("viewer").focus();
    } },
      frameTitle(frame)), " ", badge(fault.severity), " ", make("strong", {}, fault.code),
    fault.layer ? " in " : "", fault.layer ? name(fault.layer) : ""),
    make("p", {}, fault.sentence),
    numbers.length ? make("p", { className: "hint" }, numbers.join(", ")) : null,
    place && place.length ? cropsOf(place) : null);
}

function drawFaults() {
  const order = { error: 0, warning: 1, info: 2 };
  const rows = [];
  frames.forEach((frame, index) => frame.faults.forEach((fault) => rows.push({ frame, index, fault })));
  rows.sort((a, b) => (order[a.fault.severity] ?? 0) - (order[b.fault.severity] ?? 0) || a.index - b.index);
  const most = 300;
  const nodes = rows.slice(0, most).map(({ frame, index, fault }) => {
    const spots = (picturesOf(index, "full") || picturesOf(index, "small") || {}).spots || [];
    return faultRow(frame, index, fault, spots);
  });
  if (rows.length > most)
    nodes.push(make("p", { className: "hint" }, `${rows.length - most} more are in the JSON file.`));
  byId("faults").replaceChildren(...nodes);
  document.querySelector("section.faults").hidden = rows.length === 0;
  byId("faults-title").textContent = `Faults (${rows.length})`;
}

function mainValue(frame) {
  const value = valueOf(frame, mainPlace, mainQuantity);
  return value === null ? "" : number(value);
}

/** The part of a message that the value and its threshold do not say. */
function otherMessage(frame) {
  const measured = measurementOf(frame, mainPlace);
  return measured && frame.message.startsWith(`${measured.command}: ${mainQuantity} `) ? "" : frame.message;
}

function frameRow(frame, index) {
  const cells = [make("td", { className: "picture" }),
    make("td", {}, make("button", { type: "button", className: "pick", onclick: () => {
      select(index);
      byId("viewer").focus();
    } }, frameName(frame))),
    make("td", {}, badge(frame.status)), make("td", { className: "value" }, mainValue(frame)),
    make("td", {}, otherMessage(frame)), make("td", {}, frame.test ? name(short(frame.test)) : "")];
  return make("tr", { "data-index": index }, ...cells);
}

/** Thumbnails of a thousand frames are decoded when they come into view. */
const thumbnailWatcher = new IntersectionObserver((seen) => {
  for (const { isIntersecting, target } of seen) {
    if (!isIntersecting) continue;
    thumbnailWatcher.unobserve(target);
    target.replaceChildren(thumbnail(Number(target.parentNode.dataset.index), "small"));
  }
}, { rootMargin: "200px" });

// Which frames the table has, in which order.
const all = { order: [], text: "", status: "", sort: "frame" };

function wanted(frame) {
  if (all.status && frame.status !== all.status) return false;
  const words = `${frameName(frame)} ${frame.status} ${frame.message} ${frame.test} ${frame.reference} `
    + frame.faults.map((fault) => `${fault.code} ${fault.layer || ""}`).join(" ");
  return all.text.toLowerCase().split(/\s+/).every((word) => words.toLowerCase().includes(word));
}

function sorted(list) {
  if (all.sort === "frame") return list;
  if (all.sort === "value") {
    const value = (i) => valueOf(frames[i], mainPlace, mainQuantity) ?? -Infinity;
    return list.sort((a, b) => value(b) - value(a) || a - b);
  }
  const rank = new Map(data.shot.worst.map((index, i) => [index, i]));
  const place = (i) => rank.get(i) ?? Infinity;
  return list.sort((a, b) => (place(a) === place(b) ? a - b : place(a) - place(b)));
}

/** Adds the next rows; the rest follows when the browser is idle. */
function addRows(most) {
  const body = document.querySelector("#all tbody");
  const begin = body.children.length;
  const { order } = all;
  const rows = order.slice(begin, begin + most).map((index) => frameRow(frames[index], index));
  body.append(...rows);
  rows.forEach((row) => thumbnailWatcher.observe(row.querySelector(".picture")));
  markLists();
  if (begin + rows.length < order.length && most !== Infinity)
    requestIdleCallback(() => { if (order === all.order) addRows(most); });
}

function drawAll() {
  const heads = ["", NOUN === "case" ? "Case" : "Frame", "Status", mainQuantity, "What", "File"];
  all.order = sorted(frames.map((_, i) => i).filter((i) => wanted(frames[i])));
  byId("all").replaceChildren(make("table", {}, make("thead", {}, make("tr", {},
    ...heads.map((text, i) => make("th", { scope: "col", className: i === 3 ? "value" : "" }, text)))),
  make("tbody")));
  byId("all-count").textContent = all.order.length === frames.length ? plural(frames.length, NOUN)
    : `${all.order.length} of ${plural(frames.length, NOUN)}`;
  addRows(50);
}

function startAll() {
  const statuses = [...new Set(frames.map((frame) => frame.status))];
  byId("filter-status").replaceChildren(make("option", { value: "" }, "every status"),
    ...statuses.map((status) => make("option", { value: status }, status)));
  for (const [id, key] of [["filter", "text"], ["filter-status", "status"], ["sort", "sort"]])
    byId(id).oninput = () => { all[key] = byId(id).value; drawAll(); };
  addEventListener("beforeprint", () => addRows(Infinity));
  drawAll();
}

function markLists() {
  for (const button of document.querySelectorAll(".worst button[data-index]")) {
    const here = Number(button.dataset.index) === viewer.index;
    if (here) button.setAttribute("aria-current", "true");
    else button.removeAttribute("aria-current");
  }
  const before = document.querySelector("tr.chosen");
  if (before) before.classList.remove("chosen");
  const row = document.querySelector(`tr[data-index="${viewer.index}"]`);
  if (row) row.classList.add("chosen");
}

function drawAbout() {
  byId("about").replaceChildren(...data.about.flatMap(([key, value]) =>
    [make("dt", {}, key), make("dd", {}, key === "Command line" ? make("code", {}, value) : value)]));
}
