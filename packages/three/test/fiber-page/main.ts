import { PathTracer, type PathTracerProps } from '@glanz/three/fiber';
import type { ThreePathTracer } from '@glanz/three';
import { Canvas } from '@react-three/fiber';
import { createElement, createRef } from 'react';
import { createRoot } from 'react-dom/client';
import * as THREE from 'three';

const root = createRoot(document.querySelector('#root')!);
const ref = createRef<ThreePathTracer>();
const samples: number[] = [];
const errors: string[] = [];
const sphere = new THREE.SphereGeometry(1, 32, 16);

Object.assign(window, {
  ref,
  samples,
  errors,
  /** Shows a ball of a colour, path-traced as the props say; without them, as fiber shows it. */
  show: (color: string, props?: PathTracerProps) =>
    root.render(
      createElement(
        Canvas,
        { dpr: 1, flat: true, camera: { position: [0, 0, 3.5], fov: 45 } },
        props &&
          createElement(PathTracer, {
            ...props,
            ref,
            onSample: (count: number) => void samples.push(count),
            onError: (error: unknown) => void errors.push(String(error)),
          }),
        createElement('hemisphereLight', { args: ['white', 'black', Math.PI] }),
        createElement('mesh', { geometry: sphere }, createElement('meshStandardMaterial', { color })),
      ),
    ),
  hide: () => root.render(null),
});
