import type { PathTracer } from '@glanz/renderer';
import {
  animation,
  keyframes,
  recordVideo,
  turntable,
  type VideoAnimations,
  type VideoPath,
  type VideoSource,
} from '@glanz/viewer/record';
import { PlaygroundError } from '../errors';
import { Poser } from '../input/poser';
import type { Context } from '../ui/context';
import { showVideoDialog, type VideoRequest } from '../ui/video-dialog';
import { filmBackground } from '../viewer/effects';
import { orbitOf } from '../viewer/camera-rig';
import { applyPose, posedScene } from '../viewer/pose';
import type { BackdropFor } from './render';
import { fileName, over } from './save';
import { whilePaused } from './while-paused';

/** Poses the video's tracers by animations, which are called by their indices here. */
function animationsOf({ opened, store }: Context, poser: () => Poser | undefined): VideoAnimations {
  const { scene } = opened();
  return {
    animations: (scene.animations ?? []).map(({ duration }, index) => ({ name: String(index), duration })),
    poserFor: async (tracer: PathTracer) => async (name, seconds) => {
      const pose = await poser()?.pose(name === undefined ? null : Number(name), seconds);
      const posed = pose && posedScene(scene, pose);
      if (!posed)
        throw new PlaygroundError(
          'playground/animation',
          'Parts of the model appear or disappear in this animation, which the playground cannot record. Record it with the command "glanz video".',
        );
      await applyPose(tracer, posed, store.state);
    },
  };
}

/** What the page shows, as recordings need it. */
function sourceOf(context: Context, poser: () => Poser | undefined): VideoSource {
  const { session, store, rig } = context;
  const { samples, exposure, toneMap } = store.state;
  return {
    samples,
    exposure,
    toneMap,
    background: filmBackground(store.state),
    camera: rig.now,
    orbit: orbitOf(rig.view),
    denoise: session.engine.settings.denoise?.source,
    get device() {
      return session.engine.device;
    },
    copyFor: (aspect) => session.engine.copyFor(aspect),
    animation: async () => animationsOf(context, poser),
  };
}

function pathOf({ motion, seconds, degrees, clip }: VideoRequest, { store }: Context): VideoPath {
  if (motion === 'turntable') return turntable({ seconds, degrees });
  if (motion === 'animation') return animation({ name: String(clip), seconds });
  const { walk } = store.state;
  return keyframes(
    walk.map((view, i) => ({ time: (i * seconds) / Math.max(1, walk.length - 1), orbit: orbitOf(view) })),
  );
}

/** Opens the dialog that records a video. The screen's image waits meanwhile, and keeps its samples. */
export function openVideoDialog(context: Context, backdropFor: BackdropFor): void {
  const { session, store, opened } = context;
  const { scene, request } = opened();
  showVideoDialog({
    name: fileName(opened().title),
    samples: Math.min(store.state.samples, 64),
    views: store.state.walk.length,
    animations: request.kind === 'files' ? (scene.animations ?? []) : [],
    clip: store.state.clip ?? 0,
    record: (video) =>
      whilePaused(session, async () => {
        let poser: Poser | undefined;
        const makePoser = () => (request.kind === 'files' ? (poser ??= new Poser(request)) : undefined);
        try {
          const { background } = store.state;
          const { width, height, fps, samples, shutter, type, seconds, signal, onProgress, onFrame } = video;
          const composed = background === 'color' || background === 'blurred';
          return await recordVideo(sourceOf(context, makePoser), {
            path: pathOf(video, context),
            width,
            height,
            fps,
            samples,
            shutter,
            seconds,
            type,
            signal,
            onProgress,
            onFrame,
            // A video has no alpha channel.
            ...(composed ? {} : { background: 'environment' }),
            ...(composed
              ? {
                  compose: async ({ data, camera }) => {
                    const backdrop = await backdropFor(width / height, camera);
                    if (backdrop) over(data, width, height, backdrop);
                  },
                }
              : {}),
          });
        } finally {
          poser?.destroy();
        }
      }),
  });
}
