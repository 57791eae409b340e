// The graph of a correspondence: the work of other paths, and a canvas that shows it.

import { at, figures, made, mixed, unpacked } from "./values.js";

const PALETTES = {
  light: {
    ramp: ["#123c69", "#1f6f8b", "#5aa9a3", "#b5d6c3", "#ece9df"],
    ground: "#f4f2ec", none: "#d9d5cb", ink: "#4a4e56", best: "#d9480f",
    other: "#a3218a", halo: "#ffffff", guide: "#1c1e22",
  },
  dark: {
    ramp: ["#d9f3ee", "#74c6c8", "#2f7d93", "#1f4a63", "#1c2630"],
    ground: "#1a1f27", none: "#101318", ink: "#b4bac4", best: "#ff9a4d",
    other: "#ff8be6", halo: "#14161a", guide: "#ffffff",
  },
};
export const isDark = () => {
  const theme = document.documentElement.dataset.theme;
  return theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
};
const palette = () => PALETTES[isDark() ? "dark" : "light"];

// Extra work, in units of the least, from which the scale begins to tell apart, and at which it ends.
const [FIRST, LAST] = [1e-3, 100];
const height = (extra) => Math.min(Math.log1p(extra / FIRST) / Math.log1p(LAST / FIRST), 1);

function shade(level, ramp) {
  const x = level * (ramp.length - 1);
  const k = Math.min(Math.floor(x), ramp.length - 2);
  return mixed(ramp[k], ramp[k + 1], x - k);
}

// East, South and Southeast, as columns and rows.
const MOVES = [[1, 0], [0, 1], [1, 1]];

export class Landscape {
  constructor(told, works, step, before, after) {
    Object.assign(this, told, { step, before, after });
    const { rows, columns } = told;
    const half = works.length / 2;
    this.heights = new Uint16Array(half);
    for (let c = 0; c < columns; c++) {
      let level = 0;
      for (let r = 0; r < rows; r++) {
        const k = c * rows + r;
        level = (level + works[k] + 256 * works[half + k]) & 65535;
        this.heights[k] = level;
      }
    }
  }

  static async from(told) {
    const tables = [];
    for (const name of ["works", "step", "before", "after"]) tables.push(await unpacked(told[name]));
    return new Landscape(told, ...tables);
  }

  // What the least path through a dot costs more than the best one; null where there is none.
  extra(column, row) {
    const level = this.heights[column * this.rows + row];
    return level > this.levels ? null : this.unit * this.finest * Math.expm1((level / this.levels) * this.top);
  }

  // The least path through a dot: back from it to the start, and on to the end.
  path(column, row) {
    const byte = (table, c, r, step) => (table[c * this.rows + r] >> (2 * step)) & 3;
    const back = [];
    let [c, r, step] = [column, row, this.step[column * this.rows + row]];
    while (c || r) {
      back.push([c, r]);
      [c, r] = [c - MOVES[step][0], r - MOVES[step][1]];
      step = byte(this.before, c, r, step);
    }
    const path = [[0, 0], ...back.reverse()];
    [c, r, step] = [column, row, this.step[column * this.rows + row]];
    while (c < this.columns - 1 || r < this.rows - 1) {
      step = byte(this.after, c, r, step);
      [c, r] = [c + MOVES[step][0], r + MOVES[step][1]];
      path.push([c, r]);
    }
    return path;
  }
}

export class Graph {
  // `pointed` is told of the dot that the cursor is on.
  constructor(canvas, contour, dots, { letters, band, pointed }) {
    Object.assign(this, { canvas, letters, band, pointed, landscape: null, image: null, cursor: null, dot: null, chosen: null });
    const { closed, counts } = contour;
    [this.m, this.n] = counts;
    this.start = dots[0];
    [this.columns, this.rows] = closed ? [this.m + 1, this.n + 1] : [this.m, this.n];
    // The path on from the start; each step is East, South or Southeast.
    this.path = [[0, 0]];
    const last = closed ? [...dots, dots[0]] : dots;
    for (let k = 1; k < last.length; k++) {
      const [c, r] = this.path[k - 1];
      this.path.push([c + ((last[k][0] - last[k - 1][0] + this.m) % this.m), r + ((last[k][1] - last[k - 1][1] + this.n) % this.n)]);
    }
    this.zoom = 1;
    this.centre = [(this.columns - 1) / 2, (this.rows - 1) / 2];
  }

