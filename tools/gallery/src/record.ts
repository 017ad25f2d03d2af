/** What is known of an image after it has been rendered. */
export interface GalleryRecord {
  readonly id: string;
  readonly command: string;
  readonly width: number;
  readonly height: number;
  readonly samples: number;
  readonly triangles: number;
  /** From the start of the preparation to the end of the denoising, seconds. */
  readonly seconds: number;
  readonly gpu: string;
}
