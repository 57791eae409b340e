// Elements, numbers for reading, values that were packed, and values between two others.

export const at = (id) => document.getElementById(id);
export const SVG = "http://www.w3.org/2000/svg";

export function made(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

export function drawn(tag, attributes = {}) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

export const figures = (value, digits = 4) =>
  value === 0 ? "0" : Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4 ? value.toExponential(2) : String(Number(value.toPrecision(digits)));
export const place = ([x, y]) => `${figures(x, 5)}, ${figures(y, 5)}`;
export const counted = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;
export const share = (value) => `${figures(100 * value, 3)} %`;

export function entries(list, rows, kind = null) {
  list.replaceChildren(
    ...rows.flatMap(([name, value, look]) => {
      const pair = [made("dt", look ? { class: look } : {}, name), made("dd", {}, value)];
      return kind ? [made("div", { class: kind }, ...pair)] : pair;
    }),
  );
}

// Puts a text on the clipboard, and says so on the button that was pressed.
export async function copy(text, button) {
  const said = button.dataset.says ?? button.textContent;
  button.dataset.says = said;
  let done = true;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Where pages may not write to the clipboard by themselves.
    const field = made("textarea", { readonly: "" });
    field.value = text;
    document.body.append(field);
    field.select();
    done = document.execCommand("copy");
    field.remove();
  }
  button.textContent = done ? "Copied" : "Not copied";
  setTimeout(() => (button.textContent = said), 1500);
}

export async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// ---- values between two others: every number and every channel of a colour goes evenly

const NUMBER = /#[0-9a-f]{6}|-?(?:\d+\.?\d*|\.\d+)(?:e-?\d+)?/gi;

export function mixed(first, second, u) {
  if (first === second || u === 0) return first;
  const ends = second.match(NUMBER) || [];
  if (first.replace(NUMBER, "0") !== second.replace(NUMBER, "0") || !ends.length) return first;
  let k = 0;
  return first.replace(NUMBER, (start) => {
    const end = ends[k++];
    if (start[0] !== "#" || end[0] !== "#") return String(Number(((1 - u) * start + u * end).toFixed(5)));
    const channel = (n) => {
      const [p, q] = [start, end].map((colour) => parseInt(colour.slice(n, n + 2), 16));
      return Math.round((1 - u) * p + u * q).toString(16).padStart(2, "0");
    };
    return `#${channel(1)}${channel(3)}${channel(5)}`;
  });
}

export function sampled(values, t) {
  if (values.length === 1) return [values[0], values[0], 0];
  const x = t * (values.length - 1);
  const k = Math.min(Math.floor(x), values.length - 2);
  return [values[k], values[k + 1], x - k];
}

// Along lines from knot to knot, [time, share].
function along(knots) {
  const on = (from, to) => (value) => {
    const k = Math.max(knots.findIndex((knot) => knot[from] >= value), 1);
    const [first, second] = [knots[k - 1], knots[k]];
    return first[to] + ((second[to] - first[to]) * (value - first[from])) / (second[from] - first[from] || 1);
  };
  return { at: on(0, 1), timeOf: on(1, 0) };
}

// A cubic curve by its inner control points, or knots, which may go beyond 0 and 1.
export function easing(ease) {
  if (Array.isArray(ease[0])) return along(ease);
  const [x1, y1, x2, y2] = ease;
  if (x1 === y1 && x2 === y2) return { at: (x) => x, timeOf: (y) => y };
  const curve = (p, q, s) => 3 * (1 - s) * (1 - s) * s * p + 3 * (1 - s) * s * s * q + s * s * s;
  const solved = (p, q, r, u) => (value) => {
    let [low, high] = [0, 1];
    for (let n = 0; n < 40; n++) {
      const middle = (low + high) / 2;
      if (curve(p, q, middle) < value) low = middle;
      else high = middle;
    }
    return curve(r, u, high);
  };
  return { at: solved(x1, x2, y1, y2), timeOf: solved(y1, y2, x1, x2) };
}
