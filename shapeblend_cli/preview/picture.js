// What is drawn: shapes that move, the drawings at the ends of time, and the correspondence over them.

import { drawn, mixed, sampled } from "./values.js";

// The links of pictures by the names that drawings have for them.
const images = new Map();

export function know(found = {}) {
  for (const [name, link] of Object.entries(found)) images.set(name, link);
}

// Beyond the drawings outlines move on, and everything else stays.
const within = (t) => Math.min(Math.max(t, 0), 1);

export class MovingShape {
  constructor({ outlines, times, points, coats = [], clips = [] }, scale) {
    this.times = times;
    this.coats = coats;
    this.clips = clips;
    this.isFilled = coats.some(({ path, fill, image }) => fill || image || path.fill.some((colour) => colour !== "none"));
    let row = new Array(points[0].length).fill(0);
    this.keys = points.map((steps) => {
      row = row.map((value, k) => value + steps[k]);
      const found = new Float64Array(row.length);
      for (let k = 0; k < row.length; k++) found[k] = row[k] / scale + (k < 2 ? 0 : found[k - 2]);
      return found;
    });
    let offset = 0;
    this.outlines = outlines.map(({ closed, lines }) => {
      const outline = { closed, lines, start: offset, ends: [] };
      offset += 2;
      for (const kind of lines) {
        outline.ends.push(offset);
        offset += kind === "L" ? 2 : 6;
      }
      return outline;
    });
  }

  at(t) {
    const { times, keys } = this;
    let k = 0;
    while (k < times.length - 2 && t > times[k + 1]) k++;
    const u = (t - times[k]) / (times[k + 1] - times[k]);
    const [first, second] = [keys[k], keys[k + 1]];
    return first.map((value, n) => (1 - u) * value + u * second[n]);
  }

  // The outlines, or only the one with a number.
  path(points, digits, only = null) {
    const text = [];
    const point = (k) => `${Number(points[k].toFixed(digits))},${Number(points[k + 1].toFixed(digits))}`;
    for (const { closed, lines, start, ends } of only === null ? this.outlines : [this.outlines[only]]) {
      text.push(`M${point(start)}`);
      const last = closed && lines.endsWith("L") ? lines.length - 1 : lines.length; // Z draws it
      for (let n = 0; n < last; n++) {
        const k = ends[n];
        text.push(lines[n] === "L" ? `L${point(k)}` : `C${point(k)} ${point(k + 2)} ${point(k + 4)}`);
      }
      if (closed) text.push("Z");
    }
    return text.join("");
  }

  // Where on an outline a place is: the number of a segment and its parameter.
  spot(points, number, along) {
    const { start, lines, ends } = this.outlines[number];
    const n = Math.min(Math.floor(along), lines.length - 1);
    const u = along - n;
    const from = n ? ends[n - 1] + (lines[n - 1] === "L" ? 0 : 4) : start;
    const k = ends[n];
    return [0, 1].map((axis) => {
      if (lines[n] === "L") return (1 - u) * points[from + axis] + u * points[k + axis];
      const v = 1 - u;
      return (
        v * v * v * points[from + axis] + 3 * v * v * u * points[k + axis] +
        3 * v * u * u * points[k + 2 + axis] + u * u * u * points[k + 4 + axis]
      );
    });
  }
}

// Gradients lie in the group of what they paint, so that they go with it.
let gradients = 0;

function gradientOf({ tag, attributes, stops }, group) {
  const element = drawn(tag, { id: `gradient-${++gradients}`, ...attributes });
  for (const stop of stops) element.append(drawn("stop", stop));
  group.append(element);
  return element;
}

// Regions lie there, too.
let regions = 0;

function regionIn(group, rule, d = "") {
  const element = drawn("clipPath", { id: `region-${++regions}` });
  const path = drawn("path", { "clip-rule": rule, d });
  element.append(path);
  group.append(element);
  return { path, link: `url(#${element.id})` };
}

// Groups in a group, each clipped by one of some regions; returns the innermost.
function clipped(group, links) {
  for (const link of links) {
    const inner = drawn("g", { "clip-path": link });
    group.append(inner);
    group = inner;
  }
  return group;
}

// Paths that do not move, and pictures, as a group.
export function still(paths) {
  const group = drawn("g");
  for (const { path, image, source, clips = [], ...paints } of paths) {
    const holder = clipped(group, clips.map(({ rule, d }) => regionIn(group, rule, d).link));
    if (image) {
      holder.append(source ? drawn("image", { ...image, href: images.get(source) }) : drawn("path", image));
      continue;
    }
    const element = drawn("path", path);
    for (const [name, gradient] of Object.entries(paints)) element.setAttribute(name, `url(#${gradientOf(gradient, group).id})`);
    holder.append(element);
  }
  return group;
}

