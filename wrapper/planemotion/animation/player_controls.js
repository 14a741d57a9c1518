/* player_controls.js - the page around the stage: buttons, keys, the time axis with events, the energies. */
"use strict";

const KEYS = [
  ["Space", "play"], ["← →", "step"], ["n p", "next, previous event"], ["↑ ↓", "speed"], ["Home End", "start, end"],
  ["v f t e l", "velocities, forces, traces, energies, names"], ["c", "follow"], ["s", "slow at events"], ["r", "repeat"], ["d", "dark"],
  ["wheel, drag", "zoom, move; double click: all"], ["click a name", "its trace"],
];
const TOGGLES = [
  ["names", "Names", "l", true], ["velocities", "Velocities", "v", false], ["forces", "Forces", "f", false],
  ["traces", "Traces", "t", true], ["energies", "Energies", "e", true], ["follow", "Follow", "c", null], ["slow", "Slow at events", "s", false], ["repeat", "Repeat", "r", false],
];

function made(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (value !== undefined) element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
}

class Player {
  /* In the element `root`.  `themed` has the colours, `ears` hears the keys, `changed` is called when something was drawn. */
  constructor(root, told, { themed = root, ears = root, changed = () => {} } = {}) {
    this.themed = themed;
    this.ears = ears;
    this.changed = changed;
    this.closing = new AbortController();
    this.motion = new Motion(told);
    this.time = 0;
    this.row = 0; // which side of a jump is shown; undefined between rows
    this.playing = false;
    this.timing = told.timing;
    this.speed = this.timing.speed;
    this.shows = Object.fromEntries(TOGGLES.map(([key, , , on]) => [key, on]));
    Object.assign(this.shows, { ...told.shows, follow: told.follows });
    this.build(root);
    this.stage = new Stage(this.canvas, this.motion);
    this.listen();
    this.themed.dataset.theme = told.shows.theme || (darkAround() ? "dark" : "light");
    this.resize();
  }

  /* Nothing is heard or drawn any more. */
  close() {
    this.playing = false;
    this.closing.abort();
    this.watch.disconnect();
  }

  build(root) {
    const told = this.motion.told;
    this.canvas = made("canvas", { class: "scene", "aria-label": `${told.title}: the motion` });
    this.plot = made("canvas", { "aria-label": "energies over time" });
    this.axis = made("canvas", { class: "axis", tabindex: 0, role: "slider", "aria-label": "time", "aria-valuemin": 0, "aria-valuemax": this.motion.end });
    this.clock = made("div", { class: "clock" });
    this.what = made("div", { class: "what", "aria-live": "polite" });
    this.values = made("table");
    this.playButton = made("button", { class: "play", onclick: () => this.toggle() });
    this.choice = made("select", { "aria-label": "speed", onchange: () => this.setSpeed(Number(this.choice.value)) },
      ...this.timing.speeds.map((speed) => made("option", { value: speed }, `× ${speed}`)));
    this.toggles = TOGGLES.map(([key, label, letter]) =>
      made("button", { "data-shows": key, title: `key ${letter}`, onclick: () => this.show(key) }, label));
    const button = (label, title, action) => made("button", { title, "aria-label": title, onclick: action }, label);
    root.append(
      made("header", {}, made("h1", {}, told.title), made("span", { class: "note" }, told.note),
        made("button", { class: "theme", title: "light or dark (d)", onclick: () => this.theme() }, "Light / dark")),
      made("div", { class: "stage" }, this.canvas,
        made("aside", {},
          made("div", { class: "card" }, this.clock, this.what),
          made("div", { class: "card" }, made("h2", {}, "Energies [J]"), this.plot, this.values))),
      this.axis,
      made("nav", {},
        button("|◂", "start (Home)", () => this.seek(0)),
        button("◂ event", "previous event (p)", () => this.step(-1)),
        this.playButton,
        button("event ▸", "next event (n)", () => this.step(1)),
        this.choice, made("span", { class: "space" }), ...this.toggles),
      made("div", { class: "keys" }, ...KEYS.flatMap(([key, does]) => [made("kbd", {}, key), ` ${does}   `])),
    );
    if (!Object.keys(this.motion.energies).length) {
      this.plot.parentElement.remove();
      this.toggles.find((one) => one.dataset.shows === "energies").remove();
    }
    this.plot.parentElement?.toggleAttribute("hidden", !this.shows.energies);
    if (!this.motion.events.length) root.querySelectorAll("nav button[title*=event]").forEach((one) => { if (one.title !== "key s") one.disabled = true; });
  }

