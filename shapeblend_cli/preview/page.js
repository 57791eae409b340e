// The page itself: what is shown, and what users do.

import { at, copy, drawn, figures, made, mixed, place, share, unpacked } from "./values.js";
import { Matching, Picture, Scene } from "./picture.js";
import { Player, showPlaying } from "./player.js";
import { coloured, Filmstrip, tinted } from "./parts.js";
import { Graph, isDark, Landscape, legend, listenToGraph } from "./graph.js";
import { listFrames, showNumbers, showRun, showStrip } from "./report.js";

const data = JSON.parse(at("data").textContent);
const letterOf = (k) => (k < 26 ? String.fromCharCode(65 + k) : `drawing ${k + 1}`);

// ---- state

const prefersStill = matchMedia("(prefers-reduced-motion: reduce)");
const state = {
  contour: 0,
  dot: null,
  chosen: null, // { column, row, path, extra }
};
const scenes = [];
const pictures = [];
const player = new Player(data.timing, data.pairs.length, {
  shown: show,
  played: (playing) => showPlaying(at("play"), at("play-icon"), playing),
});
const film = new Filmstrip(at("film"), 9, (t) => {
  player.play(false);
  player.seek(seen.pair + t);
});
let matching = null;
let graph = null;
let seen = { pair: -1 };

const names = () => [letterOf(data.pairs[seen.pair].a), letterOf(data.pairs[seen.pair].b)];
const contours = () => data.pairs[seen.pair].contours;

// ---- what is shown

function show() {
  const { pair, t } = player;
  if (pair !== seen.pair) enter(pair);
  const scene = scenes[pair];
  seen = { ...seen, pair, t, points: pictures[pair].show(t) };
  at("drawing").setAttribute("viewBox", scene.view(t).join(" "));
  at("time").value = player.now;
  const [a, b] = names();
  at("clock").textContent = (data.pairs.length > 1 ? `${a} → ${b} ` : "") + t.toFixed(2);
  at("time").setAttribute("aria-valuetext", `${t.toFixed(2)} of the way from ${a} to ${b}`);
  film.mark(t);
  tint();
  overlay();
}

// What a contour without a partner does.
function changeOf({ a, counts, motion }) {
  if (Math.min(...counts) > 1) return "follows the edge that it lies on";
  return (a === null ? "grows from a " : "shrinks to a ") + (motion === "sweep" ? "line" : "point");
}

function enter(pair) {
  seen = { pair, colours: coloured(data.pairs[pair].contours, data.pairs[pair].order) };
  state.chosen = null;
  state.dot = null;
  const order = data.pairs[pair].order;
  at("contour").replaceChildren(
    ...order.map((k) => {
      const contour = contours()[k];
      const { a, b, counts, work } = contour;
      const solved = `${a} → ${b}: ${counts[0]} × ${counts[1]}, work ${figures(work, 3)}`;
      const what = a !== null && b !== null ? solved : `${a ?? b}: ${changeOf(contour)}`;
      return made("option", { value: k }, what);
    }),
  );
  at("contour-row").hidden = order.length < 2;
  fillOnion();
  choose(order.find((k) => contours()[k].a !== null && contours()[k].b !== null) ?? order[0]);
  fillFilm();
}

function scope(value) {
  [player.from, player.to] = value === "all" ? [0, data.pairs.length] : [Number(value), Number(value) + 1];
  at("time").min = player.from;
  at("time").max = player.to;
  showStrip(framesShown(), player.from, player.to);
  player.seek(player.from);
}

function framesShown() {
  return data.frames.filter(({ pair }) => pair >= player.from && pair < player.to);
}

// ---- over the picture

const MOST_SKINS = 40;

function fillOnion() {
  const group = at("onion");
  group.replaceChildren();
  if (!at("show-onion").checked) return;
  const scene = scenes[seen.pair];
  const frames = data.frames.filter(({ pair }) => pair === seen.pair);
  const times = frames.length ? frames.map(({ t }) => t) : [0.25, 0.5, 0.75];
  const step = Math.ceil(times.length / MOST_SKINS);
  const all = [0, ...times.filter((_, k) => k % step === 0), 1];
  for (const t of new Set(all)) {
    const d = scene.outlines(t);
    group.append(drawn("path", { class: "halo", d }), drawn("path", { d, stroke: mixed("#1f5fbf", "#c2410c", t) }));
  }
}

