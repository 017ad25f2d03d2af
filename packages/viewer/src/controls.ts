/** Camera commands of pointers and keys. */
export interface CameraCommands {
  /** Radians, to the right and up around the model. */
  orbit(yaw: number, pitch: number): void;
  /** Heights of the image. */
  pan(right: number, up: number): void;
  /** Factor; above 1 moves closer. */
  zoom(factor: number): void;
  /** Back to the first view. */
  home(): void;
  /** A click or tap without a drag; CSS pixels from the element's upper left corner. */
  pick(x: number, y: number): void;
  /** A double click, a double tap or the key F: make the point there the target; CSS pixels. */
  focus(x: number, y: number): void;
}

/** Which movements users may make. */
export interface ControlOptions {
  /** Drag, one finger, arrows. Default true. */
  readonly orbit?: boolean;
  /** Shift, middle or right button, two fingers, Shift and arrows. Default true. */
  readonly pan?: boolean;
  /** Wheel, pinch, plus and minus. Default true. */
  readonly zoom?: boolean;
  /** Double click, double tap, F; `pointer` leaves the key alone. Default true. */
  readonly focus?: boolean | 'pointer';
  /** Factor of how far a movement of the pointer or a key orbits, above 0. Default 1. */
  readonly orbitSensitivity?: number;
  /** The same for panning. Default 1. */
  readonly panSensitivity?: number;
  /** The same for zooming. Default 1. */
  readonly zoomSensitivity?: number;
}

/** Commands that movements are scaled for. */
function sensitive(
  { orbit, pan, zoom, ...others }: CameraCommands,
  { orbitSensitivity: o = 1, panSensitivity: p = 1, zoomSensitivity: z = 1 }: ControlOptions,
): CameraCommands {
  return {
    ...others,
    orbit: (yaw, pitch) => orbit(yaw * o, pitch * o),
    pan: (right, up) => pan(right * p, up * p),
    zoom: (factor) => zoom(factor ** z),
  };
}

/** Radians of orbit for a drag over the whole height. */
const DRAG_TURN = Math.PI;
/** Radians, heights and factor of one key press. */
/** Pixels per unit of a wheel event: of pixels, lines and pages. */
const WHEEL_PIXELS = [1, 16, 400];
const KEY = { turn: Math.PI / 24, pan: 0.05, zoom: 1.12 } as const;
/** A press that moves less is a click. */
const CLICK_PIXELS = 4;
/** Fingers are less exact. */
const TAP_PIXELS = 10;
/** Two taps within so many milliseconds are a double tap. */
const DOUBLE_TAP_MS = 320;

interface Point {
  x: number;
  y: number;
}

const distance = (a: Point, b: Point) => Math.hypot(a.x - b.x, a.y - b.y);

/**
 * Pointer, touch, wheel and keyboard on an element: drag to orbit; Shift, middle or right button to pan; wheel to zoom;
 * two fingers pan and pinch; double click or F to make the point there the target; arrow keys orbit, Shift and arrow
 * keys pan, + and − zoom, 0 or Home resets the view; Enter picks the centre.
 *
 * @returns A function that removes the listeners.
 */
