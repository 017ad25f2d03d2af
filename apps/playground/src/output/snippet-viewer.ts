import type { Camera, Scene } from '@glanz/scene';
import type { State } from '../state/state';
import { filmBackground } from '../viewer/effects';
import {
  addressOf,
  digits,
  environmentSource,
  environmentView,
  keyOf,
  literal,
  movedParts,
  quoted,
} from './snippet-text';

/** Calls that bring a model that was loaded to the state's materials and parts. @param viewer An expression. */
export function editCalls(scene: Scene, state: State, viewer: string): string[] {
  return [
    ...Object.entries(state.materials).map(
      ([index, values]) => `${viewer}.setMaterial(${keyOf(scene.materials, Number(index))}, ${literal(values)});`,
    ),
    ...state.hidden.map((index) => `${viewer}.setVisibility(${keyOf(scene.instances, index)}, false);`),
  ];
}

/** Calls that move parts of a model that was loaded. @param viewer An expression. */
export function moveCalls(scene: Scene, state: State, viewer: string): string[] {
  const moved = movedParts(scene, state);
  // The player of an animation places all parts.
  if (moved.length > 0 && state.clip !== null) return ['// Parts that were moved are where the animation has them.'];
  return moved.map(
    ([part, transform]) =>
      `${viewer}.edit((tracer) => tracer.setInstanceTransform(${part}, ${transform}), { key: 'move ${part}' });`,
  );
}

/**
 * A program that shows the model with `@glanz/viewer`: a canvas that users turn, which begins as the image looks now.
 *
 * @param name Of the file or sample.
 * @param camera As it looks now.
 */
export function viewerSnippet(scene: Scene, name: string, state: State, camera: Camera): string {
  const environment = environmentSource(state);
  const { intensity, rotation } = environmentView(state);
  const options: (readonly [string, string | undefined])[] = [
    ['environment', environment?.value],
    ['environmentIntensity', intensity === undefined ? undefined : String(digits(intensity))],
    ['environmentRotation', rotation === undefined ? undefined : String(digits(rotation))],
    ['background', filmBackground(state) === 'transparent' ? quoted('transparent') : undefined],
    ['ground', state.floor ? '{}' : undefined],
    ['variant', state.variant === null ? undefined : quoted(state.variant)],
    ['camera', literal(camera)],
    ['exposure', state.exposure === 0 ? undefined : String(digits(state.exposure))],
    ['toneMap', quoted(state.toneMap)],
    ['samples', String(state.samples)],
    ['noise', state.noise === 0 ? undefined : String(state.noise)],
    ['maxDepth', String(state.maxDepth)],
  ];
  const clip = state.clip === null ? undefined : scene.animations?.[state.clip];
  return [
    ...(environment?.imports ?? []),
    "import { createViewer } from '@glanz/viewer';",
    '',
    "const viewer = createViewer(document.querySelector('canvas')!, {",
    ...options.flatMap(([key, value]) => (value === undefined ? [] : [`  ${key}: ${value},`])),
    '});',
    `await viewer.load(${quoted(addressOf(name))});`,
    ...editCalls(scene, state, 'await viewer'),
    ...moveCalls(scene, state, 'await viewer'),
    ...(clip
      ? [
          'const player = await viewer.animation();',
          `player.name = ${quoted(clip.name)};`,
          `player.currentTime = ${digits(state.time)};`,
        ]
      : []),
    '',
  ].join('\n');
}
