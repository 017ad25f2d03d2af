import type { Camera, Scene } from '@glanz/scene';

import { cross, dot, transformQuat } from 'gl-matrix/esm/vec3.js';
import { chosenParts, type Selection } from '../selection';
import type { Rgb, State } from '../state/state';
import type { Store } from '../state/store';
import { AXES, middleOfParts, rotated, rotationOf, scaled, translated } from './move-parts';
import { NO_MOVE } from './moves';
import { projection, type Projected, type Projection } from './projection';

export const TOOLS = ['move', 'rotate', 'scale'] as const;
export type Tool = (typeof TOOLS)[number];

/** Length of an axis on the screen, and radius of the rings, CSS pixels. */
const LENGTH = 84;
/** Steps with the key that snaps. */
const SNAP_DEGREES = 15;
const SNAP_FACTOR = 0.1;
/** Cosine of the angle between view and axis below which a ring is seen from its edge. */
const EDGE_ON = 0.3;
/** Points of a ring. */
const RING = 48;

const LABELS: Readonly<Record<Tool, string>> = { move: 'Move', rotate: 'Rotate', scale: 'Scale' };

/** What the gizmo needs to know of the page. */
export interface GizmoHost {
  readonly store: Store<State>;
  readonly selection: Selection;
  readonly scene: () => Scene | undefined;
  readonly camera: () => Camera;
  /** Size of the image on the screen, CSS pixels. */
  readonly size: () => readonly [number, number];
  /** Calls the listener when the camera, the state or the size has changed. */
  readonly onView: (listener: () => void) => void;
}

interface Drag {
  readonly handle: number;
  readonly moves: State['moves'];
  readonly parts: readonly number[];
  readonly x: number;
  readonly y: number;
  readonly at: Projection;
  readonly middle: Rgb;
  readonly key: string;
}

const svg = <K extends keyof SVGElementTagNameMap>(tag: K, attributes: Readonly<Record<string, string>>) => {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
};

/** A step of one, two or five times a power of ten, nearest below a length. */
function niceStep(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * ([5, 2].find((factor) => factor * power <= length) ?? 1);
}

const snapped = (value: number, step: number) => Number((Math.round(value / step) * step).toPrecision(12));

/**
 * Handles over the image that move, turn or scale the chosen parts: three axes and the middle. Ctrl or Shift snaps. Each
 * drag is one step of undo. Its handles are for pointers; numbers beside the list of parts are for the keyboard.
 */
export class Gizmo {
  readonly #root: SVGSVGElement;
  readonly #host: GizmoHost;
  /** X, Y, Z, and what acts in all directions. */
  readonly #handles: readonly SVGGElement[];
  #tool: Tool | undefined;
  #drag: Drag | undefined;
  #drags = 0;

  constructor(root: SVGSVGElement, host: GizmoHost) {
    this.#root = root;
    this.#host = host;
    this.#handles = ['x', 'y', 'z', 'all'].map((name, handle) => {
      const group = svg('g', { class: `handle ${name}`, 'data-handle': name });
      group.append(
        svg('path', { class: 'hit' }),
        svg('path', { class: 'line' }),
        svg('circle', { class: 'tip', r: '6' }),
      );
      group.addEventListener('pointerdown', (event) => this.#begin(handle, event));
      root.append(group);
      return group;
    });
    root.addEventListener('pointermove', (event) => this.#follow(event));
    for (const end of ['pointerup', 'pointercancel'] as const) root.addEventListener(end, () => this.#end());
    host.selection.subscribe(() => this.draw());
    host.onView(() => this.draw());
  }

  get tool(): Tool | undefined {
    return this.#tool;
  }

  set tool(tool: Tool | undefined) {
    this.#tool = tool;
    this.draw();
  }

  /** Puts the handles where the chosen parts are on the screen. */
  draw(): void {
    const { store, selection, scene } = this.#host;
    const parts = chosenParts(selection.chosen);
    const model = scene();
    const shown = this.#tool !== undefined && parts.length > 0 && model !== undefined;
    this.#root.toggleAttribute('hidden', !shown);
    if (!shown) return;
    const middle = middleOfParts(model, store.state.moves, parts);
    const view = this.#view();
    const at = view.at(middle);
    if (!at) {
      this.#root.toggleAttribute('hidden', true);
      return;
    }
    const [width, height] = this.#host.size();
    this.#root.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.#root.dataset['at'] = `${at.x.toFixed(1)} ${at.y.toFixed(1)}`;
    const length = LENGTH * at.metres;
    for (const [handle, group] of this.#handles.entries()) {
      const [hit, line, tip] = [...group.children] as [SVGPathElement, SVGPathElement, SVGCircleElement];
      const axis = this.#axis(handle);
      let path = '';
      let end: Projected | undefined = at;
      if (axis && this.#tool === 'rotate') path = ring(view, middle, axis, length);
      else if (axis) {
        end = view.at([0, 1, 2].map((k) => (middle[k] as number) + length * (axis[k] as number)) as unknown as Rgb);
        if (end) path = `M${at.x} ${at.y}L${end.x} ${end.y}`;
      }
      for (const one of [hit, line]) one.setAttribute('d', path);
      const tipped = end !== undefined && this.#tool !== 'rotate';
      tip.style.display = tipped ? '' : 'none';
      if (end) {
        tip.setAttribute('cx', String(end.x));
        tip.setAttribute('cy', String(end.y));
      }
    }
  }

  #view(): Projection {
    return projection(this.#host.camera(), ...this.#host.size());
  }

  /** Direction of a handle in the world: parts are scaled along their own axes. */
  #axis(handle: number): Rgb | undefined {
    const axis = AXES[handle];
    const { store, selection } = this.#host;
    if (!axis || this.#tool !== 'scale') return axis;
    const move = store.state.moves[selection.chosen.instance ?? -1] ?? NO_MOVE;
    return transformQuat([0, 0, 0], axis, rotationOf(move)) as Rgb;
  }

  #begin(handle: number, event: PointerEvent): void {
    const { store, selection, scene } = this.#host;
    const model = scene();
    if (!model || event.button !== 0) return;
    event.preventDefault();
    event.stopPropagation();
    this.#root.setPointerCapture(event.pointerId);
    const parts = chosenParts(selection.chosen);
    const { moves } = store.state;
    const { left, top } = this.#root.getBoundingClientRect();
    this.#drag = {
      handle,
      moves,
      parts,
      x: event.clientX - left,
      y: event.clientY - top,
      at: this.#view(),
      middle: middleOfParts(model, moves, parts),
      key: `drag ${++this.#drags}`,
    };
    this.#root.dataset['drag'] = String(handle);
  }

