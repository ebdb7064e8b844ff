// The page of `weft report`: draws itself from the JSON in it (app/commands/report_command.cpp says what that holds), with nothing from elsewhere.
// Of one or two states, a graph and what it is compared with, one is shown at a time. `weft test` has a page of its own.
"use strict";
const report = JSON.parse(document.getElementById("report").textContent);
const COLUMN = 56, ROW = 20;

// ---- elements ----

function add(parent, tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "class") element.className = value;
    else if (key.startsWith("on")) element[key] = value;
    else if (value !== undefined && value !== false) element.setAttribute(key, value);
  }
  element.append(...children);
  if (parent) parent.append(element);
  return element;
}
function addSvg(parent, tag, attributes, title) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (title) element.append(Object.assign(document.createElementNS("http://www.w3.org/2000/svg", "title"), { textContent: title }));
  parent.append(element);
  return element;
}
const mebibytes = (bytes) => (bytes < 1048576 ? (bytes / 1024).toFixed(1) + " KiB" : (bytes / 1048576).toFixed(1) + " MiB");
const counted = (n, word) => `${n} ${word}${n === 1 ? "" : word.endsWith("s") ? "es" : "s"}`;
const inOrder = (list, key) => [...list].sort((a, b) => key(a) - key(b));

function copyButton(parent, text, label) {
  const button = add(parent, "button", { class: "chip copy", "aria-label": "copy " + label, onclick: async () => {
    try { await navigator.clipboard.writeText(text); } catch { const area = add(document.body, "textarea"); area.value = text; area.select(); document.execCommand("copy"); area.remove(); }
    button.textContent = "copied";
    setTimeout(() => { button.textContent = "copy"; }, 1200);
  } }, "copy");
}

// ---- what is known of a state, found once ----

const withoutIndex = (name) => name.replace(/\[[^\]]*\]$/, "");
const effectOf = (name) => (name.includes(".") ? name.slice(0, name.lastIndexOf(".")) : "");
const lastWord = (name) => name.slice(effectOf(name).length).replace(/^\./, "");

function indexState(state) {
  const steps = state.plan.steps;
  state.stepOf = new Map(steps.map((step, t) => [step.pass, t]));
  state.resourceOf = new Map(state.plan.resources.map((resource) => [resource.name, resource]));
  // Rows: resources that a step touches, those of one storage together, in the order in which they are first touched.
  const touched = state.plan.resources.filter((resource) => resource.steps);
  const first = new Map();
  for (const resource of touched) {
    const key = resource.storage ?? resource.name;
    first.set(key, Math.min(first.get(key) ?? Infinity, resource.steps[0]));
    resource.place = () => first.get(key);
  }
  state.rows = inOrder(inOrder(touched, (resource) => resource.steps[0]), (resource) => resource.place());
  const lying = new Map();
  for (const resource of touched) if (resource.storage !== undefined) lying.set(resource.storage, (lying.get(resource.storage) ?? 0) + 1);
  state.isShared = (resource) => (lying.get(resource.storage) ?? 0) > 1;
  // Groups of a step, outermost first: its effects, and the pass itself where it is repeated. A folded group is one column; those are
  // folded at first that are repeats or do not run in every frame.
  const times = new Map();
  for (const step of steps) times.set(withoutIndex(step.pass), (times.get(withoutIndex(step.pass)) ?? 0) + 1);
  state.groupsOf = (t) => {
    const name = withoutIndex(steps[t].pass), words = name.split(".");
    return words.slice(0, times.get(name) > 1 ? words.length : -1).map((_, i) => words.slice(0, i + 1).join("."));
  };
  state.folded = new Set([...times.keys()].filter((name) => times.get(name) > 1));
  const always = new Set(steps.flatMap((step, t) => (step.update === "always" ? state.groupsOf(t) : [])));
  steps.forEach((_, t) => { for (const group of state.groupsOf(t)) if (!always.has(group)) state.folded.add(group); });
  state.columnsOf = () => {
    const columns = [];
    steps.forEach((step, t) => {
      const groups = state.groupsOf(t), at = groups.findIndex((group) => state.folded.has(group)), fold = groups[at], last = columns.at(-1);
      if (fold && last?.fold === fold) last.steps.push(t);
      else columns.push({ fold, groups: fold ? groups.slice(0, at + 1) : groups, name: fold ?? step.pass, steps: [t] });
    });
    return columns;
  };
  // Rows that are not within one folded effect.
  state.rowsOf = (columns) => {
    const columnsOfName = new Map();
    for (const column of columns) for (const t of column.steps) for (const use of steps[t].uses) columnsOfName.set(use.resource, (columnsOfName.get(use.resource) ?? new Set()).add(column));
    return state.rows.filter((resource) => { const of = [...(columnsOfName.get(resource.name) ?? [])]; return of.length !== 1 || of[0].steps.length === 1 || times.has(of[0].fold) || resource.name === state.plan.present; });
  };
  // Who made what a step reads, and who reads what it makes: whose ranges of a resource touch, the last before and those before the next.
  const overlaps = (a, b) => a.resource === b.resource && (a.range === b.range || !a.range.includes(".mip[", a.resource.length) || !b.range.includes(".mip[", b.resource.length));
  state.sourcesOf = (t) => steps[t].uses.filter((use) => use.access !== "write").map((use) => {
    for (let s = t - 1; s >= 0; --s) if (steps[s].uses.some((made) => made.access !== "read" && overlaps(made, use))) return { use, step: s };
    return { use, step: undefined };
  });
  state.readersOf = (t) => {
    const found = [];
    steps.forEach((step, s) => { if (s > t) for (const source of state.sourcesOf(s)) if (source.step === t) found.push({ use: source.use, step: s }); });
    return found;
  };
}
let state, selected = 0, selectedResource;

