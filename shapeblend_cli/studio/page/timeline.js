// When each part moves: a bar for each, to be dragged whole or by its ends; and parts that start one after the other.

import { at, figures, made } from "./values.js";
import { ALONE } from "./parts.js";

const SNAPS = 7; // pixels within which a bar snaps
const QUARTERS = [0, 0.25, 0.5, 0.75, 1];
const STEP = 0.01; // by an arrow key, as a share of the time; ten times that with Shift
const SHORTEST = 0.02; // share of the time
const DIGITS = 3; // after the point
const WHOLE = [0, 1];
const ENDS = { start: "Start", all: "All", end: "End" };

const rounded = (value) => Number(value.toFixed(DIGITS));
const isWhole = ([start, end]) => start <= 0 && end >= 1;

export class Timeline {
  // `app` has the options in force and takes changes: get, change, attempt. `hover` is told of a contour's number on a side.
  constructor(app, hover) {
    Object.assign(this, { app, hover, parts: [], rows: new Map(), seconds: 2, drag: null });
    this.stagger = at("stagger");
    this.stagger.addEventListener("input", () => this.app.attempt(this.inTurn()));
    this.stagger.addEventListener("change", () => this.app.change(this.inTurn(), "stagger"));
    at("stagger-by").addEventListener("change", () => this.app.change({ "stagger-by": at("stagger-by").value }, "order of the parts"));
    at("at-once").addEventListener("click", () => this.app.change({ timing: null, stagger: null, "stagger-by": null }, "timing"));
    at("timeline-card").addEventListener("toggle", ({ target }) => target.open && target.scrollIntoView({ block: "nearest" }));
    this.ticks = QUARTERS.map((t) => {
      const tick = made("span");
      tick.style.left = `${100 * t}%`;
      return tick;
    });
    at("ruler").append(made("div", {}, ...this.ticks));
  }

  inTurn() {
    const share = Number(this.stagger.value);
    return { timing: null, stagger: share || null, ...(share ? {} : { "stagger-by": null }) };
  }

  // Shows the parts of a pair of an answer, in the colours of its contours.
  show({ parts, contours }, colours, { seconds }) {
    this.parts = parts;
    this.seconds = seconds;
    at("timeline-card").hidden = parts.length < 2;
    const isSame = parts.length === this.rows.size && parts.every(({ name }) => this.rows.has(name));
    if (!isSame) {
      this.drag = null;
      this.rows = new Map(parts.map(({ name }) => [name, this.row(name)]));
      at("bars").replaceChildren(...[...this.rows.values()].map(({ element }) => element));
    }
    this.ticks.forEach((tick, k) => (tick.textContent = `${figures(QUARTERS[k] * seconds, 3)} s`));
    for (const part of parts) {
      const row = this.rows.get(part.name);
      const own = contours.flatMap(({ shape }, k) => (part.shapes.includes(shape) ? [k] : []));
      row.contour = contours[own[0]] ?? null;
      row.bar.style.setProperty("--colour", own.map((k) => colours[k]).find((colour) => colour !== ALONE) ?? ALONE);
      if (this.drag?.name !== part.name) this.place(row, part.span);
    }
    const stagger = this.app.get("stagger") ?? 0;
    if (document.activeElement !== this.stagger) this.stagger.value = stagger;
    at("stagger-by").value = this.app.get("stagger-by") ?? "order";
    at("stagger-by").disabled = !Number(stagger);
    at("at-once").disabled = parts.every(({ span }) => isWhole(span)) && !Number(stagger);
  }

  row(name) {
    const label = made("span", { class: "what", title: name }, name.replace(/^(B?)(\d+)$/, (_, side, number) => `${side || "A"}, shape ${number}`));
    const bar = made("div", { class: "span" });
    const row = { name, bar, element: made("div", { class: "part-row" }, label, made("div", { class: "track" }, bar)), grips: {}, contour: null };
    for (const [which, says] of Object.entries(ENDS)) {
      const grip = made("span", { class: `grip ${which}-grip`, role: "slider", tabindex: 0, "aria-label": `${says} of ${name}`, "aria-valuemin": 0, "aria-valuemax": 1 });
      grip.addEventListener("pointerdown", (event) => this.down(row, which, grip, event));
      grip.addEventListener("pointermove", (event) => this.move(event));
      grip.addEventListener("pointerup", () => this.up());
      grip.addEventListener("pointercancel", () => this.letGo());
      grip.addEventListener("keydown", (event) => this.key(row, which, event));
      row.grips[which] = grip;
    }
    row.grips.all.addEventListener("dblclick", () => this.change(row, WHOLE));
    bar.append(row.grips.all, row.grips.start, row.grips.end);
    for (const event of ["pointerenter", "focusin"]) row.element.addEventListener(event, () => this.point(row));
    for (const event of ["pointerleave", "focusout"]) row.element.addEventListener(event, () => this.hover(null));
    return row;
  }