// Parts in their colours, over the picture and in the film.
function tint() {
  const isOn = at("show-parts").checked;
  at("picture").classList.toggle("faded", isOn);
  at("parts").replaceChildren(...(isOn ? tintedAt(seen.t, seen.points) : []));
}

const tintedAt = (t, points) => tinted(scenes[seen.pair], contours(), seen.colours, data.pairs[seen.pair].order, points);

function fillFilm() {
  film.show(scenes[seen.pair], at("show-parts").checked ? tintedAt : null);
}

// The contour that is drawn uppermost at a point of the screen, the smallest of several.
function contourAt(event) {
  const matrix = at("drawing").getScreenCTM();
  const [x, y] = [(event.clientX - matrix.e) / matrix.a, (event.clientY - matrix.f) / matrix.d];
  const pen = document.createElement("canvas").getContext("2d");
  const reach = 8 / matrix.a;
  let [best, least] = [null, Infinity];
  for (const element of tintedAt(seen.t, seen.points)) {
    const path = new Path2D(element.getAttribute("d"));
    pen.lineWidth = 2 * reach;
    const contour = Number(element.dataset.contour);
    const { isFilled } = scenes[seen.pair].shapes[contours()[contour].shape];
    const isIn = ((contours()[contour].closed || isFilled) && pen.isPointInPath(path, x, y, "nonzero")) || pen.isPointInStroke(path, x, y);
    if (!isIn) continue;
    const size = order().length - order().indexOf(contour); // the largest come first in the order
    if (size < least) [best, least] = [contour, size];
  }
  return best;
}

const order = () => data.pairs[seen.pair].order;

const dotsText = (points) => points.map(([x, y]) => `M${x} ${y}h0`).join("");
const lineText = (points) => `M${points.map(([x, y]) => `${x} ${y}`).join("L")}`;

// What of the overlay does not move.
function fillOverlay() {
  const [points, paths] = [at("show-points").checked, at("show-paths").checked];
  const parts = [];
  if (paths) parts.push(drawn("path", { class: "paths", d: matching.ways.map(lineText).join("") }));
  if (points) {
    parts.push(drawn("path", { class: "points of-a", d: dotsText(matching.vertices_a) }));
    parts.push(drawn("path", { class: "points of-b", d: dotsText(matching.vertices_b) }));
    parts.push(drawn("path", { class: "points now" }));
  }
  if (state.dot !== null) {
    const [a, b] = matching.ends[state.dot];
    parts.push(drawn("path", { class: "halo", d: dotsText([a, b]) }));
    parts.push(drawn("path", { class: "way", d: lineText(matching.ways[state.dot]) }));
    parts.push(drawn("path", { class: "point of-a", d: dotsText([a]) }), drawn("path", { class: "point of-b", d: dotsText([b]) }));
    parts.push(drawn("path", { class: "point now" }));
  }
  if (state.chosen) {
    parts.push(drawn("path", { class: "through" }), drawn("path", { class: "through other" }));
    const [a, b] = [matching.vertices_a[state.chosen.i], matching.vertices_b[state.chosen.j]];
    parts.push(drawn("path", { class: "halo", d: dotsText([a, b]) }), drawn("path", { class: "way", d: lineText([a, b]) }));
    parts.push(drawn("path", { class: "point of-a", d: dotsText([a]) }), drawn("path", { class: "point of-b", d: dotsText([b]) }));
  }
  at("overlay").replaceChildren(...parts);
  at("dot-row").hidden = !points && !paths;
  overlay();
}

// What moves.
function overlay() {
  const find = (selector) => at("overlay").querySelectorAll(selector);
  const { t, points } = seen;
  if (!points || !matching) return;
  const moving = [...find(".points.now"), ...find(".point.now")];
  if (moving.length) {
    const now = matching.at(t, points[matching.contour.shape]);
    find(".points.now").forEach((element) => element.setAttribute("d", dotsText(now)));
    find(".point.now").forEach((element) => element.setAttribute("d", dotsText([now[state.dot]])));
  }
  if (state.chosen) {
    // Eq (2) of the paper by the other path.
    const text = lineText(
      state.chosen.dots.map(([i, j]) => [0, 1].map((k) => (1 - t) * matching.vertices_a[i][k] + t * matching.vertices_b[j][k])),
    ) + (matching.contour.closed ? "Z" : "");
    find(".through").forEach((element) => element.setAttribute("d", text));
  }
}

