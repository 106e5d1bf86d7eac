// Curves as SVG with limits, readable by pointer, keyboard and as a table.

const NS = "http://www.w3.org/2000/svg";
const DASHES = ["", "7 3", "2 3", "9 3 2 3", "4 4"];

export function element(name, attributes = {}, ...children) {
  const svg = ["svg", "g", "path", "line", "rect", "circle", "text", "polyline", "polygon", "title"].includes(name);
  const made = svg ? document.createElementNS(NS, name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== undefined && value !== null && value !== false) made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== undefined && child !== null));
  return made;
}

export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const amount = Math.abs(value);
  if (amount >= 1e6 || amount < 1e-4) return value.toExponential(digits - 1).replace("e+", "e");
  return String(Number(value.toPrecision(digits)));
}

// Round steps between two values.
export function ticks(low, high, count) {
  const raw = (high - low) / Math.max(1, count) || 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((one) => one >= raw);
  const from = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.max(0, Math.floor(high / step + 1e-9) - from + 1) }, (_, i) => Number(((from + i) * step).toPrecision(12)));
}

function sample(i) {
  const svg = element("svg", { viewBox: "0 0 28 10", "aria-hidden": "true" });
  svg.append(element("line", { x1: 0, y1: 5, x2: 28, y2: 5, stroke: `var(--c${i % 10})`, "stroke-width": 2, "stroke-dasharray": DASHES[Math.floor(i / 10) + (i % 5)] ?? "" }));
  return svg;
}

// chart: { title, unit, across: { title, unit }, limit: [value, text] or null, lines: [{ name, points: [[x, y], …] }], zero }
export function chart(data) {
  const figure = element("figure", { class: "chart" });
  const unit = data.unit ? `, ${data.unit}` : "";
  const read = element("p", { class: "read", "aria-live": "polite" });
  const plot = element("div");
  figure.append(element("figcaption", {}, `${data.title}${unit}`), plot, read, legend(data), table(data));
  const draw = () => {
    const width = Math.max(260, plot.clientWidth || 600);
    plot.replaceChildren(drawn(data, width, read));
  };
  new ResizeObserver(draw).observe(plot);
  return figure;
}

function legend(data) {
  const list = element("ul", { class: "legend" });
  if (data.lines.length < 2) return list;
  data.lines.forEach((line, i) => list.append(element("li", {}, sample(i), line.name)));
  return list;
}

function table(data) {
  const details = element("details", {}, element("summary", {}, "Values as a table"));
  details.addEventListener("toggle", () => {
    if (!details.open || details.children.length > 1) return;
    const across = [...new Set(data.lines.flatMap((line) => line.points.map((point) => point[0])))].sort((a, b) => a - b);
    const by = data.lines.map((line) => new Map(line.points));
    const head = element("tr", {}, element("th", { scope: "col" }, `${data.across.title}, ${data.across.unit}`), ...data.lines.map((line) => element("th", { scope: "col", class: "number" }, line.name || data.title)));
    const rows = across.slice(0, 2000).map((x) => element("tr", {}, element("th", { scope: "row" }, number(x, 6)), ...by.map((of) => element("td", { class: "number" }, number(of.get(x))))));
    details.append(element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `${data.title}, table` }, element("table", {}, element("thead", {}, head), element("tbody", {}, ...rows))));
  });
  return details;
}