  point({ contour }) {
    if (contour) this.hover(...(contour.a !== null ? ["a", contour.a] : ["b", contour.b]));
  }

  place(row, [start, end]) {
    row.span = [start, end];
    row.bar.style.left = `${100 * start}%`;
    row.bar.style.width = `${100 * (end - start)}%`;
    const seconds = (t) => `${figures(t * this.seconds, 3)} s`;
    row.bar.title = `${seconds(start)} to ${seconds(end)}`;
    for (const [which, value] of [["start", start], ["all", start], ["end", end]]) {
      row.grips[which].setAttribute("aria-valuenow", rounded(value));
      row.grips[which].setAttribute("aria-valuetext", which === "all" ? `${seconds(start)} to ${seconds(end)}` : seconds(value));
    }
  }

  // ---- by pointer

  down(row, which, grip, event) {
    if (event.button) return;
    grip.setPointerCapture(event.pointerId);
    this.drag = { name: row.name, row, which, from: row.span, began: event.clientX, moved: false };
    event.preventDefault();
    grip.focus({ focusVisible: false });
  }

  move(event) {
    const { drag } = this;
    if (!drag) return;
    const { width } = drag.row.bar.parentElement.getBoundingClientRect();
    const by = (event.clientX - drag.began) / width;
    if (!drag.moved && Math.abs(by * width) < 3) return;
    drag.moved = true;
    const span = moved(drag.from, drag.which, by);
    this.place(drag.row, event.altKey ? span : this.snapped(span, drag, SNAPS / width));
    this.app.attempt(this.options(drag.row, drag.row.span));
  }

  // A span whose end, or whose one end, lies where another part's begins or ends, at a quarter, or at the time that is shown.
  snapped([start, end], { name, which, from }, reach) {
    const now = Number(at("timeline").style.getPropertyValue("--now"));
    const others = this.parts.filter((part) => part.name !== name).flatMap(({ span }) => span);
    const goals = [...QUARTERS, ...others, now];
    const offs = (value) => goals.map((goal) => goal - value).filter((off) => Math.abs(off) <= reach);
    const ways = which === "start" ? offs(start) : which === "end" ? offs(end) : [...offs(start), ...offs(end)];
    if (!ways.length) return [start, end];
    const least = ways.reduce((p, q) => (Math.abs(q) < Math.abs(p) ? q : p));
    const by = (which === "end" ? end - from[1] : start - from[0]) + least;
    return moved(from, which, by);
  }

  up() {
    const { drag } = this;
    this.drag = null;
    if (drag?.moved) this.change(drag.row, drag.row.span);
  }

  letGo() {
    const { drag } = this;
    if (!drag) return false;
    this.drag = null;
    this.place(drag.row, drag.from);
    this.app.attempt(null);
    return true;
  }

  // ---- by keys

  key(row, which, event) {
    const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (way) this.change(row, moved(row.span, which, way * STEP * (event.shiftKey ? 10 : 1)), true);
    else if (event.key === "Delete") this.change(row, WHOLE);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  // ---- what comes of it

  // The options by which a part moves within a span, and the others as they are.
  options(row, span) {
    const table = this.app.get("stagger")
      ? Object.fromEntries(this.parts.filter((part) => !isWhole(part.span)).map((part) => [part.name, lineOf(part.span)]))
      : JSON.parse(this.app.get("timing") ?? "{}");
    const { is_grouped: isGrouped } = this.parts.find(({ name }) => name === row.name);
    if (isWhole(span) && !isGrouped) delete table[row.name];
    else table[row.name] = lineOf(span);
    return { timing: Object.keys(table).length ? JSON.stringify(table) : null, stagger: null, "stagger-by": null };
  }

  change(row, span, merges = false) {
    const options = this.options(row, span);
    this.place(row, span);
    this.app.change(options, `timing of ${row.name}`, merges);
  }
}

const lineOf = ([start, end]) => ({ start: rounded(start), length: rounded(rounded(end) - rounded(start)) });

// A span of which an end, or all, goes by a share of the time.
function moved([start, end], which, by) {
  const between = (low, value, high) => Math.min(Math.max(value, low), high);
  if (which === "start") return [between(0, start + by, end - SHORTEST), end];
  if (which === "end") return [start, between(start + SHORTEST, end + by, 1)];
  const shift = between(-start, by, 1 - end);
  return [start + shift, end + shift];
}
