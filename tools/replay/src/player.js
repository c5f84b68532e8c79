// Time: which two frames are shown and how far between them; playing goes by the clock, not by drawn pictures.

export const speeds = [1 / 1000, 1 / 500, 1 / 200, 1 / 100, 1 / 50, 1 / 20, 1 / 10, 1 / 5, 1 / 2, 1, 2, 5, 10];
const kWholeRunSeconds = 8; // duration of playing a whole run, at first

export class Player {
  constructor(frames, onChange) {
    this.frames = frames;
    this.onChange = onChange;
    this.first = frames[0].time, (this.last = frames.at(-1).time);
    this.time = this.first;
    this.playing = false;
    this.loop = false;
    const wanted = (this.last - this.first) / kWholeRunSeconds;
    this.speed = speeds.reduce((best, s) => (Math.abs(Math.log(s / wanted)) < Math.abs(Math.log(best / wanted)) ? s : best), 1);
  }

  /** Index of the last frame not after the time. */
  index() {
    let low = 0, high = this.frames.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.frames[middle].time <= this.time + 1e-12) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** The neighbouring frames a and b and the share of the time between them. */
  between() {
    const k = this.index();
    const a = this.frames[k], b = this.frames[Math.min(k + 1, this.frames.length - 1)];
    const span = b.time - a.time;
    return { index: k, a, b, share: span > 0 ? Math.min(1, Math.max(0, (this.time - a.time) / span)) : 0 };
  }

  seek(time) {
    this.time = Math.min(this.last, Math.max(this.first, time));
    this.onChange();
  }

  step(count) {
    this.pause();
    const { index, share } = this.between();
    const from = count < 0 && share > 0 ? index + 1 : index;
    this.seek(this.frames[Math.min(this.frames.length - 1, Math.max(0, from + count))].time);
  }

  play() {
    if (this.time >= this.last) this.time = this.first;
    this.playing = true;
    this.onChange();
  }

  pause() {
    this.playing = false;
    this.onChange();
  }

  toggle() {
    this.playing ? this.pause() : this.play();
  }

  faster(by) {
    const at = speeds.indexOf(this.speed) + by;
    this.speed = speeds[Math.min(speeds.length - 1, Math.max(0, at))];
    this.onChange();
  }

  /** Advances by the seconds that have passed. */
  advance(seconds) {
    if (!this.playing) return;
    const next = this.time + seconds * this.speed;
    if (next < this.last) return this.seek(next);
    if (this.loop) return this.seek(this.first + ((next - this.last) % (this.last - this.first || 1)));
    this.playing = false;
    this.seek(this.last);
  }
}
