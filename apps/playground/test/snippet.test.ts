import { fileURLToPath } from 'node:url';
import ts from 'typescript';
import { expect, test } from 'vitest';
import { ATTRIBUTES } from '@glanz/element';
import { createCornellBox } from '@glanz/models';
import { codeSnippet } from '../src/output/snippet';
import { htmlSnippet, reactSnippet } from '../src/output/snippet-element';
import { viewerSnippet } from '../src/output/snippet-viewer';
import { initialState, type State } from '../src/state/state';
import { withLens } from '../src/viewer/lens';
import { pivotOf } from '../src/viewer/moves';

const root = fileURLToPath(new URL('../../..', import.meta.url))
  .replace(/[\\/]$/, '')
  .replaceAll('\\', '/');
const { config } = ts.readConfigFile(`${root}/tsconfig.base.json`, ts.sys.readFile);
const { options } = ts.convertCompilerOptionsFromJson(config.compilerOptions, root);

/** Files that a program before has parsed: that took most of the time, and all programs have the same options. */
const parsed = new Map<string, ts.SourceFile | undefined>();

/** What TypeScript has to say of programs that lie in the playground's test folder, or as such a file. */
function complaints(...programs: string[]): string[] {
  return complaintsAs('apps/playground/test/snippet-#.mts', programs);
}

function complaintsAs(file: string, programs: readonly string[]): string[] {
  const names = programs.map((_, i) => `${root}/${file.replace('#', String(i))}`);
  const host = ts.createCompilerHost(options);
  const { getSourceFile, fileExists, readFile } = host;
  const text = (name: string) => programs[names.indexOf(name)];
  host.fileExists = (name) => text(name) !== undefined || fileExists(name);
  host.readFile = (name) => text(name) ?? readFile(name);
  host.getSourceFile = (name, settings) => {
    const own = text(name);
    if (own !== undefined) return ts.createSourceFile(name, own, settings);
    const key = `${name} ${typeof settings === 'object' ? settings.impliedNodeFormat : ''}`;
    if (!parsed.has(key)) parsed.set(key, getSourceFile(name, settings));
    return parsed.get(key);
  };
  const program = ts.createProgram(
    names,
    {
      ...options,
      noEmit: true,
      skipLibCheck: true,
      jsx: ts.JsxEmit.ReactJSX,
      // Not among the dependencies of the folder in which components lie here.
      paths: { '@glanz/scene/studio': [`${root}/packages/scene/src/studio.ts`] },
    },
    host,
  );
  return names.flatMap((name) =>
    ts
      .getPreEmitDiagnostics(program, program.getSourceFile(name))
      .map(({ messageText }) => ts.flattenDiagnosticMessageText(messageText, '\n')),
  );
}

const scene = createCornellBox();
const camera = scene.cameras[0]!;
const plain = initialState('studio');
const worked: State = {
  ...plain,
  exposure: 0.5,
  toneMap: 'agx',
  studio: 'low-key',
  boxes: [{ azimuth: 0.1, elevation: 0.5, width: 0.6, height: 0.4, radiance: [4, 3, 2], shape: 'disc' }],
  rotation: 30,
  background: 'color',
  relight: true,
  groups: { environment: { intensity: 0.5, color: [1, 0.9, 0.8] } },
  materials: { 1: { base_color: [0.1, 0.2, 0.3], geometry_thin_walled: true } },
  hidden: [2],
  noise: 0.02,
};

