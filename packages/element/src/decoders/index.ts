import { loadPart } from '@glanz/scene';
import type { GltfDecoders, Ktx2Decoder } from '@glanz/gltf';
import { ElementError } from '../errors';
import { importDefault } from '../import-default';

/**
 * Addresses of ES modules that replace decoders of this package, absolute or relative to the page; they are read when a
 * file needs the decoder. The default export of such a module is what `GltfDecoders.draco` or `ktx2Decoder()` of
 * `@glanz/gltf` take: the module that Emscripten made, or a function that returns it or a promise of it.
 */
export interface DecoderAddresses {
  /** Of Draco: the module of `draco3dgltf`. */
  readonly draco?: string | URL | null | undefined;
  /** Of KTX2: the module of the Basis Universal transcoder. */
  readonly ktx2?: string | URL | null | undefined;
}

const ATTRIBUTE = { draco: 'draco-decoder', ktx2: 'ktx2-transcoder' } as const;

type Module = { readonly default: unknown };

/**
 * Decoders of Draco and KTX2, for the option `decoders` of `createViewer` and `loadGltf`. Each is a file of this
 * package that is fetched when the first model needs it.
 *
 * @returns Decoders that throw an `ElementError` `element/decoder` where a file cannot be fetched or started.
 * @example
 * const viewer = createViewer(canvas, { decoders: packagedDecoders() });
 */
export function packagedDecoders(addresses: DecoderAddresses = {}): GltfDecoders {
  const start = async (name: keyof DecoderAddresses, own: () => Promise<Module>): Promise<unknown> => {
    const address = addresses[name];
    try {
      const given = address ? await importDefault(address) : (await own()).default;
      return await (typeof given === 'function' ? (given as () => unknown)() : given);
    } catch (cause) {
      throw new ElementError(
        'element/decoder',
        `The decoder does not start (${ATTRIBUTE[name]}${address ? `="${String(address)}"` : ''}): ${(cause as Error).message}`,
        { cause },
      );
    }
  };
  let ktx2: { readonly address: unknown; readonly decoder: Promise<Ktx2Decoder> } | undefined;
  return {
    draco: () => start('draco', () => import('./draco')),
    ktx2: async (...image) => {
      const address = addresses.ktx2;
      if (!ktx2 || ktx2.address !== address) {
        const decoder = Promise.all([start('ktx2', () => import('./basis')), loadPart('ktx2', import('./ktx2'))]).then(
          ([module, { ktx2Decoder }]) => ktx2Decoder(module as object),
        );
        ktx2 = { address, decoder };
        // Another load tries again.
        decoder.catch(() => (ktx2 = undefined));
      }
      return (await ktx2.decoder)(...image);
    },
  };
}
