// Lines that are kept and left out, by their numbers in the drawing that was read, and what made it fit for wire.

import { html, prose } from "./elements.js";
import { keep } from "./panels.js";

const OPPOSITE = { keep: "drop", drop: "keep" };
const DONE = { dropped: "left out", faired: "made smoother" };

/** The numbers that a line had when it was read; a bridge had none. */
export function origins(state, segment) {
  const { fit, drawing } = state.shown;
  if (fit) return fit.origins[segment] ?? [];
  return drawing.segments[segment].kind === "bridge" ? [] : [segment];
}

const strokes = ({ fit, drawing }) => (fit?.original ?? drawing).segments.filter((each) => each.kind !== "bridge").length;

/** A button that is pressed while the config names all of the lines; pressed again, it takes them out of there. */
function ask(state, act, key, label, numbers) {
  const held = numbers.every((each) => state[key].includes(each));
  const none = key === "drop" && !held && new Set([...state.drop, ...numbers]).size >= strokes(state.shown);
  const clicked = () => act(held ? { take: { [key]: numbers } } : { add: { [key]: numbers }, take: { [OPPOSITE[key]]: numbers } });
  return html("button", { type: "button", "aria-pressed": String(held), disabled: none, title: none ? "Nothing would be left." : null, onclick: clicked }, label);
}

/** What can be asked of lines by the numbers that they had when they were read. */
export function staying(state, numbers, act, which = "this line") {
  if (!numbers.length) return [];
  const level = state.controls.find((each) => each.key === "fit")?.value ?? "off";
  const keeps = level !== "off" || numbers.some((each) => state.keep.includes(each));
  const told = "Wishes name lines by their numbers, which change when a line goes: look at them again.";
  return [
    html("p", { class: "buttons" }, keeps ? ask(state, act, "keep", `Keep ${which}`, numbers) : null, ask(state, act, "drop", `Leave ${which} out`, numbers)),
    state.constraints.length ? html("p", { class: "soft" }, told) : null,
  ];
}

/** The panel about a line of the drawing that was read. */
export function aboutOriginal(state, number, act) {
  const now = state.shown.fit.origins.flatMap((each, index) => (each.includes(number) ? [index] : []));
  const told = now.length ? `It is in line${now.length > 1 ? "s" : ""} ${now.join(" and ")} now.` : state.drop.includes(number) ? "It is left out, as you said." : "It is left out.";
  return [html("h2", {}, `Line ${number} as it was read`), html("p", { class: "soft" }, told), ...staying(state, [number], act)];
}

/** The lines that the config keeps and leaves out, each with a button that takes it out of there. */
export function entries(state, act) {
  const all = [...state.keep.map((number) => ["keep", number, `line ${number}, as it was read, is kept`]), ...state.drop.map((number) => ["drop", number, `line ${number}, as it was read, is left out`])];
  return all.map(([key, number, text]) => ({ text, away: () => act({ take: { [key]: [number] } }) }));
}

const share = (part) => (part > 0 && part < 0.01 ? "under 1 %" : `${Math.round(100 * part)} %`);
const face = (mm) => (mm === null ? "none" : `${mm.toFixed(1)} mm`);

function table({ before, after, costs }) {
  const rows = [
    ["Segments", before.segments, after.segments],
    ["Wires, at least", before.wires, after.wires],
    ["Tight bends", before.tight_bends, after.tight_bends],
    ["Smallest face", face(before.smallest_face_mm), face(after.smallest_face_mm)],
    ["Lines left out", share(0), share(costs.left_out)],
  ];
  const head = html("tr", {}, html("td"), ...["Before", "After"].map((each) => html("th", { scope: "col" }, each)));
  const body = rows.map(([name, ...values]) => html("tr", {}, html("th", { scope: "row" }, name), ...values.map((each) => html("td", {}, String(each)))));
  return html("table", {}, html("thead", {}, head), html("tbody", {}, ...body));
}

function listed(changes, locate) {
  const items = changes.map((each, index) => {
    const name = `${DONE[each.what] ?? each.what}, ${each.length_mm.toFixed(1)} mm`;
    const where = html("button", { type: "button", class: "plain", "data-change": index, onclick: () => locate(index) }, `${index + 1} · ${name}`);
    return html("li", {}, where, each.reason ? html("span", {}, ...prose(each.reason)) : null);
  });
  const open = changes.length <= 8; // as many as fit beside the picture
  return html("details", { open }, html("summary", {}, `${changes.length} change${changes.length === 1 ? "" : "s"}`), html("ul", { class: "places" }, ...items));
}

/** Before and after, and what was changed; a click shows its place. */
export function fitness(place, state, current, locate) {
  const { fit } = state.shown;
  keep(place, JSON.stringify(fit && [fit.before, fit.after, fit.costs, fit.changes]), () => {
    if (!fit) return [];
    const changes = fit.changes.length ? listed(fit.changes, locate) : html("p", { class: "soft" }, "Nothing had to be changed.");
    return [html("h2", {}, "Fit for wire"), table(fit), changes];
  });
  for (const each of place.querySelectorAll("[data-change]")) each.closest("li").classList.toggle("shown", Number(each.dataset.change) === current);
}

/** What is selected, as it is called in a newer state: lines are numbered anew when others go. */
export function followed(selected, before, after, side) {
  if (!before?.shown.drawing || !after.shown.drawing) return selected;
  const { fit, drawing } = after.shown;
  const among = (numbers) => drawing.segments.findIndex((_, index) => origins(after, index).some((each) => numbers.includes(each)));
  const asked = selected.segments.map((each) => origins(before, each)).filter((each) => each.length);
  const read = selected.original === null ? [] : [[selected.original]];
  const stays = fit && selected.original !== null && (side === "before" || fit.left_out.includes(selected.original));
  const segments = [...new Set((stays ? asked : [...asked, ...read]).map(among))].filter((each) => each >= 0);
  const gone = asked.flat().find((each) => fit?.left_out.includes(each)) ?? null;
  const at = before.shown.drawing.junctions[selected.junction];
  const junction = at ? drawing.junctions.findIndex(([x, y]) => Math.hypot(x - at[0], y - at[1]) < 1e-3) : -1;
  const changed = JSON.stringify(before.shown.fit?.changes) !== JSON.stringify(fit?.changes);
  return { ...selected, segments, original: stays ? selected.original : segments.length ? null : gone, junction: junction < 0 ? null : junction, change: changed ? null : selected.change };
}
