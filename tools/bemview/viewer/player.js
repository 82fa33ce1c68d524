// Time: playing, stepping and looping. Places are frames with parts of the way to the next one.

export const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 4];

/** The greatest speed, not above that of the clock, at which a run takes four seconds. */
export function speedFor(duration) {
  if (!(duration > 0)) return 1;
  return [...SPEEDS].reverse().find((speed) => speed <= 1 && duration / speed >= 3.9) ?? SPEEDS[0];
}

export class Player {
  /** `changed(place)` is called when there is another place to show. */
  constructor(recording, changed) {
    this.recording = recording;
    this.changed = changed;
    this.speed = speedFor(recording.duration);
    this.loop = true;
    this.playing = false;
    this.place = 0;
  }

  get last() {
    return this.recording.ready - 1;
  }

  goTo(place) {
    this.place = Math.min(Math.max(0, place), this.last);
    this.changed(this.place);
  }

  goToTime(time) {
    this.goTo(this.recording.placeOf(time));
  }

  /** Stops, and goes to a whole frame. */
  step(frames) {
    this.playing = false;
    const from = frames > 0 ? Math.floor(this.place + 1e-6) : Math.ceil(this.place - 1e-6);
    this.goTo(from + frames);
  }

  toggle() {
    this.playing = !this.playing && this.recording.frames > 1;
    if (this.playing && this.place >= this.recording.frames - 1) this.place = 0;
    this.changed(this.place);
  }

  /** Goes on by `seconds` of the clock. */
  advance(seconds) {
    if (!this.playing) return;
    const { times, frames, duration } = this.recording;
    let time = this.recording.timeOf(this.place) + seconds * this.speed;
    if (time >= times[frames - 1] && this.last === frames - 1) {
      if (this.loop) time = times[0] + ((time - times[0]) % duration);
      else this.playing = false;
    }
    this.goToTime(time);
  }
}