  #end(): void {
    this.#drag = undefined;
    delete this.#root.dataset['drag'];
  }

  #follow(event: PointerEvent): void {
    const drag = this.#drag;
    const model = this.#host.scene();
    if (!drag || !model || !this.#tool) return;
    const { left, top } = this.#root.getBoundingClientRect();
    const snap = event.ctrlKey || event.metaKey || event.shiftKey;
    const moves = this.#moved(model, drag, event.clientX - left, event.clientY - top, snap);
    if (moves) this.#host.store.set({ moves }, { label: LABELS[this.#tool], merge: drag.key, held: true });
  }

  /** Moves after the pointer has come to a point of the screen. */
  #moved(model: Scene, drag: Drag, x: number, y: number, snap: boolean): State['moves'] | undefined {
    const { moves, parts, middle, handle, at: view } = drag;
    const at = view.at(middle);
    if (!at) return undefined;
    const [dx, dy] = [x - drag.x, y - drag.y];
    const axis = this.#axis(handle);
    if (this.#tool === 'rotate') {
      const towards = view.towards(middle);
      const about = axis ?? towards;
      const facing = dot(about, towards);
      const angle = Math.abs(facing) < EDGE_ON ? rolled(view, about, towards, dx, dy) : turned(at, drag, x, y, facing);
      const degrees = (180 * angle) / Math.PI;
      return rotated(model, moves, parts, about, snap ? snapped(degrees, SNAP_DEGREES) : degrees);
    }
    const length = LENGTH * at.metres;
    const end =
      axis && view.at([0, 1, 2].map((k) => (middle[k] as number) + length * (axis[k] as number)) as unknown as Rgb);
    const [ax, ay] = end ? [end.x - at.x, end.y - at.y] : [LENGTH, 0];
    // An axis that points at the camera has no length on the screen.
    const along = (dx * ax + dy * ay) / Math.max(ax * ax + ay * ay, 16);
    if (this.#tool === 'scale') {
      const factor = 1 + along;
      return scaled(
        model,
        moves,
        parts,
        axis && handle,
        snap ? Math.max(SNAP_FACTOR, snapped(factor, SNAP_FACTOR)) : factor,
      );
    }
    const step = niceStep(length / 4);
    const rounded = (value: number) => (snap ? snapped(value, step) : value);
    const by = axis
      ? axis.map((k) => k * rounded(along * length))
      : [0, 1, 2].map((k) => rounded(at.metres * (dx * (view.right[k] as number) - dy * (view.up[k] as number))));
    return translated(moves, parts, by as unknown as Rgb);
  }
}

/** Radians that the pointer has gone about a point, counter-clockwise seen from the axis' tip. */
function turned(at: Projected, from: { readonly x: number; readonly y: number }, x: number, y: number, facing: number) {
  const angle = Math.atan2(at.y - y, x - at.x) - Math.atan2(at.y - from.y, from.x - at.x);
  return Math.sign(facing || 1) * Math.atan2(Math.sin(angle), Math.cos(angle));
}

/** Radians that a ring seen from its edge has rolled under the pointer: its near side moves along axis × view. */
function rolled(view: Projection, axis: Rgb, towards: Rgb, dx: number, dy: number): number {
  const along = cross([0, 0, 0], axis, towards);
  return (dx * dot(along, view.right) - dy * dot(along, view.up)) / LENGTH;
}

/** A circle about an axis, as seen. */
function ring(view: Projection, middle: Rgb, axis: Rgb, radius: number): string {
  const u: Rgb = Math.abs(axis[1]) > 0.9 ? [1, 0, 0] : [0, 1, 0];
  const v = cross([0, 0, 0], axis, u);
  const points = Array.from({ length: RING + 1 }, (_, i) => {
    const [c, s] = [Math.cos((2 * Math.PI * i) / RING), Math.sin((2 * Math.PI * i) / RING)];
    return view.at([0, 1, 2].map((k) => (middle[k] as number) + radius * (c * u[k]! + s * v[k]!)) as unknown as Rgb);
  });
  return points
    .map((point, i) => (point ? `${i === 0 || !points[i - 1] ? 'M' : 'L'}${point.x} ${point.y}` : ''))
    .join('');
}
