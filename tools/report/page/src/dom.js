// Elements by name. Text only ever goes in as text, so that nothing in a report can become markup.

const make = (space) => function element(tag, attributes = {}, ...children) {
  const made = document.createElementNS(space, tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) made.setAttribute(name, "");
    else if (value !== undefined && value !== null && value !== false && value !== "") made.setAttribute(name, value);
  }
  made.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return made;
};

export const html = make("http://www.w3.org/1999/xhtml");
export const svg = make("http://www.w3.org/2000/svg");

/** Text in which the water's density "ρw" has its subscript. */
export function words(plain) {
  return String(plain).split(/(ρw)/).map((part) => (part === "ρw" ? html("span", {}, "ρ", html("sub", {}, "w")) : part));
}

/** A link that stays beside the page: what names a scheme or a host is shown as text. */
export function link(href, text) {
  const beside = !/^([a-z][a-z0-9+.-]*:|\/\/|\\)/i.test(href.trim());
  return beside ? html("a", { href }, text) : html("span", {}, text);
}
