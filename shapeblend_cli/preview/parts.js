// Parts in colours: what becomes what has the same one in both drawings and on the way.

import { drawn, mixed } from "./values.js";
import { Picture } from "./picture.js";

const COLOURS = [
  "#2563d9", "#d9480f", "#2b8a3e", "#a3218a", "#a07400", "#0b7f8c",
  "#d6336c", "#5f3dc4", "#8a5a2b", "#5c940d", "#1971c2", "#c92a2a",
];
export const ALONE = "#7d848e";

// Parts that lie on others hide them, so that each has its own colour and no mixture.
export const tintOf = (colour) => mixed("#ffffff", colour, 0.45);

// For each contour of a blend its colour: contours that share one of A or one of B have the same.
export function coloured(contours, order) {
  const parent = contours.map((_, k) => k);
  const root = (k) => (parent[k] === k ? k : root(parent[k]));
  for (const side of ["a", "b"]) {
    const first = new Map();
    contours.forEach((contour, k) => {
      const number = contour[side];
      if (number === null) return;
      if (first.has(number)) parent[root(k)] = root(first.get(number));
      else first.set(number, k);
    });
  }
  const colours = new Map();
  const partners = new Map();
  contours.forEach(({ a, b }, k) => partners.set(root(k), (partners.get(root(k)) || 0) | (a !== null) | (2 * (b !== null))));
  for (const k of order) {
    const whole = root(k);
    if (partners.get(whole) === 3 && !colours.has(whole)) colours.set(whole, COLOURS[colours.size % COLOURS.length]);
  }
  return contours.map((_, k) => colours.get(root(k)) ?? ALONE);
}

// Paths of the contours of a scene in their colours, the first of `order` the lowest.
export function tinted(scene, contours, colours, order, points) {
  return order.map((k) => {
    const { shape, outline } = contours[k];
    const { isFilled, outlines } = scene.shapes[shape];
    const data = scene.shapes[shape].path(points[shape], scene.decimals + 1, outline);
    const fill = isFilled || outlines[outline].closed ? tintOf(colours[k]) : "none";
    return drawn("path", { class: "part", d: data, fill, stroke: colours[k], "data-contour": k });
  });
}

// Pictures of moments in a row, to be chosen.
export class Filmstrip {
  constructor(holder, count, chosen) {
    Object.assign(this, { holder, count, chosen, frames: [] });
  }

  // `tint`, if there is one, returns what lies over the picture at a time.
  show(scene, tint = null) {
    const pieces = this.count - 1;
    const frames = Array.from({ length: this.count }, (_, k) => {
      const t = k / pieces;
      const image = drawn("svg", { viewBox: scene.view(t).join(" "), "aria-hidden": "true" });
      const holder = drawn("g");
      const points = new Picture(scene, holder).show(t);
      if (tint) {
        holder.setAttribute("class", "faded");
        image.append(...tint(t, points));
      }
      image.append(holder);
      return { t, image };
    });
    if (!this.frames.length) {
      this.frames = frames.map(({ t }) => {
        const button = document.createElement("button");
        button.type = "button";
        button.setAttribute("aria-label", t === 0 ? "The first drawing" : t === 1 ? "The last drawing" : `At ${Math.round(100 * t)} %`);
        button.addEventListener("click", () => this.chosen(t));
        this.holder.append(button);
        return button;
      });
    }
    frames.forEach(({ image }, k) => this.frames[k].replaceChildren(image));
  }

  mark(t) {
    const near = Math.round(t * (this.count - 1));
    this.frames.forEach((button, k) => button.toggleAttribute("data-now", k === near));
  }
}
