// SPDX-License-Identifier: MIT
// A chart on the page: title, canvas, legend with values; what mouse, finger and keyboard do with it.

const keysInWords =
  "Arrow keys move the cursor, plus and minus zoom, Escape goes back. Drag to zoom, double click to go back.";

function element(name, className, words) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (words) made.textContent = words;
  return made;
}

const isLine = (curve) => !(curve.mark in pointOf);

const sampleWith = (classes, path) =>
  `<svg viewBox="0 -6 18 12" aria-hidden="true"><path class="${classes}" d="${path}"/></svg>`;

// The small picture of a curve in the legend, with the classes of the static pictures.
function sampleOf(curve) {
  const colour = `s${curve.colour % 7}`;
  const points = {
    dots: "M9 0h0",
    crosses: "M5 -4l8 8m0 -8l-8 8",
    pluses: "M4 0h10m-5 -5v10",
    rings: "M5 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0",
    squares: "M5 -4h8v8h-8z",
  };
  return sampleWith(`${colour} ${curve.mark}`, points[curve.mark] || "M0 0h18");
}

class Figure {
  constructor(root) {
    this.root = root;
    this.spec = page.charts.get(root.dataset.chart);
    this.drawn = null;
    this.build();
  }

  get isSmall() {
    return this.root.parentElement.classList.contains("many") && !page.large.has(this.spec.id);
  }

