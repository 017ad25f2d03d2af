import { yieldToEventLoop } from '@glanz/scene';

/**
 * Where a stage's work is done, which decides when it begins.
 * - `foreground`: on this thread, one after another in the order in which they are declared.
 * - `background`: on this thread, one after another, begun while no foreground stage can go on.
 * - `elsewhere`: on other threads or in the driver; begins as soon as its inputs are there, and is not waited for once
 *   the run has failed or was aborted.
 */
export type StagePlace = 'foreground' | 'background' | 'elsewhere';

/** What a stage can use while it runs. */
export interface StageContext {
  /** Aborted when the caller aborts, and when another stage has failed. */
  readonly signal: AbortSignal;
}

/** A named piece of work: what it needs, and the product that it makes of it. */
export interface Stage<Products, Name extends keyof Products = keyof Products, Need extends keyof Products = never> {
  readonly name: Name;
  /** Products of other stages. It begins when all are there. */
  readonly needs: readonly Need[];
  readonly place: StagePlace;
  readonly run: (inputs: Pick<Products, Need>, context: StageContext) => Products[Name] | Promise<Products[Name]>;
  /** Frees the product, if the run as a whole fails or is aborted. */
  readonly release?: ((product: Products[Name]) => void) | undefined;
}

/** A stage of any name and needs, as {@link runStages} takes them. */
export type AnyStage<Products> = Stage<Products, keyof Products, keyof Products>;

/**
 * Makes a function that declares stages: it checks that a stage uses no product that it does not name.
 *
 * @example
 * const stage = stageOf<{ mesh: Mesh; blas: Blas }>();
 * stage({ name: 'blas', needs: ['mesh'], place: 'foreground', run: ({ mesh }) => buildBlas(mesh) });
 */
export const stageOf =
  <Products>() =>
  <Name extends keyof Products, const Need extends keyof Products = never>(
    stage: Stage<Products, Name, Need>,
  ): AnyStage<Products> =>
    stage as unknown as AnyStage<Products>;

/** Options for {@link runStages}. */
export interface RunStagesOptions {
  /** Stops the run; its promise rejects with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  /** Throws if the work has become useless, e.g. on a lost device. Called after each stage. */
  readonly check?: (() => void) | undefined;
}

/** What a run of stages has made, and when: milliseconds of `performance.now()`. */
export interface StageResult<Products> {
  readonly products: Products;
  readonly times: Readonly<Record<keyof Products, { readonly begin: number; readonly end: number }>>;
}

/**
 * Runs stages, each as soon as its inputs and its place allow, until all are done. If one fails, the signal of the
 * others is aborted, those on this thread are waited for, and all products are released, last made first.
 *
 * @param stages In order of urgency; each product is made by one stage.
 * @throws What the first stage to fail throws, what `check` throws, or the signal's reason.
 * @throws {TypeError} If stages wait for each other, or for a product that none makes.
 */
export async function runStages<Products>(
  stages: readonly AnyStage<Products>[],
  { signal: outer, check }: RunStagesOptions = {},
): Promise<StageResult<Products>> {
  type Name = keyof Products;
  outer?.throwIfAborted();
  const inner = new AbortController();
  const products: Partial<Products> = {};
  const made: AnyStage<Products>[] = [];
  const times = {} as Record<Name, { begin: number; end: number }>;
  const waiting = new Set(stages);
  const running = new Map<AnyStage<Products>, Promise<void>>();
  let failure: { readonly error: unknown } | undefined;
  const fail = (error: unknown) => {
    failure ??= { error };
    inner.abort(error);
  };
  const onAbort = () => fail(outer?.reason);
  outer?.addEventListener('abort', onAbort, { once: true });

  const run = async (stage: AnyStage<Products>) => {
    const { name, release } = stage;
    const begin = performance.now();
    try {
      const product = await stage.run(products as Products, { signal: inner.signal });
      // Too late for the run, which no longer waits for this stage: nothing else would free it.
      if (failure && stage.place === 'elsewhere') return release?.(product);
      products[name] = product;
      made.push(stage);
      times[name] = { begin, end: performance.now() };
      check?.();
      // Others on this thread have their turn; what was aborted meanwhile ends here.
      if (stage.place !== 'elsewhere') await yieldToEventLoop();
      outer?.throwIfAborted();
    } catch (error) {
      fail(error);
    }
  };
  const isReady = ({ needs }: AnyStage<Products>) => needs.every((need) => need in products);
  const isBusy = (place: StagePlace) => [...running.keys()].some((stage) => stage.place === place);
  const begin = (stage: AnyStage<Products>) => {
    waiting.delete(stage);
    running.set(
      stage,
      run(stage).finally(() => running.delete(stage)),
    );
  };
  /** Begins the first stage of a place that is ready, unless one of that place is at work. */
  const beginNext = (place: StagePlace) => {
    const next = isBusy(place) ? undefined : [...waiting].find((stage) => stage.place === place && isReady(stage));
    if (next) begin(next);
  };

  const aborted = new Promise<void>((resolve) =>
    inner.signal.addEventListener('abort', () => resolve(), { once: true }),
  );
  try {
    while (!failure && waiting.size + running.size > 0) {
      for (const stage of waiting) if (stage.place === 'elsewhere' && isReady(stage)) begin(stage);
      beginNext('foreground');
      if (!isBusy('foreground')) beginNext('background');
      if (running.size === 0) {
        const names = [...waiting].map(({ name }) => String(name)).join(', ');
        throw new TypeError(`The stages ${names} wait for each other, or for what no stage makes.`);
      }
      await Promise.race([aborted, ...running.values()]);
    }
    if (failure) throw failure.error;
    return { products: products as Products, times };
  } catch (error) {
    fail(error);
    await Promise.all([...running].flatMap(([{ place }, done]) => (place === 'elsewhere' ? [] : [done])));
    for (const { name, release } of made.reverse()) release?.(products[name] as Products[Name]);
    throw error;
  } finally {
    outer?.removeEventListener('abort', onAbort);
  }
}
