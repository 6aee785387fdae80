// Elements of the page, made of data; text is set as text, so that no name becomes markup.

const SVG = "http://www.w3.org/2000/svg";

function made(element, properties, children) {
  for (const [key, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "value" || key === "checked") element[key] = value;
    else element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

/** An HTML element: properties beginning with `on` are listeners, null ones are left out. */
export function html(tag, properties = {}, ...children) {
  return made(document.createElement(tag), properties, children);
}

/** An SVG element, alike. */
export function svg(tag, properties = {}, ...children) {
  return made(document.createElementNS(SVG, tag), properties, children);
}

/** Text in which what stands between backticks is code. */
export function prose(text) {
  return text.split("`").map((part, index) => (index % 2 ? html("code", {}, part) : part));
}

/** Lets what is clicked be pressed with Enter and the space bar too; keyboard.js says how the keyboard gets there. */
export function pressable(label, action) {
  return {
    tabindex: -1,
    role: "button",
    "aria-label": label,
    onclick: action,
    onkeydown: (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      action(event);
    },
  };
}
