// The studio: the state of a project, what is asked of the server, and what is shown of its answers.

import { at, copy, counted, made } from "./values.js";
import { ALONE } from "./parts.js";
import { ask, give, keep, Latest } from "./asking.js";
import { Form } from "./form.js";
import { Panel } from "./panel.js";
import { Stage } from "./stage.js";
import { pointsOf, regionOf, Tools } from "./tools.js";

const PATIENCE = 400; // milliseconds before it is said that a blend takes time
const FRESH = 2000; // milliseconds for which nobody asks whether drawings have changed
const QUIET = 700; // milliseconds without a change before other blends are looked for
const isDark = () => {
  const { theme } = document.documentElement.dataset;
  return theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
};

// What was done, to be undone and done again.

class History {
  constructor(first) {
    Object.assign(this, { present: first, past: [], future: [] });
  }

  // Takes what is so now, and in a word what was done.
  commit(next, what) {
    if (JSON.stringify(next) === JSON.stringify(this.present)) return false;
    this.past.push({ state: this.present, what });
    this.present = next;
    this.future = [];
    return true;
  }

  undo() {
    return this.go(this.past, this.future);
  }

  redo() {
    return this.go(this.future, this.past);
  }

  go(from, to) {
    const step = from.pop();
    if (!step) return null;
    to.push({ state: this.present, what: step.what });
    this.present = step.state;
    return step.what;
  }
}

const history = new History({ files: [] });
const shown = { answer: null, version: 0, attempted: null, at: Infinity };
const dropped = new Set(); // drawings that are in no file here
let form = null;
let tools = null;

const panels = { a: new Panel(at("canvas-a"), "a"), b: new Panel(at("canvas-b"), "b") };
const stage = new Stage((pair) => showPair(pair));

// ---- the project and its changes

const app = {
  get: (name) => history.present[name],
  isPair: () => history.present.files.length === 2,
  say: (text) => (at("says").textContent = text),

  // Takes options, null for none, as what is so now.
  change(options, what) {
    shown.attempted = null;
    if (history.commit(changed(history.present, options), what)) refresh();
    else live.want(history.present);
  },

  // Shows how it would be with options, without taking them; null for how it is.
  attempt(options) {
    const next = options && changed(history.present, options);
    if (JSON.stringify(next) === JSON.stringify(shown.attempted)) return;
    shown.attempted = next;
    live.want(next ?? history.present);
  },

  // Numbers of the contours that one of a side becomes, or comes from.
  partners(side, number) {
    const other = side === "a" ? "b" : "a";
    const found = contours().filter((contour) => contour[side] === number && contour[other] !== null);
    return [...new Set(found.map((contour) => contour[other]))];
  },

  // Points of both drawings that correspond, for each contour of the blend that one of a side is.
  correspondence(side, number) {
    const pair = pairShown();
    if (!pair) return [];
    return pair.contours.flatMap((contour, k) => {
      if (contour[side] !== number || contour.a === null || contour.b === null) return [];
      const { dots, vertices_a: a, vertices_b: b } = pair.lists[k];
      const own = (point, [factor, x, y]) => [(point[0] - x) / factor, (point[1] - y) / factor];
      return [dots.map(([i, j]) => [own(a[i], pair.maps[0]), own(b[j], pair.maps[1])])];
    });
  },
};

function changed(project, options) {
  const next = { ...project, ...options };
  for (const [name, value] of Object.entries(next)) {
    if (value === null || (Array.isArray(value) && !value.length && name !== "files")) delete next[name];
  }
  return next;
}

const pairShown = () => shown.answer?.pairs?.[stage.pair] ?? null;
const contours = () => pairShown()?.contours ?? [];

// ---- looking

const live = new Latest(async (project, isOld) => {
  if (project.files.length < 2) return;
  document.documentElement.dataset.asking = "yes";
  const patience = setTimeout(() => (at("busy").hidden = false), PATIENCE);
  try {
    const began = performance.now();
    const answer = await ask("look", { project });
    show(answer, project);
    document.documentElement.dataset.took = Math.round(performance.now() - began);
    complain(null);
  } catch (error) {
    if (error.answer?.command) at("command").textContent = error.answer.command;
    if (!isOld()) complain(error.message);
  } finally {
    clearTimeout(patience);
    at("busy").hidden = true;
    if (!isOld()) delete document.documentElement.dataset.asking;
    document.documentElement.dataset.ready = "yes";
    shown.at = performance.now();
    shown.version++;
    document.documentElement.dataset.version = shown.version;
  }
});