export function controlCamera(
  element: HTMLElement,
  commanded: CameraCommands,
  options: ControlOptions = {},
): () => void {
  const commands = sensitive(commanded, options);
  const { orbit = true, pan: panning = true, zoom = true, focus = true } = options;
  const listeners = new AbortController();
  const { signal } = listeners;
  const pointers = new Map<number, Point>();
  let start: (Point & { readonly pan: boolean }) | undefined;
  let moved = false;
  let lastTap: (Point & { readonly time: number }) | undefined;
  let hover: Point | undefined;
  // Not offsetX: with a pointer captured, a browser may give it relative to what lies under the finger.
  const at = (event: MouseEvent): Point => {
    const box = element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const height = () => Math.max(1, element.clientHeight);

  const drag = (from: Point, to: Point, pan: boolean) => {
    const [dx, dy] = [(to.x - from.x) / height(), (to.y - from.y) / height()];
    if (pan) {
      if (panning) commands.pan(-dx, dy);
    } else if (orbit) commands.orbit(-dx * DRAG_TURN, dy * DRAG_TURN);
  };

  const on = <K extends keyof HTMLElementEventMap>(
    type: K,
    listener: (event: HTMLElementEventMap[K]) => void,
    options?: AddEventListenerOptions,
  ) => element.addEventListener(type, listener, { signal, ...options });

  on('pointerdown', (event) => {
    // A synthetic pointer cannot be captured; a real one always can.
    if (event.isTrusted) element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, at(event));
    moved = pointers.size > 1;
    start = { ...at(event), pan: event.button !== 0 || event.shiftKey };
  });
  on('pointermove', (event) => {
    hover = at(event);
    const from = pointers.get(event.pointerId);
    if (!from || !start) return;
    const to = at(event);
    if (!moved && distance(to, start) < (event.pointerType === 'touch' ? TAP_PIXELS : CLICK_PIXELS)) return;
    moved = true;
    if (pointers.size === 1) drag(from, to, start.pan);
    else {
      const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1] ?? from;
      const [before, after] = [distance(from, other), distance(to, other)];
      // The middle of two fingers moves half as far as the one that moves.
      drag({ x: from.x / 2, y: from.y / 2 }, { x: to.x / 2, y: to.y / 2 }, true);
      if (zoom && before > 8 && after > 8) commands.zoom(after / before);
    }
    pointers.set(event.pointerId, to);
  });
  on('pointerleave', () => void (hover = undefined));
  const release = (event: PointerEvent) => {
    if (!pointers.delete(event.pointerId) || event.type !== 'pointerup' || moved || event.button !== 0) return;
    const point = at(event);
    const { x, y } = point;
    if (event.pointerType === 'touch' && focus) {
      const again =
        lastTap && event.timeStamp - lastTap.time < DOUBLE_TAP_MS && distance(point, lastTap) < 4 * TAP_PIXELS;
      lastTap = again ? undefined : { ...point, time: event.timeStamp };
      if (again) return commands.focus(x, y);
    }
    commands.pick(x, y);
  };
  on('pointerup', release);
  on('pointercancel', release);
  on('contextmenu', (event) => panning && event.preventDefault());
  if (focus) {
    on('dblclick', (event) => {
      const { x, y } = at(event);
      commands.focus(x, y);
    });
  }
  if (zoom) {
    on(
      'wheel',
      (event) => {
        event.preventDefault();
        const pixels = event.deltaY * (WHEEL_PIXELS[event.deltaMode] as number);
        commands.zoom(Math.exp(-Math.max(-240, Math.min(240, pixels)) * (event.ctrlKey ? 0.01 : 0.0015)));
      },
      { passive: false },
    );
  }
  on('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const middle = { x: element.clientWidth / 2, y: element.clientHeight / 2 };
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (arrow) {
      const [x, y] = arrow as [number, number];
      if (event.shiftKey && panning) commands.pan(x * KEY.pan, y * KEY.pan);
      else if (!event.shiftKey && orbit) commands.orbit(x * KEY.turn, y * KEY.turn);
      else return;
    } else if (zoom && (event.key === '+' || event.key === '=')) commands.zoom(KEY.zoom);
    else if (zoom && (event.key === '-' || event.key === '_')) commands.zoom(1 / KEY.zoom);
    else if (event.key === '0' || event.key === 'Home') commands.home();
    else if (event.key === 'Enter') commands.pick(middle.x, middle.y);
    else if (focus === true && /^f$/i.test(event.key)) {
      const { x, y } = hover ?? middle;
      commands.focus(x, y);
    } else return;
    event.preventDefault();
  });
  return () => listeners.abort();
}
