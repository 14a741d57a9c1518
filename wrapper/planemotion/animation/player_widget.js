/* player_widget.js - the player as a widget of a notebook (anywidget): `time`, `playing` and `speed` go to and fro. */

const BETWEEN = 100; // ms between two messages to Python

function render({ model, el }) {
  const root = made("div", { class: "pm pm-theme", tabindex: 0, "data-lm-suppress-shortcuts": "true" });
  el.append(root);
  let waiting = null, telling = false;
  const tell = () => {
    waiting = null;
    telling = true;
    for (const key of ["time", "playing", "speed"]) model.set(key, player[key]);
    telling = false;
    model.save_changes();
  };
  const changed = () => { waiting = waiting || setTimeout(tell, BETWEEN); };
  const player = new Player(root, model.get("motion"), { changed });
  root.player = player;
  const heard = {
    time: () => player.seek(model.get("time")),
    playing: () => (model.get("playing") ? player.play() : player.pause()),
    speed: () => player.setSpeed(model.get("speed")),
  };
  const listeners = Object.entries(heard).map(([key, act]) => [`change:${key}`, () => { if (!telling) act(); }]);
  listeners.forEach(([name, listener]) => model.on(name, listener));
  if (model.get("speed")) player.setSpeed(model.get("speed"));
  player.seek(model.get("time"));
  if (model.get("playing")) player.play();
  return () => {
    clearTimeout(waiting);
    listeners.forEach(([name, listener]) => model.off(name, listener));
    player.close();
  };
}

export default { render };