test('the programs are programs: TypeScript has nothing to say', { timeout: 300_000 }, () => {
  const lens = { ...plain.lens, stop: 4, blades: 6, fov: 30 };
  const programs = [
    codeSnippet(scene, 'cornell-box', plain, camera, [640, 480]),
    codeSnippet(scene, "it's.glb", worked, withLens(camera, lens, 1.3), [640, 480]),
    codeSnippet(
      { ...scene, variants: ['storm'], animations: [{ name: 'turn', duration: 2 }] },
      'a.glb',
      { ...plain, environment: 'file', variant: 'storm', clip: 0, time: 0.5, intensity: 2 },
      withLens(camera, { ...lens, projection: 'orthographic' }, 1.3),
      [64, 48],
    ),
    codeSnippet(scene, 'a.glb', { ...plain, environment: 'constant' }, camera, [64, 48]),
    codeSnippet(scene, 'a.glb', { ...plain, environment: 'model' }, camera, [64, 48]),
    codeSnippet(scene, 'a.glb', { ...plain, environment: 'none' }, camera, [64, 48]),
  ];
  expect(complaints(...programs)).toEqual([]);
  // And it would have something to say.
  expect(complaints(programs[0]!.replace('maxDepth', 'maxDeepness'))).not.toEqual([]);
});

test('what was edited is in the program', () => {
  const code = codeSnippet(scene, 'cornell-box', worked, camera, [640, 480]);
  expect(code).toContain(
    `await tracer.setMaterial('${scene.materials[1]!.name}', { base_color: [0.1, 0.2, 0.3], geometry_thin_walled: true });`,
  );
  expect(code).toContain(`await tracer.setVisibility(2, false); // ${scene.instances[2]!.name}`);
  expect(code).toContain("STUDIOS['low-key']");
  expect(code).toContain("await tracer.setLightGroup('environment', { intensity: 0.5, color: [1, 0.9, 0.8] });");
  expect(code).toContain('tracer.render({ samples: 256, noise: 0.02 })');
  expect(code).toContain("{ toneMap: 'agx', exposure: 0.5 }");
});

const view = {
  name: "it's.glb",
  title: 'A "box" & more',
  orbit: { target: [0.1, 0.2, 0.3], distance: 2, yaw: 0.5, pitch: 0.25, zoom: 1 },
  fov: 30,
} as const;
const posed: State = { ...worked, floor: true, variant: 'storm', clip: 0, time: 0.5, intensity: 2 };
const moving = { ...scene, variants: ['storm'], animations: [{ name: 'turn', duration: 2 }] };
const nameless = { ...moving, materials: scene.materials.map((material) => ({ ...material, name: '' })) };
/** States whose programs differ in form. */
const STATES: readonly (readonly [typeof moving, State])[] = [
  [moving, plain],
  [moving, posed],
  [nameless, posed],
  ...(['file', 'constant', 'model', 'none'] as const).map(
    (environment) => [moving, { ...worked, environment, relight: false }] as const,
  ),
];

test('programs for the viewer, React and the element are programs too', { timeout: 300_000 }, () => {
  const viewers = STATES.map(([model, state]) => viewerSnippet(model, view.name, state, camera));
  expect(complaints(...viewers)).toEqual([]);
  expect(complaints(viewers[0]!.replace('toneMap', 'toneMapp'))).not.toEqual([]);
  const components = STATES.map(([model, state]) => reactSnippet(model, state, view));
  expect(complaintsAs('packages/react/test/snippet-#.tsx', components)).toEqual([]);
  expect(
    complaintsAs('packages/react/test/snippet-#.tsx', [components[0]!.replace('cameraOrbit', 'orbit')]),
  ).not.toEqual([]);
});

test('the element gets attributes that it has, in HTML that a parser reads as they are meant', () => {
  for (const [model, state] of STATES) {
    const html = htmlSnippet(model, state, view);
    const attributes = [
      ...html.slice(0, html.indexOf('></glanz-viewer>')).matchAll(/^ {2}([a-z-]+)(?:="([^"]*)")?$/gm),
    ];
    const names = attributes.map(([, name]) => name!).filter((name) => name !== 'style');
    expect(names.filter((name) => !Object.hasOwn(ATTRIBUTES, name))).toEqual([]);
    expect(new Map(attributes.map(([, name, value]) => [name, value])).get('alt')).toBe('A &quot;box&quot; &amp; more');
    const flags = attributes.filter(([, , value]) => value === undefined).map(([, name]) => name!);
    expect(flags.every((name) => ATTRIBUTES[name as keyof typeof ATTRIBUTES] === 'flag')).toBe(true);
  }
});