  vertices(column, row) {
    return [(this.start[0] + column) % this.m, (this.start[1] + row) % this.n];
  }

  layout() {
    const { width, height } = this.canvas.getBoundingClientRect();
    const box = { left: 44, top: 28, width: Math.max(width - 54, 1), height: Math.max(height - 36, 1) };
    const room = 7; // for the ends of the path
    const scale = [(this.zoom * (box.width - 2 * room)) / this.columns, (this.zoom * (box.height - 2 * room)) / this.rows];
    for (const [k, count] of [this.columns, this.rows].entries()) {
      const half = count / this.zoom / 2;
      this.centre[k] = Math.min(Math.max(this.centre[k], half - 0.5), count - 0.5 - half);
    }
    const x = (c) => box.left + box.width / 2 + (c - this.centre[0]) * scale[0];
    const y = (r) => box.top + box.height / 2 + (r - this.centre[1]) * scale[1];
    return { width, height, box, scale, x, y };
  }

  cellAt(clientX, clientY) {
    const { box, scale } = this.layout();
    const corner = this.canvas.getBoundingClientRect();
    const along = (value, from, size, k) => Math.round((value - from - size / 2) / scale[k] + this.centre[k]);
    const column = along(clientX - corner.left, box.left, box.width, 0);
    const row = along(clientY - corner.top, box.top, box.height, 1);
    const inside = column >= 0 && row >= 0 && column < this.columns && row < this.rows;
    return inside ? [column, row] : null;
  }

  paint(landscape) {
    this.landscape = landscape;
    this.repaint();
  }

  repaint() {
    this.image = null;
    this.draw();
  }

  // A dot of the path, and another path through a chosen dot; null for none.
  show(dot, chosen) {
    Object.assign(this, { dot, chosen });
    this.draw();
  }

  heat() {
    const { columns, rows, landscape } = this;
    const colours = palette();
    const channels = (colour) => [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
    const table = Array.from({ length: 257 }, (_, k) => channels(shade(k / 256, colours.ramp)));
    const none = channels(colours.none);
    const pixels = new ImageData(columns, rows);
    for (let c = 0; c < columns; c++) {
      for (let r = 0; r < rows; r++) {
        const extra = landscape.extra(c, r);
        const colour = extra === null ? none : table[Math.round(256 * height(extra / landscape.unit))];
        const k = 4 * (r * columns + c);
        [pixels.data[k], pixels.data[k + 1], pixels.data[k + 2], pixels.data[k + 3]] = [...colour, 255];
      }
    }
    const image = document.createElement("canvas");
    [image.width, image.height] = [columns, rows];
    image.getContext("2d").putImageData(pixels, 0, 0);
    return image;
  }

  draw() {
    const { canvas, columns, rows } = this;
    const { width, height, box, scale, x, y } = this.layout();
    if (!width) return;
    const ratio = window.devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    }
    canvas.classList.toggle("zoomed", this.zoom > 1);
    const colours = palette();
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.save();
    pen.beginPath();
    pen.roundRect(box.left, box.top, box.width, box.height, 6);
    pen.clip();
    pen.fillStyle = colours.ground;
    pen.fillRect(box.left, box.top, box.width, box.height);
    if (this.landscape) {
      this.image ??= this.heat();
      pen.imageSmoothingEnabled = false;
      pen.drawImage(this.image, x(-0.5), y(-0.5), columns * scale[0], rows * scale[1]);
    }
    this.guides(pen, x, y, colours);
    this.line(pen, x, y, scale, this.path, colours.best, colours.halo);
    if (this.chosen) {
      this.line(pen, x, y, scale, this.chosen.path, colours.other, colours.halo);
      this.mark(pen, x(this.chosen.column), y(this.chosen.row), colours.other, colours.halo);
    }
    if (this.dot !== null) this.mark(pen, x(this.path[this.dot][0]), y(this.path[this.dot][1]), colours.best, colours.halo);
    if (this.cursor) this.cross(pen, box, x(this.cursor[0]), y(this.cursor[1]), colours.guide);
    pen.restore();
    this.axes(pen, box, scale, x, y, colours);
  }

