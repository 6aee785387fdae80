"use strict";
// Shows one card at a time. Without this script the page is the list of all of them.
const cards = [...document.querySelectorAll(".card")];
const steps = cards.filter((card) => card.classList.contains("step"));
const chapters = [...document.querySelectorAll(".chapter")];
const element = (id) => document.getElementById(id);
let current = 0;

function show(index, focus) {
  current = Math.max(0, Math.min(index, cards.length - 1));
  const card = cards[current];
  cards.forEach((each, place) => {
    if (place === current) each.setAttribute("aria-current", "step");
    else each.removeAttribute("aria-current");
  });
  chapters.forEach((each) => each.classList.toggle("now", each.contains(card)));
  const step = steps.indexOf(card) + 1;
  element("where").textContent = step ? STEP_OF.replace("#", step) : READY;
  element("progress").max = cards.length - 1;
  element("progress").value = current;
  element("back").disabled = current === 0;
  element("next").disabled = current === cards.length - 1;
  history.replaceState(null, "", "#" + card.id);
  if (!focus) return;
  card.focus({ preventScroll: true });
  if (document.documentElement.classList.contains("paged")) window.scrollTo(0, 0);
  else card.scrollIntoView({ block: "start" });
}

function follow() {
  const wanted = location.hash.slice(1);
  const target = wanted ? element(wanted) : null;
  const card = target && (target.closest(".card") || target.querySelector(".card"));
  return card ? cards.indexOf(card) : 0;
}

function mode(paged) {
  document.documentElement.classList.toggle("paged", paged);
  const button = element("mode");
  button.textContent = paged ? button.dataset.all : button.dataset.one;
}

element("back").addEventListener("click", () => show(current - 1, true));
element("next").addEventListener("click", () => show(current + 1, true));
element("mode").addEventListener("click", () => {
  mode(!document.documentElement.classList.contains("paged"));
  show(current, true);
});
window.addEventListener("hashchange", () => show(follow(), true));

document.addEventListener("keydown", (event) => {
  if (event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
  const to = { ArrowRight: current + 1, ArrowLeft: current - 1, Home: 0, End: cards.length - 1 }[event.key];
  if (to === undefined) return;
  event.preventDefault();
  show(to, true);
});

// A swipe is one finger that goes well sideways; up and down scrolls, two fingers zoom.
let from = null;
document.addEventListener("touchstart", (event) => {
  const one = event.touches.length === 1 && (window.visualViewport?.scale ?? 1) === 1;
  from = one ? event.touches[0] : null;
}, { passive: true });
document.addEventListener("touchend", (event) => {
  if (!from) return;
  const to = event.changedTouches[0];
  const [across, down] = [to.clientX - from.clientX, to.clientY - from.clientY];
  from = null;
  if (Math.abs(across) < 50 || Math.abs(across) < 2 * Math.abs(down)) return;
  show(current + (across < 0 ? 1 : -1), true);
}, { passive: true });

document.querySelectorAll(".pager").forEach((each) => { each.hidden = false; });
mode(true);
show(follow(), false);
