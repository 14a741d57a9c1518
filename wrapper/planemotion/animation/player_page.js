/* player_page.js - the player as a page of its own. */
"use strict";

const page = document.querySelector(".pm");
page.player = new Player(page, JSON.parse(document.getElementById("pm-motion").textContent), {
  themed: document.documentElement,
  ears: window,
});

/* In a frame of a notebook all of it is seen, as far as that is sensible. */
const MOST = 1000; // px
try {
  const frame = window.frameElement;
  if (frame) frame.style.height = `${Math.min(document.querySelector(".pm").scrollHeight + 2, MOST)}px`;
} catch { /* the frame is another's */ }
