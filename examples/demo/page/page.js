"use strict";
// Draws the pictures and lets the slider move the film.

const DATA = JSON.parse(document.getElementById("data").textContent);
/// A number to read; next to the µm and 10⁻⁶ mm³ of the page, a millionth is nothing.
const number = (value, digits = 4) =>
  (Math.abs(value) < 1e-6 ? 0 : value).toLocaleString("en", { maximumSignificantDigits: digits });
const element = (id) => document.getElementById(id);

async function draw(id, picture) {
  const { view } = await vegaEmbed(`#${id}`, picture, { renderer: "svg", actions: false, tooltip: { theme: "custom" } });
  return view;
}

const film = {
  life: null,
  views: [],
  timer: null,
  drawing: Promise.resolve(),

  /// Draws the pictures of a life, then its first frame.
  choose(life) {
    this.drawing = this.drawing.then(async () => {
      this.life = life;
      this.views = await Promise.all([
        draw("profile", profilePicture(life)),
        draw("pressure", pressurePicture(life)),
        draw("volume", volumePicture(life)),
      ]);
      element("time").max = life.frames.length - 1;
      this.show((element("time").value = 0));
    });
    return this.drawing;
  },

  show(place) {
    const frame = this.life.frames[place];
    const { cycles, volume, depth, contact, stick } = frame;
    for (const view of this.views.slice(0, 2)) view.data("frame", rowsOf(frame)); // the third has no radii
    for (const view of this.views) view.data("state", stateOf(frame)).run();
    const parts = [
      ["cycle", number(Math.round(cycles), 7)],
      ["worn volume", `${number(volume)} · 10⁻⁶ mm³`],
      ["wear depth", `${number(depth)} µm`],
      ["contact radius", `${number(contact)} µm`],
      ["stick radius", `${number(stick)} µm`],
    ];
    element("state").replaceChildren(
      ...parts.map(([name, text]) => {
        const part = document.createElement("span"),
          value = document.createElement("b");
        value.textContent = text;
        part.append(`${name} `, value);
        return part;
      }),
    );
    element("time").setAttribute("aria-valuetext", `${number(Math.round(cycles), 7)} cycles`);
  },

  play(on) {
    clearInterval(this.timer);
    const slider = element("time"),
      button = element("play");
    button.setAttribute("aria-pressed", on);
    button.textContent = on ? "Pause" : "Play";
    element("state").setAttribute("aria-live", on ? "off" : "polite");
    if (!on) return;
    if (slider.value === slider.max) slider.value = 0;
    this.timer = setInterval(() => {
      slider.value = Number(slider.value) + 1;
      this.show(slider.value);
      if (slider.value === slider.max) this.play(false);
    }, 80);
  },
};

function offer(lives) {
  lives.forEach((life, k) => {
    const label = document.createElement("label"),
      choice = document.createElement("input");
    Object.assign(choice, { type: "radio", name: "life", value: k, checked: k === 0 });
    choice.addEventListener("change", () => {
      film.play(false);
      film.choose(life);
    });
    label.append(choice, ` ±${number(life.amplitude)} µm: ${life.name.toLowerCase()}`);
    element("lives").append(label);
  });
  element("time").addEventListener("input", (event) => {
    film.play(false);
    film.show(event.target.value);
  });
  element("play").addEventListener("click", () => film.play(element("play").getAttribute("aria-pressed") !== "true"));
}

/// A life with its name under it.
function drawLife(life, k) {
  element(`life${k}-caption`).textContent = life.name;
  return draw(`life${k}`, lifePicture(life));
}

offer(DATA.film);
Promise.all([
  draw("loops", loopsPicture(DATA.loops)),
  draw("varying", varyingPicture(DATA.varying)),
  film.choose(DATA.film[0]),
  ...DATA.lives.map(drawLife),
  draw("map", mapPicture(DATA.map)),
  draw("swing", swingPicture(DATA.mass)),
  draw("joint", jointPicture(DATA.mass)),
]).then(() => {
  document.body.dataset.drawn = "yes";
});
