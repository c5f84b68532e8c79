// The buttons that save a picture and record a film, and the captions of both.

import { angle, quantity } from "../units.js";
import { roleNames } from "../data/roles.js";
import { roleColours } from "../view/colours.js";
import { canFilm, compose, Film, savePicture } from "./film.js";
import { colourCaption } from "./legend.js";
import { mapCaption } from "./map.js";
import { scaleBar, viewText } from "./scale.js";

export class Recorder {
  constructor(replay, picture_button, film_button) {
    this.replay = replay;
    this.canvas = document.createElement("canvas");
    this.button = film_button;
    picture_button.addEventListener("click", () => this.picture());
    film_button.addEventListener("click", () => this.toggle());
    film_button.disabled = !canFilm();
    if (film_button.disabled) film_button.title = "This browser cannot record films";
  }

  name() {
    return (this.replay.header.scenarioPath.split("/").at(-1) || "run").replace(/\.toml$/, "");
  }

  /** The picture as just rendered, with its captions. */
  compose() {
    const { replay } = this, { look, stage, player } = replay;
    const roles = look.colouring === "role";
    const present = roles ? [...new Set(replay.roles)].sort() : [];
    compose(this.canvas, stage.renderer.domElement, {
      dark: replay.controls.dark(), ratio: stage.renderer.getPixelRatio(), title: this.name(),
      lines: replay.map ? [`${replay.map.runs} samples`] : [`t = ${quantity(player.time, "s")}, tilt ${angle(replay.now.a.tilt, 4)}, ${replay.motionText}`,
        ...(replay.showsFlow() ? [`water pressure in joints: 0 (pale blue) to ${quantity(replay.flow.most, "Pa", 3)} (dark blue); dry (brown)`]
          : look.joints && replay.full ? [`joints at t = ${quantity(replay.full.time, "s")}: friction mobilised little (green), half (yellow), fully (red); open (grey)`] : []),
        ...(look.exaggeration !== 1 ? [`displacement drawn × ${Number(look.exaggeration.toPrecision(3))}`] : [])],
      colours: replay.map ? mapCaption(replay.map, look.colouring) : roles ? { ...colourCaption(look, replay.range), items: present.map((role) => [roleColours[role], roleNames[role]]) }
        : colourCaption(look, replay.range, replay.groups),
      scale: scaleBar(stage.metresPerPixel()),
      compass: { svg: document.getElementById("axes"), text: viewText(stage.direction()) },
    });
  }

  async picture() {
    this.replay.stage.render(); // what is on the screen may be read only right after it was drawn
    this.compose();
    const moment = this.replay.map ? this.replay.look.colouring : `${this.replay.player.time.toPrecision(4)}s`;
    return savePicture(this.canvas, `${this.name()}-${moment}`);
  }

  toggle() {
    this.film ? this.end() : this.begin();
  }

  begin() {
    this.replay.stage.render();
    this.compose();
    this.film = new Film(this.canvas, this.name());
    this.button.textContent = "Stop recording", this.button.classList.add("recording");
    this.replay.player.play();
  }

  /** After every picture drawn; the film ends with the run. */
  take() {
    if (!this.film) return;
    this.compose();
    if (!this.replay.player.playing) this.end();
  }

  end() {
    const film = this.film;
    this.film = null;
    this.button.textContent = "Record film", this.button.classList.remove("recording");
    this.saved = new Promise((resolve) => setTimeout(() => resolve(film.finish()), 200)); // the last picture, too
  }
}
