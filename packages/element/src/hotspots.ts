import type { Viewer } from '@glanz/viewer';
import { length } from './units';

type Point = readonly [number, number, number];

/** A place on the model with an element that stays there. */
export interface Hotspot {
  /** Metres in the world. */
  readonly position: Point;
  /** Which way the surface faces; `undefined`: any. */
  readonly normal: Point | undefined;
}

/** Where a hotspot is now. */
export interface HotspotView {
  /** CSS pixels from the element's upper left corner. */
  readonly x: number;
  readonly y: number;
  /**
   * Whether it is in the image, its surface faces the camera, and, where occlusion is tested, no surface is in front of
   * it.
   */
  readonly visible: boolean;
}

/** Reads `data-position` or `data-normal`: three numbers, with or without a unit. */
export function readVector(text: string | null | undefined): Point | undefined {
  const parts = (text ?? '')
    .trim()
    .split(/[\s,]+/)
    .map((part) => length(part));
  const numbers = parts.map((part) => (part !== undefined && 'metres' in part ? part.metres : Number.NaN));
  return numbers.length === 3 && numbers.every(Number.isFinite) ? (numbers as unknown as Point) : undefined;
}

/** Where a hotspot is in the viewer's present image. */
export function viewHotspot(
  viewer: Viewer,
  { position, normal }: Hotspot,
  occlusion: boolean,
): HotspotView | undefined {
  const at = viewer.project(position);
  const eye = viewer.camera?.transform;
  if (!at || !eye) return undefined;
  const { clientWidth: width, clientHeight: height } = viewer.canvas;
  const [x, y] = [at.x * width, at.y * height];
  const away = position.map((value, k) => (eye[12 + k] as number) - value);
  const faces = !normal || normal.reduce((sum, value, k) => sum + value * (away[k] as number), 0) > 0;
  let visible = at.inside && faces;
  if (visible && occlusion) {
    const hit = viewer.pick(x, y);
    // What is picked at the hotspot itself may lie a hair before it.
    if (hit && hit.distance < at.distance * 0.98) visible = false;
  }
  return { x, y, visible };
}

/** Keeps the elements in slots `hotspot-…` where they belong. */
export class HotspotLayer {
  readonly #host: HTMLElement;
  readonly #layer: HTMLElement;
  readonly #boxes = new Map<string, HTMLElement>();
  readonly #observer: MutationObserver;

  constructor(host: HTMLElement, layer: HTMLElement, changed: () => void) {
    this.#host = host;
    this.#layer = layer;
    this.#observer = new MutationObserver(() => {
      this.#collect();
      changed();
    });
  }

  connect(): void {
    this.#observer.observe(this.#host, {
      childList: true,
      subtree: true,
      attributes: true,
      attributeFilter: ['slot', 'data-position', 'data-normal'],
    });
    this.#collect();
  }

  disconnect(): void {
    this.#observer.disconnect();
  }

  /** Elements of a hotspot's slot. */
  elementsOf(slot: string): Element[] {
    return [...this.#host.children].filter((child) => child.slot === slot);
  }

  /** Puts all in their places. */
  update(viewer: Viewer): void {
    for (const [slot, box] of this.#boxes) {
      const [element] = this.elementsOf(slot);
      const position = readVector(element?.getAttribute('data-position'));
      if (!element || !position) continue;
      const view = viewHotspot(
        viewer,
        { position, normal: readVector(element.getAttribute('data-normal')) },
        element.hasAttribute('data-occlusion'),
      );
      if (!view) continue;
      box.style.transform = `translate(${view.x.toFixed(2)}px, ${view.y.toFixed(2)}px) translate(-50%, -50%)`;
      box.classList.toggle('hide', !view.visible);
      const attribute = element.getAttribute('data-visibility-attribute');
      if (attribute !== null) element.toggleAttribute(`data-${attribute}`, view.visible);
      if (box.hidden) box.hidden = false;
      const before = box.dataset['visible'];
      const now = String(view.visible);
      if (before !== now) {
        box.dataset['visible'] = now;
        // As model-viewer does.
        if (before !== undefined)
          element.dispatchEvent(new CustomEvent('hotspot-visibility', { detail: { visible: view.visible } }));
      }
    }
  }

  #collect(): void {
    const slots = new Set(
      [...this.#host.children].map((child) => child.slot).filter((slot) => slot.startsWith('hotspot-')),
    );
    for (const [slot, box] of this.#boxes) {
      if (slots.has(slot)) continue;
      box.remove();
      this.#boxes.delete(slot);
    }
    for (const slot of slots) {
      if (this.#boxes.has(slot)) continue;
      const box = document.createElement('div');
      box.className = 'hotspot';
      // Until there is an image it has no place.
      box.hidden = true;
      const inner = document.createElement('slot');
      inner.name = slot;
      box.append(inner);
      this.#layer.append(box);
      this.#boxes.set(slot, box);
    }
  }
}
