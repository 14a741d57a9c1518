/* report.js - draws the plots of a report with Plotly, and plays the case that the sliders say. */
"use strict";

const told = JSON.parse(document.getElementById("data").textContent);
const MOTION = /(<script type="application\/json" id="pm-motion">)[^]*?(<\/script>)/;

/* ---- light and dark ---- */
function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  drawPlots();
  const inside = document.getElementById("player").contentDocument;
  if (inside && inside.documentElement) showCase();
}

/* ---- plots ---- */
function themed(layout) {
  const axis = { gridcolor: colour("grid"), linecolor: colour("edge"), zeroline: false, automargin: true };
  const axes = ["xaxis", "yaxis", ...Object.keys(layout).filter((key) => /^[xy]axis/.test(key))];
  return {
    ...layout,
    ...Object.fromEntries(axes.map((key) => [key, { ...axis, ...layout[key] }])),
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    font: { color: colour("ink"), family: "system-ui, DejaVu Sans, sans-serif", size: 13 },
    margin: { l: 60, r: 20, t: 12, b: 48 },
    legend: { orientation: "h", y: 1.12 },
    modebar: { bgcolor: "rgba(0,0,0,0)", color: colour("soft"), activecolor: colour("ink") },
  };
}

/* What is drawn in a colour of the house has its counterpart on dark paper. */
function onPaper(data) {
  const dark = document.documentElement.dataset.theme === "dark";
  return JSON.parse(JSON.stringify(data), (_, value) => (dark && Object.hasOwn(told.dark, value) ? told.dark[value] : value));
}

function drawPlots() {
  told.plots.forEach((plot, i) => {
    Plotly.react(`plot-${i}`, onPaper(plot.data), themed(structuredClone(plot.layout)), { displaylogo: false, responsive: true });
  });
}

/* ---- cases in motion ---- */
const sliders = told.replays.sliders.map((_, i) => document.getElementById(`slider-${i}`));

function chosenCase() {
  const place = sliders.map((slider) => Number(slider.value));
  return told.replays.cases.find((one) => one.place.every((at, i) => at === place[i]));
}

/* The page of the player with this motion in it: nothing in its JSON may end the element. */
function playerOf(motion) {
  const text = JSON.stringify(motion).replaceAll("</", "<\\/");
  return told.replays.player.replace(MOTION, (_, begin, end) => begin + text + end);
}

function showCase() {
  const one = chosenCase(), frame = document.getElementById("player");
  sliders.forEach((slider, i) => { slider.nextElementSibling.value = told.replays.sliders[i][slider.value]; });
  document.getElementById("case").textContent = [one.words, one.fault].filter(Boolean).join(": ");
  frame.hidden = !one.motion;
  if (!one.motion) return;
  frame.onload = () => {
    const inside = frame.contentDocument.documentElement;
    frame.contentDocument.querySelector("main").player.theme(document.documentElement.dataset.theme);
    frame.style.height = `${inside.querySelector("main").scrollHeight + 4}px`;
  };
  frame.srcdoc = playerOf(one.motion);
}

sliders.forEach((slider) => slider.addEventListener("input", showCase));
document.getElementById("theme").addEventListener("click", () => {
  setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
});
document.documentElement.dataset.theme = window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
drawPlots();
showCase();
