import { yieldToEventLoop, inSlices, type LatLongEnvironment } from '@glanz/scene';
import { STUDIOS, type SoftBox } from '@glanz/scene/studio';
import { toneMap } from '@glanz/tonemap';
import { watch, type Context } from './context';
import { element } from './elements';
import { colourField, sliderField } from './fields';

const DEGREE = Math.PI / 180;
const TONES = { toneMap: 'neutral', exposure: -0.5 } as const;

/** Rows of an image that are drawn between two stops. */
const ROWS = 8;

/**
 * Draws a small lat-long image so that the front (+Z) is in the middle, a few rows a step; it is seen with the last
 * one.
 *
 * @param requested Whether to continue: another one may have taken its place.
 */
export function* latLongSteps(
  canvas: HTMLCanvasElement,
  { width, height, data }: LatLongEnvironment,
  requested = () => true,
): Generator<void, void> {
  const context = canvas.getContext('2d');
  if (!context) return;
  const image = context.createImageData(canvas.width, canvas.height);
  for (let y = 0; y < canvas.height; y++) {
    if (y % ROWS === 0) yield;
    if (!requested()) return;
    const row = Math.floor(((y + 0.5) / canvas.height) * height);
    for (let x = 0; x < canvas.width; x++) {
      // u = ¾ is +Z; azimuth from there towards +X grows to the right, which is against u.
      const u = (((0.75 - ((x + 0.5) / canvas.width - 0.5)) % 1) + 1) % 1;
      const at = (row * width + Math.floor(u * width)) * 3;
      const rgb = toneMap([data[at] as number, data[at + 1] as number, data[at + 2] as number], TONES);
      const to = (y * canvas.width + x) * 4;
      for (let k = 0; k < 3; k++) image.data[to + k] = 255 * (rgb[k] as number);
      image.data[to + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
}

const radianceOf = ({ radiance }: SoftBox) =>
  typeof radiance === 'number' ? ([radiance, radiance, radiance] as const) : radiance;
const strengthOf = (box: SoftBox) => Math.max(...radianceOf(box), 1e-6);

/** The soft boxes of a studio on a map of all directions: drag them, change them, add and remove some. */
export class SkyEditor {
  readonly element: HTMLElement;
  readonly #context: Context;
  readonly #map = element('div', { class: 'sky' });
  readonly #canvas = element('canvas', { width: 160, height: 80, 'aria-hidden': 'true' });
  readonly #fields = element('div', {});
  #chosen = -1;
  #drawn: LatLongEnvironment | undefined;

  constructor(context: Context) {
    this.#context = context;
    const add = element('button', { type: 'button', id: 'add-box' }, 'Add soft box');
    const remove = element('button', { type: 'button', id: 'remove-box' }, 'Remove');
    add.addEventListener('click', () => {
      const boxes = [
        ...this.#boxes(),
        { azimuth: 20 * DEGREE, elevation: 35 * DEGREE, width: 40 * DEGREE, height: 40 * DEGREE, radiance: 4 },
      ];
      this.#chosen = boxes.length - 1;
      this.#set(boxes, 'Add soft box');
    });
    remove.addEventListener('click', () => {
      const boxes = this.#boxes().filter((_, i) => i !== this.#chosen);
      this.#chosen = -1;
      this.#set(boxes, 'Remove soft box');
    });
    this.#map.append(this.#canvas);
    this.element = element(
      'div',
      { id: 'sky-editor' },
      this.#map,
      element('div', { class: 'row' }, add, remove),
      this.#fields,
    );
    watch(context.store, ['studio', 'boxes', 'environment'], (state) => {
      if (state.environment === 'studio') this.#show();
      remove.disabled = this.#chosen < 0;
    });
  }

  #boxes(): readonly SoftBox[] {
    const { boxes, studio } = this.#context.store.state;
    return boxes ?? (STUDIOS[studio] ?? STUDIOS.neutral).boxes;
  }

  #set(boxes: readonly SoftBox[], label: string): void {
    this.#context.store.set({ boxes }, { label, merge: `${label} ${this.#chosen}` });
  }

  #change(change: Partial<SoftBox>): void {
    this.#set(
      this.#boxes().map((box, i) => (i === this.#chosen ? { ...box, ...change } : box)),
      'Soft box',
    );
  }

  #show(): void {
    const { environments, store, opened } = this.#context;
    const environment = environments.choose({ ...store.state, intensity: 1, rotation: 0 }, opened().scene);
    if (environment?.type === 'latlong' && environment.data !== this.#drawn?.data) {
      this.#drawn = environment;
      // By itself: a model that has just come has other panels to show.
      void yieldToEventLoop().then(() =>
        inSlices(latLongSteps(this.#canvas, environment, () => this.#drawn === environment)),
      );
    }
    const boxes = this.#boxes();
    if (!boxes[this.#chosen]) this.#chosen = -1;
    const handles = [...this.#map.querySelectorAll('button')];
    while (handles.length > boxes.length) handles.pop()?.remove();
    while (handles.length < boxes.length) handles.push(this.#handle(handles.length));
    for (const [i, handle] of handles.entries()) {
      const { azimuth, elevation } = boxes[i] as SoftBox;
      const x = ((((azimuth / (2 * Math.PI) + 0.5) % 1) + 1) % 1) * 100;
      handle.style.left = `${Math.min(97, Math.max(3, x))}%`;
      handle.style.top = `${Math.min(93, Math.max(7, (0.5 - elevation / Math.PI) * 100))}%`;
      handle.setAttribute('aria-pressed', String(i === this.#chosen));
    }
    if (!this.#fields.contains(document.activeElement)) this.#showFields();
  }

  #handle(index: number): HTMLButtonElement {
    const handle = element(
      'button',
      { type: 'button', 'aria-label': `Soft box ${index + 1}; arrow keys move it` },
      String(index + 1),
    );
    this.#map.append(handle);
    const choose = () => {
      this.#chosen = index;
      this.#show();
      this.#showFields();
      this.element.querySelector<HTMLButtonElement>('#remove-box')!.disabled = false;
    };
    handle.addEventListener('click', choose);
    handle.addEventListener('pointerdown', (event) => {
      choose();
      if (event.isTrusted) handle.setPointerCapture(event.pointerId);
    });
    handle.addEventListener('pointermove', (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const { left, top, width, height } = this.#map.getBoundingClientRect();
      const x = Math.min(1, Math.max(0, (event.clientX - left) / width));
      const y = Math.min(1, Math.max(0, (event.clientY - top) / height));
      this.#change({ azimuth: (x - 0.5) * 2 * Math.PI, elevation: (0.5 - y) * Math.PI });
    });
    handle.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      const box = this.#boxes()[index];
      if (!step || !box) return;
      event.preventDefault();
      this.#chosen = index;
      this.#change({
        azimuth: box.azimuth + (step[0] as number) * 5 * DEGREE,
        elevation: Math.max(-89 * DEGREE, Math.min(89 * DEGREE, box.elevation + (step[1] as number) * 5 * DEGREE)),
      });
    });
    return handle;
  }

  #showFields(): void {
    const box = this.#boxes()[this.#chosen];
    if (!box) return this.#fields.replaceChildren();
    const strength = strengthOf(box);
    const tint = radianceOf(box).map((v) => v / strength) as unknown as readonly [number, number, number];
    const now = () => this.#boxes()[this.#chosen] as SoftBox;
    this.#fields.replaceChildren(
      sliderField({
        id: 'box-strength',
        label: 'Radiance',
        value: strength,
        range: [0.05, 40],
        hardRange: [0.001, 10000],
        curve: 3,
        onInput: (v) =>
          this.#change({
            radiance: radianceOf(now()).map((c) => (c / strengthOf(now())) * v) as unknown as readonly [
              number,
              number,
              number,
            ],
          }),
      }).element,
      colourField({
        id: 'box-color',
        label: 'Colour',
        value: tint,
        onInput: (rgb) =>
          this.#change({
            radiance: rgb.map((c) => (c / Math.max(...rgb, 1e-6)) * strengthOf(now())) as unknown as readonly [
              number,
              number,
              number,
            ],
          }),
      }).element,
      sliderField({
        id: 'box-width',
        label: 'Width',
        unit: '°',
        value: box.width / DEGREE,
        range: [2, 150],
        onInput: (v) => this.#change({ width: v * DEGREE }),
      }).element,
      sliderField({
        id: 'box-height',
        label: 'Height',
        unit: '°',
        value: box.height / DEGREE,
        range: [2, 150],
        onInput: (v) => this.#change({ height: v * DEGREE }),
      }).element,
    );
  }
}
