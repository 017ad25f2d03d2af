import { createScene, type Scene } from '@glanz/scene';
import { multiply } from 'gl-matrix/esm/mat4.js';
import { readCamera } from './cameras';
import { ThreeError } from './error';
import { meshOfPart, partsOf, type Part } from './geometry';
import { readEnvironment } from './environment';
import { Ambience, readLight } from './lights';
import { flipsOf, Materials } from './materials';
import { numbersFrom } from './matrix';
import { Textures, type ReadImage } from './textures';
import type { Color, Matrix, ThreeCamera, ThreeMaterial, ThreeMesh, ThreeObject } from './types';

/** Options for {@link fromThree}. */
export interface FromThreeOptions {
  readonly signal?: AbortSignal;
  /**
   * Gives the pixels of an image that only the host can read: of a texture that a loader in Node made, or of a
   * compressed one. `undefined` leaves it to the browser.
   */
  readonly readImage?: ReadImage;
}

/** A placement of one part of a mesh. */
interface Placement {
  readonly transform: Float64Array<ArrayBuffer>;
  readonly tint?: Color;
}

/**
 * Converts a scene of three.js, as it is posed now: meshes (also instanced, batched, skinned, morphed), standard,
 * physical and basic materials with their textures, lights, the environment, and a camera. What is not supported is
 * listed in `scene.warnings`. Nothing of three.js is imported: any version since 0.160 will do. The result shares no memory
 * with it.
 *
 * @param root A `THREE.Scene`, or any object; its world matrices are brought up to date.
 * @param camera Becomes the scene's first camera.
 * @throws {ThreeError} `three/not-three`, `three/no-triangles`.
 * @throws the signal's reason, when aborted.
 * @example
 * await viewer.load(await fromThree(scene, camera));
 */
export async function fromThree(
  root: ThreeObject,
  camera?: ThreeCamera,
  options: FromThreeOptions = {},
): Promise<Scene> {
  if (!root?.isObject3D)
    throw new ThreeError('three/not-three', 'fromThree() takes a THREE.Scene or another THREE.Object3D.');
  options.signal?.throwIfAborted();
  root.updateMatrixWorld();
  const scene = createScene(root.name || undefined);
  const textures = new Textures(scene, options.readImage);
  const materials = new Materials(scene, textures);
  const meshes = new Map<string, number | undefined>();
  const ambience = new Ambience();
  const warned = new Set<string>();
  const tasks: Promise<void>[] = [];

  const visit = (object: ThreeObject): void => {
    if (!object.visible) return;
    const loose = object as unknown as Record<string, unknown>;
    if (loose['isMesh'] === true) readMesh(object as ThreeMesh);
    else if (
      (loose['isLine'] === true || loose['isPoints'] === true || loose['isSprite'] === true) &&
      !warned.has(String(loose['type']))
    ) {
      warned.add(String(loose['type']));
      scene.warnings.push({
        code: 'three/object',
        message: `${String(loose['type'])} objects ("${object.name}") have no surface and are left out.`,
      });
    } else readLight(object, scene, ambience);
    object.children.forEach(visit);
  };

  const readMesh = (mesh: ThreeMesh): void => {
    const several = Array.isArray(mesh.material);
    const list = (several ? mesh.material : [mesh.material]) as readonly ThreeMaterial[];
    const parts = mesh.isBatchedMesh
      ? batchesOf(mesh)
      : partsOf(mesh.geometry, several).map((part) => ({ part, placements: placementsOf(mesh) }));
    for (const { part, placements } of parts) {
      const material = list[part.material];
      if (!material || material['visible'] === false || placements.length === 0) continue;
      const flipV = flipsOf(material);
      const options = { flipV, colors: material['vertexColors'] === true, flat: material['flatShading'] === true };
      // Poses are a mesh's own; everything else is shared by those that show the same geometry.
      const posed = mesh.isSkinnedMesh || (mesh.morphTargetInfluences?.some((influence) => influence !== 0) ?? false);
      const key = [
        mesh.geometry.uuid,
        part.start,
        part.count,
        Object.values(options),
        posed ? (mesh as unknown as { uuid: string }).uuid : '',
      ].join(' ');
      if (!meshes.has(key)) {
        const made = meshOfPart(mesh.name || mesh.geometry.name || 'mesh', mesh, part, options);
        meshes.set(key, made && scene.meshes.push(made) - 1);
      }
      const index = meshes.get(key);
      if (index === undefined) continue;
      const hasTangents = scene.meshes[index]?.tangents !== undefined;
      for (const { transform, tint } of placements) {
        const instance = { name: mesh.name || 'mesh', mesh: index, material: 0, transform };
        scene.instances.push(instance);
        tasks.push(materials.get(material, flipV, hasTangents, tint).then((place) => void (instance.material = place)));
      }
    }
  };

  visit(root);
  await Promise.all(tasks);
  options.signal?.throwIfAborted();
  if (scene.instances.length === 0)
    throw new ThreeError(
      'three/no-triangles',
      'The scene of three.js has no visible triangles: there is nothing to show.',
    );
  const environment = await readEnvironment(root, ambience, scene, textures);
  if (environment) scene.environment = environment;
  if (camera) {
    camera.updateMatrixWorld();
    const made = readCamera(camera, scene);
    if (made) scene.cameras.push(made);
  }
  return scene;
}

