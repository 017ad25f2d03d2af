/** What can go wrong with a call to the GPU. */
export type Fault = 'lost-unknown' | 'lost-destroyed' | 'out-of-memory' | 'validation' | 'compile' | 'map' | 'late';

/** Every {@link Fault}. */
export const FAULTS: readonly Fault[] = [
  'lost-unknown',
  'lost-destroyed',
  'out-of-memory',
  'validation',
  'compile',
  'map',
  'late',
];

/** How much later a late GPU answers, in milliseconds. */
export const LATE_MS = 2000;

/** One call to the GPU that can be made to fail. */
export interface FaultPoint {
  /**
   * Call, label of what it makes or works on, number among the same calls of its phase, and phase:
   * `createBuffer "glanz nodes" #1 in create`.
   */
  readonly name: string;
  readonly call: string;
  readonly label: string;
  readonly phase: string;
  /** Number among the calls with the same name, label and phase, from 1. */
  readonly number: number;
}

/** A GPU object that has been made and not been destroyed. */
export interface LiveObject {
  readonly kind: 'buffer' | 'texture' | 'querySet';
  readonly label: string;
  readonly bytes: number;
}

const CREATES_MEMORY = /^create(Buffer|Texture|QuerySet)$/;
const CREATES_PIPELINE = /^create(Compute|Render)Pipeline(Async)?$/;
const CAN_BE_INVALID =
  /^(create(Buffer|Texture|BindGroup|BindGroupLayout|PipelineLayout|Sampler|QuerySet)|submit|writeBuffer|writeTexture|copyExternalImageToTexture)$/;
const ANSWERS = /(Async|onSubmittedWorkDone|popErrorScope)$/;

/** The faults that a call can meet, in the order of {@link FAULTS}. */
export function faultsOf({ call }: Pick<FaultPoint, 'call'>): Fault[] {
  return FAULTS.filter((fault) => {
    if (fault === 'out-of-memory') return CREATES_MEMORY.test(call);
    if (fault === 'validation') return CAN_BE_INVALID.test(call);
    if (fault === 'compile') return CREATES_PIPELINE.test(call) || call === 'createShaderModule';
    if (fault === 'map') return call === 'mapAsync';
    if (fault === 'late') return ANSWERS.test(call);
    return true;
  });
}

/**
 * Counts the calls to instrumented devices by phase, and says when the planned one has come. One recorder serves any
 * number of devices.
 */
export class FaultRecorder {
  readonly #counts = new Map<string, number>();
  #phase = 'start';
  #plan: { readonly point: string; readonly fault: Fault } | undefined;
  /** All calls since the last {@link clear}, in order. */
  readonly points: FaultPoint[] = [];
  /** GPU objects that have been made through instrumented devices and not been destroyed. */
  readonly live = new Map<object, LiveObject>();
  /** Errors that no scope has caught and no listener has handled, injected or real. */
  readonly uncaptured: string[] = [];
  /** The point at which the fault was injected. */
  struck: FaultPoint | undefined;

  /** Calls from now on belong to this phase. */
  set phase(name: string) {
    this.#phase = name;
  }

  get phase(): string {
    return this.#phase;
  }

  /** Forgets all calls, and plans a fault, if any. Live objects stay. */
  clear(plan?: { readonly point: string; readonly fault: Fault }): void {
    this.#counts.clear();
    this.points.length = 0;
    this.uncaptured.length = 0;
    this.struck = undefined;
    this.#plan = plan;
  }

  /** Counts a call. Returns the fault that it is to meet. */
  count(call: string, label: string): Fault | undefined {
    const key = `${call} ${JSON.stringify(label)}`;
    const place = `${key} ${this.#phase}`;
    const number = (this.#counts.get(place) ?? 0) + 1;
    this.#counts.set(place, number);
    const point: FaultPoint = { name: `${key} #${number} in ${this.#phase}`, call, label, phase: this.#phase, number };
    this.points.push(point);
    if (point.name !== this.#plan?.point || this.struck) return undefined;
    this.struck = point;
    return this.#plan.fault;
  }

  /** Bytes of the live objects. */
  get liveBytes(): number {
    let sum = 0;
    for (const { bytes } of this.live.values()) sum += bytes;
    return sum;
  }
}
