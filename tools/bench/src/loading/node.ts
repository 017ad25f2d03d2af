import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { loadGltf } from '@glanz/gltf';
import { decodeImage, packagedDecoders } from '@glanz/gltf/node';
import { BufferAttribute, BufferGeometry } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';
import { ASSETS, type Contestant, type Load } from './models';

/** What is used of the module of `draco3dgltf`. */
interface Draco {
  readonly [name: string]: unknown;
  readonly HEAPU8: Uint8Array;
  readonly DecoderBuffer: new () => { Init(bytes: Uint8Array, length: number): void };
  readonly Mesh: new () => { num_points(): number; num_faces(): number };
  readonly Decoder: new () => {
    DecodeBufferToMesh(buffer: object, mesh: object): { ok(): boolean };
    GetTrianglesUInt32Array(mesh: object, bytes: number, address: number): boolean;
    GetAttributeByUniqueId(mesh: object, id: number): { num_components(): number };
    GetAttributeDataArrayForAllPoints(
      mesh: object,
      attribute: object,
      type: unknown,
      bytes: number,
      address: number,
    ): boolean;
  };
  destroy(object: object): void;
  _malloc(bytes: number): number;
  _free(address: number): void;
}

/** three.js's DRACOLoader wants web workers; this does in place what its worker does. */
const dracoLoader = (open: () => Promise<Draco>) => ({
  preload: () => undefined,
  async decodeDracoFile(
    data: ArrayBuffer,
    done: (geometry: BufferGeometry) => void,
    ids: Readonly<Record<string, number>>,
    types: Readonly<Record<string, string>>,
  ) {
    const draco = await open();
    const decoder = new draco.Decoder(),
      mesh = new draco.Mesh(),
      buffer = new draco.DecoderBuffer();
    buffer.Init(new Uint8Array(data), data.byteLength);
    if (!decoder.DecodeBufferToMesh(buffer, mesh).ok()) throw new Error('Draco');
    const read = <T>(
      Type: { new (data: ArrayBuffer): T; readonly BYTES_PER_ELEMENT: number },
      count: number,
      fill: (bytes: number, address: number) => void,
    ): T => {
      const bytes = count * Type.BYTES_PER_ELEMENT,
        address = draco._malloc(bytes);
      fill(bytes, address);
      const array = new Type(draco.HEAPU8.slice(address, address + bytes).buffer as ArrayBuffer);
      draco._free(address);
      return array;
    };
    const geometry = new BufferGeometry();
    geometry.setIndex(
      new BufferAttribute(
        read(Uint32Array, 3 * mesh.num_faces(), (bytes, address) =>
          decoder.GetTrianglesUInt32Array(mesh, bytes, address),
        ),
        1,
      ),
    );
    for (const [name, id] of Object.entries(ids)) {
      const attribute = decoder.GetAttributeByUniqueId(mesh, id),
        size = attribute.num_components();
      const Type = (globalThis as unknown as Record<string, typeof Float32Array>)[types[name]!]!;
      const kind = draco[`DT_${types[name]!.replace('Array', '').toUpperCase()}`];
      geometry.setAttribute(
        name,
        new BufferAttribute(
          read(Type, mesh.num_points() * size, (bytes, address) =>
            decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, kind, bytes, address),
          ),
          size,
        ),
      );
    }
    for (const object of [mesh, decoder, buffer]) draco.destroy(object);
    done(geometry);
  },
});

/** Both loaders in this process, from the bytes of a file. Images are decoded by sharp for both. */
export function openNode(): { load(loader: Exclude<Contestant, 'worker'>, file: string): Promise<Load> } {
  const decoders = packagedDecoders();
  let draco: Promise<unknown> | undefined;
  // Kept between loads on both sides.
  const openDraco = () =>
    (draco ??= (
      createRequire(resolve('packages/gltf/package.json'))('draco3dgltf') as { createDecoderModule(): Promise<unknown> }
    ).createDecoderModule());
  const meshopt = (decoders.meshopt as () => Promise<unknown>)();
  // What three.js expects of a browser.
  Object.assign(globalThis, {
    self: globalThis,
    ProgressEvent: class extends Event {},
    createImageBitmap: async (blob: Blob) => ({
      ...(await decodeImage(new Uint8Array(await blob.arrayBuffer()), blob.type)),
      close: () => undefined,
    }),
  });
  return {
    async load(loader, file) {
      const bytes = new Uint8Array(readFileSync(join(ASSETS, file)));
      const begun = performance.now();
      let triangles = 0;
      if (loader === 'glanz') {
        const scene = await loadGltf(bytes, { decodeImage, decoders: { draco: openDraco, meshopt: () => meshopt } });
        for (const { mesh } of scene.instances) triangles += scene.meshes[mesh]!.indices.length / 3;
      } else {
        const { scene } = await new GLTFLoader()
          .setDRACOLoader(dracoLoader(openDraco as () => Promise<Draco>))
          .setMeshoptDecoder(MeshoptDecoder)
          .parseAsync(bytes.buffer, '');
        scene.traverse(({ isMesh, isInstancedMesh, count = 1, geometry }) => {
          if (isMesh)
            triangles += ((geometry.index ?? geometry.attributes.position).count / 3) * (isInstancedMesh ? count : 1);
        });
      }
      return { ms: performance.now() - begun, triangles };
    },
  };
}
