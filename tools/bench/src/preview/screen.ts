/** Milliseconds between two frames of a screen. */
export const SCREEN_MS = 1000 / 60;

/** An observer of an element that never changes. */
class Watch {
  observe(): void {}
  unobserve(): void {}
  disconnect(): void {}
}

/** A window with one canvas. */
export interface Screen {
  readonly canvas: HTMLCanvasElement;
  /** Puts the globals of a browser's window back as they were. */
  readonly close: () => void;
}

/**
 * The little of a browser that a viewer needs: a canvas whose images go to a texture, and a screen that has a frame
 * every sixtieth of a second, as one has: a frame that is late waits for the next.
 */
export function makeScreen(gpu: GPU, width: number, height: number): Screen {
  let device: GPUDevice | undefined;
  let texture: GPUTexture | undefined;
  const context = {
    configure: (settings: GPUCanvasConfiguration) => void (device = settings.device),
    unconfigure: () => texture?.destroy(),
    getCurrentTexture: () =>
      (texture ??= (device as GPUDevice).createTexture({ size: [width, height], format: 'bgra8unorm', usage: 0x10 })),
  };
  const canvas = { clientWidth: width, clientHeight: height, width, height, style: {}, getContext: () => context };
  const start = performance.now();
  const timers = new Map<number, NodeJS.Timeout>();
  let frames = 0;
  const globals: Record<string, unknown> = {
    navigator: { gpu: { ...gpu, getPreferredCanvasFormat: () => 'bgra8unorm' }, hardwareConcurrency: 2 },
    document: Object.assign(new EventTarget(), { visibilityState: 'visible' }),
    devicePixelRatio: 1,
    ResizeObserver: Watch,
    IntersectionObserver: Watch,
    matchMedia: () => Object.assign(new EventTarget(), { matches: false }),
    requestAnimationFrame: (frame: (time: number) => void) => {
      const id = ++frames;
      const now = performance.now();
      const next = start + Math.ceil((now - start) / SCREEN_MS + 1e-6) * SCREEN_MS;
      timers.set(
        id,
        setTimeout(
          () => {
            // Timers of Node come a little early; a screen does not.
            while (performance.now() < next);
            frame(next);
          },
          Math.max(0, Math.floor(next - now)),
        ),
      );
      return id;
    },
    cancelAnimationFrame: (id: number) => clearTimeout(timers.get(id)),
  };
  const former = Object.keys(globals).map((name) => [name, Object.getOwnPropertyDescriptor(globalThis, name)] as const);
  for (const [name, value] of Object.entries(globals))
    Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });
  const close = () => {
    for (const [name, descriptor] of former) {
      if (descriptor) Object.defineProperty(globalThis, name, descriptor);
      else delete (globalThis as Record<string, unknown>)[name];
    }
  };
  return { canvas: canvas as unknown as HTMLCanvasElement, close };
}
