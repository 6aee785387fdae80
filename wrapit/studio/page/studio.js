// The page: shows the studio's state, and sends what is clicked back. The config is the one truth.

import { canvas } from "./canvas.js";
import { chosen, wishes } from "./choosing.js";
import { controls } from "./controls.js";
import { html } from "./elements.js";
import { fitness, followed } from "./fitting.js";
import { arrows, named, renew } from "./keyboard.js";
import * as panels from "./panels.js";
import * as server from "./server.js";

const TABS = { wires: "Wires", jig: "Jig", guide: "Guide", ways: "Ways to divide it", text: "Text", files: "Files" };
const LAYERS = { wires: "wires", read: "its lines", numbers: "numbers", notes: "notes", picture: "the picture" };
const SIDES = { both: "both", before: "before", after: "after" };
const NOTHING = { segments: [], original: null, junction: null, finding: null, change: null };

const at = (id) => document.getElementById(id);
const view = { tab: "wires", selected: NOTHING, layers: { side: "both", wires: true, read: false, numbers: false, notes: false, picture: false } };
let state = null;
let picture = null;

function showTab(name) {
  view.tab = name;
  for (const each of Object.keys(TABS)) {
    at(`tab-${each}`).setAttribute("aria-selected", String(each === name));
    at(`tab-${each}`).tabIndex = each === name ? 0 : -1;
    at(`view-${each}`).hidden = each !== name;
  }
}

