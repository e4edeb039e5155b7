// SPDX-License-Identifier: MIT
// From a chart to Chart.js: curves are its datasets; bands, circles, lines and words are drawn by a plugin.

const dashOf = { dashes: [7, 4], "dash-dots": [8, 3, 2, 3], dotted: [2, 3] };
const pointOf = {
  dots: { pointStyle: "circle", radius: 1.6 },
  crosses: { pointStyle: "crossRot", radius: 5, borderWidth: 2 },
  pluses: { pointStyle: "cross", radius: 6, borderWidth: 2 },
  rings: { pointStyle: "circle", radius: 4.5, borderWidth: 2 },
  squares: { pointStyle: "rect", radius: 6, borderWidth: 2 },
};

// The colours of the page's style, as they are now.
function colours() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(name).trim();
  const curves = [0, 1, 2, 3, 4, 5, 6].map((i) => read(`--curve-${i}`));
  return {
    curves,
    ink: read("--ink"),
    faint: read("--faint"),
    rule: read("--rule"),
    ghost: read("--ghost"),
    paper: read("--paper"),
    font: getComputedStyle(document.body).fontFamily,
  };
}

function colourOf(curve, palette) {
  if (curve.role === "ghost") return palette.ghost;
  return curve.role === "grid" ? palette.rule : palette.curves[curve.colour % palette.curves.length];
}

// Chart.js draws what has the lower order later: the last curve stands over all others.
function datasetOf(chart, curve, palette, index) {
  const colour = colourOf(curve, palette);
  const point = pointOf[curve.mark];
  const isLog = [chart.x.log, chart.y.log];
  const place = (value, log) => (log && value <= 0 ? NaN : value);
  return {
    data: curve.x.map((x, i) => ({ x: place(x, isLog[0]), y: place(curve.y[i], isLog[1]) })),
    hidden: page.hidden.has(keyOfCurve(chart, curve)),
    showLine: !point,
    stepped: curve.mark === "steps" ? "before" : false,
    borderColor: colour,
    borderWidth: curve.role === "grid" ? 1 : 1.8,
    borderDash: dashOf[curve.mark] || [],
    borderJoinStyle: "round",
    pointRadius: point ? point.radius : 0,
    pointStyle: point ? point.pointStyle : "circle",
    pointBorderColor: colour,
    pointBorderWidth: point ? point.borderWidth || 0 : 0,
    pointBackgroundColor: curve.mark === "dots" ? colour : "transparent",
    order: 1000 * { data: 1, ghost: 2, grid: 3 }[curve.role] - index,
  };
}

function scaleOf(axis, [low, high], palette, isX, isSmall) {
  return {
    type: axis.log ? "logarithmic" : "linear",
    position: isX ? "bottom" : "left",
    min: low,
    max: high,
    title: { display: Boolean(axis.label) && !isSmall, text: axis.label, color: palette.faint, align: "end" },
    grid: {
      color: (context) => (context.tick && context.tick.value === 0 ? palette.faint : palette.rule),
      borderColor: palette.rule,
      drawTicks: false,
    },
    ticks: {
      color: palette.faint,
      padding: 5,
      maxRotation: 0,
      autoSkip: false,
      callback: (value) => shown(value, 6),
    },
    afterBuildTicks: (scale) => {
      const most = isX ? Math.max(2, scale.maxWidth / 72) : Math.max(2, scale.maxHeight / 36);
      const at = axis.log ? decadeTicks(scale.min, scale.max, most) : evenTicks(scale.min, scale.max, most);
      scale.ticks = at.map((value) => ({ value: Object.is(value, -0) ? 0 : value }));
    },
    // Charts below each other have their axes below each other.
    afterFit: (scale) => {
      if (!isX) scale.width = Math.max(scale.width, isSmall ? 44 : 64);
    },
  };
}

// Both axes with one scale: the axis with room shows more.
function madeSquare([xLow, xHigh, yLow, yHigh], area) {
  const width = area.right - area.left;
  const height = area.bottom - area.top;
  const unit = Math.max((xHigh - xLow) / width, (yHigh - yLow) / height);
  const about = (low, high, size) => [(low + high - unit * size) / 2, (low + high + unit * size) / 2];
  return [...about(xLow, xHigh, width), ...about(yLow, yHigh, height)];
}

// Draws the part of a chart that Chart.js does not know.
class Painter {
  constructor(live, spec, palette) {
    this.context = live.ctx;
    this.area = live.chartArea;
    this.spec = spec;
    this.palette = palette;
    this.x = (value) => live.scales.x.getPixelForValue(value);
    this.y = (value) => live.scales.y.getPixelForValue(value);
  }

  inside(draw) {
    const { context, area } = this;
    context.save();
    context.beginPath();
    context.rect(area.left, area.top, area.right - area.left, area.bottom - area.top);
    context.clip();
    context.font = `11px ${this.palette.font}`;
    draw();
    context.restore();
  }

  band(band) {
    const { context } = this;
    const held = (value) => Math.min(Math.max(this.y(value), this.area.top - 4), this.area.bottom + 4);
    context.beginPath();
    band.x.forEach((x, i) => context.lineTo(this.x(x), held(band.high[i])));
    for (let i = band.x.length - 1; i >= 0; --i) context.lineTo(this.x(band.x[i]), held(band.low[i]));
    context.closePath();
    context.globalAlpha = 0.16;
    context.fillStyle = this.palette.curves[band.colour % this.palette.curves.length];
    context.fill();
    context.globalAlpha = 1;
  }