// ---- top ----

function drawTop() {
  const top = add(null, "header"), plan = state.plan, bad = state.messages.filter((m) => m.severity === "error").length, warned = state.messages.filter((m) => m.severity === "warning").length;
  add(top, "h1", {}, state.title);
  if (report.states.length > 1)
    report.states.forEach((each, i) => add(top, "button", { class: "chip", "aria-pressed": String(each === state), onclick: () => { const at = state.plan.steps[selected]?.pass; state = each; selected = state.stepOf.get(at) ?? Math.min(selected, state.plan.steps.length - 1); draw(); } }, i ? "after" : "before"));
  add(top, "span", { class: "quiet" }, state.facts.join(" · "));
  const nan = state.outputs.flat().reduce((sum, output) => sum + (output.nan ?? 0) + (output.infinite ?? 0), 0);
  add(top, "span", {}, `${plan.steps.length} run · ${plan.culled.length} culled · ${plan.disabled.length} off · ${mebibytes(plan.bytes.allocated)} (${mebibytes(plan.bytes.declared)} unshared)` +
    (state.times ? ` · ${state.times.reduce((a, b) => a + b, 0).toFixed(1)} ms` : ""));
  for (const [n, word] of [[bad, "error"], [warned, "warning"]]) add(top, "button", { class: n ? "chip bad" : "chip quiet", onclick: () => showTab("Messages") }, counted(n, word));
  add(top, "button", { class: nan ? "chip bad" : "chip quiet", onclick: () => select(state.outputs.findIndex((outputs) => outputs.some((output) => output.nan || output.infinite))) }, `${nan} NaN`);
  add(top, "code", { class: "command", title: report.command }, report.command);
  copyButton(top, report.command, "the command");
  drawSearch(top);
  return top;
}

// ---- search ----

function searchable() {
  const found = [];
  state.plan.steps.forEach((step, t) => found.push({ text: step.pass, kind: "pass", go: () => select(t) }));
  for (const pass of [...state.plan.culled, ...state.plan.disabled]) found.push({ text: pass.pass, kind: "does not run: " + pass.why, go: () => showTab("Messages") });
  for (const resource of state.rows) found.push({ text: resource.name, kind: resource.shape, go: () => selectResource(resource) });
  for (const parameter of state.parameters) {
    const user = state.passes.findIndex((pass) => pass.parameters.some((each) => each.path === parameter.name));
    found.push({ text: parameter.name, kind: `parameter = ${parameter.value}`, go: () => user >= 0 && select(user) });
  }
  for (const file of new Set(state.passes.flatMap((pass) => [...pass.shader, pass.place.split(":")[0]])))
    found.push({ text: file, kind: "file", go: () => select(state.passes.findIndex((pass) => pass.shader.includes(file) || pass.place.startsWith(file + ":"))) });
  return found;
}

function drawSearch(parent) {
  const box = add(parent, "div", { class: "search" });
  const input = add(box, "input", { type: "search", placeholder: "search  /", role: "combobox", "aria-label": "search passes, resources, parameters and files", "aria-expanded": "false", "aria-controls": "found", "aria-autocomplete": "list" });
  const list = add(box, "div", { class: "found", role: "listbox", id: "found", "aria-label": "found", hidden: "" });
  let hits = [], at = 0;
  const show = () => {
    const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
    hits = words.length ? searchable().filter((each) => words.every((word) => each.text.toLowerCase().includes(word))).slice(0, 40) : [];
    at = Math.min(at, Math.max(hits.length - 1, 0));
    list.replaceChildren();
    hits.forEach((hit, i) => add(list, "div", { role: "option", id: "hit" + i, "aria-selected": String(i === at), onmousedown: (event) => { event.preventDefault(); choose(i); } }, hit.text, add(null, "span", { class: "quiet" }, "  " + hit.kind)));
    list.hidden = !hits.length;
    input.setAttribute("aria-expanded", String(hits.length > 0));
    if (hits.length) input.setAttribute("aria-activedescendant", "hit" + at); else input.removeAttribute("aria-activedescendant");
  };
  const choose = (i) => { const hit = hits[i]; input.value = ""; show(); if (hit) hit.go(); };
  input.oninput = () => { at = 0; show(); };
  input.onblur = () => { list.hidden = true; };
  input.onkeydown = (event) => {
    if (event.key === "ArrowDown" || event.key === "ArrowUp") { at = (at + (event.key === "ArrowDown" ? 1 : hits.length - 1)) % Math.max(hits.length, 1); show(); event.preventDefault(); }
    else if (event.key === "Enter") choose(at);
    else if (event.key === "Escape") { input.value = ""; show(); input.blur(); }
    event.stopPropagation();
  };
}

