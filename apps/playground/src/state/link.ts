import { readFields } from './link-fields';
import { initialState, type State } from './state';

/** What a link holds beside the state. */
export interface LinkContent {
  /** Name of a sample, or of the file that the edits belong to. */
  readonly model: string;
  readonly state: Partial<State>;
  /** Files that the image is made with and that the link cannot hold, besides the model. */
  readonly files?: LinkFiles;
}

/** See {@link LinkContent.files}. */
export interface LinkFiles {
  /** Name of the file that lights the scene. */
  readonly environment?: string;
  /** How many images of materials were replaced or taken away. */
  readonly images?: number;
}

/** The format of links; others are not read. */
const VERSION = 'v1.';
/** A link longer than this is broken by some programs that pass it on. */
export const LONGEST_LINK = 8000;
/** Images do not fit into an address. Neither does the file that lights the scene: the link names it. */
const LEFT_OUT: readonly (keyof State)[] = ['slots', 'layer'];

const equal = (a: unknown, b: unknown) => JSON.stringify(a) === JSON.stringify(b);
/** Six digits are more than a slider gives. */
const rounded = (_: string, value: unknown) =>
  typeof value === 'number' && Number.isFinite(value) ? Number(value.toPrecision(6)) : value;

/** The fields in which a state differs from what an image begins with. */
export function difference(state: State): Partial<State> {
  const initial = initialState(state.environment);
  // The environment itself is what samples differ in.
  const names = (Object.keys(initial) as (keyof State)[]).filter(
    (name) => !LEFT_OUT.includes(name) && (name === 'environment' || !equal(state[name], initial[name])),
  );
  return Object.fromEntries(names.map((name) => [name, state[name]])) as Partial<State>;
}

/**
 * What a link to a state of a model holds. @param environment Name of the file that lights the scene where the state
 * says so.
 */
export function linkContent(model: string, state: State, environment: string): LinkContent {
  const images = Object.keys(state.slots).length;
  const files: LinkFiles = {
    ...(state.environment === 'file' && environment ? { environment } : {}),
    ...(images > 0 ? { images } : {}),
  };
  return { model, state: difference(state), ...(Object.keys(files).length > 0 ? { files } : {}) };
}

async function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream): Promise<Uint8Array<ArrayBuffer>> {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

/** The part of an address behind `#`: versioned, deflated JSON in the alphabet that addresses take. */
export async function encodeLink({ model, state, files }: LinkContent): Promise<string> {
  const json = JSON.stringify({ m: model, s: state, f: files }, rounded);
  const packed = await through(new TextEncoder().encode(json), new CompressionStream('deflate-raw'));
  const text = btoa(Array.from(packed, (byte) => String.fromCharCode(byte)).join(''));
  return VERSION + text.replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

/** Maximum bytes of JSON in a link: a few letters can unpack to gigabytes. */
const MAX_BYTES = 4_194_304;

/** @throws where the bytes are no deflated text, or too long a one. */
async function unpack(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw')).getReader();
  const decoder = new TextDecoder();
  let [text, length] = ['', 0];
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return text + decoder.decode();
    length += value.length;
    if (length > MAX_BYTES) {
      await reader.cancel();
      throw new RangeError('The link holds too much.');
    }
    text += decoder.decode(value, { stream: true });
  }
}

/** Names longer than this are cut: an address comes from anywhere. */
const LONGEST_NAME = 200;

function readFiles(given: unknown): LinkFiles | undefined {
  const { environment, images } = (typeof given === 'object' && given !== null ? given : {}) as {
    environment?: unknown;
    images?: unknown;
  };
  const files: LinkFiles = {
    ...(typeof environment === 'string' ? { environment: environment.slice(0, LONGEST_NAME) } : {}),
    ...(Number.isInteger(images) && (images as number) > 0 ? { images: Math.min(images as number, 1000) } : {}),
  };
  return Object.keys(files).length > 0 ? files : undefined;
}

/** @returns Undefined where the text is no link of this format, or is broken. */
export async function decodeLink(text: string): Promise<LinkContent | undefined> {
  const body = text.replace(/^#/, '');
  if (!body.startsWith(VERSION)) return undefined;
  try {
    const bytes = Uint8Array.from(atob(body.slice(VERSION.length).replaceAll('-', '+').replaceAll('_', '/')), (c) =>
      c.charCodeAt(0),
    );
    const json = JSON.parse(await unpack(bytes)) as { m?: unknown; s?: unknown; f?: unknown };
    if (typeof json.m !== 'string' || typeof json.s !== 'object' || json.s === null) return undefined;
    const files = readFiles(json.f);
    return { model: json.m, state: readFields(json.s as Record<string, unknown>), ...(files ? { files } : {}) };
  } catch {
    return undefined;
  }
}
