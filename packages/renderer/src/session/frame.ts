import type { Camera } from '@glanz/scene';
import { cameraUniforms } from '../camera/camera';
import type { Film } from '../film/film';
import type { GpuScene } from '../scene/gpu-scene';
import { BACKGROUND_HIDDEN, BACKGROUND_TRANSPARENT, frameStruct } from '../storage/layout';
import { biasedUniforms } from '../biased-options';
import type { TracerSettings } from '../option-checks';
import { resolveFilter } from '../camera/view';
import type { Geometry } from '../geometry/geometry';

/** The frame uniforms for the present camera, film and environment. */
export function packFrame(
  camera: Camera,
  film: Pick<Film, 'width' | 'height'>,
  scene: GpuScene,
  geometry: Geometry,
  options: TracerSettings,
): ArrayBuffer {
  const data = frameStruct.allocate();
  const { environment } = scene;
  const transparent = options.background === 'transparent';
  frameStruct.write(data, 0, {
    ...cameraUniforms(camera, film.width, film.height),
    size: [film.width, film.height],
    seed: options.seed,
    max_depth: options.maxDepth,
    max_volume_depth: options.maxVolumeDepth,
    light_count: scene.lightCount,
    first_area_light: scene.areaLights.first,
    area_light_count: scene.areaLights.count,
    background:
      ((transparent ? BACKGROUND_TRANSPARENT | BACKGROUND_HIDDEN : 0) |
        (environment.visible ? 0 : BACKGROUND_HIDDEN) |
        (Math.round(options.shadowSoftness * 65_535) << 16)) >>>
      0,
    environment_radiance: environment.radiance,
    mean_luminance: environment.meanLuminance,
    environment_probability: scene.environmentProbability,
    environment_rotation: environment.rotation,
    environment_group: scene.groups.environment,
    catcher_root: geometry.placement.bareRoot,
    environment_cells: [environment.table?.width ?? 1, environment.table?.height ?? 1],
    lod_bias: options.textureLodBias,
    ...biasedUniforms(options),
    light_candidates: options.lightCandidates,
    scene_scale: geometry.placement.radius,
    filter_radius: resolveFilter(options.filter).radius,
  });
  return data;
}
