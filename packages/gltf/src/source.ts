import { GltfError } from './error';

/** Reads a file that a document names. `uri` is relative to the document, decoded. */
export type ResourceReader = (uri: string, signal: AbortSignal | undefined) => Promise<Uint8Array<ArrayBuffer>>;

/** The source of a document and of the files it refers to. */
export interface Source {
  /** Name of the document in messages. */
  readonly name: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly read: ResourceReader;
}

/** A glTF document with the files it names, by their paths, for example from a dropped folder. */
export interface GltfFiles {
  readonly files: ReadonlyMap<string, Uint8Array<ArrayBuffer> | Blob>;
  /** Path of the document. Default: the only .gltf or .glb. */
  readonly entry?: string;
}

/** Input of {@link loadGltf}: a URL, the bytes of a file, or files. */
export type GltfInput = string | URL | ArrayBuffer | Uint8Array<ArrayBuffer> | GltfFiles;

/** The error for a file that does not exist. */
export const missing = (uri: string, name: string, cause?: unknown): GltfError =>
  new GltfError(
    'gltf/missing-resource',
    `${name} names the file "${uri}", which is missing: put it beside the document.`,
    { cause, location: { file: name, path: uri } },
  );

const bytesOf = async (file: Uint8Array<ArrayBuffer> | Blob): Promise<Uint8Array<ArrayBuffer>> =>
  file instanceof Uint8Array ? file : new Uint8Array(await file.arrayBuffer());

/** A path without "." and "..", or undefined if it leaves its root. */
function normalized(path: string): string | undefined {
  const parts: string[] = [];
  for (const part of path.replaceAll('\\', '/').split('/')) {
    if (part === '' || part === '.') continue;
    if (part !== '..') parts.push(part);
    else if (parts.pop() === undefined) return undefined;
  }
  return parts.join('/');
}

async function fromFiles({ files, entry }: GltfFiles): Promise<Source> {
  const byPath = new Map([...files].map(([path, file]) => [normalized(path) ?? path, file]));
  const documents = [...byPath.keys()].filter((path) => /\.(glb|gltf)$/i.test(path));
  const name = entry === undefined ? documents[0] : normalized(entry);
  const file = name === undefined ? undefined : byPath.get(name);
  if (name === undefined || !file)
    throw new GltfError(
      'gltf/not-gltf',
      entry === undefined ? 'There is no .gltf or .glb among the files.' : `There is no "${entry}" among the files.`,
    );
  if (entry === undefined && documents.length > 1)
    throw new GltfError(
      'gltf/not-gltf',
      `There are several documents among the files: ${documents.join(', ')}. Choose one.`,
    );
  const folder = name.includes('/') ? name.slice(0, name.lastIndexOf('/') + 1) : '';
  return {
    name,
    bytes: await bytesOf(file),
    read: async (uri) => {
      const path = normalized(folder + uri);
      const found = path === undefined ? undefined : byPath.get(path);
      if (!found) throw missing(uri, name);
      return bytesOf(found);
    },
  };
}

function addressOf(address: string | URL, base: string | URL | undefined): URL {
  if (!URL.canParse(String(address), base))
    throw new GltfError(
      'gltf/missing-resource',
      `"${String(address).slice(0, 200)}" is not a valid URL${base === undefined ? ' on its own: pass a baseUrl, or in Node use loadGltfFile()' : ''}.`,
    );
  return new URL(address, base);
}

