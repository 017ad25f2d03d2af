import { execFile, spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const NEXT = join('node_modules', 'next', 'dist', 'bin', 'next');
const root = fileURLToPath(new URL('../../../', import.meta.url));

/** The first block of a language in a README: what people paste. */
export function quickStart(packageName: string, language: string): string {
  const text = readFileSync(join(root, 'packages', packageName, 'README.md'), 'utf8');
  const block = new RegExp(`\`\`\`${language}\n([\\s\\S]*?)\n\`\`\``).exec(text)?.[1];
  if (block === undefined) throw new Error(`packages/${packageName}/README.md has no block of ${language}.`);
  return block;
}

/** A block of a page of the documentation that names its file, as ```tsx [app/page.tsx] does: what people paste into that file. */
export function fileFromGuide(guide: string, path: string): string {
  const text = readFileSync(join(root, 'apps/docs/guide', `${guide}.md`), 'utf8');
  const name = path.replace(/[.[\]]/g, '\\$&');
  const block = new RegExp(`\`\`\`\\w+ \\[${name}\\]\n([\\s\\S]*?)\n\`\`\``).exec(text)?.[1];
  if (block === undefined) throw new Error(`apps/docs/guide/${guide}.md has no block for ${path}.`);
  return `${block}\n`;
}

/** Shell commands of a page of the documentation, the block that contains `has`: lines without those that install, since no registry has the packages. */
export function commandsOf(guide: string, has: string): string[] {
  const text = readFileSync(join(root, 'apps/docs/guide', `${guide}.md`), 'utf8');
  const block = [...text.matchAll(/```sh\n([\s\S]*?)\n```/g)].map(([, lines = '']) => lines).find((lines) => lines.includes(has));
  if (block === undefined) throw new Error(`apps/docs/guide/${guide}.md has no commands with ${has}.`);
  return block.split('\n').filter((line) => !line.startsWith('npm install'));
}

/** Lines that somebody would have to write. */
export const linesOf = (code: string): number => code.split('\n').filter((line) => line.trim() !== '').length;

/** A fresh folder with a project in it. */
export class Project {
  readonly folder: string;
  readonly timings: Record<string, number> = {};
  #server: ChildProcess | undefined;
  #network: Server | undefined;

  constructor(name: string) {
    this.folder = join(root, '.cache', 'newcomer', name);
    rmSync(this.folder, { recursive: true, force: true });
    mkdirSync(this.folder, { recursive: true });
  }

  write(path: string, content: string | Uint8Array): void {
    mkdirSync(dirname(join(this.folder, path)), { recursive: true });
    writeFileSync(join(this.folder, path), content);
  }

  /** The manifest that `npm create vite` writes, with our tarballs, all of them, since no registry has them. */
  manifest(dependencies: Record<string, string>, devDependencies: Record<string, string>): void {
    const tarballs = JSON.parse(process.env['GLANZ_NEWCOMER'] ?? '{}') as Record<string, string>;
    const local = Object.fromEntries(Object.entries(tarballs).map(([name, file]) => [name, `file:${file}`]));
    this.write('package.json', JSON.stringify({ name: 'newcomer', private: true, version: '0.0.0', type: 'module', dependencies: { ...dependencies, ...local }, devDependencies, overrides: local }, undefined, 2));
  }

  async timed<T>(what: string, run: () => Promise<T>): Promise<T> {
    const from = performance.now();
    const result = await run();
    this.timings[what] = performance.now() - from;
    return result;
  }

  /** Runs a program in the project; its output where it fails. */
  run(command: string, args: readonly string[], env: Record<string, string> = {}): Promise<string> {
    return new Promise((resolve, reject) => {
      execFile(command, args, { cwd: this.folder, env: { ...process.env, NODE_OPTIONS: '', ...env }, maxBuffer: 1 << 26 }, (error, stdout, stderr) => (error ? reject(new Error(`${command} ${args.join(' ')}\n${stdout}\n${stderr}`)) : resolve(stdout)));
    });
  }

  install(): Promise<string> {
    return this.timed('npm install', () => this.run('npm', ['install', '--prefer-offline', '--no-audit', '--no-fund', '--loglevel', 'error']));
  }

  vite(...args: string[]): Promise<string> {
    return this.run(process.execPath, [join('node_modules', 'vite', 'bin', 'vite.js'), ...args]);
  }

  next(...args: string[]): Promise<string> {
    return this.run(process.execPath, [NEXT, ...args], { NEXT_TELEMETRY_DISABLED: '1' });
  }

  /** Starts the server of a finished Next.js build. @returns Its address. */
  serveNext(): Promise<string> {
    return this.#start([NEXT, 'start', '--hostname', '127.0.0.1', '--port', '0'], { NEXT_TELEMETRY_DISABLED: '1' });
  }

  /** Serves files of an installed package to pages of any origin, as a content delivery network does. @returns Its address. */
  async network(packageName: string): Promise<string> {
    const types: Record<string, string> = { '.js': 'text/javascript', '.glb': 'model/gltf-binary' };
    const server = createServer((request, response) => {
      const path = new URL(request.url ?? '/', 'http://localhost').pathname;
      const file = join(this.folder, 'node_modules', packageName, path);
      const found = !path.includes('..') && existsSync(file);
      response.writeHead(found ? 200 : 404, { 'access-control-allow-origin': '*', 'content-type': types[extname(file)] ?? 'text/plain' });
      response.end(found ? readFileSync(file) : '');
    });
    this.#network = server;
    await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
    return `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
  }

  /** Starts a server of Vite's. @returns Its address. */
  serve(...args: string[]): Promise<string> {
    return this.#start([join('node_modules', 'vite', 'bin', 'vite.js'), ...args, '--host', '127.0.0.1']);
  }

  /** Starts a server, a program of Node's that prints its address. */
  #start(args: readonly string[], env: Record<string, string> = {}): Promise<string> {
    const child = (this.#server = spawn(process.execPath, args, { cwd: this.folder, stdio: ['ignore', 'pipe', 'pipe'], env: { ...process.env, ...env } }));
    return new Promise((resolve, reject) => {
      let printed = '';
      const hear = (data: Buffer) => {
        // Without the colours.
        printed += data.toString().replaceAll(new RegExp(`${String.fromCharCode(27)}\\[[0-9;]*m`, 'g'), '');
        const address = /http:\/\/127\.0\.0\.1:\d+/.exec(printed)?.[0];
        if (address) resolve(address);
      };
      child.stdout.on('data', hear);
      child.stderr.on('data', hear);
      child.on('close', (code) => reject(new Error(`${args.join(' ')} ended with ${code}:\n${printed}`)));
    });
  }

  stop(): void {
    this.#server?.removeAllListeners('close');
    this.#server?.kill();
    this.#server = undefined;
    this.#network?.close();
    this.#network = undefined;
  }
}
