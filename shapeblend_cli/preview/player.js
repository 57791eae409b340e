// What plays a blend: where it is in time, and how it goes on.

import { easing } from "./values.js";

export class Player {
  // `shown` is told whenever the time has changed, `played` when it begins or ends to play.
  constructor(timing, pairs, { shown, played }) {
    Object.assign(this, {
      shown, played,
      from: 0, // what is shown: from this drawing
      to: pairs, // to this one
      pair: 0, // the drawing that was left last
      t: 0, // the way to the next one, as the easing has it: perhaps beyond both
      clock: 0, // drawings that were reached, and the share of the time to the next one
      rest: 0, // seconds that it still stands at a drawing
      playing: false, forwards: true, speed: 1,
      left: Infinity, // runs
      before: null,
    });
    this.time(timing);
  }

  time({ seconds, ease, repeat, hold = [0, 0] }) {
    this.seconds = seconds;
    this.hold = hold; // seconds of rest at the first drawing, and at each of the others
    this.repeat = String(repeat); // a number of runs, or forever, or pingpong
    ({ at: this.eased, timeOf: this.timeOf } = easing(ease));
  }

  // The way, but not beyond either drawing.
  get share() {
    return Math.min(Math.max(this.t, 0), 1);
  }

  get now() {
    return this.pair + this.share;
  }

  repeatAs(repeat) {
    this.repeat = repeat;
    this.left = Number(repeat) || Infinity;
    this.forwards = true;
  }

  seek(now) {
    const place = Math.min(Math.max(now, this.from), this.to);
    this.pair = Math.min(Math.floor(place), this.to - 1);
    this.t = place - this.pair;
    this.clock = this.pair + this.timeOf(this.t);
    this.rest = 0;
    this.shown();
  }

  play(playing) {
    if (playing && this.repeat !== "pingpong" && this.now >= this.to) this.seek(this.from);
    if (playing && !this.playing) {
      this.left = Number(this.repeat) || Infinity;
      this.before = null;
      if (Number.isInteger(this.clock)) this.rest = this.restAt(this.clock);
      requestAnimationFrame((time) => this.tick(time));
    }
    this.playing = playing;
    this.played(playing);
  }

  restAt(drawing) {
    return this.hold[drawing > 0 ? 1 : 0];
  }

  // Begins another run, and returns where it is.
  again(way) {
    this.rest = this.restAt(this.from);
    return this.rest ? this.from : this.from + way;
  }

  tick(time) {
    if (!this.playing) return;
    let passed = (this.before === null ? 0 : Math.min((time - this.before) / 1000, 0.25)) * this.speed;
    this.before = time;
    const rested = Math.min(this.rest, passed);
    this.rest -= rested;
    passed -= rested;
    if (passed > 0) this.move(passed / this.seconds);
    if (this.left === 0) this.play(false);
    else requestAnimationFrame((later) => this.tick(later));
  }

  move(way) {
    const { from, to, clock } = this;
    let moved = clock + (this.forwards ? way : -way);
    if (clock === to && this.forwards && this.repeat !== "pingpong") moved = this.again(way); // it has rested at the end
    const next = this.forwards ? Math.floor(clock) + 1 : Math.ceil(clock) - 1;
    const isReached = this.forwards ? moved >= next : moved <= next;
    if (isReached && next >= from && next <= to && this.restAt(next)) {
      moved = next;
      this.rest = this.restAt(next);
    }
    if (moved >= to || moved <= from) {
      if (this.repeat === "pingpong") {
        if (this.forwards === moved >= to) {
          this.forwards = !this.forwards;
          moved = this.forwards ? 2 * from - moved : 2 * to - moved;
        }
      } else if (moved >= to && --this.left > 0) {
        moved = this.rest ? to : this.again((moved - to) % (to - from));
      }
    }
    moved = Math.min(Math.max(moved, from), to);
    this.clock = moved;
    this.pair = Math.min(Math.floor(moved), to - 1);
    this.t = this.eased(moved - this.pair);
    this.shown();
  }
}

const ICONS = { play: "M8 5l12 7-12 7z", pause: "M7 5h4v14H7zM13 5h4v14h-4z" };

export function showPlaying(button, icon, playing) {
  button.setAttribute("aria-label", playing ? "Pause" : "Play");
  icon.setAttribute("d", playing ? ICONS.pause : ICONS.play);
}
