// SPDX-License-Identifier: MIT
// The live page. Its data stand in the element lqg-data; scripts that share the page use
//
//   lqgPage.draw(data, options)   draws anew from what page_json() wrote (an object): the curves that are hidden, the
//                                 zoom, the chosen views and the focus stay. options.ghost: data of another page,
//                                 whose curves stand grey behind those of the same chart
//   lqgPage.errors(lines)         shows these lines over the page as it is; an empty list takes them away
//   lqgPage.charts()              ids of all charts
//   lqgPage.chart(id)             of one: {spec, live}: its data and its Chart of Chart.js, drawn if it was not
//   lqgPage.drawAll()             draws all charts that are shown, also those outside of the window; gives ms
//   lqgPage.drawnIn               ms that drawing the page took the last time

let figures = [];
let observer = null;

function say(words) {
  document.getElementById("lqg-said").textContent = words;
}

// Draws a chart when it comes near the window.
function watchFigures() {
  if (observer) observer.disconnect();
  observer = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) if (entry.isIntersecting) entry.target.lqgFigure.draw();
    },
    { rootMargin: "400px" },
  );
  for (const figure of figures) observer.observe(figure.root);
}

function drawVisible() {
  for (const figure of figures) {
    const box = figure.root.getBoundingClientRect();
    if (box.width > 0 && box.bottom > 0 && box.top < window.innerHeight) figure.draw();
  }
}

// Buttons for few views of a section, a list for many.
function addChoice(section) {
  const views = [...section.querySelectorAll(":scope > .view")];
  if (views.length < 2) return;
  section.classList.add("chosen");
  const names = views.map((view) => view.dataset.name);
  const show = (name) => {
    page.views.set(section.id, name);
    views.forEach((view) => view.classList.toggle("current", view.dataset.name === name));
    drawVisible();
  };
  const first = names.includes(page.views.get(section.id)) ? page.views.get(section.id) : names[0];
  const choice = names.length > 6 ? listOf(names, first, show) : buttonsOf(names, first, show);
  views[0].before(choice);
  show(first);
}

function listOf(names, first, show) {
  const list = element("select", "choice");
  list.setAttribute("aria-label", "what is shown");
  for (const name of names) list.append(new Option(name, name, false, name === first));
  list.addEventListener("change", () => show(list.value));
  return list;
}

function buttonsOf(names, first, show) {
  const row = element("div", "choice");
  row.setAttribute("role", "group");
  for (const name of names) {
    const button = row.appendChild(element("button", "", name));
    button.setAttribute("aria-pressed", String(name === first));
    button.addEventListener("click", () => {
      for (const other of row.children) other.setAttribute("aria-pressed", String(other === button));
      show(name);
    });
  }
  return row;
}

// What a person has opened, and where the keyboard is.
function remember(main) {
  const focused = document.activeElement && document.activeElement.closest("[data-chart]");
  return {
    open: new Set([...main.querySelectorAll("details[open]")].map((details) => details.dataset.name)),
    focus: focused && document.activeElement.tagName === "CANVAS" ? focused.dataset.chart : null,
  };
}

function recall(main, { open, focus }) {
  for (const details of main.querySelectorAll("details")) {
    if (open.has(details.dataset.name)) details.open = true;
  }
  const figure = figures.find(({ spec }) => spec.id === focus);
  if (figure) figure.canvas.focus({ preventScroll: true });
}

function draw(given, options = {}) {
  const began = performance.now();
  const main = document.getElementById("lqg-page");
  const data = expand(structuredClone(given));
  if (options.ghost) addGhosts(data, expand(structuredClone(options.ghost)));
  const before = remember(main);
  for (const figure of figures) figure.destroy();
  if (data.body) main.innerHTML = data.body;
  if (data.title) document.title = data.title;
  page.charts = new Map(data.charts.map((chart) => [chart.id, chart]));
  figures = [...main.querySelectorAll("[data-chart]")].map((root) => {
    root.lqgFigure = new Figure(root);
    return root.lqgFigure;
  });
  main.querySelectorAll("section").forEach(addChoice);
  main.querySelectorAll("[data-matrix]").forEach(addCopying);
  recall(main, before);
  drawVisible();
  watchFigures();
  lqgPage.drawnIn = performance.now() - began;
}

function restyle() {
  for (const figure of figures) if (figure.drawn) figure.drawn.restyle();
}

const lqgPage = {
  draw,
  errors(lines) {
    const box = document.getElementById("lqg-errors");
    box.textContent = lines.join("\n");
    box.hidden = !lines.length;
  },
  charts: () => figures.map((figure) => figure.spec.id),
  chart(id) {
    const figure = figures.find(({ spec }) => spec.id === id);
    if (!figure) return undefined;
    figure.draw();
    return { spec: figure.spec, live: figure.drawn.live };
  },
  drawAll() {
    const began = performance.now();
    for (const figure of figures) if (figure.root.getBoundingClientRect().width > 0) figure.draw();
    return performance.now() - began;
  },
  drawnIn: 0,
};
window.lqgPage = lqgPage;

document.documentElement.classList.add("scripted");
draw(JSON.parse(document.getElementById("lqg-data").textContent));
for (const query of ["(prefers-color-scheme: dark)", "print"]) {
  window.matchMedia(query).addEventListener("change", restyle);
}
