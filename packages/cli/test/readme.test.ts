import { readFileSync } from 'node:fs';
import { encodeHdr } from '@glanz/image';
import { describe, expect, it } from 'vitest';
import { HELP } from '../src/help';
import { parseCommand } from '../src/command';
import { run, temporaryFolder, triangleScene } from './fakes';

const README = readFileSync(new URL('../README.md', import.meta.url), 'utf8');

/** Splits a command line as a shell does: words, single quotes, no comment, nothing after a pipe. */
function words(line: string): string[] {
  return [...line.replace(/\s+[#|].*$/, '').matchAll(/'([^']*)'|(\S+)/g)].map(
    (match) => match[1] ?? (match[2] as string),
  );
}

/** Commands of a text, each of which a backslash may continue on the next line. */
const commands = (text: string, pattern: RegExp) =>
  [...text.replace(/\\\n\s*/g, '').matchAll(pattern)].map((match) => match[1]!);

const fromReadme = commands(/```sh\n([\s\S]+?)```/.exec(README)![1]!, /^(?:npx @glanz\/cli|glanz) (.+)$/gm);
const fromHelp = commands(HELP.slice(HELP.indexOf('EXAMPLES')), /^ {2}glanz (.+)$/gm);

describe('every command line that the documentation shows can be typed', () => {
  it('and they are there', () => expect([fromReadme.length, fromHelp.length]).toEqual([8, 11]));
  it.each([...fromReadme, ...fromHelp])('glanz %s', async (line) => {
    const command = parseCommand(words(line));
    expect(['render', 'convert', 'info', 'bench', 'serve', 'video', 'list-gpus']).toContain(command.kind);
    if (command.kind !== 'render') return;
    const cwd = temporaryFolder({
      [command.options?.model ?? 'shoe.glb']: '',
      'catalogue.csv': 'model,view,output\nshoe.glb,iso,a.png\n',
      'studio.hdr': encodeHdr({ width: 2, height: 1, data: new Float32Array(6).fill(0.5) }),
    });
    const { code, err } = await run([...words(line), '--size', '4x4', '--samples', '1'], cwd, {
      scene: { ...triangleScene(), variants: ['street', 'beach'] },
    });
    expect(code, err).toBe(0);
  });
});

it('the camera that the README shows is one', async () => {
  const json = /--camera` takes[^`]*`'([^']+)'`/.exec(README)![1]!;
  const { code, created } = await run(
    ['render', 'm.glb', '--size', '4x4', '--camera', json],
    temporaryFolder({ 'm.glb': '' }),
  );
  expect([code, (created[0]!.options.camera as { yfov: number }).yfov]).toEqual([0, (35 * Math.PI) / 180]);
});

it('the error that the README quotes is the one that is written', async () => {
  const quoted = /e\.g\. `(glanz: [^`]+)`/.exec(README)![1]!;
  const { err } = await run(['render', 'x.glb'], temporaryFolder());
  expect(err).toBe(`${quoted}\n`);
});
