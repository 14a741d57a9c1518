/* player.js - the stage: signs and what is shown beside them, on a canvas. */
"use strict";

class Stage {
  constructor(canvas, motion) {
    this.canvas = canvas;
    this.motion = motion;
    this.signs = [...motion.told.signs].sort((a, b) => a.order - b.order);
    this.names = mergedNames(motion, this.signs.filter((sign) => sign.kind === "name"));
    this.signs = this.signs.filter((sign) => sign.kind !== "name");
    this.traced = new Set(); // names that were clicked
    this.zoom = 1;
    this.shift = [0, 0];
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
      this.zoom = Math.max(1, Math.min(...this.size) / (this.scale * told.view));
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
    if (shows.forces) this.arrows(this.motion.forces, look, look.at, "force");
    if (blow) this.blow(blow);
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
    const bodies = this.motion.bodies.map((body, i) => ({ at: [i, 0, 0], x: body.vx, y: body.vy }));
    this.arrows(bodies, look, look.at, "velocity");
  }

  /* Arrows of a kind, where their carriers are now, as long as they are at a row: whether each could be seen. */
  arrows(list, look, at, kind, width) {
    const told = this.motion.told.inch_of, size = this.inch / told[kind], most = told.most * this.inch;
    return list.map((one) => {
      const x = between(one.x, at) * size, y = between(one.y, at) * size, far = Math.hypot(x, y);
      if (!(far >= 1)) return false;
      const cut = Math.min(1, most / far);
      this.arrow(this.pixel(this.motion.place(look, one.at)), x * cut, y * cut, this.colours[kind], width);
      return true;
    });
  }

  /* The impulses of a blow, as thick arrows that fade where the blow was, with a ring around each. */
  blow({ event, fresh }) {
    const look = this.motion.look(event.t, event.row);
    this.ink.globalAlpha = 0.25 + 0.75 * fresh;
    const seen = this.arrows(this.motion.impulses, look, { row: event.row, next: event.row, part: 0 }, "impulse", 4);
    this.ink.strokeStyle = this.colours.impulse;
    this.ink.lineWidth = 2;
    this.motion.impulses.forEach((one, i) => {
      if (seen[i]) this.disc(this.pixel(this.motion.place(look, one.at)), 6 + 10 * (1 - fresh), false, true);
    });
    this.ink.globalAlpha = 1;
  }

  traces(look) {
    for (const anchor of [...this.motion.told.traces.map((one) => one.at), ...[...this.traced].map((i) => this.names[i].at)]) {
      this.begin({ stroke: "trace", width: 1.1 });
      this.path(this.motion.way(anchor, look.t).map((place) => this.pixel(place)));
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
      const [dx, dy, wide, line] = this.offsets[i];
      const x = places[i][0] + dx, y = places[i][1] + dy;
      ink.font = font(name);
      if (line) this.lineTo(places[i], [x, y], wide, name);
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

  /* From a name that stands far away to what it names. */
  lineTo([px, py], [x, y], wide, name) {
    const ink = this.ink;
    ink.setLineDash([]);
    ink.lineWidth = 0.8;
    ink.strokeStyle = this.colours[name.stroke] || this.colours.ink;
    ink.beginPath();
    ink.moveTo(px, py);
    ink.lineTo(Math.max(x - wide / 2, Math.min(px, x + wide / 2)), Math.max(y - 8, Math.min(py, y + 8)));
    ink.stroke();
  }

  /* For each name how far from its place it stands: where it covers least of signs and other names at first. */
  placed(places, look) {
    const inked = this.inked(look), chosen = [];
    const spots = this.names.map((name, i) => this.spotsOf(name, places[i], inked));
    for (let round = 0; round < 4; round++) {
      spots.forEach((own, i) => { chosen[i] = cheapest(own, chosen.filter((_, k) => k !== i)); });
    }
    return chosen.map(({ at, x, y, wide, line }) => [x - at[0], y - at[1], wide, line]);
  }

  inked(look) {
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
    return inked;
  }

  /* Where a name may stand around its place, and what each spot costs by itself. */
  spotsOf(name, at, inked) {
    this.ink.font = font(name);
    const wide = this.ink.measureText(name.text).width, spots = [];
    for (const far of [13, 19, 27, 38, 52, 70, 92]) {
      for (let k = 0; k < 16; k++) {
        const turn = Math.PI / 4 + (k * Math.PI) / 8;
        const x = at[0] + Math.cos(turn) * (far + wide / 2 - 6), y = at[1] - Math.sin(turn) * far;
        const covered = inked.filter(([px, py]) => Math.abs(px - x) < wide / 2 + 3 && Math.abs(py - y) < 9).length;
        const out = x - wide / 2 < 2 || x + wide / 2 > this.size[0] - 2 || y < 10 || y > this.size[1] - 10;
        const line = far > 27;
        spots.push({ at, x, y, wide, line, cost: 4 * covered + 200 * out + far + 10 * line });
      }
    }
    return spots;
  }
}

/* The spot that costs least beside those of other names: boxes that overlap, lines that pass through them. */
function cheapest(spots, others) {
  const beside = (one, other) => 150 * (Math.abs(other.x - one.x) < (one.wide + other.wide) / 2 + 5 && Math.abs(other.y - one.y) < 16)
    + 40 * (one.line && passes(one, other)) + 40 * (other.line && passes(other, one));
  let best = null;
  for (const spot of spots) {
    const cost = others.reduce((sum, other) => sum + beside(spot, other), spot.cost);
    if (!best || cost < best.cost) best = { cost, spot };
  }
  return best.spot;
}

/* Whether the line from a name to its place passes through another name. */
function passes({ at, x, y }, other) {
  for (let k = 0; k <= 20; k++) {
    const px = at[0] + (k / 20) * (x - at[0]), py = at[1] + (k / 20) * (y - at[1]);
    if (Math.abs(px - other.x) < other.wide / 2 && Math.abs(py - other.y) < 8) return true;
  }
  return false;
}

function font(name) { return `${name.bold ? "600 " : ""}13px system-ui, "DejaVu Sans", sans-serif`; }

function unit(a, b) {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  return length > 0 ? [(b[0] - a[0]) / length, (b[1] - a[1]) / length] : [1, 0];
}

/* Names at one place of one carrier become one. */
function mergedNames(motion, signs) {
  const look = motion.look(0), near = motion.told.near, merged = [];
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
