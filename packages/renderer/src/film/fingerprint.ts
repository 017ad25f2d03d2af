import type { Camera, Scene } from '@glanz/scene';
import type { TracerSettings } from '../option-checks';
import { RENDER_OPTIONS, type RenderOptionName } from '../render-options';

/** Words of a large array that are hashed, spread evenly over it. */
const PROBES = 256;

/** FNV-1a over 32-bit words, in two lanes with different primes. */
class Hash {
  #a = 0x811c9dc5;
  #b = 0x9e3779b9;
  readonly #float = new Float64Array(1);
  readonly #words = new Uint32Array(this.#float.buffer);

  word(word: number): void {
    this.#a = Math.imul(this.#a ^ word, 0x01000193);
    this.#b = Math.imul(this.#b ^ (word >>> 3) ^ (word << 7), 0x85ebca6b);
  }

  /** Every `step`th value, as a double. */
  numbers(values: ArrayLike<number>, step = 1): void {
    // In locals: engines allocate a number at each write of a field with more than 31 bits.
    let a = this.#a,
      b = this.#b;
    const float = this.#float,
      words = this.#words;
    for (let i = 0; i < values.length; i += step) {
      float[0] = values[i] as number;
      for (let k = 0; k < 2; k++) {
        const word = words[k] as number;
        a = Math.imul(a ^ word, 0x01000193);
        b = Math.imul(b ^ (word >>> 3) ^ (word << 7), 0x85ebca6b);
      }
    }
    this.#a = a;
    this.#b = b;
  }

  text(text: string): void {
    this.word(text.length);
    for (let i = 0; i < text.length; i++) this.word(text.charCodeAt(i));
  }

  /** Length and {@link PROBES} of the values, which tells models apart without reading all of them. */
  probe(values: ArrayLike<number> | undefined): void {
    this.word(values?.length ?? -1);
    if (values) this.numbers(values, Math.max(1, Math.floor(values.length / PROBES)));
  }

  get value(): string {
    return [this.#a, this.#b].map((lane) => (lane >>> 0).toString(16).padStart(8, '0')).join('');
  }
}

/** The options that decide the value of a sample; the others decide when and where samples are taken. */
const samplingOptions = (options: TracerSettings): unknown[] =>
  Object.entries(RENDER_OPTIONS).flatMap(([name, { effect }]) =>
    effect === 'schedule' || effect === 'layers' ? [] : [options[name as RenderOptionName] ?? null],
  );

/**
 * A hash over what the samples of a film depend on: the options, the camera and the scene (of vertices, texels and
 * pixels only {@link PROBES} of an array are read). Two films with different values must not be continued in each
 * other's place. 64 bits against mistakes, not against malice.
 *
 * @param isCompact Whether its shapes are compact: their normals and tangents are others.
 */
export function filmFingerprint(scene: Scene, camera: Camera, options: TracerSettings, isCompact: boolean): string {
  const hash = new Hash();
  // Films of other shapes keep the fingerprint that they had before there were compact ones.
  if (isCompact) hash.text('compact');
  hash.text(JSON.stringify(samplingOptions(options)));
  hash.text(JSON.stringify({ ...camera, name: '', transform: [] }));
  hash.numbers(camera.transform);
  for (const { positions, normals, uvs, colors, indices } of scene.meshes) {
    for (const values of [positions, normals, ...(uvs ?? []), colors, indices]) hash.probe(values);
  }
  for (const { parameters, ...rest } of scene.materials) hash.text(JSON.stringify([parameters, rest]));
  for (const image of scene.images) {
    const { width, height, bitmap, compressed } = image;
    hash.word(width);
    hash.word(height);
    // Pixels that nobody has asked for yet would be unpacked, which takes time and memory.
    if (!bitmap && !compressed) hash.probe(image.data);
    hash.probe(compressed?.levels[0]);
  }
  hash.text(JSON.stringify(scene.textures));
  hash.text(JSON.stringify(scene.lights));
  const { environment } = scene;
  hash.text(JSON.stringify(environment?.type === 'latlong' ? { ...environment, data: [] } : (environment ?? null)));
  if (environment?.type === 'latlong') hash.probe(environment.data);
  for (const { mesh, material, visible, catcher, transform } of scene.instances) {
    hash.word(mesh);
    hash.word(material);
    hash.word((visible === false ? 1 : 0) | (catcher ? 2 : 0));
    hash.numbers(transform);
  }
  return hash.value;
}
