import * as THREE from 'three';
import { validateScene, type LatLongEnvironment, type Scene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { fromThree } from '../src/index';

const lit = async (...objects: THREE.Object3D[]): Promise<Scene> =>
  fromThree(
    new THREE.Scene().add(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()), ...objects),
  );

/** Irradiance of an environment on a surface, by summing up the texels. */
function irradiance({ width, height, data }: LatLongEnvironment, normal: THREE.Vector3, channel: number): number {
  let sum = 0;
  for (let j = 0; j < height; j++) {
    const theta = ((j + 0.5) / height) * Math.PI;
    for (let i = 0; i < width; i++) {
      const phi = ((i + 0.5) / width - 0.5) * 2 * Math.PI;
      const d = new THREE.Vector3(Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi));
      sum +=
        data[3 * (j * width + i) + channel]! *
        Math.max(0, d.dot(normal)) *
        Math.sin(theta) *
        (Math.PI / height) *
        ((2 * Math.PI) / width);
    }
  }
  return sum;
}

/** The same image with more columns, to sum more exactly. */
function wider(environment: LatLongEnvironment, width: number): LatLongEnvironment {
  const { height, data } = environment;
  const out = new Float32Array(width * height * 3);
  for (let j = 0; j < height; j++)
    for (let i = 0; i < width; i++)
      out.set(data.subarray(3 * j * environment.width, 3 * j * environment.width + 3), 3 * (j * width + i));
  return { ...environment, width, data: out };
}

describe('lights', () => {
  it('with a place or a direction have their units and cones', async () => {
    const point = new THREE.PointLight(new THREE.Color(1, 0.5, 0.25), 8);
    point.position.set(1, 2, 3);
    const spot = new THREE.SpotLight(0xffffff, 5, 0, 0.6, 0.25);
    spot.position.set(0, 4, 0);
    spot.target.position.set(0, 0, 3);
    const sun = new THREE.DirectionalLight(0xffffff, 3);
    sun.position.set(1, 1, 0);
    for (const light of [point, spot, sun]) light.castShadow = true;
    const { lights, warnings } = await lit(point, spot, spot.target, sun);
    expect(lights[0]).toMatchObject({ type: 'point', color: [1, 0.5, 0.25], intensity: 8, position: [1, 2, 3] });
    expect(lights[1]).toMatchObject({ type: 'spot', intensity: 5, outer_cone_angle: 0.6, direction: [0, -0.8, 0.6] });
    expect((lights[1] as { inner_cone_angle: number }).inner_cone_angle).toBeCloseTo(0.45, 10);
    const { direction } = lights[2] as { direction: readonly number[] };
    [-Math.SQRT1_2, -Math.SQRT1_2, 0].forEach((value, k) => expect(direction[k]).toBeCloseTo(value, 10));
    expect(warnings).toEqual([]);
  });

  it('ambient ones give the irradiance that three gives', async () => {
    const { environment } = await lit(new THREE.AmbientLight(new THREE.Color(1, 0.5, 0), 2));
    // π L = irradiance.
    expect(environment).toMatchObject({ type: 'constant' });
    (environment as { radiance: readonly number[] }).radiance.forEach((value, k) =>
      expect(Math.PI * value).toBeCloseTo([2, 1, 0][k]!, 10),
    );
  });

  it('hemispheres give, at any slope, the irradiance that three gives', async () => {
    const light = new THREE.HemisphereLight(new THREE.Color(0.9, 0.8, 1), new THREE.Color(0.1, 0.3, 0), 2);
    const { environment } = await lit(light);
    const fine = wider(environment as LatLongEnvironment, 256);
    for (const normal of [
      new THREE.Vector3(0, 1, 0),
      new THREE.Vector3(0, -1, 0),
      new THREE.Vector3(1, 0, 0),
      new THREE.Vector3(0.6, 0.8, 0),
    ]) {
      const share = 0.5 * normal.y + 0.5;
      for (const [k, sky, ground] of [
        [0, 0.9, 0.1],
        [1, 0.8, 0.3],
        [2, 1, 0],
      ] as const) {
        // An image of 64 rows and 256 columns sums to within a few thousandths.
        expect(Math.abs(irradiance(fine, normal, k) - 2 * (ground + (sky - ground) * share))).toBeLessThan(0.01);
      }
    }
  });

  it('rectangles emit along their -Z with the radiance of three, whatever their scale', async () => {
    const light = new THREE.RectAreaLight(new THREE.Color(1, 0.5, 0.5), 6, 2, 3);
    light.position.set(4, 0, 0);
    light.lookAt(0, 0, 0);
    light.scale.setScalar(5);
    const { lights, warnings } = await lit(light);
    expect(lights).toHaveLength(1);
    expect(lights[0]).toMatchObject({
      type: 'rectangle',
      color: [1, 0.5, 0.5],
      intensity: 6,
      position: [4, 0, 0],
      width: 2,
      height: 3,
    });
    const { direction, tangent } = lights[0] as { direction: readonly number[]; tangent: readonly number[] };
    // Lights look at their target along -Z, unlike other objects: three turns them over.
    [-1, 0, 0].forEach((value, k) => expect(direction[k]).toBeCloseTo(value, 10));
    expect(Math.abs(tangent[2]!)).toBeCloseTo(1, 10);
    expect(warnings).toEqual([]);
  });

  it('circular ones are disks of the same area', async () => {
    const light = new THREE.RectAreaLight(0xffffff, 2, 3, 3);
    Object.assign(light, { isCircular: true });
    const { lights } = await lit(light);
    expect(lights[0]).toMatchObject({ type: 'disk', intensity: 2, radius: 1.5 });
  });

  it('warns of what is not supported', async () => {
    const light = new THREE.PointLight(0xffffff, 1, 10, 1);
    light.castShadow = true;
    const { warnings } = await lit(
      light,
      new THREE.LightProbe(),
      new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial()),
    );
    expect(warnings.map(({ code }) => code)).toEqual(['three/light', 'three/light', 'three/light', 'three/object']);
    for (const [i, word] of ['decay', 'distance', 'is not supported', 'Points'].entries())
      expect(warnings[i]!.message).toContain(word);
  });
});

