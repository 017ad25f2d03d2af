import { type Raw, isObject, quote, own } from '../json-value';
import type { SceneWarning } from '@glanz/scene';
import { GltfError } from '../error';

/** The document, and how checks report errors and warnings. */
export class CheckContext {
  /**
   * Lists that have been validated: doing so for each reference would take quadratic time.
   */
  readonly #lists = new Map<string, readonly Raw[]>();

  constructor(
    readonly json: Raw,
    readonly file: string,
    readonly warnings: SceneWarning[],
  ) {}

  /** @throws {GltfError} always, by default `gltf/malformed`. */
  fail(path: string, what: string, code = 'gltf/malformed'): never {
    throw new GltfError(code, `${this.file}: ${path} ${what}; export the file again or repair it.`, {
      location: { file: this.file, path },
    });
  }

  warn(code: string, path: string, what: string): void {
    this.warnings.push({ code, message: `${this.file}: ${path} ${what}.`, path });
  }

  /** Whether the document declares that it uses an extension. */
  uses(extension: string): boolean {
    const names = own(this.json, 'extensionsUsed');
    return Array.isArray(names) && names.includes(extension);
  }

  /** A top-level array of objects; empty if absent. */
  list(key: string): readonly Raw[] {
    let list = this.#lists.get(key);
    if (!list) {
      const value = own(this.json, key);
      list = value === undefined ? [] : this.objects(value, `/${key}`);
      if (value !== undefined) this.notEmpty(list, `/${key}`);
      this.#lists.set(key, list);
    }
    return list;
  }

  /** Warns of an empty list: the schema of glTF 2.0 requires at least one entry (`minItems`). */
  notEmpty(list: readonly unknown[], path: string): void {
    if (list.length === 0) this.warn('gltf/empty', path, 'is empty, but must have an entry or be left out');
  }

  objects(value: unknown, path: string): readonly Raw[] {
    if (!Array.isArray(value)) this.fail(path, `is ${quote(value)}, but must be an array`);
    value.forEach((entry, index) => {
      if (!isObject(entry)) this.fail(`${path}/${index}`, `is ${quote(entry)}, but must be an object`);
    });
    return value as Raw[];
  }

  /** An object, or undefined if absent. */
  object(owner: Raw, key: string, path: string): Raw | undefined {
    const value = own(owner, key);
    if (value !== undefined && !isObject(value))
      this.fail(`${path}/${key}`, `is ${quote(value)}, but must be an object`);
    return value as Raw | undefined;
  }

  /** An extension's object on an object. */
  extension(owner: Raw, name: string, path: string): Raw | undefined {
    const extensions = this.object(owner, 'extensions', path);
    return extensions && this.object(extensions, name, `${path}/extensions`);
  }

  /** An integer from `low` to `high`; `initial` (if given) if absent. */
  integer(owner: Raw, key: string, path: string, low: number, high: number, initial?: number): number {
    const value = own(owner, key) ?? (Object.hasOwn(owner, key) ? null : initial);
    if (typeof value !== 'number' || !Number.isSafeInteger(value) || value < low || value > high) {
      this.fail(
        `${path}/${key}`,
        `is ${quote(value)}, but must be a whole number ${high >= Number.MAX_SAFE_INTEGER ? `of at least ${low}` : `from ${low} to ${high}`}`,
      );
    }
    return value;
  }

  /** An index into a list, or undefined if absent. */
  index(owner: Raw, key: string, path: string, list: readonly unknown[], kind: string): number | undefined {
    if (!Object.hasOwn(owner, key)) return undefined;
    this.reference(owner[key], `${path}/${key}`, list, kind);
    return owner[key] as number;
  }

  reference(value: unknown, path: string, list: readonly unknown[], kind: string): asserts value is number {
    if (typeof value !== 'number' || !Number.isInteger(value) || value < 0 || value >= list.length)
      this.fail(path, `is ${quote(value)}, which names no ${kind} (the file has ${list.length})`);
  }

  /** An array of indices without repetitions; empty if absent. */
  indices(owner: Raw, key: string, path: string, list: readonly unknown[], kind: string): readonly number[] {
    const value = own(owner, key);
    if (value === undefined) return [];
    if (!Array.isArray(value)) this.fail(`${path}/${key}`, `is ${quote(value)}, but must be an array`);
    value.forEach((entry, at) => this.reference(entry, `${path}/${key}/${at}`, list, kind));
    if (new Set(value).size !== value.length) this.fail(`${path}/${key}`, `names a ${kind} twice`);
    this.notEmpty(value, `${path}/${key}`);
    return value as number[];
  }
}
