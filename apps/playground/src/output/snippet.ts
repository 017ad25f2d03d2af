import { sceneBounds, type Camera, type Scene } from '@glanz/scene';
import { initialState, type State } from '../state/state';
import { FLOOR, FLOOR_PARAMETERS, floorMesh } from '../viewer/compose';
import { filmBackground } from '../viewer/effects';
import { addressOf, digits, environmentLines, literal, movedParts, quoted } from './snippet-text';

/** Statements that put the invisible floor under the model. */
function floorLines(scene: Scene): string[] {
  const name = quoted(FLOOR);
  const { positions } = floorMesh(sceneBounds(scene));
  return [
    `const positions = Float32Array.of(${Array.from(positions, digits).join(', ')});`,
    `scene.meshes.push({ name: ${name}, positions, indices: Uint32Array.of(0, 1, 2, 0, 2, 3) });`,
    `scene.materials.push({ name: ${name}, parameters: ${literal(FLOOR_PARAMETERS)} });`,
    `scene.instances.push({ name: ${name}, mesh: scene.meshes.length - 1, material: scene.materials.length - 1, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], catcher: true });`,
  ];
}

/**
 * A program that makes the same image with the packages: in any page that has a canvas, or in Node up to the display.
 *
 * @param name Of the file or sample.
 * @param camera As it looks now.
 * @param size Of the film.
 */
export function codeSnippet(
  scene: Scene,
  name: string,
  state: State,
  camera: Camera,
  [width, height]: readonly [number, number],
): string {
  const initial = initialState(state.environment);
  const { imports, lines } = environmentLines(state);
  const before: string[] = [];
  const after: string[] = [];
  for (const [index, values] of Object.entries(state.materials))
    after.push(`await tracer.setMaterial(${quoted(scene.materials[Number(index)]?.name ?? '')}, ${literal(values)});`);
  if (state.variant !== null) after.push(`await tracer.setVariant(${quoted(state.variant)});`);
  for (const index of state.hidden)
    after.push(
      `await tracer.setVisibility(${index}, false); // ${(scene.instances[index]?.name ?? '').replace(/\s+/g, ' ')}`,
    );
  for (const [part, transform] of movedParts(scene, state))
    after.push(
      `await tracer.setInstanceTransform(${part}, ${transform}); // ${(scene.instances[part]?.name ?? '').replace(/\s+/g, ' ')}`,
    );
  if (state.relight)
    for (const [group, settings] of Object.entries(state.groups))
      after.push(`await tracer.setLightGroup(${quoted(group)}, ${literal(settings)});`);
  const pose = state.clip === null ? '' : `, { animation: ${state.clip}, time: ${digits(state.time)} }`;
  if (Object.values(state.slots).some(Boolean))
    before.push(
      '// Images that were dropped on parameters are not in this program: add them to scene.images and scene.textures.',
    );
  if (state.floor) before.push(...floorLines(scene));
  const options = [
    `width: ${width}`,
    `height: ${height}`,
    `maxDepth: ${state.maxDepth}`,
    'camera',
    ...(filmBackground(state) === 'transparent' ? ["background: 'transparent'"] : []),
    ...(state.relight ? ["lightGroups: 'each'"] : []),
  ];
  const goal =
    state.noise > 0 ? `{ samples: ${state.samples}, noise: ${state.noise} }` : `{ samples: ${state.samples} }`;
  const { exposure, toneMap } = state;
  return [
    "import { loadGltf } from '@glanz/gltf';",
    "import { PathTracer, requestDevice } from '@glanz/renderer';",
    "import { toneMapPixels } from '@glanz/tonemap';",
    ...imports,
    '',
    `const scene = await loadGltf(${quoted(addressOf(name))}${pose});`,
    ...lines,
    ...before,
    `const camera = ${literal(camera)} as const;`,
    `const tracer = await PathTracer.create(await requestDevice(), scene, { ${options.join(', ')} });`,
    ...after,
    `for await (const { samples } of tracer.render(${goal})) console.log(samples);`,
    '',
    `const pixels = toneMapPixels(await tracer.read('beauty'), ${width}, ${height}, ${literal({ toneMap, ...(exposure === initial.exposure ? {} : { exposure }) })});`,
    `document.querySelector('canvas')!.getContext('2d')!.putImageData(new ImageData(pixels, ${width}, ${height}), 0, 0);`,
    '',
  ].join('\n');
}
