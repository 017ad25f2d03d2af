import { readIes } from '@glanz/formats/ies';
import { decodeEnvironment } from '@glanz/image/environment';
import { PathTracer } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';

// #region environment
export async function lightWith(tracer: PathTracer, url: string) {
  const response = await fetch(url); // Radiance .hdr or OpenEXR
  const { width, height, data } = decodeEnvironment(
    new Uint8Array(await response.arrayBuffer()),
  );
  await tracer.setEnvironment({
    type: 'latlong',
    width,
    height,
    data,
    rotation: Math.PI / 2,
    intensity: 1.5,
  });
}
// #endregion environment

// #region studio
export const inTheStudio = (tracer: PathTracer) =>
  tracer.setEnvironment(studioEnvironment({ rotation: 0.6 }));
export const inFog = (tracer: PathTracer) =>
  tracer.setEnvironment({
    type: 'constant',
    radiance: [0.8, 0.85, 1],
    visible: false,
  });
export const inTheDark = (tracer: PathTracer) =>
  tracer.setEnvironment(undefined);
// #endregion studio

// #region punctual
export function addPunctualLights(scene: Scene): Scene {
  return {
    ...scene,
    lights: [
      {
        type: 'directional',
        name: 'sun',
        color: [1, 0.96, 0.9],
        intensity: 3,
        direction: [-0.48, -0.8, -0.36],
      },
      {
        type: 'point',
        name: 'bulb',
        color: [1, 0.8, 0.6],
        intensity: 2,
        position: [0, 1.5, 0.5],
      },
      {
        type: 'spot',
        name: 'stage',
        color: [1, 1, 1],
        intensity: 20,
        position: [1, 3, 1],
        direction: [0, -1, 0],
        inner_cone_angle: 0.2,
        outer_cone_angle: 0.35,
      },
    ],
  };
}
// #endregion punctual

// #region profile
export function addDownlight(scene: Scene, ies: Uint8Array): Scene {
  const profile = readIes(ies); // candela, by measured angle
  return {
    ...scene,
    lights: [
      ...scene.lights,
      {
        type: 'profile',
        name: 'downlight',
        color: [1, 0.9, 0.8],
        intensity: 0.01,
        position: [0, 2.4, 0],
        direction: [0, -1, 0],
        profile,
      },
    ],
  };
}
// #endregion profile

// #region panels
export function addPanels(scene: Scene): Scene {
  return {
    ...scene,
    lights: [
      ...scene.lights,
      {
        type: 'rectangle',
        name: 'softbox',
        color: [1, 1, 1],
        intensity: 8,
        position: [-1, 1.5, 1],
        direction: [0.5, -0.7, -0.5],
        width: 0.8,
        height: 1.2,
        visible: false,
      },
      {
        type: 'disk',
        name: 'spotlight',
        color: [1, 0.9, 0.8],
        intensity: 10,
        position: [1.5, 1.5, 0],
        direction: [-1, -1, 0],
        radius: 0.2,
      },
      {
        type: 'sphere',
        name: 'globe',
        color: [1, 0.8, 0.6],
        intensity: 5,
        position: [0, 1.8, -1],
        radius: 0.15,
      },
    ],
  };
}
// #endregion panels

// #region emissive
export const glow = (tracer: PathTracer) =>
  tracer.setMaterial('lens', {
    emission_color: [0.03, 1, 0.2],
    emission_luminance: 4,
  });
// #endregion emissive

// #region catcher
export function ontoPhotograph(device: GPUDevice, scene: Scene) {
  for (const instance of scene.instances)
    if (instance.name === 'floor') instance.catcher = true;
  return PathTracer.create(device, scene, {
    width: 800,
    height: 600,
    background: 'transparent',
  });
}
// #endregion catcher