function drawn(data, width, read) {
  const height = Math.round(Math.min(340, Math.max(210, 0.45 * width)));
  const [left, right, top, bottom] = [52, 10, 12, 38];
  const xs = data.lines.flatMap((line) => line.points.map((point) => point[0]));
  const ys = data.lines.flatMap((line) => line.points.map((point) => point[1]));
  let [x0, x1] = [Math.min(...xs), Math.max(...xs)];
  if (x0 === x1) [x0, x1] = [x0 - 1, x1 + 1];
  let [y0, y1] = [Math.min(0, ...ys), Math.max(...ys, 0)];
  const limit = data.limit?.[0];
  // A limit far above all values stays outside, and is told in words.
  const inside = limit !== undefined && limit <= 4 * y1;
  if (inside) y1 = Math.max(y1, limit);
  if (data.tight) [y0, y1] = [Math.min(...ys), Math.max(...ys)];
  if (y0 === y1) y1 = y0 + 1;
  y1 += 0.06 * (y1 - y0);
  const x = (value) => left + ((value - x0) / (x1 - x0)) * (width - left - right);
  const y = (value) => height - bottom - ((value - y0) / (y1 - y0)) * (height - top - bottom);
  const best = data.lines.map((line) => [line.name, line.points.reduce((most, point) => (point[1] > most[1] ? point : most), [NaN, -Infinity])]);
  const [name, [at, most]] = best.reduce((a, b) => (b[1][1] > a[1][1] ? b : a));
  const told = `${data.title}: largest ${number(most)} ${data.unit} at ${number(at)} ${data.across.unit}${name ? ` (${name})` : ""}${limit === undefined ? "" : `, limit ${number(limit)} ${data.unit}`}. Arrow keys read values.`;
  const svg = element("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", tabindex: 0, "aria-label": told });
  for (const value of ticks(x0, x1, width / 80)) {
    svg.append(element("line", { x1: x(value), x2: x(value), y1: top, y2: height - bottom, stroke: "var(--grid)" }));
    svg.append(element("text", { x: x(value), y: height - bottom + 16, "text-anchor": "middle" }, String(value)));
  }
  for (const value of ticks(y0, y1, height / 45)) {
    svg.append(element("line", { x1: left, x2: width - right, y1: y(value), y2: y(value), stroke: "var(--grid)" }));
    svg.append(element("text", { x: left - 6, y: y(value) + 4, "text-anchor": "end" }, number(value)));
  }
  svg.append(element("text", { x: width - right, y: height - 6, "text-anchor": "end" }, `${data.across.title}, ${data.across.unit}`));
  data.lines.forEach((line, i) => {
    const points = line.points.map((point) => `${x(point[0]).toFixed(1)},${y(point[1]).toFixed(1)}`).join(" ");
    const dash = DASHES[Math.floor(i / 10) + (i % 5)] ?? "";
    svg.append(element("polyline", { points, fill: "none", stroke: `var(--c${i % 10})`, "stroke-width": 1.8, "stroke-dasharray": data.lines.length > 1 ? dash : "" }));
    if (line.points.length === 1) svg.append(element("circle", { cx: x(line.points[0][0]), cy: y(line.points[0][1]), r: 4, fill: `var(--c${i % 10})` }));
  });
  if (inside) {
    svg.append(element("line", { x1: left, x2: width - right, y1: y(limit), y2: y(limit), stroke: "var(--bad)", "stroke-width": 1.6, "stroke-dasharray": "8 4" }));
    svg.append(element("text", { x: left + 6, y: y(limit) - 4, fill: "var(--bad)" }, `limit ${number(limit)} ${data.unit}`));
  }
  const cursor = element("line", { y1: top, y2: height - bottom, stroke: "var(--soft)", visibility: "hidden" });
  svg.append(cursor);
  const grid = [...new Set(xs)].sort((a, b) => a - b);
  let place = grid.indexOf(at);
  const show = (i) => {
    place = Math.max(0, Math.min(grid.length - 1, i));
    const value = grid[place];
    cursor.setAttribute("x1", x(value));
    cursor.setAttribute("x2", x(value));
    cursor.setAttribute("visibility", "visible");
    const here = data.lines.map((line) => [line.name, line.points.find((point) => point[0] === value)?.[1]]).filter((one) => one[1] !== undefined);
    here.sort((a, b) => b[1] - a[1]);
    const words = here.slice(0, 4).map(([of, amount]) => `${of ? `${of} ` : ""}${number(amount)} ${data.unit}`);
    read.textContent = `${number(value, 6)} ${data.across.unit}: ${words.join("; ")}${here.length > 4 ? "; …" : ""}`;
  };
  svg.addEventListener("pointermove", (event) => {
    const box = svg.getBoundingClientRect();
    const value = x0 + ((((event.clientX - box.left) / box.width) * width - left) / (width - left - right)) * (x1 - x0);
    show(grid.reduce((nearest, one, i) => (Math.abs(one - value) < Math.abs(grid[nearest] - value) ? i : nearest), 0));
  });
  svg.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1, PageUp: 10, PageDown: -10 }[event.key];
    if (step === undefined && event.key !== "Home" && event.key !== "End") return;
    event.preventDefault();
    show(event.key === "Home" ? 0 : event.key === "End" ? grid.length - 1 : place + step);
  });
  if (!inside && limit !== undefined) read.textContent = `The limit, ${number(limit)} ${data.unit}, lies above the picture.`;
  return svg;
}
