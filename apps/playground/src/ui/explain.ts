import { describeError, PlaygroundError } from '../errors';
import { byId, element } from './elements';

/** Explains in place of the image why there is none, and what to do. @returns A function that removes the text. */
export function explain(error: unknown): () => void {
  const { message, code } = describeError(error);
  const missing = code === 'renderer/no-webgpu';
  const advice = missing
    ? [
        'Chrome or Edge 113 and later, on Windows, macOS, ChromeOS and Android',
        'Firefox 141 and later on Windows, 145 on macOS',
        'Safari 26 and later',
        'The address must start with https:// or http://localhost',
      ]
    : [
        'Update the graphics driver',
        'Allow hardware acceleration in the browser’s settings',
        'Reload the page if the GPU was lost',
      ];
  const notice = byId('notice');
  notice.replaceChildren(
    element('h2', {}, missing ? 'This page needs WebGPU' : 'The GPU cannot be used'),
    element(
      'p',
      { role: 'alert', 'data-code': code },
      missing
        ? 'Images are rendered on the GPU with WebGPU, which this browser does not provide for this page.'
        : message,
    ),
    element('p', {}, missing ? 'Supported browsers:' : 'Try the following:'),
    element('ul', {}, ...advice.map((line) => element('li', {}, line))),
  );
  notice.hidden = false;
  byId('preparing').hidden = true;
  byId('image').dataset['state'] = 'unavailable';
  const controls = [
    ...document.querySelectorAll<HTMLButtonElement | HTMLInputElement | HTMLSelectElement>('button, input, select'),
  ].filter(({ disabled }) => !disabled);
  for (const control of controls) control.disabled = true;
  return () => {
    notice.hidden = true;
    for (const control of controls) control.disabled = false;
  };
}

/**
 * Explains at once that WebGPU or a GPU is missing, before anything is fetched.
 *
 * @param start Starts the page. It asks for a GPU more than once; where one comes late, the page works.
 */
export async function explained(start: () => Promise<void>): Promise<void> {
  let back = () => undefined as void;
  let settled = false;
  try {
    const { gpu } = navigator as { readonly gpu?: GPU };
    if (!gpu) throw new PlaygroundError('renderer/no-webgpu', 'This browser does not provide WebGPU for this page.');
    const missing = (adapter: GPUAdapter | null) => {
      if (!adapter && !settled)
        back = explain(new PlaygroundError('renderer/no-adapter', 'WebGPU finds no usable GPU.'));
    };
    gpu.requestAdapter({ powerPreference: 'high-performance' }).then(missing, () => undefined);
    await start();
    back();
  } catch (error) {
    back();
    explain(error);
  } finally {
    settled = true;
  }
}
