import { execFile } from 'node:child_process';
import { chmodSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { describe, expect, it } from 'vitest';
import { parseFarm } from '../src/commands/farm/parse';
import { run as glanz, temporaryFolder, triangleScene } from './fakes';
import { makeGlb } from './glb';
import { bundleProgram } from './program';
import { findKubernetesValidate, findOpenJd } from './python-program';
import { findSlurm, type CheckScript } from './slurm-program';

const program = fileURLToPath(new URL('../.cache/glanz-schedulers.mjs', import.meta.url));
const examples = fileURLToPath(new URL('../../../apps/docs/examples/farm/', import.meta.url));
const run = promisify(execFile);
const [openjd, kubernetes, slurm] = await Promise.all([findOpenJd(), findKubernetesValidate(), findSlurm()]);

/** A folder with a model, a batch, and the command as a script. */
function folderWith(batch: object): string {
  const folder = temporaryFolder({ 'shoe.glb': makeGlb({ variants: true }) });
  writeFileSync(join(folder, 'batch.json'), JSON.stringify(batch));
  const script = join(folder, 'glanz');
  writeFileSync(script, `#!/bin/sh\nexec "${process.execPath}" "${program}" "$@"\n`);
  chmodSync(script, 0o755);
  return folder;
}

const MATRIX = {
  defaults: { model: 'shoe.glb', size: '8x8', 'max-depth': 2, bits: 16 },
  images: [{ variant: 'all', view: ['front', '30,20'], output: 'out/{variant}-{view}.png' }],
};

interface Template {
  readonly steps: readonly {
    readonly name: string;
    readonly parameterSpace: {
      readonly taskParameterDefinitions: readonly { readonly name: string; readonly range: unknown }[];
      readonly combination: string;
    };
    readonly script: { readonly actions: { readonly onRun: { readonly args: readonly string[] } } };
  }[];
}

async function templateOf(cwd: string, ...options: string[]): Promise<Template> {
  const { code, err } = await glanz(['farm', 'submit', 'batch.json', '--openjd', 'job.json', ...options], cwd, {
    scene: { ...triangleScene(), variants: ['red', 'green', 'deep blue'] },
  });
  expect(code, err).toBe(0);
  return JSON.parse(readFileSync(join(cwd, 'job.json'), 'utf8')) as Template;
}

describe('Open Job Description', () => {
  it('the parameters are variants × views × parts; other batches are numbered', async () => {
    const { steps } = await templateOf(folderWith(MATRIX), '--samples', '64', '--split', '16');
    const [render, merge] = steps;
    expect(steps.map(({ name }) => name)).toEqual(['Render', 'Merge']);
    expect(render!.parameterSpace).toEqual({
      taskParameterDefinitions: [
        { name: 'Variant', type: 'STRING', range: ['red', 'green', 'deep_blue'] },
        { name: 'View', type: 'STRING', range: ['front', '30_20'] },
        { name: 'Part', type: 'INT', range: '0-3' },
      ],
      combination: 'Variant * View * Part',
    });
    expect(merge!.parameterSpace.combination).toBe('Variant * View');
    const rows = folderWith([
      { model: 'shoe.glb', view: 'front', output: 'a.png' },
      { model: 'shoe.glb', view: 'front', output: 'b.png', samples: 7 },
    ]);
    const { steps: numbered } = await templateOf(rows);
    expect(numbered.map(({ parameterSpace }) => parameterSpace.taskParameterDefinitions)).toEqual([
      [{ name: 'Image', type: 'INT', range: '0-1' }],
    ]);
    // Its arguments are such that the command reads.
    const args = numbered[0]!.script.actions.onRun.args.map((text) =>
      text.replace('{{Task.Param.Image}}', '1').replace(/\{\{Param\.(\w+)\}\}/, '$1'),
    );
    expect(parseFarm(args.slice(1))).toMatchObject({
      action: 'task',
      args: ['Batch'],
      images: [1],
      store: { url: 'Store' },
    });
  });

  it('a store in a bucket is a text, with its endpoint', async () => {
    const { openJdTemplate } = await import('../src/farm/openjd');
    const template = openJdTemplate('b', [{ shot: { view: { name: 'front' } }, requests: [] } as never], {
      folder: '/w',
      batch: '/w/b.json',
      store: { url: 's3://farm/x', endpoint: 'http://127.0.0.1:9', cache: '/c' },
      outputRoot: '/w',
      cwd: '/w',
      split: undefined,
      gpu: undefined,
      values: {},
    });
    expect(template).toMatchObject({
      parameterDefinitions: expect.arrayContaining([{ name: 'Store', type: 'STRING', default: 's3://farm/x' }]),
      steps: [
        {
          script: {
            actions: {
              onRun: { args: expect.arrayContaining(['--store={{Param.Store}}', '--s3-endpoint=http://127.0.0.1:9']) },
            },
          },
        },
      ],
    });
  });

  it.skipIf(openjd.missing !== undefined)(
    openjd.missing ?? 'openjd checks and runs it: the same files, bit for bit',
    async () => {
      await bundleProgram(program);
      const [row] = MATRIX.images;
      const few = { ...MATRIX, images: [{ ...row, variant: ['red', 'deep blue'], view: 'front' }] };
      const folder = folderWith(few);
      await templateOf(folder, '--samples', '32', '--split', '16', '--gpu', 'software');
      const checked = await run(openjd.file!, ['check', 'job.json'], { cwd: folder });
      expect(checked.stdout).toMatch(/passes validation checks/);
      const argv = ['--step', 'Merge', '--run-dependencies', '-p', `Glanz=${join(folder, 'glanz')}`];
      const made = await run(openjd.file!, ['run', 'job.json', ...argv], { cwd: folder, maxBuffer: 2 ** 26 });
      expect(made.stdout).toMatch(/Session ended successfully/);
      const alone = folderWith(few);
      await run(
        join(alone, 'glanz'),
        ['farm', 'task', 'batch.json', '--samples', '32', '--split', '16', '--gpu', 'software'],
        { cwd: alone },
      );
      const names = readdirSync(join(alone, 'out')).sort();
      expect(names).toEqual(['deep_blue-front.png', 'red-front.png']);
      expect(readdirSync(join(folder, 'out')).sort()).toEqual(names);
      for (const name of names)
        expect(Buffer.compare(readFileSync(join(folder, 'out', name)), readFileSync(join(alone, 'out', name)))).toBe(0);
    },
  );
});

describe('the examples of the documentation', () => {
  it('Slurm: a task of the array renders its image', async () => {
    const folder = temporaryFolder();
    const glanzScript = join(folder, 'glanz');
    writeFileSync(glanzScript, '#!/bin/sh\nfor word in "$@"; do printf "%s\\n" "$word"; done\n');
    chmodSync(glanzScript, 0o755);
    const { stdout } = await run('bash', [join(examples, 'slurm.sh')], {
      env: { ...process.env, PATH: `${folder}:${process.env.PATH}`, SLURM_ARRAY_TASK_ID: '17' },
    });
    const [first, ...argv] = stdout.trimEnd().split('\n');
    expect(first).toBe('farm');
    expect(parseFarm(argv)).toMatchObject({
      action: 'task',
      args: ['catalogue.csv'],
      images: [17],
      store: { url: '/mnt/farm' },
    });
    // Options of sbatch are comments at the beginning.
    const text = readFileSync(join(examples, 'slurm.sh'), 'utf8');
    expect(text.match(/^#SBATCH --[a-z-]+=\S+$/gm)).toContain('#SBATCH --array=0-239');
    // Without "B:" the signal goes to the steps of a job, and this one has none.
    expect(text).toMatch(/^#SBATCH --signal=B:TERM@60$/m);
    expect(text).toMatch(/^exec glanz /m);
  });

  it.skipIf(slurm.missing !== undefined)(
    slurm.missing ?? 'Slurm: sbatch accepts the options of the array',
    async () => {
      const { check } = slurm as { check: CheckScript };
      const script = join(examples, 'slurm.sh');
      // Options are checked first: what it misses is the controller.
      expect(await check(script)).toMatch(/^allocation failure: Unable to contact slurm controller[^\n]*\n?$/);
      const wrong = join(temporaryFolder(), 'wrong.sh');
      writeFileSync(wrong, readFileSync(script, 'utf8').replace('--gres=gpu:1', '--gpus-per-task=1'));
      expect(await check(wrong)).toMatch(/Failed to validate job spec/);
    },
  );

  it('Kubernetes: an indexed job, whose command the program reads', () => {
    const job = JSON.parse(readFileSync(join(examples, 'kubernetes.json'), 'utf8')) as {
      readonly apiVersion: string;
      readonly kind: string;
      readonly spec: {
        readonly completionMode: string;
        readonly completions: number;
        readonly parallelism: number;
        readonly template: {
          readonly spec: {
            readonly restartPolicy: string;
            readonly containers: readonly {
              readonly command: readonly string[];
              readonly volumeMounts: readonly { readonly name: string; readonly mountPath: string }[];
            }[];
            readonly volumes: readonly { readonly name: string }[];
          };
        };
      };
    };
    const { spec } = job.spec.template;
    expect([job.apiVersion, job.kind, job.spec.completionMode]).toEqual(['batch/v1', 'Job', 'Indexed']);
    // Jobs allow these two alone.
    expect(['Never', 'OnFailure']).toContain(spec.restartPolicy);
    const [container] = spec.containers;
    const [command, farm, ...argv] = container!.command.map((word) => word.replace('$(JOB_COMPLETION_INDEX)', '239'));
    expect([command, farm]).toEqual(['glanz', 'farm']);
    expect(parseFarm(argv)).toMatchObject({ action: 'task', images: [239] });
    expect(job.spec.completions).toBe(240);
    const volumes = spec.volumes.map(({ name }) => name);
    for (const { name } of container!.volumeMounts) expect(volumes).toContain(name);
  });

  it.skipIf(kubernetes.missing !== undefined)(
    kubernetes.missing ?? 'Kubernetes: the schemas of its versions accept the job',
    async () => {
      const file = join(examples, 'kubernetes.json');
      const validate = (version: string, path: string) => run(kubernetes.file!, ['--strict', '-k', version, path]);
      for (const version of ['1.28', '1.31', '1.34'])
        expect((await validate(version, file)).stdout).toMatch(/passed for resource job\/catalogue/);
      const wrong = join(temporaryFolder(), 'wrong.json');
      writeFileSync(wrong, readFileSync(file, 'utf8').replace('"completionMode"', '"completionsMode"'));
      await expect(validate('1.34', wrong)).rejects.toMatchObject({
        stdout: expect.stringMatching(/'completionsMode' was unexpected/),
      });
    },
  );
});
