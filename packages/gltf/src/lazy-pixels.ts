import type { DecodedImage } from './decoded-image';

/**
 * A picture whose pixels are made when somebody asks for them, once; whoever sets them replaces them. Copies of its
 * properties do the same, each for itself.
 */
export function imageOfPixels<T extends Omit<DecodedImage, 'data'>>(
  image: T,
  read: () => DecodedImage['data'],
): T & DecodedImage {
  const hold = (holder: object, data: DecodedImage['data']) => {
    Object.defineProperty(holder, 'data', { value: data, writable: true, enumerable: true, configurable: true });
    return data;
  };
  return Object.defineProperty(image, 'data', {
    get(this: object) {
      return hold(this, read());
    },
    set(this: object, data: DecodedImage['data']) {
      hold(this, data);
    },
    enumerable: true,
    configurable: true,
  }) as T & DecodedImage;
}
