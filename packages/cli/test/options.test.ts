import { describe, expect, it } from 'vitest';
import { RENDER_OPTION_TEXTS, RENDER_OPTIONS, type RenderOption } from '@glanz/renderer/options';
import { HELP } from '../src/help';
import { CliError } from '../src/index';
import type { RenderCommandOptions } from '../src/options';
import { parseCommand } from '../src/command';
import { FLAG_OPTIONS, flagOf } from '../src/render-flags';

const options = (...argv: string[]): RenderCommandOptions => {
  const command = parseCommand(['render', ...argv]);
  if (command.kind !== 'render' || !command.options) throw new Error(command.kind);
  return command.options;
};
const complaint = (...argv: string[]): string => {
  try {
    parseCommand(argv);
  } catch (error) {
    if (error instanceof CliError && error.code === 'cli/usage' && !error.message.includes('\n')) return error.message;
    throw error;
  }
  return 'no complaint';
};

/** Settings where no flag is given. */
const defaults: Record<string, unknown> = Object.fromEntries(
  FLAG_OPTIONS.map((name) => [name, (RENDER_OPTIONS[name] as RenderOption).default]),
);

describe('glanz render', () => {
  it('has the documented defaults', () => {
    expect(options('dir/helmet.glb')).toEqual({
      model: 'dir/helmet.glb',
      pose: {},
      variants: [],
      views: [{ kind: 'camera', name: 'camera', camera: undefined }],
      outputs: [{ path: 'helmet.png', format: 'png', bits: 8 }],
      env: undefined,
      envRotation: 0,
      envIntensity: 1,
      width: 1024,
      height: 768,
      settings: defaults,
      samplesFrom: 0,
      exposure: 0,
      toneMap: 'neutral',
      catchers: [],
    });
  });

  it('reads every option, before or after the model', () => {
    const argv = [
      '--env',
      'a.hdr',
      '--env-rotation',
      '180',
      '--env-intensity=2',
      'm.gltf',
      '--size',
      '640X480',
      '--samples',
      '16',
      '--noise',
      '0.01',
      '--max-depth',
      '3',
      '--seed',
      '4294967295',
      '--camera',
      '1',
      '--exposure',
      '-1.5',
      '--tone-map',
      'agx',
      '--transparent',
      '--catcher',
      'floor',
      '--filter',
      'gaussian:2',
      '--light-groups',
      'each',
      '--max-bounces',
      'diffuse=2,volume=9',
      '--memory',
      'budgetMiB=64',
      '--clamp-indirect',
      '10',
      '--regularization',
      '0.25',
      '--no-caustics',
      '--back-face-culling',
      'all',
      '--scene',
      '1',
      '--animation',
      'walk',
      '--time',
      '-0.5',
      '--variant',
      'street',
      '--variant',
      'all',
      '--gpu',
      'H200',
      '-o',
      'x.PNG',
      '-o',
      'y.exr',
      '--bits',
      '16',
    ];
    expect(options(...argv)).toEqual({
      model: 'm.gltf',
      pose: { scene: 1, animation: 'walk', time: -0.5 },
      variants: ['street', 'all'],
      views: [{ kind: 'camera', name: 'camera', camera: '1' }],
      outputs: [
        { path: 'x.PNG', format: 'png', bits: 16 },
        { path: 'y.exr', format: 'exr', bits: 16 },
      ],
      env: 'a.hdr',
      envRotation: Math.PI,
      envIntensity: 2,
      width: 640,
      height: 480,
      samplesFrom: 0,
      settings: {
        ...defaults,
        samples: 16,
        noise: 0.01,
        maxDepth: 3,
        seed: 4294967295,
        background: 'transparent',
        filter: { type: 'gaussian', radius: 2 },
        lightGroups: 'each',
        maxBounces: { diffuse: 2, volume: 9 },
        memory: { budgetMiB: 64 },
        clampIndirect: 10,
        regularization: 0.25,
        caustics: false,
        backFaceCulling: 'all',
      },
      exposure: -1.5,
      toneMap: 'agx',
      catchers: ['floor'],
    });
  });

  it('--json and --quiet belong to the report', () => {
    expect(parseCommand(['render', 'm.glb', '--json', '-q'])).toMatchObject({
      kind: 'render',
      json: true,
      quiet: true,
    });
    expect(parseCommand(['--list-gpus', '--json'])).toEqual({ kind: 'list-gpus', json: true, quiet: false });
    expect(parseCommand(['render', 'm.glb', '--gpu', 'a', '--gpu', 'b', '--resume'])).toMatchObject({
      gpus: ['a', 'b'],
      resume: true,
    });
    expect(parseCommand(['render', '--list-gpus'])).toMatchObject({ kind: 'list-gpus' });
  });
});

it('exposure as a camera has it: sunny 16 is EV 15', () => {
  for (const text of ['f/16,1/125', '1/125 F/16 iso100', 'f/16,0.008s'])
    expect(options('m.glb', '--exposure', text).exposure).toBeCloseTo(-(Math.log2(16 * 16 * 125) + Math.log2(1.2)), 10);
});

it('help and version', () => {
  expect(
    [['--help'], ['-h'], ['render', 'x.glb', '--help'], ['help'], []].map((argv) => parseCommand(argv).kind),
  ).toEqual(new Array(5).fill('help'));
  expect(parseCommand(['-V']).kind).toBe('version');
});

