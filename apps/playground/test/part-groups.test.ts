import { Document, WebIO, type Node } from '@gltf-transform/core';
import { loadGltf } from '@glanz/gltf';
import { describe, expect, test } from 'vitest';
import { groupsOf, readDocument } from '../src/input/part-groups';

/** Names of nodes with their children; a number of materials makes it a node with a mesh of so many primitives. */
type Sketch = readonly [name: string, primitives: number, ...children: Sketch[]];

/** A file of glTF-Transform, an implementation of the format that is not ours. */
async function write(...roots: readonly Sketch[]) {
  const document = new Document();
  const buffer = document.createBuffer();
  const scene = document.createScene();
  document.getRoot().setDefaultScene(scene);
  const positions = document
    .createAccessor()
    .setType('VEC3')
    .setArray(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]))
    .setBuffer(buffer);
  const nodeOf = ([name, primitives, ...children]: Sketch): Node => {
    const node = document.createNode(name);
    if (primitives > 0) {
      const mesh = document.createMesh(`${name} mesh`);
      for (let i = 0; i < primitives; i++)
        mesh.addPrimitive(
          document
            .createPrimitive()
            .setAttribute('POSITION', positions)
            .setMaterial(document.createMaterial(`${name} ${i}`)),
        );
      node.setMesh(mesh);
    }
    for (const child of children) node.addChild(nodeOf(child));
    return node;
  };
  for (const root of roots) scene.addChild(nodeOf(root));
  return new Uint8Array(await new WebIO().writeBinary(document));
}

/** Groups as the worker finds them, with the names of their parts. */
async function read(bytes: Uint8Array<ArrayBuffer>) {
  const scene = await loadGltf(bytes, { partNodes: true });
  const groups = groupsOf(
    await readDocument(new Blob([bytes])),
    scene.animatedParts!.map(([node]) => node),
  );
  return groups.map(({ name, from, to }) => ({
    name,
    parts: scene.instances.slice(from, to).map((instance) => instance.name),
  }));
}

describe('groups of a file', () => {
  test('nodes with more than one part, each before those in it', async () => {
    const bytes = await write(
      ['Car', 1, ['Body', 2], ['Wheels', 0, ['Left', 1], ['Right', 1]], ['Flag', 0, ['Cloth', 1]]],
      ['Ground', 1],
    );
    expect(await read(bytes)).toEqual([
      { name: 'Car', parts: ['Car', 'Body', 'Body', 'Left', 'Right', 'Cloth'] },
      { name: 'Body', parts: ['Body', 'Body'] },
      { name: 'Wheels', parts: ['Left', 'Right'] },
    ]);
  });

  test('nodes with the same parts are one group', async () => {
    const bytes = await write(['Root', 0, ['Root', 0, ['', 0, ['Lamp', 0, ['Shade', 1], ['Foot', 1]]]]]);
    expect(await read(bytes)).toEqual([{ name: 'Root / Node 2 / Lamp', parts: ['Shade', 'Foot'] }]);
  });

  test('none where each node has one part', async () => {
    expect(await read(await write(['A', 1], ['B', 0, ['C', 1]]))).toEqual([]);
  });

  test('a .gltf with a byte order mark', async () => {
    expect(await readDocument(new Blob(['\ufeff{"nodes": [{}]}']))).toEqual({ nodes: [{}] });
  });

  test('what is wrong in a document does not stop it', () => {
    const loop = { nodes: [{ children: [1, 7, 'x'] }, { children: [0] }, { name: 5 }] };
    expect(groupsOf(loop, [1, 1, 9, 2, 2]).map(({ from, to }) => [from, to])).toEqual([
      [0, 2],
      [3, 5],
    ]);
    expect(groupsOf({}, [0, 0])).toEqual([]);
  });

  test('random trees: a group is what a search from its node finds', () => {
    const seed = (Math.random() * 2 ** 31) | 0;
    let state = seed;
    const random = (n: number) => ((state = (Math.imul(state, 1664525) + 1013904223) | 0) >>> 8) % n;
    for (let run = 0; run < 200; run++) {
      const nodes = Array.from({ length: 2 + random(40) }, (_, i) => ({ name: `n${i}`, children: [] as number[] }));
      const parents = nodes.map((_, i) => (i === 0 ? -1 : random(i)));
      parents.forEach((parent, i) => nodes[parent]?.children.push(i));
      const parts: number[] = [];
      const counts = nodes.map(() => random(3));
      const visit = (node: number): void => {
        for (let i = 0; i < counts[node]!; i++) parts.push(node);
        nodes[node]!.children.forEach(visit);
      };
      visit(0);
      const isBelow = (node: number, root: number): boolean =>
        node === root || (node >= 0 && isBelow(parents[node]!, root));
      const expected = new Set(
        nodes
          .map((_, root) => parts.flatMap((node, part) => (isBelow(node, root) ? [part] : [])).join())
          .filter((list) => list.includes(',')),
      );
      const groups = groupsOf({ nodes }, parts);
      const found = groups.map(({ from, to }) => Array.from({ length: to - from }, (_, i) => from + i).join());
      expect(new Set(found), `seed ${seed}, run ${run}`).toEqual(expected);
      expect(found.length).toBe(expected.size);
    }
  });

  test('a chain of nodes of any length: those that are too deep belong to the group above', () => {
    const length = 20_000;
    const nodes = Array.from({ length }, (_, i) => ({ name: `n${i}`, children: i + 1 < length ? [i + 1] : [] }));
    const groups = groupsOf(
      { nodes },
      nodes.map((_, i) => i),
    );
    expect(groups.length).toBe(16);
    expect(groups.at(-1)).toEqual({ name: 'n15', from: 15, to: length });
  });
});