  /* ---- what moves ---- */
  seek(t, row) {
    this.time = Math.min(Math.max(t, 0), this.motion.end);
    this.row = row;
    this.draw();
  }

  step(direction) {
    this.pause();
    const event = this.motion.neighbour(this.time, direction);
    this.seek(event.t, event.row);
  }

  nudge(direction) {
    this.pause();
    this.seek(this.time + (direction * this.speed) / 30);
  }

  toggle() { if (this.playing) this.pause(); else this.play(); }

  play() {
    if (this.time >= this.motion.end) this.time = 0;
    this.playing = true;
    this.last = undefined;
    requestAnimationFrame((now) => this.tick(now));
    this.draw();
  }

  pause() { this.playing = false; this.draw(); }

  tick(now) {
    if (!this.playing) return;
    const passed = this.last === undefined ? 0 : Math.min((now - this.last) / 1000, 0.1);
    this.last = now;
    let t = this.time + passed * this.speed * this.pace();
    if (t >= this.motion.end && this.shows.repeat) t = 0;
    this.time = Math.min(t, this.motion.end);
    this.row = undefined;
    if (this.time >= this.motion.end) this.playing = false;
    this.draw();
    if (this.playing) requestAnimationFrame((next) => this.tick(next));
  }

  /* Slower around an event, if that is wanted. */
  pace() {
    if (!this.shows.slow) return 1;
    const near = this.timing.near * this.speed, slower = this.timing.slower;
    const by = Math.min(this.motion.neighbour(this.time, 1).name ? this.motion.neighbour(this.time, 1).t - this.time : Infinity,
      this.motion.neighbour(this.time, -1).name ? this.time - this.motion.neighbour(this.time, -1).t : Infinity);
    return by < near ? 1 / slower + (1 - 1 / slower) * Math.pow(by / near, 2) : 1;
  }

  setSpeed(speed) { this.speed = speed; this.draw(); }

  show(key) {
    this.shows[key] = !this.shows[key];
    if (key === "energies" && this.plot.isConnected) this.plot.parentElement.toggleAttribute("hidden", !this.shows.energies);
    if (key === "follow") this.stage.reset();
    if (key === "energies") this.resize();
    this.draw();
  }

  theme(chosen) {
    this.themed.dataset.theme = chosen || (this.themed.dataset.theme === "dark" ? "light" : "dark");
    this.colour();
    this.draw();
  }

  /* ---- what is seen ---- */
  colour() {
    const style = getComputedStyle(this.themed);
    const roles = ["page", "paper", "panel", "edge", "grid", "ink", "soft", "body", "fill", "force", "spring", "touch",
      "velocity", "impulse", "trace", "kinetic", "potential", "total", "accent"];
    this.colours = Object.fromEntries(roles.map((role) => [role, style.getPropertyValue(`--${role}`).trim()]));
  }

  resize() {
    if (!this.canvas.clientWidth) return; // it is on no page yet, and has no colours
    this.colour();
    this.stage.resize();
    fit(this.axis, this.axis.clientWidth, 54);
    if (this.plot.clientWidth) fit(this.plot, this.plot.clientWidth, 150);
    this.draw();
  }

  /* The last event, for as long as it is fresh, and how fresh it is. */
  blow() {
    const done = this.motion.events.filter((event) => event.t <= this.time + 1e-9 * this.motion.end);
    const event = done[done.length - 1];
    if (!event) return null;
    const fresh = 1 - (this.time - event.t) / (this.timing.flash * this.speed * (this.shows.slow ? 1 / this.timing.slower : 1));
    return fresh > 0 ? { event, fresh } : null;
  }

  draw() {
    if (!this.stage.ink) return;
    const look = this.motion.look(this.time, this.row), blow = this.blow();
    this.stage.follow(look, this.shows.follow);
    this.stage.draw(look, this.shows, this.colours, blow);
    this.drawAxis();
    if (this.plot.clientWidth) this.drawEnergies(look);
    this.clock.textContent = `t = ${this.time.toFixed(Math.max(0, 3 - Math.floor(Math.log10(this.motion.end || 1))))} s`;
    this.what.textContent = blow ? blow.event.name : "";
    this.playButton.textContent = this.playing ? "❚❚ Pause" : "▶ Play";
    this.choice.value = this.speed;
    this.toggles.forEach((button) => button.setAttribute("aria-pressed", this.shows[button.dataset.shows]));
    this.axis.setAttribute("aria-valuenow", this.time.toPrecision(4));
    this.changed();
  }