// ---- left: the picture and the effects ----

const timeOf = (t) => state.times[t];
const bytesOf = (t) => [...new Set(state.plan.steps[t].uses.filter((use) => use.access !== "read").map((use) => use.resource))].reduce((sum, name) => sum + (state.resourceOf.get(name)?.bytes ?? 0), 0);

function drawTree() {
  const side = add(null, "nav", { "aria-label": "effects" });
  if (state.picture) add(side, "img", { class: "wide", src: state.picture.png, alt: "the presented picture" });
  const root = { name: "", children: new Map(), steps: [] };
  state.plan.steps.forEach((step, t) => {
    let node = root;
    for (const word of effectOf(step.pass).split(".").filter(Boolean)) {
      if (!node.children.has(word)) node.children.set(word, { name: (node.name && node.name + ".") + word, children: new Map(), steps: [] });
      node = node.children.get(word);
    }
    node.steps.push(t);
  });
  const all = (node) => [...node.steps, ...[...node.children.values()].flatMap(all)];
  const bars = state.times ? [["time", timeOf, "part"], ["bytes written", bytesOf, "part bytes"]] : [["bytes written", bytesOf, "part bytes"]];
  const weigh = (steps, weight) => steps.reduce((sum, t) => sum + weight(t), 0), whole = bars.map(([, weight]) => weigh(all(root), weight) || 1);
  const drawNode = (parent, node) => {
    for (const child of node.children.values()) {
      const steps = all(child), kept = steps.every((t) => state.plan.steps[t].update !== "always"), details = add(parent, "details", { open: node === root && !kept });
      const line = add(add(details, "summary"), "span", { class: "row", style: "display: inline-flex; width: calc(100% - 1.2em)" });
      add(line, "span", {}, `${lastWord(child.name)} ${steps.length}`, kept ? add(null, "span", { class: "quiet" }, " kept") : "");
      const both = add(line, "span", { class: "parts" });
      bars.forEach(([word, weight, look], i) => { const share = weigh(steps, weight) / whole[i]; add(both, "span", { class: look, style: `width: ${Math.round(90 * share)}px`, title: `${Math.round(100 * share)} % of the ${word}` }); });
      drawNode(details, child);
    }
    const names = new Map();
    for (const t of node.steps) { const name = withoutIndex(state.plan.steps[t].pass); names.set(name, [...(names.get(name) ?? []), t]); }
    for (const [name, steps] of names) add(parent, "button", { class: "line", "data-step": steps.join(" "), onclick: () => select(steps[0]) }, lastWord(name) + (steps.length > 1 ? ` ×${steps.length}` : ""));
  };
  const tree = add(side, "div", { class: "tree" });
  drawNode(tree, root);
  for (const [list, word] of [[state.plan.culled, "culled"], [state.plan.disabled, "off"]]) {
    if (!list.length) continue;
    const details = add(tree, "details");
    add(details, "summary", {}, `${list.length} ${word}`);
    for (const pass of list) add(details, "p", {}, pass.pass, " ", add(null, "span", { class: "quiet" }, pass.why.replace(/^(culled|enabled): /, "")));
  }
  return side;
}

// ---- middle: the matrix ----

// What a state has that the other has not: a pass that came or went, or whose outputs are others.
function markOf(steps) {
  const twin = report.states.find((each) => each !== state);
  if (!twin) return "";
  const marks = steps.map((t) => {
    const s = twin.stepOf.get(state.plan.steps[t].pass);
    return s === undefined ? (state === report.states[0] ? "−" : "+") : JSON.stringify(state.outputs[t]) === JSON.stringify(twin.outputs[s]) ? "" : "≠";
  });
  return marks.find((mark) => mark) ?? "";
}
const MARKS = { "+": "came", "−": "went", "≠": "writes another picture" };

