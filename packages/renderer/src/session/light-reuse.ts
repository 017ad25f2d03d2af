import type { LightReuse } from '../integrator/integrator';
import type { GpuMemory } from '../storage/buffers';

/** Textures of a frame, by what kernels call them: its own, and those of the frame before. */
const TEXTURES = {
  reservoirs_kept: ['reservoirs_before', 'rgba32uint'],
  reservoirs_surfaces: ['reservoirs_surfaces_before', 'rgba32uint'],
  reservoirs_visible: ['reservoirs_visible_before', 'r32uint'],
} as const;
type Kept = keyof typeof TEXTURES;
const KEPT = Object.keys(TEXTURES) as Kept[];

const BYTES = { rgba32uint: 16, r32uint: 4 };

// GPUTextureUsage, which Node does not define.
const USAGE = 0x04 | 0x08;
/** Frames are numbered below it. */
const NUMBERS = 2 ** 30;

/** What the light samples of a frame fit. */
interface FrameShape {
  readonly width: number;
  readonly height: number;
  /** Generation of the ids of lights. */
  readonly lights: number;
}

interface FrameTextures extends FrameShape {
  readonly views: Readonly<Record<Kept, GPUTextureView>>;
  readonly textures: readonly GPUTexture[];
}

/**
 * Light samples of a frame and of the one before, 72 bytes a pixel, in textures that change places from one frame to the
 * next: storage buffers are all in use. Freed by the first film that reuses none.
 */
export function lightReuse(memory: GpuMemory, film: () => FrameShape): LightReuse {
  let frames: [now: FrameTextures | undefined, before: FrameTextures | undefined] = [undefined, undefined];
  let on = false;
  let begun = false;
  let number = 0;
  let before = 0;
  /** Whether the film that was shown last has left light samples. */
  let left = false;

  const texture = (label: string, width: number, height: number, format: keyof typeof BYTES) =>
    memory.texture(
      { label: `glanz ${label}`, size: [width, height], format, usage: USAGE },
      BYTES[format] * width * height,
    );
  const free = (frame: FrameTextures | undefined) => frame?.textures.forEach((texture) => memory.release(texture));
  const discard = () => {
    frames.forEach(free);
    frames = [undefined, undefined];
  };
  const fitting = (frame: FrameTextures | undefined): FrameTextures => {
    const { width, height, lights } = film();
    if (frame?.width === width && frame.height === height) return { ...frame, lights };
    free(frame);
    const textures = KEPT.map((name) => texture(`light samples ${name}`, width, height, TEXTURES[name][1]));
    const views = Object.fromEntries(KEPT.map((name, i) => [name, (textures[i] as GPUTexture).createView()]));
    return { width, height, lights, textures, views: views as FrameTextures['views'] };
  };
  /** What kernels bind that keep nothing: a texture each, since none may be written twice. */
  const empty = new Map<string, GPUTexture>();
  const nothing = (name: string, format: keyof typeof BYTES) => {
    const made = empty.get(name) ?? texture(`no light samples: ${name}`, 1, 1, format);
    empty.set(name, made);
    return made.createView();
  };
  return {
    restart(reuses) {
      if (begun) left = on;
      begun = false;
      on = reuses;
    },
    begin(rebind) {
      if (!on) {
        begun = true;
        if (frames[0]) {
          discard();
          rebind();
        }
        return [0, 0];
      }
      if (!begun) {
        begun = true;
        const [now, old] = frames;
        const next = fitting(old);
        const known = left && now?.width === next.width && now.height === next.height && now.lights === next.lights;
        before = known ? number : 0;
        number = (number % NUMBERS) + 1;
        frames = [next, known ? now : fitting(now)];
        rebind();
      }
      return [number, before];
    },
    resource(name) {
      const [now, old] = frames;
      for (const kept of KEPT) {
        const [before, format] = TEXTURES[kept];
        if (name === kept) return now?.views[kept] ?? nothing(name, format);
        if (name === before) return old?.views[kept] ?? nothing(name, format);
      }
      return undefined;
    },
    discard() {
      discard();
      empty.forEach((each) => memory.release(each));
      empty.clear();
    },
  };
}