function makeTabs() {
  const names = Object.keys(TABS);
  const turned = (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    showTab(names[(names.indexOf(view.tab) + step + names.length) % names.length]);
    at(`tab-${view.tab}`).focus();
  };
  at("tabs").append(
    ...names.map((name) => html("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `view-${name}`, onclick: () => showTab(name), onkeydown: turned }, TABS[name])),
  );
  at("layers").append(
    "Show: ",
    ...Object.entries(LAYERS).map(([key, label]) => {
      const toggled = (event) => {
        view.layers[key] = event.target.checked;
        showPicture();
      };
      return html("label", {}, html("input", { type: "checkbox", id: `layer-${key}`, checked: view.layers[key], onchange: toggled }), ` ${label}`);
    }),
  );
  at("sides").append(
    html("legend", {}, "As it was read, and as it is made fit for wire:"),
    ...Object.entries(SIDES).map(([key, label]) => html("label", {}, html("input", { type: "radio", name: "side", id: `side-${key}`, checked: view.layers.side === key, onchange: () => showSide(key) }), ` ${label}`)),
  );
  showTab("wires");
}

function showSide(key) {
  view.layers.side = key;
  at(`side-${key}`).checked = true;
  showPicture();
}

const pick = {
  segment(index) {
    const { segments } = view.selected;
    const kept = segments.includes(index) ? segments.filter((each) => each !== index) : [...segments, index].slice(-2);
    view.selected = { ...NOTHING, segments: kept };
    showPicture();
  },
  junction(index) {
    view.selected = { ...NOTHING, junction: view.selected.junction === index ? null : index };
    showPicture();
  },
  original(index) {
    view.selected = { ...NOTHING, original: view.selected.original === index ? null : index };
    showPicture();
  },
  finding(index) {
    view.selected.finding = index;
    showFindings();
    at(`finding-${index}`).scrollIntoView({ block: "nearest" });
  },
};

function locate(index) {
  view.selected.finding = index;
  showTab("wires");
  showPicture();
  document.querySelector(`#canvas [data-finding="${index}"]`)?.focus();
  showFindings();
}

/** Shows the place of a change; a line that was left out there is chosen at once. */
function locateChange(index) {
  const { line } = state.shown.fit.changes[index];
  view.selected = { ...NOTHING, original: line, change: index };
  showTab("wires");
  showSide(line !== null && view.layers.side === "after" ? "both" : view.layers.side);
  document.querySelector("#canvas .change")?.scrollIntoView({ block: "nearest" });
  if (line !== null) document.querySelector(`#canvas [data-original="${line}"]`)?.focus();
  showFitness();
}

/** What has the keyboard keeps it when the picture is drawn anew. */
function focused() {
  const element = document.activeElement;
  return at("canvas").contains(element) ? named(element) : null;
}

function showPicture() {
  if (!state) return;
  const { drawing } = state.shown;
  const known = (index, all) => all && index < all.length;
  view.selected.segments = view.selected.segments.filter((each) => known(each, drawing?.segments));
  if (view.selected.junction !== null && !known(view.selected.junction, drawing?.junctions)) view.selected.junction = null;
  const read = state.shown.fit?.original.segments;
  if (view.selected.original !== null && !known(view.selected.original, read)) view.selected.original = null;
  const again = focused();
  const pressed = at("chosen").contains(document.activeElement) ? document.activeElement.textContent : null;
  at("canvas").replaceChildren(canvas(state, view.selected, view.layers, picture, pick));
  at("canvas").classList.toggle("stale", !state.fresh);
  renew(at("canvas"));
  if (again) at("canvas").querySelector(again)?.focus();
  at("layer-picture").closest("label").hidden = !drawing?.pixel_frame;
  at("sides").hidden = !state.shown.fit;
  at("chosen").replaceChildren(...chosen(state, view.selected, act).filter(Boolean));
  if (pressed) [...at("chosen").querySelectorAll("button")].find((each) => each.textContent === pressed)?.focus();
}

const showFitness = () => fitness(at("fit-for-wire"), state, view.selected.change, locateChange);

const showFindings = () => at("findings").replaceChildren(...panels.findings(state, view.selected.finding, locate, act));

function statusText() {
  const { building } = state;
  if (building) return `Making: ${building.stage} …`;
  if (state.problem) return "The last good state is shown.";
  const total = Object.values(state.shown.timings_s ?? {}).filter((each) => typeof each === "number").reduce((sum, each) => sum + each, 0);
  return state.fresh ? `All made${total ? ` in ${total.toFixed(1)} s` : ""}.` : "Waiting …";
}

function show() {
  document.title = `${state.name} – wrapit studio`;
  at("name").textContent = state.name;
  at("status").textContent = statusText();
  const progress = at("progress");
  progress.hidden = !state.building;
  if (state.building) Object.assign(progress, { max: state.building.stages.length, value: state.building.done.length });
  at("undo").disabled = !state.can_undo;
  at("redo").disabled = !state.can_redo;
  at("problem").hidden = !state.problem;
  at("problem").replaceChildren(...panels.problem(state, act, tryAgain).filter(Boolean));
  controls(at("settings"), state, act, look);
  loadPicture();
  showPicture();
  at("wishes").replaceChildren(...wishes(state, act));
  showFitness();
  at("numbers").replaceChildren(...panels.numbers(state));
  showFindings();
  panels.jig(at("view-jig"), state);
  panels.guide(at("view-guide"), state);
  panels.ways(at("view-ways"), state, ask, act);
  panels.text(at("view-text"), state, server.saveText);
  panels.files(at("view-files"), state);
}

/** Sends a change; where it is refused the page says why, unless the control that sent it does (quiet). */
async function act(wanted, { quiet = false } = {}) {
  const told = await server.change(wanted);
  if (!quiet) complain(told.error);
  return told;
}

async function ask(count) {
  complain((await server.showWays(count)).error);
}

async function look() {
  complain((await server.showFewerWires()).error);
}

async function tryAgain() {
  complain((await server.again()).error);
}

function complain(error) {
  if (!error) return;
  at("problem").hidden = false;
  at("problem").replaceChildren(...panels.problem({ problem: error }, act, tryAgain).filter(Boolean));
}

let shownPicture = null;
/** The drawing itself, to lay beneath what was read of it; fetched anew when that changed. */
function loadPicture() {
  const key = JSON.stringify([state.shown.report?.drawing_sha256, state.shown.drawing?.pixel_frame]);
  if (!state.shown.drawing?.pixel_frame || shownPicture === key) return;
  shownPicture = key;
  const loaded = new Image();
  loaded.onload = () => {
    picture = loaded;
    if (view.layers.picture) showPicture();
  };
  loaded.src = `/drawing?v=${encodeURIComponent(key)}`;
}

let waiting = false;
let stale = false;
async function refresh() {
  if (waiting) {
    stale = true;
    return;
  }
  waiting = true;
  const newest = await server.state();
  waiting = false;
  if (newest && (!state || newest.revision >= state.revision)) {
    view.selected = followed(view.selected, state, newest, view.layers.side);
    state = newest;
    show();
  }
  if (stale) {
    stale = false;
    refresh();
  }
}

function lost() {
  at("status").textContent = "The studio doesn't answer: is it still running?";
}

makeTabs();
arrows(at("canvas"));
at("undo").addEventListener("click", async () => complain((await server.undo()).error));
at("redo").addEventListener("click", async () => complain((await server.redo()).error));
document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || event.target.closest("input, textarea, select")) return;
  event.preventDefault();
  (event.shiftKey ? server.redo() : server.undo()).then(({ error }) => complain(error));
});
server.follow(refresh, lost);