  /* The pixel of a time on a canvas that has so much room at both sides. */
  across(canvas, t, room) { return room + (t / (this.motion.end || 1)) * (canvas.clientWidth - 2 * room); }

  drawAxis() {
    const ink = this.axis.getContext("2d"), wide = this.axis.clientWidth, colours = this.colours, base = 27;
    ink.clearRect(0, 0, wide, 54);
    ink.strokeStyle = colours.edge;
    ink.lineWidth = 4;
    ink.lineCap = "round";
    line(ink, [[this.across(this.axis, 0, 14), base], [this.across(this.axis, this.motion.end, 14), base]]);
    ink.strokeStyle = colours.accent;
    line(ink, [[this.across(this.axis, 0, 14), base], [this.across(this.axis, this.time, 14), base]]);
    ink.fillStyle = colours.soft;
    ink.font = "11px system-ui, 'DejaVu Sans', sans-serif";
    ink.textAlign = "center";
    ink.textBaseline = "top";
    const step = niceStep(this.motion.end || 1, Math.max(2, wide / 110));
    for (let k = 0; k * step <= this.motion.end * (1 + 1e-9); k++) {
      const x = this.across(this.axis, k * step, 14);
      ink.fillRect(x - 0.5, base + 5, 1, 4);
      ink.fillText(`${shown(k * step, 5)}${k ? "" : " s"}`, x, base + 11);
    }
    ink.fillStyle = colours.impulse;
    let written = -Infinity;
    const many = this.motion.events.length > wide / 25;
    for (const event of this.motion.events) {
      const x = this.across(this.axis, event.t, 14);
      if (many) {
        ink.fillRect(x - 0.5, base - 8, 1, 6);
        continue;
      }
      ink.beginPath();
      ink.moveTo(x, base - 3);
      ink.lineTo(x - 4, base - 10);
      ink.lineTo(x + 4, base - 10);
      ink.fill();
      const half = ink.measureText(event.name).width / 2, middle = Math.max(half, Math.min(x, wide - half));
      if (middle - half > written + 8) {
        ink.fillText(event.name, middle, 3);
        written = middle + half;
      }
    }
    ink.fillStyle = colours.accent;
    ink.strokeStyle = colours.page;
    ink.lineWidth = 2;
    ink.beginPath();
    ink.arc(this.across(this.axis, this.time, 14), base, 7, 0, 2 * Math.PI);
    ink.fill();
    ink.stroke();
  }

  drawEnergies(look) {
    const ink = this.plot.getContext("2d"), wide = this.plot.clientWidth, tall = 150, { times, energies } = this.motion;
    const kinds = Object.keys(energies);
    let low = Infinity, high = -Infinity;
    for (const kind of kinds) for (const value of energies[kind]) { low = Math.min(low, value); high = Math.max(high, value); }
    if (!(high - low > 1e-6 * Math.max(Math.abs(high), Math.abs(low)))) { low -= 1; high += 1; }
    const y = (value) => tall - 8 - ((value - low) / (high - low)) * (tall - 16);
    ink.clearRect(0, 0, wide, tall);
    ink.strokeStyle = this.colours.grid;
    ink.lineWidth = 1;
    if (low < 0 && high > 0) line(ink, [[0, y(0)], [wide, y(0)]]);
    for (const kind of kinds) {
      ink.strokeStyle = this.colours[kind];
      ink.lineWidth = 1.6;
      ink.lineJoin = "round";
      line(ink, Array.from(times, (t, i) => [this.across(this.plot, t, 4), y(energies[kind][i])]));
    }
    const now = this.across(this.plot, this.time, 4);
    ink.strokeStyle = this.colours.soft;
    ink.lineWidth = 1;
    line(ink, [[now, 0], [now, tall]]);
    this.values.replaceChildren(...kinds.map((kind) => {
      const value = between(energies[kind], look.at);
      ink.fillStyle = this.colours[kind];
      ink.beginPath();
      ink.arc(now, y(value), 3.5, 0, 2 * Math.PI);
      ink.fill();
      const dot = made("span", { class: "dot", style: `background: var(--${kind})` });
      return made("tr", {}, made("td", {}, dot, kind), made("td", {}, shown(Math.abs(value) < 1e-6 * (high - low) ? 0 : value)));
    }));
  }

