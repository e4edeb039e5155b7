// SPDX-License-Identifier: MIT
// The panel: follows the file, has a slider for each number that lqgen names, and asks for the design with them.
// view/session.hpp says what the messages are.
(() => {
  "use strict";

  const steps = 1000; // of a slider
  const rest = 150; // ms without a move until the whole design is computed
  const byId = (id) => document.getElementById(id);
  const status = byId("lqg-status");

  let state = { revision: 0, lines: [], line: 0, has_error: false, tunables: [], others: [], page: null };
  let other = null; // name and page of the design whose curves are grey, where it is not the file's
  let wantsOther = false; // it is to be asked for when the sliders rest
  let sliders = [];
  let asks = false; // a first look is under way
  let moved = false; // since it was asked for
  let settled = 0; // timer until the whole is asked for
  let solving = false; // it is under way
  let lastMove = 0; // when, in ms
  let draggedIn = []; // ms from the last move before a question to its drawn answer, of the last questions

  function say(words, isBad = false) {
    status.textContent = words;
    status.classList.toggle("bad", isBad);
  }

  // ---- sliders

  function digits(value, count) {
    return Number(value.toPrecision(count));
  }

  function valueAt(tunable, position) {
    const { low, high, scale, step } = tunable;
    const share = position / steps;
    if (scale === "logarithmic") return digits(low * (high / low) ** share, 3);
    const value = low + (high - low) * share;
    if (scale === "whole") return Math.round(value);
    if (step > 0) return digits(Math.round(value / step) * step, 12);
    const grain = 10 ** Math.floor(Math.log10((high - low) / steps));
    return digits(Math.round(value / grain) * grain, 12);
  }

  function positionOf(tunable, value) {
    const { low, high, scale } = tunable;
    const share = scale === "logarithmic" ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    return Math.round(steps * Math.min(1, Math.max(0, Number.isFinite(share) ? share : 0)));
  }

  function make(tag, name, text) {
    const node = document.createElement(tag);
    if (name) node.className = name;
    if (text) node.textContent = text;
    return node;
  }

  class Slider {
    constructor(tunable, index) {
      this.tunable = tunable;
      this.value = tunable.value;
      this.root = make("div", "slider");
      const label = this.root.appendChild(make("label", "", tunable.name));
      label.htmlFor = `lqg-slider-${index}`;
      this.range = this.root.appendChild(make("input"));
      Object.assign(this.range, { type: "range", min: 0, max: steps, step: 1, id: label.htmlFor });
      this.range.dataset.key = tunable.targets[0].key;
      this.number = this.root.appendChild(make("input", "number"));
      Object.assign(this.number, { type: "text", inputMode: "decimal", autocomplete: "off", spellcheck: false });
      this.number.setAttribute("aria-label", `${tunable.name}, ${tunable.group}`);
      this.root.appendChild(make("span", "unit", tunable.unit)).title = tunable.unit;
      this.range.addEventListener("input", () => this.set(valueAt(tunable, Number(this.range.value))));
      this.number.addEventListener("change", () => this.type());
      this.show();
    }
    get isChanged() {
      return this.value !== this.tunable.value;
    }
    show() {
      this.range.value = positionOf(this.tunable, this.value);
      this.range.setAttribute("aria-valuetext", `${this.value} ${this.tunable.unit}`.trim());
      this.number.value = String(this.value);
      this.number.removeAttribute("aria-invalid");
      this.root.classList.toggle("changed", this.isChanged);
    }
    set(value) {
      this.value = value;
      this.show();
      move();
    }
    type() {
      const text = this.number.value.trim().replace(",", ".");
      const value = Number(text);
      if (text && Number.isFinite(value)) this.set(value);
      else this.number.setAttribute("aria-invalid", "true");
    }
    changes() {
      return this.tunable.targets.map(({ key, factor }) => ({ key, value: factor * this.value }));
    }
  }

  const changed = () => sliders.filter((slider) => slider.isChanged);
  const changes = () => changed().flatMap((slider) => slider.changes());
  const nameOf = (tunable) => tunable.targets.map(({ key }) => key).join(" ");

  // The sliders of the new state; those that were moved and are still there keep their values and the focus.
  function build(tunables) {
    const moved = new Map(changed().map((slider) => [nameOf(slider.tunable), slider.value]));
    const same = JSON.stringify(tunables) === JSON.stringify(sliders.map(({ tunable }) => tunable));
    if (same) return;
    const focus = document.activeElement && document.activeElement.id;
    sliders = tunables.map((tunable, index) => new Slider(tunable, index));
    const groups = new Map();
    for (const slider of sliders) {
      const { group } = slider.tunable;
      if (!groups.has(group)) {
        const set = make("fieldset");
        set.appendChild(make("legend", "", group));
        groups.set(group, set);
      }
      groups.get(group).append(slider.root);
      if (moved.has(nameOf(slider.tunable))) slider.value = moved.get(nameOf(slider.tunable));
      slider.show();
    }
    byId("lqg-sliders").replaceChildren(...groups.values());
    if (focus && focus.startsWith("lqg-slider-") && byId(focus)) byId(focus).focus({ preventScroll: true });
  }

  // ---- what is shown

  // While the file has an error there are no sliders for it: those of before wait.
  const waits = () => state.has_error && !state.tunables.length;

  function showButtons() {
    const none = !changed().length || waits();
    byId("lqg-sliders").inert = waits();
    byId("lqg-back").disabled = none;
    byId("lqg-write").disabled = none;
  }

  function showErrors(message) {
    lqgPage.errors(message.has_error ? message.lines : []);
    byId("lqg-page").classList.toggle("old", message.has_error && !message.has_page);
  }

  const grey = () => (other ? `; grey: ${other.name}` : "");

  function showFile() {
    if (state.page) lqgPage.draw(state.page, { ghost: (other && other.page) || undefined });
    showErrors(state);
    if (!state.has_error) say(`The design of the file${grey()}`);
    else say(state.line > 0 ? `The file has an error at line ${state.line}` : "The design has an error", true);
  }

  function showTrial(message, isWhole) {
    showErrors(message);
    if (message.page) lqgPage.draw(message.page, { ghost: (other && other.page) || state.page || undefined });
    if (message.has_error && message.page) say("These numbers miss what is required; the picture shows them", true);
    else if (message.has_error) say("These numbers make no design; the picture is the last one", true);
    else if (isWhole)
      say(`The design with these numbers, in ${Math.round(message.milliseconds)} ms${grey() || "; grey: the file"}`);
    else say("First look; computing all digits, margins at the outputs, rounding");
  }

  // ---- asking

  async function post(path, question = { revision: state.revision, changes: changes() }) {
    const response = await fetch(path, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(question),
    });
    return { status: response.status, ...(await response.json()) };
  }

  function show(message, isWhole) {
    if (message.superseded) return;
    if (message.status === 200) showTrial(message, isWhole);
    else if (message.status !== 409) say(message.error, true); // 409: the new state is on its way
  }

  // First looks, one after the other as long as sliders move. While one is drawn lqgen computes the next.
  async function look() {
    if (asks) return;
    asks = true;
    let answer = null;
    try {
      for (;;) {
        const began = lastMove;
        const coming = moved && changed().length ? post("look") : null;
        moved = false;
        if (answer && answer.state === state && changed().length) {
          show(answer, false);
          draggedIn = [...draggedIn.slice(-99), performance.now() - answer.began];
        }
        if (!coming) break;
        const asked = state;
        answer = { ...(await coming), state: asked, began };
      }
    } catch {
      lost();
    }
    asks = false;
    resume();
  }

  async function solve() {
    const asked = state;
    const move = lastMove;
    try {
      solving = true;
      const answer = await post("solve").finally(() => (solving = false));
      if (asked !== state || move !== lastMove) return;
      show(answer, true);
      if (answer.superseded) settled = setTimeout(settle, rest); // by another page of this lqgen
      resume();
    } catch {
      lost();
    }
  }

  function settle() {
    settled = 0;
    if (asks) settled = setTimeout(settle, rest);
    else if (changed().length) solve();
  }

  function move() {
    moved = true;
    lastMove = performance.now();
    clearTimeout(settled);
    settled = 0;
    showButtons();
    if (!changed().length) {
      showFile();
      return resume();
    }
    say("Computing");
    look();
    settled = setTimeout(settle, rest);
  }

  byId("lqg-back").addEventListener("click", () => {
    for (const slider of sliders) {
      slider.value = slider.tunable.value;
      slider.show();
    }
    move();
  });

  byId("lqg-write").addEventListener("click", async () => {
    try {
      const message = await post("write");
      if (message.status === 200) say("Written");
      else say(`Not written: ${message.error}`, true);
    } catch {
      lost();
    }
  });

  // ---- another file's curves

  const list = byId("lqg-other");

  function showOthers() {
    const names = state.others;
    list.parentElement.hidden = !names.length;
    if (names.join("/") === [...list.options].slice(1).map(({ value }) => value).join("/")) return;
    const chosen = names.includes(list.value) ? list.value : "";
    list.replaceChildren(new Option("of the file", ""), ...names.map((name) => new Option(name, name)));
    list.value = chosen;
  }

  const computes = () => asks || solving || settled !== 0;

  function resume() {
    if (wantsOther && !computes()) compare();
  }

  // lqgen breaks off one question for the next: numbers that are being tried come first.
  async function compare() {
    const name = list.value;
    wantsOther = computes();
    if (wantsOther) return;
    try {
      const message = name ? await post("other", { name }) : { page: null };
      if (name !== list.value) return;
      if (message.superseded) {
        wantsOther = true;
        setTimeout(resume, rest); // by another page of this lqgen
      } else takeOther(name, message);
    } catch {
      lost();
    }
  }

  function takeOther(name, message) {
    if (name && !message.page) {
      list.value = other ? other.name : "";
      say(`${name} makes no design: ${message.error || message.lines[0]}`, true);
      return;
    }
    other = name ? { name, page: message.page } : null;
    if (changed().length && !waits()) move();
    else showFile();
  }

  list.addEventListener("change", compare);

  // ---- following

  function lost() {
    say("Connection lost: lqgen has ended", true);
  }

  function take(message) {
    state = message;
    if (!waits()) build(state.tunables);
    showButtons();
    showOthers();
    if (changed().length && !waits()) move();
    else showFile();
    if (list.value) compare();
  }

  async function follow() {
    for (let isLost = false; ; ) {
      try {
        const response = await fetch(`state?since=${state.revision}`);
        if (!response.ok) throw new Error(String(response.status));
        const message = await response.json();
        if (isLost || message.revision !== state.revision) take(message);
        isLost = false;
      } catch {
        lost();
        isLost = true;
        await new Promise((resolve) => setTimeout(resolve, 1000));
      }
    }
  }

  window.lqgPanel = { draggedIn: () => draggedIn };
  follow();
})();