// Adds a path or a picture for each coat of a shape to a group, and returns what draws them at a time.
function painted(shape, digits, group, links) {
  const changes = [];
  const vary = (target, name, values) => {
    target.setAttribute(name, values[0]);
    if (values.length > 1) changes.push((t) => target.setAttribute(name, mixed(...sampled(values, t))));
  };
  const elements = shape.coats.map(({ path, image, source, ...paints }) => {
    const element = drawn(source ? "image" : "path");
    if (image) {
      if (source) element.setAttribute("href", images.get(source));
      for (const [name, values] of Object.entries(image)) vary(element, name, values);
      return element;
    }
    // Where there is a gradient, the plain colour that stands for it is not painted.
    for (const [name, values] of Object.entries(path)) if (!(name in paints)) vary(element, name, values);
    for (const [name, values] of Object.entries(paints)) {
      const gradient = gradientOf(values[0], group);
      element.setAttribute(name, `url(#${gradient.id})`);
      const keys = new Set(values.flatMap(({ attributes }) => Object.keys(attributes)));
      for (const key of keys) vary(gradient, key, values.map(({ attributes }) => attributes[key] ?? "pad"));
      [...gradient.children].forEach((stop, k) => {
        for (const key of Object.keys(values[0].stops[k])) vary(stop, key, values.map(({ stops }) => stops[k][key]));
      });
    }
    return element;
  });
  clipped(group, shape.clips.map((number) => links[number])).append(...elements);
  const paths = elements.filter((_, k) => !shape.coats[k].image);
  return (t, points) => {
    const text = paths.length ? shape.path(points, digits) : "";
    for (const element of paths) element.setAttribute("d", text);
    for (const change of changes) change(t);
  };
}

// A pair of drawings and what moves between them.
export class Scene {
  constructor({ shapes, ends, lists, regions = [], images }, views, decimals) {
    Object.assign(this, { ends, views, lists, decimals });
    know(images);
    const moving = (shape) => new MovingShape(shape, 10 ** decimals);
    this.shapes = shapes.map(moving);
    this.regions = regions.map(({ rule, shapes }) => ({ rule, shapes: shapes.map(moving) }));
  }

  view(t) {
    const u = within(t);
    return this.views[0].map((start, k) => (1 - u) * start + u * this.views[1][k]);
  }

  points(t) {
    return this.shapes.map((shape) => shape.at(t));
  }

  outlines(t) {
    return this.shapes.map((shape) => shape.path(shape.at(t), this.decimals)).join("");
  }
}

// A scene in an element of SVG.
export class Picture {
  constructor(scene, holder) {
    Object.assign(this, { scene, holder, groups: {} });
  }

  // At the ends of time the drawings themselves. Returns where the points of all shapes are.
  show(t) {
    const { scene, groups, holder } = this;
    const points = scene.points(t);
    const kind = t === 0 ? "first" : t === 1 ? "last" : "between";
    if (kind === "between") {
      groups.between ??= this.between();
      groups.between.cuts.forEach((cut) => cut(t));
      groups.between.updates.forEach((update, k) => update(within(t), points[k]));
    } else {
      groups[kind] ??= { group: still(scene.ends[t]) };
    }
    const { group } = groups[kind];
    if (holder.firstChild !== group) holder.replaceChildren(group);
    return points;
  }

  between() {
    const group = drawn("g");
    const digits = this.scene.decimals + 1;
    const found = this.scene.regions.map(({ rule, shapes }) => ({ shapes, ...regionIn(group, rule) }));
    const cuts = found.map(({ shapes, path }) => (t) => {
      path.setAttribute("d", shapes.map((shape) => shape.path(shape.at(t), digits)).join(""));
    });
    const links = found.map(({ link }) => link);
    const updates = this.scene.shapes.map((shape) => painted(shape, digits, group, links));
    return { group, cuts, updates };
  }
}

// Which vertices become which, of one contour.
export class Matching {
  constructor(scene, contour, lists) {
    Object.assign(this, { contour, ...lists });
    const shape = scene.shapes[contour.shape];
    this.shape = shape;
    this.spots = (points) => this.places.map((along) => shape.spot(points, contour.outline, along));
    this.ends = this.dots.map(([i, j]) => [this.vertices_a[i], this.vertices_b[j]]);
    // Outlines are cut where both have nodes, not at these vertices: what is off at the ends fades out.
    const [first, last] = [shape.keys[0], shape.keys[shape.keys.length - 1]].map(this.spots);
    this.off = this.ends.map(([a, b], k) => [
      [a[0] - first[k][0], a[1] - first[k][1]],
      [b[0] - last[k][0], b[1] - last[k][1]],
    ]);
  }

  at(t, points) {
    return this.spots(points).map(([x, y], k) => {
      const [start, end] = this.off[k];
      return [x + (1 - t) * start[0] + t * end[0], y + (1 - t) * start[1] + t * end[1]];
    });
  }

  // The way of each dot.
  get ways() {
    const steps = this.shape.times.map((t, k) => this.at(t, this.shape.keys[k]));
    const ways = this.dots.map((_, k) => steps.map((points) => points[k]));
    Object.defineProperty(this, "ways", { value: ways });
    return ways;
  }
}
