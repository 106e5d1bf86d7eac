// Bridge and train to scale, and natural modes.

import { element, number } from "./chart.js";

const still = matchMedia("(prefers-reduced-motion: reduce)");

function line(x1, y1, x2, y2, stroke = "var(--text)", width = 1) {
  return element("line", { x1, y1, x2, y2, stroke, "stroke-width": width });
}

// The elevation: lengths and heights have one scale; a beam's depth is none of the scenario and drawn as L/15.
export function sketch(place, of) {
  const draw = () => {
    const width = Math.max(260, place.clientWidth || 600);
    const [tall, deep] = heights(of);
    const margin = 14;
    // As much of the train before the bridge as there is room for.
    const before = Math.min(0.35 * of.length, trainLength(of) + 5);
    const scale = (width - 2 * margin) / (of.length + before + 0.05 * of.length);
    const room = 5.5 * scale;
    const rail = margin + Math.max(room, tall * scale) + 22;
    const height = rail + deep * scale + 52;
    const x = (metres) => margin + (before + metres) * scale;
    const svg = element("svg", { viewBox: `0 0 ${width} ${height.toFixed(0)}`, role: "img", "aria-label": words(of) });
    svg.append(line(0, rail + 2, x(0), rail + 2, "var(--soft)", 3), line(x(of.length), rail + 2, width, rail + 2, "var(--soft)", 3));
    structure(svg, of, x, rail, scale);
    train(svg, of, x, rail, scale, [margin, width - margin]);
    dimensions(svg, of, x, rail + deep * scale + 26);
    place.replaceChildren(svg);
  };
  watch(place, draw);
}

const drawings = new WeakMap();

// Draws now and whenever the width changes; the last drawing of a place counts.
function watch(place, draw) {
  if (!drawings.has(place)) new ResizeObserver(() => drawings.get(place)?.()).observe(place);
  drawings.set(place, draw);
  draw();
}

function heights(of) {
  const up = of.nodes.map((node) => node[1]);
  const longest = Math.max(...of.bearings.slice(1).map((bearing, i) => bearing - of.bearings[i]), 1);
  return up.length ? [Math.max(0, ...up), Math.max(0, ...up.map((z) => -z))] : [0, longest / 15];
}

function trainLength(of) {
  return of.axles.at(-1)?.[0] ?? 0;
}

function words(of) {
  const spans = of.bearings.slice(1).map((bearing, i) => `${number(bearing - of.bearings[i])} m`);
  return `Elevation of the bridge: ${spans.length} ${spans.length === 1 ? "span" : "spans"} of ${spans.join(", ")}; ${of.axles.length} axles over ${number(trainLength(of))} m.`;
}

function structure(svg, of, x, rail, scale) {
  if (of.nodes.length) {
    for (const member of of.members) {
      for (let i = 1; i < member.length; i += 1) {
        const [a, b] = [of.nodes[member[i - 1]], of.nodes[member[i]]];
        svg.append(line(x(a[0]), rail - a[1] * scale, x(b[0]), rail - b[1] * scale, "var(--deck)", 1.2));
      }
    }
  } else {
    for (let i = 1; i < of.bearings.length; i += 1) {
      const [from, to] = [of.bearings[i - 1], of.bearings[i]];
      const depth = Math.max(3, ((to - from) / 15) * scale);
      svg.append(element("rect", { x: x(from), y: rail + 2, width: Math.max(1, x(to) - x(from) - 1), height: depth, fill: "var(--deck)" }));
    }
  }
  const deep = of.nodes.length ? 2 : heights(of)[1] * scale + 2;
  for (const bearing of of.bearings) {
    const [at, top] = [x(bearing), rail + deep];
    svg.append(element("polygon", { points: `${at},${top} ${at - 6},${top + 11} ${at + 6},${top + 11}`, fill: "none", stroke: "var(--text)" }));
  }
  for (const [name, at] of of.points) {
    svg.append(element("circle", { cx: x(at), cy: rail + 2, r: 3, fill: "var(--accent)" }, element("title", {}, `point ${name}, ${number(at)} m`)));
  }
}

