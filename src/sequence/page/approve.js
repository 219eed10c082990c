// The command that approves images of a suite's cases: this page writes nothing.

const approving = new Set();

const shellQuoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;

function approveCommand() {
  const names = data.approve.cases.filter((_, i) => approving.has(i)).map((one) => one.quoted);
  const reason = byId("approve-reason").value.trim();
  const ready = names.length > 0 && reason !== "";
  return { ready, text: `${data.approve.start} ${names.join(" ") || "CASE"} --reason ${shellQuoted(reason || "WHY")}` };
}

function drawApproveCommand() {
  const { ready, text } = approveCommand();
  byId("approve-command").textContent = text;
  byId("approve-copy").disabled = !ready;
  byId("approve-copied").textContent = ready ? "" : "choose cases and say why";
}

function startApproving() {
  const cases = (data.approve || {}).cases || [];
  byId("approve").hidden = cases.length === 0;
  if (!cases.length) return;
  byId("approve-cases").replaceChildren(...cases.map((one, i) => {
    const box = make("input", { type: "checkbox", id: `approve-${i}` });
    box.onchange = () => {
      if (box.checked) approving.add(i);
      else approving.delete(i);
      drawApproveCommand();
    };
    const look = make("a", { href: "#viewer", title: "Look at it" }, one.name);
    look.onclick = (event) => { event.preventDefault(); select(one.index); };
    return make("li", {}, box, " ", make("label", { htmlFor: `approve-${i}` }, look),
      make("span", { className: "hint" }, ` ${one.status}`));
  }));
  byId("approve-reason").oninput = drawApproveCommand;
  byId("approve-copy").onclick = async () => {
    getSelection().selectAllChildren(byId("approve-command"));
    try {
      await navigator.clipboard.writeText(approveCommand().text);
      byId("approve-copied").textContent = "copied";
    } catch {
      byId("approve-copied").textContent = "selected: copy with the keyboard";
    }
  };
  drawApproveCommand();
}