function show(answer, project) {
  const isFirst = !shown.answer;
  shown.answer = answer;
  if (project === history.present) at("command").textContent = answer.command;
  stage.show(answer);
  const { number, name, why } = answer.grade;
  at("verdict").textContent = `Grade ${number.toFixed(1)} of 3, ${name}${why ? `: ${why}` : ""}`;
  at("verdict").dataset.is = number < 1.0 ? "right" : number >= 2.0 ? "poor" : "fair";
  at("notes").replaceChildren(...answer.notes.filter((note) => !note.includes("in-betweens look poor")).map((note) => made("li", {}, note)));
  form.show(answer.settings);
  if (isFirst) tools.hint();
}

// The two drawings of a pair, in the colours of what becomes what.
function showPair(number) {
  const { drawings, pairs } = shown.answer;
  const pair = pairs[number];
  const two = { a: drawings[pair.a], b: drawings[pair.b] };
  at("pair-row").hidden = pairs.length < 2;
  if (at("pair").options.length !== pairs.length) {
    at("pair").replaceChildren(...pairs.map(({ a, b }, k) => made("option", { value: k }, `${drawings[a].name} → ${drawings[b].name}`)));
  }
  at("pair").value = number;
  for (const [side, panel] of Object.entries(panels)) {
    panel.show(two[side]);
    const colours = new Map();
    pair.contours.forEach((contour, k) => {
      if (contour[side] !== null && (colours.get(contour[side]) ?? ALONE) === ALONE) colours.set(contour[side], stage.colours[number][k]);
    });
    panel.colour(colours, at("show-parts").checked);
    const count = counted(panel.contours.length, "part");
    at(`name-${side}`).textContent = two[side].name;
    at(`count-${side}`).textContent = count;
    panel.canvas.setAttribute("aria-label", `Drawing ${side.toUpperCase()}, ${two[side].name}, ${count}`);
  }
  document.title = `${drawings[0].name} → ${drawings[drawings.length - 1].name} · shapeblend studio`;
  at("title").textContent = `${drawings[0].name} → ${drawings[drawings.length - 1].name}`;
  tools?.redraw();
  corrections();
}

function complain(text) {
  at("broken").hidden = !text;
  at("broken-says").textContent = (text ?? "").replace(/^the project: /, "");
}

// Everything that follows from the project itself.
function refresh() {
  const { present, past, future } = history;
  at("undo").disabled = !past.length;
  at("redo").disabled = !future.length;
  at("undo").title = past.length ? `Undo: ${past[past.length - 1].what}` : "";
  at("redo").title = future.length ? `Redo: ${future[future.length - 1].what}` : "";
  at("work").hidden = present.files.length < 2;
  at("empty").hidden = present.files.length >= 2;
  at("keys").hidden = present.files.length < 2;
  at("to-export").hidden = present.files.length < 2;
  if (present.files.length === 1) at("empty-title").textContent = `Drop the second drawing here`;
  const absent = present.files.filter((name) => dropped.has(name));
  at("absent").hidden = !absent.length;
  at("absent").textContent = `It expects ${absent.join(" and ")} where it is used.`;
  form.show(shown.answer?.settings ?? {});
  corrections();
  tools.redraw();
  live.want(present);
  lookForOthers();
}

function step(way) {
  tools.letGo();
  shown.attempted = null;
  const what = way === "undo" ? history.undo() : history.redo();
  if (what === null) return;
  refresh();
  app.say(`${way === "undo" ? "Undone" : "Done again"}: ${what}.`);
}

// ---- corrections in a list

function corrections() {
  const { present } = history;
  const remove = (name, k) => () => app.change({ [name]: present[name].filter((_, n) => n !== k) }, "removal");
  const row = (kind, text, name, k, ...more) => {
    const button = made("button", { type: "button", class: "plain", "aria-label": `Remove ${kind} ${k + 1}` }, "×");
    button.addEventListener("click", remove(name, k));
    return made("li", {}, made("span", { class: "kind" }, kind), made("span", { class: "what" }, text), ...more, button);
  };
  const pins = (present.pin ?? []).map((text, k) => {
    const points = pointsOf(text);
    const short = (point) => point.map((value) => Number(value.toPrecision(3))).join(", ");
    return row("Pin", points ? `${k + 1}: ${points.map(short).join(" → ")}` : text, "pin", k);
  });
  const matches = (present.match ?? []).map((text, k) => {
    const isNumbers = /^\d+=\d+$/.test(text);
    const swatch = made("span", { class: "swatch" });
    const which = contours().findIndex(({ a }) => isNumbers && a === Number(text.split("=")[0]));
    if (which >= 0) swatch.style.background = stage.colours[stage.pair]?.[which] ?? ALONE;
    return row("Pair", made("span", {}, swatch, isNumbers ? `part ${text.replace("=", " → part ")}` : text.replace(/[:=]/, " → ")), "match", k);
  });
  const regions = (present.stiff ?? []).map((text, k) => {
    const { centre, radius, weight } = regionOf(text);
    const input = made("input", { type: "number", min: "0.1", max: "100", step: "any", value: weight, "aria-label": `How many times as stiff region ${k + 1} is` });
    input.addEventListener("change", () => {
      if (!(Number(input.value) > 0)) return;
      const all = [...present.stiff];
      all[k] = `${text.split("=")[0]}=${Number(input.value)}`;
      app.change({ stiff: all }, "stiffness");
    });
    return row("Stiff", `at ${centre.map((value) => Number(value.toPrecision(3))).join(", ")}, ×`, "stiff", k, input);
  });
  const all = [...matches, ...pins, ...regions];
  at("none").hidden = all.length > 0;
  at("corrections").replaceChildren(...all);
}