function drawMatrix() {
  const matrix = add(null, "section", { class: "matrix", "aria-label": "steps and resources", tabindex: "0" }), columns = state.columnsOf(), rows = state.rowsOf(columns);
  Object.assign(state, { columns, shown: rows });
  const key = (color, word) => [add(null, "span", { class: "key", style: `background: var(${color})` }), ` ${word} `];
  add(matrix, "div", { class: "corner" }, add(null, "p", { class: "quiet" }, ...key("--read", "read"), ...key("--write", "write"), "(both: modify)"), add(null, "p", { class: "quiet" }, ...key("--life", "alive"), ...key("--kept", "kept"), ...key("--barrier", "barrier")),
    add(null, "p", { class: "quiet" }, "← frame before, ▌ shared storage"), add(null, "p", { class: "quiet" }, "arrows walk, Enter folds, / searches"));
  const heads = add(matrix, "div", { class: "heads" }), deepest = Math.min(Math.max(0, ...columns.map((column) => column.groups.length)), 4);
  for (let depth = 0; depth < deepest; ++depth) {
    const line = add(heads, "div", { class: "columns" });
    for (let c = 0, end; c < columns.length; c = end) {
      const group = columns[c].groups[depth];
      for (end = c + 1; end < columns.length && columns[end].groups[depth] === group;) ++end;
      const folded = state.folded.has(group), style = `width: ${(end - c) * COLUMN}px`;
      if (group) add(line, "button", { class: "group", style, tabindex: "-1", title: group, "aria-expanded": String(!folded), onclick: () => toggle(group) }, `${folded ? "▸" : "▾"} ${lastWord(group)}`);
      else add(line, "span", { class: "group", style });
    }
  }
  const line = add(heads, "div", { class: "columns" }), weight = state.times ? timeOf : bytesOf, weigh = (column) => column.steps.reduce((sum, t) => sum + weight(t), 0), most = Math.max(...columns.map(weigh)) || 1;
  columns.forEach((column, c) => {
    const last = column.steps.at(-1), output = state.outputs[last][0], mark = markOf(column.steps);
    const head = add(line, "button", { class: "column", "data-step": column.steps.join(" "), tabindex: "-1", title: `${column.name}${mark && "\n" + MARKS[mark]}\n${state.plan.steps[last].why}`, onclick: () => select(last) });
    if (output) add(head, "img", { src: output.png, alt: "" }); else add(head, "span", { class: "none" });
    add(head, "span", { class: state.times ? "bar" : "bar bytes", style: `width: ${Math.round((COLUMN - 4) * weigh(column) / most)}px` });
    add(head, "span", { class: "name" }, mark && add(null, "b", {}, mark + " "), lastWord(column.name) + (column.steps.length > 1 ? ` ×${column.steps.length}` : ""));
    column.x = c * COLUMN;
  });
  const names = add(matrix, "div", { class: "rows" });
  for (const resource of rows) add(names, "button", { class: state.isShared(resource) ? "shared" : "", tabindex: "-1", title: `${resource.name}\n${resource.shape}\n${resource.why}`, onclick: () => selectResource(resource) },
    add(null, "span", {}, resource.name), add(null, "span", { class: "quiet" }, `${resource.format ?? (resource.imported ? "import" : "buffer")} ${resource.size ? resource.size.join("x") : ""} ${resource.bytes ? mebibytes(resource.bytes) : ""}`));
  const width = columns.length * COLUMN, height = Math.max(rows.length, 1) * ROW;
  const cells = addSvg(matrix, "svg", { class: "cells", width, height, role: "img", "aria-label": "which step reads and writes which resource; the panel at the right says it in words" });
  const columnOfStep = [], rowOf = new Map(rows.map((resource, r) => [resource.name, r]));
  columns.forEach((column, c) => column.steps.forEach((t) => { columnOfStep[t] = c; }));
  state.columnMark = addSvg(cells, "rect", { class: "mark", x: 0, y: 0, width: COLUMN, height });
  state.rowMark = addSvg(cells, "rect", { class: "mark", x: 0, y: -ROW, width, height: ROW });
  rows.forEach((resource, r) => {
    const from = columnOfStep[Math.min(resource.steps[0], columnOfStep.length - 1)], to = columnOfStep[Math.min(resource.steps[1], columnOfStep.length - 1)];
    const kept = resource.persistent || resource.history;
    if (kept) addSvg(cells, "rect", { class: "kept", x: 0, y: r * ROW + 7, width, height: 6 });
    if (!resource.imported) addSvg(cells, "rect", { class: kept ? "kept" : "life", x: from * COLUMN, y: r * ROW + 5, width: (to - from + 1) * COLUMN, height: 10 });
    addSvg(cells, "line", { class: "grid", x1: 0, x2: width, y1: (r + 1) * ROW, y2: (r + 1) * ROW });
  });
  columns.forEach((column, c) => {
    const uses = column.steps.flatMap((t) => state.plan.steps[t].uses), why = column.steps.flatMap((t) => [...(state.plan.steps[t].why_barriers ?? []), ...(state.plan.steps[t].why_barriers_after_clears ?? [])]);
    for (const name of new Set(uses.map((use) => use.resource))) {
      const r = rowOf.get(name), of = uses.filter((use) => use.resource === name);
      if (r === undefined) continue;
      const reads = of.some((use) => use.access !== "write" && !use.history), writes = of.some((use) => use.access !== "read"), old = of.some((use) => use.history);
      const title = of.slice(0, 6).map((use) => `${use.access} ${use.range} as ${use.kind}` + (use.slot ? ` (${use.slot})` : "")).join("\n"), x = c * COLUMN + 12, y = r * ROW + 3;
      const cell = addSvg(cells, "g", {}, title);
      if (reads) addSvg(cell, "rect", { class: "read", x, y, width: writes ? 16 : 32, height: 14, rx: 2 });
      if (writes) addSvg(cell, "rect", { class: "write", x: reads ? x + 16 : x, y, width: reads ? 16 : 32, height: 14, rx: 2 });
      if (old) addSvg(cell, "path", { class: "history", d: `M${x - 1} ${y + 7}h-9m4 -4l-4 4l4 4` });
    }
    if (why.length) addSvg(cells, "line", { class: "tick", x1: c * COLUMN + 1, x2: c * COLUMN + 1, y1: 0, y2: height }, why.join("\n"));
  });
  // What is not in the row or the column under the pointer is dimmed.
  const dim = addSvg(cells, "path", { class: "dim", d: "" });
  const cellAt = (event) => { const at = cells.getBoundingClientRect(); return [Math.floor((event.clientX - at.left) / COLUMN), Math.floor((event.clientY - at.top) / ROW)]; };
  cells.onmousemove = (event) => {
    const [c, r] = cellAt(event), x = c * COLUMN, y = r * ROW;
    dim.setAttribute("d", `M0 0H${x}V${y}H0zM${x + COLUMN} 0H${width}V${y}H${x + COLUMN}zM0 ${y + ROW}H${x}V${height}H0zM${x + COLUMN} ${y + ROW}H${width}V${height}H${x + COLUMN}z`);
  };
  cells.onmouseleave = () => dim.setAttribute("d", "");
  cells.onclick = (event) => {
    const [c, r] = cellAt(event);
    if (columns[c]) select(columns[c].steps.at(-1));
    if (event.shiftKey && rows[r]) selectResource(rows[r]);
  };
  matrix.onkeydown = (event) => {
    if (event.target !== matrix) return;
    const c = columnOfStep[selected] ?? 0, step = { ArrowRight: 1, ArrowLeft: -1 }[event.key], row = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step && columns[c + step]) select(columns[c + step].steps.at(-1));
    if (row) selectResource(rows[Math.min(Math.max(rows.indexOf(selectedResource) + row, 0), rows.length - 1)]);
    if (event.key === "Enter" && columns[c]?.groups.length) toggle(columns[c].groups.at(-1));
    if (step || row || event.key === "Enter") event.preventDefault();
  };
  return matrix;
}