describe('environment', () => {
  it.each([true, false])('turns rows the right way: flipY %s', async (flipY) => {
    const root = new THREE.Scene().add(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()));
    // The first row in memory red, the last blue.
    const data = Float32Array.of(1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1);
    const texture = new THREE.DataTexture(data, 2, 2, THREE.RGBAFormat, THREE.FloatType);
    texture.mapping = THREE.EquirectangularReflectionMapping;
    texture.flipY = flipY;
    root.environment = texture;
    root.environmentIntensity = 3;
    root.environmentRotation.y = 0.5;
    const { environment } = await fromThree(root);
    // In three row 0 is at the bottom, unless it is turned over.
    expect(environment).toMatchObject({ type: 'latlong', intensity: 3, rotation: 0.5, visible: false });
    expect(Array.from((environment as LatLongEnvironment).data.subarray(0, 3))).toEqual(flipY ? [1, 0, 0] : [0, 0, 1]);
    root.background = texture;
    expect((await fromThree(root)).environment).toMatchObject({ visible: true });
  });

  it('of 8 bits is decoded', async () => {
    const root = new THREE.Scene().add(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()));
    const texture = new THREE.DataTexture(Uint8Array.of(128, 255, 0, 255), 1, 1);
    texture.mapping = THREE.EquirectangularReflectionMapping;
    texture.colorSpace = THREE.SRGBColorSpace;
    root.environment = texture;
    // sRGB code 128 is 0.21586 (IEC 61966-2-1).
    const { environment } = await fromThree(root);
    [0.21586, 1, 0].forEach((value, k) => expect((environment as LatLongEnvironment).data[k]).toBeCloseTo(value, 4));
  });

  it('of a cube has each face where three shows it, upright and not mirrored', async () => {
    const root = new THREE.Scene().add(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()));
    const size = 8;
    // Red encodes the face; green grows to the right of the image, blue downwards.
    const face = (n: number) => {
      const data = new Float32Array(size * size * 4);
      for (let j = 0; j < size; j++)
        for (let i = 0; i < size; i++) data.set([n + 1, (i + 0.5) / size, (j + 0.5) / size, 1], 4 * (j * size + i));
      return new THREE.DataTexture(data, size, size, THREE.RGBAFormat, THREE.FloatType);
    };
    root.environment = new THREE.CubeTexture(Array.from({ length: 6 }, (_, n) => face(n)) as never);
    const { environment, warnings } = await fromThree(root);
    expect(warnings).toEqual([]);
    const { width, height, data } = environment as LatLongEnvironment;
    const look = (...d: [number, number, number]) => {
      const v = new THREE.Vector3(...d).normalize();
      const [i, j] = [
        Math.floor((Math.atan2(v.z, v.x) / (2 * Math.PI) + 0.5) * width),
        Math.min(height - 1, Math.floor((Math.acos(v.y) / Math.PI) * height)),
      ];
      return Array.from(data.subarray(3 * (j * width + i), 3 * (j * width + i) + 3));
    };
    // "Environment maps used in three.js will have pos-x and neg-x swapped" (documentation of CubeTextureLoader).
    const sides = { 1: [-1, 0, 0], 2: [1, 0, 0], 3: [0, 1, 0], 4: [0, -1, 0], 5: [0, 0, 1], 6: [0, 0, -1] } as const;
    for (const [red, [x, y, z]] of Object.entries(sides))
      expect(look(x + 0.01, y, z + 0.01)[0]).toBeCloseTo(Number(red), 5);
    // From the middle, the image on a wall is not mirrored.
    for (const [x, , z] of [sides[1], sides[2], sides[5], sides[6]]) {
      const ahead = new THREE.Vector3(x, 0, z);
      const right = ahead.clone().cross(new THREE.Vector3(0, 1, 0));
      const [rightUp, leftDown] = [1, -1].map((side) =>
        ahead
          .clone()
          .addScaledVector(right, 0.8 * side)
          .add(new THREE.Vector3(0, 0.6 * side, 0)),
      );
      const [a, b] = [look(...rightUp!.toArray()), look(...leftDown!.toArray())];
      expect(a[0]).toBe(b[0]);
      expect(a[1]).toBeGreaterThan(0.8);
      expect(a[2]).toBeLessThan(0.3);
      expect(b[1]).toBeLessThan(0.2);
      expect(b[2]).toBeGreaterThan(0.7);
    }
    // The ceiling's and the floor's lower and upper edges meet the top and the bottom of the image of +Z.
    expect(look(0.01, 1, 0.8)[2]).toBeGreaterThan(0.8);
    expect(look(0.01, -1, 0.8)[2]).toBeLessThan(0.2);
  });

  it('that cannot be read is reported', async () => {
    for (const [texture, word] of [
      [new THREE.CubeTexture(), 'six square faces'],
      [Object.assign(new THREE.Texture(), { mapping: THREE.CubeUVReflectionMapping }), 'PMREMGenerator'],
      [new THREE.Texture(), 'EquirectangularReflectionMapping'],
    ] as const) {
      const root = new THREE.Scene().add(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()));
      root.environment = texture;
      const scene = await fromThree(root);
      expect(scene.environment).toBeUndefined();
      expect(scene.warnings.map(({ code }) => code)).toEqual(['three/environment']);
      expect(scene.warnings[0]!.message).toContain(word);
    }
  });
});

