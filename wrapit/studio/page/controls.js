// The settings: one control for each key of the config that matters, in groups.

import { html, prose } from "./elements.js";
import * as fewer from "./fewer.js";

const GROUPS = { piece: "The piece", wire: "Wire", wires: "How it is divided", jig: "Printed jig", laser: "Laser-cut jig", guide: "Guide", files: "Files" };
const OPEN = ["piece", "wire"];

/** Keys with a control of a kind of their own. */
const OWN = { "decomposition.max_wires": fewer };

function wrong(control, error) {
  const place = control.querySelector(".wrong");
  place.hidden = !error;
  place.textContent = error ? [error.problem, error.remedy].filter(Boolean).join("; ") : "";
  for (const input of control.querySelectorAll("input, select")) input.setAttribute("aria-invalid", String(Boolean(error)));
}

async function set(control, key, value, act) {
  const { error } = await act({ set: { [key]: value } }, { quiet: true });
  wrong(control, error);
}

function field(each, id, act) {
  const control = () => document.getElementById(`control-${id}`);
  const described = { "aria-describedby": `${id}-help ${id}-wrong` };
  const changed = (read) => ({ onchange: (event) => set(control(), each.key, read(event.target), act) });
  if (each.kind === "choice")
    return html("select", { id, ...described, ...changed((input) => input.value) }, ...each.choices.map((choice) => html("option", { value: choice }, choice)));
  if (each.kind === "switch") return html("input", { id, type: "checkbox", ...described, ...changed((input) => input.checked) });
  if (each.kind === "choices") {
    const all = (input) => [...input.closest("fieldset").querySelectorAll("input")].filter((box) => box.checked).map((box) => box.value);
    const boxes = each.choices.map((choice) => html("label", {}, html("input", { type: "checkbox", value: choice, ...changed(all) }), choice));
    return html("fieldset", { id, ...described }, html("legend", {}, each.label), ...boxes);
  }
  const limits = each.kind === "number" ? { type: "number", min: each.min, max: each.max, step: each.step ?? "any" } : { type: "text" };
  const value = (input) => (each.kind === "number" && input.value !== "" ? Number(input.value) : input.value);
  return html("input", { id, ...limits, ...described, autocomplete: "off", spellcheck: "false", ...changed(value) });
}

function made(each, act, look) {
  const id = each.key.replaceAll(".", "-");
  const given = html("button", { type: "button", class: "plain reset", onclick: () => act({ unset: [each.key] }), "aria-label": `${each.label}: back to ${each.default ?? "none"}` }, "Reset");
  return html(
    "div",
    { class: `control ${each.kind}`, id: `control-${id}` },
    each.kind === "choices" ? null : html("label", { for: id }, each.label),
    html("div", { class: "row" }, OWN[each.key] ? OWN[each.key].field(id, act) : field(each, id, act), given),
    OWN[each.key] ? OWN[each.key].beside(id, look) : null,
    html("p", { class: "help", id: `${id}-help` }, ...prose(each.help)),
    html("p", { class: "wrong", id: `${id}-wrong`, role: "alert", hidden: true }),
  );
}

function shown(each, state) {
  const id = each.key.replaceAll(".", "-");
  const control = document.getElementById(`control-${id}`);
  control.classList.toggle("given", each.given);
  control.querySelector(".reset").hidden = !each.given;
  const input = document.getElementById(id);
  if (OWN[each.key]) return OWN[each.key].shown(each, id, state);
  if (control.contains(document.activeElement) && control.querySelector(".wrong").hidden === false) return;
  if (each.kind === "choices") {
    for (const box of input.querySelectorAll("input")) box.checked = each.value.includes(box.value);
    return;
  }
  if (input === document.activeElement && each.kind !== "switch" && each.kind !== "choice") return;
  if (each.kind === "switch") input.checked = Boolean(each.value);
  else input.value = each.value ?? "";
  wrong(control, null);
}

/** Makes the controls once, and afterwards shows their values; what somebody is writing is left alone. */
export function controls(place, state, act, look) {
  const keys = state.controls.map((each) => each.key).join(" ");
  if (place.dataset.keys !== keys) {
    place.dataset.keys = keys;
    const groups = Object.keys(GROUPS).filter((group) => state.controls.some((each) => each.group === group));
    place.replaceChildren(
      ...groups.map((group) =>
        html(
          "details",
          { open: OPEN.includes(group) },
          html("summary", {}, GROUPS[group]),
          ...state.controls.filter((each) => each.group === group).map((each) => made(each, act, look)),
        ),
      ),
    );
  }
  for (const each of state.controls) shown(each, state);
  // What belongs to a block that is switched off would do nothing.
  const off = state.controls.filter((each) => each.kind === "switch" && !each.value).map((each) => `${each.key}.`);
  for (const each of state.controls)
    document.getElementById(`control-${each.key.replaceAll(".", "-")}`).hidden = off.some((key) => each.key.startsWith(key));
}
