/* player_page.js - the player as a page of its own. */
"use strict";

const page = document.querySelector(".pm");
page.player = new Player(page, JSON.parse(document.getElementById("pm-motion").textContent), {
  themed: document.documentElement,
  ears: window,
});
