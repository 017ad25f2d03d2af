import { PlaygroundError } from '../errors';
import type { ModelRequest } from './load-messages';

/**
 * Fetches the model that the page's address names: `?model=https://example.com/chair.glb`. Servers of other origins must
 * allow it (CORS). A .gltf must hold its data itself.
 *
 * @throws {PlaygroundError} `playground/model-address`
 */
export async function fetchModel(address: string): Promise<ModelRequest> {
  const wrong = (why: string, cause?: unknown) =>
    new PlaygroundError('playground/model-address', `The model ${address} was not loaded: ${why}.`, { cause });
  let url: URL;
  try {
    url = new URL(address, location.href);
  } catch (cause) {
    throw wrong('the address is not a valid URL', cause);
  }
  const entry = decodeURIComponent(url.pathname.split('/').at(-1) ?? '');
  if (!/^https?:$/.test(url.protocol) || !/\.(glb|gltf|obj|stl|usd[acz]?)$/i.test(entry))
    throw wrong('its URL must begin with https:// and end in .glb, .gltf, .obj, .stl or .usdz');
  let response: Response;
  try {
    response = await fetch(url);
  } catch (cause) {
    throw wrong('the server cannot be reached, or does not allow other pages to read it (CORS)', cause);
  }
  if (!response.ok) throw wrong(`the server responded with status ${response.status}`);
  return { kind: 'files', entry, files: new Map([[entry, await response.blob()]]) };
}
