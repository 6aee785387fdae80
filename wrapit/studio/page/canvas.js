// The piece as it was read and divided: lines, junctions and findings that can be clicked.

import { html, pressable, svg } from "./elements.js";

const line = (points) => points.map(([x, y]) => `${x},${-y}`).join(" ");
const curve = (beziers) =>
  beziers
    .map(([a, b, c, d], index) => `${index ? "" : `M ${a[0]} ${-a[1]} `}C ${b[0]} ${-b[1]} ${c[0]} ${-c[1]} ${d[0]} ${-d[1]}`)
    .join(" ");

const least = (values) => values.reduce((a, b) => Math.min(a, b)); // however many there are
const most = (values) => values.reduce((a, b) => Math.max(a, b));

function bounds(...drawings) {
  const points = drawings.flatMap((drawing) => [...drawing.junctions, ...drawing.segments.flatMap((segment) => segment.beziers.flat())]);
  const xs = points.map((point) => point[0]);
  const ys = points.map((point) => -point[1]);
  const low = [least(xs), least(ys)];
  return { low, size: [most(xs) - low[0], most(ys) - low[1]] };
}

function middle(beziers) {
  const [a, b, c, d] = beziers[Math.floor(beziers.length / 2)];
  const t = beziers.length % 2 ? 0.5 : 0;
  const at = (i) => (1 - t) ** 3 * a[i] + 3 * t * (1 - t) ** 2 * b[i] + 3 * t * t * (1 - t) * c[i] + t ** 3 * d[i];
  return [at(0), at(1)];
}

/** Which segments end at each junction: `[segment, at its start?]`, a loop twice. */
export function incident(drawing) {
  const ends = drawing.junctions.map(() => []);
  drawing.segments.forEach((segment, index) => {
    ends[segment.start].push([index, true]);
    ends[segment.end].push([index, false]);
  });
  return ends;
}

function source(drawing, picture) {
  const frame = drawing.pixel_frame;
  if (!frame || !picture) return null;
  const { mm_per_px: scale, origin_mm: origin } = frame;
  return svg("image", {
    href: picture.src,
    x: origin[0] - scale / 2,
    y: -origin[1] - scale / 2,
    width: picture.naturalWidth * scale,
    height: picture.naturalHeight * scale,
    opacity: 0.35,
    preserveAspectRatio: "none",
  });
}

/** A place for a mark: where it belongs, or the nearest one around it that is free. */
function free([x, y], taken, room) {
  const around = [[x, y]];
  for (let ring = 1; ring < 6; ring += 1)
    for (let step = 0; step < 6 * ring; step += 1) {
      const turn = Math.PI / 2 + (2 * Math.PI * step) / (6 * ring);
      around.push([x + ring * room * Math.cos(turn), y + ring * room * Math.sin(turn)]);
    }
  const place = around.find(([a, b]) => taken.every(([c, d]) => Math.hypot(a - c, b - d) > 0.95 * room)) ?? [x, y];
  taken.push(place);
  return place;
}

function asRead(fit, alone, unit) {
  const out = new Set(fit.left_out);
  return fit.original.segments.map((each, index) =>
    svg("path", { class: `original${alone ? " alone" : ""}${out.has(index) ? " out" : ""}`, d: curve(each.beziers), "stroke-width": unit / 3, "stroke-dasharray": out.has(index) ? unit : null }),
  );
}

/** What can be clicked of the drawing that was read: what was left out, or all of it where it is shown alone. */
function readHits(fit, alone, selected, unit, pick) {
  const shown = alone ? fit.original.segments.map((_, index) => index) : fit.left_out;
  return shown.map((index) =>
    svg("path", {
      class: `hit${selected.original === index ? " selected" : ""}`,
      d: curve(fit.original.segments[index].beziers),
      "stroke-width": (alone ? 2.4 : 1.2) * unit, // narrow, for it may lie beside a line that stayed
      "data-original": index,
      "aria-pressed": String(selected.original === index),
      ...pressable(alone ? `line ${index} as it was read` : `line ${index} as it was read, left out`, () => pick.original(index)),
    }),
  );
}

const numbered = (each, index, unit) => {
  const [x, y] = middle(each.beziers);
  return svg("text", { class: "number", x, y: -y, "font-size": 2 * unit, "stroke-width": unit / 2 }, String(index));
};

function readNumbers(fit, alone, selected, layers, unit) {
  const shown = (index) => (layers.numbers && alone) || selected.original === index;
  return fit.original.segments.flatMap((each, index) => (shown(index) ? [numbered(each, index, unit)] : []));
}

function lines({ drawing, wires, fit }, layers, unit) {
  const children = [];
  if (!wires.length || layers.read) {
    for (const each of drawing.segments)
      if (each.kind !== "bridge") children.push(svg("path", { class: "drawn", d: curve(each.beziers), "stroke-width": unit / 4 }));
  }
  if (layers.wires)
    for (const wire of wires)
      children.push(
        svg("polyline", { class: "wire", points: line(wire.points), stroke: wire.colour, "stroke-width": wire.diameter_mm }),
      );
  for (const { at, diameter_mm: diameter } of fit?.beads ?? [])
    children.push(svg("circle", { class: "bead", cx: at[0], cy: -at[1], r: diameter / 2, "stroke-width": unit / 4 }));
  return children;
}

