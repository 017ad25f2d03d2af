import type { PathTracer } from '@glanz/renderer';
import { describe, expect, it } from 'vitest';
import { FilmFit } from '../src/film-fit';

type Size = readonly [number, number];

/** A tracer with memory for so many pixels, or whose device is lost. */
function tracerOf(size: Size, memory: { pixels: number; lost?: boolean }, sizes?: Size[]): PathTracer {
  let full = size;
  const tracer = {
    width: size[0],
    height: size[1],
    setDepth: () => undefined,
    setRenderScale: (scale: number) =>
      Object.assign(tracer, { width: Math.round(full[0] * scale), height: Math.round(full[1] * scale) }),
    resize: (width: number, height: number) => {
      sizes?.push([width, height]);
      if (memory.lost) return Promise.reject(Object.assign(new Error('lost'), { code: 'renderer/device-lost' }));
      if (width * height > memory.pixels)
        return Promise.reject(Object.assign(new Error('full'), { code: 'renderer/out-of-memory' }));
      Object.assign(tracer, { width, height });
      full = [width, height];
      return Promise.resolve();
    },
  };
  return tracer as unknown as PathTracer;
}

/** As the engine does: the size there is memory for, and how many were refused. */
async function settle(films: FilmFit, tracer: PathTracer, image: Size): Promise<number> {
  for (let refused = 0; ; refused++) {
    const size = films.sizeFor(image);
    try {
      await films.fit(tracer, size, 8);
      return refused;
    } catch {
      films.refuse(tracer, size);
    }
    expect(refused).toBeLessThan(40);
  }
}

describe('FilmFit', () => {
  it('halves the pixels until they fit, in the shape of the image', async () => {
    const films = new FilmFit();
    const tracer = tracerOf([160, 40], { pixels: 9000 });
    expect(await settle(films, tracer, [200, 200])).toBe(3);
    expect([tracer.width, tracer.height]).toEqual([70, 70]);
  });

  it('stays with a film of that shape that is larger than the next try', async () => {
    const films = new FilmFit();
    const tracer = tracerOf([150, 100], { pixels: 15_000 });
    expect(await settle(films, tracer, [153, 102])).toBe(1);
    expect([tracer.width, tracer.height]).toEqual([150, 100]);
  });

  it('does not take a small preview for the best there is, whatever its rounding', async () => {
    const films = new FilmFit();
    const tracer = tracerOf([20, 13], { pixels: 2500 });
    await settle(films, tracer, [80, 50]);
    expect([tracer.width, tracer.height]).toEqual([56, 35]);
  });

  it('ends with the film there is, where nothing fits', async () => {
    const films = new FilmFit();
    const tracer = tracerOf([30, 10], { pixels: 0 });
    await settle(films, tracer, [64, 64]);
    expect([tracer.width, tracer.height]).toEqual([30, 10]);
  });

  it('forgets nothing and notes nothing when a device is lost in between', async () => {
    const films = new FilmFit();
    const memory = { pixels: 1e9, lost: true };
    const tracer = tracerOf([20, 13], memory);
    await expect(films.fit(tracer, [80, 50], 8)).rejects.toMatchObject({ code: 'renderer/device-lost' });
    expect(films.sizeFor([80, 50])).toEqual([80, 50]);
  });

  it('scales a film of the whole size for previews and back, without another film', async () => {
    const films = new FilmFit();
    const sizes: Size[] = [];
    const tracer = tracerOf([120, 90], { pixels: 1e6 }, sizes);
    films.adopt(tracer, 8);
    for (const [scale, width, height] of [
      [1 / 3, 40, 30],
      [1 / 4, 30, 23],
      [1, 120, 90],
    ] as const) {
      expect(await films.fit(tracer, [120, 90], 8, scale)).toBe(true);
      expect(await films.fit(tracer, [120, 90], 8, scale)).toBe(false);
      expect([tracer.width, tracer.height]).toEqual([width, height]);
    }
    expect(sizes).toEqual([]);
    // While the image changes its size, its film is as small as the preview.
    await films.fit(tracer, [200, 100], 8, 1 / 4);
    await films.fit(tracer, [240, 100], 8, 1 / 4);
    await films.fit(tracer, [240, 100], 8);
    await films.fit(tracer, [240, 100], 8, 1 / 2);
    expect(sizes).toEqual([
      [50, 25],
      [60, 25],
      [240, 100],
    ]);
    expect([tracer.width, tracer.height]).toEqual([120, 50]);
  });

  it('grows when there is memory again, and tries less and less often before', async () => {
    const films = new FilmFit();
    const memory = { pixels: 5000 };
    const tracer = tracerOf([10, 10], memory);
    await settle(films, tracer, [100, 100]);
    const small = [tracer.width, tracer.height];
    const waits = [];
    for (let i = 0; i < 9; i++) {
      waits.push(films.retryMs / 1000);
      expect(await films.grow(tracer, [100, 100])).toBe(false);
    }
    expect(waits).toEqual([4, 8, 16, 32, 64, 128, 256, 256, 256]);
    expect([[tracer.width, tracer.height], films.sizeFor([100, 100])]).toEqual([small, [70, 70]]);
    memory.pixels = 10_000;
    expect(await films.grow(tracer, [100, 100])).toBe(true);
    expect([films.sizeFor([100, 100]), films.retryMs]).toEqual([[100, 100], 4000]);
  });
});
