import type { Light, Material, Mesh, Scene } from '@glanz/scene';
import { isPosed, meshOf, readParts, type Conversion, type PartLink } from './convert';
import { materialState, partsState, poseState, textureState, verticesState } from './fingerprint';
import { Ambience, lightOf } from './lights';
import type { MaterialEntry } from './materials';
import type { Loose, ThreeMaterial, ThreeMesh, ThreeObject, ThreeTexture } from './types';

/** What of a scene of three has changed, as edits of the tracer's scene. */
export interface SceneEdits {
  /** Why the scene must be converted again; then all else is left out. */
  rebuild?: string;
  readonly hidden: number[];
  readonly shown: number[];
  readonly transforms: { readonly instance: number; readonly transform: ArrayLike<number> }[];
  readonly assigned: { readonly instance: number; readonly material: number }[];
  readonly meshes: { readonly index: number; readonly mesh: Mesh }[];
  readonly materials: MaterialEntry[];
  readonly lights: { readonly index: number; readonly light: Light }[];
  /** `adjust`: another intensity, rotation or visibility of the same image. */
  environment?: 'adjust' | 'read';
  readonly ambience: Ambience;
}

interface MeshState {
  readonly links: readonly PartLink[];
  readonly parts: string;
  vertices: string;
  pose: readonly number[];
  materials: readonly ThreeMaterial[];
  readonly posed: boolean;
  visible: boolean;
  /** Its world matrix, and the version of its instances' matrices. */
  world: ArrayLike<number>;
  instances: number;
  /** Of each link, the transforms of its instances. */
  transforms: (readonly ArrayLike<number>[])[];
}

const sameNumbers = (a: ArrayLike<number>, b: ArrayLike<number>): boolean => {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return true;
};

const materialsOf = (mesh: ThreeMesh): readonly ThreeMaterial[] => [mesh.material].flat() as ThreeMaterial[];

/**
 * Finds what has changed in a scene of three since it was converted, or since it was last looked at: by versions, and
 * by comparing numbers where three has no versions. Looks at each object, material and light once.
 */
export class SceneFollower {
  readonly #root: ThreeObject;
  readonly #conversion: Conversion;
  readonly #meshes = new Map<ThreeMesh, MeshState>();
  /** Parts and materials of meshes that became nothing, such as those without triangles. */
  readonly #empty = new Map<ThreeMesh, string>();
  readonly #materials = new Map<ThreeMaterial, string>();
  readonly #lights: { readonly object: ThreeObject; readonly index: number; state: string }[];
  #environment: { readonly image: string; readonly adjustment: string };

