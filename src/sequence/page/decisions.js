// Faults that are accepted or rejected here: kept by the browser, exported for --accept.

const KEPT_AS = `tonetool ${data.shot.id}`;
const decisions = { by: "", of: {} };

function readDecisions() {
  try {
    const kept = JSON.parse(localStorage.getItem(KEPT_AS));
    if (kept && typeof kept.of === "object") Object.assign(decisions, kept);
  } catch { /* a browser that keeps nothing */ }
}

function keepDecisions() {
  try {
    localStorage.setItem(KEPT_AS, JSON.stringify(decisions));
  } catch { /* the same */ }
}

const decisionKey = (frame, fault) => JSON.stringify([frame.frame, frame.view, fault.code, fault.layer || "",
  ...(isCase(frame) ? [frame.name, frame.method] : [])]);
const decisionOf = (frame, fault) => decisions.of[decisionKey(frame, fault)] || null;

/** The chosen fault of the frame, else all of them. */
function decidedFaults() {
  const { faults } = frames[viewer.index];
  return viewer.fault ? [faults[viewer.fault - 1]] : faults.filter((fault) => fault.severity !== "info");
}

/** What kept a frame from being checked is no fault of it that could be let pass. */
const canAccept = (frame) => classOf(frame.status) !== "error";

function decide(what) {
  const frame = frames[viewer.index];
  const faults = decidedFaults();
  if (what === "accepted" && faults.length && !canAccept(frame)) {
    byId("decided").textContent = `A frame that is ${frame.status} cannot be accepted: there is nothing to look at.`;
    return;
  }
  if (!faults.length) {
    byId("decided").textContent = "This frame has no fault to accept: limits of a comparison are those of the command line.";
    return;
  }
  const again = faults.every((fault) => (decisionOf(frame, fault) || {}).what === what);
  for (const fault of faults) {
    const key = decisionKey(frame, fault);
    if (again) delete decisions.of[key];
    else decisions.of[key] = { what, why: byId("note").value };
  }
  afterDecision();
}

function noteChanged() {
  const frame = frames[viewer.index];
  for (const fault of decidedFaults()) {
    const decision = decisionOf(frame, fault);
    if (decision) decision.why = byId("note").value;
  }
  keepDecisions();
  drawExport();
}

function afterDecision() {
  keepDecisions();
  drawFound();
  drawDecision();
  drawBadFrames();
  drawExport();
  drawWorst();
  markLists();
}

function drawDecision() {
  const frame = frames[viewer.index];
  const faults = decidedFaults();
  byId("decision").hidden = !frames.some((one) => one.faults.length);
  const states = new Set(faults.map((fault) => (decisionOf(frame, fault) || { what: "" }).what));
  for (const what of ["accepted", "rejected"]) {
    byId(what).setAttribute("aria-pressed", String(states.size === 1 && states.has(what)));
    byId(what).disabled = faults.length === 0 || (what === "accepted" && !canAccept(frame));
  }
  const first = faults.map((fault) => decisionOf(frame, fault)).find(Boolean);
  byId("note").value = first ? first.why : "";
  byId("note").disabled = faults.length === 0;
  byId("decided").textContent = faults.length ? `For ${viewer.fault ? `fault ${viewer.fault}` : plural(faults.length, "fault")}`
    + ` of ${NOUN} ${frameName(frame)}` : "";
}

/** As --accept reads it. */
function acceptedText() {
  const accepted = frames.flatMap((frame) => frame.faults.map((fault) => ({ frame, fault, decision: decisionOf(frame, fault) })))
    .filter(({ decision }) => decision && decision.what === "accepted")
    .map(({ frame, fault, decision }) => ({ frame: frame.frame, ...(frame.name ? { name: frame.name } : {}),
      ...(frame.method ? { method: frame.method } : {}), ...(frame.view ? { view: frame.view } : {}), code: fault.code,
      ...(fault.layer ? { layer: fault.layer } : {}), by: decisions.by, why: decision.why }));
  const once = [...new Map(accepted.map((one) => [JSON.stringify(one), one])).values()];
  return `${JSON.stringify({ check: data.shot.id, accepted: [...(data.shot.accepted || []), ...once] }, null, 1)}\n`;
}

function drawExport() {
  const count = Object.values(decisions.of).filter(({ what }) => what === "accepted").length;
  byId("export").textContent = `Export accepted (${count})`;
  byId("export").disabled = count === 0;
}

function exportAccepted() {
  make("a", { href: `data:application/json;charset=utf-8,${encodeURIComponent(acceptedText())}`, download: "accepted.json" }).click();
}

function startDecisions() {
  readDecisions();
  byId("by").value = decisions.by;
  byId("by").oninput = () => { decisions.by = byId("by").value; keepDecisions(); };
  byId("note").oninput = noteChanged;
  byId("accepted").onclick = () => decide("accepted");
  byId("rejected").onclick = () => decide("rejected");
  byId("export").onclick = exportAccepted;
  drawExport();
}