// Folds a group of steps, or opens it.
function toggle(group) {
  state.folded.has(group) ? state.folded.delete(group) : state.folded.add(group);
  const old = document.querySelector(".matrix"), hadFocus = old.contains(document.activeElement), { scrollLeft, scrollTop } = old, fresh = drawMatrix();
  old.replaceWith(fresh);
  fresh.scrollTo(scrollLeft, scrollTop);
  if (hadFocus) fresh.focus();
  mark();
}

// ---- below: flow, memory, difference, messages ----

let tab = "Flow";
const TABS = { Flow: drawFlow, Memory: drawMemory, Difference: drawDifference, Messages: drawMessages };

function drawLower() {
  const lower = add(null, "section", { class: "lower", "aria-label": "more views" }), tabs = add(lower, "div", { class: "tabs", role: "tablist" });
  const names = Object.keys(TABS).filter((name) => (name !== "Difference" || report.states.length > 1));
  if (!names.includes(tab)) tab = names[0];
  names.forEach((name, i) => add(tabs, "button", { role: "tab", id: "tab" + name, "aria-selected": String(name === tab), "aria-controls": "tabpanel", tabindex: name === tab ? "0" : "-1", onclick: () => showTab(name),
    onkeydown: (event) => { const to = names[(i + ({ ArrowRight: 1, ArrowLeft: -1 }[event.key] ?? 0) + names.length) % names.length]; if (to !== name) { showTab(to); document.getElementById("tab" + to).focus(); } } }, name));
  TABS[tab](add(lower, "div", { role: "tabpanel", id: "tabpanel", "aria-labelledby": "tab" + tab, tabindex: "0" }));
  return lower;
}
function showTab(name) { tab = name; document.querySelector(".lower").replaceWith(drawLower()); markFlow(); }

function drawFlow(panel) {
  const [whole, effects] = state.flow, open = wholeFlow || !effects;
  if (!whole) { add(panel, "p", {}, "Graphviz lays out the flow. It was not there when this page was written."); return; }
  panel.classList.add("flow");
  const show = (yes, name) => { wholeFlow = yes; showTab("Flow"); if (name) select(state.plan.steps.findIndex((step) => step.pass.startsWith(name + "."))); };
  if (effects) add(panel, "button", { class: "chip", onclick: () => show(!open) }, open ? "▾ fold the effects" : "▸ open the effects");
  const svg = add(panel, "div", {});
  svg.innerHTML = open ? whole : effects;
  drawSvg(panel, panel.querySelector("svg"), open, show);
}
let wholeFlow = false;
function drawSvg(panel, svg, open, show) {
  svg.setAttribute("width", svg.viewBox.baseVal.width);
  svg.removeAttribute("height");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", "passes and versions of resources, left to right");
  for (const node of panel.querySelectorAll("g.node")) {
    const t = state.stepOf.get(node.id) ?? state.plan.steps.findIndex((step) => withoutIndex(step.pass) === node.id);
    const effect = t < 0 && state.plan.steps.some((step) => step.pass.startsWith(node.id + "."));
    if (t >= 0 || effect) { node.style.cursor = "pointer"; node.onclick = () => (effect ? show(true, node.id) : select(t)); }
  }
  if (open) for (const cluster of panel.querySelectorAll("g.cluster > text")) { cluster.style.cursor = "pointer"; cluster.onclick = () => show(false); }
  markFlow();
}
function markFlow() {
  const name = state.plan.steps[selected]?.pass ?? "";
  for (const node of document.querySelectorAll(".flow g.node")) {
    const chosen = node.id === withoutIndex(name) || (!wholeFlow && node.id === name.split(".")[0]);
    node.classList.toggle("chosen", chosen);
    if (chosen) reveal(document.querySelector("[role=tabpanel]"), node);
  }
}

