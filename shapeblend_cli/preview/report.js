// What was found: the numbers of the report.

import { at, counted, entries, figures, made, share } from "./values.js";

export function showNumbers(contour) {
  const solved = contour.a !== null && contour.b !== null;
  const { work, stretching, bending, lower_bound: bound, gap } = contour;
  at("shares").hidden = !(work > 0);
  if (work > 0) {
    at("share-stretching").style.flexGrow = stretching / work;
    at("share-bending").style.flexGrow = bending / work;
  }
  const rows = [
    ["Work", figures(work, 6)],
    ["Stretching", figures(stretching, 6), "key-stretching"],
    ["Bending", figures(bending, 6), "key-bending"],
    ["Lower bound", bound === null || (bound === 0 && work > 0) ? "nothing is proven" : `${figures(bound, 6)} (gap ${share(gap)})`],
    ["Angles that reach zero", contour.zero_angles],
    ["Diagonal deviation", figures(contour.diagonal_deviation, 3)],
    ["Sweeps through the graph", contour.sweeps],
    ["Vertices", contour.counts.join(" and ")],
    ["Dots of the path", contour.steps],
    ["Solved in", `${figures(1000 * contour.seconds, 3)} ms`],
  ];
  if (contour.turned_back) rows.push(["B turned back by", `${figures(contour.turned_back, 3)}°`]);
  entries(at("works"), solved ? rows : [["Work", "0: nothing is solved for what has no partner"]]);
  at("motion").replaceChildren(made("strong", {}, contour.motion), `: ${contour.motion_because}`);
}

const CONSTANTS = ["ks", "kb", "es", "eb", "pb", "mb", "cs"];
const OPTIONS = { pins: "pin", tries: "try" }; // settings whose options are called otherwise
const isNothing = (value) => value === null || value.length === 0;
const asText = (value) => (isNothing(value) ? "none" : typeof value === "object" ? JSON.stringify(value) : String(value));

export function showRun(data) {
  const { settings } = data;
  at("summary").textContent = [
    counted(data.pairs.length, "pair"), counted(data.frames.length, "frame"),
    counted(data.pairs.reduce((sum, pair) => sum + pair.contours.length, 0), "contour"),
  ].join(" · ");
  at("version").textContent = `shapeblend ${data.version}`;
  for (const name of ["command", "studio"]) at(name).replaceChildren(...data[name].flatMap((word) => [made("span", {}, word), " "]));
  at("correct").hidden = !data.studio.length;
  at("notes").replaceChildren(...data.notes.map((note) => made("li", {}, note)));
  entries(at("constants"), [
    ...CONSTANTS.map((name) => [name, figures(settings[name])]),
    ...["band", "solver", "effort", "preset", "vertices", "start"].map((name) => [name, asText(settings[name])]),
  ], "pair");
  entries(at("seconds"), Object.entries(data.seconds).map(([stage, seconds]) => [stage, figures(seconds, 3)]), "pair");
  entries(at("settings"), Object.entries(settings).map(([name, value]) => [`--${(OPTIONS[name] ?? name).replaceAll("_", "-")}`, asText(value)]));
}

// A row a frame, made when they are wanted; `chosen` is told of the pair and the time of one.
export function listFrames(data, chosen) {
  at("frames-all").hidden = !data.frames.length;
  at("frames-title").textContent = `Frames (${data.frames.length})`;
  at("frame-pair").hidden = data.pairs.length < 2;
  const row = ({ t, pair, area, self_crossings: crossings }) => {
    const button = made("button", { type: "button", "aria-label": `Show t = ${figures(t)}` }, t.toFixed(3));
    button.addEventListener("click", () => chosen(pair, t));
    const cells = [button, String(pair + 1), figures(area, 5), String(crossings)].map((text) => made("td", {}, text));
    cells[1].hidden = data.pairs.length < 2;
    cells[3].classList.toggle("crosses", crossings > 0);
    return made("tr", {}, ...cells);
  };
  at("frames-all").addEventListener("toggle", () => {
    if (!at("frames").children.length) at("frames").replaceChildren(...data.frames.map(row));
  });
}

// The bars of frames between two keys.
export function showStrip(frames, from, to) {
  const most = Math.max(...frames.map(({ area }) => area), Number.MIN_VALUE);
  const bars = (some) =>
    some
      .map(({ pair, t, area }) => [(1000 * (pair + t - from)) / (to - from), -4 - (14 * area) / most])
      .map(([x, height]) => `M${x} 20v${height}`)
      .join("");
  const crossed = frames.filter((frame) => frame.self_crossings);
  at("whole").setAttribute("d", bars(frames.filter((frame) => !frame.self_crossings)));
  at("crossed").setAttribute("d", bars(crossed));
  at("strip").toggleAttribute("hidden", !frames.length);
  at("strip-says").textContent = !frames.length
    ? "No frames were asked for, so nothing is said of crossings and areas."
    : `${counted(frames.length, "frame")}; a bar is its area. ` +
      (crossed.length === 0
        ? "None crosses itself."
        : crossed.length === 1 ? "One of them crosses itself: the red one." : `${crossed.length} of them cross themselves: the red ones.`);
}