describe('reports errors in one line that says what to do', () => {
  it.each([
    [['render', 'm.glb', '--sample', '3'], 'Unknown option "--sample". Did you mean --samples?'],
    [['render', 'm.glb', '--tonmap=agx'], 'Did you mean --tone-map?'],
    [['render', 'm.glb', '--zzz'], 'Unknown option "--zzz". See glanz --help.'],
    [['render', 'm.glb', '-x'], 'Unknown option "-x"'],
    [['render', 'm.glb', '--size'], 'argument missing'],
    [['render', 'm.glb', '--transparent=yes'], 'does not take an argument'],
    [['render'], 'No model given'],
    [['--json'], 'No command given'],
    [['paint', 'm.glb'], 'Unknown command "paint"'],
    [['render', 'a.glb', 'b.glb'], 'unexpected argument "b.glb"'],
    [['render', 'm.glb', '--size', '0x0'], '--size 0x0: both sides must be from 1'],
    [['render', 'm.glb', '--size', '10x0'], 'both sides'],
    [['render', 'm.glb', '--size', '99999x1'], 'both sides'],
    [['render', 'm.glb', '--size', '-5x5'], 'must be like 1024x768'],
    [['render', 'm.glb', '--size', 'big'], 'must be like 1024x768'],
    [['render', 'm.glb', '--samples', '0'], '--samples must be a whole number from 1'],
    [['render', 'm.glb', '--samples', '1.5'], 'whole number'],
    [['render', 'm.glb', '--samples', ''], 'whole number'],
    [['render', 'm.glb', '--max-depth', 'x'], '--max-depth must be'],
    [['render', 'm.glb', '--seed', '-1'], '--seed must be'],
    [['render', 'm.glb', '--exposure', 'NaN'], '--exposure must be'],
    [['render', 'm.glb', '--exposure', 'f/8'], 'f/8,1/125,iso200'],
    [['render', 'm.glb', '--exposure', 'f/8,1/0'], 'f/8,1/125,iso200'],
    [['render', 'm.glb', '--noise', '-1'], '--noise must be a number from 0 to 1000, not "-1"'],
    [['render', 'm.glb', '--max-bounces', '3'], 'such as diffuse=2'],
    [['render', 'm.glb', '--memory', '512'], 'such as budgetMiB=512'],
    [['render', 'm.glb', '--max-bounces', 'glossy=3'], 'diffuse, specular, transmission, volume'],
    [['render', 'm.glb', '--regularization', '2'], 'from 0 to 1'],
    [['render', 'm.glb', '--clamp-indirect', '0'], '--clamp-indirect must be'],
    [['render', 'm.glb', '--light-groups', 'some'], 'must be one of off, named, each'],
    [['render', 'm.glb', '--back-face-culling', 'front'], 'must be one of off, camera, all'],
    [['render', 'm.glb', '--filter', 'mitchell'], 'must be one of box, gaussian, blackman-harris'],
    [['render', 'm.glb', '--filter', 'box:0'], 'above 0 and at most 16'],
    [['render', 'm.glb', '--tone-map', 'film'], 'Known: neutral, aces, agx, reinhard, linear'],
    [['render', 'm.glb', '-o', 'out.jpg'], 'must end in .png, .exr, .hdr or .film'],
    [['render', 'm.glb', '-o', 'out'], 'must end in'],
    [['render', 'm.glb', '-o', 'out.png', '--bits', '32'], '.png has 8 or 16'],
    [['render', 'm.glb', '-o', 'out.exr', '--bits', '8'], '.exr has 16 or 32'],
  ])('%j', (argv, message) => {
    expect(complaint(...argv)).toContain(message);
  });
});

describe('the options of the table of the renderer', () => {
  it('all have a flag but the length of a submission and the layers, which follow from the outputs', () => {
    expect(Object.keys(RENDER_OPTIONS).filter((name) => !(FLAG_OPTIONS as string[]).includes(name))).toEqual([
      'maxSubmitMs',
      'aovs',
    ]);
  });

  it.each(FLAG_OPTIONS.map((name) => [flagOf(name), name] as const))(
    '--%s is in the manual and is read',
    (flag, name) => {
      const row: RenderOption = RENDER_OPTIONS[name];
      const [, entry = ''] = new RegExp(`\\n {6}--${flag}(?: [A-Z]+)?\\s+([^]*?)\\n(?: {6}--|\\n)`).exec(HELP) ?? [];
      const text = entry.replace(/\s+/g, ' ');
      expect(text.toLowerCase()).toContain(RENDER_OPTION_TEXTS[name].doc.replaceAll('`', '').toLowerCase());
      const set = (...value: string[]) => options('m.glb', [`--${flag}`, ...value].join('=')).settings[name];
      if (row.type === 'boolean') return expect(set()).toBe(false);
      if (row.type === 'enum')
        for (const value of row.values) expect([set(value), text]).toEqual([value, expect.stringContaining(value)]);
      if (row.type !== 'number' && row.type !== 'integer') return;
      const [low, high] = row.range;
      expect(text).toMatch(new RegExp(`${low},? to ${String(high).replace('+', '\\+')}`));
      if (row.default !== undefined) expect(text).toContain(`default ${row.default}`);
      const step = row.type === 'integer' ? 1 : Math.max(1e-12, Math.abs(high) * 2 ** -50);
      expect(set(String(high))).toBe(high);
      for (const value of [high + step, low - step, NaN, Infinity, 'many', ''])
        expect(complaint('render', 'm.glb', `--${flag}=${value}`)).toSatisfy(
          (message: string) => message.startsWith(`--${flag} must be a `) && message.endsWith(`, not "${value}".`),
        );
    },
  );

  it('--background overrides --transparent', () => {
    expect(options('m.glb', '--transparent').settings.background).toBe('transparent');
    expect(options('m.glb', '--transparent', '--background', 'environment').settings.background).toBe('environment');
  });
});
