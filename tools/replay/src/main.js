// Starts the page: reads the run that stands in it, then wires player, scene and controls.

import { embeddedBytes, openSnapshots } from "./data/container.js";
import { embeddedMap } from "./data/map.js";
import { Replay } from "./replay.js";

const message = document.getElementById("message");

async function start() {
  const bytes = embeddedBytes("script.snapshot");
  if (bytes.length === 0) throw new Error("there is no snapshot file in this page: talus replay FILE -o page.html makes one");
  const file = await openSnapshots(bytes, (share) => {
    message.textContent = `Reading the run … ${Math.round(share * 100)} %`;
  });
  message.hidden = true;
  const replay = new Replay(file, embeddedMap());
  await replay.ready;
  /** For scripts and links: window.replay.player.seek(0.1), .select("c1r1s1"), .screenOf("c1r1s1"). */
  window.replay = replay;
  document.documentElement.dataset.state = "ready";
}

start().catch((error) => {
  message.hidden = false;
  message.textContent = /webgl/i.test(error.message)
    ? "This page needs WebGL 2, which this browser does not offer (hardware acceleration may be switched off)."
    : `The run cannot be shown: ${error.message}`;
  document.documentElement.dataset.state = "failed";
});
