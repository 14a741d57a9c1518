/* player.js - plays a recorded motion in a page: canvas, no libraries, no network.
 *
 * The page has a JSON text (moving.py): signs, each place with the number of the body that carries it (-1: the
 * ground, -2: a place that is followed), and the motion of the bodies at recorded times.  Between two of them
 * bodies move along straight lines and turn evenly.  At a jump there are two rows with the same time. */
"use strict";

const ENERGIES = ["kinetic", "potential", "total"];
const INCH = { coil: 0.065, arrow: 1.0, most: 1.7, hatch: 0.075, hatchStep: 0.085, block: [0.12, 0.065], weld: 0.032 };
const SPEEDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50];
const SLOWER = 6; // times, around an event
const FAR = 40; // times as large as the scene at its start: then the view follows the motion
const FLASH = 0.7; // seconds of a viewer for which a blow is shown

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

  /* The picture is much larger than what moves in it. */
  goesFar() {
    const [x0, y0, x1, y1] = this.told.box;
    return Math.max(x1 - x0, y1 - y0) > FAR * this.told.size;
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

/* A speed with which the whole run takes some seconds. */
function usualSpeed(end) {
  if (end >= 3 && end <= 25) return 1;
  const wanted = end / 8;
  return SPEEDS.reduce((best, speed) => (Math.abs(Math.log(speed / wanted)) < Math.abs(Math.log(best / wanted)) ? speed : best));
}

/* ---- drawing ---- */
class Stage {
  constructor(canvas, motion) {
    this.canvas = canvas;
    this.motion = motion;
    this.signs = [...motion.told.signs].sort((a, b) => a.order - b.order);
    this.names = mergedNames(motion, this.signs.filter((sign) => sign.kind === "name"));
    this.signs = this.signs.filter((sign) => sign.kind !== "name");
    this.traced = new Set();
    const still = motion.bodies.map((body) => body.angle === null);
    this.names.forEach((name, i) => { if (name.bold && name.at[0] >= 0 && still[name.at[0]]) this.traced.add(i); });
    this.zoom = 1;
    this.shift = [0, 0];
    this.fastest = Math.max(1e-300, ...motion.bodies.map((body) => body.vx.reduce((most, v, i) => Math.max(most, Math.hypot(v, body.vy[i])), 0)));
    this.strongest = usualGreatest(motion.forces, 0.98);
    this.hardest = usualGreatest(motion.impulses, 1);
  }

  resize() {
    const [x0, y0, x1, y1] = this.motion.told.box;
    const wide = this.canvas.clientWidth;
    const tall = Math.min(Math.max((wide * (y1 - y0)) / (x1 - x0), 240), Math.max(window.innerHeight - 250, 320));
    fit(this.canvas, wide, tall);
    this.ink = this.canvas.getContext("2d");
    this.scale = Math.min(wide / (x1 - x0), tall / (y1 - y0));
    this.middle = [(x0 + x1) / 2, (y0 + y1) / 2];
    this.size = [wide, tall];
    this.offsets = null;
    this.following = null;
  }

  reset() {
    this.zoom = 1;
    this.shift = [0, 0];
    this.following = null;
    this.offsets = null;
  }

  /* The bodies stay where they are in the view, which at first shows some times as much as the scene is large. */
  follow(look, wanted) {
    if (!wanted) return;
    const bodies = look.poses.length, at = look.poses.reduce((sum, pose) => [sum[0] + pose.x / bodies, sum[1] + pose.y / bodies], [0, 0]);
    const told = this.motion.told, scale = () => this.scale * this.zoom;
    if (!this.following) {
      this.zoom = Math.max(1, Math.min(...this.size) / (this.scale * 2.5 * told.size));
      this.shift = [-(at[0] - this.middle[0]) * scale(), (at[1] - this.middle[1]) * scale()];
      this.offsets = null;
    } else {
      this.shift[0] -= (at[0] - this.following[0]) * scale();
      this.shift[1] += (at[1] - this.following[1]) * scale();
    }
    this.following = at;
  }

  get inch() { return this.motion.told.inch * this.scale; } // pixels, whatever the zoom

  pixel([x, y]) {
    const scale = this.scale * this.zoom;
    return [
      this.size[0] / 2 + (x - this.middle[0]) * scale + this.shift[0],
      this.size[1] / 2 - (y - this.middle[1]) * scale + this.shift[1],
    ];
  }

  draw(look, shows, colours, blow) {
    const ink = this.ink;
    this.look = look;
    this.colours = colours;
    ink.clearRect(0, 0, ...this.size);
    this.grid();
    if (shows.traces) this.traces(look);
    for (const sign of this.signs) this.sign(sign, look);
    if (shows.velocities) this.velocities(look);
    if (shows.forces) this.arrows(this.motion.forces, look, this.strongest, "force");
    if (blow) this.blow(look, blow);
    if (shows.names) this.writeNames(look);
  }

  grid() {
    const ink = this.ink, [wide, tall] = this.size, scale = this.scale * this.zoom;
    const step = niceStep(wide / scale, 8);
    ink.strokeStyle = this.colours.grid;
    ink.fillStyle = this.colours.soft;
    ink.lineWidth = 1;
    ink.setLineDash([]);
    ink.font = "11px system-ui, 'DejaVu Sans', sans-serif";
    const low = [this.middle[0] - (wide / 2 + this.shift[0]) / scale, this.middle[1] - (tall / 2 - this.shift[1]) / scale];
    ink.beginPath();
    for (let k = Math.ceil(low[0] / step); k * step < low[0] + wide / scale; k++) {
      const x = Math.round(this.pixel([k * step, 0])[0]) + 0.5;
      ink.moveTo(x, 0);
      ink.lineTo(x, tall);
    }
    for (let k = Math.ceil(low[1] / step); k * step < low[1] + tall / scale; k++) {
      const y = Math.round(this.pixel([0, k * step])[1]) + 0.5;
      ink.moveTo(0, y);
      ink.lineTo(wide, y);
    }
    ink.stroke();
    const length = step * scale; // what a square of the grid is
    ink.strokeStyle = this.colours.soft;
    ink.beginPath();
    ink.moveTo(12, tall - 16);
    ink.lineTo(12, tall - 12);
    ink.lineTo(12 + length, tall - 12);
    ink.lineTo(12 + length, tall - 16);
    ink.stroke();
    ink.textAlign = "center";
    ink.textBaseline = "bottom";
    ink.fillText(`${shown(step)} ${this.motion.told.unit}`, 12 + length / 2, tall - 15);
  }

  begin(sign) {
    const ink = this.ink;
    ink.lineWidth = (sign.width || 1) * 1.35;
    ink.strokeStyle = this.colours[sign.stroke] || this.colours.ink;
    ink.fillStyle = this.colours[sign.fill] || "transparent";
    ink.setLineDash((sign.dashes || []).map((dash) => dash * 1.35));
    ink.lineJoin = ink.lineCap = "round";
    ink.beginPath();
  }

  sign(sign, look) {
    const places = sign.at.map((at) => this.pixel(this.motion.place(look, at)));
    this.begin(sign);
    (Stage.kinds[sign.kind] || Stage.kinds.line).call(this, places, sign);
  }

  path(places, closed) {
    places.forEach(([x, y], i) => (i ? this.ink.lineTo(x, y) : this.ink.moveTo(x, y)));
    if (closed) this.ink.closePath();
  }

  disc([x, y], radius, fill, stroke) {
    this.ink.beginPath();
    this.ink.arc(x, y, radius, 0, 2 * Math.PI);
    if (fill) this.ink.fill();
    if (stroke) this.ink.stroke();
  }

  /* An arrow by its tail and its length in pixels along (x, y), y up. */
  arrow([x, y], dx, dy, colour, width = 2) {
    const ink = this.ink, size = Math.hypot(dx, dy);
    if (size < 2) return;
    const ux = dx / size, uy = -dy / size, head = Math.min(9, 0.6 * size);
    const tip = [x + ux * size, y + uy * size], neck = [tip[0] - ux * head, tip[1] - uy * head];
    ink.setLineDash([]);
    ink.strokeStyle = ink.fillStyle = colour;
    ink.lineWidth = width;
    ink.beginPath();
    ink.moveTo(x, y);
    ink.lineTo(...neck);
    ink.stroke();
    ink.beginPath();
    ink.moveTo(...tip);
    ink.lineTo(neck[0] - uy * 0.42 * head, neck[1] + ux * 0.42 * head);
    ink.lineTo(neck[0] + uy * 0.42 * head, neck[1] - ux * 0.42 * head);
    ink.fill();
  }

  velocities(look) {
    this.motion.bodies.forEach((body, i) => {
      const size = (INCH.arrow * this.inch) / this.fastest;
      const at = this.pixel([look.poses[i].x, look.poses[i].y]);
      this.arrow(at, between(body.vx, look.at) * size, between(body.vy, look.at) * size, this.colours.velocity);
    });
  }

  arrows(list, look, greatest, role) {
    const most = INCH.most * this.inch;
    for (const one of list) {
      let x = (between(one.x, look.at) / greatest) * INCH.arrow * this.inch;
      let y = (between(one.y, look.at) / greatest) * INCH.arrow * this.inch;
      const cut = Math.min(1, most / Math.max(Math.hypot(x, y), 1e-9));
      this.arrow(this.pixel(this.motion.place(look, one.at)), x * cut, y * cut, this.colours[role]);
    }
  }

  /* The impulses of a blow, as thick arrows that fade. */
  blow(look, { event, fresh }) {
    const at = { row: event.row, next: event.row, part: 0 };
    this.ink.globalAlpha = 0.25 + 0.75 * fresh;
    for (const one of this.motion.impulses) {
      const size = (INCH.arrow * this.inch) / this.hardest;
      const place = this.pixel(this.motion.place(look, one.at));
      const x = between(one.x, at) * size, y = between(one.y, at) * size;
      if (Math.hypot(x, y) < 1) continue;
      this.ink.strokeStyle = this.colours.impulse;
      this.ink.lineWidth = 2;
      this.ink.setLineDash([]);
      this.disc(place, 6 + 10 * (1 - fresh), false, true);
      this.arrow(place, x, y, this.colours.impulse, 4);
    }
    this.ink.globalAlpha = 1;
  }

  traces(look) {
    for (const i of this.traced) {
      this.begin({ stroke: "trace", width: 1.1 });
      this.path(this.motion.way(this.names[i].at, look.t).map((place) => this.pixel(place)));
      this.ink.stroke();
    }
  }

  writeNames(look) {
    const ink = this.ink;
    const places = this.names.map((name) => this.pixel(this.motion.place(look, name.at)));
    if (!this.offsets) this.offsets = this.placed(places, look);
    ink.textAlign = "center";
    ink.textBaseline = "middle";
    this.boxes = this.names.map((name, i) => {
      const [dx, dy, wide] = this.offsets[i];
      const x = places[i][0] + dx, y = places[i][1] + dy;
      ink.font = font(name);
      ink.lineWidth = 3;
      ink.lineJoin = "round";
      ink.setLineDash([]);
      ink.strokeStyle = this.colours.paper;
      ink.strokeText(name.text, x, y);
      ink.fillStyle = this.colours[this.traced.has(i) ? "velocity" : name.stroke] || this.colours.ink;
      ink.fillText(name.text, x, y);
      return [x - wide / 2 - 3, y - 9, wide + 6, 18];
    });
  }

  /* For each name how far from its place it stands: where it covers least of signs and other names at first. */
  placed(places, look) {
    const inked = [];
    for (const sign of this.signs) {
      const corners = sign.at.map((at) => this.pixel(this.motion.place(look, at)));
      if (sign.kind === "circle") {
        const radius = (sign.size || 0) * this.scale * this.zoom;
        for (let k = 0; k < 24; k++) inked.push([corners[0][0] + radius * Math.cos(k * 0.2618), corners[0][1] + radius * Math.sin(k * 0.2618)]);
      }
      corners.forEach((end, i) => {
        const from = corners[Math.max(i - 1, 0)];
        const count = Math.min(60, 1 + Math.hypot(end[0] - from[0], end[1] - from[1]) / 6);
        for (let k = 0; k < count; k++) inked.push([from[0] + (k / count) * (end[0] - from[0]), from[1] + (k / count) * (end[1] - from[1])]);
      });
    }
    const taken = [];
    return this.names.map((name, i) => {
      this.ink.font = font(name);
      const wide = this.ink.measureText(name.text).width;
      let best = null;
      for (const far of [13, 19, 27, 38]) {
        for (let k = 0; k < 16; k++) {
          const turn = Math.PI / 4 + (k * Math.PI) / 8;
          const dx = Math.cos(turn) * (far + wide / 2 - 6), dy = -Math.sin(turn) * far;
          const x = places[i][0] + dx, y = places[i][1] + dy;
          const inside = ([px, py]) => Math.abs(px - x) < wide / 2 + 3 && Math.abs(py - y) < 9;
          const over = taken.filter(([ox, oy, other]) => Math.abs(ox - x) < (wide + other) / 2 + 2 && Math.abs(oy - y) < 16).length;
          const out = x - wide / 2 < 2 || x + wide / 2 > this.size[0] - 2 || y < 10 || y > this.size[1] - 10;
          const cost = 4 * inked.filter(inside).length + 150 * over + 200 * out + far;
          if (!best || cost < best.cost) best = { cost, x, y, offset: [dx, dy, wide] };
        }
      }
      taken.push([best.x, best.y, wide]);
      return best.offset;
    });
  }
}

Stage.kinds = {
  line(places) { this.path(places); this.ink.stroke(); },
  polygon(places, sign) { this.path(places, true); if (sign.fill) this.ink.fill(); this.ink.stroke(); },
  circle(places, sign) {
    const radius = (sign.size || 0) * this.scale * this.zoom;
    this.disc(places[0], radius, sign.fill, sign.stroke && sign.width !== 0);
  },
  dot([at], sign) { this.disc(at, sign.size * this.inch, true, sign.stroke); },
  arrow([tail, tip], sign) { this.arrow(tail, tip[0] - tail[0], tail[1] - tip[1], this.ink.strokeStyle); },
  ground([a, b], sign) {
    this.path([a, b]);
    this.ink.stroke();
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]), step = INCH.hatchStep * this.inch, size = INCH.hatch * this.inch;
    const ux = (b[0] - a[0]) / (length || 1), uy = (b[1] - a[1]) / (length || 1);
    this.begin({ stroke: "soft", width: 0.6 });
    for (let k = 0; k < Math.min(length / step, 2000); k++) {
      const x = a[0] + ux * k * step, y = a[1] + uy * k * step;
      this.ink.moveTo(x, y);
      this.ink.lineTo(x - size * (ux + uy), y - size * (uy - ux));
    }
    this.ink.stroke();
  },
  weld([[x, y]]) { const half = INCH.weld * this.inch; this.ink.rect(x - half, y - half, 2 * half, 2 * half); this.ink.fill(); },
  block([at, along]) {
    const [u, v] = unit(at, along), [p, q] = INCH.block.map((half) => half * this.inch);
    this.path([[-p, -q], [p, -q], [p, q], [-p, q]].map(([i, j]) => [at[0] + i * u - j * v, at[1] + i * v + j * u]), true);
    this.ink.fill();
    this.ink.stroke();
  },
  rolls([at, along]) {
    const [u, v] = unit(at, along), size = 0.07 * this.inch;
    for (const side of [-0.4, 0.4]) {
      const x = at[0] + side * size * u, y = at[1] + side * size * v;
      this.ink.moveTo(x - size * v, y + size * u);
      this.ink.lineTo(x + size * v, y - size * u);
    }
    this.ink.stroke();
  },
  touch([a, b], sign) {
    if (Math.hypot(b[0] - a[0], b[1] - a[1]) > 0.06 * this.inch) {
      this.begin({ ...sign, width: 1, dashes: [1.2, 2.4] });
      this.path([a, b]);
      this.ink.stroke();
    } else {
      this.disc(a, 0.06 * this.inch, false, true);
    }
  },
  spring([a, b]) {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (!(length > 0)) return;
    this.coils = this.coils || new Map();
    const [u, v] = unit(a, b), end = Math.min(0.12 * this.inch, 0.2 * length), wide = INCH.coil * this.inch;
    const coils = 8, places = [a];
    for (let k = 0; k <= 2 * coils; k++) {
      const far = end + (k / (2 * coils)) * (length - 2 * end), aside = k === 0 || k === 2 * coils ? 0 : k % 2 ? wide : -wide;
      places.push([a[0] + far * u - aside * v, a[1] + far * v + aside * u]);
    }
    this.path([...places, b]);
    this.ink.stroke();
  },
  damper([a, b]) {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]), [u, v] = unit(a, b);
    const half = Math.min(0.13 * this.inch, 0.25 * length), wide = INCH.coil * this.inch;
    const at = (far, aside) => [a[0] + far * u - aside * v, a[1] + far * v + aside * u];
    const middle = 0.5 * length;
    this.path([a, at(middle - half, 0)]);
    this.path([at(middle + half, wide), at(middle - half, wide), at(middle - half, -wide), at(middle + half, -wide)]);
    this.path([at(middle, 0), b]);
    this.ink.stroke();
    this.ink.lineWidth *= 2;
    this.ink.beginPath();
    this.path([at(middle, 0.75 * wide), at(middle, -0.75 * wide)]);
    this.ink.stroke();
  },
  spiral([[x, y]]) {
    for (let k = 0; k <= 90; k++) {
      const turn = (k / 90) * 5 * Math.PI, size = (0.03 + (0.09 * k) / 90) * this.inch;
      this.ink.lineTo(x + size * Math.cos(turn), y - size * Math.sin(turn));
    }
    this.ink.stroke();
  },
  couple([[x, y]], sign) {
    const radius = 0.24 * this.inch, first = (50 * Math.PI) / 180, last = (-190 * Math.PI) / 180;
    this.ink.arc(x, y, radius, first, last, true);
    this.ink.stroke();
    const turn = sign.size > 0 ? last : first, sense = sign.size > 0 ? 1 : -1;
    const tip = [x + radius * Math.cos(turn), y + radius * Math.sin(turn)];
    this.arrow([tip[0] - sense * 6 * Math.sin(turn), tip[1] + sense * 6 * Math.cos(turn)], sense * 9 * Math.sin(turn), sense * 9 * Math.cos(turn), this.ink.strokeStyle);
  },
  centre([at]) {
    const radius = 0.045 * this.inch;
    this.ink.fillStyle = this.colours.paper;
    this.disc(at, radius, true, true);
    this.ink.fillStyle = this.colours.body;
    for (const first of [0, Math.PI]) {
      this.ink.beginPath();
      this.ink.moveTo(...at);
      this.ink.arc(at[0], at[1], radius, first, first + Math.PI / 2);
      this.ink.fill();
    }
  },
};

