// Everything around the picture: findings, numbers, jig, guide, ways to divide it, the text, the files.

import { thumbnail } from "./canvas.js";
import { html, prose } from "./elements.js";
import { fileAddress } from "./server.js";

const error = ({ problem, where, remedy }) => [html("p", {}, html("strong", {}, problem)), where ? html("p", { class: "soft" }, where) : null, remedy ? html("p", {}, ...prose(remedy)) : null];

const fixes = (finding, act) =>
  (finding.fixes ?? []).length ? html("p", { class: "buttons" }, ...finding.fixes.map((fix) => html("button", { type: "button", onclick: () => act(fix.change) }, fix.label))) : null;

/** Why nothing newer can be shown, with what would help. */
export function problem(state, act, again) {
  if (!state.problem) return [];
  const retry = state.again ? html("p", { class: "buttons" }, html("button", { type: "button", onclick: again }, "Try again")) : null;
  return [...error(state.problem), fixes(state.problem, act), retry];
}

function place(each, index, current, locate) {
  const name = `${index + 1} · ${each.where}`;
  const where = each.at ? html("button", { type: "button", class: "plain", onclick: () => locate(index) }, name) : html("span", {}, name);
  return html("li", { id: `finding-${index}`, class: current === index ? "shown" : null }, where, html("span", {}, ...prose(each.message)));
}

/** Findings of one kind, each with its place and words, their remedy said once. */
function kind(group, current, locate, act) {
  const [[first]] = group;
  return html(
    "div",
    { class: `finding ${first.level}` },
    html("strong", {}, first.level),
    html("ul", { class: "places" }, ...group.map(([each, index]) => place(each, index, current, locate))),
    first.remedy ? html("p", { class: "soft" }, ...prose(first.remedy)) : null,
    fixes(first, act),
  );
}

/** What the maker should know, each with its remedy; errors first, notes folded away. A click shows its place. */
export function findings(state, current, locate, act) {
  if (!state.shown.drawing) return [];
  if (!state.findings.length) return [html("h2", {}, "Findings"), html("p", { class: "soft" }, "None: nothing stands in the way.")];
  const groups = new Map();
  state.findings.forEach((each, index) => {
    const key = JSON.stringify([each.level, each.code, each.remedy]);
    groups.set(key, [...(groups.get(key) ?? []), [each, index]]);
  });
  const of = (level) => [...groups.values()].filter(([[first]]) => first.level === level).map((group) => kind(group, current, locate, act));
  const notes = state.findings.filter((each) => each.level === "note").length;
  const open = document.getElementById("notes")?.open || state.findings[current]?.level === "note";
  const folded = html("details", { id: "notes", open }, html("summary", {}, `${notes} note${notes === 1 ? "" : "s"}`), ...of("note"));
  return [html("h2", {}, `Findings (${state.findings.length})`), ...of("error"), ...of("warning"), notes ? folded : ""];
}

const mm = (value) => `${Math.round(value)} mm`;

/** The wires with their lengths, and whether nothing better can be. */
export function numbers(state) {
  const { wires, energy, optimal, report } = state.shown;
  if (!wires.length) return [];
  const rows = wires.map((wire, index) => {
    const dot = html("span", { class: "swatch" });
    dot.style.background = wire.colour;
    return html("tr", {}, html("td", {}, dot, String(index + 1)), html("td", {}, mm(wire.length_mm)), html("td", {}, mm(wire.cut_length_mm)));
  });
  const head = html("tr", {}, ...["Wire", "Length", "Cut"].map((each) => html("th", { scope: "col" }, each)));
  const told = [];
  if (energy) told.push(optimal ? "Proven: no division is better." : "The best that was found.");
  if (report?.drawing) told.push(`${report.drawing.size_mm.map(mm).join(" × ")}.`);
  return [html("h2", {}, `${wires.length} wire${wires.length === 1 ? "" : "s"}`), html("p", { class: "soft" }, told.join(" ")), html("table", {}, html("thead", {}, head), html("tbody", {}, ...rows))];
}

/** Puts children into a place only where they differ from what is there, so that pictures don't flicker. */
export function keep(place, key, make) {
  if (place.dataset.shown === key) return;
  place.dataset.shown = key;
  place.replaceChildren(...make());
}

const named = (name) => name.replace(/\.png$/, "").replace(/^preview/, "from above").replace(/^view/, "at an angle").replaceAll("-", " ");

/** The pictures of the jigs. */
export function jig(place, state) {
  const files = Object.entries(state.shown.files).filter(([name]) => /^(preview|view).*\.png$/.test(name));
  files.sort(([a], [b]) => a.replace(/^view/, "preview").localeCompare(b.replace(/^view/, "preview")) || a.localeCompare(b));
  keep(place, JSON.stringify(files), () =>
    files.length
      ? files.map(([name, digest]) => html("figure", {}, html("img", { class: "picture", src: fileAddress(name, digest), alt: `The jig ${named(name)}` }), html("figcaption", { class: "soft" }, named(name))))
      : [html("p", { class: "soft" }, "The jig is shown when it is made.")],
  );
}

