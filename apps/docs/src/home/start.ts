/**
 * Names of adapters that are the CPU, as `isSoftware` of `@glanz/renderer` knows them: the renderer itself is fetched
 * when the viewer starts.
 */
const CPU_NAMES = /swiftshader|llvmpipe|lavapipe|basic render|warp/i;

/** What a browser says about its user's wishes; members that a browser does not have are missing. */
export interface Wishes {
  readonly matchMedia: (query: string) => { readonly matches: boolean };
  readonly navigator: {
    readonly connection?: { readonly saveData?: boolean; readonly effectiveType?: string };
  };
}

/** Whether the user asks for less motion or less data, or has a connection for which the scripts are too large. */
export function asksForLess({ matchMedia, navigator: { connection } }: Wishes): boolean {
  return (
    matchMedia('(prefers-reduced-motion: reduce)').matches ||
    matchMedia('(prefers-reduced-data: reduce)').matches ||
    connection?.saveData === true ||
    /^(slow-2g|2g|3g)$/.test(connection?.effectiveType ?? '')
  );
}

/** Whether there is a GPU that is not the CPU. */
export async function hasHardware(gpu: Pick<GPU, 'requestAdapter'> | undefined): Promise<boolean> {
  const adapter = await gpu?.requestAdapter({ powerPreference: 'high-performance' }).catch(() => null);
  if (!adapter) return false;
  const { isFallbackAdapter, architecture, device, description } = adapter.info;
  return isFallbackAdapter !== true && !CPU_NAMES.test(`${architecture} ${device} ${description}`);
}

/** Resolves when the page has loaded, is visible with the element in its window, and has nothing else to do. */
export async function settled(element: Element, signal: AbortSignal): Promise<void> {
  const once = (target: EventTarget, type: string) =>
    new Promise<void>((resolve) => target.addEventListener(type, () => resolve(), { once: true, signal }));
  if (document.readyState !== 'complete') await once(window, 'load');
  while (document.visibilityState !== 'visible') await once(document, 'visibilitychange');
  await new Promise<void>((resolve) => {
    const observer = new IntersectionObserver((entries) => {
      if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
      observer.disconnect();
      resolve();
    });
    observer.observe(element);
    signal.addEventListener('abort', () => observer.disconnect(), { once: true });
  });
  // Safari has no idle callbacks.
  await new Promise<void>((resolve) => {
    if ('requestIdleCallback' in window) requestIdleCallback(() => resolve());
    else setTimeout(resolve, 200);
  });
}
