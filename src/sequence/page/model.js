"use strict";
// The data of this page and the words for it. Texts become nodes, never markup.

function read(id) {
  const node = document.getElementById(id);
  return node ? JSON.parse(node.textContent) : null;
}

function withPosition(fault) {
  const at = fault.position;
  const box = Array.isArray(fault.rectangle) && fault.rectangle.length === 4 ? fault.rectangle : null;
  return { ...fault, sentence: fault.sentence || "", rectangle: box, position: at ? { x: at[0], y: at[1] } : null };
}

const data = read("result");
// Empty values are left out of the data.
const frames = data.shot.frames.map((frame) => ({ ...frame, view: frame.view || "", name: frame.name || "", method: frame.method || "",
  message: frame.message || "", reference: frame.reference || "", test: frame.test || "",
  faults: (frame.faults || []).map(withPosition),
  measurements: (frame.measurements || []).map((one) => ({ ...one, warnings: one.warnings || [],
    worst: one.worst ? { x: one.worst[0], y: one.worst[1] } : null })) }));
const pictures = new Map();

/** The images of a frame: "full", "large", "exact" or "small"; null where none were kept. */
function picturesOf(index, size) {
  const id = `${size}-${index}`;
  if (!pictures.has(id)) {
    if (pictures.size > 60) pictures.clear();
    pictures.set(id, read(id));
  }
  return pictures.get(id);
}

const byId = (id) => document.getElementById(id);

/** An element with properties and children; a string is a text. */
function make(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name in node && !name.startsWith("aria")) node[name] = value;
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

const SIGNS = { passed: "passed", measured: "measured", skipped: "info", warning: "warning", failed: "failed",
  "size mismatch": "error", missing: "missing", unreadable: "error", error: "error",
  crashed: "error", info: "info" };
const CLASSES = { passed: "passed", measured: "measured", skipped: "info", warning: "warning", failed: "failed",
  info: "info" };
const classOf = (status) => CLASSES[status] || "error";

/** The status as a shape and a word. */
function badge(status) {
  const space = "http://www.w3.org/2000/svg";
  const sign = document.createElementNS(space, "svg");
  const use = document.createElementNS(space, "use");
  use.setAttribute("href", `#sign-${SIGNS[status] || "error"}`);
  sign.setAttribute("class", "sign");
  sign.setAttribute("aria-hidden", "true");
  sign.append(use);
  return make("span", { className: `status ${classOf(status)}` }, sign, ` ${status}`);
}

const name = (text) => make("span", { className: "name" }, text);
const short = (file) => file.replace(/^.*[\\/]/, "");