test('what was edited is in the other programs', () => {
  const { name } = scene.materials[1]!;
  const edit = '{ base_color: [0.1, 0.2, 0.3], geometry_thin_walled: true }';
  const part = scene.instances[2]!.name;
  const viewer = viewerSnippet(moving, view.name, posed, camera);
  for (const text of [
    `await viewer.setMaterial('${name}', ${edit});`,
    `await viewer.setVisibility('${part}', false);`,
    "STUDIOS['low-key']",
    'environmentIntensity: 2,',
    'ground: {},',
    "variant: 'storm',",
    "player.name = 'turn';",
  ])
    expect(viewer).toContain(text);
  const html = htmlSnippet(moving, posed, view);
  for (const text of [
    'camera-orbit="0.5rad 1.3208rad 2m"',
    'camera-target="0.1m 0.2m 0.3m"',
    'field-of-view="30deg"',
    'environment-intensity="2"',
    'shadow-intensity="1"',
    'tone-mapping="agx"',
    `element.viewer?.setMaterial('${name}', ${edit});`,
    'element.currentTime = 0.5;',
  ])
    expect(html).toContain(text);
  const react = reactSnippet(moving, posed, view);
  expect(react).toContain(`const materials = { ${name}: ${edit} } as const;`);
  expect(react).toContain(`const parts = { '${part}': false };`);
  expect(react).toContain("cameraOrbit={'0.5rad 1.3208rad 2m'}");
});

test(
  'parts that were moved are so in all programs; parts of one name go by their indices',
  { timeout: 300_000 },
  () => {
    const box = scene.instances[3]!;
    const pivot = pivotOf(scene, 3);
    const state: State = {
      ...plain,
      hidden: [2],
      moves: { 3: { translation: [1, 2, 3], rotation: [0, 0, 0], scale: [2, 2, 2] } },
    };
    // p' = pivot + translation + 2 (p − pivot)
    const { transform: m } = box;
    const place = [0, 1, 2].map((k) => 2 * m[12 + k]! - pivot[k]! + [1, 2, 3][k]!);
    const expected = [...Array.from({ length: 12 }, (_, i) => (i % 4 === 3 ? m[i]! : 2 * m[i]!)), ...place, 1];
    const twins = { ...scene, instances: scene.instances.map((part) => ({ ...part, name: box.name })) };
    const programs = [
      codeSnippet(twins, 'a.glb', state, camera, [64, 48]),
      viewerSnippet(twins, 'a.glb', state, camera),
      htmlSnippet(twins, state, view),
      reactSnippet(twins, state, view),
    ];
    for (const code of programs) {
      const numbers = /setInstanceTransform\(3, \[([^\]]*)\]\)/.exec(code)![1]!.split(', ').map(Number);
      // Programs have six digits.
      numbers.forEach((value, i) => expect(value).toBeCloseTo(expected[i]!, 4));
      expect(numbers.length).toBe(16);
      expect(code).toContain('setVisibility(2, false)');
    }
    expect(complaints(programs[0]!, programs[1]!)).toEqual([]);
    expect(complaintsAs('packages/react/test/snippet-#.tsx', [programs[3]!])).toEqual([]);
    const animated = { ...twins, animations: [{ name: 'turn', duration: 2 }] };
    expect(viewerSnippet(animated, 'a.glb', { ...state, clip: 0 }, camera)).not.toContain('setInstanceTransform');
  },
);

test('the floor is in the program of the renderer', () => {
  const code = codeSnippet(scene, 'cornell-box', { ...plain, floor: true }, camera, [64, 48]);
  expect(complaints(code)).toEqual([]);
  expect(code).toContain('catcher: true');
});