function train(svg, of, x, rail, scale, [low, high]) {
  const front = 0.45 * of.length;
  const inside = (at) => at >= low && at <= high;
  for (const [begin, end] of of.bodies) {
    const [a, b] = [Math.max(low, x(front - end)), Math.min(high, x(front - begin))];
    if (b <= a) continue;
    svg.append(element("rect", { x: a + 1, y: rail - 3.9 * scale, width: Math.max(1, b - a - 2), height: 3 * scale, rx: Math.min(6, scale), fill: "none", stroke: "var(--accent)", "stroke-width": 1.4 }));
  }
  const heaviest = Math.max(...of.axles.map((axle) => axle[1]), 1);
  for (const [behind, load] of of.axles) {
    const at = x(front - behind);
    if (!inside(at)) continue;
    const wheel = Math.max(1.5, 0.45 * scale);
    svg.append(element("circle", { cx: at, cy: rail - wheel, r: wheel, fill: "var(--accent)" }));
    if (of.bodies.length) continue;
    const long = 20 + 14 * (load / heaviest);
    svg.append(line(at, rail - 2 * wheel - long, at, rail - 2 * wheel - 3, "var(--accent)", 1.4));
    svg.append(element("polygon", { points: `${at},${rail - 2 * wheel} ${at - 3},${rail - 2 * wheel - 6} ${at + 3},${rail - 2 * wheel - 6}`, fill: "var(--accent)" }));
  }
}

function dimensions(svg, of, x, y) {
  let last = -Infinity;
  of.bearings.slice(1).forEach((bearing, i) => {
    const [a, b] = [x(of.bearings[i]), x(bearing)];
    svg.append(line(a, y, b, y, "var(--soft)"), line(a, y - 4, a, y + 4, "var(--soft)"), line(b, y - 4, b, y + 4, "var(--soft)"));
    if ((a + b) / 2 - last < 46) return;
    last = (a + b) / 2;
    svg.append(element("text", { x: last, y: y + 15, "text-anchor": "middle" }, `${number(bearing - of.bearings[i])} m`));
  });
}

let beat = 0;
let resting = false;
let swing = () => {};

// While runs are computed the processors are theirs: shapes stand still.
export function rest(is) {
  resting = is;
  beat += 1;
  if (!is) swing();
}

// Shapes of the lowest modes; they swing unless the user asks for less motion.
export function modes(place, of, list) {
  beat += 1;
  swing = () => {};
  const moving = [];
  const figures = list.map((mode, i) => {
    const [width, height] = [240, 84];
    const svg = element("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `Mode ${i + 1}, ${number(mode.frequency)} Hz` });
    const xs = mode.shape.map((node) => node[0]);
    const [low, high] = [Math.min(...xs), Math.max(...xs)];
    const scale = (width - 20) / (high - low || 1);
    const up = mode.shape.map((node) => node[1]);
    const middle = of.nodes.length ? height - 14 + Math.min(0, ...up) * scale : height / 2;
    const reach = of.nodes.length ? 10 : 30;
    const [x, y] = [(node) => 10 + (node[0] - low) * scale, (node, part) => middle - node[1] * scale - part * reach * node[2]];
    svg.append(line(10, middle, width - 10, middle, "var(--grid)"));
    const path = element("path", { fill: "none", stroke: "var(--accent)", "stroke-width": 1.6 });
    svg.append(path);
    for (const bearing of of.bearings) svg.append(element("circle", { cx: 10 + (bearing - low) * scale, cy: middle, r: 2.5, fill: "var(--text)" }));
    const members = of.members.length ? of.members : chain(mode.shape);
    const draw = (part) => path.setAttribute("d", members.map((member) => member.map((at, k) => `${k ? "L" : "M"}${x(mode.shape[at]).toFixed(1)} ${y(mode.shape[at], part).toFixed(1)}`).join("")).join(""));
    draw(1);
    moving.push([draw, mode.frequency]);
    return element("figure", {}, svg, element("figcaption", {}, `mode ${i + 1}: ${number(mode.frequency)} Hz`));
  });
  place.replaceChildren(element("div", { class: "modes" }, ...figures));
  if (still.matches || !list.length) return;
  // The lowest mode swings in two seconds; the others keep their ratio to it, up to three times.
  const first = list[0].frequency;
  swing = () => {
    const alive = beat;
    const step = (now) => {
      if (alive !== beat || resting || !place.isConnected) return;
      if (!document.hidden) for (const [draw, frequency] of moving) draw(Math.cos((Math.PI * now * Math.min(3, frequency / first)) / 1000));
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  };
  swing();
}

// Nodes of beams in their order, a piece for every member.
function chain(shape) {
  const pieces = [[]];
  shape.forEach((node, i) => {
    if (i && node[0] <= shape[i - 1][0]) pieces.push([]);
    pieces.at(-1).push(i);
  });
  return pieces;
}
