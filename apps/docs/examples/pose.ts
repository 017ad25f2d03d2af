import type { PathTracer } from '@glanz/renderer';
import type { Mesh } from '@glanz/scene';
import { createRig, poseMesh } from '@glanz/scene/pose';

/**
 * Nods a head: four joints for each vertex, of which the second one is the
 * neck's.
 */
export async function nod(tracer: PathTracer, head: Mesh): Promise<void> {
  const vertices = head.positions.length / 3;
  const joints = new Uint16Array(4 * vertices);
  const weights = new Float32Array(4 * vertices);
  for (let v = 0; v < vertices; v++) {
    const above = Math.min(1, Math.max(0, head.positions[3 * v + 1]!));
    joints.set([0, 1, 0, 0], 4 * v);
    weights.set([1 - above, above, 0, 0], 4 * v);
  }
  const rig = createRig(head, { skin: { jointCount: 2, joints, weights } });
  const still = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  for (let frame = 0; frame < 30; frame++) {
    const angle = 0.2 * Math.sin((2 * Math.PI * frame) / 30);
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const neck = [1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, 0, 0, 1];
    const pose = poseMesh(rig, { joints: [...still, ...neck] });
    await tracer.replaceMesh(head.name, pose);
    for await (const _ of tracer.render({ samples: 16 }));
  }
}
