/** Bytes of text in which some are escaped by their numbers (RFC 3986, 2.1); they need not be UTF-8. */
export function fromPercents(text: string): Uint8Array<ArrayBuffer> {
  const plain = new TextEncoder().encode(text);
  const bytes = new Uint8Array(plain.length);
  let length = 0;
  for (let i = 0; i < plain.length; i++) {
    const escaped =
      plain[i] === 0x25 ? /^[0-9a-f]{2}$/i.exec(String.fromCharCode(...plain.subarray(i + 1, i + 3))) : null;
    bytes[length++] = escaped ? Number.parseInt(escaped[0], 16) : (plain[i] as number);
    if (escaped) i += 2;
  }
  return bytes.slice(0, length);
}

/** Bytes of base64, which may be escaped. @throws {Error} for text that is none. */
export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.includes('%') ? decodeURIComponent(text) : text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
