// The piece as it was read and divided: lines, junctions and findings that can be clicked.

import { html, pressable, svg } from "./elements.js";

const line = (points) => points.map(([x, y]) => `${x},${-y}`).join(" ");
const curve = (beziers) =>
  beziers
    .map(([a, b, c, d], index) => `${index ? "" : `M ${a[0]} ${-a[1]} `}C ${b[0]} ${-b[1]} ${c[0]} ${-c[1]} ${d[0]} ${-d[1]}`)
    .join(" ");

function bounds(drawing) {
  const points = [...drawing.junctions, ...drawing.segments.flatMap((segment) => segment.beziers.flat())];
  const xs = points.map((point) => point[0]);
  const ys = points.map((point) => -point[1]);
  const low = [Math.min(...xs), Math.min(...ys)];
  return { low, size: [Math.max(...xs) - low[0], Math.max(...ys) - low[1]] };
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

/**
 * The picture of a state. `selected` is {segments: [..], junction: n | null, finding: n | null}; `layers` says
 * what else is seen; `pick` is told of clicks: pick.segment(n), pick.junction(n), pick.finding(n).
 */
export function canvas(state, selected, layers, picture, pick) {
  const { drawing, wires } = state.shown;
  if (!drawing) return html("p", { class: "soft" }, "Nothing is read yet.");
  const { low, size } = bounds(drawing);
  const unit = Math.max(...size) / 60;
  const margin = 3 * unit;
  const box = [low[0] - margin, low[1] - margin, size[0] + 2 * margin, size[1] + 2 * margin];
  const ends = incident(drawing);
  const children = [source(drawing, layers.picture ? picture : null)];
  if (!wires.length || layers.read) {
    for (const each of drawing.segments)
      if (each.kind !== "bridge") children.push(svg("path", { class: "drawn", d: curve(each.beziers), "stroke-width": unit / 4 }));
  }
  if (layers.wires)
    for (const wire of wires)
      children.push(
        svg("polyline", { class: "wire", points: line(wire.points), stroke: wire.colour, "stroke-width": wire.diameter_mm }),
      );
  drawing.segments.forEach((each, index) => {
    const classes = ["hit", selected.segments.includes(index) && "selected", `segment-${index}`];
    children.push(
      svg("path", {
        class: classes.filter(Boolean).join(" "),
        d: curve(each.beziers),
        "stroke-width": 2.4 * unit,
        "data-segment": index,
        "aria-pressed": String(selected.segments.includes(index)),
        ...pressable(`line ${index}`, () => pick.segment(index)),
      }),
    );
  });
  drawing.junctions.forEach(([x, y], index) => {
    const classes = ["place", ends[index].length === 1 && "end", selected.junction === index && "selected"];
    children.push(
      svg(
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
      ),
    );
  });
  const asked = new Set([...selected.segments, ...(ends[selected.junction] ?? []).map(([segment]) => segment)]);
  if (layers.numbers || asked.size)
    drawing.segments.forEach((each, index) => {
      if (!layers.numbers && !asked.has(index)) return;
      const [x, y] = middle(each.beziers);
      children.push(svg("text", { class: "number", x, y: -y, "font-size": 2 * unit, "stroke-width": unit / 2 }, String(index)));
    });
  const taken = [];
  state.findings.forEach((finding, index) => {
    if (!finding.at || (finding.level === "note" && !layers.notes && index !== selected.finding)) return;
    const [x, y] = free(finding.at, taken, 2.4 * unit);
    children.push(
      svg("path", {
        class: `mark ${finding.level}`,
        d: `M ${x} ${-y} l ${1.1 * unit} ${-2.2 * unit} h ${-2.2 * unit} z`,
        "stroke-width": unit / 5,
        "data-finding": index,
        ...pressable(`finding ${index + 1}: ${finding.message}`, () => pick.finding(index)),
      }),
      svg("text", { class: "number white", x, y: -y - 1.55 * unit, "font-size": 1.2 * unit, "aria-hidden": "true" }, String(index + 1)),
    );
  });
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