/** Four digits are what a person reads; the JSON file has all of them. */
function number(value) {
  if (typeof value !== "number") return String(value);
  if (Number.isInteger(value) || !Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(3)
    : String(Number(value.toPrecision(4)));
}

/** To a tenth; never "-0.0". */
function stops(value) {
  const tenths = Math.round(value * 10);
  return (tenths > 0 ? "+" : tenths < 0 ? "\u2212" : "") + (Math.abs(tenths) / 10).toFixed(1);
}

/** Frames are told apart by number and view, cases by name and method, too. */
const isCase = (frame) => Boolean(frame.name || frame.method);
const itemName = (frame) => (isCase(frame)
  ? [frame.name, frame.method && `[${frame.method}]`, frame.frame ? `frame ${frame.frame}` : "", frame.view].filter(Boolean).join(" ")
  : String(frame.frame) + (frame.view ? ` ${frame.view}` : ""));
const frameName = (frame) => itemName(frame) + (frame.test_frame === undefined ? "" : ` (test ${frame.test_frame})`);
/** One image, which has no others beside it. */
const STILL = document.body.classList.contains("still");
const frameTitle = (frame) => STILL ? "The image" : `${isCase(frame) ? "Case" : "Frame"} ${frameName(frame)}`;
const NOUN = frames.some(isCase) ? "case" : "frame";
const capital = (word) => word[0].toUpperCase() + word.slice(1);
const entries = (list) => (Array.isArray(list) ? list : Object.entries(list || {}));

/** Every command that measured, in the order of the command line. */
const measures = [];
for (const frame of frames) {
  frame.measurements.forEach((measurement, place) => {
    if (!measures[place]) measures[place] = measurement.command;
  });
}
const measurementOf = (frame, place) => frame.measurements[place] || null;

function quantitiesOf(place) {
  const found = new Set();
  for (const frame of frames) {
    const measurement = measurementOf(frame, place);
    if (measurement) entries(measurement.quantities).forEach(([key]) => found.add(key));
  }
  return [...found];
}

function valueOf(frame, place, quantity) {
  if (place < 0) return frame.faults.length;
  const measurement = measurementOf(frame, place);
  if (!measurement) return null;
  const entry = entries(measurement.quantities).find(([key]) => key === quantity);
  if (entry && typeof entry[1] === "number") return entry[1];
  const limit = thresholdsOf(measurement).find((one) => one.quantity === quantity);
  return limit && typeof limit.value === "number" ? limit.value : null;
}

function thresholdsOf(measurement) {
  return measurement.thresholds || [];
}

function exceeds(limit, bound) {
  return typeof bound === "number" && (limit.higher_is_better ? limit.value < bound : limit.value > bound);
}

/** The threshold that gave the measurement its status, else the first. */
function decidingOf(measurement) {
  const all = thresholdsOf(measurement);
  return all.find((one) => exceeds(one, one.fail)) || all.find((one) => exceeds(one, one.warn)) || all[0] || null;
}

/** The first threshold of the command at that place of the command line, in any frame. */
function thresholdOf(place) {
  for (const frame of frames) {
    const measurement = place >= 0 && measurementOf(frame, place);
    if (measurement && thresholdsOf(measurement).length) return thresholdsOf(measurement)[0];
  }
  return null;
}

const mainPlace = Math.max(0, measures.findIndex((_, place) => thresholdOf(place)));

/** Whether the command's result is one of three verdicts; its limits are no quantities of a curve. */
const hasVerdict = (place) => frames.some((frame) => (measurementOf(frame, place) || {}).verdict);

const mainQuantity = (!hasVerdict(mainPlace) && (thresholdOf(mainPlace) || {}).quantity) || quantitiesOf(mainPlace)[0] || "";

/** "p99 0.4512 > 0.05" */
function verdictOf(frame) {
  const measurement = measurementOf(frame, mainPlace) || frame.measurements[0];
  if (!measurement) return "";
  if (measurement.verdict) return measurement.sentence;
  const limit = decidingOf(measurement);
  if (limit) {
    const bound = exceeds(limit, limit.warn) && !exceeds(limit, limit.fail) ? limit.warn : limit.fail ?? limit.warn;
    if (typeof bound !== "number") return `${limit.quantity} ${number(limit.value)}`;
    const sign = limit.value > bound ? ">" : limit.value < bound ? "<" : "=";
    return `${limit.quantity} ${number(limit.value)} ${sign} ${number(bound)}`;
  }
  const first = entries(measurement.quantities)[0];
  return first ? `${first[0]} ${number(first[1])}` : "";
}

/** What is wrong with the frame: its worst fault, and what a comparison says beside that. */
function whyOf(frame) {
  const fault = frame.status === "failed" && frame.faults.find(({ severity }) => severity === "error");
  const message = frame.message || verdictOf(frame);
  if (!fault || fault.sentence === message) return message;
  return `${fault.code}: ${fault.sentence}${message ? `; ${message}` : ""}`;
}

/** What a quantity means, for those who do not know it. */
function meaningOf(quantity) {
  const percent = /^p(\d+(\.\d+)?)$/.exec(quantity);
  if (percent) return `${quantity}: ${percent[1]} % of the pixels have no larger error.`;
  const of = { mean: "The mean error of all pixels.", max: "The largest error of a pixel." };
  return of[quantity] || "";
}

function plural(count, word) {
  return `${count} ${word}${count === 1 ? "" : "s"}`;
}