function hits(drawing, selected, unit, pick) {
  return drawing.segments.map((each, index) =>
    svg("path", {
      class: ["hit", selected.segments.includes(index) && "selected", `segment-${index}`].filter(Boolean).join(" "),
      d: curve(each.beziers),
      "stroke-width": 2.4 * unit,
      "data-segment": index,
      "aria-pressed": String(selected.segments.includes(index)),
      ...pressable(`line ${index}`, () => pick.segment(index)),
    }),
  );
}

function places(drawing, ends, selected, unit, pick) {
  return drawing.junctions.map(([x, y], index) => {
    const classes = ["place", ends[index].length === 1 && "end", selected.junction === index && "selected"];
    return svg(
      "g",
      {
        class: classes.filter(Boolean).join(" "),
        "stroke-width": unit / 4,
        "data-junction": index,
        "aria-pressed": String(selected.junction === index),
        ...pressable(ends[index].length === 1 ? `end ${index}` : `junction ${index}`, () => pick.junction(index)),
      },
      svg("circle", { class: "reach", cx: x, cy: -y, r: 2.2 * unit }), // as fingers need
      svg("circle", { cx: x, cy: -y, r: 0.8 * unit }),
    );
  });
}

function numbers(drawing, ends, selected, layers, unit) {
  const asked = new Set([...selected.segments, ...(ends[selected.junction] ?? []).map(([segment]) => segment)]);
  return drawing.segments.flatMap((each, index) => (layers.numbers || asked.has(index) ? [numbered(each, index, unit)] : []));
}

function marks(findings, selected, layers, unit, pick) {
  const taken = [];
  return findings.flatMap((finding, index) => {
    if (!finding.at || (finding.level === "note" && !layers.notes && index !== selected.finding)) return [];
    const [x, y] = free(finding.at, taken, 2.4 * unit);
    return [
      svg("path", {
        class: `mark ${finding.level}`,
        d: `M ${x} ${-y} l ${1.1 * unit} ${-2.2 * unit} h ${-2.2 * unit} z`,
        "stroke-width": unit / 5,
        "data-finding": index,
        ...pressable(`finding ${index + 1}: ${finding.message}`, () => pick.finding(index)),
      }),
      svg("text", { class: "number white", x, y: -y - 1.55 * unit, "font-size": 1.2 * unit, "aria-hidden": "true" }, String(index + 1)),
    ];
  });
}

function changed(fit, selected, unit) {
  const change = fit?.changes[selected.change];
  return change ? svg("circle", { class: "change", cx: change.at[0], cy: -change.at[1], r: 2.6 * unit, "stroke-width": unit / 2 }) : null;
}

/**
 * The picture of a state. `selected` is {segments: [..], original: n | null, junction: n | null, finding: n | null,
 * change: n | null}; `layers` says what else is seen, and which `side`: what was read (before), what is made of it
 * (after), or both; `pick` is told of clicks: pick.segment(n), .original(n), .junction(n), .finding(n).
 */
export function canvas(state, selected, layers, picture, pick) {
  const { drawing, fit } = state.shown;
  if (!drawing) return html("p", { class: "soft" }, "Nothing is read yet.");
  const { low, size } = bounds(drawing, ...(fit ? [fit.original] : []));
  const unit = Math.max(...size) / 60;
  const margin = 3 * unit;
  const box = [low[0] - margin, low[1] - margin, size[0] + 2 * margin, size[1] + 2 * margin];
  const ends = incident(drawing);
  const before = fit && layers.side !== "after";
  const alone = fit && layers.side === "before";
  const children = [
    source(drawing, layers.picture ? picture : null),
    ...(before ? asRead(fit, alone, unit) : []),
    ...(alone ? [] : [...lines(state.shown, layers, unit), ...hits(drawing, selected, unit, pick)]),
    ...(before ? readHits(fit, alone, selected, unit, pick) : []),
    ...(alone ? [] : [...places(drawing, ends, selected, unit, pick), ...numbers(drawing, ends, selected, layers, unit)]),
    ...(before ? readNumbers(fit, alone, selected, layers, unit) : []),
    ...(alone ? [] : marks(state.findings, selected, layers, unit, pick)),
    changed(fit, selected, unit),
  ];
  return svg("svg", { viewBox: box.join(" "), role: "group", "aria-describedby": "keys", "aria-label": `${state.name}: lines, junctions and findings` }, ...children);
}

/** Lights up segments while the pointer is on what speaks of them. */
export function hint(segments, on) {
  for (const index of segments) document.querySelector(`#canvas .segment-${index}`)?.classList.toggle("hinted", on);
}

/** One way to divide the drawing, small. */
export function thumbnail(drawing, drawn) {
  const { low, size } = bounds(drawing);
  const unit = Math.max(...size) / 60;
  const box = [low[0] - unit, low[1] - unit, size[0] + 2 * unit, size[1] + 2 * unit];
  const lines = drawn.map((wire) => svg("polyline", { class: "wire", points: line(wire.points), stroke: wire.colour, "stroke-width": 1.2 * unit }));
  return svg("svg", { viewBox: box.join(" "), "aria-hidden": "true" }, ...lines);
}