function pick(dot) {
  state.dot = dot;
  const says = at("dot-says");
  if (dot === null) {
    says.textContent = "Point at a dot, or move the slider, to see which vertex goes where.";
  } else {
    const [i, j] = matching.dots[dot];
    const [a, b] = matching.ends[dot];
    const [letterA, letterB] = names();
    says.replaceChildren(
      made("span", { class: "a-name" }, `${letterA} ${i}`), ` at ${place(a)} goes to `,
      made("span", { class: "b-name" }, `${letterB} ${j}`), ` at ${place(b)}`,
      made("span", { class: "quiet" }, ` · pair ${dot + 1} of ${matching.dots.length}`),
    );
    at("dot").value = dot;
  }
  changed();
}

function nearest(event) {
  if (!at("show-points").checked && !at("show-paths").checked) return null;
  const matrix = at("drawing").getScreenCTM();
  const now = matching.at(seen.t, seen.points[matching.contour.shape]);
  const reach = event.pointerType === "mouse" ? 12 : 28;
  let [best, least] = [null, reach * reach];
  matching.ends.forEach(([a, b], k) => {
    for (const [x, y] of [a, b, now[k]]) {
      const dx = matrix.a * x + matrix.e - event.clientX;
      const dy = matrix.d * y + matrix.f - event.clientY;
      const off = dx * dx + dy * dy;
      if (off < least) [best, least] = [k, off];
    }
  });
  return best;
}

// ---- the graph

function more(extra, contour) {
  if (extra < 1e-9 * (graph.landscape.unit || 1)) return "no more than the least";
  const relative = contour.work > 0 ? ` (+${share(extra / contour.work)})` : "";
  return `${figures(extra, 3)} more${relative}`;
}

function sayCell(cell) {
  const shown = cell ?? (state.chosen ? [state.chosen.column, state.chosen.row] : null);
  const says = at("cell");
  if (!shown) {
    says.textContent = graph.landscape ? "Click a dot of the graph to see the least path through it." : "";
    return;
  }
  const [i, j] = graph.vertices(...shown);
  const [a, b] = names();
  const parts = [made("span", { class: "a-name" }, `${a} ${i}`), " with ", made("span", { class: "b-name" }, `${b} ${j}`)];
  if (graph.landscape) {
    const extra = graph.landscape.extra(...shown);
    const contour = contours()[state.contour];
    const costs = `: least work ${figures(contour.work + extra)}, ${more(extra, contour)}`;
    parts.push(extra === null ? ": no path goes through this dot" : costs);
  }
  says.replaceChildren(...parts);
}

function through(cell) {
  const { landscape } = graph;
  if (!landscape || !cell) return;
  const extra = landscape.extra(...cell);
  sayCell(cell);
  if (extra === null) return;
  const path = landscape.path(...cell);
  const open = contours()[state.contour].closed ? path.slice(0, -1) : path;
  const [i, j] = graph.vertices(...cell);
  state.chosen = { column: cell[0], row: cell[1], i, j, path, extra, dots: open.map((dot) => graph.vertices(...dot)) };
  changed();
}

function back() {
  if (!state.chosen) return;
  state.chosen = null;
  graph.cursor = null;
  sayCell(null);
  changed();
}

// The chosen dot as the command line takes it: a point of A and a point of B, each in its own drawing.
function pinOf({ i, j }) {
  const [factor, x, y] = data.pairs[seen.pair].to_a;
  const [a, b] = [matching.vertices_a[i], matching.vertices_b[j]];
  const own = [(b[0] - x) / factor, (b[1] - y) / factor];
  const text = (point) => point.map((value) => Number(value.toFixed(data.decimals + 1))).join(",");
  return `--pin ${text(a)}:${text(own)}`;
}