function drawMemory(panel) {
  const steps = state.plan.steps.length, wide = Math.max(500, Math.min(1600, steps * 18)), unit = wide / (steps + 1), left = 190;
  const svg = addSvg(panel, "svg", { class: "cells", width: left + wide, height: state.plan.storages.length * 18 + 4, role: "img", "aria-label": "each texture and the steps in which resources lie in it" });
  state.plan.storages.forEach((storage, s) => {
    const text = addSvg(svg, "text", { x: 0, y: s * 18 + 13, "font-size": 11, fill: "currentColor" });
    text.textContent = `${storage.format} ${storage.width}x${storage.height} ${mebibytes(storage.bytes)}`;
    for (const resource of state.plan.resources.filter((each) => each.storage === s && each.steps)) {
      const [from, to] = storage.persistent ? [0, steps] : resource.steps;
      addSvg(svg, "rect", { class: storage.persistent ? "kept" : "life", x: left + from * unit, y: s * 18 + 2, width: Math.max((to - from + 1) * unit - 2, 3), height: 14, rx: 2 }, `${resource.name}\n${resource.why}`);
      const name = addSvg(svg, "text", { x: left + from * unit + 3, y: s * 18 + 13, "font-size": 10, fill: "currentColor" });
      name.textContent = resource.name;
    }
  });
  add(panel, "p", {}, `${mebibytes(state.plan.bytes.allocated)} in ${counted(state.plan.storages.length, "texture")}; without sharing ${mebibytes(state.plan.bytes.declared)}; no order of the passes needs less than ${mebibytes(state.plan.bytes.lower_bound)}.`);
}

function wipe(parent, before, after, word) {
  const box = add(parent, "div", { class: "wipe" });
  add(box, "img", { class: "wide", src: before, alt: word + " before" });
  const over = add(box, "img", { class: "wide", src: after, alt: word + " after" });
  const clip = (share) => { over.style.clipPath = `inset(0 0 0 ${share}%)`; };
  add(box, "input", { type: "range", min: "0", max: "100", value: "50", "aria-label": "wipe between before and after", oninput: (event) => clip(event.target.value) });
  clip(50);
  return box;
}

function drawDifference(panel) {
  const [before, after] = report.states, left = add(panel, "div"), right = add(panel, "div");
  panel.classList.add("difference");
  const pairs = [["the picture", before.picture, after.picture]];
  after.plan.steps.forEach((step, t) => { const s = before.stepOf.get(step.pass), [a, b] = [before.outputs[s]?.[0], after.outputs[t][0]]; if (a && b && JSON.stringify(a) !== JSON.stringify(b)) pairs.push([step.pass, a, b]); });
  const choice = add(left, "select", { "aria-label": "what to compare", onchange: () => show(pairs[choice.selectedIndex]) });
  for (const [name] of pairs) add(choice, "option", {}, name);
  const show = ([name, a, b]) => { left.querySelector(".wipe")?.remove(); if (a?.png && b?.png) wipe(left, a.png, b.png, name); };
  show(pairs[0]);
  if (report.pictures) add(right, "p", {}, report.pictures);
  if (pairs.length > 1) add(right, "p", {}, "first pass that writes another picture: ", add(null, "button", { class: "chip", onclick: () => { select(state.stepOf.get(pairs[1][0])); choice.selectedIndex = 1; show(pairs[1]); } }, pairs[1][0]));
  add(right, "pre", {}, report.difference.length ? report.difference.join("\n") : "the plans do the same");
}

function drawMessages(panel) {
  for (const message of state.messages) {
    add(panel, "p", { class: message.severity === "error" ? "bad" : "" }, `${message.file ? `${message.file}:${message.line ?? 0}:${message.column ?? 0}: ` : ""}${message.severity}[${message.code}]: ${message.message}`);
    for (const key of ["expected", "found", "fix"]) if (message[key]) add(panel, "p", { class: "quiet" }, `    ${key}: ${message[key]}`);
  }
  if (!state.messages.length) add(panel, "p", { class: "good" }, "no errors and no warnings");
  for (const pass of [...state.plan.culled, ...state.plan.disabled]) add(panel, "p", { class: "quiet" }, `${pass.pass}: ${pass.why}`);
}

// ---- right: the selected pass or resource ----

function link(parent, t, rest = "") {
  const item = add(parent, "li");
  add(item, "button", { class: "chip", onclick: () => select(t) }, state.plan.steps[t].pass);
  item.append(" " + rest);
}

function valuesOf(grid) {
  const { buffer } = Uint8Array.from(atob(grid.values), (c) => c.charCodeAt(0));
  return Array.from(new Float32Array(buffer));
}

