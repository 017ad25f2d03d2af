import { useFrame, useThree } from '@react-three/fiber';
import type { ToneMap } from '@glanz/tonemap';
import { useEffect, useImperativeHandle, useRef, useState, type ReactNode, type Ref } from 'react';
import { ThreePathTracer, type ThreePathTracerOptions } from '../three-path-tracer';
import type { ThreeCamera, ThreeObject } from '../types';

/** Props of {@link PathTracer}. */
export interface PathTracerProps {
  /** `false`: the scene is rasterised without sampling; the prepared scene is kept. Default `true`. */
  readonly enabled?: boolean;
  /** Samples after which no more are added. Default 1024. */
  readonly samples?: number;
  /** Samples before the path-traced image covers the rasterised one. Default 1. */
  readonly minSamples?: number;
  /** Width and height of the film, as a share of the canvas's drawing buffer. Above 0. Default 1. */
  readonly renderScale?: number;
  /** Default `neutral`. */
  readonly toneMap?: ToneMap;
  /** Exposure, EV. Default 0. */
  readonly exposure?: number;
  /** Options of the tracer, read when it is made. */
  readonly options?: ThreePathTracerOptions['tracer'];
  /** The device to render on, read when the tracer is created. Default: a new device. */
  readonly device?: GPUDevice;
  /** Called after each sample, with how many there are. */
  readonly onSample?: (samples: number) => void;
  /** Called with errors; the rasterised image is shown then. Default: written to the console. */
  readonly onError?: (error: unknown) => void;
  /** Leads to the tracer, once it is prepared. */
  readonly ref?: Ref<ThreePathTracer | null>;
}

/**
 * Path-traces the scene of a `<Canvas>` of react-three-fiber: follows what changes in it, and covers the canvas with
 * the image while nothing changes. The image is on a canvas of its own above it, which passes pointer events through.
 * `<PathTracer>` can be anywhere among the children.
 *
 * @example
 * <Canvas>
 *   <PathTracer samples={512} toneMap="aces" />
 *   <mesh>
 *     <torusKnotGeometry />
 *     <meshStandardMaterial color="tomato" />
 *   </mesh>
 *   <ambientLight intensity={2} />
 *   <OrbitControls />
 * </Canvas>
 */
export function PathTracer(props: PathTracerProps): ReactNode {
  const { ref, device, exposure, toneMap } = props;
  const { gl, scene, camera } = useThree();
  const run = useRef<Run | null>(null);
  const [tracer, setTracer] = useState<ThreePathTracer | null>(null);
  const latest = useRef(props);
  // After each render: handlers are seldom the same functions twice.
  useEffect(() => void (latest.current = props));
  useImperativeHandle<ThreePathTracer | null, ThreePathTracer | null>(ref, () => tracer, [tracer]);

  useEffect(() => {
    const made = new Run(gl.domElement, latest, device, setTracer);
    run.current = made;
    return () => {
      made.end();
      run.current = null;
      setTracer(null);
    };
  }, [gl, scene, device]);

  useEffect(() => run.current?.setView(), [exposure, toneMap]);

  // Before fiber draws: it goes on rasterising beneath.
  useFrame(() => run.current?.frame(scene as unknown as ThreeObject, camera as unknown as ThreeCamera));
  return null;
}

/** A tracer beneath a component, from when it appears until it disappears. */
class Run {
  tracer: ThreePathTracer | undefined;
  readonly #host: HTMLCanvasElement;
  readonly #canvas: HTMLCanvasElement;
  readonly #props: { readonly current: PathTracerProps };
  readonly #device: GPUDevice | undefined;
  readonly #onTracer: (tracer: ThreePathTracer) => void;
  readonly #ended = new AbortController();
  #state: 'new' | 'busy' | 'ready' | 'failed' = 'new';

  constructor(
    host: HTMLCanvasElement,
    props: { readonly current: PathTracerProps },
    device: GPUDevice | undefined,
    onTracer: (tracer: ThreePathTracer) => void,
  ) {
    this.#host = host;
    this.#props = props;
    this.#device = device;
    this.#onTracer = onTracer;
    this.#canvas = host.ownerDocument.createElement('canvas');
    Object.assign(this.#canvas.style, {
      position: 'absolute',
      inset: '0',
      width: '100%',
      height: '100%',
      pointerEvents: 'none',
      visibility: 'hidden',
    });
    host.parentElement?.append(this.#canvas);
  }

  frame(scene: ThreeObject, camera: ThreeCamera): void {
    const { enabled = true } = this.#props.current;
    if (!enabled) this.#show(false);
    else if (this.#state === 'new') this.#work(() => this.#create(scene, camera));
    else if (this.#state === 'ready') this.#work(() => this.#advance(camera));
  }

  setView(): void {
    const { exposure = 0, toneMap = 'neutral' } = this.#props.current;
    this.tracer?.setView({ exposure, toneMap }).then(() => this.#draw(), this.#fail);
  }

  end(): void {
    this.#ended.abort();
    this.tracer?.destroy();
    this.#canvas.remove();
  }

  /** One piece of work at a time: frames that come meanwhile begin none. */
  #work(work: () => Promise<void>): void {
    this.#state = 'busy';
    work().then(() => void (this.#state = 'ready'), this.#fail);
  }

  readonly #fail = (error: unknown): void => {
    if (this.#ended.signal.aborted) return;
    this.#state = 'failed';
    this.#show(false);
    // oxlint-disable-next-line no-console -- a component has no caller to throw to
    const { onError = (one: unknown) => console.error(one) } = this.#props.current;
    onError(error);
  };

  async #create(scene: ThreeObject, camera: ThreeCamera): Promise<void> {
    const { exposure = 0, toneMap = 'neutral', options } = this.#props.current;
    const [width, height] = this.#size();
    const { signal } = this.#ended;
    const tracer = await ThreePathTracer.create(scene, camera, {
      ...(this.#device ? { device: this.#device } : {}),
      ...(options ? { tracer: options } : {}),
      canvas: this.#canvas,
      width,
      height,
      exposure,
      toneMap,
      signal,
    });
    if (signal.aborted) tracer.destroy();
    signal.throwIfAborted();
    this.tracer = tracer;
    this.#onTracer(tracer);
  }

  async #advance(camera: ThreeCamera): Promise<void> {
    const tracer = this.tracer as ThreePathTracer;
    const { samples = 1024, minSamples = 1, onSample } = this.#props.current;
    tracer.camera = camera;
    const [width, height] = this.#size();
    if (width !== this.#canvas.width || height !== this.#canvas.height) await tracer.resize(width, height);
    await tracer.update();
    const before = tracer.samples;
    // The image of what was there before makes place for the rasterised one.
    this.#show(before > 0 && before >= minSamples);
    if (before >= samples) return;
    const now = await tracer.sample();
    if (this.#ended.signal.aborted) return;
    if (now > 0 && now >= minSamples) {
      this.#draw();
      this.#show(true);
    }
    onSample?.(now);
  }

  #draw(): void {
    if (this.tracer && !this.tracer.destroyed) this.tracer.render();
  }

  #show(visible: boolean): void {
    const { enabled = true } = this.#props.current;
    this.#canvas.style.visibility = visible && enabled ? 'visible' : 'hidden';
  }

  #size(): [number, number] {
    const { renderScale = 1 } = this.#props.current;
    const side = (pixels: number) => Math.max(1, Math.floor(pixels * renderScale));
    return [side(this.#host.width), side(this.#host.height)];
  }
}
