import type { PathTracer } from '@glanz/renderer';
import { sceneBounds, type Camera, type Light, type Scene } from '@glanz/scene';
import { invert, multiply } from 'gl-matrix/esm/mat4.js';
import type { Engine } from './engine';
import type { TracerSpec } from './engine-host';
import { GROUND, withoutGround, type GroundOptions } from './ground';
import type { Vector } from './orbit-state';

/** Where a model is in the world, and what it stands on. */
export interface Stage {
  /** Affine, 16 numbers, column-major; undefined: the file's own place. */
  readonly transform?: readonly number[] | undefined;
  readonly ground?: GroundOptions | undefined;
}

/** The ground reaches so many times as far as the model's box is long from corner to corner. */
const REACH = 4;
/** The ground lies so much lower than the model, as a share of the same length: a floor that is there stays in sight. */
const GAP = 1e-4;

const identity = () => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A product of affine matrices. */
export const placed = (transform: readonly number[], inner: ArrayLike<number>): number[] =>
  multiply(identity(), transform as number[], Array.from(inner));

const point = (m: readonly number[], [x, y, z]: Vector, w: 0 | 1): Vector =>
  [0, 1, 2].map(
    (k) => (m[k] as number) * x + (m[k + 4] as number) * y + (m[k + 8] as number) * z + w * (m[k + 12] as number),
  ) as unknown as Vector;

const unit = (vector: Vector): Vector => {
  const length = Math.hypot(...vector) || 1;
  return vector.map((value) => value / length) as unknown as Vector;
};

/** A light where a transform takes it. Its intensity and its size stay. */
export function placedLight<L extends Light>(transform: readonly number[], light: L): L {
  const moved: { position?: Vector; direction?: Vector; tangent?: Vector } = {};
  if ('position' in light) moved.position = point(transform, light.position, 1);
  if ('direction' in light) moved.direction = unit(point(transform, light.direction, 0));
  if ('tangent' in light && light.tangent) moved.tangent = unit(point(transform, light.tangent, 0));
  return { ...light, ...moved };
}

/** A camera's transform has no scale. */
function placedCamera(transform: readonly number[], camera: Camera): Camera {
  const at = placed(transform, camera.transform);
  for (const column of [0, 4, 8])
    unit(at.slice(column, column + 3) as unknown as Vector).forEach((value, k) => (at[column + k] = value));
  return { ...camera, transform: at };
}

/** A scene where a transform takes it: its instances, lights and cameras. */
export const placedScene = (scene: Scene, transform: readonly number[]): Scene => ({
  ...scene,
  instances: scene.instances.map((instance) => ({ ...instance, transform: placed(transform, instance.transform) })),
  lights: scene.lights.map((light) => placedLight(transform, light)),
  cameras: scene.cameras.map((camera) => placedCamera(transform, camera)),
});

/** Where the ground of a model lies: a square from −1 to 1 in the plane y = 0, moved and scaled. */
function groundTransform(model: Scene): number[] {
  const { min, max } = sceneBounds(model);
  const size = min[0] <= max[0] ? Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]) || 1 : 1;
  const [x, y, z] = min[0] <= max[0] ? [(min[0] + max[0]) / 2, min[1], (min[2] + max[2]) / 2] : [0, 0, 0];
  const half = REACH * size;
  return [half, 0, 0, 0, 0, 1, 0, 0, 0, 0, half, 0, x as number, (y as number) - GAP * size, z as number, 1];
}

/** What the ground is made of: half opaque, it takes half of the shadow. */
const groundMaterial = ({ shadow = 1, reflection = 0 }: GroundOptions) => ({
  base_color: [0.5, 0.5, 0.5] as Vector,
  specular_weight: reflection,
  specular_roughness: 0.15,
  geometry_opacity: shadow,
});

/** Whether a ground is to be seen. */
const isShown = (ground: GroundOptions | undefined): ground is GroundOptions =>
  ground !== undefined && (ground.shadow ?? 1) > 0;

/** A scene with a ground beneath it. */
function withGround(scene: Scene, ground: GroundOptions): Scene {
  return {
    ...scene,
    meshes: [
      ...scene.meshes,
      {
        name: GROUND,
        positions: Float32Array.of(-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1),
        indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
      },
    ],
    materials: [...scene.materials, { name: GROUND, parameters: groundMaterial(ground) }],
    instances: [
      ...scene.instances,
      {
        name: GROUND,
        mesh: scene.meshes.length,
        material: scene.materials.length,
        transform: groundTransform(scene),
        catcher: true,
      },
    ],
  };
}

/** A scene as it is loaded, on a stage: the model in its place, and the same with what it stands on. */
export function staged(scene: Scene, { transform, ground }: Stage): { readonly model: Scene; readonly shown: Scene } {
  const model = transform ? placedScene(scene, transform) : scene;
  return { model, shown: isShown(ground) ? withGround(model, ground) : model };
}

/** The scene of a tracer with the ground that it has not. */
const grounded = (scene: Scene, { ground }: Stage): Scene =>
  isShown(ground) && withoutGround(scene) === scene ? withGround(scene, ground) : scene;

/** What {@link restage} needs of a model. */
export interface Restaging {
  /** The stage that the tracer's scene is on, and the one that it is to be on, which it is on then. */
  readonly from: () => Stage;
  readonly to: () => Stage;
  /** What makes another tracer of a scene as it was edited. */
  readonly specify: (former: PathTracer) => TracerSpec;
}

/** Brings what an engine shows onto another stage: by edits, or by another tracer where a ground is added. */
export async function restage(
  engine: Pick<Engine, 'edit' | 'show' | 'tracer'>,
  { from, to, specify }: Restaging,
): Promise<void> {
  let stage: Stage = {};
  await engine.edit('stage', (tracer) => changeStage(tracer, from(), (stage = to())));
  const { tracer } = engine;
  if (!tracer || grounded(tracer.scene, stage) === tracer.scene) return;
  await engine.show((former) => {
    const spec = specify(former ?? tracer);
    return { ...spec, scene: grounded(spec.scene, stage) };
  });
}

/** Brings the scene of a tracer from one stage onto another. */
async function changeStage(tracer: PathTracer, from: Stage, to: Stage): Promise<void> {
  const { scene } = tracer;
  const edits: Promise<void>[] = [];
  const model = withoutGround(scene);
  const moved = from.transform !== to.transform;
  let { instances } = model;
  if (moved) {
    const back = invert(identity(), (from.transform ?? identity()) as number[]) ?? identity();
    const change = placed(to.transform ?? identity(), back);
    instances = instances.map((instance) => ({ ...instance, transform: placed(change, instance.transform) }));
    edits.push(tracer.setInstanceTransforms(instances.map(({ transform }, index) => [index, transform])));
    scene.lights.forEach((light, index) => edits.push(tracer.setLight(index, placedLight(change, light))));
  }
  if (model !== scene) {
    const index = instances.length;
    if (moved) edits.push(tracer.setInstanceTransform(index, groundTransform({ ...model, instances })));
    edits.push(tracer.setVisibility(index, isShown(to.ground)));
    if (isShown(to.ground)) edits.push(tracer.setMaterial(GROUND, groundMaterial(to.ground)));
  }
  await Promise.all(edits);
}
