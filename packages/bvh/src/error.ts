import { GlanzError } from '@glanz/wgsl/error';

/**
 * Thrown by all functions of this package. Codes:
 *
 * - `bvh/positions`: the positions are not three for each vertex, are not finite after a move, or their GPU buffer is
 *   too small. Pass complete ones, and build again.
 * - `bvh/indices`: the indices are not three for each triangle, or one refers to a vertex that does not exist. Fix
 *   the mesh.
 * - `bvh/transform`: an instance's transform is not 16 numbers. Pass a column-major matrix.
 * - `bvh/instance`: a `DynamicTlas` does not have an instance of this number. Pass all instances to its constructor.
 * - `bvh/layout`: hierarchies of meshes and of instances have nodes of different width. Widen both or none.
 * - `bvh/parts`: an instance refers to a part that was not given. Pass a part for each instance.
 * - `bvh/too-many`: one hierarchy cannot hold as many triangles or instances. Split the mesh, or combine instances.
 * - `bvh/options`: an option is out of its range. Pass a value in the range of the message.
 * - `bvh/batch`: an array of rays or results has a wrong length. Pass as many entries as the message says.
 * - `bvh/region`: a plane of a region is not four numbers, or there is none. Pass at least one plane.
 * - `bvh/worker`: a build failed in its worker, or there are no workers. Build by `buildBlas()`.
 * - `bvh/destroyed`: workers or a GPU builder were used after `destroy()`. Create them again.
 * - `bvh/not-serialized`: the bytes are not a stored hierarchy. Build it again.
 * - `bvh/version`: a stored hierarchy has another version of the format. Build it again.
 * - `bvh/truncated`: a stored hierarchy ends early. Build it again.
 * - `bvh/checksum`: a stored hierarchy was changed since. Build it again.
 * - `bvh/corrupt`: a stored hierarchy has references that lead outside of it. Build it again.
 * - `bvh/other-mesh`: a stored hierarchy belongs to another mesh. Build it again.
 * - `bvh/limit`: a build on the GPU binds more than the device allows. Request higher limits, split the mesh, or
 *   build by `buildBlas()`.
 * - `bvh/memory`: the GPU has no memory left for a build. Free memory, split the mesh, or build by `buildBlas()`.
 * - `bvh/pipeline`: the driver does not compile a shader. Update it.
 * - `bvh/device`: the device was lost during a build. Request another one and build again.
 */
export class BvhError extends GlanzError {}
