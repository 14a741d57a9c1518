/* player_motion.js - plays a recorded motion in a page: canvas, no libraries, no network.
 *
 * The page has a JSON text (document.py): signs, each place with the number of the body that carries it (-1: the
 * ground, -2: a place that is followed), and the motion of the bodies at recorded times.  Between two of them
 * bodies move along straight lines and turn evenly.  At a jump there are two rows with the same time. */
"use strict";

const ENERGIES = ["kinetic", "potential", "total"];
const INCH = { coil: 0.065, hatch: 0.075, hatchStep: 0.085, block: [0.12, 0.065], weld: 0.032 };

/* ---- numbers ---- */
function unpack(packed) {
  if ("one" in packed) return new Float32Array(packed.n).fill(packed.one);
  const text = atob(packed.f || packed.u);
  const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  if (packed.f) return new Float32Array(bytes.buffer);
  const steps = new Uint16Array(bytes.buffer);
  const size = (packed.high - packed.low) / 65535;
  return Float32Array.from(steps, (step) => packed.low + step * size);
}

/* The last row not after t, and how far t is on the way to the next. */
function rowAt(times, t) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle - 1;
  }
  const next = Math.min(low + 1, times.length - 1);
  const span = times[next] - times[low];
  return { row: low, next, part: span > 0 ? Math.min(Math.max((t - times[low]) / span, 0), 1) : 0 };
}

function between(values, at) {
  return values[at.row] + at.part * (values[at.next] - values[at.row]);
}

class Motion {
  constructor(told) {
    this.told = told;
    this.times = unpack(told.t);
    this.end = this.times[this.times.length - 1];
    this.bodies = told.bodies.map((body) => ({
      name: body.name,
      x: unpack(body.x), y: unpack(body.y), angle: body.angle && unpack(body.angle),
      vx: unpack(body.vx), vy: unpack(body.vy),
    }));
    const followed = told.followed;
    this.followed = followed && { times: unpack(followed.t), x: followed.x.map(unpack), y: followed.y.map(unpack) };
    this.energies = {};
    for (const kind of ENERGIES) if (told.energies[kind]) this.energies[kind] = unpack(told.energies[kind]);
    const arrows = (list) => list.map((one) => ({ name: one.name, at: one.at, x: unpack(one.x), y: unpack(one.y) }));
    this.forces = arrows(told.forces);
    this.impulses = arrows(told.impulses);
    this.events = told.events.map((event) => ({ ...event, t: this.times[event.row] }));
  }

  /* Where everything is at a time; a row chooses the side of a jump. */
  look(t, row) {
    const at = row === undefined ? rowAt(this.times, t) : { row, next: row, part: 0 };
    const poses = this.bodies.map((body) => {
      const angle = body.angle ? between(body.angle, at) : 0;
      return { x: between(body.x, at), y: between(body.y, at), c: Math.cos(angle), s: Math.sin(angle) };
    });
    const other = this.followed && rowAt(this.followed.times, this.times[at.row] === t ? t : t);
    return { t, at, poses, other };
  }

  place(look, [carrier, x, y]) {
    if (carrier === -1) return [x, y];
    if (carrier === -2) return [between(this.followed.x[x], look.other), between(this.followed.y[x], look.other)];
    const pose = look.poses[carrier];
    return [pose.x + pose.c * x - pose.s * y, pose.y + pose.s * x + pose.c * y];
  }

  /* The way of a place up to a time, with enough corners where its carrier turns. */
  way(anchor, until) {
    const found = [];
    const body = anchor[0] >= 0 ? this.bodies[anchor[0]] : null;
    for (let row = 0; row < this.times.length && this.times[row] <= until; row++) {
      const to = Math.min(until, row + 1 < this.times.length ? this.times[row + 1] : until);
      const turn = body && body.angle && row + 1 < this.times.length ? Math.abs(body.angle[row + 1] - body.angle[row]) : 0;
      const parts = Math.min(200, 1 + Math.floor(turn / 0.1));
      for (let k = 0; k < parts; k++) found.push(this.place(this.look(this.times[row] + (k / parts) * (to - this.times[row])), anchor));
    }
    found.push(this.place(this.look(until), anchor));
    return found;
  }

  /* The event before or after a time (direction -1 or 1); the start or the end where there is none. */
  neighbour(t, direction) {
    const close = 1e-6 * this.end;
    const list = direction > 0 ? this.events : [...this.events].reverse();
    const found = list.find((event) => (event.t - t) * direction > close);
    return found || { t: direction > 0 ? this.end : 0, row: undefined, name: "" };
  }
}

/* Round numbers for an axis: 1, 2 or 5 times a power of ten. */
function niceStep(range, count) {
  const rough = range / Math.max(count, 1);
  const power = Math.pow(10, Math.floor(Math.log10(rough)));
  return power * [1, 2, 5, 10].find((step) => step * power >= rough * 0.999);
}

function shown(value, digits = 4) {
  if (!isFinite(value)) return "-";
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(digits)));
}
