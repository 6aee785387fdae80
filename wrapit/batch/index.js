const list = document.querySelector(".pieces");
const cards = [...list.children];
const find = document.querySelector("#find");
const order = document.querySelector("#order");
const told = document.querySelector("#told");

function choose() {
  const wanted = find.value.trim().toLowerCase();
  let shown = 0;
  for (const card of cards) {
    card.hidden = !card.textContent.toLowerCase().includes(wanted);
    shown += card.hidden ? 0 : 1;
  }
  told.textContent = wanted ? `${shown} of ${cards.length} pieces` : "";
}

function sort() {
  const key = order.value;
  const value = (card) => (card.dataset[key] === "" ? Infinity : Number(card.dataset[key]));
  const sorted = [...cards].sort((a, b) => {
    const [first, second] = [value(a), value(b)];
    return first === second ? Number(a.dataset.given) - Number(b.dataset.given) : first - second;
  });
  list.append(...sorted);
}

find.addEventListener("input", choose);
order.addEventListener("change", sort);
document.querySelector(".choose").hidden = false;
