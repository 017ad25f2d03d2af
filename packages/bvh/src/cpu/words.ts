const views = /* @__PURE__ */ new WeakMap<Float32Array, Uint32Array>();

/** The words of nodes, seen as integers; the same view every time, so that queries allocate nothing. */
export function wordsOf(nodes: Float32Array): Uint32Array {
  let words = views.get(nodes);
  if (!words) views.set(nodes, (words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length)));
  return words;
}
