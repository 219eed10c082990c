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
      thumbnail(index), make("strong", {}, `Frame ${frameName(frame)}`), badge(frame.status),
      make("span", { className: "what" }, frame.message || verdictOf(frame))));
  }));
  const more = data.shot.worst.length - shown.length;
  const note = more > 0 ? `and ${plural(more, "more frame")}, see below`
    : shown.length === 0 ? "There is none." : "";
  if (note) byId("worst").after(make("p", { className: "hint" }, note));
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

/** As --bad-frames writes them: what failed or could not be checked, by the numbers of the tests. */
function badFrames() {
  return rangeText(frames.filter((frame) => classOf(frame.status) === "failed" || classOf(frame.status) === "error")
    .map((frame) => frame.test_frame ?? frame.frame));
}

function drawBadFrames() {
  const text = badFrames();
  byId("bad").hidden = !text || (frames.length === 1 && frames[0].frame === 0);
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

function faultRow(frame, index, fault, spots) {
  const numbers = [];
  if (typeof fault.value === "number") numbers.push(`measured ${number(fault.value)}`);
  if (typeof fault.threshold === "number") numbers.push(`allowed ${number(fault.threshold)}`);
  if (fault.position) numbers.push(`at ${fault.position.x},${fault.position.y}`);
  const place = fault.position && spots.filter((spot) =>
    spot.x === fault.position.x && spot.y === fault.position.y);
  return make("div", { className: "fault" },
    make("p", {}, make("button", { type: "button", onclick: () => { select(index); byId("viewer").focus(); } },
      `Frame ${frameName(frame)}`), " ", badge(fault.severity), " ", make("strong", {}, fault.code),
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

/** Adds the next rows; the rest follows when the browser is idle. */
function addRows(most) {
  const body = document.querySelector("#all tbody");
  const begin = body.children.length;
  const rows = frames.slice(begin, begin + most).map((frame, i) => frameRow(frame, begin + i));
  body.append(...rows);
  rows.forEach((row) => thumbnailWatcher.observe(row.querySelector(".picture")));
  markLists();
  if (begin + rows.length < frames.length && most !== Infinity) requestIdleCallback(() => addRows(most));
}

function drawAll() {
  const heads = ["", "Frame", "Status", mainQuantity, "What", "File"];
  byId("all").replaceChildren(make("table", {}, make("thead", {}, make("tr", {},
    ...heads.map((text, i) => make("th", { scope: "col", className: i === 3 ? "value" : "" }, text)))),
  make("tbody")));
  addRows(50);
  addEventListener("beforeprint", () => addRows(Infinity));
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