// ---- other blends

let quiet = 0;
let asked = null;

function lookForOthers() {
  clearTimeout(quiet);
  if (!at("others-card").open || !app.isPair()) {
    at("others").replaceChildren();
    return;
  }
  const project = history.present;
  at("others").setAttribute("aria-busy", "true");
  quiet = setTimeout(async () => {
    if (asked) return; // looked for again when that is done
    asked = project;
    try {
      const { others } = await ask("others", { project });
      if (project === history.present) showOthers(others);
    } catch (error) {
      if (project === history.present) at("others").replaceChildren(made("p", { class: "quiet small" }, error.message));
    } finally {
      asked = null;
      at("others").removeAttribute("aria-busy");
      if (project !== history.present) lookForOthers();
    }
  }, QUIET);
}

function showOthers(others) {
  at("others-says").textContent = others.length > 1 ? "Each looks different. The number is its grade, 0 being best and 3 worst." : "Nothing else that was tried looks different.";
  at("others").replaceChildren(...others.map(({ options, changes, grade, pictures }, k) => {
    const images = pictures.map((svg) => made("img", { src: `data:image/svg+xml,${encodeURIComponent(svg)}`, alt: "" }));
    const button = made("button", { type: "button", "aria-pressed": k === 0 },
      made("span", { class: "pictures" }, ...images),
      made("span", { class: "what" }, made("span", {}, options), made("span", { class: "quiet" }, grade.toFixed(1))));
    button.addEventListener("click", () => Object.keys(changes).length && app.change(changes, options));
    return button;
  }));
}

// ---- files

async function take(files) {
  const named = [...files].sort((p, q) => p.name.localeCompare(q.name, undefined, { numeric: true }));
  const [projects, drawings] = [true, false].map((isProject) => named.filter(({ name }) => name.toLowerCase().endsWith(".json") === isProject));
  try {
    const names = [];
    for (const file of drawings) names.push(await given(file));
    if (projects.length) {
      const { project } = await give("project", projects[0]);
      history.commit(project, "opening of a project");
    } else {
      const before = history.present.files;
      const kept = names.length === 1 && before.length === 1 ? before : [];
      // Corrections are of the drawings that were; options stay.
      history.commit(changed(history.present, { files: [...kept, ...names], pin: null, match: null, stiff: null, start: null }), "opening of drawings");
    }
    complain(null);
    refresh();
  } catch (error) {
    complain(error.message);
  }
}

// Gives a drawing to the server, and returns its name there.
async function given(file) {
  const { name, is_here: isHere } = await give("drawing", file);
  if (isHere) dropped.delete(name);
  else dropped.add(name);
  return name;
}

// A single drawing dropped onto A or B takes its place.
async function replace(side, file) {
  try {
    const name = await given(file);
    const files = [...history.present.files];
    const pair = pairShown();
    files[pair ? pair[side] : side === "a" ? 0 : 1] = name;
    history.commit(changed(history.present, { files, pin: null, match: null, stiff: null, start: null }), "opening of a drawing");
    refresh();
  } catch (error) {
    complain(error.message);
  }
}

// ---- export

async function exported(work) {
  at("replace").hidden = true;
  at("written").textContent = "Working…";
  try {
    at("written").textContent = await work();
  } catch (error) {
    at("written").textContent = error.message;
  }
}