  /* ---- what is done with it ---- */
  listen() {
    const hear = (where, kind, heard) => where.addEventListener(kind, heard, { signal: this.closing.signal });
    const scrub = (event) => {
      const box = this.axis.getBoundingClientRect();
      this.seek(((event.clientX - box.left - 14) / (box.width - 28)) * this.motion.end);
    };
    this.axis.addEventListener("pointerdown", (event) => { this.pause(); this.axis.setPointerCapture(event.pointerId); scrub(event); });
    this.axis.addEventListener("pointermove", (event) => { if (event.buttons) scrub(event); });
    this.canvas.addEventListener("wheel", (event) => { event.preventDefault(); this.zoom(event); }, { passive: false });
    this.canvas.addEventListener("pointerdown", (event) => { this.canvas.setPointerCapture(event.pointerId); this.pressed = [event.offsetX, event.offsetY]; });
    this.canvas.addEventListener("pointermove", (event) => this.drag(event));
    this.canvas.addEventListener("click", (event) => this.click(event));
    this.canvas.addEventListener("dblclick", () => { this.shows.follow = false; this.stage.reset(); this.draw(); });
    hear(window, "resize", () => this.resize());
    hear(this.ears, "keydown", (event) => this.key(event));
    this.watch = new ResizeObserver(() => { if (this.canvas.clientWidth !== (this.stage.size || [0])[0]) this.resize(); });
    this.watch.observe(this.canvas);
  }

  zoom(event) {
    const stage = this.stage, factor = Math.exp(-event.deltaY * 0.0015), zoom = Math.min(Math.max(stage.zoom * factor, 0.3), 60);
    const at = [event.offsetX - stage.size[0] / 2, event.offsetY - stage.size[1] / 2];
    stage.shift = stage.shift.map((shift, i) => at[i] - ((at[i] - shift) * zoom) / stage.zoom);
    stage.zoom = zoom;
    this.draw();
  }

  drag(event) {
    if (!event.buttons || !this.pressed) return;
    this.stage.shift = this.stage.shift.map((shift, i) => shift + (i ? event.movementY : event.movementX));
    this.draw();
  }

  click(event) {
    const moved = this.pressed && Math.hypot(event.offsetX - this.pressed[0], event.offsetY - this.pressed[1]) > 4;
    const hit = (this.stage.boxes || []).findIndex(([x, y, w, h]) => event.offsetX >= x && event.offsetX <= x + w && event.offsetY >= y && event.offsetY <= y + h);
    if (moved || hit < 0) return;
    const traced = this.stage.traced;
    if (!traced.delete(hit)) traced.add(hit);
    this.draw();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
    const speeds = this.timing.speeds, speed = (by) => this.setSpeed(speeds[Math.min(Math.max(speeds.indexOf(this.speed) + by, 0), speeds.length - 1)]);
    const actions = {
      " ": () => this.toggle(), ArrowRight: () => this.nudge(1), ArrowLeft: () => this.nudge(-1), n: () => this.step(1), p: () => this.step(-1),
      ArrowUp: () => speed(1), ArrowDown: () => speed(-1), Home: () => this.seek(0), End: () => this.seek(this.motion.end), d: () => this.theme(),
      ...Object.fromEntries(TOGGLES.map(([key, , letter]) => [letter, () => this.show(key)])),
    };
    const action = actions[event.key];
    if (!action || (event.key === " " && event.target.tagName === "BUTTON")) return;
    event.preventDefault();
    event.stopPropagation();
    action();
  }
}

function line(ink, places) {
  ink.beginPath();
  places.forEach(([x, y], i) => (i ? ink.lineTo(x, y) : ink.moveTo(x, y)));
  ink.stroke();
}

/* A notebook says whether it is dark; a page of its own is as the system is. */
function darkAround() {
  const light = document.body.dataset.jpThemeLight;
  if (light !== undefined) return light === "false";
  return Boolean(window.matchMedia && window.matchMedia("(prefers-color-scheme: dark)").matches);
}
