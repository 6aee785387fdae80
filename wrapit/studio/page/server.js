// What the page asks of its server. The token came as a cookie with the page.

async function answer(response) {
  const told = await response.json().catch(() => null);
  if (response.ok) return { error: null, ...told };
  return { error: told?.error ?? { problem: `the studio answered ${response.status}`, where: "", remedy: "open its link again" } };
}

async function post(path, body) {
  try {
    return await answer(
      await fetch(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) }),
    );
  } catch {
    return { error: { problem: "the studio doesn't answer", where: "", remedy: "start it again: wrapit studio" } };
  }
}

export const change = (wanted) => post("/change", wanted);
export const saveText = (text, base) => post("/text", { text, base });
export const undo = () => post("/undo", {});
export const again = () => post("/again", {});
export const redo = () => post("/redo", {});
export const showWays = (count) => post("/alternatives", { count });
export const showFewerWires = () => post("/fewer-wires", {});

/** The whole state, or null where the studio has ended. */
export async function state() {
  try {
    const response = await fetch("/state");
    return response.ok ? await response.json() : null;
  } catch {
    return null;
  }
}

/**
 * Calls `changed` now and whenever something is new; `lost` while the studio doesn't answer. A tab that nobody
 * sees lets go of its line: browsers open six to one server, for all tabs together, and a seventh would wait.
 */
export function follow(changed, lost) {
  let events = null;
  const listen = () => {
    if (document.hidden === (events === null)) return;
    events?.close();
    events = document.hidden ? null : new EventSource("/events");
    if (events) Object.assign(events, { onmessage: changed, onopen: changed, onerror: lost });
  };
  document.addEventListener("visibilitychange", listen);
  window.addEventListener("pageshow", listen);
  listen();
}

/** Where a file of the last build is; its hash makes the browser fetch it anew when it changed. */
export const fileAddress = (name, digest) => `/file/${encodeURIComponent(name)}?v=${digest}`;
