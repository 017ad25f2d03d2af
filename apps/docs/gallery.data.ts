import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

/** An image of the gallery, as `npm run gallery -- --docs` writes it. */
export interface GalleryEntry {
  readonly id: string;
  readonly title: string;
  readonly alt: string;
  readonly model: string;
  readonly variant?: string;
  readonly command: string;
  readonly width: number;
  readonly height: number;
  readonly samples: number;
  readonly triangles: number;
  readonly seconds: number;
  readonly gpu: string;
}

const file = fileURLToPath(new URL('gallery.json', import.meta.url));

export declare const data: { readonly images: readonly GalleryEntry[]; readonly models: readonly string[] };

export default {
  watch: [file],
  load(): typeof data {
    return JSON.parse(readFileSync(file, 'utf8')) as typeof data;
  },
};
