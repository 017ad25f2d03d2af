import { resolve } from 'node:path';
import type { PoseChange, ScenePoser } from '@glanz/gltf/animation';
import type { RenderProgress } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import type { Backend, Tracer } from '../backend';
import type { CliIo } from '../io';
import type { FrameMotion, Shot } from './shots';
import { cameraOf } from '../views';

/** Brings a tracer's scene to a pose. */
export async function applyPose(
  tracer: Pick<Tracer, 'setInstanceTransforms' | 'setVisibility' | 'setLight' | 'replaceMesh'>,
  { transforms, visibility, lights, meshes }: PoseChange,
): Promise<void> {
  await Promise.all([
    tracer.setInstanceTransforms(transforms.map(({ instance, transform }) => [instance, transform])),
    ...visibility.map(({ instance, visible }) => tracer.setVisibility(instance, visible)),
    ...lights.map(({ index, light }) => tracer.setLight(index, light)),
    ...meshes.map(({ mesh, deformed }) => tracer.replaceMesh(mesh, deformed)),
  ]);
}

/** Seconds of an animation that begins again at its end. */
export const looped = (seconds: number, duration: number): number =>
  seconds <= duration || duration === 0 ? seconds : seconds % duration;

/** A scene in a tracer that frames of a video are made of, one after another. */
export class MovingScene {
  readonly #tracer: Tracer;
  readonly #scene: Scene;
  #poser: ScenePoser | undefined;

  /** @param scene As it was loaded, and as the tracer was made of it. */
  constructor(tracer: Tracer, scene: Scene) {
    this.#tracer = tracer;
    this.#scene = scene;
  }

  /**
   * Renders a frame. The camera of a turntable and the animation move while the shutter is open.
   * @throws {GltfError} `gltf/no-such-part` for an animation that the model does not have
   */
  async *expose(
    { options, motion, view }: Shot,
    { backend, io, signal }: { readonly backend: Backend; readonly io: CliIo; readonly signal: AbortSignal },
    maxSubmitMs: number,
  ): AsyncGenerator<RenderProgress, void, undefined> {
    const { frame, times, shutter, animation, fps } = motion as FrameMotion;
    const { model, pose, width, height, settings } = options;
    const scene = this.#scene;
    if (animation !== undefined)
      this.#poser ??= await backend.openAnimations(resolve(io.cwd, model), scene, signal, pose);
    const poser = this.#poser;
    const duration = poser?.animations.find(({ name }, index) => animation === name || animation === index)?.duration;
    const { renderShutter } = await import('@glanz/renderer/shutter');
    yield* renderShutter(this.#tracer, {
      samples: settings.samples,
      times: shutter === 0 ? 1 : times,
      seed: frame,
      signal,
      maxSubmitMs,
      pose: async (time) => {
        const at = frame + shutter * time;
        if (poser) await applyPose(this.#tracer, poser.pose(animation, looped(at / fps, duration ?? 0)));
        if (view.kind === 'turntable')
          await this.#tracer.setCamera(await cameraOf({ ...view, step: at }, scene, width / height, io.cwd));
      },
    });
  }
}
