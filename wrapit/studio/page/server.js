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
export const redo = () => post("/redo", {});
export const showWays = (count) => post("/alternatives", { count });

/** The whole state, or null where the studio has ended. */
export async function state() {
  try {
    const response = await fetch("/state");
    return response.ok ? await response.json() : null;
  } catch {
    return null;
  }
}

/** Calls `changed` now and whenever something is new; `lost` while the studio doesn't answer. */
export function follow(changed, lost) {
  const events = new EventSource("/events");
  events.onmessage = changed;
  events.onopen = changed;
  events.onerror = lost;
}

/** Where a file of the last build is; its hash makes the browser fetch it anew when it changed. */
export const fileAddress = (name, digest) => `/file/${encodeURIComponent(name)}?v=${digest}`;
