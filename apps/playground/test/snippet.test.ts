import { fileURLToPath } from 'node:url';
import ts from 'typescript';
import { expect, test } from 'vitest';
import { createCornellBox } from '@glanz/models';
import { codeSnippet } from '../src/output/snippet';
import { initialState, type State } from '../src/state/state';
import { withLens } from '../src/viewer/lens';

const root = fileURLToPath(new URL('../../..', import.meta.url))
  .replace(/[\\/]$/, '')
  .replaceAll('\\', '/');
const { config } = ts.readConfigFile(`${root}/tsconfig.base.json`, ts.sys.readFile);
const { options } = ts.convertCompilerOptionsFromJson(config.compilerOptions, root);

/** What TypeScript has to say of a program that lies in the playground's test folder. */
function complaints(...programs: string[]): string[] {
  const names = programs.map((_, i) => `${root}/apps/playground/test/snippet-${i}.mts`);
  const host = ts.createCompilerHost(options);
  const { getSourceFile, fileExists, readFile } = host;
  const text = (name: string) => programs[names.indexOf(name)];
  host.fileExists = (name) => text(name) !== undefined || fileExists(name);
  host.readFile = (name) => text(name) ?? readFile(name);
  host.getSourceFile = (name, target) =>
    text(name) === undefined ? getSourceFile(name, target) : ts.createSourceFile(name, text(name)!, target);
  const program = ts.createProgram(names, { ...options, noEmit: true, skipLibCheck: true }, host);
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
