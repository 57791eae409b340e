// The blend that moves: picture, time, moments in a row.

import { at, drawn, mixed } from "./values.js";
import { Picture, Scene } from "./picture.js";
import { Player, showPlaying } from "./player.js";
import { coloured, Filmstrip, tinted } from "./parts.js";
import { Zoom } from "./zoom.js";

const SKINS = [0, 0.25, 0.5, 0.75, 1];
const MOMENTS = 9;

export class Stage {
  // `chosen` is told of the pair that is shown, if that changes.
  constructor(chosen) {
    this.chosen = chosen;
    this.scenes = [];
    this.isTinted = false;
    this.pair = 0;
    this.player = new Player({ seconds: 2, ease: [0, 0, 1, 1], repeat: "forever" }, 1, {
      shown: () => this.draw(),
      played: (playing) => showPlaying(at("play"), at("play-icon"), playing),
    });
    this.player.seek(0.5);
    this.zoom = new Zoom(at("drawing"), {
      view: () => this.scenes[this.pair]?.view(this.player.t),
      changed: () => this.draw(),
      drags: () => true,
    });
    this.film = new Filmstrip(at("film"), MOMENTS, (t) => this.go(this.pair + t));
    at("play").addEventListener("click", () => this.player.play(!this.player.playing));
    at("time").addEventListener("input", () => this.go(Number(at("time").value)));
    at("show-onion").addEventListener("change", () => this.onion());
    at("show-tint").addEventListener("change", () => this.tint(at("show-tint").checked));
    this.player.played(false);
  }

  show({ pairs, decimals, timing }) {
    this.pairs = pairs;
    this.scenes = pairs.map((pair) => new Scene(pair, pair.views, decimals));
    this.pictures = this.scenes.map((scene) => new Picture(scene, at("picture")));
    this.orders = pairs.map(({ contours }, k) => bySize(this.scenes[k], contours));
    this.colours = pairs.map(({ contours }, k) => coloured(contours, this.orders[k]));
    this.player.to = pairs.length;
    this.player.time(timing);
    at("time").max = pairs.length;
    this.player.seek(this.player.now);
    this.pair = -1;
    this.draw();
  }

  tint(isOn) {
    this.isTinted = isOn;
    if (!this.scenes.length) return;
    this.pair = -1;
    this.draw();
  }

  go(now) {
    this.player.play(false);
    this.player.seek(now);
  }

  draw() {
    if (!this.scenes.length) return;
    const { pair, t } = this.player;
    const isOther = pair !== this.pair;
    this.pair = pair;
    const scene = this.scenes[pair];
    const over = (time, points) => tinted(scene, this.pairs[pair].contours, this.colours[pair], this.orders[pair], points);
    const points = this.pictures[pair].show(t);
    at("drawing").setAttribute("viewBox", this.zoom.box(scene.view(t)).join(" "));
    at("picture").classList.toggle("faded", this.isTinted);
    at("parts").replaceChildren(...(this.isTinted ? over(t, points) : []));
    at("time").value = this.player.now;
    at("time").setAttribute("aria-valuetext", `${Math.round(100 * t)} % of the way`);
    at("clock").textContent = t.toFixed(2);
    if (isOther) {
      this.film.show(scene, this.isTinted ? over : null);
      this.onion();
      this.chosen(pair);
    }
    this.film.mark(t);
    at("timeline").style.setProperty("--now", Math.min(Math.max(t, 0), 1));
  }

  onion() {
    const group = at("onion");
    group.replaceChildren();
    if (!at("show-onion").checked || !this.scenes.length) return;
    const scene = this.scenes[this.pair];
    for (const t of SKINS) {
      const d = scene.outlines(t);
      group.append(drawn("path", { class: "halo", d }), drawn("path", { d, stroke: mixed("#1f5fbf", "#c2410c", t) }));
    }
  }
}

// Numbers of contours, the largest first.
function bySize(scene, contours) {
  const sizes = contours.map(({ shape, outline }) => {
    const { keys, outlines } = scene.shapes[shape];
    const { start, ends } = outlines[outline];
    return Math.max(...[keys[0], keys[keys.length - 1]].map((points) => {
      let [left, right, top, bottom] = [Infinity, -Infinity, Infinity, -Infinity];
      for (let k = start; k < (ends.length ? ends[ends.length - 1] + 2 : start + 2); k += 2) {
        left = Math.min(left, points[k]);
        right = Math.max(right, points[k]);
        top = Math.min(top, points[k + 1]);
        bottom = Math.max(bottom, points[k + 1]);
      }
      return Math.hypot(right - left, bottom - top);
    }));
  });
  return contours.map((_, k) => k).sort((p, q) => sizes[q] - sizes[p]);
}
