import type { DracoAttribute } from './draco';
import type { GltfJson, GltfPrimitive } from './json';
import { dracoAttributes, type PrimitiveReader } from './primitive';
import type { DracoWorkers } from './draco-workers';

/** Min compressed bytes for which workers pay off. */
const MIN_BYTES = 20_000;

/** The meshes that the nodes of a scene use; those of all nodes if no scene is shown. */
function meshesShown({ scenes, nodes = [] }: GltfJson, shown: number | undefined): Set<number> {
  const meshes = new Set<number>(),
    seen = new Set<number>();
  const pending = [...(shown === undefined ? nodes.keys() : (scenes?.[shown]?.nodes ?? []))];
  for (let index = pending.pop(); index !== undefined; index = pending.pop()) {
    if (seen.has(index)) continue;
    seen.add(index);
    const { mesh, children = [] } = nodes[index] ?? {};
    if (mesh !== undefined) meshes.add(mesh);
    pending.push(...children);
  }
  return meshes;
}

/**
 * Decodes the compressed primitives of a scene in workers, several concurrently, before they are read. Those that fail
 * are left to the reader.
 *
 * @throws {GltfError} `gltf/too-large`
 */
export async function unpackAhead(
  json: GltfJson,
  shown: number | undefined,
  reader: PrimitiveReader,
  workers: DracoWorkers,
): Promise<void> {
  const found: {
    readonly primitive: GltfPrimitive;
    readonly path: string;
    readonly bytes: Uint8Array;
    readonly attributes: readonly DracoAttribute[];
  }[] = [];
  let packedBytes = 0;
  for (const mesh of meshesShown(json, shown)) {
    json.meshes?.[mesh]?.primitives.forEach((primitive, at) => {
      const packed = primitive.extensions?.KHR_draco_mesh_compression;
      if (!packed) return;
      try {
        const bytes = reader.viewBytes(packed.bufferView);
        found.push({
          primitive,
          path: `/meshes/${mesh}/primitives/${at}/extensions/KHR_draco_mesh_compression`,
          bytes,
          attributes: dracoAttributes(primitive, reader),
        });
        packedBytes += bytes.length;
      } catch {
        // The reader reports it.
      }
    });
  }
  if (found.length < 2 || packedBytes < MIN_BYTES) return;
  // Largest first, so that all workers finish at about the same time.
  found.sort((a, b) => b.bytes.length - a.bytes.length);
  await Promise.all(
    found.map(async ({ primitive, path, bytes, attributes }) => {
      const unpacked = await workers.unpack(bytes, attributes, reader.budget.left);
      if (!unpacked) return;
      reader.budget.take(
        unpacked.indices.byteLength +
          [...unpacked.attributes.values()].reduce((sum, { numbers }) => sum + numbers.byteLength, 0),
        path,
      );
      reader.ahead.set(primitive, unpacked);
    }),
  );
}