  constructor(root: ThreeObject, conversion: Conversion) {
    this.#root = root;
    this.#conversion = conversion;
    const byMesh = new Map<ThreeMesh, PartLink[]>();
    for (const link of conversion.parts) byMesh.set(link.object, [...(byMesh.get(link.object) ?? []), link]);
    const ambience = new Ambience();
    this.#visit(
      (mesh) => {
        const links = byMesh.get(mesh);
        if (!links) return void this.#empty.set(mesh, emptyState(mesh));
        this.#meshes.set(mesh, {
          links,
          parts: partsState(mesh),
          vertices: verticesState(mesh),
          pose: poseState(mesh),
          materials: materialsOf(mesh),
          posed: isPosed(mesh),
          visible: true,
          world: Array.from(mesh.matrixWorld.elements),
          instances: instancesVersion(mesh),
          transforms: links.map(({ placements }) => placements.map(({ transform }) => transform)),
        });
        for (const material of materialsOf(mesh)) this.#materials.set(material, materialState(material));
      },
      (light) => void lightOf(light, ambience),
    );
    this.#lights = conversion.lights.map(({ object, index }) => ({
      object,
      index,
      state: JSON.stringify(conversion.scene.lights[index]),
    }));
    this.#environment = environmentState(root, ambience);
  }

  get scene(): Scene {
    return this.#conversion.scene;
  }

  /** What has changed since the last call; it counts as known from then on. */
  detect(): SceneEdits {
    this.#root.updateMatrixWorld();
    const edits: SceneEdits = {
      hidden: [],
      shown: [],
      transforms: [],
      assigned: [],
      meshes: [],
      materials: [],
      lights: [],
      ambience: new Ambience(),
    };
    const seen = new Set<ThreeObject>();
    const lights = new Map<ThreeObject, Light | undefined>();
    const used = new Set<ThreeMaterial>();
    this.#visit(
      (mesh) => {
        seen.add(mesh);
        for (const material of materialsOf(mesh)) used.add(material);
      },
      (light) => lights.set(light, lightOf(light, edits.ambience)),
    );
    const changed = this.#changedMaterials(used, edits);
    const replaced = new Set<number>();
    for (const mesh of seen as Set<ThreeMesh>) {
      const state = this.#meshes.get(mesh);
      if (state) this.#compareMesh(mesh, state, changed, replaced, edits);
      else if (this.#empty.get(mesh) !== emptyState(mesh)) edits.rebuild ??= `${nameOf(mesh)} is new`;
    }
    for (const [mesh, state] of this.#meshes) {
      if (seen.has(mesh) || !state.visible) continue;
      state.visible = false;
      edits.hidden.push(...instancesOf(state));
    }
    this.#compareLights(lights, edits);
    const environment = environmentState(this.#root, edits.ambience);
    if (environment.image !== this.#environment.image) edits.environment = 'read';
    else if (environment.adjustment !== this.#environment.adjustment) edits.environment = 'adjust';
    this.#environment = environment;
    return edits;
  }

  #changedMaterials(used: ReadonlySet<ThreeMaterial>, edits: SceneEdits): Set<ThreeMaterial> {
    const changed = new Set<ThreeMaterial>();
    for (const material of used) {
      const state = materialState(material);
      const before = this.#materials.get(material);
      if (before === state) continue;
      this.#materials.set(material, state);
      if (before !== undefined) changed.add(material);
    }
    if (changed.size > 0)
      for (const entry of this.#conversion.materials.entries)
        if (changed.has(entry.material)) edits.materials.push(entry);
    return changed;
  }

  #compareMesh(
    mesh: ThreeMesh,
    state: MeshState,
    changed: ReadonlySet<ThreeMaterial>,
    replaced: Set<number>,
    edits: SceneEdits,
  ): void {
    const materials = materialsOf(mesh);
    const reshaped = `the parts of ${nameOf(mesh)} changed`;
    if (
      partsState(mesh) !== state.parts ||
      isPosed(mesh) !== state.posed ||
      materials.length !== state.materials.length
    )
      return void (edits.rebuild ??= reshaped);
    if (!state.visible) {
      state.visible = true;
      edits.shown.push(...instancesOf(state));
    }
    const swapped = materials.some((material, i) => material !== state.materials[i]);
    const still =
      !mesh.isBatchedMesh &&
      sameNumbers(mesh.matrixWorld.elements, state.world) &&
      instancesVersion(mesh) === state.instances;
    if (!still || swapped || materials.some((material) => changed.has(material))) {
      if (!this.#comparePlacements(mesh, state, swapped, edits)) return void (edits.rebuild ??= reshaped);
      state.world = Array.from(mesh.matrixWorld.elements);
      state.instances = instancesVersion(mesh);
    }
    state.materials = materials;
    const vertices = verticesState(mesh);
    const pose = poseState(mesh);
    if (vertices === state.vertices && sameNumbers(pose, state.pose)) return;
    state.vertices = vertices;
    state.pose = pose;
    for (const link of state.links) {
      // Objects share the meshes of their geometry.
      if (replaced.has(link.mesh)) continue;
      replaced.add(link.mesh);
      const made = meshOf(mesh, link.part, link.options);
      if (!made) return void (edits.rebuild ??= `${nameOf(mesh)} has no triangles any more`);
      edits.meshes.push({ index: link.mesh, mesh: made });
    }
  }

  /** @returns Whether the mesh still has the parts that it had. */
  #comparePlacements(mesh: ThreeMesh, state: MeshState, swapped: boolean, edits: SceneEdits): boolean {
    const parts = readParts(mesh);
    if (parts.length !== state.links.length) return false;
    for (const [i, link] of state.links.entries()) {
      const { part, options, placements, material } = parts[i] as (typeof parts)[number];
      const sameOptions = (Object.keys(options) as (keyof typeof options)[]).every(
        (key) => options[key] === link.options[key],
      );
      const samePart = part.start === link.part.start && part.count === link.part.count;
      if (!sameOptions || !samePart || placements.length !== link.placements.length) return false;
      const before = state.transforms[i] as readonly ArrayLike<number>[];
      const hasTangents = this.scene.meshes[link.mesh]?.tangents !== undefined;
      for (const [k, { transform, tint }] of placements.entries()) {
        const instance = link.first + k;
        if (!sameNumbers(transform, before[k] as ArrayLike<number>)) edits.transforms.push({ instance, transform });
        if (!swapped) continue;
        const known = this.#conversion.materials.find(material, options.flipV, hasTangents, tint);
        if (known === undefined) edits.rebuild ??= `${nameOf(mesh)} has a material that is new`;
        else edits.assigned.push({ instance, material: known });
      }
      state.transforms[i] = placements.map(({ transform }) => transform);
    }
    return true;
  }

  #compareLights(now: ReadonlyMap<ThreeObject, Light | undefined>, edits: SceneEdits): void {
    const known = new Set<ThreeObject>();
    for (const link of this.#lights) {
      known.add(link.object);
      const before = this.scene.lights[link.index] as Light;
      // One that is hidden, or removed, gives no light.
      const light = now.get(link.object) ?? { ...before, intensity: 0 };
      if (light.type !== before.type) return void (edits.rebuild ??= `${nameOf(link.object)} is of another type`);
      const state = JSON.stringify(light);
      if (state === link.state) continue;
      link.state = state;
      edits.lights.push({ index: link.index, light });
    }
    for (const [object, light] of now) if (light && !known.has(object)) edits.rebuild ??= `${nameOf(object)} is new`;
  }

  /** Visits what is visible. */
  #visit(onMesh: (mesh: ThreeMesh) => void, onOther: (object: ThreeObject) => void): void {
    const visit = (object: ThreeObject): void => {
      if (!object.visible) return;
      const loose = object as unknown as Loose;
      if (loose['isMesh'] === true) onMesh(object as ThreeMesh);
      else if (loose['isLight'] === true) onOther(object);
      object.children.forEach(visit);
    };
    visit(this.#root);
  }
}

