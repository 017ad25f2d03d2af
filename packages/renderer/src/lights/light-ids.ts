import { hasSize, wordOf } from './light-records';
import type { Light } from '@glanz/scene';
import { LIGHT_ID_FIRST, lightStruct, NONE } from '../storage/layout';

/** Ids that name nothing any more, for each one that does, before all are given out again. */
const STALE = 4;
/** And so many more, which are always allowed. */
const STALE_BASE = 1 << 20;

/**
 * Names of a scene's lights that hold while it is edited, where records in the light table are written and ordered
 * again: what remembers a light from frame to frame, as a reservoir does, remembers its id. An id belongs to a light of
 * the scene, or to a triangle of an instance as long as its mesh has as many triangles, whether it shines at the moment
 * or not. `LIGHT_ID_ENVIRONMENT` is the environment.
 *
 * Records carry their ids, and {@link lightIndex} is the way back.
 */
export class LightIds {
  readonly #first = new Map<string, number>();
  #end = LIGHT_ID_FIRST;
  #generation = 0;

  /** Ids of another generation name nothing: it counts up when ids are given out from the first one on again. */
  get generation(): number {
    return this.#generation;
  }

  /** All ids are below this. */
  get end(): number {
    return this.#end;
  }

  /** Before ids for a table of so many lights are asked for. */
  begin(lights: number): void {
    if (this.#end <= STALE_BASE + STALE * lights) return;
    this.#first.clear();
    this.#end = LIGHT_ID_FIRST;
    this.#generation++;
  }

  /** The first id of an instance's triangles, which have ids one after the other. */
  ofTriangles(instance: number, triangles: number): number {
    return this.#firstOf(`${instance} ${triangles}`, triangles);
  }

  /** The id of a light of the scene. */
  ofLight(light: number): number {
    return this.#firstOf(`light ${light}`, 1);
  }

  #firstOf(source: string, count: number): number {
    let first = this.#first.get(source);
    if (first === undefined) {
      this.#first.set(source, (first = this.#end));
      this.#end += count;
    }
    return first;
  }
}

/** Writes the ids of the scene's lights into their records, which begin with those that have a size. */
export function nameLights(
  records: ArrayBuffer,
  lights: readonly Light[],
  firstArea: number,
  areaCount: number,
  ids: LightIds,
): void {
  const integers = new Uint32Array(records);
  let area = firstArea;
  let other = firstArea + areaCount;
  lights.forEach((light, index) => {
    const record = hasSize(light) ? area++ : other++;
    integers[(record * lightStruct.size) / 4 + wordOf('ids') + 3] = ids.ofLight(index);
  });
}

/**
 * The record of each id below `end`, NONE for those without one.
 *
 * @param end As {@link LightIds.end}.
 */
export function lightIndex(
  { records, count }: { readonly records: ArrayBuffer; readonly count: number },
  end: number,
): Uint32Array<ArrayBuffer> {
  const index = new Uint32Array(end).fill(NONE);
  const integers = new Uint32Array(records);
  for (let record = 0, at = wordOf('ids') + 3; record < count; record++, at += lightStruct.size / 4)
    index[integers[at] as number] = record;
  return index;
}
