import { createScene, type Mesh, type Scene } from '@glanz/scene';
import { readCamera } from './cameras';
import { ThreeError } from './error';
import { meshOfPart, partsOf, type Part, type PartOptions } from './geometry';
import { readEnvironment } from './environment';
import { Ambience, readLight, type LightLink } from './lights';
import { flipsOf, Materials } from './materials';
import { batchesOf, placementsOf, type Placement } from './placements';
import { Textures, type ReadImage } from './textures';
import type { ThreeCamera, ThreeMaterial, ThreeMesh, ThreeObject } from './types';

/** Options for {@link fromThree}. */
export interface FromThreeOptions {
  readonly signal?: AbortSignal;
  /**
   * Gets the pixels of an image that only the host can read: of a texture that a loader in Node made, or of a
   * compressed one. `undefined` leaves it to the browser.
   */
  readonly readImage?: ReadImage;
}

/** A part of a mesh of three with one material, and what it has become. */
export interface PartLink {
  readonly object: ThreeMesh;
  readonly part: Part;
  readonly material: ThreeMaterial;
  readonly options: PartOptions;
  /** Index in `Scene.meshes`. */
  readonly mesh: number;
  /** Index of its first instance in `Scene.instances`; the others follow. */
  readonly first: number;
  readonly placements: readonly Placement[];
}

/** A converted scene, and what in it comes from where. */
export interface Conversion {
  readonly scene: Scene;
  readonly parts: readonly PartLink[];
  readonly lights: readonly LightLink[];
  readonly materials: Materials;
  readonly textures: Textures;
}

/** The parts of a mesh as it is now, with where each stands. */
export function readParts(mesh: ThreeMesh): Pick<PartLink, 'part' | 'material' | 'options' | 'placements'>[] {
  const several = Array.isArray(mesh.material);
  const list = (several ? mesh.material : [mesh.material]) as readonly ThreeMaterial[];
  const parts = mesh.isBatchedMesh
    ? batchesOf(mesh)
    : partsOf(mesh.geometry, several).map((part) => ({ part, placements: placementsOf(mesh) }));
  return parts.flatMap(({ part, placements }) => {
    const material = list[part.material];
    if (!material || material['visible'] === false || placements.length === 0) return [];
    const options = {
      flipV: flipsOf(material),
      colors: material['vertexColors'] === true,
      flat: material['flatShading'] === true,
    };
    return [{ part, material, options, placements }];
  });
}

/** Whether a mesh has a pose, which is its own; everything else is shared by those that show the same geometry. */
export const isPosed = (mesh: ThreeMesh): boolean =>
  mesh.isSkinnedMesh === true || (mesh.morphTargetInfluences?.some((influence) => influence !== 0) ?? false);

/** The mesh that a part becomes, as it is posed now. */
export const meshOf = (mesh: ThreeMesh, part: Part, options: PartOptions): Mesh | undefined =>
  meshOfPart(mesh.name || mesh.geometry.name || 'mesh', mesh, part, options);

/** See {@link fromThree}. */
export async function convert(
  root: ThreeObject,
  camera: ThreeCamera | undefined,
  options: FromThreeOptions,
): Promise<Conversion> {
  if (!root?.isObject3D)
    throw new ThreeError('three/not-three', 'A THREE.Scene or another THREE.Object3D is needed to be path-traced.');
  options.signal?.throwIfAborted();
  root.updateMatrixWorld();
  const scene = createScene(root.name || undefined);
  const textures = new Textures(scene, options.readImage);
  const materials = new Materials(scene, textures);
  const meshes = new Map<string, number | undefined>();
  const ambience = new Ambience();
  const warned = new Set<string>();
  const tasks: Promise<void>[] = [];
  const links: PartLink[] = [];
  const lights: LightLink[] = [];

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
    } else {
      const light = readLight(object, scene, ambience);
      if (light) lights.push(light);
    }
    object.children.forEach(visit);
  };

  const readMesh = (mesh: ThreeMesh): void => {
    for (const { part, material, options: how, placements } of readParts(mesh)) {
      const key = [
        mesh.geometry.uuid,
        part.start,
        part.count,
        Object.values(how),
        isPosed(mesh) ? (mesh as unknown as { uuid: string }).uuid : '',
      ].join(' ');
      if (!meshes.has(key)) {
        const made = meshOf(mesh, part, how);
        meshes.set(key, made && scene.meshes.push(made) - 1);
      }
      const index = meshes.get(key);
      if (index === undefined) continue;
      const hasTangents = scene.meshes[index]?.tangents !== undefined;
      links.push({
        object: mesh,
        part,
        material,
        options: how,
        mesh: index,
        first: scene.instances.length,
        placements,
      });
      for (const { transform, tint } of placements) {
        const instance = { name: mesh.name || 'mesh', mesh: index, material: 0, transform };
        scene.instances.push(instance);
        tasks.push(
          materials.get(material, how.flipV, hasTangents, tint).then((place) => void (instance.material = place)),
        );
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
  return { scene, parts: links, lights, materials, textures };
}
