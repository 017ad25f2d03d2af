/**
 * What links a build here to one by tinybvh in C++, which this benchmark cannot run: times of both and of
 * three-mesh-bvh 0.9 on the same meshes, one thread each, minima in milliseconds on a shared two-core Xeon. Only their
 * ratios carry over: ours over tinybvh's = (three-mesh-bvh's over tinybvh's, from here) / (three-mesh-bvh's over ours,
 * from the run). The second CAD-like mesh there is another one than here, of the same size.
 */
export const TINYBVH: readonly {
  readonly mesh: string;
  readonly here: string;
  readonly reference: number;
  readonly avx2: number;
  readonly center: number;
  readonly sah10: number;
}[] = [
  { mesh: 'sphere 107k', here: 'noisy sphere 107k', reference: 34, avx2: 18, center: 40, sah10: 156 },
  { mesh: 'CAD 107k', here: 'push-button 107k', reference: 30, avx2: 16, center: 42, sah10: 163 },
  { mesh: 'sphere 1.07M', here: 'noisy sphere 1.07M', reference: 439, avx2: 254, center: 348, sah10: 1548 },
  { mesh: 'CAD 1.07M', here: 'push-button 1.07M', reference: 407, avx2: 231, center: 412, sah10: 1608 },
];