function drawOutput(parent, outputs) {
  const box = add(parent, "div"), show = (output) => {
    box.replaceChildren();
    const image = add(box, "img", { class: "wide", src: output.png, alt: output.name });
    if (outputs.length > 1) {
      const strip = add(box, "div", { class: "strip" });
      for (const each of outputs) add(strip, "button", { "aria-pressed": String(each === output), "aria-label": each.name, title: each.name, onclick: () => show(each) }, add(null, "img", { src: each.png, alt: "" }));
    }
    add(box, "p", { class: "quiet" }, `${output.name}, ${output.size.join("x")}` + (output.shown ? `, shown from ${output.shown.join(" to ")}` : ""));
    if (output.low) {
      const table = add(box, "table");
      for (const [word, values] of [["min", output.low], ["max", output.high], ["mean", output.mean]]) { const row = add(table, "tr"); add(row, "th", { scope: "row" }, word); for (const value of values) add(row, "td", { class: "number" }, String(+value.toPrecision(6))); }
      if (output.nan || output.infinite) add(box, "p", { class: "bad" }, `${output.nan} NaN, ${output.infinite} infinite`);
    }
    if (!output.grid) return;
    const loupe = add(box, "div", { class: "loupe" }), zoom = add(loupe, "canvas", { width: 9, height: 9, role: "img", "aria-label": "loupe" }), text = add(loupe, "code", {}, "point at the picture: its texels");
    const values = valuesOf(output.grid), { width, height, channels, every } = output.grid, paint = zoom.getContext("2d");
    image.onmousemove = (event) => {
      const at = image.getBoundingClientRect(), u = (event.clientX - at.left) / at.width, v = (event.clientY - at.top) / at.height;
      const x = Math.min(Math.max(Math.floor(u * output.size[0] / every), 0), width - 1), y = Math.min(Math.max(Math.floor((1 - v) * output.size[1] / every), 0), height - 1);
      paint.imageSmoothingEnabled = false;
      paint.clearRect(0, 0, 9, 9);
      paint.drawImage(image, Math.floor(u * image.naturalWidth) - 4, Math.floor(v * image.naturalHeight) - 4, 9, 9, 0, 0, 9, 9);
      text.textContent = `(${x * every}, ${y * every}): ${values.slice((y * width + x) * channels, (y * width + x + 1) * channels).map((value) => +value.toPrecision(7)).join(", ")}`;
    };
  };
  show(outputs[0]);
}

function editorTemplate() { try { return localStorage.getItem("weft editor") ?? ""; } catch { return ""; } }

function drawSelected() {
  const side = add(null, "aside", { "aria-label": "selected", "aria-live": "polite" });
  if (selectedResource) {
    const resource = selectedResource;
    add(side, "h2", {}, resource.name);
    add(side, "p", {}, resource.shape);
    add(side, "p", { class: "quiet" }, resource.why);
    for (const [word, accesses] of [["written by", ["write", "modify"]], ["read by", ["read"]]]) {
      add(side, "h3", {}, word);
      const list = add(side, "ul");
      state.plan.steps.forEach((step, t) => { for (const use of step.uses) if (use.resource === resource.name && accesses.includes(use.access)) link(list, t, `${use.access} ${use.range.slice(resource.name.length)} as ${use.kind}`); });
    }
    return side;
  }
  const step = state.plan.steps[selected], pass = state.passes[selected], outputs = state.outputs[selected];
  if (!step) { add(side, "p", {}, "no pass runs"); return side; }
  add(side, "h2", {}, step.pass);
  add(side, "p", { class: "quiet" }, `step ${selected}, ${pass.type}, ${step.update}` + (step.framebuffer ? `, ${step.framebuffer.size.join("x")}` : "") + (state.times ? `, ${state.times[selected].toFixed(3)} ms` : ""));
  if (outputs.length) drawOutput(side, outputs);
  add(side, "h3", {}, "why it runs, and why here");
  add(side, "p", {}, step.why.replace(/^runs: /, ""));
  if (step.why_here) add(side, "p", {}, step.why_here);
  const sources = state.sourcesOf(selected), readers = state.readersOf(selected);
  if (sources.length) { add(side, "h3", {}, "reads"); const list = add(side, "ul"); for (const { use, step: from } of sources) from === undefined ? add(list, "li", {}, `${use.range} (${use.slot ?? use.kind})`) : link(list, from, `${use.range} (${use.slot ?? use.kind})`); }
  if (readers.length) { add(side, "h3", {}, "read by"); const list = add(side, "ul"); for (const { use, step: to } of readers) link(list, to, use.range); }
  const barriers = [...(step.why_barriers ?? []), ...(step.why_barriers_after_clears ?? [])];
  if (barriers.length) { add(side, "h3", {}, "barriers before it"); for (const why of barriers) add(side, "p", {}, why); }
  if (pass.parameters.length) {
    add(side, "h3", {}, "parameters");
    const table = add(side, "table");
    for (const parameter of pass.parameters) {
      const row = add(table, "tr"), known = state.parameters.find((each) => each.name === parameter.path);
      add(row, "th", { scope: "row" }, parameter.name);
      add(row, "td", {}, parameter.value);
      const cell = add(row, "td");
      if (known) { add(cell, "span", { class: "quiet" }, known.from + " "); copyButton(cell, `--set ${known.name}=${known.value}`, `--set of ${known.name}`); }
    }
  }
  add(side, "h3", {}, "files");
  const template = editorTemplate(), addressOf = (file) => template && template.replace("{file}", file.replace(/:\d+$/, "")).replace("{line}", file.match(/\d+$/)?.[0] ?? 1);
  for (const file of [pass.place, ...pass.shader]) {
    const line = add(side, "p", {}, add(null, "code", {}, template ? add(null, "a", { href: addressOf(file) }, file) : file), " ");
    copyButton(line, file, file);
  }
  const input = add(add(side, "label", { class: "quiet editor" }, "links for an editor "), "input", { value: template, placeholder: "vscode://file/home/me/weft/{file}:{line}", onchange: () => { try { localStorage.setItem("weft editor", input.value); } catch {} mark(); } });
  return side;
}

