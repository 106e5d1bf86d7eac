// One run in motion: the train over the deck with its deflection, the deck's acceleration over place and time, wheel forces.

import { chart, element, number } from "./chart.js";

const still = matchMedia("(prefers-reduced-motion: reduce)");
let running = 0;

export function show(place, film, bearings) {
  const alive = (running += 1);
  const length = bearings.at(-1);
  const most = greatest(film.displacement);
  const picture = element("div");
  const slider = element("input", { type: "range", min: 0, max: film.time.length - 1, value: 0, "aria-label": "Time of the passage" });
  const play = element("button", { type: "button" }, "Play");
  const told = element("p", { class: "read", "aria-live": "off" });
  let factor = 1;
  const draw = () => {
    const k = Number(slider.value);
    const width = Math.max(260, picture.clientWidth || 600);
    factor = roundFactor((0.05 * length) / (most || 1));
    picture.replaceChildren(moment(film, k, bearings, width, factor));
    const deepest = film.displacement[k].reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a), 0);
    const strongest = film.acceleration[k].reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a), 0);
    told.textContent = `t = ${film.time[k].toFixed(3)} s, first axle at ${number(film.front[k])} m: deflection ${number(1e3 * deepest, 3)} mm, acceleration ${number(strongest, 3)} m/s². Deflection drawn ${number(factor)} times.`;
    slider.setAttribute("aria-valuetext", `${film.time[k].toFixed(2)} s`);
  };
  slider.addEventListener("input", draw);
  let playing = false;
  const run = (begin, from) => {
    const step = (now) => {
      if (!playing || alive !== running) return;
      // Four times slower than life, as far as that takes no more than 12 s.
      const duration = film.time.at(-1) - film.time[0];
      const pace = Math.max(0.25, duration / 12);
      const t = film.time[from] + ((now - begin) / 1000) * pace;
      const k = film.time.findIndex((time) => time >= t);
      slider.value = k < 0 ? film.time.length - 1 : k;
      draw();
      if (k < 0) return stop();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  };
  const stop = () => { playing = false; play.textContent = "Play"; };
  play.addEventListener("click", () => {
    if (playing) return stop();
    playing = true;
    play.textContent = "Stop";
    if (Number(slider.value) >= film.time.length - 1) slider.value = 0;
    run(performance.now(), Number(slider.value));
  });
  slider.value = deepestMoment(film);
  const parts = [element("h3", {}, `The run: ${film.title}`), picture, element("div", { class: "row" }, play, slider), told, ...contour(film, bearings)];
  if (film.wheels.length) parts.push(wheels(film));
  place.replaceChildren(...parts);
  new ResizeObserver(draw).observe(picture);
  draw();
  if (still.matches) play.hidden = false;
}

function greatest(rows) {
  return rows.reduce((most, row) => row.reduce((of, value) => Math.max(of, Math.abs(value)), most), 0);
}

function deepestMoment(film) {
  const most = greatest(film.displacement);
  return Math.max(0, film.displacement.findIndex((row) => row.some((value) => Math.abs(value) === most)));
}

// 1, 2 or 5 times a power of ten.
function roundFactor(wanted) {
  const power = 10 ** Math.floor(Math.log10(Math.max(1, wanted)));
  return [5, 2, 1].map((one) => one * power).find((one) => one <= Math.max(1, wanted));
}