// What is picked or chosen has changed.
function changed() {
  at("copy-pin").hidden = !state.chosen || data.pairs.length > 1;
  at("back").hidden = at("other-key").hidden = !state.chosen;
  fillOverlay();
  if (graph) graph.show(state.dot, state.chosen);
}

const ABSENT = {
  large: (m, n) => `${m} × ${n} dots are too many for this page to hold what other paths cost: here is the path alone.`,
  full: () => "The page holds what other paths cost for the largest contours only: here is the path alone.",
};
const help = (a, b) =>
  `Columns are vertices of ${a}, rows vertices of ${b}, in the order of the wires; ` +
  "a path from corner to corner is a correspondence. ";
const HELP_HEAT = "The darker the dot, the less its best path costs more than the least. ";
const HELP_HEAT_DARK = "The brighter the dot, the less its best path costs more than the least. ";
const HELP_KEYS = "Wheel, pinch, + and − zoom, drag moves; arrow keys and Enter choose a dot.";

async function choose(number) {
  state.contour = number;
  state.chosen = null;
  state.dot = null;
  at("contour").value = number;
  const contour = contours()[number];
  const pair = seen.pair;
  matching = new Matching(scenes[pair], contour, scenes[pair].lists[number]);
  at("dot").max = matching.dots.length - 1;
  at("dot").value = 0;
  graph = null;
  showNumbers(contour);
  const solved = contour.a !== null && contour.b !== null;
  at("graph-present").hidden = !solved;
  at("graph-absent").hidden = solved;
  pick(null);
  if (!solved) {
    const [a, b] = names();
    const name = contour.a === null ? `${contour.b} of ${b}` : `${contour.a} of ${a}`;
    at("graph-absent").textContent =
      `Contour ${name} has no partner and ${changeOf(contour)}: nothing was solved, so there is no graph.`;
    return;
  }
  const [a, b] = names();
  const drawing = new Graph(at("graph"), contour, matching.dots, { letters: [a, b], band: data.settings.band, pointed: sayCell });
  graph = drawing;
  const told = contour.graph;
  at("graph").setAttribute("aria-label", `Graph of ${contour.counts[0]} vertices of ${a} and ${contour.counts[1]} of ${b}`);
  describe();
  sayCell(null);
  graph.draw();
  if (typeof told === "string") return;
  contour.landscape ??= await Landscape.from(told);
  if (graph !== drawing) return; // another contour was chosen meanwhile
  graph.paint(contour.landscape);
  describe();
  sayCell(null);
}

function describe() {
  const contour = contours()[state.contour];
  const [a, b] = names();
  const absent = typeof contour.graph === "string" ? `${ABSENT[contour.graph](...contour.counts)} ` : "";
  const heat = absent ? absent : isDark() ? HELP_HEAT_DARK : HELP_HEAT;
  at("graph-help").textContent = help(a, b) + heat + HELP_KEYS;
  legend(graph && graph.landscape, contour.work > 0);
}

// ---- what users do

function theme(dark) {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  repaint();
}

function repaint() {
  at("theme").textContent = isDark() ? "Light" : "Dark";
  at("theme").setAttribute("aria-label", isDark() ? "Change to light colours" : "Change to dark colours");
  if (!graph) return;
  describe();
  graph.repaint();
}

function listen() {
  at("play").addEventListener("click", () => player.play(!player.playing));
  at("time").addEventListener("input", () => {
    player.play(false);
    player.seek(Number(at("time").value));
  });
  at("speed").addEventListener("change", () => (player.speed = Number(at("speed").value)));
  at("repeat").addEventListener("change", () => player.repeatAs(at("repeat").value));
  at("scope").addEventListener("change", () => scope(at("scope").value));
  at("contour").addEventListener("change", () => choose(Number(at("contour").value)));
  at("show-onion").addEventListener("change", fillOnion);
  at("show-parts").addEventListener("change", () => {
    tint();
    fillFilm();
  });
  at("stage").addEventListener("click", (event) => {
    const contour = contourAt(event);
    if (contour !== null && contour !== state.contour) choose(contour);
  });
  for (const name of ["show-points", "show-paths"]) {
    at(name).addEventListener("change", () => (at("show-points").checked || at("show-paths").checked ? fillOverlay() : pick(null)));
  }
  at("dot").addEventListener("input", () => pick(Number(at("dot").value)));
  for (const kind of ["pointermove", "pointerdown"]) {
    at("stage").addEventListener(kind, (event) => {
      const dot = nearest(event);
      if (dot !== null && dot !== state.dot) pick(dot);
    });
  }
  at("theme").addEventListener("click", () => theme(!isDark()));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
  at("back").addEventListener("click", back);
  at("copy").addEventListener("click", () => copy(data.command.join(" "), at("copy")));
  at("copy-studio").addEventListener("click", () => copy(data.studio.join(" "), at("copy-studio")));
  at("copy-pin").addEventListener("click", () => copy(pinOf(state.chosen), at("copy-pin")));
  at("zoom-in").addEventListener("click", () => graph.zoomBy(1.6));
  at("zoom-out").addEventListener("click", () => graph.zoomBy(1 / 1.6));
  at("zoom-fit").addEventListener("click", () => graph.fit());
  new ResizeObserver(() => graph && graph.draw()).observe(at("graph"));
  listenToGraph(at("graph"), () => graph, through);
  addEventListener("keydown", key);
}