  // The diagonal, and the band around it.
  guides(pen, x, y, colours) {
    const [c, r] = [this.columns - 1, this.rows - 1];
    const { band } = this;
    pen.strokeStyle = colours.guide;
    pen.lineWidth = 1;
    for (const shift of band === null ? [0] : [0, -band, band]) {
      pen.globalAlpha = shift ? 0.9 : 0.3;
      pen.setLineDash(shift ? [6, 4] : [2, 4]);
      pen.beginPath();
      pen.moveTo(x(0), y(shift * r));
      pen.lineTo(x(c), y((1 + shift) * r));
      pen.stroke();
    }
    pen.globalAlpha = 1;
    pen.setLineDash([]);
  }

  line(pen, x, y, scale, path, colour, halo) {
    pen.lineJoin = pen.lineCap = "round";
    for (const [stroke, width] of [[halo, 4.5], [colour, 2.25]]) {
      pen.strokeStyle = stroke;
      pen.lineWidth = width;
      pen.beginPath();
      path.forEach(([c, r], k) => (k ? pen.lineTo(x(c), y(r)) : pen.moveTo(x(c), y(r))));
      pen.stroke();
    }
    if (Math.min(...scale) < 7) return;
    pen.fillStyle = colour;
    for (const [c, r] of path) {
      pen.beginPath();
      pen.arc(x(c), y(r), 3.5, 0, 7);
      pen.fill();
    }
  }

  mark(pen, x, y, colour, halo) {
    pen.beginPath();
    pen.arc(x, y, 6.5, 0, 7);
    pen.fillStyle = colour;
    pen.strokeStyle = halo;
    pen.lineWidth = 2.5;
    pen.fill();
    pen.stroke();
  }

  cross(pen, box, x, y, colour) {
    pen.strokeStyle = colour;
    pen.globalAlpha = 0.5;
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(x, box.top);
    pen.lineTo(x, box.top + box.height);
    pen.moveTo(box.left, y);
    pen.lineTo(box.left + box.width, y);
    pen.stroke();
    pen.globalAlpha = 1;
  }

  axes(pen, box, scale, x, y, colours) {
    pen.fillStyle = colours.ink;
    pen.font = "12px system-ui, sans-serif";
    const [a, b] = this.letters;
    const marks = (k, count, modulus) => {
      const least = 46 / scale[k];
      const step = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000].find((size) => size >= least) ?? 20000;
      // Round vertex numbers, and where a closed wire comes back to 0.
      return Array.from({ length: count }, (_, c) => [c, (this.start[k] + c) % modulus]).filter(
        ([c, v]) => v % step === 0 && (v === 0 || modulus - v >= step * 0.6 || c === 0),
      );
    };
    pen.textAlign = "center";
    pen.textBaseline = "bottom";
    for (const [c, v] of marks(0, this.columns, this.m)) {
      if (x(c) > box.left + 44 && x(c) < box.left + box.width - 4) pen.fillText(v, x(c), box.top - 5);
    }
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const [r, v] of marks(1, this.rows, this.n)) {
      if (y(r) > box.top + 24 && y(r) < box.top + box.height - 4) pen.fillText(v, box.left - 7, y(r));
    }
    pen.font = "600 12px system-ui, sans-serif";
    pen.fillText(`${b} ↓`, box.left - 7, box.top + 8);
    pen.textAlign = "left";
    pen.textBaseline = "bottom";
    pen.fillText(`${a} →`, box.left, box.top - 5);
  }

  zoomBy(factor, clientX = null, clientY = null) {
    const before = clientX === null ? null : this.under(clientX, clientY);
    const most = Math.max(1, Math.max(this.columns, this.rows) / 6);
    this.zoom = Math.min(Math.max(this.zoom * factor, 1), most);
    if (before) {
      const after = this.under(clientX, clientY);
      this.centre = this.centre.map((value, k) => value + before[k] - after[k]);
    } else if (this.cursor) {
      this.centre = [...this.cursor];
    }
    this.draw();
  }

  under(clientX, clientY) {
    const { box, scale } = this.layout();
    const corner = this.canvas.getBoundingClientRect();
    return [
      (clientX - corner.left - box.left - box.width / 2) / scale[0] + this.centre[0],
      (clientY - corner.top - box.top - box.height / 2) / scale[1] + this.centre[1],
    ];
  }

  pan(dx, dy) {
    const { scale } = this.layout();
    this.centre = [this.centre[0] - dx / scale[0], this.centre[1] - dy / scale[1]];
    this.draw();
  }

  fit() {
    this.zoom = 1;
    this.draw();
  }

  point(cell) {
    this.cursor = cell;
    this.pointed(cell);
    this.draw();
  }

  // Moves the cursor, and the window after it.
  step(dx, dy) {
    const from = this.cursor ?? (this.chosen ? [this.chosen.column, this.chosen.row] : this.path[0]);
    const clamp = (value, count) => Math.min(Math.max(value, 0), count - 1);
    const cell = [clamp(from[0] + dx, this.columns), clamp(from[1] + dy, this.rows)];
    for (const [k, count] of [this.columns, this.rows].entries()) {
      const half = count / this.zoom / 2 - 1;
      this.centre[k] = Math.min(Math.max(this.centre[k], cell[k] - half), cell[k] + half);
    }
    this.point(cell);
  }
}