/** The guide, walled off from this page. */
export function guide(place, state) {
  const digest = state.shown.files["guide.html"];
  const print = state.shown.files["guide.pdf"];
  keep(place, `${digest} ${print}`, () =>
    digest
      ? [
          html("p", {}, html("a", { href: fileAddress("guide.html", digest), target: "_blank", rel: "noopener" }, "In a tab of its own"), print ? " · " : null, print ? html("a", { href: fileAddress("guide.pdf", print), target: "_blank", rel: "noopener" }, "To print") : null),
          html("iframe", { src: fileAddress("guide.html", digest), sandbox: "allow-scripts", title: "The guide, step by step" }),
        ]
      : [html("p", { class: "soft" }, "The guide is shown when all is made, if `outputs` has html.")],
  );
}

/** The best ways to divide the drawing, side by side; a click takes one. */
export function ways(place, state, ask, act) {
  const choice = state.controls.find((each) => each.key === "decomposition.choice")?.value ?? 1;
  keep(place, JSON.stringify([state.alternatives, choice, state.shown.drawing !== null]), () => {
    const start = [html("p", {}, "There are often several good ways to divide a drawing. Choose the one that you like best.")];
    const found = state.alternatives;
    const busy = Boolean(found?.building);
    start.push(html("button", { type: "button", id: "show-ways", disabled: busy || !state.shown.drawing, onclick: () => ask(6) }, busy ? "Looking …" : "Show six ways"));
    if (found?.error) start.push(html("div", { class: "wrong", role: "alert" }, ...error(found.error).filter(Boolean)));
    if (!Array.isArray(found)) return start;
    const cards = found.map((each) =>
      html(
        "button",
        { type: "button", class: "way", "data-way": each.number, "aria-pressed": String(Number(choice) === each.number), onclick: () => act({ set: { "decomposition.choice": each.number } }) },
        thumbnail(state.shown.drawing, each.drawn),
        html("strong", {}, `${each.number}: ${each.wires} wires`),
        ` · bends ${Math.round((each.energy.smoothness_rad * 180) / Math.PI)}°`,
        each.energy.robustness ? ` · loose ends ${Math.round(each.energy.robustness * 100) / 100}` : "",
      ),
    );
    return [...start, html("div", { class: "ways" }, ...cards)];
  });
}

/** The config as text; an edit that is under way is kept when the file changes meanwhile. */
export function text(place, state, save) {
  if (!place.dataset.made) {
    place.dataset.made = "yes";
    const area = html("textarea", { id: "yaml", spellcheck: "false", "aria-label": "The config as YAML" });
    const told = html("p", { class: "wrong", role: "alert", id: "yaml-wrong" });
    const submit = async (base) => {
      const sent = area.value;
      const { error: failed } = await save(sent, base);
      told.textContent = failed ? [failed.where, failed.problem, failed.remedy].filter(Boolean).join("; ") : "";
      if (failed) return;
      area.dataset.from = sent;
      other.hidden = true;
    };
    const reload = () => {
      area.value = area.dataset.newest;
      area.dataset.from = area.value; // in which every line ends as the page ends it
      area.dataset.base = area.dataset.newestBase;
      told.textContent = "";
      other.hidden = true;
    };
    const button = (id, label, onclick) => html("button", { type: "button", id, onclick }, label);
    const other = html(
      "div",
      { id: "yaml-other", role: "alert", hidden: true },
      html("p", {}, "The file has been changed while you were writing here. Your text is kept until you choose:"),
      html("p", { class: "buttons" }, button("overwrite-text", "Save mine in its place", () => submit(area.dataset.newestBase)), button("reload-text", "Take what the file says now", reload)),
    );
    place.append(
      html("p", { class: "soft" }, "This is the file: what is changed on this page is written here, and what is changed here, or in an editor, shows on the page."),
      area,
      told,
      other,
      html("p", { class: "buttons" }, button("save-text", "Save", () => submit(area.dataset.base)), button("drop-text", "Drop what I wrote", reload)),
    );
  }
  const area = place.querySelector("textarea");
  const untouched = area.dataset.from === undefined || area.value === area.dataset.from;
  Object.assign(area.dataset, { newest: state.text, newestBase: state.text_sha256 });
  if (!untouched) {
    document.getElementById("yaml-other").hidden = area.dataset.base === state.text_sha256;
    return;
  }
  const shown = state.text.replace(/\r\n?/g, "\n"); // as an area has it, whatever it is given
  if (area.value !== shown) area.value = shown;
  area.dataset.from = shown;
  area.dataset.base = state.text_sha256;
}

const WHAT = [
  [/^guide\.html$/, "the guide, for a browser"],
  [/^guide\.pdf$/, "the guide to print, with the piece at true size"],
  [/^(jig|form).*\.(3mf|stl)$/, "for the 3D printer"],
  [/\.step$/, "exact solids, for FreeCAD and other CAD programs"],
  [/\.dxf$/, "for the laser cutter"],
  [/^report\.json$/, "every number and finding"],
  [/^config\.lock\.yaml$/, "the config with every default"],
];

/** Every file of the last build. */
export function files(place, state) {
  const all = Object.entries(state.shown.files);
  keep(place, JSON.stringify(all), () => {
    const rows = all.map(([name, digest]) =>
      html("tr", {}, html("td", {}, html("a", { href: fileAddress(name, digest), target: "_blank", rel: "noopener" }, name)), html("td", { class: "soft" }, WHAT.find(([pattern]) => pattern.test(name))?.[1] ?? "")),
    );
    return rows.length ? [html("table", {}, html("tbody", {}, ...rows))] : [html("p", { class: "soft" }, "Files appear when all is made.")];
  });
}
