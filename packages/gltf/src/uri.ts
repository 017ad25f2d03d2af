/**
 * The parts of a data: uri (RFC 2397): its type in lower case, whether its data are base64, and the encoded data;
 * undefined for other uris.
 */
export function dataUri(
  uri: string,
): { readonly type: string; readonly base64: boolean; readonly data: string } | undefined {
  // Match the head only: the data may have many megabytes.
  const comma = uri.slice(0, 1024).indexOf(',');
  const found =
    comma < 0
      ? null
      : /^data:([a-z0-9!#$&^_.+-]+\/[a-z0-9!#$&^_.+-]+)?((?:;[a-z0-9-]+=[^;,]*)*)(;base64)?$/i.exec(
          uri.slice(0, comma),
        );
  return found
    ? { type: (found[1] ?? '').toLowerCase(), base64: found[3] !== undefined, data: uri.slice(comma + 1) }
    : undefined;
}