// Writes files; of those that were not agreed to, asks whether to.
function write(what, more, agreed = []) {
  return exported(async () => {
    const { asks, written, notes } = await ask(what, { project: history.present, agreed, ...more() });
    if (asks) {
      const { outside, existing } = asks;
      at("replace").textContent = existing.length ? "Replace what is there" : "Write there";
      at("replace").onclick = () => write(what, more, [...agreed, ...outside, ...existing]);
      at("replace").hidden = false;
      return [
        ...(outside.length ? [`Not in the folder of this project: ${outside.join(", ")}.`] : []),
        ...(existing.length ? [`There already: ${existing.join(", ")}.`] : []),
      ].join(" ");
    }
    return [`Wrote ${written.join(" and ")} in ${folder}.`, ...notes].join(" ");
  });
}

let folder = "";

// ---- what users do

function listen() {
  at("undo").addEventListener("click", () => step("undo"));
  at("redo").addEventListener("click", () => step("redo"));
  at("theme").addEventListener("click", () => {
    document.documentElement.dataset.theme = isDark() ? "light" : "dark";
    theme();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", theme);
  for (const name of ["open", "empty-open"]) at(name).addEventListener("click", () => at("files").click());
  at("files").addEventListener("change", () => {
    take(at("files").files);
    at("files").value = "";
  });
  at("broken-close").addEventListener("click", () => complain(null));
  at("halt").addEventListener("click", () => ask("halt").catch((error) => complain(error.message)));
  at("pair").addEventListener("change", () => stage.go(Number(at("pair").value) + 0.5));
  at("show-parts").addEventListener("change", () => showPair(stage.pair));
  at("others-card").addEventListener("toggle", lookForOthers);
  at("copy").addEventListener("click", () => copy(at("command").textContent, at("copy")));
  at("write").addEventListener("click", () => write("write", () => ({})));
  at("save").addEventListener("click", () => write("save", () => ({ file: at("project").value.trim() })));
  at("download").addEventListener("click", () => exported(async () => `${await keep("download", { project: history.present })} is in the browser's downloads.`));
  at("keep").addEventListener("click", () => exported(async () => `${await keep("keep", { project: history.present })} is in the browser's downloads; keep it beside the drawings.`));
  addEventListener("keydown", key);
  // Drawings may have been changed in another program meanwhile.
  addEventListener("focus", () => performance.now() - shown.at > FRESH && live.want(shown.attempted ?? history.present));
  addEventListener("resize", () => tools.redraw());
  listenToDrops();
}

function key(event) {
  const isTyping = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) && event.target.type !== "range" && event.target.type !== "checkbox";
  const command = event.ctrlKey || event.metaKey;
  const letter = event.key.toLowerCase();
  if (command && (letter === "z" || letter === "y") && !isTyping) {
    step(letter === "y" || event.shiftKey ? "redo" : "undo");
  } else if (event.key === "Escape") {
    tools.letGo();
  } else if (command || event.altKey || isTyping) {
    return;
  } else if ("123".includes(event.key)) {
    tools.choose(["pair", "pin", "stiff"][Number(event.key) - 1]);
  } else if (event.key === " " && !/^(BUTTON|SUMMARY|A)$/.test(event.target.tagName) && event.target.type !== "checkbox") {
    stage.player.play(!stage.player.playing);
  } else {
    return;
  }
  event.preventDefault();
}

function listenToDrops() {
  let depth = 0;
  const isFiles = (event) => event.dataTransfer?.types.includes("Files");
  addEventListener("dragenter", (event) => {
    if (isFiles(event)) at("drop").hidden = ++depth === 0;
  });
  addEventListener("dragleave", (event) => {
    if (isFiles(event)) at("drop").hidden = --depth <= 0;
  });
  addEventListener("dragover", (event) => isFiles(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!isFiles(event)) return;
    event.preventDefault();
    depth = 0;
    at("drop").hidden = true;
    const { files } = event.dataTransfer;
    const panel = files.length === 1 && shown.answer ? Object.values(panels).find((one) => one.isOver(event)) : null;
    if (panel && files[0].name.toLowerCase().endsWith(".svg")) replace(panel.side, files[0]);
    else take(files);
  });
}

function theme() {
  at("theme").textContent = isDark() ? "Light" : "Dark";
  at("theme").setAttribute("aria-label", isDark() ? "Change to light colours" : "Change to dark colours");
}

// ---- beginning

async function begin() {
  window.history.replaceState(null, "", "/"); // the token has become a cookie
  const first = await ask("begin");
  ({ folder } = first);
  history.present = first.project;
  form = new Form(app, first);
  tools = new Tools(panels, app);
  if (innerWidth < 900) for (const name of ["others-card", "moves-card"]) at(name).open = false;
  theme();
  listen();
  document.documentElement.dataset.version = 0;
  refresh();
  if (first.project.files.length < 2) document.documentElement.dataset.ready = "yes";
}

begin().catch((error) => {
  complain(`The studio could not be shown: ${error.message}`);
});