  build() {
    const { root, spec } = this;
    this.head = element("div", "chart-head");
    this.head.append(element("span", "chart-title", spec.title));
    this.at = this.head.appendChild(element("output", "at"));
    this.back = this.head.appendChild(element("button", "plain back", "whole"));
    this.back.hidden = true;
    this.back.addEventListener("click", () => this.reset());
    if (root.parentElement.classList.contains("many")) {
      this.enlarge = this.head.appendChild(element("button", "plain enlarge", "enlarge"));
      this.enlarge.addEventListener("click", () => this.toggleLarge());
    }
    this.plot = element("div", "plot");
    this.canvas = this.plot.appendChild(element("canvas"));
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${spec.title}. ${keysInWords}`);
    this.line = this.plot.appendChild(element("div", "cross"));
    this.box = this.plot.appendChild(element("div", "selection"));
    this.legend = this.buildLegend();
    root.classList.add("live");
    root.classList.toggle("large", page.large.has(spec.id));
    root.prepend(this.head, this.plot, this.legend);
    this.listen();
  }

  buildLegend() {
    const legend = element("div", "legend");
    this.values = [];
    for (const curve of this.spec.curves) {
      if (curve.role === "data" && curve.label) this.addEntry(legend, curve, sampleOf(curve));
    }
    const area = (band) => sampleWith(`band b${band.colour % 7}`, "M0 -5h18v10h-18z");
    for (const band of this.spec.bands) if (band.label) this.addEntry(legend, band, area(band));
    const unnamed = this.spec.curves.find((curve) => curve.role === "data" && !curve.label);
    if (unnamed && !this.values.length && !this.spec.square) {
      this.values.push({ curve: unnamed, value: legend.appendChild(element("span", "value alone")) });
    }
    for (const label of new Set(this.spec.events.map((event) => event.label))) {
      const entry = legend.appendChild(element("span", "entry"));
      entry.innerHTML = sampleWith("event", "M9 -4l-4 8h8z");
      entry.append(label);
    }
    return legend;
  }

  addEntry(legend, curve, sample) {
    const entry = legend.appendChild(element("button", "entry"));
    entry.innerHTML = sample;
    entry.append(curve.owner && curve.owner !== curve.label ? `${curve.label} ${curve.owner}`.trim() : curve.label);
    const value = this.spec.square ? element("span") : entry.appendChild(element("span", "value"));
    const key = keyOfCurve(this.spec, curve);
    const say = () => entry.setAttribute("aria-pressed", String(!page.hidden.has(key)));
    say();
    entry.addEventListener("click", () => {
      if (!page.hidden.delete(key)) page.hidden.add(key);
      say();
      if (this.drawn) this.drawn.show();
    });
    this.values.push({ curve, value });
  }

  draw() {
    if (this.drawn) return;
    this.drawn = drawOn(this.canvas, this.spec, this.isSmall);
    this.back.hidden = !isZoomed(this.spec);
  }

  destroy() {
    if (this.drawn) this.drawn.live.destroy();
    this.drawn = null;
  }

  redraw() {
    this.destroy();
    this.root.classList.toggle("large", page.large.has(this.spec.id));
    if (this.enlarge) this.enlarge.textContent = page.large.has(this.spec.id) ? "smaller" : "enlarge";
    this.draw();
  }

  toggleLarge() {
    if (!page.large.delete(this.spec.id)) page.large.add(this.spec.id);
    this.redraw();
    this.canvas.focus({ preventScroll: true });
    this.root.scrollIntoView({ block: "nearest" });
  }

  // The figures whose x moves with this one's.
  companions() {
    return this.spec.group ? figures.filter((figure) => figure.spec.group === this.spec.group) : [this];
  }

  zoomTo(x, y) {
    page.zoomX.set(keyOfX(this.spec), x);
    if (y) page.zoomY.set(this.spec.id, y);
    this.showZoom();
  }

  reset() {
    page.zoomX.delete(keyOfX(this.spec));
    for (const figure of this.companions()) page.zoomY.delete(figure.spec.id);
    this.showZoom();
  }

  showZoom() {
    for (const figure of this.companions()) {
      figure.back.hidden = !isZoomed(figure.spec);
      figure.line.style.display = "none";
      if (figure.drawn) figure.drawn.show();
    }
  }

  // Narrower or wider by a factor about the cursor, or about the middle.
  zoomBy(factor) {
    const window = this.drawn.live.scales;
    const about = (scale, axis, middle) => {
      const of = (value) => (axis.log ? Math.log10(value) : value);
      const back = (value) => (axis.log ? 10 ** value : value);
      const at = of(middle);
      return [back(at - (at - of(scale.min)) * factor), back(at + (of(scale.max) - at) * factor)];
    };
    const middleOf = (scale) => scale.getValueForPixel((scale.left + scale.right) / 2);
    const middle = this.cursor ? this.cursor.x : middleOf(window.x);
    const x = about(window.x, this.spec.x, middle);
    if (!this.spec.square) return this.zoomTo(x);
    const height = (window.y.min + window.y.max) / 2;
    return this.zoomTo(x, about(window.y, this.spec.y, this.cursor ? this.cursor.y : height));
  }

  // The curve that the cursor runs along: of those that are shown a line, and of these one with the fewest points, for
  // other curves may have points between the samples.
  main() {
    const shownCurves = this.spec.curves.filter(
      (curve) => curve.role === "data" && curve.x.length && !page.hidden.has(keyOfCurve(this.spec, curve)),
    );
    if (this.cursor && shownCurves.includes(this.cursor.curve)) return this.cursor.curve;
    const lines = shownCurves.filter((curve) => isLine(curve) && curve.x.length > 2);
    const candidates = lines.length ? lines : shownCurves;
    return candidates.sort((a, b) => a.x.length - b.x.length)[0];
  }

  // The point that is nearest to these pixels: in x, or in both where a curve is not a function of x.
  pointAt(px, py) {
    const { x, y } = this.drawn.live.scales;
    if (!this.spec.square) {
      const curve = this.main();
      if (!curve) return null;
      const index = nearest(curve.x, x.getValueForPixel(px));
      return { curve, index, x: curve.x[index], y: curve.y[index] };
    }
    let best = null;
    let least = Infinity;
    for (const curve of this.spec.curves) {
      if (curve.role !== "data" || page.hidden.has(keyOfCurve(this.spec, curve))) continue;
      curve.x.forEach((value, index) => {
        const far = Math.hypot(x.getPixelForValue(value) - px, y.getPixelForValue(curve.y[index]) - py);
        if (far < least) {
          least = far;
          best = { curve, index, x: value, y: curve.y[index] };
        }
      });
    }
    return best;
  }

  moveTo(point, aloud) {
    if (!point) return;
    this.cursor = point;
    for (const figure of this.companions()) figure.showCursor(point, figure === this);
    if (aloud) say(`${this.at.textContent}: ${this.inWords()}`);
  }

  inWords() {
    return this.values.map(({ curve, value }) => `${curve.label} ${value.textContent}`.trim()).join(", ");
  }

  showCursor(point, isOwn) {
    if (!this.drawn) return;
    const { x, y } = this.drawn.live.scales;
    const px = x.getPixelForValue(point.x);
    const isInside = px >= x.left - 1 && px <= x.right + 1;
    this.line.style.display = isInside ? "block" : "none";
    this.line.style.transform = `translateX(${px}px)`;
    this.line.style.top = `${y.top}px`;
    this.line.style.height = `${y.bottom - y.top}px`;
    this.line.classList.toggle("point", this.spec.square);
    if (this.spec.square) return this.showPoint(point, px, y);
    const name = this.spec.x.label.replace(/ *\[.*/, "");
    const unit = (this.spec.x.label.match(/\[(.*)\]/) || [])[1] || "";
    if (isOwn || this.spec.group) this.at.textContent = `${name} ${shown(point.x, 5)} ${unit}`.trim();
    for (const { curve, value } of this.values) value.textContent = this.valueAt(curve, point.x);
    return undefined;
  }

  showPoint(point, px, y) {
    this.line.style.transform = `translate(${px}px, ${y.getPixelForValue(point.y) - y.top}px)`;
    this.line.style.height = "";
    const words = point.curve.texts ? point.curve.texts[point.index] : "";
    const place = `${shown(point.x)} ${point.y < 0 ? "−" : "+"} ${shown(Math.abs(point.y))}i`;
    this.at.textContent = [point.curve.label, place, words].filter(Boolean).join("  ");
  }

  valueAt(curve, at) {
    if (curve.low) {
      if (curve.x.length === 2) return `${shown(curve.low[0])} … ${shown(curve.high[0])}`;
      const i = nearest(curve.x, at);
      return `${shown(curve.low[i])} … ${shown(curve.high[i])}`;
    }
    const i = nearest(curve.x, at);
    return i < 0 ? "" : shown(curve.y[i]);
  }

  // So many points along the curve; the first press begins in the middle.
  step(count) {
    const curve = this.main();
    if (!curve) return;
    const { x } = this.drawn.live.scales;
    const middle = x.getValueForPixel((x.left + x.right) / 2);
    const begin = this.cursor ? this.cursor.index + count : nearest(curve.x, middle);
    const index = Math.min(Math.max(begin, 0), curve.x.length - 1);
    this.moveTo({ curve, index, x: curve.x[index], y: curve.y[index] }, true);
  }

  press(event) {
    const far = event.shiftKey ? 10 : 1;
    const end = this.main() ? this.main().x.length : 0;
    const actions = {
      ArrowLeft: () => this.step(-far),
      ArrowRight: () => this.step(far),
      Home: () => this.step(-end),
      End: () => this.step(end),
      "+": () => this.zoomBy(0.5),
      "=": () => this.zoomBy(0.5),
      "-": () => this.zoomBy(2),
      "_": () => this.zoomBy(2),
      Escape: () => (isZoomed(this.spec) || !page.large.has(this.spec.id) ? this.reset() : this.toggleLarge()),
      Enter: () => this.enlarge && this.toggleLarge(),
    };
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.draw();
    actions[event.key]();
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener("keydown", (event) => this.press(event));
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || !this.drawn) return;
      this.from = this.place(event);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!this.drawn) return;
      const to = this.place(event);
      this.moveTo(this.pointAt(to.x, to.y), false);
      if (this.from) this.showSelection(to);
    });
    canvas.addEventListener("pointerup", (event) => this.release(this.place(event)));
    canvas.addEventListener("pointercancel", () => this.endSelection());
    canvas.addEventListener("dblclick", () => this.reset());
  }

  // The selected part of the plot; the whole height where the drag is flat.
  selected(to) {
    const { x, y } = this.drawn.live.scales;
    const between = (value, low, high) => Math.min(Math.max(value, low), high);
    const xs = [this.from.x, to.x].map((value) => between(value, x.left, x.right)).sort((a, b) => a - b);
    let ys = [this.from.y, to.y].map((value) => between(value, y.top, y.bottom)).sort((a, b) => a - b);
    const isFlat = ys[1] - ys[0] < 16 && !this.spec.square;
    if (isFlat) ys = [y.top, y.bottom];
    return { xs, ys, isFlat };
  }

  showSelection(to) {
    const { xs, ys } = this.selected(to);
    const style = { left: xs[0], top: ys[0], width: xs[1] - xs[0], height: ys[1] - ys[0] };
    for (const name of Object.keys(style)) this.box.style[name] = `${style[name]}px`;
    this.box.style.display = xs[1] - xs[0] > 5 ? "block" : "none";
  }

  endSelection() {
    this.from = null;
    this.box.style.display = "none";
  }

  release(to) {
    if (!this.from) return;
    const { xs, ys, isFlat } = this.selected(to);
    const isClick = Math.hypot(to.x - this.from.x, to.y - this.from.y) < 4;
    this.endSelection();
    if (isClick && this.isSmall) this.toggleLarge();
    if (xs[1] - xs[0] < 6 || (!isFlat && ys[1] - ys[0] < 6)) return;
    const { x, y } = this.drawn.live.scales;
    const values = (scale, pixels) => pixels.map((pixel) => scale.getValueForPixel(pixel)).sort((a, b) => a - b);
    this.zoomTo(values(x, xs), isFlat ? undefined : values(y, ys));
  }
}
