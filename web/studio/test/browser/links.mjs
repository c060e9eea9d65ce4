// Links as the studio makes them, for tests.
import { deflateRawSync } from "node:zlib";

export function linkTo(value, as_text = false) {
  return `#take=${deflateRawSync(as_text ? value : JSON.stringify(value)).toString("base64url")}`;
}
