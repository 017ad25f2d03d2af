import { createReadStream } from 'node:fs';
import { createServer, type ServerResponse } from 'node:http';
import { farmMetrics } from '../metrics';
import type { FarmQueue } from '../queue/farm-queue';
import type { FarmStore } from '../store/store';
import { acceptsHost } from './loopback-host';
import { STATUS_PAGE } from './status-page';
import { Thumbnails } from './thumbnails';

/** Nothing from anywhere else: the page's own style and script, its images and data from this server. */
const POLICY =
  "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/** A server of `node:http`. */
export interface StatusServer {
  listen(port: number, host: string, listening: () => void): unknown;
  once(event: 'error', listener: (error: Error) => void): unknown;
  address(): { readonly port: number } | string | null;
  close(closed?: () => void): unknown;
  closeAllConnections(): void;
}

/** Milliseconds for which an answer is reused: many pages that are open cost as much as one. */
const FRESH_MS = 500;

/**
 * A read-only page about a farm: progress, the images that were finished last, failures with their reasons, workers.
 * Not listening yet. On the loopback address it answers to `localhost` and loopback addresses alone.
 *
 * | address | answers |
 * |---|---|
 * | `/` | the page; it requests nothing from other servers |
 * | `/status.json` | status, the latest results, dead letters |
 * | `/metrics` | Prometheus text |
 * | `/result/ID/N` | the Nth file of a result, `.png` only |
 * | `/thumbnail/ID/N` | the same, small where `thumbnailOf` makes it so |
 *
 * @param thumbnailOf Makes a small PNG of an image file. Default: the page shows the images themselves, small.
 */
export function statusServer(
  queue: FarmQueue,
  store: FarmStore,
  thumbnailOf?: (file: string) => Promise<Uint8Array>,
): StatusServer {
  const thumbnails = thumbnailOf && new Thumbnails(thumbnailOf);
  let cached: { readonly at: number; readonly text: Promise<string> } | undefined;
  const statusText = () => {
    if (!cached || Date.now() - cached.at > FRESH_MS) {
      const text = Promise.all([queue.status(), queue.recent(), queue.deadLetters(50)]).then(
        ([status, recent, deadLetters]) =>
          JSON.stringify({
            status,
            recent: recent.map(({ id, label, seconds, files }) => ({
              id,
              label,
              seconds,
              image: files.findIndex(({ name }) => name.endsWith('.png')),
            })),
            deadLetters,
          }),
      );
      cached = { at: Date.now(), text };
    }
    return cached.text;
  };
  const server = createServer((request, response) => {
    const answer = async (): Promise<void> => {
      if (!acceptsHost(request, server.address()))
        return send(response, 403, 'text/plain', 'This server answers to localhost only.\n');
      if (request.method !== 'GET' && request.method !== 'HEAD')
        return send(response, 405, 'text/plain', 'Only GET.\n');
      const { pathname } = new URL(request.url ?? '/', 'http://localhost');
      if (pathname === '/') return send(response, 200, 'text/html; charset=utf-8', STATUS_PAGE);
      if (pathname === '/status.json') return send(response, 200, 'application/json', await statusText());
      if (pathname === '/metrics')
        return send(response, 200, 'text/plain; version=0.0.4', farmMetrics(await queue.status()));
      const [, kind, id, index] = /^\/(result|thumbnail)\/([0-9a-f]{40})\/(\d{1,3})$/.exec(pathname) ?? [];
      const name = id && (await store.result(id))?.files[Number(index)]?.name;
      if (!id || !name || !/^[\w-]+\.png$/.test(name)) return send(response, 404, 'text/plain', 'Not found.\n');
      const file = await store.resultFile(id, name);
      let small: Uint8Array | undefined;
      if (kind === 'thumbnail' && thumbnails && request.method === 'GET')
        try {
          small = await thumbnails.of(file);
        } catch {
          return send(response, 404, 'text/plain', 'No thumbnail can be made of this image.\n');
        }
      response.writeHead(200, {
        'content-type': 'image/png',
        // A result never changes.
        'cache-control': 'max-age=31536000, immutable',
        'content-security-policy': POLICY,
        'x-content-type-options': 'nosniff',
      });
      if (small || request.method === 'HEAD') return void response.end(small);
      createReadStream(file)
        .on('error', () => response.destroy())
        .pipe(response);
    };
    answer().catch((error: Error) => {
      if (response.headersSent) response.destroy();
      else send(response, 503, 'text/plain; charset=utf-8', `${error.message}\n`);
    });
  });
  return server;
}

function send(response: ServerResponse, code: number, type: string, body: string): void {
  response
    .writeHead(code, {
      'content-type': type,
      'cache-control': 'no-store',
      'content-security-policy': POLICY,
      'x-content-type-options': 'nosniff',
      'referrer-policy': 'no-referrer',
    })
    .end(body);
}
