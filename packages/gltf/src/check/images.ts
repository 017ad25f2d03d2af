import { dataUri } from '../uri';
import type { CheckContext } from './context';
import { isObject, own, quote, type Raw } from '../json-value';

const IMAGE_TYPE = /^image\/(png|jpeg|webp|avif|ktx2)$/;

/** Texture extensions that name an image. */
const SOURCES = ['EXT_texture_webp', 'EXT_texture_avif', 'KHR_texture_basisu'];

/** Warns of invalid textures, images and samplers; they are read later, if a material uses them. */
export function checkImages(context: CheckContext): void {
  const samplers = context.list('samplers'),
    images = context.list('images');
  const names = (value: unknown, list: readonly Raw[]) =>
    typeof value === 'number' && Number.isInteger(value) && value >= 0 && value < list.length;
  context.list('textures').forEach((texture, index) => {
    const path = `/textures/${index}`;
    const sampler = own(texture, 'sampler');
    if (sampler !== undefined && !names(sampler, samplers))
      context.warn(
        'gltf/texture',
        `${path}/sampler`,
        `is ${quote(sampler)}, which names no sampler; the texture repeats`,
      );
    const extensions = own(texture, 'extensions');
    const sources: (readonly [string, unknown])[] = [[`${path}/source`, own(texture, 'source')]];
    for (const name of SOURCES) {
      const extension = isObject(extensions) ? own(extensions, name) : undefined;
      if (extension !== undefined)
        sources.push([`${path}/extensions/${name}/source`, isObject(extension) ? own(extension, 'source') : null]);
    }
    for (const [at, source] of sources)
      if (source !== undefined && !names(source, images))
        context.warn('gltf/texture', at, `is ${quote(source)}, which names no image; it is left out`);
  });
  images.forEach((image, index) => checkImage(context, image, `/images/${index}`));
}

/** Ignores percent escapes. Tests chunks, since regular expressions fail on very long strings. */
function isBase64(text: string): boolean {
  for (let at = 0; at < text.length; at += 65536)
    if (!/^[A-Za-z0-9+/=%\s]*$/.test(text.slice(at, at + 65536))) return false;
  return true;
}

function checkImage(context: CheckContext, image: Raw, path: string): void {
  const warn = (what: string) => context.warn('gltf/image', path, what);
  const mimeType = own(image, 'mimeType');
  if (mimeType !== undefined && (typeof mimeType !== 'string' || !IMAGE_TYPE.test(mimeType)))
    warn(`has the mimeType ${quote(mimeType)}, which is not an image type; the type is read from its bytes`);
  const uri = own(image, 'uri'),
    view = own(image, 'bufferView');
  if (uri === undefined && view === undefined) return warn('has neither uri nor bufferView: there is no image');
  if (uri !== undefined && view !== undefined) warn('has a uri and a bufferView; the uri is used');
  if (uri === undefined) {
    if (typeof view !== 'number' || !context.list('bufferViews')[view])
      warn(`has the bufferView ${quote(view)}, which is none`);
    else if (mimeType === undefined)
      warn('has no mimeType, which an image in a buffer view must have; the type is read from its bytes');
    return;
  }
  if (typeof uri !== 'string') return warn(`has the uri ${quote(uri)}, which is not a string`);
  if (/^data:/i.test(uri)) {
    const data = dataUri(uri);
    if (!data || (data.base64 && !isBase64(data.data))) warn('has a data: uri that cannot be read');
    else if (!IMAGE_TYPE.test(data.type) || (mimeType !== undefined && mimeType !== data.type))
      warn(
        `has a data: uri of the type "${data.type}"${mimeType === undefined ? '' : ` and the mimeType ${quote(mimeType)}`}; the type is read from its bytes`,
      );
  } else if (/^[a-z][a-z0-9+.-]*:/i.test(uri) || uri === '' || uri.startsWith(':'))
    warn(`has the uri ${quote(uri)}, which names no file beside the document`);
}
