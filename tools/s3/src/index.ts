import { createServer, request, type IncomingMessage, type Server, type ServerResponse } from 'node:http';
import type { AddressInfo } from 'node:net';
import S3rver from 's3rver';

/** What {@link startS3} has started. */
export interface S3Server {
  /** For `--s3-endpoint`. */
  readonly endpoint: string;
  /** What a process needs in its environment to be let in. */
  readonly env: Readonly<Record<string, string>>;
  /** Requests since the start: method and path, `PUT /bucket/key`. */
  readonly requests: readonly string[];
  /** Called with each request that has a body; the number of its bytes after which the connection is cut. */
  cut: (request: string) => number | undefined;
  stop(): Promise<void>;
}

const failed = (code: string) => `<?xml version="1.0" encoding="UTF-8"?><Error><Code>${code}</Code></Error>`;

/**
 * Starts a server of S3's protocol on loopback: the package s3rver behind a proxy, which records requests, cuts
 * connections, and adds the condition `If-None-Match: *` of uploads, which s3rver does not know.
 *
 * @param directory For its objects.
 * @param bucket The one that it has.
 */
export async function startS3(directory: string, bucket: string): Promise<S3Server> {
  const inner = new S3rver({
    port: 0,
    address: '127.0.0.1',
    silent: true,
    directory,
    configureBuckets: [{ name: bucket }],
  });
  const { port } = await inner.run();
  const requests: string[] = [];
  const written = new Set<string>();
  const state: S3Server = {
    endpoint: '',
    env: {
      AWS_ACCESS_KEY_ID: 'S3RVER',
      AWS_SECRET_ACCESS_KEY: 'S3RVER',
      AWS_REGION: 'us-east-1',
      AWS_EC2_METADATA_DISABLED: 'true',
    },
    requests,
    cut: () => undefined,
    async stop() {
      proxy.closeAllConnections();
      await new Promise((done) => proxy.close(done));
      await inner.close();
    },
  };
  const proxy = createServer((incoming, outgoing) => {
    const { method = '', url = '', headers } = incoming;
    const path = url.replace(/\?.*$/, '');
    requests.push(`${method} ${url}`);
    if (method === 'PUT' && headers['if-none-match'] === '*' && written.has(path)) {
      incoming.resume();
      incoming.on('end', () => outgoing.writeHead(412).end(failed('PreconditionFailed')));
      return;
    }
    // From its beginning on, so that of two at the same moment the later one is refused.
    if (method === 'PUT') written.add(path);
    if (method === 'DELETE') written.delete(path);
    const cutAt = state.cut(`${method} ${url}`);
    if (cutAt !== undefined) written.delete(path);
    forward(incoming, outgoing, port, cutAt);
  });
  await listening(proxy);
  return Object.assign(state, { endpoint: `http://127.0.0.1:${(proxy.address() as AddressInfo).port}` });
}

const listening = (server: Server) => new Promise<void>((done) => server.listen(0, '127.0.0.1', done));

/** @param cutAt After so many bytes of the body both connections are cut. */
function forward(incoming: IncomingMessage, outgoing: ServerResponse, port: number, cutAt: number | undefined): void {
  const { method, url, headers } = incoming;
  const upstream = request({ host: '127.0.0.1', port, method, path: url, headers }, (answer) => {
    outgoing.writeHead(answer.statusCode ?? 500, answer.headers);
    answer.pipe(outgoing);
  });
  upstream.on('error', () => outgoing.destroy());
  outgoing.on('close', () => upstream.destroy());
  if (cutAt === undefined) {
    incoming.pipe(upstream);
    return;
  }
  let bytes = 0;
  incoming.on('data', (chunk: Buffer) => {
    bytes += chunk.length;
    if (bytes < cutAt) return void upstream.write(chunk);
    upstream.destroy();
    incoming.destroy();
  });
}
