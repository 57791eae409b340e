// A drawing with its parts, in its own coordinates: what is under a pointer, and what is marked on it.

import { drawn } from "./values.js";
import { know, still } from "./picture.js";
import { ALONE, tintOf } from "./parts.js";
import { Zoom } from "./zoom.js";

const SAMPLES = 160; // places along an outline at which it is looked at
const squared = ([x, y], [u, v]) => (x - u) ** 2 + (y - v) ** 2;
const MOST_NODES = 600; // that are drawn
const NODE = [2.5, 4.5]; // pixels across a node: where they lie close to each other, and at most
const RIM = 2.5; // pixels around it, both sides together
const DOT = [2, 3.5]; // pixels: radius of a place that is shown with where it goes, likewise
const between = (low, value, high) => Math.min(Math.max(value, low), high);

// What corrections say: the two ends of a pin, a stiff region; and the circle around points.

export const pointsOf = (pin) => (pin.includes(":") ? pin.split(":").map((side) => side.split(",").map(Number)) : null);
export const regionOf = (stiff) => {
  const [region, weight] = stiff.split("=");
  const [x, y, radius] = region.split(",").map(Number);
  return { centre: [x, y], radius, weight: Number(weight) };
};

export const middle = (points) => {
  const [xs, ys] = [0, 1].map((axis) => points.map((point) => point[axis]));
  const centre = [(Math.min(...xs) + Math.max(...xs)) / 2, (Math.min(...ys) + Math.max(...ys)) / 2];
  return { centre, radius: Math.max(...points.map(([x, y]) => Math.hypot(x - centre[0], y - centre[1]))) };
};

export class Panel {
  constructor(canvas, side) {
    Object.assign(this, { canvas, side, key: null, contours: [], colours: [] });
    this.layers = Object.fromEntries(["parts", "paper", "marks"].map((name) => [name, drawn("g", { class: name })]));
    canvas.append(...Object.values(this.layers));
    this.zoom = new Zoom(canvas, {
      view: () => this.drawing?.view,
      changed: () => {
        canvas.setAttribute("viewBox", this.zoom.box(this.drawing.view).join(" "));
        this.redraw?.();
      },
      drags: () => canvas.closest("[data-using]").dataset.using === "pair",
    });
  }

  // Shows a drawing; one that is shown already is left as it is.
  show(drawing) {
    if (drawing.key === this.key) return;
    this.key = drawing.key;
    this.drawing = drawing;
    this.zoom.go(1, [0.5, 0.5]);
    know(drawing.images);
    this.layers.paper.replaceChildren(still(drawing.paths));
    this.contours = drawing.contours.map(({ d, id, filled, nodes }, number) => {
      const element = drawn("path", { class: "part", d, "data-number": number });
      return { number, id, element, filled, nodes, samples: null };
    });
    this.layers.parts.replaceChildren(...this.contours.map(({ element }) => element));
    for (const contour of this.contours) {
      const { x, y, width, height } = contour.element.getBBox();
      Object.assign(contour, { box: [x, y, width, height], area: width * height, size: Math.hypot(width, height), length: contour.element.getTotalLength() });
    }
    this.order = [...this.contours].sort((p, q) => q.area - p.area || q.size - p.size).map(({ number }) => number);
  }

  // Colours by number of contour; what has none has no partner.
  colour(colours, isShown) {
    this.canvas.classList.toggle("coloured", isShown);
    for (const { number, element, filled } of this.contours) {
      const colour = colours.get(number) ?? ALONE;
      element.setAttribute("stroke", colour);
      element.setAttribute("fill", filled ? tintOf(colour) : "none");
    }
    // The largest lie lowest, so that each can be seen; of two as large the one with a partner is.
    const height = ({ number, area }) => area * ((colours.get(number) ?? ALONE) === ALONE ? 1.2 : 1);
    const sorted = [...this.contours].sort((p, q) => height(q) - height(p));
    this.layers.parts.replaceChildren(...sorted.map(({ element }) => element));
  }

  // Which parts look chosen, or pointed at.
  light(chosen, pointed) {
    for (const { number, element } of this.contours) {
      element.classList.toggle("chosen", chosen.includes(number));
      element.classList.toggle("pointed", pointed.includes(number));
    }
  }

  nameOf(number) {
    const { id } = this.contours[number];
    return `part ${number}${id ? ` (${id})` : ""}`;
  }

