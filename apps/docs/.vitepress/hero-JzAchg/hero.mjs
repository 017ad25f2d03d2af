// ../../packages/wgsl/src/error.ts
var GlanzError = class extends Error {
  /** Stable, machine-readable: `<package>/<what>`, e.g. `bvh/empty-mesh`. */
  code;
  /** Where it happened, as far as it is known. */
  location;
  constructor(code, message, options = {}) {
    super(message, options.cause === void 0 ? void 0 : { cause: options.cause });
    this.name = new.target.name;
    this.code = code;
    this.location = options.location;
  }
};

// ../../packages/scene/src/scene.ts
function createScene(name) {
  return { ...name === void 0 ? {} : { name }, meshes: [], materials: [], images: [], textures: [], instances: [], lights: [], cameras: [], warnings: [] };
}

// ../../packages/scene/src/bounds.ts
function sceneBounds(scene) {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (const instance of scene.instances) {
    const mesh = scene.meshes[instance.mesh];
    if (instance.visible !== false && mesh) growByMesh(mesh, instance, min, max);
  }
  return { min, max };
}
function growByMesh({ positions, indices }, { transform: m }, min, max) {
  for (const r of [0, 1, 2]) {
    const a = m[r], b = m[4 + r], c = m[8 + r], d = m[12 + r];
    let low = min[r], high = max[r];
    for (let i = 0; i < indices.length; i++) {
      const v = 3 * indices[i];
      const x = a * positions[v] + b * positions[v + 1] + c * positions[v + 2] + d;
      if (x < low) low = x;
      if (x > high) high = x;
    }
    min[r] = low;
    max[r] = high;
  }
}

// ../../packages/scene/src/error.ts
var SceneError = class extends GlanzError {
};

// ../../packages/scene/src/frame-camera.ts
var dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
var cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
function normalized(v, what) {
  const length2 = Math.hypot(...v);
  if (!(length2 > 1e-12) || !Number.isFinite(length2)) throw new SceneError("scene/value", `${what} is [${v.join(", ")}], which gives no direction.`);
  return [v[0] / length2, v[1] / length2, v[2] / length2];
}
function growByInstance(extents, { positions, indices }, m, center, axes, tx, ty) {
  const column = (k) => [m[4 * k], m[4 * k + 1], m[4 * k + 2]];
  const origin = column(3);
  const moved = [origin[0] - center[0], origin[1] - center[1], origin[2] - center[2]];
  const [[rx, ry, rz, rw], [ux, uy, uz, uw], [bx, by, bz, bw]] = axes.map((axis3) => [dot(axis3, column(0)), dot(axis3, column(1)), dot(axis3, column(2)), dot(axis3, moved)]);
  let { right, left, top, bottom, near, far } = extents;
  for (let i = 0; i < indices.length; i++) {
    const v = 3 * indices[i];
    const px = positions[v], py = positions[v + 1], pz = positions[v + 2];
    const r = rx * px + ry * py + rz * pz + rw;
    const u = ux * px + uy * py + uz * pz + uw;
    const b = bx * px + by * py + bz * pz + bw;
    right = Math.max(right, r + tx * b);
    left = Math.max(left, tx * b - r);
    top = Math.max(top, u + ty * b);
    bottom = Math.max(bottom, ty * b - u);
    near = Math.max(near, b);
    far = Math.min(far, b);
  }
  Object.assign(extents, { right, left, top, bottom, near, far });
}
function frameCamera(scene, { aspect, yfov = 35 * Math.PI / 180, direction: direction2 = [0.6, 0.45, 1], margin = 0.06 }) {
  if (!(aspect > 0 && aspect < Infinity)) throw new SceneError("scene/value", `aspect is ${aspect}; it must be a positive number.`);
  if (!(yfov > 0 && yfov < Math.PI)) throw new SceneError("scene/value", `yfov is ${yfov}; it must lie between 0 and \u03C0.`);
  if (!(margin >= 0 && margin < 1)) throw new SceneError("scene/value", `margin is ${margin}; it must be at least 0 and less than 1.`);
  const { min, max } = sceneBounds(scene);
  if (!(min[0] <= max[0])) throw new SceneError("scene/empty", "The scene has no visible triangles: there is nothing to frame.");
  const center = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
  const back = normalized(direction2, "direction");
  const right = normalized(cross([0, 1, 0], back), "direction, seen from above,");
  const up = cross(back, right);
  const ty = Math.tan(yfov / 2) * (1 - margin);
  const tx = ty * aspect;
  const e = { right: -Infinity, left: -Infinity, top: -Infinity, bottom: -Infinity, near: -Infinity, far: Infinity };
  for (const { mesh, transform: transform2, visible } of scene.instances) {
    if (visible !== false && scene.meshes[mesh]) growByInstance(e, scene.meshes[mesh], transform2, center, [right, up, back], tx, ty);
  }
  const x = (e.right - e.left) / 2;
  const y = (e.top - e.bottom) / 2;
  let d = Math.max((e.right + e.left) / (2 * tx), (e.top + e.bottom) / (2 * ty));
  if (!(d > e.near)) d = e.near + (e.near - e.far || 1);
  const eye = [0, 1, 2].map((k) => center[k] + right[k] * x + up[k] * y + back[k] * d);
  return { type: "perspective", name: "framed", transform: [...right, 0, ...up, 0, ...back, 0, ...eye, 1], yfov, aspect, focus_distance: d - (e.near + e.far) / 2 };
}

// ../../packages/scene/src/validate.ts
var fail = (code, message) => {
  throw new SceneError(`scene/${code}`, message);
};
function reference(index, list2, what, kind) {
  if (!(Number.isInteger(index) && index >= 0 && index < list2.length)) fail("reference", `${what} refers to ${kind} ${index}; the scene has ${list2.length}.`);
}
function finite(values, what) {
  for (let i = 0; i < values.length; i++) {
    if (!Number.isFinite(values[i])) fail("not-finite", `${what} holds ${values[i]} at ${i}; every number must be finite.`);
  }
}
function length(values, expected, what) {
  if (values.length !== expected) fail("length", `${what} has ${values.length} numbers; it must have ${expected}.`);
}
function isFlat(p, a, b, c) {
  const ax = p[a], ay = p[a + 1], az = p[a + 2];
  const ux = p[b] - ax, uy = p[b + 1] - ay, uz = p[b + 2] - az;
  const vx = p[c] - ax, vy = p[c + 1] - ay, vz = p[c + 2] - az;
  return uy * vz === uz * vy && uz * vx === ux * vz && ux * vy === uy * vx;
}
function checkMesh(mesh, index, warnings) {
  const what = `Mesh ${index} ("${mesh.name}")`;
  const { positions, indices } = mesh;
  if (positions.length % 3 !== 0) fail("length", `${what}: positions has ${positions.length} numbers; it must have three a vertex.`);
  if (indices.length % 3 !== 0) fail("length", `${what}: indices has ${indices.length} entries; it must have three a triangle.`);
  const vertices = positions.length / 3;
  finite(positions, `${what}: positions`);
  let flat = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const a = indices[i], b = indices[i + 1], c = indices[i + 2];
    if (a >= vertices || b >= vertices || c >= vertices) fail("reference", `${what}: triangle ${i / 3} refers to vertex ${Math.max(a, b, c)}; the mesh has ${vertices}.`);
    if (a === b || b === c || a === c || isFlat(positions, 3 * a, 3 * b, 3 * c)) flat++;
  }
  if (flat > 0) warnings.push({ code: "scene/degenerate", message: `${what} has ${flat} triangle${flat === 1 ? "" : "s"} without area; nothing hits ${flat === 1 ? "it" : "them"}.`, path: `/meshes/${index}` });
  const attribute = (values, stride, name) => {
    if (!values) return;
    length(values, stride * vertices, `${what}: ${name}`);
    finite(values, `${what}: ${name}`);
  };
  attribute(mesh.normals, 3, "normals");
  attribute(mesh.tangents, 4, "tangents");
  attribute(mesh.colors, 4, "colors");
  mesh.uvs?.forEach((uv, set) => attribute(uv, 2, `uvs[${set}]`));
}
function checkMaterial(scene, material, index) {
  const what = `Material ${index} ("${material.name}")`;
  for (const [name, value] of Object.entries(material.parameters)) {
    if (typeof value === "number") finite([value], `${what}: ${name}`);
    else if (Array.isArray(value)) finite(value, `${what}: ${name}`);
  }
  for (const [name, binding] of Object.entries(material.textures ?? {})) {
    if (!binding) continue;
    reference(binding.texture, scene.textures, `${what}: ${name}`, "texture");
    if (binding.transform) {
      length(binding.transform, 6, `${what}: the transform of ${name}`);
      finite(binding.transform, `${what}: the transform of ${name}`);
    }
  }
}
function checkTransform(transform2, what) {
  length(transform2, 16, `${what}: transform`);
  finite(transform2, `${what}: transform`);
}
function spread(m) {
  const [a, b, c, d, e, f, g, h, i] = [0, 1, 2, 4, 5, 6, 8, 9, 10].map((k) => m[k]);
  const lengths = Math.hypot(a, b, c) * Math.hypot(d, e, f) * Math.hypot(g, h, i);
  return lengths > 0 ? (a * (e * i - f * h) - d * (b * i - c * h) + g * (b * f - c * e)) / lengths : 0;
}
function checkLight(light, index) {
  const what = `Light ${index} ("${light.name}")`;
  finite([light.intensity, ...light.color], what);
  if (light.intensity < 0 || light.color.some((c) => c < 0)) fail("value", `${what} has a negative intensity or colour.`);
  if (light.type !== "directional") finite(light.position, `${what}: position`);
  if (light.type !== "point") {
    finite(light.direction, `${what}: direction`);
    if (!(Math.hypot(...light.direction) > 0)) fail("value", `${what}: direction has no length.`);
  }
  if (light.type === "spot" && !(light.inner_cone_angle >= 0 && light.inner_cone_angle <= light.outer_cone_angle && light.outer_cone_angle <= Math.PI / 2 + 1e-6)) {
    fail("value", `${what} has cone angles ${light.inner_cone_angle} and ${light.outer_cone_angle}; they must satisfy 0 \u2264 inner \u2264 outer \u2264 \u03C0/2.`);
  }
}
function checkCamera(camera2, index) {
  const what = `Camera ${index} ("${camera2.name}")`;
  checkTransform(camera2.transform, what);
  if (!(Math.abs(spread(camera2.transform)) > 1e-6)) fail("value", `${what}: transform cannot be inverted: its axes have no length or lie in one plane.`);
  if (camera2.type === "perspective") {
    if (!(camera2.yfov > 0 && camera2.yfov < Math.PI)) fail("value", `${what}: yfov is ${camera2.yfov}; it must lie between 0 and \u03C0.`);
    finite([camera2.lens_radius ?? 0, camera2.focus_distance ?? 1], `${what}: lens`);
  } else if (!(camera2.xmag > 0 && camera2.ymag > 0)) fail("value", `${what}: xmag and ymag are ${camera2.xmag} and ${camera2.ymag}; they must be positive.`);
}
function checkEnvironment(environment2) {
  if (environment2.type === "constant") {
    finite(environment2.radiance, "The environment");
    if (environment2.radiance.some((c) => c < 0)) fail("value", "The environment has a negative radiance.");
    return;
  }
  const { width, height, data, intensity = 1, rotation = 0 } = environment2;
  if (!(Number.isInteger(width) && Number.isInteger(height) && width > 0 && height > 0)) fail("value", `The environment has a size of ${width} \xD7 ${height}.`);
  length(data, 3 * width * height, `The environment of ${width} \xD7 ${height} pixels`);
  finite([intensity, rotation], "The environment");
  for (let i = 0; i < data.length; i++) {
    if (!(data[i] >= 0 && data[i] < Infinity)) fail("not-finite", `The environment holds ${data[i]} at ${i}; radiance must be finite and not negative.`);
  }
}
function validateScene(scene) {
  const warnings = [];
  scene.meshes.forEach((mesh, index) => checkMesh(mesh, index, warnings));
  scene.images.forEach((image, index) => {
    const what = `Image ${index} ("${image.name}")`;
    if (!(Number.isInteger(image.width) && Number.isInteger(image.height) && image.width > 0 && image.height > 0)) fail("value", `${what} has a size of ${image.width} \xD7 ${image.height}.`);
    length(image.data, 4 * image.width * image.height, `${what} of ${image.width} \xD7 ${image.height} pixels`);
    if (image.data instanceof Float32Array) finite(image.data, what);
  });
  scene.textures.forEach((texture, index) => reference(texture.image, scene.images, `Texture ${index}`, "image"));
  scene.materials.forEach((material, index) => checkMaterial(scene, material, index));
  scene.instances.forEach((instance, index) => {
    const what = `Instance ${index} ("${instance.name}")`;
    reference(instance.mesh, scene.meshes, what, "mesh");
    reference(instance.material, scene.materials, what, "material");
    checkTransform(instance.transform, what);
    if (spread(instance.transform) === 0) warnings.push({ code: "scene/flattened", message: `${what} is flattened by its transform; it does not appear.`, path: `/instances/${index}` });
    const { textures = {} } = scene.materials[instance.material];
    const sets = scene.meshes[instance.mesh].uvs?.length ?? 0;
    for (const [name, binding] of Object.entries(textures)) {
      const set = binding?.uv ?? 0;
      if (binding && set >= sets) warnings.push({ code: "scene/missing-uv", message: `${what} has no UV set ${set}, which the texture of ${name} wants; it is read at (0, 0).`, path: `/instances/${index}` });
    }
  });
  scene.lights.forEach(checkLight);
  scene.cameras.forEach(checkCamera);
  if (scene.environment) checkEnvironment(scene.environment);
  return warnings;
}

// ../../tools/models/src/shapes/mesh-builder.ts
var Growing = class {
  #data = new Float64Array(1024);
  length = 0;
  push(a, b, c) {
    if (this.length + 3 > this.#data.length) {
      const larger = new Float64Array(this.#data.length * 2);
      larger.set(this.#data);
      this.#data = larger;
    }
    this.#data[this.length++] = a;
    this.#data[this.length++] = b;
    this.#data[this.length++] = c;
  }
  get view() {
    return this.#data.subarray(0, this.length);
  }
};
var METRES_PER_MILLIMETRE = 1e-3;
var MeshBuilder = class {
  #positions = new Growing();
  #normals = new Growing();
  #triangles = new Growing();
  /** Adds a vertex and gives its index. The normal need not be unit. */
  vertex(x, y, z, nx, ny, nz) {
    this.#positions.push(x, y, z);
    const length2 = Math.hypot(nx, ny, nz) || 1;
    this.#normals.push(nx / length2, ny / length2, nz / length2);
    return this.#positions.length / 3 - 1;
  }
  /** Adds a triangle, counter-clockwise from outside. */
  triangle(a, b, c) {
    this.#triangles.push(a, b, c);
  }
  /** Adds a quadrilateral, counter-clockwise from outside. */
  quad(a, b, c, d) {
    this.triangle(a, b, c);
    this.triangle(a, c, d);
  }
  /** Number of vertices so far. */
  get vertexCount() {
    return this.#positions.length / 3;
  }
  /** Moves all vertices from index `first` on. */
  transformFrom(first, matrix) {
    const [p, n] = [this.#positions.view, this.#normals.view];
    for (let i = first * 3; i < p.length; i += 3) {
      p.set(matrix(p[i], p[i + 1], p[i + 2], 1), i);
      n.set(matrix(n[i], n[i + 1], n[i + 2], 0), i);
    }
  }
  /** The mesh, in metres. */
  build(name) {
    return {
      name,
      positions: Float32Array.from(this.#positions.view, (value) => value * METRES_PER_MILLIMETRE),
      normals: Float32Array.from(this.#normals.view),
      indices: Uint32Array.from(this.#triangles.view)
    };
  }
};

// ../../tools/models/src/shapes/tessellation.ts
function arcSegments(radius, angle, { deviation, angle: step }) {
  const sweep = Math.abs(angle);
  if (sweep === 0 || radius <= 0) return 1;
  const byDeviation = radius > deviation ? sweep / (2 * Math.acos(1 - deviation / radius)) : 1;
  return Math.max(1, Math.ceil(Math.max(byDeviation, sweep / step) - 1e-9));
}
function circleSegments(radius, tessellation) {
  return Math.max(8, 4 * arcSegments(radius, Math.PI / 2, tessellation));
}
function isNegligible(size, { deviation }) {
  return size < 3.5 * deviation;
}

// ../../tools/models/src/shapes/triangulate.ts
var area = (a, b, c) => (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
function ring(loop, offset) {
  const nodes = loop.map(([x, y], i) => ({ index: offset + i, x, y }));
  for (const [i, node] of nodes.entries()) {
    node.next = nodes[(i + 1) % nodes.length];
    node.previous = nodes[(i + nodes.length - 1) % nodes.length];
  }
  return nodes[0];
}
function* around(start2) {
  let node = start2;
  do {
    yield node;
    node = node.next;
  } while (node !== start2);
}
var within = (a, b, c, p) => area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
var samePlace = (a, b) => a.x === b.x && a.y === b.y;
function cross2(a, b, c, d) {
  if (samePlace(a, c) || samePlace(a, d) || samePlace(b, c) || samePlace(b, d)) return false;
  return area(a, b, c) * area(a, b, d) <= 0 && area(c, d, a) * area(c, d, b) <= 0;
}
function opensInto(a, b) {
  return area(a.previous, a, a.next) >= 0 ? area(a, b, a.previous) > 0 && area(a, a.next, b) > 0 : !(area(a, b, a.next) >= 0 && area(a, a.previous, b) >= 0);
}
function clearWay(o, h, rings) {
  if (!opensInto(o, h) || !opensInto(h, o)) return false;
  for (const start2 of rings) for (const node of around(start2)) if (cross2(o, h, node, node.next)) return false;
  return true;
}
function bridge(outer, hole, rings) {
  const outside = [...around(outer)];
  for (const h of [...around(hole)].sort((a, b) => b.x - a.x)) {
    const distance2 = (o3) => (o3.x - h.x) ** 2 + (o3.y - h.y) ** 2;
    const o = outside.sort((a, b) => distance2(a) - distance2(b)).find((node) => clearWay(node, h, rings));
    if (!o) continue;
    const o2 = { index: o.index, x: o.x, y: o.y };
    const h2 = { index: h.index, x: h.x, y: h.y };
    o2.next = o.next;
    o2.next.previous = o2;
    h2.previous = h.previous;
    h2.previous.next = h2;
    o.next = h;
    h.previous = o;
    h2.next = o2;
    o2.previous = h2;
    return o;
  }
  throw new RangeError("triangulate: a hole has no clear way to its surroundings");
}
function triangulate(outer, holes = []) {
  let start2 = ring(outer, 0);
  let count = outer.length;
  const rest = [];
  for (const hole of holes) {
    rest.push(ring(hole, count));
    count += hole.length;
  }
  let remaining = count + 2 * holes.length;
  while (rest.length > 0) {
    const hole = rest.shift();
    start2 = bridge(start2, hole, [start2, hole, ...rest]);
  }
  const triangles = [];
  const reflex = /* @__PURE__ */ new Set();
  for (const node2 of around(start2)) if (area(node2.previous, node2, node2.next) <= 0) reflex.add(node2);
  const isEar = (node2, minimum) => {
    const [a, c] = [node2.previous, node2.next];
    if (!(area(a, node2, c) > minimum)) return false;
    for (const p of reflex) if (p !== a && p !== node2 && p !== c && !samePlace(p, a) && !samePlace(p, node2) && !samePlace(p, c) && within(a, node2, c, p)) return false;
    return true;
  };
  let node = start2;
  let idle = 0;
  while (remaining > 3) {
    if (isEar(node, idle > remaining ? -1e-12 : 1e-12)) {
      const [a, c] = [node.previous, node.next];
      triangles.push(a.index, node.index, c.index);
      a.next = c;
      c.previous = a;
      reflex.delete(node);
      for (const touched of [a, c]) {
        if (area(touched.previous, touched, touched.next) > 0) reflex.delete(touched);
        else reflex.add(touched);
      }
      remaining--;
      node = c.next;
      idle = 0;
    } else {
      node = node.next;
      if (++idle > 2 * remaining + 2) throw new RangeError("triangulate: the outline crosses itself");
    }
  }
  triangles.push(node.previous.index, node.index, node.next.index);
  return triangles;
}

// ../../tools/models/src/shapes/extrude.ts
function levels({ bottom, top, bottomRadius = 0, topRadius = 0, tessellation }) {
  const result = [];
  const arc = (radius, from, z) => {
    const steps = arcSegments(radius, Math.PI / 2, tessellation);
    for (let i = 0; i <= steps; i++) {
      const angle = from + Math.PI / 2 * i / steps;
      result.push({ inset: radius * (1 - Math.cos(angle)), z: z + radius * Math.sin(angle), across: Math.cos(angle), along: Math.sin(angle) });
    }
  };
  if (!isNegligible(bottomRadius, tessellation)) arc(bottomRadius, -Math.PI / 2, bottom + bottomRadius);
  else result.push({ inset: 0, z: bottom, across: 1, along: 0 });
  if (!isNegligible(topRadius, tessellation)) arc(topRadius, 0, top - topRadius);
  else result.push({ inset: 0, z: top, across: 1, along: 0 });
  return result.filter((level, i) => i === 0 || Math.hypot(level.z - result[i - 1].z, level.inset - result[i - 1].inset) > 1e-9);
}
var place = (p, inset) => [p.x - p.mx * inset, p.y - p.my * inset];
var insetOf = (loop, inset) => typeof loop === "function" ? loop(inset).map((p) => [p.x, p.y]) : loop.map((p) => place(p, inset));
function extrude(builder, outer, holes, options) {
  const wall = levels(options);
  const sources2 = [outer, ...holes];
  for (const source of sources2) {
    const loop = typeof source === "function" ? source(0) : source;
    const n = loop.length;
    const first = builder.vertexCount;
    for (const { inset, z, across, along } of wall) {
      for (const [i, [x, y]] of insetOf(source, inset).entries()) builder.vertex(x, y, z, loop[i].nx * across, loop[i].ny * across, along);
    }
    for (let l = 0; l + 1 < wall.length; l++) {
      for (let i = 0; i < n; i++) {
        const j = (i + 1) % n;
        if (loop[i].x === loop[j].x && loop[i].y === loop[j].y) continue;
        builder.quad(first + l * n + i, first + l * n + j, first + (l + 1) * n + j, first + (l + 1) * n + i);
      }
    }
  }
  for (const [level, up] of [
    [wall[0], -1],
    [wall[wall.length - 1], 1]
  ]) {
    const loops = sources2.map((source) => {
      const flat = typeof source === "function" ? source(0) : source;
      return insetOf(source, level.inset).filter((_, i) => {
        const next = flat[(i + 1) % flat.length];
        return flat[i].x !== next.x || flat[i].y !== next.y;
      });
    });
    const first = builder.vertexCount;
    for (const loop of loops) for (const [x, y] of loop) builder.vertex(x, y, level.z, 0, 0, up);
    const triangles = triangulate(loops[0], loops.slice(1));
    for (let i = 0; i < triangles.length; i += 3) {
      const [a, b, c] = [first + triangles[i], first + triangles[i + 1], first + triangles[i + 2]];
      if (up > 0) builder.triangle(a, b, c);
      else builder.triangle(a, c, b);
    }
  }
}

// ../../tools/models/src/shapes/outline.ts
var point = (x, y, nx, ny, mx = nx, my = ny) => ({ x, y, nx, ny, mx, my });
function direction(a, b) {
  const x = b.x - a.x;
  const y = b.y - a.y;
  const length2 = Math.hypot(x, y);
  if (length2 === 0) throw new RangeError(`outline: two corners in one place, (${a.x}, ${a.y})`);
  return { x: x / length2, y: y / length2, length: length2 };
}
function corner(c, before, after, tessellation, out) {
  const cross4 = before.x * after.y - before.y * after.x;
  const dot4 = before.x * after.x + before.y * after.y;
  const turn = Math.atan2(cross4, dot4);
  if (Math.abs(turn) < 1e-9) {
    out.push(point(c.x, c.y, before.y, -before.x));
    return;
  }
  const n0 = { x: before.y, y: -before.x };
  const n1 = { x: after.y, y: -after.x };
  const r = c.r ?? 0;
  if (isNegligible(r, tessellation)) {
    const scale = 1 / (1 + dot4);
    const mx = (n0.x + n1.x) * scale;
    const my = (n0.y + n1.y) * scale;
    out.push(point(c.x, c.y, n0.x, n0.y, mx, my), point(c.x, c.y, n1.x, n1.y, mx, my));
    return;
  }
  const tangent = r * Math.tan(Math.abs(turn) / 2);
  const side = Math.sign(turn);
  const start2 = { x: c.x - before.x * tangent, y: c.y - before.y * tangent };
  const centre = { x: start2.x - side * n0.x * r, y: start2.y - side * n0.y * r };
  const steps = arcSegments(r, turn, tessellation);
  for (let i = 0; i <= steps; i++) {
    const angle = turn * i / steps;
    const cos = Math.cos(angle);
    const sin = Math.sin(angle);
    const nx = n0.x * cos - n0.y * sin;
    const ny = n0.x * sin + n0.y * cos;
    out.push(point(centre.x + side * nx * r, centre.y + side * ny * r, nx, ny));
  }
}
function tangentLength(before, after, r = 0) {
  return r * Math.tan(Math.abs(Math.atan2(before.x * after.y - before.y * after.x, before.x * after.x + before.y * after.y)) / 2);
}
function checkRadii(corners, closed) {
  const n = corners.length;
  const taken = corners.map((c, i) => {
    if (!closed && (i === 0 || i === n - 1)) return 0;
    return tangentLength(direction(corners[(i + n - 1) % n], c), direction(c, corners[(i + 1) % n]), c.r);
  });
  for (let i = 0; i < (closed ? n : n - 1); i++) {
    const [c, next] = [corners[i], corners[(i + 1) % n]];
    const { length: length2 } = direction(c, next);
    if (taken[i] + taken[(i + 1) % n] > length2 + 1e-9) throw new RangeError(`outline: the radii at (${c.x}, ${c.y}) and (${next.x}, ${next.y}) do not fit between them`);
  }
}
function tidy(points, closed) {
  const same = (a, b) => Math.hypot(a.x - b.x, a.y - b.y) < 1e-7;
  const result = [];
  for (const p of points) {
    const last2 = result[result.length - 1];
    if (last2 && same(last2, p)) {
      if (Math.hypot(last2.nx - p.nx, last2.ny - p.ny) < 1e-6) continue;
      result.push({ ...p, x: last2.x, y: last2.y });
    } else result.push(p);
  }
  const [first, last] = [result[0], result[result.length - 1]];
  if (closed && result.length > 1 && same(first, last)) {
    if (Math.hypot(first.nx - last.nx, first.ny - last.ny) < 1e-6) result.pop();
    else result[result.length - 1] = { ...last, x: first.x, y: first.y };
  }
  return result;
}
function closedOutline(corners, tessellation) {
  checkRadii(corners, true);
  const n = corners.length;
  const out = [];
  for (let i = 0; i < n; i++) {
    const c = corners[i];
    corner(c, direction(corners[(i + n - 1) % n], c), direction(c, corners[(i + 1) % n]), tessellation, out);
  }
  return tidy(out, true);
}
function openOutline(corners, tessellation) {
  checkRadii(corners, false);
  const out = [];
  for (const [i, c] of corners.entries()) {
    const before = i > 0 ? direction(corners[i - 1], c) : void 0;
    const after = i + 1 < corners.length ? direction(c, corners[i + 1]) : void 0;
    if (before && after) corner(c, before, after, tessellation, out);
    else {
      const d = before ?? after;
      out.push(point(c.x, c.y, d.y, -d.x));
    }
  }
  return tidy(out, false);
}
function circleOutline(x, y, radius, segments, hole = false) {
  const result = [];
  for (let i = 0; i < segments; i++) {
    const angle = (hole ? -i : i) / segments * 2 * Math.PI;
    const cos = Math.cos(angle);
    const sin = Math.sin(angle);
    const sign = hole ? -1 : 1;
    result.push(point(x + radius * cos, y + radius * sin, sign * cos, sign * sin));
  }
  return result;
}
function rectangle(x, y, width, height, r = 0) {
  const [w, h] = [width / 2, height / 2];
  return [
    { x: x - w, y: y - h, r },
    { x: x + w, y: y - h, r },
    { x: x + w, y: y + h, r },
    { x: x - w, y: y + h, r }
  ];
}

// ../../tools/models/src/shapes/revolve.ts
function revolve(builder, profile, segments, closed) {
  const first = builder.vertexCount;
  const cos = [];
  const sin = [];
  for (let j = 0; j < segments; j++) {
    cos.push(Math.cos(j / segments * 2 * Math.PI));
    sin.push(Math.sin(j / segments * 2 * Math.PI));
  }
  for (const p of profile) {
    const radius = Math.abs(p.x) < 1e-9 ? 0 : p.x;
    for (let j = 0; j < segments; j++) builder.vertex(radius * cos[j], radius * sin[j], p.y, p.nx * cos[j], p.nx * sin[j], p.ny);
  }
  const n = profile.length;
  for (let i = 0; i < (closed ? n : n - 1); i++) {
    const next = (i + 1) % n;
    const [p, q] = [profile[i], profile[next]];
    if (p.x === q.x && p.y === q.y) continue;
    for (let j = 0; j < segments; j++) {
      const k = (j + 1) % segments;
      const [a, b, c, d] = [first + i * segments + j, first + i * segments + k, first + next * segments + k, first + next * segments + j];
      if (Math.abs(p.x) < 1e-9) builder.triangle(a, c, d);
      else if (Math.abs(q.x) < 1e-9) builder.triangle(a, b, c);
      else builder.quad(a, b, c, d);
    }
  }
}

// ../../tools/models/src/shapes/thread.ts
function threadProfile(turn) {
  const phase = turn - Math.floor(turn);
  const slope = (1 - Math.abs(2 * phase - 1)) * 1.6 - 0.3;
  const s = Math.min(Math.max(slope, 0), 1);
  return s * s * (3 - 2 * s);
}
function threadedRod(builder, { radius, depth, pitch, bottom, top, tessellation }) {
  const segments = circleSegments(radius, tessellation);
  const rows = Math.round(circleSegments(pitch / 3, tessellation) / 2);
  const plain = rows < 6;
  const turns = (top - bottom) / pitch;
  const steps = plain ? 1 : Math.ceil(turns * rows);
  const height = (angle, z) => {
    if (plain) return radius - depth / 2;
    const run = Math.min((z - bottom) / pitch, (top - z) / pitch, 1);
    return radius - depth + depth * threadProfile((z - bottom) / pitch - angle / (2 * Math.PI)) * Math.max(run, 0);
  };
  const first = builder.vertexCount;
  const h = pitch * 1e-3;
  for (let i = 0; i <= steps; i++) {
    const z = i === steps ? top : bottom + (top - bottom) * i / steps;
    for (let j = 0; j < segments; j++) {
      const angle = j / segments * 2 * Math.PI;
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      const r = height(angle, z);
      const dz = (height(angle, z + h) - height(angle, z - h)) / (2 * h);
      const da = (height(angle + h, z) - height(angle - h, z)) / (2 * h);
      builder.vertex(r * cos, r * sin, z, cos + sin * da / r, sin - cos * da / r, -dz);
    }
  }
  for (let i = 0; i < steps; i++) {
    for (let j = 0; j < segments; j++) {
      const k = (j + 1) % segments;
      builder.quad(first + i * segments + j, first + i * segments + k, first + (i + 1) * segments + k, first + (i + 1) * segments + j);
    }
  }
  for (const [z, up] of [
    [bottom, -1],
    [top, 1]
  ]) {
    const rim = builder.vertexCount;
    for (let j = 0; j < segments; j++) {
      const angle = j / segments * 2 * Math.PI;
      const r = height(angle, z);
      builder.vertex(r * Math.cos(angle), r * Math.sin(angle), z, 0, 0, up);
    }
    for (let j = 1; j + 1 < segments; j++) {
      if (up > 0) builder.triangle(rim, rim + j, rim + j + 1);
      else builder.triangle(rim, rim + j + 1, rim + j);
    }
  }
}

// ../../tools/models/src/shapes/screw.ts
function halfMoon(radius, line, angle, tessellation) {
  const steps = Math.max(3, arcSegments(radius, 2 * Math.acos(line / radius), tessellation));
  const turn = (x, y) => [x * Math.cos(angle) - y * Math.sin(angle), x * Math.sin(angle) + y * Math.cos(angle)];
  const [cx, cy] = turn(-1, 0);
  return (inset) => {
    const r = radius - inset;
    const end = Math.acos((line + inset) / r);
    const arc = Array.from({ length: steps + 1 }, (_, i) => {
      const [nx, ny] = turn(Math.cos(-end + 2 * end * i / steps), Math.sin(-end + 2 * end * i / steps));
      return { x: r * nx, y: r * ny, nx, ny, mx: nx, my: ny };
    });
    const chord = { nx: cx, ny: cy, mx: cx, my: cy };
    return [{ ...arc[0], ...chord }, ...arc, { ...arc[steps], ...chord }];
  };
}
function slottedScrew(builder, options) {
  const { headRadius: radius, headHeight: height, slotWidth, slotDepth, shankRadius, shankLength, pitch, tessellation } = options;
  threadedRod(builder, { radius: shankRadius, depth: shankRadius * 0.18, pitch, bottom: -shankLength, top: 0.05, tessellation });
  const floor = height - slotDepth;
  const edge = Math.min(0.15, floor / 3);
  revolve(
    builder,
    openOutline(
      [
        { x: 0, y: 0 },
        { x: radius, y: 0, r: edge },
        { x: radius, y: floor },
        { x: 0, y: floor }
      ],
      tessellation
    ),
    circleSegments(radius, tessellation),
    false
  );
  const round = Math.min(0.28, slotDepth * 0.45);
  for (const half of [0, Math.PI]) {
    const outline = halfMoon(radius, slotWidth / 2, (options.slotAngle ?? 0) + half, tessellation);
    extrude(builder, outline, [], { bottom: floor - 0.02, top: height, topRadius: round, tessellation });
  }
}

// ../../tools/models/src/shapes/tube.ts
var subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
var crossed = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
var dot2 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
var unit = (a) => {
  const length2 = Math.hypot(...a);
  return [a[0] / length2, a[1] / length2, a[2] / length2];
};
function tube(builder, curve, radius, steps, segments) {
  const centres = Array.from({ length: steps + 1 }, (_, i) => curve(i / steps));
  const tangents = centres.map((_, i) => unit(subtract(centres[Math.min(i + 1, steps)], centres[Math.max(i - 1, 0)])));
  const t0 = tangents[0];
  let side = unit(crossed(t0, Math.abs(t0[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  const sides = [side];
  for (let i = 0; i < steps; i++) {
    const v1 = subtract(centres[i + 1], centres[i]);
    const c1 = dot2(v1, v1);
    const reflect = (v, axis3, c) => {
      const k = 2 / c * dot2(axis3, v);
      return [v[0] - k * axis3[0], v[1] - k * axis3[1], v[2] - k * axis3[2]];
    };
    const sideL = reflect(side, v1, c1);
    const tangentL = reflect(tangents[i], v1, c1);
    const v2 = subtract(tangents[i + 1], tangentL);
    const c2 = dot2(v2, v2);
    side = unit(c2 > 1e-20 ? reflect(sideL, v2, c2) : sideL);
    sides.push(side);
  }
  const first = builder.vertexCount;
  const at = (i, j) => {
    const u = sides[i];
    const v = crossed(tangents[i], u);
    const angle = j / segments * 2 * Math.PI;
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    const n = [u[0] * cos + v[0] * sin, u[1] * cos + v[1] * sin, u[2] * cos + v[2] * sin];
    const c = centres[i];
    return { p: [c[0] + n[0] * radius, c[1] + n[1] * radius, c[2] + n[2] * radius], n };
  };
  for (let i = 0; i <= steps; i++) {
    for (let j = 0; j < segments; j++) {
      const { p, n } = at(i, j);
      builder.vertex(...p, ...n);
    }
  }
  for (let i = 0; i < steps; i++) {
    for (let j = 0; j < segments; j++) {
      const k = (j + 1) % segments;
      builder.quad(first + i * segments + j, first + i * segments + k, first + (i + 1) * segments + k, first + (i + 1) * segments + j);
    }
  }
  for (const [i, sign] of [
    [0, -1],
    [steps, 1]
  ]) {
    const t = tangents[i];
    const n = [t[0] * sign, t[1] * sign, t[2] * sign];
    const rim = builder.vertexCount;
    for (let j = 0; j < segments; j++) builder.vertex(...at(i, j).p, ...n);
    for (let j = 1; j + 1 < segments; j++) {
      if (sign > 0) builder.triangle(rim, rim + j, rim + j + 1);
      else builder.triangle(rim, rim + j + 1, rim + j);
    }
  }
}
function spline(points) {
  const n = points.length - 1;
  return (t) => {
    const s = Math.min(Math.max(t, 0), 1) * n;
    const i = Math.min(Math.floor(s), n - 1);
    const f = s - i;
    const [b, c] = [points[i], points[i + 1]];
    const a = points[i - 1] ?? [2 * b[0] - c[0], 2 * b[1] - c[1], 2 * b[2] - c[2]];
    const d = points[i + 2] ?? [2 * c[0] - b[0], 2 * c[1] - b[1], 2 * c[2] - b[2]];
    const at = (k) => 0.5 * (2 * b[k] + (c[k] - a[k]) * f + (2 * a[k] - 5 * b[k] + 4 * c[k] - d[k]) * f * f + (3 * b[k] - a[k] - 3 * c[k] + d[k]) * f ** 3);
    return [at(0), at(1), at(2)];
  };
}

// ../../tools/models/src/push-button/contact-block.ts
var WIDTH = 10.2;
var BODY = [
  { x: -13.5, y: 0, r: 0.6 },
  { x: 13.5, y: 0, r: 0.6 },
  { x: 13.5, y: 4.5, r: 0.5 },
  { x: 15.5, y: 6, r: 0.5 },
  { x: 15.5, y: 9.5, r: 0.5 },
  { x: 11.2, y: 9.5, r: 0.45 },
  { x: 11.2, y: 20.5, r: 0.6 },
  { x: 9.2, y: 23, r: 1.2 },
  { x: -9.2, y: 23, r: 1.2 },
  { x: -11.2, y: 20.5, r: 0.6 },
  { x: -11.2, y: 9.5, r: 0.45 },
  { x: -15.5, y: 9.5, r: 0.5 },
  { x: -15.5, y: 6, r: 0.5 },
  { x: -13.5, y: 4.5, r: 0.5 }
];
function terminal({ name, x, wire, swing }, side) {
  const label = `${name} terminal ${side > 0 ? "top" : "bottom"}`;
  const y = side * 11.2;
  const up = { x: [1, 0, 0], z: [0, side, 0] };
  return [
    {
      name: `${label} plate`,
      material: "brass",
      placement: { at: [x, y - side * 0.2, -35.4], ...up },
      shape: (b, t) => extrude(b, closedOutline(rectangle(0, 0, 7.4, 8.6, 0.8), t), [circleOutline(0, 0, 1.55, circleSegments(1.55, t), true)], { bottom: 0, top: 1.2, bottomRadius: 0.15, topRadius: 0.2, tessellation: t })
    },
    {
      name: `${label} clamp`,
      material: "zinc-plated steel",
      placement: { at: [x, y + side * 2.3, -35.4], ...up },
      shape: (b, t) => extrude(b, closedOutline(rectangle(0, 0, 6.6, 6.6, 1.1), t), [circleOutline(0, 0, 1.55, circleSegments(1.55, t), true)], { bottom: 0, top: 0.8, bottomRadius: 0.2, topRadius: 0.2, tessellation: t })
    },
    {
      name: `${label} screw`,
      material: "zinc-plated steel",
      placement: { at: [x, y + side * 3.1, -35.4], ...up },
      shape: (b, t) => slottedScrew(b, { headRadius: 2.7, headHeight: 2, slotWidth: 0.75, slotDepth: 1.2, shankRadius: 1.5, shankLength: 3.6, pitch: 0.7, slotAngle: 0.9 + x * 0.31 + side, tessellation: t })
    },
    {
      name: `${label} conductor`,
      material: "copper",
      shape: (b, t) => {
        const at = y + side * 1.65;
        const segments = Math.max(6, circleSegments(0.65, t));
        tube(b, (s) => [x + 2.05, at, -34.2 - s * 9.3], 0.65, 1, segments);
      }
    },
    {
      name: `${label} wire`,
      material: wire,
      shape: (b, t) => {
        const at = y + side * 1.65;
        const curve = spline([
          [x + 2.05, at, -40.6],
          [x + 2.05 + swing * 0.1, at + side * 0.6, -45],
          [x + 2.05 + swing * 0.5, at + side * 3.5, -50],
          [x + 2.05 + swing, at + side * 9.5, -54],
          [x + 2.05 + swing * 1.1, at + side * 17, -55.5]
        ]);
        tube(b, curve, 1.25, Math.max(6, Math.round(circleSegments(14, t) * 0.6)), Math.max(6, circleSegments(1.25, t)));
      }
    }
  ];
}
function block(options) {
  const { name, x, body, plunger } = options;
  const across = { x: [0, 1, 0], z: [-1, 0, 0] };
  return [
    {
      name: `${name} body`,
      material: body,
      placement: { at: [x + WIDTH / 2, 0, -20.3], ...across },
      shape: (b, t) => extrude(b, closedOutline(BODY, t), [], { bottom: 0.1, top: WIDTH - 0.1, bottomRadius: 0.35, topRadius: 0.35, tessellation: t })
    },
    {
      name: `${name} plunger`,
      material: plunger,
      placement: { at: [x, 0, -45.2] },
      shape: (b, t) => extrude(b, closedOutline(rectangle(0, 0, 5.6, 9, 1.1), t), [], { bottom: 0, top: 4, bottomRadius: 0.6, tessellation: t })
    },
    ...[-1, 1].map(
      (side) => ({
        name: `${name} clip ${side > 0 ? "top" : "bottom"}`,
        material: plunger,
        placement: { at: [x, side * 13.45, -24.6], x: [1, 0, 0], z: [0, side, 0] },
        shape: (b, t) => extrude(b, closedOutline(rectangle(0, 0, 4.6, 5.2, 0.7), t), [], { bottom: 0, top: 0.9, topRadius: 0.35, tessellation: t })
      })
    ),
    ...terminal(options, 1),
    ...terminal(options, -1)
  ];
}
function cover(name, x, side, material) {
  return {
    name: `${name} cover`,
    material,
    placement: { at: [x + side * WIDTH / 2 - side * 0.12, 0, -20.3], x: [0, side, 0], z: [side, 0, 0] },
    shape: (b, t) => {
      extrude(b, closedOutline(rectangle(0, -13.2, 17.6, 15.4, 1.6), t), [], { bottom: 0, top: 0.55, topRadius: 0.3, tessellation: t });
      for (let i = 0; i < 5; i++) extrude(b, closedOutline(rectangle(0, -15 - i * 1.15, 11, 0.6, 0.28), t), [], { bottom: 0.4, top: 1, topRadius: 0.24, tessellation: t });
      for (const px of [-6.2, 6.2]) extrude(b, circleOutline(px, -8.4, 1.25, circleSegments(1.25, t)), [], { bottom: 0.4, top: 0.85, topRadius: 0.25, tessellation: t });
    }
  };
}
var CONTACT_BLOCKS = [
  ...block({ name: "Contact block NC", x: -10.8, body: "polyamide black", plunger: "polyamide red", wire: "insulation black", swing: -4 }),
  cover("Contact block NC", -10.8, -1, "polyamide black"),
  ...block({ name: "Lamp block", x: 0, body: "polycarbonate white", plunger: "polycarbonate white", wire: "insulation red", swing: 1.5 }),
  ...block({ name: "Contact block NO", x: 10.8, body: "polyamide black", plunger: "polyamide green", wire: "insulation blue", swing: 6 }),
  cover("Contact block NO", 10.8, 1, "polyamide black")
];

// ../../tools/models/src/push-button/front.ts
function openRing(inner2, outer, gap, tessellation) {
  const steps = arcSegments(outer, 2 * Math.PI - 2 * gap, tessellation);
  return (inset) => {
    const arc = (radius, sign) => {
      const start2 = gap + Math.asin(inset / radius);
      const from = Math.PI / 2 + (sign > 0 ? start2 : 2 * Math.PI - start2);
      const sweep = sign * (2 * Math.PI - 2 * start2);
      return Array.from({ length: steps + 1 }, (_, i) => {
        const [c, s] = [Math.cos(from + sweep * i / steps), Math.sin(from + sweep * i / steps)];
        return { x: radius * c, y: radius * s, nx: sign * c, ny: sign * s, mx: sign * c, my: sign * s };
      });
    };
    const end = (angle, sign) => {
      const [nx, ny] = [-Math.sin(angle) * sign, Math.cos(angle) * sign];
      return { nx, ny, mx: nx, my: ny };
    };
    const [outside, inside] = [arc(outer - inset, 1), arc(inner2 + inset, -1)];
    const [first, second] = [end(Math.PI / 2 + gap, -1), end(Math.PI / 2 - gap, 1)];
    return [{ ...outside[0], ...first }, ...outside, { ...outside[steps], ...second }, { ...inside[0], ...second }, ...inside, { ...inside[steps], ...first }];
  };
}
var FRONT = [
  {
    name: "Seal",
    material: "rubber black",
    shape: (b, t) => {
      const profile = closedOutline([{ x: 11.2, y: 0 }, { x: 15.1, y: 0 }, { x: 15.1, y: 1.1, r: 0.5 }, { x: 11.2, y: 1.1 }], t);
      revolve(b, profile, circleSegments(15, t), true);
    }
  },
  {
    name: "Bezel ring",
    material: "bezel chrome",
    shape: (b, t) => {
      const profile = closedOutline(
        [
          { x: 11.5, y: 0.9 },
          { x: 14.7, y: 0.9, r: 0.2 },
          { x: 14.7, y: 2.4, r: 0.12 },
          { x: 14.35, y: 2.4, r: 0.12 },
          { x: 14.35, y: 2.9, r: 0.12 },
          { x: 14.7, y: 2.9, r: 0.12 },
          { x: 14.5, y: 5.2, r: 1.5 },
          { x: 12.9, y: 7.2, r: 0.9 },
          { x: 11.75, y: 6.9, r: 0.4 },
          { x: 11.5, y: 5.2, r: 0.3 }
        ],
        t
      );
      revolve(b, profile, circleSegments(14.7, t), true);
    }
  },
  {
    name: "Light ring",
    material: "halo light",
    shape: (b, t) => {
      const profile = closedOutline([{ x: 10.35, y: 1 }, { x: 11.45, y: 1 }, { x: 11.45, y: 6.1, r: 0.45 }, { x: 10.35, y: 6.1, r: 0.45 }], t);
      revolve(b, profile, circleSegments(11.4, t), true);
    }
  },
  {
    name: "Lens",
    material: "lens green",
    shape: (b, t) => {
      const profile = openOutline(
        [
          { x: 0, y: 1 },
          { x: 10.2, y: 1 },
          { x: 10.2, y: 8.8, r: 0.9 },
          { x: 8.9, y: 9.15, r: 0.6 },
          { x: 7.4, y: 8.4, r: 1.2 },
          { x: 0, y: 8.4 }
        ],
        t
      );
      revolve(b, profile, circleSegments(10.2, t), false);
    }
  },
  {
    name: "Legend arc",
    material: "legend white",
    placement: { at: [0, 0, 8.3] },
    shape: (b, t) => extrude(b, openRing(3.1, 4.1, 0.5, t), [], { bottom: 0, top: 0.25, topRadius: 0.12, tessellation: t })
  },
  {
    name: "Legend bar",
    material: "legend white",
    placement: { at: [0, 0, 8.3] },
    shape: (b, t) => extrude(b, closedOutline(rectangle(0, 3.2, 1, 3.6, 0.2), t), [], { bottom: 0, top: 0.25, topRadius: 0.12, tessellation: t })
  },
  {
    name: "Mounting plate",
    material: "plate aluminium",
    placement: { at: [0, 0, -2.5] },
    shape: (b, t) => {
      const holes = [circleOutline(0, 0, 11.25, circleSegments(11.25, t), true)];
      for (const x of [-20, 20]) for (const y of [-20, 20]) holes.push(circleOutline(x, y, 1.7, circleSegments(1.7, t), true));
      extrude(b, closedOutline(rectangle(0, 0, 50, 50, 5), t), holes, { bottom: 0, top: 2.5, bottomRadius: 0.4, topRadius: 0.4, tessellation: t });
    }
  }
];

// ../../tools/models/src/push-button/materials.ts
var metal = (name, base_color, specular_roughness) => ({ name, parameters: { base_metalness: 1, base_color, specular_roughness } });
var plastic = (name, base_color, specular_roughness) => ({ name, parameters: { base_color, specular_roughness } });
var glowing = (name, base_color, emission_color, emission_luminance, specular_roughness) => ({
  name,
  parameters: { base_color, specular_roughness, emission_color, emission_luminance }
});
var MATERIALS = {
  "bezel chrome": metal("bezel chrome", [0.77, 0.78, 0.8], 0.14),
  "plate aluminium": metal("plate aluminium", [0.56, 0.57, 0.59], 0.36),
  "zinc die-cast": metal("zinc die-cast", [0.5, 0.5, 0.51], 0.3),
  "zinc-plated steel": metal("zinc-plated steel", [0.62, 0.61, 0.58], 0.2),
  brass: metal("brass", [0.887, 0.7, 0.35], 0.24),
  copper: metal("copper", [0.926, 0.56, 0.42], 0.26),
  "lens green": glowing("lens green", [0.012, 0.33, 0.08], [0.03, 1, 0.2], 0.14, 0.06),
  "halo light": glowing("halo light", [0.5, 0.6, 0.5], [0.22, 1, 0.42], 3.2, 0.2),
  "legend white": glowing("legend white", [0.8, 0.8, 0.8], [1, 1, 1], 1.4, 0.3),
  "rubber black": plastic("rubber black", [0.018, 0.018, 0.019], 0.65),
  "polyamide black": plastic("polyamide black", [0.028, 0.029, 0.031], 0.38),
  "polyamide grey": plastic("polyamide grey", [0.33, 0.34, 0.35], 0.42),
  "polycarbonate white": plastic("polycarbonate white", [0.74, 0.73, 0.7], 0.26),
  "polyamide green": plastic("polyamide green", [0.02, 0.27, 0.08], 0.34),
  "polyamide red": plastic("polyamide red", [0.5, 0.02, 0.02], 0.34),
  "polyamide orange": plastic("polyamide orange", [0.82, 0.2, 0.015], 0.34),
  "insulation blue": plastic("insulation blue", [0.02, 0.07, 0.35], 0.32),
  "insulation red": plastic("insulation red", [0.48, 0.02, 0.02], 0.32),
  "insulation black": plastic("insulation black", [0.02, 0.02, 0.022], 0.32)
};

// ../../tools/models/src/push-button/mount.ts
function toothed(inner2, outer, count, share, r, t) {
  if (isNegligible((outer - inner2) / 2, t)) return circleOutline(0, 0, outer, circleSegments(outer, t));
  const corners = [];
  const step = 2 * Math.PI / count;
  for (let i = 0; i < count; i++) {
    const [a, b] = [(i - share / 2) * step, (i + share / 2) * step];
    const slope = step * (1 - share) / 5;
    for (const [angle, radius] of [
      [a - slope, inner2],
      [a, outer],
      [b, outer],
      [b + slope, inner2]
    ])
      corners.push({ x: radius * Math.cos(angle), y: radius * Math.sin(angle), r });
  }
  return closedOutline(corners, t);
}
function hexNut(b, t, width, height, hole) {
  const corners = Array.from({ length: 6 }, (_, i) => ({ x: width / Math.sqrt(3) * Math.cos(i * Math.PI / 3), y: width / Math.sqrt(3) * Math.sin(i * Math.PI / 3), r: 0.35 }));
  extrude(b, closedOutline(corners, t), [circleOutline(0, 0, hole, circleSegments(hole, t), true)], { bottom: 0, top: height, bottomRadius: 0.25, topRadius: 0.25, tessellation: t });
}
var plateCorners = [
  [-20, -20],
  [20, -20],
  [20, 20],
  [-20, 20]
];
var MOUNT = [
  {
    name: "Housing barrel",
    material: "polyamide black",
    shape: (b, t) => threadedRod(b, { radius: 11.05, depth: 0.75, pitch: 1.5, bottom: -15.5, top: 0.95, tessellation: t })
  },
  {
    name: "Lock washer",
    material: "zinc-plated steel",
    placement: { at: [0, 0, -3.4] },
    shape: (b, t) => extrude(b, toothed(15.2, 16.4, 20, 0.5, 0.25, t), [circleOutline(0, 0, 11.2, circleSegments(11.2, t), true)], { bottom: 0, top: 0.85, bottomRadius: 0.12, topRadius: 0.12, tessellation: t })
  },
  {
    name: "Collar nut",
    material: "zinc die-cast",
    placement: { at: [0, 0, -9] },
    shape: (b, t) => extrude(b, toothed(14.5, 15.5, 28, 0.45, 0.28, t), [circleOutline(0, 0, 11, circleSegments(11, t), true)], { bottom: 0, top: 5.4, bottomRadius: 0.25, topRadius: 0.25, tessellation: t })
  },
  {
    name: "Flange",
    material: "polyamide grey",
    placement: { at: [0, 0, -20] },
    shape: (b, t) => {
      const outline = [
        { x: -17, y: -15, r: 2.5 },
        { x: -6, y: -15, r: 0.8 },
        { x: -5, y: -16.5, r: 0.8 },
        { x: 5, y: -16.5, r: 0.8 },
        { x: 6, y: -15, r: 0.8 },
        { x: 17, y: -15, r: 2.5 },
        { x: 17, y: 15, r: 2.5 },
        { x: 6, y: 15, r: 0.8 },
        { x: 5, y: 16.5, r: 0.8 },
        { x: -5, y: 16.5, r: 0.8 },
        { x: -6, y: 15, r: 0.8 },
        { x: -17, y: 15, r: 2.5 }
      ];
      extrude(b, closedOutline(outline, t), [], { bottom: 0, top: 6, bottomRadius: 0.6, topRadius: 0.6, tessellation: t });
    }
  },
  {
    name: "Latch lever",
    material: "polyamide orange",
    placement: { at: [17.1, -1.5, -17], x: [0, 1, 0], z: [1, 0, 0] },
    shape: (b, t) => {
      const outline = [
        { x: -5, y: -1.6, r: 1.5 },
        { x: 6.2, y: -1.6, r: 0.6 },
        { x: 9.4, y: 0.5, r: 0.8 },
        { x: 8.4, y: 2.3, r: 0.8 },
        { x: 5.2, y: 1.6, r: 0.9 },
        { x: -5, y: 1.6, r: 1.5 }
      ];
      extrude(b, closedOutline(outline, t), [], { bottom: 0, top: 2.2, bottomRadius: 0.35, topRadius: 0.35, tessellation: t });
    }
  },
  ...[-10.6, 10.6].map(
    (y, i) => ({
      name: `Flange screw ${i + 1}`,
      material: "zinc-plated steel",
      placement: { at: [17, y, -17], x: [0, 1, 0], z: [1, 0, 0] },
      shape: (b, t) => slottedScrew(b, { headRadius: 2, headHeight: 1.3, slotWidth: 0.6, slotDepth: 0.8, shankRadius: 1, shankLength: 3, pitch: 0.6, slotAngle: 0.4 + i * 1.1, tessellation: t })
    })
  ),
  ...[-12.8, 12.8].map(
    (x, i) => ({
      name: `Latch spring ${i + 1}`,
      material: "zinc-plated steel",
      shape: (b, t) => {
        const coils = 4.5;
        const [radius, wire] = [1.5, 0.28];
        const steps = Math.ceil(coils * circleSegments(radius, t) / 1.3);
        tube(b, (s) => [x + radius * Math.cos(s * coils * 2 * Math.PI), -8.5 + radius * Math.sin(s * coils * 2 * Math.PI), -14.2 + s * 5.3], wire, steps, Math.max(5, Math.round(circleSegments(wire, t) * 0.75)));
      }
    })
  ),
  ...plateCorners.map(
    ([x, y], i) => ({
      name: `Plate screw ${i + 1}`,
      material: "zinc-plated steel",
      placement: { at: [x, y, 0] },
      shape: (b, t) => slottedScrew(b, { headRadius: 2.75, headHeight: 1.9, slotWidth: 0.8, slotDepth: 1.1, shankRadius: 1.5, shankLength: 10, pitch: 0.7, slotAngle: 0.5 + i * 1.9, tessellation: t })
    })
  ),
  ...plateCorners.map(
    ([x, y], i) => ({
      name: `Plate nut ${i + 1}`,
      material: "zinc-plated steel",
      placement: { at: [x, y, -4.9] },
      shape: (b, t) => hexNut(b, t, 5.5, 2.4, 1.52)
    })
  ),
  {
    name: "Identification label",
    material: "polycarbonate white",
    placement: { at: [-17.05, 0, -17], x: [0, 1, 0], z: [-1, 0, 0] },
    shape: (b, t) => extrude(b, closedOutline(rectangle(0, 0, 14, 3.4, 0.6), t), [], { bottom: 0, top: 0.4, topRadius: 0.15, tessellation: t })
  }
];

// ../../tools/models/src/push-button/part.ts
function placementMatrix({ at = [0, 0, 0], x = [1, 0, 0], z = [0, 0, 1] } = {}) {
  const y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
  return [...x, 0, ...y, 0, ...z, 0, at[0] / 1e3, at[1] / 1e3, at[2] / 1e3, 1];
}

// ../../tools/models/src/push-button/index.ts
var LEVELS = {
  high: { deviation: 101e-5, angle: 0.2 },
  medium: { deviation: 0.017, angle: 0.53 },
  low: { deviation: 0.1165, angle: 0.8 }
};
var PARTS = [...FRONT, ...MOUNT, ...CONTACT_BLOCKS];
function lookAt(eye, target, yfov) {
  const back = eye.map((value, i) => value - target[i]);
  const distance2 = Math.hypot(...back);
  const z = back.map((value) => value / distance2);
  const flat = Math.hypot(z[0], z[2]);
  const x = [z[2] / flat, 0, -z[0] / flat];
  const y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
  return { type: "perspective", name: "Product view", transform: [...x, 0, ...y, 0, ...z, 0, ...eye, 1], yfov, focus_distance: distance2 };
}
function buildPushButton(tessellation) {
  const scene = createScene("Illuminated push-button");
  const materials = /* @__PURE__ */ new Map();
  for (const part of PARTS) {
    const builder = new MeshBuilder();
    part.shape(builder, tessellation);
    let material = materials.get(part.material);
    if (material === void 0) {
      material = scene.materials.length;
      materials.set(part.material, material);
      scene.materials.push(structuredClone(MATERIALS[part.material]));
    }
    scene.instances.push({ name: part.name, mesh: scene.meshes.length, material, transform: placementMatrix(part.placement) });
    scene.meshes.push(builder.build(part.name));
  }
  scene.cameras.push(lookAt([0.137, 0.075, 0.094], [2e-3, 5e-4, -0.0215], 25.5 * Math.PI / 180));
  return scene;
}
function createPushButton(options = {}) {
  return buildPushButton(LEVELS[options.level ?? "medium"]);
}

// ../../packages/wgsl/src/module.ts
function wgslModule(name, code, deps = []) {
  return Object.freeze({ name, code, deps: Object.freeze([...deps]) });
}
function gated(flag, module) {
  const negative = flag.startsWith("!");
  return Object.freeze({ module, flag: negative ? flag.slice(1) : flag, value: !negative });
}

// ../../packages/wgsl/src/compose.ts
var WgslComposeError = class extends GlanzError {
};
var GATE = /^\s*\/\/#(if|else|endif)\b\s*(!?)\s*([A-Za-z_]\w*)?\s*$/;
var DIRECTIVE = /^\s*(?:enable\s|requires\s|diagnostic\s*\().*;\s*$/;
function flagValue(flags, name, module, line) {
  if (!Object.hasOwn(flags, name)) {
    const where = line === void 0 ? `"${module}"` : `"${module}" line ${line}`;
    throw new WgslComposeError("wgsl/unknown-flag", `WGSL module ${where} asks for the flag "${name}", which was not given. Known flags: ${Object.keys(flags).sort().join(", ") || "none"}.`, {
      location: line === void 0 ? { module } : { module, line }
    });
  }
  return flags[name] === true;
}
function forEachKeptLine(module, flags, emit) {
  const gates = [];
  const active = () => gates.length === 0 || gates[gates.length - 1].active;
  const unbalanced = (line, what) => new WgslComposeError("wgsl/unbalanced-gate", `WGSL module "${module.name}" line ${line}: ${what}.`, { location: { module: module.name, line } });
  const lines = module.code.split("\n");
  for (const [index, text] of lines.entries()) {
    const line = index + 1;
    const match = GATE.exec(text);
    if (!match) {
      if (text.trimStart().startsWith("//#")) throw unbalanced(line, `"${text.trim()}" is not a gate (//#if FLAG, //#if !FLAG, //#else, //#endif)`);
      if (active()) emit(text, line);
      continue;
    }
    const [, kind, negation, flag] = match;
    if (kind === "if") {
      if (!flag) throw unbalanced(line, "//#if without a flag");
      const condition = flagValue(flags, flag, module.name, line) !== (negation === "!");
      const outer = active();
      gates.push({ line, outer, condition, active: outer && condition, elseSeen: false });
    } else {
      const gate = gates[gates.length - 1];
      if (!gate) throw unbalanced(line, `//#${kind} without //#if`);
      if (kind === "endif") gates.pop();
      else {
        if (gate.elseSeen) throw unbalanced(line, "second //#else");
        gate.elseSeen = true;
        gate.active = gate.outer && !gate.condition;
      }
    }
  }
  const open = gates.pop();
  if (open) throw unbalanced(open.line, "//#if is never closed");
}
function order(roots, flags) {
  const done = /* @__PURE__ */ new Set();
  const names = /* @__PURE__ */ new Map();
  const path = [];
  const result = [];
  const visit = (module) => {
    if (done.has(module)) return;
    if (path.includes(module)) {
      const cycle = [...path.slice(path.indexOf(module)), module].map((m) => m.name).join(" \u2192 ");
      throw new WgslComposeError("wgsl/cycle", `WGSL modules depend on each other in a circle: ${cycle}.`, { location: { module: module.name } });
    }
    const namesake = names.get(module.name);
    if (namesake && namesake !== module) {
      throw new WgslComposeError("wgsl/duplicate-name", `Two different WGSL modules are called "${module.name}".`, { location: { module: module.name } });
    }
    names.set(module.name, module);
    path.push(module);
    for (const dep of module.deps) {
      if (!isGated(dep)) visit(dep);
      else if (flagValue(flags, dep.flag, module.name) === dep.value) visit(dep.module);
    }
    path.pop();
    done.add(module);
    result.push(module);
  };
  for (const root of roots) visit(root);
  return result;
}
function isGated(dep) {
  return "flag" in dep;
}
function compose(roots, options = {}) {
  const flags = options.flags ?? {};
  const directives = /* @__PURE__ */ new Map();
  const texts = [];
  const places = [];
  const modules = order(roots, flags);
  for (const module of modules) {
    forEachKeptLine(module, flags, (text, line) => {
      const place3 = { module: module.name, line };
      if (DIRECTIVE.test(text)) {
        if (!directives.has(text.trim())) directives.set(text.trim(), place3);
        return;
      }
      texts.push(text);
      places.push(place3);
    });
  }
  places.unshift(...directives.values());
  return {
    code: `${[...directives.keys(), ...texts].join("\n")}
`,
    modules: modules.map((m) => m.name),
    locate: (line) => places[line - 1]
  };
}

// ../../packages/wgsl/src/shader.ts
var ShaderError = class extends GlanzError {
};
var oneLine = (text) => text.trim().replace(/\s*\n\s*/g, " ");
async function createShaderModule(device, shader, label) {
  device.pushErrorScope("validation");
  const module = device.createShaderModule({ label, code: shader.code });
  const [validation, info] = await Promise.all([device.popErrorScope(), module.getCompilationInfo()]);
  const errors = info.messages.filter((message) => message.type === "error");
  const first = errors[0];
  if (first) {
    const place3 = shader.locate(first.lineNum);
    const text = shader.code.split("\n")[first.lineNum - 1]?.trim();
    const where = place3 ? `${place3.module}:${place3.line}: ` : first.lineNum > 0 ? `line ${first.lineNum}: ` : "";
    const more = errors.length > 1 ? ` (and ${errors.length - 1} more)` : "";
    const location = place3 ? { module: place3.module, line: place3.line } : { line: first.lineNum };
    throw new ShaderError("wgsl/compile", `Shader "${label}" does not compile: ${where}${oneLine(first.message)}${more}${text ? ` \u2014 "${text}"` : ""}`, first.lineNum > 0 ? { location } : {});
  }
  if (validation) throw new ShaderError("wgsl/compile", `Shader "${label}" was refused: ${oneLine(validation.message)}`);
  return module;
}

// ../../packages/wgsl/src/struct.ts
var StructError = class extends GlanzError {
};
var BASIC = {
  f32: [4, 4, "f"],
  u32: [4, 4, "u"],
  i32: [4, 4, "i"],
  vec2f: [8, 8, "f"],
  vec3f: [16, 12, "f"],
  vec4f: [16, 16, "f"],
  vec2u: [8, 8, "u"],
  vec3u: [16, 12, "u"],
  vec4u: [16, 16, "u"],
  mat4x4f: [16, 64, "f"]
};
var roundUp = (value, to) => Math.ceil(value / to) * to;
function layoutOf(type, field) {
  if (typeof type === "string") {
    const basic = Object.hasOwn(BASIC, type) ? BASIC[type] : void 0;
    if (!basic) throw new StructError("wgsl/field-type", `Field "${field}" has the type "${String(type)}"; known: ${Object.keys(BASIC).join(", ")}, structs, and [type, count].`);
    const [align, size, word2] = basic;
    return { align, size, text: type, numbers: { word: word2, offsets: Array.from({ length: size / 4 }, (_, i) => i * 4) }, structs: [] };
  }
  if ("module" in type) return { align: type.align, size: type.size, text: type.name, numbers: void 0, structs: [type.module] };
  const [elementType, count] = type;
  if (!Number.isInteger(count) || count < 1) throw new StructError("wgsl/field-type", `Field "${field}" is an array of ${count} elements; it needs a whole number from 1 up.`);
  const element = layoutOf(elementType, field);
  const stride = roundUp(element.size, element.align);
  const { numbers } = element;
  return {
    align: element.align,
    size: stride * count,
    text: `array<${element.text}, ${count}>`,
    numbers: numbers && { word: numbers.word, offsets: Array.from({ length: count }, (_, i) => numbers.offsets.map((offset) => i * stride + offset)).flat() },
    structs: element.structs
  };
}
function struct(name, fields) {
  const table3 = /* @__PURE__ */ new Map();
  let end = 0;
  let align = 4;
  for (const [field, type] of Object.entries(fields)) {
    const layout = layoutOf(type, `${name}.${field}`);
    const offset = roundUp(end, layout.align);
    table3.set(field, { name: field, offset, size: layout.size, type: layout.text, layout });
    end = offset + layout.size;
    align = Math.max(align, layout.align);
  }
  if (table3.size === 0) throw new StructError("wgsl/empty-struct", `Struct "${name}" has no fields.`);
  const size = roundUp(end, align);
  const all = [...table3.values()];
  const find = (field) => {
    const found = table3.get(field);
    if (!found) throw new StructError("wgsl/unknown-field", `Struct "${name}" has no field "${field}". Fields: ${[...table3.keys()].join(", ")}.`);
    return found;
  };
  return {
    name,
    align,
    size,
    fields: all.map(({ layout: _layout, ...field }) => field),
    module: wgslModule(`struct/${name}`, `struct ${name} {
${all.map((field) => `  ${field.name}: ${field.type},`).join("\n")}
}`, [...new Set(all.flatMap(({ layout }) => layout.structs))]),
    offsetOf: (field) => find(field).offset,
    allocate: (count = 1) => new ArrayBuffer(size * count),
    write(buffer, index, values) {
      if (!Number.isInteger(index) || index < 0 || (index + 1) * size > buffer.byteLength) {
        throw new StructError("wgsl/out-of-range", `Struct "${name}" at index ${index} is outside of a buffer of ${Math.floor(buffer.byteLength / size)}.`);
      }
      const view = new DataView(buffer, index * size, size);
      for (const [field, value] of Object.entries(values)) {
        if (value === void 0) continue;
        const { layout, offset, size: bytes } = find(field);
        if (value instanceof ArrayBuffer) {
          if (value.byteLength !== bytes) throw new StructError("wgsl/field-length", `Field "${name}.${field}" takes ${bytes} bytes, got ${value.byteLength}.`);
          new Uint8Array(buffer, index * size + offset, bytes).set(new Uint8Array(value));
          continue;
        }
        const { numbers } = layout;
        if (!numbers) throw new StructError("wgsl/field-type", `Field "${name}.${field}" is a ${layout.text}: give its ${bytes} bytes as an ArrayBuffer.`);
        const given = typeof value === "number" ? 1 : value.length;
        if (given !== numbers.offsets.length) throw new StructError("wgsl/field-length", `Field "${name}.${field}" takes ${numbers.offsets.length} numbers, got ${given}.`);
        for (const [i, at] of numbers.offsets.entries()) {
          const number = typeof value === "number" ? value : value[i];
          if (numbers.word === "f") view.setFloat32(offset + at, number, true);
          else if (numbers.word === "u") view.setUint32(offset + at, number, true);
          else view.setInt32(offset + at, number, true);
        }
      }
    }
  };
}

// ../../packages/renderer/src/errors.ts
var DeviceError = class extends GlanzError {
};
var RenderError = class extends GlanzError {
};

// ../../packages/renderer/src/gpu/device.ts
var RAISED_LIMITS = ["maxStorageBufferBindingSize", "maxBufferSize", "maxTextureDimension2D", "maxTextureArrayLayers", "maxStorageBuffersPerShaderStage", "maxSampledTexturesPerShaderStage"];
var WELCOME_FEATURES = ["timestamp-query", "subgroups", "float32-filterable"];
async function requestDevice(options = {}) {
  const gpu = options.gpu ?? globalThis.navigator?.gpu;
  if (!gpu) {
    throw new DeviceError("renderer/no-webgpu", "WebGPU is not available here: use a current Chrome, Edge, Firefox or Safari over https, or in Node pass { gpu: (await createGpu()).gpu } from @glanz/renderer/node.");
  }
  const adapter = await gpu.requestAdapter({ powerPreference: options.powerPreference ?? "high-performance" });
  if (!adapter) {
    throw new DeviceError("renderer/no-adapter", "WebGPU found no usable GPU: update the graphics driver, allow hardware acceleration, or reload the page if the GPU was lost.");
  }
  const requiredLimits = {};
  if (!options.defaultLimits) for (const name of RAISED_LIMITS) requiredLimits[name] = adapter.limits[name];
  const requiredFeatures2 = WELCOME_FEATURES.filter((feature) => adapter.features.has(feature));
  try {
    return await adapter.requestDevice({ label: "glanz", requiredFeatures: requiredFeatures2, requiredLimits });
  } catch (cause) {
    throw new DeviceError("renderer/no-device", `The GPU refused a device: ${cause.message}`, { cause });
  }
}

// ../../packages/renderer/src/gpu/buffers.ts
var SLICE = 16 << 20;
var mebibytes = (bytes) => `${(bytes / 2 ** 20).toFixed(1)} MiB`;
var GpuMemory = class {
  #device;
  #live = /* @__PURE__ */ new Map();
  #bytes = 0;
  constructor(device) {
    this.#device = device;
  }
  /** Bytes held now. */
  get bytes() {
    return this.#bytes;
  }
  /**
   * A buffer of at least `size` bytes (16 at least, rounded up to 16).
   * @throws {DeviceError} `renderer/limit` naming the limit it exceeds.
   */
  buffer(label, size, usage) {
    const bytes = Math.max(16, Math.ceil(size / 16) * 16);
    const { maxBufferSize, maxStorageBufferBindingSize } = this.#device.limits;
    const storage = (usage & GPU_BUFFER_STORAGE) !== 0;
    const [name, limit] = storage && maxStorageBufferBindingSize < maxBufferSize ? ["maxStorageBufferBindingSize", maxStorageBufferBindingSize] : ["maxBufferSize", maxBufferSize];
    if (bytes > limit) {
      throw new DeviceError("renderer/limit", `The ${label} need ${mebibytes(bytes)}, but this device's ${name} is ${mebibytes(limit)}: reduce the scene, or request a device with a higher limit.`);
    }
    const buffer = this.#device.createBuffer({ label: `glanz ${label}`, size: bytes, usage });
    this.#keep(buffer, bytes);
    return buffer;
  }
  /** A buffer filled with `data`, uploaded in slices that never stall the main thread for long. */
  upload(label, data, usage) {
    const buffer = this.buffer(label, data.byteLength, usage | GPU_BUFFER_COPY_DST);
    this.write(buffer, data);
    return buffer;
  }
  /** Writes `data` into `buffer` at `offset` bytes. Lengths are multiples of 4. */
  write(buffer, data, offset = 0) {
    const [source, start2] = ArrayBuffer.isView(data) ? [data.buffer, data.byteOffset] : [data, 0];
    for (let at = 0; at < data.byteLength; at += SLICE) {
      const size = Math.min(SLICE, data.byteLength - at);
      this.#device.queue.writeBuffer(buffer, offset + at, source, start2 + at, size);
    }
  }
  texture(descriptor, bytes) {
    const texture = this.#device.createTexture(descriptor);
    this.#keep(texture, bytes);
    return texture;
  }
  /** Destroys one buffer or texture; unknown ones are ignored. */
  release(resource) {
    if (!resource) return;
    const bytes = this.#live.get(resource);
    if (bytes === void 0) return;
    this.#live.delete(resource);
    this.#bytes -= bytes;
    resource.destroy();
  }
  destroy() {
    for (const resource of this.#live.keys()) this.release(resource);
  }
  #keep(resource, bytes) {
    this.#live.set(resource, bytes);
    this.#bytes += bytes;
  }
};
var GPU_BUFFER_MAP_READ = 1;
var GPU_BUFFER_COPY_SRC = 4;
var GPU_BUFFER_COPY_DST = 8;
var GPU_BUFFER_UNIFORM = 64;
var GPU_BUFFER_STORAGE = 128;
var GPU_BUFFER_INDIRECT = 256;
var GPU_TEXTURE_COPY_DST = 2;
var GPU_TEXTURE_BINDING = 4;
var GPU_TEXTURE_RENDER = 16;
var GPU_STAGE_COMPUTE = 4;

// ../../packages/renderer/src/film.ts
var Film = class {
  width;
  height;
  block;
  total;
  /** Mean radiance and coverage, vec4f per pixel, row-major, top row first. */
  beauty;
  #features;
  #memory;
  constructor(memory2, width, height) {
    this.#memory = memory2;
    this.width = width;
    this.height = height;
    const bytes = width * height * 16;
    const usage = GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC | GPU_BUFFER_COPY_DST;
    this.block = memory2.buffer("film block", bytes, usage);
    this.total = memory2.buffer("film total", bytes, usage);
    this.beauty = memory2.buffer("film beauty", bytes, usage);
  }
  get pixels() {
    return this.width * this.height;
  }
  /** Albedo, normal and id buffers; made on first use. */
  features() {
    const bytes = this.pixels * 16;
    const usage = GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC | GPU_BUFFER_COPY_DST;
    return this.#features ??= {
      albedo: this.#memory.buffer("film albedo", bytes, usage),
      normal: this.#memory.buffer("film normal", bytes, usage),
      ids: this.#memory.buffer("film ids", bytes, usage)
    };
  }
  /** Zeroes the sums. */
  clear(encoder) {
    for (const buffer of [this.block, this.total, this.beauty]) encoder.clearBuffer(buffer);
  }
  destroy() {
    for (const buffer of [this.block, this.total, this.beauty, this.#features?.albedo, this.#features?.normal, this.#features?.ids]) this.#memory.release(buffer);
  }
};
async function readBuffer(device, source, bytes, offset = 0) {
  const staging = device.createBuffer({ label: "glanz read", size: bytes, usage: GPU_BUFFER_MAP_READ | GPU_BUFFER_COPY_DST });
  try {
    const encoder = device.createCommandEncoder({ label: "glanz read" });
    encoder.copyBufferToBuffer(source, offset, staging, 0, bytes);
    device.queue.submit([encoder.finish()]);
    await staging.mapAsync(1);
    return staging.getMappedRange().slice(0);
  } catch (cause) {
    throw new DeviceError("renderer/device-lost", `Reading back from the GPU failed: ${cause.message}`, { cause });
  } finally {
    staging.destroy();
  }
}

// ../../packages/openpbr/src/tables/encoded.ts
var TABLE_LAYOUT = { angles: 17, roughnesses: 24, outer: 20, outerTotal: 12, inner: 12, innerTotal: 16, conductor: 32 };
var TABLE_STEP = 2048;
var ENCODED_DIELECTRIC = { width: 18, height: 24, depth: 60, text: "~(Yh(**,026::<620,*;0~(*E(*,.28>FJJJ@621O(~(+S*(.44>HRbffZJ,eW(~(,;(..0:@NZr~()2~()<~()0VM~()MY(~(,?**048DLf~(),~()T~()n~()]D~()c~()^i(~(+^*,04<BTj~()@~()v~(*R~()rc~(*g~()a~()+(~(*O*04:@JZx~()T~(*D~(*r~()J~(*3~(+5~()k~()G(i,6:BNZn~():~()l~(*R~(*L0~(++~(+1~()q~()w(~()P4>JVdv~()6~()T~()p~()xr~()M~(+/~(*c~(*7~(*W*~(,n<Tjv~():~()D~()T~()T~()BB~()M~(*o~(*Q~(*1~(*M~(+9)~(2,P~()2~()H~()Z~()l~()h~()RrM~(*M~(,7~(+k~()g~()A~(*a~(+y,~(:L~()4~(*4~(*X~(*P~(*L~()XP~();~(+[~(-s~(.o~(,U~()AS~(*o~(,I.~(H:~(*N~(,B~(,P~(+J~(*L*~(*C~(-g~(09~(2-~(0g~(-S~()A(~(*s~(,S2~(_]~(-D~(0H~(/P~(+bR~(+q~(0W~(4O~(7/~(5Y~(3;~(.A~(*+)~(*w~(,)<~)2r~(3D~(7l~(3P~(**~(-[~(3s~(<A~(>[~(=c~(;7~(4g~(/k~(+9o~(+/~(*mR~)ot~(?J~(Db~(7v~(,U~(;e~(C/~(Nc~(M)~(G/~(?+~(87~(1O~(,s~(*U~(+7~()7t~+/b~(WH~(Z4~(:n~(=I~(Wc~(^Q~(l;~(c+~(SY~(EK~(;k~(3m~(/=~(,o~(+CR~()X~-72~)6T~),V~(6t~(dS~);?~)<[~)C)~)+M~(h/~(Q-~(@i~(7a~(2=~(/K~(+9~(**~(*J~0sh~*Ct~)cn~(0A~)ao~*Ii~*?y~*2-~)W5~)13~(bC~(I^~(=/~(6+~(1e~(*U~(*x~(+F~7pL~,bp~*^<~)+a~+_k~,WU~,7A~+HM~*P1~)YU~(xU~(Vq~(D[~(:A~(2k~()=~(+>~(,@~E;(~1Px~+b@~+Ye~/dm~0]m~/T;~-[-~+qQ~*Fi~)HO~(ju~(MW~(=I~(1S_~(+6~(-(~_.P~:jv~+u(~291~7kY~7q7~5)A~1/e~-jO~+GE~)pm~))G~(R7~(;;~(,s~(*j~(+(~(->~\x84=6~I08~(Xm~?F7~DT-~A<g~;<O~4=E~/2c~+l^~)rq~(qO~(E-~(/U~(*<~(,]~(*j~(-4~\x903.~ONV~6Pc~L(1~IwS~A[5~8:9~15E~,;g~)b3~(Va~(.=~(/X~(2b~(1*~(-h~(*]~(,_N()((+++----)+)(0)_*()))+-11331)+04(r+*(-(-1179;950N*(j*)+*-+/3;CKE/P_+(N(()+)/-5?QYS@~()BF)(+))))--59K^q?~()D~()X.((a))-1/3;EWomR~(*D~()<,)(~()O(1/5=?GUeq5~()l~(*Zj),*~(*S/5;AGSYec;~():~(*n~(*6D,,(~(,77CQUgeiW/~()6~(*p~(+>~()B0.,(~(/5Ais~()-~()+uS4~()T~(+>~(,@~(*vR-.0*~(4;q~()S~()k~()S~()CMZ~(*:~(,2~(-N~(-2~(*B*7.0)~(<y~()u~(+;~(+1~()wq~()B~(+F~(.(~(/H~(/Z~(-.~()lA?.0*~(KK~(,=~(.G~(-3~()S~()H~(-6~(0f~(34~(3f~(0f~(-2~()<AC,0*~(dk~(17~(4-~(/W~()(~(/R~(4>~(:.~(:2~(7,~(2V~(,P~().?A,.(~)8k~(;+~(=e~(1S~(0<~(<F~(@b~(G]~(Bx~(;6~(2f~(,f~()(;7)*(~)yQ~(NU~(MC~(0o~(@n~(TH~(Tx~(ZR~(N4~(@,~(3h~(,f~(),(5)((~+BY~(vc~(gC3~(dl~).T~(yH~(vN~([F~(G0~(6b~(-*~()H6+-+(~-c?~)qg~)8)~(D4~)Ur~*(D~)c]~)Ir~(r]~(PL~(9l~(.8~()lH*/1(~24E~+hS~)e-~)@l~+9D~+Z8~*y4~*3(~)BB~(]p~(=r~(/b~(*BV*3/(~:_)~/V[~*0g~+a4~.IT~.R(~-2h~+Av~)r8~(of~(Cb~(1L~(*dV);/(~JSc~6pC~)Fu~1CJ~4On~3GV~0Eh~-(6~*UN~)/V~(G]~(1]~(*D6?;/(~ceY~AtQ~+Z(~;oB~=Hb~9+n~3SB~.1P~*dV~)(h~(?6~(,d/eU=-)~kOG~FJA~7=N~DTt~?b:~7bJ~0Bb~+Z8~(wp~(,0~(1+~(/m~(,9~()ug=-(H((()))+-+/)+)()./_)()(++/-3-3--),4(t*(+)+--35;75/-<8(~(),(+*+)/139?AA70X0(r)((++)/7=EQO7Tl,(R(())+-/5=Qc^*~():n**(*++(///9EYsa_~()h]2(Y+(-/+39=OewG~()N~()xX2(~()C++/399AIWmeD~(*,~()tT:*~(*A(55==IMW^Y-~()@~(*D~()VV@*~(+S3;CGUU[[S(~(),~(*<~(*>~()6VF(~(-[7MWaiieO.~()2~(*L~(+.~()xfXJ*~(1+Im~()/~()/~()3oO<~()D~(*j~(+t~(+]~()dHNN,~(6cs~()^~()o~()[~()?YL~()p~(+X~(,n~(-L~(,*~()R4HJ*~(@5~()o~(+5~(+7~(*7~()+L~(*p~(,p~(.V~(/b~(.]~(,H~()N,@B*~(Ok~(+q~(-w~(-9~(*OP~(+D~(/N~(1n~(2r~(2@~(0>~(,b~()].82,~(l3~(/q~(3/~(0)~()[~(,_~(1D~(7J~(9N~(8r~(5h~(1r~(-4~()nB,+(~)GO~(8)~(<3~(3Y~(*:~(64~(=<~(DT~(D@~(AB~(;8~(3f~(.,~(*>R+=,~*Hk~(H^~(L3~(6U~(5:~(J(~(Sx~(ZD~(Ur~(M]~(B.~(6r~(/<~(*ff9E(~,A/~(m7~(ia~(4e~(Pn~(tj~)/X~)/D~(uJ~(av~(KN~(;B~(0l~(+@hKM*~/xS~)ee~)D1~(/6~)Av~)x]~*1t~)s0~)R.~)*j~(Xx~(@_~(2N~(+JFaK)~6le~+Ty~*1K~),H~+5_~,*,~+td~+;T~*Ct~)M:~(hb~(DD~(26~(*@MuI)~@nY~.P-~*F3~+Tx~.S0~//,~.>2~,ZR~*xf~)[<~(eN~(=0~(,Rq~()a~()+E(~D7e~07g~(9Y~/+,~1*@~07L~.*_~+l.~)s0~(br~(3L~(-K~(/E~(-+~(*W~()+?(4((()(())))))(((*/>()(((+)+)+))))).(H((((+))-/+/++),0(P)*))()-+/111-(22(R(()*+++--5731(@2*J*()))(++359=32J4)>()*+*+)-/9?C5FT2(.))(*-)+-19EG/VX:(9*))+(++159GI,f]@*O)(++-+115=EE<p_F*o))+-/1357??-HndP,~()?)-/1375;;9+:Zh_Z*~()s-1379;?7;)<_l]_]*~(*s-7?=CC?;(<h~()2~().T]X*~(,Q5EGOMG;+@p~()B~()d~()DVTH.~(/9AYe^WK(L~()*~()Z~(*8~(*>~()]bN<*~(3k[~()1~()=~()+[3]~()J~(*:~(*n~(+>~(*v~(**vJ/0~(;q~()?~(*1~(*)~()IOX~(*.~(+<~(,>~(,j~(,b~(+l~(*T~()<<=(~(JS~(*S~(,)~(+K~()^N~(*]~(-(~(.]~(/b~(/h~(.b~(-0~(+4~()P,Q,~(h5~(-C~(/O~(-I~()A~(+>~(/P~(3*~(50~(5P~(4@~(1h~(.f~(+l~()V;W(~)KY~(3/~(6)~(0+~()R~(3(~(:T~(?6~(@t~(?@~(;@~(6*~(0]~(,D~()8UW(~*aM~(>o~(A?~(0a~(4(~(F(~(Qh~(VP~(Tr~(N4~(DN~(:D~(1f~(+_@sS)~,Q3~(R)~(M^<~(OH~(m6~)(F~(xx~(mv~([0~(Hx~(9T~(.n~(),~()/~()5O)~-0k~(_C~(G^~(Cd~(uX~);F~);*~),6~(f<~(L*~(8v~(,>~()U~(+)~(*A~()5I).(*)(()(()()(()*(-2*)*))*)))+()(((*(<)(()*)+))+)+)().(@(()*+)(+-)/)-),0(B((()())++/-/+)00)B()((())-+-31/*62*<)*(()(+)-/371*@6(2,)()()()-15954@:**)()*))+)+/7=36HD)1)()()+(+-5795>LJ*A(()+))-+//7;/>PT(Q(+(+-)///115*<RZ.i()--+1-1/1/,2:X],~()1++--31311+.8@BTZ.~()^+/333731-.<LTFXR,~(*W-57;;55-.<VjlXX:,~(,/3AAC??-2D]v~():~()8pV+,~(.k=QWQE52Nt~()@~()Z~()h~()Z~()<N?,~(3gSswiG0f~()B~()v~(*N~(*]~(*X~(*:~()T@O,~(=5~()1~()e~()[w/x~(*0~(+8~(+x~(,B~(,B~(+j~(*v~()b,W(~(OM~(*7~(+A~(*Ww~()4~(+H~(-H~(.t~(/b~(/b~(.l~(-H~(+R~()TCY)~(sO~(,K~(-w~(+UL~(-0~(1<~(4J~(60~(60~(4X~(1t~(.]~(+Lf^W(~)RC~(0)~(0s~(*g~(-r~(68~(<]~(?j~(?p~(=2~(8D~(2h~(-Z~()bIsO+~)c)~(1y~(0/~(*l~(6x~(@R~(E.~(E(~(@]~(9x~(2t~(,jb~();~()S~()-G+,()*((()()((((()*+0)*)(()*)())()(*((2*()*)())))))((),*8(),+(()))-)+()*,(:(()(()))+(-+-),0(:(*()())))/+/+).2):())*)()(++1-/(04*4)*(()())++-5/)6:(.(((+*)*))/133*8@()(((()())-)/75*<H(1*+)*())-(-333(>P,;),+)))))+/-35(FV*E(+*)-)+--+-/-*D]*S(+)-)/+++--***JX,m)(-+/+1+-)*066PJ.~()9)-//-3-/+,2>DDT:0~()s+11351/+,2FLX_T(,~(+1/5;975+,8NVltvV?.~(-E7CCA=/.DZl~()2~()B~()H~()>JK(~(1[AW[O90Rv~()H~()h~(*(~(*0~(*(~()P4Q*~(9ua~()/yW.j~()]~(*L~(+*~(+H~(+P~(+8~(*T~()J/U(~(I?~()A~()s~()G;~()8~(*p~(,B~(-L~(..~(..~(-J~(,<~(*_nIS)~(_W~(*9~(*g~()1~()H~(,F~(/,~(1(~(2(~(1h~(0N~(.F~(+t~()X)cK(~(eY~(*a~(*AX~(,R~(06~(2d~(3n~(32~(16~(.J~(+T~()0GugI)**()(((()*)((((((*.)(*()()*+*)()((*(0()*)((()())(()*()2(*+*()()))(+)((,(4*)*(())))++)(().(8+*)()(((+)+++)*0(2*(*)(()))++--).2(4(()(*)(+(+-/-+.8(0()(*)(())+-/1).>(*((()(*+*))/13-2F*)(((())((+++13/4L(/()*+()())+-/5-4R,5)*-*()+)+)-/1/<R,A*)()+))+)-(--/BR,I)))+)++-))+***FF,[)+)+--+++(*.2:L6.~()+)(/-/--+),08@JP).~()^+1-11-/*,.>FVdL7,~(*q+377/3(,8FR_p~(),HG,~(-75==97)4DTl~()(~():~()D~()4<K(~(1e=KKA-<Zx~()J~()b~()t~()x~()l~()2*O*~(9sMgW5J~()0~()l~(*R~(+(~(+:~(+6~(*f~()rj;K)~(DUewKT~()d~(+(~(,.~(,h~(-(~(,b~(+l~(*X~()>2II)~(Euqc@~()h~(+L~(,_~(-L~(-R~(,r~(+h~(*B~()()S[A)*)(*(()(*)(((((((,**()((*(+*)(((()*(.((((())*+*(+((*((0(((()(()()+*()),(2)*))*()((+(+)),*(0,+**)((+))+(+((.(4)*)(()(()))/)))4(2()*)((((+)-)-)(6(.(*()(*+(()+//-.:(.(()*(+,+(++-//*@,*)(*)(((())+13-,H*)*))*)*+())--154L)-((()))()()+-334L,1)()(()))+)++//:F,9()(+(+))+)(+-)@@.E((+(-)+))+((,0D4.U)+)+)+-+()*.4BH),y(++/--(-)..:BTH9,~()c+-1+1--*.4<HZfB=,~(+7+137-+(4>FXfvv:G*~(-w39;3-.@Pdx~()4~()@~()@r*C)~(2m;A;/6Tt~()B~()]~()t~()v~()n~()DZ1E(~(8U?G3@p~()P~(*0~(*T~(*l~(*b~(*J~()fv4?C)~(8M?;<p~()Z~(*@~(*h~(*v~(*d~(*@~()Pd.AG?(*(()*)*()(*)(((((0*(((),+(*(+,)(((((*(*(()(*)())*(()*(.()*)*(+()*))((*((.*)(*+*(()))(+*+.(2+*()*)()(()+(+(.(0*)((((()))))++*0(.(*(()*)(()++++(4(0*)(*))(()))-+++:(.((()*()(()+-//,<(.)*)*)((()+)+31,B(*(*)(()*))(+-31.B,*(+*)*))((+)//52F*))*(+)*)))(+-/38@,/*))*))(+(+++-):8.5()()))+(+))))0<2*?)(+))+)++)(*2:>+.U))+)+--()(*0:J@1,~()1)+)1++)+*,4>JZ<;*~(*3+-1+/+**2>DTbb8?*~(,/)3/1+,0BJZhtv_,?(~(/5133)2@Vh~(),~()8~()B~()8~()(P+?)~(2A35(6Pr~()6~()P~()_~()b~()R~()8]87?*~(1W/-2Tn~()8~()T~()_~()Z~()B~()(T29=;((((((((((((*)((((2*((((((()(*+*(((((*(((((()*)((()((*(,(((()(*)*+*)(()*(.)(((*)())()(*+**(,*((()*+,))())(),(.(*()((()())))))0(0())**+*(())+++)4(0)*((((())(+)/+(6*0(((()*(()))--/(:).,+*)(()(((+-/3,>*2+(*(()()*++-/3,>*,**)()*((+(+-514<*.())*())())+-//2<**((())()))))+/+64,))*))())))+++(.6..1(+())+(+)+)(,8:)*E(()++(-+))(.6H85,e)++)+-)+),06HJ85(~()W(-+-+++..4>HVT07*~(++-)/+)*24BJVd_R0;(~(-1)1+(0:DVbltrbF+;*~(.i++(6BPjr~(),~()2~()(hR217(~(-g/*2<PfnxxrZF./77*(((*)((((((((((((4((((*)((((((((((((*(()(*(()*)((((((((*((((()*)(((()(*(,)*)(((((((()((+,(,*)((()*)(()(+((,(.)((*(()(())((++0(0((*+((((+*))-))2(0()(*)*(((+(-+/*2*0*(((()((()++//*:)4+,)(*((+((+/-1,6*2,+*)(((*+))-310:(6+*)*)()((++-/1.8*2*(()*)()(++-3-26,4)((()()(+)--+)20*0*+*+())+))+)+.2**)*())+(+)-))+.82)*5+(+()-(-)+(,8<4-*Y((+)++-()*,8@J25,~()A)+(+-)*).2<FLH25(~(*K(-++(,,6>DNRTF,5(~(+m+(+,04@FPZ]]T>(7,~(,W+),0:FN]bdbTB2-5*~(+Y*).6BJRXXTL<0-55.(((((((((((((((((2(((()*((((((((((((((((*)((((((((((((*)((((((((((((()*((*)*()(*()*)*))(*(*(*)(*()(()*)()-0*.)(*)()*((())+)(.),*(),)*))*+())-(0*2(*)+,)(()*+++/(4)6))**)*))()++/-,0,4,)(()((*)+)-3-.6):+,)(*)())(-/1104*:*)*)((()(++/3/24(<(((()()(+)-/-+,0*<()((())))++/-(.0*8(()(+((++-+-(00((0)()((-+)++-,.4,),3*)))+)++++*.6<0/*Q+)(-)))+((26@@.-)~();*)+)))+,.88BH@01(~(*3)()((*24:>HLL@,5.~(*w))*(.88BFPPND:(1(~(+7((*06:DHPPLJ<.-3.~(*=)(,48:FFHB@6.)130((()*((((((((((((2)((*()((*((((((((((()()**()(*((*))*()(*((()*((((*)(((()*((((*+*((*))*+,(,+(*(()*)*()(*-(,)*,))((*(()(((++(.*0)*(((()((()+++(0)4()*(()*()+))/-,0*6(*()(((()))///.2(>)(((((()()/-1/00(>*()*)*+*)++31+.0(D()*)*+*+)+//1+,2(F)*+*)((+)+-1/)..(D*(()))))+/--+*,**@)()((++++--(*.*(*2*)(+))++-+)(24,+(3))())++-+**26:*))[*)))+)+*(,2:@8.-*~();+*+)((,,22>@B>,/*~()s))(**.048DBDB:*-(~(*E*((,008<DBFF@2*1.~(*7(),.08:@@DF<6.+10~()K(*,,086<><64*)/12)(*()*)(*()(*((((.(())*(*()(**)(((((+(**())**(((*)*)((+*)(((,)(**()*))*(()(((*+,)*)*(*+),((((((),)*)*(*-)).(,(((*()()*((+(-(.(2((()(((*))))-/..(4(*(((*))((-+/-.0)>()((*)(()++11).,*D(((()(((++-31+0.)J((((()*-(-113).0(N(()*)*+(--11/).*(P((*+()+)-///-****N())((+)---/+),(,+D)*)))+-+--)+2,)(,0()(+-(+--)(204()(A((+()-+((*04<2*))m(()(+(*(.26:::,-(~()C(+*),*,.4:<@<6,)+~()e((***.26::@B>2,+*~()k((**0248:@@>64)-.~()O)**,.24:<::66*)36q(*(..062464.*(-18)*)(((*()*((((((((+)**(()**)*((*()((+(()(**)(,((((((()+)(*(()**)(,*)(+,(+*()*)*)***(*)+),()*(()*(*)(*()*/*,*.)(*)(((,))((/+,,)4((),()*+(()-/+.,*>(((()()*(-+11+2,)F((((((()+)113)0.)N*(()*()+)/351,.**Z)((()())//35/(,*(]((()()++-133-,(,(_()(()++-/31-(((*)T)*))-)-//--)0*+((>*+(+)-+-/)(0,.*))1)(+*+-++*(048,((+Y()*-)*((,06864()(~()/((+(,(*028:<<0**-~()M*(*,(.0448><84,)*~()O)*(*0.248<<:62,+*~()A((*,*044:6886.(+0w(*(*0.042842.,)/8O()**,..02000*)-3>))((*)(**)*((((((1-*(()**)(,)(*((*)(/*)*((((*(*,(*)+**/(*+**(*(*,((()+,(++**)((**(***)-(,((()**)((**)*(/+,,).**)(*((+**)--/0,*<()*)(*)*)++/5(2*(J(()(*)*+++351.0((V((*()())+359/..*(f(()*())+1377-*,*)n*)(())-+1795).(*)t)*)+)++3355/,)(((f*)))-+/311-(*,+*+N))(-)//-1+(20()()+((+(/++-(,264*+(+W)((+()),.2:82.()+~()/(()***,04::<6,*(+~()E*),*,.046:<840*,+~()A+,(*..42:88:40,()~()5,)*,*00646844.,**m)*(,,..20642..*)2U*),**,0,4.000*)/<;)*((,*,0,0,,*(-/D-(*()*(((,((((*()7/(((*)*(*(***())*(1)()**).*(*,(((-,)3(),(),)*,,(,(-),(1,)((**((*,,)+/.***(*)(*)**(*()1/2*(<)((()*(((++17,4((J(*((*)*++-59/.2((d()*()*+)-79=/6,((x(*)(()+-59A;(2*()~()8)(())--/7?A5,0)*)~():*)(++-/9;=9).(()(~(),()))/15595+..(-*-Z+(+--1331).42-)))3*)+)-/-+,0<8.(+)+m()(+(*(.6:<:0*+(+~()C(((*,,448B<82(*(-~()M(*(,,24::<<60,,*1~()A(*,,.044:886.0,,/y*)*,.00444422*.0+^)***,..00200.0*.*I((,(**.,00..0*.(47(*+**,*.*...*.))@-*)*((,**.,.,*))5T1(((*(*(*(***()((=7((((*).**,***(+((=*(*().),.,,*(++,*9((().),*.,.*-1,,(-)*(*)*,**,*)516*(8)*((*(((*)+7;0:+(T*+**(*+*/-;A3<.((~()*(()((()-1AGE,>*(+~()J(*(()++5?GQ;86+)*~()j()))+/3=EQI+:.+)(~()l())-/3;CKI526+)(+~()H)(-/39?C=3080+-(-L*--/3775-4>>,+++)e)))---+08DH<*--(+~()^((((*04<DHD:*))+-~()y(**004>@FFB2,+((/~()g**,.488@B>82*,((/~();(*..0468884.*,,.3c)**,.02240...(2.1E**(,(,..,2,*,.063/()*(,(*,,*.,*.42)(*()(*******.,0,06.)(*((((*,*,,.*,*H0)(((((,*(,.*.*(/bA()*(**,,.,,**())1M(*(**,*.000**+30(Q(((*,*0.04001;2,,?(*(,).*2.2./A3F+*>((*),(,*,)3KEH8+)~()0*)(*(,)+5AUY0V+)*~(*.(,)(*-+=IiqCVB1))~(+(()*)/3?Mmye6T.1)(~(+H))-15AQgwm1PB1-(+~(*b)-/9CM^eY3HT.5-)+d)-59EIIC.P_H+1/)+~()e(-/3/1*BVj_<+5+)-~(+I),*,0>J]jhP41/+)-~(+Y,*08@HVZdV@*)+)/-~(*c(.28>HLRND4(++))/~()Q(,22:<>@<6,)+,(+1U*,*002640**+),,(5.(),*,,,*,)+)*,0,3F(*)*((((+()+(.629N)(()*))))+)((46<9J*(()+(())(+(0.8B1H)()(((-(()**.2:B,>()(()(*)(*,.,46:L6(()(*)(,,**0022.v~(-c,4<Lb~()(~()>~()L~()<Ju~()-,J60~(0c~(7N)/5Go~()c~(+)~(,O~(,c~(*[X~()_N/4-+~(1L3Mw~()U~(*5~(*W~(*G~()3R~()<T774./+~(+g)(*0B_~()0~()<t.MG6B;++~(+5.0<JXhj_6EK,L-=))~()y(04<BDJ>./0N6I5(-~(*G(*.04:<B@RdN=G-)+~(+a(*,.4<FTn~().v6K?-(/~(,w,*.4:HZv~()<~()<d-G7+)1~(-=(02<JZp~().~()6rD3;1+)1~(,5,.:BP]jr_F.11/++3~()w(06@DNLF8)1)-)--36(,22622+5=5-0)--7~()T**)*++39EE;*.,--;~(*4()+--7;EGA9+40--?~(*6()+135=?CE9(42*1E~()x)+)-379??;9)440-M~()]((--1359;91+2:6(a~()D)+)--/35551(2>88q~()**))+--1/11-(2<H>~()-j)(+))--/--),2BJT~();T()()++))+)*,6BPh~()=D(())())((**0:BZt~()/4(((()*((*..6:HZ~(),[~(.Z/?Y~()+~()Y~(*=~(*c~(*O~())~():~(*f~(*(:A3)~(0t~(65*.6Fl~()]~(*r~(,>~(,H~(*Bk~()eQ4.*,~(/Y2Nx~()R~(*0~(*R~(*<nw~()es*>2*((~(-b*)-1Cg~()9~()Q~()Ia*<4,*(*~(,X-1=MYisoS704***(*~(*B(37?GGG?7+)(,,((,~()4-157;73+*)+(,,*(*X-7==93).6.(02***.D5AGE?5(:><8440,(.6;OSOC70>HHD>80,*(2I[^S?-0@JNHF:4,,(.Sk^K9*6@BJHD@62,3,as[;)268<<FF@<2.?,quI/446024:BF<80Q*~()+m;0682.)(2>DD<2k*~()7c+:<6.(/-*8BD@8~();*~()AO0>:6,-/5+0>FD@~()e(~()GA>>>.*-355*8HHD~(*=(~()G1BB20)-357-2BNJ~(*u*~()M0D<6,)-3973,>NV~(+e(~()G8H:2*)/3775+8N_~(,[(~()CDB:.*)/3597/0Lh~(-[(~();HB4.()//5793*Ft~(.s(~()5L@2,()-13595+>~()*~(0=(((((((()(((*(((((((()((((())***)*(((((((()-(+(,**,((((((*))))/)),0,*(((((*)*)++-/(.20()(((*(,(,)-/1+.2,(((((*00.**)111*,()((((.4884,)/933--()(((2>B@<6)59AC9-+((((<HLH>2+5CII?3)((*(BTPF6(-9?GIC1)((((LZJ:(3775=?=/))(,(XX@-;=91++53-+((*(]X*?GC9),0,+/)((,(jF7OMA3(684,++((((n8KSM=-.8>6.(()(,(t/UUC7)46::0,()),(t?aO?+,28864,)(()(nM^K1)024480,*()*(lcY=-,204402.*))((beW5(00402..,**)((XoG1,22.2.0*,*((((LmA(0000,.,.*,))((Bi9*02.0.*,*,(*+*((((((((((((((((((((((((()(((*)*(((((((((()*)((),((((((((()(*)(+),*(*(((((((*))(+)(),,*(((((((()()+(+*,,(*(((*)((,)+)-)(..*)((((,(((())+-**,*(((((*.,*)*+-++**((()(*.,...()--1+)(((*(..240.*)-113-+*)((.48262,(/5973)+*((.:8<62*)/3;=7-((,(4:@80.*+-57=7++),(6@880))--/575/)(.(:@:.)-1/+++/11().(<@6)133/)**)+-+(,(@>./775-),0,(++)0(D:+59;1-*0.2*()+.(D:/=?53((0200(+(,(H05?;5-+.,400*(-,(H,==93+*,..2..(-((H(A?7-),*0...**-.(J3A;1-(*....*,(/,((((((()*((((((((((((((((*))*)*)*(((((((((((((),)((((((((((()()**+*,)((((((()(*)*))*(((*((((((*())()((***)((((((()(*+()(**(*(((((((*())))((,*(()(*(((((((++(***((*(((**)*)(()))*,)()(),****(()++)*(((((***,,*,+()-)-)*(((*,.,.***)+-/++()*(,,..0.,()+/11+((*(*020.,**(--31-+(,(..020,,(+)/13--(.(.40.,,)()++/1/+(.(,42.*))+)))+-/)+.(040*))-++))((--)0(20.*+/-/)),*))(-.(22,)/1/++*(,**-+0(42*1-1/+-**.,()-0(40)-5//-,),*,*(/.(40-111)++,**,,+/2(((((((((((((((((((((((((((((((((((((((((((()*()(*((((((((((((*))**)(((((((((((()((*)*(((((((()((*()((*)*(((((((*()+*(()(**(((((((()*()(()**)*(((((((((()(((((*((((((*(*)((+)((,)*(((*((((*()())(),)*(()****)*(())+*(*+((*(**(,(*)))++*(((((,(,,*(*)(+)++)*)(**,,*.*(()+--+)(,(*,.*.(,*(+)/--)(*(*,,..*,)((-)1/)+.(,.,.*,)*()+---/(0(,*0.(*())+*--+++.(*2,**)))+(+()+/+2(,0,(()+-)))((+)-0(.,,*+--+(+*)())/2(..*+)-++/(),(*--2(..*)/-/+(+*(,+(32(((((((((((((((((((((((((((((((((((((((((((((()*((((((((((((((()*()*((((((((((()*(*+,)(((((((((((()*)*)*(((((((((((*))(*((((((((((((()*()(((*(((((((((((()()*(*((((((((((*+,))((*(()(((((*)(*)(()*)*)*(*((*)*)()(()(*(*)()**(*(*)())()(((((*(*(*(*(*))+))((*((*****(*)())++(((((**,(,(*((+)+-()*(***,*,(*())--)-(.(**,*,(.)))(+--+).((.*,,(((((-))/-+0(,*,***)()))++-+-2(*,,*(()(++((-)/-2(*,,*)()-)))))+-+2(,,*((+++)+))(+)34(,,(()+++-()))*//6(((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((()*((((((((((((((((*+*((((((((((((((((((()*(((((((()*(((((),)((((((((*)(()*)*)*()((*)(*)(()*()*()**(((*()*)((()*)**))(((((((*(()()((((*(*)((**)((()((()*(()***(((()(()))*(((*)*(*(*(()))()()(((,)****)*)))+)+(,(((,,((*()())++))*((,*(**(*((++)-++.(******(((+*+/+/)0(*(,**(*)()+)-+/+2(***,(()()(+-(1+-4((.((*(()+++(-)-36(*(.*))+)+)(-)+/+2(*,*)))++(-+()++16((((((((((((((((((((((((((((((((((((((((((((((*)(((((((((((((((((((((((((((((((((*)*)(((((((((((((()(*(((((((((((((((*()((((((((((((*(()(((*)(((((((*(+*((*)((()*((((((),)(*+**+**+*(((((*)*)(*))(((*(((((((*)*))**)((()(((*(()(*(((+*+*((((*)((**))()((*)(((((*(*)((*))(+)(*((((**(*)()(()))))*((,()*(**())+)++),(*)(,**()()))-)-).(*(,((*(()(++)/+-2((*(,*((()))++///6((*,((*()(++)/+//4(**(**))))))-)/1-6((,(*()(+)+++++/1:(***(()+)-(-)+-+-4((((((((((((((((((((((((((((((((((((((((((((*)((((((((((((((((),)*()(((((((((((*()*)((((((((((*(()*((()(((((((*))(*((*((()*+*((()**()(((*(()),)((((*+**((((()*)()*(((((()**)*()()**+((()*(*)(*+**)()*((((*)*)*)(*))((((*((*)*)(*))((*)((()(*+**)*+**))()()(*(),)(*(*))())*+((*(*(((((((()))+(+*((()**(*()))())++).((**(*)(*))+)+-+-0(((*(*(((()+++-//4((,(*)*())))+--1/4(*((**)*)+))/)/15>((*,(((+())-+/-/18(*((((*))+++)-/-18((**(())+)/)++(/-4(((((((*)(((((((((((((((()**)(((((((((((((((((*((()(((((((((*(((())(*(((((((*()(*)*(()(((((((()(**(*((())(((((((*(((((*()()((((((*+*(*(,)())((((((*+,)((*(*())(((((()*(*((((((()()*((((*)(((((*)(()*)(((((*)((()(((()(*((((()**)((+*))*(((((*)*(+*)())*(+(,)((((*)*+*+(()+(()*((),)((*))+(+*-)*(((*(),))(()-(++-).((((,)*)))()-++1+0((,)(((*)+)+)--31:(*)*(*())*-)--/19>((*((*()(+)-)/135>(((**)(*++++++/39B(*(*((+)))++-+-11<((*(*)()++++++-)16(((((((((((((((((((((((((*()*((()(((((((((*)**)())*(((((((*()**(*)())((((*)()***(.))+(()((()**((*((,*)-))*(((((((*(*,(((++((((((((*((**),)+)(()*((((((*((,))*-((,)((((*)(((((()(((((((*)(((((+(*+(**(((((()*(+((+(*(),*)((((*)+*+)(+,)((,)(()*)(*))-((+*),*)(*)*+(()+*-((+(+.+(),+,(+)(+)+()-)(,(*)(*)((++))++-/**((*(+*()()-))+3118(()**(())))++/155<(),((()()+)+-+37=F(*)*(()())+++//;AJ(*((()*+))++--/5?H(),(((()++)-)--1=D(*((((+)+++)+))//:((*,.48@H:7UK3+((((*(..2<>8-SG+(,(((((*(,..,1A3020(((((((((+/3;12>6,,(((()((+-195+::4.**(((((-)-511(0660*(*)(()(-/-3-),042.,)((((+)--//)(,24.(,)(()(+)----((,42.)(((()+)+++)-)*20.*+(()((+)+))+-).2.,-((()())(+((/1)40.1(()(((()((+-3+,4./((*()()(*()-35*025()*)*((*()*-53/0.-(*)()**)**(+1=3)4-()**()(*(*(+17;-(,(*+*(((*((*+/9;9+8((*)*(()**)(15??9D(((*)((*(((+-5;EEV((((*)*))*)(-19EMZ((*)(*+*()())/9?OZ(((((((+*+)(++/;GT((((())()(()()-/?D/,2@Pd~()(~()(~(+c~(Sw~(,g~()WW5+((~([F()(-/5Am~(*g~(+NXF)+))((()))/5K~(*MK~(,(:173)((((+)-1A~()3~(+;~()t~(+v5;=/-((((3-3Cm~(*?~())~(**~(,0W593+)(((I7Ei~()a~()u~()(~()L~(,X~()++95+)),(kWm~()I~()kG~()Zp~(-:~()A,371+(*(~()G~()E~()Q~()eqr~()HX~(-6c4-93+)*(~(*G~(*=~(*)~()3F~()>~()0H~(,RL>*771)0(~(+w~(*i~()M0~()0~()<f>~(+H~()V@4591-4(~(.3~(*+.~()0~()<rV2~(*H~()lH<-;7-8(~(0-0~()F~()B~()(]D2~()P~()XJD.9;5>(~(0?~(**~()V~()0bJ8*~()*~()8DH81=7>(~(.g~(*H~()<fNB2*XjDHB(;?F)~(,^~()prN@60(JT<HH65=<)~(*u~()>TB820,<F8BND*A6)~()cdB:64,.8>8BLN:1)+~()+N:8604.8<6>LTN2I/W@:446446<8@JX]Ni154666866:<:@HVfj~()75-:48:6:<<@<@HRhv~()C;048:<><>@>B@FPZr~()?EB4<:<>D<FB@BBFPZ~()/ML8:<@F@F>D@>>>>@a(((((((,~()V~(.(~(-I~()YI/+((1(((((*,LP~())(((((((((*((*,>~(*(~()Is()(((((*(,**0@~()(~()j~(*Q^/((((((((2,4Bd~()j~()O~()+G5+(((((((D8D]~()Ff~(+36A93((((()(bRd~()4~().~()M~(*9TU1?)((((*(~()0~():~()>~()6E~(*UgPm3M-((((*(~()r~()v~()P:~()q~(*+,Dy3e/)((()(~(+4~(*4Z~()G~(*?~()-H>i-i3((((,(~(,xn~()C~(*K~()e3N:KHU5)*)(.(~(.@~()k~(*u~(*9gDL6-h-1((((4(~(-_~(,1~(*w~()?0PN8*~()*L+((((8(~(*x~(,I~()m9NTD0:~()*d.((((8*E~(+3MNXPB42jl4*(((:*~(+/~()7R_XL:(8_d6*(((8*~(,QNv_P@4.4NV4*(((4,~(,[~()HjZB<2,.BL4((*(20~(+u~()LfF<02(0>>2*(((02~(+5~()8RB:0,,,6<.*(((.6~(*?rF802,(*24.((((,<~()k]>40,***20**(((,D~()EJ40.,(**,.,)*((*N~()7<20,**),*.*((((*((((((((_~(.V~(+3~(*A~()-K1+)9(((((((.JQ*((((((((((((**B2M+*(((((((((*((6~()*gE)+(((((((**),2F~()D~()QC())((((((,(,0<p)uG6/()(((*(0,0:T~()(~()S5UT5-()(()(826Hl>~()o<kp93+(((((D<HXbq~()9Fkl;9+)((*(TPXh*~()MM>^V3C3)((*(dtnRe~()E->S2(I7+((*(~()2~()8r1~()?s:4I34O=+((,(~()f~()<Ju~()GE:4A98E=-((4(~(*Th[~()Kw+>279<1;))(@(~(+FA~()c~()OM6>0/-B21+((J(~(+d~()o~(*-y1><4/*FD*(((V(~(+6~(*q~()eI8>@,*,DL6*((Z(~()h~(+)i)B@6,)4@P>,)(_()~(*17BF@4.*(BJ<.*(](~()QoBD@<2**0:D<,*(T(~(*G*NJ@40**24@:.)*N(~(*OVND64.**,4:4,*)H*~(*QlN>80.*(,426(*(@(~(*-hH840**(.,20*(*:((((((((<~(,0m~()GwQ;/)C(((((((*43)((((((*((((((**45()((((()(((((*(@/5)(()(((*(((*)*0ZU/)+(((((((*(),,:dq76+-*)(()((**,0L,OST/++(((*(.(*0<Vg/Ub1-+()(((.*06HF~()/2QZ,5/+((*(222>N7q>K@<5/-+(((:6:FBcK8=)L371)(*(@@HH-m3:=5J+95+),(FRN@Kc,01?@.=71(,(XXT)cM427=425A-)2(jbDEg920/;)61;/)>(~()4X/eU-:*+7-4(7/)L(~()T:^oE2.211+6.+-(b(~()rI~()3c526.(3*06,((r(~(*(~()5~()5O(44*+,+4:6((~().(~()d~()au3220,()(2<:.*~()2(~()0~()eO)280,(-.0::4)~()6(<~()E10840()*,06<.,~()*(Og.860.,),)248.*x(~());8:20.(,),.260)l((((((((,~(*_*[YK=1(S((((((((.-((((((()(((((((,())((((((*(((((((0)*-))*((()((((*),@=,+)))(((((((*),.PQ58/()((((((((*,8JWEP//((()((*(*,0B1=MZ---+((*(*,(,6JY.KH61/(+)((.(,2@<k6;.J13-))*(0,08@+[8;/P)13++((222<@KE:3;H6333+*(86:@.W/85;8>-73/,(:BB>9U,0(=)B(59/,(BHF2GE2.13/803=36(LLF/O9.2-5324/=3B(ZN6AO/4,)31(4)73T(lF1QC*.,)-3)0.13p(~(),4QS7*2,)/-+2.*-~()4(~()<=gO322,+++(*8.+~()V(~()BegG(00*)))).46.~()_(~()4~()-^5,,0,*++*02:.~()p(t~();M+,4,(()*).6:2~()l(J~()-9*2,.,)()*.264~()f((((((((-~()ZP+975-+~()=((((((((+.)((((((,(((((((().)()((((*((((((*,-41)*)(((,(((((*(432+-)(*)(*((((*)*FC-:1+)(((*(*()(,0JQAT1+-)(((()**(,88AGP*5))+**(*(*,.@9/?:>1//()*(*(,,4FW49+L)3/+(+(,*,.<8[>5;L43//-((0,,6<+M6/;:B+5/1((0.2::??:-;*F.153+(264<2I-633+:8-77+(88>:+M(6)554<(3?((:B>8;A2.)51)821A,(@FB*A52,-+3-22-C:(JF<1A/0.)11-,2(=N(TF,??*2,)-//+0.7r(b<3I5,0,(+//),0+~()@(l,MA/,0**++++*0,~()l(~()(?WC+20,+(++),06~(*>(vYU;(20**+)(((4:~(*V(nkO5(20*)(*)).2<~(*l((((((((9jtT<,*)(~(*7((((((((36)((((((*((((((((/:1)*((((,(((((((*1D7)+*(((*(((((((21:-/)()((*((((((,87/D5-))*)*(((*)*,HAAR31)))*)((((**2HI?H031))+*(*(),,:*1;.D/1-+)((*(**0>9,77N,11-+((***.4@S<1;<@/1/+-(,**0::U>/=.F.11-5(,.00>+G:+7-><-317(2,08:;58-556@0/5C(044<0=/6+5/)>8)/Q(66<:*C*0+-5+4<0+[(8<><1A.2(15-,<8)Y(:DB4972,)+11)4<6Y(DBB.91*.(-//-08BE(JF4*9-0,+++/+)8>0(R@033*..+)//+(2Bb(Z83/+*.(*+)-/(0D~()>(d(A-(*0.)(-)-(,4~(*:(j?G+00.*()))(+*>~(*d((((((((K4~()J~()8hJ:0*~(+)((((((((?D))(((((*(((((((*9H5()*)(()(((((((*1P?-()(((-((((((**)@-7))(((/(((((*(6+5L;1)()(1((((*)*D3?V55/))(/(*(()*0J9A::7//()1()(*(.2H=53N/3/+)-(**)*,<**5?D:3//++(*)*,0B;2/A0H,311-(**,,4>I@/;1B<+3-;(,**06>M@/956B2+5I(.,.0<.G>)57)B>(-Y(0004<5/2)/9-6D6*s(0448471:)13/,>B(s(46<8*9,2++/3+6FJ~()C(8<@4)7,0)--1+0>>y(8DD2/52.))-1-):Dy(@DL*5-.0(+/+/),Fc(DJF(1-2*())//-(05(JJF-5,..)+-)-/-06(TD@1-,0(*))/-155~().(Z::-),,.)))-//15~()T((((((((s;~(*L~()v~()>hH8,~(.a((((((((IR/((((((F((((((((=dG))),)(F((((((((*fW3)*)((F(((((((,66.C-+(((<(((((((4:AZG5++((0(((((**<6GJ)=1)()-((((*),N);/J77-+(7(*(()*2V3=CJ471/)7()(*,*4L51I2H*7-/3(**)(0<4*3C1B>)5+7(*(**0F74-==6F4+5A(,(*,4BA<-7=+BD.)[(*,*08<E<)5;14DB,q(0*,086C<+155(@J8~()/(00,2:+/4++37/6FJ~()5(08.48/36)-13-(:Hy(482625(2(+/15/4P~()/(8<66(/)0)+//1//4O(8H64(3*(*-)317/1;(>L80//).+)/+51;5)(BT:(-3)(()+1197K8(H]6)13-(+)--13951(Nb0-111+*+-//37GH((((((((~()wB~(,6~(*h~()XtP:.~(-s((((((((Ql=)(((((n((((((((.~()(w/(()*(V(((((((*NbgE))*)(6(((((((*fCHW7()*)9((((((*,j[_IA1*+*W(((((((8_S)JE51()g(((((**FFESX.;3+)m((((*),X,9[6P)5//k(*((),2_79M;NB(5)k((((**6X=/EG4N<(5W(((*(.:D5/=C1DL:*^(,(),0B))+7A92JJ8k(,(**0D7.+37=/>PJu(*,*,6:;2--775*BPc(.**068C2(1177/2Tc(2(..6,;,(+1597+40(2.,62-=.++115991F(24.2019)(-+359=C](:040*7;(+(1-55=;L(::2.);71*++1/77=B(B:2,1;9-(++--1791(D@0(77;/()(-/-/1C(ND,/9=3-))+(+1-+o((((((((~(,C~(,x~(.R~(*_~()8T@2*~(;l((((((((jB~()1()*(((~(,d((((((((~()l]~(*7=*)(((~()O((((((((~()x~()+0o5*)*(~(+^(((((((*~()_~()c~()8^E/()*~(+e(((((((,~()>~()71nK;/()~(+Q((((((*.nay~()(D=3/(~(+[(((((((:NKw2t8311~(+y(((((**B2=cGTd6/)~(,C((((((*V;3MS,ZV81~(,=(((*((0ZM1AM;@VTB~(+u(*()*(2XS+;CA-FVN~(+)(((*(,4JS+3;A=0FX~()O(*(((.82I-/7==7.DK(*()..83E(139?=58](,),(.6?E)+359C?C~()T(,*(,2.IC)-/379CI~()@(,*,*.*IC(-)159=;~(),(2(*.,/I=)(/-/35=b(..*.(1C=()(-+115L(4*,,)5C1()))+--//(4,,*+791)*))+(+)K(:,.--75+())()+))~()o(:0*+53/-)*()(*))^((((((((~(1]~(8H~(+I~(*k~()eyU=-~\u34E4^x((((((((~(*2~(+e~()Z,*))((~\u1824pM((((((((P~(-)~(,,L***((~\u10486c((((((((C~(+o~(*D~()X>(*((~\u092Ax?((((((((c~()oY~(*6h8**(~\u02C3PK((((((((ko~()Ct~()@R6,*~\xDAx-(((((((*kIy;rlH4,~_7-(((((((*i9WS0_VB8~:Jo(((((((.m1CO;4NL<~0B+((((((*0q-;AE32DF~+(-(((((((6y+39??1,8~*//(((((**6~()/+-5;=;5*~(4=((((((*8~()1)-157A99~(7s((((*(*2~()-(+//57=;~(R;(*)*)(.(q()+//37C~()R((*)***/[)))+--1-B((((*(*1M()()+-+)a(*(((*(5?(*+)((+3~()e(((*(*)35()*())(.~(+C(*(((*+1-(()()*))~(,[(*(*())--((((((((~(-s(**(())-)((((()()~(.a(**)*)+))((((*(()~(.[(,(()()+(*((()(()~(0g2+3CUo~()5~()EmF~()l~()t~()(D0((~\u34E5@i7((****.+//*2,**(~\u1824jJO(*(,0.,(/-.4.*((~\u104878u*(,.,44,+/082*.(~\u092B)J~()W(*,.64:4,+2:4>)(~\u02C3T:~(*O(*.06<@@2,0:>N*(~\xDB*4~(+^*,.28@DF@..4~()n=((~_;]~(,s(,.48@JJD4<~(*R+,(*~:Ot~(.-*,.48BHPRf~(*8~()*3+,(~0GB~(.^(,26>HVl~()>~(*,~():E+*.*~+-:~(.K*.8@Pb~()(~()H~()d~()(A752,,~*3b~(-K,6DRl~().~()D~()>TCE=+42,~(8>~(,/.@Rp~()0~()<n6IQAA0:4.~(:p~(*k4Jh~()2~()6_)S[K??6@62~(TV~()m6X~().~()8d1Y^QEE5<@<4C~()7<l~()<x)W^UKCE/6DB8MeD~(),~()@FScYIE?E38DD>SOL~()@~().=e[IE=C?30DJD[AV~()PT^cOC;;?A7*BLNg5d~()R)iWE=9;?=9(:NTk1t~()HQiM=757;?9-6LZo1~()0~()0i[C9335;9;3.Jhu+~()>]sO=33155;95)Dry+~()N6oI51/135799-<vu,()*(()((()(((((((0(*+((*+)((()(((((>()*)+)(+)+)(()(((P)*))(-+-/)++(*+((n()()/)1-1//)(7.((~()@*(+)+11555-(-S>((~()r(+(+-/3793-.~()Yp5*(~(*N)()-)11575;~(*C2t,))~(*h)())--35?a~(*;u~()n.**)~(*P*++-17=Ow~()s~()9~()8~()_*)(+~()P))57AOa~()-~()G^~()(~(*.F2*(-(+1=I^k~()+k,~()<~()rx).*(/~()G)=IcmqER~()H~()l~():2+/(*-~(*71CYmk1h~()P~()f~():4(55,))~(*C3Mik3p~()P~()V~(),B)1C1**-~(*-7YsIh~()L~()NvB-+5A1)*(~()Y=ikD~()F~()Lt<)9(1E1,)*~()7CuK~().~()R~(),>-=/)1?1),(oK~()-8~()R~()>L-;7/(/73(),[Swp~()Vf(9;3)(15-+),Gae~()L~()B@;?;1)*-3/+*,?m?~()dl-?;3-*++-/+149u>~()bF=A71+)(+++-/41~()/n~()H,E=5-())))++56*(()*)(*)(((*)((((,(),)*))*))(((((((0*()()(())((+*((((<)(()((-)()+*+((((F*())(+)--+(+*)+*(Z)(()+++----+)8;((t)*+(+--/11/)*O>((~()<*)()-+1133/)6m:*(~()_())+)--3311*~()I,N*+~(**(()))+//35/m~()Ix(*+~(*<))*)-)1-1=i~()u)~()8,*-~(*2*)+)+1-9Gi~()Ug~()*b6,1~()Z+()139?Me~()1kT~()@:@*5d(-17=GUekKV~()<b0<,;?)/9?MW[W1X~():~()44)8,7~()1+5=KUYO._~()6~()<T-/0.7~()^+7EUWG4d~()0~()8d2-3/23~()i-=OSK,b~(),~()2h>++=1*)~()[/ASS1V~()*~()*dB,+-?7(.~()C3IWGDvxfB.1,-?;-6~()75MY-f~(),jJ0/-*)A;5>g7USDxrN,13+*(9?=F^9^A_~(),_6-11)*+3=MRO=e(xrD(55-)*(39^b(((((*)(((*)((((((*((((+,)(((*)(((((,)*((*+((())*(((((.*)()(((())*)*)(((4)*)*))())(+*+**)(:()(()*++(+()*+)*(@*)*+()))++)+),/,(N)()((+)+-)-)(,5*)X*)((+)+++1)+(2=),j)*(+(+++/+/(*kH*(x*()(+)(/---))~()=_.+~()4((()((-+)--1s?H2/~()>()+*))(+--5O~()En,41~():)*()(+-(19I~()-Gt):3~(),())+++/59Gc^]L,<;]()(-/55?CQO:r*2678))//57?CI?6jT5205;)--59?E?58Zh83*25Y)+37=A=36XbN,/1)*o(/59=?18TXT6*+934k)15=A32JVT<*(*?CDq+1;=7,FXP@0*),AUT[-5;;1:RNB0*),(?ifU-3?=.LPH2*))*,=qj(((*)(*)((((((((((((*+**+,)(((((((((*()*()*)*)(*()((((,((((()()*())*((((.()*)(*)((+(((((((0*()(()())*+*)*)((8+*(())()))()(),+(:*()()*-()+)()(+**B((()*+(++))+)*=8-J(()*+((-)+-+*,?2)T()*)()+(-++)).=+.b)()((+))+-))(I,).h((*))()))-+-+~()+P.)p*)()()(+))-/OeR0+r(*)(()+)++1Ci246-p((+(+(+)/1?OQR1>1d))((---13;CK0N7B7L*))/)1/7;??+P:;2(6))+-1/9999)DN,7,)/))-/35795*>L<(558A)+//3953*8HH2(3IDK*/+3777(8FH6.)/WPQ+)3553(8@D82,*/k]O(/155/2<D<2,**1wl((*)(((((((((((((((*+,)(((((((((((((*)*)*((()(((((((((*(((()*((()(((((((**()*())*)*((()(((0+**)()(())(()*(((0*))(*())(()(()(((4(((())*)())+((*)(8((*))()(+))(((.30@()(()(+))))))())(D(()(*+())-)+(*K@-J((*))((++(/(),S>+R*(+(((+()+)+)(G.0Z)*(())(+))+))G+(.d)+*()((()-(-7a>(.d(*))*))+))-5CQB).b*((+*)+)+-3;M-2(0_)(+*/(+--39??@+)0R()(+)1-/359;,>3/6B())+/-/5573*<65=<2)))--1517/(4@.3ED+()///133/)6>8,5QL;(++-1311*4::0(5OP9)+-1313)28:40)3MN((((((((((((((((((*)((*)((*)(((((((((*((+*((),()((((((((((*(()*+(*((((((,((()(),+*()((*)((**)(*(()(((()*+*((.(*)()*)())(()*(((0(),)(()())(((((+*6)()(*+*+(()))),)(6(*)((()()+())*(+*<((()((+()))()(.50@(((*-*()+(++((+/.H)(((*+))))+))(I6*L()(()*))(+)+)*W:,P**))()())(-)(5G(6X(+**+)(()+()3E/)4Z((()()()))-/7K.5>Z((()()+)++-5=A4=@X((+))(++-/19?(*GHR))())-+//357/0-=DF*(-++-//151/,67=B<+()+-1-5//1.2,75@4(+)///5/-3,26*;+8+))-)11//30240*=8+((((((((((((((((((((*)(*)((((((((((((()**+,)*)((((((((*((()*+,+**)*)((((*)*(((*+*))*)*((((,(()(((((()*()((((,(),)()*)(()(*)*)(.*(+*(())(*))(()*(0)*(()*+*))(((()((2*)*)()*)()+*+(*)*6(((()(*+)()+((*/,<())(,++*(-()().1.<(*((+*()))(+)(*50D((()()((+)+()(3-0H()(*()))())+)(I0.L(*))((())(+)+-M*8R)(()((+()))+-9=1>T()(())*+(+)-3A53@T(((()+))++-/7=(;DR*()+)(-)-+1575*AFR+)((+++/-/333+)?FJ())+-)/-1133*(++4@()+)+1-19+)+(*+6+6())/)15-(3-0,+-R=((((((((((((((((((((((((((((((((((((*(()(*)(((((((((((((((*)*)*()(((*)(((*)*)((*+**()()*((*((*)(((()()*(((((,)*)*)()*((()(*)((,((((()*())(*)((((.*)((((()()()((*)(2+*(((()(+*()*+((*2*()(()()*+()((()(4((*))*())(+*+(()*:()((*)))())))(,/,<(()((()()()+(((30@)*(())*(+))(+)+/2D((()(*-(*+)+*+9)0H*))*))*)))()--A*4J(*()())(+()+-59-8P(+(()((+()--1;5+:P)*))()+))-+/3=)1:N*)()+))+--/15;.)4L()))(/)--1//9/..*H)()+-(1--+7--76@5B)(++-+(351(1(3:D;((((((((((((((((((((((((*)(((((((((((((*)(),)((((((((((*)(((((((((((((((*)*)*(()*)((((((((*)*)*)(((*()(((*)(**)*)*)(())**)()*(,((()(*))*(()*)(((,(((((((()()((((((.(()*()((()()(((((0)(*()*)()*+*+(*)*2*())*)(())*-**+((4(((()(()())*))*-,6((*())*)()(+)),-,:((()(*+)*)))(((10>()((()*)+(()+)(32@(()*())(((-)(+//0D((()(()())))+17(4F(()()()()+()-35(0J()(())(+)(--35/,2J(((+()+(-++-57(0*L)*))+)+++-/115.6)L(+)))+)/-1+75)4:3F()))+-/++/5+9.4FA((((((((((((((((((((((((((((((((((((((((((((((((((((((*)*)*(()(((((((((((((*))(*(*)((((((((,+*)*(((+**)(((((*(()*((()*()((((((*)*(((((()((((((((,)*)*)()*(()*)((((,*)*+*)*)((()(*)((.(((((()((+*(()(((.(((*)(()(*+((+,)*2)((((((())()(*))(4(()((()(())()(*-,4*)((()(*+()()),/,6(*((()()(()+()*/.<)((+(*))()*)+(+/2<*)(()(()()+))(+/0@)*()*+())()+/)-+2B*+(*+(+*++)(/--*,F)*+)()*/*++11(/2(F(+*(+(-*-++17+,81D*()))-)+++1-5(.<3H)()+))+/-//31.4:7(((((((((((((((((((((((((((((((((((((((((((((((((((((((((*)(((((((((((((*())**()*)((((((((((*(()((),)(((((((((*)(((*(+*(((((((,))*(()(*(()*)(((((,)*)((*+*)*+,)(((,)*)*)*)(()(*)((((**()(*)((),))((((*0+(*((()((+*()*(+(,,)()(((((())(),((0)*((()(()()*)()(*2(()((*))(((+((*-*4)((()((((+((+,*102,)*())*))(+((),/,8+*)(*))(()*++,(10:*+((+,+*+(+)((+),:),(+*+*+(()/((+(*<*))*+(+((+++(-)0)@()()()(-+(-1()(2+B)*+)(+)))///(*)83@()((+)++--+3*(041((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((*)(*)(((((((((*)*))*(((((((((((((*)*(((+**()(((((((*()*)*()(),)(((((*)(*)*)(*)*+,)(((**(((((((()(((((()(,)(((((((()*+**(()(,()(()*((()*))*(*.)(*()(()(((((())(,(()(**)()((+*(*)*.((*)))*)*)(()*(+,.*)(((()((*+(((()(0)*)*(()*+)*+***-,2()*))*)(((+(*)*)(2(*)(*-,+())((**+*6())()*))()))**-.)6)(*)*)+*+)+*)((((6(*+())*+(+-*(*-,(:(+,)+*+)-)))(+,,):*)))(+))(-1(*),0/((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((*()((((((((((((((()(,(()*)((((((((*)(()((,)((((((((((((*)*)(((((((((((*(()*)*)(((*)(((((),)((((((*()((((((*((*)((()((),()(((,+*(()*)*(((+(*((((*()**)(()(((((()*,()*)()*)*)*(((()(*(*+*(*)*)(+*(((((,((((()(()(((*((*(.)(*))*(+,)(()**)(,*()*(+*(+((*(*)((.((()(*+(*+((,)(+*.((((()(())(*)**)*0()*(+(*+)(*)*((*)2(())*(-*))(*())*(2)*)((+((+)(((()*)4())()())+(*))*((*(((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((*)((((((((((((((((((*)(((((((((((((((((*)((((((((((((((*+*(((((((((((((((((),)(((((((((((*)(*()*)(((((((((((((((()**()((((((((*)(((*(+(*((*()((*)*()(((*()(()(**(((((*)*)((*)((((((*()*(*+(()(,(()**)*)*()(*()*)(((*)()(,))*()(*)*)(*)()*,)*)()*()()*()*,)(*)(*(()(((*((((),(,(()((((()(((*((-*,(((+*()((((*(()((**)(*))*))**)()**),((()(()),()*)*)),,(((*+()()((*(()(((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((*)((((((((((((((*)),)((((((((((((()*()*((((((((((((((((((((((((((*)((((*)*)(((((((()*((((),+*((((((((*)((((()*(((((((*)(((*()*()((((((()*((()**+(**)*)(((*)(((*)),)((()*(((),)**+**+*()*(((*)((*)(*+*(*)(((*)),(+(*(*()(),)(()*()**))()*(*(+*((*)*()(*((*)((((((((()(((),*)*(()*)(*)(*)*()(((()*((((()*),)(*)*(((+*),)((*)(((((" };
var ENCODED_CONDUCTOR = { width: 32, height: 32, depth: 1, text: "~([>(+-/39=CIQWaa^O98]x~().xdL>2.**((((((((((*((*(*)()(+-+(**,**((((((((((((*)*((*(*((-+++)*,***(*(((((((*)*)*(*((,((+)--+)(,,,**(((((((((*)*(*(*((*((-+/-)(*.*,*((*((((((((*((*(,((()(///+(,.,**,(((((((((*)*(**(***)---/-),,.,,(*(((((((((*(*(****)()-1//)(...***(*(((((*(((*(***(*()-/3/+(,...**((*((*)((*((***(,*))+/11/(*0.,,*,(((((((*(*(*((,*(*)+//31+*,0..,(*((((*()(*(****(**)++311-),00.*,*(((((((*),((,(*,(()//311+,,0.0,(*(((((*)*((,(**(*())/133-),00.,.*((((((*((*((,**(((-+1511+*.2.0,*(((((((((*(*(****))-1/51/(,.2...((((((((((*(**(*(()+-3331-*.000.(()(*)(*((),)**(*()+-11511+,020.(((()*()()*(*)(*(((++/335//(*220(((()()(((()((*((())+-13551-*.04()*)()(()()((())((()--/33531+*02(()((())))()))(())))++/15755/),0((()))()))+)))))))))+--1359551),(()())+))))+))++))+++-//3579951)(())(+))+++)-++)+-+++-//357;9=73()*)+)+++++-+++/++----/11579==?;((+))+)-++--+/-+/---/-/13379=AAC(())++-++/--/--//-//-1/11559==CE()(+++----/-//1-/1-11/1111777=CE((+++-+-1-///1/1/11//11/331579;?())+-+//-1/11/111/1111/1/1313539((+-+/-/1/111111131/1/1/1--///1/" };

// ../../packages/openpbr/src/tables/tables.ts
function decode({ width, height, depth, text }) {
  const steps = new Int32Array(width * height * depth);
  const row = width;
  const slice2 = width * height;
  let at = 0;
  const digit = () => {
    const code = text.charCodeAt(at++);
    return code - 40 - (code > 92 ? 1 : 0) - (code > 96 ? 1 : 0);
  };
  for (let i = 0; i < steps.length; i++) {
    const left = i % row > 0;
    const up = i % slice2 >= row;
    const deep = i >= slice2;
    const get = (condition, offset) => condition ? steps[i - offset] : 0;
    const predicted = get(left, 1) + get(up, row) + get(deep, slice2) - get(left && up, 1 + row) - get(left && deep, 1 + slice2) - get(up && deep, row + slice2) + get(left && up && deep, 1 + row + slice2);
    let code = digit();
    if (text.charCodeAt(at - 1) === 126) code = (digit() * 80 + digit()) * 80 + digit();
    steps[i] = predicted + (code % 2 === 0 ? code / 2 : -(code + 1) / 2);
  }
  return Float32Array.from(steps, (step) => step / TABLE_STEP);
}
function table(encoded) {
  let data;
  return {
    width: encoded.width,
    height: encoded.height,
    depth: encoded.depth,
    get data() {
      return data ??= decode(encoded);
    }
  };
}
var OPENPBR_TABLES = {
  dielectric: /* @__PURE__ */ table(ENCODED_DIELECTRIC),
  conductor: /* @__PURE__ */ table(ENCODED_CONDUCTOR)
};

// ../../packages/openpbr/src/parameters/table.ts
var UNIT = [0, 1];
var SIGNED = [-1, 1];
var POSITIVE = [0, Infinity];
var ABOVE_ZERO = [1e-3, Infinity];
function entry(group, name, type, initial, range, doc, { soft, unit: unit3 = "1", uniform = false } = {}) {
  const value = Array.isArray(initial) ? Object.freeze(initial) : initial;
  return Object.freeze({ name, type, default: value, ...range ? { range, softRange: soft ?? range } : {}, unit: unit3, group, doc, texturable: !uniform });
}
var table2 = () => ({
  base_weight: entry("base", "base_weight", "float", 1, UNIT, "Scales the diffuse lobe, and the reflectance at normal incidence of metal."),
  base_color: entry("base", "base_color", "color3", [0.8, 0.8, 0.8], UNIT, "Albedo of the diffuse lobe; reflectance at normal incidence of metal."),
  base_diffuse_roughness: entry("base", "base_diffuse_roughness", "float", 0, UNIT, "Roughness of the diffuse lobe (\u03C3 of the EON model): 0 is Lambert, 1 flattens the shading like clay or the moon."),
  base_metalness: entry("base", "base_metalness", "float", 0, UNIT, "Mix from dielectric (0) to metal (1)."),
  specular_weight: entry("specular", "specular_weight", "float", 1, POSITIVE, "Scales the reflectance at normal incidence of the dielectric, by changing its index of refraction; scales the whole metal lobe.", { soft: UNIT }),
  specular_color: entry("specular", "specular_color", "color3", [1, 1, 1], UNIT, "Tint of the dielectric reflection seen from outside; tint near grazing angles (82\xB0) of metal."),
  specular_roughness: entry("specular", "specular_roughness", "float", 0.3, UNIT, "Perceptual roughness of the base; its square is the GGX slope. 0 is a mirror."),
  specular_roughness_anisotropy: entry("specular", "specular_roughness_anisotropy", "float", 0, UNIT, "Stretches the highlight across the tangent: 0 is round, 1 a line."),
  specular_ior: entry("specular", "specular_ior", "float", 1.5, ABOVE_ZERO, "Index of refraction of the dielectric base.", { soft: [1, 3] }),
  transmission_weight: entry("transmission", "transmission_weight", "float", 0, UNIT, "Mix from opaque (0) to transparent (1) dielectric."),
  transmission_color: entry("transmission", "transmission_color", "color3", [1, 1, 1], UNIT, "Colour of light that went straight through `transmission_depth` of the interior; with depth 0 a tint at every crossing of the surface."),
  transmission_depth: entry("transmission", "transmission_depth", "float", 0, POSITIVE, "Depth at which white light has turned into `transmission_color`; 0 switches the interior medium off.", { soft: UNIT, unit: "length" }),
  transmission_scatter: entry("transmission", "transmission_scatter", "color3", [0, 0, 0], UNIT, "Scattering coefficient of the interior, times `transmission_depth`."),
  transmission_scatter_anisotropy: entry("transmission", "transmission_scatter_anisotropy", "float", 0, SIGNED, "Henyey\u2013Greenstein g of the interior's scattering: -1 backward, 0 isotropic, 1 forward."),
  transmission_dispersion_scale: entry("transmission", "transmission_dispersion_scale", "float", 0, UNIT, "Strength of dispersion: 0 none, 1 as `transmission_dispersion_abbe_number` says."),
  transmission_dispersion_abbe_number: entry("transmission", "transmission_dispersion_abbe_number", "float", 20, ABOVE_ZERO, "Abbe number V_d of the interior: the lower, the more its index of refraction varies with the wavelength.", { soft: [9, 91] }),
  subsurface_weight: entry("subsurface", "subsurface_weight", "float", 0, UNIT, "Mix from diffuse (0) to subsurface scattering (1)."),
  subsurface_color: entry("subsurface", "subsurface_color", "color3", [0.8, 0.8, 0.8], UNIT, "Colour that multiple scattering below the surface gives back."),
  subsurface_radius: entry("subsurface", "subsurface_radius", "float", 1, POSITIVE, "Mean free path below the surface, times `subsurface_radius_scale` per channel.", { soft: UNIT, unit: "length" }),
  subsurface_radius_scale: entry("subsurface", "subsurface_radius_scale", "color3", [1, 0.5, 0.25], UNIT, "Factor per channel on `subsurface_radius`."),
  subsurface_scatter_anisotropy: entry("subsurface", "subsurface_scatter_anisotropy", "float", 0, SIGNED, "Henyey\u2013Greenstein g of subsurface scattering; on a thin wall the split between reflected (-1) and transmitted (1) light."),
  coat_weight: entry("coat", "coat_weight", "float", 0, UNIT, "Coverage of the coat."),
  coat_color: entry("coat", "coat_color", "color3", [1, 1, 1], UNIT, "Colour of the coat: what is left of white light after going through it down and up at normal incidence."),
  coat_roughness: entry("coat", "coat_roughness", "float", 0, UNIT, "Perceptual roughness of the coat."),
  coat_roughness_anisotropy: entry("coat", "coat_roughness_anisotropy", "float", 0, UNIT, "Anisotropy of the coat's highlight: 0 is round, 1 a line."),
  coat_ior: entry("coat", "coat_ior", "float", 1.6, ABOVE_ZERO, "Index of refraction of the coat.", { soft: [1, 3] }),
  coat_darkening: entry("coat", "coat_darkening", "float", 1, UNIT, "How much of the darkening by internal reflections in the coat is kept: 0 none, 1 physical."),
  fuzz_weight: entry("fuzz", "fuzz_weight", "float", 0, UNIT, "Coverage of the fuzz."),
  fuzz_color: entry("fuzz", "fuzz_color", "color3", [1, 1, 1], UNIT, "Colour of the fuzz."),
  fuzz_roughness: entry("fuzz", "fuzz_roughness", "float", 0.5, UNIT, "Roughness of the fuzz: low is velvet at the silhouette, high is dust."),
  emission_luminance: entry("emission", "emission_luminance", "float", 0, POSITIVE, "Luminance of the emission; radiance is `emission_color \xD7 emission_luminance`.", { soft: [0, 1e3], unit: "cd/m\xB2" }),
  emission_color: entry("emission", "emission_color", "color3", [1, 1, 1], POSITIVE, "Colour of the emission, not normalised.", { soft: UNIT }),
  thin_film_weight: entry("thin_film", "thin_film_weight", "float", 0, UNIT, "Coverage of the thin film."),
  thin_film_thickness: entry("thin_film", "thin_film_thickness", "float", 0.5, POSITIVE, "Thickness of the thin film.", { soft: UNIT, unit: "\xB5m" }),
  thin_film_ior: entry("thin_film", "thin_film_ior", "float", 1.4, ABOVE_ZERO, "Index of refraction of the thin film.", { soft: [1, 3] }),
  geometry_opacity: entry("geometry", "geometry_opacity", "float", 1, UNIT, "Presence of the whole surface: 0 is a hole."),
  geometry_thin_walled: entry("geometry", "geometry_thin_walled", "boolean", false, void 0, "The surface is an infinitely thin sheet with the same medium on both sides, not the boundary of a solid.", { uniform: true }),
  geometry_normal: entry("geometry", "geometry_normal", "vector3", null, void 0, "Normal of the base in the surface's frame; `null` is the unperturbed normal."),
  geometry_tangent: entry("geometry", "geometry_tangent", "vector3", null, void 0, "Tangent of the base in the surface's frame; `null` is the unperturbed tangent."),
  geometry_coat_normal: entry("geometry", "geometry_coat_normal", "vector3", null, void 0, "Normal of the coat in the surface's frame; `null` is the unperturbed normal."),
  geometry_coat_tangent: entry("geometry", "geometry_coat_tangent", "vector3", null, void 0, "Tangent of the coat in the surface's frame; `null` is the unperturbed tangent.")
});
var OPENPBR_PARAMETERS = /* @__PURE__ */ Object.freeze(/* @__PURE__ */ table2());
var OPENPBR_PARAMETER_NAMES = /* @__PURE__ */ Object.freeze(/* @__PURE__ */ Object.keys(OPENPBR_PARAMETERS));

// ../../packages/openpbr/src/parameters/validate.ts
var OpenPbrError = class extends GlanzError {
};
var isTriple = (value) => (Array.isArray(value) || ArrayBuffer.isView(value)) && value.length === 3 && Array.from(value).every((c) => typeof c === "number");
function validateParameters(given) {
  const warnings = [];
  const result = {};
  for (const [name, value] of Object.entries(given)) {
    if (value === void 0) continue;
    const info = Object.hasOwn(OPENPBR_PARAMETERS, name) ? OPENPBR_PARAMETERS[name] : void 0;
    if (!info) {
      warnings.push({ code: "openpbr/unknown-parameter", parameter: name, message: `OpenPBR has no parameter "${name}"; it is ignored.` });
      continue;
    }
    const wrong = (wanted) => new OpenPbrError("openpbr/parameter-type", `OpenPBR parameter "${name}" takes ${wanted}, got ${JSON.stringify(value) ?? String(value)}.`);
    const repair = (number, initial) => {
      if (!Number.isFinite(number)) {
        warnings.push({ code: "openpbr/not-finite", parameter: name, message: `OpenPBR parameter "${name}" is ${number}; its default ${initial} is used.` });
        return initial;
      }
      const [min, max] = info.range ?? [-Infinity, Infinity];
      const clamped = Math.min(Math.max(number, min), max);
      if (clamped !== number) warnings.push({ code: "openpbr/clamped", parameter: name, message: `OpenPBR parameter "${name}" is ${number}, outside ${min}..${max}; ${clamped} is used.` });
      return clamped;
    };
    if (info.type === "float") {
      if (typeof value !== "number") throw wrong("a number");
      result[name] = repair(value, info.default);
    } else if (info.type === "boolean") {
      if (typeof value !== "boolean") throw wrong("true or false");
      result[name] = value;
    } else if (value === null && info.type === "vector3") {
      result[name] = null;
    } else {
      if (!isTriple(value)) throw wrong("three numbers");
      const initial = info.default;
      result[name] = Array.from(value, (component, i) => repair(component, initial?.[i] ?? (i === 2 ? 1 : 0)));
    }
  }
  return { parameters: result, warnings };
}
function defaultParameters() {
  return Object.fromEntries(OPENPBR_PARAMETER_NAMES.map((name) => [name, OPENPBR_PARAMETERS[name].default]));
}
function resolveParameters(given = {}) {
  return { ...defaultParameters(), ...validateParameters(given).parameters };
}

// ../../packages/openpbr/src/wgsl/record.ts
var openPbrStruct = /* @__PURE__ */ struct("OpenPbrParameters", {
  base_color: "vec3f",
  base_weight: "f32",
  specular_color: "vec3f",
  specular_weight: "f32",
  emission_color: "vec3f",
  emission_luminance: "f32",
  transmission_color: "vec3f",
  transmission_weight: "f32",
  base_diffuse_roughness: "f32",
  base_metalness: "f32",
  specular_roughness: "f32",
  specular_roughness_anisotropy: "f32",
  specular_ior: "f32",
  geometry_opacity: "f32",
  transmission_depth: "f32",
  /** 1 for a thin wall, else 0. */
  geometry_thin_walled: "u32"
});
function packOpenPbr(buffer, index, parameters) {
  openPbrStruct.write(buffer, index, {
    base_color: parameters.base_color,
    base_weight: parameters.base_weight,
    specular_color: parameters.specular_color,
    specular_weight: parameters.specular_weight,
    emission_color: parameters.emission_color,
    emission_luminance: parameters.emission_luminance,
    transmission_color: parameters.transmission_color,
    transmission_weight: parameters.transmission_weight,
    base_diffuse_roughness: parameters.base_diffuse_roughness,
    base_metalness: parameters.base_metalness,
    specular_roughness: parameters.specular_roughness,
    specular_roughness_anisotropy: parameters.specular_roughness_anisotropy,
    specular_ior: parameters.specular_ior,
    geometry_opacity: parameters.geometry_opacity,
    transmission_depth: parameters.transmission_depth,
    geometry_thin_walled: parameters.geometry_thin_walled ? 1 : 0
  });
}

// ../../packages/openpbr/src/wgsl/features.ts
function requiredFeatures(materials, { textured = [], multipleScattering = true } = {}) {
  const all = materials.map((material) => resolveParameters(material));
  const isTextured = (name) => textured.includes(name);
  const metal2 = all.some((p) => p.base_metalness > 0 && p.specular_weight > 0);
  const insulators = all.filter((p) => p.base_metalness < 1 || isTextured("base_metalness"));
  const dielectric = insulators.some((p) => p.specular_weight > 0 && (p.specular_ior !== 1 || isTextured("specular_ior")));
  const diffuse = insulators.some((p) => p.base_weight > 0 && p.base_color.some((c) => c > 0));
  const specular = metal2 || dielectric;
  return {
    OPENPBR_SPECULAR: specular,
    OPENPBR_METAL: metal2,
    OPENPBR_DIELECTRIC: dielectric,
    OPENPBR_DIFFUSE: diffuse || !specular,
    OPENPBR_DIFFUSE_ROUGHNESS: insulators.some((p) => p.base_diffuse_roughness > 0),
    OPENPBR_ANISOTROPY: specular && all.some((p) => p.specular_roughness_anisotropy > 0),
    OPENPBR_MULTISCATTER: multipleScattering,
    OPENPBR_EMISSION: all.some((p) => p.emission_luminance > 0)
  };
}

// ../../packages/openpbr/src/tables/layout.ts
var outerTotal = TABLE_LAYOUT.outer;
var inner = outerTotal + TABLE_LAYOUT.outerTotal;
var innerTotal = inner + TABLE_LAYOUT.inner;
var TABLE_BLOCKS = {
  /** Share of the energy that is reflected, over the Fresnel reflectance at the softened cosine; seen from the thinner medium. */
  outer: [0, TABLE_LAYOUT.outer],
  /** Energy reflected and refracted by single scattering; seen from the thinner medium. */
  outerTotal: [outerTotal, TABLE_LAYOUT.outerTotal],
  /** Share of the energy that is reflected; seen from the denser medium. */
  inner: [inner, TABLE_LAYOUT.inner],
  /** Energy reflected and refracted by single scattering; seen from the denser medium. */
  innerTotal: [innerTotal, TABLE_LAYOUT.innerTotal]
};
var TABLE_DEPTH = innerTotal + TABLE_LAYOUT.innerTotal;
var TABLE_ANGLES = TABLE_LAYOUT.angles;
var TABLE_ROUGHNESSES = TABLE_LAYOUT.roughnesses;
var TABLE_CONDUCTOR = TABLE_LAYOUT.conductor;
var TABLE_MIN_ROUGHNESS = 0.01;

// ../../packages/openpbr/src/wgsl/fresnel.wgsl.ts
var openpbrFresnelDielectric = wgslModule(
  "openpbr/fresnel-dielectric",
  /* wgsl */
  `fn openpbr_fresnel_dielectric(eta: f32, c: f32) -> f32 {
  let g2 = (eta - 1.0) * (eta + 1.0) + c * c;
  if (g2 <= 0.0) { return 1.0; }
  let g = sqrt(g2);
  let a = (eta - 1.0) * (eta + 1.0) / ((g + c) * (g + c));
  let b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return min(0.5 * a * a * (1.0 + b * b), 1.0);
}`
);
var openpbrFresnelMetal = wgslModule(
  "openpbr/fresnel-metal",
  /* wgsl */
  `// Reflectance taken away at the cosine 1/7 (82 degrees), over that cosine's \u03BC (1 - \u03BC)\u2076.
fn openpbr_f82_edge(f0: vec3f, tint: vec3f) -> vec3f {
  let schlick = f0 + (1.0 - f0) * 0.46266436;
  return schlick * (1.0 - tint) * 17.6513846;
}

fn openpbr_f82(f0: vec3f, f90: f32, edge: vec3f, c: f32) -> vec3f {
  let m = 1.0 - c;
  let m5 = m * m * m * m * m;
  return clamp(f0 + (f90 - f0) * m5 - edge * (c * m5 * m), vec3f(0.0), vec3f(1.0));
}`
);

// ../../packages/openpbr/src/wgsl/energy.wgsl.ts
var float = (value) => Number.isInteger(value) ? `${value}.0` : String(value);
var axis = (first, count, size) => [float((first + 0.5) / size), float((count - 1) / size)];
var [angle0, angle1] = axis(0, TABLE_ANGLES, TABLE_ANGLES + 1);
var [rough0, rough1] = axis(0, TABLE_ROUGHNESSES, TABLE_ROUGHNESSES);
var [metal0, metal1] = axis(0, TABLE_CONDUCTOR, TABLE_CONDUCTOR);
var slice = (block2) => axis(TABLE_BLOCKS[block2][0], TABLE_BLOCKS[block2][1], TABLE_DEPTH);
var [outer0, outer1] = slice("outer");
var [outerTotal0, outerTotal1] = slice("outerTotal");
var [inner0, inner1] = slice("inner");
var [innerTotal0, innerTotal1] = slice("innerTotal");
var minRoot = Math.sqrt(TABLE_MIN_ROUGHNESS);
var unit2 = `clamp((sqrt(r) - ${float(minRoot)}) * ${float(1 / (1 - minRoot))}, 0.0, 1.0)`;
var openpbrEnergy = wgslModule(
  "openpbr/energy",
  /* wgsl */
  `// \u221Acosine, spread so that the dip of masking keeps its place as the roughness varies.
fn openpbr_energy_angle(r: f32, mu: f32) -> f32 {
  let x = sqrt(mu);
  return x * (1.0 + r) / (x + r);
}

//#if OPENPBR_METAL
// Energy that a perfect mirror of roughness r reflects by single scattering.
fn openpbr_energy_conductor(roughness: f32, mu: f32) -> f32 {
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  return openpbr_table_conductor(vec2f(${metal0} + ${metal1} * openpbr_energy_angle(r, mu), ${metal0} + ${metal1} * ${unit2}));
}
//#endif

//#if OPENPBR_DIELECTRIC
// Share of the energy that the interface reflects, the rest being refracted.
fn openpbr_energy_share(epsilon: f32, roughness: f32, mu: f32) -> f32 {
  if (epsilon == 0.0) { return 0.0; }
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  let eta = (1.0 + epsilon) / (1.0 - epsilon);
  let z = sqrt(abs(epsilon));
  var at = vec3f(openpbr_energy_angle(r, mu), ${rough0} + ${rough1} * ${unit2}, ${outer0} + ${outer1} * z);
  var scale = 1.0;
  if (epsilon > 0.0) {
    scale = openpbr_fresnel_dielectric(eta, mu + 0.8 * r * r * (1.0 - mu));
  } else {
    let critical = sqrt(1.0 - eta * eta);
    at.x = select(0.5 - 0.5 * sqrt(max(critical - mu, 0.0) / critical), 0.5 + 0.5 * sqrt(max(mu - critical, 0.0) / (1.0 - critical)), mu > critical);
    at.z = ${inner0} + ${inner1} * z;
  }
  at.x = ${angle0} + ${angle1} * at.x;
  return min(openpbr_table_dielectric(at) * scale, 1.0);
}

// The cosine-weighted mean of openpbr_energy_share over all directions.
fn openpbr_energy_share_mean(epsilon: f32, roughness: f32) -> f32 {
  if (epsilon == 0.0) { return 0.0; }
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  let e = abs(epsilon);
  let z = sqrt(e);
  // Mean transmittance of the smooth interface, about; the table holds the ratio to it.
  var through = 1.0 - 2.0 * e / (5.0864 - 3.085 * e);
  if (epsilon < 0.0) { through *= (1.0 - e) * (1.0 - e) / ((1.0 + e) * (1.0 + e)); }
  return 1.0 - min(through * openpbr_table_dielectric(vec3f(${float((TABLE_ANGLES + 0.5) / (TABLE_ANGLES + 1))}, ${rough0} + ${rough1} * ${unit2}, select(${inner0} + ${inner1} * z, ${outer0} + ${outer1} * z, epsilon > 0.0))), 1.0);
}

// Energy that the interface reflects and refracts by single scattering.
fn openpbr_energy_total(epsilon: f32, roughness: f32, mu: f32) -> f32 {
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  let z = sqrt(abs(epsilon));
  return openpbr_table_dielectric(vec3f(${angle0} + ${angle1} * openpbr_energy_angle(r, mu), ${rough0} + ${rough1} * ${unit2}, select(${innerTotal0} + ${innerTotal1} * z, ${outerTotal0} + ${outerTotal1} * z, epsilon >= 0.0)));
}
//#endif`,
  [openpbrFresnelDielectric]
);

// ../../packages/openpbr/src/wgsl/dielectric.wgsl.ts
var openpbrDielectric = wgslModule(
  "openpbr/dielectric",
  /* wgsl */
  `struct OpenPbrDielectric {
  eta: f32,
  epsilon: f32,
  roughness: f32,
  // Share of the energy that is reflected towards the viewer.
  share: f32,
  // Factor on the reflection: tint and multiple-scattering compensation.
  scale: vec3f,
}

fn openpbr_dielectric_epsilon(p: OpenPbrParameters) -> f32 {
  let epsilon = (p.specular_ior - 1.0) / (p.specular_ior + 1.0);
  return sign(epsilon) * min(abs(epsilon) * sqrt(p.specular_weight), 0.9999);
}

// view_roughness: see openpbr_view_roughness; view: see openpbr_mirror_view.
fn openpbr_dielectric_prepare(p: OpenPbrParameters, mu: f32, view_roughness: f32, view: vec2f) -> OpenPbrDielectric {
  var d: OpenPbrDielectric;
  d.epsilon = openpbr_dielectric_epsilon(p);
  d.eta = (1.0 + d.epsilon) / (1.0 - d.epsilon);
  d.roughness = p.specular_roughness;
  d.share = openpbr_energy_share(d.epsilon, view_roughness, mu);
  d.scale = p.specular_color;
  //#if OPENPBR_MULTISCATTER
  d.scale /= openpbr_energy_total(d.epsilon, view.x, view.y);
  //#endif
  return d;
}`,
  [openPbrStruct.module, openpbrFresnelDielectric, openpbrEnergy]
);

// ../../packages/openpbr/src/wgsl/diffuse.wgsl.ts
var openpbrCosine = wgslModule(
  "openpbr/cosine",
  /* wgsl */
  `fn openpbr_cosine_sample(u: vec2f) -> vec3f {
  let phi = 6.2831853 * u.x;
  let r = sqrt(u.y);
  return vec3f(r * cos(phi), r * sin(phi), sqrt(1.0 - u.y));
}`
);
var openpbrEon = wgslModule(
  "openpbr/eon",
  /* wgsl */
  `fn openpbr_eon_single_albedo(c: f32, roughness: f32) -> f32 {
  let m = 1.0 - c;
  let g = m * (0.0571085289 + m * (0.491881867 + m * (-0.332181442 + m * 0.0714429953)));
  return (1.0 + roughness * g) / (1.0 + 0.28779342 * roughness);
}

fn openpbr_eon(albedo: vec3f, roughness: f32, wo: vec3f, wi: vec3f) -> vec3f {
  let a = 1.0 / (1.0 + 0.28779342 * roughness);
  let s = dot(wo.xy, wi.xy);
  let single = a * (1.0 + roughness * select(s, s / max(max(wo.z, wi.z), 1e-7), s > 0.0));
  let mean = a * (1.0 + 0.07248821 * roughness);
  let lost = (1.0 - openpbr_eon_single_albedo(wo.z, roughness)) * (1.0 - openpbr_eon_single_albedo(wi.z, roughness)) / max(1.0 - mean, 1e-7);
  let multiple = albedo * albedo * (mean * lost) / (1.0 - albedo * (1.0 - mean));
  return (albedo * single + multiple) * 0.31830989;
}`
);

// ../../packages/openpbr/src/wgsl/emission.wgsl.ts
var openpbrEmission = wgslModule(
  "openpbr/emission",
  /* wgsl */
  `fn openpbr_emission(p: OpenPbrParameters, wo: vec3f) -> vec3f {
  return select(vec3f(0.0), p.emission_color * p.emission_luminance, wo.z > 0.0);
}`,
  [openPbrStruct.module]
);
var openpbrOpacity = wgslModule(
  "openpbr/opacity",
  /* wgsl */
  `fn openpbr_opacity(p: OpenPbrParameters) -> f32 {
  return clamp(p.geometry_opacity, 0.0, 1.0);
}`,
  [openPbrStruct.module]
);

// ../../packages/openpbr/src/wgsl/ggx.wgsl.ts
var openpbrGgx = wgslModule(
  "openpbr/ggx",
  /* wgsl */
  `fn openpbr_alpha(roughness: f32, anisotropy: f32) -> vec2f {
  let alpha = roughness * roughness;
  //#if OPENPBR_ANISOTROPY
  let flat = 1.0 - anisotropy;
  let along = alpha * sqrt(2.0 / (1.0 + flat * flat));
  return max(vec2f(along, flat * along), vec2f(1e-4));
  //#else
  return vec2f(max(alpha, 1e-4));
  //#endif
}

// \u221A(cos\xB2 + \u03B1\xB2 sin\xB2): twice the projected area of the microsurface, less the cosine.
fn openpbr_ggx_stretch(alpha: vec2f, w: vec3f) -> f32 {
  return length(vec3f(alpha * w.xy, w.z));
}

fn openpbr_ggx(alpha: vec2f, wo: vec3f, wi: vec3f, h: vec3f) -> vec2f {
  let slope = h.xy / alpha;
  let t = dot(slope, slope) + h.z * h.z;
  let d = 0.15915494 / (alpha.x * alpha.y * t * t);
  let so = openpbr_ggx_stretch(alpha, wo);
  let si = openpbr_ggx_stretch(alpha, wi);
  return d * vec2f(wi.z / (wo.z * si + wi.z * so), 1.0 / (wo.z + so));
}

fn openpbr_view_roughness(alpha: vec2f, roughness: f32, w: vec3f) -> f32 {
  //#if OPENPBR_ANISOTROPY
  return sqrt(min(length(vec3f(alpha * w.xy, roughness * roughness * w.z)), 1.0));
  //#else
  return roughness;
  //#endif
}

// (roughness, cosine)
fn openpbr_mirror_view(alpha: vec2f, roughness: f32, anisotropy: f32, w: vec3f, mu: f32) -> vec2f {
  //#if OPENPBR_ANISOTROPY
  let steepness = length(alpha * w.xy) / max(roughness * roughness, 1e-4);
  return vec2f(roughness * (1.0 - 0.065 * anisotropy * roughness), mu / length(vec2f(mu, steepness)));
  //#else
  return vec2f(roughness, mu);
  //#endif
}

// The half vector; stays finite where two grazing directions cancel.
fn openpbr_half(wo: vec3f, wi: vec3f) -> vec3f {
  let h = wo + wi;
  return normalize(vec3f(h.xy, max(h.z, 1e-7)));
}

// A half vector visible from wo (Dupuy and Benyoub 2023, spherical caps).
fn openpbr_ggx_sample(alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
  let v = normalize(vec3f(alpha * wo.xy, wo.z));
  let phi = 6.2831853 * u.x;
  let z = (1.0 - u.y) * (1.0 + v.z) - v.z;
  let r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
  let h = vec3f(r * cos(phi), r * sin(phi), z) + v;
  return normalize(vec3f(alpha * h.xy, max(h.z, 1e-7)));
}`
);

// ../../packages/openpbr/src/wgsl/metal.wgsl.ts
var openpbrMetal = wgslModule(
  "openpbr/metal",
  /* wgsl */
  `struct OpenPbrMetal {
  // Reflectance at normal incidence, and what the edge tint takes away, times specular_weight.
  f0: vec3f,
  f90: f32,
  edge: vec3f,
  // Factor on the lobe: metalness and the multiple-scattering compensation.
  scale: vec3f,
  // Directional albedo towards the viewer, about: the reflectance at a typical visible facet, and all that bounces on.
  albedo: vec3f,
}

// view: see openpbr_mirror_view.
fn openpbr_metal_prepare(p: OpenPbrParameters, mu: f32, view: vec2f) -> OpenPbrMetal {
  let f0 = p.base_weight * p.base_color;
  var metal: OpenPbrMetal;
  let weight = min(p.specular_weight, 1e6);
  metal.f0 = weight * f0;
  metal.f90 = weight;
  metal.edge = weight * openpbr_f82_edge(f0, p.specular_color);
  metal.scale = vec3f(p.base_metalness);
  //#if OPENPBR_MULTISCATTER
  let energy = openpbr_energy_conductor(view.x, view.y);
  metal.scale *= 1.0 + min(f0 * max(weight, 1.0), vec3f(1.0)) * ((1.0 - energy) / energy);
  //#endif
  metal.albedo = openpbr_metal_fresnel(metal, mu + 0.8 * p.specular_roughness * p.specular_roughness * (1.0 - mu));
  //#if OPENPBR_MULTISCATTER
  metal.albedo *= energy;
  //#endif
  return metal;
}

fn openpbr_metal_fresnel(metal: OpenPbrMetal, c: f32) -> vec3f {
  return metal.scale * openpbr_f82(metal.f0, metal.f90, metal.edge, c);
}`,
  [openPbrStruct.module, openpbrFresnelMetal, gated("OPENPBR_MULTISCATTER", openpbrEnergy)]
);

// ../../packages/openpbr/src/wgsl/bsdf.wgsl.ts
var openpbr = wgslModule(
  "openpbr",
  /* wgsl */
  `struct OpenPbrBsdf {
  alpha: vec2f,
  // Probability of sampling the microfacet lobe.
  specular_probability: f32,
  // Factor on the diffuse lobe, without its colour.
  diffuse_scale: f32,
  diffuse_color: vec3f,
  diffuse_roughness: f32,
  // Directional albedo.
  albedo: vec3f,
  dielectric_weight: f32,
  //#if OPENPBR_METAL
  metal: OpenPbrMetal,
  //#endif
  //#if OPENPBR_DIELECTRIC
  dielectric: OpenPbrDielectric,
  //#endif
}

struct OpenPbrSample {
  wi: vec3f,
  pdf: f32,
  // f \xB7 |cos \u03B8_i| / pdf of the whole mixture.
  weight: vec3f,
  valid: bool,
}

fn openpbr_prepare(p: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf {
  var b: OpenPbrBsdf;
  let mu = clamp(wo.z, 1e-5, 1.0);
  var specular = vec3f(0.0);
  b.dielectric_weight = 1.0;
  //#if OPENPBR_SPECULAR
  b.alpha = openpbr_alpha(p.specular_roughness, p.specular_roughness_anisotropy);
  let view = openpbr_mirror_view(b.alpha, p.specular_roughness, p.specular_roughness_anisotropy, wo, mu);
  //#endif
  //#if OPENPBR_METAL
  b.metal = openpbr_metal_prepare(p, mu, view);
  specular += b.metal.albedo;
  b.dielectric_weight -= p.base_metalness;
  //#endif
  b.diffuse_scale = b.dielectric_weight * p.base_weight;
  //#if OPENPBR_DIELECTRIC
  b.dielectric = openpbr_dielectric_prepare(p, mu, openpbr_view_roughness(b.alpha, p.specular_roughness, wo), view);
  specular += b.dielectric_weight * b.dielectric.share * p.specular_color;
  b.diffuse_scale *= 1.0 - b.dielectric.share;
  //#endif
  b.albedo = specular;
  b.specular_probability = 1.0;
  //#if OPENPBR_DIFFUSE
  b.diffuse_color = p.base_color;
  b.diffuse_roughness = p.base_diffuse_roughness;
  let diffuse = b.diffuse_scale * p.base_color;
  b.albedo += diffuse;
  let bright = dot(specular, vec3f(1.0));
  let total = bright + dot(diffuse, vec3f(1.0));
  b.specular_probability = select(0.5, bright / total, total > 0.0);
  //#if OPENPBR_DIELECTRIC
  let reflected = openpbr_energy_share_mean(b.dielectric.epsilon, b.dielectric.roughness);
  b.diffuse_scale /= max(1.0 - reflected, 1e-4);
  //#if OPENPBR_DIFFUSE_ROUGHNESS
  // EON is not as even as Lambert: where it peaks, the weights would give back more than they get.
  b.diffuse_scale *= 1.0 - 0.08 * b.diffuse_roughness * reflected;
  //#endif
  //#endif
  //#endif
  return b;
}

// (f \xB7 |cos \u03B8_i|, pdf) of a pair of directions with its half vector.
fn openpbr_scatter(b: OpenPbrBsdf, wo: vec3f, wi: vec3f, h: vec3f) -> vec4f {
  if (min(wo.z, wi.z) <= 0.0) { return vec4f(0.0); }
  var result = vec4f(0.0);
  //#if OPENPBR_SPECULAR
  let c = clamp(dot(wo, h), 0.0, 1.0);
  let ggx = openpbr_ggx(b.alpha, wo, wi, h);
  var reflectance = vec3f(0.0);
  //#if OPENPBR_METAL
  reflectance += openpbr_metal_fresnel(b.metal, c);
  //#endif
  //#if OPENPBR_DIELECTRIC
  reflectance += b.dielectric.scale * (b.dielectric_weight * openpbr_fresnel_dielectric(b.dielectric.eta, c));
  //#endif
  result += vec4f(reflectance * ggx.x, b.specular_probability * ggx.y);
  //#endif
  //#if OPENPBR_DIFFUSE
  var scale = b.diffuse_scale * wi.z;
  var probability = 1.0;
  //#if OPENPBR_SPECULAR
  probability -= b.specular_probability;
  //#endif
  //#if OPENPBR_DIELECTRIC
  scale *= 1.0 - openpbr_energy_share(b.dielectric.epsilon, openpbr_view_roughness(b.alpha, b.dielectric.roughness, wi), wi.z);
  //#endif
  //#if OPENPBR_DIFFUSE_ROUGHNESS
  let diffuse = openpbr_eon(b.diffuse_color, b.diffuse_roughness, wo, wi);
  //#else
  let diffuse = b.diffuse_color * 0.31830989;
  //#endif
  result += vec4f(diffuse * scale, probability * wi.z * 0.31830989);
  //#endif
  return result;
}

fn openpbr_eval_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec4f {
  return openpbr_scatter(b, wo, wi, openpbr_half(wo, wi));
}

fn openpbr_eval(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec3f {
  return openpbr_eval_pdf(b, wo, wi).xyz;
}

fn openpbr_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> f32 {
  return openpbr_eval_pdf(b, wo, wi).w;
}

fn openpbr_sample(b: OpenPbrBsdf, wo: vec3f, u: vec3f) -> OpenPbrSample {
  var s: OpenPbrSample;
  var h = vec3f(0.0, 0.0, 1.0);
  //#if OPENPBR_SPECULAR
  if (u.z < b.specular_probability) {
    h = openpbr_ggx_sample(b.alpha, wo, u.xy);
    s.wi = 2.0 * dot(wo, h) * h - wo;
  }
  //#if OPENPBR_DIFFUSE
  else {
    s.wi = openpbr_cosine_sample(u.xy);
    h = openpbr_half(wo, s.wi);
  }
  //#endif
  //#else
  s.wi = openpbr_cosine_sample(u.xy);
  //#endif
  let f = openpbr_scatter(b, wo, s.wi, h);
  s.pdf = f.w;
  s.valid = f.w > 0.0;
  s.weight = select(vec3f(0.0), f.xyz / f.w, s.valid);
  return s;
}

fn openpbr_albedo(b: OpenPbrBsdf, wo: vec3f) -> vec3f {
  return select(vec3f(0.0), min(b.albedo, vec3f(1.0)), wo.z > 0.0);
}`,
  [
    openPbrStruct.module,
    openpbrEmission,
    openpbrOpacity,
    gated("OPENPBR_SPECULAR", openpbrGgx),
    gated("OPENPBR_METAL", openpbrMetal),
    gated("OPENPBR_DIELECTRIC", openpbrDielectric),
    gated("OPENPBR_DIFFUSE", openpbrCosine),
    gated("OPENPBR_DIFFUSE_ROUGHNESS", openpbrEon)
  ]
);

// ../../packages/bvh/src/layout.ts
var NODE_WORDS = 16;
var TRIANGLE_WORDS = 12;
var BLAS_MAX_DEPTH = 40;
var TLAS_MAX_DEPTH = 22;
var BVH_STACK_SIZE = BLAS_MAX_DEPTH + TLAS_MAX_DEPTH + 2;
var LEAF = 2147483648;
var LEAF_FIRST_BITS = 27;
var LEAF_MAX = 16;
var MAX_PRIMITIVES = 2 ** LEAF_FIRST_BITS - LEAF_MAX;
var FAR = 34028234663852886e22;
var leafReference = (first, count) => (LEAF | count - 1 << LEAF_FIRST_BITS | first) >>> 0;
var leafFirst = (reference2) => reference2 & 2 ** LEAF_FIRST_BITS - 1;
var leafCount = (reference2) => (reference2 >>> LEAF_FIRST_BITS & LEAF_MAX - 1) + 1;
var bvhNodeStruct = struct("BvhNode", {
  left_min: "vec3f",
  left: "u32",
  left_max: "vec3f",
  right: "u32",
  right_min: "vec3f",
  parent: "u32",
  right_max: "vec3f",
  reserved: "u32"
});
var LEFT_MIN = 0;
var LEFT = 3;
var LEFT_MAX = 4;
var RIGHT = 7;
var RIGHT_MIN = 8;
var PARENT = 11;
var RIGHT_MAX = 12;
var bvhInstanceStruct = struct("BvhInstance", {
  to_object_0: "vec4f",
  to_object_1: "vec4f",
  to_object_2: "vec4f",
  blas_node: "u32",
  triangle_offset: "u32",
  id: "u32",
  flags: "u32"
});

// ../../packages/bvh/src/build/binned-sah.ts
var TASK = 17;
var area2 = (x, y, z) => x * y + y * z + z * x;
function buildBinnedSah(boxes, order2, options) {
  const { maxLeaf, maxDepth, bins, nodeCost } = options;
  const count = order2.length;
  const nodes = new Float32Array(Math.max(count - 1, 1) * NODE_WORDS);
  const words = new Uint32Array(nodes.buffer);
  let nodeCount = 0;
  const writeChild = (node, right2, reference2, x0, y0, z0, x1, y1, z1) => {
    const base = node * NODE_WORDS;
    const min = base + (right2 ? RIGHT_MIN : LEFT_MIN);
    const max = base + (right2 ? RIGHT_MAX : LEFT_MAX);
    nodes[min] = x0;
    nodes[min + 1] = y0;
    nodes[min + 2] = z0;
    nodes[max] = x1;
    nodes[max + 1] = y1;
    nodes[max + 2] = z1;
    words[base + (right2 ? RIGHT : LEFT)] = reference2;
  };
  if (count < 2) {
    const leaf = leafReference(0, 1);
    const b = (order2[0] ?? 0) * 6;
    if (count === 1) writeChild(0, 0, leaf, boxes[b], boxes[b + 1], boxes[b + 2], boxes[b + 3], boxes[b + 4], boxes[b + 5]);
    else writeChild(0, 0, leaf, FAR, FAR, FAR, FAR, FAR, FAR);
    writeChild(0, 1, leaf, FAR, FAR, FAR, FAR, FAR, FAR);
    return { nodes, nodeCount: 1 };
  }
  const binBoxes = new Float64Array(3 * bins * 6);
  const binCounts = new Uint32Array(3 * bins);
  const leftCosts = new Float64Array(bins);
  const tasks = new Float64Array((maxDepth + 3) * TASK);
  const left = new Float64Array(12);
  const right = new Float64Array(12);
  const clear = (box2) => {
    for (let i = 0; i < 12; i += 6) {
      box2[i] = box2[i + 1] = box2[i + 2] = Infinity;
      box2[i + 3] = box2[i + 4] = box2[i + 5] = -Infinity;
    }
  };
  const grow = (box2, primitive) => {
    const b = primitive * 6;
    const x0 = boxes[b], y0 = boxes[b + 1], z0 = boxes[b + 2];
    const x1 = boxes[b + 3], y1 = boxes[b + 4], z1 = boxes[b + 5];
    if (x0 < box2[0]) box2[0] = x0;
    if (y0 < box2[1]) box2[1] = y0;
    if (z0 < box2[2]) box2[2] = z0;
    if (x1 > box2[3]) box2[3] = x1;
    if (y1 > box2[4]) box2[4] = y1;
    if (z1 > box2[5]) box2[5] = z1;
    const x = x0 + x1, y = y0 + y1, z = z0 + z1;
    if (x < box2[6]) box2[6] = x;
    if (y < box2[7]) box2[7] = y;
    if (z < box2[8]) box2[8] = z;
    if (x > box2[9]) box2[9] = x;
    if (y > box2[10]) box2[10] = y;
    if (z > box2[11]) box2[11] = z;
  };
  const push = (top2, first, end, parent, side, depth, box2) => {
    const t = top2 * TASK;
    tasks[t] = first;
    tasks[t + 1] = end;
    tasks[t + 2] = parent;
    tasks[t + 3] = side;
    tasks[t + 4] = depth;
    tasks.set(box2, t + 5);
  };
  clear(left);
  for (let i = 0; i < count; i++) grow(left, order2[i]);
  push(0, 0, count, -1, 0, 0, left);
  let top = 1;
  while (top > 0) {
    const t = --top * TASK;
    const first = tasks[t], end = tasks[t + 1], parent = tasks[t + 2], side = tasks[t + 3], depth = tasks[t + 4];
    const x0 = tasks[t + 5], y0 = tasks[t + 6], z0 = tasks[t + 7], x1 = tasks[t + 8], y1 = tasks[t + 9], z1 = tasks[t + 10];
    const cx0 = tasks[t + 11], cy0 = tasks[t + 12], cz0 = tasks[t + 13], cx1 = tasks[t + 14], cy1 = tasks[t + 15], cz1 = tasks[t + 16];
    const size = end - first;
    const isRoot = parent < 0;
    let bestAxis = -1, bestBin = 0, bestCost = Infinity;
    const kx = bins / (cx1 - cx0), ky = bins / (cy1 - cy0), kz = bins / (cz1 - cz0);
    const needed = Math.ceil(Math.log2(size / maxLeaf)) + 1;
    if (size > 1 && depth + needed < maxDepth) {
      const useX = kx < Infinity, useY = ky < Infinity, useZ = kz < Infinity;
      for (let i = 0; i < 3 * bins; i++) {
        const b = i * 6;
        binBoxes[b] = binBoxes[b + 1] = binBoxes[b + 2] = Infinity;
        binBoxes[b + 3] = binBoxes[b + 4] = binBoxes[b + 5] = -Infinity;
        binCounts[i] = 0;
      }
      for (let i = first; i < end; i++) {
        const b = order2[i] * 6;
        const px0 = boxes[b], py0 = boxes[b + 1], pz0 = boxes[b + 2];
        const px1 = boxes[b + 3], py1 = boxes[b + 4], pz1 = boxes[b + 5];
        for (let axis3 = 0; axis3 < 3; axis3++) {
          let bin;
          if (axis3 === 0) {
            if (!useX) continue;
            bin = (px0 + px1 - cx0) * kx | 0;
          } else if (axis3 === 1) {
            if (!useY) continue;
            bin = (py0 + py1 - cy0) * ky | 0;
          } else {
            if (!useZ) continue;
            bin = (pz0 + pz1 - cz0) * kz | 0;
          }
          bin = (bin >= bins ? bins - 1 : bin) + axis3 * bins;
          binCounts[bin] = binCounts[bin] + 1;
          const o = bin * 6;
          if (px0 < binBoxes[o]) binBoxes[o] = px0;
          if (py0 < binBoxes[o + 1]) binBoxes[o + 1] = py0;
          if (pz0 < binBoxes[o + 2]) binBoxes[o + 2] = pz0;
          if (px1 > binBoxes[o + 3]) binBoxes[o + 3] = px1;
          if (py1 > binBoxes[o + 4]) binBoxes[o + 4] = py1;
          if (pz1 > binBoxes[o + 5]) binBoxes[o + 5] = pz1;
        }
      }
      for (let axis3 = 0; axis3 < 3; axis3++) {
        if (axis3 === 0 ? !useX : axis3 === 1 ? !useY : !useZ) continue;
        let n = 0, ax0 = Infinity, ay0 = Infinity, az0 = Infinity, ax1 = -Infinity, ay1 = -Infinity, az1 = -Infinity;
        for (let bin = 0; bin < bins - 1; bin++) {
          const o = (axis3 * bins + bin) * 6;
          n += binCounts[axis3 * bins + bin];
          ax0 = Math.min(ax0, binBoxes[o]);
          ay0 = Math.min(ay0, binBoxes[o + 1]);
          az0 = Math.min(az0, binBoxes[o + 2]);
          ax1 = Math.max(ax1, binBoxes[o + 3]);
          ay1 = Math.max(ay1, binBoxes[o + 4]);
          az1 = Math.max(az1, binBoxes[o + 5]);
          leftCosts[bin] = n === 0 ? Infinity : n * area2(ax1 - ax0, ay1 - ay0, az1 - az0);
        }
        n = 0;
        ax0 = ay0 = az0 = Infinity;
        ax1 = ay1 = az1 = -Infinity;
        for (let bin = bins - 1; bin > 0; bin--) {
          const o = (axis3 * bins + bin) * 6;
          n += binCounts[axis3 * bins + bin];
          ax0 = Math.min(ax0, binBoxes[o]);
          ay0 = Math.min(ay0, binBoxes[o + 1]);
          az0 = Math.min(az0, binBoxes[o + 2]);
          ax1 = Math.max(ax1, binBoxes[o + 3]);
          ay1 = Math.max(ay1, binBoxes[o + 4]);
          az1 = Math.max(az1, binBoxes[o + 5]);
          if (n === 0) continue;
          const cost = n * area2(ax1 - ax0, ay1 - ay0, az1 - az0) + leftCosts[bin - 1];
          if (cost < bestCost) {
            bestCost = cost;
            bestAxis = axis3;
            bestBin = bin;
          }
        }
      }
    }
    const box2 = area2(x1 - x0, y1 - y0, z1 - z0);
    if (!isRoot && size <= maxLeaf && !(bestCost + nodeCost * box2 < size * box2)) {
      writeChild(parent, side, leafReference(first, size), x0, y0, z0, x1, y1, z1);
      continue;
    }
    const node = nodeCount++;
    if (!isRoot) {
      writeChild(parent, side, node, x0, y0, z0, x1, y1, z1);
      words[node * NODE_WORDS + PARENT] = parent;
    }
    clear(left);
    clear(right);
    let middle = first;
    if (bestAxis >= 0) {
      const low = bestAxis === 0 ? cx0 : bestAxis === 1 ? cy0 : cz0;
      const scale = bestAxis === 0 ? kx : bestAxis === 1 ? ky : kz;
      let j = end;
      while (middle < j) {
        const primitive = order2[middle];
        const b = primitive * 6 + bestAxis;
        let bin = (boxes[b] + boxes[b + 3] - low) * scale | 0;
        if (bin >= bins) bin = bins - 1;
        if (bin < bestBin) {
          grow(left, primitive);
          middle++;
        } else {
          grow(right, primitive);
          order2[middle] = order2[--j];
          order2[j] = primitive;
        }
      }
    } else {
      const ex = cx1 - cx0, ey = cy1 - cy0, ez = cz1 - cz0;
      const axis3 = ex >= ey && ex >= ez ? 0 : ey >= ez ? 1 : 2;
      middle = first + end >>> 1;
      if (ex > 0 || ey > 0 || ez > 0) selectNth(order2, boxes, axis3, first, end, middle);
      for (let i = first; i < middle; i++) grow(left, order2[i]);
      for (let i = middle; i < end; i++) grow(right, order2[i]);
    }
    push(top++, middle, end, node, 1, depth + 1, right);
    push(top++, first, middle, node, 0, depth + 1, left);
  }
  return { nodes: nodes.slice(0, nodeCount * NODE_WORDS), nodeCount };
}
function selectNth(order2, boxes, axis3, first, end, nth) {
  const key = (i) => {
    const b = order2[i] * 6 + axis3;
    return boxes[b] + boxes[b + 3];
  };
  let low = first, high = end - 1;
  while (low < high) {
    const pivot = key(low + high >>> 1);
    let i = low, j = high;
    while (i <= j) {
      while (key(i) < pivot) i++;
      while (key(j) > pivot) j--;
      if (i <= j) {
        const swap = order2[i];
        order2[i++] = order2[j];
        order2[j--] = swap;
      }
    }
    if (nth <= j) high = j;
    else if (nth >= i) low = i;
    else return;
  }
}

// ../../packages/bvh/src/error.ts
var BvhError = class extends GlanzError {
};

// ../../packages/bvh/src/blas.ts
var triangleCount = (mesh) => Math.floor((mesh.indices ? mesh.indices.length : mesh.positions.length / 3) / 3);
function triangleBoxes(mesh, boxes) {
  const { positions, indices } = mesh;
  const vertices = Math.floor(positions.length / 3);
  const count = triangleCount(mesh);
  for (let i = 0; i < count; i++) {
    const ia = indices ? indices[3 * i] : 3 * i;
    const ib = indices ? indices[3 * i + 1] : 3 * i + 1;
    const ic = indices ? indices[3 * i + 2] : 3 * i + 2;
    if (ia >= vertices || ib >= vertices || ic >= vertices) {
      throw new BvhError("bvh/indices", `Triangle ${i} uses vertex ${Math.max(ia, ib, ic)} of ${vertices}: every index must be below the number of vertices.`);
    }
    const a = 3 * ia, b = 3 * ib, c = 3 * ic;
    for (let k = 0; k < 3; k++) {
      const p = positions[a + k], q = positions[b + k], r = positions[c + k];
      boxes[6 * i + k] = Math.min(p, q, r);
      boxes[6 * i + 3 + k] = Math.max(p, q, r);
    }
  }
}
function buildBlas(mesh, options = {}) {
  const { maxLeafTriangles = 4, bins = 16 } = options;
  if (!(Number.isInteger(maxLeafTriangles) && maxLeafTriangles >= 1 && maxLeafTriangles <= LEAF_MAX)) throw new BvhError("bvh/options", `maxLeafTriangles is ${maxLeafTriangles}; it must be a whole number from 1 to ${LEAF_MAX}.`);
  if (!(Number.isInteger(bins) && bins >= 2 && bins <= 64)) throw new BvhError("bvh/options", `bins is ${bins}; it must be a whole number from 2 to 64.`);
  if (mesh.positions.length % 3 !== 0) throw new BvhError("bvh/positions", `positions has ${mesh.positions.length} numbers; it must have three a vertex.`);
  if (mesh.indices ? mesh.indices.length % 3 !== 0 : mesh.positions.length % 9 !== 0) throw new BvhError("bvh/indices", `${mesh.indices ? `indices has ${mesh.indices.length} entries` : `positions has ${mesh.positions.length / 3} vertices`}; it must have three a triangle.`);
  const count = triangleCount(mesh);
  if (count > MAX_PRIMITIVES) throw new BvhError("bvh/too-many", `The mesh has ${count} triangles; one hierarchy holds ${MAX_PRIMITIVES}: split the mesh.`);
  const boxes = new Float32Array(count * 6);
  triangleBoxes(mesh, boxes);
  const triangleIndices = finiteBoxes(boxes);
  const { nodes, nodeCount } = buildBinnedSah(boxes, triangleIndices, { maxLeaf: maxLeafTriangles, maxDepth: BLAS_MAX_DEPTH, bins, nodeCost: 1 });
  return { nodes, nodeCount, triangleIndices, bounds: boundsOf(boxes, triangleIndices) };
}
function finiteBoxes(boxes) {
  const kept = new Uint32Array(boxes.length / 6);
  let count = 0;
  for (let i = 0; i < kept.length; i++) {
    const b = 6 * i;
    const sum = boxes[b] + boxes[b + 1] + boxes[b + 2] + boxes[b + 3] + boxes[b + 4] + boxes[b + 5];
    if (Number.isFinite(sum)) kept[count++] = i;
  }
  return count === kept.length ? kept : kept.slice(0, count);
}
function boundsOf(boxes, indices) {
  const min = new Float32Array(3).fill(Infinity);
  const max = new Float32Array(3).fill(-Infinity);
  for (const index of indices) {
    for (let k = 0; k < 3; k++) {
      min[k] = Math.min(min[k], boxes[6 * index + k]);
      max[k] = Math.max(max[k], boxes[6 * index + 3 + k]);
    }
  }
  return { min, max };
}
function packTriangles(blas, mesh) {
  const { triangleIndices } = blas;
  const { positions, indices } = mesh;
  const packed = new Float32Array(triangleIndices.length * TRIANGLE_WORDS);
  const words = new Uint32Array(packed.buffer);
  for (let i = 0; i < triangleIndices.length; i++) {
    const triangle = triangleIndices[i];
    for (let corner2 = 0; corner2 < 3; corner2++) {
      const from = 3 * (indices ? indices[3 * triangle + corner2] : 3 * triangle + corner2);
      const to = i * TRIANGLE_WORDS + corner2 * 4;
      packed[to] = positions[from];
      packed[to + 1] = positions[from + 1];
      packed[to + 2] = positions[from + 2];
    }
    words[i * TRIANGLE_WORDS + 3] = triangle;
  }
  return packed;
}

// ../../packages/bvh/src/cpu/traverse.ts
var OUTWARD = 1 + 2 ** -50;
function enter(nodes, min, max, ray, tMin, tMax) {
  const x0 = (nodes[min] - ray.ox) * ray.ix, x1 = (nodes[max] - ray.ox) * ray.ix;
  const y0 = (nodes[min + 1] - ray.oy) * ray.iy, y1 = (nodes[max + 1] - ray.oy) * ray.iy;
  const z0 = (nodes[min + 2] - ray.oz) * ray.iz, z1 = (nodes[max + 2] - ray.oz) * ray.iz;
  const near = Math.max(Math.min(x0, x1), Math.min(y0, y1), Math.min(z0, z1), tMin);
  const far = Math.min(Math.max(x0, x1), Math.max(y0, y1), Math.max(z0, z1), tMax) * OUTWARD;
  return near <= far ? near : Infinity;
}
function traverse(bvh, ray, tMin, tMax, leaf) {
  const { nodes } = bvh;
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  const stack = [0];
  let end = tMax;
  while (stack.length > 0) {
    const reference2 = stack.pop();
    if ((reference2 & LEAF) !== 0) {
      end = leaf(reference2, end);
      if (end < tMin) return;
      continue;
    }
    const base = reference2 * NODE_WORDS;
    const left = enter(nodes, base + LEFT_MIN, base + LEFT_MAX, ray, tMin, end);
    const right = enter(nodes, base + RIGHT_MIN, base + RIGHT_MAX, ray, tMin, end);
    if (left <= right) {
      if (right < Infinity) stack.push(words[base + RIGHT]);
      if (left < Infinity) stack.push(words[base + LEFT]);
    } else {
      if (left < Infinity) stack.push(words[base + LEFT]);
      stack.push(words[base + RIGHT]);
    }
  }
}

// ../../packages/bvh/src/cpu/triangle.ts
function prepareRay(ox, oy, oz, dx, dy, dz) {
  const safe = (d) => 1 / (Math.abs(d) < 1e-20 ? 1e-20 : d);
  const length2 = Math.hypot(dx, dy, dz);
  const nx = dx / length2, ny = dy / length2, nz = dz / length2;
  const s = nz >= 0 ? 1 : -1;
  const a = -1 / (s + nz);
  const b = nx * ny * a;
  return { ox, oy, oz, ix: safe(dx), iy: safe(dy), iz: safe(dz), x: [1 + s * nx * nx * a, s * b, -s * nx], y: [b, s + ny * ny * a, -ny], z: [nx / length2, ny / length2, nz / length2] };
}
function intersectTriangle(ray, p, a, b, c, out) {
  const { ox, oy, oz, x, y, z } = ray;
  const ax = p[a] - ox, ay = p[a + 1] - oy, az = p[a + 2] - oz;
  const bx = p[b] - ox, by = p[b + 1] - oy, bz = p[b + 2] - oz;
  const cx = p[c] - ox, cy = p[c + 1] - oy, cz = p[c + 2] - oz;
  const a0 = x[0] * ax + x[1] * ay + x[2] * az, a1 = y[0] * ax + y[1] * ay + y[2] * az;
  const b0 = x[0] * bx + x[1] * by + x[2] * bz, b1 = y[0] * bx + y[1] * by + y[2] * bz;
  const c0 = x[0] * cx + x[1] * cy + x[2] * cz, c1 = y[0] * cx + y[1] * cy + y[2] * cz;
  const u = a0 * c1 - a1 * c0;
  const v = b0 * a1 - b1 * a0;
  const w = c0 * b1 - c1 * b0;
  const determinant = u + v + w;
  if (Math.min(u, v, w) < 0 && Math.max(u, v, w) > 0 || determinant === 0) return false;
  out.u = u / determinant;
  out.v = v / determinant;
  out.t = (u * (z[0] * bx + z[1] * by + z[2] * bz) + v * (z[0] * cx + z[1] * cy + z[2] * cz) + w * (z[0] * ax + z[1] * ay + z[2] * az)) / determinant;
  return true;
}

// ../../packages/bvh/src/cpu/queries.ts
var prepare = (ray) => {
  const { origin: o, direction: d } = ray;
  return prepareRay(o[0], o[1], o[2], d[0], d[1], d[2]);
};
function search(blas, mesh, ray, tMin, any, instance, found) {
  if (blas.triangleIndices.length === 0) return;
  const { positions, indices } = mesh;
  const hit = { t: 0, u: 0, v: 0 };
  traverse(blas, ray, tMin, found.t, (reference2, end) => {
    const first = leafFirst(reference2);
    for (let i = first; i < first + leafCount(reference2); i++) {
      const triangle = blas.triangleIndices[i];
      const a = 3 * (indices ? indices[3 * triangle] : 3 * triangle);
      const b = 3 * (indices ? indices[3 * triangle + 1] : 3 * triangle + 1);
      const c = 3 * (indices ? indices[3 * triangle + 2] : 3 * triangle + 2);
      if (intersectTriangle(ray, positions, a, b, c, hit) && hit.t > tMin && hit.t < end) {
        end = hit.t;
        Object.assign(found, hit, { triangle, instance });
        if (any) return -Infinity;
      }
    }
    return end;
  });
}
var start = (ray) => ({ t: ray.tMax ?? Infinity, u: 0, v: 0, triangle: -1, instance: -1 });
function searchInstances(tlas, instances, ray, any) {
  const found = start(ray);
  const tMin = ray.tMin ?? 0;
  if (tlas.instanceOrder.length === 0) return found;
  const { origin: o, direction: d } = ray;
  const m = tlas.toObject;
  traverse(tlas, prepare(ray), tMin, found.t, (reference2) => {
    const instance = tlas.instanceOrder[leafFirst(reference2)];
    const { blas, mesh } = instances[instance];
    const at = 12 * instance;
    const row = (r, v) => m[at + 4 * r] * v[0] + m[at + 4 * r + 1] * v[1] + m[at + 4 * r + 2] * v[2];
    const local = prepareRay(row(0, o) + m[at + 3], row(1, o) + m[at + 7], row(2, o) + m[at + 11], row(0, d), row(1, d), row(2, d));
    search(blas, mesh, local, tMin, any, instance, found);
    return any && found.instance >= 0 ? -Infinity : found.t;
  });
  return found;
}
function closestHitInstances(tlas, instances, ray) {
  const found = searchInstances(tlas, instances, ray, false);
  return found.instance < 0 ? void 0 : { ...found };
}

// ../../packages/bvh/src/tlas.ts
function buildTlas(instances) {
  if (instances.length > 2 ** TLAS_MAX_DEPTH) throw new BvhError("bvh/too-many", `There are ${instances.length} instances; one hierarchy holds ${2 ** TLAS_MAX_DEPTH}.`);
  const boxes = new Float32Array(instances.length * 6);
  const toObject = new Float64Array(instances.length * 12);
  instances.forEach(({ bounds, transform: transform2 }, i) => {
    if (transform2.length !== 16) throw new BvhError("bvh/transform", `The transform of instance ${i} has ${transform2.length} numbers; it must be a 4\xD74 matrix, column by column.`);
    const exists = invertAffine(transform2, toObject, 12 * i) && bounds.min[0] <= bounds.max[0];
    for (let r = 0; r < 3; r++) {
      let min = transform2[12 + r], max = min;
      let slack = Math.abs(min);
      for (let k = 0; k < 3; k++) {
        const m = transform2[4 * k + r];
        const p = m * bounds.min[k], q = m * bounds.max[k];
        min += Math.min(p, q);
        max += Math.max(p, q);
        slack += Math.max(Math.abs(p), Math.abs(q));
      }
      slack *= 2 ** -22;
      boxes[6 * i + r] = exists ? min - slack : NaN;
      boxes[6 * i + 3 + r] = exists ? max + slack : NaN;
    }
  });
  const instanceOrder = finiteBoxes(boxes);
  const { nodes, nodeCount } = buildBinnedSah(boxes, instanceOrder, { maxLeaf: 1, maxDepth: TLAS_MAX_DEPTH, bins: 16, nodeCost: 1 });
  return { nodes, nodeCount, instanceOrder, toObject, bounds: boundsOf(boxes, instanceOrder) };
}
function invertAffine(m, out, at) {
  const a = m[0], b = m[4], c = m[8], x = m[12];
  const d = m[1], e = m[5], f = m[9], y = m[13];
  const g = m[2], h = m[6], i = m[10], z = m[14];
  const determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  const scale = 1 / determinant;
  const rows = [e * i - f * h, c * h - b * i, b * f - c * e, f * g - d * i, a * i - c * g, c * d - a * f, d * h - e * g, b * g - a * h, a * e - b * d];
  let finite3 = Number.isFinite(scale);
  for (let r = 0; r < 3; r++) {
    const p = rows[3 * r] * scale, q = rows[3 * r + 1] * scale, s = rows[3 * r + 2] * scale;
    const w = -(p * x + q * y + s * z);
    out.set([p, q, s, w], at + 4 * r);
    finite3 &&= Number.isFinite(Math.fround(p + q + s + w));
  }
  if (!finite3) out.fill(NaN, at, at + 12);
  return finite3;
}

// ../../packages/bvh/src/wgsl/offset.wgsl.ts
var bvhOffset = wgslModule(
  "bvh/offset",
  /* wgsl */
  `
fn bvh_offset_origin(position: vec3f, normal: vec3f, magnitude: f32) -> vec3f {
  return position + normal * (magnitude * 3.8146973e-6);
}
`
);

// ../../packages/bvh/src/wgsl/triangle.wgsl.ts
var bvhTriangleTest = wgslModule(
  "bvh/triangle",
  /* wgsl */
  `
struct BvhRay {
  origin: vec3f,
  // Reciprocal of the direction, finite.
  inverse: vec3f,
  // Two unit vectors perpendicular to the direction, and the direction over its squared length.
  x: vec3f,
  y: vec3f,
  z: vec3f,
}

fn bvh_ray(origin: vec3f, direction: vec3f) -> BvhRay {
  let safe = select(direction, vec3f(1e-20), abs(direction) < vec3f(1e-20));
  // Scaled by powers of two that cancel, as squares of very small or large directions leave the range of f32.
  let scale = 1.0 / max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
  let d = direction * scale;
  let squared = dot(d, d);
  let n = d * inverseSqrt(squared);
  // Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
  let s = select(-1.0, 1.0, n.z >= 0.0);
  let a = -1.0 / (s + n.z);
  let b = n.x * n.y * a;
  return BvhRay(origin, 1.0 / safe, vec3f(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3f(b, s + n.y * n.y * a, -n.y), d * (scale / squared));
}

// t, u, v; t < 0 if there is no hit. v0's weight is 1 - u - v.
fn bvh_intersect_triangle(ray: BvhRay, triangle: BvhTriangle) -> vec3f {
  let p0 = triangle.v0 - ray.origin;
  let p1 = triangle.v1 - ray.origin;
  let p2 = triangle.v2 - ray.origin;
  let a = vec2f(dot(ray.x, p0), dot(ray.y, p0));
  let b = vec2f(dot(ray.x, p1), dot(ray.y, p1));
  let c = vec2f(dot(ray.x, p2), dot(ray.y, p2));
  let u = a.x * c.y - a.y * c.x;
  let v = b.x * a.y - b.y * a.x;
  let w = c.x * b.y - c.y * b.x;
  let largest = max(max(max(abs(a.x), abs(a.y)), max(abs(b.x), abs(b.y))), max(abs(c.x), abs(c.y)));
  // Half an ulp each for two products and their difference.
  let tolerance = largest * largest * 1.7881393e-7;
  let low = min(u, min(v, w));
  let high = max(u, max(v, w));
  let determinant = u + v + w;
  if ((low < -tolerance && high > tolerance) || determinant == 0.0) { return vec3f(-1.0, 0.0, 0.0); }
  let inverse = 1.0 / determinant;
  let weights = clamp(vec2f(u, v) * inverse, vec2f(0.0), vec2f(1.0));
  let first = max(1.0 - weights.x - weights.y, 0.0);
  let t = first * dot(ray.z, p0) + weights.x * dot(ray.z, p1) + weights.y * dot(ray.z, p2);
  return vec3f(t, weights);
}
`
);

// ../../packages/bvh/src/wgsl/types.wgsl.ts
var bvhTypes = wgslModule(
  "bvh/types",
  /* wgsl */
  `
struct BvhTriangle {
  v0: vec3f,
  // Index of the triangle in its mesh.
  id: u32,
  v1: vec3f,
  v2: vec3f,
}

struct BvhHit {
  // In units of the ray's direction.
  t: f32,
  // Barycentrics: the point is (1 - u - v) v0 + u v1 + v v2.
  u: f32,
  v: f32,
  // As the host's bvh_triangle() counts them.
  triangle: u32,
  // As the host's bvh_instance() counts them; BVH_MISS if there is no hit.
  instance: u32,
}

const BVH_MISS = 0xffffffffu;
`,
  [bvhNodeStruct.module, bvhInstanceStruct.module]
);

// ../../packages/bvh/src/wgsl/traversal.wgsl.ts
var box = wgslModule(
  "bvh/box",
  /* wgsl */
  `
// Where the ray enters a box; larger than t_max if it does not. The far side is moved out by two ulps, so that rounding
// loses no hit on the border (Ize 2013, "Robust BVH Ray Traversal").
fn bvh_enter_box(ray: BvhRay, low: vec3f, high: vec3f, t_min: f32, t_max: f32) -> f32 {
  let a = (low - ray.origin) * ray.inverse;
  let b = (high - ray.origin) * ray.inverse;
  let near = min(a, b);
  let far = max(a, b);
  let enter = max(max(near.x, near.y), max(near.z, t_min));
  let leave = min(min(far.x, far.y), min(far.z, t_max)) * 1.0000004;
  return select(BVH_OUTSIDE, enter, enter <= leave);
}

const BVH_OUTSIDE = 3.4028234e38;
const BVH_LEAF = 0x80000000u;
const BVH_END = 0xffffffffu;
`,
  [bvhTriangleTest]
);
var traversal = (name) => {
  const any = name === "any";
  return wgslModule(
    `bvh/${name}-hit`,
    /* wgsl */
    `
fn bvh_${name}_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> ${any ? "bool" : "BvhHit"} {
  var hit = BvhHit(t_max, 0.0, 0.0, 0u, BVH_MISS);
  var stack: array<u32, ${BVH_STACK_SIZE}>;
  stack[0] = BVH_END;
  var top = 1u;
  var reference = 0u;
  var ray = bvh_ray(origin, direction);
  var instance = BVH_MISS;
  var first_node = 0u;
  var first_triangle = 0u;
  loop {
    while ((reference & BVH_LEAF) == 0u) {
      let node = bvh_node(first_node + reference);
      let left = bvh_enter_box(ray, node.left_min, node.left_max, t_min, hit.t);
      let right = bvh_enter_box(ray, node.right_min, node.right_max, t_min, hit.t);
      let in_left = left < BVH_OUTSIDE;
      let in_right = right < BVH_OUTSIDE;
      if (in_left && in_right) {
        let swap = right < left;
        stack[top] = select(node.right, node.left, swap);
        top++;
        reference = select(node.left, node.right, swap);
      } else if (in_left || in_right) {
        reference = select(node.right, node.left, in_left);
      } else {
        top--;
        reference = stack[top];
      }
    }
    if (reference == BVH_END) {
      if (instance == BVH_MISS) { break; }
      instance = BVH_MISS;
      first_node = 0u;
      ray = bvh_ray(origin, direction);
    } else if (instance == BVH_MISS) {
      instance = reference & 0x7ffffffu;
      let placed = bvh_instance(instance);
      let point = vec4f(origin, 1.0);
      ray = bvh_ray(
        vec3f(dot(placed.to_object_0, point), dot(placed.to_object_1, point), dot(placed.to_object_2, point)),
        vec3f(dot(placed.to_object_0.xyz, direction), dot(placed.to_object_1.xyz, direction), dot(placed.to_object_2.xyz, direction)),
      );
      first_node = placed.blas_node;
      first_triangle = placed.triangle_offset;
      stack[top] = BVH_END;
      top++;
      reference = 0u;
      continue;
    } else {
      let first = first_triangle + (reference & 0x7ffffffu);
      let end = first + ((reference >> 27u) & 15u) + 1u;
      for (var triangle = first; triangle < end; triangle++) {
        let found = bvh_intersect_triangle(ray, bvh_triangle(triangle));
        if (found.x > t_min && found.x < hit.t) {
          let candidate = BvhHit(found.x, found.y, found.z, triangle, instance);
          //#if BVH_FILTER
          if (!bvh_accept(candidate)) { continue; }
          //#endif
          ${any ? "return true;" : "hit = candidate;"}
        }
      }
    }
    top--;
    reference = stack[top];
  }
  return ${any ? "false" : "hit"};
}
`,
    [bvhTypes, box]
  );
};
var bvhClosestHit = traversal("closest");
var bvhAnyHit = traversal("any");

// ../../packages/renderer/src/kernels/layout.ts
var frameStruct = struct("Frame", {
  camera_origin: "vec3f",
  camera_kind: "u32",
  camera_right: "vec3f",
  lens_radius: "f32",
  camera_up: "vec3f",
  focus_distance: "f32",
  camera_forward: "vec3f",
  cone_spread: "f32",
  half_extent: "vec2f",
  size: "vec2u",
  seed: "u32",
  max_depth: "u32",
  light_count: "u32",
  background: "u32",
  environment_radiance: "vec3f",
  environment_probability: "f32",
  environment_rotation: "vec2f",
  environment_cells: "vec2u",
  lod_bias: "f32",
  scene_scale: "f32",
  reserved: "vec2u"
});
var batchStruct = struct("Batch", {
  pixel_offset: "u32",
  pixel_count: "u32",
  sample_offset: "u32",
  sample_count: "u32"
});
var pathStruct = struct("Path", {
  origin: "vec3f",
  /** Solid-angle density with which the direction was chosen. */
  pdf: "f32",
  direction: "vec3f",
  cone_width: "f32",
  throughput: "vec3f",
  alpha: "f32",
  radiance: "vec3f",
  reserved: "u32",
  /** Barycentrics as float bits, triangle, instance; see BvhHit. */
  hit: "vec4u"
});
var shadowStruct = struct("Shadow", {
  origin: "vec3f",
  distance: "f32",
  direction: "vec3f",
  path: "u32",
  contribution: "vec3f",
  reserved: "u32"
});
var lightStruct = struct("Light", {
  a: "vec3f",
  kind: "u32",
  b: "vec3f",
  /** Probability that the table picks this light, among the lights other than the environment. */
  probability: "f32",
  c: "vec3f",
  /** The light taken instead when the draw falls beyond `keep`. */
  other: "u32",
  color: "vec3f",
  keep: "f32",
  ids: "vec4u"
});
var instanceStruct = struct("Instance", {
  traversal: bvhInstanceStruct,
  to_world_0: "vec4f",
  to_world_1: "vec4f",
  to_world_2: "vec4f",
  material: "u32",
  /** Index of its mesh in the attribute heap's table. */
  mesh: "u32",
  /** Index of the light of this instance's triangle 0, or NONE. */
  first_light: "u32",
  /** Index in the scene. */
  id: "u32"
});
var materialStruct = struct("Material", {
  parameters: openPbrStruct,
  /** Word offset of its first TextureBindingRecord in the attribute heap. */
  first_binding: "u32",
  binding_count: "u32",
  flags: "u32",
  opacity_threshold: "f32"
});
var MATERIAL_TWO_SIDED_EMISSION = 1;
var MATERIAL_OPAQUE = 2;
var MATERIAL_EMISSIVE = 4;
var MATERIAL_MASK = 8;
var meshStruct = struct("MeshShading", {
  indices: "u32",
  normals: "u32",
  tangents: "u32",
  colors: "u32",
  uv0: "u32",
  uv1: "u32",
  reserved: "vec2u"
});
var bindingStruct = struct("TextureBindingRecord", {
  parameter: "u32",
  /** Bits 0..7: channel (0..3, 4 = rgb); 8..15: uv set. */
  channels: "u32",
  /** Which sampling case: a texture array together with a sampler. */
  sampling: "u32",
  layer: "u32",
  row_u: "vec3f",
  scale: "f32",
  row_v: "vec3f",
  /** Half of log2(width × height). */
  log_size: "f32"
});
var NONE = 4294967295;
var LIGHT_TRIANGLE = 0;
var LIGHT_POINT = 1;
var LIGHT_SPOT = 2;
var LIGHT_DIRECTIONAL = 3;
var LIGHT_TWO_SIDED = 16;
var LIGHT_MIRRORED = 32;
var BACKGROUND_HIDDEN = 1;
var BACKGROUND_TRANSPARENT = 2;

// ../../packages/renderer/src/scene/alias-table.ts
function buildAliasTable(weights) {
  const n = weights.length;
  let total = 0;
  for (let i = 0; i < n; i++) total += weights[i];
  if (!(total > 0) || !Number.isFinite(total)) return void 0;
  const probability = new Float64Array(n);
  const keep = new Float64Array(n).fill(1);
  const alias = new Uint32Array(n);
  const scaled = new Float64Array(n);
  const small = new Uint32Array(n);
  const large = new Uint32Array(n);
  let smalls = 0;
  let larges = 0;
  for (let i = 0; i < n; i++) {
    probability[i] = weights[i] / total;
    scaled[i] = probability[i] * n;
    alias[i] = i;
    if (scaled[i] < 1) small[smalls++] = i;
    else large[larges++] = i;
  }
  while (smalls > 0 && larges > 0) {
    const s = small[--smalls];
    const l = large[larges - 1];
    keep[s] = scaled[s];
    alias[s] = l;
    scaled[l] = scaled[l] + scaled[s] - 1;
    if (scaled[l] < 1) {
      larges--;
      small[smalls++] = l;
    }
  }
  return { probability, keep, alias };
}

// ../../packages/renderer/src/scene/environment.ts
var MAX_CELLS = [1024, 512];
var luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
function prepareEnvironment(environment2) {
  if (!environment2) return { radiance: [0, 0, 0], rotation: [1, 0], visible: true, meanLuminance: 0 };
  const visible = environment2.visible ?? true;
  if (environment2.type === "constant") {
    return { radiance: environment2.radiance, rotation: [1, 0], visible, meanLuminance: luminance(...environment2.radiance) };
  }
  const { width, height, data } = environment2;
  const pixels = new Float32Array(width * height * 4);
  for (let i = 0; i < width * height; i++) {
    for (let c = 0; c < 3; c++) {
      const value = data[3 * i + c];
      pixels[4 * i + c] = value > 0 ? Math.min(value, 3e38) : 0;
    }
    pixels[4 * i + 3] = 1;
  }
  const intensity = environment2.intensity ?? 1;
  const rotation = environment2.rotation ?? 0;
  const { table: table3, mean } = importance(environment2, pixels);
  return {
    pixels: { width, height, data: pixels },
    radiance: [intensity, intensity, intensity],
    rotation: [Math.cos(rotation), Math.sin(rotation)],
    visible,
    ...table3 && intensity > 0 ? { table: table3 } : {},
    meanLuminance: mean * intensity
  };
}
function cellLuminance(source, pixels) {
  const { width: w, height: h } = source;
  const rows = new Float64Array(w * h);
  const own = (x, y) => {
    const i = 4 * (y * w + (x + w) % w);
    return luminance(pixels[i], pixels[i + 1], pixels[i + 2]);
  };
  for (let y = 0; y < h; y++) for (let x = 0; x < w; x++) rows[y * w + x] = (own(x - 1, y) + 6 * own(x, y) + own(x + 1, y)) / 8;
  const width = Math.min(w, MAX_CELLS[0]);
  const height = Math.min(h, MAX_CELLS[1]);
  const values = new Float64Array(width * height);
  const areas = new Float64Array(width * height);
  const row = (x, y) => rows[Math.min(Math.max(y, 0), h - 1) * w + x];
  for (let y = 0; y < h; y++) {
    const y0 = y * height / h;
    const y1 = (y + 1) * height / h;
    for (let x = 0; x < w; x++) {
      const value = (row(x, y - 1) + 6 * row(x, y) + row(x, y + 1)) / 8;
      const x0 = x * width / w;
      const x1 = (x + 1) * width / w;
      for (let cy = Math.floor(y0); cy < y1; cy++) {
        for (let cx = Math.floor(x0); cx < x1; cx++) {
          const area3 = (Math.min(y1, cy + 1) - Math.max(y0, cy)) * (Math.min(x1, cx + 1) - Math.max(x0, cx));
          values[cy * width + cx] = values[cy * width + cx] + value * area3;
          areas[cy * width + cx] = areas[cy * width + cx] + area3;
        }
      }
    }
  }
  for (let i = 0; i < values.length; i++) values[i] = values[i] / areas[i];
  return { width, height, values };
}
function importance(source, pixels) {
  const { width, height, values } = cellLuminance(source, pixels);
  let sum = 0;
  let solid = 0;
  const sines = Array.from({ length: height }, (_, y) => Math.cos(y * Math.PI / height) - Math.cos((y + 1) * Math.PI / height));
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) sum += values[y * width + x] * sines[y];
    solid += sines[y] * width;
  }
  const mean = sum / solid;
  const weights = new Float64Array(width * height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) weights[y * width + x] = Math.max(values[y * width + x] - mean, 0) * sines[y];
  }
  const alias = buildAliasTable(weights);
  if (!alias) return { mean };
  const data = new Float32Array(width * height * 4);
  for (let i = 0; i < width * height; i++) {
    data[4 * i] = alias.keep[i];
    data[4 * i + 1] = alias.alias[i];
    data[4 * i + 2] = alias.probability[i] * width * height;
  }
  return { table: { width, height, data }, mean };
}

// ../../packages/renderer/src/scene/geometry.ts
var NODE_WORDS2 = 16;
var TRIANGLE_WORDS2 = 12;
async function prepareGeometry(scene, options = {}) {
  const blas = scene.meshes.map(() => void 0);
  const visible = scene.instances.flatMap((instance, index) => instance.visible !== false && scene.meshes[instance.mesh].indices.length >= 3 ? [index] : []);
  const used = [...new Set(visible.map((index) => scene.instances[index].mesh))].sort((a, b) => a - b);
  const total = used.reduce((sum, mesh) => sum + scene.meshes[mesh].indices.length, 0);
  let done = 0;
  let last = performance.now();
  for (const index of used) {
    const mesh = scene.meshes[index];
    blas[index] = buildBlas({ positions: mesh.positions, indices: mesh.indices });
    done += mesh.indices.length;
    options.onProgress?.(done / total);
    if (performance.now() - last > 12) {
      await new Promise((resolve2) => setTimeout(resolve2, 0));
      last = performance.now();
    }
    options.signal?.throwIfAborted();
  }
  const shown = visible.filter((index) => blas[scene.instances[index].mesh].triangleIndices.length > 0);
  if (shown.length === 0) throw new RenderError("renderer/no-triangles", "The scene has no visible triangles: nothing to render.");
  const tlas = buildTlas(shown.map((index) => ({ bounds: blas[scene.instances[index].mesh].bounds, transform: scene.instances[index].transform })));
  if (tlas.instanceOrder.length === 0) throw new RenderError("renderer/no-triangles", "Every instance has a transform that flattens it: nothing to render.");
  const order2 = Uint32Array.from(tlas.instanceOrder, (i) => shown[i]);
  const instanceSlots = new Uint32Array(scene.instances.length).fill(NONE);
  order2.forEach((instance, slot) => instanceSlots[instance] = slot);
  const firstNode = [];
  const firstTriangle = [];
  let nodeCount = tlas.nodes.length / NODE_WORDS2;
  let triangleCount2 = 0;
  scene.meshes.forEach((_, i) => {
    firstNode.push(nodeCount);
    firstTriangle.push(triangleCount2);
    nodeCount += blas[i]?.nodeCount ?? 0;
    triangleCount2 += blas[i]?.triangleIndices.length ?? 0;
  });
  const nodes = new Float32Array(nodeCount * NODE_WORDS2);
  const triangles = new Float32Array(triangleCount2 * TRIANGLE_WORDS2);
  nodes.set(tlas.nodes);
  scene.meshes.forEach((mesh, i) => {
    const tree = blas[i];
    if (!tree) return;
    nodes.set(tree.nodes.subarray(0, tree.nodeCount * NODE_WORDS2), firstNode[i] * NODE_WORDS2);
    triangles.set(packTriangles(tree, { positions: mesh.positions, indices: mesh.indices }), firstTriangle[i] * TRIANGLE_WORDS2);
  });
  const { min, max } = tlas.bounds;
  const center = [0, 1, 2].map((k) => (min[k] + max[k]) / 2);
  const radius = 0.5 * Math.hypot(...[0, 1, 2].map((k) => max[k] - min[k]));
  return {
    nodes,
    triangles,
    attributes: packAttributes(scene, used),
    blas,
    tlas,
    shown,
    order: order2,
    instanceSlots,
    firstNode,
    firstTriangle,
    triangleCount: triangleCount2,
    center,
    radius,
    hasVertexColors: used.some((index) => scene.meshes[index].colors !== void 0)
  };
}
function packAttributes(scene, used) {
  const tableWords = scene.meshes.length * meshStruct.size / 4;
  let size = tableWords;
  const place3 = (array) => {
    if (!array || array.length === 0) return NONE;
    const at = size;
    size += array.length;
    return at;
  };
  const table3 = meshStruct.allocate(scene.meshes.length);
  const placed = [];
  const keep = (array) => {
    const at = place3(array);
    if (at !== NONE) placed.push([at, array]);
    return at;
  };
  for (const index of used) {
    const mesh = scene.meshes[index];
    meshStruct.write(table3, index, {
      indices: keep(mesh.indices),
      normals: keep(mesh.normals),
      tangents: keep(mesh.tangents),
      colors: keep(mesh.colors),
      uv0: keep(mesh.uvs?.[0]),
      uv1: keep(mesh.uvs?.[1])
    });
  }
  const heap = new Uint32Array(size);
  heap.set(new Uint32Array(table3));
  for (const [at, array] of placed) {
    if (array) heap.set(array instanceof Uint32Array ? array : new Uint32Array(array.buffer, array.byteOffset, array.length), at);
  }
  return heap;
}
function packInstances(scene, geometry, firstLight) {
  const buffer = instanceStruct.allocate(geometry.order.length);
  geometry.tlas.instanceOrder.forEach((given, slot) => {
    const index = geometry.order[slot];
    const instance = scene.instances[index];
    const m = instance.transform;
    const traversal2 = bvhInstanceStruct.allocate();
    const inverse = geometry.tlas.toObject.subarray(12 * given, 12 * given + 12);
    bvhInstanceStruct.write(traversal2, 0, {
      to_object_0: inverse.subarray(0, 4),
      to_object_1: inverse.subarray(4, 8),
      to_object_2: inverse.subarray(8, 12),
      blas_node: geometry.firstNode[instance.mesh],
      triangle_offset: geometry.firstTriangle[instance.mesh],
      id: index,
      flags: 0
    });
    const row = (r) => [m[r], m[4 + r], m[8 + r], m[12 + r]];
    instanceStruct.write(buffer, slot, {
      traversal: traversal2,
      to_world_0: row(0),
      to_world_1: row(1),
      to_world_2: row(2),
      material: instance.material,
      mesh: instance.mesh,
      first_light: firstLight[index],
      id: index
    });
  });
  return buffer;
}

// ../../packages/renderer/src/scene/emission.ts
var srgbToLinear = (c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
var EmissionEstimate = class {
  #image;
  #texture;
  #binding;
  #decode;
  constructor(scene, binding) {
    this.#binding = binding;
    this.#texture = scene.textures[binding.texture];
    this.#image = scene.images[this.#texture.image];
    const curve = this.#texture.color_space === "srgb" ? srgbToLinear : (c) => c;
    this.#decode = Float32Array.from({ length: 256 }, (_, code) => curve(code / 255));
  }
  /** Mean over a triangle given by its uvs, from a grid of texels as fine as the triangle is large on the picture, up to 16 × 16. */
  mean(uv) {
    const [a, b, c, d] = this.#binding.transform ?? [1, 0, 0, 1, 0, 0];
    const area3 = Math.abs((uv[2] - uv[0]) * (uv[5] - uv[1]) - (uv[3] - uv[1]) * (uv[4] - uv[0])) * Math.abs(a * d - b * c);
    const n = Math.min(16, Math.max(2, Math.ceil(Math.sqrt(area3 * this.#image.width * this.#image.height) / 4)));
    let sum = 0;
    let count = 0;
    for (let i = 0; i < n; i++) {
      for (let j = 0; j < n - i; j++) {
        const s = (i + 1 / 3) / n;
        const t = (j + 1 / 3) / n;
        sum += this.#luminance(uv[0] + s * (uv[2] - uv[0]) + t * (uv[4] - uv[0]), uv[1] + s * (uv[3] - uv[1]) + t * (uv[5] - uv[1]));
        count++;
      }
    }
    return sum / count;
  }
  #luminance(u, v) {
    const [a, b, c, d, x, y] = this.#binding.transform ?? [1, 0, 0, 1, 0, 0];
    const { width, height, data } = this.#image;
    const px = Math.floor(wrap(a * u + c * v + x, this.#texture.wrap_u) * width);
    const py = Math.floor(wrap(b * u + d * v + y, this.#texture.wrap_v) * height);
    const at = 4 * (Math.min(py, height - 1) * width + Math.min(px, width - 1));
    const value = (k) => data instanceof Float32Array ? data[at + k] : this.#decode[data[at + k]];
    return 0.2126 * value(0) + 0.7152 * value(1) + 0.0722 * value(2);
  }
};
function wrap(x, mode) {
  if (!Number.isFinite(x)) return 0;
  if (mode === "clamp") return Math.min(Math.max(x, 0), 1);
  if (mode === "mirror") {
    const t = x - 2 * Math.floor(x / 2);
    return t <= 1 ? t : 2 - t;
  }
  return x - Math.floor(x);
}

// ../../packages/renderer/src/scene/materials.ts
var GEOMETRY_NORMAL_ID = 255;
function parameterId(name) {
  return name === "geometry_normal" ? GEOMETRY_NORMAL_ID : openPbrStruct.fields.findIndex((field) => field.name === name);
}
var OPACITY_ID = parameterId("geometry_opacity");
function bindingsOf(material) {
  return Object.entries(material.textures ?? {}).map(([name, binding]) => [name, parameterId(name), binding]).filter(([, id, binding]) => id >= 0 && binding !== void 0).sort((a, b) => a[1] - b[1]);
}
function usedTextures(materials) {
  return new Set(materials.flatMap((material) => bindingsOf(material).map(([, , binding]) => binding.texture)));
}
function texturedParameters(materials) {
  const found = /* @__PURE__ */ new Map();
  for (const material of materials) {
    for (const [name, id] of bindingsOf(material)) {
      const type = openPbrStruct.fields[id]?.type === "f32" ? "f32" : "vec3f";
      found.set(id, { name, id, type });
    }
  }
  return [...found.values()].sort((a, b) => a.id - b.id);
}
var CHANNEL = { r: 0, g: 1, b: 2, a: 3, rgb: 4 };
function packBindings(materials, plan) {
  const all = materials.map(bindingsOf);
  const records = bindingStruct.allocate(all.reduce((sum, list2) => sum + list2.length, 0));
  const first = [];
  const count = [];
  let index = 0;
  for (const list2 of all) {
    first.push(index);
    count.push(list2.length);
    for (const [, id, binding] of list2) {
      const placement = plan.placements.get(binding.texture);
      if (!placement) continue;
      const [a, b, c, d, x, y] = binding.transform ?? [1, 0, 0, 1, 0, 0];
      const texels = placement.width * placement.height * Math.max(Math.abs(a * d - b * c), 1e-12);
      bindingStruct.write(records, index++, {
        parameter: id,
        channels: CHANNEL[binding.channels] | ((binding.uv ?? 0) > 0 ? 1 << 8 : 0),
        sampling: placement.sampling,
        layer: placement.layer,
        row_u: [a, c, x],
        row_v: [b, d, y],
        scale: binding.scale ?? 1,
        log_size: 0.5 * Math.log2(texels)
      });
    }
  }
  return { records, first, count };
}
function emittedRadiance(parameters) {
  return parameters.emission_color.map((c) => c * parameters.emission_luminance);
}
function isOpaque(material, hasVertexAlpha) {
  return (material.parameters.geometry_opacity ?? 1) >= 1 && !material.textures?.geometry_opacity && !hasVertexAlpha;
}
function packMaterial(buffer, index, material, firstBinding, bindingCount, opaque) {
  const parameters = resolveParameters(material.parameters);
  const packed = openPbrStruct.allocate();
  packOpenPbr(packed, 0, parameters);
  const emissive = emittedRadiance(parameters).some((c) => c > 0);
  const mask = material.opacity_threshold !== void 0;
  materialStruct.write(buffer, index, {
    parameters: packed,
    first_binding: firstBinding,
    binding_count: bindingCount,
    flags: (material.double_sided ? MATERIAL_TWO_SIDED_EMISSION : 0) | (opaque ? MATERIAL_OPAQUE : 0) | (emissive ? MATERIAL_EMISSIVE : 0) | (mask ? MATERIAL_MASK : 0),
    opacity_threshold: material.opacity_threshold ?? 0
  });
}
function findMaterial(scene, nameOrIndex) {
  if (typeof nameOrIndex === "number") return scene.materials[nameOrIndex] ? nameOrIndex : -1;
  return scene.materials.findIndex((material) => material.name === nameOrIndex);
}

// ../../packages/renderer/src/scene/matrix.ts
function determinant3(m) {
  const [a, b, c] = [m[0], m[1], m[2]];
  const [d, e, f] = [m[4], m[5], m[6]];
  const [g, h, i] = [m[8], m[9], m[10]];
  return a * (e * i - f * h) - d * (b * i - c * h) + g * (b * f - c * e);
}
function transformPoint(m, x, y, z, out, at = 0) {
  for (let r = 0; r < 3; r++) out[at + r] = m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r];
}

// ../../packages/renderer/src/scene/lights.ts
var luminance2 = (c) => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
function buildLightTable(scene, geometry, sceneRadius) {
  const firstLight = new Uint32Array(scene.instances.length).fill(NONE);
  const emitters = [];
  let count = 0;
  scene.instances.forEach((instance, index) => {
    const slot = geometry.instanceSlots[index];
    const material = scene.materials[instance.material];
    if (slot === NONE || luminance2(emittedRadiance(resolveParameters(material.parameters))) <= 0) return;
    firstLight[index] = count;
    emitters.push({ instance: index, slot, base: count });
    count += scene.meshes[instance.mesh].indices.length / 3;
  });
  const punctual = count;
  count += scene.lights.length;
  const records = lightStruct.allocate(Math.max(count, 1));
  const weights = new Float64Array(count);
  for (const { instance, slot, base } of emitters) writeTriangles(records, weights, scene, instance, slot, base, geometry);
  scene.lights.forEach((light, i) => weights[punctual + i] = writeLight(records, punctual + i, light, sceneRadius));
  const table3 = buildAliasTable(weights);
  if (!table3) return { records, count: 0, firstLight: firstLight.fill(NONE), power: 0 };
  const words = lightStruct.size / 4;
  const floats = new Float32Array(records);
  const integers = new Uint32Array(records);
  const [probability, alias, keep] = [lightStruct.offsetOf("probability") / 4, lightStruct.offsetOf("other") / 4, lightStruct.offsetOf("keep") / 4];
  for (let i = 0; i < count; i++) {
    floats[i * words + probability] = table3.probability[i];
    integers[i * words + alias] = table3.alias[i];
    floats[i * words + keep] = table3.keep[i];
  }
  return { records, count, firstLight, power: weights.reduce((sum, w) => sum + w, 0) };
}
function writeTriangles(records, weights, scene, index, slot, base, geometry) {
  const instance = scene.instances[index];
  const mesh = scene.meshes[instance.mesh];
  const material = scene.materials[instance.material];
  const radiance = luminance2(emittedRadiance(resolveParameters(material.parameters)));
  const sides = material.double_sided ? 2 : 1;
  const kind = LIGHT_TRIANGLE | (material.double_sided ? LIGHT_TWO_SIDED : 0) | (determinant3(instance.transform) < 0 ? LIGHT_MIRRORED : 0);
  const binding = material.textures?.emission_color;
  const estimate = binding ? new EmissionEstimate(scene, binding) : void 0;
  const uvs = binding ? mesh.uvs?.[binding.uv ?? 0] : void 0;
  const floats = new Float32Array(records);
  const integers = new Uint32Array(records);
  const words = lightStruct.size / 4;
  const at = { a: lightStruct.offsetOf("a") / 4, b: lightStruct.offsetOf("b") / 4, c: lightStruct.offsetOf("c") / 4, kind: lightStruct.offsetOf("kind") / 4, ids: lightStruct.offsetOf("ids") / 4 };
  const p = new Float64Array(9);
  for (let triangle = 0; triangle < mesh.indices.length / 3; triangle++) {
    const corner2 = (k) => mesh.indices[3 * triangle + k];
    for (let k = 0; k < 3; k++) transformPoint(instance.transform, mesh.positions[3 * corner2(k)], mesh.positions[3 * corner2(k) + 1], mesh.positions[3 * corner2(k) + 2], p, 3 * k);
    const row = (base + triangle) * words;
    for (let k = 0; k < 3; k++) {
      floats[row + at.a + k] = p[k];
      floats[row + at.b + k] = p[3 + k];
      floats[row + at.c + k] = p[6 + k];
    }
    integers[row + at.kind] = kind;
    integers[row + at.ids] = slot;
    integers[row + at.ids + 1] = geometry.leafTriangle(instance.mesh, triangle);
    integers[row + at.ids + 2] = instance.material;
    const e1 = [0, 1, 2].map((k) => p[3 + k] - p[k]);
    const e2 = [0, 1, 2].map((k) => p[6 + k] - p[k]);
    const area3 = 0.5 * Math.hypot(e1[1] * e2[2] - e1[2] * e2[1], e1[2] * e2[0] - e1[0] * e2[2], e1[0] * e2[1] - e1[1] * e2[0]);
    const texel = estimate && uvs ? estimate.mean([0, 1, 2].flatMap((k) => [uvs[2 * corner2(k)], uvs[2 * corner2(k) + 1]])) : 1;
    const power = Math.PI * area3 * radiance * sides * texel;
    weights[base + triangle] = Number.isFinite(power) ? power : 0;
  }
}
function writeLight(records, index, light, sceneRadius) {
  const color = light.color.map((c) => c * light.intensity);
  const ids = [NONE, NONE, NONE, NONE];
  const power = luminance2(color);
  switch (light.type) {
    case "directional":
      lightStruct.write(records, index, { kind: LIGHT_DIRECTIONAL, b: light.direction, color, ids });
      return power * Math.PI * sceneRadius * sceneRadius;
    case "point":
      lightStruct.write(records, index, { kind: LIGHT_POINT, a: light.position, color, ids });
      return power * 4 * Math.PI;
    case "spot": {
      const outer = Math.cos(light.outer_cone_angle);
      const scale = 1 / Math.max(1e-3, Math.cos(light.inner_cone_angle) - outer);
      lightStruct.write(records, index, { kind: LIGHT_SPOT, a: light.position, b: light.direction, c: [scale, -outer * scale, 0], color, ids });
      return power * 2 * Math.PI * (1 - outer);
    }
  }
}

// ../../packages/renderer/src/scene/textures.ts
var addressMode = { repeat: "repeat", mirror: "mirror-repeat", clamp: "clamp-to-edge" };
function formatOf(image, texture) {
  if (image.data instanceof Float32Array) return "rgba16float";
  return texture.color_space === "srgb" ? "rgba8unorm-srgb" : "rgba8unorm";
}
function planTextures(scene, used, slots, limits) {
  const drafts = [];
  const textures = [...new Set(used)].sort((a, b) => a - b);
  for (const index of textures) {
    const texture = scene.textures[index];
    const image = scene.images[texture.image];
    const format = formatOf(image, texture);
    const shrink = Math.max(1, image.width / limits.maxTextureDimension2D, image.height / limits.maxTextureDimension2D);
    const width = Math.max(1, Math.floor(image.width / shrink));
    const height = Math.max(1, Math.floor(image.height / shrink));
    let draft = drafts.find((d) => d.width === width && d.height === height && d.format === format && (d.layers.includes(texture.image) || d.layers.length < limits.maxTextureArrayLayers));
    if (!draft) drafts.push(draft = { width, height, format, layers: [] });
    if (!draft.layers.includes(texture.image)) draft.layers.push(texture.image);
  }
  while (drafts.length > slots) {
    const order2 = [...drafts].sort((a, b) => a.width * a.height * a.layers.length - b.width * b.height * b.layers.length);
    const merged = order2.some((small) => {
      const larger = drafts.filter((d) => d !== small && d.format === small.format && d.layers.length + small.layers.length <= limits.maxTextureArrayLayers).sort((a, b) => distance(small, a) - distance(small, b))[0];
      if (!larger) return false;
      larger.width = Math.max(larger.width, small.width);
      larger.height = Math.max(larger.height, small.height);
      for (const layer of small.layers) if (!larger.layers.includes(layer)) larger.layers.push(layer);
      drafts.splice(drafts.indexOf(small), 1);
      return true;
    });
    if (!merged) throw new DeviceError("renderer/limit", `The scene's textures need ${drafts.length} texture arrays, but this device binds only ${slots} (maxSampledTexturesPerShaderStage).`);
  }
  const samplers = [];
  const samplings = [];
  const placements = /* @__PURE__ */ new Map();
  for (const index of textures) {
    const texture = scene.textures[index];
    const format = formatOf(scene.images[texture.image], texture);
    const array = drafts.findIndex((d) => d.format === format && d.layers.includes(texture.image));
    const draft = drafts[array];
    const filter = texture.filter ?? "linear";
    const descriptor = {
      addressModeU: addressMode[texture.wrap_u ?? "repeat"],
      addressModeV: addressMode[texture.wrap_v ?? "repeat"],
      magFilter: filter,
      minFilter: filter,
      mipmapFilter: filter
    };
    let sampler = samplers.findIndex((s) => s.addressModeU === descriptor.addressModeU && s.addressModeV === descriptor.addressModeV && s.magFilter === descriptor.magFilter);
    if (sampler < 0) sampler = samplers.push(descriptor) - 1;
    let sampling = samplings.findIndex(([a, s]) => a === array && s === sampler);
    if (sampling < 0) sampling = samplings.push([array, sampler]) - 1;
    placements.set(index, { sampling, layer: draft.layers.indexOf(texture.image), width: draft.width, height: draft.height });
  }
  return { arrays: drafts, samplers, samplings, placements };
}
var distance = (a, b) => Math.abs(Math.log(a.width / b.width)) + Math.abs(Math.log(a.height / b.height)) + (b.width * b.height < a.width * a.height ? 100 : 0);
function resizePixels(data, width, height, toWidth, toHeight) {
  const out = new data.constructor(toWidth * toHeight * 4);
  const round = data instanceof Float32Array ? 0 : 0.5;
  for (let y = 0; y < toHeight; y++) {
    const sy = Math.min(Math.max((y + 0.5) * height / toHeight - 0.5, 0), height - 1);
    const y0 = Math.floor(sy);
    const y1 = Math.min(y0 + 1, height - 1);
    for (let x = 0; x < toWidth; x++) {
      const sx = Math.min(Math.max((x + 0.5) * width / toWidth - 0.5, 0), width - 1);
      const x0 = Math.floor(sx);
      const x1 = Math.min(x0 + 1, width - 1);
      for (let c = 0; c < 4; c++) {
        const top = data[4 * (y0 * width + x0) + c] * (1 - sx + x0) + data[4 * (y0 * width + x1) + c] * (sx - x0);
        const bottom = data[4 * (y1 * width + x0) + c] * (1 - sx + x0) + data[4 * (y1 * width + x1) + c] * (sx - x0);
        out[4 * (y * toWidth + x) + c] = top * (1 - sy + y0) + bottom * (sy - y0) + round;
      }
    }
  }
  return out;
}

// ../../packages/renderer/src/gpu/texture-upload.ts
var BYTES = { rgba8unorm: 4, "rgba8unorm-srgb": 4, rgba16float: 8 };
var MIP_SHADER = (
  /* wgsl */
  `
@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var linear_sampler: sampler;
struct Corner { @builtin(position) position: vec4f, @location(0) uv: vec2f }
@vertex fn corner(@builtin(vertex_index) index: u32) -> Corner {
  let uv = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
  return Corner(vec4f(uv * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0), 0.0, 1.0), uv);
}
@fragment fn average(in: Corner) -> @location(0) vec4f { return textureSampleLevel(source, linear_sampler, in.uv, 0.0); }
`
);
var halfScratch = new Float32Array(1);
var halfBits = new Uint32Array(halfScratch.buffer);
function toHalf(value) {
  halfScratch[0] = Math.max(-65504, Math.min(65504, Number.isNaN(value) ? 0 : value));
  const bits = halfBits[0];
  const sign = bits >>> 16 & 32768;
  const exponent = (bits >>> 23 & 255) - 112;
  const mantissa = bits & 8388607;
  if (exponent <= 0) {
    if (exponent < -10) return sign;
    const full = mantissa | 8388608;
    const shift = 14 - exponent;
    const rounded = full + (1 << shift - 1) - 1 + (full >>> shift & 1) >>> shift;
    return sign | rounded;
  }
  return sign + ((exponent << 10 | mantissa >>> 13) + ((mantissa & 8191) > 4096 || (mantissa & 8191) === 4096 && (mantissa & 8192) !== 0 ? 1 : 0));
}
function layerBytes(image, array) {
  const data = image.width === array.width && image.height === array.height ? image.data : resizePixels(image.data, image.width, image.height, array.width, array.height);
  return data instanceof Float32Array ? Uint16Array.from(data, toHalf) : data;
}
function uploadTextures(device, memory2, scene, plan) {
  const samplers = plan.samplers.map((descriptor) => device.createSampler(descriptor));
  const textures = plan.arrays.map((array, index) => {
    const mipLevelCount = 1 + Math.floor(Math.log2(Math.max(array.width, array.height)));
    const texel = BYTES[array.format];
    const texture = memory2.texture(
      {
        label: `glanz scene texture ${index}`,
        size: [array.width, array.height, array.layers.length],
        format: array.format,
        mipLevelCount,
        usage: GPU_TEXTURE_BINDING | GPU_TEXTURE_COPY_DST | GPU_TEXTURE_RENDER
      },
      Math.ceil(array.width * array.height * array.layers.length * texel * 4 / 3)
    );
    array.layers.forEach((image, layer) => {
      const data = layerBytes(scene.images[image], array);
      device.queue.writeTexture({ texture, origin: [0, 0, layer] }, data, { bytesPerRow: array.width * texel, rowsPerImage: array.height }, [array.width, array.height, 1]);
    });
    return texture;
  });
  generateMips(device, plan, textures);
  return { textures, samplers };
}
function generateMips(device, plan, textures) {
  if (!textures.some((texture) => texture.mipLevelCount > 1)) return;
  const module = device.createShaderModule({ label: "glanz mips", code: MIP_SHADER });
  const sampler = device.createSampler({ minFilter: "linear", magFilter: "linear" });
  const pipelines = /* @__PURE__ */ new Map();
  const encoder = device.createCommandEncoder({ label: "glanz mips" });
  textures.forEach((texture, index) => {
    const { format, layers } = plan.arrays[index];
    let pipeline = pipelines.get(format);
    if (!pipeline) {
      pipeline = device.createRenderPipeline({ label: `glanz mips ${format}`, layout: "auto", vertex: { module, entryPoint: "corner" }, fragment: { module, entryPoint: "average", targets: [{ format }] } });
      pipelines.set(format, pipeline);
    }
    for (let layer = 0; layer < layers.length; layer++) {
      for (let level = 1; level < texture.mipLevelCount; level++) {
        const view = (baseMipLevel) => texture.createView({ dimension: "2d", baseMipLevel, mipLevelCount: 1, baseArrayLayer: layer, arrayLayerCount: 1 });
        const group = device.createBindGroup({
          layout: pipeline.getBindGroupLayout(0),
          entries: [
            { binding: 0, resource: view(level - 1) },
            { binding: 1, resource: sampler }
          ]
        });
        const pass = encoder.beginRenderPass({ colorAttachments: [{ view: view(level), loadOp: "clear", storeOp: "store" }] });
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, group);
        pass.draw(3);
        pass.end();
      }
    }
  });
  device.queue.submit([encoder.finish()]);
}

// ../../packages/renderer/src/gpu/gpu-scene.ts
var OWN_TEXTURES = 4;
var GpuScene = class {
  #device;
  #memory;
  #scene;
  #geometry;
  #multipleScattering;
  #plan;
  #textured;
  #firstBinding;
  #bindingCount;
  #sceneTextures;
  #samplers;
  #buffers = /* @__PURE__ */ new Map();
  #textures = /* @__PURE__ */ new Map();
  #energySampler;
  #lights;
  #environment;
  constructor(device, memory2, scene, geometry, multipleScattering) {
    this.#device = device;
    this.#memory = memory2;
    this.#scene = scene;
    this.#geometry = geometry;
    this.#multipleScattering = multipleScattering;
    this.#textured = texturedParameters(scene.materials);
    const slots = device.limits.maxSampledTexturesPerShaderStage - OWN_TEXTURES;
    this.#plan = planTextures(scene, usedTextures(scene.materials), slots, device.limits);
    const { textures, samplers } = uploadTextures(device, memory2, scene, this.#plan);
    this.#sceneTextures = textures;
    this.#samplers = samplers;
    const bindings = packBindings(scene.materials, this.#plan);
    const base = geometry.attributes.length;
    const heap = new Uint32Array(base + bindings.records.byteLength / 4);
    heap.set(geometry.attributes);
    heap.set(new Uint32Array(bindings.records), base);
    const bindingWords = bindings.records.byteLength / 4 / Math.max(1, bindings.count.reduce((a, b) => a + b, 0));
    this.#firstBinding = bindings.first.map((index) => base + index * bindingWords);
    this.#bindingCount = bindings.count;
    this.#upload("nodes", geometry.nodes);
    this.#upload("triangles", geometry.triangles);
    this.#upload("attributes", heap);
    this.#upload("materials", this.#packMaterials());
    this.#lights = this.#buildLights();
    this.#upload("lights", this.#lights.records);
    this.#upload("instances", packInstances(scene, geometry, this.#lights.firstLight));
    this.#environment = prepareEnvironment(scene.environment);
    this.#uploadEnvironment();
    this.#energySampler = device.createSampler({ label: "glanz energy", minFilter: "linear", magFilter: "linear" });
    this.#uploadEnergy();
  }
  get environment() {
    return this.#environment;
  }
  get lightCount() {
    return this.#lights.count;
  }
  /** Probability that a light sample goes to the environment rather than to the table of lights. */
  get environmentProbability() {
    if (!this.#environment.table) return 0;
    if (this.#lights.count === 0) return 1;
    const radius = this.#geometry.radius;
    const power = this.#environment.meanLuminance * 4 * Math.PI * Math.PI * radius * radius;
    return Math.min(0.9, Math.max(0.1, power / (power + this.#lights.power)));
  }
  /** What decides the kernels' text. */
  features() {
    const parameters = this.#scene.materials.map((material) => resolveParameters(material.parameters));
    const texturedNames = this.#textured.map(({ name }) => name);
    const openpbrFlags = requiredFeatures(parameters, { textured: texturedNames, multipleScattering: this.#multipleScattering });
    const lights = this.#lights.count > 0;
    const sampled = this.#environment.table !== void 0;
    return {
      flags: {
        ...openpbrFlags,
        TEXTURES: this.#textured.length > 0,
        NORMAL_MAP: texturedNames.includes("geometry_normal"),
        EMISSION_TEXTURES: texturedNames.some((name) => name === "emission_color" || name === "emission_luminance"),
        VERTEX_COLORS: this.#geometry.hasVertexColors,
        BVH_FILTER: this.#scene.instances.some((instance) => instance.visible !== false && !this.#opaque(instance.material)),
        ENVIRONMENT_MAP: this.#environment.pixels !== void 0,
        ENVIRONMENT_SAMPLED: sampled,
        LIGHTS: lights,
        NEXT_EVENT: lights || sampled
      },
      samplings: this.#plan.samplings,
      textured: this.#textured,
      textureCount: this.#sceneTextures.length,
      samplerCount: this.#samplers.length
    };
  }
  /** Binding of one of the resources this scene owns. */
  resource(name) {
    const buffer = this.#buffers.get(name);
    if (buffer) return { buffer };
    const texture = this.#textures.get(name);
    if (texture) return texture.createView();
    if (name === "energy_sampler") return this.#energySampler;
    const [, kind, index] = /^scene_(texture|sampler)_(\d+)$/.exec(name) ?? [];
    if (kind === "texture") return this.#sceneTextures[Number(index)]?.createView({ dimension: "2d-array" });
    if (kind === "sampler") return this.#samplers[Number(index)];
    return void 0;
  }
  /** Re-reads one material of the scene. Returns true if bindings were replaced. */
  updateMaterial(index) {
    const stride = materialStruct.size;
    const record = materialStruct.allocate();
    this.#packMaterial(record, 0, index);
    this.#memory.write(this.#buffers.get("materials"), record, index * stride);
    return this.#updateLights();
  }
  /** Re-reads the scene's environment. Bindings are replaced. */
  updateEnvironment(environment2) {
    this.#environment = prepareEnvironment(environment2);
    this.#uploadEnvironment();
  }
  #updateLights() {
    const before = this.#lights.records.byteLength;
    this.#lights = this.#buildLights();
    this.#memory.write(this.#buffers.get("instances"), packInstances(this.#scene, this.#geometry, this.#lights.firstLight));
    if (this.#lights.records.byteLength === before) {
      this.#memory.write(this.#buffers.get("lights"), this.#lights.records);
      return false;
    }
    this.#upload("lights", this.#lights.records);
    return true;
  }
  #opaque(material) {
    const vertexAlpha = this.#scene.instances.some((instance) => {
      const colors = instance.material === material ? this.#scene.meshes[instance.mesh].colors : void 0;
      if (!colors) return false;
      for (let i = 3; i < colors.length; i += 4) if (colors[i] < 1) return true;
      return false;
    });
    return isOpaque(this.#scene.materials[material], vertexAlpha);
  }
  #packMaterial(buffer, at, index) {
    packMaterial(buffer, at, this.#scene.materials[index], this.#firstBinding[index], this.#bindingCount[index], this.#opaque(index));
  }
  #packMaterials() {
    const buffer = materialStruct.allocate(this.#scene.materials.length);
    this.#scene.materials.forEach((_, index) => this.#packMaterial(buffer, index, index));
    return buffer;
  }
  #buildLights() {
    const inverse = /* @__PURE__ */ new Map();
    const leafTriangle = (mesh, triangle) => {
      let order2 = inverse.get(mesh);
      if (!order2) {
        const leaves = this.#geometry.blas[mesh]?.triangleIndices ?? new Uint32Array();
        order2 = new Uint32Array(this.#scene.meshes[mesh].indices.length / 3);
        leaves.forEach((input, leaf) => order2[input] = leaf);
        inverse.set(mesh, order2);
      }
      return this.#geometry.firstTriangle[mesh] + order2[triangle];
    };
    return buildLightTable(this.#scene, { instanceSlots: this.#geometry.instanceSlots, leafTriangle }, this.#geometry.radius);
  }
  #upload(name, data) {
    this.#memory.release(this.#buffers.get(name));
    this.#buffers.set(name, this.#memory.upload(name, data, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_DST));
  }
  #uploadEnvironment() {
    const none = { width: 1, height: 1, data: new Float32Array(4) };
    this.#uploadFloats("environment", this.#environment.pixels ?? none);
    this.#uploadFloats("environment_table", this.#environment.table ?? none);
  }
  #uploadFloats(name, picture) {
    this.#memory.release(this.#textures.get(name));
    const { width, height, data } = picture;
    const texture = this.#memory.texture({ label: `glanz ${name}`, size: [width, height], format: "rgba32float", usage: GPU_TEXTURE_BINDING | GPU_TEXTURE_COPY_DST }, data.byteLength);
    this.#device.queue.writeTexture({ texture }, data, { bytesPerRow: width * 16, rowsPerImage: height }, [width, height]);
    this.#textures.set(name, texture);
  }
  #uploadEnergy() {
    for (const [name, table3] of [
      ["energy_dielectric", OPENPBR_TABLES.dielectric],
      ["energy_conductor", OPENPBR_TABLES.conductor]
    ]) {
      const { width, height, depth } = table3;
      const dimension = name === "energy_dielectric" ? "3d" : "2d";
      const data = Uint16Array.from(table3.data, toHalf);
      const texture = this.#memory.texture({ label: `glanz ${name}`, size: [width, height, depth], dimension, format: "r16float", usage: GPU_TEXTURE_BINDING | GPU_TEXTURE_COPY_DST }, data.byteLength);
      this.#device.queue.writeTexture({ texture }, data, { bytesPerRow: width * 2, rowsPerImage: height }, [width, height, depth]);
      this.#textures.set(name, texture);
    }
  }
};

// ../../packages/renderer/src/kernels/connect.wgsl.ts
var connect = (traversal2) => wgslModule(
  "renderer/connect",
  /* wgsl */
  `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= queues.shadow_active) { return; }
  let shadow = shadows[id.x];
  //#if BVH_FILTER
  opacity_begin(shadow.path, 2u * queues.depth + 1u);
  //#endif
  if (bvh_any_hit(shadow.origin, shadow.direction, 0.0, shadow.distance)) { return; }
  paths[shadow.path].radiance += shadow.contribution;
}
`,
  [traversal2]
);

// ../../packages/renderer/src/kernels/energy.wgsl.ts
var energyHost = wgslModule(
  "renderer/energy",
  /* wgsl */
  `
fn openpbr_table_dielectric(coords: vec3f) -> f32 { return textureSampleLevel(energy_dielectric, energy_sampler, coords, 0.0).x; }
fn openpbr_table_conductor(coords: vec2f) -> f32 { return textureSampleLevel(energy_conductor, energy_sampler, coords, 0.0).x; }
`
);

// ../../packages/renderer/src/kernels/random.wgsl.ts
var random = wgslModule(
  "renderer/random",
  /* wgsl */
  `
var<private> random_state: u32;

fn random_pcg4d(seed: vec4u) -> vec4u {
  var v = seed * 1664525u + 1013904223u;
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  v ^= v >> vec4u(16u);
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  return v;
}

fn random_begin(pixel: u32, sample: u32, stream: u32, seed: u32) {
  random_state = random_pcg4d(vec4u(pixel, sample, stream, seed)).w;
}

// In [0, 1), 24 bits.
fn random_next() -> f32 {
  let state = random_state;
  random_state = state * 747796405u + 2891336453u;
  let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return f32(((word >> 22u) ^ word) >> 8u) * 5.9604644775390625e-8;
}

fn random_2() -> vec2f {
  let x = random_next();
  return vec2f(x, random_next());
}

fn random_3() -> vec3f {
  let xy = random_2();
  return vec3f(xy, random_next());
}
`
);

// ../../packages/renderer/src/kernels/camera.wgsl.ts
var camera = wgslModule(
  "renderer/camera",
  /* wgsl */
  `
struct CameraRay {
  origin: vec3f,
  direction: vec3f,
}

// Concentric map of the square to the unit disk (Shirley and Chiu 1997).
fn camera_disk(u: vec2f) -> vec2f {
  let o = 2.0 * u - 1.0;
  if (o.x == 0.0 && o.y == 0.0) { return vec2f(0.0); }
  if (abs(o.x) > abs(o.y)) {
    let phi = 0.7853981633974483 * (o.y / o.x);
    return o.x * vec2f(cos(phi), sin(phi));
  }
  let phi = 1.5707963267948966 - 0.7853981633974483 * (o.x / o.y);
  return o.y * vec2f(cos(phi), sin(phi));
}

// The ray through the point "offset" of a pixel, (0.5, 0.5) being its centre.
fn camera_ray(pixel: vec2u, offset: vec2f, lens: vec2f) -> CameraRay {
  let film = ((vec2f(pixel) + offset) / vec2f(frame.size)) * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0);
  let p = film * frame.half_extent;
  if (frame.camera_kind == 1u) {
    let origin = frame.camera_origin + frame.camera_right * p.x + frame.camera_up * p.y;
    return CameraRay(origin, frame.camera_forward);
  }
  let through = frame.camera_forward + frame.camera_right * p.x + frame.camera_up * p.y;
  if (frame.lens_radius <= 0.0) {
    return CameraRay(frame.camera_origin, normalize(through));
  }
  let disk = camera_disk(lens) * frame.lens_radius;
  let shift = frame.camera_right * disk.x + frame.camera_up * disk.y;
  return CameraRay(frame.camera_origin + shift, normalize(through * frame.focus_distance - shift));
}
`,
  [frameStruct.module, random]
);

// ../../packages/renderer/src/kernels/features.wgsl.ts
function featuresModule(surface, openpbr2, energy, traversal2) {
  return wgslModule(
    "renderer/features",
    /* wgsl */
    `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= batch.pixel_count) { return; }
  let pixel = batch.pixel_offset + id.x;
  let at = vec2u(pixel % frame.size.x, pixel / frame.size.x);
  let first = batch.sample_offset == 0u;
  if (first) {
    feature_ids[pixel] = vec4u(0xffffffffu);
    //#if BVH_FILTER
    opacity_begin(id.x, 0xffffu);
    //#endif
    let ray = camera_ray(at, vec2f(0.5), vec2f(0.5));
    let hit = bvh_closest_hit(ray.origin, ray.direction, 0.0, 3.4e38);
    if (hit.instance != 0xffffffffu) { feature_ids[pixel] = vec4u(instances[hit.instance].id, instances[hit.instance].material, 0u, 0u); }
  }
  random_begin(pixel, batch.sample_offset, 0u, frame.seed);
  let offset = random_2();
  let ray = camera_ray(at, offset, random_2());
  //#if BVH_FILTER
  opacity_begin(id.x, 0u);
  //#endif
  let hit = bvh_closest_hit(ray.origin, ray.direction, 0.0, 3.4e38);
  var albedo = vec4f(0.0);
  var normal = vec4f(0.0);
  if (hit.instance != 0xffffffffu) {
    let s = surface_load(vec4u(bitcast<u32>(hit.u), bitcast<u32>(hit.v), hit.triangle, hit.instance), ray.origin, ray.direction, 0.0);
    let side = select(-1.0, 1.0, dot(s.geometric, ray.direction) <= 0.0);
    let n = side * s.normal;
    let cosine = clamp(-dot(n, ray.direction), 1e-3, 1.0);
    let local_wo = vec3f(sqrt(1.0 - cosine * cosine), 0.0, cosine);
    albedo = vec4f(clamp(openpbr_albedo(openpbr_prepare(s.parameters, local_wo), local_wo), vec3f(0.0), vec3f(1.0)), 1.0);
    normal = vec4f(n, distance(ray.origin, s.position));
  }
  if (!first) {
    albedo += feature_albedo[pixel];
    normal += feature_normal[pixel];
  }
  feature_albedo[pixel] = albedo;
  feature_normal[pixel] = normal;
}
`,
    [surface, openpbr2, energy, camera, traversal2]
  );
}

// ../../packages/renderer/src/kernels/generate.wgsl.ts
var generate = wgslModule(
  "renderer/generate",
  /* wgsl */
  `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let index = id.x;
  if (index >= batch.pixel_count * batch.sample_count) { return; }
  let pixel = batch.pixel_offset + index % batch.pixel_count;
  random_begin(pixel, batch.sample_offset + index / batch.pixel_count, 0u, frame.seed);
  let offset = random_2();
  let ray = camera_ray(vec2u(pixel % frame.size.x, pixel / frame.size.x), offset, random_2());
  paths[index].origin = ray.origin;
  paths[index].pdf = 0.0;
  paths[index].direction = ray.direction;
  paths[index].cone_width = 0.0;
  paths[index].throughput = vec3f(1.0);
  paths[index].alpha = 1.0;
  paths[index].radiance = vec3f(0.0);
  queues.items[index] = index;
}
`,
  [camera]
);

// ../../packages/renderer/src/kernels/intersect.wgsl.ts
var intersect = (traversal2) => wgslModule(
  "renderer/intersect",
  /* wgsl */
  `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= queues.active_count) { return; }
  let index = queues.items[(queues.depth & 1u) * queues.capacity + id.x];
  //#if BVH_FILTER
  opacity_begin(index, 2u * queues.depth);
  //#endif
  let hit = bvh_closest_hit(paths[index].origin, paths[index].direction, 0.0, 3.4e38);
  paths[index].hit = vec4u(bitcast<u32>(hit.u), bitcast<u32>(hit.v), hit.triangle, hit.instance);
}
`,
  [traversal2]
);

// ../../packages/renderer/src/kernels/environment.wgsl.ts
var environment = wgslModule(
  "renderer/environment",
  /* wgsl */
  `
//#if ENVIRONMENT_MAP
fn environment_uv(direction: vec3f) -> vec2f {
  let turn = frame.environment_rotation;
  let x = turn.x * direction.x - turn.y * direction.z;
  let z = turn.y * direction.x + turn.x * direction.z;
  let around = select(atan2(z, x), 0.0, x == 0.0 && z == 0.0);
  return vec2f(around * 0.15915494309189535 + 0.5, acos(clamp(direction.y, -1.0, 1.0)) * 0.3183098861837907);
}

fn environment_radiance(direction: vec3f) -> vec3f {
  let size = vec2i(textureDimensions(environment));
  let at = environment_uv(direction) * vec2f(size) - 0.5;
  let base = floor(at);
  let part = at - base;
  let x0 = (i32(base.x) + size.x) % size.x;
  let x1 = (x0 + 1) % size.x;
  let y0 = clamp(i32(base.y), 0, size.y - 1);
  let y1 = clamp(i32(base.y) + 1, 0, size.y - 1);
  let top = mix(textureLoad(environment, vec2i(x0, y0), 0).rgb, textureLoad(environment, vec2i(x1, y0), 0).rgb, part.x);
  let bottom = mix(textureLoad(environment, vec2i(x0, y1), 0).rgb, textureLoad(environment, vec2i(x1, y1), 0).rgb, part.x);
  return mix(top, bottom, part.y) * frame.environment_radiance;
}
//#else
fn environment_radiance(direction: vec3f) -> vec3f { return frame.environment_radiance; }
//#endif

//#if ENVIRONMENT_SAMPLED
// The density over the sphere is that over the square divided by 2\u03C0\xB2 sin \u03B8.
fn environment_pdf(direction: vec3f) -> f32 {
  let cells = frame.environment_cells;
  let cell = min(vec2u(environment_uv(direction) * vec2f(cells)), cells - 1u);
  let sine = sqrt(max(1.0 - direction.y * direction.y, 0.0));
  return textureLoad(environment_table, cell, 0).z / max(19.739208802178716 * sine, 1e-20);
}

fn environment_sample(u: vec3f) -> vec3f {
  let cells = frame.environment_cells;
  let count = cells.x * cells.y;
  let at = u.x * f32(count);
  var index = min(u32(at), count - 1u);
  let row = textureLoad(environment_table, vec2u(index % cells.x, index / cells.x), 0);
  if (u.y >= row.x) { index = u32(row.y); }
  // The part of u.y inside its interval is a fresh uniform number.
  let again = select(u.y / max(row.x, 1e-20), (u.y - row.x) / max(1.0 - row.x, 1e-20), u.y >= row.x);
  let uv = (vec2f(f32(index % cells.x), f32(index / cells.x)) + vec2f(clamp(again, 0.0, 0.99999994), u.z)) / vec2f(cells);
  let theta = uv.y * 3.141592653589793;
  let phi = (uv.x - 0.5) * 6.283185307179586;
  let flat = sin(theta) * vec2f(cos(phi), sin(phi));
  let turn = frame.environment_rotation;
  return vec3f(turn.x * flat.x + turn.y * flat.y, cos(theta), turn.x * flat.y - turn.y * flat.x);
}
//#endif
`
);

// ../../packages/renderer/src/kernels/lights.wgsl.ts
var lightSampleStruct = wgslModule(
  "renderer/light-sample",
  /* wgsl */
  `
struct LightSample {
  direction: vec3f,
  distance: f32,
  radiance: vec3f,
  // Solid-angle density including the choice of the light; for lights without size the probability of the choice.
  pdf: f32,
  // 1 if a BSDF sample could have found this light too.
  extended: bool,
}
`
);
function lightsModule(surface) {
  return wgslModule(
    "renderer/lights",
    /* wgsl */
    `
//#if LIGHTS
// Emitted radiance of a surface point towards wo (world); zero behind a one-sided emitter.
fn light_emission(s: Surface, wo: vec3f) -> vec3f {
  if ((s.flags & 4u) == 0u) { return vec3f(0.0); }
  let front = dot(s.geometric, wo);
  if (front <= 0.0 && (s.flags & 1u) == 0u) { return vec3f(0.0); }
  let cosine = abs(front);
  return openpbr_emission(s.parameters, vec3f(sqrt(max(1.0 - cosine * cosine, 0.0)), 0.0, cosine));
}

// Density with which light_sample would have chosen this emissive point from "origin", over solid angle.
fn light_pdf(s: Surface, origin: vec3f, direction: vec3f) -> f32 {
  if (s.light == 0xffffffffu) { return 0.0; }
  let offset = s.position - origin;
  let cosine = abs(dot(s.geometric, direction));
  let area = 0.5 * s.double_area;
  return (1.0 - frame.environment_probability) * lights[s.light].probability * dot(offset, offset) / max(cosine * area, 1e-30);
}

fn light_table_sample(u: vec3f, position: vec3f) -> LightSample {
  var result = LightSample(vec3f(0.0, 1.0, 0.0), 0.0, vec3f(0.0), 0.0, false);
  let at = u.x * f32(frame.light_count);
  var index = min(u32(at), frame.light_count - 1u);
  let inside = at - f32(index);
  if (inside >= lights[index].keep) { index = lights[index].other; }
  let light = lights[index];
  let choice = (1.0 - frame.environment_probability) * light.probability;
  let kind = light.kind & 15u;
  if (kind == ${LIGHT_DIRECTIONAL}u) {
    result.direction = -light.b;
    result.distance = 3.4e38;
    result.radiance = light.color;
    result.pdf = choice;
    return result;
  }
  if (kind == ${LIGHT_POINT}u || kind == ${LIGHT_SPOT}u) {
    let offset = light.a - position;
    let distance2 = max(dot(offset, offset), 1e-20);
    result.distance = sqrt(distance2);
    result.direction = offset / result.distance;
    result.radiance = light.color / distance2;
    if (kind == ${LIGHT_SPOT}u) {
      // KHR_lights_punctual's falloff: c.x scales, c.y shifts the cosine to 0..1, squared.
      let falloff = clamp(dot(-result.direction, light.b) * light.c.x + light.c.y, 0.0, 1.0);
      result.radiance *= falloff * falloff;
    }
    result.pdf = choice;
    return result;
  }
  // A uniform point on the triangle.
  let root = sqrt(u.y);
  let b1 = root * (1.0 - u.z);
  let b2 = root * u.z;
  let edge_1 = light.b - light.a;
  let edge_2 = light.c - light.a;
  var normal = cross(edge_1, edge_2);
  let double_area = length(normal);
  normal /= max(double_area, 1e-37);
  if ((light.kind & ${LIGHT_MIRRORED}u) != 0u) { normal = -normal; }
  let offset = light.a + b1 * edge_1 + b2 * edge_2 - position;
  let distance2 = dot(offset, offset);
  let distance = sqrt(distance2);
  let direction = offset / max(distance, 1e-30);
  let cosine = -dot(normal, direction);
  if ((cosine <= 0.0 && (light.kind & ${LIGHT_TWO_SIDED}u) == 0u) || abs(cosine) * double_area <= 1e-30) { return result; }
  //#if EMISSION_TEXTURES
  let s = surface_load(vec4u(bitcast<u32>(b1), bitcast<u32>(b2), light.ids.y, light.ids.x), position, direction, 0.0);
  result.radiance = light_emission(s, -direction);
  //#else
  let one = abs(cosine);
  result.radiance = openpbr_emission(materials[light.ids.z].parameters, vec3f(sqrt(max(1.0 - one * one, 0.0)), 0.0, one));
  //#endif
  result.direction = direction;
  // Stops short of the light itself.
  result.distance = distance * (1.0 - 1e-4);
  result.pdf = choice * distance2 / (abs(cosine) * 0.5 * double_area);
  result.extended = true;
  return result;
}
//#endif

fn light_sample(u: vec4f, position: vec3f) -> LightSample {
  //#if ENVIRONMENT_SAMPLED
  if (u.w < frame.environment_probability) {
    let direction = environment_sample(u.xyz);
    return LightSample(direction, 3.4e38, environment_radiance(direction), frame.environment_probability * environment_pdf(direction), true);
  }
  //#endif
  //#if LIGHTS
  return light_table_sample(u.xyz, position);
  //#else
  return LightSample(vec3f(0.0, 1.0, 0.0), 0.0, vec3f(0.0), 0.0, false);
  //#endif
}
`,
    [surface, lightStruct.module, lightSampleStruct, environment, random]
  );
}

// ../../packages/renderer/src/kernels/resources.ts
var queues = wgslModule(
  "renderer/queues-struct",
  /* wgsl */
  `
// Two lists of path indices: the one being worked on and the next; "items" holds both, half its length each.
struct Queues {
  depth: u32,
  active_count: u32,
  shadow_active: u32,
  bad_samples: atomic<u32>,
  next_count: atomic<u32>,
  shadow_count: atomic<u32>,
  capacity: u32,
  reserved: u32,
  items: array<u32>,
}`
);
var RESOURCES = {
  frame: { type: "Frame", space: "uniform", deps: [frameStruct.module] },
  batch: { type: "Batch", space: "uniform", deps: [batchStruct.module] },
  paths: { type: "array<Path>", space: "read_write", deps: [pathStruct.module] },
  queues: { type: "Queues", space: "read_write", deps: [queues] },
  shadows: { type: "array<Shadow>", space: "read_write", deps: [shadowStruct.module] },
  dispatch: { type: "array<u32, 8>", space: "read_write" },
  nodes: { type: "array<BvhNode>", space: "read", deps: [bvhNodeStruct.module] },
  triangles: { type: "array<vec4f>", space: "read" },
  instances: { type: "array<Instance>", space: "read", deps: [instanceStruct.module] },
  attributes: { type: "array<u32>", space: "read" },
  materials: { type: "array<Material>", space: "read", deps: [materialStruct.module] },
  lights: { type: "array<Light>", space: "read", deps: [lightStruct.module] },
  environment: { type: "texture_2d<f32>", space: "unfilterable" },
  environment_table: { type: "texture_2d<f32>", space: "unfilterable" },
  energy_dielectric: { type: "texture_3d<f32>", space: "texture_3d" },
  energy_conductor: { type: "texture_2d<f32>", space: "texture_2d" },
  energy_sampler: { type: "sampler", space: "sampler" },
  film_block: { type: "array<vec4f>", space: "read_write" },
  film_total: { type: "array<vec4f>", space: "read_write" },
  beauty: { type: "array<vec4f>", space: "read_write" },
  feature_albedo: { type: "array<vec4f>", space: "read_write" },
  feature_normal: { type: "array<vec4f>", space: "read_write" },
  feature_ids: { type: "array<vec4u>", space: "read_write" }
};
function bindingModule(kernel, names, extra, deps) {
  const lines = names.map((name, index) => {
    const { type, space } = RESOURCES[name];
    const qualifier = space === "uniform" ? "<uniform>" : space === "read" ? "<storage, read>" : space === "read_write" ? "<storage, read_write>" : "";
    return `@group(0) @binding(${index}) var${qualifier} ${name}: ${type};`;
  });
  extra.forEach(([name, kind], index) => {
    lines.push(`@group(0) @binding(${names.length + index}) var ${name}: ${kind === "sampler" ? "sampler" : "texture_2d_array<f32>"};`);
  });
  const structs = names.flatMap((name) => RESOURCES[name].deps ?? []);
  return wgslModule(`renderer/${kernel}-bindings`, lines.join("\n"), [...structs, ...deps]);
}
function bindGroupLayout(device, kernel, names, extra) {
  const entries = names.map((name, binding) => ({ binding, visibility: GPU_STAGE_COMPUTE, ...layoutEntry(RESOURCES[name].space) }));
  extra.forEach(([, kind], index) => entries.push({ binding: names.length + index, visibility: GPU_STAGE_COMPUTE, ...layoutEntry(kind) }));
  return device.createBindGroupLayout({ label: `glanz ${kernel}`, entries });
}
function layoutEntry(space) {
  switch (space) {
    case "uniform":
      return { buffer: { type: "uniform" } };
    case "read":
      return { buffer: { type: "read-only-storage" } };
    case "read_write":
      return { buffer: { type: "storage" } };
    case "texture_2d":
      return { texture: { sampleType: "float" } };
    case "texture_2d_array":
      return { texture: { sampleType: "float", viewDimension: "2d-array" } };
    case "texture_3d":
      return { texture: { sampleType: "float", viewDimension: "3d" } };
    case "unfilterable":
      return { texture: { sampleType: "unfilterable-float" } };
    case "sampler":
      return { sampler: { type: "filtering" } };
  }
}

// ../../packages/renderer/src/kernels/resolve.wgsl.ts
var resolve = wgslModule(
  "renderer/resolve",
  /* wgsl */
  `
fn resolve_finite(v: vec4f) -> bool {
  return all((bitcast<vec4u>(v) & vec4u(0x7f800000u)) != vec4u(0x7f800000u));
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= batch.pixel_count) { return; }
  let pixel = batch.pixel_offset + id.x;
  var block = film_block[pixel];
  var total = film_total[pixel];
  for (var s = 0u; s < batch.sample_count; s++) {
    let index = s * batch.pixel_count + id.x;
    let value = vec4f(paths[index].radiance, paths[index].alpha);
    if (resolve_finite(value)) { block += value; } else { atomicAdd(&queues.bad_samples, 1u); }
    if (((batch.sample_offset + s) & 63u) == 63u) {
      total += block;
      block = vec4f(0.0);
    }
  }
  film_block[pixel] = block;
  film_total[pixel] = total;
  beauty[pixel] = (total + block) / f32(batch.sample_offset + batch.sample_count);
}
`
);

// ../../packages/renderer/src/kernels/schedule.wgsl.ts
var write = (
  /* wgsl */
  `
fn schedule_write(at: u32, count: u32) {
  dispatch[at] = (count + 63u) / 64u;
  dispatch[at + 1u] = 1u;
  dispatch[at + 2u] = 1u;
}
`
);
var begin = wgslModule(
  "renderer/begin",
  /* wgsl */
  `
${write}
@compute @workgroup_size(1)
fn main() {
  queues.depth = 0u;
  queues.active_count = batch.pixel_count * batch.sample_count;
  atomicStore(&queues.next_count, 0u);
  atomicStore(&queues.shadow_count, 0u);
  queues.capacity = arrayLength(&queues.items) / 2u;
  schedule_write(0u, queues.active_count);
  schedule_write(4u, 0u);
}
`
);
var advance = wgslModule(
  "renderer/advance",
  /* wgsl */
  `
${write}
@compute @workgroup_size(1)
fn main() {
  queues.depth += 1u;
  queues.active_count = atomicExchange(&queues.next_count, 0u);
  queues.shadow_active = atomicExchange(&queues.shadow_count, 0u);
  schedule_write(0u, queues.active_count);
  schedule_write(4u, queues.shadow_active);
}
`
);

// ../../packages/renderer/src/kernels/shade.wgsl.ts
function shadeModule(surface, lights, openpbr2, energy) {
  return wgslModule(
    "renderer/shade",
    /* wgsl */
    `
var<workgroup> shade_next: atomic<u32>;
var<workgroup> shade_shadow: atomic<u32>;
var<workgroup> shade_next_base: u32;
var<workgroup> shade_shadow_base: u32;

struct ShadeResult {
  goes_on: bool,
  asks: bool,
  shadow: Shadow,
}

// Radiance from outside the scene.
fn shade_miss(index: u32, depth: u32) {
  let direction = paths[index].direction;
  if (depth == 0u && frame.background != 0u) {
    if ((frame.background & ${BACKGROUND_TRANSPARENT}u) != 0u) { paths[index].alpha = 0.0; }
    if ((frame.background & ${BACKGROUND_HIDDEN}u) != 0u) { return; }
  }
  var weight = 1.0;
  //#if ENVIRONMENT_SAMPLED
  if (depth > 0u) {
    let pdf = paths[index].pdf;
    weight = pdf / (pdf + frame.environment_probability * environment_pdf(direction));
  }
  //#endif
  paths[index].radiance += paths[index].throughput * environment_radiance(direction) * weight;
}

fn shade_path(index: u32, depth: u32) -> ShadeResult {
  var result: ShadeResult;
  let hit = paths[index].hit;
  if (hit.w == 0xffffffffu) {
    shade_miss(index, depth);
    return result;
  }
  let origin = paths[index].origin;
  let direction = paths[index].direction;
  let throughput = paths[index].throughput;
  let cone_width = paths[index].cone_width;
  let wo = -direction;
  var s = surface_load(hit, origin, direction, cone_width);

  //#if LIGHTS
  let emitted = light_emission(s, wo);
  if (any(emitted > vec3f(0.0))) {
    var weight = 1.0;
    if (depth > 0u) {
      let pdf = paths[index].pdf;
      weight = pdf / (pdf + light_pdf(s, origin, direction));
    }
    paths[index].radiance += throughput * emitted * weight;
  }
  //#endif
  // "depth" counts from 0, so this vertex ends edge depth + 1; the next edge must be allowed.
  if (depth + 1u >= frame.max_depth) { return result; }

  // Everything reflects on both sides: the frame turns to the side the path came from.
  let side = select(-1.0, 1.0, dot(s.geometric, wo) >= 0.0);
  let geometric = side * s.geometric;
  var normal = side * s.normal;
  let facing = dot(normal, wo);
  if (facing < 1e-3) { normal = normalize(normal + wo * (1e-3 - facing)); }
  let tangent = normalize(s.tangent - normal * dot(s.tangent, normal));
  let bitangent = side * sign(dot(cross(s.normal, s.tangent), s.bitangent)) * cross(normal, tangent);
  let to_world = mat3x3f(tangent, bitangent, normal);
  let local_wo = wo * to_world;
  let bsdf = openpbr_prepare(s.parameters, local_wo);
  let start = bvh_offset_origin(s.position, geometric, s.magnitude);
  random_begin(batch.pixel_offset + index % batch.pixel_count, batch.sample_offset + index / batch.pixel_count, depth + 1u, frame.seed);

  //#if NEXT_EVENT
  let light = light_sample(vec4f(random_3(), random_next()), start);
  if (light.pdf > 0.0 && dot(geometric, light.direction) > 0.0) {
    let local_wi = light.direction * to_world;
    let scatter = openpbr_eval_pdf(bsdf, local_wo, local_wi);
    if (any(scatter.xyz > vec3f(0.0))) {
      let weight = select(1.0, light.pdf / (light.pdf + scatter.w), light.extended);
      result.asks = true;
      result.shadow.origin = start;
      result.shadow.distance = light.distance;
      result.shadow.direction = light.direction;
      result.shadow.path = index;
      result.shadow.contribution = throughput * scatter.xyz * light.radiance * (weight / light.pdf);
    }
  }
  //#endif

  let scattered = openpbr_sample(bsdf, local_wo, random_3());
  if (!scattered.valid) { return result; }
  let next = to_world * scattered.wi;
  if (dot(next, geometric) <= 0.0) { return result; }
  var carried = throughput * scattered.weight;
  let brightest = max(carried.x, max(carried.y, carried.z));
  if (!(brightest > 0.0)) { return result; }
  // Russian roulette from the third scattering on, for paths that carry less than a sixteenth of what they began with:
  // earlier, the noise it adds outweighs the rays it saves.
  if (depth >= 2u && brightest < 0.0625) {
    let survival = 16.0 * brightest;
    if (random_next() >= survival) { return result; }
    carried /= survival;
  }
  paths[index].origin = start;
  paths[index].pdf = scattered.pdf;
  paths[index].direction = next;
  paths[index].cone_width = cone_width + frame.cone_spread * distance(origin, s.position);
  paths[index].throughput = carried;
  result.goes_on = true;
  return result;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_index) lane: u32) {
  let depth = queues.depth;
  var result: ShadeResult;
  var index = 0u;
  if (id.x < queues.active_count) {
    index = queues.items[(depth & 1u) * queues.capacity + id.x];
    result = shade_path(index, depth);
  }
  // Places in the queues: one global atomic for a workgroup.
  var next_slot = 0u;
  var shadow_slot = 0u;
  if (result.goes_on) { next_slot = atomicAdd(&shade_next, 1u); }
  if (result.asks) { shadow_slot = atomicAdd(&shade_shadow, 1u); }
  workgroupBarrier();
  if (lane == 0u) {
    shade_next_base = atomicAdd(&queues.next_count, atomicLoad(&shade_next));
    shade_shadow_base = atomicAdd(&queues.shadow_count, atomicLoad(&shade_shadow));
  }
  workgroupBarrier();
  if (result.goes_on) { queues.items[((depth + 1u) & 1u) * queues.capacity + shade_next_base + next_slot] = index; }
  if (result.asks) { shadows[shade_shadow_base + shadow_slot] = result.shadow; }
}
`,
    [surface, lights, openpbr2, energy, random, bvhOffset]
  );
}

// ../../packages/renderer/src/kernels/surface.wgsl.ts
var word = (field) => bindingStruct.offsetOf(field) / 4;
var meshWord = (field) => meshStruct.offsetOf(field) / 4;
var attributes = wgslModule(
  "renderer/attributes",
  /* wgsl */
  `
fn attribute_mesh(mesh: u32, field: u32) -> u32 { return attributes[mesh * ${meshStruct.size / 4}u + field]; }

fn attribute_corners(mesh: u32, triangle: u32) -> vec3u {
  let at = attribute_mesh(mesh, ${meshWord("indices")}u) + 3u * triangle;
  return vec3u(attributes[at], attributes[at + 1u], attributes[at + 2u]);
}

fn attribute_2(at: u32) -> vec2f { return bitcast<vec2f>(vec2u(attributes[at], attributes[at + 1u])); }
fn attribute_3(at: u32) -> vec3f { return bitcast<vec3f>(vec3u(attributes[at], attributes[at + 1u], attributes[at + 2u])); }
fn attribute_4(at: u32) -> vec4f { return bitcast<vec4f>(vec4u(attributes[at], attributes[at + 1u], attributes[at + 2u], attributes[at + 3u])); }

struct AttributeUv {
  uv: vec2f,
  // Edges of the triangle in texture space.
  edge_1: vec2f,
  edge_2: vec2f,
}

fn attribute_uv(base: u32, corners: vec3u, weights: vec3f) -> AttributeUv {
  if (base == 0xffffffffu) { return AttributeUv(vec2f(0.0), vec2f(0.0), vec2f(0.0)); }
  let a = attribute_2(base + 2u * corners.x);
  let b = attribute_2(base + 2u * corners.y);
  let c = attribute_2(base + 2u * corners.z);
  return AttributeUv(weights.x * a + weights.y * b + weights.z * c, b - a, c - a);
}

fn attribute_color(mesh: u32, corners: vec3u, weights: vec3f) -> vec4f {
  let base = attribute_mesh(mesh, ${meshWord("colors")}u);
  if (base == 0xffffffffu) { return vec4f(1.0); }
  return weights.x * attribute_4(base + 4u * corners.x) + weights.y * attribute_4(base + 4u * corners.y) + weights.z * attribute_4(base + 4u * corners.z);
}
`,
  [meshStruct.module]
);
function materialModule(samplings, textured) {
  const cases = samplings.map(([texture, sampler], index) => `    case ${index}u: { return textureSampleLevel(scene_texture_${texture}, scene_sampler_${sampler}, uv, layer, lod); }`).join("\n");
  const apply = textured.filter(({ name }) => name !== "geometry_normal").map(({ name, id, type }) => `      case ${id}u: { result.parameters.${name} *= ${type === "vec3f" ? "texel.rgb" : "value"}; }`).join("\n");
  const normal = textured.find(({ name }) => name === "geometry_normal");
  return wgslModule(
    "renderer/material",
    /* wgsl */
    `
struct MaterialSample {
  parameters: OpenPbrParameters,
  // Tangent-space normal from the normal map, before normalising; (0, 0, 1) without one.
  normal: vec3f,
  flags: u32,
  threshold: f32,
}

//#if TEXTURES
fn material_texel(sampling: u32, uv: vec2f, layer: u32, lod: f32) -> vec4f {
  switch (sampling) {
${cases}
    default: { return vec4f(1.0); }
  }
}
//#endif

// "only" picks one parameter to texture, 0xffffffff all of them; "lod" is log2 of the footprint in units of uv.
fn material_sample(index: u32, uv0: vec2f, uv1: vec2f, lod0: f32, lod1: f32, only: u32) -> MaterialSample {
  var result: MaterialSample;
  result.parameters = materials[index].parameters;
  result.normal = vec3f(0.0, 0.0, 1.0);
  result.flags = materials[index].flags;
  result.threshold = materials[index].opacity_threshold;
  //#if TEXTURES
  let count = min(materials[index].binding_count, 64u);
  let first = materials[index].first_binding;
  for (var i = 0u; i < count; i++) {
    let at = first + i * ${bindingStruct.size / 4}u;
    let parameter = attributes[at + ${word("parameter")}u];
    if (only != 0xffffffffu && parameter != only) { continue; }
    let channels = attributes[at + ${word("channels")}u];
    let second = (channels >> 8u) != 0u;
    let uv = vec3f(select(uv0, uv1, second), 1.0);
    let placed = vec2f(dot(attribute_3(at + ${word("row_u")}u), uv), dot(attribute_3(at + ${word("row_v")}u), uv));
    let lod = select(lod0, lod1, second) + bitcast<f32>(attributes[at + ${word("log_size")}u]);
    let texel = material_texel(attributes[at + ${word("sampling")}u], placed, attributes[at + ${word("layer")}u], max(lod, 0.0));
    let value = texel[min(channels & 255u, 3u)];
    switch (parameter) {
${apply}
${normal ? `      case ${normal.id}u: { result.normal = (2.0 * texel.xyz - 1.0) * vec3f(vec2f(bitcast<f32>(attributes[at + ${word("scale")}u])), 1.0); }` : ""}
      default: { }
    }
  }
  //#endif
  return result;
}
`,
    [bindingStruct.module, materialStruct.module, attributes]
  );
}
function opacityModule(material, opacityParameter) {
  return wgslModule(
    "renderer/opacity",
    /* wgsl */
    `
var<private> opacity_key: vec3u;

// Names the random numbers of one ray: its path and its place along the path.
fn opacity_begin(path: u32, stream: u32) {
  opacity_key = vec3u(batch.pixel_offset + path % batch.pixel_count, batch.sample_offset + path / batch.pixel_count, stream);
}

fn opacity_at(hit: BvhHit) -> f32 {
  let index = instances[hit.instance].material;
  if ((materials[index].flags & 2u) != 0u) { return 1.0; }
  let mesh = instances[hit.instance].mesh;
  let corners = attribute_corners(mesh, bitcast<u32>(triangles[3u * hit.triangle].w));
  let weights = vec3f(1.0 - hit.u - hit.v, hit.u, hit.v);
  let uv0 = attribute_uv(attribute_mesh(mesh, ${meshWord("uv0")}u), corners, weights).uv;
  let uv1 = attribute_uv(attribute_mesh(mesh, ${meshWord("uv1")}u), corners, weights).uv;
  let sample = material_sample(index, uv0, uv1, -64.0, -64.0, ${opacityParameter}u);
  var opacity = sample.parameters.geometry_opacity;
  //#if VERTEX_COLORS
  opacity *= attribute_color(mesh, corners, weights).a;
  //#endif
  if ((sample.flags & ${MATERIAL_MASK}u) != 0u) { return select(0.0, 1.0, opacity >= sample.threshold); }
  return opacity;
}

// Crossing a surface of opacity \u03B1 goes on with probability 1 \u2212 \u03B1. The decision hangs on ray, instance and triangle alone,
// not on the order of traversal, so the nearest accepted hit is well defined.
fn bvh_accept(hit: BvhHit) -> bool {
  let opacity = opacity_at(hit);
  if (opacity >= 1.0) { return true; }
  let seed = vec4u(opacity_key.xy, opacity_key.z + 0x10000u * (frame.seed & 0xffffu), (hit.triangle * 0x9e3779b9u) ^ (hit.instance * 0x85ebca6bu + 1u));
  return f32(random_pcg4d(seed).x >> 8u) * 5.9604644775390625e-8 < opacity;
}
`,
    [material, random]
  );
}
function surfaceModule(material) {
  return wgslModule(
    "renderer/surface",
    /* wgsl */
    `
struct Surface {
  position: vec3f,
  // Unit; towards the front (the side the triangle's counter-clockwise winding faces).
  geometric: vec3f,
  // Unit shading frame on the front side.
  normal: vec3f,
  tangent: vec3f,
  bitangent: vec3f,
  parameters: OpenPbrParameters,
  flags: u32,
  material: u32,
  // Light index of this triangle, or 0xffffffff.
  light: u32,
  id: u32,
  // Twice the triangle's area in the world.
  double_area: f32,
  // Largest coordinate that went into the position; rounding errors are proportional to it.
  magnitude: f32,
}

// Branch-free frame (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017).
fn surface_tangent(n: vec3f) -> vec3f {
  let s = select(-1.0, 1.0, n.z >= 0.0);
  let a = -1.0 / (s + n.z);
  return vec3f(1.0 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

fn surface_normal_to_world(columns: mat3x3f, orientation: f32, n: vec3f) -> vec3f {
  return orientation * (cross(columns[1], columns[2]) * n.x + cross(columns[2], columns[0]) * n.y + cross(columns[0], columns[1]) * n.z);
}

// "hit": barycentrics as bits, triangle, instance. "cone": width of the ray's footprint per unit of distance, and at its origin.
fn surface_load(hit: vec4u, origin: vec3f, direction: vec3f, cone_width: f32) -> Surface {
  var s: Surface;
  let u = bitcast<f32>(hit.x);
  let v = bitcast<f32>(hit.y);
  let weights = vec3f(1.0 - u - v, u, v);
  let first = triangles[3u * hit.z];
  let a = first.xyz;
  let b = triangles[3u * hit.z + 1u].xyz;
  let c = triangles[3u * hit.z + 2u].xyz;
  let edge_1 = b - a;
  let edge_2 = c - a;
  let triangle = bitcast<u32>(first.w);
  let x = instances[hit.w].to_world_0;
  let y = instances[hit.w].to_world_1;
  let z = instances[hit.w].to_world_2;
  let p = a + u * edge_1 + v * edge_2;
  s.position = vec3f(dot(x.xyz, p) + x.w, dot(y.xyz, p) + y.w, dot(z.xyz, p) + z.w);
  let reach = vec4f(max(abs(a), max(abs(b), abs(c))), 1.0);
  s.magnitude = max(dot(abs(x), reach), max(dot(abs(y), reach), dot(abs(z), reach)));
  let columns = transpose(mat3x3f(x.xyz, y.xyz, z.xyz));
  let orientation = select(-1.0, 1.0, dot(columns[0], cross(columns[1], columns[2])) >= 0.0);
  let area = surface_normal_to_world(columns, orientation, cross(edge_1, edge_2));
  s.double_area = length(area);
  s.geometric = area / max(s.double_area, 1e-37);
  s.normal = s.geometric;
  s.id = instances[hit.w].id;
  s.material = instances[hit.w].material;
  let light = instances[hit.w].first_light;
  s.light = select(light + triangle, 0xffffffffu, light == 0xffffffffu);

  let mesh = instances[hit.w].mesh;
  let corners = attribute_corners(mesh, triangle);
  let normals = attribute_mesh(mesh, ${meshWord("normals")}u);
  if (normals != 0xffffffffu) {
    let n = weights.x * attribute_3(normals + 3u * corners.x) + weights.y * attribute_3(normals + 3u * corners.y) + weights.z * attribute_3(normals + 3u * corners.z);
    let world = surface_normal_to_world(columns, orientation, n);
    let length2 = dot(world, world);
    if (length2 > 0.0) { s.normal = world * inverseSqrt(length2); }
  }

  //#if TEXTURES
  let uv0 = attribute_uv(attribute_mesh(mesh, ${meshWord("uv0")}u), corners, weights);
  let uv1 = attribute_uv(attribute_mesh(mesh, ${meshWord("uv1")}u), corners, weights);
  // Texture level from the ray's cone (Akenine-M\xF6ller et al., "Texture Level of Detail Strategies", Ray Tracing Gems 2019).
  let width = cone_width + frame.cone_spread * distance(origin, s.position);
  let footprint = log2(max(width, 1e-30)) - log2(max(abs(dot(direction, s.geometric)), 1e-3)) + frame.lod_bias - 0.5 * log2(max(s.double_area, 1e-37));
  let lod0 = footprint + 0.5 * log2(max(abs(uv0.edge_1.x * uv0.edge_2.y - uv0.edge_1.y * uv0.edge_2.x), 1e-37));
  let lod1 = footprint + 0.5 * log2(max(abs(uv1.edge_1.x * uv1.edge_2.y - uv1.edge_1.y * uv1.edge_2.x), 1e-37));
  let sample = material_sample(s.material, uv0.uv, uv1.uv, lod0, lod1, 0xffffffffu);
  //#else
  let sample = material_sample(s.material, vec2f(0.0), vec2f(0.0), 0.0, 0.0, 0xffffffffu);
  //#endif
  s.parameters = sample.parameters;
  s.flags = sample.flags;
  //#if VERTEX_COLORS
  s.parameters.base_color *= attribute_color(mesh, corners, weights).rgb;
  //#endif

  var tangent = surface_tangent(s.normal);
  var handedness = 1.0;
  let tangents = attribute_mesh(mesh, ${meshWord("tangents")}u);
  if (tangents != 0xffffffffu) {
    let t = weights.x * attribute_4(tangents + 4u * corners.x) + weights.y * attribute_4(tangents + 4u * corners.y) + weights.z * attribute_4(tangents + 4u * corners.z);
    let world = columns * t.xyz;
    let flat = world - s.normal * dot(s.normal, world);
    if (dot(flat, flat) > 1e-12 * dot(world, world)) {
      tangent = normalize(flat);
      handedness = select(-1.0, 1.0, t.w >= 0.0) * orientation;
    }
  }
  //#if NORMAL_MAP
  else {
    // Tangents from the texture coordinates: along +u, with the bitangent against +v, since v runs down the picture.
    let det = uv0.edge_1.x * uv0.edge_2.y - uv0.edge_1.y * uv0.edge_2.x;
    if (det != 0.0) {
      let along_u = columns * (edge_1 * uv0.edge_2.y - edge_2 * uv0.edge_1.y) * sign(det);
      let against_v = columns * (edge_1 * uv0.edge_2.x - edge_2 * uv0.edge_1.x) * sign(det);
      let flat = along_u - s.normal * dot(s.normal, along_u);
      if (dot(flat, flat) > 0.0) {
        tangent = normalize(flat);
        handedness = select(-1.0, 1.0, dot(cross(s.normal, tangent), against_v) >= 0.0);
      }
    }
  }
  let mapped = sample.normal.x * tangent + handedness * sample.normal.y * cross(s.normal, tangent) + sample.normal.z * s.normal;
  let mapped2 = dot(mapped, mapped);
  if (mapped2 > 1e-12 && sample.normal.z > 0.0) { s.normal = mapped * inverseSqrt(mapped2); }
  //#endif
  tangent -= s.normal * dot(s.normal, tangent);
  let tangent2 = dot(tangent, tangent);
  s.tangent = select(surface_tangent(s.normal), tangent * inverseSqrt(max(tangent2, 1e-30)), tangent2 > 1e-6);
  s.bitangent = handedness * cross(s.normal, s.tangent);
  return s;
}
`,
    [material, instanceStruct.module, gated("TEXTURES", attributes)]
  );
}

// ../../packages/renderer/src/kernels/traversal.wgsl.ts
function traversalModule(kind, opacity) {
  const query = kind === "any" ? bvhAnyHit : bvhClosestHit;
  return wgslModule(
    `renderer/traversal-${kind}`,
    /* wgsl */
    `
fn bvh_node(index: u32) -> BvhNode { return nodes[index]; }
fn bvh_instance(index: u32) -> BvhInstance { return instances[index].traversal; }
fn bvh_triangle(index: u32) -> BvhTriangle {
  let a = triangles[3u * index];
  return BvhTriangle(a.xyz, bitcast<u32>(a.w), triangles[3u * index + 1u].xyz, triangles[3u * index + 2u].xyz);
}
`,
    opacity ? [query, opacity] : [query]
  );
}

// ../../packages/renderer/src/kernels/pipelines.ts
var KERNELS = ["generate", "begin", "intersect", "shade", "advance", "connect", "resolve", "features"];
function kernelText(name, features) {
  const { flags } = features;
  const material = materialModule(features.samplings, features.textured);
  const opacity = opacityModule(material, OPACITY_ID);
  const surface = surfaceModule(material);
  const traversal2 = (kind) => traversalModule(kind, flags.BVH_FILTER === true ? opacity : void 0);
  const filter = flags.BVH_FILTER ? ["frame", "batch", "attributes", "materials"] : [];
  const energy = ["energy_dielectric", "energy_conductor", "energy_sampler"];
  const scene = ["triangles", "instances", "attributes", "materials"];
  switch (name) {
    case "generate":
      return { root: generate, resources: ["frame", "batch", "paths", "queues"], textures: false };
    case "begin":
      return { root: begin, resources: ["batch", "queues", "dispatch"], textures: false };
    case "advance":
      return { root: advance, resources: ["queues", "dispatch"], textures: false };
    case "intersect":
      return { root: intersect(traversal2("closest")), resources: [...filter, "paths", "queues", "nodes", "triangles", "instances"], textures: flags.BVH_FILTER === true };
    case "connect":
      return { root: connect(traversal2("any")), resources: [...filter, "paths", "queues", "shadows", "nodes", "triangles", "instances"], textures: flags.BVH_FILTER === true };
    case "shade":
      return {
        root: shadeModule(surface, lightsModule(surface), openpbr, energyHost),
        resources: ["frame", "batch", "paths", "queues", "shadows", ...scene, "lights", "environment", "environment_table", ...energy],
        textures: true
      };
    case "resolve":
      return { root: resolve, resources: ["batch", "paths", "queues", "film_block", "film_total", "beauty"], textures: false };
    case "features":
      return {
        root: featuresModule(surface, openpbr, energyHost, traversal2("closest")),
        resources: ["frame", "batch", "nodes", ...scene, "feature_albedo", "feature_normal", "feature_ids", ...energy],
        textures: true
      };
  }
}
async function createKernel(device, name, features) {
  const text = kernelText(name, features);
  const sceneBindings = text.textures ? [
    ...Array.from({ length: features.textureCount }, (_, i) => [`scene_texture_${i}`, "texture_2d_array"]),
    ...Array.from({ length: features.samplerCount }, (_, i) => [`scene_sampler_${i}`, "sampler"])
  ] : [];
  const bindings = bindingModule(name, text.resources, sceneBindings, []);
  const shader = compose([bindings, text.root], { flags: features.flags });
  const layout = bindGroupLayout(device, name, text.resources, sceneBindings);
  const module = await createShaderModule(device, shader, `glanz ${name}`);
  try {
    const pipeline = await device.createComputePipelineAsync({
      label: `glanz ${name}`,
      layout: device.createPipelineLayout({ label: `glanz ${name}`, bindGroupLayouts: [layout] }),
      compute: { module, entryPoint: "main" }
    });
    return { pipeline, layout, resources: text.resources, sceneBindings };
  } catch (cause) {
    throw new DeviceError("renderer/gpu-error", `The GPU refused the kernel "${name}": ${cause.message}`, { cause });
  }
}

// ../../packages/renderer/src/gpu/kernel-cache.ts
var cachesOf = /* @__PURE__ */ new WeakMap();
var KernelCache = class {
  #device;
  #sets;
  #kernels;
  constructor(device) {
    this.#device = device;
    let caches = cachesOf.get(device);
    if (!caches) cachesOf.set(device, caches = { sets: /* @__PURE__ */ new Map(), kernels: /* @__PURE__ */ new Map() });
    this.#sets = caches.sets;
    this.#kernels = caches.kernels;
  }
  /** All kernels of the main loop, compiled side by side. */
  get(features, onProgress) {
    const key = JSON.stringify(features);
    return remember(this.#sets, key, async () => {
      const names = KERNELS.filter((name) => name !== "features" && (name !== "connect" || features.flags.NEXT_EVENT === true));
      let done = 0;
      const compiled = await Promise.all(
        names.map(async (name) => {
          const kernel = await this.kernel(name, features);
          onProgress?.(++done / names.length);
          return [name, kernel];
        })
      );
      return { features, kernels: Object.fromEntries(compiled) };
    });
  }
  /** One kernel. */
  kernel(name, features) {
    return remember(this.#kernels, `${name} ${JSON.stringify(features)}`, () => createKernel(this.#device, name, features));
  }
};
function remember(map, key, make) {
  let found = map.get(key);
  if (!found) {
    found = make();
    map.set(key, found);
    found.catch(() => map.delete(key));
  }
  return found;
}

// ../../packages/renderer/src/scene/camera.ts
function axis2(transform2, column) {
  const v = [0, 1, 2].map((i) => transform2[column * 4 + i]);
  const length2 = Math.hypot(...v);
  if (!(length2 > 0) || !Number.isFinite(length2)) throw new RenderError("renderer/camera", `The camera's transform has a zero or non-finite axis (column ${column}).`);
  return v.map((x) => x / length2);
}
var cross3 = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0]
];
function cameraUniforms(camera2, width, height) {
  const forward = axis2(camera2.transform, 2).map((x) => -x);
  const upHint = axis2(camera2.transform, 1);
  const right = cross3(forward, upHint);
  const length2 = Math.hypot(...right);
  if (!(length2 > 1e-6)) throw new RenderError("renderer/camera", "The camera's up and view axes are parallel.");
  const unitRight = right.map((x) => x / length2);
  const up = cross3(unitRight, forward);
  const camera_origin = [0, 1, 2].map((i) => camera2.transform[12 + i]);
  const base = { camera_origin, camera_right: unitRight, camera_up: up, camera_forward: forward };
  if (camera2.type === "orthographic") {
    if (!(camera2.xmag > 0) || !(camera2.ymag > 0)) throw new RenderError("renderer/camera", `Camera "${camera2.name}" has a view of no size: xmag ${camera2.xmag}, ymag ${camera2.ymag}.`);
    return { ...base, camera_kind: 1, lens_radius: 0, focus_distance: 1, half_extent: [camera2.ymag * width / height, camera2.ymag], cone_spread: 0 };
  }
  if (!(camera2.yfov > 0) || !(camera2.yfov < Math.PI)) throw new RenderError("renderer/camera", `Camera "${camera2.name}" has a vertical field of view of ${camera2.yfov} rad; it must lie between 0 and \u03C0.`);
  const tangent = Math.tan(camera2.yfov / 2);
  return {
    ...base,
    camera_kind: 0,
    lens_radius: Math.max(camera2.lens_radius ?? 0, 0),
    focus_distance: Math.max(camera2.focus_distance ?? 1, 1e-6),
    half_extent: [tangent * width / height, tangent],
    cone_spread: 2 * tangent / height
  };
}

// ../../packages/renderer/src/frame.ts
function packFrame(camera2, film, scene, geometry, options) {
  const data = frameStruct.allocate();
  const { environment: environment2 } = scene;
  const transparent = options.background === "transparent";
  frameStruct.write(data, 0, {
    ...cameraUniforms(camera2, film.width, film.height),
    size: [film.width, film.height],
    seed: (options.seed ?? 0) >>> 0,
    max_depth: options.maxDepth ?? 8,
    light_count: scene.lightCount,
    background: (transparent ? BACKGROUND_TRANSPARENT | BACKGROUND_HIDDEN : 0) | (environment2.visible ? 0 : BACKGROUND_HIDDEN),
    environment_radiance: environment2.radiance,
    environment_probability: scene.environmentProbability,
    environment_rotation: environment2.rotation,
    environment_cells: [environment2.table?.width ?? 1, environment2.table?.height ?? 1],
    lod_bias: options.textureLodBias ?? -1,
    scene_scale: geometry.radius
  });
  return data;
}

// ../../packages/renderer/src/pick.ts
function pickPixel(scene, geometry, camera2, width, height, x, y) {
  const view = cameraUniforms(camera2, width, height);
  const sx = (2 * x / width - 1) * view.half_extent[0];
  const sy = (1 - 2 * y / height) * view.half_extent[1];
  const along = (k, a, b, c) => a * view.camera_right[k] + b * view.camera_up[k] + c * view.camera_forward[k];
  const orthographic = view.camera_kind === 1;
  const origin = [0, 1, 2].map((k) => view.camera_origin[k] + (orthographic ? along(k, sx, sy, 0) : 0));
  const toward = [0, 1, 2].map((k) => orthographic ? view.camera_forward[k] : along(k, sx, sy, 1));
  const length2 = Math.hypot(...toward);
  const direction2 = toward.map((d) => d / length2);
  const parts = geometry.shown.map((index2) => {
    const { mesh } = scene.instances[index2];
    return { blas: geometry.blas[mesh], mesh: scene.meshes[mesh] };
  });
  const hit = closestHitInstances(geometry.tlas, parts, { origin, direction: direction2 });
  if (!hit) return void 0;
  const index = geometry.shown[hit.instance];
  const instance = scene.instances[index];
  const { positions, indices } = scene.meshes[instance.mesh];
  const local = [0, 1, 2].map((k) => {
    const corner2 = (c) => positions[3 * indices[3 * hit.triangle + c] + k];
    return (1 - hit.u - hit.v) * corner2(0) + hit.u * corner2(1) + hit.v * corner2(2);
  });
  const position = [0, 0, 0];
  transformPoint(instance.transform, ...local, position);
  return { instance: index, material: instance.material, position, distance: hit.t };
}

// ../../packages/renderer/src/scheduler.ts
var SMALLEST = 4096;
var Scheduler = class _Scheduler {
  #pixels;
  #capacity;
  /** Milliseconds that one submission should take at most. */
  budget;
  #paths;
  #sample = 0;
  #pixel = 0;
  constructor(options, paths = SMALLEST * 4) {
    this.#pixels = options.pixels;
    this.#capacity = options.capacity;
    this.budget = options.budgetMs;
    this.#paths = Math.min(paths, options.capacity);
  }
  /** Completed samples of every pixel. */
  get samples() {
    return this.#sample;
  }
  /** Paths the next batch may hold. */
  get paths() {
    return this.#paths;
  }
  /** A scheduler at sample 0 that remembers the GPU's speed. */
  restarted() {
    return new _Scheduler({ pixels: this.#pixels, capacity: this.#capacity, budgetMs: this.budget }, this.#paths);
  }
  /** The next piece up to `target` samples, or `undefined` when all have been given out. */
  next(target) {
    if (this.#sample >= target) return void 0;
    if (this.#pixel > 0 || this.#paths < this.#pixels) {
      const pixelOffset = this.#pixel;
      const rest = this.#pixels - pixelOffset;
      const bands = Math.ceil(rest / this.#paths);
      const pixelCount = Math.ceil(rest / bands);
      const batch2 = { pixelOffset, pixelCount, sampleOffset: this.#sample, sampleCount: 1 };
      this.#pixel += pixelCount;
      if (this.#pixel >= this.#pixels) {
        this.#pixel = 0;
        this.#sample++;
      }
      return batch2;
    }
    const sampleCount = Math.min(Math.floor(this.#paths / this.#pixels), target - this.#sample);
    const batch = { pixelOffset: 0, pixelCount: this.#pixels, sampleOffset: this.#sample, sampleCount };
    this.#sample += sampleCount;
    return batch;
  }
  /** Learns from the time a batch took on the GPU. */
  measured(batch, milliseconds) {
    const paths = batch.pixelCount * batch.sampleCount;
    if (milliseconds > this.budget * 1.5) {
      const factor = Math.max(0.25, 0.8 * this.budget / milliseconds);
      this.#paths = Math.min(this.#capacity, Math.max(SMALLEST, Math.min(this.#paths, Math.floor(paths * factor))));
    } else if (milliseconds < this.budget * 0.7 && paths * 1.5 >= this.#paths) {
      this.#paths = Math.min(this.#capacity, Math.floor(this.#paths * (milliseconds < this.budget * 0.25 ? 4 : 1.5)));
    }
  }
};

// ../../packages/renderer/src/path-tracer.ts
var QUEUE_WORDS = 8;
var FEATURE_SAMPLES = 64;
var PathTracer = class _PathTracer {
  #device;
  #memory;
  #scene;
  #geometry;
  #gpuScene;
  #cache;
  #options;
  #capacity;
  #buffers;
  #groups = /* @__PURE__ */ new Map();
  #kernels;
  #film;
  #camera;
  #scheduler;
  #generation = 0;
  #rendering = false;
  #destroyed = false;
  #failure;
  #featureSamples = 0;
  #statistics;
  #frameDirty = true;
  constructor(device, memory2, scene, geometry, gpuScene, cache, kernels, options, statistics) {
    this.#device = device;
    this.#memory = memory2;
    this.#scene = scene;
    this.#geometry = geometry;
    this.#gpuScene = gpuScene;
    this.#cache = cache;
    this.#kernels = kernels;
    this.#options = options;
    this.#statistics = statistics;
    this.#camera = resolveCamera(scene, options.camera, options.width / options.height);
    const limit = device.limits.maxStorageBufferBindingSize;
    const wanted = options.pathsInFlight ?? Math.min(1 << 20, Math.max(1 << 16, options.width * options.height * 4));
    this.#capacity = Math.max(64, Math.min(wanted, Math.floor(limit / pathStruct.size), 65535 * 64));
    this.#buffers = {
      frame: memory2.buffer("frame", frameStruct.size, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      batch: memory2.buffer("batch", batchStruct.size, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      paths: memory2.buffer("paths", this.#capacity * pathStruct.size, GPU_BUFFER_STORAGE),
      queues: memory2.buffer("queues", (QUEUE_WORDS + 2 * this.#capacity) * 4, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC),
      shadows: memory2.buffer("shadows", (kernels.features.flags.NEXT_EVENT ? this.#capacity : 1) * shadowStruct.size, GPU_BUFFER_STORAGE),
      dispatch: memory2.buffer("dispatch", 32, GPU_BUFFER_STORAGE | GPU_BUFFER_INDIRECT)
    };
    this.#film = new Film(memory2, options.width, options.height);
    void device.lost.then((info) => {
      if (!this.#destroyed) this.#failure ??= new DeviceError("renderer/device-lost", `The GPU device was lost (${info.reason}): ${info.message || "no details"}. The scene is safe: request a new device and create the tracer again.`);
    });
  }
  /**
   * Prepares a scene: builds its hierarchies, uploads it and compiles its kernels.
   *
   * @param device From `requestDevice()`, or any device; it stays the caller's to destroy.
   * @param scene Not changed; edits go through the tracer's methods.
   * @throws {RenderError} `renderer/size`, `renderer/camera`, `renderer/no-triangles`
   * @throws {SceneError} if the scene's parts do not fit together
   * @throws {DeviceError} `renderer/limit`, `renderer/out-of-memory`, `renderer/gpu-error`, `renderer/device-lost`
   */
  static async create(device, scene, options) {
    checkSize(options.width, options.height);
    validateScene(scene);
    const own = { ...scene, materials: scene.materials.map((material) => ({ ...material })) };
    const { signal, onProgress } = options;
    signal?.throwIfAborted();
    const t0 = performance.now();
    onProgress?.({ stage: "bvh", done: 0 });
    const geometry = await prepareGeometry(own, { signal, onProgress: (done) => onProgress?.({ stage: "bvh", done }) });
    const t1 = performance.now();
    onProgress?.({ stage: "upload", done: 0 });
    const memory2 = new GpuMemory(device);
    try {
      device.pushErrorScope("out-of-memory");
      device.pushErrorScope("validation");
      let gpuScene;
      try {
        gpuScene = new GpuScene(device, memory2, own, geometry, options.multipleScattering ?? true);
      } finally {
        await throwScopes(device);
      }
      const t2 = performance.now();
      onProgress?.({ stage: "upload", done: 1 });
      const cache = new KernelCache(device);
      const kernels = await cache.get(gpuScene.features(), (done) => onProgress?.({ stage: "compile", done }));
      signal?.throwIfAborted();
      const t3 = performance.now();
      const statistics = {
        triangles: geometry.triangleCount,
        instances: geometry.order.length,
        lights: gpuScene.lightCount,
        bvhMs: t1 - t0,
        uploadMs: t2 - t1,
        compileMs: t3 - t2,
        gpuBytes: memory2.bytes,
        badSamples: 0
      };
      device.pushErrorScope("out-of-memory");
      device.pushErrorScope("validation");
      let tracer;
      try {
        tracer = new _PathTracer(device, memory2, own, geometry, gpuScene, cache, kernels, options, statistics);
      } finally {
        await throwScopes(device);
      }
      tracer.reset();
      return tracer;
    } catch (error) {
      memory2.destroy();
      throw error;
    }
  }
  /** The tracer's own copy of the scene, with the edits made so far. Read only. */
  get scene() {
    return this.#scene;
  }
  get width() {
    return this.#film.width;
  }
  get height() {
    return this.#film.height;
  }
  get camera() {
    return this.#camera;
  }
  /** Completed samples per pixel. */
  get samples() {
    return this.#scheduler?.samples ?? 0;
  }
  /** Mean radiance and coverage: vec4f per pixel, linear, row-major, top row first. Replaced by `resize()`. */
  get beautyBuffer() {
    return this.#film.beauty;
  }
  get statistics() {
    return { ...this.#statistics, gpuBytes: this.#memory.bytes };
  }
  /**
   * Adds samples to the film until it has as many as asked for. Ends quietly when aborted by `signal` or when the film is
   * restarted by an edit; the film keeps what it has.
   *
   * @throws {RenderError} `renderer/busy` while another `render()` of this tracer runs, `renderer/destroyed`, `renderer/samples`
   * @throws {DeviceError} `renderer/device-lost`, `renderer/gpu-error`
   */
  async *render(options = {}) {
    const target = options.samples ?? 64;
    this.#check();
    if (!Number.isInteger(target) || target < 1) throw new RenderError("renderer/samples", `The number of samples must be a whole number of at least 1, not ${target}.`);
    if (this.#rendering) throw new RenderError("renderer/busy", "This tracer is already rendering: finish or abort the other render() first.");
    this.#rendering = true;
    try {
      yield* this.#run(target, options);
    } finally {
      this.#rendering = false;
    }
  }
  async *#run(target, options) {
    const generation = this.#generation;
    const start2 = performance.now();
    const scheduler = this.#scheduler ??= new Scheduler({ pixels: this.#film.pixels, capacity: this.#capacity, budgetMs: options.maxSubmitMs ?? 30 });
    scheduler.budget = options.maxSubmitMs ?? 30;
    const first = scheduler.samples;
    let reported = first;
    let lastDone = start2;
    const inFlight = [];
    const current = () => generation === this.#generation && !options.signal?.aborted && !this.#destroyed;
    for (; ; ) {
      while (inFlight.length < 2 && current()) {
        const batch = scheduler.next(target);
        if (!batch) break;
        const submitted = performance.now();
        this.#submit(batch);
        inFlight.push({ batch, after: scheduler.samples, done: this.#device.queue.onSubmittedWorkDone().then(() => performance.now() - Math.max(submitted, lastDone)) });
      }
      const oldest = inFlight.shift();
      if (!oldest) return;
      const milliseconds = await oldest.done;
      lastDone = performance.now();
      if (this.#failure) throw this.#failure;
      scheduler.measured(oldest.batch, milliseconds);
      if (!current()) {
        await Promise.all(inFlight.map(({ done }) => done));
        return;
      }
      if (oldest.after > reported) {
        reported = oldest.after;
        const elapsedMs = performance.now() - start2;
        const rate = (reported - first) / elapsedMs;
        yield { samples: reported, targetSamples: target, elapsedMs, remainingMs: rate > 0 ? (target - reported) / rate : Infinity, samplesPerSecond: rate * 1e3 };
      }
    }
  }
  async read(layer) {
    this.#check();
    const bytes = this.#film.pixels * 16;
    if (layer === "beauty") {
      const pixels = new Float32Array(await readBuffer(this.#device, this.#film.beauty, bytes));
      const counters = new Uint32Array(await readBuffer(this.#device, this.#buffers.queues, 32));
      this.#statistics = { ...this.#statistics, badSamples: counters[3] };
      return pixels;
    }
    const count = await this.#renderFeatures();
    const { albedo, normal, ids } = this.#film.features();
    if (layer === "objectId" || layer === "materialId") {
      const all = new Uint32Array(await readBuffer(this.#device, ids, bytes));
      return Uint32Array.from({ length: this.#film.pixels }, (_, i) => all[4 * i + (layer === "objectId" ? 0 : 1)]);
    }
    const sums = new Float32Array(await readBuffer(this.#device, layer === "albedo" ? albedo : normal, bytes));
    if (layer === "albedo") return sums.map((value) => value / count);
    if (layer === "normal") return sums.map((value, i) => i % 4 === 3 ? 0 : value / count);
    const coverage = new Float32Array(await readBuffer(this.#device, albedo, bytes));
    return Float32Array.from({ length: this.#film.pixels }, (_, i) => coverage[4 * i + 3] > 0 ? sums[4 * i + 3] / coverage[4 * i + 3] : 0);
  }
  /** Restarts the film. */
  reset() {
    this.#check();
    this.#generation++;
    this.#featureSamples = 0;
    this.#frameDirty = true;
    this.#scheduler = this.#scheduler?.restarted();
    const encoder = this.#device.createCommandEncoder({ label: "glanz reset" });
    this.#film.clear(encoder);
    this.#device.queue.submit([encoder.finish()]);
  }
  /** Looks through another camera: one of the scene's by index or name, or any. Restarts the film. */
  setCamera(camera2) {
    this.#camera = resolveCamera(this.#scene, camera2, this.#film.width / this.#film.height);
    this.reset();
  }
  /**
   * Changes parameters of a material and restarts the film. Where the change calls for kernels that are not there yet
   * (a lobe appears), the old ones serve until the new ones are ready.
   *
   * @returns When the picture shows the change in full.
   * @throws {RenderError} `renderer/material` if there is no such material.
   */
  async setMaterial(nameOrIndex, parameters) {
    this.#check();
    const index = findMaterial(this.#scene, nameOrIndex);
    const material = this.#scene.materials[index];
    if (!material) throw new RenderError("renderer/material", `The scene has no material ${JSON.stringify(nameOrIndex)}; it has: ${this.#scene.materials.map((m) => m.name).join(", ")}.`);
    material.parameters = { ...material.parameters, ...parameters };
    if (this.#gpuScene.updateMaterial(index)) this.#groups.clear();
    await this.#applyFeatures();
  }
  /** Replaces the surroundings and restarts the film. */
  async setEnvironment(environment2) {
    this.#check();
    if (environment2) this.#scene.environment = environment2;
    else delete this.#scene.environment;
    this.#gpuScene.updateEnvironment(environment2);
    this.#groups.clear();
    await this.#applyFeatures();
  }
  /** Changes the film's size and restarts it. */
  resize(width, height) {
    this.#check();
    checkSize(width, height);
    if (width === this.#film.width && height === this.#film.height) return;
    this.#film.destroy();
    this.#film = new Film(this.#memory, width, height);
    this.#scheduler = void 0;
    this.#groups.clear();
    this.reset();
  }
  /** What lies under a pixel (whole or fractional coordinates from the upper left corner), found on the CPU. */
  pick(x, y) {
    this.#check();
    return pickPixel(this.#scene, this.#geometry, this.#camera, this.#film.width, this.#film.height, x, y);
  }
  /** Frees all GPU memory. Idempotent; a running `render()` ends. */
  destroy() {
    if (this.#destroyed) return;
    this.#destroyed = true;
    this.#generation++;
    this.#memory.destroy();
  }
  async #applyFeatures() {
    this.reset();
    const features = this.#gpuScene.features();
    const generation = this.#generation;
    const kernels = await this.#cache.get(features);
    if (this.#destroyed || kernels === this.#kernels || generation !== this.#generation) return;
    this.#use(kernels, features);
    this.reset();
  }
  #use(kernels, features) {
    this.#kernels = kernels;
    this.#groups.clear();
    const bytes = this.#capacity * shadowStruct.size;
    if (features.flags.NEXT_EVENT && this.#buffers.shadows.size < bytes) {
      this.#memory.release(this.#buffers.shadows);
      this.#buffers.shadows = this.#memory.buffer("shadows", bytes, GPU_BUFFER_STORAGE);
    }
  }
  #check() {
    if (this.#destroyed) throw new RenderError("renderer/destroyed", "This tracer has been destroyed.");
    if (this.#failure) throw this.#failure;
  }
  #group(name, kernel) {
    let group = this.#groups.get(name);
    if (!group) {
      const film = { film_block: this.#film.block, film_total: this.#film.total, beauty: this.#film.beauty };
      if (name === "features") {
        const { albedo, normal, ids } = this.#film.features();
        Object.assign(film, { feature_albedo: albedo, feature_normal: normal, feature_ids: ids });
      }
      const names = [...kernel.resources, ...kernel.sceneBindings.map(([binding]) => binding)];
      const entries = names.map((resource, binding) => {
        const own = this.#buffers[resource] ?? film[resource];
        const found = own ? { buffer: own } : this.#gpuScene.resource(resource);
        if (!found) throw new DeviceError("renderer/gpu-error", `Kernel "${name}" wants "${resource}", which nothing provides.`);
        return { binding, resource: found };
      });
      group = this.#device.createBindGroup({ label: `glanz ${name}`, layout: kernel.layout, entries });
      this.#groups.set(name, group);
    }
    return group;
  }
  #writeBatch(batch) {
    const data = batchStruct.allocate();
    batchStruct.write(data, 0, { pixel_offset: batch.pixelOffset, pixel_count: batch.pixelCount, sample_offset: batch.sampleOffset, sample_count: batch.sampleCount });
    this.#memory.write(this.#buffers.batch, data);
    if (this.#frameDirty) {
      this.#memory.write(this.#buffers.frame, packFrame(this.#camera, this.#film, this.#gpuScene, this.#geometry, this.#options));
      this.#frameDirty = false;
    }
  }
  #submit(batch) {
    this.#writeBatch(batch);
    const { kernels, features } = this.#kernels;
    const encoder = this.#device.createCommandEncoder({ label: "glanz batch" });
    const pass = encoder.beginComputePass({ label: "glanz batch" });
    const paths = batch.pixelCount * batch.sampleCount;
    const run = (name, work) => {
      const kernel = kernels[name];
      pass.setPipeline(kernel.pipeline);
      pass.setBindGroup(0, this.#group(name, kernel));
      if (typeof work === "number") pass.dispatchWorkgroups(work);
      else pass.dispatchWorkgroupsIndirect(this.#buffers.dispatch, work.indirect);
    };
    run("begin", 1);
    run("generate", Math.ceil(paths / 64));
    const depth = this.#options.maxDepth ?? 8;
    for (let edge = 1; edge <= depth; edge++) {
      run("intersect", { indirect: 0 });
      run("shade", { indirect: 0 });
      if (edge === depth) break;
      run("advance", 1);
      if (features.flags.NEXT_EVENT) run("connect", { indirect: 16 });
    }
    run("resolve", Math.ceil(batch.pixelCount / 64));
    pass.end();
    this.#device.queue.submit([encoder.finish()]);
  }
  async #renderFeatures() {
    const target = Math.min(FEATURE_SAMPLES, Math.max(1, this.samples));
    if (this.#featureSamples >= target) return this.#featureSamples;
    const kernel = await this.#cache.kernel("features", this.#kernels.features);
    this.#check();
    const group = this.#group("features", kernel);
    const band = Math.min(this.#film.pixels, 65535 * 64);
    for (let sample = 0; sample < target; sample++) {
      for (let pixel = 0; pixel < this.#film.pixels; pixel += band) {
        const count = Math.min(band, this.#film.pixels - pixel);
        this.#writeBatch({ pixelOffset: pixel, pixelCount: count, sampleOffset: sample, sampleCount: 1 });
        const encoder = this.#device.createCommandEncoder({ label: "glanz features" });
        const pass = encoder.beginComputePass({ label: "glanz features" });
        pass.setPipeline(kernel.pipeline);
        pass.setBindGroup(0, group);
        pass.dispatchWorkgroups(Math.ceil(count / 64));
        pass.end();
        this.#device.queue.submit([encoder.finish()]);
      }
      if (sample % 4 === 3) await this.#device.queue.onSubmittedWorkDone();
    }
    this.#featureSamples = target;
    return target;
  }
};
function checkSize(width, height) {
  if (!Number.isInteger(width) || !Number.isInteger(height) || width < 1 || height < 1) {
    throw new RenderError("renderer/size", `A picture of ${width} \xD7 ${height} pixels cannot be rendered: both must be whole numbers of at least 1.`);
  }
}
function resolveCamera(scene, camera2, aspect) {
  if (typeof camera2 === "object") return camera2;
  if (camera2 === void 0) return scene.cameras[0] ?? frameCamera(scene, { aspect });
  const found = typeof camera2 === "number" ? scene.cameras[camera2] : scene.cameras.find(({ name }) => name === camera2);
  if (!found) throw new RenderError("renderer/camera", `The scene has no camera ${JSON.stringify(camera2)}; it has: ${scene.cameras.map(({ name }) => name).join(", ") || "none"}.`);
  return found;
}
async function throwScopes(device) {
  const validation = await device.popErrorScope();
  const memory2 = await device.popErrorScope();
  if (memory2) throw new DeviceError("renderer/out-of-memory", `The GPU has not enough memory for this scene: ${memory2.message}`);
  if (validation) throw new DeviceError("renderer/gpu-error", `The GPU refused the scene: ${validation.message}`);
}

// ../../packages/renderer/src/node/adapter-info.ts
var CPU_NAMES = /swiftshader|llvmpipe|lavapipe|basic render|warp/i;
function isSoftware(info) {
  return info.isFallbackAdapter === true || CPU_NAMES.test(`${info.architecture} ${info.device} ${info.description}`);
}
function lavapipeVersion(info) {
  if (!/llvmpipe|lavapipe/i.test(`${info.device} ${info.description}`)) return void 0;
  const version = /mesa (\d+)\./i.exec(info.description)?.[1];
  return version === void 0 ? void 0 : Number(version);
}
var LISTED = /backend: '([^']*)', name: '(.*)'$/;
function parseAdapterList(message) {
  const found = /* @__PURE__ */ new Map();
  for (const line of message.split("\n")) {
    const match = LISTED.exec(line.trim());
    if (match) found.set(`${match[1]}/${match[2]}`, { backend: match[1], name: match[2] });
  }
  return [...found.values()];
}

// ../../packages/renderer/src/node/dawn.ts
import { isAbsolute } from "node:path";
import { pathToFileURL } from "node:url";
var NOBODY = "glanz-lists-adapters";
async function loadDawn() {
  const override = process.env["GPU_WEBGPU"];
  try {
    if (!override) return withGlobals(await import("webgpu"));
    const specifier = isAbsolute(override) ? pathToFileURL(override).href : override;
    return withGlobals(await import(
      /* @vite-ignore */
      specifier
    ));
  } catch (cause) {
    const what = override ? `GPU_WEBGPU points to "${override}", which does not load` : 'the package "webgpu" (Dawn for Node) is not installed or does not load: run `npm install webgpu`';
    throw new DeviceError("renderer/no-webgpu", `WebGPU in Node: ${what} (${firstLine(cause)}).`, { cause });
  }
}
function withGlobals(dawn) {
  for (const [name, value] of Object.entries(dawn.globals)) {
    if (!(name in globalThis)) Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });
  }
  return dawn;
}
function firstLine(error) {
  return String(error?.message ?? error).split("\n", 1)[0].trim();
}
var PINNED = Symbol.for("glanz.dawn");
function createPinned(dawn, options) {
  const gpu = dawn.create([...options]);
  const holder = globalThis;
  (holder[PINNED] ??= []).push(gpu);
  return gpu;
}
async function listAdapters(dawn) {
  try {
    await createPinned(dawn, [`adapter=${NOBODY}`]).requestAdapter();
    return [];
  } catch (error) {
    return parseAdapterList(String(error.message));
  }
}

// ../../packages/renderer/src/node/swiftshader.ts
import { existsSync, mkdirSync, mkdtempSync, readFileSync, renameSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { homedir, tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { brotliDecompressSync } from "node:zlib";

// ../../packages/renderer/src/node/tar.ts
var BLOCK = 512;
function readTar(bytes) {
  const text = (from, length2) => {
    const field = bytes.subarray(from, from + length2);
    const end = field.indexOf(0);
    return new TextDecoder().decode(end < 0 ? field : field.subarray(0, end));
  };
  const entries = [];
  for (let at = 0; at + BLOCK <= bytes.length; ) {
    const name = text(at, 100);
    if (name === "") break;
    const size = Number.parseInt(text(at + 124, 12).trim(), 8);
    const type = bytes[at + 156];
    const start2 = at + BLOCK;
    if (!Number.isFinite(size) || start2 + size > bytes.length) throw new RangeError(`tar: entry "${name}" is cut short`);
    if (type === 0 || type === 48) entries.push({ name: name.replace(/^\.\//, ""), data: bytes.subarray(start2, start2 + size) });
    at = start2 + Math.ceil(size / BLOCK) * BLOCK;
  }
  return entries;
}

// ../../packages/renderer/src/node/swiftshader.ts
var PACKAGE = "@sparticuz/chromium";
var ICD = "vk_swiftshader_icd.json";
var DRIVER = "libvk_swiftshader.so";
var LOADER = "libvulkan.so.1";
function packageFolder() {
  for (const from of [import.meta.url, join(process.cwd(), "package.json")]) {
    try {
      let folder = dirname(createRequire(from).resolve(PACKAGE));
      while (!existsSync(join(folder, "bin", "swiftshader.tar.br"))) {
        const parent = dirname(folder);
        if (parent === folder || basename(folder) === "node_modules") return void 0;
        folder = parent;
      }
      return folder;
    } catch {
    }
  }
  return void 0;
}
var complete = (folder) => [ICD, DRIVER, LOADER].every((file) => existsSync(join(folder, file)));
function isOwn(folder) {
  const uid = process.getuid?.();
  const status = statSync(folder);
  return uid === void 0 || status.uid === uid && (status.mode & 18) === 0;
}
function cacheFolders(version) {
  const caches = [process.env["XDG_CACHE_HOME"], join(homedir(), ".cache"), join(tmpdir(), `glanz-${process.getuid?.() ?? "cache"}`)];
  return caches.filter((folder) => !!folder && folder.startsWith("/")).map((folder) => join(folder, "glanz", `swiftshader-${version}`));
}
function inflate(archive, target) {
  const parent = dirname(target);
  mkdirSync(parent, { recursive: true, mode: 448 });
  const work = mkdtempSync(join(parent, "inflating-"));
  try {
    for (const entry2 of readTar(brotliDecompressSync(readFileSync(archive)))) {
      const name = basename(entry2.name);
      if (name === ICD || name === DRIVER || name === LOADER) writeFileSync(join(work, name), entry2.data, { mode: 448 });
    }
    if (!complete(work)) throw new Error(`${archive} lacks ${ICD}, ${DRIVER} or ${LOADER}`);
    if (existsSync(target) && !complete(target)) rmSync(target, { recursive: true, force: true });
    try {
      renameSync(work, target);
    } catch (error) {
      if (!complete(target)) throw error;
    }
  } finally {
    rmSync(work, { recursive: true, force: true });
  }
}
function packagedSwiftShader() {
  if (process.platform !== "linux" || process.arch !== "x64") return `${PACKAGE} serves Linux x64 only`;
  const folder = packageFolder();
  if (!folder) return `${PACKAGE} is not installed`;
  const version = JSON.parse(readFileSync(join(folder, "package.json"), "utf8")).version ?? "unknown";
  let reason = "";
  for (const cache of cacheFolders(version)) {
    try {
      if (!existsSync(cache) || !complete(cache)) inflate(join(folder, "bin", "swiftshader.tar.br"), cache);
      if (!isOwn(cache)) throw new Error(`${cache} belongs to, or can be written by, another user`);
      return { name: `SwiftShader of ${PACKAGE}`, icd: join(cache, ICD), loader: join(cache, LOADER) };
    } catch (error) {
      reason = error.message;
    }
  }
  return `${PACKAGE} cannot be inflated: ${reason}`;
}

// ../../packages/renderer/src/node/vulkan-driver.ts
import { existsSync as existsSync2, readdirSync } from "node:fs";
import { homedir as homedir2, constants } from "node:os";
import { dirname as dirname2, join as join2 } from "node:path";
import { isMainThread } from "node:worker_threads";
var VARIABLES = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"];
function driverEnvironment() {
  return { VK_DRIVER_FILES: process.env["VK_DRIVER_FILES"], VK_ICD_FILENAMES: process.env["VK_ICD_FILENAMES"] };
}
function restoreDriverEnvironment(environment2) {
  for (const name of VARIABLES) {
    if (environment2[name] === void 0) delete process.env[name];
    else process.env[name] = environment2[name];
  }
}
function canSwitchDrivers() {
  return isMainThread && process.platform === "linux";
}
var RTLD_NODELETE = 4096;
function switchToDriver(driver) {
  for (const name of VARIABLES) process.env[name] = driver.icd;
  if (!driver.loader || !existsSync2(driver.loader)) return;
  try {
    process.dlopen({ exports: {} }, driver.loader, constants.dlopen.RTLD_NOW | constants.dlopen.RTLD_GLOBAL | RTLD_NODELETE);
  } catch {
  }
}
var list = (folder) => {
  try {
    return readdirSync(folder).sort();
  } catch {
    return [];
  }
};
function installedLavapipe() {
  for (const folder of ["/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d"]) {
    const file = list(folder).find((name) => /^lvp_icd.*\.json$/.test(name));
    if (file) return { name: "lavapipe", icd: join2(folder, file) };
  }
  return void 0;
}
function chromiumSwiftShaders() {
  const playwright = process.env["PLAYWRIGHT_BROWSERS_PATH"] ?? join2(homedir2(), ".cache", "ms-playwright");
  const folders = [
    "/usr/lib/chromium",
    "/usr/lib/chromium-browser",
    "/usr/lib64/chromium-browser",
    "/opt/google/chrome",
    "/opt/chromium.org/chromium",
    "/snap/chromium/current/usr/lib/chromium-browser",
    ...list(playwright).filter((name) => name.startsWith("chromium")).flatMap((name) => list(join2(playwright, name)).map((inner2) => join2(playwright, name, inner2)))
  ];
  return folders.map((folder) => join2(folder, "vk_swiftshader_icd.json")).filter((icd) => existsSync2(icd)).map((icd) => ({ name: `SwiftShader of ${dirname2(icd)}`, icd, loader: join2(dirname2(icd), "libvulkan.so.1") }));
}

// ../../packages/renderer/src/node/create-gpu.ts
var OLDEST_LAVAPIPE = 25;
function* sources(options, user) {
  const userChose = user.VK_DRIVER_FILES !== void 0 || user.VK_ICD_FILENAMES !== void 0;
  yield { what: userChose ? "the driver in VK_DRIVER_FILES" : "installed drivers", driver: void 0 };
  if (options.software === "never" || process.platform !== "linux") return;
  if (!canSwitchDrivers()) {
    yield { what: "software drivers", driver: "can be loaded from the main thread only" };
    return;
  }
  yield { what: "lavapipe", driver: installedLavapipe() ?? "not installed" };
  const browsers = chromiumSwiftShaders();
  for (const driver of browsers) yield { what: driver.name, driver };
  if (browsers.length === 0) yield { what: "Chromium's SwiftShader", driver: "no Chromium installed" };
  yield { what: "SwiftShader from npm", driver: packagedSwiftShader() };
}
var adapterName = (info) => (isSoftware(info) ? info.description || info.device : info.device || info.description) || info.vendor || "unnamed GPU";
function objection(info, options) {
  const software = isSoftware(info);
  const name = adapterName(info);
  if (software && options.software === "never") return `"${name}" is a software GPU`;
  if (!software && options.software === "only") return `"${name}" is not a software GPU`;
  const mesa = lavapipeVersion(info);
  if (mesa !== void 0 && mesa < OLDEST_LAVAPIPE) return `"${name}" is older than Mesa ${OLDEST_LAVAPIPE}`;
  return void 0;
}
async function tryDrivers(dawn, options) {
  const wanted = options.gpu?.toLowerCase();
  let names = [void 0];
  if (wanted !== void 0 || options.software === "only") {
    const listed = await listAdapters(dawn);
    if (listed.length === 0) return "no adapter";
    names = listed.filter((adapter) => wanted === void 0 || adapter.name.toLowerCase().includes(wanted)).map((adapter) => adapter.name);
    if (names.length === 0) return `only ${listed.map((adapter) => `"${adapter.name}"`).join(", ")}`;
  }
  let reason = "no adapter";
  for (const name of names) {
    try {
      const gpu = createPinned(dawn, name === void 0 ? [] : [`adapter=${name}`]);
      const adapter = await gpu.requestAdapter({ powerPreference: "high-performance" });
      if (!adapter) continue;
      const fault = objection(adapter.info, options);
      if (fault === void 0) return { gpu, adapterName: name ?? adapterName(adapter.info), software: isSoftware(adapter.info) };
      reason = fault;
    } catch (error) {
      reason = firstLine(error);
    }
  }
  return reason;
}
var FOUND = Symbol.for("glanz.gpu");
function memory() {
  const holder = globalThis;
  return holder[FOUND] ??= { user: driverEnvironment(), found: /* @__PURE__ */ new Map() };
}
async function search2(options, user) {
  const dawn = await loadDawn();
  restoreDriverEnvironment(user);
  const tried = [];
  for (const { what, driver } of sources(options, user)) {
    if (typeof driver === "string") {
      tried.push(`${what}: ${driver}`);
      continue;
    }
    if (driver) switchToDriver(driver);
    const result = await tryDrivers(dawn, options);
    if (typeof result !== "string") return result;
    tried.push(`${what}: ${result}`);
  }
  restoreDriverEnvironment(user);
  const wish = options.gpu === void 0 ? options.software === "only" ? "software GPU" : "usable GPU" : `GPU called "${options.gpu}"`;
  const advice = options.gpu !== void 0 ? "give a part of a listed name" : options.software === "never" ? "install the GPU\u2019s Vulkan driver, or allow a software GPU" : "install a Vulkan driver, or `npm install @sparticuz/chromium` (Linux x64) or Mesa \u2265 25 (package mesa-vulkan-drivers) for a software GPU";
  throw new DeviceError("renderer/no-adapter", `No ${wish} found (${tried.join("; ")}): ${advice}.`);
}
function createGpu(options = {}) {
  const { user, found } = memory();
  const key = JSON.stringify([options.gpu ?? null, options.software ?? "auto"]);
  let result = found.get(key);
  if (!result) {
    const before = [...found.values()];
    result = Promise.allSettled(before).then(() => search2(options, user));
    found.set(key, result);
    result.catch(() => found.delete(key));
  }
  return result;
}

// ../../packages/scene/src/studio.ts
var BOXES = [
  { azimuth: -50, elevation: 38, halfWidth: 0.42, halfHeight: 0.5, radiance: 4.6 },
  { azimuth: 65, elevation: 22, halfWidth: 0.55, halfHeight: 0.5, radiance: 0.9 },
  { azimuth: 0, elevation: 88, halfWidth: 0.7, halfHeight: 0.5, radiance: 0.5 },
  { azimuth: 150, elevation: 42, halfWidth: 0.14, halfHeight: 0.5, radiance: 3 },
  { azimuth: -145, elevation: 42, halfWidth: 0.14, halfHeight: 0.5, radiance: 2.4 }
];
var smooth = (low, high, x) => {
  const t = Math.min(Math.max((x - low) / (high - low), 0), 1);
  return t * t * (3 - 2 * t);
};
function backdrop(y) {
  return y >= 0 ? 0.5 - 0.25 * smooth(0, 0.9, y) : 0.5 - 0.2 * smooth(0, 1, -y);
}
function place2(box2) {
  const a = box2.azimuth * Math.PI / 180;
  const e = box2.elevation * Math.PI / 180;
  return {
    ...box2,
    normal: [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)],
    right: [Math.cos(a), 0, -Math.sin(a)],
    up: [-Math.sin(a) * Math.sin(e), Math.cos(e), -Math.cos(a) * Math.sin(e)]
  };
}
var dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
function boxRadiance(box2, d, blur) {
  const depth = dot3(d, box2.normal);
  if (depth <= 0.05) return 0;
  const u = Math.abs(dot3(d, box2.right)) / depth / box2.halfWidth;
  const v = Math.abs(dot3(d, box2.up)) / depth / box2.halfHeight;
  if (u > 1 + blur / box2.halfWidth || v > 1 + blur / box2.halfHeight) return 0;
  const edge = (x, half) => 1 - smooth(1 - blur / half, 1 + blur / half, x);
  return box2.radiance * edge(u, box2.halfWidth) * edge(v, box2.halfHeight) * (1 - 0.25 * Math.min(u * u + v * v, 1));
}
function studioEnvironment(options = {}) {
  const width = Math.max(16, Math.round((options.width ?? 512) / 2) * 2);
  const height = width / 2;
  const boxes = BOXES.map(place2);
  const blur = Math.max(0.03, 2 * Math.PI / width);
  const data = new Float32Array(width * height * 3);
  for (let j = 0; j < height; j++) {
    const theta = (j + 0.5) / height * Math.PI;
    const sin = Math.sin(theta);
    const y = Math.cos(theta);
    for (let i = 0; i < width; i++) {
      const phi = ((i + 0.5) / width - 0.5) * 2 * Math.PI;
      const d = [sin * Math.cos(phi), y, sin * Math.sin(phi)];
      let radiance = backdrop(y);
      for (const box2 of boxes) radiance += boxRadiance(box2, d, blur);
      data.fill(radiance, (j * width + i) * 3, (j * width + i) * 3 + 3);
    }
  }
  return {
    type: "latlong",
    width,
    height,
    data,
    ...options.intensity === void 0 ? {} : { intensity: options.intensity },
    ...options.rotation === void 0 ? {} : { rotation: options.rotation },
    ...options.visible === void 0 ? {} : { visible: options.visible }
  };
}

// ../../packages/tonemap/src/names.ts
var TONE_MAPS = ["neutral", "aces", "agx", "reinhard", "linear"];
var ToneMapError = class extends GlanzError {
};

// ../../packages/tonemap/src/finite.ts
var TONEMAP_MAX = 1048576;
var tonemapFinite = wgslModule(
  "tonemap/finite",
  /* wgsl */
  `fn tonemap_finite(v: vec3f) -> vec3f {
  let bits = bitcast<vec3u>(v);
  let magnitude = bits & vec3u(0x7fffffffu);
  let zero = (magnitude > vec3u(0x7f800000u)) | (bits > vec3u(0x7fffffffu));
  let big = magnitude > vec3u(${(127 + 20) * 2 ** 23}u);
  return select(select(v, vec3f(${TONEMAP_MAX}.0), big), vec3f(0.0), zero);
}`
);
function mapRgb(rgb, f) {
  return rgb.map(f);
}
function finite2(rgb) {
  return mapRgb(rgb, (v) => v > 0 ? Math.min(v, TONEMAP_MAX) : 0);
}
function saturate(v) {
  return Math.min(Math.max(v, 0), 1);
}

// ../../packages/tonemap/src/matrix.ts
function transform(m, [x, y, z]) {
  return [m[0] * x + m[3] * y + m[6] * z, m[1] * x + m[4] * y + m[7] * z, m[2] * x + m[5] * y + m[8] * z];
}
function wgslMatrix(m) {
  return `mat3x3f(${m.join(", ")})`;
}

// ../../packages/tonemap/src/aces.ts
var INPUT = [0.59719, 0.076, 0.0284, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777];
var OUTPUT = [1.60475, -0.10208, -327e-5, -0.53108, 1.10813, -0.07276, -0.07367, -605e-5, 1.07602];
var tonemapAces = wgslModule(
  "tonemap/aces",
  /* wgsl */
  `fn tonemap_aces(linear: vec3f) -> vec3f {
  let v = ${wgslMatrix(INPUT)} * tonemap_finite(linear);
  let fit = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.432951) + 0.238081);
  return clamp(${wgslMatrix(OUTPUT)} * fit, vec3f(0.0), vec3f(1.0));
}`,
  [tonemapFinite]
);
var fit = (v) => (v * (v + 0.0245786) - 90537e-9) / (v * (0.983729 * v + 0.432951) + 0.238081);
function acesToneMap(rgb) {
  return mapRgb(transform(OUTPUT, mapRgb(transform(INPUT, finite2(rgb)), fit)), saturate);
}

// ../../packages/tonemap/src/agx.ts
var INSET = [0.842479062, 0.042328242, 0.042375655, 0.0784336, 0.878468636, 0.0784336, 0.079223745, 0.079166127, 0.879142974];
var OUTSET = [1.196879005, -0.052896852, -0.052971636, -0.098020881, 1.15190313, -0.09804345, -0.099029744, -0.098961177, 1.151073673];
var BELOW = 10;
var ABOVE = 6.5;
var LOWEST = Math.log2(0.18) - BELOW;
var PIVOT = BELOW / (BELOW + ABOVE);
var TOE_POWER = 3;
var SHOULDER_POWER = 3.25;
var bend = (length2, power) => ((4 * length2) ** power - 1) / length2 ** power;
var TOE = bend(PIVOT, TOE_POWER);
var SHOULDER = bend(1 - PIVOT, SHOULDER_POWER);
var DISPLAY_POWER = 2.2;
var tonemapAgx = wgslModule(
  "tonemap/agx",
  /* wgsl */
  `fn tonemap_agx(linear: vec3f) -> vec3f {
  let inset = ${wgslMatrix(INSET)} * tonemap_finite(linear);
  let x = clamp((log2(max(inset, vec3f(1e-10))) - ${LOWEST}) * ${1 / (BELOW + ABOVE)}, vec3f(0.0), vec3f(1.0)) - ${PIVOT};
  let a = abs(x);
  let toe = pow(1.0 + ${TOE} * a * a * a, vec3f(${-1 / TOE_POWER}));
  let shoulder = pow(1.0 + ${SHOULDER} * pow(a, vec3f(${SHOULDER_POWER})), vec3f(${-1 / SHOULDER_POWER}));
  let code = 0.5 + 2.0 * x * select(toe, shoulder, x > vec3f(0.0));
  return pow(clamp(${wgslMatrix(OUTSET)} * code, vec3f(0.0), vec3f(1.0)), vec3f(${DISPLAY_POWER}));
}`,
  [tonemapFinite]
);
function sigmoid(value) {
  const x = saturate((Math.log2(Math.max(value, 1e-10)) - LOWEST) / (BELOW + ABOVE)) - PIVOT;
  if (x <= 0) return 0.5 + 2 * x * (1 + TOE * (-x) ** TOE_POWER) ** (-1 / TOE_POWER);
  return 0.5 + 2 * x * (1 + SHOULDER * x ** SHOULDER_POWER) ** (-1 / SHOULDER_POWER);
}
function agxToneMap(rgb) {
  return mapRgb(transform(OUTSET, mapRgb(transform(INSET, finite2(rgb)), sigmoid)), (code) => saturate(code) ** DISPLAY_POWER);
}

// ../../packages/tonemap/src/linear.ts
var tonemapLinear = wgslModule(
  "tonemap/linear",
  /* wgsl */
  `fn tonemap_linear(linear: vec3f) -> vec3f {
  return min(tonemap_finite(linear), vec3f(1.0));
}`,
  [tonemapFinite]
);
function linearToneMap(rgb) {
  return mapRgb(finite2(rgb), saturate);
}

// ../../packages/tonemap/src/neutral.ts
var F90 = 0.04;
var START = 0.8 - F90;
var DESATURATION = 0.15;
var tonemapNeutral = wgslModule(
  "tonemap/neutral",
  /* wgsl */
  `fn tonemap_neutral(linear: vec3f) -> vec3f {
  let c = tonemap_finite(linear);
  let x = min(c.r, min(c.g, c.b));
  let base = c - select(${F90}, x - x * x * ${1 / (4 * F90)}, x <= ${2 * F90});
  let peak = max(base.r, max(base.g, base.b));
  if (peak <= ${START}) { return base; }
  let compressed = 1.0 - ${(1 - START) ** 2} / (peak + ${1 - 2 * START});
  let keep = 1.0 / (${DESATURATION} * (peak - compressed) + 1.0);
  return mix(vec3f(compressed), base * (compressed / peak), keep);
}`,
  [tonemapFinite]
);
function neutralToneMap(rgb) {
  const c = finite2(rgb);
  const x = Math.min(...c);
  const offset = x <= 2 * F90 ? x - x * x / (4 * F90) : F90;
  const peak = Math.max(...c) - offset;
  if (peak <= START) return mapRgb(c, (v) => v - offset);
  const compressed = 1 - (1 - START) ** 2 / (peak + 1 - 2 * START);
  const keep = 1 / (DESATURATION * (peak - compressed) + 1);
  return mapRgb(c, (v) => compressed + ((v - offset) / peak - 1) * compressed * keep);
}

// ../../packages/tonemap/src/reinhard.ts
var REINHARD_WHITE = 4;
var tonemapReinhard = wgslModule(
  "tonemap/reinhard",
  /* wgsl */
  `fn tonemap_reinhard(linear: vec3f) -> vec3f {
  let c = tonemap_finite(linear);
  let l = dot(c, vec3f(0.2126, 0.7152, 0.0722));
  return min(c * ((1.0 + l * ${1 / REINHARD_WHITE ** 2}) / (1.0 + l)), vec3f(1.0));
}`,
  [tonemapFinite]
);
function reinhardToneMap(rgb) {
  const c = finite2(rgb);
  const l = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  const scale = (1 + l / REINHARD_WHITE ** 2) / (1 + l);
  return mapRgb(c, (v) => Math.min(v * scale, 1));
}

// ../../packages/tonemap/src/operators.ts
var OPERATORS = {
  neutral: { wgsl: tonemapNeutral, map: neutralToneMap },
  aces: { wgsl: tonemapAces, map: acesToneMap },
  agx: { wgsl: tonemapAgx, map: agxToneMap },
  reinhard: { wgsl: tonemapReinhard, map: reinhardToneMap },
  linear: { wgsl: tonemapLinear, map: linearToneMap }
};
function toneMapOperator(name) {
  if (!Object.hasOwn(OPERATORS, name)) throw new ToneMapError("tonemap/unknown", `There is no tone map "${String(name)}". Known: ${TONE_MAPS.join(", ")}.`);
  return OPERATORS[name];
}

// ../../packages/tonemap/src/srgb.ts
var tonemapSrgb = wgslModule(
  "tonemap/srgb",
  /* wgsl */
  `fn tonemap_srgb_encode(linear: vec3f) -> vec3f {
  let c = clamp(linear, vec3f(0.0), vec3f(1.0));
  return select(1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055, 12.92 * c, c <= vec3f(0.0031308));
}`
);
function srgbEncode(linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 31308e-7 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
}

// ../../packages/tonemap/src/tone-map.ts
function toneMapPixels(rgba, width, height, options = {}) {
  const count = width * height;
  if (!Number.isInteger(width) || !Number.isInteger(height) || rgba.length !== count * 4) {
    throw new ToneMapError("tonemap/size", `${width}\xD7${height} RGBA pixels need ${count * 4} floats, but ${rgba.length} were given.`);
  }
  const output = options.output ?? "uint8";
  const { map } = toneMapOperator(options.toneMap ?? "neutral");
  const exposure = 2 ** (options.exposure ?? 0);
  const straight = (options.alpha ?? "straight") === "straight";
  const out = output === "uint8" ? new Uint8ClampedArray(count * 4) : output === "uint16" ? new Uint16Array(count * 4) : new Float32Array(count * 4);
  const [top, round] = output === "uint8" ? [255, 0.5] : output === "uint16" ? [65535, 0.5] : [1, 0];
  const store = round === 0 ? (v) => v : (v) => Math.floor(v * top + round);
  for (let i = 0; i < out.length; i += 4) {
    const coverage = rgba[i + 3];
    const alpha = straight ? coverage > 0 ? Math.min(coverage, 1) : 0 : 1;
    const scale = alpha > 0 ? exposure / alpha : 0;
    const [r, g, b] = map([rgba[i] * scale, rgba[i + 1] * scale, rgba[i + 2] * scale]);
    out[i] = store(srgbEncode(r));
    out[i + 1] = store(srgbEncode(g));
    out[i + 2] = store(srgbEncode(b));
    out[i + 3] = store(alpha);
  }
  return out;
}

// src/hero.ts
async function renderHero(options) {
  const [width, height] = [1120, 1040];
  const device = await requestDevice({ gpu: (await createGpu()).gpu });
  const scene = { ...createPushButton({ level: "medium" }), environment: studioEnvironment() };
  const camera2 = frameCamera(scene, { aspect: width / height, yfov: 0.44, direction: [1, 0.52, 0.86], margin: 0.02 });
  const tracer = await PathTracer.create(device, scene, { width, height, camera: camera2, background: "transparent" });
  for await (const { samples, remainingMs } of tracer.render({ samples: options.samples })) options.report(`${samples} samples, ${Math.ceil(remainingMs / 1e3)} s left`);
  const data = toneMapPixels(await tracer.read("beauty"), width, height, { toneMap: "neutral", exposure: 0.2 });
  tracer.destroy();
  device.destroy();
  return { width, height, data };
}
export {
  renderHero
};
