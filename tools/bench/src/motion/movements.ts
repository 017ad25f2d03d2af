import type { PathTracer } from '@glanz/renderer';
import { sceneBounds, type Camera, type Scene } from '@glanz/scene';
import type { ProductScene } from '../denoise/product-scenes';
import { orbited } from './orbit';

/** Frames of a movement, and radians of an orbit from one to the next: a quarter turn a second at 60 frames a second. */
export const FRAMES = 120;
export const STEP = Math.PI / 2 / 60;
/** Radians that a camera inside of a room turns at most to either side. */
const SWAY = 0.12;
/** Of the field of view, what is left at the end of a zoom. */
const ZOOM = 0.5;
/** How far an instance moves to either side, in lengths of the scene's diagonal. */
const SHIFT = 0.05;

/** What changes from frame to frame. */
export interface Movement {
  /** Whether instances move. */
  readonly instances: boolean;
  /** Brings a tracer of a product to a frame of the movement. */
  readonly at: (tracer: PathTracer, product: ProductScene, frame: number) => Promise<void>;
}

/** A wave of two periods in the whole movement, −1 to 1, 0 at the start. */
const wave = (frame: number) => Math.sin((4 * Math.PI * frame) / FRAMES);

/** A transform after a translation by `x`, `y` and `z`. */
function moved(transform: ArrayLike<number>, [x, y, z]: readonly [number, number, number]): number[] {
  const out = Array.from(transform);
  [x, y, z].forEach((shift, k) => (out[12 + k]! += shift));
  return out;
}

/** Index of the instance that emits light; -1 if none does. */
const emitter = ({ instances, materials }: Scene) =>
  instances.findIndex(({ material }) => (materials[material]?.parameters.emission_luminance ?? 0) > 0);

/** Rooms have no environment; their camera stays in front of them. */
const isRoom = ({ environment }: Scene) => environment === undefined;

function zoomed(camera: Camera, frame: number): Camera {
  const factor = ZOOM ** (frame / (FRAMES - 1));
  return camera.type === 'perspective' ? { ...camera, yfov: camera.yfov * factor } : camera;
}

/** The camera of a frame of the orbit: around products, and back and forth in front of the room, at the same speed. */
export function orbitCamera({ scene, camera }: ProductScene, frame: number): Camera {
  const angle = frame * STEP;
  return orbited(camera, isRoom(scene) ? SWAY * Math.sin(angle / SWAY) : angle);
}

/** Movements by name. */
export const MOVEMENTS: Readonly<Record<string, Movement>> = {
  orbit: {
    instances: false,
    at: (tracer, product, frame) => tracer.setCamera(orbitCamera(product, frame)),
  },
  zoom: {
    instances: false,
    at: (tracer, { camera }, frame) => tracer.setCamera(zoomed(camera, frame)),
  },
  // The environment turns; in a room the light itself moves along the ceiling.
  light: {
    instances: false,
    at: async (tracer, { scene }, frame) => {
      if (!isRoom(scene)) return tracer.adjustEnvironment({ rotation: frame * STEP });
      const index = emitter(scene);
      const { min, max } = sceneBounds(scene);
      const reach = 0.25 * (max[0] - min[0]);
      await tracer.setInstanceTransform(index, moved(scene.instances[index]!.transform, [reach * wave(frame), 0, 0]));
    },
  },
  // The last instance that emits no light slides back and forth, or the only one.
  instance: {
    instances: true,
    at: (tracer, { scene }, frame) => {
      const light = emitter(scene);
      const index = Math.max(
        0,
        scene.instances.findLastIndex((_, i) => i !== light),
      );
      const { min, max } = sceneBounds(scene);
      const reach = SHIFT * Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
      return tracer.setInstanceTransform(index, moved(scene.instances[index]!.transform, [reach * wave(frame), 0, 0]));
    },
  },
  // The material that most instances have gets darker and brighter.
  material: {
    instances: false,
    at: (tracer, { scene }, frame) => {
      const counts = scene.materials.map((_, i) => scene.instances.filter(({ material }) => material === i).length);
      const index = counts.indexOf(Math.max(...counts));
      const color = scene.materials[index]!.parameters.base_color ?? [0.8, 0.8, 0.8];
      const factor = 0.7 + 0.3 * Math.cos((4 * Math.PI * frame) / FRAMES);
      const [r, g, b] = color;
      return tracer.setMaterial(index, { base_color: [factor * r, factor * g, factor * b] });
    },
  },
};
