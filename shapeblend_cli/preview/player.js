// What plays a blend: where it is in time, and how it goes on.

import { easing } from "./values.js";

export class Player {
  // `shown` is told whenever the time has changed, `played` when it begins or ends to play.
  constructor(timing, pairs, { shown, played }) {
    Object.assign(this, {
      shown, played,
      from: 0, // what is shown: from this drawing
      to: pairs, // to this one
      now: 0, // the drawing that was left last, and the share of the way to the next
      playing: false, forwards: true, speed: 1,
      left: Infinity, // runs
      before: null,
    });
    this.time(timing);
  }

  time({ seconds, ease, repeat }) {
    this.seconds = seconds;
    this.repeat = String(repeat); // a number of runs, or forever, or pingpong
    ({ at: this.eased, timeOf: this.timeOf } = easing(ease));
  }

  get pair() {
    return Math.min(Math.floor(this.now), this.to - 1);
  }

  get t() {
    return this.now - this.pair;
  }

  repeatAs(repeat) {
    this.repeat = repeat;
    this.left = Number(repeat) || Infinity;
    this.forwards = true;
  }

  seek(now) {
    this.now = Math.min(Math.max(now, this.from), this.to);
    this.shown();
  }

  play(playing) {
    if (playing && this.repeat !== "pingpong" && this.now >= this.to) this.now = this.from;
    if (playing && !this.playing) {
      this.left = Number(this.repeat) || Infinity;
      this.before = null;
      requestAnimationFrame((time) => this.tick(time));
    }
    this.playing = playing;
    this.played(playing);
  }

  tick(time) {
    if (!this.playing) return;
    const passed = this.before === null ? 0 : Math.min((time - this.before) / 1000, 0.25);
    this.before = time;
    const { pair, from, to } = this;
    const way = (this.forwards ? 1 : -1) * (passed * this.speed) / this.seconds;
    let moved = pair + this.timeOf(this.now - pair) + way;
    if (moved > to || moved < from) {
      if (this.repeat === "pingpong") {
        this.forwards = moved < from;
        moved = this.forwards ? 2 * from - moved : 2 * to - moved;
      } else if (--this.left > 0) {
        moved = from + ((moved - to) % (to - from));
      } else {
        moved = to;
      }
    }
    moved = Math.min(Math.max(moved, from), to);
    const next = Math.min(Math.floor(moved), to - 1);
    this.now = next + this.eased(moved - next);
    this.shown();
    if (this.left === 0) this.play(false);
    else requestAnimationFrame((later) => this.tick(later));
  }
}

const ICONS = { play: "M8 5l12 7-12 7z", pause: "M7 5h4v14H7zM13 5h4v14h-4z" };

export function showPlaying(button, icon, playing) {
  button.setAttribute("aria-label", playing ? "Pause" : "Play");
  icon.setAttribute("d", playing ? ICONS.pause : ICONS.play);
}