function font(name) { return `${name.bold ? "600 " : ""}13px system-ui, "DejaVu Sans", sans-serif`; }

function unit(a, b) {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  return length > 0 ? [(b[0] - a[0]) / length, (b[1] - a[1]) / length] : [1, 0];
}

/* What most of a list of arrows stay below. */
function usualGreatest(list, part) {
  const sizes = [];
  for (const one of list) one.x.forEach((x, i) => { const size = Math.hypot(x, one.y[i]); if (size > 0) sizes.push(size); });
  sizes.sort((a, b) => a - b);
  return sizes.length ? sizes[Math.min(sizes.length - 1, Math.floor(part * sizes.length))] : 1;
}

/* Names at one place of one carrier become one. */
function mergedNames(motion, signs) {
  const look = motion.look(0), near = 0.04 * motion.told.inch, merged = [];
  for (const sign of signs) {
    const place = motion.place(look, sign.at[0]), bold = Boolean(sign.size);
    const same = merged.find((one) => one.bold === bold && one.stroke === sign.stroke && Math.hypot(one.place[0] - place[0], one.place[1] - place[1]) < near);
    if (!same) merged.push({ text: sign.text, at: sign.at[0], stroke: sign.stroke, bold, place });
    else if (!same.text.split(", ").includes(sign.text)) same.text += `, ${sign.text}`;
  }
  return merged;
}

function fit(canvas, wide, tall) {
  const dense = window.devicePixelRatio || 1;
  canvas.style.height = `${tall}px`;
  canvas.width = Math.round(wide * dense);
  canvas.height = Math.round(tall * dense);
  canvas.getContext("2d").setTransform(dense, 0, 0, dense, 0, 0);
}
