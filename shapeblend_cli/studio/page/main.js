// The studio: the state of a project, what is asked of the server, and what is shown of its answers.

import { at, copy, counted, made } from "./values.js";
import { ALONE } from "./parts.js";
import { ask, Latest } from "./asking.js";
import { Drawings, isDrawing } from "./drawings.js";
import { Exporting } from "./exporting.js";
import { Form } from "./form.js";
import { Others } from "./others.js";
import { Panel, pointsOf, regionOf } from "./panel.js";
import { Stage } from "./stage.js";
import { Timeline } from "./timeline.js";
import { Tools } from "./tools.js";
import { zoomAll } from "./zoom.js";

const PATIENCE = 400; // milliseconds before it is said that a blend takes time
const SIGN = 30_000; // milliseconds after which the studio hears that the page is still there
const PASSING = 6000; // milliseconds for which it is said what was done
const FRESH = 2000; // milliseconds for which nobody asks whether drawings have changed
const MOST_STEPS = 100; // steps that are kept for a page that is loaded again
const KEPT = "shapeblend";
const isDark = () => {
  const { theme } = document.documentElement.dataset;
  return theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
};

// What was done, to be undone and done again, also after the page was loaded again.

class History {
  constructor(first) {
    Object.assign(this, { present: first, past: [], future: [] });
  }

