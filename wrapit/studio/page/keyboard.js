// The keyboard in the picture: one stop for Tab, however many lines there are; arrows go on from there.

const KINDS = ["segment", "original", "junction", "finding"];
const STEPS = { ArrowRight: 1, ArrowLeft: -1 };
const TURNS = { ArrowDown: 1, ArrowUp: -1 };

const kindOf = (element) => KINDS.find((kind) => element?.dataset?.[kind] !== undefined) ?? null;
const all = (place, kind) => [...place.querySelectorAll(`[data-${kind}]`)];

/** A selector of a line, junction or finding, by which it is found again when the picture is drawn anew. */
export function named(element) {
  const kind = kindOf(element);
  return kind && `[data-${kind}="${element.dataset[kind]}"]`;
}

function distance(one, other) {
  const [a, b] = [one.getBBox(), other.getBBox()];
  return Math.hypot(a.x + a.width / 2 - b.x - b.width / 2, a.y + a.height / 2 - b.y - b.height / 2);
}

/** The nearest one of the next kind that the picture shows. */
function across(place, element, turn) {
  const kinds = KINDS.filter((kind) => all(place, kind).length);
  const next = kinds[(kinds.indexOf(kindOf(element)) + turn + kinds.length) % kinds.length];
  return all(place, next).reduce((best, each) => (distance(each, element) < distance(best, element) ? each : best));
}

function reached(place, element, key) {
  const alike = all(place, kindOf(element));
  if (key === "Home") return alike[0];
  if (key === "End") return alike.at(-1);
  if (key in STEPS) return alike[(alike.indexOf(element) + STEPS[key] + alike.length) % alike.length];
  return key in TURNS ? across(place, element, TURNS[key]) : null;
}

let stop = null;

function stopAt(place, element) {
  for (const each of place.querySelectorAll('[tabindex="0"]')) each.setAttribute("tabindex", "-1");
  element?.setAttribute("tabindex", "0");
}

/** Lets arrows move the focus within a place; once, for what is in it may come and go. */
export function arrows(place) {
  place.addEventListener("focusin", ({ target }) => {
    if (!named(target)) return;
    stop = named(target);
    stopAt(place, target);
  });
  place.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !kindOf(event.target)) return;
    const next = reached(place, event.target, event.key);
    if (!next) return;
    event.preventDefault();
    next.focus();
  });
}

/** Gives a picture that was drawn anew its stop, where the last one had it. */
export function renew(place) {
  stopAt(place, (stop && place.querySelector(stop)) ?? place.querySelector("[data-segment], [data-original]"));
}
