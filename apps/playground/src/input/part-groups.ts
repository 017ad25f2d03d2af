/** Parts that lie under one node of a glTF document: a range of the scene's instances, which follow the node tree. */
export interface PartGroup {
  /** Name of the node; of nodes with the same parts, all names from the outermost on, with slashes between them. */
  readonly name: string;
  /** Index of its first instance. */
  readonly from: number;
  /** Index after that of its last instance. */
  readonly to: number;
}

/** What is read of a document, as it was before any check. */
interface Document {
  readonly nodes?: readonly {
    readonly name?: unknown;
    readonly mesh?: unknown;
    readonly children?: readonly unknown[];
  }[];
  readonly meshes?: readonly { readonly name?: unknown }[];
}

/** Deeper nodes are no groups of their own: their parts belong to the group above. */
const MAX_DEPTH = 16;
/** So many names does a group of nodes with the same parts have at most: the innermost ones. */
const MAX_NAMES = 4;

const MAGIC = 0x46546c67;

/** The JSON of a .gltf or .glb, of which nothing but its JSON is read. */
export async function readDocument(file: Blob): Promise<unknown> {
  const header = new DataView(await file.slice(0, 20).arrayBuffer());
  const text =
    header.byteLength === 20 && header.getUint32(0, true) === MAGIC
      ? file.slice(20, 20 + header.getUint32(12, true))
      : file;
  return JSON.parse(await text.text());
}

/**
 * The groups of a scene's instances, each before those in it: nodes with more than one part.
 *
 * @param json The document, as it is in the file.
 * @param nodes Of each instance, the index of its node.
 */
export function groupsOf(json: unknown, nodes: readonly number[]): PartGroup[] {
  const { nodes: all = [], meshes = [] } = json as Document;
  const parents = new Int32Array(all.length).fill(-1);
  all.forEach(({ children = [] }, index) => {
    for (const child of children) if (typeof child === 'number' && parents[child] === -1) parents[child] = index;
  });
  const text = (name: unknown) => (typeof name === 'string' ? name.trim() : '');
  const nameOf = (index: number) =>
    text(all[index]?.name) || text(meshes[all[index]?.mesh as number]?.name) || `Node ${index}`;

  const found: { readonly node: number; readonly from: number; to: number }[] = [];
  // Nodes on the way from a root to the part at hand, and where they are on it.
  const path: typeof found = [];
  const places = new Int32Array(all.length).fill(-1);
  const shorten = (length: number, to: number) => {
    for (const group of path.splice(length)) {
      places[group.node] = -1;
      group.to = to;
    }
  };
  nodes.forEach((node, part) => {
    const below: number[] = [];
    let at = node;
    while (at >= 0 && (places[at] ?? 0) < 0 && below.length < all.length) {
      below.push(at);
      at = parents[at] as number;
    }
    shorten(at < 0 ? 0 : (places[at] ?? -1) + 1, part);
    for (const next of below.reverse()) {
      places[next] = path.length;
      const group = { node: next, from: part, to: part };
      found.push(group);
      path.push(group);
    }
  });
  shorten(0, nodes.length);

  const groups: { names: string[]; readonly from: number; readonly to: number }[] = [];
  // Ends of the groups around the one at hand.
  const around: number[] = [];
  for (const { node, from, to } of found) {
    if (to - from < 2) continue;
    const last = groups.at(-1);
    if (last?.from === from && last.to === to) {
      if (last.names.at(-1) !== nameOf(node)) last.names.push(nameOf(node));
      continue;
    }
    while (around.length > 0 && (around.at(-1) as number) <= from) around.pop();
    if (around.length >= MAX_DEPTH) continue;
    around.push(to);
    groups.push({ names: [nameOf(node)], from, to });
  }
  return groups.map(({ names, from, to }) => ({ name: names.slice(-MAX_NAMES).join(' / '), from, to }));
}
