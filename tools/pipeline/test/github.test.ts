// The workflows and forms in .github: what GitHub would refuse, and commands that do not exist.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { parse } from 'yaml';

const root = fileURLToPath(new URL('../../../', import.meta.url));
const github = join(root, '.github');
const read = (...path: string[]): unknown => parse(readFileSync(join(github, ...path), 'utf8'), { strict: true });
const yamlFiles = (folder: string) => readdirSync(join(github, folder)).filter((name) => name.endsWith('.yml'));
const { scripts } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')) as {
  scripts: Record<string, string>;
};

interface Step {
  readonly run?: string;
  readonly uses?: string;
  readonly with?: Readonly<Record<string, unknown>>;
}
interface Workflow {
  readonly name: string;
  readonly on: Readonly<Record<string, unknown>>;
  readonly permissions: unknown;
  readonly jobs: Readonly<Record<string, { readonly 'timeout-minutes'?: number; readonly steps: readonly Step[] }>>;
}

describe.each(yamlFiles('workflows'))('workflow %s', (file) => {
  const workflow = read('workflows', file) as Workflow;
  const jobs = Object.values(workflow.jobs);
  const steps = jobs.flatMap((job) => job.steps);

  it('names what starts it, its rights, and how long it may take', () => {
    expect(workflow.name).toBeTruthy();
    expect(Object.keys(workflow.on).length).toBeGreaterThan(0);
    // Without it, the token may write to everything.
    expect(workflow.permissions).toBeDefined();
    for (const job of jobs) expect(job['timeout-minutes']).toBeGreaterThan(0);
  });

  it('has steps that are one thing each, of actions with a version', () => {
    for (const step of steps) expect([step.run, step.uses].filter((part) => part !== undefined)).toHaveLength(1);
    for (const { uses } of steps) if (uses !== undefined) expect(uses).toMatch(/^[\w-]+\/[\w-]+@v\d+$/);
  });

  it('runs scripts that exist', () => {
    const commands = steps.flatMap((step) => [
      step.run,
      ...Object.values(step.with ?? {}).filter((value) => typeof value === 'string'),
    ]);
    for (const command of commands) {
      const script = /^npm (?:run )?([\w:]+)/.exec(command ?? '')?.[1];
      if (script !== undefined) expect(Object.keys(scripts)).toContain(script);
    }
  });
});

it('tests with the command of the README, and the oldest Node that manifests allow', () => {
  const ci = readFileSync(join(github, 'workflows', 'ci.yml'), 'utf8');
  expect(ci).toMatch(/- run: npm test\n/);
  const { engines } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')) as { engines: { node: string } };
  expect(ci).toContain(`'${engines.node.replace('>=', '')}'`);
});

interface Field {
  readonly type: string;
  readonly id?: string;
  readonly attributes: Readonly<Record<string, unknown>>;
}

// https://docs.github.com/en/communities/using-templates-to-encourage-useful-issues-and-pull-requests/syntax-for-issue-forms
describe.each(yamlFiles('ISSUE_TEMPLATE').filter((name) => name !== 'config.yml'))('form %s', (file) => {
  const form = read('ISSUE_TEMPLATE', file) as { name: string; description: string; body: readonly Field[] };
  const fields = form.body.filter(({ type }) => type !== 'markdown');

  it('has a name, a description, and fields of known types with unique ids and labels', () => {
    expect(form.name && form.description).toBeTruthy();
    expect(fields.length).toBeGreaterThan(0);
    for (const { type } of form.body)
      expect(['markdown', 'textarea', 'input', 'dropdown', 'checkboxes']).toContain(type);
    for (const values of [fields.map(({ id }) => id), fields.map(({ attributes }) => attributes['label'])]) {
      expect(new Set(values).size).toBe(fields.length);
      for (const value of values) expect(value).toBeTruthy();
    }
  });

  it('offers choices that are distinct texts', () => {
    for (const { attributes } of fields.filter(({ type }) => type === 'dropdown')) {
      const options = attributes['options'] as unknown[];
      expect(options.every((option) => typeof option === 'string' && option !== 'None')).toBe(true);
      expect(new Set(options).size).toBe(options.length);
    }
  });
});

it('updates dependencies of npm and of the workflows', () => {
  const { version, updates } = read('dependabot.yml') as {
    version: number;
    updates: readonly { 'package-ecosystem': string; directory: string; schedule: { interval: string } }[];
  };
  expect(version).toBe(2);
  expect(updates.map((update) => update['package-ecosystem']).sort()).toEqual(['github-actions', 'npm']);
  for (const { directory, schedule } of updates) {
    expect(existsSync(join(root, directory))).toBe(true);
    expect(['daily', 'weekly', 'monthly']).toContain(schedule.interval);
  }
});
