import type { DecodedImage } from './decoded-image';

/**
 * An image whose pixels are computed on the first access to `data`, once; setting `data` replaces them. Objects to
 * which the property's descriptor is copied behave the same, independently.
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