const STEP = 0.02;

// The time of the frame or drawing before, or after, what is shown.
function neighbour(forwards) {
  const times = framesShown().map(({ pair, t }) => pair + t);
  for (let k = player.from; k <= player.to; k++) times.push(k);
  times.sort((p, q) => p - q);
  const beyond = forwards ? times.find((t) => t > player.now + 1e-9) : times.findLast((t) => t < player.now - 1e-9);
  return beyond ?? player.now;
}

function key(event) {
  const tag = event.target.tagName;
  if (event.ctrlKey || event.metaKey || event.altKey || tag === "SELECT" || event.target.id === "dot") {
    if (event.key !== "Escape") return;
  }
  const move = (now) => {
    player.play(false);
    player.seek(now);
  };
  const round = (now) => Math.round(now / STEP) * STEP;
  const acts = {
    Escape: back,
    ArrowLeft: () => move(event.shiftKey ? neighbour(false) : round(player.now - STEP)),
    ArrowRight: () => move(event.shiftKey ? neighbour(true) : round(player.now + STEP)),
    Home: () => move(player.from),
    End: () => move(player.to),
  };
  const clicks = tag === "BUTTON" || tag === "SUMMARY" || event.target.type === "checkbox";
  if (!clicks) acts[" "] = () => player.play(!player.playing);
  if (!acts[event.key]) return;
  acts[event.key]();
  event.preventDefault();
}

// ---- beginning

async function begin() {
  for (const [k, pair] of data.pairs.entries()) {
    scenes[k] = new Scene(JSON.parse(new TextDecoder().decode(await unpacked(pair.packed))), pair.views, data.decimals);
    pictures[k] = new Picture(scenes[k], at("picture"));
  }
  at("scope").append(made("option", { value: "all" }, "all, one after the other"));
  data.pairs.forEach(({ a, b }, k) => {
    const name = `${letterOf(a)} → ${letterOf(b)}: ${data.names[a]} to ${data.names[b]}`;
    at("scope").append(made("option", { value: k }, name));
  });
  at("scope-row").hidden = data.pairs.length < 2;
  for (const speed of [0.25, 0.5, 1, 2, 4]) at("speed").append(made("option", { value: speed }, `${speed} ×`));
  at("speed").value = 1;
  const repeats = new Map([["1", "once"], ["forever", "forever"], ["pingpong", "pingpong"]]);
  if (!repeats.has(player.repeat)) repeats.set(player.repeat, `${player.repeat} times`);
  for (const [value, name] of repeats) at("repeat").append(made("option", { value }, name));
  at("repeat").value = player.repeat;
  showRun(data);
  listFrames(data, (pair, t) => {
    player.play(false);
    if (pair < player.from || pair >= player.to) {
      at("scope").value = "all";
      scope("all");
    }
    player.seek(pair + t);
  });
  repaint();
  player.play(false);
  listen();
  scope("all");
  document.documentElement.dataset.ready = "yes";
  if (!prefersStill.matches) player.play(true);
}

begin().catch((error) => {
  at("broken").textContent = `This page could not be shown: ${error.message}. A browser of 2024 or later would show it.`;
  at("broken").hidden = false;
});
