import { execFile, spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { basename, dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const NEXT = join('node_modules', 'next', 'dist', 'bin', 'next');
const root = fileURLToPath(new URL('../../../', import.meta.url));

/**
 * A page: a guide of the documentation by its name, or the README of a package by `@glanz/…`; of one section, by its
 * heading.
 */
function textOf(page: string, section?: string): string {
  const path = page.startsWith('@glanz/')
    ? `packages/${page.slice('@glanz/'.length)}/README.md`
    : `apps/docs/guide/${page}.md`;
  const text = readFileSync(join(root, path), 'utf8');
  if (section === undefined) return text;
  const from = text.indexOf(`\n## ${section}\n`);
  if (from < 0) throw new Error(`${path} has no section "${section}".`);
  const to = text.indexOf('\n## ', from + 1);
  return text.slice(from, to < 0 ? undefined : to);
}

/** The first block of a language in a README: what people paste. */
export function quickStart(packageName: string, language: string): string {
  const block = new RegExp(`\`\`\`${language}\n([\\s\\S]*?)\n\`\`\``).exec(textOf(`@glanz/${packageName}`))?.[1];
  if (block === undefined) throw new Error(`packages/${packageName}/README.md has no block of ${language}.`);
  return block;
}

/**
 * A block that names its file, as ```tsx [app/page.tsx] does, or `<<< ../examples/node.ts [render.mjs]`, which shows a
 * file of the repository: what people paste into that file.
 */
export function fileFrom(page: string, path: string, section?: string): string {
  const text = textOf(page, section);
  const name = path.replace(/[.[\]]/g, '\\$&');
  const block = new RegExp(`\`\`\`\\w+ \\[${name}\\]\n([\\s\\S]*?)\n\`\`\``).exec(text)?.[1];
  if (block !== undefined) return `${block}\n`;
  const shown = new RegExp(`^<<< (\\S+) \\[${name}\\]$`, 'm').exec(text)?.[1];
  if (shown === undefined) throw new Error(`${page} has no block for ${path}.`);
  return readFileSync(join(root, 'apps/docs/guide', shown), 'utf8');
}

/** What the newcomer's project stands for, or does by itself: no registry has the packages. */
const BY_ITSELF = /^(npm (install|create|run) |npx create-next-app@|cd )/;

/** Lines of the block of shell commands of a page that contains `has`. */
function shellBlock(page: string, has: string, section?: string): string[] {
  const block = [...textOf(page, section).matchAll(/```sh\n([\s\S]*?)\n```/g)]
    .map(([, lines = '']) => lines)
    .find((lines) => lines.includes(has));
  if (block === undefined) throw new Error(`${page} has no commands with ${has}.`);
  return block.split('\n');
}

/**
 * Shell commands of a page, those of the block that contains `has`, without those that make the project and install.
 */
export const commandsFrom = (page: string, has: string, section?: string): string[] =>
  shellBlock(page, has, section).filter((line) => !BY_ITSELF.test(line));

/** Packages that the block installs. */
export const installedBy = (page: string, has: string, section?: string): string[] =>
  shellBlock(page, has, section).flatMap((line) => /^npm install (.+)$/.exec(line)?.[1]?.split(' ') ?? []);

/** Lines that a user would have to write. */
export const linesOf = (code: string): number => code.split('\n').filter((line) => line.trim() !== '').length;

/** The packed packages, as a manifest asks for them. */
function localTarballs(): Record<string, string> {
  const tarballs = JSON.parse(process.env['GLANZ_NEWCOMER'] ?? '{}') as Record<string, string>;
  return Object.fromEntries(Object.entries(tarballs).map(([name, file]) => [name, `file:${file}`]));
}

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
    const local = localTarballs();
    this.write(
      'package.json',
      JSON.stringify(
        {
          name: 'newcomer',
          private: true,
          version: '0.0.0',
          type: 'module',
          dependencies: { ...dependencies, ...local },
          devDependencies,
          overrides: local,
        },
        undefined,
        2,
      ),
    );
  }

  /**
   * Makes the project by `npm create glanz`, run from the packed package, and lets it ask for our tarballs where it asks
   * for versions that no registry has.
   */
  async create(template: string): Promise<void> {
    const creator = new Project(`create-${template}`);
    creator.manifest({}, {});
    await creator.install();
    rmSync(this.folder, { recursive: true });
    await this.timed('npm create glanz', () =>
      creator.run(join('node_modules', '.bin', 'create-glanz'), [
        join('..', basename(this.folder)),
        '--template',
        template,
      ]),
    );
    const manifest = JSON.parse(readFileSync(join(this.folder, 'package.json'), 'utf8')) as {
      dependencies: Record<string, string>;
    };
    const tarballs = localTarballs();
    for (const name of Object.keys(manifest.dependencies))
      if (tarballs[name] !== undefined) manifest.dependencies[name] = tarballs[name];
    // Overrides of what a project asks for itself must equal it.
    this.write('package.json', JSON.stringify({ ...manifest, overrides: tarballs }, undefined, 2));
  }

  readonly #imports = new Set<string>();

  /**
   * Does what a page says: its files, then, in an installed project, its commands, which install all that the files
   * import.
   */
  paste(page: string, files: readonly string[], section?: string): void {
    for (const file of files) {
      const content = fileFrom(page, file, section);
      this.write(file, content);
      for (const [, name] of content.matchAll(/(?:from|import) '(@glanz\/\w+)/g)) this.#imports.add(name as string);
    }
  }

  async type(page: string, has: string, section?: string): Promise<void> {
    // As the templates have it: browsers ask for an icon by themselves.
    this.write('public/favicon.ico', Buffer.from('R0lGODlhAQABAIAAAAAAAP///yH5BAEAAAAALAAAAAABAAEAAAIBRAA7', 'base64'));
    const lines = commandsFrom(page, has, section);
    if (lines.length === 0) throw new Error(`${page}: nothing is left of the commands with ${has}.`);
    const installed = installedBy(page, has, section);
    const used = [...this.#imports, ...lines.flatMap((line) => /node_modules\/(@glanz\/\w+)/.exec(line)?.[1] ?? [])];
    const missing = used.filter((name) => !installed.includes(name));
    if (missing.length > 0) throw new Error(`${page} does not install ${missing.join(', ')}.`);
    for (const line of lines) await this.run('sh', ['-c', line]);
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
      execFile(
        command,
        args,
        { cwd: this.folder, env: { ...process.env, NODE_OPTIONS: '', ...env }, maxBuffer: 1 << 26 },
        (error, stdout, stderr) =>
          error ? reject(new Error(`${command} ${args.join(' ')}\n${stdout}\n${stderr}`)) : resolve(stdout),
      );
    });
  }

  install(): Promise<string> {
    return this.timed('npm install', () =>
      this.run('npm', ['install', '--prefer-offline', '--no-audit', '--no-fund', '--loglevel', 'error']),
    );
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

  /**
   * Serves files of an installed package to pages of any origin, as a content delivery network does. @returns Its
   * address.
   */
  async network(packageName: string): Promise<string> {
    const types: Record<string, string> = { '.js': 'text/javascript', '.glb': 'model/gltf-binary' };
    const server = createServer((request, response) => {
      const path = new URL(request.url ?? '/', 'http://localhost').pathname;
      const file = join(this.folder, 'node_modules', packageName, path);
      const found = !path.includes('..') && existsSync(file);
      response.writeHead(found ? 200 : 404, {
        'access-control-allow-origin': '*',
        'content-type': types[extname(file)] ?? 'text/plain',
      });
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
    const child = (this.#server = spawn(process.execPath, args, {
      cwd: this.folder,
      stdio: ['ignore', 'pipe', 'pipe'],
      env: { ...process.env, ...env },
    }));
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