describe('cameras', () => {
  it('of a canvas without a size: the aspect is not supported, and the scene is valid', async () => {
    const camera = new THREE.PerspectiveCamera(50, 0 / 0, 0.1, 100);
    camera.focus = 0;
    camera.updateMatrixWorld();
    const scene = await fromThree(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()), camera);
    expect(scene.warnings.map(({ message }) => message)).toEqual([
      expect.stringMatching(/has the aspect NaN/),
      expect.stringMatching(/has the focus 0/),
    ]);
    expect(validateScene(scene)).toEqual([]);
  });

  it("see what three's see", async () => {
    const camera = new THREE.PerspectiveCamera(50, 1.5, 0.1, 100);
    camera.position.set(3, 2, 5);
    camera.lookAt(0, 1, 0);
    camera.zoom = 1.3;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    const { cameras } = await fromThree(
      new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()),
      camera,
    );
    const [made] = cameras;
    if (made?.type !== 'perspective') throw new Error('a perspective camera was wanted');
    const m = made.transform;
    for (const point of [new THREE.Vector3(0.4, 0.3, 0.2), new THREE.Vector3(-1, 2, 1)]) {
      const expected = point.clone().project(camera);
      const to = point.toArray().map((value, k) => value - m[12 + k]!);
      const along = (c: number) => to.reduce((sum, value, k) => sum + value * m[4 * c + k]!, 0);
      const t = Math.tan(made.yfov / 2);
      expect(along(0) / (-along(2) * t * made.aspect!)).toBeCloseTo(expected.x, 6);
      expect(along(1) / (-along(2) * t)).toBeCloseTo(expected.y, 6);
    }
    const flat = new THREE.OrthographicCamera(-4, 4, 3, -1, 0.1, 10);
    const ortho = (await fromThree(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()), flat))
      .cameras[0];
    expect(ortho).toMatchObject({ type: 'orthographic', xmag: 4, ymag: 2 });
    // Its middle lies a metre above the axis.
    expect(ortho!.transform[13]).toBe(1);
  });
});
