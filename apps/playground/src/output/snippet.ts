import type { Camera, Scene } from '@glanz/scene';
import { initialState, type State } from '../state/state';
import { filmBackground } from '../viewer/effects';

const digits = (value: unknown): unknown => (typeof value === 'number' ? Number(value.toPrecision(6)) : value);
const quoted = (text: string) => `'${text.replaceAll('\\', '\\\\').replaceAll("'", "\\'").replaceAll('\n', '\\n')}'`;

/** A value as a person would write it in TypeScript. */
function literal(value: unknown, depth = 0): string {
  if (Array.isArray(value) || ArrayBuffer.isView(value)) {
    const items = Array.from(value as unknown as unknown[]);
    if (items.every((item) => typeof item !== 'object')) return `[${items.map((item) => literal(item)).join(', ')}]`;
    const pad = '  '.repeat(depth + 1);
    return `[\n${items.map((item) => `${pad}${literal(item, depth + 1)},`).join('\n')}\n${'  '.repeat(depth)}]`;
  }
  if (typeof value === 'object' && value !== null)
    return `{ ${Object.entries(value)
      .map(([key, item]) => `${/^[A-Za-z_$][\w$]*$/.test(key) ? key : quoted(key)}: ${literal(item, depth)}`)
      .join(', ')} }`;
  return typeof value === 'string' ? quoted(value) : String(digits(value));
}

const BUILT_IN: Readonly<Record<string, string>> = {
  'push-button': 'push-button-medium.glb',
  'push-button-low': 'push-button-low.glb',
  'push-button-high': 'push-button-high.glb',
  'cornell-box': 'cornell-box.glb',
};

function environmentLines({ environment, studio, boxes, constant, intensity, rotation }: State): {
  readonly imports: string[];
  readonly lines: string[];
} {
  const turn = rotation === 0 ? {} : { rotation: (rotation * Math.PI) / 180 };
  const dim = intensity === 1 ? {} : { intensity };
  if (environment === 'none') return { imports: [], lines: ['delete scene.environment;'] };
  if (environment === 'constant')
    return {
      imports: [],
      lines: [`scene.environment = ${literal({ type: 'constant', radiance: constant.map((c) => c * intensity) })};`],
    };
  if (environment === 'file') {
    return {
      imports: ["import { decodeEnvironment } from '@glanz/image/environment';"],
      lines: [
        "const image = decodeEnvironment(new Uint8Array(await (await fetch('/environment.hdr')).arrayBuffer()));",
        `scene.environment = { type: 'latlong', ...image${Object.entries({ ...dim, ...turn })
          .map(([key, value]) => `, ${key}: ${literal(value)}`)
          .join('')} };`,
      ],
    };
  }
  const options = { ...dim, ...turn };
  const plain = studio === 'neutral' && !boxes;
  const setup = boxes ? `{ ...STUDIOS[${quoted(studio)}], boxes: ${literal(boxes)} }` : `STUDIOS[${quoted(studio)}]`;
  const fields = [
    ...(plain ? [] : [`setup: ${setup}`]),
    ...Object.entries(options).map(([key, value]) => `${key}: ${literal(value)}`),
  ];
  const made = `studioEnvironment(${fields.length > 0 ? `{ ${fields.join(', ')} }` : ''})`;
  return {
    imports: [`import { ${plain ? '' : 'STUDIOS, '}studioEnvironment } from '@glanz/scene/studio';`],
    lines: [`scene.environment ${environment === 'model' ? '??=' : '='} ${made};`],
  };
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
  if (state.relight)
    for (const [group, settings] of Object.entries(state.groups))
      after.push(`await tracer.setLightGroup(${quoted(group)}, ${literal(settings)});`);
  const pose = state.clip === null ? '' : `, { animation: ${state.clip}, time: ${digits(state.time)} }`;
  if (Object.values(state.slots).some(Boolean))
    before.push(
      '// Images that were dropped on parameters are not in this program: add them to scene.images and scene.textures.',
    );
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
    `const scene = await loadGltf(${quoted(`/${BUILT_IN[name] ?? name}`)}${pose});`,
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
