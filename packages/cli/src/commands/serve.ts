import { createReadStream } from 'node:fs';
import { realpath, stat } from 'node:fs/promises';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { acceptsHost, type StatusServer } from '@glanz/farm';
import { CliError, EXIT } from '../errors';
import type { CliIo } from '../io';
import type { ReportOptions } from '../options';
import { jsonLine, visible } from '../visible';

/** `glanz serve`. */
export interface ServeCommand extends ReportOptions {
  readonly kind: 'serve';
  readonly port: number;
  readonly host: string;
}

const usage = (message: string) => new CliError('cli/usage', message);

/**
 * Reads the arguments behind `serve`.
 * @throws {CliError} `cli/usage`
 */
export function parseServe(argv: readonly string[]): ServeCommand {
  let parsed;
  try {
    parsed = parseArgs({
      args: [...argv],
      allowPositionals: true,
      strict: true,
      options: {
        port: { type: 'string' },
        host: { type: 'string' },
        json: { type: 'boolean' },
        quiet: { type: 'boolean', short: 'q' },
      },
    });
  } catch (cause) {
    throw usage(`${((cause as Error).message.split('\n')[0] as string).replace(/\.?$/, '.')} See glanz help serve.`);
  }
  const { values, positionals } = parsed;
  if (positionals.length > 0)
    throw usage(
      `glanz serve takes no files: unexpected argument "${positionals[0]}". Models are dropped onto the page.`,
    );
  const port = values.port === undefined ? 4173 : Number(values.port);
  if (!(Number.isInteger(port) && port >= 0 && port <= 65535))
    throw usage(`--port must be a whole number from 0 (any that is free) to 65535, not "${values.port}".`);
  return {
    kind: 'serve',
    json: values.json ?? false,
    quiet: values.quiet ?? false,
    port,
    host: values.host ?? '127.0.0.1',
  };
}

const TYPES: Readonly<Record<string, string>> = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.json': 'application/json',
  '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
  '.jpg': 'image/jpeg',
  '.webp': 'image/webp',
  '.ico': 'image/x-icon',
  '.woff2': 'font/woff2',
};

/** The playground as the package brings it along. */
const builtIn = () => fileURLToPath(new URL('./playground/', import.meta.url));

/** A server of the files of a folder, and of nothing else. */
export function fileServer(folder: string): Server {
  const server = createServer((request, response) => {
    const answer = async () => {
      const text = (code: number, body: string) =>
        void response.writeHead(code, { 'content-type': 'text/plain; charset=utf-8' }).end(body);
      if (!acceptsHost(request, server.address())) return text(403, 'This server answers to localhost only.');
      if (request.method !== 'GET' && request.method !== 'HEAD') return text(405, 'Only GET and HEAD.');
      let path: string;
      try {
        path = decodeURIComponent(new URL(request.url ?? '/', 'http://localhost').pathname);
      } catch {
        return text(400, 'No address.');
      }
      const root = await realpath(folder);
      const file = await realpath(join(root, path.endsWith('/') ? `${path}index.html` : path)).catch(() => undefined);
      const found =
        file !== undefined && file.startsWith(root.endsWith(sep) ? root : root + sep) && !path.includes('\0')
          ? await stat(file)
          : undefined;
      if (!found?.isFile()) return text(404, 'There is no such file.');
      response.writeHead(200, {
        'content-type': TYPES[extname(file as string).toLowerCase()] ?? 'application/octet-stream',
        'content-length': found.size,
        'cache-control': 'no-cache',
        'x-content-type-options': 'nosniff',
      });
      if (request.method === 'HEAD') return void response.end();
      createReadStream(file as string)
        .on('error', () => response.destroy())
        .pipe(response);
    };
    answer().catch(() => response.destroy());
  });
  return server;
}

/** Listens, on any free port for 0. @throws {CliError} `cli/port` */
async function listen(server: StatusServer, port: number, host: string): Promise<void> {
  await new Promise<void>((done, fail) => {
    server.once('error', (cause: NodeJS.ErrnoException) =>
      fail(
        new CliError(
          'cli/port',
          `Port ${port} of ${host} cannot be used: ${cause.code === 'EADDRINUSE' ? 'another program uses it' : cause.message}; try --port 0.`,
          { cause },
        ),
      ),
    );
    server.listen(port, host, done);
  });
}

/**
 * Listens, says where, and ends with Ctrl-C. Gives the exit code.
 * @throws {CliError} where it cannot listen.
 */
export async function serveUntilInterrupt(
  server: StatusServer,
  { port, host, json, quiet }: ReportOptions & Pick<ServeCommand, 'port' | 'host'>,
  io: CliIo,
): Promise<number> {
  await listen(server, port, host);
  const { port: actual } = server.address() as AddressInfo;
  const url = `http://${host.includes(':') ? `[${host}]` : host}:${actual}/`;
  if (json) io.stdout(jsonLine({ ok: true, url }));
  else if (!quiet) io.stderr(`${visible(url)} — Ctrl-C exits\n`);
  await new Promise<void>((done) => {
    const stop = io.onInterrupt(() => {
      stop();
      done();
    });
  });
  server.closeAllConnections();
  await new Promise<void>((done) => server.close(() => done()));
  return EXIT.ok;
}

/**
 * `glanz serve`: the playground, from the package itself, until Ctrl-C. Gives the exit code.
 * @param folder What is served; default: the playground.
 */
export async function serveCommand(
  { port, host, json, quiet }: ServeCommand,
  io: CliIo,
  folder: string = builtIn(),
): Promise<number> {
  if (!(await stat(join(folder, 'index.html')).catch(() => undefined)))
    throw new CliError(
      'cli/missing-package',
      'This copy of @glanz/cli lacks the playground: build it (npm run build) or install the package again.',
    );
  return serveUntilInterrupt(fileServer(folder), { port, host, json, quiet }, io);
}