  // Takes what is so now, and in a word what was done. What merges with the step before is undone together with it.
  commit(next, what, merges = false) {
    if (JSON.stringify(next) === JSON.stringify(this.present)) return false;
    if (!merges || this.past.at(-1)?.what !== what) this.past.push({ state: this.present, what });
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

  // Keeps all of it with this tab of the browser, for the same session, and what goes with it.
  keep(session, more) {
    const { present, past, future } = this;
    try {
      sessionStorage.setItem(KEPT, JSON.stringify({ session, present, past: past.slice(-MOST_STEPS), future: future.slice(-MOST_STEPS), more }));
    } catch {
      // A browser that keeps nothing, or a history that is too long for it: undoing ends with the page.
    }
  }

  // Takes what was kept in a session, and returns what went with it; null if nothing was.
  restore(session) {
    try {
      const kept = JSON.parse(sessionStorage.getItem(KEPT));
      if (kept?.session !== session) return null;
      const { present, past, future, more } = kept;
      Object.assign(this, { present, past, future });
      return { more };
    } catch {
      return null;
    }
  }
}

const history = new History({ files: [] });
const shown = { answer: null, version: 0, attempted: null, at: Infinity };
const said = { timer: 0, notice: 0, isPassing: false, wrong: null };
let saved = ""; // the project that a file has
let session = ""; // the name of the studio's session
let form = null;
let tools = null;
let drawings = null;
let others = null;
let exporting = null;
let timeline = null;

const panels = { a: new Panel(at("canvas-a"), "a"), b: new Panel(at("canvas-b"), "b") };
const stage = new Stage((pair) => showPair(pair));

// ---- the project and its changes

const app = {
  get: (name) => history.present[name],
  project: () => history.present,
  isPair: () => history.present.files.length === 2,
  // Says what to do next, or what was just done, which passes.
  say(text, isPassing = false) {
    clearTimeout(said.timer);
    said.isPassing = isPassing;
    at("says").textContent = text;
    if (isPassing) said.timer = setTimeout(() => tools.hint(), PASSING);
  },

  complain: (text) => complain(text),
  isComplaint: (text) => said.wrong === text,
  notice: (text, label = "", act = null) => notice(text, label, act),

  // Takes options, null for none, as what is so now; see `History.commit`.
  change(options, what, merges = false) {
    shown.attempted = null;
    if (said.isPassing) tools.hint();
    if (history.commit(changed(history.present, options), what, merges)) refresh();
    else live.want(history.present);
  },

  open(project) {
    history.commit(project, "opening of a project");
    saved = JSON.stringify(history.present);
    refresh();
  },

  saved(project) {
    saved = JSON.stringify(project);
    refresh();
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
    const answer = await ask("look", { project, is_present: project === history.present, is_saved: JSON.stringify(project) === saved });
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
  const isChain = answer.pairs.length > 1;
  const isOther = !shown.answer || isChain !== shown.answer.pairs.length > 1;
  shown.answer = answer;
  if (project === history.present) at("command").textContent = answer.command;
  stage.show(answer);
  const { number, name, why } = answer.grade;
  at("verdict").title = at("verdict").textContent = `Grade ${number.toFixed(1)} of 3, ${name}${why ? `: ${why}` : ""}`;
  at("verdict").dataset.is = number < 0.5 ? "right" : number >= 2.0 ? "poor" : "fair";
  at("notes").replaceChildren(...answer.notes.filter((note) => !note.includes("in-betweens look poor")).map((note) => made("li", {}, note)));
  form.show(answer);
  pointAtFlaws();
  if (isOther && !said.isPassing) tools.hint();
}

// The two drawings of a pair, in the colours of what becomes what.
function showPair(number) {
  const { drawings, pairs } = shown.answer;
  const pair = pairs[number];
  const two = { a: drawings[pair.a], b: drawings[pair.b] };
  at("pair-row").hidden = pairs.length < 2;
  const names = pairs.map(({ a, b }) => `${drawings[a].name} → ${drawings[b].name}`);
  if (String(names) !== String([...at("pair").options].map(({ text }) => text))) {
    at("pair").replaceChildren(...names.map((name, k) => made("option", { value: k }, name)));
  }
  at("pair").value = number;
  if (Object.entries(panels).some(([side, { key }]) => key !== two[side].key)) tools?.forget();
  for (const [side, panel] of Object.entries(panels)) {
    panel.show(two[side]);
    const colours = new Map();
    pair.contours.forEach((contour, k) => {
      if (contour[side] !== null && (colours.get(contour[side]) ?? ALONE) === ALONE) colours.set(contour[side], stage.colours[number][k]);
    });
    panel.colour(colours, at("show-parts").checked);
    at(`name-${side}`).textContent = two[side].name;
    panel.canvas.setAttribute("aria-label", `Drawing ${side.toUpperCase()}, ${two[side].name}, ${counted(panel.contours.length, "part")}`);
  }
  document.title = `${drawings[0].name} → ${drawings[drawings.length - 1].name} · shapeblend studio`;
  at("title").textContent = `${drawings[0].name} → ${drawings[drawings.length - 1].name}`;
  timeline?.show(pair, stage.colours[number], shown.answer.timing);
  tools?.redraw();
  corrections();
}

// Says what is wrong, null for nothing, and marks the field that it is about.
function complain(text) {
  said.wrong = text;
  at("broken").hidden = !text;
  const plain = (text ?? "").replace(/^the project: /, "");
  const name = /^(?:--)?([a-z][a-z-]*)(?=[: ])/.exec(plain)?.[1];
  const isOption = form?.mark(name);
  at("broken-says").textContent = isOption && !plain.startsWith("--") ? `--${plain}` : plain;
}

// Says what became of a request, perhaps with something to do about it.
function notice(text, label, act) {
  clearTimeout(said.notice);
  if (text && !act) said.notice = setTimeout(() => notice(null), PASSING);
  at("notice").hidden = !text;
  at("notice-says").textContent = text ?? "";
  at("notice-do").hidden = !act;
  at("notice-do").textContent = label;
  at("notice-do").onclick = act;
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
  for (const name of ["to-export", "save"]) at(name).hidden = present.files.length < 2;
  if (present.files.length === 1) at("empty-title").textContent = `Drop the second drawing here`;
  at("unsaved").hidden = isSaved();
  drawings.show();
  form.show(shown.answer);
  corrections();
  tools.redraw();
  keep();
  live.want(present);
  others.look();
  if (present.files.length > 1) exporting.size(form.isSlow);
}

const keep = () => history.keep(session, { saved, theme: document.documentElement.dataset.theme });
const isSaved = () => JSON.stringify(history.present) === saved;

function step(way) {
  tools.letGo();
  shown.attempted = null;
  const what = way === "undo" ? history.undo() : history.redo();
  if (what === null) return;
  refresh();
  app.say(`${way === "undo" ? "Undone" : "Done again"}: ${what}.`, true);
}

// ---- where to look

const MANY = 3; // places that are pointed at
const LARGE = 0.02; // share of a drawing's area from which a part without a partner is seen
const WRONG = 0.2; // fault of an outline on its way that is seen

// Beside the verdict: the parts in which a blend is likely to be wrong, and what would help.
function pointAtFlaws() {
  const found = [];
  const name = (side, number) => `${panels[side].nameOf(number)} of ${side.toUpperCase()}`;
  const add = (side, number, weight, tool, text) => found.every((one) => one.text !== text) && found.push({ side, number, weight, tool, text });
  contours().forEach(({ a, b, wrong }) => {
    for (const [side, own, other] of [["a", a, b], ["b", b, a]]) {
      if (own === null || other !== null || shown.answer.settings.swap === "always") continue;
      const { view } = panels[side].drawing;
      const share = panels[side].contours[own].area / (view[2] * view[3]);
      const verb = side === "a" ? "vanishes" : "comes from nothing";
      if (share >= LARGE && !app.partners(side, own).length) add(side, own, 1 + share, "pair", `${name(side, own)} ${verb}: pair it`);
    }
    if (a !== null && b !== null && wrong >= WRONG) add("a", a, wrong, "pin", `${name("a", a)} bends out of shape: pin a point`);
  });
  const isRight = at("verdict").dataset.is === "right" || !app.isPair();
  at("places-none").hidden = isRight || found.length > 0;
  const worst = isRight ? [] : found.sort((p, q) => q.weight - p.weight).slice(0, MANY);
  at("places").replaceChildren(...worst.map(({ side, number, tool, text }) => {
    const button = made("button", { type: "button", class: "place" }, text[0].toUpperCase() + text.slice(1));
    button.addEventListener("click", () => tools.lookAt(side, number, tool));
    for (const event of ["pointerenter", "focus"]) button.addEventListener(event, () => tools.hover(side, number));
    for (const event of ["pointerleave", "blur"]) button.addEventListener(event, () => tools.hover(null));
    return button;
  }));
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
    const ends = ["a", "b"].map((side) => {
      const button = made("button", { type: "button", class: `plain ${side}-name`, "aria-label": `Move pin ${k + 1} in ${side.toUpperCase()} by keys` }, side.toUpperCase());
      button.addEventListener("click", () => tools.pick(side, k));
      return button;
    });
    return row("Pin", points ? `${k + 1}: ${points.map(short).join(" → ")}` : text, "pin", k, ...(points && app.isPair() ? ends : []));
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
  at("corrections-card").hidden = !all.length;
  at("corrections").replaceChildren(...all);
}

// ---- what users do

function listen() {
  at("undo").addEventListener("click", () => step("undo"));
  at("redo").addEventListener("click", () => step("redo"));
  at("theme").addEventListener("click", () => {
    document.documentElement.dataset.theme = isDark() ? "light" : "dark";
    theme();
    keep();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", theme);
  for (const name of ["open", "empty-open"]) at(name).addEventListener("click", () => at("files").click());
  at("files").addEventListener("change", () => {
    drawings.take(at("files").files);
    at("files").value = "";
  });
  addEventListener("beforeunload", (event) => isSaved() || event.preventDefault());
  at("broken-close").addEventListener("click", () => complain(null));
  at("notice-close").addEventListener("click", () => notice(null));
  at("halt").addEventListener("click", () => ask("halt").catch((error) => complain(error.message)));
  at("pair").addEventListener("change", () => stage.go(Number(at("pair").value) + 0.5));
  at("show-parts").addEventListener("change", () => shown.answer && showPair(stage.pair));
  at("others-card").addEventListener("toggle", () => others.look());
  const zooms = [panels.a.zoom, panels.b.zoom, stage.zoom];
  zoomAll(zooms, () => tools.redraw());
  at("copy").addEventListener("click", () => copy(at("command").textContent, at("copy")));
  addEventListener("keydown", key);
  // Drawings may have been changed in another program meanwhile.
  addEventListener("focus", () => performance.now() - shown.at > FRESH && live.want(shown.attempted ?? history.present));
  new ResizeObserver(() => tools.redraw()).observe(at("canvas-a"));
  showMore(at("options"));
  listenToDrops();
}

// Whether there is more below, so that it can be seen that options scroll.
function showMore(element) {
  const look = () => element.classList.toggle("is-more", element.scrollTop + element.clientHeight < element.scrollHeight - 8);
  element.addEventListener("scroll", look);
  const observer = new ResizeObserver(look);
  for (const one of [element, ...element.children]) observer.observe(one);
}

function key(event) {
  const isTyping = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) && event.target.type !== "range" && event.target.type !== "checkbox";
  const command = event.ctrlKey || event.metaKey;
  const letter = event.key.toLowerCase();
  if (command && (letter === "z" || letter === "y") && !isTyping) {
    step(letter === "y" || event.shiftKey ? "redo" : "undo");
  } else if (event.key === "Escape") {
    timeline.letGo() || tools.letGo();
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
    const panel = files.length === 1 && isDrawing(files[0]) ? Object.values(panels).find((one) => one.isOver(event)) : null;
    if (panel) drawings.replace(pairShown()?.[panel.side] ?? (panel.side === "a" ? 0 : 1), files[0]);
    else drawings.take(files);
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
  session = first.session;
  history.present = first.project;
  const kept = history.restore(session)?.more;
  if (kept?.theme) document.documentElement.dataset.theme = kept.theme;
  saved = kept?.saved ?? (first.is_saved ? JSON.stringify(first.project) : "");
  form = new Form(app, first);
  drawings = new Drawings(app, first.dropped);
  others = new Others(app);
  exporting = new Exporting(app, first.folder);
  tools = new Tools(panels, app);
  timeline = new Timeline(app, (side, number) => tools.hover(side, number));
  if (innerWidth < 900) for (const name of ["others-card", "moves-card"]) at(name).open = false;
  theme();
  listen();
  document.documentElement.dataset.version = 0;
  refresh();
  setInterval(() => ask("here").catch(() => {}), SIGN);
  if (first.project.files.length < 2) document.documentElement.dataset.ready = "yes";
}

begin().catch((error) => {
  complain(`The studio could not be shown: ${error.message}`);
});