  circle(circle) {
    const { context } = this;
    context.beginPath();
    const across = Math.abs(this.x(circle.x + circle.radius) - this.x(circle.x));
    const up = Math.abs(this.y(circle.y + circle.radius) - this.y(circle.y));
    context.ellipse(this.x(circle.x), this.y(circle.y), across, up, 0, 0, 2 * Math.PI);
    context.setLineDash([3, 3]);
    context.strokeStyle = this.palette.faint;
    context.stroke();
    context.setLineDash([]);
  }

  word(text, x, y, align) {
    const { context } = this;
    context.textAlign = align;
    context.lineWidth = 3;
    context.strokeStyle = this.palette.paper;
    context.strokeText(text, x, y);
    context.fillStyle = this.palette.ink;
    context.fillText(text, x, y);
  }

  guide(guide) {
    const { context, area } = this;
    const isX = guide.axis === "x";
    const at = isX ? this.x(guide.at) : this.y(guide.at);
    context.beginPath();
    context.moveTo(isX ? at : area.left, isX ? area.top : at);
    context.lineTo(isX ? at : area.right, isX ? area.bottom : at);
    context.setLineDash([4, 3]);
    context.lineWidth = 1;
    context.strokeStyle = this.palette.faint;
    context.stroke();
    context.setLineDash([]);
    const isRight = at > (area.left + area.right) / 2;
    if (isX) this.word(guide.label, at + (isRight ? -4 : 4), area.top + 11, isRight ? "end" : "start");
    else if (at >= area.top && at <= area.bottom) {
      this.word(guide.label, area.right - 3, at - 14 < area.top ? at + 12 : at - 4, "end");
    }
  }

  note(note) {
    const { context } = this;
    const x = this.x(note.x);
    const y = this.y(note.y);
    const along = { x: this.x(note.x + note.dx) - x, y: this.y(note.y + note.dy) - y };
    const length = Math.hypot(along.x, along.y);
    if (length > 0) {
      const c = (6 * along.x) / length;
      const s = (6 * along.y) / length;
      context.beginPath();
      context.moveTo(x + c, y + s);
      context.lineTo(x - c / 2 - s / 2, y - s / 2 + c / 2);
      context.lineTo(x - c / 2 + s / 2, y - s / 2 - c / 2);
      context.fillStyle = this.palette.ink;
      context.fill();
    }
    const isRight = x + 8 + context.measureText(note.text).width > this.area.right;
    this.word(note.text, x + (isRight ? -8 : 8), y - 5, isRight ? "end" : "start");
  }

  event(event) {
    const { context } = this;
    const x = this.x(event.at);
    context.beginPath();
    context.moveTo(x, this.area.bottom - 8);
    context.lineTo(x - 4, this.area.bottom);
    context.lineTo(x + 4, this.area.bottom);
    context.fillStyle = this.palette.ink;
    context.fill();
  }
}

function pluginOf(spec, palette) {
  return {
    id: "lqg",
    beforeDatasetsDraw(live) {
      const painter = new Painter(live, spec, palette());
      painter.inside(() => {
        spec.bands.forEach((band) => page.hidden.has(keyOfCurve(spec, band)) || painter.band(band));
        spec.circles.forEach((circle) => painter.circle(circle));
      });
    },
    afterDatasetsDraw(live) {
      const painter = new Painter(live, spec, palette());
      painter.inside(() => {
        spec.guides.forEach((guide) => painter.guide(guide));
        spec.notes.forEach((note) => painter.note(note));
        spec.events.forEach((event) => painter.event(event));
      });
    },
  };
}

// A live chart on this canvas. restyle() reads the colours anew, show() the window and what is hidden.
function drawOn(canvas, spec, isSmall) {
  let palette = colours();
  const [xLow, xHigh, yLow, yHigh] = shownWindow(spec);
  const options = (window) => ({
    animation: false,
    responsive: true,
    maintainAspectRatio: false,
    // Rising x can be cut where it is outside of the window; a curve in a plane is in no order.
    parsing: spec.square ? { xAxisKey: "x", yAxisKey: "y" } : false,
    normalized: !spec.square,
    events: [],
    font: { family: palette.font },
    plugins: { legend: { display: false }, tooltip: { enabled: false } },
    scales: {
      x: scaleOf(spec.x, window.slice(0, 2), palette, true, isSmall),
      y: scaleOf(spec.y, window.slice(2), palette, false, isSmall),
    },
  });
  const live = new Chart(canvas, {
    type: "scatter",
    data: { datasets: spec.curves.map((curve, i) => datasetOf(spec, curve, palette, i)) },
    options: options([xLow, xHigh, yLow, yHigh]),
    plugins: [pluginOf(spec, () => palette)],
  });
  const setWindow = (window) => {
    Object.assign(live.options.scales.x, { min: window[0], max: window[1] });
    Object.assign(live.options.scales.y, { min: window[2], max: window[3] });
    live.update("none");
  };
  const show = () => {
    spec.curves.forEach((curve, i) => {
      live.data.datasets[i].hidden = page.hidden.has(keyOfCurve(spec, curve));
    });
    setWindow(shownWindow(spec));
    if (spec.square) setWindow(madeSquare(shownWindow(spec), live.chartArea));
  };
  if (spec.square) {
    show();
    live.options.onResize = () => requestAnimationFrame(() => live.ctx && show());
  }
  const restyle = () => {
    palette = colours();
    live.data.datasets = spec.curves.map((curve, i) => datasetOf(spec, curve, palette, i));
    live.options.scales = options(shownWindow(spec)).scales;
    show();
  };
  return { live, show, restyle };
}
