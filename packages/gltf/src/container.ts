import type { SceneWarning } from '@glanz/scene';
import { quote, type Raw } from './json-value';
import { GltfError } from './error';

/** A document extracted from its container. */
export interface Container {
  /** Parsed; only `asset` has been checked. */
  readonly json: Raw;
  /** The binary chunk of a GLB. */
  readonly binary?: Uint8Array<ArrayBuffer>;
}

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BINARY_CHUNK = 0x004e4942;

/**
 * Parses a GLB or a JSON document.
 * @param name Name of the file in messages.
 * @param warnings Receives deviations that do no harm.
 * @throws {GltfError} `gltf/not-gltf`, `gltf/truncated`, `gltf/version`, `gltf/malformed`
 */
export function openContainer(bytes: Uint8Array<ArrayBuffer>, name: string, warnings: SceneWarning[]): Container {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length >= 4 && view.getUint32(0, true) === MAGIC) return openGlb(bytes, view, name, warnings);
  return { json: parseJson(bytes, name, warnings) };
}

function openGlb(bytes: Uint8Array<ArrayBuffer>, view: DataView, name: string, warnings: SceneWarning[]): Container {
  const truncated = (end: number, at: number) =>
    new GltfError(
      'gltf/truncated',
      `${name} ends at byte ${bytes.length}, but byte ${end} should be there: the file is cut off. Download or export it again.`,
      { location: { file: name, byteOffset: at } },
    );
  const malformed = (what: string, at: number) =>
    new GltfError('gltf/malformed', `${name} ${what}; export the file again or repair it.`, {
      location: { file: name, byteOffset: at },
    });
  if (bytes.length < 20) throw truncated(20, bytes.length);
  const version = view.getUint32(4, true);
  if (version !== 2)
    throw new GltfError('gltf/version', `${name} is a GLB of version ${version}; only version 2 is known.`, {
      location: { file: name, byteOffset: 4 },
    });
  const total = view.getUint32(8, true);
  if (total > bytes.length) throw truncated(total, 8);
  if (total < bytes.length)
    warnings.push({
      code: 'gltf/container',
      message: `${name} has ${bytes.length - total} bytes after its end, which are not read.`,
    });
  let json: Raw | undefined;
  let binary: Uint8Array<ArrayBuffer> | undefined;
  let at = 12,
    chunks = 0;
  for (; at + 8 <= total; chunks++) {
    const length = view.getUint32(at, true);
    const type = view.getUint32(at + 4, true);
    if (at + 8 + length > total) throw truncated(at + 8 + length, at);
    if (length % 4 !== 0) throw malformed(`has a chunk of ${length} bytes, which is not a multiple of 4`, at);
    const chunk = bytes.subarray(at + 8, at + 8 + length);
    if (!json && type !== JSON_CHUNK) throw malformed('does not start with a JSON chunk', at);
    if (json && type === JSON_CHUNK) throw malformed('has two JSON chunks', at);
    if (binary && type === BINARY_CHUNK)
      warnings.push({ code: 'gltf/container', message: `${name} has a second binary chunk, which is not read.` });
    if (!json) json = parseJson(chunk, name, warnings);
    else if (type === BINARY_CHUNK && !binary) {
      binary = chunk;
      if (chunks > 1)
        warnings.push({
          code: 'gltf/container',
          message: `${name} has its binary chunk in place ${chunks + 1}, but it must be the second; it is read.`,
        });
    }
    at += 8 + length;
  }
  if (at < total)
    warnings.push({
      code: 'gltf/container',
      message: `${name} has ${total - at} bytes after its last chunk, which are not read.`,
    });
  if (!json)
    throw new GltfError('gltf/malformed', `${name} is a GLB without a JSON chunk.`, { location: { file: name } });
  return binary ? { json, binary } : { json };
}

function parseJson(bytes: Uint8Array, name: string, warnings: SceneWarning[]): Raw {
  let json: unknown;
  // TextDecoder skips the byte order mark.
  if (bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf) {
    warnings.push({
      code: 'gltf/container',
      message: `${name}: its JSON starts with a byte order mark, which glTF does not allow; it is skipped.`,
    });
  }
  try {
    json = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(bytes));
  } catch (cause) {
    throw new GltfError(
      'gltf/not-gltf',
      `${name} is not a glTF file: it is neither a GLB (which starts with "glTF") nor JSON.`,
      { cause, location: { file: name } },
    );
  }
  if (
    typeof json !== 'object' ||
    json === null ||
    !('asset' in json) ||
    typeof json.asset !== 'object' ||
    json.asset === null
  ) {
    throw new GltfError('gltf/not-gltf', `${name} is JSON, but not a glTF document: it has no "asset".`, {
      location: { file: name },
    });
  }
  const { version, minVersion } = json.asset as { version?: unknown; minVersion?: unknown };
  const minor = (value: unknown) => (typeof value === 'string' ? Number(/^2\.(\d+)$/.exec(value)?.[1] ?? NaN) : NaN);
  const own = minor(version),
    min = minVersion === undefined ? 0 : minor(minVersion);
  if (!(own >= 0) || !(min <= own)) {
    throw new GltfError(
      'gltf/version',
      `${name} is of glTF version ${quote(min <= own ? version : (minVersion ?? version))}; only 2.0 is known.`,
      { location: { file: name, path: '/asset/version' } },
    );
  }
  if (min > 0 || own > 0)
    warnings.push({
      code: 'gltf/version',
      message: `${name} is of glTF version ${String(version)}; it is read as 2.0.`,
      path: '/asset/version',
    });
  return json as unknown as Raw;
}
