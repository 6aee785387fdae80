// Fewer wires for lines that are run along twice: a slider over what was found, and what each place of it costs.

import { html } from "./elements.js";
import { keep } from "./panels.js";

const CHOICE = "decomposition.choice";
const KEY = "decomposition.max_wires";
const COLUMNS = ["Wires", "Run twice", "Bends"];
let newest = null;
let dragged = false;
let moved = 0; // and not yet in the file
let asked = false; // by the button, which had the keyboard

const counted = (wires) => `${wires} wire${wires === 1 ? "" : "s"}`;
const numbers = (each) => [String(each.wires), `${Math.round(each.doubled_mm)} mm`, `${Math.round(each.bends_deg)}°`];
const words = (each) => `${counted(each.wires)}, ${Math.round(each.doubled_mm)} mm run twice, bends ${Math.round(each.bends_deg)}° in all`;

/** Places run from the fewest wires, on the left, to those without a limit. */
const found = (state) => (Array.isArray(state.fewer_wires) ? [...state.fewer_wires].reverse() : null);

/** The place of what a limit gives: the most wires that it allows. */
function placeOf(places, limit) {
  if (limit === null || limit === "" || limit >= places.at(-1).wires) return places.length - 1;
  return Math.max(0, places.findLastIndex((each) => each.max_wires !== null && each.max_wires <= limit));
}

function say(slider) {
  const each = found(newest)[slider.value];
  slider.setAttribute("aria-valuetext", words(each));
  [...document.querySelectorAll(`#${slider.id}-costs tbody tr`)].forEach((row, index) => row.setAttribute("aria-current", String(index === Number(slider.value))));
}

/** Puts the slider where the file has it, unless somebody is moving it. */
function stand(slider) {
  const places = found(newest);
  if (!dragged && !moved) slider.value = placeOf(places, newest.controls.find((each) => each.key === KEY).value);
  say(slider);
}

/** What is told beside the slider is of the best wires, so another choice goes. */
async function take(slider, act) {
  const { max_wires } = found(newest)[slider.value];
  const chosen = newest.controls.some((each) => each.key === CHOICE && each.given) ? [CHOICE] : [];
  moved += 1;
  const { error } = await act(max_wires === null ? { unset: [KEY, ...chosen] } : { set: { [KEY]: max_wires }, unset: chosen });
  moved -= 1;
  dragged = false;
  if (error) stand(slider);
}

/** The slider; it works once there is something to choose among. */
export function field(id, act) {
  return html("input", {
    id,
    type: "range",
    min: 0,
    max: 1,
    step: 1,
    disabled: true,
    "aria-describedby": `${id}-help ${id}-told`,
    oninput: (event) => {
      dragged = true;
      say(event.target);
    },
    onchange: (event) => take(event.target, act),
  });
}

/** What is said below the slider. */
export function beside(id, look) {
  return html(
    "div",
    {},
    html("p", { class: "soft", id: `${id}-told`, role: "status" }),
    html("div", { id: `${id}-costs`, class: "costs" }),
    html("button", { type: "button", id: `${id}-look`, onclick: () => ((asked = true), look()) }, "Show what fewer wires cost"),
  );
}

function told(state, limit, places) {
  const asked = limit === null || limit === "" ? "" : `The file asks for at most ${limit}. `;
  if (state.fewer_wires?.building) return `${asked}Looking for what fewer wires cost …`;
  if (state.fewer_wires?.error) return [state.fewer_wires.error.problem, state.fewer_wires.error.remedy].filter(Boolean).join("; ");
  if (!places) return asked;
  return places.length === 1 ? "Fewer wires can't be had." : "Fewest wires on the left.";
}

function table(places) {
  const head = html("tr", {}, ...COLUMNS.map((each) => html("th", { scope: "col" }, each)));
  const rows = places.map((each) => html("tr", {}, ...numbers(each).map((number) => html("td", {}, number))));
  return [html("table", {}, html("thead", {}, head), html("tbody", {}, ...rows))];
}

/** Shows the state: the slider stands at what the file asks for. */
export function shown(each, id, state) {
  newest = state;
  const places = found(state);
  const slider = document.getElementById(id);
  const busy = Boolean(state.fewer_wires?.building);
  const look = document.getElementById(`${id}-look`);
  look.hidden = places !== null;
  look.disabled = busy || !state.shown.drawing;
  const said = told(state, each.value, places);
  const line = document.getElementById(`${id}-told`);
  if (line.textContent !== said) line.textContent = said;
  slider.disabled = !places || places.length === 1;
  keep(document.getElementById(`${id}-costs`), JSON.stringify(places), () => (places ? table(places) : []));
  if (!places) return;
  slider.max = Math.max(1, places.length - 1);
  if (places.length === 1) slider.value = 1;
  else stand(slider);
  if (asked && [look, document.body].includes(document.activeElement)) slider.focus();
  asked = false;
}
