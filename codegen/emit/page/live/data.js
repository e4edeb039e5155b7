// SPDX-License-Identifier: MIT
// What is shown: the charts as page_json.cpp writes them, and what of them a person has chosen to see.

// The whole state of the page. Charts are known by their ids; `hidden` has keys of keyOfCurve().
const page = {
  charts: new Map(), // id → chart as it came
  hidden: new Set(),
  zoomX: new Map(), // group or id → [low, high]
  zoomY: new Map(), // id → [low, high]
  views: new Map(), // id of a section → name of the view that is shown
  large: new Set(), // ids of charts of an overview that are shown large
};

const keyOfCurve = (chart, curve) => [chart.id, curve.owner || "", curve.label].join("\n");
const keyOfX = (chart) => chart.group || chart.id;

// Puts the lists of numbers where their indices stand, and NaN in place of null.
function expand(data) {
  const lists = data.lists.map((values) => values.map((value) => (value === null ? NaN : value)));
  for (const chart of data.charts) {
    for (const curve of chart.curves) {
      curve.x = lists[curve.x];
      curve.y = lists[curve.y];
    }
    for (const band of chart.bands) for (const name of ["x", "low", "high"]) band[name] = lists[band[name]];
  }
  return data;
}

// The curves of the charts of the same id, to be drawn grey behind the others.
function addGhosts(data, older) {
  const old = new Map(older.charts.map((chart) => [chart.id, chart]));
  for (const chart of data.charts) {
    const behind = old.get(chart.id);
    if (!behind) continue;
    const ghosts = behind.curves.filter((curve) => curve.role === "data");
    chart.curves = ghosts.map((curve) => ({ ...curve, role: "ghost", label: "" })).concat(chart.curves);
  }
}

// Index of the value that is nearest in rising values; −1 without any.
function nearest(values, wanted) {
  let low = 0;
  let high = values.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] < wanted) low = middle;
    else high = middle;
  }
  if (high < 0) return -1;
  return Math.abs(values[low] - wanted) <= Math.abs(values[high] - wanted) ? low : high;
}

// What the shown curves need inside of [low, high] of x, 3 % more on each side.
function rangeOfY(chart, [low, high]) {
  let range = [Infinity, -Infinity];
  const log = chart.y.log;
  const include = (value) => {
    if (!Number.isFinite(value) || (log && value <= 0)) return;
    range = [Math.min(range[0], value), Math.max(range[1], value)];
  };
  for (const curve of chart.curves) {
    if (curve.role === "grid" || page.hidden.has(keyOfCurve(chart, curve))) continue;
    curve.x.forEach((x, i) => {
      if (x >= low && x <= high) include(curve.y[i]);
    });
  }
  if (!(range[0] < range[1])) return chart.view.slice(2);
  if (log) {
    const factor = (range[1] / range[0]) ** 0.03;
    return [range[0] / factor, range[1] * factor];
  }
  const room = 0.03 * (range[1] - range[0]);
  return [range[0] - room, range[1] + room];
}

// [x low, x high, y low, y high]
function shownWindow(chart) {
  const zoomed = page.zoomX.get(keyOfX(chart));
  const x = zoomed || chart.view.slice(0, 2);
  const y = page.zoomY.get(chart.id) || (zoomed && !chart.square ? rangeOfY(chart, x) : chart.view.slice(2));
  return [...x, ...y];
}

const isZoomed = (chart) => page.zoomX.has(keyOfX(chart)) || page.zoomY.has(chart.id);

// Ticks of 1, 2 or 5 times a power of ten, at most `most` of them.
function evenTicks(low, high, most) {
  const power = 10 ** Math.floor(Math.log10((high - low) / most));
  const step = power * [1, 2, 5, 10].find((factor) => (high - low) / (factor * power) <= most);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(k * step);
  return ticks;
}

function decadeTicks(low, high, most) {
  const first = Math.floor(Math.log10(low) + 1e-9);
  const last = Math.ceil(Math.log10(high) - 1e-9);
  const stride = Math.max(1, Math.ceil((last - first + 1) / most));
  const inDecade = last - first <= 2 || (last - first) * 3 <= most ? [1, 2, 5] : [1];
  const ticks = [];
  for (let decade = first; decade <= last; decade += stride) {
    ticks.push(...inDecade.map((factor) => factor * 10 ** decade));
  }
  return ticks.filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
}

// A number in so many significant digits, for people.
function shown(value, digits = 4) {
  if (!Number.isFinite(value)) return "–";
  const rounded = Number(value.toPrecision(digits));
  const size = Math.abs(rounded);
  const text = size !== 0 && (size >= 1e6 || size < 1e-4) ? rounded.toExponential() : String(rounded);
  return text.replace("e+", "e").replace(/-/g, "−");
}