/** Where a mesh stands: once, or as often as it has instances. */
function placementsOf(mesh: ThreeMesh): Placement[] {
  const world = numbersFrom(mesh.matrixWorld);
  if (!mesh.isInstancedMesh) return [{ transform: world }];
  const { count, instanceMatrix, instanceColor } = mesh as unknown as {
    readonly count: number;
    readonly instanceMatrix: { readonly array: ArrayLike<number> };
    readonly instanceColor: { readonly array: ArrayLike<number> } | null;
  };
  return Array.from({ length: count }, (_, i) => {
    const own = Array.from({ length: 16 }, (__, k) => instanceMatrix.array[16 * i + k] as number);
    const c = instanceColor?.array;
    return {
      transform: multiply(new Float64Array(16), world, own),
      ...(c ? { tint: { r: c[3 * i] as number, g: c[3 * i + 1] as number, b: c[3 * i + 2] as number } } : {}),
    };
  });
}

/** What three takes for one of its colours, to be filled by it. */
class Target implements Color {
  r = 1;
  g = 1;
  b = 1;

  setRGB(r: number, g: number, b: number): this {
    [this.r, this.g, this.b] = [r, g, b];
    return this;
  }

  fromArray(array: ArrayLike<number>, offset = 0): this {
    return this.setRGB(array[offset] as number, array[offset + 1] as number, array[offset + 2] as number);
  }
}

interface Batched {
  readonly maxInstanceCount: number;
  getVisibleAt(id: number): boolean;
  getGeometryIdAt(id: number): number;
  getGeometryRangeAt(id: number): { readonly start: number; readonly count: number } | null;
  getMatrixAt(id: number, target: Matrix): Matrix;
  /** Since version 0.166. */
  getColorAt?(id: number, target: Target): unknown;
}

/** The geometries of a BatchedMesh with the places of each. */
function batchesOf(mesh: ThreeMesh): { readonly part: Part; readonly placements: Placement[] }[] {
  const batched = mesh as unknown as Batched;
  const world = numbersFrom(mesh.matrixWorld);
  // An object of three's own to be filled.
  const matrix = (mesh.matrixWorld as unknown as { clone(): Matrix }).clone();
  const byGeometry = new Map<number, Placement[]>();
  for (let id = 0; id < batched.maxInstanceCount; id++) {
    try {
      if (!batched.getVisibleAt(id)) continue;
    } catch {
      // A number that was never given, or was given back.
      continue;
    }
    const geometry = batched.getGeometryIdAt(id);
    const placements = byGeometry.get(geometry) ?? [];
    const tint = new Target();
    batched.getColorAt?.(id, tint);
    placements.push({
      transform: multiply(new Float64Array(16), world, batched.getMatrixAt(id, matrix).elements),
      ...(tint.r === 1 && tint.g === 1 && tint.b === 1 ? {} : { tint }),
    });
    byGeometry.set(geometry, placements);
  }
  return [...byGeometry].flatMap(([geometry, placements]) => {
    const range = batched.getGeometryRangeAt(geometry);
    return range
      ? [{ part: { start: range.start, count: range.count - (range.count % 3), material: 0 }, placements }]
      : [];
  });
}