// ---- selection ----

// Scrolls `box`, and nothing around it, until `element` is in its middle; or with a `corner` of names that cover it, until it is in sight.
function reveal(box, element, corner, across = true, down = true) {
  if (!element) return;
  const a = box.getBoundingClientRect(), b = element.getBoundingClientRect();
  const by = (low, high, from, to, covered) => (corner ? Math.min(from - low - covered, 0) || Math.max(to - high, 0) : (from + to - low - high) / 2);
  box.scrollBy(across ? by(a.left, a.right, b.left, b.right, corner?.offsetWidth) : 0, down ? by(a.top, a.bottom, b.top, b.bottom, corner?.offsetHeight) : 0);
}
function mark() {
  const matrix = document.querySelector(".matrix");
  for (const element of document.querySelectorAll("[data-step]")) element.setAttribute("aria-current", String(element.dataset.step.split(" ").includes(String(selected))));
  const column = state.columns.find((each) => each.steps.includes(selected));
  if (column) {
    state.columnMark.setAttribute("x", column.x);
    reveal(matrix, document.querySelector(".column[aria-current=true]"), matrix.querySelector(".corner"), true, false);
  }
  const r = state.shown.indexOf(selectedResource), written = state.plan.steps[selected]?.uses.find((use) => use.access !== "read")?.resource;
  const buttons = document.querySelectorAll(".rows button");
  buttons.forEach((button, i) => button.setAttribute("aria-current", String(i === r)));
  reveal(matrix, buttons[r >= 0 ? r : state.shown.findIndex((resource) => resource.name === written)], matrix.querySelector(".corner"), false, true);
  state.rowMark.setAttribute("y", r * ROW);
  document.querySelector("aside").replaceWith(drawSelected());
  markFlow();
}
function select(t) {
  if (!(t >= 0)) return;
  selected = t;
  selectedResource = undefined;
  history.replaceState(null, "", "#" + encodeURIComponent(state.plan.steps[t].pass));
  mark();
}
function selectResource(resource) { selectedResource = resource; mark(); }
function fromAddress() {
  const t = state.stepOf.get(decodeURIComponent(location.hash.slice(1)));
  if (t !== undefined) selected = t;
}
function draw() {
  selectedResource = undefined;
  document.querySelectorAll("header, nav, main, aside").forEach((element) => element.remove());
  document.body.append(drawTop(), drawTree(), add(null, "main", {}, drawMatrix(), drawLower()), drawSelected());
  mark();
}

function drawFrame() {
  report.states.forEach(indexState);
  state = report.states.at(-1);
  onhashchange = () => { fromAddress(); mark(); };
  onkeydown = (event) => { if (event.key === "/" && !/INPUT|TEXTAREA/.test(document.activeElement.tagName)) { document.querySelector(".search input").focus(); event.preventDefault(); } };
  state.plan.steps.forEach((step, t) => { if (step.uses.some((use) => use.access !== "read" && (use.range === state.plan.present || use.resource === state.plan.present))) selected = t; });
  fromAddress();
  draw();
}

// Of a viewer that runs (`weft view --serve`): drawn anew when something changed there; the pass that is selected stays.
async function follow() {
  try {
    const now = Number(await (await fetch("/changes" + location.search)).text());
    if (now !== report.live) {
      const page = new DOMParser().parseFromString(await (await fetch("/" + location.search)).text(), "text/html");
      const data = page.getElementById("report");
      if (data) { Object.assign(report, JSON.parse(data.textContent)); drawFrame(); }
    }
    document.body.classList.remove("ended");
  } catch { document.body.classList.add("ended"); }
  setTimeout(follow, 1000);
}

// ---- the page of weft test ----

function drawCases() {
  document.body.classList.add("plain");
  const page = add(document.body, "main"), failed = report.cases.filter((each) => each.lines);
  add(page, "h1", {}, `weft test: ${failed.length} of ${counted(report.cases.length, "case")} failed`);
  for (const each of failed) {
    add(page, "h2", { id: each.name }, `${each.name}: ${each.graph}`);
    if (each.first) add(page, "p", { class: "bad" }, `first that differs: ${each.first}`);
    for (const line of each.lines) add(page, "p", {}, line);
    if (!each.pairs) continue;
    for (const pair of each.pairs) {
      const row = add(page, "div", { class: "pair" }), figure = (source, caption) => source && add(row, "figure", {}, add(null, "img", { class: "wide", src: source, alt: caption }), add(null, "figcaption", { class: "quiet" }, caption));
      figure(pair.picture, `picture, frame ${pair.frame}`);
      figure(pair.expected, `golden: ${pair.golden}`);
      figure(pair.flip, "FLIP: black 0, yellow 1");
      if (pair.picture && pair.expected) wipe(page, pair.expected, pair.picture, pair.golden);
    }
  }
}

if (report.cases) drawCases(); else drawFrame();
if (report.live !== undefined) follow();