  // Whether a correction calls a part so.
  isCalled(number, name) {
    return /^\d+$/.test(name) ? Number(name) === number : name.replace(/^#/, "") === this.contours[number].id;
  }

  mark(...elements) {
    this.layers.marks.replaceChildren(...elements);
  }

  // ---- from the screen into the drawing, and back

  get matrix() {
    return this.canvas.getScreenCTM();
  }

  get scale() {
    return this.matrix?.a || 1;
  }

  point({ clientX, clientY }) {
    const { a, d, e, f } = this.matrix;
    return [(clientX - e) / a, (clientY - f) / d];
  }

  onScreen([x, y]) {
    const { a, d, e, f } = this.matrix;
    return [a * x + e, d * y + f];
  }

  isOver({ clientX, clientY }) {
    const { left, right, top, bottom } = this.canvas.getBoundingClientRect();
    return clientX >= left && clientX <= right && clientY >= top && clientY <= bottom;
  }

  // The smallest part around a point, or else the nearest within reach, in pixels.
  partAt(point, reach = 16) {
    const place = new DOMPoint(...point);
    const around = this.contours.filter(({ filled, element }) => filled && element.isPointInFill(place));
    const lines = this.contours.filter(({ filled }) => !filled);
    const near = this.nearest(point, around.length ? lines : this.contours, around.length ? reach / 2 : reach);
    if (near && (!around.length || !near.contour.filled)) return near.contour.number;
    return around.length ? around.reduce((p, q) => (q.area <= p.area ? q : p)).number : null;
  }

  // The nearest place on an outline within reach; nodes attract.
  spotAt(point, reach = 26, only = null) {
    const some = only === null ? this.contours : [this.contours[only]];
    const place = this.nearest(point, some, reach);
    if (!place) return null;
    const within = (9 / this.scale) ** 2;
    const node = some
      .flatMap((contour) => contour.nodes.map((at) => ({ contour, at, off: squared(at, point) })))
      .reduce((p, q) => (p && p.off <= q.off ? p : q), null);
    const best = node && node.off <= Math.max(within, place.off) && node.off < (reach / this.scale) ** 2 && node.off <= place.off + within ? node : place;
    return { number: best.contour.number, at: best.at, isNode: best === node };
  }

  nearest(point, contours, reach) {
    let best = null;
    let least = (reach / this.scale) ** 2;
    for (const contour of contours) {
      const [x, y, width, height] = contour.box;
      const dx = Math.max(x - point[0], point[0] - x - width, 0);
      const dy = Math.max(y - point[1], point[1] - y - height, 0);
      if (dx * dx + dy * dy > least) continue;
      for (const at of this.samples(contour)) {
        const off = squared(at, point);
        if (off < least) [best, least] = [{ contour, at, off }, off];
      }
    }
    return best;
  }

  samples(contour) {
    contour.samples ??= Array.from({ length: SAMPLES + 1 }, (_, k) => {
      const { x, y } = contour.element.getPointAtLength((k / SAMPLES) * contour.element.getTotalLength());
      return [x, y];
    });
    return contour.samples;
  }

  // ---- marks, whose sizes are pixels

  dot(at, pixels, attributes) {
    return drawn("circle", { cx: at[0], cy: at[1], r: pixels / this.scale, ...attributes });
  }

  number([x, y], number) {
    const size = 9.5 / this.scale;
    const label = drawn("text", { class: "pin-number", x, y: y + 0.36 * size, "font-size": size, "text-anchor": "middle" });
    label.textContent = number;
    return label;
  }

  // Pixels from a node to the next one on its outline, most of them.
  get spacing() {
    const gaps = this.contours.flatMap(({ nodes, length }) => nodes.map(() => length / nodes.length)).sort((p, q) => p - q);
    return this.scale * (gaps[gaps.length >> 2] ?? 0);
  }

  get dotSize() {
    return between(DOT[0], 0.2 * this.spacing, DOT[1]);
  }

  nodes() {
    const count = this.contours.reduce((sum, { nodes }) => sum + nodes.length, 0);
    if (count > MOST_NODES) return [];
    const data = this.contours.flatMap(({ nodes }) => nodes.map(([x, y]) => `M${x} ${y}h0`)).join("");
    const size = between(NODE[0], 0.25 * this.spacing, NODE[1]);
    return [["nodes under", size + RIM], ["nodes", size]].map(([name, width]) => {
      const path = drawn("path", { class: name, d: data });
      path.style.strokeWidth = `${width}px`;
      return path;
    });
  }

  text([x, y]) {
    const digits = this.drawing.decimals + 1;
    return `${Number(x.toFixed(digits))},${Number(y.toFixed(digits))}`;
  }
}