function moment(film, k, bearings, width, factor) {
  const [length, margin] = [bearings.at(-1), 14];
  const scale = (width - 2 * margin) / (1.3 * length);
  const [rail, height] = [64, 64 + Math.max(40, 0.075 * length * scale + 20)];
  const x = (metres) => margin + (metres + 0.15 * length) * scale;
  const at = film.x.map((place, i) => [place, film.displacement[k][i]]);
  const line = [...at, ...bearings.map((bearing) => [bearing, 0])].sort((a, b) => a[0] - b[0]);
  const sag = (place) => {
    if (place <= 0 || place >= length) return 0;
    const next = line.findIndex((one) => one[0] >= place);
    const [a, b] = [line[Math.max(0, next - 1)], line[next]];
    return b[0] === a[0] ? b[1] : a[1] + ((b[1] - a[1]) * (place - a[0])) / (b[0] - a[0]);
  };
  const y = (place) => rail + sag(place) * factor * scale;
  const svg = element("svg", { viewBox: `0 0 ${width} ${height.toFixed(0)}`, role: "img", "aria-label": `The train on the deck at ${film.time[k].toFixed(2)} s; deflection drawn ${number(factor)} times` });
  svg.append(element("line", { x1: margin, x2: width - margin, y1: rail, y2: rail, stroke: "var(--grid)" }));
  svg.append(element("polyline", { points: line.map(([place]) => `${x(place).toFixed(1)},${y(place).toFixed(1)}`).join(" "), fill: "none", stroke: "var(--deck)", "stroke-width": 4 }));
  for (const bearing of bearings) svg.append(element("polygon", { points: `${x(bearing)},${rail + 3} ${x(bearing) - 6},${rail + 14} ${x(bearing) + 6},${rail + 14}`, fill: "none", stroke: "var(--text)" }));
  for (const behind of film.axles) {
    const run = film.front[k] - behind;
    const place = film.backward ? length - run : run;
    if (x(place) < margin || x(place) > width - margin) continue;
    const top = y(place);
    svg.append(element("line", { x1: x(place), x2: x(place), y1: top - 34, y2: top - 6, stroke: "var(--accent)", "stroke-width": 1.6 }));
    svg.append(element("circle", { cx: x(place), cy: top - 6, r: 4, fill: "var(--accent)" }));
  }
  return svg;
}

// Acceleration over place and time; blue: up, red: down.
function contour(film, bearings) {
  const most = greatest(film.acceleration);
  if (!most || film.x.length < 2) return [];
  const [columns, rows] = [film.time.length, film.x.length];
  const canvas = element("canvas", { width: columns, height: rows, tabindex: 0, role: "img", "aria-label": `Acceleration of the deck over time and place, at most ${number(most, 3)} m/s². Arrow keys read values.`, style: "height: 160px; image-rendering: auto" });
  const context = canvas.getContext("2d");
  const pixels = context.createImageData(columns, rows);
  for (let k = 0; k < columns; k += 1) {
    for (let i = 0; i < rows; i += 1) {
      const share = film.acceleration[k][i] / most;
      const fade = Math.round(255 * (1 - Math.min(1, Math.abs(share)) ** 0.7));
      pixels.data.set(share > 0 ? [255, fade, fade, 255] : [fade, fade, 255, 255], 4 * (i * columns + k));
    }
  }
  context.putImageData(pixels, 0, 0);
  const told = element("p", { class: "read", "aria-live": "polite" }, `left to right: ${number(film.time[0])} to ${number(film.time.at(-1))} s; top to bottom: 0 to ${number(bearings.at(-1))} m; white 0, red down, blue up, full colour ${number(most, 3)} m/s²`);
  let [k, i] = [0, Math.floor(rows / 2)];
  const read = () => { told.textContent = `t = ${film.time[k].toFixed(3)} s, x = ${number(film.x[i])} m: ${number(film.acceleration[k][i], 3)} m/s²`; };
  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    k = Math.max(0, Math.min(columns - 1, Math.floor(((event.clientX - box.left) / box.width) * columns)));
    i = Math.max(0, Math.min(rows - 1, Math.floor(((event.clientY - box.top) / box.height) * rows)));
    read();
  });
  canvas.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!by) return;
    event.preventDefault();
    [k, i] = [Math.max(0, Math.min(columns - 1, k + by[0])), Math.max(0, Math.min(rows - 1, i + by[1]))];
    read();
  });
  return [element("h3", {}, "Acceleration of the deck over time and place"), canvas, told];
}

function wheels(film) {
  const least = film.axles.map((_, i) => Math.min(...film.wheels.map((row) => row[i])));
  const worst = least.indexOf(Math.min(...least));
  const lines = [...new Set([0, worst, film.axles.length - 1])].map((i) => ({
    name: `wheelset ${i + 1}`,
    points: film.time.map((time, k) => [time, 1e-3 * film.wheels[k][i]]),
  }));
  return chart({ title: "Contact force of wheelsets", unit: "kN", across: { title: "time", unit: "s" }, limit: null, lines, tight: true });
}
