"use strict";
// Reads curve values under the pointer and by arrow keys; the page is complete without it.
for (const svg of document.querySelectorAll("svg.chart")) {
  const curves = [...svg.querySelectorAll("polyline[data-v]")].map((line) => ({
    name: line.dataset.n,
    pixels: line.getAttribute("points").split(" ").map((p) => parseFloat(p)),
    values: line.dataset.v.split(",").map((v) => v.split(" ")),
  }));
  const out = svg.parentElement.querySelector(".readout");
  if (!curves.length || !out) continue;
  const near = (c, x) =>
    c.pixels.reduce((best, p, i) => (Math.abs(p - x) < Math.abs(c.pixels[best] - x) ? i : best), 0);
  const show = (x) => {
    const told = curves.map((c) => {
      const [at, value] = c.values[near(c, x)];
      return `${c.name}: ${value} at ${at}`;
    });
    out.textContent = told.reverse().join(" · ");
  };
  svg.addEventListener("pointermove", (e) => {
    const box = svg.getBoundingClientRect();
    show(((e.clientX - box.left) / box.width) * svg.viewBox.baseVal.width);
  });
  const first = curves[curves.length - 1];
  let at = -1;
  svg.addEventListener("keydown", (e) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
    if (!step) return;
    e.preventDefault();
    at = Math.min(Math.max(at + step, 0), first.pixels.length - 1);
    show(first.pixels[at]);
  });
}