/** Percent-decoded text; unchanged if its escapes are invalid. */
export function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Opens any input. `fetch` and `baseUrl` apply to URLs; bytes without a `baseUrl` cannot name other files. */
export async function openSource(
  input: GltfInput,
  options: {
    readonly fetch: typeof globalThis.fetch;
    readonly baseUrl: string | URL | undefined;
    readonly credentials: RequestCredentials | undefined;
    readonly signal: AbortSignal | undefined;
    readonly maxBytes: number;
    readonly onBytes: (done: number) => void;
  },
): Promise<Source> {
  if (typeof input === 'object' && 'files' in input) return fromFiles(input);
  // Called without a receiver: browsers reject fetch as a method of another object.
  const { fetch, credentials, maxBytes, onBytes } = options;
  const get = async (url: URL, uri: string, name: string, signal: AbortSignal | undefined) => {
    let response: Response;
    try {
      response = await fetch(url, { ...(signal ? { signal } : {}), ...(credentials ? { credentials } : {}) });
    } catch (cause) {
      signal?.throwIfAborted();
      throw new GltfError(
        'gltf/missing-resource',
        `${name}: "${uri}" could not be fetched: ${cause instanceof Error ? cause.message : String(cause)}.`,
        { cause, location: { file: name } },
      );
    }
    if (!response.ok)
      throw new GltfError(
        'gltf/missing-resource',
        `${name}: "${uri}" could not be fetched: the server responded with ${response.status} ${response.statusText}.`,
        { location: { file: name } },
      );
    try {
      return await bodyOf(response, uri, name);
    } catch (cause) {
      signal?.throwIfAborted();
      if (cause instanceof GltfError) throw cause;
      throw new GltfError(
        'gltf/missing-resource',
        `${name}: the download of "${uri}" was interrupted: ${cause instanceof Error ? cause.message : String(cause)}.`,
        { cause, location: { file: name } },
      );
    }
  };
  const bodyOf = async (response: Response, uri: string, name: string): Promise<Uint8Array<ArrayBuffer>> => {
    const tooLarge = () =>
      new GltfError(
        'gltf/too-large',
        `${name}: "${uri}" has more than the ${maxBytes} bytes that limits.fileBytes allows.`,
        { location: { file: name } },
      );
    const announced = Number(response.headers.get('content-length') ?? 0);
    if (announced > maxBytes) throw tooLarge();
    if (!response.body) return new Uint8Array(await response.arrayBuffer());
    // Read in chunks to report progress and to stop a server that sends more than the limit.
    const reader = response.body.getReader();
    const pieces: Uint8Array[] = [];
    let length = 0;
    for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
      pieces.push(piece.value);
      length += piece.value.length;
      if (length > maxBytes) {
        void reader.cancel().catch(() => undefined);
        throw tooLarge();
      }
      // For compressed responses, content-length counts the compressed bytes.
      if (announced > 0 && length <= announced) onBytes(length / announced);
    }
    const bytes = new Uint8Array(length);
    let at = 0;
    for (const piece of pieces) {
      bytes.set(piece, at);
      at += piece.length;
    }
    return bytes;
  };
  const relative =
    (base: URL | undefined, name: string): ResourceReader =>
    async (uri, signal) => {
      // Lone surrogates cannot be percent-encoded.
      const path = uri
        .replace(/\p{Surrogate}/gu, '\ufffd')
        .split('/')
        .map(encodeURIComponent)
        .join('/');
      // URLs such as "blob:" and "data:" have no folder.
      if (!base || !URL.canParse(path, base)) throw missing(uri, name);
      const url = new URL(path, base);
      // An untrusted document must not make the host request anything else.
      if (!url.href.startsWith(new URL('.', base).href))
        throw new GltfError(
          'gltf/missing-resource',
          `${name} names "${uri}": only files below the document's own folder are read.`,
          { location: { file: name } },
        );
      return get(url, uri, name, signal);
    };
  const page = typeof location === 'undefined' ? undefined : location.href;
  const base = options.baseUrl === undefined ? undefined : addressOf(options.baseUrl, page);
  if (typeof input === 'string' || input instanceof URL) {
    const url = addressOf(input, base ?? page);
    const name = /^(data|blob):/.test(url.protocol)
      ? 'The glTF file'
      : decoded(url.pathname.slice(url.pathname.lastIndexOf('/') + 1)) || url.href;
    return { name, bytes: await get(url, url.href, name, options.signal), read: relative(url, name) };
  }
  return {
    name: 'The glTF file',
    bytes: input instanceof Uint8Array ? input : new Uint8Array(input),
    read: relative(base, 'The glTF file'),
  };
}