const nameOf = (object: ThreeObject): string => `"${object.name || String((object as unknown as Loose)['type'])}"`;

const instancesVersion = (mesh: ThreeMesh): number =>
  (mesh as unknown as { readonly instanceMatrix?: { readonly version: number } }).instanceMatrix?.version ?? 0;

const instancesOf = ({ links }: MeshState): number[] =>
  links.flatMap(({ first, placements }) => placements.map((_, i) => first + i));

const emptyState = (mesh: ThreeMesh): string =>
  [
    partsState(mesh),
    ...materialsOf(mesh).map((material) => `${material?.uuid}${String(material?.['visible'])}`),
  ].join();

function environmentState(root: ThreeObject, { above, below }: Ambience): { image: string; adjustment: string } {
  const loose = root as unknown as Loose;
  const environment = loose['environment'] as ThreeTexture | null | undefined;
  const { x, y, z } = (loose['environmentRotation'] as Record<'x' | 'y' | 'z', number> | undefined) ?? {
    x: 0,
    y: 0,
    z: 0,
  };
  const intensity = (loose['environmentIntensity'] as number | undefined) ?? 1;
  const ambient = [...above, ...below];
  const lit = ambient.some((value) => value !== 0);
  return {
    // Ambient light is added to the image, divided by its intensity.
    image: [textureState(environment), x, z, ...(lit ? [...ambient, intensity] : [])].join(),
    adjustment: [intensity, y, loose['background'] === environment && Boolean(environment)].join(),
  };
}

/** Parameters of a material that differ, with all that they are now; missing ones have their defaults. */
export function changedParameters(
  before: Material['parameters'],
  after: Material['parameters'],
  defaults: Material['parameters'],
): Material['parameters'] {
  const changed: Record<string, unknown> = {};
  for (const name of new Set([...Object.keys(before), ...Object.keys(after)]) as Set<keyof typeof after>) {
    const value = after[name] ?? defaults[name];
    if (JSON.stringify(before[name] ?? defaults[name]) !== JSON.stringify(value)) changed[name] = value;
  }
  return changed;
}
