import { createRequire } from 'node:module';
import { launchOptions } from '@glanz/browser/launch';
import { GALLERY_MODELS } from '@glanz/models/gallery';
import { sceneToGlb } from '@glanz/models/gltf';
import type { BrowserType } from 'playwright';

/**
 * three.js as its manual shows a glTF model: image-based light, transmission, multisampling. The environment is what
 * `PMREMGenerator.fromScene` makes of the model's own softboxes and backdrop, as three.js makes its `RoomEnvironment`;
 * the second one has the light of the first on the backdrop.
 */
const PAGE = `
import { NeutralToneMapping, PMREMGenerator, Scene, WebGLRenderer } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
globalThis.rasterise = async ({ model, stage, camera: name, at, width, height }) => {
  const bytes = Uint8Array.from(atob(model), (c) => c.charCodeAt(0));
  const { scene: root, cameras } = await new GLTFLoader().parseAsync(bytes.buffer, '');
  const canvas = document.createElement('canvas');
  const renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  renderer.toneMapping = NeutralToneMapping;
  renderer.setSize(width, height, false);
  const scene = new Scene();
  scene.add(root);
  const subject = [];
  root.traverse((object) => object.isMesh && !stage.includes(object.material.name) && subject.push(object));
  const show = (visible) => subject.forEach((mesh) => void (mesh.visible = visible));
  show(false);
  const generator = new PMREMGenerator(renderer);
  const position = root.position.clone().set(...at);
  for (let bounce = 0; bounce < 2; bounce++)
    scene.environment = generator.fromScene(scene, 0, 0.01, 100, { position }).texture;
  show(true);
  const camera = cameras.find((one) => one.name === name);
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  renderer.render(scene, camera);
  return { png: canvas.toDataURL('image/png').split(',')[1], parts: subject.length };
};`;

/** What is rasterised: a model of the gallery from one of its cameras. */
export interface RasterisedImage {
  readonly model: string;
  readonly camera: string;
  /** From where its environment is seen, metres. */
  readonly at: readonly [number, number, number];
  readonly width: number;
  readonly height: number;
}

/**
 * Renders the .glb of a model of the gallery with three.js in Chromium: a PNG.
 *
 * @param folders Of the documentation, and where Chromium lies.
 */
export async function rasterise(
  { model, ...view }: RasterisedImage,
  folders: { readonly docs: string; readonly browser: string },
): Promise<Uint8Array> {
  const scene = GALLERY_MODELS[model]!();
  const isStage = ({ name, parameters }: (typeof scene.materials)[number]) =>
    name === 'backdrop' || (parameters.emission_luminance ?? 0) > 0;
  const stage = scene.materials.filter(isStage).map(({ name }) => name);
  const { build } = await import('esbuild');
  const { outputFiles } = await build({
    stdin: { contents: PAGE, resolveDir: folders.docs },
    bundle: true,
    write: false,
    format: 'iife',
    logLevel: 'error',
  });
  const { chromium } = createRequire(`${folders.docs}/package.json`)('playwright') as { chromium: BrowserType };
  const browser = await chromium.launch(await launchOptions(folders.browser));
  try {
    const page = await browser.newPage();
    await page.addScriptTag({ content: outputFiles[0]!.text });
    const input = { model: Buffer.from(await sceneToGlb(scene)).toString('base64'), stage, ...view };
    const { png, parts } = await page.evaluate(
      (all) =>
        (globalThis as unknown as { rasterise: (from: object) => Promise<{ png: string; parts: number }> }).rasterise(
          all,
        ),
      input,
    );
    if (parts === 0) throw new Error(`Nothing of "${model}" is left beside its stage.`);
    return Buffer.from(png, 'base64');
  } finally {
    await browser.close();
  }
}