// Explain the shades of a landscape, if there is one, as shares of the least work if that is not 0.
export function legend(landscape, isRelative) {
  at("legend").hidden = !landscape;
  if (!landscape) return;
  const canvas = at("ramp");
  [canvas.width, canvas.height] = [256, 1];
  const pen = canvas.getContext("2d");
  for (let k = 0; k < 256; k++) {
    pen.fillStyle = shade(k / 255, palette().ramp);
    pen.fillRect(k, 0, 1, 1);
  }
  const labels = [0, 0.01, 0.1, 1, 10, 100].map((extra) => {
    const text = isRelative ? `+${100 * extra} %` : `+${figures(extra * landscape.unit, 2)}`;
    const mark = made("span", {}, extra === 0 ? "least" : extra === LAST ? "more" : text);
    mark.style.left = `${100 * height(extra)}%`;
    return mark;
  });
  at("ticks").replaceChildren(...labels);
}

// Zoom, move and choose in the graph that is there at the time; `chosen` is told of the dot.
export function listenToGraph(canvas, current, chosen) {
  const fingers = new Map();
  let moved = 0;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (!fingers.size) moved = 0;
    fingers.set(event.pointerId, event);
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) {
      current().point(current().cellAt(event.clientX, event.clientY));
      return;
    }
    const [dx, dy] = [event.clientX - last.clientX, event.clientY - last.clientY];
    moved += Math.hypot(dx, dy);
    const apart = () => {
      const [p, q] = [...fingers.values()];
      const middle = [(p.clientX + q.clientX) / 2, (p.clientY + q.clientY) / 2];
      return { far: Math.hypot(p.clientX - q.clientX, p.clientY - q.clientY), middle };
    };
    const was = fingers.size === 2 ? apart() : null;
    fingers.set(event.pointerId, event);
    if (was) {
      moved = Infinity;
      const now = apart();
      current().zoomBy(now.far / Math.max(was.far, 1), ...now.middle);
      current().pan(now.middle[0] - was.middle[0], now.middle[1] - was.middle[1]);
    } else if (current().zoom > 1 && moved > 5) {
      current().pan(dx, dy);
    }
  });
  canvas.addEventListener("pointerup", (event) => {
    fingers.delete(event.pointerId);
    if (moved > 5) return;
    chosen(current().cellAt(event.clientX, event.clientY));
  });
  canvas.addEventListener("pointercancel", (event) => {
    fingers.delete(event.pointerId);
    moved = Infinity;
  });
  canvas.addEventListener("pointerleave", () => current()?.point(null));
  canvas.addEventListener("blur", () => current()?.point(null));
  canvas.addEventListener("wheel", (event) => {
    if (event.deltaY > 0 && current().zoom === 1) return; // all is shown: the page scrolls
    event.preventDefault();
    current().zoomBy(Math.exp(-event.deltaY / 400), event.clientX, event.clientY);
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const far = event.shiftKey ? 10 : 1;
    const moves = { ArrowLeft: [-far, 0], ArrowRight: [far, 0], ArrowUp: [0, -far], ArrowDown: [0, far] };
    const acts = {
      "+": () => current().zoomBy(1.6),
      "=": () => current().zoomBy(1.6), // the same key without shift
      "-": () => current().zoomBy(1 / 1.6),
      0: () => current().fit(),
      Enter: () => chosen(current().cursor),
    };
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (moves[event.key]) current().step(...moves[event.key]);
    else if (acts[event.key]) acts[event.key]();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
}
