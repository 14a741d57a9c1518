/* player_signs.js - the signs of mechanics: how each kind is drawn on the stage. */
"use strict";

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
