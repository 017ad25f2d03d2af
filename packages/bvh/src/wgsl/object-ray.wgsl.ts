import { wgslModule } from '@glanz/wgsl/module';
import { bvhTriangleTest } from './triangle.wgsl';
import { bvhRecords } from './types.wgsl';

/** `bvh_object_ray(placed, origin, direction)`: a ray of the world in the space of an instance. The direction keeps its length in the world's units, so t is the same in both. */
export const bvhObjectRay = wgslModule(
  'bvh/object-ray',
  /* wgsl */ `
fn bvh_object_ray(placed: BvhInstance, origin: vec3f, direction: vec3f) -> BvhRay {
  let point = vec4f(origin, 1.0);
  return bvh_ray(
    vec3f(dot(placed.to_object_0, point), dot(placed.to_object_1, point), dot(placed.to_object_2, point)),
    vec3f(dot(placed.to_object_0.xyz, direction), dot(placed.to_object_1.xyz, direction), dot(placed.to_object_2.xyz, direction)),
  );
}
`,
  [bvhRecords, bvhTriangleTest],
);
