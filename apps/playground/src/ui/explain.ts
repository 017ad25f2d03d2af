import { describeError } from '../errors';
import { byId, element } from './elements';

/** Says why there is no picture and what to do, where the picture would be. */
export function explain(error: unknown): void {
  const { message, code } = describeError(error);
  const missing = code === 'renderer/no-webgpu';
  const advice = missing
    ? ['Chrome or Edge 113 and later, on Windows, macOS, ChromeOS and Android', 'Firefox 141 and later on Windows, 145 on macOS', 'Safari 26 and later', 'The address must start with https:// or http://localhost']
    : ['Update the graphics driver', 'Allow hardware acceleration in the browser’s settings', 'Reload the page if the GPU was lost'];
  const notice = byId('notice');
  notice.replaceChildren(
    element('h2', {}, missing ? 'This page needs WebGPU' : 'The GPU cannot be used'),
    element('p', { role: 'alert', 'data-code': code }, missing ? 'Pictures are computed on the GPU through WebGPU, which this browser does not offer here.' : message),
    element('p', {}, missing ? 'Browsers that have it:' : 'What may help:'),
    element('ul', {}, ...advice.map((line) => element('li', {}, line))),
  );
  notice.hidden = false;
  byId('preparing').hidden = true;
  byId('picture').dataset['state'] = 'unavailable';
  for (const control of document.querySelectorAll<HTMLButtonElement | HTMLInputElement | HTMLSelectElement>('button, input, select')) control.disabled = true;
}
