// A link that holds a whole take: JSON, deflated, in the letters that an address may have. Nothing leaves the machine.
import { deflateSync, Inflate, strFromU8, strToU8 } from "fflate";
import { InputError, limits } from "./limits.js";
import type { Take } from "./take.js";

const kKey = "take";

export function packTake(take: Take): string {
  const bytes = deflateSync(strToU8(JSON.stringify({ take: 1, scene: take.scene, inputs: take.inputs })), { level: 9 });
  let letters = "";
  for (let i = 0; i < bytes.length; i += 4096) letters += String.fromCharCode(...bytes.subarray(i, i + 4096));
  return btoa(letters).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** The text of the take. It stops where too much comes out: small links can hold very large texts. */
export function unpackTake(packed: string): string {
  if (packed.length > limits.link) {
    throw new InputError(`the link has ${packed.length} characters; the studio takes ${limits.link}`);
  }
  if (!/^[\w-]+$/.test(packed))
    throw new InputError("the link is damaged: it has letters that no link of this page has");
  let bytes: Uint8Array;
  try {
    bytes = Uint8Array.from(atob(packed.replace(/-/g, "+").replace(/_/g, "/")), (letter) => letter.charCodeAt(0));
  } catch {
    throw new InputError("the link is damaged: it is not whole");
  }
  const parts: Uint8Array[] = [];
  let size = 0;
  let ended = false;
  const inflate = new Inflate((part, final) => {
    size += part.length;
    ended ||= final;
    if (size > limits.text) throw new InputError(`what the link holds is larger than ${limits.text} characters`);
    parts.push(part.slice());
  });
  try {
    for (let i = 0; i < bytes.length; i += 1024) inflate.push(bytes.subarray(i, i + 1024), i + 1024 >= bytes.length);
  } catch (error) {
    if (error instanceof InputError) throw error;
    throw new InputError("the link is damaged: it does not unpack");
  }
  if (!ended) throw new InputError("the link is damaged: its end is missing");
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return strFromU8(whole);
}

/** The address of this page with the take in it. */
export function linkTo(take: Take, page: string): string {
  const url = new URL(page);
  url.hash = `${kKey}=${packTake(take)}`;
  return url.href;
}
/** The packed take of an address, or null. */
export function packedIn(hash: string): string | null {
  const found = /^#take=(.*)$/s.exec(hash);
  return found?.[1] ?? null;
}
