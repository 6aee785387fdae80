// What can be asked of the lines and junctions that are selected, and what has been.

import { hint, incident } from "./canvas.js";
import { html } from "./elements.js";
import { aboutOriginal, entries, origins, staying } from "./fitting.js";

const PAIRS = ["through", "not_through"];
const OPPOSITE = { same_wire: "different_wire", different_wire: "same_wire", through: "not_through", not_through: "through", start_at: "cut_at", cut_at: "start_at" };

const members = (value) => JSON.stringify([value].flat().toSorted((a, b) => a - b));

/** The change that adds a wish, and takes away one that says the opposite of the same lines. */
function wishing(state, wish) {
  const [kind] = Object.keys(wish).filter((key) => key !== "at");
  const release = state.constraints
    .filter(({ constraint: each }) => each[OPPOSITE[kind]] !== undefined && members(each[OPPOSITE[kind]]) === members(wish[kind]) && (each.at === undefined || each.at === wish.at || !PAIRS.includes(kind)))
    .map(({ index }) => index);
  return { constrain: [wish], release };
}

/** Where the config holds this wish already. */
const held = (state, wish) =>
  state.constraints.filter(({ constraint }) => Object.entries(wish).every(([key, value]) => constraint[key] !== undefined && members(constraint[key]) === members(value))).map(({ index }) => index);

/** How wires pass now: `a,b` of every two segment ends that a wire joins at a junction. */
function passes(state, junction) {
  const { drawing, wires } = state.shown;
  const found = new Set();
  const leaves = ([segment, reversed]) => (reversed ? drawing.segments[segment].start : drawing.segments[segment].end);
  for (const wire of wires) {
    const steps = wire.segments;
    steps.forEach((step, index) => {
      const next = steps[index + 1] ?? (wire.closed ? steps[0] : null);
      if (next && leaves(step) === junction) found.add(members([step[0], next[0]]));
    });
  }
  return found;
}

const carrier = (state, segment) => {
  const index = state.shown.wires.findIndex((wire) => wire.segments.some(([each]) => each === segment));
  return index < 0 ? "" : ` (${state.shown.wires[index].name})`;
};

/** A button that is pressed while the wish is held; pressed again, it takes the wish away. */
function ask(state, act, label, wish) {
  const release = held(state, wish);
  const clicked = () => act(release.length ? { release } : wishing(state, wish));
  return html("button", { type: "button", "aria-pressed": String(release.length > 0), onclick: clicked }, label);
}

function aboutJunction(state, junction, act) {
  const ends = incident(state.shown.drawing)[junction];
  const title = ends.length === 1 ? `End ${junction}` : `Junction ${junction}`;
  const here = [
    ask(state, act, "A wire starts here", { start_at: junction }),
    ends.length > 1 ? ask(state, act, "All wires end here", { cut_at: junction }) : null,
    html("button", { type: "button", onclick: () => act({ set: { "bail.at": String(junction) } }) }, "Hang the piece here"),
  ];
  const now = passes(state, junction);
  const rows = [];
  const segments = [...new Set(ends.map(([segment]) => segment))].sort((a, b) => a - b);
  segments.forEach((a, index) => {
    for (const b of segments.slice(index + 1)) {
      const both = new Set([a, b]);
      const shared = state.shown.drawing.segments.filter((each, at) => both.has(at) && each.start !== each.end);
      const twice = shared.length === 2 && members([shared[0].start, shared[0].end]) === members([shared[1].start, shared[1].end]);
      const at = twice ? { at: junction } : {};
      const lit = { onmouseenter: () => hint([a, b], true), onmouseleave: () => hint([a, b], false) };
      rows.push(
        html(
          "div",
          { class: "pair", ...lit },
          html("span", {}, `${a} – ${b}`, now.has(members([a, b])) ? " · a wire passes" : ""),
          ask(state, act, "Pass", { through: [a, b], ...at }),
          ask(state, act, "Don't", { not_through: [a, b], ...at }),
        ),
      );
    }
  });
  return [html("h2", {}, title), html("p", { class: "buttons" }, ...here), rows.length ? html("h3", {}, "From line to line") : null, ...rows];
}

function aboutSegments(state, [a, b], act) {
  if (b === undefined)
    return [html("h2", {}, `Line ${a}${carrier(state, a)}`), html("p", { class: "soft" }, "Click another line: are they one wire?"), ...staying(state, origins(state, a), act)];
  const pair = [a, b];
  const stay = staying(state, [...new Set(pair.flatMap((each) => origins(state, each)))], act, "these lines");
  const { segments } = state.shown.drawing;
  const meet = [segments[a].start, segments[a].end].filter((each) => [segments[b].start, segments[b].end].includes(each));
  const met = new Set(meet);
  const buttons = [ask(state, act, "Same wire", { same_wire: pair }), ask(state, act, "Different wires", { different_wire: pair })];
  if (met.size === 1) buttons.push(ask(state, act, "Pass from one to the other", { through: pair }), ask(state, act, "Never pass so", { not_through: pair }));
  const lines = met.size > 1 ? html("p", { class: "soft" }, "They meet twice: click a junction to say how wires pass there.") : null;
  return [html("h2", {}, `Lines ${a}${carrier(state, a)} and ${b}${carrier(state, b)}`), html("p", { class: "buttons" }, ...buttons), lines, ...stay];
}

/** The panel about what is selected; `act` takes a change. */
export function chosen(state, selected, act) {
  if (!state.shown.drawing) return [];
  if (selected.junction !== null) return aboutJunction(state, selected.junction, act);
  if (selected.original !== null) return aboutOriginal(state, selected.original, act);
  if (selected.segments.length) return aboutSegments(state, selected.segments, act);
  return [
    html("h2", {}, "Say how it is to be"),
    html("p", { class: "soft" }, "Click two lines: are they one wire? Click a junction: how do wires pass it? Click an end: does a wire start there? Click one line: does it stay?"),
  ];
}

/** The wishes that the config holds, each with a button that takes it away. */
export function wishes(state, act) {
  const wished = state.constraints.map(({ index, text }) => ({ text, away: () => act({ release: [index] }) }));
  const all = [...wished, ...entries(state, act)];
  if (!all.length) return [];
  const items = all.map(({ text, away }) =>
    html("li", {}, html("span", {}, text), html("button", { type: "button", class: "plain", "aria-label": `take away: ${text}`, onclick: away }, "Take away")),
  );
  return [html("h2", {}, "Your wishes"), html("ul", { class: "plain" }, ...items)];
}
